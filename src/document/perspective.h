/* perspective: the view of bodies in space: the place of the eye, and the faces, lines and paths at one time in the
 * order in which they are drawn, with hidden sides as faint outlines.  Pages and LaTeX draw these pieces; the script of
 * a page, which moves the bodies, takes its numbers from here, too. */
#ifndef NH_PERSPECTIVE_H
#define NH_PERSPECTIVE_H

#include "document/time_series.h"

/* sides: of a round face, of half a great circle and of a ball's outline */
enum { NH_VIEW_SIDES = 32, NH_VIEW_ARCS = 48 };

/* The projection; pixels go to the right and down. */
typedef struct {
    const nh_time_series *course;
    double wide, high; /* size of the picture, in pixels */
    int up;            /* the axis of the ground's frame that points up */
    /* unit vectors: to the eye, to the right and up in the picture, to the light */
    double towards[3], right[3], top[3], light[3];
    double ambient, direct, white; /* brightness and paleness of a face: numbers between 0 and 1 */
    double solid, faint, behind;   /* opacities: of a face, of a hidden outline, of a hidden great circle */
    double distance, scale, x, y;  /* distance of the eye; pixels per unit at the target; where the target is seen */
    double floor, pitch;           /* the lowest place; the side of the squares drawn there */
    double dot;                    /* the least radius of a ball, in pixels */
    size_t count;                  /* times */
    double *middle;                /* the target at each time, three numbers each */
} nh_view;

/* The view for the first `count` times: it contains the whole motion, or follows bodies that move far.  NULL when
 * nothing is in space.  The caller frees it by nh_view_free. */
nh_view *nh_view_create(const nh_time_series *course, size_t count, double wide, double high);
void nh_view_free(nh_view *view);

/* A point at time number i: x, y, the depth towards the eye and the pixels per unit there. */
void nh_view_see(const nh_view *view, size_t i, const double point[3], double out[4]);

/* Colours are 0xRRGGBB, or -1 for none. */
typedef struct {
    double depth;
    size_t first, points; /* its place in the picture's list */
    bool closed;
    int fill, stroke;
    double fill_opacity, stroke_opacity, width;
} nh_piece;

typedef struct {
    size_t count, capacity, points, room;
    nh_piece *piece;
    double *point; /* x and y of each, in pixels */
} nh_picture;

/* All pieces that are seen at time number i, the far ones first.  The picture begins as {0}. */
void nh_view_draw(const nh_view *view, size_t i, nh_picture *out);
/* a x b */
void nh_view_cross(const double a[3], const double b[3], double out[3]);
void nh_picture_clear(nh_picture *picture);

#endif

/* The pieces of a picture of bodies in space: faces, edges, great circles, paths and the ground. */
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "document/perspective.h"

enum { sides = NH_VIEW_SIDES, arcs = NH_VIEW_ARCS, grey = 0x808080, rods = 0x7A7A7A };

static const int colour[] = {0x0072B2, 0xD55E00, 0x009E73, 0xCC79A7, 0xE69F00, 0x56B4E9};

/* The ground, which lies below everything, then the paths. */
static const double ground_depth = -INFINITY, path_depth = -1e299;

typedef struct {
    const nh_view *view;
    size_t i; /* index of the time */
    nh_picture *out;
    double width; /* width of a line that has one pixel on a page */
} painter;

/* ---- vectors ---- */

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* p + a u + b v */
static void sum(const double p[3], double a, const double u[3], double b, const double v[3], double out[3])
{
    for (size_t j = 0; j < 3; j++) out[j] = p[j] + a * u[j] + b * v[j];
}

static double depth(const painter *w, const double p[3])
{
    double q[4];
    nh_view_see(w->view, w->i, p, q);
    return q[2];
}

/* The vector from a point to the eye. */
static void to_eye(const painter *w, const double p[3], double out[3])
{
    const nh_view *v = w->view;
    for (size_t j = 0; j < 3; j++) out[j] = v->middle[3 * w->i + j] + v->distance * v->towards[j] - p[j];
}

static double value(const painter *w, size_t s, size_t j, size_t i)
{
    const nh_line *line = nh_time_series_shape(w->view->course, s, j);
    return line->value[i * line->stride];
}

static bool triple(const painter *w, size_t s, size_t j, size_t i, double out[3])
{
    bool known = true;
    for (size_t e = 0; e < 3; e++) {
        out[e] = value(w, s, j + e, i);
        known &= isfinite(out[e]);
    }
    return known;
}

/* ---- pieces ---- */

static void add_pixel(painter *w, double x, double y)
{
    nh_picture *p = w->out;
    nh_grow(&p->point, &p->room, 2 * p->points + 2, sizeof *p->point);
    p->point[2 * p->points] = x;
    p->point[2 * p->points++ + 1] = y;
    p->piece[p->count - 1].points++;
}

static void add_point(painter *w, const double point[3])
{
    double q[4];
    nh_view_see(w->view, w->i, point, q);
    add_pixel(w, q[0], q[1]);
}

/* Adds points to the last piece. */
static nh_piece *begin(painter *w, double at, int stroke, double opacity, double width)
{
    nh_picture *p = w->out;
    nh_grow(&p->piece, &p->capacity, p->count + 1, sizeof *p->piece);
    p->piece[p->count] = (nh_piece){.depth = at,
                                    .first = p->points,
                                    .fill = -1,
                                    .stroke = stroke,
                                    .stroke_opacity = opacity,
                                    .width = width * w->width};
    return &p->piece[p->count++];
}

/* The colour of a face with this normal in the light. */
static int lit(const painter *w, int base, const double normal[3])
{
    const nh_view *v = w->view;
    double bright = v->ambient + v->direct * fmax(0, dot(normal, v->light));
    int out = 0;
    for (int shift = 16; shift >= 0; shift -= 8) {
        double part = (base >> shift) & 0xFF;
        out |= (int)lround(bright * (part + (255 - part) * v->white)) << shift;
    }
    return out;
}

/* A face, with or without edges, if its outer side is seen; otherwise a faint outline. */
static bool face(painter *w, size_t n, double (*corner)[3], const double normal[3], int base, bool edged)
{
    static const double edge = 1.4, seam = 0.5;
    double middle[3] = {0, 0, 0}, eye[3];
    for (size_t k = 0; k < n; k++)
        for (size_t j = 0; j < 3; j++) middle[j] += corner[k][j] / (double)n;
    to_eye(w, middle, eye);
    bool front = dot(normal, eye) > 0;
    if (!front && !edged) return false;
    nh_piece *p = begin(w, depth(w, middle), front && !edged ? lit(w, base, normal) : base, front ? 1 : w->view->faint,
                        !front  ? 1
                        : edged ? edge
                                : seam);
    p->closed = true;
    if (front) p->fill = lit(w, base, normal), p->fill_opacity = w->view->solid;
    for (size_t k = 0; k < n; k++) add_point(w, corner[k]);
    return front;
}

/* The great circle in the plane of a and b: lines where it is seen, faint ones where the ball hides it. */
static void great_circle(painter *w, const double p[3], const double a[3], const double b[3], double r, int base)
{
    static const double front_opacity = 0.95, width = 1.4;
    double eye[3], from[3], to[3], away[3];
    to_eye(w, p, eye);
    int before = -1;
    for (int k = 0; k < arcs; k++) {
        double t = 2 * M_PI * k / arcs, u = 2 * M_PI * (k + 1) / arcs;
        sum(p, r * cos(t), a, r * sin(t), b, from);
        sum(p, r * cos(u), a, r * sin(u), b, to);
        for (size_t j = 0; j < 3; j++) away[j] = from[j] - p[j];
        int front = dot(away, eye) > r * r;
        if (front != before) {
            begin(w, depth(w, p) + (front ? r : -r), base, front ? front_opacity : w->view->behind, width);
            add_point(w, from);
        }
        add_point(w, to);
        before = front;
    }
}

static void ball(painter *w, const double p[3], double r, double (*axis)[3], int base)
{
    static const double edge = 1.4, seen = 1.2; /* great circles are drawn on a ball that is larger than a point */
    double q[4];
    nh_view_see(w->view, w->i, p, q);
    double radius = fmax(w->view->dot, q[3] * r);
    nh_piece *piece = begin(w, q[2], base, 1, edge);
    piece->closed = true;
    piece->fill = lit(w, base, w->view->towards);
    piece->fill_opacity = w->view->solid;
    for (int k = 0; k < arcs; k++)
        add_pixel(w, q[0] + radius * cos(2 * M_PI * k / arcs), q[1] + radius * sin(2 * M_PI * k / arcs));
    for (size_t k = 0; k < 3 && q[3] * r > seen * w->view->dot; k++)
        great_circle(w, p, axis[k], axis[(k + 1) % 3], r, base);
}

/* Each end with two radii, so that its rotation is seen. */
static void cylinder(painter *w, const double p[3], double r, double half, double (*axis)[3], int base)
{
    static const double lifted = 0.01, mark = 3, counter_mark = 0.5;
    double around[sides + 1][3], corner[sides][3], from[3], to[3], normal[3];
    for (int k = 0; k <= sides; k++)
        for (size_t j = 0; j < 3; j++)
            around[k][j] = r * (cos(2 * M_PI * k / sides) * axis[0][j] + sin(2 * M_PI * k / sides) * axis[1][j]);
    for (int e = 1; e >= -1; e -= 2) {
        sum(p, e * half, axis[2], 0, axis[2], from);
        sum(axis[2], e - 1, axis[2], 0, axis[2], normal);
        for (int k = 0; k < sides; k++) sum(from, 1, around[k], 0, axis[2], corner[k]);
        if (!face(w, sides, corner, normal, base, true)) continue;
        for (int k = 0; k < 2; k++) {
            begin(w, depth(w, from) + lifted * r, base, k ? counter_mark : 1, k ? 1 : mark);
            sum(from, 1, around[k * sides / 2], 0, axis[2], to);
            add_point(w, from);
            add_point(w, to);
        }
    }
    for (int k = 0; k < sides && half > 0; k++) {
        double length = 2 * r * cos(M_PI / sides), quad[4][3];
        for (int c = 0; c < 4; c++) sum(p, 1, around[k + (c == 1 || c == 2)], c < 2 ? half : -half, axis[2], quad[c]);
        for (size_t j = 0; j < 3; j++) normal[j] = length > 0 ? (around[k][j] + around[k + 1][j]) / length : 0;
        face(w, 4, quad, normal, base, false);
    }
}

static void block(painter *w, const double p[3], const double edge[3], double (*axis)[3], int base)
{
    for (size_t k = 0; k < 6; k++) {
        size_t u = k % 3, v = (u + 1) % 3, t = (u + 2) % 3;
        double side = k < 3 ? 1 : -1, normal[3], centre[3], corner[4][3];
        sum(axis[u], side - 1, axis[u], 0, axis[u], normal);
        sum(p, side * edge[u] / 2, axis[u], 0, axis[u], centre);
        for (int c = 0; c < 4; c++)
            sum(centre, (c == 0 || c == 3 ? 0.5 : -0.5) * edge[v], axis[v], (c < 2 ? 0.5 : -0.5) * edge[t], axis[t],
                corner[c]);
        face(w, 4, corner, normal, base, true);
    }
}

static void body(painter *w, size_t s, int base)
{
    nh_shape_kind kind = w->view->course->shape[s].kind;
    size_t axes = nh_shape_numbers(kind) - 6;
    double p[3], size[3] = {0, 0, 0}, axis[3][3];
    bool known = triple(w, s, 0, w->i, p) && triple(w, s, axes, w->i, axis[0]) && triple(w, s, axes + 3, w->i, axis[1]);
    for (size_t j = 3; j < axes; j++) {
        size[j - 3] = value(w, s, j, w->i);
        known &= isfinite(size[j - 3]);
    }
    if (!known) return;
    nh_view_cross(axis[0], axis[1], axis[2]);
    if (kind == NH_SHAPE_BALL) ball(w, p, size[0], axis, base);
    else if (kind == NH_SHAPE_CYLINDER) cylinder(w, p, size[0], size[1] / 2, axis, base);
    else block(w, p, size, axis, base);
}

static void rod(painter *w, size_t s)
{
    static const double width = 3;
    double from[3], to[3];
    if (!triple(w, s, 0, w->i, from) || !triple(w, s, 3, w->i, to)) return;
    begin(w, (depth(w, from) + depth(w, to)) / 2, rods, 1, width);
    add_point(w, from);
    add_point(w, to);
}

/* ---- the ground and the paths ---- */

/* Squares whose side is a round number. */
static void ground(painter *w)
{
    enum { half = 4 };
    static const double faint = 0.25;
    const nh_view *v = w->view;
    size_t across[2] = {(size_t)(v->up + 1) % 3, (size_t)(v->up + 2) % 3};
    const double *middle = v->middle + 3 * w->i;
    for (size_t m = 0; m < 2; m++)
        for (int k = -half; k <= half; k++) {
            double p[3], *along = &p[across[1 - m]];
            p[v->up] = v->floor;
            p[across[m]] = v->pitch * (round(middle[across[m]] / v->pitch) + k);
            *along = v->pitch * (round(middle[across[1 - m]] / v->pitch) - half);
            begin(w, ground_depth, grey, faint, 1);
            add_point(w, p);
            *along += 2 * half * v->pitch;
            add_point(w, p);
        }
}

/* Where the shape is seen at time k; a shape in the plane is on the ground. */
static bool seen_at(const painter *w, size_t s, size_t k, double q[4])
{
    double p[3] = {value(w, s, 0, k), value(w, s, 1, k), 0};
    if (nh_shape_in_space(w->view->course->shape[s].kind)) p[2] = value(w, s, 2, k);
    if (!isfinite(p[0]) || !isfinite(p[1]) || !isfinite(p[2])) return false;
    nh_view_see(w->view, w->i, p, q);
    return true;
}

/* The cubic from time k - 1 to k that Catmull and Rom give, in steps of few pixels. */
static void bow(painter *w, double (*q)[2])
{
    enum { most = 24 };
    static const double step = 3;
    int n = (int)fmin(most, ceil(hypot(q[2][0] - q[1][0], q[2][1] - q[1][1]) / step));
    for (int k = 1; k <= n; k++) {
        double t = (double)k / n, p[2];
        for (size_t j = 0; j < 2; j++) {
            double a = q[1][j], b = q[2][j], da = (b - q[0][j]) / 2, db = (q[3][j] - a) / 2;
            p[j] = a + t * (da + t * (3 * (b - a) - 2 * da - db + t * (da + db - 2 * (b - a))));
        }
        add_pixel(w, p[0], p[1]);
    }
}

static void path(painter *w, size_t s, int base)
{
    static const double opacity = 0.4, width = 1.2, nearest = 1; /* pixels between two points */
    size_t count = w->view->count;
    bool on = false;
    double last[2] = {0, 0};
    for (size_t k = 0; k < count; k++) {
        double now[4], other[4], q[4][2];
        bool known = seen_at(w, s, k, now);
        if (known && !on) {
            begin(w, path_depth, base, opacity, width);
            add_pixel(w, now[0], now[1]);
        }
        double distance = known && on ? hypot(now[0] - last[0], now[1] - last[1]) : 0;
        if (known && on && distance < nearest && k + 1 < count) continue;
        for (size_t e = 0; e < 4 && known && on; e++) { /* the ends count twice */
            size_t at = k + e >= 2 ? k + e - 2 : 0;
            bool there = at < count && seen_at(w, s, at, other);
            for (size_t j = 0; j < 2; j++) q[e][j] = e == 1 ? last[j] : there ? other[j] : e ? now[j] : last[j];
        }
        if (known && on) bow(w, q);
        on = known;
        last[0] = now[0];
        last[1] = now[1];
    }
}

static int farther(const void *a, const void *b)
{
    const nh_piece *p = a, *q = b;
    if (p->depth != q->depth) return p->depth < q->depth ? -1 : 1;
    return (p->first > q->first) - (p->first < q->first); /* in the order in which they were added */
}

void nh_view_draw(const nh_view *v, size_t i, nh_picture *out)
{
    static const double page = 640, thinnest = 0.6;
    painter w = {.view = v, .i = i, .out = out, .width = fmax(thinnest, v->wide / page)};
    const nh_time_series *c = v->course;
    size_t k = 0;
    ground(&w);
    for (size_t s = 0; s < c->shapes; s++) {
        nh_shape_kind kind = c->shape[s].kind;
        if (c->shape[s].flat) continue;
        if (kind == NH_SHAPE_ROD) {
            rod(&w, s);
            continue;
        }
        int base = colour[k++ % (sizeof colour / sizeof *colour)];
        if (kind != NH_SHAPE_SEGMENT) path(&w, s, base);
        if (nh_shape_in_space(kind)) body(&w, s, base);
    }
    qsort(out->piece, out->count, sizeof *out->piece, farther);
}

void nh_picture_clear(nh_picture *p)
{
    nh_free(p->piece);
    nh_free(p->point);
    *p = (nh_picture){0};
}

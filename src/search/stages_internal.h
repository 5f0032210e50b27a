/* For the files that build stages. */
#ifndef NH_STAGES_INTERNAL_H
#define NH_STAGES_INTERNAL_H

#include "search/stages.h"

enum { NH_MOST_LIST = 1600, NH_MOST_FAMILIES = 24 };

/* The families of one stage. */
typedef struct {
    nh_arena *arena;
    const nh_model *o;
    const nh_dictionary *w;
    nh_family *family;
    size_t count;
} nh_shelf;

/* Expressions, each once; more than fit are left out: a list that is full has more columns than the option `columns` lets any ansatz have. */
typedef struct {
    size_t n;
    nh_ex e[NH_MOST_LIST];
} nh_list;

void nh_list_put(nh_list *list, nh_ex e);
void nh_list_put_all(nh_list *list, size_t n, const nh_ex *e);
nh_list nh_list_squares(const nh_shelf *shelf, const nh_list *a);
/* The coordinates, with 1, with t. */
nh_list nh_list_positions(const nh_shelf *shelf, bool one, bool time);
/* 1, the coordinates that are not only in sines and cosines, their squares, t. */
nh_list nh_list_lengths(const nh_shelf *shelf, bool squares_too, bool time);
/* The system's own functions of position, with 1. */
nh_list nh_list_functions(const nh_shelf *shelf, bool one);

nh_family nh_shelf_terms(nh_shelf *shelf, const nh_list *list);
nh_family nh_shelf_product(nh_shelf *shelf, size_t n, const nh_family *part);
nh_family nh_shelf_polynomial(nh_shelf *shelf, const nh_list *list, size_t degree);
void nh_shelf_add(nh_shelf *shelf, nh_family family);
void nh_shelf_product_of_lists(nh_shelf *shelf, const nh_list *a, const nh_list *b);

/* ---- stages_time.c ---- */

/* Does the Lagrangian, a force or a constraint depend on time? */
bool nh_shelf_timely(const nh_shelf *shelf);
/* Functions of t alone, with their derivatives. */
void nh_list_put_time(const nh_shelf *shelf, nh_list *list);
/* What a force that depends on t alone adds to momenta and centres of mass. */
void nh_shelf_drive(nh_shelf *shelf);
/* Momenta, positions, powers and logarithms of t, and no more. */
void nh_stage_drive(nh_shelf *shelf);
/* Squares of positions and velocities with coefficients that depend on time: Ermakov and Lewis. */
void nh_stage_time(nh_shelf *shelf);

/* ---- stages_many.c ---- */

void nh_stage_centres(nh_shelf *shelf);
void nh_stage_turns(nh_shelf *shelf);

/* ---- stages_weighted.c ---- */

/* Degree four with weights, in the frame of the kinetic energy and in the system's own forms. */
void nh_stage_weight_4(nh_shelf *shelf);
void nh_stage_forms_4(nh_shelf *shelf);

/* ---- stages_separation.c ---- */

void nh_stage_separation(nh_shelf *shelf);
/* Squares of single momenta, and the energy, with coefficients that are functions of one coordinate each, and these. */
void nh_stage_separated(nh_shelf *shelf);
/* Squares of momenta with coefficients that are functions of one coordinate each (Carter's constant). */
void nh_stage_momenta(nh_shelf *shelf);
/* Quasi-homogeneous polynomials of degree four in the velocities, for polynomial potentials. */
void nh_stage_homogeneous(nh_shelf *shelf);
/* Cubic in the velocities times positions, the system's functions with one velocity (Holt, Fokas and Lagerstrom). */
void nh_stage_cubic(nh_shelf *shelf);
/* Half angles: parabolic coordinates seen from polar ones. */
void nh_stage_half_angles(nh_shelf *shelf);
/* 1 and products of functions of one coordinate, and velocities with these. */
nh_list nh_list_one_coordinate(const nh_shelf *shelf);
void nh_stage_one_coordinate(nh_shelf *shelf);

#endif

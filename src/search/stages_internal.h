/* stages_internal: lists of expressions and families, for the files that build stages. */
#ifndef NH_STAGES_INTERNAL_H
#define NH_STAGES_INTERNAL_H

#include "search/stages.h"

enum { NH_MOST_EXPRS = 1600, NH_MOST_FAMILIES = 24 };

/* The families of one stage. */
typedef struct {
    nh_arena *arena;
    const nh_model *o;
    const nh_dictionary *w;
    nh_family *family;
    size_t count;
} nh_family_list;

/* Expressions, each once.  Those for which there is no room are left out: a full list has more columns than the option
 * `columns` allows an ansatz. */
typedef struct {
    size_t n;
    nh_ex e[NH_MOST_EXPRS];
} nh_expr_set;

/* The first adds one expression, the second n; the third returns the products of two of `a`, squares included. */
void nh_expr_set_put(nh_expr_set *list, nh_ex e);
void nh_expr_set_put_all(nh_expr_set *list, size_t n, const nh_ex *e);
nh_expr_set nh_expr_set_squares(const nh_family_list *families, const nh_expr_set *a);
/* The coordinates, with 1, with t. */
nh_expr_set nh_expr_set_positions(const nh_family_list *families, bool one, bool time);
/* 1, the coordinates that are not only in sines and cosines, their squares, t. */
nh_expr_set nh_expr_set_lengths(const nh_family_list *families, bool squares_too, bool time);
/* Products over the angles of {1, cos, sin}. */
nh_expr_set nh_expr_set_waves(const nh_family_list *families);
/* The system's own functions of position, with 1. */
nh_expr_set nh_expr_set_functions(const nh_family_list *families, bool one);

/* Families in the arena of the list: these terms; products of one function of each part; all monomials up to the
 * degree. Then added to the list: one; the products of the terms of two sets.  Beyond NH_MOST_FAMILIES none is
 * added. */
nh_family nh_family_list_terms(nh_family_list *families, const nh_expr_set *list);
nh_family nh_family_list_product(nh_family_list *families, size_t n, const nh_family *part);
nh_family nh_family_list_polynomial(nh_family_list *families, const nh_expr_set *list, size_t degree);
void nh_family_list_add(nh_family_list *families, nh_family family);
void nh_family_list_product_of_sets(nh_family_list *families, const nh_expr_set *a, const nh_expr_set *b);

/* ---- stages_time.c ---- */

/* Does the Lagrangian, a force or a constraint depend on time? */
bool nh_family_list_timely(const nh_family_list *families);
/* Functions of t alone, with their derivatives. */
void nh_expr_set_put_time(const nh_family_list *families, nh_expr_set *list);
/* The functions that a force depending on t alone adds to momenta and centres of mass. */
void nh_family_list_drive(nh_family_list *families);
/* Momenta, positions, powers and logarithms of t, and no more. */
void nh_stage_drive(nh_family_list *families);
/* Squares of positions and velocities with coefficients that depend on time: Ermakov and Lewis. */
void nh_stage_time(nh_family_list *families);

/* ---- stages_weighted.c ---- */

/* Degree four with weights, in the frame of the kinetic energy. */
void nh_stage_weight_4(nh_family_list *families);

/* ---- stages_rational.c ---- */

/* Quotients by those factors of the Lagrangian's denominators that are affine in the velocities; none without them. */
void nh_stage_rational(nh_family_list *families);
nh_expr_set nh_expr_set_quotients(const nh_family_list *families);

/* Squares of velocities with coefficients of higher degree in the positions; the energy and functions with lower
 * ones. */
void nh_stage_separation(nh_family_list *families);
/* Half angles: parabolic coordinates seen from polar ones. */
void nh_stage_half_angles(nh_family_list *families);

#endif

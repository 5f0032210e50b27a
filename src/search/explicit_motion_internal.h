/* explicit_motion_internal: the known formulas of the states along one curve, for the parts of explicit_motion.c. */
#ifndef NH_EXPLICIT_MOTION_INTERNAL_H
#define NH_EXPLICIT_MOTION_INTERNAL_H

#include "search/explicit_motion.h"
#include "search/combined_coordinates.h"

enum { most_constants = 24, most_roots = 4, most_integrals = 8, most_symbols = 60 };

/* An expression as a polynomial in each of the states, as far as that was asked for. */
typedef struct nh_explicit_form {
    nh_ex e;
    struct {
        int degree; /* one more than nh_explicit_degree; 0: not asked for */
        nh_ex k[3];
    } * in; /* per state */
} nh_explicit_form;

/* A current along the curve, until another state is solved. */
typedef struct {
    bool read;
    size_t unknowns; /* states that are not solved and that it depends on */
    nh_explicit_form *form;
} nh_explicit_view;

/* du/ds = r = A u + B of the state u, read anew when another state is solved. */
typedef struct {
    bool read, made, linear, refused; /* made: read at some time; refused: it could not be integrated */
    size_t state, length;
    nh_ex own, speed, r, A, B; /* r = own/speed */
} nh_explicit_equation;

typedef struct {
    nh_arena *arena;
    const nh_model *o;
    nh_dag *d;
    const nh_points *points;
    const nh_options *options;
    const nh_ex *fixed;
    const nh_combined_coordinates *combined; /* all expressions are in them; NULL: none */
    nh_explicit_motion *m;
    /* of every state: its rate; its value in s, the constants, the roots, the integrals and the states that are not
       solved */
    nh_ex s, *rate, *value;
    bool *solved;
    nh_explicit_equation *equation; /* per state */
    size_t currents, most_named;
    nh_ex *current;
    nh_explicit_view *view; /* per current */
    nh_explicit_forms *forms;
    bool *used;
    size_t symbols; /* parameters of the system, then the constants */
    nh_ex symbol[most_symbols];
    nh_ex radicand[most_roots]; /* of the roots, with the earlier ones written as such */
} nh_explicit_curve;

/* ---- expressions along the curve and in the states (explicit_motion_curve.c) ---- */

nh_ex nh_explicit_simple(const nh_explicit_curve *c, nh_ex e);
bool nh_explicit_too_long(const nh_explicit_curve *c, nh_ex e);
/* With the solved states substituted. */
nh_ex nh_explicit_along(const nh_explicit_curve *c, nh_ex e);
/* In the states alone, without combined coordinates; integrals are 0: it has a value at a point of the model. */
nh_ex nh_explicit_at_points(const nh_explicit_curve *c, nh_ex e);
/* The same sign at all points?  0: no, or not known. */
int nh_explicit_sign(void *curve, nh_ex e);
/* The sign at more points than the other; 0: neither. */
int nh_explicit_mostly(void *curve, nh_ex e);
/* Does an integral without closed form stand in e? */
bool nh_explicit_has_integral(const nh_explicit_curve *c, nh_ex e);
/* How many states that are not solved e depends on; the last of them. */
size_t nh_explicit_unknowns(const nh_explicit_curve *c, nh_ex e, size_t *last);
void nh_explicit_settle(nh_explicit_curve *c, size_t u, nh_ex value);
nh_ex nh_explicit_split_roots(nh_explicit_curve *c, nh_ex e);
bool nh_explicit_room(const nh_explicit_curve *c);
/* C1, C2, ...: its value along the curve. */
nh_ex nh_explicit_constant(nh_explicit_curve *c, nh_ex value, bool integrated);
bool nh_explicit_vanishes(const nh_explicit_curve *c, nh_ex e);
/* The degree of a polynomial in u, at most two; 3 otherwise. */
int nh_explicit_degree(const nh_explicit_curve *c, nh_ex e, nh_ex u, nh_ex k[3]);

/* ---- steps; false: none could be taken ---- */

/* From currents, with at most so many states that are not solved. */
bool nh_explicit_solve_first(nh_explicit_curve *c, size_t most_unknowns);
bool nh_explicit_solve_second(nh_explicit_curve *c, size_t most_unknowns, bool constant_root);
/* By integration (explicit_motion_rates.c): in closed form; else what has none gets a name. */
bool nh_explicit_solve_rate(nh_explicit_curve *c, bool named);

#endif

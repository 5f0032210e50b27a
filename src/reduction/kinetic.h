/* kinetic: a system as kinetic energy, potential and constraint forms, the data that reduction works with.
 *
 *     L = 1/2 K_rs(q) v^r v^s + a_s(q) v^s - V(q),      f^A = omega^A_s(q) v^s + b^A(q)
 *
 * The constraints are taken without poles (sin instead of tan).  Any property beyond this (explicit time, forces, a
 * Lagrangian that is not quadratic, constraints that are not linear) is recorded. */
#ifndef NH_KINETIC_H
#define NH_KINETIC_H

#include "base/option.h"
#include "geometry/model.h"

typedef struct {
    const nh_model *model;
    nh_dag *dag;
    nh_arena *arena;
    size_t m, f;            /* coordinates, constraints */
    nh_ex *q, *v;           /* m symbols each */
    const char **name;      /* m, of the coordinates */
    bool *angle, *periodic; /* m: an angle; one that is at the same place after a turn */
    bool *dependent;        /* m: named under `dependent:` */
    nh_ex *K, V, *a;        /* m x m (row-major), m; zeros unless quadratic */
    nh_ex *force;           /* f: the constraints without poles */
    nh_ex *omega, *b;       /* f x m (row-major), f; zeros unless affine */
    const nh_ex *Q;         /* m: forces without a potential */
    bool quadratic, magnetic, autonomous, forced, affine, linear;
    bool metric;     /* quadratic, and K positive definite at the sample points */
    bool invertible; /* quadratic, and K of full rank there */
    bool reducible;  /* L = K - V with a metric, linear constraints, no time, no forces */
    /* a metric, no time, constraints that are at most affine: the system has reduced equations, though no connection is
     * used */
    bool general;
    /* the same with any invertible K: its symmetries are counted (jets.h) */
    bool countable;
    const char *obstacle;  /* the reason why it is not reducible, in words; NULL: it is */
    size_t places;         /* samples */
    double *place, *speed; /* places x m: positions, and velocities that satisfy the constraints */
    double *time;          /* places */
} nh_kinetic;

/* Keeps the model, which may be bare and must outlive it.  NULL with a message when there are too few usable sample
   points. */
nh_kinetic *nh_kinetic_create(const nh_model *model, uint64_t seed, nh_error *error);
/* The same for what follows from the kinetic energy alone: time may occur elsewhere, and the potential is zero. */
nh_kinetic *nh_kinetic_metric(const nh_model *model, uint64_t seed, nh_error *error);
void nh_kinetic_free(nh_kinetic *kinetic);

/* The name, with _r behind it where the file has one like it: of a coordinate, velocity, parameter or definition.  In
 * the kinetic's arena. */
const char *nh_kinetic_unused_name(const nh_kinetic *kinetic, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
/* A tape of expressions in the coordinates, parameters bound. */
nh_tape *nh_kinetic_tape(const nh_kinetic *kinetic, size_t count, const nh_ex *out);
/* d e / d x; 0 once the run was ended (base/progress.h): of large mass matrices all derivatives are wanted, and of an
   ended run nothing is kept. */
nh_ex nh_kinetic_diff(const nh_kinetic *kinetic, nh_ex e, nh_ex x);
/* Values of expressions in the coordinates at one place. */
void nh_kinetic_values(const nh_kinetic *kinetic, size_t count, const nh_ex *e, const double *q, double *out);
/* The rank of a matrix of expressions, row by row, at almost all places, for the parameters' values (modulo primes).
 * False: not known. */
bool nh_kinetic_rank(const nh_kinetic *kinetic, size_t rows, size_t columns, const nh_ex *e, size_t *rank);
/* At the first `places` sample points, count values each. */
void nh_kinetic_sample(const nh_kinetic *kinetic, size_t count, const nh_ex *e, size_t places, double *out);
/* The largest modulus of each coordinate at the first `places` sample points, in which fields compare whatever the
   units are: 1 for an angle, and where it is zero at all of them. */
void nh_kinetic_sizes(const nh_kinetic *kinetic, size_t places, double *size);
/* The length of the sampling box in the metric with this diagonal (m), or 1 without one: fields are compared with it,
 * and what is found does not depend on units.  A power of 1024, by which no digit is lost: where the length is near one
 * it is 1. */
double nh_kinetic_length(const nh_kinetic *kinetic, const double *diagonal);
/* Does one of them change its value when an angle makes one turn?  Then it is defined on a covering of the
 * configuration space only. */
bool nh_kinetic_many_valued(const nh_kinetic *kinetic, size_t count, const nh_ex *e);

#endif

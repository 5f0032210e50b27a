/* linearize: the linear equations of motion at a state, or along a family of states, and what their eigenvalues say
 * about stability. */
#ifndef NH_LINEARIZE_H
#define NH_LINEARIZE_H

#include "commands/request.h"
#include "commands/scan.h"
#include "geometry/linearization.h"

/* What the eigenvalues of the closed linear equations say: a real part is positive or negative where its error bound
 * proves that. */
typedef enum {
    NH_LINEAR_UNSTEADY, /* nothing: the state is not steady, or its linear equations change with time */
    NH_LINEAR_UNKNOWN,  /* nothing: no eigenvalues were enclosed */
    NH_LINEAR_UNSTABLE, /* there is a positive real part */
    NH_LINEAR_STABLE,   /* all real parts are negative */
    NH_LINEAR_BUT_ZERO, /* those of all eigenvalues but 0 are */
    NH_LINEAR_MARGINAL  /* none is positive, some eigenvalue besides 0 has none */
} nh_linear_verdict;

typedef struct {
    nh_scan_value value;
    nh_linear_equations *equations; /* NULL: see why */
    const char *why;
    nh_linear_verdict verdict;
    size_t positive; /* eigenvalues with positive real part, with multiplicity */
} nh_linear_row;

/* Between low and high the verdict changes, or the number of positive real parts. */
typedef struct {
    double low, high;
    nh_linear_verdict before, after;
    size_t positive_before, positive_after;
} nh_linear_change;

struct nh_linearized { /* nhsym.h */
    nh_arena *arena;
    nh_system *system;
    nh_linearization *linearization;
    const char *at, *over; /* as typed; over: the name, or NULL */
    size_t rows;           /* 1 without `over` */
    nh_linear_row *row;
    size_t changes, change_capacity;
    nh_linear_change *change;
    size_t branches; /* of eigenvalues along `over` */
    double *re, *im; /* rows x branches; NAN where there is none */
    bool partial;
};

/* nh_linearized_free frees it.  NULL with a message; with `over` an answer may lack some values, which say why. */
nh_linearized *nh_linearize_create(const nh_request *request, nh_error *error);

/* The name of entry i of (x, w) of the linear equations: "lean", "lean'"; in the system's memory. */
const char *nh_linearize_name(const nh_linearized *linearized, const nh_linear_equations *equations, size_t i);

#endif

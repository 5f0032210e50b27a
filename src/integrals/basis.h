/* basis: which columns of a sampled matrix are independent, and by how much.  Used by the null space and by the
   pencil. */
#ifndef NH_BASIS_H
#define NH_BASIS_H

#include <stdbool.h>
#include <stddef.h>

#include "base/error.h"

/* All tolerances, from the option table. */
typedef struct {
    /* a column of B is dependent when less than this part of it is independent of the columns before it (1e-9) */
    double rank;
    double zero;      /* null: sigma <= zero * eps * max(1, sigma_max)  (100) */
    double undecided; /* undecided up to this many times the null bound (1e5) */
    double gap;       /* least ratio of the first non-null to the last null value (1e3) */
    /* sigma_max enters the null bound up to this value: a singular column must not make everything null (1e6) */
    double steepest;
    double likely;  /* values up to this one, before the widest gap, are likely null (1e-7) */
    double trivial; /* a column whose variation is below trivial * its size is constant (1e-11) */
} nh_nullspace_options;

/* Columns that are independent over the samples, chosen by Gram-Schmidt of the equilibrated matrix in the caller's
 * order: B D^-1 P = Q R with D = diag(scale) and P the columns that are kept. [VanDerSluis1969] */
typedef struct {
    size_t count;   /* independent columns */
    size_t *column; /* their numbers, ascending: of dependent columns the first ones stay */
    double *r;      /* count x count, upper triangle */
    double *scale;  /* per column of B (all of them): its norm; 0 marks a constant or empty column */
    double smallest_kept, largest_dropped; /* pivots relative to the first; 0 when there is none */
} nh_basis;

/* b: rows x columns with leading dimension ld, or its triangle.  size: norm of each column before centring; NULL:
 * nothing was centred.  A basis with count 0 is no error. */
bool nh_basis_init(nh_basis *basis, size_t rows, size_t columns, const double *b, size_t ld, const double *size,
                   const nh_nullspace_options *options, nh_error *error);
void nh_basis_clear(nh_basis *basis);
/* out (rows x count) := a D^-1 P, the same columns of another matrix in the same units. */
void nh_basis_gather(const nh_basis *basis, size_t rows, const double *a, size_t ld, double *out);
/* c (columns x count_of_x) := D^-1 P R^-1 x, from orthonormal coordinates x (count x count_of_x, overwritten) to the
 * columns; columns outside the basis get 0. */
void nh_basis_expand(const nh_basis *basis, size_t columns, size_t count_of_x, double *x, double *c);

#endif

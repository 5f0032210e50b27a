/* rows: the constraint Noether equations at sample points.
 *
 * Current route [CechMusilova2014, sec. 3.3]:  unknown Phi = sum_j c_j b_j, rows
 *
 *     Gamma(b_j) / (1 + max|a| + max|v|)
 *
 * Symmetry route [CechMusilova2014, eqs. 17, 19]:  unknown z0 = Lbar Z^0 and zeta^i, independent of each other, rows
 *
 *     (N0)   X_0(Phi) + A_i zeta^i = 0
 *     (NY)   Y_j(Phi) - M_ij zeta^i = 0            with  Phi = z0 + pbar_i zeta^i.
 *
 * Writing Lbar Z^0 instead of Z^0 keeps the problem regular where Lbar vanishes.  (NX) only determines W and is not
 * fitted. */
#ifndef NH_ROWS_H
#define NH_ROWS_H

#include "integrals/ansatz.h"
#include "integrals/nullspace.h"

/* The current route, prepared: one tape for the factors and their rates, and scratch for a batch.  `unknown` are
 * symbols of the ansatz whose values are given at each run.  Borrows model and ansatz. */
typedef struct nh_rows nh_rows;
nh_rows *nh_rows_create(const nh_model *model, const nh_ansatz *ansatz, size_t unknowns, const nh_ex *unknown);
void nh_rows_free(nh_rows *rows);

/* Feed A and B for all points, with the unknowns at theta.  Points beyond the chart give equations (A), no values (B):
 * a function of the chart may be as large as it likes there, which says nothing about how much it varies. */
void nh_rows_current(nh_rows *rows, const nh_points *points, const double *theta, nh_equations *equations);

/* The same as whole matrices: weighted rates into a (nh_points_equations x columns), values into b (count x columns),
   column-major. */
void nh_rows_all(const nh_model *model, const nh_ansatz *ansatz, const nh_points *points, double *a, double *b);

/* kappa b_j and Gamma(b_j) for the pencil, into count x columns arrays (column-major). */
void nh_rows_pencil(const nh_model *model, const nh_ansatz *ansatz, nh_ex kappa, const nh_points *points, double *a,
                    double *b);

/* The symmetry route's own columns: a function g that is a candidate for z0 (slot 0) or for zeta^i (slot i). */
typedef struct {
    size_t slot; /* 0: z0;  i >= 1: zeta^(i-1) */
    nh_ex function;
} nh_field_column;

/* The fields that the ansatz' currents would have: z0 = b - pbar zeta, zeta = M^-1 db/dw, each component a column of
 * its own, repeated ones once.  The list belongs to the model's arena. */
size_t nh_rows_field_columns(const nh_model *model, size_t n, const nh_ex *b, nh_field_column **out);

void nh_rows_symmetry(const nh_model *model, size_t n, const nh_field_column *column, const nh_points *points,
                      nh_equations *equations);

/* The current that a combination of field columns gives. */
nh_ex nh_rows_field_current(const nh_model *model, const nh_field_column *column);

#endif

/* linalg: dense linear algebra, over LAPACK.  Matrices are column-major (LAPACK's order): a[i + j*ld] is row i, column
 * j. */
#ifndef NH_LINALG_H
#define NH_LINALG_H

#include <stdbool.h>
#include <stddef.h>

/* Sets the number of BLAS threads.  One is best: starting BLAS threads costs more than most of our matrices take, and
 * our own threads (base/parallel.h) do not change results. */
void nh_linalg_threads(int count);

/* Are all `count` numbers x finite?  LAPACK's iterations may not end on a NaN: all functions below refuse one. */
bool nh_all_finite(size_t count, const double *x);

/* Streaming QR: feed blocks of rows, keep only the triangle.  Memory O(columns^2).  With more than one thread it is
 * computed while the caller continues with the next rows; the triangle is the same to the last bit. */
typedef struct nh_qr nh_qr;
nh_qr *nh_qr_create(size_t columns, size_t threads);
void nh_qr_free(nh_qr *qr);
void nh_qr_reset(nh_qr *qr); /* forget all rows */
/* `rows` x columns block, column-major with leading dimension ld >= rows; it is overwritten. */
void nh_qr_add(nh_qr *qr, size_t rows, double *block, size_t ld);
/* The upper triangle R (columns x columns, zeros below the diagonal). */
void nh_qr_triangle(nh_qr *qr, double *r);
size_t nh_qr_rows(const nh_qr *qr); /* rows seen so far */

/* Singular values (descending) of a (m x n), left vectors u (m x min, may be NULL), right vectors vt (min x n, may be
 * NULL). False when the iteration fails, or when the user interrupts a large one (base/progress.h). */
bool nh_svd(size_t m, size_t n, double *a, double *s, double *u, double *vt);

/* Eigenvalues of a general n x n matrix (overwritten); right eigenvectors in LAPACK's packing into v (n x n), may be
   NULL. */
bool nh_eigen(size_t n, double *a, double *re, double *im, double *v);

/* Solve a x = b for nrhs right-hand sides, n x n (both overwritten, x in b); *rcond gets the reciprocal condition
 * number (may be NULL).  False when singular. */
bool nh_solve(size_t n, double *a, size_t nrhs, double *b, double *rcond);

/* Least squares min |a x - b| (m x n, rank-revealing with relative tolerance rcond); x (n x nrhs) in the head of b (ldb
 * = max(m,n)). Returns the rank, or -1 when the iteration fails. */
int nh_least_squares(size_t m, size_t n, double *a, size_t nrhs, double *b, size_t ldb, double rcond);

/* The determinant of a (n x n, overwritten), by elimination with row pivots. */
double nh_determinant(size_t n, double *a);

/* Euclidean norm, safe against overflow. */
double nh_norm(size_t count, const double *x);

/* c = a b  (m x k times k x n). */
void nh_multiply(size_t m, size_t n, size_t k, const double *a, const double *b, double *c);

/* b := b r^-1 for an upper triangle r (n x n, leading dimension ldr), b is m x n. */
void nh_solve_triangle_right(size_t m, size_t n, const double *r, size_t ldr, double *b);

/* x := r^-1 x for an upper triangle, x is n x nrhs. */
void nh_solve_triangle(size_t n, size_t nrhs, const double *r, size_t ldr, double *x, size_t ldx);

#endif

/* linalg: see the header.  The only file that includes LAPACKE and CBLAS. */
#include "base/linalg.h"

#include <cblas.h>
#include <lapacke.h>
#undef I /* lapacke.h brings in <complex.h>, whose I would clash with any variable of that name */

#include <math.h>
#include <string.h>
#include <sys/mman.h>

#include "base/budget.h"
#include "base/effort.h"
#include "base/memory.h"
#include "base/parallel.h"

/* OpenBLAS only: any other BLAS leaves the symbol unresolved, and then there is nothing to set. */
extern void openblas_set_num_threads(int count) __attribute__((weak));

enum {
    PANEL = 64,          /* columns factorised at a time, and */
    LEAF = 4,            /* those of them left to LAPACK: the fastest of several (tests/bench_nullspace.c) */
    SMALLEST_BLOCK = 64, /* rows; below it the calls cost more than the flops */
    ASIDE = 100,         /* columns, from which on the QR of a full block takes longer than to start a thread for it */
    PATIENT = 400,       /* columns: decompositions of fewer are not interrupted */
    SMALL = 32,          /* equations, as motions solve them at each step */
    SVD = 12,
    PIVOTED = 3,
    EIGEN = 20 /* times m n min(m, n) multiplications */
};

/* bytes of the buffer that OpenBLAS maps for every thread that calls it */
static const size_t BUFFER = (size_t)128 << 20;

/* units of effort: per call of LAPACK, per row, and per multiplication in small matrices */
static const double CALL = 350, ROW = 50, FLOP = 0.4;

void nh_linalg_threads(int count)
{
    if (openblas_set_num_threads) openblas_set_num_threads(count);
}

/* OpenBLAS tries for ever to map its buffer where the address space has no room.  So before the first call of a thread
 * we map and unmap a buffer of the same size ourselves. */
static void look_for_room(void)
{
    static _Thread_local bool found;
    if (found || !openblas_set_num_threads) return;
    void *room = mmap(NULL, BUFFER, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (room == MAP_FAILED) nh_memory_ended(BUFFER);
    munmap(room, BUFFER);
    found = true;
}

static size_t smaller(size_t a, size_t b) { return a < b ? a : b; }

static size_t larger(size_t a, size_t b) { return a > b ? a : b; }

/* LAPACK wants every leading dimension to be at least 1, also for empty matrices. */
static lapack_int leading(size_t rows) { return (lapack_int)larger(rows, 1); }

static double product(size_t a, size_t b, size_t c) { return (double)a * (double)b * (double)c; }

/* x - x is 0 for finite x and NaN otherwise. */
bool nh_all_finite(size_t count, const double *x)
{
    double sum = 0;
    for (size_t i = 0; i < count; i++) sum += x[i] - x[i];
    return sum == 0;
}

/* ---- streaming QR ---- */

struct nh_qr {
    size_t columns;
    size_t rows;     /* seen so far, those waiting in `block` included */
    size_t waiting;  /* rows in `block` */
    size_t capacity; /* rows `block` can hold */
    double *r;       /* columns x columns */
    double *block;   /* capacity x columns */
    /* the same: rows that are on their way into the triangle; where nothing is done aside it is the same memory */
    double *full;
    size_t filled;   /* rows in `full` */
    nh_aside *aside; /* the job that factorises `full` */
    double *t;       /* PANEL x PANEL */
    double *work;    /* PANEL x columns */
};

nh_qr *nh_qr_create(size_t columns, size_t threads)
{
    nh_qr *qr = nh_alloc(sizeof *qr);
    *qr = (nh_qr){.columns = columns, .capacity = larger(2 * columns, SMALLEST_BLOCK)};
    qr->r = nh_alloc_array(columns * columns, sizeof(double));
    qr->block = nh_alloc_array(qr->capacity * columns, sizeof(double));
    qr->full = threads > 1 && columns >= ASIDE ? nh_alloc_array(qr->capacity * columns, sizeof(double)) : qr->block;
    qr->t = nh_alloc_array(PANEL * PANEL, sizeof(double));
    qr->work = nh_alloc_array(PANEL * columns, sizeof(double));
    return qr;
}

static void await(nh_qr *qr)
{
    nh_aside_end(qr->aside);
    qr->aside = NULL;
}

void nh_qr_reset(nh_qr *qr)
{
    await(qr);
    memset(qr->r, 0, qr->columns * qr->columns * sizeof *qr->r);
    qr->rows = qr->waiting = 0;
}

void nh_qr_free(nh_qr *qr)
{
    if (!qr) return;
    await(qr);
    if (qr->full != qr->block) nh_free(qr->full);
    nh_free(qr->r);
    nh_free(qr->block);
    nh_free(qr->t);
    nh_free(qr->work);
    nh_free(qr);
}

/* With V the reflectors of panel columns first..first+count, stored in the block (on R they are the identity), and T
 * their triangle, Q^T = 1 - [1; V] T^T [1; V]^T on the columns to the right:
 *
 *     W = T^T (R_right + V^T B_right),   R_right -= W,   B_right -= V W */
static void reflect(nh_qr *qr, size_t first, size_t count, const double *t, size_t right, size_t columns)
{
    size_t n = qr->columns;
    lapack_int k = (lapack_int)count, c = (lapack_int)columns, m = (lapack_int)qr->filled,
               ld = (lapack_int)qr->capacity;
    const double *v = qr->full + first * qr->capacity;
    double *b = qr->full + right * qr->capacity, *r = qr->r + first + right * n, *w = qr->work;
    for (size_t j = 0; j < columns; j++) memcpy(w + j * count, r + j * n, count * sizeof *w);
    cblas_dgemm(CblasColMajor, CblasTrans, CblasNoTrans, k, c, m, 1.0, v, ld, b, ld, 1.0, w, k);
    cblas_dtrmm(CblasColMajor, CblasLeft, CblasUpper, CblasTrans, CblasNonUnit, k, c, 1.0, t, PANEL, w, k);
    for (size_t j = 0; j < columns; j++)
        for (size_t i = 0; i < count; i++) r[i + j * n] -= w[i + j * count];
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, m, c, k, -1.0, v, ld, w, k, 1.0, b, ld);
}

/* Reflectors of a panel, by halves: nearly all flops are then matrix products, where LAPACK's dtpqrt does matrix-vector
 * ones (13 % slower at 1000 columns).  The triangle of both halves is [T1 T12; 0 T2] with T12 = -T1 V1^T V2 T2. */
static void factorise(nh_qr *qr, size_t first, size_t count, double *t)
{
    lapack_int m = (lapack_int)qr->filled, n = (lapack_int)qr->columns, ld = (lapack_int)qr->capacity;
    double *v = qr->full + first * qr->capacity;
    if (count <= LEAF) {
        LAPACKE_dtpqrt2_work(LAPACK_COL_MAJOR, m, (lapack_int)count, 0, qr->r + first * (qr->columns + 1), n, v, ld, t,
                             PANEL);
        return;
    }
    size_t half = count / 2, rest = count - half;
    double *t2 = t + half * (PANEL + 1), *t12 = t + half * PANEL;
    factorise(qr, first, half, t);
    reflect(qr, first, half, t, first + half, rest);
    factorise(qr, first + half, rest, t2);
    lapack_int k1 = (lapack_int)half, k2 = (lapack_int)rest;
    cblas_dgemm(CblasColMajor, CblasTrans, CblasNoTrans, k1, k2, m, -1.0, v, ld, v + half * qr->capacity, ld, 0.0, t12,
                PANEL);
    cblas_dtrmm(CblasColMajor, CblasLeft, CblasUpper, CblasNoTrans, CblasNonUnit, k1, k2, 1.0, t, PANEL, t12, PANEL);
    cblas_dtrmm(CblasColMajor, CblasRight, CblasUpper, CblasNoTrans, CblasNonUnit, k1, k2, 1.0, t2, PANEL, t12, PANEL);
}

/* [R; block] = Q R', panel by panel: a reflector acts on one row of R and all rows of the block, so the zeros of R
   stay. */
static void absorb(void *context)
{
    nh_qr *qr = context;
    look_for_room();
    for (size_t first = 0; first < qr->columns; first += PANEL) {
        size_t count = smaller(PANEL, qr->columns - first), right = first + count;
        factorise(qr, first, count, qr->t);
        if (right < qr->columns) reflect(qr, first, count, qr->t, right, qr->columns - right);
    }
}

/* Factorises the waiting rows; with a second block they are exchanged for it, and the caller need not wait. */
static void flush(nh_qr *qr)
{
    await(qr);
    if (qr->waiting == 0) return;
    double *next = qr->full;
    qr->full = qr->block;
    qr->filled = qr->waiting;
    qr->block = next;
    qr->waiting = 0;
    if (qr->full == qr->block) absorb(qr);
    else qr->aside = nh_aside_begin(absorb, qr);
}

/* All rows go through the buffer, however they arrive: so the triangle is the same to the last bit for every way of
 * cutting the rows into blocks. */
void nh_qr_add(nh_qr *qr, size_t rows, double *block, size_t ld)
{
    nh_work_add(NH_WORK_DENSE, product(rows, qr->columns, qr->columns + SMALLEST_BLOCK));
    for (size_t done = 0; done < rows;) {
        size_t take = smaller(rows - done, qr->capacity - qr->waiting);
        for (size_t j = 0; j < qr->columns; j++)
            memcpy(qr->block + qr->waiting + j * qr->capacity, block + done + j * ld, take * sizeof(double));
        qr->waiting += take;
        qr->rows += take;
        done += take;
        if (qr->waiting == qr->capacity) flush(qr);
    }
}

void nh_qr_triangle(nh_qr *qr, double *r)
{
    flush(qr);
    await(qr);
    memset(r, 0, qr->columns * qr->columns * sizeof *r);
    for (size_t j = 0; j < qr->columns; j++) memcpy(r + j * qr->columns, qr->r + j * qr->columns, (j + 1) * sizeof *r);
}

size_t nh_qr_rows(const nh_qr *qr) { return qr->rows; }

/* ---- decompositions ---- */

/* One decomposition with its own memory, so that an interrupted caller can leave it to itself. */
typedef struct {
    size_t m, n;
    double *a, *s, *u, *vt;
    bool slow, ok;
} decomposition;

static void decomposition_free(void *context)
{
    decomposition *d = context;
    nh_free(d->a);
    nh_free(d->s);
    nh_free(d->u);
    nh_free(d->vt);
    nh_free(d);
}

static double *kept(size_t count, const double *a)
{
    double *copy = nh_alloc_array(count, sizeof *copy);
    if (a) memcpy(copy, a, count * sizeof *copy);
    return copy;
}

static void give(size_t count, const double *from, double *to)
{
    if (to) memcpy(to, from, count * sizeof *to);
}

/* Did LAPACK succeed?  It reports missing memory by a code of its own. */
static bool worked(lapack_int info)
{
    if (info == LAPACK_WORK_MEMORY_ERROR || info == LAPACK_TRANSPOSE_MEMORY_ERROR) nh_memory_ended(0);
    return info == 0;
}

/* dgesdd is several times faster than dgesvd, but its divide and conquer can fail where plain QR iteration does not. */
static void compute_svd(void *context)
{
    decomposition *d = context;
    look_for_room();
    char job = d->u ? 'S' : 'N';
    lapack_int rows = (lapack_int)d->m, columns = (lapack_int)d->n, ld = leading(d->m),
               ldvt = leading(smaller(d->m, d->n));
    double *superdiagonal = d->slow ? nh_alloc_array(smaller(d->m, d->n), sizeof *superdiagonal) : NULL;
    if (d->slow)
        d->ok = worked(LAPACKE_dgesvd(LAPACK_COL_MAJOR, job, job, rows, columns, d->a, ld, d->s, d->u, ld, d->vt, ldvt,
                                      superdiagonal));
    else d->ok = worked(LAPACKE_dgesdd(LAPACK_COL_MAJOR, job, rows, columns, d->a, ld, d->s, d->u, ld, d->vt, ldvt));
    nh_free(superdiagonal);
}

/* False when the caller was interrupted and left the decomposition to itself; then it no longer belongs to the
 * caller. */
static bool run(void (*compute)(void *), decomposition *d)
{
    if (smaller(d->m, d->n) >= PATIENT) return nh_interruptible(compute, decomposition_free, d);
    compute(d);
    return true;
}

bool nh_svd(size_t m, size_t n, double *a, double *s, double *u, double *vt)
{
    size_t k = smaller(m, n);
    bool ok = k == 0, sides = u || vt; /* LAPACK computes both or none */
    if (!nh_all_finite(m * n, a)) return false;
    nh_work_add(NH_WORK_DENSE, SVD * product(m, n, k));
    for (int slow = 0; slow < 2 && !ok; slow++) {
        decomposition *d = nh_alloc(sizeof *d);
        *d = (decomposition){.m = m,
                             .n = n,
                             .a = kept(m * n, a),
                             .s = kept(k, NULL),
                             .u = sides ? kept(m * k, NULL) : NULL,
                             .vt = sides ? kept(k * n, NULL) : NULL,
                             .slow = slow};
        if (!run(compute_svd, d)) return false;
        give(k, d->s, s);
        give(m * k, d->u, u);
        give(k * n, d->vt, vt);
        ok = d->ok;
        decomposition_free(d);
    }
    return ok;
}

bool nh_eigen(size_t n, double *a, double *re, double *im, double *v)
{
    if (n == 0) return true;
    if (!nh_all_finite(n * n, a)) return false;
    nh_work_add(NH_WORK_DENSE, EIGEN * product(n, n, n));
    lapack_int size = (lapack_int)n;
    look_for_room();
    return worked(LAPACKE_dgeev(LAPACK_COL_MAJOR, 'N', v ? 'V' : 'N', size, a, size, re, im, NULL, size, v, size));
}

/* ---- equations ---- */

bool nh_solve(size_t n, double *a, size_t nrhs, double *b, double *rcond)
{
    if (rcond) *rcond = n == 0;
    if (n == 0) return true;
    if (!nh_all_finite(n * n, a) || !nh_all_finite(n * nrhs, b)) return false;
    look_for_room();
    nh_work_add(NH_WORK_DENSE, product(n, n, n + nrhs));
    nh_effort_add(CALL + ROW * (double)n + FLOP * product(n, n, n + nrhs));
    lapack_int size = (lapack_int)n;
    lapack_int few[SMALL], *swap = n > SMALL ? nh_alloc_array(n, sizeof *swap) : few;
    /* _work: without the search for NaN, which is made above */
    double norm = rcond ? LAPACKE_dlange_work(LAPACK_COL_MAJOR, '1', size, size, a, size, NULL) : 0;
    lapack_int info = LAPACKE_dgesv_work(LAPACK_COL_MAJOR, size, (lapack_int)nrhs, a, size, swap, b, size);
    if (info == 0 && rcond) info = LAPACKE_dgecon(LAPACK_COL_MAJOR, '1', size, a, size, norm, rcond);
    if (swap != few) nh_free(swap);
    return worked(info);
}

/* dgelsy: rank by pivoted QR with a condition estimate; the solution of least norm.  It does not iterate. */
int nh_least_squares(size_t m, size_t n, double *a, size_t nrhs, double *b, size_t ldb, double rcond)
{
    if (!nh_all_finite(m * n, a)) return -1;
    for (size_t j = 0; j < nrhs; j++)
        if (!nh_all_finite(m, b + j * ldb)) return -1;
    if (m == 0 || n == 0) {
        for (size_t j = 0; j < nrhs; j++) memset(b + j * ldb, 0, n * sizeof *b);
        return 0;
    }
    nh_work_add(NH_WORK_DENSE, PIVOTED * product(m, n, smaller(m, n)));
    look_for_room();
    nh_effort_add(PIVOTED * (CALL + ROW * (double)n + FLOP * product(m, n, smaller(m, n))));
    lapack_int rank = -1;
    lapack_int *order = nh_alloc_array(n, sizeof *order);
    for (size_t j = 0; j < nrhs && m < n; j++)
        memset(b + m + j * ldb, 0, (n - m) * sizeof *b); /* read by LAPACKE's check for NaN, otherwise only written */
    lapack_int info = LAPACKE_dgelsy(LAPACK_COL_MAJOR, (lapack_int)m, (lapack_int)n, (lapack_int)nrhs, a, (lapack_int)m,
                                     b, (lapack_int)ldb, order, rcond, &rank);
    nh_free(order);
    return worked(info) ? (int)rank : -1;
}

/* ---- products ---- */

void nh_multiply(size_t m, size_t n, size_t k, const double *a, const double *b, double *c)
{
    if (k == 0) memset(c, 0, m * n * sizeof *c);
    if (m == 0 || n == 0 || k == 0) return;
    nh_work_add(NH_WORK_DENSE, product(m, n, k));
    look_for_room();
    lapack_int rows = (lapack_int)m, columns = (lapack_int)n, inner = (lapack_int)k;
    /* dgemm would copy the whole matrix for one vector */
    if (n == 1) cblas_dgemv(CblasColMajor, CblasNoTrans, rows, inner, 1.0, a, rows, b, 1, 0.0, c, 1);
    else if (m == 1) cblas_dgemv(CblasColMajor, CblasTrans, inner, columns, 1.0, b, inner, a, 1, 0.0, c, 1);
    else
        cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, rows, columns, inner, 1.0, a, rows, b, inner, 0.0, c,
                    rows);
}

void nh_solve_triangle_right(size_t m, size_t n, const double *r, size_t ldr, double *b)
{
    if (m == 0 || n == 0) return;
    nh_work_add(NH_WORK_DENSE, product(m, n, n) / 2);
    look_for_room();
    cblas_dtrsm(CblasColMajor, CblasRight, CblasUpper, CblasNoTrans, CblasNonUnit, (lapack_int)m, (lapack_int)n, 1.0, r,
                (lapack_int)ldr, b, (lapack_int)m);
}

void nh_solve_triangle(size_t n, size_t nrhs, const double *r, size_t ldr, double *x, size_t ldx)
{
    if (n == 0 || nrhs == 0) return;
    nh_work_add(NH_WORK_DENSE, product(n, n, nrhs) / 2);
    look_for_room();
    cblas_dtrsm(CblasColMajor, CblasLeft, CblasUpper, CblasNoTrans, CblasNonUnit, (lapack_int)n, (lapack_int)nrhs, 1.0,
                r, (lapack_int)ldr, x, (lapack_int)ldx);
}

double nh_determinant(size_t n, double *a)
{
    double det = 1;
    for (size_t k = 0; k < n; k++) {
        size_t best = k;
        for (size_t i = k + 1; i < n; i++)
            if (fabs(a[i + k * n]) > fabs(a[best + k * n])) best = i;
        if (a[best + k * n] == 0) return 0;
        for (size_t j = 0; j < n && best != k; j++) {
            double x = a[k + j * n];
            a[k + j * n] = a[best + j * n];
            a[best + j * n] = x;
        }
        if (best != k) det = -det;
        det *= a[k + k * n];
        for (size_t i = k + 1; i < n; i++)
            for (size_t j = n; j-- > k;) a[i + j * n] -= a[i + k * n] / a[k + k * n] * a[k + j * n];
    }
    return det;
}

double nh_norm(size_t count, const double *x)
{
    double largest = 0, sum = 0;
    for (size_t i = 0; i < count; i++) largest = fmax(largest, fabs(x[i]));
    if (largest == 0) return 0;
    for (size_t i = 0; i < count; i++) sum += x[i] / largest * (x[i] / largest);
    return largest * sqrt(sum);
}

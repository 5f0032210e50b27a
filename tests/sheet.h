/* sheet: the values of all geometric quantities of a model at one point, and Omega computed from them a second time.
 *
 * Omega is taken from the gradients of p_s and E by the coordinate-free formula, term by term, so that the size of the terms is known:
 * what should vanish must vanish in comparison with them. */
#ifndef NH_TESTS_SHEET_H
#define NH_TESTS_SHEET_H

#include "mechanics.h"

#include "graph/diff.h"

typedef struct {
    const nh_model *model;
    size_t m, n, k, width; /* width = 1 + m + n: components of a field */
    nh_tape *tape;
    nh_tape_work *work;
    double *value, *field; /* field: scratch */
    const double *rho, *R, *p, *pbar, *dL, *dp, *dE, *M, *A, *G, *a, *mu, *nu, *reaction, *Q, *Lq, *Lt;
} sheet;

/* Q_s, dL/dq^s, dL/dt composed, and dLbar/dw^i. */
static inline void sheet_forces(const nh_model *o, nh_ex *Q, nh_ex *Lq, nh_ex *Lt, nh_ex *dL)
{
    const nh_system *y = o->system;
    *Lt = nh_model_compose(o, nh_diff(o->dag, y->lagrangian, y->t));
    for (size_t s = 0; s < o->m; s++) {
        Q[s] = nh_model_compose(o, y->force[s]);
        Lq[s] = nh_model_compose(o, nh_diff(o->dag, y->lagrangian, y->coordinate[s].q));
    }
    for (size_t i = 0; i < o->n; i++) dL[i] = nh_diff(o->dag, o->Lbar, o->chart->w[i]);
}

static inline sheet *sheet_of(const nh_model *o)
{
    size_t m = o->m, n = o->n, k = o->k, width = 1 + m + n, total = 0;
    sheet *s = nh_alloc(sizeof *s);
    *s = (sheet){.model = o, .m = m, .n = n, .k = k, .width = width, .field = nh_alloc_array(width, sizeof(double))};
    nh_ex *own = nh_alloc_array((m + 1) * width + 2 * m + n + 1, sizeof *own);
    nh_ex *dp = own, *dE = dp + m * width, *Q = dE + width, *Lq = Q + m, *Lt = Lq + m, *dL = Lt + 1;
    for (size_t j = 0; j < width; j++) {
        for (size_t i = 0; i < m; i++) dp[i * width + j] = nh_diff(o->dag, o->p[i], o->chart->symbol[j]);
        dE[j] = nh_diff(o->dag, o->E, o->chart->symbol[j]);
    }
    sheet_forces(o, Q, Lq, Lt, dL);
    const double **place[] = {&s->rho, &s->R, &s->p, &s->pbar, &s->dL, &s->dp, &s->dE, &s->M, &s->A, &s->G, &s->a, &s->mu, &s->nu, &s->reaction, &s->Q,
                              &s->Lq, &s->Lt};
    const nh_ex *from[] = {o->rho, o->R, o->p, o->pbar, dL, dp, dE, o->M, o->A, nh_model_G(o), o->a, o->mu, o->nu, o->reaction, Q, Lq, Lt};
    const size_t count[] = {m, m * n, m, n, n, m * width, width, n * n, n, n * n, n, k, k * m, m, m, m, 1};
    const size_t parts = sizeof count / sizeof *count;
    for (size_t i = 0; i < parts; i++) total += count[i];
    nh_ex *e = nh_alloc_array(total, sizeof *e);
    s->value = nh_alloc_array(total, sizeof *s->value);
    for (size_t i = 0, at = 0; i < parts; at += count[i++]) {
        if (count[i]) memcpy(e + at, from[i], count[i] * sizeof *e);
        *place[i] = s->value + at;
    }
    s->tape = nh_model_tape(o, total, e);
    s->work = nh_tape_work_create(s->tape);
    nh_free(e);
    nh_free(own);
    return s;
}

static inline void sheet_free(sheet *s)
{
    nh_tape_work_free(s->work);
    nh_tape_free(s->tape);
    nh_free(s->value);
    nh_free(s->field);
    nh_free(s);
}

static inline void sheet_at(sheet *s, const double *z)
{
    nh_tape_eval(s->tape, s->work, z, s->value);
}

/* Components (dt, dq, dw) of X_0 (kind 0), X_i (1..n), Y_i (n+1..2n), Gamma (2n+1). */
static inline void sheet_field(const sheet *s, size_t kind, double *f)
{
    memset(f, 0, s->width * sizeof *f);
    bool gamma = kind == 2 * s->n + 1, time = kind == 0 || gamma;
    f[0] = time;
    for (size_t q = 0; q < s->m; q++)
        if (time || kind <= s->n) f[1 + q] = time ? s->rho[q] : s->R[q * s->n + kind - 1];
    for (size_t i = 0; i < s->n; i++) f[1 + s->m + i] = gamma ? s->a[i] : kind == s->n + 1 + i;
}

/* The derivative of a function along a field; `size` grows by the magnitudes of its terms. */
static inline double sheet_along(const sheet *s, const double *f, const double *gradient, double factor, double *size)
{
    double sum = 0;
    for (size_t j = 0; j < s->width; j++) {
        double term = f[j] * gradient[j] * factor;
        sum += term;
        *size += fabs(term);
    }
    return sum;
}

/* Omega(A,B) = A(p_s) B^s - B(p_s) A^s - A(E) B^0 + B(E) A^0 */
static inline double sheet_omega(const sheet *s, const double *a, const double *b, double *size)
{
    *size = 0;
    double sum = sheet_along(s, b, s->dE, a[0], size) + sheet_along(s, a, s->dE, -b[0], size);
    for (size_t q = 0; q < s->m; q++)
        sum += sheet_along(s, a, s->dp + q * s->width, b[1 + q], size) + sheet_along(s, b, s->dp + q * s->width, -a[1 + q], size);
    return sum;
}

#endif

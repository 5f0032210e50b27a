/* Every identity of the geometry: the general formulas of Omega and Gamma against the closed forms that the program uses.
 *
 * Omega is computed here a second time, from numerical gradients of p_s and E and the coordinate-free formula, term by term, so that
 * the size of the terms is known: what should vanish must vanish to 1e-12 of them. */
#include "mechanics.h"

#include "expr/diff.h"
#include "expr/normal.h"
#include "geometry/distribution.h"

static const double TIGHT = 1e-12;

/* ---- values of everything at one point ---- */

typedef struct {
    const nh_model *model;
    size_t m, n, k, width; /* width = 1 + m + n: components of a field */
    nh_tape *tape;
    nh_tape_work *work;
    double *value;
    const double *rho, *R, *p, *pbar, *dL, *E, *dp, *dE, *M, *A, *G, *a, *mu, *nu, *reaction, *Q, *Lq, *Lt;
} sheet;

typedef struct {
    nh_ex e[2000];
    size_t count;
} list;

static const double *add(list *l, sheet *s, size_t count, const nh_ex *e)
{
    size_t at = l->count;
    cr_assert_lt(at + count, sizeof l->e / sizeof *l->e);
    if (count) memcpy(l->e + at, e, count * sizeof *e);
    l->count += count;
    return (const double *)s + at; /* an offset until `value` is there */
}

static void gradients(const nh_model *o, size_t count, const nh_ex *e, nh_ex *out)
{
    size_t width = 1 + o->m + o->n;
    for (size_t s = 0; s < count; s++)
        for (size_t j = 0; j < width; j++) out[s * width + j] = nh_diff(o->dag, e[s], o->chart->symbol[j]);
}

static void applied(const nh_model *o, nh_ex *Q, nh_ex *Lq, nh_ex *Lt, nh_ex *dL)
{
    const nh_system *y = o->system;
    *Lt = nh_model_compose(o, nh_diff(o->dag, y->lagrangian, y->t));
    for (size_t s = 0; s < o->m; s++) {
        Q[s] = nh_model_compose(o, y->force[s]);
        Lq[s] = nh_model_compose(o, nh_diff(o->dag, y->lagrangian, y->coordinate[s].q));
    }
    for (size_t i = 0; i < o->n; i++) dL[i] = nh_diff(o->dag, o->Lbar, o->chart->w[i]);
}

static sheet *sheet_of(const nh_model *o)
{
    static list l;
    size_t m = o->m, n = o->n, width = 1 + m + n;
    sheet *s = nh_alloc(sizeof *s);
    nh_ex *x = nh_alloc_array((m + 1) * width + 2 * m + n + 1, sizeof *x), *dp = x, *dE = dp + m * width, *Q = dE + width, *Lq = Q + m, *Lt = Lq + m,
          *dL = Lt + 1;
    *s = (sheet){.model = o, .m = m, .n = n, .k = o->k, .width = width};
    l.count = 0;
    gradients(o, m, o->p, dp);
    gradients(o, 1, &o->E, dE);
    applied(o, Q, Lq, Lt, dL);
    const double **place[] = {&s->rho, &s->R, &s->p, &s->pbar, &s->dL, &s->E, &s->dp, &s->dE, &s->M, &s->A, &s->G, &s->a, &s->mu, &s->nu, &s->reaction,
                              &s->Q, &s->Lq, &s->Lt};
    const nh_ex *from[] = {o->rho, o->R, o->p, o->pbar, dL, &o->E, dp, dE, o->M, o->A, o->G, o->a, o->mu, o->nu, o->reaction, Q, Lq, Lt};
    size_t count[] = {m, m * n, m, n, n, 1, m * width, width, n * n, n, n * n, n, o->k, o->k * m, m, m, m, 1}, parts = sizeof count / sizeof *count, at = 0;
    for (size_t i = 0; i < parts; i++) add(&l, s, count[i], from[i]);
    s->tape = nh_model_tape(o, l.count, l.e);
    s->work = nh_tape_work_create(s->tape);
    s->value = nh_alloc_array(l.count, sizeof *s->value);
    for (size_t i = 0; i < parts; at += count[i++]) *place[i] = s->value + at;
    nh_free(x);
    return s;
}

static void sheet_free(sheet *s)
{
    nh_tape_work_free(s->work);
    nh_tape_free(s->tape);
    nh_free(s->value);
    nh_free(s);
}

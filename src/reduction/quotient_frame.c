/* quotient_frame: motions on the quotient in the frame of a slice (quotient.h). */
#include <string.h>

#include "base/linalg.h"
#include "graph/diff.h"
#include "geometry/bordered.h"
#include "graph/dag.h"
#include "graph/node.h"
#include "reduction/quotient.h"

struct nh_frame_motion {
    const nh_slice *slice;
    nh_bordered *bordered;
    nh_tape *tape; /* generators and their derivatives: e_a^s, then d_r e_a^s */
    nh_tape_work *work;
    double *e, *q, *v, *a, *frame;
};

/* Fr u' into F. */
static bool force(void *context, double t, const double *x, const double *u, double *F)
{
    nh_frame_motion *f = context;
    const nh_slice *s = f->slice;
    size_t m = s->m, n = s->n, d = s->d;
    const double *zeta = u + n, *slope = f->e + m * d;
    nh_slice_place(s, x, f->q);
    nh_tape_eval(f->tape, f->work, f->q, f->e);
    memset(f->frame, 0, m * m * sizeof *f->frame);
    memset(f->v, 0, m * sizeof *f->v);
    for (size_t i = 0; i < n; i++) f->frame[s->shape[i] + i * m] = 1;
    memcpy(f->frame + n * m, f->e, m * d * sizeof *f->e);
    nh_multiply(m, 1, m, f->frame, u, f->v);
    if (!nh_bordered_accelerations(f->bordered, t, f->q, f->v, f->a)) return false;
    for (size_t a = 0; a < d; a++)
        for (size_t i = 0; i < m; i++) {
            double along = 0;
            for (size_t j = 0; j < n; j++) along += u[j] * slope[(a * m + i) * m + s->shape[j]];
            for (size_t r = 0; r < m; r++) along += f->v[r] * slope[(a * m + i) * m + r];
            f->a[i] -= zeta[a] * along;
        }
    memcpy(F, f->a, m * sizeof *F);
    return nh_solve(m, f->frame, 1, F, NULL);
}

/* v . dL/dv - L at v = Fr u on the slice. */
static nh_ex energy(const nh_model *model, const nh_slice *s, const nh_ex *u)
{
    nh_dag *d = model->dag;
    const nh_kinetic *k = s->kinetic;
    nh_ex L = model->system->lagrangian, sum = nh_neg(d, L),
          *from = nh_alloc_array(2 * (s->m + s->d) + 1, sizeof *from), *to = from + s->m + s->d;
    for (size_t i = 0; i < s->m; i++) sum = nh_add(d, sum, nh_mul(d, k->v[i], nh_diff(d, L, k->v[i])));
    for (size_t i = 0; i < s->m; i++) {
        from[i] = k->v[i];
        to[i] = nh_int(d, 0);
        for (size_t a = 0; a < s->d; a++)
            if (!nh_is_zero(d, s->E[i * s->d + a]))
                to[i] = nh_add(d, to[i], nh_mul(d, s->E[i * s->d + a], u[s->n + a]));
    }
    for (size_t i = 0; i < s->n; i++) to[s->shape[i]] = nh_add(d, to[s->shape[i]], u[i]);
    for (size_t a = 0; a < s->d; a++) from[s->m + a] = k->q[s->along[a]], to[s->m + a] = s->y[a];
    sum = nh_substitute(d, sum, s->m + s->d, from, to);
    nh_free(from);
    return sum;
}

nh_frame_motion *nh_frame_motion_create(nh_reduced *out, const nh_model *model, const nh_slice *s)
{
    const nh_kinetic *k = s->kinetic;
    size_t m = s->m, d = s->d, n = s->n;
    nh_frame_motion *f = nh_alloc(sizeof *f);
    nh_ex *e = nh_alloc_array(m * d * (1 + m) + 1, sizeof *e);
    for (size_t a = 0; a < d; a++)
        for (size_t i = 0; i < m; i++) {
            e[a * m + i] = s->action->generator[a].component[i];
            for (size_t r = 0; r < m; r++) e[m * d + (a * m + i) * m + r] = nh_diff(model->dag, e[a * m + i], k->q[r]);
        }
    *f = (nh_frame_motion){
        .slice = s, .bordered = nh_bordered_create(model), .tape = nh_kinetic_tape(k, m * d * (1 + m), e)};
    f->work = nh_tape_work_create(f->tape);
    f->e = nh_alloc_array(m * d * (1 + m) + 3 * m + m * m + 1, sizeof *f->e);
    f->q = f->e + m * d * (1 + m);
    f->v = f->q + m;
    f->a = f->v + m;
    f->frame = f->a + m;
    nh_reduced_init(out, k, n, s->x, m, d);
    for (size_t i = 0; i < m; i++) {
        out->w[i] = nh_symbol_fresh(model->dag, "u");
        out->momentum[i] = nh_name_of(model->dag, out->w[i]);
        out->M[i * (m + 1)] = nh_int(model->dag, 1);
        if (i < n) out->dx[i] = out->w[i];
        else out->zeta[i - n] = out->w[i];
    }
    out->plain = true;
    out->force = force;
    out->context = f;
    out->energy = energy(model, s, out->w);
    out->t = model->system->t;
    out->timed = nh_depends(model->dag, out->energy, out->t);
    nh_reduced_guard_slice(out, s);
    nh_free(e);
    return f;
}

void nh_frame_motion_free(nh_frame_motion *f)
{
    if (!f) return;
    nh_bordered_free(f->bordered);
    nh_tape_work_free(f->work);
    nh_tape_free(f->tape);
    nh_free(f->e);
    nh_free(f);
}

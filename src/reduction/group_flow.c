#include "reduction/group_flow.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "base/memory.h"
#include "reduction/subspace.h"

/* Where the generators do not depend on the shape coordinates, T g d/dx^i = d/dx^i, and the place follows the equation
 * q' = x'^i d/dx^i + (Ad_g zeta)^a e_a(q), which stays on the path of the motion: the flows of the factors take other
 * paths, perhaps around a pole of the coordinates. */
static bool independent_of_shape(const nh_slice *s)
{
    const nh_kinetic *k = s->kinetic;
    for (size_t a = 0; a < s->d; a++)
        for (size_t r = 0; r < s->m; r++)
            for (size_t i = 0; i < s->n; i++)
                if (nh_depends(k->dag, s->action->generator[a].component[r], s->x[i])) return false;
    return true;
}

/* Is A^3 = lambda A?  So it is for translations and for rotations, boosts too, in the bases that are usual. */
static void find_cubic(nh_group_flow *f, size_t a)
{
    static const double rounding = 1e-15;
    size_t d = f->d, n = d * d, most = 0;
    const double *A = f->ad + a * n;
    double *square = f->square + a * n, *cube = f->next, off = 0, size = nh_largest(n, A);
    nh_multiply(d, d, d, A, A, square);
    nh_multiply(d, d, d, A, square, cube);
    for (size_t i = 0; i < n; i++)
        if (fabs(A[i]) > fabs(A[most])) most = i;
    f->lambda[a] = size > 0 ? cube[most] / A[most] : 0;
    for (size_t i = 0; i < n; i++) off = fmax(off, fabs(cube[i] - f->lambda[a] * A[i]));
    if (fabs(f->lambda[a]) <= rounding * size * size) f->lambda[a] = 0;
    f->cubic[a] = off <= rounding * size * size * size;
}

/* exp(t ad_a) into f->E: 1 + S ad_a + C ad_a^2 with S = sin(wt)/w, C = (1 - cos(wt))/w^2 for lambda = -w^2, and so on;
   else by scaling and squaring. */
static void exponential(nh_group_flow *f, size_t a, double t)
{
    size_t d = f->d, n = d * d;
    const double *A = f->ad + a * n, *square = f->square + a * n;
    if (!f->cubic[a]) {
        for (size_t i = 0; i < n; i++) f->next[i] = t * A[i];
        nh_matrix_exp(d, f->next, f->E);
        return;
    }
    double w = sqrt(fabs(f->lambda[a])), half = t / 2, S = t, C = half * t;
    if (f->lambda[a] < 0) S = sin(w * t) / w, C = 2 * pow(sin(w * half) / w, 2);
    if (f->lambda[a] > 0) S = sinh(w * t) / w, C = 2 * pow(sinh(w * half) / w, 2);
    for (size_t i = 0; i < n; i++) f->E[i] = (i % (d + 1) == 0) + S * A[i] + C * square[i];
}

void nh_group_flow_factors(nh_group_flow *f, const double *t)
{
    size_t d = f->d;
    for (size_t i = 0; i < d * d; i++) f->P[i] = i % (d + 1) == 0;
    for (size_t a = 0; a < d; a++) {
        memcpy(f->M + a * d, f->P + a * d, d * sizeof *f->M);
        if (!f->acts[a] || t[a] == 0) continue;
        exponential(f, a, t[a]);
        nh_multiply(d, d, d, f->P, f->E, f->next);
        memcpy(f->P, f->next, d * d * sizeof *f->P);
    }
}

/* rate: x', and from `inner` on Ad_h zeta of the present factor. */
static void place_rate(nh_group_flow *f, const double *q, double *rate)
{
    const nh_slice *s = f->chart->slice;
    double *out = rate + f->inner + f->d;
    nh_multiply(f->d, 1, f->d, f->before, rate + f->inner, f->spatial);
    nh_tape_eval(f->field, f->field_work, q, f->e);
    memset(out, 0, s->m * sizeof *out);
    for (size_t i = 0; i < s->n; i++) out[s->shape[i]] = rate[i];
    for (size_t a = 0; a < f->d; a++)
        for (size_t r = 0; r < s->m; r++) out[r] += f->spatial[a] * f->e[r + a * s->m];
}

bool nh_group_flow_rate(double time, const double *z, double *rate, void *context)
{
    nh_group_flow *f = context;
    size_t d = f->d;
    nh_reduced_flow_time(f->chart->flow, time);
    if (!nh_reduced_flow_at(f->chart->flow, z, rate, NULL, f->zeta, NULL)) return false;
    if (!f->group) return true;
    nh_group_flow_factors(f, z + f->inner);
    nh_multiply(d, 1, d, f->P, f->zeta, rate + f->inner);
    if (f->direct) place_rate(f, z + f->inner + d, rate);
    return f->abelian || nh_solve(d, f->M, 1, rate + f->inner, NULL);
}

/* The largest entry of M in units of the group's coordinates. */
static double largest_entry(const nh_group_flow *f)
{
    double most = 0;
    for (size_t i = 0; i < f->d * f->d; i++) most = fmax(most, fabs(f->M[i]) * f->unit[i / f->d] / f->unit[i % f->d]);
    return most;
}

/* det M does not depend on the basis of the Lie algebra, and vanishes where the coordinates of the second kind are
 * singular (cos t_2 of a rotation).  Where it is far from zero large entries, of translations above all, cost digits
 * only. */
bool nh_group_flow_guard(double time, const double *z, double *value, void *context)
{
    (void)time;
    static const double least = 0.2, most = 30;
    nh_group_flow *f = context;
    if (!nh_reduced_flow_guards(f->chart->flow, z, value)) return false;
    if (!f->d || !f->group) return true;
    value[2] = 1;
    if (f->abelian) return true;
    nh_group_flow_factors(f, z + f->inner);
    double large = 1 - largest_entry(f) / most, det = fabs(nh_determinant(f->d, f->M));
    value[2] = fmin(fmin(det, 1 / det) - least, large);
    return isfinite(value[2]);
}

/* unit_a = 1 / max |e_a^s| / size_s over sample points. */
static void find_units(nh_group_flow *f)
{
    enum { most_places = 8 };
    const nh_kinetic *k = f->action->kinetic;
    size_t m = f->m, places = k->places < most_places ? k->places : most_places;
    double *size = nh_alloc_array(m + 1, sizeof *size);
    nh_kinetic_sizes(k, places, size);
    for (size_t p = 0; p < places; p++) {
        nh_tape_eval(f->field, f->field_work, k->place + p * m, f->e);
        for (size_t i = 0; i < m * f->d; i++)
            if (isfinite(f->e[i])) f->unit[i / m] = fmax(f->unit[i / m], fabs(f->e[i]) / size[i % m]);
    }
    for (size_t a = 0; a < f->d; a++) f->unit[a] = f->unit[a] > 0 ? 1 / f->unit[a] : 1;
    nh_free(size);
}

void nh_group_flow_init(nh_group_flow *f, const nh_action *action, bool group)
{
    const nh_algebra *g = &action->algebra;
    size_t d = g->d, m = action->kinetic->m;
    *f = (nh_group_flow){.action = action, .group = group, .abelian = true, .d = d, .m = m};
    f->ad = nh_alloc_array(2 * d * d * d + 4 * d * d + 2 * d + 1, sizeof *f->ad);
    f->square = f->ad + d * d * d;
    f->lambda = f->square + d * d * d;
    f->M = f->lambda + d;
    f->P = f->M + d * d;
    f->E = f->P + d * d;
    f->next = f->E + d * d;
    f->zeta = f->next + d * d;
    f->acts = nh_alloc_array(2 * d + 1, sizeof *f->acts);
    f->cubic = f->acts + d;
    for (size_t a = 0; a < d; a++) {
        for (size_t i = 0; i < d; i++) f->zeta[i] = i == a;
        nh_algebra_ad(g, f->zeta, f->ad + a * d * d);
        f->acts[a] = nh_largest(d * d, f->ad + a * d * d) > 0;
        f->abelian &= !f->acts[a];
        find_cubic(f, a);
    }
    nh_ex *e = nh_alloc_array(m * d + 1, sizeof *e);
    for (size_t a = 0; a < d; a++) memcpy(e + a * m, action->generator[a].component, m * sizeof *e);
    f->field = nh_kinetic_tape(action->kinetic, m * d, e);
    f->field_work = nh_tape_work_create(f->field);
    f->e = nh_alloc_array(m * d + d * d + 2 * d + 1, sizeof *f->e);
    f->before = f->e + m * d;
    f->spatial = f->before + d * d;
    f->unit = f->spatial + d;
    find_units(f);
    for (size_t i = 0; i < d * d; i++) f->before[i] = i % (d + 1) == 0;
    nh_free(e);
}

void nh_group_flow_chart(nh_group_flow *f, const nh_reduced_chart *chart)
{
    f->chart = chart;
    f->inner = chart->reduced->n + chart->reduced->r;
    f->direct = f->group && independent_of_shape(chart->slice);
}

void nh_group_flow_clear(nh_group_flow *f)
{
    nh_tape_work_free(f->field_work);
    nh_tape_free(f->field);
    nh_free(f->e);
    nh_free(f->ad);
    nh_free(f->acts);
}

size_t nh_group_flow_size(const nh_group_flow *f) { return f->inner + (f->group ? f->d + (f->direct ? f->m : 0) : 0); }

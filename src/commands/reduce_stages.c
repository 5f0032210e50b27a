/* reduce_stages: which reductions a system allows, carried out, and their motions against the full one. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/linalg.h"
#include "base/progress.h"
#include "motion/automatic.h"
#include "reduction/density.h"
#include "reduction/reach.h"
#include "reduction/subspace.h"
#include "commands/reduce_internal.h"
#include "graph/dag.h"
#include "graph/function.h"

/* ---- a stage ---- */

static char *name_of(nh_reduction *r, const nh_action *action)
{
    nh_group *g = nh_group_of(action->kinetic, action->d, action->generator, &r->options);
    char *name = nh_strdup(g->name);
    nh_group_free(g);
    return name;
}

/* The slice through a place, and the one that is shown: y = 0 where that is regular. */
void nh_reduction_make_slices(nh_reduction *r, const nh_action *action, const double *q, nh_slice **through,
                              nh_slice **shown)
{
    size_t m = action->kinetic->m, d = action->d, *shape = nh_arena_alloc(r->arena, (m + 1) * sizeof *shape),
           *along = shape + (m - d);
    double *y = nh_alloc_array(d + 1, sizeof *y), *zero = nh_alloc_array(d + 1, sizeof *zero);
    nh_slice_choose(action, shape, along);
    bool same = true;
    for (size_t a = 0; a < d; a++) same &= (y[a] = q[along[a]]) == 0;
    size_t which = action == &r->action[0] ? 0 : 1;
    *through = nh_arena_alloc(r->arena, sizeof **through);
    *shown = nh_arena_alloc(r->arena, sizeof **shown);
    nh_slice_init(*through, action, shape, along, y);
    if (r->brief && r->kept[which]) **shown = *r->kept[which];
    else if (!same && nh_slice_nice(action, along, zero)) nh_slice_init(*shown, action, shape, along, zero);
    else **shown = **through;
    if (!r->brief && (*shown)->K != (*through)->K) r->kept[which] = *shown;
    nh_free(y);
    nh_free(zero);
}

nh_reduction_stage *nh_reduction_new_stage(nh_reduction *r, nh_stage_kind kind, const nh_action *action)
{
    nh_reduction_stage *s = &r->stage[r->stages++];
    bool local = false;
    for (size_t a = 0; a < action->d; a++) local |= action->generator[a].local;
    *s = (nh_reduction_stage){.local = local,
                              .kind = kind,
                              .action = action,
                              .group = name_of(r, action),
                              .against_full = true,
                              .linear_drift = -1,
                              .energy_drift = -1,
                              .momentum_drift = -1};
    return s;
}

/* ---- Chaplygin ---- */

static const nh_chaplygin *chaplygin_on(nh_reduction *r, const nh_slice *slice, nh_error *error)
{
    nh_chaplygin *c = nh_arena_alloc(r->arena, sizeof *c);
    return nh_chaplygin_init(c, slice, error) ? c : NULL;
}

/* Existence is tested on the slice through the initial state, the closed form found on the one that is shown. */
static nh_chaplygin_measure measure_of(const nh_reduction *r, const nh_slice *slice, const nh_ex *K, const nh_ex *U,
                                       const nh_slice *shown, const nh_ex *Ks, const nh_ex *Us)
{
    nh_chaplygin_measure m = nh_chaplygin_measure_of(slice, K, U, shown, Ks, Us, &r->options);
    if (m.tested && m.measure && m.size > 0)
        m.closed = nh_density_find(shown, Ks, Us, &r->options, &m.density, &m.proof);
    nh_ex size = m.closed ? nh_call(shown->dag, NH_ABS, m.density) : 0; /* its sign does not matter */
    if (m.closed) m.local = nh_kinetic_many_valued(shown->kinetic, 1, &size);
    return m;
}

/* Where the values show that there is none: for which parameters there would be one. */
static void conditions_of(nh_reduction *r, nh_reduction_stage *s, const nh_slice *shown, const nh_ex *K, const nh_ex *U)
{
    const nh_chaplygin_measure *m = &s->measure;
    if (m->tested && !(m->measure && m->factor) && r->system->parameters &&
        !nh_reduction_late(r, "conditions for a measure"))
        s->conditions = nh_measure_conditions_of(r->arena, shown, K, U);
}

static bool chaplygin_stage(nh_reduction_bench *b, const nh_action *action, const nh_chaplygin **through,
                            nh_error *error)
{
    nh_reduction *r = b->r;
    nh_slice *slice, *shown;
    size_t m = r->kinetic->m;
    nh_reduction_make_slices(r, action, r->initial.q, &slice, &shown);
    nh_error ignored = {0};
    const nh_chaplygin *c = *through = chaplygin_on(r, slice, error), *pretty = slice->K == shown->K ? c
                                                                                : r->brief && r->kept_chaplygin
                                                                                    ? r->kept_chaplygin
                                                                                    : chaplygin_on(r, shown, &ignored);
    nh_error_clear(&ignored);
    if (!c) return false;
    if (!pretty) pretty = c; /* the slice through the initial state then */
    if (pretty != c) r->kept_chaplygin = pretty;
    nh_reduction_stage *s = nh_reduction_new_stage(r, NH_STAGE_CHAPLYGIN, action);
    s->slice = slice;
    s->reduced = &c->reduced;
    s->shown = &pretty->reduced;
    s->shown_slice = pretty->slice;
    s->chaplygin = pretty;
    if (!r->brief && c->plain) s->measure = measure_of(r, slice, c->K, c->U, pretty->slice, pretty->K, pretty->U);
    conditions_of(r, s, pretty->slice, pretty->K, pretty->U);
    nh_atlas *atlas = nh_atlas_create(action, true);
    size_t *independent = nh_arena_alloc(r->arena, (m + 1) * sizeof *independent);
    for (size_t i = 0; i < slice->n; i++) independent[i] = i;
    nh_atlas_add(atlas, slice, &c->reduced, independent, NULL);
    if (pretty != c) {
        nh_atlas_add(atlas, pretty->slice, &pretty->reduced, independent, NULL);
        nh_atlas_prefer(atlas);
    }
    nh_reduction_compare_full(b, s, atlas);
    return true;
}

/* ---- the second stage ---- */

/* Of n combinations t of the generators (d x n) those that satisfy (ii), and of these a group that acts freely on the
 * shape space, as fields on Q; used: the generators that occur in the former. */
static size_t second_fields(nh_reduction *r, const nh_chaplygin *first, size_t n, const double *t, nh_ex *field,
                            bool *used)
{
    const nh_action *g = &r->group->action;
    nh_dag *d = r->kinetic->dag;
    size_t m = r->kinetic->m;
    nh_ex *all = nh_alloc_array(n * m + n + 1, sizeof *all), *exact = all + n * m;
    double *c = nh_alloc_array(n * n + 1, sizeof *c);
    for (size_t i = 0; i < n * m; i++) {
        all[i] = nh_int(d, 0);
        for (size_t a = 0; a < g->d; a++)
            if (t[a + i / m * g->d] != 0)
                all[i] =
                    nh_add(d, all[i], nh_mul(d, nh_real(d, t[a + i / m * g->d]), g->generator[a].component[i % m]));
    }
    size_t count = nh_second_candidates(first, n, all, &r->options, c);
    for (size_t j = 0; j < count; j++) {
        nh_second_coefficients(first, n, all, c + j * n, &r->options, exact);
        for (size_t i = 0; i < n; i++)
            for (size_t a = 0; a < g->d; a++) used[a] |= c[j * n + i] != 0 && t[a + i * g->d] != 0;
        for (size_t s = 0; s < m; s++) {
            field[j * m + s] = nh_int(d, 0);
            for (size_t i = 0; i < n; i++)
                field[j * m + s] = nh_add(d, field[j * m + s], nh_mul(d, exact[i], all[i * m + s]));
        }
    }
    nh_free(all);
    nh_free(c);
    return count ? nh_second_free(first, count, field, &r->options) : 0;
}

/* The largest |e_a^s (p_s + ahat_s)| that momenta of this energy can have (Cauchy and Schwarz): sqrt(e_a K e_a) sqrt(p
 * K^-1 p) + |e_a^s ahat_s|.  The momentum itself may be zero up to rounding, which is a small part of this. */
static double largest_momentum(size_t n, const double *K, const double *e, const double *p, const double *magnetic)
{
    double *factor = nh_alloc_array(n * n + n, sizeof *factor), *v = factor + n * n, length = 0, twice = 0,
           of_magnetic = 0;
    memcpy(factor, K, n * n * sizeof *factor);
    memcpy(v, p, n * sizeof *v);
    bool good = nh_solve(n, factor, 1, v, NULL);
    for (size_t i = 0; i < n && good; i++) {
        twice += p[i] * v[i];
        of_magnetic += e[i] * magnetic[i];
        for (size_t j = 0; j < n; j++) length += e[i] * K[i * n + j] * e[j];
    }
    nh_free(factor);
    return sqrt(fmax(length, 0)) * sqrt(fmax(twice, 0)) + fabs(of_magnetic);
}

/* The drift of e_a^s (p_s + ahat_s) along the motion that is reduced once, and that motion's positions. */
static double *once_reduced(nh_reduction_bench *b, const nh_chaplygin *first, const nh_second *t, const double *z,
                            double *drift, size_t *reached)
{
    nh_reduction *r = b->r;
    size_t n = first->n, d = t->d;
    nh_error trouble = {0};
    nh_reduced_flow *flow = nh_reduced_flow_create(&first->reduced);
    nh_flow_problem problem = nh_reduced_flow_problem(flow);
    nh_flow_options options = {.method = NH_ADAMS,
                               .absolute = nh_reduction_absolute(r),
                               .rtol = b->rtol,
                               .max_steps = fmin(r->options.steps, NH_REDUCTION_STEPS)};
    nh_motion *motion = nh_automatic(&problem, z, NH_REDUCTION_OUTPUTS, b->times, &options, NULL, &trouble);
    double *out = nh_arena_alloc(r->arena, (NH_REDUCTION_OUTPUTS * n + 1) * sizeof *out),
           *E = nh_alloc_array(n * d + 2 * d + n + n * n, sizeof *E);
    double *start = E + n * d, *size = start + d, *magnetic = size + d, *K = magnetic + n;
    *reached = motion ? motion->count : 0;
    *drift = *reached > 1 ? 0 : -1;
    for (size_t i = 0; i < *reached; i++) {
        const double *at = motion->state + i * 2 * n;
        memcpy(out + i * n, at, n * sizeof *out);
        nh_action_values(&t->action, at, E);
        nh_kinetic_values(t->hat, n, first->a, at, magnetic);
        nh_kinetic_values(t->hat, n * n, first->K, at, K);
        for (size_t a = 0; a < d; a++) {
            double momentum = 0;
            for (size_t k = 0; k < n; k++) momentum += E[k + a * n] * (at[n + k] + magnetic[k]);
            if (i == 0) start[a] = momentum;
            size[a] = fmax(size[a], largest_momentum(n, K, E + a * n, at + n, magnetic));
            if (momentum != start[a]) *drift = fmax(*drift, fabs(momentum - start[a]) / size[a]);
        }
    }
    nh_motion_free(motion);
    nh_reduced_flow_free(flow);
    nh_free(E);
    return out;
}

/* The full motion's shape coordinates, where the first group leaves these invariant; NULL where it does not. */
static double *full_shape(const nh_reduction_bench *b, const nh_slice *s)
{
    const nh_action *g = s->action;
    for (size_t a = 0; a < g->d; a++)
        for (size_t i = 0; i < s->n; i++)
            if (!nh_is_zero(s->dag, g->generator[a].component[s->shape[i]])) return NULL;
    double *out = nh_arena_alloc(b->r->arena, (b->reached * s->n + 1) * sizeof *out);
    for (size_t k = 0; k < b->reached; k++)
        for (size_t i = 0; i < s->n; i++) out[k * s->n + i] = b->full[k * s->m + s->shape[i]];
    return out;
}

/* The first group and the second as one action on Q. */
static nh_action both_groups(const nh_action *first, size_t d, const nh_ex *field, const nh_options *options)
{
    nh_generator *g = nh_alloc_array(first->d + d + 1, sizeof *g);
    nh_action both;
    memcpy(g, first->generator, first->d * sizeof *g);
    for (size_t b = 0; b < d; b++)
        nh_generator_init(&g[first->d + b], first->kinetic, NULL, field + b * first->kinetic->m, options);
    nh_action_init(&both, first->kinetic, first->d + d, g, options);
    nh_free(g);
    return both;
}

/* q, v: the initial state, or that moved along the first group's orbit onto the slice of `first`; simple: the first
   stage as it is shown. */
static bool second_stage(nh_reduction_bench *b, const nh_chaplygin *first, const nh_chaplygin *simple, const double *q,
                         const double *v, size_t d, const nh_ex *field, nh_error *error)
{
    nh_reduction *r = b->r;
    nh_second *t = &r->second[0], *pretty = t;
    const nh_slice *s1 = first->slice;
    size_t n = first->n, *shape = nh_alloc_array(2 * n + 2, sizeof *shape), *along = shape + n + 1;
    double *x = nh_alloc_array(8 * n + 8, sizeof *x), *u = x + n, *z = u + s1->m + 1,
           *y0 = nh_alloc_array(n + 1, sizeof *y0);
    bool good = nh_second_init(t, first, d, field, &r->options, error);
    if (good) {
        nh_slice_choose(&t->action, shape, along);
        for (size_t i = 0; i < n; i++) x[i] = q[s1->shape[i]];
        for (size_t a = 0; a < d; a++) y0[a] = x[along[a]];
        good = nh_second_equations(t, shape, along, y0, error) && nh_slice_components(s1, q, v, u) &&
               nh_reduced_start(&first->reduced, x, u, z);
    }
    /* the same stage on slices at simple places */
    if (good && (simple != first || nh_largest(d, y0) > 0) && !r->brief) {
        nh_error trouble = {0};
        if (nh_slice_nice(&t->action, along, y0) &&
            nh_second_init(&r->second[1], simple, d, field, &r->options, &trouble) &&
            nh_second_equations(&r->second[1], shape, along, y0, &trouble))
            pretty = &r->second[1];
    }
    if (good) {
        size_t reached;
        nh_reduction_stage *s = nh_reduction_new_stage(r, NH_STAGE_SECOND, &t->action);
        s->second = pretty;
        s->slice = &t->slice;
        s->reduced = &t->reduced;
        s->shown = &pretty->reduced;
        s->shown_slice = &pretty->slice;
        if (t->abelian && first->plain && first->d && !r->brief)
            s->measure = measure_of(r, &t->slice, t->Kt, t->U, &pretty->slice, pretty->Kt, pretty->U);
        conditions_of(r, s, &pretty->slice, pretty->Kt, pretty->U);
        double *want = once_reduced(b, first, t, z, &s->momentum_drift, &reached);
        double *full = full_shape(b, s1);
        s->against_full = full != NULL;
        nh_action both = both_groups(s1->action, d, field, &r->options);
        nh_atlas *atlas = nh_atlas_create_second(t, both.closes ? &both : NULL);
        nh_atlas_add(atlas, &t->slice, &t->reduced, NULL, t);
        nh_reduction_compare(b, s,
                             &(nh_reduction_time_series){.atlas = atlas,
                                                         .q = x,
                                                         .v = u,
                                                         .outputs = NH_REDUCTION_OUTPUTS,
                                                         .want = full ? full : want,
                                                         .stride = n,
                                                         .reached = full ? b->reached : reached});
        nh_atlas_free(atlas);
        nh_action_clear(&both);
    }
    nh_free(shape);
    nh_free(x);
    nh_free(y0);
    return good;
}

static bool first_and_second(nh_reduction_bench *b, nh_error *error)
{
    nh_reduction *r = b->r;
    const nh_action *g = &r->group->action;
    size_t f = r->kinetic->f, m = r->kinetic->m;
    double *t = nh_alloc_array(g->d * (g->d + f) + 1, sizeof *t), *rest = t + g->d * f;
    const nh_chaplygin *first = NULL;
    double *q = nh_alloc_array(2 * m + NH_REACH_MOST * f + 1, sizeof *q), *v = q + m;
    bool good = true;
    memcpy(q, r->initial.q, m * sizeof *q);
    memcpy(v, r->initial.v, m * sizeof *v);
    if (nh_group_chaplygin(r->group, &r->options, t)) {
        nh_action_sub(&r->action[0], g, f, t, &r->options);
        good = chaplygin_stage(b, &r->action[0], &first, error);
        const nh_chaplygin *shown = good ? r->stage[0].chaplygin : NULL;
        if (good && shown != first && nh_slice_reach(shown->slice, q, v, v + m) < SIZE_MAX) first = shown;
        size_t n =
            good && !nh_reduction_late(r, "a second stage") ? nh_group_normaliser_of(&g->algebra, f, t, rest) : 0;
        nh_ex *field = nh_alloc_array(n * m + 1, sizeof *field);
        bool *used = nh_alloc_array(2 * g->d + 1, sizeof *used), *normalises = used + g->d;
        for (size_t i = 0; i < f * g->d; i++) used[i % g->d] |= t[i] != 0;
        for (size_t i = 0; i < n * g->d; i++) normalises[i % g->d] |= rest[i] != 0;
        size_t d = n ? second_fields(r, first, n, rest, field, used) : 0;
        nh_error trouble = {0};
        if (good && !nh_interrupted()) nh_reduction_not_in_second(r, first, used, normalises);
        nh_free(used);
        if (n && !d && !first->plain)
            nh_reduction_warn(r,
                              "stage 1 is not reduced further: forces of the reduced system act along the further "
                              "symmetries (%zu) that normalise the first group, so no momentum is conserved",
                              n);
        if (d && !nh_interrupted() && !second_stage(b, first, shown, q, v, d, field, &trouble))
            nh_reduction_warn(r, "stage 1 is not reduced further: %s", trouble.what);
        nh_free(field);
    } else if (g->d) nh_reduction_no_chaplygin(r);
    nh_free(t);
    nh_free(q);
    return good;
}

/* Without constraints the first stage divides out nothing, G = {e}, Upsilon = 0, and the second one is the reduction to
 * the level sets of the momentum: Routh's, or that of the cotangent bundle [ChhabraEmami2014, sec. 2.3]. */
static bool momentum_levels(nh_reduction_bench *b, nh_error *error)
{
    nh_reduction *r = b->r;
    const nh_action *g = &r->group->action;
    size_t m = r->kinetic->m, *shape = nh_alloc_array(m + 1, sizeof *shape);
    nh_slice *whole = nh_arena_alloc(r->arena, sizeof *whole);
    nh_ex *field = nh_alloc_array(g->d * m + 1, sizeof *field);
    double nothing = 0, *all = nh_alloc_array(g->d * g->d + 1, sizeof *all);
    bool *used = nh_alloc_array(g->d + 1, sizeof *used);
    for (size_t i = 0; i < m; i++) shape[i] = i;
    for (size_t a = 0; a < g->d; a++) all[a * (g->d + 1)] = 1;
    nh_action_sub(&r->action[0], g, 0, &nothing, &r->options);
    nh_slice_init(whole, &r->action[0], shape, shape, &nothing);
    const nh_chaplygin *first = chaplygin_on(r, whole, error);
    size_t d = first ? second_fields(r, first, g->d, all, field, used) : 0;
    bool good = d && second_stage(b, first, first, r->initial.q, r->initial.v, d, field, error);
    if (first && !d) nh_fail(error, NH_INPUT, "", "forces act along all fields of the group");
    nh_free(used);
    nh_free(all);
    nh_free(shape);
    nh_free(field);
    return good;
}

bool nh_reduction_stages(nh_reduction *r, nh_error *error)
{
    nh_reduction_bench b = {.r = r, .times = nh_arena_alloc(r->arena, NH_REDUCTION_OUTPUTS * sizeof(double))};
    for (size_t i = 0; i < NH_REDUCTION_OUTPUTS; i++) b.times[i] = r->until * (double)i / (NH_REDUCTION_OUTPUTS - 1);
    if (nh_reduction_late(r, "the reduction")) return true;
    bool moves = nh_reduction_full_motion(&b, error);
    r->times = b.times;
    r->full_count = moves ? b.reached : 0;
    r->full_place = b.full;
    if (!moves || (!nh_interrupted() && r->kinetic->general && !first_and_second(&b, error))) return false;
    const nh_action *g = &r->group->action;
    bool quotient = !r->kinetic->general;
    if (nh_interrupted()) return true;
    if (g->d == r->kinetic->f && r->stages) return true; /* the first stage divides the whole group out */
    if (nh_reduction_late(r, "the reduction by the whole group at once")) return true;
    if (!nh_reduction_free_subgroup(r, &r->action[1])) {
        nh_reduction_warn(r, "no subgroup acts freely on the sample points");
        return true;
    }
    if (r->action[1].d < g->d)
        nh_reduction_warn(r,
                          "the whole group does not act freely (isotropy of dimension %zu); the reduction uses a "
                          "subgroup of dimension %zu",
                          g->d - g->orbit, r->action[1].d);
    nh_error trouble = {0};
    bool good =
        quotient ? nh_reduction_quotient(&b, &r->action[1], &trouble) : nh_reduction_whole(&b, &r->action[1], &trouble);
    if (!good && (r->chain_text || r->inner_text)) {
        if (error) *error = trouble;
        return false;
    }
    if (trouble.code != NH_OK) nh_reduction_warn(r, "the system is not reduced by the whole group: %s", trouble.what);
    bool levels =
        good && !r->kinetic->f && !quotient && !nh_interrupted() && !nh_reduction_late(r, "level sets of the momentum");
    nh_error_clear(&trouble);
    if (levels && !momentum_levels(&b, &trouble))
        nh_reduction_warn(r, "not reduced on level sets of the momentum: %s", trouble.what);
    return true;
}

/* reduce_whole: the reduction by the whole group at once, and the equations by stages. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "commands/reduce_internal.h"
#include "graph/dag.h"

/* Reads "3; 1, 2" as blocks; the numbers are those of the generators of the action, from 1. */
static size_t read_chain(const char *text, size_t d, size_t *size, size_t *order, nh_error *error)
{
    size_t blocks = 0, n = 0;
    bool *used = nh_alloc_array(d + 1, sizeof *used), good = true;
    size[0] = 0;
    for (const char *c = text; *c && good;) {
        char *end;
        long i = strtol(c, &end, 10);
        if (end != c) {
            good = i >= 1 && (size_t)i <= d && !used[i - 1];
            if (good) used[i - 1] = true, order[n++] = (size_t)i - 1, size[blocks]++;
            c = end;
        } else if (*c == ';') {
            if (size[blocks] && blocks + 1 < d) size[++blocks] = 0;
            c++;
        } else {
            good = strchr(", \t", *c) != NULL;
            c++;
        }
    }
    nh_free(used);
    if (good && n == d) return blocks + (size[blocks] > 0);
    nh_fail(error, NH_USAGE, "--chain", "a chain must name every generator of the group once, found `%.100s`", text);
    nh_error_hint(error,
                  "--chain \"3; 1, 2\": generators of the quotient first, those of the smallest normal subgroup last");
    return 0;
}

static bool bad_inner(size_t d, const char *typed, size_t at, nh_error *error)
{
    nh_deck_fail_typed("--inner", typed, at, error,
                       "this is not an entry of an inner product on the %zu generators of the group", d);
    return nh_error_hint(error,
                         "--inner \"1,%zu=1/2; %zu,%zu=3\": numbers of two generators, and the value; what is not "
                         "given is 1 on the diagonal and 0 elsewhere",
                         d, d, d);
}

/* Reads "1,4=1/2; 4,4=3" as expressions of the parameters. */
static bool read_inner(nh_reduction *r, size_t d, nh_error *error)
{
    nh_dag *dag = r->kinetic->dag;
    nh_ex *g = nh_arena_alloc(r->arena, (d * d + 1) * sizeof *g), value;
    for (size_t a = 0; a < d * d; a++) g[a] = nh_int(dag, a % (d + 1) == 0);
    const char *typed = r->inner_text;
    for (size_t at = 0, length, i, j; typed[at]; at += length + (typed[at + length] == ';')) {
        at += strspn(typed + at, " \t");
        length = strcspn(typed + at, ";");
        int end = 0;
        if (!length) continue;
        if (sscanf(typed + at, "%zu , %zu = %n", &i, &j, &end) != 2 || !end || i < 1 || j < 1 || i > d || j > d ||
            (size_t)end > length)
            return bad_inner(d, typed, at, error);
        size_t right = at + (size_t)end;
        if (!nh_system_expression_part(r->system, "--inner", typed, right, at + length - right, 0, NULL, &value, error))
            return false;
        for (size_t s = 0; s < r->kinetic->m; s++)
            if (nh_depends(dag, value, r->kinetic->q[s]) || nh_depends(dag, value, r->kinetic->v[s]))
                return nh_deck_fail_typed("--inner", typed, right, error,
                                          "this is not constant: values may contain parameters only");
        g[(i - 1) * d + j - 1] = g[(j - 1) * d + i - 1] = value;
    }
    r->inner = g;
    return true;
}

static bool positive(size_t d, const double *metric)
{
    double *a = nh_alloc_array(d * d + 1, sizeof *a);
    bool good = true;
    memcpy(a, metric, d * d * sizeof *a);
    for (size_t k = 0; k < d && good; k++) {
        good = a[k * (d + 1)] > 0;
        for (size_t i = k + 1; i < d && good; i++)
            for (size_t j = k + 1; j < d; j++) a[i * d + j] -= a[i * d + k] * a[k * d + j] / a[k * (d + 1)];
    }
    nh_free(a);
    return good;
}

/* g0 where it is given; otherwise the locked inertia at a sample point, whose numbers are generic. */
static bool inner_product(nh_reduction *r, const nh_slice *slice, double *metric, nh_error *error)
{
    size_t d = slice->d, m = slice->m;
    double *K = nh_alloc_array(m * m + 1, sizeof *K);
    nh_kinetic_values(r->kinetic, m * m, slice->K, r->initial.q, K);
    for (size_t a = 0; a < d * d; a++) metric[a] = K[(slice->n + a / d) * m + slice->n + a % d];
    nh_free(K);
    if (!r->inner_text) return true;
    if (!read_inner(r, d, error)) return false;
    nh_kinetic_values(r->kinetic, d * d, r->inner, r->initial.q, metric);
    return positive(d, metric) ||
           nh_fail(error, NH_USAGE, "--inner", "`%.200s` is not positive definite", r->inner_text);
}

/* g > n, n the group of the first stage where it is an ideal, as the papers have it: two blocks; 0: it is none. */
static size_t chain_of_first(const nh_reduction *r, const nh_action *g, size_t *size, size_t *order)
{
    const nh_action *first = r->stages && r->stage[0].kind == NH_STAGE_CHAPLYGIN ? r->stage[0].action : NULL;
    size_t d = g->d, n = 0, at = 0, most = first ? first->d : 0;
    bool *in = nh_arena_alloc(r->arena, (d + 1) * sizeof *in), ideal = true;
    for (size_t a = 0; a < d; a++)
        for (size_t b = 0; b < most && !in[a]; b++)
            in[a] = !memcmp(g->generator[a].component, first->generator[b].component,
                            r->kinetic->m * sizeof *g->generator[a].component);
    for (size_t a = 0; a < d; a++) n += in[a];
    for (size_t i = 0; i < d * d * d; i++) ideal &= !in[i / d % d] || in[i % d] || g->algebra.c[i] == 0;
    if (!n || n < most || n == d || !ideal) return 0;
    for (int member = 0; member < 2; member++)
        for (size_t a = 0; a < d; a++)
            if (in[a] == member) order[at++] = a;
    size[0] = d - n;
    size[1] = n;
    return 2;
}

/* The equations by stages. */
static bool by_stages(nh_reduction *r, nh_reduction_stage *s, nh_error *error)
{
    const nh_slice *slice = s->slice;
    size_t d = slice->d, *size = nh_alloc_array(2 * d + 2, sizeof *size), *order = size + d + 1;
    double *metric = nh_alloc_array(d * d + 1, sizeof *metric);
    size_t blocks = r->chain_text ? read_chain(r->chain_text, d, size, order, error)
                                  : chain_of_first(r, slice->action, size, order);
    if (!blocks && !r->chain_text) blocks = nh_ideals_find(&slice->action->algebra, size, order);
    bool good = blocks > 0 && inner_product(r, slice, metric, error) &&
                nh_ideals_init(&r->chain, &slice->action->algebra, blocks, size, order, metric, error);
    bool own = r->options.lifts > 0;
    for (size_t a = 0; a < d * d && own && !r->inner_text; a++) metric[a] = a % (d + 1) == 0;
    if (good)
        good = s->by_stages =
            nh_poincare_check(&s->poincare, slice, &r->chain, own ? metric : NULL, &r->options, error);
    s->chain = &r->chain;
    nh_free(size);
    nh_free(metric);
    return good;
}

bool nh_reduction_whole(nh_reduction_bench *b, const nh_action *action, nh_error *error)
{
    nh_reduction *r = b->r;
    nh_slice *slice, *shown;
    size_t m = r->kinetic->m, *independent = nh_arena_alloc(r->arena, (m + 1) * sizeof *independent);
    nh_reduced *o = nh_arena_alloc(r->arena, 2 * sizeof *o);
    const nh_reduced *pretty = o;
    nh_reduction_make_slices(r, action, r->initial.q, &slice, &shown);
    nh_reduced_independent(slice, independent);
    bool good = nh_reduced_master(o, slice, independent, error);
    nh_error ignored = {0};
    size_t *own = nh_arena_alloc(r->arena, (m + 1) * sizeof *own);
    if (!good) return false;
    if (slice->K != shown->K) {
        nh_reduced_independent(shown, own);
        if (r->brief && r->kept_whole) pretty = r->kept_whole;
        else pretty = nh_reduced_master(o + 1, shown, own, &ignored) ? o + 1 : o;
        if (pretty != o) r->kept_whole = pretty;
        nh_error_clear(&ignored);
    }
    nh_reduction_stage *s = nh_reduction_new_stage(
        r, action->dimension_assumption && r->kinetic->reducible ? NH_STAGE_POINCARE : NH_STAGE_SLICE, action);
    s->slice = slice;
    s->reduced = o;
    s->shown = pretty;
    s->shown_slice = pretty == o ? slice : shown;
    if (!r->brief && r->kinetic->reducible) nh_linear_momenta_find(&s->linear, pretty, &r->options);
    nh_atlas *atlas = nh_atlas_create(action, false);
    nh_atlas_add(atlas, slice, o, independent, NULL);
    if (pretty != o) {
        nh_atlas_add(atlas, shown, pretty, own, NULL);
        nh_atlas_prefer(atlas);
    }
    nh_reduction_compare_full(b, s, atlas);
    nh_error trouble = {0};
    bool given = r->chain_text || r->inner_text;
    if (!r->brief && s->kind == NH_STAGE_POINCARE && !by_stages(r, s, given ? error : &trouble)) {
        if (given) good = false;
        else nh_reduction_warn(r, "no equations by stages: %s", trouble.what);
    }
    return good;
}

bool nh_reduction_free_subgroup(nh_reduction *r, nh_action *out)
{
    const nh_action *g = &r->group->action;
    double *t = nh_alloc_array(g->d * g->d + 1, sizeof *t);
    size_t n = nh_group_free_basis(r->group, &r->options, t);
    if (n) nh_action_sub(out, g, n, t, &r->options);
    bool good = n && out->closes && out->free;
    nh_free(t);
    return good;
}

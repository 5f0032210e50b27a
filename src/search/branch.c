#include "search/branch.h"

#include "exact/normal.h"
#include "graph/dag.h"

nh_model *nh_branch_other(const nh_model *o, const nh_options *options)
{
    nh_system *system = o->system;
    int before = system->branch;
    nh_error ignored;
    nh_error_clear(&ignored);
    if (!o->chart->branch) return NULL;
    system->branch = -o->chart->branch;
    nh_model *other = nh_model_create(
        system, nh_chart_create(system, NH_CHART_COORDINATES, (uint64_t)options->seed, &ignored), &ignored);
    system->branch = before;
    bool same = other && other->chart->branch == -o->chart->branch;
    for (size_t i = 0; same && i < o->n; i++) same = other->chart->w[i] == o->chart->w[i];
    if (same) return other;
    nh_model_free(other);
    return NULL;
}

bool nh_branch_conserves(const nh_model *other, nh_ex phi, const nh_proof *here, const nh_options *options)
{
    nh_proof there = nh_prove_claim(
        other, phi, (nh_claim){.free = here->all_parameters || here->fixed, .fixed = here->fixed}, options);
    return there.proved || (!here->proved && there.digits >= options->digits);
}

/* Is it zero by its normal form, or, where that is too large, at the probes? */
static bool vanishes(const nh_model *o, nh_ex e)
{
    return nh_normal_is_zero(o->dag, e, 0) == NH_ZERO || nh_chart_pivot_score(o->chart, e) == 0;
}

static bool agree(const nh_model *o, const nh_model *other, size_t n, const nh_ex *here, const nh_ex *there)
{
    bool good = true;
    for (size_t i = 0; i < n && good; i++)
        good =
            vanishes(other, nh_sub(o->dag, nh_chart_composed(o->chart, nh_chart_shown(o->chart, here[i]), other->chart),
                                   there[i]));
    return good;
}

/* Lagrangian, energy, equations of motion, multipliers and reaction, as they are printed. */
static bool equations_agree(const nh_model *o, const nh_model *other)
{
    return agree(o, other, 1, &o->Lbar, &other->Lbar) && agree(o, other, 1, &o->E, &other->E) &&
           agree(o, other, o->n, o->a, other->a) && agree(o, other, o->k, o->mu, other->mu) &&
           agree(o, other, o->m, o->reaction, other->reaction);
}

/* Is the field, as printed, that of the current on the other branch?  By (N0), (NX), (NY). */
static bool field_agrees(const nh_model *o, const nh_model *other, const nh_points *points, const nh_symmetry *z,
                         nh_ex phi, double enough)
{
    nh_ex *e = nh_alloc_array(2 * o->n + 2, sizeof *e), *zeta = e + 1, *W = zeta + o->n;
    e[0] = nh_chart_composed(o->chart, nh_chart_shown(o->chart, z->Z0), other->chart);
    for (size_t i = 0; i < o->n; i++) {
        zeta[i] = nh_chart_composed(o->chart, nh_chart_shown(o->chart, z->zeta[i]), other->chart);
        W[i] = nh_chart_composed(o->chart, nh_chart_shown(o->chart, z->W[i]), other->chart);
    }
    bool good = nh_symmetry_residual(other, points, phi, e[0], zeta, W) <= enough;
    nh_free(e);
    return good;
}

static bool on_both(const nh_analysis *r, const nh_model *other, const nh_points *points, const nh_current *f)
{
    const nh_model *o = r->model;
    nh_ex phi = nh_chart_composed(o->chart, nh_chart_shown(o->chart, f->phi), other->chart);
    if (f->series || !nh_branch_conserves(other, phi, &f->proof, &r->options)) return false;
    return !f->has_symmetry || (points && field_agrees(o, other, points, &f->symmetry, phi, r->options.heldout));
}

void nh_branch_compare(nh_analysis *r)
{
    enum { generic_points = 24 };
    const nh_model *o = r->model->chart->branch ? r->model : r->other && r->other->chart->branch ? r->other : NULL;
    if (!o) return;
    char *here = nh_chart_branch_name(o->chart, o->chart->branch),
         *there = nh_chart_branch_name(o->chart, -o->chart->branch);
    nh_error ignored;
    nh_error_clear(&ignored);
    r->branch = nh_arena_strdup(r->arena, here);
    r->other_branch = nh_arena_strdup(r->arena, there);
    nh_model *other = nh_branch_other(o, &r->options);
    /* (t, q, w): of either branch */
    nh_points *points =
        other ? nh_points_create(o, generic_points, 1, (uint64_t)r->options.seed + 202, &ignored) : NULL;
    r->equations_on_both = other && equations_agree(o, other);
    for (size_t k = 0; k < r->count && other && o == r->model; k++)
        r->found[k].on_both = on_both(r, other, points, &r->found[k]);
    for (size_t k = 0; k < r->pieces && other && o == r->model; k++)
        r->piece[k].on_both = on_both(r, other, points, &r->piece[k]);
    for (size_t k = 0; k < r->furthers && other && o == r->model; k++)
        r->further[k].current.on_both = on_both(r, other, points, &r->further[k].current);
    nh_points_free(points);
    nh_model_free(other);
    nh_free(here);
    nh_free(there);
}

#include "search/search.h"

#include "exact/normal.h"
#include "graph/dag.h"
#include "search/current_list.h"

nh_model *nh_branch_other(const nh_model *model, const nh_options *options)
{
    nh_system *system = model->system;
    int before = system->branch;
    nh_error ignored;
    nh_error_clear(&ignored);
    if (!model->chart->branch) return NULL;
    system->branch = -model->chart->branch;
    nh_model *other = nh_model_create(
        system, nh_chart_create(system, NH_CHART_COORDINATES, (uint64_t)options->seed, &ignored), &ignored);
    system->branch = before;
    bool same = other && other->chart->branch == -model->chart->branch;
    for (size_t i = 0; same && i < model->n; i++) same = other->chart->w[i] == model->chart->w[i];
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
static bool vanishes(const nh_model *model, nh_ex e)
{
    return nh_normal_is_zero(model->dag, e, 0) == NH_ZERO || nh_chart_pivot_score(model->chart, e) == 0;
}

static bool agree(const nh_model *model, const nh_model *other, size_t n, const nh_ex *here, const nh_ex *there)
{
    bool good = true;
    for (size_t i = 0; i < n && good; i++)
        good =
            vanishes(other, nh_sub(model->dag,
                                   nh_chart_composed(model->chart, nh_chart_shown(model->chart, here[i]), other->chart),
                                   there[i]));
    return good;
}

/* Lagrangian, energy, equations of motion, multipliers and reaction, as they are printed. */
static bool equations_agree(const nh_model *model, const nh_model *other)
{
    return agree(model, other, 1, &model->Lbar, &other->Lbar) && agree(model, other, 1, &model->E, &other->E) &&
           agree(model, other, model->n, model->a, other->a) && agree(model, other, model->k, model->mu, other->mu) &&
           agree(model, other, model->m, model->reaction, other->reaction);
}

/* Is the field, as printed, that of the current on the other branch?  By (N0), (NX), (NY). */
static bool field_agrees(const nh_model *model, const nh_model *other, const nh_points *points, const nh_symmetry *z,
                         nh_ex phi, double enough)
{
    nh_ex *e = nh_alloc_array(2 * model->n + 2, sizeof *e), *zeta = e + 1, *W = zeta + model->n;
    e[0] = nh_chart_composed(model->chart, nh_chart_shown(model->chart, z->Z0), other->chart);
    for (size_t i = 0; i < model->n; i++) {
        zeta[i] = nh_chart_composed(model->chart, nh_chart_shown(model->chart, z->zeta[i]), other->chart);
        W[i] = nh_chart_composed(model->chart, nh_chart_shown(model->chart, z->W[i]), other->chart);
    }
    double kind[3];
    bool good = nh_symmetry_residual(other, points, phi, e[0], zeta, W, kind) <= enough;
    nh_free(e);
    return good;
}

static bool on_both(const nh_analysis *result, const nh_model *other, const nh_points *points, const nh_current *f)
{
    const nh_model *model = result->question->model;
    nh_ex phi = nh_chart_composed(model->chart, nh_chart_shown(model->chart, f->phi), other->chart);
    if (f->series || !nh_branch_conserves(other, phi, &f->proof, &result->question->options)) return false;
    return !f->has_symmetry ||
           (points && field_agrees(model, other, points, &f->symmetry, phi, result->question->options.heldout));
}

static void compare(nh_analysis *result, const nh_model *other, const nh_points *points, const nh_current *f)
{
    nh_current_list_describe(result, f)->on_both = on_both(result, other, points, f);
}

void nh_branch_compare(nh_analysis *result)
{
    const nh_current_list *list = result->list;
    enum { generic_points = 24 };
    const nh_model *model = result->question->model->chart->branch ? result->question->model
                            : result->question->other && result->question->other->chart->branch
                                ? result->question->other
                                : NULL;
    if (!model) return;
    char *here = nh_chart_branch_name(model->chart, model->chart->branch),
         *there = nh_chart_branch_name(model->chart, -model->chart->branch);
    nh_error ignored;
    nh_error_clear(&ignored);
    result->branch = nh_arena_strdup(result->arena, here);
    result->other_branch = nh_arena_strdup(result->arena, there);
    nh_model *other = nh_branch_other(model, &result->question->options);
    /* (t, q, w): of either branch */
    nh_points *points =
        other ? nh_points_create(model, generic_points, 1, (uint64_t)result->question->options.seed + 202, &ignored)
              : NULL;
    result->equations_on_both = other && equations_agree(model, other);
    bool same = other && model == result->question->model;
    for (size_t k = 0; same && k < list->count; k++) compare(result, other, points, &list->found[k]);
    for (size_t k = 0; same && k < list->pieces; k++) compare(result, other, points, &list->piece[k]);
    for (size_t k = 0; same && k < list->furthers; k++) compare(result, other, points, &list->further[k].current);
    nh_points_free(points);
    nh_model_free(other);
    nh_free(here);
    nh_free(there);
}

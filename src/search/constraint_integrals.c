/* constraint_integrals: functions of (t, q) that the constraints keep constant. [docs/method.md, sec. 2]
 *
 *     nh_integrals_find             a search without velocities: coordinates to degree four, functions, potentials of
 *                                   constraints that are total derivatives
 *     nh_integrals_of_constraints   which of the currents of (t, q) are new beside the given position constraints */
#include "search/searches.h"

#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/function.h"
#include "graph/node.h"
#include "integrals/force_potential.h"
#include "search/current_list.h"

enum { generic_count = 24, own_seed = 505 };

/* Is e a function of t and q? */
static bool only_events(const nh_model *model, nh_ex e)
{
    for (size_t j = 1 + model->m; j < model->width; j++)
        if (nh_depends(model->dag, e, model->chart->symbol[j])) return false;
    return true;
}

/* Functions in the order: the given constraints between positions, then the currents of (t, q); current[i]: which
   current, or r->count. */
static size_t gather(const nh_analysis *result, nh_ex *phi, size_t *current)
{
    const nh_current_list *list = result->list;
    const nh_system *system = result->question->system;
    size_t n = 0;
    for (size_t a = 0; a < system->constraints; a++)
        if (system->constraint[a].position) phi[n] = system->constraint[a].level, current[n++] = list->count;
    for (size_t k = 0; k < list->count; k++)
        if (only_events(result->question->model, list->found[k].phi)) phi[n] = list->found[k].phi, current[n++] = k;
    return n;
}

void nh_integrals_of_constraints(nh_analysis *result)
{
    const nh_options *options = &result->question->options;
    const nh_current_list *list = result->list;
    size_t most = list->count + result->question->system->constraints + 1;
    nh_ex *phi = nh_alloc_array(most, sizeof *phi);
    size_t *current = nh_alloc_array(most, sizeof *current),
           n = result->question->system->constraints ? gather(result, phi, current) : 0;
    nh_independence *kind = nh_alloc_array(most, sizeof *kind);
    nh_error ignored;
    nh_error_clear(&ignored);
    nh_points *points =
        n ? nh_points_create(result->question->model, generic_count, 1, (uint64_t)options->seed + own_seed, &ignored)
          : NULL;
    result->integral = nh_arena_alloc(result->arena, most * sizeof *result->integral);
    if (points)
        nh_independence_test(result->question->model, points, n, phi, NULL, options->sure, options->doubt, kind, NULL);
    for (size_t i = 0; i < n && points; i++) {
        if (current[i] == list->count) continue;
        nh_current *f = nh_current_list_describe(result, &list->found[current[i]]);
        bool fresh = kind[i] == NH_INDEPENDENT && result->integrals < result->question->constraint.hidden;
        if (fresh) result->integral[result->integrals++] = current[i];
        if (!f->meaning[0])
            f->meaning = fresh                                    ? "integral of the constraints"
                         : result->question->constraint.positions ? "the constraints between positions"
                                                                  : "";
    }
    nh_points_free(points);
    nh_free(kind);
    nh_free(current);
    nh_free(phi);
}

/* ---- a search of its own ---- */

enum { own_stages = 3, most_functions = 60 };

typedef struct {
    size_t events, functions;
    /* t and the coordinates; functions of them that the system shows, sines, cosines */
    nh_ex event[most_functions], function[most_functions];
} alphabet;

/* Adds a function of (t, q), once. */
static void letter(const nh_model *model, alphabet *a, nh_ex e)
{
    if (!only_events(model, e) || a->functions == most_functions) return;
    for (size_t i = 0; i < a->functions; i++)
        if (a->function[i] == e) return;
    a->function[a->functions++] = e;
}

/* Where a velocity is q^k times something, k > 1: dq/q^k is integrated to q^(1 - k). */
static void powers(const nh_model *model, alphabet *a)
{
    nh_dag *d = model->dag;
    NH_LIST(product);
    for (size_t s = 0; s < model->m; s++) {
        size_t n = nh_products_in(d, model->rho[s], &product);
        for (size_t i = 0; i < n; i++)
            for (size_t k = 0; k < nh_arity(d, product[i]); k++) {
                nh_ex q = nh_child(d, product[i], k), exponent = nh_exponent_of(d, product[i], k);
                if (nh_kind_of(d, q) != NH_SYMBOL || nh_kind_of(d, exponent) != NH_NUMBER) continue;
                nh_num power = nh_number_of(d, exponent);
                if (power.q == 1 && power.p > 1) letter(model, a, nh_powi(d, q, 1 - power.p));
            }
    }
}

/* f = form_s v^s + rate for a constraint f = 0; false: it is not affine in the velocities. */
static bool read_form(const nh_model *model, nh_ex f, nh_ex *form, nh_ex *rate)
{
    nh_dag *d = model->dag;
    nh_ex *v = nh_alloc_array(2 * model->m, sizeof *v), *zero = v + model->m;
    bool affine = true;
    for (size_t s = 0; s < model->m; s++) v[s] = model->system->coordinate[s].v, zero[s] = nh_int(d, 0);
    for (size_t s = 0; s < model->m; s++) form[s] = nh_simplify_short(d, nh_diff(d, f, v[s]), 0);
    for (size_t s = 0; s < model->m; s++)
        for (size_t j = 0; j < model->m; j++) affine &= !nh_depends(d, form[s], v[j]);
    *rate = nh_simplify_short(d, nh_substitute(d, f, model->m, v, zero), 0);
    nh_free(v);
    return affine;
}

/* F with form + rate dt = dF, or 0. */
static nh_ex potential(const nh_stage_solver *solver, const nh_ex *form, nh_ex rate)
{
    const nh_model *model = solver->r->question->model;
    nh_dag *d = model->dag;
    nh_ex t = model->system->t, G = nh_int(d, 0),
          F = nh_force_potential_of(model, solver->ranges, (size_t)solver->r->question->options.proof_terms, form);
    if (!F) return 0;
    nh_ex rest = nh_simplify_short(d, nh_sub(d, rate, nh_diff(d, F, t)), 0);
    for (size_t s = 0; s < model->m; s++)
        if (nh_depends(d, rest, model->system->coordinate[s].q)) return 0;
    return nh_is_zero(d, rest) || nh_stage_solver_integral(solver, t, rest, false, &G) ? nh_add(d, F, G) : 0;
}

/* Constraints that are total derivatives, as they are written or solved for one of the velocities: theta' = (phi' - 1)
 * sin(phi - t) leaves theta + cos(phi - t) constant. */
static void potentials(const nh_stage_solver *solver, alphabet *a)
{
    const nh_model *model = solver->r->question->model;
    nh_dag *d = model->dag;
    nh_ex *form = nh_alloc_array(2 * model->m, sizeof *form), *solved = form + model->m, rate;
    for (size_t k = 0; k < model->system->constraints; k++) {
        const nh_constraint *c = &model->system->constraint[k];
        if (c->level && !c->position) letter(model, a, nh_model_compose(model, c->level));
        if (c->position || c->level || !read_form(model, nh_sub(d, c->lhs, c->rhs), form, &rate)) continue;
        nh_ex F = potential(solver, form, rate);
        for (size_t s = 0; s < model->m && !F; s++) {
            if (nh_kind_of(d, form[s]) == NH_NUMBER) continue;
            nh_ex factor = nh_powi(d, form[s], -1);
            for (size_t j = 0; j < model->m; j++) solved[j] = nh_simplify_short(d, nh_mul(d, factor, form[j]), 0);
            F = potential(solver, solved, nh_simplify_short(d, nh_mul(d, factor, rate), 0));
        }
        if (F) letter(model, a, F);
    }
    nh_free(form);
}

static void letters(const nh_stage_solver *solver, alphabet *a)
{
    const nh_model *model = solver->r->question->model;
    nh_dictionary w = solver->words;
    for (size_t j = 0; j <= model->m && a->events < most_functions; j++)
        a->event[a->events++] = model->chart->symbol[j];
    for (size_t i = 0; i < w.atoms; i++) letter(model, a, w.atom[i]);
    for (size_t i = 0; i < w.potentials; i++) letter(model, a, w.potential[i]);
    for (size_t i = 0; i < w.waves; i++) {
        letter(model, a, nh_call(model->dag, NH_COS, w.wave[i]));
        letter(model, a, nh_call(model->dag, NH_SIN, w.wave[i]));
    }
    powers(model, a);
    potentials(solver, a);
}

/* Quadratic in the coordinates, and functions; cubic, and coordinates times functions; of degree four, and squares of
   the functions. */
static size_t families_of(const alphabet *a, size_t stage, nh_family *part, nh_family *out)
{
    size_t n = 0;
    part[0] = (nh_family){.kind = NH_POLYNOMIAL, .in = a->event, .in_count = a->events, .degree = stage == 1 ? 1 : 2};
    part[1] = (nh_family){.kind = NH_TERMS, .terms = a->functions, .term = a->function};
    part[2] = (nh_family){.kind = NH_POLYNOMIAL, .in = a->function, .in_count = a->functions, .degree = 2};
    out[n++] = (nh_family){.kind = NH_POLYNOMIAL, .in = a->event, .in_count = a->events, .degree = 2 + stage};
    if (a->functions == 0) return n;
    if (stage == 0) out[n++] = part[1];
    else if (stage == 1) out[n++] = (nh_family){.kind = NH_FAMILY_PRODUCT, .parts = 2, .part = part};
    else out[n++] = part[2];
    return n;
}

void nh_integrals_find(nh_stage_solver *solver)
{
    static const char *const names[own_stages] = {"functions of time and positions: quadratic, and the system's own",
                                                  "the same, cubic, and times positions",
                                                  "the same of degree four, and squares of the system's own"};
    size_t before = solver->r->list->independent;
    alphabet *a = nh_alloc(sizeof *a);
    letters(solver, a);
    for (size_t i = 0;
         i < own_stages && solver->r->list->independent < before + solver->r->question->constraint.integrals &&
         !nh_stage_solver_done(solver);
         i++) {
        nh_family part[3], family[2];
        size_t families = families_of(a, i, part, family);
        nh_stage_solver_stage(solver, names[i], families, family);
    }
    nh_free(a);
}

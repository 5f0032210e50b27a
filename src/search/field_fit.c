/* field_fit: stages that fit fields, the first of the search. [docs/method.md, sec. 4, "Fields first"]
 *
 *     simple      (time, X_i) times {1, t, positions, first harmonics, the system's functions}, functions of t and q
 *     products    X_i times products of harmonics, functions and lengths
 *     linear      products of two bases times {1, positions}: components linear in the velocities
 *     rates       X_i times exponentials and waves with rates of a pencil (rates.c)
 *
 * A simple field has a complicated current: a rigid displacement of a chain has ten numbers as components and a
 * momentum of ten thousand symbols.  Its columns adapt themselves to the system, and its rows need no accelerations.
 * What is found is lifted and proved as any current is. */
#include <string.h>

#include "graph/dag.h"
#include "graph/function.h"
#include "search/stage_solver.h"
#include "search/stages_internal.h"

typedef struct {
    nh_field_bases bases;
    nh_family_list list;
} fit;

/* Linear equations of motion are solved exactly by a search of their own: there a fit finds the same by rounding.  Who
 * asks for fields alone gets them. */
static bool begin(nh_stage_solver *solver, fit *f)
{
    nh_analysis *result = solver->r;
    const nh_model *model = result->question->model;
    if (nh_stage_solver_done(solver)) return false;
    if (result->question->route != NH_ROUTE_FIELDS && !model->k && nh_linear_motion_is(solver)) return false;
    f->bases = nh_field_rows_bases(model);
    f->list = (nh_family_list){result->arena, model, &solver->words,
                               nh_arena_alloc(result->arena, NH_MOST_FAMILIES * sizeof(nh_family)), 0};
    return true;
}

/* What is too large is left out: stages of currents follow that have the same functions in fewer columns. */
static void solve(nh_stage_solver *solver, const fit *f, const char *name)
{
    if (nh_ansatz_size(f->list.count, f->list.family) > solver->r->question->options.stage_columns) return;
    solver->fields = &f->bases;
    nh_stage_solver_stage(solver, name, f->list.count, f->list.family);
    solver->fields = NULL;
}

/* The currents of X_i, and with `time` of time. */
static nh_expr_set bases_of(const fit *f, bool time)
{
    nh_expr_set all = {0};
    for (size_t b = time ? 0 : 1; b < f->bases.count; b++) nh_expr_set_put(&all, f->bases.base[b].phi);
    return all;
}

/* cos and sin of each angle. */
static nh_expr_set harmonics_of(const fit *f)
{
    nh_dag *d = f->list.o->dag;
    nh_expr_set all = {0};
    for (size_t i = 0; i < f->list.w->waves; i++) {
        nh_expr_set_put(&all, nh_call(d, NH_COS, f->list.w->wave[i]));
        nh_expr_set_put(&all, nh_call(d, NH_SIN, f->list.w->wave[i]));
    }
    return all;
}

/* Functions of t and q alone: z0 of fields without X_i; and where (NY) has rows the velocities' functions, too. */
static void functions_alone(fit *f)
{
    nh_expr_set positions = nh_expr_set_positions(&f->list, false, true), own = nh_expr_set_functions(&f->list, false);
    nh_family_list_add(&f->list, nh_family_list_polynomial(&f->list, &positions, 2));
    nh_family_list_add(&f->list, nh_family_list_terms(&f->list, &own));
    if (!f->bases.inclined) return;
    nh_expr_set words = {0};
    nh_expr_set_put_all(&words, f->list.w->velocities, f->list.w->velocity);
    nh_expr_set_put_all(&words, f->list.w->forms, f->list.w->form);
    nh_expr_set_put_all(&words, f->list.w->momenta, f->list.w->momentum);
    nh_family_list_add(&f->list, nh_family_list_terms(&f->list, &words));
}

void nh_field_fit_simple(nh_stage_solver *solver)
{
    fit f;
    if (!begin(solver, &f)) return;
    nh_dag *d = f.list.o->dag;
    nh_expr_set bases = bases_of(&f, false), simple = nh_expr_set_positions(&f.list, true, true),
                waves = harmonics_of(&f), own = nh_expr_set_functions(&f.list, false), time = bases_of(&f, true),
                times = {0};
    time.n = 1;
    nh_expr_set_put(&times, nh_int(d, 1));
    nh_expr_set_put(&times, f.list.o->system->t);
    nh_expr_set_put_all(&simple, waves.n, waves.e);
    nh_expr_set_put_all(&simple, own.n, own.e);
    nh_family_list_product_of_sets(&f.list, &bases, &simple);
    nh_family_list_product_of_sets(&f.list, &time, &times);
    functions_alone(&f);
    solve(solver, &f, "fields with simple components: constants, positions, harmonics, functions");
}

void nh_field_fit_products(nh_stage_solver *solver)
{
    fit f;
    if (!begin(solver, &f)) return;
    nh_expr_set bases = bases_of(&f, false), lengths = nh_expr_set_lengths(&f.list, false, true),
                own = nh_expr_set_functions(&f.list, true), waves = nh_expr_set_waves(&f.list),
                time = bases_of(&f, true);
    nh_family_list_add(&f.list, nh_family_list_product(&f.list, 3,
                                                       (nh_family[]){nh_family_list_terms(&f.list, &bases),
                                                                     nh_family_list_terms(&f.list, &lengths),
                                                                     nh_family_list_terms(&f.list, &waves)}));
    nh_family_list_product_of_sets(&f.list, &bases, &own);
    time.n = 1;
    nh_family_list_add(&f.list, nh_family_list_terms(&f.list, &time));
    functions_alone(&f);
    solve(solver, &f, "fields with products of harmonics and lengths as components");
}

/* zeta = f (Phi_i zeta_j + Phi_j zeta_i), of the current f Phi_i Phi_j; each base is a factor of its own. */
void nh_field_fit_linear(nh_stage_solver *solver)
{
    enum { others = 6 }; /* families beside one for each base */
    fit f;
    if (!begin(solver, &f) || f.bases.count + others > NH_MOST_FAMILIES) return;
    nh_expr_set bases = bases_of(&f, false), places = nh_expr_set_positions(&f.list, true, false),
                own = nh_expr_set_functions(&f.list, true), time = bases_of(&f, true);
    time.n = 1;
    for (size_t i = 0; i < bases.n; i++) {
        nh_expr_set one = {1, {bases.e[i]}}, rest = {0};
        nh_expr_set_put_all(&rest, bases.n - i, bases.e + i);
        nh_family_list_add(&f.list, nh_family_list_product(&f.list, 3,
                                                           (nh_family[]){nh_family_list_terms(&f.list, &one),
                                                                         nh_family_list_terms(&f.list, &rest),
                                                                         nh_family_list_terms(&f.list, &places)}));
    }
    nh_family_list_product_of_sets(&f.list, &bases, &places);
    nh_family_list_product_of_sets(&f.list, &time, &places);
    nh_family_list_product_of_sets(&f.list, &own, &places);
    functions_alone(&f);
    solve(solver, &f, "fields with components linear in the velocities");
}

void nh_field_fit_rates(nh_stage_solver *solver)
{
    fit f;
    if (!begin(solver, &f) || f.bases.inclined) return;
    nh_expr_set bases = bases_of(&f, false);
    nh_family family = nh_family_list_terms(&f.list, &bases);
    solver->fields = &f.bases;
    nh_rates_of_fields(solver, &family);
    solver->fields = NULL;
}

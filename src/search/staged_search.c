/* staged_search: the rows of the search, in their order. [docs/stages.md]
 *
 *     part           budget `work`    what it does
 *     KNOWN          whole            energy, momenta, linear fields, words: also where the count misses nothing
 *     FITTED         what is left     linear problems, small ones first
 *     INTEGRATED     what is left     one equation of motion after another
 *     CONSTRUCTED    whole            what the count says is missing
 *     REST           whole            primitives, series
 *     ELSEWHERE      no limit         other velocities, levels of integrals, sides of kinks */
#include "search/search.h"

#include <math.h>
#include <string.h>

#include "base/budget.h"
#include "base/progress.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/node.h"
#include "integrals/force_potential.h"
#include "integrals/prove.h"
#include "search/stage_solver.h"
#include "search/searches.h"
#include "search/missing.h"
#include "search/quadratures.h"
#include "search/stages.h"

/* The part of a momentum with velocities, where there is another, which may come from a total derivative in L. */
static void without_positions(nh_stage_solver *solver, nh_ex momentum)
{
    const nh_model *model = solver->r->question->model;
    nh_ex *zero = nh_alloc_array(model->n + 1, sizeof *zero);
    for (size_t i = 0; i < model->n; i++) zero[i] = nh_int(model->dag, 0);
    nh_ex rest = nh_substitute(model->dag, momentum, model->n, model->chart->w, zero);
    nh_free(zero);
    if (nh_is_zero(model->dag, rest) || nh_kind_of(model->dag, rest) == NH_NUMBER) return;
    nh_stage_solver_certify(solver, nh_simplify_short(model->dag, nh_sub(model->dag, momentum, rest), 0),
                            "the part of a momentum with velocities");
}

/* The energy and each momentum alone, so that no nearly dependent function replaces them. */
static void energy_and_momenta(nh_stage_solver *solver)
{
    nh_analysis *result = solver->r;
    for (size_t i = 0; i <= solver->words.momenta && !nh_stage_solver_done(solver); i++) {
        nh_ex *e = nh_arena_alloc(result->arena, sizeof *e);
        nh_family *all = nh_arena_alloc(result->arena, sizeof *all);
        *e = i == 0 ? result->question->model->E : solver->words.momentum[i - 1];
        *all = (nh_family){.kind = NH_TERMS, .terms = 1, .term = e};
        if (nh_stage_solver_promising(solver, 1, all))
            nh_stage_solver_stage(solver, i == 0 ? "energy" : "a momentum", 1, all);
        else
            nh_stage_solver_certify(solver, *e,
                                    i == 0 ? "energy, in ball arithmetic" : "a momentum, in ball arithmetic");
        if (i > 0 && !nh_stage_solver_done(solver)) without_positions(solver, *e);
    }
}

/* What the energy and the work of the forces leave constant, where the forces have a potential. */
static void force_potential(nh_stage_solver *solver)
{
    const nh_model *model = solver->r->question->model;
    nh_ex U = nh_force_potential(model, solver->ranges, (size_t)solver->r->question->options.proof_terms);
    if (U) nh_stage_solver_certify(solver, nh_sub(model->dag, model->E, U), "energy and potential of the forces");
}

/* Whether a limit ended the search.  Work ends it at the same place everywhere, time does not; a stage that was too
 * large is skipped and ends nothing. */
static void how_it_ended(nh_analysis *result, bool spent)
{
    for (size_t i = 0; i < result->stages; i++)
        spent |= result->stage[i].limit.option && !strcmp(result->stage[i].limit.option, "work");
    if (result->list->independent >= result->question->local_maximum) result->search = NH_SEARCH_COMPLETE;
    else result->search = spent || nh_late() ? NH_SEARCH_CUT : NH_SEARCH_EXHAUSTED;
    if (result->search != NH_SEARCH_CUT || !spent) return;
    result->partial = true;
    nh_analysis_warn(result, "the limit of %g million units of work ended the search; raise it by --option work=%g",
                     result->question->options.work, 10 * result->question->options.work);
}

/* For these only the equations on one side of kinks are left. */
static void sides(nh_stage_solver *solver) { nh_sides_search(solver, nh_staged_search_run); }

static void primitives(nh_stage_solver *solver) { nh_missing_primitives(solver); }

/* The first three parts of the search share the whole of the option `work`; each of the others has it for itself, but
   for the last one, which is short and has as much as it needs. */
typedef enum { KNOWN, FITTED, INTEGRATED, CONSTRUCTED, REST, ELSEWHERE, PARTS } part;

/* What a row fits, for who asks for one route alone; BOTH belongs to either. */
typedef enum { CURRENTS, FIELDS, BOTH } fitted;

/* A row of the search: a stage of `stages`, or a search of its own.  At most 64 of them: there is a bit for each. */
typedef struct {
    const char *name; /* for `left_out`, and docs/stages.md */
    part part;
    void (*run)(nh_stage_solver *solver); /* NULL: the stage */
    nh_stage_name stage;
    fitted fits;
} row;

/* What is known comes first; then small linear problems, because what is found in them is short: those are left out in
   which the count says that nothing is missing.  Then the equations are integrated one after another, which gives the
   motion, too, and what the count still misses is constructed.  What has no closed form is a series at last.  The
   search ends as soon as there can be no more.  docs/stages.md has what each row is worth. */
static const row rows[] = {
    {"constraints", KNOWN, nh_integrals_find, 0, BOTH},         /* positions that they hold */
    {"energy and momenta", KNOWN, energy_and_momenta, 0, BOTH}, /* alone: no nearly dependent function replaces them */
    {"potential of forces", KNOWN, force_potential, 0, BOTH},   /* the energy with it */
    {"linear fields", KNOWN, nh_linear_fields_search, 0, BOTH}, /* translations, turns, boosts */
    {"simple fields", KNOWN, nh_field_fit_simple, 0, FIELDS},   /* components are constants, positions, harmonics */
    {"words", KNOWN, .stage = NH_STAGE_WORDS},            /* the energy, momenta, velocities, positions by themselves */
    {"fields", FITTED, nh_field_fit_products, 0, FIELDS}, /* components are products of them */
    {"fields with rates", FITTED, nh_field_fit_rates, 0, FIELDS},    /* of a pencil over the momenta */
    {"driven words", FITTED, .stage = NH_STAGE_DRIVE},               /* with what a force of t adds to them */
    {"rational", FITTED, .stage = NH_STAGE_RATIONAL},                /* velocities in denominators */
    {"linear motion", FITTED, nh_linear_motion_search, 0, CURRENTS}, /* before the pencil, whose rates are rounded */
    {"hidden linear motion", FITTED, nh_linear_motion_functions, 0, CURRENTS}, /* in coordinates that hide it */
    {"rates", FITTED, nh_rates_search, 0, CURRENTS}, /* exponentials and waves with rates of a pencil */
    {"words times positions", FITTED, .stage = NH_STAGE_WORDS_POSITIONS}, /* and times t */
    {"momenta times functions", FITTED, .stage = NH_STAGE_MOMENTA},       /* and harmonics, whatever L is */
    {"isometries", FITTED, nh_isometries_search, 0, BOTH},                /* the same, whatever the coordinates */
    {"turning velocities", FITTED, nh_velocity_turn_search, 0, CURRENTS}, /* two velocities and their energy */
    {"slopes", FITTED, nh_slopes_search, 0, CURRENTS},                    /* two velocities by themselves */
    {"last quadrature", FITTED, nh_quadratures_complete, 0, CURRENTS},    /* where one is missing, or a linear one */
    {"linear in velocities", FITTED, nh_field_fit_linear, 0, FIELDS},     /* fields of Runge and Lenz */
    {"degree 2", FITTED, .stage = NH_STAGE_DEGREE_2},                     /* from here on columns by the hundred */
    {"weights", FITTED, .stage = NH_STAGE_WEIGHTS},                       /* Runge and Lenz */
    {"weight 4", FITTED, .stage = NH_STAGE_WEIGHT_4},                     /* Kovalevskaya, Toda, Calogero */
    {"separation", FITTED, .stage = NH_STAGE_SEPARATION},                 /* Euler, Liouville */
    {"degree 2 in time", FITTED, .stage = NH_STAGE_TIME},                 /* Ermakov, Lewis */
    {"half angles", FITTED, .stage = NH_STAGE_HALF_ANGLES},               /* parabolic coordinates from polar ones */
    {"named functions", FITTED, nh_stage_solver_named, 0, CURRENTS}, /* Bessel, Gauss, .. of one coordinate, or of t */
    {"quadratures", INTEGRATED, nh_quadratures_search, 0, CURRENTS},
    {"construct", CONSTRUCTED, nh_missing_find, 0, CURRENTS},
    {"primitives", REST, primitives, 0, CURRENTS}, /* of the further integrals that it found */
    {"series", REST, nh_stage_solver_series, 0, CURRENTS},
    {"frames", ELSEWHERE, nh_frames_search, 0, CURRENTS},          /* in velocities along and across headings */
    {"levels", ELSEWHERE, nh_integral_levels_search, 0, CURRENTS}, /* on levels of linear integrals */
    {"sides", ELSEWHERE, sides, 0, CURRENTS},                      /* of kinks */
};

enum { ROWS = sizeof rows / sizeof *rows };
_Static_assert(ROWS <= 64, "a bit for each row");

const char *nh_staged_search_row(size_t i) { return i < ROWS ? rows[i].name : NULL; }

/* Is there nothing for this part to do?  Of a complete list the motion may not be known, nor the functions without
   which not all integrals are polynomials of the list. */
static bool part_is_done(const nh_stage_solver *solver, part p)
{
    return p == INTEGRATED    ? nh_budget_spent() || nh_late()
           : p == CONSTRUCTED ? nh_late()
                              : nh_stage_solver_done(solver);
}

/* What a row may change: a row that changes nothing can be left out. */
typedef struct {
    size_t count, pieces, independent, furthers;
} outcome;

static outcome outcome_of(const nh_analysis *result)
{
    const nh_current_list *list = result->list;
    return (outcome){list->count, list->pieces, list->independent, list->furthers};
}

/* Does the row belong to the route? */
static bool is_on_route(const row *own, nh_route route)
{
    return own->fits == BOTH || route == NH_ROUTE_BOTH || (own->fits == FIELDS) == (route == NH_ROUTE_FIELDS);
}

/* One row, unless its part is done or the row is left out; `used` marks rows that changed something. */
static void run_row(nh_stage_solver *solver, size_t i)
{
    nh_stage stage;
    nh_analysis *result = solver->r;
    const row *own = &rows[i];
    if (!is_on_route(own, result->question->route) || part_is_done(solver, own->part)) return;
    if (result->question->left_out >> i & 1) return;
    outcome before = outcome_of(result);
    solver->counted.on = own->part != KNOWN && own->part != CONSTRUCTED;
    if (own->run) own->run(solver);
    else if (nh_stage_at(result->arena, result->question->model, &solver->words, own->stage, &stage))
        nh_stage_solver_stage(solver, stage.name, stage.families, stage.family);
    outcome after = outcome_of(result);
    if (memcmp(&before, &after, sizeof before)) result->used |= UINT64_C(1) << i;
}

bool nh_staged_search_run(nh_analysis *result, nh_error *error)
{
    nh_stage_solver x;
    bool spent = false;
    if (!nh_stage_solver_begin(&x, result, error)) return false;
    result->counted = nh_count_memory_create();
    x.words = nh_dictionary_of(result->question->model);
    for (part p = 0; p < PARTS; p++) {
        if (p != FITTED && p != INTEGRATED) nh_budget_begin(p == ELSEWHERE ? INFINITY : result->question->options.work);
        for (size_t i = 0; i < ROWS; i++)
            if (rows[i].part == p) run_row(&x, i);
        spent |= p != CONSTRUCTED && nh_budget_spent();
    }
    nh_budget_begin(INFINITY);
    nh_currents_finish(x.bench);
    nh_missing_name_further(result);
    how_it_ended(result, spent);
    nh_stage_solver_end(&x);
    return true;
}

#include "search/staged_search.h"

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
#include "search/constraint_integrals.h"
#include "search/frames.h"
#include "search/integral_levels.h"
#include "search/quadratures.h"
#include "search/sides.h"
#include "search/slopes.h"
#include "search/stages.h"

/* The part of a momentum with velocities, where there is another, which may come from a total derivative in L. */
static void without_positions(nh_stage_solver *x, nh_ex momentum)
{
    const nh_model *o = x->r->model;
    nh_ex *zero = nh_alloc_array(o->n + 1, sizeof *zero);
    for (size_t i = 0; i < o->n; i++) zero[i] = nh_int(o->dag, 0);
    nh_ex rest = nh_substitute(o->dag, momentum, o->n, o->chart->w, zero);
    nh_free(zero);
    if (nh_is_zero(o->dag, rest) || nh_kind_of(o->dag, rest) == NH_NUMBER) return;
    nh_stage_solver_certify(x, nh_simplify_short(o->dag, nh_sub(o->dag, momentum, rest), 0),
                            "the part of a momentum with velocities");
}

/* The energy and each momentum alone, so that no nearly dependent function replaces them. */
static void single_stages(nh_stage_solver *x)
{
    nh_analysis *r = x->r;
    for (size_t i = 0; i <= x->words.momenta && !nh_stage_solver_done(x); i++) {
        nh_ex *e = nh_arena_alloc(r->arena, sizeof *e);
        nh_family *all = nh_arena_alloc(r->arena, sizeof *all);
        *e = i == 0 ? r->model->E : x->words.momentum[i - 1];
        *all = (nh_family){.kind = NH_TERMS, .terms = 1, .term = e};
        if (nh_stage_solver_promising(x, 1, all)) nh_stage_solver_stage(x, i == 0 ? "energy" : "a momentum", 1, all);
        else nh_stage_solver_certify(x, *e, i == 0 ? "energy, in ball arithmetic" : "a momentum, in ball arithmetic");
        if (i > 0 && !nh_stage_solver_done(x)) without_positions(x, *e);
    }
}

/* What the energy and the work of the forces leave constant, where the forces have a potential. */
static void force_potential(nh_stage_solver *x)
{
    const nh_model *o = x->r->model;
    nh_ex U = nh_force_potential(o, x->ranges, (size_t)x->r->options.proof_terms);
    if (U) nh_stage_solver_certify(x, nh_sub(o->dag, o->E, U), "energy and potential of the forces");
}

/* Each of the system's functions alone: many together are nearly dependent on a small interval. */
static void function_stages(nh_stage_solver *x)
{
    nh_analysis *r = x->r;
    size_t n = x->words.velocities + x->words.forms;
    nh_ex *linear = nh_arena_alloc(r->arena, (n + 1) * sizeof *linear);
    memcpy(linear, x->words.velocity, x->words.velocities * sizeof *linear);
    memcpy(linear + x->words.velocities, x->words.form, x->words.forms * sizeof *linear);
    for (size_t i = 0; i < x->words.atoms && !nh_stage_solver_done(x); i++) {
        nh_family *part = nh_arena_alloc(r->arena, 2 * sizeof *part), *all = nh_arena_alloc(r->arena, sizeof *all);
        part[0] = (nh_family){.kind = NH_TERMS, .terms = n, .term = linear};
        part[1] = (nh_family){.kind = NH_TERMS, .terms = 1, .term = &x->words.atom[i]};
        all[0] = (nh_family){.kind = NH_FAMILY_PRODUCT, .parts = 2, .part = part};
        if (nh_stage_solver_promising(x, 1, all))
            nh_stage_solver_stage(x, "velocities and forms times one function", 1, all);
    }
}

/* The usual integrals of many bodies, before stages that are too large for such systems. */
static void stages_of_many(nh_stage_solver *x)
{
    enum { few_coordinates = 6, turns = 1 };
    nh_stage stage;
    x->wide = true;
    for (size_t i = 0; x->r->model->m > few_coordinates && !nh_stage_solver_done(x) &&
                       nh_stage_of_many(x->r->arena, x->r->model, &x->words, i, &stage);
         i++) {
        if (i == turns) nh_linear_motion_forms(x);
        if (i != turns || !x->forms) nh_stage_solver_stage(x, stage.name, stage.families, stage.family);
    }
    x->wide = false;
}

/* Whether a limit ended the search.  Work ends it at the same place everywhere, time does not; a stage that was too
 * large is skipped and ends nothing. */
static void how_it_ended(nh_analysis *r, bool spent)
{
    for (size_t i = 0; i < r->stages; i++)
        spent |= r->stage[i].limit.option && !strcmp(r->stage[i].limit.option, "work");
    if (r->independent >= r->local_maximum) r->search = NH_SEARCH_COMPLETE;
    else r->search = spent || nh_late() ? NH_SEARCH_CUT : NH_SEARCH_EXHAUSTED;
    if (r->search != NH_SEARCH_CUT || !spent) return;
    r->partial = true;
    nh_analysis_warn(r, "the limit of %g million units of work ended the search; raise it by --option work=%g",
                     r->options.work, 10 * r->options.work);
}

/* For these only the equations on one side of kinks are left. */
static void sides(nh_stage_solver *x) { nh_sides_search(x, nh_staged_search_run); }

/* A stage of `stages`, or a search of its own. */
typedef struct {
    const char *name;                     /* for `left_out`, and docs/stages.md */
    void (*run)(nh_stage_solver *solver); /* NULL: the stage */
    nh_stage_name stage;
} step;

/* What is found by small linear problems first; what they can hide from each other, and what needs many columns,
   later.  From the third step on the count may make a stage superfluous. */
static const step steps[] = {
    {"linear fields", nh_linear_fields_search, 0}, /* before stages whose coefficients would be masses and lengths */
    {"words", .stage = NH_STAGE_WORDS},            /* the energy, momenta, velocities and positions by themselves */
    {"driven words", .stage = NH_STAGE_DRIVE},     /* with what a force of t adds to them */
    {"rational", .stage = NH_STAGE_RATIONAL},      /* velocities in denominators */
    {"many bodies", stages_of_many, 0},            /* and angular momenta, where everything else is too large */
    /* before the pencil, which has the rates of linear motion by rounding */
    {"linear motion", nh_linear_motion_search, 0},
    {"hidden linear motion", nh_linear_motion_functions, 0}, /* the same in coordinates that hide it */
    {"rates", nh_rates_search, 0}, /* before larger stages, whose null vectors are less short */
    {"words times positions", .stage = NH_STAGE_WORDS_POSITIONS}, /* and times t */
    {"momenta times functions", .stage = NH_STAGE_MOMENTA},       /* and harmonics, whatever L is */
    {"isometries", nh_isometries_search, 0},                      /* the same, whatever the coordinates */
    {"one function", function_stages, 0},                         /* times one function */
    {"turning velocities", nh_velocity_turn_search, 0},           /* two velocities and their energy */
    {"slopes", nh_slopes_search, 0},                              /* two velocities by themselves */
    {"last quadrature", nh_quadratures_complete, 0},              /* where one integral is missing, or a linear one */
    {"series of one coordinate", nh_series_stages, 0},            /* no closed form */
    {"degree 2", .stage = NH_STAGE_DEGREE_2},                     /* from here on columns by the hundred */
    {"weights", .stage = NH_STAGE_WEIGHTS},                       /* Runge and Lenz */
    {"weight 4", .stage = NH_STAGE_WEIGHT_4},                     /* Kovalevskaya, Toda, Calogero */
    {"separation", .stage = NH_STAGE_SEPARATION},                 /* Euler, Liouville */
    {"degree 2 in time", .stage = NH_STAGE_TIME},                 /* Ermakov, Lewis */
    {"series in time", nh_stage_solver_series_in_time, 0},        /* no closed form */
    {"half angles", .stage = NH_STAGE_HALF_ANGLES},               /* parabolic coordinates seen from polar ones */
    {"series of each coordinate", nh_stage_solver_series_in_each, 0}, /* no closed form, of one coordinate each */
};

/* After them, with all the work that is needed. */
static const step last_steps[] = {
    {"quadratures", nh_quadratures_search, 0},
    {"frames", nh_frames_search, 0},
    {"levels", nh_integral_levels_search, 0},
    {"sides", sides, 0},
};

enum { STEPS = sizeof steps / sizeof *steps, LAST_STEPS = sizeof last_steps / sizeof *last_steps };

const char *nh_staged_search_row(size_t i)
{
    return i < STEPS ? steps[i].name : i < STEPS + LAST_STEPS ? last_steps[i - STEPS].name : NULL;
}

/* What a row may change: a row that changes nothing can be left out. */
typedef struct {
    size_t count, pieces, independent, forms;
    bool postponed;
} outcome;

static outcome outcome_of(const nh_stage_solver *x)
{
    return (outcome){x->r->count, x->r->pieces, x->r->independent, x->forms, x->r->postponed};
}

static void run_step(nh_stage_solver *x, const step *s, size_t row)
{
    nh_stage stage;
    nh_analysis *r = x->r;
    outcome before = outcome_of(x);
    if (r->left_out >> row & 1) return;
    if (s->run) s->run(x);
    else if (nh_stage_at(r->arena, r->model, &x->words, s->stage, &stage))
        nh_stage_solver_stage(x, stage.name, stage.families, stage.family);
    outcome after = outcome_of(x);
    bool same = before.count == after.count && before.pieces == after.pieces && before.forms == after.forms &&
                before.independent == after.independent && before.postponed == after.postponed;
    if (!same) r->used |= UINT64_C(1) << row;
}

bool nh_staged_search_run(nh_analysis *r, nh_error *error)
{
    nh_stage_solver x;
    if (!nh_stage_solver_begin(&x, r, error)) return false;
    nh_budget_begin(r->options.work);
    r->counted = nh_count_memory_create();
    x.words = nh_dictionary_of(r->model);
    nh_integrals_find(&x);
    single_stages(&x);
    if (!nh_stage_solver_done(&x)) force_potential(&x);
    for (size_t i = 0; i < STEPS && !nh_stage_solver_done(&x); i++) {
        x.counted.on = i > 1;
        x.postpones = i + 1 == STEPS && r->options.construct > 0;
        run_step(&x, &steps[i], i);
    }
    run_step(&x, &last_steps[0], STEPS);
    bool spent = nh_budget_spent();
    nh_budget_begin(INFINITY);
    for (size_t i = 1; i < LAST_STEPS && !nh_stage_solver_done(&x); i++) run_step(&x, &last_steps[i], STEPS + i);
    nh_currents_finish(x.bench);
    how_it_ended(r, spent);
    nh_stage_solver_end(&x);
    return true;
}

#include <math.h>
#include <string.h>

#include "base/clock.h"
#include "base/progress.h"
#include "commands/benchmark_internal.h"

enum { most_halvings = 8 };
static const double middle_tolerance = 1e-8;
/* part of a final time, no eighth of which was reached, that is tried next */
static const double least_part = 1.0 / 64;
static const double share_of_fits = 0.25; /* part of the budget for the discrete problem */

const char *nh_run_record_status_name(nh_run_record_status status)
{
    static const char *const names[] = {"accurate", "flagged",    "detected", "failed",
                                        "timeout",  "undetected", "not run"};
    return names[status];
}

const char *nh_run_record_status_json(nh_run_record_status status)
{
    static const char *const names[] = {"right", "warned", "caught", "failed", "timeout", "wrong", "not run"};
    return names[status];
}

/* ---- the reference ---- */

static bool states_of(nh_benchmark_work *c, size_t formulation, const char *method, double tolerance, double *states)
{
    nh_candidate_run k = {.method = nh_method_find(method), .formulation = formulation};
    nh_motion *motion = nh_benchmark_work_counted(c, &k, tolerance, 0.25);
    c->hurried |= motion && !motion->complete && nh_benchmark_work_out_of_time(c, motion);
    c->effort = 0;
    if (motion && motion->count > c->reached) c->reached = motion->count;
    bool good = motion && motion->complete && !nh_formulation_breaks_down(&c->formulation[formulation], motion) &&
                nh_formulation_states(&c->formulation[formulation], motion, states);
    nh_motion_free(motion);
    return good;
}

/* Computes two motions by different methods; the first is the reference when they agree. */
typedef struct {
    const char *first, *second;
    double first_tolerance, second_tolerance;
} pair;

/* Takes these states as the reference if they are known more accurately than the present one. */
static void prefer(nh_benchmark_work *c, double agreement, const double *states, const char *reference,
                   const char *second)
{
    if (!(agreement < c->out->agreement)) return;
    memcpy(c->solution.state, states, NH_BENCHMARK_OUTPUTS * 2 * c->model->m * sizeof *states);
    c->out->agreement = agreement;
    c->out->reference = reference;
    c->out->second = second;
}

static double agreement_of(nh_benchmark_work *c, double *states, const double *other)
{
    double *before = c->solution.state;
    c->solution.state = states;
    nh_reference_solution_scales(&c->solution, c->out->arena, c->formulation[0].scale[0]);
    double agreement = nh_reference_solution_error(&c->solution, NH_BENCHMARK_OUTPUTS, other);
    c->solution.state = before;
    return agreement;
}

/* Tries one formulation; its reference is taken when it is more accurate than the present one.  `states` and `other`
 * are work memory.  False: the first motion had no time. */
static bool try_pair(nh_benchmark_work *c, const pair *p, size_t f, double *states, double *other)
{
    nh_arena *arena = c->out->arena;
    size_t ignored;
    bool hurried = c->hurried;
    c->hurried = false;
    if (!states_of(c, f, p->first, p->first_tolerance, states)) {
        bool late_here = c->hurried;
        c->hurried |= hurried;
        return !late_here;
    }
    const char *name = nh_arena_printf(arena, "%s at %.0e in %s", p->first, p->first_tolerance, c->formulation[f].name);
    if (states_of(c, f, p->second, p->second_tolerance, other))
        prefer(c, agreement_of(c, states, other), states, name,
               nh_arena_printf(arena, "%s at %.0e", p->second, p->second_tolerance));
    /* where the two methods disagree, a closed form may take the place of the second */
    for (size_t k = 0; k < c->closed_count && !(c->out->agreement < c->options.benchmark_trusted); k++)
        if (c->closed[k].whole)
            prefer(c, nh_closed_off(c, &c->closed[k], states, &ignored), states, name,
                   nh_arena_printf(arena, "closed form \"%s\"", c->closed[k].motion->name));
    c->hurried |= hurried;
    return true;
}

/* In the chart; in all coordinates where the chart breaks down or the two methods disagree; by implicit methods where
 * the motion is too stiff for explicit ones. */
bool nh_benchmark_work_reference(nh_benchmark_work *c, nh_error *error)
{
    static const pair pairs[] = {{"GSL rk8pd", "CVODE Adams", 1e-14, 1e-13},
                                 {"ARKODE ESDIRK", "CVODE BDF", 1e-13, 1e-13}};
    size_t size = NH_BENCHMARK_OUTPUTS * 2 * c->model->m;
    double *states = nh_alloc_array(size, sizeof *states), *other = nh_alloc_array(size, sizeof *other);
    c->out->agreement = INFINITY;
    for (size_t p = 0; p < sizeof pairs / sizeof *pairs; p++) {
        bool time = true; /* when one formulation has no time the next one, which takes longer, has none either */
        for (size_t f = 0;
             f < c->formulations && (time || c->once) && !(c->out->agreement < c->options.benchmark_trusted); f++)
            if (!c->formulation[f].breaks) time = try_pair(c, &pairs[p], f, states, other);
    }
    nh_free(states);
    nh_free(other);
    if (isfinite(c->out->agreement)) {
        nh_known_motions_use(c);
        nh_reference_solution_scales(&c->solution, c->out->arena, c->formulation[0].scale[0]);
        return true;
    }
    nh_fail(error, NH_NUMERIC, "", "no reference could be computed: the motion does not reach t = %g by two methods",
            c->out->end);
    return nh_error_hint(error, c->hurried && !c->once
                                    ? "there was no time for more: choose an earlier --until or a larger --budget"
                                    : "choose an earlier --until, another --initial or other --velocities");
}

/* ---- all methods in all formulations ---- */

/* NULL: multipliers by IDA, which is none of the methods that can be named. */
static bool wanted(const nh_benchmark *b, const nh_method *method)
{
    bool any = !b->methods;
    for (size_t i = 0; i < b->methods; i++) any |= b->only[i] == method;
    return any;
}

static void add(nh_benchmark_work *c, const nh_method *method, size_t formulation, bool projected)
{
    if (c->candidates < NH_BENCHMARK_CANDIDATES && wanted(c->out, method))
        c->candidate[c->candidates++] =
            (nh_candidate_run){.method = method, .formulation = formulation, .projected = projected};
}

void nh_benchmark_work_add(nh_benchmark_work *c, const nh_method *method, size_t formulation)
{
    add(c, method, formulation, false);
}

void nh_benchmark_work_refuse(nh_benchmark_work *c, const char *method, const char *why)
{
    nh_benchmark *out = c->out;
    if (out->refused == c->refusals) { /* the list is full */
        const char **more = nh_arena_alloc(out->arena, (2 * c->refusals + 8) * sizeof *more);
        if (out->refused) memcpy(more, out->refusal, out->refused * sizeof *more);
        out->refusal = more;
        c->refusals = 2 * c->refusals + 8;
    }
    out->refusal[out->refused++] = nh_arena_printf(c->out->arena, "%s: %s", method, why);
}

/* The currents that a projection preserves; the others with the reason. */
static void choose_currents(nh_benchmark_work *c)
{
    const nh_reference_solution *y = &c->solution;
    size_t n = y->currents;
    const char **why = nh_arena_alloc(c->out->arena, (n + 1) * sizeof *why);
    c->held = nh_arena_alloc(c->out->arena, (n + 1) * sizeof *c->held);
    nh_projection_choose(c->model, n, y->current, y->times[0], y->times[NH_BENCHMARK_OUTPUTS - 1], c->formulation[0].z0,
                         why);
    for (size_t k = 0; k < n; k++) {
        if (!why[k]) c->held[c->held_currents++] = y->current[k];
        else nh_benchmark_work_refuse(c, nh_arena_printf(c->out->arena, "projection onto %s", y->name[k]), why[k]);
    }
}

static void list_candidates(nh_benchmark_work *c)
{
    for (size_t i = 0; i < nh_method_count(); i++) {
        const nh_method *m = nh_method_at(i);
        const char *why = wanted(c->out, m) ? nh_method_refused(m, c->formulation[0].programs) : NULL;
        if (why) nh_benchmark_work_refuse(c, m->name, why);
        else add(c, m, 0, false);
    }
    const nh_method *projected = nh_method_find("GSL rk8pd");
    if (!wanted(c->out, projected)) return;
    if (!c->solution.currents)
        nh_benchmark_work_refuse(c, "projection",
                                 "the energy is not conserved, and the file knows no current; `known:` may hold one "
                                 "that `nhsym analyze` finds");
    else if (c->model->chart->implicit)
        nh_benchmark_work_refuse(c, "projection",
                                 "the constraints are solved by Newton's method inside the equations of motion");
    else {
        choose_currents(c);
        if (c->held_currents) add(c, projected, 0, true);
    }
}

/* The chart comes first: every method is tried in it. */
static void list_elsewhere(nh_benchmark_work *c)
{
    /* where no method is named */
    static const char *const elsewhere[] = {"GSL rk8pd", "CVODE Adams", "CVODE BDF", "Lagrange-d'Alembert, order 4",
                                            "relaxation, order 8"};
    size_t named = c->out->methods, count = named ? named : sizeof elsewhere / sizeof *elsewhere;
    for (size_t f = 1; f < c->formulations; f++)
        for (size_t i = 0; i < count; i++) {
            const nh_method *m = named ? c->out->only[i] : nh_method_find(elsewhere[i]);
            if (!m->order || (c->formulation[f].model && !nh_method_refused(m, c->formulation[f].programs)))
                add(c, m, f, false);
        }
    for (int index = 1; index <= (c->model->k ? 2 : 1) && !named; index++) {
        add(c, NULL, c->formulations - 1, false);
        c->candidate[c->candidates - 1].index = index;
    }
}

static bool open_formulations(nh_benchmark_work *c, nh_error *error)
{
    const nh_simulation *s = c->out->question;
    nh_error ignored;
    nh_error_clear(&ignored);
    double absolute = c->absolute;
    if (c->model->chart->quasi)
        c->other = nh_model_create(s->system, nh_chart_create(s->system, NH_CHART_COORDINATES, 1, &ignored), &ignored);
    if (!nh_formulation_open(&c->formulation[c->formulations++], s->model, &c->initial, c->project, absolute,
                             c->out->arena, error))
        return false;
    if (c->other) {
        if (nh_formulation_open(&c->formulation[c->formulations], c->other, &c->initial, c->project, absolute,
                                c->out->arena, &ignored))
            c->formulations++;
        else nh_formulation_close(&c->formulation[c->formulations]);
    }
    return nh_formulation_open_all(&c->formulation[c->formulations++], &c->formulation[0], c->initial.t, c->out->arena,
                                   error);
}

/* One motion with the guard in each chart. */
static void watch_charts(nh_benchmark_work *c)
{
    nh_candidate_run k = {.method = nh_method_find("CVODE Adams")};
    for (k.formulation = 0; k.formulation < c->formulations; k.formulation++) {
        nh_formulation *f = &c->formulation[k.formulation];
        if (!f->problem.guards) continue;
        nh_motion *motion = nh_benchmark_work_counted(c, &k, middle_tolerance, 0.1);
        c->effort = 0;
        f->breaks = motion && nh_formulation_breaks_down(f, motion);
        nh_motion_free(motion);
    }
}

static bool open_bench(nh_benchmark_work *c, const nh_request *request, size_t coordinate, double turn, bool once,
                       double budget, nh_error *error)
{
    nh_arena *arena = nh_arena_create();
    nh_benchmark *out = nh_arena_alloc(arena, sizeof *out);
    *c = (nh_benchmark_work){.out = out,
                             .budget = budget,
                             .begun = nh_clock(),
                             .absolute = request->options.absolute,
                             .options = request->options,
                             .project = request->project,
                             .once = once};
    out->arena = arena;
    out->methods = request->methods;
    const nh_method **only = nh_arena_alloc(arena, request->methods * sizeof *only);
    for (size_t i = 0; i < request->methods; i++) only[i] = request->method[i];
    out->only = only; /* the caller's list may not outlive the result */
    out->question = nh_arena_alloc(arena, sizeof *out->question);
    out->question->arena = nh_arena_create();
    if (!nh_simulate_read(out->question, request, &c->initial, &out->end, error)) return false;
    c->model = out->question->model;
    c->initial.q[coordinate] += turn;
    if (turn != 0) c->project = true;
    c->solution.model = c->model;
    c->solution.state = nh_arena_alloc(arena, NH_BENCHMARK_OUTPUTS * 2 * c->model->m * sizeof *c->solution.state);
    out->begin = c->initial.t;
    for (size_t i = 0; i < NH_BENCHMARK_OUTPUTS; i++)
        c->solution.times[i] = i + 1 == NH_BENCHMARK_OUTPUTS
                                   ? out->end
                                   : out->begin + (out->end - out->begin) * (double)i / (NH_BENCHMARK_OUTPUTS - 1);
    if (!(fabs(out->end - out->begin) > 0))
        return nh_fail(error, NH_USAGE, "", "the motion ends where it begins (t = %g)", out->end);
    size_t known = c->model->system->currents;
    const char **varying = nh_arena_alloc(arena, (known + 1) * sizeof *varying);
    for (size_t i = nh_reference_solution_currents(&c->solution, arena, varying); i-- > 0;)
        nh_benchmark_work_refuse(c, nh_arena_printf(arena, "the known current \"%s\"", varying[i]),
                                 "it is not conserved with these parameters");
    out->currents = c->solution.currents;
    out->current = c->solution.name;
    if (!open_formulations(c, error)) return false;
    nh_known_motions_open(c);
    watch_charts(c);
    return true;
}

bool nh_benchmark_work_open(nh_benchmark_work *c, const nh_request *request, double budget, nh_error *error)
{
    return open_bench(c, request, 0, 0, false, budget, error);
}

bool nh_benchmark_work_open_once(nh_benchmark_work *c, const nh_request *request, size_t coordinate, double turn,
                                 double budget, nh_error *error)
{
    return open_bench(c, request, coordinate, turn, true, budget, error);
}

void nh_benchmark_work_no_reference(nh_benchmark_work *c)
{
    size_t m2 = 2 * c->model->m;
    const nh_formulation *all = &c->formulation[c->formulations - 1];
    for (size_t i = 0; i < NH_BENCHMARK_OUTPUTS; i++) memcpy(c->solution.state + i * m2, all->z0, m2 * sizeof(double));
    nh_reference_solution_scales(&c->solution, c->out->arena, c->absolute);
}

void nh_benchmark_work_close(nh_benchmark_work *c)
{
    for (size_t f = 0; f < c->formulations; f++) nh_formulation_close(&c->formulation[f]);
    nh_reference_solution_close(&c->solution);
    nh_reduction_free(c->reduction);
    nh_model_free(c->other);
}

static void end_bench(nh_benchmark_work *c)
{
    nh_benchmark_work_close(c);
    nh_benchmark_free(c->out);
}

/* A default final time may lie beyond a singularity, or be a million periods: it is halved, or divided by more where
 * not even an eighth was reached, until there is a motion. */
static bool open_somewhere(nh_benchmark_work *c, const nh_request *request, double budget, nh_error *error)
{
    nh_request q = *request;
    for (int i = 0; i < most_halvings; i++) {
        nh_error_clear(error);
        if (!nh_benchmark_work_open(c, &q, budget, error)) break;
        bool chosen = request->until_given || (c->out->question->analysis && c->out->question->analysis->has_until),
             last = chosen || i + 1 == most_halvings;
        bool there = nh_benchmark_work_reference(c, error);
        c->out->doubtful = there && !(c->out->agreement < c->options.benchmark_trusted);
        if (there && (last || !c->out->doubtful)) {
            c->out->shortened = i > 0;
            return true;
        }
        if (last) break;
        q.until_given = true;
        q.options.until =
            c->out->begin +
            (c->out->end - c->out->begin) *
                (c->reached > 1 ? fmin(0.5, (double)(c->reached - 1) / (NH_BENCHMARK_OUTPUTS - 1)) : least_part);
        end_bench(c);
    }
    end_bench(c);
    return false;
}

/* Has the grid of the request points for this system? */
static bool choose_grid(const nh_benchmark_work *c, const nh_request *request, nh_grid *grid, nh_error *error)
{
    const nh_model *model = c->out->question->model;
    if (!nh_grid_choose(c->out->arena, model, request->grid, grid, error)) return false;
    nh_points *p = nh_grid_points(model, &c->options, grid, 1, (uint64_t)c->options.seed, error);
    nh_points_free(p);
    return p || error->code != NH_OK || nh_fail(error, NH_NUMERIC, "", "no point of the grid is usable");
}

nh_benchmark *nh_benchmark_run(const nh_request *request, double budget, nh_error *error)
{
    nh_benchmark_work c;
    if (!open_somewhere(&c, request, budget, error)) return NULL;
    nh_grid grid = {0};
    if (!choose_grid(&c, request, &grid, error)) {
        nh_benchmark *out = c.out;
        nh_benchmark_work_close(&c);
        nh_benchmark_free(out);
        return NULL;
    }
    c.fit_alone = request->fit;
    c.every_grid = request->fit && !request->grid;
    if (!request->fit) {
        list_candidates(&c);
        list_elsewhere(&c);
        nh_benchmark_reduced(&c, request);
    }
    c.begun = nh_clock(); /* the budget is for measurements: the work before them is needed in any case */
    nh_benchmark_work_measure_all(&c);
    if (!c.out->methods) { /* these warnings concern no integrator */
        if (!request->fit) nh_benchmark_derivatives(&c.formulation[0], c.out);
        nh_benchmark_fit(&c, &grid, request->fit ? budget : budget * share_of_fits);
    }
    c.out->partial |= nh_interrupted();
    nh_benchmark_work_close(&c);
    return c.out;
}

nh_benchmark *nh_benchmark_reference(const nh_request *request, double budget, nh_error *error)
{
    nh_benchmark_work c;
    if (!open_somewhere(&c, request, budget, error)) return NULL;
    nh_benchmark_work_close(&c);
    return c.out;
}

void nh_benchmark_free(nh_benchmark *c)
{
    if (!c) return;
    nh_simulation_free(c->question);
    nh_arena_free(c->of_maps);
    nh_arena_free(c->arena);
}

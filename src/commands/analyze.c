#include "commands/analyze.h"

#include <math.h>
#include <string.h>

#include "motion/trajectory.h"
#include "base/budget.h"
#include "base/clock.h"
#include "base/linalg.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "graph/declared.h"
#include "integrals/fitted.h"
#include "search/coefficients.h"
#include "search/current_list.h"
#include "search/grid.h"
#include "search/currents.h"
#include "commands/analyze_known.h"
#include "commands/analyze_models.h"
#include "commands/figures.h"
#include "search/searches.h"
#include "search/search.h"
#include "search/missing.h"
#include "search/motion_series.h"
#include "search/theory.h"
#include "search/specials.h"

enum { least_samples = 256, samples_per_column = 4, motion_outputs = 401 };

static double lap(double *last)
{
    double t = nh_clock(), d = t - *last;
    *last = t;
    return d;
}

/* ---- reading ---- */

static void merge_options(nh_analysis_question *question, const nh_request *q)
{
    const nh_analysis_file *a = question->analysis;
    question->options = q->options;
    if (question->pace > 0 && !q->until_given) question->options.until /= question->pace;
    question->route = a ? a->route : NH_ROUTE_BOTH;
    if (q->route) nh_analysis_file_route(q->route, &question->route, NULL);
    if (question->model) nh_fitted_options(question->model, &question->options);
    if (!a) return;
    if (a->has_seed && !q->seed_given) question->options.seed = a->seed;
    question->samples_in_file = a->has_samples && !q->samples_given;
    if (question->samples_in_file) question->options.samples = a->samples;
    if (a->has_tolerance && !q->tolerance_given) question->options.tolerance = a->tolerance;
    if (a->has_until && !q->until_given) question->options.until = a->until;
}

static bool read_files(nh_analysis *result, nh_analysis_question *question, const nh_request *q, nh_error *error)
{
    if (q->analysis_path && !(question->analysis = nh_analysis_file_read(q->analysis_path, error))) return false;
    size_t own = question->analysis ? question->analysis->settings : 0;
    nh_setting *setting = nh_arena_alloc(result->arena, (own + q->settings + 1) * sizeof *setting);
    if (own) memcpy(setting, question->analysis->setting, own * sizeof *setting);
    if (q->settings) memcpy(setting + own, q->setting, q->settings * sizeof *setting);
    question->system = nh_system_read(q->system_path, own + q->settings, setting, error);
    for (size_t i = 0; question->system && i < question->system->notes; i++)
        nh_analysis_warn(result, "%s", question->system->note[i]);
    return question->system != NULL;
}

/* The word of the command line, else that of the analysis file. */
static bool choose_grid(nh_analysis *result, nh_analysis_question *question, const nh_request *q, nh_error *error)
{
    const nh_analysis_file *a = question->analysis;
    question->grid.in_file = !q->grid && a && a->grid;
    const char *word = q->grid ? q->grid : a ? a->grid : NULL;
    if (!nh_grid_choose(result->arena, question->model, word, &question->grid, error)) return false;
    /* every stage of the program's own search uses it */
    bool staged = !a || !a->families;
    return !staged || nh_grid_possible(result, NULL, 0, (size_t)question->options.samples, error);
}

/* ---- the linear problem ---- */

typedef struct {
    nh_analysis *result;
    const nh_ansatz *ansatz;
    nh_ansatz *currents; /* of fields */
} problem;

static nh_nullspace *field_route(void *context, const nh_points *points, nh_error *error)
{
    problem *p = context;
    nh_ansatz_free(p->currents);
    p->currents = NULL;
    return nh_routes_fields(p->result, p->ansatz, points, &p->currents, error);
}

static nh_nullspace *current_route(void *context, const nh_points *points, nh_error *error)
{
    const problem *p = context;
    const nh_analysis *result = p->result;
    nh_equations *equations = nh_equations_create(p->ansatz->columns, nh_threads(result->question->options.threads));
    nh_rows *rows = nh_rows_create(result->question->model, p->ansatz, 0, NULL);
    nh_rows_current(rows, points, NULL, equations);
    nh_nullspace_options limits = nh_nullspace_options_from(&result->question->options);
    nh_nullspace *s = nh_nullspace_solve(equations, &limits, error);
    nh_rows_free(rows);
    nh_equations_free(equations);
    return s;
}

/* The null space on the grid of the question; of a fit of fields in `currents`, which it makes. */
static nh_nullspace *on_grid(nh_analysis *result, const nh_ansatz *a, nh_points **points, nh_ansatz **currents,
                             nh_error *error)
{
    const nh_options *options = &result->question->options;
    size_t usual = samples_per_column * a->columns;
    if (usual < least_samples) usual = least_samples;
    bool fields = result->question->route == NH_ROUTE_FIELDS;
    problem p = {result, a, NULL};
    nh_nullspace *s = nh_grid_solve(result, a, a->columns, (size_t)options->samples, usual, (uint64_t)options->seed,
                                    fields ? field_route : current_route, &p, points, error);
    if (s && !fields) result->current = nh_spectrum_of(result->arena, s);
    *currents = p.currents;
    return s;
}

/* Takes the null vectors; where the spectrum is in doubt also the likely ones, about which a certificate decides. */
static void collect(nh_analysis *result, nh_current_checker *bench, const nh_ansatz *a, const nh_points *points,
                    const nh_nullspace *s)
{
    bool sure = s->likely == s->dimension;
    nh_candidates *list =
        nh_echelon(result->question->model, points, a, s, sure ? s->dimension : s->likely, &result->question->options);
    for (size_t k = 0; k < list->count; k++) nh_currents_add(bench, &list->candidate[k], points, sure);
    nh_currents_join(bench, points);
    nh_candidates_free(list);
}

static bool linear_problem(nh_analysis *result, size_t families, const nh_family *family, double *clock,
                           nh_error *error)
{
    nh_points *ranges =
        nh_points_create(result->question->model, least_samples, 1, (uint64_t)result->question->options.seed, error);
    if (!ranges) return false;
    nh_ansatz *a = nh_ansatz_create(result->question->model, ranges, families, family,
                                    (size_t)result->question->options.columns, error);
    nh_points_free(ranges);
    if (!a) return false;
    result->timing.samples = lap(clock);
    nh_points *points;
    nh_ansatz *own = NULL; /* of the currents of fields */
    nh_nullspace *s = on_grid(result, a, &points, &own, error);
    bool good = s != NULL;
    if (own) nh_ansatz_free(a), a = own;
    if (good) {
        result->samples = points->count;
        result->beyond = nh_points_equations(points) - points->count;
        result->rejected = points->tried - nh_points_equations(points);
        if (result->question->route == NH_ROUTE_BOTH) nh_routes_compare(result, a, points, s);
        result->timing.nullspace = lap(clock);
        nh_current_checker *bench = nh_current_checker_create(result, error);
        good = bench != NULL;
        nh_agreement_keep(result, families, family, a, s, own != NULL);
        if (good) collect(result, bench, a, points, s);
        if (good) nh_currents_finish(bench);
        nh_current_checker_free(bench);
        result->timing.currents = lap(clock);
    }
    nh_nullspace_free(s);
    nh_points_free(points);
    nh_ansatz_free(a);
    return good;
}

/* After the deadline anything may be missing. */
static void watch_deadline(nh_analysis *result)
{
    bool late = nh_late() && result->search != NH_SEARCH_COMPLETE;
    if (late) result->search = NH_SEARCH_CUT;
    if (late && !nh_interrupted()) {
        result->partial = true;
        nh_analysis_warn(result, "the time limit of %g s ended the search; raise it by --max-seconds",
                         result->question->options.max_seconds);
    }
    nh_deadline_set(INFINITY);
}

/* Where the ansatz of the user holds currents, and more can exist, the program's own search follows, and what the count
 * says is missing; the numbers of the problem remain those of the ansatz. */
static bool go_on(nh_analysis *result, nh_error *error)
{
    nh_spectrum given = result->current;
    size_t samples = result->samples, beyond = result->beyond, rejected = result->rejected;
    bool searched = result->list->count && !result->question->analysis->alone &&
                    result->search == NH_SEARCH_EXHAUSTED && !nh_late();
    if (searched && !nh_staged_search_run(result, error)) return false;
    watch_deadline(result);
    if (!nh_late()) nh_missing_count(result, result->stages > 0);
    result->current = given;
    result->samples = samples, result->beyond = beyond, result->rejected = rejected;
    return true;
}

/* FOUND needs a certificate for every current; NONE needs that no null vector and no omitted stage is left open. */
static void conclude(nh_analysis *result)
{
    bool kept_out =
             result->search == NH_SEARCH_CUT || (result->search != NH_SEARCH_COMPLETE && nh_analysis_left_out(result)),
         open = result->open > 0 || kept_out || nh_analysis_by_trial(result),
         failed = result->list->count == 0 && result->current.dimension > 0;
    bool fitted = result->list->count && result->list->found[0].fitted;
    nh_dag *d = result->question->model->dag;
    double error = nh_declared_table_error(d);
    if (fitted)
        nh_analysis_warn(result, "a table has no formula: what is conserved is fitted, not proved; %s",
                         error > 0 ? nh_arena_printf(result->arena,
                                                     "the slopes of `%s` differ by %.1g (root mean square) from those "
                                                     "without every second value",
                                                     nh_declared_has_table(d), error)
                                   : "the tables have too few values to tell how well they are known");
    result->verdict = fitted                                                  ? NH_FITTED
                      : result->list->count || nh_analysis_to_the_end(result) ? NH_FOUND
                      : open || failed || result->list->pieces                ? NH_UNDECIDED
                                                                              : NH_NONE;
    if (result->list->count == 0 && kept_out)
        nh_analysis_warn(result, "stages beyond a limit may contain further currents%s",
                         nh_analysis_left_out(result) ? ": the list of stages names the options to raise" : "");
    if (result->list->count == 0 && result->open)
        nh_analysis_warn(
            result, "some null vectors have no certificate: to decide, use another ansatz or more samples (--samples)");
    if (result->current.rank_in_doubt &&
        (!result->stages || (result->question->analysis && result->question->analysis->families)))
        nh_analysis_warn(result,
                         "two columns of the ansatz are nearly dependent: the option `rank` decides which are kept");
}

/* ---- the motion ---- */

static const nh_observable *list_tracks(nh_analysis *result)
{
    const nh_current_list *list = result->list;
    nh_observables *t = &result->tracks;
    *t = nh_observables_create(result->arena, result->question->model);
    nh_observables_add_states(t);
    nh_observables_add(t, "E", NH_TRACK_ENERGY, result->question->model->E);
    for (size_t k = 0; k < list->count; k++)
        nh_observables_add(t, list->found[k].name, NH_TRACK_CURRENT, list->found[k].phi);
    nh_observables_add_drawing(t, result->question->analysis);
    nh_observables_add_watches(t, result->question->analysis);
    nh_observable *watch = nh_arena_alloc(result->arena, (t->count + 1) * sizeof *watch);
    for (size_t i = 0; i < t->count; i++)
        watch[i] = (nh_observable){t->track[i].name, t->track[i].value, t->track[i].kind == NH_TRACK_WATCH,
                                   t->track[i].kind == NH_TRACK_CURRENT || t->track[i].kind == NH_TRACK_ENERGY};
    return watch;
}

/* A drift that does not fall with the tolerance.  A current that is proved is constant: then its formula magnifies the
 * error of the motion (x exp(t) along x = exp(-t), whose error is absolute), or its value does not fit into a
 * double. */
static void say_drift(nh_analysis *result, const nh_current *f)
{
    double drift = f->drift.drift[NH_DRIFT_RUNS - 1];
    if (!isfinite(drift))
        nh_analysis_warn(result, "%s has no finite value at some states of the test motion in double precision",
                         f->name);
    else if (f->proof.proved)
        nh_analysis_warn(result,
                         "%s drifts by %.1e along the test motion, more than %g tolerances, and hardly less at smaller "
                         "ones: it is proved to be constant, so this is the error of the motion, which the formula "
                         "magnifies",
                         f->name, drift, result->question->options.drift);
    else
        nh_analysis_warn(result,
                         "%s drifts by %.1e along the test motion, more than %g tolerances; the drift hardly falls "
                         "with the tolerance, so it is not the error of the motion",
                         f->name, drift, result->question->options.drift);
}

/* The end of the test motion: at the latest the place where it has an impulse, which a warning names. */
static double end_of_motion(nh_analysis *result, const nh_state *initial)
{
    const nh_options *options = &result->question->options;
    static const double before = 1e-9; /* part of the time to the impulse */
    double end = options->until, times[2] = {initial->t, end};
    nh_terrain terrain = nh_terrain_of(result->question->model, options, result->arena);
    nh_error ignored;
    nh_error_clear(&ignored);
    if (!terrain.impulses || !(end > initial->t)) return end;
    nh_trajectory_request request = {.model = result->question->model,
                                     .initial = initial,
                                     .count = 2,
                                     .times = times,
                                     .options = options,
                                     .impulses = terrain.impulses,
                                     .impulse = terrain.impulse};
    nh_trajectory *motion = nh_trajectory_create(&request, &ignored);
    double reached = motion ? motion->motion->end_time : end;
    if (reached > initial->t && reached < end) {
        end = reached - before * (reached - initial->t);
        nh_analysis_warn(result, "the test motion ends at t = %.6g: %s", reached, motion->motion->note);
    }
    nh_trajectory_free(motion);
    return end;
}

static void validate(nh_analysis *result, const nh_request *q)
{
    const nh_current_list *list = result->list;
    nh_error trouble;
    nh_error_clear(&trouble);
    nh_state initial = result->question->analysis ? result->question->analysis->initial : (nh_state){0};
    if (!result->question->analysis || !result->question->analysis->has_initial)
        if (!nh_defaults_initial(result, &initial, &trouble)) {
            nh_analysis_warn(result, "no motion was computed: %s", trouble.what);
            return;
        }
    nh_ex *phi = nh_arena_alloc(result->arena, (list->count + 1) * sizeof *phi);
    nh_valid *valid = nh_arena_alloc(result->arena, (list->count + 1) * sizeof *valid);
    for (size_t k = 0; k < list->count; k++) {
        const nh_series *series = list->found[k].series;
        phi[k] = list->found[k].phi;
        if (series) valid[k] = (nh_valid){series->variable, series->low, series->high};
    }
    const nh_observable *watch = list_tracks(result);
    nh_choice choice = {.system = result->question->system, .model = result->question->model};
    nh_choice_open(&choice, true);
    nh_validation_request request = {.model = result->question->model,
                                     .other = result->question->other,
                                     .currents = list->count,
                                     .current = phi,
                                     .valid = valid,
                                     .watches = result->tracks.count,
                                     .watch = watch,
                                     .initial = &initial,
                                     .until = end_of_motion(result, &initial),
                                     .outputs = motion_outputs,
                                     .options = &result->question->options,
                                     .accuracy = q->accuracy,
                                     .ways = &choice.ways};
    result->validation = nh_validate(&request, &trouble);
    nh_choice_close(&choice);
    if (!result->validation) {
        nh_analysis_warn(result, "no motion was computed: %s", trouble.what);
        return;
    }
    for (size_t k = 0; k < list->count; k++) {
        nh_current_list_describe(result, &list->found[k])->drift = result->validation->current[k];
        if (list->found[k].drift.in_doubles > 0)
            nh_analysis_warn(result,
                             "the formula of %s loses digits along the test motion: its values in double precision "
                             "change by %.1e; with 77 digits, along the same motion, they change by %.1e",
                             list->found[k].name, list->found[k].drift.in_doubles,
                             list->found[k].drift.drift[NH_DRIFT_RUNS - 1]);
        if (!list->found[k].drift.explained) say_drift(result, &list->found[k]);
    }
    nh_motion_series_add(result);
    if (result->validation->note[0]) nh_analysis_warn(result, "%s", result->validation->note);
    if (result->validation->checked && !result->validation->accuracy.held)
        nh_analysis_warn(result, "%s", result->validation->accuracy.why);
}

/* An upper bound for the dimension of the space of currents polynomial in the velocities of degree two, with functions
 * of t as coefficients where these were counted. */
static size_t counted_currents(const nh_analysis *result)
{
    for (size_t k = NH_COMPLETENESS_KINDS; k-- > 0;) {
        const nh_count *c = &result->completeness[k].count;
        if (result->completeness[k].counted && !c->obstacle && c->rows >= 2 && c->row[1].bounded)
            return c->row[1].bound;
    }
    return 0;
}

/* The geometry, with the brackets of the currents that have a field in closed form. */
static void write_out(nh_analysis *result)
{
    nh_progress("the geometry", -1);
    nh_named_current *list =
        nh_arena_alloc(result->arena, (result->list->count + result->list->furthers + 1) * sizeof *list);
    size_t count = 0;
    result->theory = nh_theory_of(result->arena, result->question->model, result->question->other, result->list->count,
                                  &result->question->options);
    for (size_t k = 0; k < result->list->count; k++) {
        const nh_current *f = &result->list->found[k];
        if (f->has_symmetry && !f->series) nh_theory_add(result->arena, result->theory, f->name, &f->symmetry);
        if (f->proof.proved && !f->series) list[count++] = (nh_named_current){f->name, f->phi, f->energy};
    }
    for (size_t k = 0; k < result->list->furthers; k++) {
        const nh_current *f = &result->list->further[k].current;
        if (f->proof.proved && !f->series) list[count++] = (nh_named_current){f->name, f->phi, f->energy};
    }
    if (!nh_late())
        nh_theory_space(result->arena, result->theory, count, list, counted_currents(result),
                        &result->question->options);
}

/* ---- the steps of an analysis ---- */

static void say_what_ended_it(nh_analysis *result)
{
    char words[80];
    const char *option = nh_ended_option();
    nh_ended_words(words, sizeof words);
    result->partial = true;
    bool bare = result->list->count && !result->list->found[0].has_symmetry;
    nh_analysis_warn(result, "%s: the results are partial%s%s%s%s", words,
                     bare ? ", without the symmetries of the currents" : "",
                     result->validation ? "" : ", and no motion was computed", option ? "; raise the limit by " : "",
                     option ? option : "");
}

static bool run(nh_analysis *result, nh_analysis_question *question, const nh_request *q, nh_error *error)
{
    double start = nh_clock(), clock = start;
    question->options = q->options;
    question->left_out = q->left_out;
    question->command = q->line ? nh_arena_strdup(result->arena, q->line) : NULL;
    question->system_path = nh_arena_strdup(result->arena, q->system_path);
    if (q->system_words) question->system_words = nh_arena_strdup(result->arena, q->system_words);
    question->analysis_path = q->analysis_path ? nh_arena_strdup(result->arena, q->analysis_path) : NULL;
    nh_progress("the system file", -1);
    if (!read_files(result, question, q, error)) return false;
    merge_options(question, q);
    result->timing.read = lap(&clock);
    nh_progress("the equations of motion", -1);
    nh_budget_begin(question->options.work);
    bool made = nh_analyze_models(result, question, q, error);
    nh_budget_begin(INFINITY);
    if (!made) return false;
    nh_deadline_set(question->options.max_seconds);
    merge_options(question, q); /* now the motion of the analysis is known, too */
    if (!choose_grid(result, question, q, error)) return false;
    result->timing.geometry = lap(&clock);
    if (q->model_only) return true;
    size_t families = question->analysis ? question->analysis->families : 0;
    nh_family *family = question->analysis ? question->analysis->family : NULL;
    if (families == 0) {
        result->ansatz_note = "chosen by the program: stages made of the system's own functions";
        if (!nh_staged_search_run(result, error)) return false;
        result->timing.nullspace = lap(&clock);
        watch_deadline(result);
        if (!nh_late()) nh_missing_count(result, true);
    } else {
        result->ansatz_note = "as given in the analysis file";
        nh_progress("the ansatz of the analysis file", -1);
        bool solved = nh_specials_find(result, &families, &family, error);
        result->timing.unknowns = lap(&clock);
        solved = solved && linear_problem(result, families, family, &clock, error);
        if (!solved && !nh_late()) return false;
        if (!solved) nh_error_clear(error);
        result->search = !solved                                                ? NH_SEARCH_CUT
                         : result->list->independent >= question->local_maximum ? NH_SEARCH_COMPLETE
                                                                                : NH_SEARCH_EXHAUSTED;
        if (!go_on(result, error)) return false;
    }
    if (!nh_late()) nh_agreement_find(result);
    if (!nh_interrupted()) nh_symmetries_find(result);
    conclude(result);
    nh_integrals_of_constraints(result);
    nh_branch_compare(result);
    if (!nh_interrupted()) nh_analyze_known(result);
    nh_progress("a motion to check it", -1);
    if (!nh_interrupted()) validate(result, q);
    if (!nh_interrupted() && q->equations) write_out(result);
    if (!nh_interrupted() && q->documents) nh_figures_compute(result, q, families, family);
    if (nh_interrupted()) say_what_ended_it(result);
    result->timing.validation = lap(&clock);
    result->timing.total = nh_clock() - start;
    return true;
}

nh_analysis *nh_analysis_create(const nh_request *request, nh_error *error)
{
    nh_linalg_threads(1);
    nh_arena *arena = nh_arena_create();
    nh_analysis *result = nh_arena_alloc(arena, sizeof *result);
    nh_analysis_question *question = nh_arena_alloc(arena, sizeof *question);
    result->arena = arena;
    result->question = question;
    nh_current_list_begin(result);
    bool good = run(result, question, request, error);
    nh_deadline_set(INFINITY);
    nh_budget_begin(INFINITY);
    if (good) return result;
    nh_analysis_free(result);
    return NULL;
}

#include "commands/analyze.h"

#include <math.h>
#include <string.h>

#include "motion/trajectory.h"
#include "base/budget.h"
#include "base/clock.h"
#include "base/linalg.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "search/agreement.h"
#include "search/branch.h"
#include "search/coefficients.h"
#include "search/currents.h"
#include "search/defaults.h"
#include "commands/analyze_known.h"
#include "commands/analyze_models.h"
#include "commands/figures.h"
#include "search/constraint_integrals.h"
#include "search/staged_search.h"
#include "search/symmetries.h"
#include "search/missing.h"
#include "search/motion_series.h"
#include "search/routes.h"
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

static void merge_options(nh_analysis *r, const nh_request *q)
{
    const nh_analysis_file *a = r->analysis;
    r->options = q->options;
    if (r->pace > 0 && !q->until_given) r->options.until /= r->pace;
    if (!a) return;
    if (a->has_seed && !q->seed_given) r->options.seed = a->seed;
    if (a->has_samples && !q->samples_given) r->options.samples = a->samples;
    if (a->has_tolerance && !q->tolerance_given) r->options.tolerance = a->tolerance;
    if (a->has_until && !q->until_given) r->options.until = a->until;
}

static bool read_files(nh_analysis *r, const nh_request *q, nh_error *error)
{
    if (q->analysis_path && !(r->analysis = nh_analysis_file_read(q->analysis_path, error))) return false;
    size_t own = r->analysis ? r->analysis->settings : 0;
    nh_setting *setting = nh_arena_alloc(r->arena, (own + q->settings + 1) * sizeof *setting);
    if (own) memcpy(setting, r->analysis->setting, own * sizeof *setting);
    if (q->settings) memcpy(setting + own, q->setting, q->settings * sizeof *setting);
    r->system = nh_system_read(q->system_path, own + q->settings, setting, error);
    for (size_t i = 0; r->system && i < r->system->notes; i++) nh_analysis_warn(r, "%s", r->system->note[i]);
    return r->system != NULL;
}

/* ---- the linear problem ---- */

static nh_points *fit_points(nh_analysis *r, size_t columns, nh_error *error)
{
    size_t count = (size_t)r->options.samples;
    if (count == 0) count = samples_per_column * columns;
    if (count < least_samples) count = least_samples;
    if (count < columns + 16) count = columns + 16;
    return nh_points_cover(r->model, count, (uint64_t)r->options.seed, error);
}

static nh_nullspace *current_route(nh_analysis *r, const nh_ansatz *a, const nh_points *points, nh_error *error)
{
    nh_equations *equations = nh_equations_create(a->columns, nh_threads(r->options.threads));
    nh_rows *rows = nh_rows_create(r->model, a, 0, NULL);
    nh_rows_current(rows, points, NULL, equations);
    nh_nullspace_options limits = nh_nullspace_options_from(&r->options);
    nh_nullspace *s = nh_nullspace_solve(equations, &limits, error);
    nh_rows_free(rows);
    nh_equations_free(equations);
    if (s) r->current = nh_spectrum_of(r->arena, s);
    return s;
}

/* Takes the null vectors; where the spectrum is in doubt also the likely ones, about which a certificate decides. */
static void collect(nh_analysis *r, nh_current_checker *bench, const nh_ansatz *a, const nh_points *points,
                    const nh_nullspace *s)
{
    bool sure = s->likely == s->dimension;
    nh_candidates *list = nh_echelon(r->model, points, a, s, sure ? s->dimension : s->likely, &r->options);
    for (size_t k = 0; k < list->count; k++) nh_currents_add(bench, &list->candidate[k], points, sure);
    nh_currents_join(bench, points);
    nh_candidates_free(list);
}

static bool linear_problem(nh_analysis *r, size_t families, const nh_family *family, double *clock, nh_error *error)
{
    nh_points *ranges = nh_points_create(r->model, least_samples, 1, (uint64_t)r->options.seed, error);
    if (!ranges) return false;
    nh_ansatz *a = nh_ansatz_create(r->model, ranges, families, family, (size_t)r->options.columns, error);
    nh_points_free(ranges);
    if (!a) return false;
    nh_points *points = fit_points(r, a->columns, error);
    r->timing.samples = lap(clock);
    nh_nullspace *s = points ? current_route(r, a, points, error) : NULL;
    bool good = s != NULL;
    if (good) {
        r->samples = points->count;
        r->beyond = nh_points_equations(points) - points->count;
        r->rejected = points->tried - nh_points_equations(points);
        if (r->route != NH_ROUTE_CURRENT) nh_routes_compare(r, a, points, s);
        r->timing.nullspace = lap(clock);
        nh_current_checker *bench = nh_current_checker_create(r, error);
        good = bench != NULL;
        nh_agreement_keep(r, families, family, a, s);
        if (good) collect(r, bench, a, points, s);
        if (good) nh_currents_finish(bench);
        nh_current_checker_free(bench);
        r->timing.currents = lap(clock);
    }
    nh_nullspace_free(s);
    nh_points_free(points);
    nh_ansatz_free(a);
    return good;
}

/* After the deadline anything may be missing. */
static void watch_deadline(nh_analysis *r)
{
    bool late = nh_late() && r->search != NH_SEARCH_COMPLETE;
    if (late) r->search = NH_SEARCH_CUT;
    if (late && !nh_interrupted()) {
        r->partial = true;
        nh_analysis_warn(r, "the time limit of %g s ended the search; raise it by --max-seconds",
                         r->options.max_seconds);
    }
    nh_deadline_set(INFINITY);
}

/* Where the ansatz of the user holds currents, and more can exist, the program's own search follows, and what the count
 * says is missing; the numbers of the problem remain those of the ansatz. */
static bool go_on(nh_analysis *r, nh_error *error)
{
    nh_spectrum given = r->current;
    size_t samples = r->samples, beyond = r->beyond, rejected = r->rejected;
    bool searched = r->count && !r->analysis->alone && r->search == NH_SEARCH_EXHAUSTED && !nh_late();
    if (searched && !nh_staged_search_run(r, error)) return false;
    watch_deadline(r);
    if (!nh_late()) nh_missing_count(r, r->stages > 0);
    r->current = given;
    r->samples = samples, r->beyond = beyond, r->rejected = rejected;
    return true;
}

/* FOUND needs a certificate for every current; NONE needs that no null vector and no omitted stage is left open. */
static void conclude(nh_analysis *r)
{
    bool kept_out = r->search == NH_SEARCH_CUT || (r->search != NH_SEARCH_COMPLETE && nh_analysis_left_out(r)),
         open = r->open > 0 || kept_out || nh_analysis_by_trial(r), failed = r->count == 0 && r->current.dimension > 0;
    r->verdict = r->count || nh_analysis_to_the_end(r) ? NH_FOUND
                 : open || failed || r->pieces         ? NH_UNDECIDED
                                                       : NH_NONE;
    if (r->count == 0 && kept_out)
        nh_analysis_warn(r, "stages beyond a limit may contain further currents%s",
                         nh_analysis_left_out(r) ? ": the list of stages names the options to raise" : "");
    if (r->count == 0 && r->open)
        nh_analysis_warn(
            r, "some null vectors have no certificate: to decide, use another ansatz or more samples (--samples)");
    if (r->current.rank_in_doubt && (!r->stages || (r->analysis && r->analysis->families)))
        nh_analysis_warn(r, "two columns of the ansatz are nearly dependent: the option `rank` decides which are kept");
}

/* ---- the motion ---- */

static const nh_observable *list_tracks(nh_analysis *r)
{
    nh_observables *t = &r->tracks;
    *t = nh_observables_create(r->arena, r->model);
    nh_observables_add_states(t);
    nh_observables_add(t, "E", NH_TRACK_ENERGY, r->model->E);
    for (size_t k = 0; k < r->count; k++) nh_observables_add(t, r->found[k].name, NH_TRACK_CURRENT, r->found[k].phi);
    nh_observables_add_drawing(t, r->analysis);
    nh_observables_add_watches(t, r->analysis);
    nh_observable *watch = nh_arena_alloc(r->arena, (t->count + 1) * sizeof *watch);
    for (size_t i = 0; i < t->count; i++)
        watch[i] = (nh_observable){t->track[i].name, t->track[i].value, t->track[i].kind == NH_TRACK_WATCH,
                                   t->track[i].kind == NH_TRACK_CURRENT || t->track[i].kind == NH_TRACK_ENERGY};
    return watch;
}

/* A drift that does not fall with the tolerance.  A current that is proved is constant: then its formula magnifies the
 * error of the motion (x exp(t) along x = exp(-t), whose error is absolute), or its value does not fit into a
 * double. */
static void say_drift(nh_analysis *r, const nh_current *f)
{
    double drift = f->drift.drift[NH_DRIFT_RUNS - 1];
    if (!isfinite(drift))
        nh_analysis_warn(r, "%s has no finite value at some states of the test motion in double precision", f->name);
    else if (f->proof.proved)
        nh_analysis_warn(r,
                         "%s drifts by %.1e along the test motion, more than %g tolerances, and hardly less at smaller "
                         "ones: it is proved to be constant, so this is the error of the motion, which the formula "
                         "magnifies",
                         f->name, drift, r->options.drift);
    else
        nh_analysis_warn(r,
                         "%s drifts by %.1e along the test motion, more than %g tolerances; the drift hardly falls "
                         "with the tolerance, so it is not the error of the motion",
                         f->name, drift, r->options.drift);
}

/* The end of the test motion: at the latest the place where it has an impulse, which a warning names. */
static double end_of_motion(nh_analysis *r, const nh_state *initial)
{
    static const double before = 1e-9; /* part of the time to the impulse */
    double end = r->options.until, times[2] = {initial->t, end};
    nh_terrain terrain = nh_terrain_of(r->model, &r->options, r->arena);
    nh_error ignored;
    nh_error_clear(&ignored);
    if (!terrain.impulses || !(end > initial->t)) return end;
    nh_trajectory_request request = {.model = r->model,
                                     .initial = initial,
                                     .count = 2,
                                     .times = times,
                                     .options = &r->options,
                                     .impulses = terrain.impulses,
                                     .impulse = terrain.impulse};
    nh_trajectory *motion = nh_trajectory_create(&request, &ignored);
    double reached = motion ? motion->motion->end_time : end;
    if (reached > initial->t && reached < end) {
        end = reached - before * (reached - initial->t);
        nh_analysis_warn(r, "the test motion ends at t = %.6g: %s", reached, motion->motion->note);
    }
    nh_trajectory_free(motion);
    return end;
}

static void validate(nh_analysis *r, const nh_request *q)
{
    nh_error trouble;
    nh_error_clear(&trouble);
    nh_state initial = r->analysis ? r->analysis->initial : (nh_state){0};
    if (!r->analysis || !r->analysis->has_initial)
        if (!nh_defaults_initial(r, &initial, &trouble)) {
            nh_analysis_warn(r, "no motion was computed: %s", trouble.what);
            return;
        }
    nh_ex *phi = nh_arena_alloc(r->arena, (r->count + 1) * sizeof *phi);
    nh_valid *valid = nh_arena_alloc(r->arena, (r->count + 1) * sizeof *valid);
    for (size_t k = 0; k < r->count; k++) {
        const nh_series *series = r->found[k].series;
        phi[k] = r->found[k].phi;
        if (series) valid[k] = (nh_valid){series->variable, series->low, series->high};
    }
    const nh_observable *watch = list_tracks(r);
    nh_choice choice = {.system = r->system, .model = r->model};
    nh_choice_open(&choice, true);
    nh_validation_request request = {.model = r->model,
                                     .other = r->other,
                                     .currents = r->count,
                                     .current = phi,
                                     .valid = valid,
                                     .watches = r->tracks.count,
                                     .watch = watch,
                                     .initial = &initial,
                                     .until = end_of_motion(r, &initial),
                                     .outputs = motion_outputs,
                                     .options = &r->options,
                                     .accuracy = q->accuracy,
                                     .ways = &choice.ways};
    r->validation = nh_validate(&request, &trouble);
    nh_choice_close(&choice);
    if (!r->validation) {
        nh_analysis_warn(r, "no motion was computed: %s", trouble.what);
        return;
    }
    for (size_t k = 0; k < r->count; k++) {
        r->found[k].drift = r->validation->current[k];
        if (r->found[k].drift.in_doubles > 0)
            nh_analysis_warn(r,
                             "the formula of %s loses digits along the test motion: its values in double precision "
                             "change by %.1e; with 77 digits, along the same motion, they change by %.1e",
                             r->found[k].name, r->found[k].drift.in_doubles,
                             r->found[k].drift.drift[NH_DRIFT_RUNS - 1]);
        if (!r->found[k].drift.explained) say_drift(r, &r->found[k]);
    }
    nh_motion_series_add(r);
    if (r->validation->note[0]) nh_analysis_warn(r, "%s", r->validation->note);
    if (r->validation->checked && !r->validation->accuracy.held) nh_analysis_warn(r, "%s", r->validation->accuracy.why);
}

/* An upper bound for the dimension of the space of currents polynomial in the velocities of degree two, with functions
 * of t as coefficients where these were counted. */
static size_t counted_currents(const nh_analysis *r)
{
    for (size_t k = NH_COMPLETENESS_KINDS; k-- > 0;) {
        const nh_count *c = &r->completeness[k].count;
        if (r->completeness[k].counted && !c->obstacle && c->rows >= 2 && c->row[1].bounded) return c->row[1].bound;
    }
    return 0;
}

/* The geometry, with the brackets of the currents that have a field in closed form. */
static void write_out(nh_analysis *r)
{
    nh_progress("the geometry", -1);
    nh_named_current *list = nh_arena_alloc(r->arena, (r->count + r->furthers + 1) * sizeof *list);
    size_t count = 0;
    r->theory = nh_theory_of(r->arena, r->model, r->other, r->count, &r->options);
    for (size_t k = 0; k < r->count; k++) {
        const nh_current *f = &r->found[k];
        if (f->has_symmetry && !f->series) nh_theory_add(r->arena, r->theory, f->name, &f->symmetry);
        if (f->proof.proved && !f->series) list[count++] = (nh_named_current){f->name, f->phi, f->energy};
    }
    for (size_t k = 0; k < r->furthers; k++) {
        const nh_current *f = &r->further[k].current;
        if (f->proof.proved && !f->series) list[count++] = (nh_named_current){f->name, f->phi, f->energy};
    }
    if (!nh_late()) nh_theory_space(r->arena, r->theory, count, list, counted_currents(r), &r->options);
}

/* ---- the steps of an analysis ---- */

static void say_what_ended_it(nh_analysis *r)
{
    char words[80];
    const char *option = nh_ended_option();
    nh_ended_words(words, sizeof words);
    r->partial = true;
    bool bare = r->count && !r->found[0].has_symmetry;
    nh_analysis_warn(r, "%s: the results are partial%s%s%s%s", words,
                     bare ? ", without the symmetries of the currents" : "",
                     r->validation ? "" : ", and no motion was computed", option ? "; raise the limit by " : "",
                     option ? option : "");
}

static bool run(nh_analysis *r, const nh_request *q, nh_error *error)
{
    double start = nh_clock(), clock = start;
    r->options = q->options;
    r->left_out = q->left_out;
    r->command = q->line ? nh_arena_strdup(r->arena, q->line) : NULL;
    r->system_path = nh_arena_strdup(r->arena, q->system_path);
    if (q->system_words) r->system_words = nh_arena_strdup(r->arena, q->system_words);
    r->analysis_path = q->analysis_path ? nh_arena_strdup(r->arena, q->analysis_path) : NULL;
    nh_progress("the system file", -1);
    if (!read_files(r, q, error)) return false;
    merge_options(r, q);
    r->route = r->analysis ? r->analysis->route : NH_ROUTE_BOTH;
    r->timing.read = lap(&clock);
    nh_progress("the equations of motion", -1);
    nh_budget_begin(r->options.work);
    bool made = nh_analyze_models(r, q, error);
    nh_budget_begin(INFINITY);
    if (!made) return false;
    nh_deadline_set(r->options.max_seconds);
    merge_options(r, q); /* now the motion of the analysis is known, too */
    r->timing.geometry = lap(&clock);
    if (q->model_only) return true;
    size_t families = r->analysis ? r->analysis->families : 0;
    nh_family *family = r->analysis ? r->analysis->family : NULL;
    if (families == 0) {
        r->ansatz_note = "chosen by the program: stages made of the system's own functions";
        if (!nh_staged_search_run(r, error)) return false;
        r->timing.nullspace = lap(&clock);
        watch_deadline(r);
        if (!nh_late()) nh_missing_count(r, true);
    } else {
        r->ansatz_note = "as given in the analysis file";
        nh_progress("the ansatz of the analysis file", -1);
        bool solved = nh_specials_find(r, &families, &family, error);
        r->timing.unknowns = lap(&clock);
        solved = solved && linear_problem(r, families, family, &clock, error);
        if (!solved && !nh_late()) return false;
        if (!solved) nh_error_clear(error);
        r->search = !solved                              ? NH_SEARCH_CUT
                    : r->independent >= r->local_maximum ? NH_SEARCH_COMPLETE
                                                         : NH_SEARCH_EXHAUSTED;
        if (!go_on(r, error)) return false;
    }
    if (!nh_late()) nh_agreement_find(r);
    if (!nh_interrupted()) nh_symmetries_find(r);
    conclude(r);
    nh_integrals_of_constraints(r);
    nh_branch_compare(r);
    if (!nh_interrupted()) nh_analyze_known(r);
    nh_progress("a motion to check it", -1);
    if (!nh_interrupted()) validate(r, q);
    if (!nh_interrupted() && q->equations) write_out(r);
    if (!nh_interrupted() && q->documents) nh_figures_compute(r, q, families, family);
    if (nh_interrupted()) say_what_ended_it(r);
    r->timing.validation = lap(&clock);
    r->timing.total = nh_clock() - start;
    return true;
}

nh_analysis *nh_analysis_create(const nh_request *request, nh_error *error)
{
    nh_linalg_threads(1);
    nh_arena *arena = nh_arena_create();
    nh_analysis *r = nh_arena_alloc(arena, sizeof *r);
    r->arena = arena;
    bool good = run(r, request, error);
    nh_deadline_set(INFINITY);
    nh_budget_begin(INFINITY);
    if (good) return r;
    nh_analysis_free(r);
    return NULL;
}

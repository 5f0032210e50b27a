#include "commands/simulate_internal.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/clock.h"
#include "graph/dag.h"

#include "graph/diff.h"
#include "graph/terms.h"
#include "integrals/region.h"

enum { default_outputs = 100, most_outputs = 10000000, most_comparisons = 4 };
/* units of effort: a motion that needs less is compared with that of the whole model, which may need as much */
static const double small_motion = 1e8, most_whole = 1e9;
static const double repeated = 0.1; /* seconds: shorter comparisons are repeated */

/* ---- which quantities are wanted along the motion ---- */

/* "y, T = m/2*v^2" */
static bool read_watch(nh_simulation *s, const char *typed, nh_error *error)
{
    const nh_model *model = s->model;
    nh_ex taken;
    nh_named extra[2];
    size_t extras = 0;
    if (!nh_symbol_find(model->dag, "E", &taken)) extra[extras++] = (nh_named){.name = "E", .value = model->E};
    if (!nh_symbol_find(model->dag, "Lbar", &taken)) extra[extras++] = (nh_named){.name = "Lbar", .value = model->Lbar};
    for (const char *text = typed, *end; *text; text = end + (*end != 0)) {
        end = text + nh_text_entry(text, ",;");
        const char *equal = memchr(text, '=', (size_t)(end - text)), *to = equal ? equal : end;
        while (text < to && *text == ' ') text++;
        while (to > text && to[-1] == ' ') to--;
        nh_ex e;
        const char *name = nh_arena_strndup(s->arena, text, (size_t)(to - text)), *right = equal ? equal + 1 : text;
        if (!nh_system_expression_part(s->system, "--watch", typed, (size_t)(right - typed), (size_t)(end - right),
                                       extras, extra, &e, error))
            return false;
        if (!nh_analysis_file_to_chart(model, e, &e, error)) return false;
        nh_observables_add(&s->columns, nh_deck_spelled_all(s->arena, name), NH_TRACK_WATCH, e);
    }
    if (s->columns.count) return true;
    nh_fail(error, NH_USAGE, "", "--watch names no quantity");
    return nh_error_hint(error, "--watch \"%s, E\"", s->system->coordinate[0].name);
}

static bool read_scene(nh_simulation *s, nh_error *error)
{
    nh_observables_add_watches(&s->columns, s->analysis);
    if (s->columns.count) return true;
    nh_fail(error, NH_USAGE, "", "--scene needs an analysis file with a list `watch`");
    return nh_error_hint(error, "use --watch \"%s\" instead", s->system->coordinate[0].name);
}

static void list_columns(nh_simulation *s, const char *also, bool draw)
{
    const nh_model *model = s->model;
    nh_observables *t = &s->columns;
    nh_error ignored;
    nh_error_clear(&ignored);
    nh_observables_add_states(t);
    for (size_t k = 0; k < s->system->currents; k++) {
        const nh_named *known = &s->system->current[k];
        nh_ex e;
        if (!known->unwatched && nh_analysis_file_to_chart(model, known->value, &e, &ignored))
            nh_observables_add(t, known->name, NH_TRACK_CURRENT, e);
    }
    for (size_t a = 0; a < model->k; a++)
        nh_observables_add(t, nh_arena_printf(s->arena, "c%zu", a + 1), NH_TRACK_MULTIPLIER, model->mu[a]);
    nh_observables_add(t, "E", NH_TRACK_ENERGY, model->E);
    nh_observables_add_watches(t, s->analysis);
    nh_ex e;
    if (also && nh_system_expression_text(s->system, "", also, 0, NULL, &e, &ignored) &&
        nh_analysis_file_to_chart(model, e, &e, &ignored))
        nh_observables_add(t, "Phi", NH_TRACK_WATCH, e);
    if (draw) nh_observables_add_drawing(t, s->analysis);
}

static double *output_times(nh_simulation *s, const nh_request *q, double begin, double end, size_t *count,
                            nh_error *error)
{
    double span = fabs(end - begin), step = q->step > 0 ? q->step : span / default_outputs,
           steps = ceil(span / step * (1 - 1e-12));
    if (!(span > 0) || !(steps < most_outputs)) {
        nh_fail(error, NH_USAGE, "",
                span > 0 ? "the output step %g is too small for the time %g"
                         : "the motion ends where it begins (t = %g)",
                span > 0 ? step : end, span);
        return NULL;
    }
    *count = (size_t)steps + 1;
    double *times = nh_arena_alloc(s->arena, *count * sizeof *times);
    for (size_t i = 0; i < *count; i++)
        times[i] = i + 1 == *count ? end : begin + (end > begin ? step : -step) * (double)i;
    return times;
}

static bool choose_columns(nh_simulation *s, const nh_request *q, nh_error *error)
{
    s->columns = nh_observables_create(s->arena, s->model);
    if (q->watch) return read_watch(s, q->watch, error);
    if (q->scene) return read_scene(s, error);
    list_columns(s, q->current, q->draw && !q->ensemble);
    return true;
}

/* The largest error of the observables, relative to the size that they have along the motion. */
static double difference_from(const nh_simulation *s, const nh_trajectory_request *q, const nh_trajectory *t)
{
    nh_dynamics *d = nh_dynamics_create(s->model);
    double worst = 0, *size = nh_alloc_array(q->n + 1, sizeof *size);
    bool known = nh_trajectory_sizes(d, t->motion, q->n, q->e, size);
    for (size_t k = 0; known && k < q->n * t->motion->count; k++) {
        double off = fabs(s->value[k] - t->value[k]);
        if (off > 0 && isfinite(off)) worst = fmax(worst, off / size[k % q->n]);
    }
    nh_free(size);
    nh_dynamics_free(d);
    return worst;
}

/* How much the smallest model saves, and whether it is right: the whole model is integrated, too, where that costs
 * little. */
static void compare_with_whole(nh_simulation *s, const nh_trajectory_request *q)
{
    nh_trajectory_request whole = *q;
    nh_error ignored;
    nh_error_clear(&ignored);
    whole.smallest = false;
    whole.max_effort = most_whole;
    if (!s->trajectory->scene || s->motion->effort > small_motion || !s->motion->complete) return;
    double begin = nh_clock(), few = s->motion->seconds, all = INFINITY;
    /* the least times: other programs run, too */
    for (int i = 0; i < most_comparisons && (i == 0 || nh_clock() - begin < repeated); i++) {
        nh_trajectory *t = nh_trajectory_create(&whole, &ignored),
                      *again = i ? nh_trajectory_create(q, &ignored) : NULL;
        bool complete = t && t->motion->complete;
        if (i == 0) s->compared = complete;
        if (complete && i == 0) s->whole_difference = difference_from(s, &whole, t);
        if (complete) all = fmin(all, t->motion->seconds), s->whole_evaluations = t->motion->evaluations;
        if (again) few = fmin(few, again->motion->seconds);
        nh_trajectory_free(again);
        nh_trajectory_free(t);
    }
    s->scene_seconds = few;
    s->whole_seconds = all;
}

/* The currents that the system file knows, in the model's chart, and the momenta p_s xi^s of its symmetries: the
 * smallest model may use those that are conserved. */
static size_t known_currents(nh_simulation *s, nh_ex **out)
{
    nh_error ignored;
    nh_dag *d = s->model->dag;
    size_t n = 0, m = s->model->m;
    *out = nh_arena_alloc(s->arena, (s->system->currents + s->system->symmetries + 1) * sizeof **out);
    for (size_t i = 0; i < s->system->symmetries; i++) {
        nh_ex momentum = nh_int(d, 0);
        for (size_t j = 0; j < m; j++)
            momentum = nh_add(d, momentum, nh_mul(d, s->model->p[j], s->system->symmetry[i * m + j]));
        (*out)[n++] = momentum;
    }
    for (size_t k = 0; k < s->system->currents; k++) {
        const nh_named *known = &s->system->current[k];
        nh_error_clear(&ignored);
        n += !known->unwatched && nh_analysis_file_to_chart(s->model, known->value, &(*out)[n], &ignored);
    }
    return n;
}

/* The candidates from which the method is chosen. */
static void open_choice(nh_simulation *s, const nh_request *q, bool plain)
{
    s->ways = (nh_choice){.system = s->system,
                          .model = s->model,
                          .seed = (uint64_t)q->options.seed,
                          .may_derive = q->chart == NH_CHART_AUTO,
                          .deriving = s->deriving};
    nh_choice_open(&s->ways, plain);
}

/* The method of the request, with its steps from one output to the next where these are fixed. */
static bool use_method(nh_simulation *s, const nh_request *q, const double *times, nh_trajectory_request *request,
                       nh_error *error)
{
    const nh_method *method = request->method = q->methods ? q->method[0] : NULL;
    if (!method) return true;
    if (q->accuracy > 0 || q->ensemble) {
        nh_fail(error, NH_USAGE, "", "%s, and --method as well",
                q->ensemble ? "an ensemble has its own methods" : "--accuracy chooses the method");
        return nh_error_hint(error, "leave one of the two options out");
    }
    if (!method->order) return true;
    request->programs = s->programs = nh_programs_create(s->model);
    request->step = (times[1] - times[0]) / q->options.fixed_steps;
    s->fixed_step = fabs(request->step);
    const char *refused = nh_method_refused(method, s->programs);
    if (!refused) return true;
    nh_fail(error, NH_NUMERIC, "", "the method `%s` cannot be used here: %s", method->word, refused);
    return nh_error_hint(error, "`nhsym explain methods` lists the others");
}

/* A note where steps of a fixed length are so long that what the motion conserves changes by a hundredth of the size of
 * its terms, or, where these nearly cancel, by as much as it is and more than small errors are. */
static void note_drift(nh_simulation *s, const nh_trajectory_request *q)
{
    static const double gross = 0.01, small = 1e-4;
    nh_motion *motion = s->motion;
    size_t n = q->n, worst = n;
    double most = 0, reached = 0, *size = nh_alloc_array(n + 1, sizeof *size);
    nh_dynamics *d = nh_dynamics_create(s->model);
    bool known = nh_trajectory_sizes(d, motion, n, q->e, size);
    for (size_t k = 0; k < n && known; k++) {
        double drift = 0, far = s->value[k];
        if (!(size[k] > 0) || !nh_dependency_graph_conserved(s->model, q->e[k])) continue;
        for (size_t i = 0; i < motion->count; i++)
            if (fabs(s->value[i * n + k] - s->value[k]) > drift)
                far = s->value[i * n + k], drift = fabs(far - s->value[k]);
        bool lost = drift > gross * size[k] || (drift > small * size[k] && drift > fabs(s->value[k]));
        if (lost && drift > most * size[k]) most = drift / size[k], reached = far, worst = k;
    }
    if (worst < n)
        nh_motion_note(motion,
                       "%.60s is conserved, but goes from %.3g to %.3g along this motion: the fixed step %g is too "
                       "long; give a shorter --step or more fixed_steps, or leave --method out",
                       s->columns.track[worst].name, s->value[worst], reached, s->fixed_step);
    nh_dynamics_free(d);
    nh_free(size);
}

/* Curves through the rows of a short table would be polygons. */
static void draw_finely(nh_simulation *s, const nh_request *q, const nh_trajectory_request *request)
{
    enum { enough = 801 }; /* the page shows every second one, with the last */
    const nh_motion *m = s->motion;
    if (!q->picture || s->fixed_step > 0 || m->count < 2 || m->count >= enough) return;
    nh_trajectory_request fine = *request;
    nh_options options = *request->options;
    nh_error ignored;
    nh_error_clear(&ignored);
    double *times = nh_alloc_array(enough, sizeof *times), begin = m->time[0], span = m->time[m->count - 1] - begin;
    for (size_t i = 0; i < enough; i++) times[i] = begin + span * (double)i / (enough - 1);
    options.tolerance = s->tolerance;
    fine.options = &options, fine.method = nh_method_find(s->method);
    fine.count = enough, fine.times = times;
    fine.events = 0;
    s->drawn = nh_trajectory_create(&fine, &ignored);
    if (s->drawn && !s->drawn->motion->complete) nh_trajectory_free(s->drawn), s->drawn = NULL;
    nh_free(times);
}

/* Functions at whose zeros motions have an impulse, in the simulation's memory; returns their number.  Where the
 * Lagrangian jumps, or the constraints begin to allow other velocities, the velocities of a motion jump.  The equations
 * of motion on the two sides do not determine the jump, so motions end there (integrals/region.h). */
static size_t impulses_of(nh_simulation *s, const nh_options *options, const nh_ex **impulse)
{
    nh_terrain *terrain = nh_arena_alloc(s->arena, sizeof *terrain);
    *terrain = nh_terrain_of(s->model, options, s->arena);
    *impulse = terrain->impulse;
    return terrain->impulses;
}

const nh_trajectory *nh_simulation_drawn(const nh_simulation *s) { return s->drawn ? s->drawn : s->trajectory; }

static bool integrate(nh_simulation *s, const nh_request *q, const nh_state *initial, size_t count, const double *times,
                      nh_error *error)
{
    nh_options options = q->options;
    options.tolerance = s->tolerance;
    nh_ex *e = nh_arena_alloc(s->arena, (s->columns.count + 1) * sizeof *e);
    for (size_t k = 0; k < s->columns.count; k++) e[k] = s->columns.track[k].value;
    bool *by_terms = nh_arena_alloc(s->arena, (s->columns.count + 1) * sizeof *by_terms);
    for (size_t k = 0; k < s->columns.count; k++)
        by_terms[k] = s->columns.track[k].kind == NH_TRACK_CURRENT || s->columns.track[k].kind == NH_TRACK_ENERGY;
    nh_trajectory_request request = {.model = s->model,
                                     .initial = initial,
                                     .count = count,
                                     .times = times,
                                     .options = &options,
                                     .n = s->columns.count,
                                     .e = e,
                                     .by_terms = by_terms,
                                     .smallest = q->watch || q->scene,
                                     .project = q->project};
    nh_event *event = nh_arena_alloc(s->arena, (s->events + 1) * sizeof *event);
    for (size_t i = 0; i < s->events; i++) event[i] = s->event[i].event;
    request.events = s->events, request.event = event;
    request.impulses = impulses_of(s, &options, &request.impulse);
    nh_ex *known;
    if (!use_method(s, q, times, &request, error)) return false;
    if (request.smallest) request.currents = known_currents(s, &known), request.current = known;
    s->checked = q->accuracy > 0;
    if (s->checked) open_choice(s, q, request.smallest);
    if (q->ensemble) return nh_simulate_many(s, q, &request, error);
    s->trajectory = s->checked ? nh_trajectory_accurate(&request, q->accuracy, &s->ways.ways, &s->accuracy, error)
                               : nh_trajectory_create(&request, error);
    if (!s->trajectory) return false;
    if (s->checked) s->tolerance = s->accuracy.tolerance, s->held = s->accuracy.held, s->why = s->accuracy.why;
    s->motion = s->trajectory->motion;
    s->value = s->trajectory->value;
    s->method = s->trajectory->method;
    s->formulation = s->trajectory->formulation;
    if (s->fixed_step > 0 && s->motion->size == s->model->m + s->model->n) note_drift(s, &request);
    draw_finely(s, q, &request);
    /* the smallest model was tried */
    if (!s->trajectory->scene && request.smallest && !(request.method && request.method->order))
        s->scene = nh_arena_printf(s->arena, "all %zu states integrated, %s: no smaller subsystem reaches the end",
                                   s->motion->size,
                                   strstr(s->formulation, "all coordinates") ? "in all coordinates" : "in the chart");
    if (!s->trajectory->scene) return true;
    s->scene = nh_simulate_words(s, s->trajectory->scene, nh_closed_subsystem_words);
    s->idle = nh_simulate_words(s, s->trajectory->scene, nh_closed_subsystem_idle_words);
    if (!s->checked && !s->events) compare_with_whole(s, &request);
    return true;
}

static nh_simulation *simulate_in_chart(const nh_request *q, nh_error *error)
{
    nh_arena *arena = nh_arena_create();
    nh_simulation *s = nh_arena_alloc(arena, sizeof *s);
    nh_state initial;
    double until, *times = NULL;
    size_t count;
    s->arena = arena;
    s->table = q->rows;
    if (nh_simulate_read(s, q, &initial, &until, error)) times = output_times(s, q, initial.t, until, &count, error);
    if (times) s->violation = nh_simulate_violation(s, &initial, q->project);
    if (times && choose_columns(s, q, error) && nh_simulate_events(s, q, error) &&
        integrate(s, q, &initial, count, times, error))
        return s;
    nh_simulation_free(s);
    return NULL;
}

/* ---- in which velocities? ---- */

/* The number of states that the smallest model for the observables keeps in this chart; SIZE_MAX: not known. *quasi: is
 * it a chart of quasi-velocities? */
static size_t states_kept(const nh_request *q, bool *quasi)
{
    nh_error ignored;
    nh_error_clear(&ignored);
    nh_arena *arena = nh_arena_create();
    nh_simulation *s = nh_arena_alloc(arena, sizeof *s);
    nh_state initial;
    double until;
    size_t kept = SIZE_MAX;
    s->arena = arena;
    if (nh_simulate_read(s, q, &initial, &until, &ignored) && choose_columns(s, q, &ignored)) {
        nh_ex *known, *e = nh_arena_alloc(arena, (s->columns.count + 1) * sizeof *e);
        for (size_t k = 0; k < s->columns.count; k++) e[k] = s->columns.track[k].value;
        size_t count = known_currents(s, &known), n = 0;
        nh_ex *current = nh_arena_alloc(arena, (count + s->model->m + 1) * sizeof *current);
        n = nh_dependency_graph_cyclic(s->model, current);
        for (size_t k = 0; k < count; k++)
            if (nh_dependency_graph_conserved(s->model, known[k])) current[n++] = known[k];
        nh_closed_subsystem *scene = nh_closed_subsystem_create(s->model, s->columns.count, e, n, current);
        kept = scene->kept;
        *quasi = s->model->chart->quasi;
        nh_closed_subsystem_free(scene);
    }
    nh_simulation_free(s);
    return kept;
}

/* Quasi-velocities may couple quantities that are separate in coordinate velocities. */
static bool coordinates_keep_fewer(const nh_request *q)
{
    nh_request other = *q;
    bool quasi = false, ignored;
    size_t kept = states_kept(q, &quasi);
    other.chart = NH_CHART_COORDINATES;
    return quasi && states_kept(&other, &ignored) < kept;
}

nh_simulation *nh_simulation_create(const nh_request *q, nh_error *error)
{
    if ((q->watch || q->scene) && q->chart == NH_CHART_AUTO && !q->ensemble && coordinates_keep_fewer(q)) {
        nh_request other = *q;
        nh_error ignored;
        nh_error_clear(&ignored);
        other.chart = NH_CHART_COORDINATES;
        nh_simulation *s = simulate_in_chart(&other, &ignored);
        /* the chart may end on the way */
        if (s && s->trajectory->scene && s->motion->complete && (!s->checked || s->held)) return s;
        nh_simulation_free(s);
    }
    return simulate_in_chart(q, error);
}

/* Is it a coordinate that is no angle? */
static bool is_position(const nh_simulation *s, size_t column)
{
    const nh_system *system = s->system;
    for (size_t i = 0; i < system->coordinates; i++)
        if (s->columns.track[column].value == system->coordinate[i].q) return system->coordinate[i].type != NH_ANGLE;
    return false;
}

bool nh_simulation_is_path(const nh_simulation *s, size_t x, size_t y)
{
    return is_position(s, x) && is_position(s, y);
}

void nh_simulation_free(nh_simulation *s)
{
    if (!s) return;
    nh_trajectory_free(s->trajectory);
    nh_trajectory_free(s->drawn);
    nh_programs_free(s->programs);
    nh_ensemble_free(s->ensemble);
    nh_choice_close(&s->ways);
    nh_model_free(s->model);
    nh_analysis_file_free(s->analysis);
    nh_system_free(s->system);
    nh_arena_free(s->arena);
}

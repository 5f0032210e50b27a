#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/clock.h"
#include "base/progress.h"
#include "commands/robustness_internal.h"

enum { most_values = 12, most_parameters = 12 };
static const char *const methods[] = {"GSL rk8pd", "GSL rkf45", "ARKODE Dormand-Prince", "CVODE Adams", "CVODE BDF"};
enum { method_count = NH_ROBUSTNESS_METHODS };
static const char *const stepping[] = {"midpoint", "Lagrange-d'Alembert", "Lagrange-d'Alembert, order 4",
                                       "energy-preserving", "relaxation, order 4"};
_Static_assert(sizeof methods / sizeof *methods == method_count && sizeof stepping / sizeof *stepping == method_count,
               "as many of both");
enum { longer_times = 4, longer_by_steps = 3 }; /* entries of `longer`; the first ones, for fixed steps */
static const double longer[longer_times] = {1, 10, 100, 1000}, absolute[] = {1e-9, 1e-6, 1e-3, 1, 1e3, 1e6},
                    parameter[] = {1e-9, 1e-6, 1e-3, 1e-1, 10, 1e3, 1e6};
static const double least_cell = 0.02; /* least number of seconds for a value */

const char *const nh_robustness_no_time = "the budget had no time for it";

bool nh_robustness_late(const nh_robustness_work *w) { return nh_interrupted() || nh_clock() > w->begun + w->budget; }

/* ---- one cell ---- */

static double drift_of(const nh_run_record *m) { return isnan(m->worst_drift) ? 0 : m->worst_drift; }

/* Which safeguard triggered in a run that ended?  NULL: none. */
static const char *guard_of(nh_benchmark_work *b, const nh_candidate_run *k, const nh_run_record *m, double step,
                            const nh_options *o)
{
    nh_arena *arena = b->out->arena;
    nh_run_record tight;
    nh_candidate_run again = *k;
    if (m->status == NH_FLAGGED || m->status == NH_DETECTED) return "the pivot of the chart";
    if (drift_of(m) > o->robustness_error) return nh_arena_printf(arena, "a current drifts by %.0e", drift_of(m));
    nh_benchmark_work_measure(b, &again, step > 0 ? NAN : o->robustness_tolerance / 10, step > 0 ? step / 2 : NAN,
                              &tight);
    if (tight.status == NH_TIMEOUT) b->hurried = true; /* it has no significance */
    if (tight.status == NH_TIMEOUT) return NULL;
    if (tight.status == NH_FAILED)
        return step > 0 ? "half the step does not reach the end" : "a tighter tolerance does not reach the end";
    /* both are compared with the same reference, so that the difference of their errors is a lower bound for that of
     * their states */
    if (fabs(tight.error - m->error) > o->robustness_error / 4)
        return step > 0 ? "half the step gives another motion" : "a tighter tolerance gives another motion";
    return NULL;
}

static void decide(nh_benchmark_work *b, const nh_candidate_run *k, nh_run_record *m, bool reference, double step,
                   const nh_options *o, nh_robustness_cell *cell)
{
    bool ended = m->status != NH_FAILED && m->status != NH_TIMEOUT;
    const char *guard = ended && (reference || !b->hurried) ? guard_of(b, k, m, step, o) : NULL;
    bool good = m->error <= o->robustness_error;
    cell->error = reference ? m->error : NAN;
    cell->drift = m->worst_drift;
    cell->note = guard ? guard : m->note;
    if (!ended) cell->status = m->status;
    else if (b->hurried && !guard && !(reference && good)) {
        cell->status = NH_TIMEOUT;
        cell->note = "there was no time for a reference, or for a tighter run";
    } else if (!reference) {
        cell->status = guard ? NH_DETECTED : NH_FLAGGED;
        if (!guard) cell->note = "no two methods agree on this motion";
    } else cell->status = good ? guard ? NH_FLAGGED : NH_ACCURATE : guard ? NH_DETECTED : NH_UNDETECTED;
}

static void try_method(nh_benchmark_work *b, const char *name, bool in_coordinates, bool reference, double step,
                       const nh_options *o, nh_robustness_cell *cell)
{
    nh_candidate_run k = {.method = nh_method_find(name),
                          .formulation = in_coordinates && b->formulations == NH_BENCHMARK_FORMULATIONS ? 1 : 0};
    nh_run_record m;
    const char *refused = nh_method_refused(k.method, b->formulation[k.formulation].programs);
    if (refused) {
        cell->status = NH_NOT_RUN;
        cell->note = refused;
        return;
    }
    b->hurried &= !reference; /* a lack of time of one method does not affect the next */
    nh_benchmark_work_measure(b, &k, step > 0 ? NAN : o->robustness_tolerance, step > 0 ? step : NAN, &m);
    decide(b, &k, &m, reference, step, o, cell);
}

void nh_robustness_try(nh_robustness_work *w, const nh_request *request, double turn, size_t coordinate,
                       bool in_coordinates, nh_robustness_cell *cell)
{
    nh_error error;
    nh_error_clear(&error);
    double left = w->begun + w->budget - nh_clock(),
           budget = fmax(left / (double)(w->values_left ? w->values_left : 1), least_cell);
    nh_benchmark_work b;
    if (nh_robustness_late(w)) {
        for (size_t i = 0; i < method_count; i++)
            cell[i] = (nh_robustness_cell){.at = cell[i].at,
                                           .second_at = cell[i].second_at,
                                           .method = w->step > 0 ? stepping[i] : methods[i],
                                           .error = NAN,
                                           .drift = NAN,
                                           .status = NH_NOT_RUN,
                                           .note = nh_robustness_no_time};
        return;
    }
    bool opened = nh_benchmark_work_open_once(&b, request, coordinate, turn, budget, &error);
    /* otherwise the two references say little about which runs are accurate */
    bool reference =
        opened && nh_benchmark_work_reference(&b, &error) && b.out->agreement <= request->options.robustness_error;
    if (opened && !reference) nh_benchmark_work_no_reference(&b);
    for (size_t i = 0; i < method_count; i++) {
        cell[i].method = w->step > 0 ? stepping[i] : methods[i];
        cell[i].error = cell[i].drift = NAN;
        cell[i].status = NH_FAILED;
        cell[i].note = error.what;
        if (opened) try_method(&b, cell[i].method, in_coordinates, reference, w->step, &request->options, &cell[i]);
        cell[i].note = nh_arena_strdup(w->out->arena, cell[i].note);
    }
    if (w->values_left) w->values_left--;
    nh_benchmark_work_close(&b);
    nh_benchmark_free(b.out);
}

/* ---- maps ---- */

nh_robustness_map *nh_robustness_add_map(nh_robustness_work *w, const char *name, const char *axis, size_t values,
                                         size_t methods_here)
{
    nh_arena *arena = w->out->arena;
    nh_robustness_map *map = &w->out->map[w->out->maps++];
    *map = (nh_robustness_map){.name = nh_arena_strdup(arena, name),
                               .axis = nh_arena_strdup(arena, axis),
                               .methods = methods_here,
                               .cells = values * methods_here};
    map->cell = nh_arena_alloc(arena, map->cells * sizeof *map->cell);
    return map;
}

static void set_at(nh_robustness_map *map, size_t value, double at)
{
    for (size_t i = 0; i < map->methods; i++) map->cell[value * map->methods + i].at = at;
}

/* `step` above 0: methods with this fixed step, which shows those whose energy grows [ModinVerdier2020]. */
static void map_time(nh_robustness_work *w, const char *name, size_t count, double step, double begin, double end)
{
    nh_robustness_map *map = nh_robustness_add_map(w, name, "end of the motion", count, method_count);
    w->step = step;
    for (size_t v = 0; v < count; v++) {
        nh_request q = *w->request;
        q.until_given = true;
        q.options.until = begin + (end - begin) * longer[v];
        set_at(map, v, q.options.until);
        nh_robustness_try(w, &q, 0, 0, false, map->cell + v * method_count);
    }
    w->step = 0;
}

static void map_absolute(nh_robustness_work *w)
{
    enum { count = sizeof absolute / sizeof *absolute };
    nh_robustness_map *map =
        nh_robustness_add_map(w, "badly scaled", "size below which errors are absolute", count, method_count);
    for (size_t v = 0; v < count; v++) {
        nh_request q = *w->request;
        q.options.absolute = absolute[v];
        set_at(map, v, absolute[v]);
        nh_robustness_try(w, &q, 0, 0, false, map->cell + v * method_count);
    }
}

static void map_parameter(nh_robustness_work *w, const char *name, double value)
{
    enum { count = sizeof parameter / sizeof *parameter };
    nh_robustness_map *map =
        nh_robustness_add_map(w, nh_arena_printf(w->out->arena, "parameter %s", name), name, count, method_count);
    nh_setting *setting = nh_arena_alloc(w->out->arena, (w->request->settings + 1) * sizeof *setting);
    if (w->request->settings) memcpy(setting, w->request->setting, w->request->settings * sizeof *setting);
    for (size_t v = 0; v < count; v++) {
        nh_request q = *w->request;
        setting[q.settings] = (nh_setting){.name = nh_arena_strdup(w->out->arena, name), .value = value * parameter[v]};
        q.setting = setting;
        q.settings++;
        set_at(map, v, value * parameter[v]);
        nh_robustness_try(w, &q, 0, 0, false, map->cell + v * method_count);
    }
}

static void map_angle(nh_robustness_work *w, const char *name, size_t coordinate)
{
    nh_robustness_map *map =
        nh_robustness_add_map(w, nh_arena_printf(w->out->arena, "%s turned, chart of coordinate velocities", name),
                              name, most_values, method_count);
    for (size_t v = 0; v < most_values; v++) {
        double turn = 2 * acos(-1) * (double)v / most_values;
        set_at(map, v, turn);
        nh_robustness_try(w, w->request, turn, coordinate, true, map->cell + v * method_count);
    }
}

static size_t angles_of(const nh_system *system, bool charts)
{
    size_t n = 0;
    for (size_t i = 0; i < system->coordinates && charts; i++) n += system->coordinate[i].type == NH_ANGLE;
    return n;
}

static bool all_maps(nh_robustness_work *w, const nh_benchmark_work *plain, nh_error *error)
{
    const nh_system *system = plain->out->question->system;
    bool charts = plain->formulations == NH_BENCHMARK_FORMULATIONS || (!plain->model->chart->quasi && plain->model->k);
    size_t parameters = system->parameters < most_parameters ? system->parameters : most_parameters,
           angles = angles_of(system, charts);
    w->out->map = nh_arena_alloc(
        w->out->arena, (3 + system->robustness_maps + parameters + angles + NH_ROBUSTNESS_FITS) * sizeof *w->out->map);
    w->values_left = longer_times + sizeof absolute / sizeof *absolute +
                     parameters * (sizeof parameter / sizeof *parameter) + angles * most_values + longer_by_steps;
    nh_robustness_fits(w, plain);
    for (size_t i = 0; i < system->robustness_maps; i++)
        if (!nh_robustness_named(w, plain, &system->robustness_map[i], error)) return false;
    map_absolute(w);
    for (size_t i = 0; i < system->coordinates && angles; i++)
        if (system->coordinate[i].type == NH_ANGLE) map_angle(w, system->coordinate[i].name, i);
    for (size_t i = 0; i < parameters; i++) map_parameter(w, system->parameter[i].name, system->parameter[i].value);
    double begin = plain->out->begin, end = plain->out->end;
    map_time(w, "long times by fixed steps", longer_by_steps,
             fabs(end - begin) / (4 * w->request->options.benchmark_steps), begin, end);
    map_time(w, "long times", longer_times, 0, begin, end);
    return true;
}

/* "samples": the maps of the discrete problem; otherwise the name of a map of the system file, or ranges. */
static bool one_map(nh_robustness_work *w, const nh_benchmark_work *plain, const char *over, nh_error *error)
{
    const nh_system *system = plain->out->question->system;
    w->out->map = nh_arena_alloc(w->out->arena, NH_ROBUSTNESS_FITS * sizeof *w->out->map);
    if (!strcmp(over, "samples")) return nh_robustness_fits(w, plain), true;
    for (size_t i = 0; i < system->robustness_maps; i++)
        if (!strcmp(over, system->robustness_map[i].name))
            return nh_robustness_named(w, plain, &system->robustness_map[i], error);
    if (!system->robustness_maps || strchr(over, '='))
        return nh_robustness_axes(w, plain, w->request, NULL, over, error);
    nh_fail(error, NH_USAGE, "", "--over `%s` is neither a range nor a robustness map of this system", over);
    return nh_error_hint(error, "--over \"NAME=LOW:HIGH\", or one of its maps, such as --over \"%s\"",
                         system->robustness_map[0].name);
}

nh_robustness *nh_robustness_create(const nh_request *request, const char *over, double budget, nh_error *error)
{
    nh_arena *arena = nh_arena_create();
    nh_robustness *out = nh_arena_alloc(arena, sizeof *out);
    *out = (nh_robustness){.arena = arena,
                           .tolerance = request->options.robustness_tolerance,
                           .accuracy = request->options.robustness_error};
    nh_robustness_work w = {.out = out, .request = request, .begun = nh_clock(), .budget = budget};
    nh_benchmark_work plain;
    bool good = nh_benchmark_work_open_once(&plain, request, 0, 0, budget, error) &&
                (over ? one_map(&w, &plain, over, error) : all_maps(&w, &plain, error));
    nh_benchmark_work_close(&plain);
    nh_benchmark_free(plain.out);
    for (size_t i = 0; i < out->maps; i++)
        for (size_t j = 0; j < out->map[i].cells; j++) out->count[out->map[i].cell[j].status]++;
    if (good) return out;
    nh_robustness_free(out);
    return NULL;
}

void nh_robustness_free(nh_robustness *maps)
{
    if (maps) nh_arena_free(maps->arena);
}

nh_benchmark *nh_robustness_benchmark(const nh_request *request, const char *over, double seconds, nh_error *error)
{
    static const double usual = 5, longest = 300; /* seconds: of runs; of maps, which are limited by steps */
    double share = seconds > 0 && !over ? seconds / 2 : seconds;
    nh_benchmark *b = over ? nh_benchmark_reference(request, share > 0 ? share : usual, error)
                           : nh_benchmark_run(request, share > 0 ? share : usual, error);
    if (!b || nh_interrupted()) return b;
    nh_robustness *maps = nh_robustness_create(request, over, share > 0 ? share : longest, error);
    if (!maps) return nh_benchmark_free(b), NULL;
    b->maps = maps;
    b->of_maps = maps->arena;
    return b;
}

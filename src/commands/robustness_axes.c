/* robustness_axes: a map over one or two quantities that the user names. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "commands/robustness_internal.h"
#include "evaluate/constant_text.h"
#include "graph/node.h"

enum { most_axes = 2, values_of_one = 10, values_of_two = 6, most_values = 100 };
static const double decades = 100; /* a range from x to 100 x or more is divided in equal ratios */

typedef enum { AXIS_PARAMETER, AXIS_INITIAL, AXIS_OPTION } axis_kind;

typedef struct {
    const char *name;
    double low, high;
    size_t count; /* 0: not given */
    axis_kind kind;
} axis;

/* ---- reading ---- */

static bool unreadable(const char *text, nh_error *error)
{
    nh_fail(error, NH_USAGE, "", "--over `%s` is no range", text);
    return nh_error_hint(
        error,
        "it is written --over \"NAME=LOW:HIGH\", or NAME=LOW:HIGH:VALUES, one or two of them with a comma between");
}

static bool read_axis(nh_arena *arena, const char *text, axis *a, nh_error *error)
{
    const char *equal = strchr(text, '=');
    char *end;
    if (!equal || equal == text) return unreadable(text, error);
    *a = (axis){.name = nh_arena_strndup(arena, text, (size_t)(equal - text))};
    const char *colon = strchr(equal, ':'), *second = colon ? strchr(colon + 1, ':') : NULL;
    if (!colon || !nh_constant_text(nh_arena_strndup(arena, equal + 1, (size_t)(colon - equal - 1)), &a->low))
        return unreadable(text, error);
    size_t length = second ? (size_t)(second - colon - 1) : strlen(colon + 1);
    if (!nh_constant_text(nh_arena_strndup(arena, colon + 1, length), &a->high)) return unreadable(text, error);
    if (!second) return true;
    long count = strtol(second + 1, &end, 10);
    if (*end || count < 1 || count > most_values) return unreadable(text, error);
    a->count = (size_t)count;
    return true;
}

/* A parameter, part of the initial state, or an option. */
static bool know(const nh_benchmark_work *plain, const nh_request *request, axis *a, nh_error *error)
{
    const nh_model *model = plain->model;
    const nh_system *system = model->system;
    for (size_t i = 0; i < system->parameters; i++)
        if (!strcmp(a->name, system->parameter[i].name)) return true; /* AXIS_PARAMETER */
    bool initial = false;
    for (size_t i = 0; i < system->coordinates; i++)
        initial |= !strcmp(a->name, system->coordinate[i].name) ||
                   !strcmp(a->name, nh_name_of(model->dag, system->coordinate[i].v));
    for (size_t i = 0; i < model->n; i++) initial |= !strcmp(a->name, nh_name_of(model->dag, model->chart->w[i]));
    a->kind = initial ? AXIS_INITIAL : AXIS_OPTION;
    if (initial && request->initial) return true;
    if (initial) {
        nh_fail(error, NH_USAGE, "", "--over `%s` changes the initial state, which is not given", a->name);
        return nh_error_hint(error, "--initial \"%s=0\" gives it; omitted values are 0 or follow from the constraints",
                             a->name);
    }
    a->name = nh_option_name(a->name);
    for (size_t i = 0; i < nh_option_count(); i++)
        if (!strcmp(a->name, nh_option_at(i).name)) return true;
    nh_fail(error, NH_USAGE, "", "--over `%s`: there is no such parameter, coordinate, velocity or option", a->name);
    return nh_error_hint(
        error,
        "`nhsym show` prints the system; options are those of `nhsym explain options`, such as until or absolute");
}

/* Reads up to two axes; returns their number, or 0 with a message. */
static size_t read_axes(nh_arena *arena, const nh_benchmark_work *plain, const nh_request *request, const char *over,
                        axis *a, nh_error *error)
{
    size_t n = 0;
    char *text = nh_arena_strdup(arena, over), *rest = text;
    for (char *part; (part = strsep(&rest, ",;"));) {
        while (*part == ' ') part++;
        if (n == most_axes)
            return nh_fail(error, NH_USAGE, "", "--over takes at most %d ranges", most_axes),
                   nh_error_hint(error, "set further parameters one at a time by --set"), 0;
        if (!read_axis(arena, part, &a[n], error) || !know(plain, request, &a[n], error)) return 0;
        n++;
    }
    for (size_t i = 0; i < n; i++)
        if (!a[i].count) a[i].count = n == 1 ? values_of_one : values_of_two;
    return n;
}

/* ---- values ---- */

static double value_at(const axis *a, size_t i)
{
    double part = a->count > 1 ? (double)i / (double)(a->count - 1) : 0, ratio = a->low != 0 ? a->high / a->low : 0;
    if (i + 1 == a->count && a->count > 1) return a->high;
    if (a->low != 0 && (ratio >= decades || (ratio > 0 && ratio <= 1 / decades))) return a->low * pow(ratio, part);
    return a->low + (a->high - a->low) * part;
}

/* "phi=0, omega=2" with one value replaced or added. */
static const char *with_initial(nh_arena *arena, const char *initial, const char *name, double value)
{
    char *text = nh_arena_strdup(arena, initial), *rest = text;
    const char *out = nh_arena_printf(arena, "%s=%.17g", name, value);
    for (char *part; (part = strsep(&rest, ",;"));) {
        part += strspn(part, " ");
        size_t length = strcspn(part, "= ");
        if (*part && (length != strlen(name) || strncmp(part, name, length)))
            out = nh_arena_printf(arena, "%s, %s", out, part);
    }
    return out;
}

static bool change(nh_arena *arena, const axis *a, double value, nh_request *q, nh_setting *setting, nh_error *error)
{
    if (a->kind == AXIS_INITIAL) {
        q->initial = with_initial(arena, q->initial, a->name, value);
        q->project = true; /* velocities that are given may no longer satisfy the constraints */
        return true;
    }
    if (a->kind == AXIS_OPTION) {
        q->until_given |= !strcmp(a->name, "until");
        return nh_options_set(&q->options, a->name, nh_arena_printf(arena, "%.17g", value), error);
    }
    setting[q->settings++] = (nh_setting){.name = a->name, .value = value};
    return true;
}

bool nh_robustness_axes(nh_robustness_work *w, const nh_benchmark_work *plain, const nh_request *request,
                        const char *name, const char *over, nh_error *error)
{
    nh_arena *arena = w->out->arena;
    axis a[most_axes];
    size_t n = read_axes(arena, plain, request, over, a, error), second = n == most_axes ? a[1].count : 1;
    if (!n) return false;
    if (!name) name = n == 1 ? a[0].name : nh_arena_printf(arena, "%s and %s", a[0].name, a[1].name);
    nh_robustness_map *map = nh_robustness_add_map(w, name, a[0].name, a[0].count * second, NH_ROBUSTNESS_METHODS);
    w->values_left += map->cells / map->methods;
    map->second_axis = n == 1 ? NULL : a[1].name;
    nh_setting *setting = nh_arena_alloc(arena, (request->settings + most_axes) * sizeof *setting);
    if (request->settings) memcpy(setting, request->setting, request->settings * sizeof *setting);
    for (size_t i = 0, cells = a[0].count * second; i < cells; i++) {
        nh_request q = *request;
        nh_robustness_cell *cell = map->cell + i * map->methods;
        double x = value_at(&a[0], i / second), y = n == 1 ? 0 : value_at(&a[1], i % second);
        q.setting = setting;
        if (!change(arena, &a[0], x, &q, setting, error) || (n > 1 && !change(arena, &a[1], y, &q, setting, error)))
            return false;
        for (size_t k = 0; k < map->methods; k++) cell[k].at = x, cell[k].second_at = y;
        nh_robustness_try(w, &q, 0, 0, false, cell);
    }
    return true;
}

/* ---- by name ---- */

bool nh_robustness_named(nh_robustness_work *w, const nh_benchmark_work *plain, const nh_named_map *s, nh_error *error)
{
    nh_request q = *w->request;
    nh_setting *setting = nh_arena_alloc(w->out->arena, (q.settings + s->settings + 1) * sizeof *setting);
    if (q.settings) memcpy(setting, q.setting, q.settings * sizeof *setting);
    for (size_t i = 0; i < s->settings; i++)
        setting[q.settings++] = (nh_setting){.name = s->setting[i].name, .value = s->setting[i].value};
    q.setting = setting;
    if (s->initial) q.initial = s->initial;
    if (s->velocities)
        q.chart = !strcmp(s->velocities, "auto")    ? NH_CHART_AUTO
                  : !strcmp(s->velocities, "quasi") ? NH_CHART_QUASI
                                                    : NH_CHART_COORDINATES;
    if (s->until > 0) q.options.until = s->until, q.until_given = true;
    for (size_t i = 0; i < s->options; i++)
        if (!nh_options_set(&q.options, s->option[i].name, nh_arena_printf(w->out->arena, "%.17g", s->option[i].value),
                            error))
            return false;
    w->step = s->step;
    bool good = nh_robustness_axes(w, plain, &q, s->name, s->over, error);
    w->step = 0;
    return good;
}

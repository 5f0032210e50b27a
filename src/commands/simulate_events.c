/* simulate_events: zeros along a motion: events, and a Poincare section. */
#include <string.h>

#include "commands/simulate_internal.h"
#include "graph/dag.h"

/* A part of what the user typed, without blanks around it. */
typedef struct {
    const char *from;
    size_t length;
} piece;

static piece trimmed(const char *from, const char *to)
{
    while (from < to && *from == ' ') from++;
    while (to > from && to[-1] == ' ') to--;
    return (piece){from, (size_t)(to - from)};
}

static bool says(piece p, const char *word) { return strlen(word) == p.length && !strncmp(p.from, word, p.length); }

/* rising, falling, both, stop */
static bool read_word(nh_simulation *s, const char *option, piece p, nh_simulated_event *event, nh_error *error)
{
    static const char *const words[] = {"rising", "falling", "both", "stop"};
    static const int directions[] = {1, -1, 0};
    for (int i = 0; i < 3; i++)
        if (says(p, words[i])) return event->event.direction = directions[i], true;
    if (says(p, "stop") && !event->section) return event->event.stop = true;
    const char *word = nh_arena_strndup(s->arena, p.from, p.length),
               *near = nh_text_nearest(word, words, event->section ? 3 : 4);
    nh_fail(error, NH_USAGE, "", "%s: `%s` stands behind the expression, where %s may stand", option, word,
            event->section ? "rising, falling or both" : "rising, falling, both and stop");
    return near ? nh_error_hint(error, "did you mean `%s`?", near)
                : nh_error_hint(error, "%s \"%s = 0, rising\"; semicolons separate several", option,
                                s->system->coordinate[0].name);
}

static bool part(nh_simulation *s, const char *option, const char *typed, piece p, nh_ex *out, nh_error *error)
{
    const nh_model *model = s->model;
    nh_ex taken;
    nh_named extra[2];
    size_t extras = 0;
    if (!nh_symbol_find(model->dag, "E", &taken)) extra[extras++] = (nh_named){.name = "E", .value = model->E};
    if (!nh_symbol_find(model->dag, "Lbar", &taken)) extra[extras++] = (nh_named){.name = "Lbar", .value = model->Lbar};
    return nh_system_expression_part(s->system, option, typed, (size_t)(p.from - typed), p.length, extras, extra, out,
                                     error) &&
           nh_analysis_file_to_chart(model, *out, out, error);
}

/* "y", or "y = x" for y - x */
static bool read_zero(nh_simulation *s, const char *option, const char *typed, piece p, nh_ex *out, nh_error *error)
{
    const nh_model *model = s->model;
    const char *equal = memchr(p.from, '=', p.length);
    nh_ex left, right = nh_int(model->dag, 0);
    if (!part(s, option, typed, equal ? trimmed(p.from, equal) : p, &left, error) ||
        (equal && !part(s, option, typed, trimmed(equal + 1, p.from + p.length), &right, error)))
        return false;
    *out = nh_sub(model->dag, left, right);
    bool changes = false;
    for (size_t i = 0; i < model->width; i++) changes |= nh_depends(model->dag, *out, model->chart->symbol[i]);
    if (changes) return true;
    nh_fail(error, NH_USAGE, "", "%s: `%.*s` never changes along a motion", option, (int)p.length, p.from);
    return nh_error_hint(error,
                         "an expression of t, coordinates and velocities is zero at an event, as in %s \"%s = 0\"",
                         option, s->system->coordinate[0].name);
}

static bool read_events(nh_simulation *s, const char *option, const char *typed, bool section, nh_error *error)
{
    for (const char *at = typed, *end; *at; at = end + (*end != 0)) {
        nh_simulated_event *event = &s->event[s->events];
        end = at + nh_text_entry(at, ";");
        const char *next = at + nh_text_entry(at, ",;");
        piece p = trimmed(at, next);
        if (!p.length && trimmed(at, end).length == 0) continue;
        *event = (nh_simulated_event){
            .name = nh_arena_strndup(s->arena, p.from, p.length), .section = section, .event.direction = section};
        if (!read_zero(s, option, typed, p, &event->event.e, error)) return false;
        while (next < end) {
            const char *word = next + 1;
            next = word + nh_text_entry(word, ",;");
            if (!read_word(s, option, trimmed(word, next), event, error)) return false;
        }
        s->events++;
    }
    if (s->events) return true;
    nh_fail(error, NH_USAGE, "", "%s names no expression", option);
    return nh_error_hint(error, "%s \"%s = 0\"", option, s->system->coordinate[0].name);
}

static size_t entries(const char *typed)
{
    size_t n = 1;
    for (const char *c = typed; c && *c; c++) n += *c == ';';
    return n;
}

/* Refuses options that cannot be combined with events. */
static bool allowed(const nh_request *q, nh_simulation *s, nh_error *error)
{
    bool stop = false;
    for (size_t i = 0; i < s->events; i++) stop |= s->event[i].event.stop;
    if (q->ensemble) {
        nh_fail(error, NH_USAGE, "", "--ensemble, and %s as well", q->event ? "--event" : "--section");
        return nh_error_hint(
            error,
            "members of an ensemble take common steps; write the initial states into a table for --initial-table");
    }
    if (!(stop && q->accuracy > 0)) return true;
    nh_fail(error, NH_USAGE, "",
            "--accuracy compares motions up to one end, and an event that stops them gives each its own");
    return nh_error_hint(error, "leave out `stop` or --accuracy; --tolerance sets the error of each step");
}

/* The column of that name. */
static bool find_column(nh_simulation *s, piece p, int *out, nh_error *error)
{
    const char **name = nh_arena_alloc(s->arena, (s->columns.count + 1) * sizeof *name);
    const char *word = nh_arena_strndup(s->arena, p.from, p.length), *own = nh_system_state_name(s->system, word);
    size_t n = 0;
    for (; n < s->columns.count && s->columns.track[n].kind != NH_TRACK_SHAPE; n++) {
        name[n] = s->columns.track[n].name;
        if (!strcmp(word, name[n]) || !strcmp(own, name[n])) return *out = (int)n, true;
    }
    if (says(p, "t")) return *out = NH_AXIS_TIME, true;
    const char *near = nh_text_nearest(word, name, n);
    nh_fail(error, NH_USAGE, "", "--axes: `%s` is not a column of the table", word);
    return near ? nh_error_hint(error, "did you mean `%s`?", near)
                : nh_error_hint(error, "--watch \"a = %s, b = EXPR\" --axes \"a, b\" takes any expressions", name[0]);
}

static bool read_axes(nh_simulation *s, const char *typed, nh_error *error)
{
    size_t first = nh_text_entry(typed, ",");
    const char *end = typed + strlen(typed);
    if (typed[first] && !strchr(typed + first + 1, ','))
        return find_column(s, trimmed(typed, typed + first), &s->axis[0], error) &&
               find_column(s, trimmed(typed + first + 1, end), &s->axis[1], error);
    nh_fail(error, NH_USAGE, "", "--axes needs two columns, found `%s`", typed);
    return nh_error_hint(error, "--axes \"%s, %s'\"", s->system->coordinate[0].name, s->system->coordinate[0].name);
}

static bool is_column_of(const nh_simulation *s, size_t k, nh_ex e)
{
    return k < s->columns.count && s->columns.track[k].value == e;
}

/* The default columns: over time the first quantity; of a section the first two observables, or else the first
 * coordinate that the section leaves free, and its velocity. */
static void choose_axes(nh_simulation *s, const nh_request *q)
{
    const nh_model *model = s->model;
    const nh_simulated_event *section = &s->event[s->events - 1];
    s->axis[0] = q->section ? 0 : NH_AXIS_TIME;
    s->axis[1] = 0;
    if (!q->section) return;
    s->axis[1] = s->columns.count > 1;
    for (size_t i = 0; i < model->m && !q->watch && !q->scene; i++) {
        nh_ex coordinate = model->system->coordinate[i].q;
        size_t at = s->columns.count;
        for (size_t k = s->columns.count; k-- > 0;)
            if (is_column_of(s, k, model->rho[i])) at = k;
        if (nh_depends(model->dag, section->event.e, coordinate) || at == s->columns.count ||
            !is_column_of(s, i, coordinate))
            continue;
        s->axis[0] = (int)i;
        s->axis[1] = (int)at;
        return;
    }
}

bool nh_simulate_events(nh_simulation *s, const nh_request *q, nh_error *error)
{
    s->event = nh_arena_alloc(s->arena, (entries(q->event) + entries(q->section)) * sizeof *s->event);
    if (q->event && !read_events(s, "--event", q->event, false, error)) return false;
    size_t before = s->events;
    if (q->section && !read_events(s, "--section", q->section, true, error)) return false;
    if (q->section && s->events != before + 1) {
        nh_fail(error, NH_USAGE, "", "--section needs one expression, found %zu", s->events - before);
        return nh_error_hint(error, "zeros of several expressions are events: --event \"%s\"", q->section);
    }
    if (s->events && !allowed(q, s, error)) return false;
    s->has_section = q->section != NULL;
    s->has_axes = q->axes != NULL;
    if (q->axes) return read_axes(s, q->axes, error);
    return choose_axes(s, q), true;
}

#include "document/simulation.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "base/progress.h"
#include "document/time_series.h"

static void put(nh_text *out, double x)
{
    char text[40];
    if (!isfinite(x)) return; /* an empty field: there is no value */
    nh_text_number(x, text, sizeof text);
    nh_text_add(out, text);
}

/* ---- column names ----
 *
 * Of letters, digits and underscores, as gnuplot, R and pandas take them without quotes: x' is x_dot, and other
 * characters of an expression become underscores.  All names are different: a second column with the same name (a known
 * current called E, like the energy) also gets its kind. */

static const char *plain_name(nh_arena *arena, const char *name)
{
    nh_text out;
    nh_text_init(&out);
    if (isdigit((unsigned char)*name)) nh_text_add(&out, "v");
    for (const char *c = name; *c; c++) {
        bool letter = isalnum((unsigned char)*c) || *c == '_' || (unsigned char)*c >= 0x80,
             gap = out.length && nh_text_string(&out)[out.length - 1] == '_';
        if (letter) nh_text_add_n(&out, c, 1);
        else if (*c == '\'') nh_text_add(&out, gap ? "dot" : "_dot");
        else if (!gap && out.length && c[1]) nh_text_add(&out, "_");
    }
    const char *kept = nh_arena_strdup(arena, out.length ? nh_text_string(&out) : "value");
    nh_text_clear(&out);
    return kept;
}

static bool is_taken(const char *const *names, size_t count, const char *name)
{
    bool taken = !strcmp(name, "t") || !strcmp(name, "member");
    for (size_t k = 0; k < count && !taken; k++) taken = !strcmp(names[k], name);
    return taken;
}

/* The names of the columns as a table shows them, one per column, different, of letters, digits and underscores. */
static const char **column_names(const nh_simulation *s)
{
    static const char *const kinds[] = {"state", "current", "multiplier", "energy", "watched", "shape"};
    const nh_observables *t = &s->columns;
    const char **out = nh_arena_alloc(s->arena, (t->count + 1) * sizeof *out);
    for (size_t k = 0; k < t->count; k++) {
        const char *name = plain_name(s->arena, t->track[k].name), *kind = kinds[t->track[k].kind];
        out[k] = name;
        if (is_taken(out, k, out[k])) out[k] = nh_arena_printf(s->arena, "%s_%s", name, kind);
        for (int more = 2; is_taken(out, k, out[k]); more++)
            out[k] = nh_arena_printf(s->arena, "%s_%s_%d", name, kind, more);
    }
    return out;
}

/* The columns of a table, without those of the drawing, which come last. */
static size_t shown_of(const nh_simulation *s)
{
    size_t shown = 0;
    while (shown < s->columns.count && s->columns.track[shown].kind != NH_TRACK_SHAPE) shown++;
    return shown;
}

static void put_names(const nh_simulation *s, const char *first, size_t shown, nh_text *out)
{
    const char **name = column_names(s);
    nh_text_add(out, first);
    for (size_t k = 0; k < shown; k++) nh_text_addf(out, ",%s", name[k]);
    nh_text_add(out, "\n");
}

static void put_rows(const nh_simulation *s, const char *first, nh_text *out)
{
    size_t shown = shown_of(s);
    for (size_t i = 0; i < s->motion->count; i++) {
        nh_text_add(out, first);
        put(out, s->motion->time[i]);
        for (size_t k = 0; k < shown; k++) {
            nh_text_add(out, ",");
            put(out, s->value[i * s->columns.count + k]);
        }
        nh_text_add(out, "\n");
    }
}

/* The zeros of expression number `which`, or of all, with their names in front. */
static void put_events(const nh_simulation *s, const char *first, bool all, size_t which, nh_text *out)
{
    size_t shown = shown_of(s);
    for (size_t i = 0; i < s->motion->events; i++) {
        const nh_event_found *e = &s->motion->event[i];
        if (all ? s->event[e->which].section : e->which != which) continue;
        nh_text_add(out, first);
        if (all) nh_text_addf(out, "\"%s\",%s,", s->event[e->which].name, nh_direction_word(e->direction));
        put(out, e->time);
        for (size_t k = 0; k < shown; k++) {
            nh_text_add(out, ",");
            put(out, s->trajectory->event_value[i * s->columns.count + k]);
        }
        nh_text_add(out, "\n");
    }
}

void nh_events_csv(const nh_simulation *s, nh_text *out)
{
    put_names(s, "event,direction,t", shown_of(s), out);
    put_events(s, "", true, 0, out);
}

void nh_section_csv(const nh_simulation *s, nh_text *out)
{
    put_names(s, "t", shown_of(s), out);
    put_events(s, "", false, s->events - 1, out);
}

void nh_motion_csv(const nh_simulation *s, nh_text *out)
{
    put_names(s, "t", shown_of(s), out);
    put_rows(s, "", out);
}

void nh_member_csv(const nh_simulation *s, size_t member, const nh_simulate_row *row, nh_text *out)
{
    nh_text first;
    nh_text_init(&first);
    nh_text_add(&first, "member,");
    for (size_t i = 0; i < row->settings; i++) nh_text_addf(&first, "%s,", row->setting[i].name);
    nh_text_add(&first, "t");
    if (member == 0) put_names(s, nh_text_string(&first), shown_of(s), out);
    nh_text_clear(&first);
    nh_text_addf(&first, "%zu,", member);
    for (size_t i = 0; i < row->settings; i++) put(&first, row->setting[i].value), nh_text_add(&first, ",");
    if (s->has_section) put_events(s, nh_text_string(&first), false, s->events - 1, out);
    else put_rows(s, nh_text_string(&first), out);
    nh_text_clear(&first);
}

void nh_ensemble_csv(const nh_simulation *s, nh_text *out)
{
    const nh_ensemble *e = s->ensemble;
    put_names(s, "member,t", s->columns.count, out);
    for (size_t j = 0; j < e->members * e->count; j++) {
        put(out, (double)(j / e->count));
        nh_text_add_n(out, ",", 1);
        put(out, e->time[j % e->count]);
        for (size_t k = 0; k < e->n; k++) {
            nh_text_add_n(out, ",", 1);
            put(out, e->value[j * e->n + k]);
        }
        nh_text_add_n(out, "\n", 1);
    }
}

/* The candidates from which a method was chosen. */
static const char *const choices[] = {[NH_CHOICE_RACE] = "race",
                                      [NH_CHOICE_GIVEN] = "given",
                                      [NH_CHOICE_PILOT] = "measured",
                                      [NH_CHOICE_SHORT] = "short"};

void nh_accuracy_json(const nh_accuracy *a, nh_json *root)
{
    if (!a) {
        nh_json_put_null(root, "accuracy");
        return;
    }
    nh_json *item = nh_json_put_object(root, "accuracy");
    nh_json_put_number(item, "wanted", a->wanted);
    nh_json_put_bool(item, "held", a->held);
    nh_json_put_number(item, "estimate", a->estimate);
    nh_json_put_number(item, "step", a->step);
    nh_json_put_text(item, "choice", choices[a->choice]);
    nh_json_put_bool(item, "measured", a->measured);
    nh_json_put_text(item, "next", a->measured && a->other ? a->other->name : NULL);
    nh_json_put_number(item, "times", a->measured ? a->next : NAN);
    nh_json_put_text(item, "second", a->second);
    nh_json_put_number(item, "difference", a->difference);
    nh_json_put_number(item, "runs", a->runs);
    nh_json_put_number(item, "evaluations", (double)a->evaluations);
    nh_json_put_text(item, "why", a->why);
}

static void put_accuracy_of_all(const nh_simulation *s, nh_json *root)
{
    if (!s->checked) {
        nh_json_put_null(root, "accuracy");
        return;
    }
    const nh_ensemble_accuracy *a = &s->accuracy_of_all;
    nh_json *item = nh_json_put_object(root, "accuracy");
    nh_json_put_number(item, "wanted", a->wanted);
    nh_json_put_bool(item, "held", a->held);
    nh_json_put_number(item, "estimate", a->estimate);
    nh_json_put_bool(item, "all_alone", a->all_alone);
    nh_json_put_text(item, "method_alone", a->way.method ? a->way.method->name : NULL);
    nh_json_put_text(item, "choice", a->way.method ? choices[a->choice] : NULL);
    nh_json_put_number(item, "ratio", a->ratio > 0 ? a->ratio : NAN);
    nh_json_put_number(item, "alone", (double)a->alone);
    nh_json_put_number(item, "unsure", (double)a->unsure);
    nh_json_put_number(item, "runs", a->runs);
    nh_json_put_number(item, "evaluations", (double)a->evaluations);
    nh_json_put_text(item, "why", a->why);
}

/* The beginning of every document. */
static void put_head(const nh_system *system, nh_json *root)
{
    nh_json_put_number(root, "schema", 1);
    nh_json_put_text(root, "version", NH_VERSION);
    nh_json_put_text(root, "system", system->name);
}

char *nh_ensemble_json(const nh_simulation *s, const nh_run *run)
{
    const nh_ensemble *e = s->ensemble;
    nh_json *root = nh_json_object();
    put_head(s->system, root);
    nh_json_put_text(root, "method", s->method);
    nh_json_put_text(root, "formulation", s->formulation);
    nh_json_put_text(root, "scene", s->scene);
    nh_json_put_number(root, "tolerance", s->tolerance);
    nh_json_put_bool(root, "complete", e->incomplete == 0);
    bool open = e->incomplete > 0 || (s->checked && !s->accuracy_of_all.held);
    nh_json_put_bool(root, "partial", open && nh_interrupted());
    put_accuracy_of_all(s, root);
    nh_json_put_numbers(root, "time", e->count, e->time, 1);
    nh_json *members = nh_json_put_array(root, "members");
    for (size_t i = 0; i < e->members; i++) {
        nh_json *member = nh_json_add_object(members);
        for (size_t k = 0; k < e->n; k++)
            nh_json_put_numbers(member, s->columns.track[k].name, e->count, e->value + i * e->count * e->n + k, e->n);
    }
    nh_json *stats = nh_json_put_object(root, "stats");
    nh_json_put_number(stats, "members", (double)e->members);
    nh_json_put_number(stats, "evaluations", (double)e->evaluations);
    nh_json_put_number(stats, "alone", (double)e->alone);
    nh_json_put_number(stats, "seconds", e->seconds);
    nh_json *warnings = nh_json_put_array(root, "warnings");
    if (e->incomplete) nh_json_add_text(warnings, e->note);
    if (run) nh_run_json(run, s->system, root);
    return nh_json_finish(root);
}

/* One expression and its zeros: times, directions and the columns there. */
static void put_zeros(const nh_simulation *s, size_t which, nh_json *item)
{
    const nh_simulated_event *event = &s->event[which];
    size_t n = nh_events_of(s, which), count = s->columns.count, at = 0;
    nh_json_put_text(item, "of", event->name);
    nh_json_put_text(item, "direction", nh_direction_word(event->event.direction));
    if (!event->section) nh_json_put_bool(item, "stop", event->event.stop);
    double *time = nh_alloc_array((2 + count) * n + 1, sizeof *time), *rising = time + n, *value = rising + n;
    for (size_t i = 0; i < s->motion->events; i++) {
        if (s->motion->event[i].which != which) continue;
        time[at] = s->motion->event[i].time;
        rising[at] = s->motion->event[i].direction;
        memcpy(value + at++ * count, s->trajectory->event_value + i * count, count * sizeof *value);
    }
    nh_json_put_numbers(item, "time", n, time, 1);
    nh_json_put_numbers(item, "sign", n, rising, 1);
    nh_json *values = nh_json_put_object(item, "values");
    for (size_t k = 0; k < shown_of(s); k++) nh_json_put_numbers(values, s->columns.track[k].name, n, value + k, count);
    nh_free(time);
}

static void put_all_zeros(const nh_simulation *s, nh_json *root)
{
    if (!s->events) return;
    nh_json *list = s->event[0].section ? NULL : nh_json_put_array(root, "events");
    for (size_t i = 0; i < s->events; i++)
        put_zeros(s, i, s->event[i].section ? nh_json_put_object(root, "section") : nh_json_add_object(list));
}

static void put_motion(const nh_simulation *s, nh_json *root)
{
    static const char *const groups[] = {"states", "currents", "multipliers", "energies", "watch"};
    nh_json_put_text(root, "method", s->method);
    nh_json_put_text(root, "formulation", s->formulation);
    nh_json_put_text(root, "scene", s->scene);
    nh_json_put_text(root, "without_influence", s->idle);
    if (s->compared) {
        nh_json *whole = nh_json_put_object(root, "whole_model");
        nh_json_put_number(whole, "seconds", s->whole_seconds);
        nh_json_put_number(whole, "evaluations", (double)s->whole_evaluations);
        nh_json_put_number(whole, "difference", s->whole_difference);
    }
    nh_json_put_number(root, "tolerance", s->tolerance);
    nh_json_put_bool(root, "complete", s->motion->complete);
    bool open = !s->motion->complete || (s->checked && !s->accuracy.held), ended = nh_interrupted();
    nh_json_put_bool(root, "partial", open && (ended || (s->motion->limited && !s->motion->complete)));
    nh_accuracy_json(s->checked ? &s->accuracy : NULL, root);
    nh_json_put_numbers(root, "time", s->motion->count, s->motion->time, 1);
    nh_time_series *c = nh_time_series_of_simulation(s);
    for (int kind = NH_TRACK_STATE; kind <= NH_TRACK_WATCH; kind++)
        nh_time_series_json(c, root, groups[kind], (nh_track_kind)kind);
    if (c->shapes) nh_time_series_json_drawing(c, root);
    nh_time_series_free(c);
    put_all_zeros(s, root);
    nh_json *stats = nh_json_put_object(root, "stats");
    nh_json_put_number(stats, "evaluations", (double)s->motion->evaluations);
    nh_json_put_number(stats, "steps", (double)s->motion->steps);
    nh_json_put_number(stats, "seconds", s->motion->seconds);
    nh_json *warnings = nh_json_put_array(root, "warnings");
    for (size_t i = 0; i < s->system->notes; i++) nh_json_add_text(warnings, s->system->note[i]);
    if (s->assembled) nh_json_add_text(warnings, s->assembled);
    if (s->violation) nh_json_add_text(warnings, s->violation);
    if (s->motion->note[0]) nh_json_add_text(warnings, s->motion->note);
}

char *nh_motion_json(const nh_simulation *s, const nh_run *run)
{
    nh_json *root = nh_json_object();
    put_head(s->system, root);
    put_motion(s, root);
    if (run) nh_run_json(run, s->system, root);
    return nh_json_finish(root);
}

/* The parameters that no row of the table sets. */
static void put_common_parameters(const nh_system *system, const nh_simulate_row *row, nh_json *root)
{
    nh_json *parameters = nh_json_put_object(root, "parameters");
    for (size_t i = 0; i < system->parameters; i++) {
        const char *name = system->parameter[i].name;
        size_t k = 0;
        while (k < row->settings && strcmp(row->setting[k].name, name)) k++;
        if (k == row->settings) nh_json_put_number(parameters, name, system->parameter[i].value);
    }
}

void nh_member_json(const nh_simulation *s, const nh_simulate_row *row, const nh_run *run, nh_json *root)
{
    if (!nh_json_get(root, "motions")) {
        put_head(s->system, root);
        put_common_parameters(s->system, row, root);
        nh_run_json(run, s->system, root);
        nh_json_put_array(root, "motions");
    }
    nh_json *item = nh_json_add_object(nh_json_get(root, "motions")), *set = nh_json_put_object(item, "set");
    for (size_t i = 0; i < row->settings; i++) nh_json_put_number(set, row->setting[i].name, row->setting[i].value);
    nh_json_put_text(item, "initial", row->initial);
    put_motion(s, item);
}

/* ---- events and section ---- */

enum { most_rows = 40, most_columns = 8 };

const char *nh_direction_word(int direction) { return direction > 0 ? "rising" : direction < 0 ? "falling" : "both"; }

const char *nh_direction_before(int direction) { return direction > 0 ? "rising " : direction < 0 ? "falling " : ""; }

size_t nh_events_of(const nh_simulation *s, size_t which)
{
    size_t n = 0;
    for (size_t i = 0; s->motion && i < s->motion->events; i++) n += s->motion->event[i].which == which;
    return n;
}

/* ---- the page ---- */

/* "y = 0, falling: 12 times" and its first rows, with as many columns as are easy to read. */
static void table(nh_pen *p, const nh_simulation *s, size_t which)
{
    const nh_simulated_event *event = &s->event[which];
    size_t count = nh_events_of(s, which), columns = 0, rows = 0;
    nh_text heads;
    char caption[300];
    nh_text_init(&heads);
    nh_text_add(&heads, "t|direction");
    for (; columns < s->columns.count && columns < most_columns && s->columns.track[columns].kind != NH_TRACK_SHAPE;
         columns++)
        nh_text_addf(&heads, "|%s", s->columns.track[columns].name);
    snprintf(caption, sizeof caption, "%.150s, %s%s: %zu%s", event->name, nh_direction_word(event->event.direction),
             event->event.stop ? ", ends the motion"
             : event->section  ? ", the section"
                               : "",
             count, count > most_rows ? "; the first of them" : "");
    nh_pen_table(p, caption, nh_text_string(&heads));
    nh_text_clear(&heads);
    for (size_t i = 0; i < s->motion->events && rows < most_rows; i++) {
        const nh_event_found *found = &s->motion->event[i];
        if (found->which != which) continue;
        nh_pen_open(p, NH_PEN_ROW, NULL, NULL);
        nh_pen_cell(p, NH_PEN_ROW_HEAD, "%.10g", found->time);
        nh_pen_cell(p, NH_PEN_CELL, "%s", nh_direction_word(found->direction));
        for (size_t k = 0; k < columns; k++)
            nh_pen_cell(p, NH_PEN_CELL, "%.6g", s->trajectory->event_value[i * s->columns.count + k]);
        nh_pen_close(p, NH_PEN_ROW);
        rows++;
    }
    nh_pen_table_end(p);
}

void nh_events_write(nh_pen *p, const nh_simulation *s)
{
    if (!s->events) return;
    nh_pen_section(p, "events", s->has_section ? "Section" : "Events");
    if (s->has_section && nh_events_of(s, s->events - 1)) {
        nh_motion_plot plot = {0};
        nh_motion_plot_add(&plot, s, NULL);
        nh_plot picture = nh_motion_plot_of(&plot);
        nh_pen_plot(p, &picture, plot.title);
        nh_motion_plot_clear(&plot);
    }
    for (size_t i = 0; i < s->events; i++) {
        if (nh_events_of(s, i)) table(p, s, i);
        else
            nh_pen_words(p, "%s has no %szero along this motion.", s->event[i].name,
                         nh_direction_before(s->event[i].event.direction));
    }
}

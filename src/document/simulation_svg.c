/* simulation_svg: a simulation, or several of them, as one picture. */
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "document/simulation.h"
#include "document/svg.h"

enum { most_curves = 7, most_members = 60 }; /* as many as on the page */

/* ---- two columns of one motion or of several ---- */

/* The values of one column along the motion, along that of a member of an ensemble, or at the points of the section. */
static double *values_of(const nh_simulation *s, int column, size_t member, size_t *count)
{
    const nh_ensemble *e = s->ensemble;
    const nh_trajectory *t = s->has_section || e ? s->trajectory : nh_simulation_drawn(s);
    const nh_motion *m = t ? t->motion : NULL;
    size_t most = e ? e->count : s->has_section ? m->events : m->count, k = column < 0 ? 0 : (size_t)column;
    double *out = nh_alloc_array(most + 1, sizeof *out);
    *count = 0;
    for (size_t i = 0; i < most; i++) {
        if (s->has_section && m->event[i].which + 1 != s->events) continue;
        out[(*count)++] = column == NH_AXIS_TIME ? (e                ? e->time[i]
                                                    : s->has_section ? m->event[i].time
                                                                     : m->time[i])
                          : e                    ? e->value[(member * e->count + i) * e->n + k]
                          : s->has_section       ? s->trajectory->event_value[i * s->columns.count + k]
                                                 : t->value[i * s->columns.count + k];
    }
    return out;
}

static const char *name_of(const nh_simulation *s, int column)
{
    return column == NH_AXIS_TIME ? "t" : s->columns.track[column].name;
}

static void begin(nh_motion_plot *plot, const nh_simulation *s)
{
    const nh_simulated_event *section = s->has_section ? &s->event[s->events - 1] : NULL;
    const char *x = name_of(s, s->axis[0]), *y = name_of(s, s->axis[1]), *title = s->system->title;
    plot->timed = s->axis[0] == NH_AXIS_TIME && !section;
    plot->equal = !section && s->axis[0] >= 0 && s->axis[1] >= 0 &&
                  nh_simulation_is_path(s, (size_t)s->axis[0], (size_t)s->axis[1]);
    snprintf(plot->x_label, sizeof plot->x_label, "%s", x);
    snprintf(plot->y_label, sizeof plot->y_label, "%s", y);
    if (section)
        snprintf(plot->title, sizeof plot->title, "%.150s: section %.100s, %s", title, section->name,
                 nh_direction_word(section->event.direction));
    else if (plot->timed) snprintf(plot->title, sizeof plot->title, "%.150s: %.60s over time", title, y);
    else snprintf(plot->title, sizeof plot->title, "%.150s: %.60s against %.60s", title, y, x);
}

static void add(nh_motion_plot *plot, const nh_simulation *s, size_t member, const char *name)
{
    size_t n = plot->members++, count;
    nh_curve *all = nh_alloc_array(plot->members, sizeof *all);
    if (n) memcpy(all, plot->curve, n * sizeof *all);
    nh_free(plot->curve);
    plot->named = name && (n == 0 || plot->named);
    all[n] = (nh_curve){.name = nh_strdup(name ? name : plot->y_label),
                        .x = values_of(s, s->axis[0], member, &count),
                        .x_stride = 1,
                        .y_stride = 1,
                        .dots = s->has_section};
    all[n].y = values_of(s, s->axis[1], member, &count);
    all[n].count = count;
    plot->curve = all;
}

void nh_motion_plot_add(nh_motion_plot *plot, const nh_simulation *s, const char *name)
{
    const nh_ensemble *e = s->ensemble;
    if (!plot->members) begin(plot, s);
    for (size_t j = 0; e && j < e->members && j < most_members; j++)
        add(plot, s, j, s->table ? s->table->row[j].name : NULL);
    if (!e && (s->has_section || plot->members < most_members)) add(plot, s, 0, name);
}

nh_plot nh_motion_plot_of(const nh_motion_plot *plot)
{
    bool section = plot->members && plot->curve[0].dots;
    return (nh_plot){.id = section ? "section" : "plot",
                     .title = plot->title,
                     .description = plot->title,
                     .x_label = plot->x_label,
                     .y_label = plot->y_label,
                     .timed = plot->timed,
                     .equal = plot->equal,
                     .path = !section && !plot->timed,
                     .fan = section || (plot->members > 1 && !(plot->named && plot->members <= most_curves)),
                     .curves = plot->members,
                     .curve = plot->curve};
}

void nh_motion_plot_clear(nh_motion_plot *plot)
{
    for (size_t i = 0; i < plot->members; i++) {
        nh_free((char *)plot->curve[i].name);
        nh_free((double *)plot->curve[i].x);
        nh_free((double *)plot->curve[i].y);
    }
    nh_free(plot->curve);
    plot->curve = NULL;
    plot->members = 0;
}

/* ---- one motion over time ---- */

/* The observables; if there are none, the coordinates, which come first. */
static size_t curves_of_motion(const nh_simulation *s, nh_curve curve[most_curves])
{
    const nh_observables *t = &s->columns;
    const nh_trajectory *drawn = nh_simulation_drawn(s);
    bool watched = t->count && t->track[0].kind == NH_TRACK_WATCH;
    size_t n = 0, last = watched ? t->count : s->model->m;
    for (size_t k = 0; k < last && n < most_curves; k++)
        curve[n++] = (nh_curve){.name = t->track[k].name,
                                .count = drawn->motion->count,
                                .x = drawn->motion->time,
                                .x_stride = 1,
                                .y = drawn->value + k,
                                .y_stride = t->count};
    return n;
}

static void over_time(const nh_simulation *s, nh_text *out)
{
    nh_curve curve[most_curves];
    size_t n = curves_of_motion(s, curve);
    char title[200];
    snprintf(title, sizeof title, "%.150s over time", s->system->title);
    nh_plot plot = {.id = "plot",
                    .title = title,
                    .description = title,
                    .x_label = "t",
                    .y_label = n == 1 ? s->columns.track[0].name : "",
                    .timed = true,
                    .curves = n,
                    .curve = curve};
    nh_svg_plot(&plot, out);
}

void nh_motion_svg(const nh_simulation *s, nh_text *out)
{
    if (!s->ensemble && !s->has_section && !s->has_axes) {
        over_time(s, out);
        return;
    }
    nh_motion_plot plot = {0};
    nh_motion_plot_add(&plot, s, NULL);
    nh_plot picture = nh_motion_plot_of(&plot);
    nh_svg_plot(&picture, out);
    nh_motion_plot_clear(&plot);
}

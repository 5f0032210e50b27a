/* reduction_motion: the motions of the stages beside the full one, as figures, as comma-separated values and as
   JSON. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "document/reduction_internal.h"

/* ---- figures ---- */

enum { together = 3, every = 4 }; /* coordinates in one figure: each has a line, and a point at every fourth time */

/* The full motion of the coordinate of that name; NULL where the stage has other coordinates than the system, which
 * move under the first group. */
static const double *full_of(const nh_reduction *r, const nh_reduction_stage *s, const char *name)
{
    if (!s->against_full) return NULL;
    for (size_t k = 0; k < r->kinetic->m; k++)
        if (!strcmp(r->kinetic->name[k], name)) return r->full_place + k;
    return NULL;
}

static bool is_angle(const nh_reduction *r, const char *name)
{
    long k = nh_system_coordinate(r->system, name);
    return k >= 0 && r->system->coordinate[k].type == NH_ANGLE;
}

/* Lines: after reconstruction; points: the full motion. */
static void places(nh_pen *p, const nh_reduction *r, const nh_reduction_stage *s, size_t n, const size_t *which)
{
    const nh_reduction_motion *o = &s->motion;
    nh_curve curve[2 * together];
    size_t curves = 0;
    for (size_t i = 0; i < n; i++)
        curve[curves++] = (nh_curve){.name = s->action->kinetic->name[which[i]],
                                     .count = o->count,
                                     .x = r->times,
                                     .x_stride = 1,
                                     .y = o->q + which[i],
                                     .y_stride = o->m};
    for (size_t i = 0; i < n; i++) {
        const char *name = s->action->kinetic->name[which[i]];
        const double *full = full_of(r, s, name);
        if (!full) continue;
        curve[curves++] = (nh_curve){.name = nh_arena_printf(r->arena, "%s, full", name),
                                     .count = (r->full_count + every - 1) / every,
                                     .x = r->times,
                                     .x_stride = every,
                                     .y = full,
                                     .y_stride = every * r->kinetic->m,
                                     .dots = true};
    }
    nh_plot plot = {.title = "Reduced and full motion",
                    .description = "Coordinates over time: lines from the reduced equations, points of the full motion",
                    .x_label = "t",
                    .y_label = is_angle(r, curve[0].name) ? "angle" : "coordinate",
                    .curves = curves,
                    .curve = curve};
    nh_pen_plot(
        p, &plot,
        "Coordinates over time: lines from the reduced equations and the group's motion, points of the full motion.");
}

static void momenta(nh_pen *p, const nh_reduction *r, const nh_reduction_motion *o)
{
    enum { most = 6 };
    nh_curve curve[most];
    size_t n = o->momenta < most ? o->momenta : most;
    for (size_t k = 0; k < n; k++)
        curve[k] = (nh_curve){.name = o->name[k],
                              .count = o->charted,
                              .x = r->times,
                              .x_stride = 1,
                              .y = o->p + k,
                              .y_stride = o->momenta,
                              .marks = o->charted < o->count};
    nh_plot plot = {.title = "Momenta of the reduced motion",
                    .description = "Momenta of the reduced equations over time",
                    .x_label = "t",
                    .y_label = n == 1 ? o->name[0] : "momentum",
                    .curves = n,
                    .curve = curve};
    if (n && o->charted > 1)
        nh_pen_plot(p, &plot,
                    o->charted < o->count ? "Momenta of the reduced equations over time, until the slice or the "
                                            "velocities change for the first time."
                                          : "Momenta of the reduced equations over time.");
}

void nh_reduction_figures(const nh_reduction *r, const nh_reduction_stage *s, nh_pen *p)
{
    const nh_reduction_motion *o = &s->motion;
    if (o->count < 2) return;
    nh_pen_open(p, NH_PEN_FOLD, NULL, "Its motion beside the full one");
    for (int angles = 0; angles < 2; angles++) { /* their units differ */
        size_t which[together], n = 0;
        for (size_t k = 0; k < o->m; k++) {
            if (is_angle(r, s->action->kinetic->name[k]) != angles) continue;
            which[n++] = k;
            if (n == together) places(p, r, s, n, which), n = 0;
        }
        if (n) places(p, r, s, n, which);
    }
    momenta(p, r, o);
    nh_pen_close(p, NH_PEN_FOLD);
}

/* ---- numbers ---- */

static void put(nh_text *out, bool there, double value)
{
    char text[40];
    nh_text_number(value, text, sizeof text);
    nh_text_addf(out, ",%s", there && isfinite(value) ? text : "");
}

static void put_row(const nh_reduction *r, size_t i, nh_text *out)
{
    size_t m = r->kinetic->m;
    for (size_t k = 0; k < m; k++) put(out, i < r->full_count, i < r->full_count ? r->full_place[i * m + k] : 0);
    for (size_t j = 0; j < r->stages; j++) {
        const nh_reduction_motion *o = &r->stage[j].motion;
        for (size_t k = 0; k < o->m; k++) put(out, i < o->count, i < o->count ? o->q[i * o->m + k] : 0);
        for (size_t k = 0; k < o->momenta; k++) put(out, i < o->charted, i < o->charted ? o->p[i * o->momenta + k] : 0);
    }
    nh_text_add(out, "\n");
}

void nh_reduction_csv(const nh_reduction *r, nh_text *out)
{
    size_t rows = r->full_count;
    nh_text_add(out, "t");
    for (size_t k = 0; k < r->kinetic->m; k++) nh_text_addf(out, ",%s", r->kinetic->name[k]);
    for (size_t j = 0; j < r->stages; j++) {
        const nh_reduction_motion *o = &r->stage[j].motion;
        for (size_t k = 0; k < o->m; k++)
            nh_text_addf(out, ",stage%zu.%s", j + 1, r->stage[j].action->kinetic->name[k]);
        for (size_t k = 0; k < o->momenta; k++) nh_text_addf(out, ",stage%zu.%s", j + 1, o->name[k]);
        if (o->count > rows) rows = o->count;
    }
    nh_text_add(out, "\n");
    for (size_t i = 0; i < rows; i++) {
        char time[40];
        nh_text_number(r->times[i], time, sizeof time);
        nh_text_add(out, time);
        put_row(r, i, out);
    }
}

void nh_reduction_motion_json(const nh_reduction *r, const nh_reduction_stage *s, nh_json *to)
{
    const nh_reduction_motion *o = &s->motion;
    if (o->count < 2) {
        nh_json_put_null(to, "motion");
        return;
    }
    nh_json *item = nh_json_put_object(to, "motion"), *places_of = NULL, *momenta_of = NULL;
    nh_json_put_numbers(item, "time", o->count, r->times, 1);
    places_of = nh_json_put_object(item, "places");
    for (size_t k = 0; k < o->m; k++)
        nh_json_put_numbers(places_of, s->action->kinetic->name[k], o->count, o->q + k, o->m);
    momenta_of = nh_json_put_object(item, "momenta");
    for (size_t k = 0; k < o->momenta; k++)
        nh_json_put_numbers(momenta_of, o->name[k], o->charted, o->p + k, o->momenta);
}

void nh_reduction_full_json(const nh_reduction *r, nh_json *to)
{
    nh_json *item = nh_json_put_object(to, "full_motion"), *places_of;
    nh_json_put_numbers(item, "time", r->full_count, r->times, 1);
    places_of = nh_json_put_object(item, "places");
    for (size_t k = 0; k < r->kinetic->m && r->full_count; k++)
        nh_json_put_numbers(places_of, r->kinetic->name[k], r->full_count, r->full_place + k, r->kinetic->m);
}

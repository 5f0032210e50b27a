/* simulation_svg: a simulation as one picture of its own. */
#include <stdio.h>

#include "base/memory.h"
#include "document/simulation.h"
#include "document/svg.h"

enum { most_curves = 7, most_members = 60 }; /* as on the page */

/* What is watched; where nothing is, the coordinates, which come first. */
static size_t curves_of_motion(const nh_simulation *s, nh_curve curve[most_curves])
{
    const nh_observables *t = &s->columns;
    bool watched = t->count && t->track[0].kind == NH_TRACK_WATCH;
    size_t n = 0, last = watched ? t->count : s->model->m;
    for (size_t k = 0; k < last && n < most_curves; k++)
        curve[n++] = (nh_curve){.name = t->track[k].name,
                                .count = s->motion->count,
                                .x = s->motion->time,
                                .x_stride = 1,
                                .y = s->value + k,
                                .y_stride = t->count};
    return n;
}

/* The first quantity of each member. */
static size_t curves_of_members(const nh_simulation *s, nh_curve curve[most_members])
{
    const nh_ensemble *e = s->ensemble;
    size_t n = e->members < most_members ? e->members : most_members;
    for (size_t j = 0; j < n; j++)
        curve[j] = (nh_curve){.name = s->columns.track[0].name,
                              .count = e->count,
                              .x = e->time,
                              .x_stride = 1,
                              .y = e->value + j * e->count * e->n,
                              .y_stride = e->n};
    return n;
}

void nh_motion_svg(const nh_simulation *s, nh_text *out)
{
    nh_curve curve[most_members];
    if (s->has_section) {
        nh_section_plot section = {0};
        nh_section_plot_add(&section, s);
        nh_plot picture = nh_section_plot_of(&section);
        nh_svg_plot(&picture, out);
        nh_section_plot_clear(&section);
        return;
    }
    size_t n = s->ensemble ? curves_of_members(s, curve) : curves_of_motion(s, curve);
    char title[200];
    snprintf(title, sizeof title, "%.150s over time", s->system->title);
    const char *one = n == 1 || s->ensemble ? s->columns.track[0].name : "";
    nh_plot plot = {.id = "plot",
                    .title = title,
                    .description = title,
                    .x_label = "t",
                    .y_label = one,
                    .timed = true,
                    .fan = s->ensemble != NULL,
                    .curves = n,
                    .curve = curve};
    nh_svg_plot(&plot, out);
}

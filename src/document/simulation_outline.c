/* A simulation as a document. */
#include <math.h>
#include <stdio.h>

#include "document/simulation.h"
#include "document/time_series.h"
#include "document/typeset.h"

static void answer(nh_pen *p, const nh_simulation *s)
{
    const nh_ensemble *e = s->ensemble;
    size_t count = e ? e->count : s->motion->count;
    const double *time = e ? e->time : s->motion->time;
    bool complete = e ? e->incomplete == 0 : s->motion->complete;
    nh_pen_open(p, NH_PEN_ANSWER, complete && !(s->checked && !s->held) ? "found" : "undecided", NULL);
    if (e) nh_pen_say(p, "%zu motions", e->members);
    else nh_pen_say(p, "A motion");
    nh_pen_say(p, " from t = %.6g to %.6g%s.", time[0], time[count - 1],
               complete ? e || !s->motion->stopped ? "" : ", where an event ends it"
               : e      ? "; not all members reach the end"
                        : ", where it ended early");
    nh_pen_close(p, NH_PEN_ANSWER);
    nh_pen_open(p, NH_PEN_WORDS, NULL, NULL);
    nh_pen_say(p, "%s in {%s}", s->method, s->formulation);
    if (!isnan(s->tolerance)) nh_pen_say(p, ", tolerance %.2g", s->tolerance); /* a fixed step belongs to the method */
    nh_pen_say(p, ".");
    if (s->checked) nh_pen_say(p, " Accuracy: %s.", s->why);
    nh_pen_close(p, NH_PEN_WORDS);
    if (s->scene) nh_pen_words(p, "The smallest model that determines the observables: %s.", s->scene);
}

/* Every member as a thin line, one plot per quantity. */
static void fans(nh_pen *p, const nh_simulation *s)
{
    enum { most_members = 60 };
    const nh_ensemble *e = s->ensemble;
    nh_curve curve[most_members];
    size_t members = e->members < most_members ? e->members : most_members;
    nh_pen_words(p, "Each line is one member%s.", members < e->members ? "; only the first members are drawn" : "");
    for (size_t k = 0; k < e->n; k++) {
        const char *name = s->columns.track[k].name;
        char title[200];
        for (size_t j = 0; j < members; j++)
            curve[j] = (nh_curve){.name = name,
                                  .count = e->count,
                                  .x = e->time,
                                  .x_stride = 1,
                                  .y = e->value + j * e->count * e->n + k,
                                  .y_stride = e->n};
        nh_text plain;
        nh_text_init(&plain);
        nh_typeset_plain(name, &plain);
        snprintf(title, sizeof title, "%.100s of the members over time", nh_text_string(&plain));
        nh_text_clear(&plain);
        nh_plot plot = {.title = title,
                        .description = "One thin line per member of the ensemble",
                        .x_label = "t",
                        .y_label = name,
                        .fan = true,
                        .curves = members,
                        .curve = curve};
        nh_pen_plot(p, &plot, title);
    }
}

/* The picture of --axes; that of a section is shown elsewhere. */
static void columns_against_one_another(nh_pen *p, const nh_simulation *s)
{
    if (!s->has_axes || s->has_section) return;
    nh_motion_plot plot = {0};
    nh_motion_plot_add(&plot, s, NULL);
    nh_plot picture = nh_motion_plot_of(&plot);
    picture.id = "axes";
    nh_pen_plot(p, &picture, plot.title);
    nh_motion_plot_clear(&plot);
}

void nh_simulation_write(const nh_simulation *s, const nh_run *run, nh_pen_style style, nh_text *out)
{
    nh_pen pen, *p = &pen;
    const nh_ensemble *e = s->ensemble;
    const char *note = e ? e->note : s->motion->note;
    nh_pen_subject subject = {.system = s->system, .analysis = s->analysis, .dag = s->model->dag, .shown = run->shown};
    nh_time_series *c = e ? NULL : nh_time_series_of_simulation(s);
    nh_pen_begin(p, style, &subject, e ? "many motions" : "a motion", out);
    answer(p, s);
    if (s->begin) nh_pen_words(p, "No initial state was given. The program chose this one: %s.", s->begin);
    nh_stage *stage = p->ink->stage && !e ? nh_simulation_stage(s, run) : NULL;
    if (stage) p->ink->stage(p->to, stage);
    p->ink->links(p->to, !s->events       ? "motion|Motion|system|System|repeat|Repeat it"
                         : s->has_section ? "motion|Motion|events|Section|system|System|repeat|Repeat it"
                                          : "motion|Motion|events|Events|system|System|repeat|Repeat it");
    if (note[0]) nh_pen_warning(p, note);
    nh_pen_section(p, "motion", "Motion");
    if (c) p->ink->series(p->to, c);
    else fans(p, s);
    columns_against_one_another(p, s);
    nh_events_write(p, s);
    nh_pen_words(p, "%.10g evaluations of the equations, %.3g seconds of integration.",
                 (double)(e ? e->evaluations : s->motion->evaluations), e ? e->seconds : s->motion->seconds);
    nh_pen_system(p, s->model, NULL);
    nh_pen_end(p, run);
    nh_stage_free(stage);
    nh_time_series_free(c);
}

/* A simulation as a document. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "document/facts.h"
#include "document/live.h"
#include "document/simulation.h"
#include "document/time_series.h"
#include "document/typeset.h"
#include "graph/dag.h"
#include "integrals/prove.h"

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

/* ---- the top of its page ---- */

typedef struct {
    const nh_simulation *s;
    size_t count;
    nh_stage_row *row;
    nh_live_quantity *quantity;
} list;

/* Is it the energy under another name? */
static bool is_energy(const list *l, nh_ex e, const nh_options *options)
{
    const nh_model *model = l->s->model;
    nh_ex term[] = {e, nh_neg(model->dag, model->E)};
    return e == model->E || nh_prove_zero(model, 2, term, true, options).proved;
}

/* What is not proved to be conserved is only plotted. */
static void add(list *l, const nh_track *track, const nh_options *options)
{
    enum { most_named = 6 }; /* parameters */
    const nh_simulation *s = l->s;
    bool energy = track->kind == NH_TRACK_ENERGY, words = strchr(track->name, ' ') != NULL;
    nh_proof proof = nh_prove_current(s->model, track->value, true, options);
    if (!proof.proved || (!energy && is_energy(l, track->value, options))) return;
    const char *sure = nh_facts_holds(s->model, &proof, s->system->parameters <= most_named);
    l->quantity[l->count] = (nh_live_quantity){.name = track->name,
                                               .value = track->value,
                                               .proved = true,
                                               .all_parameters = proof.all_parameters,
                                               .fixed = proof.fixed};
    l->row[l->count++] = (nh_stage_row){.name = energy  ? "Energy"
                                                : words ? track->name
                                                        : "",
                                        .doc = "",
                                        .from = energy ? "the symmetry in time" : "",
                                        .sure = *sure == ' ' ? sure + 1 : sure,
                                        .anchor = "",
                                        .label = words ? "" : track->name,
                                        .value = track->value,
                                        .proved = true,
                                        .drift = NAN};
}

nh_stage *nh_simulation_stage(const nh_simulation *s, const nh_run *run)
{
    nh_time_series *series = nh_time_series_of_simulation(s);
    if (!series || series->count < 2) return nh_time_series_free(series), NULL;
    const nh_observables *t = &s->columns;
    nh_options options;
    nh_options_default(&options);
    list l = {.s = s,
              .row = nh_arena_alloc(s->arena, (t->count + 1) * sizeof *l.row),
              .quantity = nh_arena_alloc(s->arena, (t->count + 1) * sizeof *l.quantity)};
    for (size_t i = 0; i < t->count; i++)
        if (t->track[i].kind == NH_TRACK_ENERGY) add(&l, &t->track[i], &options);
    for (size_t i = 0; i < t->count; i++)
        if (t->track[i].kind == NH_TRACK_CURRENT || t->track[i].kind == NH_TRACK_WATCH) add(&l, &t->track[i], &options);
    double *first = nh_arena_alloc(s->arena, (t->count + 1) * sizeof *first);
    for (size_t i = 0; i < t->count; i++) first[i] = series->line[i].value[0];
    nh_live_request request = {.model = s->model,
                               .tracks = t,
                               .first = first,
                               .begin = series->time[0],
                               .end = series->time[series->count - 1],
                               .quantities = l.count,
                               .quantity = l.quantity};
    nh_stage *stage = nh_arena_alloc(s->arena, sizeof *stage);
    *stage = (nh_stage){.series = series,
                        .tracks = t,
                        .live = nh_live_create(&request, nh_live_js_lacks),
                        .command = nh_live_command(s->arena, run, s->system),
                        .rows = l.count,
                        .row = l.row};
    return stage;
}

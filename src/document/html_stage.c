/* The first screen of a page (stage.h). */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "document/export_code.h"
#include "document/formula.h"
#include "document/html_internal.h"
#include "document/live.h"
#include "graph/dag.h"
#include "graph/print.h"
#include "integrals/fixed.h"

enum { most_frames = 401, many = 7 };

/* ---- the model ---- */

/* The tracks of a motion that the page does not compute anew, at some of its times. */
static void put_frames(const nh_stage *s, nh_text *out)
{
    const nh_time_series *c = s->series;
    size_t step = (c->count + most_frames - 2) / most_frames;
    if (!step) step = 1;
    nh_text_add(out, "nhsymModel.motion = {t: [");
    for (size_t i = 0; i < c->count; i += step) nh_text_addf(out, "%s%.7g", i ? "," : "", c->time[i]);
    nh_text_add(out, "],\nvalue: [");
    for (size_t j = 0; j < s->tracks->count; j++) {
        nh_text_add(out, j ? ",\n[" : "[");
        for (size_t i = 0; i < c->count; i += step) {
            double v = c->line[j].value[i * c->line[j].stride];
            if (isfinite(v)) nh_text_addf(out, "%s%.5g", i ? "," : "", v);
            else nh_text_add(out, i ? ",null" : "null");
        }
        nh_text_add(out, "]");
    }
    nh_text_add(out, "]};\n");
}

/* Does the page compute the motion? */
static bool put_model(nh_html_writer *w, const nh_stage *s)
{
    nh_html_add(w, "<script id=\"model\">//<![CDATA[\n");
    nh_live_js(s->live, s->tracks, NH_LIVE_MOST, w->out);
    if (s->live->why) put_frames(s, w->out);
    nh_view *view = nh_view_create(s->series, s->series->count, 1, 1);
    if (view) nh_text_addf(w->out, "nhsymModel.up = %d;\n", view->up);
    nh_view_free(view);
    nh_html_add(w, "nhsymModel.command = ");
    nh_live_js_text(s->command, w->out);
    nh_html_add(w, ";\n//]]></script>\n");
    return !s->live->why;
}

/* ---- the controls ---- */

/* The largest of 1, 2, 5 times a power of ten that is at most x. */
static double rounded(double x)
{
    double e = pow(10, floor(log10(x))), f = x / e;
    return e * (f >= 5 ? 5 : f >= 2 ? 2 : 1);
}

/* A slider from low to high; `snap`: a value at which something special happens, or NAN. */
static void slider(nh_html_writer *w, const char *name, const char *what, double value, double low, double high,
                   double snap)
{
    nh_html_add(w, "<div class=\"sl\" data-name=\"");
    nh_html_text(w, name);
    if (isfinite(snap)) nh_text_addf(w->out, "\" data-snap=\"%.17g", snap);
    nh_html_add(w, "\"><label title=\"");
    nh_html_text(w, what);
    nh_html_add(w, "\">");
    nh_html_source(w, name);
    nh_text_addf(w->out,
                 "</label><input type=\"range\" min=\"%.9g\" max=\"%.9g\" step=\"any\" value=\"%.9g\" aria-label=\"",
                 low, high, value);
    nh_html_text(w, what);
    nh_text_addf(w->out, "\"/><input type=\"number\" step=\"any\" value=\"%.6g\" aria-label=\"", value);
    nh_html_text(w, what);
    nh_html_add(w, ", as a number\"/></div>\n");
}

static bool occurs(const nh_live *l, nh_ex symbol)
{
    for (size_t i = 0; i < l->code->functions; i++) {
        nh_ex *e;
        size_t n = nh_export_expressions(&l->code->function[i], l->code->arena, &e);
        for (size_t k = 0; k < n; k++)
            if (nh_depends(l->model->dag, e[k], symbol)) return true;
    }
    return false;
}

/* The value that some quantity needs. */
static double special(const nh_live *l, size_t parameter)
{
    for (size_t k = 0; k < l->quantities; k++) {
        const nh_ex *fixed = l->quantity[k].fixed;
        if (fixed && nh_fixed_has(l->model, fixed, parameter)) return l->model->parameter_value[parameter];
    }
    return NAN;
}

static void parameter_slider(nh_html_writer *w, const nh_live *l, size_t i)
{
    const nh_parameter *p = &l->model->system->parameter[i];
    double value = p->value, size = value ? fabs(value) : 1, low = value ? rounded(size / 8) : -2,
           high = value ? 3 * size : 2;
    nh_text what;
    nh_text_init(&what);
    nh_text_addf(&what, "%s%s%s", *p->doc ? p->doc : p->name, *p->unit ? ", in " : "", p->unit);
    if (value < 0) slider(w, p->name, nh_text_string(&what), value, -high, -low, special(l, i));
    else slider(w, p->name, nh_text_string(&what), value, low, high, special(l, i));
    nh_text_clear(&what);
}

static void parameter_sliders(nh_html_writer *w, const nh_live *l)
{
    const nh_system *system = l->model->system;
    size_t n = 0;
    for (size_t i = 0; i < system->parameters; i++) n += occurs(l, system->parameter[i].symbol);
    if (!n) return;
    nh_text_addf(w->out, "<div><h4>Parameters</h4><div%s>\n", n > many ? " class=\"many\"" : "");
    for (size_t i = 0; i < system->parameters; i++)
        if (occurs(l, system->parameter[i].symbol)) parameter_slider(w, l, i);
    nh_html_add(w, "</div></div>\n");
}

static void state_slider(nh_html_writer *w, const nh_live *l, size_t i)
{
    static const double turn = 3.15, beside = 0.5;
    const nh_system *system = l->model->system;
    const nh_coordinate *c = i < system->coordinates ? &system->coordinate[i] : NULL;
    double low = -2, high = 2, value = l->initial[i];
    nh_chart_range(l->model->chart, l->symbol[i], &low, &high);
    if (c && c->type == NH_ANGLE) low = fmin(low, -turn), high = fmax(high, turn);
    low = fmin(low, value - beside * fabs(value)), high = fmax(high, value + beside * fabs(value));
    nh_text what;
    nh_text_init(&what);
    if (c) nh_text_addf(&what, "%s at the start", c->doc && *c->doc ? c->doc : c->name);
    else nh_text_addf(&what, "the velocity %s at the start", l->state[i]);
    if (c && c->unit && *c->unit) nh_text_addf(&what, ", in %s", c->unit);
    slider(w, l->state[i], nh_text_string(&what), value, low, high, 0);
    nh_text_clear(&what);
}

static void state_sliders(nh_html_writer *w, const nh_live *l)
{
    nh_text_addf(w->out, "<div><h4>Start, at t = %.4g</h4><div%s>\n", l->begin,
                 l->states > many ? " class=\"many\"" : "");
    for (size_t i = 0; i < l->states; i++) state_slider(w, l, i);
    nh_html_add(w, "</div></div>\n");
}

/* Why there are no sliders. */
static void put_why(nh_html_writer *w, const nh_live *l)
{
    nh_html_text(w, "The motion that the program computed; a page cannot compute it: ");
    nh_html_text(w, l->why);
    nh_html_text(w, ".");
}

static void controls(nh_html_writer *w, const nh_stage *s, bool live)
{
    nh_html_add(w,
                "<div class=\"bar\"><button class=\"play\" id=\"play\" type=\"button\" aria-label=\"play\"></button>"
                "<input type=\"range\" id=\"time\" aria-label=\"time\"/><span class=\"time\" id=\"clock\"></span>"
                "<select id=\"speed\" aria-label=\"speed\"><option value=\"0.25\">\u00bc\u00d7</option><option "
                "value=\"0.5\">\u00bd\u00d7</option><option value=\"1\" selected=\"selected\">1\u00d7</option><option "
                "value=\"2\">2\u00d7</option><option value=\"4\">4\u00d7</option></select></div>\n"
                "<details class=\"ctl\" open=\"open\"><summary>Change parameters and start</summary>\n");
    if (live) {
        nh_html_add(w, "<div class=\"sliders\">\n");
        parameter_sliders(w, s->live);
        state_sliders(w, s->live);
        nh_html_add(w, "</div>\n");
    }
    nh_html_add(w, "<div class=\"under\">");
    if (live) nh_html_add(w, "<label>tolerance <select id=\"tol\"></select></label>");
    nh_html_add(w, "<span id=\"told\">");
    if (!live) put_why(w, s->live);
    nh_html_add(w, "</span><button class=\"lnk\" id=\"csv\" type=\"button\">CSV</button><button class=\"lnk\" "
                   "type=\"button\" data-copy=\"#command\">copy as command</button>");
    if (s->series->shapes)
        nh_html_add(w, "<button class=\"lnk\" id=\"movie\" type=\"button\">animation as SVG</button>");
    if (live)
        nh_html_add(w, "<button class=\"lnk\" id=\"reset\" type=\"button\" hidden=\"hidden\">back to the first "
                       "values</button>");
    nh_html_add(w, "</div><code id=\"command\" class=\"screen\"></code></details>\n");
}

/* ---- the table ---- */

/* Words with the names of coordinates as formulas. */
static void words(nh_html_writer *w, const char *text)
{
    const nh_system *system = w->system;
    nh_text token;
    nh_text_init(&token);
    for (const char *c = text; *c;) {
        size_t n = strcspn(c, " ,");
        nh_text_cut(&token, 0);
        nh_text_add_n(&token, c, n ? n : 1);
        const char *word = nh_text_string(&token);
        bool name = false;
        for (size_t i = 0; i < system->coordinates && strcmp(word, "a"); i++)
            name |= !strcmp(word, system->coordinate[i].name);
        if (name) nh_html_source(w, word);
        else nh_html_prose(w, word);
        c += n ? n : 1;
    }
    nh_text_clear(&token);
}

/* The formulas of a stage are those of its own model, whose graph need not be that of the page's other formulas. */
static nh_dag *graph_of(const nh_stage *s) { return s->live->model->dag; }

static void equals(nh_html_writer *w, const nh_stage *s, const char *label, nh_ex e)
{
    char *text = nh_print_string(graph_of(s), e);
    if (*label) nh_html_source(w, label), nh_html_add(w, " <math><mo>=</mo></math> ");
    nh_html_source(w, text);
    nh_free(text);
}

static void how_sure(nh_html_writer *w, const nh_stage_row *r)
{
    nh_text_addf(w->out, "<td class=\"how\"><span class=\"sure %s\">", r->proved ? "proved" : "numbers");
    nh_html_text(w, r->proved ? "proved" : r->sure);
    nh_html_add(w, "</span>");
    if (r->proved && *r->sure) {
        nh_html_add(w, "<span class=\"sub\">");
        nh_html_prose(w, r->sure);
        nh_html_add(w, "</span>");
    }
    nh_html_add(w, "<span class=\"needs\"></span></td>");
}

/* As text: a formula is no name of a link. */
static void plain_name(nh_html_writer *w, const char *name)
{
    nh_text plain;
    nh_text_init(&plain);
    nh_typeset_plain(name, &plain);
    nh_html_text(w, nh_text_string(&plain));
    nh_text_clear(&plain);
}

static void row(nh_html_writer *w, const nh_stage *s, const nh_formula_list *list, size_t k)
{
    enum { colours = 6 };
    const nh_stage_row *r = &s->row[k];
    nh_text_addf(w->out,
                 "<tr data-quantity=\"%zu\" style=\"--k:var(--c%zu)\"><th scope=\"row\"><span class=\"nm\"><span "
                 "class=\"key\"></span><span>",
                 k, 1 + k % colours);
    if (*r->anchor) nh_text_addf(w->out, "<a href=\"#%s\">", r->anchor);
    if (*r->name) words(w, r->name);
    else plain_name(w, s->live->quantity[k].name);
    nh_html_add(w, *r->anchor ? "</a>" : "");
    if (*r->doc) nh_html_add(w, " <span class=\"doc\">"), nh_html_prose(w, r->doc), nh_html_add(w, "</span>");
    nh_html_add(w, "</span></span><div class=\"f\">");
    if (r->series || !list->short_enough[k]) nh_html_add(w, "<em>a long formula: see below</em>");
    else equals(w, s, r->label, list->formula[k]);
    nh_html_add(w, "</div>");
    if (*r->from) nh_html_add(w, "<span class=\"from\">from "), words(w, r->from), nh_html_add(w, "</span>");
    nh_html_add(w, "</th>");
    how_sure(w, r);
    nh_html_add(w, "<td class=\"now\"><span class=\"val\"></span><span class=\"meter\" aria-hidden=\"true\"><i></i>"
                   "</span><span class=\"dr\">");
    if (isfinite(r->drift)) nh_text_addf(w->out, r->drift > 0 ? "drift %.1e" : "drift 0", r->drift);
    nh_html_add(w, "</span></td></tr>\n");
}

static void quantities(nh_html_writer *w, const nh_stage *s)
{
    if (!s->rows) return;
    nh_ex *e = nh_alloc_array(s->rows, sizeof *e);
    size_t names = 0;
    bool any = false;
    for (size_t k = 0; k < s->rows; k++) e[k] = s->row[k].series ? nh_int(graph_of(s), 0) : s->row[k].value;
    nh_formula_list list = nh_formula_list_make(graph_of(s), s->rows, e, w->shown, &names);
    nh_html_add(w, "<section aria-label=\"conserved quantities\">\n<table class=\"q\"><thead><tr><th "
                   "scope=\"col\">Conserved quantity, and the symmetry that it comes from</th><th scope=\"col\" "
                   "class=\"c2\">how sure</th><th scope=\"col\" class=\"now c3\">now, and drift</th></tr></thead>"
                   "<tbody>\n");
    for (size_t k = 0; k < s->rows; k++) row(w, s, &list, k);
    nh_html_add(w, "</tbody></table>\n");
    for (size_t k = 0; k < list.parts; k++) {
        if (!list.beside[k]) continue;
        nh_html_add(w, any ? ", " : "<p class=\"parts\">");
        any = true;
        equals(w, s, list.part[k].name, list.part[k].value);
    }
    nh_html_add(w, any ? "</p>\n" : "");
    nh_html_add(w, "<p class=\"hint\">Drift: the largest change along the motion, relative to the terms; the bar runs "
                   "from 10<sup>\u221216</sup> to 1.</p>\n</section>\n");
    nh_formula_list_clear(&list);
    nh_free(e);
}

/* ---- plots ---- */

/* The model's number of a curve that is a line of the series; SIZE_MAX: it has none. */
static size_t track_of(const nh_stage *s, const nh_curve *curve)
{
    for (size_t j = 0; j < s->live->tracks; j++)
        if (s->series->line[s->live->track[j]].value == curve->y) return j;
    return SIZE_MAX;
}

static void legend(nh_html_writer *w, size_t track, const char *name)
{
    nh_text_addf(w->out, "<span class=\"lg\" data-track=\"%zu\">", track);
    nh_html_source(w, name);
    nh_html_add(w, "</span>");
}

void nh_html_live_figure(nh_html_writer *w, nh_plot *plot, const char *what, const char *axis)
{
    size_t found = 0;
    char id[40];
    for (size_t k = 0; k < plot->curves; k++) found += track_of(w->stage, &plot->curve[k]) != SIZE_MAX;
    nh_text_addf(w->out, "<figure class=\"%s\" data-title=\"", found ? "plot" : "still");
    nh_html_text(w, plot->title);
    nh_html_add(w, "\">");
    snprintf(id, sizeof id, "fig%zu", ++w->figures);
    plot->id = id;
    nh_svg_plot(plot, w->out);
    nh_html_add(w, "<figcaption><b>");
    nh_html_text(w, what);
    if (strchr(axis, '/')) nh_html_add(w, ", "), nh_html_prose(w, strchr(axis, '/') + 2);
    nh_html_add(w, "</b>");
    for (size_t k = 0; k < plot->curves && found; k++) {
        size_t track = track_of(w->stage, &plot->curve[k]);
        if (track != SIZE_MAX) legend(w, track, plot->curve[k].name);
    }
    nh_html_add(w, "</figcaption></figure>\n");
}

/* Without a picture of its own where no script runs. */
static void drift(nh_html_writer *w, const nh_stage *s)
{
    enum { colours = 6 };
    nh_html_add(w, "<figure class=\"plot\" data-drift=\"\" data-title=\"Drift of the conserved quantities\">"
                   "<figcaption><b>Drift</b>");
    for (size_t k = 0; k < s->rows && k < colours; k++)
        if (!s->live->without[k]) legend(w, k, *s->row[k].label ? s->row[k].label : s->live->quantity[k].name);
    nh_html_add(w, "</figcaption></figure>\n");
}

static void picture(nh_html_writer *w, const nh_time_series *c)
{
    if (!c->shapes) {
        nh_html_add(w, "<div id=\"stage\"></div>\n");
        return;
    }
    nh_html_add(w, "<div class=\"stage\" id=\"stage\"><div class=\"still\">");
    nh_html_still(w, c);
    nh_html_add(w, "</div><svg class=\"scene\" role=\"img\" tabindex=\"0\" aria-label=\"The system in motion. Drawn: ");
    nh_html_text(w, c->drawing);
    nh_html_add(w, "\"></svg><p class=\"hint drawn\">Drawn: ");
    nh_html_text(w, c->drawing);
    nh_html_add(w, ".</p><div class=\"view\"><button type=\"button\" data-do=\"out\" aria-label=\"zoom "
                   "out\">\u2212</button><button type=\"button\" data-do=\"in\" aria-label=\"zoom in\">+</button>"
                   "<button type=\"button\" data-do=\"fit\">fit</button><button type=\"button\" data-do=\"follow\" "
                   "aria-pressed=\"false\">follow</button></div></div>\n");
}

void nh_html_stage(nh_html_writer *w, const nh_stage *s)
{
    nh_text model, *page = w->out;
    w->stage = s;
    nh_html_head_end(w);
    nh_text_init(&model);
    w->out = &model;
    bool live = put_model(w, s);
    w->out = page;
    nh_text_addf(w->out, "<div class=\"hero%s\">\n<section aria-label=\"the motion\">\n", s->rows ? "" : " alone");
    picture(w, s->series);
    controls(w, s, live);
    nh_html_add(w, "</section>\n");
    quantities(w, s);
    nh_html_add(w, "</div>\n<div class=\"plots\">\n");
    nh_html_plots(w, s->series);
    if (live && s->rows) drift(w, s);
    nh_html_add(w, "</div>\n<p class=\"hint script\">Click a plot to go to that time. Drag to zoom in. Click a name to "
                   "hide its curve. <button class=\"lnk\" id=\"unzoom\" type=\"button\" hidden=\"hidden\">zoom "
                   "out</button></p>\n");
    nh_html_add(w, nh_text_string(&model));
    nh_text_clear(&model);
}

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "graph/print.h"
#include "document/facts.h"
#include "document/formula.h"
#include "document/html_internal.h"

/* ---- the formula ---- */

/* sum' c_k T_k(s) by Clenshaw's recurrence. */
static double chebyshev(const double *c, size_t degree, double s)
{
    double b1 = 0, b2 = 0;
    for (size_t k = degree; k > 0; k--) {
        double b0 = c[k] + 2 * s * b1 - b2;
        b2 = b1;
        b1 = b0;
    }
    return c[0] + s * b1 - b2;
}

static void series_plot(nh_html_writer *w, const nh_current *f)
{
    enum { points = 101, most = 7 };
    const nh_series *s = f->series;
    size_t n = s->words < most ? s->words : most;
    double *x = nh_alloc_array((n + 1) * points, sizeof *x);
    nh_curve curve[most];
    char name[most][24], title[200];
    for (size_t j = 0; j < points; j++) x[j] = s->low + (s->high - s->low) * (double)j / (points - 1);
    for (size_t i = 0; i < n; i++) {
        double *y = x + (i + 1) * points;
        for (size_t j = 0; j < points; j++) y[j] = chebyshev(s->coefficient + i * s->stride, s->degree, 2.0 * (double)j / (points - 1) - 1);
        snprintf(name[i], sizeof *name, "f_%zu", i + 1);
        curve[i] = (nh_curve){.name = name[i], .count = points, .x = x, .x_stride = 1, .y = y, .y_stride = 1};
    }
    snprintf(title, sizeof title, "Coefficient functions of %.100s", f->name);
    nh_plot plot = {.title = title, .description = "The coefficient functions over their variable", .x_label = nh_name_of(w->dag, s->variable),
                    .y_label = n == 1 ? name[0] : "value", .curves = n, .curve = curve};
    nh_html_figure(w, &plot, "The coefficient functions.");
    nh_free(x);
}

static void series_table(nh_html_writer *w, const nh_current *f)
{
    const nh_series *s = f->series;
    nh_text heads;
    nh_text_init(&heads);
    nh_text_add(&heads, "k");
    for (size_t i = 0; i < s->words; i++) nh_text_addf(&heads, "|f%zu", i + 1);
    nh_html_add(w, "<details><summary>Chebyshev coefficients</summary>\n");
    nh_html_table(w, "Coefficients of T_k on the interval mapped to [-1, 1]", nh_text_string(&heads));
    nh_text_clear(&heads);
    for (size_t k = 0; k <= s->degree; k++) {
        nh_text_addf(w->out, "<tr><th scope=\"row\">%zu</th>", k);
        for (size_t i = 0; i < s->words; i++) nh_html_cell(w, s->coefficient[i * s->stride + k], 10);
        nh_html_add(w, "</tr>\n");
    }
    nh_html_table_end(w);
    nh_html_add(w, "</details>\n");
}

static void series(nh_html_writer *w, const nh_current *f)
{
    const nh_series *s = f->series;
    nh_html_add(w, "<div class=\"formula main\">");
    nh_html_source(w, f->name);
    nh_html_add(w, "<math><mo>=</mo></math> <math>");
    nh_formula_series(w->dag, s, NH_MATHML, w->out);
    nh_html_add(w, "</math></div>\n<p>Each f is a Chebyshev series of degree ");
    nh_html_count(w, s->degree);
    nh_html_add(w, " in ");
    nh_html_source(w, nh_name_of(w->dag, s->variable));
    nh_html_add(w, "on [");
    nh_html_number(w, s->low, 4);
    nh_html_add(w, ", ");
    nh_html_number(w, s->high, 4);
    nh_html_add(w, "]: it has no closed form among the functions of the search.</p>\n");
    series_plot(w, f);
    series_table(w, f);
}

static void as_text(nh_html_writer *w, const nh_current *f)
{
    nh_dag *d = w->dag;
    nh_ex own = nh_formula_shown(w->r, f->phi);
    bool other = f->has_in_velocities && f->in_velocities != nh_chart_in_velocities(w->r->model->chart, own);
    char *text = nh_print_short(d, own, w->shown), *plain = other ? nh_print_short(d, f->in_velocities, w->shown) : NULL;
    if (text || plain) nh_html_add(w, "<details class=\"copy\"><summary>As text, to copy</summary>\n");
    if (text) nh_html_tagged(w, "pre", text);
    if (plain) nh_html_add(w, "<p>in coordinate velocities</p>\n");
    if (plain) nh_html_tagged(w, "pre", plain);
    if (text || plain) nh_html_add(w, "</details>\n");
    nh_free(plain);
    nh_free(text);
}

/* ---- what is known of it ---- */

static void certificate(nh_html_writer *w, const nh_current *f)
{
    nh_html_add(w, "<dt>Certified</dt><dd>");
    if (f->proof.proved) nh_html_add(w, "proved");
    else {
        nh_html_add(w, "conserved to ");
        nh_html_number(w, floor(f->proof.digits), 6);
        nh_html_add(w, " digits");
        nh_html_add(w, nh_formula_doubt(f));
    }
    nh_html_text(w, nh_facts_holds(w->r->model, &f->proof, false));
    nh_html_text(w, nh_facts_where(w->r, f));
    nh_html_add(w, "</dd>\n<dt>Residual</dt><dd>");
    nh_html_number(w, f->heldout, 2);
    nh_html_add(w, " at points outside the fit</dd>\n");
}

static void drift_line(nh_html_writer *w, const nh_current *f)
{
    const nh_validation *v = w->r->validation;
    if (!v) return;
    nh_html_add(w, "<dt>Drift</dt><dd>");
    nh_html_number(w, f->drift.drift[NH_DRIFT_RUNS - 1], 2);
    nh_html_add(w, " along a motion computed with tolerance ");
    nh_html_number(w, v->tolerance[NH_DRIFT_RUNS - 1], 2);
    nh_text_addf(w->out, "; %s</dd>\n", nh_facts_drift(&f->drift));
}

static void standing(nh_html_writer *w, const nh_current *f)
{
    nh_html_add(w, "<p class=\"tags\">");
    if (f->meaning[0]) {
        nh_html_add(w, "<span>");
        nh_html_meaning(w, f->meaning);
        nh_html_add(w, "</span>");
    }
    if (f->independence == NH_INDEPENDENT) nh_html_tagged(w, "span", "independent");
    if (f->independence == NH_DEPENDENT) nh_html_tagged(w, "span", "depends on the others");
    if (f->independence == NH_DOUBTFUL) nh_html_tagged(w, "span", "perhaps dependent on the others");
    if (f->independence == NH_CONSTANT) nh_html_tagged(w, "span", "constant on the submanifold");
    if (f->local) nh_html_tagged(w, "span", "local: many-valued on an angle");
    nh_html_add(w, "</p>\n");
    if (!f->relation) return;
    nh_html_add(w, "<div class=\"formula\">");
    nh_html_source(w, f->relation);
    nh_html_add(w, "</div>\n");
}

void nh_html_field(nh_html_writer *w, size_t n, const char *const *along, const nh_ex *e)
{
    char (*text)[200] = nh_alloc_array(n + 1, sizeof *text);
    const char **label = nh_alloc_array(n + 1, sizeof *label);
    nh_ex *component = nh_alloc_array(n + 1, sizeof *component);
    size_t count = 0;
    for (size_t i = 0; i < n; i++) {
        if (nh_is_zero(w->dag, e[i])) continue;
        snprintf(text[count], sizeof *text, "Z|%.180s", along[i]);
        label[count] = text[count];
        component[count++] = e[i];
    }
    nh_html_formulas(w, count, label, component);
    if (!count) nh_html_add(w, "<p>It vanishes.</p>\n");
    nh_free(component);
    nh_free(label);
    nh_free(text);
}

static void symmetry(nh_html_writer *w, const nh_current *f)
{
    const nh_analysis *r = w->r;
    const nh_model *o = r->model;
    nh_html_add(w, "<details><summary>Its symmetry Z</summary>\n");
    nh_field_term *term;
    size_t count = nh_formula_field(r, &f->symmetry, &term);
    const char **along = nh_alloc_array(count + 1, sizeof *along);
    nh_ex *e = nh_alloc_array(count + 1, sizeof *e);
    for (size_t i = 0; i < count; i++) {
        along[i] = term[i].along ? term[i].along : "Gamma";
        e[i] = term[i].coefficient;
    }
    if (count && !term[0].along) nh_html_add(w, "<p>Written as a multiple of \u0393 plus the remaining components.</p>\n");
    nh_html_field(w, count, along, e);
    nh_free(e);
    nh_free(along);
    if (!f->symmetry.bracket_in_distribution) nh_html_add(w, "<p>By how much [\u0393,\u2009Z] leaves the canonical distribution:</p>\n");
    for (size_t a = 0; a < o->k && !f->symmetry.bracket_in_distribution; a++) {
        char label[240];
        snprintf(label, sizeof label, "<msub><mi>i</mi><mrow><mo>[</mo><mi mathvariant=\"normal\">\u0393</mi><mo>,</mo><mi>Z</mi><mo>]</mo></mrow></msub><msup><mi>\u03d5</mi><mn>%zu</mn></msup>", a + 1);
        nh_html_formula(w, label, f->symmetry.bracket_form[a]);
    }
    nh_html_add(w, "</details>\n");
}

/* |Phi - Phi(0)| over the size of its terms. */
static void drift_plot(nh_html_writer *w, const nh_current *f)
{
    const nh_analysis *r = w->r;
    const nh_validation *v = r->validation;
    size_t j = 0;
    if (!v || v->count < 2 || !(f->drift.scale > 0)) return;
    const nh_track *track = r->tracks.track;
    while (j < v->watches && track[j].value != f->phi) j++;
    while (j < v->watches && track[j].kind != NH_TRACK_CURRENT) j++;
    if (j == v->watches) return;
    double *y = nh_alloc_array(v->count, sizeof *y), first = v->watch[j];
    for (size_t i = 0; i < v->count; i++) y[i] = fabs(v->watch[i * v->watches + j] - first) / f->drift.scale;
    nh_curve curve = {.name = f->name, .count = v->count, .x = v->time, .x_stride = 1, .y = y, .y_stride = 1};
    char title[200];
    snprintf(title, sizeof title, "Drift of %.100s along the test motion", f->name);
    nh_plot plot = {.title = title, .description = "Absolute change since the start, relative to the size of the terms of the current, on a logarithmic scale",
                    .x_label = "t", .y_label = "relative change", .log_y = true, .floor = 1e-17, .timed = true, .curves = 1, .curve = &curve};
    nh_html_add(w, "<details class=\"drift\"><summary>Drift plot</summary>\n");
    nh_html_figure(w, &plot, "Change of the current since the start, relative to the size of its terms; rounding is near 10\u207b\u00b9\u2076.");
    nh_html_add(w, "</details>\n");
    nh_free(y);
}

static void card(nh_html_writer *w, const nh_current *f)
{
    w->names = 0;
    nh_html_add(w, "<article class=\"card\">\n<h3>");
    nh_html_source(w, f->name);
    nh_html_add(w, "</h3>\n");
    standing(w, f);
    if (f->series) series(w, f);
    else nh_html_formula(w, f->name, f->phi);
    nh_html_add(w, "<dl>\n");
    certificate(w, f);
    drift_line(w, f);
    if (f->has_symmetry) {
        nh_html_add(w, "<dt>Symmetry</dt><dd>");
        nh_facts_symmetry(&f->symmetry, NH_FACTS_PAGE, "; ", w->out);
        nh_html_add(w, "</dd>\n");
    }
    nh_html_add(w, "</dl>\n");
    if (f->has_symmetry && !f->series) symmetry(w, f);
    drift_plot(w, f);
    if (!f->series) as_text(w, f);
    nh_html_add(w, "</article>\n");
}

/* ---- abbreviations, and what is only nearly conserved ---- */

static void abbreviations(nh_html_writer *w)
{
    const nh_analysis_file *a = w->r->analysis;
    if (!a || !a->definitions || !w->r->count) return;
    nh_html_add(w, "<p>where</p>\n");
    for (size_t i = 0; i < a->definitions; i++) {
        nh_html_add(w, "<div class=\"formula\">");
        nh_html_source(w, a->definition[i].name);
        nh_html_add(w, "<math><mo>=</mo></math> ");
        nh_html_source(w, a->definition[i].text);
        nh_html_add(w, "</div>\n");
    }
}

static void pieces(nh_html_writer *w)
{
    const nh_analysis *r = w->r;
    if (!r->pieces) return;
    nh_html_add(w, "<h3>Constant only in a region</h3>\n<p>These functions are constant while a motion stays in the given region. They are not counted.</p>\n");
    for (size_t k = 0; k < r->pieces; k++) {
        const nh_current *f = &r->piece[k];
        nh_html_add(w, "<article class=\"card\">\n<h4>");
        nh_html_source(w, f->name);
        nh_html_add(w, "</h4>\n");
        nh_html_formula(w, f->name, f->phi);
        nh_html_add(w, "<dl>\n<dt>Holds</dt><dd>");
        nh_html_text(w, f->region);
        nh_html_add(w, "</dd>\n");
        certificate(w, f);
        nh_html_add(w, "</dl>\n");
        as_text(w, f);
        nh_html_add(w, "</article>\n");
    }
}

static void furthers(nh_html_writer *w)
{
    const nh_analysis *r = w->r;
    if (!r->furthers) return;
    nh_html_add(w, "<h3>Further integrals</h3>\n<p>These integrals are functions of the currents above, but no polynomials in them. They are not counted.</p>\n");
    for (size_t k = 0; k < r->furthers; k++) {
        const nh_current *f = &r->further[k].current;
        nh_html_add(w, "<article class=\"card\">\n<h4>");
        nh_html_source(w, f->name);
        nh_html_add(w, "</h4>\n");
        nh_html_formula(w, f->name, f->phi);
        nh_html_add(w, "<dl>\n<dt>Degree</dt><dd>");
        nh_html_count(w, r->further[k].degree);
        nh_html_add(w, "</dd>\n");
        certificate(w, f);
        nh_html_add(w, "</dl>\n");
        as_text(w, f);
        nh_html_add(w, "</article>\n");
    }
    if (r->relations) nh_html_add(w, "<h4>Relations</h4>\n");
    for (size_t k = 0; k < r->relations; k++) {
        nh_html_add(w, "<div class=\"formula\">");
        nh_html_source(w, r->relation[k].left);
        nh_html_add(w, "<math><mo>=</mo></math> ");
        nh_html_source(w, r->relation[k].right);
        nh_html_add(w, "</div>\n");
    }
}

static void almost(nh_html_writer *w)
{
    const nh_analysis *r = w->r;
    if (!r->almosts) return;
    nh_html_add(w, "<h3>Almost conserved, not currents</h3>\n<p>In double precision these functions look constant. With more digits they change, or they have no certificate. They are not counted; the slowest comes first.</p>\n");
    for (size_t k = 0; k < r->almosts; k++) {
        nh_html_add(w, "<article class=\"card almost\">\n");
        nh_html_formula(w, "", r->almost[k].phi);
        nh_html_add(w, "<p>Its rate cancels to ");
        nh_html_number(w, floor(r->almost[k].digits), 6);
        nh_html_add(w, " digits; it changes by ");
        nh_html_number(w, r->almost[k].rate, 2);
        nh_html_add(w, " of its own variation per unit of time.</p>\n</article>\n");
    }
}

void nh_html_currents(nh_html_writer *w)
{
    const nh_analysis *r = w->r;
    nh_html_add(w, "<section id=\"currents\"><h2>Currents</h2>\n<p>A current is a function of time, coordinates and velocities that is constant along every motion.</p>\n");
    if (!r->count) nh_html_add(w, "<p>None was found. The stages of the search are listed below.</p>\n");
    for (size_t k = 0; k < r->count; k++) card(w, &r->found[k]);
    abbreviations(w);
    furthers(w);
    pieces(w);
    almost(w);
    nh_html_add(w, "</section>\n");
}

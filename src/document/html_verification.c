/* The answer to `verify` as a page. */
#include <math.h>
#include <stdio.h>

#include "base/memory.h"
#include "document/facts.h"
#include "document/html_internal.h"
#include "document/verification.h"

static void certificate(nh_html_writer *w, const nh_verification *v)
{
    if (v->proof.proved) {
        nh_html_add(w, ", proved");
        nh_html_text(w, nh_facts_holds(v->model, &v->proof, false));
    } else {
        nh_html_add(w, ", to ");
        nh_html_number(w, floor(v->proof.digits), 6);
        nh_html_add(w, v->proof.rounded ? " digits (its numbers are rounded to doubles)" : " digits");
    }
}

static void answer(nh_html_writer *w, const nh_verification *v, bool field)
{
    nh_text_addf(w->out, "<p class=\"answer %s\">", v->conserved ? "found" : "undecided");
    if (v->conserved) {
        nh_text_addf(w->out, "Yes: this is %s", nh_verification_noun(v, field));
        certificate(w, v);
        nh_html_text(w, nh_verification_branches(v));
    } else if (v->region) {
        nh_html_add(w, "No: this is conserved only in a region: ");
        nh_html_text(w, v->region);
    } else {
        nh_text_addf(w->out, "No: this is not %s", nh_verification_noun(v, field));
    }
    nh_html_add(w, v->conserved && v->trivial ? "; it is trivial: the current is a constant.</p>\n" : ".</p>\n");
}

static void counterexample(nh_html_writer *w, const nh_verification *v, bool field)
{
    if (!v->has_counterexample) return;
    nh_html_add(w, "<section id=\"counterexample\"><h2>Where it fails</h2>\n<p>");
    nh_html_add(w, field ? "The condition that fails: " : "Its rate of change along the motion through this state is ");
    if (field) nh_html_text(w, v->equation);
    if (field) nh_html_add(w, ". In this state it gives ");
    nh_html_number(w, v->rate, 6);
    nh_html_add(w, ", not 0.</p>\n");
    nh_html_table(w, "A state of the system", "quantity|value");
    for (size_t j = 0; j < v->model->width; j++) {
        nh_html_add(w, "<tr><th scope=\"row\">");
        nh_html_source(w, nh_name_of(w->dag, v->model->chart->symbol[j]));
        nh_html_add(w, "</th><td>");
        nh_html_number(w, v->counterexample[j], 6);
        nh_html_add(w, "</td></tr>\n");
    }
    nh_html_table_end(w);
    nh_html_add(w, "</section>\n");
}

static void symmetry(nh_html_writer *w, const nh_verification *v, bool field)
{
    if (!v->has_symmetry || v->trivial) return;
    nh_text_addf(w->out, "<section id=\"symmetry\"><h2>%s</h2>\n", field ? "The field, with its Chetaev components" : "The symmetry that gives it");
    size_t m = v->model->m, n = v->model->n;
    const char **along = nh_alloc_array(1 + m + n, sizeof *along);
    nh_ex *e = nh_alloc_array(1 + m + n, sizeof *e);
    along[0] = "t", e[0] = v->symmetry.Z0;
    for (size_t s = 0; s < m; s++) along[1 + s] = v->system->coordinate[s].name, e[1 + s] = v->symmetry.field.space[s];
    for (size_t i = 0; i < n; i++) along[1 + m + i] = nh_name_of(w->dag, v->model->chart->w[i]), e[1 + m + i] = v->symmetry.W[i];
    nh_html_field(w, 1 + m + n, along, e);
    nh_free(e);
    nh_free(along);
    nh_html_add(w, "<dl><dt>Symmetry</dt><dd>");
    nh_facts_symmetry(&v->symmetry, NH_FACTS_PAGE, "; ", w->out);
    nh_html_add(w, "</dd></dl>\n</section>\n");
}

/* What a field has outside of the canonical distribution; it has no current then. */
static void outside(nh_html_writer *w, const nh_verification *v)
{
    nh_html_add(w, "<p>Z is not in the canonical distribution:</p>\n");
    for (size_t a = 0; a < v->model->k; a++) {
        char label[200];
        snprintf(label, sizeof label, "<msub><mi>i</mi><mi>Z</mi></msub><msup><mi>\u03d5</mi><mn>%zu</mn></msup>", a + 1);
        nh_html_formula(w, label, v->form[a]);
    }
}

static void question(nh_html_writer *w, const nh_verification *v, bool field)
{
    if (v->outside || v->of_equations) nh_html_add(w, "<section id=\"question\"><h2>The field</h2>\n");
    else if (field) nh_html_add(w, "<section id=\"question\"><h2>The current of the field</h2>\n");
    else nh_html_add(w, "<section id=\"question\"><h2>The question</h2>\n<p>Does this stay constant along every motion?</p>\n");
    nh_html_add(w, "<article class=\"card\">\n");
    if (v->of_equations) nh_html_formula(w, "<mrow><mo>[</mo><mi>\u0393</mi><mo>,</mo><mi>Z</mi><mo>]</mo><mo>=</mo><mi>f</mi><mi>\u0393</mi><mo>,</mo><mspace width=\"1em\"></mspace><mi>f</mi></mrow>", v->factor);
    else if (v->outside) outside(w, v);
    else nh_html_formula(w, "Phi", v->current);
    nh_html_add(w, "<dl><dt>Residual</dt><dd>");
    nh_html_number(w, v->residual, 2);
    nh_html_add(w, field ? ", the largest residual of the conditions at random states, relative to their terms</dd></dl>\n</article></section>\n"
                         : ", the largest rate at random states, relative to its terms</dd></dl>\n</article></section>\n");
}

void nh_html_verification(const nh_verification *v, bool field, const nh_run *run, nh_text *out)
{
    nh_html_writer w = {.out = out, .system = v->system, .dag = v->model->dag, .chart = nh_verification_chart(v), .shown = run->shown, .written = INFINITY};
    bool shown = v->has_symmetry && !v->trivial;
    nh_html_begin(&w, field ? "is it a symmetry?" : "is it conserved?");
    answer(&w, v, field);
    nh_html_links(&w, v->has_counterexample ? "question|The question|counterexample|Where it fails|system|System|words|Words|repeat|Repeat it"
                      : shown               ? "question|The question|symmetry|The symmetry|system|System|words|Words|repeat|Repeat it"
                                            : "question|The question|system|System|words|Words|repeat|Repeat it");
    question(&w, v, field);
    counterexample(&w, v, field);
    symmetry(&w, v, field);
    nh_html_add(&w, "<section id=\"system\"><h2>The system</h2>\n");
    nh_html_written(&w);
    nh_html_add(&w, "<h3>As it was understood</h3>\n");
    nh_html_equations(&w, v->model);
    nh_html_add(&w, "</section>\n");
    nh_html_geometry(&w, v->arena, v->theory);
    nh_html_words(&w, "current, symmetry, case, distribution, projectable, residual");
    nh_html_repeat(&w, run);
    nh_html_end(&w);
}

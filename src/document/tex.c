#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/versions.h"
#include "exact/normal.h"
#include "graph/print.h"
#include "document/typeset.h"
#include "document/facts.h"
#include "document/formula.h"
#include "document/html.h"
#include "document/tex_internal.h"

/* ---- the answer ---- */

static void answer(nh_tex_writer *w)
{
    const nh_analysis *r = w->r;
    if (r->count) {
        nh_tex_count(w, r->independent);
        nh_text_addf(w->out, " independent current%s of at most ", r->independent == 1 ? "" : "s");
        nh_tex_count(w, r->local_maximum);
        nh_tex_add(w, ".");
    } else {
        nh_tex_add(w, nh_facts_nothing(r));
        nh_tex_add(w, ".");
    }
    nh_tex_add(w, " ");
    nh_tex_words(w, nh_facts_search(r));
    nh_tex_add(w, " ");
    nh_text words;
    nh_text_init(&words);
    nh_facts_completeness(r, &words);
    nh_tex_words(w, nh_text_string(&words));
    nh_text_clear(&words);
    nh_tex_add(w, "\n");
    for (size_t i = 0; i < r->warnings; i++) {
        nh_tex_add(w, "\n\\textbf{Warning:} ");
        nh_tex_words(w, r->warning[i]);
        nh_tex_add(w, "\n");
    }
}

/* ---- currents ---- */

/* Z = Z_Gamma Gamma + Z_x d/dx + ..., its components, and by how much the bracket leaves the canonical distribution: what text and page have. */
static void field(nh_tex_writer *w, const nh_current *f)
{
    nh_field_term *term;
    size_t n = nh_formula_field(w->r, &f->symmetry, &term);
    nh_text label;
    nh_tex_add(w, n ? "Its symmetry is $Z = " : "Its symmetry is $Z = 0$.\n");
    for (size_t i = 0; i < n; i++) {
        nh_text_addf(w->out, "%sZ_{", i ? " + " : "");
        nh_typeset(term[i].along ? term[i].along : "Gamma", NH_LATEX, w->out);
        nh_tex_add(w, term[i].along ? "}\\,\\partial/\\partial " : "}\\,\\Gamma");
        if (term[i].along) nh_typeset(term[i].along, NH_LATEX, w->out);
    }
    nh_tex_add(w, n ? "$ with\n" : "");
    for (size_t i = 0; i < n; i++) {
        nh_text_init(&label);
        nh_text_add(&label, "Z_{");
        nh_typeset(term[i].along ? term[i].along : "Gamma", NH_LATEX, &label);
        nh_text_add(&label, "}");
        nh_tex_labelled(w, nh_text_string(&label), term[i].coefficient);
        nh_text_clear(&label);
    }
    for (size_t a = 0; a < w->r->model->k && !f->symmetry.bracket_in_distribution; a++) {
        char name[80];
        snprintf(name, sizeof name, "i_{[\\Gamma, Z]}\\,\\phi^{%zu}", a + 1);
        nh_tex_labelled(w, name, f->symmetry.bracket_form[a]);
    }
}

static void certificate(nh_tex_writer *w, const nh_current *f)
{
    const nh_validation *v = w->r->validation;
    if (f->proof.proved) nh_tex_add(w, "Proved");
    else {
        nh_tex_add(w, "Conserved to ");
        nh_tex_number(w, floor(f->proof.digits), 6);
        nh_tex_add(w, " digits");
        nh_tex_add(w, nh_formula_doubt(f));
    }
    nh_tex_words(w, nh_facts_holds(w->r->model, &f->proof, false));
    nh_tex_words(w, nh_facts_where(w->r, f));
    nh_tex_add(w, ".");
    nh_tex_add(w, " Residual ");
    nh_tex_number(w, f->heldout, 2);
    if (v) {
        nh_tex_add(w, ", drift ");
        nh_tex_number(w, f->drift.drift[NH_DRIFT_RUNS - 1], 2);
        nh_tex_add(w, " at tolerance ");
        nh_tex_number(w, v->tolerance[NH_DRIFT_RUNS - 1], 2);
    }
    nh_tex_add(w, f->local ? "; local: many-valued on an angle.\n" : ".\n");
}

/* c_k for the functions from..to-1; cells have a width, so that the columns of a long table agree after the first pass of TeX. */
static void coefficient_table(nh_tex_writer *w, const nh_series *s, size_t from, size_t to)
{
    enum { digits = 10 };
    static const char narrow[] = "\\hbox to 2em{\\hss ", wide[] = " & \\hbox to 9.5em{\\hss ";
    nh_text_addf(w->out, "{\\footnotesize\\begin{longtable}{*{%zu}{r}}\n%s$k$}", to - from + 1, narrow);
    for (size_t i = from; i < to; i++) nh_text_addf(w->out, "%s$c_k$ of $f_{%zu}$}", wide, i + 1);
    nh_tex_add(w, " \\\\\\hline\\endhead\n");
    for (size_t k = 0; k <= s->degree; k++) {
        nh_text_addf(w->out, "%s%zu}", narrow, k);
        for (size_t i = from; i < to; i++) {
            nh_tex_add(w, wide);
            nh_tex_number(w, s->coefficient[i * s->stride + k], digits);
            nh_tex_add(w, "}");
        }
        nh_tex_add(w, " \\\\\n");
    }
    nh_tex_add(w, "\\end{longtable}}\n");
}

static void series(nh_tex_writer *w, const nh_current *f)
{
    enum { beside = 4 }; /* functions that a page is wide enough for */
    const nh_series *s = f->series;
    const char *q = nh_name_of(w->r->model->dag, s->variable);
    nh_tex_add(w, "\\nhformula{");
    nh_typeset(f->name, NH_LATEX, w->out);
    nh_tex_add(w, " = ");
    nh_formula_series(w->r->model->dag, s, NH_LATEX, w->out);
    nh_tex_add(w, "}\nwithout closed form: for ");
    nh_tex_name(w, q);
    nh_tex_add(w, " from $a={}$");
    nh_tex_number(w, s->low, 10);
    nh_tex_add(w, " to $b={}$");
    nh_tex_number(w, s->high, 10);
    nh_tex_add(w, " each $f$ is a series of Chebyshev polynomials\n\\nhformula{\\sum_{k=0}^{");
    nh_text_addf(w->out, "%zu} c_k\\, T_k\\!\\left(\\frac{2\\,", s->degree);
    nh_typeset(q, NH_LATEX, w->out);
    nh_tex_add(w, " - a - b}{b - a}\\right)}\n");
    for (size_t i = 0; i < s->words; i += beside) coefficient_table(w, s, i, i + beside < s->words ? i + beside : s->words);
}

static void current(nh_tex_writer *w, const nh_current *f)
{
    nh_tex_add(w, "\\subsection*{");
    nh_tex_name(w, f->name);
    if (f->meaning[0]) nh_tex_add(w, ": "), nh_tex_words(w, f->meaning);
    nh_tex_add(w, "}\n");
    if (f->series) series(w, f);
    else nh_tex_formula(w, f->name, f->phi);
    if (f->independence == NH_DEPENDENT) nh_tex_add(w, f->relation ? "It depends on the others:\n" : "It depends on the others. ");
    if (f->independence == NH_DOUBTFUL) nh_tex_add(w, "Perhaps it depends on the others. ");
    if (f->independence == NH_CONSTANT) nh_tex_add(w, "It is constant on the submanifold. ");
    if (f->relation) nh_tex_display(w, "", f->relation);
    certificate(w, f);
    if (!f->has_symmetry) return;
    nh_facts_symmetry(&f->symmetry, NH_FACTS_TEX, "; ", w->out);
    nh_tex_add(w, ".\n");
    if (!f->series) field(w, f);
}

static void piece(nh_tex_writer *w, const nh_current *f)
{
    nh_tex_add(w, "\\subsection*{");
    nh_tex_name(w, f->name);
    nh_tex_add(w, "}\nIt is constant only in a region, and is not counted: ");
    nh_tex_words(w, f->region);
    nh_tex_add(w, ".\n");
    nh_tex_formula(w, f->name, f->phi);
}

static void further(nh_tex_writer *w, const nh_further_integral *g)
{
    nh_tex_add(w, "\\subsection*{");
    nh_tex_name(w, g->current.name);
    nh_tex_add(w, "}\nIt is a function of the currents above, but no polynomial in them; degree ");
    nh_tex_number(w, (double)g->degree, 2);
    nh_tex_add(w, ".\n");
    nh_tex_formula(w, g->current.name, g->current.phi);
}

static void almost(nh_tex_writer *w)
{
    const nh_analysis *r = w->r;
    if (r->almosts) nh_tex_add(w, "\\subsection*{Almost conserved, not currents}\n");
    for (size_t k = 0; k < r->almosts; k++) {
        nh_tex_formula(w, "", r->almost[k].phi);
        nh_tex_add(w, "Its rate cancels to ");
        nh_tex_number(w, floor(r->almost[k].digits), 6);
        nh_tex_add(w, " digits; it changes by ");
        nh_tex_number(w, r->almost[k].rate, 2);
        nh_tex_add(w, " of its own variation per unit of time.\n");
    }
}

static void currents_section(nh_tex_writer *w)
{
    const nh_analysis_file *a = w->r->analysis;
    nh_tex_add(w, "\\section{Currents}\n");
    for (size_t k = 0; k < w->r->count; k++) current(w, &w->r->found[k]);
    for (size_t k = 0; k < w->r->furthers; k++) further(w, &w->r->further[k]);
    if (w->r->relations) nh_tex_add(w, "\\subsection*{Relations}\n");
    for (size_t k = 0; k < w->r->relations; k++) nh_tex_display(w, w->r->relation[k].left, w->r->relation[k].right);
    for (size_t k = 0; k < w->r->pieces; k++) piece(w, &w->r->piece[k]);
    for (size_t i = 0; a && w->r->count && i < a->definitions; i++) {
        nh_tex_add(w, i ? "" : "\\medskip Here\n");
        nh_tex_display(w, a->definition[i].name, a->definition[i].text);
    }
    almost(w);
}

/* ---- figures and tables ---- */

static void draw(void *context, const nh_plot *plot, const char *caption) { nh_tex_plot(context, plot, caption); }

static void figures_section(nh_tex_writer *w)
{
    if (!w->r->figures) return;
    nh_tex_add(w, "\\section{Figures}\n");
    nh_html_plots(w->r, NH_SECTION_FIGURES, draw, w);
}

static void motion_section(nh_tex_writer *w)
{
    const nh_validation *v = w->r->validation;
    if (!v) return;
    nh_tex_add(w, "\\section{A motion}\n");
    nh_tex_words(w, v->method);
    nh_tex_add(w, " in ");
    nh_tex_chart(w, v->chart);
    nh_tex_add(w, ", $t$ from ");
    nh_tex_number(w, v->begin, 6);
    nh_tex_add(w, " to ");
    nh_tex_number(w, v->end, 6);
    nh_tex_add(w, ".\n");
    nh_html_plots(w->r, NH_SECTION_MOTION, draw, w);
    if (!v->currents) return;
    nh_tex_add(w, "Drift of the currents, by tolerance of the integration\n\\begin{center}\\begin{tabular}{lrrr}\ncurrent");
    for (size_t i = 0; i < NH_DRIFT_RUNS; i++) nh_tex_add(w, " & "), nh_tex_number(w, v->tolerance[i], 2);
    nh_tex_add(w, " \\\\\\hline\n");
    for (size_t k = 0; k < v->currents; k++) {
        nh_tex_name(w, w->r->found[k].name);
        for (size_t i = 0; i < NH_DRIFT_RUNS; i++) nh_tex_add(w, " & "), nh_tex_number(w, v->current[k].drift[i], 2);
        nh_tex_add(w, " \\\\\n");
    }
    nh_tex_add(w, "\\end{tabular}\\end{center}\n");
}

/* Both routes side by side. */
static void routes(nh_tex_writer *w)
{
    const nh_spectrum *const route[2] = {&w->r->current, &w->r->symmetry};
    double number[2][NH_SPECTRUM_NUMBERS];
    bool both = route[0]->done && route[1]->done;
    if (!route[0]->done && !route[1]->done) return;
    for (size_t k = 0; k < 2; k++)
        if (route[k]->done) nh_facts_spectrum(route[k], number[k]);
    nh_text_addf(w->out, "\\begin{center}\\begin{tabular}{l%s}\nroute%s%s \\\\\\hline\n", both ? "rr" : "r", route[0]->done ? " & current" : "", route[1]->done ? " & symmetry" : "");
    const char *head = NH_SPECTRUM_HEADS;
    for (size_t i = 0; i < NH_SPECTRUM_NUMBERS; i++) {
        size_t length = strcspn(head, "|");
        nh_text_add_n(w->out, head, length);
        head += length + (head[length] == '|');
        for (size_t k = 0; k < 2; k++) {
            if (!route[k]->done) continue;
            nh_tex_add(w, " & ");
            nh_tex_number(w, number[k][i], i < NH_SPECTRUM_COUNTS ? 10 : 2);
        }
        nh_tex_add(w, " \\\\\n");
    }
    nh_tex_add(w, "\\end{tabular}\\end{center}\n");
}

static void stages(nh_tex_writer *w)
{
    const nh_analysis *r = w->r;
    if (!r->stages) return;
    nh_tex_add(w, "What was tried\n\\begin{longtable}{lrrr}\nstage & columns & null values & new currents \\\\\\hline\\endhead\n");
    for (size_t i = 0; i < r->stages; i++) {
        const nh_stage_record *s = &r->stage[i];
        nh_tex_add(w, "\\parbox[t]{0.42\\linewidth}{\\raggedright ");
        nh_tex_words(w, s->name);
        nh_tex_add(w, "\\strut} & ");
        if (s->skipped) {
            nh_tex_add(w, "\\multicolumn{3}{l}{too large: \\texttt{");
            nh_tex_words(w, nh_limit_words(r->arena, &s->limit));
            nh_tex_add(w, "}} \\\\\n");
            continue;
        }
        nh_tex_count(w, s->columns);
        nh_tex_add(w, " & ");
        nh_tex_count(w, s->dimension);
        nh_tex_add(w, s->undecided ? " (undecided) & " : " & ");
        nh_tex_count(w, s->found);
        nh_tex_add(w, " \\\\\n");
    }
    nh_tex_add(w, "\\end{longtable}\n");
}

static void search_section(nh_tex_writer *w)
{
    const nh_analysis *r = w->r;
    nh_tex_add(w, "\\section{How it was found}\nAnsatz: ");
    nh_tex_words(w, r->ansatz_note);
    nh_tex_add(w, ". ");
    nh_tex_count(w, r->samples);
    nh_tex_add(w, " sample points, ");
    nh_tex_count(w, r->rejected);
    nh_tex_add(w, " rejected.\n");
    nh_html_plots(r, NH_SECTION_SEARCH, draw, w);
    routes(w);
    stages(w);
}

void nh_tex(const nh_analysis *r, bool fragment, nh_text *out)
{
    nh_tex_writer w = nh_tex_writer_of(r, out);
    nh_run run = {r->command, r->system_path, r->analysis_path, r->options.seed, r->options.shown, r->timing.total};
    nh_tex_head(&w, fragment, NULL);
    nh_tex_add(&w, "\\begingroup\\parindent=0pt\\emergencystretch=3em\n");
    answer(&w);
    currents_section(&w);
    nh_tex_written(&w);
    nh_tex_equations(&w, r->model);
    if (r->other) nh_tex_equations(&w, r->other);
    nh_tex_explicit_motion(&w);
    nh_tex_geometry(&w, r->arena, r->theory);
    motion_section(&w);
    figures_section(&w);
    search_section(&w);
    nh_tex_repeat(&w, &run);
    nh_tex_add(&w, "\\par\\endgroup\n");
    if (!fragment) nh_tex_add(&w, "\\end{document}\n");
}

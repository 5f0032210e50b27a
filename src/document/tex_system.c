/* What every LaTeX document has: its head, the system, its equations of motion, how to repeat the run. */
#include <stdio.h>

#include "base/versions.h"
#include "exact/normal.h"
#include "graph/print.h"
#include "document/facts.h"
#include "document/tex_internal.h"

/* ---- before and after the body ---- */

static const char macros[] =
    "\\providecommand{\\nhnumber}[2]{$#2$} % all digits, and what is shown\n"
    "\\providecommand{\\nhbreak}{\\penalty0\\hskip0pt\\relax}\n"
    "\\definecolor{nhblue}{HTML}{0072B2}\\definecolor{nhred}{HTML}{D55E00}\\definecolor{nhgreen}{HTML}{009E73}\\definecolor{nhpink}{HTML}{CC79A7}"
    "\\definecolor{nhorange}{HTML}{E69F00}\\definecolor{nhsky}{HTML}{56B4E9}\n";

void nh_tex_head(nh_tex_writer *w, bool fragment, const char *what)
{
    static const char packages[] = "\\usepackage{amsmath,amssymb,longtable,pgfplots}\n";
    nh_tex_add(w, "% Written by nhsym " NH_VERSION ".\n");
    if (fragment) nh_text_addf(w->out, "%% To be read by \\input; the document needs these lines before its beginning:\n%% %s%% \\pgfplotsset{compat=1.16}\n", packages);
    else nh_text_addf(w->out, "\\documentclass[11pt,a4paper]{article}\n%s\\usepackage[margin=2.5cm]{geometry}\n\\pgfplotsset{compat=1.16}\n", packages);
    nh_tex_add(w, nh_tex_formula_macro);
    nh_tex_add(w, macros);
    if (fragment) return;
    nh_tex_add(w, "\\title{");
    nh_tex_words(w, w->system->title);
    if (what) nh_text_addf(w->out, ": %s", what);
    nh_tex_add(w, "}\n\\author{nhsym " NH_VERSION "}\n\\date{}\n\\begin{document}\n\\maketitle\n");
}

nh_tex_writer nh_tex_writer_of(const nh_analysis *r, nh_text *out)
{
    const nh_chart *chart = r->other && r->other->chart->roots ? r->other->chart : r->model->chart;
    return (nh_tex_writer){.out = out, .system = r->system, .analysis = r->analysis, .dag = r->model->dag, .chart = chart,
                           .shown = r->options.shown, .written = r->options.written, .r = r};
}

/* ---- the system ---- */

static void parameters(nh_tex_writer *w)
{
    const nh_system *s = w->system;
    if (!s->parameters) return;
    nh_tex_add(w, "\\begin{center}\\begin{tabular}{lll}\nparameter & value & meaning \\\\\\hline\n");
    for (size_t i = 0; i < s->parameters; i++) {
        nh_tex_name(w, s->parameter[i].name);
        nh_tex_add(w, " & ");
        nh_tex_number(w, s->parameter[i].value, 10);
        nh_tex_add(w, " ");
        if (s->parameter[i].unit) nh_tex_words(w, s->parameter[i].unit);
        nh_tex_add(w, " & \\parbox[t]{0.6\\linewidth}{\\raggedright ");
        if (s->parameter[i].doc) nh_tex_words(w, s->parameter[i].doc);
        nh_tex_add(w, "\\strut} \\\\\n");
    }
    nh_tex_add(w, "\\end{tabular}\\end{center}\n");
}

static void constraint_words(nh_tex_writer *w)
{
    nh_text words;
    if (!w->r) {
        nh_tex_add(w, "Constraints\n");
        return;
    }
    nh_text_init(&words);
    nh_facts_constraint(w->r, &words);
    nh_text_add(&words, w->r->branch ? "; " : "");
    nh_facts_branch(w->r, &words);
    nh_tex_count(w, w->r->model->k);
    nh_tex_add(w, " ");
    nh_tex_words(w, nh_text_string(&words));
    nh_tex_add(w, "\n");
    nh_text_clear(&words);
}

void nh_tex_written(nh_tex_writer *w)
{
    const nh_system *s = w->system;
    nh_tex_add(w, "\\section{The system}\n");
    if (s->source && s->source[0]) nh_tex_words(w, s->source), nh_tex_add(w, ".\n\n");
    parameters(w);
    nh_tex_add(w, "Lagrangian\n");
    nh_tex_formula(w, "L", s->lagrangian);
    if (s->constraints) constraint_words(w);
    for (size_t i = 0; i < s->constraints; i++) nh_tex_display(w, "", s->constraint[i].text);
}

void nh_tex_equations(nh_tex_writer *w, const nh_model *o)
{
    char label[200];
    nh_tex_add(w, "\\subsection*{");
    nh_tex_add(w, nh_facts_equations(o));
    nh_tex_add(w, ", in ");
    nh_tex_chart(w, o->chart->name);
    nh_tex_add(w, "}\n");
    for (size_t i = 0; i < o->n; i++) {
        snprintf(label, sizeof label, "%.180s'", nh_name_of(o->dag, o->chart->w[i]));
        nh_tex_formula(w, label, o->a[i]);
    }
    if (o->k) nh_tex_add(w, "Chetaev multipliers\n");
    for (size_t a = 0; a < o->k; a++) {
        snprintf(label, sizeof label, o->k == 1 ? "mu" : "mu_%zu", a + 1);
        nh_tex_formula(w, label, o->mu[a]);
    }
    if (o->k) nh_tex_add(w, "Force of the constraints\n");
    for (size_t s = 0; s < o->m && o->k; s++) {
        snprintf(label, sizeof label, "F_%.180s", o->system->coordinate[s].name);
        if (!nh_is_zero(o->dag, o->reaction[s])) nh_tex_formula(w, label, o->reaction[s]);
    }
}

/* ---- to repeat it ---- */

void nh_tex_repeat(nh_tex_writer *w, const nh_run *run)
{
    nh_tex_add(w, "\\section{To repeat it}\n\\begin{raggedright}\n");
    if (run->command) nh_tex_code(w, run->command), nh_tex_add(w, "\n\n");
    nh_tex_add(w, "nhsym " NH_VERSION ", seed ");
    nh_tex_number(w, run->seed, 17);
    if (run->system_path) nh_tex_add(w, ", system file "), nh_tex_code(w, run->system_path);
    if (run->analysis_path) nh_tex_add(w, ", analysis file "), nh_tex_code(w, run->analysis_path);
    for (size_t i = 0; nh_version_of(i).name; i++) {
        nh_tex_add(w, ", ");
        nh_tex_words(w, nh_version_of(i).name);
        nh_tex_add(w, " ");
        nh_tex_words(w, nh_version_of(i).version);
    }
    nh_tex_add(w, ", ");
    nh_tex_words(w, nh_versions_machine());
    nh_tex_add(w, ".\n\n\\end{raggedright}\n");
}

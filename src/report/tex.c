#include "report/tex.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "expr/normal.h"
#include "expr/print.h"
#include "expr/typeset.h"
#include "report/formula.h"

enum { line_symbols = 60, widest = 75 }; /* letters and signs that a line takes, about */

typedef struct {
    const nh_result *r;
    nh_text *out;
} writer;

static void words(writer *w, const char *text)
{
    for (const char *c = text; *c; c++) {
        if (strchr("{}$&#_%", *c)) nh_text_addf(w->out, "\\%c", *c);
        else if (*c == '\\') nh_text_add(w->out, "\\textbackslash{}");
        else if (*c == '^') nh_text_add(w->out, "\\textasciicircum{}");
        else if (*c == '~') nh_text_add(w->out, "\\textasciitilde{}");
        else if (*c == '<') nh_text_add(w->out, "\\textless{}");
        else if (*c == '>') nh_text_add(w->out, "\\textgreater{}");
        else if ((unsigned char)*c >= 0x20) nh_text_add_n(w->out, c, 1);
        else nh_text_add(w->out, " ");
    }
}

static void number(writer *w, double value, int digits)
{
    char text[60];
    if (!isfinite(value)) {
        nh_text_add(w->out, "--");
        return;
    }
    snprintf(text, sizeof text, "%.*g", digits, value);
    char *exponent = strchr(text, 'e');
    int power = 0;
    if (exponent) sscanf(exponent + 1, "%d", &power);
    if (exponent) *exponent = 0;
    nh_text_addf(w->out, exponent ? "$%s\\cdot 10^{%d}$" : "$%s$", text, power);
}

/* ---- formulas ---- */

/* Letters, digits and signs that are seen: a command counts as one. */
static size_t symbols(const char *latex)
{
    size_t n = 0;
    for (const char *c = latex; *c; c++) {
        if (*c == '\\') {
            n += c[1] != ',' && strncmp(c, "\\left", 5) && strncmp(c, "\\right", 6) && strncmp(c, "\\frac", 5);
            while ((c[1] >= 'a' && c[1] <= 'z') || (c[1] >= 'A' && c[1] <= 'Z')) c++;
        } else {
            n += *c != '{' && *c != '}' && *c != ' ' && *c != '^' && *c != '_';
        }
    }
    return n;
}

typedef struct {
    nh_text *out;
    size_t on_line, most;
} lines;

static void measure(void *context, const char *piece)
{
    lines *l = context;
    if (symbols(piece) > l->most) l->most = symbols(piece);
}

static void put_piece(void *context, const char *piece)
{
    lines *l = context;
    size_t n = symbols(piece);
    if (l->on_line && l->on_line + n > line_symbols) {
        nh_text_add(l->out, "\\\\\n&\\quad{}");
        l->on_line = 0;
    }
    nh_text_add(l->out, piece);
    l->on_line += n;
}

/* What cannot be broken is given as text that can be broken after every sign. */
static void as_text(writer *w, const char *label, const char *text)
{
    nh_text_add(w->out, "\\par\\noindent{\\footnotesize\\ttfamily\\raggedright ");
    words(w, label);
    nh_text_add(w->out, label[0] ? " = " : "");
    for (const char *c = text; *c; c++) {
        char one[2] = {*c, 0};
        words(w, one);
        if (strchr("+-*/( ", *c)) nh_text_add(w->out, "\\allowbreak{}");
    }
    nh_text_add(w->out, "\\par}\n");
}

/* label = text; label may be "". */
static void display(writer *w, const char *label, const char *text)
{
    lines l = {.out = w->out};
    bool formula = nh_typeset_pieces(text, NH_LATEX, measure, &l) > 0;
    if (!formula || l.most > widest) {
        as_text(w, label, text);
        return;
    }
    nh_text_add(w->out, "\\begin{align*}\n&");
    if (label[0] && nh_typeset(label, NH_LATEX, w->out)) nh_text_add(w->out, " = ");
    l.on_line = strlen(label);
    nh_typeset_pieces(text, NH_LATEX, put_piece, &l);
    nh_text_add(w->out, "\n\\end{align*}\n");
}

static void formula(writer *w, const char *label, nh_ex e)
{
    nh_dag *d = w->r->model->dag;
    char *text = nh_print_short(d, nh_formula_abbreviate(w->r, e), w->r->options.shown);
    if (text) {
        display(w, label, text);
    } else {
        nh_text_add(w->out, "\\par\\noindent ");
        words(w, label);
        nh_text_addf(w->out, ": too long for a page%s.\\par\n", (double)nh_complexity(d, e) <= w->r->options.written ? "; the JSON has it" : "");
    }
    nh_free(text);
}

/* ---- sections ---- */

static void system_section(writer *w)
{
    const nh_result *r = w->r;
    const nh_system *s = r->system;
    nh_text_add(w->out, "\\section{The system}\n");
    if (s->source && s->source[0]) words(w, s->source), nh_text_add(w->out, ".\n\n");
    if (s->parameters) nh_text_add(w->out, "\\begin{center}\\begin{tabular}{lll}\nparameter & value & meaning \\\\\\hline\n");
    for (size_t i = 0; i < s->parameters; i++) {
        nh_text_add(w->out, "$");
        if (!nh_typeset(s->parameter[i].name, NH_LATEX, w->out)) nh_text_add(w->out, "?");
        nh_text_add(w->out, "$ & ");
        number(w, s->parameter[i].value, 10);
        nh_text_add(w->out, " ");
        if (s->parameter[i].unit) words(w, s->parameter[i].unit);
        nh_text_add(w->out, " & ");
        if (s->parameter[i].doc) words(w, s->parameter[i].doc);
        nh_text_add(w->out, " \\\\\n");
    }
    if (s->parameters) nh_text_add(w->out, "\\end{tabular}\\end{center}\n");
    nh_text_add(w->out, "Lagrangian\n");
    formula(w, "L", s->lagrangian);
    if (s->constraints) nh_text_addf(w->out, "Constraints (%s, %s)\n", nh_constraint_type_name(r->constraint.type), nh_constraint_integrability(r->model, &r->constraint));
    for (size_t i = 0; i < s->constraints; i++) display(w, "", s->constraint[i].text);
    nh_text_add(w->out, "Reduced equations in ");
    words(w, r->model->chart->name);
    nh_text_add(w->out, "\n");
    for (size_t i = 0; i < r->model->n; i++) {
        char label[200];
        snprintf(label, sizeof label, "%.180s'", nh_name_of(r->model->dag, r->model->chart->w[i]));
        formula(w, label, r->model->a[i]);
    }
    if (r->model->k) nh_text_add(w->out, "Chetaev multipliers\n");
    for (size_t a = 0; a < r->model->k; a++) {
        char label[40];
        snprintf(label, sizeof label, "mu_%zu", a + 1);
        formula(w, label, r->model->mu[a]);
    }
}

static void field(writer *w, const nh_found *f)
{
    const nh_system *s = w->r->system;
    nh_text_add(w->out, "Its symmetry has the components\n");
    for (size_t i = 0; i <= s->coordinates; i++) {
        char label[200];
        nh_ex e = i ? f->symmetry.field.space[i - 1] : f->symmetry.Z0;
        snprintf(label, sizeof label, "Z_%.180s", i ? s->coordinate[i - 1].name : "t");
        if (!nh_is_zero(w->r->model->dag, e)) formula(w, label, e);
    }
}

static void current(writer *w, const nh_found *f)
{
    nh_text_add(w->out, "\\subsection*{$");
    if (!nh_typeset(f->name, NH_LATEX, w->out)) nh_text_add(w->out, "?");
    nh_text_add(w->out, "$");
    if (f->meaning[0]) nh_text_add(w->out, ": "), words(w, f->meaning);
    nh_text_add(w->out, "}\n");
    if (f->series) nh_text_addf(w->out, "A Chebyshev series of degree %zu without closed form; the JSON tells more.\n", f->series->degree);
    else formula(w, f->name, f->phi);
    if (f->relation) nh_text_add(w->out, "It depends on the others:\n"), display(w, "", f->relation);
    if (f->proof.all_parameters) nh_text_add(w->out, "Proved for all parameter values.");
    else if (f->proof.proved) nh_text_add(w->out, "Proved for these parameter values.");
    else nh_text_addf(w->out, "Its rate cancels to %.0f digits.", floor(f->proof.digits));
    nh_text_add(w->out, " Residual ");
    number(w, f->heldout, 2);
    if (w->r->validation) nh_text_add(w->out, ", drift "), number(w, f->drift.drift[NH_DRIFT_RUNS - 1], 2);
    nh_text_add(w->out, ".\n");
    if (!f->has_symmetry) return;
    if (f->symmetry.kase) nh_text_addf(w->out, "Case %d; ", f->symmetry.kase);
    nh_text_addf(w->out, "$[\\Gamma, Z]$ %s the canonical distribution.\n", f->symmetry.bracket_in_distribution ? "lies in" : "leaves");
    if (!f->series) field(w, f);
}

static void search_section(writer *w)
{
    const nh_result *r = w->r;
    nh_text_add(w->out, "\\section{How it was found}\nAnsatz ");
    words(w, r->ansatz_note);
    nh_text_addf(w->out, ". %zu sample points.\n", r->samples);
    if (r->current.done) nh_text_addf(w->out, "%zu columns, %zu rows, %zu null values.\n", r->current.columns, r->current.rows, r->current.dimension);
    for (size_t i = 0; i < r->warnings; i++) nh_text_add(w->out, "\n\\textbf{Warning:} "), words(w, r->warning[i]), nh_text_add(w->out, "\n");
    nh_text_add(w->out, "\n\\section{To repeat it}\nnhsym " NH_VERSION);
    if (r->command) nh_text_add(w->out, ": \\texttt{"), words(w, r->command), nh_text_add(w->out, "}");
    nh_text_addf(w->out, ", seed %.0f.\n", r->options.seed);
}

void nh_tex(const nh_result *r, nh_text *out)
{
    writer w = {r, out};
    nh_text_add(out, "\\documentclass[11pt,a4paper]{article}\n\\usepackage{amsmath,amssymb}\n\\usepackage[margin=2.5cm]{geometry}\n\\allowdisplaybreaks\n\\setlength{\\parindent}{0pt}\n\\title{");
    words(&w, r->system->title);
    nh_text_add(out, "}\n\\author{nhsym " NH_VERSION "}\n\\date{}\n\\begin{document}\n\\maketitle\n");
    if (r->count) nh_text_addf(out, "%zu independent current%s of at most %zu.%s\n", r->independent, r->independent == 1 ? "" : "s", r->local_maximum, r->partial ? " The search was ended early." : "");
    else nh_text_add(out, "No current was found in this ansatz.\n");
    system_section(&w);
    nh_text_add(out, "\\section{Currents}\n");
    for (size_t k = 0; k < r->count; k++) current(&w, &r->found[k]);
    const nh_analysis *a = r->analysis;
    for (size_t i = 0; a && r->count && i < a->definitions; i++) {
        nh_text_add(out, i ? "" : "Here\n");
        display(&w, a->definition[i].name, a->definition[i].text);
    }
    search_section(&w);
    nh_text_add(out, "\\end{document}\n");
}

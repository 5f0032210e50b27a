#include "document/summary_internal.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "exact/normal.h"
#include "graph/print.h"
#include "document/facts.h"
#include "document/formula.h"
#include "document/geometry_sheet.h"
#include "document/motion_sheet.h"

enum { line_width = 100 };

void nh_summary_heading(nh_summary_writer *w, const char *text)
{
    nh_text_addf(w->out, "\n%s%s%s\n", w->style.colour ? "\033[1m" : "", text, w->style.colour ? "\033[0m" : "");
}

static void faint(nh_summary_writer *w, bool on)
{
    if (w->style.colour) nh_text_add(w->out, on ? "\033[2m" : "\033[0m");
}

static void abbreviations(nh_summary_writer *w)
{
    const nh_analysis_file *a = w->r->analysis;
    for (size_t i = 0; a && i < a->definitions; i++) nh_text_addf(w->out, "  %s %s = %s\n", i ? "     " : "where", a->definition[i].name, a->definition[i].text);
}

/* A formula that begins at column `hang`, broken before + and - (or after *) so that nothing runs off the page. */
static void wrapped(nh_summary_writer *w, int hang, const char *rest)
{
    int room = line_width - hang;
    const char *end = rest + strlen(rest);
    while (end - rest > room) {
        int cut = 0;
        for (int i = 1; i < room; i++)
            if (rest[i] == ' ' && (rest[i + 1] == '+' || rest[i + 1] == '-')) cut = i;
        for (int i = 1; i < room && !cut; i++)
            if (rest[room - i] == '*') cut = room - i + 1;
        if (!cut) break;
        nh_text_add_n(w->out, rest, (size_t)cut);
        nh_text_addf(w->out, "\n%*s", hang, "");
        rest += cut + (rest[cut] == ' ');
    }
    nh_text_addf(w->out, "%s\n", rest);
}

/* The formula as text; when it is too long, how long it would be. */
static char *text_of(const nh_summary_writer *w, nh_ex e)
{
    return nh_formula_text(w->r->model->dag, e, w->r->options.shown);
}

/* "label = formula" */
static void formula(nh_summary_writer *w, int indent, const char *label, nh_ex e)
{
    char *text = text_of(w, nh_formula_abbreviate(w->r, e));
    int at = indent + (int)nh_text_width(label);
    nh_text_addf(w->out, "%*s%s", indent, "", label);
    wrapped(w, at < 24 ? at : indent + 4, text);
    nh_free(text);
}

/* ---- the system ---- */

/* Which functions the constraints alone keep constant. */
static void integrals_line(nh_summary_writer *w)
{
    const nh_analysis *r = w->r;
    size_t hidden = r->constraint.hidden, left = hidden - r->integrals;
    if (hidden == 0) return;
    bool all = r->constraint.holonomic;
    nh_text_addf(w->out, "%zu %s%s: ", hidden, all ? "integral" : "hidden holonomic constraint", hidden == 1 ? "" : "s");
    for (size_t i = 0; i < r->integrals; i++) {
        const nh_current *f = &r->found[r->integral[i]];
        char *text = nh_print_string(r->model->dag, f->phi);
        bool brief = strlen(text) <= line_width / 2;
        nh_text_addf(w->out, "%s%s%s%s = const%s", i ? ", " : "", f->name, brief ? " = " : "", brief ? text : "", f->local ? " (local)" : "");
        nh_free(text);
    }
    if (left) nh_text_addf(w->out, "%s%zu without a closed form in this ansatz", r->integrals ? ", and " : "", left);
    nh_text_add(w->out, "\n");
}

static void system_lines(nh_summary_writer *w)
{
    const nh_analysis *r = w->r;
    const nh_system *s = r->system;
    nh_text_addf(w->out, "%s%s%s", w->style.colour ? "\033[1m" : "", s->title, w->style.colour ? "\033[0m" : "");
    for (size_t i = 0; i < s->parameters; i++) nh_text_addf(w->out, "%s%s = %.10g", i ? ", " : "   with ", s->parameter[i].name, s->parameter[i].value);
    nh_text_addf(w->out, "\n%zu coordinate%s", s->coordinates, s->coordinates == 1 ? "" : "s");
    if (s->constraints) {
        nh_text_addf(w->out, ", %zu ", s->constraints);
        nh_facts_constraint(r, w->out);
    } else {
        nh_text_add(w->out, ", no constraints");
    }
    nh_text_addf(w->out, "; constraint submanifold of dimension %zu\n", 1 + r->model->m + r->model->n);
    nh_facts_branch(r, w->out);
    nh_text_add(w->out, r->branch ? "\n" : "");
    integrals_line(w);
}

static void equations_of(nh_summary_writer *w, const nh_model *o)
{
    nh_text label;
    for (size_t i = 0; i < o->n; i++) {
        nh_text_init(&label);
        nh_text_addf(&label, "%s' = ", nh_name_of(o->dag, o->chart->w[i]));
        formula(w, 2, nh_text_string(&label), o->a[i]);
        nh_text_clear(&label);
    }
}

static void equations(nh_summary_writer *w)
{
    const nh_analysis *r = w->r;
    nh_text title;
    nh_text_init(&title);
    nh_text_addf(&title, "%s, in %s", nh_facts_equations(r->model), r->model->chart->name);
    nh_summary_heading(w, nh_text_string(&title));
    nh_text_clear(&title);
    equations_of(w, r->model);
    if (r->other) {
        nh_text_addf(w->out, "  and in %s:\n", r->other->chart->name);
        equations_of(w, r->other);
    }
    for (size_t a = 0; a < r->model->k; a++) {
        if (a == 0) nh_summary_heading(w, "Chetaev multipliers");
        nh_dag *d = r->model->dag;
        bool shorter = r->other && ((double)nh_complexity(d, r->other->mu[a]) <= r->options.shown || nh_complexity(d, r->other->mu[a]) <= nh_complexity(d, r->model->mu[a]));
        const nh_model *o = shorter ? r->other : r->model;
        nh_text_addf(w->out, "  of %s:\n", r->system->constraint[a].text);
        formula(w, 4, "mu = ", o->mu[a]);
    }
}

/* ---- currents ---- */

static void component(nh_summary_writer *w, const nh_field_term *term, bool first)
{
    nh_ex e = nh_formula_abbreviate(w->r, term->coefficient);
    const char *before = term->along ? "d/d" : "", *along = term->along ? term->along : "Gamma";
    nh_text text;
    nh_text_init(&text);
    char *printed = text_of(w, e);
    bool sum = nh_formula_is_sum(printed), minus = !sum && printed[0] == '-';
    nh_text_add(w->out, first ? (minus ? "        Z = -" : "        Z = ") : minus ? "          - " : "          + ");
    if (sum) nh_text_addf(&text, "(%s) ", printed);
    else if (strcmp(printed + minus, "1")) nh_text_addf(&text, "%s ", printed + minus);
    nh_text_addf(&text, "%s%s", before, along);
    nh_free(printed);
    wrapped(w, 12, nh_text_string(&text));
    nh_text_clear(&text);
}

static void field_lines(nh_summary_writer *w, const nh_current *f)
{
    nh_field_term *term;
    size_t n = nh_formula_field(w->r, &f->symmetry, &term);
    for (size_t i = 0; i < n; i++) component(w, &term[i], i == 0);
    if (n == 0) nh_text_add(w->out, "        Z = 0\n");
}

static void certificate(nh_summary_writer *w, const nh_current *f)
{
    nh_text_add(w->out, "        ");
    const char *holds = nh_facts_holds(w->r->model, &f->proof, true);
    if (f->proof.proved) nh_text_addf(w->out, "proved%s", holds);
    else nh_text_addf(w->out, "conserved to %.0f digits%s%s", f->proof.digits, nh_formula_doubt(f), holds);
    nh_text_add(w->out, nh_facts_where(w->r, f));
    nh_text_addf(w->out, "; held-out residual %.1e", f->heldout);
    if (w->r->validation && !f->region && f->drift.until != 0) nh_text_addf(w->out, "; drift %.1e at tolerance %.0e", f->drift.drift[NH_DRIFT_RUNS - 1], w->r->validation->tolerance[NH_DRIFT_RUNS - 1]);
    nh_text_add(w->out, "\n");
}

static void bracket_lines(nh_summary_writer *w, const nh_current *f)
{
    const nh_analysis *r = w->r;
    nh_text_add(w->out, "        ");
    nh_facts_symmetry(&f->symmetry, NH_FACTS_TEXT, ";\n        ", w->out);
    nh_text_add(w->out, "\n");
    if (f->symmetry.bracket_in_distribution) return;
    for (size_t a = 0; a < r->model->k; a++) {
        nh_text label;
        nh_text_init(&label);
        nh_text_addf(&label, "i_[Gamma,Z] phi^%zu = ", a + 1);
        formula(w, 8, nh_text_string(&label), f->symmetry.bracket_form[a]);
        nh_text_clear(&label);
    }
}

static void series_lines(nh_summary_writer *w, const nh_series *s)
{
    nh_dag *d = w->r->model->dag;
    const char *q = nh_name_of(d, s->variable);
    nh_text_add(w->out, "        ");
    for (size_t i = 0; i < s->words; i++) {
        nh_text_addf(w->out, "%sf%zu(%s)", i ? " + " : "", i + 1, q);
        if (nh_is_number(d, s->word[i], 1)) continue;
        nh_text_add(w->out, "*");
        nh_print(d, s->word[i], w->out);
    }
    nh_text_addf(w->out, "\n        f: Chebyshev series of degree %zu in %s on [%g, %g] without closed form (coefficients in the JSON)\n", s->degree, q, s->low, s->high);
    if (!s->equation) return;
    nh_text_add(w->out, "        the same: ");
    wrapped(w, 12, s->equation);
}

static void current(nh_summary_writer *w, const nh_current *f)
{
    nh_text_addf(w->out, "\n  %s%s%s", w->style.colour ? "\033[32m" : "", f->name, w->style.colour ? "\033[0m" : "");
    if (f->meaning[0]) nh_text_addf(w->out, "  (%s)", f->meaning);
    if (f->independence == NH_DEPENDENT) nh_text_addf(w->out, "  depends on the currents above%s%s", f->relation ? ": " : "", f->relation ? f->relation : "");
    if (f->independence == NH_DOUBTFUL) nh_text_addf(w->out, "  perhaps dependent on the currents above (gradient fraction %.1e)", f->fraction);
    if (f->independence == NH_CONSTANT) nh_text_add(w->out, "  constant on the submanifold");
    if (f->local) nh_text_add(w->out, "  [local: many-valued on an angle]");
    if (f->region) nh_text_addf(w->out, "  %s", f->region);
    nh_text_add(w->out, "\n");
    if (f->series) series_lines(w, f->series);
    else formula(w, 8, "", f->phi);
    if (f->has_symmetry && !f->series) field_lines(w, f);
    faint(w, true);
    certificate(w, f);
    if (f->has_symmetry) bracket_lines(w, f);
    faint(w, false);
}

/* What doubles take for a current and more digits do not. */
static void almost(nh_summary_writer *w)
{
    enum { longest = 40, most = 2 };
    const nh_analysis *r = w->r;
    for (size_t k = 0; k < r->almosts && k < most; k++) {
        const nh_near_current *a = &r->almost[k];
        bool brief = nh_complexity(r->model->dag, a->phi) <= longest;
        nh_text_addf(w->out, "\n  almost conserved, not a current: its rate cancels to %.0f digits; it changes by %.0e of its own variation per unit of time%s\n",
                     a->digits, a->rate, brief ? "" : " (expression in the JSON)");
        if (brief) formula(w, 8, "", a->phi);
    }
    if (r->almosts > most) nh_text_addf(w->out, "\n  %zu more functions are almost conserved: see the JSON\n", r->almosts - most);
}

/* Words that begin at this column. */
static void sentence(nh_summary_writer *w, int indent, const char *text)
{
    int at = 0;
    while (*text) {
        size_t length = strcspn(text, " ");
        bool fits = at && at + 1 + (int)length <= line_width;
        if (fits) nh_text_add(w->out, " ");
        else nh_text_addf(w->out, "%s%*s", at ? "\n" : "", indent, "");
        at = (fits ? at + 1 : indent) + (int)length;
        nh_text_add_n(w->out, text, length);
        text += length + (text[length] == ' ');
    }
    nh_text_add(w->out, "\n");
}

static void completeness(nh_summary_writer *w)
{
    nh_text words;
    nh_text_init(&words);
    nh_facts_completeness(w->r, &words);
    if (nh_text_string(&words)[0]) sentence(w, 2, nh_text_string(&words));
    nh_text_clear(&words);
}

static void further(nh_summary_writer *w, const nh_further_integral *g)
{
    nh_text_addf(w->out, "\n  %s%s%s  (degree %zu)\n", w->style.colour ? "\033[32m" : "", g->current.name, w->style.colour ? "\033[0m" : "", g->degree);
    formula(w, 8, "", g->current.phi);
    faint(w, true);
    certificate(w, &g->current);
    faint(w, false);
}

static void relation(nh_summary_writer *w, const nh_further_relation *q)
{
    nh_text line;
    nh_text_init(&line);
    nh_text_addf(&line, "%s = %s", q->left, q->right);
    sentence(w, 8, nh_text_string(&line));
    nh_text_clear(&line);
}

static void answer(nh_summary_writer *w)
{
    const nh_analysis *r = w->r;
    static const char *const verdicts[] = {"FOUND", "NONE", "UNDECIDED"};
    nh_text title;
    nh_text_init(&title);
    if (r->count == 0) nh_text_addf(&title, "%s: no current%s %s", verdicts[r->verdict], r->pieces ? " of all motions" : "", r->verdict == NH_NONE ? "in this ansatz" : "so far");
    else nh_text_addf(&title, "%s: %zu independent current%s of at most %zu", verdicts[r->verdict], r->independent, r->independent == 1 ? "" : "s", r->local_maximum);
    nh_text_addf(&title, " (search %s)", nh_search_word(r->search));
    nh_summary_heading(w, nh_text_string(&title));
    nh_text_clear(&title);
    completeness(w);
    for (size_t k = 0; k < r->count; k++) current(w, &r->found[k]);
    if (r->furthers) nh_text_add(w->out, "\n  Functions of these currents, but no polynomials in them:\n");
    for (size_t k = 0; k < r->furthers; k++) further(w, &r->further[k]);
    if (r->relations) nh_text_add(w->out, "\n  Relations among them:\n");
    for (size_t k = 0; k < r->relations; k++) relation(w, &r->relation[k]);
    if (r->pieces) nh_text_add(w->out, "\n  Constant only in a region of the states, and not counted:\n");
    for (size_t k = 0; k < r->pieces; k++) current(w, &r->piece[k]);
    almost(w);
    abbreviations(w);
}

void nh_summary(const nh_analysis *r, nh_summary_style style, nh_text *out)
{
    nh_summary_writer w = {r, style, out};
    system_lines(&w);
    answer(&w);
    equations(&w);
    if (r->motion) nh_sheet_text(nh_motion_sheet(r), style.colour, out);
    if (r->theory) nh_sheet_text(nh_geometry_sheet(r->arena, r->theory, r->analysis), style.colour, out);
    nh_summary_evidence(&w);
    nh_summary_motion(&w);
    for (size_t i = 0; i < r->warnings; i++) nh_text_addf(out, "%s  warning: %s\n", i ? "" : "\n", r->warning[i]);
    nh_text_addf(out, "\n%.0f ms (geometry %.0f, unknowns %.0f, null space %.0f, currents %.0f, motion %.0f)\n", 1e3 * r->timing.total, 1e3 * r->timing.geometry,
                 1e3 * r->timing.unknowns, 1e3 * (r->timing.samples + r->timing.nullspace), 1e3 * r->timing.currents, 1e3 * r->timing.validation);
}

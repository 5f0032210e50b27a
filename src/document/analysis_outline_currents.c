/* The currents of an analysis: formula, certificate, symmetry; then what is not counted. */
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "document/analysis_internal.h"
#include "document/facts.h"
#include "document/formula.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/measure.h"
#include "graph/node.h"
#include "graph/declared.h"
#include "graph/print.h"
#include "integrals/real_where.h"
#include "search/theory.h"

/* ---- properties of a current ---- */

static void real_where(nh_pen *p, const nh_analysis *result, const nh_current *f)
{
    nh_model *model = result->question->model;
    nh_ex found[NH_MOST_REAL_WHERE];
    bool parameters = !f->series && (f->proof.all_parameters || f->proof.fixed);
    size_t n = parameters ? nh_real_where_divisors(model, f->phi, found) : 0;
    for (size_t i = 0; i < n; i++) {
        char *text = nh_print_string(model->dag, found[i]);
        nh_pen_say(p, i ? " and <%s> != 0" : " with <%s> != 0", text);
        nh_free(text);
    }
    n = f->series ? 0 : nh_real_where(model, f->phi, found);
    for (size_t i = 0; i < n; i++) {
        char *text = nh_print_string(model->dag, found[i]);
        nh_pen_say(p, i ? " and <%s> > 0" : ", real where <%s> > 0", text);
        nh_free(text);
    }
}

static void certificate(nh_pen *p, const nh_analysis *result, const nh_current *f)
{
    nh_pen_fact_begin(p, f->fitted ? "Fitted" : "Certified");
    if (f->fitted) nh_pen_say(p, "%s", nh_facts_proof(result, f));
    else if (f->proof.proved) nh_pen_say(p, "proved");
    else nh_pen_say(p, "conserved to %.6g digits%s", floor(f->proof.digits), nh_formula_doubt(f));
    if (!f->fitted)
        nh_pen_say(p, "%s%s", nh_facts_holds(result->question->model, &f->proof, false),
                   nh_facts_which_branch(result, f));
    real_where(p, result, f);
    nh_pen_say(p, "; residual %.2g outside the fit", f->heldout);
    nh_pen_close(p, NH_PEN_FACT);
}

static void tag(nh_pen *p, bool holds, const char *words)
{
    if (!holds) return;
    nh_pen_open(p, NH_PEN_TAG, NULL, NULL);
    nh_pen_say(p, "%s", words);
    nh_pen_close(p, NH_PEN_TAG);
}

static void tags(nh_pen *p, const nh_analysis *result, const nh_current *f)
{
    nh_pen_open(p, NH_PEN_TAGS, NULL, NULL);
    if (f->meaning[0]) {
        nh_pen_open(p, NH_PEN_TAG, NULL, NULL);
        nh_analysis_write_meaning(p, result, f->meaning);
        nh_pen_close(p, NH_PEN_TAG);
    }
    tag(p, f->independence == NH_INDEPENDENT, "independent");
    tag(p, f->independence == NH_DEPENDENT, "depends on the others");
    tag(p, f->independence == NH_DOUBTFUL, "perhaps dependent on the others");
    tag(p, f->independence == NH_CONSTANT, "constant on the submanifold");
    tag(p, f->local, "local: many-valued on an angle");
    nh_pen_close(p, NH_PEN_TAGS);
}

/* The forms phi^a = nu^a_s (dq^s - rho^s dt) of the constraints as they were written [CechMusilova2014, eq. 6], or
 * those of the geometry, where it is shown; defined once in a document, where they first occur. */
static void forms(nh_pen *p, const nh_analysis *result, nh_sheet *sheet)
{
    const nh_model *model = result->question->model;
    nh_dag *d = model->dag;
    if (p->forms) return;
    p->forms = true;
    for (size_t a = 0; a < model->k; a++) {
        const nh_ex *own = result->theory ? result->theory->own->form + a * (1 + model->m) : NULL,
                    *nu = model->nu + a * model->m;
        nh_ex along = nh_int(d, 0);
        nh_sheet_sum(sheet, "", nh_sheet_label(sheet, "\\form^{%zu}", a + 1));
        for (size_t s = 0; s < model->m; s++) {
            nh_sheet_add(sheet, own ? own[1 + s] : nu[s],
                         nh_sheet_label(sheet, "\\d<%s>", nh_name_of(d, model->system->coordinate[s].q)));
            along = nh_sub(d, along, nh_mul(d, nu[s], model->rho[s]));
        }
        nh_sheet_add(sheet, own ? own[0] : nh_simplify_short(d, along, 0), "\\d t");
    }
}

/* i_[Gamma,Z] phi^a for these forms. */
static const nh_ex *out_of_distribution(const nh_analysis *result, const nh_current *f)
{
    for (size_t i = 0; result->theory && i < result->theory->brackets; i++)
        if (!strcmp(result->theory->bracket[i].name, f->name)) return result->theory->bracket[i].bracket->form;
    return result->theory ? NULL : f->symmetry.bracket_form;
}

/* The bracket as a sum of its components, or, where that is long, component by component; and its part outside of the
 * canonical distribution. */
static void field(nh_pen *p, const nh_analysis *result, const nh_current *f)
{
    enum { short_sum = 100, in_text = 2 };
    nh_field_term *term;
    double length = 0;
    size_t n = nh_formula_field(result, &f->symmetry, &term),
           k = f->symmetry.bracket_in_distribution ? 0 : result->question->model->k;
    nh_sheet *sheet = nh_sheet_create(result->arena, result->question->model->dag);
    sheet->analysis = result->question->analysis;
    sheet->chart = p->of.chart;
    sheet->shown = result->question->options.shown;
    nh_sheet_begin(sheet, "", "", "");
    for (size_t i = 0; i < n; i++) length += (double)nh_complexity(sheet->dag, term[i].coefficient);
    if (p->ink->brief && length > in_text * result->question->options.shown) {
        nh_pen_words(p, "Z has %zu symbols: the page shows it, and so does --option shown=%zu here", (size_t)length,
                     (size_t)ceil(length / in_text));
        return;
    }
    if (length <= short_sum) nh_sheet_sum(sheet, "", "Z");
    for (size_t i = 0; i < n; i++) {
        const char *label = length > short_sum ? "Z_{<%s>}" : "\\frac{\\p}{\\p<%s>}", *along = term[i].along;
        label = along ? nh_arena_printf(result->arena, label, along) : length > short_sum ? "Z_{Gamma}" : "Gamma";
        if (length > short_sum) nh_sheet_formula(sheet, label, term[i].coefficient);
        else nh_sheet_add(sheet, term[i].coefficient, label);
    }
    const nh_ex *out = k ? out_of_distribution(result, f) : NULL;
    for (size_t a = 0; a < k && out; a++)
        nh_sheet_formula(sheet, nh_sheet_label(sheet, "i_{[Gamma,Z]} \\form^{%zu}", a + 1), out[a]);
    if (out) forms(p, result, sheet);
    bool folds = length > short_sum;
    if (folds) nh_pen_open(p, NH_PEN_FOLD, NULL, "Its symmetry Z");
    nh_pen_sheet(p, sheet);
    if (folds) nh_pen_close(p, NH_PEN_FOLD);
}

static void as_text(nh_pen *p, const nh_analysis *result, const nh_current *f)
{
    nh_dag *d = result->question->model->dag;
    nh_ex own = nh_formula_shown(result, f->phi);
    if (!p->ink->screen) return;
    bool other =
        f->has_in_velocities && f->in_velocities != nh_chart_in_velocities(result->question->model->chart, own);
    char *text = nh_print_short(d, own, result->question->options.shown),
         *plain = other ? nh_print_short(d, f->in_velocities, result->question->options.shown) : NULL;
    if (text || plain) {
        nh_pen_open(p, NH_PEN_SCREEN, NULL, "As text, to copy");
        if (text) nh_pen_code(p, text);
        if (plain) nh_pen_words(p, "in coordinate velocities");
        if (plain) nh_pen_code(p, plain);
        nh_pen_close(p, NH_PEN_SCREEN);
    }
    nh_free(plain);
    nh_free(text);
}

/* ---- definitions of the analysis file ---- */

/* Does the name occur in the current, or in its field, as they are shown? */
static bool stands_in(const nh_analysis *result, const nh_current *f, const char *name)
{
    nh_dag *d = result->question->model->dag;
    nh_ex symbol = nh_symbol(d, name);
    nh_field_term *term;
    bool any = !f->series && nh_depends(d, nh_formula_shown(result, f->phi), symbol);
    size_t n = f->has_symmetry && !f->series && !any ? nh_formula_field(result, &f->symmetry, &term) : 0;
    for (size_t i = 0; i < n && !any; i++)
        any = nh_depends(d, nh_formula_shortened(result->question->analysis, d, term[i].coefficient), symbol);
    return any;
}

static bool of_name(char c) { return isalnum((unsigned char)c) || c == '_'; }

static bool has_word(const char *text, const char *word)
{
    size_t length = strlen(word);
    for (const char *at = text; (at = strstr(at, word)); at++)
        if ((at == text || !of_name(at[-1])) && !of_name(at[length])) return true;
    return false;
}

/* Writes the definitions that the current needs, or all (NULL), unless they were written before; with the definitions
 * that these need. */
static void definitions(nh_pen *p, const nh_analysis *result, const nh_current *f, bool *told)
{
    const nh_analysis_file *a = result->question->analysis;
    size_t n = a ? a->definitions : 0;
    bool any = false, *now = nh_arena_alloc(result->arena, (n + 1) * sizeof *now);
    for (size_t i = n; i-- > 0;) {
        now[i] = !told[i] && (!f || stands_in(result, f, a->definition[i].name));
        for (size_t j = i + 1; j < n && !told[i] && !now[i]; j++)
            now[i] = now[j] && has_word(a->definition[j].text, a->definition[i].name);
    }
    for (size_t i = 0; i < n; i++) {
        if (!now[i]) continue;
        if (!any) nh_pen_words(p, "where");
        p->ink->equation(p->to, a->definition[i].name, a->definition[i].text);
        any = told[i] = true;
    }
}

/* ---- a current ---- */

/* The energy as a function of all velocities, v^s dL/dv^s - L; or, where that is long, Phi = -E or E on the
 * submanifold. */
static bool energy_in_all_velocities(const nh_analysis *result, const nh_current *f, nh_ex *E)
{
    nh_dag *d = result->question->model->dag;
    const nh_system *system = result->question->system;
    bool itself = f->energy && (!strcmp(f->meaning, "energy") || !strncmp(f->meaning, "minus", 5));
    size_t length = itself ? nh_complexity(d, f->phi) : 0;
    if (length <= NH_SYMMETRY_LENGTHY || system->orientations) return false;
    *E = nh_neg(d, system->lagrangian);
    for (size_t i = 0; i < result->question->model->m; i++) {
        nh_ex v = system->coordinate[i].v;
        *E = nh_add(d, *E, nh_mul(d, v, nh_diff(d, system->lagrangian, v)));
    }
    *E = nh_simplify_short(d, *E, 0);
    return nh_complexity(d, *E) < length / 2;
}

/* The field d/dt belongs to minus the energy: E is written beside it, because readers know E rather than -E. */
static void closed_form(nh_pen *p, const nh_analysis *result, const nh_current *f)
{
    nh_dag *d = result->question->model->dag;
    nh_ex symbol = nh_symbol(d, "E"), E = nh_neg(d, f->phi);
    bool minus = !strncmp(f->meaning, "minus", 5), taken = nh_depends(d, f->phi, symbol),
         all = !taken && energy_in_all_velocities(result, f, &E);
    if (f->energy && !taken && (minus || all))
        nh_pen_formulas(p, 2, (const char *[]){f->name, "E"}, (nh_ex[]){minus ? nh_neg(d, symbol) : symbol, E});
    else nh_pen_formula(p, f->name, f->phi);
    if (all && result->question->model->k)
        nh_pen_words(p, "E is written in all velocities, which satisfy the constraints: it is longer in those of the "
                        "chart.");
}

static void current(nh_pen *p, const nh_analysis *result, const nh_current *f, bool *told)
{
    const nh_validation *v = result->validation;
    double drift = f->drift.drift[NH_DRIFT_RUNS - 1];
    nh_pen_card(p, NULL);
    nh_pen_name_heading(p, nh_arena_printf(result->arena, "q-%s", f->name), f->name);
    tags(p, result, f);
    if (f->relation) p->ink->equation(p->to, "", f->relation);
    if (f->has_symmetry && !f->series) field(p, result, f);
    if (f->series) nh_analysis_write_series(p, result, f);
    else closed_form(p, result, f);
    definitions(p, result, f, told);
    nh_pen_open(p, NH_PEN_FACTS, NULL, NULL);
    if (f->doc) nh_pen_fact(p, "In words", "%s", f->doc);
    if (f->known) nh_pen_fact(p, "Known", "%s; brackets mark currents that the system file gives", f->known);
    certificate(p, result, f);
    if (v && isfinite(drift))
        nh_pen_fact(p, "Drift", "%.2g at tolerance %.2g; %s", drift, v->tolerance[NH_DRIFT_RUNS - 1],
                    nh_facts_drift(&f->drift));
    else if (v)
        nh_pen_fact(p, "Drift", "not measured: it %s of the test motion",
                    isnan(drift) ? "is real at no state" : "has no finite value at some states");
    if (f->has_symmetry) {
        nh_pen_fact_begin(p, "Symmetry");
        p->ink->symmetry(p->to, &f->symmetry);
        nh_pen_close(p, NH_PEN_FACT);
        const double *off = f->symmetry.off;
        nh_pen_fact(p, "Residuals", "(N0) %.2g, (NX) %.2g, (NY) %.2g", off[0], off[1], off[2]);
    }
    nh_pen_close(p, NH_PEN_FACTS);
    if (!f->series) as_text(p, result, f);
}

/* ---- integrals that are not counted ---- */

/* A function with a property that the currents do not have. */
static void uncounted(nh_pen *p, const nh_analysis *result, const nh_current *f, const char *property)
{
    nh_pen_card(p, NULL);
    nh_pen_name_heading(p, NULL, f->name);
    nh_pen_open(p, NH_PEN_TAGS, NULL, NULL);
    nh_pen_open(p, NH_PEN_TAG, NULL, NULL);
    nh_pen_theory(p, property);
    nh_pen_close(p, NH_PEN_TAG);
    nh_pen_close(p, NH_PEN_TAGS);
    nh_pen_formula(p, f->name, f->phi);
    nh_pen_open(p, NH_PEN_FACTS, NULL, NULL);
    certificate(p, result, f);
    nh_pen_close(p, NH_PEN_FACTS);
    as_text(p, result, f);
}

static void furthers(nh_pen *p, const nh_analysis *result)
{
    const nh_current_list *list = result->list;
    const char *those = "";
    if (list->furthers) {
        nh_pen_heading(p, "Further integrals");
        nh_pen_words(p, "These integrals are polynomial in the velocities. They are functions of the currents above: "
                        "they are not counted.");
        those = nh_arena_printf(result->arena, "$<%s>$", list->found[0].name);
        if (list->count > 1)
            those = nh_arena_printf(result->arena, "%s to $<%s>$", those, list->found[list->count - 1].name);
    }
    for (size_t k = 0; k < list->furthers; k++) {
        const char *where = list->further[k].current.region;
        uncounted(p, result, &list->further[k].current,
                  nh_arena_printf(result->arena, "degree %zu; depends on %s%s%s", list->further[k].degree, those,
                                  where ? "; " : "", where ? where : ""));
    }
    if (result->relations) nh_pen_heading(p, "Relations");
    for (size_t k = 0; k < result->relations; k++)
        p->ink->equation(p->to, result->relation[k].left, result->relation[k].right);
}

static void pieces(nh_pen *p, const nh_analysis *result)
{
    const nh_current_list *list = result->list;
    if (!list->pieces) return;
    nh_pen_heading(p, "Constant only in a region");
    nh_pen_words(p, "These functions are constant while a motion stays in the given region. %s",
                 nh_analysis_to_the_end(result)
                     ? "A motion ends at a wall where it has an impulse: the equations of motion do not determine how "
                       "it continues."
                     : "They are not counted.");
    for (size_t k = 0; k < list->pieces; k++) uncounted(p, result, &list->piece[k], list->piece[k].region);
}

static void almost(nh_pen *p, const nh_analysis *result)
{
    enum { first_ones = 2 }; /* for a terminal */
    if (!result->almosts) return;
    nh_pen_heading(p, "Almost conserved, not currents");
    nh_pen_words(p, nh_declared_has_table(result->question->model->dag)
                        ? "These functions change slowly. Whether this is the error of the tables is not known. They "
                          "are not counted; the slowest comes first."
                        : "In double precision these functions look constant. With more digits they change, or they "
                          "have no certificate. They are not counted; the slowest comes first.");
    for (size_t k = 0; k < result->almosts && !(p->ink->brief && k == first_ones); k++) {
        const nh_near_current *a = &result->almost[k];
        nh_pen_card(p, NULL);
        nh_pen_formula(p, "", a->phi);
        nh_pen_words(p, "Its rate cancels to %.6g digits; it changes by %.2g of its own variation per unit of time.",
                     floor(a->digits), a->rate);
    }
}

/* What is true of the statements of the system file. */
static void stated(nh_pen *p, const nh_analysis *result)
{
    if (!result->stateds) return;
    nh_pen_heading(p, "What the system file states");
    nh_pen_open(p, NH_PEN_FACTS, NULL, NULL);
    for (size_t i = 0; i < result->stateds; i++) {
        const nh_stated *s = &result->stated[i];
        bool missed = s->verdict == NH_STATED_MISSED;
        const char *why = s->relation ? s->relation : s->region ? s->region : s->obstacle;
        if (s->verdict == NH_STATED_FOUND && !why) why = "a function of those found";
        if (missed) why = s->out_of_reach ? s->out_of_reach : "it is no function of those found";
        if (s->state) why = nh_arena_printf(result->arena, "its rate is %.6g at a state", s->rate);
        nh_pen_fact(p, s->name, "%s%s%s%s%s", missed ? "conserved, but " : "", nh_analysis_stated_word(s->verdict),
                    s->denied && s->verdict == NH_STATED_FALSE ? ", as stated" : "", why ? "; " : "", why ? why : "");
    }
    nh_pen_close(p, NH_PEN_FACTS);
}

void nh_analysis_write_currents(nh_pen *p, const nh_analysis *result)
{
    const nh_current_list *list = result->list;
    const nh_analysis_file *a = result->question->analysis;
    if (!p->ink->brief) {
        nh_pen_section(p, "currents", "Currents");
        nh_pen_words(
            p, "A current is a function of time, coordinates and velocities that is constant along every motion.");
        if (!list->count) nh_pen_words(p, "None was found. The stages of the search are listed below.");
    }
    bool *told = nh_arena_alloc(result->arena, ((a ? a->definitions : 0) + 1) * sizeof *told);
    memset(told, 0, ((a ? a->definitions : 0) + 1) * sizeof *told);
    for (size_t k = 0; k < list->count; k++) current(p, result, &list->found[k], told);
    nh_pen_card_end(p);
    if (list->count) definitions(p, result, NULL, told);
    furthers(p, result);
    pieces(p, result);
    almost(p, result);
    stated(p, result);
}

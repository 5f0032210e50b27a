#include "document/verification.h"

#include <math.h>
#include <stdio.h>

#include "base/json.h"
#include "base/memory.h"
#include "document/facts.h"
#include "document/geometry_sheet.h"
#include "document/screen.h"
#include "document/sheet.h"
#include "document/simulation.h"
#include "document/current_words.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/measure.h"
#include "graph/node.h"
#include "graph/print.h"
#include "integrals/prove.h"

const nh_chart *nh_verification_chart(const nh_verification *v)
{
    bool here_only = v->branch && v->conserved && !v->on_both && !v->form;
    return here_only ? NULL : v->model->chart;
}

static nh_ex as_shown(const nh_verification *v, nh_ex e)
{
    const nh_chart *chart = nh_verification_chart(v);
    return chart ? nh_chart_shown(chart, e) : e;
}

const char *nh_verification_branches(const nh_verification *v)
{
    if (!v->branch) return "";
    if (v->on_both) return ", on both branches";
    return nh_arena_printf(v->arena, v->form ? ", on the branch %s" : ", on the branch %s only", v->branch);
}

const char *nh_verification_noun(const nh_verification *v)
{
    return v->of_equations ? "a symmetry of the equations of motion" : v->form ? "a constraint symmetry" : "conserved";
}

static void put_expression(const nh_verification *v, nh_json *to, const char *key, nh_ex e)
{
    char *text = nh_print_string(v->model->dag, as_shown(v, e));
    nh_json_put_text(to, key, text);
    nh_free(text);
}

static void put_symmetry(const nh_verification *v, nh_json *to)
{
    nh_dag *d = v->model->dag;
    nh_json *item = nh_json_put_object(to, "symmetry"), *components;
    put_expression(v, item, "Z0", v->symmetry.Z0);
    components = nh_json_put_object(item, "components");
    put_expression(v, components, "t", v->symmetry.Z0);
    for (size_t s = 0; s < v->model->m; s++)
        put_expression(v, components, v->system->coordinate[s].name, v->symmetry.field.space[s]);
    for (size_t i = 0; i < v->model->n; i++)
        put_expression(v, components, nh_name_of(d, v->model->chart->w[i]), v->symmetry.W[i]);
    if (v->symmetry.kase) nh_json_put_number(item, "case", v->symmetry.kase);
    else nh_json_put_null(item, "case");
    nh_json_put_bool(item, "bracket_in_distribution", v->symmetry.bracket_in_distribution);
    nh_json_put_bool(item, "projectable", v->symmetry.projectable);
}

/* For a field: whether it lies in the canonical distribution, and its part outside of it. */
static void put_forms(const nh_verification *v, nh_json *to)
{
    if (!v->form) {
        nh_json_put_null(to, "in_distribution");
        nh_json_put_null(to, "i_Z_phi");
        return;
    }
    nh_json_put_bool(to, "in_distribution", !v->outside);
    nh_json *list = nh_json_put_array(to, "i_Z_phi");
    for (size_t a = 0; a < v->model->k; a++) {
        char *text = nh_print_string(v->model->dag, as_shown(v, v->form[a]));
        nh_json_add_text(list, text);
        nh_free(text);
    }
}

char *nh_verification_json(const nh_verification *v, const nh_run *run)
{
    nh_dag *d = v->model->dag;
    nh_json *root = nh_json_object();
    nh_json_put_number(root, "schema", 1);
    nh_json_put_text(root, "version", NH_VERSION);
    nh_json_put_text(root, "system", v->system->name);
    nh_json_put_bool(root, "conserved", v->conserved);
    nh_json_put_text(root, "region", v->region);
    nh_json_put_text(root, "of", v->of_equations ? "equations" : v->form ? "constraint" : NULL);
    if (v->of_equations) put_expression(v, root, "factor", v->factor);
    else nh_json_put_null(root, "factor");
    nh_json *makes = nh_json_put_object(root, "makes");
    for (size_t i = 0; i < v->made; i++) put_expression(v, makes, v->make[i].name, v->make[i].value);
    if (v->outside || v->of_equations) nh_json_put_null(root, "current");
    else put_expression(v, root, "current", v->current);
    put_forms(v, root);
    nh_json_put_bool(root, "trivial", v->trivial);
    nh_json_put_text(root, "branch", v->branch);
    if (v->branch && !v->form && v->conserved) nh_json_put_bool(root, "on_both_branches", v->on_both);
    else nh_json_put_null(root, "on_both_branches");
    if (v->has_symmetry) put_symmetry(v, root);
    else nh_json_put_null(root, "symmetry");
    nh_json_put_number(root, "residual", v->residual);
    nh_json_put_number(root, "certified_digits", floor(v->proof.digits));
    nh_json_put_bool(root, "proved", v->proof.proved);
    nh_json_put_bool(root, "proved_for_all_parameters", v->proof.all_parameters);
    nh_facts_put_holds(root, v->model, &v->proof);
    if (v->has_counterexample) {
        nh_json *point = nh_json_put_object(root, "counterexample");
        for (size_t j = 0; j < v->model->width; j++)
            nh_json_put_number(point, nh_name_of(d, v->model->chart->symbol[j]), v->counterexample[j]);
        nh_json_put_number(point, "rate", v->rate);
    } else {
        nh_json_put_null(root, "counterexample");
    }
    nh_geometry_json(v->arena, v->theory, NULL, root, "equations");
    if (run) nh_run_json(run, v->system, root);
    return nh_json_finish(root);
}

/* ---- the document ---- */

static bool of_field(const nh_verification *v) { return v->form || v->of_equations; }

static void answer(nh_pen *p, const nh_verification *v)
{
    const char *noun = nh_verification_noun(v);
    nh_pen_open(p, NH_PEN_ANSWER, v->conserved ? "found" : "undecided", NULL);
    if (v->conserved) {
        nh_pen_say(p, "Yes: this is %s", noun);
        if (v->proof.proved) nh_pen_say(p, ", proved%s", nh_facts_holds(v->model, &v->proof, false));
        else
            nh_pen_say(p, ", to %.6g digits%s", floor(v->proof.digits),
                       v->fitted          ? ", as far as values of a table can tell: a table has no formula"
                       : v->proof.rounded ? " (its numbers are rounded to doubles)"
                                          : "");
        nh_pen_say(p, "%s%s%s%s.", nh_verification_branches(v), v->region ? ", " : "", v->region ? v->region : "",
                   v->trivial ? "; it is trivial: the current is a constant" : "");
    } else if (v->region) {
        nh_pen_say(p, "No: this is conserved only in a region: %s.", v->region);
    } else {
        nh_pen_say(p, "No: this is not %s.", noun);
    }
    nh_pen_close(p, NH_PEN_ANSWER);
}

static void counterexample(nh_pen *p, const nh_verification *v)
{
    if (!v->has_counterexample) return;
    nh_pen_section(p, "counterexample", "Where it fails");
    nh_pen_open(p, NH_PEN_WORDS, NULL, NULL);
    if (of_field(v)) {
        nh_pen_say(p, "The condition that fails is ");
        nh_pen_letters(p, v->equation);
        nh_pen_say(p, " = 0");
        if (v->equation_number)
            nh_pen_say(p, " (%s in Čech and Musilová, 2014)", nh_arena_printf(v->arena, "%zu", v->equation_number));
        nh_pen_say(p, ". Its left side is %.6g", v->rate);
    } else {
        nh_pen_say(p, "The rate of change along the motion is %s, not 0,",
                   v->rate == 0 ? "too small for a double" : nh_arena_printf(v->arena, "%.6g", v->rate));
    }
    nh_pen_say(p, " in the state ");
    for (size_t j = 0; j < v->model->width; j++)
        nh_pen_say(p, j ? ", <%s> = %.10g" : "<%s> = %.10g", nh_name_of(v->model->dag, v->model->chart->symbol[j]),
                   v->counterexample[j]);
    nh_pen_say(p, v->branch ? ", on the branch <%s>." : ".", v->branch);
    if (v->on_other) nh_pen_say(p, " On the branch <%s> it is conserved: proved.", v->other_branch);
    if (of_field(v) && v->equation_number > 6 && !v->theory)
        nh_pen_say(p, " The option --equations defines the letters.");
    nh_pen_close(p, NH_PEN_WORDS);
}

/* The components that do not vanish. */
static void components(nh_pen *p, const nh_verification *v)
{
    size_t m = v->model->m, n = v->model->n, count = 0;
    const char **label = nh_alloc_array(1 + m + n, sizeof *label);
    nh_ex *e = nh_alloc_array(1 + m + n, sizeof *e);
    for (size_t i = 0; i < 1 + m + n; i++) {
        const char *along = i == 0   ? "t"
                            : i <= m ? v->system->coordinate[i - 1].name
                                     : nh_name_of(v->model->dag, v->model->chart->w[i - 1 - m]);
        e[count] = i == 0 ? v->symmetry.Z0 : i <= m ? v->symmetry.field.space[i - 1] : v->symmetry.W[i - 1 - m];
        label[count] = nh_arena_printf(v->arena, "Z_{<%s>}", along);
        count += !nh_is_zero(v->model->dag, e[count]);
    }
    nh_pen_formulas(p, count, label, e);
    if (!count) nh_pen_words(p, "It vanishes.");
    nh_free(e);
    nh_free(label);
}

/* The result of a symmetry of the equations of motion on the currents that the system file knows. */
static void made(nh_pen *p, const nh_verification *v)
{
    if (v->made) nh_pen_words(p, "It maps known currents to these:");
    for (size_t i = 0; i < v->made; i++)
        nh_pen_formula(p, nh_arena_printf(v->arena, "Z(<%s>)", v->make[i].name), v->make[i].value);
}

static void symmetry(nh_pen *p, const nh_verification *v)
{
    if (!v->has_symmetry || v->trivial) return;
    nh_pen_section(p, "symmetry",
                   of_field(v) ? "The field, with its Chetaev components" : "The symmetry that gives it");
    components(p, v);
    nh_pen_open(p, NH_PEN_FACTS, NULL, NULL);
    nh_pen_fact_begin(p, "Symmetry");
    p->ink->symmetry(p->to, &v->symmetry);
    nh_pen_close(p, NH_PEN_FACT);
    nh_pen_close(p, NH_PEN_FACTS);
}

/* The part of a field outside of the canonical distribution: a current is defined only for fields in it. */
static void outside(nh_pen *p, const nh_verification *v)
{
    nh_pen_words(p, "Z is not in the canonical distribution:");
    for (size_t a = 0; a < v->model->k; a++) {
        nh_pen_formula(p, nh_arena_printf(v->arena, "i_{Z} \\form^{%zu}", a + 1), v->form[a]);
        nh_pen_open(p, NH_PEN_WORDS, NULL, NULL);
        nh_pen_say(p, "where ");
        nh_pen_letters(p, nh_arena_printf(v->arena, "\\form^{%zu}", a + 1));
        nh_pen_say(p, " belongs to <%s>.", v->system->constraint[a].text);
        nh_pen_close(p, NH_PEN_WORDS);
    }
}

static void question(nh_pen *p, const nh_verification *v)
{
    bool field = of_field(v);
    const char *title = v->outside || v->of_equations ? "The field"
                        : field                       ? "The current of the field"
                                                      : "The question";
    nh_pen_section(p, "question", title);
    if (!field) nh_pen_words(p, "Does this stay constant along every motion?");
    nh_pen_card(p, NULL);
    if (v->of_equations) nh_pen_formula(p, "[Gamma,Z] = f Gamma,\\quad f", v->factor);
    else if (v->outside) outside(p, v); /* the field has no current */
    else nh_pen_formula(p, "Phi", v->current);
    made(p, v);
    nh_pen_open(p, NH_PEN_FACTS, NULL, NULL);
    nh_pen_fact(p, "Residual", "%.2g, the largest %s, relative to %s terms", v->residual,
                field ? "residual of the conditions at random states" : "rate at random states",
                field ? "their" : "its");
    nh_pen_close(p, NH_PEN_FACTS);
}

/* ---- of a current, on a terminal ---- */

/* d/dt of the current along motions. */
static nh_ex rate(const nh_verification *v)
{
    const nh_model *model = v->model;
    nh_ex *term = nh_alloc_array(1 + model->m + model->n, sizeof *term), sum = nh_int(model->dag, 0);
    nh_rate_terms(model, v->current, term);
    for (size_t i = 0; i < 1 + model->m + model->n; i++) sum = nh_add(model->dag, sum, term[i]);
    nh_free(term);
    return nh_simplify_short(model->dag, sum, 0);
}

static void put_yes(const nh_verification *v, bool colour, nh_text *out)
{
    nh_text words;
    nh_text_init(&words);
    nh_text_add(&words, "Yes. This is conserved");
    if (v->proof.proved) nh_text_addf(&words, ": proved%s", nh_facts_holds(v->model, &v->proof, true));
    else
        nh_text_addf(&words, " to %.6g digits%s", floor(v->proof.digits),
                     v->fitted          ? ", as far as values of a table can tell: a table has no formula"
                     : v->proof.rounded ? " (its numbers are rounded to doubles)"
                                        : "");
    nh_text_addf(&words, "%s%s%s.", nh_verification_branches(v), v->region ? ", " : "", v->region ? v->region : "");
    if (v->trivial) nh_text_add(&words, " It is the same number at all states.");
    if (v->has_symmetry && !v->trivial) {
        const char *how;
        nh_text what;
        nh_text_init(&what);
        nh_symmetry_words(v->model, &v->symmetry, &how, &what);
        nh_text_addf(&words, " It comes from %s%s%s.", how, what.length ? " " : "", nh_text_string(&what));
        nh_text_clear(&what);
    }
    nh_screen_begin(out, colour, v->system, NULL, &words);
}

/* A state at which it changes, and its rate in general where that is short. */
static void put_no(const nh_verification *v, bool colour, nh_text *out)
{
    enum { short_rate = 120 };
    const nh_model *model = v->model;
    nh_text words;
    nh_text_init(&words);
    if (v->region) nh_text_addf(&words, "No. This is conserved only in a region: %s.", v->region);
    else
        nh_text_addf(&words, "No. This changes along motions%s%s", v->branch ? " on the branch " : "",
                     v->branch ? v->branch : "");
    if (v->has_counterexample && !v->region) {
        nh_text_add(&words, ", for example at ");
        for (size_t j = 0; j < model->width; j++)
            nh_text_addf(&words, "%s%s = %.5g", j ? ", " : "", nh_name_of(model->dag, model->chart->symbol[j]),
                         v->counterexample[j]);
        nh_text_addf(&words, ": its rate there is %.4g, not 0.", v->rate);
    } else if (!v->region) {
        nh_text_add(&words, ".");
    }
    if (v->on_other) nh_text_addf(&words, " On the branch %s it is conserved: proved.", v->other_branch);
    nh_screen_begin(out, colour, v->system, NULL, &words);
    nh_ex general = model->chart->implicit || v->region ? 0 : rate(v);
    if (general && nh_complexity(model->dag, general) <= short_rate) {
        nh_text_add(out, "Its rate in general:\n");
        nh_screen_equation("rate", model->dag, as_shown(v, general), out);
    }
}

static void first_screen(const nh_verification *v, bool colour, nh_text *out)
{
    if (v->conserved) put_yes(v, colour, out);
    else put_no(v, colour, out);
    if (v->named) nh_screen_equation("Phi", v->model->dag, as_shown(v, v->current), out);
    nh_screen_more(out, v->conserved ? "the symmetry in full, and the check" : "the state in full, and the check",
                   NULL);
}

void nh_verification_write(const nh_verification *v, const nh_run *run, nh_pen_style style, nh_text *out)
{
    if (nh_screen_is_wanted(style) && !of_field(v) && !v->theory) {
        first_screen(v, style.colour, out);
        return;
    }
    nh_pen pen, *p = &pen;
    bool shown = v->has_symmetry && !v->trivial;
    nh_pen_subject subject = {
        .system = v->system, .dag = v->model->dag, .chart = nh_verification_chart(v), .shown = run->shown};
    nh_pen_begin(p, style, &subject, of_field(v) ? "is it a symmetry?" : "is it conserved?", out);
    answer(p, v);
    nh_stage *stage = p->ink->stage && v->motion ? nh_simulation_stage(v->motion, run) : NULL;
    if (stage) p->ink->stage(p->to, stage);
    p->ink->links(p->to,
                  v->has_counterexample
                      ? "question|The question|counterexample|Where it fails|system|System|words|Words|repeat|Repeat it"
                  : shown ? "question|The question|symmetry|The symmetry|system|System|words|Words|repeat|Repeat it"
                          : "question|The question|system|System|words|Words|repeat|Repeat it");
    question(p, v);
    counterexample(p, v);
    symmetry(p, v);
    nh_pen_system(p, v->model, NULL);
    nh_pen_geometry(p, v->arena, v->theory);
    nh_pen_glossary(p, "current, symmetry, case, distribution, projectable, residual");
    nh_pen_end(p, run);
    nh_stage_free(stage);
}

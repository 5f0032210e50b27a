/* The answer to `verify` as a document. */
#include <math.h>

#include "base/memory.h"
#include "document/facts.h"
#include "document/verification.h"
#include "exact/normal.h"

static void answer(nh_pen *p, const nh_verification *v, bool field)
{
    const char *noun = nh_verification_noun(v, field);
    nh_pen_open(p, NH_PEN_ANSWER, v->conserved ? "found" : "undecided", NULL);
    if (v->conserved) {
        nh_pen_say(p, "Yes: this is %s", noun);
        if (v->proof.proved) nh_pen_say(p, ", proved%s", nh_facts_holds(v->model, &v->proof, false));
        else nh_pen_say(p, ", to %.6g digits%s", floor(v->proof.digits), v->proof.rounded ? " (its numbers are rounded to doubles)" : "");
        nh_pen_say(p, "%s%s.", nh_verification_branches(v), v->trivial ? "; it is trivial: the current is a constant" : "");
    } else if (v->region) {
        nh_pen_say(p, "No: this is conserved only in a region: %s.", v->region);
    } else {
        nh_pen_say(p, "No: this is not %s.", noun);
    }
    nh_pen_close(p, NH_PEN_ANSWER);
}

static void counterexample(nh_pen *p, const nh_verification *v, bool field)
{
    if (!v->has_counterexample) return;
    nh_pen_section(p, "counterexample", "Where it fails");
    if (field) nh_pen_words(p, "The condition that fails: %s. In this state it gives %.6g, not 0.", v->equation, v->rate);
    else nh_pen_words(p, "Its rate of change along the motion through this state is %.6g, not 0.", v->rate);
    nh_pen_table(p, "A state of the system", "quantity|value");
    for (size_t j = 0; j < v->model->width; j++)
        nh_pen_row(p, "#<%s>|%.6g", nh_name_of(v->model->dag, v->model->chart->symbol[j]), v->counterexample[j]);
    nh_pen_table_end(p);
}

/* The components that do not vanish. */
static void components(nh_pen *p, const nh_verification *v)
{
    size_t m = v->model->m, n = v->model->n, count = 0;
    const char **label = nh_alloc_array(1 + m + n, sizeof *label);
    nh_ex *e = nh_alloc_array(1 + m + n, sizeof *e);
    for (size_t i = 0; i < 1 + m + n; i++) {
        const char *along = i == 0 ? "t" : i <= m ? v->system->coordinate[i - 1].name : nh_name_of(v->model->dag, v->model->chart->w[i - 1 - m]);
        e[count] = i == 0 ? v->symmetry.Z0 : i <= m ? v->symmetry.field.space[i - 1] : v->symmetry.W[i - 1 - m];
        label[count] = nh_arena_printf(v->arena, "Z_{<%s>}", along);
        count += !nh_is_zero(v->model->dag, e[count]);
    }
    p->ink->formulas(p->to, count, label, e);
    if (!count) nh_pen_words(p, "It vanishes.");
    nh_free(e);
    nh_free(label);
}

static void symmetry(nh_pen *p, const nh_verification *v, bool field)
{
    if (!v->has_symmetry || v->trivial) return;
    nh_pen_section(p, "symmetry", field ? "The field, with its Chetaev components" : "The symmetry that gives it");
    components(p, v);
    nh_pen_open(p, NH_PEN_FACTS, NULL, NULL);
    nh_pen_fact_begin(p, "Symmetry");
    p->ink->symmetry(p->to, &v->symmetry);
    nh_pen_close(p, NH_PEN_FACT);
    nh_pen_close(p, NH_PEN_FACTS);
}

static void question(nh_pen *p, const nh_verification *v, bool field)
{
    bool no_current = v->outside || v->of_equations;
    nh_pen_section(p, "question", no_current ? "The field" : field ? "The current of the field" : "The question");
    if (!no_current && !field) nh_pen_words(p, "Does this stay constant along every motion?");
    nh_pen_card(p, NULL);
    if (v->of_equations) nh_pen_formula(p, "[Gamma,Z] = f Gamma,\\quad f", v->factor);
    else if (!v->outside) nh_pen_formula(p, "Phi", v->current);
    else nh_pen_words(p, "Z is not in the canonical distribution:");
    for (size_t a = 0; a < v->model->k && v->outside && !v->of_equations; a++) /* it has no current then */
        nh_pen_formula(p, nh_arena_printf(v->arena, "i_{Z}\\form^{%zu}", a + 1), v->form[a]);
    nh_pen_open(p, NH_PEN_FACTS, NULL, NULL);
    nh_pen_fact(p, "Residual", "%.2g, the largest %s, relative to %s terms", v->residual,
                field ? "residual of the conditions at random states" : "rate at random states", field ? "their" : "its");
    nh_pen_close(p, NH_PEN_FACTS);
}

void nh_verification_write(const nh_verification *v, bool field, const nh_run *run, nh_pen_form form, nh_text *out)
{
    nh_pen pen, *p = &pen;
    bool shown = v->has_symmetry && !v->trivial;
    nh_pen_subject subject = {.system = v->system, .dag = v->model->dag, .chart = nh_verification_chart(v), .shown = run->shown};
    nh_pen_begin(p, form, &subject, field ? "is it a symmetry?" : "is it conserved?", out);
    answer(p, v, field);
    p->ink->links(p->to, v->has_counterexample ? "question|The question|counterexample|Where it fails|system|System|words|Words|repeat|Repeat it"
                         : shown               ? "question|The question|symmetry|The symmetry|system|System|words|Words|repeat|Repeat it"
                                               : "question|The question|system|System|words|Words|repeat|Repeat it");
    question(p, v, field);
    counterexample(p, v, field);
    symmetry(p, v, field);
    nh_pen_system(p, v->model, NULL);
    nh_pen_geometry(p, v->arena, v->theory);
    nh_pen_glossary(p, "current, symmetry, case, distribution, projectable, residual");
    nh_pen_end(p, run);
}

#include "document/verification.h"

#include <math.h>
#include <stdio.h>

#include "base/json.h"
#include "exact/normal.h"
#include "graph/print.h"
#include "document/facts.h"
#include "document/geometry_sheet.h"

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

/* Longer than `shown` symbols: only how long. */
static void put(const nh_verification *v, nh_text *out, const char *label, nh_ex e, double shown)
{
    nh_dag *dag = v->model->dag;
    e = as_shown(v, e);
    char *text = nh_print_short(dag, e, shown);
    if (text) nh_text_addf(out, "%s%s\n", label, text);
    else nh_text_addf(out, "%s... (%zu symbols: too long to be shown; option `shown`)\n", label, nh_complexity(dag, e));
    nh_free(text);
}

static void put_point(const nh_verification *v, nh_text *out)
{
    char number[40];
    const nh_chart *c = v->model->chart;
    for (size_t j = 0; j < v->model->width; j++) {
        nh_text_number(v->counterexample[j], number, sizeof number);
        nh_text_addf(out, "%s%s = %s", j ? ", " : "", nh_name_of(v->model->dag, c->symbol[j]), number);
    }
}

static void put_field(const nh_verification *v, double shown, nh_text *out)
{
    const nh_symmetry *z = &v->symmetry;
    nh_text_add(out, "  its symmetry has the components\n");
    put(v, out, "    t: ", z->Z0, shown);
    for (size_t s = 0; s < v->model->m; s++) {
        nh_text_addf(out, "    %s: ", v->system->coordinate[s].name);
        put(v, out, "", z->field.space[s], shown);
    }
    for (size_t i = 0; i < v->model->n; i++) {
        nh_text_addf(out, "    %s: ", nh_name_of(v->model->dag, v->model->chart->w[i]));
        put(v, out, "", z->W[i], shown);
    }
    nh_text_add(out, "  ");
    nh_facts_symmetry(z, NH_FACTS_TEXT, ";\n  ", out);
    nh_text_add(out, "\n");
}

/* By how much a field leaves the canonical distribution: its current is defined for fields in it only. */
static void put_outside(const nh_verification *v, double shown, nh_text *out)
{
    nh_text_add(out, "Z is not in the canonical distribution:\n");
    for (size_t a = 0; a < v->model->k; a++) {
        char label[80];
        snprintf(label, sizeof label, "  i_Z phi^%zu = ", a + 1);
        put(v, out, label, v->form[a], shown);
        nh_text_addf(out, "    where phi^%zu belongs to %s\n", a + 1, v->system->constraint[a].text);
    }
}

const char *nh_verification_noun(const nh_verification *v, bool field)
{
    return v->of_equations ? "a symmetry of the equations of motion" : field ? "a constraint symmetry" : "conserved";
}

/* What a symmetry of the equations of motion makes of the currents that the system file knows. */
static void put_made(const nh_verification *v, double shown, nh_text *out)
{
    if (v->made) nh_text_add(out, "  it makes of known currents\n");
    for (size_t i = 0; i < v->made; i++) {
        char label[200];
        snprintf(label, sizeof label, "    Z(%.150s) = ", v->make[i].name);
        put(v, out, label, v->make[i].value, shown);
    }
}

void nh_verification_text(const nh_verification *v, bool field, double shown, nh_text *out)
{
    if (v->of_equations) put(v, out, "[Gamma,Z] = f Gamma with f = ", v->factor, shown);
    else if (field && v->outside) put_outside(v, shown, out);
    else if (field) put(v, out, "the field's current is  ", v->current, shown);
    else put(v, out, "Phi = ", v->current, INFINITY);
    if (v->region) {
        nh_text_addf(out, "NO: this is conserved only in a region: %s\n", v->region);
        return;
    }
    if (!v->conserved) {
        nh_text_addf(out, "NO: this is not %s\n  at ", nh_verification_noun(v, field));
        if (v->has_counterexample) put_point(v, out);
        nh_text_addf(out, "\n  %s = %.6g, relative to its terms %.2g\n", field ? v->equation : "Gamma(Phi)", v->rate, v->residual);
        return;
    }
    nh_text_addf(out, "YES: this is %s", nh_verification_noun(v, field));
    if (v->proof.proved) nh_text_addf(out, ", proved%s", nh_facts_holds(v->model, &v->proof, false));
    else nh_text_addf(out, ", to %.0f digits%s", v->proof.digits, v->proof.rounded ? " (its numbers are rounded to doubles)" : "");
    nh_text_add(out, nh_verification_branches(v));
    nh_text_addf(out, "%s\n", v->trivial ? "; it is trivial: the current is a constant" : "");
    if (v->has_symmetry && !v->trivial) put_field(v, shown, out);
    put_made(v, shown, out);
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
    for (size_t s = 0; s < v->model->m; s++) put_expression(v, components, v->system->coordinate[s].name, v->symmetry.field.space[s]);
    for (size_t i = 0; i < v->model->n; i++) put_expression(v, components, nh_name_of(d, v->model->chart->w[i]), v->symmetry.W[i]);
    if (v->symmetry.kase) nh_json_put_number(item, "case", v->symmetry.kase);
    else nh_json_put_null(item, "case");
    nh_json_put_bool(item, "bracket_in_distribution", v->symmetry.bracket_in_distribution);
    nh_json_put_bool(item, "projectable", v->symmetry.projectable);
}

/* Of a field: does it lie in the canonical distribution, and what it has outside of it. */
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
        for (size_t j = 0; j < v->model->width; j++) nh_json_put_number(point, nh_name_of(d, v->model->chart->symbol[j]), v->counterexample[j]);
        nh_json_put_number(point, "rate", v->rate);
    } else {
        nh_json_put_null(root, "counterexample");
    }
    nh_geometry_json(v->arena, v->theory, NULL, root);
    if (run) nh_run_json(run, v->system, root);
    return nh_json_finish(root);
}

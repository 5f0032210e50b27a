#include "document/verification.h"

#include <math.h>
#include <stdio.h>

#include "base/json.h"
#include "exact/normal.h"
#include "graph/print.h"
#include "document/facts.h"
#include "document/geometry_sheet.h"
#include "graph/node.h"

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
    nh_geometry_json(v->arena, v->theory, NULL, root);
    if (run) nh_run_json(run, v->system, root);
    return nh_json_finish(root);
}

#include "report/verdict.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "expr/print.h"

static void put(nh_text *out, nh_dag *dag, const char *label, nh_ex e)
{
    nh_text_add(out, label);
    nh_print(dag, e, out);
    nh_text_add(out, "\n");
}

static void put_point(const nh_verdict_of_one *v, nh_text *out)
{
    char number[40];
    const nh_chart *c = v->model->chart;
    for (size_t j = 0; j < v->model->width; j++) {
        nh_text_number(v->counterexample[j], number, sizeof number);
        nh_text_addf(out, "%s%s = %s", j ? ", " : "", nh_name_of(v->model->dag, c->symbol[j]), number);
    }
}

static void put_field(const nh_verdict_of_one *v, nh_text *out)
{
    nh_dag *d = v->model->dag;
    const nh_symmetry *z = &v->symmetry;
    nh_text_add(out, "  its symmetry has the components\n");
    put(out, d, "    t: ", z->Z0);
    for (size_t s = 0; s < v->model->m; s++) {
        nh_text_addf(out, "    %s: ", v->system->coordinate[s].name);
        put(out, d, "", z->field.space[s]);
    }
    for (size_t i = 0; i < v->model->n; i++) {
        nh_text_addf(out, "    %s: ", nh_name_of(d, v->model->chart->w[i]));
        put(out, d, "", z->W[i]);
    }
    nh_text_addf(out, "  case %d; [Gamma,Z] %s the canonical distribution\n", z->kase, z->bracket_in_distribution ? "lies in" : "leaves");
}

void nh_verdict_text(const nh_verdict_of_one *v, bool field, nh_text *out)
{
    nh_dag *d = v->model->dag;
    if (field) put(out, d, "the field's current is  ", v->current);
    else put(out, d, "Phi = ", v->current);
    if (!v->conserved) {
        nh_text_addf(out, "%s\n  at ", field ? "NO: this is not a constraint symmetry" : "NO: this is not conserved");
        if (v->has_counterexample) put_point(v, out);
        nh_text_addf(out, "\n  %s = %.6g, relative to its terms %.2g\n", field ? v->equation : "Gamma(Phi)", v->rate, v->residual);
        return;
    }
    nh_text_add(out, field ? "YES: this is a constraint symmetry" : "YES: this is conserved");
    if (v->proof.all_parameters) nh_text_add(out, ", proved for all parameter values");
    else if (v->proof.proved) nh_text_add(out, ", proved for these parameter values");
    else nh_text_addf(out, ", to %.0f digits", v->proof.digits);
    nh_text_addf(out, "%s\n", v->trivial ? "; but it is trivial: the current is constant" : "");
    if (v->has_symmetry && !v->trivial) put_field(v, out);
}

static void add_expression(cJSON *to, const char *key, nh_dag *dag, nh_ex e)
{
    char *text = nh_print_string(dag, e);
    cJSON_AddStringToObject(to, key, text);
    nh_free(text);
}

static void add_number(cJSON *to, const char *key, double x) { cJSON_AddItemToObject(to, key, isfinite(x) ? cJSON_CreateNumber(x) : cJSON_CreateNull()); }

static void add_symmetry(const nh_verdict_of_one *v, cJSON *to)
{
    nh_dag *d = v->model->dag;
    cJSON *item = cJSON_AddObjectToObject(to, "symmetry"), *components = NULL;
    add_expression(item, "Z0", d, v->symmetry.Z0);
    components = cJSON_AddObjectToObject(item, "components");
    add_expression(components, "t", d, v->symmetry.Z0);
    for (size_t s = 0; s < v->model->m; s++) add_expression(components, v->system->coordinate[s].name, d, v->symmetry.field.space[s]);
    for (size_t i = 0; i < v->model->n; i++) add_expression(components, nh_name_of(d, v->model->chart->w[i]), d, v->symmetry.W[i]);
    cJSON_AddNumberToObject(item, "case", v->symmetry.kase);
    cJSON_AddBoolToObject(item, "bracket_in_distribution", v->symmetry.bracket_in_distribution);
}

char *nh_verdict_json(const nh_verdict_of_one *v)
{
    nh_dag *d = v->model->dag;
    cJSON *root = cJSON_CreateObject();
    cJSON_AddNumberToObject(root, "schema", 1);
    cJSON_AddBoolToObject(root, "conserved", v->conserved);
    add_expression(root, "current", d, v->current);
    cJSON_AddBoolToObject(root, "trivial", v->trivial);
    if (v->has_symmetry) add_symmetry(v, root);
    else cJSON_AddNullToObject(root, "symmetry");
    add_number(root, "residual", v->residual);
    add_number(root, "certified_digits", floor(v->proof.digits));
    cJSON_AddBoolToObject(root, "proved", v->proof.proved);
    cJSON_AddBoolToObject(root, "proved_for_all_parameters", v->proof.all_parameters);
    if (v->has_counterexample) {
        cJSON *point = cJSON_AddObjectToObject(root, "counterexample");
        for (size_t j = 0; j < v->model->width; j++) add_number(point, nh_name_of(d, v->model->chart->symbol[j]), v->counterexample[j]);
        add_number(point, "rate", v->rate);
    } else {
        cJSON_AddNullToObject(root, "counterexample");
    }
    char *printed = cJSON_Print(root);
    cJSON_Delete(root);
    size_t length = strlen(printed);
    char *out = nh_alloc(length + 2);
    memcpy(out, printed, length);
    out[length] = '\n';
    free(printed);
    return out;
}

#include <math.h>
#include <string.h>

#include "base/json.h"
#include "graph/diff.h"
#include "exact/normal.h"
#include "graph/print.h"
#include "document/facts.h"
#include "document/reduction_internal.h"
#include "graph/dag.h"
#include "graph/node.h"

static void put_expression(nh_json *to, const char *key, nh_dag *d, nh_ex e)
{
    char *text = nh_print_string(d, e);
    nh_json_put_text(to, key, text);
    nh_free(text);
}

static void put_condition(nh_json *to, const char *key, const nh_condition *c)
{
    nh_json *item = nh_json_put_object(to, key);
    nh_json_put_bool(item, "holds", c->holds);
    nh_json_put_bool(item, "proved", c->proved);
    nh_json_put_bool(item, "for_all_parameters", c->all_parameters);
    nh_json_put_number(item, "residual", c->residual);
}

static void put_fields(nh_json *to, const nh_action *g)
{
    const nh_kinetic *k = g->kinetic;
    nh_json *list = nh_json_put_array(to, "generators"), *checks;
    for (size_t a = 0; a < g->d; a++) {
        nh_json *item = nh_json_add_object(list);
        for (size_t s = 0; s < k->m; s++)
            if (!nh_is_zero(k->dag, g->generator[a].component[s]))
                put_expression(item, k->name[s], k->dag, g->generator[a].component[s]);
    }
    nh_json *holds = nh_json_put_array(to, "holds");
    for (size_t a = 0; a < g->d; a++) {
        nh_proof proof = nh_generator_proof(k, &g->generator[a]);
        nh_facts_add_holds(holds, k->model, &proof);
    }
    checks = nh_json_put_array(to, "invariance");
    for (size_t a = 0; a < g->d; a++) {
        nh_json *item = nh_json_add_object(checks);
        put_condition(item, "kinetic_energy", &g->generator[a].metric);
        put_condition(item, "potential", &g->generator[a].potential);
        put_condition(item, "constraints", &g->generator[a].constraints);
        nh_json_put_bool(item, "local", g->generator[a].local);
    }
}

static nh_json *pair_of(nh_json *list, size_t a, size_t b)
{
    nh_json *item = nh_json_add_object(list), *of = nh_json_put_array(item, "of");
    nh_json_add_number(of, (double)a + 1);
    nh_json_add_number(of, (double)b + 1);
    return item;
}

/* The brackets of the fields that are not zero, [e_a, e_b] = -C_ab^k e_k, with the parameters: {"of": [1, 4], "is":
 * {"2": "(a + b)/a"}}; null for a bracket that is no combination of the generators. */
static void put_brackets(nh_json *to, const nh_action *g)
{
    nh_json *list = nh_json_put_array(to, "brackets");
    nh_dag *d = g->kinetic->dag;
    for (size_t a = 0; a < g->d; a++)
        for (size_t b = a + 1; b < g->d; b++) {
            nh_json *item = NULL, *is = NULL;
            if (g->outside[a * g->d + b]) {
                item = pair_of(list, a, b);
                nh_json_put_null(item, "is");
            }
            for (size_t k = 0; k < g->d; k++) {
                nh_ex c = g->constant[(a * g->d + b) * g->d + k];
                if (nh_is_zero(d, c)) continue;
                if (!item) {
                    item = pair_of(list, a, b);
                    is = nh_json_put_object(item, "is");
                }
                put_expression(is, nh_arena_printf(g->kinetic->arena, "%zu", k + 1), d, nh_neg(d, c));
            }
        }
}

static void put_algebra(nh_json *to, const nh_action *action)
{
    const nh_algebra *g = &action->algebra;
    nh_json *outer = nh_json_put_array(to, "structure_constants");
    for (size_t a = 0; a < g->d; a++) {
        nh_json *row = nh_json_add_array(outer);
        for (size_t b = 0; b < g->d; b++) {
            nh_json *entry = nh_json_add_array(row);
            for (size_t k = 0; k < g->d; k++)
                nh_json_add_number(entry, action->outside[a * g->d + b] ? NAN : g->c[(a * g->d + b) * g->d + k]);
        }
    }
}

static void put_series(nh_json *to, const char *key, size_t n, const size_t *dimension)
{
    nh_json *list = nh_json_put_array(to, key);
    for (size_t i = 0; i < n; i++) nh_json_add_number(list, (double)dimension[i]);
}

/* J_a = e_a^s dL/dv^s, the spatial momenta. */
static void put_momentum_map(nh_json *to, const nh_action *g)
{
    const nh_kinetic *k = g->kinetic;
    nh_json *list = nh_json_put_array(to, "momentum_map");
    for (size_t a = 0; a < g->d; a++) {
        nh_ex sum = nh_int(k->dag, 0);
        for (size_t s = 0; s < k->m; s++)
            if (!nh_is_zero(k->dag, g->generator[a].component[s]))
                sum = nh_add(k->dag, sum,
                             nh_mul(k->dag, g->generator[a].component[s],
                                    nh_diff(k->dag, k->model->system->lagrangian, k->v[s])));
        char *text = nh_print_string(k->dag, nh_simplify(k->dag, sum));
        nh_json_add_text(list, text);
        nh_free(text);
    }
}

static void put_group(nh_json *root, const char *key, const nh_reduction *r, const nh_group *g)
{
    nh_json *to = nh_json_put_object(root, key);
    nh_json_put_number(to, "dimension", (double)(g->action.d + g->missing));
    nh_json_put_text(to, "name", g->name);
    nh_json *global = nh_json_put_object(to, "global");
    nh_json_put_number(global, "dimension", (double)(g->local ? g->global : g->action.d));
    nh_json_put_text(global, "name", !g->local ? g->name : g->global_name ? g->global_name : NULL);
    nh_json_put_bool(global, "complete", g->missing == 0);
    put_fields(to, &g->action);
    put_algebra(to, &g->action);
    put_brackets(to, &g->action);
    put_momentum_map(to, &g->action);
    nh_json_put_number(to, "centre", (double)g->report.centre);
    nh_json_put_number(to, "radical", (double)g->report.radical);
    put_series(to, "derived_series", g->report.derived_length, g->report.derived);
    put_series(to, "lower_central_series", g->report.lower_length, g->report.lower);
    nh_json_put_number(to, "closure", g->action.closure);
    nh_json_put_bool(to, "free", g->action.free);
    nh_json_put_number(to, "orbit", (double)g->action.orbit);
    nh_json_put_number(to, "isotropy", (double)(g->action.d - g->action.orbit));
    if (r->kinetic->affine) {
        nh_json_put_number(to, "intersection", (double)g->action.intersection);
    } else {
        nh_json_put_null(to, "intersection");
    }
    if (!g->jets) {
        nh_json_put_null(to, "local");
        return;
    }
    nh_json *local = nh_json_put_object(to, "local");
    nh_json_put_number(local, "dimension", (double)g->jets->dimension);
    nh_json_put_bool(local, "exact", g->jets->exact);
    nh_json_put_number(local, "of_kinetic_energy", (double)g->jets->of_metric);
    nh_json_put_number(local, "of_kinetic_energy_and_potential", (double)g->jets->of_potential);
    nh_json_put_number(local, "of_kinetic_energy_and_constraints", (double)g->jets->of_constraints);
    nh_json_put_number(local, "without_closed_form", (double)g->missing);
    if (g == r->all) nh_json_put_number(local, "up_to_a_total_derivative", (double)r->weaker);
    nh_json_put_number(local, "largest_null_value", g->jets->last_null);
    nh_json_put_number(local, "smallest_other_value", g->jets->first_other);
}

static void put_matrix(nh_json *to, const char *key, nh_dag *d, size_t rows, size_t columns, const nh_ex *e)
{
    nh_json *outer = nh_json_put_array(to, key);
    for (size_t i = 0; i < rows; i++) {
        nh_json *row = nh_json_add_array(outer);
        for (size_t j = 0; j < columns; j++) {
            char *text = nh_print_string(d, e[i * columns + j]);
            nh_json_add_text(row, text);
            nh_free(text);
        }
    }
}

/* A condition is a list of ways to satisfy it; a way is a list of polynomials that vanish. */
static void put_conditions(nh_json *to, const nh_reduction *r, const nh_measure_conditions *c)
{
    nh_json *list[2] = {nh_json_put_array(to, "measure_where"), nh_json_put_array(to, "factor_where")};
    for (size_t i = 0; i < c->count && c->known; i++) {
        nh_json *ways = nh_json_add_array(list[c->condition[i].factor]);
        for (size_t j = 0; j < c->condition[i].where.ways; j++) {
            const nh_parameter_zeros_way *way = &c->condition[i].where.way[j];
            nh_json *all = nh_json_add_array(ways);
            for (size_t k = 0; k < way->count; k++) {
                char *text = nh_print_string(r->kinetic->dag, way->polynomial[k]);
                nh_json_add_text(all, text);
                nh_free(text);
            }
        }
    }
}

static void put_measure(nh_json *to, const nh_reduction *r, const nh_reduction_stage *s)
{
    if (!s->measure.tested) return;
    nh_json *m = nh_json_put_object(to, "measure");
    nh_json_put_bool(m, "exists", s->measure.measure);
    nh_json_put_bool(m, "exact", s->measure.exact);
    nh_json_put_bool(m, "liouville", s->measure.measure && s->measure.size == 0);
    nh_json_put_bool(m, "local", s->measure.local);
    nh_json_put_bool(m, "phi_simple", s->measure.simple);
    if (s->kind == NH_STAGE_SECOND && s->shown->n > 2) nh_json_put_null(m, "conformal_factor");
    else nh_json_put_bool(m, "conformal_factor", s->measure.factor);
    nh_json_put_number(m, "curl", s->measure.curl);
    put_conditions(m, r, &s->conditions);
    nh_json_put_bool(m, "rare", s->conditions.rare);
    nh_json_put_bool(m, "never", s->conditions.never);
    nh_json_put_bool(m, "never_hamiltonian", s->conditions.never_hamiltonian);
    if (s->measure.closed) put_expression(m, "density", r->kinetic->dag, s->measure.density);
    if (s->measure.closed) nh_json_put_bool(m, "density_proved", s->measure.proof.proved);
    if (s->measure.closed) nh_facts_put_holds(m, r->kinetic->model, &s->measure.proof);
}

static void put_chaplygin(nh_json *to, const nh_reduction *r, const nh_reduction_stage *s)
{
    const nh_chaplygin *c = s->chaplygin;
    put_matrix(to, "metric", c->dag, c->n, c->n, c->K);
    put_matrix(to, "connection", c->dag, c->d, c->n, c->A);
    put_matrix(to, "body_momentum", c->dag, c->d, c->n, c->J);
    nh_json *list = nh_json_put_array(to, "curvature"), *ups = nh_json_put_array(to, "upsilon");
    for (size_t i = 0; i < c->n; i++)
        for (size_t j = i + 1; j < c->n; j++) {
            nh_json *item = nh_json_add_object(list), *other = nh_json_add_object(ups);
            nh_json_put_text(item, "i", nh_name_of(c->dag, c->slice->x[i]));
            nh_json_put_text(item, "j", nh_name_of(c->dag, c->slice->x[j]));
            nh_json_put_text(other, "i", nh_name_of(c->dag, c->slice->x[i]));
            nh_json_put_text(other, "j", nh_name_of(c->dag, c->slice->x[j]));
            nh_json *values = nh_json_put_array(item, "values");
            for (size_t a = 0; a < c->d; a++) {
                char *text = nh_print_string(c->dag, c->B[(a * c->n + i) * c->n + j]);
                nh_json_add_text(values, text);
                nh_free(text);
            }
            nh_ex sum = nh_int(c->dag, 0);
            for (size_t k = 0; k < c->n; k++)
                sum = nh_add(c->dag, sum, nh_mul(c->dag, c->U[(k * c->n + i) * c->n + j], c->reduced.w[k]));
            put_expression(other, "value", c->dag, sum);
        }
    if (!c->plain) {
        put_matrix(to, "drift", c->dag, 1, c->d, c->A0);
        put_matrix(to, "magnetic", c->dag, 1, c->n, c->a);
        put_matrix(to, "force", c->dag, 1, c->n, c->force);
    }
    put_measure(to, r, s);
}

static void put_second(nh_json *to, const nh_reduction *r, const nh_reduction_stage *s)
{
    const nh_second *t = s->second;
    nh_dag *d = t->slice.dag;
    put_matrix(to, "locked_inertia", d, t->d, t->d, t->inertia);
    put_matrix(to, "mechanical_connection", d, t->d, t->n, t->Av);
    put_matrix(to, "metric", d, t->n, t->n, t->Kt);
    nh_json_put_bool(to, "abelian", t->abelian);
    nh_json_put_number(to, "coadjoint_orbit", (double)t->orbit);
    nh_json_put_number(to, "isotropy", (double)(t->d - t->orbit));
    nh_json_put_number(to, "condition_weak", t->weak);
    nh_json_put_number(to, "condition_strong", t->strong);
    if (s->momentum_drift >= 0) nh_json_put_number(to, "momentum_drift", s->momentum_drift);
    else nh_json_put_null(to, "momentum_drift");
    put_measure(to, r, s);
}

static void put_hamilton(nh_json *to, const nh_reduction *r, const nh_reduction_stage *s)
{
    nh_reduction_hamilton_json(r, s, to);
    nh_reduction_helmholtz_json(r, s, to);
}

static void put_chain(nh_json *to, const nh_reduction_stage *s)
{
    const nh_ideals *c = s->chain;
    const nh_poincare *p = &s->poincare;
    nh_json *list = nh_json_put_array(to, "chain"), *check;
    for (size_t j = 0; j < c->blocks; j++) {
        nh_json *block = nh_json_add_array(list);
        for (size_t i = c->start[j]; i < c->start[j] + c->size[j]; i++)
            nh_json_add_number(block, (double)c->order[i] + 1);
    }
    check = nh_json_put_object(to, "by_stages");
    nh_json_put_number(check, "intersection", (double)p->dimension);
    nh_json_put_number(check, "places", (double)p->places);
    nh_json_put_number(check, "one_stage_vertical", p->one_vertical);
    nh_json_put_number(check, "one_stage_horizontal", p->one_horizontal);
    nh_json_put_number(check, "by_stages_vertical", p->stages_vertical);
    nh_json_put_number(check, "by_stages_horizontal", p->stages_horizontal);
    nh_json_put_number(check, "bracket", p->bracket);
    nh_json_put_number(check, "euler_poincare", p->euler_poincare);
}

static void put_locked_inertia(nh_json *to, const nh_slice *s)
{
    nh_ex *e = nh_alloc_array(s->d * s->d + 1, sizeof *e);
    for (size_t a = 0; a < s->d * s->d; a++) e[a] = s->K[(s->n + a / s->d) * s->m + s->n + a % s->d];
    put_matrix(to, "locked_inertia", s->dag, s->d, s->d, e);
    nh_free(e);
}

/* The method of a motion, where an accuracy is requested. */
static nh_json *put_choice(nh_json *to, const nh_reduction_choice *c)
{
    if (!c->method) return NULL;
    nh_json *item = nh_json_put_object(to, "accuracy");
    nh_json_put_bool(item, "held", c->held);
    nh_json_put_text(item, "method", c->method);
    nh_json_put_number(item, "tolerance", c->tolerance);
    nh_json_put_number(item, "step", c->step);
    nh_json_put_number(item, "error", c->error);
    nh_json_put_number(item, "evaluations", (double)c->evaluations);
    nh_json_put_number(item, "seconds", c->seconds);
    nh_json_put_text(item, "next", c->next);
    nh_json_put_number(item, "times", c->times);
    nh_json_put_number(item, "runs", c->runs);
    nh_json_put_text(item, "why", c->why);
    return item;
}

static void put_slice(nh_json *to, const nh_reduction *r, const nh_reduction_stage *s)
{
    const nh_slice *slice = s->shown_slice;
    nh_dag *d = r->kinetic->dag;
    nh_json *y = nh_json_put_object(to, "slice"), *list = nh_json_put_array(to, "moved");
    for (size_t a = 0; a < slice->d; a++) put_expression(y, slice->kinetic->name[slice->along[a]], d, slice->y[a]);
    for (size_t i = 0; i < slice->n; i++)
        if (nh_slice_moves(slice, i)) nh_json_add_text(list, nh_name_of(d, slice->x[i]));
}

static void put_stage(nh_json *stages, const nh_reduction *r, size_t number)
{
    const nh_reduction_stage *s = nh_reduction_named(&r->stage[number]);
    nh_json *to = nh_json_add_object(stages), *list = nh_json_put_array(to, "shape");
    nh_dag *d = r->kinetic->dag;
    nh_json_put_text(to, "kind", nh_stage_kind_name(s->kind));
    nh_json_put_text(to, "group", s->group);
    nh_json_put_bool(to, "local", s->local);
    nh_json_put_bool(to, "alternative", nh_reduction_instead(r, number));
    put_fields(to, s->action);
    for (size_t i = 0; i < s->shown->n; i++) nh_json_add_text(list, nh_name_of(d, s->shown->x[i]));
    put_slice(to, r, s);
    list = nh_json_put_array(to, "velocities");
    for (size_t i = 0; i < s->shown->r; i++) nh_json_add_text(list, nh_name_of(d, s->shown->w[i]));
    nh_reduction_equation *e;
    size_t n = nh_reduction_equations(r, s, &e);
    size_t momenta = s->shown->plain ? 0 : s->shown->r;
    nh_json *momentum = nh_json_put_array(to, "momentum"), *equations = nh_json_put_array(to, "equations"),
            *group = nh_json_put_array(to, "group_velocity");
    for (size_t i = 0; i < n; i++) {
        bool rate = i >= momenta && i + s->shown->d < n;
        nh_json *item = nh_json_add_object(i < momenta ? momentum : rate ? equations : group);
        nh_json_put_text(item, "of",
                         rate ? nh_arena_strndup(r->kinetic->arena, e[i].name, strlen(e[i].name) - 1) : e[i].name);
        put_expression(item, rate ? "rate" : "value", d, e[i].value);
    }
    if (s->kind == NH_STAGE_CHAPLYGIN) put_chaplygin(to, r, s);
    if (s->kind == NH_STAGE_SECOND) put_second(to, r, s);
    put_hamilton(to, r, s);
    if (s->by_stages) put_chain(to, s);
    if (s->kind == NH_STAGE_POINCARE || s->kind == NH_STAGE_SLICE) put_locked_inertia(to, s->shown_slice);
    nh_sheet *sheet = nh_reduction_sheet(r, s);
    if (sheet) nh_sheet_json(sheet, nh_json_put_object(to, "geometry"));
    else nh_json_put_null(to, "geometry");
    if (s->linear.count) {
        nh_json *linear = nh_json_put_object(to, "linear_momenta"), *which = nh_json_put_array(linear, "momenta");
        for (size_t a = 0; a < s->linear.count; a++) nh_json_add_text(which, s->shown->momentum[s->linear.index[a]]);
        put_matrix(linear, "equation", d, s->linear.count, s->linear.count, s->linear.N);
        if (s->linear_drift >= 0) nh_json_put_number(linear, "drift", s->linear_drift);
        else nh_json_put_null(linear, "drift");
    }
    if (s->compared)
        nh_json_put_number(to, s->against_full ? "agreement_with_full" : "agreement_with_first", s->agreement);
    else nh_json_put_null(to, "agreement_with_full");
    if (s->unsure > 0) nh_json_put_number(to, "unsure", s->unsure);
    const char *why = nh_reduction_no_energy(r, s);
    if (why) nh_json_put_text(to, "energy_not_followed", why);
    put_choice(to, &s->choice);
    nh_json_put_number(to, "reached", s->reached);
    if (s->printed_states) nh_json_put_number(to, "printed_difference", s->printed);
    else nh_json_put_null(to, "printed_difference");
    if (s->energy_drift >= 0) nh_json_put_number(to, "energy_drift", s->energy_drift);
    else nh_json_put_null(to, "energy_drift");
    nh_json_put_number(to, "restarts", (double)s->restarts);
    nh_json_put_number(to, "charts", (double)s->charts);
    nh_json_put_number(to, "seconds", s->seconds);
    nh_json_put_number(to, "speedup", s->speedup);
    nh_reduction_motion_json(r, s, to);
}

static void put_momenta(nh_json *root, const nh_reduction *r)
{
    nh_json *list = nh_json_put_array(root, "momenta");
    const nh_kinetic *k = r->kinetic;
    for (size_t i = 0; i < r->momenta.count; i++) {
        const nh_momentum *p = &r->momenta.momentum[i];
        nh_json *item = nh_json_add_object(list), *field = nh_json_put_object(item, "field");
        nh_json_put_text(item, "kind",
                         p->moving          ? "moving energy"
                         : p->of_lagrangian ? "lagrangian"
                         : p->horizontal    ? "horizontal"
                         : p->gauge         ? "gauge"
                                            : "momentum");
        for (size_t s = 0; s < k->m; s++)
            if (!nh_is_zero(k->dag, p->field[s])) put_expression(field, k->name[s], k->dag, p->field[s]);
        put_expression(item, "expression", k->dag, p->value);
        nh_json_put_bool(item, "proved", p->proof.proved);
        nh_facts_put_holds(item, k->model, &p->proof);
        nh_json_put_bool(item, "local", p->local);
    }
}

static void put_unused(nh_json *root, const nh_reduction *r)
{
    nh_json *list = nh_json_put_array(root, "not_used");
    for (size_t i = 0; i < r->unused_count; i++) {
        nh_json *item = nh_json_add_object(list);
        nh_json_put_text(item, "what", r->unused[i].what);
        nh_json_put_text(item, "why", r->unused[i].why);
    }
}

static void put_joints(nh_json *root, const nh_reduction *r)
{
    const nh_chain_symmetries *c = r->joints;
    if (!c) return;
    nh_json *list = nh_json_put_array(root, "joints");
    for (size_t i = 0; i < c->fields; i++) {
        const nh_generator *g = &r->of_joint[i];
        nh_json *item = nh_json_add_object(list), *field;
        nh_json_put_text(item, "joint", nh_reduction_joint_name(r, c->field[i].joint));
        nh_json_put_text(item, "rule", nh_chain_rule_name(c->field[i].rule));
        field = nh_json_put_object(item, "field");
        for (size_t s = 0; s < r->kinetic->m; s++)
            if (!nh_is_zero(r->kinetic->dag, g->component[s]))
                put_expression(field, r->kinetic->name[s], r->kinetic->dag, g->component[s]);
        nh_json_put_bool(item, "kinetic_energy", g->metric.holds);
        nh_json_put_bool(item, "potential", g->potential.holds);
        nh_json_put_bool(item, "constraints", g->constraints.holds);
        nh_json_put_bool(item, "local", g->local);
    }
}

char *nh_reduction_json(const nh_reduction *r, const nh_run *run)
{
    nh_json *root = nh_json_object(), *parameters, *warnings, *stages;
    nh_json_put_number(root, "schema", 1);
    nh_json_put_text(root, "version", NH_VERSION);
    nh_json_put_text(root, "system", r->system->name);
    parameters = nh_json_put_object(root, "parameters");
    for (size_t i = 0; i < r->system->parameters; i++)
        nh_json_put_number(parameters, r->system->parameter[i].name, r->system->parameter[i].value);
    put_group(root, "group", r, r->all ? r->all : r->group);
    if (r->all && r->group != r->all) put_group(root, "divided", r, r->group);
    const nh_action *g = &r->group->action;
    nh_json_put_bool(root, "dimension_assumption", g->dimension_assumption);
    bool chaplygin = false;
    for (size_t i = 0; i < r->stages; i++) chaplygin |= r->stage[i].kind == NH_STAGE_CHAPLYGIN;
    nh_json_put_bool(root, "chaplygin", chaplygin);
    put_joints(root, r);
    nh_reduction_metric_json(r, root);
    nh_json_put_bool(root, "partial", r->partial);
    nh_json *full = put_choice(root, &r->full);
    if (!full) nh_json_put_null(root, "accuracy");
    if (full) {
        nh_json_put_number(full, "wanted", r->wanted);
        nh_json_put_text(full, "formulation", r->full_formulation);
    }
    stages = nh_json_put_array(root, "stages");
    for (size_t i = 0; i < r->stages; i++) put_stage(stages, r, i);
    nh_reduction_full_json(r, root);
    put_momenta(root, r);
    nh_reduction_growth_json(r, root);
    put_unused(root, r);
    nh_json_put_number(root, "coordinates", (double)r->kinetic->m);
    nh_json_put_number(root, "seconds", r->seconds);
    warnings = nh_json_put_array(root, "warnings");
    for (size_t i = 0; i < r->warnings; i++) nh_json_add_text(warnings, r->warning[i]);
    if (run) nh_run_json(run, r->system, root);
    return nh_json_finish(root);
}

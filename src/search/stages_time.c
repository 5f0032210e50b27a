/* stages_time: functions that the stages add where the Lagrangian, a force or a constraint depends on time. */
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/function.h"
#include "graph/node.h"
#include "search/stages_internal.h"

enum { most_powers = 6, longest_walk = 1000 };

void nh_expr_set_put_time(const nh_family_list *s, nh_expr_set *l)
{
    nh_dag *d = s->o->dag;
    nh_expr_set f = nh_expr_set_functions(s, true);
    for (size_t i = 0; i < f.n; i++) {
        bool timely = true;
        for (size_t j = 0; j < s->w->positions; j++) timely &= !nh_depends(d, f.e[i], s->w->position[j]);
        if (!timely) continue;
        nh_expr_set_put(l, f.e[i]);
        nh_ex slope = nh_diff(d, f.e[i], s->o->system->t);
        if (nh_kind_of(d, slope) != NH_NUMBER) nh_expr_set_put(l, slope);
    }
}

bool nh_family_list_timely(const nh_family_list *s)
{
    const nh_model *model = s->o;
    nh_ex t = model->system->t;
    bool timely = nh_depends(model->dag, model->Lbar, t);
    for (size_t k = 0; k < model->m; k++)
        timely |= nh_depends(model->dag, model->rho[k], t) ||
                  (model->system->has_forces && nh_depends(model->dag, model->system->force[k], t));
    return timely;
}

/* The highest power of t in a sum of products; inside of functions and roots it does not count. */
static long power_of_time(const nh_model *model, nh_ex e, int *left)
{
    nh_dag *d = model->dag;
    nh_kind kind = nh_kind_of(d, e);
    if (e == model->system->t) return 1;
    if (kind != NH_SUM && kind != NH_PRODUCT) return 0;
    if (--*left < 0) return most_powers;
    long highest = 0, all = 0;
    for (size_t i = 0; i < nh_arity(d, e); i++) {
        long power = power_of_time(model, nh_child(d, e, i), left);
        nh_ex x = kind == NH_PRODUCT ? nh_exponent_of(d, e, i) : nh_int(d, 1);
        if (nh_kind_of(d, x) != NH_NUMBER || nh_number_of(d, x).q != 1 || nh_number_of(d, x).p < 0) continue;
        power = power * nh_number_of(d, x).p < most_powers ? power * nh_number_of(d, x).p : most_powers;
        highest = power > highest ? power : highest;
        all += power;
    }
    return kind == NH_SUM ? highest : all < most_powers ? all : most_powers;
}

/* The power that a force t^p needs after two integrations, without functions of t.  More powers would be nearly
 * dependent on the functions, where t has a short interval. */
static long powers_of_time(const nh_model *model)
{
    int left = longest_walk;
    long p = power_of_time(model, model->system->lagrangian, &left);
    for (size_t k = 0; k < model->m; k++) {
        long here = power_of_time(model, model->rho[k], &left),
             force = model->system->has_forces ? power_of_time(model, model->system->force[k], &left) : 0;
        p = here > p ? here : p;
        p = force > p ? force : p;
    }
    return p + 2 < most_powers ? p + 2 : most_powers;
}

/* The functions that a force depending on t alone adds to momenta and centres of mass: powers of t, and functions of t
 * by themselves and times t. */
void nh_family_list_drive(nh_family_list *s)
{
    nh_dag *d = s->o->dag;
    nh_ex t = s->o->system->t;
    nh_expr_set f = {0}, powers = {0}, some = {0};
    nh_expr_set_put_time(s, &f);
    for (long k = 1, most = powers_of_time(s->o); k <= most; k++) nh_expr_set_put(&powers, nh_powi(d, t, k));
    nh_expr_set_put(&some, nh_int(d, 1));
    nh_expr_set_put(&some, t);
    nh_family_list_add(s, nh_family_list_terms(s, &powers));
    nh_family_list_product_of_sets(s, &f, &some);
}

/* The fewest functions for a momentum, and a centre of mass, on which only a force in t acts: many functions of t are
 * nearly dependent where t has a short interval. */
void nh_stage_drive(nh_family_list *s)
{
    nh_dag *d = s->o->dag;
    nh_ex t = s->o->system->t;
    nh_expr_set p = {0}, g = {0}, q = nh_expr_set_positions(s, false, false), f = nh_expr_set_functions(s, false),
                powers = {0};
    if (!nh_family_list_timely(s)) return;
    nh_expr_set_put_all(&p, s->w->momenta, s->w->momentum);
    nh_expr_set_put(&g, nh_int(d, 1));
    nh_expr_set_put(&g, t);
    for (size_t i = 0; i < f.n; i++)
        if (nh_function_of(d, f.e[i]) == NH_LOG && nh_depends(d, f.e[i], t)) nh_expr_set_put(&g, f.e[i]);
    for (long k = 1, most = powers_of_time(s->o); k <= most; k++) nh_expr_set_put(&powers, nh_powi(d, t, k));
    nh_family_list_product_of_sets(s, &p, &g);
    nh_family_list_add(s, nh_family_list_terms(s, &q));
    nh_family_list_add(s, nh_family_list_terms(s, &powers));
}

/* Squares of positions and velocities with coefficients that depend on time: Ermakov and Lewis. */
void nh_stage_time(nh_family_list *s)
{
    nh_dag *d = s->o->dag;
    nh_expr_set l = {0}, f = nh_expr_set_functions(s, true), g = {0};
    nh_ex t = s->o->system->t;
    if (!nh_family_list_timely(s) || s->w->positions > 3) return;
    nh_expr_set_put_all(&l, s->w->positions, s->w->position);
    nh_expr_set_put_all(&l, s->o->n, s->o->chart->w);
    nh_expr_set v = nh_expr_set_squares(s, &l);
    nh_expr_set_put(&g, nh_int(d, 1));
    nh_expr_set_put(&g, t);
    nh_expr_set_put(&g, nh_powi(d, t, 2));
    for (size_t i = 0; i < f.n; i++) {
        bool timely = nh_depends(d, f.e[i], t);
        for (size_t j = 0; j < s->w->positions; j++) timely &= !nh_depends(d, f.e[i], s->w->position[j]);
        if (timely) nh_expr_set_put(&g, f.e[i]);
    }
    nh_family_list_product_of_sets(s, &v, &g);
    nh_family_list_product_of_sets(s, &l, &g);
    nh_expr_set p = {0}, powers = {0};
    nh_expr_set_put_all(&p, s->w->potentials, s->w->potential);
    for (int k = 0; k <= 4; k++) nh_expr_set_put(&powers, nh_powi(d, t, k));
    nh_family_list_product_of_sets(s, &p, &powers);
}

/* Stages for integrals homogeneous with weights, as Kovalevskaya's; for separable systems; with half angles. */
#include "graph/diff.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/node.h"
#include "graph/function.h"
#include "search/stages_internal.h"

/* Weighted degree four: linear forms have weight one, terms of the potential and their derivatives two, as in the
 * energy (Kovalevskaya's integral, Toda's, Calogero's). */
static void weighted(nh_family_list *s, const nh_expr_set *u, const nh_expr_set *f)
{
    nh_expr_set ff = nh_expr_set_squares(s, f);
    nh_family_list_add(s, nh_family_list_polynomial(s, u, 4));
    if (f->n)
        nh_family_list_add(s, nh_family_list_product(
                                  s, 2, (nh_family[]){nh_family_list_polynomial(s, u, 2), nh_family_list_terms(s, f)}));
    nh_family_list_add(s, nh_family_list_terms(s, &ff));
}

/* e, without its number as a factor. */
static void put_up_to_number(const nh_family_list *s, nh_expr_set *l, nh_ex e)
{
    nh_dag *d = s->o->dag;
    if (nh_kind_of(d, e) == NH_PRODUCT) e = nh_div(d, e, nh_number(d, nh_constant_of(d, e)));
    if (nh_kind_of(d, e) != NH_NUMBER) nh_expr_set_put(l, e);
}

/* Terms of the potential and, where these stay few, their derivatives by the angles again, or along quasi-velocities: a
 * rotor adds the component of gravity along it. */
static nh_expr_set weight_two(const nh_family_list *s)
{
    enum { most = 10, few = 7, longest = 30 };
    const nh_model *model = s->o;
    nh_expr_set f = {0};
    nh_expr_set_put_all(&f, s->w->potentials < most ? s->w->potentials : most, s->w->potential);
    nh_expr_set more = f, along = {0};
    for (size_t i = 0; i < f.n; i++)
        for (size_t j = 0; j < s->w->waves; j++) put_up_to_number(s, &more, nh_diff(model->dag, f.e[i], s->w->wave[j]));
    for (size_t i = 0; i < s->w->potentials && model->chart->quasi; i++)
        for (size_t j = 0; j < model->n; j++) {
            nh_ex slope = nh_simplify_short(model->dag, nh_model_X(model, j, s->w->potential[i]), 0);
            if (nh_complexity(model->dag, slope) <= longest) put_up_to_number(s, &along, slope);
        }
    if (along.n <= few) nh_expr_set_put_all(&f, along.n, along.e);
    return more.n <= few && !model->chart->quasi ? more : f;
}

void nh_stage_weight_4(nh_family_list *s)
{
    nh_expr_set u = {0}, f = weight_two(s);
    if (s->w->frames == s->o->n) nh_expr_set_put_all(&u, s->w->frames, s->w->frame);
    else nh_expr_set_put_all(&u, s->o->n, s->o->chart->w);
    weighted(s, &u, &f);
}

/* Integrals from separation of variables (Euler's two centres, Liouville's systems): squares of velocities with
 * coefficients of higher degree in the positions, the energy and the system's functions with lower ones. */
void nh_stage_separation(nh_family_list *s)
{
    nh_expr_set l = {0}, e = {0}, q = nh_expr_set_positions(s, false, false), f = nh_expr_set_functions(s, false);
    bool few = s->w->positions <= 2;
    if (s->w->positions > 3 || s->w->waves) return;
    nh_expr_set_put_all(&l, s->o->n, s->o->chart->w);
    nh_expr_set v = nh_expr_set_squares(s, &l);
    nh_expr_set_put(&e, s->o->E);
    nh_expr_set_put_all(&e, f.n, f.e);
    nh_family_list_add(
        s, nh_family_list_product(
               s, 2, (nh_family[]){nh_family_list_terms(s, &v), nh_family_list_polynomial(s, &q, few ? 4 : 2)}));
    nh_family_list_add(s, nh_family_list_product(
                              s, 2, (nh_family[]){nh_family_list_terms(s, &e), nh_family_list_polynomial(s, &q, 2)}));
    nh_family_list_add(s, nh_family_list_polynomial(s, &q, 4));
}

/* Parabolic coordinates are r cos^2(q/2), r sin^2(q/2): integrals that separate in them are quadratic in the frame
 * times lengths and half angles. */
void nh_stage_half_angles(nh_family_list *s)
{
    nh_dag *d = s->o->dag;
    nh_expr_set half = {0}, f = {0}, l = nh_expr_set_lengths(s, false, false), ll = nh_expr_set_lengths(s, true, false);
    if (s->w->waves != 1 || s->w->frames != s->o->n || s->o->k) return;
    for (int k = 1; k <= 3; k += 2) {
        nh_ex angle = nh_mul(d, nh_ratio(d, k, 2), s->w->wave[0]);
        nh_expr_set_put(&half, nh_call(d, NH_COS, angle));
        nh_expr_set_put(&half, nh_call(d, NH_SIN, angle));
    }
    nh_expr_set_put_all(&f, s->w->frames, s->w->frame);
    nh_expr_set ff = nh_expr_set_squares(s, &f);
    nh_family_list_add(s,
                       nh_family_list_product(s, 3,
                                              (nh_family[]){nh_family_list_terms(s, &ff), nh_family_list_terms(s, &l),
                                                            nh_family_list_terms(s, &half)}));
    nh_family_list_product_of_sets(s, &ll, &half);
}

/* Stages for separable systems, for polynomial potentials, and for coefficients that depend on time. */

#include "graph/dag.h"
#include "graph/function.h"
#include "search/stages_internal.h"

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

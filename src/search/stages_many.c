/* Stages of few columns for systems of many coordinates: centres of mass and angular momenta.  All products of degree
 * one or two would be too many. */
#include "graph/dag.h"
#include "search/stages_internal.h"

/* Momenta times 1 and t, positions, t. */
void nh_stage_centres(nh_family_list *s)
{
    nh_expr_set p = {0}, one = {0}, q = nh_expr_set_positions(s, false, true);
    nh_expr_set_put_all(&p, s->w->momenta, s->w->momentum);
    nh_expr_set_put(&one, nh_int(s->o->dag, 1));
    nh_expr_set_put(&one, s->o->system->t);
    nh_family_list_product_of_sets(s, &p, &one);
    nh_family_list_add(s, nh_family_list_terms(s, &q));
}

/* q_i v_j - q_j v_i: with a constant kinetic energy v^T M v/2 every linear field that leaves it invariant is M^-1 S q
   with S antisymmetric, and has the momentum v^T S q. */
void nh_stage_turns(nh_family_list *s)
{
    const nh_model *o = s->o;
    nh_dag *d = o->dag;
    nh_expr_set l = {0};
    if (o->k || o->chart->quasi) return;
    for (size_t i = 0; i < o->m; i++)
        for (size_t j = 0; j < i; j++) {
            const nh_coordinate *a = &o->system->coordinate[i], *b = &o->system->coordinate[j];
            if (a->type != NH_ANGLE && b->type != NH_ANGLE)
                nh_expr_set_put(&l, nh_sub(d, nh_mul(d, a->q, b->v), nh_mul(d, b->q, a->v)));
        }
    nh_family_list_add(s, nh_family_list_terms(s, &l));
}

/* Stages of few columns for systems of many coordinates, where everything of degree one or two times everything else is too much: centres of mass and angular momenta. */
#include "search/stages_internal.h"

/* Momenta times 1 and t, positions, t. */
void nh_stage_centres(nh_shelf *s)
{
    nh_list p = {0}, one = {0}, q = nh_list_positions(s, false, true);
    nh_list_put_all(&p, s->w->momenta, s->w->momentum);
    nh_list_put(&one, nh_int(s->o->dag, 1));
    nh_list_put(&one, s->o->system->t);
    nh_shelf_product_of_lists(s, &p, &one);
    nh_shelf_add(s, nh_shelf_terms(s, &q));
}

/* q_i v_j - q_j v_i: with a constant kinetic energy v^T M v/2 every linear field that leaves it invariant is M^-1 S q with S antisymmetric, and has the momentum v^T S q. */
void nh_stage_turns(nh_shelf *s)
{
    const nh_model *o = s->o;
    nh_dag *d = o->dag;
    nh_list l = {0};
    if (o->k || o->chart->quasi) return;
    for (size_t i = 0; i < o->m; i++)
        for (size_t j = 0; j < i; j++) {
            const nh_coordinate *a = &o->system->coordinate[i], *b = &o->system->coordinate[j];
            if (a->type != NH_ANGLE && b->type != NH_ANGLE) nh_list_put(&l, nh_sub(d, nh_mul(d, a->q, b->v), nh_mul(d, b->q, a->v)));
        }
    nh_shelf_add(s, nh_shelf_terms(s, &l));
}

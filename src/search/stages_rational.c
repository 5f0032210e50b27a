/* Stages for Lagrangians with velocities in denominators, as 1/(x' + x^2), and logarithms of them.
 *
 * Where L is a function of D = x' + f(x), D satisfies D' = lambda(x) D along the motion (a Darboux factor), so that
 * quotients by D have short rates: for L = 1/(x' + x^2) the rate of x/D is 1, that of 1/D is x/D. */
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/num.h"
#include "search/stages_internal.h"

enum { most_denominators = 3, most_variables = 7 };

/* Is e affine in the velocities of the chart, and not free of them? */
static bool is_affine(const nh_model *model, nh_ex e)
{
    bool moves = false, affine = true;
    for (size_t i = 0; i < model->n && affine; i++) {
        nh_ex slope = nh_diff(model->dag, e, model->chart->w[i]);
        moves |= !nh_is_zero(model->dag, slope);
        for (size_t j = 0; j < model->n && affine; j++) affine = !nh_depends(model->dag, slope, model->chart->w[j]);
    }
    return moves && affine;
}

/* x'' + f(x) x' + g(x) = 0 with (g/f)' = c (1 - c) f (Chiellini's condition, [HarkoLoboMak2014]) has the Darboux
 * factors D = x' + h/c and x' + h/(1 - c), h = g/f, with D' = -c f D and -(1 - c) f D.  Writes both, and the power of
 * the first times one of the second that is constant.  False: there are none with rational c. */
static bool chiellini(const nh_family_list *s, nh_ex out[3])
{
    const nh_model *o = s->o;
    nh_dag *d = o->dag;
    if (o->m != 1 || o->n != 1 || o->k || nh_depends(d, o->a[0], o->system->t)) return false;
    nh_ex w = o->chart->w[0], zero = nh_int(d, 0), f = nh_simplify(d, nh_neg(d, nh_diff(d, o->a[0], w))),
          g = nh_neg(d, nh_substitute(d, o->a[0], 1, &w, &zero));
    if (nh_is_zero(d, f) || nh_is_zero(d, g) || nh_depends(d, f, w)) return false;
    nh_ex h = nh_simplify(d, nh_div(d, g, f)),
          product = nh_simplify(d, nh_div(d, nh_diff(d, h, o->system->coordinate[0].q), f)),
          root = nh_simplify(d, nh_sqrt(d, nh_sub(d, nh_int(d, 1), nh_mul(d, nh_int(d, 4), product)))),
          c = nh_div(d, nh_add(d, nh_int(d, 1), root), nh_int(d, 2)), other = nh_sub(d, nh_int(d, 1), c);
    if (nh_kind_of(d, c) != NH_NUMBER || !nh_num_short(nh_number_of(d, c)) || nh_is_zero(d, other)) return false;
    out[0] = nh_add(d, w, nh_div(d, h, c));
    out[1] = nh_add(d, w, nh_div(d, h, other));
    nh_num power = nh_number_of(d, c); /* D_0^(1 - c) D_1^-c, to a whole power */
    out[2] = nh_mul(d, nh_powi(d, out[0], power.q - power.p), nh_powi(d, out[1], -power.p));
    return true;
}

/* The denominators, arguments of logarithms and roots in the Lagrangian that are affine in the velocities, and the
 * Darboux factors of an equation of Lienard's kind. */
static nh_expr_set denominators(const nh_family_list *s)
{
    nh_dag *d = s->o->dag;
    nh_expr_set out = {0};
    nh_ex *node;
    size_t count = nh_nodes_in(d, 1, &s->o->Lbar, &node);
    for (size_t i = 0; i < count; i++) {
        nh_kind kind = nh_kind_of(d, node[i]);
        bool log = kind == NH_FUNCTION && nh_function_of(d, node[i]) == NH_LOG;
        for (size_t k = 0; (log || kind == NH_PRODUCT) && k < nh_arity(d, node[i]); k++) {
            nh_ex exponent = log ? 0 : nh_exponent_of(d, node[i], k);
            bool below = log || (nh_kind_of(d, exponent) == NH_NUMBER &&
                                 (nh_number_of(d, exponent).p < 0 || nh_number_of(d, exponent).q > 1));
            nh_ex D = nh_child(d, node[i], k);
            if (below && out.n < most_denominators && is_affine(s->o, D)) nh_expr_set_put(&out, D);
        }
    }
    nh_free(node);
    nh_ex factor[3];
    if (chiellini(s, factor)) nh_expr_set_put_all(&out, 2, factor);
    return out;
}

/* Quotients of monomials in time, positions and velocities, up to degree two, by the denominators and their squares;
 * their logarithms; polynomials in time and positions. */
void nh_stage_rational(nh_family_list *s)
{
    nh_dag *d = s->o->dag;
    nh_expr_set D = denominators(s), over = {0}, u = {0}, tq = nh_expr_set_positions(s, false, true), rest = {0};
    if (!D.n) return;
    for (size_t i = 0; i < D.n; i++) {
        nh_expr_set_put(&over, nh_powi(d, D.e[i], -1));
        nh_expr_set_put(&over, nh_powi(d, D.e[i], -2));
        nh_expr_set_put(&rest, nh_call(d, NH_LOG, D.e[i]));
    }
    nh_expr_set_put_all(&u, tq.n, tq.e);
    nh_expr_set_put_all(&u, s->o->n, s->o->chart->w);
    nh_ex factor[3];
    if (chiellini(s, factor)) nh_expr_set_put(&rest, factor[2]);
    nh_expr_set_put(&rest, s->o->E);
    size_t degree = u.n > most_variables ? 1 : 2;
    nh_family part[2] = {nh_family_list_terms(s, &over), nh_family_list_polynomial(s, &u, degree)};
    nh_family_list_add(s, nh_family_list_product(s, 2, part));
    nh_family_list_add(s, nh_family_list_polynomial(s, &tq, 2));
    nh_family_list_add(s, nh_family_list_terms(s, &rest));
}

/* Quotients of 1 and positions by the denominators, and 1: what oscillates or grows with time. */
nh_expr_set nh_expr_set_quotients(const nh_family_list *s)
{
    nh_dag *d = s->o->dag;
    nh_expr_set D = denominators(s), q = nh_expr_set_positions(s, true, false), out = {0};
    for (size_t i = 0; i < D.n; i++)
        for (size_t j = 0; j < q.n; j++) nh_expr_set_put(&out, nh_div(d, q.e[j], D.e[i]));
    if (out.n) nh_expr_set_put(&out, nh_int(d, 1));
    return out;
}

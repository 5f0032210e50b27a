/* explicit_motion_curve: the values along one curve, and states from currents.
 *
 *     in terms of     s, C, R, J and unsolved states     nh_explicit_along
 *                     the states (t, q, w)               nh_explicit_at_points: C, R by their values, J = 0
 *
 * A quadratic current a u^2 + b u + e = C gives u = (-b + r)/(2 a), r^2 = b^2 - 4 a (e - C).  Where r^2 = (known)^2
 * times something free of s, r is a constant in place of C; else r = factor times R, with R^2 given and dR/ds =
 * (R^2)'/(2 R). */
#include "search/explicit_motion_internal.h"

#include <math.h>
#include <string.h>

#include "exact/generic_value.h"
#include "exact/normal.h"
#include "exact/square.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/measure.h"
#include "graph/monomials.h"
#include "graph/node.h"

/* ---- expressions along the curve and in the states ---- */

nh_ex nh_explicit_simple(const nh_explicit_curve *c, nh_ex e)
{
    return nh_simplify_short(c->d, e, (size_t)c->options->quadrature_length);
}

bool nh_explicit_too_long(const nh_explicit_curve *c, nh_ex e)
{
    return nh_complexity(c->d, e) > (size_t)c->options->quadrature_length;
}

nh_ex nh_explicit_along(const nh_explicit_curve *c, nh_ex e)
{
    nh_ex *from = nh_alloc_array(c->m->states + 1, sizeof *from), *to = nh_alloc_array(c->m->states + 1, sizeof *to);
    size_t n = 0;
    for (size_t i = 0; i < c->m->states; i++)
        if (c->solved[i] && i != c->m->parameter) from[n] = c->m->state[i], to[n++] = c->value[i];
    e = nh_substitute(c->d, e, n, from, to);
    nh_free(to);
    nh_free(from);
    return e;
}

/* In the states alone; integrals are 0. */
static nh_ex in_states(const nh_explicit_curve *c, nh_ex e)
{
    const nh_explicit_motion *m = c->m;
    nh_ex zero = nh_int(c->d, 0);
    for (size_t i = m->integrals; i-- > 0;) e = nh_substitute(c->d, e, 1, &m->integral[i].symbol, &zero);
    for (size_t i = m->roots; i-- > 0;) e = nh_substitute(c->d, e, 1, &m->root[i].symbol, &m->root[i].value);
    for (size_t i = m->constants; i-- > 0;)
        e = nh_substitute(c->d, e, 1, &m->constant[i].symbol, &m->constant[i].value);
    return e;
}

nh_ex nh_explicit_at_points(const nh_explicit_curve *c, nh_ex e)
{
    return nh_combined_coordinates_out(c->combined, c->d, in_states(c, e));
}

bool nh_explicit_has_integral(const nh_explicit_curve *c, nh_ex e)
{
    for (size_t i = 0; i < c->m->integrals; i++)
        if (nh_depends(c->d, e, c->m->integral[i].symbol)) return true;
    return false;
}

/* The number of points at which it is positive, and at which it is negative. */
static void count_signs(const nh_explicit_curve *c, nh_ex e, size_t *above, size_t *below)
{
    *above = *below = 0;
    if (nh_explicit_has_integral(c, e)) return;
    double *value = nh_alloc_array(c->points->count + 1, sizeof *value);
    nh_ex here = e;
    for (size_t i = c->m->roots; i-- > 0;) here = nh_substitute_root(c->d, here, c->radicand[i], c->m->root[i].symbol);
    here = nh_explicit_at_points(c, here);
    nh_points_evaluate(c->points, c->o, 1, &here, value);
    for (size_t p = 0; p < c->points->count; p++) {
        *above += value[p] > 0;
        *below += value[p] < 0;
    }
    nh_free(value);
}

int nh_explicit_sign(void *curve, nh_ex e)
{
    size_t above, below;
    count_signs(curve, e, &above, &below);
    return (above > 0) - (below > 0);
}

int nh_explicit_mostly(void *curve, nh_ex e)
{
    size_t above, below;
    count_signs(curve, e, &above, &below);
    return (above > below) - (below > above);
}

size_t nh_explicit_unknowns(const nh_explicit_curve *c, nh_ex e, size_t *last)
{
    size_t n = 0;
    for (size_t i = 0; i < c->m->states; i++)
        if (!c->solved[i] && nh_depends(c->d, e, c->m->state[i])) *last = i, n++;
    return n;
}

void nh_explicit_settle(nh_explicit_curve *c, size_t u, nh_ex value)
{
    nh_ex symbol = c->m->state[u];
    for (size_t i = 0; i < c->m->states; i++)
        if (c->solved[i]) c->value[i] = nh_explicit_simple(c, nh_substitute(c->d, c->value[i], 1, &symbol, &value));
    c->value[u] = value;
    c->solved[u] = true;
    for (size_t i = 0; i < c->m->states; i++) c->equation[i].read = false;
    for (size_t j = 0; j < c->currents; j++) c->view[j].read = false;
}

nh_ex nh_explicit_split_roots(nh_explicit_curve *c, nh_ex e)
{
    return nh_square_roots(c->d, e, (size_t)c->options->quadrature_length, nh_explicit_sign, c);
}

bool nh_explicit_room(const nh_explicit_curve *c)
{
    return c->m->constants < most_constants && c->symbols < most_symbols;
}

nh_ex nh_explicit_constant(nh_explicit_curve *c, nh_ex value, bool integrated)
{
    nh_explicit_motion *m = c->m;
    bool at_start = nh_explicit_has_integral(c, value);
    if (integrated) value = nh_explicit_simple(c, in_states(c, value));
    nh_ex symbol = nh_symbol_fresh(c->d, nh_arena_printf(c->arena, "C%zu", m->constants + 1));
    if (integrated) value = nh_explicit_split_roots(c, value);
    m->constant[m->constants++] = (nh_motion_constant){symbol, value, integrated, at_start};
    c->symbol[c->symbols++] = symbol;
    return symbol;
}

bool nh_explicit_vanishes(const nh_explicit_curve *c, nh_ex e)
{
    return nh_normal_is_zero(c->d, e, (size_t)c->options->proof_terms) == NH_ZERO;
}

/* By a value, which is found sooner than a normal form.  False: not known, as where roots are symbols of their own. */
static bool is_nonzero(const nh_explicit_curve *c, nh_ex e, nh_ex u)
{
    for (size_t i = 0; i < c->m->roots; i++)
        if (nh_depends(c->d, e, c->m->root[i].symbol)) return false;
    return nh_generic_nonzero(c->d, 1, &e, 2, (nh_ex[]){u, c->s});
}

int nh_explicit_degree(const nh_explicit_curve *c, nh_ex e, nh_ex u, nh_ex k[3])
{
    nh_dag *d = c->d;
    nh_ex zero = nh_int(d, 0), first = nh_diff(d, e, u), second = nh_diff(d, first, u);
    if (is_nonzero(c, nh_diff(d, second, u), u)) return 3;
    k[2] = nh_explicit_simple(c, nh_mul(d, nh_ratio(d, 1, 2), second));
    if (nh_depends(d, k[2], u) && !nh_explicit_vanishes(c, nh_diff(d, k[2], u))) return 3;
    k[2] = nh_substitute(d, k[2], 1, &u, &zero);
    k[1] = nh_explicit_simple(c, nh_substitute(d, first, 1, &u, &zero));
    k[0] = nh_explicit_simple(c, nh_substitute(d, e, 1, &u, &zero));
    if (!nh_monomials_has_degree(d, e, u)) { /* the third derivative of u |u| vanishes, too; and u/u has a hole */
        nh_ex rest = nh_sub(d, e, nh_add(d, k[0], nh_mul(d, u, nh_add(d, k[1], nh_mul(d, u, k[2])))));
        if (!nh_explicit_vanishes(c, rest)) return 3;
    }
    for (int degree = 2; degree > 0; degree--)
        if (is_nonzero(c, k[degree], u) || !nh_explicit_vanishes(c, k[degree])) return degree;
    return 0;
}

/* ---- from currents ---- */

/* sqrt(Q) as a factor times the root of the radicand of its normal form. */
static bool canonical_root(nh_dag *d, nh_ex Q, nh_ex *factor, nh_ex *base)
{
    nh_ex root = nh_canonical(d, nh_sqrt(d, Q), 0), half = nh_ratio(d, 1, 2);
    *base = 0;
    if (nh_kind_of(d, root) != NH_PRODUCT) return false;
    for (size_t i = 0; i < nh_arity(d, root); i++)
        if (nh_exponent_of(d, root, i) == half && nh_kind_of(d, nh_child(d, root, i)) != NH_NUMBER) {
            if (*base) return false;
            *base = nh_child(d, root, i);
        }
    *factor = *base ? nh_div(d, root, nh_sqrt(d, *base)) : root;
    return *base != 0;
}

/* Does it change along the curve? */
static bool moves(const nh_explicit_curve *c, nh_ex e)
{
    return nh_depends(c->d, e, c->s) || nh_explicit_has_integral(c, e);
}

/* sqrt(Q), whose value in the states is `state`: a constant where Q does not depend on s, in place of the newest one,
 * which Q determines; else a symbol of its own, with its derivative and its square.  0: neither. */
static bool name_root(nh_explicit_curve *c, nh_ex Q, nh_ex state, bool constant, nh_ex *out)
{
    nh_dag *d = c->d;
    nh_explicit_motion *m = c->m;
    nh_motion_constant *newest = &m->constant[m->constants - 1];
    nh_ex k[3], factor, base;
    if (!moves(c, Q) && nh_explicit_degree(c, Q, newest->symbol, k) == 1) {
        newest->value = nh_explicit_simple(c, state);
        *out = newest->symbol;
        return true;
    }
    if (constant || m->roots == most_roots || !canonical_root(d, Q, &factor, &base)) return false;
    nh_ex symbol = nh_symbol_fresh(d, nh_arena_printf(c->arena, "R%zu", m->roots + 1)), plain = base;
    for (size_t i = m->roots; i-- > 0;) {
        nh_ex root = nh_sqrt(d, c->radicand[i]);
        plain = nh_substitute(d, plain, 1, &m->root[i].symbol, &root);
    }
    nh_relate(d, symbol, 2, base);
    nh_diff_rule(d, symbol, c->s, nh_div(d, nh_diff(d, base, c->s), nh_mul(d, nh_int(d, 2), symbol)));
    c->radicand[m->roots] = plain;
    m->root[m->roots++] = (nh_motion_root){symbol, base, nh_explicit_simple(c, nh_div(d, state, in_states(c, factor)))};
    *out = nh_mul(d, factor, symbol);
    return true;
}

/* D = outside^2 * inside without denominators below the root. */
static bool split_root_of(nh_dag *d, nh_ex D, nh_ex *outside, nh_ex *inside)
{
    nh_ex more, rest;
    if (!nh_square_split(d, D, outside, inside)) return false;
    nh_ex N = nh_numerator(d, *inside);
    if (!nh_square_split(d, nh_simplify_short(d, nh_div(d, *inside, N), 0), &more, &rest)) return false;
    *outside = nh_mul(d, *outside, more);
    *inside = nh_mul(d, rest, N);
    return true;
}

/* Q = b (C + e), e a constant: with the root of +-b outside, which has one sign at the points, a constant is left. */
static void take_out_rate(nh_explicit_curve *c, nh_ex C, nh_ex *outside, nh_ex *inside)
{
    nh_dag *d = c->d;
    nh_ex k[3], more, rest;
    if (nh_explicit_degree(c, *inside, C, k) != 1) return;
    nh_ex e = nh_explicit_simple(c, nh_div(d, k[0], k[1]));
    int sign = moves(c, e) ? 0 : nh_explicit_sign(c, k[1]);
    if (!sign || !split_root_of(d, nh_mul(d, nh_int(d, sign), k[1]), &more, &rest)) return;
    *outside = nh_product(d, 3, (nh_ex[]){*outside, more, nh_sqrt(d, rest)});
    *inside = nh_mul(d, nh_int(d, sign), nh_add(d, C, e));
}

/* a u^2 + b u + e = C:  u = (-b + r)/(2 a), r^2 = b^2 - 4 a (e - C); r = 2 a u + b in the states.  `constant_root`:
   only where r is one, but for a factor. */
static bool solve_quadratic(nh_explicit_curve *c, size_t u, const nh_ex k[3], nh_ex current, bool constant_root)
{
    nh_dag *d = c->d;
    nh_ex constant = nh_explicit_constant(c, current, false), two = nh_int(d, 2), inside, outside, r;
    nh_ex D = nh_explicit_simple(
        c, nh_sub(d, nh_powi(d, k[1], 2), nh_product(d, 3, (nh_ex[]){nh_int(d, 4), k[2], nh_sub(d, k[0], constant)})));
    size_t last;
    bool solved = split_root_of(d, D, &outside, &inside) && nh_explicit_unknowns(c, inside, &last) == 0;
    if (solved) take_out_rate(c, constant, &outside, &inside);
    nh_ex state = nh_add(d, nh_product(d, 3, (nh_ex[]){two, k[2], c->m->state[u]}), k[1]);
    solved = solved && name_root(c, inside, in_states(c, nh_div(d, state, outside)), constant_root, &r);
    if (!solved) {
        c->m->constants--;
        c->symbols--;
        return false;
    }
    nh_explicit_settle(c, u,
                       nh_explicit_simple(c, nh_div(d, nh_sub(d, nh_mul(d, outside, r), k[1]), nh_mul(d, two, k[2]))));
    return true;
}

/* Looks for one state of one current that is polynomial in it, with few unsolved states, velocities before positions,
 * short ones first. */
typedef struct {
    size_t current, state;
    double cost;
    const nh_ex *k; /* the coefficients of the polynomial */
} choice;
static const double position = 0.5, symbol = 1e-6;

static nh_explicit_form *form_of(nh_explicit_curve *c, nh_ex e)
{
    nh_explicit_forms *known = c->forms;
    for (size_t i = 0; i < known->count; i++)
        if (known->form[i]->e == e) return known->form[i];
    nh_grow(&known->form, &known->capacity, known->count + 1, sizeof *known->form);
    nh_explicit_form *f = known->form[known->count++] = nh_arena_alloc(c->arena, sizeof *f);
    f->e = e;
    f->in = nh_arena_alloc(c->arena, c->m->states * sizeof *f->in);
    return f;
}

static nh_explicit_view *view(nh_explicit_curve *c, size_t j)
{
    nh_explicit_view *v = &c->view[j];
    size_t last;
    if (v->read) return v;
    v->form = form_of(c, nh_explicit_along(c, c->current[j]));
    v->unknowns = nh_explicit_unknowns(c, v->form->e, &last);
    v->read = true;
    return v;
}

static void consider(nh_explicit_curve *c, size_t j, int degree, size_t most_unknowns, choice *best)
{
    nh_explicit_view *v = view(c, j);
    nh_explicit_form *f = v->form;
    if (v->unknowns == 0) c->used[j] = true;
    if (v->unknowns == 0 || v->unknowns > most_unknowns || nh_explicit_too_long(c, f->e)) return;
    for (size_t u = c->m->states; u-- > 0;) {
        if (c->solved[u] || !nh_depends(c->d, f->e, c->m->state[u])) continue;
        double cost = (double)v->unknowns + (u <= c->o->m) * position + (double)nh_complexity(c->d, f->e) * symbol;
        if (cost >= best->cost) continue;
        if (!f->in[u].degree) f->in[u].degree = nh_explicit_degree(c, f->e, c->m->state[u], f->in[u].k) + 1;
        if (f->in[u].degree == degree + 1) *best = (choice){.current = j, .state = u, .cost = cost, .k = f->in[u].k};
    }
}

/* The easiest state that a current gives with at most so many that are not solved. */
bool nh_explicit_solve_first(nh_explicit_curve *c, size_t most_unknowns)
{
    nh_dag *d = c->d;
    choice best = {.cost = INFINITY};
    for (size_t j = 0; j < c->currents; j++)
        if (!c->used[j]) consider(c, j, 1, most_unknowns, &best);
    if (best.cost == INFINITY || !nh_explicit_room(c)) return false;
    c->used[best.current] = true;
    nh_ex constant = nh_explicit_constant(c, c->current[best.current], false),
          value = nh_div(d, nh_sub(d, constant, best.k[0]), best.k[1]);
    nh_explicit_settle(c, best.state, nh_explicit_simple(c, value));
    return true;
}

/* Other states may be factors of the root, but not below it: a current gives x'^2/cos(h)^2 of a velocity x' = v
 * cos(h). */
bool nh_explicit_solve_second(nh_explicit_curve *c, size_t most_unknowns, bool constant_root)
{
    for (size_t j = 0; j < c->currents && nh_explicit_room(c); j++) {
        choice best = {.cost = INFINITY};
        if (!c->used[j]) consider(c, j, 2, most_unknowns, &best);
        if (best.cost == INFINITY || !solve_quadratic(c, best.state, best.k, c->current[j], constant_root)) continue;
        return c->used[j] = true;
    }
    return false;
}

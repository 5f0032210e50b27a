/* multipliers: how fast a current changes along the motion, in all coordinates with Chetaev multipliers, in ball arithmetic of many digits.
 *
 *     K v' + h + F^T mu = 0,   F v' + g = 0     [docs/method.md, sec. 6]       rate = dPhi/dt + v dPhi/dq + v' dPhi/dv
 *
 * An own evaluation by Arb, its own points, its own linear algebra: no chart, no reduced equations, no proof, no ball of the program has a part in
 * it, only the parser and exact derivatives.  Velocities start near those of the chart and are moved onto the constraints by Newton's method
 * to all digits, so that the points are as accurate as the arithmetic. */
#ifndef NH_TESTS_MULTIPLIERS_H
#define NH_TESTS_MULTIPLIERS_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "evaluate/arb.h"
#include "evaluate/named_value.h"
#undef I /* a name in headers that may follow */
#include "graph/diff.h"
#include "graph/num_long.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/num.h"
#include "integrals/points.h"

/* ---- expressions in ball arithmetic ---- */

/* Values of the nodes of one graph at one point; value[e] counts when epoch[e] is the present one. */
typedef struct {
    nh_dag *dag; /* borrows */
    slong bits;
    size_t size, symbols;
    uint32_t now, *epoch;
    arb_ptr value;
    const nh_ex *symbol;
    arb_srcptr at; /* of the symbols; borrows */
} arb_graph;

static void arb_graph_init(arb_graph *g, nh_dag *dag, slong bits, size_t symbols, const nh_ex *symbol, arb_srcptr at)
{
    *g = (arb_graph){.dag = dag, .bits = bits, .size = nh_dag_size(dag), .symbols = symbols, .symbol = symbol, .at = at, .now = 1};
    g->epoch = calloc(g->size + 1, sizeof *g->epoch);
    g->value = _arb_vec_init((slong)g->size + 1);
}

static void arb_graph_clear(arb_graph *g)
{
    _arb_vec_clear(g->value, (slong)g->size + 1);
    free(g->epoch);
}

static void arb_number(arb_t out, nh_num c, slong bits)
{
    if (!nh_num_exact(c)) {
        arb_set_d(out, c.d);
        return;
    }
    fmpq_t ratio;
    mpq_t v;
    fmpq_init(ratio);
    mpq_init(v);
    nh_num_get_mpq(v, c);
    fmpq_set_mpq(ratio, v);
    arb_set_fmpq(out, ratio, bits);
    mpq_clear(v);
    fmpq_clear(ratio);
}

static arb_srcptr arb_graph_value(arb_graph *g, nh_ex e);

static void arb_sum(arb_graph *g, nh_ex e, arb_t out)
{
    arb_t c;
    arb_init(c);
    arb_number(out, nh_constant_of(g->dag, e), g->bits);
    for (size_t i = 0; i < nh_arity(g->dag, e); i++) {
        arb_number(c, nh_coefficient_of(g->dag, e, i), g->bits);
        arb_addmul(out, c, arb_graph_value(g, nh_child(g->dag, e, i)), g->bits);
    }
    arb_clear(c);
}

static void arb_product(arb_graph *g, nh_ex e, arb_t out)
{
    arb_t power;
    arb_init(power);
    arb_number(out, nh_constant_of(g->dag, e), g->bits);
    for (size_t i = 0; i < nh_arity(g->dag, e); i++) {
        nh_ex exponent = nh_exponent_of(g->dag, e, i);
        nh_num x = nh_kind_of(g->dag, exponent) == NH_NUMBER ? nh_number_of(g->dag, exponent) : nh_num_real(0.1);
        arb_srcptr base = arb_graph_value(g, nh_child(g->dag, e, i));
        if (nh_num_short(x) && x.q == 1 && llabs(x.p) < 1000) {
            arb_pow_ui(power, base, (ulong)llabs(x.p), g->bits);
            if (x.p < 0) arb_inv(power, power, g->bits);
        } else if (nh_num_short(x) && x.q == 2 && llabs(x.p) < 1000) {
            arb_sqrt(power, base, g->bits);
            arb_pow_ui(power, power, (ulong)llabs(x.p), g->bits);
            if (x.p < 0) arb_inv(power, power, g->bits);
        } else {
            arb_pow(power, base, arb_graph_value(g, exponent), g->bits);
        }
        arb_mul(out, out, power, g->bits);
    }
    arb_clear(power);
}

static void arb_function(arb_graph *g, nh_ex e, arb_t out)
{
    slong b = g->bits;
    nh_function f = nh_function_of(g->dag, e);
    arb_srcptr x = f == NH_PI ? NULL : arb_graph_value(g, nh_child(g->dag, e, 0));
    switch (f) {
    case NH_SIN: arb_sin(out, x, b); break;
    case NH_COS: arb_cos(out, x, b); break;
    case NH_TAN: arb_tan(out, x, b); break;
    case NH_ASIN: arb_asin(out, x, b); break;
    case NH_ACOS: arb_acos(out, x, b); break;
    case NH_ATAN: arb_atan(out, x, b); break;
    case NH_SINH: arb_sinh(out, x, b); break;
    case NH_COSH: arb_cosh(out, x, b); break;
    case NH_TANH: arb_tanh(out, x, b); break;
    case NH_ASINH: arb_asinh(out, x, b); break;
    case NH_ACOSH: arb_acosh(out, x, b); break;
    case NH_ATANH: arb_atanh(out, x, b); break;
    case NH_EXP: arb_exp(out, x, b); break;
    case NH_LOG: arb_log(out, x, b); break;
    case NH_ABS: arb_abs(out, x); break;
    case NH_SIGN: arb_sgn(out, x); break;
    case NH_ATAN2: arb_atan2(out, x, arb_graph_value(g, nh_child(g->dag, e, 1)), b); break;
    case NH_PI: arb_const_pi(out, b); break;
    default: { /* Legendre's, Bessel's, ..: a wrong value would not satisfy the equation that their derivatives know */
        arb_ptr all = _arb_vec_init((slong)nh_arity(g->dag, e));
        for (size_t i = 0; i < nh_arity(g->dag, e); i++) arb_set(all + i, arb_graph_value(g, nh_child(g->dag, e, i)));
        nh_named_value_ball(f, all, out, b);
        _arb_vec_clear(all, (slong)nh_arity(g->dag, e));
    }
    }
}

/* The value of a node; not finite where it is undefined or a symbol has no value. */
static arb_srcptr arb_graph_value(arb_graph *g, nh_ex e)
{
    arb_ptr out = g->value + e;
    if (g->epoch[e] == g->now) return out;
    g->epoch[e] = g->now;
    switch (nh_kind_of(g->dag, e)) {
    case NH_NUMBER: arb_number(out, nh_number_of(g->dag, e), g->bits); break;
    case NH_SUM: arb_sum(g, e, out); break;
    case NH_PRODUCT: arb_product(g, e, out); break;
    case NH_FUNCTION: arb_function(g, e, out); break;
    default:
        arb_indeterminate(out);
        for (size_t i = 0; i < g->symbols; i++)
            if (g->symbol[i] == e) arb_set(out, g->at + i);
    }
    return out;
}

/* ---- the motion at points ---- */

/* Per point t, q, v and their rates 1, v, v'; the symbols are those and the parameters. */
typedef struct {
    const nh_model *model; /* borrows */
    slong bits;
    size_t m, k, points, capacity, symbols;
    bool exact;            /* no number of the equations was too long for an exact one: then rates have all digits, else those of doubles */
    nh_ex *symbol;
    arb_ptr state, change; /* points x symbols */
} multiplier_motion;

/* A parameter's double stands for the shortest decimal that reads as it. */
static void arb_decimal(arb_t out, double value, slong bits)
{
    char text[40];
    snprintf(text, sizeof text, "%.15g", value);
    if (strtod(text, NULL) != value || arb_set_str(out, text, bits)) arb_set_d(out, value);
}

static bool arb_small(const arb_t x, slong bits)
{
    arb_t bound;
    arb_init(bound);
    arb_one(bound);
    arb_mul_2exp_si(bound, bound, -bits);
    bool small = arb_is_finite(x);
    arb_t size;
    arb_init(size);
    arb_abs(size, x);
    small = small && arb_lt(size, bound);
    arb_clear(size);
    arb_clear(bound);
    return small;
}

/* One Newton step of least length onto f = 0; true when f was zero to three quarters of the digits. */
static bool onto_constraints(const multiplier_motion *o, arb_graph *g, const nh_ex *f, const nh_ex *F, arb_ptr v, bool *good)
{
    size_t m = o->m, k = o->k;
    bool there = true;
    arb_mat_t A, At, S, y, step;
    arb_mat_init(A, (slong)k, (slong)m);
    arb_mat_init(At, (slong)m, (slong)k);
    arb_mat_init(S, (slong)k, (slong)k);
    arb_mat_init(y, (slong)k, 1);
    arb_mat_init(step, (slong)m, 1);
    for (size_t a = 0; a < k; a++) {
        arb_set(arb_mat_entry(y, (slong)a, 0), arb_graph_value(g, f[a]));
        there &= arb_small(arb_mat_entry(y, (slong)a, 0), 3 * o->bits / 4);
        for (size_t s = 0; s < m; s++) arb_set(arb_mat_entry(A, (slong)a, (slong)s), arb_graph_value(g, F[a * m + s]));
    }
    arb_mat_transpose(At, A);
    arb_mat_mul(S, A, At, o->bits);
    *good = arb_mat_solve(y, S, y, o->bits);
    arb_mat_mul(step, At, y, o->bits);
    for (size_t s = 0; s < m && *good && !there; s++) {
        arb_sub(v + s, v + s, arb_mat_entry(step, (slong)s, 0), o->bits);
        arb_get_mid_arb(v + s, v + s);
    }
    arb_mat_clear(A);
    arb_mat_clear(At);
    arb_mat_clear(S);
    arb_mat_clear(y);
    arb_mat_clear(step);
    g->now++;
    return there;
}

/* The bordered system at the graph's point: accelerations into `a` (m).  False where it is singular. */
static bool accelerations(const multiplier_motion *o, arb_graph *g, const nh_ex *K, const nh_ex *h, const nh_ex *F, const nh_ex *c, arb_ptr a)
{
    slong m = (slong)o->m, n = m + (slong)o->k;
    arb_mat_t A, b;
    arb_mat_init(A, n, n);
    arb_mat_init(b, n, 1);
    for (slong i = 0; i < m; i++) {
        for (slong j = 0; j < m; j++) arb_set(arb_mat_entry(A, i, j), arb_graph_value(g, K[i * m + j]));
        arb_neg(arb_mat_entry(b, i, 0), arb_graph_value(g, h[i]));
        for (slong r = m; r < n; r++) {
            arb_set(arb_mat_entry(A, r, i), arb_graph_value(g, F[(r - m) * m + i]));
            arb_set(arb_mat_entry(A, i, r), arb_mat_entry(A, r, i));
        }
    }
    for (slong r = m; r < n; r++) arb_neg(arb_mat_entry(b, r, 0), arb_graph_value(g, c[r - m]));
    bool regular = arb_mat_solve(b, A, b, o->bits);
    for (slong i = 0; i < m; i++) {
        arb_set(a + i, arb_mat_entry(b, i, 0));
        regular = regular && arb_is_finite(a + i);
    }
    arb_mat_clear(A);
    arb_mat_clear(b);
    return regular;
}

/* K, h, F, c (with F v' + c = 0) and f, as expressions of t, q, v. */
static void multiplier_equations(const nh_model *o, nh_ex *K, nh_ex *h, nh_ex *F, nh_ex *c, nh_ex *f)
{
    const nh_system *y = o->system;
    nh_dag *d = o->dag;
    size_t m = o->m;
    for (size_t s = 0; s < m; s++) {
        nh_ex p = nh_diff(d, y->lagrangian, y->coordinate[s].v);
        h[s] = nh_sub(d, nh_diff(d, p, y->t), nh_add(d, nh_diff(d, y->lagrangian, y->coordinate[s].q), y->force[s]));
        for (size_t r = 0; r < m; r++) {
            K[s * m + r] = nh_diff(d, p, y->coordinate[r].v);
            h[s] = nh_add(d, h[s], nh_mul(d, y->coordinate[r].v, nh_diff(d, p, y->coordinate[r].q)));
        }
    }
    for (size_t a = 0; a < o->k; a++) {
        f[a] = nh_sub(d, y->constraint[a].lhs, y->constraint[a].rhs);
        c[a] = nh_diff(d, f[a], y->t);
        for (size_t s = 0; s < m; s++) {
            F[a * m + s] = nh_diff(d, f[a], y->coordinate[s].v);
            c[a] = nh_add(d, c[a], nh_mul(d, y->coordinate[s].v, nh_diff(d, f[a], y->coordinate[s].q)));
        }
    }
}

/* The motion at those of the points where it is regular. */
static multiplier_motion *multiplier_motion_create(const nh_model *model, const nh_points *at, slong bits)
{
    enum { most_steps = 20 };
    const nh_system *y = model->system;
    size_t m = model->m, k = model->k, p = y->parameters;
    multiplier_motion *o = nh_alloc(sizeof *o);
    *o = (multiplier_motion){.model = model, .bits = bits, .m = m, .k = k, .capacity = at->count, .symbols = 1 + 2 * m + p};
    o->symbol = nh_alloc_array(o->symbols, sizeof *o->symbol);
    o->state = _arb_vec_init((slong)(at->count * o->symbols));
    o->change = _arb_vec_init((slong)(at->count * o->symbols));
    o->symbol[0] = y->t;
    for (size_t s = 0; s < m; s++) o->symbol[1 + s] = y->coordinate[s].q, o->symbol[1 + m + s] = y->coordinate[s].v;
    for (size_t i = 0; i < p; i++) o->symbol[1 + 2 * m + i] = model->parameter[i];
    nh_ex *K = nh_alloc_array(m * m + m + 2 * k + k * m, sizeof *K), *h = K + m * m, *F = h + m, *c = F + k * m, *f = c + k;
    multiplier_equations(model, K, h, F, c, f);
    o->exact = true;
    for (nh_ex *e = K; e < f + k; e++) o->exact = o->exact && nh_is_exact(model->dag, *e);
    double *v = nh_alloc_array(m * at->count, sizeof *v);
    nh_points_evaluate(at, model, m, model->rho, v);
    arb_graph g;
    arb_graph_init(&g, model->dag, bits, o->symbols, o->symbol, NULL);
    for (size_t i = 0; i < at->count; i++) {
        arb_ptr z = o->state + o->points * o->symbols, rate = o->change + o->points * o->symbols;
        for (size_t j = 0; j <= m; j++) arb_set_d(z + j, at->column[j][i]);
        for (size_t s = 0; s < m; s++) arb_set_d(z + 1 + m + s, v[s * at->count + i]);
        for (size_t j = 0; j < p; j++) arb_decimal(z + 1 + 2 * m + j, model->parameter_value[j], bits);
        g.at = z;
        g.now++;
        bool there = k == 0, good = true;
        for (int step = 0; step < most_steps && good && !there; step++) there = onto_constraints(o, &g, f, F, z + 1 + m, &good);
        if (!there || !good || !accelerations(o, &g, K, h, F, c, rate + 1 + m)) continue;
        arb_one(rate);
        for (size_t s = 0; s < m; s++) arb_set(rate + 1 + s, z + 1 + m + s);
        o->points++;
    }
    arb_graph_clear(&g);
    nh_free(v);
    nh_free(K);
    return o;
}

static void multiplier_motion_free(multiplier_motion *o)
{
    if (!o) return;
    _arb_vec_clear(o->state, (slong)(o->capacity * o->symbols));
    _arb_vec_clear(o->change, (slong)(o->capacity * o->symbols));
    nh_free(o->symbol);
    nh_free(o);
}

/* ---- rates ---- */

/* 10-logarithms of what the relative rate is at most and at least, the worst over the points that could be evaluated.  Relative to the slopes of
 * Phi times the speed of the state: an acceleration may be zero up to rounding. */
typedef struct {
    size_t points;
    bool exact; /* equations and Phi; else only the digits of doubles mean anything */
    double upper, lower;
} multiplier_rate;

static double arb_log10(const arf_t x)
{
    arf_t mantissa;
    fmpz_t exponent;
    if (arf_is_zero(x)) return -INFINITY;
    arf_init(mantissa);
    fmpz_init(exponent);
    arf_frexp(mantissa, exponent, x);
    double value = log10(fabs(arf_get_d(mantissa, ARF_RND_NEAR))) + fmpz_get_d(exponent) * log10(2);
    arf_clear(mantissa);
    fmpz_clear(exponent);
    return value;
}

static void add_rate(const multiplier_motion *o, arb_graph *g, const nh_ex *slope, arb_srcptr change, multiplier_rate *worst)
{
    size_t n = 1 + 2 * o->m;
    arb_t sum, size, slopes, speed;
    arf_t bound;
    arb_init(sum);
    arb_init(size);
    arb_init(slopes);
    arb_init(speed);
    arf_init(bound);
    arb_one(speed);
    for (size_t j = 0; j < n; j++) {
        arb_srcptr d = arb_graph_value(g, slope[j]);
        arb_addmul(sum, d, change + j, o->bits);
        arb_abs(size, d);
        arb_add(slopes, slopes, size, o->bits);
        arb_abs(size, change + j);
        arb_max(speed, speed, size, o->bits);
    }
    arb_mul(size, slopes, speed, o->bits);
    if (arb_is_zero(slopes)) arb_zero(sum), arb_one(size);
    arb_div(sum, sum, size, o->bits);
    if (arb_is_finite(sum)) {
        worst->points++;
        arb_get_abs_ubound_arf(bound, sum, 64);
        worst->upper = fmax(worst->upper, arb_log10(bound));
        arb_get_abs_lbound_arf(bound, sum, 64);
        worst->lower = fmax(worst->lower, arb_log10(bound));
    }
    arf_clear(bound);
    arb_clear(sum);
    arb_clear(size);
    arb_clear(slopes);
    arb_clear(speed);
}

/* Of a function of t, q, v and parameters. */
static multiplier_rate multiplier_rate_of(const multiplier_motion *o, nh_ex phi)
{
    size_t n = 1 + 2 * o->m;
    nh_dag *d = o->model->dag;
    multiplier_rate worst = {.exact = o->exact, .upper = -INFINITY, .lower = -INFINITY};
    nh_ex *slope = nh_alloc_array(n, sizeof *slope);
    for (size_t j = 0; j < n; j++) {
        slope[j] = nh_diff(d, phi, o->symbol[j]);
        worst.exact = worst.exact && nh_is_exact(d, slope[j]);
    }
    arb_graph g;
    arb_graph_init(&g, d, o->bits, o->symbols, o->symbol, NULL);
    for (size_t i = 0; i < o->points; i++) {
        g.at = o->state + i * o->symbols;
        g.now++;
        add_rate(o, &g, slope, o->change + i * o->symbols, &worst);
    }
    arb_graph_clear(&g);
    nh_free(slope);
    return worst;
}

#endif

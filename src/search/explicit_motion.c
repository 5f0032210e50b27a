#include "search/explicit_motion.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/budget.h"
#include "exact/antiderivative.h"
#include "exact/normal.h"
#include "exact/square.h"
#include "graph/diff.h"
#include "graph/measure.h"
#include "integrals/exact_points.h"
#include "integrals/fixed.h"
#include "integrals/prove.h"

enum { most_constants = 24, most_roots = 4, most_symbols = 60 };

typedef struct {
    nh_arena *arena;
    const nh_model *o;
    nh_dag *d;
    const nh_points *points;
    const nh_options *options;
    const bool *fixed;
    nh_explicit_motion *m;
    nh_ex s, *rate, *value;     /* of every state: its rate; its value in s, the constants, the roots and the states that are not solved */
    bool *solved;
    nh_ex *refused;             /* per state: du/ds that could not be integrated; 0: none */
    size_t currents;
    nh_ex *current;
    bool *used;
    size_t symbols;             /* parameters of the system, then the constants */
    nh_ex symbol[most_symbols];
    nh_ex radicand[most_roots]; /* of the roots, with the earlier ones written as such */
} curve;

/* ---- expressions along the curve and in the states ---- */

static nh_ex simple(const curve *c, nh_ex e) { return nh_simplify_short(c->d, e, (size_t)c->options->quadrature_length); }

static bool too_long(const curve *c, nh_ex e) { return nh_complexity(c->d, e) > (size_t)c->options->quadrature_length; }

/* With what is solved. */
static nh_ex along(const curve *c, nh_ex e)
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

/* In the states alone. */
static nh_ex in_states(const curve *c, nh_ex e)
{
    const nh_explicit_motion *m = c->m;
    for (size_t i = m->roots; i-- > 0;) e = nh_substitute(c->d, e, 1, &m->root[i].symbol, &m->root[i].value);
    for (size_t i = m->constants; i-- > 0;) e = nh_substitute(c->d, e, 1, &m->constant[i].symbol, &m->constant[i].value);
    return e;
}

/* The same sign at all points? */
static int sign_at_points(void *context, nh_ex e)
{
    const curve *c = context;
    double *value = nh_alloc_array(c->points->count + 1, sizeof *value);
    nh_ex here = e;
    for (size_t i = c->m->roots; i-- > 0;) here = nh_substitute_root(c->d, here, c->radicand[i], c->m->root[i].symbol);
    here = in_states(c, here);
    bool above = false, below = false;
    nh_points_evaluate(c->points, c->o, 1, &here, value);
    for (size_t p = 0; p < c->points->count; p++) {
        above |= value[p] > 0;
        below |= value[p] < 0;
    }
    nh_free(value);
    return above == below ? 0 : above ? 1 : -1;
}

/* How many states that are not solved e depends on; the last of them. */
static size_t unknowns(const curve *c, nh_ex e, size_t *last)
{
    size_t n = 0;
    for (size_t i = 0; i < c->m->states; i++)
        if (!c->solved[i] && nh_depends(c->d, e, c->m->state[i])) *last = i, n++;
    return n;
}

static void settle(curve *c, size_t u, nh_ex value)
{
    nh_ex symbol = c->m->state[u];
    for (size_t i = 0; i < c->m->states; i++)
        if (c->solved[i]) c->value[i] = simple(c, nh_substitute(c->d, c->value[i], 1, &symbol, &value));
    c->value[u] = value;
    c->solved[u] = true;
    memset(c->refused, 0, c->m->states * sizeof *c->refused);
}

static nh_ex with_split_roots(curve *c, nh_ex e) { return nh_square_roots(c->d, e, (size_t)c->options->quadrature_length, sign_at_points, c); }

static bool room(const curve *c) { return c->m->constants < most_constants && c->symbols < most_symbols; }

/* C1, C2, ... */
static nh_ex new_constant(curve *c, nh_ex value, bool integrated)
{
    nh_explicit_motion *m = c->m;
    nh_ex symbol = nh_symbol_fresh(c->d, nh_arena_printf(c->arena, "C%zu", m->constants + 1));
    if (integrated) value = with_split_roots(c, value);
    m->constant[m->constants++] = (nh_motion_constant){symbol, value, integrated};
    c->symbol[c->symbols++] = symbol;
    return symbol;
}

/* ---- from currents ---- */

static bool vanishes(const curve *c, nh_ex e) { return nh_normal_is_zero(c->d, e, (size_t)c->options->proof_terms) == NH_ZERO; }

/* The degree of a polynomial in u, at most two; 3 otherwise. */
static int degree_in(const curve *c, nh_ex e, nh_ex u, nh_ex k[3])
{
    nh_dag *d = c->d;
    nh_ex zero = nh_int(d, 0), first = nh_diff(d, e, u), second = nh_diff(d, first, u);
    k[2] = simple(c, nh_mul(d, nh_ratio(d, 1, 2), second));
    if (nh_depends(d, k[2], u) && !vanishes(c, nh_diff(d, k[2], u))) return 3;
    k[2] = nh_substitute(d, k[2], 1, &u, &zero);
    k[1] = simple(c, nh_substitute(d, first, 1, &u, &zero));
    k[0] = simple(c, nh_substitute(d, e, 1, &u, &zero));
    nh_ex rest = nh_sub(d, e, nh_add(d, k[0], nh_mul(d, u, nh_add(d, k[1], nh_mul(d, u, k[2]))))); /* u |u| has a third derivative that vanishes, too */
    return !vanishes(c, rest) ? 3 : !vanishes(c, k[2]) ? 2 : !vanishes(c, k[1]) ? 1 : 0;
}

/* sqrt(Q) as a factor times the root of what normal forms have below it. */
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

/* sqrt(Q), whose value in the states is `state`: a constant where Q does not depend on s, in place of the newest one, which Q determines; else a symbol of its
 * own, with its derivative and its square.  0: neither. */
static bool name_root(curve *c, nh_ex Q, nh_ex state, bool constant, nh_ex *out)
{
    nh_dag *d = c->d;
    nh_explicit_motion *m = c->m;
    nh_motion_constant *newest = &m->constant[m->constants - 1];
    nh_ex k[3], factor, base;
    if (!nh_depends(d, Q, c->s) && degree_in(c, Q, newest->symbol, k) == 1) {
        newest->value = simple(c, state);
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
    m->root[m->roots++] = (nh_motion_root){symbol, base, simple(c, nh_div(d, state, in_states(c, factor)))};
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
static void take_out_rate(curve *c, nh_ex C, nh_ex *outside, nh_ex *inside)
{
    nh_dag *d = c->d;
    nh_ex k[3], more, rest;
    if (degree_in(c, *inside, C, k) != 1) return;
    nh_ex e = simple(c, nh_div(d, k[0], k[1]));
    int sign = nh_depends(d, e, c->s) ? 0 : sign_at_points(c, k[1]);
    if (!sign || !split_root_of(d, nh_mul(d, nh_int(d, sign), k[1]), &more, &rest)) return;
    *outside = nh_product(d, 3, (nh_ex[]){*outside, more, nh_sqrt(d, rest)});
    *inside = nh_mul(d, nh_int(d, sign), nh_add(d, C, e));
}

/* a u^2 + b u + e = C:  u = (-b + r)/(2 a), r^2 = b^2 - 4 a (e - C); r = 2 a u + b in the states.  `constant_root`: only where r is one, but for a factor. */
static bool solve_quadratic(curve *c, size_t u, const nh_ex k[3], nh_ex current, bool constant_root)
{
    nh_dag *d = c->d;
    nh_ex constant = new_constant(c, current, false), two = nh_int(d, 2), inside, outside, r;
    nh_ex D = simple(c, nh_sub(d, nh_powi(d, k[1], 2), nh_product(d, 3, (nh_ex[]){nh_int(d, 4), k[2], nh_sub(d, k[0], constant)})));
    size_t last;
    bool solved = split_root_of(d, D, &outside, &inside) && unknowns(c, inside, &last) == 0;
    if (solved) take_out_rate(c, constant, &outside, &inside);
    nh_ex state = nh_add(d, nh_product(d, 3, (nh_ex[]){two, k[2], c->m->state[u]}), k[1]);
    solved = solved && name_root(c, inside, in_states(c, nh_div(d, state, outside)), constant_root, &r);
    if (!solved) {
        c->m->constants--;
        c->symbols--;
        return false;
    }
    settle(c, u, simple(c, nh_div(d, nh_sub(d, nh_mul(d, outside, r), k[1]), nh_mul(d, two, k[2]))));
    return true;
}

/* One state of one current, a polynomial in it; few states that are not solved, velocities before positions, short ones. */
typedef struct {
    size_t current, state;
    double cost;
    nh_ex k[3];
} choice;
static const double position = 0.5, symbol = 1e-6;

static void consider(curve *c, size_t j, int degree, size_t most_unknowns, choice *best)
{
    nh_ex e = along(c, c->current[j]);
    size_t last = 0, n = unknowns(c, e, &last);
    if (n == 0) c->used[j] = true;
    if (n == 0 || n > most_unknowns || too_long(c, e)) return;
    for (size_t u = c->m->states; u-- > 0;) {
        if (c->solved[u] || !nh_depends(c->d, e, c->m->state[u])) continue;
        choice this = {.current = j, .state = u};
        if (degree_in(c, e, c->m->state[u], this.k) != degree) continue;
        this.cost = (double)n + (u <= c->o->m) * position + (double)nh_complexity(c->d, e) * symbol;
        if (this.cost < best->cost) *best = this;
    }
}

/* The easiest state that a current gives with at most so many that are not solved. */
static bool solve_first(curve *c, size_t most_unknowns)
{
    nh_dag *d = c->d;
    choice best = {.cost = INFINITY};
    for (size_t j = 0; j < c->currents; j++)
        if (!c->used[j]) consider(c, j, 1, most_unknowns, &best);
    if (best.cost == INFINITY || !room(c)) return false;
    c->used[best.current] = true;
    nh_ex constant = new_constant(c, c->current[best.current], false);
    settle(c, best.state, simple(c, nh_div(d, nh_sub(d, constant, best.k[0]), best.k[1])));
    return true;
}

/* Other states may stand before the root, not below it: x'^2/cos(h)^2 is what is given of a velocity x' = v cos(h). */
static bool solve_second(curve *c, size_t most_unknowns, bool constant_root)
{
    for (size_t j = 0; j < c->currents && room(c); j++) {
        choice best = {.cost = INFINITY};
        if (!c->used[j]) consider(c, j, 2, most_unknowns, &best);
        if (best.cost == INFINITY || !solve_quadratic(c, best.state, best.k, c->current[j], constant_root)) continue;
        return c->used[j] = true;
    }
    return false;
}

/* ---- by integration ---- */

/* int f ds, in which roots are written as such. */
static bool integrate(curve *c, nh_ex f, nh_ex *F)
{
    nh_dag *d = c->d;
    const nh_explicit_motion *m = c->m;
    for (size_t i = m->roots; i-- > 0;) {
        nh_ex root = nh_sqrt(d, c->radicand[i]);
        f = nh_substitute(d, f, 1, &m->root[i].symbol, &root);
    }
    nh_integration in = {.dag = d, .x = c->s, .constants = c->symbols, .constant = c->symbol, .max_terms = (size_t)c->options->proof_terms, .sign = sign_at_points, .context = c};
    if (!nh_antiderivative(&in, f, F)) return false;
    for (size_t i = m->roots; i-- > 0;) *F = nh_substitute_root(d, *F, c->radicand[i], m->root[i].symbol);
    return true;
}

/* exp(-I) up to a constant factor, so that |p| may be p in logarithms: exp(log(p^2)/2) is p; atanh f is (log(1 + f) - log(1 - f))/2. */
static nh_ex factor_of(curve *c, nh_ex I)
{
    enum { most = 16 };
    nh_dag *d = c->d;
    nh_ex call[most], by[most], one = nh_int(d, 1);
    size_t n = nh_functions_in(d, I, call, most), known = 0;
    for (size_t i = 0; i < n && n <= most; i++) {
        nh_function f = nh_function_of(d, call[i]);
        nh_ex p = f == NH_LOG || f == NH_ATANH ? nh_child(d, call[i], 0) : 0;
        bool square = f == NH_LOG && nh_kind_of(d, p) == NH_PRODUCT && nh_arity(d, p) == 1 && nh_is_number(d, nh_exponent_of(d, p, 0), 2) && nh_num_is(nh_constant_of(d, p), 1);
        if (square) by[known] = nh_mul(d, nh_int(d, 2), nh_call(d, NH_LOG, nh_child(d, p, 0)));
        else if (f == NH_ATANH) by[known] = nh_mul(d, nh_ratio(d, 1, 2), nh_sub(d, nh_call(d, NH_LOG, nh_add(d, one, p)), nh_call(d, NH_LOG, nh_sub(d, one, p))));
        else continue;
        call[known++] = call[i];
    }
    return nh_canonical(d, nh_call(d, NH_EXP, nh_neg(d, nh_substitute(d, I, known, call, by))), 0);
}

/* du/ds = A u + B */
static bool solve_linear(curve *c, size_t u, nh_ex A, nh_ex B)
{
    nh_dag *d = c->d;
    nh_ex I = nh_int(d, 0), G, mu;
    if (!nh_is_zero(d, A) && !integrate(c, A, &I)) return false;
    mu = factor_of(c, I);
    if (!integrate(c, nh_mul(d, mu, B), &G)) return false;
    nh_ex constant = new_constant(c, simple(c, in_states(c, nh_sub(d, nh_mul(d, mu, c->m->state[u]), G))), true);
    settle(c, u, simple(c, nh_div(d, nh_add(d, constant, G), mu)));
    return true;
}

/* A state with du/ds = A u + B. */
typedef struct {
    size_t state, length;
    nh_ex r, A, B;
} equation;

static size_t equations(curve *c, equation *out)
{
    nh_ex speed = along(c, c->rate[c->m->parameter]), k[3];
    size_t count = 0;
    for (size_t u = 0; u < c->m->states && !too_long(c, speed); u++) {
        nh_ex own = along(c, c->rate[u]);
        if (c->solved[u] || too_long(c, own)) continue;
        nh_ex r = with_split_roots(c, simple(c, nh_div(c->d, own, speed)));
        size_t last = u, n = unknowns(c, r, &last);
        if (r == c->refused[u] || n > 1 || last != u || too_long(c, r) || degree_in(c, r, c->m->state[u], k) > 1) continue;
        out[count++] = (equation){u, nh_complexity(c->d, r), r, k[1], k[0]};
    }
    return count;
}

static int by_length(const void *left, const void *right)
{
    const equation *a = left, *b = right;
    return a->length != b->length ? (a->length < b->length ? -1 : 1) : a->state < b->state ? -1 : a->state > b->state;
}

/* The shortest first. */
static bool solve_rate(curve *c)
{
    equation *list = nh_alloc_array(c->m->states + 1, sizeof *list);
    size_t count = equations(c, list);
    bool solved = false;
    qsort(list, count, sizeof *list, by_length);
    for (size_t i = 0; i < count && !solved && room(c); i++) {
        solved = solve_linear(c, list[i].state, list[i].A, list[i].B);
        if (!solved) c->refused[list[i].state] = list[i].r;
    }
    nh_free(list);
    return solved;
}

/* ---- the whole ---- */

static void start(curve *c, size_t n, const nh_ex *current)
{
    const nh_model *o = c->o;
    nh_dag *d = c->d;
    nh_explicit_motion *m = c->m;
    size_t states = m->states;
    nh_ex *state = nh_arena_alloc(c->arena, states * sizeof *state);
    memcpy(state, o->chart->symbol, states * sizeof *state);
    m->state = state;
    c->rate = nh_arena_alloc(c->arena, states * sizeof *c->rate);
    c->value = nh_arena_alloc(c->arena, states * sizeof *c->value);
    c->refused = nh_arena_alloc(c->arena, states * sizeof *c->refused);
    c->solved = nh_arena_alloc(c->arena, states * sizeof *c->solved);
    c->current = nh_arena_alloc(c->arena, (n + 1) * sizeof *c->current);
    c->used = nh_arena_alloc(c->arena, (n + 1) * sizeof *c->used);
    m->constant = nh_arena_alloc(c->arena, most_constants * sizeof *m->constant);
    m->root = nh_arena_alloc(c->arena, most_roots * sizeof *m->root);
    for (size_t i = 0; i < states; i++) {
        nh_ex rate = i == 0 ? nh_int(d, 1) : i <= o->m ? o->rho[i - 1] : o->a[i - 1 - o->m];
        c->rate[i] = c->fixed ? nh_fixed_values(o, c->fixed, rate) : rate;
        c->value[i] = nh_int(d, 0);
    }
    c->currents = n;
    for (size_t j = 0; j < n; j++) c->current[j] = c->fixed ? nh_fixed_values(o, c->fixed, current[j]) : current[j];
    for (size_t i = 0; i < o->system->parameters && c->symbols < most_symbols - most_constants; i++) c->symbol[c->symbols++] = o->parameter[i];
    c->s = state[m->parameter];
    c->solved[m->parameter] = true;
    c->value[m->parameter] = c->s;
}

/* With the constants that the state has, is the formula the state itself? */
static bool agrees(const curve *c, size_t i)
{
    static const double rounding = 1e-6;
    nh_ex pair[2] = {in_states(c, c->value[i]), c->m->state[i]};
    size_t count = c->points->count, compared = 0;
    double *value = nh_alloc_array(2 * count + 1, sizeof *value), off = 0, size = 0;
    nh_points_evaluate(c->points, c->o, 2, pair, value);
    for (size_t p = 0; p < count; p++) {
        if (!isfinite(value[p])) continue;
        compared++;
        off = fmax(off, fabs(value[p] - value[count + p]));
        size = fmax(size, fabs(value[count + p]));
    }
    nh_free(value);
    return off <= rounding * size && 2 * compared > count;
}

/* What still depends on states that are not solved is not known.  A constant that is none, to all digits, ends it all. */
static void conclude(curve *c)
{
    nh_explicit_motion *m = c->m;
    bool *known = nh_arena_alloc(c->arena, m->states * sizeof *known), constant = true;
    for (size_t j = 0; j < m->constants && constant; j++) {
        nh_ex rate = nh_model_gamma(c->o, m->constant[j].value);
        constant = nh_is_zero(c->d, rate) || nh_prove_digits(c->o, m->constant[j].value, c->options) >= c->options->digits || vanishes(c, nh_exact_values(c->o, rate));
    }
    for (size_t i = 0; i < m->states; i++) {
        size_t last;
        known[i] = i == m->parameter || (constant && c->solved[i] && unknowns(c, c->value[i], &last) == 0 && agrees(c, i));
        m->known += known[i];
    }
    if (!constant) m->constants = 0;
    m->is_known = known;
    m->value = c->value;
}

nh_explicit_motion *nh_explicit_motion_along(nh_arena *arena, const nh_model *o, const nh_points *points, size_t parameter, const bool *fixed, size_t n, const nh_ex *current,
                                             const nh_options *options)
{
    enum { pair = 2 };
    curve c = {.arena = arena, .o = o, .d = o->dag, .points = points, .options = options, .fixed = fixed};
    c.m = nh_arena_alloc(arena, sizeof *c.m);
    *c.m = (nh_explicit_motion){.states = 1 + o->m + o->n, .parameter = parameter, .fixed = fixed};
    start(&c, n, current);
    if (nh_is_zero(c.d, c.rate[parameter])) return NULL;
    bool more = true;
    while (more && !nh_budget_spent())
        more = solve_first(&c, 1) || solve_second(&c, 1, true) || solve_rate(&c) || solve_second(&c, 1, false) || solve_first(&c, pair) || solve_second(&c, pair, false);
    conclude(&c);
    return c.m;
}

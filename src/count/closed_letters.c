/* closed_letters: bases of powers with their exponents, angles and exponents of the Lagrangian, the equations of
 * motion and the determinant of the inertia.
 *
 *     take_expression    Lbar, rho, M, A in canonical form: functions and powers with their lowest exponents
 *     take_determinant   factors of det M, with half powers
 *     take_roots         roots of the inertia's diagonal
 *     take_rates         waves and exponentials along cyclic coordinates and t (construct_rates.h)
 *     take_potential     highest powers: up to these a power costs as much as a coordinate */
#include "count/closed_words.h"

#include <math.h>

#include "exact/kernel.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/num.h"
#include "graph/terms.h"

enum { largest_form = 2000, largest_inertia = 4, least_down = 1 };

/* ---- the list ---- */

/* The letter of this kind and base; a new one has whole powers only. */
static nh_letter *letter_of(nh_closed_letters *l, nh_letter_kind kind, nh_ex base)
{
    for (size_t i = 0; i < l->count; i++)
        if (l->item[i].kind == kind && l->item[i].base == base) return &l->item[i];
    nh_grow(&l->item, &l->capacity, l->count + 1, sizeof *l->item);
    l->item[l->count] = (nh_letter){.kind = kind, .base = base, .root = 1, .up = 1};
    return &l->item[l->count++];
}

static bool is_coordinate(const nh_jet_equations *x, nh_ex symbol)
{
    bool found = false;
    for (size_t k = 0; k < x->coordinates; k++) found |= x->coordinate[k] == symbol;
    return found;
}

/* Does it depend on coordinates of the equations, on nothing else, and on no velocity? */
static bool of_position(const nh_jet_equations *x, nh_ex e)
{
    bool position = false, velocity = false;
    for (size_t k = 0; k < x->coordinates; k++) position |= nh_depends(x->dag, e, x->coordinate[k]);
    for (size_t s = 0; s < x->model->m; s++) {
        nh_ex q = x->model->system->coordinate[s].q;
        if (nh_depends(x->dag, e, q) && !is_coordinate(x, q)) return false;
    }
    for (size_t i = 0; i < x->n; i++) velocity |= nh_depends(x->dag, e, x->w[i]);
    return position && !velocity;
}

/* ---- sines, cosines, exponentials ---- */

/* A unit of which both numbers are multiples. */
static nh_num common(nh_num a, nh_num b)
{
    int64_t q = a.q / nh_gcd(a.q, b.q) * b.q;
    return nh_num_ratio(nh_gcd(a.p * (q / a.q), b.p * (q / b.q)), q);
}

/* The letter for an argument: an existing letter of a rational multiple is given a smaller unit. */
static nh_letter *direction(nh_dag *d, nh_closed_letters *l, nh_letter_kind kind, nh_ex argument, double *sign)
{
    nh_parts whole;
    nh_parts_make(d, true, argument, &whole);
    nh_letter *found = NULL;
    *sign = 1;
    if (whole.count == 1 && nh_num_short(whole.item[0].coefficient) && whole.item[0].coefficient.p) {
        nh_num c = whole.item[0].coefficient;
        *sign = c.p < 0 ? -1 : 1;
        c.p = c.p < 0 ? -c.p : c.p;
        nh_ex atom = whole.item[0].atom;
        for (size_t i = 0; i < l->count && !found; i++) {
            nh_parts other;
            if (l->item[i].kind != kind) continue;
            nh_parts_make(d, true, l->item[i].base, &other);
            if (other.count == 1 && other.item[0].atom == atom) {
                found = &l->item[i];
                c = common(c, other.item[0].coefficient);
            }
            nh_free(other.item);
        }
        nh_ex base = nh_mul(d, nh_number(d, nh_num_ratio(c.p, c.q)), atom);
        if (found) found->base = base;
        else found = letter_of(l, kind, base);
    }
    nh_free(whole.item);
    return found;
}

/* The letter of a function of the position: a circle or an exponential for its angle, with a denominator for tan and
 * the like. */
static void take_function(const nh_jet_equations *x, nh_closed_letters *l, nh_ex e)
{
    nh_dag *d = x->dag;
    nh_letter *found;
    double sign;
    if (!of_position(x, e)) return;
    switch (nh_function_of(d, e)) {
    case NH_SIN:
    case NH_COS:
    case NH_TAN:
        found = direction(d, l, NH_LETTER_CIRCLE, nh_child(d, e, 0), &sign);
        if (found && nh_function_of(d, e) == NH_TAN) found->down = fmax(found->down, least_down);
        break;
    case NH_SINH:
    case NH_COSH:
    case NH_TANH:
        found = direction(d, l, NH_LETTER_EXPONENTIAL, nh_child(d, e, 0), &sign);
        if (found) found->down = fmax(found->down, least_down);
        break;
    case NH_EXP:
        found = direction(d, l, NH_LETTER_EXPONENTIAL, nh_child(d, e, 0), &sign);
        if (found && sign < 0) found->down = fmax(found->down, least_down);
        break;
    case NH_ABS:
    case NH_SIGN:
    case NH_PI: break;
    default: letter_of(l, NH_LETTER_POWER, e);
    }
}

/* ---- powers ---- */

/* A sum that is negative at all probes has a real root only with the other sign. */
static nh_ex positive(const nh_jet_equations *x, nh_ex base)
{
    nh_dag *d = x->dag;
    if (nh_kind_of(d, base) != NH_SUM || nh_model_sign(x->model, base) >= 0) return base;
    nh_ex sum = nh_neg(d, nh_number(d, nh_constant_of(d, base)));
    for (size_t i = 0; i < nh_arity(d, base); i++)
        sum = nh_sub(d, sum, nh_mul(d, nh_number(d, nh_coefficient_of(d, base, i)), nh_child(d, base, i)));
    return sum;
}

/* `less`: by how much the lowest exponent of an integral is expected above this one. */
static void take_power(const nh_jet_equations *x, nh_closed_letters *l, nh_ex base, nh_num exponent, double less)
{
    nh_dag *d = x->dag;
    bool function = nh_kind_of(d, base) == NH_FUNCTION;
    nh_function f = function ? nh_function_of(d, base) : NH_PI;
    double value = nh_num_value(exponent), sign;
    if (!of_position(x, base) || !nh_num_short(exponent)) return;
    if (function && (f == NH_SIN || f == NH_COS) && exponent.q == 1) {
        nh_letter *angle = direction(d, l, NH_LETTER_CIRCLE, nh_child(d, base, 0), &sign);
        double *down = !angle ? NULL : f == NH_SIN ? &angle->down_sine : &angle->down;
        if (down && value < 0) *down = fmax(*down, fmax(-value - less, 1));
        return;
    }
    if (function && f == NH_EXP) { /* canonical forms have exp(x)^-1 for exp(-x) */
        nh_letter *found = direction(d, l, NH_LETTER_EXPONENTIAL, nh_child(d, base, 0), &sign);
        if (found && sign * value < 0) found->down = fmax(found->down, least_down);
        return;
    }
    if (exponent.q == 1 && value > 0) return; /* whole powers are polynomials in the letters of the base */
    nh_letter *found = letter_of(l, NH_LETTER_POWER, positive(x, base));
    found->root = found->root / nh_gcd(found->root, exponent.q) * exponent.q;
    if (value < 0) found->down = fmax(found->down, fmax(-value - less, 1 / (double)found->root));
    else found->up = fmax(found->up, value);
}

static void take_expression(const nh_jet_equations *x, nh_closed_letters *l, nh_ex e, double less)
{
    nh_dag *d = x->dag;
    NH_LIST(found);
    nh_ex own = nh_canonical(d, e, largest_form);
    size_t n = nh_functions_in(d, own, &found);
    for (size_t i = 0; i < n; i++) take_function(x, l, found[i]);
    n = nh_products_in(d, own, &found);
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < nh_arity(d, found[i]); k++) {
            nh_ex exponent = nh_exponent_of(d, found[i], k);
            if (nh_kind_of(d, exponent) == NH_NUMBER)
                take_power(x, l, nh_child(d, found[i], k), nh_number_of(d, exponent), less);
        }
}

/* ---- the determinant of the inertia ---- */

/* The determinant of the rows from `row` on and the columns that are not used yet. */
static nh_ex minor_of(const nh_model *model, size_t row, uint32_t used)
{
    if (row == model->n) return nh_int(model->dag, 1);
    nh_ex sum = nh_int(model->dag, 0);
    bool minus = false;
    for (size_t j = 0; j < model->n; j++) {
        if (used >> j & 1) continue;
        nh_ex term = model->M[row * model->n + j];
        if (!nh_is_zero(model->dag, term)) {
            term = nh_mul(model->dag, term, minor_of(model, row + 1, used | (uint32_t)1 << j));
            sum = minus ? nh_sub(model->dag, sum, term) : nh_add(model->dag, sum, term);
        }
        minus = !minus;
    }
    return sum;
}

/* Is e a square of a product of coordinates' powers? */
static bool is_square(const nh_jet_equations *x, nh_ex e)
{
    nh_dag *d = x->dag;
    if (nh_kind_of(d, e) != NH_PRODUCT) return nh_is_number(d, e, 1);
    bool square = true;
    for (size_t k = 0; k < nh_arity(d, e); k++) {
        nh_ex exponent = nh_exponent_of(d, e, k);
        nh_num n = nh_kind_of(d, exponent) == NH_NUMBER ? nh_number_of(d, exponent) : nh_num_int(1);
        square &= is_coordinate(x, nh_child(d, e, k)) && nh_num_short(n) && n.q == 1 && n.p % 2 == 0;
    }
    return square;
}

/* Is the root of `base` a root of the system times coordinates, but for its sign?  Words with both would be related, in
 * a way that proofs do not know. */
static bool has_root(const nh_jet_equations *x, const nh_closed_letters *l, nh_ex base)
{
    nh_dag *d = x->dag;
    bool found = false;
    for (size_t i = 0; i < l->count && !found; i++)
        found = l->item[i].kind == NH_LETTER_POWER && l->item[i].root % 2 == 0 && l->item[i].base != base &&
                is_square(x, nh_simplify_short(d, nh_div(d, base, l->item[i].base), largest_form));
    return found;
}

static bool is_odd(const nh_dag *d, nh_ex exponent)
{
    if (nh_kind_of(d, exponent) != NH_NUMBER) return false;
    nh_num n = nh_number_of(d, exponent);
    return nh_num_short(n) && n.q == 1 && n.p % 2 != 0;
}

/* The factors of an expression, as bases with half powers; coordinates, where their power is odd.  Common factors of a
 * sum's terms are divided out, unless `plain`: the quotient may be written with them again. */
static void take_factors(const nh_jet_equations *x, nh_closed_letters *l, nh_ex e, bool plain)
{
    nh_dag *d = x->dag;
    bool product = nh_kind_of(d, e) == NH_PRODUCT;
    for (size_t k = 0; k < (product ? nh_arity(d, e) : 1); k++) {
        nh_ex base = product ? nh_child(d, e, k) : e, common = nh_int(d, 1);
        if (!of_position(x, base)) continue;
        bool sum = nh_kind_of(d, base) == NH_SUM, odd = product && is_odd(d, nh_exponent_of(d, e, k));
        if (sum && !plain) common = nh_terms_common(d, base);
        if (!nh_is_number(d, common, 1)) {
            take_factors(x, l, common, true);
            take_factors(x, l, nh_simplify_short(d, nh_div(d, base, common), largest_form), true);
        } else {
            bool root = sum ? !has_root(x, l, base) : odd && is_coordinate(x, base);
            take_power(x, l, base, root ? nh_num_ratio(-1, 2) : nh_num_int(-1), 0);
        }
    }
}

static void take_determinant(const nh_jet_equations *x, nh_closed_letters *l)
{
    const nh_model *model = x->model;
    if (model->n <= largest_inertia)
        take_factors(x, l, nh_simplify_short(x->dag, minor_of(model, 0, 0), largest_form), false);
}

/* The momenta of a frame in which the inertia is 1 have roots of the inertia: exp(u/2) where the inertia has exp(u).
 * `all`: also of sums and coordinates, which may cancel from the determinant, as in (r^2 - 1) T'^2 - r'^2/(r^2 - 1). */
static void take_roots(const nh_jet_equations *x, nh_closed_letters *l, bool all)
{
    nh_dag *d = x->dag;
    double sign;
    for (size_t i = 0; i < x->model->n; i++) {
        nh_ex inertia = nh_simplify_short(d, x->model->M[i * x->model->n + i], largest_form);
        bool product = nh_kind_of(d, inertia) == NH_PRODUCT;
        for (size_t k = 0; k < (product ? nh_arity(d, inertia) : 1); k++) {
            nh_ex factor = product ? nh_child(d, inertia, k) : inertia;
            bool odd = product && is_odd(d, nh_exponent_of(d, inertia, k)) && is_coordinate(x, factor);
            if (all && odd) take_power(x, l, factor, nh_num_ratio(-1, 2), 0);
            if (all && product && nh_kind_of(d, factor) == NH_SUM && of_position(x, factor))
                take_factors(x, l, factor, true);
            if (nh_kind_of(d, factor) != NH_FUNCTION || nh_function_of(d, factor) != NH_EXP || !of_position(x, factor))
                continue;
            nh_ex half = nh_mul(d, nh_ratio(d, 1, 2), nh_child(d, factor, 0));
            nh_letter *found = direction(d, l, NH_LETTER_EXPONENTIAL, half, &sign);
            if (found) found->down = fmax(found->down, least_down);
        }
    }
}

/* ---- the coordinates ---- */

/* Is `base` linear, in coordinates that are letters? */
static bool is_linear(const nh_jet_equations *x, const nh_closed_letters *l, size_t coordinates, nh_ex base)
{
    bool linear = true;
    for (size_t k = 0; k < x->coordinates && linear; k++) {
        nh_ex slope = nh_diff(x->dag, base, x->coordinate[k]);
        bool letter = nh_is_zero(x->dag, slope);
        for (size_t j = 0; j < coordinates; j++) letter |= l->item[j].base == x->coordinate[k];
        for (size_t j = 0; j < x->coordinates; j++) linear &= letter && !nh_depends(x->dag, slope, x->coordinate[j]);
    }
    return linear;
}

/* Powers of a coordinate that occurs only inside of functions are unlikely. */
static bool only_inside(const nh_jet_equations *x, size_t n, const nh_ex *e, nh_ex q)
{
    enum { most = 64 };
    nh_dag *d = x->dag;
    NH_LIST(function);
    nh_ex fresh[most];
    bool inside = false, plain = false;
    for (size_t k = 0; k < n; k++) {
        size_t count = nh_functions_in(d, e[k], &function);
        if (count >= most) return false;
        for (size_t i = 0; i < count; i++) {
            inside |= nh_depends(d, function[i], q);
            fresh[i] = nh_int(d, (int64_t)i + 2);
        }
        plain |= nh_depends(d, nh_substitute(d, e[k], count, function, fresh), q);
    }
    return inside && !plain;
}

/* The highest powers of coordinates in the potential: up to these, at most doubled, a power is as cheap as a
 * coordinate. */
static void take_potential(const nh_jet_equations *x, nh_closed_letters *l)
{
    static const double most = 2;
    const nh_model *model = x->model;
    nh_dag *d = x->dag;
    nh_ex *zero = nh_alloc_array(x->n + 1, sizeof *zero);
    for (size_t i = 0; i < x->n; i++) zero[i] = nh_int(d, 0);
    nh_ex *term, V = nh_substitute(d, model->Lbar, x->n, x->w, zero);
    size_t terms = nh_terms_of(d, V, &term);
    for (size_t i = 0; i < terms; i++) {
        if (nh_kind_of(d, term[i]) != NH_PRODUCT) continue;
        for (size_t k = 0; k < nh_arity(d, term[i]); k++) {
            nh_ex base = nh_child(d, term[i], k), exponent = nh_exponent_of(d, term[i], k);
            for (size_t j = 0; j < l->count && nh_kind_of(d, exponent) == NH_NUMBER; j++)
                if (l->item[j].base == base && l->item[j].kind == NH_LETTER_POWER)
                    l->item[j].up = fmax(l->item[j].up, fmin(most, nh_num_value(nh_number_of(d, exponent))));
        }
    }
    nh_free(term);
    nh_free(zero);
}

/* The rates in coordinates of the equations: those of the shape have no cyclic coordinates. */
static void take_rates(const nh_jet_equations *x, nh_closed_letters *l, const nh_construct_rates *rates)
{
    nh_dag *d = x->dag;
    double sign;
    for (size_t i = 0; rates && i < rates->count; i++) {
        const nh_construct_rate *r = &rates->item[i];
        if (!is_coordinate(x, r->coordinate)) continue;
        nh_ex argument = nh_construct_rate_argument(d, r);
        nh_letter *found = direction(d, l, r->wave ? NH_LETTER_CIRCLE : NH_LETTER_EXPONENTIAL, argument, &sign);
        if (found && !r->wave && sign < 0) found->down = fmax(found->down, least_down);
        if (found && r->root) found->unit = r->unit;
    }
}

/* Is it a letter, as far as the rates tell? */
static bool has_powers(const nh_construct_rates *rates, nh_ex coordinate)
{
    bool pure = false;
    for (size_t i = 0; rates && rates->only && i < rates->pure && !pure; i++)
        pure = rates->pure_coordinate[i] == coordinate;
    return !pure;
}

/* In t, as in cyclic coordinates, the rates are all that integrals contain: the powers of a letter of rates alone, up
 * to the highest rate.  Of rates with a small unit, as 1 and 1.001, these would be too many: they keep their price. */
static void take_known(const nh_jet_equations *x, nh_closed_letters *l, size_t first, const nh_construct_rates *rates)
{
    static const int64_t most = 6;
    for (size_t i = 0; rates && i < rates->count; i++) {
        const nh_construct_rate *r = &rates->item[i];
        nh_letter_kind kind = r->wave ? NH_LETTER_CIRCLE : NH_LETTER_EXPONENTIAL;
        if (!rates->only && r->coordinate != x->model->system->t) continue;
        if (!is_coordinate(x, r->coordinate)) continue;
        nh_parts own, unit;
        nh_parts_make(x->dag, true, nh_construct_rate_argument(x->dag, r), &own);
        for (size_t k = first; k < l->count; k++) {
            if (l->item[k].kind != kind) continue;
            nh_parts_make(x->dag, true, l->item[k].base, &unit);
            if (unit.count == 1 && own.count == 1 && unit.item[0].atom == own.item[0].atom) {
                double multiple = nh_num_value(own.item[0].coefficient) / nh_num_value(unit.item[0].coefficient);
                l->item[k].known = (int64_t)fmax((double)l->item[k].known, round(fabs(multiple)));
            }
            nh_free(unit.item);
        }
        nh_free(own.item);
    }
    for (size_t k = first; k < l->count; k++)
        if (l->item[k].known > most) l->item[k].known = 0;
}

nh_closed_letters nh_closed_letters_of(nh_jet_equations *x, bool secular, const nh_construct_rates *rates)
{
    const nh_model *model = x->model;
    nh_closed_letters l = {0};
    size_t n = 0;
    nh_ex *e = nh_alloc_array(model->m + model->n * model->n + model->n + 2, sizeof *e);
    e[n++] = model->Lbar;
    for (size_t s = 0; s < model->m; s++) e[n++] = model->rho[s];
    for (size_t i = 0; i < model->n * model->n; i++) e[n++] = model->M[i];
    for (size_t i = 0; i < model->n; i++) e[n++] = model->A[i];
    for (size_t k = 0; k < x->coordinates; k++)
        if (has_powers(rates, x->coordinate[k]) && (secular || !only_inside(x, n, e, x->coordinate[k])))
            letter_of(&l, NH_LETTER_POWER, x->coordinate[k]);
    size_t coordinates = l.count;
    /* the last are forces: derivatives, whose exponents are one lower */
    for (size_t i = 0; i < n; i++) take_expression(x, &l, e[i], i + model->n < n ? 0 : 1);
    take_determinant(x, &l);
    take_roots(x, &l, rates && rates->only);
    size_t own = l.count;
    take_rates(x, &l, rates);
    take_known(x, &l, own, rates);
    take_potential(x, &l);
    for (size_t i = coordinates; i < l.count; i++)
        l.item[i].linear = l.item[i].kind == NH_LETTER_POWER && is_linear(x, &l, coordinates, l.item[i].base);
    nh_free(e);
    return l;
}

/* quadratures_form: constants of integration in the forms in which they are shown. [docs/method.md, sec. 4,
 * "Quadratures"]
 *
 *     shorter_roots, shorter_logarithms    sqrt(m^2 u) = m sqrt(u);  log(c u) = log u + constant
 *     better_area_functions                atanh(a/sqrt(a^2 + b^2)) = asinh(a/b)
 *     areas_of_logarithms                  log(a + b sqrt(R)), a^2 - b^2 R = +-N^2, without log N
 *     in_other_roots                       signs into roots, roots joined, roots of the equations of motion
 *     without_a_divisor                    times currents that divide it; without currents that are its factors
 *
 * Every step proposes; what is not proved again is not taken. */
#include "search/quadratures_internal.h"

#include "exact/normal.h"
#include "exact/square.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/function.h"
#include "graph/measure.h"
#include "graph/named_function.h"
#include "graph/node.h"
#include "graph/num.h"
#include "graph/terms.h"
#include "integrals/exact_points.h"

/* sqrt(u) sqrt(v) as sqrt(u v), also below other roots: integrands are factored, which hides that the states cancel in
 * 1 - C^2. */
static nh_ex joined_roots(nh_dag *d, nh_ex e)
{
    enum { most = 200, passes = 4 };
    NH_LIST(product);
    nh_ex by[most], half = nh_ratio(d, 1, 2);
    for (int pass = 0; pass < passes; pass++) {
        size_t n = nh_products_in(d, e, &product), joined = 0;
        for (size_t i = 0; i < n && i < most; i++) {
            nh_ex radicand = nh_int(d, 1), others = nh_number(d, nh_constant_of(d, product[i]));
            size_t roots = 0;
            for (size_t f = 0; f < nh_arity(d, product[i]); f++) {
                nh_ex base = nh_child(d, product[i], f), x = nh_exponent_of(d, product[i], f);
                bool root = x == half || x == nh_neg(d, half);
                roots += root;
                if (root) radicand = nh_mul(d, radicand, nh_pow(d, base, nh_add(d, x, x)));
                else others = nh_mul(d, others, nh_pow(d, base, x));
            }
            if (roots < 2) continue;
            nh_ex above = nh_simplify_short(d, radicand, 0);
            nh_ex below = nh_simplify_short(d, nh_div(d, nh_int(d, 1), radicand), 0);
            bool over = nh_complexity(d, below) < nh_complexity(d, above);
            product[joined] = product[i];
            by[joined++] = over ? nh_div(d, others, nh_sqrt(d, below)) : nh_mul(d, others, nh_sqrt(d, above));
        }
        if (!joined) return e;
        e = nh_substitute(d, e, joined, product, by);
    }
    return e;
}

/* e = outside^2 inside, from the common factor of a sum, or from numerator and denominator. */
static bool split(nh_dag *d, nh_ex e, nh_ex *outside, nh_ex *inside)
{
    NH_LIST(root);
    e = nh_simplify_short(d, e, 0);
    bool quotient = nh_kind_of(d, e) == NH_SUM && !nh_radicands_in(d, e, &root);
    nh_ex common = nh_kind_of(d, e) == NH_SUM ? nh_terms_common(d, e) : nh_int(d, 1);
    if (!nh_is_number(d, common, 1)) {
        e = nh_mul(d, common, nh_simplify_short(d, nh_div(d, e, common), 0));
        quotient = false;
    }
    return quotient ? nh_square_split_quotient(d, e, outside, inside) : nh_square_split(d, e, outside, inside);
}

/* sqrt(m^2 u) as m sqrt(u), sqrt(x^4 u) as x^2 sqrt(u): if that changes a sign, the root has the other sign everywhere
 * in e; the result is proved anew. */
static nh_ex shorter_roots(const nh_model *model, nh_ex e)
{
    nh_dag *d = model->dag;
    NH_LIST(radicand);
    nh_ex outside, inside;
    size_t n = nh_radicands_in(d, e, &radicand);
    for (size_t i = 0; i < n; i++) {
        bool positive = split(d, radicand[i], &outside, &inside) &&
                        (nh_model_is_constant(model, outside) || nh_model_sign(model, outside) > 0);
        if (positive) e = nh_substitute_root(d, e, radicand[i], nh_mul(d, outside, nh_sqrt(d, inside)));
    }
    return e;
}

/* log(c u) as log u, with a positive constant c of parameters: in a current it adds a constant only. */
static nh_ex shorter_logarithm(void *model_, nh_ex call)
{
    const nh_model *model = model_;
    nh_dag *d = model->dag;
    nh_ex u = nh_function_of(d, call) == NH_LOG ? nh_child(d, call, 0) : 0;
    if (!u || nh_kind_of(d, u) != NH_PRODUCT) return 0;
    nh_ex c = nh_number(d, nh_constant_of(d, u));
    for (size_t f = 0; f < nh_arity(d, u); f++)
        if (nh_model_is_constant(model, nh_child(d, u, f)) && nh_model_is_constant(model, nh_exponent_of(d, u, f)))
            c = nh_mul(d, c, nh_pow(d, nh_child(d, u, f), nh_exponent_of(d, u, f)));
    nh_ex valued = nh_model_values(model, c);
    bool positive = nh_kind_of(d, valued) == NH_NUMBER && nh_num_value(nh_number_of(d, valued)) > 0;
    return positive ? nh_call(d, NH_LOG, nh_div(d, u, c)) : 0;
}

static bool has_roots_of_states(const nh_model *model, nh_ex e)
{
    enum { most = 24 };
    NH_LIST(radicand);
    size_t n = nh_radicands_in(model->dag, e, &radicand);
    bool found = false;
    for (size_t i = 0; i < n && !found; i++) found = !nh_model_is_constant(model, radicand[i]);
    return found;
}

/* atanh(a/sqrt(a^2 + b^2)) as asinh(a/b), where that is not much longer: it keeps its digits where b is small. */
static nh_ex better_area_functions(const nh_model *model, nh_ex e)
{
    enum { most = 24, a_few = 4 };
    nh_dag *d = model->dag;
    NH_LIST(call);
    nh_ex outside, inside, one = nh_int(d, 1);
    size_t n = nh_functions_in(d, e, &call);
    for (size_t i = 0; i < n && n <= most; i++) {
        if (nh_function_of(d, call[i]) != NH_ATANH) continue;
        nh_ex f = nh_child(d, call[i], 0), square = nh_simplify_short(d, nh_powi(d, f, 2), 0);
        nh_ex other = nh_simplify_short(d, nh_div(d, square, nh_sub(d, one, square)), 0);
        if (!nh_square_split(d, other, &outside, &inside)) continue;
        nh_ex u = nh_simplify_short(d, nh_mul(d, outside, nh_sqrt(d, inside)), 0);
        int sign = has_roots_of_states(model, u) ? 0 : nh_model_sign(model, nh_div(d, f, u));
        if (!sign || nh_complexity(d, u) > nh_complexity(d, f) + a_few) continue;
        nh_ex area = nh_mul(d, nh_int(d, sign), nh_call(d, NH_ASINH, u));
        e = nh_substitute(d, e, 1, &call[i], &area);
    }
    return e;
}

/* sqrt(s^2 R) as s sqrt(R), where sqrt(R) occurs in the equations of motion and the parameters make s positive: the
 * rate then vanishes for both signs of s. */
static nh_ex roots_of_the_equations(const nh_model *model, nh_ex e)
{
    nh_dag *d = model->dag;
    NH_LIST(own);
    NH_LIST(more);
    NH_LIST(theirs);
    nh_ex half = nh_ratio(d, 1, 2), s, rest;
    size_t roots = nh_radicands_in(d, e, &own), known = 0, capacity = 0;
    for (size_t k = 0; k < model->n && roots; k++) {
        size_t m = nh_radicands_in(d, model->a[k], &more);
        nh_grow(&theirs, &capacity, known + m, sizeof *theirs);
        for (size_t j = 0; j < m; j++) theirs[known++] = more[j];
    }
    for (size_t i = 0; i < roots; i++)
        for (size_t j = 0; j < known; j++) {
            nh_ex ratio = nh_simplify_short(d, nh_div(d, own[i], theirs[j]), 0);
            bool parametric = own[i] != theirs[j] && nh_model_is_constant(model, ratio);
            if (!parametric || !nh_square_split(d, ratio, &s, &rest)) continue;
            nh_ex value = nh_model_values(model, s);
            if (rest != nh_int(d, 1) || nh_kind_of(d, value) != NH_NUMBER) continue;
            if (nh_num_value(nh_number_of(d, value)) < 0) s = nh_neg(d, s);
            e = nh_substitute_root(d, e, own[i], nh_mul(d, s, nh_pow(d, theirs[j], half)));
            break;
        }
    return e;
}

/* sign(u) as u/sqrt(u^2): then it goes into the roots beside it. */
static nh_ex sign_as_root(void *dag, nh_ex call)
{
    if (nh_function_of(dag, call) != NH_SIGN) return 0;
    nh_ex u = nh_child(dag, call, 0);
    return nh_div(dag, u, nh_sqrt(dag, nh_powi(dag, u, 2)));
}

/* Is u = a + b sqrt(R), with one root, but for those of constants? */
static bool is_surd(const nh_model *model, nh_ex u, nh_ex *a, nh_ex *b, nh_ex *R)
{
    enum { most = 8 };
    nh_dag *d = model->dag;
    NH_LIST(radicand);
    nh_ex s = nh_symbol_fresh(d, "s"), zero = nh_int(d, 0);
    size_t n = nh_radicands_in(d, u, &radicand), roots = 0;
    for (size_t i = 0; i < n; i++)
        if (!nh_model_is_constant(model, radicand[i])) radicand[roots++] = radicand[i];
    if (n > most || roots != 1) return false;
    nh_ex e = nh_simplify_short(d, nh_substitute_root(d, u, radicand[0], s), 0);
    *R = radicand[0];
    *b = nh_simplify_short(d, nh_diff(d, e, s), 0);
    *a = nh_simplify_short(d, nh_substitute(d, e, 1, &s, &zero), 0);
    return !nh_depends(d, *b, s) && !nh_is_zero(d, *b);
}

/* The root of e, where it is positive; `exact`: and has no root but of constants. */
static bool root_of(const nh_model *model, nh_ex e, bool exact, nh_ex *out)
{
    nh_dag *d = model->dag;
    nh_ex outside, inside;
    if (!split(d, e, &outside, &inside) || (exact && !nh_model_is_constant(model, inside))) return false;
    if (exact && nh_model_sign(model, outside) < 0) outside = nh_neg(d, outside);
    *out = nh_mul(d, outside, nh_sqrt(d, inside));
    return !exact || nh_model_sign(model, outside) > 0;
}

/* w = arcosh(C) as *times arsinh(*sinh): sinh(w/2) is the root of (C - 1)/2, and cosh(w/2) that of (C + 1)/2. */
static bool area_of_cosine(const nh_model *model, nh_ex C, int *times, nh_ex *sinh)
{
    enum { most_halves = 4 };
    nh_dag *d = model->dag;
    nh_ex half = nh_ratio(d, 1, 2), one = nh_int(d, 1);
    bool found = false;
    for (int k = 1; k <= most_halves; k++) {
        nh_ex below = nh_simplify_short(d, nh_mul(d, half, nh_sub(d, C, one)), 0), root;
        if (!root_of(model, below, false, &root) || (found && nh_complexity(d, root) >= nh_complexity(d, *sinh))) break;
        *sinh = root;
        *times = 1 << k;
        found = true;
        if (!root_of(model, nh_simplify_short(d, nh_mul(d, half, nh_add(d, C, one)), 0), true, &C)) break;
    }
    return found;
}

/* log(a + b sqrt(R)) without log N, where a^2 - b^2 R = N^2 or -N^2: with a = N cosh w or N sinh w it is w.  N may be a
 * current. */
static bool area_of(const nh_model *model, nh_ex u, nh_ex *out)
{
    nh_dag *d = model->dag;
    nh_ex a, b, R, N;
    u = joined_roots(d, u);
    if (!is_surd(model, u, &a, &b, &R)) return false;
    nh_ex norm = nh_simplify_short(d, nh_sub(d, nh_powi(d, a, 2), nh_product(d, 3, (nh_ex[]){b, b, R})), 0);
    int times = 1, sign = nh_is_zero(d, norm) ? 0 : nh_model_sign(model, norm);
    if (!sign || !root_of(model, sign > 0 ? norm : nh_simplify_short(d, nh_neg(d, norm), 0), true, &N)) return false;
    nh_ex w = nh_simplify_short(d, nh_div(d, a, N), 0);
    if (sign > 0 && !area_of_cosine(model, w, &times, &w)) return false;
    int side = nh_model_sign(model, sign > 0 ? nh_div(d, w, b) : b);
    if (!side || nh_complexity(d, w) >= nh_complexity(d, u)) return false;
    *out = nh_mul(d, nh_int(d, times * side), nh_call(d, NH_ASINH, w));
    return true;
}

/* log(y + sqrt(1 + y^2)) as arsinh(y): shorter, and no logarithm of a current is added. */
static nh_ex area_of_logarithm(void *model_, nh_ex call)
{
    const nh_model *model = model_;
    nh_ex area;
    bool log = nh_function_of(model->dag, call) == NH_LOG;
    return log && area_of(model, nh_child(model->dag, call, 0), &area) ? area : 0;
}

static nh_ex areas_of_logarithms(const nh_model *model, nh_ex e)
{
    nh_ex with = nh_substitute_calls(model->dag, e, area_of_logarithm, (void *)model);
    return with == e ? e : nh_simplify_short(model->dag, with, 0);
}

/* Most are not, which doubles show: a rate that is nowhere as small as rounding. */
bool nh_quadratures_conserves(const nh_model *model, nh_ex e)
{
    enum { rounding = 1000000000 }; /* one part in so many */
    nh_dag *d = model->dag;
    if (nh_model_is_constant(model, e)) return true;
    nh_ex rate = nh_model_gamma(model, e), least = nh_mul(d, nh_ratio(d, 1, rounding), e);
    if (nh_model_sign(model, nh_sub(d, nh_powi(d, rate, 2), nh_powi(d, least, 2))) > 0) return false;
    return nh_is_zero(d, nh_simplify_short(d, rate, 0));
}

/* A product without its conserved factors, but for the longest. */
static nh_ex without_factors(const nh_model *model, nh_ex e)
{
    nh_dag *d = model->dag;
    size_t n = nh_kind_of(d, e) == NH_PRODUCT ? nh_arity(d, e) : 0, longest = 0;
    for (size_t f = 1; f < n; f++)
        if (nh_complexity(d, nh_child(d, e, f)) > nh_complexity(d, nh_child(d, e, longest))) longest = f;
    nh_ex rest = n ? nh_int(d, 1) : e;
    for (size_t f = 0; f < n; f++) {
        nh_ex factor = nh_pow(d, nh_child(d, e, f), nh_exponent_of(d, e, f));
        if (f == longest || !nh_quadratures_conserves(model, factor)) rest = nh_mul(d, rest, factor);
    }
    return rest;
}

/* e times a factor, term by term. */
static nh_ex times(nh_dag *d, nh_ex e, nh_ex factor)
{
    if (nh_kind_of(d, e) != NH_SUM) return nh_simplify_short(d, nh_mul(d, e, factor), 0);
    nh_ex sum = nh_mul(d, nh_number(d, nh_constant_of(d, e)), factor);
    for (size_t i = 0; i < nh_arity(d, e); i++) {
        nh_ex term = nh_mul(d, nh_number(d, nh_coefficient_of(d, e, i)), nh_child(d, e, i));
        sum = nh_add(d, sum, nh_simplify_short(d, nh_mul(d, term, factor), 0));
    }
    return nh_simplify_short(d, sum, 0);
}

/* What a product may be multiplied by: each factor's inverse; that of all that divides it; that and of exponentials. */
static size_t multipliers_of(nh_dag *d, nh_ex term, size_t most, nh_ex *out)
{
    size_t n = 0;
    nh_ex divisor = nh_int(d, 1), growth = divisor;
    if (nh_kind_of(d, term) != NH_PRODUCT) return 0;
    for (size_t f = 0; f < nh_arity(d, term) && n + 2 < most; f++) {
        nh_ex base = nh_child(d, term, f), x = nh_exponent_of(d, term, f);
        if (nh_kind_of(d, x) != NH_NUMBER) continue;
        out[n] = nh_pow(d, base, nh_neg(d, x));
        if (nh_num_value(nh_number_of(d, x)) < 0) divisor = nh_mul(d, divisor, out[n]);
        else if (nh_kind_of(d, base) == NH_FUNCTION && nh_function_of(d, base) == NH_EXP)
            growth = nh_mul(d, growth, out[n]);
        n++;
    }
    out[n++] = divisor;
    out[n++] = nh_mul(d, divisor, growth);
    return n;
}

/* A current times a current that divides it, where that is not much longer, or divided by one where that is shorter:
 * x y' - u, and not x - u/y'.  What is polynomial in the velocities is counted (count/completeness.h). */
static nh_ex without_a_divisor(const nh_model *model, nh_ex e)
{
    enum { a_few = 4, most = 32, longest = 500 };
    nh_dag *d = model->dag;
    nh_ex core = without_factors(model, e);
    bool sum = nh_kind_of(d, core) == NH_SUM;
    size_t length = nh_complexity(d, core);
    for (size_t i = 0; i < (sum ? nh_arity(d, core) : 1) && length <= longest; i++) {
        nh_ex multiplier[most];
        size_t n = multipliers_of(d, sum ? nh_child(d, core, i) : core, most, multiplier);
        for (size_t k = 0; k < n; k++) {
            if (nh_model_is_constant(model, multiplier[k]) || !nh_quadratures_conserves(model, multiplier[k])) continue;
            nh_ex whole = without_factors(model, times(d, core, multiplier[k]));
            bool divided = nh_complexity(d, nh_powi(d, multiplier[k], -1)) < nh_complexity(d, multiplier[k]);
            bool short_enough = nh_complexity(d, whole) < (divided ? length : length + a_few);
            if (short_enough && !nh_model_is_constant(model, whole)) return whole;
        }
    }
    return core;
}

/* A form of a constant without signs, its roots joined.  The time of a swing has signs. */
static nh_ex in_other_roots(const nh_analysis *result, nh_ex e, bool general)
{
    const nh_model *model = result->question->model;
    if (nh_named_function_has_elliptic(model->dag, e) &&
        nh_prove_current(model, e, true, &result->question->options).all_parameters)
        return e;
    nh_ex joined =
        shorter_roots(model, joined_roots(model->dag, nh_substitute_calls(model->dag, e, sign_as_root, model->dag)));
    nh_ex rooted = nh_simplify_short(model->dag, roots_of_the_equations(model, joined), 0);
    bool shorter = nh_complexity(model->dag, rooted) < nh_complexity(model->dag, e);
    if (e == rooted || !general) return e;
    if (!shorter && nh_prove_current(model, e, true, &result->question->options).all_parameters) return e;
    return nh_prove_current(model, rooted, true, &result->question->options).all_parameters ? rooted : e;
}

nh_ex nh_quadratures_form(const nh_analysis *result, nh_ex value, bool general)
{
    enum { most_divisors = 3 };
    const nh_model *model = result->question->model;
    nh_dag *d = model->dag;
    nh_ex short_logs = nh_substitute_calls(d, shorter_roots(model, value), shorter_logarithm, (void *)model);
    nh_ex e = shorter_roots(model, nh_simplify_short(d, short_logs, 0));
    nh_ex stable = areas_of_logarithms(model, better_area_functions(model, e));
    if (stable != e && nh_prove_current(model, stable, true, &result->question->options).all_parameters) e = stable;
    e = in_other_roots(result, e, general);
    nh_ex whole = e;
    for (int k = 0; k < most_divisors; k++) whole = without_a_divisor(model, whole);
    if (whole == e) return e;
    nh_proof proof = nh_prove_current(model, whole, general, &result->question->options);
    return (general ? proof.all_parameters : proof.proved) ? whole : e;
}

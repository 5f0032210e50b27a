/* prove: the order in which a proof is looked for. [docs/method.md, sec. 4, "Proof"]
 *
 *     nh_prove_claim
 *       |-- an exact relation is known: done
 *       |-- long rate: is it the energy?  has it a short field zeta, with (N0) and (NY) identities?
 *       |-- prove_zero
 *       |     |-- prove_sum    normal form with symbols, then with values
 *       |     |-- cancel       digits in balls; may refute
 *       |     `-- prove_sum    once more with more terms, where the digits promise success
 *       `-- short rate, not proved for all parameters: the field after all
 *
 * A term is one direction's part of Gamma(Phi): 1 + m + n of them (nh_rate_terms). */
#include "integrals/prove.h"

#include <math.h>

#include "exact/square.h"
#include "geometry/model.h"
#include "graph/declared.h"
#include "graph/diff.h"
#include "graph/function.h"
#include "graph/measure.h"
#include "graph/monomials.h"
#include "graph/named_function.h"
#include "graph/node.h"
#include "graph/terms.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "integrals/affine_field.h"
#include "integrals/exact_points.h"
#include "integrals/fitted.h"
#include "integrals/fixed.h"
#include "integrals/noether_equation.h"
#include "integrals/symmetry.h"

/* ---- Rates with signs or elliptic integrals in a form in which the normal form sees that they vanish ----
 *
 * It treats |u| and every root as a function of its own, of which it knows the square only: sqrt(u^2 v) is then not
 * |u| sqrt(v), and (N/D)^(1/4) has nothing to do with sqrt(N). */

/* sign(u) as |u|/u, of which the normal form knows the square. */
static nh_ex without_sign(void *dag, nh_ex call)
{
    if (nh_function_of(dag, call) != NH_SIGN) return 0;
    nh_ex u = nh_child(dag, call, 0);
    return nh_div(dag, nh_call(dag, NH_ABS, u), u);
}

/* sin and cos of 2 a, and of 2 a + pi, by those of a, where one of these stands in e: equal radicands then have one
 * form. */
static nh_ex in_half_angles(nh_dag *d, nh_ex e)
{
    enum { most = 32 };
    NH_LIST(call);
    nh_ex by[most], whole[most], one = nh_int(d, 1), two = nh_int(d, 2);
    size_t n = nh_functions_in(d, e, &call), doubled = 0;
    for (size_t i = 0; i < n && n <= most; i++)
        for (size_t k = 0; k < n; k++) {
            nh_function f = nh_function_of(d, call[i]), g = nh_function_of(d, call[k]);
            bool waves = (f == NH_SIN || f == NH_COS) && (g == NH_SIN || g == NH_COS);
            if (!waves) continue;
            nh_ex half = nh_child(d, call[k], 0), apart = nh_sub(d, nh_child(d, call[i], 0), nh_mul(d, two, half));
            if (!nh_is_zero(d, apart) && apart != nh_pi(d)) continue;
            nh_ex sign = nh_int(d, nh_is_zero(d, apart) ? 1 : -1), sine = nh_call(d, NH_SIN, half);
            nh_ex value = f == NH_COS ? nh_sub(d, one, nh_mul(d, two, nh_powi(d, sine, 2)))
                                      : nh_product(d, 3, (nh_ex[]){two, sine, nh_call(d, NH_COS, half)});
            whole[doubled] = call[i];
            by[doubled++] = nh_mul(d, sign, value);
            break;
        }
    return nh_substitute(d, e, doubled, whole, by);
}

/* sqrt(e) in another form: where e is c u^2 with a constant c, and u has one sign on the domain, without the square
 * below the root; of a constant over e' as one over a root.  0: there is none.  `decisive`: the parameters on which
 * that sign depends. */
static nh_ex root_of(const nh_model *model, nh_ex e, bool *decisive)
{
    nh_dag *d = model->dag;
    nh_ex outside, inside;
    bool square = nh_square_split(d, e, &outside, &inside) && nh_model_is_constant(model, inside);
    int sign = square && !nh_model_is_constant(model, outside) ? nh_model_sign(model, outside) : 0;
    for (size_t i = 0; i < model->system->parameters && sign; i++)
        decisive[i] |= nh_depends(d, outside, model->parameter[i]);
    if (sign) return nh_product(d, 3, (nh_ex[]){nh_int(d, sign), outside, nh_sqrt(d, inside)});
    bool below = nh_model_is_constant(model, nh_numerator(d, e));
    return below ? nh_powi(d, nh_sqrt(d, nh_simplify_short(d, nh_powi(d, e, -1), 0)), -1) : 0;
}

/* sqrt(u^2 v) as |u| sqrt(v), where |u| stands in e, and without squares: nothing else says that they belong
 * together.  The outer roots first: they are known as they stand. */
static nh_ex squares_out(const nh_model *model, nh_ex e, bool *decisive)
{
    enum { most = 32 };
    nh_dag *d = model->dag;
    NH_LIST(base);
    NH_LIST(call);
    nh_ex one = nh_int(d, 1);
    size_t calls = nh_functions_in(d, e, &call), n = nh_radicands_in(d, e, &base);
    for (size_t k = n; k-- > 0 && n <= most;) {
        nh_ex rest = nh_simplify_short(d, base[k], 0), outside = one;
        if (nh_model_is_constant(model, rest)) continue;
        for (size_t i = 0; i < calls && calls <= most; i++) {
            if (nh_function_of(d, call[i]) != NH_ABS) continue;
            nh_ex other = nh_simplify_short(d, nh_div(d, rest, nh_powi(d, nh_child(d, call[i], 0), 2)), 0);
            if (nh_complexity(d, other) >= nh_complexity(d, rest)) continue;
            outside = nh_mul(d, outside, call[i]);
            rest = other;
        }
        nh_ex root = root_of(model, rest, decisive);
        if (!root && outside == one) continue;
        e = nh_substitute_root(d, e, base[k], nh_mul(d, outside, root ? root : nh_sqrt(d, rest)));
    }
    return e;
}

/* The powers k/4 and k/2 of N/D with those of N and D, where both are positive: sums of quotients have one form. */
static nh_ex fourth_roots(const nh_model *model, nh_ex e)
{
    enum { most = 64 };
    nh_dag *d = model->dag;
    NH_LIST(product);
    size_t n = nh_products_in(d, e, &product);
    for (size_t i = 0; i < n && n <= most; i++)
        for (size_t k = 0; k < nh_arity(d, product[i]); k++) {
            nh_ex base = nh_child(d, product[i], k), x = nh_exponent_of(d, product[i], k);
            if (nh_kind_of(d, x) != NH_NUMBER || nh_number_of(d, x).q != 4) continue;
            nh_ex above = nh_numerator(d, base), below = nh_simplify_short(d, nh_div(d, above, base), 0), outside,
                  inside;
            if (nh_is_number(d, below, 1) || nh_model_sign(model, above) <= 0) continue;
            if (!nh_square_split(d, below, &outside, &inside) || nh_model_sign(model, inside) <= 0) continue;
            nh_ex size = nh_model_sign(model, outside) < 0 ? nh_neg(d, outside) : outside;
            nh_ex root = nh_div(d, nh_sqrt(d, above), nh_mul(d, size, nh_sqrt(d, inside)));
            if (nh_model_sign(model, root) > 0) e = nh_substitute_positive_root(d, e, base, root);
        }
    return e;
}

/* A form that is equal on the domain of the model.  decisive[i], one for each parameter, is set where that follows from
 * the signs that functions of this parameter have at the probes, with the value that it has. */
static nh_ex rate_form(const nh_model *model, nh_ex e, bool *decisive)
{
    nh_dag *d = model->dag;
    nh_ex positive = nh_substitute_calls(d, e, without_sign, d);
    if (positive == e && !nh_named_function_has_elliptic(d, e)) return e;
    return squares_out(model, fourth_roots(model, in_half_angles(d, positive)), decisive);
}

/* ---- prove ---- */

/* patience: so many times longer may the proof of a certified current be */
enum { wanted_points = 4, most_tries = 40, double_digits = 8, patience = 5 };

/* The digits to which the terms cancel against each other; where each term cancels in itself already, relative to the
 * parts of the terms. */
static bool cancels(nh_ball *ball, size_t n, const nh_ex *term, nh_ex sum, nh_ex size, double *log10_ratio)
{
    double bound, scale;
    if (nh_ball_relative_sum(ball, n, term, log10_ratio)) return true;
    if (!nh_ball_log10_bound(ball, sum, &bound) || !nh_ball_log10_bound(ball, size, &scale)) return false;
    *log10_ratio = isfinite(scale) ? bound - scale : -INFINITY;
    return true;
}

/* To how many digits the terms cancel: the fewest at some exact points in ball arithmetic, 0 where there are no
 * points. */
static void cancel(const nh_model *model, size_t n, const nh_ex *term, const nh_options *options, nh_proof *proof)
{
    nh_ex sum = nh_int(model->dag, 0);
    for (size_t i = 0; i < n; i++) sum = nh_add(model->dag, sum, term[i]);
    nh_ex size = nh_terms_uncancelled(model->dag, sum);
    nh_ball *ball = nh_ball_create(model->dag, (long)options->bits);
    uint64_t state = (uint64_t)options->seed + 77;
    double least = INFINITY;
    for (int tries = 0; tries < most_tries && proof->points < wanted_points; tries++) {
        double log10_ratio;
        if (!nh_exact_point(model, ball, &state) || !cancels(ball, n, term, sum, size, &log10_ratio)) continue;
        least = fmin(least, -log10_ratio);
        proof->points++;
    }
    nh_ball_free(ball);
    double most = options->bits * log10(2);
    proof->digits = proof->points == 0 ? 0 : fmax(0, fmin(least, most));
}

/* e with the values of the parameters that are fixed; the others are symbols. */
static nh_ex with_symbols(const nh_model *model, const nh_ex *fixed, nh_ex e)
{
    return fixed ? nh_fixed_values(model, fixed, e) : e;
}

/* The proof for all parameter values, but for those that are fixed. */
static nh_proof holding(nh_proof proof, const nh_ex *fixed)
{
    proof.proved = true;
    proof.all_parameters = !fixed;
    proof.fixed = fixed;
    return proof;
}

/* The velocities, parameters and t in which e is a polynomial. */
static size_t symbols_of_degree(const nh_model *model, nh_ex e, size_t most, nh_ex *out)
{
    size_t n = 0;
    nh_ex t = model->system->t;
    for (size_t i = 0; i < model->n && n < most; i++)
        if (nh_monomials_has_degree(model->dag, e, model->chart->w[i])) out[n++] = model->chart->w[i];
    for (size_t i = 0; i < model->system->parameters && n < most; i++)
        if (nh_monomials_has_degree(model->dag, e, model->parameter[i])) out[n++] = model->parameter[i];
    if (n < most && nh_monomials_has_degree(model->dag, e, t)) out[n++] = t;
    return n;
}

/* Over one denominator with all monomials in the velocities a rate may be too large where each coefficient is not: they
 * vanish one by one. */
static nh_zero_verdict is_zero(const nh_model *model, nh_ex e, size_t limit)
{
    enum { most_symbols = 24, most_coefficients = 2000 };
    nh_ex symbol[most_symbols];
    nh_monomials m;
    e = nh_model_paired_roots(model, e);
    nh_zero_verdict verdict = nh_normal_is_zero(model->dag, e, limit);
    if (verdict != NH_TOO_LARGE) return verdict;
    size_t n = symbols_of_degree(model, e, most_symbols, symbol);
    bool split = nh_monomials_of(model->dag, e, n, symbol, most_coefficients, &m);
    if (split && m.count > 1) verdict = NH_ZERO;
    for (size_t i = 0; i < m.count && verdict == NH_ZERO; i++)
        verdict = nh_normal_is_zero(model->dag, m.coefficient[i], limit);
    nh_monomials_clear(&m);
    return verdict;
}

typedef struct {
    const nh_model *model;
    nh_ex e;
    size_t limit;
} zero_problem;

static bool vanishes(const nh_ex *fixed, void *context)
{
    const zero_problem *z = context;
    return is_zero(z->model, nh_fixed_values(z->model, fixed, z->e), z->limit) == NH_ZERO;
}

/* By normal forms of at most so many terms.  True: one was too large. */
static bool try_forms(const nh_model *model, nh_ex sum, nh_claim claim, size_t limit, nh_proof *proof)
{
    nh_zero_verdict symbols = NH_TOO_LARGE, values = NH_ZERO;
    if (!proof->proved && claim.free && !claim.rounded)
        symbols = is_zero(model, with_symbols(model, claim.fixed, sum), limit);
    if (symbols == NH_ZERO) *proof = holding(*proof, claim.fixed);
    if (!proof->proved && !claim.rounded) values = is_zero(model, nh_model_values(model, sum), limit);
    proof->proved = proof->proved || (!claim.rounded && values == NH_ZERO);
    if (proof->proved && symbols == NH_NONZERO)
        proof->fixed = nh_fixed_least(model, 1, &sum, vanishes, &(zero_problem){model, sum, limit});
    return !claim.rounded && ((claim.free && symbols == NH_TOO_LARGE) || values == NH_TOO_LARGE);
}

/* The same for the values of these parameters only. */
static nh_proof with_values(const nh_model *model, nh_proof proof, const bool *which)
{
    bool any = false;
    for (size_t i = 0; i < model->system->parameters; i++) any |= which[i];
    if (!any || !(proof.all_parameters || proof.fixed)) return proof;
    const nh_ex *own = nh_fixed_those(model, which);
    return holding(proof, proof.fixed ? nh_fixed_both(model, proof.fixed, own) : own);
}

/* `proof`: known results of earlier steps. */
static nh_proof prove_zero(const nh_model *model, size_t n, const nh_ex *term, nh_proof proof, nh_claim claim,
                           const nh_options *options)
{
    nh_dag *d = model->dag;
    if (nh_fitted_is(model)) return (nh_proof){0}; /* a table has no formula: no proof is tried */
    nh_ex sum = nh_int(d, 0), *valued = nh_alloc_array(n + 1, sizeof *valued);
    for (size_t i = 0; i < n; i++) sum = nh_add(d, sum, term[i]);
    bool *decisive = nh_alloc_array(model->system->parameters + 1, sizeof *decisive);
    sum = rate_form(model, sum, decisive);
    size_t limit = (size_t)options->proof_terms;
    bool longer = !proof.proved && try_forms(model, sum, claim, limit, &proof);
    bool exact = true;
    for (size_t i = 0; i < n; i++) {
        valued[i] = nh_model_values(model, term[i]);
        exact = exact && nh_is_exact(d, valued[i]);
    }
    cancel(model, n, valued, options, &proof);
    if (longer && !proof.proved && proof.points > 0 && proof.digits >= options->digits)
        try_forms(model, sum, claim, patience * limit, &proof);
    if (proof.proved) proof = with_values(model, proof, decisive);
    nh_free(decisive);
    /* numbers too long for exact rationals were rounded to doubles when the rate was formed */
    double doubt = options->digits / 2;
    proof.rounded = !exact;
    proof.sided = proof.proved && nh_model_paired_roots(model, sum) != sum;
    if (!exact && doubt > double_digits) doubt = double_digits;
    proof.refuted = !proof.proved && proof.points > 0 && proof.digits < doubt;
    /* digits of a stand-in say nothing of other functions */
    if (!proof.proved && nh_declared_unspecified(d)) proof.digits = fmin(proof.digits, double_digits);
    nh_free(valued);
    return proof;
}

nh_proof nh_proof_both(const nh_model *model, nh_proof a, nh_proof b)
{
    nh_proof out = {.proved = a.proved && b.proved,
                    .all_parameters = a.all_parameters && b.all_parameters,
                    .digits = fmin(a.digits, b.digits)};
    const nh_ex *of_a = a.all_parameters || a.fixed ? a.fixed : nh_fixed_every(model),
                *of_b = b.all_parameters || b.fixed ? b.fixed : nh_fixed_every(model);
    if (out.proved && !out.all_parameters) out.fixed = nh_fixed_both(model, of_a, of_b);
    out.points = a.points < b.points ? a.points : b.points;
    out.rounded = a.rounded || b.rounded;
    out.refuted = a.refuted || b.refuted;
    return out;
}

nh_proof nh_prove_zero(const nh_model *model, size_t n, const nh_ex *term, bool parameters_free,
                       const nh_options *options)
{
    return prove_zero(model, n, term, (nh_proof){0}, (nh_claim){.free = parameters_free}, options);
}

/* Is e zero by normal form, with the parameters that the claim leaves free as symbols? */
static bool is_identity(const nh_model *model, nh_ex e, nh_claim claim, const nh_options *options)
{
    e = claim.free ? with_symbols(model, claim.fixed, e) : nh_model_values(model, e);
    return nh_normal_is_zero(model->dag, e, (size_t)options->proof_terms) == NH_ZERO;
}

/* Are X_0(Phi) + A_i zeta^i and Y_j(Phi) - M_ij zeta^i zero?  Then so is Gamma(Phi) = X_0(Phi) + a^j Y_j(Phi), by M a =
 * A and without M^-1, which is what makes Gamma(Phi) long [docs/method.md, (6), (11)].  The former is shorter in all
 * coordinates where L is invariant. */
static bool equations_hold(const nh_model *model, nh_ex phi, const nh_ex *zeta, nh_claim claim,
                           const nh_options *options)
{
    nh_dag *d = model->dag;
    nh_ex rate;
    bool holds = true;
    for (size_t j = 0; j <= model->n && holds; j++) {
        nh_ex e = j < model->n ? nh_model_Y(model, j, phi) : nh_model_X0(model, phi);
        for (size_t i = 0; i < model->n; i++)
            e = j < model->n ? nh_sub(d, e, nh_mul(d, model->M[i * model->n + j], zeta[i]))
                             : nh_add(d, e, nh_mul(d, model->A[i], zeta[i]));
        bool short_too = j == model->n && nh_noether_equation(model, phi, zeta, &rate);
        holds = (short_too && is_identity(model, rate, claim, options)) || is_identity(model, e, claim, options);
    }
    return holds;
}

/* The field of a current that is a multiple of a momentum, by a constant of which only the value is known so far:
 * Y_j(Phi) and M_ij zeta^i have the ratio s. */
static void scale(const nh_model *model, nh_ex phi, nh_ex *zeta)
{
    nh_dag *d = model->dag;
    for (size_t j = 0; j < model->n; j++) {
        nh_ex sum = nh_int(d, 0);
        for (size_t i = 0; i < model->n; i++) sum = nh_add(d, sum, nh_mul(d, model->M[i * model->n + j], zeta[i]));
        sum = nh_simplify_short(d, sum, 0);
        if (nh_is_zero(d, sum)) continue;
        nh_ex s = nh_simplify_short(d, nh_div(d, nh_model_Y(model, j, phi), sum), 0);
        bool constant = !nh_depends(d, s, model->system->t);
        for (size_t k = 0; k < model->m; k++) constant &= !nh_depends(d, s, model->system->coordinate[k].q);
        for (size_t i = 0; i < model->n; i++) constant &= !nh_depends(d, s, model->chart->w[i]);
        for (size_t i = 0; i < model->n && constant; i++) zeta[i] = nh_mul(d, s, zeta[i]);
        return;
    }
}

/* Energies and momenta have fields with short components however long the accelerations are. */
static bool proved_by_symmetry(const nh_model *model, nh_ex phi, nh_claim claim, const nh_options *options)
{
    enum { longest = 40 };
    nh_ex *zeta = nh_alloc_array(model->n + 1, sizeof *zeta);
    bool holds = model->n > 0;
    bool affine = holds && nh_affine_field(model, phi, options, zeta);
    if (affine && claim.free) scale(model, phi, zeta);
    if (affine && equations_hold(model, phi, zeta, claim, options)) {
        nh_free(zeta);
        return true;
    }
    if (holds) nh_symmetry_components(model, phi, zeta);
    for (size_t i = 0; i < model->n && holds; i++) holds = nh_complexity(model->dag, zeta[i]) <= longest;
    holds = holds && equations_hold(model, phi, zeta, claim, options);
    nh_free(zeta);
    return holds;
}

void nh_rate_terms(const nh_model *model, nh_ex phi, nh_ex *term)
{
    nh_dag *d = model->dag;
    term[0] = nh_diff(d, phi, model->system->t);
    for (size_t s = 0; s < model->m; s++)
        term[1 + s] = nh_mul(d, model->rho[s], nh_diff(d, phi, model->system->coordinate[s].q));
    for (size_t i = 0; i < model->n; i++) term[1 + model->m + i] = nh_mul(d, model->a[i], nh_model_Y(model, i, phi));
}

double nh_prove_digits(const nh_model *model, nh_ex phi, const nh_options *options)
{
    size_t n = 1 + model->m + model->n;
    nh_ex *term = nh_alloc_array(n, sizeof *term);
    nh_proof proof = {0};
    nh_rate_terms(model, phi, term);
    for (size_t i = 0; i < n; i++) term[i] = nh_model_values(model, term[i]);
    cancel(model, n, term, options, &proof);
    nh_free(term);
    return proof.digits;
}

/* 1. What the claim brings with it: a relation with other currents.  2. Of a long rate, energy or a short field: the
 * normal form would be far longer.  3. Normal forms, then balls (prove_zero).  4. The field, where forms left it open
 * for which parameters it holds. */
nh_proof nh_prove_claim(const nh_model *model, nh_ex phi, nh_claim claim, const nh_options *options)
{
    enum { long_rate = 2000 }; /* nh_complexity */
    if (nh_fitted_is(model)) return (nh_proof){0};
    size_t n = 1 + model->m + model->n, length = 0;
    nh_ex *term = nh_alloc_array(n, sizeof *term);
    nh_rate_terms(model, phi, term);
    for (size_t j = 0; j < n; j++) length += nh_complexity(model->dag, term[j]);
    nh_proof proof = {0};
    claim.rounded = !nh_is_exact(model->dag, nh_model_values(model, phi));
    if (claim.rounded) claim.related = false;
    if (claim.related) proof = holding(proof, claim.fixed);
    else if (claim.free && length > long_rate && nh_symmetry_is_energy(model, phi)) proof = holding(proof, NULL);
    else if (!claim.rounded && length > long_rate && proved_by_symmetry(model, phi, claim, options))
        proof = claim.free ? holding(proof, claim.fixed) : (nh_proof){.proved = true};
    proof = prove_zero(model, n, term, proof, claim, options);
    bool may_be_general = !proof.refuted && claim.free && !claim.rounded;
    /* a short rate with many roots can be harder than its field */
    bool general = proof.proved && (proof.all_parameters || claim.fixed);
    if (may_be_general && !general && length <= long_rate && proved_by_symmetry(model, phi, claim, options))
        proof = holding(proof, claim.fixed);
    /* a field may be known for the values only */
    if (may_be_general && !proof.proved && length > long_rate)
        proof.proved = proved_by_symmetry(model, phi, (nh_claim){.fixed = claim.fixed}, options);
    nh_free(term);
    return proof;
}

nh_proof nh_prove_current(const nh_model *model, nh_ex phi, bool parameters_free, const nh_options *options)
{
    return nh_prove_claim(model, phi, (nh_claim){.free = parameters_free}, options);
}

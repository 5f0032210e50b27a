#include "integrals/prove.h"

#include <math.h>

#include "graph/declared.h"
#include "graph/diff.h"
#include "graph/monomials.h"
#include "graph/terms.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "integrals/affine_field.h"
#include "integrals/exact_points.h"
#include "integrals/fixed.h"
#include "integrals/noether_equation.h"
#include "integrals/rate_form.h"
#include "integrals/symmetry.h"

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

static void cancel(const nh_model *o, size_t n, const nh_ex *term, const nh_options *options, nh_proof *proof)
{
    nh_ex sum = nh_int(o->dag, 0);
    for (size_t i = 0; i < n; i++) sum = nh_add(o->dag, sum, term[i]);
    nh_ex size = nh_terms_uncancelled(o->dag, sum);
    nh_ball *ball = nh_ball_create(o->dag, (long)options->bits);
    uint64_t state = (uint64_t)options->seed + 77;
    double least = INFINITY;
    for (int tries = 0; tries < most_tries && proof->points < wanted_points; tries++) {
        double log10_ratio;
        if (!nh_exact_point(o, ball, &state) || !cancels(ball, n, term, sum, size, &log10_ratio)) continue;
        least = fmin(least, -log10_ratio);
        proof->points++;
    }
    nh_ball_free(ball);
    double most = options->bits * log10(2);
    proof->digits = proof->points == 0 ? 0 : fmax(0, fmin(least, most));
}

static nh_ex with_symbols(const nh_model *o, const nh_ex *fixed, nh_ex e)
{
    return fixed ? nh_fixed_values(o, fixed, e) : e;
}

static nh_proof holding(nh_proof proof, const nh_ex *fixed)
{
    proof.proved = true;
    proof.all_parameters = !fixed;
    proof.fixed = fixed;
    return proof;
}

/* The velocities, parameters and t in which e is a polynomial. */
static size_t symbols_of_degree(const nh_model *o, nh_ex e, size_t most, nh_ex *out)
{
    size_t n = 0;
    nh_ex t = o->system->t;
    for (size_t i = 0; i < o->n && n < most; i++)
        if (nh_monomials_has_degree(o->dag, e, o->chart->w[i])) out[n++] = o->chart->w[i];
    for (size_t i = 0; i < o->system->parameters && n < most; i++)
        if (nh_monomials_has_degree(o->dag, e, o->parameter[i])) out[n++] = o->parameter[i];
    if (n < most && nh_monomials_has_degree(o->dag, e, t)) out[n++] = t;
    return n;
}

/* Over one denominator with all monomials in the velocities a rate may be too large where each coefficient is not: they
 * vanish one by one. */
static nh_zero_verdict is_zero(const nh_model *o, nh_ex e, size_t limit)
{
    enum { most_symbols = 24, most_coefficients = 2000 };
    nh_ex symbol[most_symbols];
    nh_monomials m;
    e = nh_model_paired_roots(o, e);
    nh_zero_verdict verdict = nh_normal_is_zero(o->dag, e, limit);
    if (verdict != NH_TOO_LARGE) return verdict;
    size_t n = symbols_of_degree(o, e, most_symbols, symbol);
    bool split = nh_monomials_of(o->dag, e, n, symbol, most_coefficients, &m);
    if (split && m.count > 1) verdict = NH_ZERO;
    for (size_t i = 0; i < m.count && verdict == NH_ZERO; i++)
        verdict = nh_normal_is_zero(o->dag, m.coefficient[i], limit);
    nh_monomials_clear(&m);
    return verdict;
}

typedef struct {
    const nh_model *o;
    nh_ex e;
    size_t limit;
} zero_problem;

static bool vanishes(const nh_ex *fixed, void *context)
{
    const zero_problem *z = context;
    return is_zero(z->o, nh_fixed_values(z->o, fixed, z->e), z->limit) == NH_ZERO;
}

/* By normal forms of at most so many terms.  Is one too large? */
static bool prove_sum(const nh_model *o, nh_ex sum, nh_claim claim, size_t limit, nh_proof *proof)
{
    nh_zero_verdict symbols = NH_TOO_LARGE, values = NH_ZERO;
    if (!proof->proved && claim.free && !claim.rounded) symbols = is_zero(o, with_symbols(o, claim.fixed, sum), limit);
    if (symbols == NH_ZERO) *proof = holding(*proof, claim.fixed);
    if (!proof->proved && !claim.rounded) values = is_zero(o, nh_model_values(o, sum), limit);
    proof->proved = proof->proved || (!claim.rounded && values == NH_ZERO);
    if (proof->proved && symbols == NH_NONZERO)
        proof->fixed = nh_fixed_least(o, 1, &sum, vanishes, &(zero_problem){o, sum, limit});
    return !claim.rounded && ((claim.free && symbols == NH_TOO_LARGE) || values == NH_TOO_LARGE);
}

/* The same for the values of these parameters only. */
static nh_proof with_values(const nh_model *o, nh_proof proof, const bool *which)
{
    bool any = false;
    for (size_t i = 0; i < o->system->parameters; i++) any |= which[i];
    if (!any || !(proof.all_parameters || proof.fixed)) return proof;
    const nh_ex *own = nh_fixed_those(o, which);
    return holding(proof, proof.fixed ? nh_fixed_both(o, proof.fixed, own) : own);
}

/* `proof`: known results of earlier steps. */
static nh_proof prove_zero(const nh_model *o, size_t n, const nh_ex *term, nh_proof proof, nh_claim claim,
                           const nh_options *options)
{
    nh_dag *d = o->dag;
    nh_ex sum = nh_int(d, 0), *valued = nh_alloc_array(n + 1, sizeof *valued);
    for (size_t i = 0; i < n; i++) sum = nh_add(d, sum, term[i]);
    bool *decisive = nh_alloc_array(o->system->parameters + 1, sizeof *decisive);
    sum = nh_rate_form(o, sum, decisive);
    size_t limit = (size_t)options->proof_terms;
    bool longer = !proof.proved && prove_sum(o, sum, claim, limit, &proof);
    bool exact = true;
    for (size_t i = 0; i < n; i++) {
        valued[i] = nh_model_values(o, term[i]);
        exact = exact && nh_is_exact(d, valued[i]);
    }
    cancel(o, n, valued, options, &proof);
    if (longer && !proof.proved && proof.points > 0 && proof.digits >= options->digits)
        prove_sum(o, sum, claim, patience * limit, &proof);
    if (proof.proved) proof = with_values(o, proof, decisive);
    nh_free(decisive);
    /* numbers too long for exact rationals were rounded to doubles when the rate was formed */
    double doubt = options->digits / 2;
    proof.rounded = !exact;
    proof.sided = proof.proved && nh_model_paired_roots(o, sum) != sum;
    if (!exact && doubt > double_digits) doubt = double_digits;
    proof.refuted = !proof.proved && proof.points > 0 && proof.digits < doubt;
    /* digits of a stand-in say nothing of other functions */
    if (!proof.proved && nh_declared_unspecified(d)) proof.digits = fmin(proof.digits, double_digits);
    nh_free(valued);
    return proof;
}

nh_proof nh_proof_both(const nh_model *o, nh_proof a, nh_proof b)
{
    nh_proof out = {.proved = a.proved && b.proved,
                    .all_parameters = a.all_parameters && b.all_parameters,
                    .digits = fmin(a.digits, b.digits)};
    const nh_ex *of_a = a.all_parameters || a.fixed ? a.fixed : nh_fixed_every(o),
                *of_b = b.all_parameters || b.fixed ? b.fixed : nh_fixed_every(o);
    if (out.proved && !out.all_parameters) out.fixed = nh_fixed_both(o, of_a, of_b);
    out.points = a.points < b.points ? a.points : b.points;
    out.rounded = a.rounded || b.rounded;
    out.refuted = a.refuted || b.refuted;
    return out;
}

nh_proof nh_prove_zero(const nh_model *o, size_t n, const nh_ex *term, bool parameters_free, const nh_options *options)
{
    return prove_zero(o, n, term, (nh_proof){0}, (nh_claim){.free = parameters_free}, options);
}

static bool is_identity(const nh_model *o, nh_ex e, nh_claim claim, const nh_options *options)
{
    e = claim.free ? with_symbols(o, claim.fixed, e) : nh_model_values(o, e);
    return nh_normal_is_zero(o->dag, e, (size_t)options->proof_terms) == NH_ZERO;
}

/* Are X_0(Phi) + A_i zeta^i and Y_j(Phi) - M_ij zeta^i zero?  Then so is Gamma(Phi) = X_0(Phi) + a^j Y_j(Phi), by M a =
 * A and without M^-1, which is what makes Gamma(Phi) long [docs/method.md, (6), (11)].  The former is shorter in all
 * coordinates where L is invariant. */
static bool equations_hold(const nh_model *o, nh_ex phi, const nh_ex *zeta, nh_claim claim, const nh_options *options)
{
    nh_dag *d = o->dag;
    nh_ex rate;
    bool holds = true;
    for (size_t j = 0; j <= o->n && holds; j++) {
        nh_ex e = j < o->n ? nh_model_Y(o, j, phi) : nh_model_X0(o, phi);
        for (size_t i = 0; i < o->n; i++)
            e = j < o->n ? nh_sub(d, e, nh_mul(d, o->M[i * o->n + j], zeta[i]))
                         : nh_add(d, e, nh_mul(d, o->A[i], zeta[i]));
        bool short_too = j == o->n && nh_noether_equation(o, phi, zeta, &rate);
        holds = (short_too && is_identity(o, rate, claim, options)) || is_identity(o, e, claim, options);
    }
    return holds;
}

/* The field of a current that is a multiple of a momentum, by a constant of which only the value is known so far:
 * Y_j(Phi) and M_ij zeta^i have the ratio s. */
static void scale(const nh_model *o, nh_ex phi, nh_ex *zeta)
{
    nh_dag *d = o->dag;
    for (size_t j = 0; j < o->n; j++) {
        nh_ex sum = nh_int(d, 0);
        for (size_t i = 0; i < o->n; i++) sum = nh_add(d, sum, nh_mul(d, o->M[i * o->n + j], zeta[i]));
        sum = nh_simplify_short(d, sum, 0);
        if (nh_is_zero(d, sum)) continue;
        nh_ex s = nh_simplify_short(d, nh_div(d, nh_model_Y(o, j, phi), sum), 0);
        bool constant = !nh_depends(d, s, o->system->t);
        for (size_t k = 0; k < o->m; k++) constant &= !nh_depends(d, s, o->system->coordinate[k].q);
        for (size_t i = 0; i < o->n; i++) constant &= !nh_depends(d, s, o->chart->w[i]);
        for (size_t i = 0; i < o->n && constant; i++) zeta[i] = nh_mul(d, s, zeta[i]);
        return;
    }
}

/* Energies and momenta have fields with short components however long the accelerations are. */
static bool proved_by_symmetry(const nh_model *o, nh_ex phi, nh_claim claim, const nh_options *options)
{
    enum { longest = 40 };
    nh_ex *zeta = nh_alloc_array(o->n + 1, sizeof *zeta);
    bool holds = o->n > 0;
    bool affine = holds && nh_affine_field(o, phi, options, zeta);
    if (affine && claim.free) scale(o, phi, zeta);
    if (affine && equations_hold(o, phi, zeta, claim, options)) {
        nh_free(zeta);
        return true;
    }
    if (holds) nh_symmetry_components(o, phi, zeta);
    for (size_t i = 0; i < o->n && holds; i++) holds = nh_complexity(o->dag, zeta[i]) <= longest;
    holds = holds && equations_hold(o, phi, zeta, claim, options);
    nh_free(zeta);
    return holds;
}

void nh_rate_terms(const nh_model *o, nh_ex phi, nh_ex *term)
{
    nh_dag *d = o->dag;
    term[0] = nh_diff(d, phi, o->system->t);
    for (size_t s = 0; s < o->m; s++) term[1 + s] = nh_mul(d, o->rho[s], nh_diff(d, phi, o->system->coordinate[s].q));
    for (size_t i = 0; i < o->n; i++) term[1 + o->m + i] = nh_mul(d, o->a[i], nh_model_Y(o, i, phi));
}

double nh_prove_digits(const nh_model *o, nh_ex phi, const nh_options *options)
{
    size_t n = 1 + o->m + o->n;
    nh_ex *term = nh_alloc_array(n, sizeof *term);
    nh_proof proof = {0};
    nh_rate_terms(o, phi, term);
    for (size_t i = 0; i < n; i++) term[i] = nh_model_values(o, term[i]);
    cancel(o, n, term, options, &proof);
    nh_free(term);
    return proof.digits;
}

nh_proof nh_prove_claim(const nh_model *o, nh_ex phi, nh_claim claim, const nh_options *options)
{
    enum { long_rate = 2000 }; /* nh_complexity */
    size_t n = 1 + o->m + o->n, length = 0;
    nh_ex *term = nh_alloc_array(n, sizeof *term);
    nh_rate_terms(o, phi, term);
    for (size_t j = 0; j < n; j++) length += nh_complexity(o->dag, term[j]);
    nh_proof proof = {0};
    claim.rounded = !nh_is_exact(o->dag, nh_model_values(o, phi));
    if (claim.rounded) claim.related = false;
    if (claim.related) proof = holding(proof, claim.fixed);
    else if (claim.free && length > long_rate && nh_symmetry_is_energy(o, phi)) proof = holding(proof, NULL);
    else if (!claim.rounded && length > long_rate && proved_by_symmetry(o, phi, claim, options))
        proof = claim.free ? holding(proof, claim.fixed) : (nh_proof){.proved = true};
    proof = prove_zero(o, n, term, proof, claim, options);
    bool open = !proof.refuted && claim.free && !claim.rounded;
    /* a short rate with many roots can be harder than its field */
    bool general = proof.proved && (proof.all_parameters || claim.fixed);
    if (open && !general && length <= long_rate && proved_by_symmetry(o, phi, claim, options))
        proof = holding(proof, claim.fixed);
    /* a field may be known for the values only */
    if (open && !proof.proved && length > long_rate)
        proof.proved = proved_by_symmetry(o, phi, (nh_claim){.fixed = claim.fixed}, options);
    nh_free(term);
    return proof;
}

nh_proof nh_prove_current(const nh_model *o, nh_ex phi, bool parameters_free, const nh_options *options)
{
    return nh_prove_claim(o, phi, (nh_claim){.free = parameters_free}, options);
}

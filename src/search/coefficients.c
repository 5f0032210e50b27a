/* coefficients: the attempts, in their order.
 *
 *     refine              many digits; below the option `digits` it is no current
 *     relation_of         sum_j c_j Gamma(b_j) = 0 over the parameters            (15), integrals/fixed.h
 *                         with letters for numbers inside of terms                (15b), integrals/letters.h
 *                         with the coefficients of its field, where (15) is too large   (15c), integrals/companion.h
 *                         modulo primes, for all parameters                                   count/lift.h
 *     recognise           each coefficient by itself as a simple number */
#include "search/coefficients.h"

#include <math.h>
#include <string.h>

#include "count/lift.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/node.h"
#include "integrals/companion.h"
#include "integrals/fixed.h"
#include "integrals/prove.h"
#include "integrals/recognise.h"
#include "integrals/refine.h"

/* The factors of a product that are parameters. */
static nh_ex parameters_in(const nh_model *model, nh_ex e)
{
    nh_dag *d = model->dag;
    nh_ex all = nh_int(d, 1);
    if (nh_kind_of(d, e) != NH_PRODUCT) return all;
    for (size_t k = 0; k < nh_arity(d, e); k++) {
        nh_ex base = nh_child(d, e, k), factor = nh_pow(d, base, nh_exponent_of(d, e, k));
        bool parameter = false;
        for (size_t i = 0; i < model->system->parameters; i++) parameter |= base == model->parameter[i];
        if (parameter) all = nh_mul(d, all, factor);
    }
    return all;
}

/* Coefficients for all parameters by residues, which long rates do not hinder, and that proves to be conserved. */
static bool lifted(const nh_model *model, const nh_candidate *c, const nh_options *options, nh_ex *out)
{
    enum { most_terms = 60 };
    static const double part = 0.01; /* of the work of a construction */
    static const double larger = 50; /* proofs: what residues give is seldom false */
    nh_dag *d = model->dag;
    size_t n = c->count;
    nh_options wide = *options;
    wide.proof_terms *= larger;
    if (n > most_terms) return false;
    nh_ex term[most_terms], factor[most_terms], phi = nh_int(d, 0);
    double like[most_terms];
    for (size_t j = 0; j < n; j++) {
        factor[j] = parameters_in(model, c->term[j]);
        term[j] = nh_div(d, c->term[j], factor[j]);
        like[j] = c->coefficient[j] * nh_model_number(model, factor[j]);
    }
    if (!nh_lift_coefficients(model, n, term, like, c->pivot, part * options->construct, out)) return false;
    for (size_t j = 0; j < n; j++) {
        phi = nh_add(d, phi, nh_mul(d, out[j], term[j]));
        out[j] = nh_div(d, out[j], factor[j]);
    }
    return nh_prove_current(model, phi, true, &wide).all_parameters;
}

/* The relation of the terms' rates.  Where it needs values of parameters, or has no exact numbers, the numbers inside
 * of terms are replaced by names. */
static nh_fixed relation_of(const nh_model *model, const nh_candidate *c, const nh_options *options, nh_ex *out,
                            nh_letters *letters)
{
    bool rounded = false;
    nh_ex *rate = nh_alloc_array(c->count + 1, sizeof *rate);
    for (size_t j = 0; j < c->count; j++) {
        rate[j] = nh_model_paired_roots(model, nh_model_gamma(model, c->term[j]));
        rounded = rounded || !nh_is_short(model->dag, c->term[j]);
    }
    nh_fixed relation = (c->by_values ? nh_fixed_relation_by_values : nh_fixed_relation)(model, c->count, rate,
                                                                                         c->coefficient, options, out);
    if (!relation.all_parameters && (rounded || !relation.too_large)) {
        nh_fixed named = nh_letters_relation(model, c->count, c->term, c->coefficient, options, rate, letters);
        if (named.found) relation = named;
        if (named.found) memcpy(out, rate, c->count * sizeof *out);
        else letters->count = 0;
    }
    if (relation.too_large) {
        nh_ex *shown = nh_alloc_array(c->count + 1, sizeof *shown);
        memcpy(shown, out, c->count * sizeof *shown);
        nh_fixed shorter = relation.found ? nh_companion_relation(model, c->count, c->term, options, shown)
                                          : nh_companion_relation_nearby(model, c->count, c->term, rate, c->coefficient,
                                                                         options, shown);
        if (shorter.found) memcpy(rate, shown, c->count * sizeof *shown);
        nh_free(shown);
        if (shorter.found) relation = shorter;
        if (shorter.found) memcpy(out, rate, c->count * sizeof *out);
    }
    if (!relation.all_parameters && lifted(model, c, options, rate)) {
        relation = (nh_fixed){.found = true, .all_parameters = true};
        letters->count = 0;
        memcpy(out, rate, c->count * sizeof *out);
    }
    nh_free(rate);
    return relation;
}

/* Exact coefficients: the rates of the support's terms are linearly related over the field of the parameters, some of
 * which keep their given values where that is needed. */
static bool exact_coefficients(const nh_model *model, const nh_candidate *c, const nh_options *options, nh_ex *out,
                               nh_claim *claim, nh_letters *letters)
{
    nh_fixed relation = relation_of(model, c, options, out, letters);
    for (size_t j = 0; j < c->count && relation.fixed && relation.found && !relation.too_large; j++)
        c->term[j] = nh_fixed_values(model, relation.fixed, c->term[j]);
    *claim = (nh_claim){.free = true, .fixed = relation.fixed, .related = relation.found};
    /* other values are not considered: the proof may be shorter than the relation */
    if (relation.too_large) *claim = (nh_claim){.free = true};
    return relation.found;
}

/* ---- many digits ---- */

/* The same up to a millionth of the largest? */
static bool near(size_t n, const double *a, const double *b)
{
    double largest = 0, worst = 0;
    for (size_t j = 0; j < n; j++) {
        largest = fmax(largest, fabs(a[j]));
        worst = fmax(worst, fabs(a[j] - b[j]));
    }
    return worst <= 1e-6 * largest;
}

/* Drops terms that are conserved by themselves, which leave the others' coefficients undetermined; one term stays. */
static bool drop_constant_terms(const nh_model *model, nh_candidate *c, const nh_options *options)
{
    nh_dag *d = model->dag;
    size_t n = 0, pivot = 0, before = c->count;
    for (size_t j = 0; j < before; j++) {
        bool constant = j != c->pivot && nh_normal_is_zero(d, nh_model_gamma(model, c->term[j]),
                                                           (size_t)options->proof_terms) == NH_ZERO;
        if (constant) continue;
        if (j == c->pivot) pivot = n;
        c->term[n] = c->term[j];
        c->coefficient[n++] = c->coefficient[j];
    }
    c->count = n;
    c->pivot = pivot;
    return n < before;
}

/* Numbers inside of terms first, then the coefficients, that of the pivot being 1. */
static nh_refined refine_terms(const nh_model *model, const nh_candidate *c, const nh_options *options)
{
    bool *leading = nh_alloc_array(c->count + 1, sizeof *leading);
    leading[c->pivot] = true;
    nh_refine_numbers(model, c->count, c->term, c->coefficient, c->pivot, options);
    nh_refined better = nh_refine(model, c->count, c->term, leading, options);
    nh_free(leading);
    return better;
}

/* Drops terms whose coefficients vanish: they may have relations of their own. */
static void drop_zeros(nh_candidate *c)
{
    size_t n = 0, pivot = 0;
    for (size_t j = 0; j < c->count; j++) {
        if (c->coefficient[j] == 0 && j != c->pivot) continue;
        if (j == c->pivot) pivot = n;
        c->term[n] = c->term[j];
        c->coefficient[n++] = c->coefficient[j];
    }
    c->count = n;
    c->pivot = pivot;
}

static void refine(const nh_model *model, nh_candidate *c, const nh_options *options, nh_current *f)
{
    nh_refined better = refine_terms(model, c, options);
    if (better.count == 0 && drop_constant_terms(model, c, options)) {
        nh_refined_clear(&better);
        better = refine_terms(model, c, options);
    }
    f->asked = true;
    f->refined = better.count ? better.digits[0] : -1;
    /* a combination of the same terms, but not the one of doubles */
    f->moved = better.count && !near(c->count, c->coefficient, better.coefficient);
    if (better.count) memcpy(c->coefficient, better.coefficient, c->count * sizeof *c->coefficient);
    if (better.count) drop_zeros(c);
    nh_refined_clear(&better);
}

/* ---- the whole ---- */

/* sum_j k_j b_j, or with the fitted coefficients. */
static nh_ex combination(nh_dag *d, const nh_candidate *c, const nh_ex *k)
{
    nh_ex phi = nh_int(d, 0);
    for (size_t j = 0; j < c->count; j++)
        phi = nh_add(d, phi, nh_mul(d, k ? k[j] : nh_real(d, c->coefficient[j]), c->term[j]));
    return phi;
}

bool nh_coefficients_certain(const nh_current *f, const nh_options *options)
{
    return f->proof.proved || f->proof.digits >= options->digits;
}

bool nh_coefficients_refuted(const nh_current *f, const nh_options *options)
{
    return f->asked && f->refined >= 0 && f->refined < options->digits && !nh_coefficients_certain(f, options);
}

nh_ex nh_coefficients_assemble(const nh_model *model, nh_candidate *c, const nh_options *options, nh_current *f,
                               nh_claim *claim)
{
    nh_dag *d = model->dag;
    nh_ex *k = nh_alloc_array(c->count + 1, sizeof *k);
    bool many = c->count > 1;               /* one term has no coefficients to refine */
    if (many) refine(model, c, options, f); /* relations of many terms cost more */
    bool hopeless = many && f->refined >= 0 && f->refined < options->digits;
    f->exact = !hopeless && exact_coefficients(model, c, options, k, claim, &f->letters);
    if (!many && !f->exact) refine(model, c, options, f);
    if (!f->exact) {
        f->exact = true;
        for (size_t j = 0; j < c->count; j++)
            f->exact &= nh_recognise_number(d, c->coefficient[j], options->recognise, &k[j]);
    }
    if (!claim->related) *claim = (nh_claim){.free = f->exact};
    nh_ex phi = combination(d, c, f->exact ? k : NULL);
    nh_free(k);
    return phi;
}

void nh_coefficients_certify(const nh_options *options, nh_current *f)
{
    f->printed_digits = f->proof.digits;
    if (nh_coefficients_certain(f, options)) return;
    if (f->refined < options->digits) return;
    f->proof.digits = f->refined;
    f->proof.refuted = false;
}

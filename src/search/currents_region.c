/* currents_region: currents that hold for a part of the motions only, and how they are continued. */
#include <math.h>

#include "exact/normal.h"
#include "exact/square.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/num.h"
#include "search/counted.h"
#include "search/currents.h"

static nh_region region_of(nh_current_checker *checker, nh_ex phi, double digits, bool sided)
{
    nh_analysis *result = checker->result;
    if (!checker->searched)
        checker->terrain = nh_terrain_of(result->question->model, &result->question->options, result->arena);
    checker->searched = true;
    return nh_region_of(result->question->model, &checker->terrain, phi, digits, sided, &result->question->options,
                        result->arena);
}

const char *nh_currents_region(nh_current_checker *checker, nh_ex phi, double digits, bool *to_the_end)
{
    nh_region region = region_of(checker, phi, digits, false);
    if (to_the_end) *to_the_end = nh_region_to_the_end(&region);
    return nh_region_text(checker->result->question->model->dag, &region, checker->result->arena);
}

const char *nh_currents_hold(nh_current_checker *checker, nh_current *f)
{
    const nh_model *model = checker->result->question->model;
    const nh_options *options = &checker->result->question->options;
    bool everywhere = f->proof.proved && !f->proof.sided;
    /* a formula that cancels to fewer digits as printed cannot be required to do better */
    nh_region region =
        region_of(checker, f->phi, everywhere ? 0 : fmax(NH_LEAST_ALMOST, fmin(f->printed_digits, options->digits) / 2),
                  f->proof.sided);
    if (region.count && !f->proof.proved) {
        size_t n = 1 + model->m + model->n;
        nh_ex *term = nh_alloc_array(n, sizeof *term);
        nh_rate_terms(model, f->phi, term);
        for (size_t j = 0; j < n; j++) term[j] = nh_region_piece(model, &region, term[j]);
        nh_proof proof = nh_prove_zero(model, n, term, f->exact, options);
        if (proof.proved) f->proof = proof;
        nh_free(term);
    }
    f->to_the_end = nh_region_to_the_end(&region);
    f->counted = nh_region_has_probe(model, &region);
    return nh_region_text(model->dag, &region, checker->result->arena);
}

/* ---- continued through its walls ----
 *
 * z' sqrt(x^2/y^2 + 1) is constant on each side of y = 0 and changes its sign there.  With the square taken out of the
 * root it is z' sqrt(x^2 + y^2)/y: the same function on one side, up to the sign that the root has there, and an
 * analytic one through the wall, so that it is a current on both sides if it is one on either, as long as the equations
 * of motion go through as well. */

/* base = outside^2 inside, from its numerator and denominator; false where there is no square. */
static bool take_out(nh_dag *d, nh_ex base, nh_ex *outside, nh_ex *inside)
{
    nh_ex out[2], in[2];
    nh_ex top = nh_numerator(d, base);
    if (!nh_square_split(d, nh_simplify_short(d, top, 0), &out[0], &in[0]) ||
        !nh_square_split(d, nh_simplify_short(d, nh_div(d, top, base), 0), &out[1], &in[1]))
        return false;
    *outside = nh_div(d, out[0], out[1]);
    *inside = nh_simplify_short(d, nh_div(d, in[0], in[1]), 0);
    return nh_kind_of(d, *outside) != NH_NUMBER;
}

/* phi with sqrt(u^2 v) as u sqrt(v) or -u sqrt(v), whichever it is at the first probe of the chart; phi itself where no
 * root has a square in it. */
static nh_ex continued_roots(const nh_model *model, nh_ex phi)
{
    nh_dag *d = model->dag;
    NH_LIST(base);
    nh_ex outside, inside;
    size_t n = nh_radicands_in(d, phi, &base);
    for (size_t i = 0; i < n; i++) {
        if (nh_kind_of(d, base[i]) <= NH_SYMBOL || !take_out(d, base[i], &outside, &inside)) continue;
        nh_ex root = nh_mul(d, outside, nh_sqrt(d, inside));
        int sign = nh_model_sign_at_probe(model, nh_div(d, root, nh_sqrt(d, base[i])));
        if (sign) phi = nh_substitute_root(d, phi, base[i], sign > 0 ? root : nh_neg(d, root));
    }
    return phi;
}

/* -atan(1/u), which is smooth where u is infinite, in the place of atan(u): they differ by pi/2 on one side, by -pi/2
 * on the other. */
static nh_ex continued_arctangent(void *dag, nh_ex call)
{
    if (nh_function_of(dag, call) != NH_ATAN) return 0;
    nh_ex turned = nh_simplify_short(dag, nh_div(dag, nh_int(dag, 1), nh_child(dag, call, 0)), 0);
    return nh_neg(dag, nh_call(dag, NH_ATAN, turned));
}

/* Is there one arctangent in phi only, and is phi = rest + factor * atan(u)? */
static bool only_arctangent(nh_dag *d, nh_ex phi, nh_ex *call, nh_ex *rest, nh_ex *factor)
{
    enum { most = 64 };
    NH_LIST(all);
    nh_ex zero = nh_int(d, 0), angle = nh_symbol_fresh(d, "angle");
    size_t n = nh_functions_in(d, phi, &all), found = 0;
    for (size_t i = 0; i < n; i++)
        if (nh_function_of(d, all[i]) == NH_ATAN) *call = all[i], found++;
    if (found != 1 || n > most) return false;
    nh_ex e = nh_substitute(d, phi, 1, call, &angle);
    *factor = nh_diff(d, e, angle);
    *rest = nh_substitute(d, e, 1, &angle, &zero);
    return !nh_depends(d, *factor, angle);
}

/* u = A/B, from the factors of u. */
static void split_quotient(nh_dag *d, nh_ex u, nh_ex *A, nh_ex *B)
{
    *A = nh_numerator(d, u);
    *B = nh_int(d, 1);
    if (nh_kind_of(d, u) == NH_PRODUCT) {
        *A = nh_number(d, nh_constant_of(d, u));
        for (size_t i = 0; i < nh_arity(d, u); i++) {
            nh_ex base = nh_child(d, u, i), power = nh_exponent_of(d, u, i);
            bool below = nh_kind_of(d, power) == NH_NUMBER && nh_num_value(nh_number_of(d, power)) < 0;
            if (below) *B = nh_mul(d, *B, nh_pow(d, base, nh_neg(d, power)));
            else *A = nh_mul(d, *A, nh_pow(d, base, power));
        }
    } else {
        *B = nh_simplify_short(d, nh_div(d, *A, u), 0);
    }
}

static bool is_constant(const nh_model *model, nh_ex e)
{
    return nh_normal_is_zero(model->dag, nh_model_gamma(model, e), 0) == NH_ZERO;
}

/* Coordinates, exponentials, sines, cosines and tangents in e. */
static size_t letters_of(const nh_model *model, nh_ex e, size_t most, nh_ex *letter)
{
    enum { most_calls = 8 };
    nh_dag *d = model->dag;
    NH_LIST(call);
    size_t calls = nh_functions_in(d, e, &call), count = 0;
    for (size_t i = 0; i < calls && calls <= most_calls && count + 2 < most; i++) {
        nh_function f = nh_function_of(d, call[i]);
        if (f == NH_EXP) letter[count++] = call[i];
        if (f != NH_SIN && f != NH_COS && f != NH_TAN) continue;
        letter[count++] = nh_call(d, NH_SIN, nh_child(d, call[i], 0));
        letter[count++] = nh_call(d, NH_COS, nh_child(d, call[i], 0));
        letter[count++] = nh_call(d, NH_TAN, nh_child(d, call[i], 0));
    }
    for (size_t i = 1; i <= model->m && count < most; i++)
        if (nh_depends(d, e, model->chart->symbol[i])) letter[count++] = model->chart->symbol[i];
    return count;
}

/* The root of the factor by which e must be divided to be a constant of the motion: 1, or a power of a letter, which
 * may change its sign; 0: there is none. */
static nh_ex root_of_scale(const nh_model *model, nh_ex e)
{
    enum { most = 24, highest = 4 };
    nh_dag *d = model->dag;
    nh_ex letter[most];
    if (is_constant(model, e)) return nh_int(d, 1);
    size_t letters = letters_of(model, e, most, letter);
    for (int power = 1; power <= highest; power++)
        for (size_t i = 0; i < 2 * letters; i++) {
            int own = i % 2 ? -power : power;
            if (!is_constant(model, nh_div(d, e, nh_powi(d, letter[i / 2], own)))) continue;
            return nh_pow(d, letter[i / 2], nh_ratio(d, own, 2));
        }
    return 0;
}

/* phi = r + c atan(A/B), where c is a constant of the motion, as sin(r/c + atan(A/B)) times S, or alone where S is not
 * constant: A cos(r/c) + B sin(r/c), which goes on however often the angle turns round.  S^2 = A^2 + B^2; phi itself
 * where it has another number of arctangents. */
static nh_ex continued_turns(const nh_model *model, nh_ex phi)
{
    nh_dag *d = model->dag;
    nh_ex call, rest, factor, A, B, outside, inside;
    if (!only_arctangent(d, phi, &call, &rest, &factor)) return phi;
    split_quotient(d, nh_child(d, call, 0), &A, &B);
    nh_ex sum = nh_simplify_short(d, nh_add(d, nh_powi(d, A, 2), nh_powi(d, B, 2)), 0);
    if (!nh_square_split(d, sum, &outside, &inside)) return phi;
    nh_ex angle = nh_simplify_short(d, nh_div(d, rest, factor), 0), S = nh_int(d, 1);
    if (!is_constant(model, sum)) {
        nh_ex root = root_of_scale(model, inside);
        S = nh_mul(d, outside, root ? root : nh_sqrt(d, inside));
    }
    A = nh_simplify_short(d, nh_div(d, A, S), 0);
    B = nh_simplify_short(d, nh_div(d, B, S), 0);
    return nh_add(d, nh_mul(d, A, nh_call(d, NH_COS, angle)), nh_mul(d, B, nh_call(d, NH_SIN, angle)));
}

/* Can the same current be written so that it passes through its walls?  Then it must be proved again, and hold
 * everywhere; perhaps for more parameter values, because it has no roots and arctangents whose branches must agree. */
static bool goes_through(nh_current_checker *checker, nh_current *f, nh_ex phi)
{
    nh_model *model = checker->result->question->model;
    nh_claim claim = {.free = f->exact, .fixed = f->proof.fixed};
    if (phi == f->phi) return false;
    nh_proof proof = nh_prove_claim(model, phi, claim, &checker->result->question->options);
    if (!proof.proved || nh_currents_region(checker, phi, 0, NULL)) return false;
    f->phi = nh_simplify_short(model->dag, phi, 0);
    f->proof = proof;
    return true;
}

bool nh_currents_continue(nh_current_checker *checker, nh_current *f)
{
    nh_model *model = checker->result->question->model;
    if (!f->proof.proved) return false;
    if (goes_through(checker, f, continued_roots(model, f->phi)) ||
        goes_through(checker, f, nh_substitute_calls(model->dag, f->phi, continued_arctangent, model->dag)))
        return true;
    /* a polynomial in the velocities, such as the energy in a potential atan(y/x), is counted as one */
    return isinf(nh_counted_degree_of(model, f->phi)) && goes_through(checker, f, continued_turns(model, f->phi));
}

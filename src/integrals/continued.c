/* continued: other forms of a function, equal up to a constant or sign on a part, that go through a wall.
 *
 *     roots         sqrt(u^2 v)    ->  +-u sqrt(v)
 *     arctangents   atan(u)        ->  -atan(1/u), moved by pi/2
 *     turns         r + c atan(A/B) constant  ->  (A cos(r/c) + B sin(r/c))/S, S^2 = A^2 + B^2
 *
 * [docs/method.md, sec. 4, "Quadratures"] */
#include "integrals/continued.h"

#include <math.h>

#include "exact/normal.h"
#include "exact/square.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/num.h"
#include "system/sample.h"

/* The sign of a quotient at a point of the box where it has one: 1 or -1; 0 where none was found. */
static int sign_in_box(const nh_model *model, nh_ex quotient, uint64_t state)
{
    enum { tries = 20 };
    const nh_chart *c = model->chart;
    nh_tape *tape = nh_model_tape(model, 1, &quotient);
    nh_tape_work *work = nh_tape_work_create(tape);
    double *z = nh_alloc_array(model->width, sizeof *z), value = NAN;
    for (int k = 0; k < tries && !(isfinite(value) && value != 0); k++) {
        for (size_t j = 0; j < model->width; j++) z[j] = c->low[j] + (c->high[j] - c->low[j]) * nh_random(&state);
        if (nh_chart_complete(c, z)) nh_tape_eval(tape, work, z, &value);
    }
    nh_free(z);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    return !isfinite(value) || value == 0 ? 0 : value > 0 ? 1 : -1;
}

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

nh_ex nh_continued_roots(const nh_model *model, nh_ex phi, uint64_t seed)
{
    nh_dag *d = model->dag;
    NH_LIST(base);
    nh_ex outside, inside;
    size_t n = nh_radicands_in(d, phi, &base);
    for (size_t i = 0; i < n; i++) {
        if (nh_kind_of(d, base[i]) <= NH_SYMBOL || !take_out(d, base[i], &outside, &inside)) continue;
        nh_ex root = nh_mul(d, outside, nh_sqrt(d, inside));
        int sign = sign_in_box(model, nh_div(d, root, nh_sqrt(d, base[i])), seed);
        if (sign) phi = nh_substitute_root(d, phi, base[i], sign > 0 ? root : nh_neg(d, root));
    }
    return phi;
}

nh_ex nh_continued_arctangents(const nh_model *model, nh_ex phi)
{
    enum { most = 64 };
    nh_dag *d = model->dag;
    NH_LIST(call);
    nh_ex by[most];
    size_t n = nh_functions_in(d, phi, &call), count = 0;
    for (size_t i = 0; i < n && i < most; i++) {
        if (nh_function_of(d, call[i]) != NH_ATAN) continue;
        nh_ex turned = nh_simplify_short(d, nh_div(d, nh_int(d, 1), nh_child(d, call[i], 0)), 0);
        by[count] = nh_neg(d, nh_call(d, NH_ATAN, turned));
        call[count++] = call[i];
    }
    return nh_substitute(d, phi, count, call, by);
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
static void sides(nh_dag *d, nh_ex u, nh_ex *A, nh_ex *B)
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

nh_ex nh_continued_turns(const nh_model *model, nh_ex phi)
{
    nh_dag *d = model->dag;
    nh_ex call, rest, factor, A, B, outside, inside;
    if (!only_arctangent(d, phi, &call, &rest, &factor)) return phi;
    sides(d, nh_child(d, call, 0), &A, &B);
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

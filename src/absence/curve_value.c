#include "absence/curve_value.h"

#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/num.h"
#include "graph/num_long.h"

static const char irrational[] = "irrational numbers remain", roots_remain[] = "roots remain on the plane",
                  transcendental[] = "functions that are not rational remain on the plane",
                  pole[] = "the plane lies in a pole of the equations";

/* Engines take polynomials of degree 60; those that are longer only cost time.  A turn has degree 2 in tan(x/2). */
enum { most_length = 80, most_turns = 32 };

typedef struct {
    const nh_curve_place *place;
    size_t count;
    const nh_ex *node; /* ascending: children first */
    nh_curve_element *value;
    nh_curve_state *state;
    const char **why;
} evaluation;

static size_t index_of(const evaluation *v, nh_ex e)
{
    size_t low = 0, high = v->count;
    while (low + 1 < high) {
        size_t middle = low + (high - low) / 2;
        if (v->node[middle] <= e) low = middle;
        else high = middle;
    }
    return low;
}

static void note(evaluation *v, size_t k, nh_curve_state state, const char *why)
{
    v->state[k] = state;
    v->why[k] = why;
}

static void set_number(nh_num a, fmpq_t out)
{
    mpq_t q;
    mpq_init(q);
    nh_num_get_mpq(q, a);
    fmpq_set_mpq(out, q);
    mpq_clear(q);
}

static void number(evaluation *v, size_t k, nh_num a)
{
    if (!nh_num_exact(a)) {
        note(v, k, NH_CURVE_SINGULAR, "rounded numbers remain");
        return;
    }
    fmpq_t q;
    fmpq_init(q);
    set_number(a, q);
    nh_curve_field_set_fmpq(&v->value[k], q);
    fmpq_clear(q);
}

static bool is_zero_symbol(const nh_curve_place *place, nh_ex e)
{
    for (size_t i = 0; i < place->zeros; i++)
        if (e == place->zero[i]) return true;
    return false;
}

static void symbol(evaluation *v, size_t k)
{
    const nh_curve_place *place = v->place;
    nh_ex e = v->node[k];
    if (is_zero_symbol(place, e) || (e == place->velocity && place->rest)) {
        nh_curve_field_set_si(&v->value[k], 0);
    } else if (e == place->velocity) {
        nh_curve_field_set_w(&v->value[k]);
    } else if (e == place->coordinate) {
        if (place->angle) note(v, k, NH_CURVE_UNKNOWN, "an angle remains outside of sines and cosines");
        else nh_curve_field_set_x(&v->value[k]);
    } else {
        note(v, k, NH_CURVE_UNKNOWN, "letters without a value remain");
    }
}

static void sum(evaluation *v, size_t k)
{
    nh_dag *dag = v->place->dag;
    nh_ex e = v->node[k];
    number(v, k, nh_constant_of(dag, e));
    fmpq_t c;
    nh_curve_element term;
    fmpq_init(c);
    nh_curve_field_element_init(&term);
    for (size_t i = 0; i < nh_arity(dag, e); i++) {
        size_t child = index_of(v, nh_child(dag, e, i));
        nh_num coefficient = nh_coefficient_of(dag, e, i);
        nh_curve_state state = nh_num_exact(coefficient) ? v->state[child] : NH_CURVE_SINGULAR;
        if (state > v->state[k]) note(v, k, state, v->why[child]);
        if (v->state[k] != NH_CURVE_FINE) continue;
        set_number(coefficient, c);
        nh_curve_field_scale(&term, &v->value[child], c);
        nh_curve_field_add(&v->value[k], &v->value[k], &term);
    }
    fmpq_clear(c);
    nh_curve_field_element_clear(&term);
}

/* base^x into `out`, base not in state NH_CURVE_SINGULAR.  A zero has whole powers that are positive only: others are
 * poles or branch points. */
static nh_curve_state power(const evaluation *v, size_t base, nh_ex exponent, nh_curve_element *out, const char **why)
{
    nh_dag *dag = v->place->dag;
    const nh_curve_element *b = &v->value[base];
    bool fine = v->state[base] == NH_CURVE_FINE, numeric = nh_kind_of(dag, exponent) == NH_NUMBER;
    nh_num x = numeric ? nh_number_of(dag, exponent) : nh_num_int(0);
    numeric = numeric && nh_num_short(x) && x.p < most_length && x.p > -most_length;
    bool whole = numeric && x.q == 1 && x.p > 0;
    *why = fine ? pole : v->why[base];
    if (!whole && (!fine || nh_curve_field_is_zero(b))) return NH_CURVE_SINGULAR;
    if (!fine) return NH_CURVE_UNKNOWN;
    *why = !numeric                                                        ? transcendental
           : fmpz_poly_length(b->even) > 1 || fmpz_poly_length(b->den) > 1 ? roots_remain
                                                                           : irrational;
    if (!numeric) return NH_CURVE_UNKNOWN;
    nh_curve_field_set(out, b);
    for (; x.q % 2 == 0; x.q /= 2)
        if (!nh_curve_field_sqrt(out, out, v->place->side)) return NH_CURVE_UNKNOWN;
    if (x.q != 1) return NH_CURVE_UNKNOWN;
    *why = pole;
    return nh_curve_field_pow(v->place->field, out, out, x.p) ? NH_CURVE_FINE : NH_CURVE_SINGULAR;
}

/* A factor 0 makes the product 0 where the others are finite. */
static void product(evaluation *v, size_t k)
{
    nh_dag *dag = v->place->dag;
    nh_ex e = v->node[k];
    bool zero = false;
    nh_curve_element factor;
    nh_curve_field_element_init(&factor);
    number(v, k, nh_constant_of(dag, e));
    for (size_t i = 0; i < nh_arity(dag, e); i++) {
        size_t base = index_of(v, nh_child(dag, e, i));
        const char *why = v->why[base];
        nh_curve_state state = v->state[base];
        if (state != NH_CURVE_SINGULAR) state = power(v, base, nh_exponent_of(dag, e, i), &factor, &why);
        if (state == NH_CURVE_FINE && nh_curve_field_is_zero(&factor)) zero = true;
        if (state > v->state[k]) note(v, k, state, why);
        if (v->state[k] == NH_CURVE_FINE) nh_curve_field_mul(v->place->field, &v->value[k], &v->value[k], &factor);
    }
    if (zero && v->state[k] == NH_CURVE_UNKNOWN) {
        note(v, k, NH_CURVE_FINE, NULL);
        nh_curve_field_set_si(&v->value[k], 0);
    }
    nh_curve_field_element_clear(&factor);
}

/* ---- sines and cosines ---- */

/* sine = 2 t/(1 + t^2), cosine = (1 - t^2)/(1 + t^2) */
static void half_angle(nh_curve_element *sine, nh_curve_element *cosine)
{
    nh_curve_field_set_si(sine, 0);
    nh_curve_field_set_si(cosine, 1);
    fmpz_poly_set_coeff_si(sine->even, 1, 2);
    fmpz_poly_set_coeff_si(cosine->even, 2, -1);
    fmpz_poly_set_coeff_si(sine->den, 2, 1);
    fmpz_poly_set_coeff_si(cosine->den, 2, 1);
}

/* (c, s) = (c1 c2 - s1 s2, s1 c2 + c1 s2) */
static void turn(const nh_curve_field *field, nh_curve_element *sine, nh_curve_element *cosine,
                 const nh_curve_element *by_sine, const nh_curve_element *by_cosine)
{
    nh_curve_element s, c, term;
    nh_curve_field_element_init(&s);
    nh_curve_field_element_init(&c);
    nh_curve_field_element_init(&term);
    nh_curve_field_mul(field, &s, sine, by_cosine);
    nh_curve_field_mul(field, &term, cosine, by_sine);
    nh_curve_field_add(&s, &s, &term);
    nh_curve_field_mul(field, &c, cosine, by_cosine);
    nh_curve_field_submul(field, &c, sine, by_sine);
    nh_curve_field_set(sine, &s);
    nh_curve_field_set(cosine, &c);
    nh_curve_field_element_clear(&s);
    nh_curve_field_element_clear(&c);
    nh_curve_field_element_clear(&term);
}

/* e with all letters that vanish on the curve at 0 */
static nh_ex on_plane(const nh_curve_place *place, nh_ex e)
{
    nh_ex *zero = nh_alloc_array(place->zeros + 1, sizeof *zero);
    for (size_t i = 0; i < place->zeros; i++) zero[i] = nh_int(place->dag, 0);
    e = nh_substitute(place->dag, e, place->zeros, place->zero, zero);
    nh_free(zero);
    return e;
}

/* Sine and cosine of k x + c pi into elements.  False: the argument is no such sum. */
static bool sine_of(const evaluation *v, nh_ex argument, nh_curve_element *sine, nh_curve_element *cosine)
{
    const nh_curve_place *place = v->place;
    nh_dag *dag = place->dag;
    nh_ex rest = on_plane(place, argument), part, first = nh_int(dag, 0), second = nh_int(dag, 1);
    /* a turn is found in a sum only */
    if (nh_split_turn(dag, nh_add(dag, rest, place->coordinate), &part, &first, &second))
        rest = nh_sub(dag, part, place->coordinate);
    if (nh_kind_of(dag, first) != NH_NUMBER || nh_kind_of(dag, second) != NH_NUMBER) return false;
    nh_num s = nh_number_of(dag, first), c = nh_number_of(dag, second);
    nh_ex slope = nh_diff(dag, rest, place->coordinate);
    if (nh_kind_of(dag, slope) != NH_NUMBER || !nh_num_exact(s) || !nh_num_exact(c)) return false;
    nh_num k = nh_number_of(dag, slope);
    if (k.q != 1 || k.p > most_turns || k.p < -most_turns || (k.p != 0 && !place->angle)) return false;
    if (!nh_is_zero(dag, nh_sub(dag, rest, nh_mul(dag, slope, place->coordinate)))) return false;
    fmpq_t q;
    nh_curve_element by[2];
    fmpq_init(q);
    set_number(s, q);
    nh_curve_field_set_fmpq(sine, q);
    set_number(c, q);
    nh_curve_field_set_fmpq(cosine, q);
    fmpq_clear(q);
    nh_curve_field_element_init(&by[0]);
    nh_curve_field_element_init(&by[1]);
    half_angle(&by[0], &by[1]);
    if (k.p < 0) fmpz_poly_neg(by[0].even, by[0].even);
    for (int64_t i = 0; i < (k.p < 0 ? -k.p : k.p); i++) turn(place->field, sine, cosine, &by[0], &by[1]);
    nh_curve_field_element_clear(&by[0]);
    nh_curve_field_element_clear(&by[1]);
    return true;
}

static void trigonometric(evaluation *v, size_t k, nh_function f, nh_ex argument)
{
    nh_curve_element sine, cosine;
    nh_curve_field_element_init(&sine);
    nh_curve_field_element_init(&cosine);
    if (!sine_of(v, argument, &sine, &cosine)) {
        note(v, k, f == NH_TAN ? NH_CURVE_SINGULAR : NH_CURVE_UNKNOWN, transcendental);
    } else if (f == NH_TAN) {
        if (!nh_curve_field_inv(v->place->field, &cosine, &cosine)) note(v, k, NH_CURVE_SINGULAR, pole);
        else nh_curve_field_mul(v->place->field, &v->value[k], &sine, &cosine);
    } else {
        nh_curve_field_set(&v->value[k], f == NH_SIN ? &sine : &cosine);
    }
    nh_curve_field_element_clear(&sine);
    nh_curve_field_element_clear(&cosine);
}

/* Functions of one argument that are analytic at 0, or at 1, and have a rational value there. */
static bool value_of_call(nh_function f, bool at_zero, bool at_one, slong *value)
{
    switch (f) {
    case NH_ASIN:
    case NH_ATAN:
    case NH_SINH:
    case NH_TANH:
    case NH_ASINH:
    case NH_ATANH: *value = 0; return at_zero;
    case NH_COSH:
    case NH_EXP: *value = 1; return at_zero;
    case NH_LOG: *value = 0; return at_one;
    default: return false;
    }
}

static void call(evaluation *v, size_t k)
{
    nh_dag *dag = v->place->dag;
    nh_ex e = v->node[k];
    nh_function f = nh_function_of(dag, e);
    if (f == NH_PI) {
        note(v, k, NH_CURVE_UNKNOWN, irrational);
        return;
    }
    nh_ex argument = nh_child(dag, e, 0);
    if (nh_arity(dag, e) == 1 && (f == NH_SIN || f == NH_COS || f == NH_TAN)) {
        trigonometric(v, k, f, argument);
        return;
    }
    size_t child = index_of(v, argument);
    bool entire = f == NH_EXP || f == NH_SINH || f == NH_COSH, zero = false, one = false;
    slong value = 0;
    if (v->state[child] == NH_CURVE_FINE) {
        zero = nh_curve_field_is_zero(&v->value[child]);
        one = fmpz_poly_is_one(v->value[child].even) && fmpz_poly_is_one(v->value[child].den) &&
              nh_curve_field_is_even(&v->value[child]);
    }
    if (nh_arity(dag, e) == 1 && value_of_call(f, zero, one, &value)) nh_curve_field_set_si(&v->value[k], value);
    else
        note(v, k, entire && v->state[child] != NH_CURVE_SINGULAR ? NH_CURVE_UNKNOWN : NH_CURVE_SINGULAR,
             transcendental);
}

/* What is too long has no value. */
static void shorten(evaluation *v, size_t k)
{
    const nh_curve_element *a = &v->value[k];
    bool long_one = fmpz_poly_length(a->even) > most_length || fmpz_poly_length(a->odd) > most_length ||
                    fmpz_poly_length(a->den) > most_length;
    if (v->state[k] == NH_CURVE_FINE && long_one) note(v, k, NH_CURVE_UNKNOWN, "the degree on the plane is too high");
}

static void value_of(evaluation *v, size_t k)
{
    nh_dag *dag = v->place->dag;
    switch (nh_kind_of(dag, v->node[k])) {
    case NH_NUMBER: number(v, k, nh_number_of(dag, v->node[k])); break;
    case NH_SYMBOL: symbol(v, k); break;
    case NH_SUM: sum(v, k); break;
    case NH_PRODUCT: product(v, k); break;
    case NH_FUNCTION: call(v, k); break;
    }
    shorten(v, k);
}

void nh_curve_value(const nh_curve_place *place, size_t n, const nh_ex *e, nh_curve_element *value,
                    nh_curve_state *state, const char **why)
{
    NH_LIST(node);
    size_t count = nh_nodes_in(place->dag, n, e, &node);
    evaluation v = {.place = place, .count = count, .node = node, .value = nh_curve_field_elements(count)};
    v.state = nh_alloc_array(count + 1, sizeof *v.state);
    v.why = nh_alloc_array(count + 1, sizeof *v.why);
    for (size_t k = 0; k < count; k++) value_of(&v, k);
    for (size_t i = 0; i < n; i++) {
        size_t k = index_of(&v, e[i]);
        state[i] = v.state[k];
        if (why) why[i] = v.why[k];
        if (state[i] == NH_CURVE_FINE) nh_curve_field_set(&value[i], &v.value[k]);
    }
    nh_curve_field_elements_free(v.value, count);
    nh_free(v.state);
    nh_free(v.why);
}

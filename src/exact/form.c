/* An expression as a quotient of polynomials in kernels (form.h), in four steps:
 *
 *      e  -- rewrite -->            arguments, radicands and exponents canonical, each by a form of its own
 *         -- collect, settle -->    kernels k_1 .. k_n: sin and cos of x/6 for sin(x/2) and cos(x/3)    kernel.c
 *         -- relate -->             sin^2 = 1 - cos^2, r^m = radicand, sqrt(a b) = sqrt(a) sqrt(b), ..
 *         -- nh_form_eval -->       num/den in Z[k_1 .. k_n], reduced by the relations             form_eval.c */
#include "exact/form.h"

#include <math.h>

#include "graph/dag_internal.h"
#include "exact/named_relation.h"
#include "exact/print_quotient.h"
#include "graph/dag.h"
#include "graph/function.h"
#include "graph/measure.h"
#include "graph/node.h"
#include "graph/num.h"

enum {
    deepest = 300,        /* depth of nesting that is rewritten: what the stack bears */
    argument_terms = 300, /* an argument whose canonical form is longer stays as it is */
    most_kernels = 300
};

void nh_forms_init(nh_forms *forms, nh_dag *dag, bool literal, size_t max_terms)
{
    *forms = (nh_forms){.dag = dag, .literal = literal, .max_terms = max_terms};
}

void nh_forms_clear(nh_forms *forms)
{
    nh_index_clear(&forms->rewritten);
    nh_index_clear(&forms->canonical);
}

/* ---- canonical arguments ---- */

/* Is it a symbol without relation? */
static bool free_symbol(const nh_dag *dag, nh_ex e)
{
    return nh_kind_of(dag, e) == NH_SYMBOL && !nh_dag_power_rule(dag, e);
}

/* A product of powers of symbols? */
static bool plain_product(const nh_dag *dag, nh_ex e)
{
    for (size_t i = 0; i < nh_arity(dag, e); i++) {
        if (!free_symbol(dag, nh_child(dag, e, i))) return false;
        if (nh_exponent_kind_of(dag, nh_exponent_of(dag, e, i)) != NH_EXPONENT_WHOLE) return false;
    }
    return true;
}

/* A sum of products of powers of symbols is canonical as it is. */
static bool is_plain(const nh_dag *dag, nh_ex e)
{
    nh_kind kind = nh_kind_of(dag, e);
    if (kind == NH_NUMBER || kind == NH_SYMBOL) return kind == NH_NUMBER || free_symbol(dag, e);
    if (kind == NH_PRODUCT) {
        if (nh_arity(dag, e) == 1 && nh_is_number(dag, nh_exponent_of(dag, e, 0), 1))
            return is_plain(dag, nh_child(dag, e, 0));
        return plain_product(dag, e);
    }
    if (kind != NH_SUM) return false;
    for (size_t i = 0; i < nh_arity(dag, e); i++) {
        nh_ex term = nh_child(dag, e, i);
        if (!free_symbol(dag, term) && !(nh_kind_of(dag, term) == NH_PRODUCT && plain_product(dag, term))) return false;
    }
    return true;
}

/* The form of an argument, within narrower limits. */
static bool make_argument(nh_forms *s, nh_ex e, nh_form *form)
{
    size_t max_terms = s->max_terms;
    s->max_terms = argument_terms;
    bool fine = nh_form_make(s, e, true, form) == NH_FIELD_FINE;
    s->max_terms = max_terms;
    if (fine) form->value = nh_quotient_rationalise(form->field, form->value);
    return fine && nh_quotient_field_state_of(form->field) == NH_FIELD_FINE;
}

/* Inexact numbers that the source does not have are a sign of overflow. */
static bool is_sound(const nh_dag *dag, nh_ex result, nh_ex source)
{
    if (nh_kind_of(dag, result) == NH_NUMBER && isnan(nh_num_value(nh_number_of(dag, result)))) return false;
    return nh_is_short(dag, result) || !nh_is_short(dag, source);
}

/* e = *content * (result), both canonical, content positive. */
static nh_ex canonical_parts(nh_forms *s, nh_ex e, nh_num *content)
{
    nh_form form;
    nh_pieces pieces;
    nh_arena *arena = nh_arena_create();
    nh_ex rest = e;
    *content = nh_num_int(1);
    if (make_argument(s, e, &form) && nh_pieces_make(form.field, arena, form.value, false, &pieces)) {
        bool minus = nh_num_value(pieces.constant) < 0, zero = nh_num_is(pieces.constant, 0);
        nh_num size = minus ? nh_num_mul(pieces.constant, nh_num_int(-1)) : pieces.constant;
        pieces.constant = nh_num_int(zero ? 0 : minus ? -1 : 1);
        nh_ex candidate = nh_print_quotient_terms(&form.kernels, &pieces);
        if (nh_num_short(size) && is_sound(s->dag, candidate, e)) {
            rest = candidate;
            *content = zero ? nh_num_int(1) : size;
        }
    }
    nh_form_clear(&form);
    nh_arena_free(arena);
    return rest;
}

/* num/den = whole + rest/den: the argument of sin(y + 1/(1 + x)) is split at the + */
static nh_ex emit_mixed(nh_form *form)
{
    const nh_quotient *side[2];
    nh_dag *dag = form->kernels.dag;
    nh_arena *arena = nh_arena_create();
    nh_ex sum = nh_int(dag, 0);
    bool fits = true;
    nh_quotient_divide(form->field, form->value, &side[0], &side[1]);
    for (int i = 0; i < 2 && fits; i++) {
        nh_pieces pieces;
        fits = nh_pieces_make(form->field, arena, side[i], false, &pieces);
        if (fits) sum = nh_add(dag, sum, nh_print_quotient_terms(&form->kernels, &pieces));
    }
    nh_arena_free(arena);
    return fits ? sum : nh_real(dag, NAN); /* inexact: the caller treats it as an overflow */
}

/* e as its normal form prints it, without its content; remembered. */
static nh_ex canonical(nh_forms *s, nh_ex e)
{
    uint32_t known;
    nh_form form;
    if (is_plain(s->dag, e)) return e;
    if (nh_index_get(&s->canonical, e, &known)) return known;
    nh_ex result = e;
    if (make_argument(s, e, &form)) {
        nh_ex candidate = emit_mixed(&form);
        if (is_sound(s->dag, candidate, e)) result = candidate;
    }
    nh_form_clear(&form);
    if (!nh_index_get(&s->canonical, e, &known)) nh_index_put(&s->canonical, e, result);
    return result;
}

/* ---- rewriting ---- */

/* n^x as a product of powers of primes: 6^(1/2) = 2^(1/2) 3^(1/2). */
static nh_ex whole_root(nh_dag *dag, int64_t n, nh_num x)
{
    nh_ex e = nh_int(dag, 1);
    for (int64_t d = 2; d < 2000 && d <= n / d; d++) {
        int64_t multiplicity = 0;
        for (; n % d == 0; n /= d) multiplicity++;
        if (!multiplicity) continue;
        nh_num power = nh_num_mul(x, nh_num_int(multiplicity));
        e = nh_mul(dag, e, nh_pow(dag, nh_int(dag, d), nh_number(dag, power)));
    }
    return n == 1 ? e : nh_mul(dag, e, nh_pow(dag, nh_int(dag, n), nh_number(dag, x)));
}

static nh_ex number_root(nh_dag *dag, nh_num c, nh_num x)
{
    if (!nh_num_short(c) || c.p <= 0) return nh_pow(dag, nh_number(dag, c), nh_number(dag, x));
    nh_ex bottom = whole_root(dag, c.q, nh_num_mul(x, nh_num_int(-1)));
    return nh_mul(dag, whole_root(dag, c.p, x), bottom);
}

/* (c B)^x = c^x B^x with a positive number c and a canonical B of content 1 */
static nh_ex rewrite_root(nh_forms *s, nh_ex base, nh_num x)
{
    nh_dag *dag = s->dag;
    if (nh_kind_of(dag, base) == NH_NUMBER) return number_root(dag, nh_number_of(dag, base), x);
    nh_num content = nh_num_int(1);
    if (!is_plain(dag, base)) {
        base = canonical_parts(s, base, &content);
    } else if (nh_kind_of(dag, base) == NH_PRODUCT && nh_num_short(nh_constant_of(dag, base))) {
        content = nh_constant_of(dag, base);
        if (content.p < 0) content.p = -content.p;
        base = nh_mul(dag, nh_number(dag, nh_num_inv(content)), base);
    }
    if (nh_kind_of(dag, base) == NH_NUMBER) return number_root(dag, nh_num_mul(content, nh_number_of(dag, base)), x);
    return nh_mul(dag, number_root(dag, content, x), nh_pow(dag, base, nh_number(dag, x)));
}

static nh_ex rewrite(nh_forms *s, nh_ex e);

static nh_ex rewrite_power(nh_forms *s, nh_ex base, nh_ex exponent)
{
    switch (nh_exponent_kind_of(s->dag, exponent)) {
    case NH_EXPONENT_WHOLE: return nh_pow(s->dag, rewrite(s, base), exponent);
    case NH_EXPONENT_ROOT: return rewrite_root(s, base, nh_number_of(s->dag, exponent));
    default: return nh_pow(s->dag, canonical(s, base), canonical(s, exponent));
    }
}

/* exp(c log b + rest) = b^c exp(rest) */
static nh_ex rewrite_exponential(nh_forms *s, nh_ex a)
{
    nh_dag *dag = s->dag;
    nh_parts parts;
    nh_ex product = nh_int(dag, 1), rest = a;
    nh_parts_make(dag, false, a, &parts);
    for (size_t i = 0; i < parts.count; i++) {
        nh_ex atom = parts.item[i].atom, c = nh_number(dag, parts.item[i].coefficient);
        if (nh_kind_of(dag, atom) != NH_FUNCTION || nh_function_of(dag, atom) != NH_LOG) continue;
        product = nh_mul(dag, product, rewrite_power(s, nh_child(dag, atom, 0), c));
        rest = nh_sub(dag, rest, nh_mul(dag, c, atom));
    }
    nh_free(parts.item);
    return nh_mul(dag, product, nh_call(dag, NH_EXP, rest));
}

/* sinh and the like in terms of exp, when not literal */
static nh_ex rewrite_hyperbolic(nh_forms *s, nh_function f, nh_ex a)
{
    nh_dag *dag = s->dag;
    nh_ex up = rewrite_exponential(s, a), down = nh_powi(dag, up, -1);
    nh_ex sine = nh_sub(dag, up, down), cosine = nh_add(dag, up, down);
    if (f == NH_TANH) return nh_div(dag, sine, cosine);
    return nh_div(dag, f == NH_SINH ? sine : cosine, nh_int(dag, 2));
}

/* sin(rest + c pi) and cos(rest + c pi) by those of the rest. */
static bool rewrite_turn(nh_forms *s, nh_function f, nh_ex a, nh_ex *out)
{
    nh_dag *dag = s->dag;
    nh_ex rest, sine, cosine;
    if ((f != NH_SIN && f != NH_COS) || !nh_split_turn(dag, a, &rest, &sine, &cosine)) return false;
    nh_ex p = nh_call(dag, NH_SIN, rest), q = nh_call(dag, NH_COS, rest);
    *out = f == NH_SIN ? nh_add(dag, nh_mul(dag, p, cosine), nh_mul(dag, q, sine))
                       : nh_sub(dag, nh_mul(dag, q, cosine), nh_mul(dag, p, sine));
    return true;
}

/* By functions of orders in a standard interval; not where the expression is to be shown. */
static nh_ex related(nh_forms *s, nh_ex e)
{
    nh_ex next;
    return nh_named_relation_step(s->dag, e, &next) ? rewrite(s, next) : e;
}

static nh_ex rewrite_function(nh_forms *s, nh_ex e)
{
    nh_function f = nh_function_of(s->dag, e);
    if (nh_arity(s->dag, e) == 0) return e;
    nh_ex a = canonical(s, nh_child(s->dag, e, 0)), turned;
    if (rewrite_turn(s, f, a, &turned)) return turned;
    if (f == NH_EXP) return rewrite_exponential(s, a);
    if (!s->literal && (f == NH_SINH || f == NH_COSH || f == NH_TANH)) return rewrite_hyperbolic(s, f, a);
    nh_ex argument[NH_MOST_ARGUMENTS] = {a};
    for (size_t i = 1; i < nh_arity(s->dag, e); i++) argument[i] = canonical(s, nh_child(s->dag, e, i));
    e = nh_call_any(s->dag, f, argument);
    return nh_is_named_function(f) && !s->literal ? related(s, e) : e;
}

static nh_ex rewrite_sum(nh_forms *s, nh_ex e)
{
    size_t n = nh_arity(s->dag, e);
    bool changed = false;
    nh_num *coefficient = nh_alloc_array(n + 1, sizeof *coefficient);
    nh_ex *term = nh_alloc_array(n + 1, sizeof *term);
    for (size_t i = 0; i < n; i++) {
        coefficient[i] = nh_coefficient_of(s->dag, e, i);
        term[i] = rewrite(s, nh_child(s->dag, e, i));
        changed |= term[i] != nh_child(s->dag, e, i);
    }
    coefficient[n] = nh_constant_of(s->dag, e);
    term[n] = nh_int(s->dag, 1);
    nh_ex result = changed ? nh_linear(s->dag, n + 1, coefficient, term) : e;
    nh_free(coefficient);
    nh_free(term);
    return result;
}

static nh_ex rewrite_product(nh_forms *s, nh_ex e)
{
    size_t n = nh_arity(s->dag, e);
    bool changed = false;
    nh_ex *factor = nh_alloc_array(n ? n : 1, sizeof *factor);
    for (size_t i = 0; i < n; i++) {
        nh_ex base = nh_child(s->dag, e, i), exponent = nh_exponent_of(s->dag, e, i),
              as_it_is = nh_pow(s->dag, base, exponent);
        factor[i] = rewrite_power(s, base, exponent);
        changed |= factor[i] != as_it_is;
    }
    nh_ex result = e;
    if (changed) result = nh_number(s->dag, nh_constant_of(s->dag, e));
    for (size_t i = 0; i < n && changed; i++) result = nh_mul(s->dag, result, factor[i]);
    nh_free(factor);
    return result;
}

/* e with canonical arguments, radicands and exponents. */
static nh_ex rewrite(nh_forms *s, nh_ex e)
{
    uint32_t known;
    nh_kind kind = nh_kind_of(s->dag, e);
    if (kind == NH_NUMBER || kind == NH_SYMBOL || s->depth >= deepest) return e;
    if (nh_index_get(&s->rewritten, e, &known)) return known;
    s->depth++;
    nh_ex result = kind == NH_FUNCTION ? rewrite_function(s, e)
                   : kind == NH_SUM    ? rewrite_sum(s, e)
                                       : rewrite_product(s, e);
    s->depth--;
    if (!nh_index_get(&s->rewritten, e, &known)) nh_index_put(&s->rewritten, e, result);
    return result;
}

/* ---- the whole ---- */

/* The square roots that are related so far. */
typedef struct {
    size_t generator;
    const nh_quotient *radicand;
} square_root;

enum { most_roots = 6, longest_product = 400 }; /* terms */

/* Is whole = a b? */
static bool is_product(nh_form *f, const nh_quotient *whole, const nh_quotient *a, const nh_quotient *b)
{
    if (nh_quotient_terms(a) * nh_quotient_terms(b) > longest_product || nh_quotient_terms(whole) > longest_product)
        return false;
    return nh_quotient_equal(f->field, whole, nh_quotient_mul(f->field, a, b));
}

/* sqrt(a b) = sqrt(a) sqrt(b) where all three occur in one expression: a and b are then not negative wherever it is
 * defined. */
static const nh_quotient *from_other_roots(nh_form *f, const square_root *root, size_t roots,
                                           const nh_quotient *radicand)
{
    for (size_t i = 0; i < roots; i++)
        for (size_t j = 0; j < i; j++) {
            const nh_quotient *a = root[i].radicand, *b = root[j].radicand;
            bool product = is_product(f, radicand, a, b), over_b = !product && is_product(f, a, radicand, b),
                 over_a = !product && !over_b && is_product(f, b, radicand, a);
            if (!product && !over_b && !over_a) continue;
            return nh_quotient_mul(f->field, nh_quotient_power_of(f->field, root[i].generator, over_a ? -1 : 1),
                                   nh_quotient_power_of(f->field, root[j].generator, over_b ? -1 : 1));
        }
    return NULL;
}

static bool half_of(nh_num c, nh_num *root)
{
    double p = sqrt((double)c.p), q = sqrt((double)c.q);
    if (!nh_num_short(c) || c.p <= 0) return false;
    *root = nh_num_ratio((int64_t)llround(p), (int64_t)llround(q));
    return nh_num_is(nh_num_add(nh_num_mul(*root, *root), nh_num_mul(c, nh_num_int(-1))), 0);
}

/* Is the generator positive?  Exponentials are, and a generator that is itself a radicand. */
static bool is_positive(nh_form *f, const square_root *root, size_t roots, size_t generator)
{
    bool found = f->kernels.item[generator].kind == NH_KERNEL_EXP;
    for (size_t i = 0; i < roots && !found; i++)
        found = nh_quotient_equal(f->field, root[i].radicand, nh_quotient_power_of(f->field, generator, 1));
    return found;
}

/* The root of a positive square: of a number times powers of positive expressions.  NULL: q is no such square. */
static const nh_quotient *root_of_monomial(nh_form *f, const square_root *of, size_t roots, const nh_quotient *q)
{
    nh_arena *arena = nh_arena_create();
    nh_pieces p;
    nh_num c;
    bool good = nh_pieces_make(f->field, arena, q, false, &p) && p.factors == 0 && half_of(p.constant, &c);
    const nh_quotient *root = good ? nh_quotient_number(f->field, c) : NULL;
    for (size_t g = 0; good && g < p.generators; g++) {
        if (p.exponent[g] == 0) continue;
        good = p.exponent[g] % 2 == 0 && is_positive(f, of, roots, g);
        if (good) root = nh_quotient_mul(f->field, root, nh_quotient_power_of(f->field, g, p.exponent[g] / 2));
    }
    nh_arena_free(arena);
    return good ? root : NULL;
}

static bool has_exponentials(const nh_form *f)
{
    bool found = false;
    for (size_t i = 0; i < f->kernels.count && !found; i++) found = f->kernels.item[i].kind == NH_KERNEL_EXP;
    return found;
}

/* sqrt(1 + x exp(-2 u)) = exp(-u) sqrt(exp(2 u) + x), perhaps times roots of numbers or parameters: exponentials are
 * positive, and so is a radicand. */
static const nh_quotient *from_shifted_root(nh_form *f, const square_root *root, size_t roots,
                                            const nh_quotient *radicand)
{
    enum { most_factors = 2 };
    if (!has_exponentials(f) || nh_quotient_terms(radicand) > longest_product) return NULL;
    for (unsigned set = 1; set < 1u << roots; set++) {
        const nh_quotient *ratio = radicand, *product = nh_quotient_number(f->field, nh_num_int(1));
        size_t factors = 0;
        for (size_t i = 0; i < roots; i++) {
            if (!(set >> i & 1) || ++factors > most_factors || nh_quotient_terms(root[i].radicand) > longest_product)
                continue;
            ratio = nh_quotient_mul(f->field, ratio, nh_quotient_inv(f->field, root[i].radicand));
            product = nh_quotient_mul(f->field, product, nh_quotient_power_of(f->field, root[i].generator, 1));
        }
        const nh_quotient *factor = factors > most_factors ? NULL : root_of_monomial(f, root, roots, ratio);
        if (factor) return nh_quotient_mul(f->field, factor, product);
    }
    return NULL;
}

static void relate_root(nh_form *f, size_t generator, square_root *root, size_t *roots)
{
    const nh_kernel *k = &f->kernels.item[generator];
    const nh_quotient *radicand = nh_form_eval(f, k->atom), *others = NULL;
    if (k->unit.q == 2) others = from_other_roots(f, root, *roots, radicand);
    if (k->unit.q == 2 && !others) others = from_shifted_root(f, root, *roots, radicand);
    if (others) nh_quotient_field_relate(f->field, generator, 1, others);
    else nh_quotient_field_relate(f->field, generator, (unsigned)k->unit.q, radicand);
    if (k->unit.q == 2 && !others && *roots < most_roots) root[(*roots)++] = (square_root){generator, radicand};
}

/* sign(u)? */
static bool is_sign(const nh_dag *dag, nh_ex e)
{
    return nh_kind_of(dag, e) == NH_FUNCTION && nh_function_of(dag, e) == NH_SIGN;
}

void nh_form_relate_signs(nh_form *f)
{
    for (size_t i = 0; i < f->kernels.count; i++)
        if (f->kernels.item[i].kind == NH_KERNEL_PLAIN && is_sign(f->kernels.dag, f->kernels.item[i].atom))
            nh_quotient_field_relate(f->field, i, 2, nh_quotient_number(f->field, nh_num_int(1)));
}

void nh_form_relate_abs(nh_form *f, size_t generator)
{
    nh_dag *dag = f->kernels.dag;
    nh_ex atom = f->kernels.item[generator].atom, sign = nh_call(dag, NH_SIGN, atom);
    const nh_quotient *u = nh_form_eval(f, atom);
    uint32_t i;
    if (is_sign(dag, sign) && nh_index_get(&f->kernels.plain, sign, &i))
        nh_quotient_field_relate(f->field, generator, 1,
                                 nh_quotient_mul(f->field, u, nh_quotient_power_of(f->field, i, 1)));
    else nh_quotient_field_relate(f->field, generator, 2, nh_quotient_pow(f->field, u, 2));
}

/* The relations of the kernels, radicands before their roots, and the expressions in a symbol's relation before the
 * symbol, so that every relation is known before it is needed. */
static void relate(nh_form *f)
{
    square_root root[most_roots];
    size_t roots = 0;
    nh_form_relate_signs(f);
    for (size_t n = 0; n < f->kernels.count; n++) {
        size_t i = f->kernels.order[n];
        const nh_kernel *k = &f->kernels.item[i];
        const nh_power_rule *rule = k->kind == NH_KERNEL_PLAIN ? nh_dag_power_rule(f->kernels.dag, k->atom) : NULL;
        if (rule)
            nh_quotient_field_relate(f->field, i, rule->order, nh_form_eval(f, rule->value)),
                nh_quotient_field_repeat(f->field);
        if (k->kind == NH_KERNEL_SIN || k->kind == NH_KERNEL_SINH)
            nh_quotient_field_relate_pair(f->field, i, k->partner, k->kind == NH_KERNEL_SINH);
        if (k->kind == NH_KERNEL_ROOT) relate_root(f, i, root, &roots);
        if (k->kind == NH_KERNEL_ABS) nh_form_relate_abs(f, i);
    }
}

/* The four steps. */
nh_quotient_field_state nh_form_make(nh_forms *forms, nh_ex e, bool opaque, nh_form *form)
{
    *form = (nh_form){0};
    bool coarse = forms->coarse;
    forms->coarse = false;
    e = rewrite(forms, e);
    forms->coarse = coarse;
    nh_kernels *k = &form->kernels;
    nh_kernels_init(k, forms->dag, forms->literal, opaque);
    k->coarse = coarse;
    nh_kernels_collect(k, e);
    if (k->broken) return NH_FIELD_UNDEFINED;
    if (k->too_deep) return NH_FIELD_TOO_LARGE;
    nh_kernels_settle(k);
    if (k->count > most_kernels) return NH_FIELD_TOO_LARGE;
    form->field = nh_quotient_field_create(k->count, forms->max_terms);
    relate(form);
    form->value = nh_form_eval(form, e);
    return nh_quotient_field_state_of(form->field);
}

void nh_form_clear(nh_form *form)
{
    nh_kernels_clear(&form->kernels);
    nh_quotient_field_free(form->field);
    nh_index_clear(&form->known);
    nh_free(form->of);
}

nh_ex nh_form_rewrite(nh_forms *forms, nh_ex e) { return rewrite(forms, e); }

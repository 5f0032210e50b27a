/* nh_simplify: the shortest of several forms of one expression, by nh_complexity.
 *
 *      e --> form, literal (sin(a + b) stays) --> quotient: factored, multiplied out, as terms, without roots below
 *        |                                        and with cos^2 in place of sin^2, angle by angle
 *        +-> form, cut into atoms, where that may show more relations --> the same
 *        +-> if nothing was shorter: its parts by themselves; then polynomial terms apart from the rest
 *
 * Each form is offered, and the shortest wins; e is among them, so that the result is never longer. Parts are
 * remembered, by this call and by the graph, since the same components occur in many expressions. */
#include "base/progress.h"
#include "graph/dag_internal.h"
#include "exact/print_quotient.h"
#include "exact/form.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/num.h"

enum {
    most_terms = 1000, /* largest number of terms of intermediate polynomials */
    flip_terms = 200,  /* terms of quotients for which elimination of both sin^2 and cos^2 is tried */
    most_flips = 8,    /* for at most this many angles */
    factor_terms = 60, /* see normal_factor.c */
    shortest = 4,      /* complexity below which an expression is already simple */
    deepest = 20,      /* nesting of arguments and terms that are simplified by themselves */
    longest = 3000     /* for the equations of a system: complexity beyond which expressions are not simplified */
};

/* State that one call shares between the expression and its parts. */
typedef struct {
    nh_dag *dag;
    nh_forms literal, cut;
    nh_index done;     /* part -> simplified */
    size_t too_deep;   /* how many parts were left as they are */
    nh_index rational; /* part -> is it a polynomial in symbols and their inverses? */
    int depth;
} context;

typedef struct {
    context *shared;
    nh_dag *dag;
    nh_ex best, last;
    size_t length;
    bool inexact; /* the source has inexact numbers: more of them are no sign of overflow */
} contest;

static nh_ex simplify(context *shared, nh_ex e);

/* Takes the candidate where it is shorter than the best so far, and brings no inexact numbers. */
static void offer(contest *c, nh_ex candidate)
{
    if (candidate == c->last || candidate == c->best) return;
    c->last = candidate;
    size_t length = nh_complexity(c->dag, candidate);
    if (length >= c->length || (!c->inexact && !nh_is_short(c->dag, candidate))) return;
    c->best = candidate;
    c->length = length;
}

static size_t most_terms_of(const nh_pieces *p)
{
    size_t most = 0;
    for (size_t i = 0; i < p->factors; i++) most = p->factor[i].terms > most ? p->factor[i].terms : most;
    return most;
}

static void offer_product(contest *c, const nh_form *form, const nh_pieces *pieces, bool collect)
{
    if (nh_print_quotient_product_least(&form->kernels, pieces, collect) < c->length)
        offer(c, nh_print_quotient_product(&form->kernels, pieces, collect));
}

static void offer_products(contest *c, const nh_form *form, const nh_pieces *pieces)
{
    offer_product(c, form, pieces, false);
    /* two terms have no common factors: these are in the monomial already */
    if (most_terms_of(pieces) > 2) offer_product(c, form, pieces, true);
}

static void offer_terms(contest *c, const nh_form *form, const nh_pieces *pieces)
{
    if (nh_print_quotient_terms_least(&form->kernels, pieces) < c->length)
        offer(c, nh_print_quotient_terms(&form->kernels, pieces));
}

/* All ways to write one quotient.  A quotient of n terms has no shorter form than n unless they have factors. */
static void offer_quotient(contest *c, const nh_form *form, const nh_quotient *q)
{
    size_t terms = nh_quotient_terms(q);
    if (terms > c->length && terms > factor_terms) return;
    nh_arena *arena = nh_arena_create();
    nh_pieces factored, whole;
    bool irreducible = false;
    bool fits = nh_pieces_make(form->field, arena, q, false, &whole);
    if (nh_pieces_make(form->field, arena, q, true, &factored)) {
        offer_products(c, form, &factored);
        irreducible = fits && factored.factors == whole.factors && most_terms_of(&factored) == most_terms_of(&whole);
    }
    if (fits && terms <= c->length) {
        if (!irreducible) offer_products(c, form, &whole);
        offer_terms(c, form, &whole);
    }
    nh_arena_free(arena);
}

/* Eliminate sin^2 everywhere; then, angle by angle, cos^2 where that is shorter. */
static void offer_form(contest *c, nh_form *form)
{
    const nh_quotient *q = form->value;
    offer_quotient(c, form, q);
    const nh_quotient *rational = nh_quotient_rationalise(form->field, q);
    if (rational != q && nh_quotient_field_state_of(form->field) == NH_FIELD_FINE) offer_quotient(c, form, rational);
    size_t pairs = nh_quotient_terms(q) <= flip_terms ? nh_quotient_field_pairs(form->field) : 0;
    for (size_t i = 0; i < pairs && i < most_flips && !nh_is_zero(c->dag, c->best); i++) {
        size_t before = c->length;
        nh_quotient_field_flip_pair(form->field, i);
        const nh_quotient *flipped = nh_quotient_again(form->field, q);
        if (nh_quotient_field_state_of(form->field) != NH_FIELD_FINE) return;
        /* what has no such square is the same */
        if (!nh_quotient_equal(form->field, q, flipped)) offer_quotient(c, form, flipped);
        if (c->length < before) q = flipped;
        else nh_quotient_field_flip_pair(form->field, i);
    }
}

/* Arguments and radicands of kernels are shown in their shortest form. */
static void beautify(contest *c, nh_form *form)
{
    for (size_t i = 0; i < form->kernels.count; i++) {
        nh_kernel *k = &form->kernels.item[i];
        size_t twin = k->partner; /* sine and cosine have the same argument */
        nh_ex inside = k->kind == NH_KERNEL_ROOT ? k->atom : nh_kernel_argument(&form->kernels, i);
        k->length = 1;
        if (k->kind == NH_KERNEL_PLAIN && nh_kind_of(c->dag, inside) != NH_FUNCTION) continue;
        if (!nh_quotient_has(form->field, form->value, i) && !nh_quotient_has(form->field, form->value, twin)) continue;
        nh_ex shown = nh_complexity(c->dag, inside) > shortest ? simplify(c->shared, inside) : inside;
        if (shown != inside) k->shown = shown;
        k->length = nh_complexity(c->dag, shown) + (k->kind != NH_KERNEL_PLAIN);
    }
}

/* Would splitting the arguments into atoms show more relations? */
static bool worth_cutting(const nh_dag *dag, const nh_kernels *k)
{
    for (size_t i = 0; i < k->count; i++) {
        const nh_kernel *x = &k->item[i];
        if (x->kind == NH_KERNEL_SINH) return true;
        if ((x->kind == NH_KERNEL_SIN || x->kind == NH_KERNEL_EXP) && nh_kind_of(dag, x->atom) == NH_SUM) return true;
        for (size_t j = 0; j < i && x->kind == NH_KERNEL_SIN; j++)
            if (k->item[j].kind == NH_KERNEL_SIN && k->item[j].atom == x->atom) return true;
    }
    return false;
}

/* Returns whether the other kind of kernels is worth trying. */
static bool compete(contest *c, nh_ex e, bool literal)
{
    nh_form form;
    bool fine = nh_form_make(literal ? &c->shared->literal : &c->shared->cut, e, true, &form) == NH_FIELD_FINE;
    bool more = literal && worth_cutting(c->dag, &form.kernels);
    if (fine) {
        beautify(c, &form);
        offer_form(c, &form);
    }
    nh_form_clear(&form);
    return more && !nh_is_zero(c->dag, c->best);
}

/* ---- part by part ---- */

static bool worth_descending(const nh_dag *dag, nh_ex e)
{
    nh_kind kind = nh_kind_of(dag, e);
    if (kind == NH_SUM) return true;
    for (size_t i = 0; i < nh_arity(dag, e); i++) {
        nh_kind inner = nh_kind_of(dag, nh_child(dag, e, i));
        if (kind == NH_FUNCTION ? inner > NH_SYMBOL : inner == NH_SUM || inner == NH_FUNCTION) return true;
    }
    return false;
}

static nh_ex part(contest *c, nh_ex e) { return worth_descending(c->dag, e) ? simplify(c->shared, e) : e; }

static nh_ex sum_of_parts(contest *c, nh_ex e)
{
    size_t n = nh_arity(c->dag, e);
    nh_num *coefficient = nh_alloc_array(n + 1, sizeof *coefficient);
    nh_ex *term = nh_alloc_array(n + 1, sizeof *term);
    for (size_t i = 0; i < n; i++) {
        coefficient[i] = nh_coefficient_of(c->dag, e, i);
        term[i] = part(c, nh_child(c->dag, e, i));
    }
    coefficient[n] = nh_constant_of(c->dag, e);
    term[n] = nh_int(c->dag, 1);
    nh_ex sum = nh_linear(c->dag, n + 1, coefficient, term);
    nh_free(coefficient);
    nh_free(term);
    return sum;
}

static nh_ex product_of_parts(contest *c, nh_ex e)
{
    nh_ex product = nh_number(c->dag, nh_constant_of(c->dag, e));
    for (size_t i = 0; i < nh_arity(c->dag, e); i++) {
        nh_ex base = part(c, nh_child(c->dag, e, i)), exponent = part(c, nh_exponent_of(c->dag, e, i));
        product = nh_mul(c->dag, product, nh_pow(c->dag, base, exponent));
    }
    return product;
}

static nh_ex of_parts(contest *c, nh_ex e)
{
    nh_kind kind = nh_kind_of(c->dag, e);
    if (kind == NH_SUM) return sum_of_parts(c, e);
    if (kind == NH_PRODUCT) return product_of_parts(c, e);
    nh_ex argument[NH_MOST_ARGUMENTS];
    for (size_t i = 0; i < nh_arity(c->dag, e); i++) argument[i] = part(c, nh_child(c->dag, e, i));
    return nh_call_any(c->dag, nh_function_of(c->dag, e), argument);
}

static bool polynomial(context *shared, nh_ex e);

static bool polynomial_parts(context *shared, nh_ex e)
{
    const nh_dag *dag = shared->dag;
    nh_kind kind = nh_kind_of(dag, e);
    for (size_t i = 0; i < nh_arity(dag, e); i++) {
        if (!polynomial(shared, nh_child(dag, e, i))) return false;
        if (kind != NH_PRODUCT) continue;
        nh_ex x = nh_exponent_of(dag, e, i);
        if (nh_kind_of(dag, x) != NH_NUMBER || nh_number_of(dag, x).q != 1) return false;
        if (nh_number_of(dag, x).p < 0 && nh_kind_of(dag, nh_child(dag, e, i)) != NH_SYMBOL) return false;
    }
    return true;
}

/* Is it a polynomial in symbols and their inverses?  Each part is examined once: a shared graph has exponentially many
 * paths. */
static bool polynomial(context *shared, nh_ex e)
{
    nh_kind kind = nh_kind_of(shared->dag, e);
    uint32_t known;
    if (kind == NH_FUNCTION || kind == NH_SYMBOL || kind == NH_NUMBER) return kind != NH_FUNCTION;
    if (nh_index_get(&shared->rational, e, &known)) return known;
    bool result = polynomial_parts(shared, e);
    nh_index_put(&shared->rational, e, result);
    return result;
}

/* Simplifies the polynomial terms of a sum by themselves: with a term like k/sqrt(..) the common denominator makes
 * everything longer. */
static nh_ex apart(contest *c, nh_ex e)
{
    nh_ex plain = nh_int(c->dag, 0), rest = nh_int(c->dag, 0);
    if (nh_kind_of(c->dag, e) != NH_SUM) return e;
    for (size_t i = 0; i < nh_arity(c->dag, e); i++) {
        nh_ex term = nh_child(c->dag, e, i),
              scaled = nh_mul(c->dag, nh_number(c->dag, nh_coefficient_of(c->dag, e, i)), term);
        nh_ex *to = polynomial(c->shared, term) ? &plain : &rest;
        *to = nh_add(c->dag, *to, scaled);
    }
    if (nh_is_zero(c->dag, plain) || nh_is_zero(c->dag, rest)) return e;
    plain = nh_add(c->dag, plain, nh_number(c->dag, nh_constant_of(c->dag, e)));
    return nh_add(c->dag, simplify(c->shared, rest), simplify(c->shared, plain));
}

/* The best form of e, with those of its parts. */
static nh_ex simplify(context *shared, nh_ex e)
{
    uint32_t known;
    nh_ex before;
    contest c = {.shared = shared, .dag = shared->dag, .best = e, .last = e, .length = nh_complexity(shared->dag, e)};
    if (c.length <= shortest || nh_interrupted()) return e;
    if (shared->depth > deepest) return shared->too_deep++, e;
    if (nh_dag_form(c.dag, e, NH_FORM_PART, &before)) return before;
    if (nh_index_get(&shared->done, e, &known)) return known;
    size_t left = shared->too_deep;
    shared->depth++;
    c.inexact = !nh_is_short(c.dag, e);
    if (compete(&c, e, true)) compete(&c, e, false);
    if (c.best == e) offer(&c, of_parts(&c, e));
    if (c.best == e) offer(&c, apart(&c, e));
    shared->depth--;
    if (!nh_index_get(&shared->done, e, &known)) nh_index_put(&shared->done, e, c.best);
    /* the same parts are in many expressions: the graph keeps what does not depend on the rest */
    if (shared->too_deep == left && !nh_interrupted()) nh_dag_set_form(c.dag, e, NH_FORM_PART, c.best);
    return c.best;
}

/* ---- arguments as the user wrote them ---- */

/* log((R + v)/(R - v)) comes back with a canonical argument, which may be longer than what was written: then the
 * source's call is put back.  Both stand for the same value: one is the rewriting of the other. */
static nh_ex restore_calls(context *shared, nh_ex source, nh_ex result)
{
    enum { most_calls = 64 };
    nh_dag *dag = shared->dag;
    NH_LIST(call);
    nh_ex shown[most_calls];
    size_t n = nh_functions_in(dag, source, &call), kept = 0;
    if (n > most_calls) return result;
    for (size_t i = 0; i < n; i++) {
        if (nh_arity(dag, call[i]) != 1) continue;
        nh_ex canonical = nh_form_rewrite(&shared->literal, call[i]);
        if (nh_kind_of(dag, canonical) != NH_FUNCTION || nh_arity(dag, canonical) != 1) continue;
        nh_ex g = nh_call(dag, nh_function_of(dag, canonical), simplify(shared, nh_child(dag, canonical, 0)));
        if (g == call[i] || nh_complexity(dag, g) <= nh_complexity(dag, call[i])) continue;
        shown[kept] = g;
        call[kept++] = call[i];
    }
    return kept ? nh_substitute(dag, result, kept, shown, call) : result;
}

/* The base b of c b^x with a root x, where the rewriting of base^x is no more than b^x; 0 otherwise. */
static nh_ex canonical_base(context *shared, nh_ex base, nh_ex exponent)
{
    nh_dag *dag = shared->dag;
    nh_ex power = nh_form_rewrite(&shared->literal, nh_pow(dag, base, exponent));
    bool plain =
        nh_kind_of(dag, power) == NH_PRODUCT && nh_arity(dag, power) == 1 && nh_num_is(nh_constant_of(dag, power), 1);
    return plain && nh_exponent_of(dag, power, 0) == exponent ? nh_child(dag, power, 0) : 0;
}

/* The same for roots: sqrt((x - a)^2 + y^2), and not sqrt(a^2 + y^2 + x*(x - 2*a)). */
static nh_ex restore_roots(context *shared, nh_ex source, nh_ex result)
{
    enum { most_products = 200, most_roots = 16 };
    nh_dag *dag = shared->dag;
    NH_LIST(product);
    nh_ex written[most_roots], shown[most_roots];
    size_t n = nh_products_in(dag, source, &product), kept = 0;
    for (size_t i = 0; i < n && n <= most_products; i++)
        for (size_t j = 0; j < nh_arity(dag, product[i]) && kept < most_roots; j++) {
            nh_ex base = nh_child(dag, product[i], j), exponent = nh_exponent_of(dag, product[i], j);
            if (nh_kind_of(dag, base) != NH_SUM || nh_exponent_kind_of(dag, exponent) != NH_EXPONENT_ROOT) continue;
            nh_ex b = canonical_base(shared, base, exponent), g = b ? simplify(shared, b) : base;
            bool known = g == base || nh_complexity(dag, g) <= nh_complexity(dag, base);
            for (size_t k = 0; k < kept; k++) known |= shown[k] == g;
            if (known) continue;
            shown[kept] = g;
            written[kept++] = base;
        }
    return kept ? nh_substitute(dag, result, kept, shown, written) : result;
}

/* The same components are simplified again and again: the graph keeps the results. */
nh_ex nh_simplify(nh_dag *dag, nh_ex e)
{
    nh_ex known;
    if (nh_dag_form(dag, e, NH_FORM_SIMPLE, &known)) return known;
    context shared = {.dag = dag};
    nh_forms_init(&shared.literal, dag, true, most_terms);
    nh_forms_init(&shared.cut, dag, false, most_terms);
    nh_ex result = simplify(&shared, e);
    if (result != e) result = restore_roots(&shared, e, restore_calls(&shared, e, result));
    nh_forms_clear(&shared.literal);
    nh_forms_clear(&shared.cut);
    nh_index_clear(&shared.done);
    nh_index_clear(&shared.rational);
    if (nh_interrupted()) return result; /* this result may not be the shortest */
    nh_dag_set_form(dag, e, NH_FORM_SIMPLE, result);
    nh_dag_set_form(dag, result, NH_FORM_SIMPLE, result);
    return result;
}

size_t nh_simplify_longest(size_t n)
{
    enum { many = 12, short_enough = 150 };
    return n > many ? short_enough : 0;
}

nh_ex nh_simplify_short(nh_dag *dag, nh_ex e, size_t most)
{
    return nh_complexity_within(dag, e, most ? most : longest) ? nh_simplify(dag, e) : e;
}

/* Square roots by conjugates, down to quotients of polynomials (field_root.h).
 *
 *      e = a + b r,  r^2 = D                    r the last root; a, b, D without it
 *          |
 *          +-- b = 0     sqrt(a), or r sqrt(a/D)
 *          |
 *          +-- n = sqrt(a^2 - b^2 D)            the norm, one root less
 *              u = sqrt((a + n)/2), or sqrt((a - n)/2)
 *              sqrt(e) = u + b r/(2 u)          because u^2 + b^2 D/(4 u^2) = a
 *
 * Without roots, sin(a) = 2 t/(1 + t^2) and cos(a) = (1 - t^2)/(1 + t^2) with t = tan(a/2) leave a quotient of
 * polynomials, which is a square if its factors occur in even powers. */
#include "exact/field_root.h"

#include "base/memory.h"
#include "exact/form.h"
#include "exact/normal.h"
#include "exact/print_quotient.h"
#include "graph/dag.h"
#include "graph/function.h"
#include "graph/node.h"

enum { most_terms = 20000 };

typedef struct {
    nh_dag *dag;
    const nh_root_field *f;
    nh_ex *tangent;        /* one symbol for each angle, tan(a/2), and for each exponent, exp(a) */
    nh_ex *symbol, *value; /* for each root, and its square in these symbols */
} root_search;

/* exp(2 a + b), which graphs do not split, as a product of powers of the symbols for exp(a) and exp(b). */
static nh_ex exponential(void *search, nh_ex e)
{
    const root_search *x = search;
    const nh_root_field *f = x->f;
    if (nh_function_of(x->dag, e) != NH_EXP) return 0;
    nh_parts parts;
    nh_ex product = nh_int(x->dag, 1);
    nh_parts_make(x->dag, false, nh_child(x->dag, e, 0), &parts);
    for (size_t i = 0; i < parts.count; i++) {
        nh_ex power = e;
        nh_ex part = nh_mul(x->dag, nh_number(x->dag, parts.item[i].coefficient), parts.item[i].atom);
        for (size_t k = 0; k < f->exponents && power == e; k++) {
            nh_ex times = nh_div(x->dag, part, f->exponent[k]);
            if (nh_kind_of(x->dag, times) == NH_NUMBER) power = nh_pow(x->dag, x->tangent[f->angles + k], times);
        }
        if (power == e) product = nh_int(x->dag, 0);
        product = nh_mul(x->dag, product, power);
    }
    nh_free(parts.item);
    return nh_is_zero(x->dag, product) ? e : product;
}

/* e in symbols for the roots and tangents: functions of multiples are written by the generators first, which have to
 * stand beside them for this. */
static nh_ex in_symbols(root_search *x, nh_ex e)
{
    nh_dag *d = x->dag;
    const nh_root_field *f = x->f;
    nh_ex mark = nh_symbol_fresh(d, "mark"), power = mark, zero = nh_int(d, 0), one = nh_int(d, 1);
    for (size_t i = 0; i < f->angles + f->exponents; i++, power = nh_mul(d, power, mark))
        e = nh_add(
            d, e,
            nh_mul(d, power,
                   i < f->angles ? nh_call(d, NH_SIN, f->angle[i]) : nh_call(d, NH_EXP, f->exponent[i - f->angles])));
    e = nh_substitute(d, nh_canonical_sum(d, e), 1, &mark, &zero);
    for (size_t i = f->roots; i-- > 0;) e = nh_substitute_root(d, e, f->radicand[i], x->symbol[i]);
    for (size_t i = 0; i < f->angles; i++) {
        nh_ex u = x->tangent[i], square = nh_powi(d, u, 2), below = nh_add(d, one, square);
        nh_ex from[] = {nh_call(d, NH_SIN, f->angle[i]), nh_call(d, NH_COS, f->angle[i])},
              to[] = {nh_div(d, nh_add(d, u, u), below), nh_div(d, nh_sub(d, one, square), below)};
        e = nh_substitute(d, e, 2, from, to);
    }
    return nh_substitute_calls(d, e, exponential, x);
}

/* Without roots: a quotient of polynomials in symbols and functions that are not related. */
static bool rational_root(nh_dag *d, nh_ex e, nh_ex *root)
{
    nh_forms forms;
    nh_form form;
    nh_pieces pieces;
    nh_arena *arena = nh_arena_create();
    nh_forms_init(&forms, d, false, most_terms);
    bool good = nh_form_make(&forms, e, false, &form) == NH_FIELD_FINE;
    for (size_t i = 0; i < form.kernels.count && good; i++)
        good = form.kernels.item[i].kind == NH_KERNEL_PLAIN || form.kernels.item[i].kind == NH_KERNEL_EXP;
    const nh_quotient *q = good ? nh_quotient_root(form.field, form.value) : NULL;
    good = q && nh_pieces_make(form.field, arena, q, false, &pieces);
    if (good) *root = nh_print_quotient_product(&form.kernels, &pieces, false);
    nh_form_clear(&form);
    nh_forms_clear(&forms);
    nh_arena_free(arena);
    return good;
}

static bool root_with(root_search *x, size_t roots, nh_ex e, nh_ex *root);

/* e without the last root: the square of something without it, or of r times that. */
static bool root_without(root_search *x, size_t last, nh_ex e, nh_ex *root)
{
    if (root_with(x, last, e, root)) return true;
    bool good = root_with(x, last, nh_simplify(x->dag, nh_div(x->dag, e, x->value[last])), root);
    if (good) *root = nh_mul(x->dag, *root, x->symbol[last]);
    return good;
}

/* The root of e in the field with the first `roots` roots. */
static bool root_with(root_search *x, size_t roots, nh_ex e, nh_ex *root)
{
    nh_dag *d = x->dag;
    if (nh_is_zero(d, e)) return *root = e, true;
    if (!roots) return rational_root(d, e, root);
    size_t last = roots - 1;
    nh_ex r = x->symbol[last], minus = nh_neg(d, r), half = nh_ratio(d, 1, 2), n, u;
    nh_ex conjugate = nh_substitute(d, e, 1, &r, &minus);
    nh_ex a = nh_simplify(d, nh_mul(d, half, nh_add(d, e, conjugate))),
          b = nh_simplify(d, nh_div(d, nh_mul(d, half, nh_sub(d, e, conjugate)), r));
    if (nh_is_zero(d, b)) return root_without(x, last, a, root);
    nh_ex norm = nh_sub(d, nh_powi(d, a, 2), nh_mul(d, nh_powi(d, b, 2), x->value[last]));
    if (!root_with(x, last, nh_simplify(d, norm), &n)) return false;
    for (int sign = 0; sign < 2; sign++) {
        nh_ex square = nh_simplify(d, nh_mul(d, half, sign ? nh_sub(d, a, n) : nh_add(d, a, n)));
        if (nh_is_zero(d, square) || !root_with(x, last, square, &u)) continue;
        *root = nh_add(d, u, nh_div(d, nh_mul(d, nh_mul(d, half, b), r), u));
        return true;
    }
    return false;
}

bool nh_field_root(nh_dag *d, const nh_root_field *f, nh_ex e, nh_ex *root)
{
    root_search x = {.dag = d, .f = f};
    x.tangent = nh_alloc_array(f->angles + f->exponents + 1, sizeof *x.tangent);
    x.symbol = nh_alloc_array(2 * f->roots + 1, sizeof *x.symbol);
    x.value = x.symbol + f->roots;
    for (size_t i = 0; i < f->angles + f->exponents; i++) x.tangent[i] = nh_symbol_fresh(d, "u");
    for (size_t i = 0; i < f->roots; i++) {
        x.symbol[i] = nh_symbol_fresh(d, "r");
        x.value[i] = in_symbols(&x, f->radicand[i]);
        nh_relate(d, x.symbol[i], 2, x.value[i]);
    }
    bool good = root_with(&x, f->roots, in_symbols(&x, e), root);
    for (size_t i = 0; i < f->angles + f->exponents && good; i++) {
        nh_ex back = i < f->angles ? nh_div(d, nh_call(d, NH_SIN, f->angle[i]),
                                            nh_add(d, nh_int(d, 1), nh_call(d, NH_COS, f->angle[i])))
                                   : nh_call(d, NH_EXP, f->exponent[i - f->angles]);
        *root = nh_substitute(d, *root, 1, &x.tangent[i], &back);
    }
    for (size_t i = 0; i < f->roots && good; i++) {
        nh_ex r = nh_sqrt(d, f->radicand[i]);
        *root = nh_substitute(d, *root, 1, &x.symbol[i], &r);
    }
    if (good) *root = nh_canonical(d, nh_simplify(d, *root), 0); /* with the same radicands */
    nh_free(x.tangent);
    nh_free(x.symbol);
    return good;
}

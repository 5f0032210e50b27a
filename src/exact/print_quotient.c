#include "exact/print_quotient.h"

#include <string.h>

#include "base/memory.h"
#include "graph/dag.h"
#include "graph/function.h"
#include "graph/measure.h"
#include "graph/node.h"
#include "graph/num.h"

/* ---- monomials ---- */

static int64_t opposite(int64_t a, int64_t b)
{
    if (a > 0 && b < 0) return a < -b ? a : -b;
    if (a < 0 && b > 0) return a > -b ? a : -b;
    return 0;
}

/* sin^a cos^b as tan^t sin^(a-t) cos^(b+t); returns t and takes it off the exponents. */
static int64_t take_tangents(const nh_kernels *k, size_t sine, int64_t *exponent)
{
    nh_kernel_kind kind = k->item[sine].kind;
    if (kind != NH_KERNEL_SIN && kind != NH_KERNEL_SINH) return 0;
    int64_t t = opposite(exponent[sine], exponent[k->item[sine].partner]);
    exponent[sine] -= t;
    exponent[k->item[sine].partner] += t;
    return t;
}

static nh_ex with_tangents(const nh_kernels *k, nh_ex e, int64_t *exponent)
{
    for (size_t g = 0; g < k->count; g++) {
        int64_t t = take_tangents(k, g, exponent);
        if (!t) continue;
        nh_function f = k->item[g].kind == NH_KERNEL_SIN ? NH_TAN : NH_TANH;
        nh_ex tangent = nh_call(k->dag, f, nh_kernel_argument(k, g));
        e = nh_mul(k->dag, e, nh_powi(k->dag, tangent, t));
    }
    return e;
}

/* e * prod_g k_g^exponent[g]; the exponentials in one: exp(a) exp(b) = exp(a + b) */
static nh_ex times_monomial(const nh_kernels *k, nh_ex e, const int64_t *exponent)
{
    nh_dag *dag = k->dag;
    nh_ex growth = nh_int(dag, 0), *factor = nh_alloc_array(k->count + 2, sizeof *factor);
    size_t n = 0;
    factor[n++] = e;
    for (size_t g = 0; g < k->count; g++) {
        if (!exponent[g]) continue;
        if (k->item[g].kind == NH_KERNEL_EXP)
            growth = nh_add(dag, growth, nh_mul(dag, nh_int(dag, exponent[g]), nh_kernel_argument(k, g)));
        else factor[n++] = nh_kernel_power(k, g, exponent[g]);
    }
    if (!nh_is_zero(dag, growth)) factor[n++] = nh_call(dag, NH_EXP, growth);
    if (n > 1) e = nh_product(dag, n, factor);
    nh_free(factor);
    return e;
}

/* ---- sums ---- */

static nh_ex expanded(const nh_kernels *k, const nh_factor *f, size_t width)
{
    nh_ex *term = nh_alloc_array(f->terms, sizeof *term), one = nh_int(k->dag, 1);
    for (size_t i = 0; i < f->terms; i++) term[i] = times_monomial(k, one, f->exponent + i * width);
    nh_ex sum = nh_linear(k->dag, f->terms, f->coefficient, term);
    nh_free(term);
    return sum;
}

static int64_t least_exponent(const nh_factor *f, size_t width, size_t g, size_t *count)
{
    int64_t least = 0;
    *count = 0;
    for (size_t i = 0; i < f->terms; i++) {
        int64_t x = f->exponent[i * width + g];
        if (x <= 0) continue;
        if (!least || x < least) least = x;
        ++*count;
    }
    return least;
}

/* The power of a kernel that shortens the sum most when it is taken out of the terms that have it; `width` when there
 * is none. */
static size_t most_shared(const nh_kernels *k, const nh_factor *f, size_t width, int64_t *power)
{
    size_t best = width, most = 0, count;
    for (size_t g = 0; g < k->count; g++) {
        int64_t least = least_exponent(f, width, g, &count);
        if (count < 2) continue;
        size_t saving = (count - 1) * (1 + k->item[g].length + (least > 1 ? 2 : 0));
        if (saving <= most) continue;
        most = saving;
        best = g;
        *power = least;
    }
    return best;
}

/* The terms with (or without) kernel g, divided by g^least. */
static void select_terms(const nh_factor *f, size_t width, size_t g, int64_t least, bool with, nh_factor *out)
{
    out->terms = 0;
    out->coefficient = nh_alloc_array(f->terms, sizeof *out->coefficient);
    out->exponent = nh_alloc_array(f->terms * width, sizeof *out->exponent);
    for (size_t i = 0; i < f->terms; i++) {
        if ((f->exponent[i * width + g] > 0) != with) continue;
        int64_t *exponent = out->exponent + out->terms * width;
        memcpy(exponent, f->exponent + i * width, width * sizeof *exponent);
        if (with) exponent[g] -= least;
        out->coefficient[out->terms++] = f->coefficient[i];
    }
}

/* sum = k_g^m * (sum of quotients) + rest, and so on within both */
static nh_ex collected(const nh_kernels *k, const nh_factor *f, size_t width)
{
    int64_t least = 0;
    size_t g = most_shared(k, f, width, &least);
    if (g == width) return expanded(k, f, width);
    nh_factor with, without;
    select_terms(f, width, g, least, true, &with);
    select_terms(f, width, g, least, false, &without);
    nh_ex e = nh_mul(k->dag, nh_kernel_power(k, g, least), collected(k, &with, width));
    if (without.terms) e = nh_add(k->dag, e, collected(k, &without, width));
    nh_free(with.coefficient);
    nh_free(with.exponent);
    nh_free(without.coefficient);
    nh_free(without.exponent);
    return e;
}

/* ---- the whole ---- */

nh_ex nh_print_quotient_product(const nh_kernels *kernels, const nh_pieces *pieces, bool collect)
{
    nh_dag *dag = kernels->dag;
    size_t width = pieces->generators;
    nh_ex e = nh_number(dag, pieces->constant);
    if (nh_num_is(pieces->constant, 0)) return e;
    int64_t *exponent = nh_alloc_array(width, sizeof *exponent);
    memcpy(exponent, pieces->exponent, width * sizeof *exponent);
    e = with_tangents(kernels, e, exponent);
    e = times_monomial(kernels, e, exponent);
    nh_free(exponent);
    for (size_t i = 0; i < pieces->factors; i++) {
        const nh_factor *f = &pieces->factor[i];
        nh_ex sum = collect ? collected(kernels, f, width) : expanded(kernels, f, width);
        e = nh_mul(dag, e, nh_powi(dag, sum, f->power));
    }
    return e;
}

nh_ex nh_print_quotient_terms(const nh_kernels *kernels, const nh_pieces *pieces)
{
    nh_dag *dag = kernels->dag;
    size_t width = pieces->generators;
    nh_ex common = nh_number(dag, pieces->constant);
    const nh_factor *top = NULL;
    for (size_t i = 0; i < pieces->factors; i++) {
        const nh_factor *f = &pieces->factor[i];
        if (f->power > 0 && !top) top = f;
        else common = nh_mul(dag, common, nh_powi(dag, expanded(kernels, f, width), f->power));
    }
    if (!top) return times_monomial(kernels, common, pieces->exponent);
    nh_ex *term = nh_alloc_array(top->terms, sizeof *term);
    int64_t *exponent = nh_alloc_array(width, sizeof *exponent);
    for (size_t i = 0; i < top->terms; i++) {
        for (size_t g = 0; g < width; g++) exponent[g] = pieces->exponent[g] + top->exponent[i * width + g];
        term[i] = times_monomial(kernels, common, exponent);
    }
    nh_ex sum = nh_linear(dag, top->terms, top->coefficient, term);
    nh_free(term);
    nh_free(exponent);
    return sum;
}

/* ---- how long they are at least ---- */

typedef struct {
    const nh_kernels *k;
    const nh_pieces *pieces;
    bool mixes;  /* roots, powers and numbers merge with what stands beside them */
    bool shared; /* a number in front of a sum may be multiplied into it */
} least;

static least least_of(const nh_kernels *k, const nh_pieces *pieces)
{
    bool unit = nh_num_is(pieces->constant, 1) || nh_num_is(pieces->constant, -1);
    least l = {.k = k, .pieces = pieces, .shared = !unit};
    for (size_t g = 0; g < k->count; g++) {
        const nh_kernel *x = &k->item[g];
        l.mixes |= x->kind == NH_KERNEL_ROOT || x->kind == NH_KERNEL_POWER;
        l.mixes |= x->kind == NH_KERNEL_PLAIN && nh_kind_of(k->dag, x->atom) == NH_NUMBER;
    }
    return l;
}

/* What a power of a kernel adds to a product whatever else is in it. */
static size_t least_of_power(const least *l, size_t g, int64_t exponent)
{
    const nh_kernel *x = &l->k->item[g];
    size_t own = 0;
    if (!exponent) return 0;
    if (x->kind == NH_KERNEL_PLAIN) own = nh_kind_of(l->k->dag, x->atom) == NH_SYMBOL;
    if (x->kind >= NH_KERNEL_SIN && x->kind <= NH_KERNEL_COSH) own = 2; /* the function and its argument */
    return own && !l->mixes && exponent != 1 && exponent != -1 ? own + 2 : own;
}

/* The same of a product of powers, with the signs between them; `more` are added to the exponents. */
static size_t least_of_monomial(const least *l, const int64_t *exponent, const int64_t *more)
{
    size_t length = 0;
    for (size_t g = 0; g < l->k->count; g++) {
        size_t own = least_of_power(l, g, exponent[g] + (more ? more[g] : 0));
        if (own) length += own + (length > 0);
    }
    return length;
}

static size_t least_of_sum(const least *l, const nh_factor *f, bool collect)
{
    size_t length = f->terms - 1; /* signs between them */
    if (f->terms < 2) return 0;
    for (size_t i = 0; i < f->terms; i++) {
        size_t own = collect ? 0 : least_of_monomial(l, f->exponent + i * l->pieces->generators, NULL);
        bool number = own && !l->mixes && !l->shared && f->coefficient[i].p != 1 && f->coefficient[i].p != -1;
        length += own ? own + (number ? 2 : 0) : 1;
    }
    return length;
}

size_t nh_print_quotient_product_least(const nh_kernels *kernels, const nh_pieces *pieces, bool collect)
{
    least l = least_of(kernels, pieces);
    size_t length = 0;
    for (size_t i = 0; i < pieces->factors; i++) length += least_of_sum(&l, &pieces->factor[i], collect);
    return length;
}

size_t nh_print_quotient_terms_least(const nh_kernels *kernels, const nh_pieces *pieces)
{
    least l = least_of(kernels, pieces);
    const nh_factor *top = NULL;
    size_t others = 0, length = 0;
    for (size_t i = 0; i < pieces->factors; i++) {
        const nh_factor *f = &pieces->factor[i];
        if (f->power > 0 && !top) top = f;
        else others += least_of_sum(&l, f, false);
    }
    if (!top) return others;
    for (size_t i = 0; i < top->terms; i++) {
        size_t own = others + least_of_monomial(&l, top->exponent + i * pieces->generators, pieces->exponent);
        length += (own ? own : 1) + (i > 0);
    }
    return length;
}

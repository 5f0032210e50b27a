/* algebra: sums, the canonical constructors of dag.h; product.c has products and powers. */
#include <stdlib.h>

#include "base/memory.h"
#include "graph/dag.h"
#include "graph/term_list.h"
#include "graph/dag_internal.h"
#include "graph/node.h"
#include "graph/num.h"

void nh_term_list_push(nh_term_list *b, nh_term_list_item x)
{
    nh_grow(&b->list, &b->capacity, b->count + 1, sizeof *b->list);
    b->list[b->count++] = x;
}

int nh_term_list_order(const void *a, const void *b)
{
    nh_ex x = ((const nh_term_list_item *)a)->e, y = ((const nh_term_list_item *)b)->e;
    return x < y ? -1 : x > y;
}

nh_ex nh_term_list_intern(nh_dag *dag, nh_kind kind, const nh_term_list *b)
{
    size_t n = 1 + 2 * b->count;
    uint32_t small[33], *arg = n <= 33 ? small : nh_alloc_array(n, sizeof *arg);
    arg[0] = nh_number(dag, b->c);
    for (size_t i = 0; i < b->count; i++) {
        arg[1 + 2 * i] = b->list[i].e;
        arg[2 + 2 * i] = kind == NH_SUM ? nh_number(dag, b->list[i].c) : b->list[i].x;
    }
    nh_ex e = nh_dag_intern(dag, kind, 0, n, arg);
    if (arg != small) nh_free(arg);
    return e;
}

static void gather_terms(nh_dag *dag, nh_term_list *b, nh_ex e, nh_num scale)
{
    nh_kind kind = nh_kind_of(dag, e);
    if (kind == NH_NUMBER) {
        b->c = nh_num_add(b->c, nh_num_mul(scale, nh_number_of(dag, e)));
    } else if (kind == NH_SUM) {
        b->c = nh_num_add(b->c, nh_num_mul(scale, nh_constant_of(dag, e)));
        for (size_t i = 0; i < nh_arity(dag, e); i++)
            nh_term_list_push(
                b, (nh_term_list_item){.e = nh_child(dag, e, i), .c = nh_num_mul(scale, nh_coefficient_of(dag, e, i))});
    } else if (kind == NH_PRODUCT) {
        nh_num c = nh_num_mul(scale, nh_constant_of(dag, e));
        nh_ex rest = nh_product_without_number(dag, e);
        if (nh_kind_of(dag, rest) == NH_SUM) gather_terms(dag, b, rest, c);
        else nh_term_list_push(b, (nh_term_list_item){.e = rest, .c = c});
    } else {
        nh_term_list_push(b, (nh_term_list_item){.e = e, .c = scale});
    }
}

/* The content of the sum with the sign of its first coefficient, by which the sum is divided; where a coefficient is or
 * would become inexact, only the sign. */
static nh_num content_of(const nh_term_list *b)
{
    nh_num sign = nh_num_int(nh_num_value(b->list[0].c) < 0 ? -1 : 1);
    int64_t p = 0, q = 1;
    for (size_t i = 0; i <= b->count; i++) {
        nh_num c = i < b->count ? b->list[i].c : b->c;
        if (!nh_num_short(c)) return sign;
        p = nh_gcd(p, c.p);
        __int128 l = (__int128)q / nh_gcd(q, c.q) * c.q;
        if (l > INT64_MAX) return sign;
        q = (int64_t)l;
    }
    nh_num content = nh_num_mul(sign, nh_num_ratio(p, q)), inverse = nh_num_inv(content);
    for (size_t i = 0; i <= b->count; i++)
        if (!nh_num_short(nh_num_mul(inverse, i < b->count ? b->list[i].c : b->c))) return sign;
    return content;
}

static nh_ex times_number(nh_dag *dag, nh_num c, nh_ex e)
{
    if (nh_num_is(c, 1)) return e;
    return nh_mul(dag, nh_number(dag, c), e);
}

static nh_ex build_sum(nh_dag *dag, nh_term_list *b)
{
    if (b->count) qsort(b->list, b->count, sizeof *b->list, nh_term_list_order);
    size_t n = 0;
    for (size_t i = 0; i < b->count;) {
        nh_term_list_item x = b->list[i++];
        while (i < b->count && b->list[i].e == x.e) x.c = nh_num_add(x.c, b->list[i++].c);
        if (!nh_num_is(x.c, 0)) b->list[n++] = x;
    }
    b->count = n;
    if (n == 0) return nh_number(dag, b->c);
    if (n == 1 && nh_num_is(b->c, 0)) return times_number(dag, b->list[0].c, b->list[0].e);
    nh_num content = content_of(b), inverse = nh_num_inv(content);
    if (!nh_num_is(content, 1)) {
        b->c = nh_num_mul(b->c, inverse);
        for (size_t i = 0; i < n; i++) b->list[i].c = nh_num_mul(b->list[i].c, inverse);
    }
    nh_ex sum = nh_term_list_intern(dag, NH_SUM, b);
    if (nh_num_is(content, 1)) return sum;
    nh_term_list product = {.c = content};
    nh_term_list_push(&product, (nh_term_list_item){.e = sum, .x = nh_int(dag, 1)});
    nh_ex e = nh_term_list_intern(dag, NH_PRODUCT, &product);
    nh_free(product.list);
    return e;
}

nh_ex nh_linear(nh_dag *dag, size_t n, const nh_num *coefficient, const nh_ex *term)
{
    nh_term_list b = {.c = nh_num_int(0)};
    for (size_t i = 0; i < n; i++)
        if (!nh_num_is(coefficient[i], 0)) gather_terms(dag, &b, term[i], coefficient[i]);
    nh_ex e = build_sum(dag, &b);
    nh_free(b.list);
    return e;
}

nh_ex nh_add(nh_dag *dag, nh_ex a, nh_ex b)
{
    if (nh_is_zero(dag, a)) return b;
    if (nh_is_zero(dag, b)) return a;
    return nh_linear(dag, 2, (nh_num[]){nh_num_int(1), nh_num_int(1)}, (nh_ex[]){a, b});
}

nh_ex nh_sub(nh_dag *dag, nh_ex a, nh_ex b)
{
    if (nh_is_zero(dag, b)) return a;
    return nh_linear(dag, 2, (nh_num[]){nh_num_int(1), nh_num_int(-1)}, (nh_ex[]){a, b});
}

nh_ex nh_neg(nh_dag *dag, nh_ex a) { return nh_mul(dag, nh_int(dag, -1), a); }

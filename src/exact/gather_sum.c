/* gather_sum: arithmetic of sums of products of powers of kernels. */
#include <stdlib.h>
#include <string.h>

#include "exact/gather_internal.h"
#include "graph/dag.h"
#include "graph/function.h"
#include "graph/measure.h"
#include "graph/node.h"
#include "graph/num.h"

enum { largest_exponent = 60, largest_power = 6 };

static const nh_gather_sum nothing;

/* ---- kernels ---- */

static bool is_call(const nh_dag *d, nh_ex e, nh_function f)
{
    return nh_kind_of(d, e) == NH_FUNCTION && nh_function_of(d, e) == f;
}

size_t nh_gather_kernel(nh_gathering *g, nh_ex e)
{
    size_t k = 0;
    while (k < g->kernels && g->kernel[k] != e) k++;
    if (k < g->kernels) return k;
    if (k == NH_GATHER_KERNELS) {
        g->failed = true;
        return 0;
    }
    g->kernels++;
    g->kernel[k] = e;
    g->length[k] = nh_complexity(g->dag, e) + (nh_kind_of(g->dag, e) == NH_SUM);
    g->cosine[k] = -1;
    bool sine = is_call(g->dag, e, NH_SIN);
    if (!sine && !is_call(g->dag, e, NH_COS)) return k;
    size_t other = nh_gather_kernel(g, nh_call(g->dag, sine ? NH_COS : NH_SIN, nh_child(g->dag, e, 0)));
    if (!g->failed) g->cosine[sine ? k : other] = (int)(sine ? other : k);
    return k;
}

/* ---- sums ---- */

nh_gather_sum nh_gather_room(nh_gathering *g, size_t n)
{
    return (nh_gather_sum){.t = nh_arena_alloc(g->arena, (n + 1) * sizeof(nh_gather_term))};
}

static int by_exponents(const void *a, const void *b)
{
    return memcmp(((const nh_gather_term *)a)->x, ((const nh_gather_term *)b)->x, NH_GATHER_KERNELS);
}

bool nh_gather_same(const nh_gathering *g, const nh_gather_term *a, const nh_gather_term *b)
{
    return !memcmp(a->x, b->x, g->kernels);
}

void nh_gather_sort(nh_gathering *g, nh_gather_sum *s)
{
    size_t n = 0;
    g->work += 4 * s->n;
    if (s->n) qsort(s->t, s->n, sizeof *s->t, by_exponents);
    for (size_t i = 0; i < s->n;) {
        nh_gather_term sum = s->t[i++];
        while (i < s->n && nh_gather_same(g, &sum, &s->t[i])) sum.c = nh_num_add(sum.c, s->t[i++].c);
        if (!nh_num_short(sum.c)) g->failed = true;
        if (!nh_num_is(sum.c, 0)) s->t[n++] = sum;
    }
    s->n = n;
    if (n > NH_GATHER_TERMS) g->failed = true;
}

nh_gather_sum nh_gather_add(nh_gathering *g, nh_gather_sum a, nh_num c, nh_gather_sum b)
{
    nh_gather_sum s = nh_gather_room(g, a.n + b.n);
    for (size_t i = 0; i < a.n; i++) s.t[s.n++] = a.t[i];
    for (size_t i = 0; i < b.n; i++) {
        s.t[s.n] = b.t[i];
        s.t[s.n].c = nh_num_mul(c, b.t[i].c);
        s.n++;
    }
    nh_gather_sort(g, &s);
    return g->failed ? nothing : s;
}

static nh_gather_term product_of(nh_gathering *g, const nh_gather_term *a, const nh_gather_term *b, bool divide)
{
    nh_gather_term t = {.c = nh_num_mul(a->c, divide ? nh_num_inv(b->c) : b->c)};
    for (size_t k = 0; k < g->kernels; k++) {
        int x = a->x[k] + (divide ? -b->x[k] : b->x[k]);
        if (x > largest_exponent || x < -largest_exponent) g->failed = true;
        t.x[k] = (int8_t)x;
    }
    if (!nh_num_short(t.c)) g->failed = true;
    return t;
}

nh_gather_sum nh_gather_times(nh_gathering *g, nh_gather_sum a, const nh_gather_term *t, bool divide)
{
    nh_gather_sum s = nh_gather_room(g, a.n);
    for (size_t i = 0; i < a.n; i++) s.t[s.n++] = product_of(g, &a.t[i], t, divide);
    nh_gather_sort(g, &s);
    return g->failed ? nothing : s;
}

nh_gather_sum nh_gather_multiply(nh_gathering *g, nh_gather_sum a, nh_gather_sum b)
{
    if (a.n * b.n > (size_t)NH_GATHER_TERMS * NH_GATHER_TERMS) g->failed = true;
    if (g->failed) return nothing;
    nh_gather_sum s = nh_gather_room(g, a.n * b.n);
    for (size_t i = 0; i < a.n; i++)
        for (size_t j = 0; j < b.n; j++) s.t[s.n++] = product_of(g, &a.t[i], &b.t[j], false);
    nh_gather_sort(g, &s);
    return g->failed ? nothing : s;
}

static nh_gather_sum power(nh_gathering *g, nh_gather_sum a, int64_t n)
{
    nh_gather_sum p = a;
    if (n > largest_power && a.n > 1) g->failed = true;
    for (int64_t i = 1; i < n && !g->failed; i++) p = nh_gather_multiply(g, p, a);
    return p;
}

/* ---- quotients ---- */

bool nh_gather_divides(const nh_gathering *g, const nh_gather_term *d, const nh_gather_term *t)
{
    for (size_t k = 0; k < g->kernels; k++) {
        int x = t->x[k] - d->x[k];
        if (x < 0 && (t->x[k] >= 0 || x < t->x[k])) return false;
    }
    return true;
}

static const nh_gather_term *find(const nh_gather_sum *p, const nh_gather_term *t)
{
    return p->n ? bsearch(t, p->t, p->n, sizeof *t, by_exponents) : NULL;
}

/* Are all products of q with the terms of d there, with their coefficients, and not yet used? */
static bool takes(nh_gathering *g, const nh_gather_sum *p, const nh_gather_sum *d, const nh_gather_term *q, bool *used)
{
    size_t place[NH_GATHER_TERMS];
    for (size_t i = 0; i < d->n; i++) {
        nh_gather_term t = product_of(g, &d->t[i], q, false);
        const nh_gather_term *there = find(p, &t);
        if (!there || used[there - p->t] || !nh_num_equal(there->c, t.c)) return false;
        place[i] = (size_t)(there - p->t);
    }
    for (size_t i = 0; i < d->n; i++) used[place[i]] = true;
    return true;
}

bool nh_gather_divide(nh_gathering *g, nh_gather_sum p, nh_gather_sum d, nh_gather_sum *q, nh_gather_sum *r)
{
    bool used[NH_GATHER_TERMS] = {false};
    *q = nh_gather_room(g, p.n);
    *r = nh_gather_room(g, p.n);
    g->work += p.n * d.n;
    for (size_t i = 0; i < p.n && !g->failed; i++) {
        if (used[i] || !nh_gather_divides(g, &d.t[0], &p.t[i])) continue;
        nh_gather_term one = product_of(g, &p.t[i], &d.t[0], true);
        if (takes(g, &p, &d, &one, used)) q->t[q->n++] = one;
    }
    for (size_t i = 0; i < p.n; i++)
        if (!used[i]) r->t[r->n++] = p.t[i];
    nh_gather_sort(g, q);
    return q->n && !g->failed;
}

/* ---- sin^2 + cos^2 = 1 ---- */

nh_gather_sum nh_gather_reduce(nh_gathering *g, nh_gather_sum p, size_t from, size_t to)
{
    bool any = true;
    while (any && !g->failed) {
        nh_gather_sum s = nh_gather_room(g, 2 * p.n);
        any = false;
        for (size_t i = 0; i < p.n; i++) {
            nh_gather_term t = p.t[i];
            bool square = t.x[from] >= 2;
            any |= square;
            if (square) t.x[from] = (int8_t)(t.x[from] - 2);
            s.t[s.n++] = t;
            if (!square) continue;
            t.x[to] = (int8_t)(t.x[to] + 2);
            t.c = nh_num_mul(nh_num_int(-1), t.c);
            s.t[s.n++] = t;
        }
        nh_gather_sort(g, &s);
        p = s;
    }
    return g->failed ? nothing : p;
}

/* ---- from and to expressions ---- */

static nh_gather_sum single(nh_gathering *g, nh_num c, nh_ex kernel, int64_t exponent)
{
    nh_gather_sum s = nh_gather_room(g, 1);
    s.t[s.n++] = (nh_gather_term){.c = c};
    if (exponent > largest_exponent || exponent < -largest_exponent) g->failed = true;
    else if (exponent) s.t[0].x[nh_gather_kernel(g, kernel)] = (int8_t)exponent;
    return s;
}

static nh_gather_sum factor(nh_gathering *g, nh_ex base, nh_ex exponent)
{
    nh_num x = nh_kind_of(g->dag, exponent) == NH_NUMBER ? nh_number_of(g->dag, exponent) : nh_num_real(0.5);
    if (!nh_num_short(x)) return single(g, nh_num_int(1), nh_pow(g->dag, base, exponent), 1);
    if (x.q > 1) return single(g, nh_num_int(1), nh_pow(g->dag, base, nh_ratio(g->dag, 1, x.q)), x.p);
    nh_kind kind = nh_kind_of(g->dag, base);
    if (kind == NH_SUM && x.p > 0 && !g->closed) return power(g, nh_gather_expand(g, base), x.p);
    return single(g, nh_num_int(1), base, x.p);
}

nh_gather_sum nh_gather_expand(nh_gathering *g, nh_ex e)
{
    const nh_dag *d = g->dag;
    nh_kind kind = nh_kind_of(d, e);
    if (g->failed) return nothing;
    if (kind == NH_NUMBER) return single(g, nh_number_of(d, e), e, 0);
    if (kind == NH_SYMBOL || kind == NH_FUNCTION) return single(g, nh_num_int(1), e, 1);
    nh_gather_sum s = single(g, nh_constant_of(d, e), e, 0);
    if (kind == NH_SUM && nh_num_is(s.t[0].c, 0)) s.n = 0;
    for (size_t i = 0; i < nh_arity(d, e) && !g->failed; i++) {
        if (kind == NH_SUM) s = nh_gather_add(g, s, nh_coefficient_of(d, e, i), nh_gather_expand(g, nh_child(d, e, i)));
        else s = nh_gather_multiply(g, s, factor(g, nh_child(d, e, i), nh_exponent_of(d, e, i)));
    }
    return s;
}

nh_ex nh_gather_product(nh_gathering *g, const nh_gather_term *t)
{
    nh_ex factor[NH_GATHER_KERNELS + 1];
    size_t n = 0;
    factor[n++] = nh_number(g->dag, t->c);
    for (size_t k = 0; k < g->kernels; k++)
        if (t->x[k]) factor[n++] = nh_powi(g->dag, g->kernel[k], t->x[k]);
    return nh_product(g->dag, n, factor);
}

nh_ex nh_gather_written(nh_gathering *g, nh_gather_sum p)
{
    nh_ex term[NH_GATHER_TERMS];
    nh_num one[NH_GATHER_TERMS];
    for (size_t i = 0; i < p.n; i++) {
        term[i] = nh_gather_product(g, &p.t[i]);
        one[i] = nh_num_int(1);
    }
    return nh_linear(g->dag, p.n, one, term);
}

/* gather_shape: short forms of a sum, found by taking out divisors, completing squares, and sin^2 + cos^2 = 1.
 *
 * Divisors are what several terms share, and sums that occur more than once when the terms are divided by what they
 * share: the kernels and co-kernels of [BraytonMcMullen1982], as for polynomials in [HosangadiFallahKastner2006]. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "exact/gather_internal.h"
#include "graph/dag.h"
#include "graph/measure.h"
#include "graph/node.h"
#include "graph/num.h"

enum {
    most_divisors = 160, /* that are compared at one step */
    most_cokernels = 40,
    most_squares = 24, /* terms of sums whose squares are completed */
    bar = 3,           /* what a fraction bar counts more than another operator */
    bar_in_sum = 5,
    nested = 1, /* parentheses in parentheses */
    mixed = 1   /* and a sum of velocities and of what is none */
};

/* ---- lengths ---- */

typedef struct {
    size_t own;    /* what reads badly */
    double degree; /* in the velocities, symbols as x' */
} reading;

/* What reads badly: each symbol, function or sum below a fraction bar, more so inside of a sum; and among the sums in
 * parentheses those that stand inside of others, and those that mix degrees in the velocities; as often as it is
 * written.  `inside`: in so many sums. */
static reading read_of(const nh_dag *d, nh_ex e, size_t inside)
{
    nh_kind kind = nh_kind_of(d, e);
    reading r = {.own = kind == NH_SUM && inside > 1 ? nested : 0};
    bool mixes = false;
    if (kind == NH_SYMBOL) r.degree = strchr(nh_name_of(d, e), '\'') != NULL;
    for (size_t i = 0; i < nh_arity(d, e); i++) {
        reading part = read_of(d, nh_child(d, e, i), inside + (kind == NH_SUM));
        r.own += part.own;
        if (kind == NH_SUM) {
            mixes |= i && part.degree != r.degree;
            r.degree = fmax(r.degree, part.degree);
        }
        if (kind != NH_PRODUCT) continue;
        nh_ex x = nh_exponent_of(d, e, i);
        double power = nh_kind_of(d, x) == NH_NUMBER ? nh_num_value(nh_number_of(d, x)) : 0;
        r.degree += part.degree * power;
        r.own += power >= 0 ? 0 : inside ? bar_in_sum : bar;
    }
    if (mixes && inside) r.own += mixed;
    return r;
}

size_t nh_gather_cost(const nh_dag *d, nh_ex e) { return nh_complexity(d, e) + read_of(d, e, 0).own; }

void nh_gather_offer(nh_gather_contest *c, nh_ex e)
{
    if (c->g->failed || e == c->best) return;
    size_t length = nh_gather_cost(c->g->dag, e);
    if (length >= c->length) return;
    c->best = e;
    c->length = length;
}

static size_t length_of_term(const nh_gathering *g, const nh_gather_term *t)
{
    size_t length = t->c.q == 1 && (t->c.p == 1 || t->c.p == -1) ? 0 : 2;
    for (size_t k = 0; k < g->kernels; k++)
        if (t->x[k]) length += 1 + g->length[k] + (t->x[k] > 1 || t->x[k] < -1 ? 2 : 0);
    return length ? length - 1 : 1;
}

static size_t length_of(const nh_gathering *g, nh_gather_sum p)
{
    size_t length = 0;
    for (size_t i = 0; i < p.n; i++) length += length_of_term(g, &p.t[i]) + 1;
    return length ? length - 1 : 0;
}

/* ---- divisors ---- */

typedef struct {
    nh_gather_sum d;
    size_t saved;
} divisor;

typedef struct {
    nh_gather_contest *c;
    size_t n, cokernels, whole;
    divisor list[most_divisors];
    nh_gather_term cokernel[most_cokernels];
    nh_gather_sum kernel[most_cokernels];
} divisors;

/* What two terms share. */
static nh_gather_term shared_by(const nh_gathering *g, const nh_gather_term *a, const nh_gather_term *b)
{
    nh_gather_term t = {.c = nh_num_int(1)};
    for (size_t k = 0; k < g->kernels; k++) {
        int x = a->x[k], y = b->x[k];
        if (x > 0 && y > 0) t.x[k] = (int8_t)(x < y ? x : y);
        if (x < 0 && y < 0) t.x[k] = (int8_t)(x > y ? x : y);
    }
    return t;
}

bool nh_gather_is_one(const nh_gathering *g, const nh_gather_term *t)
{
    for (size_t k = 0; k < g->kernels; k++)
        if (t->x[k]) return false;
    return true;
}

/* The terms with all of t, divided by it. */
static nh_gather_sum with(nh_gathering *g, nh_gather_sum p, const nh_gather_term *t)
{
    nh_gather_sum s = nh_gather_room(g, p.n);
    for (size_t i = 0; i < p.n; i++) {
        nh_gather_term common = shared_by(g, &p.t[i], t);
        if (nh_gather_same(g, &common, t)) s.t[s.n++] = p.t[i];
    }
    return nh_gather_times(g, s, t, true);
}

/* Divided by the coefficient of its first term. */
static nh_gather_sum monic(nh_gathering *g, nh_gather_sum p)
{
    nh_gather_term number = {.c = p.n ? p.t[0].c : nh_num_int(1)};
    return nh_gather_times(g, p, &number, true);
}

static bool equal(const nh_gathering *g, nh_gather_sum a, nh_gather_sum b)
{
    bool same = a.n == b.n;
    for (size_t i = 0; i < a.n && same; i++)
        same = nh_gather_same(g, &a.t[i], &b.t[i]) && nh_num_equal(a.t[i].c, b.t[i].c);
    return same;
}

static void add_divisor(divisors *x, nh_gather_sum d)
{
    nh_gathering *g = x->c->g;
    nh_gather_sum q, r;
    if (x->n == most_divisors || !d.n || nh_gather_tired(g)) return;
    for (size_t i = 0; i < x->n; i++)
        if (equal(g, x->list[i].d, d)) return;
    if (!nh_gather_divide(g, x->c->p, d, &q, &r) || (d.n == 1 && q.n < 2)) return;
    size_t parts = length_of(g, d) + (d.n > 1) + length_of(g, q) + (q.n > 1) + 1;
    if (r.n) parts += 1 + length_of(g, r);
    if (parts >= x->whole) return;
    x->list[x->n++] = (divisor){.d = d, .saved = x->whole - parts};
}

static void add_cokernel(divisors *x, const nh_gather_term *t)
{
    nh_gathering *g = x->c->g;
    for (size_t i = 0; i < x->cokernels; i++)
        if (nh_gather_same(g, &x->cokernel[i], t)) return;
    if (x->cokernels == most_cokernels || nh_gather_tired(g)) return;
    g->work += x->c->p.n * g->kernels;
    x->cokernel[x->cokernels] = *t;
    x->kernel[x->cokernels++] = with(g, x->c->p, t);
}

/* The terms that two sums have in common when they are multiplied by numbers: those of the ratio that the most have. */
static nh_gather_sum common_part(nh_gathering *g, nh_gather_sum a, nh_gather_sum b, bool opposite)
{
    nh_gather_sum s = nh_gather_room(g, a.n);
    for (size_t i = 0; i < a.n; i++)
        for (size_t j = 0; j < b.n; j++)
            if (nh_gather_same(g, &a.t[i], &b.t[j]) &&
                nh_num_equal(a.t[i].c, opposite ? nh_num_mul(nh_num_int(-1), b.t[j].c) : b.t[j].c))
                s.t[s.n++] = a.t[i];
    g->work += a.n * b.n;
    return s;
}

static int by_saving(const void *a, const void *b)
{
    const divisor *x = a, *y = b;
    return x->saved != y->saved ? (x->saved > y->saved ? -1 : 1) : (x->d.n > y->d.n) - (x->d.n < y->d.n);
}

static void find_divisors(divisors *x)
{
    nh_gathering *g = x->c->g;
    nh_gather_sum p = x->c->p;
    x->whole = length_of(g, p);
    for (size_t i = 0; i < p.n; i++)
        for (size_t j = 0; j < i && !nh_gather_tired(g); j++) {
            nh_gather_term t = shared_by(g, &p.t[i], &p.t[j]);
            g->work += g->kernels;
            if (!nh_gather_is_one(g, &t)) add_cokernel(x, &t);
            for (size_t k = 0; k < g->kernels; k++) {
                nh_gather_term alone = {.c = nh_num_int(1)};
                alone.x[k] = t.x[k];
                if (t.x[k]) add_cokernel(x, &alone);
            }
        }
    for (size_t i = 0; i < x->cokernels; i++) {
        add_divisor(x, (nh_gather_sum){.n = 1, .t = &x->cokernel[i]});
        if (x->kernel[i].n > 1) add_divisor(x, monic(g, x->kernel[i]));
    }
    for (size_t i = 0; i < x->cokernels; i++)
        for (size_t j = 0; j < i && !nh_gather_tired(g); j++)
            for (int opposite = 0; opposite < 2; opposite++) {
                nh_gather_sum s = common_part(g, x->kernel[i], x->kernel[j], opposite);
                if (s.n > 1) add_divisor(x, monic(g, s));
            }
    qsort(x->list, x->n, sizeof *x->list, by_saving);
}

static void offer_divisors(nh_gather_contest *c)
{
    nh_gathering *g = c->g;
    divisors *x = nh_alloc(sizeof *x);
    x->c = c;
    find_divisors(x);
    size_t tries = c->width > 0 ? (size_t)c->width : 1;
    for (size_t i = 0; i < x->n && i < tries && !nh_gather_tired(g); i++) {
        nh_gather_sum q, r;
        if (!nh_gather_divide(g, c->p, x->list[i].d, &q, &r)) continue;
        nh_ex product =
            nh_mul(c->g->dag, nh_gather_shape(g, x->list[i].d, c->width / 2), nh_gather_shape(g, q, c->width / 2));
        nh_gather_offer(c, nh_add(c->g->dag, product, nh_gather_shape(g, r, c->width - 1)));
    }
    nh_free(x);
}

/* ---- by parameters, by velocities ---- */

/* Kernels of which no term has two: p = sum of k_i q_i, and a rest.  Begins with `first`, in the order of kernels. */
static uint32_t exclusive(const nh_gathering *g, nh_gather_sum p, size_t first)
{
    uint32_t set = 0;
    for (size_t i = 0; i < g->kernels; i++) {
        size_t k = (first + i) % g->kernels;
        bool fits = true, any = false;
        for (size_t j = 0; j < p.n && fits; j++) {
            int x = p.t[j].x[k];
            fits = x == 0 || x == 1;
            any |= x == 1;
            for (size_t l = 0; l < g->kernels && x; l++) fits = fits && !((set >> l & 1) && p.t[j].x[l]);
        }
        if (fits && any) set |= (uint32_t)1 << k;
    }
    return set;
}

static void offer_each(nh_gather_contest *c, uint32_t set)
{
    nh_gathering *g = c->g;
    nh_gather_sum rest = c->p, q, r;
    nh_ex sum = nh_int(g->dag, 0);
    for (size_t k = 0; k < g->kernels; k++) {
        nh_gather_term one = {.c = nh_num_int(1)};
        if (!(set >> k & 1)) continue;
        one.x[k] = 1;
        if (!nh_gather_divide(g, rest, (nh_gather_sum){.n = 1, .t = &one}, &q, &r)) continue;
        sum = nh_add(c->g->dag, sum, nh_mul(c->g->dag, g->kernel[k], nh_gather_shape(g, q, c->width - 2)));
        rest = r;
    }
    nh_gather_offer(c, nh_add(c->g->dag, sum, nh_gather_shape(g, rest, c->width - 2)));
}

static void offer_sets(nh_gather_contest *c)
{
    uint32_t tried[NH_GATHER_KERNELS];
    size_t n = 0;
    for (size_t k = 0; k < c->g->kernels && !nh_gather_tired(c->g); k++) {
        uint32_t set = exclusive(c->g, c->p, k);
        bool known = !(set & (set - 1)); /* of one: a divisor */
        for (size_t i = 0; i < n; i++) known |= tried[i] == set;
        if (known) continue;
        tried[n++] = set;
        offer_each(c, set);
    }
}

/* ---- common denominators, of symbols and functions: products of sums would stand above ---- */

static void offer_denominators(nh_gather_contest *c)
{
    nh_gathering *g = c->g;
    nh_gather_term all = {.c = nh_num_int(1)};
    size_t below = 0;
    for (size_t k = 0; k < g->kernels; k++) {
        for (size_t i = 0; i < c->p.n && nh_kind_of(g->dag, g->kernel[k]) != NH_SUM; i++)
            if (c->p.t[i].x[k] < all.x[k]) all.x[k] = c->p.t[i].x[k];
        below += all.x[k] < 0;
    }
    if (!below) return;
    nh_gather_sum top = nh_gather_times(g, c->p, &all, true);
    nh_gather_offer(c, nh_mul(c->g->dag, nh_gather_product(g, &all), nh_gather_shape(g, top, c->width - 1)));
}

/* ---- sin^2 + cos^2 = 1 ---- */

/* Every term without this angle times sin^2 + cos^2, where the others have two factors of it. */
static bool homogeneous(nh_gathering *g, nh_gather_sum p, size_t sine, size_t cosine, nh_gather_sum *out)
{
    size_t without = 0;
    *out = nh_gather_room(g, 2 * p.n);
    for (size_t i = 0; i < p.n; i++) {
        nh_gather_term t = p.t[i];
        int x = t.x[sine], y = t.x[cosine];
        if (x < 0 || y < 0 || (x + y != 2 && x + y != 0)) return false;
        if (x + y) {
            out->t[out->n++] = t;
            continue;
        }
        without++;
        t.x[sine] = 2;
        out->t[out->n++] = t;
        t.x[sine] = 0;
        t.x[cosine] = 2;
        out->t[out->n++] = t;
    }
    if (!without || without == p.n) return false;
    nh_gather_sort(g, out);
    return !g->failed;
}

static void offer_angle(nh_gather_contest *c, size_t sine, size_t cosine)
{
    nh_gathering *g = c->g;
    bool squares = false;
    for (size_t i = 0; i < c->p.n; i++) squares |= c->p.t[i].x[sine] > 1 || c->p.t[i].x[cosine] > 1;
    if (!squares) return;
    nh_gather_sum form[3] = {nh_gather_reduce(g, c->p, sine, cosine), nh_gather_reduce(g, c->p, cosine, sine)};
    size_t forms = homogeneous(g, c->p, sine, cosine, &form[2]) ? 3 : 2;
    for (size_t i = 0; i < forms && !nh_gather_tired(g); i++)
        if (form[i].n <= c->p.n + 2 && !equal(g, form[i], c->p))
            nh_gather_offer(c, nh_gather_shape(g, form[i], c->width - 1));
}

static void offer_angles(nh_gather_contest *c)
{
    for (size_t k = 0; k < c->g->kernels && c->p.n <= most_squares && !nh_gather_tired(c->g); k++)
        if (c->g->cosine[k] >= 0) offer_angle(c, k, (size_t)c->g->cosine[k]);
}

/* ---- a sum ---- */

/* What all terms share, with the number that all coefficients are whole multiples of. */
static nh_gather_term content_of(nh_gathering *g, nh_gather_sum p)
{
    nh_gather_term t = p.t[0];
    int64_t top = 0, below = 1;
    for (size_t i = 0; i < p.n; i++) {
        nh_gather_term both = shared_by(g, &t, &p.t[i]);
        memcpy(t.x, both.x, sizeof t.x);
        top = nh_gcd(top, p.t[i].c.p);
        nh_num l = nh_num_mul(nh_num_int(below / nh_gcd(below, p.t[i].c.q)), nh_num_int(p.t[i].c.q));
        if (!nh_num_short(l)) g->failed = true;
        else below = l.p;
    }
    t.c = nh_num_ratio(top, below);
    return t;
}

static nh_ex shape_of(nh_gathering *g, nh_gather_sum p, int width)
{
    nh_gather_contest c = {.g = g, .p = p, .width = width, .best = nh_gather_written(g, p)};
    c.length = nh_gather_cost(g->dag, c.best);
    if (nh_gather_tired(g)) return c.best;
    if (width > 1) offer_sets(&c);
    if (p.n > 2 && p.n <= most_squares) nh_gather_offer_squares(&c);
    if (width > 0) offer_denominators(&c);
    if (width > 0) offer_angles(&c);
    offer_divisors(&c);
    return c.best;
}

static size_t place_of(const nh_gathering *g, nh_gather_sum p, int width)
{
    uint64_t hash = (uint64_t)width + 1469598103934665603u;
    for (size_t i = 0; i < p.n; i++) {
        for (size_t k = 0; k < g->kernels; k++) hash = (hash ^ (uint64_t)(p.t[i].x[k] + 128)) * 1099511628211u;
        hash = (hash ^ (uint64_t)p.t[i].c.p ^ ((uint64_t)p.t[i].c.q << 32)) * 1099511628211u;
    }
    return (size_t)(hash >> 32) % NH_GATHER_MEMO;
}

nh_ex nh_gather_shape(nh_gathering *g, nh_gather_sum p, int width)
{
    if (!p.n || g->failed) return nh_int(g->dag, 0);
    if (p.n == 1) return nh_gather_product(g, &p.t[0]);
    if (width < 0) width = 0;
    nh_gather_term content = content_of(g, p);
    p = nh_gather_times(g, p, &content, true);
    if (g->failed) return nh_int(g->dag, 0);
    size_t at = place_of(g, p, width);
    bool known = g->memo[at].sum.n && g->memo[at].width == width && equal(g, g->memo[at].sum, p);
    nh_ex shape = known ? g->memo[at].shape : shape_of(g, p, width);
    g->memo[at].sum = p;
    g->memo[at].width = width;
    g->memo[at].shape = shape;
    return nh_mul(g->dag, nh_gather_product(g, &content), shape);
}

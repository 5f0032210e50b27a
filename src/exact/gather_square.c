/* gather_square: squares of sums: a x^2 + b x + c completed, and pairs k u^2 + k v^2 with 2 k u v. */
#include <math.h>

#include "exact/gather_internal.h"
#include "graph/dag.h"
#include "graph/num.h"

/* The sum with sin^2 or cos^2 replaced wherever that gives fewer terms. */
static nh_gather_sum fewest(nh_gathering *g, nh_gather_sum p)
{
    for (size_t k = 0; k < g->kernels && !nh_gather_tired(g); k++) {
        if (g->cosine[k] < 0) continue;
        size_t other = (size_t)g->cosine[k];
        nh_gather_sum a = nh_gather_reduce(g, p, k, other), b = nh_gather_reduce(g, p, other, k);
        g->work += 4 * p.n;
        if (g->failed) return p;
        if (a.n < p.n) p = a;
        if (b.n < p.n) p = b;
    }
    return p;
}

/* a x^2 + b x + c = a/v^2 (v x + r)^2 + c - a r^2/v^2 with r = b v/(2 a), where that leaves no more terms than c has,
 * and none where c has one.  The parts are c, b and a; u = v x with a power x of a kernel. */
static void offer_square(nh_gather_contest *c, size_t k, const nh_gather_sum part[3], const nh_gather_term *u)
{
    nh_gathering *g = c->g;
    nh_gather_term v = *u, twice;
    v.x[k] = 0;
    twice = v;
    twice.c = nh_num_int(2);
    nh_gather_sum a = nh_gather_times(g, nh_gather_times(g, part[2], &v, true), &v, true), r, none,
                  doubled = nh_gather_times(g, a, &twice, false);
    if (g->failed || !nh_gather_divide(g, part[1], doubled, &r, &none) || none.n) return;
    nh_gather_sum square = nh_gather_multiply(g, a, nh_gather_multiply(g, r, r)),
                  rest = fewest(g, nh_gather_add(g, part[0], nh_num_int(-1), square));
    if (g->failed || rest.n + (part[0].n < 2) > part[0].n) return;
    nh_ex base = nh_add(c->g->dag, nh_gather_product(g, u), nh_gather_shape(g, r, c->width / 2));
    nh_ex product = nh_mul(c->g->dag, nh_gather_shape(g, a, c->width / 2), nh_powi(g->dag, base, 2));
    nh_gather_offer(c, nh_add(c->g->dag, product, nh_gather_shape(g, rest, c->width - 1)));
}

/* The least power of the kernel, if all its powers are this one and its square; else 0. */
static int power_in(const nh_gather_sum *p, size_t k)
{
    int least = 0;
    for (size_t i = 0; i < p->n; i++) {
        int x = p->t[i].x[k];
        if (x < 0) return 0;
        if (x && (!least || x < least)) least = x;
    }
    for (size_t i = 0; i < p->n && least; i++) {
        int x = p->t[i].x[k];
        if (x && x != least && x != 2 * least) return 0;
    }
    return least;
}

/* Squares in one kernel. */
static void offer_squares_in(nh_gather_contest *c, size_t k)
{
    nh_gathering *g = c->g;
    nh_gather_sum part[3];
    nh_gather_term one = {.c = nh_num_int(1)}, root = one;
    int power = power_in(&c->p, k);
    if (!power) return;
    for (int i = 0; i < 3; i++) part[i] = nh_gather_room(g, c->p.n);
    for (size_t i = 0; i < c->p.n; i++) {
        nh_gather_term t = c->p.t[i];
        nh_gather_sum *to = &part[t.x[k] / power];
        t.x[k] = 0;
        to->t[to->n++] = t;
    }
    if (!part[2].n || !part[1].n) return;
    for (int i = 0; i < 3; i++) nh_gather_sort(g, &part[i]);
    one.x[k] = (int8_t)power;
    offer_square(c, k, part, &one);
    root.x[k] = (int8_t)power;
    for (size_t i = 0; i < g->kernels && part[2].n == 1; i++) root.x[i] = (int8_t)(root.x[i] + part[2].t[0].x[i] / 2);
    if (!nh_gather_same(g, &root, &one)) offer_square(c, k, part, &root);
}

/* The root of a positive rational that is a square; 0 else. */
static nh_num root_of(nh_num c)
{
    int64_t p = (int64_t)sqrt((double)c.p), q = (int64_t)sqrt((double)c.q);
    return c.p > 0 && p * p == c.p && q * q == c.q ? nh_num_ratio(p, q) : nh_num_int(0);
}

/* Are terms i and j k u^2 and k v^2, and is there a term 2 k u v or -2 k u v?  Then *at is its place, and
 * *square = k (u + v)^2 or k (u - v)^2. */
static bool is_square(nh_gather_contest *c, const nh_gather_sum *p, size_t i, size_t j, size_t *at, nh_ex *square)
{
    nh_gathering *g = c->g;
    const nh_gather_term *x = &p->t[i], *y = &p->t[j];
    nh_gather_term k = {.c = x->c}, u = {.c = nh_num_int(1)}, v = {.c = nh_num_mul(y->c, nh_num_inv(x->c))}, cross = u;
    if (!nh_num_short(v.c) || nh_num_is(root_of(v.c), 0)) return false;
    v.c = root_of(v.c);
    for (size_t l = 0; l < g->kernels; l++) {
        if (x->x[l] < 0 || y->x[l] < 0 || (x->x[l] + y->x[l]) % 2) return false;
        k.x[l] = x->x[l] % 2;
        u.x[l] = (int8_t)(x->x[l] / 2);
        v.x[l] = (int8_t)(y->x[l] / 2);
        cross.x[l] = (int8_t)((x->x[l] + y->x[l]) / 2);
    }
    nh_num twice = nh_num_mul(nh_num_int(2), nh_num_mul(k.c, v.c));
    for (*at = 0; *at < p->n && !nh_gather_same(g, &p->t[*at], &cross);) ++*at;
    if (*at == p->n) return false;
    bool minus = nh_num_equal(p->t[*at].c, nh_num_mul(nh_num_int(-1), twice));
    if (!minus && !nh_num_equal(p->t[*at].c, twice)) return false;
    if (minus) v.c = nh_num_mul(nh_num_int(-1), v.c);
    nh_ex sum = nh_add(c->g->dag, nh_gather_product(g, &u), nh_gather_product(g, &v));
    *square = nh_mul(c->g->dag, nh_gather_product(g, &k), nh_powi(g->dag, sum, 2));
    return true;
}

/* Squares of two terms, one after another, and the rest. */
static void offer_pairs(nh_gather_contest *c)
{
    nh_gathering *g = c->g;
    nh_gather_sum rest = nh_gather_add(g, c->p, nh_num_int(0), c->p);
    nh_ex squares = nh_int(g->dag, 0), square;
    for (size_t i = 0, at; i < rest.n && !nh_gather_tired(g); i++)
        for (size_t j = i + 1; j < rest.n; j++) {
            g->work += g->kernels;
            if (!is_square(c, &rest, i, j, &at, &square)) continue;
            squares = nh_add(c->g->dag, squares, square);
            rest.t[i].c = rest.t[j].c = rest.t[at].c = nh_num_int(0);
            nh_gather_sort(g, &rest);
            i = (size_t)-1;
            break;
        }
    if (!nh_is_zero(g->dag, squares))
        nh_gather_offer(c, nh_add(c->g->dag, squares, nh_gather_shape(g, rest, c->width - 1)));
}

void nh_gather_offer_squares(nh_gather_contest *c)
{
    for (size_t k = 0; k < c->g->kernels && !nh_gather_tired(c->g); k++) offer_squares_in(c, k);
    offer_pairs(c);
}

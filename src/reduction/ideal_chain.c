/* The bracket of a Lie algebra along a chain of ideals (ideal_chain.h, [CendraDiaz2018, eq. 14]).
 *
 *      g = n_0  >  n_1  >  n_2  > ..          basis vectors in order:  [ block 0 | block 1 | block 2 .. ]
 *
 *      H_j: a vector of block j less its g0-projection on what lies behind it, so that xi = H_0 xi_0 + H_1 xi_1 + ..
 *      [e, f] in parts = within blocks (block_i, -a_j) + across blocks (b_j of e, less b_j of f) */
#include "reduction/ideal_chain.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "base/memory.h"
#include "reduction/subspace.h"

/* ---- the chain ---- */

/* Are the vectors from `from` on an ideal of those from `above` on? */
static bool ideal(const nh_algebra *g, size_t above, size_t from, nh_error *error, const size_t *order)
{
    size_t d = g->d;
    double most = nh_largest(d * d * d, g->c);
    for (size_t a = above; a < d; a++)
        for (size_t b = from; b < d; b++)
            for (size_t k = 0; k < from; k++)
                if (fabs(g->c[(a * d + b) * d + k]) > 1e-9 * most)
                    return nh_fail(error, NH_INPUT, "",
                                   "a subgroup of the chain is not normal in the one before it: [e%zu, e%zu] has a "
                                   "component along e%zu",
                                   order[a] + 1, order[b] + 1, order[k] + 1);
    return true;
}

/* H_j: e_i of block j minus its g0-projection on n_(j+1), spanned by the vectors behind. */
static bool make_lifts(nh_ideals *c, const double *metric)
{
    size_t d = c->d;
    double *g = nh_alloc_array(3 * d * d + 1, sizeof *g), *a = g + d * d, *b = a + d * d;
    bool good = true;
    for (size_t i = 0; i < d; i++)
        for (size_t j = 0; j < d; j++) g[i + j * d] = metric[c->order[i] + c->order[j] * d];
    for (size_t j = 0; j < c->blocks && good; j++) {
        size_t first = c->start[j] + c->size[j], n = d - first;
        for (size_t i = c->start[j]; i < first && good; i++) {
            double *h = c->lift + i * d;
            h[i] = 1;
            for (size_t r = 0; r < n; r++) {
                for (size_t s = 0; s < n; s++) a[r + s * n] = g[first + r + (first + s) * d];
                b[r] = -g[first + r + i * d];
            }
            if (n) good = nh_solve(n, a, 1, b, NULL);
            for (size_t r = 0; r < n; r++) h[first + r] = b[r];
        }
    }
    for (size_t i = 0; i < d * d; i++) {
        a[i] = c->lift[i];
        c->split[i] = i % (d + 1) == 0;
    }
    if (good && d) good = nh_solve(d, a, d, c->split, NULL);
    nh_free(g);
    return good;
}

bool nh_ideals_init(nh_ideals *c, const nh_algebra *g, size_t blocks, const size_t *size, const size_t *order,
                    const double *metric, nh_error *error)
{
    size_t d = g->d, at = 0;
    *c = (nh_ideals){.d = d, .blocks = blocks, .size = nh_alloc_array(2 * blocks + d + 1, sizeof *c->size)};
    c->start = c->size + blocks;
    c->order = c->start + blocks;
    c->lift = nh_alloc_array(2 * d * d + 1, sizeof *c->lift);
    c->split = c->lift + d * d;
    double *t = nh_alloc_array(d * d + 1, sizeof *t);
    for (size_t j = 0; j < blocks; at += size[j], j++) c->size[j] = size[j], c->start[j] = at;
    memcpy(c->order, order, d * sizeof *order);
    for (size_t i = 0; i < d; i++) t[order[i] + i * d] = 1;
    c->algebra = nh_algebra_change(g, d, t, NULL);
    nh_free(t);
    bool good = at == d || nh_fail(error, NH_INPUT, "",
                                   "the blocks of the chain contain %zu generators, but the group has %zu", at, d);
    for (size_t j = 1; j < blocks && good; j++) good = ideal(&c->algebra, c->start[j - 1], c->start[j], error, order);
    if (good && !make_lifts(c, metric))
        good = nh_fail(error, NH_NUMERIC, "", "the inner product on the Lie algebra is singular");
    if (!good) nh_ideals_clear(c);
    return good;
}

void nh_ideals_clear(nh_ideals *c)
{
    nh_free(c->size);
    nh_free(c->lift);
    nh_algebra_clear(&c->algebra);
    *c = (nh_ideals){0};
}

/* The number of elements of the set. */
static size_t bits(unsigned long set)
{
    size_t n = 0;
    for (; set; set &= set - 1) n++;
    return n;
}

/* Is the span of these basis vectors an ideal of the whole algebra? */
static bool spans_ideal(const nh_algebra *g, unsigned long set)
{
    size_t d = g->d;
    for (size_t a = 0; a < d; a++)
        for (size_t b = 0; b < d; b++)
            for (size_t k = 0; k < d && set >> b & 1; k++)
                if (!(set >> k & 1) && g->c[(a * d + b) * d + k] != 0) return false;
    return true;
}

size_t nh_ideals_find(const nh_algebra *g, size_t *size, size_t *order)
{
    enum { most = 14 };
    size_t d = g->d, blocks = 0, at = 0;
    unsigned long now = d <= most ? (1ul << d) - 1 : 0;
    if (d > most) {
        for (size_t i = 0; i < d; i++) order[i] = i;
        size[0] = d;
        return 1;
    }
    while (now) {
        unsigned long best = 0;
        /* subsets; the largest ideal, of equal ones that of the first vectors */
        for (unsigned long set = (now - 1) & now; set; set = (set - 1) & now)
            if (bits(set) >= bits(best) && spans_ideal(g, set)) best = set;
        size[blocks] = bits(now) - bits(best);
        for (size_t i = 0; i < d; i++)
            if ((now & ~best) >> i & 1) order[at++] = i;
        blocks++;
        now = best;
    }
    return blocks;
}

/* ---- parts ---- */

void nh_ideals_split(const nh_ideals *c, const double *xi, double *parts)
{
    double *x = nh_alloc_array(c->d + 1, sizeof *x);
    for (size_t i = 0; i < c->d; i++) x[i] = xi[c->order[i]];
    nh_multiply(c->d, 1, c->d, c->split, x, parts);
    nh_free(x);
}

void nh_ideals_join(const nh_ideals *c, const double *parts, double *xi)
{
    double *x = nh_alloc_array(c->d + 1, sizeof *x);
    nh_multiply(c->d, 1, c->d, c->lift, parts, x);
    for (size_t i = 0; i < c->d; i++) xi[c->order[i]] = x[i];
    nh_free(x);
}

void nh_ideals_split_covector(const nh_ideals *c, const double *mu, double *beta)
{
    for (size_t j = 0; j < c->d; j++) {
        beta[j] = 0;
        for (size_t i = 0; i < c->d; i++) beta[j] += c->lift[i + j * c->d] * mu[c->order[i]];
    }
}

/* ---- the bracket by stages ---- */

/* sum of H_k x_k over blocks from..to - 1. */
static void lifted(const nh_ideals *c, size_t from, size_t to, const double *x, double *out)
{
    memset(out, 0, c->d * sizeof *out);
    for (size_t k = from; k < to; k++)
        for (size_t i = c->start[k]; i < c->start[k] + c->size[k]; i++)
            for (size_t r = 0; r < c->d; r++) out[r] += c->lift[r + i * c->d] * x[i];
}

/* [H_j x, H_j y] cut into what block j gets, and -a_j(x, y) in parts, added to out. */
static void add_within(const nh_ideals *c, size_t j, const double *e, const double *f, double *work, double *out)
{
    size_t d = c->d;
    double *x = work, *y = x + d, *b = y + d, *rest = b + d;
    lifted(c, j, j + 1, e, x);
    lifted(c, j, j + 1, f, y);
    nh_algebra_bracket(&c->algebra, x, y, b);
    memcpy(rest, b, d * sizeof *rest);
    /* block j of a vector of n_j is read off directly */
    for (size_t i = c->start[j]; i < c->start[j] + c->size[j]; i++) {
        out[i] += b[i];
        for (size_t r = 0; r < d; r++) rest[r] -= b[i] * c->lift[r + i * d];
    }
    nh_multiply(d, 1, d, c->split, rest, x); /* rest = -a_j lies in n_(j+1) */
    for (size_t i = c->start[j] + c->size[j]; i < d; i++) out[i] += x[i];
}

/* sign b_j(x_j, sum_(k>j) H_k y_k) in parts. */
static void add_across(const nh_ideals *c, size_t j, double sign, const double *e, const double *f, double *work,
                       double *out)
{
    size_t d = c->d;
    double *x = work, *y = x + d, *b = y + d;
    lifted(c, j, j + 1, e, x);
    lifted(c, j + 1, c->blocks, f, y);
    nh_algebra_bracket(&c->algebra, x, y, b);
    nh_multiply(d, 1, d, c->split, b, x);
    for (size_t i = c->start[j] + c->size[j]; i < d; i++) out[i] += sign * x[i];
}

void nh_ideals_bracket(const nh_ideals *c, const double *e, const double *f, double *out)
{
    double *work = nh_alloc_array(4 * c->d + 1, sizeof *work);
    memset(out, 0, c->d * sizeof *out);
    for (size_t j = 0; j < c->blocks; j++) {
        add_within(c, j, e, f, work, out);
        add_across(c, j, 1, e, f, work, out);
        add_across(c, j, -1, f, e, work, out);
    }
    nh_free(work);
}

void nh_ideals_euler_poincare(const nh_ideals *c, const double *eta, const double *beta, double *out)
{
    size_t d = c->d;
    double *unit = nh_alloc_array(2 * d + 1, sizeof *unit), *b = unit + d;
    for (size_t i = 0; i < d; i++) {
        for (size_t k = 0; k < d; k++) unit[k] = k == i;
        nh_ideals_bracket(c, eta, unit, b);
        out[i] = 0;
        for (size_t k = 0; k < d; k++) out[i] += beta[k] * b[k];
    }
    nh_free(unit);
}

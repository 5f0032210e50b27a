/* scaling: the constants kappa, mu, sigma, tau, e (and weights beta of functions) of a linear system.
 * [docs/method.md, sec. 10, "Weights"]
 *
 *     columns     kappa (coordinates) | mu (coordinates) | sigma (n) | tau | e | beta (functions)
 *     rows, at each random point and for each f = rho^s, M_ij, A_i, function:
 *                 q_k f_q  ..         | f_q ..           | w_i f_w   |  - (weight of f) f
 *
 * Series of first order at a point give f and its derivatives. */
#include "count/scaling.h"

#include <string.h>

#include "exact/residue_matrix.h"
#include "graph/num.h"

enum { spare = 8, most_tries = 200, longest = 1000 };

/* The columns of the linear system. */
typedef struct {
    size_t coordinates, n, functions, rates, width; /* rates: of the coordinates without time */
    size_t shift, velocity, time, energy, weight;   /* first column of each kind; kappa comes first */
} columns;

static columns columns_of(const nh_jet_equations *x, size_t functions)
{
    columns c = {.coordinates = x->coordinates, .n = x->n, .functions = functions, .rates = x->m};
    c.shift = c.coordinates;
    c.velocity = c.shift + c.coordinates;
    c.time = c.velocity + c.n;
    c.energy = c.time + 1;
    c.weight = c.energy + 1;
    c.width = c.weight + functions;
    return c;
}

/* ---- values ---- */

/* A random point (q, w) and series of first order about it. */
typedef struct {
    nh_jet_equations *x;
    nh_jet_ring *ring;
    nh_jet_eval *eval;
    nh_residue *at, *slope; /* q, then w; value and derivatives of an expression */
} place;

/* A random point, where each coordinate and velocity is a series of order one in its own direction. */
static place place_at(nh_jet_equations *x, nh_prime field, uint64_t seed)
{
    size_t all = x->coordinates + x->n, *one = nh_alloc_array(all + 1, sizeof *one);
    for (size_t k = 0; k < all; k++) one[k] = 1;
    nh_jet_equations_choose(x, field, seed);
    place p = {.x = x, .ring = nh_jet_ring_create(field, all, one, 1)};
    size_t size = p.ring->size;
    nh_residue *series = nh_alloc_array((all + 1) * size, sizeof *series);
    uint64_t random = seed + 7919;
    p.at = nh_alloc_array(all + 1, sizeof *p.at);
    p.slope = nh_alloc_array(size, sizeof *p.slope);
    for (size_t k = 0; k < all; k++) {
        p.at[k] = k < x->coordinates ? x->at[k] : nh_residue_random(field, &random);
        series[k * size] = p.at[k];
        series[k * size + p.ring->up[k * size]] = 1;
    }
    p.eval = nh_jet_equations_eval(x, p.ring, series);
    for (size_t i = 0; i < x->n; i++) nh_jet_eval_set(p.eval, x->w[i], series + (x->coordinates + i) * size, true);
    nh_free(series);
    nh_free(one);
    return p;
}

static void place_clear(place *p)
{
    nh_jet_eval_free(p->eval);
    nh_jet_ring_free(p->ring);
    nh_free(p->at);
    nh_free(p->slope);
}

/* The row of S(e) = (.. ) e: the derivatives; the caller adds the weights, multiples of *value.  False: another point
 * is needed. */
static bool derivatives(place *p, const columns *c, nh_ex e, nh_residue *row, nh_residue *value)
{
    nh_prime f = p->ring->field;
    size_t size = p->ring->size;
    memset(row, 0, c->width * sizeof *row);
    if (!nh_jet_eval_all(p->eval, 1, &e, p->slope)) return false;
    for (size_t k = 0; k < c->coordinates + c->n; k++) {
        nh_residue slope = p->slope[p->ring->up[k * size]], product = nh_residue_mul(f, slope, p->at[k]);
        if (k < c->coordinates) row[k] = product, row[c->shift + k] = slope;
        else row[c->velocity + k - c->coordinates] = product;
    }
    *value = p->slope[0];
    return true;
}

static void add(nh_prime f, nh_residue *entry, nh_residue value) { *entry = nh_residue_add(f, *entry, value); }
static void subtract(nh_prime f, nh_residue *entry, nh_residue value) { *entry = nh_residue_sub(f, *entry, value); }

/* ---- the linear system ---- */

/* The equations of motion at a point; how many rows, or 0: another point is needed. */
static size_t equations_at(place *p, const columns *c, nh_residue *row)
{
    const nh_jet_equations *x = p->x;
    nh_prime f = p->ring->field;
    size_t rows = 0, time = c->coordinates - c->rates;
    nh_residue value, *own = row;
    for (size_t s = 0; s < c->rates; s++, own = row + rows * c->width) {
        if (!derivatives(p, c, x->rho[s], own, &value)) return 0;
        subtract(f, &own[time + s], value);
        add(f, &own[c->time], value);
        rows++;
    }
    for (size_t i = 0; i < c->n * c->n; i++, own = row + rows * c->width) {
        if (!derivatives(p, c, x->M[i], own, &value)) return 0;
        subtract(f, &own[c->energy], value);
        add(f, &own[c->velocity + i / c->n], value);
        add(f, &own[c->velocity + i % c->n], value);
        rows++;
    }
    for (size_t i = 0; i < c->n; i++, own = row + rows * c->width) {
        if (!derivatives(p, c, x->A[i], own, &value)) return 0;
        subtract(f, &own[c->energy], value);
        add(f, &own[c->velocity + i], value);
        add(f, &own[c->time], value);
        rows++;
    }
    if (time) { /* t' = 1 */
        memset(own, 0, c->width * sizeof *own);
        own[0] = 1;
        own[c->time] = nh_residue_negative(f, 1);
        rows++;
    }
    return rows;
}

typedef struct {
    columns c;
    nh_prime field;
    size_t rows, points, *start; /* rows of the equations; start[i] .. start[i + 1]: of function i, one per point */
    nh_residue *row, *own;       /* rows x width: equations; points x width for each function */
} linear_system;

/* The rows of all points, and the logarithmic derivatives of the functions there. */
static bool collect(linear_system *s, nh_jet_equations *x, const nh_ex *function)
{
    size_t each = s->c.rates + s->c.n * s->c.n + s->c.n + 1, found = 0;
    s->points = s->c.width + spare;
    s->row = nh_alloc_array((s->points * each + s->c.coordinates) * s->c.width + 1, sizeof *s->row);
    s->own = nh_alloc_array(s->c.functions * s->points * s->c.width + 1, sizeof *s->own);
    for (uint64_t seed = 1; found < s->points && seed < most_tries + s->points; seed++) {
        place p = place_at(x, s->field, seed);
        size_t rows = equations_at(&p, &s->c, s->row + s->rows * s->c.width);
        bool good = rows > 0;
        for (size_t i = 0; i < s->c.functions && good; i++) {
            nh_residue value, *own = s->own + (i * s->points + found) * s->c.width;
            good = derivatives(&p, &s->c, function[i], own, &value);
            if (good) subtract(s->field, &own[s->c.weight + i], value);
        }
        if (good) s->rows += rows, found++;
        place_clear(&p);
    }
    return found == s->points;
}

/* The null space of rows (destroyed), as rows of out; its dimension. */
static size_t null_space(nh_prime field, size_t rows, size_t width, nh_residue *a, nh_residue *out)
{
    size_t *pivot = nh_alloc_array(rows + width + 1, sizeof *pivot), count = 0,
           rank = nh_residue_matrix_echelon(field, rows, width, width, a, pivot);
    for (size_t k = 0, i = 0; k < width; k++) {
        if (i < rank && pivot[i] == k) {
            i++;
            continue;
        }
        nh_residue *x = out + count++ * width;
        memset(x, 0, width * sizeof *x);
        x[k] = 1;
        for (size_t j = 0; j < rank; j++) x[pivot[j]] = nh_residue_negative(field, a[j * width + k]);
    }
    nh_free(pivot);
    return count;
}

/* The scalings with these functions, as rows of out; their number. */
static size_t scalings_with(const linear_system *s, const bool *heeded, nh_residue *out)
{
    size_t width = s->c.width, rows = s->rows;
    nh_residue *a = nh_alloc_array((rows + (s->c.functions + 1) * s->points) * width + 1, sizeof *a);
    memcpy(a, s->row, rows * width * sizeof *a);
    for (size_t i = 0; i < s->c.functions; i++) {
        if (!heeded[i]) { /* beta = 0 */
            a[rows++ * width + s->c.weight + i] = 1;
            continue;
        }
        memcpy(a + rows * width, s->own + i * s->points * width, s->points * width * sizeof *a);
        rows += s->points;
    }
    size_t count = null_space(s->field, rows, width, a, out);
    nh_free(a);
    return count;
}

/* Does one of them give different weights to velocities or functions? */
static bool tells(const columns *c, size_t count, const nh_residue *scaling)
{
    for (size_t i = 0; i < count; i++)
        for (size_t k = 0; k < c->width; k++) {
            bool weight = (k >= c->velocity && k < c->time) || k >= c->weight;
            if (weight && scaling[i * c->width + k]) return true;
        }
    return false;
}

static bool read_fraction(nh_prime field, nh_residue value, nh_num *out)
{
    int64_t top, bottom;
    if (!nh_residue_fraction(field, value, longest, &top, &bottom)) return false;
    *out = nh_num_ratio(top, bottom);
    return true;
}

/* A coordinate that is a function itself is not shifted. */
static void forbid_shifts(linear_system *s, const nh_jet_equations *x, size_t functions, const nh_ex *function)
{
    for (size_t k = 0; k < s->c.coordinates; k++)
        for (size_t i = 0; i < functions; i++)
            if (function[i] == x->coordinate[k]) {
                nh_residue *own = s->row + s->rows++ * s->c.width;
                memset(own, 0, s->c.width * sizeof *own);
                own[s->c.shift + k] = 1;
                break;
            }
}

/* All functions, or one after another those that leave a scaling; the scalings, as rows of out. */
static size_t heed(const linear_system *s, bool *heeded, nh_residue *out)
{
    size_t n = s->c.functions;
    for (size_t i = 0; i < n; i++) heeded[i] = true;
    size_t count = scalings_with(s, heeded, out);
    if (tells(&s->c, count, out)) return count;
    memset(heeded, 0, n * sizeof *heeded);
    for (size_t i = 0; i < n; i++) {
        heeded[i] = true;
        heeded[i] = tells(&s->c, scalings_with(s, heeded, out), out);
    }
    count = scalings_with(s, heeded, out);
    return tells(&s->c, count, out) ? count : 0;
}

nh_scalings nh_scaling_find(nh_jet_equations *x, size_t functions, const nh_ex *function)
{
    linear_system s = {.c = columns_of(x, functions), .field = nh_jet_point_prime(x->point, 0)};
    nh_scalings out = {.coordinates = x->coordinates, .n = x->n, .width = s.c.width};
    bool *heeded = nh_alloc_array(functions + 1, sizeof *heeded), good = collect(&s, x, function);
    nh_residue *scaling = nh_alloc_array(s.c.width * s.c.width + 1, sizeof *scaling);
    size_t count = 0;
    if (good) {
        forbid_shifts(&s, x, functions, function);
        count = heed(&s, heeded, scaling);
    }
    out.number = nh_alloc_array(count * s.c.width + 1, sizeof *out.number);
    for (size_t i = 0; i < count * s.c.width && good; i++) good = read_fraction(s.field, scaling[i], &out.number[i]);
    out.count = good ? count : 0;
    nh_free(scaling);
    nh_free(heeded);
    nh_free(s.row);
    nh_free(s.own);
    return out;
}

void nh_scaling_clear(nh_scalings *s) { nh_free(s->number); }

bool nh_scaling_combine(const nh_scalings *s, nh_prime field, nh_residue *out)
{
    uint64_t random = 2718;
    memset(out, 0, s->width * sizeof *out);
    for (size_t i = 0; i < s->count; i++) {
        nh_residue factor = s->count == 1 ? 1 : nh_residue_random(field, &random), value;
        for (size_t k = 0; k < s->width; k++) {
            nh_num a = s->number[i * s->width + k];
            if (!nh_residue_ratio(field, a.p, a.q, &value)) return false;
            out[k] = nh_residue_add(field, out[k], nh_residue_mul(field, factor, value));
        }
    }
    return true;
}

void nh_scaling_weights(nh_jet_equations *x, const nh_residue *scaling, nh_prime field, size_t functions,
                        const nh_ex *function, nh_residue *weight, bool *constant)
{
    enum { places = 2 };
    columns c = columns_of(x, 0);
    size_t found = 0;
    nh_residue *row = nh_alloc_array(c.width + 1, sizeof *row), value;
    for (size_t i = 0; i < functions; i++) constant[i] = true;
    for (uint64_t seed = 1; found < places && seed < most_tries; seed++) {
        place p = place_at(x, field, seed);
        bool regular = true;
        for (size_t i = 0; i < functions && regular; i++) {
            regular = derivatives(&p, &c, function[i], row, &value) && value;
            nh_residue sum = 0;
            for (size_t k = 0; k < c.time && regular; k++)
                sum = nh_residue_add(field, sum, nh_residue_mul(field, row[k], scaling[k]));
            if (regular) sum = nh_residue_mul(field, sum, nh_residue_inverse(field, value));
            if (found == 0) weight[i] = sum;
            else if (regular) constant[i] &= weight[i] == sum;
        }
        found += regular;
        place_clear(&p);
    }
    if (found < places) memset(constant, 0, functions * sizeof *constant);
    nh_free(row);
}

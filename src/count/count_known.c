/* Known integrals: their degrees, and the rank of their differentials modulo the prime. */
#include <string.h>

#include "exact/residue_matrix.h"
#include "count/count_internal.h"
#include "graph/node.h"

enum { most_failures = 80 };

/* ---- known integrals ---- */

/* Is a current with named functions a current for every solution of their equations?  The proof of its formula may have
 * used a relation between two functions. */
static bool is_kept(nh_counter *c, const nh_jet_ring *ring, const nh_residue *coordinate, size_t k, bool *good)
{
    nh_jet_equations *x = c->equations;
    uint64_t random = 815;
    nh_residue *w = nh_alloc_array(x->n + 1, sizeof *w), *series = nh_alloc_array(ring->size, sizeof *series);
    nh_jet_eval *v = nh_jet_equations_eval(x, ring, coordinate);
    for (size_t i = 0; i < x->n; i++) w[i] = nh_residue_random(ring->field, &random);
    nh_jet_equations_velocities(x, v, ring, w);
    *good = nh_jet_eval_all(v, 1, &c->rate[k], series);
    bool kept = !*good || series[0] == 0;
    nh_jet_eval_free(v);
    nh_free(series);
    nh_free(w);
    return kept;
}

/* Differences of the values along the line w = a + s b, s = 0 .. count - 1: the degree is that of the last one that is
 * not zero. */
static bool line_degree(nh_counter *c, const nh_jet_ring *ring, const nh_residue *coordinate, nh_ex e, size_t *degree)
{
    enum { values = NH_COUNT_HIGHEST_DEGREE + 4 };
    nh_jet_equations *x = c->equations;
    nh_residue y[values], *w = nh_alloc_array(2 * x->n + 1, sizeof *w),
                          *series = nh_alloc_array(ring->size, sizeof *series);
    uint64_t random = 4711;
    bool good = true;
    nh_jet_eval *v = nh_jet_equations_eval(x, ring, coordinate);
    for (size_t i = 0; i < 2 * x->n; i++) w[i] = nh_residue_random(ring->field, &random);
    for (size_t s = 0; s < values && good; s++) {
        nh_jet_equations_velocities(x, v, ring, w);
        good = nh_jet_eval_all(v, 1, &e, series);
        y[s] = series[0];
        for (size_t i = 0; i < x->n; i++) w[i] = nh_residue_add(ring->field, w[i], w[x->n + i]);
    }
    *degree = 0;
    for (size_t k = 1; k < values && good; k++) {
        for (size_t s = values - 1; s >= k; s--) y[s] = nh_residue_sub(ring->field, y[s], y[s - 1]);
        for (size_t s = k; s < values; s++)
            if (y[s]) *degree = k;
    }
    nh_jet_eval_free(v);
    nh_free(series);
    nh_free(w);
    return good;
}

/* Residues stand for the values of functions, whatever their arguments: cos(w) would be a number. */
static bool has_functions_of_velocities(const nh_jet_equations *x, nh_ex e)
{
    NH_LIST(call);
    size_t n = nh_functions_in(x->dag, e, &call);
    bool found = false;
    for (size_t i = 0; i < n && !found; i++)
        for (size_t l = 0; l < x->n && !found; l++) found = nh_depends(x->dag, call[i], x->w[l]);
    return found;
}

/* Known integral `from` takes place `to`. */
static void move_known(nh_counter *c, size_t to, size_t from)
{
    size_t n = c->equations->n;
    c->failed[to] = c->failed[from];
    c->index[to] = c->index[from];
    c->named[to] = c->named[from];
    c->rate[to] = c->rate[from];
    c->current[to] = c->current[from];
    memmove(c->slope + to * n, c->slope + from * n, n * sizeof *c->slope);
}

/* The degrees of the currents of the kind that is counted, 0 for others, which count for functional dependence only.  A
 * current that cannot be evaluated here makes the point a bad one; one that never can be is left out. */
bool nh_count_take_known(nh_counter *c)
{
    nh_jet_equations *x = c->equations;
    size_t *one = nh_alloc_array(x->coordinates + 1, sizeof *one);
    for (size_t k = 0; k < x->coordinates; k++) one[k] = 1;
    nh_jet_ring *ring = nh_jet_ring_create(x->point->field, x->coordinates, one, 0);
    bool good = true;
    size_t kept = 0;
    for (size_t k = 0; k < c->known && good; k++) {
        size_t degree = 0;
        if (c->named[k] && (c->unnamed || !is_kept(c, ring, x->at, k, &good))) continue;
        good = good && line_degree(c, ring, x->at, c->current[k], &degree);
        bool hopeless = !good && ++c->failed[k] > most_failures;
        good |= hopeless;
        if (hopeless) continue;
        bool timely = !x->time && nh_depends(x->dag, c->current[k], x->model->system->t);
        /* no product of it is of the kind that is counted */
        bool polynomial = degree <= NH_COUNT_HIGHEST_DEGREE && !has_functions_of_velocities(x, c->current[k]);
        if (good && (timely || !polynomial)) degree = 0;
        move_known(c, kept, k);
        c->degree[kept++] = degree;
        if (!good) { /* the other currents are unchanged */
            for (k++; k < c->known; k++) move_known(c, kept++, k);
        }
    }
    c->known = kept;
    nh_jet_ring_free(ring);
    nh_free(one);
    return good;
}

/* ---- functional independence ---- */

nh_residue *nh_count_more_differentials(nh_differentials *d, size_t count)
{
    size_t width = d->kept + d->n, old = d->rows;
    nh_grow(&d->row, &d->capacity, (old + count) * width + 1, sizeof *d->row);
    memset(d->row + old * width, 0, count * width * sizeof *d->row);
    d->rows += count;
    return d->row + old * width;
}

size_t nh_count_rank(const nh_differentials *d, nh_prime f)
{
    size_t width = d->kept + d->n;
    nh_residue *row = nh_alloc_array(d->rows * width + 1, sizeof *row);
    if (d->rows) memcpy(row, d->row, d->rows * width * sizeof *row);
    size_t rank = nh_residue_matrix_rank(f, d->rows, width, row);
    nh_free(row);
    return rank;
}

/* w^alpha without one factor w_l (l = n: all factors) */
static nh_residue velocity_power(const nh_differentials *d, nh_prime f, const uint8_t *alpha, size_t l)
{
    nh_residue r = 1;
    for (size_t i = 0; i < d->n; i++)
        r = nh_residue_mul(f, r, nh_residue_power(f, d->w[i], (uint64_t)(alpha[i] - (i == l))));
    return r;
}

/* d Phi = sum of d c_alpha w^alpha + c_alpha alpha_l w^(alpha - 1_l) dw^l, for every solution */
void nh_count_solutions_differ(const nh_graded_count *g, nh_prime f, nh_differentials *d)
{
    size_t N = g->total[g->order], width = d->kept + d->n;
    nh_residue *out = nh_count_more_differentials(d, N);
    for (size_t a = 0; a < g->alphas; a++) {
        const uint8_t *alpha = g->alpha + a * d->n;
        const nh_residue *jet = g->jet + a * (1 + d->kept) * N;
        nh_residue power = velocity_power(d, f, alpha, d->n);
        for (size_t k = 0; k < width; k++) {
            size_t l = k - d->kept; /* when this is no direction of a coordinate */
            if (k >= d->kept && !alpha[l]) continue;
            nh_residue factor = k < d->kept ? power : nh_residue_mul(f, alpha[l], velocity_power(d, f, alpha, l));
            const nh_residue *c = jet + (k < d->kept ? 1 + k : 0) * N;
            for (size_t j = 0; j < N; j++)
                out[j * width + k] = nh_residue_add(f, out[j * width + k], nh_residue_mul(f, factor, c[j]));
        }
    }
}

void nh_count_differentials_append(nh_differentials *d, const nh_differentials *more)
{
    nh_residue *out = nh_count_more_differentials(d, more->rows);
    if (more->rows) memcpy(out, more->row, more->rows * (d->kept + d->n) * sizeof *out);
}

/* Series up to the largest weight have the derivatives along all coordinates. */
static nh_jet_ring *first_jets(const nh_counter *c, const nh_jet_ring *ring, const nh_residue *coordinate,
                               nh_residue **cut)
{
    const nh_adapted_frame *f = c->frame;
    size_t order = f->step < ring->order ? f->step : ring->order;
    nh_jet_ring *first = nh_jet_ring_create(ring->field, f->kept, f->weight, order);
    *cut = nh_alloc_array(f->all * first->size + 1, sizeof **cut);
    for (size_t k = 0; k < f->all; k++)
        memcpy(*cut + k * first->size, coordinate + k * ring->size, first->size * sizeof **cut);
    return first;
}

/* The same for the known integrals, by their series and their derivatives in the velocities. */
bool nh_count_known_differ(nh_counter *c, const nh_jet_ring *ring, const nh_residue *coordinate, nh_differentials *d)
{
    size_t width = d->kept + d->n;
    nh_residue *cut;
    nh_jet_ring *first = first_jets(c, ring, coordinate, &cut);
    nh_residue *series = nh_alloc_array(first->size, sizeof *series);
    nh_jet_eval *v = nh_jet_equations_eval(c->equations, first, cut);
    nh_jet_equations_velocities(c->equations, v, first, d->w);
    bool good = true;
    for (size_t k = 0; k < c->known && good; k++) {
        nh_residue *out = nh_count_more_differentials(d, 1);
        for (size_t j = 0; j < width && good; j++) {
            nh_ex e = j < d->kept ? c->current[k] : c->slope[k * d->n + j - d->kept];
            if (j == 0 || j >= d->kept) good = nh_jet_eval_all(v, 1, &e, series);
            out[j] = series[j < d->kept ? first->up[j * first->size] : 0];
        }
    }
    nh_jet_eval_free(v);
    nh_free(series);
    nh_free(cut);
    nh_jet_ring_free(first);
    return good;
}

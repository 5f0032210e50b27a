/* Eigenvalues of the derivative along a cyclic coordinate on the space of solutions. */
#include "count/construct_rates.h"

#include <flint/fmpq.h>
#include <flint/nmod_mat.h>
#include <flint/nmod_poly.h>
#include <flint/nmod_poly_factor.h>
#include <string.h>

#include "base/progress.h"
#include "count/count_internal.h"

enum { beyond_degree = 3, spare = 4, most_points = 20, most_coefficients = 4000, most_solutions = 120 };

/* ---- the field of a cyclic coordinate ---- */

/* d/dq_k = sum_j b_j d/dz_j: (dy/dz) b = dy/dq_k, where y are the linear coordinates of the frame.  Exact up to order -
 * step. */
static bool cyclic_field(const nh_adapted_frame *f, const nh_count_series *s, size_t k, nh_residue *b)
{
    const nh_jet_ring *ring = s->ring;
    size_t m = f->all, size = ring->size;
    nh_residue *J = nh_alloc_array(m * m * size, sizeof *J), *slope = nh_alloc_array(size, sizeof *slope);
    for (size_t l = 0; l < m; l++)
        for (size_t j = 0; j < m; j++) {
            nh_jet_derivative(ring, s->coordinate + l * size, j, slope);
            for (size_t i = 0; i < m; i++) nh_jet_add_multiple(ring, J + (i * m + j) * size, f->from[i * m + l], slope);
        }
    for (size_t i = 0; i < m; i++) nh_jet_constant(ring, f->from[i * m + k], b + i * size);
    bool good = nh_jet_solve(ring, m, J, 1, b);
    nh_free(slope);
    nh_free(J);
    return good;
}

/* ---- its matrix on the solutions ---- */

/* Solution `s` of c_alpha. */
static void take_series(const nh_graded_count *g, const nh_jet_ring *ring, size_t alpha, size_t s, nh_residue *out)
{
    size_t N = g->total[g->order];
    for (size_t e = 0; e < ring->size; e++) out[e] = g->series[(alpha * ring->size + e) * N + s];
}

/* Random functionals of the solutions (columns 0 .. N - 1) and of their derivatives (N .. 2N - 1),
   up to coefficient `end`. */
static void functionals(const nh_graded_count *g, const nh_jet_ring *ring, const nh_residue *b, size_t end,
                        nmod_mat_t out)
{
    size_t N = g->total[g->order], rows = N + spare, size = ring->size;
    nh_residue *weight = nh_alloc_array(rows * end + 1, sizeof *weight), *c = nh_alloc_array(3 * size, sizeof *c);
    nh_residue *slope = c + size, *rate = slope + size;
    uint64_t random = 1618;
    for (size_t alpha = 0; alpha < g->alphas; alpha++) {
        for (size_t i = 0; i < rows * end; i++) weight[i] = nh_residue_random(ring->field, &random);
        for (size_t s = 0; s < N; s++) {
            take_series(g, ring, alpha, s, c);
            memset(rate, 0, size * sizeof *rate);
            for (size_t j = 0; j < ring->variables; j++) {
                if (nh_jet_is_zero(ring, b + j * size)) continue;
                nh_jet_derivative(ring, c, j, slope);
                nh_jet_add_product(ring, rate, b + j * size, slope);
            }
            for (size_t i = 0; i < rows; i++) {
                uint64_t own = nmod_mat_entry(out, i, s), its = nmod_mat_entry(out, i, N + s);
                for (size_t e = 0; e < end; e++) {
                    own = nh_residue_gather(ring->field, own, weight[i * end + e], c[e]);
                    its = nh_residue_gather(ring->field, its, weight[i * end + e], rate[e]);
                }
                nmod_mat_entry(out, i, s) = nh_residue_reduce(ring->field, own);
                nmod_mat_entry(out, i, N + s) = nh_residue_reduce(ring->field, its);
            }
        }
    }
    nh_free(c);
    nh_free(weight);
}

/* A := the matrix of the derivative on the solutions, from the values of solutions (left half of `both`) and of their
 * derivatives (right half).  False where the series are too short to tell solutions apart, or the span is not closed
 * under the derivative. */
static bool matrix_of(nmod_mat_t both, size_t N, nmod_mat_t A)
{
    if ((size_t)nmod_mat_rref(both) != N || (N && nmod_mat_entry(both, N - 1, N - 1) != 1)) return false;
    for (size_t i = 0; i < N; i++)
        for (size_t j = 0; j < N; j++) nmod_mat_entry(A, i, j) = nmod_mat_entry(both, i, N + j);
    return true;
}

/* ---- its eigenvalues ---- */

/* The short fraction with this residue. */
static bool fraction(nh_residue value, uint64_t p, nh_num *out)
{
    enum { longest = 1000 };
    fmpz_t a, m;
    fmpq_t q;
    fmpz_init_set_ui(a, value);
    fmpz_init_set_ui(m, p);
    fmpq_init(q);
    bool found = fmpq_reconstruct_fmpz(q, a, m) && fmpz_cmp_ui(fmpq_denref(q), longest) <= 0 &&
                 fmpz_cmp_si(fmpq_numref(q), longest) <= 0 && fmpz_cmp_si(fmpq_numref(q), -longest) >= 0;
    if (found) *out = nh_num_ratio(fmpz_get_si(fmpq_numref(q)), fmpz_get_si(fmpq_denref(q)));
    fmpq_clear(q);
    fmpz_clear(m);
    fmpz_clear(a);
    return found;
}

static void put(nh_construct_rates *out, nh_construct_rate r)
{
    for (size_t i = 0; i < out->count; i++) {
        const nh_construct_rate *o = &out->item[i];
        if (o->coordinate == r.coordinate && o->wave == r.wave && o->rate.p == r.rate.p && o->rate.q == r.rate.q)
            return;
    }
    if (out->count < NH_MOST_CONSTRUCT_RATES) out->item[out->count++] = r;
}

/* The square root of a square number, otherwise 0. */
static int64_t root_of(int64_t square)
{
    int64_t root = 0;
    while (root * root < square) root++;
    return root * root == square ? root : 0;
}

/* Reads a linear factor x - lambda, or x^2 + omega^2: no prime here has a root of -1. */
static void read_factor(const nmod_poly_t f, uint64_t p, nh_ex coordinate, nh_construct_rates *out)
{
    nh_residue last = (nh_residue)nmod_poly_get_coeff_ui(f, 0);
    nh_construct_rate r = {.coordinate = coordinate, .wave = nmod_poly_degree(f) == 2};
    if (!last || nmod_poly_degree(f) > 2 || (r.wave && nmod_poly_get_coeff_ui(f, 1))) return;
    if (!fraction(r.wave ? last : (nh_residue)(p - last), p, &r.rate)) return;
    if (r.wave) {
        if (r.rate.p < 0 || !root_of(r.rate.p) || !root_of(r.rate.q)) return;
        r.rate = nh_num_ratio(root_of(r.rate.p), root_of(r.rate.q));
    }
    put(out, r);
}

static void read_eigenvalues(const nmod_mat_t A, uint64_t p, nh_ex coordinate, nh_construct_rates *out)
{
    nmod_poly_t characteristic;
    nmod_poly_factor_t parts;
    nmod_poly_init(characteristic, p);
    nmod_poly_factor_init(parts);
    nmod_mat_charpoly(characteristic, A);
    nmod_poly_factor(parts, characteristic);
    for (slong i = 0; i < parts->num; i++) read_factor(parts->p + i, p, coordinate, out);
    nmod_poly_factor_clear(parts);
    nmod_poly_clear(characteristic);
}

/* ---- a point ---- */

/* False where the series are too short: more truncated series than solutions satisfy the equations. */
static bool rates_of(const nh_counter *c, const nh_count_series *s, const nh_graded_count *g, size_t k,
                     nh_construct_rates *out)
{
    bool closed = true;
    const nh_jet_ring *ring = s->ring;
    size_t N = g->total[g->order], m = c->frame->all;
    size_t end = ring->first[ring->order - c->frame->step + 1]; /* derivatives are exact up to this order */
    nh_residue *b = nh_alloc_array(m * ring->size, sizeof *b);
    nmod_mat_t both, A;
    nmod_mat_init(both, (slong)(N + spare), (slong)(2 * N), ring->field.p);
    nmod_mat_init(A, (slong)N, (slong)N, ring->field.p);
    if (cyclic_field(c->frame, s, k, b)) {
        functionals(g, ring, b, end, both);
        closed = matrix_of(both, N, A);
        if (closed) read_eigenvalues(A, ring->field.p, c->equations->coordinate[k], out);
    }
    double products = (double)m * (double)ring->pairs[ring->size] + 2 * (double)(N + spare) * (double)end;
    out->work += (double)g->alphas * (double)N * products;
    nmod_mat_clear(A);
    nmod_mat_clear(both);
    nh_free(b);
    return closed;
}

/* False: another point is needed.  `closed`: series of this order tell all solutions apart. */
static bool rates_at(nh_counter *c, size_t degree, size_t order, bool *closed, nh_construct_rates *out)
{
    const nh_adapted_frame *f = c->frame;
    bool regular = true;
    *closed = true;
    if (f->kept != f->all || nh_jet_ring_size(f->kept, f->weight, order, most_coefficients) == SIZE_MAX) return true;
    nh_count_series *s = nh_count_series_create(c, order, c->q->work, &regular);
    for (size_t part = 0; s && part < (s->split ? 2 : 1) && !nh_late(); part++) {
        nh_parity parity = !s->split ? NH_ALL_DEGREES : part ? NH_ODD_DEGREES : NH_EVEN_DEGREES;
        nh_graded_problem p = nh_count_problem(c, s, degree, parity);
        p.keep = true;
        nh_graded_count *g = nh_graded_solve(&p);
        out->work += g->work;
        bool few = g->solved && g->total[g->order] <= most_solutions;
        for (size_t k = 0; k < c->equations->coordinates && few; k++)
            if (nh_jet_equations_is_cyclic(c->equations, c->equations->coordinate[k]))
                *closed &= rates_of(c, s, g, k, out);
        nh_graded_count_clear(g);
    }
    nh_count_series_free(s);
    return s || regular;
}

nh_construct_rates nh_construct_rates_of(const nh_model *model, size_t degree, bool time, double work)
{
    nh_count_question q = {.time = time, .degree = degree, .work = work};
    nh_construct_rates out = {0};
    nh_counter c;
    bool some = false, done = false, closed = false;
    nh_counter_open(&c, model, &q);
    for (size_t k = 0; k < c.equations->coordinates && !c.equations->obstacle; k++)
        some |= nh_jet_equations_is_cyclic(c.equations, c.equations->coordinate[k]);
    for (size_t point = 0; some && !done && point < most_points && !c.equations->obstacle && !nh_late(); point++) {
        if (!nh_count_regular_point(&c, point)) continue;
        size_t order = (degree + beyond_degree) * c.frame->step, more = (degree + 1) * c.frame->step;
        done = rates_at(&c, degree, order, &closed, &out);
        if (done && !closed && out.work < work) done = rates_at(&c, degree, order + more, &closed, &out);
    }
    nh_counter_close(&c);
    return out;
}

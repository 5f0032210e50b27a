/* Eigenvalues of the derivative along a cyclic coordinate on the space of solutions. */
#include "count/construct_rates.h"

#include <flint/nmod_mat.h>
#include <flint/nmod_poly.h>
#include <flint/nmod_poly_factor.h>

#include "base/progress.h"
#include "count/solution_matrix.h"

enum { beyond_degree = 3, most_points = 20, most_coefficients = 4000, most_solutions = 120 };

/* ---- eigenvalues ---- */

/* The short fraction with this residue. */
static bool fraction(nh_residue value, nh_prime field, nh_num *out)
{
    enum { longest = 1000 };
    int64_t top, bottom;
    bool found = nh_residue_fraction(field, value, longest, &top, &bottom);
    if (found) *out = nh_num_ratio(top, bottom);
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
static void read_factor(const nmod_poly_t f, nh_prime field, nh_ex coordinate, nh_construct_rates *out)
{
    nh_residue last = (nh_residue)nmod_poly_get_coeff_ui(f, 0);
    nh_construct_rate r = {.coordinate = coordinate, .wave = nmod_poly_degree(f) == 2};
    if (!last || nmod_poly_degree(f) > 2 || (r.wave && nmod_poly_get_coeff_ui(f, 1))) return;
    if (!fraction(r.wave ? last : nh_residue_negative(field, last), field, &r.rate)) return;
    if (r.wave) {
        if (r.rate.p < 0 || !root_of(r.rate.p) || !root_of(r.rate.q)) return;
        r.rate = nh_num_ratio(root_of(r.rate.p), root_of(r.rate.q));
    }
    put(out, r);
}

static void read_eigenvalues(const nmod_mat_t A, nh_prime field, nh_ex coordinate, nh_construct_rates *out)
{
    nmod_poly_t characteristic;
    nmod_poly_factor_t parts;
    nmod_poly_init(characteristic, field.p);
    nmod_poly_factor_init(parts);
    nmod_mat_charpoly(characteristic, A);
    nmod_poly_factor(parts, characteristic);
    for (slong i = 0; i < parts->num; i++) read_factor(parts->p + i, field, coordinate, out);
    nmod_poly_factor_clear(parts);
    nmod_poly_clear(characteristic);
}

/* ---- a point ---- */

/* Reads the rates along coordinate k; *idle stays where no solution depends on it.  False where the series are too
 * short. */
static bool rates_of(const nh_counter *c, const nh_count_series *s, const nh_graded_count *g, size_t k, bool *idle,
                     nh_construct_rates *out)
{
    const nh_jet_ring *ring = s->ring;
    size_t N = g->total[g->order];
    nh_residue *along = nh_alloc_array(c->frame->all * ring->size, sizeof *along),
               *value = nh_alloc_array(N * N + 1, sizeof *value);
    nmod_mat_t A;
    nmod_mat_init(A, (slong)N, (slong)N, ring->field.p);
    nh_jet_constant(ring, 1, along + k * ring->size);
    bool closed = !N || nh_solution_matrix(c, s, g, along, NULL, value, &out->work);
    for (size_t i = 0; i < N; i++)
        for (size_t j = 0; j < N; j++) nmod_mat_entry(A, i, j) = value[i * N + j];
    *idle &= closed && nmod_mat_is_zero(A);
    if (closed) read_eigenvalues(A, ring->field, c->equations->coordinate[k], out);
    nmod_mat_clear(A);
    nh_free(value);
    nh_free(along);
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
    size_t coordinates = c->equations->coordinates, part = 0, parts = !s ? 0 : s->split ? 2 : 1;
    bool *idle = nh_alloc_array(coordinates + 1, sizeof *idle), all = parts > 0;
    for (size_t k = 0; k < coordinates; k++)
        idle[k] = nh_jet_equations_is_cyclic(c->equations, c->equations->coordinate[k]);
    for (; part < parts && !nh_late(); part++) {
        nh_parity parity = !s->split ? NH_ALL_DEGREES : part ? NH_ODD_DEGREES : NH_EVEN_DEGREES;
        nh_graded_problem p = nh_count_problem(c, s, degree, parity);
        p.keep = true;
        nh_graded_count *g = nh_graded_solve(&p);
        out->work += g->work;
        bool few = g->solved && g->total[g->order] <= most_solutions;
        for (size_t k = 0; k < c->equations->coordinates && few; k++)
            if (nh_jet_equations_is_cyclic(c->equations, c->equations->coordinate[k]))
                *closed &= rates_of(c, s, g, k, &idle[k], out);
        all &= few;
        nh_graded_count_clear(g);
    }
    out->idle = 0;
    for (size_t k = 0; k < coordinates && all && part == parts; k++)
        if (idle[k] && out->idle < NH_MOST_CONSTRUCT_RATES)
            out->idle_coordinate[out->idle++] = c->equations->coordinate[k];
    nh_free(idle);
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

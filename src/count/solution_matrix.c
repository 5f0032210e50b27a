/* solution_matrix: (S Phi_j) = sum_i out[i, j] Phi_i, from values of random functionals on solutions and on their
 * images.
 *
 *     [ Phi_1 .. Phi_N | S Phi_1 .. S Phi_N ]   ->   echelon form   ->   [ 1 | matrix ]      rank N, or it has none
 *
 * S takes derivatives: along the frame's coordinates these are right up to order - step. */
#include "count/scaling.h"

#include <string.h>

#include "exact/residue_matrix.h"

enum { spare = 4 };

/* S = sum_j b_j d/dz_j: (dy/dz) b = dy/dq s, where y are the linear coordinates of the frame.  Exact up to order -
 * step. */
static bool field_in_frame(const nh_adapted_frame *f, const nh_count_series *s, const nh_residue *along, nh_residue *b)
{
    const nh_jet_ring *ring = s->ring;
    size_t m = f->all, size = ring->size;
    nh_residue *J = nh_alloc_array(m * m * size, sizeof *J), *slope = nh_alloc_array(size, sizeof *slope);
    memset(b, 0, m * size * sizeof *b);
    for (size_t l = 0; l < m; l++) {
        for (size_t j = 0; j < m; j++) {
            nh_jet_derivative(ring, s->coordinate + l * size, j, slope);
            for (size_t i = 0; i < m; i++) nh_jet_add_multiple(ring, J + (i * m + j) * size, f->from[i * m + l], slope);
        }
        for (size_t i = 0; i < m; i++) nh_jet_add_multiple(ring, b + i * size, f->from[i * m + l], along + l * size);
    }
    bool good = nh_jet_solve(ring, m, J, 1, b);
    nh_free(slope);
    nh_free(J);
    return good;
}

/* Solution `s` of c_alpha. */
static void take_series(const nh_graded_count *g, const nh_jet_ring *ring, size_t alpha, size_t s, nh_residue *out)
{
    size_t N = g->total[g->order];
    for (size_t e = 0; e < ring->size; e++) out[e] = g->series[(alpha * ring->size + e) * N + s];
}

/* S(c) */
static void image(const nh_jet_ring *ring, const nh_residue *b, nh_residue factor, const nh_residue *c,
                  nh_residue *slope, nh_residue *out)
{
    memset(out, 0, ring->size * sizeof *out);
    nh_jet_add_multiple(ring, out, factor, c);
    for (size_t j = 0; j < ring->variables; j++) {
        if (nh_jet_is_zero(ring, b + j * ring->size)) continue;
        nh_jet_derivative(ring, c, j, slope);
        nh_jet_add_product(ring, out, b + j * ring->size, slope);
    }
}

/* Random functionals of the solutions (columns 0 .. N - 1) and of their images (N .. 2N - 1), up to coefficient
 * `end`: rows x 2N. */
static void functionals(const nh_graded_count *g, const nh_jet_ring *ring, const nh_residue *b,
                        const nh_residue *factor, size_t end, size_t rows, nh_residue *out)
{
    size_t N = g->total[g->order], size = ring->size;
    nh_residue *weight = nh_alloc_array(rows * end + 1, sizeof *weight), *c = nh_alloc_array(3 * size, sizeof *c);
    nh_residue *slope = c + size, *rate = slope + size;
    uint64_t random = 1618;
    for (size_t alpha = 0; alpha < g->alphas; alpha++) {
        for (size_t i = 0; i < rows * end; i++) weight[i] = nh_residue_random(ring->field, &random);
        for (size_t s = 0; s < N; s++) {
            take_series(g, ring, alpha, s, c);
            image(ring, b, factor ? factor[alpha] : 0, c, slope, rate);
            for (size_t i = 0; i < rows; i++) {
                uint64_t own = out[i * 2 * N + s], its = out[i * 2 * N + N + s];
                for (size_t e = 0; e < end; e++) {
                    own = nh_residue_gather(ring->field, own, weight[i * end + e], c[e]);
                    its = nh_residue_gather(ring->field, its, weight[i * end + e], rate[e]);
                }
                out[i * 2 * N + s] = nh_residue_reduce(ring->field, own);
                out[i * 2 * N + N + s] = nh_residue_reduce(ring->field, its);
            }
        }
    }
    nh_free(c);
    nh_free(weight);
}

bool nh_solution_matrix(const nh_counter *c, const nh_count_series *s, const nh_graded_count *g,
                        const nh_residue *along, const nh_residue *factor, nh_residue *out, double *work)
{
    const nh_jet_ring *ring = s->ring;
    size_t N = g->total[g->order], m = c->frame->all, rows = N + spare;
    if (!N || ring->order < c->frame->step) return false;
    size_t end = ring->first[ring->order - c->frame->step + 1]; /* derivatives are exact up to this order */
    nh_residue *b = nh_alloc_array(m * ring->size, sizeof *b), *both = nh_alloc_array(rows * 2 * N + 1, sizeof *both);
    size_t *pivot = nh_alloc_array(rows + 1, sizeof *pivot);
    bool good = field_in_frame(c->frame, s, along, b);
    if (good) {
        functionals(g, ring, b, factor, end, rows, both);
        good = nh_residue_matrix_echelon(ring->field, rows, 2 * N, 2 * N, both, pivot) == N && pivot[N - 1] == N - 1;
    }
    for (size_t i = 0; i < N && good; i++) memcpy(out + i * N, both + i * 2 * N + N, N * sizeof *out);
    *work +=
        (double)g->alphas * (double)N * ((double)m * (double)ring->pairs[ring->size] + 2 * (double)rows * (double)end);
    nh_free(pivot);
    nh_free(both);
    nh_free(b);
    return good;
}

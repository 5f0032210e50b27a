/* Random linear functionals of series, several on each of a few curves z_k = v_k s^(weight_k). */
#include "count/count_internal.h"

#include <string.h>

#include "exact/row_sum.h"

enum { each = 4 }; /* functionals on a curve */

/* v^e for all exponents, by tables of powers. */
static void powers(const nh_jet_ring *ring, const nh_residue *v, nh_residue *table, nh_residue *out)
{
    size_t m = ring->variables, orders = ring->order + 1;
    for (size_t k = 0; k < m; k++) {
        table[k * orders] = 1;
        for (size_t i = 1; i < orders; i++)
            table[k * orders + i] = nh_residue_mul(ring->field, table[k * orders + i - 1], v[k]);
    }
    for (size_t e = 0; e < ring->size; e++) {
        out[e] = 1;
        for (size_t k = 0; k < m; k++)
            out[e] = nh_residue_mul(ring->field, out[e], table[k * orders + ring->exponent[e * m + k]]);
    }
}

void nh_count_curve(const nh_jet_ring *ring, uint64_t *random, nh_residue *out)
{
    size_t m = ring->variables;
    nh_residue *v = nh_alloc_array(m + 1, sizeof *v), *table = nh_alloc_array(m * (ring->order + 1) + 1, sizeof *table);
    for (size_t k = 0; k < m; k++) v[k] = nh_residue_random(ring->field, random);
    powers(ring, v, table, out);
    nh_free(table);
    nh_free(v);
}

nh_count_lines nh_count_lines_create(const nh_jet_ring *ring, size_t least)
{
    nh_count_lines l = {.lines = least / each + 1, .size = ring->size, .order = ring->order};
    uint64_t random = 57721;
    l.count = l.lines * each;
    l.curve = nh_alloc_array(l.lines * ring->size, sizeof *l.curve);
    l.weight = nh_alloc_array(l.count * (ring->order + 1), sizeof *l.weight);
    for (size_t j = 0; j < l.lines; j++) nh_count_curve(ring, &random, l.curve + j * ring->size);
    for (size_t i = 0; i < l.count * (ring->order + 1); i++) l.weight[i] = nh_residue_random(ring->field, &random);
    return l;
}

void nh_count_lines_clear(nh_count_lines *l)
{
    nh_free(l->curve);
    nh_free(l->weight);
}

void nh_count_along(const nh_jet_ring *ring, const nh_jet_ring *line, const nh_residue *curve, size_t count,
                    const nh_residue *series, nh_residue *out)
{
    memset(out, 0, count * line->size * sizeof *out);
    for (size_t k = 0; k < count; k++)
        for (size_t e = 0; e < ring->size; e++) {
            nh_residue *at = &out[k * line->size + ring->degree[e]], c = series[k * ring->size + e];
            if (c) *at = nh_residue_add(ring->field, *at, nh_residue_mul(ring->field, curve[e], c));
        }
}

void nh_count_line_values(const nh_count_lines *l, size_t j, nh_prime field, const nh_residue *series, nh_residue *out,
                          size_t stride)
{
    for (size_t i = j * each; i < (j + 1) * each; i++) {
        uint64_t sum = 0;
        for (size_t k = 0; k <= l->order; k++)
            sum = nh_residue_gather(field, sum, l->weight[i * (l->order + 1) + k], series[k]);
        out[i * stride] = nh_residue_reduce(field, sum);
    }
}

/* Sums by degree along each curve first. */
void nh_count_lines_values(const nh_count_lines *l, const nh_jet_ring *ring, size_t N, const nh_residue *series,
                           nh_residue *out, size_t stride)
{
    size_t orders = l->order + 1;
    const nh_residue **row = nh_alloc_array(ring->size + 1, sizeof *row);
    nh_residue *sum = nh_alloc_array(orders * N + 1, sizeof *sum), *own = nh_alloc_array(orders, sizeof *own);
    for (size_t e = 0; e < ring->size; e++) row[e] = series + e * N;
    for (size_t j = 0; j < l->lines; j++) {
        memset(sum, 0, orders * N * sizeof *sum);
        for (size_t k = 0; k < orders; k++)
            nh_row_sum_add(ring->field, N, sum + k * N, ring->first[k + 1] - ring->first[k],
                           l->curve + j * l->size + ring->first[k], row + ring->first[k]);
        for (size_t s = 0; s < N; s++) {
            for (size_t k = 0; k < orders; k++) own[k] = sum[k * N + s];
            nh_count_line_values(l, j, ring->field, own, out + s, stride);
        }
    }
    nh_free(own);
    nh_free(sum);
    nh_free(row);
}

/* Determinants of compressions: polynomials in lambda at values of mu, interpolated to polynomials in both. */
#include "classify/compression.h"

#include <flint/nmod_mat.h>
#include <flint/nmod_poly.h>

#include "base/memory.h"
#include "base/progress.h"

/* The compressed coefficients of lambda^i at one mu: degree + 1 matrices. */
typedef struct {
    size_t degree;
    slong size;
    nmod_mat_t *m;
} square;

/* sum += a times m */
static void add_multiple(nmod_mat_t sum, nh_prime f, nh_residue a, const nh_residue *m)
{
    slong columns = nmod_mat_ncols(sum);
    for (slong i = 0; i < nmod_mat_nrows(sum); i++)
        for (slong j = 0; j < columns; j++)
            nmod_mat_entry(sum, i, j) =
                nh_residue_add(f, (nh_residue)nmod_mat_entry(sum, i, j), nh_residue_mul(f, a, m[i * columns + j]));
}

size_t nh_compression_rank(const nh_staircase_matrices *m, nh_prime f)
{
    uint64_t random = 424242;
    nmod_mat_t sum;
    nh_residue lambda = nh_residue_random(f, &random), mu = nh_residue_random(f, &random);
    nmod_mat_init(sum, (slong)m->rows, (slong)m->columns, f.p);
    for (size_t k = 0; k < (m->degree + 1) * (m->second + 1); k++) {
        nh_residue power = nh_residue_mul(f, nh_residue_power(f, lambda, k % (m->degree + 1)),
                                          nh_residue_power(f, mu, k / (m->degree + 1)));
        add_multiple(sum, f, power, m->entry + k * m->rows * m->columns);
    }
    size_t rank = (size_t)nmod_mat_rank(sum);
    nmod_mat_clear(sum);
    return rank;
}

static void fill_random(nmod_mat_t m, nh_prime f, uint64_t *random)
{
    for (slong i = 0; i < nmod_mat_nrows(m); i++)
        for (slong j = 0; j < nmod_mat_ncols(m); j++) nmod_mat_entry(m, i, j) = nh_residue_random(f, random);
}

/* The matrix at a value of lambda. */
static void at_lambda(const square *s, nh_residue lambda, nmod_mat_t out)
{
    nmod_mat_zero(out);
    for (size_t i = s->degree + 1; i-- > 0;) {
        nmod_mat_scalar_mul(out, out, lambda);
        nmod_mat_add(out, out, s->m[i]);
    }
}

/* Interpolates from degree x size + 1 determinants. */
static void by_values(const square *s, nh_prime f, nmod_poly_t out)
{
    size_t count = s->degree * (size_t)s->size + 1;
    ulong *place = nh_alloc_array(count, sizeof *place), *value = nh_alloc_array(count, sizeof *value);
    nmod_mat_t m;
    nmod_mat_init(m, s->size, s->size, f.p);
    for (size_t k = 0; k < count; k++) {
        place[k] = k;
        at_lambda(s, (nh_residue)k, m);
        value[k] = nmod_mat_det(m);
    }
    nmod_poly_interpolate_nmod_vec(out, place, value, (slong)count);
    nmod_mat_clear(m);
    nh_free(value);
    nh_free(place);
}

/* det(B + u A) = det B det(1 + u B^-1 A),  the reversed characteristic polynomial of -B^-1 A, with B = X(shift) and
 * lambda = shift + u. False: B is singular. */
static bool by_eigenvalues(const square *s, nh_prime f, nh_residue shift, nmod_poly_t out)
{
    nmod_mat_t B, K;
    nmod_mat_init(B, s->size, s->size, f.p);
    nmod_mat_init(K, s->size, s->size, f.p);
    at_lambda(s, shift, B);
    ulong determinant = nmod_mat_det(B);
    bool good = determinant && nmod_mat_solve(K, B, s->m[1]);
    if (good) {
        nmod_mat_neg(K, K);
        nmod_mat_charpoly(out, K);
        nmod_poly_reverse(out, out, s->size + 1);
        nmod_poly_taylor_shift(out, out, nh_residue_negative(f, shift));
        nmod_poly_scalar_mul_nmod(out, out, determinant);
    }
    nmod_mat_clear(K);
    nmod_mat_clear(B);
    return good;
}

static void determinant_at(const square *s, nh_prime f, nmod_poly_t out)
{
    enum { shifts = 3 };
    for (nh_residue k = 0; k < shifts && s->degree == 1; k++)
        if (by_eigenvalues(s, f, 1000003 * k, out)) return;
    by_values(s, f, out);
}

/* Values at 0, 1, .. become coefficients, for every power of lambda. */
static void interpolate(nh_prime f, size_t width, size_t count, nh_residue *value)
{
    ulong *place = nh_alloc_array(count, sizeof *place), *y = nh_alloc_array(count, sizeof *y);
    nmod_poly_t p;
    nmod_poly_init(p, f.p);
    for (size_t i = 0; i < width; i++) {
        for (size_t k = 0; k < count; k++) place[k] = k, y[k] = value[k * width + i];
        nmod_poly_interpolate_nmod_vec(p, place, y, (slong)count);
        for (size_t k = 0; k < count; k++) value[k * width + i] = (nh_residue)nmod_poly_get_coeff_ui(p, (slong)k);
    }
    nmod_poly_clear(p);
    nh_free(y);
    nh_free(place);
}

/* L times every coefficient times C: size x size each. */
static nh_residue *compressed(const nh_staircase_matrices *m, nh_prime f, slong size, uint64_t seed)
{
    uint64_t random = seed;
    size_t count = (m->degree + 1) * (m->second + 1), at = 0;
    nh_residue *out = nh_alloc_array(count * (size_t)(size * size) + 1, sizeof *out);
    nmod_mat_t L, C, part, half, product;
    nmod_mat_init(L, size, (slong)m->rows, f.p);
    nmod_mat_init(C, (slong)m->columns, size, f.p);
    nmod_mat_init(part, (slong)m->rows, (slong)m->columns, f.p);
    nmod_mat_init(half, size, (slong)m->columns, f.p);
    nmod_mat_init(product, size, size, f.p);
    fill_random(L, f, &random);
    fill_random(C, f, &random);
    for (size_t k = 0; k < count; k++) {
        nmod_mat_zero(part);
        add_multiple(part, f, 1, m->entry + k * m->rows * m->columns);
        nmod_mat_mul(half, L, part);
        nmod_mat_mul(product, half, C);
        for (slong i = 0; i < size; i++)
            for (slong j = 0; j < size; j++) out[at++] = (nh_residue)nmod_mat_entry(product, i, j);
    }
    nmod_mat_clear(product);
    nmod_mat_clear(half);
    nmod_mat_clear(part);
    nmod_mat_clear(C);
    nmod_mat_clear(L);
    return out;
}

bool nh_compression_determinant(const nh_staircase_matrices *m, nh_prime f, size_t rank, uint64_t seed,
                                nh_residue_polynomial *out)
{
    square s = {.degree = m->degree, .size = (slong)rank, .m = nh_alloc_array(m->degree + 1, sizeof *s.m)};
    nh_residue *power = compressed(m, f, s.size, seed);
    nmod_poly_t p;
    nmod_poly_init(p, f.p);
    for (size_t i = 0; i <= m->degree; i++) nmod_mat_init(s.m[i], s.size, s.size, f.p);
    *out = (nh_residue_polynomial){.degree = {m->degree * rank, m->second * rank}};
    size_t width = out->degree[0] + 1, count = out->degree[1] + 1;
    out->coefficient = nh_alloc_array(width * count, sizeof *out->coefficient);
    for (size_t k = 0; k < count && !nh_late(); k++) {
        for (size_t i = 0; i <= m->degree; i++) {
            nmod_mat_zero(s.m[i]);
            for (size_t j = 0; j <= m->second; j++)
                add_multiple(s.m[i], f, nh_residue_power(f, (nh_residue)k, j),
                             power + (j * (m->degree + 1) + i) * rank * rank);
        }
        determinant_at(&s, f, p);
        for (size_t i = 0; i < width; i++)
            out->coefficient[k * width + i] = (nh_residue)nmod_poly_get_coeff_ui(p, (slong)i);
    }
    interpolate(f, width, count, out->coefficient);
    for (size_t i = 0; i <= m->degree; i++) nmod_mat_clear(s.m[i]);
    nmod_poly_clear(p);
    nh_free(power);
    nh_free(s.m);
    bool good = !nh_late();
    if (!good) nh_free(out->coefficient);
    return good;
}

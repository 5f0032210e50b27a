#include "reduction/symmetry_rays.h"

#include <string.h>

#include "base/progress.h"
#include "exact/residue_matrix.h"

static void set_positions(const nh_count_rays *c, nh_jet_eval *v)
{
    nh_residue *at = nh_alloc_array(c->ring->size, sizeof *at);
    for (size_t s = 0; s < c->m; s++) {
        nh_jet_constant(c->ring, c->q0[s], at);
        at[nh_ray_index(c, 1, 0)] = c->X[s];
        at[nh_ray_index(c, 1, 1)] = c->Y[s];
        nh_jet_eval_set(v, c->k->q[s], at, false);
    }
    nh_free(at);
}

/* D: velocities e_free - S e_dependent, and v0, series; false where the constraints are dependent at the point. */
static bool find_frame(nh_count_rays *c)
{
    size_t m = c->m, f = c->f, size = c->ring->size, cols = c->n + 1;
    nh_residue *at = nh_alloc_array(f * m + 1, sizeof *at), *M = nh_alloc_array(f * f * size + 1, sizeof *M),
               *right = nh_alloc_array(f * cols * size + 1, sizeof *right);
    size_t *pivot = nh_alloc_array(f + m + 1, sizeof *pivot), *free = pivot + f, n = 0;
    for (size_t i = 0; i < f * m; i++) at[i] = nh_ray_series(c, c->value, c->at.omega + i)[0];
    bool good = nh_residue_matrix_pivots(c->field, f, m, at, pivot) == f;
    for (size_t s = 0, p = 0; s < m && good; s++)
        if (p < f && pivot[p] == s) p++;
        else free[n++] = s;
    for (size_t a = 0; a < f && good; a++) {
        for (size_t p = 0; p < f; p++)
            memcpy(nh_ray_series(c, M, a * f + p), nh_ray_series(c, c->value, c->at.omega + a * m + pivot[p]),
                   size * sizeof *M);
        for (size_t j = 0; j < n; j++)
            memcpy(nh_ray_series(c, right, a * cols + j), nh_ray_series(c, c->value, c->at.omega + a * m + free[j]),
                   size * sizeof *M);
        memcpy(nh_ray_series(c, right, a * cols + n), nh_ray_series(c, c->value, c->at.b + a), size * sizeof *M);
    }
    good = good && (!f || nh_jet_solve(c->ring, f, M, cols, right));
    memset(c->frame, 0, (c->n * m + 1) * size * sizeof *M);
    memset(c->rest, 0, m * size * sizeof *M);
    for (size_t j = 0; j < n && good; j++) nh_ray_series(c, c->frame, j * m + free[j])[0] = 1;
    for (size_t p = 0; p < f && good; p++)
        for (size_t j = 0; j <= n; j++) /* column n: v0 */
            nh_jet_add_multiple(
                c->ring, j < n ? nh_ray_series(c, c->frame, j * m + pivot[p]) : nh_ray_series(c, c->rest, pivot[p]),
                nh_residue_negative(c->field, 1), nh_ray_series(c, right, p * cols + j));
    nh_free(at);
    nh_free(M);
    nh_free(right);
    nh_free(pivot);
    return good;
}

/* Forces at a random velocity that the constraints allow. */
static bool evaluate_forces(nh_count_rays *c, nh_jet_eval *v)
{
    nh_residue *at = nh_alloc_array(c->ring->size, sizeof *at);
    nh_residue *w = nh_alloc_array(c->n + 1, sizeof *w);
    for (size_t j = 0; j < c->n; j++) w[j] = nh_residue_random(c->field, &c->random);
    for (size_t s = 0; s < c->m; s++) {
        memcpy(at, nh_ray_series(c, c->rest, s), c->ring->size * sizeof *at);
        for (size_t j = 0; j < c->n; j++)
            nh_jet_add_multiple(c->ring, at, w[j], nh_ray_series(c, c->frame, j * c->m + s));
        nh_jet_eval_set(v, c->k->v[s], at, true);
        memcpy(nh_ray_series(c, c->rest, s), at, c->ring->size * sizeof *at); /* from now on this velocity */
    }
    bool good = nh_jet_eval_all(v, c->at.total - c->at.velocity_free, c->e + c->at.velocity_free,
                                nh_ray_series(c, c->value, c->at.velocity_free));
    nh_free(at);
    nh_free(w);
    return good;
}

/* K^-1, Gamma, and along both directions G = Gamma(., x), dG = its derivatives [transport.h]. */
static bool connection(nh_count_rays *c)
{
    const nh_jet_ring *ring = c->ring;
    size_t m = c->m, h = c->h, size = ring->size, cube = m * m * m;
    nh_residue half = nh_residue_inverse(c->field, 2), *K = nh_alloc_array(m * m * size, sizeof *K),
               *first = nh_alloc_array(cube * size, sizeof *first), *sum = nh_alloc_array(size, sizeof *sum);
    for (size_t i = 0; i < m * m; i++) {
        memcpy(nh_ray_series(c, K, i), nh_ray_series(c, c->value, c->at.K + nh_ray_packed(i / m, i % m)),
               size * sizeof *K);
        nh_jet_constant(ring, i % (m + 1) == 0, nh_ray_series(c, c->inverse, i));
    }
    bool good = nh_jet_solve(ring, m, K, m, c->inverse);
#define DK(i, j, l) nh_ray_series(c, c->value, c->at.dK + (l)*h + nh_ray_packed(i, j))
#define DDK(i, j, l, p) nh_ray_series(c, c->value, c->at.ddK + nh_ray_packed(l, p) * h + nh_ray_packed(i, j))
    nh_residue minus = nh_residue_negative(c->field, half);
    memset(c->gamma, 0, cube * size * sizeof *first);
    for (size_t at = 0; at < cube && good; at++) { /* first[l][j][k] = Gamma_l,jk */
        size_t l = at / m / m, j = at / m % m, k = at % m;
        nh_jet_add_multiple(ring, nh_ray_series(c, first, at), half, DK(l, k, j));
        nh_jet_add_multiple(ring, nh_ray_series(c, first, at), half, DK(l, j, k));
        nh_jet_add_multiple(ring, nh_ray_series(c, first, at), minus, DK(j, k, l));
    }
    for (size_t at = 0; at < cube && good; at++)
        for (size_t l = 0; l < m; l++)
            nh_jet_add_product(ring, nh_ray_series(c, c->gamma, at), nh_ray_series(c, c->inverse, at / m / m * m + l),
                               nh_ray_series(c, first, l * m * m + at % (m * m)));
    for (int way = 0; way < 2 && good; way++) {
        const nh_residue *x = way ? c->Y : c->X;
        memset(c->G[way], 0, m * m * size * sizeof *first);
        memset(c->dG[way], 0, cube * size * sizeof *first);
        for (size_t at = 0; at < cube; at++)
            nh_jet_add_multiple(ring, nh_ray_series(c, c->G[way], at / m), x[at % m], nh_ray_series(c, c->gamma, at));
        for (size_t at = 0; at < cube && !nh_late(); at++) { /* p, l, j: d_p Gamma_l,jk x^k - d_p K_ln G^n_j */
            size_t p = at / m / m, l = at / m % m, j = at % m;
            memset(sum, 0, size * sizeof *sum);
            for (size_t k = 0; k < m; k++) {
                nh_jet_add_multiple(ring, sum, nh_residue_mul(c->field, half, x[k]), DDK(l, k, j, p));
                nh_jet_add_multiple(ring, sum, nh_residue_mul(c->field, half, x[k]), DDK(l, j, k, p));
                nh_jet_add_multiple(ring, sum, nh_residue_mul(c->field, minus, x[k]), DDK(j, k, l, p));
            }
            for (size_t n = 0; n < m; n++)
                nh_jet_sub_product(ring, sum, DK(l, n, p), nh_ray_series(c, c->G[way], n * m + j));
            for (size_t i = 0; i < m; i++) /* dG[(p m + i) m + j] */
                nh_jet_add_product(ring, nh_ray_series(c, c->dG[way], (p * m + i) * m + j),
                                   nh_ray_series(c, c->inverse, i * m + l), sum);
        }
    }
#undef DK
#undef DDK
    nh_free(K);
    nh_free(first);
    nh_free(sum);
    return good;
}

/* The coefficient of s^power u^u of n series, side by side. */
static void cut(const nh_count_rays *c, const nh_residue *block, size_t n, nh_residue *out)
{
    for (size_t power = 0; power <= NH_RAY_ORDER; power++)
        for (size_t u = 0; u < 2; u++) {
            if (u && power > NH_RAY_SIDE) continue;
            size_t e = nh_ray_index(c, power, u);
            for (size_t i = 0; i < n; i++) out[(2 * power + u) * n + i] = block[i * c->ring->size + e];
        }
}

static void cut_all(nh_count_rays *c)
{
    size_t m = c->m, cube = m * m * m;
    cut(c, c->gamma, cube, c->cGamma);
    cut(c, c->G[1], m * m, c->cGy);
    cut(c, c->dG[1], cube, c->cdGy);
    cut(c, c->G[0], m * m, c->cG);
    cut(c, c->dG[0], cube, c->cdG);
    for (size_t power = 0; power <= NH_RAY_SIDE; power++) { /* along X + u Y */
        for (size_t i = 0; i < m * m; i++) {
            nh_residue *to = c->cG + (2 * power + 1) * m * m + i;
            *to = nh_residue_add(c->field, *to, c->cGy[2 * power * m * m + i]);
        }
        for (size_t i = 0; i < cube; i++) {
            nh_residue *to = c->cdG + (2 * power + 1) * cube + i;
            *to = nh_residue_add(c->field, *to, c->cdGy[2 * power * cube + i]);
        }
    }
}

/* ---- jets ---- */

/* B = K^-1 (A - 1/2 xi^l d_l K) at q0, A antisymmetric: column by column into y. */
static void first_jets(nh_count_rays *c)
{
    size_t m = c->m, column = 0;
    nh_residue half = nh_residue_inverse(c->field, 2);
    for (size_t l = 0; l < m; l++)
        for (size_t j = 0; j <= l; j++, column++) { /* j = l: the unit vector l; else the turn l, j */
            nh_residue *jet = c->y + column * 2 * (NH_RAY_ORDER + 1) * c->jet;
            if (j == l) jet[l] = 1;
            for (size_t i = 0; i < m; i++)
                for (size_t k = 0; k < m; k++) {
                    uint64_t sum = 0;
                    for (size_t r = 0; r < m; r++) {
                        nh_residue S = r == l && k == j ? 1 : r == j && k == l ? (nh_residue)(c->field.p - 1) : 0;
                        if (j == l)
                            S = nh_residue_mul(
                                c->field, (nh_residue)(c->field.p - half),
                                nh_ray_series(c, c->value, c->at.dK + l * c->h + nh_ray_packed(r, k))[0]);
                        sum = nh_residue_gather(c->field, sum, nh_ray_series(c, c->inverse, i * m + r)[0], S);
                    }
                    jet[m + i * m + k] = nh_residue_reduce(c->field, sum);
                }
        }
}

/* out (m x m) += or -= a b, all m x m, row by row; `width` columns of b and out. */
static void gather(const nh_count_rays *c, const nh_residue *a, const nh_residue *b, size_t rows, size_t width,
                   bool minus, nh_residue *out)
{
    size_t m = c->m;
    for (size_t i = 0; i < rows; i++)
        for (size_t j = 0; j < width; j++) {
            uint64_t sum = 0;
            for (size_t k = 0; k < m; k++) sum = nh_residue_gather(c->field, sum, a[i * m + k], b[k * width + j]);
            nh_residue part = nh_residue_reduce(c->field, sum);
            out[i * width + j] = minus ? nh_residue_sub(c->field, out[i * width + j], part)
                                       : nh_residue_add(c->field, out[i * width + j], part);
        }
}

/* - xi^p dG_p + B G - G B - Gamma(., t) of one pair of coefficients. */
static void pair(const nh_count_rays *c, const nh_residue *Gamma, const nh_residue *G, const nh_residue *dG,
                 const nh_residue *jet, const nh_residue *t, const nh_residue *other_jet, const nh_residue *other_G,
                 nh_residue *out)
{
    size_t m = c->m, square = m * m;
    for (size_t i = 0; i < square; i++) {
        uint64_t sum = 0;
        for (size_t p = 0; p < m; p++) sum = nh_residue_gather(c->field, sum, dG[p * square + i], jet[p]);
        out[i] = nh_residue_sub(c->field, out[i], nh_residue_reduce(c->field, sum));
    }
    gather(c, other_jet + m, other_G, m, m, false, out);
    gather(c, G, jet + m, m, m, true, out);
    gather(c, Gamma, t, square, 1, true, out);
}

/* The coefficient (power, u) of the rate of B along the ray (way 0) or along Y at u = 0 (way 1). */
void nh_symmetry_rays_rate(const nh_count_rays *c, size_t column, size_t power, size_t u, int way, const nh_residue *t,
                           nh_residue *out)
{
    size_t m = c->m, square = m * m, cube = m * square;
    const nh_residue *y = c->y + column * 2 * (NH_RAY_ORDER + 1) * c->jet, *G = way ? c->cGy : c->cG,
                     *dG = way ? c->cdGy : c->cdG;
    memset(out, 0, square * sizeof *out);
    for (size_t a = 0; a <= power; a++)
        for (size_t e = 0; e <= u; e++) {
            size_t here = 2 * a + e, there = 2 * (power - a) + u - e;
            pair(c, c->cGamma + here * cube, G + here * square, dG + here * cube, y + there * c->jet, t + there * m,
                 y + here * c->jet, G + there * square, out);
        }
}

/* B Z for the direction X + u Y (way 0) or Y (way 1): the coefficient (power, u). */
void nh_symmetry_rays_moved(const nh_count_rays *c, const nh_residue *y, size_t power, size_t u, int way,
                            nh_residue *out)
{
    size_t m = c->m;
    memset(out, 0, m * sizeof *out);
    gather(c, y + (2 * power + u) * c->jet + m, way ? c->Y : c->X, m, 1, false, out);
    if (u) gather(c, y + 2 * power * c->jet + m, c->Y, m, 1, false, out);
}

/* Transports all columns; y[0] is given. */
static void transport(nh_count_rays *c)
{
    size_t m = c->m;
    for (size_t column = 0; column < c->columns && !nh_late(); column++) {
        nh_residue *y = c->y + column * 2 * (NH_RAY_ORDER + 1) * c->jet;
        for (size_t power = 0; power < NH_RAY_ORDER; power++) {
            nh_residue by = nh_residue_inverse(c->field, (nh_residue)(power + 1));
            for (size_t u = 0; u < 2; u++) {
                if (u && power >= NH_RAY_SIDE) continue;
                nh_residue *next = y + (2 * (power + 1) + u) * c->jet;
                nh_symmetry_rays_moved(c, y, power, u, 0, c->t + (2 * power + u) * m);
                memcpy(next, c->t + (2 * power + u) * m, m * sizeof *next);
                nh_symmetry_rays_rate(c, column, power, u, 0, c->t, next + m);
                nh_residue_scale(c->field, c->jet, next, by);
            }
        }
    }
}

bool nh_symmetry_rays_follow(nh_count_rays *c)
{
    for (size_t s = 0; s < c->m; s++) {
        c->X[s] = nh_residue_random(c->field, &c->random);
        c->Y[s] = nh_residue_random(c->field, &c->random);
    }
    nh_jet_eval *v = nh_jet_eval_create(c->point, c->ring);
    set_positions(c, v);
    bool good = nh_jet_eval_all(v, c->at.velocity_free, c->e, c->value) && find_frame(c) && connection(c);
    if (good && c->k->forced) good = evaluate_forces(c, v);
    nh_jet_eval_free(v);
    if (!good) return false;
    cut_all(c);
    memset(c->y, 0, c->columns * 2 * (NH_RAY_ORDER + 1) * c->jet * sizeof *c->y);
    first_jets(c);
    transport(c);
    return true;
}

void nh_symmetry_rays_allocate(nh_count_rays *c)
{
    size_t m = c->m, cube = m * m * m, size = c->ring->size, powers = 2 * (NH_RAY_ORDER + 1);
    c->q0 = nh_alloc_array(3 * m, sizeof *c->q0), c->X = c->q0 + m, c->Y = c->X + m;
    c->value = nh_alloc_array(c->at.total * size, sizeof *c->value);
    c->gamma = nh_alloc_array((3 * cube + 3 * m * m) * size, sizeof *c->gamma);
    c->dG[0] = c->gamma + cube * size, c->dG[1] = c->dG[0] + cube * size, c->G[0] = c->dG[1] + cube * size;
    c->G[1] = c->G[0] + m * m * size, c->inverse = c->G[1] + m * m * size;
    c->frame = nh_alloc_array((c->n * m + 1 + m) * size, sizeof *c->frame);
    c->rest = c->frame + (c->n * m + 1) * size;
    c->cGamma = nh_alloc_array(powers * (3 * cube + 2 * m * m), sizeof *c->cGamma);
    c->cdG = c->cGamma + powers * cube, c->cdGy = c->cdG + powers * cube, c->cG = c->cdGy + powers * cube;
    c->cGy = c->cG + powers * m * m;
    c->y = nh_alloc_array(c->columns * powers * c->jet, sizeof *c->y);
    c->t = nh_alloc_array(powers * m, sizeof *c->t);
    for (size_t set = 0; set < NH_COUNT_SETS; set++)
        c->rows[set].row = nh_alloc_array(c->columns * c->columns, sizeof(nh_residue));
}

void nh_symmetry_rays_release(nh_count_rays *c)
{
    nh_free(c->q0);
    nh_free(c->value);
    nh_free(c->gamma);
    nh_free(c->frame);
    nh_free(c->cGamma);
    nh_free(c->y);
    nh_free(c->t);
    for (size_t set = 0; set < NH_COUNT_SETS; set++) nh_free(c->rows[set].row);
}

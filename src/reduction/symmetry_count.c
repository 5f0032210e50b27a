#include "reduction/symmetry_count.h"

#include <string.h>

#include "base/progress.h"
#include "exact/form.h"
#include "exact/generic_value.h"
#include "exact/jet_eval.h"
#include "exact/residue_matrix.h"

/* s to the order `order`, s u to `order - heavy`; u^2 = 0 */
enum { order = 13, heavy = 7, side = order - heavy, canonical_length = 2000, most_points = 60, most_rays = 12,
       most_nodes = 400000, most_coordinates = 16 };

enum { OF_METRIC, OF_POTENTIAL, OF_CONSTRAINTS, KINDS };

/* Where the expressions of each sort stand. */
typedef struct {
    size_t K, dK, ddK, dV, omega, domega, b, db, a, da, velocity_free, Q, dQ, total;
} layout;

/* Rows in echelon form. */
typedef struct {
    size_t rank;
    nh_residue *row;
} echelon;

typedef struct {
    const nh_kinetic *k;
    size_t m, f, n, h, columns, jet; /* n = m - f; jet = m + m^2 */
    layout at;
    nh_ex *e;
    nh_jet_point *point;
    nh_prime field;
    const nh_jet_ring *ring;
    uint64_t random;
    nh_residue *q0, *X, *Y;                  /* m */
    nh_residue *value;                       /* series of all expressions */
    nh_residue *gamma, *G[2], *dG[2], *inverse; /* series: m^3; along X and Y, m^2 and m^3; m^2 */
    nh_residue *frame, *rest;                /* D: n x m series; m series, v0 of affine constraints */
    /* by powers of s, then of u: coefficient (power, u) of Gamma, G, dG, and of each column's jet and B Z */
    nh_residue *cGamma, *cG, *cdG, *cGy, *cdGy, *y, *t;
    echelon rows[1 << KINDS];                /* by sets of kinds */
    size_t before[1 << KINDS];
} count;

static size_t packed(size_t i, size_t j) { return i >= j ? i * (i + 1) / 2 + j : j * (j + 1) / 2 + i; }

/* ---- expressions ---- */

static void lay_out(count *c)
{
    size_t m = c->m, f = c->f, h = c->h, n = 0;
    layout *l = &c->at;
    l->K = n, n += h;
    l->dK = n, n += m * h;
    l->ddK = n, n += h * h;
    l->dV = n, n += m;
    l->omega = n, n += f * m;
    l->domega = n, n += m * f * m;
    l->b = n, n += f;
    l->db = n, n += m * f;
    l->a = n, n += m;
    l->da = n, n += m * m;
    l->velocity_free = l->Q = n;
    if (c->k->forced) n += m;
    l->dQ = n; /* by q^0.., then by v^0.. */
    if (c->k->forced) n += 2 * m * m;
    l->total = n;
}

static nh_ex slope(const count *c, nh_ex e, size_t s) { return nh_kinetic_diff(c->k, e, c->k->q[s]); }

static void list(count *c, nh_ex *e)
{
    const nh_kinetic *k = c->k;
    const layout *l = &c->at;
    size_t m = c->m, f = c->f, h = c->h;
    for (size_t i = 0; i < m; i++)
        for (size_t j = 0; j <= i; j++) e[l->K + packed(i, j)] = k->K[i * m + j];
    memcpy(e + l->omega, k->omega, f * m * sizeof *e);
    memcpy(e + l->b, k->b, f * sizeof *e);
    memcpy(e + l->a, k->a, m * sizeof *e);
    for (size_t s = 0; s < m; s++) {
        for (size_t p = 0; p < h; p++) e[l->dK + s * h + p] = slope(c, e[l->K + p], s);
        e[l->dV + s] = slope(c, k->V, s);
        for (size_t i = 0; i < f * m; i++) e[l->domega + s * f * m + i] = slope(c, k->omega[i], s);
        for (size_t i = 0; i < f; i++) e[l->db + s * f + i] = slope(c, k->b[i], s);
        for (size_t i = 0; i < m; i++) e[l->da + s * m + i] = slope(c, k->a[i], s);
        for (size_t r = 0; r <= s; r++)
            for (size_t p = 0; p < h; p++) e[l->ddK + packed(s, r) * h + p] = slope(c, e[l->dK + s * h + p], r);
        for (size_t i = 0; i < m && k->forced; i++) {
            e[l->Q + i] = k->Q[i];
            e[l->dQ + s * m + i] = slope(c, k->Q[i], s);
            e[l->dQ + (m + s) * m + i] = nh_kinetic_diff(k, k->Q[i], k->v[s]);
        }
    }
}

/* The reason why there are no residues, or NULL. */
static const char *take(count *c)
{
    nh_forms forms;
    nh_ex *e = nh_alloc_array(c->at.total, sizeof *e);
    size_t nodes = 0, rank;
    list(c, e);
    nh_forms_init(&forms, c->k->dag, false, canonical_length);
    for (size_t i = 0; i < c->at.total && nodes < most_nodes && !nh_late(); i++) {
        nodes += nh_node_count(c->k->dag, e[i]);
        c->e[i] = nh_form_rewrite(&forms, nh_model_values(c->k->model, e[i]));
    }
    nh_forms_clear(&forms);
    nh_free(e);
    if (nodes >= most_nodes || nh_late()) return "formulas that are too long";
    /* the derivatives have no other functions */
    nh_ex *own = nh_alloc_array(c->at.total, sizeof *own);
    size_t n = 0;
    for (size_t i = 0; i < c->h; i++) own[n++] = c->e[c->at.K + i];
    for (size_t i = c->at.dV; i < c->at.total; i++) own[n++] = c->e[i];
    bool known = nh_generic_rank(c->k->dag, 1, n, own, &rank);
    nh_free(own);
    if (!known) return "functions without residues, or related in ways that are not known";
    return nh_jet_point_register(c->point, c->at.total, c->e) ? NULL : c->point->obstacle;
}

/* ---- along a ray ---- */

static nh_residue *series(const count *c, nh_residue *block, size_t i) { return block + i * c->ring->size; }

static size_t index_of(const count *c, size_t power, size_t u)
{
    uint8_t exponent[2] = {(uint8_t)power, (uint8_t)u};
    return nh_jet_ring_find(c->ring, exponent);
}

static void set_positions(const count *c, nh_jet_eval *v)
{
    nh_residue *at = nh_alloc_array(c->ring->size, sizeof *at);
    for (size_t s = 0; s < c->m; s++) {
        nh_jet_constant(c->ring, c->q0[s], at);
        at[index_of(c, 1, 0)] = c->X[s];
        at[index_of(c, 1, 1)] = c->Y[s];
        nh_jet_eval_set(v, c->k->q[s], at, false);
    }
    nh_free(at);
}

/* D: velocities e_free - S e_dependent, and v0, series; false where the constraints are dependent at the point. */
static bool find_frame(count *c)
{
    size_t m = c->m, f = c->f, size = c->ring->size, cols = c->n + 1;
    nh_residue *at = nh_alloc_array(f * m + 1, sizeof *at), *M = nh_alloc_array(f * f * size + 1, sizeof *M),
               *right = nh_alloc_array(f * cols * size + 1, sizeof *right);
    size_t *pivot = nh_alloc_array(f + m + 1, sizeof *pivot), *free = pivot + f, n = 0;
    for (size_t i = 0; i < f * m; i++) at[i] = series(c, c->value, c->at.omega + i)[0];
    bool good = nh_residue_matrix_pivots(c->field, f, m, at, pivot) == f;
    for (size_t s = 0, p = 0; s < m && good; s++)
        if (p < f && pivot[p] == s) p++;
        else free[n++] = s;
    for (size_t a = 0; a < f && good; a++) {
        for (size_t p = 0; p < f; p++)
            memcpy(series(c, M, a * f + p), series(c, c->value, c->at.omega + a * m + pivot[p]), size * sizeof *M);
        for (size_t j = 0; j < n; j++)
            memcpy(series(c, right, a * cols + j), series(c, c->value, c->at.omega + a * m + free[j]),
                   size * sizeof *M);
        memcpy(series(c, right, a * cols + n), series(c, c->value, c->at.b + a), size * sizeof *M);
    }
    good = good && (!f || nh_jet_solve(c->ring, f, M, cols, right));
    memset(c->frame, 0, (c->n * m + 1) * size * sizeof *M);
    memset(c->rest, 0, m * size * sizeof *M);
    for (size_t j = 0; j < n && good; j++) series(c, c->frame, j * m + free[j])[0] = 1;
    for (size_t p = 0; p < f && good; p++)
        for (size_t j = 0; j <= n; j++) /* column n: v0 */
            nh_jet_add_multiple(c->ring,
                                j < n ? series(c, c->frame, j * m + pivot[p]) : series(c, c->rest, pivot[p]),
                                nh_residue_negative(c->field, 1), series(c, right, p * cols + j));
    nh_free(at);
    nh_free(M);
    nh_free(right);
    nh_free(pivot);
    return good;
}

/* Forces at a random velocity that the constraints allow. */
static bool evaluate_forces(count *c, nh_jet_eval *v)
{
    nh_residue *at = nh_alloc_array(c->ring->size, sizeof *at);
    nh_residue *w = nh_alloc_array(c->n + 1, sizeof *w);
    for (size_t j = 0; j < c->n; j++) w[j] = nh_residue_random(c->field, &c->random);
    for (size_t s = 0; s < c->m; s++) {
        memcpy(at, series(c, c->rest, s), c->ring->size * sizeof *at);
        for (size_t j = 0; j < c->n; j++) nh_jet_add_multiple(c->ring, at, w[j], series(c, c->frame, j * c->m + s));
        nh_jet_eval_set(v, c->k->v[s], at, true);
        memcpy(series(c, c->rest, s), at, c->ring->size * sizeof *at); /* from now on this velocity */
    }
    bool good = nh_jet_eval_all(v, c->at.total - c->at.velocity_free, c->e + c->at.velocity_free,
                                series(c, c->value, c->at.velocity_free));
    nh_free(at);
    nh_free(w);
    return good;
}

/* K^-1, Gamma, and along both directions G = Gamma(., x), dG = its derivatives [transport.h]. */
static bool connection(count *c)
{
    const nh_jet_ring *ring = c->ring;
    size_t m = c->m, h = c->h, size = ring->size, cube = m * m * m;
    nh_residue half = nh_residue_inverse(c->field, 2), *K = nh_alloc_array(m * m * size, sizeof *K),
               *first = nh_alloc_array(cube * size, sizeof *first), *sum = nh_alloc_array(size, sizeof *sum);
    for (size_t i = 0; i < m * m; i++) {
        memcpy(series(c, K, i), series(c, c->value, c->at.K + packed(i / m, i % m)), size * sizeof *K);
        nh_jet_constant(ring, i % (m + 1) == 0, series(c, c->inverse, i));
    }
    bool good = nh_jet_solve(ring, m, K, m, c->inverse);
#define DK(i, j, l) series(c, c->value, c->at.dK + (l) * h + packed(i, j))
#define DDK(i, j, l, p) series(c, c->value, c->at.ddK + packed(l, p) * h + packed(i, j))
    nh_residue minus = nh_residue_negative(c->field, half);
    memset(c->gamma, 0, cube * size * sizeof *first);
    for (size_t at = 0; at < cube && good; at++) { /* first[l][j][k] = Gamma_l,jk */
        size_t l = at / m / m, j = at / m % m, k = at % m;
        nh_jet_add_multiple(ring, series(c, first, at), half, DK(l, k, j));
        nh_jet_add_multiple(ring, series(c, first, at), half, DK(l, j, k));
        nh_jet_add_multiple(ring, series(c, first, at), minus, DK(j, k, l));
    }
    for (size_t at = 0; at < cube && good; at++)
        for (size_t l = 0; l < m; l++)
            nh_jet_add_product(ring, series(c, c->gamma, at), series(c, c->inverse, at / m / m * m + l),
                               series(c, first, l * m * m + at % (m * m)));
    for (int way = 0; way < 2 && good; way++) {
        const nh_residue *x = way ? c->Y : c->X;
        memset(c->G[way], 0, m * m * size * sizeof *first);
        memset(c->dG[way], 0, cube * size * sizeof *first);
        for (size_t at = 0; at < cube; at++)
            nh_jet_add_multiple(ring, series(c, c->G[way], at / m), x[at % m], series(c, c->gamma, at));
        for (size_t at = 0; at < cube && !nh_late(); at++) { /* p, l, j: d_p Gamma_l,jk x^k - d_p K_ln G^n_j */
            size_t p = at / m / m, l = at / m % m, j = at % m;
            memset(sum, 0, size * sizeof *sum);
            for (size_t k = 0; k < m; k++) {
                nh_jet_add_multiple(ring, sum, nh_residue_mul(c->field, half, x[k]), DDK(l, k, j, p));
                nh_jet_add_multiple(ring, sum, nh_residue_mul(c->field, half, x[k]), DDK(l, j, k, p));
                nh_jet_add_multiple(ring, sum, nh_residue_mul(c->field, minus, x[k]), DDK(j, k, l, p));
            }
            for (size_t n = 0; n < m; n++) nh_jet_sub_product(ring, sum, DK(l, n, p), series(c, c->G[way], n * m + j));
            for (size_t i = 0; i < m; i++) /* dG[(p m + i) m + j] */
                nh_jet_add_product(ring, series(c, c->dG[way], (p * m + i) * m + j),
                                   series(c, c->inverse, i * m + l), sum);
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
static void cut(const count *c, const nh_residue *block, size_t n, nh_residue *out)
{
    for (size_t power = 0; power <= order; power++)
        for (size_t u = 0; u < 2; u++) {
            if (u && power > side) continue;
            size_t e = index_of(c, power, u);
            for (size_t i = 0; i < n; i++) out[(2 * power + u) * n + i] = block[i * c->ring->size + e];
        }
}

static void cut_all(count *c)
{
    size_t m = c->m, cube = m * m * m;
    cut(c, c->gamma, cube, c->cGamma);
    cut(c, c->G[1], m * m, c->cGy);
    cut(c, c->dG[1], cube, c->cdGy);
    cut(c, c->G[0], m * m, c->cG);
    cut(c, c->dG[0], cube, c->cdG);
    for (size_t power = 0; power <= side; power++) { /* along X + u Y */
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
static void first_jets(count *c)
{
    size_t m = c->m, column = 0;
    nh_residue half = nh_residue_inverse(c->field, 2);
    for (size_t l = 0; l < m; l++)
        for (size_t j = 0; j <= l; j++, column++) { /* j = l: the unit vector l; else the turn l, j */
            nh_residue *jet = c->y + column * 2 * (order + 1) * c->jet;
            if (j == l) jet[l] = 1;
            for (size_t i = 0; i < m; i++)
                for (size_t k = 0; k < m; k++) {
                    uint64_t sum = 0;
                    for (size_t r = 0; r < m; r++) {
                        nh_residue S = r == l && k == j ? 1 : r == j && k == l ? (nh_residue)(c->field.p - 1) : 0;
                        if (j == l)
                            S = nh_residue_mul(c->field, (nh_residue)(c->field.p - half),
                                               series(c, c->value, c->at.dK + l * c->h + packed(r, k))[0]);
                        sum = nh_residue_gather(c->field, sum, series(c, c->inverse, i * m + r)[0], S);
                    }
                    jet[m + i * m + k] = nh_residue_reduce(c->field, sum);
                }
        }
}

/* out (m x m) += or -= a b, all m x m, row by row; `width` columns of b and out. */
static void gather(const count *c, const nh_residue *a, const nh_residue *b, size_t rows, size_t width, bool minus,
                   nh_residue *out)
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
static void pair(const count *c, const nh_residue *Gamma, const nh_residue *G, const nh_residue *dG,
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
static void rate(const count *c, size_t column, size_t power, size_t u, int way, const nh_residue *t, nh_residue *out)
{
    size_t m = c->m, square = m * m, cube = m * square;
    const nh_residue *y = c->y + column * 2 * (order + 1) * c->jet, *G = way ? c->cGy : c->cG,
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
static void moved(const count *c, const nh_residue *y, size_t power, size_t u, int way, nh_residue *out)
{
    size_t m = c->m;
    memset(out, 0, m * sizeof *out);
    gather(c, y + (2 * power + u) * c->jet + m, way ? c->Y : c->X, m, 1, false, out);
    if (u) gather(c, y + 2 * power * c->jet + m, c->Y, m, 1, false, out);
}

/* Transports all columns; y[0] is given. */
static void transport(count *c)
{
    size_t m = c->m;
    for (size_t column = 0; column < c->columns && !nh_late(); column++) {
        nh_residue *y = c->y + column * 2 * (order + 1) * c->jet;
        for (size_t power = 0; power < order; power++) {
            nh_residue by = nh_residue_inverse(c->field, (nh_residue)(power + 1));
            for (size_t u = 0; u < 2; u++) {
                if (u && power >= side) continue;
                nh_residue *next = y + (2 * (power + 1) + u) * c->jet;
                moved(c, y, power, u, 0, c->t + (2 * power + u) * m);
                memcpy(next, c->t + (2 * power + u) * m, m * sizeof *next);
                rate(c, column, power, u, 0, c->t, next + m);
                nh_residue_scale(c->field, c->jet, next, by);
            }
        }
    }
}

/* ---- rows ---- */

static void append(count *c, int kind, size_t rows, const nh_residue *row)
{
    size_t n = c->columns;
    size_t *pivot = nh_alloc_array(n + rows + 1, sizeof *pivot);
    nh_residue *all = nh_alloc_array((n + rows) * n, sizeof *all);
    for (size_t set = 1; set < 1 << KINDS; set++) {
        echelon *e = &c->rows[set];
        if (!(set >> kind & 1)) continue;
        memcpy(all, e->row, e->rank * n * sizeof *all);
        memcpy(all + e->rank * n, row, rows * n * sizeof *all);
        e->rank = nh_residue_matrix_echelon(c->field, e->rank + rows, n, n, all, pivot);
        memcpy(e->row, all, e->rank * n * sizeof *all);
    }
    nh_free(all);
    nh_free(pivot);
}

/* d_u xi - s B Y and d_u B - s (rate of B along Y), power by power. */
static void metric_rows(count *c)
{
    size_t m = c->m, rows = side * c->jet, n = c->columns;
    nh_residue *row = nh_alloc_array(rows * n, sizeof *row), *want = nh_alloc_array(c->jet, sizeof *want);
    for (size_t column = 0; column < n && !nh_late(); column++) {
        const nh_residue *y = c->y + column * 2 * (order + 1) * c->jet;
        for (size_t power = 0; power < side; power++) {
            moved(c, y, power, 0, 1, c->t + 2 * power * m);
            memcpy(want, c->t + 2 * power * m, m * sizeof *want);
            rate(c, column, power, 0, 1, c->t, want + m);
            for (size_t i = 0; i < c->jet; i++)
                row[(power * c->jet + i) * n + column] =
                    nh_residue_sub(c->field, y[(2 * (power + 1) + 1) * c->jet + i], want[i]);
        }
    }
    append(c, OF_METRIC, rows, row);
    nh_free(row);
    nh_free(want);
}

/* The components of the jet of a column as series at u = 0. */
static void jet_series(const count *c, size_t column, nh_residue *out)
{
    const nh_residue *y = c->y + column * 2 * (order + 1) * c->jet;
    memset(out, 0, c->jet * c->ring->size * sizeof *out);
    for (size_t power = 0; power <= order; power++)
        for (size_t i = 0; i < c->jet; i++)
            out[i * c->ring->size + index_of(c, power, 0)] = y[2 * power * c->jet + i];
}

/* out += sum_l of jet's xi^l e_l, e_l = the series number `first + l step`. */
static void along(const count *c, const nh_residue *jet, size_t first, size_t step, nh_residue *out)
{
    for (size_t l = 0; l < c->m; l++)
        nh_jet_add_product(c->ring, out, series(c, (nh_residue *)jet, l), series(c, c->value, first + l * step));
}

/* out = (L_xi form)_i = xi^l d_l form_i + form_l B^l_i, of series from `form` on, their derivatives from `slope` on,
   `step` apart. */
static void of_form(const count *c, const nh_residue *jet, size_t form, size_t slope_at, size_t step, size_t i,
                    nh_residue *out)
{
    memset(out, 0, c->ring->size * sizeof *out);
    along(c, jet, slope_at + i, step, out);
    for (size_t l = 0; l < c->m; l++)
        nh_jet_add_product(c->ring, out, series(c, c->value, form + l),
                           series(c, (nh_residue *)jet, c->m + l * c->m + i));
}

static void put(const count *c, const nh_residue *from, size_t at, size_t column, nh_residue *row)
{
    for (size_t power = 0; power <= order; power++)
        row[(at * (order + 1) + power) * c->columns + column] = from[index_of(c, power, 0)];
}

static void potential_rows(count *c)
{
    size_t m = c->m, rows = (1 + m) * (order + 1), size = c->ring->size;
    nh_residue *row = nh_alloc_array(rows * c->columns, sizeof *row), *jet = nh_alloc_array(c->jet * size, sizeof *jet),
               *sum = nh_alloc_array(size, sizeof *sum);
    for (size_t column = 0; column < c->columns && !nh_late(); column++) {
        jet_series(c, column, jet);
        memset(sum, 0, size * sizeof *sum);
        along(c, jet, c->at.dV, 1, sum);
        put(c, sum, m, column, row);
        for (size_t i = 0; i < m && c->k->magnetic; i++) {
            of_form(c, jet, c->at.a, c->at.da, m, i, sum);
            put(c, sum, i, column, row);
        }
    }
    append(c, OF_POTENTIAL, rows, row);
    nh_free(row);
    nh_free(jet);
    nh_free(sum);
}

/* (L_xi Q)_i = xi^l d_l Q_i + B^l_r v^r dQ_i/dv^l + Q_l B^l_i. */
static void of_force(const count *c, const nh_residue *jet, const nh_residue *turned, size_t i, nh_residue *out)
{
    of_form(c, jet, c->at.Q, c->at.dQ, c->m, i, out);
    for (size_t l = 0; l < c->m; l++)
        nh_jet_add_product(c->ring, out, turned + l * c->ring->size,
                           series(c, c->value, c->at.dQ + (c->m + l) * c->m + i));
}

static void constraint_rows(count *c)
{
    size_t m = c->m, f = c->f, n = c->n, each = f * (n + 1) + m, rows = each * (order + 1), size = c->ring->size;
    nh_residue *row = nh_alloc_array(rows * c->columns + 1, sizeof *row),
               *jet = nh_alloc_array(c->jet * size, sizeof *jet),
               *form = nh_alloc_array((m + 1) * size, sizeof *form), *sum = form + m * size;
    for (size_t column = 0; column < c->columns && !nh_late(); column++) {
        size_t at = 0;
        jet_series(c, column, jet);
        for (size_t a = 0; a < f; a++) {
            for (size_t i = 0; i < m; i++)
                of_form(c, jet, c->at.omega + a * m, c->at.domega + a * m, f * m, i, series(c, form, i));
            for (size_t j = 0; j <= n; j++) { /* on D; j = n: on v0, with xi(b) */
                memset(sum, 0, size * sizeof *sum);
                if (j == n) along(c, jet, c->at.db + a, f, sum);
                for (size_t i = 0; i < m; i++)
                    nh_jet_add_product(c->ring, sum, series(c, form, i),
                                       j < n ? series(c, c->frame, j * m + i) : series(c, c->rest, i));
                put(c, sum, at++, column, row);
            }
        }
        for (size_t l = 0; l < m && c->k->forced; l++) { /* B v */
            memset(series(c, form, l), 0, size * sizeof *form);
            for (size_t r = 0; r < m; r++)
                nh_jet_add_product(c->ring, series(c, form, l), series(c, jet, m + l * m + r), series(c, c->rest, r));
        }
        for (size_t i = 0; i < m && c->k->forced; i++) {
            of_force(c, jet, form, i, sum);
            put(c, sum, at++, column, row);
        }
    }
    if (f || c->k->forced) append(c, OF_CONSTRAINTS, rows, row);
    nh_free(row);
    nh_free(jet);
    nh_free(form);
}

/* One random ray from q0; false where the point is not regular. */
static bool ray(count *c)
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
    memset(c->y, 0, c->columns * 2 * (order + 1) * c->jet * sizeof *c->y);
    first_jets(c);
    transport(c);
    metric_rows(c);
    potential_rows(c);
    constraint_rows(c);
    return !nh_late();
}

/* ---- the whole ---- */

/* The rank of the xi of the kernel of the rows. */
static size_t orbit_of(const count *c, const echelon *e)
{
    size_t n = c->columns, m = c->m, kernel = 0;
    bool *bound = nh_alloc_array(n, sizeof *bound);
    size_t *pivot = nh_alloc_array(n + 1, sizeof *pivot);
    nh_residue *xi = nh_alloc_array(n * m + 1, sizeof *xi);
    for (size_t r = 0; r < e->rank; r++) {
        pivot[r] = 0;
        while (e->row[r * n + pivot[r]] == 0) pivot[r]++;
        bound[pivot[r]] = true;
    }
    for (size_t j = 0; j < n; j++) {
        if (bound[j]) continue;
        for (size_t i = 0; i < m; i++) { /* column j less those of the pivots */
            nh_residue sum = c->y[j * 2 * (order + 1) * c->jet + i];
            for (size_t r = 0; r < e->rank; r++)
                sum = nh_residue_sub(c->field, sum, nh_residue_mul(c->field, e->row[r * n + j],
                                                                   c->y[pivot[r] * 2 * (order + 1) * c->jet + i]));
            xi[kernel * m + i] = sum;
        }
        kernel++;
    }
    size_t rank = nh_residue_matrix_rank(c->field, kernel, m, xi);
    nh_free(bound);
    nh_free(pivot);
    nh_free(xi);
    return rank;
}

static bool settled(count *c)
{
    bool same = true;
    for (size_t set = 1; set < 1 << KINDS; set++) {
        same &= c->before[set] == c->rows[set].rank;
        c->before[set] = c->rows[set].rank;
    }
    return same;
}

/* Rays until two in a row add nothing. */
static const char *rows_at(count *c, uint64_t seed)
{
    size_t quiet = 0;
    c->random = 90210 + seed;
    nh_jet_point_choose(c->point, c->field, seed);
    for (size_t s = 0; s < c->m; s++) c->q0[s] = nh_residue_random(c->field, &c->random);
    for (size_t set = 0; set < 1 << KINDS; set++) c->rows[set].rank = c->before[set] = 0;
    for (size_t i = 0; i < most_rays && quiet < 2; i++) {
        if (!ray(c)) return nh_late() ? "the time that is left" : "no regular point was found";
        quiet = settled(c) ? quiet + 1 : 0;
    }
    return NULL;
}

static void allocate(count *c)
{
    size_t m = c->m, cube = m * m * m, size = c->ring->size, powers = 2 * (order + 1);
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
    for (size_t set = 0; set < 1 << KINDS; set++)
        c->rows[set].row = nh_alloc_array(c->columns * c->columns, sizeof(nh_residue));
}

static void release(count *c)
{
    nh_free(c->q0);
    nh_free(c->value);
    nh_free(c->gamma);
    nh_free(c->frame);
    nh_free(c->cGamma);
    nh_free(c->y);
    nh_free(c->t);
    for (size_t set = 0; set < 1 << KINDS; set++) nh_free(c->rows[set].row);
}

static size_t least(size_t a, size_t b) { return a < b ? a : b; }

/* The bounds modulo the index-th prime; those that are smaller go to `out`. */
static const char *modulo(count *c, size_t index, nh_symmetry_count *out)
{
    static const size_t weight[2] = {1, heavy - 1}; /* of s and of u: s^k u has the degree k + heavy - 1 */
    const char *obstacle = "no regular point was found";
    c->field = nh_jet_point_prime(c->point, index);
    nh_jet_ring *ring = nh_jet_ring_create(c->field, 2, weight, order);
    c->ring = ring;
    allocate(c);
    for (uint64_t seed = 1; seed <= most_points && obstacle && !nh_late(); seed++) obstacle = rows_at(c, seed);
    if (!obstacle) {
        const size_t n = c->columns, metric = 1 << OF_METRIC, V = metric | 1 << OF_POTENTIAL,
                     D = metric | 1 << OF_CONSTRAINTS, all = V | D;
        bool fewer = n - c->rows[all].rank < out->dimension;
        out->of_metric = least(out->of_metric, n - c->rows[metric].rank);
        out->of_potential = least(out->of_potential, n - c->rows[V].rank);
        out->of_constraints = least(out->of_constraints, n - c->rows[D].rank);
        out->dimension = least(out->dimension, n - c->rows[all].rank);
        if (fewer) out->orbit = orbit_of(c, &c->rows[all]);
    }
    release(c);
    nh_jet_ring_free(ring);
    return obstacle;
}

nh_symmetry_count nh_symmetry_count_of(const nh_kinetic *k)
{
    enum { primes = 2 };
    size_t m = k->m;
    nh_symmetry_count out = {NULL, SIZE_MAX, SIZE_MAX, SIZE_MAX, SIZE_MAX, 0};
    if (m > most_coordinates) return (nh_symmetry_count){.obstacle = "too many coordinates"};
    count c = {.k = k, .m = m, .f = k->f, .n = m - k->f, .h = m * (m + 1) / 2, .columns = m * (m + 1) / 2,
               .jet = m + m * m, .point = nh_jet_point_create(k->dag)};
    lay_out(&c);
    c.e = nh_alloc_array(c.at.total, sizeof *c.e);
    out.obstacle = take(&c);
    for (size_t index = 0; index < primes && !out.obstacle; index++) out.obstacle = modulo(&c, index, &out);
    nh_jet_point_free(c.point);
    nh_free(c.e);
    return out;
}

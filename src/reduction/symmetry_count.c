/* The number of local symmetries modulo a prime (symmetry_count.h).
 *
 *      for each of two primes:
 *          q0 random, K, V, omega, .. as power series along q0 + s (X + u Y)
 *          until two rays in a row add no rank:
 *              jets as columns, transported as series in s, and to first order in u
 *              metric rows       d_u xi - s B Y,  d_u B - s (rate of B along Y)
 *              potential rows    xi(V)
 *              constraint rows   (L_xi omega)(X), .. on D, forces
 *          bound = columns - rank, for the metric alone, with the potential, with everything
 *      the smaller bound of the two */
#include "reduction/symmetry_count.h"

#include <string.h>

#include "base/progress.h"
#include "exact/form.h"
#include "exact/generic_value.h"
#include "exact/residue_matrix.h"
#include "graph/node.h"
#include "reduction/symmetry_rays.h"

enum { canonical_length = 2000, most_points = 400, most_nodes = 400000, most_coordinates = 16 };

enum { OF_METRIC, OF_POTENTIAL, OF_CONSTRAINTS };

/* ---- expressions ---- */

static void lay_out(nh_count_rays *c)
{
    size_t m = c->m, f = c->f, h = c->h, n = 0;
    nh_count_layout *l = &c->at;
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

/* d e/dq^s. */
static nh_ex slope(const nh_count_rays *c, nh_ex e, size_t s) { return nh_kinetic_diff(c->k, e, c->k->q[s]); }

static void list(nh_count_rays *c, nh_ex *e)
{
    const nh_kinetic *k = c->k;
    const nh_count_layout *l = &c->at;
    size_t m = c->m, f = c->f, h = c->h;
    for (size_t i = 0; i < m; i++)
        for (size_t j = 0; j <= i; j++) e[l->K + nh_ray_packed(i, j)] = k->K[i * m + j];
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
            for (size_t p = 0; p < h; p++) e[l->ddK + nh_ray_packed(s, r) * h + p] = slope(c, e[l->dK + s * h + p], r);
        for (size_t i = 0; i < m && k->forced; i++) {
            e[l->Q + i] = k->Q[i];
            e[l->dQ + s * m + i] = slope(c, k->Q[i], s);
            e[l->dQ + (m + s) * m + i] = nh_kinetic_diff(k, k->Q[i], k->v[s]);
        }
    }
}

/* The reason why there are no residues, or NULL. */
static const char *take(nh_count_rays *c)
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

/* ---- rows ---- */

/* Rows for one kind of condition, into its echelon form. */
static void append(nh_count_rays *c, int kind, size_t rows, const nh_residue *row)
{
    size_t n = c->columns;
    size_t *pivot = nh_alloc_array(n + rows + 1, sizeof *pivot);
    nh_residue *all = nh_alloc_array((n + rows) * n, sizeof *all);
    for (size_t set = 1; set < NH_COUNT_SETS; set++) {
        nh_echelon *e = &c->rows[set];
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
static void metric_rows(nh_count_rays *c)
{
    size_t m = c->m, rows = NH_RAY_SIDE * c->jet, n = c->columns;
    nh_residue *row = nh_alloc_array(rows * n, sizeof *row), *want = nh_alloc_array(c->jet, sizeof *want);
    for (size_t column = 0; column < n && !nh_late(); column++) {
        const nh_residue *y = c->y + column * 2 * (NH_RAY_ORDER + 1) * c->jet;
        for (size_t power = 0; power < NH_RAY_SIDE; power++) {
            nh_symmetry_rays_moved(c, y, power, 0, 1, c->t + 2 * power * m);
            memcpy(want, c->t + 2 * power * m, m * sizeof *want);
            nh_symmetry_rays_rate(c, column, power, 0, 1, c->t, want + m);
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
static void jet_series(const nh_count_rays *c, size_t column, nh_residue *out)
{
    const nh_residue *y = c->y + column * 2 * (NH_RAY_ORDER + 1) * c->jet;
    memset(out, 0, c->jet * c->ring->size * sizeof *out);
    for (size_t power = 0; power <= NH_RAY_ORDER; power++)
        for (size_t i = 0; i < c->jet; i++)
            out[i * c->ring->size + nh_ray_index(c, power, 0)] = y[2 * power * c->jet + i];
}

/* out += sum_l of jet's xi^l e_l, e_l = the series number `first + l step`. */
static void along(const nh_count_rays *c, const nh_residue *jet, size_t first, size_t step, nh_residue *out)
{
    for (size_t l = 0; l < c->m; l++)
        nh_jet_add_product(c->ring, out, nh_ray_series(c, (nh_residue *)jet, l),
                           nh_ray_series(c, c->value, first + l * step));
}

/* out = (L_xi form)_i = xi^l d_l form_i + form_l B^l_i, of series from `form` on, their derivatives from `slope` on,
   `step` apart. */
static void of_form(const nh_count_rays *c, const nh_residue *jet, size_t form, size_t slope_at, size_t step, size_t i,
                    nh_residue *out)
{
    memset(out, 0, c->ring->size * sizeof *out);
    along(c, jet, slope_at + i, step, out);
    for (size_t l = 0; l < c->m; l++)
        nh_jet_add_product(c->ring, out, nh_ray_series(c, c->value, form + l),
                           nh_ray_series(c, (nh_residue *)jet, c->m + l * c->m + i));
}

static void put(const nh_count_rays *c, const nh_residue *from, size_t at, size_t column, nh_residue *row)
{
    for (size_t power = 0; power <= NH_RAY_ORDER; power++)
        row[(at * (NH_RAY_ORDER + 1) + power) * c->columns + column] = from[nh_ray_index(c, power, 0)];
}

/* xi(V), power by power. */
static void potential_rows(nh_count_rays *c)
{
    size_t m = c->m, rows = (1 + m) * (NH_RAY_ORDER + 1), size = c->ring->size;
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
static void of_force(const nh_count_rays *c, const nh_residue *jet, const nh_residue *turned, size_t i, nh_residue *out)
{
    of_form(c, jet, c->at.Q, c->at.dQ, c->m, i, out);
    for (size_t l = 0; l < c->m; l++)
        nh_jet_add_product(c->ring, out, turned + l * c->ring->size,
                           nh_ray_series(c, c->value, c->at.dQ + (c->m + l) * c->m + i));
}

static void constraint_rows(nh_count_rays *c)
{
    size_t m = c->m, f = c->f, n = c->n, each = f * (n + 1) + m, rows = each * (NH_RAY_ORDER + 1), size = c->ring->size;
    nh_residue *row = nh_alloc_array(rows * c->columns + 1, sizeof *row),
               *jet = nh_alloc_array(c->jet * size, sizeof *jet), *form = nh_alloc_array((m + 1) * size, sizeof *form),
               *sum = form + m * size;
    for (size_t column = 0; column < c->columns && !nh_late(); column++) {
        size_t at = 0;
        jet_series(c, column, jet);
        for (size_t a = 0; a < f; a++) {
            for (size_t i = 0; i < m; i++)
                of_form(c, jet, c->at.omega + a * m, c->at.domega + a * m, f * m, i, nh_ray_series(c, form, i));
            for (size_t j = 0; j <= n; j++) { /* on D; j = n: on v0, with xi(b) */
                memset(sum, 0, size * sizeof *sum);
                if (j == n) along(c, jet, c->at.db + a, f, sum);
                for (size_t i = 0; i < m; i++)
                    nh_jet_add_product(c->ring, sum, nh_ray_series(c, form, i),
                                       j < n ? nh_ray_series(c, c->frame, j * m + i) : nh_ray_series(c, c->rest, i));
                put(c, sum, at++, column, row);
            }
        }
        for (size_t l = 0; l < m && c->k->forced; l++) { /* B v */
            memset(nh_ray_series(c, form, l), 0, size * sizeof *form);
            for (size_t r = 0; r < m; r++)
                nh_jet_add_product(c->ring, nh_ray_series(c, form, l), nh_ray_series(c, jet, m + l * m + r),
                                   nh_ray_series(c, c->rest, r));
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

static bool ray(nh_count_rays *c)
{
    if (!nh_symmetry_rays_follow(c)) return false;
    metric_rows(c);
    potential_rows(c);
    constraint_rows(c);
    return !nh_late();
}

/* ---- the whole ---- */

/* The rank of the xi of the kernel of the rows. */
static size_t orbit_of(const nh_count_rays *c, const nh_echelon *e)
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
            nh_residue sum = c->y[j * 2 * (NH_RAY_ORDER + 1) * c->jet + i];
            for (size_t r = 0; r < e->rank; r++)
                sum = nh_residue_sub(
                    c->field, sum,
                    nh_residue_mul(c->field, e->row[r * n + j], c->y[pivot[r] * 2 * (NH_RAY_ORDER + 1) * c->jet + i]));
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

static bool settled(nh_count_rays *c)
{
    bool same = true;
    for (size_t set = 1; set < NH_COUNT_SETS; set++) {
        same &= c->before[set] == c->rows[set].rank;
        c->before[set] = c->rows[set].rank;
    }
    return same;
}

/* Rays until two in a row add nothing. */
static const char *rows_at(nh_count_rays *c, uint64_t seed)
{
    size_t quiet = 0;
    c->random = 90210 + seed;
    nh_jet_point_choose(c->point, c->field, seed);
    for (size_t s = 0; s < c->m; s++) c->q0[s] = nh_residue_random(c->field, &c->random);
    for (size_t set = 0; set < NH_COUNT_SETS; set++) c->rows[set].rank = c->before[set] = 0;
    while (quiet < 2) {
        if (!ray(c)) return nh_late() ? "the time that is left" : "no regular point was found";
        quiet = settled(c) ? quiet + 1 : 0;
    }
    return NULL;
}

static size_t least(size_t a, size_t b) { return a < b ? a : b; }

/* The bounds modulo the index-th prime; those that are smaller go to `out`. */
static const char *modulo(nh_count_rays *c, size_t index, nh_symmetry_count *out)
{
    static const size_t weight[2] = {1, NH_RAY_HEAVY - 1}; /* of s and of u */
    const char *obstacle = "no regular point was found";
    c->field = nh_jet_point_prime(c->point, index);
    nh_jet_ring *ring = nh_jet_ring_create(c->field, 2, weight, NH_RAY_ORDER);
    c->ring = ring;
    nh_symmetry_rays_allocate(c);
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
    nh_symmetry_rays_release(c);
    nh_jet_ring_free(ring);
    return obstacle;
}

nh_symmetry_count nh_symmetry_count_of(const nh_kinetic *k)
{
    enum { primes = 2 };
    size_t m = k->m;
    nh_symmetry_count out = {NULL, SIZE_MAX, SIZE_MAX, SIZE_MAX, SIZE_MAX, 0};
    if (m > most_coordinates) return (nh_symmetry_count){.obstacle = "too many coordinates"};
    nh_count_rays c = {.k = k,
                       .m = m,
                       .f = k->f,
                       .n = m - k->f,
                       .h = m * (m + 1) / 2,
                       .columns = m * (m + 1) / 2,
                       .jet = m + m * m,
                       .point = nh_jet_point_create(k->dag)};
    lay_out(&c);
    c.e = nh_alloc_array(c.at.total, sizeof *c.e);
    out.obstacle = take(&c);
    for (size_t index = 0; index < primes && !out.obstacle; index++) out.obstacle = modulo(&c, index, &out);
    nh_jet_point_free(c.point);
    nh_free(c.e);
    return out;
}

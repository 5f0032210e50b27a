/* count_products: products of known integrals as vectors modulo the prime: values of random linear functionals, which
 * are the same for products and for solutions of the count.
 *
 *     functional j      velocities w_j, a curve z_k = v_k s^(weight_k), and weights of the powers of s
 *     of a product      the integrals as series in s along the curve, multiplied
 *     of a solution     sum of c_alpha w^alpha, with the coefficients of z^e times v^e, sorted by weight of e
 *
 * The rank of the values is that of the products, at most N: a lower bound for the number of integrals. */
#include <string.h>

#include "base/progress.h"
#include "exact/residue_matrix.h"
#include "count/count_internal.h"

enum { most_products = 3000, spare_columns = 8 };

/* Exponents of all products up to a degree, the empty one first, `known` numbers each; returns 0 when there are too
 * many. */
static size_t list(const nh_counter *c, size_t degree, uint8_t *out)
{
    uint8_t *e = nh_alloc(c->known + 1);
    size_t count = 0;
    for (bool more = true; more && count <= most_products;) {
        if (out) memcpy(out + count * c->known, e, c->known);
        count++;
        size_t i = 0, sum = 0;
        for (size_t k = 0; k < c->known; k++) sum += e[k] * c->degree[k];
        while (i < c->known && (!c->degree[i] || sum + c->degree[i] > degree)) sum -= e[i] * c->degree[i], e[i++] = 0;
        more = i < c->known;
        if (more) e[i]++;
    }
    nh_free(e);
    return count <= most_products ? count : 0;
}

/* Every product but 1 is an earlier one times a factor. */
static void find_factors(nh_count_monomials *p, size_t known)
{
    uint8_t *less = nh_alloc(known + 1);
    for (size_t i = 1; i < p->count; i++) {
        size_t k = 0, before = i;
        while (!p->exponent[i * known + k]) k++;
        memcpy(less, p->exponent + i * known, known);
        less[k]--;
        while (before-- > 0 && memcmp(p->exponent + before * known, less, known) != 0) {
        }
        p->before[i] = before;
        p->is_factor[before] = true;
        p->factor[i] = k;
    }
    nh_free(less);
}

nh_count_monomials nh_count_monomials_list(const nh_counter *c, size_t degree)
{
    nh_count_monomials p = {.count = list(c, degree, NULL)};
    p.exponent = nh_alloc(p.count * c->known + 1);
    p.before = nh_alloc_array(p.count + 1, sizeof *p.before);
    p.factor = nh_alloc_array(p.count + 1, sizeof *p.factor);
    p.is_factor = nh_alloc_array(p.count + 1, sizeof *p.is_factor);
    if (p.count) list(c, degree, p.exponent);
    find_factors(&p, c->known);
    return p;
}

void nh_count_monomials_clear(nh_count_monomials *p)
{
    nh_free(p->is_factor);
    nh_free(p->factor);
    nh_free(p->before);
    nh_free(p->exponent);
}

/* ---- functionals ---- */

/* v^exponent. */
static nh_residue power_of(nh_prime field, const nh_residue *v, const uint8_t *exponent, size_t n)
{
    nh_residue r = 1;
    for (size_t k = 0; k < n; k++) r = nh_residue_mul(field, r, nh_residue_power(field, v[k], exponent[k]));
    return r;
}

nh_count_functionals nh_count_functionals_create(const nh_jet_ring *ring, size_t n, size_t count, uint64_t seed)
{
    size_t orders = ring->order + 1;
    nh_count_functionals f = {.count = count, .n = n, .size = ring->size, .order = ring->order};
    f.w = nh_alloc_array(count * n + 1, sizeof *f.w);
    f.curve = nh_alloc_array(count * ring->size + 1, sizeof *f.curve);
    f.weight = nh_alloc_array(count * orders + 1, sizeof *f.weight);
    for (size_t i = 0; i < count * n; i++) f.w[i] = nh_residue_random(ring->field, &seed);
    for (size_t i = 0; i < count * orders; i++) f.weight[i] = nh_residue_random(ring->field, &seed);
    for (size_t j = 0; j < count; j++) nh_count_curve(ring, &seed, f.curve + j * ring->size);
    return f;
}

void nh_count_functionals_clear(nh_count_functionals *f)
{
    nh_free(f->weight);
    nh_free(f->curve);
    nh_free(f->w);
}

static nh_residue dot(nh_prime field, size_t n, const nh_residue *a, const nh_residue *b)
{
    uint64_t sum = 0;
    for (size_t i = 0; i < n; i++) sum = nh_residue_gather(field, sum, a[i], b[i]);
    return nh_residue_reduce(field, sum);
}

/* The functional sum_e weight_e of all products along a line, at one choice of velocities.  That of f phi_k is the one
 * with the weights sum_e weight_e phi_k,e-i of f: the series of most products, which are no factors, are not made. */
static void values_along(const nh_jet_ring *line, const nh_count_monomials *p, size_t known, const nh_residue *phi,
                         const nh_residue *weight, nh_residue *product, size_t stride, nh_residue *out)
{
    size_t n = line->size;
    nh_residue *times = nh_alloc_array(known * n + 1, sizeof *times);
    for (size_t k = 0; k < known; k++)
        for (size_t i = 0; i < n; i++) times[k * n + i] = dot(line->field, n - i, weight + i, phi + k * n);
    nh_jet_constant(line, 1, product);
    out[0] = weight[0];
    for (size_t i = 1; i < p->count; i++) {
        const nh_residue *before = product + p->before[i] * n;
        out[i * stride] = dot(line->field, n, before, times + p->factor[i] * n);
        if (p->is_factor[i]) nh_jet_mul(line, before, phi + p->factor[i] * n, product + i * n);
    }
    nh_free(times);
}

bool nh_count_product_values(nh_counter *c, const nh_jet_ring *ring, const nh_residue *coordinate,
                             const nh_count_monomials *p, const nh_count_functionals *f, nh_residue *out)
{
    nh_jet_equations *x = c->equations;
    size_t one = 1, all = x->coordinates;
    nh_jet_ring *line = nh_jet_ring_create(ring->field, 1, &one, ring->order);
    nh_residue *phi = nh_alloc_array(c->known * line->size + 1, sizeof *phi),
               *product = nh_alloc_array(p->count * line->size, sizeof *product),
               *q = nh_alloc_array(all * line->size + 1, sizeof *q);
    bool good = true;
    for (size_t j = 0; j < f->count && good && !nh_late(); j++) {
        nh_count_along(ring, line, f->curve + j * f->size, all, coordinate, q);
        nh_jet_eval *v = nh_jet_equations_eval(x, line, q);
        nh_jet_equations_velocities(x, v, line, f->w + j * f->n);
        good = c->known == 0 || nh_jet_eval_all(v, c->known, c->current, phi);
        if (good) values_along(line, p, c->known, phi, f->weight + j * line->size, product, f->count, out + j);
        c->work += (double)p->count * (double)line->pairs[line->size] + (double)all * (double)ring->size;
        nh_jet_eval_free(v);
    }
    nh_free(q);
    nh_free(product);
    nh_free(phi);
    nh_jet_ring_free(line);
    return good;
}

/* sum over alpha of c_alpha w^alpha, with the first coefficients of the series only. */
void nh_count_solution_values(const nh_graded_count *g, const nh_jet_ring *ring, const nh_count_functionals *f,
                              nh_residue *out)
{
    size_t N = g->total[g->order];
    memset(out, 0, N * f->count * sizeof *out);
    for (size_t j = 0; j < f->count; j++)
        for (size_t a = 0; a < g->alphas; a++) {
            nh_residue power = power_of(ring->field, f->w + j * f->n, g->alpha + a * f->n, f->n);
            for (size_t e = 0; e < f->size; e++) {
                nh_residue factor = nh_residue_mul(ring->field, power,
                                                   nh_residue_mul(ring->field, f->curve[j * f->size + e],
                                                                  f->weight[j * (f->order + 1) + ring->degree[e]]));
                const nh_residue *c = g->series + (a * ring->size + e) * N;
                for (size_t s = 0; s < N; s++)
                    out[s * f->count + j] =
                        nh_residue_add(ring->field, out[s * f->count + j], nh_residue_mul(ring->field, factor, c[s]));
            }
        }
}

/* ---- how many are independent ---- */

/* Is a single current of this degree among the factors? */
static bool has_own_degree(const nh_counter *c, const uint8_t *exponent, size_t degree)
{
    bool own = false;
    for (size_t k = 0; k < c->known; k++) own |= exponent[k] && c->degree[k] == degree;
    return own;
}

/* The rank of the rows of all products, or of those of currents of lower degree. */
static size_t rank_of(const nh_counter *c, nh_prime field, const nh_count_monomials *p, size_t columns,
                      const nh_residue *value, size_t degree, bool lower)
{
    nh_residue *rows = nh_alloc_array(p->count * columns, sizeof *rows);
    size_t kept = 0;
    for (size_t i = 0; i < p->count; i++) {
        if (lower && has_own_degree(c, p->exponent + i * c->known, degree)) continue;
        memcpy(rows + kept++ * columns, value + i * columns, columns * sizeof *rows);
    }
    size_t rank = nh_residue_matrix_rank(field, kept, columns, rows);
    nh_free(rows);
    return rank;
}

/* The rank of the products modulo the prime: they are solutions to this order, of which there are `bound` independent
   ones. */
bool nh_count_products(nh_counter *c, const nh_jet_ring *ring, const nh_residue *coordinate, size_t degree,
                       size_t bound, nh_count_row *out)
{
    nh_count_monomials p = nh_count_monomials_list(c, degree);
    out->known = out->lower = 1;
    if (!p.count || !c->known) {
        nh_count_monomials_clear(&p);
        return true;
    }
    nh_count_functionals f = nh_count_functionals_create(
        ring, c->equations->n, (p.count < bound ? p.count : bound) + spare_columns, 1234567 + degree);
    nh_residue *value = nh_alloc_array(p.count * f.count, sizeof *value);
    bool good = nh_count_product_values(c, ring, coordinate, &p, &f, value);
    out->known = rank_of(c, ring->field, &p, f.count, value, degree, false);
    bool own = false;
    for (size_t k = 0; k < c->known; k++) own |= c->degree[k] == degree;
    out->lower = own ? rank_of(c, ring->field, &p, f.count, value, degree, true) : out->known;
    nh_free(value);
    nh_count_functionals_clear(&f);
    nh_count_monomials_clear(&p);
    return good;
}

/* ---- a growing subspace ---- */

bool nh_count_space_add(nh_count_space *x, nh_prime field, const nh_residue *row)
{
    nh_grow(&x->row, &x->capacity, (x->rows + 1) * x->width + 1, sizeof *x->row);
    nh_residue *own = x->row + x->rows * x->width;
    memcpy(own, row, x->width * sizeof *own);
    for (size_t i = 0; i < x->rows; i++) {
        const nh_residue *other = x->row + i * x->width;
        size_t at = 0;
        while (!other[at]) at++; /* the entry there is 1 */
        if (own[at]) nh_residue_add_multiple(field, x->width, own, other, nh_residue_sub(field, 0, own[at]));
    }
    size_t at = 0;
    while (at < x->width && !own[at]) at++;
    if (at == x->width) return false;
    nh_residue scale = nh_residue_inverse(field, own[at]);
    nh_residue_scale(field, x->width - at, own + at, scale);
    x->rows++;
    return true;
}

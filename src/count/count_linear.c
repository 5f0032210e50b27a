/* The number of integrals of linear equations of motion, from their frequencies: for any number of coordinates, where
 * series have too many terms.
 *
 *     M q'' = K q + b,   M and K constant and symmetric,   (K - sigma_i^2 M) u_i = 0
 *
 * The coefficients of an integral of degree d are polynomials in q (the leading ones solve Killing's equation of flat
 * space, the others inherit it), of degree 2 d at most together with the velocities.  With z_i, y_i = u_i.M (q' -+
 * sigma_i q), whose rates are +-sigma_i, a polynomial is conserved if all its monomials have the rate 0.  Where no sum
 * of 2 d numbers +-sigma_i vanishes but those that cancel, these are the polynomials in E_i = z_i y_i, whose leading
 * terms (u_i.M q')^2 are independent: of degree d/2 at most.  With t in the coefficients all their monomials are of
 * one rate; two of these with the same leading term would differ by such a sum: so they have the degree d at most, and
 * the integrals are the polynomials of degree d in exp(-+sigma_i t) (z_i, y_i).  [docs/method.md, sec. 10] */
#include "count/count_internal.h"

#include <flint/nmod_mat.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/progress.h"
#include "exact/ball_matrix.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"

typedef struct {
    nh_counter *c;
    size_t n;
    nh_ex *K;                 /* n x n, row by row */
    double *frequency, error; /* values of a linear function at sigma_i, and their error */
    double work;              /* products */
} linear;

/* ---- the equations ---- */

/* Does e depend on parameters only? */
static bool is_constant(const nh_jet_equations *x, nh_ex e)
{
    bool is = !nh_depends(x->dag, e, x->model->system->t);
    for (size_t i = 0; i < x->m && is; i++)
        is = !nh_depends(x->dag, e, x->coordinate[x->time + i]) && !nh_depends(x->dag, e, x->w[i]);
    return is;
}

static bool is_symmetric(size_t n, const nh_ex *e)
{
    bool is = true;
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < i; j++) is &= e[i * n + j] == e[j * n + i];
    return is;
}

/* Are the equations M w' = A with constant symmetric M and K, A = K q and terms without q and w? Reads K = dA/dq, n x
 * n. */
static bool read_equations(linear *l)
{
    enum { largest_entry = 1000 };
    const nh_jet_equations *x = l->c->equations;
    size_t n = x->n;
    bool is = x->m == n;
    for (size_t i = 0; i < n && is; i++) is = x->rho[i] == x->w[i] && !nh_depends(x->dag, x->A[i], x->model->system->t);
    for (size_t i = 0; i < n * n && is; i++) is = is_constant(x, x->M[i]);
    for (size_t i = 0; i < n && is; i++)
        for (size_t j = 0; j < n && is; j++) {
            nh_ex q = x->coordinate[x->time + j];
            is = !nh_depends(x->dag, x->A[i], x->w[j]);
            bool has = nh_depends(x->dag, x->A[i], q);
            l->K[i * n + j] =
                has ? nh_canonical(x->dag, nh_diff(x->dag, x->A[i], q), largest_entry) : nh_int(x->dag, 0);
            is = is && is_constant(x, l->K[i * n + j]);
        }
    return is && is_symmetric(n, x->M) && is_symmetric(n, l->K);
}

/* ---- sums of frequencies ---- */

/* sigma_i as balls; a generic linear function of the complex number makes it a real one, so that sums can be sorted. */
static bool read_frequencies(linear *l)
{
    enum { bits = 256, products = 500 };
    static const double slope = 0.6180339887498949; /* a generic line of the complex plane */
    const nh_jet_equations *x = l->c->equations;
    const nh_model *model = x->model;
    double *re = nh_alloc_array(2 * l->n + 1, sizeof *re), *im = re + l->n;
    nh_ball *ball = nh_ball_create(x->dag, bits);
    for (size_t k = 0; k < model->system->parameters; k++)
        nh_ball_set_double(ball, model->parameter[k], model->parameter_value[k]);
    bool good = nh_ball_eigenvalue_roots(ball, l->n, x->M, l->K, re, im, &l->error);
    for (size_t i = 0; i < l->n && good; i++) l->frequency[i] = im[i] + slope * re[i];
    l->error *= 4;
    l->work += products * pow((double)l->n, 3);
    nh_ball_free(ball);
    nh_free(re);
    return good;
}

/* The sums of at most `left` further frequencies of index i and above, of either sign: returns their number, and writes
 * them into out unless that is NULL. */
static size_t list_sums(const linear *l, size_t i, size_t left, double sum, size_t most, double *out)
{
    size_t count = 1;
    if (out) out[0] = sum;
    for (; i < l->n && left && count < most; i++)
        for (size_t k = 1; k <= left; k++)
            for (int sign = -1; sign <= 1; sign += 2)
                count += list_sums(l, i + 1, left - k, sum + (double)sign * (double)k * l->frequency[i], most - count,
                                   out ? out + count : NULL);
    return count;
}

static int by_size(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

typedef enum { NONE, PERHAPS, TOO_MANY } resonance;

/* Does a sum of 2 `half` frequencies, of either sign, vanish without cancelling in pairs?  Not where no two sums of
 * `half` frequencies are equal. */
static resonance find_resonance(linear *l, size_t half)
{
    enum { most_sums = 2000000, each = 30 };
    size_t count = list_sums(l, 0, half, 0, most_sums, NULL);
    if (count >= most_sums || l->work + each * (double)count > l->c->q->work || nh_late()) return TOO_MANY;
    double *sum = nh_alloc_array(count + 1, sizeof *sum), largest = 0, apart = HUGE_VAL;
    list_sums(l, 0, half, 0, most_sums, sum);
    l->work += each * (double)count;
    for (size_t i = 0; i < l->n; i++) largest = fmax(largest, fabs(l->frequency[i]));
    double error = (double)half * (l->error + (double)(half + 1) * ldexp(largest, -50));
    qsort(sum, count, sizeof *sum, by_size);
    for (size_t i = 1; i < count; i++) apart = fmin(apart, sum[i] - sum[i - 1]);
    nh_free(sum);
    return apart > 2 * error ? NONE : PERHAPS;
}

/* ---- ranks ---- */

/* The values of n x n expressions at the point. */
static void set_matrix(const nh_jet_equations *x, nh_jet_eval *v, const nh_jet_ring *ring, const nh_ex *e,
                       nh_residue *series, nmod_mat_t out, bool *good)
{
    *good = *good && nh_jet_eval_all(v, x->n * x->n, e, series);
    for (size_t i = 0; i < x->n * x->n && *good; i++) nmod_mat_entry(out, i / x->n, i % x->n) = series[i * ring->size];
}

/* dE = (-K A^k q, M A^k q') for k = 0 .. n - 1 with A = M^-1 K, along the coordinates of the frame; z = (q, q'), q
   from the equilibrium. */
static void put_energies(const linear *l, const nh_count_series *s, nmod_mat_t M, nmod_mat_t K, nmod_mat_t A,
                         nmod_mat_t z, nh_differentials *out)
{
    const nh_jet_equations *x = l->c->equations;
    size_t n = l->n, width = out->kept + n, size = s->ring->size;
    nh_prime f = s->ring->field;
    nmod_mat_t image;
    nmod_mat_init(image, (slong)n, 2, f.p);
    nh_residue *row = nh_count_more_differentials(out, n);
    for (size_t k = 0; k < n; k++, row += width) {
        nmod_mat_mul(image, K, z);
        for (size_t j = 0; j < out->kept; j++)
            for (size_t i = 0; i < n; i++)
                row[j] = nh_residue_sub(f, row[j],
                                        nh_residue_mul(f, (nh_residue)nmod_mat_entry(image, i, 0),
                                                       s->coordinate[(x->time + i) * size + s->ring->up[j * size]]));
        nmod_mat_mul(image, M, z);
        for (size_t i = 0; i < n; i++) row[out->kept + i] = (nh_residue)nmod_mat_entry(image, i, 1);
        nmod_mat_mul(image, A, z);
        nmod_mat_swap(image, z);
    }
    nmod_mat_clear(image);
}

/* (K^-1 (K q + b), w) */
static bool from_equilibrium(const linear *l, const nh_count_series *s, nh_jet_eval *v, const nmod_mat_t K,
                             const nh_residue *w, nh_residue *series, nmod_mat_t z)
{
    const nh_jet_equations *x = l->c->equations;
    size_t n = l->n;
    nmod_mat_t force, place;
    nmod_mat_init(force, (slong)n, 1, s->ring->field.p);
    nmod_mat_init(place, (slong)n, 1, s->ring->field.p);
    bool good = nh_jet_eval_all(v, n, x->A, series);
    for (size_t i = 0; i < n && good; i++) nmod_mat_entry(force, i, 0) = series[i * s->ring->size];
    good = good && nmod_mat_solve(place, K, force);
    for (size_t i = 0; i < n && good; i++) {
        nmod_mat_entry(z, i, 0) = nmod_mat_entry(place, i, 0);
        nmod_mat_entry(z, i, 1) = w[i];
    }
    nmod_mat_clear(place);
    nmod_mat_clear(force);
    return good;
}

/* False: another point is needed. */
static bool add_energies(const linear *l, const nh_count_series *s, const nh_residue *w, nh_differentials *out)
{
    nh_jet_equations *x = l->c->equations;
    size_t n = l->n;
    nmod_mat_t M, K, A, z;
    nmod_mat_init(z, (slong)n, 2, s->ring->field.p);
    nmod_mat_init(M, (slong)n, (slong)n, s->ring->field.p);
    nmod_mat_init(K, (slong)n, (slong)n, s->ring->field.p);
    nmod_mat_init(A, (slong)n, (slong)n, s->ring->field.p);
    nh_residue *series = nh_alloc_array(n * n * s->ring->size + 1, sizeof *series);
    nh_jet_eval *v = nh_jet_equations_eval(x, s->ring, s->coordinate);
    bool good = true;
    set_matrix(x, v, s->ring, x->M, series, M, &good);
    set_matrix(x, v, s->ring, l->K, series, K, &good);
    good = good && nmod_mat_solve(A, M, K) && from_equilibrium(l, s, v, K, w, series, z);
    if (good) put_energies(l, s, M, K, A, z, out);
    nh_jet_eval_free(v);
    nh_free(series);
    nmod_mat_clear(A);
    nmod_mat_clear(K);
    nmod_mat_clear(M);
    nmod_mat_clear(z);
    return good;
}

/* The rank of the known integrals of degree 1 ..  `degree`. */
static size_t rank_of_degree(const nh_counter *c, const nh_differentials *known, size_t degree)
{
    nh_differentials some = {.n = known->n, .kept = known->kept};
    size_t width = known->kept + known->n;
    for (size_t k = 0; k < c->known; k++)
        if (c->degree[k] && c->degree[k] <= degree)
            memcpy(nh_count_more_differentials(&some, 1), known->row + k * width, width * sizeof *some.row);
    size_t rank = nh_count_rank(&some, c->equations->point->field);
    nh_free(some.row);
    return rank;
}

typedef struct {
    size_t all, known, generators, of; /* ranks of all; of the known ones, those of the degree `of` that generate all */
} ranks;

/* The ranks of the differentials of all energies with the known integrals, and of the known ones alone, at a random
 * point. */
static bool find_ranks(linear *l, ranks *out)
{
    nh_counter *c = l->c;
    bool regular;
    nh_count_series *s = nh_count_series_create(c, 1, INFINITY, &regular);
    if (!s) return false;
    nh_differentials all, known;
    nh_count_differentials(c, &all, &known);
    bool good = nh_count_known_differ(c, s->ring, s->coordinate, &known) && add_energies(l, s, all.w, &all);
    nh_count_differentials_append(&all, &known);
    nh_prime f = s->ring->field;
    bool time = c->equations->time;
    out->of = time ? 1 : 2;
    if (good) {
        out->all = time ? 2 * l->n : nh_count_rank(&all, f);
        out->known = nh_count_rank(&known, f);
        out->generators = rank_of_degree(c, &known, out->of);
    }
    nh_count_differentials_clear(&all, &known);
    nh_count_series_free(s);
    return good;
}

/* ---- the rows ---- */

/* The number of monomials of degree at most d in n variables: (n + d)!/(n! d!). */
static size_t monomials(size_t n, size_t d)
{
    double count = 1;
    for (size_t k = 1; k <= d; k++) count = count * (double)(n + k) / (double)k;
    return (size_t)(count + 0.5);
}

static nh_count_row row_of(const linear *l, const ranks *r, size_t degree)
{
    size_t letters = (r->of == 1 ? 2 : 1) * l->n, d = degree / r->of;
    bool none = degree < r->of;
    nh_count_row row = {.degree = degree,
                        .bound = monomials(letters, d),
                        .known = monomials(r->generators, d),
                        .rank = none ? r->known : r->all,
                        .known_rank = r->known,
                        .bounded = true,
                        .settled = true};
    row.lower = degree == r->of ? 1 : row.bound;
    row.complete = row.bound == row.known;
    row.functions = row.rank == row.known_rank;
    return row;
}

void nh_count_linear(nh_counter *c, size_t last, nh_count *out)
{
    linear l = {.c = c, .n = c->equations->n};
    ranks r = {0};
    l.K = nh_alloc_array(l.n * l.n + 1, sizeof *l.K);
    l.frequency = nh_alloc_array(l.n + 1, sizeof *l.frequency);
    bool good = read_equations(&l) && read_frequencies(&l) && find_ranks(&l, &r);
    while (good && out->rows < last) {
        good = find_resonance(&l, out->rows + 1) == NONE;
        if (!good) break;
        out->row[out->rows] = row_of(&l, &r, out->rows + 1);
        if (!out->linear) out->linear = out->rows + 1;
        out->rows++;
    }
    c->work += l.work;
    if (out->rows == last) out->end = NULL;
    nh_free(l.frequency);
    nh_free(l.K);
}

/* Solutions of the equations on a box, and what they are. */
#include "integrals/box_series_internal.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/budget.h"
#include "base/linalg.h"
#include "base/memory.h"
#include "graph/dag.h"
#include "integrals/function_series.h"
#include "system/sample.h"

/* ---- the linear problem ---- */

/* Number of products of r polynomials T_k up to this total degree: binomial(degree + r, r). */
static size_t terms_of(size_t r, size_t degree)
{
    size_t n = 1;
    for (size_t j = 1; j <= r; j++) n = n * (degree + j) / j;
    return n;
}

size_t nh_box_series_degree(const nh_box_series *x, size_t most_columns)
{
    enum { highest = 40 };
    size_t degree = 0;
    while (degree < highest && x->words * terms_of(x->equations.variables, degree + 1) <= most_columns) degree++;
    return degree;
}

static unsigned char *list_terms(size_t r, size_t degree, nh_arena *arena)
{
    unsigned char *out = nh_arena_alloc(arena, terms_of(r, degree) * r), k[NH_BOX_VARIABLES] = {0};
    size_t count = 0;
    for (bool more = true; more;) {
        memcpy(out + count++ * r, k, r);
        size_t j = r;
        while (j-- > 0) {
            if (nh_box_order(r, k) < degree) break;
            k[j] = 0;
        }
        more = j < r;
        if (more) k[j]++;
    }
    return out;
}

/* Computes T_k(u) and T_k'(u) for k up to degree. */
static void chebyshev(double u, size_t degree, double *T, double *D)
{
    T[0] = 1;
    D[0] = 0;
    for (size_t k = 1; k <= degree; k++) {
        T[k] = k == 1 ? u : 2 * u * T[k - 1] - T[k - 2];
        D[k] = k == 1 ? 1 : 2 * T[k - 1] + 2 * u * D[k - 1] - D[k - 2];
    }
}

/* The unknowns are the coefficients times this weight, which is about the size of the derivatives: then rounding
 * affects the rates by equal parts. */
static double weight(const nh_box_functions *f, size_t r, size_t term)
{
    double degree = (double)nh_box_order(r, f->index + term * r);
    return 1 + degree * degree;
}

/* Writes the equations at one place, one row each: rows x (words x terms), column-major with `ld`. */
static void put_rows(const nh_box_series *x, const nh_box_functions *f, const double *place, const double *coefficient,
                     double *row, size_t ld)
{
    const nh_box_equations *e = &x->equations;
    size_t r = e->variables;
    double T[NH_BOX_VARIABLES][64], D[NH_BOX_VARIABLES][64], basis[1 + NH_BOX_VARIABLES];
    for (size_t j = 0; j < r; j++) chebyshev(place[j], f->degree, T[j], D[j]);
    for (size_t i = 0; i < f->terms; i++) {
        for (size_t v = 0; v <= r; v++) {
            basis[v] = 1;
            for (size_t j = 0; j < r; j++) {
                size_t k = f->index[i * r + j];
                basis[v] *= v == j + 1 ? D[j][k] * 2 / (f->high[j] - f->low[j]) : T[j][k];
            }
        }
        for (size_t b = 0; b < e->equations; b++)
            for (size_t a = 0; a < e->functions; a++) {
                const double *c = coefficient + b * e->functions + a;
                const double *A = coefficient + e->equations * e->functions + (b * e->functions + a) * r;
                double sum = *c * basis[0];
                for (size_t j = 0; j < r; j++) sum += A[j] * basis[1 + j];
                row[b + (a * f->terms + i) * ld] = sum / weight(f, r, i);
            }
    }
}

/* Computes the triangle of the equations at enough places; false where they have no values everywhere. */
static bool collocate(const nh_box_series *x, const nh_box_functions *f, double *triangle)
{
    enum { extra = 10 };
    static const double oversampling = 1.6;
    const nh_model *o = x->model;
    const nh_box_equations *e = &x->equations;
    size_t r = e->variables, n = e->equations * e->functions, all = n * (1 + r), columns = e->functions * f->terms;
    size_t places = (size_t)(oversampling * (double)f->terms) + extra;
    while (places * e->equations < columns * 3 / 2) places++;
    nh_ex *out = nh_alloc_array(all, sizeof *out);
    memcpy(out, e->plain, n * sizeof *out);
    memcpy(out + n, e->along, n * r * sizeof *out);
    nh_tape *tape = nh_tape_create(o->dag, r, e->variable, all, out, 0, NULL, NULL);
    nh_tape_work *work = nh_tape_work_create(tape);
    nh_sampler *sampler = nh_sampler_create(r, (const double[]){0, 0, 0}, (const double[]){1, 1, 1}, 1);
    nh_qr *qr = nh_qr_create(columns, 1);
    double *value = nh_alloc_array(all, sizeof *value), *row = nh_alloc_array(e->equations * columns, sizeof *row);
    bool fine = true;
    for (size_t p = 0; p < places && fine; p++) {
        double u[NH_BOX_VARIABLES], s[NH_BOX_VARIABLES];
        nh_sampler_next(sampler, u);
        for (size_t j = 0; j < r; j++) {
            u[j] = -cos(M_PI * u[j]); /* denser at the edges, as Chebyshev nodes are */
            s[j] = (f->low[j] + f->high[j]) / 2 + u[j] * (f->high[j] - f->low[j]) / 2;
        }
        nh_tape_eval(tape, work, s, value);
        fine = nh_all_finite(all, value);
        if (!fine) break;
        put_rows(x, f, u, value, row, e->equations);
        nh_qr_add(qr, e->equations, row, e->equations);
    }
    if (fine &&
        nh_box_order(o->n, x->exponent + (x->words - 1) * o->n) == 0) { /* excludes the current 1 from the solutions */
        memset(row, 0, columns * sizeof *row);
        row[(x->words - 1) * f->terms] = 1;
        nh_qr_add(qr, 1, row, 1);
    }
    if (fine) nh_qr_triangle(qr, triangle);
    nh_free(row);
    nh_free(value);
    nh_qr_free(qr);
    nh_sampler_free(sampler);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    nh_free(out);
    return fine;
}

/* Number of singular values (descending) that are rounding errors, if they are far below the others; else 0. */
static size_t nullity(size_t n, const double *s)
{
    static const double rounding = 3e-14, apart = 300;
    size_t count = 0;
    while (count < n && s[n - 1 - count] <= rounding * s[0]) count++;
    if (count == 0 || count == n) return 0;
    return s[n - 1 - count] >= apart * fmax(s[n - count], DBL_EPSILON * s[0]) ? count : 0;
}

/* ---- one basis of the space ---- */

/* The derivative of this order of T_k at 0: the coefficients of T_k, k even or odd with the order, by
 * (1 - u^2) T'' - u T' + k^2 T = 0, so T^(p+2)(0) = (p^2 - k^2) T^(p)(0). */
static double at_centre(size_t k, size_t order)
{
    if ((k + order) % 2) return 0;
    double value = k % 2 ? (double)k * (k / 2 % 2 ? -1 : 1) : k / 2 % 2 ? -1 : 1;
    for (double p = (double)(k % 2); p + 2 <= (double)order; p += 2) value *= p * p - (double)(k * k);
    return value;
}

/* The values of f_alpha at the centre, then its derivatives along the variables, then the second ones, in units of the
 * box: columns. */
static size_t jets(const nh_box_series *x, const nh_box_functions *f, double *out, size_t most)
{
    size_t r = x->equations.variables, words = x->words, columns = 0;
    for (size_t order = 0; order <= x->degree + 2; order++)
        for (size_t a = 0; a < words; a++) {
            unsigned char *mu = nh_alloc_array(terms_of(r, order) * r + 1, 1), *at = mu;
            size_t count = nh_box_exponents(r, order, order + 1, mu);
            for (size_t z = 0; z < count && columns < most; z++, at += r, columns++)
                for (size_t k = 0; k < f->count; k++) {
                    const double *c = f->coefficient + (k * words + a) * f->terms;
                    double sum = 0;
                    for (size_t i = 0; i < f->terms; i++) {
                        double factor = c[i];
                        for (size_t j = 0; j < r && factor != 0; j++) factor *= at_centre(f->index[i * r + j], at[j]);
                        sum += factor;
                    }
                    out[k + columns * f->count] = sum;
                }
            nh_free(mu);
        }
    return columns;
}

static void scale_row(nh_box_functions *f, size_t n, double *c, double *jet, size_t columns, size_t k, double factor)
{
    for (size_t i = 0; i < n; i++) c[k * n + i] *= factor;
    for (size_t j = 0; j < columns; j++) jet[k + j * f->count] *= factor;
}

static void subtract_row(nh_box_functions *f, size_t n, double *c, double *jet, size_t columns, size_t k, size_t from,
                         double factor)
{
    for (size_t i = 0; i < n; i++) c[k * n + i] -= factor * c[from * n + i];
    for (size_t j = 0; j < columns; j++) jet[k + j * f->count] -= factor * jet[from + j * f->count];
}

static void swap_rows(nh_box_functions *f, size_t n, double *c, double *jet, size_t columns, size_t k, size_t l)
{
    for (size_t i = 0; i < n && k != l; i++) {
        double t = c[k * n + i];
        c[k * n + i] = c[l * n + i];
        c[l * n + i] = t;
    }
    for (size_t j = 0; j < columns && k != l; j++) {
        double t = jet[k + j * f->count];
        jet[k + j * f->count] = jet[l + j * f->count];
        jet[l + j * f->count] = t;
    }
}

/* Reduced echelon form by the jets at the centre. */
static void normalise(const nh_box_series *x, nh_box_functions *f, double *c)
{
    enum { most_jets = 400 };
    static const double pivot = 1e-6;
    size_t n = x->words * f->terms, done = 0;
    double *jet = nh_alloc_array(f->count * most_jets, sizeof *jet);
    size_t columns = jets(x, f, jet, most_jets);
    for (size_t j = 0; j < columns && done < f->count; j++) {
        size_t best = done;
        for (size_t k = done; k < f->count; k++)
            if (fabs(jet[k + j * f->count]) > fabs(jet[best + j * f->count])) best = k;
        if (fabs(jet[best + j * f->count]) < pivot) continue;
        swap_rows(f, n, c, jet, columns, done, best);
        scale_row(f, n, c, jet, columns, done, 1 / jet[done + j * f->count]);
        for (size_t k = 0; k < f->count; k++)
            if (k != done) subtract_row(f, n, c, jet, columns, k, done, jet[k + j * f->count]);
        done++;
    }
    nh_free(jet);
}

/* Removes coefficients below rounding, and functions that are as small as the errors of the others. */
static void trim(const nh_box_series *x, const nh_box_functions *f, double *c)
{
    static const double nothing = 1e-13;
    size_t n = x->words * f->terms;
    for (size_t k = 0; k < f->count; k++) {
        double largest = 0;
        for (size_t i = 0; i < n; i++) largest = fmax(largest, fabs(c[k * n + i]));
        for (size_t i = 0; i < n; i++)
            if (fabs(c[k * n + i]) < DBL_EPSILON / 2 * largest) c[k * n + i] = 0;
        for (size_t a = 0; a < x->words; a++) {
            double *word = c + k * n + a * f->terms, most = 0;
            for (size_t i = 0; i < f->terms; i++) most = fmax(most, fabs(word[i]));
            if (most < nothing * largest) memset(word, 0, f->terms * sizeof *word);
        }
    }
}

/* The degree above which all coefficients are rounding errors. */
static size_t enough(const nh_box_series *x, const nh_box_functions *f)
{
    static const double rounding = 1e-14;
    size_t n = x->words * f->terms, degree = 0, r = x->equations.variables;
    for (size_t k = 0; k < f->count; k++) {
        double largest = 0;
        for (size_t i = 0; i < n; i++) largest = fmax(largest, fabs(f->coefficient[k * n + i]));
        for (size_t i = 0; i < n; i++) {
            size_t total = nh_box_order(r, f->index + i % f->terms * r);
            if (total > degree && fabs(f->coefficient[k * n + i]) > rounding * largest) degree = total;
        }
    }
    return degree;
}

static nh_box_functions solve(const nh_box_series *x, const double *low, const double *high, size_t degree,
                              nh_arena *arena)
{
    size_t r = x->equations.variables;
    nh_box_functions f = {.degree = degree, .terms = terms_of(r, degree), .index = list_terms(r, degree, arena)};
    size_t n = x->words * f.terms;
    memcpy(f.low, low, r * sizeof *low);
    memcpy(f.high, high, r * sizeof *high);
    double *triangle = nh_alloc_array(n * n, sizeof *triangle), *s = nh_alloc_array(n, sizeof *s),
           *vt = nh_alloc_array(n * n, sizeof *vt);
    nh_work_add(NH_WORK_DENSE, 12.0 * (double)n * (double)n * (double)n);
    if (collocate(x, &f, triangle) && nh_svd(n, n, triangle, s, NULL, vt)) f.count = nullity(n, s);
    double *c = nh_arena_alloc(arena, (f.count * n + 1) * sizeof *c);
    for (size_t k = 0; k < f.count; k++)
        for (size_t i = 0; i < n; i++) c[k * n + i] = vt[n - 1 - k + i * n] / weight(&f, r, i % f.terms);
    f.coefficient = c;
    if (f.count) normalise(x, &f, c);
    trim(x, &f, c);
    nh_free(vt);
    nh_free(s);
    nh_free(triangle);
    return f;
}

nh_box_functions nh_box_series_solve(const nh_box_series *x, const double *low, const double *high, size_t degree,
                                     nh_arena *arena)
{
    enum { spare = 3 };
    nh_box_functions f = solve(x, low, high, degree, arena);
    size_t less = f.count ? enough(x, &f) + spare : degree;
    if (less >= degree) return f;
    nh_box_functions shorter = solve(x, low, high, less, arena); /* fewer unknowns have smaller rounding errors */
    return shorter.count == f.count ? shorter : f;
}

/* ---- what it is ---- */

nh_points *nh_box_series_points(const nh_box_series *x, const nh_box_functions *f, size_t count, uint64_t seed)
{
    const nh_model *o = x->model;
    nh_chart chart = *o->chart;
    nh_model thin = *o;
    nh_error ignored;
    nh_error_clear(&ignored);
    thin.chart = &chart;
    chart.low = nh_alloc_array(o->width, sizeof *chart.low);
    chart.high = nh_alloc_array(o->width, sizeof *chart.high);
    memcpy(chart.low, o->chart->low, o->width * sizeof *chart.low);
    memcpy(chart.high, o->chart->high, o->width * sizeof *chart.high);
    for (size_t j = 0; j < x->equations.variables; j++)
        for (size_t s = 0; s < o->width; s++)
            if (chart.symbol[s] == x->equations.variable[j]) {
                chart.low[s] = f->low[j];
                chart.high[s] = f->high[j];
            }
    nh_points *points = nh_points_create(&thin, count, 1, seed, &ignored);
    nh_free(chart.high);
    nh_free(chart.low);
    return points;
}

size_t nh_box_series_alone(const nh_box_series *x, const nh_box_functions *f, size_t k)
{
    static const double nothing = 1e-11;
    size_t ones = 0, others = 0, which = x->words, r = x->equations.variables;
    for (size_t a = 0; a < x->words; a++) {
        double value = 0;
        for (size_t i = 0; i < f->terms; i++) {
            double term = f->coefficient[(k * x->words + a) * f->terms + i];
            for (size_t j = 0; j < r && term != 0; j++) term *= at_centre(f->index[i * r + j], 0);
            value += term;
        }
        bool one = fabs(value - 1) < nothing;
        ones += one;
        others += !one && fabs(value) > nothing;
        if (one) which = a;
    }
    return ones == 1 && !others ? which : x->words;
}

/* ---- expressions ---- */

/* The sum over the terms whose first `at` indices are these, as polynomials in the rest. */
static nh_ex nested(const nh_box_series *x, const nh_box_functions *f, const double *c, nh_ex *const *T, size_t at,
                    unsigned char *k)
{
    nh_dag *d = x->model->dag;
    size_t r = x->equations.variables;
    nh_ex sum = nh_int(d, 0);
    if (at == r) {
        for (size_t i = 0; i < f->terms; i++)
            if (!memcmp(f->index + i * r, k, r) && c[i] != 0) sum = nh_real(d, c[i]);
        return sum;
    }
    for (size_t z = 0; z + nh_box_order(at, k) <= f->degree; z++) {
        k[at] = (unsigned char)z;
        sum = nh_add(d, sum, nh_mul(d, T[at][z], nested(x, f, c, T, at + 1, k)));
    }
    k[at] = 0;
    return sum;
}

nh_ex nh_box_series_expression(const nh_box_series *x, const nh_box_functions *f, size_t k)
{
    nh_dag *d = x->model->dag;
    size_t r = x->equations.variables;
    nh_ex *T[NH_BOX_VARIABLES], phi = nh_int(d, 0);
    for (size_t j = 0; j < r; j++) {
        T[j] = nh_alloc_array(f->degree + 1, sizeof *T[j]);
        nh_series_polynomials(d, x->equations.variable[j], f->low[j], f->high[j], f->degree, T[j]);
    }
    for (size_t a = 0; a < x->words; a++) {
        unsigned char index[NH_BOX_VARIABLES] = {0};
        phi = nh_add(d, phi,
                     nh_mul(d, x->word[a], nested(x, f, f->coefficient + (k * x->words + a) * f->terms, T, 0, index)));
    }
    for (size_t j = 0; j < r; j++) nh_free(T[j]);
    return phi;
}

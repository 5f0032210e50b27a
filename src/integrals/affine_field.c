#include "integrals/affine_field.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "base/memory.h"
#include "base/progress.h"
#include "integrals/centre_of_mass.h"
#include "integrals/exact_points.h"
#include "integrals/recognise.h"

enum { spare_points = 4, tries_per_point = 4, most_denominator = 1000 };
static const double small = 1e-10;    /* of a residual, relative to the components */
static const double singular = 1e-12; /* of the basis at the points */

/* M^T zeta = Y(Phi) at a random point, with the values of the words there. */
static bool values_at(const nh_model *o, nh_ball *ball, uint64_t *state, const nh_ex *M, const nh_ex *Y, size_t words,
                      const nh_ex *word, double *work, double *zeta, double *row)
{
    double radius, rcond;
    if (!nh_exact_point(o, ball, state)) return false;
    for (size_t i = 0; i < o->n; i++) {
        if (!nh_ball_value(ball, Y[i], &zeta[i], &radius)) return false;
        for (size_t j = 0; j < o->n; j++)
            if (!nh_ball_value(ball, M[i * o->n + j], &work[j * o->n + i], &radius)) return false;
    }
    for (size_t b = 0; b < words; b++)
        if (!nh_ball_value(ball, word[b], &row[b], &radius)) return false;
    return nh_solve(o->n, work, 1, zeta, &rcond);
}

/* The coefficients of each component, if they are short fractions that fit at all points; `row` is points x width,
 * `value` points x n. */
static bool fit(const nh_model *o, size_t points, size_t width, const nh_ex *basis, const double *row,
                const double *value, nh_ex *zeta)
{
    nh_dag *d = o->dag;
    double *a = nh_alloc_array(points * width, sizeof *a), *b = nh_alloc_array(points * o->n, sizeof *b);
    nh_num *c = nh_alloc_array(width, sizeof *c);
    memcpy(a, row, points * width * sizeof *a);
    memcpy(b, value, points * o->n * sizeof *b);
    bool good = nh_least_squares(points, width, a, o->n, b, points, singular) == (int)width;
    for (size_t i = 0; i < o->n && good; i++) {
        double size = 0, residual = 0;
        for (size_t k = 0; k < width && good; k++) {
            double x = b[i * points + k];
            good =
                fabs(x) < small ? (c[k] = nh_num_int(0), true) : nh_recognise_ratio(x, most_denominator, small, &c[k]);
        }
        for (size_t p = 0; p < points && good; p++) {
            double rest = value[i * points + p];
            size = fmax(size, fabs(rest));
            for (size_t k = 0; k < width; k++) rest -= nh_num_value(c[k]) * row[k * points + p];
            residual = fmax(residual, fabs(rest));
        }
        good = good && residual <= small * fmax(size, 1);
        if (good) zeta[i] = nh_linear(d, width, c, basis);
    }
    nh_free(c);
    nh_free(b);
    nh_free(a);
    return good;
}

/* Values of zeta (points x n) and of the words (points x words), column by column; false where there are too few. */
static bool sample(const nh_model *o, nh_ex phi, const nh_options *options, size_t points, size_t words,
                   const nh_ex *word, double *value, double *row)
{
    size_t found = 0, n = o->n;
    nh_ex *M = nh_alloc_array(n * n + n + words + 1, sizeof *M), *Y = M + n * n, *exact = Y + n;
    double *work = nh_alloc_array(n * n + n + words + 1, sizeof *work), *here = work + n * n, *line = here + n;
    for (size_t i = 0; i < n; i++) Y[i] = nh_exact_values(o, nh_model_Y(o, i, phi));
    for (size_t i = 0; i < n * n; i++) M[i] = nh_exact_values(o, o->M[i]);
    for (size_t b = 0; b < words; b++) exact[b] = nh_exact_values(o, word[b]);
    nh_ball *ball = nh_ball_create(o->dag, (long)options->bits);
    uint64_t state = (uint64_t)options->seed + 78;
    for (size_t tries = 0; tries < tries_per_point * points && found < points && !nh_interrupted(); tries++) {
        if (!values_at(o, ball, &state, M, Y, words, exact, work, here, line)) continue;
        for (size_t i = 0; i < n; i++) value[i * points + found] = here[i];
        for (size_t k = 0; k < words; k++) row[k * points + found] = line[k];
        found++;
    }
    nh_ball_free(ball);
    nh_free(work);
    nh_free(M);
    return found == points;
}

/* 1, t, q, t q, and where centres of mass are: 2 + 3 m at most. */
static size_t affine(const nh_model *o, const nh_options *options, nh_ex *basis)
{
    nh_ex t = o->system->t;
    nh_centre_of_mass *centre = nh_alloc_array(o->m + 1, sizeof *centre);
    size_t n = 0, centres = nh_centre_of_mass_find(o, (size_t)options->proof_terms, centre);
    basis[n++] = nh_int(o->dag, 1);
    basis[n++] = t;
    for (size_t s = 0; s < o->m; s++) {
        basis[n++] = o->system->coordinate[s].q;
        basis[n++] = nh_mul(o->dag, t, o->system->coordinate[s].q);
    }
    for (size_t i = 0; i < centres; i++) basis[n++] = nh_div(o->dag, centre[i].F, centre[i].mass);
    nh_free(centre);
    return n;
}

size_t nh_affine_field_words(const nh_model *o, size_t a, size_t b, nh_ex out[NH_AFFINE_FIELD_WORDS])
{
    nh_dag *d = o->dag;
    const nh_coordinate *c = o->system->coordinate;
    if (a == b || c[a].type != NH_ANGLE || c[b].type != NH_ANGLE) return 0;
    nh_ex cosine = nh_call(d, NH_COS, c[b].q), sine = nh_call(d, NH_SIN, c[b].q), tangent = nh_call(d, NH_TAN, c[b].q);
    nh_ex first[] = {nh_call(d, NH_COS, c[a].q), nh_call(d, NH_SIN, c[a].q)};
    nh_ex second[] = {nh_int(d, 1), tangent, nh_powi(d, cosine, -1), nh_powi(d, tangent, -1), nh_powi(d, sine, -1)};
    for (size_t i = 0; i < NH_AFFINE_FIELD_WORDS; i++) out[i] = nh_mul(d, first[i % 2], second[i / 2]);
    return NH_AFFINE_FIELD_WORDS;
}

/* 1, q and q q: what quadratic changes of coordinates make of turns, as far as there are points for them. */
static bool fit_quadratic(const nh_model *o, size_t points, size_t most, const nh_ex *word, const double *row,
                          const double *value, nh_ex *zeta)
{
    size_t width = 0, m = o->m;
    if (1 + m + m * (m + 1) / 2 > most) return false;
    nh_ex *basis = nh_alloc_array(most, sizeof *basis);
    double *some = nh_alloc_array(points * most, sizeof *some);
    for (size_t r = 0; r <= m; r++)
        for (size_t s = r; s <= m; s++, width++) {
            size_t a = r ? 2 * r : 0, b = s ? 2 * s : 0; /* where affine() puts 1 and q */
            basis[width] = nh_mul(o->dag, word[a], word[b]);
            for (size_t p = 0; p < points; p++) some[width * points + p] = row[a * points + p] * row[b * points + p];
        }
    bool good = fit(o, points, width, basis, some, value, zeta);
    nh_free(some);
    nh_free(basis);
    return good;
}

bool nh_affine_field(const nh_model *o, nh_ex phi, const nh_options *options, nh_ex *zeta)
{
    size_t pairs = o->m * o->m;
    nh_ex *word = nh_alloc_array(2 + 3 * o->m + pairs * NH_AFFINE_FIELD_WORDS, sizeof *word);
    size_t width = affine(o, options, word), most = width + NH_AFFINE_FIELD_WORDS, points = most + spare_points;
    nh_ex *end = word + width;
    for (size_t p = 0; p < pairs; p++) end += nh_affine_field_words(o, p / o->m, p % o->m, end);
    size_t words = (size_t)(end - word);
    double *value = nh_alloc_array(points * o->n + 1, sizeof *value),
           *row = nh_alloc_array(points * words, sizeof *row), *some = nh_alloc_array(points * most, sizeof *some);
    nh_ex *basis = nh_alloc_array(most, sizeof *basis);
    memcpy(basis, word, width * sizeof *basis);
    bool sampled = o->n > 0 && sample(o, phi, options, points, words, word, value, row),
         good = sampled && fit(o, points, width, basis, row, value, zeta);
    memcpy(some, row, points * width * sizeof *some);
    for (size_t at = width; at < words && sampled && !good; at += NH_AFFINE_FIELD_WORDS) {
        memcpy(basis + width, word + at, NH_AFFINE_FIELD_WORDS * sizeof *basis);
        memcpy(some + points * width, row + points * at, points * NH_AFFINE_FIELD_WORDS * sizeof *some);
        good = fit(o, points, most, basis, some, value, zeta);
    }
    if (sampled && !good) good = fit_quadratic(o, points, most, word, row, value, zeta);
    nh_free(basis);
    nh_free(some);
    nh_free(row);
    nh_free(value);
    nh_free(word);
    return good;
}

/* affine_field: values of zeta = M^-T Y(Phi) at random points in ball arithmetic, then least squares in one basis of
 * words after another; the first whose coefficients are short fractions is taken.
 *
 *     fit             1, t, q, t q, centres of mass
 *     fit_with_time   these, and -tau w^i
 *     fit             these, and the ten words of a turn of two angles, for every pair
 *     fit_still       polynomials in the positions as the system shows them, without t
 *     fit_written     all that the system shows
 *     fit_quadratic   1, q, q q; coefficients as products of powers of parameters
 *
 * Matrices: row (points x words) and value (points x n) are column by column. */
#include "integrals/affine_field.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "base/memory.h"
#include "base/progress.h"
#include "graph/dag.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/num.h"
#include "integrals/exact_points.h"
#include "integrals/recognise.h"
#include "integrals/shown_coordinates.h"

enum { spare_points = 4, tries_per_point = 4, most_denominator = 1000 };
enum {
    most_waves = 12,
    most_plain = NH_MOST_PLACES + most_waves,
    most_components = 42,
    most_written = most_plain + most_components
};
static const double small = 1e-10;    /* of a residual, relative to the components */
static const double singular = 1e-12; /* of the basis at the points */

/* A parameter at another value than that which the system gives it. */
typedef struct {
    size_t parameter;
    nh_ex value;
} change;

/* M^T zeta = Y(Phi) at a random point, with the values of the words there. */
static bool values_at(const nh_model *model, nh_ball *ball, uint64_t *state, const nh_ex *M, const nh_ex *Y,
                      size_t words, const nh_ex *word, double *work, double *zeta, double *row)
{
    double radius, rcond;
    if (!nh_exact_point(model, ball, state)) return false;
    for (size_t i = 0; i < model->n; i++) {
        if (!nh_ball_value(ball, Y[i], &zeta[i], &radius)) return false;
        for (size_t j = 0; j < model->n; j++)
            if (!nh_ball_value(ball, M[i * model->n + j], &work[j * model->n + i], &radius)) return false;
    }
    for (size_t b = 0; b < words; b++)
        if (!nh_ball_value(ball, word[b], &row[b], &radius)) return false;
    return nh_solve(model->n, work, 1, zeta, &rcond);
}

/* The coefficients of each component (n x width), if they are short fractions that fit at all points; `row` is points x
 * width, `value` points x n. */
static bool coefficients(size_t n, size_t points, size_t width, const double *row, const double *value, nh_num *out)
{
    double *a = nh_alloc_array(points * width, sizeof *a), *b = nh_alloc_array(points * n, sizeof *b);
    memcpy(a, row, points * width * sizeof *a);
    memcpy(b, value, points * n * sizeof *b);
    bool good = nh_least_squares(points, width, a, n, b, points, singular) == (int)width;
    for (size_t i = 0; i < n && good; i++) {
        double size = 0, residual = 0;
        nh_num *c = out + i * width;
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
    }
    nh_free(b);
    nh_free(a);
    return good;
}

static bool fit(const nh_model *model, size_t points, size_t width, const nh_ex *basis, const double *row,
                const double *value, nh_ex *zeta)
{
    nh_num *c = nh_alloc_array(model->n * width + 1, sizeof *c);
    bool good = coefficients(model->n, points, width, row, value, c);
    for (size_t i = 0; i < model->n && good; i++) zeta[i] = nh_linear(model->dag, width, c + i * width, basis);
    nh_free(c);
    return good;
}

/* e with the given values; one parameter may have another one. */
static nh_ex valued(const nh_model *model, const change *other, nh_ex e)
{
    if (other) e = nh_substitute(model->dag, e, 1, &model->parameter[other->parameter], &other->value);
    return nh_model_values(model, e);
}

/* Values of zeta (points x n) and of the words (points x words), column by column; false where there are too few. */
static bool sample(const nh_model *model, nh_ex phi, const nh_options *options, const change *other, size_t points,
                   size_t words, const nh_ex *word, double *value, double *row)
{
    size_t found = 0, n = model->n;
    nh_ex *M = nh_alloc_array(n * n + n + words + 1, sizeof *M), *Y = M + n * n, *exact = Y + n;
    double *work = nh_alloc_array(n * n + n + words + 1, sizeof *work), *here = work + n * n, *line = here + n;
    for (size_t i = 0; i < n; i++) Y[i] = valued(model, other, nh_model_Y(model, i, phi));
    for (size_t i = 0; i < n * n; i++) M[i] = valued(model, other, model->M[i]);
    for (size_t b = 0; b < words; b++) exact[b] = valued(model, other, word[b]);
    nh_ball *ball = nh_ball_create(model->dag, (long)options->bits);
    uint64_t state = (uint64_t)options->seed + 78;
    for (size_t tries = 0; tries < tries_per_point * points && found < points && !nh_interrupted(); tries++) {
        if (!values_at(model, ball, &state, M, Y, words, exact, work, here, line)) continue;
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
static size_t affine(const nh_model *model, const nh_options *options, nh_ex *basis)
{
    nh_ex t = model->system->t;
    nh_centre_of_mass *centre = nh_alloc_array(model->m + 1, sizeof *centre);
    size_t n = 0, centres = nh_centre_of_mass_find(model, (size_t)options->proof_terms, centre);
    basis[n++] = nh_int(model->dag, 1);
    basis[n++] = t;
    for (size_t s = 0; s < model->m; s++) {
        basis[n++] = model->system->coordinate[s].q;
        basis[n++] = nh_mul(model->dag, t, model->system->coordinate[s].q);
    }
    for (size_t i = 0; i < centres; i++) basis[n++] = nh_div(model->dag, centre[i].F, centre[i].mass);
    nh_free(centre);
    return n;
}

size_t nh_affine_field_words(const nh_model *model, size_t a, size_t b, nh_ex out[NH_AFFINE_FIELD_WORDS])
{
    nh_dag *d = model->dag;
    const nh_coordinate *c = model->system->coordinate;
    if (a == b || c[a].type != NH_ANGLE || c[b].type != NH_ANGLE) return 0;
    nh_ex cosine = nh_call(d, NH_COS, c[b].q), sine = nh_call(d, NH_SIN, c[b].q), tangent = nh_call(d, NH_TAN, c[b].q);
    nh_ex first[] = {nh_call(d, NH_COS, c[a].q), nh_call(d, NH_SIN, c[a].q)};
    nh_ex second[] = {nh_int(d, 1), tangent, nh_powi(d, cosine, -1), nh_powi(d, tangent, -1), nh_powi(d, sine, -1)};
    for (size_t i = 0; i < NH_AFFINE_FIELD_WORDS; i++) out[i] = nh_mul(d, first[i % 2], second[i / 2]);
    return NH_AFFINE_FIELD_WORDS;
}

/* 1, q and q q, from the values of 1 and q in `row`; the number of columns. */
static size_t quadratic(const nh_model *model, size_t points, const nh_ex *word, const double *row, nh_ex *basis,
                        double *out)
{
    size_t width = 0;
    for (size_t r = 0; r <= model->m; r++)
        for (size_t s = r; s <= model->m; s++, width++) {
            size_t a = r ? 2 * r : 0, b = s ? 2 * s : 0; /* where affine() puts 1 and q */
            basis[width] = nh_mul(model->dag, word[a], word[b]);
            for (size_t p = 0; p < points; p++) out[width * points + p] = row[a * points + p] * row[b * points + p];
        }
    return width;
}

/* c (p/p0)^e, where e is the power by which c became `moved` when p0 was multiplied by the ratio; false: by none. */
static bool power_of(nh_dag *d, nh_num c, nh_num moved, nh_num ratio, nh_ex p, nh_num p0, nh_ex *coefficient)
{
    enum { highest = 3 };
    if (nh_num_is(c, 0) || nh_num_is(moved, 0)) return nh_num_is(c, 0) && nh_num_is(moved, 0);
    for (int e = -highest; e <= highest; e++) {
        nh_ex scale = nh_powi(d, nh_number(d, ratio), e);
        if (nh_mul(d, nh_number(d, c), scale) != nh_number(d, moved)) continue;
        *coefficient = nh_mul(d, *coefficient, nh_powi(d, nh_div(d, p, nh_number(d, p0)), e));
        return true;
    }
    return false;
}

/* What quadratic changes of coordinates make of turns, as far as there are points for so many functions. Coefficients
 * that are products of powers of parameters, as other values of these show, are written so. */
static bool fit_quadratic(const nh_model *model, nh_ex phi, const nh_options *options, size_t points, size_t most,
                          const nh_ex *word, const double *row, const double *value, nh_ex *zeta)
{
    nh_dag *d = model->dag;
    size_t m = model->m, n = model->n, words = 1 + 2 * m;
    if (1 + m + m * (m + 1) / 2 > most) return false;
    nh_ex *basis = nh_alloc_array(most, sizeof *basis);
    double *some = nh_alloc_array(points * most, sizeof *some);
    double *other_value = nh_alloc_array(points * (n + words + 1), sizeof *other_value);
    double *other_row = other_value + points * n;
    size_t width = quadratic(model, points, word, row, basis, some), all = n * width;
    nh_num *c = nh_alloc_array(2 * all + 1, sizeof *c), *moved = c + all, ratio = nh_num_int(2);
    nh_ex *coefficient = nh_alloc_array(all + 1, sizeof *coefficient);
    bool good = coefficients(n, points, width, some, value, c);
    for (size_t z = 0; z < all && good; z++) coefficient[z] = nh_number(d, c[z]);
    bool powers = good;
    for (size_t k = 0; k < model->system->parameters && powers; k++) {
        nh_ex p = model->parameter[k], p0 = nh_model_values(model, p);
        if (!nh_depends(d, phi, p) || nh_kind_of(d, p0) != NH_NUMBER || nh_is_zero(d, p0)) continue;
        change other = {k, nh_mul(d, p0, nh_number(d, ratio))};
        powers = sample(model, phi, options, &other, points, words, word, other_value, other_row);
        if (!powers) break;
        quadratic(model, points, word, other_row, basis, some);
        powers = coefficients(n, points, width, some, other_value, moved);
        for (size_t z = 0; z < all && powers; z++)
            powers = power_of(d, c[z], moved[z], ratio, p, nh_number_of(d, p0), &coefficient[z]);
    }
    for (size_t i = 0; i < n && good; i++) {
        zeta[i] = nh_int(d, 0);
        for (size_t k = 0; k < width; k++) {
            size_t z = i * width + k;
            zeta[i] = nh_add(d, zeta[i], nh_mul(d, powers ? coefficient[z] : nh_number(d, c[z]), basis[k]));
        }
    }
    nh_free(coefficient);
    nh_free(c);
    nh_free(other_value);
    nh_free(some);
    nh_free(basis);
    return good;
}

/* zeta^i = xi^i(t, q) - tau w^i with xi in the span of the words and a number tau: of an energy, also in coordinates
 * that move.  `velocity`: the values of w, points x n. */
static bool fit_with_time(const nh_model *model, size_t points, size_t width, const nh_ex *basis, const double *row,
                          const double *velocity, const double *value, nh_ex *zeta)
{
    size_t all = width + 1;
    nh_num *c = nh_alloc_array(all, sizeof *c), tau = nh_num_int(0);
    nh_ex *with = nh_alloc_array(all, sizeof *with);
    double *some = nh_alloc_array(points * all, sizeof *some);
    memcpy(with, basis, width * sizeof *with);
    memcpy(some, row, points * width * sizeof *some);
    bool good = true;
    for (size_t i = 0; i < model->n && good; i++) {
        memcpy(some + points * width, velocity + i * points, points * sizeof *some);
        good = coefficients(1, points, all, some, value + i * points, c);
        if (good && i == 0) tau = c[width];
        good = good && nh_num_equal(tau, c[width]) && !nh_num_is(tau, 0);
        with[width] = model->chart->w[i];
        if (good) zeta[i] = nh_linear(model->dag, all, c, with);
    }
    nh_free(some);
    nh_free(with);
    nh_free(c);
    return good;
}

/* Sums of positions as the system shows them, the sines and cosines in it, and what fields have in such coordinates. */
static size_t written(const nh_model *model, nh_ex out[most_written])
{
    nh_dag *d = model->dag;
    NH_LIST(call);
    size_t places = nh_shown_places(model, out), n = places, waves = 0,
           calls = nh_functions_in(d, model->system->lagrangian, &call);
    for (size_t i = 0; i < calls && waves + 2 <= most_waves; i++) {
        nh_function f = nh_function_of(d, call[i]);
        bool moves = false, known = false;
        for (size_t s = 0; s < model->m; s++) moves |= nh_depends(d, call[i], model->system->coordinate[s].v);
        if ((f != NH_SIN && f != NH_COS) || moves) continue;
        for (size_t k = 0; k < n; k++) known |= out[k] == call[i];
        if (known) continue;
        waves += 2;
        out[n++] = call[i];
        out[n++] = nh_call(d, f == NH_SIN ? NH_COS : NH_SIN, nh_child(d, call[i], 0));
    }
    return n + nh_shown_components(model, places, out, most_components, out + n);
}

/* Is the column a combination of the others? */
static bool depends_on(size_t points, size_t width, const double *row, const double *column)
{
    double *a = nh_alloc_array(points * (width + 1), sizeof *a), *b = a + points * width, size = 0, rest = 0;
    memcpy(a, row, points * width * sizeof *a);
    memcpy(b, column, points * sizeof *b);
    bool good = nh_least_squares(points, width, a, 1, b, points, singular) == (int)width;
    for (size_t p = 0; p < points && good; p++) {
        double e = column[p];
        for (size_t k = 0; k < width; k++) e -= b[k] * row[k * points + p];
        rest = fmax(rest, fabs(e));
        size = fmax(size, fabs(column[p]));
    }
    nh_free(a);
    return !good || rest <= small * size;
}

/* One column more, if it is no combination of those that are there. */
static void append(size_t points, nh_ex word, const double *column, nh_ex *all, double *some, size_t *n)
{
    if (*n && depends_on(points, *n, some, column)) return;
    memcpy(some + *n * points, column, points * sizeof *some);
    all[(*n)++] = word;
}

/* In coordinates that hide a symmetry, or move: components in the span of what the system shows, too. */
static bool fit_written(const nh_model *model, size_t points, size_t width, const nh_ex *basis, const double *row,
                        size_t words, const nh_ex *word, const double *column, const double *velocity,
                        const double *value, nh_ex *zeta)
{
    nh_ex *all = nh_alloc_array(width + words + 1, sizeof *all);
    double *some = nh_alloc_array(points * (width + words + 1), sizeof *some);
    size_t n = width;
    memcpy(all, basis, width * sizeof *all);
    memcpy(some, row, points * width * sizeof *some);
    for (size_t k = 0; k < words; k++) append(points, word[k], column + k * points, all, some, &n);
    bool good = n > width && (fit(model, points, n, all, some, value, zeta) ||
                              fit_with_time(model, points, n, all, some, velocity, value, zeta));
    nh_free(some);
    nh_free(all);
    return good;
}

/* The same by polynomials in the positions alone, without t: of fewer columns more digits are left. */
static bool fit_still(const nh_model *model, size_t points, size_t words, const nh_ex *word, const double *column,
                      const double *value, nh_ex *zeta)
{
    nh_ex *all = nh_alloc_array(words + 1, sizeof *all);
    NH_LIST(call);
    double *some = nh_alloc_array(points * (words + 1), sizeof *some);
    size_t n = 0;
    for (size_t k = 0; k < words; k++) {
        bool moves = nh_depends(model->dag, word[k], model->system->t) || nh_functions_in(model->dag, word[k], &call);
        for (size_t s = 0; s < model->n && !moves; s++) moves = nh_depends(model->dag, word[k], model->chart->w[s]);
        if (!moves) append(points, word[k], column + k * points, all, some, &n);
    }
    bool good = fit(model, points, n, all, some, value, zeta);
    nh_free(some);
    nh_free(all);
    return good;
}

bool nh_affine_field(const nh_model *model, nh_ex phi, const nh_options *options, nh_ex *zeta)
{
    size_t pairs = model->m * model->m;
    nh_ex *word =
        nh_alloc_array(2 + 3 * model->m + pairs * NH_AFFINE_FIELD_WORDS + most_written + model->n, sizeof *word);
    size_t width = affine(model, options, word);
    nh_ex *end = word + width;
    for (size_t p = 0; p < pairs; p++) end += nh_affine_field_words(model, p / model->m, p % model->m, end);
    size_t shown = (size_t)(end - word), more = written(model, end), fields = shown + more, words = fields + model->n;
    size_t most = width + (more > most_plain ? more : most_plain), points = most + spare_points;
    memcpy(end + more, model->chart->w, model->n * sizeof *end);
    double *value = nh_alloc_array(points * model->n + 1, sizeof *value),
           *row = nh_alloc_array(points * words, sizeof *row), *some = nh_alloc_array(points * most, sizeof *some);
    nh_ex *basis = nh_alloc_array(most, sizeof *basis);
    memcpy(basis, word, width * sizeof *basis);
    bool sampled = model->n > 0 && sample(model, phi, options, NULL, points, words, word, value, row),
         good = sampled && fit(model, points, width, basis, row, value, zeta);
    memcpy(some, row, points * width * sizeof *some);
    if (sampled && !good) good = fit_with_time(model, points, width, basis, row, row + points * fields, value, zeta);
    for (size_t at = width; at < shown && sampled && !good; at += NH_AFFINE_FIELD_WORDS) {
        memcpy(basis + width, word + at, NH_AFFINE_FIELD_WORDS * sizeof *basis);
        memcpy(some + points * width, row + points * at, points * NH_AFFINE_FIELD_WORDS * sizeof *some);
        good = fit(model, points, width + NH_AFFINE_FIELD_WORDS, basis, some, value, zeta);
    }
    if (sampled && !good && more) good = fit_still(model, points, fields, word, row, value, zeta);
    if (sampled && !good)
        good = fit_written(model, points, width, basis, row, more, word + shown, row + points * shown,
                           row + points * fields, value, zeta);
    if (sampled && !good) good = fit_quadratic(model, phi, options, points, most, word, row, value, zeta);
    nh_free(basis);
    nh_free(some);
    nh_free(row);
    nh_free(value);
    nh_free(word);
    return good;
}

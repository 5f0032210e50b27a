/* function_series: from one point of the variable s to its whole interval. [docs/method.md, sec. 4, "Coefficients
 * without closed form"]
 *
 *     nh_series_open      words, their rates and Gamma(s), with the parameters' values; the space near the middle of s
 *     reach               how far the solutions can be continued: exact/ball_ode.h, interval by interval
 *     fit                 Chebyshev coefficients of every f_i, the degree doubled until the last quarter is rounding
 *     hold_out            the rates at points that were not used: the certificate
 *
 *         begin      low                    middle                 high        end
 *           |---------[======================x======================]----------|
 *                      the series;  shortened where it would need too high a degree
 *
 * A current k is words x (degree + 1) coefficients, one word after the other. [Trefethen2013, ch. 8] */
#include "integrals/function_series.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/progress.h"
#include "exact/ball_ode.h"
#include "graph/dag.h"
#include "graph/function.h"
#include "graph/num.h"
#include "integrals/exact_points.h"

enum { near_terms = 8, first_degree = 16, heldout = 4, heldout_tries = 60, heldout_from = 100000 };
/* part of the first interval: its Taylor polynomials are exact to rounding there */
static const double near_part = 1e-3, least_step = 1e-4, /* part of the interval of s */
    /* part of the sampling interval by which the series extend beyond it, where that is possible */
    room = 0.04, cut = 0.9; /* factor by which the interval shrinks when the series there would be too long */

struct nh_series_search {
    const nh_model *o; /* borrows */
    const nh_options *options;
    nh_ex variable;
    size_t at;      /* the variable among the chart's symbols */
    nh_chart chart; /* a copy whose box has no width along the variable */
    nh_model thin;
    double *low, *high;
    double begin, end, middle;
    nh_ball *ball;
    nh_ball_ode *ode;
    size_t count;
    nh_ex *word, *value, *slope, variable_slope; /* value, slope: with the parameters' values */
};

/* The box of the thin model: s - half .. s + half along the variable, unchanged along the others. */
static void stand_at(nh_series_search *x, double s, double half)
{
    x->low[x->at] = s - half;
    x->high[x->at] = s + half;
}

/* The sample's number is the state of the random generator: the same rest for every s. */
static bool point(void *context, nh_ball *ball, double s, size_t sample)
{
    nh_series_search *x = context;
    uint64_t state = (uint64_t)x->options->seed + 4001 * (uint64_t)(sample + 1);
    stand_at(x, s, 0);
    return nh_exact_point(&x->thin, ball, &state);
}

nh_series_search *nh_series_open(const nh_model *model, nh_ex variable, size_t words, const nh_ex *word,
                                 const nh_options *options)
{
    nh_series_search *x = nh_alloc(sizeof *x);
    *x = (nh_series_search){
        .o = model, .options = options, .variable = variable, .chart = *model->chart, .thin = *model};
    x->thin.chart = &x->chart;
    x->chart.low = x->low = nh_alloc_array(model->width, sizeof *x->low);
    x->chart.high = x->high = nh_alloc_array(model->width, sizeof *x->high);
    memcpy(x->low, model->chart->low, model->width * sizeof *x->low);
    memcpy(x->high, model->chart->high, model->width * sizeof *x->high);
    while (x->at < model->width && model->chart->symbol[x->at] != variable) x->at++;
    x->begin = x->low[x->at];
    x->end = x->high[x->at];
    x->middle = (x->begin + x->end) / 2;
    x->word = nh_alloc_array(words + 1, sizeof *x->word);
    x->value = nh_alloc_array(words + 1, sizeof *x->value);
    x->slope = nh_alloc_array(words + 1, sizeof *x->slope);
    memcpy(x->word, word, words * sizeof *word);
    for (size_t i = 0; i < words; i++) {
        x->value[i] = nh_model_values(model, word[i]);
        x->slope[i] = nh_model_values(model, nh_model_gamma(model, word[i]));
    }
    x->variable_slope = nh_model_values(model, nh_model_gamma(model, variable));
    x->ball = nh_ball_create(model->dag, nh_ball_ode_bits(options->digits));
    nh_ball_ode_problem problem = {.words = words,
                                   .value = x->value,
                                   .slope = x->slope,
                                   .variable_slope = x->variable_slope,
                                   .point = point,
                                   .context = x,
                                   .digits = options->digits};
    x->ode = nh_ball_ode_create(x->ball, &problem);
    if (x->end > x->begin) x->count = nh_ball_ode_start(x->ode, x->middle, (x->end - x->begin) / 2);
    return x;
}

void nh_series_close(nh_series_search *x)
{
    if (!x) return;
    nh_ball_ode_free(x->ode);
    nh_ball_free(x->ball);
    nh_free(x->slope);
    nh_free(x->value);
    nh_free(x->word);
    nh_free(x->high);
    nh_free(x->low);
    nh_free(x);
}

size_t nh_series_count(const nh_series_search *x) { return x->count; }
size_t nh_series_words(const nh_series_search *x) { return nh_ball_ode_words(x->ode); }

/* ---- near the middle ---- */

/* Horner's scheme in s - middle, with the Taylor coefficients of the first interval. */
nh_ex nh_series_near(const nh_series_search *x, size_t k)
{
    nh_dag *d = x->o->dag;
    size_t words = nh_series_words(x);
    double *c = nh_alloc_array(near_terms * words * x->count + 1, sizeof *c);
    nh_ex phi = nh_int(d, 0), away = nh_sub(d, x->variable, nh_real(d, x->middle));
    nh_ball_ode_taylor(x->ode, near_terms, c);
    for (size_t i = 0; i < words; i++) {
        nh_ex f = nh_int(d, 0);
        for (size_t j = near_terms; j-- > 0;)
            f = nh_add(d, nh_real(d, c[j + near_terms * (i + k * words)]), nh_mul(d, away, f));
        phi = nh_add(d, phi, nh_mul(d, f, x->word[nh_ball_ode_word(x->ode, i)]));
    }
    nh_free(c);
    return phi;
}

nh_points *nh_series_points(const nh_series_search *x, size_t count)
{
    nh_series_search *thin = (nh_series_search *)x;
    nh_error ignored;
    nh_error_clear(&ignored);
    stand_at(thin, x->middle, near_part * nh_ball_ode_half(x->ode));
    return nh_points_create(&x->thin, count, 1, (uint64_t)x->options->seed + 505, &ignored);
}

/* ---- the whole interval ---- */

/* An end that is a short decimal. */
static double shortened(double s, double width, double (*rounded)(double))
{
    int places = 2 - (int)floor(log10(width));
    double unit = pow(10, abs(places));
    return places >= 0 ? rounded(s * unit) / unit : rounded(s / unit) * unit;
}

/* c_j = 2/N sum_k f(s_k) cos(j (k + 1/2) pi/N), half of that for j = 0; N = degree + 1 points. */
static void transform(const nh_series_search *x, double low, double high, size_t degree, double *c)
{
    size_t n = degree + 1, functions = nh_series_words(x) * x->count;
    double *value = nh_alloc_array(functions * n, sizeof *value);
    for (size_t k = 0; k < n; k++)
        nh_ball_ode_value(x->ode, (low + high) / 2 + (high - low) / 2 * cos(M_PI * ((double)k + 0.5) / (double)n),
                          value + k * functions);
    for (size_t f = 0; f < functions; f++)
        for (size_t j = 0; j < n; j++) {
            long double sum = 0;
            for (size_t k = 0; k < n; k++)
                sum += (long double)value[k * functions + f] *
                       cosl(M_PIl * (long double)(j * (2 * k + 1) % (4 * n)) / (2 * (long double)n));
            c[f * n + j] = (double)(sum * (j ? 2 : 1) / (long double)n);
        }
    nh_free(value);
}

/* Is the last quarter of every current's coefficients at rounding? */
static bool converged(const nh_series_search *x, size_t degree, const double *c)
{
    static const double rounding = 4e-15;
    size_t n = degree + 1, words = nh_series_words(x);
    for (size_t k = 0; k < x->count; k++) {
        double largest = 0, tail = 0;
        for (size_t i = 0; i < words; i++)
            for (size_t j = 0; j < n; j++) {
                double size = fabs(c[(k * words + i) * n + j]) * nh_ball_ode_size(x->ode, i);
                largest = fmax(largest, size);
                if (4 * j >= 3 * n) tail = fmax(tail, size);
            }
        if (!(tail <= rounding * largest)) return false;
    }
    return true;
}

/* Does no current become much smaller than it is elsewhere on the interval?  Small values have lost as many digits. */
static bool even(const nh_series_search *x, double low, double high)
{
    enum { places = 65 };
    static const double least = 1e-5;
    size_t words = nh_series_words(x), functions = words * x->count;
    double *value = nh_alloc_array(functions * places, sizeof *value);
    bool good = true;
    for (size_t p = 0; p < places; p++)
        nh_ball_ode_value(x->ode, low + (high - low) * (double)p / (places - 1), value + p * functions);
    for (size_t k = 0; k < x->count; k++) {
        double most = 0, smallest = INFINITY;
        for (size_t p = 0; p < places; p++) {
            double size = 0;
            for (size_t i = 0; i < words; i++)
                size = fmax(size, fabs(value[p * functions + k * words + i]) * nh_ball_ode_size(x->ode, i));
            most = fmax(most, size);
            smallest = fmin(smallest, size);
        }
        good &= smallest >= least * most;
    }
    nh_free(value);
    return good;
}

/* The degree, doubled until it is enough on this interval. */
static double *fit(const nh_series_search *x, double low, double high, size_t *degree)
{
    size_t most = (size_t)x->options->series_degree, functions = nh_series_words(x) * x->count;
    if (!even(x, low, high)) return NULL;
    for (*degree = first_degree < most ? first_degree : most;; *degree = 2 * *degree < most ? 2 * *degree : most) {
        double *c = nh_alloc_array(functions * (*degree + 1), sizeof *c);
        transform(x, low, high, *degree, c);
        if (converged(x, *degree, c)) return c;
        nh_free(c);
        if (*degree == most || nh_late()) return NULL;
    }
}

/* Each current's rate at points that were not used in the fit. */
static bool hold_out(nh_series_search *x, double low, double high, double *digits)
{
    size_t seen = 0;
    double *here = nh_alloc_array(x->count + 1, sizeof *here);
    for (size_t k = 0; k < x->count; k++) digits[k] = INFINITY;
    for (size_t tries = 0; tries < heldout_tries && seen < heldout; tries++) {
        double s = low + (high - low) * (0.37 + 0.618 * (double)tries - floor(0.37 + 0.618 * (double)tries));
        if (!nh_ball_ode_residual(x->ode, s, heldout_from + tries, here)) continue;
        for (size_t k = 0; k < x->count; k++) digits[k] = fmin(digits[k], here[k]);
        seen++;
    }
    nh_free(here);
    return seen == heldout;
}

/* The interval with a margin, for motions that begin at its edge. */
static void reach(nh_series_search *x, double beyond, double *low, double *high)
{
    double end = fmax(x->end, beyond), width = end - x->begin, least = least_step * width;
    *low = shortened(x->begin - room * width, width, floor);
    *high = shortened(end + room * width, width, ceil);
    double left = nh_ball_ode_extend(x->ode, *low, least), right = nh_ball_ode_extend(x->ode, *high, least);
    if (left > *low) *low = fmax(shortened(left, width, ceil), x->begin);
    if (right < *high) *high = fmin(shortened(right, width, floor), end);
}

/* The word whose coefficient is 1 for current k and 0 for the others at that point. */
static void find_alone(const nh_series_search *x, nh_series_space *out)
{
    static const double nothing = 1e-12;
    double *f = nh_alloc_array(out->words * out->count + 1, sizeof *f);
    nh_ball_ode_value(x->ode, out->at, f);
    for (size_t k = 0; k < out->count; k++) {
        size_t ones = 0, others = 0;
        out->alone[k] = out->words;
        for (size_t i = 0; i < out->words; i++) {
            bool one = fabs(f[k * out->words + i] - 1) < nothing;
            others += !one && fabs(f[k * out->words + i]) > nothing;
            ones += one;
            if (one) out->alone[k] = i;
        }
        if (ones != 1 || others) out->alone[k] = out->words;
    }
    nh_free(f);
}

bool nh_series_extend(nh_series_search *x, double beyond, nh_arena *arena, nh_series_space *out)
{
    double low, high, *c = NULL, width = x->end - x->begin;
    size_t words = nh_series_words(x), degree = 0;
    if (x->count == 0) return false;
    reach(x, beyond, &low, &high);
    double at = x->variable == x->o->system->t ? fmin(fmax(0, low), high) : x->middle;
    nh_ball_ode_normalise(x->ode, at);
    while (low < x->middle && x->middle < high && !(c = fit(x, low, high, &degree)) && !nh_late() &&
           high - low > least_step * width) {
        bool right = high - x->middle > x->middle - low;
        if (right) high = shortened(x->middle + cut * (high - x->middle), high - low, floor);
        else low = shortened(x->middle - cut * (x->middle - low), high - low, ceil);
    }
    if (!c) return false;
    *out = (nh_series_space){.low = low,
                             .high = high,
                             .words = words,
                             .count = x->count,
                             .degree = degree,
                             .at = at,
                             .word = nh_arena_alloc(arena, (words + 1) * sizeof *out->word),
                             .size = nh_arena_alloc(arena, (words + 1) * sizeof *out->size),
                             .digits = nh_arena_alloc(arena, (x->count + 1) * sizeof *out->digits),
                             .alone = nh_arena_alloc(arena, (x->count + 1) * sizeof *out->alone)};
    size_t n = words * x->count * (degree + 1);
    out->coefficient = nh_arena_alloc(arena, n * sizeof *out->coefficient);
    memcpy(out->coefficient, c, n * sizeof *c);
    nh_free(c);
    for (size_t i = 0; i < words; i++) {
        out->word[i] = x->word[nh_ball_ode_word(x->ode, i)];
        out->size[i] = nh_ball_ode_size(x->ode, i);
    }
    find_alone(x, out);
    return hold_out(x, low, high, out->digits);
}

/* T_k = cos(k acos s): short on paper.  Powers of s would overflow exact numbers, their coefficients doubles' digits.
 */
void nh_series_polynomials(nh_dag *d, nh_ex variable, double low, double high, size_t degree, nh_ex *T)
{
    nh_ex a = nh_number(d, nh_num_decimal(low)), b = nh_number(d, nh_num_decimal(high)), two = nh_int(d, 2);
    nh_ex s = nh_div(d, nh_sub(d, nh_mul(d, two, variable), nh_add(d, a, b)), nh_sub(d, b, a)),
          angle = nh_call(d, NH_ACOS, s);
    for (size_t k = 0; k <= degree; k++)
        T[k] = k == 0 ? nh_int(d, 1) : k == 1 ? s : nh_call(d, NH_COS, nh_mul(d, nh_int(d, (int64_t)k), angle));
}

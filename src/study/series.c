/* The ladder's search for coefficient functions without closed form:
 *
 *     Phi = sum_i f_i(q) b_i,     f_i = sum_k c_ik T_k((q - middle)/half)
 *
 * with b_i velocities or their products and q one coordinate in its sampling interval, beyond which a series says nothing.  The null space is
 * that of doubles, at the lowest degree that shows one; the certificate is the same problem at a degree high enough for `digits` digits,
 * solved in ball arithmetic, where a true current's residual falls geometrically with the degree [Trefethen2013, ch. 8]. */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/clock.h"
#include "noether/refine.h"
#include "study/climb.h"

enum { first_degree = 16, last_degree = 40, most_words = 12, most_unknowns = 420, most_vectors = 8 };

typedef struct {
    nh_climb *x;
    size_t words;
    nh_ex word[most_words];
    nh_ex q, s;       /* the coordinate, and (q - middle)/half */
    double low, high; /* its interval */
} problem;

/* Vectors of coefficients c[i * (degree + 1) + k]. */
typedef struct {
    size_t degree, count;
    double *c;
    size_t *pivot; /* per vector: where it is 1 and the others are 0 */
    double quotient;
} table;

/* ---- the functions ---- */

/* An interval with short rational ends that holds the sampled one with some room: acos s is singular at s = 1. */
static void set_interval(problem *p)
{
    enum { grid = 100 };
    static const double room = 0.04;
    nh_dag *d = p->x->r->model->dag;
    nh_chart_range(p->x->r->model->chart, p->q, &p->low, &p->high);
    double width = p->high - p->low;
    int64_t low = (int64_t)floor((p->low - room * width) * grid), high = (int64_t)ceil((p->high + room * width) * grid);
    p->low = (double)low / grid;
    p->high = (double)high / grid;
    nh_ex middle = nh_ratio(d, low + high, 2 * grid), half = nh_ratio(d, high - low, 2 * grid);
    p->s = nh_div(d, nh_sub(d, p->q, middle), half);
}

/* T_k = cos(k acos s): short on paper.  Powers of s would overflow exact numbers, their coefficients doubles' digits. */
static void chebyshev(const problem *p, size_t degree, nh_ex *T)
{
    nh_dag *d = p->x->r->model->dag;
    nh_ex angle = nh_call(d, NH_ACOS, p->s);
    for (size_t k = 0; k <= degree; k++) T[k] = k == 0 ? nh_int(d, 1) : k == 1 ? p->s : nh_call(d, NH_COS, nh_mul(d, nh_int(d, (int64_t)k), angle));
}

static nh_ex *terms_of(const problem *p, size_t degree)
{
    nh_dag *d = p->x->r->model->dag;
    nh_ex *T = nh_alloc_array(degree + 1, sizeof *T), *term = nh_alloc_array(p->words * (degree + 1), sizeof *term);
    chebyshev(p, degree, T);
    for (size_t i = 0; i < p->words; i++)
        for (size_t k = 0; k <= degree; k++) term[i * (degree + 1) + k] = nh_mul(d, p->word[i], T[k]);
    nh_free(T);
    return term;
}

static nh_family family_of(const problem *p, size_t degree, nh_ex *T, nh_family *part)
{
    chebyshev(p, degree, T);
    part[0] = (nh_family){.kind = NH_TERMS, .terms = p->words, .term = p->word};
    part[1] = (nh_family){.kind = NH_TERMS, .terms = degree + 1, .term = T};
    return (nh_family){.kind = NH_FAMILY_PRODUCT, .parts = 2, .part = part};
}

/* ---- the null space in doubles ---- */

/* The ansatz' own columns, sorted in its way, to (word, k). */
static void collect(const problem *p, const nh_solved *s, table *t)
{
    size_t n = p->words * (t->degree + 1);
    nh_ex *term = terms_of(p, t->degree);
    t->c = nh_alloc_array(n * t->count + 1, sizeof *t->c);
    for (size_t j = 0; j < s->ansatz->terms; j++) {
        size_t at = 0;
        while (at < n && term[at] != s->ansatz->term[j]) at++;
        for (size_t v = 0; v < t->count && at < n; v++)
            for (size_t c = 0; c < s->ansatz->columns; c++)
                t->c[v * n + at] += s->ansatz->to_term[j + c * s->ansatz->terms] * s->nullspace->vector[c + v * s->ansatz->columns];
    }
    nh_free(term);
}

/* Reduced echelon form with pivots among the lowest functions, T_0 before T_1: the averages of the f_i tell the vectors apart. */
static void reduce(const problem *p, table *t)
{
    size_t rows = t->degree + 1, n = p->words * rows, done = 0;
    t->pivot = nh_alloc_array(t->count + 1, sizeof *t->pivot);
    for (size_t k = 0; k < rows && done < t->count; k++)
        for (size_t step = 0; step < p->words && done < t->count; step++) {
            size_t vector = 0, at = 0;
            double best = 0;
            for (size_t v = done; v < t->count; v++)
                for (size_t i = 0; i < p->words; i++) {
                    double largest = 0;
                    for (size_t j = 0; j < n; j++) largest = fmax(largest, fabs(t->c[v * n + j]));
                    double x = fabs(t->c[v * n + i * rows + k]) / largest;
                    if (!(x > best)) continue;
                    best = x;
                    vector = v;
                    at = i * rows + k;
                }
            if (best < 1e-3) break;
            for (size_t j = 0; j < n; j++) {
                double x = t->c[vector * n + j];
                t->c[vector * n + j] = t->c[done * n + j];
                t->c[done * n + j] = x;
            }
            double unit = t->c[done * n + at];
            for (size_t j = 0; j < n; j++) t->c[done * n + j] /= unit;
            for (size_t v = 0; v < t->count; v++) {
                double f = t->c[v * n + at];
                for (size_t j = 0; j < n && v != done; j++) t->c[v * n + j] -= f * t->c[done * n + j];
            }
            t->pivot[done++] = at;
        }
    t->count = done;
}

static void table_clear(table *t)
{
    nh_free(t->c);
    nh_free(t->pivot);
    *t = (table){0};
}

/* Is the spectrum on its way down?  Then a higher degree is worth trying. */
static bool converging(const nh_nullspace *s) { return s->rank > 0 && s->spectrum[0] < 1e-6; }

/* Degrees until there is a null space, or no sign of one. */
static table find(problem *p, nh_tried *note)
{
    table t = {0};
    for (size_t degree = first_degree; degree <= last_degree && t.count == 0; degree += (last_degree - first_degree) / 2) {
        nh_ex *T = nh_alloc_array(degree + 1, sizeof *T);
        nh_family part[2], family = family_of(p, degree, T, part);
        nh_solved s = nh_climb_solve(p->x, 1, &family);
        bool goes_on = s.nullspace && converging(s.nullspace);
        note->columns = s.ansatz ? s.ansatz->columns : 0;
        note->sectors = s.sectors;
        note->skipped = !s.ansatz;
        note->limit = s.limit;
        if (s.nullspace) {
            note->dimension = s.nullspace->dimension;
            note->gap = s.nullspace->gap;
            t.degree = degree;
            t.count = s.nullspace->dimension < most_vectors ? s.nullspace->dimension : most_vectors;
            t.quotient = t.count ? s.nullspace->spectrum[t.count - 1] : 0;
            if (t.count) collect(p, &s, &t);
            if (t.count) nh_climb_keep_spectrum(p->x, s.nullspace, false);
        }
        nh_solved_clear(&s);
        nh_free(T);
        if (!goes_on) break;
    }
    if (t.count) reduce(p, &t);
    return t;
}

/* ---- the certificate ---- */

/* The degree from which on all coefficients are below 1e-12 of the largest: with geometric decay `digits` digits need digits/12 times that. */
static double decay(const problem *p, const table *t)
{
    size_t rows = t->degree + 1, last = 1;
    double largest = 0;
    for (size_t j = 0; j < t->count * p->words * rows; j++) largest = fmax(largest, fabs(t->c[j]));
    for (size_t j = 0; j < t->count * p->words * rows; j++)
        if (fabs(t->c[j]) > 1e-12 * largest && j % rows > last) last = j % rows;
    return (double)last;
}

/* The same vectors at a degree that gives as many digits as are asked for; false when none could be reached. */
static bool certify(const problem *p, const table *t, table *fine, double **digits)
{
    const nh_options *options = &p->x->r->options;
    double least = 1.1 * options->digits / 12 * decay(p, t);
    for (double factor = 1; factor < 2; factor *= 1.3) {
        size_t degree = (size_t)ceil(factor * least), rows = degree + 1, n = p->words * rows;
        if (n > most_unknowns) return false;
        bool *leading = nh_alloc_array(n + 1, sizeof *leading);
        for (size_t v = 0; v < t->count; v++) leading[t->pivot[v] / (t->degree + 1) * rows + t->pivot[v] % (t->degree + 1)] = true;
        nh_refined r = nh_refine_series(p->x->r->model, p->words, p->word, p->s, degree, leading, 1.15, options);
        bool good = r.count == t->count;
        for (size_t v = 0; v < r.count; v++) good &= r.digits[v] >= options->digits;
        nh_free(leading);
        if (good) {
            *fine = (table){.degree = degree, .count = r.count, .c = r.coefficient, .quotient = t->quotient};
            *digits = r.digits;
            return true;
        }
        nh_refined_clear(&r);
    }
    return false;
}

/* ---- from vectors to currents ---- */

/* What doubles can see of it: without the tails of the series below rounding. */
static nh_ex expression_of(const problem *p, const double *c, size_t degree, nh_series *series)
{
    nh_dag *d = p->x->r->model->dag;
    size_t rows = degree + 1;
    double largest = 0;
    nh_ex *T = nh_alloc_array(rows, sizeof *T), phi = nh_int(d, 0);
    chebyshev(p, degree, T);
    for (size_t j = 0; j < p->words * rows; j++) largest = fmax(largest, fabs(c[j]));
    for (size_t i = 0; i < p->words; i++) {
        nh_ex f = nh_int(d, 0);
        for (size_t k = 0; k < rows; k++) {
            if (fabs(c[i * rows + k]) < DBL_EPSILON / 8 * largest) continue;
            if (k > series->degree) series->degree = k;
            f = nh_add(d, f, nh_mul(d, nh_real(d, c[i * rows + k]), T[k]));
        }
        if (nh_is_zero(d, f)) continue;
        for (size_t k = 0; k < rows && series->coefficient; k++) series->coefficient[series->words * rows + k] = c[i * rows + k];
        series->word[series->words++] = p->word[i];
        phi = nh_add(d, phi, nh_mul(d, p->word[i], f));
    }
    nh_free(T);
    return phi;
}

static size_t keep(problem *p, const table *fine, const double *digits)
{
    nh_result *r = p->x->r;
    size_t n = p->words * (fine->degree + 1), added = 0;
    for (size_t v = 0; v < fine->count && !nh_climb_done(p->x); v++) {
        nh_series *series = nh_arena_alloc(r->arena, sizeof *series);
        *series = (nh_series){.coordinate = p->q, .low = p->low, .high = p->high, .word = nh_arena_alloc(r->arena, p->words * sizeof(nh_ex)),
                              .coefficient = nh_arena_alloc(r->arena, n * sizeof(double)), .stride = fine->degree + 1};
        nh_ex phi = expression_of(p, fine->c + v * n, fine->degree, series);
        if (nh_currents_add_series(p->x->bench, phi, series, fine->quotient, digits[v])) {
            r->independent++;
            added++;
        }
    }
    return added;
}

/* Is there anything in it that is not known?  The certificate is dear. */
static bool fresh(const problem *p, const table *t)
{
    nh_arena *arena = p->x->r->arena;
    size_t n = p->words * (t->degree + 1);
    for (size_t v = 0; v < t->count; v++) {
        nh_series ignored = {.word = nh_arena_alloc(arena, p->words * sizeof(nh_ex))};
        if (!nh_currents_known(p->x->bench, expression_of(p, t->c + v * n, t->degree, &ignored))) return true;
    }
    return false;
}

static void search(problem *p, const char *what)
{
    nh_result *r = p->x->r;
    char name[120];
    double start = nh_clock(), *digits = NULL;
    set_interval(p);
    snprintf(name, sizeof name, "%s with coefficients that are series in %s", what, nh_name_of(r->model->dag, p->q));
    nh_tried *note = nh_climb_note(p->x, name);
    table t = find(p, note), fine = {0};
    bool news = t.count && fresh(p, &t);
    if (news && certify(p, &t, &fine, &digits)) note->found = keep(p, &fine, digits);
    else note->undecided = news;
    note->seconds = nh_clock() - start;
    nh_free(digits);
    table_clear(&fine);
    table_clear(&t);
}

/* What has closed form should be found as that: the same words with harmonics of q and the system's functions. */
static void closed_forms(problem *p)
{
    nh_climb *x = p->x;
    nh_dag *d = x->r->model->dag;
    nh_ex *f = nh_arena_alloc(x->r->arena, (6 + x->words.atoms) * sizeof *f), *word = nh_arena_alloc(x->r->arena, (p->words + 1) * sizeof *word);
    size_t n = 0;
    f[n++] = nh_int(d, 1);
    if (!x->words.waves) f[n++] = p->q;
    for (int k = 1; k <= 2 && x->words.waves; k++) {
        nh_ex angle = nh_mul(d, nh_int(d, k), p->q);
        f[n++] = nh_call(d, NH_COS, angle);
        f[n++] = nh_call(d, NH_SIN, angle);
    }
    for (size_t i = 0; i < x->words.atoms; i++) f[n++] = x->words.atom[i];
    memcpy(word, p->word, p->words * sizeof *word);
    nh_family *part = nh_arena_alloc(x->r->arena, 2 * sizeof *part), *both = nh_arena_alloc(x->r->arena, sizeof *both);
    part[0] = (nh_family){.kind = NH_TERMS, .terms = p->words, .term = word};
    part[1] = (nh_family){.kind = NH_TERMS, .terms = n, .term = f};
    both[0] = (nh_family){.kind = NH_FAMILY_PRODUCT, .parts = 2, .part = part};
    nh_climb_stage(x, "squares of velocities times harmonics and functions of the shape", 1, both);
}

/* Functions of one coordinate q make sense where the equations of motion depend on no other: then 1, w and w w are closed under Gamma. */
void nh_climb_series(nh_climb *x)
{
    const nh_model *o = x->r->model;
    nh_dag *d = o->dag;
    if (x->words.shapes != 1 || o->n > most_words) return;
    problem p = {.x = x, .q = x->words.shape[0]};
    for (size_t i = 0; i < o->n; i++) p.word[p.words++] = o->chart->w[i];
    if (o->system->has_forces && p.words < most_words) p.word[p.words++] = nh_int(d, 1); /* friction takes what depends on the place alone */
    search(&p, "velocities");
    if (nh_climb_done(x) || 1 + o->n * (o->n + 1) / 2 > most_words) return;
    p.words = 0;
    p.word[p.words++] = nh_int(d, 1);
    for (size_t i = 0; i < o->n; i++)
        for (size_t j = 0; j <= i; j++) p.word[p.words++] = nh_mul(d, o->chart->w[i], o->chart->w[j]);
    closed_forms(&p);
    if (!nh_climb_done(x)) search(&p, "squares of velocities");
}

/* Places where [K F^T; F 0] becomes singular, inside the steps of a motion (singular.h).
 *
 *      |det|   \               /          sampled at a few times of the step; a minimum that may be a zero is searched
 *               \    step     /           by golden sections, first on the cubic of the step, then on its states
 *          |-----o---o---o---o------|     then the least singular values of F and of K on ker F there against those at
 *                   \_/                   both sides: far smaller means zero, and the words say which vanish
 *
 * Columns are scaled by 1/sqrt(K_ss) and rows of F by 1/|F_a| at the start, so that no unit matters. */
#include "motion/singular.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/linalg.h"
#include "base/memory.h"

enum { places = 5, most_iterations = 60, first_iterations = 12, longest_text = 80, longest_words = 200 };
/* where a step is sampled; those next to its ends tell whether the determinant falls or rises there */
static const double place[places] = {0, 1e-3, 0.5, 1 - 1e-3, 1};
static const double golden = 0.3819660112501051; /* (3 - sqrt(5))/2 */
/* part of the values at both sides: a minimum above it after the first iterations is no zero */
static const double shallow = 0.05;
/* part of the values at both sides: a smaller singular value is zero, or the step is far longer than the way past the
 * place */
static const double vanishing = 1e-3;
/* part of the largest determinant: above it no error leads to a zero */
static const double close_by = 1e-6;
/* error of a motion after many steps, in rtol; its largest value */
static const double errors = 1e4, most_error = 1e-6;
/* part of the determinant before the end of a step: where it is smaller at the end, the motion may end exactly there */
static const double same = 1e-9;
/* part of the largest entry of a singular vector: smaller entries are not named */
static const double takes_part = 0.3;

struct nh_singular_watch {
    nh_singular_terms terms;
    size_t m, k;
    size_t states;          /* entries of `state` and `size`, which are allocated in the first step */
    double *entry;          /* K (m x m), F (k x m), column-major */
    double *column, *row;   /* factors of columns and rows: 1/sqrt(K_ss) and 1/|F_a| at the start */
    double *matrix, *state; /* (m + k) x (m + k); a state */
    double *square, *vector, *sigma, *work;
    double start[2];        /* singular values at the start */
    double last_time, last; /* the determinant at the end of the last step */
    double *size, most;     /* the largest value of each state and of the determinant so far */
    bool begun;
    bool close; /* the place was found within errors of the states */
    bool rough; /* states inside the step come from the cubic (nh_inside_step_sketch) */
    char words[longest_words];
};

/* ---- the determinant ---- */

/* K and F at the state c->state. */
static bool entries_here(nh_singular_watch *c, double t)
{
    return c->terms.value(t, c->state, c->entry, c->terms.context) && nh_all_finite(c->m * (c->m + c->k), c->entry);
}

static bool entries_at(nh_singular_watch *c, nh_inside_step *inside, double t)
{
    bool good = c->rough ? nh_inside_step_sketch(t, c->state, inside) : nh_inside_step_state(t, c->state, inside);
    return good && entries_here(c, t);
}

/* Scales velocities to units of equal kinetic energy, and constraints to units of equal size. */
static void scale(nh_singular_watch *c)
{
    size_t m = c->m, k = c->k;
    const double *K = c->entry, *F = K + m * m;
    for (size_t s = 0; s < m; s++) {
        double own = fabs(K[s + s * m]);
        c->column[s] = own > 0 ? 1 / sqrt(own) : 1;
    }
    for (size_t a = 0; a < k; a++) {
        double norm = 0;
        for (size_t s = 0; s < m; s++) norm = hypot(norm, F[a + s * k] * c->column[s]);
        c->row[a] = norm > 0 ? 1 / norm : 1;
    }
}

/* K_sr s_s s_r and F_as r_a s_s, in place. */
static void apply_scale(nh_singular_watch *c)
{
    size_t m = c->m, k = c->k;
    double *K = c->entry, *F = K + m * m;
    for (size_t s = 0; s < m; s++) {
        for (size_t r = 0; r < m; r++) K[s + r * m] *= c->column[s] * c->column[r];
        for (size_t a = 0; a < k; a++) F[a + s * k] *= c->row[a] * c->column[s];
    }
}

/* |det| of the bordered matrix with these entries; infinite where it cannot be computed. */
static double determinant_of(nh_singular_watch *c)
{
    size_t m = c->m, k = c->k, n = m + k;
    apply_scale(c);
    memset(c->matrix, 0, n * n * sizeof *c->matrix);
    for (size_t s = 0; s < m; s++) {
        for (size_t r = 0; r < m; r++) c->matrix[s + r * n] = c->entry[s + r * m];
        for (size_t a = 0; a < k; a++)
            c->matrix[m + a + s * n] = c->matrix[s + (m + a) * n] = c->entry[m * m + a + s * k];
    }
    double det = fabs(nh_determinant(n, c->matrix));
    return isfinite(det) ? det : INFINITY;
}

/* The determinant at a time in the step. */
static double determinant(nh_singular_watch *c, nh_inside_step *inside, double t)
{
    return entries_at(c, inside, t) ? determinant_of(c) : INFINITY;
}

/* ---- singular values ---- */

/* The least singular values of F and of K on ker F at a time in the step, with the singular vectors: the combination of
 * rows of F that vanishes, and a velocity without inertia. */
static bool least_values(nh_singular_watch *c, nh_inside_step *inside, double t, double least[2], double *rows,
                         double *velocity)
{
    size_t m = c->m, k = c->k, n = m - k;
    const double *K = c->entry, *F = K + m * m;
    double *kernel = c->work, *half = kernel + m * m, *small = half + m * m;
    if (!entries_at(c, inside, t)) return false;
    apply_scale(c);
    memset(c->square, 0, m * m * sizeof *c->square);
    for (size_t a = 0; a < k; a++)
        for (size_t s = 0; s < m; s++) c->square[a + s * m] = F[a + s * k];
    if (!nh_svd(m, m, c->square, c->sigma, c->matrix, c->vector)) return false;
    least[0] = k ? c->sigma[k - 1] : 1;
    for (size_t a = 0; a < k && rows; a++) rows[a] = c->matrix[a + (k - 1) * m];
    least[1] = 1;
    if (!n) return true;
    for (size_t i = 0; i < n; i++)
        for (size_t s = 0; s < m; s++) kernel[s + i * m] = c->vector[k + i + s * m];
    nh_multiply(m, m, n, K, kernel, half);
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++) {
            small[i + j * n] = 0;
            for (size_t s = 0; s < m; s++) small[i + j * n] += kernel[s + i * m] * half[s + j * m];
        }
    if (!nh_svd(n, n, small, c->sigma, NULL, c->vector)) return false;
    least[1] = c->sigma[n - 1];
    for (size_t s = 0; s < m && velocity; s++) {
        velocity[s] = 0;
        for (size_t i = 0; i < n; i++) velocity[s] += kernel[s + i * m] * c->vector[n - 1 + i * n];
    }
    return true;
}

/* max |x_i|. */
static double largest(size_t n, const double *x)
{
    double most = 0;
    for (size_t i = 0; i < n; i++) most = fmax(most, fabs(x[i]));
    return most;
}

/* "the coefficients of the constraint x*z' = x*y*x' vanish" */
static void say_constraints(nh_singular_watch *c, const double *rows)
{
    size_t k = c->k, count = 0, last = 0;
    double most = largest(k, rows);
    for (size_t a = 0; a < k; a++)
        if (fabs(rows[a]) > takes_part * most) count++, last = a;
    const char *text = c->terms.system->constraint[last].text;
    if (count == 1 && text && strlen(text) <= longest_text)
        snprintf(c->words, sizeof c->words, "the coefficients of the velocities in the constraint %s vanish", text);
    else if (count == 1)
        snprintf(c->words, sizeof c->words, "the coefficients of the velocities in constraint %zu vanish", last + 1);
    else snprintf(c->words, sizeof c->words, "the constraints are not independent of each other");
}

/* "the mass matrix is singular: nothing determines the acceleration of x and y" */
static void say_velocities(nh_singular_watch *c, const double *velocity)
{
    size_t m = c->m, used = 0;
    double most = largest(m, velocity);
    int n = snprintf(c->words, sizeof c->words, "the mass matrix is singular%s",
                     c->terms.mapped ? "" : ", without inertia in");
    for (size_t s = 0; s < m && !c->terms.mapped && n > 0 && (size_t)n < sizeof c->words; s++)
        if (fabs(velocity[s]) > takes_part * most)
            n += snprintf(c->words + n, sizeof c->words - (size_t)n, "%s%s", used++ ? ", " : " ",
                          c->terms.system->coordinate[s].name);
}

/* Do the singular values at `time` vanish relative to those at the sides?  The words say which. */
static bool vanishes(nh_singular_watch *c, nh_inside_step *inside, double time, const double sides[2])
{
    double here[2], *rows = c->work + 3 * c->m * c->m, *velocity = rows + c->k;
    if (!least_values(c, inside, time, here, rows, velocity)) return false;
    for (size_t s = 0; s < c->m; s++) velocity[s] *= c->column[s];
    if (here[0] < vanishing * sides[0]) return say_constraints(c, rows), true;
    if (here[1] < vanishing * sides[1]) return say_velocities(c, velocity), true;
    return false;
}

/* ---- minima inside a step ---- */

/* The minimum between two times by golden sections; NAN where it is not zero. */
static double lowest_in(nh_singular_watch *c, nh_inside_step *inside, double from, double to, double sides)
{
    double a = from, b = to, x = a + golden * (b - a), y = b - golden * (b - a), fx = determinant(c, inside, x),
           fy = determinant(c, inside, y);
    for (int i = 0; i < most_iterations; i++) {
        if (i == first_iterations && fmin(fx, fy) > shallow * sides) return NAN;
        if (fx < fy) b = y, y = x, fy = fx, x = a + golden * (b - a), fx = determinant(c, inside, x);
        else a = x, x = y, fx = fy, y = b - golden * (b - a), fy = determinant(c, inside, y);
    }
    return fx < fy ? x : y;
}

/* Looks for the minimum first along the cubic of the step. */
static double lowest(nh_singular_watch *c, nh_inside_step *inside, double from, double to, double sides)
{
    c->rough = true;
    double at = lowest_in(c, inside, from, to, sides);
    c->rough = false;
    return isnan(at) ? NAN : lowest_in(c, inside, from, to, sides);
}

/* The values at the start of the motion. */
static bool begin_at(nh_singular_watch *c, nh_inside_step *inside, double t)
{
    nh_free(c->state);
    c->states = nh_inside_step_size(inside);
    c->state = nh_alloc_array(2 * c->states, sizeof *c->state);
    c->size = c->state + c->states;
    if (!entries_at(c, inside, t)) return false;
    scale(c);
    c->last_time = NAN;
    return least_values(c, inside, t, c->start, NULL, NULL);
}

static bool least_of_both(nh_singular_watch *c, nh_inside_step *inside, double from, double to, double least[2])
{
    double other[2];
    if (!least_values(c, inside, from, least, NULL, NULL) || !least_values(c, inside, to, other, NULL, NULL))
        return false;
    for (int i = 0; i < 2; i++) least[i] = fmin(least[i], other[i]);
    return true;
}

/* Can errors of the states change the determinant by its own value? */
static bool within_error(nh_singular_watch *c, nh_inside_step *inside, double t, double det, double rtol)
{
    double error = fmin(errors * rtol, most_error);
    if (!(det < close_by * c->most)) return false;
    for (size_t i = 0; i < 2 * c->states; i++) {
        if (!nh_inside_step_state(t, c->state, inside)) return false;
        c->state[i / 2] += (i % 2 ? -error : error) * c->size[i / 2];
        if (entries_here(c, t) && determinant_of(c) > 2 * det) return true;
    }
    return false;
}

static void follow_sizes(nh_singular_watch *c, nh_inside_step *inside)
{
    if (!nh_inside_step_state(nh_inside_step_end(inside), c->state, inside)) return;
    for (size_t i = 0; i < c->states; i++) c->size[i] = fmax(c->size[i], fabs(c->state[i]));
}

/* Do the samples fall and rise?  Or do they fall towards an end of the step, near which the minimum may lie? */
static bool may_be_zero(const double *det, int i)
{
    static const double lower = 0.9, far_lower = 1e-2;
    bool least = det[i] <= det[i - 1] && det[i] <= det[i + 1] && det[i] < lower * fmax(det[i - 1], det[i + 1]);
    return least || (i == 1 && det[1] < far_lower * det[2]) || (i == places - 2 && det[i] < far_lower * det[i - 1]);
}

double nh_singular_watch_step(nh_singular_watch *c, nh_inside_step *inside, double rtol)
{
    double begin = nh_inside_step_begin(inside), end = nh_inside_step_end(inside), time[places], det[places], sides[2];
    if (!c->begun && !(c->begun = begin_at(c, inside, begin))) return NAN;
    c->rough = true;
    for (int i = 0; i < places; i++) {
        time[i] = i + 1 == places ? end : begin + place[i] * (end - begin);
        det[i] = i == 0 && c->last_time == begin ? c->last : determinant(c, inside, time[i]);
        if (isfinite(det[i])) c->most = fmax(c->most, det[i]);
    }
    c->rough = false;
    c->last_time = end, c->last = det[places - 1];
    follow_sizes(c, inside);
    for (int i = 1; i + 1 < places; i++) {
        if (!may_be_zero(det, i)) continue;
        double at = lowest(c, inside, time[i - 1], time[i + 1], fmin(det[i - 1], det[i + 1]));
        if (isnan(at) || !least_of_both(c, inside, time[i - 1], time[i + 1], sides)) continue;
        if (vanishes(c, inside, at, sides)) return at;
    }
    /* the motion may end exactly there */
    if (det[places - 1] < same * det[places - 2] && least_of_both(c, inside, begin, time[places - 2], sides) &&
        vanishes(c, inside, end, sides))
        return end;
    if (within_error(c, inside, end, det[places - 1], rtol) && vanishes(c, inside, end, c->start)) {
        c->close = true;
        return end;
    }
    return NAN;
}

bool nh_singular_watch_end(nh_singular_watch *c, nh_inside_step *inside)
{
    return c->begun && vanishes(c, inside, nh_inside_step_end(inside), c->start);
}

bool nh_singular_watch_close(const nh_singular_watch *c) { return c->close; }
const char *nh_singular_watch_words(const nh_singular_watch *c) { return c->words; }

/* ---- creation ---- */

nh_singular_watch *nh_singular_watch_create(const nh_singular_terms *terms)
{
    size_t m = terms->m, k = terms->k, n = m * (m + k), square = (m + k) * (m + k), work = 3 * m * m + m + k;
    nh_singular_watch *c = nh_alloc(sizeof *c);
    *c = (nh_singular_watch){.terms = *terms, .m = m, .k = k};
    c->entry = nh_alloc_array(n + m + k + square + 2 * m * m + m + work + 1, sizeof *c->entry);
    c->column = c->entry + n, c->row = c->column + m, c->matrix = c->row + k;
    c->square = c->matrix + square, c->vector = c->square + m * m, c->sigma = c->vector + m * m;
    c->work = c->sigma + m;
    return c;
}

void nh_singular_watch_free(nh_singular_watch *c)
{
    if (!c) return;
    nh_free(c->state);
    nh_free(c->entry);
    nh_free(c);
}

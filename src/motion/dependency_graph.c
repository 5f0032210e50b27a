/* Which states feed which, and what conserved currents make superfluous (dependency_graph.h).
 *
 *      rows i = rates of the states, then the watched expressions;   feeds[i][j]: d row_i/dz_j is not identically zero
 *
 *      close_network     from the watched rows: keep the states that feed them, ask their rows, and so on
 *      improve           for each current and each kept state it may determine: substitute z_j = (c - B)/A in all rows,
 *                        close the network anew, keep the best; again, until none leaves fewer states
 *
 *      A derivative is judged by its values at the probes first; those that vanish there are proved to be zero by their
 *      normal form or by balls, in the network that is used in the end. */
#include "motion/dependency_graph.h"

#include <math.h>
#include <string.h>

#include "exact/ball.h"
#include "graph/diff.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/num.h"

static const double seems_zero = 1e-11; /* relative size below which a derivative may be identically zero */
static const double ball_digits = 40;   /* digits to which it must vanish when its normal form is too large */
/* least ratio of |A| at the probes to its largest value: above it a current determines its state everywhere */
static const double steady = 0.02;
enum { ball_bits = 256, ball_points = 4, most_terms = 4000, cost_of_state = 10 };

static nh_ex symbol_of(const nh_model *model, size_t j) { return model->chart->symbol[1 + j]; }

nh_tape *nh_dependency_graph_tape(const nh_dependency_graph *w, size_t n, const nh_ex *e, size_t fixed,
                                  const nh_ex *symbol, const double *value)
{
    const nh_model *model = w->model;
    size_t given = model->system->parameters;
    nh_ex *in = nh_alloc_array(model->width + w->levels + 1, sizeof *in),
          *bound = nh_alloc_array(given + fixed + 1, sizeof *bound);
    double *at = nh_alloc_array(given + fixed + 1, sizeof *at);
    memcpy(in, model->chart->symbol, model->width * sizeof *in);
    for (size_t k = 0; k < w->levels; k++) in[model->width + k] = w->level[k].constant;
    for (size_t i = 0; i < given; i++) bound[i] = model->parameter[i], at[i] = model->parameter_value[i];
    for (size_t i = 0; i < fixed; i++) bound[given + i] = symbol[i], at[given + i] = value[i];
    nh_tape *tape = nh_tape_create(model->dag, model->width + w->levels, in, n, e, given + fixed, bound, at);
    nh_free(at);
    nh_free(bound);
    nh_free(in);
    return tape;
}

/* n expressions at all probes, with the constants of these points: out[p * n + i]. */
static double *at_probes(const nh_dependency_graph *w, size_t n, const nh_ex *e)
{
    const nh_model *model = w->model;
    size_t probes = model->chart->probes, width = model->width;
    nh_ex *phi = nh_alloc_array(w->levels + 1, sizeof *phi);
    double *point = nh_alloc_array(width + w->levels + 1, sizeof *point),
           *out = nh_alloc_array(n * probes + 1, sizeof *out);
    for (size_t k = 0; k < w->levels; k++) phi[k] = w->level[k].current;
    nh_tape *constants = nh_model_tape(model, w->levels, phi), *tape = nh_dependency_graph_tape(w, n, e, 0, NULL, NULL);
    nh_tape_work *a = nh_tape_work_create(constants), *b = nh_tape_work_create(tape);
    for (size_t p = 0; p < probes; p++) {
        memcpy(point, model->chart->probe + p * width, width * sizeof *point);
        nh_tape_eval(constants, a, point, point + width);
        nh_tape_eval(tape, b, point, out + p * n);
    }
    nh_tape_work_free(a);
    nh_tape_work_free(b);
    nh_tape_free(constants);
    nh_tape_free(tape);
    nh_free(point);
    nh_free(phi);
    return out;
}

/* ---- is it zero? ---- */

/* |d| below 10^-40 at the first probes, rigorously.  Constants of currents may have any value. */
static bool vanishes_in_balls(const nh_dependency_graph *w, nh_ex d)
{
    const nh_model *model = w->model;
    if (model->chart->implicit) return false; /* the probes' implicit velocities have a double's digits */
    size_t points = model->chart->probes < ball_points ? model->chart->probes : ball_points;
    nh_ball *ball = nh_ball_create(model->dag, ball_bits);
    bool zero = points > 0;
    for (size_t p = 0; p < points && zero; p++) {
        double bound;
        for (size_t i = 0; i < model->system->parameters; i++)
            nh_ball_set_expression(ball, model->parameter[i],
                                   nh_number(model->dag, nh_num_decimal(model->parameter_value[i])));
        for (size_t i = 0; i < model->width; i++)
            nh_ball_set_double(ball, model->chart->symbol[i], model->chart->probe[p * model->width + i]);
        for (size_t k = 0; k < w->levels; k++)
            nh_ball_set_double(ball, w->level[k].constant, 0.7385 + 0.31 * (double)(p + k));
        zero = nh_ball_log10_bound(ball, d, &bound) && bound < -ball_digits;
    }
    nh_ball_free(ball);
    return zero;
}

/* Is d identically zero? By its normal form, or by balls where that is too large. */
static bool is_zero(const nh_dependency_graph *w, nh_ex d)
{
    return nh_is_zero(w->model->dag, d) || nh_normal_is_zero(w->model->dag, d, most_terms) == NH_ZERO ||
           vanishes_in_balls(w, d);
}

/* ---- which state feeds which ---- */

/* Is state j determined by a current? */
static bool removed(const nh_dependency_graph *w, size_t j)
{
    for (size_t k = 0; k < w->levels; k++)
        if (w->level[k].state == j) return true;
    return false;
}

/* The feeds of the listed rows, also through the implicit velocities (derivatives follow their rules).  One tape has
 * all derivatives. */
static void feed_rows(nh_dependency_graph *w, size_t rows, const size_t *row, bool proved)
{
    const nh_model *model = w->model;
    size_t n = w->states, count = 0, probes = model->chart->probes;
    nh_ex *e = nh_alloc_array(rows * (n + 1) + 1, sizeof *e);
    size_t *from = nh_alloc_array(rows * n + 1, sizeof *from);
    for (size_t r = 0; r < rows; r++)
        for (size_t j = 0; j < n; j++) {
            nh_ex d = removed(w, j) ? nh_int(model->dag, 0) : nh_diff(model->dag, w->row[row[r]], symbol_of(model, j));
            w->feeds[row[r] * n + j] = false;
            if (nh_is_zero(model->dag, d)) continue;
            from[count] = r * n + j;
            e[count++] = d;
        }
    for (size_t r = 0; r < rows; r++) e[count + r] = w->row[row[r]];
    double *value = at_probes(w, count + rows, e);
    for (size_t c = 0; c < count; c++) {
        size_t r = from[c] / n, j = from[c] % n;
        bool zero = probes > 0;
        for (size_t p = 0; p < probes && zero; p++) { /* an undefined value does not vanish */
            const double *at = value + p * (count + rows);
            zero = fabs(at[c]) <= seems_zero * (1 + fabs(at[count + r]));
        }
        w->feeds[row[r] * n + j] = !(zero && (!proved || is_zero(w, e[c])));
    }
    nh_free(value);
    nh_free(from);
    nh_free(e);
}

static bool reads_implicit(const nh_model *model, nh_ex e)
{
    for (size_t a = 0; a < model->chart->implicit; a++)
        if (nh_depends(model->dag, e, model->chart->u[a])) return true;
    return false;
}

/* Implicit velocities are found together: every state in their equations is needed. */
static void keep_implicit(nh_dependency_graph *w)
{
    const nh_model *model = w->model;
    bool needed = false;
    for (size_t i = 0; i < w->states + w->watches; i++)
        needed |= (i >= w->states || w->kept[i]) && reads_implicit(model, w->row[i]);
    for (size_t a = 0; a < model->chart->implicit && needed; a++)
        for (size_t j = 0; j < w->states; j++)
            w->kept[j] |= nh_depends(model->dag, model->chart->residual[a], symbol_of(model, j));
    w->implicit = needed;
}

/* Follows the feeds from the watched expressions: asks rows whose feeds are not known yet, until there are none. */
static void close_network(nh_dependency_graph *w, bool proved)
{
    size_t n = w->states, total = n + w->watches, *row = nh_alloc_array(total + 1, sizeof *row), rows = 0;
    bool *done = nh_alloc_array(total + 1, sizeof *done);
    memset(w->kept, 0, n * sizeof *w->kept);
    for (size_t k = 0; k < w->watches; k++) row[rows++] = n + k;
    while (rows) {
        feed_rows(w, rows, row, proved);
        for (size_t r = 0; r < rows; r++) {
            done[row[r]] = true;
            for (size_t j = 0; j < n; j++) w->kept[j] |= w->feeds[row[r] * n + j];
        }
        keep_implicit(w);
        rows = 0;
        for (size_t j = 0; j < n; j++)
            if (w->kept[j] && !done[j]) row[rows++] = j;
    }
    w->count = 0;
    for (size_t j = 0; j < n; j++) w->count += w->kept[j];
    nh_free(done);
    nh_free(row);
}

/* The operations of the kept rows, with a constant for each state. */
static void estimate_cost(nh_dependency_graph *w)
{
    nh_ex *e = nh_alloc_array(w->count + 1, sizeof *e);
    size_t n = 0;
    for (size_t j = 0; j < w->states; j++)
        if (w->kept[j]) e[n++] = w->row[j];
    nh_tape *tape = nh_dependency_graph_tape(w, n, e, 0, NULL, NULL);
    w->cost = nh_tape_length(tape) + cost_of_state * n;
    nh_tape_free(tape);
    nh_free(e);
}

/* ---- states that currents determine ---- */

static void copy_network(nh_dependency_graph *to, const nh_dependency_graph *from)
{
    size_t n = from->states, total = n + from->watches;
    *to = *from;
    to->row = nh_alloc_array(total + 1, sizeof *to->row);
    to->level = nh_alloc_array(n + 1, sizeof *to->level);
    to->feeds = nh_alloc_array(total * n + 1, sizeof *to->feeds);
    to->kept = nh_alloc_array(n + 1, sizeof *to->kept);
    memcpy(to->row, from->row, total * sizeof *to->row);
    memcpy(to->level, from->level, from->levels * sizeof *to->level);
    memcpy(to->feeds, from->feeds, total * n * sizeof *to->feeds);
    memcpy(to->kept, from->kept, n * sizeof *to->kept);
}

void nh_dependency_graph_clear(nh_dependency_graph *w)
{
    nh_free(w->row);
    nh_free(w->level);
    nh_free(w->feeds);
    nh_free(w->kept);
}

/* Does A have one sign at the probes, and is it never small? */
static bool determines(const nh_dependency_graph *w, nh_ex slope, nh_ex curvature)
{
    const nh_model *model = w->model;
    nh_ex e[2] = {slope, curvature};
    double *value = at_probes(w, 2, e), least = INFINITY, most = 0;
    bool good = model->chart->probes > 0;
    for (size_t p = 0; p < model->chart->probes && good; p++) {
        double a = value[2 * p];
        good = isfinite(a) && a * value[0] > 0 && fabs(value[2 * p + 1]) <= seems_zero * (1 + fabs(a));
        least = fmin(least, fabs(a));
        most = fmax(most, fabs(a));
    }
    nh_free(value);
    return good && least > steady * most && is_zero(w, curvature);
}

/* Removes state j by this current; false when the current does not determine it, or not at every time. */
static bool remove_state(nh_dependency_graph *w, nh_ex current, size_t j)
{
    const nh_model *model = w->model;
    nh_dag *d = model->dag;
    nh_ex x = symbol_of(model, j), zero = nh_int(d, 0), phi = current;
    for (size_t k = 0; k < w->levels; k++) {
        nh_ex v = symbol_of(model, w->level[k].state);
        phi = nh_substitute(d, phi, 1, &v, &w->level[k].value);
    }
    nh_ex slope = nh_diff(d, phi, x);
    if (nh_is_zero(d, slope) || nh_depends(d, slope, model->system->t) || !determines(w, slope, nh_diff(d, slope, x)))
        return false;
    slope = nh_substitute(d, slope, 1, &x, &zero);
    nh_level *l = &w->level[w->levels];
    *l = (nh_level){.current = current, .constant = nh_symbol_fresh(d, "c"), .state = j, .slope = slope};
    l->value = nh_div(d, nh_sub(d, l->constant, nh_substitute(d, phi, 1, &x, &zero)), slope);
    for (size_t i = 0; i < w->states + w->watches; i++) w->row[i] = nh_substitute(d, w->row[i], 1, &x, &l->value);
    for (size_t k = 0; k < w->levels; k++)
        w->level[k].value = nh_substitute(d, w->level[k].value, 1, &x, &l->value),
        w->level[k].slope = nh_substitute(d, w->level[k].slope, 1, &x, &l->value);
    w->row[j] = l->value;
    w->levels++;
    return true;
}

/* The best single removal, judged by values at the probes; false when none leaves fewer states. */
static bool improve(nh_dependency_graph *w, size_t n, const nh_ex *current)
{
    nh_dependency_graph best = {0};
    for (size_t c = 0; c < n; c++) {
        bool used = false;
        for (size_t k = 0; k < w->levels; k++) used |= w->level[k].current == current[c];
        for (size_t j = 0; j < w->states && !used; j++) {
            nh_dependency_graph trial;
            if (!w->kept[j]) continue;
            copy_network(&trial, w);
            bool better = remove_state(&trial, current[c], j);
            if (better) close_network(&trial, false);
            better = better && trial.count < w->count && (!best.row || trial.count <= best.count);
            if (better) estimate_cost(&trial);
            better =
                better && trial.cost < w->cost && (!best.row || trial.count < best.count || trial.cost < best.cost);
            if (better) nh_dependency_graph_clear(&best), best = trial;
            else nh_dependency_graph_clear(&trial);
        }
    }
    if (!best.row) return false;
    nh_dependency_graph_clear(w);
    *w = best;
    return true;
}

void nh_dependency_graph_init(nh_dependency_graph *w, const nh_model *o, size_t watches, const nh_ex *watched, size_t n,
                              const nh_ex *current)
{
    nh_dependency_graph plain = {.model = o, .states = o->m + o->n, .watches = watches}, small;
    size_t total = plain.states + watches;
    plain.row = nh_alloc_array(total + 1, sizeof *plain.row);
    plain.level = nh_alloc_array(plain.states + 1, sizeof *plain.level);
    plain.feeds = nh_alloc_array(total * plain.states + 1, sizeof *plain.feeds);
    plain.kept = nh_alloc_array(plain.states + 1, sizeof *plain.kept);
    memcpy(plain.row, o->rho, o->m * sizeof *plain.row);
    memcpy(plain.row + o->m, o->a, o->n * sizeof *plain.row);
    memcpy(plain.row + plain.states, watched, watches * sizeof *plain.row);
    close_network(&plain, true);
    estimate_cost(&plain);
    copy_network(&small, &plain);
    while (small.levels < small.states && !o->chart->implicit && improve(&small, n, current)) continue;
    if (small.levels) close_network(&small, true);
    bool better = small.count < plain.count;
    *w = better ? small : plain;
    nh_dependency_graph_clear(better ? &plain : &small);
}

bool nh_dependency_graph_ignores(const nh_dependency_graph *w, nh_ex symbol)
{
    nh_dag *d = w->model->dag;
    size_t probes = w->model->chart->probes;
    for (size_t k = 0; k < w->levels; k++)
        if (nh_depends(d, w->level[k].current, symbol)) return false;
    for (size_t a = 0; a < w->model->chart->implicit && w->implicit; a++)
        if (nh_depends(d, w->model->chart->residual[a], symbol)) return false;
    for (size_t i = 0; i < w->states + w->watches; i++) {
        nh_ex e[2] = {i < w->states && !w->kept[i] ? nh_int(d, 0) : nh_diff(d, w->row[i], symbol), w->row[i]};
        if (nh_is_zero(d, e[0])) continue;
        double *value = at_probes(w, 2, e);
        bool zero = probes > 0;
        for (size_t p = 0; p < probes && zero; p++)
            zero = fabs(value[2 * p]) <= seems_zero * (1 + fabs(value[2 * p + 1]));
        nh_free(value);
        if (!zero || !is_zero(w, e[0])) return false;
    }
    return true;
}

bool nh_dependency_graph_conserved(const nh_model *model, nh_ex current)
{
    nh_dependency_graph w = {.model = model};
    nh_ex e[2] = {nh_model_gamma(model, current), current};
    double *value = at_probes(&w, 2, e);
    bool good = model->chart->probes > 0;
    for (size_t p = 0; p < model->chart->probes && good; p++)
        good = fabs(value[2 * p]) <= seems_zero * (1 + fabs(value[2 * p + 1]));
    nh_free(value);
    return good && is_zero(&w, e[0]);
}

size_t nh_dependency_graph_cyclic(const nh_model *model, nh_ex *out)
{
    const nh_system *system = model->system;
    size_t n = 0;
    for (size_t i = 0; i < model->m; i++) {
        bool cyclic = nh_is_zero(model->dag, system->force[i]) &&
                      nh_is_zero(model->dag, nh_diff(model->dag, system->lagrangian, system->coordinate[i].q));
        for (size_t a = 0; a < model->k && cyclic; a++) cyclic = nh_is_zero(model->dag, model->nu[a * model->m + i]);
        if (cyclic) out[n++] = model->p[i];
    }
    return n;
}

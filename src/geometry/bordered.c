/* bordered: the tape of [K | h | F | g | f] and the solution of the saddle (base/saddle.h).
 *
 *     value        K        h      F       g     f
 *     size       m x m      m    k x m     k     k           one array of doubles in this order;
 *     layout     columns         columns                     K[s + r m] = d2L/dv^s dv^r, F[a + s k] = df^a/dv^s
 *
 * Of a chain of bodies h and K come from its recursion (nh_chain_bias), not from derivatives of a long L. */
#include "geometry/bordered.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "base/saddle.h"
#include "graph/diff.h"
#include "exact/normal.h"
#include "exact/walls.h"
#include "graph/dag.h"

/* A simplified formula that would be much longer is not used: it is evaluated at every step. */
nh_ex nh_constraint_without_poles(const nh_model *model, size_t a)
{
    enum { short_enough = 300, growth = 2 };
    nh_dag *d = model->dag;
    nh_ex f = nh_chart_constraint(model->chart, a), numerator = nh_numerator(d, f);
    size_t length = nh_complexity(d, numerator);
    return length <= short_enough || length <= growth * nh_complexity(d, f) ? numerator : f;
}

struct nh_bordered {
    const nh_system *system;
    size_t m, k;
    nh_tape *tape; /* K, h, F, g, f */
    nh_tape_work *work;
    size_t walls;
    nh_tape *wall; /* NULL: there are none */
    nh_tape_work *wall_work;
    double *in, *out;
    double *terms, *saddle, *right; /* values of the tape; work memory and right-hand side of the solution */
    double *two;                    /* two right-hand sides, and their solutions without multipliers */
    double *unit;                   /* m: size of each velocity, so that those of lengths and angles compare */
};

/* h_s = dp_s/dt without v' - dL/dq^s - Q_s with dp_s/dt = p_t + p_q v; g^a = f^a_t + f^a_q v. */
void nh_bordered_expressions(const nh_model *model, nh_ex *K, nh_ex *h, nh_ex *F, nh_ex *g, nh_ex *f)
{
    const nh_system *system = model->system;
    nh_dag *d = model->dag;
    size_t m = model->m, k = model->k;
    nh_ex *q = nh_alloc_array(2 * m, sizeof *q), *v = q + m;
    for (size_t s = 0; s < m; s++) q[s] = system->coordinate[s].q, v[s] = system->coordinate[s].v;
    nh_ex rest = system->lagrangian; /* the part of L that does not come from bodies and joints */
    const nh_chain *chain = nh_model_chain(model, &rest);
    if (chain)
        nh_chain_bias(chain, &(nh_chain_scope){.dag = d, .arena = model->arena, .t = system->t, .m = m, .q = q, .v = v},
                      h);
    for (size_t s = 0; s < m; s++) {
        nh_ex p = nh_diff(d, rest, v[s]), own = chain ? h[s] : nh_int(d, 0);
        h[s] = nh_sub(d, nh_diff(d, p, system->t), nh_add(d, nh_diff(d, rest, q[s]), system->force[s]));
        h[s] = nh_add(d, h[s], nh_diff_along(d, p, m, q, v));
        if (chain) h[s] = nh_add(d, h[s], own);
        for (size_t r = 0; r < m; r++) K[s + r * m] = nh_diff(d, p, v[r]);
        for (size_t r = 0; r < m && chain; r++) K[s + r * m] = nh_add(d, K[s + r * m], chain->K[s * m + r]);
    }
    for (size_t a = 0; a < k; a++) {
        f[a] = nh_constraint_without_poles(model, a);
        g[a] = nh_add(d, nh_diff(d, f[a], system->t), nh_diff_along(d, f[a], m, q, v));
        for (size_t s = 0; s < m; s++) F[a + s * k] = nh_diff(d, f[a], v[s]);
    }
    nh_free(q);
}

nh_bordered *nh_bordered_create(const nh_model *model)
{
    const nh_system *system = model->system;
    nh_dag *d = model->dag;
    size_t m = model->m, k = model->k, total = m * m + m + k * m + 2 * k;
    nh_ex *in = nh_alloc_array(1 + 2 * m, sizeof *in), *out = nh_alloc_array(total + 1, sizeof *out);
    in[0] = system->t;
    for (size_t s = 0; s < m; s++) {
        in[1 + s] = system->coordinate[s].q;
        in[1 + m + s] = system->coordinate[s].v;
    }
    nh_bordered_expressions(model, out, out + m * m, out + m * m + m, out + m * m + m + k * m,
                            out + m * m + m + k * m + k);
    nh_bordered *b = nh_alloc(sizeof *b);
    *b = (nh_bordered){.system = system,
                       .m = m,
                       .k = k,
                       .in = nh_alloc_array(1 + 2 * m, sizeof *b->in),
                       .out = nh_alloc_array(total + 1, sizeof *b->out)};
    b->terms = nh_alloc_array(total + 1, sizeof *b->terms);
    b->saddle = nh_alloc_array(nh_saddle_work(m, k), sizeof *b->saddle);
    b->right = nh_alloc_array(m + k, sizeof *b->right);
    b->two = nh_alloc_array(2 * (m + k) + 2 * m, sizeof *b->two);
    b->unit = nh_alloc_array(m + 1, sizeof *b->unit);
    for (size_t s = 0; s < m; s++) b->unit[s] = nh_chart_unit(system, s);
    b->tape =
        nh_tape_create(d, 1 + 2 * m, in, total, out, system->parameters, model->parameter, model->parameter_value);
    b->work = nh_tape_work_create(b->tape);
    nh_ex wall[NH_MOST_WALLS];
    b->walls = nh_walls_between(d, total, out, 1 + 2 * m, in, wall);
    if (b->walls)
        b->wall = nh_tape_create(d, 1 + 2 * m, in, b->walls, wall, system->parameters, model->parameter,
                                 model->parameter_value),
        b->wall_work = nh_tape_work_create(b->wall);
    nh_free(in);
    nh_free(out);
    return b;
}

void nh_bordered_jit(nh_bordered *b, double patience) { nh_tape_jit(b->work, patience); }
const char *nh_bordered_words(const nh_bordered *b) { return nh_tape_words(b->work); }

void nh_bordered_free(nh_bordered *b)
{
    if (!b) return;
    nh_tape_work_free(b->work);
    nh_tape_free(b->tape);
    nh_tape_work_free(b->wall_work);
    nh_tape_free(b->wall);
    nh_free(b->in);
    nh_free(b->out);
    nh_free(b->terms);
    nh_free(b->saddle);
    nh_free(b->right);
    nh_free(b->two);
    nh_free(b->unit);
    nh_free(b);
}

/* Divides every constraint by |df/dv|, in units of the velocities, so that its multiplier has the size of the reaction
 * in all units of length. */
static void normalise(size_t m, size_t k, const double *unit, double *F)
{
    double *g = F + k * m, *f = g + k;
    for (size_t a = 0; a < k; a++) {
        double norm = 0;
        for (size_t s = 0; s < m; s++) norm = hypot(norm, F[a + s * k] * unit[s]);
        if (!(norm > 0)) continue;
        for (size_t s = 0; s < m; s++) F[a + s * k] /= norm;
        g[a] /= norm;
        f[a] /= norm;
    }
}

size_t nh_bordered_coordinates(const nh_bordered *b) { return b->m; }
const nh_system *nh_bordered_system(const nh_bordered *b) { return b->system; }

size_t nh_bordered_constraints(const nh_bordered *b) { return b->k; }

size_t nh_bordered_walls(const nh_bordered *b) { return b->walls; }

void nh_bordered_wall(nh_bordered *b, double t, const double *state, double *value)
{
    b->in[0] = t;
    memcpy(b->in + 1, state, 2 * b->m * sizeof *state);
    nh_tape_eval(b->wall, b->wall_work, b->in, value);
}

bool nh_bordered_terms(nh_bordered *b, double t, const double *q, const double *v, double *K, double *h, double *F,
                       double *g, double *f)
{
    size_t m = b->m, k = b->k;
    b->in[0] = t;
    memcpy(b->in + 1, q, m * sizeof *q);
    memcpy(b->in + 1 + m, v, m * sizeof *v);
    nh_tape_eval(b->tape, b->work, b->in, b->out);
    double *x = b->out;
    normalise(m, k, b->unit, x + m * m + m);
    memcpy(K, x, m * m * sizeof *x);
    memcpy(h, x + m * m, m * sizeof *x);
    memcpy(F, x + m * m + m, k * m * sizeof *x);
    memcpy(g, x + m * m + m + k * m, k * sizeof *x);
    memcpy(f, x + m * m + m + k * m + k, k * sizeof *x);
    return nh_all_finite(m * m + m + k * m + 2 * k, x);
}

bool nh_bordered_accelerations(nh_bordered *b, double t, const double *q, const double *v, double *acceleration)
{
    size_t m = b->m, k = b->k;
    double *h = b->terms + m * m, *F = h + m, *g = F + k * m, *f = g + k;
    return nh_bordered_terms(b, t, q, v, b->terms, h, F, g, f) &&
           nh_saddle_solve(m, k, b->terms, F, h, g, acceleration, NULL, NULL, b->saddle);
}

/* Two right-hand sides with one factorisation: (h, g) gives v', and (0, f) the step to f = 0 that is least in the
 * metric K. */
bool nh_bordered_rates(nh_bordered *b, double t, const double *q, const double *v, double *acceleration, double *change)
{
    size_t m = b->m, k = b->k;
    double *h = b->terms + m * m, *F = h + m, *g = F + k * m, *f = g + k, *two = b->two, *solution = two + 2 * (m + k);
    memset(change, 0, m * sizeof *change);
    if (!k) return nh_bordered_accelerations(b, t, q, v, acceleration);
    if (!nh_bordered_terms(b, t, q, v, b->terms, h, F, g, f)) return false;
    memcpy(two, h, m * sizeof *h);
    memset(two + m, 0, m * sizeof *two);
    memcpy(two + 2 * m, g, 2 * k * sizeof *g); /* g, f */
    if (!nh_saddle_solve_two(m, k, b->terms, F, two, two + 2 * m, solution, b->saddle)) return false;
    memcpy(acceleration, solution, m * sizeof *acceleration);
    memcpy(change, solution + m, m * sizeof *change);
    return true;
}

void nh_bordered_accelerations_batch(nh_bordered *b, size_t count, const double *const *in, size_t stride, double *to)
{
    size_t m = b->m, k = b->k, total = m * m + m + k * m + 2 * k;
    double *h = b->terms + m * m, *F = h + m, *g = F + k * m,
           *column = nh_alloc_array(total * NH_BATCH, sizeof *column);
    double **out = nh_alloc_array(total, sizeof *out);
    for (size_t i = 0; i < total; i++) out[i] = column + i * NH_BATCH;
    nh_tape_eval_batch(b->tape, b->work, count, in, out);
    for (size_t j = 0; j < count; j++) {
        for (size_t i = 0; i < total; i++) b->terms[i] = out[i][j];
        normalise(m, k, b->unit, F);
        bool good =
            nh_all_finite(total, b->terms) && nh_saddle_solve(m, k, b->terms, F, h, g, b->right, NULL, NULL, b->saddle);
        for (size_t s = 0; s < m; s++) to[s * stride + j] = good ? b->right[s] : NAN;
    }
    nh_free(out);
    nh_free(column);
}

bool nh_bordered_force(nh_bordered *b, double t, const double *q, const double *v, const double *mu, double *force)
{
    size_t m = b->m, k = b->k;
    double *h = b->terms + m * m, *F = h + m, *g = F + k * m, *f = g + k;
    bool good = nh_bordered_terms(b, t, q, v, b->terms, h, F, g, f);
    for (size_t s = 0; s < m; s++) {
        force[s] = 0;
        for (size_t a = 0; a < k; a++) force[s] += mu[a] * F[a + s * k];
    }
    return good;
}

/* Gauss-Newton: at each step the shortest change x of the velocities, in their units, with F x = -f. */
bool nh_bordered_project(nh_bordered *b, double t, const double *q, const bool *fixed, double *v)
{
    enum { most_steps = 60 };
    /* largest last step, and largest remainder of the constraints, relative to the velocities */
    static const double converged = 1e-12, satisfied = 1e-9;
    size_t m = b->m, k = b->k;
    double *h = b->terms + m * m, *F = h + m, *g = F + k * m, *f = g + k;
    for (int step = 0; step < most_steps && k; step++) {
        double size = 0, speed = 0, left = 0;
        if (!nh_bordered_terms(b, t, q, v, b->terms, h, F, g, f)) return false;
        memset(b->right, 0, (m + k) * sizeof *b->right);
        for (size_t a = 0; a < k; a++) b->right[a] = -f[a];
        for (size_t s = 0; s < m; s++)
            for (size_t a = 0; a < k; a++) F[a + s * k] *= fixed && fixed[s] ? 0 : b->unit[s];
        /* the shortest of the solutions; 0 where fixed */
        if (nh_least_squares(k, m, F, 1, b->right, m + k, 1e-12) < 0) return false;
        for (size_t s = 0; s < m; s++) {
            v[s] += b->right[s] * b->unit[s];
            size = fmax(size, fabs(b->right[s]));
            speed = fmax(speed, fabs(v[s]) / b->unit[s]);
        }
        for (size_t a = 0; a < k; a++) left = fmax(left, fabs(f[a]));
        if (size <= converged * speed) return left <= satisfied * speed;
    }
    return k == 0;
}

/* projected_points: Newton's method for f^a(t, q, v) = 0 and, for quasi-velocities, rho(t, q, w) = v.
 *
 *     solve     in doubles, x := x - J f with the pseudo-inverse J of df/dx: the shortest step
 *     refine    in balls with the same J, until all digits are right */
#include "integrals/projected_points.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "base/memory.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "integrals/exact_points.h"

enum { most_steps = 40, digits_of_a_step = 5 };
static const double small_step = 1e-14, dependent = 1e-15, exact_enough = 1e-20, same_branch = 1e-6;

/* Equations f(x) = 0 for `unknowns` symbols x, by x := x - J f with a pseudo-inverse J of df/dx. */
typedef struct {
    size_t unknowns, equations;
    nh_ex *x, *f;                /* borrowed; */
    nh_ex *entry, *step, *fresh; /* J (unknowns x equations, column-major), J f, and the next x */
    nh_tape *tape;               /* f and df/dx (equations x unknowns, column-major) */
    nh_tape_work *work;
    double *out, *inverse;
} newton;

struct nh_projector {
    const nh_model *o;
    nh_ball *ball;
    size_t m, k, n, inputs;
    nh_ex *in;                 /* t, q, v, w of quasi-velocities */
    double *at;                /* their values */
    newton constraints, chart; /* f^a(t, q, v) = 0 for v; rho(t, q, w) - v = 0 for quasi-velocities w */
};

/* ---- one system of equations ---- */

/* Programs for f and J = df/dx (equations x unknowns, column-major), and the expressions of J^T f with symbols for J.
 */
static void newton_create(nh_projector *p, newton *s, size_t unknowns, nh_ex *x, size_t equations, nh_ex *f)
{
    nh_dag *d = p->o->dag;
    size_t n = equations * unknowns;
    nh_ex *all = nh_alloc_array(equations + n + 1, sizeof *all);
    s->unknowns = unknowns, s->equations = equations, s->x = x, s->f = f;
    s->entry = nh_alloc_array(n + 2 * unknowns + 1, sizeof *s->entry);
    s->step = s->entry + n;
    s->fresh = s->step + unknowns;
    for (size_t a = 0; a < equations; a++) {
        all[a] = f[a];
        for (size_t j = 0; j < unknowns; j++) all[equations + a + j * equations] = nh_diff(d, f[a], x[j]);
    }
    for (size_t i = 0; i < n; i++) s->entry[i] = nh_symbol_fresh(d, "J");
    for (size_t j = 0; j < unknowns; j++) {
        s->fresh[j] = nh_symbol_fresh(d, "v");
        s->step[j] = nh_int(d, 0);
        for (size_t a = 0; a < equations; a++)
            s->step[j] = nh_add(d, s->step[j], nh_mul(d, s->entry[j + a * unknowns], f[a]));
    }
    s->tape = nh_tape_create(d, p->inputs, p->in, equations + n, all, p->o->system->parameters, p->o->parameter,
                             p->o->parameter_value);
    s->work = nh_tape_work_create(s->tape);
    s->out = nh_alloc_array(equations + n + 1, sizeof *s->out);
    s->inverse = nh_alloc_array(n + 1, sizeof *s->inverse);
    nh_free(all);
}

static void newton_clear(newton *s)
{
    nh_free(s->inverse);
    nh_free(s->out);
    nh_tape_work_free(s->work);
    nh_tape_free(s->tape);
    nh_free(s->entry);
}

/* J at the point p->at; each equation is first divided by its largest derivative. */
static bool invert(nh_projector *p, newton *s)
{
    size_t n = s->unknowns, r = s->equations, big = n > r ? n : r;
    nh_tape_eval(s->tape, s->work, p->at, s->out);
    if (!nh_all_finite(r + r * n, s->out)) return false;
    double *a = nh_alloc_array(r * n + big * r + 1, sizeof *a), *b = a + r * n;
    for (size_t i = 0; i < r; i++) {
        double most = 0;
        for (size_t j = 0; j < n; j++) most = fmax(most, fabs(s->out[r + i + j * r]));
        for (size_t j = 0; j < n; j++) a[i + j * r] = most > 0 ? s->out[r + i + j * r] / most : 0;
        b[i + i * big] = most > 0 ? 1 / most : 0;
    }
    bool good = nh_least_squares(r, n, a, r, b, big, dependent) >= 0;
    for (size_t i = 0; i < r; i++)
        for (size_t j = 0; j < n; j++) s->inverse[j + i * n] = b[j + i * big];
    nh_free(a);
    return good && nh_all_finite(n * r, s->inverse);
}

/* Iterates from the values x, which are also in p->at. */
static bool solve(nh_projector *p, newton *s, double *x)
{
    for (int step = 0; step < most_steps; step++) {
        double largest = 0, moved = 0;
        if (!invert(p, s)) return false;
        for (size_t j = 0; j < s->unknowns; j++) {
            double by = 0;
            for (size_t a = 0; a < s->equations; a++) by += s->inverse[j + a * s->unknowns] * s->out[a];
            x[j] -= by;
            moved = fmax(moved, fabs(by));
            largest = fmax(largest, fabs(x[j]));
        }
        if (moved <= small_step * largest) return true;
    }
    return false;
}

/* Continues in balls with the same J: each step gains the digits that J has. */
static bool refine(nh_projector *p, newton *s)
{
    double largest = 0, moved = 0, value, radius;
    for (size_t i = 0; i < s->unknowns * s->equations; i++) nh_ball_set_double(p->ball, s->entry[i], s->inverse[i]);
    for (long step = 0; step < 2 + nh_ball_bits(p->ball) / (4 * digits_of_a_step); step++) {
        for (size_t j = 0; j < s->unknowns; j++)
            nh_ball_set_middle(p->ball, s->fresh[j], nh_sub(p->o->dag, s->x[j], s->step[j]));
        for (size_t j = 0; j < s->unknowns; j++) nh_ball_set_middle(p->ball, s->x[j], s->fresh[j]);
    }
    for (size_t j = 0; j < s->unknowns; j++) {
        if (!nh_ball_value(p->ball, s->step[j], &value, &radius)) return false;
        moved = fmax(moved, fabs(value));
        if (!nh_ball_value(p->ball, s->x[j], &value, &radius)) return false;
        largest = fmax(largest, fabs(value));
    }
    return moved <= exact_enough * largest;
}

/* ---- the points ---- */

nh_projector *nh_projector_create(const nh_model *model, nh_ball *ball)
{
    const nh_system *system = model->system;
    if (!model->chart->quasi && model->k == 0) return NULL;
    nh_projector *p = nh_alloc(sizeof *p);
    size_t m = model->m, quasi = model->chart->quasi ? model->n : 0;
    *p = (nh_projector){.o = model, .ball = ball, .m = m, .k = model->k, .n = model->n, .inputs = 1 + 2 * m + quasi};
    p->in = nh_alloc_array(p->inputs + model->k + m, sizeof *p->in);
    p->at = nh_alloc_array(p->inputs, sizeof *p->at);
    p->in[0] = system->t;
    nh_ex *f = p->in + p->inputs, *difference = f + model->k;
    for (size_t s = 0; s < m; s++) {
        p->in[1 + s] = system->coordinate[s].q;
        p->in[1 + m + s] = system->coordinate[s].v;
        difference[s] = nh_sub(model->dag, model->rho[s], system->coordinate[s].v);
    }
    for (size_t i = 0; i < quasi; i++) p->in[1 + 2 * m + i] = model->chart->w[i];
    for (size_t a = 0; a < model->k; a++)
        f[a] = nh_sub(model->dag, system->constraint[a].lhs, system->constraint[a].rhs);
    newton_create(p, &p->constraints, m, p->in + 1 + m, model->k, f);
    newton_create(p, &p->chart, quasi, p->in + 1 + 2 * m, quasi ? m : 0, difference);
    return p;
}

void nh_projector_free(nh_projector *p)
{
    if (!p) return;
    newton_clear(&p->chart);
    newton_clear(&p->constraints);
    nh_free(p->at);
    nh_free(p->in);
    nh_free(p);
}

bool nh_projected_point(nh_projector *p, const double *position, const double *v, double *z)
{
    const nh_chart *c = p->o->chart;
    double *velocity = p->at + 1 + p->m, *quasi = velocity + p->m;
    memcpy(p->at, position, (1 + p->m) * sizeof *position);
    memcpy(velocity, v, p->m * sizeof *v);
    for (size_t i = 0; i < p->chart.unknowns; i++) quasi[i] = 0;
    if (p->k && !solve(p, &p->constraints, velocity)) return false;
    if (c->quasi && !solve(p, &p->chart, quasi)) return false;
    memcpy(z, position, (1 + p->m) * sizeof *z);
    for (size_t i = 0; i < p->n; i++) z[1 + p->m + i] = c->quasi ? quasi[i] : velocity[c->free[i]];
    for (size_t i = 0; i < c->implicit; i++) z[1 + p->m + p->n + i] = velocity[c->dependent[i]];
    return true;
}

/* Are the velocities of z the given ones, and not those of another branch? */
static bool gives_velocity(nh_projector *p, double *z)
{
    const double *velocity = p->at + 1 + p->m;
    double largest = nh_norm(p->m, velocity), value, radius;
    if (!nh_exact_at(p->o, p->ball, z)) return false;
    for (size_t s = 0; s < p->m; s++) {
        if (!nh_ball_value(p->ball, p->o->rho[s], &value, &radius)) return false;
        if (fabs(value - velocity[s]) > same_branch * largest) return false;
    }
    return true;
}

bool nh_projected_exact_point(nh_projector *p, const double *position, const double *v, double *z)
{
    const nh_chart *c = p->o->chart;
    double radius;
    if (!nh_projected_point(p, position, v, z)) return false;
    for (size_t j = 0; j < p->inputs; j++) nh_ball_set_double(p->ball, p->in[j], p->at[j]);
    if ((p->k && !refine(p, &p->constraints)) || (c->quasi && !refine(p, &p->chart))) return false;
    for (size_t i = 0; i < p->n; i++)
        if (!nh_ball_value(p->ball, c->w[i], &z[1 + p->m + i], &radius)) return false;
    return gives_velocity(p, z);
}

/* A projection of states onto the level set of currents (projection.h): Gauss-Newton steps of least norm.
 *
 *      J: d Phi_k/dz_j, currents x size;  D = diag(s_i^2)
 *
 *      z <- z + D J^T (J D J^T)^+ (Phi(z0) - Phi(z)),     with rows scaled to norm 1 before the rank decision */
#include "motion/projection.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "graph/diff.h"
#include "motion/dynamics.h"
#include "motion/sizes.h"

enum { most_steps = 3 };
static const double independent = 1e-6; /* relative size of a singular value below which rows depend on each other */

struct nh_projection {
    const nh_model *model;
    size_t size, currents;
    nh_tape *tape; /* values, then d Phi_k / dz_j at [k + j * currents] */
    nh_tape_work *work;
    double *point, *out, *wanted, *scale, *matrix, *right;
    long evaluations;
};

/* The units in which states are moved: their sizes. */
static void measure_sizes(nh_projection *p, double t, double end, const double *z0)
{
    nh_dynamics *d = nh_dynamics_create(p->model);
    nh_flow_problem problem = nh_dynamics_problem(d);
    nh_sizes sizes;
    bool known = nh_sizes_begin(&sizes, &problem, 1, z0, t, end);
    for (size_t j = 0; j < p->size; j++) p->scale[j] = known ? sizes.size[j] : z0[j] != 0 ? fabs(z0[j]) : 1;
    nh_sizes_clear(&sizes);
    nh_dynamics_free(d);
}

nh_projection *nh_projection_create(const nh_model *model, size_t currents, const nh_ex *current, double t, double end,
                                    const double *z0)
{
    nh_projection *p = nh_alloc(sizeof *p);
    size_t size = model->m + model->n, total = currents * (1 + size), tall = currents > size ? currents : size;
    *p = (nh_projection){.model = model, .size = size, .currents = currents};
    nh_ex *e = nh_alloc_array(total + 1, sizeof *e);
    for (size_t k = 0; k < currents; k++) {
        e[k] = current[k];
        for (size_t j = 0; j < size; j++)
            e[currents + k + j * currents] = nh_diff(model->dag, current[k], model->chart->symbol[1 + j]);
    }
    p->tape = nh_model_tape(model, total, e);
    p->work = nh_tape_work_create(p->tape);
    nh_free(e);
    p->point = nh_alloc_array(model->width, sizeof *p->point);
    p->out = nh_alloc_array(total + 1, sizeof *p->out);
    p->wanted = nh_alloc_array(currents + 1, sizeof *p->wanted);
    p->scale = nh_alloc_array(size, sizeof *p->scale);
    p->matrix = nh_alloc_array(total + size + 1, sizeof *p->matrix);
    p->right = nh_alloc_array(tall + 1, sizeof *p->right);
    p->point[0] = t;
    memcpy(p->point + 1, z0, size * sizeof *z0);
    nh_tape_eval(p->tape, p->work, p->point, p->out);
    memcpy(p->wanted, p->out, currents * sizeof *p->wanted);
    measure_sizes(p, t, end, z0);
    return p;
}

/* The first currents whose gradients (rows of J D at a point (t, q, w)) are independent, the others left out:
   Gram-Schmidt, twice. */
static void independent_rows(nh_projection *p, const double *point, bool *left_out)
{
    size_t r = p->currents, n = p->size, kept = 0;
    memcpy(p->point, point, (1 + n) * sizeof *point);
    nh_tape_eval(p->tape, p->work, p->point, p->out);
    for (size_t k = 0; k < r; k++) {
        double *row = p->matrix + kept * n;
        for (size_t j = 0; j < n; j++) row[j] = p->out[r + k + j * r] * p->scale[j];
        double size = nh_norm(n, row), rest = size;
        for (int pass = 0; pass < 2; pass++)
            for (size_t i = 0; i < kept; i++) {
                double dot = 0;
                for (size_t j = 0; j < n; j++) dot += row[j] * p->matrix[i * n + j];
                for (size_t j = 0; j < n; j++) row[j] -= dot * p->matrix[i * n + j];
            }
        rest = nh_norm(n, row);
        left_out[k] = !(rest > independent * size) || !isfinite(rest);
        for (size_t j = 0; j < n && !left_out[k]; j++) row[j] /= rest;
        kept += !left_out[k];
    }
}

size_t nh_projection_choose(const nh_model *model, size_t currents, const nh_ex *current, double t, double end,
                            const double *z0, const char **why)
{
    nh_projection *p = nh_projection_create(model, currents, current, t, end, z0);
    /* independent at some probe; omitted here */
    bool *anywhere = nh_alloc_array(2 * currents + 1, sizeof *anywhere), *out = anywhere + currents;
    double *start = nh_alloc_array(model->width, sizeof *start);
    size_t chosen = 0;
    memcpy(start, p->point, (1 + p->size) * sizeof *start);
    for (size_t i = 0; i < model->chart->probes; i++) {
        memset(out, 0, currents * sizeof *out);
        independent_rows(p, model->chart->probe + i * model->width, out);
        for (size_t k = 0; k < currents; k++) anywhere[k] |= !out[k];
    }
    memset(out, 0, currents * sizeof *out);
    independent_rows(p, start, out);
    for (size_t k = 0; k < currents; k++) {
        why[k] =
            !out[k] ? NULL
            : anywhere[k]
                ? "at the initial state its gradient vanishes or depends on the gradients of the currents before it"
                : "it depends on the currents before it";
        chosen += !why[k];
    }
    nh_free(start);
    nh_free(anywhere);
    nh_projection_free(p);
    return chosen;
}

void nh_projection_free(nh_projection *p)
{
    if (!p) return;
    nh_tape_work_free(p->work);
    nh_tape_free(p->tape);
    nh_free(p->point);
    nh_free(p->out);
    nh_free(p->wanted);
    nh_free(p->scale);
    nh_free(p->matrix);
    nh_free(p->right);
    nh_free(p);
}

/* Makes one Gauss-Newton step, and returns its size, or infinity.  Rows are scaled to norm 1, so that the rank does not
 * depend on the currents' units. */
static double project_once(nh_projection *p, double *z)
{
    size_t r = p->currents, n = p->size;
    double worst = 0;
    nh_tape_eval(p->tape, p->work, p->point, p->out);
    p->evaluations++;
    for (size_t k = 0; k < r; k++) {
        double norm = 0;
        for (size_t j = 0; j < n; j++) norm = hypot(norm, p->out[r + k + j * r] * p->scale[j]);
        if (!isfinite(norm) || !isfinite(p->out[k])) return INFINITY;
        norm = norm > 0 ? norm : 1;
        for (size_t j = 0; j < n; j++) p->matrix[k + j * r] = p->out[r + k + j * r] * p->scale[j] / norm;
        p->right[k] = (p->wanted[k] - p->out[k]) / norm;
    }
    if (nh_least_squares(r, n, p->matrix, 1, p->right, r > n ? r : n, independent) < 0) return INFINITY;
    for (size_t j = 0; j < n; j++) {
        z[j] += p->scale[j] * p->right[j];
        worst = fmax(worst, fabs(p->right[j]));
    }
    return worst;
}

/* At most most_steps steps; fewer where one is below rounding. */
bool nh_projection_apply(double t, double *z, void *context)
{
    nh_projection *p = context;
    double change = 1;
    for (int i = 0; i < most_steps && change > 1e-15; i++) {
        p->point[0] = t;
        memcpy(p->point + 1, z, p->size * sizeof *z);
        change = project_once(p, z);
    }
    return isfinite(change);
}

long nh_projection_evaluations(const nh_projection *p) { return p->evaluations; }

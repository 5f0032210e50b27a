/* group_walls: the fields of a group along which no wall moves at which the Lagrangian, a force or a constraint jumps
 * or has a kink. */
#include <math.h>
#include <string.h>

#include "exact/walls.h"
#include "graph/diff.h"
#include "reduction/group.h"
#include "reduction/subspace.h"

enum { most_places = 8, steps = 30 };

/* Walls u = 0 of the coordinates, each with its gradient. */
typedef struct {
    const nh_kinetic *k;
    size_t count;
    nh_ex *e;      /* count x (1 + m): u, du/dq */
    double *value; /* of one of them */
} walls;

/* The jumps of atan2 and similar functions are constants: they are no walls for functions of angles. */
static size_t walls_of(const nh_kinetic *k, nh_ex *u)
{
    const nh_system *system = k->model->system;
    nh_walls all = {0};
    size_t count = 0;
    nh_walls_add(&all, k->dag, system->lagrangian);
    for (size_t i = 0; i < k->m && system->has_forces; i++) nh_walls_add(&all, k->dag, system->force[i]);
    for (size_t a = 0; a < k->f; a++) nh_walls_add(&all, k->dag, k->force[a]);
    for (size_t i = 0; i < all.count; i++) {
        bool here = false, elsewhere = nh_depends(k->dag, all.e[i], system->t);
        for (size_t j = 0; j < k->m; j++) {
            here |= nh_depends(k->dag, all.e[i], k->q[j]);
            elsewhere |= nh_depends(k->dag, all.e[i], k->v[j]);
        }
        if (here && !elsewhere && !all.edge[i] && !all.cut[i]) u[count++] = all.e[i];
    }
    return count;
}

static bool open_walls(walls *w, const nh_kinetic *k)
{
    nh_ex u[NH_MOST_WALLS];
    size_t m = k->m;
    *w = (walls){.k = k, .count = walls_of(k, u)};
    if (!w->count) return false;
    w->e = nh_alloc_array(w->count * (m + 1), sizeof *w->e);
    w->value = nh_alloc_array(m + 1, sizeof *w->value);
    for (size_t i = 0; i < w->count; i++) {
        w->e[i * (m + 1)] = u[i];
        for (size_t s = 0; s < m; s++) w->e[i * (m + 1) + 1 + s] = nh_diff(k->dag, u[i], k->q[s]);
    }
    return true;
}

static void close_walls(walls *w)
{
    nh_free(w->e);
    nh_free(w->value);
}

/* Newton steps from q to wall number i, along the gradient of its function in units of the coordinates.  `value` then
 * has the function and its gradient there. */
static bool go_to(walls *w, size_t i, const double *unit, double *q)
{
    static const double near = 1e-12;
    size_t m = w->k->m;
    for (int step = 0; step < steps; step++) {
        double square = 0, size = 0, u;
        nh_kinetic_values(w->k, m + 1, w->e + i * (m + 1), q, w->value);
        u = w->value[0];
        for (size_t s = 0; s < m; s++) {
            double slope = w->value[1 + s] * unit[s];
            square += slope * slope;
            size += fabs(slope) * fmax(1, fabs(q[s]) / unit[s]);
        }
        if (!isfinite(u) || !isfinite(square) || !(square > 0)) return false;
        if (fabs(u) <= near * size) return true;
        for (size_t s = 0; s < m; s++) q[s] -= u * w->value[1 + s] * unit[s] * unit[s] / square;
    }
    return false;
}

/* The columns' combinations that vanish in all rows, with whole numbers where there are some. */
static size_t combinations(size_t rows, size_t d, double *a, const double *size, const nh_options *options, double *c)
{
    for (size_t i = 0; i < rows * d; i++) a[i] /= size[i / rows] > 0 ? size[i / rows] : 1;
    size_t n = nh_kernel(rows, d, a, options->group, c, NULL, NULL);
    for (size_t i = 0; i < n * d; i++) c[i] /= size[i % d] > 0 ? size[i % d] : 1;
    nh_column_echelon(d, n, options->group, c);
    return n;
}

/* One row: the rates at which d fields (columns of length `stride`) change u; `size` takes the fields' own. */
static void put_row(const walls *w, const double *unit, size_t d, size_t stride, const double *field, size_t rows,
                    double *row, double *size)
{
    size_t m = w->k->m;
    double slope = 0;
    for (size_t s = 0; s < m; s++) slope += fabs(w->value[1 + s]) * unit[s];
    for (size_t e = 0; e < d; e++) {
        double rate = 0;
        for (size_t s = 0; s < m; s++) {
            rate += w->value[1 + s] * field[s + e * stride];
            size[e] = fmax(size[e], fabs(field[s + e * stride]) / unit[s]);
        }
        row[e * rows] = slope > 0 && isfinite(rate) ? rate / slope : 0;
    }
}

size_t nh_group_jets_within_walls(const nh_jets *j, const nh_kinetic *k, const nh_options *options)
{
    size_t m = k->m, d = j->dimension, stride = m + m * m, places = j->places;
    walls w;
    if (!d || !open_walls(&w, k)) return d;
    size_t rows = places * w.count;
    double *a = nh_alloc_array(rows * d + d * d + m + d + 1, sizeof *a), *c = a + rows * d, *unit = c + d * d,
           *size = unit + m;
    nh_kinetic_sizes(k, k->places, unit);
    for (size_t r = 0; r < rows; r++) {
        size_t p = r / w.count;
        nh_kinetic_values(k, m + 1, w.e + r % w.count * (m + 1), j->end + p * m, w.value);
        put_row(&w, unit, d, stride, j->moved + p * stride * d, rows, a + r, size);
    }
    size_t n = combinations(rows, d, a, size, options, c);
    nh_free(a);
    close_walls(&w);
    return n;
}

nh_group *nh_group_within_walls(const nh_group *g, const nh_options *options)
{
    const nh_kinetic *k = g->kinetic;
    size_t m = k->m, d = g->action.d, places = k->places < most_places ? k->places : most_places;
    walls w;
    if (!d || !open_walls(&w, k)) return NULL;
    size_t rows = places * w.count;
    double *a = nh_alloc_array(rows * d + d * d + m * d + 2 * m + d + 1, sizeof *a), *c = a + rows * d,
           *field = c + d * d, *q = field + m * d, *unit = q + m, *size = unit + m;
    nh_kinetic_sizes(k, k->places, unit);
    for (size_t r = 0; r < rows; r++) {
        memcpy(q, k->place + r / w.count * m, m * sizeof *q);
        if (!go_to(&w, r % w.count, unit, q)) continue;
        nh_action_values(&g->action, q, field);
        put_row(&w, unit, d, m, field, rows, a + r, size);
    }
    size_t n = combinations(rows, d, a, size, options, c);
    nh_group *within = NULL;
    if (n < d) {
        nh_action sub;
        nh_action_sub(&sub, &g->action, n, c, options);
        within = nh_group_of(k, sub.d, sub.generator, options);
        within->given = false;
        nh_action_clear(&sub);
    }
    nh_free(a);
    close_walls(&w);
    return within;
}

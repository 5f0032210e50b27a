/* The symmetry group of a system, its name, and its subgroup of global symmetries (group.h).
 *
 *      jets                how many local symmetries, and their algebra, without closed forms
 *      generators          their closed forms, level by level of the library
 *      action              constants, ranks at sample points
 *      report, circles     which ideals; which one-dimensional pieces close after a turn
 *      find_global         the subalgebra of fields that are single-valued on all angles
 */
#include "reduction/group.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "base/memory.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/function.h"
#include "reduction/action.h"
#include "reduction/section.h"
#include "reduction/subspace.h"

/* ---- Which combinations of commuting symmetries may be circles though no generator is one ----
 *
 * Two oscillators that turn at incommensurable rates under either of two generators turn one by one under combinations:
 * where the linear parts of the fields have the joint rates w_j(x), linear in the combination x, those x at which one
 * rate is 1 and the others 0 close. */

/* J[(i m + r) m + s] = d_r of component s of the combination i, at the first sample point. */
static void linear_parts(const nh_action *g, size_t n, const double *c, double *J)
{
    const nh_kinetic *k = g->kinetic;
    nh_dag *d = k->dag;
    size_t m = k->m, square = m * m;
    nh_ex *e = nh_alloc_array(square * g->d + 1, sizeof *e);
    double *each = nh_alloc_array(square * g->d + 1, sizeof *each);
    for (size_t a = 0; a < g->d; a++)
        for (size_t i = 0; i < square; i++)
            e[a * square + i] = nh_diff(d, g->generator[a].component[i % m], k->q[i / m]);
    nh_kinetic_values(k, square * g->d, e, k->place, each);
    nh_multiply(square, n, g->d, each, c, J);
    nh_free(e);
    nh_free(each);
}

/* The joint rates: row j, of n, says how fast each combination turns in the plane of the eigenvectors u and w of a sum
 * of them, J u = p u - w_j w.  Rows that others span are left out; returns their number. */
static size_t rates(size_t m, size_t n, const double *J, double *row)
{
    static const double small = 1e-6;
    size_t square = m * m, count = 0;
    double *sum = nh_alloc_array(2 * square + 4 * m + n + n * n + 1, sizeof *sum), *v = sum + square, *re = v + square,
           *im = re + m, *image = im + m, *own = image + m, *basis = own + n;
    for (size_t i = 0; i < n; i++)
        for (size_t p = 0; p < square; p++) sum[p] += J[i * square + p] * (1 + sqrt(2.0 + (double)i));
    bool good = nh_eigen(m, sum, re, im, v);
    for (size_t j = 0; j + 1 < m && good && count < n; j++) {
        const double *u = v + j * m, *w = u + m;
        double uu = 0, uw = 0, ww = 0, size = 0;
        if (!(im[j] > small)) continue;
        for (size_t s = 0; s < m; s++) uu += u[s] * u[s], uw += u[s] * w[s], ww += w[s] * w[s];
        for (size_t i = 0; i < n; i++) {
            double iu = 0, iw = 0;
            nh_multiply(m, 1, m, J + i * square, u, image);
            for (size_t s = 0; s < m; s++) iu += image[s] * u[s], iw += image[s] * w[s];
            own[i] = -(uu * iw - uw * iu) / (uu * ww - uw * uw);
            size = fmax(size, fabs(own[i]));
        }
        memcpy(row + count * n, own, n * sizeof *own);
        if (size > 0 && nh_span(n, count + 1, row, small * size, basis) == count + 1) count++;
    }
    nh_free(sum);
    return count;
}

/* n commuting combinations c of the generators (d x n).  The directions go to out (d x n); returns their number, at
 * most n.  Numbers only: the flow decides (nh_flows_closed). */
static size_t torus_directions(const nh_action *g, size_t n, const double *c, double *out)
{
    size_t m = g->kinetic->m, d = g->d;
    double *J = nh_alloc_array(m * m * n + 3 * n * n + 1, sizeof *J), *row = J + m * m * n, *gram = row + n * n,
           *dual = gram + n * n;
    linear_parts(g, n, c, J);
    size_t r = rates(m, n, J, row);
    for (size_t i = 0; i < r * r; i++) { /* x = W^T (W W^T)^-1 */
        dual[i] = i % (r + 1) == 0;
        for (size_t a = 0; a < n; a++) gram[i] += row[i / r * n + a] * row[i % r * n + a];
    }
    if (r && !nh_solve(r, gram, r, dual, NULL)) r = 0;
    memset(out, 0, d * n * sizeof *out);
    for (size_t j = 0; j < r; j++)
        for (size_t a = 0; a < d; a++)
            for (size_t i = 0; i < r; i++)
                for (size_t b = 0; b < n; b++) out[a + j * d] += c[a + b * d] * row[i * n + b] * dual[i + j * r];
    nh_free(J);
    return r;
}

/* ---- group ---- */

/* ---- circles ---- */

/* The number of circles: of the generators, one-dimensional pieces and combinations of these that are central and have
 * a closed flow, those that are independent modulo [g,g]. */
static size_t circles(const nh_group *g, const nh_options *options)
{
    const nh_algebra *c = &g->action.algebra;
    size_t d = c->d, count = 0, rank, lines = 0;
    double *all = nh_alloc_array(7 * d * d + 1, sizeof *all), *d1 = all + d * d, *line = d1 + d * d,
           *central = line + d * d;
    nh_flows *flows = nh_flows_create(&g->action);
    for (size_t i = 0; i < d * d; i++) all[i] = i % (d + 1) == 0;
    size_t n1 = nh_algebra_brackets(c, d, all, d, all, options->group, d1);
    for (size_t i = 0; i < g->report.pieces; i++) {
        double size = nh_largest(d, g->report.piece[i].basis);
        if (g->report.piece[i].kind != NH_R) continue;
        /* of size one, because turns of 2 pi are tried */
        for (size_t a = 0; a < d; a++) line[a + lines * d] = g->report.piece[i].basis[a] / (size > 0 ? size : 1);
        lines++;
    }
    memcpy(central, line, lines * d * sizeof *line);
    count = lines + torus_directions(&g->action, lines, line, central + lines * d);
    for (size_t a = 0; a < d; a++)
        if (nh_largest(d * d, c->c + a * d * d) == 0) memcpy(central + count++ * d, all + a * d, d * sizeof *central);
    size_t closed = 0;
    for (size_t i = 0; i < count && (i != lines || closed < lines); i++)
        if (nh_flows_closed(flows, central + i * d))
            memmove(central + closed++ * d, central + i * d, d * sizeof *central);
    nh_project_off(d, closed, central, n1, d1);
    rank = nh_span(d, closed, central, sqrt(options->group), all);
    nh_flows_free(flows);
    nh_free(all);
    return rank;
}

/* "SE(2) x SO(2)^3" from the pieces and the circles. */
static void name_group(nh_group *g, const nh_options *options)
{
    static const double rounding = 1e-10;
    nh_text name;
    nh_text_init(&name);
    const nh_algebra *algebra = g->missing ? &g->jets->algebra : &g->action.algebra;
    size_t d = algebra->d;
    bool exact = !g->missing && g->action.exact;
    double *t = nh_alloc_array(d * d + d + 1, sizeof *t), *unit = t + d * d;
    if (exact) nh_algebra_balance(algebra, unit);
    for (size_t a = 0; a < d; a++) t[a * (d + 1)] = exact ? unit[a] : 1;
    nh_algebra balanced = nh_algebra_change(algebra, d, t, NULL);
    nh_algebra_report_init(&g->report, exact ? &balanced : algebra, exact ? rounding : options->group, options->cluster,
                           (size_t)options->ideals, (uint64_t)options->seed);
    for (size_t i = 0; i < g->report.pieces && exact; i++)
        for (size_t j = 0; j < d * g->report.piece[i].dimension; j++) g->report.piece[i].basis[j] *= unit[j % d];
    nh_algebra_clear(&balanced);
    nh_free(t);
    g->closed = nh_alloc_array(g->report.pieces + 1, sizeof *g->closed);
    size_t n = g->missing || !g->action.closes ? 0 : circles(g, options);
    for (size_t i = 0; i < g->report.pieces; i++)
        if (g->report.piece[i].kind == NH_R && n > 0) g->closed[i] = true, n--;
    nh_algebra_name(&g->report, g->closed, &name);
    g->name = nh_strdup(nh_text_string(&name));
    nh_text_clear(&name);
}

/* The changes of the components after a turn of each angle vanish: exact relations; false: not known. */
static bool single_valued_exactly(const nh_action *g, const nh_options *options, double *c, size_t *n)
{
    const nh_kinetic *k = g->kinetic;
    nh_dag *d = k->dag;
    size_t m = k->m, rows = m * m;
    nh_ex *e = nh_alloc_array(rows * g->d + 1, sizeof *e);
    for (size_t i = 0; i < rows * g->d; i++) {
        nh_ex q = k->q[i / m % m], x = g->generator[i / rows].component[i % m],
              after = nh_add(d, q, nh_mul(d, nh_int(d, 2), nh_pi(d)));
        e[i] = k->periodic[i / m % m] ? nh_sub(d, nh_substitute(d, x, 1, &q, &after), x) : nh_int(d, 0);
    }
    bool known = nh_section_combinations(k, g->d, rows, e, options, c, n);
    nh_free(e);
    return known;
}

/* The combinations of generators that are single-valued on all angles form an algebra: the null space of their changes
 * after a turn, in units of the coordinates and of the generators' sizes. */
static size_t single_valued(const nh_action *g, const nh_options *options, double *c)
{
    enum { most_places = 8 };
    static const double turn = 6.283185307179586;
    const nh_kinetic *k = g->kinetic;
    size_t m = k->m, d = g->d, places = k->places < most_places ? k->places : most_places, rows = places * m * m, exact;
    if (single_valued_exactly(g, options, c, &exact)) return exact;
    double *a = nh_alloc_array(rows * d + 2 * m * d + 2 * m + d + 1, sizeof *a), *before = a + rows * d,
           *after = before + m * d, *q = after + m * d, *unit = q + m, *size = unit + m;
    nh_kinetic_sizes(k, places, unit);
    for (size_t p = 0; p < places; p++) {
        memcpy(q, k->place + p * m, m * sizeof *q);
        nh_action_values(g, q, before);
        for (size_t i = 0; i < m * d; i++) size[i / m] = fmax(size[i / m], fabs(before[i]) / unit[i % m]);
        for (size_t s = 0; s < m; s++) {
            if (!k->periodic[s]) continue;
            q[s] += turn;
            nh_action_values(g, q, after);
            q[s] -= turn;
            for (size_t e = 0; e < d; e++)
                for (size_t i = 0; i < m; i++)
                    a[(p * m + s) * m + i + e * rows] = (after[i + e * m] - before[i + e * m]) / unit[i];
        }
    }
    for (size_t i = 0; i < rows * d; i++) a[i] /= size[i / rows] > 0 ? size[i / rows] : 1;
    size_t n = nh_kernel(rows, d, a, options->group, c, NULL, NULL);
    for (size_t i = 0; i < n * d; i++) c[i] /= size[i % d] > 0 ? size[i % d] : 1;
    nh_column_echelon(d, n, options->group, c);
    nh_free(a);
    return n;
}

static void find_global(nh_group *g, const nh_options *options)
{
    g->local = g->missing > 0;
    for (size_t a = 0; a < g->action.d; a++) g->local |= g->action.generator[a].local;
    if (!g->local || !g->action.d) return;
    double *c = nh_alloc_array(g->action.d * g->action.d + 1, sizeof *c);
    nh_action sub;
    g->global = single_valued(&g->action, options, c);
    nh_action_sub(&sub, &g->action, g->global, c, options);
    nh_group *whole = sub.closes ? nh_group_of(g->kinetic, sub.d, sub.generator, options) : NULL;
    g->global_name = whole ? nh_strdup(whole->name) : NULL;
    nh_group_free(whole);
    nh_action_clear(&sub);
    nh_free(c);
}

nh_group *nh_group_find(const nh_kinetic *k, const nh_options *options, nh_error *error)
{
    nh_group *g = nh_alloc(sizeof *g);
    g->kinetic = k;
    if (k->countable) g->jets = nh_jets_find(k, options, error);
    if ((k->countable && !g->jets) || !nh_generators_find(&g->found, k, g->jets, options, error)) {
        nh_group_free(g);
        return NULL;
    }
    g->missing = g->jets && g->jets->dimension > g->found.count ? g->jets->dimension - g->found.count : 0;
    nh_action_init(&g->action, k, g->found.count, g->found.generator, options);
    name_group(g, options);
    find_global(g, options);
    return g;
}

nh_group *nh_group_of(const nh_kinetic *k, size_t count, const nh_generator *generator, const nh_options *options)
{
    nh_group *g = nh_alloc(sizeof *g);
    *g = (nh_group){.kinetic = k, .given = true};
    nh_action_init(&g->action, k, count, generator, options);
    name_group(g, options);
    return g;
}

void nh_group_free(nh_group *g)
{
    if (!g) return;
    nh_jets_free(g->jets);
    nh_action_clear(&g->action);
    nh_algebra_report_clear(&g->report);
    nh_free(g->closed);
    nh_free(g->name);
    nh_free(g->global_name);
    nh_free(g);
}

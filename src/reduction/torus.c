#include "reduction/torus.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "base/memory.h"
#include "graph/diff.h"
#include "reduction/subspace.h"

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

size_t nh_torus_directions(const nh_action *g, size_t n, const double *c, double *out)
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

/* algebra_kind: the names of indecomposable algebras, by their series, Killing form and radical.
 *
 *      d = 1, 2                        R; the affine group of a line
 *      d = 3                           by [g,g] and ad_x on it, x outside: Bianchi's numbers
 *      [g,g] Heisenberg's, d = 4       turns or boosts of its plane
 *      [g,g] = g, abelian radical      by the signature of the Killing form: simple, or with translations
 *      else                            no name */
#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "base/memory.h"
#include "reduction/algebra.h"
#include "reduction/subspace.h"
#include "system/sample.h"

size_t nh_algebra_derived(const nh_algebra *g, double small, double *out)
{
    double *all = nh_alloc_array(g->d * g->d + 1, sizeof *all);
    for (size_t i = 0; i < g->d; i++) all[i * (g->d + 1)] = 1;
    size_t n = nh_algebra_brackets(g, g->d, all, g->d, all, small, out);
    nh_free(all);
    return n;
}

/* What is orthogonal to [g,g] for the Killing form. */
size_t nh_algebra_radical(const nh_algebra *g, double small, double *out)
{
    size_t d = g->d;
    double *k = nh_alloc_array(d * d + 1, sizeof *k), *d1 = nh_alloc_array(d * d + 1, sizeof *d1),
           *rows = nh_alloc_array(d * d + 1, sizeof *rows);
    nh_algebra_killing(g, k);
    size_t r = nh_algebra_derived(g, small, d1);
    for (size_t a = 0; a < r; a++)
        for (size_t j = 0; j < d; j++)
            for (size_t i = 0; i < d; i++) rows[a + j * r] += d1[i + a * d] * k[i + j * d];
    double scale = nh_largest(d * d * d, g->c);
    size_t n = nh_kernel(r, d, rows, small * scale * scale, out, NULL, NULL);
    nh_free(k);
    nh_free(d1);
    nh_free(rows);
    return n;
}

/* The numbers of positive and of negative eigenvalues of the Killing form. */
static void killing_signs(const nh_algebra *g, double small, size_t *positive, size_t *negative)
{
    size_t d = g->d;
    double *k = nh_alloc_array(d * d + 1, sizeof *k), *re = nh_alloc_array(2 * d + 1, sizeof *re), zero;
    nh_algebra_killing(g, k);
    /* squares of constants: the eigenvalues spread twice as far as these */
    zero = small * sqrt(small) * nh_largest(d * d, k);
    *positive = *negative = 0;
    if (nh_eigen(d, k, re, re + d, NULL))
        for (size_t i = 0; i < d; i++) {
            *positive += re[i] > zero;
            *negative += re[i] < -zero;
        }
    nh_free(k);
    nh_free(re);
}

/* The eigenvalues, sum and difference halved, of ad_x on a plane modulo a subspace (both in the columns of `basis`: the
 * first n - 2 span the subspace), x random: 1 with two real ones, 0 with one, -1 with complex ones. */
static int plane_values(const nh_algebra *g, size_t n, const double *basis, double small, uint64_t *seed, double *mean,
                        double *square)
{
    size_t d = g->d, first = n - 2;
    double *x = nh_alloc_array(d + 2 * d + 2 * n + 1, sizeof *x), *image = x + d, *c = image + 2 * d;
    for (size_t i = 0; i < d; i++) x[i] = 2 * nh_random(seed) - 1;
    for (size_t j = 0; j < 2; j++) nh_algebra_bracket(g, x, basis + (first + j) * d, image + j * d);
    nh_coordinates(d, n, basis, 2, image, c);
    const double *p = c + first, *q = c + n + first;
    double size = fmax(fmax(fabs(p[0]), fabs(p[1])), fmax(fabs(q[0]), fabs(q[1])));
    *mean = (p[0] + q[1]) / 2;
    *square = (p[0] - q[1]) * (p[0] - q[1]) / 4 + p[1] * q[0];
    int kind = fabs(*square) <= small * size * size ? 0 : *square > 0 ? 1 : -1;
    if (fabs(*mean) <= sqrt(small) * size) *mean = 0;
    *square = kind ? *square : fabs(p[0] - q[1]) + fabs(p[1]) + fabs(q[0]) > sqrt(small) * size; /* a Jordan block? */
    nh_free(x);
    return kind;
}

/* [g,g] abelian of dimension 2: ad_x on it. */
static nh_algebra_kind plane_kind(const nh_algebra *g, const double *d1, double small, uint64_t *seed)
{
    double mean, square;
    int kind = plane_values(g, 2, d1, small, seed, &mean, &square);
    if (kind == 0) return mean == 0 ? NH_OTHER_ALGEBRA : square != 0 ? NH_BIANCHI4 : NH_BIANCHI5;
    if (mean == 0) return kind < 0 ? NH_SE2 : NH_E11;
    return kind < 0 ? NH_BIANCHI7 : NH_BIANCHI6;
}

/* [g,g] Heisenberg's algebra, whose centre is that of g: the rest turns or boosts the plane beside the centre. */
static nh_algebra_kind kind_of_four(const nh_algebra *g, const double *d1, size_t r, double small, uint64_t *seed)
{
    double *z = nh_alloc_array(4 * 16, sizeof *z), *plane = z + 16, *basis = plane + 16, *out = basis + 16, mean,
           square;
    size_t centre = nh_algebra_centre(g, small, z), inner = nh_algebra_brackets(g, r, d1, r, d1, small, out);
    nh_algebra_kind kind = NH_OTHER_ALGEBRA;
    memcpy(plane, d1, 4 * r * sizeof *plane);
    nh_project_off(4, r, plane, centre, z);
    memcpy(basis, z, 4 * sizeof *basis);
    if (r == 3 && centre == 1 && inner == 1 && nh_span(4, 3, plane, sqrt(small), basis + 4) == 2) {
        int values = plane_values(g, 3, basis, small, seed, &mean, &square);
        if (values && mean == 0) kind = values < 0 ? NH_NIL_SO2 : NH_NIL_SO11;
    }
    nh_free(z);
    return kind;
}

static nh_algebra_kind kind_of_three(const nh_algebra *g, const double *d1, size_t r, double small, uint64_t *seed)
{
    size_t positive, negative;
    killing_signs(g, small, &positive, &negative);
    if (r == 3) return negative == 3 ? NH_SO3 : NH_SL2R;
    if (r == 2) return plane_kind(g, d1, small, seed);
    double *centre = nh_alloc_array(9, sizeof *centre), off = 1, x;
    size_t z = nh_algebra_centre(g, small, centre);
    if (r == 1 && z == 1) off = nh_coordinates(3, 1, centre, 1, d1, &x);
    nh_free(centre);
    return off < sqrt(small) ? NH_HEISENBERG : NH_OTHER_ALGEBRA;
}

/* det of ad_x on the radical (r columns of rad), x random: its sign tells vectors from spinors. */
static double on_radical(const nh_algebra *g, size_t r, const double *rad, uint64_t *seed)
{
    size_t d = g->d;
    double *x = nh_alloc_array(d + d * r + r * r + 1, sizeof *x), *image = x + d, *ad = image + d * r;
    for (size_t i = 0; i < d; i++) x[i] = 2 * nh_random(seed) - 1;
    for (size_t j = 0; j < r; j++) nh_algebra_bracket(g, x, rad + j * d, image + j * d);
    nh_coordinates(d, r, rad, r, image, ad);
    double det = nh_determinant(r, ad);
    nh_free(x);
    return det;
}

/* Perfect algebras whose radical is abelian, by the signature of the Killing form: the simple ones, and turns, or turns
 * and boosts, with translations. */
static nh_algebra_kind perfect_kind(const nh_algebra *g, double small, uint64_t *seed)
{
    static const struct {
        size_t d, radical, positive, negative;
        nh_algebra_kind kind;
    } known[] = {{6, 0, 3, 3, NH_SO31},   {6, 3, 0, 3, NH_SE3},   {6, 3, 2, 1, NH_E21},    {8, 0, 5, 3, NH_SL3R},
                 {8, 0, 4, 4, NH_SU21},   {8, 0, 0, 8, NH_SU3},   {10, 0, 0, 10, NH_SO5},  {10, 0, 4, 6, NH_SO41},
                 {10, 0, 6, 4, NH_SO32},  {10, 4, 0, 6, NH_SE4},  {10, 4, 3, 3, NH_ISO31}, {15, 0, 0, 15, NH_SO6},
                 {15, 0, 5, 10, NH_SO51}, {15, 0, 8, 7, NH_SO42}, {15, 0, 9, 6, NH_SL4R},  {15, 0, 6, 9, NH_SU31}};
    size_t d = g->d, positive, negative;
    double *rad = nh_alloc_array(2 * d * d + 1, sizeof *rad), *out = rad + d * d;
    nh_algebra_kind kind = NH_OTHER_ALGEBRA;
    size_t r = nh_algebra_radical(g, small, rad);
    killing_signs(g, small, &positive, &negative);
    bool abelian = nh_algebra_brackets(g, r, rad, r, rad, small, out) == 0;
    for (size_t i = 0; i < sizeof known / sizeof *known && abelian; i++)
        if (known[i].d == d && known[i].radical == r && known[i].positive == positive && known[i].negative == negative)
            kind = known[i].kind;
    if (kind == NH_ISO31 && !(on_radical(g, r, rad, seed) < 0)) kind = NH_OTHER_ALGEBRA;
    nh_free(rad);
    return kind;
}

nh_algebra_kind nh_algebra_kind_of(const nh_algebra *g, double small, uint64_t seed)
{
    size_t d = g->d;
    nh_algebra_kind kind = NH_OTHER_ALGEBRA;
    double *d1 = nh_alloc_array(d * d + 1, sizeof *d1);
    size_t r = nh_algebra_derived(g, small, d1);
    if (d == 1) kind = NH_R;
    else if (d == 2 && r == 1) kind = NH_AFF1;
    else if (d == 3) kind = kind_of_three(g, d1, r, small, &seed);
    else if (d == 4) kind = kind_of_four(g, d1, r, small, &seed);
    else if (r == d) kind = perfect_kind(g, small, &seed);
    nh_free(d1);
    return kind;
}

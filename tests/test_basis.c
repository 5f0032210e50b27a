/* basis: which columns of a matrix stay, against the definition in plain loops, and the triangle that they have. */
#include <criterion/criterion.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "integrals/basis.h"

enum { rows = 60, most = 40 };

/* cos x, exp x and 1/(x + 3) are sums of Chebyshev polynomials: each is nearly one of those of low degree, and no pivot is small.  Some polynomials
 * stand before what goes. */
static size_t columns_of(double b[most][rows], int variant)
{
    double grown = 1.2 + 0.3 * variant, pole = 2.3 + 0.4 * variant;
    size_t n = 0, polynomials = 24, before = (size_t)(2 * variant - 2);
    for (size_t k = 0; k < polynomials + 4; k++, n++)
        for (size_t i = 0; i < rows; i++) {
            double x = 2 * (double)i / (rows - 1) - 1, f[] = {cos(grown * x), exp(x), sin(grown * x), 1 / (x + pole)};
            size_t degree = k < before ? k : k < before + 3 ? polynomials : k - 3;
            b[n][i] = degree < polynomials ? cos((double)degree * acos(x)) : k < before + 3 ? f[k - before] : f[3];
        }
    return n;
}

/* The distance of column j from the span of the n listed ones without it. */
static double distance(const double b[most][rows], size_t n, const size_t *list, size_t j)
{
    long double q[most][rows], x[rows];
    size_t kept = 0;
    for (size_t k = 0; k <= n; k++) { /* itself last */
        size_t from = k < n ? list[k] : j;
        long double norm = 0, rest = 0;
        if (k < n && from == j) continue;
        for (size_t i = 0; i < rows; i++) norm += (long double)b[from][i] * b[from][i];
        for (size_t i = 0; i < rows; i++) x[i] = b[from][i] / sqrtl(norm);
        for (int pass = 0; pass < 2; pass++)
            for (size_t a = 0; a < kept; a++) {
                long double dot = 0;
                for (size_t i = 0; i < rows; i++) dot += q[a][i] * x[i];
                for (size_t i = 0; i < rows; i++) x[i] -= dot * q[a][i];
            }
        for (size_t i = 0; i < rows; i++) rest += x[i] * x[i];
        if (k == n) return (double)sqrtl(rest);
        for (size_t i = 0; i < rows; i++) q[kept][i] = x[i] / sqrtl(rest);
        kept++;
    }
    return 0;
}

/* The columns that stay: each in turn, unless it depends on those before it; where one of these then depends on all the others, the worst of them goes,
 * and all begins anew. */
static size_t stay(const double b[most][rows], size_t columns, double rank, size_t *list, size_t *gone)
{
    bool out[most] = {false};
    size_t n;
    for (bool again = true; again;) {
        again = false;
        n = 0;
        for (size_t j = 0; j < columns && !again; j++) {
            if (out[j] || distance(b, n, list, j) < rank) continue;
            list[n++] = j;
            size_t worst = 0;
            for (size_t k = 1; k < n; k++)
                if (distance(b, n, list, list[k]) < distance(b, n, list, list[worst])) worst = k;
            again = distance(b, n, list, list[worst]) < rank;
            if (!again) continue;
            out[list[worst]] = true;
            ++*gone;
        }
    }
    return n;
}

Test(basis, what_nearly_is_a_sum_of_the_others_goes)
{
    static double b[most][rows];
    size_t gone = 0;
    for (int variant = 1; variant <= 3; variant++) {
        size_t columns = columns_of(b, variant), list[most];
        nh_nullspace_options o = {.rank = 1e-9, .trivial = 1e-11};
        nh_basis basis;
        nh_error error = {0};
        size_t n = stay(b, columns, o.rank, list, &gone);
        cr_assert(nh_basis_init(&basis, rows, columns, b[0], rows, NULL, &o, &error), "%s", error.what);
        cr_expect_eq(basis.count, n, "%zu and %zu", basis.count, n);
        for (size_t k = 0; k < n && k < basis.count; k++)
            cr_expect_eq(basis.column[k], list[k], "%zu: %zu and %zu", k, basis.column[k], list[k]);
        double least = 1;
        for (size_t j = 0; j < basis.count; j++) { /* R^T R = B^T B in their units */
            least = fmin(least, basis.r[j + j * basis.count]);
            for (size_t i = 0; i <= j; i++) {
                double dot = 0, product = 0;
                for (size_t k = 0; k <= i; k++) product += basis.r[k + i * basis.count] * basis.r[k + j * basis.count];
                for (size_t k = 0; k < rows; k++)
                    dot += b[basis.column[i]][k] / basis.scale[basis.column[i]] * (b[basis.column[j]][k] / basis.scale[basis.column[j]]);
                cr_expect(fabs(dot - product) < 1e-13, "%zu, %zu: %g", i, j, dot - product);
            }
        }
        cr_expect_eq(basis.smallest_kept, least);
        cr_expect(basis.largest_dropped < o.rank && basis.largest_dropped > 0, "%g", basis.largest_dropped);
        nh_basis_clear(&basis);
    }
    cr_expect_geq(gone, 3, "%zu: the sweep has what it is made for", gone);
}

Test(basis, infinite_columns_are_refused)
{
    static double b[most][rows];
    size_t columns = columns_of(b, 1);
    b[5][7] = INFINITY;
    nh_nullspace_options o = {.rank = 1e-9, .trivial = 1e-11};
    nh_basis basis;
    nh_error error = {0};
    cr_expect_not(nh_basis_init(&basis, rows, columns, b[0], rows, NULL, &o, &error));
    cr_expect(strstr(error.what, "too large to be compared"), "%s", error.what);
}

#include "integrals/recognise.h"

#include <math.h>

#include "base/linalg.h"
#include "base/memory.h"
#include "graph/dag.h"
#include "graph/num.h"

/* Continued fraction, stopped at the first convergent that is near enough. */
bool nh_recognise_ratio(double value, int64_t most, double tolerance, nh_num *out)
{
    double x = fabs(value), rest = x;
    int64_t p0 = 0, p1 = 1, q0 = 1, q1 = 0;
    if (!isfinite(value) || x > 1e9) return false;
    if (value == 0) {
        *out = nh_num_int(0);
        return true;
    }
    for (int i = 0; i < 40; i++) {
        double whole = floor(rest);
        if (whole > 1e9) return false;
        int64_t p = (int64_t)whole * p1 + p0, q = (int64_t)whole * q1 + q0;
        if (q > most) return false;
        p0 = p1, p1 = p;
        q0 = q1, q1 = q;
        if (fabs((double)p / (double)q - x) <= tolerance * x) {
            *out = nh_num_ratio(value < 0 ? -p : p, q);
            return p != 0;
        }
        rest = 1 / (rest - whole);
        if (!isfinite(rest)) return false;
    }
    return false;
}

bool nh_recognise_number(nh_dag *dag, double value, double tolerance, nh_ex *out)
{
    enum { plain = 400, under_root = 60 };
    nh_num r;
    if (nh_recognise_ratio(value, plain, tolerance, &r)) {
        *out = nh_number(dag, r);
        return true;
    }
    if (!nh_recognise_ratio(value * value, under_root, tolerance, &r)) return false;
    *out = nh_sqrt(dag, nh_number(dag, r));
    if (value < 0) *out = nh_neg(dag, *out);
    return true;
}

bool nh_recognise_monomial(nh_dag *dag, size_t sets, size_t n, const nh_ex *symbol, const double *p, const double *c,
                           double tolerance, nh_ex *out)
{
    if (sets < n + 2) return false;
    double *a = nh_alloc_array(sets * (n + 1), sizeof *a), *b = nh_alloc_array(sets, sizeof *b);
    bool good = true;
    for (size_t s = 0; s < sets && good; s++) {
        good = c[s] != 0 && isfinite(c[s]) && (c[s] > 0) == (c[0] > 0);
        b[s] = log(fabs(c[s]));
        a[s] = 1;
        for (size_t i = 0; i < n; i++) {
            good &= p[s * n + i] > 0;
            a[s + (i + 1) * sets] = log(p[s * n + i]);
        }
    }
    good = good && nh_least_squares(sets, n + 1, a, 1, b, sets, 1e-12) == (int)n + 1;
    nh_ex e = nh_int(dag, 1);
    double *exponent = a; /* reused: the matrix has been destroyed */
    for (size_t i = 0; i < n && good; i++) {
        exponent[i] = round(2 * b[i + 1]) / 2;
        good = fabs(b[i + 1] - exponent[i]) < 1e-6 && fabs(exponent[i]) <= 8;
        if (good) e = nh_mul(dag, e, nh_pow(dag, symbol[i], nh_ratio(dag, (int64_t)(2 * exponent[i]), 2)));
    }
    double factor = 0, worst = 0;
    for (size_t s = 0; s < sets && good; s++) {
        double rest = c[s];
        for (size_t i = 0; i < n; i++) rest /= pow(p[s * n + i], exponent[i]);
        if (s == 0) factor = rest;
        worst = fmax(worst, fabs(rest / factor - 1));
    }
    nh_ex number = 0;
    good = good && worst <= tolerance && nh_recognise_number(dag, factor, tolerance, &number);
    if (good) *out = nh_mul(dag, number, e);
    nh_free(b);
    nh_free(a);
    return good;
}

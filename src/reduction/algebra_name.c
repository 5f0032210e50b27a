/* algebra_name: the indecomposable ideals of an algebra, and their names.
 *
 * An algebra is a direct sum of ideals exactly when its centroid, the matrices T with T[x,y] = [Tx,y], has commuting
 * projections.  The generalised eigenspaces of a random element of it are therefore ideals; of several random elements
 * the finest valid splitting is kept. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/linalg.h"
#include "base/memory.h"
#include "reduction/algebra.h"
#include "reduction/subspace.h"
#include "system/sample.h"

enum { draws = 16 };

static double scale_of(const nh_algebra *g) { return fmax(nh_largest(g->d * g->d * g->d, g->c), 1e-300); }

static void identity(size_t d, double *out)
{
    for (size_t i = 0; i < d * d; i++) out[i] = i % (d + 1) == 0;
}

/* ---- series ---- */

/* Dimensions of the derived, or lower central, series, until they no longer fall; how many there are. */
static size_t series(const nh_algebra *g, bool derived, double small, size_t *dimension)
{
    size_t d = g->d, n = d, length = 0;
    double *all = nh_alloc_array(d * d + 1, sizeof *all), *u = nh_alloc_array(d * d + 1, sizeof *u),
           *next = nh_alloc_array(d * d + 1, sizeof *next);
    identity(d, all);
    identity(d, u);
    for (;;) {
        dimension[length++] = n;
        if (length == NH_MOST_SERIES || n == 0) break;
        size_t r = nh_algebra_brackets(g, derived ? n : d, derived ? u : all, n, u, small, next);
        if (r == n) break;
        memcpy(u, next, d * d * sizeof *u);
        n = r;
    }
    nh_free(all);
    nh_free(u);
    nh_free(next);
    return length;
}

/* ---- splitting ---- */

/* T is in the centroid when it commutes with ad_y for every y: T[x,y] = -T ad_y x and [Tx,y] = -ad_y T x.  Then it
 * commutes with ad_[y,z] too, so that a few random y say almost everything: the rows of T ad_y - ad_y T = 0 in the w^2
 * entries of T (column-major) for `few` of them. */
enum { few = 3 };

static void random_ad(const nh_algebra *g, uint64_t *seed, double *ad)
{
    double *y = nh_alloc_array(g->d + 1, sizeof *y);
    for (size_t i = 0; i < g->d; i++) y[i] = 2 * nh_random(seed) - 1;
    nh_algebra_ad(g, y, ad);
    nh_free(y);
}

/* T ad_y - ad_y T = 0 for `few` random y: (few w^2) x w^2, T by columns. */
static double *commutant_rows(const nh_algebra *g, uint64_t *seed)
{
    size_t w = g->d, rows = few * w * w;
    double *a = nh_alloc_array(rows * w * w + 1, sizeof *a), *ad = nh_alloc_array(w * w + 1, sizeof *ad);
    for (size_t draw = 0; draw < few; draw++) {
        random_ad(g, seed, ad);
        for (size_t k = 0; k < w; k++)
            for (size_t l = 0; l < w; l++) {
                size_t row = (draw * w + k) * w + l; /* (T ad)_kl - (ad T)_kl */
                for (size_t i = 0; i < w; i++) {
                    a[row + (k + i * w) * rows] += ad[i + l * w];
                    a[row + (i + l * w) * rows] -= ad[k + i * w];
                }
            }
    }
    nh_free(ad);
    return a;
}

/* Of n matrices T_j the combinations that commute with one more random ad_y; returns their number. */
static size_t shrink(const nh_algebra *g, double small, size_t n, double *kernel, uint64_t *seed)
{
    size_t w = g->d, length = w * w;
    double *ad = nh_alloc_array(3 * length + 1, sizeof *ad), *left = ad + length, *right = left + length;
    double *rows = nh_alloc_array(length * n + 1, sizeof *rows), *mix = nh_alloc_array(n * n + 1, sizeof *mix),
           *out = nh_alloc_array(length * n + 1, sizeof *out);
    random_ad(g, seed, ad);
    for (size_t j = 0; j < n; j++) {
        nh_multiply(w, w, w, kernel + j * length, ad, left);
        nh_multiply(w, w, w, ad, kernel + j * length, right);
        for (size_t i = 0; i < length; i++) rows[i + j * length] = left[i] - right[i];
    }
    size_t kept = nh_kernel(length, n, rows, small, mix, NULL, NULL);
    nh_multiply(length, kept, n, kernel, mix, out);
    memcpy(kernel, out, length * kept * sizeof *out);
    nh_free(ad);
    nh_free(rows);
    nh_free(mix);
    nh_free(out);
    return kept;
}

/* A basis of the centroid; out is w^2 x w^2.  It ends when two more elements change nothing. */
static size_t centroid(const nh_algebra *g, double small, uint64_t *seed, double *out)
{
    size_t w = g->d, n, same = 0;
    double *a = commutant_rows(g, seed);
    n = nh_kernel(few * w * w, w * w, a, small * scale_of(g), out, NULL, NULL);
    nh_free(a);
    for (size_t draws_left = 2 * w; n > 1 && same < 2 && draws_left > 0; draws_left--) {
        size_t kept = shrink(g, small * scale_of(g), n, out, seed);
        same = kept == n ? same + 1 : 0;
        n = kept;
    }
    return n;
}

typedef struct {
    size_t count, dimension[64];
    double *basis; /* w x w, piece after piece */
} splitting;

/* Null space of a power of (T - ev), or of its real quadratic: the `mul` smallest right singular vectors. */
static void eigenspace(size_t w, const double *t, double re, double im, size_t mul, double *out)
{
    double *a = nh_alloc_array(4 * w * w + 1, sizeof *a), *power = a + w * w, *next = power + w * w, *vt = next + w * w;
    double *s = nh_alloc_array(w + 1, sizeof *s);
    memcpy(a, t, w * w * sizeof *a);
    for (size_t i = 0; i < w; i++) a[i * (w + 1)] -= re;
    if (im != 0) { /* (T - re)^2 + im^2 */
        nh_multiply(w, w, w, a, a, next);
        for (size_t i = 0; i < w; i++) next[i * (w + 1)] += im * im;
        memcpy(a, next, w * w * sizeof *a);
    }
    identity(w, power);
    for (size_t k = 0; k < mul; k++) {
        nh_multiply(w, w, w, power, a, next);
        double size = fmax(nh_largest(w * w, next), 1e-300);
        for (size_t i = 0; i < w * w; i++) power[i] = next[i] / size;
    }
    if (nh_svd(w, w, power, s, NULL, vt))
        for (size_t j = 0; j < mul; j++)
            for (size_t i = 0; i < w; i++) out[i + j * w] = vt[(w - mul + j) + i * w];
    nh_free(a);
    nh_free(s);
}

/* The generalised eigenspaces of t, conjugate eigenvalues together. */
static void split_by(size_t w, const double *t, double cluster, splitting *out)
{
    double *a = nh_alloc_array(w * w + 2 * w + 1, sizeof *a), *re = a + w * w, *im = re + w, radius = 0;
    size_t filled = 0;
    bool *used = nh_alloc_array(w + 1, sizeof *used);
    out->count = 0;
    memcpy(a, t, w * w * sizeof *a);
    if (!nh_eigen(w, a, re, im, NULL)) w = 0;
    for (size_t i = 0; i < w; i++) radius = fmax(radius, hypot(re[i], im[i]));
    for (size_t i = 0; i < w; i++) {
        if (used[i]) continue;
        double sum_re = 0, sum_im = 0, size = cluster * radius;
        size_t mul = 0;
        for (size_t j = i; j < w; j++)
            if (!used[j] && hypot(re[j] - re[i], fabs(im[j]) - fabs(im[i])) <= size) {
                used[j] = true;
                sum_re += re[j];
                sum_im += fabs(im[j]);
                mul++;
            }
        sum_im = sum_im / (double)mul > size ? sum_im / (double)mul : 0;
        eigenspace(w, t, sum_re / (double)mul, sum_im, mul, out->basis + filled * w);
        filled += mul;
        if (out->count < 64) out->dimension[out->count++] = mul;
    }
    nh_free(a);
    nh_free(used);
}

/* Do the pieces span, commute, and are they ideals? */
static bool valid_splitting(const nh_algebra *g, const splitting *s, double small)
{
    size_t w = g->d, at = 0, total = 0;
    double scale = scale_of(g), *sv = nh_alloc_array(w + 1, sizeof *sv), *out = nh_alloc_array(w * w + 1, sizeof *out);
    nh_singular_values(w, w, s->basis, sv);
    bool good = w > 0 && sv[w - 1] > sqrt(small);
    for (size_t i = 0; i < s->count && good; i++) {
        total += s->dimension[i];
        good = nh_algebra_ideal(g, s->dimension[i], s->basis + at * w) <= sqrt(small) * scale;
        for (size_t j = i + 1, next = at + s->dimension[i]; j < s->count && good; next += s->dimension[j], j++)
            good = nh_algebra_brackets(g, s->dimension[i], s->basis + at * w, s->dimension[j], s->basis + next * w,
                                       sqrt(small), out) == 0;
        at += s->dimension[i];
    }
    nh_free(sv);
    nh_free(out);
    return good && total == w;
}

/* How far the pieces are from ideals. */
static double off_ideals(const nh_algebra *g, const splitting *s)
{
    double off = 0;
    for (size_t i = 0, at = 0; i < s->count; at += s->dimension[i++])
        off = fmax(off, nh_algebra_ideal(g, s->dimension[i], s->basis + at * g->d));
    return off;
}

/* Of equally fine splittings the most accurate one: a random element may have eigenvalues close together. */
static void finest_splitting(const nh_algebra *g, double small, double cluster, size_t most, uint64_t seed,
                             splitting *best)
{
    best->count = 1;
    best->dimension[0] = g->d;
    identity(g->d, best->basis);
    if (g->d > most) return;
    size_t w = g->d, unknowns = w * w;
    double *kernel = nh_alloc_array(unknowns * unknowns + 1, sizeof *kernel),
           *t = nh_alloc_array(unknowns + 1, sizeof *t);
    size_t n = centroid(g, small, &seed, kernel);
    splitting s = {.basis = nh_alloc_array(w * w + 1, sizeof(double))};
    double least = INFINITY;
    for (int draw = 0; draw < draws && n > 1; draw++) {
        memset(t, 0, unknowns * sizeof *t);
        for (size_t j = 0; j < n; j++) {
            double x = 2 * nh_random(&seed) - 1;
            for (size_t i = 0; i < unknowns; i++) t[i] += x * kernel[i + j * unknowns];
        }
        split_by(w, t, cluster, &s);
        if (s.count < 2 || s.count < best->count || !valid_splitting(g, &s, small)) continue;
        double off = off_ideals(g, &s);
        if (s.count == best->count && !(off < least)) continue;
        least = off;
        best->count = s.count;
        memcpy(best->dimension, s.dimension, sizeof s.dimension);
        memcpy(best->basis, s.basis, w * w * sizeof *s.basis);
    }
    nh_free(kernel);
    nh_free(t);
    nh_free(s.basis);
}

/* The part of the centre outside [g,g], and an ideal that complements it: [g,g] and the remaining vectors. */
static size_t central_factor(const nh_algebra *g, double small, double *flat, double *rest, size_t *rest_dimension)
{
    size_t d = g->d;
    double *z = nh_alloc_array(3 * d * d + 1, sizeof *z), *d1 = z + d * d, *both = d1 + d * d;
    size_t nz = nh_algebra_centre(g, small, z), n1 = nh_algebra_derived(g, small, d1), at = 0;
    double *off = nh_alloc_array(d * d + 1, sizeof *off), *kernel = nh_alloc_array(d * d + 1, sizeof *kernel);
    memcpy(off, z, d * nz * sizeof *off);
    nh_project_off(d, nz, off, n1, d1);
    size_t nk = nh_kernel(d, nz, off, sqrt(small), kernel, NULL, NULL), nf = 0; /* combinations that lie in [g,g] */
    double *other = nh_alloc_array(nz * nz + 1, sizeof *other);
    double *transposed = nh_alloc_array(nz * nz + 1, sizeof *transposed);
    for (size_t j = 0; j < nk; j++)
        for (size_t i = 0; i < nz; i++) transposed[j + i * (nk ? nk : 1)] = kernel[i + j * nz];
    nf = nh_kernel(nk, nz, transposed, 0.5, other, NULL, NULL); /* the combinations orthogonal to these */
    nh_multiply(d, nf, nz, z, other, flat);
    memcpy(both, d1, d * n1 * sizeof *both);
    memcpy(both + d * n1, flat, d * nf * sizeof *both);
    double *span = nh_alloc_array(d * d + 1, sizeof *span), *rows = nh_alloc_array(d * d + 1, sizeof *rows);
    size_t ns = nh_span(d, n1 + nf, both, sqrt(small), span);
    for (size_t j = 0; j < ns; j++)
        for (size_t i = 0; i < d; i++) rows[j + i * ns] = span[i + j * d];
    memcpy(rest, d1, d * n1 * sizeof *rest);
    at = nh_kernel(ns, d, rows, 0.5, rest + d * n1, NULL, NULL);
    *rest_dimension = n1 + at;
    nh_free(z);
    nh_free(off);
    nh_free(kernel);
    nh_free(other);
    nh_free(transposed);
    nh_free(span);
    nh_free(rows);
    return nf;
}

static int larger_first(const void *a, const void *b)
{
    const nh_algebra_piece *x = a, *y = b;
    if (x->dimension != y->dimension) return x->dimension > y->dimension ? -1 : 1;
    return (int)x->kind - (int)y->kind;
}

static void add_piece(nh_algebra_report *r, nh_algebra_kind kind, size_t n, const double *basis)
{
    nh_algebra_piece *p = &r->piece[r->pieces++];
    *p = (nh_algebra_piece){kind, n, nh_alloc_array(r->d * n + 1, sizeof(double))};
    memcpy(p->basis, basis, r->d * n * sizeof *basis);
}

void nh_algebra_report_init(nh_algebra_report *r, const nh_algebra *g, double small, double cluster, size_t most,
                            uint64_t seed)
{
    size_t d = g->d, w;
    double *scratch = nh_alloc_array(5 * d * d + 1, sizeof *scratch), *flat = scratch, *rest = flat + d * d,
           *basis = rest + d * d, *lifted = basis + d * d;
    *r = (nh_algebra_report){.d = d, .piece = nh_alloc_array(d + 1, sizeof *r->piece)};
    r->centre = nh_algebra_centre(g, small, scratch);
    r->radical = nh_algebra_radical(g, small, scratch);
    r->derived_length = series(g, true, small, r->derived);
    r->lower_length = series(g, false, small, r->lower);
    size_t n = central_factor(g, small, flat, rest, &w);
    for (size_t j = 0; j < n; j++) add_piece(r, NH_R, 1, flat + j * d);
    if (w) {
        nh_algebra core = nh_algebra_change(g, w, rest, NULL);
        splitting s = {.basis = basis};
        finest_splitting(&core, small, cluster, most, seed, &s);
        for (size_t i = 0, at = 0; i < s.count; at += s.dimension[i], i++) {
            nh_multiply(d, s.dimension[i], w, rest, basis + at * w, lifted);
            nh_algebra part = nh_algebra_change(g, s.dimension[i], lifted, NULL);
            add_piece(r, nh_algebra_kind_of(&part, small, seed), s.dimension[i], lifted);
            nh_algebra_clear(&part);
        }
        nh_algebra_clear(&core);
    }
    qsort(r->piece, r->pieces, sizeof *r->piece, larger_first);
    nh_free(scratch);
}

void nh_algebra_report_clear(nh_algebra_report *r)
{
    for (size_t i = 0; i < r->pieces; i++) nh_free(r->piece[i].basis);
    nh_free(r->piece);
    *r = (nh_algebra_report){0};
}

static void put_power(nh_text *out, const char *name, size_t count, bool *first)
{
    if (!count) return;
    nh_text_add(out, *first ? "" : " x ");
    nh_text_add(out, name);
    if (count > 1) nh_text_addf(out, "^%zu", count);
    *first = false;
}

void nh_algebra_name(const nh_algebra_report *r, const bool *closed, nh_text *out)
{
    static const char *const names[] = {"R",
                                        "SO(3)",
                                        "SL(2,R)",
                                        "SE(2)",
                                        "E(1,1)",
                                        "Heisenberg",
                                        "Aff(1)",
                                        "SE(3)",
                                        "Bianchi IV",
                                        "Bianchi V",
                                        "Bianchi VI",
                                        "Bianchi VII",
                                        "(Heisenberg x| SO(2))",
                                        "(Heisenberg x| SO(1,1))",
                                        "SO(3,1)",
                                        "SL(3,R)",
                                        "SU(2,1)",
                                        "SU(3)",
                                        "SO(5)",
                                        "SO(4,1)",
                                        "SO(3,2)",
                                        "SO(6)",
                                        "SO(5,1)",
                                        "SO(4,2)",
                                        "SL(4,R)",
                                        "SU(3,1)",
                                        "ISO(2,1)",
                                        "SE(4)",
                                        "ISO(3,1)"};
    bool first = true;
    size_t circles = 0, lines = 0;
    for (size_t i = 0; i < r->pieces; i++) {
        size_t same = 1;
        if (r->piece[i].kind == NH_R) {
            if (closed && closed[i]) circles++;
            else lines++;
            continue;
        }
        if (r->piece[i].kind == NH_OTHER_ALGEBRA) {
            char text[80];
            snprintf(text, sizeof text, "(an algebra of dimension %zu)", r->piece[i].dimension);
            put_power(out, text, 1, &first);
            continue;
        }
        while (i + 1 < r->pieces && r->piece[i + 1].kind == r->piece[i].kind) i++, same++;
        put_power(out, names[r->piece[i].kind], same, &first);
    }
    put_power(out, "SO(2)", circles, &first);
    put_power(out, "R", lines, &first);
    if (first) nh_text_add(out, "trivial");
}

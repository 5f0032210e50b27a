/* darboux_lines: straight lines c with V'(c) = mu M c, and the eigenvalues of M^-1 V''(c)/mu. */
#include <string.h>

#include <flint/fmpz_poly_factor.h>

#include "absence/darboux_internal.h"
#include "absence/polynomial_text.h"
#include "absence/rational_value.h"
#include "base/text.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/node.h"
#include "graph/num.h"
#include "graph/print.h"

void nh_darboux_refute(nh_darboux_work *w, const char *point, const char *eigenvalue)
{
    if (w->out->refuted) return;
    w->out->refuted = true;
    w->out->refutation = (nh_darboux_refutation){point, eigenvalue};
}

/* ---- one line ---- */

static const char *line_words(const nh_darboux_work *w, const nh_ex *c)
{
    nh_text text;
    nh_text_init(&text);
    for (size_t i = 0; i < w->n; i++) {
        char *value = nh_print_string(w->dag, c[i]);
        nh_text_addf(&text, "%s%s", i ? ", " : "c = (", value);
        nh_free(value);
    }
    nh_text_add(&text, ")");
    const char *out = nh_arena_strdup(w->arena, nh_text_string(&text));
    nh_text_clear(&text);
    return out;
}

/* One root of an irreducible polynomial: "3*sqrt(2) - 5" where `any` root will do, or "lambda, lambda^3 + lambda + 1 =
 * 0". */
static const char *root_words(const nh_darboux_work *w, const fmpz_poly_t g, bool any)
{
    const char *out = NULL;
    fmpq_t half, square;
    fmpq_init(half);
    fmpq_init(square);
    if (any && fmpz_poly_degree(g) == 2) { /* h +- sqrt(h^2 - c/a) with h = -b/(2 a) */
        fmpq_set_fmpz_frac(half, fmpz_poly_get_coeff_ptr(g, 1), fmpz_poly_get_coeff_ptr(g, 2));
        fmpq_div_2exp(half, half, 1);
        fmpq_neg(half, half);
        fmpq_set_fmpz_frac(square, fmpz_poly_get_coeff_ptr(g, 0), fmpz_poly_get_coeff_ptr(g, 2));
        fmpq_neg(square, square);
        fmpq_addmul(square, half, half);
    }
    if (fmpq_sgn(square) > 0) {
        nh_ex root = nh_sqrt(w->dag, nh_rational_value_number(w->dag, square));
        char *text = nh_print_string(w->dag, nh_add(w->dag, nh_rational_value_number(w->dag, half), root));
        out = nh_arena_strdup(w->arena, text);
        nh_free(text);
    } else {
        out = nh_arena_printf(w->arena, "lambda, %s = 0", nh_polynomial_text_whole(w->arena, g, "lambda"));
    }
    fmpq_clear(half);
    fmpq_clear(square);
    return out;
}

/* Has A + sqrt(d) B, given as (A, d B; B, A), a rational characteristic polynomial: have its powers rational traces?
 * Then that of the large matrix is its square. */
static bool rational_characteristic(const nh_darboux_work *w, const fmpq_mat_t matrix)
{
    slong n = (slong)w->n;
    if (fmpq_mat_nrows(matrix) == n) return true;
    bool rational = true;
    fmpq_mat_t power;
    fmpq_t trace;
    fmpq_mat_init_set(power, matrix);
    fmpq_init(trace);
    for (slong k = 0; k < n && rational; k++) {
        fmpq_zero(trace);
        for (slong i = 0; i < n; i++) fmpq_add(trace, trace, fmpq_mat_entry(power, n + i, i));
        rational = fmpq_is_zero(trace);
        fmpq_mat_mul(power, power, matrix);
    }
    fmpq_clear(trace);
    fmpq_mat_clear(power);
    return rational;
}

/* The eigenvalues: each root of an irreducible factor of degree > 1 is not rational. */
static void test_matrix(nh_darboux_work *w, const fmpq_mat_t matrix, const char *point)
{
    fmpq_poly_t characteristic;
    fmpz_poly_t f;
    fmpz_poly_factor_t parts;
    fmpq_t lambda;
    fmpq_poly_init(characteristic);
    fmpz_poly_init(f);
    fmpz_poly_factor_init(parts);
    fmpq_init(lambda);
    bool any = rational_characteristic(w, matrix);
    fmpq_mat_charpoly(characteristic, matrix);
    fmpq_poly_get_numerator(f, characteristic);
    fmpz_poly_factor(parts, f);
    for (slong i = 0; i < parts->num && !w->out->refuted; i++) {
        const fmpz_poly_struct *g = parts->p + i;
        if (fmpz_poly_degree(g) > 1) {
            nh_darboux_refute(w, point, root_words(w, g, any));
            continue;
        }
        fmpq_set_fmpz_frac(lambda, fmpz_poly_get_coeff_ptr(g, 0), fmpz_poly_get_coeff_ptr(g, 1));
        fmpq_neg(lambda, lambda);
        if (!nh_darboux_excluded(w->arena, w->out->degree, lambda)) continue;
        char *text = fmpq_get_str(NULL, 10, lambda);
        nh_darboux_refute(w, point, nh_arena_strdup(w->arena, text));
        flint_free(text);
    }
    fmpq_clear(lambda);
    fmpz_poly_factor_clear(parts);
    fmpz_poly_clear(f);
    fmpq_poly_clear(characteristic);
}

/* The factor mu with V'(c) = mu M c; false: there is none, or it is 0. */
static bool on_line(const nh_darboux_work *w, const nh_rational_value_place *place, nh_ex *mu)
{
    nh_dag *dag = w->dag;
    nh_ex slope[NH_DARBOUX_MOST], momentum[NH_DARBOUX_MOST];
    size_t first = w->n;
    for (size_t i = 0; i < w->n; i++) {
        slope[i] = nh_rational_value_at(place, w->slope[i]);
        momentum[i] = nh_int(dag, 0);
        for (size_t j = 0; j < w->n; j++) {
            nh_ex mass = nh_rational_value_number(dag, fmpq_mat_entry(w->inertia, (slong)i, (slong)j));
            momentum[i] = nh_add(dag, momentum[i], nh_mul(dag, mass, place->value[j]));
        }
        if (first == w->n && nh_rational_value_differs(dag, momentum[i])) first = i;
    }
    if (first == w->n || !nh_rational_value_differs(dag, slope[first])) return false;
    *mu = nh_simplify(dag, nh_div(dag, slope[first], momentum[first]));
    for (size_t i = 0; i < w->n; i++) {
        nh_ex difference = nh_sub(dag, slope[i], nh_mul(dag, *mu, momentum[i]));
        if (nh_normal_is_zero(dag, difference, 0) != NH_ZERO) return false;
    }
    return true;
}

/* The whole number whose square root is the only root in the entries; 0: there is no root; -1: there are others. */
static int64_t only_root(const nh_dag *dag, size_t count, const nh_ex *entry)
{
    int64_t only = 0;
    for (size_t i = 0; i < count; i++) {
        NH_LIST(radicand);
        size_t n = nh_radicands_in(dag, entry[i], &radicand);
        for (size_t k = 0; k < n; k++) {
            if (nh_kind_of(dag, radicand[k]) != NH_NUMBER) return -1;
            nh_num value = nh_number_of(dag, radicand[k]);
            if (!nh_num_short(value) || value.q != 1 || value.p <= 1 || (only && only != value.p)) return -1;
            only = value.p;
        }
    }
    return only;
}

/* The entry is a + b sqrt(d) with rational a and b; false: it is not seen to be. */
static bool split(nh_dag *dag, nh_ex entry, int64_t d, fmpq_t a, fmpq_t b)
{
    if (!d) return nh_rational_value_of(dag, entry, a);
    nh_ex root = nh_sqrt(dag, nh_int(dag, d)), symbol = nh_symbol_fresh(dag, "root"), other = nh_neg(dag, root);
    nh_ex conjugate = nh_substitute_root(dag, entry, nh_int(dag, d), symbol);
    conjugate = nh_substitute(dag, conjugate, 1, &symbol, &other);
    nh_ex half = nh_ratio(dag, 1, 2), sum = nh_mul(dag, half, nh_add(dag, entry, conjugate)),
          difference = nh_mul(dag, half, nh_sub(dag, entry, conjugate));
    return nh_rational_value_of(dag, sum, a) && nh_rational_value_of(dag, nh_div(dag, difference, root), b);
}

/* A + sqrt(d) B acts on u + sqrt(d) v, with rational u and v, as (A, d B; B, A).  The characteristic polynomial of this
 * is the product of that of A + sqrt(d) B with its conjugate: each factor over Q of the one has a root in common with
 * the other.  The entries are those of V''(c)/mu, which M^-1 multiplies. */
static bool matrix_of(const nh_darboux_work *w, const nh_ex *entry, fmpq_mat_t out)
{
    slong n = (slong)w->n;
    int64_t d = only_root(w->dag, w->n * w->n, entry);
    if (d < 0) return false;
    fmpq_mat_t whole, root;
    fmpq_mat_init(whole, n, n);
    fmpq_mat_init(root, n, n);
    bool good = true;
    for (slong i = 0; i < n * n && good; i++)
        good = split(w->dag, entry[i], d, fmpq_mat_entry(whole, i / n, i % n), fmpq_mat_entry(root, i / n, i % n));
    fmpq_mat_mul(whole, w->inverse, whole);
    fmpq_mat_mul(root, w->inverse, root);
    fmpq_t square;
    fmpq_init(square);
    fmpq_set_si(square, (slong)d, 1);
    fmpq_mat_clear(out);
    fmpq_mat_init(out, d ? 2 * n : n, d ? 2 * n : n);
    for (slong i = 0; i < n; i++)
        for (slong j = 0; j < n; j++) {
            fmpq_set(fmpq_mat_entry(out, i, j), fmpq_mat_entry(whole, i, j));
            if (!d) continue;
            fmpq_set(fmpq_mat_entry(out, n + i, n + j), fmpq_mat_entry(whole, i, j));
            fmpq_set(fmpq_mat_entry(out, n + i, j), fmpq_mat_entry(root, i, j));
            fmpq_mul(fmpq_mat_entry(out, i, n + j), fmpq_mat_entry(root, i, j), square);
        }
    fmpq_clear(square);
    fmpq_mat_clear(root);
    fmpq_mat_clear(whole);
    return good;
}

void nh_darboux_try(nh_darboux_work *w, const nh_ex *c, const char *words)
{
    nh_ex mu, entry[NH_DARBOUX_MOST * NH_DARBOUX_MOST];
    nh_rational_value_place place = {.dag = w->dag, .count = w->n, .symbol = w->q, .value = c};
    if (!nh_rational_value_analytic(&place, w->potential) || !on_line(w, &place, &mu)) return;
    w->out->points++;
    if (w->out->refuted) return;
    fmpq_mat_t matrix;
    fmpq_mat_init(matrix, 0, 0);
    for (size_t i = 0; i < w->n * w->n; i++)
        entry[i] = nh_simplify(w->dag, nh_div(w->dag, nh_rational_value_at(&place, w->second[i]), mu));
    if (matrix_of(w, entry, matrix)) test_matrix(w, matrix, words ? words : line_words(w, c));
    else w->out->undecided++;
    if (w->out->refuted) {
        memcpy(w->line, c, w->n * sizeof *c);
        w->triangle = words != NULL;
    }
    fmpq_mat_clear(matrix);
}

/* darboux_lines: straight lines c with V'(c) = mu M c, and the eigenvalues of M^-1 V''(c)/mu. */
#include <string.h>

#include <flint/fmpz_poly_factor.h>

#include "absence/darboux_internal.h"
#include "absence/polynomial_text.h"
#include "absence/rational_value.h"
#include "base/text.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/monomials.h"
#include "graph/print.h"

void nh_darboux_refute(nh_darboux_work *w, const char *point, const char *eigenvalue)
{
    if (w->out->refuted) return;
    w->out->refuted = true;
    w->out->refutation = (nh_darboux_refutation){point, eigenvalue};
}

/* ---- one line with whole coordinates ---- */

static const char *line_words(const nh_darboux_work *w, const long *c)
{
    nh_text text;
    nh_text_init(&text);
    for (size_t i = 0; i < w->n; i++) nh_text_addf(&text, "%s%ld", i ? ", " : "c = (", c[i]);
    nh_text_add(&text, ")");
    const char *out = nh_arena_strdup(w->arena, nh_text_string(&text));
    nh_text_clear(&text);
    return out;
}

/* One root of an irreducible polynomial: "3*sqrt(2) - 5", or "lambda, lambda^3 + lambda + 1 = 0". */
static const char *root_words(const nh_darboux_work *w, const fmpz_poly_t g)
{
    const char *out = NULL;
    fmpq_t half, square;
    fmpq_init(half);
    fmpq_init(square);
    if (fmpz_poly_degree(g) == 2) { /* h +- sqrt(h^2 - c/a) with h = -b/(2 a) */
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

/* The eigenvalues: each root of an irreducible factor of degree > 1 is not rational. */
static void test_matrix(nh_darboux_work *w, const fmpq_mat_t matrix, const long *c)
{
    fmpq_poly_t characteristic;
    fmpz_poly_t f;
    fmpz_poly_factor_t parts;
    fmpq_t lambda;
    fmpq_poly_init(characteristic);
    fmpz_poly_init(f);
    fmpz_poly_factor_init(parts);
    fmpq_init(lambda);
    fmpq_mat_charpoly(characteristic, matrix);
    fmpq_poly_get_numerator(f, characteristic);
    fmpz_poly_factor(parts, f);
    for (slong i = 0; i < parts->num && !w->out->refuted; i++) {
        const fmpz_poly_struct *g = parts->p + i;
        if (fmpz_poly_degree(g) > 1) {
            nh_darboux_refute(w, line_words(w, c), root_words(w, g));
            continue;
        }
        fmpq_set_fmpz_frac(lambda, fmpz_poly_get_coeff_ptr(g, 0), fmpz_poly_get_coeff_ptr(g, 1));
        fmpq_neg(lambda, lambda);
        if (nh_darboux_allowed(w->out->degree, lambda)) continue;
        char *text = fmpq_get_str(NULL, 10, lambda);
        nh_darboux_refute(w, line_words(w, c), nh_arena_strdup(w->arena, text));
        flint_free(text);
    }
    fmpq_clear(lambda);
    fmpz_poly_factor_clear(parts);
    fmpz_poly_clear(f);
    fmpq_poly_clear(characteristic);
}

/* M c */
static void momentum(const nh_darboux_work *w, const long *c, fmpq_mat_t out)
{
    fmpq_mat_t column;
    fmpq_mat_init(column, (slong)w->n, 1);
    for (size_t i = 0; i < w->n; i++) fmpq_set_si(fmpq_mat_entry(column, (slong)i, 0), c[i], 1);
    fmpq_mat_mul(out, w->inertia, column);
    fmpq_mat_clear(column);
}

/* The factor mu with V'(c) = mu M c; false: there is none, or it is 0. */
static bool on_line(const nh_darboux_work *w, const nh_rational_value_place *place, const long *c, nh_ex *mu)
{
    nh_ex slope[NH_DARBOUX_MOST], size[NH_DARBOUX_MOST];
    fmpq_mat_t p;
    fmpq_mat_init(p, (slong)w->n, 1);
    momentum(w, c, p);
    size_t first = w->n;
    for (size_t i = 0; i < w->n; i++) {
        slope[i] = nh_rational_value_at(place, w->slope[i]);
        size[i] = nh_rational_value_number(w->dag, fmpq_mat_entry(p, (slong)i, 0));
        if (first == w->n && !nh_is_zero(w->dag, size[i])) first = i;
    }
    fmpq_mat_clear(p);
    if (first == w->n || !nh_rational_value_differs(w->dag, slope[first])) return false;
    *mu = nh_div(w->dag, slope[first], size[first]);
    for (size_t i = 0; i < w->n; i++) {
        nh_ex difference = nh_sub(w->dag, slope[i], nh_mul(w->dag, *mu, size[i]));
        if (nh_normal_is_zero(w->dag, difference, 0) != NH_ZERO) return false;
    }
    return true;
}

void nh_darboux_try(nh_darboux_work *w, const long *c)
{
    nh_ex value[NH_DARBOUX_MOST], mu;
    for (size_t i = 0; i < w->n; i++) value[i] = nh_int(w->dag, c[i]);
    nh_rational_value_place place = {.dag = w->dag, .count = w->n, .symbol = w->q, .value = value};
    if (!nh_rational_value_analytic(&place, w->potential) || !on_line(w, &place, c, &mu)) return;
    w->out->points++;
    fmpq_mat_t second, matrix;
    fmpq_mat_init(second, (slong)w->n, (slong)w->n);
    fmpq_mat_init(matrix, (slong)w->n, (slong)w->n);
    bool rational = true, was = w->out->refuted;
    for (size_t i = 0; i < w->n * w->n && rational; i++) {
        nh_ex entry = nh_div(w->dag, nh_rational_value_at(&place, w->second[i]), mu);
        rational = nh_rational_value_of(w->dag, entry, fmpq_mat_entry(second, (slong)(i / w->n), (slong)(i % w->n)));
    }
    if (rational) {
        fmpq_mat_mul(matrix, w->inverse, second);
        test_matrix(w, matrix, c);
        if (w->out->refuted && !was) memcpy(w->line, c, w->n * sizeof *c);
    } else {
        w->out->undecided++;
    }
    fmpq_mat_clear(matrix);
    fmpq_mat_clear(second);
}

/* ---- all lines (1, s) of a polynomial in two coordinates ---- */

/* On (1, s), with f(s) = V(1, s): V_x = k f - s f', V_y = f', V_xx = k (k - 1) f - 2 (k - 1) s f' + s^2 f'',
 * V_xy = (k - 1) f' - s f'', V_yy = f''. */
typedef struct {
    fmpq_poly_t s, x, y, xx, xy, yy; /* s; the derivatives of V */
    fmpq_poly_t rate, turn, trace;   /* (M^-1 V')_x, (M^-1 V')_y - s (M^-1 V')_x, the trace of M^-1 V'' */
} plane;

static void plane_each(plane *p, void (*do_to)(fmpq_poly_t))
{
    fmpq_poly_struct *const all[] = {p->s, p->x, p->y, p->xx, p->xy, p->yy, p->rate, p->turn, p->trace};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) do_to(all[i]);
}

/* out := a f + b s g */
static void combine(fmpq_poly_t out, long a, const fmpq_poly_t f, long b, const fmpq_poly_t s, const fmpq_poly_t g)
{
    fmpq_poly_t part;
    fmpq_poly_init(part);
    fmpq_poly_scalar_mul_si(part, f, a);
    fmpq_poly_mul(out, s, g);
    fmpq_poly_scalar_mul_si(out, out, b);
    fmpq_poly_add(out, out, part);
    fmpq_poly_clear(part);
}

/* out += a f */
static void add_multiple(fmpq_poly_t out, const fmpq_t a, const fmpq_poly_t f)
{
    fmpq_poly_t part;
    fmpq_poly_init(part);
    fmpq_poly_scalar_mul_fmpq(part, f, a);
    fmpq_poly_add(out, out, part);
    fmpq_poly_clear(part);
}

static void plane_fill(plane *p, const nh_darboux_work *w, const fmpq_poly_t f)
{
    long k = w->out->degree;
    const fmpq *xx = fmpq_mat_entry(w->inverse, 0, 0), *xy = fmpq_mat_entry(w->inverse, 0, 1),
               *yy = fmpq_mat_entry(w->inverse, 1, 1);
    fmpq_poly_set_coeff_si(p->s, 1, 1);
    fmpq_poly_derivative(p->y, f);
    fmpq_poly_derivative(p->yy, p->y);
    combine(p->x, k, f, -1, p->s, p->y);
    combine(p->xy, k - 1, p->y, -1, p->s, p->yy);
    combine(p->xx, k - 1, p->x, -1, p->s, p->xy); /* V_x is homogeneous of degree k - 1 */
    add_multiple(p->rate, xx, p->x);
    add_multiple(p->rate, xy, p->y);
    add_multiple(p->turn, xy, p->x);
    add_multiple(p->turn, yy, p->y);
    fmpq_poly_mul(p->trace, p->s, p->rate);
    fmpq_poly_sub(p->turn, p->turn, p->trace);
    fmpq_poly_zero(p->trace);
    add_multiple(p->trace, xx, p->xx);
    add_multiple(p->trace, xy, p->xy);
    add_multiple(p->trace, xy, p->xy);
    add_multiple(p->trace, yy, p->yy);
}

static const char *direction_words(const nh_darboux_work *w, const fmpz_poly_t g)
{
    if (fmpz_poly_degree(g) > 1)
        return nh_arena_printf(w->arena, "c = (1, s), %s = 0", nh_polynomial_text_whole(w->arena, g, "s"));
    fmpq_t s;
    fmpq_init(s);
    fmpq_set_fmpz_frac(s, fmpz_poly_get_coeff_ptr(g, 0), fmpz_poly_get_coeff_ptr(g, 1));
    fmpq_neg(s, s);
    char *text = fmpq_get_str(NULL, 10, s);
    const char *out = nh_arena_printf(w->arena, "c = (1, %s)", text);
    flint_free(text);
    fmpq_clear(s);
    return out;
}

/* The lines at the roots of an irreducible factor g: mu = `rate` modulo g, and the eigenvalue beside k - 1 is
 * trace/mu - (k - 1), an element of Q[s]/(g). */
static void test_factor(nh_darboux_work *w, const plane *p, const fmpz_poly_t g)
{
    fmpq_poly_t f, mu, inverse, other, lambda;
    fmpq_t value;
    fmpq_poly_struct *const all[] = {f, mu, inverse, other, lambda};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) fmpq_poly_init(all[i]);
    fmpq_init(value);
    fmpq_poly_set_fmpz_poly(f, g);
    fmpq_poly_rem(mu, p->rate, f);
    if (!fmpq_poly_is_zero(mu)) {
        w->out->points += (size_t)fmpz_poly_degree(g);
        fmpq_poly_xgcd(other, inverse, lambda, mu, f);
        fmpq_poly_mul(lambda, p->trace, inverse);
        fmpq_poly_set_si(other, w->out->degree - 1);
        fmpq_poly_sub(lambda, lambda, other);
        fmpq_poly_rem(lambda, lambda, f);
        fmpq_poly_get_coeff_fmpq(value, lambda, 0);
        if (fmpq_poly_degree(lambda) > 0 || !nh_darboux_allowed(w->out->degree, value))
            nh_darboux_refute(w, direction_words(w, g), nh_polynomial_text(w->arena, lambda, "s"));
    }
    fmpq_clear(value);
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) fmpq_poly_clear(all[i]);
}

/* V(1, s); false: the potential is no polynomial with rational coefficients. */
static bool on_directions(const nh_darboux_work *w, fmpq_poly_t f)
{
    enum { most_terms = 1000 };
    nh_monomials m;
    fmpq_t value;
    if (w->n != 2 || w->out->degree < 0) return false;
    for (size_t i = 0; i < w->n; i++)
        if (!nh_monomials_has_degree(w->dag, w->potential, w->q[i])) return false;
    if (!nh_monomials_of(w->dag, w->potential, w->n, w->q, most_terms, &m)) return false;
    bool good = true;
    fmpq_init(value);
    for (size_t i = 0; i < m.count && good; i++) {
        slong power = m.exponent[i * m.symbols + 1];
        good = nh_rational_value_of(w->dag, m.coefficient[i], value);
        /* Equal powers of y belong to equal monomials. */
        if (good && !fmpq_is_zero(value)) fmpq_poly_set_coeff_fmpq(f, power, value);
    }
    fmpq_clear(value);
    nh_monomials_clear(&m);
    return good;
}

bool nh_darboux_plane(nh_darboux_work *w)
{
    static const long up[] = {0, 1};
    fmpq_poly_t f;
    fmpz_poly_t turn;
    plane p;
    fmpq_poly_init(f);
    bool good = on_directions(w, f);
    if (good) {
        plane_each(&p, fmpq_poly_init);
        plane_fill(&p, w, f);
        good = !fmpq_poly_is_zero(p.turn);
        if (good) {
            fmpz_poly_factor_t parts;
            fmpz_poly_init(turn);
            fmpz_poly_factor_init(parts);
            fmpq_poly_get_numerator(turn, p.turn);
            fmpz_poly_factor(parts, turn);
            for (slong i = 0; i < parts->num; i++) test_factor(w, &p, parts->p + i);
            fmpz_poly_factor_clear(parts);
            fmpz_poly_clear(turn);
            nh_darboux_try(w, up);
        }
        plane_each(&p, fmpq_poly_clear);
    }
    fmpq_poly_clear(f);
    return good;
}

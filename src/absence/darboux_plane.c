/* darboux_plane: all straight lines of a polynomial potential in two coordinates.
 *
 * On (1, s), with f(s) = V(1, s): V_x = k f - s f', V_y = f', V_xx = k (k - 1) f - 2 (k - 1) s f' + s^2 f'',
 * V_xy = (k - 1) f' - s f'', V_yy = f''.  The roots of (M^-1 V')_y - s (M^-1 V')_x are the lines. */
#include <flint/fmpz_poly_factor.h>

#include "absence/darboux_internal.h"
#include "absence/polynomial_text.h"
#include "absence/rational_value.h"
#include "graph/dag.h"
#include "graph/monomials.h"

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
        if (fmpq_poly_degree(lambda) > 0 || nh_darboux_excluded(w->arena, w->out->degree, value))
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
    const nh_ex up[] = {nh_int(w->dag, 0), nh_int(w->dag, 1)};
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
            nh_darboux_try(w, up, NULL);
        }
        plane_each(&p, fmpq_poly_clear);
    }
    fmpq_poly_clear(f);
    return good;
}

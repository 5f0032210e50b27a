/* higher_system: two equations of motion as polynomials, and what is wanted of them. */
#include "absence/higher_internal.h"
#include "absence/rational_value.h"
#include "graph/dag.h"
#include "graph/monomials.h"

enum { most_terms = 100, most_exponent = 30, cubic = 3 };

void nh_higher_system_init(nh_higher_system *s)
{
    *s = (nh_higher_system){0};
    fmpq_poly_init(s->curve);
    fmpq_poly_init(s->normal);
}

static void polynomial_clear(nh_higher_polynomial *p)
{
    for (size_t i = 0; i < p->count; i++) fmpq_clear(p->coefficient + i);
    nh_free(p->coefficient);
    nh_free(p->u);
    nh_free(p->z);
}

void nh_higher_system_clear(nh_higher_system *s)
{
    for (size_t i = 0; i < NH_HIGHER_DIRECTIONS; i++) polynomial_clear(&s->rate[i]);
    fmpq_poly_clear(s->curve);
    fmpq_poly_clear(s->normal);
}

/* Appends one term; false: its coefficient is not rational, or its degree is too high. */
static bool add_term(nh_dag *dag, const nh_monomials *m, size_t i, nh_higher_polynomial *p)
{
    const unsigned char *exponent = m->exponent + i * m->symbols;
    fmpq *at = p->coefficient + p->count;
    fmpq_init(at);
    bool good = nh_rational_value_of(dag, m->coefficient[i], at);
    if (!good || fmpq_is_zero(at)) {
        fmpq_clear(at);
        return good;
    }
    p->u[p->count] = exponent[0];
    p->z[p->count++] = exponent[1];
    return exponent[0] <= NH_HIGHER_DEGREE && exponent[1] <= NH_HIGHER_DEGREE;
}

bool nh_higher_polynomial_of(nh_dag *dag, nh_ex e, nh_ex u, nh_ex z, nh_higher_polynomial *p)
{
    const nh_ex symbol[] = {u, z};
    nh_monomials m;
    if (!nh_monomials_has_degree(dag, e, u) || !nh_monomials_has_degree(dag, e, z)) return false;
    if (!nh_monomials_of(dag, e, 2, symbol, most_terms, &m)) return false;
    p->coefficient = nh_alloc_array(m.count + 1, sizeof *p->coefficient);
    p->u = nh_alloc_array(m.count + 1, 1);
    p->z = nh_alloc_array(m.count + 1, 1);
    bool good = true;
    for (size_t i = 0; i < m.count && good; i++) good = add_term(dag, &m, i, p);
    nh_monomials_clear(&m);
    return good;
}

void nh_higher_polynomial_part(const nh_higher_polynomial *p, unsigned z, fmpq_poly_t out)
{
    fmpq_t sum;
    fmpq_init(sum);
    fmpq_poly_zero(out);
    for (size_t i = 0; i < p->count; i++) {
        if (p->z[i] != z) continue;
        fmpq_poly_get_coeff_fmpq(sum, out, p->u[i]);
        fmpq_add(sum, sum, p->coefficient + i);
        fmpq_poly_set_coeff_fmpq(out, p->u[i], sum);
    }
    fmpq_clear(sum);
}

/* n >= 0 with n (n + 1) = N; -1: there is none, or it is too large. */
static slong whole_exponent(const fmpq_t N)
{
    if (!fmpz_is_one(fmpq_denref(N))) return -1;
    for (slong n = 0; n <= most_exponent; n++)
        if (fmpz_equal_si(fmpq_numref(N), n * (n + 1))) return n;
    return -1;
}

/* With u = 4/(sigma_3 t^2) + .. the equation of z_1 is z_1'' = (4 normal_1/sigma_3) t^-2 z_1 + .. */
static slong exponent_of(const nh_higher_system *s)
{
    enum { four = 4 };
    fmpq_t N, leading;
    fmpq_init(N);
    fmpq_init(leading);
    fmpq_poly_get_coeff_fmpq(N, s->normal, 1);
    fmpq_poly_get_coeff_fmpq(leading, s->curve, cubic);
    fmpq_div(N, N, leading);
    fmpq_set_si(leading, four, 1);
    fmpq_mul(N, N, leading);
    slong n = whole_exponent(N);
    fmpq_clear(N);
    fmpq_clear(leading);
    return n;
}

/* Is sigma' = 2 f(u, 0)? */
static bool moves_along(const nh_higher_system *s)
{
    fmpq_poly_t slope, twice;
    fmpq_poly_init(slope);
    fmpq_poly_init(twice);
    fmpq_poly_derivative(slope, s->curve);
    nh_higher_polynomial_part(&s->rate[NH_HIGHER_ALONG], 0, twice);
    fmpq_poly_scalar_mul_ui(twice, twice, 2);
    bool good = fmpq_poly_equal(slope, twice);
    fmpq_poly_clear(slope);
    fmpq_poly_clear(twice);
    return good;
}

const char *nh_higher_system_complete(nh_higher_system *s, const nh_higher_polynomial *square)
{
    nh_higher_polynomial_part(square, 0, s->curve);
    if (fmpq_poly_degree(s->curve) != cubic || !fmpq_poly_is_squarefree(s->curve))
        return "the curve is not of genus 1 with one point at infinity";
    if (!moves_along(s)) return "the curve is not that of the motion";
    nh_higher_polynomial_part(&s->rate[NH_HIGHER_ACROSS], 0, s->normal);
    if (!fmpq_poly_is_zero(s->normal)) return "the plane is not invariant";
    nh_higher_polynomial_part(&s->rate[NH_HIGHER_ACROSS], 1, s->normal);
    if (fmpq_poly_degree(s->normal) > 1) return "the normal equation is irregular where the motion has its pole";
    s->exponent = exponent_of(s);
    return s->exponent < 0 ? "the exponents where the motion has its pole are not whole, or too large" : NULL;
}

/* higher_connected: why the group of the first variational equation is connected.
 *
 * With x = u the equation of z_1 is  sigma z'' + sigma'/2 z' = normal z.  Paths are followed in the x-plane, and
 * (z, dz/dx) along them.  The Wronskian of two solutions is a number over u', so a closed path multiplies it by the
 * sign with which u' returns: where the determinant is 1, and not -1, the path is closed on the curve.  There
 * (z, dz/dx) and (z, dz/dt) differ by u', which returns, so that the matrices have the same trace. */
#include "absence/higher_internal.h"
#include "absence/monodromy_internal.h"
#include "base/foreign_memory.h"

enum { roots = 3 };

/* ---- the equation ---- */

/* d(z, dz/dx)/dx */
static void equation_of(const nh_higher_system *s, nh_linear_equation *equation)
{
    fmpq_poly_t num, den;
    fmpq_poly_init(num);
    fmpq_poly_init(den);
    nh_linear_equation_init(equation, 2);
    fmpq_poly_one(den);
    nh_linear_equation_set(equation, 0, 1, den, den);
    nh_linear_equation_set(equation, 1, 0, s->normal, s->curve);
    fmpq_poly_derivative(num, s->curve);
    fmpq_poly_scalar_mul_si(den, s->curve, -2);
    nh_linear_equation_set(equation, 1, 1, num, den);
    nh_linear_equation_reduce(equation);
    fmpq_poly_clear(num);
    fmpq_poly_clear(den);
}

/* ---- multipliers ---- */

/* Is the determinant certainly not -1, so that it is 1? */
static bool returns(const acb_mat_t g, long bits)
{
    acb_t d;
    acb_init(d);
    acb_mat_det(d, g, bits);
    acb_add_ui(d, d, 1, bits);
    bool good = acb_is_finite(d) && !acb_contains_zero(d);
    acb_clear(d);
    return good;
}

/* Is the trace of a matrix of determinant 1 certainly not in [-2, 2]?  Then no multiplier has the absolute value 1. */
static bool stretches(const acb_t trace)
{
    arb_t size;
    arb_init(size);
    arb_abs(size, acb_realref(trace));
    arb_sub_ui(size, size, 2, ARF_PREC_EXACT);
    bool is = acb_is_finite(trace) && (arb_is_positive(size) || !arb_contains_zero(acb_imagref(trace)));
    arb_clear(size);
    return is;
}

/* The larger absolute value of the roots of mu^2 - trace mu + 1. */
static void modulus(arb_t size, const acb_t trace, long bits)
{
    acb_t root, other;
    arb_t second;
    acb_init(root);
    acb_init(other);
    arb_init(second);
    acb_mul(root, trace, trace, bits);
    acb_sub_ui(root, root, 4, bits);
    bool left = arb_is_negative(acb_realref(root));
    if (left) acb_neg(root, root);
    acb_sqrt(root, root, bits);
    if (left) acb_mul_onei(root, root);
    acb_sub(other, trace, root, bits);
    acb_add(root, trace, root, bits);
    acb_abs(size, root, bits);
    acb_abs(second, other, bits);
    arb_max(size, size, second, bits);
    arb_mul_2exp_si(size, size, -1);
    acb_clear(root);
    acb_clear(other);
    arb_clear(second);
}

/* The path around two zeros of sigma, one after the other. */
static bool pair(const nh_monodromy_sum *sum, const nh_monodromy_element first, const nh_monodromy_element second,
                 acb_t trace)
{
    acb_mat_t g;
    acb_mat_init(g, 2, 2);
    acb_mat_mul(g, second, first, sum->bits);
    acb_mat_trace(trace, g, sum->bits);
    bool good = returns(g, sum->bits) && stretches(trace);
    acb_mat_clear(g);
    return good;
}

static bool any_pair(nh_monodromy_sum *sum, acb_t trace)
{
    nh_monodromy_element loop[roots];
    bool good = true, found = false;
    for (size_t i = 0; i < roots; i++) {
        loop[i] = nh_monodromy_element_new(sum);
        good = good && nh_monodromy_loop(sum, i, loop[i]);
    }
    for (size_t i = 0; i < roots && good; i++)
        for (size_t k = 0; k < i && !found; k++) found = pair(sum, loop[k], loop[i], trace);
    for (size_t i = 0; i < roots; i++) nh_monodromy_element_free(sum, loop[i]);
    return found;
}

bool nh_higher_multiplier(const nh_higher_system *s, long bits, acb_t trace, arb_t size)
{
    nh_linear_equation equation;
    nh_monodromy_sum sum;
    nh_foreign_memory_begin();
    equation_of(s, &equation);
    bool found = nh_monodromy_sum_init(&sum, 1, &equation, bits) && sum.points == roots && any_pair(&sum, trace);
    if (found) modulus(size, trace, bits);
    nh_monodromy_sum_clear(&sum);
    nh_linear_equation_clear(&equation);
    return found;
}

/* ---- solutions ---- */

/* sigma P'' + first P' + zeroth P for z = P:      first = sigma'/2,    zeroth = -normal
 *                              for z = u' P:   first = 3 sigma'/2,  zeroth = sigma''/2 - normal */
typedef struct {
    fmpq_poly_t first, zeroth; /* factors of P' and of P */
    const fmpq_poly_struct *second;
} operation;

static void operation_init(operation *o, const nh_higher_system *s, bool odd)
{
    enum { thrice = 3 };
    fmpq_poly_init(o->first);
    fmpq_poly_init(o->zeroth);
    o->second = s->curve;
    fmpq_poly_derivative(o->first, s->curve);
    if (odd) {
        fmpq_poly_derivative(o->zeroth, o->first);
        fmpq_poly_scalar_div_ui(o->zeroth, o->zeroth, 2);
        fmpq_poly_scalar_mul_ui(o->first, o->first, thrice);
    }
    fmpq_poly_scalar_div_ui(o->first, o->first, 2);
    fmpq_poly_sub(o->zeroth, o->zeroth, s->normal);
}

/* out = the operation, applied to P */
static void apply(const operation *o, const fmpq_poly_t P, fmpq_poly_t out)
{
    fmpq_poly_t slope, term;
    fmpq_poly_init(slope);
    fmpq_poly_init(term);
    fmpq_poly_mul(out, o->zeroth, P);
    fmpq_poly_derivative(slope, P);
    fmpq_poly_mul(term, o->first, slope);
    fmpq_poly_add(out, out, term);
    fmpq_poly_derivative(slope, slope);
    fmpq_poly_mul(term, o->second, slope);
    fmpq_poly_add(out, out, term);
    fmpq_poly_clear(slope);
    fmpq_poly_clear(term);
}

/* P of the degree d, monic: its lower coefficients one after another, so that the powers x^(d + 1), .., x^1 of what is
 * left vanish.  Is nothing left? */
static bool solve(const operation *o, slong degree, fmpq_poly_t P)
{
    fmpq_poly_t left, power, image;
    fmpq_t value, factor;
    fmpq_poly_init(left);
    fmpq_poly_init(power);
    fmpq_poly_init(image);
    fmpq_init(value);
    fmpq_init(factor);
    fmpq_poly_zero(P);
    fmpq_poly_set_coeff_si(P, degree, 1);
    apply(o, P, left);
    bool good = true;
    for (slong j = degree - 1; j >= 0 && good; j--) {
        fmpq_poly_zero(power);
        fmpq_poly_set_coeff_si(power, j, 1);
        apply(o, power, image);
        fmpq_poly_get_coeff_fmpq(value, left, j + 1);
        fmpq_poly_get_coeff_fmpq(factor, image, j + 1);
        good = !fmpq_is_zero(factor);
        if (!good) break;
        fmpq_div(value, value, factor);
        fmpq_neg(value, value);
        fmpq_poly_set_coeff_fmpq(P, j, value);
        fmpq_poly_scalar_mul_fmpq(image, image, value);
        fmpq_poly_add(left, left, image);
    }
    good = good && fmpq_poly_is_zero(left);
    fmpq_poly_clear(left);
    fmpq_poly_clear(power);
    fmpq_poly_clear(image);
    fmpq_clear(value);
    fmpq_clear(factor);
    return good;
}

/* A solution that is single-valued on the curve has its only pole at infinity, of order n in t, where u has one of
 * order 2, and u' one of order 3: it is P(u) for even n, u' P(u) for odd n. */
bool nh_higher_solution(const nh_higher_system *s, fmpq_poly_t P, bool *odd)
{
    enum { order = 3 };
    *odd = s->exponent % 2;
    slong degree = (s->exponent - (*odd ? order : 0)) / 2;
    if (*odd && s->exponent < order) return false;
    operation o;
    operation_init(&o, s, *odd);
    bool found = solve(&o, degree, P);
    fmpq_poly_clear(o.first);
    fmpq_poly_clear(o.zeroth);
    return found;
}

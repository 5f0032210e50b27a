/* normal_equation_curve: the curve w^2 = sigma(x) at one level of an integral.
 *
 *     F = m(x) w^2/2 + V(x) on the plane,   sigma = 2 (h - V)/m */
#include "absence/normal_equation_internal.h"

#include "base/text.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/node.h"
#include "graph/num.h"
#include "graph/num_long.h"
#include "graph/print.h"

/* Levels that are tried: small, of both signs, and rarely those of an equilibrium. */
static const struct {
    slong top;
    ulong bottom;
} level[] = {{1, 7},  {1, 3},  {2, 5},  {3, 2},  {5, 11}, {-1, 3}, {7, 3},  {-2, 7}, {11, 5},  {1, 19},
             {-3, 2}, {13, 4}, {-9, 4}, {17, 3}, {23, 5}, {-7, 2}, {31, 3}, {1, 97}, {-41, 6}, {53, 2}};
enum { levels = sizeof level / sizeof *level };

/* m, V, and what else m w^2/2 + V would have. */
enum { part_value, part_slope, part_inertia, parts };

/* num/den on the plane at w = 0 */
static bool parts_of(const nh_normal_work *work, size_t k, nh_curve_element *part, const char **why)
{
    nh_curve_place at_rest = work->place;
    nh_curve_state state[parts];
    const char *obstacle[parts];
    nh_ex w = work->plane->y[1], e[parts];
    at_rest.rest = true;
    e[part_value] = work->integral[k];
    e[part_slope] = nh_diff(work->dag, e[part_value], w);
    e[part_inertia] = nh_diff(work->dag, e[part_slope], w);
    nh_curve_value(&at_rest, parts, e, part, state, obstacle);
    for (size_t i = 0; i < parts; i++)
        if (state[i] != NH_CURVE_FINE) *why = obstacle[i];
    if (*why) return false;
    if (!nh_curve_field_is_zero(&part[part_slope])) *why = "the integral is not even in the velocity";
    else if (nh_curve_field_is_zero(&part[part_inertia])) *why = "the integral is not quadratic in the velocity";
    return !*why;
}

/* out = 2 (h - V)/m */
static void square_from(const nh_normal_work *work, const nh_curve_element *difference, const nh_curve_element *inertia,
                        nh_curve_element *out)
{
    fmpq_t two;
    fmpq_init(two);
    fmpq_set_si(two, 2, 1);
    nh_curve_field_inv(&work->field, out, inertia);
    nh_curve_field_mul(&work->field, out, out, difference);
    nh_curve_field_scale(out, out, two);
    fmpq_clear(two);
}

/* Is w^2 no square in Q(x), so that K is a field? */
static bool is_field(const nh_normal_work *work, const nh_curve_element *difference, const nh_curve_element *inertia)
{
    nh_curve_element square;
    nh_curve_field_element_init(&square);
    square_from(work, difference, inertia, &square);
    bool good = !nh_curve_field_sqrt(&square, &square, NH_CURVE_FAR);
    nh_curve_field_element_clear(&square);
    return good;
}

/* h - V, without a double zero, also where tan(x/2) is infinite? */
static bool is_simple(const nh_normal_work *work, const nh_curve_element *difference)
{
    fmpz_poly_t slope;
    fmpz_poly_init(slope);
    fmpz_poly_derivative(slope, difference->even);
    fmpz_poly_gcd(slope, slope, difference->even);
    bool simple = !nh_curve_field_is_zero(difference) && fmpz_poly_degree(slope) <= 0;
    if (work->plane->angle) simple &= fmpz_poly_degree(difference->even) >= fmpz_poly_degree(difference->den);
    fmpz_poly_clear(slope);
    return simple;
}

/* The n-th level for which that is so; of an integral for which it never is, the n-th of all. */
static bool choose_level(const nh_normal_work *work, const nh_curve_element *part, size_t n, fmpq_t h,
                         nh_curve_element *difference)
{
    fmpq_t minus;
    nh_curve_element negative;
    fmpq_init(minus);
    nh_curve_field_element_init(&negative);
    fmpq_set_si(minus, -1, 1);
    nh_curve_field_scale(&negative, &part[part_value], minus);
    size_t found = 0, any = 0;
    bool good = false;
    for (int strict = 1; strict >= 0 && found == 0; strict--)
        for (size_t i = 0; i < levels && !good; i++) {
            fmpq_set_si(h, level[i].top, level[i].bottom);
            nh_curve_field_set_fmpq(difference, h);
            nh_curve_field_add(difference, difference, &negative);
            if (!is_field(work, difference, &part[part_inertia])) continue;
            if (!strict) good = any++ == n;
            else if (is_simple(work, difference)) good = found++ == n;
        }
    fmpq_clear(minus);
    nh_curve_field_element_clear(&negative);
    return good;
}

/* w^2 = 2 (h - V)/m, and the proof that the integral is h there: it has no further terms. */
static bool set_curve(nh_normal_work *work, size_t k, const nh_curve_element *difference,
                      const nh_curve_element *inertia, const fmpq_t h)
{
    nh_curve_element square, value, expected;
    nh_curve_state state;
    nh_curve_field_element_init(&square);
    nh_curve_field_element_init(&value);
    nh_curve_field_element_init(&expected);
    square_from(work, difference, inertia, &square);
    fmpz_poly_set(work->field.num, square.even);
    fmpz_poly_set(work->field.den, square.den);
    nh_curve_value(&work->place, 1, &work->integral[k], &value, &state, NULL);
    nh_curve_field_set_fmpq(&expected, h);
    bool good = state == NH_CURVE_FINE && nh_curve_field_equal(&value, &expected);
    nh_curve_field_element_clear(&square);
    nh_curve_field_element_clear(&value);
    nh_curve_field_element_clear(&expected);
    return good;
}

static nh_ex number_of(nh_dag *dag, const fmpq_t value)
{
    mpq_t q;
    mpq_init(q);
    fmpq_get_mpq(q, value);
    nh_ex e = nh_number(dag, nh_num_of_mpq(q));
    mpq_clear(q);
    return e;
}

static nh_ex polynomial_of(nh_dag *dag, const fmpz_poly_t p, nh_ex x)
{
    nh_ex e = nh_int(dag, 0);
    fmpq_t c;
    fmpq_init(c);
    for (slong i = 0; i < fmpz_poly_length(p); i++) {
        fmpz_poly_get_coeff_fmpz(fmpq_numref(c), p, i);
        e = nh_add(dag, e, nh_mul(dag, number_of(dag, c), nh_powi(dag, x, i)));
    }
    fmpq_clear(c);
    return e;
}

/* e on the plane at w = 0 */
static nh_ex at_rest(const nh_normal_work *work, nh_ex e)
{
    size_t n = work->normals + 1;
    nh_ex *zero = nh_alloc_array(n, sizeof *zero);
    for (size_t i = 0; i < n; i++) zero[i] = nh_int(work->dag, 0);
    e = nh_substitute(work->dag, e, n, work->plane->y + 1, zero);
    nh_free(zero);
    return e;
}

/* The square of w as a formula: of an angle in its sines and cosines. */
static nh_ex square_of(const nh_normal_work *work, nh_ex h)
{
    nh_dag *dag = work->dag;
    nh_ex x = work->plane->y[0], w = work->plane->y[1];
    if (!work->plane->angle) {
        nh_ex e = nh_div(dag, polynomial_of(dag, work->field.num, x), polynomial_of(dag, work->field.den, x));
        return nh_simplify(dag, e);
    }
    nh_ex F = work->integral[work->determines];
    nh_ex inertia = at_rest(work, nh_diff(dag, nh_diff(dag, F, w), w));
    nh_ex twice = nh_mul(dag, nh_int(dag, 2), nh_sub(dag, h, at_rest(work, F)));
    return nh_simplify(dag, nh_div(dag, twice, inertia));
}

static void describe(nh_normal_work *work, const fmpq_t h)
{
    nh_dag *dag = work->dag;
    const char *name = nh_name_of(dag, work->plane->y[0]);
    work->out->level = number_of(dag, h);
    work->out->square = square_of(work, work->out->level);
    char *square = nh_print_string(dag, work->out->square);
    work->out->curve = nh_arena_printf(work->arena, "%s^2 = %s", nh_name_of(dag, work->plane->y[1]), square);
    work->out->variable = work->plane->angle ? nh_arena_printf(work->arena, "tan(%s/2)", name) : name;
    nh_free(square);
}

/* The curve from integral k; false with the reason. */
static bool curve_from(nh_normal_work *work, size_t k, size_t n, const char **why)
{
    nh_curve_element *part = nh_curve_field_elements(parts), difference;
    fmpq_t h;
    fmpq_init(h);
    nh_curve_field_element_init(&difference);
    bool good = parts_of(work, k, part, why);
    if (good && !choose_level(work, part, n, h, &difference)) {
        *why = "no further level is tried";
        good = false;
    }
    if (good && !set_curve(work, k, &difference, &part[part_inertia], h)) {
        *why = "the integral is not quadratic in the velocity";
        good = false;
    }
    work->determines = k;
    if (good) describe(work, h);
    fmpq_clear(h);
    nh_curve_field_element_clear(&difference);
    nh_curve_field_elements_free(part, parts);
    return good;
}

bool nh_normal_equation_curve(nh_normal_work *work, size_t n)
{
    const nh_known_integrals *known = work->known;
    const char *first = "no integral determines the curve";
    if (known->energy < known->count) {
        first = NULL;
        if (curve_from(work, known->energy, n, &first)) return true;
    }
    for (size_t k = 0; k < known->count; k++) {
        const char *why = NULL;
        if (k != known->energy && curve_from(work, k, n, &why)) return true;
    }
    return nh_normal_equation_refuse(work, first);
}

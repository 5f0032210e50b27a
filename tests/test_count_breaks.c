/* Attempts to break the count: other points and primes, plateaus, systems that fall apart, related functions, leaves, and brute force. */
#include <criterion/criterion.h>
#include <stdio.h>
#include <string.h>

#include "exact/residue_matrix.h"
#include "count/count_internal.h"
#include "problem/analysis_file.h"
#include "names.h"

static nh_model *model_of(nh_system *s)
{
    nh_error error = {0};
    nh_model *o = nh_model_create(s, nh_chart_create(s, NH_CHART_AUTO, 1, &error), &error);
    cr_assert_not_null(o, "%s", error.what);
    return o;
}

/* N(0), .., N(order) at the point that follows from `attempt`; false: it is a singular one. */
static bool totals_at(const nh_model *o, size_t degree, size_t order, size_t attempt, size_t *total)
{
    nh_count_question q = {.degree = degree, .work = 1e12};
    nh_counter c;
    nh_counter_open(&c, o, &q, false);
    bool regular = nh_count_regular_point(&c, attempt);
    nh_count_series *s = regular ? nh_count_series_create(&c, order, INFINITY, &regular) : NULL;
    memset(total, 0, (order + 1) * sizeof *total);
    if (s) {
        nh_graded_problem p = nh_count_problem(&c, s, degree, NH_ALL_DEGREES);
        nh_graded_count *g = nh_graded_solve(&p);
        cr_assert(g->solved);
        memcpy(total, g->total, (order + 1) * sizeof *total);
        nh_graded_count_clear(g);
    }
    bool good = s != NULL;
    nh_count_series_free(s);
    nh_counter_close(&c);
    return good;
}

static nh_count count_text(const char *text, size_t degree)
{
    nh_system *s = system_of(text);
    nh_model *o = model_of(s);
    nh_count_question q = {.degree = degree, .work = 1e10};
    nh_count c = nh_count_integrals(o, &q);
    nh_model_free(o);
    nh_system_free(s);
    return c;
}

static void expect(const char *text, size_t degrees, const size_t *bound)
{
    nh_count c = count_text(text, degrees);
    cr_assert_null(c.obstacle, "%s: %s", text, c.obstacle);
    cr_assert_eq(c.rows, degrees, "%s", text);
    for (size_t d = 0; d < degrees; d++) cr_expect_eq(c.row[d].bound, bound[d], "%s\ndegree %zu: %zu instead of %zu", text, d + 1, c.row[d].bound, bound[d]);
}

#define EXPECT(text, ...) expect(text, sizeof((size_t[]){__VA_ARGS__}) / sizeof(size_t), (size_t[]){__VA_ARGS__})
#define PLANE(potential) "name: p\ncoordinates: [x, y]\ndomain: {x: [0.5, 1.5], y: [0.5, 1.5]}\nlagrangian: (x'^2 + y'^2)/2 - (" potential ")\n"

/* ---- from one order to the next ---- */

/* Series of order 5, then 6 and 9, against order 9 at once: brackets of weight 1, 2 and 3, and conditions that are kept or substituted. */
Test(breaks, a_lower_order_is_a_beginning)
{
    enum { orders = 3, degree = 3 };
    static const size_t ORDER[orders] = {5, 6, 9};
    static const char *const TEXT[] = {PLANE("x^2*y + y^3/3 + (x^2 + y^2)/2"), PLANE("1/sqrt(x^2 + y^2)"),
                                       "name: c\ncoordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2 - y^2/2\nconstraints: [\"z' = y*x'\"]\n",
                                       "name: e\ncoordinates: [x, y, z, u]\nlagrangian: (x'^2 + y'^2 + z'^2 + u'^2)/2\nconstraints: [\"z' = y*x'\", \"u' = z*x'\"]\n"};
    for (size_t i = 0; i < sizeof TEXT / sizeof *TEXT; i++) {
        nh_system *y = system_of(TEXT[i]);
        nh_model *o = model_of(y);
        nh_count_question q = {.degree = degree, .work = 1e12};
        nh_counter c;
        nh_counter_open(&c, o, &q, false);
        bool regular = false;
        for (size_t attempt = 0; !regular; attempt++)
            if (nh_count_regular_point(&c, attempt)) nh_count_series_free(nh_count_series_create(&c, 1, INFINITY, &regular));
        nh_graded_state *state = NULL;
        for (size_t k = 0; k < orders; k++) {
            nh_count_series *s = nh_count_series_create(&c, ORDER[k], INFINITY, &regular);
            nh_graded_problem p = nh_count_problem(&c, s, degree, NH_ALL_DEGREES);
            nh_graded_count *whole = nh_graded_solve(&p), *rest = nh_graded_continue(&p, &state);
            cr_assert(whole->solved && rest->solved && state);
            size_t N = whole->total[ORDER[k]];
            cr_expect_arr_eq(rest->total, whole->total, (ORDER[k] + 1) * sizeof *whole->total, "%s", TEXT[i]);
            cr_expect(rest->injective == whole->injective && rest->injective_at == whole->injective_at);
            cr_expect(rest->most == whole->most && rest->alphas == whole->alphas);
            cr_expect_arr_eq(rest->jet, whole->jet, whole->alphas * (1 + s->ring->variables) * N * sizeof *whole->jet, "%s", TEXT[i]);
            nh_graded_count_clear(rest);
            nh_graded_count_clear(whole);
            nh_count_series_free(s);
        }
        nh_graded_state_free(state);
        nh_counter_close(&c);
        nh_model_free(o);
        nh_system_free(y);
    }
}

/* ---- points and primes ---- */

Test(breaks, all_points_and_primes_give_the_same_number)
{
    enum { order = 8, attempts = 12 };
    static const char *const TEXT[] = {PLANE("1/sqrt(x^2 + y^2)"), PLANE("x^2*y + y^3/3 + (x^2 + y^2)/2"), PLANE("exp(x - y) + exp(-x) + exp(y)")};
    for (size_t i = 0; i < sizeof TEXT / sizeof *TEXT; i++) {
        nh_system *s = system_of(TEXT[i]);
        nh_model *o = model_of(s);
        size_t least = SIZE_MAX, tried = 0, same = 0, total[order + 1];
        for (size_t attempt = 0; attempt < attempts; attempt++) {
            if (!totals_at(o, 3, order, attempt, total)) continue;
            tried++;
            same = total[order] < least ? 1 : same + (total[order] == least);
            least = total[order] < least ? total[order] : least;
        }
        cr_expect(tried >= 3 && same == tried, "%s: %zu of %zu points", TEXT[i], same, tried); /* an unlucky one could only have more */
        nh_model_free(o);
        nh_system_free(s);
    }
}

/* A prime as small as 11 gave wrong numbers: all that are used are far larger than any order, and large enough for sums of products. */
Test(breaks, primes_are_never_small)
{
    for (size_t i = 0; i < 100; i += 7) cr_expect_gt(nh_prime_at(i).p, (uint64_t)1 << 30);
}

/* ---- plateaus ---- */

/* N stays the same for some orders, and falls later.  The number that is a bound and called settled is the last. */
static void falls_later(const char *text, size_t degree, size_t order)
{
    nh_system *s = system_of(text);
    nh_model *o = model_of(s);
    size_t *total = nh_alloc_array(order + 1, sizeof *total), attempt = 0, plateaus = 0;
    while (!totals_at(o, degree, order, attempt, total)) attempt++;
    for (size_t k = 1; k < order; k++) plateaus += total[k] == total[k + 1] && total[k] > total[order];
    nh_count_question q = {.degree = degree, .work = 1e10};
    nh_count c = nh_count_integrals(o, &q);
    cr_assert_eq(c.rows, degree, "%s", text);
    const nh_count_row *row = &c.row[degree - 1];
    cr_expect_gt(plateaus, 0, "%s: this is no trap", text);
    cr_expect(row->bounded && row->bound == total[order], "%s: %zu, %zu at last", text, row->bound, total[order]);
    nh_free(total);
    nh_model_free(o);
    nh_system_free(s);
}

Test(breaks, plateaus_are_not_taken_for_the_end)
{
    /* step 2: 10 15 25 25 25 11 7 3 3 ..; step 3: 3 3 4 4 3 2 2 .. and 3 3 3 3 2 1 1 .. */
    falls_later("name: c\ncoordinates: [x, y, z]\nconstraints: [\"z' = y*x'\"]\nlagrangian: (x'^2 + y'^2 + z'^2)/2 - (x^2 + y^2 + z^2)/2\n", 3, 14);
    falls_later("name: e\ncoordinates: [x, y, z, u]\nconstraints: [\"y' = z*x'\", \"z' = u*x'\"]\nlagrangian: (x'^2 + y'^2 + z'^2 + u'^2)/2 - x^2\n", 1, 16);
    falls_later("name: e\ncoordinates: [x, y, z, u]\nconstraints: [\"y' = z*x'\", \"z' = u*x'\"]\nlagrangian: (x'^2 + u'^2)/2 - z*u\n", 1, 16);
}

/* ---- systems that fall apart ---- */

/* Products of the energies of the parts: partitions of the degree by twos. */
Test(breaks, decoupled_systems_have_the_energies_of_their_parts)
{
    EXPECT(PLANE("x^4 + x + y^4 - 2*y^3"), 1, 3, 3, 6, 6, 10);
    EXPECT("name: d\ncoordinates: [x, y, z]\nlagrangian: (x'^2 + 2*y'^2 + 3*z'^2)/2 - x^4 + y^3 - y^4 - z^5\n", 1, 4, 4, 10);
    EXPECT("name: d\ncoordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2 - x^2*y^3 - x^4 - y - z^4 + z\n", 1, 3, 3, 6); /* two, and one */
}

/* ---- functions that are related ---- */

/* A potential that is zero, or constant, as written in no obvious way: the plane's Killing tensors remain. */
Test(breaks, related_functions_stay_related)
{
    EXPECT(PLANE("sqrt(1 + x^2)*sqrt(1 + y^2) - sqrt((1 + x^2)*(1 + y^2))"), 4, 10);
    EXPECT(PLANE("exp(x/2)*exp(y/3) - exp(x/2 + y/3)"), 4, 10);
    EXPECT(PLANE("cos(x)^2*cos(y)^2 + sin(x)^2*cos(y)^2 + sin(y)^2"), 4, 10);
    EXPECT(PLANE("cosh(2*x) - 2*cosh(x)^2 + tan(y)*cos(y) - sin(y)"), 4, 10);
    EXPECT(PLANE("(x + y)^(1/3)*(x + y)^(1/6)*(x + y)^(-1/2)*x^4 - x^4"), 4, 10);
    EXPECT(PLANE("(x + sqrt(1 + x^2))^(1/3)*(sqrt(1 + x^2) - x)^(1/3)"), 4, 10);
    EXPECT(PLANE("exp(2*log(x)) - x^2"), 4, 10);
}

/* Roots of squares of roots: residues may have the sign of another branch, which is of another system.  The first two potentials are constant. */
Test(breaks, roots_of_squares_are_no_field)
{
    EXPECT(PLANE("sqrt(1 + x + sqrt(2*x + x^2)) - (sqrt(2 + x) + sqrt(x))/sqrt(2)"), 4, 10);
    EXPECT(PLANE("sqrt(x + 2*sqrt(x) + 1) - sqrt(x)"), 4, 10);
    static const char *const ROW[] = {PLANE("sqrt(x + sqrt(x^2 + y^2)) + sqrt(sqrt(x^2 + y^2) - x)"), PLANE("sqrt(x + 2*sqrt(x) + 2) - sqrt(x)"),
                                      PLANE("sqrt(1 + x + sqrt(2*x + x^2))")};
    for (size_t i = 0; i < sizeof ROW / sizeof *ROW; i++) {
        nh_count c = count_text(ROW[i], 2);
        cr_expect_null(c.obstacle, "%s: %s", ROW[i], c.obstacle);
    }
}

/* Roots of squares without roots: the potential vanishes where the domain lies, although another sign of the root gives
   one that does not. */
Test(breaks, roots_of_squares_have_the_sign_of_the_domain)
{
    static const char *const POTENTIAL[] = {"sqrt(1 - cos(2*x))/sqrt(2) - sin(x)", "sqrt(1 - sin(x)^2) - cos(x)",
                                            "sqrt(x^2 + 2*x*y + y^2) - x - y", "sqrt(exp(2*x) + 2 + exp(-2*x)) - exp(x) - exp(-x)",
                                            "(1 - sin(x)^2)^(3/2) - cos(x)^3", "abs(x)*sqrt(y) - sqrt(x^2*y)"};
    for (size_t i = 0; i < sizeof POTENTIAL / sizeof *POTENTIAL; i++) {
        char text[300];
        snprintf(text, sizeof text, "name: s\ncoordinates: [x, y]\ndomain: {x: [0.5, 1.4], y: [0.5, 1]}\nlagrangian: (x'^2 + y'^2)/2 - (%s)\n", POTENTIAL[i]);
        nh_count c = count_text(text, 2);
        cr_expect(!c.obstacle && c.rows == 2 && c.row[0].bound == 4 && c.row[1].bound == 10, "%s: %s %zu", text, c.obstacle ? c.obstacle : "", c.row[0].bound);
    }
}

/* ---- infinitely many functions of what the constraints keep constant ---- */

Test(breaks, leaves_are_counted_one_by_one)
{
    nh_count c = count_text("name: l\ncoordinates: [x, y]\nconstraints: [\"y' = 0\"]\nlagrangian: (x'^2 + y'^2)/2 - 0*y\n", 3);
    cr_assert_null(c.obstacle, "%s", c.obstacle);
    cr_expect_eq(c.leaf, 1);
    for (size_t d = 0; d < c.rows; d++) cr_expect_eq(c.row[d].bound, d + 2, "degree %zu: %zu", d + 1, c.row[d].bound); /* powers of x' */
}

/* ---- brute force ---- */

/* Exponents of n variables of total degree at most d. */
static size_t exponents(size_t n, size_t d, uint8_t *out)
{
    size_t count = 0;
    uint8_t *e = nh_alloc(n + 1);
    for (bool more = true; more;) {
        size_t sum = 0, i = 0;
        for (size_t k = 0; k < n; k++) sum += e[k];
        if (sum <= d) {
            if (out) memcpy(out + count * n, e, n);
            count++;
        }
        for (; i < n && e[i] == d; i++) e[i] = 0;
        more = i < n;
        if (more) e[i]++;
    }
    nh_free(e);
    return count;
}

static size_t find(size_t n, size_t count, const uint8_t *list, const uint8_t *e)
{
    for (size_t i = 0; i < count; i++)
        if (!memcmp(list + i * n, e, n)) return i;
    return SIZE_MAX;
}

/* Polynomials in x and w, of degree d at most in either, with sum w_i d/dx_i Phi = 0: the kernel of one dense matrix. */
static size_t kernel_of_free_motion(size_t n, size_t d)
{
    nh_prime f = nh_prime_at(3);
    size_t xs = exponents(n, d, NULL), ws = exponents(n, d + 1, NULL), own = exponents(n, d, NULL), columns = xs * own, rows = xs * ws;
    uint8_t *x = nh_alloc(xs * n), *w = nh_alloc(ws * n), *v = nh_alloc(own * n), *e = nh_alloc(2 * n);
    exponents(n, d, x);
    exponents(n, d + 1, w);
    exponents(n, d, v);
    nh_residue *a = nh_alloc_array(rows * columns, sizeof *a);
    for (size_t j = 0; j < columns; j++)
        for (size_t i = 0; i < n; i++) {
            memcpy(e, x + j / own * n, n);
            memcpy(e + n, v + j % own * n, n);
            if (!e[i]) continue;
            nh_residue factor = e[i]--;
            e[n + i]++;
            size_t row = find(n, xs, x, e) * ws + find(n, ws, w, e + n);
            a[row * columns + j] = nh_residue_add(f, a[row * columns + j], factor);
        }
    size_t rank = nh_residue_matrix_rank(f, rows, columns, a);
    nh_free(a);
    nh_free(e);
    nh_free(v);
    nh_free(w);
    nh_free(x);
    return columns - rank;
}

Test(breaks, flat_systems_agree_with_brute_force)
{
    for (size_t d = 1; d <= 4; d++) {
        nh_count line = count_text("name: f\ncoordinates: [x]\nlagrangian: x'^2/2\n", d), plane = count_text(PLANE("0*x"), d);
        cr_expect_eq(line.row[d - 1].bound, kernel_of_free_motion(1, d), "line, degree %zu", d);
        cr_expect_eq(plane.row[d - 1].bound, kernel_of_free_motion(2, d), "plane, degree %zu", d);
    }
    nh_count space = count_text("name: f\ncoordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2\n", 2);
    cr_expect_eq(space.row[1].bound, kernel_of_free_motion(3, 2));
}

/* One coordinate and time; the currents of `known`, said to have so many independent ones among them: of how many does the count know at degree 1, with 1? */
static size_t known_at_one(const char *lagrangian, const char *known, size_t independent)
{
    char *text = nh_alloc(4096);
    snprintf(text, 4096, "name: n\ncoordinates: [x]\ndomain: {t: [0.5, 1.5]}\nlagrangian: %s\nknown:\n  currents:\n%s", lagrangian, known);
    nh_error error = {0};
    nh_system *s = system_of(text);
    nh_model *o = model_of(s);
    nh_ex phi[8];
    size_t n = 0;
    for (; n < s->currents; n++) cr_assert(nh_analysis_file_to_chart(o, s->current[n].value, &phi[n], &error), "%s", error.what);
    nh_count_question q = {.time = true, .degree = 1, .work = 1e9, .known = n, .current = phi, .independent = independent};
    nh_count c = nh_count_integrals(o, &q);
    cr_assert_null(c.obstacle, "%s", c.obstacle);
    cr_expect_eq(c.row[0].bound, 3); /* 1 and two linear ones */
    nh_model_free(o);
    nh_system_free(s);
    nh_free(text);
    return c.row[0].known;
}

#define CURRENT(name, expr) "    - {name: " name ", expr: \"" expr "\"}\n"

/* Named functions stand for any solution of their equation. */
Test(count_breaks, named_functions_that_are_related)
{
    const char *spring = "x'^2/2 - t*x^2/2", *two = CURRENT("A", "x'*airy_ai(-t) + x*airy_ai_prime(-t)") CURRENT("B", "x'*airy_bi(-t) + x*airy_bi_prime(-t)");
    cr_expect_eq(known_at_one(spring, two, 2), 3);
    cr_expect_eq(known_at_one(spring, two, 0), 1); /* nobody says that they are independent */
    /* sqrt(pi t/2) J_1/2(t) = sin(t); other solutions are independent of it. */
    const char *same = CURRENT("A", "sqrt(t)*(x'*bessel_j(1/2, t) - x*bessel_j_prime(1/2, t)) - x*bessel_j(1/2, t)/(2*sqrt(t))") CURRENT("B", "x'*sin(t) - x*cos(t)");
    cr_expect_eq(known_at_one("x'^2/2 - x^2/2", same, 1), 2);
    /* exp(t) 1F1(1, 1, -2 t) = exp(-t), of which x'' = x holds, but not of another solution. */
    cr_expect_eq(known_at_one("x'^2/2 + x^2/2", CURRENT("A", "(x'*hyp1f1(1, 1, -2*t) + 2*x*hyp1f1_prime(1, 1, -2*t) - x*hyp1f1(1, 1, -2*t))*exp(t)"), 1), 1);
    /* The determinant of Wronski is in the formula, and of other solutions it is another number: pi (A B' - A' B) = 1. */
    cr_expect_eq(known_at_one(spring, CURRENT("A", "(x'*airy_ai(-t) + x*airy_ai_prime(-t))*(1 + pi*(airy_ai(-t)*airy_bi_prime(-t) - airy_ai_prime(-t)*airy_bi(-t)))"), 1), 2);
}

/* Of incomplete beta functions and elliptic integrals the residues stand for f + c: as t F(1/2, 1/2; 3/2; -t^2) = asinh(t) is known twice, two currents are
 * one. */
Test(count_breaks, antiderivatives_with_names)
{
    const char *root = "sqrt(1 + t^2)*x'^2/2", *beta = "x - sqrt(1 + t^2)*x'*t*hyp2f1(1/2, 1/2, 3/2, -t^2)", *momentum = CURRENT("p", "sqrt(1 + t^2)*x'");
    char known[600];
    snprintf(known, sizeof known, CURRENT("A", "%s") "%s", beta, momentum);
    cr_expect_eq(known_at_one(root, known, 2), 3);
    snprintf(known, sizeof known, CURRENT("A", "%s") CURRENT("B", "x - sqrt(1 + t^2)*x'*asinh(t)"), beta);
    cr_expect_eq(known_at_one(root, known, 1), 2);
    cr_expect_eq(known_at_one("sqrt(2 - sin(t)^2)*x'^2/2", CURRENT("A", "x - sqrt(2 - sin(t)^2)*x'*elliptic_f(t, 1/2)/sqrt(2)") CURRENT("p", "sqrt(2 - sin(t)^2)*x'"), 2), 3);
    cr_expect_eq(known_at_one("x'^2/2/sqrt(2 - sin(t)^2)", CURRENT("A", "x - x'*elliptic_einc(t, 1/2)*sqrt(2)/sqrt(2 - sin(t)^2)"), 1), 2);
    cr_expect_eq(known_at_one("x'^2/2/sqrt(2 - sin(t)^2)", CURRENT("A", "x - x'*elliptic_f(t, 1/2)*sqrt(2)/sqrt(2 - sin(t)^2)"), 1), 1); /* it is none */
}

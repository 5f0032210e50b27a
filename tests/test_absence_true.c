/* Is there any other integral?  Where more are known to exist than the program is told of, none of them is excluded.
 *
 * Systems with known integrals behind changes of their coordinates; each is asked with all that the search finds, and with
 * the energy alone, as if the search had found nothing else. */
#include <criterion/criterion.h>

#include "absence.h"
#include "base/progress.h"
#include "document/absence_parts.h"
#include "sweep.h"

/* X and Y: definitions of a map; T + V in them. */
typedef struct {
    const char *name, *text;
    size_t exist; /* independent integrals that are single-valued: rational in X, Y, X', Y' */
} potential;

static const potential POTENTIALS[] = {
    {"two quartic oscillators", "X^4 + X^2/2 + Y^4/3 + Y^2", 2},
    {"degrees 6 and 4", "X^6 + X^2 + Y^4 - Y^2", 2},
    {"two equal quartic oscillators", "X^4 + Y^4", 2},
    {"two cubic oscillators", "X^3/3 + X^2/2 + Y^3 + Y^2/2", 2},
    {"KdV", "(X^2 + 7/3*Y^2)/2 + X^2*Y + 2*Y^3", 2},
    {"Sawada-Kotera", "(X^2 + Y^2)/2 + X^2*Y + Y^3/3", 2},
    {"Kaup-Kupershmidt", "(X^2 + 16*Y^2)/2 + X^2*Y + 16/3*Y^3", 2},
    {"1:6:1", "X^4 + 6*X^2*Y^2 + Y^4 + X^2 + Y^2", 2},
    {"1:6:8", "X^4 + 6*X^2*Y^2 + 8*Y^4 + X^2 + 4*Y^2", 2},
    {"1:12:16", "X^4 + 12*X^2*Y^2 + 16*Y^4 + X^2 + 4*Y^2", 2},
    {"Garnier", "(X^2 + Y^2)^2 + X^2 + 3*Y^2", 2},
    {"resonance 1:2", "X^2/2 + 2*Y^2", 3},
    {"resonance 2:3", "2*X^2 + 9/2*Y^2", 3},
    {"resonance 4:5", "8*X^2 + 25/2*Y^2", 3},
    {"resonance 1:5", "X^2/2 + 25/2*Y^2", 3},
    {"resonance 3:7", "9/2*X^2 + 49/2*Y^2", 3},
    {"Smorodinsky-Winternitz", "X^2/2 + Y^2/2 + 1/X^2 + 2/Y^2", 3},
    {"Smorodinsky-Winternitz 1:2", "X^2/2 + 2*Y^2 + 1/X^2 + 2*Y", 3},
    {"2:1 with 1/Y^2", "4*X^2 + Y^2 + 1/Y^2", 3},
};
enum { POTENTIAL_COUNT = sizeof POTENTIALS / sizeof *POTENTIALS };

/* Planes remain planes of coordinates, or y = x, but for the rotation; what is not a rotation gives inertia that varies. */
static const struct {
    const char *x, *y;
} MAPS[] = {{"x", "y"},
            {"y", "x"},
            {"x + y", "x - y"},
            {"x", "x + y"},
            {"x + y", "2*x - y"},
            {"3/5*x + 4/5*y", "3/5*y - 4/5*x"},
            {"x + x^3", "y"},
            {"x + x^3/3", "y + y^3/5"},
            {"x", "y + x^2"},
            {"x*(1 + y^2)", "y"},
            {"x*(1 + y)", "y"},
            {"x", "y - x^2 + x^4"},
            {"x*y", "y"},
            {"x^2 - y^2", "2*x*y"},
            {"x*exp(y)", "y"},
            {"x", "y + x*exp(x)"},
            {"x + sin(x)/2", "y"},
            {"x*cos(y)", "x*sin(y)"},
            {"x/(1 + y^2)", "y"},
            {"sinh(x)", "y"},
            {"x*sqrt(1 + y^2)", "y"}};
enum { MAP_COUNT = sizeof MAPS / sizeof *MAPS };

/* Closed shapes of another kind, and integrals that no search to degree 6 finds. */
#define POLAR(L) "coordinates: [{name: r, type: length}, {name: h, type: angle}]\nlagrangian: (r'^2 + r^2*h'^2)/2 - (" L ")\ndomain: {r: [0.5, 2], h: [0.1, 0.2]}\n"
#define ON_SPHERE(V) "coordinates: [{name: h, type: angle}, {name: p, type: angle}]\nlagrangian: (h'^2 + sin(h)^2*p'^2)/2 - (" V ")\ndomain: {h: [0.5, 1.4], p: [0.2, 1.2]}\n"
#define ROLLING(L, C) "coordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2 - (" L ")\nconstraints: [\"" C "\"]\n"
#define BODY_AXES "definitions: [\"W1 = p'*sin(h)*sin(s) + h'*cos(s)\", \"W2 = p'*sin(h)*cos(s) - h'*sin(s)\", \"W3 = p'*cos(h) + s'\"]\n"
#define BODY(T, V) EULER_ANGLES BODY_AXES "lagrangian: " T " - (" V ")\ndomain: {h: [0.5, 2.5]}\n"

static const potential OTHERS[] = {
    /* F. Tremblay, A. V. Turbiner and P. Winternitz, J. Phys. A 42 (2009) 242001; with 1/r: S. Post and P. Winternitz 2010 */
    {"TTW 1", POLAR("r^2/2 + (2/cos(h)^2 + 3/sin(h)^2)/r^2"), 3},
    {"TTW 2", POLAR("r^2/2 + (2/cos(2*h)^2 + 3/sin(2*h)^2)/r^2"), 3},
    {"TTW 3", POLAR("r^2/2 + (2/cos(3*h)^2 + 3/sin(3*h)^2)/r^2"), 3},
    {"TTW 4", POLAR("r^2/2 + 1/cos(4*h)^2/r^2"), 3},
    {"TTW 5", POLAR("r^2/2 + 1/cos(5*h)^2/r^2"), 3},
    {"Post and Winternitz 3", POLAR("-1/r + 1/cos(3*h)^2/r^2"), 3},
    {"an angular potential", POLAR("r^2/2 + cos(3*h)/r^2"), 2},
    {"spherical pendulum along another axis", ON_SPHERE("sin(h)*cos(p)"), 2},
    {"Neumann", ON_SPHERE("sin(h)^2*cos(p)^2 + 2*sin(h)^2*sin(p)^2"), 2},
    {"Higgs", ON_SPHERE("tan(h)^2"), 2},
    {"three centrifugal terms on a sphere", ON_SPHERE("1/cos(h)^2 + 1/(sin(h)*cos(p))^2 + 1/(sin(h)*sin(p))^2"), 3},
    {"Lagrange with a gyrostat", BODY("(2*W1^2 + 2*W2^2 + 3*W3^2)/2 + 2*W3", "cos(h)"), 3},
    {"Zhukovsky", BODY("(3*W1^2 + 2*W2^2 + W3^2)/2 + W1 + 2*W2", "0"), 3},
    {"Kovalevskaya, turned", BODY("(2*W1^2 + 2*W2^2 + W3^2)/2", "3/5*sin(h)*sin(s) + 4/5*sin(h)*cos(s)"), 3},
    {"Kovalevskaya and Yehia", BODY("(2*W1^2 + 2*W2^2 + W3^2)/2 + W3", "sin(h)*sin(s)"), 3},
    {"Brun", BODY("(3*W1^2 + 2*W2^2 + W3^2)/2", "(3*(sin(h)*sin(s))^2 + 2*(sin(h)*cos(s))^2 + cos(h)^2)/2"), 3},
    {"z' = y x' with V(y)", ROLLING("y^4", "z' = y*x'"), 2},
    {"z' = x x'", ROLLING("x^4 + y^4", "z' = x*x'"), 2},
    {"two oscillators and one", IN_SPACE("x^4 + y^4 + z^3 + z^2"), 3},
    {"Henon-Heiles and one", IN_SPACE("(x^2 + y^2)/2 + x^2*y - y^3/3 + z^4"), 2},
    {"Garnier in space", IN_SPACE("(x^2 + y^2 + z^2)^2 + x^2 + 2*y^2 + 3*z^2"), 3},
    {"a central force in space", IN_SPACE("(x^2 + y^2 + z^2)^2"), 4},
    {"a symmetry in space", IN_SPACE("(x^2 + y^2)^2 + z^2 + (x^2 + y^2)*z^2"), 2},
    {"three particles", IN_SPACE("1/(x - y)^2 + 1/(y - z)^2 + 1/(z - x)^2 + x^2 + y^2 + z^2") "domain: {x: [0, 0.5], y: [1, 1.5], z: [2, 2.5]}\n", 5},
    {"Toda", IN_SPACE("exp(x - y) + exp(y - z) + exp(z - x)"), 3},
};
enum { OTHER_COUNT = sizeof OTHERS / sizeof *OTHERS };

static void sound(const char *name, const nh_absence *a, size_t exist)
{
    cr_expect_null(a->contradiction, "%s: %s", name, a->contradiction);
    if (a->verdict == NH_ABSENCE_SETTLED) return;
    cr_expect_geq(absence_bound(a), exist, "%s: at most %zu (%s), and %zu exist", name, absence_bound(a), absence_word(a), exist);
    for (size_t k = 0; k < a->attempts; k++) {
        const nh_absence_attempt *t = &a->attempt[k];
        size_t most = t->equation->obstacle ? SIZE_MAX : a->shape->count - 1 - t->orbit;
        cr_expect_geq(most, exist, "%s: at most %zu by %s, and %zu exist", name, most, t->equation->plane->words, exist);
    }
}

/* With what is found, and as if nothing but the energy were. */
static void try_text(const char *name, const char *text, size_t exist)
{
    nh_error error = {0};
    nh_analysis *r = absence_of_text(text, &error);
    cr_assert(r && r->absence, "%s: %s", name, error.what);
    sound(name, r->absence, exist);
    const nh_current_list *all = r->list;
    nh_current_list energy = *all;
    for (size_t k = 0; k < all->count; k++)
        if (all->found[k].energy) {
            energy.found = all->found + k;
            energy.count = energy.independent = 1;
        }
    r->list = &energy;
    for (int everything = 0; everything <= sweep_whole(); everything++) {
        nh_absence_find(r, everything);
        sound(name, r->absence, exist);
    }
    r->list = all;
    nh_analysis_free(r);
}

Test(absence_true, behind_maps)
{
    for (size_t i = 0; i < POTENTIAL_COUNT * MAP_COUNT; i++) {
        if (!sweep_tries(i, 210, 399)) continue;
        const potential *p = &POTENTIALS[i % POTENTIAL_COUNT];
        char text[600], name[200];
        const char *x = MAPS[i / POTENTIAL_COUNT].x, *y = MAPS[i / POTENTIAL_COUNT].y;
        snprintf(text, sizeof text, "coordinates: [x, y]\ndefinitions: [\"X = %s\", \"Y = %s\"]\nlagrangian: (X'^2 + Y'^2)/2 - (%s)\n%s", x, y, p->text,
                 strchr(p->text, '/') ? "domain: {x: [0.5, 2], y: [0.2, 0.4]}\n" : "");
        snprintf(name, sizeof name, "%s, X = %s, Y = %s", p->name, x, y);
        try_text(name, text, p->exist);
    }
}

Test(absence_true, others)
{
    for (size_t i = 0; i < OTHER_COUNT; i++)
        if (sweep_tries(i, 13, 30)) try_text(OTHERS[i].name, OTHERS[i].text, OTHERS[i].exist);
}

static nh_analysis *asked(const char *text)
{
    nh_error error = {0};
    nh_analysis *r = absence_of_text(text, &error);
    cr_assert(r && r->absence, "%s", error.what);
    return r;
}

/* The angular momentum of x and y exists for a = 1 only: for other values nothing depends on it. */
Test(absence_true, what_depends_on_integrals_of_special_parameters_is_not_general)
{
    nh_analysis *r = asked("parameters: {a: 1}\n" IN_SPACE("(x^2 + a*y^2 + z^2)/2 + (x^2 + a*y^2)*z - z^3/3"));
    cr_expect_eq(r->absence->verdict, NH_ABSENCE_DEPENDENT);
    cr_expect_eq(r->absence->known, 2U);
    cr_expect_not(r->absence->generic);
    nh_analysis_free(r);
    r = asked("parameters: {a: 1}\n" IN_SPACE("(x^2 + y^2 + z^2)/2 + a*(x^2 + y^2)*z - z^3/3"));
    cr_expect_eq(r->absence->verdict, NH_ABSENCE_DEPENDENT);
    cr_expect(r->absence->generic);
    nh_analysis_free(r);
}

/* Along x = 0 the equation is irregular: closed paths alone exclude, in balls, and only what is periodic in h. */
Test(absence_true, irregular_points_do_not_exclude_what_is_not_periodic)
{
    nh_analysis *r = asked("coordinates: [{name: h, type: angle}, x]\nlagrangian: (h'^2 + x'^2)/2 - cos(h) - (1 + sin(h)^2/3)*x^2 - x^4\n");
    nh_absence *a = r->absence;
    cr_assert_str_eq(a->attempt[0].equation->plane->words, "x = 0");
    cr_assert(a->attempt[0].kovacic && a->attempt[0].kovacic->group == NH_GROUP_SL2 && !a->attempt[0].kovacic->regular);
    cr_assert_eq(a->best, 0U);
    cr_expect_not(a->rational);
    cr_expect_eq(nh_absence_parts_reason_of(a), NH_ABSENCE_BY_MONODROMY);
    cr_expect(nh_absence_parts_periodic(a));
    nh_analysis_free(r);
}

/* What is computed after an interruption proves nothing; and the continuation along closed paths ends. */
Test(absence_true, a_computation_that_was_ended_excludes_nothing)
{
    nh_analysis *r = asked(IN_PLANE("x^2*y - y^3/3"));
    cr_assert_eq(r->absence->verdict, NH_ABSENCE_NONE_ELSE);
    nh_interrupt();
    nh_absence_find(r, true);
    cr_expect_eq(r->absence->verdict, NH_ABSENCE_OPEN);
    cr_expect_null(r->absence->darboux);
    cr_expect_eq(r->absence->resonances, 0U);
    nh_linear_equation root;
    nh_linear_equation_init(&root, 1);
    fmpz_poly_set_str(root.num, "1  1");
    fmpz_poly_set_str(root.den, "2  0 3");
    nh_monodromy *m = nh_monodromy_try(r->arena, 1, &root);
    cr_expect_eq(m->steps, 0U);
    cr_expect_str_eq(m->obstacle, "the computation was ended");
    nh_linear_equation_clear(&root);
    nh_interrupt_clear();
    nh_analysis_free(r);
}

/* h turns and y, which is no angle, does not come back: (1/z'^2 + y - 1/2) e^(2 y) is an integral, and periodic in h. */
Test(absence_true, turns_that_are_not_closed)
{
    try_text("y' = h'", "coordinates: [{name: h, type: angle}, y, z]\nlagrangian: (h'^2 + y'^2 + z'^2)/2 - cos(h)\nconstraints: [\"y' = h'\"]\n"
             "forces: [\"z = h'*z' + h'*z'^3*y\"]\n", 3);
}

/* The roots of polynomials of high degree take long before any step is counted. */
Test(absence_true, many_singular_points)
{
    nh_linear_equation root;
    nh_linear_equation_init(&root, 1);
    fmpz_poly_set_coeff_si(root.num, 0, 1);
    fmpz_poly_set_coeff_si(root.den, 0, 3);
    fmpz_poly_set_coeff_si(root.den, 300, 1);
    nh_arena *arena = nh_arena_create();
    nh_monodromy *m = nh_monodromy_try(arena, 1, &root);
    cr_expect_eq(m->steps, 0U);
    cr_expect_str_eq(m->obstacle, "there are more than 100 singular points");
    nh_linear_equation_clear(&root);
    nh_arena_free(arena);
}

/* z' e^-h and u' e^(-h/3) are integrals, and not periodic in h: what speaks of periodic ones does not contradict them. */
Test(absence_true, integrals_of_another_class_contradict_nothing)
{
    nh_analysis *r = asked("coordinates: [{name: h, type: angle}, z, u, x]\nlagrangian: (h'^2 + z'^2 + u'^2 + x'^2)/2 - cos(h) - x^2*cos(h)/3 - x^4\n"
                           "forces: [\"z = h'*z'\", \"u = h'*u'/3\"]\n");
    const nh_absence *a = r->absence;
    cr_assert_eq(a->known, 3U);
    cr_assert_str_eq(a->attempt[0].equation->plane->words, "x = 0, z' = 0, u' = 0");
    cr_expect_not(a->attempt[0].equation->all_single_valued);
    cr_expect_null(a->contradiction, "%s", a->contradiction);
    cr_expect_geq(absence_bound(a), 3U);
    nh_analysis_free(r);
}

/* u_xx = (w u)_x with w = 6/(x^2 - 2) + 2/x: the normal form has a triangular group of dimension 2, and y'/h' - w(h) y is an
 * integral that is rational. */
Test(absence_true, a_triangular_normal_form_leaves_an_integral)
{
    nh_analysis *r = asked("coordinates: [h, y]\nlagrangian: (h'^2 + y'^2)/2 - h^4/4\n"
                           "forces: [\"y = (6/(h^2 - 2) + 2/h)*h'*y' - (12*h/(h^2 - 2)^2 + 2/h^2)*h'^2*y - h^3*y'/h'\"]\n");
    const nh_absence *a = r->absence;
    cr_assert_gt(a->attempts, 0U);
    cr_assert_not_null(a->attempt[0].kovacic);
    cr_expect_eq(a->attempt[0].kovacic->group, NH_GROUP_TRIANGULAR);
    cr_expect_eq(a->attempt[0].orbit, 1U);
    cr_expect_eq(a->verdict, NH_ABSENCE_AT_MOST);
    cr_expect_eq(a->at_most, 2U);
    nh_analysis_free(r);
}

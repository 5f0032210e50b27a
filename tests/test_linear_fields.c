/* linear fields: bodies that float freely have the momenta of turns and translations, and centres of mass, for all parameter values, however long the
 * accelerations are. */
#include "mechanics.h"
#include "scratch.h"
#include "sweep.h"

#include "commands/analyze.h"
#include "commands/verify.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "integrals/affine_field.h"
#include "integrals/noether_equation.h"
#include "integrals/prove.h"

#define BASE \
    "bodies:\n  - {name: base, mass: m0, inertia: I0}\n  - {name: one, mass: m1, inertia: I1, center: [l/2, 0, 0]}\n"
#define JOINTS \
    "joints:\n  - {type: planar, child: base, axis: z, coordinates: [x, y, h]}\n  - {type: revolute, parent: base, child: one, at: [a, 0, 0], axis: z, coordinates: [q]}\n"
#define ONE_LINK "parameters: {g: 3.7, m0: 4, m1: 1, I0: 0.9, I1: 0.1, a: 0.6, l: 0.7}\n"
#define FREE_ARM "name: arm\n" ONE_LINK BASE JOINTS
#define FALLING_ARM "name: arm\n" ONE_LINK "gravity: [0, -g, 0]\n" BASE JOINTS
#define TWO_LINKS(GRAVITY)                                                                                                                               \
    "name: arm\nparameters: {g: 3.7, m0: 4, m1: 1, m2: 0.8, I0: 0.9, I1: 0.1, I2: 0.07, a: 0.6, l: 0.7}\n" GRAVITY BASE                                   \
    "  - {name: two, mass: m2, inertia: I2, center: [l/2, 0, 0]}\n" JOINTS                                                                                \
    "  - {type: revolute, parent: one, child: two, at: [l, 0, 0], axis: z, coordinates: [r]}\n"
#define SLIDER(GRAVITY)                                                                                                                                  \
    "name: slider\nparameters: {g: 1.7, m0: 4, m1: 1, I: 0.9, J: 0.7, K: 0.5, b: 0.3}\n" GRAVITY                                                          \
    "bodies:\n  - {name: base, mass: m0, inertia: [I, J, K]}\n  - {name: one, mass: m1}\n"                                                               \
    "joints:\n  - {type: free, child: base, angles: zxz}\n  - {type: prismatic, parent: base, child: one, at: [b, 0, 0], axis: z, coordinates: [s]}\n"

/* So many independent currents, for all parameters; `complete`: and no more of the first degrees. */
static void expect_these(const char *text, size_t currents, bool other_may_be_at_values, bool complete)
{
    char path[SCRATCH];
    FILE *out = scratch_open(path);
    cr_assert(out && fputs(text, out) >= 0 && fclose(out) == 0);
    nh_error error = {0};
    nh_request q = {.system_path = path};
    nh_options_default(&q.options);
    q.options.max_seconds = 1e6; /* the same on every machine */
    nh_analysis *r = nh_analysis_create(&q, &error);
    remove(path);
    cr_assert(r, "%s", error.what);
    size_t free = 0;
    for (size_t k = 0; k < r->list->count; k++) {
        const nh_current *f = &r->list->found[k];
        free += f->independence == NH_INDEPENDENT && f->proof.all_parameters;
        cr_expect(f->proof.all_parameters || (other_may_be_at_values && f->independence != NH_INDEPENDENT), "current %zu", k);
    }
    cr_expect_eq(free, currents, "%zu independent currents for all parameters", free);
    cr_expect(!complete || !r->completeness[NH_COMPLETE_IN_COORDINATES].missing_at);
    nh_analysis_free(r);
}

static void expect(const char *text, size_t currents, bool other_may_be_at_values) { expect_these(text, currents, other_may_be_at_values, true); }

/* The energy, two momenta, two centres of mass, and the angular momentum. */
Test(linear_fields, one_link_on_a_free_base, WHOLE_ONLY) { expect(FREE_ARM, 6, false); }
Test(linear_fields, and_while_it_falls, WHOLE_ONLY) { expect(FALLING_ARM, 6, false); }
Test(linear_fields, two_links, WHOLE_ONLY) { expect(TWO_LINKS(""), 6, true); }
Test(linear_fields, two_links_while_they_fall, WHOLE_ONLY) { expect(TWO_LINKS("gravity: [0, -g, 0]\n"), 6, false); }

/* A slider on a body in space: the energy, three momenta, three centres of mass, three angular momenta; about the centre of mass while it falls. */
Test(linear_fields, a_slider_on_a_free_body, WHOLE_ONLY) { expect(SLIDER(""), 10, false); }
Test(linear_fields, a_slider_on_a_falling_body, WHOLE_ONLY) { expect(SLIDER("gravity: g\n"), 10, false); }

/* What analyze proves by a short field, verify proves of a formula that was typed: the rate itself is too long. */
Test(linear_fields, verify_proves_a_momentum_by_its_field, PLAIN_ONLY)
{
    char path[SCRATCH];
    FILE *out = scratch_open(path);
    cr_assert(out && fputs(TWO_LINKS("gravity: [0, -g, 0]\n"), out) >= 0 && fclose(out) == 0);
    nh_error error = {0};
    nh_options options;
    nh_options_default(&options);
    nh_system *y = nh_system_read(path, 0, NULL, &error);
    remove(path);
    cr_assert(y, "%s", error.what);
    nh_verification *v = nh_verification_of_current(y, NH_CHART_AUTO,
                                                    "(m0 + m1 + m2)*x' - (m1 + m2)*a*h'*sin(h) - (m1/2 + m2)*l*(h' + q')*sin(h + q)"
                                                    " - m2*l/2*(h' + q' + r')*sin(h + q + r)",
                                                    &options, &error);
    cr_assert(v, "%s", error.what);
    cr_expect(v->conserved && v->proof.proved && v->proof.all_parameters);
    nh_verification_free(v);
}

/* By hand; the angles of two pendulums have none. */
Test(linear_fields, centres_of_mass)
{
    static const struct {
        size_t s;
        const char *mass, *F;
    } known[] = {{0, "m0 + m1", "(m0 + m1)*x + m1*(a*cos(h) + l/2*cos(h + q))"}, {1, "m0 + m1", "(m0 + m1)*y + m1*(a*sin(h) + l/2*sin(h + q))"}};
    mechanics x = mechanics_of_text(FALLING_ARM, NH_CHART_AUTO);
    nh_dag *d = x.model->dag;
    nh_centre_of_mass centre[4];
    cr_assert_eq(nh_centre_of_mass_find(x.model, 0, centre), 2);
    for (size_t i = 0; i < 2; i++) {
        cr_expect_eq(centre[i].s, known[i].s);
        cr_expect_eq(nh_normal_is_zero(d, nh_sub(d, centre[i].mass, formula(x.model, known[i].mass)), 0), NH_ZERO);
        cr_expect_eq(nh_normal_is_zero(d, nh_sub(d, centre[i].F, formula(x.model, known[i].F)), 0), NH_ZERO);
    }
    mechanics_clear(&x);
    x = mechanics_of_text("name: pendulums\nparameters: {m: 1, M: 2, g: 3}\ncoordinates: [{name: u, type: angle}, {name: v, type: angle}]\n"
                          "lagrangian: (m + M)/2*u'^2 + M/2*v'^2 + M*cos(u - v)*u'*v' + g*cos(u)\n",
                          NH_CHART_AUTO);
    cr_expect_eq(nh_centre_of_mass_find(x.model, 0, centre), 0);
    mechanics_clear(&x);
}

/* The turn about the centre of mass C of what falls: x moves by C_y - y, y by x - C_x, h by 1. */
Test(linear_fields, turn_about_the_centre_of_mass)
{
    mechanics x = mechanics_of_text(FALLING_ARM, NH_CHART_AUTO);
    nh_dag *d = x.model->dag;
    nh_options options;
    nh_options_default(&options);
    static const char *known[4] = {"m1*(a*sin(h) + l/2*sin(h + q))/(m0 + m1)", "-m1*(a*cos(h) + l/2*cos(h + q))/(m0 + m1)", "1", "0"};
    nh_ex phi = nh_int(d, 0), zeta[4];
    for (size_t i = 0; i < 4; i++) phi = nh_add(d, phi, nh_mul(d, formula(x.model, known[i]), x.model->p[i]));
    cr_assert(nh_affine_field(x.model, phi, &options, zeta));
    for (size_t i = 0; i < 4; i++)
        cr_expect_eq(nh_normal_is_zero(d, nh_sub(d, zeta[i], formula(x.model, known[i])), 0), NH_ZERO, "%zu", i);
    mechanics_clear(&x);
}

/* A turn of y and x + a z^2: quadratic in the coordinates, for all a. */
Test(linear_fields, a_turn_in_curved_coordinates)
{
    mechanics x = mechanics_of_text("name: a\nparameters: {a: 0.3}\ncoordinates: [x, y, z]\n"
                                    "lagrangian: (x' + 2*a*z*z')^2*(1 + y^2) + y'^2*(2 + x^4) + z'^2*(1 + x*y^3)\n",
                                    NH_CHART_AUTO);
    nh_dag *d = x.model->dag;
    nh_options options;
    nh_options_default(&options);
    static const char *known[3] = {"-y - 2*a*z*(x - z)", "x + a*z^2", "x - z"};
    nh_ex phi = nh_int(d, 0), zeta[3];
    for (size_t i = 0; i < 3; i++) phi = nh_add(d, phi, nh_mul(d, formula(x.model, known[i]), x.model->p[i]));
    cr_assert(nh_affine_field(x.model, phi, &options, zeta));
    for (size_t i = 0; i < 3; i++)
        cr_expect_eq(nh_normal_is_zero(d, nh_sub(d, zeta[i], formula(x.model, known[i])), 0), NH_ZERO, "%zu", i);
    mechanics_clear(&x);
}

/* In both patterns of angles the turn about x, which is none of the coordinates. */
Test(linear_fields, turns_in_space)
{
    static const struct {
        const char *angles, *zeta[3];
    } known[] = {{"zxz", {"-sin(a)/tan(b)", "cos(a)", "sin(a)/sin(b)"}}, {"zyx", {"cos(a)*tan(b)", "-sin(a)", "cos(a)/cos(b)"}}};
    for (size_t k = 0; k < sizeof known / sizeof *known; k++) {
        char text[400];
        snprintf(text, sizeof text,
                 "name: top\nparameters: {I: 0.9, J: 0.7, K: 0.5}\nbodies: [{name: top, inertia: [I, J, K]}]\n"
                 "joints: [{type: spherical, child: top, angles: %s, coordinates: [a, b, c]}]\n",
                 known[k].angles);
        mechanics x = mechanics_of_text(text, NH_CHART_AUTO);
        nh_dag *d = x.model->dag;
        nh_options options;
        nh_options_default(&options);
        nh_ex phi = nh_int(d, 0), zeta[3];
        for (size_t i = 0; i < 3; i++) phi = nh_add(d, phi, nh_mul(d, formula(x.model, known[k].zeta[i]), x.model->p[i]));
        cr_assert(nh_affine_field(x.model, phi, &options, zeta), "%s", known[k].angles);
        for (size_t i = 0; i < 3; i++) {
            nh_ex rest = nh_sub(d, zeta[i], formula(x.model, known[k].zeta[i]));
            cr_expect_eq(nh_normal_is_zero(d, rest, 0), NH_ZERO, "%s: %zu", known[k].angles, i);
        }
        nh_proof proof = nh_prove_current(x.model, phi, true, &options);
        cr_expect(proof.all_parameters, "%s", known[k].angles);
        mechanics_clear(&x);
    }
}

/* The last link turns about the point in which its skate stands: the sum of the rates is its momentum over J, of which only the value 1/0.2 is seen at points. */
Test(linear_fields, a_multiple_of_a_momentum, PLAIN_ONLY)
{
    mechanics x = mechanics_of_text(
        "name: links\nparameters: {m: 1, J: 0.2, l: 0.5}\n"
        "bodies: [{name: a, mass: m, inertia: J}, {name: b, mass: m, inertia: J}, {name: c, mass: m, inertia: J}]\n"
        "joints:\n  - {type: planar, child: a, coordinates: [x, y, h]}\n  - {type: revolute, parent: a, child: b, at: [l, 0, 0], axis: z, coordinates: [u]}\n"
        "  - {type: revolute, parent: b, child: c, at: [l, 0, 0], axis: z, coordinates: [v]}\n"
        "wheels: [{type: knife-edge, body: a, axis: y}, {type: knife-edge, body: c, axis: y}]\ndomain: {u: [0.3, 0.9], v: [0.3, 0.9]}\n",
        NH_CHART_AUTO);
    nh_options options;
    nh_options_default(&options);
    options.proof_terms = 2000; /* the rate itself has more */
    nh_proof proof = nh_prove_current(x.model, formula(x.model, "h' + u' + v'"), true, &options);
    cr_expect(proof.all_parameters && !proof.fixed);
    proof = nh_prove_current(x.model, formula(x.model, "h' + u'"), true, &options);
    cr_expect(!proof.proved);
    mechanics_clear(&x);
}

/* By hand: the turn is d/dh + x d/dy - y d/dx, the centre of mass belongs to -t d/dx, and of the energy there is none. */
Test(linear_fields, fields_by_their_values)
{
    static const struct {
        const char *phi, *zeta[4];
    } known[] = {{"(m0 + m1)*x' - m1*(a*sin(h)*h' + l/2*sin(h + q)*(h' + q'))", {"1", "0", "0", "0"}},
                 {"I1*(h' + q') + I0*h'", {NULL}},
                 {"t*((m0 + m1)*y' + m1*(a*cos(h)*h' + l/2*cos(h + q)*(h' + q')))/3 + x^2", {"0", "t/3", "0", "0"}}};
    mechanics x = mechanics_of_text(FREE_ARM, NH_CHART_AUTO);
    nh_dag *d = x.model->dag;
    nh_options options;
    nh_options_default(&options);
    nh_ex zeta[4], p[4];
    for (size_t k = 0; k < sizeof known / sizeof *known; k++) {
        bool found = nh_affine_field(x.model, formula(x.model, known[k].phi), &options, zeta);
        cr_expect_eq(found, known[k].zeta[0] != NULL, "%s", known[k].phi);
        for (size_t i = 0; i < 4 && found; i++) cr_expect_eq(zeta[i], formula(x.model, known[k].zeta[i]), "%s: %zu", known[k].phi, i);
    }
    memcpy(p, x.model->p, sizeof p);
    nh_ex turn = nh_add(d, p[2], nh_sub(d, nh_mul(d, formula(x.model, "x"), p[1]), nh_mul(d, formula(x.model, "y"), p[0])));
    cr_expect(nh_affine_field(x.model, turn, &options, zeta));
    cr_expect(zeta[0] == formula(x.model, "-y") && zeta[1] == formula(x.model, "x") && zeta[2] == formula(x.model, "1") && zeta[3] == formula(x.model, "0"));
    cr_expect(nh_affine_field(x.model, x.model->E, &options, zeta) && zeta[0] == x.model->chart->w[0]);
    cr_expect_not(nh_affine_field(x.model, nh_mul(d, x.model->E, x.model->E), &options, zeta));
    mechanics_clear(&x);
}

static nh_zero_verdict noether(const mechanics *m, const char *phi, size_t n, const char *const *field)
{
    nh_ex zeta[4], rate;
    for (size_t i = 0; i < n; i++) zeta[i] = formula(m->model, field[i]);
    cr_assert(nh_noether_equation(m->model, formula(m->model, phi), zeta, &rate));
    return nh_normal_is_zero(m->model->dag, rate, 0);
}

/* In all coordinates, without and with a constraint that moves: a turn is found good, and another multiple of a component is not. */
Test(linear_fields, the_equation_of_noether_in_all_coordinates)
{
    mechanics free = mechanics_of_text("name: a\ncoordinates: [y, z, {name: h, type: angle}]\n"
                                       "lagrangian: (y'^2 + (z' + h'*cos(h))^2)*(1 + y^2 + (z + sin(h))^2)/2 + h'^2 - cos(2*t)*(y^2 + (z + sin(h))^2) - cos(h - t)\n", NH_CHART_AUTO);
    static const char turn[] = "(1 + y^2 + (z + sin(h))^2)*(y*(z' + h'*cos(h)) - (z + sin(h))*y')";
    cr_expect_eq(noether(&free, turn, 3, (const char *const[]){"-z - sin(h)", "y", "0"}), NH_ZERO);
    cr_expect_neq(noether(&free, turn, 3, (const char *const[]){"-z - sin(h)", "2*y", "0"}), NH_ZERO);
    mechanics_clear(&free);
    mechanics bound = mechanics_of_text("name: b\nparameters: {c: 0.3}\ncoordinates: [x, y, z]\n"
                                        "lagrangian: (x'^2 + (y' + c)^2 + z'^2)/2 - z^2 + 3*x*x'\nconstraints: [\"z' = 2*x*x' + 2*(y + c*t)*(y' + c)\"]\n", NH_CHART_AUTO);
    cr_assert_eq(bound.model->n, 2);
    /* the gauge term adds 3 x xi^x */
    cr_expect_eq(noether(&bound, "x*(y' + c) - (y + c*t)*x'", 2, (const char *const[]){"-y - c*t", "x"}), NH_ZERO);
    mechanics_clear(&bound);
    mechanics moving = mechanics_of_text("name: m\nparameters: {c: 0.3}\ncoordinates: [x, y]\n"
                                         "lagrangian: (x'^2*(1 + sin(x - 2*t)^2) + y'^2)/2 + y'^4/8 - c*cos(x - 2*t)*y\n", NH_CHART_AUTO);
    static const char energy[] = "2*(1 + sin(x - 2*t)^2)*x' - (x'^2*(1 + sin(x - 2*t)^2) + y'^2)/2 - 3*y'^4/8 - c*cos(x - 2*t)*y";
    nh_options options;
    nh_options_default(&options);
    nh_ex zeta[2];
    cr_expect(nh_affine_field(moving.model, formula(moving.model, energy), &options, zeta));
    cr_expect(zeta[0] == formula(moving.model, "2 - x'") && zeta[1] == formula(moving.model, "-y'"));
    cr_expect_eq(noether(&moving, energy, 2, (const char *const[]){"2 - x'", "-y'"}), NH_ZERO);
    cr_expect_neq(noether(&moving, energy, 2, (const char *const[]){"3 - x'", "-y'"}), NH_ZERO);
    mechanics_clear(&moving);
}

/* ---- bodies that attract each other: the integrals have the masses as letters, whatever their number ---- */

static void attracting(size_t bodies, size_t space, size_t currents)
{
    static const char axis[] = "xyz";
    char *text = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&text, &length);
    fprintf(out, "name: bodies\nparameters: {G: 1");
    for (size_t i = 1; i <= bodies; i++) fprintf(out, ", m%zu: %g", i, 1 + 0.3 * (double)i);
    fprintf(out, "}\ncoordinates: [");
    for (size_t i = 1; i <= bodies; i++)
        for (size_t a = 0; a < space; a++) fprintf(out, "%s%c%zu", i + a > 1 ? ", " : "", axis[a], i);
    fprintf(out, "]\nlagrangian: 0");
    for (size_t i = 1; i <= bodies; i++) {
        for (size_t a = 0; a < space; a++) fprintf(out, " + m%zu/2*%c%zu'^2", i, axis[a], i);
        for (size_t j = 1; j < i; j++) {
            fprintf(out, " + G*m%zu*m%zu/sqrt(", i, j);
            for (size_t a = 0; a < space; a++) fprintf(out, "%s(%c%zu - %c%zu)^2", a ? " + " : "", axis[a], i, axis[a], j);
            fputs(")", out);
        }
    }
    fputs("\n", out);
    fclose(out);
    expect_these(text, currents, false, false);
    free(text);
}

/* The energy, momenta, centres of mass, angular momenta. */
Test(linear_fields, bodies_that_attract_each_other, PLAIN_ONLY)
{
    static const struct {
        size_t bodies, space, currents;
    } cases[] = {{3, 2, 6}, {4, 2, 6}, {3, 3, 10}, {5, 2, 6}, {4, 3, 10}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        if (sweep_tries(i, 1, 5)) attracting(cases[i].bodies, cases[i].space, cases[i].currents);
}

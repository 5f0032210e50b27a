/* Misprints of [CechMusilova2014] on the Chaplygin sleigh, shown by the program: what is printed is refuted, what is meant is proved for all
 * parameter values.  What is right as printed stands here too. */
#include <criterion/criterion.h>
#include <string.h>

#include "graph/diff.h"
#include "exact/normal.h"
#include "commands/verify.h"
#include "graph/dag.h"

#define S "(x'/(a*cos(phi)))"                       /* v/a */
#define R "sqrt(" S "^2 + k^2*phi'^2)"
#define LOG "log((" R " + " S ")/(" R " - " S "))"
#define PHI1 "-m/2*(x'^2/cos(phi)^2 + a^2*k^2*phi'^2)"
#define PHI2 "m*x'/cos(phi)*sin(phi/k) + m*a*k*phi'*cos(phi/k)"
#define PHI2B "m*x'/cos(phi)*cos(phi/k) - m*a*k*phi'*sin(phi/k)"
#define PHI3 "m*a^2*k^2/2*" LOG " - m*a^2*t*" R

/* Z(Phi_3) = G Gamma - B (d_phi +- ... d_x') + D (d_x + tan phi d_y +- ... d_phi') */
#define G "k^2/(" R ")^2*" LOG
#define B "((phi'*t + x'/(a*phi'*cos(phi)))/" R ")"
#define D "((a*k^2*cos(phi) - x'*t)/" R ")"
#define PLACES "Z0=" G "; phi=" G "*phi' - " B "; x=" G "*x' + " D "; y=" G "*x'*tan(phi) + " D "*tan(phi)"
#define PHI_RATE G "*(-phi'*x'/(a*k^2*cos(phi)))"
#define X_RATE G "*(a*phi'^2*cos(phi) - phi'*x'*tan(phi))"
#define GAMMA(f) "Z0=" f "; phi=" f "*phi'; x=" f "*x'; y=" f "*x'*tan(phi)"
#define LBAR "(m/2*(x'^2/cos(phi)^2 + a^2*k^2*phi'^2))"

typedef struct {
    const char *where, *text;
    bool field, holds;
    double k; /* 0: for all values of the parameters */
} claim;

static const claim claims[] = {
    {"Phi_1, the energy", PHI1, false, true, 0},
    {"Phi_2", PHI2, false, true, 0},
    {"Phi_3", PHI3, false, true, 0},
    {"the companion of Phi_2, which is not printed", PHI2B, false, true, 0},
    {"for k = 1 the companion is the momentum of the centre of mass along x", "m*(x' - a*phi'*sin(phi))", false, true, 1},
    {"... and only then", "m*(x' - a*phi'*sin(phi))", false, false, 2},
    {"Z(Phi_1) = d/dt", "Z0=1", true, true, 0},
    {"Z(Phi_2)", "phi=cos(phi/k)/(a*k); x=cos(phi)*sin(phi/k); y=sin(phi)*sin(phi/k)", true, true, 0},
    {"Z(Phi_3) as printed: two components outside the Gamma term have the wrong sign",
     PLACES "; phi'=" PHI_RATE " + " D "*phi'/(a*k^2*cos(phi)); x'=" X_RATE " + " B "*(a*phi'*cos(phi) - x'*tan(phi))", true, false, 0},
    {"Z(Phi_3) corrected", PLACES "; phi'=" PHI_RATE " - " D "*phi'/(a*k^2*cos(phi)); x'=" X_RATE " - " B "*(a*phi'*cos(phi) - x'*tan(phi))", true, true, 0},
    {"sec. 3.3: Gamma itself is no constraint symmetry", GAMMA("1"), true, false, 0},
    {"sec. 3.3: \"f Gamma is one only if dLbar annihilates the distribution\": but Gamma/Lbar always is", GAMMA("1/" LBAR), true, true, 0},
};

static nh_verification *verdict_of(const char *text, bool field, double k)
{
    nh_error error = {0};
    nh_options options;
    nh_setting setting[] = {{.name = "k", .value = k}, {.name = "a", .value = 0.7}, {.name = "m", .value = 1.3}};
    if (k == 0) setting[0].value = 1.5;
    nh_options_default(&options);
    nh_system *y = nh_system_read("systems/sleigh.yaml", 3, setting, &error);
    cr_assert_not_null(y, "%s", error.what);
    nh_verification *v = (field ? nh_verification_of_field : nh_verification_of_current)(y, NH_CHART_COORDINATES, text, &options, &error);
    cr_assert_not_null(v, "%s: %s", text, error.what);
    return v;
}

Test(errata, what_is_printed_and_what_is_meant)
{
    for (size_t i = 0; i < sizeof claims / sizeof *claims; i++) {
        const claim *c = &claims[i];
        nh_verification *v = verdict_of(c->text, c->field, c->k);
        cr_expect_eq(v->conserved, c->holds, "%s: the program says %s", c->where, v->conserved ? "yes" : "no");
        if (c->holds) cr_expect(v->proof.proved && (c->k || v->proof.all_parameters), "%s: not proved", c->where);
        else cr_expect(v->has_counterexample && v->residual > 1e-6, "%s: no counterexample", c->where);
        nh_verification_free(v);
    }
}

/* An expression in the coordinate chart of a verdict. */
static nh_ex formula(const nh_verification *v, const char *text)
{
    nh_error error = {0};
    nh_ex e;
    cr_assert(nh_system_expression_text(v->system, "formula", text, 0, NULL, &e, &error), "%s: %s", text, error.what);
    return nh_model_compose(v->model, e);
}

static bool equal(const nh_verification *v, nh_ex a, nh_ex b) { return nh_normal_is_zero(v->model->dag, nh_sub(v->model->dag, a, b), 0) == NH_ZERO; }

/* The brackets [Gamma, Z] after (43): that of Z_3 has the opposite sign; Z_1 is case 1 and stays in the canonical distribution, the others are case 3. */
Test(errata, brackets)
{
    static const struct { const char *current, *bracket; int kase; } list[] = {
        {PHI1, "0", 1},
        {PHI2, "-x'/(a*k*cos(phi)^2)*cos(phi/k) + phi'/cos(phi)*sin(phi/k)", 3},
        {PHI3, "a/(phi'*cos(phi))*" R, 3},
    };
    for (size_t i = 0; i < 3; i++) {
        nh_verification *v = verdict_of(list[i].current, false, 0);
        cr_assert(v->has_symmetry);
        nh_ex found = v->symmetry.bracket_form[0], printed = formula(v, list[i].bracket);
        cr_expect(equal(v, found, printed), "bracket of Z_%zu", i + 1);
        if (i == 2) cr_expect_not(equal(v, found, nh_neg(v->model->dag, printed)), "the sign as printed");
        cr_expect_eq(v->symmetry.kase, list[i].kase, "Z_%zu is case %d", i + 1, v->symmetry.kase);
        cr_expect_eq(v->symmetry.bracket_in_distribution, i == 0);
        nh_verification_free(v);
    }
}

/* (40) for the field of Phi_1 Phi_2, whose Z^0 depends on phi: x'^2/(a^2 cos phi) must be x'^2/(a^2 cos^2 phi). */
Test(errata, equation_40)
{
    nh_verification *v = verdict_of("(" PHI1 ")*(" PHI2 ")", false, 0);
    cr_assert(v->conserved && v->has_symmetry);
    nh_model *o = v->model;
    nh_dag *d = o->dag;
    nh_ex phi = o->system->coordinate[0].q, Z0 = v->symmetry.field.time, Zphi = v->symmetry.field.space[0], Zx = v->symmetry.field.space[1];
    cr_assert(o->chart->w[0] == o->system->coordinate[0].v && !nh_is_zero(d, nh_diff(d, Z0, phi)));
    nh_ex rest = nh_mul(d, formula(v, "x'*sin(phi)/(a^2*cos(phi)^3) + phi'/(a*cos(phi))"), Zx);
    rest = nh_add(d, rest, nh_mul(d, formula(v, "k^2"), v->symmetry.W[0]));
    rest = nh_add(d, rest, nh_mul(d, formula(v, "k^2*phi'"), nh_diff(d, Zphi, phi)));
    rest = nh_add(d, rest, nh_mul(d, formula(v, "x'/(a^2*cos(phi)^2)"), nh_diff(d, Zx, phi)));
    nh_ex printed = nh_mul(d, formula(v, "(x'^2/(a^2*cos(phi)) + k^2*phi'^2)/2"), nh_diff(d, Z0, phi));
    nh_ex meant = nh_mul(d, formula(v, "(x'^2/(a^2*cos(phi)^2) + k^2*phi'^2)/2"), nh_diff(d, Z0, phi));
    cr_expect_not(equal(v, rest, printed));
    cr_expect(equal(v, rest, meant));
    nh_verification_free(v);
}

/* (32): -(m/cos^2 phi) x'' - m sin phi phi' x'/cos^3 phi + m a phi'^2/cos phi = 0 along the motion, and phi'' of the second equation. */
Test(errata, equations_of_motion)
{
    nh_verification *v = verdict_of(PHI1, false, 0);
    nh_model *o = v->model;
    nh_dag *d = o->dag;
    nh_ex x = nh_add(d, nh_mul(d, formula(v, "-m/cos(phi)^2"), o->a[1]), formula(v, "-m*sin(phi)*phi'*x'/cos(phi)^3 + m*a*phi'^2/cos(phi)"));
    nh_ex printed = nh_add(d, nh_mul(d, formula(v, "-m/cos(phi)^2"), o->a[0]), formula(v, "-m*sin(phi)*phi'*x'/cos(phi)^3"));
    cr_expect(equal(v, x, nh_int(d, 0)));
    cr_expect_not(equal(v, printed, nh_int(d, 0)), "the first form as printed, with phi'' for x'' and without its last term");
    cr_expect(equal(v, o->a[0], formula(v, "-phi'*x'/(a*k^2*cos(phi))")));
    nh_verification_free(v);
}

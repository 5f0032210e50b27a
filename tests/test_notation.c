/* Names and signs as people write them: Greek letters and LaTeX's names are other spellings of the same names, `**` is `^`, and x_dot is
 * x' where nothing has this name. */
#include "graph/parse.h"
#include "mechanics.h"
#include "program.h"

static nh_ex reading(const nh_system *s, const char *text)
{
    nh_error error = {0};
    nh_ex e = 0;
    must(nh_system_expression_text(s, "test", text, 0, NULL, &e, &error), &error, text);
    return e;
}

Test(notation, spelled_names)
{
    static const struct {
        const char *text, *name;
        size_t length;
    } cases[] = {{"theta", "theta", 5}, {"θ", "theta", 2}, {"\\theta", "theta", 6}, {"θ_1'", "theta_1", 4}, {"\\theta_1*x", "theta_1", 8}, {"\\omega_{12}+1", "omega_12", 11},
                 {"ω₁", "omega1", 5}, {"\\varphi x", "phi", 7}, {"Δx", "Deltax", 3}, {"π", "pi", 2}, {"x_θ", "x_theta", 4}, {"\\dot x", "", 0}, {"\\thetax", "", 0},
                 {"{a}", "", 0}, {"+", "", 0}, {"", "", 0}, {"a_{1", "", 0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char name[64];
        size_t n = nh_name_spelled(cases[i].text, name, sizeof name);
        cr_expect_eq(n, cases[i].length, "%s: %zu", cases[i].text, n);
        if (n) cr_expect_str_eq(name, cases[i].name, "%s", cases[i].text);
    }
}

/* One system in three spellings has one Lagrangian, the same constraint, force, definition and domain. */
Test(notation, one_system_in_three_spellings)
{
    static const char *const texts[] = {
        "parameters: {omega_1: 2, mu: 0.3}\ncoordinates: {theta: angle, x: length}\ndefinitions: [\"alpha = omega_1*x\"]\nlagrangian: theta'^2/2 + x'^2/2 - alpha^2/2*cos(theta)\n"
        "forces: [\"theta = -mu*theta'\"]\nconstraints: [\"theta' = x*x'\"]\ndomain: {theta: [0, 1], theta': [0, 2]}\nknown: {currents: [{name: c, expr: \"theta - x^2/2\"}]}\n",
        "parameters: {ω_1: 2, μ: 0.3}\ncoordinates: {θ: angle, x: length}\ndefinitions: [\"α = ω_1*x\"]\nlagrangian: θ'**2/2 + x_dot^2/2 - α**2/2*cos(ϑ)\n"
        "forces: [\"θ = -μ*θ'\"]\nconstraints: [\"θ' = x*x'\"]\ndomain: {θ: [0, 1], θ': [0, 2]}\nknown: {currents: [{name: c, expr: \"θ - x^2/2\"}]}\n",
        "parameters: [{name: '\\omega_1', value: 2}, {name: \"\\\\mu\", value: 0.3}]\ncoordinates: [{name: '\\theta', type: angle}, {name: x, type: length}]\n"
        "definitions: ['\\alpha = \\omega_{1}*x']\nlagrangian: (\\theta_dot^2 + x_dot**2)/2 - \\alpha**2/2*cos(\\theta)\n"
        "forces: [\"theta = -mu*theta_dot\"]\nconstraints: ['theta_dot = x*x_dot']\ndomain: {theta: [0, 1], theta_dot: [0, 2]}\nknown: {currents: [{name: c, expr: '\\theta - x^2/2'}]}\n"};
    static const char *const asked[] = {"omega_1*theta'", "ω_1*θ_dot", "\\omega_1*theta'", "mu*alpha**2"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        nh_error error = {0};
        nh_system *s = nh_system_parse("test.yaml", texts[i], 0, NULL, &error);
        must(s != NULL, &error, texts[i]);
        cr_expect_str_eq(s->coordinate[0].name, "theta");
        cr_expect_str_eq(s->parameter[0].name, "omega_1");
        cr_expect_eq(s->intervals, 2);
        cr_expect_eq(s->lagrangian, reading(s, "theta'^2/2 + x'^2/2 - omega_1^2*x^2/2*cos(theta)"));
        cr_expect_eq(s->force[0], reading(s, "-mu*theta'"));
        cr_expect_eq(s->constraint[0].lhs, s->coordinate[0].v);
        cr_expect_eq(reading(s, asked[0]), reading(s, asked[1]));
        cr_expect_eq(reading(s, asked[0]), reading(s, asked[2]));
        cr_expect_eq(reading(s, asked[3]), reading(s, "μ*α^2"));
        nh_system_free(s);
    }
}

/* Texts for readers and units stay as they are; a name of its own has precedence over x_dot. */
Test(notation, what_stays)
{
    nh_error error = {0};
    nh_system *s = nh_system_parse("test.yaml", "title: Ω\nparameters: [{name: R, value: 2, unit: Ω, doc: θ}, {name: x_dot, value: 5}]\ncoordinates: [x]\nlagrangian: R*x'^2/2 - x_dot*x\n", 0, NULL, &error);
    must(s != NULL, &error, "the system");
    cr_expect_str_eq(s->title, "Ω");
    cr_expect_str_eq(s->parameter[0].unit, "Ω");
    cr_expect_eq(s->lagrangian, reading(s, "R*x'^2/2 - x_dot*x"));
    cr_expect(!nh_depends(s->dag, reading(s, "x_dot"), s->coordinate[0].v));
    cr_expect_eq(reading(s, "-x**2"), reading(s, "-(x^2)"));
    cr_expect_eq(reading(s, "2**3**2"), reading(s, "512"));
    nh_system_free(s);
}

/* The command line takes the same spellings, and its columns have names of letters, digits and _. */
Test(notation, the_command_line)
{
    place p = place_make();
    write_here(&p, "a.yaml", "parameters: {ω: 2}\ncoordinates: [θ]\nlagrangian: θ'^2/2 - ω^2*θ^2/2\n");
#define REST " --until 1 --step 1 --quiet"
    finished f[] = {run(&p, "simulate a.yaml --initial theta=1,theta'=0.5 --set omega=3 --watch theta,v=theta',theta*omega" REST),
                    run(&p, "simulate a.yaml --initial θ=1,θ'=0.5 --set ω=3 --watch θ,v=θ',θ*ω" REST),
                    run(&p, "simulate a.yaml --initial \\theta=1,theta_dot=0.5 --set \\omega=3 --watch \\theta,v=theta_dot,\\theta*\\omega" REST)};
    for (int i = 0; i < 3; i++) {
        cr_expect_eq(f[i].code, 0, "%d: %s", i, f[i].err);
        cr_expect_str_eq(f[i].out, f[0].out);
    }
    for (int i = 0; i < 3; i++) finished_clear(&f[i]);
    place_clear(&p);
}

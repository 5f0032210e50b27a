/* papers: the rows of docs/papers.md: what the three papers of the program's method print, and what the program is asked for.
 *
 * No row holds its finding: bench_papers.c computes it. */
#ifndef NH_TESTS_PAPERS_H
#define NH_TESTS_PAPERS_H

#include <stdbool.h>

/* ---- formulas of the sleigh, as printed ---- */

#define S "(x'/(a*cos(phi)))"
#define ROOT "sqrt(" S "^2 + k^2*phi'^2)"
#define LOG "log((" ROOT " + " S ")/(" ROOT " - " S "))"
#define PHI1 "-m/2*(x'^2/cos(phi)^2 + a^2*k^2*phi'^2)"
#define PHI2 "m*x'/cos(phi)*sin(phi/k) + m*a*k*phi'*cos(phi/k)"
#define PHI3 "m*a^2*k^2/2*" LOG " - m*a^2*t*" ROOT
#define E_0 "(m*a^2/2*(x'^2/(a^2*cos(phi)^2) + k^2*phi'^2))"
#define E_T "(m*x'^2/(2*cos(phi)^2))"
#define GREAT "k^2/(" ROOT ")^2*" LOG
#define TURN "((phi'*t + x'/(a*phi'*cos(phi)))/" ROOT ")"
#define GLIDE "((a*k^2*cos(phi) - x'*t)/" ROOT ")"
#define PLACES "Z0=" GREAT "; phi=" GREAT "*phi' - " TURN "; x=" GREAT "*x' + " GLIDE "; y=" GREAT "*x'*tan(phi) + " GLIDE "*tan(phi)"
#define RATES(first, second) "; phi'=" GREAT "*(-phi'*x'/(a*k^2*cos(phi))) " first " " GLIDE "*phi'/(a*k^2*cos(phi)); x'=" GREAT \
    "*(a*phi'^2*cos(phi) - phi'*x'*tan(phi)) " second " " TURN "*(a*phi'*cos(phi) - x'*tan(phi))"
#define LBAR "(m/2*(x'^2/cos(phi)^2 + a^2*k^2*phi'^2))"
#define DELTA "(l - c*sin(psi1))"

/* ---- commands whose JSON is read ---- */

enum { D_PHI1, D_PHI2, D_PHI3, D_PRODUCT, D_ANALYZE, D_SPEED, D_CRANE, D_DISK, D_ROLLING, D_BODY, D_PENDULUM, D_UPRIGHT, D_SYMMETRIES, D_SUBNORMAL, D_DISK_CURRENTS, D_SCALING, D_TOP, D_SEMIHOLONOMIC, D_ZERO, D_COUNT, D_NONE };

static const struct {
    const char *system, *words, *shown; /* shown: with the names of long formulas, which the page defines; NULL: the words themselves */
} DOCUMENTS[D_COUNT] = {
    {"sleigh", "verify sleigh --velocities coordinates --equations --current \"" PHI1 "\"", "verify sleigh --equations --current Phi_1"},
    {"sleigh", "verify sleigh --velocities coordinates --equations --current \"" PHI2 "\"", "verify sleigh --equations --current Phi_2"},
    {"sleigh", "verify sleigh --velocities coordinates --equations --current \"" PHI3 "\"", "verify sleigh --equations --current Phi_3"},
    {"sleigh", "verify sleigh --velocities coordinates --equations --current \"(" PHI1 ")*(" PHI2 ")\"", "verify sleigh --equations --current Phi_1*Phi_2"},
    {"sleigh", "analyze sleigh", NULL},
    {"constant_speed", "verify constant_speed --equations --current \"atanh(z'/c) + g*t/c\"", NULL},
    {"crane", "reduce crane --group \"1, 2, 3, 5, 6\" --equations --until 1", NULL},
    {"euler_disk", "reduce euler_disk --group \"psi=1; x1=1; x2=1\" --chain \"1; 2, 3\" --equations --until 1", NULL},
    {"euler_disk", "verify euler_disk --equations --current \"t\"", NULL},
    {"sleigh_inertia", "reduce sleigh_inertia --until 1", NULL},
    {"spherical_pendulum", "reduce spherical_pendulum --until 1", NULL},
    {"vertical_disk", "reduce vertical_disk --equations --until 1", NULL},
    {"sleigh", "analyze sleigh --equations", NULL},
    {"euler_disk", "reduce euler_disk --chain \"4; 1; 2; 3\" --until 1", NULL},
    {"euler_disk", "analyze euler_disk", NULL},
    {"free_particle", "verify free_particle --field \"t=2*t; x=x; y=y; z=z\"", NULL},
    {"euler_top", "reduce euler_top --until 1", NULL},
    {"tests/data/curved_rail.yaml", "verify tests/data/curved_rail.yaml --equations --current \"(T + V)*(y - c*x^2 - b*sin(phi))\"", NULL},
    {"euler_disk", "reduce euler_disk --group \"psi=1; x1=1; x2=1\" --chain \"1; 2, 3\" --option lifts=1 --equations --until 1", NULL},
};

/* ---- rows ---- */

typedef enum {
    VALUE,     /* the shown coefficient is the printed formula (else the corrected one, `meant`) */
    AT,        /* the same for an expression at a place of the JSON, `label` */
    HOLDS,     /* the determining equations of this number hold for the current's field */
    CURRENT,   /* is conserved; FIELD: is a constraint symmetry; else `meant` is */
    FIELD,
    REFUTED,   /* a field is a constraint symmetry, which the paper excludes */
    IS,        /* the JSON has `printed` at the place `label` */
    SMALL,     /* the number there is a residual, near rounding */
    BY,        /* a computation of its own, `label` names it */
    NOT        /* not computable: `printed` says why */
} kind;

typedef struct {
    const char *paper, *item, *what;
    kind kind;
    int document;
    const char *section, *label, *of, *printed, *meant;
    double k;  /* of CURRENT: the value of k; 0: all */
    bool ours; /* an object of the paper of which it prints no value: `printed` is what the program gave before */
} row;

#define A "sym"
#define B "stages"
#define C "chains"

static const row ROWS[] = {
    {A, "2.1", "first prolongation of 2 t d/dt + x d/dx + y d/dy + z d/dz: along x', dZ^x/dt - x' dZ^0/dt", AT, D_SCALING, .label = "symmetry.components.x'",
        .printed = "x' - x'*2"},
    {A, "(1)", "first variation formula, under the integrals: for any variation, with A and B of (3)", BY, D_PHI1, .label = "first variation"},
    {A, "(2), (3)", "E_phi: coefficient of phi''", VALUE, D_PHI1, "chetaev_equations", "#0", "phi''", "-m*a^2*k^2", .k = 0},
    {A, "(2), (3)", "A_x", VALUE, D_PHI1, "chetaev_equations", "#1", "", "m*a*phi'^2*cos(phi)", .k = 0},
    {A, "(4)", "unconstrained Noether equation: rotations of the Kepler problem", FIELD, D_NONE, .label = "kepler", .printed = "x=-y; y=x"},
    {A, "(5)", "its current", CURRENT, D_NONE, .label = "kepler", .printed = "m*(x*y' - x'*y)"},
    {A, "normal form, (28)", "g of the sleigh", VALUE, D_PHI1, "normal_form", "y'", "", "x'*tan(phi)", .k = 0},
    {A, "(6)", "phi^1: dx", VALUE, D_PHI1, "canonical_distribution", "phi^1", "dx", "-tan(phi)", .k = 0},
    {A, "(6)", "phi^1: dy", VALUE, D_PHI1, "canonical_distribution", "phi^1", "dy", "1", .k = 0},
    {A, "(7)", "nonholonomic first variation, under the integrals: for any Z in the canonical distribution, with Abar and Bbar", BY, D_PHI1, .label = "constrained variation"},
    {A, "(8)", "eps_l(Lbar) - Lbar_a eps_l(g^a) = Abar_l + Bbar_ls q''^s", BY, D_PHI1, .label = "euler"},
    {A, "(9)", "its second form, through A and B of (3)", BY, D_PHI1, .label = "projection"},
    {A, "(10)", "Chetaev's equations with the accelerations of (21) and mu of (47)", BY, D_PHI1, .label = "chetaev"},
    {A, "(11)", "a Chetaev field's component along y", BY, D_PRODUCT, .label = "chetaev field"},
    {A, "(12)", "F_1 of Z(Phi_2), by its formula in components", BY, D_PHI2, .label = "F"},
    {A, "(13)", "the current of a field", BY, D_PRODUCT, .label = "current"},
    {A, "(14)", "for the field of Phi_1 Phi_2", HOLDS, D_PRODUCT, .of = "14"},
    {A, "(15)", "for the field of Phi_1 Phi_2; the second term of the bracket of Z^0 belongs inside", BY, D_PRODUCT, .label = "15"},
    {A, "(16)", "for the field of Phi_1 Phi_2", HOLDS, D_PRODUCT, .of = "16"},
    {A, "(17)", "for the field of Phi_3", HOLDS, D_PHI3, .of = "17"},
    {A, "(18)", "for the field of Phi_3", HOLDS, D_PHI3, .of = "18"},
    {A, "(19)", "for the field of Phi_3", HOLDS, D_PHI3, .of = "19"},
    {A, "semiholonomic form", "of (14)-(16), for the field of a product of two currents", BY, D_SEMIHOLONOMIC, .label = "semiholonomic"},
    {A, "(20)", "Z^phi of Phi_2", AT, D_PHI2, .label = "symmetry.components.phi", .printed = "cos(phi/k)/(a*k)"},
    {A, "(20)", "Ztilde^x of Phi_2", AT, D_PHI2, .label = "symmetry.components.x'", .printed = "(a*phi'*cos(phi) - x'*tan(phi))*cos(phi/k)/(a*k)"},
    {A, "(21)", "Gamma: along phi'", VALUE, D_PHI1, "semispray", "Gamma", "d/dphi'", "-phi'*x'/(a*k^2*cos(phi))", .k = 0},
    {A, "(21)", "Gamma: along x'", VALUE, D_PHI1, "semispray", "Gamma", "d/dx'", "a*phi'^2*cos(phi) - phi'*x'*tan(phi)", .k = 0},
    {A, "3.3", "f Gamma is a constraint symmetry only if dLbar annihilates C: but Gamma/Lbar always is one", REFUTED, D_NONE, .label = "sleigh",
        .printed = "Z0=1/" LBAR "; phi=phi'/" LBAR "; x=x'/" LBAR "; y=x'*tan(phi)/" LBAR},
    {A, "(22)", "for a nonlinear constraint (constant speed), a current with t in it: right is -W^l [eps'_l(g) + g_lr (Bbar^-1)^rp Abar_p]", BY, D_SPEED, .label = "22"},
    {A, "(23)", "i_[Gamma,Z2] phi^1 for a linear constraint", VALUE, D_PHI2, "currents", "i_[Gamma,Z(Phi)]phi^1", "",
        "-x'/(a*k*cos(phi)^2)*cos(phi/k) + phi'/cos(phi)*sin(phi/k)", .k = 0},
    {A, "(24)", "component of [Gamma,Z3] along t: the paper has [Z,Gamma]", BY, D_PHI3, .label = "24"},
    {A, "(25)-(27)", "Z(Phi_1) is of case 1", IS, D_PHI1, .label = "symmetry.case", .printed = "1"},
    {A, "(25)-(27)", "Z(Phi_2) is of case 3", IS, D_PHI2, .label = "symmetry.case", .printed = "3"},
    {A, "(25)-(27)", "Z(Phi_3) is of case 3", IS, D_PHI3, .label = "symmetry.case", .printed = "3"},
    {A, "figure 1", "the sleigh", NOT, D_NONE, .printed = "a drawing; the page of `analyze sleigh` draws the sleigh in motion"},
    {A, "(29)", "Lbar", VALUE, D_PHI1, "lagrangian", "Lbar", "", LBAR, .k = 0},
    {A, "(29)", "Lbar_1", VALUE, D_PHI1, "lagrangian", "Lbar_y", "", "m*(x'*tan(phi) + a*phi'*cos(phi))", .k = 0},
    {A, "(30)", "Abar_phi", VALUE, D_PHI1, "reduced_equations", "Abar_phi", "", "-m*a*phi'*x'/cos(phi)", .k = 0},
    {A, "(30)", "Abar_x", VALUE, D_PHI1, "reduced_equations", "Abar_x", "", "m*a*phi'^2/cos(phi) - m*phi'*x'*sin(phi)/cos(phi)^3", .k = 0},
    {A, "(30)", "Bbar_phi,phi", VALUE, D_PHI1, "reduced_equations", "Bbar_phi,phi", "", "-m*a^2*k^2", .k = 0},
    {A, "(30)", "Bbar_x,x", VALUE, D_PHI1, "reduced_equations", "Bbar_x,x", "", "-m/cos(phi)^2", .k = 0},
    {A, "(30)", "inverse, x,x", VALUE, D_PHI1, "reduced_equations", "(Bbar^-1)_x,x", "", "-cos(phi)^2/m", .k = 0},
    {A, "(31)", "phi'' = ..", VALUE, D_PHI1, "semispray", "Gamma", "d/dphi'", "-phi'*x'/(a*k^2*cos(phi))", .k = 0},
    {A, "(32)", "first form", BY, D_PHI1, .label = "32"},
    {A, "(32)", "second form, x'' = ..", VALUE, D_PHI1, "semispray", "Gamma", "d/dx'", "a*phi'^2*cos(phi) - phi'*x'*tan(phi)", .k = 0},
    {A, "(33)", "the motion from phi = 0, x' = 0, in (31) and (32)", BY, D_PHI1, .label = "33"},
    {A, "figures 2-5", "paths for k = 1, .., 4, drawn from computed motions, against (33)", BY, D_ANALYZE, .label = "figure", .of = "0"},
    {A, "(34), 1st", "coefficient of Z^phi - phi' Z^0", VALUE, D_PHI1, "determining_equations", "(17)", "zeta^phi", "-m*a*phi'*x'/cos(phi)", .k = 0},
    {A, "(34), 2nd", "coefficient of Z^0", BY, D_PHI1, .label = "34"},
    {A, "(34), 5th", "coefficient of Z^x - x' Z^0", VALUE, D_PHI1, "determining_equations", "(19, x)", "zeta^x", "-m/cos(phi)^2", .k = 0},
    {A, "(35)", "omega' in v and omega", AT, D_ANALYZE, .label = "reduced_equations.0.rate", .printed = "-omega*v/(a*k^2)"},
    {A, "(35)", "v' in v and omega", AT, D_ANALYZE, .label = "reduced_equations.1.rate", .printed = "a*omega^2"},
    {A, "(36)", "Phi_1", CURRENT, D_NONE, .label = "sleigh", .printed = PHI1},
    {A, "(37)", "E_T, E_R along (33)", BY, D_PHI1, .label = "37"},
    {A, "figure 6", "energies over time, drawn from computed motions, against (37)", BY, D_ANALYZE, .label = "figure", .of = "1"},
    {A, "(38)", "E_T,C, E_R,C along (33)", BY, D_PHI1, .label = "38"},
    {A, "figure 7", "energies with respect to the centre of mass, likewise against (38); the paper divides them by E_0", BY, D_ANALYZE, .label = "figure", .of = "3"},
    {A, "Phi_2", "", CURRENT, D_NONE, .label = "sleigh", .printed = PHI2},
    {A, "Phi_3", "", CURRENT, D_NONE, .label = "sleigh", .printed = PHI3},
    {A, "Phi_3", "shortened, with energies: needs the sign of x'/cos phi", CURRENT, D_NONE, .label = "sleigh",
        .printed = "m*a^2*k^2/2*log((sqrt(" E_0 ") + sqrt(" E_T "))/(sqrt(" E_0 ") - sqrt(" E_T "))) - a*t*sqrt(2*m*" E_0 ")", .meant = PHI3},
    {A, "k = 1", "momentum of the centre of mass along y", CURRENT, D_NONE, .label = "sleigh", .printed = "m*(x'*tan(phi) + a*phi'*cos(phi))", .k = 1},
    {A, "k = 1", "... and along x", CURRENT, D_NONE, .label = "sleigh", .printed = "m*(x' - a*phi'*sin(phi))", .k = 1},
    {A, "Z(Phi_1)", "", FIELD, D_NONE, .label = "sleigh", .printed = "Z0=1"},
    {A, "Z(Phi_2)", "", FIELD, D_NONE, .label = "sleigh", .printed = "phi=cos(phi/k)/(a*k); x=cos(phi)*sin(phi/k); y=sin(phi)*sin(phi/k)"},
    {A, "Z(Phi_3)", "two components outside of the Gamma term have the wrong sign", FIELD, D_NONE, .label = "sleigh", .printed = PLACES RATES("+", "+"),
        .meant = PLACES RATES("-", "-")},
    {A, "(39)", "coefficient of Z^phi", VALUE, D_PHI1, "determining_equations", "(14)", "Z^phi", "m*a^2*(-x'*phi'/(a*cos(phi)))", .k = 0},
    {A, "(39)", "coefficient of Z^x", VALUE, D_PHI1, "determining_equations", "(14)", "Z^x", "m*a^2*(x'*phi'*sin(phi)/(a^2*cos(phi)^3) + phi'^2/(a*cos(phi)))", .k = 0},
    {A, "(40)", "coefficient of d_c Z^0/dphi", VALUE, D_PHI1, "determining_equations", "(15, phi)", "d_c Z^0/dphi", "-m*a^2/2*(x'^2/(a^2*cos(phi)) + k^2*phi'^2)",
        "-m*a^2/2*(x'^2/(a^2*cos(phi)^2) + k^2*phi'^2)", .k = 0},
    {A, "(41)", "coefficient of Z^phi", VALUE, D_PHI1, "determining_equations", "(15, x)", "Z^phi", "m*a^2*(x'*sin(phi)/(a^2*cos(phi)^3) - phi'/(a*cos(phi)))", .k = 0},
    {A, "(42)", "coefficient of dZ^phi/dphi'", VALUE, D_PHI1, "determining_equations", "(16, phi)", "dZ^phi/dphi'", "m*a^2*k^2*phi'", .k = 0},
    {A, "(43)", "coefficient of dZ^x/dx'", VALUE, D_PHI1, "determining_equations", "(16, x)", "dZ^x/dx'", "m*x'/cos(phi)^2", .k = 0},
    {A, "after (43)", "i_[Gamma,Z1] phi^1", VALUE, D_PHI1, "currents", "i_[Gamma,Z(Phi)]phi^1", "", "0", .k = 0},
    {A, "after (43)", "i_[Gamma,Z3] phi^1: the sign", VALUE, D_PHI3, "currents", "i_[Gamma,Z(Phi)]phi^1", "", "-a/(phi'*cos(phi))*" ROOT, "a/(phi'*cos(phi))*" ROOT, .k = 0},
    {A, "(44)", "2nd: coefficient of phi''", VALUE, D_PHI1, "chetaev_equations", "#1", "phi''", "m*a*sin(phi)", .k = 0},
    {A, "(44)", "3rd: coefficient of phi''", VALUE, D_PHI1, "chetaev_equations", "#2", "phi''", "-m*a*cos(phi)", .k = 0},
    {A, "(44)", "2nd: df/dx'", VALUE, D_PHI1, "chetaev_equations", "#1", "=mu", "-tan(phi)", .k = 0},
    {A, "(45), (47)", "minus the force along y: the program gives the reaction on the sleigh", VALUE, D_PHI1, "chetaev_equations", "F_y", "", "(k^2 - 1)/k^2*m*phi'*x'", .k = 0},
    {A, "(46)", "Euler force along x", VALUE, D_PHI1, "inertial_forces", "F_x^Euler", "phi''", "m*a*sin(phi)", .k = 0},
    {A, "(46)", "centrifugal force along y", VALUE, D_PHI1, "inertial_forces", "F_y^centrifugal", "", "m*a*phi'^2*sin(phi)", .k = 0},
    {A, "(46)", "no Coriolis force", VALUE, D_PHI1, "inertial_forces", "F_x^Coriolis", "", "0", .k = 0},
    {A, "(47)", "mu, with J = m a^2 (k^2 - 1)", VALUE, D_PHI1, "chetaev_equations", "mu", "", "-m*(k^2 - 1)/k^2*phi'*x'", .k = 0},
    {A, "4.2", "dimension of the constraint symmetries of currents of degree two", VALUE, D_SYMMETRIES, "symmetry_space", "dim", "", "7", .k = 0, .ours = true},
    {A, "4.2", "which currents have [Gamma,Z] in the canonical distribution", IS, D_SYMMETRIES, .label = "equations.bracket_bounds.2.words",
        .printed = "So the currents with [Gamma,Z] in the canonical distribution are the functions of Phi1, and no others: proved.", .ours = true},
    {A, "4.2", "which have a field of case 1", IS, D_SYMMETRIES, .label = "equations.bracket_bounds.4.words",
        .printed = "So the currents with a field of case 1 are the functions of Phi1, and no others: proved.", .ours = true},
    {A, "4.2", "dimension of the point symmetries of the equations", VALUE, D_SYMMETRIES, "equation_symmetries", "dim_point", "", "5", .k = 0, .ours = true},
    {A, "4.3", "the force is not variational: 2 dF_x/dx', which Helmholtz's conditions want to be 0, is -2 (k^2 - 1)/k^2 m phi' tan(phi)", BY, D_PHI1, .label = "helmholtz"},

    {C, "(2.1)-(2.4)", "metric of the crane's eight coordinates, (3.22)", BY, D_NONE, .label = "crane metric"},
    {C, "(2.5)", "fields of the action: {H, J} = 0 for the momentum J of each, at p = dL/dq'", BY, D_CRANE, .label = "lifted action"},
    {C, "(2.6)", "momentum map: p_phi1 of the group's third generator, by (3.22)", AT, D_CRANE, .label = "divided.momentum_map.2",
        .printed = "(jz3 + jx6*sin(phi2)^2 + jy6*cos(phi2)^2)*(theta' + phi1')"},
    {C, "definition 2.1", "the group: NHR1, NHR2", IS, D_CRANE, .label = "group.name", .printed = "SE(2) x SO(2)^3"},
    {C, "definition 2.2, (2.7)", "Chaplygin system: NHR3", IS, D_CRANE, .label = "chaplygin", .printed = "true"},
    {C, "(2.8)", "A-hat: x, psi1", VALUE, D_CRANE, "0.connection", "Ahat_psi1^1", "", "-l*c*cos(psi1)/" DELTA, .k = 0},
    {C, "(2.8)", "A-hat: x, psi2", VALUE, D_CRANE, "0.connection", "Ahat_psi2^1", "", "-l*b*cos(psi1)/" DELTA, .k = 0},
    {C, "(2.8)", "A-hat: theta, psi1", VALUE, D_CRANE, "0.connection", "Ahat_psi1^4", "", "-c*sin(psi1)/" DELTA, .k = 0},
    {C, "(2.8)", "A-hat: theta, psi2", VALUE, D_CRANE, "0.connection", "Ahat_psi2^4", "", "-b*sin(psi1)/" DELTA, .k = 0},
    {C, "(2.8)", "A-hat: psi3, psi1", VALUE, D_CRANE, "0.connection", "Ahat_psi1^3", "", "-2*l*c/(b*" DELTA ")", .k = 0},
    {C, "(2.8)", "A-hat: psi3, psi2", VALUE, D_CRANE, "0.connection", "Ahat_psi2^3", "", "-(l + c*sin(psi1))/" DELTA, .k = 0},
    {C, "(2.9)", "horizontal lift of psi1: along e_1", VALUE, D_CRANE, "0.connection", "hor(d/dpsi1)", "e_1", "l*c*cos(psi1)/" DELTA, .k = 0},
    {C, "(2.10), (5.30)", "H(x, p) with p = K-hat x' is the kinetic energy", BY, D_CRANE, .label = "crane hamiltonian"},
    {C, "theorem 2.3, 5.1, (2.11)", "reduced motion against the full one", SMALL, D_CRANE, .label = "stages.0.agreement_with_full"},
    {C, "(2.12)", "Upsilon_12 = F . vector with the momentum in the body frame", BY, D_CRANE, .label = "upsilon"},
    {C, "(2.12)", "curvature: theta", VALUE, D_CRANE, "0.connection", "B_psi1,psi2^4", "", "-l*b*cos(psi1)/" DELTA "^2", .k = 0, .ours = true},
    {C, "(2.12)", "all other Upsilon vanish: lines of others", BY, D_CRANE, .label = "other upsilon"},
    {C, "proposition 1, (i), (ii)", "condition (ii) for N = Q3", SMALL, D_CRANE, .label = "stages.1.condition_strong"},
    {C, "proposition 2", "the momentum is kept", SMALL, D_CRANE, .label = "stages.1.momentum_drift"},
    {C, "(2.13)", "the level set's form", NOT, D_NONE, .printed = "coordinate-free; in coordinates it is (2.19) and (2.20)"},
    {C, "(2.14)", "locked inertia", VALUE, D_CRANE, "1.mechanical_connection", "I_1,1", "", "jz3 + jx6*sin(phi2)^2 + jy6*cos(phi2)^2", .k = 0, .ours = true},
    {C, "(2.14)", "A-breve: psi1", VALUE, D_CRANE, "1.mechanical_connection", "Abreve_psi1^1", "", "c*sin(psi1)/" DELTA, .k = 0},
    {C, "(2.14)", "A-breve: psi2", VALUE, D_CRANE, "1.mechanical_connection", "Abreve_psi2^1", "", "b*sin(psi1)/" DELTA, .k = 0},
    {C, "(2.15), (2.16)", "N_theta = N", IS, D_CRANE, .label = "stages.1.abelian", .printed = "true"},
    {C, "lemma 2.4, alpha_theta", "momentum along psi1 on the level set", VALUE, D_CRANE, "1.hamiltonian", "phat_psi1", "theta_1", "c*sin(psi1)/" DELTA, .k = 0},
    {C, "lemma 2.5", "d alpha_theta is basic: nothing in it depends on phi1, and d alpha_theta = Xi_theta along psi1, psi2", BY, D_CRANE, .label = "basic"},
    {C, "(2.17), (2.20)", "Xi_theta", VALUE, D_CRANE, "1.magnetic_form", "Xi_psi1,psi2", "theta_1", "b*l*cos(psi1)/" DELTA "^2", .k = 0},
    {C, "(2.18)", "the inverse of phi_theta: along psi2", VALUE, D_CRANE, "1.hamiltonian", "phat_psi2", "theta_1", "b*sin(psi1)/" DELTA, .k = 0},
    {C, "theorem 2.6, 5.2, (2.19)", "twice reduced motion against the full one", SMALL, D_CRANE, .label = "stages.1.agreement_with_full"},
    {C, "(2.11), (2.19)", "an invariant measure of the reduced crane: for no positive parameters", IS, D_CRANE, .label = "stages.0.measure.never", .printed = "true", .ours = true},
    {C, "definition 3.1, (3.21), (3.22)", "metric from bodies and joints; r_cm,3 and r_6 are misprinted", BY, D_NONE, .label = "crane metric"},
    {C, "(3.23)", "potential of a field g that points down: T + V of the masses of a double pendulum", CURRENT, D_NONE, .label = "double_pendulum",
        .printed = "T + a*g*l*cos(p) + b*g*(l*cos(p) + h*cos(q))", .meant = "T - a*g*l*cos(p) - b*g*(l*cos(p) + h*cos(q))"},
    {C, "(3.24)", "Legendre map of the chain", BY, D_NONE, .label = "crane metric"},
    {C, "theorem 4.1", "the first joint's group", IS, D_CRANE, .label = "joints.0.rule", .printed = "first joint"},
    {C, "(4.25)-(4.29), proposition 3", "symmetries joint by joint: d/dphi1 leaves the kinetic energy invariant", IS, D_CRANE, .label = "joints.#phi1.kinetic_energy", .printed = "true"},
    {C, "(5.31)-(5.34)", "a non-abelian second group (Euler's top, SO(3)), by the bundle of coadjoint orbits: reduced motion against the full one", SMALL, D_TOP,
        .label = "stages.1.agreement_with_full", .ours = true},
    {C, "figures 1, 2", "the crane and its frames", NOT, D_NONE, .printed = "drawings"},

    {B, "(1)-(4)", "reduced covariant derivative", NOT, D_NONE, .printed = "coordinate-free; in the algebra it is b of (10)"},
    {B, "(5)-(7)", "a of the chain of SE(2) x R", VALUE, D_UPRIGHT, "2.chain", "a_0(e_4,e_4)", "e_1", "0", .k = 0},
    {B, "lemma 2.2, (8)-(10)", "b of the chain of SE(2) x R: b(e_4, e_1)", VALUE, D_UPRIGHT, "2.chain", "b_0(e_4,e_1)", "e_2", "1", .k = 0},
    {B, "proposition 2.1, (11), (12)", "bracket by two stages", BY, D_NONE, .label = "bracket", .of = "2"},
    {B, "theorem 2.3, (13)-(15)", "bracket by several stages", BY, D_NONE, .label = "bracket", .of = "9"},
    {B, "theorem 2.3", "a subnormal chain of the disk's group: bracket", SMALL, D_SUBNORMAL, .label = "stages.last.by_stages.bracket", .ours = true},
    {B, "theorem 2.3", "... and Euler-Poincare right-hand side", SMALL, D_SUBNORMAL, .label = "stages.last.by_stages.euler_poincare", .ours = true},
    {B, "theorem 2.3", "... and the disk's equations along it", SMALL, D_SUBNORMAL, .label = "stages.last.by_stages.by_stages_vertical", .ours = true},
    {B, "(16)-(19)", "Euler-Poincare equations, full pairing", BY, D_NONE, .label = "euler-poincare", .of = "whole"},
    {B, "(20), (21)", "Euler-Poincare equations by stages as printed", BY, D_NONE, .label = "euler-poincare", .of = "printed"},
    {B, "example of (21)", "SO(3) x SO(3) x R: each factor has the equations of its own", BY, D_NONE, .label = "direct product"},
    {B, "(22)-(32)", "Euler-d'Alembert-Poincare equations by stages (a sleigh)", SMALL, D_BODY, .label = "stages.1.by_stages.by_stages_vertical"},
    {B, "(33)-(39)", "Lagrange-Poincare equations by stages (spherical pendulum)", SMALL, D_PENDULUM, .label = "stages.0.by_stages.by_stages_horizontal"},
    {B, "(40)-(43), vertical", "Lagrange-d'Alembert-Poincare equations by stages", SMALL, D_DISK, .label = "stages.last.by_stages.by_stages_vertical"},
    {B, "(40)-(43), horizontal", "", SMALL, D_DISK, .label = "stages.last.by_stages.by_stages_horizontal"},
    {B, "(44), (46)", "orbits of dimension 3 in 5 coordinates", IS, D_DISK, .label = "group.orbit", .printed = "3"},
    {B, "(45)", "constraint of the disk: x1'", VALUE, D_ROLLING, "normal_form", "x1'", "", "-r*psi'*cos(varphi)", .k = 0},
    {B, "(47)", "S: along d/dx1", VALUE, D_DISK, "last.connection", "chi_1", "e_2", "-r*cos(varphi)", .k = 0},
    {B, "(48)", "the lift of d/dvarphi: along the group", VALUE, D_ZERO, "last.connection", "hor(d/dvarphi)", "e_1", "0", .k = 0},
    {B, "(48)", "... and along d/dvarphi", VALUE, D_ZERO, "last.connection", "hor(d/dvarphi)", "d/dvarphi", "1", .k = 0},
    {B, "(48)", "... and the curvature, which vanishes", VALUE, D_ZERO, "last.connection", "B_theta,varphi^1", "", "0", .k = 0},
    {B, "(48)", "the equations by stages with this connection", SMALL, D_ZERO, .label = "stages.last.by_stages.by_stages_horizontal"},
    {B, "(49), (50)", "the chain", IS, D_DISK, .label = "stages.last.chain", .printed = "[[1],[2,3]]"},
    {B, "reduced Lagrangian", "l of the disk", BY, D_ROLLING, .label = "disk lagrangian"},
    {B, "(51), final system, 1st", "I_3, not r I_3", BY, D_ROLLING, .label = "disk", .of = "1"},
    {B, "(51), final system, 2nd", "along varphi", BY, D_ROLLING, .label = "disk", .of = "2"},
    {B, "(51), final system, 3rd", "along theta", BY, D_ROLLING, .label = "disk", .of = "3"},
    {B, "solution of (51)", "currents with the functions of theta that solve it, beside the energy", IS, D_DISK_CURRENTS, .label = "independent_currents", .printed = "3", .ours = true},
    {B, "solution of (51)", "Phi_2, linear in varphi', psi', with Riemann's functions riemann_c(n, kappa, 3/4, cot(theta)): its rate along (51)", BY, D_DISK_CURRENTS, .label = "solves", .of = "riemann_c(", .ours = true},
    {B, "solution of (51)", "Phi_3, likewise with riemann_s: its rate along (51)", BY, D_DISK_CURRENTS, .label = "solves", .of = "riemann_s(", .ours = true},
    {B, "appendix A", "definitions 7.1-7.5, lemmas 7.4, 7.6, (52)", NOT, D_NONE, .printed = "coordinate-free calculus on associated bundles; on a slice it is the connection and its curvature (`reduce --equations`)"},
    {B, "appendix B", "definition 7.7, theorem 7.8, (53)-(57)", NOT, D_NONE, .printed = "coordinate-free form of (33)-(43), which are computed"},
};

#undef A
#undef B
#undef C

#endif

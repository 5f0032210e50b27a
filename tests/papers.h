/* papers: the rows of docs/papers.md: what the three papers of the program's method print, and what the program is asked for.
 *
 * No row holds its finding: papers_find.h computes it. */
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

/* ---- commands whose text is read ---- */

/* clang-format off */
#define COMMANDS(X) \
    X(D_SHOW, "sleigh", "nhsym show sleigh --velocities coordinates --equations --details") \
    X(D_QUASI, "sleigh", "nhsym show sleigh --equations") \
    X(D_PHI1, "sleigh", "nhsym verify sleigh --velocities coordinates --equations --current Phi_1") \
    X(D_PHI2, "sleigh", "nhsym verify sleigh --velocities coordinates --equations --current Phi_2") \
    X(D_PHI3, "sleigh", "nhsym verify sleigh --velocities coordinates --equations --current Phi_3") \
    X(D_PRODUCT, "sleigh", "nhsym verify sleigh --velocities coordinates --equations --current Phi_1*Phi_2") \
    X(D_SYMMETRIES, "sleigh", "nhsym analyze sleigh --equations --details") \
    X(D_PATH1, "sleigh", "nhsym simulate sleigh --set k=1 --initial \"phi=0, omega=1, v=0\" --until 5 --step 0.1 --tolerance 1e-13") \
    X(D_PATH2, "sleigh", "nhsym simulate sleigh --set k=2 --initial \"phi=0, omega=2, v=0\" --until 5 --step 0.1 --tolerance 1e-13") \
    X(D_PATH3, "sleigh", "nhsym simulate sleigh --set k=3 --initial \"phi=0, omega=3, v=0\" --until 5 --step 0.1 --tolerance 1e-13") \
    X(D_PATH4, "sleigh", "nhsym simulate sleigh --set k=4 --initial \"phi=0, omega=4, v=0\" --until 5 --step 0.1 --tolerance 1e-13") \
    X(D_SPEED, "constant_speed", "nhsym verify constant_speed --equations --current \"atanh(z'/c) + g*t/c\"") \
    X(D_SPEED2, "constant_speed", "nhsym verify constant_speed --equations --current \"y'/x'\"") \
    X(D_SCALING, "free_particle", "nhsym verify free_particle --field \"t=2*t; x=x; y=y; z=z\"") \
    X(D_SEMIHOLONOMIC, "tests/data/curved_rail.yaml", "nhsym verify tests/data/curved_rail.yaml --equations --current \"(T + V)*(y - c*x^2 - b*sin(phi))\"") \
    X(D_CRANE_GEOMETRY, "crane", "nhsym show crane --velocities coordinates --equations --details") \
    X(D_CRANE_ANALYSIS, "crane", "nhsym analyze crane --details") \
    X(D_CRANE, "crane", "nhsym reduce crane --group \"1, 2, 3, 5, 6\" --equations --until 1") \
    X(D_ROLLING, "euler_disk", "nhsym show euler_disk --velocities coordinates --equations --details") \
    X(D_DISK, "euler_disk", "nhsym reduce euler_disk --group \"psi=1; x1=1; x2=1\" --chain \"1; 2, 3\" --equations --until 1") \
    X(D_ZERO, "euler_disk", "nhsym reduce euler_disk --group \"psi=1; x1=1; x2=1\" --chain \"1; 2, 3\" --option lifts=1 --equations --until 1") \
    X(D_SUBNORMAL, "euler_disk", "nhsym reduce euler_disk --chain \"4; 1; 2; 3\" --equations --until 1") \
    X(D_DISK_CURRENTS, "euler_disk", "nhsym analyze euler_disk --details") \
    X(D_BODY, "sleigh_inertia", "nhsym reduce sleigh_inertia --equations --until 1") \
    X(D_PENDULUM, "spherical_pendulum", "nhsym reduce spherical_pendulum --equations --until 1") \
    X(D_UPRIGHT, "vertical_disk", "nhsym reduce vertical_disk --equations --until 1") \
    X(D_THREE, "vertical_disk", "nhsym reduce vertical_disk --chain \"4; 1; 2, 3\" --equations --until 1") \
    X(D_FOUR, "vertical_disk", "nhsym reduce vertical_disk --chain \"4; 1; 2; 3\" --equations --until 1") \
    X(D_FACTORS, "tests/data/two_tops.yaml", "nhsym reduce tests/data/two_tops.yaml --until 1 --details") \
    X(D_SQUARE, "sleigh", "nhsym verify sleigh --velocities coordinates --equations --current Phi_1*Phi_1") \
    X(D_TOP, "euler_top", "nhsym reduce euler_top --until 1 --details")
/* clang-format on */

#define X(name, system, words) name,
enum { COMMANDS(X) D_COUNT, D_NONE };
#undef X
#define X(name, system, words) {system, words},
static const struct {
    const char *system, *words;
} DOCUMENTS[D_COUNT] = {COMMANDS(X)};
#undef X

/* ---- rows ---- */

typedef enum {
    VALUE,     /* the coefficient that stands there is the printed formula (else the corrected one, `meant`) */
    HOLDS,     /* the determining equations of the number `by` hold for the current's field */
    CURRENT,   /* `printed` is conserved in the system `label`; FIELD: is a constraint symmetry; else `meant` is */
    FIELD,
    REFUTED,   /* a field is a constraint symmetry, which the paper excludes */
    WORDS,     /* the text has the words `printed` */
    NUMBER,    /* the number behind the words `label`, of the stage `of`, is a residual, near rounding */
    BY,        /* a computation of its own, `by` names it, on what stands at `section`, `label` */
    NOT        /* not computable: `printed` says why */
} kind;

typedef struct {
    const char *paper, *item, *what;
    kind kind;
    int document;
    const char *section, *label, *of, *printed, *meant, *by, *part;
    double k;  /* of CURRENT: the value of k; 0: all */
    bool ours; /* an object of the paper of which it prints no value */
} row;

#define A "sym"
#define B "stages"
#define C "chains"

static const row ROWS[] = {
    {A, "2.1", "first prolongation of 2 t d/dt + x d/dx + y d/dy + z d/dz: along x', dZ^x/dt - x' dZ^0/dt", VALUE, D_SCALING, "field", "Z_x'", "", .printed = "x' - x'*2"},
    {A, "(1)", "first variation formula, under the integrals: for any variation, with A and B of (3)", BY, D_SHOW, .by = "first variation", .section = "chetaev_equations", .label = "#1"},
    {A, "(2), (3)", "E_phi: coefficient of phi''", VALUE, D_SHOW, "chetaev_equations", "#0", "phi''", .printed = "-m*a^2*k^2"},
    {A, "(2), (3)", "A_x", VALUE, D_SHOW, "chetaev_equations", "#1", "", .printed = "m*a*phi'^2*cos(phi)"},
    {A, "(4)", "unconstrained Noether equation: rotations of the Kepler problem", FIELD, D_NONE, .label = "kepler", .printed = "x=-y; y=x"},
    {A, "(5)", "its current", CURRENT, D_NONE, .label = "kepler", .printed = "m*(x*y' - x'*y)"},
    {A, "normal form, (28)", "g of the sleigh", VALUE, D_SHOW, "normal_form", "y'", "", .printed = "x'*tan(phi)"},
    {A, "(6)", "phi^1: dx", VALUE, D_SHOW, "canonical_distribution", "phi^1", "dx", .printed = "-tan(phi)"},
    {A, "(6)", "phi^1: dy", VALUE, D_SHOW, "canonical_distribution", "phi^1", "dy", .printed = "1"},
    {A, "(7)", "nonholonomic first variation, under the integrals: for any Z in the canonical distribution, with Abar and Bbar", BY, D_SHOW, .by = "constrained variation", .section = "reduced_equations", .label = "Abar_x"},
    {A, "(8)", "eps_l(Lbar) - Lbar_a eps_l(g^a) = Abar_l + Bbar_ls q''^s", BY, D_SHOW, .by = "euler", .section = "euler_expressions", .label = "eps_phi(Lbar)"},
    {A, "(9)", "its second form, through A and B of (3)", BY, D_SHOW, .by = "projection", .section = "reduced_equations", .label = "Abar_x"},
    {A, "(10)", "Chetaev's equations with the accelerations of (21) and mu of (47)", BY, D_SHOW, .by = "chetaev", .section = "chetaev_equations", .label = "#1"},
    {A, "(11)", "a Chetaev field's component along y", BY, D_PRODUCT, .by = "chetaev field", .section = "symmetry", .label = "Z_y"},
    {A, "(12)", "F_1 of Z(Phi_2), by its formula in components", BY, D_PHI2, .by = "F", .section = "currents", .label = "F_1(Phi)"},
    {A, "(13)", "the current of a field", BY, D_PRODUCT, .by = "current", .section = "determining_equations", .label = "(13)"},
    {A, "(14)", "for the field of Phi_1 Phi_2", HOLDS, D_PRODUCT, .by = "14", .section = "determining_equations", .label = "(14)"},
    {A, "(15)", "for the field of Phi_1 Phi_2; the second term of the bracket of Z^0 belongs inside", BY, D_PRODUCT, .by = "15", .section = "determining_equations", .label = "(15, phi)"},
    {A, "(16)", "for the field of Phi_1 Phi_2", HOLDS, D_PRODUCT, .by = "16", .section = "determining_equations", .label = "(16, phi)"},
    {A, "(17)", "for the field of Phi_3", HOLDS, D_PHI3, .by = "17", .section = "determining_equations", .label = "(17)"},
    {A, "(18)", "for the field of Phi_3", HOLDS, D_PHI3, .by = "18", .section = "determining_equations", .label = "(18, phi)"},
    {A, "(19)", "for the field of Phi_3", HOLDS, D_PHI3, .by = "19", .section = "determining_equations", .label = "(19, phi)"},
    {A, "semiholonomic form", "of (14)-(16), for the field of a product of two currents", BY, D_SEMIHOLONOMIC, .by = "semiholonomic", .section = "symmetry", .label = "Z_t"},
    {A, "(20)", "Z^phi of Phi_2", VALUE, D_PHI2, "symmetry", "Z_phi", "", .printed = "cos(phi/k)/(a*k)"},
    {A, "(20)", "Ztilde^x of Phi_2", VALUE, D_PHI2, "symmetry", "Z_x'", "", .printed = "(a*phi'*cos(phi) - x'*tan(phi))*cos(phi/k)/(a*k)"},
    {A, "(21)", "Gamma: along phi'", VALUE, D_SHOW, "semispray", "Gamma", "d/dphi'", .printed = "-phi'*x'/(a*k^2*cos(phi))"},
    {A, "(21)", "Gamma: along x'", VALUE, D_SHOW, "semispray", "Gamma", "d/dx'", .printed = "a*phi'^2*cos(phi) - phi'*x'*tan(phi)"},
    {A, "3.3", "f Gamma is a constraint symmetry only if dLbar annihilates C: but Gamma/Lbar always is one", REFUTED, D_NONE, .label = "sleigh", .printed = "Gamma/Lbar"},
    {A, "(22)", "for a nonlinear constraint (constant speed), a current with t in it: right is -W^l [eps'_l(g) + g_lr (Bbar^-1)^rp Abar_p]", BY, D_SPEED, .by = "22", .section = "currents", .label = "i_[Gamma,Z(Phi)]phi^1"},
    {A, "(23)", "i_[Gamma,Z2] phi^1 for a linear constraint", VALUE, D_PHI2, "currents", "i_[Gamma,Z(Phi)]phi^1", "",
        .printed = "-x'/(a*k*cos(phi)^2)*cos(phi/k) + phi'/cos(phi)*sin(phi/k)"},
    {A, "(24)", "component of [Gamma,Z3] along t: the paper has [Z,Gamma]", BY, D_PHI3, "currents", "[Gamma,Z(Phi)]", .by = "24"},
    {A, "(24), third line", "for a nonlinear constraint, where [Gamma,Z] lies in the canonical distribution: W^l [eps'_l(g) + g_ls (BA)^s] belongs there", BY, D_SPEED2, "currents", "i_[Gamma,Z(Phi)]phi^1", .by = "26 nonlinear"},
    {A, "(24), last line", "the derivative d_c by a velocity means that by a coordinate: [Gamma,Z2] along velocities", BY, D_PHI2, "currents", "[Gamma,Z(Phi)]", .by = "24 last"},
    {A, "before (25)", "[Gamma,Z] = a Gamma along velocities lacks a: of Gamma/Lbar", BY, D_SHOW, "semispray", "Gamma", .by = "before 25"},
    {A, "(25)", "for Gamma/Lbar and for d/dt, the field of minus the energy", BY, D_SHOW, "semispray", "Gamma", .by = "25"},
    {A, "(26)", "for the field of Phi_1 Phi_1, a linear constraint", BY, D_SQUARE, "euler_expressions", "eps_phi(g^y)", .by = "26"},
    {A, "(26)", "for a nonlinear constraint (constant speed), the field of y'/x', whose [Gamma,Z] lies in the canonical distribution", BY, D_SPEED2, "euler_expressions", "eps_y(g^x)", .by = "26 nonlinear"},
    {A, "(27)", "for Gamma/Lbar, a symmetry of the equations of motion: right is -Ztilde^s d(BA)^l/dv^s", BY, D_SHOW, "semispray", "Gamma", .by = "27"},
    {A, "cases 1)-3)", "Z(Phi_1) is of case 1", WORDS, D_PHI1, .printed = "(case 1)"},
    {A, "cases 1)-3)", "Z(Phi_2) is of case 3", WORDS, D_PHI2, .printed = "(case 3)"},
    {A, "cases 1)-3)", "Z(Phi_3) is of case 3", WORDS, D_PHI3, .printed = "(case 3)"},
    {A, "figure 1", "the sleigh", NOT, D_NONE, .printed = "a drawing; the page of `analyze sleigh` draws the sleigh in motion"},
    {A, "(29)", "Lbar", VALUE, D_SHOW, "lagrangian", "Lbar", "", .printed = LBAR},
    {A, "(29)", "Lbar_1", VALUE, D_SHOW, "lagrangian", "Lbar_y", "", .printed = "m*(x'*tan(phi) + a*phi'*cos(phi))"},
    {A, "(30)", "Abar_phi", VALUE, D_SHOW, "reduced_equations", "Abar_phi", "", .printed = "-m*a*phi'*x'/cos(phi)"},
    {A, "(30)", "Abar_x", VALUE, D_SHOW, "reduced_equations", "Abar_x", "", .printed = "m*a*phi'^2/cos(phi) - m*phi'*x'*sin(phi)/cos(phi)^3"},
    {A, "(30)", "Bbar_phi,phi", VALUE, D_SHOW, "reduced_equations", "Bbar_phi,phi", "", .printed = "-m*a^2*k^2"},
    {A, "(30)", "Bbar_x,x", VALUE, D_SHOW, "reduced_equations", "Bbar_x,x", "", .printed = "-m/cos(phi)^2"},
    {A, "(30)", "inverse, x,x", VALUE, D_SHOW, "reduced_equations", "(Bbar^-1)_x,x", "", .printed = "-cos(phi)^2/m"},
    {A, "(31)", "phi'' = ..", VALUE, D_SHOW, "semispray", "Gamma", "d/dphi'", .printed = "-phi'*x'/(a*k^2*cos(phi))"},
    {A, "(32)", "first form", BY, D_SHOW, .by = "32", .section = "reduced_equations", .label = "(9, x)"},
    {A, "(32)", "second form, x'' = ..", VALUE, D_SHOW, "semispray", "Gamma", "d/dx'", .printed = "a*phi'^2*cos(phi) - phi'*x'*tan(phi)"},
    {A, "(33)", "the motion from phi = 0, x' = 0, in (31) and (32)", BY, D_SHOW, .by = "33", .section = "semispray", .label = "Gamma"},
    {A, "figure 2", "the path for k = 1, against (33)", BY, D_PATH1, .by = "figure", .part = "1 x y phi"},
    {A, "figure 3", "the path for k = 2, against (33)", BY, D_PATH2, .by = "figure", .part = "2 x y phi"},
    {A, "figure 4", "the path for k = 3, against (33)", BY, D_PATH3, .by = "figure", .part = "3 x y phi"},
    {A, "figure 5", "the path for k = 4, against (33)", BY, D_PATH4, .by = "figure", .part = "4 x y phi"},
    {A, "(34), 1st", "coefficient of Z^phi - phi' Z^0", VALUE, D_SHOW, "determining_equations", "(17)", "zeta^phi", .printed = "-m*a*phi'*x'/cos(phi)"},
    {A, "(34), 2nd", "coefficient of Z^0", BY, D_SHOW, .by = "34", .section = "determining_equations", .label = "(18, phi)"},
    {A, "(34), 5th", "coefficient of Z^x - x' Z^0", VALUE, D_SHOW, "determining_equations", "(19, x)", "zeta^x", .printed = "-m/cos(phi)^2"},
    {A, "(35)", "omega' in v and omega", VALUE, D_QUASI, "motion", "omega'", "", .printed = "-omega*v/(a*k^2)"},
    {A, "(35)", "v' in v and omega", VALUE, D_QUASI, "motion", "v'", "", .printed = "a*omega^2"},
    {A, "(36)", "Phi_1", CURRENT, D_NONE, .label = "sleigh", .printed = PHI1},
    {A, "(37)", "E_T, E_R along (33)", BY, D_PATH3, .by = "figure", .part = "3 E_T E_R"},
    {A, "figure 6", "energies over time, against (37)", BY, D_PATH2, .by = "figure", .part = "2 E_T E_R"},
    {A, "(38)", "E_T,C, E_R,C along (33)", BY, D_PATH3, .by = "figure", .part = "3 E_TC E_RC"},
    {A, "figure 7", "energies with respect to the centre of mass, against (38); the paper divides them by E_0", BY, D_PATH2, .by = "figure", .part = "2 E_TC E_RC"},
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
    {A, "(39)", "coefficient of Z^phi", VALUE, D_SHOW, "determining_equations", "(14)", "Z^phi", .printed = "m*a^2*(-x'*phi'/(a*cos(phi)))"},
    {A, "(39)", "coefficient of Z^x", VALUE, D_SHOW, "determining_equations", "(14)", "Z^x", .printed = "m*a^2*(x'*phi'*sin(phi)/(a^2*cos(phi)^3) + phi'^2/(a*cos(phi)))"},
    {A, "(40)", "coefficient of d_c Z^0/dphi", VALUE, D_SHOW, "determining_equations", "(15, phi)", "d_c Z^0/dphi", .printed = "-m*a^2/2*(x'^2/(a^2*cos(phi)) + k^2*phi'^2)",
        "-m*a^2/2*(x'^2/(a^2*cos(phi)^2) + k^2*phi'^2)"},
    {A, "(41)", "coefficient of Z^phi", VALUE, D_SHOW, "determining_equations", "(15, x)", "Z^phi", .printed = "m*a^2*(x'*sin(phi)/(a^2*cos(phi)^3) - phi'/(a*cos(phi)))"},
    {A, "(42)", "coefficient of dZ^phi/dphi'", VALUE, D_SHOW, "determining_equations", "(16, phi)", "dZ^phi/dphi'", .printed = "m*a^2*k^2*phi'"},
    {A, "(43)", "coefficient of dZ^x/dx'", VALUE, D_SHOW, "determining_equations", "(16, x)", "dZ^x/dx'", .printed = "m*x'/cos(phi)^2"},
    {A, "after (43)", "i_[Gamma,Z1] phi^1", VALUE, D_PHI1, "currents", "i_[Gamma,Z(Phi)]phi^1", "", .printed = "0"},
    {A, "after (43)", "i_[Gamma,Z3] phi^1: the sign", VALUE, D_PHI3, "currents", "i_[Gamma,Z(Phi)]phi^1", "", .printed = "-a/(phi'*cos(phi))*" ROOT, .meant = "a/(phi'*cos(phi))*" ROOT},
    {A, "(44)", "2nd: coefficient of phi''", VALUE, D_SHOW, "chetaev_equations", "#1", "phi''", .printed = "m*a*sin(phi)"},
    {A, "(44)", "3rd: coefficient of phi''", VALUE, D_SHOW, "chetaev_equations", "#2", "phi''", .printed = "-m*a*cos(phi)"},
    {A, "(44)", "2nd: df/dx'", VALUE, D_SHOW, "chetaev_equations", "#1", "=mu", .printed = "-tan(phi)"},
    {A, "(45), (47)", "minus the force along y: the program gives the reaction on the sleigh", VALUE, D_SHOW, "chetaev_equations", "F_y", "", .printed = "(k^2 - 1)/k^2*m*phi'*x'"},
    {A, "(46)", "Euler force along x", VALUE, D_SHOW, "inertial_forces", "F_x^Euler", "phi''", .printed = "m*a*sin(phi)"},
    {A, "(46)", "centrifugal force along y", VALUE, D_SHOW, "inertial_forces", "F_y^centrifugal", "", .printed = "m*a*phi'^2*sin(phi)"},
    {A, "(46)", "no Coriolis force", VALUE, D_SHOW, "inertial_forces", "F_x^Coriolis", "", .printed = "0"},
    {A, "(47)", "mu, with J = m a^2 (k^2 - 1)", VALUE, D_SHOW, "chetaev_equations", "mu", "", .printed = "-m*(k^2 - 1)/k^2*phi'*x'"},
    {A, "4.2", "dimension of the constraint symmetries of currents of degree two", VALUE, D_SYMMETRIES, "symmetry_space", "dim", "", .ours = true},
    {A, "4.2", "which currents have [Gamma,Z] in the canonical distribution", WORDS, D_SYMMETRIES, .printed = "the currents with [Gamma,Z] in the canonical distribution are the functions of Phi1, and no others: proved", .ours = true},
    {A, "4.2", "which have a field of case 1", WORDS, D_SYMMETRIES, .printed = "the currents with a field of case 1 are the functions of Phi1, and no others: proved", .ours = true},
    {A, "4.2", "dimension of the point symmetries of the equations", VALUE, D_SYMMETRIES, "equation_symmetries", "dim_point", "", .ours = true},
    {A, "4.3", "the force is not variational: 2 dF_x/dx', which Helmholtz's conditions want to be 0, is -2 (k^2 - 1)/k^2 m phi' tan(phi)", BY, D_SHOW, .by = "helmholtz", .section = "chetaev_equations", .label = "F_x"},

    {C, "(2.1)-(2.4)", "metric of the crane's eight coordinates, (3.22)", BY, D_CRANE_GEOMETRY, "chetaev_equations", "#3", .by = "crane metric"},
    {C, "section 2", "the crane's D generates all directions: but there is an integral of the constraints", WORDS, D_CRANE_ANALYSIS, .printed = "growth vector 4,5,7", .meant = "D and its brackets span 7 of 8 dimensions"},
    {C, "section 6.1", "theta' + psi1', the turning of the axle, is conserved, which the paper does not say", CURRENT, D_NONE, .label = "crane", .printed = "theta' + psi1'", .ours = true},
    {C, "(2.5)", "fields of the action: {H, J} = 0 for the momentum J of each, at p = dL/dq'", BY, D_CRANE, .by = "lifted action", .section = "momenta", .label = "J"},
    {C, "(2.6)", "momentum map: p_phi1 of the group's third generator, by (3.22)", VALUE, D_CRANE, "momenta", "J", "", .printed = "(jz3 + jx6*sin(phi2)^2 + jy6*cos(phi2)^2)*(theta' + phi1')"},
    {C, "definition 2.1", "the group: NHR1, NHR2", WORDS, D_CRANE, .printed = "Symmetry group: SE(2) x SO(2)^3, dimension 6"},
    {C, "definition 2.2, (2.7)", "Chaplygin system: NHR3", WORDS, D_CRANE, .printed = "Stage 1: Chaplygin reduction by SE(2) x SO(2)"},
    {C, "(2.8)", "A-hat: x, psi1", VALUE, D_CRANE, "1.connection", "Ahat_psi1^1", "", .printed = "-l*c*cos(psi1)/" DELTA},
    {C, "(2.8)", "A-hat: x, psi2", VALUE, D_CRANE, "1.connection", "Ahat_psi2^1", "", .printed = "-l*b*cos(psi1)/" DELTA},
    {C, "(2.8)", "A-hat: theta, psi1", VALUE, D_CRANE, "1.connection", "Ahat_psi1^4", "", .printed = "-c*sin(psi1)/" DELTA},
    {C, "(2.8)", "A-hat: theta, psi2", VALUE, D_CRANE, "1.connection", "Ahat_psi2^4", "", .printed = "-b*sin(psi1)/" DELTA},
    {C, "(2.8)", "A-hat: psi3, psi1", VALUE, D_CRANE, "1.connection", "Ahat_psi1^3", "", .printed = "-2*l*c/(b*" DELTA ")"},
    {C, "(2.8)", "A-hat: psi3, psi2", VALUE, D_CRANE, "1.connection", "Ahat_psi2^3", "", .printed = "-(l + c*sin(psi1))/" DELTA},
    {C, "(2.9)", "horizontal lift of psi1: along e_1", VALUE, D_CRANE, "1.connection", "hor(d/dpsi1)", "e_1", .printed = "l*c*cos(psi1)/" DELTA},
    {C, "(2.10), (5.30)", "H(x, p) with p = K-hat x' is the kinetic energy", BY, D_CRANE, .by = "crane hamiltonian", .section = "1.hamiltonian", .label = "Khat_psi1,psi1"},
    {C, "(2.11)", "the reduced equations as Hamilton's: x' = dH/dp, p' = -dH/dx + Upsilon x'", BY, D_CRANE, "1.stage", "p_phi1'", .by = "crane equations"},
    {C, "theorem 2.3, 5.1, (2.11)", "reduced motion against the full one", NUMBER, D_CRANE, .label = "after reconstruction: ", .of = "1"},
    {C, "(2.12)", "Upsilon_12 = F . vector with the momentum in the body frame", BY, D_CRANE, .by = "upsilon", .section = "1.gyroscopic_form", .label = "Upsilon_psi1,psi2"},
    {C, "(2.12)", "curvature: x", VALUE, D_CRANE, "1.connection", "B_psi1,psi2^1", "", .printed = "-l*b*(c - l*sin(psi1))/" DELTA "^2"},
    {C, "(2.12)", "curvature: theta", VALUE, D_CRANE, "1.connection", "B_psi1,psi2^4", "", .printed = "-l*b*cos(psi1)/" DELTA "^2"},
    {C, "(2.12)", "curvature: psi3", VALUE, D_CRANE, "1.connection", "B_psi1,psi2^3", "", .printed = "-2*l*c*cos(psi1)/" DELTA "^2"},
    {C, "(2.12)", "all other Upsilon vanish: lines of others", BY, D_CRANE, .by = "other upsilon", .section = "1.gyroscopic_form", .label = "Upsilon_psi1,psi2"},
    {C, "proposition 1, (i), (ii)", "condition (ii) for N = Q3", NUMBER, D_CRANE, .label = "in the weak form, ", .of = "2"},
    {C, "proposition 2", "the momentum is kept", NUMBER, D_CRANE, .label = "the momentum by ", .of = "2"},
    {C, "(2.13)", "the level set's form", NOT, D_NONE, .printed = "coordinate-free; in coordinates it is (2.19) and (2.20)"},
    {C, "(2.14)", "locked inertia", VALUE, D_CRANE, "2.mechanical_connection", "I_1,1", "", .printed = "jz3 + jx6*sin(phi2)^2 + jy6*cos(phi2)^2", .ours = true},
    {C, "(2.14)", "A-breve: psi1", VALUE, D_CRANE, "2.mechanical_connection", "Abreve_psi1^1", "", .printed = "c*sin(psi1)/" DELTA},
    {C, "(2.14)", "A-breve: psi2", VALUE, D_CRANE, "2.mechanical_connection", "Abreve_psi2^1", "", .printed = "b*sin(psi1)/" DELTA},
    {C, "(2.15), (2.16)", "N_theta = N", WORDS, D_CRANE, .printed = "N_theta=N: the level set is divided by the whole group"},
    {C, "lemma 2.4, alpha_theta", "momentum along psi1 on the level set", VALUE, D_CRANE, "2.level_set", "phat_psi1", "theta_1", .printed = "c*sin(psi1)/" DELTA},
    {C, "lemma 2.5", "d alpha_theta is basic: nothing in it depends on phi1, and d alpha_theta = Xi_theta along psi1, psi2", BY, D_CRANE, .by = "basic", .section = "2.magnetic_form", .label = "Xi_psi1,psi2"},
    {C, "(2.17), (2.20)", "Xi_theta", VALUE, D_CRANE, "2.magnetic_form", "Xi_psi1,psi2", "theta_1", .printed = "b*l*cos(psi1)/" DELTA "^2"},
    {C, "(2.18)", "the inverse of phi_theta: along psi2", VALUE, D_CRANE, "2.level_set", "phat_psi2", "theta_1", .printed = "b*sin(psi1)/" DELTA},
    {C, "theorem 2.6, 5.2, (2.19)", "twice reduced motion against the full one", NUMBER, D_CRANE, .label = "after reconstruction: ", .of = "2"},
    {C, "(2.11), (2.19)", "an invariant measure of the reduced crane: for no positive parameters", WORDS, D_CRANE, .printed = "none exists for positive values of the parameters (proved)", .ours = true},
    {C, "definition 3.1, (3.21), (3.22)", "metric from bodies and joints, with r_cm,3 = (l1, 0, l2/2) and r_6 = (0, 0, l2)", BY, D_CRANE_GEOMETRY, "chetaev_equations", "#7", .by = "crane metric"},
    {C, "(3.21), r_cm,3", "printed (l1, l2/2, 0), beside the column's axis, so that m3 (l2/2)^2 is added to its inertia: coefficient of phi1'' in the equation of phi1", VALUE,
        D_CRANE_GEOMETRY, "chetaev_equations", "#4", "phi1''", .printed = "-(jz3 + jx6*sin(phi2)^2 + jy6*cos(phi2)^2 + m3*(l2/2)^2)",
        .meant = "-(jz3 + jx6*sin(phi2)^2 + jy6*cos(phi2)^2)"},
    {C, "(3.23)", "potential, where g points up (minus the g of the file): T + V of the masses of a double pendulum", CURRENT, D_NONE, .label = "double_pendulum",
        .printed = "T + a*(-g)*l*cos(p) + b*(-g)*(l*cos(p) + h*cos(q))"},
    {C, "(3.24)", "Legendre map of the chain", BY, D_CRANE_GEOMETRY, "lagrangian", "p_phi2", .by = "legendre"},
    {C, "theorem 4.1", "the first joint's group", WORDS, D_CRANE, .printed = "joint of car: -y d/dx + x d/dy + d/dtheta (first joint, AP1, AP2): a symmetry of the system"},
    {C, "(4.25)-(4.29), proposition 3", "symmetries joint by joint: d/dphi1 leaves the kinetic energy invariant", WORDS, D_CRANE, .printed = "joint of column: d/dphi1 (AP2): a symmetry of the system"},
    {C, "(5.31)-(5.34)", "a non-abelian second group (Euler's top, SO(3)), by the bundle of coadjoint orbits: reduced motion against the full one", NUMBER, D_TOP, .label = "after reconstruction: ", .of = "2", .ours = true},
    {C, "figures 1, 2", "the crane and its frames", NOT, D_NONE, .printed = "drawings"},

    {B, "(1)-(4)", "reduced covariant derivative", NOT, D_NONE, .printed = "coordinate-free; in the algebra it is b of (10)"},
    {B, "(5)-(7)", "a of the chain of SE(2) x R: a(e_4, e_4)", VALUE, D_UPRIGHT, "3.chain", "a_0(e_4,e_4)", "e_1", .printed = "0"},
    {B, "lemma 2.2, (8)-(10)", "b of the chain of SE(2) x R: b(e_4, e_1)", VALUE, D_UPRIGHT, "3.chain", "b_0(e_4,e_1)", "e_2", .printed = "1"},
    {B, "proposition 2.1, (11), (12)", "bracket by two stages", BY, D_BODY, "2.chain", "b_0(e_3,e_1)", .by = "stages", .part = "bracket"},
    {B, "theorem 2.3, (13)-(15)", "bracket by several stages", BY, D_FOUR, "3.chain", "b_0(e_4,e_1)", .by = "stages", .part = "bracket"},
    {B, "theorem 2.3, n = 2", "written out", BY, D_UPRIGHT, "3.chain", "b_0(e_4,e_1)", .by = "stages", .part = "bracket"},
    {B, "theorem 2.3, n = 3", "written out: in the part of n_(1,2), three second arguments behind a minus have a bar too many", BY, D_FOUR, "3.chain", "b_0(e_4,e_2)", .by = "stages", .part = "bars"},
    {B, "theorem 2.3", "a subnormal chain of the disk's group: bracket", NUMBER, D_SUBNORMAL, .label = "differs from the bracket by ", .of = "2", .ours = true},
    {B, "theorem 2.3", "... and Euler-Poincare right-hand side", NUMBER, D_SUBNORMAL, .label = "right-hand side by ", .of = "2", .ours = true},
    {B, "theorem 2.3", "... and the disk's equations along it", NUMBER, D_SUBNORMAL, .label = "in one stage and by ", .of = "2", .ours = true},
    {B, "(16)-(19)", "Euler-Poincare equations of a rigid body", BY, D_TOP, "1.stage", "mu_1'", .by = "euler-poincare"},
    {B, "(16)-(19)", "by stages, with the full pairing", BY, D_FOUR, "3.chain", "b_0(e_4,e_1)", .by = "stages", .part = "rates"},
    {B, "(20), (21)", "Euler-Poincare equations by stages: beta_l of the blocks behind do not drop out", BY, D_FOUR, "3.chain", "b_0(e_4,e_1)", .by = "stages", .part = "own"},
    {B, "example of (21)", "SO(3) x SO(3) x R: each factor has the equations of its own", BY, D_FACTORS, "1.stage", "mu_1'", .by = "euler-poincare"},
    {B, "(22)-(25), (27)-(32)", "Euler-d'Alembert-Poincare equations by stages (a sleigh), with all blocks", NUMBER, D_BODY, .label = "in one stage and by ", .of = "2"},
    {B, "(26)", "the same in the particular case: mu_3' of the sleigh, S = <e_1> + <e_3>; what (20) drops is missing here, too", BY, D_BODY, "2.stage", "mu_3'", .by = "26 by stages"},
    {B, "(33)-(39)", "Lagrange-Poincare equations by stages (spherical pendulum)", NUMBER, D_PENDULUM, .label = "in one stage and by ", .of = "1"},
    {B, "(40), (41), vertical", "with eta - A(x)x' for eta, three blocks: beta_l of the blocks behind do not drop out", BY, D_UPRIGHT, "3.chain", "b_0(e_4,e_1)", .by = "stages", .part = "own"},
    {B, "two stages, horizontal", "A^(1,2) is missing behind eta^(0,1) in the part of n_(2,3)", BY, D_THREE, "3.chain", "b_0(e_4,e_1)", .by = "stages", .part = "horizontal"},
    {B, "section 5, particular case", "the vertical equations: likewise, four blocks", BY, D_FOUR, "3.chain", "b_0(e_4,e_2)", .by = "stages", .part = "own"},
    {B, "(40)-(43)", "Lagrange-d'Alembert-Poincare equations by stages, vertical and horizontal", NUMBER, D_DISK, .label = "in one stage and by ", .of = "2"},
    {B, "(44), (46)", "orbits of dimension 3 in 5 coordinates", WORDS, D_DISK, .printed = "Action: free, with orbits of dimension 3"},
    {B, "(45)", "constraint of the disk: x1'", VALUE, D_ROLLING, "normal_form", "x1'", "", .printed = "-r*psi'*cos(varphi)"},
    {B, "(47)", "S: along d/dx1", VALUE, D_DISK, "2.nonholonomic_connection", "chi_1", "e_2", .printed = "-r*cos(varphi)"},
    {B, "(48)", "the lift of d/dvarphi: along the group", VALUE, D_ZERO, "2.nonholonomic_connection", "hor(d/dvarphi)", "e_1", .printed = "0"},
    {B, "(48)", "... and along d/dvarphi", VALUE, D_ZERO, "2.nonholonomic_connection", "hor(d/dvarphi)", "d/dvarphi", .printed = "1"},
    {B, "(48)", "... and the curvature, which vanishes", VALUE, D_ZERO, "2.nonholonomic_connection", "B_theta,varphi^1", "", .printed = "0"},
    {B, "(48)", "the equations by stages with this connection", NUMBER, D_ZERO, .label = "in one stage and by ", .of = "2"},
    {B, "(49), (50)", "the chain", WORDS, D_DISK, .printed = "block 0 e_1; block 1 e_2 e_3."},
    {B, "reduced Lagrangian", "l of the disk", BY, D_ROLLING, .by = "disk lagrangian", .section = "free", .label = "L"},
    {B, "(51), final system, 1st", "I_3, not r I_3", BY, D_ROLLING, .section = "semispray", .label = "Gamma", .by = "disk", .part = "1"},
    {B, "(51), final system, 2nd", "along varphi", BY, D_ROLLING, .section = "semispray", .label = "Gamma", .by = "disk", .part = "2"},
    {B, "(51), final system, 3rd", "along theta", BY, D_ROLLING, .section = "semispray", .label = "Gamma", .by = "disk", .part = "3"},
    {B, "(51), last line", "eta^(1,2) = r eta^(0,1) u: u is missing (x1' of the two)", VALUE, D_ROLLING, "normal_form", "x1'", "", .printed = "r*psi'", .meant = "-r*psi'*cos(varphi)"},
    {B, "solution of (51)", "currents with the functions of theta that solve it, beside the energy", WORDS, D_DISK_CURRENTS, .printed = "3 independent currents", .ours = true},
    {B, "solution of (51)", "Phi_2, linear in varphi', psi', with Riemann's functions riemann_c(n, kappa, 3/4, cot(theta)): its rate along (51)", BY, D_DISK_CURRENTS, .by = "solves", .part = "riemann_c(", .ours = true},
    {B, "solution of (51)", "Phi_3, likewise with riemann_s: its rate along (51)", BY, D_DISK_CURRENTS, .by = "solves", .part = "riemann_s(", .ours = true},
    {B, "appendix A", "definitions 7.1-7.5, lemmas 7.4, 7.6, (52)", NOT, D_NONE, .printed = "coordinate-free calculus on associated bundles; on a slice it is the connection and its curvature (`reduce --equations`)"},
    {B, "appendix B", "definition 7.7, theorem 7.8, (53)-(57)", NOT, D_NONE, .printed = "coordinate-free form of (33)-(43), which are computed"},
};

#undef A
#undef B
#undef C

#endif

#include "document/wording.h"

/* docs/glossary.md has the same words in the same order. */
static const nh_glossary_entry entries[] = {
    {"system", "What a system file describes: coordinates, parameters, Lagrangian, forces, constraints; or bodies "
               "and joints."},
    {"constraint submanifold", "Times, positions and the velocities that the constraints allow."},
    {"velocities", "Coordinates on the fibres of the constraint submanifold: some of the coordinates' velocities, "
                   "or quasi-velocities."},
    {"chart", "Positions with one choice of velocities."},
    {"distribution", "The canonical distribution: virtual displacements that the constraints allow. [Gamma,Z] may "
                     "leave it."},
    {"constraint semispray", "Gamma, the vector field of the equations of motion on the constraint submanifold."},
    {"Gamma", "The constraint semispray; along it a function has the rate of change Gamma(f)."},
    {"bracket", "[X,Y], the field along which a function f has the rate of change X(Y(f)) - Y(X(f))."},
    {"structure constants", "C of the Lie algebra of the group that nhsym reduce divides out, with [e_a,e_b] = "
                            "-C^c_{a,b} e_c for the brackets of its fields."},
    {"equations of motion", "On the constraint submanifold: the constraints are eliminated, nothing else."},
    {"reduced equations", "The equations that remain when the group is divided out as well (nhsym reduce)."},
    {"first integral", "A function of time, coordinates and velocities that every motion keeps constant: "
                       "Gamma(Phi) = 0."},
    {"conserved quantity", "A first integral; the two mean the same."},
    {"current", "A first integral Phi, together with the field Z whose symmetry gives it: Gamma(Phi) = 0."},
    {"trivial", "Of a current: a constant on the constraint submanifold.  Its field is a multiple of Gamma."},
    {"momentum", "Of a coordinate x: dL/dx'.  Of a field of the group: the sum of its components times these "
                 "(nhsym reduce)."},
    {"constraint symmetry", "A field Z in the canonical distribution with L_Z(alpha) = 0 on it; its current is "
                            "Phi = alpha(Z)."},
    {"symmetry", "The Chetaev field Z in the canonical distribution with L_Z(alpha) = 0 on it; its current is Phi "
                 "= alpha(Z)."},
    {"case", "Z is a symmetry of the equations of motion, [Gamma,Z] = a Gamma (case 1); [Gamma,Z] = a Gamma + b Z "
             "(case 2); neither (case 3)."},
    {"projectable", "The components of Z along time and coordinates do not depend on velocities.  Whether Z is a "
                    "symmetry of the equations of motion is another question."},
    {"space of symmetries", "Constraint symmetries are linear in their currents; those that are projectable, of case "
                            "1, or have [Gamma,Z] in the "
                            "canonical distribution form subspaces (--equations)."},
    {"symmetry of the equations", "A field S with [Gamma,S] = a Gamma: a point symmetry acts on time and positions, a "
                                  "dynamical one has components that "
                                  "depend on velocities (--equations)."},
    {"closure", "The fields Gamma, U_1, .. with all their brackets.  What it leaves constant are the currents with "
                "[Gamma,Z] in the canonical "
                "distribution; its rank bounds their number (--equations)."},
    {"multiplier", "Chetaev's multiplier mu_a, one for each constraint: dL/dq - (dL/dv)' = mu_a df^a/dv, so the force "
                   "that keeps constraint a is minus mu_a times its derivatives by the velocities."},
    {"reaction", "The force of the constraints along each coordinate: minus the sum over the constraints a of mu_a "
                 "times the derivative of constraint a by the velocity of the coordinate."},
    {"mu", "mu_a: Chetaev's multiplier of constraint a; in nhsym reduce the momentum of the group along its "
           "field e_a, in the body frame."},
    {"degree", "Of a polynomial in the velocities, whatever its coefficients are."},
    {"local", "The current, field or density changes when an angle goes once around: it is defined on a part of "
              "the configuration space only."},
    {"region", "Where a current holds that jumps, or ends, where motions cross a kink or a cut of |x|, sqrt(x^2), "
               "atan2, ...  Such a current is not counted."},
    {"independent", "Its gradient is not a combination of the gradients of the currents before it."},
    {"holonomic", "A constraint between positions, as it was given."},
    {"integrable", "The velocity constraints are integrable: as many functions of time and positions stay "
                   "constant."},
    {"partly", "Partly integrable: some combinations of the constraints hold a function of time and positions "
               "constant, others do not."},
    {"nonholonomic", "No function of time and positions is held constant by the constraints: every place can be "
                     "reached."},
    {"semiholonomic", "eps'_l(g) = 0 for a constraint that is linear or affine in the velocities: it is "
                      "integrable.  Not defined for nonlinear constraints."},
    {"hidden", "Hidden holonomic constraints: functions that the constraints alone keep constant, found by "
               "brackets of the allowed directions."},
    {"growth", "Growth vector: the ranks of D, D + [D,D], ..., where D are the allowed directions."},
    {"group", "The symmetries that leave kinetic energy, potential and constraints invariant: fields on "
              "configuration space (nhsym reduce)."},
    {"algebra", "The infinitesimal form of a group: its fields and their brackets."},
    {"generator", "One basis element of the algebra of a group."},
    {"zeta", "zeta_a: velocity of the group along its field e_a, in the body frame (nhsym reduce)."},
    {"shape", "Coordinates on a slice through the orbits of a group; the reduced equations are written in them."},
    {"stage of a reduction", "The division by one group: Chaplygin's, a second one by further symmetry, or by the "
                             "whole group at once (Lagrange-d'Alembert-Poincare)."},
    {"Chaplygin", "A system whose group's orbits and constraint distribution are complementary: together they "
                  "span every direction and share none.  It reduces to the shape space."},
    {"density", "Of a measure that the motions leave invariant."},
    {"question", "What a user wants to know: system, settings, initial state, limits."},
    {"problem", "A question whose files have been read."},
    {"analysis file", "An ansatz, unknowns and figures for one system, as text."},
    {"ansatz", "The functions that a fit combines into currents."},
    {"family", "A group of functions of an ansatz, such as the polynomials up to a degree."},
    {"column", "One function of an ansatz: one column of the matrix of the fit."},
    {"pencil", "A matrix that depends on one unknown as a polynomial.  Where its rank falls lie the "
               "frequencies of an ansatz, or special values of a parameter (nhsym classify)."},
    {"stage of a search", "One ansatz among those that the program tries one after another."},
    {"verdict", "How an analysis answers: FOUND, NONE or UNDECIDED."},
    {"FOUND", "Currents were found and each is proved, or certified to at least 50 digits."},
    {"NONE", "No combination of the ansatz is conserved: every generalized singular value is far above rounding, "
             "and nothing was left out."},
    {"UNDECIDED", "Values between rounding and significance: take more samples or another ansatz; a current is "
                  "given with its digits."},
    {"search", "What tries one ansatz after another; it ends complete, exhausted or cut."},
    {"complete",
     "Of a search: as many independent currents are found as can exist locally, so that there cannot be more.  "
     "\"Complete to degree 4\" says that no integral polynomial in the velocities of degree at most 4 is missing: "
     "nhsym explain completeness."},
    {"exhausted", "A search that tried all that there was to try, but for stages that are too large: the list of "
                  "stages names the option that brings them in.  There may be currents of another kind."},
    {"cut", "A search that a limit of work or time ended before all was tried (exit code 5)."},
    {"further integral",
     "Polynomial in the velocities and a function of the currents found, so that it is not counted.  The products of "
     "the currents do not give it; without it the list of integrals of its degree would not be complete."},
    {"completeness",
     "Every integral that is polynomial in the velocities up to a degree, whatever functions its "
     "coefficients are, is a polynomial in the currents found.  It is proved by counting: an upper bound (power "
     "series modulo a prime) and a lower one (products of the currents) agree.  Integrals of other kinds, and "
     "those of higher degree, are not excluded.  Equations that are defined piece by piece are counted where the "
     "domain lies, and the report says where."},
    {"proved", "The rate of change is zero as an exact expression."},
    {"certified", "The rate of change is zero to at least 50 digits in ball arithmetic."},
    {"residual", "The rate of change of a current at points that were not used to find it, relative to the size "
                 "of its terms: rounding is near 10^-16."},
    {"gap", "The smallest nonzero singular value over the largest vanishing one.  Below 1000 nothing is decided."},
    {"formulation", "The equations that an integrator solves: on the constraint submanifold, or in all "
                    "coordinates with multipliers."},
    {"integration plan", "A method with its tolerance or step, and the velocities that it is used in."},
    {"closed subsystem", "The states on which the wanted quantities depend; only these are integrated."},
    {"observable", "A quantity that is followed along a motion."},
    {"safeguard", "What ends or flags a motion near a singular place."},
    {"validation", "A current followed along computed motions."},
    {"drift", "The largest change of a current along a computed motion, relative to the size of its terms."},
    {"benchmark", "Integrators compared on one motion: error against cost (nhsym benchmark)."},
    {"robustness map", "Where in a plane of parameters integrators are accurate, flagged, detected or undetected "
                       "(nhsym benchmark --robustness)."},
    {"accurate", "Of a measured motion: the error is as small as expected for its tolerance or step, and no "
                 "safeguard triggered.  In JSON: right."},
    {"flagged", "Accurate, and a safeguard triggered: the pivot of the chart; in maps also the drift of a "
                "current, or a run at a tenth of the tolerance.  In JSON: warned."},
    {"detected", "Not accurate, or ended early, and a safeguard says so.  In JSON: caught."},
    {"undetected", "Not accurate, and no safeguard triggered.  What counts as accurate: options benchmark_error, "
                   "benchmark_far and benchmark_fixed.  In JSON: wrong."},
    {"timeout", "A motion that was ended because it took too long, or too many steps."},
    {"scan", "Numbers of a system at every point of a grid of parameter values, and where they jump (nhsym scan)."},
    {"special value", "A value of a parameter at which there is more than for almost all values beside it."},
    {"unit", "Points of a scan that are computed one after another; its file is written completely or not at all."},
    {"work", "Operations counted in units that do not depend on the machine."},
};

size_t nh_glossary_count(void) { return sizeof entries / sizeof *entries; }
nh_glossary_entry nh_glossary_at(size_t i) { return entries[i]; }

static const nh_glossary_entry functions[] = {
    {"legendre_p(n, x)", "Legendre's function P_n of degree n"},
    {"legendre_q(n, x)", "Legendre's function Q_n, on -1 < x < 1 or x > 1"},
    {"hyp2f1(a, b, c, x)", "Gauss's hypergeometric function 2F1(a, b; c; x)"},
    {"gauss_f(s, p, c, x)", "the same by the sum s = a + b and the product p = a b: real where a and b are conjugate"},
    {"riemann_c(a, b, c, x)", "y with (1 + x^2)^2 y'' = (a + b x + c x^2) y, y(0) = 1, y'(0) = 0: "
                              "Riemann's equation, singular at i, -i and infinity; by 2F1 of (1 + i x)/2"},
    {"riemann_s(a, b, c, x)", "the same with y(0) = 0, y'(0) = 1"},
    {"hyp1f1(a, b, x)", "Kummer's confluent function M(a, b, x) = 1F1(a; b; x)"},
    {"hyperu(a, b, x)", "Tricomi's confluent function U(a, b, x)"},
    {"bessel_j(n, x)", "Bessel's function J_n, n any real number"},
    {"bessel_y(n, x)", "Bessel's function Y_n, x > 0"},
    {"bessel_i(n, x)", "the modified function I_n"},
    {"bessel_k(n, x)", "the modified function K_n, x > 0"},
    {"airy_ai(x)", "Airy's function Ai"},
    {"airy_bi(x)", "Airy's function Bi"},
    {"elliptic_k(m)", "complete elliptic integral of the first kind, m = k^2"},
    {"elliptic_e(m)", "complete elliptic integral of the second kind"},
    {"elliptic_f(u, m)", "incomplete elliptic integral of the first kind, of the angle u"},
    {"elliptic_einc(u, m)", "incomplete elliptic integral of the second kind"},
    {"elliptic_pi(n, u, m)", "incomplete elliptic integral of the third kind, with 1 - n sin(u)^2 below"},
};

size_t nh_glossary_functions(void) { return sizeof functions / sizeof *functions; }
nh_glossary_entry nh_glossary_function_at(size_t i) { return functions[i]; }

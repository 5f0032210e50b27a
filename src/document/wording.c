#include "document/wording.h"

/* docs/glossary.md has the same words in the same order. */
static const nh_glossary_entry entries[] = {
    {"system", "What a system file describes: coordinates, parameters, Lagrangian, forces and constraints, or "
               "bodies and joints."},
    {"constraint submanifold",
     "All states (t, q, v) that satisfy the constraints: times, positions, and the velocities that the "
     "constraints allow."},
    {"velocities", "The independent velocities that describe a motion: some of the coordinates' velocities, or "
                   "quasi-velocities."},
    {"quasi-velocity",
     "A combination of the coordinates' velocities that is used as an independent velocity, such as the "
     "speed along a blade."},
    {"chart", "A choice of independent velocities. Another choice may be needed where one breaks down, as y' = "
              "x'*tan(phi) does at cos(phi) = 0."},
    {"distribution", "The canonical distribution: the virtual displacements that the constraints allow. [Gamma,Z] need "
                     "not lie in it."},
    {"constraint semispray",
     "The vector field Gamma of the equations of motion, on the states that satisfy the constraints."},
    {"Gamma", "The vector field of the equations of motion. A function f changes along motions at the rate "
              "Gamma(f)."},
    {"bracket", "The bracket [X,Y] of two vector fields. A function f changes along it at the rate X(Y(f)) - Y(X(f))."},
    {"structure constants",
     "The numbers C that define the group which nhsym reduce divides out: [e_a,e_b] = -C^c_{a,b} e_c for "
     "the brackets of its fields."},
    {"equations of motion",
     "The equations for the independent velocities: the constraints are eliminated, and nothing else."},
    {"reduced equations", "The equations that remain after the group is divided out (nhsym reduce)."},
    {"first integral",
     "A function of time, coordinates and velocities that stays constant along every motion: Gamma(Phi) = "
     "0."},
    {"conserved quantity", "The same as a first integral."},
    {"current", "A first integral Phi together with the field Z, the symmetry that gives it."},
    {"E", "The energy v dL/dv - L. It is conserved where neither the Lagrangian nor the constraints depend on time and "
          "no other force does work."},
    {"trivial", "A current is trivial if it is the same number at all states. Its field is a multiple of Gamma."},
    {"momentum", "The momentum of a coordinate x is dL/dx'. The momentum of a field of the group is the sum of its "
                 "components times these (nhsym reduce)."},
    {"angular momentum", "The conserved quantity of a rotation; the momentum of an angle."},
    {"Laplace-Runge-Lenz vector",
     "In the potential -k/r the vector A = p x (q x p)/m - k q/r is conserved. It points to the "
     "pericentre, and its length is k times the eccentricity."},
    {"Fradkin's tensor",
     "In the potential k r^2/2 the tensor T_ij = m v_i v_j + k x_i x_j is conserved. Its principal axes "
     "are those of the ellipse."},
    {"constraint symmetry",
     "A field Z in the canonical distribution with L_Z(alpha) = 0 on it. Its current is Phi = alpha(Z)."},
    {"symmetry", "A change that maps motions to motions, such as a shift in time, a shift or a rotation. Here it is "
                 "the Chetaev field Z in the canonical distribution with L_Z(alpha) = 0 on it; its current is Phi = "
                 "alpha(Z)."},
    {"Noether", "Noether's theorem: each symmetry of the action gives a conserved quantity. A shift in time gives "
                "the energy, a shift the momentum, a rotation the angular momentum."},
    {"Z", "The field whose symmetry gives a current."},
    {"boost", "The change to a frame that moves evenly: x to x + c t."},
    {"case", "How Z relates to the equations of motion. Case 1: [Gamma,Z] = a Gamma, so that Z is a symmetry of "
             "them. Case 2: [Gamma,Z] = a Gamma + b Z. Case 3: neither."},
    {"projectable", "Z is projectable if its components along time and coordinates do not depend on velocities. This "
                    "does not decide whether Z is a symmetry of the equations of motion."},
    {"space of symmetries",
     "Sums of constraint symmetries are constraint symmetries, because a symmetry depends linearly on its "
     "current. Those that are projectable, of case 1, or have [Gamma,Z] in the canonical distribution "
     "form subspaces (--equations)."},
    {"symmetry of the equations",
     "A field S with [Gamma,S] = a Gamma. A point symmetry acts on time and positions; the components of "
     "a dynamical one depend on velocities (--equations)."},
    {"closure", "The fields Gamma, U_1, .. with all their brackets. The functions that all of them keep constant are "
                "the currents with [Gamma,Z] in the canonical distribution; its rank bounds their number "
                "(--equations)."},
    {"multiplier", "Chetaev's multiplier mu_a of constraint a: dL/dq - (dL/dv)' = mu_a df^a/dv. The force that keeps "
                   "constraint a is minus mu_a times the derivatives of f^a by the velocities."},
    {"reaction", "The force of the constraints along each coordinate: minus the sum over the constraints a of mu_a "
                 "times the derivative of constraint a by the velocity of the coordinate."},
    {"mu", "Chetaev's multiplier mu_a of constraint a. In nhsym reduce it is the momentum of the group along "
           "its field e_a, in the body frame."},
    {"degree", "The highest power of the velocities in a polynomial, whatever its coefficients are."},
    {"local", "A current, field or density is local if it changes when an angle makes a full turn. It is defined "
              "on a part of the configuration space."},
    {"region", "The part of the states in which a current holds that jumps or ends, because motions cross a kink or "
               "a cut of |x|, sqrt(x^2), atan2, ... Such a current is not counted."},
    {"independent", "A current is independent of others if it is not a function of them: its gradient is not a "
                    "combination of theirs."},
    {"holonomic", "A constraint between positions, as it was given."},
    {"integrable", "The velocity constraints are integrable if each follows from a function of time and positions that "
                   "stays constant."},
    {"partly", "The constraints are partly integrable if some of their combinations keep a function of time and "
               "positions constant, and others do not."},
    {"nonholonomic", "The constraints are nonholonomic if they keep no function of time and positions constant: every "
                     "place can be reached."},
    {"semiholonomic",
     "A constraint that is linear or affine in the velocities is semiholonomic if eps'_l(g) = 0: it is "
     "integrable. This is not defined for nonlinear constraints."},
    {"hidden", "Hidden holonomic constraints are functions of time and positions that the constraints alone keep "
               "constant. They are found by brackets of the allowed directions."},
    {"growth", "The growth vector has the ranks of D, D + [D,D], ..., where D are the allowed directions."},
    {"group", "The symmetries that leave kinetic energy, potential and constraints unchanged: fields on "
              "configuration space (nhsym reduce)."},
    {"algebra", "The infinitesimal form of a group: its fields and their brackets."},
    {"generator", "One of the basis fields of the algebra of a group."},
    {"zeta", "The velocity zeta_a of the group along its field e_a, in the body frame (nhsym reduce)."},
    {"shape", "Coordinates on a slice that crosses the orbits of a group. The reduced equations are written in "
              "them."},
    {"slice", "The places at which the coordinates of a group have fixed values. The reduced equations are written "
              "there; a coordinate x that the group moves is called x_s on it (nhsym reduce)."},
    {"Hamilton's form",
     "The reduced equations with momenta as variables: x' = dH/dp, p' = -dH/dx + Upsilon x'. Upsilon "
     "vanishes where the equations are Hamiltonian in these variables (nhsym reduce --details)."},
    {"Helmholtz's conditions",
     "The conditions under which the force Upsilon x' of Hamilton's form comes from a Lagrangian (nhsym "
     "reduce --details)."},
    {"locked inertia",
     "The kinetic energy of the velocities of a group: I_ab = K(e_a,e_b) for its fields (nhsym reduce "
     "--details)."},
    {"stage of a reduction",
     "The division by one group: Chaplygin's, a second one by further symmetry, or the division by the "
     "whole group at once (Lagrange-d'Alembert-Poincare)."},
    {"Chaplygin", "In a Chaplygin system every velocity splits uniquely into an allowed one and one of a group motion. "
                  "It reduces to the shape space."},
    {"density", "The density exp(sigma) of a volume that the motions preserve (an invariant measure)."},
    {"question", "What a user wants to know: system, settings, initial state, limits."},
    {"problem", "A question whose files have been read."},
    {"analysis file", "A text file with an ansatz, unknowns and figures for one system."},
    {"ansatz", "The functions that a fit combines into currents."},
    {"family", "A group of functions of an ansatz, such as the polynomials up to a degree."},
    {"column", "One function of an ansatz: one column of the matrix of the fit."},
    {"sample grid",
     "The points of the constraint submanifold at which the equations are compared: Sobol or Halton points, "
     "products of nodes (tensor, sparse), states along motions, or those of a file (--grid)."},
    {"table", "A file of values that the system file makes a smooth function (key tables). It has no formula."},
    {"pencil", "A matrix whose entries are polynomials in one unknown. The unknown has the frequencies of an "
               "ansatz, or special values of a parameter (nhsym classify), where the rank of the matrix falls."},
    {"stage of a search", "One ansatz of the sequence that the program tries."},
    {"verdict", "The answer of an analysis: FOUND, FITTED, NONE or UNDECIDED."},
    {"FOUND", "Currents were found, and each is proved, or certified to at least 50 digits."},
    {"FITTED",
     "Currents were found of a system whose equations contain tables of values: a table has no formula, so they "
     "are not proved, but hold at points that the fit has not seen as far as is said."},
    {"NONE", "No combination of the ansatz is conserved: every generalized singular value is far above rounding, "
             "and nothing was left out."},
    {"UNDECIDED", "Some singular values lie between rounding and significance: more samples or another ansatz may "
                  "decide. A current is given with its digits."},
    {"search", "The search tries a sequence of ansatz spaces. It ends complete, exhausted, or cut off by a limit."},
    {"complete", "A search is complete if as many independent currents are found as can exist locally. \"Complete to "
                 "degree 4\" says that no integral polynomial in the velocities of degree at most 4 is missing: nhsym "
                 "explain completeness."},
    {"exhausted", "A search is exhausted if every stage was tried except those larger than the limits; the list of "
                  "stages names the option that includes them. Currents of another kind may exist."},
    {"cut", "A limit of work or time ended the search before all was tried (exit code 5)."},
    {"further integral",
     "A polynomial in the velocities that is a function of the currents found, so that it is not counted. "
     "Products of the currents do not give it; without it the list of integrals of its degree would not "
     "be complete."},
    {"completeness",
     "Every integral that is polynomial in the velocities up to a degree, whatever functions its "
     "coefficients are, is a polynomial in the currents found. It is proved by counting: an upper bound "
     "(power series modulo a prime) and a lower one (products of the currents) agree. Integrals of other "
     "kinds, and those of higher degree, are not excluded. Equations that are defined piece by piece are "
     "counted where the domain lies, and the report says where."},
    {"no other integral",
     "The theorem that every first integral of a class is a function of those found. A particular motion, in complex "
     "time, is surrounded by a linear equation; if its Galois group or its monodromy moves a general vector in all "
     "directions, there is no room for another integral that is meromorphic near this motion (--absence)."},
    {"meromorphic",
     "A function is meromorphic if it is, near each complex state, a quotient of two power series: poles are allowed, "
     "logarithms, irrational powers and essential singularities are not. It is single-valued."},
    {"invariant plane",
     "States with x = 0, theta = pi/2 and such, which motions do not leave, and on which one coordinate moves alone. "
     "Along such motions the linear equations for others near by are simple."},
    {"normal variational equation", "The linear equation for the motions next to a particular one, without the "
                                    "direction along it and without those that known integrals hold."},
    {"Galois group", "The group of all linear maps of the solutions of a linear differential equation that keep all "
                     "algebraic relations between them and their derivatives. Where all singular points are regular it "
                     "is the closure of the monodromy: what loops of complex time do to solutions. SL(2): all 2 x 2 "
                     "matrices of determinant 1; such an equation has no solution in closed form."},
    {"proved", "The rate of change is zero as an exact expression."},
    {"certified", "The rate of change is zero to at least 50 digits in ball arithmetic."},
    {"residual", "The rate of change of a current at points that were not used to find it, relative to the size of "
                 "its terms. Rounding gives about 10^-16."},
    {"gap", "The smallest nonzero singular value divided by the largest vanishing one. Below 1000 nothing is "
            "decided."},
    {"null value", "A singular value that is zero up to rounding. Each belongs to a combination of the columns that is "
                   "conserved."},
    {"formulation", "The equations that an integrator solves: those in independent velocities, or those in all "
                    "coordinates with multipliers."},
    {"integration plan", "A method with its tolerance or step, and the velocities in which it is used."},
    {"closed subsystem", "The states on which the wanted quantities depend. Only these are integrated."},
    {"observable", "A quantity that is followed along a motion."},
    {"safeguard", "A check that ends or flags a motion near a singular place."},
    {"validation", "The check of a current along computed motions."},
    {"drift", "The largest change of a current along a computed motion, relative to the size of its terms."},
    {"benchmark", "A comparison of integrators on one motion: error against cost (nhsym benchmark)."},
    {"robustness map", "A map of a plane of parameters that shows where integrators are accurate, flagged, detected or "
                       "undetected (nhsym benchmark --robustness)."},
    {"accurate", "A measured motion is accurate if its error is as small as expected for its tolerance or step, and "
                 "no safeguard triggered. In JSON: right."},
    {"flagged", "Accurate, but a safeguard triggered: the pivot of the chart; in maps also the drift of a current, "
                "or a run at a tenth of the tolerance. In JSON: warned."},
    {"detected", "Not accurate, or ended early, and a safeguard says so. In JSON: caught."},
    {"undetected", "Not accurate, and no safeguard triggered. The options benchmark_error, benchmark_far and "
                   "benchmark_fixed say what counts as accurate. In JSON: wrong."},
    {"timeout", "A motion that was begun and ended because it took too long, or too many steps."},
    {"not run", "A motion that was never begun: the method refuses the system, or the budget was used up."},
    {"scan", "Numbers of a system at every point of a grid of parameter values, and the values where they jump "
             "(nhsym scan)."},
    {"special value", "A value of a parameter for which there is more than for almost all values near it."},
    {"unit", "Points of a scan that are computed one after another. Its file is written completely or not at all."},
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

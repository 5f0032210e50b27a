#include "report/glossary.h"

static const nh_glossary_entry entries[] = {
    {"current", "A function Phi of time, coordinates and velocities that stays constant along every motion: Gamma(Phi) = 0."},
    {"symmetry", "The Chetaev field Z in the canonical distribution with L_Z(alpha) = 0 on it; its current is Phi = alpha(Z)."},
    {"case", "1: [Gamma,Z] = a Gamma, Z is also a symmetry of the equations of motion.  2: [Gamma,Z] = a Gamma + b Z.  3: neither."},
    {"distribution", "The canonical distribution: virtual displacements that the constraints allow. [Gamma,Z] may leave it."},
    {"FOUND", "Currents were found and each is proved, or certified to at least 50 digits."},
    {"NONE", "No combination of the ansatz is conserved: every generalized singular value is far above rounding."},
    {"UNDECIDED", "Values between rounding and significance: take more samples or another ansatz; a current is given with its digits."},
    {"multiplier", "Chetaev's multiplier mu_a: the force that keeps constraint a is mu_a times its derivatives by the velocities."},
    {"residual", "The rate of change of a current at points that were not used to find it, relative to the size of its terms: rounding is near 1e-16."},
    {"gap", "The ratio of the first singular value that is not null to the last that is.  Below 1000 nothing is decided."},
    {"drift", "The largest change of a current along a computed motion, relative to the size of its terms."},
    {"local", "The current changes when an angle goes once around: it is defined on a part of the configuration space only."},
    {"independent", "Its gradient is not a combination of the gradients of the currents before it."},
    {"group", "The symmetries that leave kinetic energy, potential and constraints invariant: fields on configuration space (nhsym reduce)."},
    {"Chaplygin", "A system whose group's orbits and constraint distribution are complementary: V + D = TQ, V cap D = 0.  It reduces to the shape space."},
    {"shape", "Coordinates of a slice through the orbits of a group; the reduced equations are written in them."},
    {"stage", "A reduction by a group: Chaplygin's, a second one by further symmetry, or the whole group at once (Lagrange-d'Alembert-Poincare)."},
    {"holonomic", "A constraint between positions, as it was given."},
    {"integrable", "The constraints on velocities say no more than that as many functions of time and positions stay constant."},
    {"partly", "Partly integrable: some combinations of the constraints hold a function of time and positions constant, others do not."},
    {"nonholonomic", "No function of time and positions is held constant by the constraints: every place can be reached."},
    {"hidden", "Hidden holonomic constraints: functions that the constraints alone keep constant, found by brackets of the allowed directions."},
    {"growth", "Growth vector: the dimensions that the allowed directions, their brackets, the brackets with those, ... fill."},
    {"right", "A measured integration (nhsym chart) whose error its tolerance or step lets expect, and no guard complains."},
    {"warned", "Right, but a guard complains: the pivot of the chart, and in maps the drift of a current or a run at a tenth of the tolerance."},
    {"caught", "It failed, or its error is larger than may be expected, and a guard says so."},
    {"wrong", "It ended without complaint, and its error is larger than may be expected: options chart_wrong, chart_far and chart_fixed."},
    {"timeout", "An integration that was given up because it took too long."},
    {"semiholonomic", "eps'_l(g) = 0 for a constraint that is linear or affine in the velocities: it is integrable.  Not defined for nonlinear constraints."},
    {"projectable", "The components of Z along time and coordinates do not depend on velocities.  Whether Z is a symmetry of the equations of motion is another question."},
};

size_t nh_glossary_count(void) { return sizeof entries / sizeof *entries; }
nh_glossary_entry nh_glossary_at(size_t i) { return entries[i]; }

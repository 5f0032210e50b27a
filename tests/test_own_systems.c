/* own_systems: ten systems of our own, outside of the catalogue, against motions and integrals by hand, through the public
 * interface alone.  An integral that the program misses today is marked so: then it must not be there. */
#include <criterion/criterion.h>

#include <cjson/cJSON.h>
#include <float.h>
#include <nhsym.h>
#include <stdio.h>
#include <string.h>

#include "own_bodies.h"
#include "own_points.h"
#include "sweep.h"

/* clang-format off */
static const own_system OWN[] = {
    {"floating_chain",
     "name: floating_chain\n"
     "title: Three point masses on two massless rods, afloat in the plane\n"
     "parameters: {m1: 1.2, m2: 0.7, m3: 0.9, l1: 0.8, l2: 0.6}\n"
     "bodies:\n"
     "  - {name: first, mass: m1}\n"
     "  - {name: second, mass: m2, center: [l1, 0, 0]}\n"
     "  - {name: third, mass: m3, center: [l2, 0, 0]}\n"
     "joints:\n"
     "  - {type: planar, child: first, coordinates: [x, y, a]}\n"
     "  - {type: fixed, parent: first, child: second}\n"
     "  - {type: revolute, parent: second, child: third, at: [l1, 0, 0], coordinates: [b]}\n",
     "x y a b", 8, afloat_rates, afloat_place,
     {0.3, -0.2, 0.5, 0.9, 0.4, -0.3, 1.1, -0.7},
     {0, 0, 0, 0, 0.3, 0, 0, 0.8},
     {{"momentum along x", afloat_px, false},
      {"momentum along y", afloat_py, false},
      {"centre along x", afloat_x, false},
      {"centre along y", afloat_y, false},
      {"angular momentum", afloat_turning, false},
      {"energy", afloat_energy, false}}, true},
    {"slope_chain",
     "name: slope_chain\n"
     "title: Bead on an inclined rail with two masses hung from it\n"
     "parameters: {m1: 1.5, m2: 0.8, m3: 0.5, l1: 0.7, l2: 0.4, g: 9.81, slope: 0.3}\n"
     "coordinates:\n"
     "  - {name: s, type: length, doc: \"along the rail, downhill\"}\n"
     "  - {name: a, type: angle, doc: of the upper rod from the normal of the rail}\n"
     "  - {name: b, type: angle}\n"
     "definitions:\n"
     "  - x2 = s + l1*sin(a)\n"
     "  - z2 = -l1*cos(a)\n"
     "  - x3 = x2 + l2*sin(b)\n"
     "  - z3 = z2 - l2*cos(b)\n"
     "lagrangian: m1/2*s'^2 + m2/2*(x2'^2 + z2'^2) + m3/2*(x3'^2 + z3'^2) + g*sin(slope)*(m1*s + m2*x2 +"
     " m3*x3) - g*cos(slope)*(m2*z2 + m3*z3)\n",
     "s a b", 6, rail_rates, rail_place,
     {0.2, 0.4, -0.3, 0.5, 0.6, -0.8},
     {0, 0, 0, 0, 0, 0},
     {{"energy", rail_energy, false},
      {"momentum along the rail", rail_momentum, false},
      {"centre of mass", rail_centre, false}}, false},
    {"suslov_rotor",
     "name: suslov_rotor\n"
     "title: Suslov's body with a free rotor\n"
     "parameters: {A: 1.4, B: 1.1, C: 0.9, D: 0.2, F: 0.15, J: 0.3}\n"
     "coordinates:\n"
     "  - {name: phi, type: angle}\n"
     "  - {name: theta, type: angle}\n"
     "  - {name: psi, type: angle}\n"
     "  - {name: u, type: angle, doc: of the rotor}\n"
     "definitions:\n"
     "  - W1 = phi'*sin(theta)*sin(psi) + theta'*cos(psi)\n"
     "  - W2 = phi'*sin(theta)*cos(psi) - theta'*sin(psi)\n"
     "  - W3 = phi'*cos(theta) + psi'\n"
     "lagrangian: (A*W1^2 + B*W2^2 + C*W3^2)/2 + D*W1*W3 + F*W2*W3 + J*W1*u' + J*u'^2/2\n"
     "constraints: [W3 = 0]\n"
     "velocities:\n"
     "  names: [w1, w2, s]\n"
     "  map:\n"
     "    - theta' = w1*cos(psi) - w2*sin(psi)\n"
     "    - phi' = (w1*sin(psi) + w2*cos(psi))/sin(theta)\n"
     "    - psi' = -(w1*sin(psi) + w2*cos(psi))*cos(theta)/sin(theta)\n"
     "    - u' = s\n"
     "domain: {theta: [0.5, 2.4]}\n",
     "phi theta psi u", 7, suslov_rates, suslov_place,
     {0.3, 1.1, 0.4, 0.2, 0.7, -0.5, 0.9},
     {0, 1, 0, 0, 0, 0, 2},
     {{"momentum of the rotor", suslov_rotor, false},
      {"energy", suslov_energy, false},
      {"time of the turn", suslov_time, false},
      {"angle of the rotor", suslov_angle, true}}, true},
    {"veselova_rotor",
     "name: veselova_rotor\n"
     "title: Veselova's body with a free rotor\n"
     "parameters: {A: 1.1, B: 1.7, C: 2.3, J: 0.4}\n"
     "coordinates:\n"
     "  - {name: phi, type: angle}\n"
     "  - {name: theta, type: angle}\n"
     "  - {name: psi, type: angle}\n"
     "  - {name: u, type: angle, doc: of the rotor}\n"
     "definitions:\n"
     "  - w1 = phi'*sin(theta)*sin(psi) + theta'*cos(psi)\n"
     "  - w2 = phi'*sin(theta)*cos(psi) - theta'*sin(psi)\n"
     "  - w3 = phi'*cos(theta) + psi'\n"
     "lagrangian: (A*w1^2 + B*w2^2 + C*w3^2 + J*(w3 + u')^2)/2\n"
     "constraints: [phi' + psi'*cos(theta) = 0]\n"
     "domain: {theta: [0.5, 1.3]}\n",
     "phi theta psi u", 7, veselova_rates, veselova_place,
     {0.3, 0.9, 0.4, 0.2, 0.5, 0.8, 0.6},
     {0, 1, 0, 0, 0, 0, 2},
     {{"momentum of the rotor", veselova_rotor, false},
      {"energy", veselova_energy, false},
      {"momentum along x", veselova_mx, false},
      {"momentum along y", veselova_my, false}}, true},
    {"gyrostat",
     "name: gyrostat\n"
     "title: Gyrostat with two free rotors\n"
     "parameters: {A: 1.1, B: 1.6, C: 2.1, J: 0.3, K: 0.4}\n"
     "bodies:\n"
     "  - {name: carrier, inertia: [A, B, C]}\n"
     "  - {name: rotor1, inertia: [J, 0, 0]}\n"
     "  - {name: rotor3, inertia: [0, 0, K]}\n"
     "joints:\n"
     "  - {type: spherical, child: carrier, angles: zxz, coordinates: [phi, theta, psi]}\n"
     "  - {type: revolute, parent: carrier, child: rotor1, axis: x, coordinates: [u]}\n"
     "  - {type: revolute, parent: carrier, child: rotor3, axis: z, coordinates: [s]}\n",
     "phi theta psi u s", 10, gyrostat_rates, gyrostat_place,
     {0.3, 0.9, 0.4, 0.2, -0.3, 0.5, 0.8, -0.4, 0.6, 1.2},
     {0, 1.2, 0, 0, 0, 0, 0, 1, 0, 0},
     {{"momentum along x", gyrostat_mx, false},
      {"momentum along y", gyrostat_my, false},
      {"momentum along z", gyrostat_mz, false},
      {"rate of the first rotor", gyrostat_rotor1, false},
      {"rate of the third rotor", gyrostat_rotor3, false},
      {"square of the momentum", gyrostat_square, false},
      {"energy", gyrostat_energy, false}}, true},
    {"skate_spring_table",
     "name: tied_skate\n"
     "title: Skate on a turning table, tied to its axle by a spring\n"
     "parameters: {m: 1.3, J: 0.4, W: 0.6, k: 2.1}\n"
     "coordinates:\n"
     "  - {name: x, type: length}\n"
     "  - {name: y, type: length}\n"
     "  - {name: h, type: angle, doc: heading}\n"
     "lagrangian: m/2*(x'^2 + y'^2) + J/2*h'^2 - k/2*(x^2 + y^2)\n"
     "constraints:\n"
     "  - (x' + W*y)*sin(h) = (y' - W*x)*cos(h)\n",
     "x y h", 5, skate_rates, skate_place,
     {0.4, -0.3, 0.5, 0.7, 0.9},
     {1, 0, 0, 0, 0},
     {{"turn", skate_turn, false},
      {"heading", skate_heading, false},
      {"moving energy", skate_energy, false},
      {"across", skate_across, false},
      {"phase", skate_phase, false}}, true},
    {"isokinetic",
     "name: isokinetic\n"
     "title: Particle of constant speed that a charged line attracts\n"
     "parameters: {m: 1.3, c: 1.2, k: 0.7}\n"
     "coordinates:\n"
     "  - {name: x, type: length}\n"
     "  - {name: y, type: length}\n"
     "lagrangian: m/2*(x'^2 + y'^2) - k/2*log(x^2 + y^2)\n"
     "constraints: [\"x'^2 + y'^2 = c^2\"]\n"
     "domain: {x: [0.6, 1.4], y: [0.2, 1], x': [0.3, 1], y': [0.3, 1.1]}\n",
     "x y", 3, steady_rates, steady_place,
     {0.9, 0.5, 0.8},
     {1, 0, 0},
     {{"angular momentum over a power of r", steady_turning, false},
      {"direction", steady_direction, true}}, true},
    {"appell_spring",
     "name: appell_spring\n"
     "title: Particle whose slope is given, on a spring along z\n"
     "parameters: {m: 1.3, c: 0.8, k: 2}\n"
     "coordinates: [x, y, z]\n"
     "lagrangian: m/2*(x'^2 + y'^2 + z'^2) - k/2*z^2\n"
     "constraints: [\"z'^2 = c^2*(x'^2 + y'^2)\"]\n",
     "x y z", 5, sloped_rates, sloped_place,
     {0.4, -0.3, 0.5, 0.7, 0.9},
     {0, 0, 0, 0, 0.9},
     {{"energy", sloped_energy, false},
      {"direction", sloped_direction, false},
      {"across", sloped_across, false},
      {"along", sloped_along, false},
      {"phase", sloped_phase, false}}, true},
    {"disk_on_belt",
     "name: disk_on_belt\n"
     "title: Disk that rolls upright on an inclined moving belt\n"
     "parameters: {m: 1.3, I: 0.3, J: 0.2, R: 0.5, g: 9.81, slope: 0.2, V: 0.7}\n"
     "coordinates:\n"
     "  - {name: x, type: length, doc: downhill}\n"
     "  - {name: y, type: length}\n"
     "  - {name: h, type: angle, doc: heading}\n"
     "  - {name: p, type: angle, doc: roll}\n"
     "lagrangian: m/2*(x'^2 + y'^2) + J/2*h'^2 + I/2*p'^2 + m*g*sin(slope)*x\n"
     "constraints:\n"
     "  - x' = R*p'*cos(h) - V\n"
     "  - y' = R*p'*sin(h)\n",
     "x y h p", 6, disk_rates, disk_place,
     {0.4, -0.3, 0.5, 0.2, 0.9, 0.7},
     {0, 0, 0, 0, 0, 0},
     {{"turn", disk_turn, false},
      {"heading", disk_heading, false},
      {"product", disk_product, false},
      {"energy that the belt sees", disk_energy, false},
      {"roll", disk_roll, false},
      {"y", disk_y, false},
      {"x", disk_x, false}}, true},
    {"wheel_on_turntable",
     "name: wheel_on_turntable\n"
     "title: Wheel that rolls upright on a turntable\n"
     "parameters: {m: 1.1, I: 0.3, J: 0.2, R: 0.5, W: 0.8}\n"
     "bodies:\n"
     "  - {name: table}\n"
     "  - {name: fork}\n"
     "  - {name: wheel, mass: m, inertia: [J, I, J]}\n"
     "joints:\n"
     "  - {type: revolute, child: table, values: [W*t]}\n"
     "  - {type: planar, child: fork, at: [0, 0, R], coordinates: [x, y, h]}\n"
     "  - {type: revolute, parent: fork, child: wheel, axis: y, coordinates: [p]}\n"
     "wheels:\n"
     "  - {type: rolling, body: wheel, axle: y, radius: R, on: table}\n",
     "x y h p", 6, wheel_rates, wheel_place,
     {0.4, -0.3, 0.5, 0.2, 0.9, 0.7},
     {1, 0, 0, 0, 0, 0},
     {{"turn", wheel_turn, false},
      {"heading", wheel_heading, false},
      {"moving energy", wheel_energy, false},
      {"across", wheel_across, false},
      {"phase", wheel_phase, false},
      {"roll", wheel_roll, false}}, true},
};
/* clang-format on */

enum { OWN_COUNT = sizeof OWN / sizeof *OWN, SAMPLES = 12, STEPS = 500, MOST_CURRENTS = 24 };

static const double DURATION = 3, SAME = 1e-8;

/* ---- functions of a state: currents of the program, integrals by hand ---- */

typedef struct {
    const own_system *system;
    const nh_analysis *analysis; /* of current number `index`, */
    size_t index;
    const own_integral *known; /* or this integral */
} function;

static double value(const function *f, double t, const double *z)
{
    if (f->known) return f->known->value(t, z);
    double q[OWN_COORDINATES], v[OWN_COORDINATES];
    f->system->place(t, z, q, v);
    return nh_current_value(f->analysis, f->index, t, q, v);
}

/* Derivatives by the numbers of the state, and at last by t: central differences, Richardson's extrapolation. */
static void gradient(const function *f, double t, const double *z, double *out)
{
    for (size_t i = 0; i <= f->system->size; i++) {
        double slope[2], at[OWN_SIZE];
        for (int k = 0; k < 2; k++) {
            double h = 1e-3 * (k + 1), side[2];
            for (int s = 0; s < 2; s++) {
                double step = s ? h : -h;
                memcpy(at, z, sizeof at);
                if (i < f->system->size) at[i] += step;
                side[s] = value(f, i < f->system->size ? t : t + step, at);
            }
            slope[k] = (side[1] - side[0]) / (2 * h);
        }
        out[i] = (4 * slope[0] - slope[1]) / 3;
    }
}

/* ---- a motion by hand ---- */

typedef struct {
    double t[SAMPLES + 1], z[SAMPLES + 1][OWN_SIZE];
} motion;

/* The classical method of Runge and Kutta. */
static void step(const own_system *s, double t, double h, double *z)
{
    double k[4][OWN_SIZE], at[OWN_SIZE];
    for (int stage = 0; stage < 4; stage++) {
        double ahead = stage == 0 ? 0 : stage == 3 ? h : h / 2;
        for (size_t i = 0; i < s->size; i++) at[i] = z[i] + (stage ? ahead * k[stage - 1][i] : 0);
        s->rates(t + ahead, at, k[stage]);
    }
    for (size_t i = 0; i < s->size; i++) z[i] += h / 6 * (k[0][i] + 2 * k[1][i] + 2 * k[2][i] + k[3][i]);
}

static motion moved(const own_system *s, const double *start)
{
    motion m = {0};
    memcpy(m.z[0], start, sizeof m.z[0]);
    for (size_t j = 0; j < SAMPLES; j++) {
        double h = DURATION / SAMPLES / STEPS;
        memcpy(m.z[j + 1], m.z[j], sizeof m.z[0]);
        for (int i = 0; i < STEPS; i++) step(s, m.t[j] + i * h, h, m.z[j + 1]);
        m.t[j + 1] = m.t[j] + DURATION / SAMPLES;
    }
    return m;
}

/* Its change along the motion, relative to its terms |Phi| + sum |dPhi/dz_i z_i|; NAN where it is not defined. */
static double change(const function *f, const motion *m)
{
    double most = 0, terms = DBL_MIN, first = value(f, 0, m->z[0]), g[OWN_SIZE + 1];
    for (size_t j = 0; j <= SAMPLES; j++) {
        double now = value(f, m->t[j], m->z[j]), size = fabs(now);
        if (!isfinite(now)) return NAN;
        most = fmax(most, fabs(now - first));
        gradient(f, m->t[j], m->z[j], g);
        for (size_t i = 0; i < f->system->size; i++) size += fabs(g[i] * m->z[j][i]);
        if (isfinite(size)) terms = fmax(terms, size);
    }
    return most / terms;
}

/* ---- the space that gradients span ---- */

typedef struct {
    size_t rank;
    double row[MOST_CURRENTS][OWN_SIZE + 1]; /* orthonormal */
} span;

/* What remains of g, as a part of it, off the span; g becomes it, of length 1. */
static double rest(const span *s, size_t size, double *g)
{
    double length = 0, left = 0;
    for (size_t i = 0; i < size; i++) length += g[i] * g[i];
    for (int twice = 0; twice < 2; twice++)
        for (size_t k = 0; k < s->rank; k++) {
            double along = 0;
            for (size_t i = 0; i < size; i++) along += g[i] * s->row[k][i];
            for (size_t i = 0; i < size; i++) g[i] -= along * s->row[k][i];
        }
    for (size_t i = 0; i < size; i++) left += g[i] * g[i];
    for (size_t i = 0; i < size; i++) g[i] /= sqrt(left);
    return sqrt(left / length);
}

/* What is a combination remains by rounding and the differences alone. */
static const double COMBINED = 1e-6;

static void add(span *s, size_t size, double *g)
{
    if (rest(s, size, g) > COMBINED) memcpy(s->row[s->rank++], g, sizeof s->row[0]);
}

static span spanned(const own_system *s, const nh_analysis *a, double t, const double *z)
{
    span out = {0};
    for (size_t i = 0; i < nh_analysis_currents(a); i++) {
        double g[OWN_SIZE + 1];
        gradient(&(function){.system = s, .analysis = a, .index = i}, t, z, g);
        add(&out, s->size + 1, g);
    }
    return out;
}

/* ---- the statements ---- */

static const char *formula_of(const nh_analysis *a, size_t i)
{
    static char text[2000];
    char *formula = nh_current_formula(a, i, NH_SYNTAX_PLAIN);
    snprintf(text, sizeof text, "%s", formula ? formula : "(too long)");
    nh_string_free(formula);
    return text;
}

/* What divides by the turn, say, is not defined on a motion without one. */
static bool stays(double by, bool ordinary) { return by < SAME || (ordinary && isnan(by)); }

/* The integrals by hand are constant along both motions, and so is everything that the program calls conserved. */
static void expect_constant(const own_system *s, const nh_analysis *a)
{
    const motion m[] = {moved(s, s->generic), moved(s, s->ordinary)};
    for (int k = 0; k < 2; k++) {
        for (const own_integral *known = s->known; known->name; known++) {
            double by = change(&(function){.system = s, .known = known}, &m[k]);
            cr_expect(stays(by, k == 1), "%s: by hand, %s changes by %g", s->name, known->name, by);
        }
        for (size_t i = 0; i < nh_analysis_currents(a); i++) {
            double by = change(&(function){.system = s, .analysis = a, .index = i}, &m[k]);
            cr_expect(stays(by, k == 1), "%s: %s changes by %g", s->name, formula_of(a, i), by);
        }
    }
}

/* Every integral by hand is a function of those that the program found, and these are as many as it says. */
static void expect_complete(const own_system *s, const nh_analysis *a)
{
    const motion m = moved(s, s->generic);
    for (size_t j = 1; j <= SAMPLES; j += 3) {
        span found = spanned(s, a, m.t[j], m.z[j]);
        cr_expect_eq(found.rank, nh_analysis_independent(a), "%s: %zu independent, not %zu", s->name, found.rank,
                     nh_analysis_independent(a));
        for (const own_integral *known = s->known; known->name; known++) {
            double g[OWN_SIZE + 1], left;
            gradient(&(function){.system = s, .known = known}, m.t[j], m.z[j], g);
            left = rest(&found, s->size + 1, g);
            if (known->missed) cr_expect_gt(left, 0.01, "%s: %s is found today", s->name, known->name);
            else cr_expect_lt(left, COMBINED, "%s: %s is no function of the currents: %g", s->name, known->name, left);
        }
    }
}

static void expect_named(const own_system *s, const nh_problem *problem)
{
    char names[100] = "";
    for (size_t i = 0; i < nh_problem_coordinates(problem); i++) {
        if (i) strcat(names, " ");
        strcat(names, nh_problem_coordinate(problem, i));
    }
    cr_assert_str_eq(names, s->coordinates);
}

static nh_problem *opened(const own_system *s, nh_context *context)
{
    nh_error error = {0};
    nh_question question = {.system = s->name, .system_text = s->text};
    nh_problem *problem = nh_problem_open(context, &question, &error);
    cr_assert_not_null(problem, "%s: %s", s->name, error.what);
    return problem;
}

static const own_system *system_named(const char *name)
{
    for (size_t i = 0; i < OWN_COUNT; i++)
        if (!strcmp(OWN[i].name, name)) return &OWN[i];
    cr_assert_fail("no system %s", name);
    return NULL;
}

static void expect_as_by_hand(const own_system *s)
{
    nh_error error = {0};
    nh_context *context = nh_context_create();
    nh_problem *problem = opened(s, context);
    expect_named(s, problem);
    nh_analysis *a = nh_analyze(problem, &error);
    cr_assert_not_null(a, "%s: %s", s->name, error.what);
    cr_assert_leq(nh_analysis_currents(a), (size_t)MOST_CURRENTS);
    cr_expect_str_eq(nh_analysis_verdict(a), "FOUND");
    cr_expect_eq(nh_analysis_most(a), s->size, "%s: at most %zu", s->name, nh_analysis_most(a));
    for (size_t i = 0; i < nh_analysis_currents(a); i++)
        cr_expect(nh_current_describe(a, i).proved, "%s: %s", s->name, formula_of(a, i));
    expect_constant(s, a);
    expect_complete(s, a);
    nh_analysis_free(a);
    nh_problem_free(problem);
    nh_context_free(context);
}

Test(own_systems, what_is_called_conserved_is_so_along_motions_by_hand_and_nothing_known_is_missing)
{
    for (size_t i = 0; i < OWN_COUNT; i++)
        if (sweep_tries(i, 1, 5)) expect_as_by_hand(&OWN[i]);
}

/* ---- equations of motion, and questions ---- */

/* The accelerations of all coordinates, by hand from velocities a little later and before. */
static void by_hand(const own_system *s, double t, const double *z, double *q, double *v, double *out)
{
    static const double h = 1e-4;
    double rate[OWN_SIZE], at[OWN_SIZE], place[OWN_COORDINATES], side[2][OWN_COORDINATES];
    s->rates(t, z, rate);
    for (int k = 0; k < 2; k++) {
        for (size_t i = 0; i < s->size; i++) at[i] = z[i] + (k ? h : -h) * rate[i];
        s->place(t + (k ? h : -h), at, place, side[k]);
    }
    s->place(t, z, q, v);
    for (size_t i = 0; i < OWN_COORDINATES; i++) out[i] = (side[1][i] - side[0][i]) / (2 * h);
}

Test(own_systems, accelerations_are_those_of_newton_and_euler)
{
    for (size_t i = 0; i < OWN_COUNT; i++) {
        const own_system *s = &OWN[i];
        nh_error error = {0};
        nh_context *context = nh_context_create();
        nh_problem *problem = opened(s, context);
        nh_rates *rates = nh_rates_create(problem, &error);
        cr_assert_not_null(rates, "%s: %s", s->name, error.what);
        const motion m = moved(s, s->generic);
        for (size_t j = 0; j <= SAMPLES; j += 4) {
            double q[OWN_COORDINATES] = {0}, v[OWN_COORDINATES] = {0}, want[OWN_COORDINATES], a[OWN_COORDINATES];
            by_hand(s, m.t[j], m.z[j], q, v, want);
            nh_rates_at(rates, 1, &m.t[j], q, v, a);
            for (size_t k = 0; k < nh_problem_coordinates(problem); k++)
                cr_expect_float_eq(a[k], want[k], 1e-5 * (1 + fabs(want[k])), "%s: %s'' = %g, by hand %g", s->name,
                                   nh_problem_coordinate(problem, k), a[k], want[k]);
        }
        nh_rates_free(rates);
        nh_problem_free(problem);
        nh_context_free(context);
    }
}

/* x cos(h) + y sin(h) - z/c is constant where z' = c u > 0 and u is the speed; the equations are those of z' < 0. */
Test(own_systems, what_is_conserved_on_the_other_branch_alone_is_said_to_be_so)
{
    nh_error error = {0};
    nh_context *context = nh_context_create();
    nh_problem *problem = opened(system_named("appell_spring"), context);
    nh_verification *v = nh_verify_current(problem, "(x*x' + y*y')/sqrt(x'^2 + y'^2) - z/c", &error);
    cr_assert_not_null(v, "%s", error.what);
    cr_expect_not(nh_verification_holds(v));
    char *text = nh_verification_document(v, NH_FORMAT_TEXT, &error);
    cr_expect_not_null(strstr(text, "on the branch z' < 0"), "%s", text);
    cr_expect_not_null(strstr(text, "it is conserved: proved."), "%s", text);
    nh_string_free(text);
    nh_verification_free(v);
    nh_problem_free(problem);
    nh_context_free(context);
}

/* The gradient of z'^2 - c^2 (x'^2 + y'^2) vanishes where the point comes to rest: the equations do not tell how it goes
 * on.  `simulate` ends there; the motion that checks the currents stepped over it, and no two methods agreed. */
Test(own_systems, the_motion_that_checks_currents_ends_where_no_acceleration_is_determined)
{
    nh_error error = {0};
    nh_context *context = nh_context_create();
    nh_problem *problem = opened(system_named("appell_spring"), context);
    nh_analysis *a = nh_analyze(problem, &error);
    cr_assert_not_null(a, "%s", error.what);
    char *text = nh_analysis_document(a, NH_FORMAT_TEXT, &error);
    cr_expect_not_null(strstr(text, "the test motion ends at t = "), "%s", text);
    cr_expect_null(strstr(text, "states differ"), "%s", text);
    nh_string_free(text);
    nh_analysis_free(a);
    nh_problem_free(problem);
    nh_context_free(context);
}

/* ---- reductions ---- */

static double number(const cJSON *of, const char *key)
{
    const cJSON *item = cJSON_GetObjectItem(of, key);
    return cJSON_IsNumber(item) ? item->valuedouble : NAN;
}

/* Suslov's body by its whole group: at the place of the slice all terms of the constraint were rounding, and the check
 * of the equations, which divides by them, was off by 1. */
Test(own_systems, reduced_equations_agree_with_the_accelerations)
{
    for (size_t i = 0; i < OWN_COUNT; i++) {
        if (!sweep_tries(i, 1, 5)) continue;
        const own_system *s = &OWN[i];
        nh_error error = {0};
        nh_context *context = nh_context_create();
        nh_problem *problem = opened(s, context);
        nh_reduction *r = nh_reduce(problem, &error);
        cr_assert_not_null(r, "%s: %s", s->name, error.what);
        char *text = nh_reduction_document(r, NH_FORMAT_JSON, &error);
        cJSON *document = cJSON_Parse(text), *stage = NULL;
        const cJSON *stages = cJSON_GetObjectItem(document, "stages");
        cr_expect_eq(cJSON_GetArraySize(stages) > 0, s->reducible, "%s: %d stages", s->name,
                     cJSON_GetArraySize(stages));
        cJSON_ArrayForEach (stage, stages) {
            cr_expect_lt(number(stage, "printed_difference"), SAME, "%s", s->name);
            cr_expect_lt(number(stage, "agreement_with_full"), SAME, "%s", s->name);
        }
        cJSON_Delete(document);
        nh_string_free(text);
        nh_reduction_free(r);
        nh_problem_free(problem);
        nh_context_free(context);
    }
}

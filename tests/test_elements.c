/* Springs, dampers, actuators and points of bodies against hand-written systems of the same mechanism: the equations agree at rest, at
 * zero, where bodies are aligned, and at random states; energy is lost at the rate 2 R; forces at points do the work that they should. */
#include <stdio.h>

#include "graph/dag.h"
#include "graph/diff.h"
#include "mechanics.h"
#include "sweep.h"

enum { most = 6 };

static nh_system *parsed(const char *text)
{
    nh_error error = {0};
    nh_system *s = nh_system_parse("test.yaml", text, 0, NULL, &error);
    must(s != NULL, &error, text);
    return s;
}

static nh_ex rate(const nh_system *s, nh_ex e)
{
    nh_ex sum = nh_diff(s->dag, e, s->t);
    for (size_t i = 0; i < s->coordinates; i++) sum = nh_add(s->dag, sum, nh_mul(s->dag, nh_diff(s->dag, e, s->coordinate[i].q), s->coordinate[i].v));
    return sum;
}

/* Values where t, the coordinates and their velocities are z. */
static void at(const nh_system *s, size_t n, const nh_ex *e, const double *z, double *out)
{
    const nh_ex *symbols;
    const double *values;
    nh_ex in[1 + 2 * most];
    in[0] = s->t;
    for (size_t i = 0; i < s->coordinates; i++) in[1 + i] = s->coordinate[i].q, in[1 + s->coordinates + i] = s->coordinate[i].v;
    nh_system_bindings(s, &symbols, &values);
    nh_tape *tape = nh_tape_create(s->dag, 1 + 2 * s->coordinates, in, n, e, s->parameters, symbols, values);
    nh_tape_work *work = nh_tape_work_create(tape);
    nh_tape_eval(tape, work, z, out);
    nh_tape_work_free(work);
    nh_tape_free(tape);
}

/* The mass matrix, and d/dt dL/dq' - dL/dq - Q without accelerations: m x m + m expressions. */
static void equations(const nh_system *s, nh_ex *out)
{
    nh_dag *d = s->dag;
    size_t m = s->coordinates;
    for (size_t i = 0; i < m; i++) {
        nh_ex p = nh_diff(d, s->lagrangian, s->coordinate[i].v);
        for (size_t j = 0; j < m; j++) out[i * m + j] = nh_diff(d, p, s->coordinate[j].v);
        out[m * m + i] = nh_sub(d, nh_sub(d, rate(s, p), nh_diff(d, s->lagrangian, s->coordinate[i].q)), s->force[i]);
    }
}

static double between(uint64_t *seed, double low, double high)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * (double)(*seed >> 11) / 9007199254740992.0;
}

/* Both systems have the same equations at zero, at rest with every angle 0 or pi, and at random states. */
static void expect_same(const char *one, const char *other, double tolerance)
{
    nh_system *s = parsed(one), *r = parsed(other);
    size_t m = s->coordinates, n = m * m + m;
    nh_ex e[most * most + most], f[most * most + most];
    cr_assert_eq(m, r->coordinates);
    equations(s, e);
    equations(r, f);
    uint64_t seed = 11;
    for (int state = 0; state < 12; state++) {
        double z[1 + 2 * most] = {0}, a[most * most + most], b[most * most + most];
        for (size_t i = 0; i < m && state > 0; i++) {
            if (state > 4) z[1 + i] = between(&seed, -1.3, 1.3), z[1 + m + i] = between(&seed, -1.3, 1.3);
            else if (s->coordinate[i].type == NH_ANGLE) z[1 + i] = (double)(state >> i & 1) * acos(-1);
        }
        z[0] = state ? 0.3 : 0;
        at(s, n, e, z, a);
        at(r, n, f, z, b);
        for (size_t k = 0; k < n; k++)
            cr_expect(fabs(a[k] - b[k]) <= tolerance * (1 + fabs(b[k])), "state %d, equation %zu: %.17g, %.17g\n%s", state, k, a[k], b[k], one);
    }
    nh_system_free(s);
    nh_system_free(r);
}

#define ARM                                                                                                                                  \
    "parameters: {m: 1, l: 0.7, k: 3, c: 0.2, l0: 0.4, u: 0.6, g: 9.81}\ngravity: [0, -g, 0]\n"                                                \
    "bodies:\n  - {name: upper, mass: m, inertia: m*l^2/12, center: [l/2, 0, 0]}\n  - {name: lower, mass: m, inertia: m*l^2/12, center: [l/2, 0, 0]}\n" \
    "joints:\n  - {type: revolute, name: hip, child: upper, coordinates: [a]}\n  - {type: revolute, name: knee, parent: upper, child: lower, at: [l, 0, 0], coordinates: [b]}\n" \
    "points: [{name: tip, body: lower, at: [l, 0, 0]}, {name: nail, body: ground, at: [0, -1, 0]}]\n"
#define HAND                                                                                                                                 \
    "parameters: {m: 1, l: 0.7, k: 3, c: 0.2, l0: 0.4, u: 0.6, g: 9.81}\ncoordinates: {a: angle, b: angle}\n"                                    \
    "definitions: [x = l*cos(a), y = l*sin(a), X = x + l*cos(a + b), Y = y + l*sin(a + b), xm = x + l/2*cos(a + b), ym = y + l/2*sin(a + b),"   \
    " T = m*l^2/8*a'^2 + m/2*(xm'^2 + ym'^2) + m*l^2/24*(a'^2 + (a' + b')^2), V = m*g*(y/2 + ym), \"d = sqrt(X^2 + (Y + 1)^2)\"]\n"

Test(elements, springs_agree_with_written_energies)
{
    static const char *const pairs[][2] = {
        {"springs: [{joint: knee, stiffness: k, rest: 0.1}]\n", "lagrangian: T - V - k/2*(b - 0.1)^2\n"},
        {"springs: [{coordinate: a, stiffness: 2*k}]\n", "lagrangian: T - V - k*a^2\n"},
        {"springs: [{between: [tip, nail], stiffness: k, length: l0*cos(t)}]\n", "lagrangian: T - V - k/2*(d - l0*cos(t))^2\n"},
        {"springs: [{between: [[ground, 0, -1, 0], [lower, l, 0, 0]], stiffness: k}]\n", "lagrangian: T - V - k/2*d^2\n"},
        {"springs: [{between: [upper, tip], stiffness: k, length: l0}]\n", "lagrangian: \"T - V - k/2*(sqrt(2*l^2*(1 + cos(b))) - l0)^2\"\n"},
        {"springs: [{between: [tip, [upper, 2*l, 0, 0]], stiffness: k}]\n", "lagrangian: \"T - V - k*l^2*(1 - cos(b))\"\n"},
    };
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        char one[2000], other[2000];
        snprintf(one, sizeof one, "%s%s", ARM, pairs[i][0]);
        snprintf(other, sizeof other, "%s%s", HAND, pairs[i][1]);
        if (i == 4) continue; /* singular where the arm is folded: below */
        expect_same(one, other, 1e-12);
    }
}

/* Where the arm is folded, the ends coincide: the energy with rest length 0 has no root, the other one is noted. */
Test(elements, springs_that_shrink_to_a_point)
{
    nh_system *s = parsed(ARM "springs: [{between: [upper, tip], stiffness: k}]\n");
    nh_ex e[most * most + most];
    double z[1 + 2 * most] = {0, 0.4, acos(-1), 0, 0}, out[most * most + most];
    equations(s, e);
    at(s, 6, e, z, out);
    for (int k = 0; k < 6; k++) cr_expect(isfinite(out[k]), "%d: %g", k, out[k]);
    cr_expect_eq(s->notes, 0);
    nh_system_free(s);
    s = parsed(ARM "springs: [{between: [tip, [ground, 2*l, 0, 0]], stiffness: k, length: l0}]\n");
    cr_assert_eq(s->notes, 1);
    cr_expect(strstr(s->note[0], "coincide") != NULL, "%s", s->note[0]);
    nh_system_free(s);
    expect_same(ARM "springs: [{between: [tip, [ground, 2*l, 0, 0]], stiffness: k}]\n", HAND "lagrangian: \"T - V - k/2*((X - 2*l)^2 + Y^2)\"\n", 1e-12);
}

Test(elements, dampers_and_actuators_agree_with_written_forces)
{
    static const char *const pairs[][2] = {
        {"dampers: [{joint: knee, damping: c}]\n", "forces: [b = -c*b']\n"},
        {"dampers: [{between: [tip, nail], damping: c}]\n", "dissipation: c/2*d'^2\n"},
        {"dissipation: c/2*(a' + b')^2\n", "forces: [\"a = -c*(a' + b')\", \"b = -c*(a' + b')\"]\n"},
        {"actuators: [{joint: hip, force: u*cos(b)}]\n", "forces: [a = u*cos(b)]\n"},
        {"actuators: [{point: tip, force: [u, 2*u, 0]}]\n", "forces: [\"a = -u*Y + 2*u*X\", \"b = -u*(Y - y) + 2*u*(X - x)\"]\n"},
        {"actuators: [{point: tip, force: [0, u, 0], in: lower}]\n", "forces: [a = u*(l + l*cos(b)), b = u*l]\n"},
        {"actuators: [{body: lower, torque: [0, 0, u]}]\n", "forces: [a = u, b = u]\n"},
        {"actuators: [{body: upper, torque: [0, 0, u], in: lower}, {joint: knee, force: -u}]\n", "forces: [a = u, b = -u]\n"},
    };
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        char one[2000], other[2000];
        snprintf(one, sizeof one, "%s%s", ARM, pairs[i][0]);
        snprintf(other, sizeof other, "%s%slagrangian: T - V\n", HAND, pairs[i][1]);
        expect_same(one, other, 1e-12);
    }
    /* a force u along a distance is a potential -u d */
    expect_same(ARM "actuators: [{between: [tip, nail], force: u}]\n", HAND "lagrangian: T - V + u*d\n", 1e-12);
}

/* A torque in space: about the ground's z it drives the first of three turns zyx, and by -sin(b) the third. */
Test(elements, torques_in_space)
{
    nh_system *s = parsed("parameters: {u: 0.7}\nbodies: [{name: top, mass: 1, inertia: [1, 2, 3]}]\njoints: [{type: spherical, child: top, coordinates: [a, b, c]}]\n"
                          "actuators: [{body: top, torque: [0, 0, u]}]\n");
    double z[7] = {0, 0.3, -0.4, 1.1, 0.2, 0.5, -0.6}, Q[3];
    at(s, 3, s->force, z, Q);
    cr_expect_float_eq(Q[0], 0.7, 1e-14);
    cr_expect_float_eq(Q[1], 0, 1e-14);
    cr_expect_float_eq(Q[2], 0.7 * -sin(-0.4), 1e-14);
    nh_system_free(s);
}

/* Springs and dampers alone: dE/dt = sum Q_i q_i' = -2 R. */
Test(elements, energy_is_lost_at_twice_the_dissipation)
{
    nh_system *s = parsed(ARM "dampers: [{joint: hip, damping: c}, {between: [tip, nail], damping: 2*c}]\ndissipation: c/2*b'^2\n"
                              "definitions: [\"R = c/2*(a'^2 + b'^2) + c*(tip_x*tip_x' + (tip_y + 1)*tip_y')^2/(tip_x^2 + (tip_y + 1)^2)\"]\n");
    nh_dag *d = s->dag;
    nh_ex power = nh_int(d, 0), R = 0;
    for (size_t i = 0; i < s->coordinates; i++) power = nh_add(d, power, nh_mul(d, s->force[i], s->coordinate[i].v));
    for (size_t i = 0; i < s->definitions; i++)
        if (!strcmp(s->definition[i].name, "R")) R = s->definition[i].value;
    uint64_t seed = 5;
    for (int k = 0; k < 6; k++) {
        double z[5] = {0}, out[2];
        for (int i = 1; i < 5 && k; i++) z[i] = between(&seed, -1.5, 1.5);
        at(s, 2, (nh_ex[]){power, R}, z, out);
        cr_expect(fabs(out[0] + 2 * out[1]) <= 1e-13 * (1 + fabs(out[1])), "%.17g, %.17g", out[0], out[1]);
    }
    nh_system_free(s);
}

/* Positions of points serve in definitions before and after, constraints and forces. */
Test(elements, points_are_definitions)
{
    nh_system *s = parsed(ARM "definitions: [l1 = l/2, h = tip_y + l1, w = 2*h]\nconstraints: [\"tip_x = tip_y + 1\"]\nforces: [a = tip_y']\nlagrangian: -tip_x^2\n");
    double z[5] = {0, 0.3, 0.8, 0.5, -0.2}, out[2];
    at(s, 1, s->force, z, out);
    cr_expect_float_eq(out[0], 0.7 * cos(0.3) * 0.5 + 0.7 * cos(1.1) * 0.3, 1e-14);
    cr_expect_eq(s->constraints, 1);
    nh_system_free(s);
}

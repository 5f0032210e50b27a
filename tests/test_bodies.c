/* Bodies and joints: energies against differentiated poses, poses against exponentials by hand, the mass matrix and the accelerations against a
 * recursion by hand, wheels against their geometry, the crane against independent values of 40 digits. */
#include "base/linalg.h"
#include "chain.h"
#include "graph/diff.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/node.h"
#include "oracle.h"
#include "sweep.h"

/* ---- values ---- */

/* Expressions of a system where t, the coordinates and their velocities are z. */
static void at(const nh_system *s, size_t n, const nh_ex *e, const double *z, double *out)
{
    size_t m = s->coordinates;
    const nh_ex *symbols;
    const double *values;
    nh_ex in[1 + 2 * most_links];
    in[0] = s->t;
    for (size_t i = 0; i < m; i++) in[1 + i] = s->coordinate[i].q, in[1 + m + i] = s->coordinate[i].v;
    nh_system_bindings(s, &symbols, &values);
    nh_tape *tape = nh_tape_create(s->dag, 1 + 2 * m, in, n, e, s->parameters, symbols, values);
    nh_tape_work *work = nh_tape_work_create(tape);
    nh_tape_eval(tape, work, z, out);
    nh_tape_work_free(work);
    nh_tape_free(tape);
}

static nh_ex rate(const nh_system *s, nh_ex e)
{
    nh_ex sum = nh_diff(s->dag, e, s->t);
    for (size_t i = 0; i < s->coordinates; i++) sum = nh_add(s->dag, sum, nh_mul(s->dag, nh_diff(s->dag, e, s->coordinate[i].q), s->coordinate[i].v));
    return sum;
}

static nh_system *parsed(const char *text)
{
    nh_error error = {0};
    nh_system *s = nh_system_parse("test.yaml", text, 0, NULL, &error);
    must(s != NULL, &error, "the system");
    return s;
}

static void random_state(const nh_system *s, uint64_t seed, double *z)
{
    z[0] = 0.37;
    for (size_t i = 0; i < 2 * s->coordinates; i++) z[1 + i] = between(&seed, -1.3, 1.3);
}

/* T from poses alone: m |x'|^2/2 and w from R^T R', V from positions. */
static void energies_from_poses(const nh_system *s, const double *z, double *T, double *V)
{
    const nh_chain *c = s->chain;
    *T = *V = 0;
    for (size_t b = 0; b < c->bodies; b++) {
        const nh_body *body = &c->body[b];
        nh_ex e[40];
        double x[40], W[9];
        for (int i = 0; i < 9; i++) e[i] = body->pose.R[i], e[9 + i] = rate(s, body->pose.R[i]), e[18 + i] = body->inertia[i];
        for (int i = 0; i < 3; i++) e[27 + i] = rate(s, body->position[i]), e[30 + i] = body->position[i], e[33 + i] = c->gravity[i];
        e[36] = body->mass;
        at(s, 37, e, z, x);
        double Rt[9];
        for (int i = 0; i < 9; i++) Rt[i] = x[i % 3 * 3 + i / 3];
        multiplied(Rt, x + 9, W);
        double w[3] = {W[7], W[2], W[3]}, L[3];
        turned(x + 18, 0, w, L);
        *T += x[36] / 2 * dot(x + 27, x + 27) + dot(w, L) / 2;
        *V -= x[36] * dot(x + 33, x + 30);
    }
}

/* ---- every kind of joint, random trees ---- */

static tree random_tree(size_t bodies, uint64_t seed, char **text)
{
    tree t = {.gravity = {between(&seed, -5, 5), between(&seed, -5, 5), -9.81}};
    nh_text b, j;
    nh_text_init(&b);
    nh_text_init(&j);
    for (size_t i = 0; i < bodies; i++) {
        int parent = (int)(between(&seed, 0, (double)i + 1)) - 1;
        grow(&t, parent, &FORMS[(size_t)between(&seed, 0, forms)], &seed, &b, &j);
    }
    *text = tree_text(&t, &b, &j);
    nh_text_clear(&b);
    nh_text_clear(&j);
    return t;
}

static void check_tree(const tree *t, const char *text, const char *name)
{
    nh_system *s = parsed(text);
    const nh_chain *c = s->chain;
    size_t n = t->links;
    static double z[1 + 2 * most_links], M[most_links * most_links], K[most_links * most_links];
    double energy[2], T, V, quadratic = 0;
    placed x[most_links] = {0};
    cr_assert_eq(s->coordinates, n, "%s", name);
    random_state(s, 99, z);
    at(s, 2, (nh_ex[]){c->kinetic, c->potential}, z, energy);
    energies_from_poses(s, z, &T, &V);
    cr_expect_leq(fabs(energy[0] - T), 2e-14 * fabs(T), "%s: kinetic energy %.17g, from poses %.17g", name, energy[0], T);
    cr_expect_leq(fabs(energy[1] - V), 2e-14 * (1 + fabs(V)), "%s: potential %.17g, from poses %.17g", name, energy[1], V);
    for (size_t i = 0; i < n; i++) x[i] = place(&t->link[i], z[1 + i]);
    mass_matrix(t, x, M);
    at(s, n * n, c->K, z, K);
    double worst = 0, size = 0;
    for (size_t i = 0; i < n * n; i++) {
        worst = fmax(worst, fabs(K[i] - M[i]));
        size = fmax(size, fabs(M[i]));
        quadratic += K[i] * z[1 + n + i / n] * z[1 + n + i % n] / 2;
    }
    cr_expect_leq(worst, 3e-14 * size, "%s: metric off by %.1e of %.1e", name, worst, size);
    cr_expect_leq(fabs(quadratic - T), 3e-14 * T);
    for (size_t b = 0; b < c->bodies; b++) { /* poses along the path, multiplied up by hand */
        double R[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, p[3] = {0, 0, 0}, pose[12];
        for (int i = t->end[b]; i >= 0; i = t->link[i].parent) {
            multiplied(x[i].R, R, R);
            turned(x[i].R, 0, p, p);
            for (int e = 0; e < 3; e++) p[e] += x[i].p[e];
        }
        nh_ex e[12];
        memcpy(e, c->body[b].pose.R, sizeof c->body[b].pose.R);
        memcpy(e + 9, c->body[b].pose.p, sizeof c->body[b].pose.p);
        at(s, 12, e, z, pose);
        for (int i = 0; i < 12; i++) cr_expect_leq(fabs(pose[i] - (i < 9 ? R[i] : p[i - 9])), 1e-14 * (1 + fabs(pose[i])), "%s: pose of body %zu, entry %d", name, b, i);
    }
    nh_system_free(s);
}

Test(bodies, every_joint_alone, PLAIN_ONLY)
{
    for (size_t k = 0; k < forms; k++) {
        if (!sweep_tries(k, 1, 2)) continue;
        uint64_t seed = 17 + k;
        tree t = {.gravity = {1.1, -0.7, -9}};
        nh_text b, j;
        nh_text_init(&b);
        nh_text_init(&j);
        grow(&t, -1, &FORMS[0], &seed, &b, &j);
        grow(&t, 0, &FORMS[k], &seed, &b, &j);
        char *text = tree_text(&t, &b, &j);
        check_tree(&t, text, FORMS[k].type);
        nh_free(text);
        nh_text_clear(&b);
        nh_text_clear(&j);
    }
}

Test(bodies, random_trees, PLAIN_ONLY)
{
    for (uint64_t seed = 1; seed <= 12; seed++) {
        if (!sweep_tries(seed, 2, 6)) continue;
        char *text, name[40];
        tree t = random_tree(2 + seed % 6, seed, &text);
        snprintf(name, sizeof name, "tree %d", (int)seed);
        check_tree(&t, text, name);
        nh_free(text);
    }
}

/* Body Jacobian (of eq. 3.22): column k of `out` (screws columns) is the twist of the body's frame for the rate 1 of screw k alone. */
static void body_jacobian(const nh_chain *c, nh_dag *d, size_t body, nh_twist *out)
{
    nh_pose behind = nh_pose_identity(d); /* of the body in the frame of the screw at hand */
    for (size_t k = 0; k < c->screws; k++)
        for (int i = 0; i < 3; i++) out[k].v[i] = out[k].w[i] = nh_int(d, 0);
    for (long b = (long)body; b != NH_GROUND;) {
        const nh_joint *j = &c->joint[c->body[b].joint];
        for (size_t k = j->first + j->screws; k-- > j->first;) {
            nh_twist own = nh_screw_twist(d, &c->screw[k]);
            nh_pose step = nh_screw_pose(d, &c->screw[k]);
            out[k] = nh_twist_inwards(d, &behind, &own);
            behind = nh_pose_product(d, &step, &behind);
        }
        behind = nh_pose_product(d, &j->placement, &behind);
        b = j->parent;
    }
}

Test(bodies, jacobian_and_frames_agree)
{
    char *text;
    random_tree(5, 4, &text);
    nh_system *s = parsed(text);
    const nh_chain *c = s->chain;
    static double z[1 + 2 * most_links];
    random_state(s, 5, z);
    nh_twist *J = nh_alloc_array(c->screws, sizeof *J);
    for (size_t b = 0; b < c->bodies; b++) {
        nh_pose pose;
        nh_twist twist;
        nh_chain_frame(c, s->dag, (long)b, 0, &pose, &twist);
        body_jacobian(c, s->dag, b, J);
        for (int e = 0; e < 6; e++) {
            nh_ex sum = nh_int(s->dag, 0);
            for (size_t k = 0; k < c->screws; k++) sum = nh_add(s->dag, sum, nh_mul(s->dag, e < 3 ? J[k].v[e] : J[k].w[e - 3], c->screw[k].rate));
            double x[2];
            at(s, 2, (nh_ex[]){sum, e < 3 ? twist.v[e] : twist.w[e - 3]}, z, x);
            cr_expect_leq(fabs(x[0] - x[1]), 1e-13 * (1 + fabs(x[0])), "body %zu, component %d: %.17g and %.17g", b, e, x[0], x[1]);
        }
    }
    nh_free(J);
    nh_free(text);
    nh_system_free(s);
}

/* ---- accelerations ---- */

static void check_accelerations(const tree *t, const char *text, double bound, const char *name)
{
    mechanics x = mechanics_of_text(text, NH_CHART_AUTO);
    size_t n = t->links;
    static double z[1 + 2 * most_links], M[most_links * most_links], got[most_links], want[most_links];
    random_state(x.system, 3, z);
    accelerations_by_hand(t, z + 1, z + 1 + n, M, want);
    values_at(x.model, n, x.model->a, z, got);
    double worst = 0, size = 0;
    for (size_t i = 0; i < n; i++) worst = fmax(worst, fabs(got[i] - want[i])), size = fmax(size, fabs(want[i]));
    cr_expect(worst <= bound * size, "%s: accelerations off by %.1e of %.1e", name, worst, size);
    mechanics_clear(&x);
}

Test(bodies, accelerations_of_chains)
{
    for (size_t n = 1; n <= 10; n += 3) {
        if (!sweep_tries(n, 1, 4)) continue;
        tree t;
        char *text = revolute_chain(&t, n, 11 + n), name[40];
        snprintf(name, sizeof name, "chain of %zu", n);
        check_accelerations(&t, text, 1e-12, name);
        nh_free(text);
    }
}

Test(bodies, accelerations_of_trees, PLAIN_ONLY)
{
    for (uint64_t seed = 21; seed <= 24; seed++) {
        if (!sweep_tries(seed, 2, 4)) continue;
        char *text, name[40];
        tree t = random_tree(3, seed, &text);
        snprintf(name, sizeof name, "tree %d", (int)seed);
        check_accelerations(&t, text, 1e-11, name);
        nh_free(text);
    }
}

/* A graph, not a formula: the number of nodes grows like a power of n. */
Test(bodies, chains_stay_small, PLAIN_ONLY)
{
    for (size_t n = 4; n <= 12; n += 4) {
        tree t;
        char *text = revolute_chain(&t, n, 5);
        nh_system *s = parsed(text);
        cr_expect_leq(nh_node_count(s->dag, s->lagrangian), 60 * n * n, "%zu bodies: %zu nodes", n, nh_node_count(s->dag, s->lagrangian));
        nh_free(text);
        nh_system_free(s);
    }
}

/* ---- where the ground's axes stand does not matter ---- */

/* The same chain behind a fixed joint that turns and shifts everything, with gravity turned likewise: the same Lagrangian. */
Test(bodies, relocating_the_base)
{
    static const char chain[] =
        "bodies:\n  - {name: a, mass: 1.3, center: [0.2, 0.1, -0.3], inertia: [0.4, 0.5, 0.6]}\n  - {name: b, mass: 0.7, center: [0, 0.4, 0.1], inertia: 0.2}\n";
    char moved[2000], plain[2000];
    double angle = 0.7, tilt = -0.4, R[9], S[9], p[3], g[3], gravity[3] = {0.3, -0.6, -9};
    link turn[2] = {{.w = {0, 0, 1}}, {.w = {0, 1, 0}}};
    displacement(&turn[0], angle, R, p);
    displacement(&turn[1], tilt, S, p);
    multiplied(R, S, R);
    turned(R, 0, gravity, g);
    const char *rest = "  - {type: spherical, %s child: a, at: [0.1, 0.2, 0.3], coordinates: [u, v, w]}\n  - {type: helical, pitch: 0.2, parent: a, child: b, at: [0, 1, 0], axis: [1, 2, -2], coordinates: [h]}\n";
    char joints[1000];
    snprintf(joints, sizeof joints, rest, "");
    snprintf(plain, sizeof plain, "gravity: [%.17g, %.17g, %.17g]\n%sjoints:\n%s", gravity[0], gravity[1], gravity[2], chain, joints);
    snprintf(joints, sizeof joints, rest, "parent: base,");
    snprintf(moved, sizeof moved, "gravity: [%.17g, %.17g, %.17g]\n%s  - {name: base}\njoints:\n  - {type: fixed, child: base, at: [3, -2, 5], rotation: [{z: %.17g}, {y: %.17g}]}\n%s", g[0], g[1], g[2], chain, angle, tilt, joints);
    nh_system *a = parsed(plain), *b = parsed(moved);
    double z[9], L[2], V[4];
    for (int k = 0; k < 5; k++) {
        random_state(a, 50 + (uint64_t)k, z);
        at(a, 2, (nh_ex[]){a->chain->kinetic, a->chain->potential}, z, V);
        at(b, 2, (nh_ex[]){b->chain->kinetic, b->chain->potential}, z, V + 2);
        if (k == 0) L[0] = V[1], L[1] = V[3];
        cr_expect_leq(fabs(V[0] - V[2]), 1e-14 * V[0] * 10);
        cr_expect_leq(fabs((V[1] - L[0]) - (V[3] - L[1])), 1e-12, "potentials differ by more than a constant");
        cr_expect(k == 0 || fabs(V[1] - L[0]) > 1e-3);
    }
    nh_system_free(a);
    nh_system_free(b);
}

/* ---- prescribed and coupled displacements ---- */

/* A bead on a hoop that is turned at the rate W, and a second body geared to it. */
Test(bodies, values_in_place_of_coordinates)
{
    nh_system *s = parsed("parameters: [{name: W, value: 0.8}, {name: r, value: 1.5}, {name: m, value: 2}, {name: J, value: 0.3}, {name: g, value: 9}]\n"
                          "gravity: g\n"
                          "bodies: [{name: hoop}, {name: arm}, {name: bead, mass: m}, {name: gear, inertia: [0, 0, J]}]\n"
                          "joints:\n"
                          "  - {type: revolute, child: hoop, axis: z, values: [W*t]}\n"
                          "  - {type: revolute, parent: hoop, child: arm, axis: y, coordinates: [q]}\n"
                          "  - {type: fixed, parent: arm, child: bead, at: [0, 0, -r]}\n"
                          "  - {type: revolute, child: gear, axis: z, values: [-3*q]}\n"
                          "lagrangian: -q^2/7\n");
    double z[3] = {0.4, 0.9, -1.2}, L;
    at(s, 1, &s->lagrangian, z, &L);
    double want = 2 * 1.5 * 1.5 / 2 * (1.2 * 1.2 + 0.8 * 0.8 * sin(0.9) * sin(0.9)) + 0.3 / 2 * 9 * 1.2 * 1.2 + 2 * 9 * 1.5 * cos(0.9) - 0.81 / 7;
    cr_expect_float_eq(L, want, 1e-13, "%.17g, %.17g", L, want);
    cr_expect_eq(s->coordinates, 1);
    cr_expect_eq((int)s->coordinate[0].type, (int)NH_ANGLE);
    nh_system_free(s);
}

/* Names, types and sampling intervals that the file does not give. */
Test(bodies, defaults)
{
    nh_system *s = parsed("bodies: [{name: a, mass: 1}, {name: b, mass: 1, inertia: 1}]\n"
                          "coordinates: [z, {name: b_b, doc: mine}]\n"
                          "joints:\n  - {type: cylindrical, child: a}\n  - {type: spherical, parent: a, child: b, at: [0, 0, 1]}\n"
                          "lagrangian: z'^2\n");
    static const char *const names[] = {"z", "b_b", "a_s", "a_a", "b_a", "b_c"};
    static const nh_coordinate_type types[] = {NH_PLAIN, NH_ANGLE, NH_LENGTH, NH_ANGLE, NH_ANGLE, NH_ANGLE};
    cr_assert_eq(s->coordinates, 6);
    for (size_t i = 0; i < 6; i++) {
        cr_expect_str_eq(s->coordinate[i].name, names[i]);
        cr_expect_eq((int)s->coordinate[i].type, (int)types[i], "%s", names[i]);
    }
    cr_assert_eq(s->intervals, 1);
    cr_expect_eq(s->interval[0].symbol, s->coordinate[1].q);
    cr_expect_leq(s->interval[0].high, 1.5);
    nh_system_free(s);
}

/* ---- wheels ---- */

/* A tilted wheel on a free body: its conditions say that the material point where the rim is lowest does not move. */
Test(bodies, a_tilted_wheel_touches_with_its_lowest_point)
{
    nh_system *s = parsed("bodies: [{name: wheel, mass: 1, inertia: [1, 2, 3]}]\n"
                          "joints: [{type: free, child: wheel, angles: zxy, coordinates: [x, y, z, a, b, c]}]\n"
                          "wheels: [{type: rolling, body: wheel, at: [0, 0.3, 0], axle: y, radius: 0.8}]\n");
    cr_assert_eq(s->constraints, 3);
    const nh_pose *p = &s->chain->body[0].pose;
    double z[13];
    for (uint64_t seed = 1; seed <= 4; seed++) {
        random_state(s, seed, z);
        nh_ex e[24];
        double pose[24], f[3];
        for (int i = 0; i < 9; i++) e[i] = p->R[i], e[12 + i] = rate(s, p->R[i]);
        for (int i = 0; i < 3; i++) e[9 + i] = p->p[i], e[21 + i] = rate(s, p->p[i]);
        at(s, 24, e, z, pose);
        double low = INFINITY, body[3] = {0, 0.3, 0}, point[3], u[3], bottom = 0;
        for (int pass = 0; pass < 2; pass++) /* the lowest point of the rim, by search: coarse, then fine */
            for (int k = -5000; k <= 5000; k++) {
                double angle = pass ? bottom + k * 4e-7 : k * 3.14159265358979 / 5000, rim[3] = {0.8 * cos(angle), 0.3, 0.8 * sin(angle)}, world[3];
                turned(pose, 0, rim, world);
                if (pass == 0 ? world[2] < low : world[2] < low) low = world[2], memcpy(body, rim, sizeof rim), bottom = pass ? bottom : angle;
            }
        turned(pose + 12, 0, body, u);
        for (int i = 0; i < 3; i++) u[i] += pose[21 + i];
        turned(pose, 0, body, point);
        double n[3] = {0, 0, 1}, axle[3], forward[3], side[3], y[3] = {0, 1, 0};
        turned(pose, 0, y, axle);
        cross(axle, n, forward);
        cross(n, forward, side);
        nh_ex c[3] = {s->constraint[0].lhs, s->constraint[1].lhs, s->constraint[2].lhs};
        at(s, 3, c, z, f);
        cr_expect_float_eq(f[0], dot(forward, u), 1e-5, "forward %.9g, %.9g", f[0], dot(forward, u));
        cr_expect_float_eq(f[1], dot(side, u), 1e-5, "sideways %.9g, %.9g", f[1], dot(side, u));
        cr_expect_float_eq(f[2], dot(n, u), 1e-5, "up %.9g, %.9g", f[2], dot(n, u));
    }
    nh_system_free(s);
}

/* What is implied is left out: the second wheel of an axle, the height of a wheel that stays in the plane. */
Test(bodies, implied_conditions_are_left_out)
{
    nh_system *s = parsed("parameters: [{name: r, value: 0.4}]\n"
                          "bodies: [{name: car, mass: 1, inertia: 1}, {name: left, inertia: 1}, {name: right, inertia: 1}]\n"
                          "joints:\n"
                          "  - {type: planar, child: car, coordinates: [x, y, h]}\n"
                          "  - {type: revolute, parent: car, child: left, at: [0, 0.5, r], axis: y, coordinates: [p]}\n"
                          "  - {type: revolute, parent: car, child: right, at: [0, -0.5, r], axis: -y, coordinates: [q]}\n"
                          "wheels:\n"
                          "  - {type: rolling, body: left, axle: y, radius: r}\n"
                          "  - {type: rolling, body: right, axle: y, radius: r}\n");
    cr_assert_eq(s->constraints, 3);
    double z[11] = {0, 0.3, -0.2, 0.7, 0.1, 0.2, 0, 0, 0.9, 0, 0}, f[3], forward = 1.3;
    nh_ex c[3] = {s->constraint[0].lhs, s->constraint[1].lhs, s->constraint[2].lhs};
    z[6] = forward * cos(0.7), z[7] = forward * sin(0.7);
    z[9] = (forward - 0.5 * 0.9) / 0.4, z[10] = -(forward + 0.5 * 0.9) / 0.4;
    at(s, 3, c, z, f);
    for (int i = 0; i < 3; i++) cr_expect_float_eq(f[i], 0, 1e-15, "condition %d is %.3g", i, f[i]);
    z[10] += 0.1;
    at(s, 3, c, z, f);
    cr_expect_gt(fabs(f[0]) + fabs(f[1]) + fabs(f[2]), 0.01);
    nh_system_free(s);
}

/* On a table that turns at the rate W a ball at rest in space slips, one that goes with the table does not. */
Test(bodies, wheels_on_a_moving_surface)
{
    nh_system *s = parsed("parameters: [{name: W, value: 0.8}]\n"
                          "bodies: [{name: table}, {name: place}, {name: ball, mass: 1, inertia: 0.4}]\n"
                          "joints:\n"
                          "  - {type: revolute, child: table, axis: z, values: [W*t]}\n"
                          "  - {type: translation, axes: [x, y], child: place, coordinates: [x, y]}\n"
                          "  - {type: spherical, parent: place, child: ball, angles: zxz, coordinates: [a, b, c]}\n"
                          "wheels: [{type: ball, body: ball, radius: 0.5, on: table}]\n");
    cr_assert_eq(s->constraints, 2);
    double z[11] = {0.6, 0.7, -0.4, 0.3, 0.8, 0.2, 0.8 * 0.4, 0.8 * 0.7, 0.8, 0, 0}, f[2]; /* p = W: the ball turns with the table */
    nh_ex c[2] = {s->constraint[0].lhs, s->constraint[1].lhs};
    at(s, 2, c, z, f);
    cr_expect_float_eq(f[0], 0, 1e-15);
    cr_expect_float_eq(f[1], 0, 1e-15);
    for (int i = 6; i < 11; i++) z[i] = 0;
    at(s, 2, c, z, f);
    cr_expect_float_eq(hypot(f[0], f[1]), 0.8 * hypot(0.7, 0.4), 1e-14);
    nh_system_free(s);
}

/* ---- the crane ---- */

static const char *const CRANE[] = {"l", "l0", "l1", "l2", "b", "c", "m1", "m2", "m3", "m4", "m6", "jz1", "jx2", "jz3", "jx4", "jy4", "jx6", "jy6"};
enum { crane_parameters = sizeof CRANE / sizeof *CRANE };

static mechanics crane(const char *path, const cJSON *set, nh_chart_choice choice)
{
    nh_setting setting[crane_parameters];
    for (size_t i = 0; i < crane_parameters; i++) setting[i] = (nh_setting){.name = CRANE[i], .value = oracle_number(oracle_get(set, "params"), CRANE[i])};
    return mechanics_of_file(path, choice, crane_parameters, setting);
}

static const cJSON *crane_set(cJSON *all)
{
    return oracle_get(all, "sets")->child;
}

/* K, the constraints, and the motion's accelerations in all coordinates, against 40 digits. */
Test(bodies, crane_against_the_oracle, PLAIN_ONLY)
{
    cJSON *all = oracle_read("tests/data/crane_oracle.json");
    const cJSON *set = crane_set(all);
    mechanics x = crane("systems/crane.yaml", set, NH_CHART_QUASI);
    const nh_system *s = x.system;
    tally K = {.what = "K"}, f = {.what = "constraints"}, a = {.what = "rates"}, L = {.what = "Lbar"};
    for (const cJSON *point = oracle_get(set, "points")->child; point; point = point->next) {
        double z[17] = {0}, want[64], got[64], w[4];
        oracle_flat(oracle_get(point, "q_full"), z + 1);
        oracle_flat(oracle_get(point, "qdot_full"), z + 9);
        oracle_flat(oracle_get(point, "K_full"), want);
        at(s, 64, s->chain->K, z, got);
        tally_add(&K, 64, got, want, 0);
        nh_ex c[4] = {s->constraint[0].lhs, s->constraint[1].lhs, s->constraint[2].lhs, s->constraint[3].lhs};
        at(s, 4, c, z, got);
        tally_add(&f, 4, got, (double[]){0, 0, 0, 0}, 1);
        at(s, 1, &s->lagrangian, z, got);
        tally_add(&L, 1, got, (double[]){oracle_number(point, "Lbar")}, 0);
        nh_ex inverse[4];
        cr_assert(nh_chart_inverse(x.model->chart, inverse));
        at(s, 4, inverse, z, w);
        /* accelerations of psi1, psi2, phi1, phi2 along the motion */
        double state[13] = {0}, acc[4], is[4];
        memcpy(state + 1, z + 1, 8 * sizeof *state);
        memcpy(state + 9, w, sizeof w);
        static const size_t index[] = {3, 5, 4, 7}; /* psi1, psi2, phi1, phi2 among the coordinates */
        nh_ex e[4];
        for (int i = 0; i < 4; i++) e[i] = nh_model_gamma(x.model, x.model->rho[index[i]]);
        values_at(x.model, 4, e, state, is);
        oracle_flat(oracle_get(point, "acc"), acc);
        tally_add(&a, 4, is, acc, 0);
    }
    tally_check(&K, 1e-14, "crane");
    tally_check(&f, 1e-14, "crane");
    tally_check(&L, 1e-13, "crane");
    tally_check(&a, 1e-12, "crane");
    cJSON_Delete(all);
    mechanics_clear(&x);
}

/* By bodies and joints and by a Lagrangian written out: the same function, the same distribution. */
Test(bodies, crane_in_two_ways)
{
    nh_error error = {0};
    nh_system *a = nh_system_read("systems/crane.yaml", 0, NULL, &error), *b = nh_system_read("systems/crane_lagrangian.yaml", 0, NULL, &error);
    must(a && b, &error, "the cranes");
    double z[17], L[2], F[64];
    cr_assert_eq(a->coordinates, b->coordinates);
    cr_assert_eq(a->constraints, 4);
    for (size_t i = 0; i < 8; i++) cr_expect_str_eq(a->coordinate[i].name, b->coordinate[i].name);
    for (uint64_t seed = 1; seed <= 6; seed++) {
        random_state(a, seed, z);
        at(a, 1, &a->lagrangian, z, L);
        at(b, 1, &b->lagrangian, z, L + 1);
        cr_expect_leq(fabs(L[0] - L[1]), 1e-14 * fabs(L[0]), "%.17g, %.17g", L[0], L[1]);
        nh_ex row[64]; /* both sets of one-forms, stacked: of rank 4 */
        for (int k = 0; k < 8; k++) {
            const nh_system *s = k < 4 ? a : b;
            for (int i = 0; i < 8; i++) row[i] = nh_diff(s->dag, nh_sub(s->dag, s->constraint[k % 4].lhs, s->constraint[k % 4].rhs), s->coordinate[i].v);
            at(s, 8, row, z, F + 8 * k);
        }
        double s8[8];
        cr_assert(nh_svd(8, 8, F, s8, NULL, NULL));
        cr_expect_gt(s8[3], 0.05);
        cr_expect_lt(s8[4], 1e-14);
    }
    nh_system_free(a);
    nh_system_free(b);
}

/* K of a car with trailers is what the file's own definitions say, and its chart satisfies the constraints (checked on reading). */
Test(bodies, energies_written_by_hand)
{
    static const char *const names[] = {"car_trailers_5", "two_wheel_cart", "cart_rotor", "spherical_robot", "crane"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        if (!sweep_tries(i + 3, 1, 5)) continue;
        char path[100];
        snprintf(path, sizeof path, "systems/%s.yaml", names[i]);
        mechanics x = mechanics_of_file(path, NH_CHART_QUASI, 0, NULL);
        double z[17] = {0}, T[2];
        nh_ex energy = 0;
        for (size_t k = 0; k < x.system->currents; k++)
            if (!strcmp(x.system->current[k].name, "energy")) energy = x.system->current[k].value;
        random_state(x.system, 8, z);
        at(x.system, 2, (nh_ex[]){x.system->chain->kinetic, energy}, z, T);
        cr_expect_leq(fabs(T[0] - T[1]), 1e-13 * T[0], "%s: %.17g, %.17g", names[i], T[0], T[1]);
        mechanics_clear(&x);
    }
}

/* Newton and Euler against Lagrange: c = X_0(dL/dq') - dL/dq with X_0 = d/dt + q' d/dq, also where joints are driven or geared. */
Test(bodies, bias_agrees_with_the_lagrangian, PLAIN_ONLY)
{
    nh_system *s = parsed("gravity: [0.4, -1, -9]\n"
                          "bodies:\n"
                          "  - {name: a, mass: 1.2, center: [0.1, 0.2, 0.3], inertia: [[0.5, 0.1, 0], [0.1, 0.6, -0.05], [0, -0.05, 0.7]]}\n"
                          "  - {name: b, mass: 0.8, center: [0, -0.3, 0.1], inertia: [0.2, 0.3, 0.4]}\n"
                          "  - {name: c, mass: 0.5, center: [0.4, 0, 0], inertia: 0.1}\n"
                          "joints:\n"
                          "  - {type: spherical, child: a, at: [0, 0, 1], coordinates: [u, v, w]}\n"
                          "  - {type: helical, pitch: 0.3, axis: [1, 1, 0], parent: a, child: b, at: [0.5, 0, 0], values: [t^2/3 + sin(u)*r]}\n"
                          "  - {type: cylindrical, axis: y, parent: a, child: c, rotation: {x: 0.4}, coordinates: [r, h]}\n");
    nh_dag *d = s->dag;
    size_t m = s->coordinates;
    nh_ex q[8], v[8], bias[8], other[8];
    double z[17], got[8], want[8];
    cr_assert_eq(m, 5);
    for (size_t i = 0; i < m; i++) q[i] = s->coordinate[i].q, v[i] = s->coordinate[i].v;
    nh_chain_bias(s->chain, &(nh_chain_scope){.dag = d, .arena = s->arena, .t = s->t, .m = m, .q = q, .v = v}, bias);
    for (size_t i = 0; i < m; i++) other[i] = nh_sub(d, rate(s, nh_diff(d, s->lagrangian, v[i])), nh_diff(d, s->lagrangian, q[i]));
    for (uint64_t seed = 1; seed <= 5; seed++) {
        random_state(s, seed, z);
        at(s, m, bias, z, got);
        at(s, m, other, z, want);
        for (size_t i = 0; i < m; i++) cr_expect_leq(fabs(got[i] - want[i]), 1e-13 * (5 + fabs(want[i])), "component %zu: %.17g, %.17g", i, got[i], want[i]);
    }
    nh_system_free(s);
}

/* A large chain in a chart that moves, with a further term in its Lagrangian: M a = A is Lagrange's equation of the whole. */
Test(bodies, large_chains_with_wheels, PLAIN_ONLY)
{
    mechanics x = mechanics_of_text("parameters: [{name: W, value: 0.7}, {name: l, value: 0.8}]\n"
                                    "gravity: [0.3, 0.2, -9]\n"
                                    "bodies:\n  - {name: disc}\n  - {name: car, mass: 1.1, inertia: 0.3, center: [0.2, 0.1, 0]}\n  - {name: one, mass: 0.9, inertia: 0.2, center: [-0.4, 0, 0.2]}\n"
                                    "  - {name: two, mass: 0.7, inertia: [0.1, 0.2, 0.3], center: [-0.3, 0.1, 0.3]}\n  - {name: arm, mass: 0.6, inertia: [0.2, 0.1, 0.1], center: [0.1, 0.2, 0.5]}\n"
                                    "joints:\n  - {type: revolute, child: disc, values: [W*t]}\n  - {type: planar, child: car, coordinates: [x, y, h]}\n"
                                    "  - {type: revolute, parent: car, child: one, at: [-l, 0, 0], coordinates: [a]}\n  - {type: revolute, axis: [0, 1, 1], parent: one, child: two, at: [-l, 0, 0], coordinates: [b]}\n"
                                    "  - {type: spherical, parent: two, child: arm, at: [0, 0, 1], coordinates: [u, v, w]}\n"
                                    "wheels: [{type: knife-edge, body: car, axis: y, on: disc}]\n"
                                    "dependent: [y]\ndomain: {h: [-1, 1]}\nlagrangian: x*a'*cos(b) - b^2*x^2\n", NH_CHART_AUTO);
    const nh_model *o = x.model;
    nh_dag *d = o->dag;
    cr_assert_gt(nh_complexity(d, x.system->lagrangian), 3000);
    nh_points *points = points_of(o, 6, 3);
    for (size_t p = 0; p < points->count; p++) {
        double z[40], size = 0;
        point_of(points, p, z);
        for (size_t i = 0; i < o->n; i++) {
            nh_ex want = nh_int(d, 0);
            for (size_t s = 0; s < o->m; s++) {
                nh_ex force = nh_sub(d, nh_model_compose(o, nh_diff(d, x.system->lagrangian, x.system->coordinate[s].q)), nh_model_X0(o, o->p[s]));
                want = nh_add(d, want, nh_mul(d, o->R[s * o->n + i], force));
            }
            double a = value_at(o, o->A[i], z), b = value_at(o, want, z);
            size = fmax(size, fabs(b));
            cr_expect_leq(fabs(a - b), 1e-12 * (1 + size), "A_%zu: %.17g, %.17g", i, a, b);
        }
    }
    nh_points_free(points);
    mechanics_clear(&x);
}

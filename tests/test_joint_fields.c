/* Closed forms of the symmetries of chains: what the jets count is given by the displacements of the joints. */
#include "reduced.h"
#include "sweep.h"

#include "exact/normal.h"
#include "reduction/chain.h"
#include "reduction/group.h"
#include "reduction/joint.h"

#define HEAD "parameters: [{name: g, value: 9.81}, {name: al, value: 0.4}, {name: A, value: 0.4}, {name: m, value: 1.2}]\n"

typedef struct {
    const char *name, *text, *group;
    size_t dimension;
} chain;

static const chain chains[] = {
    {"ball on a column", "bodies: [{name: a, mass: 1, inertia: 0.7}, {name: b, mass: m, inertia: [A, A, A]}]\njoints:\n  - {type: revolute, child: a, coordinates: [p]}\n"
     "  - {type: spherical, parent: a, child: b, at: [0.5, 0, 0.9], coordinates: [u, v, w]}\n", "SO(3)^2 x SO(2)", 7},
    {"ball on a tilted column", "bodies: [{name: a, mass: 1, inertia: [0.5, 0.6, 0.7]}, {name: b, mass: m, inertia: [A, A, A]}]\njoints:\n"
     "  - {type: revolute, axis: y, child: a, rotation: {x: al}, coordinates: [p]}\n"
     "  - {type: spherical, parent: a, child: b, rotation: {y: 0.3}, at: [0.5, 0, 0.9], angles: zxz, coordinates: [u, v, w]}\n", "SO(3)^2 x SO(2)", 7},
    {"free, turned about y", "gravity: g\nbodies: [{name: b, mass: m, inertia: [A, 0.6, 0.7], center: [0.1, 0.2, 0.3]}]\njoints:\n"
     "  - {type: free, child: b, rotation: {y: al}, coordinates: [x, y, z, u, v, w]}\n", "SO(3) x SE(2)", 6},
    {"round and free, turned about x", "gravity: g\nbodies: [{name: b, mass: m, inertia: [A, A, 0.7]}]\njoints:\n"
     "  - {type: free, child: b, rotation: {x: al}, coordinates: [x, y, z, u, v, w]}\n", "SO(3) x SE(2) x SO(2)", 7},
    {"free ball, its centre elsewhere", "bodies: [{name: b, mass: m, inertia: A, center: [0.1, 0, 0]}]\njoints:\n  - {type: free, child: b, coordinates: [x, y, z, u, v, w]}\n", "SE(3) x SO(3)^2", 12},
    {"cylinder in a turned sphere", "bodies: [{name: a, mass: 1, inertia: [0.3, 0.4, 0.5]}, {name: b, mass: m, inertia: [A, A, 0.2]}]\njoints:\n"
     "  - {type: spherical, child: a, rotation: {y: al}, coordinates: [u, v, w]}\n  - {type: cylindrical, parent: a, child: b, axis: z, coordinates: [s, p]}\n", "SO(3) x SO(2)", 4},
    {"helix on an oblique slide", "bodies: [{name: a, mass: 1}, {name: b, mass: m, inertia: [A, A, 0.2]}]\njoints:\n  - {type: prismatic, axis: [1, 2, 2], child: a, coordinates: [x]}\n"
     "  - {type: helical, parent: a, child: b, axis: z, pitch: 0.2, coordinates: [p]}\n", NULL, 3},
    {"ball on a slide", "bodies: [{name: a, mass: 1}, {name: b, mass: m, inertia: [A, 0.5, 0.6]}]\njoints:\n  - {type: prismatic, axis: [1, 2, 2], child: a, coordinates: [x]}\n"
     "  - {type: spherical, parent: a, child: b, rotation: {y: al}, coordinates: [u, v, w]}\n", "SO(3) x R", 4},
    {"top on a cart, turned about x", "gravity: g\nbodies: [{name: a, mass: 1}, {name: b, mass: m, inertia: [A, A, 0.6], center: [0, 0, 0.4]}]\njoints:\n"
     "  - {type: translation, axes: [x, z], rotation: {x: pi/2}, child: a, coordinates: [x, y]}\n  - {type: spherical, parent: a, child: b, coordinates: [u, v, w]}\n", NULL, 5},
    {"ball in an arm", "bodies: [{name: a, mass: 1, inertia: [0.3, 0.4, 0.5], center: [0.2, 0, 0]}, {name: b, mass: m, inertia: A}]\njoints:\n"
     "  - {type: spherical, child: a, coordinates: [a1, a2, a3]}\n  - {type: spherical, parent: a, child: b, at: [0.5, 0, 0], coordinates: [u, v, w]}\n", "SO(3)^3", 9},
    {"ball in two arms", "bodies: [{name: a, mass: 1, inertia: [0.3, 0.4, 0.5]}, {name: c, mass: 0.5, inertia: [0.1, 0.2, 0.25]}, {name: b, mass: m, inertia: A}]\njoints:\n"
     "  - {type: revolute, axis: y, child: a, coordinates: [p]}\n  - {type: revolute, axis: x, parent: a, child: c, at: [0.4, 0, 0], coordinates: [q]}\n"
     "  - {type: spherical, parent: c, child: b, at: [0, 0.5, 0], coordinates: [u, v, w]}\n", "SO(3)^2 x SO(2)", 7},
    {"two free bodies", "gravity: g\nbodies: [{name: a, mass: 1, inertia: [0.3, 0.4, 0.5]}, {name: b, mass: m, inertia: [A, 0.2, 0.3], center: [0, 0.1, 0]}]\njoints:\n"
     "  - {type: free, child: a, rotation: {x: 0.3}, coordinates: [x, y, z, a1, a2, a3]}\n"
     "  - {type: revolute, axis: [0, 0.6, 0.8], parent: a, child: b, at: [0.5, 0, 0], coordinates: [u]}\n", "SO(3) x SE(2)", 6},
    {"a free body by two joints", "bodies: [{name: a}, {name: b, mass: m, inertia: [A, 0.5, 0.6], center: [0.1, 0.2, 0]}]\njoints:\n"
     "  - {type: translation, axes: [x, y, z], child: a, coordinates: [x, y, z]}\n  - {type: spherical, parent: a, child: b, coordinates: [u, v, w]}\n", "SE(3) x SO(3)", 9},
    {"hand of a SCARA robot", "gravity: g\nbodies: [{name: a, mass: 1, inertia: [0.3, 0.4, 0.5], center: [0.1, 0.2, 0]}, {name: b, mass: m, inertia: [A, A, 0.2], center: [0.2, 0, 0]}]\njoints:\n"
     "  - {type: schoenflies, child: a, coordinates: [x, y, z, h]}\n  - {type: revolute, parent: a, child: b, at: [0.4, 0, 0], coordinates: [p]}\n", "SE(2) x SO(2)", 4},
    {"two plates", "bodies: [{name: a, mass: 1, inertia: [0.3, 0.4, 0.5], center: [0.1, 0, 0]}, {name: b, mass: m, inertia: [A, 0.3, 0.2], center: [0.2, 0, 0]}]\njoints:\n"
     "  - {type: planar, axis: y, child: a, coordinates: [x, y, h]}\n  - {type: revolute, axis: y, parent: a, child: b, at: [0.4, 0, 0], coordinates: [p]}\n", NULL, 4},
};

Test(joint_fields, give_what_the_jets_count)
{
    for (size_t i = 0; i < sizeof chains / sizeof *chains; i++) {
        if (!sweep_tries(i, 2, 5)) continue;
        nh_error error = {0};
        nh_options options;
        nh_options_default(&options);
        nh_text text;
        nh_text_init(&text);
        nh_text_addf(&text, "name: test\n" HEAD "%s", chains[i].text);
        reducible x = reducible_make(nh_system_parse("test.yaml", nh_text_string(&text), 0, NULL, &error), 1, &error);
        cr_assert_not_null(x.kinetic, "%s: %s", chains[i].name, error.what);
        nh_group *g = nh_group_find(x.kinetic, &options, &error);
        must(g != NULL, &error, chains[i].name);
        cr_expect_eq(g->jets->dimension, chains[i].dimension, "%s: %zu symmetries", chains[i].name, g->jets->dimension);
        cr_expect_eq(g->missing, 0, "%s: %zu without a closed form", chains[i].name, g->missing);
        cr_expect(g->action.closes, "%s: closure %g", chains[i].name, g->action.closure);
        if (chains[i].group) cr_expect_str_eq(g->name, chains[i].group, "%s: %s", chains[i].name, g->name);
        for (size_t a = 0; a < g->action.d; a++) {
            const nh_generator *e = &g->action.generator[a];
            cr_expect(e->metric.proved && e->potential.proved && e->constraints.proved, "%s: generator %zu is not proved", chains[i].name, a + 1);
        }
        nh_group_free(g);
        reducible_clear(&x);
        nh_text_clear(&text);
    }
}

/* Through its own centre of mass the hand's last axis leaves a flat metric of 15 symmetries, of which some have no closed form: a bracket that is one of
 * those is said to be none of the combinations; all others are, by differences of the fields. */
Test(joint_fields, brackets_that_leave_the_closed_forms, WHOLE_ONLY)
{
    enum { m = 5, most = 15 };
    static const double h = 1e-5, q0[m] = {0.3, -0.2, 0.4, 0.7, -0.5};
    nh_error error = {0};
    nh_options options;
    nh_options_default(&options);
    reducible x = reducible_make(nh_system_parse("test.yaml", "name: test\n" HEAD
        "bodies: [{name: a, mass: 1, inertia: [0.3, 0.4, 0.5], center: [0.1, 0.2, 0]}, {name: b, mass: m, inertia: [A, A, 0.2]}]\njoints:\n"
        "  - {type: schoenflies, child: a, coordinates: [x, y, z, h]}\n  - {type: revolute, parent: a, child: b, at: [0.4, 0, 0], coordinates: [p]}\n", 0, NULL, &error), 1, &error);
    cr_assert_not_null(x.kinetic, "%s", error.what);
    nh_group *g = nh_group_find(x.kinetic, &options, &error);
    must(g != NULL, &error, "the group");
    const nh_action *action = &g->action;
    size_t d = action->d, outside = 0;
    cr_assert(g->jets->dimension == 15 && g->missing > 0 && d <= most && !action->closes);
    double E[m * most], above[m][m * most], below[m][m * most], q[m];
    nh_action_values(action, q0, E);
    for (size_t s = 0; s < m; s++) {
        memcpy(q, q0, sizeof q);
        q[s] += h, nh_action_values(action, q, above[s]);
        q[s] -= 2 * h, nh_action_values(action, q, below[s]);
    }
    for (size_t a = 0; a < d; a++)
        for (size_t b = 0; b < d; b++) {
            bool left = action->outside[a * d + b];
            outside += left;
            for (size_t i = 0; i < m && !left; i++) {
                double bracket = 0, sum = 0;
                for (size_t s = 0; s < m; s++) {
                    bracket += E[s + a * m] * (above[s][i + b * m] - below[s][i + b * m]) / (2 * h);
                    bracket -= E[s + b * m] * (above[s][i + a * m] - below[s][i + a * m]) / (2 * h);
                }
                for (size_t k = 0; k < d; k++) sum -= action->algebra.c[(a * d + b) * d + k] * E[i + k * m];
                cr_expect_float_eq(bracket, sum, 1e-8, "[e_%zu, e_%zu] along %zu: %g, %g", a + 1, b + 1, i, bracket, sum);
            }
        }
    cr_expect_gt(outside, 0);
    nh_group_free(g);
    reducible_clear(&x);
}

/* A sum of several fields of joints with the parameters in its coefficients: a plate turns about its centre of mass. */
Test(joint_fields, coefficients_over_the_parameters)
{
    nh_error error = {0};
    nh_options options;
    nh_options_default(&options);
    nh_system *s = nh_system_parse("test.yaml", "parameters: [{name: c, value: 0.37}, {name: J, value: 0.61}]\nbodies: [{name: a, mass: 1, inertia: J, center: [c, 0, 0]}]\n"
                                                "joints: [{type: planar, child: a, coordinates: [x, y, h]}]\n", 0, NULL, &error);
    nh_joint_fields f;
    nh_joint_fields_init(&f, s);
    cr_expect_geq(f.count, 6);
    for (size_t i = 0; i < f.count; i++)
        for (size_t j = 0; j < i; j++) cr_expect_neq(memcmp(f.component + i * f.m, f.component + j * f.m, f.m * sizeof *f.component), 0, "fields %zu and %zu", i, j);
    nh_joint_fields_clear(&f);
    reducible x = reducible_make(s, 1, &error);
    nh_group *g = nh_group_find(x.kinetic, &options, &error);
    must(g != NULL, &error, "the group");
    for (size_t a = 0; a < g->action.d; a++) cr_expect(g->action.generator[a].metric.all_parameters, "generator %zu", a + 1);
    nh_group_free(g);
    reducible_clear(&x);
}

/* Displacements of space are named by the joint's axes, which are exact, not by numbers found at the parameters' values. */
Test(joint_fields, displacements_of_space_are_exact)
{
    nh_error error = {0};
    nh_system *s = nh_system_parse("test.yaml", "parameters: [{name: al, value: 0.37}, {name: h, value: 0.21}]\nbodies: [{name: a, mass: 1, inertia: 0.3}, {name: b, mass: 2, inertia: 0.1, center: [0.2, 0, 0]}]\n"
                                                "joints:\n  - {type: planar, child: a, rotation: {y: al}, coordinates: [x, y, p]}\n  - {type: helical, child: b, axis: [1, 2, 2], pitch: h, coordinates: [q]}\n", 0, NULL, &error);
    nh_chain_symmetries *c = nh_chain_symmetries_find(s, 5, &error);
    must(c != NULL, &error, "symmetries");
    size_t moves = 0;
    for (size_t i = 0; i < c->fields; i++) {
        if (c->field[i].rule != NH_CHAIN_AP1) continue;
        moves++;
        for (size_t k = 0; k < s->coordinates; k++) {
            nh_ex e = c->field[i].component[k];
            cr_expect_not(nh_depends(s->dag, e, s->parameter[0].symbol) || nh_depends(s->dag, e, s->parameter[1].symbol), "field %zu, component %zu", i, k);
            cr_expect(nh_is_exact(s->dag, e), "field %zu, component %zu", i, k);
        }
    }
    cr_expect_eq(moves, 4, "%zu", moves); /* x, y, p of one body, q of the other */
    nh_chain_symmetries_free(c);
    nh_system_free(s);
}

/* reduce: the command's whole pipeline on every shipped system, its JSON, and what it says about groups that will not do. */
#include "oracle.h"
#include "reduced.h"

#include <stdio.h>
#include <stdlib.h>

#include "document/export.h"
#include "document/reduction.h"
#include "scratch.h"
#include "sweep.h"

static nh_reduction *reduce_path(const char *path, const char *group, const char *chain, const char *initial, uint64_t seed, nh_error *error)
{
    nh_request q = {.system_path = path, .group = group, .chain = chain, .initial = initial};
    nh_options_default(&q.options);
    q.options.seed = (double)seed;
    return nh_reduction_create(&q, error);
}

/* A system written to a file of its own. */
static nh_reduction *reduce_text(const char *text, const char *group, uint64_t seed, nh_error *error)
{
    char path[SCRATCH];
    cr_assert(scratch_text(path, text));
    nh_reduction *r = reduce_path(path, group, NULL, NULL, seed, error);
    remove(path);
    return r;
}

static const struct {
    const char *system, *group;
    size_t dimension;
} catalogue[] = {
    {"appell_hamel", "SE(2)", 3},     {"ball_on_turntable", "SO(3) x SO(2)", 4},  {"chaplygin_ball", "SE(2)", 3},      {"contact_oscillator", "R", 1},
    {"crane", "SE(2) x SO(2)^3", 6},  {"euler_top", "SO(3)", 3},            {"free_particle", "SE(3)", 6},       {"heisenberg_particle", "SO(2) x R", 2},
    {"henon_heiles", "trivial", 0},   {"isotropic_oscillator", "SO(3)", 3}, {"kepler", "SO(3)", 3},              {"knife_edge", "SE(2)", 3},
    {"nonholonomic_particle", "R^2", 2}, {"rolling_ball", "SO(3) x SE(2)", 6}, {"rolling_disk", "SE(2) x SO(2)", 4}, {"routh_sphere", "SE(2) x SO(2)", 4},
    {"sleigh", "SE(2)", 3},           {"sleigh_inertia", "SE(2)", 3},       {"suslov", "SO(3)", 3},              {"two_wheel_carriage", "SE(2) x R^2", 5},
    {"vertical_disk", "SE(2) x R", 4}, {"neumann", "trivial", 0},          {"snakeboard", "SE(2) x SO(2)", 4},  {"two_wheel_cart", "SE(2) x SO(2)^2", 5},
    {"three_bodies", "SE(2) x SO(2)", 4}, {"calogero_moser", "R", 1},       {"ball_on_slope", "SO(3) x R", 4},   {"roller_racer", "SE(2)", 3},
    {"cart_rotor", "SE(2) x SO(2)", 4}, {"cart_on_disc", "SO(2)", 1},       {"charged_particle", "SO(2) x R", 2}, {"foucault_pendulum", "SO(2)", 1},
    {"skate_with_friction", "SE(2)", 3}, {"bead_on_turning_wire", "SO(2)", 1}, {"car_trailers_2", "SE(2)", 3}, {"euler_disk", "SE(2) x SO(2)", 4},
    {"spherical_robot", "SE(2) x SO(2)^2", 5}, {"rattleback", "SE(2)", 3},  {"veselova", "SO(2)", 1},            {"double_pendulum", "trivial", 0},
};

Test(reduce, groups_and_motions_of_the_shipped_systems)
{
    for (size_t i = 0; i < sizeof catalogue / sizeof *catalogue; i++) {
        if (!sweep_tries(i, 9, 27)) continue;
        char path[100];
        nh_error error = {0};
        snprintf(path, sizeof path, "systems/%s.yaml", catalogue[i].system);
        size_t compared = 0;
        nh_reduction *r = reduce_path(path, NULL, NULL, NULL, 1, &error);
        must(r != NULL, &error, path);
        cr_expect_str_eq(r->all->name, catalogue[i].group, "%s: %s", catalogue[i].system, r->all->name);
        cr_expect_eq(r->all->action.d, catalogue[i].dimension, "%s: %zu generators", catalogue[i].system, r->all->action.d);
        for (size_t a = 0; a < r->all->action.d; a++) {
            const nh_generator *g = &r->all->action.generator[a];
            cr_expect(g->metric.proved && g->potential.proved && g->constraints.proved, "%s: generator %zu is not proved", catalogue[i].system, a + 1);
        }
        for (size_t s = 0; s < r->stages; s++) {
            const nh_reduction_stage *t = &r->stage[s];
            cr_expect(t->compared || t->note[0], "%s, stage %zu is silent", catalogue[i].system, s + 1);
            compared += t->compared;
            cr_expect(t->agreement <= 100 * r->options.tolerance, "%s, stage %zu (%s): %g", catalogue[i].system, s + 1, nh_stage_kind_name(t->kind), t->agreement);
            cr_expect(t->reached >= r->full_reached, "%s, stage %zu: up to %g of %g: %s", catalogue[i].system, s + 1, t->reached, r->full_reached, t->note);
            if (r->kinetic->linear) cr_expect(t->energy_drift <= 100 * r->options.tolerance, "%s, stage %zu: energy drifts by %g", catalogue[i].system, s + 1, t->energy_drift);
        }
        bool short_one = !strcmp(catalogue[i].system, "snakeboard") || !strcmp(catalogue[i].system, "euler_disk"); /* axles become parallel; a sensitive motion */
        cr_expect(r->stages == 0 || short_one || r->full_reached >= r->until, "%s: the full motion is known up to %g", catalogue[i].system, r->full_reached);
        cr_expect(compared > 0 || r->stages == 0, "%s: nothing is compared", catalogue[i].system);
        for (size_t k = 0; k < r->momenta.count; k++) cr_expect(r->momenta.momentum[k].proof.proved, "%s: momentum %zu", catalogue[i].system, k + 1);
        nh_reduction_free(r);
    }
}

/* The crane: three kinds of stages, each over ten units of time. */
Test(reduce, crane, PLAIN_ONLY)
{
    for (uint64_t seed = 1; seed <= 3; seed++) {
        if (!sweep_tries(seed - 1, 2, 3)) continue;
        nh_error error = {0};
        nh_reduction *r = reduce_path("systems/crane.yaml", NULL, NULL, NULL, seed, &error);
        must(r != NULL, &error, "crane");
        cr_assert_eq(r->stages, 3);
        cr_expect_eq(r->stage[0].kind, NH_STAGE_CHAPLYGIN);
        cr_expect_str_eq(r->stage[0].group, "SE(2) x SO(2)");
        cr_expect_eq(r->stage[1].kind, NH_STAGE_SECOND);
        cr_expect_eq(r->stage[2].kind, NH_STAGE_POINCARE);
        for (size_t s = 0; s < 3; s++) {
            cr_expect_eq(r->stage[s].reached, 10.0, "seed %d, stage %zu: up to %g", (int)seed, s + 1, r->stage[s].reached);
            cr_expect(r->stage[s].agreement <= 1e-8);
        }
        cr_expect(r->stage[2].by_stages && r->stage[2].poincare.stages_vertical < 1e-12 && r->stage[2].poincare.stages_horizontal < 1e-12);
        cr_expect_eq(r->momenta.count, 2); /* of phi1, and of the front axle with its wheels */
        cr_expect(r->momenta.momentum[0].horizontal && r->momenta.momentum[1].of_lagrangian);
        cr_expect_eq(r->all->jets->of_metric, 22);
        nh_reduction_free(r);
    }
}

/* The same numbers of a group whatever the seed: dimension, and the structure constants of the closed forms. */
Test(reduce, structure_constants_do_not_depend_on_the_seed, WHOLE_ONLY)
{
    double c[216];
    for (uint64_t seed = 1; seed <= 4; seed++) {
        if (!sweep_tries(seed - 1, 3, 3)) continue;
        nh_error error = {0};
        nh_reduction *r = reduce_path("systems/crane.yaml", NULL, NULL, NULL, seed, &error);
        must(r != NULL, &error, "crane");
        cr_assert_eq(r->all->action.d, 6);
        if (seed == 1) memcpy(c, r->all->action.algebra.c, sizeof c);
        for (size_t i = 0; i < 216; i++) cr_expect_eq(c[i], r->all->action.algebra.c[i]);
        nh_reduction_free(r);
    }
}

/* Perturbed systems have no symmetry, or only the one that is left. */
Test(reduce, perturbed_systems)
{
    static const char head[] = "name: s\nparameters: [{name: m, value: 1.3}, {name: J, value: 0.7}, {name: a, value: 0.4}]\n"
                               "coordinates:\n  - {name: x, type: length}\n  - {name: y, type: length}\n  - {name: h, type: angle}\n"
                               "constraints: [\"x'*sin(h) - y'*cos(h) = 0\"]\nlagrangian: J*h'^2/2 + m*((x' - a*h'*sin(h))^2 + (y' + a*h'*cos(h))^2)/2";
    static const struct {
        const char *more;
        size_t dimension;
    } cases[] = {{"\n", 3}, {" - x\n", 1}, {" - x*y - 0.3*cos(h)\n", 0}, {" + 0.01*x^2*h'^2 + 0.02*y*x'^2\n", 0}, {" - x^2 - y^2\n", 1}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        nh_error error = {0};
        char text[1200];
        snprintf(text, sizeof text, "%s%s", head, cases[i].more);
        nh_reduction *r = reduce_text(text, NULL, 1, &error);
        must(r != NULL, &error, cases[i].more);
        cr_expect_eq(r->all->action.d + r->all->missing, cases[i].dimension, "%s: %zu", cases[i].more, r->all->action.d);
        nh_reduction_free(r);
    }
}

static void refused(const char *system, const char *group, const char *chain, const char *words)
{
    nh_error error = {0};
    nh_reduction *r = reduce_path(system, group, chain, NULL, 1, &error);
    cr_expect(r == NULL, "%s is accepted", group ? group : chain);
    cr_expect(strstr(error.what, words) != NULL, "%s: %s", group ? group : chain, error.what);
    nh_reduction_free(r);
}

Test(reduce, bad_groups_are_explained)
{
    refused("systems/sleigh.yaml", "x=1; phi=1, x=-y, y=x", NULL, "[d/dx, d/dphi - y d/dx + x d/dy] = d/dy is not a linear combination of them");
    refused("systems/sleigh.yaml", "phi=1", NULL, "does not leave the kinetic energy invariant");
    refused("systems/rolling_disk.yaml", "p=1", NULL, "does not leave the constraint distribution invariant");
    refused("systems/kepler.yaml", "x=-y, y=x; y=-z, z=y; z=-x, x=z", NULL, "the action is not free: 3 fields, but an orbit of dimension 2 at x = ");
    refused("systems/sleigh.yaml", "1, 7", NULL, "there is no generator 7");
    refused("systems/sleigh.yaml", "phj=1", NULL, "`phj` is not a coordinate");
    refused("systems/sleigh.yaml", "x", NULL, "is not a component of a vector field");
    refused("systems/sleigh.yaml", "x=y'", NULL, "contains a velocity");
    refused("systems/sleigh.yaml", "x=1+", NULL, "");
    refused("systems/vertical_disk.yaml", NULL, "1; 4; 2, 3", "a subgroup of the chain is not normal in the one before it");
    refused("systems/vertical_disk.yaml", NULL, "1, 2", "must name every generator of the group once");
}

/* A smaller group, given: its own stage and momenta. */
/* The equations of motion know better what is wrong than the metric. */
Test(reduce, a_singular_Lagrangian_is_explained)
{
    nh_error error = {0};
    nh_reduction *r = reduce_text("coordinates: [x, y]\nlagrangian: x*y' - y*x' - x^2 - y^2\n", NULL, 1, &error);
    cr_expect_null(r);
    cr_expect(strstr(error.what, "the Lagrangian is linear in the velocities"), "%s", error.what);
    cr_expect(strstr(error.where, ":2:"), "%s", error.where);
    nh_reduction_free(r);
}

Test(reduce, given_groups)
{
    nh_error error = {0};
    nh_reduction *r = reduce_path("systems/two_wheel_carriage.yaml", "x=1; y=1; p=1, x=-y, y=x", NULL, "x=0.3, p=0.2, x'=0.7, p'=0.5", 1, &error);
    must(r != NULL, &error, "given");
    cr_expect(r->group->given && r->all == NULL);
    cr_expect_str_eq(r->group->name, "SE(2)");
    cr_assert_eq(r->stages, 1);
    cr_expect_eq(r->stage[0].kind, NH_STAGE_CHAPLYGIN);
    cr_expect(r->stage[0].compared && r->stage[0].agreement < 1e-8, "%g", r->stage[0].agreement);
    cr_expect_float_eq(r->initial.v[1], 0.7 * tan(0.2), 1e-12, "what is not named follows from the constraints");
    cr_expect_eq(r->initial.v[0], 0.7);
    cr_expect_eq(r->warnings, 0);
    cr_expect(r->stage[0].measure.measure && r->stage[0].measure.factor);
    nh_reduction_free(r);
}

static const char SKATE[] = "name: s\nparameters: [{name: m, value: 1.3}, {name: J, value: 0.7}]\n"
    "coordinates:\n  - {name: x, type: length}\n  - {name: y, type: length}\n  - {name: h, type: angle}\n"
    "constraints: [\"x'*sin(h) - y'*cos(h) = 0\"]\nlagrangian: J*h'^2/2 + m*(x'^2 + y'^2)/2\n";

Test(reduce, groups_of_the_system_file)
{
    char text[900];
    nh_error error = {0};
    snprintf(text, sizeof text, "%ssymmetry:\n  - {x: 1}\n  - {y: 1}\n", SKATE);
    nh_reduction *r = reduce_text(text, NULL, 1, &error);
    must(r != NULL, &error, "symmetry");
    cr_expect_str_eq(r->group->name, "R^2");
    cr_expect(r->stages > 0 && r->stage[0].agreement < 1e-8);
    nh_reduction_free(r);
    snprintf(text, sizeof text, "%ssymmetry:\n  - {x: 1}\n  - {z: 1}\n", SKATE);
    cr_expect(reduce_text(text, NULL, 1, &error) == NULL);
    cr_expect(strstr(error.what, "`z` is not a coordinate") && strstr(error.where, ":11:6"), "%s at %s", error.what, error.where);
    nh_error_clear(&error);
    snprintf(text, sizeof text, "%ssymmetry:\n  - {x: y'}\n", SKATE);
    cr_expect(reduce_text(text, NULL, 1, &error) == NULL);
    nh_error_clear(&error);
    snprintf(text, sizeof text, "%ssymmetry: [{h: 1}]\n", SKATE);
    cr_expect(reduce_text(text, NULL, 1, &error) == NULL);
    cr_expect(strstr(error.what, "does not leave the constraint distribution invariant") != NULL, "%s", error.what);
}

Test(reduce, velocities_off_the_constraints)
{
    nh_error error = {0};
    cr_expect(reduce_path("systems/sleigh_inertia.yaml", NULL, NULL, "h=0.3, x'=1, y'=1, h'=0.2", 1, &error) == NULL);
    cr_expect(strstr(error.what, "violate the constraints") != NULL, "%s", error.what);
    nh_request q = {.system_path = "systems/sleigh_inertia.yaml", .initial = "h=0.3, x'=1, y'=1, h'=0.2", .project = true};
    nh_options_default(&q.options);
    nh_error_clear(&error);
    nh_reduction *r = nh_reduction_create(&q, &error);
    must(r != NULL, &error, "projected");
    cr_expect_float_eq(r->initial.v[0] * sin(0.3) - r->initial.v[1] * cos(0.3), 0, 1e-12);
    nh_reduction_free(r);
}

Test(reduce, json)
{
    nh_error error = {0};
    nh_reduction *r = reduce_path("systems/chaplygin_ball.yaml", NULL, NULL, NULL, 1, &error);
    must(r != NULL, &error, "json");
    char *text = nh_reduction_json(r, NULL);
    cJSON *json = cJSON_Parse(text);
    cr_assert(json != NULL);
    cr_expect(!strstr(text, "nan") && !strstr(text, "inf\""));
    const cJSON *group = oracle_get(json, "group"), *stages = oracle_get(json, "stages");
    cr_expect_eq(oracle_number(group, "dimension"), 3);
    cr_expect_eq(cJSON_GetArraySize(oracle_get(group, "generators")), 3);
    cr_expect_eq(cJSON_GetArraySize(oracle_get(group, "structure_constants")), 3);
    cr_assert_eq(cJSON_GetArraySize(stages), 3);
    cr_expect_str_eq(oracle_get(stages->child, "kind")->valuestring, "chaplygin");
    cr_expect_eq(cJSON_GetArraySize(oracle_get(stages->child, "shape")), 3);
    cr_expect_eq(cJSON_GetArraySize(oracle_get(stages->child, "equations")), 3);
    cr_expect(oracle_number(stages->child, "agreement_with_full") < 1e-8);
    cr_expect(oracle_number(stages->child->next, "agreement_with_full") < 1e-8);
    cr_expect(cJSON_IsTrue(oracle_get(json, "chaplygin")));
    cr_expect(cJSON_IsTrue(oracle_get(json, "dimension_assumption")));
    cJSON_Delete(json);
    nh_free(text);
    nh_text out;
    nh_text_init(&out);
    nh_reduction_write(r, NULL, (nh_pen_style){.form = NH_PEN_TEXT, .verbose = true}, &out);
    cr_expect(strstr(nh_text_string(&out), "Symmetry group: SE(2), dimension 3") != NULL);
    nh_text_clear(&out);
    nh_reduction_free(r);
}

/* The stages as C. */
static void export_c(const nh_reduction *r, nh_text *out)
{
    nh_export *x = nh_export_of_reduction(r);
    nh_export_text(x, NH_EXPORT_C, "reduced", NULL, out);
    nh_export_free(x);
}

/* A coordinate may be called as the array of the state, and time may occur. */
Test(reduce, c_code_of_a_quotient_compiles)
{
    static const char text[] = "name: s\ncoordinates: [{name: z, type: length}, {name: rate, type: length}, {name: y, type: length}]\n"
                               "lagrangian: z'^2/2 + rate'^2/2*(1 + sin(t)^2) + y'^2/2 + z*y'/3 - cos(z)*rate\n";
    nh_error error = {0};
    nh_reduction *r = reduce_text(text, NULL, 1, &error);
    must(r != NULL, &error, "z");
    cr_assert(r->stages == 1 && r->stage[0].kind == NH_STAGE_QUOTIENT);
    char name[SCRATCH], command[SCRATCH + 100];
    nh_text code;
    nh_text_init(&code);
    export_c(r, &code);
    cr_expect(strstr(nh_text_string(&code), "int reduced_stage1(double t, const double state[") != NULL);
    cr_assert(scratch_text(name, nh_text_string(&code)));
    snprintf(command, sizeof command, "${CC:-cc} -std=c99 -Wall -Wextra -Werror -fsyntax-only -x c %s", name);
    cr_expect_eq(system(command), 0);
    remove(name);
    nh_text_clear(&code);
    nh_reduction_free(r);
}

/* The C code of every stage, compiled, against the equations themselves. */
Test(reduce, c_code_computes_the_reduced_equations, PLAIN_ONLY)
{
    nh_error error = {0};
    nh_reduction *r = reduce_path("systems/crane.yaml", NULL, NULL, NULL, 1, &error);
    must(r != NULL, &error, "crane");
    nh_text code;
    nh_text_init(&code);
    export_c(r, &code);
    nh_text_add(&code, "#include <stdio.h>\nint main(void)\n{\n    double z[20], rate[20] = {0}, zeta[20] = {0};\n");
    double z[20], *got = nh_alloc_array(40 * r->stages, sizeof *got), *next = got;
    for (size_t i = 0; i < 20; i++) z[i] = 0.3 + 0.11 * (double)i - 0.007 * (double)(i * i);
    for (size_t i = 0; i < 20; i++) nh_text_addf(&code, "    z[%zu] = %.17g;\n", i, z[i]);
    for (size_t s = 0; s < r->stages; s++) nh_text_addf(&code, "    if (reduced_stage%zu(0, z, &reduced_default, rate, zeta)) return 1;\n    for (int i = 0; i < 20; i++) printf(\"%%.17g\\n%%.17g\\n\", rate[i], zeta[i]);\n", s + 1);
    nh_text_add(&code, "    return 0;\n}\n");
    cr_assert_eq(scratch_run_c(nh_text_string(&code), got, 40 * r->stages), (long)(40 * r->stages), "%s", nh_text_string(&code));
    for (size_t s = 0; s < r->stages; s++) {
        const nh_reduced *o = r->stage[s].shown;
        double rate[20] = {0}, zeta[20] = {0};
        nh_reduced_flow *flow = nh_reduced_flow_create(o);
        cr_assert(nh_reduced_flow_at(flow, z, rate, NULL, zeta, NULL));
        nh_reduced_flow_free(flow);
        for (size_t i = 0; i < 20; i++)
            for (int which = 0; which < 2; which++, next++) {
                double want = which ? zeta[i] : rate[i];
                if (i < (which ? o->d : o->n + o->r)) cr_expect_float_eq(*next, want, 1e-11 * (1 + fabs(want)), "stage %zu, %d %zu: %g, not %g", s + 1, which, i, *next, want);
            }
    }
    nh_free(got);
    nh_text_clear(&code);
    nh_text_init(&code);
    nh_reduction_latex(r, &code);
    cr_expect(strstr(nh_text_string(&code), "\\dot{p}_{\\psi _{1}} = ") != NULL);
    nh_text_clear(&code);
    nh_reduction_free(r);
}

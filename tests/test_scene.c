/* The smallest model for what is watched: the same values as the whole model, and really the smallest. */
#include <dirent.h>
#include <stdio.h>
#include <unistd.h>

#include "mechanics.h"
#include "scratch.h"
#include "sweep.h"
#include "motion/trajectory.h"
#include "commands/simulate.h"
#include "graph/dag.h"

static const char *const planar =
    "name: test\ncoordinates: [{name: x}, {name: y}, {name: z}]\n"
    "lagrangian: (x'^2 + y'^2 + z'^2)/2 - 1.3*(1 - cos(x)) - y^2*(0.7 + x/5)\n";

/* x and y are coupled in what is written only. */
static const char *const cancelling =
    "name: test\ncoordinates: [{name: x}, {name: y}]\n"
    "lagrangian: (x'^2 + y'^2)/2 + (sin(x)^2 + cos(x)^2)*y - x^2*(cosh(y)^2 - sinh(y)^2)\n";

static nh_trajectory *motion_of(const nh_model *model, const nh_state *initial, size_t n, const nh_ex *e, bool smallest, size_t currents, const nh_ex *current)
{
    enum { COUNT = 7 };
    double times[COUNT];
    nh_options options;
    nh_error error = {0};
    nh_options_default(&options);
    options.tolerance = 1e-10;
    options.steps = 20000;
    for (int i = 0; i < COUNT; i++) times[i] = initial->t + 0.137 * i;
    nh_trajectory_request q = {.model = model, .initial = initial, .count = COUNT, .times = times, .options = &options, .n = n, .e = e, .smallest = smallest, .currents = currents, .current = current};
    return nh_trajectory_create(&q, &error);
}

/* A place and a velocity from one of the chart's probes. */
static void start_at_probe(const nh_model *o, size_t p, nh_state *out)
{
    const double *point = o->chart->probe + p * o->chart->width;
    out->t = point[0];
    memcpy(out->q, point + 1, o->m * sizeof *out->q);
    values_at(o, o->m, o->rho, point, out->v);
}

static nh_closed_subsystem *scene_of(const nh_model *o, const char *text)
{
    nh_ex e = formula(o, text);
    return nh_closed_subsystem_create(o, 1, &e, 0, NULL);
}

static void expect_scene(const nh_model *o, const char *watched, size_t core, size_t quadratures)
{
    nh_closed_subsystem *s = scene_of(o, watched);
    nh_text words;
    nh_text_init(&words);
    nh_closed_subsystem_words(s, &words);
    cr_expect(s->core == core && s->quadratures == quadratures && s->kept == core + quadratures, "%s: %s", watched, nh_text_string(&words));
    cr_expect_leq(s->instructions, s->instructions_of_all);
    nh_text_clear(&words);
    nh_closed_subsystem_free(s);
}

Test(scene, what_feeds_what)
{
    mechanics x = mechanics_of_file("systems/sleigh.yaml", NH_CHART_AUTO, 0, NULL);
    expect_scene(x.model, "m/2*v^2 + omega", 2, 0);
    expect_scene(x.model, "phi", 2, 1);
    expect_scene(x.model, "phi + 3*x", 2, 2);
    expect_scene(x.model, "x*y", 2, 3);
    expect_scene(x.model, "x'", 2, 1); /* v cos(phi) */
    mechanics_clear(&x);
    x = mechanics_of_text(planar, NH_CHART_AUTO);
    expect_scene(x.model, "z'", 0, 1);
    expect_scene(x.model, "z", 0, 2); /* z' stays constant: nobody reads it but z */
    expect_scene(x.model, "y'*2.5", 4, 0);
    mechanics_clear(&x);
}

Test(scene, what_cancels_is_not_read)
{
    mechanics x = mechanics_of_text(cancelling, NH_CHART_AUTO);
    expect_scene(x.model, "x", 2, 0);
    expect_scene(x.model, "y", 0, 2);
    expect_scene(x.model, "y' + 0.3*(sin(x)^2 + cos(x)^2)", 0, 1);
    expect_scene(x.model, "y' + sin(2*x) - 2*sin(x)*cos(x)", 0, 1); /* its derivative vanishes only by an identity */
    expect_scene(x.model, "y' + sin(2*x) - 2.001*sin(x)*cos(x)", 2, 1);
    mechanics_clear(&x);
}

static const nh_closed_subsystem *scene_along(nh_trajectory **t, const nh_model *o, const double *at, const char *watched, const char *known)
{
    nh_state initial = {.q = (double *)at, .v = (double *)at + o->m};
    nh_ex e = formula(o, watched), current = known ? formula(o, known) : 0;
    *t = motion_of(o, &initial, 1, &e, true, known != NULL, &current);
    cr_assert(*t && (*t)->scene && (*t)->motion->complete, "%s", watched);
    return (*t)->scene;
}

/* The crane turns freely about the car's centre line: its tilt needs one velocity and the momentum of its turn, the car's path neither of them. */
Test(scene, the_crane_and_its_car, PLAIN_ONLY)
{
    mechanics x = mechanics_of_file("systems/crane.yaml", NH_CHART_AUTO, 0, NULL);
    double at[16] = {0, 0, 0, 0.4, 0, 0, 0, 0.3};
    double f = 1, s = 0.3, turn = f * sin(0.4) / 2.6;
    at[8] = f * cos(0.4), at[10] = turn, at[11] = s, at[12] = 0.2, at[13] = (f - 0.8 * (s + turn)) / 0.35, at[14] = (f + 0.8 * (s + turn)) / 0.35, at[15] = 0.1;
    nh_trajectory *t;
    const nh_closed_subsystem *c = scene_along(&t, x.model, at, "x", NULL);
    cr_expect(c->core == 3 && c->quadratures == 2 && !c->levels && c->instructions < c->instructions_of_all * 2 / 3, "%zu, %zu, %zu", c->core, c->quadratures, c->levels);
    nh_trajectory_free(t);
    c = scene_along(&t, x.model, at, "x", "theta' + psi1'");
    cr_expect(c->core == 2 && c->quadratures == 2 && c->levels == 1, "%zu, %zu, %zu", c->core, c->quadratures, c->levels);
    nh_trajectory_free(t);
    c = scene_along(&t, x.model, at, "phi2", NULL);
    cr_expect(c->kept == 2 && c->levels == 1, "%zu, %zu", c->kept, c->levels);
    nh_trajectory_free(t);
    mechanics_clear(&x);
}

/* The momentum of a cyclic coordinate is found without being told; one that is not conserved is not believed. */
Test(scene, cyclic_momenta)
{
    mechanics x = mechanics_of_file("systems/spherical_pendulum.yaml", NH_CHART_AUTO, 0, NULL);
    const double at[4] = {0.7, 0, 0.1, 0.9};
    nh_trajectory *t, *all;
    const nh_closed_subsystem *s = scene_along(&t, x.model, at, x.system->coordinate[0].name, NULL);
    cr_expect(s->kept == 2 && s->levels == 1, "%zu, %zu", s->kept, s->levels);
    nh_state initial = {.q = (double *)at, .v = (double *)at + 2};
    nh_ex e = x.system->coordinate[0].q;
    all = motion_of(x.model, &initial, 1, &e, false, 0, NULL);
    for (size_t i = 0; i < all->motion->count; i++) cr_expect_float_eq(t->value[i], all->value[i], 1e-8);
    nh_trajectory_free(t);
    nh_trajectory_free(all);
    mechanics_clear(&x);
    x = mechanics_of_text(planar, NH_CHART_AUTO);
    double start[6] = {0.7, 0.2, 0, 0.1, 0.9, 0.3};
    s = scene_along(&t, x.model, start, "x", "y' + 0.1*x");
    cr_expect_eq(s->levels, 0);
    nh_trajectory_free(t);
    mechanics_clear(&x);
}

/* Centre of mass and momentum remove a place and a velocity each, the angular momentum does not determine anything for long; a current that is not
 * defined at the initial state is of no use there. */
Test(scene, places_and_useless_currents)
{
    mechanics x = mechanics_of_file("systems/three_bodies.yaml", NH_CHART_AUTO, 0, NULL);
    nh_ex current[8], e = formula(x.model, "x1");
    nh_error error = {0};
    size_t n = 0;
    for (size_t k = 0; k < x.system->currents; k++) n += nh_analysis_file_to_chart(x.model, x.system->current[k].value, &current[n], &error);
    double at[12] = {1, 0, -1, 0, 0, 1.3, 0.1, 0, 0, 0.4, 0, 0};
    nh_state initial = {.q = at, .v = at + 6};
    nh_trajectory *few = motion_of(x.model, &initial, 1, &e, true, n, current), *all = motion_of(x.model, &initial, 1, &e, false, 0, NULL);
    cr_assert(few && all && few->scene && few->motion->complete);
    cr_expect(few->scene->kept == 8 && few->scene->levels == 4, "%zu, %zu", few->scene->kept, few->scene->levels);
    for (size_t i = 0; i < all->motion->count; i++) cr_expect_float_eq(few->value[i], all->value[i], 1e-7);
    nh_trajectory_free(few);
    nh_trajectory_free(all);
    mechanics_clear(&x);
    x = mechanics_of_file("systems/knife_edge.yaml", NH_CHART_AUTO, 0, NULL);
    const double still[6] = {0.3, 0.2, 0.1, cos(0.1), sin(0.1), 0}; /* without turning: X has a pole */
    nh_trajectory *t;
    scene_along(&t, x.model, still, "x", "x - (x'*cos(p) + y'*sin(p))*sin(p)/p'");
    for (size_t i = 0; i < t->motion->count; i++) cr_expect_float_eq(t->value[i], 0.3 + cos(0.1) * t->motion->time[i], 1e-8, "%g", t->value[i]);
    nh_trajectory_free(t);
    mechanics_clear(&x);
}

/* p = cos(x) y' + ... determines y' only until cos(x) = 0: the motion goes on with all that is needed. */
Test(scene, a_current_that_ceases_to_determine)
{
    mechanics x = mechanics_of_text("name: test\ncoordinates: [{name: x}, {name: y}]\ndomain: {x: [-0.8, 0.8]}\nlagrangian: x'^2/2 + cos(x)^2*y'^2/2 + x'*y'/9 - x^2/8\n", NH_CHART_AUTO);
    double at[4] = {0.2, 0, 1.6, 0.9};
    nh_state initial = {.q = at, .v = at + 2};
    nh_ex e = x.system->coordinate[0].q;
    nh_trajectory *few = motion_of(x.model, &initial, 1, &e, true, 0, NULL), *all = motion_of(x.model, &initial, 1, &e, false, 0, NULL);
    cr_assert(few && all);
    cr_expect(few->motion->complete == all->motion->complete);
    for (size_t i = 0; i < all->motion->count && i < few->motion->count; i++) cr_expect_float_eq(few->value[i], all->value[i], 1e-6);
    nh_trajectory_free(few);
    nh_trajectory_free(all);
    mechanics_clear(&x);
}

/* Quadratures come in an order in which each reads only what stands before it. */
Test(scene, quadratures_are_in_order)
{
    mechanics x = mechanics_of_file("systems/sleigh.yaml", NH_CHART_AUTO, 0, NULL);
    nh_closed_subsystem *s = scene_of(x.model, "x + y");
    cr_assert_eq(s->kept, 5);
    cr_expect_str_eq(nh_closed_subsystem_state_name(s, s->state[2]), "phi", "%s", nh_closed_subsystem_state_name(s, s->state[2]));
    nh_closed_subsystem_free(s);
    mechanics_clear(&x);
}

/* Watched in the chart (phi', x'), which ends at cos phi = 0 between two outputs: all coordinates take over. */
Test(scene, a_chart_that_ends_between_outputs_is_left)
{
    mechanics x = mechanics_of_file("systems/sleigh.yaml", NH_CHART_COORDINATES, 0, NULL);
    nh_options options;
    nh_error error = {0};
    nh_options_default(&options);
    double q[3] = {0}, v[3] = {2, 0, 0}, times[2] = {0, 5};
    nh_state initial = {.q = q, .v = v};
    nh_ex e = formula(x.model, "phi'");
    for (int smallest = 0; smallest < 2; smallest++) {
        nh_trajectory_request r = {.model = x.model, .initial = &initial, .count = 2, .times = times, .options = &options, .n = 1, .e = &e, .smallest = smallest};
        nh_trajectory *t = nh_trajectory_create(&r, &error);
        cr_assert(t && t->motion->complete);
        cr_expect(strstr(t->formulation, "all coordinates"), "%s", t->formulation);
        cr_expect_float_eq(t->value[1], 2 / cosh(5.0), 1e-7, "%.12g", t->value[1]);
        nh_trajectory_free(t);
    }
    mechanics_clear(&x);
}

/* A rotor on a plate: friction turns the plate, nothing the rotor, whose mass then does not matter, with numbers for masses, too. */
static const char *const rotor =
    "name: test\nparameters: [{name: I, value: 0.02}]\nbodies:\n  - {name: plate, mass: 2, inertia: [0.1, 0.2, 0.3]}\n  - {name: rotor, mass: 1, inertia: [0.01, 0.01, %s]}\n"
    "joints:\n  - {type: planar, child: plate, coordinates: [x, y, h]}\n  - {type: revolute, parent: plate, child: rotor, axis: z%s, coordinates: [p]}\n"
    "forces: [\"h = -(%s)*h'\"]\n";

static void expect_idle(const char *inertia, const char *at, const char *friction, const char *watched, const char *words)
{
    char text[800];
    snprintf(text, sizeof text, rotor, inertia, at, friction);
    mechanics x = mechanics_of_text(text, NH_CHART_AUTO);
    nh_closed_subsystem *s = scene_of(x.model, watched);
    nh_text idle;
    nh_text_init(&idle);
    nh_closed_subsystem_idle_words(s, &idle);
    cr_expect_str_eq(nh_text_string(&idle), words, "%s, %s, %s: %s", inertia, at, watched, nh_text_string(&idle));
    nh_text_clear(&idle);
    nh_closed_subsystem_free(s);
    mechanics_clear(&x);
}

Test(scene, bodies_whose_masses_are_numbers)
{
    expect_idle("0.02", "", "1", "h", "the parameter I has no influence, nor the body rotor");
    expect_idle("0.02", "", "1", "p", "the parameter I has no influence, nor the body rotor"); /* p'' = -h'' */
    expect_idle("I", "", "1", "h", "the parameter I has no influence, nor the body rotor");
    expect_idle("0.02", ", at: [0.5, 0, 0]", "1", "h", "the parameter I has no influence"); /* its mass is the plate's burden */
    expect_idle("0.02", ", at: [0.5, 0, 0]", "1e-13", "h", "the parameter I has no influence"); /* also in a slow scene */
    expect_idle("0.02", "", "1e-13", "h", "the parameter I has no influence, nor the body rotor");
    expect_idle("0.02", "", "1", "E", "the parameter I has no influence");
}

static nh_simulation *simulate_watching(const char *path, const char *initial, const char *watch, double accuracy)
{
    nh_error error = {0};
    nh_request q = {.system_path = path, .initial = initial, .watch = watch, .step = 5, .accuracy = accuracy};
    nh_options_default(&q.options);
    nh_simulation *s = nh_simulation_create(&q, &error);
    must(s != NULL, &error, path);
    return s;
}

/* A skate turns by itself: cos(p) = 0 ends the chart of its velocities, and is nothing to the heading.  What it is something to says so. */
Test(scene, the_end_of_a_chart_that_does_not_matter)
{
    for (int k = 0; k < 2; k++) {
        nh_simulation *s = simulate_watching("systems/knife_edge.yaml", "p'=1, x'=1", "p", k ? 1e-9 : 0);
        cr_expect(strstr(s->scene, "p' and p by quadrature, x, y and "), "%s", s->scene);
        cr_expect_float_eq(s->value[s->motion->count - 1], 10, 1e-8, "%.12g", s->value[s->motion->count - 1]);
        nh_simulation_free(s);
    }
    nh_simulation *s = simulate_watching("systems/knife_edge.yaml", "p'=1, x'=1", "x", 0);
    cr_expect_str_eq(s->scene, "all 6 states integrated, in all coordinates: no smaller subsystem reaches the end", "%s", s->scene);
    nh_simulation_free(s);
}

/* A motion that begins where x' does not determine y': other velocities are taken, also where the file names the dependent ones. */
Test(scene, a_start_where_the_chart_ends)
{
    static const struct {
        const char *path, *initial;
    } all[] = {{"systems/knife_edge.yaml", "p=1.5707963267948966, y'=1"}, {"systems/sleigh.yaml", "phi=1.5707963267948966, y'=1"}};
    for (int i = 0; i < 2; i++) {
        nh_error error = {0};
        nh_request q = {.system_path = all[i].path, .initial = all[i].initial, .watch = "y", .step = 5, .chart = NH_CHART_COORDINATES};
        nh_options_default(&q.options);
        nh_simulation *s = nh_simulation_create(&q, &error);
        must(s != NULL, &error, all[i].path);
        cr_expect(s->motion->complete && fabs(s->value[s->motion->count - 1] - 10) < 1e-7, "%.12g", s->value[s->motion->count - 1]);
        nh_simulation_free(s);
    }
}

/* Quasi-velocities that mix two oscillators: in coordinate velocities one of them is enough; not so for those of the sleigh. */
Test(scene, the_chart_that_keeps_fewest_states)
{
    char path[64];
    snprintf(path, sizeof path, "/tmp/nhsym-test-scene-%ld.yaml", (long)getpid());
    FILE *file = fopen(path, "w");
    fputs("name: mixed\ncoordinates: [{name: x}, {name: y}]\nlagrangian: (x'^2 + y'^2)/2 - x^2/2 - y^2\nvelocities: {names: [a, b], map: [\"x' = a + b\", \"y' = a - b\"]}\n", file);
    fclose(file);
    nh_error error = {0};
    nh_request q = {.system_path = path, .initial = "x=1, x'=0.5", .watch = "x", .until_given = true};
    nh_options_default(&q.options);
    q.options.until = 2;
    nh_simulation *s = nh_simulation_create(&q, &error);
    must(s != NULL, &error, path);
    cr_expect(s->trajectory->scene && s->trajectory->scene->kept == 2, "%s", s->scene);
    size_t last = s->motion->count - 1;
    cr_expect_float_eq(s->value[last * s->columns.count], cos(2.0) + 0.5 * sin(2.0), 1e-8);
    nh_simulation_free(s);
    q = (nh_request){.system_path = "systems/sleigh.yaml", .initial = "omega=2", .watch = "omega", .until_given = true, .options = q.options};
    s = nh_simulation_create(&q, &error);
    must(s != NULL, &error, "sleigh");
    cr_expect(s->trajectory->scene->kept == 2 && s->model->chart->quasi, "%s", s->scene);
    nh_simulation_free(s);
    remove(path);
}

/* ---- the same values as the whole model, for every system ---- */

static uint64_t state = 88172645463325252u;

static double chance(void)
{
    state ^= state << 13, state ^= state >> 7, state ^= state << 17;
    return (double)(state >> 11) * 0x1p-53;
}

static nh_ex random_quantity(const nh_model *o)
{
    nh_dag *d = o->dag;
    nh_ex a = o->chart->symbol[1 + (size_t)(chance() * (double)(o->m + o->n))], b = o->rho[(size_t)(chance() * (double)o->m)];
    return chance() < 0.4 ? a : chance() < 0.5 ? b : nh_add(d, nh_mul(d, a, nh_real(d, 0.31 + chance())), nh_mul(d, b, b));
}

static bool has_quasi(const char *path)
{
    nh_error ignored = {0};
    nh_system *s = nh_system_read(path, 0, NULL, &ignored);
    bool any = s && s->quasi > 0;
    nh_system_free(s);
    return any;
}

static size_t compared, smaller, by_currents;

static void compare_on(const char *path, nh_chart_choice choice)
{
    mechanics x = mechanics_of_file(path, choice, 0, NULL);
    nh_model *o = x.model;
    nh_error ignored = {0};
    size_t known = 0;
    nh_ex *current = nh_alloc_array(x.system->currents + 1, sizeof *current);
    for (size_t k = 0; k < x.system->currents; k++) known += nh_analysis_file_to_chart(o, x.system->current[k].value, &current[known], &ignored);
    double *at = nh_alloc_array(2 * o->m, sizeof *at);
    nh_state initial = {.q = at, .v = at + o->m};
    for (size_t trial = 0; trial < 3 && trial < o->chart->probes; trial++) {
        nh_ex e = random_quantity(o);
        start_at_probe(o, trial, &initial);
        nh_trajectory *all = motion_of(o, &initial, 1, &e, false, 0, NULL), *few = motion_of(o, &initial, 1, &e, true, known, current);
        cr_expect_eq(all == NULL, few == NULL, "%s", path);
        if (all && few && all->motion->complete && few->motion->complete && few->scene) {
            compared++;
            smaller += few->scene->kept < few->scene->states;
            by_currents += few->scene->levels > 0;
            cr_expect_eq(few->motion->size, few->scene->kept);
            for (size_t i = 0; i < all->motion->count; i++)
                cr_expect_float_eq(few->value[i], all->value[i], 1e-6 * (1 + fabs(all->value[i])), "%s, output %zu: %.12g, not %.12g", path, i, few->value[i], all->value[i]);
        }
        nh_trajectory_free(all);
        nh_trajectory_free(few);
    }
    nh_free(at);
    nh_free(current);
    mechanics_clear(&x);
}

Test(scene, the_same_values_for_every_system, PLAIN_ONLY)
{
    char *name[most_files];
    size_t n = list("systems", name), tried = 0;
    for (size_t i = 0; i < n; free(name[i++])) {
        if (!sweep_tries(i + 2, 4, 16)) continue;
        char path[400];
        snprintf(path, sizeof path, "systems/%s.yaml", name[i]);
        compare_on(path, NH_CHART_AUTO);
        if (has_quasi(path)) compare_on(path, NH_CHART_COORDINATES);
        tried++;
    }
    cr_expect(n * compared > 150 * tried && n * smaller > 80 * tried && (tried < 10 || n * by_currents > 40 * tried), "%zu compared, %zu of them smaller, %zu by currents", compared, smaller, by_currents);
}

/* A position on or off the circle of a pendulum: in any unit of length. */
Test(scene, an_initial_position_astray)
{
    static const double length[] = {1e-9, 1, 1e9};
    for (size_t i = 0; i < 6; i++) {
        double l = length[i / 2];
        char text[600], initial[100], path[SCRATCH];
        nh_error error = {0};
        snprintf(text, sizeof text, "name: pendulum\nparameters: [{name: l, value: %.17g}, {name: g, value: %.17g}]\ncoordinates: [{name: x, type: length}, {name: y, type: length}]\n"
                                    "lagrangian: 1/2*(x'^2 + y'^2) - g*y\nconstraints: [\"x^2 + y^2 = l^2\"]\n", l, l);
        snprintf(initial, sizeof initial, "x=%.17g, y=%.17g", 0.6 * l * (i % 2 ? 1.001 : 1), -0.8 * l);
        cr_assert(scratch_text(path, text));
        nh_request q = {.system_path = path, .initial = initial, .step = 1};
        nh_options_default(&q.options);
        q.options.until = 1;
        nh_simulation *s = nh_simulation_create(&q, &error);
        remove(path);
        must(s != NULL, &error, initial);
        cr_expect_eq(s->violation != NULL, i % 2 == 1, "l = %g, %s", l, initial);
        nh_simulation_free(s);
    }
}

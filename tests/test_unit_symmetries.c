/* Units of length, mass and time change neither the kind of a constraint nor what is said of a symmetry, and no usable point, and no symmetry group. */
#include <float.h>
#include <stdio.h>

#include "document/screen.h"
#include "geometry/distribution.h"
#include "graph/dag.h"
#include "graph/function.h"
#include "integrals/symmetry.h"
#include "graph/print.h"
#include "reduction/group.h"
#include "reduced.h"
#include "sweep.h"

typedef struct {
    double length, mass, time;
} units;
static const units all_units[] = {{1, 1, 1}, {1e-9, 1, 1}, {1e9, 1, 1}, {1, 1e-9, 1}, {1, 1e9, 1}, {1, 1, 1e-9}, {1, 1, 1e9}};
enum { UNITS = sizeof all_units / sizeof *all_units, most_currents = 5, most_text = 3000 };

/* Intervals of two lengths (or of one coordinate that is none), of angles and of their velocities. */
static void write_box(const units *u, const char *lengths, const char *angles, nh_text *out)
{
    nh_text_add(out, "domain: {t: [0, ");
    nh_text_addf(out, "%.17g]", u->time);
    for (const char *c = lengths; *c; c++)
        nh_text_addf(out, ", %c: [-%.17g, %.17g], \"%c'\": [-%.17g, %.17g]", *c, u->length, u->length, *c, 1.5 * u->length / u->time, 1.5 * u->length / u->time);
    for (const char *c = angles; *c; c++) nh_text_addf(out, ", %c: [-1.1, 1.2], \"%c'\": [-%.17g, %.17g]", *c, *c, 1.5 / u->time, 1.5 / u->time);
    nh_text_add(out, "}\n");
}

static void write_oscillator(const units *u, nh_text *out)
{
    nh_text_addf(out, "name: oscillator\nparameters: [{name: m, value: %.17g}, {name: k, value: %.17g}]\ncoordinates: [{name: x}, {name: y}]\nlagrangian: m*(x'^2 + y'^2)/2 - k*(x^2 + y^2)/2\n", 1.3 * u->mass, 1.9 * u->mass / u->time / u->time);
    write_box(u, "xy", "", out);
}

static void write_pendulum(const units *u, nh_text *out)
{
    nh_text_addf(out, "name: pendulum\nparameters: [{name: m, value: %.17g}, {name: l, value: %.17g}, {name: g, value: %.17g}]\ncoordinates: [{name: h, type: angle}]\nlagrangian: m*l^2*h'^2/2 + m*g*l*cos(h)\n", 1.3 * u->mass,
                 0.8 * u->length, 0.9 * u->length / u->time / u->time);
    write_box(u, "", "h", out);
}

static void write_sleigh(const units *u, nh_text *out)
{
    double m = 2 * u->mass, a = 0.7 * u->length;
    nh_text_addf(out, "name: sleigh\nparameters: [{name: m, value: %.17g}, {name: a, value: %.17g}, {name: J, value: %.17g}]\ncoordinates: [{name: h, type: angle}, {name: x}, {name: y}]\n"
                      "lagrangian: m/2*((x' - a*h'*sin(h))^2 + (y' + a*h'*cos(h))^2) + J/2*h'^2\nconstraints: [\"y'*cos(h) = x'*sin(h)\"]\n", m, a, 3 * m * a * a);
    write_box(u, "xy", "h", out);
}

static void write_disk(const units *u, nh_text *out)
{
    double m = 1.3 * u->mass, r = 0.8 * u->length;
    nh_text_addf(out, "name: disk\nparameters: [{name: m, value: %.17g}, {name: I, value: %.17g}, {name: J, value: %.17g}, {name: r, value: %.17g}]\n"
                      "coordinates: [{name: x}, {name: y}, {name: h, type: angle}, {name: p, type: angle}]\nlagrangian: m*(x'^2 + y'^2)/2 + I*h'^2/2 + J*p'^2/2\n"
                      "constraints: [\"x' = r*cos(h)*p'\", \"y' = r*sin(h)*p'\"]\n", m, m * r * r / 4, m * r * r / 2, r);
    write_box(u, "xy", "hp", out);
}

static const struct {
    void (*write)(const units *u, nh_text *out);
    const char *current[most_currents];
} systems[] = {
    {write_oscillator, {"E", "m*(x*y' - y*x')", "m*(x'*cos(t*sqrt(k/m)) + x*sqrt(k/m)*sin(t*sqrt(k/m)))"}},
    {write_pendulum, {"E"}},
    {write_sleigh, {"E"}},
    {write_disk, {"E", "h'*I", "p'*r*m", "I*(t*h' - h)", "I*(r*p'*cos(h) + y*h')"}},
};

/* What is said, in one text. */
static void describe(const mechanics *x, const char *const *current, nh_text *out)
{
    nh_error error = {0};
    nh_options options;
    nh_options_default(&options);
    nh_distribution kind = nh_distribution_of(x->model);
    nh_text_addf(out, "%s; %s; growth", x->model->chart->name, nh_constraint_integrability(x->model, &kind));
    for (size_t i = 0; i < kind.growth.length; i++) nh_text_addf(out, " %zu", kind.growth.rank[i]);
    nh_points *points = nh_points_create(x->model, 64, 1, 1, &error);
    must(points != NULL, &error, "points");
    nh_text_addf(out, "; %zu points tried, %zu degenerate\n", points->tried, points->degenerate);
    for (size_t k = 0; k < most_currents && current[k]; k++) {
        nh_symmetry z;
        must(nh_symmetry_of(x->model, points, formula(x->model, current[k]), options.same, &z, &error), &error, current[k]);
        nh_text_addf(out, "%s: case %d, %s the canonical distribution, %s\n", current[k], z.kase, z.bracket_in_distribution ? "in" : "not in", z.projectable ? "projectable" : "not projectable");
    }
    nh_points_free(points);
}

/* The symmetry group with its fields. */
static void describe_group(const mechanics *x, const char *const *current, nh_text *out)
{
    (void)current;
    nh_error error = {0};
    nh_options options;
    nh_options_default(&options);
    nh_kinetic *k = nh_kinetic_create(x->model, 1, &error);
    must(k != NULL, &error, "the metric");
    nh_group *g = nh_group_find(k, &options, &error);
    must(g != NULL, &error, "the group");
    nh_text_addf(out, "%s, %zu isometries, %zu fields without a closed form\n", g->name, g->jets->of_metric, g->missing);
    for (size_t i = 0; i < g->action.d; i++)
        for (size_t s = 0; s < k->m; s++) {
            char *e = nh_print_string(k->dag, g->action.generator[i].component[s]);
            nh_text_addf(out, "%s%s", e, s + 1 < k->m ? ", " : "\n");
            nh_free(e);
        }
    nh_group_free(g);
    nh_kinetic_free(k);
}

static void in_all_units(void (*describe_it)(const mechanics *x, const char *const *current, nh_text *out))
{
    for (size_t c = 0; c < sizeof systems / sizeof *systems; c++) {
        char one[most_text] = "";
        for (size_t i = 0; i < UNITS; i++) {
            const units *u = &all_units[i];
            nh_text file, words;
            nh_text_init(&file);
            nh_text_init(&words);
            systems[c].write(u, &file);
            mechanics x = mechanics_of_text(nh_text_string(&file), NH_CHART_AUTO);
            describe_it(&x, systems[c].current, &words);
            if (i == 0) snprintf(one, sizeof one, "%s", nh_text_string(&words));
            cr_expect_str_eq(nh_text_string(&words), one, "units %g, %g, %g:\n%s\n%s", u->length, u->mass, u->time, nh_text_string(&words), one);
            mechanics_clear(&x);
            nh_text_clear(&words);
            nh_text_clear(&file);
        }
    }
}

Test(unit_symmetries, words_know_none, PLAIN_ONLY) { in_all_units(describe); }
Test(unit_symmetries, groups_know_none, PLAIN_ONLY) { in_all_units(describe_group); }

/* Velocities that are longer than a normal form may be are linear in w as they are written: the energy of a bicycle is conserved by the theorem. */
Test(unit_symmetries, energy_where_velocities_are_long, PLAIN_ONLY)
{
    mechanics x = mechanics_of_file("systems/whipple_bicycle.yaml", NH_CHART_AUTO, 0, NULL);
    cr_expect(nh_symmetry_is_energy(x.model, x.model->E));
    cr_expect_not(nh_symmetry_is_energy(x.model, x.model->Lbar));
    mechanics_clear(&x);
}

/* A shared graph of 200 nodes would have 2^100 letters on paper. */
Test(unit_symmetries, a_screen_has_no_room_for_a_shared_graph)
{
    nh_dag *d = nh_dag_create();
    nh_ex e = nh_symbol(d, "x");
    nh_text out;
    nh_text_init(&out);
    cr_expect(nh_screen_equation("y", d, e, &out));
    for (int k = 0; k < 100; k++) e = nh_call(d, NH_SIN, nh_add(d, nh_call(d, NH_COS, e), nh_powi(d, e, 2)));
    cr_expect_not(nh_screen_equation("z", d, e, &out));
    cr_expect_str_eq(nh_text_string(&out), "  y = x\n");
    nh_text_clear(&out);
    nh_dag_free(d);
}

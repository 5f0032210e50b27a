/* The shipped stresses: maps where methods fail, and how many cells are silently wrong.  And the nonreversible test: which methods gain energy exponentially.
 * usage: bench_stress [-v] [FACTOR]        FACTOR times the usual seconds per map */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "motion/midpoint.h"
#include "report/chart.h"
#include "study/stress.h"

static const char DISK[] = "name: disk\nparameters: [{name: m, value: 1}, {name: r, value: 1}, {name: g, value: 1}, {name: A, value: 0.25}, {name: C, value: 0.5}]\n"
    "coordinates: [{name: x}, {name: y}, {name: p, type: angle}, {name: s, type: angle}, {name: h, type: angle}]\n"
    "lagrangian: m/2*(x'^2 + y'^2 + r^2*cos(h)^2*h'^2) + A/2*(h'^2 + sin(h)^2*p'^2) + C/2*(s' + p'*cos(h))^2 - m*g*r*sin(h)\n"
    "constraints: [\"x' = -r*cos(p)*(s' + p'*cos(h)) + r*h'*sin(h)*sin(p)\", \"y' = -r*sin(p)*(s' + p'*cos(h)) - r*h'*sin(h)*cos(p)\"]\n"
    "domain: {h: [0.8, 1.5]}\n"
    "known: {currents: [{name: E, expr: \"m/2*(x'^2 + y'^2 + r^2*cos(h)^2*h'^2) + A/2*(h'^2 + sin(h)^2*p'^2) + C/2*(s' + p'*cos(h))^2 + m*g*r*sin(h)\"}]}\n";

static const char FRONT_AXLE[] = "name: front_axle\nparameters: [{name: l, value: 2.6}, {name: c, value: 3}, {name: b, value: 0.35}]\n"
    "coordinates: [{name: psi1, type: angle}, {name: psi2, type: angle}, {name: theta, type: angle}]\n"
    "lagrangian: 6*(b*psi2' + c*psi1' + c*theta')^2 + 3*theta'^2 + (theta' + psi1')^2/10 + psi2'^2/25\n"
    "constraints: [\"theta'*(l - c*sin(psi1)) = sin(psi1)*(b*psi2' + c*psi1')\"]\ndependent: [theta]\ndomain: {psi1: [-0.5, 0.5]}\n";

static const char STIFF[] = "name: stiff_contact\nparameters: [{name: K, value: 1}, {name: L, value: 1, doc: unit of length}]\n"
    "coordinates: [{name: x, type: length}, {name: y, type: length}, {name: z, type: length}]\n"
    "lagrangian: (x'^2 + y'^2 + z'^2)/2 - (x^2 + K*y^2)/2\nconstraints: [\"x' + y*z'/L = 0\"]\n"
    "known: {currents: [{name: Ey, expr: \"y'^2/2 + K*y^2/2\"}]}\n";

static const struct {
    const char *title, *path, *text; /* one of path and text */
    const char *initial, *over;
    nh_chart_choice chart;
    double until, seconds;
} CASES[] = {
    {"sleigh across cos(phi) = 0, bad chart", "systems/sleigh.yaml", NULL, "phi=0, phi'=1", "phi'=0.1:4:6, phi=0:6.28:6", NH_CHART_COORDINATES, 10, 6},
    {"sleigh, J to 0 and a to 0", "systems/sleigh_inertia.yaml", NULL, "h=0, h'=1", "J=1e-16:1:6, a=1e-9:1:6", NH_CHART_AUTO, 10, 6},
    {"disk towards flat", NULL, DISK, "h=1, p'=0.1", "p'=1e-6:0.1:6, stress_tolerance=1e-4:1e-11:4", NH_CHART_AUTO, 3.92, 8},
    {"disk, upright", NULL, DISK, "h=1.5697963, s'=0.5", "h=1.570796316:1.5697963:4, s'=0.28:0.61:6", NH_CHART_AUTO, 20, 6},
    {"front axle at l = c sin(psi1)", NULL, FRONT_AXLE, "psi1=0.6, psi1'=0.3, psi2'=-1.5758", "psi1=0.2:1.2:6, psi1'=-0.6:0.6:6", NH_CHART_COORDINATES, 3, 6},
    {"stiffness and inertia ratios up to 1e6", NULL, STIFF, "x=1, y=0.001, z=0.3, y'=0, z'=0.5", "K=1:1e12:7", NH_CHART_AUTO, 1, 6},
    {"inertia ratios of a body", "systems/suslov.yaml", NULL, NULL, NULL, NH_CHART_AUTO, 10, 12},
    {"up to 1e6 periods", NULL, STIFF, "x=1, y=0.2, z=0.3, y'=0.9, z'=0.5", "until=6.283e2:6.283e6:5", NH_CHART_AUTO, 10, 60},
    {"units of 1e-12 to 1e12", NULL, STIFF, "x=1, y=0.2, z=0.3, y'=0.9, z'=0.5", "absolute=1e-12:1e6:7, L=1e-12:1e12:5", NH_CHART_AUTO, 10, 8},
};

static bool write_text(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");
    return file && fputs(text, file) >= 0 && fclose(file) == 0;
}

static size_t run_case(size_t i, const char *folder, double factor, bool verbose)
{
    char path[200];
    snprintf(path, sizeof path, "%s/system.yaml", folder);
    if (CASES[i].text && !write_text(path, CASES[i].text)) exit(1);
    nh_error error;
    nh_error_clear(&error);
    nh_simulate_request q = {.system_path = CASES[i].text ? path : CASES[i].path, .initial = CASES[i].initial, .chart = CASES[i].chart, .until_given = true};
    nh_options_default(&q.options);
    q.options.until = CASES[i].until;
    nh_stress *s = nh_stress_create(&q, CASES[i].over, factor * CASES[i].seconds, &error);
    if (!s) {
        fprintf(stderr, "%s: %s\n", CASES[i].title, error.what);
        exit(1);
    }
    printf("| %s | %s |", CASES[i].title, CASES[i].over ? CASES[i].over : "every parameter and angle");
    for (int k = 0; k <= NH_WRONG; k++) printf(" %zu |", s->count[k]);
    puts("");
    fflush(stdout);
    size_t wrong = s->count[NH_WRONG];
    if (verbose || wrong) {
        nh_text text;
        nh_text_init(&text);
        nh_stress_text(s, true, &text);
        fputs(nh_text_string(&text), stderr);
        nh_text_clear(&text);
    }
    nh_stress_free(s);
    if (CASES[i].text) unlink(path);
    return wrong;
}

/* ---- the nonreversible test ---- */

/* A pendulum s drives the direction of the velocity of a particle in a plane; when s rotates, nothing turns the motion round in time [ModinVerdier2020].
 * In the velocities (u, s') of an orthonormal frame. */
static const char DRIVEN[] = "name: driven\ncoordinates: [{name: x}, {name: z}, {name: s, type: angle}]\n"
    "lagrangian: (x'^2 + z'^2 + s'^2)/2 - (x^2 + z^2)/2 + cos(s) - 0.15*sin(2*s)\n"
    "constraints: [\"x'*sin(sin(s) + 0.5*sin(2*s + 1)) = z'*cos(sin(s) + 0.5*sin(2*s + 1))\"]\n"
    "chart: {velocities: [u, w], map: [\"x' = u*cos(sin(s) + 0.5*sin(2*s + 1))\", \"z' = u*sin(sin(s) + 0.5*sin(2*s + 1))\", \"s' = w\"]}\n";

static void put_growth(const nh_model *o, const char *name, nh_midpoint_rule rule, bool composed, double w, double step, double until)
{
    enum { outputs = 3 };
    double z0[5] = {1, 0.2, 0.3, 0.5, w}, times[outputs] = {0, until / 2, until}, scale[5] = {1, 1, 1, 1, 1}, E[outputs];
    nh_error error;
    nh_error_clear(&error);
    nh_flow_options how = {.step = step, .scale = scale, .max_steps = 1e9, .rtol = 1e-10};
    nh_programs *programs = nh_programs_create(o);
    nh_motion *motion = nh_midpoint(programs, rule, composed, z0, outputs, times, &how, &error);
    nh_tape *tape = nh_model_tape(o, 1, &o->E);
    nh_tape_work *work = nh_tape_work_create(tape);
    for (size_t i = 0; i < outputs; i++) {
        double point[6] = {times[i]};
        E[i] = NAN;
        if (!motion || i >= motion->count) continue;
        memcpy(point + 1, motion->state + i * 5, 5 * sizeof *point);
        nh_tape_eval(tape, work, point, &E[i]);
    }
    printf("| %s | %g | %s | ", name, step, w > 2 ? "rotates" : "librates");
    if (isfinite(E[1])) printf("%.3g | ", fabs(E[1] / E[0]));
    else printf("ended | ");
    if (isfinite(E[2])) printf("%.3g |\n", fabs(E[2] / E[0]));
    else printf("ended |\n");
    nh_tape_work_free(work);
    nh_tape_free(tape);
    nh_motion_free(motion);
    nh_programs_free(programs);
}

static void nonreversible(void)
{
    nh_error error;
    nh_error_clear(&error);
    nh_system *s = nh_system_parse("driven", DRIVEN, 0, NULL, &error);
    nh_model *o = s ? nh_model_create(s, nh_chart_create(s, NH_CHART_AUTO, 1, &error), &error) : NULL;
    if (!o) {
        fprintf(stderr, "%s\n", error.what);
        exit(1);
    }
    static const double speeds[] = {2.3, 0.9};
    printf("\n| method | step | the driver | E(3000) / E(0) | E(6000) / E(0) |\n|---|---|---|---|---|\n");
    for (int i = 0; i < 2; i++) {
        put_growth(o, "Lagrange-d'Alembert", NH_LAGRANGE_DALEMBERT, false, speeds[i], 0.15, 6000);
        put_growth(o, "Lagrange-d'Alembert, order 4", NH_LAGRANGE_DALEMBERT, true, speeds[i], 0.15, 6000);
        put_growth(o, "Lagrange-d'Alembert", NH_LAGRANGE_DALEMBERT, false, speeds[i], 0.0375, 6000);
        put_growth(o, "midpoint", NH_MIDPOINT, false, speeds[i], 0.15, 6000);
        put_growth(o, "energy-preserving", NH_ENERGY, false, speeds[i], 0.15, 6000);
    }
    nh_model_free(o);
    nh_system_free(s);
}

int main(int argc, char **argv)
{
    char folder[] = "/tmp/nhsym-stress-XXXXXX";
    bool verbose = argc > 1 && !strcmp(argv[1], "-v");
    double factor = argc > 1 + verbose ? atof(argv[1 + verbose]) : 1;
    size_t wrong = 0;
    if (!mkdtemp(folder)) return 1;
    printf("| stress | over | right | warned | caught | failed | out of time | silently wrong |\n|---|---|---|---|---|---|---|---|\n");
    for (size_t i = 0; i < sizeof CASES / sizeof *CASES; i++) wrong += run_case(i, folder, factor, verbose);
    rmdir(folder);
    nonreversible();
    return wrong != 0;
}

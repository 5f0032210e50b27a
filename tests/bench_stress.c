/* The shipped robustness maps: every map that a system file names, and those of the discrete problem, and how many cells are undetected.  And the nonreversible test:
 * which methods gain energy exponentially.
 * usage: bench_stress [-v] [SECONDS]        at most so many seconds per map (120) */
#include <dirent.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "motion/integrators.h"
#include "document/benchmark.h"
#include "commands/robustness.h"

enum { most_files = 500 };

static double seconds = 120;
static bool verbose;
static size_t wrong;

static void put_row(const char *command, const char *over, const nh_robustness *s, const nh_robustness_map *only)
{
    size_t count[NH_RUN_STATUSES] = {0};
    for (size_t i = 0; i < s->maps; i++)
        for (size_t j = 0; j < s->map[i].cells; j++)
            if (!only || only == &s->map[i]) count[s->map[i].cell[j].status]++;
    printf("| %s | %s |", command, over);
    for (int k = 0; k < NH_RUN_STATUSES; k++) printf(" %zu |", count[k]);
    puts("");
    fflush(stdout);
    wrong += count[NH_UNDETECTED];
    if (!verbose && !count[NH_UNDETECTED]) return;
    for (size_t i = 0; i < s->maps; i++)
        for (size_t j = 0; j < s->map[i].cells; j++) {
            const nh_robustness_cell *c = &s->map[i].cell[j];
            if (verbose || c->status == NH_UNDETECTED)
                fprintf(stderr, "%s: %g, %g, %s: %s: %s\n", s->map[i].name, c->at, c->second_at, c->method, nh_run_record_status_name(c->status), c->note ? c->note : "");
        }
}

static nh_robustness *stress_of(const char *path, const char *over, double budget)
{
    nh_error error;
    nh_error_clear(&error);
    nh_request q = {.system_path = path};
    nh_options_default(&q.options);
    nh_robustness *s = nh_robustness_create(&q, over, budget, &error);
    if (s) return s;
    fprintf(stderr, "%s: %s\n", path, error.what);
    exit(1);
}

/* The name by which the command line finds it. */
static void name_of(const char *path, char out[100])
{
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    snprintf(out, 100, "%.*s", (int)(strlen(name) - 5), name);
}

static void run_named(const char *path)
{
    nh_error error;
    nh_error_clear(&error);
    nh_system *system = nh_system_read(path, 0, NULL, &error);
    char name[100], command[400];
    name_of(path, name);
    for (size_t i = 0; system && i < system->robustness_maps; i++) {
        nh_robustness *s = stress_of(path, system->robustness_map[i].name, seconds);
        snprintf(command, sizeof command, "`nhsym benchmark %s --over \"%s\"`", name, system->robustness_map[i].name);
        put_row(command, system->robustness_map[i].over, s, NULL);
        nh_robustness_free(s);
    }
    nh_system_free(system);
}

static int by_name(const void *a, const void *b) { return strcmp(*(char *const *)a, *(char *const *)b); }

static void run_folder(const char *folder)
{
    char *path[most_files];
    size_t files = 0;
    DIR *d = opendir(folder);
    for (struct dirent *entry; d && (entry = readdir(d)) && files < most_files;) {
        if (!strstr(entry->d_name, ".yaml")) continue;
        path[files] = malloc(strlen(folder) + strlen(entry->d_name) + 2);
        sprintf(path[files++], "%s/%s", folder, entry->d_name);
    }
    if (d) closedir(d);
    qsort(path, files, sizeof *path, by_name);
    for (size_t i = 0; i < files; i++) {
        run_named(path[i]);
        free(path[i]);
    }
}

/* The maps of the discrete problem, of the first seconds of everything. */
static void run_fits(const char *path)
{
    static const char *const names[] = {"clustered samples", "noisy samples", "ansatz at the edge of dependence", "frequencies that nearly coincide"};
    char name[100], command[400];
    nh_robustness *s = stress_of(path, "samples", seconds);
    name_of(path, name);
    for (size_t i = 0; i < s->maps; i++)
        for (size_t k = 0; k < sizeof names / sizeof *names; k++)
            if (!strcmp(s->map[i].name, names[k])) {
                snprintf(command, sizeof command, "`nhsym benchmark %s --over samples`: %s", name, names[k]);
                put_row(command, s->map[i].axis, s, &s->map[i]);
            }
    nh_robustness_free(s);
}

/* ---- the nonreversible test ---- */

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
    nh_system *s = nh_system_read("systems/stress/driven_particle.yaml", 0, NULL, &error);
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
    verbose = argc > 1 && !strcmp(argv[1], "-v");
    if (argc > 1 + verbose) seconds = atof(argv[1 + verbose]);
    static const char *const fits[] = {"systems/sleigh.yaml", "systems/spherical_pendulum.yaml", "systems/henon_heiles.yaml", "systems/nonholonomic_oscillator.yaml", "systems/ball_on_turntable.yaml"};
    printf("| map | over | accurate | flagged | detected | failed | timeout | undetected | not run |\n|---|---|---|---|---|---|---|---|---|\n");
    run_folder("systems");
    run_folder("systems/stress");
    for (size_t i = 0; i < sizeof fits / sizeof *fits; i++) run_fits(fits[i]);
    nonreversible();
    return wrong != 0;
}

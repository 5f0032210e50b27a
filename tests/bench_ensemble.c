/* Many motions at once against the same motions one by one, by the same method and by CVODE Adams at the same tolerance, on one thread. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "motion/integrators.h"
#include "motion/ensemble.h"

enum { members = 10000, repetitions = 3, outputs = 2 };

static const struct {
    const char *path;
    double z0[16], until;
} CASES[] = {
    {"systems/sleigh.yaml", {0.3, 0, 0, 2, 0.7}, 10},
    {"systems/contact_oscillator.yaml", {1, 0.2, 0.3, 0.9, 0.5}, 10},
    {"systems/henon_heiles.yaml", {0.1, 0.2, 0.25, -0.1}, 20},
    {"systems/ball_on_turntable.yaml", {0.5, 0.3, 0.2, 0.4, 0.6}, 5},
};

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* `end` NULL: by CVODE. */
static double one_by_one(const nh_trajectory_request *q, size_t size, const double *initial, double *end)
{
    double seconds = 0;
    nh_error error = {0};
    nh_dynamics *d = nh_dynamics_create(q->model);
    nh_flow_problem problem = nh_dynamics_problem(d);
    double *scale = calloc(size, sizeof *scale);
    for (size_t i = 0; i < size; i++) scale[i] = q->options->absolute;
    nh_flow_options how = {.method = NH_ADAMS, .max_steps = 1e9, .rtol = q->options->tolerance, .scale = scale};
    for (size_t k = 0; k < members; k++) {
        const double *z = initial + k * size;
        nh_motion *motion = end ? nh_gsl_odeiv(NH_RK8PD, &problem, z, q->count, q->times, &how, &error) : nh_cvode(&problem, z, q->count, q->times, &how, &error);
        seconds += motion->seconds;
        if (end) memcpy(end + k * size, motion->state + (motion->count - 1) * size, size * sizeof *end);
        nh_motion_free(motion);
    }
    free(scale);
    nh_dynamics_free(d);
    return seconds;
}

static void bench(size_t c)
{
    nh_error error = {0};
    nh_system *system = nh_system_read(CASES[c].path, 0, NULL, &error);
    nh_model *o = system ? nh_model_create(system, nh_chart_create(system, NH_CHART_AUTO, 1, &error), &error) : NULL;
    if (!o) {
        fprintf(stderr, "%s: %s\n", CASES[c].path, error.what);
        exit(1);
    }
    size_t size = o->m + o->n;
    double times[outputs] = {0, CASES[c].until}, alone[repetitions], v = 0, together[repetitions], worst = 0;
    double *initial = calloc(members * size, sizeof *initial), *end = calloc(members * size, sizeof *end);
    nh_options options;
    nh_options_default(&options);
    options.tolerance = 1e-8;
    nh_trajectory_request q = {.model = o, .count = outputs, .times = times, .options = &options, .n = size, .e = o->chart->symbol + 1};
    nh_ensemble_states(size, CASES[c].z0, members, 0.1, 1, initial);
    size_t left = 0;
    for (int r = 0; r < repetitions; r++) {
        alone[r] = one_by_one(&q, size, initial, end);
        if (r == 0) v = one_by_one(&q, size, initial, NULL);
        nh_ensemble *e = nh_ensemble_create(&q, members, initial, 1, &error);
        together[r] = e->seconds;
        left = e->alone;
        for (size_t k = 0; k < members; k++)
            for (size_t i = 0; i < size; i++) worst = fmax(worst, fabs(e->value[(k * outputs + 1) * size + i] - end[k * size + i]) / (1 + fabs(end[k * size + i])));
        nh_ensemble_free(e);
    }
    qsort(alone, repetitions, sizeof *alone, by_value);
    qsort(together, repetitions, sizeof *together, by_value);
    double a = alone[repetitions / 2], b = together[repetitions / 2];
    printf("| %s | %d | %zu | %.1f | %.1f | %.1f | %.1f | %.1f | %.0e |\n", system->name, members, left, 1e6 * v / members, 1e6 * a / members, 1e6 * b / members, v / b, a / b, worst);
    free(initial);
    free(end);
    nh_model_free(o);
    nh_system_free(system);
}

int main(void)
{
    printf("| system | members | computed alone | one by one by CVODE, us each | one by one by the same pair, us each | together, us each | CVODE / together | pair / together | difference |\n|---|---|---|---|---|---|---|---|---|\n");
    for (size_t c = 0; c < sizeof CASES / sizeof *CASES; c++) bench(c);
    return 0;
}

/* The same sleigh as bench_sympy.py and bench_octave.m, inside one process: milliseconds from the text to the equations, and of a motion at the loosest
 * tolerance whose error, against the closed form, is below a given one.
 * usage: bench_side ERROR          prints: ms of the derivation, ms of the motion, its error */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/clock.h"
#include "motion/trajectory.h"

enum { repetitions = 21 };

static int by_value(const void *a, const void *b) { return (*(const double *)a > *(const double *)b) - (*(const double *)a < *(const double *)b); }

int main(int argc, char **argv)
{
    double allowed = argc > 1 ? atof(argv[1]) : 1e-8, derive[repetitions], move[repetitions], times[2] = {0, 10}, q[3] = {0}, v[3] = {2, 0, 0}, error_found = INFINITY;
    nh_error error;
    nh_options options;
    nh_error_clear(&error);
    nh_options_default(&options);
    nh_state initial = {.q = q, .v = v};
    for (int r = 0; r < repetitions; r++) {
        double begin = nh_clock();
        nh_system *s = nh_system_read("systems/sleigh.yaml", 0, NULL, &error);
        nh_model *o = s ? nh_model_create(s, nh_chart_create(s, NH_CHART_AUTO, 1, &error), &error) : NULL;
        if (!o) return fprintf(stderr, "%s\n", error.what), 1;
        nh_dynamics *d = nh_dynamics_create(o);
        derive[r] = nh_clock() - begin;
        nh_trajectory_request request = {.model = o, .initial = &initial, .count = 2, .times = times, .options = &options, .n = o->m, .e = o->chart->symbol + 1, .method = nh_method_find("GSL rk8pd")};
        if (r == 0) options.tolerance = 1e-2;
        do {
            if (r == 0) options.tolerance /= 2;
            nh_trajectory *t = nh_trajectory_create(&request, &error);
            if (!t) return fprintf(stderr, "%s\n", error.what), 1;
            move[r] = t->motion->seconds;
            error_found = fabs(t->value[o->m] - 4 * atan(tanh(2 * times[1] / 4)));
            nh_trajectory_free(t);
        } while (error_found > allowed && options.tolerance > 1e-14);
        nh_dynamics_free(d);
        nh_model_free(o);
        nh_system_free(s);
    }
    qsort(derive, repetitions, sizeof *derive, by_value);
    qsort(move, repetitions, sizeof *move, by_value);
    printf("%.3f %.4f %.1e\n", 1e3 * derive[repetitions / 2], 1e3 * move[repetitions / 2], error_found);
    return 0;
}

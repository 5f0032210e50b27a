/* Is an accuracy that is said to be reached reached, and what does it cost?  Every system of a folder, three starts and times each, eight accuracies;
 * then all of it again by what a chart of one second, from another start, found to be the cheapest.
 * usage: bench_accuracy FOLDER [-v] */
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>

#include "accuracy_cases.h"
#include "study/chart.h"

enum { most_files = 500, most_cases = 2000 };
static const double budget = 1; /* seconds of a chart */

static accuracy_case cases[2][most_cases]; /* without a chart, and with one */
static size_t counts[2];

static int by_name(const void *a, const void *b) { return strcmp(*(char *const *)a, *(char *const *)b); }
static int by_value(const void *a, const void *b) { return (*(const double *)a > *(const double *)b) - (*(const double *)a < *(const double *)b); }

static void try_start(accuracy_case *c, const char *name, bool verbose)
{
    accuracy_try(c, true);
    if (verbose || c->wrong)
        fprintf(stderr, "%s: until %g, %.0e asked, %.1e found (%s): %s; %.1f times the evaluations, %.1f times the time, %d runs; %s\n", name, c->until, c->eps, c->error, c->known ? "known" : "unknown",
                c->wrong ? "WRONG" : c->a.held ? "held" : "not held", (double)c->a.evaluations / (double)c->least_evaluations, c->a.seconds / c->least_seconds, c->a.runs, c->a.why);
}

static void try_file(const char *path, size_t index, bool verbose)
{
    nh_error error;
    nh_error_clear(&error);
    nh_system *system = nh_system_read(path, 0, NULL, &error);
    nh_model *o = system ? nh_model_create(system, nh_chart_create(system, NH_CHART_AUTO, 1, &error), &error) : NULL;
    nh_simulate_request request = {.system_path = path};
    nh_options_default(&request.options);
    nh_comparison *chart = o ? nh_compare(&request, budget, &error) : NULL;
    for (size_t i = 0; o && i < 2 * accuracy_starts; i++) {
        bool charted = i >= accuracy_starts;
        double *q = calloc(2 * o->m, sizeof *q);
        accuracy_case *c = &cases[charted][counts[charted]];
        if (counts[charted] < most_cases && (!charted || chart) && accuracy_start(c, o, index, i % accuracy_starts, q, q + o->m)) {
            if (charted) c->ways = chart->ranking[0].count, c->way = chart->ranking[0].way;
            try_start(c, system->name, verbose);
            counts[charted]++;
        }
        free(q);
    }
    nh_comparison_free(chart);
    nh_model_free(o);
    nh_system_free(system);
}

static double part(size_t n, double *x, double at)
{
    qsort(x, n, sizeof *x, by_value);
    return n ? x[(size_t)(at * (double)(n - 1))] : NAN;
}

static void report(size_t count, const accuracy_case *list, double eps)
{
    static double evaluations[most_cases], seconds[most_cases], ratio[most_cases];
    size_t asked = 0, held = 0, unknown = 0, wrong = 0, n = 0;
    for (size_t i = 0; i < count; i++) {
        const accuracy_case *c = &list[i];
        if (eps > 0 && fabs(log10(c->eps / eps)) > 0.1) continue;
        asked++;
        held += c->a.held;
        unknown += c->a.held && !c->known;
        wrong += c->wrong;
        if (!c->a.held || !c->known || !c->least_evaluations) continue;
        evaluations[n] = (double)c->a.evaluations / (double)c->least_evaluations;
        seconds[n] = c->a.seconds / c->least_seconds;
        ratio[n++] = c->error / c->eps;
    }
    char name[32];
    snprintf(name, sizeof name, "%.0e", eps);
    printf("| %s | %zu | %zu | %zu | %zu | %.2g | %.2g | %.1f | %.1f | %.1f | %.1f |\n", eps > 0 ? name : "all", asked, held, wrong, unknown, part(n, ratio, 0.5), part(n, ratio, 1), part(n, evaluations, 0.5),
           part(n, evaluations, 0.9), part(n, seconds, 0.5), part(n, seconds, 0.9));
}

int main(int argc, char **argv)
{
    static char *path[most_files];
    size_t files = 0;
    DIR *folder = argc > 1 ? opendir(argv[1]) : NULL;
    if (!folder) return fprintf(stderr, "usage: bench_accuracy FOLDER [-v]\n"), 2;
    for (struct dirent *entry; (entry = readdir(folder)) && files < most_files;) {
        if (!strstr(entry->d_name, ".yaml")) continue;
        path[files] = malloc(strlen(argv[1]) + strlen(entry->d_name) + 2);
        sprintf(path[files++], "%s/%s", argv[1], entry->d_name);
    }
    closedir(folder);
    qsort(path, files, sizeof *path, by_name);
    for (size_t i = 0; i < files; i++) try_file(path[i], i, argc > 2);
    size_t wrong = 0, measured = 0;
    for (size_t k = 0; k < 2; k++) {
        if (k) printf("\nThe same after `nhsym chart`, of %g s and from another start, by the cheapest way that it measured:\n\n", budget);
        printf("| eps | cases | accepted | accepted and wrong | accepted, truth unknown | error / eps, median | largest | evaluations / cheapest, median | 90 %% | time / cheapest, median | 90 %% |\n"
               "|---|---|---|---|---|---|---|---|---|---|---|\n");
        for (int i = 0; i < accuracy_asked; i++) report(counts[k], cases[k], pow(10, -4 - i));
        report(counts[k], cases[k], 0);
        for (size_t i = 0; i < counts[k]; i++) wrong += cases[k][i].wrong, measured += cases[k][i].a.measured;
    }
    printf("\nBy the chart's choice: %zu of %zu.\n", measured, counts[1]);
    for (size_t i = 0; i < files; i++) free(path[i]);
    return wrong != 0;
}

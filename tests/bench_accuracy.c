/* Is an accuracy that is said to be reached reached, and what does it cost?  Every system of a folder, six starts and three times each, eight accuracies.
 * usage: bench_accuracy FOLDER [-v] */
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>

#include "accuracy_cases.h"

enum { most_files = 500, most_cases = 2000 };

static accuracy_case cases[most_cases];
static size_t count;

static int by_name(const void *a, const void *b) { return strcmp(*(char *const *)a, *(char *const *)b); }
static int by_value(const void *a, const void *b) { return (*(const double *)a > *(const double *)b) - (*(const double *)a < *(const double *)b); }

static void try_start(accuracy_case *c, const char *name, bool verbose)
{
    accuracy_try(c, true);
    if (verbose || c->wrong)
        fprintf(stderr, "%s: until %g, %.0e wanted, %.1e found (%s): %s; %.1f times the evaluations, %.1f times the counted work, %.1f times the time, %d runs; %s\n", name, c->until, c->eps, c->error,
                c->known ? "known" : "unknown", c->wrong ? "WRONG" : c->a.held ? "held" : "not held", (double)c->a.evaluations / (double)c->least_evaluations, c->a.effort / c->least_effort,
                c->a.seconds / c->least_seconds, c->a.runs, c->a.why);
}

static void try_file(const char *path, size_t index, bool verbose)
{
    nh_error error;
    nh_error_clear(&error);
    nh_system *system = nh_system_read(path, 0, NULL, &error);
    nh_model *o = system ? nh_model_create(system, nh_chart_create(system, NH_CHART_AUTO, 1, &error), &error) : NULL;
    for (size_t i = 0; o && i < accuracy_starts && count < most_cases; i++) {
        double *q = calloc(2 * o->m, sizeof *q);
        if (accuracy_start(&cases[count], o, index, i, q, q + o->m)) try_start(&cases[count++], system->name, verbose);
        free(q);
    }
    nh_model_free(o);
    nh_system_free(system);
}

static double part(size_t n, double *x, double at)
{
    qsort(x, n, sizeof *x, by_value);
    return n ? x[(size_t)(at * (double)(n - 1))] : NAN;
}

static void report(double eps)
{
    static double evaluations[most_cases], effort[most_cases], seconds[most_cases], ratio[most_cases];
    size_t asked = 0, held = 0, unknown = 0, wrong = 0, n = 0;
    for (size_t i = 0; i < count; i++) {
        const accuracy_case *c = &cases[i];
        if (eps > 0 && fabs(log10(c->eps / eps)) > 0.1) continue;
        asked++;
        held += c->a.held;
        unknown += c->a.held && !c->known;
        wrong += c->wrong;
        if (!c->a.held || !c->known || !c->least_evaluations) continue;
        evaluations[n] = (double)c->a.evaluations / (double)c->least_evaluations;
        effort[n] = c->a.effort / c->least_effort;
        seconds[n] = c->a.seconds / c->least_seconds;
        ratio[n++] = c->error / c->eps;
    }
    char name[32];
    snprintf(name, sizeof name, "%.0e", eps);
    printf("| %s | %zu | %zu | %zu | %zu | %.2g | %.2g | %.1f | %.1f | %.1f | %.1f | %.1f | %.1f |\n", eps > 0 ? name : "all", asked, held, wrong, unknown, part(n, ratio, 0.5), part(n, ratio, 1), part(n, evaluations, 0.5),
           part(n, evaluations, 0.9), part(n, effort, 0.5), part(n, effort, 0.9), part(n, seconds, 0.5), part(n, seconds, 0.9));
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
    printf("| eps | cases | accepted | accepted and wrong | accepted, truth unknown | error / eps, median | largest | evaluations / cheapest, median | 90 %% | counted work / cheapest, median | 90 %% | time / cheapest, median | 90 %% |\n"
           "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (int i = 0; i < accuracy_asked; i++) report(pow(10, -4 - i));
    report(0);
    for (size_t i = 0; i < count; i++) wrong += cases[i].wrong, measured += cases[i].a.measured;
    printf("\nBy a method that was measured on a piece of the motion: %zu of %zu.\n", measured, count);
    for (size_t i = 0; i < files; i++) free(path[i]);
    return wrong != 0;
}

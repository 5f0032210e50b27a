/* bench_fields: the page docs/fields.md, what fits of fields find in each system of a folder.
 *
 *     bench_fields FOLDER
 */
#include <dirent.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "commands/analyze.h"

enum { MOST = 400 };
static const double tight = 1e-8; /* the aim for the angle */

static int by_name(const void *a, const void *b) { return strcmp(*(char *const *)a, *(char *const *)b); }

static nh_analysis *analysed(const char *path, const char *route)
{
    nh_error error = {0};
    nh_request q = {.system_path = path, .route = route};
    nh_options_default(&q.options);
    q.options.max_seconds = 1e6;
    q.options.threads = 1;
    return nh_analysis_create(&q, &error);
}

static bool of_fields(const nh_stage_record *s) { return !strncmp(s->name, "fields", 6) || strstr(s->name, "of fields"); }

/* The largest residual of the equations, of currents with a field. */
static double residual(const nh_analysis *r)
{
    double worst = 0;
    for (size_t k = 0; k < r->list->count; k++)
        if (r->list->found[k].has_symmetry) worst = fmax(worst, r->list->found[k].symmetry.noether_residual);
    return worst;
}

typedef struct {
    size_t systems, fields, currents, both, angles, loose;
    double time, total;
} sums;

static void row(const char *name, const nh_analysis *fields, const nh_analysis *currents, const nh_analysis *both, sums *sum)
{
    size_t columns = 0, null = 0, f = fields->list->independent, c = currents->list->independent, b = both->list->independent;
    double seconds = 0, total = both->timing.total;
    for (size_t i = 0; i < both->stages; i++) {
        const nh_stage_record *s = &both->stage[i];
        if (!of_fields(s)) continue;
        columns = s->columns > columns ? s->columns : columns;
        null += s->dimension;
        seconds += s->seconds;
    }
    const nh_counted_space *space = &fields->counted_space;
    char angle[24] = "-";
    if (space->compared && space->fields) snprintf(angle, sizeof angle, "%.0e", space->angle);
    printf("| %s | %zu | %zu | %zu | %.0e | %s | %zu | %zu | %zu | %.0f |\n", name, columns, fields->samples, null, residual(fields), angle, f, c, b, 100 * seconds / total);
    fflush(stdout);
    sum->systems++;
    sum->fields += f;
    sum->currents += c;
    sum->both += b;
    sum->angles += space->compared && space->fields;
    sum->loose += space->compared && space->fields && !(space->angle < tight);
    sum->time += seconds;
    sum->total += total;
}

int main(int argc, char **argv)
{
    static char *names[MOST];
    size_t n = 0;
    sums sum = {0};
    DIR *folder = argc == 2 ? opendir(argv[1]) : NULL;
    if (!folder) return fprintf(stderr, "usage: bench_fields FOLDER\n"), 2;
    for (struct dirent *e; (e = readdir(folder)) && n < MOST;) {
        size_t length = strlen(e->d_name);
        if (length > 5 && !strcmp(e->d_name + length - 5, ".yaml")) names[n++] = strdup(e->d_name);
    }
    closedir(folder);
    qsort(names, n, sizeof *names, by_name);
    printf("| system | columns | samples | null | residual | angle | fields | currents | both | time |\n|---|---|---|---|---|---|---|---|---|---|\n");
    for (size_t i = 0; i < n; i++) {
        char path[600], *name = names[i];
        snprintf(path, sizeof path, "%s/%s", argv[1], name);
        nh_analysis *fields = analysed(path, "fields"), *currents = analysed(path, "currents"), *both = analysed(path, "both");
        name[strlen(name) - 5] = 0;
        if (fields && currents && both) row(name, fields, currents, both, &sum);
        else printf("| %s | no analysis | | | | | | | | |\n", name);
        nh_analysis_free(fields);
        nh_analysis_free(currents);
        nh_analysis_free(both);
        free(name);
    }
    printf("\n%zu systems: %zu integrals by fields, %zu by currents, %zu by both; %zu angles, %zu of them above %.0e; the fits of fields take %.0f %% of the time.\n", sum.systems, sum.fields, sum.currents, sum.both, sum.angles,
           sum.loose, tight, 100 * sum.time / sum.total);
    return sum.loose ? 1 : 0;
}

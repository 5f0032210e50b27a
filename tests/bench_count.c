/* bench_count: how many integrals polynomial in the velocities systems have, beside those that their files know.
 *
 *     bench_count [DEGREE] [time] [generic] [shape|closed] [only] [work N] FILE...
 *
 * A line per file and degree.  Degree 0: as far as it goes; only: this degree, not those below it; N: the work of one
 * count at most, 3e9.
 */
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "count/count.h"
#include "problem/analysis_file.h"

static void count_file(const char *path, const nh_count_question *asked)
{
    nh_error error;
    nh_error_clear(&error);
    nh_system *y = nh_system_read(path, 0, NULL, &error);
    nh_chart *chart = y ? nh_chart_create(y, NH_CHART_AUTO, 1, &error) : NULL;
    nh_model *o = chart ? nh_model_create(y, chart, &error) : NULL;
    if (!o) {
        printf("%s: %s\n", path, error.what);
        return;
    }
    nh_ex *known = calloc(y->currents + 1, sizeof *known);
    size_t n = 0;
    for (size_t k = 0; k < y->currents; k++) n += nh_analysis_file_to_chart(o, y->current[k].value, &known[n], &error);
    nh_count_question q = *asked;
    q.known = n;
    q.current = known;
    double start = nh_clock_of_thread();
    nh_count c = nh_count_integrals(o, &q);
    printf("%s: %.3f s, work %.1e, step %zu, leaf %zu, prime %lu%s%s%s%s\n", path, nh_clock_of_thread() - start, c.work, c.step, c.leaf, (unsigned long)c.prime, c.obstacle ? ", OBSTACLE: " : "", c.obstacle ? c.obstacle : "",
           c.end ? ", end: " : "", c.end ? c.end : "");
    for (size_t k = 0; k < c.rows; k++)
        printf("   degree %zu: N = %zu, known %zu, rank %zu of %zu, order %zu%s%s\n", c.row[k].degree, c.row[k].bound, c.row[k].known, c.row[k].known_rank, c.row[k].rank, c.row[k].order, c.row[k].settled ? ", settled" : "", c.row[k].complete ? ", COMPLETE" : "");
    fflush(stdout);
    free(known);
    nh_model_free(o);
}

int main(int argc, char **argv)
{
    nh_count_question q = {.degree = 2, .work = 3e9};
    for (int i = 1; i < argc; i++) {
        if (isdigit((unsigned char)argv[i][0])) q.degree = strtoul(argv[i], NULL, 10);
        else if (!strcmp(argv[i], "time")) q.time = true;
        else if (!strcmp(argv[i], "generic")) q.generic = true;
        else if (!strcmp(argv[i], "only")) q.alone = true;
        else if (!strcmp(argv[i], "shape")) q.shape = NH_NOT_CYCLIC;
        else if (!strcmp(argv[i], "closed")) q.shape = NH_CLOSED_SHAPE;
        else if (!strcmp(argv[i], "work") && i + 1 < argc) q.work = strtod(argv[++i], NULL);
        else count_file(argv[i], &q);
    }
    return 0;
}

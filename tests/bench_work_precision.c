/* bench_work_precision: the drawings of docs/work_precision.md, and the page.
 *
 *     bench_work_precision systems docs/pictures        writes work_NAME.svg, and the page to standard output
 */
#include <stdio.h>
#include <string.h>

#include "base/output.h"
#include "document/benchmark.h"

static const double seconds = 20;
static const char *const name[] = {"sleigh", "rolling_disk", "ball_on_turntable", "contact_oscillator", "kepler", "snakeboard"};

/* The accurate run of all coordinates with the least time, or the fewest evaluations, of those with a smaller error. */
static const nh_run_record *best(const nh_benchmark *b, double below, bool by_evaluations)
{
    const nh_run_record *found = NULL;
    for (size_t i = 0; i < b->count; i++) {
        const nh_run_record *m = &b->item[i];
        if (m->status != NH_ACCURATE || m->reduced || !(m->error <= below)) continue;
        if (!found || (by_evaluations ? m->evaluations < found->evaluations : m->seconds < found->seconds)) found = m;
    }
    return found;
}

static void put_table(const nh_benchmark *b)
{
    static const double goal[] = {1e-3, 1e-6, 1e-9, 1e-12};
    printf("| error below | fewest evaluations | | fastest | seconds, quartiles |\n|---|---|---|---|---|\n");
    for (size_t i = 0; i < sizeof goal / sizeof *goal; i++) {
        const nh_run_record *few = best(b, goal[i], true), *fast = best(b, goal[i], false);
        if (few && fast)
            printf("| %.0e | %s in %s | %ld | %s in %s | %.2g, %.2g to %.2g |\n", goal[i], few->method, few->formulation, few->evaluations, fast->method, fast->formulation, fast->seconds,
                   fast->seconds_low, fast->seconds_high);
    }
    puts("");
}

static void put_orders(const nh_benchmark *b)
{
    size_t right = 0;
    for (size_t i = 0; i < b->orders; i++) right += b->order[i].judged.reason == NH_ORDER_EXPECTED;
    printf("%zu of %zu methods with a fixed step show the order of their theory.", right, b->orders);
    nh_text others;
    nh_text_init(&others);
    if (nh_benchmark_put_orders(b, b->orders, &others)) printf(" %s", nh_text_string(&others));
    nh_text_clear(&others);
    puts("\n");
}

static bool put(const char *folder, const char *system, const char *into)
{
    char path[500], to[500];
    nh_error error;
    nh_error_clear(&error);
    snprintf(path, sizeof path, "%.200s/%.200s.yaml", folder, system);
    snprintf(to, sizeof to, "%.200s/work_%.200s.svg", into, system);
    nh_request q = {.system_path = path};
    nh_options_default(&q.options);
    q.options.benchmark_columns = 2; /* no discrete problem */
    nh_benchmark *b = nh_benchmark_run(&q, seconds, &error);
    nh_text svg;
    nh_text_init(&svg);
    if (b) nh_benchmark_svg(b, &svg);
    bool good = b && nh_output_write(to, nh_text_string(&svg), svg.length, &error);
    if (good) {
        const nh_system *s = b->question->system;
        printf("## %s\n\n`nhsym benchmark %s --no-analysis --budget %.0fs --option benchmark_columns=2 --svg work_%s.svg`\n\n", s->title ? s->title : s->name, system, seconds, system);
        printf("![Work against error: %s](pictures/work_%s.svg)\n\n", s->title ? s->title : s->name, system);
        put_table(b);
        put_orders(b);
    } else {
        fprintf(stderr, "%s: %s\n", system, error.what);
    }
    nh_text_clear(&svg);
    nh_benchmark_free(b);
    return good;
}

int main(int argc, char **argv)
{
    size_t drawn = 0, all = sizeof name / sizeof *name;
    if (argc != 3) return 2;
    for (size_t i = 0; i < all; i++) drawn += put(argv[1], name[i], argv[2]);
    return drawn != all;
}

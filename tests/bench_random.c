/* bench_random: random systems with built-in symmetries, analysed without an analysis file, against what was built in.
 *
 *     bench_random [SYSTEMS [SEED [FOLDER|- [OPTION=VALUE...]]]]
 *
 * prints a table; keeps the files in FOLDER; the exit code is 1 when something false is reported.
 *
 * A built-in current that is missing is counted and named, and does not fail: the program promises what it finds, not that it finds all. */
#include <unistd.h>

#include "catalogue.h"
#include "random_system.h"

#include "graph/dag.h"

int main(int argc, char **argv)
{
    size_t n = argc > 1 ? strtoull(argv[1], NULL, 10) : 200, known = 0, missing = 0, wrong = 0, unread = 0, uncertain = 0, found = 0, rounded = 0, almosts = 0, fast = 0;
    uint64_t seed = argc > 2 ? strtoull(argv[2], NULL, 10) : 1;
    bool keep = argc > 3 && strcmp(argv[3], "-");
    char folder[4000] = "/tmp/nhsym-random-XXXXXX", path[4096];
    if (keep) snprintf(folder, sizeof folder, "%s", argv[3]);
    else if (!mkdtemp(folder)) return 2;
    double total = 0;
    nh_options options;
    nh_options_default(&options);
    options.steps = 2000; /* the motions are not what is judged here */
    options.max_seconds = 1e6; /* counted work ends a search, the same on every machine */
    for (int i = 4; i < argc; i++) {
        char *equals = strchr(argv[i], '=');
        nh_error error = {0};
        if (equals) *equals = 0;
        if (!equals || !nh_options_set(&options, argv[i], equals + 1, &error)) return fprintf(stderr, "%s: %s\n", argv[i], error.what), 2;
    }
    print_head("system");
    for (size_t i = 0; i < n; i++) {
        char label[200];
        random_system r = random_system_create(seed * 1000003 + i);
        snprintf(path, sizeof path, "%s/random%zu.yaml", folder, i);
        FILE *file = fopen(path, "w");
        if (!file) return 2;
        random_system_write(&r, "random", file);
        fclose(file);
        row o = compare_path(path, &options);
        snprintf(label, sizeof label, "%zu: %s", i, random_system_note(&r));
        print_row(label, &o);
        nh_dag_free(r.dag);
        if (!keep) remove(path);
        known += o.known;
        missing += o.missing;
        wrong += o.wrong;
        unread += o.unread;
        uncertain += o.uncertain;
        found += o.found;
        rounded += o.rounded;
        almosts += o.almosts;
        fast += o.fast;
        total += o.seconds;
    }
    if (!keep) rmdir(folder);
    printf("\n%zu random systems from seed %llu: %zu independent currents, %zu false, %zu not certified; of %zu built in %zu missing; %zu not checked by the multiplier form, "
           "%zu only to the digits of doubles; %zu called almost conserved, %zu of them not slow; %.0f seconds in all.\n",
           n, (unsigned long long)seed, found, wrong, uncertain, known, missing, unread, rounded, almosts, fast, total);
    return n == 0 || wrong > 0;
}

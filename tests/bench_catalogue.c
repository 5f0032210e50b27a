/* bench_catalogue: every system of a folder analysed without an analysis file, against the integrals that its file knows.
 *
 *     bench_catalogue systems [SEED]        prints a table; the exit code is 1 when something within reach is missing or something false is reported or
 *                                       written
 * The pictures in it are drawn by bench_pictures.
 */
#include "catalogue.h"

int main(int argc, char **argv)
{
    char *name[most_files];
    const char *folder = argc > 1 ? argv[1] : "systems";
    uint64_t seed = argc > 2 ? strtoull(argv[2], NULL, 10) : 0;
    size_t n = list(folder, name), missing = 0, excused = 0, wrong = 0, unread = 0, almosts = 0, fast = 0;
    double total = 0;
    print_head("system");
    for (size_t i = 0; i < n; i++) {
        row o = compare_file(folder, name[i], seed, 0);
        char cell[500];
        snprintf(cell, sizeof cell, "docs/catalogue/%.200s.svg", name[i]);
        bool drawn = access(cell, R_OK) == 0; /* by `make pictures` */
        snprintf(cell, sizeof cell, drawn ? "%.200s<br>![its motion](catalogue/%.200s.svg)" : "%.200s", name[i], name[i]);
        print_row(cell, &o);
        missing += o.missing;
        excused += o.excused;
        wrong += o.wrong + o.untrue;
        total += o.seconds;
        unread += o.unread;
        almosts += o.almosts;
        fast += o.fast;
        free(name[i]);
    }
    printf("\n%zu systems, %zu known integrals missing (%zu of them out of reach), %zu false, %zu not checked by the multiplier form; %zu called almost conserved, %zu of them not slow; %.1f seconds in all.\n", n, missing, excused, wrong, unread, almosts, fast, total);
    return n == 0 || missing - excused + wrong > 0;
}

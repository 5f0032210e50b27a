/* bench_parameters: a system with other values of its parameters.
 *
 *     bench_parameters FILE [SEED] [currents|reductions]
 *
 * Three sets of values: distinct whole numbers, decimals of five digits, and the file's values with one parameter at 1, at 0 or at another one's value; sets for
 * which the system is another one (no metric, other constraints, an error) are drawn again.  Prints a row of docs/parameters.md, which `make parameters` puts
 * together; nothing for a system without parameters.  The exit code is 1 when it could not be read. */
#include "parameter_sets.h"

static const char *const mark[] = {"letters", "functions", "limited", "no meaning", "differs"};

int main(int argc, char **argv)
{
    const char *path = argc > 1 ? argv[1] : "", *what = argc > 3 ? argv[3] : "", *file = strrchr(path, '/');
    parameters_row o = parameters_of(path, strcmp(what, "reductions") != 0, strcmp(what, "currents") != 0, argc > 2 ? strtoull(argv[2], NULL, 10) : 1);
    file = file ? file + 1 : path;
    if (!o.formulas && *o.words) fprintf(stderr, "%s: %s\n", path, o.words);
    bool good = o.formulas || !*o.words;
    if (o.formulas) {
        printf("| %.*s | %zu |", (int)strcspn(file, "."), file, o.formulas);
        for (size_t set = 0; set < PARAMETER_SETS; set++) printf(" %s |", o.drawn[set] ? mark[o.fate[set]] : "-");
        printf(" %zu | %s |\n", o.limited, o.words);
    }
    nh_free(o.words);
    return good ? EXIT_SUCCESS : EXIT_FAILURE;
}

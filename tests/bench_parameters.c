/* bench_parameters: every system of a folder with other values of its parameters.
 *
 *     bench_parameters systems [SEED] [currents|reductions]
 *
 * Per system with parameters three sets of values: distinct whole numbers, decimals of five digits, and the file's values with one parameter at 1, at 0 or
 * at another one's value; sets for which the system is another one (no metric, other constraints, an error) are drawn again.  Same: the formulas are the
 * file's, letter for letter, of the special set after its value is put in.  The exit code is 1 when no system could be read. */
#include "catalogue.h"
#include "parameter_sets.h"

static const char *mark(const parameters_row *o, size_t set) { return !o->drawn[set] ? "-" : o->same[set] ? "yes" : "no"; }

typedef struct {
    size_t systems, formulas, limited, same[PARAMETER_SETS], drawn[PARAMETER_SETS], all;
} totals;

static void add(totals *t, const parameters_row *o)
{
    bool all = true;
    t->systems++;
    t->formulas += o->formulas;
    t->limited += o->limited;
    for (size_t set = 0; set < PARAMETER_SETS; set++) {
        t->drawn[set] += o->drawn[set];
        t->same[set] += o->drawn[set] && o->same[set];
        all &= !o->drawn[set] || o->same[set];
    }
    t->all += all;
}

int main(int argc, char **argv)
{
    char *name[most_files];
    const char *folder = argc > 1 ? argv[1] : "systems", *what = argc > 3 ? argv[3] : "";
    uint64_t seed = argc > 2 ? strtoull(argv[2], NULL, 10) : 1;
    size_t n = list(folder, name);
    totals t = {0};
    puts("| system | formulas | whole numbers | decimals | one special value | for some values only | which |\n|---|---|---|---|---|---|---|");
    for (size_t i = 0; i < n; free(name[i++])) {
        char path[4096];
        snprintf(path, sizeof path, "%s/%s.yaml", folder, name[i]);
        parameters_row o = parameters_of(path, strcmp(what, "reductions") != 0, strcmp(what, "currents") != 0, seed);
        if (o.formulas) {
            printf("| %s | %zu | %s | %s | %s | %zu | %s |\n", name[i], o.formulas, mark(&o, 0), mark(&o, 1), mark(&o, 2), o.limited, o.words);
            fflush(stdout);
            add(&t, &o);
        }
        nh_free(o.words);
    }
    printf("\n%zu systems with parameters, %zu formulas. The same with whole numbers in %zu of %zu, with decimals in %zu of %zu, with one special value in %zu of %zu, in all sets in %zu; for some values only: %zu.\n",
           t.systems, t.formulas, t.same[0], t.drawn[0], t.same[1], t.drawn[1], t.same[2], t.drawn[2], t.all, t.limited);
    return t.systems == 0;
}

/* bench_perturbed: every system of a folder with a small generic term added to its Lagrangian: what was conserved is told apart from what nearly is.
 *
 *     bench_perturbed systems [SEED]
 *
 * Original: independent currents of the unperturbed system.  Survive: of those, conserved with the term too, by the multiplier form.  Found: of the
 * perturbed system.  Lost: survivors that are not functions of those found.  The exit code is 1 when something false is reported or something is lost. */
#include "perturbed.h"

int main(int argc, char **argv)
{
    char *name[most_files];
    const char *folder = argc > 1 ? argv[1] : "systems";
    uint64_t seed = argc > 2 ? strtoull(argv[2], NULL, 10) : 1;
    nh_options options;
    nh_options_default(&options);
    size_t n = list(folder, name), wrong = 0, lost = 0, copies = 0, almosts = 0, fast = 0;
    puts("| system | term times | original | survive | found | false | lost | not certified | seconds | which |\n|---|---|---|---|---|---|---|---|---|---|");
    for (size_t i = 0; i < n; i++) {
        for (size_t k = 0; k < PERTURBATIONS; k++) {
            perturbed p = perturbed_copy(folder, name[i], k, seed, &options);
            printf("| %s | 1e%d | %zu | %zu | %zu | %zu | %zu | %zu | %.2f | %s |\n", name[i], perturbation[k], p.original, p.survive, p.o.found, p.o.wrong, p.o.missing,
                   p.o.uncertain, p.o.seconds, p.o.names);
            fflush(stdout);
            wrong += p.o.wrong;
            lost += p.o.missing;
            almosts += p.o.almosts;
            fast += p.o.fast;
            copies++;
        }
        free(name[i]);
    }
    printf("\n%zu perturbed copies of %zu systems: %zu false, %zu lost; %zu called almost conserved, %zu of them not slow.\n", copies, n, wrong, lost, almosts, fast);
    return n == 0 || wrong + lost > 0;
}

/* bench_reductions: every system of a folder reduced from many initial states, against the full motion over ten units of time.
 *
 *     bench_reductions systems [STATES]
 *
 * Known: full motions that are known to 100 tolerances up to the end (the others are compared as far as they are known).  Followed: reduced motions that go as far, or until the constraints become
 * dependent.
 * Apart: those whose places differ by more than 100 tolerances, and what the full motion is unsure by, somewhere.  Times faster: the time of the full motions over that of the reduced ones, equal
 * tolerances, one run.  The exit code is 1 when a motion is apart or not followed. */
#include <stdlib.h>

#include "catalogue.h"
#include "reductions.h"

int main(int argc, char **argv)
{
    char *name[most_files];
    const char *folder = argc > 1 ? argv[1] : "systems";
    size_t states = argc > 2 ? strtoul(argv[2], NULL, 10) : 50, n = list(folder, name), wrong = 0, motions = 0, systems = 0;
    puts("| system | stage | group | states | known | followed | apart | largest distance | charts changed | times faster |\n|---|---|---|---|---|---|---|---|---|---|");
    for (size_t i = 0; i < n; i++) {
        static const char *const kinds[] = {"first, Chaplygin", "second", "whole group, V + D = TQ", "whole group", "quotient"};
        char path[300];
        nh_error error = {0};
        snprintf(path, sizeof path, "%s/%s.yaml", folder, name[i]);
        reductions_row all = reductions_of(path, states, &error);
        if (error.code != NH_OK) printf("| %s | %s |\n", name[i], error.what);
        wrong += error.code != NH_OK;
        systems += all.open;
        for (size_t s = 0; s < all.stages; s++) {
            const stage_row *o = &all.stage[s];
            char unsure[30] = "";
            if (o->unsure > o->apart) snprintf(unsure, sizeof unsure, " (%zu)", o->unsure);
            printf("| %s | %s | %s | %zu | %zu | %zu | %zu%s | %.1e | %zu | %.1f |\n", name[i], kinds[o->kind], o->group, o->states, all.known, o->whole, o->apart, unsure, o->worst, o->charts,
                   o->seconds > 0 ? o->full / o->seconds : 0);
            wrong += o->apart + (o->states - o->whole);
            motions += o->states;
        }
        fflush(stdout);
        nh_error_clear(&error);
        free(name[i]);
    }
    printf("\n%zu reduced motions of %zu systems: %zu apart or not followed.\n", motions, systems, wrong);
    return n == 0 || wrong > 0;
}

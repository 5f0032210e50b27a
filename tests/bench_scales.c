/* --accuracy over amplitudes of 1e-12 to 1e12, accuracies of 1e-4 to 1e-11 and units that are 1e9 times larger or smaller: how many motions are accepted, and is one of
 * them wrong? */
#include <stdlib.h>

#include "scales_cases.h"

typedef struct {
    size_t tried, held, wrong;
} count;

static void try_all(const scales_of *s, double eps, count *c)
{
    for (size_t i = 0; i < scales_systems; i++) {
        scales_result r = scales_try(&scales_all[i], s, eps);
        c->tried++, c->held += r.held, c->wrong += r.wrong;
        if (r.wrong || !r.held)
            printf("%s: %s, amplitude %g, units %g %g %g, wanted %g, found %g: %s\n", r.wrong ? "WRONG" : "not accepted", scales_all[i].name, s->amplitude, s->length, s->mass, s->time, eps, r.error, r.why);
    }
}

int main(void)
{
    count all = {0};
    for (int e = 4; e <= 11; e++) {
        for (int a = -12; a <= 12; a += 2) try_all(&(scales_of){pow(10, a), 1, 1, 1}, pow(10, -e), &all);
        for (int u = -9; u <= 9; u += 18) {
            double unit = pow(10, u);
            try_all(&(scales_of){1, unit, 1, 1}, pow(10, -e), &all);
            try_all(&(scales_of){1, 1, unit, 1}, pow(10, -e), &all);
            try_all(&(scales_of){1, 1, 1, unit}, pow(10, -e), &all);
        }
    }
    printf("%zu motions, %zu accepted, %zu accepted and wrong\n", all.tried, all.held, all.wrong);
    return all.wrong ? EXIT_FAILURE : EXIT_SUCCESS;
}

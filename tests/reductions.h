/* Every stage of a system's reduction from many initial states, against the full motion: for bench_reductions and test_reductions. */
#ifndef NH_TESTS_REDUCTIONS_H
#define NH_TESTS_REDUCTIONS_H

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "commands/reduce.h"

typedef struct {
    nh_stage_kind kind;
    char group[64];
    size_t states, whole;   /* started; followed as far as the full motion is known, or until the constraints become dependent */
    size_t apart;           /* further from it than 100 tolerances and what it is unsure by */
    size_t unsure;          /* not apart because of the latter only, or apart */
    size_t charts;          /* changes of slice or velocities */
    double worst;           /* largest distance */
    double seconds, full;   /* of the reduced motions that are complete, and of their full ones */
} stage_row;

typedef struct {
    size_t states, known;   /* started; full motions that are known up to the end */
    size_t stages;
    stage_row stage[4];
    bool open;              /* there is something to reduce by */
} reductions_row;

/* From the first `states` sample points (all are in the domain and satisfy the constraints). */
static inline reductions_row reductions_of(const char *path, size_t states, nh_error *error)
{
    reductions_row all = {0};
    nh_request q = {.system_path = path};
    nh_options_default(&q.options);
    nh_reduction *r = nh_reduction_create(&q, error);
    all.open = r && r->stages > 0 && r->group->action.d > 0;
    for (size_t i = 0; all.open && i < states && i < r->kinetic->places; i++) {
        if (!nh_reduction_again(r, i, error)) break;
        bool known = r->full_reached >= r->until;
        all.states++;
        all.known += known;
        for (size_t s = 0; s < r->stages; s++) {
            const nh_reduction_stage *t = &r->stage[s];
            size_t at = 0;
            while (at < all.stages && (all.stage[at].kind != t->kind || strncmp(all.stage[at].group, t->group, sizeof all.stage[at].group - 1))) at++;
            if (at == 4) continue;
            stage_row *o = &all.stage[at];
            if (at == all.stages) {
                all.stages++;
                o->kind = t->kind;
                snprintf(o->group, sizeof o->group, "%s", t->group);
            }
            o->states++;
            o->whole += (t->compared || r->full_reached == 0) && (t->reached >= r->full_reached || t->dependent);
            o->apart += nh_stage_apart(t, &r->options);
            o->unsure += t->unsure > 0;
            o->charts += t->charts;
            o->worst = fmax(o->worst, t->agreement);
            if (getenv("NHSYM_TEST_FIGURES") && (t->agreement > 100 * r->options.tolerance || !t->compared || t->reached < r->full_reached))
                printf("%s state %zu stage %zu: %.2g up to %.4g of %.4g; %s\n", path, i, s + 1, t->agreement, t->reached, r->full_reached, t->note);
            if (known && t->complete && t->seconds > 0) {
                o->seconds += t->seconds;
                o->full += r->full_seconds;
            }
        }
    }
    nh_reduction_free(r);
    return all;
}

#endif

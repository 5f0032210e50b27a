#include "motion/safeguards.h"

#include <math.h>

#include "base/memory.h"

void nh_guards_begin(nh_guards *g, const nh_flow_problem *problem, const nh_flow_options *options, const double *z,
                     size_t count, const double *times)
{
    static const double part = 1e-7; /* part of the whole motion */
    size_t n = problem->guards;
    *g = (nh_guards){.problem = problem, .longest = INFINITY, .least = part * fabs(times[count - 1] - times[0])};
    if (!options->guarded || !n) return;
    g->value = nh_alloc_array(2 * n, sizeof *g->value);
    g->sign = g->value + n;
    if (!problem->guard(times[0], z, g->sign, problem->context))
        for (size_t i = 0; i < n; i++) g->sign[i] = NAN; /* set by the first step */
}

void nh_guards_clear(nh_guards *g)
{
    nh_free(g->value);
    g->value = NULL;
}

/* The guard that has changed its sign, or cannot be computed; -1: none.  A guard that was zero at the start takes the
 * first sign that it has. */
static long changed(nh_guards *g, double t, const double *z)
{
    const nh_flow_problem *p = g->problem;
    bool good = p->guard(t, z, g->value, p->context);
    for (size_t i = p->turns && !p->own_guards ? p->guards - p->turns : 0; i < p->guards; i++) {
        if (!good || !isfinite(g->value[i])) return (long)i;
        if (!(fabs(g->sign[i]) > 0)) g->sign[i] = g->value[i];
        if (g->value[i] * g->sign[i] < 0 || (g->value[i] == 0 && g->sign[i] != 0)) return (long)i;
    }
    return -1;
}

nh_guard_verdict nh_guards_judge(nh_guards *g, double before, double now, const double *z, nh_motion *motion)
{
    if (!g->value) return NH_GUARD_KEPT;
    double way = fabs(now - before);
    long guard = changed(g, now, z);
    if (guard < 0) {
        /* there is no change any more, or it will be found again */
        if (g->longest <= g->least) g->longest = INFINITY;
        /* this was the first half of the way to the change */
        else if (way > 0.999 * g->longest) g->longest /= 2;
        return NH_GUARD_KEPT;
    }
    if (guard >= (long)(g->problem->guards - g->problem->turns) && isfinite(g->value[guard])) {
        motion->guard_hit = guard;
        return NH_GUARD_TURN;
    }
    g->longest = way / 2;
    if (way > g->least) return NH_GUARD_BACK;
    motion->guard_hit = guard;
    nh_motion_note(motion, "safeguard %ld goes through zero at t = %.10g", guard + 1, now);
    return NH_GUARD_END;
}

/* automatic: an explicit pair of order 8 whose motion is handed to CVODE BDF where that needs far less work.
 *
 * The pair runs first.  When its work exceeds a limit, BDF computes the same motion with a small part of the work that
 * the pair would need to the end; if it gets there, its motion is returned, otherwise the pair goes on from where it
 * is.  Where the pair itself fails before, BDF may need as much work.  So a motion that is not stiff costs at most that
 * part more. */
#include "motion/automatic.h"

#include <math.h>

#include "base/clock.h"
#include "base/effort.h"

/* work that BDF may always do where the pair fails; part of the time after which the pair's work is extrapolated */
static const double least_effort = 1e6, least_done = 1e-6;

typedef struct {
    const nh_flow_problem *problem;
    const nh_flow_options *options;
    const double *initial, *times;
    size_t count;
    double begin, now; /* units at the start; time of the last evaluation */
    bool tried;
    /* the motion by BDF, complete or ended by a guard or at a singular place; NULL: BDF does not take over */
    nh_motion *stiff;
} attempt;

static bool rate(double t, const double *z, double *out, void *context)
{
    attempt *a = context;
    a->now = t;
    return a->problem->rate(t, z, out, a->problem->context);
}

static bool guard(double t, const double *z, double *value, void *context)
{
    return ((attempt *)context)->problem->guard(t, z, value, ((attempt *)context)->problem->context);
}
static bool renew(double *z, void *context)
{
    return ((attempt *)context)->problem->renew(z, ((attempt *)context)->problem->context);
}
static bool wall(double t, const double *z, double *value, void *context)
{
    return ((attempt *)context)->problem->wall(t, z, value, ((attempt *)context)->problem->context);
}

static bool cancelled(const attempt *a)
{
    return a->options->cancelled && a->options->cancelled(a->options->cancel_context);
}

/* Runs BDF with at most so much work. */
static void try_stiff(attempt *a, double effort)
{
    nh_flow_options options = *a->options;
    nh_error ignored;
    nh_error_clear(&ignored);
    a->tried = true;
    options.effort = options.effort > 0 ? fmin(effort, options.effort) : effort;
    nh_motion *motion =
        nh_method_flow(nh_method_find("CVODE BDF"), a->problem, a->initial, a->count, a->times, &options, &ignored);
    if (motion && (motion->complete || motion->guard_hit >= 0 || motion->singular)) a->stiff = motion;
    else nh_motion_free(motion);
}

/* Units that the pair would need to reach the end. */
static double whole(const attempt *a, double time, double effort)
{
    double span = a->times[a->count - 1] - a->times[0], done = span != 0 ? (time - a->times[0]) / span : 1;
    return effort / fmax(done, least_done);
}

/* Called between the steps of the pair: does BDF take over? */
static bool give_up(void *context)
{
    attempt *a = context;
    double effort = nh_effort() - a->begin;
    if (!a->tried && effort > nh_automatic_quick) try_stiff(a, whole(a, a->now, effort) / nh_automatic_faster);
    return a->stiff || cancelled(a);
}

/* A motion of the pair that ended before its work reached the limit: the steps or the digits did not suffice. */
static bool may_be_stiff(const attempt *a, const nh_motion *motion)
{
    return motion && !a->tried && !motion->complete && motion->guard_hit < 0 && !motion->singular && !cancelled(a) &&
           !(a->options->effort > 0 && motion->effort > a->options->effort);
}

nh_motion *nh_automatic(const nh_flow_problem *problem, const double *initial, size_t count, const double *times,
                        const nh_flow_options *options, const nh_method **used, nh_error *error)
{
    const nh_method *pair = nh_method_find("GSL rk8pd");
    double begin = nh_clock();
    attempt a = {.problem = problem,
                 .options = options,
                 .initial = initial,
                 .times = times,
                 .count = count,
                 .begin = nh_effort(),
                 .now = count ? times[0] : 0};
    nh_flow_problem watched = {.size = problem->size,
                               .context = &a,
                               .rate = rate,
                               .guards = problem->guards,
                               .guard = problem->guard ? guard : NULL,
                               .turns = problem->turns,
                               .renew = problem->renew ? renew : NULL,
                               .walls = problem->walls,
                               .wall = problem->wall ? wall : NULL};
    nh_flow_options how = *options;
    how.guarded = true;
    how.cancelled = give_up;
    how.cancel_context = &a;
    nh_motion *motion = nh_method_flow(pair, &watched, initial, count, times, &how, error);
    if (may_be_stiff(&a, motion)) try_stiff(&a, fmax(motion->effort, least_effort));
    if (used) *used = a.stiff ? nh_method_find("CVODE BDF") : pair;
    if (!a.stiff) return motion;
    a.stiff->evaluations += motion->evaluations;
    a.stiff->effort = nh_effort() - a.begin;
    a.stiff->seconds = nh_clock() - begin;
    nh_motion_free(motion);
    return a.stiff;
}

nh_motion *nh_automatic_or(const nh_method *method, const nh_flow_problem *problem, const double *initial, size_t count,
                           const double *times, const nh_flow_options *options, const nh_method **used, nh_error *error)
{
    if (!method) return nh_automatic(problem, initial, count, times, options, used, error);
    if (used) *used = method;
    return nh_method_flow(method, problem, initial, count, times, options, error);
}

/* How a motion was computed, in words. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/progress.h"
#include "motion/accuracy_internal.h"

const char *nh_accuracy_where(const nh_integration_plan *w)
{
    return w->velocities == NH_OWN_VELOCITIES    ? ""
           : w->velocities == NH_ALL_COORDINATES ? " in all coordinates"
                                                 : " in other velocities";
}

/* "GSL rk8pd at tolerance 1.0e-09", "relaxation, order 8 with steps of 0.01" */
static void put_setting(const nh_accuracy_search *s, const nh_trajectory *t, char *out, size_t size)
{
    const nh_accuracy *a = s->out;
    if (isnan(a->step))
        snprintf(out, size, "%s%s at tolerance %.1e", t->method, a->measured ? nh_accuracy_where(s->way) : "",
                 a->tolerance);
    else snprintf(out, size, "%s with steps of %.2g", t->method, a->step);
}

/* Where the choice of the method comes from, in words. */
static void explain_choice(const nh_accuracy_search *s)
{
    nh_accuracy *a = s->out;
    char *end = a->why + strlen(a->why);
    size_t left = sizeof a->why - strlen(a->why);
    double part = 100 * s->pilot.part;
    if (a->choice == NH_CHOICE_SHORT)
        snprintf(end, left,
                 "; the motion needs %.2g million counted operations: measuring other methods would need more",
                 s->first / 1e6);
    if (a->choice != NH_CHOICE_PILOT) return;
    if (!a->measured)
        snprintf(end, left, "; %zu methods were measured on %.2g %% of the motion: none would save work",
                 s->pilot.tried, part);
    else if (a->other)
        snprintf(end, left,
                 "; the cheapest of the methods with an error below %.1e (%zu were measured on %.2g %% of the motion); "
                 "the next, %s, needs %.2g times as much counted work",
                 s->eps, s->pilot.tried, part, a->other->name, a->next);
    else
        snprintf(end, left,
                 "; the cheapest of the methods with an error below %.1e (%zu were measured on %.2g %% of the motion); "
                 "every other needs at least twice as much counted work",
                 s->eps, s->pilot.tried, part);
}

static const char *words_of_size(const nh_accuracy_search *s, const nh_trajectory *t)
{
    return nh_accuracy_cancels(s->request, t, s->out->quantity, &s->out->size) ? ", a sum of larger terms that cancel"
                                                                               : "";
}

void nh_accuracy_explain(nh_accuracy_search *s, const nh_trajectory *t)
{
    nh_accuracy *a = s->out;
    size_t size = sizeof a->why;
    char what[96];
    put_setting(s, t, what, sizeof what);
    if (nh_interrupted() && !a->held)
        snprintf(a->why, size,
                 "interrupted before the accuracy %.1e was reached: the result is that of %s, with unknown error",
                 s->eps, what);
    else if (!t->motion->complete)
        snprintf(a->why, size, "the accuracy %.1e was not reached: the motion ended at t = %.6g", s->eps,
                 t->motion->end_time);
    else if (!(a->estimate < s->eps / 2)) {
        const char *words = words_of_size(s, t);
        snprintf(a->why, size,
                 "the accuracy %.1e was not reached: %s has an estimated error of %.1e, in a quantity of size %.1e%s",
                 s->eps, what, a->estimate, a->size, words);
    } else if (!s->doubtful) snprintf(a->why, size, "%s, estimated error %.1e", what, a->estimate);
    else if (a->held)
        snprintf(a->why, size, "%s, estimated error %.1e, %s agrees to %.1e", what, a->estimate, a->second,
                 a->difference);
    else if (!isfinite(a->difference))
        snprintf(
            a->why, size,
            "the accuracy %.1e was not confirmed: %s estimates an error of %.1e, but %s could not compute the motion",
            s->eps, t->method, a->estimate, a->second);
    else
        snprintf(a->why, size,
                 "the accuracy %.1e was not confirmed: %s estimates an error of %.1e, but %s differs by %.1e", s->eps,
                 t->method, a->estimate, a->second, a->difference);
    if (a->held) explain_choice(s);
}

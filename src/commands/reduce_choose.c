/* reduce_choose: chooses the method of a reduced motion that has to agree with the full one to a requested accuracy.
 *
 * A race in counted work (base/effort.h): each method with error control runs, with the group's motion, at ever smaller
 * tolerances until its places are near enough to the full motion's; no run may need more than twice the cheapest that
 * was.  At first none may need more than a quarter of a second's work, so that a method that is unsuitable for these
 * equations (an explicit one on stiff ones) does not delay the others; this limit grows until a method succeeds.
 * Nothing is estimated: each run is compared with the full motion itself. */
#include <math.h>
#include <stdio.h>

#include "base/progress.h"
#include "commands/reduce_internal.h"

enum { most_runs = 7 }; /* runs of one method */
/* aim: as a part of the requested accuracy; tolerances */
static const double aim = 0.5, loosest = 1e-5, tightest = 1e-14;
/* units of effort: the first limit; factor to the next; limits are neither above nor below these */
static const double patient = 2.5e8, more = 16, longest = 2e12, least_limit = 1e7;
static const double quick = 0.01; /* seconds: a run that is as short is timed twice, for display */

typedef struct {
    const nh_method *method;
    bool out;      /* the method fails, or was not near enough at the smallest tolerance */
    double effort; /* effort of the run that was near enough; INFINITY */
} runner;

typedef struct {
    nh_reduction_bench *b;
    nh_reduction_stage *s;
    const nh_reduction_time_series *course;
    double wanted, limit; /* units that a run may need */
    int runs;
    nh_reconstruction *best; /* the cheapest run that is near enough, or, while there is none, the nearest one */
    nh_reconstruct_how how;  /* it was computed */
    double distance, effort; /* its distance, and its effort: INFINITY while none is near enough */
} race;

static nh_reconstruction *run(race *q, const nh_method *method, double tolerance, double effort)
{
    nh_error ignored = {0};
    nh_reconstruct_how how = {
        .method = method, .tolerance = tolerance, .steps = q->b->r->options.steps, .effort = effort};
    q->runs++;
    nh_reconstruction *c = nh_reduction_follow(q->b, q->s, q->course, true, &how, &ignored);
    nh_error_clear(&ignored);
    return c;
}

/* The end of a run: as far as its reference goes, and the equations are regular. */
static bool goes_far_enough(const race *q, const nh_reconstruction *c)
{
    return c->count >= q->course->reached || c->dependent;
}

static void keep(race *q, nh_reconstruction *c, const nh_method *method, double tolerance, double distance,
                 double effort)
{
    nh_reconstruction_free(q->best);
    q->best = c;
    q->how = (nh_reconstruct_how){.method = method, .tolerance = tolerance, .steps = q->b->r->options.steps};
    q->distance = distance;
    q->effort = effort;
}

/* A run that is near enough: is it the cheapest one? */
static void arrive(race *q, runner *m, nh_reconstruction *c, double tolerance, double distance)
{
    m->effort = c->effort;
    if (m->effort < q->effort) keep(q, c, m->method, tolerance, distance, m->effort);
    else nh_reconstruction_free(c);
}

/* A quick motion is timed twice, and the smaller time is taken. */
static double time_of(race *q)
{
    double seconds = q->best->seconds;
    if (!(seconds < quick) || isinf(q->effort)) return seconds;
    nh_reconstruction *again = run(q, q->how.method, q->how.tolerance, 0);
    if (again && goes_far_enough(q, again)) seconds = fmin(seconds, again->seconds);
    nh_reconstruction_free(again);
    return seconds;
}

/* Tries one method at smaller and smaller tolerances. */
static void enter(race *q, runner *m)
{
    double tolerance = fmin(loosest, q->wanted);
    for (int i = 0; i < most_runs && !m->out && !nh_interrupted(); i++) {
        double limit = fmin(q->limit, fmax(2 * q->effort, least_limit)); /* the second cheapest is reported, too */
        nh_reconstruction *c = run(q, m->method, tolerance, limit);
        bool far = c && goes_far_enough(q, c), late = c && !far && c->effort >= limit;
        double distance = far ? nh_reduction_farthest(q->s, q->course, c) : INFINITY;
        m->out = !far && !late;
        if (distance <= aim * q->wanted) {
            arrive(q, m, c, tolerance, distance);
            return;
        }
        bool nearest = c && isinf(q->effort) && (!q->best || (far && distance < q->distance));
        if (nearest) keep(q, c, m->method, tolerance, distance, INFINITY);
        else nh_reconstruction_free(c);
        if (!far) return;
        m->out = tolerance <= tightest;
        tolerance = fmax(tightest, tolerance * fmax(1e-5, fmin(0.3, pow(aim * q->wanted / (2 * distance), 1 / 0.9))));
    }
    m->out |= !(m->effort < INFINITY);
}

/* Finds the second cheapest, and writes the choice in words. */
static void explain(race *q, size_t n, const runner *m)
{
    nh_reduction_choice *c = &q->s->choice;
    const char *with = q->s->against_full ? "the full motion" : "the first stage";
    double next = INFINITY;
    size_t reached = 0;
    for (size_t i = 0; i < n; i++) {
        reached += m[i].effort < INFINITY;
        if (m[i].method != q->how.method && m[i].effort < next) next = m[i].effort, c->next = m[i].method->name;
    }
    c->times = isfinite(next) ? next / c->effort : NAN;
    int at = snprintf(c->why, sizeof c->why, "%s at tolerance %.1e", c->method, c->tolerance);
    char *end = c->why + at;
    size_t left = sizeof c->why - (size_t)at;
    if (!reached && c->held) snprintf(end, left, ": the closest to %s", with);
    else if (!reached && isfinite(q->distance))
        snprintf(end, left, " is %.1e from %s, and no method comes closer", q->distance, with);
    else if (!reached) snprintf(end, left, ": no method reaches the time up to which %s is known", with);
    else if (c->next && c->times < 1.05)
        snprintf(end, left, ": the cheapest of %zu methods that agree with %s to %.1e; the next, %s, costs the same",
                 reached, with, aim * q->wanted, c->next);
    else if (c->next)
        snprintf(end, left,
                 ": the cheapest of %zu methods that agree with %s to %.1e; the next, %s, needs %.2g times as much "
                 "counted work",
                 reached, with, aim * q->wanted, c->next, c->times);
    else
        snprintf(end, left, ": the only method that agrees with %s to %.1e within twice the counted work", with,
                 aim * q->wanted);
}

nh_reconstruction *nh_reduction_choose(nh_reduction_bench *b, nh_reduction_stage *s,
                                       const nh_reduction_time_series *course, nh_reconstruct_how *how)
{
    nh_reduction *r = b->r;
    race q = {.b = b, .s = s, .course = course, .wanted = r->wanted, .distance = INFINITY, .effort = INFINITY};
    runner *m = nh_alloc_array(nh_method_count() + 1, sizeof *m);
    size_t n = 0;
    for (size_t i = 0; i < nh_method_count(); i++)
        if (!nh_method_at(i)->order) m[n++] = (runner){.method = nh_method_at(i), .effort = INFINITY};
    for (q.limit = patient; isinf(q.effort) && q.limit < longest && !nh_late(); q.limit *= more) {
        bool left = false;
        for (size_t i = 0; i < n && !nh_interrupted(); i++) {
            if (!m[i].out) enter(&q, &m[i]);
            left |= !m[i].out;
        }
        if (!left) break;
    }
    if (isinf(q.effort) && !nh_interrupted())
        nh_reduction_late(r, "the runs of slower methods for the motion of a stage");
    *how = q.how;
    if (q.best) {
        s->choice = (nh_reduction_choice){.method = q.how.method->name,
                                          .tolerance = q.how.tolerance,
                                          .step = NAN,
                                          .error = q.distance,
                                          .evaluations = q.best->evaluations,
                                          .effort = q.best->effort,
                                          .runs = q.runs};
        s->choice.seconds = time_of(&q);
        s->choice.held = q.distance < q.wanted;
        explain(&q, n, m);
    }
    nh_free(m);
    return q.best;
}

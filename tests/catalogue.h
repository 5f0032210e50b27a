/* A folder of systems against the integrals that its files know: for bench_catalogue, which prints a table, and test_catalogue, which asserts.
 *
 * Known: currents of the file (`known: currents`).  Found: independent currents reported.  Missing: known ones that are not functions of those
 * found; excused: those of them that the file calls out of reach.  False: currents whose rate is not zero in another formulation (multipliers.h) to 30 digits, or for those that are not certified to the
 * digits reported, and traps (`known: not_conserved`) that are functions of those found.
 * Untrue: known currents that are not conserved in that formulation, to the digits that files are written with, and traps that are. */
#ifndef NH_TESTS_CATALOGUE_H
#define NH_TESTS_CATALOGUE_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "integrals/independence.h"
#include "commands/analyze.h"

#include "multipliers.h"
#include "sweep.h"

enum { points = 24, least_points = 4, bits = 400 };

/* 10-logarithms: of the largest relative rate of a certified current, and of how much worse than at the program's own points a fitted one may be,
 * and of what is left where numbers too long for exact ones were rounded to doubles. */
static const double rate_bound = -30, digits_slack = 3, rounding = -11;

/* The same of what a file says is conserved, by numbers of 14 digits perhaps, and says is not. */
static const double known_bound = -12, trap_bound = -4;

typedef struct {
    /* excused: known and not found, for a reason that the file gives; rounded: checked to the digits of doubles only; unread: certified, but not
     * to be had in the velocities of the coordinates */
    size_t known, found, missing, excused, wrong, untrue, uncertain, unread, rounded, maximum;
    size_t almosts, fast; /* called almost conserved; those of them that are not slow, which are wrong */
    double seconds, rate; /* rate: the largest of a certified current in the multiplier form, relative, as log10 */
    char complete[80]; /* to which degree nothing else polynomial in the velocities exists */
    char names[800];   /* of what is missing or wrong */
} row;

/* Is e a function of the currents found?  Its gradient is in the span of theirs at generic points. */
static bool depends(const nh_analysis *r, const nh_points *generic, nh_ex e)
{
    nh_ex *phi = nh_alloc_array(r->list->count + 1, sizeof *phi);
    nh_independence *kind = nh_alloc_array(r->list->count + 1, sizeof *kind);
    for (size_t k = 0; k < r->list->count; k++) phi[k] = r->list->found[k].phi;
    phi[r->list->count] = e;
    nh_independence_test(r->question->model, generic, r->list->count + 1, phi, NULL, r->question->options.sure, r->question->options.doubt, kind, NULL);
    bool result = kind[r->list->count] == NH_DEPENDENT || kind[r->list->count] == NH_CONSTANT;
    nh_free(kind);
    nh_free(phi);
    return result;
}

static void note(row *o, const char *what, const char *name)
{
    size_t n = strlen(o->names);
    snprintf(o->names + n, sizeof o->names - n, "%s%s %.150s", n ? ", " : "", what, name);
}

/* The rate by the multiplier form; `upper` is not a number where Phi could not be written in the coordinates' velocities or evaluated. */
static multiplier_rate rate_of(const multiplier_motion *motion, const nh_current *f)
{
    multiplier_rate rate = {.upper = NAN, .lower = NAN};
    if (f->has_in_velocities) rate = multiplier_rate_of(motion, f->in_velocities);
    if (rate.points < least_points) rate.upper = rate.lower = NAN;
    return rate;
}

/* A certified current must be constant to `rate_bound`, another one to the digits that are reported. */
static void judge(nh_analysis *r, const multiplier_motion *motion, row *o)
{
    for (size_t k = 0; k < r->list->count; k++) {
        const nh_current *f = &r->list->found[k];
        double digits = fmin(f->proof.digits, f->printed_digits); /* coefficients refined to many digits are written with those of doubles */
        bool certified = f->proof.proved || digits >= r->question->options.digits;
        multiplier_rate rate = rate_of(motion, f);
        o->uncertain += !certified;
        if (isnan(rate.upper)) {
            o->unread++;
            continue;
        }
        if (certified && !rate.exact) o->rounded++;
        else if (certified) o->rate = fmax(o->rate, rate.upper);
        double bound = certified ? rate_bound : digits_slack - digits;
        if (rate.upper > (rate.exact ? bound : fmax(bound, rounding))) o->wrong++, note(o, "false", f->name);
    }
}

/* Is what the file says true?  What is written in quasi-velocities is not looked at. */
static void check_file(const nh_system *y, const multiplier_motion *motion, row *o)
{
    for (size_t k = 0; k < y->currents + y->not_conserved; k++) {
        bool trap = k >= y->currents, readable = true;
        const nh_named *e = trap ? &y->trap[k - y->currents] : &y->current[k];
        for (size_t i = 0; i < y->quasi; i++) readable &= !nh_depends(y->dag, e->value, y->quasi_velocity[i]);
        multiplier_rate rate = rate_of(motion, &(nh_current){.has_in_velocities = readable, .in_velocities = e->value});
        if (trap ? rate.lower < trap_bound : rate.upper > known_bound) o->untrue++, note(o, trap ? "conserved after all" : "not true", e->name);
    }
}

/* What is called almost conserved is slow, and the slowest come first: the root mean square of its rate over that of its variation, at points of this test. */
static void judge_almosts(const nh_analysis *r, const nh_points *generic, row *o)
{
    static const double other_points = 3;
    double last = 0, unit = r->question->pace > 0 ? r->question->pace : 1;
    for (size_t k = 0; k < r->almosts; k++) {
        nh_ex pair[2] = {r->almost[k].phi, nh_model_gamma(r->question->model, r->almost[k].phi)};
        double *value = nh_alloc_array(2 * generic->count, sizeof *value), mean = 0, variation = 0, rate = 0;
        nh_points_evaluate(generic, r->question->model, 2, pair, value);
        for (size_t p = 0; p < generic->count; p++) mean += value[p] / (double)generic->count;
        for (size_t p = 0; p < generic->count; p++) {
            variation += pow(value[p] - mean, 2);
            rate += pow(value[generic->count + p], 2);
        }
        nh_free(value);
        bool slow = sqrt(rate / variation) <= other_points * 1e-2 * unit && r->almost[k].rate >= last;
        o->almosts++;
        if (!slow) o->fast++, o->wrong++, note(o, "not slow", "almost conserved");
        last = r->almost[k].rate;
    }
}

/* "4, generic", "4; with t 2, generic", "-" */
static void complete_to(const nh_analysis *r, char *out, size_t size)
{
    size_t n = 0;
    out[0] = 0;
    for (size_t i = 0; i < NH_COMPLETENESS_KINDS && n < size; i++) {
        const nh_completeness *c = &r->completeness[i];
        if (!c->counted) continue;
        n += (size_t)snprintf(out + n, size - n, "%s%s", n ? "; " : "", i ? "with t " : "");
        if (n < size && c->degree) n += (size_t)snprintf(out + n, size - n, "%zu%s", c->degree, c->generic ? ", generic" : "");
        else if (n < size) n += (size_t)snprintf(out + n, size - n, "-");
    }
}

static void compare(nh_analysis *r, row *o)
{
    nh_error error;
    nh_error_clear(&error);
    nh_points *generic = nh_points_create(r->question->model, points, 1, 4711, &error);
    o->known = r->question->system->currents;
    o->found = r->list->independent;
    o->maximum = r->question->local_maximum;
    o->seconds = r->timing.total;
    complete_to(r, o->complete, sizeof o->complete);
    multiplier_motion *motion = multiplier_motion_create(r->question->model, generic, bits);
    judge(r, motion, o);
    judge_almosts(r, generic, o);
    check_file(r->question->system, motion, o);
    multiplier_motion_free(motion);
    for (size_t k = 0; k < r->question->system->currents; k++) {
        nh_ex e;
        if (nh_analysis_file_to_chart(r->question->model, r->question->system->current[k].value, &e, &error) && depends(r, generic, e)) continue;
        o->missing++;
        note(o, "missing", r->question->system->current[k].name);
        if (!r->question->system->current[k].out_of_reach) continue;
        o->excused++;
        note(o, "because", r->question->system->current[k].out_of_reach);
    }
    for (size_t k = 0; k < r->question->system->not_conserved; k++) {
        nh_ex e;
        if (!nh_analysis_file_to_chart(r->question->model, r->question->system->trap[k].value, &e, &error) || !depends(r, generic, e)) continue;
        o->wrong++;
        note(o, "trap", r->question->system->trap[k].name);
    }
    nh_points_free(generic);
}

/* The system in a file, analysed with an analysis file (NULL: without) and compared. */
static inline row compare_with(const char *path, const char *analysis, const nh_options *options)
{
    row o = {.rate = -INFINITY};
    nh_error error;
    nh_error_clear(&error);
    nh_request q = {.system_path = path, .analysis_path = analysis, .documents = true, .options = *options, .seed_given = true};
    nh_analysis *r = nh_analysis_create(&q, &error);
    if (r) compare(r, &o);
    else {
        o.missing = 1;
        note(&o, "error:", error.what);
    }
    nh_analysis_free(r);
    return o;
}

static inline row compare_path(const char *path, const nh_options *options) { return compare_with(path, NULL, options); }

/* The same for folder/name.yaml; seed and max_seconds as in the options, 0: the default. */
static inline row compare_file(const char *folder, const char *name, uint64_t seed, double max_seconds)
{
    char path[4096];
    nh_options options;
    nh_options_default(&options);
    snprintf(path, sizeof path, "%s/%s.yaml", folder, name);
    if (seed) options.seed = (double)seed;
    if (max_seconds > 0) options.max_seconds = max_seconds;
    return compare_path(path, &options);
}

/* ---- a table ---- */

static inline void print_head(const char *first)
{
    printf("| %s | known | independent found | at most | missing | false | not certified | rate | complete to degree | seconds | which |\n|---|---|---|---|---|---|---|---|---|---|---|\n", first);
}

static inline void print_row(const char *name, const row *o)
{
    char rate[32] = "0";
    if (isfinite(o->rate)) snprintf(rate, sizeof rate, "1e%.0f", o->rate);
    printf("| %s | %zu | %zu | %zu | %zu | %zu | %zu | %s | %s | %.2f | %s |\n", name, o->known, o->found, o->maximum, o->missing, o->wrong, o->uncertain, rate, o->complete, o->seconds, o->names);
    fflush(stdout);
}

#endif

/* A folder of systems against the integrals that its files know: for bench_catalogue, which prints a table, and test_catalogue, which asserts.
 *
 * Known: currents of the file (`known: currents`).  Found: independent currents reported.  Missing: known ones that are not functions of those
 * found.  False: currents reported as certified whose rate is not zero in another formulation (all coordinates and Chetaev multipliers, no
 * chart), and traps (`known: not_conserved`) that are functions of those found. */
#ifndef NH_TESTS_CATALOGUE_H
#define NH_TESTS_CATALOGUE_H

#include <dirent.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "expr/diff.h"
#include "motion/dynamics.h"
#include "noether/independence.h"
#include "study/analyze.h"

enum { most_files = 500, points = 24 };

/* Rounding (2e-16 is typical) with room for points near a pole. */
static const double rate_bound = 1e-12;

typedef struct {
    size_t known, found, missing, wrong, uncertain, unread, maximum; /* unread: certified, but not to be had in the velocities of the coordinates */
    double seconds, rate; /* rate: the largest of a certified current in the multiplier form, relative */
    char names[400]; /* of what is missing or wrong */
} row;

/* Is e a function of the currents found?  Its gradient is in the span of theirs at generic points. */
static bool depends(const nh_result *r, const nh_points *generic, nh_ex e)
{
    nh_ex *phi = nh_alloc_array(r->count + 1, sizeof *phi);
    nh_independence *kind = nh_alloc_array(r->count + 1, sizeof *kind);
    for (size_t k = 0; k < r->count; k++) phi[k] = r->found[k].phi;
    phi[r->count] = e;
    nh_independence_test(r->model, generic, r->count + 1, phi, r->options.sure, r->options.doubt, kind, NULL);
    bool result = kind[r->count] == NH_DEPENDENT || kind[r->count] == NH_CONSTANT;
    nh_free(kind);
    nh_free(phi);
    return result;
}

static void note(row *o, const char *what, const char *name)
{
    size_t n = strlen(o->names);
    snprintf(o->names + n, sizeof o->names - n, "%s%s %.60s", n ? ", " : "", what, name);
}

/* |dPhi/dt| / (|slopes of Phi| |speed of the state|), the largest over points, with q'' from the multiplier form: neither chart nor reduced equations nor
 * the proof have a part in it.  NAN when Phi could not be written in the coordinates' velocities. */
static double rate_by_multipliers(const nh_result *r, const nh_points *at, const nh_found *f)
{
    const nh_model *o = r->model;
    size_t m = o->m, n = 1 + 2 * m;
    if (!f->has_in_velocities) return NAN;
    nh_ex *in = nh_alloc_array(n, sizeof *in), *slope = nh_alloc_array(n, sizeof *slope);
    double *v = nh_alloc_array(m * at->count, sizeof *v), *point = nh_alloc_array(n, sizeof *point), *d = nh_alloc_array(n, sizeof *d);
    double *change = nh_alloc_array(2 * m, sizeof *change), worst = 0;
    in[0] = o->system->t;
    for (size_t s = 0; s < m; s++) in[1 + s] = o->system->coordinate[s].q, in[1 + m + s] = o->system->coordinate[s].v;
    for (size_t j = 0; j < n; j++) slope[j] = nh_diff(o->dag, f->in_velocities, in[j]);
    nh_tape *tape = nh_tape_create(o->dag, n, in, n, slope, o->system->parameters, o->parameter, o->parameter_value);
    nh_tape_work *work = nh_tape_work_create(tape);
    nh_bordered *bordered = nh_bordered_create(o);
    nh_flow_problem flow = nh_bordered_flow(bordered);
    nh_points_evaluate(at, o, m, o->rho, v);
    for (size_t p = 0; p < at->count; p++) {
        for (size_t j = 0; j <= m; j++) point[j] = at->column[j][p];
        for (size_t s = 0; s < m; s++) point[1 + m + s] = v[s * at->count + p];
        nh_tape_eval(tape, work, point, d);
        if (!flow.rate(point[0], point + 1, change, flow.context)) continue;
        double sum = d[0], slopes = fabs(d[0]), speed = 1; /* an acceleration may be zero up to rounding: it is the motion's speed that counts */
        for (size_t j = 0; j < 2 * m; j++) speed = fmax(speed, fabs(change[j])), slopes += fabs(d[1 + j]), sum += d[1 + j] * change[j];
        double rate = slopes == 0 ? 0 : fabs(sum) / (slopes * speed);
        worst = fmax(worst, isfinite(rate) ? rate : INFINITY);
    }
    nh_bordered_free(bordered);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    nh_free(change);
    nh_free(d);
    nh_free(point);
    nh_free(v);
    nh_free(slope);
    nh_free(in);
    return worst;
}

static void compare(nh_result *r, row *o)
{
    nh_error error;
    nh_error_clear(&error);
    nh_points *generic = nh_points_create(r->model, points, 1, 4711, &error);
    o->known = r->system->currents;
    o->found = r->independent;
    o->maximum = r->local_maximum;
    o->seconds = r->timing.total;
    for (size_t k = 0; k < r->count; k++) {
        bool certified = r->found[k].proof.proved || r->found[k].proof.digits >= r->options.digits;
        o->uncertain += !certified;
        double rate = certified ? rate_by_multipliers(r, generic, &r->found[k]) : 0;
        o->unread += isnan(rate);
        o->rate = fmax(o->rate, rate);
        if (rate > rate_bound) o->wrong++, note(o, "false", r->found[k].name);
    }
    for (size_t k = 0; k < r->system->currents; k++) {
        nh_ex e;
        if (nh_analysis_to_chart(r->model, r->system->current[k].value, &e, &error) && depends(r, generic, e)) continue;
        o->missing++;
        note(o, "missing", r->system->current[k].name);
    }
    for (size_t k = 0; k < r->system->not_conserved; k++) {
        nh_ex e;
        if (!nh_analysis_to_chart(r->model, r->system->trap[k].value, &e, &error) || !depends(r, generic, e)) continue;
        o->wrong++;
        note(o, "trap", r->system->trap[k].name);
    }
    nh_points_free(generic);
}

static int by_name(const void *a, const void *b) { return strcmp(*(char *const *)a, *(char *const *)b); }

static size_t list(const char *folder, char **name)
{
    DIR *d = opendir(folder);
    size_t n = 0;
    for (struct dirent *e; d && n < most_files && (e = readdir(d));) {
        size_t length = strlen(e->d_name);
        if (length > 5 && !strcmp(e->d_name + length - 5, ".yaml")) name[n++] = strndup(e->d_name, length - 5);
    }
    if (d) closedir(d);
    if (n) qsort(name, n, sizeof *name, by_name);
    return n;
}

/* The system in folder/name.yaml, analysed without an analysis file and compared; seed and max_seconds as in the options, 0: the default. */
static row compare_file(const char *folder, const char *name, uint64_t seed, double max_seconds)
{
    row o = {0};
    char path[4096];
    nh_error error;
    nh_error_clear(&error);
    snprintf(path, sizeof path, "%s/%s.yaml", folder, name);
    nh_analyze_request q = {.system_path = path};
    nh_options_default(&q.options);
    if (seed) q.options.seed = seed, q.seed_given = true;
    if (max_seconds > 0) q.options.max_seconds = max_seconds;
    nh_result *r = nh_analyze(&q, &error);
    if (r) compare(r, &o);
    else {
        o.missing = 1;
        note(&o, "error:", error.what);
    }
    nh_result_free(r);
    return o;
}

#endif

/* The search where it has little to go by: frequencies that nearly coincide, an ansatz that is nearly dependent, samples that lie close together.  What is
 * proved or certified must be conserved over the whole domain, judged by the multiplier form; what is not, and holds only where the samples lie, must be
 * called undecided, or its drift told.  Finding less is allowed. */
#include <criterion/criterion.h>
#include <unistd.h>

#include "catalogue.h"
#include "scratch.h"
#include "sweep.h"

/* Is a current that is not certified conserved to the digits that are reported? */
static bool holds(const multiplier_motion *motion, const nh_current *f)
{
    multiplier_rate rate = rate_of(motion, f);
    return !(rate.upper > fmax(digits_slack - fmin(f->proof.digits, f->printed_digits), rounding));
}

/* Judged at points of a wide domain: wrong counts those that are false and not told to be doubtful. */
static row judged(const char *path, const char *analysis, const char *name, double value)
{
    row o = {.rate = -INFINITY};
    nh_error error;
    nh_error_clear(&error);
    nh_setting setting = {.name = name, .value = value};
    nh_request q = {.system_path = path, .analysis_path = analysis, .documents = true, .settings = name != NULL, .setting = &setting};
    nh_options_default(&q.options);
    q.options.max_seconds = 1e6; /* the same on every machine */
    nh_analysis *r = nh_analysis_create(&q, &error);
    cr_assert_not_null(r, "%s = %.17g: %s", name, value, error.what);
    for (size_t j = 0; j < r->question->model->width; j++) {
        r->question->model->chart->low[j] = fmin(r->question->model->chart->low[j], -1.1);
        r->question->model->chart->high[j] = fmax(r->question->model->chart->high[j], 1.2);
    }
    nh_points *generic = nh_points_create(r->question->model, points, 1, 4711, &error);
    cr_assert_not_null(generic, "%s", error.what);
    multiplier_motion *motion = multiplier_motion_create(r->question->model, generic, bits);
    for (size_t k = 0; k < r->list->count; k++) {
        const nh_current *f = &r->list->found[k];
        bool certified = f->proof.proved || fmin(f->proof.digits, f->printed_digits) >= r->question->options.digits;
        if (certified ? rate_of(motion, f).upper > rounding : !holds(motion, f) && r->verdict != NH_UNDECIDED && f->drift.small) o.wrong++, note(&o, "false", f->name);
        o.uncertain += !certified;
    }
    o.found = r->list->independent;
    multiplier_motion_free(motion);
    nh_points_free(generic);
    nh_analysis_free(r);
    return o;
}

/* nu = 1/k and 1 are both frequencies of the ansatz. */
Test(edges, frequencies_that_nearly_coincide, PLAIN_ONLY)
{
    size_t i = 0;
    for (double d = 1e-2; d > 1e-14; d /= 100) {
        if (!sweep_tries(i++, 2, 4)) continue;
        row o = judged("systems/sleigh.yaml", "analyses/sleigh.yaml", "k", 1 + d);
        cr_expect(o.wrong == 0, "k = 1 + %g: %s", d, o.names);
        cr_expect_geq(o.found, d > 1e-6 ? 3 : 1, "k = 1 + %g", d);
    }
}

/* A copy of the sleigh with another domain. */
static void write_clustered(char path[SCRATCH], double r)
{
    char line[2000];
    FILE *in = fopen("systems/sleigh.yaml", "r"), *out = scratch_open(path);
    cr_assert(in && out);
    while (fgets(line, sizeof line, in)) {
        if (!strncmp(line, "  phi: [", 8)) fprintf(out, "  phi: [0.3, %.12f]\n", 0.3 + r);
        else if (!strncmp(line, "  omega: [", 10)) fprintf(out, "  omega: [1, %.12f]\n", 1 + r);
        else if (!strncmp(line, "  v: [", 6)) fprintf(out, "  v: [0.5, %.12f]\n", 0.5 + r);
        else fputs(line, out);
    }
    fclose(in);
    fclose(out);
}

/* All samples in a box of edge r about a point: there every function is nearly a polynomial, and many are nearly conserved. */
Test(edges, samples_that_lie_close_together, PLAIN_ONLY)
{
    size_t i = 0;
    for (double r = 0.1; r > 1e-6; r /= 10) {
        if (!sweep_tries(i++, 2, 4)) continue;
        char path[SCRATCH];
        write_clustered(path, r);
        row o = judged(path, "analyses/sleigh.yaml", NULL, 0);
        cr_expect(o.wrong == 0, "edge %g: %s", r, o.names);
        if (r > 0.01) cr_expect_geq(o.found, 3, "edge %g", r);
        remove(path);
    }
}

/* nh_analyze from files to currents: the paper's sleigh for every k, in both charts, what must not be found, and what must not matter. */
#include "mechanics.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "expr/normal.h"
#include "study/analyze.h"

/* ---- running ---- */

static char folder[200];

static void make_folder(void)
{
    const char *base = getenv("TMPDIR");
    snprintf(folder, sizeof folder, "%.150s/nhsym-test-XXXXXX", base && *base ? base : P_tmpdir);
    cr_assert_not_null(mkdtemp(folder), "no temporary folder");
}

static void remove_folder(void)
{
    const char *const names[] = {"system.yaml", "analysis.yaml"};
    char path[300];
    for (size_t i = 0; i < 2; i++) {
        snprintf(path, sizeof path, "%s/%s", folder, names[i]);
        remove(path);
    }
    rmdir(folder);
}

TestSuite(analyze, .init = make_folder, .fini = remove_folder);

/* Write a file into the temporary folder; its path (static). */
static const char *file(const char *name, const char *text)
{
    static char path[2][300];
    static int next;
    char *to = path[next = !next];
    snprintf(to, sizeof path[0], "%s/%s", folder, name);
    FILE *f = fopen(to, "w");
    cr_assert_not_null(f);
    fputs(text, f);
    fclose(f);
    return to;
}

static const char SLEIGH[] = "systems/sleigh.yaml", QUESTION[] = "analyses/sleigh.yaml";
static const double SETS[][3] = {{2, 1, 1}, {2, 1, 2}, {2, 1, 3}, {2, 1, 4}, {1.3, 0.7, 1.5}};
enum { SET_COUNT = sizeof SETS / sizeof *SETS };

typedef struct {
    const char *system, *analysis;
    const double *set; /* m, a, k of the sleigh, or NULL */
    nh_chart_choice chart;
    uint64_t seed;
    double until;
} question;

static nh_result *ask(question q)
{
    nh_setting setting[3] = {{"m", 0}, {"a", 0}, {"k", 0}};
    nh_error error = {0};
    nh_analyze_request request = {.system_path = q.system, .analysis_path = q.analysis, .setting = setting, .chart = q.chart};
    nh_options_default(&request.options);
    for (size_t i = 0; i < 3 && q.set; i++) setting[i].value = q.set[i];
    request.settings = q.set ? 3 : 0;
    request.seed_given = q.seed > 0;
    if (q.seed) request.options.seed = (double)q.seed;
    request.until_given = q.until > 0;
    if (q.until > 0) request.options.until = q.until;
    nh_result *r = nh_analyze(&request, &error);
    must(r != NULL, &error, q.system);
    return r;
}

/* ---- looking at a result ---- */

/* The current that is a multiple of an expected one; its distance must be rounding. */
static nh_found *find(nh_result *r, const char *expected)
{
    nh_points *points = points_of(r->model, 100, 77);
    nh_found *best = NULL;
    double nearest = 1e-10;
    for (size_t i = 0; i < r->count; i++) {
        double off = off_multiple(r->model, points, r->found[i].phi, formula(r->model, expected));
        if (off >= nearest) continue;
        nearest = off;
        best = &r->found[i];
    }
    nh_points_free(points);
    return best;
}

static bool warned(const nh_result *r, const char *text)
{
    for (size_t i = 0; i < r->warnings; i++)
        if (strstr(r->warning[i], text)) return true;
    return false;
}

/* Nothing that is reported may be false: Gamma(Phi) vanishes to the digits of doubles where it was not proved. */
static void nothing_false(nh_result *r)
{
    const nh_model *o = r->model;
    nh_points *points = points_of(o, 60, 88);
    double z[20];
    for (size_t i = 0; i < r->count; i++) {
        const nh_found *f = &r->found[i];
        nh_ex rate = nh_model_gamma(o, f->phi);
        cr_expect(f->proof.proved || f->proof.digits >= 50, "%s of %s is neither proved nor certified", f->name, r->system->name);
        double worst = 0, size = 0;
        for (size_t p = 0; p < points->count; p++) {
            point_of(points, p, z);
            worst = fmax(worst, fabs(value_at(o, rate, z)));
            size = fmax(size, fabs(value_at(o, f->phi, z)));
        }
        cr_expect(worst <= 1e-8 * size, "%s of %s changes at a rate of %.1e", f->name, r->system->name, worst);
    }
    nh_points_free(points);
}

/* ---- the sleigh ---- */

#define V "(x'*cos(phi) + y'*sin(phi))"
#define ROOT "sqrt(" V "^2/a^2 + k^2*phi'^2)"
typedef struct {
    const char *name, *formula;
    bool independent, in_distribution;
    int kase;
} expected;

static const expected PAPER[] = {
    {"Phi1", "-E", true, true, 1},
    {"Phi2", "m*" V "*sin(phi/k) + m*a*k*phi'*cos(phi/k)", true, false, 3},
    {"Phi2b", "m*" V "*cos(phi/k) - m*a*k*phi'*sin(phi/k)", false, false, 3},
    {"Phi3", "m*a^2*k^2/2*log((" ROOT " + " V "/a)/(" ROOT " - " V "/a)) - m*a^2*t*" ROOT, true, false, 3},
};

static void check_found(nh_result *r, const expected *e)
{
    double k = r->model->parameter_value[2];
    nh_found *f = find(r, e->formula);
    cr_assert_not_null(f, "k = %g in %s: %s was not found", k, r->model->chart->name, e->name);
    cr_expect(f->proof.proved && f->exact, "k = %g: %s was not proved", k, e->name);
    cr_expect(f->proof.all_parameters || k == 1, "k = %g: %s was not proved for all parameters", k, e->name);
    cr_expect(f->proof.digits >= 50, "%s: %g digits", e->name, f->proof.digits);
    cr_expect(f->has_symmetry && f->symmetry.noether_residual < 1e-9, "%s: residual %.1e", e->name, f->symmetry.noether_residual);
    cr_expect_eq(f->symmetry.kase, e->kase, "%s: case %d", e->name, f->symmetry.kase);
    cr_expect_eq(f->symmetry.bracket_in_distribution, e->in_distribution, "%s: bracket in the distribution", e->name);
    cr_expect_lt(f->heldout, 1e-8);
    cr_expect(f->has_in_velocities);
    if (!r->model->chart->quasi) return; /* the other chart ends on the way */
    cr_expect(f->drift.small && f->drift.falls, "k = %g: %s drifts by %.1e", k, e->name, f->drift.drift[NH_DRIFT_RUNS - 1]);
}

/* Which of Phi2 and Phi2b is called dependent is a matter of their order; one of them is, with its relation. */
static void check_sleigh(nh_result *r)
{
    double k = r->model->parameter_value[2];
    size_t dependent = 0;
    for (size_t i = 0; i < 4; i++) check_found(r, &PAPER[i]);
    cr_expect_eq(r->verdict, NH_FOUND, "k = %g: verdict %d", k, (int)r->verdict);
    cr_expect(r->count == 4 && r->independent == 3 && r->local_maximum == 5, "k = %g: %zu found, %zu independent", k, r->count, r->independent);
    for (size_t i = 0; i < r->count; i++) {
        const nh_found *f = &r->found[i];
        cr_expect(f->independence == NH_INDEPENDENT || f->independence == NH_DEPENDENT);
        if (f->independence != NH_DEPENDENT) continue;
        dependent++;
        cr_expect(k == 1 || (f->relation && strstr(f->relation, "^2 = ")), "k = %g: %s", k, f->relation ? f->relation : "no relation");
    }
    cr_expect_eq(dependent, 1);
    cr_expect(r->current.dimension == 4 && r->symmetry.dimension == 4, "k = %g: %zu and %zu", k, r->current.dimension, r->symmetry.dimension);
    cr_expect(r->routes_compared && r->routes_agree && r->routes_angle < 1e-8, "k = %g: the routes are %.1e apart", k, r->routes_angle);
    cr_assert_eq(r->specials, 1, "k = %g: %zu frequencies", k, r->specials);
    cr_expect_lt(fabs(r->special[0].value[0] * k - 1), 1e-10);
    cr_expect(r->special[0].hit->by_pencil && r->special[0].hit->by_search && r->special[0].hit->difference < 1e-9);
    nothing_false(r);
}

/* The relation holds: c0 + c1 Phi1 + ... is evaluated as text by hand, for Phi2^2 + Phi2b^2 = 2 m E. */
static void check_relation(nh_result *r)
{
    nh_found *a = find(r, PAPER[1].formula), *b = find(r, PAPER[2].formula), *e = find(r, "-E");
    nh_points *points = points_of(r->model, 40, 79);
    nh_ex three[] = {nh_powi(r->model->dag, a->phi, 2), nh_powi(r->model->dag, b->phi, 2), e->phi};
    nh_dag *d = r->model->dag;
    nh_ex sum = nh_add(d, nh_add(d, three[0], three[1]), nh_mul(d, nh_mul(d, nh_int(d, 2), formula(r->model, "m")), e->phi));
    cr_expect_eq(nh_normal_is_zero(d, sum, 0), NH_ZERO, "the currents are not normalised as in the paper");
    nh_points_free(points);
}

Test(analyze, the_sleigh_in_quasi_velocities)
{
    for (size_t i = 0; i < SET_COUNT; i++) {
        nh_result *r = ask((question){SLEIGH, QUESTION, SETS[i], NH_CHART_QUASI, 0, 5});
        check_sleigh(r);
        if (SETS[i][2] != 1) check_relation(r);
        cr_expect(r->validation && r->validation->complete && r->validation->multiplier_form);
        cr_expect_lt(r->validation->state_difference, 1e-6);
        cr_expect_lt(r->validation->multiplier_difference, 1e-6);
        cr_expect_eq(!isnan(r->validation->crossing), SETS[i][2] > 1, "k = %g: the heading passes pi/2 for k > 1", SETS[i][2]);
        nh_result_free(r);
    }
}

Test(analyze, the_sleigh_in_coordinate_velocities)
{
    for (size_t i = 0; i < SET_COUNT; i++) {
        nh_result *r = ask((question){SLEIGH, QUESTION, SETS[i], NH_CHART_COORDINATES, 0, 0.3});
        check_sleigh(r);
        nh_result_free(r);
    }
}

/* The frequency gets its name wherever it is not ambiguous. */
Test(analyze, the_frequency_is_recognised)
{
    for (size_t i = 1; i < SET_COUNT; i++) {
        nh_result *r = ask((question){SLEIGH, QUESTION, SETS[i], NH_CHART_AUTO, 0, 1});
        cr_assert(r->specials == 1 && r->special[0].recognised[0], "k = %g", SETS[i][2]);
        cr_expect_eq(r->special[0].recognised[0], formula(r->model, "1/k"), "k = %g", SETS[i][2]);
        nh_result_free(r);
    }
}

/* k = 1, all the mass in the centre: no multiplier, the centre of mass moves uniformly, both components of its momentum are found. */
Test(analyze, the_sleigh_without_inertia_about_its_centre)
{
    const char *text = "name: q\nsystem: sleigh\nansatz:\n"
                       "  - product:\n"
                       "      - terms: [omega, v]\n"
                       "      - {basis: fourier, in: phi, harmonics: 1}\n"
                       "validate: {initial: {phi: 0.3, x: 0.1, y: -0.2, omega: 1.4, v: 0.7}, time: [0, 6]}\n"
                       "scene: {watch: [\"xC = x + a*cos(phi)\", \"yC = y + a*sin(phi)\"]}\n";
    nh_result *r = ask((question){SLEIGH, file("analysis.yaml", text), SETS[0], NH_CHART_AUTO, 0, 0});
    cr_assert_eq(r->verdict, NH_FOUND);
    cr_expect(find(r, "m*(x' - a*phi'*sin(phi))") && find(r, "m*(y' + a*phi'*cos(phi))"), "the momentum of the centre of mass");
    cr_expect(r->count == 2 && r->independent == 2);
    const nh_validation *v = r->validation;
    cr_assert(v && v->complete && v->watches == 2);
    double worst = 0, force = 0;
    for (size_t i = 0; i < v->count; i++)
        for (size_t j = 0; j < 2; j++) {
            double s = (v->time[i] - v->time[0]) / (v->time[v->count - 1] - v->time[0]);
            double line = (1 - s) * v->watch[j] + s * v->watch[(v->count - 1) * 2 + j];
            worst = fmax(worst, fabs(v->watch[2 * i + j] - line));
            force = fmax(force, fabs(v->multiplier[i]));
        }
    cr_expect(worst < 1e-8, "the centre of mass leaves its line by %.1e", worst);
    cr_expect(force < 1e-12, "the multiplier is %.1e", force);
    nh_result_free(r);
}

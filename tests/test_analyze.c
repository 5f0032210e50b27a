/* nh_analysis_create from files to currents: the paper's sleigh for every k, in both charts, what must not be found, and what must not matter. */
#include "mechanics.h"
#include "sweep.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "exact/normal.h"
#include "commands/analyze.h"
#include "graph/dag.h"

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

/* The shipped analysis without the program's own search: its ansatz alone. */
static const char *alone(const char *path)
{
    char text[8000] = "search: no\n";
    FILE *f = fopen(path, "r");
    cr_assert_not_null(f);
    size_t n = strlen(text);
    text[n + fread(text + n, 1, sizeof text - n - 1, f)] = 0;
    fclose(f);
    return file("alone.yaml", text);
}

typedef struct {
    const char *system, *analysis;
    const double *set; /* m, a, k of the sleigh, or NULL */
    nh_chart_choice chart;
    uint64_t seed;
    double until;
} question;

static nh_analysis *ask(question q)
{
    nh_setting setting[3] = {{.name = "m"}, {.name = "a"}, {.name = "k"}};
    nh_error error = {0};
    nh_request request = {.system_path = q.system, .analysis_path = q.analysis, .documents = true, .setting = setting, .chart = q.chart};
    if (q.analysis == QUESTION) request.analysis_path = alone(QUESTION);
    nh_options_default(&request.options);
    for (size_t i = 0; i < 3 && q.set; i++) setting[i].value = q.set[i];
    request.settings = q.set ? 3 : 0;
    request.seed_given = q.seed > 0;
    if (q.seed) request.options.seed = (double)q.seed;
    request.until_given = q.until > 0;
    if (q.until > 0) request.options.until = q.until;
    nh_analysis *r = nh_analysis_create(&request, &error);
    must(r != NULL, &error, q.system);
    return r;
}

/* ---- looking at a result ---- */

/* The current that is a multiple of an expected one; its distance must be rounding. */
static const nh_current *find(nh_analysis *r, const char *expected)
{
    nh_points *points = points_of(r->question->model, 100, 77);
    const nh_current *best = NULL;
    double nearest = 1e-10;
    for (size_t i = 0; i < r->list->count; i++) {
        double off = off_multiple(r->question->model, points, r->list->found[i].phi, formula(r->question->model, expected));
        if (off >= nearest) continue;
        nearest = off;
        best = &r->list->found[i];
    }
    nh_points_free(points);
    return best;
}

static bool warned(const nh_analysis *r, const char *text)
{
    for (size_t i = 0; i < r->warnings; i++)
        if (strstr(r->warning[i], text)) return true;
    return false;
}

/* Nothing that is reported may be false: Gamma(Phi) vanishes to the digits of doubles where it was not proved. */
static void nothing_false(nh_analysis *r)
{
    const nh_model *o = r->question->model;
    nh_points *points = points_of(o, 60, 88);
    double z[20];
    for (size_t i = 0; i < r->list->count; i++) {
        const nh_current *f = &r->list->found[i];
        nh_ex rate = nh_model_gamma(o, f->phi);
        cr_expect(f->proof.proved || f->proof.digits >= 50, "%s of %s is neither proved nor certified", f->name, r->question->system->name);
        double worst = 0, size = 0;
        for (size_t p = 0; p < points->count; p++) {
            point_of(points, p, z);
            worst = fmax(worst, fabs(value_at(o, rate, z)));
            size = fmax(size, fabs(value_at(o, f->phi, z)));
        }
        cr_expect(worst <= 1e-8 * size, "%s of %s changes at a rate of %.1e", f->name, r->question->system->name, worst);
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

static void check_found(nh_analysis *r, const expected *e)
{
    double k = r->question->model->parameter_value[2];
    const nh_current *f = find(r, e->formula);
    cr_assert_not_null(f, "k = %g in %s: %s was not found", k, r->question->model->chart->name, e->name);
    cr_expect(f->proof.proved && f->exact, "k = %g: %s was not proved", k, e->name);
    cr_expect(f->proof.all_parameters || k == 1, "k = %g: %s was not proved for all parameters", k, e->name);
    cr_expect(f->proof.digits >= 50, "%s: %g digits", e->name, f->proof.digits);
    cr_expect(f->has_symmetry && f->symmetry.noether_residual < 1e-9, "%s: residual %.1e", e->name, f->symmetry.noether_residual);
    cr_expect_eq(f->symmetry.kase, e->kase, "%s: case %d", e->name, f->symmetry.kase);
    cr_expect_eq(f->symmetry.bracket_in_distribution, e->in_distribution, "%s: bracket in the distribution", e->name);
    cr_expect_lt(f->heldout, 1e-8);
    cr_expect(f->has_in_velocities);
    if (!r->question->model->chart->quasi) return; /* the other chart ends on the way */
    cr_expect(f->drift.small && f->drift.falls, "k = %g: %s drifts by %.1e", k, e->name, f->drift.drift[NH_DRIFT_RUNS - 1]);
}

/* Which of Phi2 and Phi2b is called dependent is a matter of their order; one of them is, with its relation. */
static void check_sleigh(nh_analysis *r)
{
    double k = r->question->model->parameter_value[2];
    size_t dependent = 0;
    for (size_t i = 0; i < 4; i++) check_found(r, &PAPER[i]);
    cr_expect_eq(r->verdict, NH_FOUND, "k = %g: verdict %d", k, (int)r->verdict);
    cr_expect(r->list->count == 4 && r->list->independent == 3 && r->question->local_maximum == 5, "k = %g: %zu found, %zu independent", k, r->list->count, r->list->independent);
    for (size_t i = 0; i < r->list->count; i++) {
        const nh_current *f = &r->list->found[i];
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
static void check_relation(nh_analysis *r)
{
    const nh_current *a = find(r, PAPER[1].formula), *b = find(r, PAPER[2].formula), *e = find(r, "-E");
    nh_points *points = points_of(r->question->model, 40, 79);
    nh_ex three[] = {nh_powi(r->question->model->dag, a->phi, 2), nh_powi(r->question->model->dag, b->phi, 2), e->phi};
    nh_dag *d = r->question->model->dag;
    nh_ex sum = nh_add(d, nh_add(d, three[0], three[1]), nh_mul(d, nh_mul(d, nh_int(d, 2), formula(r->question->model, "m")), e->phi));
    cr_expect_eq(nh_normal_is_zero(d, sum, 0), NH_ZERO, "the currents are not normalised as in the paper");
    nh_points_free(points);
}

Test(analyze, the_sleigh_in_quasi_velocities)
{
    for (size_t i = 0; i < SET_COUNT; i++) {
        if (!sweep_tries(i + 1, 1, 3)) continue;
        nh_analysis *r = ask((question){SLEIGH, QUESTION, SETS[i], NH_CHART_QUASI, 0, 5});
        check_sleigh(r);
        if (SETS[i][2] != 1) check_relation(r);
        cr_expect(r->validation && r->validation->complete && r->validation->multiplier_form);
        cr_expect_lt(r->validation->state_difference, 1e-6);
        cr_expect_lt(r->validation->multiplier_difference, 1e-6);
        cr_expect_eq(!isnan(r->validation->crossing), SETS[i][2] > 1, "k = %g: the heading passes pi/2 for k > 1", SETS[i][2]);
        nh_analysis_free(r);
    }
}

Test(analyze, the_sleigh_in_coordinate_velocities, WHOLE_ONLY)
{
    for (size_t i = 0; i < SET_COUNT; i++) {
        if (!sweep_tries(i, 1, 3)) continue;
        nh_analysis *r = ask((question){SLEIGH, QUESTION, SETS[i], NH_CHART_COORDINATES, 0, 0.3});
        check_sleigh(r);
        nh_analysis_free(r);
    }
}

/* The ansatz of the shipped analysis, then the program's own search: all that can exist.  (Three of five.) */
Test(analyze, the_sleigh_has_all_five_quantities)
{
    nh_analysis *r = ask((question){SLEIGH, "analyses/sleigh.yaml", NULL, NH_CHART_AUTO, 0, 1});
    for (size_t i = 0; i < 4; i++) check_found(r, &PAPER[i]);
    cr_expect(r->list->independent == 5 && r->question->local_maximum == 5 && r->search == NH_SEARCH_COMPLETE, "%zu", r->list->independent);
    cr_expect(r->current.dimension == 4 && r->symmetry.dimension == 4, "the numbers of the problem are those of the ansatz");
    nh_analysis_free(r);
}

/* The frequency gets its name wherever it is not ambiguous. */
Test(analyze, the_frequency_is_recognised, PLAIN_ONLY)
{
    for (size_t i = 1; i < SET_COUNT; i++) {
        if (!sweep_tries(i + 2, 1, 3)) continue;
        nh_analysis *r = ask((question){SLEIGH, QUESTION, SETS[i], NH_CHART_AUTO, 0, 1});
        cr_assert(r->specials == 1 && r->special[0].recognised[0], "k = %g", SETS[i][2]);
        cr_expect_eq(r->special[0].recognised[0], formula(r->question->model, "1/k"), "k = %g", SETS[i][2]);
        nh_analysis_free(r);
    }
}

/* k = 1, all the mass in the centre: no multiplier, the centre of mass moves uniformly, both components of its momentum are found. */
Test(analyze, the_sleigh_without_inertia_about_its_centre, PLAIN_ONLY)
{
    const char *text = "name: q\nsystem: sleigh\nsearch: no\nansatz:\n"
                       "  - product:\n"
                       "      - terms: [omega, v]\n"
                       "      - {basis: fourier, in: phi, harmonics: 1}\n"
                       "validate: {initial: {phi: 0.3, x: 0.1, y: -0.2, omega: 1.4, v: 0.7}, time: [0, 6]}\n"
                       "scene: {watch: [\"xC = x + a*cos(phi)\", \"yC = y + a*sin(phi)\"]}\n";
    nh_analysis *r = ask((question){SLEIGH, file("analysis.yaml", text), SETS[0], NH_CHART_AUTO, 0, 0});
    cr_assert_eq(r->verdict, NH_FOUND);
    cr_expect(find(r, "m*(x' - a*phi'*sin(phi))") && find(r, "m*(y' + a*phi'*cos(phi))"), "the momentum of the centre of mass");
    cr_expect(r->list->count == 2 && r->list->independent == 2);
    const nh_validation *v = r->validation;
    cr_assert(v && v->complete && v->watches >= 2);
    size_t first = v->watches - 2; /* the user's are the last of what is recorded */
    double worst = 0, force = 0;
    for (size_t i = 0; i < v->count; i++)
        for (size_t j = 0; j < 2; j++) {
            double s = (v->time[i] - v->time[0]) / (v->time[v->count - 1] - v->time[0]);
            double line = (1 - s) * v->watch[first + j] + s * v->watch[(v->count - 1) * v->watches + first + j];
            worst = fmax(worst, fabs(v->watch[v->watches * i + first + j] - line));
            force = fmax(force, fabs(v->multiplier[i]));
        }
    cr_expect(worst < 1e-8, "the centre of mass leaves its line by %.1e", worst);
    cr_expect(force < 1e-12, "the multiplier is %.1e", force);
    nh_analysis_free(r);
}

/* ---- what must not be found ---- */

/* The sleigh's file with a line added or replaced. */
static const char *sleigh_with(const char *extra, const char *lagrangian_too)
{
    static char text[6000];
    char line[400];
    size_t at = 0;
    FILE *f = fopen(SLEIGH, "r");
    cr_assert_not_null(f);
    while (fgets(line, sizeof line, f)) {
        bool lagrangian = !strncmp(line, "lagrangian:", 11);
        if (lagrangian) line[strcspn(line, "\n")] = 0;
        at += (size_t)snprintf(text + at, sizeof text - at, "%s%s", line, lagrangian ? lagrangian_too : "");
        if (lagrangian) at += (size_t)snprintf(text + at, sizeof text - at, "\n%s", extra);
        cr_assert_lt(at, sizeof text - 500);
    }
    fclose(f);
    return file("system.yaml", text);
}

static const char *ansatz(const char *items)
{
    static char text[3000];
    snprintf(text, sizeof text, "name: q\nsystem: any\nsearch: no\nansatz:\n%s", items);
    return file("analysis.yaml", text);
}

/* A little friction: the energy is not conserved, and this is said; with a column that compensates it, that is a true current. */
Test(analyze, friction, WHOLE_ONLY)
{
    const char *system = sleigh_with("forces:\n  - phi = -0.01*phi'\n", "");
    nh_analysis *r = ask((question){.system = system, .analysis = ansatz("  - terms: [omega^2, v^2, omega*v]\n")});
    cr_expect(r->verdict == NH_NONE && r->list->count == 0, "verdict %d, %zu found", (int)r->verdict, r->list->count);
    cr_expect(warned(r, "energy is not conserved") && warned(r, "-omega^2/100"), "nothing was said about the energy");
    nh_analysis_free(r);
    r = ask((question){.system = system, .analysis = QUESTION});
    cr_expect_null(find(r, "E"));
    cr_expect_null(find(r, PAPER[1].formula));
    cr_expect_null(find(r, PAPER[2].formula));
    cr_assert_eq(r->list->count, 1);
    cr_expect_str_empty(r->list->found[0].meaning);
    cr_expect_not_null(find(r, "E + v/(100*a)"), "d/dt v = a omega^2 makes up for the friction");
    cr_expect(warned(r, "energy is not conserved"));
    nothing_false(r);
    nh_analysis_free(r);
    r = ask((question){.system = system}); /* the program's own search */
    cr_expect_null(find(r, "E"));
    cr_expect(warned(r, "energy is not conserved"));
    nothing_false(r);
    nh_analysis_free(r);
}

/* Nothing is said against the energy where it is conserved but not in the ansatz. */
Test(analyze, an_ansatz_without_a_true_integral_says_none, PLAIN_ONLY)
{
    static const char *const items[] = {"  - {basis: polynomial, in: [x, y, phi], degree: 3}\n", "  - terms: [omega, v, omega*v, omega^2]\n",
                                        "  - product:\n      - terms: [omega, v]\n      - {basis: fourier, in: phi, harmonics: 4}\n"};
    for (size_t i = 0; i < 3; i++) {
        nh_analysis *r = ask((question){.system = SLEIGH, .analysis = ansatz(items[i])});
        cr_expect(r->verdict == NH_NONE && r->list->count == 0 && r->list->independent == 0, "ansatz %zu: %zu found", i, r->list->count);
        cr_expect(r->current.done && r->current.rank > 0 && r->current.spectrum[0] > 1e-6, "ansatz %zu: smallest value %.1e", i, r->current.spectrum[0]);
        for (size_t j = 1; j < r->current.rank; j++) cr_expect(r->current.spectrum[j] >= r->current.spectrum[j - 1]);
        cr_expect(r->symmetry.done && r->symmetry.dimension == 0);
        cr_expect_not(warned(r, "energy"));
        nh_analysis_free(r);
    }
}

Test(analyze, an_unknown_frequency_that_does_not_exist)
{
    const char *system = sleigh_with("", " + 0.3*cos(x)");
    nh_analysis *r = ask((question){.system = system, .analysis = QUESTION, .until = 1});
    cr_expect(r->specials == 0 && r->hits->count == 0);
    cr_expect_eq(r->verdict, NH_NONE); /* E contains cos x, which is not in the ansatz */
    cr_expect(r->list->count == 0 && r->current.spectrum[0] > 1e-5, "%zu found, smallest value %.1e", r->list->count, r->current.spectrum[0]);
    nh_analysis_free(r);
}

/* A thousandth of something: nothing of the unperturbed system survives but what is true. */
Test(analyze, perturbed_systems, PLAIN_ONLY)
{
    static const char *const more[] = {" + 0.001*x'^2*x", " + 0.001*phi'*x'", " + 0.001*cos(phi)", " + 0.001*x*y", " + 0.001*x'^4"};
    for (size_t i = 0; i < 5; i++) {
        if (!sweep_tries(i, 4, 8)) continue;
        const char *system = sleigh_with("", more[i]);
        nh_analysis *r = ask((question){.system = system, .analysis = QUESTION, .until = 1}), *own = ask((question){.system = system, .until = 1});
        cr_expect_null(find(r, PAPER[1].formula), "%s", more[i]);
        cr_expect_null(find(r, PAPER[2].formula), "%s", more[i]);
        cr_expect_null(find(r, PAPER[3].formula), "%s", more[i]);
        nothing_false(r);
        nothing_false(own);
        cr_expect_not_null(find(own, "E"), "%s: the energy", more[i]);
        nh_analysis_free(own);
        nh_analysis_free(r);
    }
}

/* Almost integrable: the frequency is off by 1e-7, so that the null value is small but not null. */
Test(analyze, nearly_is_not_conserved)
{
    nh_analysis *r = ask((question){.system = SLEIGH, .analysis = ansatz("  - product:\n      - terms: [omega, v]\n"
                                                                      "      - {basis: fourier, in: phi, frequency: 0.5000001}\n")});
    cr_expect(r->verdict == NH_NONE && r->list->count == 0, "verdict %d with %zu found", (int)r->verdict, r->list->count);
    cr_expect(r->current.spectrum[0] > 1e-9 && r->current.spectrum[0] < 1e-6, "%.1e", r->current.spectrum[0]);
    nh_analysis_free(r);
}

/* Functions that the search makes may be undefined somewhere (here the root of 3 - 8 x^2 + ...): they go, the energy stays. */
Test(analyze, words_that_are_not_finite_do_not_hide_the_energy, PLAIN_ONLY)
{
    nh_analysis *r = ask((question){.system = file("system.yaml", "name: box\ncoordinates: [{name: x, type: length}, {name: y, type: length}, {name: p, type: angle}]\n"
                                                               "lagrangian: x'^2*(29*y^4 + 25)/200 - 2.12*x^2 + y'^2*(29*x^2 + 18)/100 + p'^2 + y^2*p'\n"
                                                               "constraints: [\"p' = 79*x^2*y'/50 - 4*x'*sin(p)/5\"]\n"), .until = 1});
    cr_expect_not_null(find(r, "E"), "%zu found", r->list->count);
    nothing_false(r);
    nh_analysis_free(r);
}

/* A number too long for an exact rational: rounding at the 16th digit is no refutation, and no certificate. */
Test(analyze, inexact_constants_refute_nothing)
{
    nh_analysis *r = ask((question){.system = file("system.yaml", "name: tiny\ncoordinates: [x, y]\n"
                                                               "lagrangian: x'^2/2 + 1.3*y'^2*(1 + x^2) + x'*y'/3 - 1.1234567890123e-9*(7.7e10*x^3*y + 3.3e10*y^4/7)/1.7e1 - 1.6726e-27*1e27*y\n"), .until = 1});
    cr_assert_geq(r->list->count, 1);
    cr_expect_not_null(find(r, "E"), "%zu found", r->list->count);
    cr_expect_not(warned(r, "is not conserved"));
    cr_expect(r->list->found[0].proof.proved || r->verdict == NH_UNDECIDED);
    nh_analysis_free(r);
}

/* ---- what must not matter ---- */

#define POLYNOMIAL "  - {basis: polynomial, in: [omega, v], degree: 2}\n"
#define WAVES "  - product:\n      - {basis: polynomial, in: [omega, v], degree: 1}\n      - {basis: fourier, in: phi, harmonics: 1}\n"
#define TRUE_WAVES "  - product:\n      - terms: [omega, v]\n      - {basis: fourier, in: phi, frequency: 1/k}\n"
#define TERMS "  - terms: [\"x'*t\", \"x*omega\", \"sqrt(E)*t\"]\n"

/* Relative difference of two spectra above rounding. */
static double spectra(const nh_spectrum *a, const nh_spectrum *b)
{
    double worst = a->rank == b->rank && a->dimension == b->dimension ? 0 : INFINITY;
    for (size_t i = a->dimension; i < a->rank && isfinite(worst); i++) worst = fmax(worst, fabs(a->spectrum[i] / b->spectrum[i] - 1));
    return worst;
}

static nh_analysis *plain(const char *system, const char *items, uint64_t seed, nh_chart_choice chart)
{
    return ask((question){.system = system, .analysis = ansatz(items), .seed = seed, .until = 0.3, .chart = chart});
}

/* With an ansatz of the user's own nothing is counted beyond the first degree that misses some: series of higher degrees take
 * most of the time and memory, and change nothing that is said. */
Test(analyze, counts_with_an_ansatz_end_where_something_is_missing)
{
    nh_analysis *r = ask((question){.system = SLEIGH, .analysis = QUESTION, .until = 0.3});
    for (int kind = 0; kind < NH_COMPLETENESS_KINDS; kind++) {
        const nh_completeness *c = &r->completeness[kind];
        cr_expect(c->degree == 1 && c->missing_at == 2 && c->missing == 1 && c->count.rows == 2 && c->count.more, "%zu rows", c->count.rows);
    }
    nh_analysis_free(r);
}

/* The same rows in another order: the same spectrum.  The seed moves the points: the same dimensions, the same kind of spectrum. */
Test(analyze, order_of_the_ansatz_and_seed, PLAIN_ONLY)
{
    nh_analysis *a = plain(SLEIGH, POLYNOMIAL WAVES TRUE_WAVES TERMS, 1, NH_CHART_AUTO);
    const char *orders[] = {TERMS TRUE_WAVES WAVES POLYNOMIAL, WAVES TERMS POLYNOMIAL TRUE_WAVES};
    for (size_t i = 0; i < 2; i++) {
        nh_analysis *b = plain(SLEIGH, orders[i], 1, NH_CHART_AUTO);
        cr_expect_eq(a->list->count, b->list->count);
        cr_expect_lt(spectra(&a->current, &b->current), 1e-8, "order %zu: %.1e", i, spectra(&a->current, &b->current));
        cr_expect_lt(spectra(&a->symmetry, &b->symmetry), 1e-8, "order %zu: %.1e", i, spectra(&a->symmetry, &b->symmetry));
        nh_analysis_free(b);
    }
    cr_expect_eq(a->current.dimension, 3);
    for (uint64_t seed = 2; seed < 8; seed++) {
        if (!sweep_tries(seed, 3, 6)) continue;
        nh_analysis *b = plain(SLEIGH, POLYNOMIAL WAVES TRUE_WAVES TERMS, seed, NH_CHART_AUTO);
        cr_expect(b->verdict == NH_FOUND && b->list->count == a->list->count && b->list->independent == a->list->independent);
        cr_expect_lt(spectra(&a->current, &b->current), 0.5, "seed %d: %.1e", (int)seed, spectra(&a->current, &b->current));
        for (size_t i = 0; i < 3; i++) cr_expect_not_null(find(b, PAPER[i].formula), "seed %d: %s", (int)seed, PAPER[i].name);
        nh_analysis_free(b);
    }
    nh_analysis_free(a);
}

/* The same seed gives the same result to the last digit. */
Test(analyze, repeatable, PLAIN_ONLY)
{
    nh_analysis *a = ask((question){SLEIGH, QUESTION, SETS[4], NH_CHART_AUTO, 3, 1}), *b = ask((question){SLEIGH, QUESTION, SETS[4], NH_CHART_AUTO, 3, 1});
    cr_assert_eq(a->current.rank, b->current.rank);
    cr_expect_arr_eq(a->current.spectrum, b->current.spectrum, a->current.rank * sizeof(double));
    cr_expect_arr_eq(a->special[0].value, b->special[0].value, sizeof(double));
    for (size_t i = 0; i < a->list->count; i++) cr_expect_eq(a->list->found[i].drift.drift[2], b->list->found[i].drift.drift[2]);
    nh_analysis_free(a);
    nh_analysis_free(b);
}

/* Millimetres for metres: a and the velocity's box times 1000; grams for kilograms. */
static const char *in_other_units(double length, double mass)
{
    static char text[3000];
    snprintf(text, sizeof text,
             "name: sleigh\n"
             "parameters: [{name: m, value: %.17g}, {name: a, value: %.17g}, {name: k, value: 2}]\n"
             "coordinates:\n  - {name: phi, type: angle}\n  - {name: x, type: length}\n  - {name: y, type: length}\n"
             "lagrangian: m/2*((x' - a*phi'*sin(phi))^2 + (y' + a*phi'*cos(phi))^2) + m*a^2*(k^2 - 1)/2*phi'^2\n"
             "constraints: [\"y' = x'*tan(phi)\"]\ndependent: [y]\n"
             "velocities: {names: [omega, v], map: [phi' = omega, x' = v*cos(phi), y' = v*sin(phi)]}\n"
             "domain: {phi: [-1.2, 1.2], omega: [-2, 2], v: [%.17g, %.17g], x: [%.17g, %.17g], y: [%.17g, %.17g]}\n",
             2 * mass, length, -2 * length, 2 * length, -length, length, -length, length);
    return file("system.yaml", text);
}

Test(analyze, units, PLAIN_ONLY)
{
    nh_analysis *a = plain(in_other_units(1, 1), POLYNOMIAL WAVES TRUE_WAVES TERMS, 1, NH_CHART_AUTO);
    nh_analysis *grams = plain(in_other_units(1, 1000), POLYNOMIAL WAVES TRUE_WAVES TERMS, 1, NH_CHART_AUTO);
    cr_expect_eq(a->list->count, 3);
    cr_expect_lt(spectra(&a->current, &grams->current), 1e-8, "%.1e", spectra(&a->current, &grams->current));
    cr_expect_lt(spectra(&a->symmetry, &grams->symmetry), 1e-8, "%.1e", spectra(&a->symmetry, &grams->symmetry));
    const double lengths[] = {1000, 1e-3};
    for (size_t i = 0; i < 2; i++) {
        nh_analysis *b = plain(in_other_units(lengths[i], 1), POLYNOMIAL WAVES TRUE_WAVES TERMS, 1, NH_CHART_AUTO);
        cr_expect(b->verdict == NH_FOUND && b->list->count == 3 && b->list->independent == 2, "lengths x %g: %zu found", lengths[i], b->list->count);
        cr_expect(b->current.dimension == a->current.dimension && b->current.rank == a->current.rank, "lengths x %g", lengths[i]);
        cr_expect(b->symmetry.dimension == a->symmetry.dimension && b->symmetry.rank == a->symmetry.rank, "lengths x %g", lengths[i]);
        cr_expect(b->routes_agree, "lengths x %g: %.1e", lengths[i], b->routes_angle);
        for (size_t j = 0; j < 3; j++) cr_expect_not_null(find(b, PAPER[j].formula), "lengths x %g: %s", lengths[i], PAPER[j].name);
        nh_analysis_free(b);
    }
    nh_analysis_free(a);
    nh_analysis_free(grams);
}

/* The same question in both charts: the same functions, so the same dimensions and ranks. */
Test(analyze, charts, PLAIN_ONLY)
{
    nh_analysis *a = plain(SLEIGH, POLYNOMIAL WAVES TRUE_WAVES TERMS, 1, NH_CHART_QUASI);
    nh_analysis *b = plain(SLEIGH, POLYNOMIAL WAVES TRUE_WAVES TERMS, 1, NH_CHART_COORDINATES);
    cr_expect(a->question->model->chart->quasi && !b->question->model->chart->quasi);
    cr_expect(a->list->count == b->list->count && a->list->independent == b->list->independent && b->verdict == NH_FOUND);
    cr_expect(a->current.dimension == b->current.dimension && a->current.rank == b->current.rank, "%zu of %zu, %zu of %zu", a->current.dimension,
              a->current.rank, b->current.dimension, b->current.rank);
    cr_expect_eq(a->symmetry.dimension, b->symmetry.dimension);
    for (size_t j = 0; j < 3; j++) cr_expect(find(a, PAPER[j].formula) && find(b, PAPER[j].formula), "%s", PAPER[j].name);
    nh_analysis_free(a);
    nh_analysis_free(b);
}

/* ---- other systems, from files of the test's own ---- */

/* A Chebyshev series of high degree, whose last coefficients are tiny: y' exp(cos q) is conserved. */
Test(analyze, chebyshev)
{
    const char *system = file("system.yaml", "name: weight\ncoordinates: [{name: q, type: angle}, {name: y, type: length}]\n"
                                             "lagrangian: (q'^2 + exp(cos(q))*y'^2)/2\ndomain: {q: [-1, 1]}\n");
    const char *items = "  - product:\n      - terms: [\"y'\"]\n      - {basis: chebyshev, in: q, degree: 24}\n";
    nh_analysis *r = ask((question){.system = system, .analysis = ansatz(items)});
    cr_assert(r->current.dimension == 1 && r->list->count == 0 && r->almosts == 1, "%zu null values, %zu found, %zu almost", r->current.dimension, r->list->count, r->almosts);
    cr_expect_eq(r->verdict, NH_UNDECIDED, "fitted coefficients are no certificate");
    cr_expect(r->almost[0].digits >= 10 && r->almost[0].rate < 1e-9, "%g digits, rate %.1e", r->almost[0].digits, r->almost[0].rate);
    nh_points *points = points_of(r->question->model, 100, 5);
    double off = off_multiple(r->question->model, points, r->almost[0].phi, formula(r->question->model, "exp(cos(q))*y'"));
    cr_expect_lt(off, 1e-10, "off by %.1e", off);
    nh_points_free(points);
    nh_analysis_free(r);
}

Test(analyze, a_nonlinear_constraint, PLAIN_ONLY)
{
    nh_analysis *r = ask((question){.system = file("system.yaml", SPACE_EXPLICIT), .analysis = ansatz("  - terms: [\"x'/y'\", \"x'\", \"y'\", \"x\", \"t\"]\n")});
    cr_assert_eq(r->list->count, 1, "%zu found", r->list->count);
    cr_expect_not_null(find(r, "x'/y'"));
    cr_expect(r->list->found[0].symmetry.kase == 2 && r->list->found[0].symmetry.bracket_in_distribution, "case %d", r->list->found[0].symmetry.kase);
    cr_expect(warned(r, "energy is not conserved"));
    nothing_false(r);
    nh_analysis_free(r);
}

/* A disturbance of 1e-9 breaks the rotation: no double sees it, the refined coefficients do. */
/* Z = Z^0 Gamma + relative, component by component; of a boost the relative part is t d/dx + d/dx'. */
Test(analyze, symmetries_relative_to_the_motion, PLAIN_ONLY)
{
    static const char text[] = "name: pair\ncoordinates: [{name: x, type: length}, {name: y, type: length}]\n"
                               "parameters: [{name: m, value: 1.3}, {name: n, value: 0.7}]\nlagrangian: m*x'^2/2 + n*y'^2/2 - (x - y)^4/4 - (x - y)^2\n";
    nh_analysis *r = ask((question){.system = file("system.yaml", text)});
    const nh_model *o = r->question->model;
    nh_points *at = nh_points_create(o, 20, 1, 3, NULL);
    size_t seen = 0;
    for (size_t k = 0; k < r->list->count; k++) {
        const nh_symmetry *z = &r->list->found[k].symmetry;
        if (!z->along_motion) continue;
        seen++;
        nh_ex off[4];
        double value[4 * 20];
        for (size_t s = 0; s < 2; s++) {
            off[s] = nh_sub(o->dag, z->field.space[s], nh_add(o->dag, nh_mul(o->dag, z->Z0, o->rho[s]), z->relative.space[s]));
            off[2 + s] = nh_sub(o->dag, z->field.velocity[s], nh_add(o->dag, nh_mul(o->dag, z->Z0, o->a[s]), z->relative.velocity[s]));
            cr_expect_eq(z->relative.space[s], o->system->t);
            cr_expect_eq(z->relative.velocity[s], nh_int(o->dag, 1));
        }
        nh_points_evaluate(at, o, 4, off, value);
        for (size_t i = 0; i < 4 * at->count; i++) cr_expect(fabs(value[i]) < 1e-11, "off by %g", value[i]);
    }
    cr_expect_eq(seen, 1);
    nh_points_free(at);
    nh_analysis_free(r);
}

Test(analyze, almost_conserved_is_told_apart)
{
    nh_analysis *r = ask((question){.system = file("system.yaml", PARTICLE("rounded", "") "lagrangian: (x'^2 + y'^2 - x^2 - y^2)/2 + 1e-9*x^2*y\n"),
                                  .analysis = ansatz("  - {basis: polynomial, in: [x, y, x', y'], degree: 4}\n")});
    cr_expect(r->verdict == NH_FOUND && r->list->independent == 1, "%zu independent", r->list->independent);
    cr_expect_not_null(find(r, "x'^2 + y'^2 + x^2 + y^2 - 2e-9*x^2*y"));
    cr_assert_gt(r->almosts, 0);
    for (size_t k = 0; k < r->almosts; k++) {
        const nh_near_current *a = &r->almost[k];
        cr_expect(a->digits > 6 && a->digits < 25 && a->rate > 0 && a->rate < 1e-8, "%g digits, rate %.1e", a->digits, a->rate);
    }
    nh_analysis_free(r);
}

/* Definitions that use each other many times over: the potential would be longer than any memory when written out, and is a small graph. */
Test(analyze, definitions_upon_definitions, PLAIN_ONLY)
{
    enum { levels = 45 };
    char text[levels * 60 + 300];
    size_t n = (size_t)sprintf(text, "name: deep\nparameters: [{name: m, value: 1.5}]\ncoordinates: [{name: x, type: length}]\ndefinitions:\n  - d0 = x/m\n");
    for (int i = 0; i < levels; i++) n += (size_t)sprintf(text + n, "  - d%d = (d%d + 1)*(d%d + 2)/(3 + d%d^2)\n", i + 1, i, i, i);
    sprintf(text + n, "lagrangian: m*x'^2/2 - d%d\n", levels);
    nh_analysis *r = ask((question){.system = file("system.yaml", text)});
    cr_expect_eq(r->question->model->n, 1u);
    nothing_false(r);
    nh_analysis_free(r);
}

/* What a current is called, it is: sign, factor and all. */
Test(analyze, meanings_are_true)
{
    static const char *const systems[] = {"sleigh", "vertical_disk", "heisenberg_particle", "rolling_ball", "charged_particle", "euler_top"};
    size_t tried = 0, energies = 0, momenta = 0;
    for (size_t i = 0; i < sizeof systems / sizeof *systems; i++) {
        if (!sweep_tries(i + 1, 6, 12)) continue;
        tried++;
        char path[100];
        snprintf(path, sizeof path, "systems/%s.yaml", systems[i]);
        nh_analysis *r = ask((question){.system = path});
        nh_dag *d = r->question->model->dag;
        for (size_t k = 0; k < r->list->count; k++) {
            const nh_current *f = &r->list->found[k];
            const char *momentum = strstr(f->meaning, "momentum of ");
            bool minus = !strncmp(f->meaning, "minus the ", 10), multiple = !strncmp(f->meaning, "a multiple of the ", 18);
            nh_ex e = r->question->model->E;
            cr_expect_eq(f->energy, strstr(f->meaning, "energy") != NULL);
            if (!momentum && !f->energy) continue;
            for (size_t s = 0; momentum && s < r->question->model->m; s++)
                if (!strcmp(momentum + 12, r->question->system->coordinate[s].name)) e = r->question->model->p[s];
            cr_expect(multiple || nh_is_zero(d, nh_simplify(d, nh_sub(d, f->phi, minus ? nh_neg(d, e) : e))), "%s: %s is not the %s", systems[i], f->name, f->meaning);
            energies += f->energy;
            momenta += momentum != NULL;
        }
        nh_analysis_free(r);
    }
    cr_expect(energies == tried && momenta + 1 > tried, "%zu energies, %zu momenta", energies, momenta);
}

/* Coefficients that solve a linear equation without elementary solutions (the disk's are of Legendre type): a series each, certified by its
 * refinement; with the energy they are three of the disk's currents.  They must be new, linear and constant to rounding inside the interval. */
Test(analyze, series_of_the_rolling_disk, PLAIN_ONLY)
{
    nh_error error = {0};
    nh_request request = {.system_path = "systems/rolling_disk.yaml"};
    nh_options_default(&request.options);
    request.options.named = 0;
    nh_analysis *r = nh_analysis_create(&request, &error);
    must(r != NULL, &error, "rolling_disk");
    size_t series = 0;
    cr_expect(r->verdict == NH_FOUND && r->list->independent == 3, "%zu independent", r->list->independent);
    for (size_t k = 0; k < r->list->count; k++) {
        const nh_current *f = &r->list->found[k];
        if (!f->series) continue;
        series++;
        cr_expect(f->proof.digits >= 50 && f->printed_digits >= 13 && f->printed_digits < 20, "%g refined, %g printed", f->proof.digits, f->printed_digits);
        cr_expect(f->heldout < 1e-12 && f->series->low < 0.8 && f->series->high > 1.8, "%.1e on [%g, %g]", f->heldout, f->series->low, f->series->high);
        cr_expect(f->independence == NH_INDEPENDENT && f->drift.small, "drift %.1e", f->drift.drift[2]);
        for (size_t i = 0; i < r->question->model->n; i++)
            for (size_t j = 0; j < r->question->model->n; j++) {
                nh_ex second = nh_model_Y(r->question->model, i, nh_model_Y(r->question->model, j, f->phi));
                cr_expect(nh_is_zero(r->question->model->dag, nh_simplify(r->question->model->dag, second)), "not linear");
            }
    }
    cr_expect_eq(series, 2);
    nh_analysis_free(r);
}

/* Kovalevskaya's top in Euler angles: energy, momentum, and an integral of the fourth degree; with other moments of inertia it is not there. */
Test(analyze, kovalevskaya, PLAIN_ONLY)
{
    static const char *const form =
        "name: top\nparameters: [{name: A, value: %s}, {name: C, value: 0.9}, {name: g, value: 1.3}]\n"
        "coordinates: [{name: phi, type: angle}, {name: theta, type: angle}, {name: psi, type: angle}]\n"
        "lagrangian: A/2*(phi'^2*sin(theta)^2 + theta'^2) + C/2*(psi' + phi'*cos(theta))^2 - g*sin(theta)*sin(psi)\ndomain: {theta: [0.4, 2.6]}\n";
    char text[600];
    for (int special = 0; special < 2; special++) {
        snprintf(text, sizeof text, form, special ? "1.8" : "1.7");
        nh_analysis *r = ask((question){.system = file("system.yaml", text)});
        cr_expect(r->verdict == NH_FOUND && r->list->independent == 2 + (size_t)special, "%zu independent", r->list->independent);
        nothing_false(r);
        nh_analysis_free(r);
    }
}

/* What is found in Cartesian coordinates must be found in polar ones: vectors have the harmonics of a cyclic angle there. */
Test(analyze, polar_coordinates, WHOLE_ONLY)
{
#define SPHERICAL "coordinates: [{name: r, type: length}, {name: th, type: angle}, {name: ph, type: angle}]\ndomain: {r: [0.5, 2], th: [0.4, 2.6]}\n"
#define POLAR "coordinates: [{name: r, type: length}, {name: ph, type: angle}]\ndomain: {r: [0.5, 2]}\n"
    static const struct {
        const char *text;
        size_t independent;
        const char *one; /* one of the currents */
    } list[] = {
        {"name: kepler\n" POLAR "lagrangian: (r'^2 + r^2*ph'^2)/2 + 1.3/r\n", 4, NULL}, /* Kepler's equation is the fourth */
        {"name: oscillator\n" POLAR "lagrangian: (r'^2 + r^2*ph'^2)/2 - 1.7*r^2/2\n", 4, "r^2*ph'"},
        {"name: free\n" SPHERICAL "lagrangian: (r'^2 + r^2*th'^2 + r^2*sin(th)^2*ph'^2)/2\n", 6, "r^2*sin(th)^2*ph'"},
        {"name: monopole\n" SPHERICAL "lagrangian: (r'^2 + r^2*th'^2 + r^2*sin(th)^2*ph'^2)/2 + 0.6*cos(th)*ph' + 1.2/r - 0.18/r^2\n", 5, "r^2*sin(th)^2*ph' + 0.6*cos(th)"},
    };
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        nh_analysis *r = ask((question){.system = file("system.yaml", list[i].text)});
        cr_expect(r->verdict == NH_FOUND && r->list->independent == list[i].independent, "%s: %zu independent", r->question->system->name, r->list->independent);
        if (list[i].one) cr_expect_not_null(find(r, list[i].one), "%s", r->question->system->name);
        nothing_false(r);
        nh_analysis_free(r);
    }
}

/* An exponent that the program must find: y^c x' with the force -c x' y'/y, and it must be recognised as c. */
Test(analyze, unknown_exponents)
{
    const char *text = "name: power\nparameters: [{name: c, value: 0.7}]\ncoordinates: [{name: x, type: length}, {name: y, type: length}]\n"
                       "lagrangian: (x'^2 + y'^2)/2\nforces: [\"x = -c*x'*y'/y\"]\ndomain: {y: [0.5, 2]}\n";
    nh_analysis *r = ask((question){.system = file("system.yaml", text)});
    cr_expect(r->verdict == NH_FOUND && r->list->independent == 4, "%zu independent", r->list->independent);
    const nh_current *f = find(r, "y^c*x'");
    cr_assert_not_null(f);
    cr_expect(f->proof.all_parameters, "for all c");
    nothing_false(r);
    nh_analysis_free(r);
}

/* A free top whose angle of precession is given as a length, in thousandths: the pencil has seven digits of the rate 1/1000. */
Test(analyze, a_rate_with_few_digits, PLAIN_ONLY)
{
    const char *text = "name: top\nparameters: [{name: A, value: 1.1}, {name: B, value: 1.7}, {name: C, value: 2.3}]\n"
                       "coordinates: [{name: p, type: length}, {name: h, type: angle}, {name: s, type: angle}]\n"
                       "definitions: [\"P = p'/1000\"]\ndomain: {p: [-800, 800], h: [0.5, 2.1], s: [-0.8, 0.8]}\n"
                       "lagrangian: A*(h'*cos(s) + P*sin(h)*sin(s))^2/2 + B*(-h'*sin(s) + P*sin(h)*cos(s))^2/2 + C*(P*cos(h) + s')^2/2\n";
    nh_analysis *r = ask((question){.system = file("system.yaml", text)});
    cr_expect(r->verdict == NH_FOUND && r->list->independent == 4, "%zu independent", r->list->independent);
    for (size_t k = 0; k < r->list->count; k++) cr_expect(r->list->found[k].proof.all_parameters, "Phi%zu", k + 1);
    nothing_false(r);
    nh_analysis_free(r);
}

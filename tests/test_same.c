/* The answer does not depend on what must not matter: seed, names and order of the coordinates, units, the choice of dependent velocities, the chart.
 *
 * The currents found are written as known ones into the changed file, so that each must be a function of those found there; as many independent
 * ones on both sides then means the same currents. */
#include <criterion/criterion.h>

#include <unistd.h>

#include "catalogue.h"
#include "rewrite.h"
#include "scratch.h"

#include "graph/num.h"

static const char *const systems[] = {"appell_hamel", "contact_oscillator", "euler_top", "free_particle", "heisenberg_particle", "henon_heiles_kk", "isotropic_oscillator",
                                      "kepler", "knife_edge", "lagrange_top", "lane_emden", "neumann", "nonholonomic_oscillator", "nonholonomic_particle", "perpendicular_velocities", "relativistic_particle",
                                      "sleigh", "sleigh_inertia", "spherical_pendulum", "suslov", "suslov_principal", "two_wheel_carriage", "vertical_disk"};
enum { SYSTEMS = sizeof systems / sizeof *systems };

static nh_options patient(void)
{
    nh_options options;
    nh_options_default(&options);
    options.max_seconds = 1e6; /* time must not decide what is found */
    options.stage_columns = 120;
    options.until = 0.5;
    options.steps = 2000;
    return options;
}

/* What a person reads off. */
typedef struct {
    nh_analysis *r;
    nh_ex *current; /* independent ones, in t, q, q' */
    size_t count, certified;
} answer;

static nh_analysis *analysis_of(const char *path, const nh_options *options, nh_chart_choice chart)
{
    nh_error error = {0};
    nh_request q = {.system_path = path, .options = *options, .seed_given = true, .chart = chart};
    nh_analysis *r = nh_analysis_create(&q, &error);
    cr_assert_not_null(r, "%s: %s", path, error.what);
    return r;
}

static size_t certified(const nh_analysis *r)
{
    size_t n = 0;
    for (size_t k = 0; k < r->list->count; k++) n += r->list->found[k].proof.proved || r->list->found[k].proof.digits >= r->question->options.digits;
    return n;
}

static answer answer_of(const char *name, const nh_options *options)
{
    char path[300];
    snprintf(path, sizeof path, "systems/%s.yaml", name);
    answer a = {.r = analysis_of(path, options, NH_CHART_AUTO)};
    a.current = nh_alloc_array(a.r->list->count + 1, sizeof *a.current);
    for (size_t k = 0; k < a.r->list->count; k++) {
        cr_assert(a.r->list->found[k].has_in_velocities);
        if (a.r->list->found[k].independence == NH_INDEPENDENT) a.current[a.count++] = a.r->list->found[k].in_velocities;
    }
    a.certified = certified(a.r);
    return a;
}

static void answer_clear(answer *a)
{
    nh_free(a->current);
    nh_analysis_free(a->r);
}

/* The changed system gives the same verdict and the same currents; `what` was changed. */
static void expect_same(const answer *a, const char *name, const char *what, const nh_options *options, rewriting how, nh_chart_choice chart)
{
    char path[SCRATCH];
    FILE *out = scratch_open(path);
    cr_assert_not_null(out);
    how.known = a->count;
    how.current = a->current;
    rewrite_system(a->r->question->system, &how, out);
    fclose(out);
    nh_analysis *r = analysis_of(path, options, chart);
    row o = {.rate = -INFINITY};
    compare(r, &o);
    cr_expect_eq(r->verdict, a->r->verdict, "%s, %s: verdict %d, was %d", name, what, (int)r->verdict, (int)a->r->verdict);
    cr_expect_eq(o.found, a->r->list->independent, "%s, %s: %zu independent currents, were %zu", name, what, o.found, a->r->list->independent);
    cr_expect_eq(o.maximum, a->r->question->local_maximum, "%s, %s: at most %zu, was %zu", name, what, o.maximum, a->r->question->local_maximum);
    cr_expect_eq(o.missing, 0, "%s, %s: %s", name, what, o.names);
    cr_expect_eq(o.wrong, 0, "%s, %s: %s", name, what, o.names);
    cr_expect_eq(r->list->count - certified(r), a->r->list->count - a->certified, "%s, %s: %zu of %zu certified, were %zu of %zu", name, what, certified(r), r->list->count, a->certified, a->r->list->count);
    nh_analysis_free(r);
    remove(path);
}

typedef void check(const answer *, const char *, const nh_options *);

static void for_all(check *one, size_t from)
{
    nh_options options = patient();
    for (size_t i = 0; i < SYSTEMS; i++) {
        if (!sweep_tries(i + from, 48, 160)) continue;
        answer a = answer_of(systems[i], &options);
        one(&a, systems[i], &options);
        answer_clear(&a);
    }
}

static void other_seeds(const answer *a, const char *name, const nh_options *options)
{
    for (int seed = 2; seed <= 3; seed++) {
        nh_options other = *options;
        char what[40];
        other.seed = 1000003.0 * seed;
        snprintf(what, sizeof what, "seed %.0f", other.seed);
        expect_same(a, name, what, &other, (rewriting){0}, NH_CHART_AUTO);
    }
}

Test(same, whatever_the_seed) { for_all(other_seeds, 19); }

static void other_names(const answer *a, const char *name, const nh_options *options)
{
    enum { most = 20 };
    size_t back[most], turned[most], m = a->r->question->system->coordinates;
    cr_assert_leq(m, (size_t)most);
    for (size_t i = 0; i < m; i++) back[i] = m - 1 - i, turned[i] = (i + 1) % m;
    expect_same(a, name, "renamed", options, (rewriting){.rename = true}, NH_CHART_AUTO);
    expect_same(a, name, "in the opposite order", options, (rewriting){.order = back}, NH_CHART_AUTO);
    expect_same(a, name, "renamed and in another order", options, (rewriting){.rename = true, .order = turned}, NH_CHART_AUTO);
}

Test(same, whatever_the_coordinates_are_called_and_their_order, PLAIN_ONLY)
{
    for_all(other_names, 18);
}

/* Centimetres and kilometres, minutes, another unit of mass. */
static void other_units(const answer *a, const char *name, const nh_options *options)
{
    expect_same(a, name, "lengths in hundredths", options, (rewriting){.length = nh_num_ratio(1, 100)}, NH_CHART_AUTO);
    expect_same(a, name, "lengths in thousands", options, (rewriting){.length = nh_num_int(1000)}, NH_CHART_AUTO);
    expect_same(a, name, "times in sixtieths", options, (rewriting){.time = nh_num_ratio(1, 60)}, NH_CHART_AUTO);
    expect_same(a, name, "L times 1/1000", options, (rewriting){.action = nh_num_ratio(1, 1000)}, NH_CHART_AUTO);
    expect_same(a, name, "all units changed", options, (rewriting){.length = nh_num_int(12), .time = nh_num_ratio(7, 2), .action = nh_num_int(1000)}, NH_CHART_AUTO);
}

Test(same, whatever_the_units) { for_all(other_units, 21); }

/* Every other choice of dependent velocities that gives a chart at all, up to a few. */
static void other_charts(const answer *a, const char *name, const nh_options *options)
{
    enum { most_choices = 3 };
    const nh_system *y = a->r->question->system;
    size_t m = y->coordinates, k = y->constraints, tried = 0;
    if (k == 0) return;
    if (y->quasi) expect_same(a, name, "in coordinate velocities", options, (rewriting){.no_chart = true}, NH_CHART_COORDINATES);
    for (size_t bits_of = 0; bits_of < (size_t)1 << m && tried < most_choices; bits_of++) {
        size_t dependent[20], n = 0;
        for (size_t s = 0; s < m; s++)
            if (bits_of >> s & 1) dependent[n++] = s;
        if (n != k) continue;
        char *text = NULL;
        size_t size;
        nh_error error = {0};
        rewriting how = {.no_chart = true, .dependents = k, .dependent = dependent};
        FILE *out = open_memstream(&text, &size);
        rewrite_system(y, &how, out);
        fclose(out);
        nh_system *again = nh_system_parse("again", text, 0, NULL, &error);
        nh_chart *chart = again ? nh_chart_create(again, NH_CHART_COORDINATES, 1, &error) : NULL;
        bool regular = chart && chart->pivot > 1e-3 && chart->implicit == 0;
        nh_chart_free(chart);
        nh_system_free(again);
        free(text);
        if (!regular) continue;
        char what[200] = "dependent:";
        for (size_t i = 0; i < k; i++) strcat(strcat(what, " "), y->coordinate[dependent[i]].name);
        expect_same(a, name, what, options, how, NH_CHART_COORDINATES);
        tried++;
    }
}

Test(same, whatever_the_chart) { for_all(other_charts, 14); }

/* Systems that the catalogue does not have: everything that is known of each is found, certified, and nothing more is claimed.  One per weakness that strangers'
 * systems have shown. */
#include <criterion/criterion.h>

#include <unistd.h>

#include "catalogue.h"
#include "scratch.h"
#include "search/search.h"
#include "sweep.h"
#include "unseen.h"

static void expect_known(const unseen *u)
{
    char path[SCRATCH];
    FILE *out = scratch_open(path);
    cr_assert_not_null(out);
    fprintf(out, "name: unseen\n%s", u->text);
    fclose(out);
    nh_error error = {0};
    nh_request q = {.system_path = path, .seed_given = true};
    nh_options_default(&q.options);
    q.options.max_seconds = 1e6; /* the same on every machine */
    nh_analysis *r = nh_analysis_create(&q, &error);
    remove(path);
    cr_expect_not_null(r, "%s: %s", u->name, error.what);
    if (!r) return;
    row o = {.rate = -INFINITY};
    compare(r, &o);
    cr_expect_eq(o.missing + o.wrong + o.untrue, 0, "%s: %s", u->name, o.names);
    cr_expect_eq(r->verdict, NH_FOUND, "%s", u->name);
    cr_expect_eq(r->list->independent, u->independent, "%s: %zu independent", u->name, r->list->independent);
    nh_analysis_free(r);
}

Test(unseen, what_is_known_is_found_certified_and_no_more_is_claimed, PLAIN_ONLY)
{
    for (size_t i = 0; i < UNSEEN_COUNT; i++)
        if (sweep_tries(i + 1, 20, 36)) expect_known(&UNSEEN[i]);
}

/* No other test has these ways. */
Test(unseen, hidden_turns, PLAIN_ONLY)
{
    size_t turns = 0;
    for (size_t i = 0; i < UNSEEN_COUNT; i++)
        if (!strncmp(UNSEEN[i].name, "turn ", 5) && sweep_tries(turns++, 10, 10)) expect_known(&UNSEEN[i]);
}

/* z' = A z + b(t), where b has finitely many derivatives: each current is exp(-lambda t) (l . z + c(t)), and no series
   is needed. */
Test(unseen, linear_motion_that_is_driven_has_closed_forms, PLAIN_ONLY)
{
    static const struct {
        const char *name, *text;
        size_t independent;
        bool formulas; /* the rates are formulas, too: everything is proved */
    } driven[] = {
        {"a trough whose axis moves",
         "parameters: {m: 1, k: 3, v: 0.5}\n"
         "coordinates: [x, y]\n"
         "lagrangian: m/2*(x'^2 + y'^2) - k/2*(y - v*t)^2\n", 4, true},
        {"sprung masses with drag, under a force that grows",
         "parameters: {m: 1, k: 3, c: 0.4, f: 0.2}\n"
         "coordinates: [x, y]\n"
         "lagrangian: m/2*(x'^2 + y'^2) - k/2*(x^2 + (y - x)^2) + f*t^2*y\n"
         "forces: [\"x = -c*x'\"]\n", 4, false},
        {"springs that weaken as 1/t^2",
         "parameters: {k: 0.1}\n"
         "coordinates: [x, y]\n"
         "lagrangian: (x'^2 + y'^2)/2 - k*(x^2 + 3*y^2)/(2*t^2)\n"
         "domain: {t: [1, 2]}\n", 4, true},
        {"pendulum with friction as the square of its velocity",
         "parameters: {c: 0.3, g: 0.8}\n"
         "coordinates: [{name: h, type: angle}]\n"
         "lagrangian: h'^2/2 + g*cos(h)\n"
         "forces: [\"h = -c*h'^2\"]\n", 1, true},
        {"a mass that grows, under a wave",
         "parameters: {m: 1, k: 4, b: 0.2, F: 0.5, w: 1.7}\n"
         "coordinates: [x]\n"
         "lagrangian: exp(b*t)*(m/2*x'^2 - k/2*x^2 + F*x*cos(w*t))\n", 2, true},
        {"resonance",
         "parameters: {m: 1.3, F: 0.5, w: 1.7}\n"
         "coordinates: [x]\n"
         "lagrangian: m/2*(x'^2 - w^2*x^2) + F*x*sin(w*t)\n", 2, true},
        {"sprung masses under a wave that dies out",
         "parameters: {m: 1.3, k: 3, F: 0.5, w: 1.7, c: 0.3}\n"
         "coordinates: [x, y]\n"
         "lagrangian: m/2*(x'^2 + y'^2) - k/2*(x^2 + (y - x)^2 + y^2) + F*y*exp(-c*t)*cos(w*t)^2\n", 4, true},
    };
    for (size_t i = 0; i < sizeof driven / sizeof *driven; i++) {
        if (!sweep_tries(i, 2, 3)) continue;
        char path[SCRATCH];
        FILE *out = scratch_open(path);
        cr_assert_not_null(out);
        fprintf(out, "name: driven\n%s", driven[i].text);
        fclose(out);
        nh_error error = {0};
        nh_request q = {.system_path = path, .seed_given = true};
        nh_options_default(&q.options);
        nh_analysis *r = nh_analysis_create(&q, &error);
        remove(path);
        cr_assert_not_null(r, "%s: %s", driven[i].name, error.what);
        cr_expect_eq(r->list->independent, driven[i].independent, "%s: %zu independent", driven[i].name, r->list->independent);
        for (size_t k = 0; k < r->list->count; k++)
            cr_expect(!r->list->found[k].series && (r->list->found[k].proof.proved || !driven[i].formulas), "%s: %s", driven[i].name,
                      r->list->found[k].name);
        nh_analysis_free(r);
    }
}

/* Where the count does not reach, or has no such coefficients, one stage finds what the others do not: each of these has a system. */
Test(unseen, stages_that_have_a_system_of_their_own)
{
    static const struct {
        const char *stage, *text;
        size_t independent;
    } ROW[] = {
        /* asin + acos are functions that may be related: not counted; P_x - pi/2 F t in elliptic coordinates */
        {"states with linear equations, times functions of t",
         "parameters: {F: 0.7}\n"
         "coordinates: [u, v, z]\n"
         "lagrangian: (cosh(u)^2 - cos(v)^2)*(u'^2 + v'^2)/2 + z'^2/2 + F*cosh(u)*cos(v)*(asin(z/9) + acos(z/9))\n"
         "domain: {u: [0.5, 1.5], v: [0.3, 1.2]}\n", 6},
        /* no polynomial in the velocities; t is known on a short interval, where its functions are nearly dependent */
        {"momenta times 1, t and logarithms of t, positions, powers of t",
         "coordinates: [x, y, z]\n"
         "lagrangian: t*(x'^2 + y'^2 + z'^2)/2 + x*log(t) + y*t^3\n"
         "constraints: [\"z'^2 = 1\"]\n"
         "domain: {t: [1, 1.1]}\n", 5},
        /* a rolling disk, which has two integrals with Legendre functions of h, beside a quartic oscillator */
        {"velocities with coefficients that are named functions of h",
         "parameters: {m: 1.3, A: 0.25, C: 0.5, r: 0.8, g: 0.9}\n"
         "coordinates: [x, y, {name: p, type: angle}, {name: h, type: angle}, {name: s, type: angle}, w]\n"
         "lagrangian: A*(h'^2 + p'^2*sin(h)^2)/2 + C*(p'*cos(h) + s')^2/2 - g*m*r*sin(h) + m*(h'^2*r^2*cos(h)^2 + x'^2 + y'^2)/2 + w'^2/2 - w^3 - w^4\n"
         "constraints: [\"x' = h'*r*sin(h)*sin(p) - p'*r*cos(h)*cos(p) - r*s'*cos(p)\", \"y' = -h'*r*sin(h)*cos(p) - p'*r*sin(p)*cos(h) - r*s'*sin(p)\"]\n"
         "domain: {h: [0.8, 1.8]}\n", 4},
    };
    for (size_t i = 0; i < sizeof ROW / sizeof *ROW; i++) {
        if (!sweep_tries(i + 2, 3, 3)) continue;
        char path[SCRATCH];
        FILE *out = scratch_open(path);
        cr_assert_not_null(out);
        fprintf(out, "name: own\n%s", ROW[i].text);
        fclose(out);
        nh_error error = {0};
        nh_request q = {.system_path = path, .seed_given = true};
        nh_options_default(&q.options);
        nh_analysis *r = nh_analysis_create(&q, &error);
        remove(path);
        cr_assert_not_null(r, "%s: %s", ROW[i].stage, error.what);
        size_t found = 0;
        for (size_t k = 0; k < r->stages; k++)
            if (!strcmp(r->stage[k].name, ROW[i].stage)) found += r->stage[k].found;
        cr_expect_gt(found, 0, "%s", ROW[i].stage);
        cr_expect_eq(r->list->independent, ROW[i].independent, "%s: %zu independent", ROW[i].stage, r->list->independent);
        nh_analysis_free(r);
    }
}

/* ---- rows of the search that a developer leaves out (make stages) ---- */

static nh_analysis *analysed_without(const char *path, uint64_t left_out)
{
    nh_error error = {0};
    nh_request q = {.system_path = path, .seed_given = true, .left_out = left_out};
    nh_options_default(&q.options);
    q.options.max_seconds = 1e6;
    nh_analysis *r = nh_analysis_create(&q, &error);
    cr_assert_not_null(r, "%s: %s", path, error.what);
    return r;
}

static uint64_t row_named(const char *name)
{
    for (size_t i = 0; nh_staged_search_row(i); i++)
        if (!strcmp(nh_staged_search_row(i), name)) return UINT64_C(1) << i;
    cr_assert_fail("no row %s", name);
    return 0;
}

/* The quadratures alone give exp(-J d log(omega)/(m c)), and the same of -omega, where omega is negative: one integral.  They were counted as two. */
Test(unseen, without_stages_nothing_is_counted_twice)
{
    size_t rows = 0;
    while (nh_staged_search_row(rows)) rows++;
    cr_assert(rows < 63);
    nh_analysis *r = analysed_without("systems/skate_with_friction.yaml", (UINT64_C(1) << rows) - 1 - row_named("quadratures"));
    cr_expect_eq(r->list->independent, 3);
    cr_expect_eq(r->question->left_out & r->used, 0);
    cr_expect_eq(r->used, row_named("quadratures"));
    nh_analysis_free(r);
}

/* A row that is left out is not run, and everything else is as it was. */
Test(unseen, a_row_that_is_left_out_finds_nothing)
{
    nh_analysis *all = analysed_without("systems/oscillator.yaml", 0);
    cr_assert(all->used & row_named("linear motion"));
    nh_analysis *r = analysed_without("systems/oscillator.yaml", row_named("linear motion"));
    cr_expect_not(r->used & row_named("linear motion"));
    cr_expect_leq(r->list->independent, all->list->independent);
    nh_analysis_free(r);
    nh_analysis_free(all);
}

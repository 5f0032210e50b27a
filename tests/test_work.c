/* work: what a benchmark says of times, floor, fronts and orders of its own runs, what it draws of them, and what it leaves away when only a part is asked for.  (The numbers themselves: test_judge.c.) */
#include <cjson/cJSON.h>
#include <stdio.h>

#include "mechanics.h"
#include "program.h"
#include "scratch.h"
#include "sweep.h"
#include "document/benchmark.h"
#include "document/benchmark_internal.h"

static nh_benchmark *compare(const char *path, const char *initial, double until, double budget, bool fit)
{
    nh_error error = {0};
    nh_request q = {.system_path = path, .initial = initial, .until_given = true, .fit = fit};
    nh_options_default(&q.options);
    q.options.until = until;
    if (!fit) q.options.benchmark_columns = 2; /* no discrete problem */
    nh_benchmark *c = nh_benchmark_run(&q, budget, &error);
    must(c != NULL, &error, path);
    return c;
}

/* Beside other programs a run may have fewer repetitions, but never none. */
Test(work, a_time_is_the_median_of_its_repetitions, PLAIN_ONLY)
{
    nh_benchmark *c = compare("systems/sleigh.yaml", "omega=2", 5, 5, false);
    size_t often = 0;
    for (size_t i = 0; i < c->count; i++) {
        const nh_run_record *m = &c->item[i];
        size_t below = 0, above = 0;
        if (m->status == NH_NOT_RUN || m->status == NH_FAILED) continue;
        cr_assert(m->repeats >= 1 && m->repeats <= NH_BENCHMARK_REPEATS);
        for (size_t k = 0; k < m->repeats; k++) below += m->time[k] <= m->seconds, above += m->time[k] >= m->seconds;
        cr_expect(2 * below >= m->repeats && 2 * above >= m->repeats, "%s: %zu, %zu of %zu", m->method, below, above, m->repeats);
        cr_expect_eq(isnan(m->seconds_low), m->repeats < 3);
        if (m->repeats >= 3) cr_expect(m->seconds_low <= m->seconds && m->seconds <= m->seconds_high, "%s", m->method);
        often += m->repeats >= 3;
    }
    cr_expect_geq(often, 10u);
    nh_benchmark_free(c);
}

Test(work, nothing_beats_a_run_on_the_front_by_either_measure, PLAIN_ONLY)
{
    nh_benchmark *c = compare("systems/rolling_disk.yaml", NULL, 3, 3, false);
    size_t on = 0, below = 0;
    for (size_t i = 0; i < c->count; i++) {
        const nh_run_record *m = &c->item[i];
        cr_expect_eq(m->below_floor, m->error <= c->agreement || (m->reduced && m->error <= m->floor));
        below += m->below_floor;
        on += m->front_evaluations;
        for (size_t j = 0; j < c->count; j++) {
            const nh_run_record *o = &c->item[j];
            if (o->status != NH_ACCURATE || o->reduced) continue;
            double mine = fmax(m->error, m->floor), other = fmax(o->error, o->floor);
            cr_expect_not(m->front_evaluations && other < mine && o->evaluations <= m->evaluations, "%s by %s", m->method, o->method);
            cr_expect_not(m->front && other < mine && o->seconds <= m->seconds, "%s by %s", m->method, o->method);
        }
    }
    cr_expect(on >= 2 && below >= 1, "%zu, %zu", on, below);
    nh_benchmark_free(c);
}

/* A force with a kink: no method has its order there, and the sentence says why; without the kink all have it. */
Test(work, an_order_that_is_not_that_of_the_theory_has_a_sentence, PLAIN_ONLY)
{
    static const struct {
        const char *text;
        bool kink;
    } all[] = {{"name: kink\ncoordinates: [x]\nlagrangian: x'^2/2 - abs(x) - x^2/2\n", true}, {"name: smooth\ncoordinates: [x]\nlagrangian: x'^2/2 - x^4/4 - x^2/2\n", false}};
    for (size_t k = 0; k < 2; k++) {
        char path[SCRATCH];
        cr_assert(scratch_text(path, all[k].text));
        nh_benchmark *c = compare(path, "x=1", 7, 3, false);
        nh_text words;
        nh_text_init(&words);
        bool told = nh_benchmark_put_orders(c, 9, &words);
        cr_assert(c->orders >= 4, "%zu", c->orders);
        if (all[k].kink) cr_expect(told && strstr(nh_text_string(&words), "midpoint, order 4: observed 1.") && strstr(nh_text_string(&words), "because the right-hand side is not smooth."), "%s", nh_text_string(&words));
        else cr_expect_null(strstr(nh_text_string(&words), "smooth"), "%s", nh_text_string(&words));
        for (size_t i = 0; i < c->orders; i++)
            if (!strcmp(c->order[i].method, "midpoint")) cr_expect_eq(c->order[i].judged.reason, all[k].kink ? NH_ORDER_ROUGH : NH_ORDER_EXPECTED);
        nh_text_clear(&words);
        nh_benchmark_free(c);
        remove(path);
    }
}

/* What no budget was left for was not run; a timeout was begun. */
Test(work, what_was_never_begun_is_no_timeout)
{
    nh_benchmark *c = compare("systems/rolling_disk.yaml", NULL, 5, 0.15, false);
    size_t not_run = 0;
    for (size_t i = 0; i < c->count; i++) {
        const nh_run_record *m = &c->item[i];
        if (m->status == NH_TIMEOUT) cr_expect(m->evaluations > 0, "%s", m->method);
        if (m->status != NH_NOT_RUN) continue;
        cr_expect(m->repeats == 0 && m->evaluations == 0 && isnan(m->seconds) && isnan(m->error) && m->note[0], "%s", m->method);
        not_run++;
    }
    cr_expect(c->partial && not_run > 0);
    nh_benchmark_free(c);
}

/* ---- drawings ---- */

static size_t marks_of(const nh_curve *f) { return f->front || f->expected ? 0 : f->count; }

static void check_panel(const nh_benchmark *c, const nh_plot *p, bool evaluations)
{
    size_t named = 0, points = 0, hollow = 0, all = 0, below = 0;
    for (size_t k = 0; k < p->curves; k++) {
        const nh_curve *f = &p->curve[k];
        named += !f->front && !f->faint && !f->expected;
        points += marks_of(f);
        for (size_t i = 0; i < marks_of(f); i++) hollow += f->style[i] == NH_MARK_HOLLOW;
        for (size_t j = 0; j < k; j++) cr_expect(f->front || f->faint || strcmp(f->name, p->curve[j].name), "two curves %s", f->name);
        for (size_t i = 1; i < f->count && f->front; i++) cr_expect(f->x[i - 1] <= f->x[i] && f->y[i - 1] >= f->y[i], "no stairs"); /* less work, larger error */
    }
    for (size_t i = 0; i < c->count; i++) {
        const nh_run_record *m = &c->item[i];
        bool drawn = !m->reduced && m->status <= NH_FLAGGED && isfinite(m->error);
        all += drawn;
        below += drawn && m->below_floor;
    }
    cr_expect_leq(named, 6u);
    cr_expect_geq(named, 2u);
    cr_expect_eq(points, all, "%zu of %zu runs", points, all);
    cr_expect_eq(hollow, below, "%zu hollow of %zu", hollow, below);
    cr_expect_eq(p->shaded, c->agreement);
    cr_expect_str_eq(p->y_label, evaluations ? "evaluations of the right-hand side" : "seconds");
}

Test(work, every_run_is_drawn_and_six_methods_have_names, PLAIN_ONLY)
{
    nh_benchmark *c = compare("systems/sleigh.yaml", "omega=2", 5, 3, false);
    nh_benchmark_row row[NH_BENCHMARK_ROWS];
    size_t rows = nh_benchmark_rows(c, c->arena, row);
    cr_assert(rows >= 2 && row[0].panels == 2 && row[0].others > 0);
    check_panel(c, &row[0].panel[0], false);
    check_panel(c, &row[0].panel[1], true);
    cr_expect_str_eq(row[1].panel[1].y_label, "evaluations of the right-hand side");
    nh_text svg;
    nh_text_init(&svg);
    nh_benchmark_svg(c, &svg);
    const char *text = nh_text_string(&svg);
    cr_expect(strstr(text, "Methods with a fixed step") && strstr(text, "not told from the reference") && strstr(text, "Equations reduced by a symmetry group"));
    cr_expect_not(strstr(text, "nan") || strstr(text, "inf\""));
    cr_expect_lt(svg.length, 60000u);
    nh_text_clear(&svg);
    nh_benchmark_free(c);
}

/* ---- parts ---- */

/* The known currents are nearer than rounding lets expect, and no motion is computed. */
Test(work, the_discrete_problem_alone, PLAIN_ONLY)
{
    nh_benchmark *c = compare("systems/spherical_pendulum.yaml", NULL, 1, 4, true);
    size_t known = 0, samples = 0;
    bool grids = false; /* others than Sobol points */
    cr_expect(c->count == 0 && c->fits > 20 && c->derivatives == 0, "%zu, %zu", c->count, c->fits);
    for (size_t i = 0; i < c->fits; i++) {
        const nh_fitted *m = &c->fit[i];
        cr_expect(m->degree >= 1 && strstr("sobol halton tensor sparse", m->grid), "%s", m->grid);
        grids |= strcmp(m->grid, "sobol") != 0;
        samples += i == 0 || (m->degree == c->fit[0].degree && m->samples != c->fit[i - 1].samples);
        if (!m->right || !isfinite(m->error)) continue;
        known++;
        cr_expect(m->error < 10 * m->expected, "%zu functions, %zu samples: %g, expected %g", m->functions, m->samples, m->error, m->expected);
    }
    cr_expect(known > 10 && samples >= 5, "%zu, %zu", known, samples);
    nh_benchmark_row row[NH_BENCHMARK_ROWS];
    cr_expect_eq(nh_benchmark_rows(c, c->arena, row), 1u);
    cr_expect(row[0].fit && row[0].panels == 3);
    cr_expect(grids);
    nh_benchmark_free(c);
}

Test(work, a_map_comes_without_the_comparison)
{
    place p = place_with_systems();
    finished f = run_expecting(&p, "benchmark free_particle --until 1 --budget 1s --over x=0:1 --initial x=0 --details", 0);
    const char *map = strstr(f.out, "Where methods fail");
    size_t before = 0;
    cr_assert_not_null(map, "%s", f.out);
    for (const char *c = f.out; c < map; c++) before += *c == '\n';
    cr_expect_leq(before, 8u, "%s", f.out);
    cr_expect_not(strstr(f.out, "All runs") || strstr(f.out, "msadams") || strstr(f.out, "Jacobian"), "%s", f.out);
    finished_clear(&f);
    f = run_expecting(&p, "benchmark free_particle --fit --over x=0:1", 2);
    cr_expect_str_eq(f.err, "nhsym: --fit, and --over as well\nhint: --fit measures the discrete problem, and no motion\n");
    finished_clear(&f);
    place_clear(&p);
}

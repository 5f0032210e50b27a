/* Is there any other integral?  Systems of the literature, from both sides: where one is known to exist none is excluded. */
#include <criterion/criterion.h>

#include "absence.h"
#include "program.h"
#include "published.h"
#include "sweep.h"

static nh_analysis *asked(const absence_system *s)
{
    nh_error error = {0};
    nh_analysis *r = absence_of_text(s->text, &error);
    cr_assert(r && r->absence, "%s: %s", s->name, error.what);
    return r;
}

/* Nothing that exists is excluded, and no engine contradicts another one. */
static void sound(const char *name, const nh_analysis *r, size_t exist)
{
    const nh_absence *a = r->absence;
    cr_expect_null(a->contradiction, "%s: %s", name, a->contradiction);
    cr_expect_geq(absence_bound(a), exist, "%s: at most %zu (%s), and %zu exist", name, absence_bound(a), absence_word(a), exist);
}

static void judge(const absence_system *s, const nh_analysis *r)
{
    const nh_absence *a = r->absence;
    unsigned by = absence_by(a);
    bool excluded = absence_bound(a) == s->exist;
    sound(s->name, r, s->exist);
    cr_expect_eq(by & s->by, s->by, "%s: engines %u, expected %u; %s", s->name, by, s->by, a->obstacle ? a->obstacle : "");
    if (s->expected == EXCLUDED) {
        cr_expect(excluded, "%s: %s, %s", s->name, absence_word(a), a->obstacle ? a->obstacle : "");
        cr_expect(!a->rational, "%s: meromorphic, not only rational", s->name);
    }
    if (s->expected == IRREGULAR) cr_expect(!excluded || a->rational, "%s: at most rational", s->name);
    /* an integrable system may be settled: then as many are found as are known */
    if (s->expected == OPEN_ROW) cr_expect(!excluded || s->exist > 1, "%s: %s", s->name, absence_word(a));
    if (a->verdict == NH_ABSENCE_OPEN) cr_expect_not_null(a->obstacle, "%s: no reason", s->name);
}

Test(absence_systems, rows_of_the_literature)
{
    for (size_t i = 0; i < ABSENCE_COUNT; i++) {
        if (!sweep_tries(i, 12, 40)) continue;
        nh_analysis *r = asked(&ABSENCE[i]);
        judge(&ABSENCE[i], r);
        nh_analysis_free(r);
    }
}

/* What the search finds in systems whose integrals are known, and in the catalogue: a refutation beside it would be false. */
Test(absence_systems, published_integrals_are_not_excluded, PLAIN_ONLY)
{
    for (size_t i = 0; i < PUBLISHED_COUNT; i++) {
        if (!sweep_tries(i, 60, 120)) continue;
        nh_error error = {0};
        nh_analysis *r = absence_of_text(PUBLISHED[i].text, &error);
        cr_assert(r && r->absence, "%s: %s", PUBLISHED[i].name, error.what);
        sound(PUBLISHED[i].name, r, absence_count(r));
        nh_analysis_free(r);
    }
}

/* With the energy alone the engines must leave room for the others. */
Test(absence_systems, integrals_that_are_withheld_are_not_excluded, PLAIN_ONLY)
{
    for (size_t i = 0; i < ABSENCE_COUNT; i++) {
        if (ABSENCE[i].exist < 2 || !sweep_tries(i, 30, 60)) continue;
        char why[200];
        nh_analysis *r = asked(&ABSENCE[i]);
        cr_expect(absence_without(r, why, sizeof why), "%s: %s", ABSENCE[i].name, why);
        nh_analysis_free(r);
    }
}

/* Without the program: KdV's potential with a constraint, and without it as a control. */
Test(absence_systems, numbers_agree, PLAIN_ONLY)
{
    if (system("/usr/bin/python3 -c 'import numpy, sympy' 2>/dev/null") != 0) {
        cr_log_warn("skipped: there is no Python with NumPy and SymPy (Debian: python3-numpy python3-sympy)");
        return;
    }
    cr_expect_eq(system(sweep_whole() ? "/usr/bin/python3 tests/numerical_monodromy.py >/dev/null" : "/usr/bin/python3 tests/numerical_monodromy.py 'KdV with z' >/dev/null"), 0);
}

/* classify --of absence: the values of Henon and Heiles' family that are found and excluded; 2/3 by a logarithm of higher order. */
Test(absence_systems, classify_answers_from_both_sides)
{
    static const char *const sides[] = {"excluded", "found", "excluded", "excluded", "found"};
    place p = place_make();
    char line[600], path[PATH_MAX + 30];
    snprintf(line, sizeof line, "classify %.300s/tests/data/classify/henon_heiles.yaml --over eps=-1/3,1/3,2/3,1,2 --of absence --set B=1 --degree 2 --quiet --json c.json", p.project);
    finished f = run(&p, line);
    cr_assert_eq(f.code, 0, "%s", f.err);
    snprintf(path, sizeof path, "%s/c.json", p.folder);
    FILE *file = fopen(path, "r");
    cr_assert_not_null(file);
    char *text = read_stream(file);
    fclose(file);
    nh_json *root = nh_json_parse(text);
    const nh_json *values = nh_json_get(root, "values");
    cr_assert_eq(nh_json_count(values), 5);
    for (size_t i = 0; i < 5; i++) cr_expect_str_eq(nh_json_text(nh_json_entry(values, i), "side"), sides[i], "%s", nh_json_text(nh_json_entry(values, i), "value"));
    cr_expect(nh_json_is_true(root, "almost_all_excluded"));
    nh_json_free(root);
    free(text);
    finished_clear(&f);
    place_clear(&p);
}

Test(absence_systems, integrals_of_the_catalogue_are_not_excluded)
{
    char *name[most_files];
    size_t n = list("systems", name);
    cr_assert_gt(n, 50);
    for (size_t i = 0; i < n; i++) {
        char path[SCRATCH];
        nh_error error = {0};
        snprintf(path, sizeof path, "systems/%s.yaml", name[i]);
        nh_analysis *r = sweep_tries(i + 3, 20, 60) ? absence_of_file(path, &error) : NULL;
        if (r) sound(name[i], r, absence_count(r));
        cr_expect_eq(error.code, NH_OK, "%s: %s", name[i], error.what);
        nh_analysis_free(r);
        free(name[i]);
    }
}

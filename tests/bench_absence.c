/* bench_absence: the page docs/absence.md: is there any other integral?  The table of the literature, families from both sides,
 * the catalogue, and rows that are in no paper that we know.
 *
 *     bench_absence FOLDER [table|families|catalogue|monodromy]
 *
 * The exit code is 1 where something that exists is excluded, an engine contradicts another one, or a row is another than is expected. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "absence.h"
#include "sweep.h"

enum { most_text = 2000, most_reasons = 40, most_values = 24 };

typedef struct {
    size_t rows, excluded, open, wrong;
    double seconds;
} sums;

/* ---- the table ---- */

static void put_engines(const nh_absence *a)
{
    const nh_absence_attempt *t = absence_shown(a);
    printf(" %s | ", t && t->kovacic ? nh_kovacic_word(t->kovacic->group) : "-");
    if (t && t->higher && t->higher->refuted) printf("logarithm at order %u | ", t->higher->order);
    else if (t && t->monodromy) printf("%zu of %zu | ", t->monodromy->rank, t->monodromy->size);
    else if (t && t->residues) printf("residues: %s | ", t->residues->verdict == NH_RESIDUE_OPEN ? "open" : t->residues->factor);
    else printf("- | ");
    printf("%s | ", !a->darboux || !a->darboux->applies ? "-" : a->darboux->refuted ? a->darboux->refutation.eigenvalue : "open");
    if (t && t->higher && t->higher->refuted) printf("%lu | ", (unsigned long)t->higher->prime);
    else if (t && t->kovacic) printf("%lu | ", (unsigned long)t->kovacic->prime);
    else printf("- | ");
}

static bool as_expected(const absence_system *s, const nh_absence *a)
{
    bool excluded = absence_bound(a) == s->exist, sound = absence_bound(a) >= s->exist && !a->contradiction;
    if (s->expected == EXCLUDED) return sound && excluded && !a->rational && (absence_by(a) & s->by) == s->by;
    if (s->expected == IRREGULAR) return sound && (!excluded || a->rational);
    return sound && (!excluded || s->exist > 1);
}

static void table_row(const absence_system *s, sums *sum)
{
    nh_error error = {0};
    nh_analysis *r = absence_of_text(s->text, &error);
    sum->rows++;
    if (!r) {
        printf("| %s | no analysis: %s | | | | | | | |\n", s->name, error.what);
        sum->wrong++;
        return;
    }
    const nh_absence *a = r->absence;
    const nh_absence_attempt *t = absence_shown(a);
    bool good = as_expected(s, a);
    printf("| %s | %s%s | %zu | %s |", s->name, absence_word(a), good ? "" : " (not as expected)", a->known, t && t->equation ? t->equation->plane->words : "-");
    put_engines(a);
    printf("%.2f |\n", absence_seconds);
    fflush(stdout);
    sum->excluded += absence_bound(a) == s->exist;
    sum->open += a->verdict == NH_ABSENCE_OPEN;
    sum->wrong += !good;
    sum->seconds += absence_seconds;
    nh_analysis_free(r);
}

static size_t table(void)
{
    sums sum = {0};
    puts("| system | other integrals | known | motions | Kovacic | balls, or higher order | lines | prime | s |\n|---|---|---|---|---|---|---|---|---|");
    for (size_t i = 0; i < ABSENCE_COUNT; i++) table_row(&ABSENCE[i], &sum);
    printf("\n%zu systems: at %zu a theorem excludes all that are not known to exist, %zu are open, %zu are not as expected; %.1f s for all decisions.\n", sum.rows, sum.excluded, sum.open,
           sum.wrong, sum.seconds);
    return sum.wrong;
}

/* ---- families ---- */

typedef struct {
    const char *name, *format; /* with the first value, then the second one */
    const char *over[2];
    const char *value[2][most_values];
    size_t fewest; /* integrals for almost all values */
    bool (*known)(double a, double b); /* the literature knows one more */
    const char *literature;
    bool swapped; /* the second value comes first in the format */
} family;

static bool is(double a, double b) { return fabs(a - b) < 1e-9; }

static bool known_henon_heiles(double B, double eps) { return is(eps, 2) || (is(B, 1) && is(eps, 1. / 3)) || (is(B, 16) && is(eps, 16. / 3)); }
static bool known_top(double A, double B) { return is(B, 1) || (is(A, B) && is(B, 2)) || (is(A, 1) && is(B, 0.5)); }
static bool known_quartic(double a, double b)
{
    static const double list[][2] = {{2, 1}, {6, 1}, {12, 16}, {0.75, 1. / 16}, {6, 8}, {0.75, 0.125}};
    for (size_t i = 0; i < sizeof list / sizeof *list; i++)
        if (is(a, list[i][0]) && is(b, list[i][1])) return true;
    return is(a, 0);
}
static bool known_suslov(double one, double two) { return is(one, two); }
static bool known_free(double k, double none) { return (void)none, is(k, 0); }

static const family FAMILIES[] = {
    {.name = "Henon-Heiles, V = (x^2 + B y^2)/2 + x^2 y + eps y^3", .format = HENON_HEILES("%s", "%s"), .over = {"B", "eps"},
     .value = {{"1/16", "1/4", "1/2", "1", "2", "4", "16"}, {"-1", "-1/3", "1/5", "1/3", "1/2", "2/3", "1", "4/3", "2", "3", "16/3", "10/3"}}, .fewest = 1, .known = known_henon_heiles,
     .literature = "eps = 2; (1, 1/3); (16, 16/3)"},
    {.name = "Heavy tops with moments A, B, 1 and the centre of mass on the first axis", .format = HEAVY_TOP("%s", "%s", "1", "1", "0"), .over = {"A", "B"},
     .value = {{"1/2", "1", "3/2", "2", "3", "4"}, {"1/2", "1", "3/2", "2", "3", "4"}}, .fewest = 2, .known = known_top, .literature = "B = 1 (Lagrange); (2, 2), (1, 1/2) (Kovalevskaya); (4, 4) (Goryachev and Chaplygin, on a level only)"},
    {.name = "Homogeneous quartics, V = x^4 + a x^2 y^2 + b y^4", .format = IN_PLANE("x^4 + (%s)*x^2*y^2 + (%s)*y^4"), .over = {"a", "b"},
     .value = {{"-1", "0", "3/4", "1", "2", "3", "6", "8", "12"}, {"-1", "1/16", "1/8", "1/2", "1", "2", "8", "16"}}, .fewest = 1, .known = known_quartic,
     .literature = "a = 0; (2, 1); (6, 1); (12, 16), (3/4, 1/16); (6, 8), (3/4, 1/8)"},
    {.name = "Suslov's problem with Kozlov's potential and moments I1, I2", .format = SUSLOV("%s", "%s", "cos(h)"), .over = {"I1", "I2"},
     .value = {{"1", "2", "3", "4", "5", "6", "8", "10"}, {"1", "2", "3", "4", "5", "6"}}, .fewest = 1, .known = known_suslov, .literature = "I1 = I2"},
    {.name = "Nonholonomic Henon-Heiles, z' = k y x'", .format = NONHOLONOMIC_HENON_HEILES("1", "-1/3", "%s"), .over = {"k"}, .value = {{"0", "1/10", "1/3", "1/2", "1", "3/2", "2", "5"}}, .fewest = 1, .known = NULL, .literature = "none"},
    {.name = "Nonholonomic KdV, z' = k y x'", .format = NONHOLONOMIC_HENON_HEILES("1", "2", "%s"), .over = {"k"}, .value = {{"0", "1/10", "1/3", "1/2", "1", "3/2", "2", "5"}}, .fewest = 1, .known = known_free, .literature = "k = 0"},
    {.name = "Nonholonomic Sawada-Kotera, z' = k y x'", .format = NONHOLONOMIC_HENON_HEILES("1", "1/3", "%s"), .over = {"k"}, .value = {{"0", "1/10", "1/3", "1/2", "1", "3/2", "2", "5"}}, .fewest = 1, .known = known_free, .literature = "k = 0"},
    {.name = "Nonholonomic Kaup-Kupershmidt, z' = k y x'", .format = NONHOLONOMIC_HENON_HEILES("16", "16/3", "%s"), .over = {"k"}, .value = {{"0", "1/10", "1/3", "1/2", "1", "3/2", "2", "5"}}, .fewest = 1, .known = known_free, .literature = "k = 0"},
};

/* Why values are open, with how many. */
typedef struct {
    size_t count, number[most_reasons];
    char *text[most_reasons];
} reasons;

static void count_reason(reasons *all, const char *why)
{
    size_t i = 0;
    while (i < all->count && strcmp(all->text[i], why)) i++;
    if (i == most_reasons) return;
    if (i == all->count) all->text[all->count++] = strdup(why);
    all->number[i]++;
}

static double value_of(const char *text)
{
    double top = 0, bottom = 1;
    return sscanf(text, "%lf/%lf", &top, &bottom) > 0 ? top / bottom : NAN;
}

typedef struct {
    size_t found, excluded, open, wrong, news, missed;
    double seconds;
    reasons why;
} family_sums;

/* A cell: "2" integrals are found, "none else", "open"; with a ! where the literature says otherwise. */
static void cell(const family *f, const char *a, const char *b, family_sums *sum)
{
    char text[most_text];
    nh_error error = {0};
    snprintf(text, sizeof text, f->format, a, b ? b : ""); /* one value: the second is not read */
    nh_analysis *r = absence_of_text(text, &error);
    bool known = f->known && f->known(value_of(a), b ? value_of(b) : 0);
    if (!r) {
        printf(" - |");
        count_reason(&sum->why, error.what);
        sum->open++;
        return;
    }
    const nh_absence *x = r->absence;
    bool found = x->known > f->fewest, excluded = absence_bound(x) <= f->fewest, wrong = x->contradiction || (excluded && (known || found));
    printf(" %s%s%s |", found ? "found" : excluded ? (x->rational ? "none else (rational)" : "none else") : "open", wrong ? " WRONG" : "", found && !known ? " (new)" : known && !found ? " (known)" : "");
    fflush(stdout);
    sum->found += found;
    sum->excluded += excluded && !found;
    sum->open += !excluded && !found;
    sum->wrong += wrong;
    sum->news += found && !known;
    sum->missed += known && !found;
    sum->seconds += absence_seconds;
    char bound[64];
    snprintf(bound, sizeof bound, "at most %zu integrals, by a theorem", absence_bound(x));
    if (!excluded && !found) count_reason(&sum->why, x->obstacle ? x->obstacle : bound);
    nh_analysis_free(r);
}

static size_t put_family(const family *f)
{
    family_sums sum = {0};
    size_t columns = 0;
    printf("\n### %s\n\nKnown integrable: %s.\n\n", f->name, f->literature);
    while (f->value[1][columns]) columns++;
    if (columns) printf("| %s, %s |", f->over[0], f->over[1]);
    else printf("| %s |", f->over[0]);
    for (size_t k = 0; k < (columns ? columns : 1); k++) printf(" %s |", columns ? f->value[1][k] : "other integrals");
    printf("\n|---|");
    for (size_t k = 0; k < (columns ? columns : 1); k++) printf("---|");
    puts("");
    for (size_t i = 0; f->value[0][i]; i++) {
        printf("| **%s** |", f->value[0][i]);
        for (size_t k = 0; k < (columns ? columns : 1); k++) cell(f, f->value[0][i], columns ? f->value[1][k] : NULL, &sum);
        puts("");
    }
    printf("\nFound: %zu, of which %zu are not in the literature above; excluded: %zu; open: %zu; known and not found: %zu; wrong: %zu; %.1f s.\n", sum.found, sum.news, sum.excluded, sum.open, sum.missed, sum.wrong,
           sum.seconds);
    for (size_t k = 0; k < sum.why.count; k++) {
        printf("%s%zu open: %s.\n", k ? "" : "\n", sum.why.number[k], sum.why.text[k]);
        free(sum.why.text[k]);
    }
    return sum.wrong;
}

/* ---- the catalogue ---- */

static size_t catalogue(const char *folder)
{
    char *name[most_files];
    size_t n = list(folder, name), wrong = 0;
    puts("| system | other integrals | known | at most | motions | reason | s |\n|---|---|---|---|---|---|---|");
    for (size_t i = 0; i < n; i++) {
        char path[SCRATCH];
        nh_error error = {0};
        snprintf(path, sizeof path, "%s/%s.yaml", folder, name[i]);
        nh_analysis *r = absence_of_file(path, &error);
        if (r) {
            const nh_absence *a = r->absence;
            const nh_absence_attempt *t = absence_shown(a);
            bool good = !a->contradiction && absence_bound(a) >= absence_count(r);
            printf("| %s | %s%s | %zu |", name[i], absence_word(a), good ? "" : " WRONG", a->known);
            if (absence_bound(a) == SIZE_MAX) printf(" - |");
            else printf(" %zu |", absence_bound(a));
            printf(" %s | %s | %.2f |\n", t && t->equation ? t->equation->plane->words : "-", a->obstacle ? a->obstacle : "", absence_seconds);
            fflush(stdout);
            wrong += !good;
        } else printf("| %s | no analysis: %s | | | | | |\n", name[i], error.what);
        nh_analysis_free(r);
        free(name[i]);
    }
    printf("\n%zu systems; integrals that exist and are excluded: %zu.\n", n, wrong);
    return wrong;
}

int main(int argc, char **argv)
{
    if (argc < 2) return fprintf(stderr, "usage: bench_absence FOLDER [table|families|catalogue|monodromy]\n"), 2;
    const char *only = argc > 2 ? argv[2] : NULL;
    size_t wrong = 0;
    if (!only || !strcmp(only, "table")) puts("## Systems of the literature\n"), wrong += table();
    if (!only || !strcmp(only, "families")) {
        puts("\n## Families, from both sides");
        for (size_t i = 0; i < sizeof FAMILIES / sizeof *FAMILIES; i++) wrong += put_family(&FAMILIES[i]);
    }
    if (!only || !strcmp(only, "monodromy")) {
        puts("\n## Monodromy by numbers\n\n`tests/numerical_monodromy.py` shares no code with the program: it follows the full variational equations, with multipliers, in complex time around loops of the curve. "
             "The trace of the commutator of two squares is 2 where the identity component of the group is solvable.\n");
        fflush(stdout);
        wrong += system("/usr/bin/python3 tests/numerical_monodromy.py") != 0;
    }
    if (!only || !strcmp(only, "catalogue")) puts("\n## The catalogue\n"), wrong += catalogue(argv[1]);
    printf("\nNot as expected: %zu.\n", wrong);
    return wrong > 0;
}

/* group_same: the symmetry group of the shipped systems is the same for other seeds and in other coordinates, and gone when a term without symmetry is added. */
#include "reduced.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "graph/dag.h"
#include "graph/function.h"
#include "reduction/group.h"
#include "rewrite.h"
#include "sweep.h"

/* What does not depend on the choice of coordinates or generators. */
typedef struct {
    size_t dimension, closed, orbit, centre, radical, derived[NH_MOST_SERIES], lower[NH_MOST_SERIES], isometries;
    char name[80];     /* circles are told from lines */
    char algebra[80];
    double c[512];     /* constants of the closed forms, where they fit */
} identity;

static identity identity_of(nh_system *s, uint64_t seed)
{
    nh_error error = {0};
    nh_options options;
    nh_options_default(&options);
    options.seed = (double)seed;
    identity out = {0};
    char *name = nh_strdup(s ? s->name : "?");
    reducible x = reducible_make(s, seed, &error);
    nh_group *g = nh_group_find(x.kinetic, &options, &error);
    must(g != NULL, &error, name);
    const nh_algebra_report *p = &g->report;
    nh_text text;
    nh_text_init(&text);
    nh_algebra_name(p, NULL, &text);
    out.dimension = g->action.d + g->missing;
    out.closed = g->action.d;
    out.orbit = g->jets ? g->jets->orbit : g->action.orbit;
    out.isometries = g->jets ? g->jets->of_metric : 0;
    out.centre = p->centre;
    out.radical = p->radical;
    memcpy(out.derived, p->derived, sizeof out.derived);
    memcpy(out.lower, p->lower, sizeof out.lower);
    snprintf(out.name, sizeof out.name, "%s", g->name);
    snprintf(out.algebra, sizeof out.algebra, "%s", nh_text_string(&text));
    size_t d = g->action.d;
    if (d * d * d <= sizeof out.c / sizeof *out.c) memcpy(out.c, g->action.algebra.c, d * d * d * sizeof *out.c);
    nh_text_clear(&text);
    nh_group_free(g);
    reducible_clear(&x);
    nh_free(name);
    return out;
}

static nh_system *read_shipped(const char *name)
{
    char path[300];
    nh_error error = {0};
    snprintf(path, sizeof path, "systems/%s.yaml", name);
    nh_system *s = nh_system_read(path, 0, NULL, &error);
    must(s != NULL, &error, name);
    return s;
}


/* The same system in other words, read again. */
static nh_system *again(const nh_system *y, const rewriting *how)
{
    nh_error error = {0};
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    rewrite_system(y, how, out);
    fclose(out);
    nh_system *s = nh_system_parse("again.yaml", text, 0, NULL, &error);
    must(s != NULL, &error, y->name);
    free(text);
    return s;
}

static void same_algebra(const char *name, const char *what, const identity *a, const identity *b)
{
    cr_expect_eq(b->dimension, a->dimension, "%s, %s: dimension %zu, was %zu", name, what, b->dimension, a->dimension);
    cr_expect_eq(b->orbit, a->orbit, "%s, %s: orbits of dimension %zu, were %zu", name, what, b->orbit, a->orbit);
    cr_expect_eq(b->isometries, a->isometries, "%s, %s: %zu isometries, were %zu", name, what, b->isometries, a->isometries);
    cr_expect_str_eq(b->algebra, a->algebra, "%s, %s: %s, was %s", name, what, b->algebra, a->algebra);
    cr_expect(b->centre == a->centre && b->radical == a->radical && !memcmp(b->derived, a->derived, sizeof a->derived) && !memcmp(b->lower, a->lower, sizeof a->lower), "%s, %s: other series", name, what);
}

/* ---- over the catalogue ---- */

/* check: returns the dimension of the group. */
static void for_all(size_t (*check)(const char *name), size_t from)
{
    char *name[most_files];
    size_t n = list("systems", name), count = 0, symmetric = 0;
    cr_assert_gt(n, 60u);
    for (size_t i = 0; i < n; free(name[i++])) {
        if (!sweep_tries(i + from, 6, 24)) continue;
        clock_t begin = clock();
        symmetric += check(name[i]) > 0;
        count++;
        if (getenv("NHSYM_TEST_FIGURES")) printf("%-26s %.2f s\n", name[i], (double)(clock() - begin) / CLOCKS_PER_SEC);
    }
    cr_expect(symmetric > (sweep_whole() ? 50u : 0u), "only %zu systems, %zu with symmetry", count, symmetric);
}

static size_t other_seeds(const char *name)
{
    identity a = identity_of(read_shipped(name), 1);
    for (uint64_t seed = 2; seed <= 3; seed++) {
        identity b = identity_of(read_shipped(name), seed);
        same_algebra(name, "another seed", &a, &b);
        cr_expect_str_eq(b.name, a.name, "%s: %s, was %s", name, b.name, a.name);
        cr_expect_eq(b.closed, a.closed, "%s: %zu closed forms, were %zu", name, b.closed, a.closed);
        for (size_t i = 0; i < sizeof a.c / sizeof *a.c; i++) cr_expect_float_eq(b.c[i], a.c[i], 1e-12, "%s: a structure constant is %.17g, was %.17g", name, b.c[i], a.c[i]);
    }
    return a.dimension;
}

static size_t other_names(const char *name)
{
    nh_system *s = read_shipped(name);
    size_t n = s->coordinates, order[rewrite_most];
    for (size_t i = 0; i < n; i++) order[i] = n - 1 - i;
    nh_system *new = again(s, &(rewriting){.rename = true, .order = order, .no_dependents = true, .no_chart = true});
    identity a = identity_of(s, 1), b = identity_of(new, 1);
    same_algebra(name, "in another order", &a, &b);
    cr_expect_str_eq(b.name, a.name, "%s: %s, was %s", name, b.name, a.name);
    cr_expect_eq(b.closed, a.closed, "%s: %zu closed forms, were %zu", name, b.closed, a.closed);
    return a.dimension;
}

/* V = 1/100 (sum of sines of all coordinates, and of neighbours together) has no symmetry. */
static nh_ex generic_term(const nh_system *y)
{
    nh_dag *d = y->dag;
    nh_ex sum = nh_int(d, 0);
    for (size_t i = 0; i < y->coordinates; i++) {
        nh_ex q = y->coordinate[i].q, r = y->coordinate[(i + 1) % y->coordinates].q;
        nh_ex one = nh_call(d, NH_SIN, nh_add(d, nh_mul(d, nh_ratio(d, 13, 10), q), nh_ratio(d, (long)i + 1, 3)));
        nh_ex two = nh_call(d, NH_COS, nh_add(d, nh_mul(d, nh_ratio(d, 7, 10), q), nh_mul(d, nh_ratio(d, 11, 10 + (long)i), r)));
        sum = nh_add(d, sum, nh_mul(d, nh_ratio(d, 1, 100), nh_add(d, one, two)));
    }
    return sum;
}

static size_t perturbed(const char *name)
{
    nh_system *s = read_shipped(name);
    nh_system *new = again(s, &(rewriting){.extra = generic_term(s), .no_chart = true});
    identity a = identity_of(new, 1);
    cr_expect_eq(a.dimension, 0, "%s, perturbed: dimension %zu (%s)", name, a.dimension, a.name);
    return identity_of(s, 1).dimension;
}

Test(group_same, whatever_the_seed, WHOLE_ONLY) { for_all(other_seeds, 0); }
Test(group_same, whatever_the_coordinates_are_called_and_their_order) { for_all(other_names, 1); }
Test(group_same, none_where_a_term_without_symmetry_is_added) { for_all(perturbed, 2); }

/* ---- coordinates that are functions of others ---- */

/* q_s = new q_s + g(q_o)/5, g the sine of an angle, else a square; in all of the system. */
static nh_system *bent(const nh_system *y, size_t s, size_t o)
{
    rewriting how = {.no_chart = true, .no_dependents = true};
    rewriter w = rewriter_of(y, &how);
    nh_dag *d = y->dag;
    nh_ex q = y->coordinate[o].q, v = y->coordinate[o].v, fifth = nh_ratio(d, 1, 5);
    bool angle = y->coordinate[o].type == NH_ANGLE;
    nh_ex g = angle ? nh_call(d, NH_SIN, q) : nh_mul(d, q, q), slope = angle ? nh_call(d, NH_COS, q) : nh_mul(d, nh_int(d, 2), q);
    for (size_t i = 0; i < w.count; i++) { /* the symbols keep their names */
        if (w.from[i] == y->coordinate[s].q) w.to[i] = nh_add(d, w.to[i], nh_mul(d, fifth, g));
        if (w.from[i] == y->coordinate[s].v) w.to[i] = nh_add(d, w.to[i], nh_mul(d, fifth, nh_mul(d, slope, v)));
    }
    nh_error error = {0};
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    fputs("name: bent\n", out);
    write_coordinates(&w, out);
    write_equations(&w, out);
    write_domain(&w, out);
    fclose(out);
    nh_system *new = nh_system_parse("bent.yaml", text, 0, NULL, &error);
    must(new != NULL, &error, y->name);
    free(text);
    return new;
}

Test(group_same, in_coordinates_that_are_functions_of_others, WHOLE_ONLY)
{
    static const struct {
        const char *system;
        size_t s, o;
    } cases[] = {{"sleigh", 1, 0}, {"sleigh", 0, 1}, {"crane_lagrangian", 0, 3}, {"two_wheel_cart", 3, 2}, {"snakeboard", 4, 0}, {"kepler", 0, 1}, {"free_particle", 2, 0}, {"chaplygin_ball", 2, 0},
                 {"rolling_ball", 0, 1}, {"rolling_disk", 0, 2}, {"euler_disk", 1, 0}, {"veselova", 0, 1}, {"knife_edge", 1, 2}, {"vertical_disk", 0, 3}, {"heisenberg_particle", 2, 0}, {"torus_geodesic", 0, 1}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        if (!sweep_tries(i, 4, 8)) continue;
        nh_system *s = read_shipped(cases[i].system), *new = bent(s, cases[i].s, cases[i].o);
        identity a = identity_of(s, 1), b = identity_of(new, 1);
        cr_expect(a.dimension > 0);
        same_algebra(cases[i].system, "bent", &a, &b);
    }
}

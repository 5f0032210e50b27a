/* Formulas that are zero, or twice another one, without looking so: whatever is said modulo primes is the same with and without them, or nothing is said. */
#include <criterion/criterion.h>
#include <stdio.h>
#include <string.h>

#include "count/count.h"
#include "exact/generic_value.h"
#include "identities.h"
#include "mechanics.h"
#include "sweep.h"

enum { most_text = 2000, degree = 2 };

typedef enum { IN_POTENTIAL, IN_METRIC, IN_CONSTRAINT, IN_FORCE, IN_TIME, IN_PARAMETER, PLACES } where;

/* A system with the term Z, which couples what is separate without it. */
static void write_system(char *text, where place, const char *Z)
{
    static const char *const parts[PLACES] = {
        "lagrangian: (x'^2+y'^2)/2-x^4/4-y^4/3-(%s)*(3*x*y^2+x^3*y)\n",
        "lagrangian: (x'^2+(1+(%s)*x)*y'^2)/2-x^4/4-y^4/3\n",
        "lagrangian: (x'^2+y'^2+z'^2)/2-x^4/4\nconstraints: [\"z' = (1+(%s))*y*x'\"]\n",
        "lagrangian: (x'^2+y'^2)/2-x^4/4-y^4/3\nforces: [\"x = -(%s)*y\"]\n",
        "lagrangian: (x'^2+y'^2)/2-x^4/4-y^4/3-(%s)*(3*x*y^2+x^3*y)\n",
        "parameters: {a: 2}\nlagrangian: (x'^2+y'^2)/2-x^4/4-y^4/3-(%s)*(3*x*y^2+x^3*y)\n"};
    int n = snprintf(text, most_text, "name: zero\ncoordinates: [x, y%s]\ndomain: {x: [0.5, 1.5], y: [0.5, 1.5]}\n", place == IN_CONSTRAINT ? ", z" : "");
    snprintf(text + n, most_text - (size_t)n, parts[place], Z);
}

static nh_count count_of(where place, const char *Z)
{
    char text[most_text];
    write_system(text, place, Z);
    mechanics x = mechanics_of_text(text, NH_CHART_COORDINATES);
    nh_count_question q = {.degree = degree, .work = 2e8, .generic = place == IN_PARAMETER, .time = place == IN_TIME};
    nh_count c = nh_count_integrals(x.model, &q);
    mechanics_clear(&x);
    return c;
}

/* Is what is said of both the same, or nothing said of the first? */
static bool agree(const nh_count *a, const nh_count *b)
{
    if (a->obstacle || b->obstacle) return true;
    bool same = a->leaf == b->leaf;
    for (size_t d = 0; d < a->rows && d < b->rows && same; d++)
        same = !a->row[d].settled || !b->row[d].settled || a->row[d].bound == b->row[d].bound;
    return same;
}

static const char *letter_of(where place) { return place == IN_TIME ? "t" : place == IN_PARAMETER ? "a" : "x"; }

/* Zeros (seeds that are even), and sums that are not zero but twice their right side. */
Test(identities, counts_are_those_of_the_plain_system)
{
    size_t seeds = sweep_whole() ? 2000 : 36, counted = 0, refused = 0, wrong = 0;
    nh_count plain[PLACES];
    for (where p = 0; p < PLACES; p++) plain[p] = count_of(p, "0");
    for (size_t seed = 0; seed < seeds; seed++) {
        where place = (where)(seed % PLACES);
        identity z = identity_make(seed, letter_of(place));
        bool zero = seed / PLACES % 2 == 0;
        char Z[3 * identity_length], same[2 * identity_length];
        snprintf(Z, sizeof Z, "%s%s(%s)", z.left, zero ? "-" : "+", z.right);
        snprintf(same, sizeof same, "2*(%s)", z.right);
        nh_count here = count_of(place, Z), expected = zero ? plain[place] : count_of(place, same);
        bool good = agree(&here, &expected);
        refused += here.obstacle != NULL;
        counted += !here.obstacle && good;
        wrong += !good;
        if (getenv("SHOW_REFUSED") && here.obstacle) fprintf(stderr, "refused %d %s: %s\n", place, Z, here.obstacle);
        cr_expect(good, "seed %zu, place %d: %s: %zu of degree 2, but %zu", seed, place, Z, here.row[1].bound, expected.row[1].bound);
    }
    fprintf(stderr, "identities: %zu counted, %zu refused, %zu false\n", counted, refused, wrong);
    cr_expect(counted > refused, "%zu counted, %zu refused", counted, refused);
}

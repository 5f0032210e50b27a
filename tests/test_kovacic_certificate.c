/* kovacic: what is printed lets a program of its own, in another language, repeat the proof; and it sees false ones. */
#include "kovacic_equations.h"
#include "scratch.h"

#include <criterion/criterion.h>

#include "absence/kovacic_internal.h"

static nh_arena *arena;
static fmpz_poly_q_t r, map, pulled;

static void start(void)
{
    arena = nh_arena_create();
    fmpz_poly_q_init(r);
    fmpz_poly_q_init(map);
    fmpz_poly_q_init(pulled);
}

static void stop(void)
{
    fmpz_poly_q_clear(pulled);
    fmpz_poly_q_clear(map);
    fmpz_poly_q_clear(r);
    nh_arena_free(arena);
    flint_cleanup();
}

TestSuite(kovacic_certificate, .init = start, .fini = stop);

static nh_kovacic *decide(const fmpz_poly_q_t equation)
{
    return nh_kovacic_decide(arena, fmpz_poly_q_numref(equation), fmpz_poly_q_denref(equation));
}

/* What the program says, without the newline. */
static const char *checked(const nh_kovacic *kovacic)
{
    static char line[200];
    char path[SCRATCH], command[SCRATCH + 100];
    nh_json *object = nh_json_object();
    nh_kovacic_certificate(object, kovacic);
    char *text = nh_json_finish(object);
    cr_assert(scratch_text(path, text));
    nh_free(text);
    snprintf(command, sizeof command, "/usr/bin/python3 tests/check_certificate.py %s 2>&1", path);
    FILE *in = popen(command, "r");
    cr_assert_not_null(in);
    *line = 0;
    while (fgets(line, sizeof line, in)) {} /* the last line */
    int code = pclose(in);
    unlink(path);
    line[strcspn(line, "\n")] = 0;
    cr_expect_eq(!code, !strcmp(line, "SL(2)"), "%s", line);
    return line;
}

static bool no_python(void)
{
    bool none = system("/usr/bin/python3 -c '' >/dev/null 2>&1");
    if (none) cr_log_warn("skipped: there is no Python (Debian: python3)");
    return none;
}

static void expect_proof(const char *what)
{
    const nh_kovacic *k = decide(r);
    cr_expect_eq(k->group, NH_GROUP_SL2, "%s: %s", what, nh_kovacic_word(k->group));
    const char *said = checked(k);
    cr_expect_str_eq(said, "SL(2)", "%s: %s", what, said);
}

Test(kovacic_certificate, another_program_repeats_the_proofs)
{
    if (no_python()) return;
    henon_heiles(r, (ratio){1, 1}, (ratio){-1, 3}, (ratio){1, 7});
    expect_proof("Henon-Heiles");
    suslov(r, (ratio){3, 1}, (ratio){2, 1});
    expect_proof("Suslov");
    suslov(r, (ratio){8, 3}, (ratio){1, 1});
    expect_proof("Suslov 8/3");
    const ratio s[3] = {{1, 9}, {1, 4}, {4, 49}};
    hypergeometric(r, s);
    expect_proof("hypergeometric");
    put_text(map, "3  1 2 3/3  -1 1 1");
    pull_back(pulled, r, map);
    fmpz_poly_q_swap(r, pulled);
    expect_proof("behind a map");
    const ratio t[3] = {{2, 1}, {3, 5}, {7, 1}};
    hypergeometric(r, t);
    expect_proof("exponents that are not rational");
    put_text(r, "3  -1 0 1/2  0 1");
    expect_proof("a simple pole");
}

Test(kovacic_certificate, another_program_repeats_those_with_irregular_points)
{
    if (no_python()) return;
    put_text(r, "2  0 1");
    expect_proof("Airy");
    put_text(r, "3  -4 0 3/1  12");
    expect_proof("Weber");
    put_text(r, "5  7 3 0 0 1/5  0 0 4 0 4"); /* poles 0, i, -i; infinity of order 0 */
    expect_proof("regular poles");
    put_text(r, "5  7 3 0 0 1/7  0 0 0 0 1 0 4"); /* 0 of order 4 */
    expect_proof("a pole of order 4");
    put_text(r, "6  7 3 0 0 1 1/6  0 0 0 0 0 1"); /* 0 of order 5, infinity of order 0 */
    expect_proof("a pole of order 5");
}

/* What is left out is looked for. */
Test(kovacic_certificate, degrees_and_forms_are_not_taken_on_trust)
{
    if (no_python()) return;
    put_text(r, "1  2/3  0 0 1"); /* x^2 */
    nh_kovacic *k = decide(r);
    k->degrees = 0;
    for (size_t i = 0; i < NH_KOVACIC_INVARIANTS; i++) k->invariant[i].possible = false;
    cr_expect_str_eq(checked(k), "Riccati's equation has a solution", "%s", checked(k));
    const ratio dihedral[3] = {{1, 4}, {1, 4}, {1, 9}};
    hypergeometric(r, dihedral);
    k = decide(r);
    cr_assert(k->invariant[0].possible && k->invariant[0].solutions > 0);
    k->invariant[0].degree--;
    cr_expect_str_eq(checked(k), "exponents of a form of degree 4", "%s", checked(k));
    k->invariant[0].possible = false;
    cr_expect_str_eq(checked(k), "forms of degree 4 are left out", "%s", checked(k));
}

Test(kovacic_certificate, false_ones_are_seen)
{
    if (no_python()) return;
    henon_heiles(r, (ratio){1, 1}, (ratio){-1, 3}, (ratio){1, 7});
    nh_kovacic *k = decide(r);
    k->root[1] += 2; /* + 1 may be the other root: 1/2 and -1/2 */
    cr_expect(strstr(checked(k), "a root at the pole"), "%s", checked(k));
    k->root[1] -= 2;
    k->pole[0]++;
    cr_expect_str_eq(checked(k), "not the poles");
    k->pole[0]--;
    k->prime++;
    cr_expect_str_eq(checked(k), "prime, or poles");
    k->prime--;
    cr_expect_str_eq(checked(k), "SL(2)");
    henon_heiles(r, (ratio){1, 1}, (ratio){2, 1}, (ratio){1, 7}); /* integrable */
    cr_expect_str_eq(checked(decide(r)), "a form of degree 4 is invariant");
    henon_heiles(r, (ratio){1, 1}, (ratio){1, 3}, (ratio){1, 7});
    cr_expect_str_eq(checked(decide(r)), "Riccati's equation has a solution");
    put_text(r, "5  0 3 0 0 1");
    k = decide(r);
    cr_expect_str_eq(checked(k), "SL(2)");
    k->root[0]++;
    cr_expect_str_eq(checked(k), "the root at infinity");
    put_text(r, "5  0 4 0 0 1"); /* x exp(x^3/3) */
    cr_expect_str_eq(checked(decide(r)), "Riccati's equation has a solution");
    put_text(r, "2  -3 16/3  0 0 16"); /* x^(1/4) exp(2 sqrt(x)) */
    cr_expect_str_eq(checked(decide(r)), "a form of degree 4 is invariant");
    const ratio s[3] = {{1, 9}, {1, 4}, {1, 25}};
    hypergeometric(r, s);
    cr_expect_str_eq(checked(decide(r)), "a form of degree 12 is invariant");
}

/* Poles 1 and 1 + p are one modulo p. */
Test(kovacic_certificate, poles_that_meet_modulo_the_prime_are_seen)
{
    if (no_python()) return;
    put_text(r, "1  1/2  -1 1");
    put_text(map, "1  2/2  -1073741828 1");
    fmpz_poly_q_mul(r, r, map);
    nh_kovacic *k = decide(r);
    cr_expect_eq(k->poles, 2);
    cr_expect_neq(k->prime, 1073741827);
    k->prime = 1073741827;
    k->poles = 1;
    k->pole[0] = 1;
    cr_expect_str_eq(checked(k), "r is not reduced, or poles meet modulo the prime");
}

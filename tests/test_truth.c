/* What a report says is true in every word: statements of a system file, searches that found nothing, conditions, digits. */
#include <criterion/criterion.h>
#include <math.h>

#include "base/json.h"
#include "program.h"
#include "sweep.h"

/* The JSON of `nhsym LINE --json a.json`, and what was printed. */
typedef struct {
    nh_json *json;
    char *text;
} told;

static told tell(const place *p, const char *line, int code)
{
    char all[2000];
    snprintf(all, sizeof all, "%s --json a.json", line);
    finished f = run_expecting(p, all, code);
    char *source = read_here(p, "a.json");
    told t = {source ? nh_json_parse(source) : NULL, f.out};
    cr_assert_not_null(t.json, "%s: no JSON\n%s", line, f.err);
    free(source);
    free(f.err);
    unfold(t.text);
    return t;
}

static void told_clear(told *t)
{
    nh_json_free(t->json);
    free(t->text);
}

/* ---- currents that the system file states ---- */

#define TWO_SPRINGS "coordinates: [x, y]\nparameters: {w: 1.3}\nlagrangian: (x'^2 + y'^2)/2 - w^2*(x^2 + y^2)/2\n"

static const struct {
    const char *as, *expr, *verdict;
    bool warns;
} statement[] = {
    {"currents", "x'*y' - w*x*y", "not conserved", true},
    {"currents", "x'*y' + w^2*x*y", "found", false},
    {"currents", "3*(x'^2 - y'^2 + w^2*(x^2 - y^2))", "found", false},
    {"currents", "(x*y' - y*x')^2", "found", false},
    {"currents", "(x*y' - y*x')/(x'^2 + w^2*x^2)", "found", false},
    {"currents", "sqrt(1 + (x'^2 + w^2*x^2)/3)", "found", false},
    {"currents", "exp(x*y' - y*x')", "found", false},
    {"currents", "atan2(w*x, x') - atan2(w*y, y')", "in a region", false},
    {"currents", "x'^2 + w^2*x^2 + 1e-80*x", "not conserved", true},
    {"currents", "x'^2 + 1.69*x^2", "found", false},
    {"currents", "x'^2 + 1.6900001*x^2", "not conserved", true},
    {"currents", "sin(x)^2 + cos(x)^2", "constant", true},
    {"currents", "sqrt(-1 - x^2)", "undecided", false},
    {"not_conserved", "x'", "not conserved", false},
    {"not_conserved", "x'^2 + w^2*x^2", "found", true},
};

/* (A false claim, and a true one in another form, were passed over in silence.) */
Test(truth, what_a_file_states_of_currents_is_judged)
{
    place p = place_make();
    for (size_t i = 0; i < sizeof statement / sizeof *statement; i++) {
        if (!sweep_tries(i + 1, 8, 15) && i) continue;
        char file[600];
        snprintf(file, sizeof file, TWO_SPRINGS "known: {%s: [{name: it, expr: \"%s\"}]}\n", statement[i].as, statement[i].expr);
        write_here(&p, "s.yaml", file);
        told t = tell(&p, "analyze -v s.yaml --html a.html --tex a.tex", 0);
        char *page = read_here(&p, "a.html"), *tex = read_here(&p, "a.tex");
        const nh_json *it = nh_json_entry(nh_json_get(t.json, "stated"), 0);
        const char *verdict = nh_json_text(it, "verdict");
        bool refuted = !strcmp(statement[i].verdict, "not conserved"), warned = strstr(t.text, "`it`") != NULL;
        cr_expect_str_eq(verdict, statement[i].verdict, "%s: %s", statement[i].expr, t.text);
        cr_expect_eq(warned, statement[i].warns, "%s: %s", statement[i].expr, t.text);
        cr_expect(strstr(t.text, statement[i].verdict) && strstr(page, statement[i].verdict) && strstr(tex, statement[i].verdict),
                  "%s: %s", statement[i].expr, t.text);
        cr_expect_eq(nh_json_get(nh_json_get(it, "state"), "x") != NULL, refuted, "%s: a state", statement[i].expr);
        if (refuted) cr_expect(nh_json_value(it, "rate") != 0, "%s", statement[i].expr);
        free(page);
        free(tex);
        told_clear(&t);
    }
    place_clear(&p);
}

/* ---- where a current jumps ---- */

#define CUT "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - 0.8*atan2(y, x) - "

static const struct {
    const char *system;
    double counted; /* currents of all motions */
    const char *region; /* of one in a part of the motions, or NULL */
} wall[] = {
    /* (the energy was "conserved, proved": six crossings of y = 0 near the domain have none of its jumps) */
    {CUT "x^2/2\ndomain: {x: [0.2, 1]}\n", 0, "on each side of y = 0"},
    {CUT "x^2/2\ndomain: {x: [0.9, 0.901], y: [0.1, 0.11]}\n", 0, "on each side of y = 0"},
    {CUT "x^2/2\ndomain: {x: [20, 21], y: [3, 4]}\n", 0, "on each side of y = 0"},
    {CUT "x^2/2\n", 0, "on each side of y = 0"},
    /* no motion gets from x > 0 to the cut */
    {CUT "1/x^2\ndomain: {x: [0.2, 1]}\n", 1, NULL},
    {CUT "log(x)\ndomain: {x: [0.2, 1]}\n", 1, NULL},
    /* the wall x = 0 matters beyond y = 3 only, or beyond another wall */
    {"coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - (1 + x/abs(x))*(abs(y - 3) + y - 3)^3\n", 0, "where the motion has an impulse"},
    {"coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - y - 3*asin(sin(x))\ndomain: {x: [-0.2, 0.2]}\n", 3, "in some parts"},
};

Test(truth, a_current_holds_wherever_motions_go)
{
    place p = place_make();
    for (size_t i = 0; i < sizeof wall / sizeof *wall; i++) {
        if (!sweep_tries(i + 1, 5, 8) && i) continue;
        write_here(&p, "s.yaml", wall[i].system);
        told t = tell(&p, "analyze s.yaml", 0);
        const nh_json *pieces = nh_json_get(t.json, "currents_in_regions");
        cr_expect_eq(nh_json_value(t.json, "independent_currents"), wall[i].counted, "%s%s", wall[i].system, t.text);
        const char *region = nh_json_text(nh_json_entry(pieces, 0), "region");
        const char *formulas = nh_json_text(nh_json_get(t.json, "explicit_motion"), "region");
        if (strstr(wall[i].system, "asin")) cr_expect(formulas, "a motion with constants of one part");
        cr_expect(wall[i].region ? region && strstr(region, wall[i].region) : !region, "%s%s", wall[i].system, t.text);
        told_clear(&t);
    }
    place_clear(&p);
}

/* L with |x - 1/n| + ... + |x - 1|: more walls than are kept.  (The walls beyond 40 were left out without a word.) */
Test(truth, walls_that_are_not_looked_at_are_told)
{
    static const char *const extra[] = {"", " + sign(x - 2)*y'"};
    place p = place_make();
    for (size_t many = 0; many < 2; many++)
        for (size_t k = 0; k < 2; k++) {
            char text[4000] = "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2";
            size_t n = many ? 45 : 30, at = strlen(text);
            for (size_t i = 1; i <= n; i++) at += (size_t)sprintf(text + at, " - 0.01*abs(x - %zu/%zu)", i, n);
            sprintf(text + at, "%s\n", extra[k]);
            write_here(&p, "s.yaml", text);
            told t = tell(&p, "analyze s.yaml", 0);
            const char *region = nh_json_text(nh_json_get(t.json, "completeness"), "region");
            cr_expect_eq(strstr(t.text, "each further wall") || strstr(t.text, "each wall"), many, "%s", t.text);
            /* a continuous energy passes through all kinks */
            cr_expect_eq(nh_json_value(t.json, "independent_currents") == 3, !k, "%s", t.text);
            cr_expect(!strstr(t.text, "x < 1 and"), "a wall that another one implies: %s", region ? region : "");
            told_clear(&t);
        }
    place_clear(&p);
}

/* ---- unknowns that were sought by trial ---- */

#define DRAG "name: drag\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\nforces:\n  - x = -(35/188*x' + 35/94*y')*x'\n" \
    "  - y = -(35/188*x' + 35/94*y')*y'\n"

/* (NONE, "search exhausted", although x' exp(35/188 x + 35/94 y) is conserved; "the ansatz is too large" of no columns.) */
Test(truth, trials_that_find_nothing_prove_nothing)
{
    static const char *const ansatz[] = {"exp(al*x + be*y)", "exp(al*x)*cosh(be*y)", "exp(al*x - be*y^2)", "(1 + x^2)^al*exp(be*y)"};
    static const double width[] = {40, 400, 4};
    place p = place_make();
    write_here(&p, "drag.yaml", DRAG);
    for (size_t i = 0; i < 4; i++)
        for (size_t k = 0; k < 3; k++) {
            char file[600];
            if (!sweep_tries(3 * i + k + 1, 4, 12) && i + k) continue;
            snprintf(file, sizeof file, "name: a\nsystem: drag.yaml\nansatz:\n  - product:\n      - terms: [\"x'\", \"y'\"]\n      - terms: [\"%s\"]\n"
                     "unknowns: {al: [-%g, %g], be: [-%g, %g]}\n", ansatz[i], width[k], width[k], width[k], width[k]);
            write_here(&p, "a.yaml", file);
            told t = tell(&p, "analyze --analysis a.yaml", 0);
            const nh_json *tried = nh_json_get(t.json, "tried");
            const char *verdict = nh_json_text(t.json, "verdict");
            cr_expect(strcmp(verdict, "NONE") != 0 && !strstr(t.text, "exhausted"), "%s%s", file, t.text);
            cr_expect(!strstr(t.text, "0 columns") && !strstr(t.text, "too large"), "%s", t.text);
            cr_expect(nh_json_value(tried, "evaluations") > 0 && nh_json_value(tried, "visited") > 0, "%s", t.text);
            cr_expect(strcmp(verdict, "FOUND") == 0 || strstr(t.text, "This proves nothing about other values."), "%s", t.text);
            if (i == 0 && k == 2) cr_expect_str_eq(verdict, "FOUND", "%s", t.text);
            told_clear(&t);
        }
    place_clear(&p);
}

/* ---- divisors of parameters ---- */

static const struct {
    const char *system;
    size_t divisors; /* of all currents together */
} divided[] = {
    {"coordinates: [x]\nparameters: {w: 1.3, W: 0.7}\nlagrangian: x'^2/2 - w^2*x^2/2 + x*cos(W*t)\n", 1},
    {"coordinates: [x]\nparameters: {w: 1.3}\nlagrangian: x'^2/2 - w^2*x^2/2 + x*cos(t)\n", 1},
    {"coordinates: [x]\nparameters: {m: 1.3, k: 0.7}\nlagrangian: m*x'^2/2 - k*x^2/2\n", 0},
};

/* ("For all parameter values", with 1/(w^2 - W^2) in the formula.) */
Test(truth, parameters_at_which_a_formula_has_a_pole_are_told)
{
    for (size_t i = 0; i < sizeof divided / sizeof *divided; i++) {
        place p = place_make();
        write_here(&p, "s.yaml", divided[i].system);
        told t = tell(&p, "analyze s.yaml", 0);
        const nh_json *currents = nh_json_get(t.json, "currents");
        size_t some = 0;
        for (size_t k = 0; k < nh_json_count(currents); k++) some += nh_json_count(nh_json_get(nh_json_entry(currents, k), "nonzero"));
        cr_expect(divided[i].divisors ? some > 0 : some == 0, "%s: %zu", divided[i].system, some);
        cr_expect((strstr(t.text, "!= 0") != NULL) == (divided[i].divisors > 0), "%s:\n%s", divided[i].system, t.text);
        told_clear(&t);
        place_clear(&p);
    }
}

/* ---- integrals at special values ---- */

/* (One more of degree 1 was counted at k = 0, and not shown: it is a function of the others.) */
Test(truth, what_is_more_at_a_special_value_is_shown)
{
    place p = place_make();
    write_here(&p, "s.yaml", "coordinates: [x, y, z]\nparameters: {k: 0.7}\nlagrangian: (x'^2 + y'^2 + z'^2)/2 - k*x^2/2 - y^2/2\n"
                             "constraints: [\"z' = y*x'\"]\n");
    told t = tell(&p, "classify s.yaml --over k --degree 2", 0);
    cr_expect(strstr(t.text, "x'*sqrt(y^2 + 1)"), "%s", t.text);
    told_clear(&t);
    place_clear(&p);
}

/* ---- quasi-velocities ---- */

/* (v and omega of the sleigh were defined nowhere.) */
Test(truth, quasi_velocities_are_defined)
{
    place p = place_make();
    told t = tell(&p, "analyze sleigh --tex a.tex --html a.html", 0);
    char *tex = read_here(&p, "a.tex"), *page = read_here(&p, "a.html");
    cr_expect(strstr(t.text, "phi' = omega") && strstr(t.text, "x' = ") && strstr(t.text, "y' = "), "%s", t.text);
    cr_expect(tex && strstr(tex, "Velocities") && page && strstr(page, "Velocities"));
    free(page);
    free(tex);
    told_clear(&t);
    place_clear(&p);
}

/* The first screen of an answer: on a terminal's 40 lines, in words that need no explanation, and with what the document says. */
#include <criterion/criterion.h>
#include <dirent.h>
#include <stdlib.h>
#include <string.h>

#include "base/json.h"
#include "program.h"
#include "sweep.h"

enum { most_lines = 40, most_columns = 80 };

/* Words that a second-year student of mechanics does not know. */
static const char *const jargon[] = {"canonical distribution", "projectable", "submanifold", "Phi1", "current", "residual", "[Gamma", "minus the energy", "spectrum"};

static void check_screen(const char *line, const char *text)
{
    size_t lines = 0;
    for (const char *at = text; *at; lines++) {
        size_t length = strcspn(at, "\n"), width = 0;
        for (size_t i = 0; i < length; i++) width += ((unsigned char)at[i] & 0xc0) != 0x80;
        cr_expect_leq(width, most_columns, "%s: %.*s", line, (int)length, at);
        cr_expect(length == 0 || at[length - 1] != ' ', "%s: a blank ends `%.*s`", line, (int)length, at);
        at += length + (at[length] == '\n');
    }
    cr_expect_leq(lines, most_lines, "%s: %zu lines\n%s", line, lines, text);
    for (size_t i = 0; i < sizeof jargon / sizeof *jargon; i++) {
        const char *warning = strstr(text, "Warning"), *word = strstr(text, jargon[i]);
        cr_expect(!word || (warning && word > warning), "%s: `%s` in\n%s", line, jargon[i], text);
    }
}

/* Sentences are folded. */
static void one_line(char *text)
{
    for (char *c = text; *c; c++)
        if (*c == '\n' && c[1] != '\n') *c = ' ';
}

/* ---- analyze ---- */

/* As many quantities as the JSON has, numbered; the sentence about them; whether there can be more. */
static void check_analysis(const place *p, const char *system)
{
    char line[300];
    snprintf(line, sizeof line, "analyze %s --option work=600 --until 1 --json a.json", system);
    finished f = run(p, line);
    cr_expect(f.code == 0 || f.code == 5, "%s: %d %s", line, f.code, f.err); /* 5: the limit of work */
    char *source = read_here(p, "a.json");
    nh_json *root = nh_json_parse(source);
    check_screen(line, f.out);
    size_t count = 0, independent = (size_t)nh_json_value(root, "independent_currents"), most = (size_t)nh_json_value(root, "local_maximum");
    while (nh_json_entry(nh_json_get(root, "currents"), count)) count++;
    char number[20], at_most[60];
    snprintf(number, sizeof number, "\n%zu ", count);
    snprintf(at_most, sizeof at_most, "At most %zu", most);
    if (count) cr_expect(strstr(f.out, number), "%s: quantity %zu is not in\n%s", system, count, f.out);
    if (count && independent == most) cr_expect(strstr(f.out, "that can exist"), "%s\n%s", system, f.out);
    else if (count) cr_expect(strstr(f.out, at_most), "%s: no `%s` in\n%s", system, at_most, f.out);
    cr_expect(strstr(f.out, "--details"), "%s", system);
    nh_json_free(root);
    free(source);
    finished_clear(&f);
}

Test(first_screen, every_system_has_one, .timeout = 600)
{
    place p = place_with_systems();
    char folder[600];
    snprintf(folder, sizeof folder, "%.500s/systems", p.project);
    struct dirent **entry;
    int n = scandir(folder, &entry, NULL, alphasort);
    cr_assert_gt(n, 0);
    for (int i = 0; i < n; i++) {
        char *dot = strstr(entry[i]->d_name, ".yaml");
        bool tried = dot && sweep_tries((size_t)i, 12, 40);
        if (tried) *dot = 0, check_analysis(&p, entry[i]->d_name);
        free(entry[i]);
    }
    free(entry);
    place_clear(&p);
}

Test(first_screen, quantities_are_told_in_the_words_of_mechanics)
{
    static const struct {
        const char *system, *says[6];
    } screens[] = {
        {"kepler", {"E = ", "Energy. From the symmetry in time.", "Angular momentum. From rotations in the plane of x and y.",
                    "All are proved for all m, k.", "At most 6 can exist"}},
        {"sleigh", {"All 5 conserved quantities", "1 to 4 are proved for all m, a, k; 5 for k = 2", "Follows from the others.",
                    "The constraint y' = x'*tan(phi) is nonholonomic.", "x' = v*cos(phi)"}},
        {"henon_heiles", {"Only the energy is conserved", "Nothing else is conserved among polynomials in the velocities up to degree 6", "y'' = y^2 - y - x^2"}},
        {"rolling_disk", {"3 independent conserved quantities were found. At most 8 can exist.\n 1  E"}}, /* of its motion some states only are known */
        {"lagrange_top", {"p_s = ", "Angular momentum conjugate to s. From turning s."}},
    };
    place p = place_with_systems();
    for (size_t i = 0; i < sizeof screens / sizeof *screens; i++) {
        char line[100];
        snprintf(line, sizeof line, "analyze %s", screens[i].system);
        finished f = run_expecting(&p, line, 0);
        check_screen(line, f.out);
        one_line(f.out);
        for (size_t k = 0; k < 6 && screens[i].says[k]; k++)
            cr_expect(strstr(f.out, screens[i].says[k]), "%s: no `%s` in\n%s", line, screens[i].says[k], f.out);
        finished_clear(&f);
    }
    place_clear(&p);
}

/* A formula has one colour; without a terminal there is none. */
Test(first_screen, formulas_are_coloured_on_a_terminal)
{
    if (!terminals_exist()) cr_skip_test("a bare chroot without /dev/pts has no terminals");
    place p = place_with_systems();
    finished pipe = run_expecting(&p, "analyze kepler", 0), terminal = run_so(&p, &(manner){.terminal = true}, "analyze kepler");
    cr_expect(!strchr(pipe.out, '\033'));
    cr_expect(strstr(terminal.out, "\033[36m1  E = "), "%s", terminal.out);
    finished_clear(&pipe);
    finished_clear(&terminal);
    place_clear(&p);
}

/* ---- reduce, simulate ---- */

Test(first_screen, of_a_reduction)
{
    place p = place_with_systems();
    finished f = run_expecting(&p, "reduce crane --until 1", 0);
    check_screen("reduce crane", f.out);
    one_line(f.out);
    cr_expect(strstr(f.out, "SE(2) x SO(2)^3") && strstr(f.out, "Left: psi1, phi1, psi3, phi2") && strstr(f.out, "no others"), "%s", f.out);
    cr_expect(strstr(f.out, "Put together again"), "%s", f.out);
    finished_clear(&f);
    place_clear(&p);
}

/* On a terminal a table of some rows and of the columns that fit; in a pipe all numbers. */
Test(first_screen, of_a_motion)
{
    if (!terminals_exist()) cr_skip_test("a bare chroot without /dev/pts has no terminals");
    place p = place_with_systems();
    const char *line = "simulate sleigh --initial omega=2 --until 5 --step 0.01";
    finished pipe = run_expecting(&p, line, 0), terminal = run_so(&p, &(manner){.terminal = true}, line);
    cr_expect(!strncmp(pipe.out, "t,phi,x,y,", 10), "%.80s", pipe.out);
    cr_expect(strstr(terminal.out, "t ") && strstr(terminal.out, "omega") && strstr(terminal.out, "32 of 501 rows"), "%s", terminal.out);
    cr_expect(strstr(terminal.out, "-13.22831921"), "the last row: %s", terminal.out);
    cr_expect(strstr(terminal.out, "--csv FILE"), "%s", terminal.out);
    finished_clear(&pipe);
    finished_clear(&terminal);
    place_clear(&p);
}

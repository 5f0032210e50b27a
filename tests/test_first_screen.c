/* The first screen of an answer: on a terminal's 40 lines, in words that need no explanation, and with what the document says. */
#include <criterion/criterion.h>
#include <dirent.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/json.h"
#include "program.h"
#include "sweep.h"

enum { most_lines = 40, most_columns = 80 };

/* Words that a second-year student of mechanics does not know. */
static const char *const jargon[] = {"canonical distribution", "projectable", "submanifold", "\nPhi", "(Phi", "current", "residual", "[Gamma", "minus the energy", "spectrum"};

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

Test(first_screen, every_system_has_one)
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
        {"kepler", {"E = ", "Energy: the size of the orbit. From the symmetry in time.", "4  m*(x*z' - z*x')    Angular momentum. From rotations about z, x and y.",
                    "Laplace-Runge-Lenz vector along z.", "further polynomials are conserved too, as functions of these (--details): Laplace-Runge-Lenz vector along y and x.",
                    "All are proved for all m, k."}},
        {"sleigh", {"All 5 conserved quantities", "Energy: how fast. From the symmetry in time.", "Which way it leaves.", "1 to 4 are proved for all m, a, k; 5 for k = 2", "Follows from the others.",
                    "2, 5, 6 change when an angle makes a full turn."}},
        {"henon_heiles", {"Only the energy is conserved", "Nothing else is conserved among polynomials in the velocities up to degree 6", "y'' = y^2 - y - x^2"}},
        {"rolling_disk", {"3 independent conserved quantities were found. At most 8 can exist.   m = 1.3"}}, /* of its motion some states only are known */
        {"isotropic_oscillator", {"Linear in the velocities. From time-dependent shifts of x, y and z."}},
        {"free_particle", {"Momentum conjugate to x and y. From shifting x and y.", "4  x - t*x'", "Motion of the centre of mass. From boosts along x, y and z."}},
        {"rotating_saddle", {"Jacobi's integral. From a symmetry that moves time, x and y."}},
        {"skate_on_belt", {"2  x' + y*th'", "Moving energy. From a symmetry that moves time and x."}},
        {"veselova", {"Component of the spatial angular momentum."}},
        {"chaplygin_ball", {"Angular momentum conjugate to p.", "Component of the spatial angular momentum."}},
        {"suslov_principal", {"Component of the angular momentum in the body."}},
        {"lagrange_top", {"p_s = ", "Angular momentum conjugate to s: spin about its own axis. From turning s."}},
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

/* A robot from a URDF file: bodies by name, the ground it stands on, and symmetries that cost no line in a full screen. */
Test(first_screen, of_robots)
{
    static const struct {
        const char *file, *options, *says[6];
    } screens[] = {
        {"arm_robot.urdf", "", {"mass: chassis 6, left_wheel 0.5", "Energy. From the symmetry in time.", "3 p_right = right'/500",
                                "conjugate to left and right. From turning left and right.", "6 p_turret = ", "--wheel left_wheel,right_wheel lets them roll"}},
    };
    place p = place_with_systems();
    for (size_t i = 0; i < sizeof screens / sizeof *screens; i++) {
        char line[900];
        snprintf(line, sizeof line, "analyze %.600s/tests/data/urdf/%s --option work=600 --until 1 %s", p.project, screens[i].file, screens[i].options);
        finished f = run(&p, line);
        cr_expect(f.code == 0 || f.code == 5, "%s: %d %s", line, f.code, f.err);
        check_screen(line, f.out);
        one_line(f.out);
        for (char *c = f.out; *c; c++)
            while (*c == ' ' && c[1] == ' ') memmove(c, c + 1, strlen(c));
        for (size_t k = 0; k < 6 && screens[i].says[k]; k++) cr_expect(strstr(f.out, screens[i].says[k]), "%s: no `%s` in\n%s", line, screens[i].says[k], f.out);
        finished_clear(&f);
    }
    place_clear(&p);
}

/* E is T + V in place of a long formula only where algebra says so: T of degree 2 in the velocities, V free of them. */
Test(first_screen, a_long_energy_by_the_names_of_the_file)
{
#define LONG "x^2/(1 + x^2 + y^4) + y^2/(2 + x^2*y^2) + sqrt(1 + x^2*y^4)*exp(-x^2 - y^2) + sin(x)^2*cos(y + x^2)/(3 + sin(x*y)) + x^4*y^6/(5 + x^2 + y^2 + sqrt(1 + x^2)) + log(1 + x^4 + y^6)*sqrt(7 + y^2)"
#define MORE " + exp(-x^4*y^2)*cos(x*y + 3)/(11 + x^6) + y^8/(13 + x^2*y^2 + sqrt(2 + y^2)) + sin(x - y)^3*exp(-y^2)/(17 + cos(x)^2*y^2)"
    static const struct {
        const char *kinetic, *potential, *name;
        bool sum;
    } cases[] = {
        {"(x'^2 + y'^2)/2", LONG MORE, "V", true},
        {"(x'^2 + y'^2)/2", LONG MORE, "U", true},
        {"(x'^2 + y'^2)/2 + x'^4/4", LONG MORE, "V", false},
        {"(x'^2 + y'^2)/2", LONG MORE " - y*x' + x^2*y'", "V", false},
    };
    place p = place_with_systems();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[2000], sum[40];
        snprintf(text, sizeof text, "coordinates: [x, y]\nT: %s\n%s: %s\n", cases[i].kinetic, cases[i].name, cases[i].potential);
        write_here(&p, "energy.yaml", text);
        finished f = run(&p, "analyze energy.yaml --option work=60 --until 1");
        cr_expect(f.code == 0 || f.code == 5, "%s: %d %s", text, f.code, f.err);
        snprintf(sum, sizeof sum, "1  E = T + %s\n", cases[i].name);
        cr_expect(strstr(f.out, cases[i].sum ? sum : "1  E = a formula of "), "%s%s", text, f.out);
        finished_clear(&f);
    }
    place_clear(&p);
#undef LONG
#undef MORE
}

/* ---- names and symmetries, decided by algebra ---- */

/* From which symmetry a quantity comes: a shift, a turn, a rotation, a boost, a scaling, time, several coordinates. */
Test(first_screen, symmetries_have_their_names)
{
    static const struct {
        const char *coordinates, *lagrangian, *current, *says;
    } tried[] = {
        {"[x: length, y: length]", "(x'^2 + y'^2)/2 - 9*y", "x'", "from shifting x."},
        {"[x: length, {p: angle}]", "(x'^2 + x^2*p'^2)/2 - x^4", "x^2*p'", "from turning p."},
        {"[x: length, y: length]", "(x'^2 + y'^2)/2 - (x^2 + y^2)^2", "x*y'-y*x'", "from rotations in the plane of x and y."},
        {"[x: length, y: length, z: length]", "(x'^2 + y'^2 + z'^2)/2 - (x^2 + z^2)^2 - y", "z*x'-x*z'", "from rotations about y."},
        {"[x: length, y: length]", "(x'^2 + y'^2)/2 - y^4", "t*x'-x", "from boosts along x."},
        {"[x: length, y: length]", "(x'^2 + y'^2)/2 - 1/(x^2 + y^2)", "t*(x'^2+y'^2+2/(x^2+y^2))-x*x'-y*y'", "from a scaling of time, x and y."},
        {"[x: length, y: length]", "x'*y' - x*y", "x*y'-y*x'", "from a scaling of x and y."},
        {"[x: length, y: length]", "(x'^2 + y'^2)/2 - x^2/2 - y^4", "x'*cos(t)+x*sin(t)", "from time-dependent shifts of x."},
        {"[x: length, y: length]", "(x'^2 + y'^2)/2 - (x - y)^4", "x'+y'", "from a joint shift of x and y."},
        {"[x: length, y: length]", "(x'^2 + y'^2)/2 - x^4*y^2", "(x'^2+y'^2)/2+x^4*y^2", "from the symmetry in time."},
        {"[x: length, y: length]", "(x'^2 + y'^2)/2 - x^4 - y^4", "x'^2/2+x^4", "from a symmetry that involves the velocities."},
    };
    place p = place_make();
    for (size_t i = 0; i < sizeof tried / sizeof *tried; i++) {
        char file[500], line[300];
        snprintf(file, sizeof file, "name: a\ncoordinates: %s\nlagrangian: \"%s\"\ndomain: {x: [1, 2]}\n", tried[i].coordinates, tried[i].lagrangian);
        write_here(&p, "a.yaml", file);
        snprintf(line, sizeof line, "verify a.yaml --current %s", tried[i].current);
        finished f = run_expecting(&p, line, 0);
        check_screen(line, f.out);
        one_line(f.out);
        cr_expect(strstr(f.out, "Yes. This is conserved: proved") && strstr(f.out, tried[i].says), "%s: no `%s` in\n%s", tried[i].lagrangian, tried[i].says, f.out);
        finished_clear(&f);
    }
    place_clear(&p);
}

/* A component of the Laplace-Runge-Lenz vector is one only for the potential 1/r, whatever the letters are. */
Test(first_screen, forms_have_their_names)
{
    static const struct {
        const char *lagrangian, *says, *never;
    } tried[] = {
        {"3*(u'^2 + w'^2)/2 + q/sqrt(u^2 + w^2)", "Laplace-Runge-Lenz vector along", "Fradkin"},
        {"3*(u'^2 + w'^2)/2 + q/sqrt(u^2 + w^2) - 1/u^2", "Quadratic in the velocities.", "Laplace"},
        {"(u'^2 + w'^2)/2 - q*(u^2 + w^2 + 2*u^2*w + 2*w^3/3)/2", "1  E = ", "Fradkin"},
    };
    place p = place_make();
    for (size_t i = 0; i < sizeof tried / sizeof *tried; i++) {
        char file[500];
        snprintf(file, sizeof file, "name: a\nparameters: {q: 0.8}\ncoordinates: [u: length, w: length]\nlagrangian: \"%s\"\ndomain: {u: [1, 2], w: [-1, 1]}\n", tried[i].lagrangian);
        write_here(&p, "a.yaml", file);
        finished f = run_expecting(&p, "analyze a.yaml", 0);
        check_screen("analyze", f.out);
        one_line(f.out);
        cr_expect(strstr(f.out, tried[i].says), "%s: no `%s` in\n%s", tried[i].lagrangian, tried[i].says, f.out);
        cr_expect(!strstr(f.out, tried[i].never), "%s\n%s", tried[i].lagrangian, f.out);
        finished_clear(&f);
    }
    place_clear(&p);
}

/* Names come from definitions: Euler's angles about z, y and z with other letters and in another order; and what looks
 * like a moving energy without a constraint that moves. */
Test(first_screen, names_do_not_depend_on_letters)
{
    static const struct {
        const char *rest, *says, *never;
    } tried[] = {
        {"coordinates: [c: angle, a: angle, b: angle]\n"
         "lagrangian: (1.1*(b'*sin(c) - a'*sin(b)*cos(c))^2 + 1.7*(b'*cos(c) + a'*sin(b)*sin(c))^2 + 2.3*(a'*cos(b) + c')^2)/2\ndomain: {b: [0.6, 1.4]}\n",
         "Component of the spatial angular momentum.", "in the body"},
        {"coordinates: [u: length, w: length]\nlagrangian: (u'^2 + w'^2)/2 - ((u^2 - w^2)*cos(2*t) + 2*u*w*sin(2*t))/5\n", "Jacobi's integral.", "Moving energy"},
        {"coordinates: [u: length, w: length]\nlagrangian: (u'^2 + w'^2)/2 - u^4 - 3*w^4\n", "Energy.", "Jacobi"},
    };
    place p = place_make();
    for (size_t i = 0; i < sizeof tried / sizeof *tried; i++) {
        char file[800];
        snprintf(file, sizeof file, "name: a\n%s", tried[i].rest);
        write_here(&p, "a.yaml", file);
        finished f = run_expecting(&p, "analyze a.yaml", 0);
        check_screen("analyze", f.out);
        one_line(f.out);
        cr_expect(strstr(f.out, tried[i].says), "no `%s` in\n%s", tried[i].says, f.out);
        cr_expect(!strstr(f.out, tried[i].never), "`%s` in\n%s", tried[i].never, f.out);
        finished_clear(&f);
    }
    place_clear(&p);
}

/* The rate at the state of the example is the value of the rate in general. */
Test(first_screen, the_rate_of_what_is_not_conserved)
{
    place p = place_with_systems();
    finished f = run_expecting(&p, "verify sleigh --current omega", 1);
    check_screen("verify", f.out);
    one_line(f.out);
    double omega = NAN, v = NAN, rate = NAN;
    const char *at = strstr(f.out, "omega = "), *other = strstr(f.out, ", v = "), *there = strstr(f.out, "its rate there is ");
    cr_assert(at && other && there, "%s", f.out);
    sscanf(at, "omega = %lf", &omega);
    sscanf(other, ", v = %lf", &v);
    sscanf(there, "its rate there is %lf", &rate);
    cr_expect(strstr(f.out, "rate = -omega*v/(a*k^2)"), "%s", f.out);
    cr_expect(fabs(rate + omega*v/4) <= 2e-4*fabs(rate) && rate != 0, "%g %g %g", omega, v, rate);
    finished_clear(&f);
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

/* ---- classify, benchmark, linearize, scan ---- */

/* The first screen and the JSON of the same run: the screen is checked for its size and words, and returned in one line
 * for each paragraph. */
static finished screen_with_json(const place *p, const char *line, nh_json **root)
{
    char all[600];
    snprintf(all, sizeof all, "%.500s --json screen.json", line);
    finished f = run_expecting(p, all, 0);
    char *source = read_here(p, "screen.json");
    *root = nh_json_parse(source);
    free(source);
    check_screen(line, f.out);
    cr_expect(strstr(f.out, "\nMore: --details"), "%s\n%s", line, f.out);
    one_line(f.out);
    return f;
}

/* Each special place stands on the screen, and as many values as the headline says; where the JSON says that nothing else is
 * special, the screen says that this is proved. */
Test(first_screen, of_a_classification)
{
    static const char *const families[] = {"henon_heiles.yaml --over eps", "henon_heiles.yaml --over B,eps --degree 2", "contact.yaml --over b",
                                           "suslov.yaml --over D --of measure", "knife.yaml --over b --degree 1", "sleigh.yaml --over a --degree 1",
                                           "henon_heiles.yaml --over A,B,eps --degree 2 --option planes=1", "cubic.yaml --over c --degree 2"};
    place p = place_make();
    for (size_t i = 0; i < sizeof families / sizeof *families; i++) {
        char line[400], number[40];
        if (!sweep_tries(i, 2, 3)) continue;
        snprintf(line, sizeof line, "classify %.200s/tests/data/classify/%.100s", p.project, families[i]);
        nh_json *root;
        finished f = screen_with_json(&p, line, &root);
        const nh_json *special = nh_json_get(root, "special"), *over = nh_json_get(root, "over");
        size_t n = nh_json_count(special);
        snprintf(number, sizeof number, "%zu value", n);
        if (nh_json_count(over) == 1) cr_expect(strstr(f.out, n ? number : "No value of "), "%s: %zu\n%s", line, n, f.out);
        for (size_t k = 0; k < n; k++) {
            const nh_json *where = nh_json_get(nh_json_entry(special, k), "where");
            const char *name[3], *one = nh_json_text(nh_json_entry(special, k), "where");
            size_t names = one ? 0 : nh_json_names(where, 3, name);
            if (one) cr_expect(strstr(f.out, one), "%s: no `%s` in\n%s", line, one, f.out);
            for (size_t j = 0; j < names; j++) cr_expect(strstr(f.out, nh_json_text(where, name[j])), "%s: no `%s` in\n%s", line, nh_json_text(where, name[j]), f.out);
        }
        if (nh_json_is_true(root, "nowhere_else")) cr_expect(strstr(f.out, "proved"), "%s\n%s", line, f.out);
        if (nh_json_count(nh_json_get(root, "currents")) && strstr(line, "henon")) cr_expect(strstr(f.out, "  E = "), "the energy has its sign: %s", f.out);
        nh_json_free(root);
        finished_clear(&f);
    }
    place_clear(&p);
}

/* The eigenvalues, conjugate ones in one line; and the place where the stability changes. */
Test(first_screen, of_linear_equations)
{
    static const char *const lines[] = {"linearize whipple_bicycle --at x'=5", "linearize pendulum --at theta=pi", "linearize sleigh --at v=1", "linearize double_pendulum"};
    place p = place_with_systems();
    nh_json *root;
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        finished f = screen_with_json(&p, lines[i], &root);
        const nh_json *list = nh_json_get(root, "eigenvalues");
        cr_expect_gt(nh_json_count(list), 0);
        for (size_t k = 0; k < nh_json_count(list); k++) {
            const nh_json *z = nh_json_entry(list, k);
            double re = nh_json_value(z, "re"), im = nh_json_value(z, "im");
            char text[100];
            snprintf(text, sizeof text, im == 0 ? "  %.10g " : "  %.10g +- %.10g i ", re, fabs(im));
            cr_expect(strstr(f.out, text), "%s: no `%s` in\n%s", lines[i], text, f.out);
        }
        nh_json_free(root);
        finished_clear(&f);
    }
    finished f = screen_with_json(&p, "linearize whipple_bicycle --over x'=4,5,13/2", &root);
    cr_expect(strstr(f.out, "changes at 2 values of x' between 4 and 13/2."), "%s", f.out);
    cr_expect(strstr(f.out, "x' = 4.292382536: unstable below, stable but for 0 above") && strstr(f.out, "x' = 6.024262015: "), "%s", f.out);
    nh_json_free(root);
    finished_clear(&f);
    place_clear(&p);
}

/* For each accuracy the fastest run, and all runs by what happened to them. */
Test(first_screen, of_a_benchmark)
{
    place p = place_with_systems();
    nh_json *root;
    finished f = screen_with_json(&p, "benchmark pendulum --until 1 --budget 300ms", &root);
    const nh_json *list = nh_json_get(root, "motion"), *goals = nh_json_get(root, "goals");
    char text[100];
    snprintf(text, sizeof text, "%zu runs: ", nh_json_count(list));
    cr_expect(strstr(f.out, text), "no `%s` in\n%s", text, f.out);
    for (size_t i = 0; i < nh_json_count(goals); i++) {
        const nh_json *best = NULL;
        for (size_t k = 0; k < nh_json_count(list); k++) {
            const nh_json *m = nh_json_entry(list, k);
            if (strcmp(nh_json_text(m, "status"), "right") || nh_json_is_true(m, "reduced") || !(nh_json_value(m, "error") <= nh_json_number_at(goals, i))) continue;
            if (!best || nh_json_value(m, "seconds") < nh_json_value(best, "seconds")) best = m;
        }
        if (!best) continue;
        snprintf(text, sizeof text, "%-13.0e%.29s", nh_json_number_at(goals, i), nh_json_text(best, "method"));
        cr_expect(strstr(f.out, text), "no `%s` in\n%s", text, f.out);
    }
    nh_json_free(root);
    finished_clear(&f);
    place_clear(&p);
}

Test(first_screen, of_a_scan)
{
    place p = place_make();
    write_here(&p, "a.yaml", "name: a\nparameters: {k: 0.2}\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - (x^2 + y^2)/2 - x^2*y - 2/3*sin(k)*y^3\n");
    finished f = run_expecting(&p, "scan a.yaml --over k=0.1:1.4:8 --degree 2 -o out", 0);
    check_screen("scan", f.out);
    one_line(f.out);
    char *source = read_here(&p, "out/scan.json"), text[100];
    nh_json *root = nh_json_parse(source);
    const nh_json *special = nh_json_get(root, "special");
    cr_assert_eq(nh_json_count(special), 1);
    snprintf(text, sizeof text, "k = %s = ", nh_json_text(nh_json_get(nh_json_entry(special, 0), "at"), "k"));
    cr_expect(strstr(f.out, "1 confirmed special value, 0 not confirmed, from 8 points.") && strstr(f.out, text), "no `%s` in\n%s", text, f.out);
    snprintf(text, sizeof text, "with 1): %g at 8 points", nh_json_value(nh_json_entry(nh_json_get(root, "points"), 0), "dimension"));
    cr_expect(strstr(f.out, text), "no `%s` in\n%s", text, f.out);
    nh_json_free(root);
    free(source);
    finished_clear(&f);
    place_clear(&p);
}

/* ---- reduce, simulate ---- */

Test(first_screen, of_a_reduction)
{
    place p = place_with_systems();
    finished f = run_expecting(&p, "reduce crane --until 1", 0);
    check_screen("reduce crane", f.out);
    one_line(f.out);
    cr_expect(strstr(f.out, "SE(2) x SO(2)^3") && strstr(f.out, "Left: psi1, phi1, psi2, phi2") && strstr(f.out, "no others"), "%s", f.out);
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

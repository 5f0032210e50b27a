/* export_cli: `nhsym export` as a user types it: wrong words, inputs, files, and text that other programs read. */
#include "program.h"

#include <ctype.h>

#include "sweep.h"

static const char system_text[] =
    "name: driven\nparameters: [{name: m, value: 2}, {name: u, value: 0}, {name: w, value: 1}]\n"
    "coordinates: [{name: x, type: length}, {name: y, type: length}]\n"
    "lagrangian: m/2*(x'^2 + y'^2)\nforces: [\"x = u\", \"y = u*w\"]\n";

Test(export_cli, wrong_words)
{
    static const char *const cases[][3] = {
        {"export", "`nhsym export` needs a system", "hint: nhsym export sleigh --to c -o code"},
        {"export driven.yaml", "--to: no language is given",
         "hint: --to takes c, python, sympy, matlab, js, latex or json"},
        {"export driven.yaml --to pyhton", "--to: there is no language `pyhton`", "hint: did you mean `python`?"},
        {"export driven.yaml --to c --of equatoins", "--of: there is no part `equatoins`",
         "hint: did you mean `equations`?"},
        {"export driven.yaml --to c --of ,", "--of: no part is named", "hint: --of takes equations"},
        {"export driven.yaml --to c --input v", "--input: `v` is not a parameter of driven", ""},
        {"export driven.yaml --to c --input u,m", "--input: `m` occurs in the velocities' part of the Lagrangian",
         "hint: an input is a parameter of the forces or the potential"},
        {"export driven.yaml --to c --of equations --name 2nd", "--name: `2nd` is not a name for functions",
         "hint: a name is a letter"},
        {"export driven.yaml --to c --of equations --name a-b", "--name: `a-b` is not a name for functions",
         "hint: a name is a letter"},
        {"reduce driven.yaml --to cpp", "--to: there is no language `cpp`", ""}};
    place p = place_make();
    write_here(&p, "driven.yaml", system_text);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        finished f = run(&p, cases[i][0]);
        cr_expect_eq(f.code, 2, "%s: %d", cases[i][0], f.code);
        cr_expect_str_eq(f.out, "", "%s printed\n%s", cases[i][0], f.out);
        cr_expect(strstr(f.err, cases[i][1]) && strstr(f.err, cases[i][2]), "%s complained\n%s", cases[i][0], f.err);
        finished_clear(&f);
    }
    place_clear(&p);
}

Test(export_cli, inputs_and_parts)
{
    place p = place_make();
    write_here(&p, "driven.yaml", system_text);
    finished f = run_expecting(&p, "export driven.yaml --to c --of equations --input u", 0);
    cr_expect_not_null(strstr(f.out, "const double inputs[1], const driven_parameters *parameters"));
    cr_expect_not_null(strstr(f.out, "/* inputs: u */"));
    cr_expect_null(strstr(f.out, "double u;"), "an input is no parameter");
    cr_expect_null(strstr(f.out, "driven_momenta"), "only the wanted part");
    finished_clear(&f);
    write_here(&p, "marked.yaml", "include: driven.yaml\nparameters: [{name: u, value: 0, input: true}]\n");
    f = run_expecting(&p, "export marked.yaml --to c --of equations", 0); /* the file says it itself */
    cr_expect_not_null(strstr(f.out, "/* inputs: u */"), "%s", f.out);
    finished_clear(&f);
    f = run_expecting(&p, "export marked.yaml --to c --of equations --input w", 0);
    cr_expect_not_null(strstr(f.out, "/* inputs: u, w */"), "%s", f.out);
    finished_clear(&f);
    write_here(&p, "marked.yaml", "include: driven.yaml\nparameters: [{name: u, value: 0, input: yes}]\n");
    f = run_expecting(&p, "analyze marked.yaml", 3);
    cr_expect_not_null(strstr(f.err, "marked.yaml:2:41: `input` must be true or false, found `yes`"), "%s", f.err);
    finished_clear(&f);
    f = run_expecting(&p, "export driven.yaml --to json --of momenta,submanifold --input u,w", 0);
    cr_expect_not_null(strstr(f.out, "\"inputs\":\t[\"u\", \"w\"]"));
    cr_expect(strstr(f.out, "\"velocities_of_momenta\"") && strstr(f.out, "\"rates\"") &&
              !strstr(f.out, "\"accelerations\""));
    finished_clear(&f);
    place_clear(&p);
}

/* The same text every time, in files or not; a folder that cannot be; another name. */
Test(export_cli, files)
{
    place p = place_make();
    write_here(&p, "driven.yaml", system_text);
    finished one = run_expecting(&p, "export driven.yaml --to python --of equations", 0),
             two = run_expecting(&p, "export driven.yaml --to python --of equations -o code --threads 2", 0);
    char *file = read_here(&p, "code/driven.py");
    cr_assert_not_null(file);
    cr_expect_str_eq(one.out, file);
    cr_expect_not_null(strstr(two.out, "written: code/driven.py"));
    free(file);
    finished_clear(&one);
    finished_clear(&two);
    one = run_expecting(&p, "export driven.yaml --to c --of equations -o code --name plant --quiet", 0);
    cr_expect_str_eq(one.out, "");
    char *header = read_here(&p, "code/plant.h"), *source = read_here(&p, "code/plant.c");
    cr_expect(header && strstr(header, "int plant_accelerations(") && source && strstr(source, "#include \"plant.h\""));
    free(header);
    free(source);
    finished_clear(&one);
    one = run(&p, "export driven.yaml --to c --of equations -o no/code");
    cr_expect_eq(one.code, 4);
    cr_expect_not_null(strstr(one.err, "the folder could not be created"));
    finished_clear(&one);
    place_clear(&p);
}

/* With other parameters, or elsewhere, a current may not be conserved. */
Test(export_cli, where_currents_hold, PLAIN_ONLY)
{
    place p = place_with_systems();
    finished f = run_expecting(&p, "export sleigh --to c --of currents", 0);
    cr_expect_not_null(strstr(f.out, " * Phi1, minus the energy: proved for all m, a, k\n"));
    finished_clear(&f);
    write_here(&p, "mathieu.yaml", "name: mathieu\nparameters: [{name: a, value: 1.1}, {name: e, value: 0.4}]\n"
                                   "coordinates: [{name: x, type: length}]\nlagrangian: x'^2/2 - (a + e*cos(2*t))*x^2/2\n"
                                   "domain: {t: [0.1, 2]}\n");
    f = run_expecting(&p, "export mathieu.yaml --to c --of currents", 0);
    cr_expect_not_null(strstr(f.out, " for these parameter values only; a series, for 0."));
    finished_clear(&f);
    place_clear(&p);
}

/* ---- LaTeX ---- */

/* Braces and environments are closed in their order; no formula is left out. */
static void check_latex(const char *name, const char *text)
{
    char open[20][40];
    size_t depth = 0;
    long braces = 0;
    for (const char *c = text; *c; c++) {
        bool escaped = c > text && c[-1] == '\\' && !(c > text + 1 && c[-2] == '\\');
        if (*c == '%' && !escaped)
            c += strcspn(c, "\n") - 1;
        else if (*c == '{' && !escaped)
            braces++;
        else if (*c == '}' && !escaped)
            cr_assert_geq(--braces, 0, "%s: %.60s", name, c);
        bool begin = !strncmp(c, "\\begin{", 7), end = !strncmp(c, "\\end{", 5);
        if (!begin && !end) continue;
        char word[40];
        snprintf(word, sizeof word, "%.*s", (int)strcspn(c + (begin ? 7 : 5), "}"), c + (begin ? 7 : 5));
        cr_assert(begin ? depth < 20 : depth && !strcmp(open[depth - 1], word), "%s: \\end{%s}", name, word);
        if (begin)
            strcpy(open[depth++], word);
        else
            depth--;
    }
    cr_expect(braces == 0 && depth == 0, "%s: %ld braces, %zu environments are open", name, braces, depth);
    cr_expect_null(strstr(text, "too long"), "%s", name);
    cr_expect_null(strstr(text, " = }"), "%s: an empty formula", name);
    cr_expect_null(strstr(text, "&=  \\\\"), "%s: an empty formula", name);
}

Test(export_cli, latex)
{
    static const char *const names[] = {"sleigh --of equations,momenta,submanifold",
                                        "crane --of equations,submanifold,reduced", "car_trailers_3 --of submanifold",
                                        "constant_speed --of equations,submanifold",
                                        "chaplygin_ball --of submanifold,reduced"};
    place p = place_with_systems();
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        if (!sweep_tries(i, 1, 3)) continue;
        char line[200];
        snprintf(line, sizeof line, "export %s --to latex", names[i]);
        finished f = run_expecting(&p, line, 0);
        cr_expect(!strncmp(f.out, "% ", 2) && strstr(f.out, "\\end{document}"));
        check_latex(names[i], f.out);
        finished_clear(&f);
    }
    place_clear(&p);
}

static bool is_in(const place *p, const char *name, const char *begin, const char *word)
{
    char *text = read_here(p, name);
    bool good = text && !strncmp(text, begin, strlen(begin)) && strstr(text, word);
    free(text);
    return good;
}

/* --json and --tex mean what they mean elsewhere: beside a language, in place of one, and `-`. */
Test(export_cli, documents_beside_the_code)
{
    place p = place_make();
    write_here(&p, "driven.yaml", system_text);
    finished f = run_expecting(&p, "export driven.yaml --of equations --json a.json --tex a.tex", 0);
    cr_expect_str_eq(f.out, "");
    cr_expect(is_in(&p, "a.json", "{", "\"functions\"") && is_in(&p, "a.tex", "%", "\\documentclass"));
    finished_clear(&f);
    f = run_expecting(&p, "export driven.yaml --of equations --to c --json b.json", 0);
    cr_expect(strstr(f.out, "driven_accelerations") && is_in(&p, "b.json", "{", "\"accelerations\""));
    finished_clear(&f);
    f = run_expecting(&p, "export driven.yaml --of equations --to c --quiet --json -", 0);
    cr_expect(f.out[0] == '{' && !strstr(f.out, "#include"));
    finished_clear(&f);
    f = run_expecting(&p, "export driven.yaml --of equations --to python -o code --tex c.tex", 0);
    cr_expect(strstr(f.out, "written: code/driven.py") && is_in(&p, "code/driven.py", "\"\"\"", "import numpy") && is_in(&p, "c.tex", "%", "document"));
    finished_clear(&f);
    f = run_expecting(&p, "export driven.yaml --html a.html", 2);
    cr_expect(strstr(f.err, "does not take --html"));
    finished_clear(&f);
    place_clear(&p);
}

/* A constraint that is quadratic in the velocities has two branches, and code on the submanifold is on one of them. */
Test(export_cli, the_branch_is_said)
{
    static const char *const cases[][2] = {{"appell_hamel", "z' < 0"}, {"upper.yaml", "z' > 0"}};
    place p = place_make();
    write_here(&p, "upper.yaml", "name: upper\ncoordinates: [x, y, z]\ndomain: {z': [0, 1.5]}\nlagrangian: (x'^2 + y'^2 + z'^2)/2 - z\n"
                                 "constraints: [\"z'^2 = 0.3*(x'^2 + y'^2)\"]\n");
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char line[200], said[100];
        snprintf(line, sizeof line, "export %s --to c --of submanifold", cases[i][0]);
        finished f = run(&p, line);
        snprintf(said, sizeof said, "Velocities of all coordinates.  On the branch %s.", cases[i][1]);
        cr_expect(f.code == 0 && strstr(f.out, said), "%s: %s", line, f.out);
        snprintf(said, sizeof said, "submanifold are those of the branch %s; ", cases[i][1]);
        cr_expect(strstr(f.out, said) && strstr(f.out, "satisfy the constraints.  On the branch"), "%s", f.out);
        finished_clear(&f);
    }
    place_clear(&p);
}

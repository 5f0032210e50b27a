/* nhsym simulate: methods by name, initial states that nobody gives, names of columns, pictures, standard input and output. */
#include <criterion/criterion.h>
#include <math.h>

#include "motion/method.h"
#include "program.h"
#include "sweep.h"

/* A line of words in single quotes for a shell; the program is $N. */
static finished run_shell(const place *p, const char *line)
{
    char command[4096];
    snprintf(command, sizeof command, "N='%.400s'; %.3500s", p->program, line);
    return run_vector(p, &(manner){0}, (char *[]){"sh", "-c", command, NULL});
}

/* The last number of a table. */
static double last_number(const char *table)
{
    const char *comma = strrchr(table, ',');
    return comma ? strtod(comma + 1, NULL) : NAN;
}

static const char *const oscillator = "name: spring\nparameters: [{name: w, value: 2}]\ncoordinates: [x]\nlagrangian: (x'^2 - w^2*x^2)/2\n";

/* x = cos 2t at t = 3 by every method, as exactly as its order promises. */
Test(simulate, every_method_has_a_word, PLAIN_ONLY)
{
    place p = place_make();
    write_here(&p, "spring.yaml", oscillator);
    for (size_t i = 0; i < nh_method_count(); i++) {
        const nh_method *method = nh_method_at(i);
        char line[300];
        snprintf(line, sizeof line, "$N simulate spring.yaml --initial 'x=1' --until 3 --step 0.1 --watch x --tolerance 1e-9 --method %s --option fixed_steps=20", method->word);
        finished f = run_shell(&p, line);
        double error = fabs(last_number(f.out) - cos(6)), allowed = method->order == 0 ? 1e-6 : method->order == 2 ? 1e-3 : 1e-6;
        cr_expect(f.code == 0 && error < allowed && error > 0, "%s: exit code %d, error %g\n%s", method->word, f.code, error, f.err);
        finished_clear(&f);
        snprintf(line, sizeof line, "$N simulate spring.yaml --initial 'x=1' --until 3 --json - --method %s", method->word);
        f = run_shell(&p, line);
        cr_expect(strstr(f.out, method->name), "%s is not reported as %s", method->word, method->name);
        finished_clear(&f);
    }
    place_clear(&p);
}

Test(simulate, methods_that_cannot_be_used)
{
    static const struct {
        const char *line, *words;
        int code;
    } cases[] = {
        {"simulate sleigh --initial omega=1 --method rk8pb", "there is no method `rk8pb`\nhint: did you mean `rk8pd`?", 2},
        {"simulate sleigh --initial omega=1 --method rk8pd --accuracy 1e-6", "--accuracy chooses the method, and --method as well", 2},
        {"simulate sleigh --initial omega=1 --method bdf --ensemble 3", "an ensemble has its own methods, and --method as well", 2},
        {"simulate skate_with_friction --method energy", "the method `energy` cannot be used here", 4},
    };
    place p = place_with_systems();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        finished f = run_expecting(&p, cases[i].line, cases[i].code);
        cr_expect(strstr(f.err, cases[i].words), "%s: %s", cases[i].line, f.err);
        finished_clear(&f);
    }
    place_clear(&p);
}

/* L = x'^2/2 - sign(x): the equations of motion on both sides are x'' = 0, and the energy jumps by 2 where x = 0. */
Test(simulate, an_impulse_is_not_passed_in_silence)
{
    place p = place_with_systems();
    write_here(&p, "jump.yaml", "name: jump\ncoordinates: [x]\nlagrangian: x'^2/2 - sign(x)\n");
    finished all = run_expecting(&p, "simulate jump.yaml --initial x=-1,x'=0.4 --until 4 --step 4 --ensemble 2", 4);
    cr_expect(strstr(all.err, "2 members did not reach the end; member 0: at t = 2.5 it reaches x = 0"), "%s", all.err);
    finished_clear(&all);
    for (int crosses = 0; crosses < 2; crosses++) {
        char line[200];
        snprintf(line, sizeof line, "simulate jump.yaml --initial x=-1,x'=%s --until 4 --step 1", crosses ? "0.4" : "-0.4");
        finished f = run_expecting(&p, line, crosses ? 4 : 0);
        cr_expect_eq(strstr(f.err, "at t = 2.5 it reaches x = 0, where it has an impulse") != NULL, crosses == 1, "%s", f.err);
        cr_expect_eq(strstr(f.out, "\n2,") != NULL && strstr(f.out, "\n3,") == NULL, crosses == 1, "%s", f.out);
        finished_clear(&f);
    }
    place_clear(&p);
}

/* What is written on standard error gives the same motion again. */
Test(simulate, a_state_that_nobody_gives)
{
    static const char *const systems[] = {"kepler", "vertical_disk", "lane_emden", "lagrange_top", "free.yaml"};
    place p = place_with_systems();
    write_here(&p, "free.yaml", "coordinates: [a, b, c]\nlagrangian: (a'^2 + b'^2 + 3*c'^2)/2 - a*b*c\nconstraints: [\"c' = a*b' + 1\"]\nname: free\n");
    for (size_t i = 0; i < sizeof systems / sizeof *systems; i++) {
        char line[2000];
        snprintf(line, sizeof line, "simulate %s --until 1.5 --step 0.5", systems[i]);
        finished f = run_expecting(&p, line, 0);
        const char *from = strstr(f.err, "no initial state is given: --initial \""), *end = from ? strrchr(from, '"') : NULL;
        cr_assert(end && end > from, "%s: %s", systems[i], f.err);
        from = strchr(from, '"') + 1;
        snprintf(line, sizeof line, "$N simulate %s --until 1.5 --step 0.5 --initial \"%.*s\"", systems[i], (int)(end - from), from);
        finished again = run_shell(&p, line);
        cr_expect(again.code == 0 && !strcmp(f.out, again.out), "%s:\n%s%s%s", line, f.out, again.out, again.err);
        cr_expect(!strstr(f.out, "nan"), "%s", f.out);
        finished_clear(&again);
        finished_clear(&f);
    }
    place_clear(&p);
}

/* The formulas of the bicycle's dependent velocities lose digits where its chart is nearly singular: the constraints determine these velocities. */
Test(simulate, a_state_that_nobody_gives_satisfies_the_constraints, PLAIN_ONLY)
{
    place p = place_with_systems();
    finished f = run_expecting(&p, "simulate whipple_bicycle --until 0.1 --step 0.1", 0);
    cr_expect(strstr(f.out, "\n0.1,") && !strstr(f.out, "nan"), "%s", f.out);
    finished_clear(&f);
    place_clear(&p);
}

Test(simulate, names_of_columns_need_no_quotes)
{
    static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_,";
    static const struct {
        const char *line, *head;
    } cases[] = {
        {"$N simulate kepler --initial \"x=1, y'=1\" --until 1", "t,x,y,z,x_dot,y_dot,z_dot,E,Lx,Ly,Lz,Ax,Ay,Az,E_energy\n"},
        {"$N simulate kepler --initial \"x=1, y'=1\" --until 1 --watch \"2*x, -x, x*y, x/y, sqrt(x^2 + y^2), t\"", "t,v2_x,x,x_y,x_y_watched,sqrt_x_2_y_2,t_watched\n"},
        {"$N simulate kepler --initial \"x=1, y'=1\" --until 1 --watch \"x, x, x, x_watched = y\"", "t,x,x_watched,x_watched_2,x_watched_watched\n"},
        {"$N simulate crane --until 1", "t,"},
    };
    place p = place_with_systems();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        finished f = run_shell(&p, cases[i].line);
        cr_expect(f.code == 0 && !strncmp(f.out, cases[i].head, strlen(cases[i].head)), "%s: %.200s\n%s", cases[i].line, f.out, f.err);
        cr_expect(f.out[strspn(f.out, letters)] == '\n', "%.300s", f.out);
        finished_clear(&f);
    }
    place_clear(&p);
}

Test(simulate, standard_input_and_output)
{
    static const struct {
        const char *line, *out, *err;
        int code;
    } cases[] = {
        {"$N show sleigh | $N simulate - --initial omega=2 --until 1 --step 1", "t,phi,x,y,", "", 0},
        {"$N show sleigh | $N verify - --current energ", "", "/dev/stdin", 2},
        {"$N simulate sleigh --initial omega=2 --until 1 --svg -", "<svg", "", 0},
        {"$N simulate sleigh --initial omega=2 --until 1 --html -", "<!", "", 0},
        {"$N verify sleigh --field Z0=1 --html -", "<!", "", 0},
        {"$N simulate sleigh --initial omega=2 --until 1 --html - --json -", "", "`-` prints one output, but 2 options take it", 2},
        {"printf 'name: x\\ncoordinates: [q]\\nlagrangian: qq^2\\n' | $N analyze -", "", "/dev/stdin:3", 3},
    };
    place p = place_with_systems();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        finished f = run_shell(&p, cases[i].line);
        cr_expect(f.code == cases[i].code && !strncmp(f.out, cases[i].out, strlen(cases[i].out)), "%s: %d\n%.100s\n%s", cases[i].line, f.code, f.out, f.err);
        if (i != 1) cr_expect(strstr(f.err, cases[i].err), "%s: %s", cases[i].line, f.err);
        finished_clear(&f);
    }
    place_clear(&p);
}

Test(simulate, a_picture_shows_what_is_watched)
{
    place p = place_with_systems();
    finished f = run_shell(&p, "$N simulate sleigh --initial omega=2 --until 2 --watch 'phi, v' --svg a.svg --quiet && $N simulate sleigh --initial omega=2 --until 2 --ensemble 5 --svg b.svg --quiet");
    char *a = read_here(&p, "a.svg"), *b = read_here(&p, "b.svg");
    cr_assert(f.code == 0 && a && b && !*f.out, "%s%s", f.out, f.err);
    size_t curves[2] = {0, 0};
    for (const char *c = a; (c = strstr(c, "<path")); c++) curves[0]++;
    for (const char *c = b; (c = strstr(c, "<path")); c++) curves[1]++;
    cr_expect(strstr(a, "Chaplygin sleigh over time") && curves[0] >= 2 && curves[1] >= 5, "%zu and %zu curves", curves[0], curves[1]);
    free(a), free(b);
    finished_clear(&f);
    place_clear(&p);
}

/* How wide and high the first curve of a picture is, in its units. */
static void extent(const char *svg, double size[2])
{
    double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
    const char *c = strstr(svg, "<path");
    c = c ? strstr(c, " d=\"") : NULL;
    cr_assert(c, "no curve in %.200s", svg);
    size_t axis = 0;
    for (c += 4; *c && *c != '"';) {
        char *end;
        double number = strtod(c, &end);
        if (end == c) {
            c++;
            continue;
        }
        low[axis] = fmin(low[axis], number);
        high[axis] = fmax(high[axis], number);
        axis = !axis;
        c = end;
    }
    for (axis = 0; axis < 2; axis++) size[axis] = high[axis] - low[axis];
}

/* --axes: a circle is a circle in the plane, and an orbit in phase space fills the picture; members of several motions have their values as names. */
Test(simulate, pictures_of_two_columns)
{
    static const struct {
        const char *options;
        bool circle;
        size_t paths, names, fans; /* curves; names of the legend; thin curves */
    } cases[] = {
        {"--initial \"x=1, y'=1\" --axes 'x, y'", true, 1, 0, 0},
        {"--initial \"x=1\" --axes \"x, x'\"", false, 1, 0, 0},
        {"--initial \"x=1\" --axes \"t, x'\"", false, 1, 0, 0},
        {"--initial \"y'=1\" --over x=1:3:3 --axes 'x, y'", false, 3, 3, 0},
        {"--initial \"y'=1\" --over k=1:3:3 --over x=1,2 --axes 'x, y'", false, 6, 6, 0},
        {"--initial \"y'=1\" --over k=1:3:5 --over x=1,2", false, 10, 0, 10},
        {"--initial \"x=1, y'=1\" --ensemble 9 --axes 'x, y'", true, 9, 0, 9},
    };
    place p = place_make();
    write_here(&p, "plane.yaml", "parameters: {k: 1}\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2 - k*(x^2 + y^2))/2\n");
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char line[300];
        snprintf(line, sizeof line, "$N simulate plane.yaml --until 6.3 %s --svg a.svg --quiet", cases[i].options);
        finished f = run_shell(&p, line);
        char *a = read_here(&p, "a.svg");
        cr_assert(f.code == 0 && a && !*f.out, "%s: %s%s", cases[i].options, f.out, f.err);
        double size[2];
        size_t paths = 0, names = 0, fans = 0;
        extent(a, size);
        for (const char *c = a; (c = strstr(c, "<path")); c++) paths++;
        for (const char *c = a; (c = strstr(c, "class=\"legend\"")); c++) names++;
        for (const char *c = a; (c = strstr(c, "stroke-opacity=\"0.5\"")); c++) fans++;
        cr_expect(paths == cases[i].paths && names == cases[i].names && fans == cases[i].fans, "%s: %zu curves, %zu names, %zu thin", cases[i].options, paths, names, fans);
        if (i < 2) cr_expect((fabs(size[0] - size[1]) < 1) == cases[i].circle, "%s: %g x %g", cases[i].options, size[0], size[1]);
        if (i == 4) cr_expect(strstr(a, "k = 2, x = 1<"), "%s", a);
        free(a);
        finished_clear(&f);
    }
    place_clear(&p);
}

Test(simulate, tables_of_initial_states_and_parameters)
{
    static const struct {
        const char *table, *options, *out, *err;
        int code;
    } cases[] = {
        {"x,x_dot\n1,0\n0,2\n", "", "member,t,x,x_dot,E\n0,0,1,0,2\n0,1,", "", 0},
        {"x, \"w\"\n2,1\n# a comment\n\n1+1,3\n", "", "member,w,t,x,x_dot,E\n0,1,0,2,0,2\n0,1,1,", "", 0},
        {"x\n2\n1\n", "--method relaxation-8", "member,t,x,x_dot,E\n0,0,2,0,8\n", "", 0},
        {"x\n3\n", "--json -", "{\n\t\"schema\":\t1,\n\t\"version\":\t", "", 0},
        {"x;w\r\n1,5;1\r\n-2e0;2\r\n", "", "member,w,t,x,x_dot,E\n0,1,0,1.5,0,1.125\n", "", 0}, /* as spreadsheets write it where the comma is the decimal point */
        {"\xef\xbb\xbfx\tx_dot\n0,5\t\n2\t1\n", "", "member,t,x,x_dot,E\n0,0,0.5,0,0.5\n", "", 0},
        {",x,x_dot\n0,1.5,0\n1,2,1\n", "", "member,t,x,x_dot,E\n0,0,1.5,0,4.5\n", "", 0}, /* pandas numbers the rows */
        {"\"\";\"x\"\n\"a;b\";\"1,5\"\n", "", "member,t,x,x_dot,E\n0,0,1.5,0,4.5\n", "", 0},
        {"x;w\n1,234;1.5\n", "", "", "starts.csv:2: decimals stand behind a comma in `1,234` and behind a point in `1.5` of line 2", 3},
        {"x;w\n2;1\n1\n", "", "", "starts.csv:3: this line has 1 fields, but the line of names has 2", 3},
        {"xx\n2\n", "", "", "starts.csv: the column `xx` is not a coordinate, velocity or parameter of spring\nhint: did you mean `x`?", 3},
        {"x,w\n2,1\n1\n", "", "", "starts.csv:3: this line has 1 fields, but the line of names has 2", 3},
        {"x,w\n2,one\n", "", "", "starts.csv:2: `w` needs a number, found `one`", 3},
        {"x\n2\n1 +\n", "", "", "starts.csv:3", 3},
        {"x\n", "", "", "starts.csv: the table has no rows", 3},
        {"x\n1\n", "--ensemble 3", "", "--initial-table, and --ensemble as well", 2},
        {"t,x\n0,1\n1,1\n", "", "", "all motions of a table begin at one time, but t is 1 here and 0 in the first row", 3},
    };
    place p = place_make();
    write_here(&p, "spring.yaml", oscillator);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char line[300];
        write_here(&p, "starts.csv", cases[i].table);
        snprintf(line, sizeof line, "$N simulate spring.yaml --until 1 --step 1 --initial-table starts.csv %s", cases[i].options);
        finished f = run_shell(&p, line);
        cr_expect(f.code == cases[i].code && !strncmp(f.out, cases[i].out, strlen(cases[i].out)), "%s: %d\n%s%s", cases[i].table, f.code, f.out, f.err);
        cr_expect(strstr(f.err, cases[i].err), "%s: %s", cases[i].table, f.err);
        finished_clear(&f);
    }
    place_clear(&p);
}

/* --over: the table of all combinations. */
Test(simulate, motions_over_ranges)
{
    static const struct {
        const char *options, *out, *err;
        int code;
    } cases[] = {
        {"--over w=1:2:3 --watch x", "member,w,t,x\n0,1,0,1\n", "", 0},
        {"--over w=1,3/2 --over x=2,4 --watch x", "member,w,t,x\n0,1,0,2\n", "", 0},
        {"--over x=0:1:2 --over \"x'=1,2\"", "member,t,x,x_dot,E\n0,0,0,1,0.5\n", "", 0},
        {"--over w", "", "--over `w` is neither a range nor a list", 2},
        {"--over w=2:1:3", "", "the first end of the range is not below the second", 2},
        {"--over ww=1:2:3", "", "--over: `ww` is not a coordinate, velocity or parameter of spring\nhint: did you mean", 2},
        {"--over w=1:2:3 --initial-table starts.csv", "", "--initial-table, and --over as well", 2},
        {"--over w=1:2:3 --ensemble 3", "", "--over, and --ensemble as well", 2},
    };
    place p = place_make();
    write_here(&p, "spring.yaml", oscillator);
    write_here(&p, "starts.csv", "x\n1\n");
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char line[300];
        snprintf(line, sizeof line, "$N simulate spring.yaml --initial x=1 --until 1 --step 1 %s", cases[i].options);
        finished f = run_shell(&p, line);
        cr_expect(f.code == cases[i].code && !strncmp(f.out, cases[i].out, strlen(cases[i].out)), "%s: %d\n%s%s", cases[i].options, f.code, f.out, f.err);
        cr_expect(strstr(f.err, cases[i].err), "%s: %s", cases[i].options, f.err);
        size_t lines = 0;
        for (const char *c = f.out; *c; c++) lines += *c == '\n';
        cr_expect(i != 0 || lines == 7, "three motions of two rows, and names: %zu lines", lines);
        cr_expect(i != 1 || lines == 9, "four motions: %zu lines", lines);
        finished_clear(&f);
    }
    place_clear(&p);
}

/* m x'' = u(t): what was put in comes out after two integrations. */
Test(simulate, inputs_over_time)
{
    static const struct {
        const char *input;
        double speed; /* at t = 3 */
    } cases[] = {{"u=sin(t)", 0.5 * (1 - -0.98999249660044542)}, {"u = m*t^2", 9}, {"u=drive.csv:thrust", 0.5 * (0.5 * 2 + 1 * 2 + (2 - 1) / 2.0)}, {"u=drive.csv:flat", 1.5 * 0.25}};
    static const struct {
        const char *input, *err;
    } wrong[] = {{"w=1", "`w` is not a parameter of cart"}, {"u=2*u", "the input `u` depends on itself"}, {"u=-3*x", "what depends on the state stands under `forces:`"},
                 {"u=mm", "hint: did you mean `m`?"}, {"u=sin(s)", "--input u:5: unknown name `s`"},
                 {"u=drive.csv:thrus", "drive.csv: there is no column `thrus`\nhint: did you mean `thrust`?"}, {"u=drive.csv:zz", "drive.csv: there is no column `zz`\nhint: its columns are t, "},
                 {"u=drive.csv", "--input u needs a column of drive.csv\nhint: for example --input \"u=drive.csv:"}, {"u=nowhere.csv", "nowhere.csv: "},
                 {"u=back.csv:v", "back.csv:3: the times of an input must rise, but 0 comes after 1"}, {"u", "--input needs NAME=EXPR, found `u`\nhint: for example: --input \"u=sin(t)\""},
                 {"drive.csv", "--input needs NAME=EXPR, found `drive.csv`\nhint: a column of a table: --input \"u=drive.csv:COLUMN\""}};
    place p = place_make();
    write_here(&p, "cart.yaml", "name: cart\nparameters: [{name: m, value: 2}, {name: u, value: 7}]\ncoordinates: [x]\nlagrangian: m*x'^2/2\nforces: [\"x = u\"]\n");
    write_here(&p, "drive.csv", "t,thrust,flat\n0.5,0,0.25\n1,2,0.25\n2,2,0.25\n4,-2,0.25\n");
    write_here(&p, "back.csv", "t,v\n1,0\n0,1\n");
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char line[300];
        snprintf(line, sizeof line, "$N simulate cart.yaml --initial x=0 --until 3 --step 3 --watch \"x'\" --input '%s'", cases[i].input);
        finished f = run_shell(&p, line);
        cr_expect(f.code == 0 && fabs(last_number(f.out) - cases[i].speed) < 1e-9, "%s: %s instead of %.10g\n%s", cases[i].input, f.out, cases[i].speed, f.err);
        finished_clear(&f);
    }
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        char line[300];
        snprintf(line, sizeof line, "$N simulate cart.yaml --initial x=0 --input '%s'", wrong[i].input);
        finished f = run_shell(&p, line);
        cr_expect((f.code == 2 || f.code == 3) && strstr(f.err, wrong[i].err), "%s: %d %s", wrong[i].input, f.code, f.err);
        finished_clear(&f);
    }
    place_clear(&p);
}

/* Commas and semicolons end the entries of every list, except between parentheses. */
Test(simulate, lists_have_one_syntax)
{
    static const char *const lines[][2] = {
        {"simulate spring.yaml --until 1 --step 1 --initial \"x=atan2(1,2), x'=1\" --watch \"x, atan2(x,x')\"", "simulate spring.yaml --until 1 --step 1 --initial \"x=atan2(1,2); x'=1;\" --watch \" x ; atan2(x,x')\""},
        {"verify spring.yaml --field 'Z0=1, x=0'", "verify spring.yaml --field 'Z0=1; x=0'"},
    };
    place p = place_make();
    write_here(&p, "spring.yaml", oscillator);
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        finished f[2];
        for (int k = 0; k < 2; k++) {
            char line[400];
            snprintf(line, sizeof line, "$N %s", lines[i][k]);
            f[k] = run_shell(&p, line);
        }
        cr_expect(f[0].code == 0 && f[1].code == 0 && !strcmp(f[0].out, f[1].out), "%s\n%s%s%s%s", lines[i][0], f[0].out, f[1].out, f[0].err, f[1].err);
        finished_clear(&f[0]), finished_clear(&f[1]);
    }
    place_clear(&p);
}

/* As a shell calls it. */
Test(simulate, completions_complete_values)
{
    static const char *const cases[][2] = {{"nhsym simulate sleigh --method relax", "relaxation-4 relaxation-8"}, {"nhsym simulate --option fixed_st", "fixed_steps="}, {"nhsym explain metho", "methods"},
                                           {"nhsym help simul", "simulate"}, {"nhsym simulate sleigh --velocities qu", "quasi"}, {"nhsym simulate sleigh --initial-t", "--initial-table"}};
    place p = place_with_systems();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char line[700];
        snprintf(line, sizeof line, "$N help bash >c.bash; bash -c 'compopt() { :; }; . ./c.bash; COMP_WORDS=(%s); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _nhsym; echo \"${COMPREPLY[*]}\"'", cases[i][0]);
        finished f = run_shell(&p, line);
        size_t length = strlen(cases[i][1]);
        cr_expect(!strncmp(f.out, cases[i][1], length) && f.out[length] == '\n', "%s: %s%s", cases[i][0], f.out, f.err);
        finished_clear(&f);
    }
    place_clear(&p);
}

/* --csv FILE has what would be printed, and nothing is: of one motion, of several, beside JSON. */
Test(simulate, the_table_as_a_file)
{
    static const struct {
        const char *options, *table, *out;
    } cases[] = {{"--csv a.csv", "t,x,x_dot,E\n0,1,0,0.5\n", ""},
                 {"--csv a.csv --over w=1,3 --watch x", "member,w,t,x\n0,1,0,1\n", ""},
                 {"--csv a.csv --ensemble 2 --watch x", "member,t,x\n0,0,1\n", ""},
                 {"--csv a.csv --over w=1,3 --json - --quiet", "member,w,t,", "{"}};
    place p = place_make();
    write_here(&p, "spring.yaml", oscillator);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char line[300];
        snprintf(line, sizeof line, "rm -f a.csv; $N simulate spring.yaml --initial x=1 --set w=1 --until 1 --step 1 %s", cases[i].options);
        finished f = run_shell(&p, line);
        char *table = read_here(&p, "a.csv");
        cr_expect(f.code == 0 && table && !strncmp(table, cases[i].table, strlen(cases[i].table)), "%s: %d\n%s%s", cases[i].options, f.code, f.err, table ? table : "no table");
        cr_expect(strlen(cases[i].out) ? !strncmp(f.out, cases[i].out, 1) : !*f.out, "%s printed %s", cases[i].options, f.out);
        free(table);
        finished_clear(&f);
    }
    place_clear(&p);
}

static size_t occurrences(const char *text, char c)
{
    size_t n = 0;
    for (; text && *text; text++) n += *text == c;
    return n;
}

/* x = cos(2 t) with three rows: the picture is a curve, the table keeps its rows. */
Test(simulate, pictures_are_curves_though_tables_are_short)
{
    place p = place_make();
    write_here(&p, "spring.yaml", oscillator);
    finished f = run_shell(&p, "$N simulate spring.yaml --initial 'x=1' --until 3 --step 1.5 --svg a.svg --csv a.csv -q; cat a.csv; echo; cat a.svg");
    char *svg = strstr(f.out, "<svg");
    cr_assert(f.code == 0 && svg, "%s", f.err);
    /* points that a quarter of a pixel does not tell from the line are left out */
    cr_expect(occurrences(svg, 'L') > 25, "%zu corners", occurrences(svg, 'L'));
    *svg = 0;
    cr_expect_eq(occurrences(f.out, '\n'), 5, "%s", f.out);
    finished_clear(&f);
    place_clear(&p);
}

/* A step of a third of the period: the energy is gone. */
Test(simulate, a_fixed_step_is_named_and_watched)
{
    static const char kepler[] = "name: orbit\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 + 1/sqrt(x^2 + y^2)\n";
    place p = place_make();
    write_here(&p, "orbit.yaml", kepler);
    finished f = run_shell(&p, "$N simulate orbit.yaml --initial \"x=0.1, y'=4.3588989435\" --until 62.8 --step 6.28 --method midpoint");
    cr_expect(f.code == 0 && strstr(f.err, "fixed steps of 0.628") && strstr(f.err, "is conserved, but goes from -0.5 to 7.6"), "%s", f.err);
    finished_clear(&f);
    f = run_shell(&p, "$N simulate orbit.yaml --initial \"x=1, y'=1\" --until 6.28 --step 0.0628 --method midpoint");
    cr_expect(f.code == 0 && strstr(f.err, "fixed steps of 0.00628") && !strstr(f.err, "conserved"), "%s", f.err);
    finished_clear(&f);
    f = run_shell(&p, "$N simulate orbit.yaml --initial \"x=1, y'=1\" --method leapfrog");
    cr_expect(f.code == 2 && strstr(f.err, "the nearest one here is `dalembert`: discrete Lagrange-d'Alembert"), "%s", f.err);
    finished_clear(&f);
    place_clear(&p);
}

Test(simulate, the_end_may_be_an_expression)
{
    place p = place_make();
    write_here(&p, "spring.yaml", oscillator);
    finished f = run_shell(&p, "$N simulate spring.yaml --initial 'x=1' --until '2*pi' --step 10 --watch x");
    cr_expect(f.code == 0 && strstr(f.out, "\n6.283185307179586,"), "%s%s", f.out, f.err);
    finished_clear(&f);
    f = run_shell(&p, "$N simulate spring.yaml --until 1/0; $N simulate spring.yaml --until k");
    cr_expect(strstr(f.err, "needs a number, found `1/0`") && strstr(f.err, "needs a number, found `k`"), "%s", f.err);
    finished_clear(&f);
    place_clear(&p);
}

/* At every whole period the velocity along the axis is zero: its error is measured by its size along the motion. */
Test(simulate, accuracy_is_relative_to_the_motion, PLAIN_ONLY)
{
    place p = place_make();
    write_here(&p, "orbit.yaml", "name: orbit\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 + 1/sqrt(x^2 + y^2)\n");
    finished f = run_vector(&p, &(manner){0}, (char *[]){p.program, "simulate", "orbit.yaml", "--initial", "x=0.1, y'=sqrt(19)", "--until", "2*pi", "--step", "6.283185307179586",
                                                         "--accuracy", "1e-8", "--quiet", NULL});
    double row[3] = {0, 0, 0};
    char *last = strstr(f.out, "\n6.28");
    cr_assert_eq(f.code, 0, "exit code %d\n%s", f.code, f.err);
    cr_assert(last && sscanf(last, "%lf,%lf,%lf", &row[0], &row[1], &row[2]) == 3, "%s", f.out);
    cr_expect_float_eq(row[1], 0.1, 1e-7);
    finished_clear(&f);
    f = run_vector(&p, &(manner){0}, (char *[]){p.program, "simulate", "orbit.yaml", "--watch", "energy", NULL});
    cr_expect(f.code == 2 && strstr(f.err, "the energy is written E"), "exit code %d\n%s", f.code, f.err);
    finished_clear(&f);
    place_clear(&p);
}

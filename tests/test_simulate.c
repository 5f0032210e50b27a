/* nhsym simulate: methods by name, initial states that nobody gives, names of columns, pictures, standard input and output. */
#include <criterion/criterion.h>
#include <math.h>

#include "motion/method.h"
#include "program.h"

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
Test(simulate, every_method_has_a_word)
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

/* nhsym simulate --event and --section: zeros along motions, against closed forms. */
#include <criterion/criterion.h>
#include <math.h>

#include "base/json.h"
#include "motion/method.h"
#include "program.h"
#include "sweep.h"

static const char *const pendulum =
    "name: pendulum\ncoordinates: [{name: phi, type: angle}]\nlagrangian: phi'^2/2 + cos(phi)\n";
static const char *const henon_heiles =
    "name: hh\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2 - x^2 - y^2)/2 - x^2*y + y^3/3\n";
static const char *const ball =
    "name: ball\nparameters: [{name: g, value: 10}]\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - g*y\n";

static finished run_shell(const place *p, const char *format, ...)
{
    char line[2000], command[4096];
    va_list list;
    va_start(list, format);
    vsnprintf(line, sizeof line, format, list);
    va_end(list);
    snprintf(command, sizeof command, "N='%.400s'; %s", p->program, line);
    return run_vector(p, &(manner){0}, (char *[]){"sh", "-c", command, NULL});
}

/* The JSON of `nhsym simulate LINE --json -`. */
static nh_json *simulated(const place *p, const char *line)
{
    finished f = run_shell(p, "$N simulate %s --json -", line);
    nh_json *root = f.code == 0 ? nh_json_parse(f.out) : NULL;
    cr_assert(root, "%s: exit code %d\n%s", line, f.code, f.err);
    finished_clear(&f);
    return root;
}

static const nh_json *event(const nh_json *root, size_t which)
{
    return nh_json_entry(nh_json_get(root, "events"), which);
}
static size_t count(const nh_json *zeros) { return nh_json_count(nh_json_get(zeros, "time")); }
static double time_of(const nh_json *zeros, size_t i) { return nh_json_number_at(nh_json_get(zeros, "time"), i); }
static double sign_of(const nh_json *zeros, size_t i) { return nh_json_number_at(nh_json_get(zeros, "sign"), i); }
static double value_of(const nh_json *zeros, const char *name, size_t i)
{
    return nh_json_number_at(nh_json_get(nh_json_get(zeros, "values"), name), i);
}

static double period(double amplitude) /* 2 pi / agm(1, cos(amplitude/2)) */
{
    double a = 1, b = cos(amplitude / 2);
    while (fabs(a - b) > 1e-15) {
        double mean = (a + b) / 2;
        b = sqrt(a * b);
        a = mean;
    }
    return 2 * acos(-1) / a;
}

/* Half a period of the pendulum by every method, as exactly as its order promises; the last row of the table is the event. */
Test(events, half_a_period_by_every_method, PLAIN_ONLY)
{
    place p = place_make();
    write_here(&p, "pendulum.yaml", pendulum);
    for (size_t i = 0; i < nh_method_count(); i++) {
        const nh_method *method = nh_method_at(i);
        char line[300];
        snprintf(
            line, sizeof line,
            "pendulum.yaml --initial phi=2 --until 20 --step 0.25 --tolerance 1e-11 --event \"phi', stop\" --method %s",
            method->word);
        nh_json *root = simulated(&p, line);
        const nh_json *e = event(root, 0), *time = nh_json_get(root, "time");
        double allowed = method->order == 0   ? 1e-9
                         : method->order == 2 ? 1e-4
                                              : 3e-8,
               off = fabs(time_of(e, 1) - period(2) / 2);
        cr_expect(count(e) == 2 && off < allowed, "%s: off by %g", method->word, off);
        cr_expect(time_of(e, 0) == 0 && sign_of(e, 0) == -1 && sign_of(e, 1) == 1 && nh_json_is_true(root, "complete"),
                  "%s", method->word);
        cr_expect(nh_json_number_at(time, nh_json_count(time) - 1) == time_of(e, 1),
                  "%s: the last output is not the event", method->word);
        nh_json_free(root);
    }
    place_clear(&p);
}

/* Ten periods: the times are those of the closed form, the states are on the zero. */
Test(events, directions)
{
    place p = place_make();
    write_here(&p, "pendulum.yaml", pendulum);
    nh_json *root = simulated(&p, "pendulum.yaml --initial phi=2 --until 83 --step 83 --tolerance 1e-12 --event 'phi = "
                                  "0, rising; phi, falling' --event \"phi = 1\"");
    double T = period(2);
    cr_assert_eq(count(event(root, 0)), 10);
    cr_assert_eq(count(event(root, 1)), 10);
    cr_assert_eq(count(event(root, 2)), 20);
    for (size_t i = 0; i < 10; i++) {
        cr_expect(fabs(time_of(event(root, 0), i) - T * (0.75 + (double)i)) < 1e-9 &&
                      fabs(value_of(event(root, 0), "phi", i)) < 1e-13,
                  "%.15g", time_of(event(root, 0), i));
        cr_expect(fabs(time_of(event(root, 1), i) - T * (0.25 + (double)i)) < 1e-9, "%.15g",
                  time_of(event(root, 1), i));
    }
    nh_json_free(root);
    place_clear(&p);
}

/* A throw from the ground: the start is a zero and ends nothing; also against the time. */
/* Where a function has no value its sign may change without a zero: that place is told, and is no event. */
Test(events, a_sign_that_changes_where_there_is_no_value)
{
    static const struct {
        const char *function;
        double zero; /* its only one until t = 3, or NAN */
        bool everywhere;
    } cases[] = {{"(x-1)*sqrt((x-1)^2-0.01)", NAN, false},      {"(x-1)/sqrt((x-1)^2-1e-9)", NAN, false},
                 {"(x-1)*(x-2)*sqrt((x-1)^2-0.01)", 2, false},
                 {"(x-2)*sqrt((x-1)^2-0.25)/(x-1)", 2, false},  {"(x-1)*sqrt((x-2)^2-0.01)/abs(x-2)", 1, false},
                 {"(x-1)*sqrt(1+(x-1)^2)", 1, true}};
    place p = place_make();
    write_here(&p, "free.yaml", "name: free\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\n");
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char line[300];
        snprintf(line, sizeof line, "free.yaml --initial \"x'=1\" --until 3 --event \"%s\"", cases[i].function);
        nh_json *root = simulated(&p, line);
        size_t n = count(event(root, 0));
        for (size_t k = 0; k < n; k++) {
            double t = time_of(event(root, 0), k);
            cr_expect(fabs(t - cases[i].zero) < 1e-8, "%s: an event at t = %.12g", line, t);
        }
        if (cases[i].everywhere) cr_expect_eq(n, (size_t)!isnan(cases[i].zero), "%s: %zu events", line, n);
        nh_json_free(root);
    }
    place_clear(&p);
}

Test(events, at_the_start)
{
    place p = place_make();
    write_here(&p, "ball.yaml", ball);
    nh_json *root = simulated(&p, "ball.yaml --initial \"x'=1, y'=5\" --event 'y, stop' --event 'x - t' --until 7");
    const nh_json *e = event(root, 0);
    cr_assert_eq(count(e), 2);
    cr_expect(time_of(e, 0) == 0 && sign_of(e, 0) == 1 && fabs(time_of(e, 1) - 1) < 1e-13 &&
              fabs(value_of(e, "x", 1) - 1) < 1e-13);
    cr_expect_eq(count(event(root, 1)), 0, "x = t all along is no event");
    nh_json_free(root);
    root = simulated(&p, "ball.yaml --initial \"x'=1, y'=5, y=-1\" --event 'y, stop' --until -3");
    cr_expect(count(event(root, 0)) == 0, "a throw backward in time does not come back");
    nh_json_free(root);
    root = simulated(&p, "ball.yaml --initial \"x'=1, y'=-5\" --event 'y, stop' --until -3");
    cr_expect(count(event(root, 0)) == 2 && fabs(time_of(event(root, 0), 1) + 1) < 1e-13 &&
                  sign_of(event(root, 0), 1) == 1,
              "rising is along t, whatever the direction of the motion");
    nh_json_free(root);
    place_clear(&p);
}

/* The highest point of the pendulum is -2: 1e-8 above it there are two zeros 1e-4 apart, 1e-7 below it there is none; a pole and a jump are none either. */
Test(events, grazing_and_jumps)
{
    place p = place_make();
    write_here(&p, "pendulum.yaml", pendulum);
    nh_json *root = simulated(&p, "pendulum.yaml --initial phi=2 --until 8 --tolerance 1e-12 --event 'phi + 2 - 1e-8; "
                                  "phi + 2 + 1e-7; 1/phi; phi/abs(phi)'");
    double half = sqrt(2 * 1e-8 / sin(2));
    const nh_json *e = event(root, 0);
    cr_assert_eq(count(e), 2);
    cr_expect(fabs(time_of(e, 0) - (period(2) / 2 - half)) < 1e-7 &&
                  fabs(time_of(e, 1) - (period(2) / 2 + half)) < 1e-7,
              "%.12g %.12g", time_of(e, 0), time_of(e, 1));
    for (size_t i = 1; i < 4; i++) cr_expect_eq(count(event(root, i)), 0, "%s", nh_json_text(event(root, i), "of"));
    const nh_json *warnings = nh_json_get(root, "warnings");
    cr_expect(nh_json_count(warnings) == 1, "a jump is told");
    nh_json_free(root);
    place_clear(&p);
}

/* Far more zeros than steps. */
Test(events, many_in_one_step)
{
    place p = place_make();
    write_here(&p, "ball.yaml",
               ball); /* its steps are 8 s long, and 1 s from one sample to the next: sin(100 t) looks slow at these */
    nh_json *root = simulated(&p, "ball.yaml --initial \"x'=1\" --until 10 --event 'sin(100*t)'");
    const nh_json *e = event(root, 0);
    cr_assert_eq(count(e), 319);
    for (size_t i = 0; i < 319; i++)
        cr_expect(fabs(time_of(e, i) - (double)i * acos(-1) / 100) < 1e-14 * (1 + (double)i));
    nh_json_free(root);
    place_clear(&p);
}

/* The zeros of a cos(f t + p) - level between 0 and the end. */
static size_t zeros_of_cosine(double a, double f, double p, double level, double end)
{
    size_t n = 0;
    for (long k = -2; k * 2 * M_PI < f * end + 10; k++)
        for (int side = -1; side < 2; side += 2) {
            double t = (side * acos(level / a) - p + 2 * M_PI * (double)k) / f;
            n += t > 0 && t < end;
        }
    return n;
}

/* Pairs of zeros that nearly touch, of several functions at once, among others at the same time; steps of every length.  (Of the 955 zeros of
 * x = 0.999999 along x = cos(t) 841 were found by the usual method, beside others.) */
Test(events, touching_pairs)
{
    static const char *const methods[] = {"auto", "verner", "adams", "rk8pd", "bdf"};
    static const double depth[] = {1e-2, 1e-4, 1e-6, 3e-8, -1e-6};
    place p = place_make();
    write_here(&p, "two.yaml", "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2 - x^2)/2 - y^2\n");
    double a = sqrt(0.3 * 0.3 + 0.5), f = sqrt(2), phase = -atan2(1 / f, 0.3);
    for (size_t m = 0; m < 5; m++)
        for (size_t d = 0; d < 5; d++) {
            char line[500];
            double level = a * (1 - depth[d]), x = 1 - depth[d], end = m < 4 ? 300 : 40;
            if (!sweep_tries(5 * m + d + 1, 8, 25)) continue;
            snprintf(line, sizeof line,
                     "two.yaml --initial \"x=1, y=0.3, y'=1\" --tolerance 1e-11 --until %g --step %g --method %s --event \"x = %.17g; x = %.17g; y = %.17g; "
                     "x*y = 0.2999; y = %.17g\"", end, d % 2 ? end : end / 7, methods[m], x, 0.5 * x, level, 0.3 * level);
            nh_json *root = simulated(&p, line);
            size_t wanted[] = {depth[d] < 0 ? 0 : zeros_of_cosine(1, 1, 0, x, end), zeros_of_cosine(1, 1, 0, 0.5 * x, end),
                               depth[d] < 0 ? 0 : zeros_of_cosine(a, f, phase, level, end)};
            for (size_t i = 0; i < 3; i++) cr_expect_eq(count(event(root, i)), wanted[i], "%s: %zu of %zu", line, count(event(root, i)), wanted[i]);
            cr_expect_eq(count(event(root, 4)), zeros_of_cosine(a, f, phase, 0.3 * level, end), "%s", line);
            nh_json_free(root);
        }
    place_clear(&p);
}

/* Two zeros beside every kink: x = 0.6 cos(t) + 0.8 sin(t) passes c 22 or 23 times. */
Test(events, zeros_beside_kinks)
{
    static const char *const level[] = {"1e-2", "1e-5", "1e-8"}, *const centre[] = {"0.3", "0.77", "-0.5", "0"};
    place p = place_make();
    write_here(&p, "two.yaml", "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2 - x^2)/2 - y^2\n");
    for (size_t i = 0; i < 12; i++) {
        char line[400];
        if (!sweep_tries(i + 1, 6, 12)) continue;
        const char *l = level[i % 3], *c = centre[i / 3];
        snprintf(line, sizeof line,
                 "two.yaml --initial \"x=0.6, x'=0.8, y=0.3, y'=1\" --until 70 --step 70 --event \"abs(x - (%s)) = %s; x = %s; "
                 "abs(sin(20*x) - (%s)) = %s; sin(20*x) = %s\"", c, l, c, c, l, c);
        nh_json *root = simulated(&p, line);
        for (size_t k = 0; k < 4; k += 2)
            cr_expect_eq(count(event(root, k)), 2 * count(event(root, k + 1)), "%s: %zu beside %zu", line, count(event(root, k)), count(event(root, k + 1)));
        cr_expect_eq(count(event(root, 1)), i / 3 == 1 ? 23u : 22u);
        nh_json_free(root);
    }
    place_clear(&p);
}

/* Whether a function that touches 0 within the tolerance crosses it cannot be told. */
Test(events, what_is_not_decided_is_said)
{
    static const char *const touching[] = {"x = 1", "x^2 = 1", "(x - 1)*(y - 2)", "(x - 0.3)^2"};
    place p = place_make();
    write_here(&p, "two.yaml", "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2 - x^2)/2 - y^2\n");
    for (size_t i = 0; i < sizeof touching / sizeof *touching; i++) {
        char line[300];
        snprintf(line, sizeof line, "two.yaml --initial \"x=0.6, x'=0.8, y=0.3, y'=1\" --until 7 --event \"%s; x'\"", touching[i]);
        nh_json *root = simulated(&p, line);
        cr_expect_eq(count(event(root, 1)), 2, "%s", touching[i]);
        cr_expect_gt(nh_json_count(nh_json_get(root, "warnings")), 0, "%s", touching[i]);
        nh_json_free(root);
    }
    place_clear(&p);
}

/* x = exp(-t) beside a rate of 1e6, and dry friction, of which the first turn is at pi - atan(0.01/0.9). */
Test(events, stiff_and_with_friction, PLAIN_ONLY)
{
    static const char *const methods[] = {"auto", "bdf", "adams", "esdirk", "verner"};
    place p = place_make();
    write_here(&p, "stiff.yaml",
               "name: stiff\ncoordinates: [x]\nlagrangian: (x'^2 - 1e6*x^2)/2\nforces: [x = -(1e6 + 1)*x']\n");
    write_here(&p, "friction.yaml",
               "name: friction\ncoordinates: [x]\nlagrangian: (x'^2 - x^2)/2\nforces: [x = -0.1*x'/abs(x')]\n");
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) {
        char line[300];
        double turn = acos(-1) - atan(0.01 / 0.9);
        snprintf(line, sizeof line,
                 "friction.yaml --initial \"x=1, x'=-0.01\" --until 4 --tolerance 1e-10 --event \"x'\" --method %s",
                 methods[i]);
        nh_json *root = simulated(&p, line);
        cr_expect(count(event(root, 0)) == 1 && fabs(time_of(event(root, 0), 0) - turn) < 1e-8 &&
                      nh_json_count(nh_json_get(root, "warnings")) == 0,
                  "%s: %.15g, not %.15g", methods[i], time_of(event(root, 0), 0), turn);
        nh_json_free(root);
        if (i > 3) break; /* an explicit method does not get through a stiff motion */
        snprintf(line, sizeof line, "stiff.yaml --initial \"x=1, x'=-1\" --until 4 --event \"x = 0.5\" --method %s",
                 methods[i]);
        root = simulated(&p, line);
        cr_expect(count(event(root, 0)) == 1 && fabs(time_of(event(root, 0), 0) - log(2)) < 1e-7, "%s: %.15g",
                  methods[i], time_of(event(root, 0), 0));
        nh_json_free(root);
    }
    place_clear(&p);
}

/* One time in quasi-velocities, in coordinate velocities with all coordinates where these end, and in the smallest model: omega = 1 of the sleigh. */
Test(events, in_every_formulation)
{
    static const char *const ways[] = {"", "--velocities coordinates", "--watch omega",
                                       "--method midpoint-4 --step 0.01"};
    place p = place_with_systems();
    double time[4], crossing[4];
    for (size_t i = 0; i < 4; i++) {
        char line[300];
        snprintf(
            line, sizeof line,
            "sleigh --initial 'omega=2, v=1' --until 4 --tolerance 1e-12 --event 'omega = 1' --event 'cos(phi)' %s",
            ways[i]);
        nh_json *root = simulated(&p, line);
        time[i] = time_of(event(root, 0), 0);
        crossing[i] = time_of(event(root, 1), 0);
        cr_expect(fabs(time[i] - time[0]) < 1e-9 && fabs(crossing[i] - crossing[0]) < 1e-9, "%s: %.15g %.15g", ways[i],
                  time[i], crossing[i]);
        nh_json_free(root);
    }
    place_clear(&p);
}

/* Every point lies on the section, has the energy of the start, and rises. */
Test(events, section_of_henon_heiles)
{
    place p = place_make();
    write_here(&p, "hh.yaml", henon_heiles);
    nh_json *root =
        simulated(&p, "hh.yaml --initial \"y=0.1, x'=0.4\" --until 500 --step 500 --section x --tolerance 1e-12");
    const nh_json *s = nh_json_get(root, "section");
    cr_assert(count(s) > 70 && time_of(s, 0) == 0, "%zu points", count(s));
    for (size_t i = 0; i < count(s); i++) {
        cr_expect(fabs(value_of(s, "x", i)) < 1e-12 && value_of(s, "x'", i) > 0 &&
                  fabs(value_of(s, "E", i) - value_of(s, "E", 0)) < 1e-11);
        cr_expect(i == 0 || time_of(s, i) > time_of(s, i - 1) + 1);
    }
    nh_json_free(root);
    place_clear(&p);
}

/* Tables, a folder, and one picture of the sections of several motions. */
Test(events, tables_and_pictures)
{
    place p = place_make();
    write_here(&p, "hh.yaml", henon_heiles);
    finished f =
        run_shell(&p, "$N simulate hh.yaml --initial \"x'=0.4\" --over y=0:0.2:3 --until 60 --section 'x, both' --axes "
                      "\"y, y'\" --svg s.svg && grep -c '<circle' s.svg && $N simulate hh.yaml --initial "
                      "\"y=0.1, x'=0.4\" --until 30 --step 30 --event 'y, falling' --section x -o out -q && head -1 "
                      "out/events.csv && head -1 out/section.csv && wc -l < out/motion.csv && "
                      "grep -o '<h2[^>]*>Section' out/report.html | wc -l && $N simulate hh.yaml --initial \"y=0.1, "
                      "x'=0.4\" --until 30 --section x | head -1");
    cr_expect_eq(f.code, 0, "%s", f.err);
    cr_expect(strstr(f.out, "event,direction,t,x,y,x_dot,y_dot,E\nt,x,y,x_dot,y_dot,E\n3\n1\nt,x,y,x_dot,y_dot,E\n"),
              "%s", f.out);
    finished_clear(&f);
    place_clear(&p);
}

/* The table of a page and of LaTeX: a head per column, and a row per zero. */
Test(events, tables_of_documents)
{
    place p = place_make();
    write_here(&p, "pendulum.yaml", pendulum);
    finished f = run_shell(&p, "$N simulate pendulum.yaml --initial phi=2 --until 9 --event phi --html a.html --tex a.tex -q");
    char *page = read_here(&p, "a.html"), *tex = read_here(&p, "a.tex");
    cr_assert(f.code == 0 && page && tex, "%s", f.err);
    const char *table = strstr(page, "<caption>phi, both: 2"), *end = table ? strstr(table, "</table>") : NULL;
    cr_assert(end);
    size_t heads = 0, cells = 0, rows = 0;
    for (const char *c = table; (c = strstr(c, "<th scope=\"col\"")) && c < end; c++) heads++;
    for (const char *c = table; (c = strstr(c, "<td")) && c < end; c++) cells++;
    for (const char *c = table; (c = strstr(c, "<th scope=\"row\"")) && c < end; c++) rows++;
    const char *time = strstr(table, "2.087438");
    cr_expect(heads == 5 && rows == 2 && cells == 8, "%zu heads, %zu rows, %zu cells", heads, rows, cells);
    cr_expect(time && time < end && strstr(table, ">direction<") && !memchr(table, '|', (size_t)(end - table)), "%.*s", (int)(end - table), table);
    table = strstr(tex, "phi, both: 2");
    end = table ? strstr(table, "longtable") : NULL;
    cr_expect(end && strstr(table, "t & direction & phi & ") && !memchr(table, '|', (size_t)(end - table)), "%.*s", end ? (int)(end - table) : 0, table);
    free(page), free(tex);
    finished_clear(&f);
    place_clear(&p);
}

Test(events, errors_say_where)
{
    static const struct {
        const char *line, *words;
    } cases[] = {
        {"--event 'ph'", "--event:1: unknown name `ph`"},
        {"--event 'phi + '", "--event:"},
        {"--event 'phi, rsing'", "hint: did you mean `rising`?"},
        {"--event '3'", "`3` never changes along a motion"},
        {"--event ''", "--event names no expression"},
        {"--section 'phi, stop'", "where rising, falling or both may stand"},
        {"--section \"phi; phi'\"", "--section needs one expression, found 2"},
        {"--section phi --axes 'phi, ph'", "did you mean `phi`?"},
        {"--section phi --axes phi", "--axes needs two columns"},
        {"--axes 'phi, ph'", "--axes: `ph` is not a column of the table\nhint: did you mean `phi`?"},
        {"--event phi --ensemble 3", "--ensemble, and --event as well"},
        {"--event 'phi, stop' --accuracy 1e-6", "leave out `stop` or --accuracy"},
    };
    place p = place_make();
    write_here(&p, "pendulum.yaml", pendulum);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        finished f = run_shell(&p, "$N simulate pendulum.yaml --initial phi=2 %s", cases[i].line);
        cr_expect(f.code == 2 && strstr(f.err, cases[i].words), "%s: exit code %d\n%s", cases[i].line, f.code, f.err);
        finished_clear(&f);
    }
    place_clear(&p);
}

/* A pendulum that starts from rest at phi = 1 passes phi = 0 once, falling, until t = 2. */
Test(events, a_direction_without_zeros_is_named)
{
    place p = place_make();
    write_here(&p, "pendulum.yaml", pendulum);
    finished f = run_shell(&p, "$N simulate pendulum.yaml --initial phi=1 --until 2 --section phi; $N simulate pendulum.yaml --initial phi=1 --until 2 --section 'phi - 2, both'");
    cr_expect_not_null(strstr(f.err, "nhsym: phi has no rising zero along this motion\n"), "%s", f.err);
    cr_expect_not_null(strstr(f.err, "nhsym: phi - 2 has no zero along this motion\n"), "%s", f.err);
    finished_clear(&f);
    place_clear(&p);
}

/* ---- places where the equations of motion determine no acceleration ---- */

typedef struct {
    const char *name, *text, *initial;
    double end;        /* where the motion reaches one; 0: it does not */
    const char *words;
} place_without_acceleration;

static const place_without_acceleration SINGULAR[] = {
    {"cone",
     "parameters: {a: 0.7}\ncoordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2 - z\n"
     "constraints: [\"z*z' = a^2*(x*x' + y*y')\"]\n",
     "x=0.8, y=0.6, z=0.7, x'=-0.8, y'=-0.6", 0.835877792354, "constraint z*z' = a^2*(x*x' + y*y') vanish"},
    {"beside the tip",
     "coordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2 - z\nconstraints: [\"z*z' = x*x' + y*y'\"]\n",
     "x=1, y=0, z=1, x'=-1, y'=0.001", 0, ""},
    {"crossing", "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\nconstraints: [\"x*y' + y*x' = 0\"]\n",
     "x=1, y=0, x'=-1", 1, "constraint x*y' + y*x' = 0 vanish"},
    {"vanishing row",
     "coordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2\nconstraints: [\"x*z' = x*y*x'\"]\n",
     "x=1, y=0.3, z=0, x'=-1, y'=0.2", 1.033734, "constraint x*z' = x*y*x' vanish"},
    {"two rows that meet",
     "coordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2\nconstraints: [\"y' = x*z'\", \"y' = -x*z'\"]\n",
     "x=1, y=0, z=0, x'=-0.7", 1.428571428571, "constraints are not independent"},
    {"mass that vanishes", "coordinates: [x, y]\nlagrangian: (x^2*x'^2 + y'^2)/2\n", "x=1, y=0, x'=-1, y'=1", 0.5,
     "mass matrix is singular, without inertia in x,"},
    {"mass that grows less", "coordinates: [x, y]\nlagrangian: (exp(-9*t)*x'^2 + y'^2)/2\n", "x=1, y=0, x'=-1, y'=1", 0,
     ""},
    {"gimbal",
     "coordinates: [{name: psi, type: angle}, {name: theta, type: angle}, {name: phi, type: angle}]\n"
     "definitions:\n  - w1 = psi'*sin(theta)*sin(phi) + theta'*cos(phi)\n"
     "  - w2 = psi'*sin(theta)*cos(phi) - theta'*sin(phi)\n  - w3 = psi'*cos(theta) + phi'\n"
     "lagrangian: (w1^2 + 1.5*w2^2 + 2*w3^2)/2\n",
     "psi=0, theta=1, phi=0, theta'=-1", 1, "mass matrix is singular, without inertia in psi, phi"},
};

/* Motions end there, by integrators with and without dense output, and say why; beside it they go on. */
Test(events, places_without_acceleration)
{
    static const char *const method[] = {"auto", "adams", "verner"};
    place p = place_make();
    for (size_t i = 0; i < sizeof SINGULAR / sizeof *SINGULAR; i++)
        for (size_t k = 0; k < sizeof method / sizeof *method; k++) {
            const place_without_acceleration *c = &SINGULAR[i];
            if (k && i % 2 == k - 1) continue;
            write_here(&p, "a.yaml", c->text);
            finished f = run_shell(&p, "$N simulate a.yaml --initial \"%s\" --until 2 --step 0.1 --method %s --json a.json",
                                   c->initial, method[k]);
            char *text = read_here(&p, "a.json");
            nh_json *root = text ? nh_json_parse(text) : NULL;
            const nh_json *time = nh_json_get(root, "time");
            size_t n = nh_json_count(time);
            double last = n ? nh_json_number_at(time, n - 1) : -1;
            cr_expect(f.code == (c->end > 0 ? 4 : 0), "%s, %s: code %d\n%s", c->name, method[k], f.code, f.err);
            if (c->end > 0) {
                cr_expect(strstr(f.err, c->words), "%s, %s: %s", c->name, method[k], f.err);
                cr_expect(last < c->end && last > c->end - 0.11, "%s, %s: last output %g", c->name, method[k], last);
            } else {
                cr_expect(fabs(last - 2) < 1e-12, "%s, %s: last output %g\n%s", c->name, method[k], last, f.err);
            }
            nh_json_free(root);
            free(text);
            finished_clear(&f);
        }
    place_clear(&p);
}

/* Members of an ensemble that pass the tip: where the pivot of the chart is small, errors would turn a motion back. */
Test(events, ensembles_keep_the_energy_near_a_pivot)
{
    place p = place_make();
    write_here(&p, "cone.yaml",
               "name: cone\ncoordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2 - z\n"
               "constraints: [\"z*z' = x*x' + y*y'\"]\n");
    finished f = run_shell(&p, "$N simulate cone.yaml --initial \"x=1, y=0, z=1, x'=-1\" --until 2 --step 2 --ensemble 8 "
                               "--csv a.csv");
    char *text = read_here(&p, "a.csv"), *line = text ? strtok(text, "\n") : NULL;
    double before = 0;
    size_t compared = 0;
    while (line && (line = strtok(NULL, "\n"))) {
        const char *last = strrchr(line, ',');
        double energy = last && last[1] ? strtod(last + 1, NULL) : NAN;
        int member = 0;
        double time = 0;
        cr_assert_eq(sscanf(line, "%d,%lf", &member, &time), 2, "%s", line);
        if (time > 0 && !isnan(energy)) {
            cr_expect(fabs(energy - before) < 1e-8, "%s after %.12g", line, before);
            compared++;
        }
        before = energy;
    }
    cr_expect(compared > 4, "%s", f.err);
    free(text);
    finished_clear(&f);
    place_clear(&p);
}

/* live: the model of a motion as JavaScript.  Node computes the motion of `export --to js`, and the program computes it; tests/live.js compares them.  Without
 * Node these tests are skipped. */
#include <cjson/cJSON.h>
#include <math.h>

#include "document/page.h"
#include "evaluate/tape.h"
#include "graph/dag.h"
#include "graph/function.h"
#include "program.h"
#include "sweep.h"

static bool node_exists(void) { return system("command -v node >/dev/null 2>&1") == 0; }

/* Of every shipped system that the sweep tries: the states of three motions, with other parameters and velocities, all velocities and the energy along them,
 * and the quantities that hold. */
Test(live, node_computes_the_same_motion)
{
    static const double bound = 1e-11, sensitive = 1e-9;
    /* nearby motions part, or pass near a singularity: no two integrators in double precision agree better */
    static const char *const sensitives[] = {"three_bodies"};
    if (!node_exists()) cr_skip_test("no Node");
    place p = place_with_systems();
    char *name[most_files];
    size_t n = list("systems", name), written = 0, motions = 0;
    for (size_t i = 0; i < n; free(name[i++])) {
        char line[200], shell[3 * PATH_MAX], model[PATH_MAX];
        if (!sweep_tries(i, 7, 40) || !strcmp(name[i], "whipple_bicycle")) continue; /* 100 kB of equations: minutes */
        snprintf(line, sizeof line, "export %s --to js --option work=300 -o .", name[i]);
        finished f = run(&p, line);
        snprintf(model, sizeof model, "%.3000s/%s.js", p.folder, name[i]);
        if (f.code == 4) cr_expect(strstr(f.err, "cannot be written in JavaScript") || strstr(f.err, "no motion"), "%s: %s", line, f.err);
        else cr_expect(f.code == 0 || f.code == 5, "%s: %d %s", line, f.code, f.err);
        finished_clear(&f);
        if (access(model, R_OK)) continue;
        written++;
        snprintf(shell, sizeof shell, "node '%.3000s/tests/live.js' %s.js '%.3000s' %s", p.project, name[i], p.program, name[i]);
        f = run_vector(&p, &(manner){0}, (char *[]){"sh", "-c", shell, NULL});
        cr_assert_eq(f.code, 0, "%s: %s", name[i], f.err);
        cJSON *seen = cJSON_Parse(f.out);
        cr_assert(seen, "%s", f.out);
        double most = bound, states = cJSON_GetNumberValue(cJSON_GetObjectItem(seen, "states")), drift = cJSON_GetNumberValue(cJSON_GetObjectItem(seen, "drift")),
               values = cJSON_GetNumberValue(cJSON_GetObjectItem(seen, "velocities"));
        for (size_t k = 0; k < sizeof sensitives / sizeof *sensitives; k++)
            if (!strcmp(name[i], sensitives[k])) most = sensitive;
        motions += (size_t)cJSON_GetNumberValue(cJSON_GetObjectItem(seen, "motions"));
        cr_expect_lt(states, most, "%s: states differ by %g", name[i], states);
        cr_expect_lt(values, 10 * most, "%s: velocities and energy differ by %g", name[i], values);
        cr_expect_lt(drift, 10 * most, "%s: a quantity drifts by %g", name[i], drift);
        cJSON_Delete(seen);
        finished_clear(&f);
    }
    fprintf(stderr, "measured: %zu models, %zu motions\n", written, motions);
    cr_expect_geq(motions, written, "%zu motions of %zu models", motions, written);
    place_clear(&p);
}

/* Elliptic integrals and the solutions of Riemann's equation at many arguments, beyond a quarter of a turn and below zero too. */
Test(live, functions_that_javascript_lacks)
{
    static const struct {
        nh_function function;
        const char *js;
        size_t arguments;
        double low[4], high[4];
    } functions[] = {
        {NH_ELLIPTIC_F, "ellipticF", 2, {-6, -3}, {6, 0.95}},
        {NH_ELLIPTIC_EINC, "ellipticE", 2, {-6, -3}, {6, 0.95}},
        {NH_ELLIPTIC_PI, "ellipticPi", 3, {-2, -1.4, -2}, {0.9, 1.4, 0.9}},
    };
    if (!node_exists()) cr_skip_test("no Node");
    enum { tries = 60 };
    place p = place_make();
    char *script = malloc(1 << 20), *at = script + sprintf(script, "%s\nvar far = [];\nfunction near(name, x, y) { if (!(Math.abs(x - y) <= 2e-13 * (1 + Math.abs(y)))) far.push([name, x, y]); }\n", nh_page_special);
    unsigned seed = 5;
    for (size_t i = 0; i < sizeof functions / sizeof *functions; i++) {
        static const char *const names[] = {"n", "u", "m"};
        nh_dag *d = nh_dag_create();
        nh_ex symbol[4];
        size_t n = functions[i].arguments;
        for (size_t j = 0; j < n; j++) symbol[j] = nh_symbol(d, names[3 - n + j]);
        nh_ex e = nh_call_any(d, functions[i].function, symbol);
        nh_tape *tape = nh_tape_create(d, n, symbol, 1, &e, 0, NULL, NULL);
        nh_tape_work *work = nh_tape_work_create(tape);
        for (int k = 0; k < tries; k++) {
            double x[3], y;
            for (size_t j = 0; j < n; j++) x[j] = functions[i].low[j] + (functions[i].high[j] - functions[i].low[j]) * (double)rand_r(&seed) / RAND_MAX;
            nh_tape_eval(tape, work, x, &y);
            if (!isfinite(y)) continue;
            at += sprintf(at, "near('%s', nhsymSpecial.%s(", functions[i].js, functions[i].js);
            for (size_t j = 0; j < n; j++) at += sprintf(at, "%s%.17g", j ? ", " : "", x[j]);
            at += sprintf(at, "), %.17g);\n", y);
        }
        nh_tape_work_free(work);
        nh_tape_free(tape);
        nh_dag_free(d);
    }
    sprintf(at, "console.log(far.length ? JSON.stringify(far.slice(0, 5)) : 'all equal');\n");
    write_here(&p, "special.js", script);
    finished f = run_vector(&p, &(manner){0}, (char *[]){"sh", "-c", "node special.js", NULL});
    cr_expect_str_eq(f.out, "all equal\n", "%s%s", f.out, f.err);
    finished_clear(&f);
    free(script);
    place_clear(&p);
}

/* What cannot be written is refused with the reason, and with what to write instead. */
Test(live, what_cannot_be_written)
{
    place p = place_with_systems();
    finished f = run_expecting(&p, "export sleigh --to js --of currents", 2);
    cr_expect(strstr(f.err, "one model"), "%s", f.err);
    finished_clear(&f);
    f = run_expecting(&p, "reduce crane --to js", 2);
    cr_expect(strstr(f.err, "export") && strstr(f.err, "--to js"), "%s", f.err);
    finished_clear(&f);
    write_here(&p, "airy.yaml", "name: airy\ncoordinates: [x]\nlagrangian: x'^2/2 - airy_ai(x)\n");
    f = run(&p, "export airy.yaml --to js");
    cr_expect(f.code != 0 && strstr(f.err, "airy_ai") && strstr(f.err, "--to python"), "%d %s", f.code, f.err);
    finished_clear(&f);
    place_clear(&p);
}

/* The first state has few digits, and t = 0 where the time does not occur; positions that equations bind have all theirs. */
Test(live, the_first_state_can_be_read)
{
    static const char *const names[] = {"pendulum", "kepler", "lagrange_top", "double_pendulum", "henon_heiles"};
    place p = place_with_systems();
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        char line[100];
        snprintf(line, sizeof line, "export %s --to js --option work=100", names[i]);
        finished f = run(&p, line);
        const char *at = strstr(f.out, "  initial: ["), *time = strstr(f.out, "  time: [0, ");
        cr_assert(at && time, "%s: %d %s", names[i], f.code, f.err);
        for (at += strlen("  initial: ["); *at != ']'; at += strspn(at, ", ")) {
            size_t digits = 0;
            bool leading = true;
            for (; *at != ',' && *at != ']'; at++) leading &= strchr("-0.", *at) != NULL, digits += !leading && *at != '.';
            cr_expect_leq(digits, 2u, "%s: %.60s", names[i], strstr(f.out, "  initial: "));
        }
        finished_clear(&f);
    }
    write_here(&p, "bound.yaml", "name: bound\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - y\nconstraints: [\"x^2 + y^2 = 2\"]\n");
    finished f = run_expecting(&p, "simulate bound.yaml --until 0.1 --json m.json", 0);
    finished_clear(&f);
    char *text = read_here(&p, "m.json");
    cJSON *json = cJSON_Parse(text), *states = cJSON_GetObjectItem(json, "states");
    double x = cJSON_GetNumberValue(cJSON_GetArrayItem(cJSON_GetObjectItem(states, "x"), 0)), y = cJSON_GetNumberValue(cJSON_GetArrayItem(cJSON_GetObjectItem(states, "y"), 0));
    cr_expect_float_eq(x * x + y * y, 2, 1e-12, "%g, %g", x, y);
    cJSON_Delete(json);
    free(text);
    place_clear(&p);
}

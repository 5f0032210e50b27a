/* cli_reduce: what `nhsym reduce` prints and returns about groups that will not do, and at its time limit. */
#include "program.h"

#include "oracle.h"
#include "sweep.h"

typedef struct {
    const char *system, *option, *value; /* one more option, or NULL */
    int code;
    const char *words[4]; /* all of them in what it complains about */
} refusal;

static finished reduce(const place *p, char **more, size_t count)
{
    static char path[PATH_MAX + 20];
    static const char *const environment[] = {path, NULL};
    char *argument[12] = {(char *)p->program, "reduce"};
    for (size_t i = 0; i < count; i++) argument[2 + i] = more[i];
    snprintf(path, sizeof path, "NHSYM_PATH=%s", p->project);
    return run_vector(p, &(manner){.environment = environment}, argument);
}

static const refusal refusals[] = {
    /* brackets: which one, and what it is */
    {"sleigh", "--group", "x=1; phi=1, x=-y, y=x", 3, {"these fields do not span a Lie algebra", "[d/dx, d/dphi - y d/dx + x d/dy] = d/dy is not a linear combination of them", "hint: add the bracket"}},
    {"crane", "--group", "x=1; phi1=1; theta=1, x=-y, y=x", 3, {"[d/dx, -y d/dx + x d/dy + d/dtheta] = d/dy is not a linear combination"}},
    {"two_wheel_cart", "--group", "y=1; h=1, x=-y, y=x", 3, {"[d/dy, -y d/dx + x d/dy + d/dh] = -d/dx is not a linear combination"}},
    {"kepler", "--group", "x=-y, y=x; y=-z, z=y", 3, {"these fields do not span a Lie algebra", "is not a linear combination of them"}},
    {"rolling_ball", "--group", "x=1; p=1, x=-y, y=x", 3, {"these fields do not span a Lie algebra", "= d/dy is not a linear combination of them"}},
    /* what is not left alone, and by how much */
    {"sleigh", "--group", "phi=1", 3, {"d/dphi is not a symmetry: it does not leave the kinetic energy invariant", "relative residual"}},
    {"snakeboard", "--group", "phi=1", 3, {"it does not leave the constraint distribution invariant"}},
    {"rolling_disk", "--group", "p=1", 3, {"it does not leave the constraint distribution invariant"}},
    {"euler_disk", "--group", "theta=1", 3, {"does not leave the kinetic energy invariant"}},
    {"kepler", "--group", "x=1", 3, {"d/dx is not a symmetry: it does not leave the potential invariant"}},
    {"ball_on_slope", "--group", "x=1", 3, {"d/dx is not a symmetry: it does not leave the potential invariant"}},
    {"skate_with_friction", "--group", "phi=1", 3, {"is not a symmetry"}},
    /* not free: everywhere, or where it starts; dependent fields are told apart */
    {"kepler", "--group", "x=-y, y=x; y=-z, z=y; z=-x, x=z", 3, {"the action is not free: 3 fields, but an orbit of dimension 2 at x = ", "hint: reduce by a subgroup"}},
    {"pendulum_in_space", "--group", "1, 1", 3, {"these fields are not independent: field 2", "is 1 times field 1", "hint: remove field 2"}},
    {"sleigh", "--group", "x=1; y=1; x=2, y=-3", 3, {"field 3, 2 d/dx - 3 d/dy, is 2 times field 1 + -3 times field 2"}},
    {"sleigh", "--group", "y=0", 3, {"field 1 is zero everywhere"}},
    /* chains */
    {"vertical_disk", "--chain", "1; 4; 2, 3", 3, {"a subgroup of the chain is not normal in the one before it: [e4, e2] has a component along e1"}},
    {"vertical_disk", "--chain", "1, 2", 2, {"must name every generator of the group once"}},
    /* an initial time: of a system that depends on the time it would be another motion */
    {"sleigh", "--initial", "t=2, omega=1", 2, {"--initial: reduce computes motions from t = 0 on, not from t = 2", "leave t out"}},
    /* states from which no motion starts: why, and what to do */
    {"kepler", "--initial", "x=0, y=0, z=0, x'=1", 4, {"no motion starts from this state: x = y = z = 0: x^2 + y^2 + z^2 = 0", "hint: start from other values"}},
    {"euler_disk", "--initial", "theta=0", 4, {"theta = 0: the mass matrix is singular, without inertia in", "hint: where `theta` is an Euler angle, or that of a pole, the coordinates are singular, not the motion"}},
    {"euler_top", "--initial", "h=0, h'=1", 4, {"h = 0: the mass matrix is singular, without inertia in p, s", "use other angles"}},
    {"calogero_moser", "--initial", "x=0, y=0", 4, {"x = y = 0: x - y = 0"}},
    /* not a group at all */
    {"sleigh", "--group", "", 2, {"give vector fields or numbers of generators"}},
    {"crane", "--group", "1, 7", 2, {"there is no generator 7; the group has 6"}},
    {"sleigh", "--group", "phj=1", 2, {"`phj` is not a coordinate", "did you mean `phi`?"}},
    {"sleigh", "--group", "x=y'", 2, {"the component of `x` contains a velocity"}},
    {"kepler", "--group", "x", 2, {"`x` is not a component of a vector field", "hint: write fields as `x=1; ...`"}},
};

Test(cli_reduce, groups_that_will_not_do, PLAIN_ONLY)
{
    place p = place_make();
    for (size_t i = 0; i < sizeof refusals / sizeof *refusals; i++) {
        const refusal *c = &refusals[i];
        char *more[] = {(char *)c->system, (char *)c->option, (char *)c->value, "--json", "-"};
        finished f = reduce(&p, more, 5);
        cr_expect_eq(f.code, c->code, "%s %s \"%s\": exit code %d, expected %d\n%s", c->system, c->option, c->value, f.code, c->code, f.err);
        cr_expect_str_eq(f.out, "", "%s \"%s\" printed\n%s", c->system, c->value, f.out);
        for (size_t w = 0; w < 4 && c->words[w]; w++) cr_expect(strstr(f.err, c->words[w]) != NULL, "%s %s \"%s\" complained\n%s", c->system, c->option, c->value, f.err);
        finished_clear(&f);
    }
    place_clear(&p);
}

/* Reduced and full motions agree to what is asked for, or it is said why not. */
Test(cli_reduce, accuracy)
{
    static const struct {
        const char *system, *accuracy;
        int code;
        const char *words;
    } cases[] = {{"sleigh", "1e-6", 0, NULL},
                 {"sleigh", "1e-10", 0, NULL},
                 {"snakeboard", "1e-8", 4, "the accuracy 1.0e-08 was not reached to the end: stage 1 was compared to t = 1.375"}, /* its constraints become dependent on the way */
                 {"sleigh", "1e-13", 2, "compared to 1e-12 at best"}};
    place p = place_make();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        if (!sweep_tries(i, 1, 3)) continue;
        char *more[] = {(char *)cases[i].system, "--accuracy", (char *)cases[i].accuracy, "--json", "-"};
        finished f = reduce(&p, more, 5);
        cr_expect_eq(f.code, cases[i].code, "%s %s: %d, %s", cases[i].system, cases[i].accuracy, f.code, f.err);
        if (cases[i].words) cr_expect(strstr(f.err, cases[i].words) != NULL, "%s", f.err);
        static const char *const key = "\"agreement_with_full\":";
        int stages = 0;
        for (const char *at = f.code == 0 ? f.out : ""; (at = strstr(at, key)); stages++) {
            double off = strtod(at + strlen(key), (char **)&at);
            cr_expect(off < atof(cases[i].accuracy), "%s %s: %g", cases[i].system, cases[i].accuracy, off);
        }
        cr_expect(f.code != 0 || stages == 2, "%d", stages);
        finished_clear(&f);
    }
    place_clear(&p);
}

/* The full motion and every stage say by which method they are computed, and agree to what is asked for: groups of several kinds, one and two stages, equations by stages, a quotient. */
Test(cli_reduce, accuracy_chooses_methods, PLAIN_ONLY)
{
    static const char *const cases[][2] = {{"sleigh", "1e-5"}, {"sleigh", "1e-10"}, {"suslov", "1e-8"}, {"kepler", "1e-5"}, {"kepler", "1e-10"}, {"crane_lagrangian", "1e-8"}, {"constant_speed", "1e-8"}};
    place p = place_make();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const char *system = cases[i][0], *eps = cases[i][1];
        char *more[] = {(char *)system, "--accuracy", (char *)eps, "--json", "-"};
        finished f = reduce(&p, more, 5);
        cr_assert_eq(f.code, 0, "%s %s: %d, %s", system, eps, f.code, f.err);
        cJSON *json = cJSON_Parse(f.out);
        const cJSON *full = oracle_get(json, "accuracy"), *stages = oracle_get(json, "stages"), *stage;
        cr_expect(cJSON_IsTrue(oracle_get(full, "held")) && oracle_number(full, "error") < atof(eps) / 4 && oracle_number(full, "evaluations") > 10, "%s %s", system, eps);
        cr_expect_float_eq(oracle_number(full, "wanted"), atof(eps), 1e-20);
        cr_expect(cJSON_GetArraySize(stages) > 0);
        cJSON_ArrayForEach(stage, stages) {
            const cJSON *choice = oracle_get(stage, "accuracy");
            const char *method = oracle_get(choice, "method")->valuestring, *why = oracle_get(choice, "why")->valuestring;
            cr_expect(cJSON_IsTrue(oracle_get(choice, "held")) && oracle_number(choice, "error") < atof(eps), "%s %s: %s", system, eps, why);
            cr_expect(strstr(why, method) == why && strstr(why, "agree") != NULL, "%s", why);
            cr_expect(oracle_number(choice, "evaluations") > 10 && oracle_number(choice, "runs") > 1 && oracle_number(choice, "seconds") > 0);
        }
        cJSON_Delete(json);
        finished_clear(&f);
    }
    place_clear(&p);
}

/* A dashpot that stops the relative motion of two masses within 1e-6: what is left when their common motion is divided out is stiff. */
Test(cli_reduce, accuracy_of_a_stiff_reduced_motion, WHOLE_ONLY)
{
    static const char text[] = "name: dashpot\nparameters: [{name: c, value: 500000}]\ncoordinates: [{name: x, type: length}, {name: y, type: length}]\n"
                               "lagrangian: (x'^2 + y'^2)/2 - (x - y)^2/2\nforces: [\"x = -c*(x' - y')\", \"y = c*(x' - y')\"]\n";
    place p = place_make();
    char file[PATH_MAX + 20];
    snprintf(file, sizeof file, "%s/dashpot.yaml", p.folder);
    FILE *out = fopen(file, "w");
    cr_assert(out && fputs(text, out) >= 0 && fclose(out) == 0);
    char *more[] = {file, "--accuracy", "1e-8", "--json", "-"};
    finished f = reduce(&p, more, 5);
    cr_assert_eq(f.code, 0, "%s", f.err);
    cJSON *json = cJSON_Parse(f.out);
    const char *method = oracle_get(oracle_get(cJSON_GetArrayItem(oracle_get(json, "stages"), 0), "accuracy"), "method")->valuestring;
    cr_expect(!strcmp(method, "CVODE BDF") || !strcmp(method, "CVODE Adams") || strstr(method, "ESDIRK"), "%s", method);
    cJSON_Delete(json);
    finished_clear(&f);
    place_clear(&p);
}

/* Euler's disk passes so near to the vertical that no method knows its motion to 1e-10: what is known, and from when on it is not. */
Test(cli_reduce, accuracy_that_cannot_be_had, PLAIN_ONLY)
{
    place p = place_make();
    char *more[] = {"euler_disk", "--accuracy", "1e-10"};
    finished f = reduce(&p, more, 3);
    cr_expect_eq(f.code, 4, "%d", f.code);
    cr_expect(strstr(f.err, "the accuracy 1.0e-10 was not reached to the end: stage 1 was compared to t = ") && strstr(f.err, "the time up to which the full motion is known"), "%s", f.err);
    cr_expect(strstr(f.out, "the full motion is not known to 2.5e-11: GSL rk8pd at tolerance") != NULL, "%s", f.out);
    finished_clear(&f);
    place_clear(&p);
}

/* The axis of a rotation: refused for a given group, a warning for one that was found. */
Test(cli_reduce, starts_where_the_action_is_not_free)
{
    place p = place_make();
    char *given[] = {"isotropic_oscillator", "--group", "x=-y, y=x", "--initial", "x=0, y=0, z=1"};
    finished f = reduce(&p, given, 5);
    cr_expect_eq(f.code, 3);
    cr_expect(strstr(f.err, "the action is not free: 1 field, but an orbit of dimension 0 at x = 0, y = 0, z = 1") && strstr(f.err, "choose an initial state that is not fixed by the fields"), "%s", f.err);
    finished_clear(&f);
    char *found[] = {"isotropic_oscillator", "--initial", "x=0, y=0, z=0"};
    f = reduce(&p, found, 3);
    cr_expect_eq(f.code, 0);
    cr_expect(strstr(f.out, "at the initial position, the action is not free: 3 fields, but an orbit\n"), "%s", f.out);
    finished_clear(&f);
    place_clear(&p);
}

/* Euler's angles are singular where sin(theta) = 0: ways across that place are left out. */
Test(cli_reduce, around_singular_angles, PLAIN_ONLY)
{
    static const char *const interval[] = {"-1, 1", "-3, 3", "-0.3, 0.3"};
    place p = place_make();
    for (size_t i = 0; i < sizeof interval / sizeof *interval; i++) {
        char text[900];
        snprintf(text, sizeof text,
                 "name: body\ncoordinates: [{name: psi, type: angle}, {name: theta, type: angle}, {name: phi, type: angle}]\n"
                 "definitions:\n  - w1 = psi'*sin(theta)*sin(phi) + theta'*cos(phi)\n"
                 "  - w2 = psi'*sin(theta)*cos(phi) - theta'*sin(phi)\n  - w3 = psi'*cos(theta) + phi'\n"
                 "lagrangian: (1.3*w1^2 + 1.7*w2^2 + 2*w3^2)/2\ndomain: {theta: [%s]}\n",
                 interval[i]);
        write_here(&p, "body.yaml", text);
        finished f = reduce(&p, (char *[]){"body.yaml"}, 1);
        cr_expect(f.code == 0 && strstr(f.out, "SO(3), of dimension 3"), "%s: %s%s", interval[i], f.out, f.err);
        finished_clear(&f);
    }
    place_clear(&p);
}

/* Exit code 5: little was found until then, which is marked, or nothing, and nothing is printed. */
Test(cli_reduce, time_limit)
{
    static const char *const systems[] = {"crane", "sleigh", "snakeboard", "kepler"};
    place p = place_make();
    for (size_t i = 0; i < sizeof systems / sizeof *systems; i++) {
        char *more[] = {(char *)systems[i], "--max-seconds", "0", "--json", "-"};
        finished f = reduce(&p, more, 5);
        cr_expect_eq(f.code, 5, "%s: exit code %d\n%s", systems[i], f.code, f.err);
        cJSON *json = *f.out ? cJSON_Parse(f.out) : NULL;
        cr_expect(*f.out ? cJSON_IsTrue(cJSON_GetObjectItem(json, "partial")) : strstr(f.err, "time limit") && strstr(f.err, "raise it by --max-seconds"), "%s: %s%s", systems[i], f.out, f.err);
        cJSON_Delete(json);
        finished_clear(&f);
    }
    place_clear(&p);
}

/* The momentum map is that of the Lagrangian, whatever stands in it; and what is only a symmetry of the equations is counted. */
Test(cli_reduce, momenta_of_any_lagrangian, PLAIN_ONLY)
{
    static const struct {
        const char *system, *momentum;
        size_t which, weaker;
    } cases[] = {{"charged_particle", "m*(x*y' - y*x') + B*(x^2 + y^2)/2", 1, 2}, {"relativistic_charge", "m*y'/sqrt(1 - x'^2 - y'^2)", 0, 0}, {"crane", NULL, 0, 0}};
    place p = place_make();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char *more[] = {(char *)cases[i].system, "--json", "-"};
        finished f = reduce(&p, more, 3);
        cr_expect_eq(f.code, 0);
        cJSON *json = cJSON_Parse(f.out);
        cr_assert(json != NULL, "%s printed\n%s", cases[i].system, f.out);
        const cJSON *group = oracle_get(json, "group"), *local = oracle_get(group, "local"), *map = oracle_get(group, "momentum_map");
        if (cases[i].momentum) cr_expect_str_eq(cJSON_GetArrayItem(map, (int)cases[i].which)->valuestring, cases[i].momentum);
        if (!cJSON_IsNull(local)) cr_expect_eq(oracle_number(local, "up_to_a_total_derivative"), (double)cases[i].weaker);
        cJSON_Delete(json);
        finished_clear(&f);
    }
    place_clear(&p);
}

/* The constraint x'^2 + y'^2 = c^2 has two velocities y' for each x': the equations say for which they are. */
Test(cli_reduce, the_branch_of_the_equations_is_named)
{
    place p = place_make();
    write_here(&p, "own.yaml", "name: own\nparameters: [{name: c, value: 2}, {name: g, value: 1.5}]\ncoordinates: [{name: x, type: length}, {name: y, type: length}]\n"
                               "lagrangian: (x'^2 + y'^2)/2 - g*y\nconstraints: [\"x'^2 + y'^2 = c^2\"]\ndependent: [y]\n");
    for (int up = 0; up < 2; up++) {
        finished f = run_expecting(&p, up ? "reduce -v own.yaml --initial x=0,y=0,x'=0,y'=2" : "reduce -v own.yaml --initial x=0,y=0,x'=0,y'=-2", 0);
        cr_expect_not_null(strstr(f.out, up ? "\n  y' = sqrt(c^2 - x'^2)\n" : "\n  y' = -sqrt(c^2 - x'^2)\n"), "%s", f.out);
        cr_expect_not_null(strstr(f.out, up ? "hold on the branch y' > 0," : "hold on the branch y' < 0,"), "%s", f.out);
        finished_clear(&f);
    }
    place_clear(&p);
}

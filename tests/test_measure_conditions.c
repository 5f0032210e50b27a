/* For which parameters a reduced system has an invariant measure, or becomes Hamiltonian: against numbers that this file computes from the printed metric and
 * Upsilon, at the program's values of the parameters and at those that its conditions name. */
#include "reduced_sheet.h"
#include "sweep.h"

#include <math.h>

#include "base/linalg.h"
#include "graph/node.h"

enum { most = 4, most_parameters = 24 };

/* A stage, with values of the parameters that may be changed. */
typedef struct {
    reduced_sheet s;
    size_t n;
    size_t x[most];          /* index of each shape coordinate among the symbols */
    const nh_ex *parameter;
    double value[most_parameters];
} stage;

static stage open_stage(const char *file, const char *line, size_t index)
{
    stage g = {.s = reduced_of(file, 0, NULL, line, index)};
    const cJSON *name;
    const double *numbers;
    nh_system_bindings(g.s.system, &g.parameter, &numbers);
    cr_assert_leq(g.s.system->parameters, (size_t)most_parameters);
    memcpy(g.value, numbers, g.s.system->parameters * sizeof *numbers);
    cJSON_ArrayForEach(name, oracle_get(g.s.stage, "shape"))
        for (size_t i = 0; i < g.s.system->coordinates; i++)
            if (!strcmp(g.s.system->coordinate[i].name, name->valuestring)) g.x[g.n++] = 2 * i;
    return g;
}

static double *parameter_named(stage *g, const char *name)
{
    for (size_t i = 0; i < g->s.system->parameters; i++)
        if (!strcmp(nh_name_of(g->s.system->dag, g->parameter[i]), name)) return &g->value[i];
    cr_assert_fail("there is no parameter %s", name);
    return NULL;
}

static double value_with(const stage *g, const char *text)
{
    nh_error error = {0};
    nh_ex e;
    double out;
    must(nh_system_expression_text(g->s.system, "test", text, 0, NULL, &e, &error), &error, text);
    nh_tape *tape = nh_tape_create(g->s.system->dag, g->s.symbols, g->s.symbol, 1, &e, g->s.system->parameters, g->parameter, g->value);
    nh_tape_work *work = nh_tape_work_create(tape);
    nh_tape_eval(tape, work, g->s.value, &out);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    return out;
}

/* T^k_ij = (K^-1)^kl U_lij at the place: T[k + n (i + n j)]. */
static void tensor(stage *g, double *T)
{
    size_t n = g->n;
    double K[most * most], rcond;
    const cJSON *row, *entry, *metric = oracle_get(g->s.stage, "metric");
    for (size_t i = 0; i < g->s.system->coordinates; i++) g->s.value[2 * i + 1] = 0;
    for (size_t i = 0; i < n; i++) {
        row = cJSON_GetArrayItem(metric, (int)i);
        for (size_t j = 0; j < n; j++) K[i + j * n] = value_with(g, cJSON_GetArrayItem(row, (int)j)->valuestring);
    }
    memset(T, 0, n * n * n * sizeof *T);
    cJSON_ArrayForEach(entry, oracle_get(g->s.stage, "upsilon")) {
        size_t i = 0, j = 0;
        for (size_t k = 0; k < n; k++) {
            const char *name = g->s.system->coordinate[g->x[k] / 2].name;
            if (!strcmp(text_of(entry, "i"), name)) i = k;
            if (!strcmp(text_of(entry, "j"), name)) j = k;
        }
        for (size_t l = 0; l < n; l++) {
            g->s.value[g->x[l] + 1] = 1;
            T[l + n * (i + n * j)] = value_with(g, text_of(entry, "value"));
            T[l + n * (j + n * i)] = -T[l + n * (i + n * j)];
            g->s.value[g->x[l] + 1] = 0;
        }
    }
    cr_assert(nh_solve(n, K, n * n, T, &rcond));
}

static void traces(stage *g, double *T, double *Theta)
{
    tensor(g, T);
    for (size_t j = 0; j < g->n; j++) {
        Theta[j] = 0;
        for (size_t i = 0; i < g->n; i++) Theta[j] += T[i + g->n * (i + g->n * j)];
    }
}

/* The largest d_i Theta_j - d_j Theta_i by differences, and the largest part of T beside its traces. */
static void residuals(stage *g, double *curl, double *rest)
{
    static const double step = 1e-5;
    size_t n = g->n;
    double T[most * most * most], Theta[2][most], slope[most][most];
    for (size_t i = 0; i < g->s.system->coordinates; i++) g->s.value[2 * i] = 0.4 + 0.17 * (double)i;
    for (size_t i = 0; i < n; i++) {
        double at = g->s.value[g->x[i]];
        for (int side = 0; side < 2; side++) {
            g->s.value[g->x[i]] = at + (side ? step : -step);
            traces(g, T, Theta[side]);
        }
        g->s.value[g->x[i]] = at;
        for (size_t j = 0; j < n; j++) slope[i][j] = (Theta[1][j] - Theta[0][j]) / (2 * step);
    }
    traces(g, T, Theta[0]);
    *curl = *rest = 0;
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++) {
            *curl = fmax(*curl, fabs(slope[i][j] - slope[j][i]));
            for (size_t k = 0; k < n; k++) {
                double want = ((k == i) * Theta[0][j] - (k == j) * Theta[0][i]) / (double)(n - 1);
                *rest = fmax(*rest, fabs(T[k + n * (i + n * j)] - want));
            }
        }
}

static const char *where(const stage *g, const char *key)
{
    static char text[2][1000];
    char *to = text[!strcmp(key, "factor_where")], *all = cJSON_PrintUnformatted(oracle_get(oracle_get(g->s.stage, "measure"), key));
    char *at = to;
    for (const char *c = all; *c; c++)
        if (*c != ' ') *at++ = *c;
    *at = 0;
    free(all);
    return to;
}

/* Eighteen parameters, four shape coordinates: exactly which values have a measure, and that no positive ones do. */
Test(measure_conditions, crane, PLAIN_ONLY)
{
    static const char *const line = " --group x=1;y=1;phi1=1;psi3=1;x=-y,y=x,theta=1";
    stage g = open_stage("systems/crane.yaml", line, 0);
    const cJSON *measure = oracle_get(g.s.stage, "measure");
    double curl, rest, b = *parameter_named(&g, "b"), l = *parameter_named(&g, "l"), l0 = *parameter_named(&g, "l0"), l1 = *parameter_named(&g, "l1");
    double m1 = *parameter_named(&g, "m1"), m2 = *parameter_named(&g, "m2"), m3 = *parameter_named(&g, "m3"), m4 = *parameter_named(&g, "m4"), m6 = *parameter_named(&g, "m6");
    cr_assert_not_null(strstr(where(&g, "measure_where"), "[\"l\"],[\"b\"],[\"2*jy4+b^2*(m1+m2+m3+2*m4+m6)\"]"), "%s", where(&g, "measure_where"));
    cr_assert_not_null(strstr(where(&g, "factor_where"), "[\"jz1+l0^2*m1+l1^2*(m3+m6)-l^2*(m1+m3+m6)\"]"), "%s", where(&g, "factor_where"));
    cr_expect(cJSON_IsTrue(oracle_get(measure, "never")) && cJSON_IsTrue(oracle_get(measure, "never_hamiltonian")));
    residuals(&g, &curl, &rest);
    cr_expect(curl > 1e-3 && rest > 1e-3, "%g %g", curl, rest);
    double *jy4 = parameter_named(&g, "jy4"), *jz1 = parameter_named(&g, "jz1"), positive = *jy4;
    *jy4 = -b * b * (m1 + m2 + m3 + 2 * m4 + m6) / 2; /* a measure, no factor */
    residuals(&g, &curl, &rest);
    cr_expect(curl < 1e-8 && rest > 1e-3, "%g %g", curl, rest);
    *jz1 = l * l * (m1 + m3 + m6) - l0 * l0 * m1 - l1 * l1 * (m3 + m6); /* where both conditions for a factor hold det Khat = 0; here the second one alone */
    *jy4 = positive;
    residuals(&g, &curl, &rest);
    cr_expect(curl > 1e-3 && rest > 1e-3, "%g %g", curl, rest);
    reduced_clear(&g.s);
}

/* A condition that positive values can meet is not said to be met by none. */
Test(measure_conditions, positive_values, PLAIN_ONLY)
{
    static const struct {
        const char *weight;
        bool never;
    } cases[] = {{"(e - k)", false}, {"(e + k)", true}, {"(e^2 - 2*e*k + 2*k^2)", false}, {"(k - e)*e", false}, {"e*k", true}, {"7", true}, {"sin(e)", false}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[600];
        snprintf(text, sizeof text, "name: weighted\nparameters: [{name: e, value: 0.7}, {name: k, value: 0.2}]\ncoordinates: [{name: x, type: length}, {name: y, type: length}, {name: z, type: length}]\n"
                 "domain: {x: [0.2, 0.6], y: [0.2, 0.6]}\nlagrangian: ((1 + %s*x^2)*x'^2 + y'^2 + z'^2)/2\nconstraints: [\"z' = y*x'\"]\n", cases[i].weight);
        reduced_sheet s = reduced_from("own.yaml", text, 0, NULL, " --group z=1", 0);
        cr_expect_eq((bool)cJSON_IsTrue(oracle_get(oracle_get(s.stage, "measure"), "never")), cases[i].never, "%s", cases[i].weight);
        reduced_clear(&s);
    }
}

/* Without the mass m there is no kinetic energy of y: m = 0 is no way to a measure, and k = 0 contains "k = 0 and k + 1 = 0". */
Test(measure_conditions, zeros_that_the_system_excludes, PLAIN_ONLY)
{
    static const struct {
        const char *energy, *ways;
    } cases[] = {{"x'^2 + m*(1 + x^2)*y'^2 + z'^2", "[[[\"k\"],[\"k - 1\"]]]"}, {"x'^2 + (1 + m*x^2)*y'^2 + z'^2", "[[[\"k\"],[\"m*k\",\"k + 1\"],[\"k - 1\"]]]"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[600];
        snprintf(text, sizeof text, "name: heavy\nparameters: {m: 1.3, k: 0.4}\ncoordinates: [x, y, z]\nlagrangian: (%s)/2\nconstraints: [\"z' = x*y' + k*y*x'\"]\n", cases[i].energy);
        reduced_sheet s = reduced_from("own.yaml", text, 0, NULL, " --group z=1", 0);
        char *ways = cJSON_PrintUnformatted(oracle_get(oracle_get(s.stage, "measure"), "measure_where"));
        cr_expect_str_eq(ways, cases[i].ways);
        free(ways);
        reduced_clear(&s);
    }
}

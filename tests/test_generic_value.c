/* generic_value: what is not zero, and what is zero although it does not look so; and what is known of the crane's measure. */
#include <cjson/cJSON.h>

#include "exact/generic_value.h"
#include "graph/dag.h"
#include "mechanics.h"
#include "program.h"
#include "sweep.h"

static const char PLANE[] = "name: plane\nparameters: [{name: k, value: 1}]\ncoordinates: [{name: x, type: length}, {name: y, type: length}, {name: f, type: angle}]\n"
                            "lagrangian: (x'^2 + y'^2 + f'^2)/2\n";

Test(generic_value, zero_in_disguise_and_not)
{
    static const char *const zero[] = {"0", "sin(f)^2 + cos(f)^2 - 1", "sin(2*f)*k - 2*k*sin(f)*cos(f)", "(x + y)^3 - x^3 - 3*x^2*y - 3*x*y^2 - y^3", "exp(x)*exp(-x) - 1",
                                       "log(x*y) - log(x) - log(y)", "atan(tan(f)) - f", "sqrt(x^2*y) - x*sqrt(y)"};
    static const char *const other[] = {"(k - 1)*x", "sin(f)*cos(f)", "sin(f/2)^2 - cos(f)", "exp(k*x) - 1", "(x + y)^3 - x^3 - y^3", "1/(x - k*y)", "sqrt(1 + x^2) - y"};
    mechanics x = mechanics_of_text(PLANE, NH_CHART_COORDINATES);
    nh_ex q[3];
    for (size_t s = 0; s < 3; s++) q[s] = x.system->coordinate[s].q;
    for (size_t i = 0; i < sizeof zero / sizeof *zero; i++) {
        nh_ex e = formula(x.model, zero[i]);
        cr_expect(!nh_generic_nonzero(x.model->dag, 1, &e, 3, q), "%s is zero for some signs at least", zero[i]);
    }
    for (size_t i = 0; i < sizeof other / sizeof *other; i++) {
        nh_ex e[2] = {nh_int(x.model->dag, 0), formula(x.model, other[i])};
        cr_expect(nh_generic_nonzero(x.model->dag, 2, e, 3, q), "%s", other[i]);
    }
    mechanics_clear(&x);
}

Test(generic_value, the_crane_has_no_measure_for_positive_parameters, PLAIN_ONLY)
{
    place p = place_with_systems();
    finished f = run(&p, "reduce -v crane --until 1 --json=r.json");
    cr_assert_eq(f.code, 0, "%s", f.err);
    cr_expect(strstr(f.out, "none exists for positive values of the parameters"), "%s", f.out);
    finished_clear(&f);
    char *json = read_here(&p, "r.json");
    cJSON *root = cJSON_Parse(json);
    const cJSON *stage = cJSON_GetArrayItem(cJSON_GetObjectItem(root, "stages"), 0), *measure = cJSON_GetObjectItem(stage, "measure");
    cr_expect(cJSON_IsFalse(cJSON_GetObjectItem(measure, "exists")));
    cr_expect(cJSON_IsTrue(cJSON_GetObjectItem(measure, "never")));
    cJSON_Delete(root);
    free(json);
    place_clear(&p);
}

/* ---- angles that are rational multiples of pi ---- */

/* The same residues serve cosines and the square roots that they contain: 4 cos(pi/5) = 1 + sqrt(5), and not 1 - sqrt(5). */
Test(generic_value, cosines_of_fractions_of_pi_are_algebraic)
{
    static const char *const zero[] = {
        "4*cos(pi/5) - 1 - sqrt(5)", "4*sin(pi/10) + 1 - sqrt(5)", "8*cos(pi/7)^3 - 4*cos(pi/7)^2 - 4*cos(pi/7) + 1", "4*cos(pi/12) - sqrt(6) - sqrt(2)",
        "4*cos(pi/8)^2 - 2 - sqrt(2)", "8*sin(pi/7)*sin(2*pi/7)*sin(3*pi/7) - sqrt(7)", "tan(3*pi/11) + 4*sin(2*pi/11) - sqrt(11)",
        "x*cos(f + pi/9) - x*cos(f)*cos(pi/9) + x*sin(f)*sin(pi/9)", "cos(pi/9)*cos(2*pi/9)*cos(4*pi/9) - 1/8", "sin(pi)*x", "8*sin(3*pi/10)*cos(pi/5) - 3 - sqrt(5)"};
    static const char *const other[] = {"4*cos(pi/5) - 1 + sqrt(5)", "cos(pi/10) - sin(pi/10)", "cos(pi/180)*x - y", "8*cos(pi/7)^3 - 4*cos(pi/7)^2 - 4*cos(pi/7)",
                                        "tan(3*pi/11) + 4*sin(2*pi/11) + sqrt(11)", "x*cos(f + 0.3*pi) - x*cos(f)"};
    mechanics x = mechanics_of_text(PLANE, NH_CHART_COORDINATES);
    nh_ex q[3];
    for (size_t s = 0; s < 3; s++) q[s] = x.system->coordinate[s].q;
    for (size_t i = 0; i < sizeof zero / sizeof *zero; i++) {
        nh_ex e = formula(x.model, zero[i]);
        cr_expect(!nh_generic_nonzero(x.model->dag, 1, &e, 3, q), "%s is zero", zero[i]);
    }
    for (size_t i = 0; i < sizeof other / sizeof *other; i++) {
        nh_ex e = formula(x.model, other[i]);
        cr_expect(nh_generic_nonzero(x.model->dag, 1, &e, 3, q), "%s is not", other[i]);
    }
    mechanics_clear(&x);
}

Test(generic_value, ranks_of_matrices)
{
    static const struct {
        size_t rows, columns, rank;
        const char *entry[9];
    } cases[] = {{2, 2, 2, {"1", "1", "1", "1 + 1e-15"}},
                 {2, 2, 1, {"x", "x*y", "sin(f)^2 + cos(f)^2", "y"}},
                 {3, 3, 2, {"1", "2", "3", "4", "5", "6", "7", "8", "9"}},
                 {2, 3, 2, {"cos(pi/5)", "1", "x", "1/4 + sqrt(5)/4", "1", "x + 1e-12*y"}},
                 {2, 2, 1, {"cos(pi/5)", "x", "1/4 + sqrt(5)/4", "x"}}};
    mechanics x = mechanics_of_text(PLANE, NH_CHART_COORDINATES);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        nh_ex e[9];
        size_t rank, total = cases[i].rows * cases[i].columns;
        for (size_t j = 0; j < total; j++) e[j] = formula(x.model, cases[i].entry[j]);
        cr_assert(nh_generic_rank(x.model->dag, cases[i].rows, cases[i].columns, e, &rank), "case %zu", i);
        cr_expect_eq(rank, cases[i].rank, "case %zu: %zu", i, rank);
    }
    mechanics_clear(&x);
}

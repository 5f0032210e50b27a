/* source: C that computes what the tape computes; names; long sums in pieces. */
#include <criterion/criterion.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "evaluate/tape.h"
#include "document/source.h"
#include "graph/dag.h"
#include "scratch.h"
#include "typed.h"

/* Formulas of some symbols at one place: by the tape, and by a program whose names are those of the language. */
static void compare(nh_dag *d, size_t inputs, const char *const *names, const double *value, size_t count,
                    const char *const *formulas, size_t least_statements)
{
    nh_ex e[40], in[8];
    double got[40], want[40];
    nh_text code, body;
    nh_text_init(&code);
    nh_text_init(&body);
    for (size_t i = 0; i < inputs; i++) in[i] = nh_symbol(d, names[i]);
    for (size_t i = 0; i < count; i++) e[i] = ex(d, formulas[i]);
    nh_source *w = nh_source_create(&nh_source_c, d, &body);
    nh_source_indent(w, "    ");
    const char *out = nh_source_word(w, "out");
    for (size_t i = 0; i < inputs; i++)
        nh_text_addf(&body, "    const double %s = %.17g;\n", nh_source_name(w, in[i]), value[i]);
    nh_source_plan(w, count, e);
    nh_source_parts(w, count, e);
    size_t statements = 0;
    for (const char *at = nh_text_string(&body); (at = strstr(at, "const double s")); at++) statements++;
    cr_expect_geq(statements, least_statements, "%zu statements:\n%s", statements, nh_text_string(&body));
    for (size_t i = 0; i < count; i++) {
        nh_text_addf(&body, "    %s[%zu] = ", out, i);
        nh_source_put(w, e[i]);
        nh_text_add(&body, ";\n");
    }
    nh_text_addf(&code, "#include <math.h>\n#include <stdio.h>\n%sint main(void)\n{\n    double %s[%zu];\n%s",
                 nh_source_has_sign(w) ? "static double nh_sign(double x) { return x > 0 ? 1 : x < 0 ? -1 : x; }\n"
                                       : "",
                 out, count, nh_text_string(&body));
    nh_text_addf(&code, "    for (int i_ = 0; i_ < %zu; i_++) printf(\"%%.17g\\n\", %s[i_]);\n    return 0;\n}\n",
                 count, out);
    cr_assert_eq(scratch_run_c(nh_text_string(&code), got, count), (long)count, "%s", nh_text_string(&code));
    nh_tape *tape = nh_tape_create(d, inputs, in, count, e, 0, NULL, NULL);
    nh_tape_work *work = nh_tape_work_create(tape);
    nh_tape_eval(tape, work, value, want);
    for (size_t i = 0; i < count; i++)
        cr_expect_float_eq(got[i], want[i], 4e-15 * (1 + fabs(want[i])), "%s: %.17g, not %.17g\n%s", formulas[i],
                           got[i], want[i], nh_text_string(&code));
    nh_tape_work_free(work);
    nh_tape_free(tape);
    nh_source_free(w);
    nh_text_clear(&code);
    nh_text_clear(&body);
}

Test(source, c_computes_the_same)
{
    static const char *const formulas[] = {"x'^2/2 + y*sin(x)^3",
                                           "sqrt(1 + x^2)*exp(-y/3)",
                                           "(x + y)^-2 + 1/(x + y)",
                                           "atan2(y, x) + abs(x - y)",
                                           "2^x*x^y",
                                           "-x + 3*y - 7/4",
                                           "pi*x/(2*y) - 1e-3",
                                           "tan(x + y)/(cosh(x') + log(y))",
                                           "int*double^2 - x'*(int + double)",
                                           "(x + y)^(1/2)*(x + y)^(1/3)",
                                           "4",
                                           "x/y/x'",
                                           "-(x*y)^3/(1 + (x*y)^2)",
                                           "(x^2 + y^2)^(-3/2)",
                                           "sign(x') + sign(x)",
                                           "x - (y - (x' - 1/3))",
                                           "-(x - y)/(2*x)",
                                           "1/x^3",
                                           "(-x)^3*y^-1",
                                           "asinh(x) + acosh(1 + y) + atanh(x/3) + asin(x) + acos(x/2)",
                                           "-2*(x - 3*y)*(-x')",
                                           "x^(-1/2)*y^(5/2)",
                                           "-x'^5 + (x*y)^7/3"};
    static const char *const names[5] = {"x", "y", "x'", "int", "double"};
    const double value[5] = {0.7315, 1.618, -0.377, 2.25, 0.915};
    nh_dag *d = nh_dag_create();
    compare(d, 5, names, value, sizeof formulas / sizeof *formulas, formulas, 1);
    nh_dag_free(d);
}

/* Keywords of C and C++, macros, functions that the code calls, names of the code itself. */
Test(source, names_of_the_language)
{
    static const char *const names[8] = {"pow", "fabs", "s1", "out", "NAN", "and", "x_dot", "x'"};
    static const char *const formulas[] = {"pow^3 + fabs*s1 - out/NAN + and*x_dot - x'", "abs(pow - fabs)^and",
                                           "(s1 + out)*(NAN + and)*(s1 + out)"};
    const double value[8] = {1.5, 0.25, 2.5, -0.75, 3.25, 0.5, 1.125, 4.5};
    nh_dag *d = nh_dag_create();
    compare(d, 8, names, value, 3, formulas, 1);
    nh_dag_free(d);
}

/* Many terms, and deep nests, in statements of bounded length. */
Test(source, long_formulas_are_cut)
{
    static const char *const names[2] = {"x", "y"};
    const double value[2] = {0.3, 1.7};
    nh_dag *d = nh_dag_create();
    nh_text sum, nest;
    nh_text_init(&sum);
    nh_text_init(&nest);
    nh_text_add(&sum, "1");
    for (int i = 1; i < 200; i++) nh_text_addf(&sum, " + sin(%d*x)*y/%d", i, i);
    for (int i = 0; i < 150; i++) nh_text_add(&nest, "sin(1 + x*");
    nh_text_add(&nest, "y");
    for (int i = 0; i < 150; i++) nh_text_add(&nest, ")");
    const char *const formulas[] = {nh_text_string(&sum), nh_text_string(&nest)};
    compare(d, 2, names, value, 2, formulas, 8);
    nh_text_clear(&sum);
    nh_text_clear(&nest);
    nh_dag_free(d);
}

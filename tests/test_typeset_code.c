/* typeset: C that computes what the tape computes. */
#include <criterion/criterion.h>

#include <math.h>
#include <stdio.h>

#include "base/memory.h"
#include "evaluate/tape.h"
#include "document/typeset_code.h"
#include "scratch.h"
#include "typed.h"

Test(typeset, c_computes_the_same)
{
    static const char *const formulas[] = {
        "x'^2/2 + y*sin(x)^3", "sqrt(1 + x^2)*exp(-y/3)", "(x + y)^-2 + 1/(x + y)", "atan2(y, x) + abs(x - y)", "2^x*x^y", "-x + 3*y - 7/4", "pi*x/(2*y) - 1e-3",
        "tan(x + y)/(cosh(x') + log(y))", "int*double^2 - x'*(int + double)", "(x + y)^(1/2)*(x + y)^(1/3)", "4", "x/y/x'", "-(x*y)^3/(1 + (x*y)^2)"};
    enum { count = sizeof formulas / sizeof *formulas };
    nh_dag *d = nh_dag_create();
    nh_ex e[count], in[5];
    static const char *const names[5] = {"x", "y", "x'", "int", "double"};
    const double value[5] = {0.7315, 1.618, -0.377, 2.25, 0.915};
    const char *target[count];
    char buffer[count][20];
    nh_text code;
    size_t temporaries = 0;
    nh_text_init(&code);
    for (size_t i = 0; i < 5; i++) in[i] = nh_symbol(d, names[i]);
    nh_text_add(&code, "#include <math.h>\n#include <stdio.h>\nint main(void)\n{\n");
    for (size_t i = 0; i < 5; i++) {
        nh_text_add(&code, "    double ");
        nh_typeset_c_name(names[i], &code);
        nh_text_addf(&code, " = %.17g;\n", value[i]);
    }
    nh_text_addf(&code, "    double out[%d];\n", count);
    for (size_t i = 0; i < count; i++) {
        e[i] = ex(d, formulas[i]);
        snprintf(buffer[i], sizeof buffer[i], "out[%zu]", i);
        target[i] = buffer[i];
    }
    nh_typeset_c(d, count, e, target, &temporaries, &code);
    nh_text_addf(&code, "    for (int i = 0; i < %d; i++) printf(\"%%.17g\\n\", out[i]);\n    return 0;\n}\n", count);
    double got[count], want[count];
    cr_assert_eq(scratch_run_c(nh_text_string(&code), got, count), (long)count, "%s", nh_text_string(&code));
    nh_tape *tape = nh_tape_create(d, 5, in, count, e, 0, NULL, NULL);
    nh_tape_work *work = nh_tape_work_create(tape);
    nh_tape_eval(tape, work, value, want);
    for (size_t i = 0; i < count; i++) cr_expect_float_eq(got[i], want[i], 4e-15 * (1 + fabs(want[i])), "%s: %.17g, not %.17g", formulas[i], got[i], want[i]);
    cr_expect_geq(temporaries, 1, "common subexpressions are computed once");
    nh_tape_work_free(work);
    nh_tape_free(tape);
    nh_text_clear(&code);
    nh_dag_free(d);
}

/* The currents of the Chaplygin sleigh, by the library.
 *
 *     cc example.c -lnhsym && ./a.out                  (pkg-config --cflags --libs nhsym, where it is installed)
 */
#include <nhsym.h>
#include <stdio.h>

/* The kinetic energy of a sleigh at rest in x and y, turning with omega = 1. */
static const double position[] = {0, 0, 0}, velocity[] = {1, 0, 0};

static int failed(nh_context *context, const nh_error *error)
{
    char text[3000];
    nh_error_format(error, text, sizeof text);
    fprintf(stderr, "%s\n", text);
    nh_context_free(context);
    return error->code;
}

int main(void)
{
    nh_error error = {0};
    nh_context *context = nh_context_create();
    nh_problem *problem = nh_problem_open(context, &(nh_question){.system = "sleigh", .set = "m=2"}, &error);
    nh_analysis *analysis = problem ? nh_analyze(problem, &error) : NULL;
    nh_problem_free(problem);
    if (!analysis) return failed(context, &error);
    printf("%s, search %s: %zu independent of %zu\n", nh_analysis_verdict(analysis), nh_analysis_search(analysis), nh_analysis_independent(analysis), nh_analysis_most(analysis));
    for (size_t i = 0; i < nh_analysis_currents(analysis); i++) {
        nh_current_facts current = nh_current_describe(analysis, i);
        char *formula = nh_current_formula(analysis, i, NH_SYNTAX_PLAIN);
        printf("%s = %s (%s%s%s), here %g\n", current.name, formula ? formula : "(long)", current.proved ? "proved" : "checked",
               *current.meaning ? ", " : "", current.meaning,
               nh_current_value(analysis, i, 0, position, velocity));
        nh_string_free(formula);
    }
    nh_analysis_free(analysis);
    nh_context_free(context);
    return 0;
}

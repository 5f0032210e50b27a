/* bench_contexts: analyses one after another, and each in its own thread with its own context: seconds, and whether what is found is the same.
 *
 *     bench_contexts [SYSTEM ...]          sleigh, kepler and heisenberg_particle when none is named; the exit code is 1 when an answer differs
 */
#include <nhsym.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"

enum { most_systems = 32, most_letters = 20000 };

typedef struct {
    const char *system;
    char *said; /* the currents, or what was wrong */
} work;

static void *analyse(void *context)
{
    work *w = context;
    nh_context *c = nh_context_create();
    nh_error error = {0};
    nh_problem *problem = nh_problem_open(c, &(nh_question){.system = w->system, .options = "threads=2"}, &error);
    nh_analysis *a = problem ? nh_analyze(problem, &error) : NULL;
    w->said = calloc(most_letters, 1);
    for (size_t i = 0; a && i < nh_analysis_currents(a); i++) {
        char *formula = nh_current_formula(a, i, NH_SYNTAX_PLAIN);
        snprintf(w->said + strlen(w->said), most_letters - strlen(w->said), "%s %s\n", nh_current_describe(a, i).name, formula ? formula : "");
        nh_string_free(formula);
    }
    if (!a) snprintf(w->said, most_letters, "%s", error.what);
    nh_analysis_free(a);
    nh_problem_free(problem);
    nh_context_free(c);
    return NULL;
}

int main(int argc, char **argv)
{
    static const char *const usual[] = {"sleigh", "kepler", "heisenberg_particle"};
    const char *const *system = argc > 1 ? (const char *const *)argv + 1 : usual;
    size_t n = argc > 1 ? (size_t)argc - 1 : sizeof usual / sizeof *usual, different = 0;
    if (n > most_systems) n = most_systems;
    work alone[most_systems], beside[most_systems];
    pthread_t thread[most_systems];
    double begin = nh_clock(), one_by_one, at_once;
    for (size_t i = 0; i < n; i++) alone[i].system = beside[i].system = system[i];
    for (size_t i = 0; i < n; i++) analyse(&alone[i]);
    one_by_one = nh_clock() - begin;
    begin = nh_clock();
    for (size_t i = 0; i < n; i++) pthread_create(&thread[i], NULL, analyse, &beside[i]);
    for (size_t i = 0; i < n; i++) pthread_join(thread[i], NULL);
    at_once = nh_clock() - begin;
    for (size_t i = 0; i < n; i++) {
        bool same = !strcmp(alone[i].said, beside[i].said);
        if (!same) printf("%s differs\n-- alone\n%s-- beside others\n%s", system[i], alone[i].said, beside[i].said);
        different += !same;
        free(alone[i].said);
        free(beside[i].said);
    }
    printf("%zu systems: one after another %.2f s, at once %.2f s, %zu differ\n", n, one_by_one, at_once, different);
    return different > 0;
}

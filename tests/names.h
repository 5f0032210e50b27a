/* names: systems as text, and values of their expressions where named symbols have given values, for the tests. */
#ifndef NH_TESTS_NAMES_H
#define NH_TESTS_NAMES_H

#include "mechanics.h"

#include "graph/dag.h"

static inline nh_system *system_of(const char *text)
{
    nh_error error = {0};
    nh_system *s = nh_system_parse("test.yaml", text, 0, NULL, &error);
    must(s != NULL, &error, "the system");
    return s;
}

static inline nh_ex expression_of(const nh_system *s, const char *text)
{
    nh_error error = {0};
    nh_ex e = 0;
    must(nh_system_expression_text(s, "test", text, 0, NULL, &e, &error), &error, text);
    return e;
}

/* e where the symbols names[i] are values[i]; parameters have the system's values. */
static inline double value_of(const nh_system *s, nh_ex e, size_t n, const char *const *names, const double *values)
{
    const nh_ex *symbols;
    const double *bound;
    nh_ex in[32];
    double out;
    cr_assert_leq(n, (size_t)32);
    for (size_t i = 0; i < n; i++) cr_assert(nh_symbol_find(s->dag, names[i], &in[i]), "there is no symbol %s", names[i]);
    nh_system_bindings(s, &symbols, &bound);
    nh_tape *tape = nh_tape_create(s->dag, n, in, 1, &e, s->parameters, symbols, bound);
    nh_tape_work *work = nh_tape_work_create(tape);
    nh_tape_eval(tape, work, values, &out);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    return out;
}

#endif

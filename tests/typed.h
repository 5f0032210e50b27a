/* typed: expressions as a person types them, every name a symbol. */
#ifndef NH_TESTS_TYPED_H
#define NH_TESTS_TYPED_H

#include <criterion/criterion.h>

#include "graph/dag.h"
#include "graph/parse.h"

static inline bool any_symbol(void *dag, const char *name, nh_ex *out, nh_parse_fault *fault)
{
    (void)fault;
    *out = nh_symbol(dag, name);
    return true;
}

static inline nh_ex ex(nh_dag *dag, const char *text)
{
    nh_ex e = 0;
    nh_parse_fault fault = {0};
    cr_assert(nh_parse(dag, text, any_symbol, dag, &e, &fault), "%s: %s", text, fault.what);
    return e;
}

#endif

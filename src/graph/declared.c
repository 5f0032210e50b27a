#include "graph/declared.h"

#include "graph/dag.h"
#include "graph/dag_internal.h"
#include "graph/function.h"
#include "graph/node.h"

size_t nh_declared_add(nh_dag *dag, const char *name)
{
    nh_grow(&dag->declared, &dag->declared_capacity, dag->declared_count + 1, sizeof *dag->declared);
    dag->declared[dag->declared_count] = (nh_declared){.name = nh_arena_strdup(dag->names, name)};
    return dag->declared_count++;
}

void nh_declared_give(nh_dag *dag, size_t f, nh_ex variable, const nh_ex *value)
{
    nh_declared *own = &dag->declared[f];
    own->variable = variable;
    nh_ex *copy = nh_arena_alloc(dag->names, (NH_DECLARED_PRIMES + 1) * sizeof *copy);
    own->value = memcpy(copy, value, (NH_DECLARED_PRIMES + 1) * sizeof *copy);
}

bool nh_declared_find(const nh_dag *dag, const char *name, size_t *f)
{
    for (*f = 0; *f < dag->declared_count; ++*f)
        if (!strcmp(dag->declared[*f].name, name)) return true;
    return false;
}

nh_ex nh_declared_call(nh_dag *dag, size_t f, size_t n, nh_ex x)
{
    const nh_declared own = dag->declared[f];
    if (!own.value)
        return nh_call_any(dag, NH_UNSPECIFIED, (nh_ex[]){nh_int(dag, (int64_t)f), nh_int(dag, (int64_t)n), x});
    return nh_substitute(dag, own.value[n], 1, &own.variable, &x);
}

size_t nh_declared_name(const nh_dag *dag, nh_ex call, const char **name)
{
    *name = dag->declared[nh_number_of(dag, nh_child(dag, call, 0)).p].name;
    return (size_t)nh_number_of(dag, nh_child(dag, call, 1)).p;
}

void nh_declared_names(nh_dag *dag, const nh_dag *from)
{
    for (size_t i = 0; i < from->declared_count; i++) nh_declared_add(dag, from->declared[i].name);
}

const char *nh_declared_unspecified(const nh_dag *dag)
{
    for (size_t i = 0; i < dag->declared_count; i++)
        if (!dag->declared[i].value) return dag->declared[i].name;
    return NULL;
}

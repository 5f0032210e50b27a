#include "graph/declared.h"

#include <math.h>
#include <string.h>

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

const char *nh_declared_function(const nh_dag *dag, size_t f)
{
    return f < dag->declared_count ? dag->declared[f].name : NULL;
}

nh_ex nh_declared_call(nh_dag *dag, size_t f, size_t n, nh_ex x)
{
    const nh_declared own = dag->declared[f];
    if (!own.value)
        return nh_call_any(dag, NH_UNSPECIFIED, (nh_ex[]){nh_int(dag, (int64_t)f), nh_int(dag, (int64_t)n), x});
    return nh_substitute(dag, own.value[n], 1, &own.variable, &x);
}

void nh_declared_names(nh_dag *dag, const nh_dag *from)
{
    for (size_t i = 0; i < from->declared_count; i++) {
        size_t f = nh_declared_add(dag, from->declared[i].name);
        nh_declared_give_table(dag, f, from->declared[i].table, from->declared[i].letters);
    }
}

const char *nh_declared_unspecified(const nh_dag *dag)
{
    for (size_t i = 0; i < dag->declared_count; i++)
        if (!dag->declared[i].value && !dag->declared[i].table) return dag->declared[i].name;
    return NULL;
}

/* ---- tables ---- */

void nh_declared_give_table(nh_dag *dag, size_t f, const nh_spline *table, const char *const *letters)
{
    dag->declared[f].table = table;
    dag->declared[f].letters = letters;
}

const nh_spline *nh_declared_table(const nh_dag *dag, size_t f)
{
    return f < dag->declared_count ? dag->declared[f].table : NULL;
}

const nh_spline **nh_declared_tables(const nh_dag *dag)
{
    if (!nh_declared_has_table(dag)) return NULL;
    const nh_spline **table = nh_alloc_array(dag->declared_count, sizeof *table);
    for (size_t f = 0; f < dag->declared_count; f++) table[f] = dag->declared[f].table;
    return table;
}

const char *nh_declared_has_table(const nh_dag *dag)
{
    for (size_t i = 0; i < dag->declared_count; i++)
        if (dag->declared[i].table) return dag->declared[i].name;
    return NULL;
}

double nh_declared_table_error(const nh_dag *dag)
{
    double error = 0;
    for (size_t i = 0; i < dag->declared_count; i++)
        if (dag->declared[i].table) error = fmax(error, dag->declared[i].table->error);
    return error;
}

nh_ex nh_declared_call_table(nh_dag *dag, size_t f, size_t n, nh_ex x, nh_ex y)
{
    return nh_call_any(dag, NH_TABLE, (nh_ex[]){nh_int(dag, (int64_t)f), nh_int(dag, (int64_t)n), x, y});
}

static size_t number_in(const nh_dag *dag, nh_ex e, size_t i)
{
    return (size_t)nh_number_of(dag, nh_child(dag, e, i)).p;
}

nh_ex nh_declared_table_rate(nh_dag *dag, nh_ex e, size_t i)
{
    if (i < 2) return nh_real(dag, NAN);
    size_t f = number_in(dag, e, 0), n = number_in(dag, e, 1), step = i == 2 ? 1 : NH_SPLINE_ORDERS;
    if (n / step % NH_SPLINE_ORDERS + 1 == NH_SPLINE_ORDERS) return nh_int(dag, 0);
    return nh_declared_call_table(dag, f, n + step, nh_child(dag, e, 2), nh_child(dag, e, 3));
}

size_t nh_declared_put(const nh_dag *dag, nh_ex call, nh_text *out)
{
    nh_function f = nh_function_of(dag, call);
    if (f != NH_UNSPECIFIED && f != NH_TABLE) return 0;
    const nh_declared own = dag->declared[number_in(dag, call, 0)];
    size_t n = number_in(dag, call, 1), order[2] = {f == NH_TABLE ? n % NH_SPLINE_ORDERS : n, 0};
    bool two = own.table && own.table->y;
    if (two) order[1] = n / NH_SPLINE_ORDERS;
    nh_text_add(out, own.name);
    if (two && n) nh_text_add(out, "_");
    for (size_t k = 0; k < 2; k++)
        for (; order[k] > 0; order[k]--) nh_text_add(out, two ? own.letters[k] : "'");
    return 2;
}

size_t nh_declared_arguments(const nh_dag *dag, nh_ex call)
{
    bool one = nh_function_of(dag, call) == NH_TABLE && !dag->declared[number_in(dag, call, 0)].table->y;
    return nh_arity(dag, call) - one;
}

bool nh_declared_find_partial(const nh_dag *dag, const char *word, size_t *f, size_t *n)
{
    for (*f = 0; *f < dag->declared_count; ++*f) {
        const nh_declared own = dag->declared[*f];
        size_t length = strlen(own.name), order[2] = {0, 0};
        if (!own.table || !own.table->y || strncmp(word, own.name, length) || word[length] != '_') continue;
        const char *at = word + length + 1;
        for (size_t k = 0; k < 2; k++)
            for (size_t l = strlen(own.letters[k]); !strncmp(at, own.letters[k], l); at += l) order[k]++;
        *n = order[0] + NH_SPLINE_ORDERS * order[1];
        if (!*at && *n && order[0] < NH_SPLINE_ORDERS && order[1] < NH_SPLINE_ORDERS) return true;
    }
    return false;
}

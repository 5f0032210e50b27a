/* dag_internal: the graph's storage, shared by the modules that make or remember nodes. */
#ifndef NH_DAG_INTERNAL_H
#define NH_DAG_INTERNAL_H

#include "base/memory.h"
#include "base/spline.h"
#include "graph/node.h"

typedef struct {
    const char *text;
    nh_ex symbol;
    bool hidden; /* not found by name */
} nh_symbol_name;

/* One open-addressing slot of the derivative memo. */
typedef struct {
    uint64_t key; /* (e << 32 | x) + 1, 0 when free */
    nh_ex value;
} nh_diff_memo;

typedef struct {
    nh_ex u, x, value;
} nh_diff_rule_entry;

/* symbol^order = value, see normal.h. */
typedef struct {
    nh_ex symbol, value;
    unsigned order;
} nh_power_rule;

/* A function that a file declares, see declared.h. */
typedef struct {
    const char *name;
    nh_ex variable;
    const nh_ex *value;         /* with its derivatives; NULL: unspecified, or a table */
    const nh_spline *table;     /* NULL: none */
    const char *const *letters; /* of a table: the names of its variables */
} nh_declared;

/* Forms of an expression that the graph keeps: the simplest one; the same before calls and roots are written as in the
 * source, for parts of others; the one that is shown (exact/gather.h). */
typedef enum { NH_FORM_SIMPLE, NH_FORM_PART, NH_FORM_SHOWN, NH_FORMS } nh_dag_kept;

struct nh_dag {
    nh_dag_nodes all; /* first */
    size_t node_count, node_capacity;
    size_t arg_count, arg_capacity;
    uint32_t *bucket;
    size_t bucket_count;
    nh_symbol_name *name;
    size_t name_count, name_capacity;
    nh_arena *names;
    nh_diff_memo *memo;
    size_t memo_count, memo_capacity;
    nh_ex *form[NH_FORMS]; /* per node: its form + 1; 0 when not yet asked */
    size_t form_capacity[NH_FORMS];
    nh_diff_rule_entry *rule;
    size_t rule_count, rule_capacity;
    nh_power_rule *power;
    size_t power_count, power_capacity;
    nh_declared *declared;
    size_t declared_count, declared_capacity;
    size_t copied;        /* so many nodes are those of the graph that this one is a copy of */
    unsigned long worker; /* nh_parallel_worker() where it was made: expressions are made nowhere else */
};

/* The relation that a symbol satisfies, or NULL. */
const nh_power_rule *nh_dag_power_rule(const nh_dag *dag, nh_ex symbol);

/* The memo of forms of e; false where e is not there, otherwise *out. */
bool nh_dag_form(const nh_dag *dag, nh_ex e, nh_dag_kept kept, nh_ex *out);
void nh_dag_set_form(nh_dag *dag, nh_ex e, nh_dag_kept kept, nh_ex form);

/* The derivative of the function e with respect to its argument i. */
nh_ex nh_diff_argument(nh_dag *dag, nh_ex e, size_t i);

/* The node with this kind, function and arguments: the existing one, or a new one. */
nh_ex nh_dag_intern(nh_dag *dag, unsigned kind, unsigned op, size_t count, const uint32_t *arg);

#endif

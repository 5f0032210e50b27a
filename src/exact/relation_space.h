/* relation_space: all linear relations among columns of expressions.
 *
 *     sum_j c_j e_ij = 0    identically, for every row i,   c_j in Q(parameters)
 *
 * Along a curve whose power series are random modulo a prime, the constants being random residues, the columns become
 * columns of residues, whose rank is a lower bound: so `bound`, the number of columns less this rank, is an upper bound
 * for the dimension of the relations.  Each vector of the reduced echelon form says which columns a relation consists
 * of; its coefficients are found exactly, and the relation is then an identity of normal forms.  Where `proved` is
 * equal to `bound` there are no other relations. */
#ifndef NH_RELATION_SPACE_H
#define NH_RELATION_SPACE_H

#include "base/memory.h"
#include "graph/expr.h"

typedef struct {
    nh_dag *dag;
    size_t columns, rows;
    const nh_ex *entry; /* entry[j * rows + i] */
    size_t variables;
    const nh_ex *variable; /* all other symbols are constants */
    size_t parameters;
    const nh_ex *parameter;
    size_t max_terms; /* largest number of terms of normal forms; 0: their default */
} nh_relation_columns;

typedef struct {
    const char *obstacle; /* why nothing is known, or NULL */
    size_t bound, proved;
    /* proved x columns: the last column of each relation has the coefficient 1, and is in no other relation */
    nh_ex *coefficient;
} nh_relation_space;

/* Is the last column a combination of those before it, modulo the prime?  Then `support` marks that column and those
 * that the combination needs, the first ones possible.  `parameters` and max_terms do not matter. */
typedef enum { NH_LAST_UNKNOWN, NH_LAST_IS_FREE, NH_LAST_IS_COMBINED } nh_relation_last;
nh_relation_last nh_relation_space_last(const nh_relation_columns *columns, bool *support);

/* In the arena; expressions belong to the graph. */
nh_relation_space *nh_relation_space_of(nh_arena *arena, const nh_relation_columns *columns);

#endif

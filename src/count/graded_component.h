/* graded_component: unknowns of the symbol that occur together, and sparse elimination of their equations: the shortest
 * row and its rarest column first.
 *
 * Most components are small and there are thousands of them: one after the other uses the same memory. */
#ifndef NH_GRADED_COMPONENT_H
#define NH_GRADED_COMPONENT_H

#include "count/graded_solver_internal.h"

typedef struct {
    uint32_t column;
    nh_residue value;
} nh_graded_cell;

typedef struct {
    size_t count, capacity;
    uint32_t *item;
} nh_graded_row_list;

/* The remaining rows by their length, in lists: a row's number plus 1, or 0 at the end. */
typedef struct {
    size_t least; /* no row is shorter */
    uint32_t *first, *next, *previous;
} nh_graded_lengths;

typedef struct {
    size_t rows, columns, rank;
    size_t *equation;               /* of each row */
    size_t *unknown;                /* of each column */
    nh_graded_cell **cells, *spare; /* spare: a replaced row whose memory serves the next one */
    size_t *room, spare_room;       /* length of each row; room of the spare one */
    size_t *length, *count;         /* number of entries of each row; number of remaining rows that have this column */
    bool *done, *pivoted;           /* rows used as pivots; columns */
    size_t *pivot_row, *pivot_column;
    nh_residue *inverse;        /* by which the row's known part is still to be multiplied */
    nh_graded_row_list *member; /* for each column: the rows that have it or had it, some more than once */
    nh_graded_lengths rest;
    double work; /* of all components so far */
} nh_graded_component;

/* Room for components of at most so many rows and columns; nh_graded_component_clear takes the same numbers. */
void nh_graded_component_init(nh_graded_component *component, size_t rows, size_t columns);
void nh_graded_component_clear(nh_graded_component *component, size_t rows, size_t columns);

/* Eliminates: afterwards row pivot_row[t] has the entry 1 at column pivot_column[t], t < rank, and its other entries
 * are at columns with a later pivot or without one.  The other rows have no entries, and their known parts are conditions.
 * The caller has set rows, columns, equation and unknown; `place`: the column of each unknown. */
void nh_graded_component_solve(const nh_graded_system *system, nh_graded_component *component, const size_t *place);

#endif

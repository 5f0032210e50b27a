/* library_columns: many states of a caller as batches of a tape whose inputs are t, positions, velocities.  The
   caller's arrays are read where they are. */
#ifndef NH_LIBRARY_COLUMNS_H
#define NH_LIBRARY_COLUMNS_H

#include "evaluate/tape.h"

typedef struct {
    size_t inputs, count; /* 1 + 2 m; states */
    const double *t, *q, *v;
    const double **in;     /* of the batch */
    double zero[NH_BATCH]; /* the time where none is given */
} nh_columns;

void nh_columns_open(nh_columns *columns, size_t coordinates, size_t count, const double *t, const double *q,
                     const double *v);
/* Sets `in` to the states from number `from` on; how many these are, 0 at the end. */
size_t nh_columns_next(nh_columns *columns, size_t from);
void nh_columns_close(nh_columns *columns);

#endif

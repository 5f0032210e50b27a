/* library_internal: what the files of the public interface (nhsym.h) share. */
#ifndef NH_LIBRARY_INTERNAL_H
#define NH_LIBRARY_INTERNAL_H

#include "base/context.h"
#include "base/files.h"
#include "evaluate/tape.h"
#include "library/request.h"

struct nh_problem {
    nh_context *context;
    nh_context *before; /* of the thread, while a computation goes on */
    nh_arena *arena;
    nh_request request;  /* of every computation; its strings are in the arena */
    nh_file_store files; /* that it has read */
    nh_system *system;
};

/* First in a function of nhsym.h: a caller may pass NULL in place of an error, but within the library there is one. */
#define NH_OWN_ERROR(error)                                                                                            \
    nh_error own_error = {.code = NH_OK};                                                                              \
    if (!(error)) (error) = &own_error

/* False: memory ended before the job did (base/recovery.h).  After that has happened once in a thread, it does further
 * jobs on a new thread, because FLINT's memory for the old one may be inconsistent. */
bool nh_library_run(void (*job)(void *), void *data);
/* The same, with a message. */
bool nh_library_try(void (*job)(void *), void *data, nh_error *error);
/* The same, in the problem's context: with its files and its time limit. */
bool nh_problem_run(nh_problem *problem, void (*job)(void *), void *data, nh_error *error);

/* Many states of a caller as batches of a tape with the inputs t, positions, velocities; its arrays are not copied. */
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

/* export: equations of motion, currents and reductions of a system as functions for other languages (document/export.h
 * writes them).
 *
 * A function takes the time, arrays of states, the inputs and the parameters.  Its body is: unknowns of linear systems,
 * or of Newton's iteration, one after the other; then its results, as expressions of all these. */
#ifndef NH_EXPORT_H
#define NH_EXPORT_H

#include "commands/analyze.h"
#include "commands/reduce.h"

typedef enum {
    NH_EXPORT_EQUATIONS = 1,   /* in all coordinates, with multipliers */
    NH_EXPORT_MOMENTA = 2,     /* momenta, and the velocities that they determine */
    NH_EXPORT_SUBMANIFOLD = 4, /* equations of motion on the constraint submanifold */
    NH_EXPORT_CURRENTS = 8,
    NH_EXPORT_REDUCED = 16, /* every stage of the reduction, with its reconstruction */
    NH_EXPORT_ALL = 31
} nh_export_part;

/* An argument (e: symbols) or a result (e: values). */
typedef struct {
    const char *name;     /* an identifier in every language */
    const char *doc;      /* description, one line */
    size_t rows, columns; /* columns 1: a vector; otherwise a matrix, row by row */
    const nh_ex *e;
    const char *const *label; /* rows: names of the entries; NULL: the names of the symbols */
} nh_export_array;

/* Solve matrix unknown = right; or with `newton` repeat unknown -= matrix^-1 right until it no longer changes,
 * beginning with the argument `guess`. */
typedef struct {
    bool newton;
    size_t n;
    const nh_ex *matrix, *right, *unknown; /* n x n, row by row; n; n symbols */
    size_t guess;                          /* index of the argument */
} nh_export_solve;

enum { NH_EXPORT_MOST_ARRAYS = 5, NH_EXPORT_MOST_SOLVES = 2 };

typedef struct {
    const char *name, *doc;  /* doc: description, in lines */
    const nh_system *system; /* the system of which time and the parameters are symbols */
    size_t stage;            /* stage of a reduction */
    nh_dag *dag;
    nh_export_part part;
    size_t arguments, solves, results;
    nh_export_array argument[NH_EXPORT_MOST_ARRAYS], result[NH_EXPORT_MOST_ARRAYS];
    nh_export_solve solve[NH_EXPORT_MOST_SOLVES];
} nh_export_function;

typedef struct nh_export {
    nh_arena *arena;
    const char *command;
    const char *to, *name; /* as in the request, or NULL */
    double seed;
    nh_system *own;          /* read here; NULL where another result owns the system */
    nh_model *bare;          /* likewise */
    nh_analysis *analysis;   /* NULL unless currents are wanted */
    nh_reduction *reduction; /* likewise */
    bool borrowed;           /* the reduction belongs to another result */
    const nh_system *system;
    const nh_model *model; /* with its geometry; NULL where no function needs it */
    bool *input;           /* per parameter: is it an input? */
    size_t inputs;
    size_t functions, capacity;
    nh_export_function *function;
    size_t notes;
    const char *note[12]; /* notes: functions that are missing, and why */
    double written;       /* formulas up to this length are written without names for their parts */
    bool partial;
} nh_export;

/* Collects the functions; the caller frees the result.  NULL with a message. */
nh_export *nh_export_create(const nh_request *request, nh_error *error);
/* The functions of the reduced equations alone, for a reduction that outlives the result. */
nh_export *nh_export_of_reduction(const nh_reduction *reduction);
void nh_export_free(nh_export *export_);

/* "equations, momenta, submanifold, currents, reduced" */
const char *nh_export_part_name(nh_export_part part);

#endif

/* export: equations of motion, currents and reductions of a system as functions that other languages can hold
 * (document/export.h writes them).
 *
 * A function takes the time, arrays of states, the inputs and the parameters.  Its body is: unknowns of linear systems,
 * or of Newton's iteration, one after the other; then its results, as expressions of all these. */
#ifndef NH_EXPORT_H
#define NH_EXPORT_H

#include "commands/analyze.h"
#include "commands/reduce.h"

typedef enum {
    NH_EXPORT_EQUATIONS = 1,   /* in all coordinates, with multipliers */
    NH_EXPORT_MOMENTA = 2,     /* momenta and the velocities that they determine */
    NH_EXPORT_SUBMANIFOLD = 4, /* equations of motion on the constraint submanifold */
    NH_EXPORT_CURRENTS = 8,
    NH_EXPORT_REDUCED = 16, /* every stage of the reduction, with its reconstruction */
    NH_EXPORT_ALL = 31
} nh_export_part;

typedef struct {
    const char *command, *system_path;
    size_t settings;
    const nh_setting *setting;
    nh_chart_choice chart;
    const char *initial, *group; /* of the reduction; or NULL */
    bool weak;
    const char *of;    /* "equations, currents", or NULL: all */
    const char *input; /* "u, tau": parameters that are inputs of a controller, or NULL */
    const char *to, *name; /* the language and the first word of the names, for who writes it; or NULL */
    nh_options options;
} nh_export_request;

/* An argument (e: symbols) or a result (e: values). */
typedef struct {
    const char *name;     /* a word that is a name in every language */
    const char *doc;      /* one line */
    size_t rows, columns; /* columns 1: a vector; else a matrix, row by row */
    const nh_ex *e;
    const char *const *label; /* rows: what the entries are; NULL: the names of the symbols */
} nh_export_array;

/* matrix unknown = right, or with `newton`: unknown -= matrix^-1 right until that changes nothing, from the argument
 * `guess`. */
typedef struct {
    bool newton;
    size_t n;
    const nh_ex *matrix, *right, *unknown; /* n x n, row by row; n; n symbols */
    size_t guess;                          /* the argument's index */
} nh_export_solve;

enum { NH_EXPORT_MOST_ARRAYS = 5, NH_EXPORT_MOST_SOLVES = 2 };

typedef struct {
    const char *name, *doc;  /* doc: lines */
    const nh_system *system; /* whose symbols the time and the parameters are */
    size_t stage;            /* of a reduction */
    nh_dag *dag;
    nh_export_part part;
    size_t arguments, solves, results;
    nh_export_array argument[NH_EXPORT_MOST_ARRAYS], result[NH_EXPORT_MOST_ARRAYS];
    nh_export_solve solve[NH_EXPORT_MOST_SOLVES];
} nh_export_function;

typedef struct nh_export {
    nh_arena *arena;
    const char *command;
    const char *to, *name; /* of the request, or NULL */
    double seed;
    nh_system *own;          /* read here; NULL where another result has it */
    nh_model *bare;          /* likewise */
    nh_analysis *analysis;   /* NULL unless currents are wanted */
    nh_reduction *reduction; /* likewise */
    bool borrowed;           /* it belongs to another */
    const nh_system *system;
    const nh_model *model; /* with its geometry; NULL where nothing needs it */
    bool *input;           /* per parameter */
    size_t inputs;
    size_t functions, capacity;
    nh_export_function *function;
    size_t notes;
    const char *note[12]; /* what there is not, and why */
    double written;       /* formulas up to this length are written without names for their parts */
    bool partial;
} nh_export;

/* NULL with a message. */
nh_export *nh_export_create(const nh_export_request *request, nh_error *error);
/* The reduced equations alone, of a reduction that outlives the result. */
nh_export *nh_export_of_reduction(const nh_reduction *reduction);
void nh_export_free(nh_export *export_);

/* "equations, momenta, submanifold, currents, reduced" */
const char *nh_export_part_name(nh_export_part part);

#endif

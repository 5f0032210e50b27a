/* analysis_file: a question as text (docs/formats.md): ansatz, unknowns, motion, figures. */
#ifndef NH_ANALYSIS_FILE_H
#define NH_ANALYSIS_FILE_H

#include "motion/dynamics.h"
#include "integrals/unknowns.h"

/* What is fitted: fields first, then currents; fields alone; currents alone. */
typedef enum { NH_ROUTE_BOTH, NH_ROUTE_FIELDS, NH_ROUTE_CURRENTS, NH_ROUTES } nh_route;

/* A figure of the file. */
typedef enum { NH_FIGURE_PATH, NH_FIGURE_PLOT, NH_FIGURE_SCAN, NH_FIGURE_SAMPLES, NH_FIGURE_RESIDUAL } nh_figure_kind;
typedef struct {
    nh_figure_kind kind;
    const char *title;
    size_t quantities;
    nh_named *quantity; /* path: x, y and perhaps a heading; plot: each over time; residual: the two axes */
    size_t values;      /* 0: one motion with the values of the analysis */
    const char *vary;   /* a parameter, */
    double *value;      /* its values, a motion each; samples: how many, a linear problem each */
    nh_ex of;           /* residual: of this function; 0: of the currents found */
    bool has_time;
    /* the motion begins at the t of the initial state, whether that lies within these times or not */
    double begin, end;
    size_t unknown; /* scan: over this one */
} nh_figure_request;

/* The part that must be known before the system is read. */
typedef struct {
    nh_arena *arena;
    nh_deck *deck;
    const char *name, *system;
    size_t settings;
    nh_setting *setting;
    nh_chart_choice chart;
    nh_route route;
    const char *grid; /* a word of system/sample_grid.h, or the path of points; NULL: none is chosen */
    bool alone;       /* the ansatz alone: the program's own search does not follow */
    bool has_seed, has_samples, has_tolerance;
    double seed, samples, tolerance;
    /* the rest, after nh_analysis_file_resolve */
    size_t families, unknowns, watches, definitions;
    nh_family *family;
    nh_unknown *unknown;
    nh_named *definition, *watch;
    size_t shapes;
    nh_shape *shape; /* to be drawn */
    size_t figures;
    nh_figure_request *figure;
    bool has_initial, has_until;
    nh_state initial;
    /* the same as expressions of the parameters: t, q, v; and which of q and v were given (2m), all velocities where
       quasi-velocities were */
    nh_ex *exact;
    bool *written;
    double until;
} nh_analysis_file;

/* "both", "fields" or "currents"; "symmetry" and "current" of earlier versions are read, too.  False: none of these,
 * and `error` has a hint. */
bool nh_analysis_file_route(const char *word, nh_route *route, nh_error *error);
const char *nh_analysis_file_route_word(nh_route route);
nh_analysis_file *nh_analysis_file_read(const char *path, nh_error *error);
/* The same from a text, called `name` in messages. */
/* "phi=0, omega=2" as the initial state; `name`: where it is written, for messages, whose code is `code`. */
nh_analysis_file *nh_analysis_file_start(const char *name, const char *state, nh_code code, nh_error *error);
void nh_analysis_file_free(nh_analysis_file *analysis);

/* Read ansatz, unknowns, initial state and scene in the names of the model's system; expressions are brought to its
   chart.  For an initial state a model with only its system, graph, m and parameters is enough. */
bool nh_analysis_file_resolve(nh_analysis_file *analysis, const nh_model *model, nh_error *error);

/* Any expression of the system (coordinate velocities, quasi-velocities) as a function of the model's chart. */
bool nh_analysis_file_to_chart(const nh_model *model, nh_ex e, nh_ex *out, nh_error *error);

#endif

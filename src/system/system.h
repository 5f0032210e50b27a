/* system: the content of a system file as expressions (docs/formats.md). */
#ifndef NH_SYSTEM_H
#define NH_SYSTEM_H

#include "system/deck.h"
#include "base/memory.h"
#include "graph/expr.h"
#include "system/bodies.h"
#include "system/orientation.h"
#include "system/shape.h"

typedef enum { NH_ANGLE, NH_LENGTH, NH_PLAIN } nh_coordinate_type;

typedef struct {
    const char *name, *unit, *doc;
    nh_ex symbol;
    double value;
    double written; /* its value in the file */
    bool set;       /* set by the user, not by the file */
    bool input;     /* the file says that it may change with time: an argument of exported code */
} nh_parameter;

typedef struct {
    const char *name, *unit, *doc; /* unit, for labels: "" when it is not told */
    nh_coordinate_type type;
    bool counted; /* an angle whose turns count: a turn of a joint with a pitch ends at another place */
    nh_ex q, v;   /* the coordinate and its velocity "name'" */
} nh_coordinate;

typedef struct {
    const char *text;
    nh_ex lhs, rhs; /* f = lhs - rhs */
    bool position;  /* it was an equation between positions, level = 0: lhs and rhs are its time derivative */
    /* without `position`: a function of positions that is known to have the rate f, the height of a wheel; or 0 */
    nh_ex level;
    nh_ex framed; /* with orientations: lhs - rhs in the symbols of angular velocities (system/orientation.h) */
    const nh_deck_node *node;
} nh_constraint;

typedef struct {
    nh_ex symbol;
    double low, high;
} nh_interval;

typedef struct {
    const char *name, *text, *doc; /* doc: a sentence about a known current, or "" */
    const char *symbol;            /* of a known current: how its source calls it, "Phi_2", or NULL */
    nh_ex value;
    /* of a known current: the reason why the program's own ansatz does not contain it, or NULL */
    const char *out_of_reach;
    bool unwatched; /* of a known current: no column of a motion */
} nh_named;

typedef struct {
    const char *name;
    /* an expression of t and the parameters, instead of a value; of a function, whose name is "V(r)": its value; NULL:
     * none */
    const char *input;
    double value;
    const nh_deck *deck; /* where it was written: NULL for the command line */
    const nh_deck_node *key;
    /* with bottom > 0: exactly this ratio; the name is then a definition instead of a parameter */
    int64_t top, bottom;
    /* the same with this constant, as in "sqrt(3)/2", or function of the other parameters; NULL: none */
    const char *formula;
} nh_setting;

/* A robustness map, as texts of the command line, which are not read before the map is made. */
typedef struct {
    const char *name, *doc, *over;
    const char *initial, *velocities; /* NULL: not given */
    double until, step;               /* 0: not given; step: by methods with this fixed step */
    size_t settings, options;
    nh_setting *setting, *option;
} nh_named_map;

/* A closed form: some coordinates as functions of t and of numbers that follow from the initial state.  The file claims
 * it; whoever uses it must check it. */
typedef struct {
    const char *name;
    size_t starts, conditions, values;
    nh_named *start;  /* in the initial state (t, coordinates, either velocities) */
    nh_ex *symbol;    /* their symbols in the motion */
    nh_ex *condition; /* vanish at initial states that it holds for */
    bool *given;      /* per coordinate: is it known? */
    nh_ex *value;     /* per coordinate, in t, parameters and the symbols */
} nh_known_motion;

typedef struct {
    nh_arena *arena;
    nh_dag *dag;
    nh_deck *deck;
    const char *name, *title, *source;
    /* for the user: parts of a robot description that were left out or replaced; units that do not agree */
    const char **note;
    size_t notes;
    nh_ex t;
    size_t parameters, coordinates, constraints, definitions, intervals, currents, not_conserved;
    nh_parameter *parameter;
    nh_coordinate *coordinate;
    nh_constraint *constraint;
    /* number of constraints, the last ones, that put the system on a level of an integral */
    size_t levels;
    nh_named *definition;
    nh_interval *interval; /* the sampling box as far as the user gave it */
    size_t reaches;
    nh_interval *reach;       /* in place of default intervals (system/system_internal.h) */
    nh_named *current, *trap; /* known currents; functions known not to be conserved */
    nh_chain *chain;          /* bodies and joints; NULL when the file has none */
    size_t symmetries;        /* fields on configuration space that the file names as generators of a group */
    nh_ex *symmetry;          /* symmetries x coordinates: components */
    size_t shapes;
    nh_shape *shape; /* to be drawn, in t, coordinates and parameters */
    size_t robustness_maps;
    nh_named_map *robustness_map;
    nh_ex lagrangian; /* with the energies of bodies and joints */
    nh_ex *force;     /* per coordinate; the number 0 where there is none */
    bool has_forces;
    bool driven;       /* an input over time replaces a parameter */
    int branch;        /* of a quadratic constraint: the sign of its root, or 0: the domain chooses */
    size_t dependents; /* 0 when the user named none */
    size_t *dependent; /* coordinate indices */
    /* (t, q, q') at which formulas of dependent velocities must be regular; NULL: none */
    const double *start;
    size_t quasi;          /* number of quasi-velocities, 0 without a chart */
    nh_ex *quasi_velocity; /* symbols */
    nh_ex *quasi_map;      /* velocity of each coordinate */
    size_t orientations;   /* system/orientation.h */
    nh_orientation *orientation;
    /* with orientations: the Lagrangian in the symbols of angular velocities, the Lagrangian that it was made of, and
     * the rates along the frame as functions of the quasi-velocities (NULL: not known) */
    nh_ex framed, framed_of;
    nh_ex *quasi_framed;
    nh_named *framed_definition; /* the definitions in these symbols */
} nh_system;

/* Read a system file; `settings` override parameter values.  NULL on failure. */
nh_system *nh_system_read(const char *path, size_t settings, const nh_setting *setting, nh_error *error);
nh_system *nh_system_parse(const char *name, const char *text, size_t settings, const nh_setting *setting,
                           nh_error *error);
/* The tree of a file with all that it includes, completed as system/system_internal.h says. */
nh_deck *nh_system_deck(const char *path, nh_error *error);
void nh_system_free(nh_system *system);

/* The closed forms that the file knows, in memory of the system.  False only where one contains a definition that is
 * not a function of t. */
bool nh_system_motions(nh_system *system, size_t *count, nh_known_motion **out, nh_error *error);

/* t, coordinates, velocities and quasi-velocities by name, for messages: at most 2*coordinates + quasi + 1, counted by
   the result. */
size_t nh_system_state_names(const nh_system *system, const char **names);

/* In ASCII (nh_deck_spelled), and x' for x_dot where x is a coordinate and nothing is named x_dot, as in the tables
 * that simulate writes; else `name`. */
const char *nh_system_state_name(const nh_system *system, const char *name);

/* The coordinate whose velocity `word` may mean, as others write it: of x1 that is x1dot, x1_dot, dotx1, xdot1, dx1,
 * dx1/dt, vx1, v_x1, and v1 where no other name ends in 1.  NULL: none, or `near`, the nearest name in letters (or
 * NULL), begins with v as well. */
#define NH_VELOCITY_IS_WRITTEN "the velocity of `%s` is written %s'"
const char *nh_system_velocity_meant(const nh_system *system, const char *word, const char *near);

/* Gives the hint for a word that names no coordinate, or no parameter: the nearest name, or all of them.  Always
 * false. */
bool nh_system_hint_coordinates(const nh_system *system, const char *word, nh_error *error);
bool nh_system_hint_parameters(const nh_system *system, const char *word, nh_error *error);

/* Parse an expression of this system: t, parameters, definitions, coordinates, velocities x', quasi-velocities, and the
 * extra names; errors point into `node`, a scalar of `deck`. */
bool nh_system_expression(const nh_system *system, const nh_deck *deck, const nh_deck_node *node, size_t extras,
                          const nh_named *extra, nh_ex *out, nh_error *error);
/* The same for what follows the first `=` of the scalar, or the whole of it. */
bool nh_system_right_side(const nh_system *system, const nh_deck *deck, const nh_deck_node *node, size_t extras,
                          const nh_named *extra, nh_ex *out, nh_error *error);
/* The same for a text from the command line, called `where` in messages. */
bool nh_system_expression_text(const nh_system *system, const char *where, const char *text, size_t extras,
                               const nh_named *extra, nh_ex *out, nh_error *error);

/* The same for `length` bytes of it from byte `begin` on; messages show all that was typed. */
bool nh_system_expression_part(const nh_system *system, const char *where, const char *typed, size_t begin,
                               size_t length, size_t extras, const nh_named *extra, nh_ex *out, nh_error *error);

/* Parameter symbols and values as parallel arrays owned by the arena. */
void nh_system_bindings(const nh_system *system, const nh_ex **symbols, const double **values);
/* e, of this graph, with the parameters at their given values, decimals being the ratios that they are written as. */
nh_ex nh_system_values(const nh_system *system, nh_dag *dag, nh_ex e);
/* The value of an expression in the parameters. */
double nh_system_number(const nh_system *system, nh_ex e);

/* Refuses a system with a function without a value: `what` needs numbers.  Returns false then. */
bool nh_system_needs_values(const nh_system *system, const char *what, nh_error *error);

/* Refuses a system with a table: `what` needs a formula, as balls and power series do.  Returns false then. */
bool nh_system_needs_formulas(const nh_system *system, const char *what, nh_error *error);

/* Refuses a level (0, 1, ..) that motions leave, or of which that is not decided.  Returns false. */
bool nh_system_refuse_level(const nh_system *system, size_t level, bool proved, nh_error *error);

/* The index of a coordinate by name, or -1. */
long nh_system_coordinate(const nh_system *system, const char *name);

/* ---- orientations (system_orientation.c) ---- */

/* The orientation of this name, or of which this is a coordinate; or NULL. */
nh_orientation *nh_orientation_named(const nh_system *system, const char *name);
const nh_orientation *nh_orientation_of(const nh_system *system, size_t coordinate);
/* A word that is an angular velocity or a matrix entry: `framed` gives the symbol of the angular velocity. */
bool nh_orientation_word(const nh_system *system, const char *word, bool framed, bool *velocity, nh_ex *out);
/* Velocities of orientations' coordinates, written in the angular velocities' symbols. */
nh_ex nh_orientation_framed(const nh_system *system, nh_ex e);
/* The symbols of the angular velocities, written in coordinates and their velocities. */
nh_ex nh_orientation_written(const nh_system *system, nh_ex e);
/* From rates along the frame (m: of other coordinates their velocities) to those of the coordinates (m). */
void nh_orientation_map(const nh_system *system, const nh_ex *framed, nh_ex *out);
/* For printed formulas: in the symbols of matrix entries; and back. */
nh_ex nh_orientation_shown(const nh_system *system, nh_ex e);
nh_ex nh_orientation_unshown(const nh_system *system, nh_ex e);

#endif

/* analysis: the result of an analysis.  Documents only show it; nothing is computed after it is complete. */
#ifndef NH_ANALYSIS_H
#define NH_ANALYSIS_H

#include "geometry/distribution.h"
#include "count/completeness.h"
#include "motion/validation.h"
#include "integrals/independence.h"
#include "integrals/letters.h"
#include "integrals/prove.h"
#include "integrals/gradient_rank.h"
#include "integrals/region.h"
#include "integrals/symmetry.h"
#include "integrals/unknowns.h"
#include "problem/observables.h"
#include "system/sample_grid.h"

/* Coefficient functions without closed form: Chebyshev series in one variable, a coordinate or t, on an interval. */
typedef struct {
    nh_ex variable;
    double low, high; /* the interval */
    size_t degree, words;
    nh_ex *word;         /* the functions that are multiplied by the series */
    double *coefficient; /* of T_k for word i: coefficient[i * stride + k], k = 0 .. degree */
    size_t stride;
    const char *equation; /* a linear equation of second order that they satisfy; NULL: not known, or too long */
} nh_series;

typedef struct {
    const char *name;    /* Phi1, Phi2, ... */
    const char *symbol;  /* how the system's file says that its source calls it; or NULL */
    const char *meaning; /* "energy", "minus the momentum of x", "a multiple of the energy", or "" */
    bool energy;         /* it is a multiple of the energy */
    nh_ex phi;           /* in the chart */
    nh_ex in_velocities; /* in t, q, q' and parameters */
    bool has_in_velocities;
    bool exact;         /* every coefficient was recognised */
    nh_letters letters; /* numbers inside of its terms that have names */
    double quotient, heldout;
    bool fitted;       /* of a system with tables: no proof is tried (integrals/fitted.h) */
    double fit_digits; /* of a fitted one: digits to which its coefficients are determined; INFINITY: it has none */
    nh_proof proof;
    bool asked;            /* were the coefficients refined with many digits?  */
    bool moved;            /* and did the refinement give another combination than doubles had? */
    double refined;        /* digits to which the rate cancels then, -1 when this could not be computed */
    double printed_digits; /* the digits to which the current cancels with its coefficients as printed */
    nh_independence independence;
    double fraction;
    nh_rank rank;         /* how independence was decided; undecided: by doubles */
    const char *relation; /* for a dependent one: "Phi3^2 = ...", or NULL */
    /* in terms of currents that the system's file knows, in brackets: "Phi4 = [Phi3]/a^2"; or NULL */
    const char *known;
    const char *doc; /* what the file says of the known current of which it is a multiple; or NULL */
    bool has_symmetry, local;
    bool on_both;            /* of two branches: as printed, current and field hold on the other one too */
    const char *region;      /* of a piece: where it holds, "for x > 0" */
    bool counted;            /* of a piece: it holds on the sides on which integrals are counted (integrals/region.h) */
    bool to_the_end;         /* of a piece: motions end where its region does, at walls where they have an impulse */
    const nh_series *series; /* NULL for a closed form */
    nh_symmetry symmetry;
    nh_drift drift;
} nh_current;

/* A combination that looks conserved in doubles and is not. */
typedef struct {
    nh_ex phi, in_velocities; /* in the chart; in t, q, q' and parameters */
    double digits;            /* digits to which its rate cancels at best, with coefficients of any accuracy */
    double rate;              /* root mean square of its rate over that of its variation, per unit of time */
} nh_near_current;

/* The grid of the sample points (search/grid.h). */
typedef struct {
    nh_grid_kind kind;
    bool in_file;     /* it stands in the analysis file */
    const char *path; /* of a file of points */
    bool velocities;  /* its rows are (t, q, v), else (t, q, w) */
    size_t rows;
    double *row;
} nh_grid;

typedef struct {
    const char *name; /* "z' < 0" */
    size_t points;
} nh_grid_branch;

enum { NH_GRID_MOST_BRANCHES = 8 };

/* What became of it: of the largest linear problem that was solved. */
typedef struct {
    size_t needed;                                      /* of a number of points that was refused: enough */
    size_t used, variables;                             /* variables: of a tensor or sparse grid, else 0 */
    size_t not_finite, not_solved, degenerate, outside; /* rejected: why */
    size_t branches;
    nh_grid_branch branch[NH_GRID_MOST_BRANCHES];
} nh_grid_report;

/* One linear problem and its answer. */
typedef struct {
    bool done;
    nh_verdict verdict;
    size_t columns, rows, rank, dimension, likely;
    double *spectrum, gap; /* with the digits that are known */
    bool rank_in_doubt;
} nh_spectrum;

enum { NH_MOST_ALMOST = 6, NH_MOST_PIECES = 6, NH_MOST_FURTHER = 24, NH_MOST_RELATIONS = 24 };

/* A product such as "Phi6^2", and the expression that it equals. */
typedef struct {
    const char *left, *right;
} nh_further_relation;

/* An integral that is a function of the others, and without which not all integrals are polynomials of the list. */
typedef struct {
    nh_current current;
    size_t degree; /* in the velocities */
} nh_further_integral;

/* The null vectors of a sampled problem: combinations of columns that are polynomials in the velocities. */
typedef struct {
    size_t degree, columns, dimension;
    bool timely; /* t occurs */
    bool fields; /* of a fit of fields */
    nh_ex *column;
    double *vector; /* columns x dimension */
} nh_sampled_space;

/* The null vectors compared with the counted space, where the count is complete to their degree: the space is spanned
 * by products of the currents. */
typedef struct {
    bool compared, agrees, fields;
    size_t degree, products;
    double angle; /* the largest distance of a null vector from the space */
} nh_counted_space;

/* What is true of a function that the system file calls a current (`known: currents`), or none (`not_conserved`): a
 * function of those found; conserved, but none; constant whatever the motion is; conserved in a part of the motions;
 * not conserved; not decided. */
typedef enum {
    NH_STATED_FOUND,
    NH_STATED_MISSED,
    NH_STATED_CONSTANT,
    NH_STATED_REGIONAL,
    NH_STATED_FALSE,
    NH_STATED_OPEN
} nh_stated_verdict;

typedef struct {
    const char *name, *text;
    const char *out_of_reach; /* why the search need not find it, or NULL */
    bool denied;              /* it is one of `not_conserved` */
    nh_stated_verdict verdict;
    const char *relation;          /* "[Phi3] = a^2*Phi4", the file's name in brackets; NULL: none was found */
    const char *region, *obstacle; /* where it holds; why nothing is decided; or NULL */
    bool proved;
    double digits;       /* to which the rate cancels, where it is conserved */
    double *state, rate; /* where it is not: model->width values (t, q, w, u), or NULL, and the rate there */
} nh_stated;

/* An option that excluded something, and the value from which on it would not; option: NULL: nothing was excluded. */
typedef struct {
    const char *option;
    double value;
} nh_limit;

/* How the search ended: all integrals of the kind that can exist are found, all stages were tried, or a limit (of work,
 * size or time) ended it. */
typedef enum { NH_SEARCH_COMPLETE, NH_SEARCH_EXHAUSTED, NH_SEARCH_CUT } nh_search;

/* A stage of the search. */
typedef struct {
    const char *name;
    /* sectors: parts that were solved separately; found: number of new independent currents */
    size_t columns, sectors, dimension, found;
    double gap, seconds;
    bool skipped, undecided; /* skipped: too large; undecided: likely null vectors without a certificate */
    nh_limit limit;          /* of a stage that was skipped */
} nh_stage_record;

typedef struct {
    double *value;
    nh_ex *recognised; /* per unknown: an expression, or 0 */
    const nh_hit *hit;
} nh_special;

typedef struct {
    double read, geometry, samples, unknowns, nullspace, currents, validation, total; /* seconds */
} nh_timing;

/* A curve of a figure: y over x; a path has a heading where one is drawn. */
typedef struct {
    const char *name; /* "E_T", "k = 2", "E_T, k = 2" */
    size_t quantity;  /* of the request; of a path 0 */
    double value;     /* value of the varied parameter; NAN: none is varied */
    size_t count;
    double *x, *y, *heading; /* heading: NULL: none is drawn */
} nh_figure_curve;

typedef struct {
    const nh_figure_request *request;
    size_t curves;
    nh_figure_curve *curve;
} nh_figure;

/* What is asked.  Written by the command before the search begins, and constant from then on. */
typedef struct {
    /* the command that repeats the analysis; command and analysis_path may be NULL */
    const char *command, *system_path, *analysis_path;
    const char *system_words; /* how a command line names the system; NULL: by its path */
    nh_system *system;
    nh_analysis_file *analysis; /* NULL: chosen by the program */
    nh_model *model, *other;    /* other: the coordinate chart beside a quasi one, or NULL */
    nh_distribution constraint; /* the kind of constraint */
    nh_options options;
    double pace; /* Omega of problem/time_scale.h where the system was found fast (or long), else 0 */
    nh_route route;
    nh_grid grid;
    bool samples_in_file; /* their number stands in the analysis file */
    size_t local_maximum; /* as many integrals as there are near a regular point: 2 m - k */
    uint64_t left_out;    /* rows of the search (staged_search.h) that a developer leaves out, bit i for row i */
    bool derived;         /* it is of a system that the search made from the user's (search/other_system.h) */
} nh_analysis_question;

/* The integrals, each of them checked.  Only search/current_list.h changes which there are. */
typedef struct {
    size_t count, capacity, independent;
    const nh_current *found; /* `count` of them, `independent` of which are */
    /* currents of a part of the motions only (integrals/region.h): not counted; at most NH_MOST_PIECES */
    size_t pieces;
    const nh_current *piece;
    /* polynomial in the velocities, and functions of the currents found: not counted.  The products of the currents
     * that the count uses do not give them.  At most NH_MOST_FURTHER */
    size_t furthers;
    const nh_further_integral *further;
} nh_current_list;

/* The question, the integrals, and a report of how they were found and what else is known of the system. */
struct nh_analysis {
    nh_arena *arena;
    const nh_analysis_question *question;
    const nh_current_list *list;
    /* ---- the report ---- */
    struct nh_theory *theory; /* where it was requested; else NULL */
    /* of a quadratic constraint: "z' < 0", the branch of the computation, and "z' > 0"; NULL: there are no branches */
    const char *branch, *other_branch;
    bool equations_on_both;  /* as printed, the equations hold on the other branch too */
    const char *ansatz_note; /* description of what was tried */
    /* beyond: points where the chart's pivot is near zero, from the multiplier form */
    size_t samples, beyond, rejected;
    nh_grid_report grid;
    size_t stages, stage_capacity;
    nh_stage_record *stage;        /* of the staged search; empty with an analysis file */
    uint64_t used;                 /* rows of the search that found something, bit i for row i */
    nh_spectrum current, symmetry; /* of fits of currents, of fields */
    bool routes_compared, routes_agree;
    double routes_angle;
    nh_sampled_space *sampled; /* NULL: an ansatz that the program chose, or not polynomial in the velocities */
    nh_counted_space counted_space;
    nh_hits *hits;
    size_t specials;
    nh_special *special;
    size_t open;        /* null vectors that may be true, but have no certificate */
    const char *letter; /* first letters of the names of currents, as Phi in Phi1; see nh_current_list_name */
    size_t relations;   /* polynomial ones among currents and further integrals; at most NH_MOST_RELATIONS */
    nh_further_relation *relation;
    size_t stateds; /* of the system file, in its order */
    nh_stated *stated;
    size_t almosts; /* nearly conserved quantities that the search found: at most NH_MOST_ALMOST */
    nh_near_current *almost;
    const struct nh_explicit_motion *motion; /* as formulas (search/explicit_motion.h); NULL: none is known */
    /* independent functions of (t, q) that the constraints hold constant, found; not those given between positions */
    size_t integrals;
    size_t *integral; /* list->found[integral[i]] */
    nh_completeness completeness[NH_COMPLETENESS_KINDS];
    nh_count_memory *counted;   /* while the search goes on */
    struct nh_absence *absence; /* is there any other integral (absence/absence.h); NULL: it was not asked */
    nh_verdict verdict;
    nh_search search;      /* the verdict cannot be NONE where the search was cut */
    nh_observables tracks; /* their values are in validation->watch, row by row */
    size_t figures;
    nh_figure *figure;         /* the expressions that the analysis file asks for */
    nh_validation *validation; /* NULL when no motion could be computed */
    size_t warnings;
    const char **warning;
    /* the last words of the warning that the energy is not conserved; NULL: none, or they are long */
    const char *energy_rate;
    bool partial; /* the limit of work or time, or the user, ended the search */
    nh_timing timing;
};

/* "complete", "exhausted", "cut". */
const char *nh_search_word(nh_search search);
/* "found", "not found", "constant", "in a region", "not conserved", "undecided". */
const char *nh_analysis_stated_word(nh_stated_verdict verdict);
/* "--option stage_columns=412": the setting that would include a stage that was too large.  In the arena. */
const char *nh_limit_words(nh_arena *arena, const nh_limit *limit);
/* The pieces that are constant along every motion, because motions end where the pieces do. */
size_t nh_analysis_to_the_end(const nh_analysis *result);
/* Were the unknowns of the ansatz sought by trial alone?  Then other values may give currents. */
bool nh_analysis_by_trial(const nh_analysis *result);
/* The number of stages that were too large. */
size_t nh_analysis_left_out(const nh_analysis *result);

/* A null space's numbers, copied into an arena. */
nh_spectrum nh_spectrum_of(nh_arena *arena, const nh_nullspace *nullspace);

/* Appends a copy of the text, unless it is there already or the list is full. */
void nh_analysis_warn(nh_analysis *result, const char *format, ...) __attribute__((format(printf, 2, 3)));

#endif

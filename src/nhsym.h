/* nhsym: symmetries and conservation laws of mechanical systems with constraints.
 *
 *     nh_context *context = nh_context_create();
 *     nh_error error = {0};
 *     nh_problem *problem = nh_problem_open(context, &(nh_question){.system = "sleigh"}, &error);
 *     nh_analysis *analysis = problem ? nh_analyze(problem, &error) : NULL;
 *     for (size_t i = 0; analysis && i < nh_analysis_currents(analysis); i++) {
 *         char *formula = nh_current_formula(analysis, i, NH_SYNTAX_PLAIN);
 *         puts(formula);
 *         nh_string_free(formula);
 *     }
 *
 * A fallible function takes an nh_error last, returns NULL or false on failure and fills the error.  No function prints
 * or ends the process.  Where an allocation fails the error is NH_LIMIT (without an nh_error: NULL, false or NAN), memory
 * of this call is lost, and its objects remain usable; nh_context_create sets the allocators of FLINT and GMP for it.
 * The caller owns a result, which remains valid without its problem and context; a const char * lives as long as the
 * object that gave it.  An nh_error may be NULL, and so may what is freed.  Threads with separate contexts are
 * independent; one thread at a time may use a context's objects.  Angles: radians, all else: as in the system file. */
/* clang-format off */
#ifndef NHSYM_H
#define NHSYM_H
#include <stdbool.h>
#include <stddef.h>
#ifdef __cplusplus
extern "C" {
#endif
#ifdef __GNUC__
#define NH_API __attribute__((visibility("default")))
#else
#define NH_API
#endif

/* ---- errors; the values of nh_code are the exit codes of the command line ---- */
typedef enum {
    NH_OK = 0,
    NH_REFUTED = 1,  /* the answer to the question is "no" */
    NH_USAGE = 2,    /* an invalid question: an option, a name */
    NH_INPUT = 3,    /* an error in a file */
    NH_NUMERIC = 4,  /* a numerical failure; the message gives the reason */
    NH_LIMIT = 5,    /* a limit of time, memory or iterations */
    NH_INTERRUPTED = 130
} nh_code;

typedef struct {
    nh_code code;
    char where[256];    /* "file:line:column", or empty */
    char what[768];     /* what is wrong and what was expected */
    char hint[512];     /* what to do next, or empty */
    char excerpt[1024]; /* the source line and a caret below it, or empty */
} nh_error;

NH_API void nh_error_clear(nh_error *error);
/* The whole message, several lines without a final newline, into `out` (always terminated). */
NH_API void nh_error_format(const nh_error *error, char *out, size_t size);
NH_API const char *nh_version_text(void); /* "0.2.0" */

/* ---- a context: the state of one thread's computations ---- */
typedef struct nh_context nh_context;
NH_API nh_context *nh_context_create(void);
NH_API void nh_context_free(nh_context *context);
/* The current step and its completed part in [0, 1]; below 0: unknown.  The computing thread calls `tell`; NULL: no calls. */
NH_API void nh_context_on_progress(nh_context *context, void (*tell)(void *data, const char *doing, double part), void *data);
/* The computation returns soon with partial results.  May be called from any thread or signal handler.  Later computations in this context are not affected. */
NH_API void nh_context_interrupt(nh_context *context);

/* ---- a question about a system ---- */
/* Members that are NULL, 0 or false are not given. */
typedef struct {
    const char *system;        /* a name ("sleigh") or the path of a system file, */
    const char *system_text;   /* or the text of one; `system` is then its name in messages */
    const char *analysis;      /* likewise an analysis file; NULL: the one with the name of the system, if it exists */
    const char *analysis_text;
    bool        no_analysis;   /* use no analysis file */
    const char *set;           /* parameters: "m=2, k=0.5" */
    const char *velocities;    /* "auto", "quasi" or "coordinates" */
    const char *initial;       /* "phi=0, omega=2" */
    double      until;         /* the end of motions; 0: that of the files, or 10 */
    double      step;          /* between outputs of a simulation; 0: a hundredth of the time */
    double      accuracy;      /* the largest allowed error of motions; 0: the option `tolerance`, errors not estimated */
    const char *watch;         /* observables of a simulation: "y, T = m/2*v^2" */
    const char *method;        /* of a simulation: an integrator that `nhsym explain methods` lists; NULL: the one that suits */
    const char *options;       /* of docs/options.md: "seed=3, samples=500" */
    bool        project;       /* an initial state that violates the constraints is moved onto them */
} nh_question;

/* The systems that have a name, a line for each: name, blanks, title.  Free the string by nh_string_free. */
NH_API char *nh_systems(nh_error *error);

typedef struct nh_problem nh_problem;
/* Reads the files.  The context must outlive the problem. */
NH_API nh_problem *nh_problem_open(nh_context *context, const nh_question *question, nh_error *error);
/* After its results, in the thread that worked with it: what the algebra keeps for this thread is given back, too. */
NH_API void nh_problem_free(nh_problem *problem);
/* A parameter becomes a function of time in all answers that are asked for afterwards: "9.81 + sin(t)", an expression
 * of t and the other parameters, or "FILE.csv:COLUMN", the broken line through a column over the column t.  On failure
 * the problem remains as it was. */
NH_API bool nh_problem_input(nh_problem *problem, const char *parameter, const char *input, nh_error *error);
NH_API const char *nh_problem_name(const nh_problem *problem);
NH_API size_t nh_problem_coordinates(const nh_problem *problem);
NH_API const char *nh_problem_coordinate(const nh_problem *problem, size_t index);
NH_API size_t nh_problem_parameters(const nh_problem *problem);
NH_API const char *nh_problem_parameter(const nh_problem *problem, size_t index, double *value); /* value may be NULL */

/* ---- answers ---- */
typedef struct nh_analysis     nh_analysis;     /* currents and symmetries */
typedef struct nh_simulation   nh_simulation;   /* one motion */
typedef struct nh_reduction    nh_reduction;    /* the symmetry group and the reduced equations */
typedef struct nh_verification nh_verification; /* of one current or field */
typedef struct nh_classified   nh_classified;   /* the values of parameters at which there are more currents */
typedef struct nh_benchmark    nh_benchmark;    /* integrators compared on one motion */
typedef struct nh_linearized   nh_linearized;   /* the linear equations at a state, or along a family of states */
typedef struct nh_export       nh_export;       /* equations, currents and reductions as code */
NH_API nh_analysis     *nh_analyze(nh_problem *problem, nh_error *error);
NH_API nh_simulation   *nh_simulate(nh_problem *problem, nh_error *error);
/* The same with zeros of expressions along the motion, as --event and --section take them; both may be NULL: "y = 0, falling, stop; x' - 1", "x, rising".  They stand in its JSON. */
NH_API nh_simulation *nh_simulate_zeros(nh_problem *problem, const char *events, const char *section, nh_error *error);
NH_API nh_reduction    *nh_reduce(nh_problem *problem, nh_error *error);
NH_API nh_verification *nh_verify_current(nh_problem *problem, const char *current, nh_error *error); /* "m*v" */
NH_API nh_verification *nh_verify_field(nh_problem *problem, const char *field, nh_error *error);     /* "Z0=1; phi=phi'; x=x'" */
NH_API bool nh_verification_holds(const nh_verification *verification);
NH_API bool nh_verification_proved(const nh_verification *verification);
/* Over up to three parameters: "k", "B, eps".  `shape`: only currents with coefficients free of cyclic coordinates. */
NH_API nh_classified   *nh_classify_over(nh_problem *problem, const char *parameter, bool shape, nh_error *error);

/* A comparison of integrators; NULL, or members that are NULL, 0 or false: all methods, 5 seconds. */
typedef struct {
    double      seconds;    /* for the measurements; 0: 5 */
    const char *methods;    /* only these, which `nhsym explain methods` lists: "rk8pd, dalembert" */
    bool        robustness; /* also maps of where methods fail, which compare five methods of their own */
    const char *over;       /* one such map, over one or two ranges: "a=1e-9:1, omega=1:9" */
} nh_comparison;
NH_API nh_benchmark    *nh_benchmark_methods(nh_problem *problem, const nh_comparison *comparison, nh_error *error);
/* At the state `initial` of the question, 0 where it is not given; over: NULL, or values: "x'=0:10:101". */
NH_API nh_linearized   *nh_linearize(nh_problem *problem, const char *over, nh_error *error);

NH_API void nh_analysis_free(nh_analysis *analysis);
NH_API void nh_simulation_free(nh_simulation *simulation);
NH_API void nh_reduction_free(nh_reduction *reduction);
NH_API void nh_verification_free(nh_verification *verification);
NH_API void nh_classified_free(nh_classified *classified);
NH_API void nh_benchmark_free(nh_benchmark *benchmark);
NH_API void nh_linearized_free(nh_linearized *linearized);
NH_API void nh_export_free(nh_export *export_);

/* The documents of the command line.  A reduction's LaTeX are its equations; a simulation's text is its table.  CSV:
 * simulation, reduction, benchmark, linearized; SVG: simulation, benchmark, linearized; else NULL with an error. */
typedef enum { NH_FORMAT_TEXT, NH_FORMAT_JSON, NH_FORMAT_HTML, NH_FORMAT_LATEX, NH_FORMAT_CSV,
               NH_FORMAT_SVG } nh_format;
NH_API char *nh_analysis_document(const nh_analysis *analysis, nh_format format, nh_error *error);
NH_API char *nh_simulation_document(const nh_simulation *simulation, nh_format format, nh_error *error);
NH_API char *nh_reduction_document(const nh_reduction *reduction, nh_format format, nh_error *error);
NH_API char *nh_verification_document(const nh_verification *verification, nh_format format, nh_error *error);
NH_API char *nh_classified_document(const nh_classified *classified, nh_format format, nh_error *error);
NH_API char *nh_benchmark_document(const nh_benchmark *benchmark, nh_format format, nh_error *error);
NH_API char *nh_linearized_document(const nh_linearized *linearized, nh_format format, nh_error *error);
NH_API void  nh_string_free(char *string); /* frees strings of all functions */
/* language: "c", "python", "sympy", "matlab", "js", "latex" or "json".  NULL, or parts: "equations, currents"; inputs:
 * parameters, "u, tau"; prefix: what all names begin with, instead of the system's name. */
NH_API nh_export *nh_export_functions(nh_problem *problem, const char *language, const char *parts, const char *inputs,
                                      const char *prefix, nh_error *error);
/* File number `file` and its name, both to be freed; NULL without an error after the last.  `name` NULL: all in one. */
NH_API char *nh_export_code(const nh_export *export_, size_t file, char **name, nh_error *error);

/* ---- an analysis ---- */
NH_API const char *nh_analysis_verdict(const nh_analysis *analysis); /* "FOUND", "FITTED", "NONE" or "UNDECIDED" */
NH_API const char *nh_analysis_search(const nh_analysis *analysis);  /* "complete", "exhausted" or "cut" */
NH_API size_t nh_analysis_currents(const nh_analysis *analysis);
NH_API size_t nh_analysis_independent(const nh_analysis *analysis);  /* functionally independent ones among them */
NH_API size_t nh_analysis_most(const nh_analysis *analysis);         /* the number that exists locally: 2m - k, with t one more */
typedef struct {
    const char *name;    /* "Phi1" */
    const char *meaning; /* "energy", "minus the momentum of x", or "" */
    bool   proved;       /* exactly, at least for the given parameters */
    bool   for_all;      /* proved for all parameter values */
    bool   independent;  /* of those before it */
    double digits;       /* to which its rate vanishes in ball arithmetic */
    double drift;        /* along the test motion, relative; NAN: none was computed */
} nh_current_facts;
NH_API nh_current_facts nh_current_describe(const nh_analysis *analysis, size_t index); /* strings live as long as the analysis */

typedef enum { NH_SYNTAX_PLAIN, NH_SYNTAX_LATEX, NH_SYNTAX_MATHML } nh_syntax;
/* A formula in t, coordinates, parameters and the velocities of the system file.  NULL: too long to be written.  Free the string by nh_string_free. */
NH_API char *nh_current_formula(const nh_analysis *analysis, size_t index, nh_syntax syntax);
/* Any formula in the language of system files ("J*phi'^2/2"), typeset.  NULL: it is none. */
NH_API char *nh_formula_typeset(const char *formula, nh_syntax syntax);
/* The value at a time, positions and velocities (one of each per coordinate, in their order); NAN where it is not defined. */
NH_API double nh_current_value(const nh_analysis *analysis, size_t index, double t, const double *q, const double *v);
/* The same at many states, faster for each: coordinate i of state j is q[i*count + j], likewise v; t[j] (NULL: 0).  False where the current has no such formula. */
NH_API bool nh_current_values(const nh_analysis *analysis, size_t index, size_t count, const double *t, const double *q, const double *v, double *out);

/* ---- a simulation: a table with time in column 0 ---- */
NH_API size_t nh_simulation_rows(const nh_simulation *simulation);
NH_API size_t nh_simulation_columns(const nh_simulation *simulation);
NH_API const char *nh_simulation_column(const nh_simulation *simulation, size_t column);
NH_API double nh_simulation_value(const nh_simulation *simulation, size_t row, size_t column);
NH_API void nh_simulation_read(const nh_simulation *simulation, size_t column, double *out); /* all rows */
/* One column against another as an SVG picture, with one scale on both axes where both are positions; NULL: there is no such column.  Free the string by nh_string_free. */
NH_API char *nh_simulation_svg(const nh_simulation *simulation, size_t x, size_t y);

/* ---- equations of motion ---- */
typedef struct nh_rates nh_rates;
NH_API nh_rates *nh_rates_create(nh_problem *problem, nh_error *error); /* remains valid without its problem */
NH_API void nh_rates_free(nh_rates *rates);
/* The accelerations of all coordinates at many states that satisfy the constraints, arranged as for nh_current_values; NAN where they are not determined. */
NH_API void nh_rates_at(nh_rates *rates, size_t count, const double *t, const double *q, const double *v, double *out);

#ifdef __cplusplus
}
#endif
#endif

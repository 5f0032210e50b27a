/* cli_table: one table of commands and one of options, for help, manual page, completions and the parser of the command
   line. */
#ifndef NH_CLI_TABLE_H
#define NH_CLI_TABLE_H

#include <stdbool.h>

/* Is `word` one of the words in `words`, which are separated by single blanks?  The tables name the commands of an
 * option so. */
bool nh_word_among(const char *words, const char *word);

/*    code           name           argument            shown as             of the commands      meaning */
#define NH_CLI_OPTION_TABLE(X)                                                                                         \
    X(opt_set, "set", required_argument, "NAME=VALUE",                                                                 \
      "analyze verify simulate benchmark reduce classify scan linearize export show", "set a parameter; repeatable")   \
    X(opt_wheel, "wheel", required_argument, "LINK[=RADIUS]",                                                          \
      "analyze verify simulate benchmark reduce classify scan linearize export show",                                  \
      "robots: this link rolls on the plane z = 0; repeatable")                                                        \
    X(opt_base, "base", required_argument, "fixed|planar|floating|free",                                               \
      "analyze verify simulate benchmark reduce classify scan linearize export show",                                  \
      "robots: how the root link is carried; planar with wheels, else fixed")                                          \
    X(opt_on, "on", required_argument, "\"p_x = 0\"", "analyze verify classify show",                                  \
      "on this level of an integral linear in the velocities, p_x: the momentum of x; repeatable")                     \
    X(opt_analysis, "analysis", required_argument, "FILE", "analyze simulate benchmark",                               \
      "read ansatz and motion from this analysis file")                                                                \
    X(opt_no_analysis, "no-analysis", no_argument, "", "analyze simulate benchmark",                                   \
      "ignore analysis files; the program chooses ansatz and motion")                                                  \
    X(opt_route, "route", required_argument, "both|fields|currents", "analyze",                                        \
      "fit symmetry fields first and currents then, or one of them alone")                                             \
    X(opt_velocities, "velocities", required_argument, "auto|quasi|coordinates",                                       \
      "analyze verify simulate benchmark export show", "velocities of the computation")                                \
    X(opt_json, "json", optional_argument, "[FILE|-]",                                                                 \
      "analyze verify simulate benchmark reduce classify scan linearize export show",                                  \
      "write JSON to FILE (- for standard output, and nothing else)")                                                  \
    X(opt_html, "html", required_argument, "FILE",                                                                     \
      "analyze verify simulate benchmark reduce classify scan linearize show",                                         \
      "write the result as one self-contained page")                                                                   \
    X(opt_tex, "tex", required_argument, "FILE",                                                                       \
      "analyze verify simulate benchmark reduce classify scan linearize export show",                                  \
      "write the result as a LaTeX document")                                                                          \
    X(opt_fragment, "fragment", no_argument, "", "analyze",                                                            \
      "LaTeX without a preamble, to include in another document")                                                      \
    X('o', "output", required_argument, "DIR",                                                                         \
      "analyze verify simulate reduce classify benchmark scan linearize export show new",                              \
      "-o: write all files into a folder; of `new`: the file")                                                         \
    X(opt_current, "current", required_argument, "EXPR", "verify", "is this conserved?")                               \
    X(opt_field, "field", required_argument, "\"Z0=..; x=..\"", "verify", "is this a constraint symmetry?")            \
    X(opt_equations, "equations", no_argument, "", "analyze verify reduce show",                                       \
      "also the geometry: forms, Gamma, determining equations; connection, curvature, H")                              \
    X(opt_absence, "absence", no_argument, "", "analyze",                                                              \
      "is there any other integral: all motions, levels and methods, not only the cheap ones")                         \
    X(opt_initial, "initial", required_argument, "\"phi=0, omega=2\"", "simulate benchmark reduce export",             \
      "initial state")                                                                                                 \
    X(opt_at, "at", required_argument, "\"x'=4, lean=0\"", "linearize", "the state; all else is 0 or follows")         \
    X(opt_project, "project", no_argument, "", "simulate benchmark reduce linearize",                                  \
      "project the initial positions and velocities onto the constraints")                                             \
    X(opt_initial_table, "initial-table", required_argument, "FILE", "simulate",                                       \
      "a motion per row of a CSV file: initial states and parameters by name")                                         \
    X(opt_method, "method", required_argument, "NAME", "simulate benchmark",                                           \
      "integrator, as `nhsym explain methods` lists them; auto: the one that suits")                                   \
    X(opt_step, "step", required_argument, "H", "simulate",                                                            \
      "output spacing; a method with a fixed step makes fixed_steps of them, 10, from one output to the next")         \
    X(opt_watch, "watch", required_argument, "\"x, T=m/2*v^2\"", "simulate",                                           \
      "only these quantities, from the smallest model that determines them")                                           \
    X(opt_event, "event", required_argument, "\"y = 0, falling, stop\"", "simulate",                                   \
      "zeros of an expression along the motion: rising, falling or both; stop: the first ends it; repeatable")         \
    X(opt_section, "section", required_argument, "\"x, rising\"", "simulate",                                          \
      "a Poincare section: a row for each zero of the expression, instead of the motion's table")                      \
    X(opt_axes, "axes", required_argument, "\"y, y'\"", "simulate",                                                    \
      "the two columns that the picture shows: a path, or a phase portrait; else columns over time")                   \
    X(opt_scene, "scene", no_argument, "", "simulate", "only the quantities of the analysis file")                     \
    X(opt_accuracy, "accuracy", required_argument, "EPS", "analyze simulate reduce",                                   \
      "largest error of the motions; the program chooses and checks method and tolerance")                             \
    X(opt_ensemble, "ensemble", required_argument, "N", "simulate",                                                    \
      "N motions at once, from states around the initial state")                                                       \
    X(opt_spread, "spread", required_argument, "S", "simulate", "relative spread of initial states")                   \
    X(opt_robustness, "robustness", no_argument, "", "benchmark", "maps of where the methods fail")                    \
    X(opt_fit, "fit", no_argument, "", "benchmark", "the discrete problem alone: error by samples, degree and time")   \
    X(opt_over, "over", required_argument, "RANGES", "simulate benchmark classify scan linearize",                     \
      "values or ranges of parameters; repeatable")                                                                    \
    X(opt_shape, "shape", no_argument, "", "classify",                                                                 \
      "only integrals whose coefficients do not depend on cyclic coordinates")                                         \
    X(opt_of, "of", required_argument, "WORDS", "verify scan classify export show", "the results to compute")          \
    X(opt_number, "number", required_argument, "NAME", "scan",                                                         \
      "a number by its path in the JSON, as in group.dimension; repeatable")                                           \
    X(opt_workers, "workers", required_argument, "N", "scan",                                                          \
      "processes that share the work; it does not change the result")                                                  \
    X(opt_chunk, "chunk", required_argument, "I/N", "scan", "only part I of N, for job arrays; then once without it")  \
    X(opt_budget, "budget", required_argument, "TIME", "benchmark", "time to spend on measurements: 5s, 200ms")        \
    X(opt_svg, "svg", required_argument, "FILE", "benchmark simulate linearize", "write a picture")                    \
    X(opt_pdf, "pdf", required_argument, "FILE", "benchmark simulate linearize",                                       \
      "the same picture as PDF, by the program rsvg-convert")                                                          \
    X(opt_csv, "csv", required_argument, "FILE", "benchmark simulate reduce scan linearize", "write a CSV table")      \
    X(opt_group, "group", required_argument, "FIELDS", "reduce export",                                                \
      "\"1, 2\" or \"x=1; theta=1\": the group to divide out")                                                         \
    X(opt_chain, "chain", required_argument, "\"3; 1, 2\"", "reduce",                                                  \
      "a chain of normal subgroups, for a reduction by stages")                                                        \
    X(opt_inner, "inner", required_argument, "\"1,4=1/2; 4,4=3\"", "reduce",                                           \
      "the inner product of generators that chooses the lifts by stages; else orthonormal")                            \
    X(opt_weak, "weak", no_argument, "", "reduce export", "also allow symmetries up to a total derivative")            \
    X(opt_to, "to", required_argument, "c|python|sympy|matlab|js|latex|json", "reduce export",                         \
      "the language of the exported code")                                                                             \
    X(opt_input, "input", required_argument, "\"u=sin(t)\"", "simulate export",                                        \
      "parameters that are inputs; repeatable")                                                                        \
    X(opt_like, "like", required_argument, "SYSTEM|FILE", "new", "the system to begin with")                           \
    X(opt_name, "name", required_argument, "NAME", "export", "what names of files and functions begin with")           \
    X(opt_tolerance, "tolerance", required_argument, "EPS", "analyze simulate benchmark reduce",                       \
      "relative tolerance of the motions")                                                                             \
    X(opt_until, "until", required_argument, "T", "analyze simulate benchmark reduce", "end time of the motions")      \
    X(opt_seed, "seed", required_argument, "N", "analyze export", "seed of all random choices")                        \
    X(opt_samples, "samples", required_argument, "N", "analyze", "number of sample points")                            \
    X(opt_grid, "grid", required_argument, "sobol|halton|tensor|sparse|motion|FILE.csv", "analyze benchmark",          \
      "where the equations are sampled")                                                                               \
    X(opt_columns, "columns", required_argument, "N", "analyze", "number of columns of the largest ansatz")            \
    X(opt_degree, "degree", required_argument, "D", "analyze classify scan",                                           \
      "count integrals polynomial in the velocities up to this degree")                                                \
    X(opt_threads, "threads", required_argument, "N", "analyze", "number of threads; it does not change the result")   \
    X(opt_max_seconds, "max-seconds", required_argument, "S",                                                          \
      "analyze verify simulate benchmark reduce classify scan linearize export show",                                  \
      "time limit: the run ends then, with partial results")                                                           \
    X(opt_max_memory, "max-memory", required_argument, "SIZE",                                                         \
      "analyze verify simulate benchmark reduce classify scan linearize export show",                                  \
      "the same for the memory: 500M, 2G")                                                                             \
    X(opt_option, "option", required_argument, "NAME=VALUE",                                                           \
      "analyze verify simulate benchmark reduce classify scan linearize export show",                                  \
      "set an option that `nhsym explain options` lists")                                                              \
    X(opt_progress, "progress", required_argument, "auto|always|never",                                                \
      "analyze verify simulate benchmark reduce classify scan linearize export show",                                  \
      "show the current step on standard error")                                                                       \
    X('q', "quiet", no_argument, "",                                                                                   \
      "analyze verify simulate benchmark reduce classify scan linearize export show new",                              \
      "-q: print only tables and code")                                                                                \
    X('v', "details", no_argument, "", "analyze verify simulate benchmark reduce classify scan linearize show",        \
      "-v: everything: symmetries, equations, checks, how it was searched")                                            \
    X(opt_no_color, "no-color", no_argument, "",                                                                       \
      "analyze verify simulate benchmark reduce classify scan linearize export show",                                  \
      "no colours; NO_COLOR does the same")                                                                            \
    X('h', "help", no_argument, "", "", "-h: list the options of the command")                                         \
    X(opt_version, "version", no_argument, "", "", "print the version")

/* What an option means for one of its commands, where the table above cannot say it for all:
 * option, commands, meaning. */
#define NH_CLI_MEANING_TABLE(X)                                                                                        \
    X("over", "simulate", "a motion for each value of a parameter, coordinate or velocity: k=1:2:11; repeatable")      \
    X("over", "benchmark", "maps of where the methods fail over these ranges: a=1e-9:1, omega=1:9; repeatable")        \
    X("over", "classify", "the parameter, or up to three of them: B,eps")                                              \
    X("over", "scan", "the grid: values of a parameter, k=1:4:61 or k=1,2,5/2; repeatable")                            \
    X("over", "linearize", "values of a parameter, a coordinate or a velocity: \"x'=0:10:101\"")                       \
    X("project", "linearize", "move positions and velocities onto the constraints")                                    \
    X("of", "verify", "the field is a symmetry of this: constraint, or equations (of motion)")                         \
    X("of", "classify", "the question: currents, measure, hamiltonization, symmetries, constraints or absence")        \
    X("of", "scan", "which numbers: count (of integrals), analyze or reduce")                                          \
    X("of", "export", "the parts: equations, momenta, submanifold, currents, reduced")                                 \
    X("of", "show", "only these names, one per line: parameters, coordinates, velocities")                             \
    X("equations", "show",                                                                                             \
      "the geometry: chart, Lagrangian, fields, coefficients, equations; with --details all forms")                    \
    X("output", "scan", "the folder of its parts and its result")                                                      \
    X("output", "export", "write the code into files of this folder")                                                  \
    X("csv", "benchmark", "write a table: a row for each run, with step or tolerance, error, time and observed order") \
    X("csv", "simulate", "write the table into this file")                                                             \
    X("csv", "reduce", "write a table of the motions: full and reduced")                                               \
    X("csv", "scan", "write the table of the points into this file, instead of scan.csv of the folder")                \
    X("method", "benchmark", "only this integrator of those that `nhsym explain methods` lists; repeatable")           \
    X("svg", "benchmark", "write a picture: seconds and evaluations against error")                                    \
    X("svg", "simulate", "write a picture: the columns over time, or a section")                                       \
    X("csv", "linearize", "write a table: an eigenvalue per row, or a value of --over per row")                        \
    X("svg", "linearize", "write a picture: the eigenvalues in the plane, or over a parameter")                        \
    X("to", "reduce", "print the reduced equations as code, or the motions as csv")                                    \
    X("input", "simulate", "a parameter over time: an expression of t, or FILE.csv:COLUMN")                            \
    X("input", "export", "parameters that are arguments of the code: \"u, v\"")

/* Old names: still read, but not shown.  Options: code, old name, argument; commands: old name, name. */
#define NH_CLI_OLD_OPTION_TABLE(X)                                                                                     \
    X(opt_velocities, "chart", required_argument)                                                                      \
    X('v', "verbose", no_argument)                                                                                     \
    X(opt_robustness, "stress", no_argument)
#define NH_CLI_OLD_COMMAND_TABLE(X) X("chart", "benchmark")

/* The command of this name, old or not; else the word itself.  And the command whose name, old or not, is nearest to
 * a word, or NULL. */
const char *nh_cli_command_name(const char *word);
const char *nh_cli_command_near(const char *word);

/* name, what follows it, meaning, an example */
#define NH_CLI_COMMAND_TABLE(X)                                                                                        \
    X(analyze, "SYSTEM|FILE", "find conserved quantities and their symmetries",                                        \
      "nhsym analyze sleigh --html report.html")                                                                       \
    X(verify, "SYSTEM|FILE", "is this conserved? is this a symmetry?",                                                 \
      "nhsym verify sleigh --current \"m*v*sin(phi/k) + m*a*k*omega*cos(phi/k)\"")                                     \
    X(simulate, "SYSTEM|FILE", "compute a motion: a table, CSV or JSON",                                               \
      "nhsym simulate sleigh --initial \"phi=0, omega=2\" --until 5 --step 0.1 > motion.csv")                          \
    X(benchmark, "SYSTEM|FILE", "compare integrators on one motion",                                                   \
      "nhsym benchmark sleigh --budget 1s --svg sleigh.svg")                                                           \
    X(reduce, "SYSTEM|FILE", "find the symmetry group, reduce the equations",                                          \
      "nhsym reduce vertical_disk --group \"1, 2\"")                                                                   \
    X(classify, "SYSTEM|FILE", "find parameters at which more is conserved",                                           \
      "nhsym classify penning_trap --over w --degree 2")                                                               \
    X(scan, "SYSTEM|FILE", "numbers over a grid of parameters, and jumps",                                             \
      "nhsym scan sleigh --over k=1:4:61 -o scan")                                                                     \
    X(linearize, "SYSTEM|FILE", "linear equations at a state, and stability", "nhsym linearize sleigh --at \"v=1\"")   \
    X(export, "SYSTEM|FILE", "equations, currents and reductions as code", "nhsym export sleigh --to c -o code")       \
    X(list, "[WORD]", "list the available systems, or those with a word", "nhsym list pendulum")                       \
    X(show, "SYSTEM|FILE", "print a system file, or its equations", "nhsym show sleigh --equations")                   \
    X(new, "NAME", "write NAME.yaml, a system to edit", "nhsym new mine --like double_pendulum")                       \
    X(explain, "[TOPIC]", "define a word of the report", "nhsym explain gap")                                          \
    X(version, "", "print the version", "nhsym version")                                                               \
    X(help, "[COMMAND]", "describe a command: options and an example", "nhsym help analyze")

#endif

/* cli_table: every command and option in one table each; help, manual page and completions print from them, and the command line is read by them. */
#ifndef NH_CLI_TABLE_H
#define NH_CLI_TABLE_H

#include <stdbool.h>

/* Is it one of the words, which single blanks separate?  So the tables name the commands of an option. */
bool nh_word_among(const char *words, const char *word);

/*    code           name           argument            shown as             of the commands      meaning */
#define NH_CLI_OPTION_TABLE(X)                                                                                                                                     \
    X(opt_set,         "set",         required_argument, "NAME=VALUE",         "analyze verify simulate benchmark reduce", "another parameter value; repeatable")      \
    X(opt_analysis,    "analysis",    required_argument, "FILE",               "analyze simulate benchmark", "the ansatz and the motion")                              \
    X(opt_no_analysis, "no-analysis", no_argument,       "",                   "analyze simulate benchmark", "the program chooses them, whatever files there are")     \
    X(opt_velocities,  "velocities",  required_argument, "auto|quasi|coordinates", "analyze verify simulate benchmark", "which velocities to compute in")                  \
    X(opt_json,        "json",        optional_argument, "[FILE|-]",           "analyze verify simulate benchmark reduce", "the result as JSON; with - nothing else is printed") \
    X(opt_html,        "html",        required_argument, "FILE",               "analyze verify simulate benchmark reduce", "the result as one page that needs nothing else") \
    X(opt_tex,         "tex",         required_argument, "FILE",               "analyze", "the result as a LaTeX document")                                        \
    X(opt_fragment,    "fragment",    no_argument,       "",                   "analyze", "the LaTeX without a preamble, to be read by another")                      \
    X('o',             "output",      required_argument, "DIR",                "analyze", "-o: all of these and every figure, into a folder")                      \
    X(opt_current,     "current",     required_argument, "EXPR",               "verify", "is this conserved?")                                                     \
    X(opt_field,       "field",       required_argument, "\"Z0=..; x=..\"",    "verify", "is this a constraint symmetry?")                                         \
    X(opt_initial,     "initial",     required_argument, "\"phi=0, omega=2\"", "simulate benchmark reduce", "the initial state")                                       \
    X(opt_project,     "project",     no_argument,       "",                   "simulate benchmark reduce", "move initial velocities onto the constraints")            \
    X(opt_step,        "step",        required_argument, "H",                  "simulate", "output spacing")                                                       \
    X(opt_watch,       "watch",       required_argument, "\"x, T=m/2*v^2\"",   "simulate", "only these quantities, by the smallest model for them")                \
    X(opt_scene,       "scene",       no_argument,       "",                   "simulate", "only the quantities of the analysis file")                             \
    X(opt_accuracy,    "accuracy",    required_argument, "EPS",                "analyze simulate reduce", "the error of the motions: method and tolerance are chosen, and checked") \
    X(opt_ensemble,    "ensemble",    required_argument, "N",                  "simulate", "many motions at once, from states around the initial one")             \
    X(opt_spread,      "spread",      required_argument, "S",                  "simulate", "relative spread of initial states")                                             \
    X(opt_robustness,  "robustness",  no_argument,       "",                   "benchmark", "maps of where the methods are accurate and where they fail")              \
    X(opt_over,        "over",        required_argument, "\"a=1e-9:1, omega=1:9\"", "benchmark", "the robustness map of these ranges: parameters, initial values, options") \
    X(opt_budget,      "budget",      required_argument, "TIME",               "benchmark", "how long to measure: 5s, 200ms")                                          \
    X(opt_svg,         "svg",         required_argument, "FILE",               "benchmark", "time against error as a picture")                                         \
    X(opt_group,       "group",       required_argument, "FIELDS",             "reduce", "\"1, 2\" or \"x=1; theta=1\": what to reduce by")                        \
    X(opt_chain,       "chain",       required_argument, "\"3; 1, 2\"",        "reduce", "the stages")                                                             \
    X(opt_weak,        "weak",        no_argument,       "",                   "reduce", "also allow symmetries up to a total derivative")              \
    X(opt_to,          "to",          required_argument, "c|latex",            "reduce", "write the equations as code")                                            \
    X(opt_tolerance,   "tolerance",   required_argument, "EPS",                "analyze simulate benchmark reduce", "of the motions")                                  \
    X(opt_until,       "until",       required_argument, "T",                  "analyze simulate benchmark reduce", "their end")                                       \
    X(opt_seed,        "seed",        required_argument, "N",                  "analyze", "of every random choice")                                                \
    X(opt_samples,     "samples",     required_argument, "N",                  "analyze", "sample points")                                                         \
    X(opt_columns,     "columns",     required_argument, "N",                  "analyze", "largest ansatz that is tried")                                          \
    X(opt_degree,      "degree",      required_argument, "D",                  "analyze", "count integrals polynomial in the velocities up to this degree")        \
    X(opt_threads,     "threads",     required_argument, "N",                  "analyze", "processors to use; they do not change the result")                      \
    X(opt_max_seconds, "max-seconds", required_argument, "S",                  "analyze verify simulate benchmark reduce", "an emergency brake: the time after which the run ends, with what there is") \
    X(opt_option,      "option",      required_argument, "NAME=VALUE",         "analyze verify simulate benchmark reduce", "any number of `nhsym explain options`")    \
    X(opt_progress,    "progress",    required_argument, "auto|always|never",  "analyze verify simulate benchmark reduce", "what is being done, on standard error")           \
    X('q',             "quiet",       no_argument,       "",                   "analyze verify simulate benchmark reduce new", "-q: no summary")                       \
    X('v',             "verbose",     no_argument,       "",                   "analyze simulate benchmark reduce", "-v: more of it")                                    \
    X(opt_no_color,    "no-color",    no_argument,       "",                   "analyze verify simulate benchmark reduce", "no colours; NO_COLOR does the same")       \
    X('h',             "help",        no_argument,       "",                   "", "-h: the options of the command")                                               \
    X(opt_version,     "version",     no_argument,       "",                   "", "the version")

/* Old names: still read, and shown nowhere.  Of options: code, old name, argument; of commands: old name, name. */
#define NH_CLI_OLD_OPTION_TABLE(X)                    \
    X(opt_velocities, "chart",  required_argument)    \
    X(opt_robustness, "stress", no_argument)
#define NH_CLI_OLD_COMMAND_TABLE(X) X("chart", "benchmark")

/* The command of this name, old or not; else the word itself.  And the command whose name, old or not, is nearest to
 * a word, or NULL. */
const char *nh_cli_command_name(const char *word);
const char *nh_cli_command_near(const char *word);

/* name, what follows it, meaning, an example */
#define NH_CLI_COMMAND_TABLE(X)                                                                                                                      \
    X(analyze,  "SYSTEM|FILE", "currents, their symmetries and their checks", "nhsym analyze sleigh --html report.html")                     \
    X(verify,   "SYSTEM|FILE", "is this conserved? is this a symmetry?", "nhsym verify sleigh --current \"m*v*sin(phi/k) + m*a*k*omega*cos(phi/k)\"") \
    X(simulate, "SYSTEM|FILE", "a motion, as CSV or JSON", "nhsym simulate sleigh --initial \"phi=0, omega=2\" --until 5 --step 0.1")                  \
    X(benchmark, "SYSTEM|FILE", "integrators compared: error against cost", "nhsym benchmark sleigh --budget 1s --svg sleigh.svg") \
    X(reduce,   "SYSTEM|FILE", "its symmetry group, and the reduced equations", "nhsym reduce vertical_disk --group \"1, 2\"")                          \
    X(list,     "",            "list available systems", "nhsym list")                                                                                  \
    X(show,     "SYSTEM",      "a system file", "nhsym show sleigh")                                                                                   \
    X(new,      "NAME",        "write NAME.yaml, a system to start from", "nhsym new skate")                                                           \
    X(explain,  "[WORD]",      "what a word of the report means", "nhsym explain gap")                                                                 \
    X(version,  "",            "the version", "nhsym version")                                                                                         \
    X(help,     "[COMMAND]",   "a command, its options and an example", "nhsym help analyze")

#endif

/* option: the table of numerical options: name, default, range, kind (real or whole), unit, meaning.
 *
 * The command line (--option NAME=VALUE), `nhsym explain options` and docs/options.md all print from it. */
#ifndef NH_OPTION_H
#define NH_OPTION_H

#include <stddef.h>

#include "base/error.h"

/*        name          default  least   most   kind   unit        meaning */
#define NH_OPTION_TABLE(X)                                                                                             \
    X(samples, 0, 0, 1e7, whole, "points", "fit points; 0: four per column, at least 256")                             \
    X(seed, 1, 0, 1e15, whole, "", "seed of the low-discrepancy samples and of every random choice")                   \
    X(columns, 1500, 1, 20000, whole, "columns", "largest ansatz that is tried")                                       \
    X(stage_columns, 330, 1, 20000, whole, "columns", "largest part of one stage when the program chooses")            \
    X(split_columns, 90, 1, 20000, whole, "columns",                                                                   \
      "a stage with more columns than this is split by discrete symmetries")                                           \
    X(threads, 0, 0, 64, whole, "threads",                                                                             \
      "that share the work; 0: one per processor; the result does not depend on it")                                   \
    X(work, 1e4, 0, 1e9, real, "millions",                                                                             \
      "of units of work (about a nanosecond each) after which the search by stages ends")                              \
    X(max_seconds, 120, 0, 1e7, real, "s",                                                                             \
      "time after which the search ends, even if work is left: a limit for slow machines")                             \
    X(max_memory, 0, 0, 1e9, real, "MB",                                                                               \
      "memory of the process at which a run ends, with partial results; 0: 3/4 of what there is")                      \
    X(rank, 1e-9, 0, 1, real, "", "columns whose pivot is below this part of the first are dependent")                 \
    X(zero, 100, 1, 1e6, real, "epsilon", "generalized singular values up to zero*epsilon*max(1,largest) are null")    \
    X(undecided, 1e5, 1, 1e10, real, "", "up to this many times the null bound a value is undecided")                  \
    X(gap, 1e3, 1, 1e15, real, "", "least ratio of the smallest nonzero to the largest vanishing singular value")      \
    X(steepest, 1e6, 1, 1e15, real, "", "largest singular value that may raise the null bound")                        \
    X(likely, 1e-7, 0, 1, real, "", "values up to this, before the widest gap, are tried for a certificate")           \
    X(trivial, 1e-11, 0, 1, real, "", "a column that varies by less than this part of its size is constant")           \
    X(split, 1e-4, 0, 1, real, "", "pencil eigenvalues below this are split Jordan blocks at zero")                    \
    X(heldout, 1e-8, 0, 1, real, "", "largest relative residual of a current on points not used in the fit")           \
    X(slow, 1e-2, 0, 1e6, real, "",                                                                                    \
      "a function that changes by less than this part of its variation in a unit of time is almost conserved")         \
    X(support, 3e-7, 0, 1, real, "", "coefficients below this part of the largest are tried as zero")                  \
    X(sure, 1e-2, 0, 1, real, "", "gradient fraction above which a current is independent")                            \
    X(doubt, 1e-6, 0, 1, real, "", "gradient fraction below which a current is dependent")                             \
    X(same, 1e-9, 0, 1, real, "", "relative difference below which two fields agree at a point")                       \
    X(recognise, 1e-10, 0, 1, real, "", "relative difference below which a number is taken for a simple one")          \
    X(agreement, 1e-8, 0, 1, real, "", "largest angle between spaces found by two fits, or counted")                   \
    X(evaluations, 200, 10, 1e7, whole, "", "objective evaluations of the global search per unknown")                  \
    X(bits, 256, 64, 4096, whole, "bits", "working precision of ball arithmetic")                                      \
    X(digits, 50, 10, 1000, whole, "digits", "digits to which a residual must vanish to be certified")                 \
    X(proof_terms, 20000, 100, 1e7, whole, "terms",                                                                    \
      "largest polynomial that an exact proof may use; five times as large for what balls certify")                    \
    X(named, 1, 0, 1, whole, "",                                                                                       \
      "coefficients without elementary form: 1: named functions (Legendre, Gauss, Bessel, ..) are tried before a "     \
      "series; 0: they are not")                                                                                       \
    X(series_degree, 256, 8, 4096, whole, "",                                                                          \
      "largest degree of a Chebyshev series of a coefficient without closed form; where it needs more, its interval "  \
      "is shorter")                                                                                                    \
    X(degree, 0, 0, 12, whole, "",                                                                                     \
      "integrals polynomial in the velocities are counted up to this degree; 0: 6 for two coordinates, 4 up to four, " \
      "2 for more")                                                                                                    \
    X(count_work, 2e8, 0, 1e15, real, "products",                                                                      \
      "of residues that one count may take; where a bound still falls, and for the first bound, five times as many; "  \
      "for --degree, and for the first bound in up to four coordinates, ten times")                                    \
    X(construct, 2e9, 0, 1e15, real, "products",                                                                       \
      "of residues that constructing what one count misses may take; 0: nothing is constructed")                       \
    X(words, 2000, 1, 20000, whole, "words",                                                                           \
      "functions of the coordinates that the coefficients of a missing integral are made of, at most")                 \
    X(quadrature_length, 400, 10, 1e6, whole, "symbols", "longer formulas are not integrated for explicit motions")    \
    X(pencil, 6000, 10, 1e6, whole, "unknowns", "classify: largest linear system for integrals at a degree")           \
    X(plane, 100, 2, 1e4, whole, "", "classify over two or three parameters: largest determinant")                     \
    X(lines, 10, 0, 1000, whole, "",                                                                                   \
      "classify over two parameters: beyond `plane` the first one takes all ratios up to this height; 0: none")        \
    X(planes, 4, 0, 100, whole, "",                                                                                    \
      "classify over three parameters: the first one takes all ratios up to this height; 0: none")                     \
    X(staircase, 5e10, 1e6, 1e15, real, "products",                                                                    \
      "classify: of residues that looking for the values of one degree may take")                                      \
    X(theorem, 150, 0, 1e5, whole, "primes",                                                                           \
      "classify: the largest number for a proof about every real and complex number; 0: no such proof")                \
    X(absence, 0, 0, 1, whole, "",                                                                                     \
      "analyze: 1: all motions, levels and methods for the question whether there is any other integral, as "          \
      "--absence; 0: the cheap ones")                                                                                  \
    X(lifts, 0, 0, 1, whole, "", "1: lifts orthogonal by --inner, 0: by kinetic energy")                               \
    X(shown, 600, 10, 1e9, whole, "symbols", "documents omit formulas four times as long")                             \
    X(written, 1e6, 10, 1e9, whole, "symbols", "longer formulas are null in JSON")                                     \
    X(tolerance, 1e-10, 1e-14, 1e-2, real, "", "relative tolerance of the motions")                                    \
    X(absolute, 1e-3, 0, 1e6, real, "",                                                                                \
      "part of a state's largest size so far below which errors are absolute; benchmark: the size")                    \
    X(drift, 100, 1, 1e6, real, "tolerance",                                                                           \
      "a current that drifts by more tolerances must drift less at smaller ones")                                      \
    X(steps, 2e5, 10, 1e9, whole, "steps", "a motion that needs more steps than this ends with a message")             \
    X(fixed_steps, 10, 1, 1e6, whole, "steps",                                                                         \
      "simulate --method: steps of a method with a fixed step between two outputs")                                    \
    X(group, 1e-7, 0, 1, real, "", "equations of a symmetry group, scaled to size one: what is below this vanishes")   \
    X(transversal, 5e-3, 0, 1, real, "",                                                                               \
      "a group is divided out by Chaplygin reduction when its orbits stay so far from the distribution")               \
    X(cluster, 2e-3, 0, 1, real, "",                                                                                   \
      "eigenvalues nearer than this part of the largest belong to one ideal of an algebra")                            \
    X(transport, 1e-11, 1e-14, 1e-4, real, "", "tolerance to which 1-jets of symmetries are transported")              \
    X(transport_steps, 4000, 1, 1e9, whole, "steps", "largest number of steps of the transport of 1-jets")             \
    X(jets, 240, 1, 1e5, whole, "unknowns",                                                                            \
      "reduce: m coordinates give m (m + 1)/2 unknowns of local symmetries of the metric; more are not solved for")    \
    X(ideals, 24, 1, 1000, whole, "dimensions", "reduce: a larger Lie algebra is not decomposed into ideals")          \
    X(compile, 1, 0, 1e6, real, "",                                                                                    \
      "interpreting a motion's equations may take so many times the work of compiling; then they are compiled; 0: "    \
      "never")                                                                                                         \
    X(robustness_tolerance, 1e-8, 1e-14, 1e-2, real, "", "of the motions of benchmark --robustness")                   \
    X(robustness_error, 1e-4, 1e-12, 1, real, "", "an error up to this is accurate in benchmark --robustness")         \
    X(robustness_steps, 3e4, 10, 1e10, whole, "steps",                                                                 \
      "step limit of benchmark --robustness; a motion beyond it is a timeout")                                         \
    X(robustness_columns, 40, 2, 2000, whole, "columns",                                                               \
      "benchmark --robustness: largest ansatz of the discrete problem")                                                \
    X(benchmark_error, 1e-2, 1e-12, 1e6, real, "",                                                                     \
      "benchmark: an error above this, and above benchmark_far tolerances, is not accurate")                           \
    X(benchmark_far, 1e4, 1, 1e15, real, "tolerance", "benchmark: how far above its tolerance an error may be")        \
    X(benchmark_fixed, 0.1, 1e-12, 1e6, real, "", "benchmark: with a fixed step, an error above this is not accurate") \
    X(benchmark_trusted, 1e-4, 1e-14, 1, real, "",                                                                     \
      "benchmark: the search for a reference stops when its two methods agree to this")                                \
    X(benchmark_closed, 100, 1, 1e15, real, "",                                                                        \
      "benchmark: largest error of a closed form, in multiples of the difference of two methods")                      \
    X(benchmark_steps, 32, 1, 1e6, whole, "steps",                                                                     \
      "benchmark: their number with the longest fixed step; four times as many at each further level")                 \
    X(benchmark_columns, 220, 2, 5000, whole, "columns", "benchmark: largest ansatz of the discrete problem")          \
    X(check_work, 4000, 1, 1e9, real, "millions", "of units of work that the motions of the check may take together")  \
    X(scan_columns, 120, 2, 5000, whole, "columns",                                                                    \
      "scan: largest ansatz space whose smallest singular value is followed")                                          \
    X(scan_root, 1e-6, 1e-14, 1, real, "",                                                                             \
      "scan: a minimum of a singular value is a root if it is below this fraction of the neighbouring values")         \
    X(until, 10, -1e9, 1e9, real, "time", "end of the validation motion")

typedef enum { NH_OPTION_real, NH_OPTION_whole } nh_option_kind;

/* Old names: still read, but not shown. */
#define NH_OPTION_OLD_TABLE(X)                                                                                         \
    X(stress_tolerance, robustness_tolerance)                                                                          \
    X(stress_error, robustness_error)                                                                                  \
    X(stress_steps, robustness_steps)                                                                                  \
    X(stress_columns, robustness_columns)                                                                              \
    X(chart_wrong, benchmark_error)                                                                                    \
    X(chart_far, benchmark_far)                                                                                        \
    X(chart_fixed, benchmark_fixed)                                                                                    \
    X(chart_trusted, benchmark_trusted)                                                                                \
    X(chart_closed, benchmark_closed)                                                                                  \
    X(chart_steps, benchmark_steps)                                                                                    \
    X(chart_columns, benchmark_columns)

typedef struct {
#define X(name, value, low, high, kind, unit, doc) double name;
    NH_OPTION_TABLE(X)
#undef X
} nh_options;

/* Every option at its default. */
void nh_options_default(nh_options *options);

/* "name=value" or a name and a value; unknown names, values out of range and fractions of what is whole are refused
   with a suggestion. */
bool nh_options_set(nh_options *options, const char *name, const char *value, nh_error *error);

/* Today's name of an option that is given by an old name; any other word unchanged. */
const char *nh_option_name(const char *word);

/* For documentation and help. */
typedef struct {
    const char *name, *unit, *doc;
    double value, low, high;
    nh_option_kind kind;
} nh_option_row;
size_t nh_option_count(void);
nh_option_row nh_option_at(size_t index);

#endif

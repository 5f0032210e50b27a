/* named_coefficients: currents f(s) a + h(s) b, a and b velocities or
 * coordinates, whose coefficients are functions with names.
 *
 * Where Gamma(a) and Gamma(b) are Gamma(s) times combinations of a and b alone,
 * with coefficients A that depend on s,
 *
 *     f' = -A_aa f - A_ba h,    h' = -A_ab f - A_bb h, (31)
 *
 * is equivalent to one equation of second order, exactly and over all
 * parameters (named_variable.h, named_match.h).  A position q stands for
 * q Gamma(s): of a plane wave x' f(u) + x u' h(u). */
#ifndef NH_NAMED_COEFFICIENTS_H
#define NH_NAMED_COEFFICIENTS_H

#include "base/memory.h"
#include "geometry/model.h"

enum { NH_MOST_NAMED = 8 };

/* Currents, proved, into `out`; their number.  a and b: symbols of `word`, or
 * `form`, combinations of these with coefficients that depend on s, in which
 * the equation may be simpler.  *open: the equation of a pair that matches
 * nothing, as a text in the arena; or NULL. */
size_t nh_named_coefficients(const nh_model *model, nh_ex variable, size_t words, const nh_ex *word, size_t forms,
                             const nh_ex *form, nh_arena *arena, nh_ex out[NH_MOST_NAMED], const char **open);

/* The value of a function of s at the middle of its sampling interval, with the parameters' values. */
double nh_named_typical(const nh_model *model, nh_ex s, nh_ex e);

#endif

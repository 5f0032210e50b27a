/* currents: from null vectors to readable currents with all checks. */
#ifndef NH_CURRENTS_H
#define NH_CURRENTS_H

#include "search/current_checker.h"

/* Draws the held-out and the generic points.  Keeps the analysis, which has to outlive it.  NULL with an error
 * where the domain has too few usable points. */
nh_current_checker *nh_current_checker_create(nh_analysis *result, nh_error *error);
void nh_current_checker_free(nh_current_checker *bench);

/* Refines a candidate, recognises its coefficients, normalises, proves, holds out and classifies it, and appends it to
 * result->found unless it turns out not to be conserved (then a warning says so).  `fit`: the points of its null space.
 * `certain`: the null space was certain; otherwise the candidate needs a certificate, and without one there is no
 * warning. */
bool nh_currents_add(nh_current_checker *bench, nh_candidate *candidate, const nh_points *fit, bool certain);

/* The last current holds at the given parameters only, phi for all: phi replaces it if it is a function of phi and the
 * other currents; otherwise phi is placed before it.  Nothing happens where phi depends on the other currents.  Is it
 * replaced? */
bool nh_currents_exchange_last(nh_current_checker *bench, nh_ex phi);

/* The last current is added again, as this candidate; where that fails it stays. */
void nh_currents_add_again(nh_current_checker *bench, nh_candidate *candidate, const nh_points *fit, bool certain);
/* The same as nh_currents_add for a function of the currents found, of this degree in the velocities: it goes to
 * result->further, or takes the place of a current that is not polynomial in the velocities. */
bool nh_currents_add_further(nh_current_checker *bench, nh_candidate *candidate, const nh_points *fit, size_t degree);

/* Currents that are only certified leave the list: proved ones may take their place.  Returns how many, in the arena;
 * then those are put back that do not depend on currents found since. */
size_t nh_currents_set_aside(nh_current_checker *bench, nh_current **aside);
void nh_currents_take_back(nh_current_checker *bench, size_t n, const nh_current *aside);

/* Is a function independent of the currents found, at these points?  In doubles up to `doubt` of its gradient; from
 * there to the option `sure` in ball arithmetic.  exact: its numbers are. */
nh_independence nh_currents_beside(const nh_analysis *analysis, const nh_points *points, nh_ex current, bool exact,
                                   double doubt);

/* Is it a function of the currents found so far, or constant?  `exact`: its numbers do not come from a fit. */
bool nh_currents_known(const nh_current_checker *bench, nh_ex phi, bool exact);

/* Where the current holds, in words; NULL: everywhere.  A current that is not proved holds to so many digits. */
const char *nh_currents_region(nh_current_checker *bench, nh_ex phi, double digits, bool *to_the_end);
/* The same of this current; one that is not proved everywhere may be proved there. */
const char *nh_currents_hold(nh_current_checker *bench, nh_current *found);
/* A proved current that ends or jumps at a zero of u because it contains a root of u^2: with u instead of that root, is
 * it a current everywhere?  Then it is replaced by that one. */
bool nh_currents_continue(nh_current_checker *bench, nh_current *found);

/* The same as nh_currents_add for a series, which cancels to so many digits.  Nothing is added when it depends on
 * earlier currents.  meaning: in words, or NULL. */
bool nh_currents_add_series(nh_current_checker *bench, nh_ex phi, const nh_series *series, double digits,
                            const char *meaning);

/* Call after the last candidate of a list: is a combination of the nearly conserved ones a current?  Returns how many
 * were added. */
size_t nh_currents_join(nh_current_checker *bench, const nh_points *fit);

/* Where there are series: decides which currents are independent, closed forms first, and removes series that depend on
 * others. */
void nh_currents_recount(nh_current_checker *bench);

/* Sorts, names and relates the currents; removes series that depend on closed forms. */
void nh_currents_finish(nh_current_checker *bench);

#endif

/* absence_parts: what the sentences, tables and JSON of other integrals (absence/absence.h) have in common. */
#ifndef NH_ABSENCE_PARTS_H
#define NH_ABSENCE_PARTS_H

#include "absence/absence.h"
#include "search/analysis.h"

/* The attempt that decides; NULL: none does. */
const nh_absence_attempt *nh_absence_parts_best(const nh_absence *absence);
/* What decides: the group SL(2) of the normal equation, or of one of its blocks; a triangular group; a residue, or an
 * irregular point, of an equation of first order; the monodromy in balls; a logarithm of a higher variational equation;
 * the homogeneous potential. */
typedef enum {
    NH_ABSENCE_BY_GROUP,
    NH_ABSENCE_BY_BLOCK,
    NH_ABSENCE_BY_TRIANGULAR,
    NH_ABSENCE_BY_RESIDUE,
    NH_ABSENCE_BY_IRREGULAR,
    NH_ABSENCE_BY_MONODROMY,
    NH_ABSENCE_BY_LOGARITHM,
    NH_ABSENCE_BY_DARBOUX,
    NH_ABSENCE_BY_NOTHING
} nh_absence_parts_reason;
nh_absence_parts_reason nh_absence_parts_reason_of(const nh_absence *absence);
/* "Galois group SL(2)", "a logarithm": for a first screen. */
const char *nh_absence_parts_short(nh_absence_parts_reason reason);
/* Is anything excluded, and no error of the program told? */
bool nh_absence_parts_excludes(const nh_absence *absence);
/* "none else", "dependent", "at most", "not Liouville integrable", "open", "settled"; "contradiction" where one is
 * told. */
const char *nh_absence_parts_verdict(const nh_absence *absence);
/* The names of the integrals that count, "Phi1", n of them, in the arena; returns n. */
size_t nh_absence_parts_known(const nh_analysis *result, const char ***name);
/* "SL(2)", "moves in 4 of 4 dimensions", "a residue is not rational", "connected, and not abelian at order 3", "open":
 * what an attempt found. */
const char *nh_absence_parts_group(nh_arena *arena, const nh_absence_attempt *attempt);
bool nh_absence_parts_angles(const nh_closed_shape *shape);
/* Are periodic integrals alone excluded?  So where the group is no SL(2), and the equations have angles. */
bool nh_absence_parts_periodic(const nh_absence *absence);
/* The roots that the equations of a shape contain, "sqrt(x^2 + y^2)"; in the arena. */
size_t nh_absence_parts_roots(nh_arena *arena, const nh_closed_shape *shape, const char ***root);

#endif

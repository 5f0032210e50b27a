/* agreement: the sampled problem against the counted space.
 *
 * The null vectors of an ansatz that is polynomial in the velocities belong to the space of all integrals of its
 * degree.  Where the count is complete this is spanned by products of the currents that are proved: every null vector
 * must be a combination of these, at points of their own. */
#ifndef NH_AGREEMENT_H
#define NH_AGREEMENT_H

#include "integrals/ansatz.h"
#include "integrals/nullspace.h"
#include "search/analysis.h"

/* Keep what the sampled problem found, until the count is there. */
void nh_agreement_keep(nh_analysis *result, size_t families, const nh_family *family, const nh_ansatz *ansatz,
                       const nh_nullspace *nullspace);

/* result->counted_space; a disagreement is a warning as well.  Nothing where the count is not complete to the ansatz's
   degree. */
void nh_agreement_find(nh_analysis *result);

#endif

/* agreement: null vectors of the sampled problem compared with the counted space of integrals.
 *
 * The null vectors of an ansatz that is polynomial in the velocities belong to the space of all integrals of its
 * degree.  Where the count is complete this space is spanned by products of the proved currents: every null vector must
 * be a combination of these products, at points that neither was computed with. */
#ifndef NH_AGREEMENT_H
#define NH_AGREEMENT_H

#include "integrals/ansatz.h"
#include "integrals/nullspace.h"
#include "search/analysis.h"

/* Keeps the null vectors of the sampled problem until the count is known. */
void nh_agreement_keep(nh_analysis *result, size_t families, const nh_family *family, const nh_ansatz *ansatz,
                       const nh_nullspace *nullspace);

/* Sets result->counted_space; a disagreement is a warning as well.  Does nothing where the count is not complete to the
 * ansatz's degree. */
void nh_agreement_find(nh_analysis *result);

#endif

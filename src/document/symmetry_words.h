/* symmetry_words: the symmetry of a conserved quantity in the words of mechanics. */
#ifndef NH_SYMMETRY_WORDS_H
#define NH_SYMMETRY_WORDS_H

#include "base/text.h"
#include "integrals/symmetry.h"

/* "the symmetry in time", "shifting x", "turning phi", "rotations in the plane of x and y", "a symmetry that involves
 * the velocities": to be read after "from".  True: rotations of positions. */
bool nh_symmetry_words(const nh_model *model, const nh_symmetry *symmetry, nh_text *out);

#endif

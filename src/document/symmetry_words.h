/* symmetry_words: the symmetry of a conserved quantity in the words of mechanics. */
#ifndef NH_SYMMETRY_WORDS_H
#define NH_SYMMETRY_WORDS_H

#include "base/text.h"
#include "integrals/symmetry.h"

/* To be read after "from": how = "the symmetry in time", "shifting", "turning", "rotations about", "rotations in the
 * plane of", "boosts along", "a scaling of", "a symmetry that involves the velocities"; what: the coordinates, or
 * nothing.
 * True: rotations of positions. */
bool nh_symmetry_words(const nh_model *model, const nh_symmetry *symmetry, const char **how, nh_text *what);

#endif

/* current_words: a conserved quantity in the words of mechanics: its sign, its letter, its name. */
#ifndef NH_CURRENT_WORDS_H
#define NH_CURRENT_WORDS_H

#include "base/text.h"
#include "search/analysis.h"

bool nh_current_is_energy(const nh_current *current); /* or minus the energy */
/* `e`, a form of this current, with the sign that readers know: E and p, not -E and -p. */
nh_ex nh_current_signed(const nh_analysis *result, const nh_current *current, nh_ex e);
/* "E = ", "p_x = ", or "": for what stands before the formula; in the arena of the result. */
const char *nh_current_label(const nh_analysis *result, const nh_current *current);

#endif

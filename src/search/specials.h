/* specials: the values of the ansatz' unknowns at which currents appear, named where they are simple. */
#ifndef NH_SPECIALS_H
#define NH_SPECIALS_H

#include "search/analysis.h"

/* Find them, and replace every family with an unknown by one copy for each value (none when there is none). */
bool nh_specials_find(nh_analysis *result, size_t *families, nh_family **family, nh_error *error);

/* Names for numbers in a current that was found: values of unknowns among them are called so. */
void nh_specials_name(nh_analysis *result, const nh_letters *letters);

#endif

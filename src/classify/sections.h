/* sections: special curves from their points on lines, and special surfaces from their curves in planes, modulo a
 * prime.
 *
 * In a section one parameter has a value; what is special there are polynomials in the others, of the same degrees in
 * almost all sections.  Their coefficients are rational functions of the value (special_surfaces.h). */
#ifndef NH_SECTIONS_H
#define NH_SECTIONS_H

#include "classify/special_surfaces.h"

/* What is special where the last parameter has this whole number as its value; curves of no degree in mu are points on
 * a line.  False: a limit was reached, or the run ended. */
typedef bool (*nh_sections_look)(void *context, int64_t value, nh_common_curves *out);

/* The parts of nh_common_curves, with the parameter of the sections as their last. */
typedef struct {
    nh_residue_surface special, degenerate, across;
} nh_sections;

/* The same polynomials, borrowed. */
nh_sections nh_sections_of(const nh_common_curves *curves);

/* Takes `count` sections, and more until they suffice, which is counted.  False: as above, or, with `too_few` set, they
 * never do.  nh_sections_clear. */
bool nh_sections_find(nh_prime field, nh_sections_look section, void *context, size_t *count, bool *too_few,
                      nh_sections *out);
void nh_sections_clear(nh_sections *sections);

#endif

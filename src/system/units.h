/* units: is this a unit of measurement?
 *
 *     unit    := "" | product { "/" product }          kg m^2, kg*m^2, N/m, 1/s, kg/(m s)
 *     product := factor { (" " | "*" | "·") factor }
 *     factor  := ("1" | name | "(" unit ")") [ "^" exponent | superscripts ]
 *
 * Names are those of the SI and of what is accepted beside it (min, h, deg, bar, eV, ...), with the SI's prefixes
 * where these are used.  Units are for the reader: nothing is converted, and dimensions are not compared. */
#ifndef NH_UNITS_H
#define NH_UNITS_H

#include <stdbool.h>
#include <stddef.h>

/* When it is none: where the part that is not understood begins, how long it is, and the nearest unit that is known,
 * or NULL. */
typedef struct {
    size_t offset, length;
    const char *nearest;
} nh_unit_fault;
bool nh_is_unit(const char *text, nh_unit_fault *fault);

#endif

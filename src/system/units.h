/* units: is this a unit of measurement?
 *
 *     unit    := "" | product { "/" product }          kg m^2, kg*m^2, N/m, 1/s, kg/(m s)
 *     product := factor { (" " | "*" | "·") factor }
 *     factor  := ("1" | name | "(" unit ")") [ "^" exponent | superscripts ]
 *
 * Names are those of the SI and of what is accepted beside it (min, h, deg, bar, eV, ...), with the SI's prefixes
 * where these are used.  Nothing is converted; whether the terms of a system have one unit, dimension.h looks. */
#ifndef NH_UNITS_H
#define NH_UNITS_H

#include <stdbool.h>
#include <stddef.h>

#include "base/error.h"

#include "base/text.h"

/* When it is none: where the part that is not understood begins, how long it is, and the nearest unit that is known,
 * or NULL. */
typedef struct {
    size_t offset, length;
    const char *nearest;
} nh_unit_fault;
bool nh_is_unit(const char *text, nh_unit_fault *fault);
/* Adds to a fault about `9.81 m/s^2` where the unit stands.  Returns false. */
bool nh_unit_hint(const char *text, nh_error *error);

/* The value of a unit: powers of the base units of the SI, with radians as 1, and the factor of their product. */
enum {
    NH_UNIT_METRE,
    NH_UNIT_KILOGRAM,
    NH_UNIT_SECOND,
    NH_UNIT_AMPERE,
    NH_UNIT_KELVIN,
    NH_UNIT_MOLE,
    NH_UNIT_CANDELA,
    NH_UNIT_BASES
};
typedef struct {
    double power[NH_UNIT_BASES];
    double scale; /* nan: not known */
    bool clock;   /* it measures time in something else than seconds */
} nh_unit;

/* The value of a text that nh_is_unit accepts; "" is 1. */
nh_unit nh_unit_of(const char *text);
nh_unit nh_unit_product(nh_unit a, nh_unit b, double power); /* a b^power */
/* Are the powers equal, and no two known factors different? */
bool nh_unit_equal(nh_unit a, nh_unit b);
/* "kg m^2/s^2", "0.001 m", "1". */
void nh_unit_print(nh_unit unit, nh_text *out);

#endif

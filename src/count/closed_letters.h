/* closed_letters: which functions a system's equations are made of (closed_words.h). */
#ifndef NH_CLOSED_LETTERS_H
#define NH_CLOSED_LETTERS_H

#include "count/construct_rates.h"
#include "count/jet_equations.h"

typedef enum { NH_LETTER_POWER, NH_LETTER_CIRCLE, NH_LETTER_EXPONENTIAL } nh_letter_kind;

typedef struct {
    nh_letter_kind kind;
    nh_ex base;   /* what is taken to a power; or the argument of sin, cos, exp */
    int64_t root; /* exponents are multiples of 1/root */
    /* lowest and highest exponent in the system: an exponent is priced relative to these, or higher; 0: it does not
     * occur */
    double up, down;
    double down_sine; /* of the sine; of cosines `down` holds the lowest exponent */
    nh_ex unit;       /* a root in the base that the equations do not contain, which sines take; 0: none */
    int64_t known;    /* powers up to this one have the rates of integrals in t, and no price; 0: not known */
    bool linear;      /* its whole powers are polynomials in the coordinates, which are letters themselves */
} nh_letter;

typedef struct {
    size_t count, capacity;
    nh_letter *item;
} nh_letters;

/* Finds the letters; the caller frees letters->item.  `secular`: also coordinates that occur only inside of functions,
 * whose polynomials are many-valued on an angle.  `rates`: exponentials and waves in cyclic coordinates, or NULL. */
nh_letters nh_letters_of(nh_jet_equations *equations, bool secular, const nh_construct_rates *rates);

#endif

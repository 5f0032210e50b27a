/* closed_letters: which functions a system's equations are made of (closed_words.h). */
#ifndef NH_CLOSED_LETTERS_H
#define NH_CLOSED_LETTERS_H

#include "count/construct_rates.h"
#include "count/jet_equations.h"

typedef enum { NH_LETTER_POWER, NH_LETTER_CIRCLE, NH_LETTER_EXPONENTIAL } nh_letter_kind;

typedef struct {
    nh_letter_kind kind;
    nh_ex base;           /* what is taken to a power; the argument of sin, cos, exp */
    int64_t root;         /* exponents are multiples of 1/root */
    /* how far the system goes up and down: an exponent costs its part of that, or more; 0: not at all */
    double up, down;
    double down_sine;     /* of the sine: `down` is of the cosine */
    bool linear;          /* the whole powers are polynomials in the coordinates, which are letters as well */
} nh_letter;

typedef struct {
    size_t count, capacity;
    nh_letter *item;
} nh_letters;

/* With `secular` ones also coordinates that are seen only inside of functions: what has them is many-valued on an
   angle.  `rates`: exponentials and waves in cyclic coordinates, or NULL.  The caller frees letters->item. */
nh_letters nh_letters_of(nh_jet_equations *equations, bool secular, const nh_construct_rates *rates);

#endif

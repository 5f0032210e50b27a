/* closed_words: functions of the coordinates in closed form that the coefficients of a system's integrals may be made
 * of.
 *
 * The letters are taken from the equations of motion, the Lagrangian and the determinant of the inertia:
 *
 *     q                    whole powers; negative and fractional ones where the system has them
 *     bases of powers      sums under roots and in denominators, with the least root that occurs
 *     factors of det M     with half powers of both signs, which normalise the reduced momenta; whole ones where a
 *                          root of the system is the same but for powers of coordinates
 *     cos u, sin u         of the least angle of which the system has multiples; negative powers where it has them
 *     exp u                whole powers, of both signs where it has them
 *     cos, sin, exp of a cyclic coordinate times a rate, where solutions have this rate (construct_rates.h); those in
 *                          t cost nothing: integrals have no others
 *     log u, asin u, ..    whole powers
 *
 * A word is a product of powers, one of each letter at most; its price is the sum of the prices of the powers: the
 * degree, where the most negative exponent that the system has costs as much as a coordinate.  Words come cheapest
 * first.  Where these are too many, words have few factors that are no polynomials: in sums over pairs of bodies few of
 * the many denominators stand in one term. */
#ifndef NH_CLOSED_WORDS_H
#define NH_CLOSED_WORDS_H

#include "count/construct_rates.h"
#include "count/jet_equations.h"
#include "count/scaling.h"
#include "geometry/model.h"

typedef struct {
    nh_ex shown, value; /* with parameters as symbols; as it is evaluated */
    double price;
    uint32_t coordinates; /* a set of bits: the coordinates on which it depends */
    bool plain;           /* a polynomial in coordinates, sines and cosines */
    nh_residue weight;    /* S(value) / value, where words are listed by their weights */
} nh_closed_power;

typedef struct {
    size_t powers, capacity;
    nh_closed_power *power; /* cheapest first; the first is 1 */
} nh_closed_letter;

typedef struct {
    nh_jet_equations *equations;
    double most; /* the largest price */
    size_t letters, capacity;
    nh_closed_letter *letter;
    bool independent; /* whatever words are listed, they are linearly independent */
    size_t words;
    uint16_t *choice; /* words x letters: the index of the power of each letter */
    double *price;    /* price per word */
} nh_closed_words;

/* The letters with their powers up to a price, and no words yet; `secular`, `rates`: closed_letters.h.  All letters are
 * registered for evaluation, so a point must be chosen afterwards.  Never NULL. */
nh_closed_words *nh_closed_words_create(nh_jet_equations *equations, double price, bool secular,
                                        const nh_construct_rates *rates);

/* Leaves out the powers that the scaling does not multiply by constants, and gives weights to the others.  Were there
 * none to leave out?  The equations stand at another point afterwards. */
bool nh_closed_words_weigh(nh_closed_words *words, const nh_residue *scaling, nh_prime field);

/* The sums of weights that words may have. */
typedef struct {
    nh_prime field;
    size_t count;
    const nh_residue *weight;
} nh_closed_weights;

/* Lists the words up to the price, of these weights (NULL: all).  False: there are more than `most_words`, even with
 * one factor in each that is not plain; or none. */
bool nh_closed_words_list(nh_closed_words *words, size_t most_words, const nh_closed_weights *wanted);
void nh_closed_words_free(nh_closed_words *words);

/* Leaves out words that are linear combinations of cheaper ones (partial fractions, sines and cosines in denominators),
 * by their values at random points; *work grows by the products of residues.  False: it would take more than `most`.
 * The equations stand at another point afterwards.  Related roots may have other signs at other points, so their words
 * stay. */
bool nh_closed_words_reduce(nh_closed_words *words, double most, double *work);

/* The coordinates that a word depends on, its weight, and the word with parameters as symbols. */
uint32_t nh_closed_words_coordinates(const nh_closed_words *words, size_t word);
nh_residue nh_closed_words_weight(const nh_closed_words *words, nh_prime field, size_t word);
nh_ex nh_closed_words_expression(const nh_closed_words *words, size_t word);

/* The series of all words, one after another.  False: another point is needed.  `work` counts products of residues. */
bool nh_closed_words_evaluate(const nh_closed_words *words, const nh_jet_ring *ring, const nh_residue *coordinate,
                              nh_residue *out, double *work);

/* Which functions a system's equations are made of (closed_words.h). */

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
} nh_closed_letters;

/* Finds the letters; the caller frees letters->item.  `secular`: also coordinates that occur only inside of functions,
 * whose polynomials are many-valued on an angle.  `rates`: exponentials and waves in cyclic coordinates, or NULL. */
nh_closed_letters nh_closed_letters_of(nh_jet_equations *equations, bool secular, const nh_construct_rates *rates);

/* Antiderivatives of the roots and denominators that a system's equations have (closed_letters.h).
 *
 * A rolling body has x' = r w, and w may be a constant over sqrt(a + c cos(h)^2): so integrals over a coordinate occur
 * in the constants of a motion. */

/* Writes functions with these derivatives: 1/z and 1/sqrt(a + b z + c z^2) by z, where z is a coordinate, a sine or a
 * cosine and the powers occur; z^k/sqrt(a + b z^n) by z, n up to 8; 1/sqrt(a - b sin(u)^2) and this root by u; sine and
 * cosine themselves.  `time`: time counts as a coordinate.  Returns how many, at most `most`. */
size_t nh_closed_primitives(const nh_model *model, bool time, size_t most, nh_ex *out);

#endif

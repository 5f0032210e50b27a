/* For the files of the classification. */
#ifndef NH_CLASSIFY_INTERNAL_H
#define NH_CLASSIFY_INTERNAL_H

#include "classify/classify.h"

typedef struct {
    const nh_model *model;
    nh_classify_question q; /* a copy: sections and lines hold its last parameters */
    nh_count_question count;
    nh_parametric family;
    nh_classification *out;
    double products; /* products of residues that the search for the zeros of this degree may still take */
} nh_classify_search;

/* Opens the family, which the caller closes; an obstacle is in the family. */
void nh_classify_open(nh_classify_search *search, const nh_model *model, const nh_classify_question *question);

/* Holds parameter v at top/bottom; bottom 0: lets it vary. */
void nh_classify_hold(nh_classify_search *search, int v, int64_t top, int64_t bottom);
/* The number of parameters that vary. */
int nh_classify_free(const nh_classify_search *search);

/* Where integrals are counted: at random values of the parameters that vary, at a zero of `on` (not NULL), or in the
 * limit of infinite lambda. */
typedef struct {
    const nh_special_factor *on;
    bool infinite;
} nh_classify_place;

/* The index-th prime modulo which the numbers below the equations' roots have roots. */
nh_prime nh_classify_prime(const nh_classify_search *search, size_t index);

/* Series at another regular point modulo this prime.  NULL: they are too long, or no regular point was found. */
nh_parametric_series *nh_classify_series(nh_classify_search *search, nh_prime field, uint64_t seed, size_t order);

/* Where the equations of this degree lose rank modulo one prime, by series of the row's order, in the parameters that
 * vary; sizes go into the row.  False: a limit was reached or the run ended. */
bool nh_classify_zeros(nh_classify_search *search, size_t degree, size_t prime, nh_classify_row *row,
                       nh_common_zeros *out);

/* N at one place: orders grow until it is the least possible, or no longer changes.  `known`: the number for almost all
 * values, which says which products are independent; or NULL.  False: beyond the limits. */
bool nh_classify_count(nh_classify_search *search, size_t degree, const nh_classify_place *place, size_t least,
                       size_t *known, nh_classify_number *out);

/* Have the equations no meaning at this place, although they may have a limit, which is what is counted? */
bool nh_classify_singular(nh_classify_search *search, const nh_classify_place *place);

/* classify_sweep.c: holds the last parameter at a/b up to a height, one value after the other, and looks for anything
 * special there besides known zeros and walls; values with something else become walls.  Writes `swept` and `height` of
 * the row.  False: a limit was reached, the run ended, or, for two parameters, there are more curves than are known,
 * with `end` set to nh_classify_curves. */
bool nh_classify_sweep(nh_classify_search *search, size_t degree, size_t height, nh_classify_row *row);
extern const char nh_classify_curves[];
/* Adds a wall that is not in the list yet. */
void nh_classify_add_wall(nh_classification *out, const nh_special_factor *polynomial);

#endif

/* For the files of the classification. */
#ifndef NH_CLASSIFY_INTERNAL_H
#define NH_CLASSIFY_INTERNAL_H

#include "classify/classify.h"
#include "classify/special_curves.h"
#include "classify/special_surfaces.h"

typedef struct {
    const nh_classify_question *q;
    nh_count_question count;
    nh_parametric family;
    nh_classification *out;
    double products; /* products of residues that the search for the values of this degree may still take */
} nh_classify_search;

/* Opens the family, which the caller closes; an obstacle is in the family. */
void nh_classify_open(nh_classify_search *search, const nh_model *model, const nh_classify_question *question);

/* The value of the parameter at which the equations are taken.  With two parameters mu has the value of the question or
 * a random one, and so has nu with three. */
typedef enum {
    NH_CLASSIFY_ANY,
    NH_CLASSIFY_ROOT,
    NH_CLASSIFY_INFINITE,
    NH_CLASSIFY_CURVE,
    NH_CLASSIFY_SURFACE
} nh_classify_kind;
typedef struct {
    nh_classify_kind kind;
    const nh_special_factor *root;
    const nh_special_surface *surface; /* or a curve */
} nh_classify_place;

/* The index-th prime modulo which the numbers below the equations' roots have roots. */
nh_prime nh_classify_prime(const nh_classify_search *search, size_t index);

/* Series at another regular point modulo this prime.  NULL: they are too long, or no regular point was found. */
nh_parametric_series *nh_classify_series(nh_classify_search *search, nh_prime field, uint64_t seed, size_t order);

/* Where the equations of this degree lose rank, modulo one prime, at two points, by series of the row's order. */
bool nh_classify_roots(nh_classify_search *search, size_t degree, size_t prime, nh_classify_row *row,
                       nh_special_roots *out);

/* N at one value: orders grow until it is the least possible, or no longer changes.  `known`: the number for almost all
 * values, which says which products are independent; or NULL.  False: beyond the limits. */
bool nh_classify_count(nh_classify_search *search, size_t degree, const nh_classify_place *place, size_t least,
                       size_t *known, nh_classify_number *out);

/* Have the equations no meaning at this value, although they may have a limit, which is what is counted? */
bool nh_classify_singular(nh_classify_search *search, const nh_classify_place *place);

#endif

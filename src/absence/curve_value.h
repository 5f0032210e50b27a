/* curve_value: values of expressions on the curve of a particular motion, in its field (curve_field.h).
 *
 * Every factor has its value for itself: 0 times 1/0 is no number, although the expression x (1/x) would be. */
#ifndef NH_CURVE_VALUE_H
#define NH_CURVE_VALUE_H

#include "absence/curve_field.h"
#include "graph/expr.h"

typedef struct {
    nh_dag *dag;
    const nh_curve_field *field;
    nh_ex coordinate, velocity; /* symbols of x and w */
    bool angle;                 /* the field's variable is tan(x/2) */
    bool rest;                  /* w = 0 */
    nh_curve_side side;         /* where roots are positive */
    size_t zeros;
    const nh_ex *zero; /* symbols that vanish on the curve */
} nh_curve_place;

/* NH_CURVE_UNKNOWN: finite, but no element of the field.  NH_CURVE_SINGULAR: a pole or a branch point for all x, or it
 * is not known that it is none. */
typedef enum { NH_CURVE_FINE, NH_CURVE_UNKNOWN, NH_CURVE_SINGULAR } nh_curve_state;

/* Values of n expressions of the coordinate, the velocity, the zeros and numbers; value: n elements that are
 * initialised, of which those in a fine state are set.  why[i]: of the others, in words; may be NULL. */
void nh_curve_value(const nh_curve_place *place, size_t n, const nh_ex *e, nh_curve_element *value,
                    nh_curve_state *state, const char **why);

#endif

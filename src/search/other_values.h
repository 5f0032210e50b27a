/* other_values: null spaces of a stage at other values of the parameters than the given ones.
 *
 * At special values (1, 4, 7) the echelon form of a null space has a smaller support than at generic ones: a
 * coefficient such as a - 2 b + c vanishes there, and no relation over the field of the parameters has this support.
 * The vectors at values nearby have the generic support, from which the exact relation gives currents for all values:
 * those of the echelon form there, which are the same whatever the given values are; and those with the pivots that the
 * vectors at the given values have, which become these vectors. */
#ifndef NH_OTHER_VALUES_H
#define NH_OTHER_VALUES_H

#include "integrals/ansatz.h"
#include "search/currents.h"

typedef struct {
    bool tried;
    nh_model model; /* the analysis' model at the other values; owns only what depends on the values */
    nh_points *points;
    /* simplest first; with the given pivots.  NULL: the stage has no null space there, or may not be solved again */
    nh_candidates *simplest, *with_pivots;
} nh_other_values;

/* The model at other values, without points; false where its tapes have the given values in them. */
bool nh_other_values_begin(const nh_model *model, nh_other_values *other);
/* The null space of the ansatz for that model, at other->points. */
void nh_other_values_take(nh_other_values *other, const nh_ansatz *ansatz, const nh_nullspace *nullspace, size_t pivots,
                          const nh_ex *pivot, const nh_options *options);
void nh_other_values_clear(nh_other_values *other);

/* Replaces the last current, which holds at the given parameters only and has this pivot, by currents that hold for all
 * values.  Is the last one gone? */
bool nh_other_values_exchange(nh_current_checker *bench, nh_other_values *other, nh_ex pivot);

#endif

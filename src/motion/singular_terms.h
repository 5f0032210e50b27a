/* singular_terms: K and F of singular.h along the motions of a model. */
#ifndef NH_SINGULAR_TERMS_H
#define NH_SINGULAR_TERMS_H

#include "motion/along.h"
#include "motion/singular.h"

typedef struct nh_singular_of_model nh_singular_of_model;

/* NULL: K and F are constant, or they depend on states that are not known (known[i]: chart->symbol[1 + i]; NULL: all
 * are).  `in_chart`: the equations are those of the chart's velocities.  `make` compiles expressions of the chart for
 * the states of the motion. */
nh_singular_of_model *nh_singular_of_model_create(const nh_model *model, bool in_chart, const bool *known,
                                                  nh_along_values *make(size_t n, const nh_ex *e, void *context),
                                                  void *context);
void nh_singular_of_model_free(nh_singular_of_model *terms);
/* NULL is allowed, and gives NULL. */
nh_singular_watch *nh_singular_of_model_watch(const nh_singular_of_model *terms);

#endif

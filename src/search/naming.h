/* naming: numbers as expressions of the parameters, by computing them again at other parameter values. */
#ifndef NH_NAMING_H
#define NH_NAMING_H

#include "geometry/model.h"

/* The number at another parameter set (a model whose tapes are bound to it), nearest to `near`; false when it cannot be
 * computed. */
typedef bool nh_follow(const nh_model *changed, double near, double *value, void *context);

enum { NH_NAMING_ATOMS = 12 };

/* The positive parameters, and sums of parameters (J + m a^2) in the equations of motion. */
size_t nh_naming_atoms(const nh_model *model, nh_ex atom[NH_NAMING_ATOMS]);

/* A product of powers of the parameters, and of sums of them that occur in the equations of motion, that equals `value`
 * at the model's parameters and follows it at others; else a simple rational or root; else 0. */
nh_ex nh_name_value(const nh_model *model, double value, nh_follow *follow, void *context, double tolerance,
                    uint64_t seed);

#endif

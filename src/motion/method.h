/* method: the integrators under one name each. */
#ifndef NH_METHOD_H
#define NH_METHOD_H

#include "motion/explicit.h"
#include "motion/midpoint.h"
#include "motion/pairs.h"

typedef enum { NH_METHOD_CVODE, NH_METHOD_EXPLICIT, NH_METHOD_PAIRS, NH_METHOD_MIDPOINT } nh_method_family;

typedef struct {
    const char *name, *about;
    nh_method_family family;
    int kind;           /* of the family's own list */
    bool composed;      /* of NH_METHOD_MIDPOINT */
    bool fixed;         /* takes a step instead of a tolerance */
} nh_method;

size_t nh_method_count(void);
const nh_method *nh_method_at(size_t index);
/* The method of that name, or NULL. */
const nh_method *nh_method_find(const char *name);

/* A motion of z' = f(t, z) by a method with error control (not of NH_METHOD_MIDPOINT). */
nh_motion *nh_method_flow(const nh_method *method, const nh_flow_problem *problem, const double *initial, size_t count, const double *times,
                          const nh_flow_options *options, nh_error *error);

#endif

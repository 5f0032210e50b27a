/* method: the integrators under one name each. */
#ifndef NH_METHOD_H
#define NH_METHOD_H

#include "motion/integrators.h"

typedef enum {
    NH_METHOD_CVODE,
    NH_METHOD_GSL_ODEIV,
    NH_METHOD_ARKODE,
    NH_METHOD_MIDPOINT,
    NH_METHOD_RELAXATION
} nh_method_family;

typedef struct {
    const char *word, *name, *about; /* word: on the command line */
    nh_method_family family;
    int kind;      /* index in the list of its family */
    bool composed; /* of NH_METHOD_MIDPOINT */
    int order;     /* order of methods that take a step instead of a tolerance; otherwise 0 */
} nh_method;

/* All methods in the order in which they are listed; the index must be below the count. */
size_t nh_method_count(void);
const nh_method *nh_method_at(size_t index);
/* The method of that name or word, or NULL. */
const nh_method *nh_method_find(const char *name);
/* Reads a word that a user gives: "auto" gives NULL, for the method that suits (automatic.h).  False, with a
 * suggestion, where there is no such method. */
#define NH_METHOD_AUTOMATIC "auto"
bool nh_method_given(const char *word, const nh_method **out, nh_error *error);

/* A motion of z' = f(t, z) by a method with error control (order 0). */
nh_motion *nh_method_flow(const nh_method *method, const nh_flow_problem *problem, const double *initial, size_t count,
                          const double *times, const nh_flow_options *options, nh_error *error);

/* A motion of a model by a method with a fixed step, and why it may not be used with the model (NULL: it may). */
nh_motion *nh_method_steps(const nh_method *method, nh_programs *programs, const double *initial, size_t count,
                           const double *times, const nh_flow_options *options, nh_error *error);
const char *nh_method_refused(const nh_method *method, nh_programs *programs);

#endif

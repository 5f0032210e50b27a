/* generators: infinitesimal symmetries in closed form.
 *
 * xi = sum_k c_k b_k(q) d/dq^i(k) over a library that grows (library.h) until as many fields are found as the jets say
 * there are; of a chain of bodies with the fields of its joints (joint_fields.h).  The rows are
 * the conditions of invariance.h at sample points; c is a null vector of A relative to B, the values of the fields (a
 * quotient, as in [GolubVanLoan2013, sec. 8.7.4]).  The null space is brought to reduced echelon form, its numbers to
 * rationals or, with the parameters, to an exact relation, and every field is then checked by itself. */
#ifndef NH_GENERATORS_H
#define NH_GENERATORS_H

#include "reduction/invariance.h"
#include "reduction/jets.h"

typedef struct {
    size_t count;
    nh_generator *generator;
    int level;      /* level of the library that was enough, or of the last one */
    size_t columns; /* number of columns of that library */
    double last_null, first_other;
} nh_generators;

/* `jets` may be NULL (no metric): then every level is tried while the number grows.  Memory belongs to the kinetic's
 * arena.  False only on numerical breakdown; finding no generator is no failure. */
bool nh_generators_find(nh_generators *out, const nh_kinetic *kinetic, const nh_jets *jets, const nh_options *options,
                        nh_error *error);

#endif

/* tape_complex: a tape at a complex point, for derivatives by a complex step: Im f(x + i h)/h has no cancellation, so
 * that h may be 1e-100 [MartinsSturdzaAlonso2003].
 *
 * Functions are continued from the real axis: a function that is undefined at the real part is not-a-number here, too;
 * abs z is z or -z, sign is constant, and a real exponent and atan2 are taken to first order in the imaginary part. */
#ifndef NH_TAPE_COMPLEX_H
#define NH_TAPE_COMPLEX_H

#include "evaluate/named_value.h" /* complex numbers */
#undef I                          /* the macro is removed: elsewhere the inertia is called I */

#include "evaluate/tape.h"

/* Work memory for nh_tape_eval_complex, with the tape's constants in place (nh_free). */
double complex *nh_tape_complex_create(const nh_tape *tape);
/* One point: in[n_in], out[n_out]. */
void nh_tape_eval_complex(const nh_tape *tape, double complex *work, const double complex *in, double complex *out);

#endif

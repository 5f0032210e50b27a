/* machine: a tape as machine code.
 *
 * The instructions of a tape become C, one assignment each and in the same order, and the system's compiler makes a
 * function of them (evaluate/compile.h), without any option that would change a value: what it returns equals what
 * nh_tape_eval returns, bit by bit, as far as the library's sincos equals its sin and its cos, as in glibc.  So the
 * change from one to the other in the middle of a motion cannot be seen in the result.
 *
 * Equal tapes share their code; what was compiled stays until the end of the process. */
#ifndef NH_MACHINE_H
#define NH_MACHINE_H

#include "base/text.h"
#include "evaluate/tape.h"

typedef struct nh_machine nh_machine;
typedef void nh_machine_code(const double *in, double *out);

/* What was compiled already, or is being; or NULL. */
nh_machine *nh_machine_known(const nh_tape *tape);
/* Starts the compiler unless this code is there already.  NULL when there is too much of it. */
nh_machine *nh_machine_of(const nh_tape *tape);
/* The code, when it is there; NULL otherwise, and *busy says whether it may still come. */
nh_machine_code *nh_machine_get(nh_machine *machine, bool wait, bool *busy);
/* Ends compilers that run and removes their folders; at the end of the process it happens by itself, unless that ends
   by _exit. */
void nh_machine_cleanup(void);
/* "compiled by cc in 0.07 s", or why not; stays valid. */
const char *nh_machine_words(const nh_machine *machine);

#endif

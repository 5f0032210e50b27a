/* machine: a tape as machine code.
 *
 * The instructions of a tape become C, one assignment each and in the same order, and the system's compiler makes a
 * function of them (evaluate/compile.h), without any option that would change a value: what it returns equals what
 * nh_tape_eval returns, bit by bit, as far as the library's sincos equals its sin and its cos, as in glibc.  So a
 * result does not show when a motion changed from one to the other.
 *
 * Equal tapes share their code; what was compiled stays until the end of the process. */
#ifndef NH_MACHINE_H
#define NH_MACHINE_H

#include "base/text.h"
#include "evaluate/tape.h"

typedef struct nh_machine nh_machine;
typedef void nh_machine_code(const double *in, double *out);

/* The code of this tape that was compiled already, or is being compiled; or NULL. */
nh_machine *nh_machine_known(const nh_tape *tape);
/* Starts the compiler unless this code is there already.  NULL when there is too much of it. */
nh_machine *nh_machine_of(const nh_tape *tape);
/* The code, when it is there; NULL otherwise, and *busy says whether it may still come. */
nh_machine_code *nh_machine_get(nh_machine *machine, bool wait, bool *busy);
/* Ends running compilers and removes their folders.  At the end of the process this happens by itself, unless the
 * process ends by _exit. */
void nh_machine_cleanup(void);
/* "compiled by cc in 0.07 s", or why not; the text stays valid. */
const char *nh_machine_words(const nh_machine *machine);

#endif

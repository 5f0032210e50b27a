/* foreign_memory: makes GMP and FLINT, which end the process when an allocation fails, allocate through
 * base/memory.h. */
#ifndef NH_FOREIGN_MEMORY_H
#define NH_FOREIGN_MEMORY_H

/* Takes effect at the first call in the process.  Functions that another program has already given to GMP remain. */
void nh_foreign_memory_begin(void);

/* Gives back what FLINT keeps for this thread; not after a run that was given up (nh_recovery_lost). */
void nh_foreign_memory_end(void);

#endif

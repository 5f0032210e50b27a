/* foreign_memory: GMP and FLINT, which end the process when an allocation fails, allocate as this program does. */
#ifndef NH_FOREIGN_MEMORY_H
#define NH_FOREIGN_MEMORY_H

/* Once for the process, the first time; functions that another program has given to GMP remain. */
void nh_foreign_memory_begin(void);

#endif

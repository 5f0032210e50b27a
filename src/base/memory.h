/* memory: allocation that either succeeds or does not return, and arenas.
 *
 * A library that checks every small allocation by hand has mostly untested branches.  Here an allocation that fails
 * gives up the run of this thread (base/recovery.h), so that the functions of nhsym.h can report it; outside of a run
 * it calls the handler of the program (that of the command line ends the process with exit code 5); without a handler
 * it aborts. */
#ifndef NH_MEMORY_H
#define NH_MEMORY_H

#include <stddef.h>

#define NH_MEGABYTE 1048576.0 /* bytes */

typedef void nh_memory_handler(size_t wanted);

/* Called when memory runs out outside of every run; must not return. */
void nh_memory_set_handler(nh_memory_handler *handler);
/* Called after a failed allocation of `wanted` bytes; does not return. */
_Noreturn void nh_memory_ended(size_t wanted);
/* Passes on what another library has allocated; NULL is treated as a failed allocation. */
void *nh_memory_got(void *pointer);
/* For tests: lets the allocation after `allocations` more allocations fail, once; SIZE_MAX: none.  Returns what was
 * left of the number before. */
size_t nh_memory_fail_after(size_t allocations);

void *nh_alloc(size_t size);                                  /* zeroed; size 0 gives a valid pointer */
void *nh_alloc_bytes(size_t size);                            /* not zeroed */
void *nh_alloc_array(size_t count, size_t size);              /* zeroed; overflow of count*size is a failure, too */
void *nh_realloc_array(void *old, size_t count, size_t size); /* new part not zeroed */
void nh_free(void *pointer);
char *nh_strdup(const char *text);

/* Bytes of this process that are in memory now; 0 where the system does not say. */
double nh_memory_in_use(void);
/* Bytes of memory that this process may have: of the machine, or of its control group; 0 where the system does not
 * say. */
double nh_memory_of_machine(void);
/* The part of the control groups, versions 1 and 2: `list` is /proc/self/cgroup, `root` /sys/fs/cgroup. */
double nh_memory_of_group(const char *list, const char *root);

/* Grow `*array` (element size `size`) so that it holds at least `need` elements, doubling `*capacity`. */
void nh_grow(void *array_pointer, size_t *capacity, size_t need, size_t size);

/* An arena: many small allocations, freed together. */
typedef struct nh_arena nh_arena;
nh_arena *nh_arena_create(void);
void nh_arena_free(nh_arena *arena);
void *nh_arena_alloc(nh_arena *arena, size_t size); /* zeroed, 16-byte aligned */
char *nh_arena_strdup(nh_arena *arena, const char *text);
char *nh_arena_strndup(nh_arena *arena, const char *text, size_t length);
char *nh_arena_printf(nh_arena *arena, const char *format, ...) __attribute__((format(printf, 2, 3)));

#endif

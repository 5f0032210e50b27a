/* memory: allocation that either succeeds or ends in the handler the program installed, and arenas.
 *
 * A library that checks every small allocation by hand has mostly untested branches; instead the one handler
 * decides (the command line reports exit code 5, "limit reached").  The default handler aborts. */
#ifndef NH_MEMORY_H
#define NH_MEMORY_H

#include <stddef.h>

#define NH_MEGABYTE 1048576.0 /* bytes */

typedef void nh_memory_handler(size_t wanted);

/* Called when memory runs out; must not return. */
void nh_memory_set_handler(nh_memory_handler *handler);

void *nh_alloc(size_t size);                 /* zeroed; size 0 gives a valid pointer */
void *nh_alloc_array(size_t count, size_t size); /* zeroed; overflow of count*size goes to the handler */
void *nh_realloc_array(void *old, size_t count, size_t size); /* new part not zeroed */
void nh_free(void *pointer);
char *nh_strdup(const char *text);

/* Bytes of this process that are in memory now; 0 where the system does not say. */
double nh_memory_in_use(void);
/* Bytes of memory that this machine has; 0 where the system does not say. */
double nh_memory_of_machine(void);

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

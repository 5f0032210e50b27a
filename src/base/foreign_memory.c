#include "base/foreign_memory.h"

#include <flint/flint.h>
#include <gmp.h>
#include <pthread.h>

#include "base/memory.h"

typedef void *gmp_allocate(size_t size);
typedef void *gmp_reallocate(void *old, size_t old_size, size_t size);
typedef void gmp_free(void *pointer, size_t size);

static void *reallocate(void *old, size_t size) { return nh_realloc_array(old, 1, size); }

static void *reallocate_for_gmp(void *old, size_t old_size, size_t size)
{
    (void)old_size;
    return reallocate(old, size);
}

static void free_for_gmp(void *pointer, size_t size)
{
    (void)size;
    nh_free(pointer);
}

static void set_functions(void)
{
    gmp_allocate *allocate, *usual_allocate;
    gmp_reallocate *again, *usual_again;
    gmp_free *release, *usual_release;
    mp_get_memory_functions(&allocate, &again, &release);
    mp_set_memory_functions(NULL, NULL, NULL);
    mp_get_memory_functions(&usual_allocate, &usual_again, &usual_release);
    if (allocate == usual_allocate && again == usual_again && release == usual_release)
        mp_set_memory_functions(nh_alloc_bytes, reallocate_for_gmp, free_for_gmp);
    else mp_set_memory_functions(allocate, again, release);
    __flint_set_memory_functions(nh_alloc_bytes, nh_alloc_array, reallocate, nh_free);
}

void nh_foreign_memory_begin(void)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, set_functions);
}

void nh_foreign_memory_end(void) { flint_cleanup(); }

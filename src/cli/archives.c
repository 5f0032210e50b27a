/* archives: settings for libraries that are linked into the program, made before these start. */
#include <errno.h>
#include <stdlib.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "base/memory.h"

/* OpenBLAS starts a thread per core when it is loaded, and each of them spins for 25 ms waiting for work.  This
 * setting makes it start none: blocks of work are shared out above it (base/parallel.h), with results that do not
 * depend on the number of threads.  Must run before the constructors of the libraries, which have no priority. */
__attribute__((constructor(101))) static void keep_blas_single(void) { setenv("OPENBLAS_NUM_THREADS", "1", 0); }

/* OpenBLAS has kernels for every kind of processor, which add in different orders: the last digits, and decisions that
 * depend on them, would differ between machines.  The Haswell kernels run on all processors with AVX2 and FMA, and are
 * nearly as fast as those for newer ones on matrices of our sizes. */
#if defined __x86_64__ && defined __GNUC__
__attribute__((constructor(101))) static void keep_blas_the_same(void)
{
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) setenv("OPENBLAS_CORETYPE", "Haswell", 0);
}
#endif

/* A search takes and gives back arrays of some megabytes thousands of times; memory that returns to the system each
 * time comes back as pages to be cleared, for half of the system's share of the time. */
#ifdef __GLIBC__
__attribute__((constructor)) static void keep_memory(void)
{
    mallopt(M_MMAP_THRESHOLD, 32 << 20);
    mallopt(M_TRIM_THRESHOLD, 512 << 20);
}
#endif

/* Libraries that are linked into the program do not all survive an allocation that fails (SUNDIALS and GSL follow null
 * pointers): the linker sends their allocations here (--wrap), and none of them fails. */
void *__real_malloc(size_t size), *__real_calloc(size_t count, size_t size), *__real_realloc(void *old, size_t size);
void *__real_aligned_alloc(size_t alignment, size_t size);
int __real_posix_memalign(void **out, size_t alignment, size_t size);
void *__wrap_malloc(size_t size), *__wrap_calloc(size_t count, size_t size), *__wrap_realloc(void *old, size_t size);
void *__wrap_aligned_alloc(size_t alignment, size_t size);
int __wrap_posix_memalign(void **out, size_t alignment, size_t size);

static void *got(void *memory, size_t size)
{
    if (!memory && size) nh_memory_ended(size);
    return memory;
}

void *__wrap_malloc(size_t size) { return got(__real_malloc(size), size); }
void *__wrap_calloc(size_t count, size_t size) { return got(__real_calloc(count, size), count ? size : 0); }
void *__wrap_realloc(void *old, size_t size) { return got(__real_realloc(old, size), size); }
void *__wrap_aligned_alloc(size_t alignment, size_t size) { return got(__real_aligned_alloc(alignment, size), size); }

int __wrap_posix_memalign(void **out, size_t alignment, size_t size)
{
    int reason = __real_posix_memalign(out, alignment, size);
    if (reason == ENOMEM) nh_memory_ended(size);
    return reason;
}

/* SUNDIALS 7 as Debian builds it refers to MPI; a single process needs nothing of it but the address that stands for
 * "no processes".  The definitions here take the place of MPI's library, which may measure the processor's clock when
 * it is loaded: that takes longer than a short command. */
#ifdef NH_WITHOUT_MPI
extern char ompi_mpi_comm_null[1];
int MPI_Comm_dup(void), MPI_Comm_free(void), MPI_Comm_rank(void);

char ompi_mpi_comm_null[1];
int MPI_Comm_dup(void) { abort(); }
int MPI_Comm_free(void) { abort(); }
int MPI_Comm_rank(void) { abort(); }
#endif

/* archives: settings for libraries that are linked into the program, made before these start. */
#include <stdlib.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

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

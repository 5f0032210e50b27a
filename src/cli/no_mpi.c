/* no_mpi: SUNDIALS 7 as Debian builds it refers to MPI, of which a single process needs nothing but the address that stands for "no processes".  Where its archive is
 * linked, these take the place of MPI's library: loading that takes 30 times as long as loading all others, because it measures the processor's clock. */
#ifdef NH_WITHOUT_MPI
#include <stdlib.h>

extern char ompi_mpi_comm_null[1];
int MPI_Comm_dup(void), MPI_Comm_free(void), MPI_Comm_rank(void);

char ompi_mpi_comm_null[1];
int MPI_Comm_dup(void) { abort(); }
int MPI_Comm_free(void) { abort(); }
int MPI_Comm_rank(void) { abort(); }
#endif

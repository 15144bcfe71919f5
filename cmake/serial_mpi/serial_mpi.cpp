// The functions of MPI that SUNDIALS 7 of Debian names and, without a communicator, never calls. A call is a fault of
// this program and ends it. Only their names matter to the linker.
#include <cstdlib>

#include "mpi.h"

extern "C" {
char ompi_mpi_comm_null[8], ompi_mpi_double[8], ompi_mpi_long[8];

#define MYOID_NEVER_CALLED(name) \
  int name(void) { std::abort(); }
MYOID_NEVER_CALLED(MPI_Abort)
MYOID_NEVER_CALLED(MPI_Comm_dup)
MYOID_NEVER_CALLED(MPI_Comm_free)
MYOID_NEVER_CALLED(MPI_Comm_rank)
MYOID_NEVER_CALLED(MPI_Comm_size)
MYOID_NEVER_CALLED(MPI_Op_create)
MYOID_NEVER_CALLED(MPI_Op_free)
MYOID_NEVER_CALLED(MPI_Reduce)
MYOID_NEVER_CALLED(MPI_Type_commit)
MYOID_NEVER_CALLED(MPI_Type_create_resized)
MYOID_NEVER_CALLED(MPI_Type_create_struct)
MYOID_NEVER_CALLED(MPI_Type_free)
MYOID_NEVER_CALLED(MPI_Type_get_extent)
}

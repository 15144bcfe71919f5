#pragma once
/* In place of Open MPI's header, for one process: SUNDIALS 7 of Debian names a communicator in each of its headers, and
 * Myoid gives it the one that stands for none. The names are those of Open MPI's binary interface. */
#ifdef __cplusplus
extern "C" {
#endif

typedef struct ompi_communicator_t* MPI_Comm;
extern char ompi_mpi_comm_null[];
#define MPI_COMM_NULL ((MPI_Comm)(void*)ompi_mpi_comm_null)

#ifdef __cplusplus
}
#endif

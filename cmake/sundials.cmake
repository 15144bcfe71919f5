# CVODES of SUNDIALS 5 to 7, and the serial vectors and dense matrices that it works with. By hand: the config of the
# distribution's package names an MPI that is not needed. Static where it is there, as in dependencies.cmake.
find_path(MYOID_SUNDIALS_INCLUDE cvodes/cvodes.h)
if(NOT MYOID_SUNDIALS_INCLUDE)
  message(FATAL_ERROR "No header cvodes/cvodes.h of SUNDIALS 5 to 7. Debian, Ubuntu: libsundials-dev, or unpack that "
                      "package alone as cmake/setup.sh does and name its folder usr by -DCMAKE_PREFIX_PATH=...; "
                      "Fedora: sundials-devel")
endif()
file(STRINGS ${MYOID_SUNDIALS_INCLUDE}/sundials/sundials_config.h version REGEX "^#define SUNDIALS_VERSION_MAJOR")
string(REGEX REPLACE "[^0-9]" "" MYOID_SUNDIALS_MAJOR "${version}")
if(MYOID_SUNDIALS_MAJOR LESS 5 OR MYOID_SUNDIALS_MAJOR GREATER 7)
  message(WARNING "SUNDIALS ${MYOID_SUNDIALS_MAJOR} in ${MYOID_SUNDIALS_INCLUDE}: Myoid is written for 5 to 7")
endif()

add_library(myoid_sundials INTERFACE)
target_include_directories(myoid_sundials SYSTEM INTERFACE $<BUILD_INTERFACE:${MYOID_SUNDIALS_INCLUDE}>)
set(parts cvodes nvecserial sunmatrixdense sunlinsoldense)
if(MYOID_SUNDIALS_MAJOR GREATER_EQUAL 7)
  list(APPEND parts core)
endif()
foreach(part IN LISTS parts)
  find_library(MYOID_SUNDIALS_${part} NAMES libsundials_${part}.a sundials_${part} REQUIRED)
  set(library ${MYOID_SUNDIALS_${part}})
  if(library MATCHES "\\.a$" AND NOT library MATCHES "^/usr/")
    # Not of the system: the installed package carries it, so that it needs no folder of this build.
    install(FILES ${library} DESTINATION ${CMAKE_INSTALL_LIBDIR}/myoid COMPONENT dev)
    get_filename_component(name ${library} NAME)
    target_link_libraries(myoid_sundials INTERFACE
      $<BUILD_INTERFACE:${library}> $<INSTALL_INTERFACE:$<INSTALL_PREFIX>/${CMAKE_INSTALL_LIBDIR}/myoid/${name}>)
  else()
    target_link_libraries(myoid_sundials INTERFACE ${library})
  endif()
endforeach()

# Debian's SUNDIALS 7 was built with Open MPI, whose functions it names and a serial program never calls. Another MPI
# has to be there.
file(STRINGS ${MYOID_SUNDIALS_INCLUDE}/sundials/sundials_config.h mpi REGEX "^#define SUNDIALS_MPI_ENABLED 1")
if(MYOID_SUNDIALS_core AND mpi)
  set(open_mpi "")
  if(MYOID_SUNDIALS_core MATCHES "\\.a$")
    file(STRINGS ${MYOID_SUNDIALS_core} open_mpi REGEX "ompi_mpi_comm_null" LIMIT_COUNT 1)
  endif()
  if(open_mpi)
    add_library(myoid_serial_mpi STATIC ${CMAKE_CURRENT_LIST_DIR}/serial_mpi/serial_mpi.cpp)
    set_target_properties(myoid_serial_mpi PROPERTIES EXPORT_NAME serial_mpi CXX_VISIBILITY_PRESET hidden)
    install(TARGETS myoid_serial_mpi EXPORT MyoidTargets DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT dev)
    target_include_directories(myoid_sundials SYSTEM INTERFACE
                               $<BUILD_INTERFACE:${CMAKE_CURRENT_LIST_DIR}/serial_mpi>)
    target_link_libraries(myoid_sundials INTERFACE myoid_serial_mpi)
  else()
    find_package(MPI REQUIRED COMPONENTS C)
    target_link_libraries(myoid_sundials INTERFACE MPI::MPI_C)
  endif()
endif()

# An activated conda environment stands in the search path of programs, and so of CMake: its compiler takes headers and
# a C library of its own, and its libraries want its own libstdc++. Either with the system's packages links to nothing
# or to a program that ends at its start. So the environment is left out, and a conda compiler is refused, unless
# everything comes from there: -DMYOID_CONDA=ON, which conda-build's environment (packaging/conda) sets.
if(DEFINED ENV{CONDA_BUILD})
  set(myoid_conda ON)
else()
  set(myoid_conda OFF)
endif()
option(MYOID_CONDA "Compiler and libraries are those of a conda environment" ${myoid_conda})
if(NOT MYOID_CONDA)
  set(myoid_prefixes $ENV{CONDA_PREFIX} $ENV{CONDA_PREFIX_1} $ENV{MAMBA_ROOT_PREFIX})
  set(found "")
  if(CMAKE_CXX_COMPILER MATCHES "-conda-")
    set(found ${CMAKE_CXX_COMPILER})
  endif()
  foreach(prefix IN LISTS myoid_prefixes)
    cmake_path(IS_PREFIX prefix "${CMAKE_CXX_COMPILER}" NORMALIZE inside)
    if(inside)
      set(found ${CMAKE_CXX_COMPILER})
    endif()
  endforeach()
  if(found)
    message(FATAL_ERROR "The compiler ${found} is that of a conda environment, and the libraries are the system's. "
                        "Leave the environment (conda deactivate) and remove the build folder, or name the system's "
                        "compiler (-DCMAKE_CXX_COMPILER=/usr/bin/g++), or, if the environment has every library, say "
                        "so (-DMYOID_CONDA=ON)")
  endif()
  foreach(prefix IN LISTS myoid_prefixes)
    message(STATUS "Libraries of the conda environment ${prefix} are left out (-DMYOID_CONDA=ON takes them)")
    list(APPEND CMAKE_IGNORE_PREFIX_PATH ${prefix})
  endforeach()
endif()

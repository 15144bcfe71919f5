# Headers and the templates of a room cost more than half of every compilation. With MYOID_UNITY all sources of a target
# are one translation unit, and GCC reads the headers that most of them include from a file that it made once
# (a precompiled header). The other presets read every header of every source, and so find a missing include.
if(MYOID_UNITY)
  set(CMAKE_UNITY_BUILD ON)
  if(NOT DEFINED CMAKE_UNITY_BUILD_BATCH_SIZE)
    set(CMAKE_UNITY_BUILD_BATCH_SIZE 0)
  endif()
  # GCC looks for memory that it can use again each time it needs a third more, which takes a twelfth of its time. The
  # largest room needs 2.2 GB when GCC does not look.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    add_compile_options(--param=ggc-min-heapsize=2000000)
  endif()
endif()
set(MYOID_COMMON_HEADERS <algorithm> <array> <charconv> <cmath> <cstdint> <cstring> <filesystem> <fstream> <functional>
    <limits> <map> <memory> <numbers> <numeric> <optional> <set> <span> <sstream> <string> <string_view> <utility>
    <variant> <vector> <Eigen/Core> <Eigen/Geometry> <fmt/format.h> <fmt/ranges.h> <nlohmann/json.hpp>)

# myoid_optimize(TARGET [LIGHTLY]): the level of optimization of a target, and the headers compiled once for this level.
# LIGHTLY (-O1) is for what waits for files and people: a third less to compile, and the same results to the last bit,
# because neither level reorders floating-point arithmetic. At -O1 GCC 12 calls variables uninitialized that are not.
function(myoid_optimize target)
  set(level full)
  set(light $<$<NOT:$<CONFIG:Debug>>:-O1> -Wno-maybe-uninitialized)
  if("LIGHTLY" IN_LIST ARGN AND NOT MYOID_SANITIZE)
    set(level light)
    target_compile_options(${target} PRIVATE ${light})
  endif()
  if(NOT MYOID_UNITY OR NOT CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    return()
  endif()
  if(NOT TARGET myoid_headers_${level})
    set(empty ${CMAKE_BINARY_DIR}/headers_${level}.cpp)
    file(CONFIGURE OUTPUT ${empty} CONTENT "// Compiled headers belong to a target, and a target has a source.\n")
    add_library(myoid_headers_${level} OBJECT EXCLUDE_FROM_ALL ${empty})
    target_link_libraries(myoid_headers_${level} PRIVATE Eigen3::Eigen fmt::fmt nlohmann_json::nlohmann_json
                                                         myoid_warnings)
    target_precompile_headers(myoid_headers_${level} PRIVATE ${MYOID_COMMON_HEADERS})
    if(level STREQUAL "light")
      target_compile_options(myoid_headers_light PRIVATE ${light})
    endif()
  endif()
  target_precompile_headers(${target} REUSE_FROM myoid_headers_${level})
  get_target_property(kind ${target} TYPE)
  if(kind STREQUAL "EXECUTABLE")
    target_compile_options(${target} PRIVATE -fPIC)  # as the libraries: one set of compiled headers for both
  endif()
endfunction()

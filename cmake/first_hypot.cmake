# myoid_first_hypot(TARGET): the target asks for hypot's first version (first_hypot.cpp), where there is one. A target
# that is linked of another's objects needs the linker's option alone: myoid_first_hypot(TARGET OBJECTS).
include(CheckCXXSourceCompiles)
set(CMAKE_REQUIRED_LINK_OPTIONS -Wl,--wrap=hypot)
file(READ ${CMAKE_CURRENT_LIST_DIR}/first_hypot.cpp myoid_first_hypot_source)
check_cxx_source_compiles("${myoid_first_hypot_source}
#include <cmath>
int main(int argc, char**) { return std::hypot(3.0 * argc, 4.0) > 0.0 ? 0 : 1; }" MYOID_HAS_FIRST_HYPOT)
unset(CMAKE_REQUIRED_LINK_OPTIONS)
function(myoid_first_hypot target)
  if(NOT MYOID_HAS_FIRST_HYPOT OR MYOID_SANITIZE)
    return()
  endif()
  if(NOT "OBJECTS" IN_LIST ARGN)
    target_sources(${target} PRIVATE ${PROJECT_SOURCE_DIR}/cmake/first_hypot.cpp)
    set_source_files_properties(${PROJECT_SOURCE_DIR}/cmake/first_hypot.cpp TARGET_DIRECTORY ${target}
                                PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  endif()
  target_link_options(${target} PRIVATE -Wl,--wrap=hypot)
endfunction()

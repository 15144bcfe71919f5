# One interface target carries every flag; each has its reason.
add_library(myoid_warnings INTERFACE)
target_compile_options(myoid_warnings INTERFACE
  -Wall -Wextra -Wpedantic    # the baseline
  -Wshadow                    # a hidden name is a wrong name
  -Wconversion                # counts and doubles do not mix by accident
  -Wdouble-promotion          # there is no float here; one would be a mistake
  -Wold-style-cast            # casts say what they do
  -Wnon-virtual-dtor -Woverloaded-virtual
  $<$<CXX_COMPILER_ID:GNU>:-Wduplicated-cond$<SEMICOLON>-Wduplicated-branches$<SEMICOLON>-Wlogical-op>
  -Wformat=2)
# Designated initializers leave the other members at their defaults on purpose.
target_compile_options(myoid_warnings INTERFACE -Wno-missing-field-initializers)
# -Wnull-dereference is off: with GCC 12 at -O2 it reports Eigen's own inlined code.
if(MYOID_WARNINGS_AS_ERRORS)
  target_compile_options(myoid_warnings INTERFACE -Werror)
endif()
if(MYOID_TIDY)
  find_program(MYOID_CLANG_TIDY clang-tidy REQUIRED)
  set(CMAKE_CXX_CLANG_TIDY ${MYOID_CLANG_TIDY} --warnings-as-errors=*)
endif()

# Headers and the templates of a room cost more than half of every compilation. With MYOID_UNITY all sources of a target
# are one translation unit. The other presets read every header of every source, and so find a missing include.
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
  # Objects do not know the folder of their checkout, so that the compiler cache serves every
  # checkout (dependencies.cmake).
  add_compile_options(-ffile-prefix-map=${PROJECT_SOURCE_DIR}=.)
endif()

# myoid_optimize(TARGET LEVEL) in place of -O2, with the same results to the last bit, because no level reorders
# floating-point arithmetic. -O1 is for rooms that wait for files and people: a third less to compile. -Og is for tests,
# which call optimized rooms: a fifth less again, and less than -O0, which writes more code. Below -O2, GCC 12 calls
# variables uninitialized that are not.
function(myoid_optimize target level)
  if(NOT MYOID_SANITIZE)
    target_compile_options(${target} PRIVATE $<$<NOT:$<CONFIG:Debug>>:${level}> -Wno-maybe-uninitialized)
  endif()
endfunction()

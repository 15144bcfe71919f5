# Headers and the templates of a room cost more than half of every compilation: with MYOID_UNITY all sources of a target
# are one translation unit.
if(MYOID_UNITY)
  set(CMAKE_UNITY_BUILD ON)
  if(NOT DEFINED CMAKE_UNITY_BUILD_BATCH_SIZE)
    set(CMAKE_UNITY_BUILD_BATCH_SIZE 0)
  endif()
endif()

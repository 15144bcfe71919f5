# The wings of the house and their rooms. A wing is a folder of myoid/ and a namespace; a room is a folder of its wing, or
# the wing's own folder where both have one name.
set(MYOID_WING_ground core math files)
set(MYOID_WING_recording tables makers c3d recording signals)
set(MYOID_WING_muscle muscle)
set(MYOID_WING_page page)
set(MYOID_WING_body model osim arm kinematics dynamics forces simulation scene)
set(MYOID_WING_fit beliefs measurement intervals posterior methods)
set(MYOID_WING_opensim opensim projects)
set(MYOID_WING_study phases study draft intake checks)
set(MYOID_WING_run design run identify_files)
set(MYOID_WING_results results comparison review exports cohort mat realtime)
set(MYOID_WING_lab virtual_person twin)
set(MYOID_WING_program contents steps commands cli)
set(MYOID_WINGS ground recording muscle page body fit opensim study run results lab program)
foreach(wing IN LISTS MYOID_WINGS)
  foreach(room IN LISTS MYOID_WING_${wing})
    if(room STREQUAL wing)
      set(MYOID_FOLDER_${room} ${wing})
    else()
      set(MYOID_FOLDER_${room} ${wing}/${room})
    endif()
  endforeach()
endforeach()

# The rooms, lowest first, and which lower rooms each may use: written here once. The targets link
# exactly these; tests/architecture compares every #include with this list.
set(MYOID_LAYERS core math files muscle tables makers c3d recording signals model osim arm
    kinematics dynamics forces simulation beliefs measurement intervals posterior methods page phases study intake checks
    design run scene opensim projects exports results comparison draft contents identify_files review virtual_person
    twin cohort realtime mat steps commands cli)
set(MYOID_LAYER_core)
set(MYOID_LAYER_math core)
set(MYOID_LAYER_files core)
set(MYOID_LAYER_muscle core math files)
set(MYOID_LAYER_tables core files)
set(MYOID_LAYER_makers core files tables)
set(MYOID_LAYER_c3d core files)
set(MYOID_LAYER_recording core math files tables makers c3d)
set(MYOID_LAYER_signals core math files tables recording)
set(MYOID_LAYER_model core math muscle)
set(MYOID_LAYER_osim core files muscle model)
set(MYOID_LAYER_arm core muscle)
set(MYOID_LAYER_kinematics core math files recording signals model)
set(MYOID_LAYER_dynamics core math files tables recording signals model osim kinematics)
set(MYOID_LAYER_forces core math muscle model osim kinematics dynamics)
set(MYOID_LAYER_simulation core math files muscle model osim arm kinematics dynamics forces)
set(MYOID_LAYER_beliefs core)
set(MYOID_LAYER_measurement core math muscle beliefs)
set(MYOID_LAYER_intervals core math muscle measurement)
set(MYOID_LAYER_posterior core math muscle beliefs measurement intervals)
set(MYOID_LAYER_methods core math muscle beliefs measurement intervals posterior)
set(MYOID_LAYER_page core files)
set(MYOID_LAYER_phases core math)
set(MYOID_LAYER_study core math files muscle recording signals model osim arm kinematics forces measurement
    phases)
set(MYOID_LAYER_intake core math files tables recording signals model osim kinematics dynamics study)
set(MYOID_LAYER_checks core math files tables recording signals model osim kinematics dynamics measurement
    methods study intake)
set(MYOID_LAYER_design core math files muscle arm kinematics dynamics beliefs measurement
    intervals posterior page study)
set(MYOID_LAYER_run core math files tables signals model kinematics dynamics forces beliefs
    measurement intervals posterior methods page phases study intake checks design)
set(MYOID_LAYER_scene core files recording model osim page)
set(MYOID_LAYER_exports core files muscle osim measurement intervals study run projects)
set(MYOID_LAYER_results core math files muscle tables model kinematics forces simulation
    measurement intervals methods page phases study design run scene exports)
set(MYOID_LAYER_comparison core files measurement intervals page study)
set(MYOID_LAYER_draft core files tables recording model osim arm kinematics study)
set(MYOID_LAYER_contents core files tables c3d recording model projects)
set(MYOID_LAYER_identify_files core files muscle tables measurement study)
set(MYOID_LAYER_review core files recording measurement intervals page study intake projects identify_files run results)
set(MYOID_LAYER_opensim core math files tables recording signals model osim kinematics
    dynamics forces simulation)
set(MYOID_LAYER_projects core math files tables recording osim opensim)
set(MYOID_LAYER_virtual_person core math files muscle model osim arm beliefs
    measurement study)
set(MYOID_LAYER_twin core math files muscle tables recording c3d arm beliefs intervals study run
    virtual_person)
set(MYOID_LAYER_cohort core math files tables recording intervals page study design comparison)
set(MYOID_LAYER_realtime core files measurement kinematics model muscle study)
set(MYOID_LAYER_mat core files tables)
set(MYOID_LAYER_steps core math files muscle tables c3d recording signals model osim arm kinematics dynamics
    forces simulation intervals page study checks results)
set(MYOID_LAYER_commands core files tables recording osim arm measurement intervals methods page study
    checks design run scene opensim projects exports results comparison draft contents identify_files review
    virtual_person twin cohort steps)
set(MYOID_LAYER_cli core math files methods page study design results comparison contents review cohort mat commands
    steps)

# Rooms that compute little themselves: they read, write, judge and call the rooms below.
set(MYOID_LIGHT_LAYERS osim arm beliefs page phases study intake checks design run scene exports results comparison
    draft contents identify_files opensim projects review twin cohort mat steps commands cli)

# myoid_layer(NAME UNITS ... [GENERATED sources...] [TESTS_USE layers...] [TESTS_TOGETHER] [EXTERNAL targets...])
# A folder is a target; its tests are one executable. A unit u stands for those of u.h, u.cpp and u.test.cpp
# that exist. TESTS_USE names the layers that only the tests need. TESTS_TOGETHER: ctest starts the tests as one, because
# many of them look at one result that takes seconds to make.
function(myoid_layer name)
  cmake_parse_arguments(ARG "TESTS_TOGETHER" "" "UNITS;GENERATED;TESTS_USE;EXTERNAL" ${ARGN})
  set(headers)
  set(sources ${ARG_GENERATED})
  set(tests)
  foreach(unit IN LISTS ARG_UNITS)
    set(path ${CMAKE_CURRENT_SOURCE_DIR}/${unit})
    if(NOT EXISTS ${path}.h AND NOT EXISTS ${path}.cpp AND NOT EXISTS ${path}.test.cpp)
      message(FATAL_ERROR "myoid/${MYOID_FOLDER_${name}}/CMakeLists.txt lists ${unit}, which has no file")
    endif()
    if(EXISTS ${path}.h)
      list(APPEND headers ${unit}.h)
    endif()
    if(EXISTS ${path}.cpp)
      list(APPEND sources ${unit}.cpp)
    endif()
    if(EXISTS ${path}.test.cpp)
      list(APPEND tests ${unit}.test.cpp)
    endif()
  endforeach()
  set(deps)
  foreach(dep IN LISTS MYOID_LAYER_${name})
    list(APPEND deps myoid_${dep})
  endforeach()
  add_library(myoid_${name} STATIC ${sources} ${headers})
  target_include_directories(myoid_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                                  $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(myoid_${name} PUBLIC ${deps} ${ARG_EXTERNAL} Eigen3::Eigen fmt::fmt
                                      PRIVATE $<BUILD_INTERFACE:myoid_warnings>)
  if(name IN_LIST MYOID_LIGHT_LAYERS)
    myoid_optimize(myoid_${name} -O1)
  endif()
  set_target_properties(myoid_${name} PROPERTIES EXPORT_NAME ${name})
  install(TARGETS myoid_${name} EXPORT MyoidTargets DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT dev)
  if(MYOID_TESTS AND tests)
    add_executable(${name}_tests ${tests})
    list(TRANSFORM ARG_TESTS_USE PREPEND myoid_)
    target_link_libraries(${name}_tests PRIVATE myoid_${name} ${ARG_TESTS_USE} myoid_test_support
                                                myoid_warnings)
    myoid_optimize(${name}_tests -Og)
    if(ARG_TESTS_TOGETHER)
      add_test(NAME ${name}.all COMMAND ${name}_tests)
      set_tests_properties(${name}.all PROPERTIES COST 10 TIMEOUT 1800)
    else()
      gtest_discover_tests(${name}_tests TEST_PREFIX "${name}." DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 1800)
    endif()
  endif()
endfunction()

# The folder of the checkout is known to this object alone: the objects of two checkouts are equal otherwise, and
# the compiler cache serves both.
if(MYOID_TESTS OR MYOID_BENCHMARKS)
  add_library(myoid_places STATIC EXCLUDE_FROM_ALL ${PROJECT_SOURCE_DIR}/tests/support/places.cpp)
  target_include_directories(myoid_places PUBLIC ${PROJECT_SOURCE_DIR})
  target_compile_definitions(myoid_places PRIVATE MYOID_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  target_link_libraries(myoid_places PRIVATE myoid_warnings)
endif()
# Test helpers that no single folder owns.
if(MYOID_TESTS)
  add_library(myoid_test_support INTERFACE)
  target_include_directories(myoid_test_support INTERFACE ${PROJECT_SOURCE_DIR})
  target_link_libraries(myoid_test_support INTERFACE myoid_places GTest::gtest GTest::gmock GTest::gtest_main)
endif()

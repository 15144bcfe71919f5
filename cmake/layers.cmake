# The layers, lowest first, and which lower layers each may use: written here once. The targets link
# exactly these; tests/architecture compares every #include with this list.
set(MYOID_LAYERS core math files muscle tables c3d recording signals model osim arm kinematics
    dynamics forces simulation identification intervals methods report phases study intake checks
    design run scene results draft contents identify_files opensim_tools twin cli)
set(MYOID_LAYER_core)
set(MYOID_LAYER_math core)
set(MYOID_LAYER_files core)
set(MYOID_LAYER_muscle core math files)
set(MYOID_LAYER_tables core files)
set(MYOID_LAYER_c3d core files)
set(MYOID_LAYER_recording core math files tables c3d)
set(MYOID_LAYER_signals core math files recording)
set(MYOID_LAYER_model core math files)
set(MYOID_LAYER_osim core files muscle model)
set(MYOID_LAYER_arm core muscle)
set(MYOID_LAYER_kinematics core math files tables signals model)
set(MYOID_LAYER_dynamics core math files tables recording signals model osim kinematics)
set(MYOID_LAYER_forces core muscle model osim kinematics dynamics)
set(MYOID_LAYER_simulation core math files muscle model osim arm kinematics dynamics forces)
set(MYOID_LAYER_identification core math muscle)
set(MYOID_LAYER_intervals core math muscle signals identification)
set(MYOID_LAYER_methods core math muscle forces identification intervals)
set(MYOID_LAYER_report core files)
set(MYOID_LAYER_phases core math)
set(MYOID_LAYER_study core files muscle recording model osim arm kinematics identification)
set(MYOID_LAYER_intake core files tables recording signals model osim kinematics dynamics study)
set(MYOID_LAYER_checks core math files tables recording signals model kinematics dynamics study
    intake)
set(MYOID_LAYER_design core muscle arm kinematics dynamics simulation identification intervals
    methods report study)
set(MYOID_LAYER_run core math files tables signals osim arm kinematics dynamics forces
    identification intervals methods report phases study intake checks design)
set(MYOID_LAYER_scene core files recording model osim report)
set(MYOID_LAYER_results core math files muscle tables model kinematics forces simulation
    identification intervals methods report phases study design run scene)
set(MYOID_LAYER_draft core files tables recording model osim arm kinematics study)
set(MYOID_LAYER_contents core tables c3d recording model)
set(MYOID_LAYER_identify_files core math files muscle tables recording signals dynamics
    identification methods checks)
set(MYOID_LAYER_opensim_tools core math files tables recording signals model osim kinematics
    dynamics forces simulation)
set(MYOID_LAYER_twin core math files muscle tables c3d model osim arm simulation intervals run)
set(MYOID_LAYER_cli core math files muscle tables c3d recording signals model osim arm kinematics
    dynamics forces simulation identification intervals methods report study checks design run scene
    results draft contents identify_files opensim_tools twin)

# myoid_layer(NAME [HEADERS ...] [SOURCES ...] [TESTS ...] [EXTERNAL targets...])
# A folder is a target; its tests are one executable. Everything is listed by name.
function(myoid_layer name)
  cmake_parse_arguments(ARG "" "" "HEADERS;SOURCES;TESTS;EXTERNAL" ${ARGN})
  set(deps)
  foreach(dep IN LISTS MYOID_LAYER_${name})
    list(APPEND deps myoid_${dep})
  endforeach()
  if(ARG_SOURCES)
    add_library(myoid_${name} STATIC ${ARG_SOURCES} ${ARG_HEADERS})
    target_include_directories(myoid_${name} PUBLIC ${PROJECT_SOURCE_DIR})
    target_link_libraries(myoid_${name} PUBLIC ${deps} ${ARG_EXTERNAL} Eigen3::Eigen fmt::fmt
                                        PRIVATE myoid_warnings)
  else()
    add_library(myoid_${name} INTERFACE)
    target_include_directories(myoid_${name} INTERFACE ${PROJECT_SOURCE_DIR})
    target_link_libraries(myoid_${name} INTERFACE ${deps} ${ARG_EXTERNAL} Eigen3::Eigen fmt::fmt)
  endif()
  if(MYOID_TESTS AND ARG_TESTS)
    add_executable(${name}_tests ${ARG_TESTS})
    target_link_libraries(${name}_tests PRIVATE myoid_${name} myoid_test_support myoid_warnings)
    if(NOT MYOID_SANITIZE)
      target_compile_options(${name}_tests PRIVATE -O1)  # quick to build; the library keeps -O2
    endif()
    gtest_discover_tests(${name}_tests TEST_PREFIX "${name}." DISCOVERY_TIMEOUT 60
                         PROPERTIES TIMEOUT 600)
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

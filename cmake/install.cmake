# What C++ programs build against: `find_package(Myoid)` after `cmake --install BUILD --component dev --prefix DIR`.
# The headers of all rooms, their static libraries (Myoid::core ... Myoid::commands), the C interface (Myoid::c).
include(CMakePackageConfigHelpers)
set(myoid_config ${CMAKE_INSTALL_LIBDIR}/cmake/Myoid)
install(DIRECTORY myoid DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT dev
        FILES_MATCHING PATTERN "*.h" PATTERN viewer EXCLUDE PATTERN cli EXCLUDE)
install(TARGETS myoid_pugixml myoid_toml myoid_jet myoid_sundials EXPORT MyoidTargets)
install(EXPORT MyoidTargets NAMESPACE Myoid:: DESTINATION ${myoid_config} COMPONENT dev)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/MyoidConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES cmake/MyoidConfig.cmake ${CMAKE_BINARY_DIR}/MyoidConfigVersion.cmake DESTINATION ${myoid_config}
        COMPONENT dev)
# The licences of the works that the libraries hold.
install(FILES NOTICE licenses.txt DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libmyoid-dev COMPONENT dev)

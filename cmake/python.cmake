# The extension module of python/: built where Python's headers and pybind11 are (packages python3-dev, pybind11-dev).
# Debian's Python, unless -DMYOID_PYTHON names another interpreter.
find_program(MYOID_PYTHON NAMES python3 HINTS /usr/bin NO_CMAKE_ENVIRONMENT_PATH)
find_path(MYOID_PYBIND11_INCLUDE pybind11/pybind11.h)
if(MYOID_PYTHON)
  execute_process(
    COMMAND ${MYOID_PYTHON} -c
            "import sysconfig; print(sysconfig.get_path('include'), sysconfig.get_config_var('EXT_SUFFIX'), sep=';')"
    OUTPUT_VARIABLE MYOID_PYTHON_FACTS OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  list(GET MYOID_PYTHON_FACTS 0 MYOID_PYTHON_INCLUDE)
  list(GET MYOID_PYTHON_FACTS 1 MYOID_PYTHON_SUFFIX)
endif()
set(MYOID_HAS_PYTHON OFF)
if(MYOID_PYBIND11_INCLUDE AND EXISTS "${MYOID_PYTHON_INCLUDE}/Python.h")
  set(MYOID_HAS_PYTHON ON)
endif()

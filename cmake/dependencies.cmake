# Everything comes from packages of the system (Debian 12 has all of them); nothing is fetched.
find_program(MYOID_CCACHE ccache)
if(MYOID_CCACHE)
  # A second checkout finds the first one's objects.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=1
                                  ${MYOID_CCACHE})
endif()

find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(fmt 9 REQUIRED)
find_package(pugixml REQUIRED)
# Static where it is there: what the program loads at its start costs every short run 0.1 ms.
add_library(myoid_pugixml INTERFACE)
if(TARGET pugixml::static)
  target_link_libraries(myoid_pugixml INTERFACE pugixml::static)
else()
  target_link_libraries(myoid_pugixml INTERFACE pugixml::pugixml)
endif()
find_package(nlohmann_json 3.11 REQUIRED)
find_package(CLI11 2.1 REQUIRED)
find_package(TBB REQUIRED)
# The static library where there is one: a program that hashes little need not load 5 MB at its start.
set(OPENSSL_USE_STATIC_LIBS ON)
find_package(OpenSSL 3 QUIET COMPONENTS Crypto)
if(NOT OPENSSL_FOUND)
  set(OPENSSL_USE_STATIC_LIBS OFF)
  find_package(OpenSSL 3 REQUIRED COMPONENTS Crypto)
endif()
# Debian 13's static library needs zlib's, which is not built for shared libraries and modules.
if(OPENSSL_USE_STATIC_LIBS)
  include(CheckCXXSourceCompiles)
  set(CMAKE_REQUIRED_FLAGS -fPIC)
  set(CMAKE_REQUIRED_LINK_OPTIONS -shared)
  set(CMAKE_REQUIRED_LIBRARIES OpenSSL::Crypto)
  check_cxx_source_compiles("#include <openssl/evp.h>
const void* sha256() { return EVP_sha256(); }
int main() { return sha256() == nullptr; }" MYOID_STATIC_CRYPTO_IN_MODULES)
  unset(CMAKE_REQUIRED_FLAGS)
  unset(CMAKE_REQUIRED_LINK_OPTIONS)
  unset(CMAKE_REQUIRED_LIBRARIES)
  if(NOT MYOID_STATIC_CRYPTO_IN_MODULES)
    find_library(MYOID_SHARED_CRYPTO NAMES libcrypto.so REQUIRED)
    set_target_properties(OpenSSL::Crypto PROPERTIES IMPORTED_LOCATION ${MYOID_SHARED_CRYPTO} INTERFACE_LINK_LIBRARIES "")
  endif()
endif()
find_package(Threads REQUIRED)
find_package(Boost 1.74 REQUIRED)  # headers only
find_path(MYOID_TOMLPLUSPLUS_INCLUDE toml++/toml.h REQUIRED)
find_path(MYOID_CERES_INCLUDE ceres/jet.h REQUIRED)

# ceres/jet.h only: the program does not link Ceres (decision 0008). Its config header pulls nothing.
add_library(myoid_jet INTERFACE)
target_include_directories(myoid_jet SYSTEM INTERFACE ${MYOID_CERES_INCLUDE})

add_library(myoid_toml INTERFACE)
target_include_directories(myoid_toml SYSTEM INTERFACE ${MYOID_TOMLPLUSPLUS_INCLUDE})

include(${CMAKE_CURRENT_LIST_DIR}/sundials.cmake)

# libmatio (MATLAB files) is loaded by its soname when such a file is written; without its header none can be.
find_path(MYOID_MATIO_INCLUDE matio.h)
find_library(MYOID_MATIO_LIBRARY NAMES libmatio.so)
set(MYOID_MATIO_SONAME "")
if(MYOID_MATIO_INCLUDE AND MYOID_MATIO_LIBRARY)
  file(REAL_PATH "${MYOID_MATIO_LIBRARY}" matio_file)
  if(matio_file MATCHES "(libmatio\\.so\\.[0-9]+)")
    set(MYOID_MATIO_SONAME ${CMAKE_MATCH_1})
  endif()
endif()
if(NOT MYOID_MATIO_SONAME)
  message(STATUS "No libmatio (package libmatio-dev): --mat is refused")
endif()

if(MYOID_TESTS)
  find_package(GTest 1.12 REQUIRED)
endif()

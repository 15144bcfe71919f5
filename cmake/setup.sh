#!/usr/bin/env bash
# Sourced by run-demo and run-tests: installs what is missing on Debian 12 and 13, configures and builds
# the one optimised tree that both share. Idempotent.

MYOID_ROOT="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
MYOID_BUILD="$MYOID_ROOT/build/release"

# package: why it is needed. Ubuntu 24.04 has the same names. Fedora's, by reading, not tried: gcc-c++ cmake ninja-build
# ccache eigen3-devel fmt-devel pugixml-devel tomlplusplus-devel json-devel cli11-devel tbb-devel openssl-devel
# ceres-solver-devel boost-devel sundials-devel matio-devel pybind11-devel python3-devel.
MYOID_PACKAGES=(
  "g++:compiler" "cmake:build system" "ninja-build:build system" "ccache:quick rebuilds"
  "libeigen3-dev:linear algebra" "libfmt-dev:text formatting" "libpugixml-dev:.osim files"
  "libtomlplusplus-dev:study files" "nlohmann-json3-dev:JSON results" "libcli11-dev:command line"
  "libtbb-dev:threads" "libssl-dev:SHA-256 of the inputs" "libceres-dev:ceres/jet.h (exact derivatives); test oracle"
  "libboost-dev:Sobol points and distribution functions (headers)"
  "libjs-three:three.js, for pages with a moving model" "esbuild:bundles it with our viewer"
  "libmatio-dev:MATLAB files (--mat)"
)
MYOID_TEST_PACKAGES=(
  "libgtest-dev:tests" "libgmock-dev:tests" "libbenchmark-dev:benchmarks"
  "libsimbody-dev:test oracle of the multibody engine"
)

myoid_log() { printf '%s\n' "$*" >&2; }

myoid_as_root() {  # myoid_as_root COMMAND...
  if [ "$(id -u)" -eq 0 ]; then "$@"; else sudo "$@"; fi
}

myoid_is_installed() { dpkg-query -W -f='${Status}' "$1" 2>/dev/null | grep -q 'install ok installed'; }

myoid_install_packages() {  # myoid_install_packages PACKAGE:REASON...
  local missing=() entry name
  for entry in "$@"; do
    name="${entry%%:*}"
    if ! myoid_is_installed "$name"; then
      missing+=("$name")
      myoid_log "missing package: $name (${entry#*:})"
    fi
  done
  [ "${#missing[@]}" -eq 0 ] && return 0
  if [ "$(id -u)" -ne 0 ] && ! command -v sudo >/dev/null; then
    myoid_log "Please install as root:  apt-get install ${missing[*]}"
    exit 3
  fi
  myoid_log "Installing: ${missing[*]}"
  myoid_as_root apt-get update -qq >&2
  myoid_as_root env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends "${missing[@]}" >&2
}

# CVODES, for stiff differential equations. Debian's libsundials-dev depends on 157 packages (116 MB: MPI, PETSc and
# Fortran), of which the serial solver uses none. Where it is not installed, its headers and static libraries are
# unpacked beside the build.
myoid_unpack_sundials() {
  local place="$MYOID_ROOT/build/sundials"
  [ -f /usr/include/cvodes/cvodes.h ] && return 0
  export CMAKE_PREFIX_PATH="$place/usr${CMAKE_PREFIX_PATH:+:$CMAKE_PREFIX_PATH}"
  [ -f "$place/usr/include/cvodes/cvodes.h" ] && return 0
  myoid_log "Unpacking libsundials-dev (ODE integration) in $place"
  mkdir -p "$place"
  (cd "$place" && { apt-get download -qq libsundials-dev ||
      { myoid_as_root apt-get update -qq && apt-get download -qq libsundials-dev; }; } &&
    dpkg-deb -x libsundials-dev_*.deb . && rm libsundials-dev_*.deb) >&2
}

# The browser in which the pages with a moving model are tested (90 MB to fetch). Without it that
# test is skipped, and says so.
myoid_install_browser() {
  command -v chromium >/dev/null && return 0
  if [ "$(id -u)" -ne 0 ] && ! command -v sudo >/dev/null; then
    myoid_log "No chromium: pages with a moving model are not tested in a browser"
    return 0
  fi
  myoid_log "Installing: chromium"
  { myoid_as_root apt-get update -qq && myoid_as_root env DEBIAN_FRONTEND=noninteractive \
      apt-get install -y -qq --no-install-recommends chromium; } >&2 ||
    myoid_log "chromium cannot be installed: pages with a moving model are not tested in a browser"
}

# The Python module and its tests. Without these packages the module is not built.
myoid_install_python() {
  local wanted=(pybind11-dev python3-dev python3-numpy python3-pandas python3-xarray python3-pytest python3-pip
                python3-scipy python3-matplotlib python3-nbclient python3-ipykernel python3-joblib mypy) name missing=()
  for name in "${wanted[@]}"; do
    myoid_is_installed "$name" || missing+=("$name")
  done
  [ "${#missing[@]}" -eq 0 ] && return 0
  if [ "$(id -u)" -ne 0 ] && ! command -v sudo >/dev/null; then
    myoid_log "No ${missing[*]}: the Python module is not tested"
    return 0
  fi
  myoid_log "Installing: ${missing[*]}"
  { myoid_as_root apt-get update -qq && myoid_as_root env DEBIAN_FRONTEND=noninteractive \
      apt-get install -y -qq --no-install-recommends "${missing[@]}"; } >&2 ||
    myoid_log "${missing[*]} cannot be installed: the Python module is not tested"
}

# Programs that some tests run with: engines of a cohort (Snakemake, which takes longer to install, is left out), Octave
# for matlab/+myoid, man for the manual pages, Sphinx for the site, debootstrap for empty roots. Without them these tests
# are skipped, and say so. CI only: on a workstation Slurm's package would start services.
myoid_install_test_programs() {
  local wanted=(debootstrap parallel slurm-wlm munge octave man-db python3-sphinx python3-myst-parser
                python3-sphinx-rtd-theme libjs-katex)
  if [ "$(id -u)" -ne 0 ] && ! command -v sudo >/dev/null; then return 0; fi
  myoid_log "Installing: ${wanted[*]}"
  { myoid_as_root apt-get update -qq && myoid_as_root env DEBIAN_FRONTEND=noninteractive \
      apt-get install -y -qq --no-install-recommends "${wanted[@]}"; } >&2 ||
    myoid_log "${wanted[*]} cannot be installed: their tests are skipped"
}

# clang has libFuzzer. Without it the readers are not fuzzed, and CI says so.
myoid_install_clang() {
  command -v clang++ >/dev/null && return 0
  if [ "$(id -u)" -ne 0 ] && ! command -v sudo >/dev/null; then return 0; fi
  myoid_log "Installing: clang"
  { myoid_as_root apt-get update -qq && myoid_as_root env DEBIAN_FRONTEND=noninteractive \
      apt-get install -y -qq --no-install-recommends clang; } >&2 ||
    myoid_log "clang cannot be installed: the readers are not fuzzed"
}

myoid_build() {  # myoid_build [target...]
  myoid_log "Configuring and building in $MYOID_BUILD"
  local log tests=ON warnings=OFF entry
  # The compilers of other systems warn of other things, which stop nobody there.
  grep -q '^VERSION_CODENAME=bookworm' /etc/os-release 2>/dev/null && warnings=ON
  for entry in "${MYOID_TEST_PACKAGES[@]}"; do myoid_is_installed "${entry%%:*}" || tests=OFF; done
  cd "$MYOID_ROOT"
  log="$(mktemp)"
  if ! cmake --preset release -DMYOID_TESTS="$tests" -DMYOID_WARNINGS_AS_ERRORS="$warnings" >"$log" 2>&1; then cat "$log" >&2; exit 1; fi
  rm -f "$log"
  local targets=()
  [ "$#" -gt 0 ] && targets=(--target "$@")
  cmake --build "$MYOID_BUILD" "${targets[@]}" >&2
}

# Sets TMPDIR to a new folder in memory, where there is one with 2 GB free that may run programs: the tests write
# thousands of files, and the program waits until each is on the disk.
myoid_temporary_in_memory() {
  local free folder
  [ -z "${TMPDIR:-}" ] && free="$(df --output=avail -k /dev/shm 2>/dev/null | tail -1)" || return 0
  [ "${free:-0}" -gt 2000000 ] && folder="$(mktemp -d /dev/shm/myoid.XXXXXX 2>/dev/null)" || return 0
  trap 'rm -rf "$TMPDIR"' EXIT
  export TMPDIR="$folder"
  printf '#!/bin/sh\n' >"$TMPDIR/program"
  chmod +x "$TMPDIR/program"
  "$TMPDIR/program" 2>/dev/null || { rm -rf "$folder"; trap - EXIT; unset TMPDIR; }
}

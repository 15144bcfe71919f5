#!/usr/bin/env bash
# usage: packaging/syntax.sh PREFIX [FOLDER...]
# Reads all sources of the program and its libraries with the system's compiler (-fsyntax-only; CXX names another), each
# folder of myoid/ as one unit, by the headers in PREFIX/usr/include. Generated sources are left out. Each folder with an
# error is named with its first errors; the exit code is 1 then.
set -euo pipefail
[ "$#" -ge 1 ] || { sed -n '2s/^# //p' "$0" >&2; exit 2; }
include=$(realpath "$1")/usr/include
shift
cd "$(dirname "$0")/.."
compiler=${CXX:-g++}
version=$(sed -n 's/^project(myoid VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
folders=("$@")
[ "$#" -gt 0 ] || mapfile -t folders < <(find myoid -name '*.cpp' ! -name '*.test.cpp' -printf '%h\n' | sort -u)
# Where packages keep headers: Eigen, and those that differ by processor.
places=(-I. -isystem "$include" -isystem "$include/eigen3" -isystem "$include/$("$compiler" -print-multiarch)" -isystem
  cmake/serial_mpi)
number() { sed -n "s/^#define $1 *\"\{0,1\}\([0-9.]*\).*/\1/p" "$include"/$2 | head -n 1; }
failed=0 errors=$(mktemp)
trap 'rm -f "$errors"' EXIT
for folder in "${folders[@]}"; do
  if ! find "$folder" -maxdepth 1 -name '*.cpp' ! -name '*.test.cpp' | LC_ALL=C sort | sed 's/.*/#include "&"/' |
    "$compiler" -std=c++20 -fsyntax-only -w -O0 -DMYOID_VERSION="\"$version\"" "${places[@]}" -x c++ - 2>"$errors"; then
    failed=$((failed + 1))
    echo "$folder:"
    grep -m 3 'error' "$errors"
  fi
done
echo "${#folders[@]} folders, $failed with errors: $("$compiler" --version | head -n 1)," \
  "fmt $(number FMT_VERSION fmt/'[cb]'*e.h), SUNDIALS $(number SUNDIALS_VERSION '*/sundials/sundials_config.h')"
[ "$failed" -eq 0 ]

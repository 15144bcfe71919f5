#!/usr/bin/env bash
# usage: tests/conda/run.sh   Configures a small project in a made-up conda environment: its compiler is refused, its
# libraries are left out, and -DMYOID_CONDA=ON takes both.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
environment=$work/env
mkdir -p "$environment/bin" "$environment/lib/cmake/fmt"
printf 'set(fmt_FOUND TRUE)\n' >"$environment/lib/cmake/fmt/fmt-config.cmake"
printf '#!/bin/sh\nexec %s "$@"\n' "$(command -v c++)" >"$environment/bin/x86_64-conda-linux-gnu-c++"
chmod +x "$environment/bin/x86_64-conda-linux-gnu-c++"
export CONDA_PREFIX=$environment PATH="$environment/bin:$PATH"
unset CONDA_BUILD CXX

configure() {  # configure NAME OPTION...: prints what CMake says on one line
  cmake -S "$here" -B "$work/$1" -G Ninja "${@:2}" 2>&1 | tr -s '\n ' ' '
  return "${PIPESTATUS[0]}"
}
compiler=-DCMAKE_CXX_COMPILER=x86_64-conda-linux-gnu-c++

said=$(configure refused "$compiler") && { echo "a conda compiler is taken"; exit 1; }
grep -q "conda deactivate" <<<"$said"
configure system | grep -q "left out"
! configure system | grep -q "fmt of $environment" || { echo "conda's library is taken"; exit 1; }
configure conda "$compiler" -DMYOID_CONDA=ON | grep -q "fmt of $environment"
CONDA_BUILD=1 configure build "$compiler" | grep -q "fmt of $environment"
echo "the guard against conda: passed"

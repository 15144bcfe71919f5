#!/usr/bin/env bash
# usage: tests/installed/run.sh BUILD PROGRAM [FOLDER]   Installs headers and libraries of a build into an empty folder,
# builds the project beside this script and the numbered examples against that folder alone, and runs their programs.
# BUILD `system`: against what a package has installed. The examples' programs stay in FOLDER.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
built=${3:-$work/examples}
rm -rf "$built"
[ "$1" = system ] || cmake --install "$1" --component dev --prefix "$work/prefix" >"$work/log"
# Headers and CMake's files name no place of the build: another computer has neither.
source=$(cd "$(dirname "$0")/../.." && pwd)
mkdir -p "$work/prefix"
! grep -rIl --include='*.cmake' --include='*.h' -F -e "$source" "$work/prefix" ||
  { echo "the installed package names the checkout"; exit 1; }
[ ! -e "$work/prefix/bin" ] || { echo "the component dev holds programs"; exit 1; }
cmake -S "$(dirname "$0")" -B "$work/build" -G Ninja -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_BUILD_TYPE=Release >"$work/log"
cmake --build "$work/build" >"$work/log" || { cat "$work/log"; exit 1; }
version=$("$2" --version)
{
  printf 'motion\nversion=1\nnRows=51\nnColumns=2\ninDegrees=no\nendheader\ntime\telbow_flexion\n'
  awk 'BEGIN { for (i = 0; i <= 50; ++i) printf "%.17g\t%.17g\n", i / 50, 0.5 + i / 100 }'
} >"$work/motion.sto"
"$work/build/moment_arms" "$work/motion.sto" | tee "$work/said"
grep -q "^$version: 4 muscles" "$work/said"
"$work/build/real_time" | grep "^$version: "

examples=$(dirname "$0")/../../examples
cmake -S "$examples" -B "$built" -G Ninja -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_BUILD_TYPE=Debug >"$work/log"
cmake --build "$built" >"$work/log" || { cat "$work/log"; exit 1; }
[ "$(find "$built" -maxdepth 1 -type f -executable | wc -l)" -eq 6 ] || { echo "not six examples"; exit 1; }
"$built/muscle_forces" "$examples/03_muscle_forces/triceps.toml" "$examples/03_muscle_forces/lengths.csv" >"$work/said"
grep -q '^at 0.0 s, fiber 0.1200 m, 0.0000 m/s: 1000.0000 N$' "$work/said"  # half active at the optimal length

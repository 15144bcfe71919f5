#!/usr/bin/env bash
# usage: tests/installed/run.sh BUILD PROGRAM [FOLDER]   Installs headers and libraries of a build into an empty folder,
# builds the project beside this script and the numbered examples against that folder alone, and runs their programs.
# BUILD `system`: against what a package has installed. The examples' programs stay in FOLDER. Root (unshare) hides the
# checkout and its builds from all this, as if they were gone.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
built=$(realpath -m "${3:-$work/kept}")
rm -rf "$built"
[ "$1" = system ] || cmake --install "$1" --component dev --prefix "$work/prefix" >"$work/log"
# Headers and CMake's files name no place of the build: another computer has neither.
source=$(cd "$(dirname "$0")/../.." && pwd)
mkdir -p "$work/prefix"
! grep -rIl --include='*.cmake' --include='*.h' -F -e "$source" "$work/prefix" ||
  { echo "the installed package names the checkout"; exit 1; }
[ ! -e "$work/prefix/bin" ] || { echo "the component dev holds programs"; exit 1; }
version=$("$2" --version)
cp -r "$source/tests/installed" "$work/user"
cp -r "$source/examples" "$work/examples"
away=()  # a command before others: without the checkout
mkdir "$work/empty"
{
  [ "$1" = system ] || printf 'mount --bind %q %q\n' "$work/empty" "$(realpath "$1")"
  printf 'mount --bind %q %q\nexec "$@"\n' "$work/empty" "$source"
} >"$work/hide.sh"
if [ "$(id -u)" -eq 0 ] && unshare --mount bash -e "$work/hide.sh" true 2>/dev/null; then
  away=(unshare --mount bash -e "$work/hide.sh")
  ! "${away[@]}" test -e "$source/CMakeLists.txt" || { echo "the checkout is still there"; exit 1; }
  echo "the checkout is hidden"
fi
cd "$work"
build_alone() {  # build_alone SOURCE FOLDER TYPE
  "${away[@]}" env -u CMAKE_PREFIX_PATH cmake -S "$1" -B "$2" -G Ninja -DCMAKE_PREFIX_PATH="$work/prefix" \
    -DCMAKE_BUILD_TYPE="$3" >"$work/log" || { cat "$work/log"; exit 1; }
  "${away[@]}" cmake --build "$2" >"$work/log" || { cat "$work/log"; exit 1; }
}
build_alone user "$work/build" Release
{
  printf 'motion\nversion=1\nnRows=51\nnColumns=2\ninDegrees=no\nendheader\ntime\telbow_flexion\n'
  awk 'BEGIN { for (i = 0; i <= 50; ++i) printf "%.17g\t%.17g\n", i / 50, 0.5 + i / 100 }'
} >"$work/motion.sto"
"${away[@]}" "$work/build/moment_arms" "$work/motion.sto" | tee "$work/said"
grep -q "^$version: 4 muscles" "$work/said"
"${away[@]}" "$work/build/real_time" | grep "^$version: "

build_alone examples "$work/built" Debug
[ "$(find built -maxdepth 1 -type f -executable | wc -l)" -eq 6 ] || { echo "not six examples"; exit 1; }
given=examples/03_muscle_forces
"${away[@]}" built/muscle_forces $given/triceps.toml $given/lengths.csv >"$work/said"
grep -q '^at 0.0 s, fiber 0.1200 m, 0.0000 m/s: 1000.0000 N$' "$work/said"  # half active at the optimal length
cp -r built "$built"

#!/usr/bin/env bash
# usage: tests/threads/run.sh [TARGET...]
# Builds the preset `tsan` and runs the threaded parts under the thread sanitizer: the tests of rooms (default: core,
# math, realtime), one model of the C interface in several threads, and a study of a virtual person with four threads.
# TBB is compiled with the sanitizer, too (its sources: packaging/python-headers.sh); without that, the sanitizer does
# not see that one task waits for another. The exit code is 1 if it finds something.
set -euo pipefail
cd "$(dirname "$0")/../.."
[ $# -gt 0 ] || set -- core_tests math_tests realtime_tests
tree=build/tsan headers=build/python-headers
cmake --preset tsan >/dev/null
cmake --build $tree --target "$@" myoid_c myoid >&2
[ -d $headers/tbb ] || packaging/python-headers.sh $headers >&2
if [ ! -e $tree/tbb/libtbb.so.12 ]; then
  mkdir -p $tree/tbb
  fast=()
  [ "$(uname -m)" = x86_64 ] && fast=(-mrtm -mwaitpkg)
  g++ -std=c++17 -O1 -g1 -w -fPIC -shared -fsanitize=thread "${fast[@]}" -D__TBB_BUILD -D__TBB_DYNAMIC_LOAD_ENABLED=0 \
    -D__TBB_SOURCE_DIRECTLY_INCLUDED=1 -I$headers/tbb/include $headers/tbb/src/tbb/*.cpp -Wl,-soname,libtbb.so.12 \
    -o $tree/tbb/libtbb.so.12 -ldl -lpthread
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export LD_LIBRARY_PATH=$PWD/$tree/tbb
export TSAN_OPTIONS="suppressions=$PWD/$headers/tbb/cmake/suppressions/tsan.suppressions exitcode=66 history_size=4"
failed=0
watched() {  # watched NAME COMMAND...
  local name=$1 code=0
  shift
  "$@" >"$work/said" 2>&1 || code=$?
  local found; found=$(grep -c '^WARNING: ThreadSanitizer' "$work/said" || true)
  if [ "$found" -gt 0 ] || { [ $code -ne 0 ] && [ $code -ne 4 ]; }; then
    failed=1
    grep -A 12 '^WARNING: ThreadSanitizer' "$work/said" | head -60 || tail -5 "$work/said"
  fi
  echo "$name: $found warnings of the thread sanitizer, exit code $code"
}
for target in "$@"; do watched "$target" "$tree/bin/$target"; done
cat >"$work/p.toml" <<'TOML'
level = "L1"
[[trial]]
name = "mvc"
kind = "mvc"
direction = "both"
[[trial]]
name = "lift"
kind = "eccentric"
held_mass_kg = 1.0
TOML
program=$tree/bin/myoid
watched "twin of 4 persons" $program twin --protocol "$work/p.toml" --subjects 4 --threads 4 --out "$work/people"
watched "run, 4 threads" $program run "$work/people/person_000001/study.toml" --threads 4 --out "$work/results"
printf 'name,study\nA,people/person_000001/study.toml\nB,people/person_000002/study.toml\n' >"$work/persons.csv"
watched "cohort, 2 persons at a time" $program cohort "$work/persons.csv" --jobs 2 --out "$work/cohort"
gcc -std=c99 -O1 -g -pthread -fsanitize=thread -I$tree/include tests/realtime/threads.c \
  -L$tree/lib -lmyoid -Wl,-rpath,"$PWD/$tree/lib" -o "$work/threads"
watched "C interface, 4 threads" "$work/threads" "$work/results"
exit $failed

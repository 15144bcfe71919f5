#!/usr/bin/env bash
# usage: docs/renew.sh [BUILD] [--figures]
# Writes all numbers, tables and lines that pages take from the program of BUILD (build/release): printed tables, the
# picture of the house, the tutorial, the notebooks; with --figures also the pictures, which take minutes. A number in a
# sentence that no script knows is named by the tests. Needs the recordings of $MYOID_DATA, else of ../shared/data.
set -euo pipefail
cd "$(dirname "$0")/.."
build=build/release
[ $# -eq 0 ] || [[ $1 == -* ]] || { build=$1; shift; }
python=${MYOID_PYTHON:-/usr/bin/python3}
for room in beliefs study intake commands intervals files virtual_person; do
  MYOID_PRINT_PAGES=1 "$build/bin/${room}_tests" --gtest_brief=1
done
"$python" docs/house.py --write
"$python" tests/tutorial/errors_of_demo.py "$build/bin/myoid" README.md --write
"$python" tests/tutorial/commands_of_page.py "$build/bin/myoid" docs/tutorial.md . --write
MYOID_PRINT_PAGES=1 bash tests/python/run_tests.sh "$build/bin/myoid" "$build/python" "$python" test_notebooks.py
if [ "${1:-}" = --figures ]; then
  "$python" docs/figures/make_figures.py "$build/bin/myoid" "$build/pictures"
  rm -rf "$build/demo"
  "$build/bin/myoid" demo --no-open --out "$build/demo"
  "$python" docs/figures/make_theory_figures.py "$build/demo/result" "$build/demo/recording"
fi

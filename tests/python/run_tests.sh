#!/usr/bin/env bash
# usage: tests/python/run_tests.sh PROGRAM FOLDER PYTHON [FILES]   Tests the package myoid in FOLDER with pytest; skipped,
# and said so, where there is none.
set -euo pipefail
export MYOID PYTHONPATH PYTHONDONTWRITEBYTECODE=1
MYOID=$(realpath "$1")
PYTHONPATH=$(realpath "$2")
python=$3
shift 3
"$python" -c 'import pytest, numpy' 2>/dev/null || { echo "skipped: $python has no pytest or no numpy"; exit 77; }
cd "$(dirname "$0")"
code=0
"$python" -m pytest -q -rs -p no:cacheprovider "$@" || code=$?
[ "$code" -ne 5 ] || exit 77  # pytest's code where every test is skipped
exit "$code"

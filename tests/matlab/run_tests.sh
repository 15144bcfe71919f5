#!/usr/bin/env bash
# usage: tests/matlab/run_tests.sh PROGRAM   Tests matlab/+myoid with Octave; skipped, and said so, where there is none.
set -euo pipefail
export MYOID; MYOID=$(realpath "$1")
cd "$(dirname "$0")"
command -v octave-cli >/dev/null || { echo "skipped: there is no octave-cli"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# The lines of the page, without the figure.
page=../../docs/guide/matlab.md
{
  echo "addpath('$PWD/../../matlab'); warning('off', 'all');"
  sed -n '/^    r = myoid.run/,/^$/p' "$page" | sed '/plot(/d; /legend(/d'
} >"$work/page.m"
[ "$(wc -l <"$work/page.m")" -ge 8 ]
octave-cli --norc --quiet --path ../../matlab --eval "cd('$PWD'); test_myoid('$work')"
cd "$work/it's here" && octave-cli --norc --quiet "$work/page.m" | grep -q 'BIC: .* N, .* to .*'
echo "docs/guide/matlab.md: its lines run"

#!/usr/bin/env bash
# usage: docs/api/make.sh [OUT]   Makes the API reference (HTML) from the headers, by default in build/api, and counts by
# room the names without a comment (all of them: OUT/warnings.txt). Any other warning is an error.
set -euo pipefail
out=$(realpath -m "${1:-$(dirname "$0")/../../build/api}")
cd "$(dirname "$0")/../.."
command -v doxygen >/dev/null || { echo "doxygen is not installed (Debian: apt install doxygen)" >&2; exit 77; }
mkdir -p "$out"
{
  cat docs/api/Doxyfile
  echo "OUTPUT_DIRECTORY = \"$out\""
  echo "WARN_LOGFILE = \"$out/warnings.txt\""
  echo "PROJECT_NUMBER = $(sed -n 's/^project(myoid VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)"
} | doxygen - >"$out/log.txt"
echo "$out/index.html"
sort -u "$out/warnings.txt" >"$out/sorted.txt"
mv "$out/sorted.txt" "$out/warnings.txt"
sed -n 's|^.*myoid/\([a-z0-9_]*\)/[a-z0-9_/]*\.h:[0-9]*: .*is not documented.*|\1|p' "$out/warnings.txt" | uniq -c |
  sort -k1,1nr -k2 | awk '{ print $2 ": " $1; all += $1 } END { print "without a comment: " all + 0 }'
! grep -v 'is not documented\.$' "$out/warnings.txt" >&2

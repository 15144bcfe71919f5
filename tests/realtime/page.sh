#!/usr/bin/env bash
# usage: tests/realtime/page.sh PROGRAM LIBRARY_FOLDER INCLUDE_FOLDER
# Compiles the lines of docs/guide/realtime.md as C and runs them on a small virtual person.
set -euo pipefail
program=$(realpath "$1") library=$(realpath "$2") include=$(realpath "$3")
page=$(cd "$(dirname "$0")" && pwd)/../../docs/guide/realtime.md
command -v cc >/dev/null || { echo "skipped: there is no cc"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
{
  printf '#include <stdio.h>\n#include "myoid.h"\nint main(void) {\n'
  sed -n '/^    char error/,/^$/p' "$page"
  printf 'myoid_workspace_free(workspace);\nmyoid_close(model);\nreturn 0;\n}\n'
} >"$work/page.c"
cc -std=c99 -Wall -Wextra -Werror -I"$include" "$work/page.c" -L"$library" -lmyoid -Wl,-rpath,"$library" -o "$work/page"
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
cd "$work"
"$program" twin --protocol p.toml --out recording --quiet >/dev/null
"$program" run recording/study.toml --out results --quiet >/dev/null || [ $? -eq 4 ]
./page | tee said
grep -q 'N m (.* to .*)' said
here=$(dirname "$page")/../../tests/realtime
cc -std=c99 -Wall -Wextra -Werror -I"$include" "$here/faults.c" -L"$library" -lmyoid -lm -Wl,-rpath,"$library" -o faults
./faults results
cc -std=c99 -Wall -Wextra -Werror -pthread -I"$include" "$here/threads.c" -L"$library" -lmyoid -Wl,-rpath,"$library" -o threads
./threads results
if command -v python3 >/dev/null; then
  python3 "$here/../../examples/realtime/with_ctypes.py" results "$library/libmyoid.so" | tee said
  grep -q 'N m (.* to .*)' said
  python3 "$here/damaged.py" "$library/libmyoid.so" results damage
fi

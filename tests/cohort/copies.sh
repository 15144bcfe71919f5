#!/usr/bin/env bash
# usage: tests/cohort/copies.sh PROGRAM COHORT COPIES OUT
# The step of the group over many results: copies (as links) of the persons of a COHORT in turn, then `cohort --group`.
# Prints time, memory and sizes; the page is OUT/report.html.
set -euo pipefail
program=$(realpath "$1") cohort=$(realpath "$2") copies=$3
mkdir -p "$4/persons"
out=$(realpath "$4")
persons=("$cohort"/persons/*)
study=$(find "$cohort" -name study.toml | head -1)
echo name,study >"$out/../persons.csv"
for i in $(seq "$copies"); do
  id=$(printf 'P%05d' "$i")
  cp -al "${persons[$((i % ${#persons[@]}))]}" "$out/persons/$id"
  echo "$id,$study" >>"$out/../persons.csv"
done
python3 - "$program" "$out" <<'PY'
import resource, subprocess, sys, time
begin = time.monotonic()
program, out = sys.argv[1:]
command = [program, "cohort", out + "/../persons.csv", "--out", out, "--group", "--quiet", "--overwrite"]
code = subprocess.call(command, stdout=subprocess.DEVNULL)
used = resource.getrusage(resource.RUSAGE_CHILDREN)
print(f"exit code {code}, {time.monotonic() - begin:.1f} s by the clock, {used.ru_utime + used.ru_stime:.1f} s of "
      f"processor, {used.ru_maxrss / 1000:.0f} MB")
PY
stat -c '%s bytes %n' "$out"/*.html "$out"/*.csv "$out"/*.json

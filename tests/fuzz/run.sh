#!/usr/bin/env bash
# tests/fuzz/run.sh [SECONDS|build] [FORMAT...]: builds the fuzz targets and runs each for so long (default
# 60 s), from the seeds and from what earlier runs found. Corpora and crashes: build/fuzz/corpus. MYOID_FUZZ_SEED
# fixes the random numbers.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
seconds="${1:-60}"
shift || true
formats=("$@")
[ "${#formats[@]}" -gt 0 ] || formats=(c3d edf trc sto orientations csv anc toml osim bids loads setup mesh markers info project)
cmake --preset fuzz >/dev/null
cmake --build build/fuzz --target fuzz_seeds "${formats[@]/#/fuzz_}" >&2
[ "$seconds" != build ] || exit 0
build/fuzz/bin/fuzz_seeds build/fuzz/seeds
failed=0
[ -n "${TMPDIR:-}" ] || [ ! -w /dev/shm ] || export TMPDIR=/dev/shm
for format in "${formats[@]}"; do
  mkdir -p "build/fuzz/corpus/$format"
  echo "== $format" >&2
  build/fuzz/bin/fuzz_"$format" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 -seed="${MYOID_FUZZ_SEED:-0}" -print_final_stats=1 \
    -artifact_prefix="build/fuzz/corpus/$format-" "build/fuzz/corpus/$format" "build/fuzz/seeds/$format" 2>&1 |
    grep -E "ERROR|SUMMARY|stat::number_of_executed_units|terminate|what\(\)" || true
  if compgen -G "build/fuzz/corpus/$format-*" >/dev/null; then failed=1; fi
done
exit "$failed"

# Sourced by run-tests --ci: every fuzz target for some seconds, from the seeds, with the build's time bounded by
# MYOID_CI_END less the time of the mutation campaign. A crash fails the run; no clang, or no time left for the build,
# is said and does not. Longer runs: tests/fuzz/run.sh
(
  cd "$MYOID_ROOT"
  seconds=10
  limit=$((MYOID_CI_END - SECONDS - 16 * seconds - MYOID_CAMPAIGN))
  if [ "$limit" -lt 60 ]; then myoid_log "fuzzing: no time left"; exit 0; fi
  if ! command -v clang++ >/dev/null; then
    myoid_log "No clang++: the readers are not fuzzed (apt-get install clang)"
    exit 0
  fi
  myoid_log "Fuzzing (build of at most $limit s, then $seconds s for each reader)"
  status=0
  timeout "$limit" tests/fuzz/run.sh build || status=$?
  if [ "$status" -eq 124 ]; then myoid_log "fuzzing: out of time while building"; exit 0; fi
  [ "$status" -eq 0 ] || { myoid_log "fuzzing: the targets do not build"; exit "$status"; }
  # From one seed: a new crash is that of a change, not of luck.
  MYOID_FUZZ_SEED=1 tests/fuzz/run.sh "$seconds" >&2 || { myoid_log "fuzzing: see build/fuzz/corpus"; exit 1; }
  myoid_log "fuzzing: passed"
)

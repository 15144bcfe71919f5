# Sourced by run-tests --ci: the tests under AddressSanitizer and UBSan, given up after a time.
# A failing test fails the run; running out of time is said and does not.
(
  cd "$MYOID_ROOT"
  myoid_log "Sanitizer build (at most 12 minutes)"
  start=$SECONDS
  cmake --preset asan >/dev/null
  status=0
  timeout 720 cmake --build build/asan >/dev/null || status=$?
  if [ "$status" -eq 124 ]; then myoid_log "sanitizers: out of time while building, not run"; exit 0; fi
  [ "$status" -eq 0 ] || { myoid_log "sanitizers: the build failed"; exit "$status"; }
  left=$((720 - (SECONDS - start)))
  [ "$left" -gt 30 ] || { myoid_log "sanitizers: built, no time left to run"; exit 0; }
  timeout "$left" ctest --test-dir build/asan -LE slow --output-on-failure -j "$(nproc)" >&2 || status=$?
  if [ "$status" -eq 124 ]; then myoid_log "sanitizers: out of time, some tests not run"; exit 0; fi
  exit "$status"
)

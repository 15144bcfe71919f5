# Sourced by run-tests --ci: the lower layers' tests (readers, numerics, laws, model, motion) under AddressSanitizer and
# UBSan. They have half of the time that is left until MYOID_CI_END, 10 minutes at most. A failing test fails the run;
# running out of time is said and does not.
(
  cd "$MYOID_ROOT"
  limit=$(((MYOID_CI_END - SECONDS) / 2))
  if [ "$limit" -gt 600 ]; then limit=600; fi
  if [ "$limit" -lt 60 ]; then myoid_log "sanitizers: no time left"; exit 0; fi
  myoid_log "Sanitizer build (at most $limit s)"
  start=$SECONDS
  cmake --preset asan >/dev/null
  for name in files tables c3d recording core math model osim signals muscle kinematics dynamics; do
    left=$((limit - (SECONDS - start)))
    if [ "$left" -lt 20 ]; then myoid_log "sanitizers: out of time before ${name}_tests"; exit 0; fi
    status=0
    timeout "$left" cmake --build build/asan --target "${name}_tests" >/dev/null || status=$?
    if [ "$status" -eq 124 ]; then myoid_log "sanitizers: out of time while building ${name}_tests"; exit 0; fi
    [ "$status" -eq 0 ] || { myoid_log "sanitizers: ${name}_tests does not build"; exit "$status"; }
    left=$((limit - (SECONDS - start)))
    [ "$left" -gt 5 ] || { myoid_log "sanitizers: no time left to run ${name}_tests"; exit 0; }
    timeout "$left" "build/asan/bin/${name}_tests" --gtest_brief=1 >&2 || status=$?
    if [ "$status" -eq 124 ]; then myoid_log "sanitizers: out of time while running ${name}_tests"; exit 0; fi
    [ "$status" -eq 0 ] || { myoid_log "sanitizers: ${name}_tests failed"; exit "$status"; }
  done
  myoid_log "sanitizers: passed"
)

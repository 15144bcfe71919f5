# Sourced by run-tests --ci: 180 s of the mutation campaign over all commands (tests/damage/campaign.py), from one seed.
# It runs bin/myoid of the preset asan if that can be built in the time that is left until MYOID_CI_END, else that of
# the release build, without sanitizers. A fault fails the run; no time left is said and does not. Longer runs:
# tests/damage/campaign.py build/asan/bin/myoid --seconds 3600
(
  cd "$MYOID_ROOT"
  seconds=$MYOID_CAMPAIGN
  if [ "$((MYOID_CI_END - SECONDS))" -lt 60 ]; then myoid_log "campaign: no time left"; exit 0; fi
  if ! command -v python3 >/dev/null; then myoid_log "No python3: no mutation campaign"; exit 0; fi
  program=build/release/bin/myoid
  limit=$((MYOID_CI_END - SECONDS - seconds))
  if [ "$limit" -ge 60 ]; then
    myoid_log "Mutation campaign (sanitizer build of at most $limit s)"
    status=0
    { cmake --preset asan && timeout "$limit" cmake --build build/asan --target myoid; } >/dev/null || status=$?
    if [ "$status" -eq 0 ]; then
      program=build/asan/bin/myoid
    elif [ "$status" -eq 124 ]; then
      myoid_log "campaign: out of time while building; the release build is used"
    else
      myoid_log "campaign: myoid does not build with sanitizers"; exit "$status"
    fi
  fi
  if [ ! -x "$program" ]; then myoid_log "campaign: there is no $program"; exit 0; fi
  left=$((MYOID_CI_END - SECONDS))
  if [ "$left" -lt "$seconds" ]; then seconds=$left; fi
  if [ "$seconds" -lt 30 ]; then myoid_log "campaign: no time left"; exit 0; fi
  myoid_log "Mutation campaign of $program ($seconds s)"
  # From one seed: a new fault is that of a change, not of luck.
  python3 tests/damage/campaign.py "$program" --seconds "$seconds" --seed 1 --keep build/campaign >&2 ||
    { myoid_log "campaign: see build/campaign"; exit 1; }
  myoid_log "campaign: passed"
)

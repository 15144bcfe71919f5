# Sourced by run-tests --ci: the mutation campaign over all commands (tests/damage/campaign.py), from one seed, with the
# release build, as far as MYOID_CAMPAIGN seconds reach. A fault fails the run; no time left is said and does not. With
# sanitizers, and longer, by hand: tests/damage/campaign.py build/asan/bin/myoid --seconds 3600
(
  cd "$MYOID_ROOT"
  seconds=$MYOID_CAMPAIGN
  if ! command -v python3 >/dev/null; then myoid_log "No python3: no mutation campaign"; exit 0; fi
  left=$((MYOID_CI_END - SECONDS))
  if [ "$left" -lt "$seconds" ]; then seconds=$left; fi
  if [ "$seconds" -lt 30 ]; then myoid_log "campaign: no time left"; exit 0; fi
  myoid_log "Mutation campaign ($seconds s)"
  # From one seed, and no more runs than are known to pass: a new fault is that of a change, not of luck.
  python3 tests/damage/campaign.py "$MYOID_BUILD/bin/myoid" --seconds "$seconds" --runs 1000 --seed 1 \
    --keep build/campaign >&2 || { myoid_log "campaign: see build/campaign"; exit 1; }
  myoid_log "campaign: passed"
)

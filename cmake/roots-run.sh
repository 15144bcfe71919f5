# Sourced by run-tests --ci: README's lines for tarball and wheel in an empty root of the oldest Debian that they serve,
# as far as MYOID_ROOTS_END reaches. A line that fails there fails the run; no root (not the user root, no archive, no
# mounts) and no time left are said and do not. By hand: packaging/roots.sh run OUT bullseye bookworm trixie
(
  cd "$MYOID_ROOT"
  suite=bullseye
  place=build/roots-run
  end=$MYOID_ROOTS_END
  if [ "$((end - SECONDS))" -lt 120 ]; then myoid_log "roots: no time left"; exit 0; fi
  within() { timeout "$((end > SECONDS ? end - SECONDS : 1))" "$@"; }
  myoid_log "README's lines in an empty root of $suite (at most $((end - SECONDS)) s)"
  within packaging/roots.sh make "$suite" >&2 || { myoid_log "roots: no empty root can be made here"; exit 0; }
  rm -rf "$place" && mkdir -p "$place"
  within packaging/tarball.sh "$MYOID_BUILD" "$place" >&2 || { myoid_log "roots: no tarball in time"; exit 0; }
  python=$(sed -n 's/^MYOID_PYTHON:[A-Z]*=//p' "$MYOID_BUILD/CMakeCache.txt")
  within "$python" -c "import sys; sys.path.insert(0, 'python'); import build_backend
build_backend.build_wheel('$place', {'build-dir': '$MYOID_BUILD'})" >&2 || { myoid_log "roots: no wheel here"; exit 0; }
  status=0
  within packaging/roots.sh run "$place" "$suite" >&2 || status=$?
  if [ "$status" -eq 124 ]; then myoid_log "roots: out of time"; exit 0; fi
  [ "$status" -eq 0 ] || { myoid_log "roots: a line of README fails in an empty root of $suite"; exit 1; }
  myoid_log "roots: passed"
)

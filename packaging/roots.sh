#!/usr/bin/env bash
# usage: packaging/roots.sh build SUITE...          builds the committed tree in an empty root of each suite, and runs it
#        packaging/roots.sh wheel FOLDER SUITE...   the same, and puts the wheel of the suite's Python into FOLDER
#        packaging/roots.sh run FOLDER SUITE...     runs the tarball and the wheels of FOLDER (release.sh) in such roots
# Suites are those of the archive: bookworm (Debian 12), trixie (13), bullseye (11). It must be root and needs
# debootstrap. The roots stay in MYOID_ROOTS (build/roots), so that a second call is quicker; DEBIAN_MIRROR names another
# archive. The last line of each suite says what was done there; the exit code is 1 if one failed.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
roots=${MYOID_ROOTS:-$root/build/roots}
mirror=${DEBIAN_MIRROR:-http://deb.debian.org/debian}
usage() { sed -n '2,4s/^# //p' "$0" >&2; exit 2; }
[ "$#" -ge 2 ] || usage
order=$1
shift
case $order in
  build) ;;
  wheel | run) [ "$#" -ge 2 ] || usage; artefacts=$(realpath "$1"); shift ;;
  *) usage ;;
esac
[ "$(id -u)" -eq 0 ] && command -v debootstrap >/dev/null ||
  { echo "an empty root is made by root with debootstrap (apt-get install debootstrap)" >&2; exit 3; }
mkdir -p "$roots"

make_root() {  # make_root SUITE
  local place=$roots/$1
  [ -e "$place/made" ] && return 0
  rm -rf "$place"
  debootstrap --variant=minbase "$1" "$place" "$mirror" >"$roots/$1.log" 2>&1 || return 1
  cp /etc/resolv.conf "$place/etc" 2>/dev/null || true
  touch "$place/made"
}

inside() {  # inside SUITE SCRIPT: the script of standard shell in the root, with /proc
  mountpoint -q "$roots/$1/proc" || mount --bind /proc "$roots/$1/proc"
  local status=0
  env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
    SOURCE_DATE_EPOCH="$(git -C "$root" log -1 --format=%ct)" \
    chroot "$roots/$1" sh -euc "$2" >>"$roots/$1.log" 2>&1 || status=$?
  umount "$roots/$1/proc"
  return "$status"
}

# The commands of README: ./run-demo, then the preset for users, whose objects the compiler cache has by then.
build_in() {
  rm -rf "$roots/$1/src/new" && mkdir -p "$roots/$1/src/new" "$roots/$1/src/myoid"
  git -C "$root" archive HEAD | tar -x -C "$roots/$1/src/new"
  # The build of an earlier call stays.
  find "$roots/$1/src/myoid" -mindepth 1 -maxdepth 1 ! -name build -exec rm -rf {} +
  cp -a "$roots/$1/src/new/." "$roots/$1/src/myoid"
  inside "$1" 'cd /src/myoid
    apt-get update -qq
    apt-get install -y -qq --no-install-recommends pybind11-dev python3-dev python3-numpy
    ./run-demo
    [ -s build/demo/result/report.html ]
    [ -d build/sundials/usr ] && export CMAKE_PREFIX_PATH=$PWD/build/sundials/usr
    cmake --preset user
    cmake --build --preset user
    PYTHONPATH=build/user/python python3 -c "import myoid; myoid.run(\"build/demo/recording/study.toml\")"
    build/user/bin/myoid --version >/tmp/version' || return 1
  echo "built by ./run-demo and by the preset user; the demo ran, in Python too: myoid $(cat "$roots/$1/tmp/version")"
}

wheel_in() {
  build_in "$1" >/dev/null || return 1
  inside "$1" 'cd /src/myoid && rm -rf /tmp/wheels && mkdir /tmp/wheels
    python3 -c "import sys; sys.path.insert(0, \"python\"); import build_backend
build_backend.build_wheel(\"/tmp/wheels\", {\"build-dir\": \"build/user\"})"' || return 1
  cp "$roots/$1"/tmp/wheels/*.whl "$artefacts"
  echo "wheel: $(basename "$roots/$1"/tmp/wheels/*.whl)"
}

# The tarball's program, then each wheel that this Python takes.
run_in() {
  rm -rf "$roots/$1/tmp/artefacts" && mkdir -p "$roots/$1/tmp/artefacts"
  cp "$artefacts"/*.tar.gz "$artefacts"/*.whl "$roots/$1/tmp/artefacts"
  inside "$1" 'cd /tmp/artefacts
    tar -xzf myoid-*-$(uname -m).tar.gz
    ./myoid-*-$(uname -m)/bin/myoid demo --no-open --overwrite --out /tmp/demo_of_tarball
    [ -s /tmp/demo_of_tarball/result/report.html ]
    apt-get update -qq
    apt-get install -y -qq --no-install-recommends python3-venv python3-numpy
    rm -rf /tmp/env && python3 -m venv --system-site-packages /tmp/env
    python3 -c "import sys; print(\"cp%d%d\" % sys.version_info[:2])" >/tmp/python
    rm -f /tmp/wheel && for wheel in myoid-*-$(cat /tmp/python)-*.whl; do
      [ -e "$wheel" ] || continue
      /tmp/env/bin/pip install --no-deps --no-index "$wheel"
      /tmp/env/bin/myoid demo --no-open --overwrite --out /tmp/demo_of_wheel
      /tmp/env/bin/python -c "import myoid; myoid.run(\"/tmp/demo_of_wheel/recording/study.toml\")"
      echo "$wheel" >/tmp/wheel
    done' || return 1
  local wheel
  if wheel=$(cat "$roots/$1/tmp/wheel" 2>/dev/null); then
    echo "the demo ran from the tarball and from $wheel, in Python too"
  else
    echo "the demo ran from the tarball; no wheel for its Python ($(cat "$roots/$1/tmp/python"))"
  fi
}

# (`set -e` does not hold in a function whose result is tested: each step that may fail returns by itself.)
status=0
for suite in "$@"; do
  if make_root "$suite" && said=$("${order}_in" "$suite"); then
    echo "$suite: $said"
  else
    tail -20 "$roots/$suite.log" | sed 's/^/    /' >&2
    echo "$suite: failed, see $roots/$suite.log"
    status=1
  fi
done
exit "$status"

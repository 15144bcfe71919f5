#!/usr/bin/env bash
# usage: packaging/deb.sh OUT [--twice]
# Builds the Debian packages of the committed tree into OUT. --twice: builds again and compares every byte. The time
# of the changelog (SOURCE_DATE_EPOCH) is the time of every file, unless the environment states another.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
mkdir -p "$1"
out=$(realpath "$1")
command -v dpkg-buildpackage >/dev/null && command -v dh >/dev/null ||
  { echo "Please install: apt-get install debhelper dh-python dpkg-dev fakeroot" >&2; exit 3; }
commit=$(git -C "$root" rev-parse HEAD)  # of both builds
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

build() {  # build FOLDER: the same place each time, another time of day
  rm -rf "$work/build" && mkdir -p "$work/build/myoid" "$1"
  git -C "$root" archive "$commit" | tar -x -C "$work/build/myoid"
  # ccache finds the objects of an earlier call, whose folder has another name.
  (cd "$work/build/myoid" && CCACHE_DIR=${CCACHE_DIR:-$HOME/.cache/ccache} CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1 \
    DEB_BUILD_OPTIONS="parallel=$(nproc) noautodbgsym ${DEB_BUILD_OPTIONS:-}" dpkg-buildpackage -b -us -uc) \
    >"$1/build.log" 2>&1 || { tail -20 "$1/build.log" >&2; exit 1; }
  mv "$work"/build/*.deb "$work"/build/*.changes "$1"
}

build "$out"
ls -l "$out"/*.deb
if [ "${2:-}" = --twice ]; then
  build "$work/second"
  for file in "$out"/*.deb; do cmp "$file" "$work/second/$(basename "$file")"; done
  echo "built twice: the same bytes"
fi
if command -v lintian >/dev/null; then
  # Root builds in containers too.
  lintian --allow-root --fail-on error,warning "$out"/*.deb && echo "lintian finds nothing"
else
  echo "lintian: skipped, not installed"
fi

#!/usr/bin/env bash
# usage: packaging/deb.sh OUT [--twice]
# Builds the Debian packages of the committed tree into OUT, looks for the compiler's protections in every program and
# library, and asks lintian. --twice: compiles everything again in another folder and time zone, without the compiler's
# cache, and compares every byte. The time of the changelog (SOURCE_DATE_EPOCH) is the time of every file, unless the
# environment states another.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
mkdir -p "$1"
out=$(realpath "$1")
command -v dpkg-buildpackage >/dev/null && command -v dh >/dev/null ||
  { echo "Please install: apt-get install debhelper dh-python dpkg-dev fakeroot" >&2; exit 3; }
commit=$(git -C "$root" rev-parse HEAD)  # of both builds
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

build() {  # build FOLDER PLACE: the tree lies in PLACE
  local place=$work/$2
  mkdir -p "$place/myoid" "$1"
  git -C "$root" archive "$commit" | tar -x -C "$place/myoid"
  # ccache finds the objects of an earlier call, whose folder has another name.
  (cd "$place/myoid" && CCACHE_DIR=${CCACHE_DIR:-$HOME/.cache/ccache} CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1 \
    DEB_BUILD_OPTIONS="parallel=$(nproc) noautodbgsym ${DEB_BUILD_OPTIONS:-}" dpkg-buildpackage -b -us -uc) \
    >"$1/build.log" 2>&1 || { tail -20 "$1/build.log" >&2; exit 1; }
  mv "$place"/*.deb "$place"/*.changes "$1"
  rm -rf "$place"
}

# Position-independent code, read-only relocations that are bound at the start, and guards of the stack; the program
# calls checked functions of the C library, too.
check_protections() {
  local file count=0
  for file in "$out"/*.deb; do dpkg-deb -x "$file" "$work/unpacked"; done
  while read -r file; do
    [ "$(head -c 4 "$file" | tail -c 3)" = ELF ] || continue
    count=$((count + 1))
    readelf -hldW --dyn-syms "$file" >"$work/elf"
    for sign in 'Type: *DYN' GNU_RELRO 'Flags:.* NOW' __stack_chk_fail; do
      grep -q "$sign" "$work/elf" || { echo "$(basename "$file") has no $sign" >&2; return 1; }
    done
    case $file in
      */bin/myoid) grep -q '_chk@GLIBC' "$work/elf" || { echo "the program calls no checked function" >&2; return 1; } ;;
    esac
  done < <(find "$work/unpacked" -type f \( -perm -u=x -o -name '*.so*' \) ! -name '*.a')
  [ "$count" -gt 0 ] || { echo "the packages hold no program" >&2; return 1; }
  echo "protected: $count programs and libraries"
}

build "$out" build
(cd "$out" && sha256sum ./*.deb)
check_protections
if [ "${2:-}" = --twice ]; then
  CCACHE_DISABLE=1 TZ=Pacific/Kiritimati build "$work/second" another-folder
  for file in "$out"/*.deb; do cmp "$file" "$work/second/$(basename "$file")"; done
  echo "built twice: the same bytes"
fi
if command -v lintian >/dev/null; then
  # Root builds in containers too.
  lintian --allow-root --fail-on error,warning "$out"/*.deb && echo "lintian finds nothing"
else
  echo "lintian: skipped, not installed"
fi

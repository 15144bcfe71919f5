#!/usr/bin/env bash
# usage: packaging/release.sh OUT [--build-dir TREE] [--without deb,site,recordings]
# Makes everything of a release of the committed tree, whose version CMakeLists.txt states:
#
#   myoid-VERSION.tar.gz                  sources
#   myoid-VERSION-ARCH.tar.gz             the program with all its libraries (tarball.sh)
#   myoid-VERSION-py3-none-...whl         the wheel of all Pythons whose headers can be fetched (python-headers.sh)
#   *.deb                                 Debian's packages, built twice (deb.sh)
#   myoid-recordings-VERSION.tar.gz       the public recordings of tutorial and examples, where they are at hand
#   myoid-site-VERSION.tar.gz             the documentation as pages (docs/site/make.sh)
#   release-notes.md                      the entry of CHANGELOG.md, and what each file needs
#   SHA256SUMS
#
# Program and wheel are those of the preset user, or of a TREE that is built already ("build/release" after
# ./run-tests). An artefact that cannot be made here is named on the last lines, and in
# release-notes.md. Exit code 1: one is missing that --without does not name.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
usage() { sed -n '2s/^# //p' "$0" >&2; exit 2; }
[ "$#" -ge 1 ] || usage
mkdir -p "$1"
out=$(realpath "$1")
shift
without="" tree=""
while [ "$#" -gt 0 ]; do
  case $1 in
    --without) without=,${2:-},; shift 2 ;;
    --build-dir) tree=${2:-}; shift 2 ;;
    *) usage ;;
  esac
done
cd "$root"
version=$(sed -n 's/^project(myoid VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
[ -z "$(git status --porcelain --untracked-files=no)" ] ||
  { echo "files differ from the last commit; a release is made of a commit" >&2; exit 1; }
[ -z "$(ls -A "$out")" ] || { echo "$out is not empty; name a new folder" >&2; exit 1; }
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
export SOURCE_DATE_EPOCH
missing=()
wanted() {  # wanted NAME: false, and remembered, for what --without names
  case $without in *,"$1",*) missing+=("$1: left out by --without"); return 1 ;; esac
}
say() { echo "release: $*"; }

say "sources"
/usr/bin/env python3 -c "
import sys
sys.path.insert(0, 'python')
import build_backend
build_backend.build_sdist(sys.argv[1])" "$out"

say "program"
if [ -z "$tree" ]; then
  tree=build/user
  . cmake/setup.sh
  myoid_unpack_sundials
  cmake --preset user >/dev/null
fi
cmake --build "$tree" --target myoid
packaging/tarball.sh "$tree" "$out"

say "wheel"
wheel="import sys; sys.path.insert(0, 'python'); import build_backend
build_backend.build_wheel(sys.argv[1], {'build-dir': sys.argv[2], 'python-headers': sys.argv[3]})"
headers=build/python-headers
packaging/python-headers.sh "$headers" || { missing+=("the wheel's modules of other Pythons"); headers=""; }
python=$(sed -n 's/^MYOID_PYTHON:[A-Z]*=//p' "$tree/CMakeCache.txt")
"$python" -c "$wheel" "$out" "$tree" "$headers" >/dev/null || missing+=("wheel: needs python3-dev, pybind11-dev")

if wanted deb; then
  say "Debian's packages, twice"
  packaging/deb.sh "$out" --twice || missing+=("deb: see $out/build.log")
  rm -f "$out/build.log"
fi
if wanted recordings; then
  say "recordings"
  examples/get_data --pack "$out/myoid-recordings-$version.tar.gz" ||
    { missing+=("recordings: not all at hand (examples/get_data --check)"); rm -f "$out"/myoid-recordings-*; }
fi
if wanted site; then
  say "site"
  if docs/site/make.sh build/site; then
    tar -C build --sort=name --owner=0 --group=0 --numeric-owner --mtime="@$SOURCE_DATE_EPOCH" \
      --transform "s,^site,myoid-site-$version," -c site | gzip -n9 >"$out/myoid-site-$version.tar.gz"
  else
    missing+=("site: needs the packages that docs/site/make.sh names")
  fi
fi

say "notes and checksums"
modules_of() {  # modules_of WHEEL: the Pythons that it has a module for
  python3 -m zipfile -l "$out/$1" | sed -n 's/.*_native\.cpython-3\([0-9]*\)-.*/3.\1/p' | sort -V | tr '\n' ' '
}
needs() {  # needs FILE: one line on what a user needs for it
  case $1 in
    *.whl) echo "Python 3.9 or newer; its module also one of: $(modules_of "$1")" ;;
    *.deb) echo "Debian $(. /etc/os-release && echo "$VERSION_ID")" ;;
    *-"$(uname -m)".tar.gz) echo "Linux, $(uname -m)" ;;
    *-recordings-*) echo "examples/get_data --from" ;;
    *-site-*) echo "a browser" ;;
    *) echo "a compiler (docs/guide/packages.md)" ;;
  esac
}
{
  echo "# Myoid $version"
  echo
  date -u -d "@$SOURCE_DATE_EPOCH" "+%Y-%m-%d, commit $(git rev-parse --short=12 HEAD)"
  echo
  awk '/^## / { if (seen++) exit; next } seen' CHANGELOG.md | sed '1{/^$/d}'
  echo
  echo "| file | bytes | needs |"
  echo "| --- | --- | --- |"
  (cd "$out" && for file in *; do
    [ "$file" = release-notes.md ] || echo "| $file | $(stat -c %s "$file") | $(needs "$file") |"
  done)
  for each in ${missing[@]+"${missing[@]}"}; do printf '\nNot made: %s\n' "$each"; done
} >"$out/release-notes.md"
(cd "$out" && sha256sum -- $(ls | grep -v SHA256SUMS) >SHA256SUMS && sha256sum --quiet -c SHA256SUMS)
cat "$out/SHA256SUMS"
for each in ${missing[@]+"${missing[@]}"}; do echo "not made: $each"; done
for each in ${missing[@]+"${missing[@]}"}; do [[ $each == *"left out by --without" ]] || exit 1; done

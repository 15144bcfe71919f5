#!/usr/bin/env bash
# usage: tests/packages/tarball.sh BUILD   Packs the program of a build twice: the same bytes, every library in the archive
# (the C library too), with its licences, and a program that runs from another place by a link.
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
command -v dpkg-query >/dev/null || { echo "skipped: no dpkg, which names the libraries' licences"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$root/packaging/tarball.sh" "$1" "$work/one" >/dev/null
"$root/packaging/tarball.sh" "$1" "$work/two" >/dev/null
cmp "$work"/one/*.tar.gz "$work"/two/*.tar.gz
mkdir "$work/place" && tar -xzf "$work"/one/*.tar.gz -C "$work/place"
place=$(echo "$work"/place/*)
ln -s "$place/bin/myoid" "$work/myoid"
version=$(env -i PATH=/usr/bin:/bin "$work/myoid" --version)
[ "$version" = "$("$1/bin/myoid" --version)" ]
loader=$(echo "$place"/lib/ld-linux*)
outside=$("$loader" --library-path "$place/lib" --list "$place/lib/myoid" | grep -o '/[^ ]*' | grep -v -e "^$place/" -e /ld-linux || true)
[ -z "$outside" ] || { echo "libraries that are not in the archive: $outside"; exit 1; }
for library in "$place"/lib/*.so*; do
  grep -q "^$(basename "$library"): package .*, source " "$place/share/doc/libraries/packages.txt"
done
for file in LICENSE NOTICE licenses.txt share/doc/libraries/LGPL-2.1 examples/get_data share/man1/myoid.1; do
  [ -s "$place/$file" ] || { echo "$file is not in the archive"; exit 1; }
done
links=0
while IFS=: read -r page link; do  # relative links of all pages, without the place on the page
  links=$((links + 1))
  [ -e "$(dirname "$page")/$link" ] || { echo "${page#"$place"/} links to $link, which is not in the archive"; exit 1; }
done < <(cd "$place" && grep -roPH --include='*.md' '\]\(\K(?![a-z]+:|#)[^)\s#]+' "$place")
[ "$links" -gt 300 ] || { echo "$links links were found, expected hundreds"; exit 1; }
echo "the tarball: passed"

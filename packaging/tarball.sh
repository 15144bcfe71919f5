#!/usr/bin/env bash
# usage: packaging/tarball.sh BUILD OUT
# Packs the program of a build (release, user) with every shared library, the C library and its loader too, for all Linux
# systems of this processor, older ones too: OUT/myoid-VERSION-ARCH.tar.gz, the same bytes for the same build.
set -euo pipefail
build=$(realpath "$1")
mkdir -p "$2"
out=$(realpath "$2")
root=$(cd "$(dirname "$0")/.." && pwd)
version=$("$build/bin/myoid" --version)
name=myoid-$version-$(uname -m)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/$name/bin" "$work/$name/lib" "$work/$name/share/doc/libraries"
install -s "$build/bin/myoid" "$work/$name/lib/myoid"
ldd "$build/bin/myoid" | grep -o '/[^ ]*' | sort >"$work/libraries"
loader=$(basename "$(grep -E '/ld-linux[^/]*$' "$work/libraries")")
owner_of() {  # owner_of FILE: its package. /lib is /usr/lib, and the package may list either.
  local file
  file=$(realpath "$1")
  { dpkg-query -S "$file" || dpkg-query -S "${file#/usr}"; } 2>/dev/null | head -1 | cut -d: -f1 | grep .
}
# Debian's libraries as they are, each with the package and version whose source Debian keeps, and its licences.
while read -r library; do
  cp -L "$library" "$work/$name/lib/"
  package=$(owner_of "$library") ||
    { echo "$library belongs to no package of Debian: its licence is not known" >&2; exit 1; }
  cp -L "/usr/share/doc/$package/copyright" "$work/$name/share/doc/libraries/$package.copyright"
  echo "$(basename "$library"): package $(dpkg-query -W -f='${Package} ${Version}, source ${source:Package} ${source:Version}' "$package")"
done <"$work/libraries" >"$work/$name/share/doc/libraries/packages.txt"
cp -L /usr/share/common-licenses/{LGPL-2.1,GPL-3,GPL-2,Apache-2.0} "$work/$name/share/doc/libraries/"
cat >"$work/$name/bin/myoid" <<SH
#!/bin/sh
# Starts the program with the loader and the libraries beside it.
here=\$(CDPATH= cd -- "\$(dirname -- "\$(readlink -f -- "\$0")")/.." && pwd)
exec "\$here/lib/$loader" --library-path "\$here/lib" "\$here/lib/myoid" "\$@"
SH
chmod 755 "$work/$name/bin/myoid" "$work/$name/lib/$loader"
"$build/bin/myoid" help-files "$work/$name/share"
# The pages with all to which they link, so that every link leads to a file.
(cd "$root" && cp -r --parents examples docs matlab cmake/layers.cmake .github/ISSUE_TEMPLATE LICENSE NOTICE licenses.txt \
  README.md CHANGELOG.md CONTRIBUTING.md SECURITY.md CITATION.cff "$work/$name/")
find "$work/$name" -name __pycache__ -prune -exec rm -rf {} +
epoch=${SOURCE_DATE_EPOCH:-$(git -C "$root" log -1 --format=%ct)}
tar -C "$work" --sort=name --owner=0 --group=0 --numeric-owner --mode=go=rX,u+rw --mtime="@$epoch" -c "$name" |
  gzip -n9 >"$out/$name.tar.gz"
env -i PATH=/usr/bin:/bin "$work/$name/bin/myoid" --version >/dev/null
ls -l "$out/$name.tar.gz"

#!/usr/bin/env bash
# usage: packaging/tarball.sh BUILD OUT
# Packs the program of a build (release) with every shared library but the C library's, for other Linux systems with a
# C library of this or a newer version: OUT/myoid-VERSION-ARCH.tar.gz, the same bytes for the same build.
set -euo pipefail
build=$(realpath "$1")
mkdir -p "$2"
out=$(realpath "$2")
root=$(cd "$(dirname "$0")/.." && pwd)
version=$("$build/bin/myoid" --version)
name=myoid-$version-$(uname -m)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/$name/bin" "$work/$name/lib" "$work/$name/share"
install -s "$build/bin/myoid" "$work/$name/lib/myoid"
ldd "$build/bin/myoid" | awk '/=> \// { print $3 }' | grep -vE '/(libc|libm|libpthread|libdl|librt)\.so' |
  while read -r library; do cp -L "$library" "$work/$name/lib/"; done
cat >"$work/$name/bin/myoid" <<'SH'
#!/bin/sh
# Starts the program with the libraries beside it.
here=$(CDPATH= cd -- "$(dirname -- "$(readlink -f -- "$0")")/.." && pwd)
LD_LIBRARY_PATH="$here/lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}" exec "$here/lib/myoid" "$@"
SH
chmod 755 "$work/$name/bin/myoid"
"$build/bin/myoid" help-files "$work/$name/share"
cp -r "$root/examples" "$root/LICENSE" "$root/NOTICE" "$root/licenses.txt" "$root/README.md" "$work/$name/"
epoch=${SOURCE_DATE_EPOCH:-$(git -C "$root" log -1 --format=%ct)}
tar -C "$work" --sort=name --owner=0 --group=0 --numeric-owner --mtime="@$epoch" -c "$name" | gzip -n9 >"$out/$name.tar.gz"
env -i PATH=/usr/bin:/bin "$work/$name/bin/myoid" --version >/dev/null
ls -l "$out/$name.tar.gz"

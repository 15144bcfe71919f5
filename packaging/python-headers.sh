#!/usr/bin/env bash
# usage: packaging/python-headers.sh FOLDER
# Fetches the headers of the Pythons of Debian 11, 12 and 13 and those of a pybind11 for all of them, Debian 11's C and
# C++ libraries (old/) and the sources of this system's TBB (tbb/), by apt, and unpacks them in FOLDER. Nothing is
# installed. With them one wheel serves all these Pythons, and its modules run where libraries are as old as those:
#   pip wheel . --no-build-isolation --no-deps --config-settings python-headers=FOLDER
# DEBIAN_MIRROR names another archive.
set -euo pipefail
[ "$#" -eq 1 ] || { sed -n '2s/^# //p' "$0" >&2; exit 2; }
mkdir -p "$1"
out=$(realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/lists/partial" "$work/archives/partial"
archive="[signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] ${DEBIAN_MIRROR:-http://deb.debian.org/debian}"
for suite in bullseye bookworm trixie; do
  echo "deb $archive $suite main"
done >"$work/sources.list"
own=$(. /etc/os-release && echo "$VERSION_CODENAME")
echo "deb-src $archive $own main" >>"$work/sources.list"
fetch() {  # apt of these sources alone
  apt-get -qq -o Dir::Etc::SourceList="$work/sources.list" -o Dir::Etc::SourceParts=/dev/null \
    -o Dir::State::Lists="$work/lists" -o Dir::Cache="$work" -o APT::Sandbox::User=root "$@"
}
fetch update
cd "$work"
fetch download libpython3.9-dev/bullseye libpython3.11-dev/bookworm libpython3.13-dev/trixie pybind11-dev/trixie
rm -rf "$out/usr" "$out/old" "$out/tbb"
for package in ./*.deb; do dpkg-deb -x "$package" "$work/unpacked"; done
mkdir -p "$out/usr/include" "$out/old" "$out/tbb"
cp -a "$work"/unpacked/usr/include/. "$out/usr/include"
mkdir old && cd old
fetch download libc6/bullseye libc6-dev/bullseye libgcc-s1/bullseye libstdc++6/bullseye
for package in ./*.deb; do dpkg-deb -x "$package" "$out/old"; done
cd "$work"
fetch source --download-only "onetbb=$(dpkg-query -W -f='${source:Version}' libtbb-dev)"
tar -xf onetbb_*.orig.tar.* -C "$out/tbb" --strip-components=1
libc=$(sed -n 's/^#define\t__GLIBC_MINOR__\t//p' "$out/old/usr/include/features.h")
echo "$out: $(cd "$out/usr/include" && ls -d python3.* | tr '\n' ' ')pybind11, libraries of glibc 2.$libc, TBB"

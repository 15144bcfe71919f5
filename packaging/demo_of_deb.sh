#!/usr/bin/env bash
# usage: packaging/demo_of_deb.sh PACKAGES
# Installs `myoid` of a folder into an empty Debian root (debootstrap; it must be root, and reach an archive) and runs
# the demo there, then `python3-myoid` and the demo in Python. Where that cannot be done, the packages are unpacked into
# an empty folder, and the script says so.
set -euo pipefail
packages=$(realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
unset TMPDIR  # the empty root may not have this folder
if [ "$(id -u)" -eq 0 ] && command -v debootstrap >/dev/null &&
  debootstrap --variant=minbase bookworm "$work/root" "${DEBIAN_MIRROR:-http://deb.debian.org/debian}" >"$work/log" 2>&1; then
  cp "$packages"/*.deb "$work/root/tmp"
  cp /etc/resolv.conf "$work/root/etc" 2>/dev/null || true
  [ -d /etc/apt/apt.conf.d ] && cp -n /etc/apt/apt.conf.d/* "$work/root/etc/apt/apt.conf.d" 2>/dev/null || true
  # The demo needs the examples, which a minimal root would leave out.
  chroot "$work/root" sh -c 'rm -f /etc/dpkg/dpkg.cfg.d/*doc* && apt-get update -qq &&
    apt-get install -y -qq --no-install-recommends /tmp/myoid_*.deb' >>"$work/log" 2>&1 ||
    { tail -20 "$work/log"; exit 1; }
  cp "$(dirname "$0")/../debian/tests/demo" "$work/root/tmp/demo"
  chroot "$work/root" sh /tmp/demo
  echo "in an empty Debian root with $(chroot "$work/root" dpkg -l | grep -c '^ii') packages"
  chroot "$work/root" sh -c 'apt-get install -y -qq --no-install-recommends /tmp/python3-myoid_*.deb' >>"$work/log" 2>&1 ||
    { tail -20 "$work/log"; exit 1; }
  cp "$(dirname "$0")/../debian/tests/python" "$work/root/tmp/python"
  chroot "$work/root" sh /tmp/python
else
  echo "no empty Debian root can be made here (debootstrap as root, with an archive): unpacked into a folder instead"
  tail -3 "$work/log" 2>/dev/null || true
  for deb in "$packages"/*.deb; do dpkg -x "$deb" "$work/prefix"; done
  sed "s#/usr/share/doc#$work/prefix/usr/share/doc#" "$(dirname "$0")/../debian/tests/demo" >"$work/demo"
  AUTOPKGTEST_TMP=$work PATH="$work/prefix/usr/bin:$PATH" sh "$work/demo"
fi

#!/usr/bin/env bash
# usage: packaging/roots.sh build SUITE...          builds the committed tree in an empty root of each suite, and runs it
#        packaging/roots.sh run FOLDER SUITE...     runs README's lines for tarball and wheel of FOLDER (release.sh) as
#                                                   printed in such roots, pipx and the module of Python, too
#        packaging/roots.sh make SUITE...           makes the roots
#        packaging/roots.sh deb FOLDER SUITE...     builds Debian's packages there twice (deb.sh), into FOLDER
#        packaging/roots.sh syntax SUITE...         reads all sources by compiler and headers of the suite (syntax.sh)
# Suites are those of the archive: bookworm (Debian 12), trixie (13), bullseye (11); jammy (Ubuntu 22.04), noble (24.04),
# plucky (25.04). It must be root and needs debootstrap. The roots stay in MYOID_ROOTS (build/roots), so that a second
# call is quicker; DEBIAN_MIRROR and UBUNTU_MIRROR name other archives. The last line of each suite says what was done
# there; the exit code is 1 if one failed.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
roots=${MYOID_ROOTS:-$root/build/roots}
debian=${DEBIAN_MIRROR:-http://deb.debian.org/debian}
ubuntu=${UBUNTU_MIRROR:-http://archive.ubuntu.com/ubuntu}
usage() { sed -n '2,8s/^# //p' "$0" >&2; exit 2; }
[ "$#" -ge 2 ] || usage
order=$1
shift
case $order in
  build | make | syntax) ;;
  run | deb) [ "$#" -ge 2 ] || usage; artefacts=$(realpath "$1"); shift ;;
  *) usage ;;
esac
[ "$(id -u)" -eq 0 ] && command -v debootstrap >/dev/null ||
  { echo "an empty root is made by root with debootstrap (apt-get install debootstrap)" >&2; exit 3; }
mkdir -p "$roots"

make_root() {  # make_root SUITE
  local place=$roots/$1
  [ -e "$place/made" ] && return 0
  rm -rf "$place"
  case $1 in
    # An old debootstrap knows no new suite; its script of all Ubuntus has the name of the first.
    jammy | noble | plucky) set -- "$1" --components=main,universe "$ubuntu" gutsy ;;
    *) set -- "$1" --components=main "$debian" "" ;;
  esac
  debootstrap --variant=minbase "$2" "$1" "$place" "$3" ${4:+"$4"} >"$roots/$1.log" 2>&1 || return 1
  cp /etc/resolv.conf "$place/etc" 2>/dev/null || true
  # What a system with Python has: the wheel's line begins with a virtual environment.
  inside "$1" 'apt-get update -qq
    apt-get install -y -qq --no-install-recommends python3-venv python3-numpy' || return 1
  touch "$place/made"
}

# The mount goes with the process, however that ends: nothing of this system lies in a root that somebody removes.
inside() {  # inside SUITE SCRIPT: the script of standard shell in the root, with /proc
  env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
    SOURCE_DATE_EPOCH="$(git -C "$root" log -1 --format=%ct)" \
    unshare --mount sh -euc 'mount --bind /proc "$0/proc" && exec chroot "$0" sh -euc "$1"' "$roots/$1" "$2" \
    >>"$roots/$1.log" 2>&1
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

# The lines of README that install a file of the release, in an empty folder each. An empty root need not reach Python's
# archive: NumPy is Debian's, packed as a wheel; Debian 11's is older than the wheel asks for, and is used as it is.
run_in() {
  local place=$roots/$1/tmp/release
  rm -rf "$place" && mkdir -p "$place/tarball" "$place/wheel" "$place/links"
  cp "$artefacts"/myoid-*-"$(uname -m)".tar.gz "$place/tarball"
  cp "$artefacts"/myoid-*.whl "$place/wheel"
  readme_line '^tar ' >"$place/tarball/line"
  readme_line '^python3 ' >"$place/wheel/line"
  readme_line 'pipx install' | sed 's/^`\([^`]*\)`.*/\1/' >"$place/wheel/pipx-line"
  cat >"$place/pack_numpy.py" <<'END'
import pathlib, sys, zipfile, numpy
if tuple(map(int, numpy.__version__.split(".")[:2])) < (1, 24): sys.exit()
info, place = f"numpy-{numpy.__version__}.dist-info", pathlib.Path(numpy.__file__).parent
files = {f"{info}/METADATA": f"Metadata-Version: 2.1\nName: numpy\nVersion: {numpy.__version__}\n",
         f"{info}/WHEEL": "Wheel-Version: 1.0\nGenerator: roots.sh\nRoot-Is-Purelib: true\nTag: py3-none-any\n"}
with zipfile.ZipFile(f"links/numpy-{numpy.__version__}-py3-none-any.whl", "w") as wheel:
    names = [f for f in place.rglob("*") if f.is_file() and "tests" not in f.parts and f.suffix != ".pyc"]
    for file in names: wheel.write(file, file.relative_to(place.parent))
    for name, text in files.items(): wheel.writestr(name, text)
    listed = [str(f.relative_to(place.parent)) for f in names] + list(files) + [f"{info}/RECORD"]
    wheel.writestr(f"{info}/RECORD", "".join(f"{name},,\n" for name in listed))
END
  cat >"$place/module.py" <<'END'
import sys, warnings
try:
    import myoid
    warnings.simplefilter("ignore")
    r = myoid.run("myoid-demo/recording/study.toml")
    print(len(r.parameters), "numbers in Python %d.%d" % sys.version_info[:2])
except ImportError as error:
    print("ImportError:", str(error).split("(")[0] + "..." + str(error).split(")")[-1])
END
  inside "$1" 'cd /tmp/release/tarball
    sh -eux ./line >../said
    tail -n 1 ../said >../lines
    cd .. && python3 pack_numpy.py && cd wheel
    export PIP_NO_INDEX=1 PIP_FIND_LINKS="/tmp/release/links /usr/share/python-wheels" USE_EMOJI=0
    ls ../links/*.whl || { export PIP_NO_DEPS=1; older=/usr/lib/python3/dist-packages; }
    sh -eux ./line >../said
    tail -n 1 ../said >>../lines
    PYTHONPATH=${older:-} env/bin/python ../module.py >>../lines
    if apt-get install -y -qq --no-install-recommends pipx; then
      rm -rf /root/.local myoid-demo
      sh -eux ./pipx-line
      /root/.local/bin/myoid --version >>../lines
    else
      echo "not in this suite" >>../lines
    fi' || return 1
  printf '\n'
  paste -d ' ' <(printf '    %s\n' tarball: wheel: module: pipx:) "$place/lines"
}

make_in() { echo "an empty root is there"; }

# Headers are unpacked beside the compiler: the packages that they are in need hundreds of others to be installed. Where
# the suite has no toml++, which is headers alone, those of this system serve.
syntax_in() {
  rm -rf "$roots/$1/src/syntax" && mkdir -p "$roots/$1/src/syntax" "$roots/$1/tmp/toml"
  git -C "$root" archive HEAD | tar -x -C "$roots/$1/src/syntax"
  cp -rL /usr/include/toml++ "$roots/$1/tmp/toml" || return 1
  inside "$1" 'cd /src/syntax
    apt-get update -qq
    apt-get install -y -qq --no-install-recommends g++
    mkdir -p /headers/packages && cd /headers/packages
    mkdir -p /headers/usr/include && cp -r /tmp/toml/. /headers/usr/include
    apt-get download -qq libtomlplusplus-dev || echo "no toml++ in this suite"
    apt-get download -qq libeigen3-dev libfmt-dev libpugixml-dev nlohmann-json3-dev libcli11-dev libtbb-dev \
      libssl-dev libceres-dev libsundials-dev $(apt-cache depends libboost-dev | sed -n "s/.*Depends: //p")
    for package in ./*.deb; do dpkg-deb -x "$package" /headers; done
    cd /src/syntax && packaging/syntax.sh /headers >/tmp/said' || { cat "$roots/$1/tmp/said" >&2; return 1; }
  tail -n 1 "$roots/$1/tmp/said"
}

readme_line() { sed -n '/^## Get it/,/^## /s/^ *//p' "$root/README.md" | grep -e "$1" | head -n 1; }

deb_in() {
  rm -rf "$roots/$1/src/deb" "$roots/$1/tmp/deb" && mkdir -p "$roots/$1/src"
  git clone -q --no-hardlinks "$root" "$roots/$1/src/deb" || return 1
  inside "$1" 'cd /src/deb
    apt-get update -qq
    apt-get install -y -qq --no-install-recommends ca-certificates ccache debhelper dh-python dpkg-dev fakeroot git \
      lintian
    apt-get build-dep -y -qq --no-install-recommends ./
    git config --global --replace-all safe.directory /src/deb
    packaging/deb.sh /tmp/deb --twice >/tmp/said' || return 1
  cp "$roots/$1"/tmp/deb/*.deb "$artefacts"
  printf '\n'
  sed 's/^/    /' "$roots/$1/tmp/said"
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

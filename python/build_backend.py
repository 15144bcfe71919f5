"""Makes the wheel and the source distribution of the module (PEP 517), with Python's own library and CMake.

    pip wheel . --no-build-isolation --no-deps
    pip wheel . --no-build-isolation --no-deps --config-settings build-dir=build/release
    pip wheel . --no-build-isolation --no-deps --config-settings python-headers=FOLDER

The first builds in build/wheel, the second links what that tree has compiled, the third adds a module for each Python
whose headers are in the folder (packaging/python-headers.sh). The wheel holds the program, the modules and every shared
library that they need. The C and C++ libraries in it serve the program alone, where the system's C library is older than
its own: any Linux runs the program, while a module asks its process for them. The same tree gives the same bytes.
"""

from __future__ import annotations

import base64
import gzip
import hashlib
import io
import os
import platform
import re
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import time
import tomllib
import zipfile
from collections.abc import Mapping
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
# The system's libraries, of which a module uses those of its process.
SYSTEM = re.compile(r"(libc|libm|libpthread|libdl|librt|libstdc\+\+|libgcc_s|linux-vdso|ld-linux[-\w]*)\.so")
# Starts the program; where the C library is too old for it, with the one in the wheel.
STARTER = """#!python
import importlib.util
import os
import platform
import sys

package = os.path.dirname(importlib.util.find_spec("myoid").origin)
program = os.path.join(package, "bin", "myoid")
libraries = package + ".libs"
command = [program]
name, number = platform.libc_ver()
if name != "glibc" or tuple(map(int, number.split(".")[:2])) < (2, NEEDED):
    command = [libraries + "/system/LOADER", "--library-path", libraries + "/system:" + libraries, program]
os.execv(command[0], [*command, *sys.argv[1:]])
"""

Settings = Mapping[str, str] | None


def project() -> dict:
    return tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]


def version() -> str:
    found = re.search(r"^project\(myoid VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"), re.M)
    if not found:
        raise RuntimeError("CMakeLists.txt states no version of the project")
    return found[1]


def metadata() -> str:
    p = project()
    lines = [
        "Metadata-Version: 2.1", f"Name: {p['name']}", f"Version: {version()}", f"Summary: {p['description']}",
        f"License: {p['license']['text']}", f"Requires-Python: {p['requires-python']}",
        *(f"Requires-Dist: {d}" for d in p["dependencies"]),
    ]  # fmt: skip
    for extra, packages in p["optional-dependencies"].items():
        lines += [f"Provides-Extra: {extra}", *(f'Requires-Dist: {d}; extra == "{extra}"' for d in packages)]
    readme = (ROOT / p["readme"]).read_text(encoding="utf-8")
    return "\n".join([*lines, "Description-Content-Type: text/markdown", "", readme])


# The oldest C library of the systems whose libstdc++ has these symbols (PEP 600 names systems by the C library).
SYSTEMS_WITH_GLIBCXX = {28: 31, 29: 34, 30: 35, 31: 36, 32: 38, 33: 39, 34: 41}


def oldest_system(binaries: list[bytes]) -> int:
    """N of the oldest C library 2.N with all symbols that the binaries need, by the versions in their tables."""
    needed = {17}  # the oldest that pip knows as manylinux_2_N for every processor
    for data in binaries:
        needed |= {int(n) for n in re.findall(rb"\0GLIBC_2\.(\d+)(?=[.\0])", data)}
        for n in {int(n) for n in re.findall(rb"\0GLIBCXX_3\.4\.(\d+)\0", data)}:
            needed.add(next((system for symbols, system in SYSTEMS_WITH_GLIBCXX.items() if n <= symbols), 99))
    return max(needed)


def tag() -> str:
    """Any Python 3 of any Linux with glibc: the program brings its C library, and `import myoid` says what it needs."""
    system = "manylinux_2_17" if platform.libc_ver()[0] == "glibc" else "linux"
    return f"py3-none-{system}_{platform.machine()}"


def build_time() -> int:
    """SOURCE_DATE_EPOCH, else the time of the last commit, else of pyproject.toml [s since 1970]."""
    if "SOURCE_DATE_EPOCH" in os.environ:
        return int(os.environ["SOURCE_DATE_EPOCH"])
    git = subprocess.run(["git", "-C", ROOT, "log", "-1", "--format=%ct"], capture_output=True, text=True, check=False)
    return int(git.stdout) if git.returncode == 0 else int((ROOT / "pyproject.toml").stat().st_mtime)


def linked(settings: Settings) -> list[Path]:
    """Builds the program and the modules; returns their files, the program first, this Python's module second."""
    given = (settings or {}).get("build-dir")
    tree = ROOT / given if given else ROOT / "build" / "wheel"
    headers = (settings or {}).get("python-headers")
    if not given:
        options = ["MYOID_TESTS=OFF", "MYOID_BENCHMARKS=OFF", "MYOID_UNITY=ON", "CMAKE_BUILD_TYPE=Release",
                   "CMAKE_CXX_FLAGS_RELEASE=-O2 -DNDEBUG", f"MYOID_PYTHON={sys.executable}"]  # fmt: skip
        subprocess.run(["cmake", "-S", ROOT, "-B", tree, "-G", "Ninja", *(f"-D{o}" for o in options)], check=True)
    if headers:
        subprocess.run(["cmake", f"-DMYOID_PYTHON_HEADERS={Path(headers).resolve()}", tree], check=True)
    subprocess.run(["cmake", "--build", tree, "--target", "myoid_wheel"], check=True)
    package = tree / "wheel" / "myoid"
    suffix = sysconfig.get_config_var("EXT_SUFFIX")
    if not (package / f"_native{suffix}").is_file():
        raise RuntimeError(f"{tree} is built for another Python than {sys.executable} ({suffix})")
    minors = [int(p.name[8:]) for p in Path(headers or os.devnull).glob("usr/include/python3.*")]
    modules = [f"_native{re.sub('cpython-3[0-9]+', f'cpython-3{minor}', suffix)}" for minor in sorted(minors)]
    return [package / "bin" / "myoid", *(package / name for name in dict.fromkeys([f"_native{suffix}", *modules]))]


def libraries(binary: Path) -> dict[str, Path]:
    """The shared libraries that a binary needs and its loader, by name."""
    told = subprocess.run(["ldd", binary], capture_output=True, text=True, check=True).stdout
    if "not found" in told:
        raise RuntimeError(f"{binary} needs libraries that are not there:\n{told}")
    return {Path(path).name: Path(path) for path in re.findall(r"^\s*(?:\S+ => )?(/\S+)", told, re.M)}


def package_of(library: Path) -> str:
    """Debian's package of a library, if it has one. /lib is /usr/lib, and either may be listed."""
    for name in (os.path.realpath(library), os.path.realpath(library).removeprefix("/usr")):
        told = subprocess.run(["dpkg-query", "-S", name], capture_output=True, text=True, check=False)
        if told.returncode == 0:
            return told.stdout.split(":")[0]
    return ""


def source_of(package: str) -> str:
    form = "package ${Package} ${Version}, source ${source:Package} ${source:Version}"
    return subprocess.run(["dpkg-query", "-W", "-f", form, package], capture_output=True, text=True, check=True).stdout


def contents(binaries: list[Path]) -> dict[str, tuple[bytes, bool]]:
    """The files of the wheel but for its record: bytes, and whether a file is a program."""
    files = {}
    for file in sorted((ROOT / "python" / "myoid").iterdir()):
        if file.is_file():
            files[f"myoid/{file.name}"] = (file.read_bytes(), False)
    program, *modules = binaries
    for file in modules:
        files[f"myoid/{file.name}"] = (file.read_bytes(), True)
    files["myoid/bin/myoid"] = (program.read_bytes(), True)
    needed = oldest_system([file.read_bytes() for file in binaries])
    found, sources = libraries(program), []
    found |= {name: path for name, path in libraries(modules[0]).items() if not SYSTEM.match(name)}
    for name, path in sorted(found.items()):
        place = "myoid.libs/system" if SYSTEM.match(name) else "myoid.libs"
        files[f"{place}/{name}"] = (path.read_bytes(), True)
        package = package_of(path) if shutil.which("dpkg-query") else ""
        if package:
            files[f"{place}/{name}.copyright"] = (Path(f"/usr/share/doc/{package}/copyright").read_bytes(), False)
            sources.append(f"{name}: {source_of(package)}\n")
    files["myoid.libs/packages.txt"] = ("".join(sources).encode(), False)
    for licence in ("GPL-2", "GPL-3", "LGPL-2.1"):  # which the notices name
        text = Path("/usr/share/common-licenses", licence)
        if text.is_file():
            files[f"myoid.libs/system/{licence}"] = (text.read_bytes(), False)
    loader = next((name for name in found if name.startswith("ld-linux")), "")
    starter = STARTER.replace("NEEDED", str(needed)).replace("LOADER", loader)
    files[f"myoid-{version()}.data/scripts/myoid"] = (starter.encode(), True)
    info = f"myoid-{version()}.dist-info"
    for name in ("LICENSE", "NOTICE", "licenses.txt"):
        files[f"{info}/{name}"] = ((ROOT / name).read_bytes(), False)
    files[f"{info}/METADATA"] = (metadata().encode(), False)
    files[f"{info}/WHEEL"] = (wheel_file().encode(), False)
    return files


def wheel_file() -> str:
    return f"Wheel-Version: 1.0\nGenerator: myoid\nRoot-Is-Purelib: false\nTag: {tag()}\n"


def record(files: Mapping[str, tuple[bytes, bool]], name: str) -> str:
    lines = []
    for path, (data, _) in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        lines.append(f"{path},sha256={digest},{len(data)}")
    return "\n".join([*lines, f"{name},,", ""])


def get_requires_for_build_wheel(config_settings: Settings = None) -> list[str]:
    return []


def get_requires_for_build_sdist(config_settings: Settings = None) -> list[str]:
    return []


def prepare_metadata_for_build_wheel(metadata_directory: str, config_settings: Settings = None) -> str:
    folder = Path(metadata_directory) / f"myoid-{version()}.dist-info"
    folder.mkdir()
    (folder / "METADATA").write_text(metadata(), encoding="utf-8")
    (folder / "WHEEL").write_text(wheel_file(), encoding="utf-8")
    return folder.name


def build_wheel(wheel_directory: str, config_settings: Settings = None, metadata_directory: str | None = None) -> str:
    files = contents(linked(config_settings))
    listed = f"myoid-{version()}.dist-info/RECORD"
    files[listed] = (record(files, listed).encode(), False)
    name = f"myoid-{version()}-{tag()}.whl"
    date = time.gmtime(max(build_time(), 315532800))[:6]  # a .zip begins at 1980
    with zipfile.ZipFile(Path(wheel_directory) / name, "w", zipfile.ZIP_DEFLATED) as archive:
        for path, (data, program) in files.items():
            entry = zipfile.ZipInfo(path, date)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = (0o100755 if program else 0o100644) << 16
            archive.writestr(entry, data)
    return name


def build_sdist(sdist_directory: str, config_settings: Settings = None) -> str:
    """Packs the files that git lists; of an unpacked source distribution all files but build/."""
    base = f"myoid-{version()}"
    git = subprocess.run(["git", "-C", ROOT, "ls-files", "-z"], capture_output=True, text=True, check=False)
    names = [n for n in git.stdout.split("\0") if n]
    if git.returncode != 0:
        files = (p.relative_to(ROOT) for p in ROOT.rglob("*") if p.is_file() or p.is_symlink())
        names = [str(p) for p in files if p.parts[0] != "build" and p.name != "PKG-INFO"]
    buffer, date = io.BytesIO(), build_time()
    with tarfile.open(fileobj=buffer, mode="w", format=tarfile.PAX_FORMAT) as archive:

        def cleaned(entry: tarfile.TarInfo) -> tarfile.TarInfo:
            entry.uid = entry.gid = 0
            entry.uname = entry.gname = ""
            entry.mtime = date
            return entry

        for name in sorted(names):
            archive.add(ROOT / name, f"{base}/{name}", recursive=False, filter=cleaned)
        told = metadata().encode()
        entry = tarfile.TarInfo(f"{base}/PKG-INFO")
        entry.size = len(told)
        archive.addfile(cleaned(entry), io.BytesIO(told))
    (Path(sdist_directory) / f"{base}.tar.gz").write_bytes(gzip.compress(buffer.getvalue(), 6, mtime=0))
    return f"{base}.tar.gz"

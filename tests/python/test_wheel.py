"""The wheel: what it needs, and a study by it in an empty virtual environment."""

import os
import re
import shutil
import subprocess
import sys
import tarfile
import zipfile
from pathlib import Path

import numpy
import pytest
from conftest import SOURCE, program

import myoid

sys.path.insert(0, str(SOURCE / "python"))  # build_backend
TREE = Path(myoid.__file__).resolve().parents[2]
SYSTEM = {"libc.so.6", "libm.so.6", "libstdc++.so.6", "libgcc_s.so.1", "ld-linux-x86-64.so.2", "ld-linux-aarch64.so.1",
          "libpthread.so.0", "libdl.so.2"}  # fmt: skip


def pip(*arguments):
    done = subprocess.run([sys.executable, "-m", "pip", *arguments], capture_output=True, text=True, check=False,
                          env={**os.environ, "PIP_DISABLE_PIP_VERSION_CHECK": "1"})  # fmt: skip
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    """The wheel, linked from what the build tree has compiled."""
    if subprocess.run([sys.executable, "-m", "pip", "--version"], capture_output=True, check=False).returncode != 0:
        pytest.skip(f"{sys.executable} has no pip")
    folder = tmp_path_factory.mktemp("wheel")
    pip("wheel", SOURCE, "--no-build-isolation", "--no-deps", "--config-settings", f"build-dir={TREE}", "-w", folder)
    (file,) = folder.glob("myoid-*.whl")
    return file


def test_the_wheel_needs_nothing_but_the_libraries_of_the_system(wheel, tmp_path):
    if not shutil.which("objdump"):
        pytest.skip("needs objdump")
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(tmp_path)
        assert archive.testzip() is None
    included = {file.name for file in (tmp_path / "myoid.libs").glob("*.so*") if file.suffix != ".copyright"}
    binaries = [tmp_path / "myoid/bin/myoid", *(tmp_path / "myoid").glob("_native*.so")]
    assert len(binaries) >= 2
    (starter,) = tmp_path.glob("myoid-*.data/scripts/myoid")
    allowed = int(re.search(r"< \(2, (\d+)\)", starter.read_text())[1])
    for file in [*binaries, *(tmp_path / "myoid.libs" / name for name in included)]:
        told = subprocess.run(["objdump", "-p", file], capture_output=True, text=True, check=True).stdout
        needed = set(re.findall(r"NEEDED +(\S+)", told))
        assert needed and needed <= SYSTEM | included, file.name
        # An older C library than the starter's limit is replaced by the one in the wheel.
        assert all(int(v) <= allowed for v in re.findall(r"GLIBC_2\.(\d+)", told))
        if needed & included:
            assert re.search(r"RUNPATH +\$ORIGIN/(?:\.\./)+myoid\.libs\n", told), file.name
    packages = (tmp_path / "myoid.libs/packages.txt").read_text()
    for name in included:
        assert (tmp_path / f"myoid.libs/{name}.copyright").is_file()
        assert f"{name}: package " in packages


def test_modules_linked_with_old_libraries_ask_for_nothing_newer(wheel, tmp_path):
    headers = re.search(r"^MYOID_PYTHON_HEADERS:PATH=(.+)$", (TREE / "CMakeCache.txt").read_text(), re.M)
    if not headers or not Path(headers[1], "old").is_dir():
        pytest.skip("needs the old libraries that packaging/python-headers.sh fetches")
    from build_backend import oldest_system

    (features,) = Path(headers[1], "old").glob("usr/include/features.h")
    old = int(re.search(r"__GLIBC_MINOR__\s+(\d+)", features.read_text())[1])
    with zipfile.ZipFile(wheel) as archive:
        modules = {name: archive.read(name) for name in archive.namelist() if name.startswith("myoid/_native")}
    assert len(modules) >= 1
    assert {name for name, data in modules.items() if oldest_system([data]) > old} == set()


def test_the_program_runs_with_the_c_library_in_the_wheel(wheel, tmp_path):
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(tmp_path)
    system = tmp_path / "myoid.libs/system"
    (loader,) = (file for file in system.glob("ld-linux*") if file.suffix != ".copyright")
    (tmp_path / "myoid/bin/myoid").chmod(0o755)
    loader.chmod(0o755)
    command = [loader, "--library-path", f"{system}:{tmp_path / 'myoid.libs'}", "--list", tmp_path / "myoid/bin/myoid"]
    told = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    assert all(place.startswith(str(tmp_path)) for place in re.findall(r"=> (/\S+)", told)), told
    done = subprocess.run([*command[:3], command[4], "--version"], capture_output=True, text=True, check=True)
    assert done.stdout == program("--version")


def test_a_module_that_cannot_be_loaded_says_why(tmp_path):
    shutil.copytree(SOURCE / "python/myoid", tmp_path / "myoid")
    (tmp_path / "myoid/_native.cpython-38-x86_64-linux-gnu.so").write_bytes(b"")
    code = "try:\n    import myoid\nexcept ImportError as error:\n    print(error)"
    done = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, check=True)
    assert "Python 3.8" in done.stdout
    assert f"Python 3.{sys.version_info[1]}" in done.stdout


def test_without_numpy_the_package_is_named():
    code = "try:\n    import myoid\nexcept ModuleNotFoundError as error:\n    print(error.name, error, sep='\\n')"
    # -S: without the folders of installed packages.
    done = subprocess.run([sys.executable, "-S", "-c", code], env={"PYTHONPATH": str(TREE / "python")},
                          capture_output=True, text=True, check=True)  # fmt: skip
    assert done.stdout.splitlines()[0] == "numpy"
    assert "pip install numpy" in done.stdout


def test_the_tag_is_the_oldest_system_that_has_every_symbol():
    from build_backend import oldest_system

    assert oldest_system([b"\0GLIBC_2.2.5\0"]) == 17
    assert oldest_system([b"\0GLIBC_2.34\0GLIBC_2.3.4\0", b"\0GLIBC_2.4\0"]) == 34
    assert oldest_system([b"\0GLIBC_2.34\0GLIBCXX_3.4.30\0"]) == 35  # libstdc++ of GCC 12
    assert oldest_system([b"\0GLIBCXX_3.4.21\0"]) == 31


def test_the_version_stands_in_one_place(wheel):
    number = program("--version").strip()
    assert wheel.name.startswith(f"myoid-{number}-")
    with zipfile.ZipFile(wheel) as archive:
        assert f"\nVersion: {number}\n" in archive.read(f"myoid-{number}.dist-info/METADATA").decode()


def test_the_wheel_holds_the_licences_of_the_works_in_it(wheel):
    number = program("--version").strip()
    with zipfile.ZipFile(wheel) as archive:
        texts = archive.read(f"myoid-{number}.dist-info/licenses.txt").decode()
    works = "three.js fmt pugixml toml++ JSON CLI11 Ceres SUNDIALS pybind11 Eigen Boost oneTBB OpenSSL GCC".split()
    assert [work for work in works if f"\n{work}" not in texts] == []
    for licence in ("MIT", "BSD-3-Clause", "BSL-1.0", "MPL-2.0", "GCC Runtime Library Exception"):
        assert f"\n{licence}\n====" in texts


def test_a_second_wheel_has_the_same_bytes_and_the_sdist_the_sources(wheel, tmp_path):
    # The backend is called in a process of its own, as pip does.
    code = (
        "import sys; sys.path.insert(0, 'python'); import build_backend as b; "
        f"b.build_wheel({str(tmp_path)!r}, {{'build-dir': {str(TREE)!r}}}); b.build_sdist({str(tmp_path)!r})"
    )
    subprocess.run([sys.executable, "-c", code], cwd=SOURCE, check=True, capture_output=True)
    assert (tmp_path / wheel.name).read_bytes() == wheel.read_bytes()
    (sdist,) = tmp_path.glob("*.tar.gz")
    base = sdist.name.removesuffix(".tar.gz")
    with tarfile.open(sdist) as archive:
        names = set(archive.getnames())
    assert {f"{base}/{n}" for n in ("PKG-INFO", "pyproject.toml", "CMakeLists.txt", "python/src/module.cpp")} <= names
    assert not any(name.startswith(f"{base}/build/") for name in names)


def test_the_twenty_snippets_run_from_the_wheel_outside_the_checkout(wheel, tmp_path):
    environment, copied = tmp_path / "env", tmp_path / "copied"
    # The packages that the snippets use beside myoid are the system's.
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", "--system-site-packages", environment], check=True)
    pip("--python", environment / "bin/python", "install", "--no-index", "--no-deps", "--ignore-installed", wheel)
    (copied / "tests/python").mkdir(parents=True)
    for file in ("conftest.py", "test_arrays.py"):
        shutil.copy(SOURCE / "tests/python" / file, copied / "tests/python")
    shutil.copytree(SOURCE / "examples/rat_soleus", copied / "examples/rat_soleus")
    inherited = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}

    def run(*command):
        done = subprocess.run([environment / "bin/python", *command], cwd=copied, capture_output=True, text=True,
                              check=False, env={**inherited, "MYOID": str(environment / "bin/myoid")})  # fmt: skip
        assert done.returncode == 0, done.stdout + done.stderr
        return done.stdout

    assert run("-c", "import myoid; print(myoid.__file__)").startswith(str(environment))
    told = run("-m", "pytest", "-q", "-rs", "-p", "no:cacheprovider", "tests/python/test_arrays.py")
    assert int(re.search(r"(\d+) passed", told)[1]) >= 20
    print(told)


def test_a_study_runs_from_the_wheel_in_an_environment_of_numpy_alone(wheel, tmp_path):
    environment = tmp_path / "env"
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", environment], check=True)
    pip("--python", environment / "bin/python", "install", "--no-index", "--no-deps", wheel)
    (packages,) = environment.glob("lib/python3*/site-packages")
    for part in Path(numpy.__file__).parents[1].glob("numpy*"):
        (packages / part.name).symlink_to(part)

    def run(*command):
        done = subprocess.run([environment / "bin" / command[0], *command[1:]], cwd=tmp_path, capture_output=True,
                              text=True, check=False, env={"PATH": "/usr/bin:/bin"})  # fmt: skip
        assert done.returncode == 0, done.stdout + done.stderr
        return done.stdout

    assert run("myoid", "--version") == program("--version")
    run("myoid", "twin", "--model", "arm4", "--protocol", SOURCE / "examples/protocols/three_trials.toml", "--seed", "1",
        "--out", "recording", "--quiet")  # fmt: skip
    script = (
        "import myoid, warnings\n"
        "warnings.simplefilter('ignore', myoid.MyoidWarning)\n"
        "r = myoid.run('recording/study.toml', out='results')\n"
        "print(len(r.parameters.where(method='torque', verdict='identified')))\n"
        "print(myoid.__file__, *{l.split()[-1] for l in open('/proc/self/maps') if 'tbb' in l or 'fmt' in l})\n"
    )
    identified, places = run("python", "-c", script).splitlines()
    assert int(identified) >= 1
    assert all(place.startswith(str(environment)) for place in places.split())
    # The same study by the program of the build tree: the last bit of every number.
    program("run", tmp_path / "recording/study.toml", "--out", tmp_path / "program", "--quiet")
    for file in ("parameters.csv", "swing_2kg/id.sto"):
        assert (tmp_path / "results" / file).read_bytes() == (tmp_path / "program" / file).read_bytes()

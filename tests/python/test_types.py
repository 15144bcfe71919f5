"""The types of the package, by mypy in its strict form (pyproject.toml)."""

import os
import shutil
import subprocess

import pytest
from conftest import SOURCE


def mypy(*arguments, cwd):
    if not shutil.which("mypy"):
        pytest.skip("needs mypy")
    command = ["mypy", "--no-incremental", "--cache-dir", os.devnull, *map(os.fspath, arguments)]
    return subprocess.run(command, cwd=cwd, capture_output=True, text=True, check=False,
                          env={**os.environ, "MYPYPATH": os.fspath(SOURCE / "python")})  # fmt: skip


def test_the_package_has_the_types_that_it_states():
    done = mypy("--config-file", SOURCE / "pyproject.toml", cwd=SOURCE)
    assert done.returncode == 0, done.stdout + done.stderr


def test_a_users_mistake_is_found(tmp_path):
    (tmp_path / "use.py").write_text(
        "import myoid\n"
        "angles = myoid.ik(model='arm4', markers='lift.trc').angles\n"
        "rate: float = angles.rate\n"
        "myoid.ik(model='arm4', marker='lift.trc')\n"
        "name: int = angles.channels[0]\n"
    )
    done = mypy("--strict", "--ignore-missing-imports", "use.py", cwd=tmp_path)
    assert [line.split(":")[1] for line in done.stdout.splitlines() if ": error:" in line] == ["4", "5"], done.stdout

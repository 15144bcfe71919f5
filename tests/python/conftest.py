"""A small virtual person, the demo's person, and the program."""

import os
import subprocess
import warnings
from pathlib import Path

import pytest

import myoid

SOURCE = Path(__file__).resolve().parents[2]
SMALL = """
level = "L1"
[[trial]]
name = "mvc"
kind = "mvc"
direction = "both"
[[trial]]
name = "lift"
kind = "eccentric"
held_mass_kg = 1.0
"""


def program(*arguments, fails=False, stderr=False):
    """Runs the program; returns its standard output, or with `stderr` its messages."""
    done = subprocess.run(
        [os.environ["MYOID"], *map(os.fspath, arguments)], capture_output=True, text=True, check=False
    )
    assert fails or done.returncode in (0, 4), done.stderr
    return done.stderr if stderr else done.stdout


@pytest.fixture(scope="session")
def protocol(tmp_path_factory):
    file = tmp_path_factory.mktemp("protocol") / "p.toml"
    file.write_text(SMALL)
    return file


@pytest.fixture(scope="session")
def recording(tmp_path_factory, protocol):
    """The study of a small virtual person."""
    return myoid.twin(protocol=protocol, out=tmp_path_factory.mktemp("person") / "r").study


@pytest.fixture(scope="session")
def result(recording, tmp_path_factory):
    """The results of that study."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", myoid.MyoidWarning)
        return myoid.run(recording, out=tmp_path_factory.mktemp("results") / "r")


@pytest.fixture(scope="session")
def data():
    """The shared data; tests skip, saying so, where there are none."""
    folder = Path(os.environ.get("MYOID_DATA", SOURCE / ".." / "shared" / "data"))
    if not folder.is_dir():
        pytest.skip(f"needs {folder}; set MYOID_DATA to the shared data folder")
    return folder

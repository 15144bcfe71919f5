"""The numbered examples: the Python and the C++ program of each number print the same lines."""

import importlib.util
import os
import subprocess
import sys
from pathlib import Path

import pytest
from conftest import SOURCE, program

EXAMPLES = SOURCE / "examples"
NUMBERED = sorted(folder.name for folder in EXAMPLES.glob("0*_*"))


def ladder(recording, out):
    """The arguments of the examples, from the check of their numbers."""
    spec = importlib.util.spec_from_file_location("check_numbers", SOURCE / "tests" / "examples" / "check_numbers.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.ladder(recording, EXAMPLES, out)


@pytest.fixture(scope="module")
def person(tmp_path_factory):
    folder = tmp_path_factory.mktemp("examples") / "recording"
    program("twin", "--protocol", EXAMPLES / "protocols" / "three_trials.toml", "--out", folder)
    return folder


def test_there_are_six():
    assert [name[:2] for name in NUMBERED] == ["01", "02", "03", "04", "05", "06"]


@pytest.mark.parametrize("name", NUMBERED)
def test_both_languages_print_the_same_numbers(name, person, tmp_path):
    compiled = Path(os.environ.get("MYOID_EXAMPLES", "")) / name[3:]
    if not compiled.is_file():
        pytest.skip(f"{compiled} is not built")
    printed = []
    for command in ([compiled], [sys.executable, EXAMPLES / name / f"{name[3:]}.py"]):
        out = tmp_path / str(len(printed))
        out.mkdir()
        arguments = map(os.fspath, [*command, *ladder(person, out)[name]])
        done = subprocess.run(list(arguments), capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        printed.append(done.stdout)
    assert printed[0].count("\n") > 3
    assert printed[0] == printed[1]

"""The module as a whole: names, documentation, stubs, the options of the command line."""

import inspect
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from conftest import SOURCE, program

import myoid

# Options of the program that belong to a terminal: what it prints and which exit code it has.
TERMINAL = {"help", "json", "quiet", "verbose", "strict", "each_muscle", "paper_figures", "help_files", "settings",
            "defaults"}  # fmt: skip
PAGE = {"html", "motion", "forces", "activations", "markers", "meshes", "up", "start", "end", "overwrite"}
COMMANDS = [
    "run", "identify", "predict", "check", "compare", "design", "emg", "ik", "id", "paths", "so", "muscle", "simulate",
    "twin", "twin_study", "run_tool", "info", "convert", "cohort", "report", "init",
]  # fmt: skip


@pytest.mark.parametrize("command", COMMANDS)
def test_keywords_are_the_options_of_the_command_line(command):
    text = program(command.replace("_", "-"), "--help")
    options = {o.replace("-", "_") for o in re.findall(r"^  (?:-\w,)?--([a-z-]+)", text, re.MULTILINE)} - TERMINAL
    if command == "info":
        options -= PAGE
    if command == "paths":
        options -= {"sweep", "muscle"}  # myoid.sweep
    parameters = inspect.signature(getattr(myoid, command)).parameters
    keywords = {p.name.rstrip("_") for p in parameters.values() if p.kind == p.KEYWORD_ONLY} - {"progress"}
    positional = {p.name for p in parameters.values() if p.kind == p.POSITIONAL_OR_KEYWORD}
    if command == "cohort":
        options -= {"entity", "n_cpus", "mem_mb"}  # of workflows and BIDS Apps; threads, jobs
    if command in ("convert", "emg"):
        keywords -= {"out"} if command == "convert" else {"rate"}  # of arrays
    assert keywords == options - positional


def test_every_public_function_is_documented_and_called_by_a_test():
    texts = "".join(f.read_text() for f in Path(__file__).parent.glob("*.py"))
    for name in myoid.__all__:
        thing = getattr(myoid, name)
        if name.startswith("__"):
            continue
        assert thing.__doc__, name
        if inspect.isfunction(thing):
            assert f"myoid.{name}(" in texts, name
            for keyword in set(inspect.signature(thing).parameters) - {"start", "end", "threads", "seed", "overwrite",
                                                                      "progress"}:  # fmt: skip
                assert re.search(rf"\b{keyword}\b", thing.__doc__), f"{name}: {keyword} is not documented"
        elif inspect.isclass(thing):
            for method, member in inspect.getmembers(thing):
                if not method.startswith("_") and (inspect.isfunction(member) or isinstance(member, property)):
                    assert member.__doc__, f"{name}.{method}"


def test_the_version_is_the_program_s():
    assert myoid.__version__ == program("--version").strip()
    cmake = (SOURCE / "CMakeLists.txt").read_text()
    assert f"VERSION {myoid.__version__} " in cmake
    # Files whose formats need the number written out.
    assert (SOURCE / "debian/changelog").read_text().startswith(f"myoid ({myoid.__version__}) ")
    assert f'{{% set version = "{myoid.__version__}" %}}' in (SOURCE / "packaging/conda/meta.yaml").read_text()


def test_debian_s_list_of_symbols_has_every_function_of_the_c_interface():
    header = (SOURCE / "myoid/results/realtime/c_interface.h").read_text()
    symbols = (SOURCE / "debian/libmyoid0.symbols").read_text()
    declared = set(re.findall(r"\b(myoid_\w+)\(", header))
    assert len(declared) > 10 and set(re.findall(r"^ (\w+)@Base", symbols, re.MULTILINE)) == declared


def test_the_recipe_of_conda_names_every_library_that_cmake_asks_for():
    jinja2, yaml = pytest.importorskip("jinja2"), pytest.importorskip("yaml")
    text = (SOURCE / "packaging/conda/meta.yaml").read_text()
    recipe = yaml.safe_load(
        jinja2.Template(text, undefined=jinja2.StrictUndefined).render(
            compiler=lambda language: language, stdlib=lambda language: language, pin_compatible=lambda name: name
        )
    )
    assert recipe["package"] == {"name": "myoid", "version": myoid.__version__}
    names = {"Eigen3": "eigen", "OpenSSL": "openssl", "Boost": "libboost-headers", "TBB": "tbb-devel",
             "CLI11": "cli11"}  # fmt: skip
    cmake = (SOURCE / "cmake/dependencies.cmake").read_text() + (SOURCE / "cmake/sundials.cmake").read_text()
    asked = set(re.findall(r"find_package\((\w+)", cmake)) - {"GTest", "Threads", "MPI"}
    host = {entry.split()[0] for entry in recipe["requirements"]["host"]}
    assert {names.get(name, name) for name in asked} <= host
    by_header = {"toml++/toml.h": "tomlplusplus", "ceres/jet.h": "ceres-solver", "cvodes/cvodes.h": "sundials",
                 "matio.h": "libmatio"}  # fmt: skip
    assert {by_header[name] for name in re.findall(r"find_path\(\w+ ([\w+./]+)", cmake)} <= host


def test_the_stubs_name_what_the_extension_has():
    from myoid import _native

    stub = (Path(myoid.__file__).parent / "_native.pyi").read_text()
    names = {n for n in dir(_native) if not n.startswith("_")}
    assert names == set(re.findall(r"^(?:def|class) (\w+)", stub, re.MULTILINE))
    for kind in ("Recording", "Model"):
        body = stub.split(f"class {kind}:")[1].split("\n\n")[0]
        assert set(re.findall(r"def (\w+)", body)) == {n for n in dir(getattr(_native, kind)) if not n.startswith("_")}
    assert (Path(myoid.__file__).parent / "py.typed").is_file()


def test_the_page_s_ten_lines_run(result, recording, tmp_path):
    text = (SOURCE / "docs/guide/python.md").read_text()
    blocks = re.findall(r"\n((?:    .*\n|\n(?=    ))+)", text)
    lines = next(block for block in blocks if "import myoid" in block)
    script = "\n".join(line[4:] for line in lines.splitlines())
    assert len(script.strip().splitlines()) >= 10
    environment = {**os.environ, "PYTHONPATH": str(Path(myoid.__file__).parents[1]), "PYTHONWARNINGS": "ignore"}
    done = subprocess.run([sys.executable, "-c", script], cwd=recording.parent, env=environment, capture_output=True,
                          text=True, check=False)  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert re.search(r"BIC: \d+ N, \d+ to \d+", done.stdout)

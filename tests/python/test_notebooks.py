"""The notebooks of examples/notebooks run and print their stored outputs. MYOID_PRINT_PAGES=1 writes their outputs."""

import os
import sys
from pathlib import Path

import pytest
from conftest import SOURCE

import myoid

nbformat = pytest.importorskip("nbformat")
nbclient = pytest.importorskip("nbclient")
pytest.importorskip("ipykernel")
pytest.importorskip("matplotlib")
NOTEBOOKS = sorted((SOURCE / "examples/notebooks").glob("*.ipynb"))


def printed(notebook):
    """The texts that the cells print, in order."""
    return [output["text"] for cell in notebook.cells for output in cell.get("outputs", ())
            if output["output_type"] == "stream"]  # fmt: skip


def tidied(notebook):
    """The notebook without the marks of one run."""
    for cell in notebook.cells:
        cell.metadata.pop("execution", None)
    notebook.metadata.pop("language_info", None)
    return notebook


def test_there_are_five():
    assert len(NOTEBOOKS) == 5


@pytest.mark.parametrize("file", NOTEBOOKS, ids=lambda file: file.stem)
def test_a_notebook_runs_and_prints_what_stands_in_it(file, tmp_path, monkeypatch):
    from jupyter_client.kernelspec import KernelSpec
    from jupyter_client.manager import AsyncKernelManager

    monkeypatch.setenv("PYTHONPATH", str(Path(myoid.__file__).parents[1]))
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    manager = AsyncKernelManager()
    manager._kernel_spec = KernelSpec(argv=[sys.executable, "-m", "ipykernel_launcher", "-f", "{connection_file}"])
    stored = nbformat.read(file, as_version=4)
    notebook = nbformat.read(file, as_version=4)
    place = {"metadata": {"path": str(tmp_path)}}
    nbclient.NotebookClient(notebook, km=manager, timeout=600, resources=place).execute()
    if os.environ.get("MYOID_PRINT_PAGES"):
        nbformat.write(tidied(notebook), file)
        return
    assert file.stat().st_size < 1_000_000
    outputs = [output for cell in stored.cells for output in cell.get("outputs", ())]
    assert any("image/png" in output.get("data", {}) for output in outputs)
    assert printed(stored) and printed(notebook) == printed(stored)

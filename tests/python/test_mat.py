"""MATLAB files: SciPy, as another reader, finds the numbers and texts of parameters.csv and of the series."""

import warnings

import numpy as np
import pytest
from conftest import program

import myoid

io = pytest.importorskip("scipy.io")


@pytest.fixture(scope="module")
def both(recording, tmp_path_factory):
    """A result and its MATLAB file, as SciPy reads it."""
    folder = tmp_path_factory.mktemp("mat")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", myoid.MyoidWarning)
        try:
            result = myoid.run(recording, out=folder / "Kräfte µ", mat=folder / "new/r.mat")
        except myoid.InvalidInput as error:
            if "libmatio" not in str(error):
                raise
            pytest.skip(str(error))
    return result, io.loadmat(folder / "new/r.mat", squeeze_me=True, struct_as_record=False)


def test_the_columns_of_the_table(both):
    result, found = both
    assert set(found["parameters"]._fieldnames) == {c if c != "case" else "fit_case" for c in result.parameters.columns}
    for name in result.parameters.columns:
        column = getattr(found["parameters"], "fit_case" if name == "case" else name)
        wanted = result.parameters[name]
        if isinstance(wanted[0], str):
            assert [str(text) if len(text) else "" for text in column] == wanted
        elif isinstance(wanted[0], bool):
            assert column.dtype == np.uint8 and [bool(x) for x in column] == wanted
        else:
            assert np.array_equal(column, [np.nan if x is None else x for x in wanted], equal_nan=True)


def test_every_series_of_every_trial_to_the_bit(both):
    result, found = both
    assert [trial.name for trial in found["trials"]] == list(result.trials)
    count = 0
    for trial in found["trials"]:
        for name in trial.series._fieldnames:
            series, wanted = getattr(trial.series, name), result.trials[trial.name][name]
            # Another reader of the file than the library's.
            text = (result.trials[trial.name]._files[name]).read_text(encoding="utf-8").split("endheader\n")[1]
            table = np.array([[float(x) for x in line.split("\t")] for line in text.splitlines()[1:] if line.strip()])
            assert series.time.tobytes() == table[:, 0].tobytes()
            assert np.array_equal(series.values.reshape(len(table), -1), table[:, 1:], equal_nan=True)
            assert list(np.atleast_1d(series.names)) == text.splitlines()[0].split("\t")[1:]
            in_memory = ["rad" if unit == "deg" else unit for unit in np.atleast_1d(series.units)]
            assert in_memory == wanted.units and all(wanted.units)
            assert bool(series.in_degrees) == (name == "ik")
            count += 1
        assert set(trial.series._fieldnames) == set(result.trials[trial.name])
    assert count >= 20


def test_units_of_series_are_those_of_the_pages(both):
    lift = both[0].trials["lift"]
    assert lift["ik"].unit("elbow_flexion") == "rad" and lift["id"].unit("elbow_flexion_moment") == "N m"
    assert lift["MuscleAnalysis_MuscleTendonVelocity"].unit("BIC") == "m/s"
    assert lift["identified_forces"].unit("BIC_identified") == "N"


def test_run_and_remarks(both):
    result, found = both
    for name in ("program", "version", "command", "study"):
        assert getattr(found["run"], name) == result.run[name]
    assert "Kräfte µ" in found["run"].command
    texts = [fault["message"] for fault in result.run["faults"]]
    for trial in result.run["trials"]:
        texts += [fault["message"] for fault in trial["faults"]] + trial["notes"]
    assert list(np.atleast_1d(found["remarks"].text)) == texts


def test_report_writes_it_of_a_finished_run(both, tmp_path):
    result, found = both
    program("report", result.path, "--mat", tmp_path / "again.mat", "--quiet")
    again = io.loadmat(tmp_path / "again.mat", squeeze_me=True, struct_as_record=False)
    assert np.array_equal(again["parameters"].estimate, found["parameters"].estimate, equal_nan=True)
    program("report", result.path, "--mat", tmp_path / "again.mat", "--quiet")
    io.whosmat(tmp_path / "again.mat")


def test_files_that_cannot_be_written_are_refused_before_the_run(both, recording, tmp_path):
    (tmp_path / "there.mat").write_text("mine")
    for name, words in {"there.mat": "there.mat", "r.txt": "ends in .mat"}.items():
        with pytest.raises(myoid.InvalidInput, match=words):
            myoid.run(recording, out=tmp_path / "out", mat=tmp_path / name)
    assert (tmp_path / "there.mat").read_text() == "mine" and not (tmp_path / "out").exists()

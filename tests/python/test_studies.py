"""Studies: the numbers of the program, results as people read them, errors, Ctrl-C."""

import _thread
import copy
import os
import pickle
import re
import shutil
import signal
import threading
import time
import warnings
from pathlib import Path

import numpy as np
import pytest
from conftest import program

import myoid


def test_run_gives_the_numbers_of_the_program_to_the_last_bit(recording, result, tmp_path):
    # The demo's own study: test_wheel.py.
    program("run", recording, "--out", tmp_path / "cli", "--quiet")
    for file in ["parameters.csv", *(f"{name}/id.sto" for name in result.trials)]:
        assert (result.path / file).read_bytes() == (tmp_path / "cli" / file).read_bytes()
    head, first = (line.split(",") for line in (tmp_path / "cli/parameters.csv").read_text().splitlines()[:2])
    assert result.parameters.columns == head and result.parameters[0]["estimate"] == float(first[6])
    verdicts = {"identified", "reproducible", "weak", "prior_dominated", "not_identifiable", "non_physical"}
    assert set(result.parameters["verdict"]) <= verdicts and len(result.parameters.where(method="torque")) > 20
    assert len(myoid.Table.read(recording.parent / "truth.csv")) > 10


def test_names_are_the_users(recording, tmp_path):
    trial, muscle = "slow 2 kg / 李", "BIC, 'long' #1"
    study = recording.parent / "odd names.toml"
    text = recording.read_text(encoding="utf-8")
    text = text.replace('name = "lift"', f'name = "{trial}"').replace('name = "BIC"', f'name = "{muscle}"')
    text = text.replace('same_as = "BIC"', f'same_as = "{muscle}"')
    study.write_text(text, encoding="utf-8")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", myoid.MyoidWarning)
        result = myoid.run(study, out=tmp_path / "r")
    assert result.trials[trial]["ik"]["elbow_flexion"].max() > 1.57
    assert f"{muscle}_identified" in result.trials[trial]["identified_forces"].channels
    assert result.parameter(muscle, "max_isometric_force")["unit"] == "N"


def test_a_temporary_folder_goes_with_its_result(recording):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", myoid.MyoidWarning)
        result = myoid.run(recording, method="torque", export=["ceinms", "osimx"])
    folder = result.path
    assert set(result.parameters["method"]) == {"torque"}
    assert (folder / "ceinms_calibrated.xml").is_file() and (folder / "nmsm.osimx").is_file()
    with pytest.raises(myoid.InvalidInput, match="export"):
        myoid.run(recording, export="osimxx")
    assert (folder / "parameters.csv").is_file() and result.report.is_file()
    del result
    assert not folder.exists()


def test_a_result_reads_its_folder(result, tmp_path):
    row = result.parameter("BIC", "max_isometric_force")
    assert row["unit"] == "N" and row["ci_low"] < row["estimate"] < row["ci_high"]
    assert result.parameters.where(parameter="concentric_curvature")[0]["unit"] == "1"
    assert set(result.parameters["at_bound"]) <= {True, False}
    with pytest.raises(KeyError, match="0 rows"):
        result.parameter("BIC", "no_such")
    lift = result.trials["lift"]
    assert lift.use and not lift.failure
    angle = lift["ik"]
    assert angle["elbow_flexion"].max() > 1.57 and angle.rate == pytest.approx(100, rel=0.5)
    assert "identified_forces" in lift and len(lift) == len(list(lift))
    with pytest.raises(KeyError, match="there are"):
        lift["none"]
    assert result.run["program"] == "myoid" and result.run["command"].endswith("from Python")
    assert "parameters_torque" in result.tables
    assert result.gates and {gate["status"] for gate in result.gates} <= {"pass", "warn", "fail", "info"}
    assert result.report.is_file() and (result.model is None or result.model.is_file())
    again = myoid.Result(result.path)
    assert list(again.parameters) == list(result.parameters) and again.gates == result.gates
    assert (result.save(tmp_path / "copy") / "report.html").read_bytes() == result.report.read_bytes()
    assert "numbers identified" in repr(result)


def test_a_pickled_result_carries_its_tables_and_series(recording, tmp_path):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", myoid.MyoidWarning)
        result = myoid.run(recording)
    # Nobody named a folder: the copy has all files, in another folder, and outlives the first.
    there = pickle.loads(pickle.dumps(result))
    assert there.path != result.path and list(there.parameters) == list(result.parameters)
    assert np.array_equal(there.trials["lift"]["ik"].values, result.trials["lift"]["ik"].values)
    assert there.report.read_bytes() == result.report.read_bytes() and there.run == result.run
    lift = pickle.loads(pickle.dumps(result.trials["lift"]))
    assert list(lift) == list(result.trials["lift"])
    assert np.array_equal(lift["id"].values, result.trials["lift"]["id"].values)
    # A named folder is opened where it is; where it is gone, the tables are there.
    named = myoid.Result(result.save(tmp_path / "named"))
    packed = pickle.dumps(named)
    assert pickle.loads(packed).path == (tmp_path / "named").absolute()
    shutil.rmtree(tmp_path / "named")
    gone = pickle.loads(packed)
    assert list(gone.parameters) == list(result.parameters) and gone.run == result.run
    assert list(gone.tables) == list(result.tables) and not gone.report.is_file()
    copied = copy.copy(gone)
    del gone
    assert len(copied.parameters) == len(result.parameters)


def test_a_notebook_shows_bars_and_the_report_without_a_server(result):
    assert "srcdoc=" not in result._repr_html_()
    page = result._repr_html_() + result.report_html()
    assert page.count("<svg") >= 10 and "srcdoc=" in page and "http://" not in page.split("srcdoc=")[0]
    frame = re.search(r'srcdoc="([^"]*)"', page)
    assert frame and "&lt;html" in frame.group(1)[:200].lower().replace("&lt;!doctype html&gt;", "&lt;html")
    assert "<table>" in result.tables["trials"]._repr_html_()


def test_pandas_and_xarray_where_they_are(result):
    series = result.trials["lift"]["id"]
    try:
        import pandas  # noqa: F401
    except ModuleNotFoundError:
        for conversion in (series.to_pandas, result.to_pandas):
            with pytest.raises(ModuleNotFoundError, match="pip install pandas"):
                conversion()
    else:
        frame = series.to_pandas()
        assert frame.index.name == "time" and list(frame.columns) == series.channels
        assert frame.attrs["units"]
        assert len(result.to_pandas()) == len(result.parameters)
    try:
        import xarray  # noqa: F401
    except ModuleNotFoundError:
        with pytest.raises(ModuleNotFoundError, match="pip install xarray"):
            result.to_xarray()
    else:
        array = series.to_xarray()
        assert array.dims == ("channel", "time") and "units" in array.attrs
        assert np.array_equal(array.sel(channel=series.channels[0]), series.values[:, 0])
        assert result.to_xarray()["lift"]["id"].dims == ("channel", "time")


def test_review(tmp_path):
    with pytest.raises(myoid.InvalidInput):
        myoid.review(tmp_path, out=tmp_path / "none")
    data = Path(os.environ.get("MYOID_DATA", "none")) / "ceinms-rt-leg"
    if not data.is_dir():
        pytest.skip("needs the shared recordings")
    found = myoid.review(data, out=tmp_path / "opinion")
    assert [row["calibration"] for row in found.torques] == [True, False]
    # Their subject was fitted to the calibration's trial.
    assert all(row["left_out_r2"] > row["their_r2"] for row in found.torques if not row["calibration"])
    assert {row["standing"] for row in found.numbers} <= {"agrees", "differs", "untold"}
    assert found.strengths and found.says and (tmp_path / "opinion/report.html").is_file()


def test_check_compare_design(recording, result, tmp_path):
    found = myoid.check(recording)
    assert found and found.of_study and found.trials == 2 and found.muscles >= 4 and found.errors == 0
    assert all(remark.severity and str(remark) for remark in found.findings)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", myoid.MyoidWarning)
        other = myoid.run(recording, out=tmp_path / "other")
        compared = myoid.compare(result, other, out=tmp_path / "compared")
    assert {row["change"] for row in compared.parameters} <= {"treatment", "cannot_tell"}
    assert all(row["difference"] == 0 for row in compared.parameters)
    assert (tmp_path / "compared/report.html").is_file()
    planned = myoid.design(model="arm4", targets="max_isometric_force", movements=2, persons=2)
    assert len(planned.plan) == 2 and len(planned.expected) == 2 and planned.catalogue_size > 10
    assert [row["parameter"] for row in planned.beforehand] == ["max_isometric_force"] * len(planned.beforehand)


def test_predict_gives_the_files_of_the_program(result, tmp_path):
    found = myoid.predict(result, trials="lift", out=tmp_path / "p")
    program("predict", result.path, "--trials", "lift", "--out", tmp_path / "cli", "--quiet")
    files = ["predictions.csv", "lift/predicted_torque_elbow_flexion.sto", "lift/predicted_forces.sto"]
    for file in files:
        assert (found.path / file).read_bytes() == (tmp_path / "cli" / file).read_bytes()
    (score,) = found.scores
    assert score["trial"] == "lift" and score["fitted"] is True and "lift" in repr(found)
    torque = found.trials["lift"]["predicted_torque_elbow_flexion"]
    names = [f"elbow_flexion_{part}" for part in ("measured", "predicted", "low", "high")]
    measured, predicted, low, high = (torque[name] for name in names)
    assert np.all((low < predicted) & (predicted < high)) and len(torque) == score["samples"]
    # The share of the samples within the band, from the columns.
    assert np.mean((low <= measured) & (measured <= high)) == pytest.approx(score["covered"], abs=1.5 / len(torque))
    assert np.sqrt(np.mean((measured - predicted) ** 2)) == pytest.approx(score["rmse_nm"], rel=1e-9)
    assert "rmse_nm" in found._repr_html_()
    with pytest.raises(myoid.InvalidInput, match="none"):
        myoid.predict(result, trials=["none"])


def test_identify_from_the_files_of_the_run(result, tmp_path):
    names = "max_isometric_force optimal_fiber_length force_length_width concentric_curvature "
    names += "eccentric_curvature_product eccentric_plateau max_shortening_speed tendon_slack_length"
    (tmp_path / "muscles.csv").write_text(
        "muscle,emg," + names.replace(" ", ",") + "\n"
        "BIC,BIC,1060,0.1224,0.055,0.28,0.058,1.4,1.22,0.21\n"
        "TRI,TRI,2047,0.1217,0.0548,0.28,0.058,1.4,1.22,0.2\n"
    )
    lift = result.path / "lift"
    options = dict(
        muscles=tmp_path / "muscles.csv", activations=lift / "activation.sto",
        lengths=lift / "MuscleAnalysis_Length.sto", velocities=[lift / "MuscleAnalysis_MuscleTendonVelocity.sto"],
        moment_arms=lift / "MuscleAnalysis_MomentArm_elbow_flexion.sto", torques=lift / "id.sto",
        coordinate="elbow_flexion", method="torque", motion=lift / "ik.mot", export="ceinms-rt",
    )  # fmt: skip
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", myoid.MyoidWarning)
        fitted = myoid.identify(**options, out=tmp_path / "out")
    command = [f"--{key.replace('_', '-')}={str(v[0] if isinstance(v, list) else v)}" for key, v in options.items()]
    program("identify", *command, "--out", tmp_path / "cli", "--quiet")
    assert (tmp_path / "out/parameters.csv").read_bytes() == (tmp_path / "cli/parameters.csv").read_bytes()
    subject = "ceinms_rt_calibrated.xml"
    assert (tmp_path / "out" / subject).read_bytes() == (tmp_path / "cli" / subject).read_bytes()
    assert {"BIC", "TRI"} <= set(fitted.parameters["muscle"]) and fitted.found["message"]
    # Both free the same numbers of the muscles; one lift is too little to tell
    # what stands beside them, and muscles.csv does not state v_max and tendon as known.
    beside = {"emg_exponent", "length_activation", "joint_torque_offset", "joint_stiffness", "joint_viscosity"}
    free = [{row["parameter"] for row in found.parameters} for found in (result, fitted)]
    assert free[0] - beside == free[1] - {"max_shortening_speed", "tendon_slack_length"} and beside & free[0]
    assert all(row["given_estimate"] is not None for row in fitted.parameters)
    assert fitted.gates and fitted.report.is_file()
    assert [trial["name"] for trial in fitted.run["trials"]] == ["MuscleAnalysis_Length"]


def test_twins_and_their_study(protocol, tmp_path):
    many = myoid.twin(protocol=protocol, out=tmp_path / "many", subjects=3, truth_only=True, seed=7)
    assert len(many.truth) == 3 and many.studies == [] and many.truth["seed"] == [7, 8, 9]
    program("twin", "--protocol", protocol, "--subjects", "3", "--truth-only", "--seed", "7", "--out", tmp_path / "cli")
    assert (tmp_path / "many/persons.csv").read_bytes() == (tmp_path / "cli/persons.csv").read_bytes()
    told = []
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", myoid.MyoidWarning)
        study = myoid.twin_study(protocol=protocol, subjects=2, progress=lambda share, what: told.append((share, what)))
    assert study.finished == 2 and study.failures == [] and study.level == "L1"
    assert len(study.summary) > 4 and {1.0, 2.0} == set(study.persons["seed"])
    assert study.predictions.columns and "2 persons" in repr(study)
    assert told and all(0 <= share <= 1 and what for share, what in told)


def test_mistakes_are_the_errors_of_the_library(recording, result, tmp_path):
    with pytest.raises(myoid.ReadError, match="no such file") as missing:
        myoid.run(tmp_path / "none.toml")
    assert missing.value.path.endswith("none.toml") and isinstance(missing.value, (ValueError, myoid.Error))
    study = tmp_path / "wrong.toml"
    study.write_text("# a study\nnmae = 1\n")
    with pytest.raises(myoid.ReadError) as wrong:
        myoid.run(study)
    assert wrong.value.line == 2
    broken = tmp_path / "broken.osim"
    broken.write_text("<OpenSimDocument")
    with pytest.raises(myoid.InvalidInput):
        myoid.Model(broken)
    with pytest.raises(myoid.ModelError, match="there are"):
        myoid.Model().muscle_kinematics({"knee": 1.0})
    with pytest.raises(myoid.InvalidInput, match="is not empty"):
        myoid.run(recording, out=result.path)
    with pytest.raises(myoid.InvalidInput, match="lowpass: found -1"):
        myoid.id(model="arm4", motion="x.mot", lowpass=-1)
    with pytest.raises(myoid.InvalidInput, match="expected one of x, y"):
        myoid.check(recording, up="upwards")
    with pytest.raises(TypeError, match="movements: expected a whole number, found str"):
        myoid.design(model="arm4", movements="two")
    with pytest.raises(TypeError, match="unexpected keyword"):
        myoid.run(recording, no_such=1)
    with pytest.raises(myoid.InvalidInput, match="parameters.csv"):
        myoid.Result(tmp_path)
    with pytest.raises(myoid.InvalidInput, match="after start"):
        myoid.check(recording, start=2, end=1)


def test_ctrl_c_stops_a_call_and_leaves_no_folder(protocol, tmp_path):
    signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell's job in the background ignores it
    threading.Timer(0.5, _thread.interrupt_main).start()
    begin = time.monotonic()
    with pytest.raises(KeyboardInterrupt), warnings.catch_warnings():
        warnings.simplefilter("ignore", myoid.MyoidWarning)
        myoid.twin(protocol=protocol, subjects=1000000, truth_only=True, out=tmp_path / "many")
    assert time.monotonic() - begin < 20
    assert not (tmp_path / "many").exists()


def test_a_listener_that_fails_stops_the_call(recording):
    def listen(share, what):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"), warnings.catch_warnings():
        warnings.simplefilter("ignore", myoid.MyoidWarning)
        myoid.run(recording, progress=listen)
    turned = dict(model="arm4", markers=recording.parent / "lift.trc", up="z")
    with pytest.warns(myoid.MyoidWarning):
        found = myoid.ik(**turned)
    assert any(remark.severity == "warning" for remark in found.remarks)
    with pytest.raises(myoid.MyoidWarning), warnings.catch_warnings():
        warnings.simplefilter("error", myoid.MyoidWarning)
        myoid.ik(**turned)


def test_other_threads_go_on_while_a_call_works(recording):
    ticks = []
    stop = threading.Event()

    def tick():
        while not stop.wait(0.01):
            ticks.append(time.monotonic())

    thread = threading.Thread(target=tick)
    thread.start()
    begin = time.monotonic()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", myoid.MyoidWarning)
        myoid.run(recording, threads=1)
    end = time.monotonic()
    stop.set()
    thread.join()
    inside = sum(begin < t < end for t in ticks)
    assert inside >= 3, "the lock of Python is released"

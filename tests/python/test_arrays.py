"""Twenty things that people write: values in, values out, by the module that is installed or built."""

import _thread
import copy
import json
import pickle
import signal
import threading
import warnings
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from conftest import SOURCE, program

import myoid

pytestmark = pytest.mark.filterwarnings("ignore::myoid.MyoidWarning")


@pytest.fixture(scope="module")
def model(recording):
    return myoid.Model(recording.parent / "model.osim")


@pytest.fixture(scope="module")
def angles(recording, model):
    return myoid.ik(model=model, markers=recording.parent / "lift.trc").angles


def plotting():
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    return matplotlib


def equal(a, b):
    """Two series of the same numbers, to the last bit."""
    assert a.channels == b.channels and a.units == b.units
    np.testing.assert_array_equal(a.time, b.time)
    np.testing.assert_array_equal(a.values, b.values)


def alike(a, b):
    """Angles of markers and of the same markers, whose positions in mm may differ in the last bit."""
    assert a.channels == b.channels and a.units == b.units
    np.testing.assert_allclose(a.values, b.values, rtol=0, atol=1e-8)


def test_01_read(recording):
    trial = myoid.read(recording.parent / "lift.trc")
    markers = trial.markers
    name = markers.names[0]
    assert np.asarray(markers).shape == (len(markers), len(markers.names), 3)
    np.testing.assert_array_equal(markers[10:20][name], markers[name][10:20])
    assert list(markers) == markers.names and dict(markers)[name].shape == (len(markers), 3)
    assert markers.between(0.1, 0.2).time[0] >= 0.1 and markers[[name]].names == [name]
    emg = myoid.read_series(recording.parent / "lift_emg.sto")
    assert np.array(emg).shape == emg.values.shape and np.mean(emg) == emg.values.mean()
    assert emg[["BIC"]].channels == ["BIC"] and list(emg) == emg.channels
    loud = emg[emg["BIC"] > 0]
    assert 0 < len(loud) < len(emg) and loud["BIC"].min() > 0
    with pytest.raises(TypeError, match="series.values"):
        emg[3]
    with pytest.raises(myoid.InvalidInput, match="samples x channels"):
        myoid.TimeSeries([0, 1], [[1.0]], ["a"], ["N"])


def test_02_plot(result, tmp_path):
    plotting()
    predicted = myoid.predict(result, trials="lift")
    forest = myoid.plot.forest(result)
    assert forest.get_xlabel() and len(forest.get_yticks()) > 5
    force = myoid.plot.forest(result, parameter="max_isometric_force", reading="given")
    assert force.get_xlabel() == "max_isometric_force [N]"
    torque = myoid.plot.torque(predicted, "elbow_flexion")
    assert torque.get_ylabel() == "torque of elbow_flexion [N m]" and torque.get_xlabel() == "time [s]"
    curves = myoid.plot.curves(result.trials["lift"]["ik"])
    assert "elbow_flexion [rad]" in [text.get_text() for text in curves.get_legend().get_texts()]
    carpet = myoid.plot.carpet(result.trials["lift"]["activation"])
    assert carpet.images[0].get_array().shape[1] == len(result.trials["lift"]["activation"])
    assert myoid.plot.forest(result, ax=force) is force
    for i, axes in enumerate((forest, force, torque, curves, carpet)):
        axes.figure.savefig(tmp_path / f"{i}.png")
        assert (tmp_path / f"{i}.png").stat().st_size > 5000
    with pytest.raises(myoid.InvalidInput, match="joint"):
        myoid.plot.torque(predicted, "knee")


def test_03_ik_takes_markers_of_every_kind(recording, model, angles):
    trial = myoid.read(recording.parent / "lift.trc")
    equal(myoid.ik(model=model, markers=trial).angles, angles)
    alike(myoid.ik(model=model, markers=trial.markers).angles, angles)
    by_name = {name: trial.markers[name] for name in trial.markers}
    alike(myoid.ik(model=model, markers={"time": trial.markers.time, **by_name}).angles, angles)
    alike(myoid.ik(model=model, markers=trial.markers[:20]).angles, angles[:20])
    with pytest.raises(myoid.InvalidInput, match="names of markers"):
        myoid.ik(model=model, markers=trial.markers.positions)


def test_03_ik_takes_pandas_and_pyomeca(recording, model, angles):
    pytest.importorskip("pandas")
    pytest.importorskip("xarray")
    markers = myoid.read(recording.parent / "lift.trc").markers
    alike(myoid.ik(model=model, markers=markers.to_pandas()).angles, angles)
    alike(myoid.ik(model=model, markers=markers.to_xarray()).angles, angles)


def test_04_id_takes_motions_of_every_kind(model, angles, tmp_path):
    forces = myoid.id(model=model, motion=angles, lowpass=6).forces
    pickled = pickle.loads(pickle.dumps(angles))
    equal(myoid.id(model=model, motion=pickled, lowpass=6).forces, forces)
    equal(myoid.id(model=model, motion={"time": angles.time, **dict(angles)}, lowpass=6).forces, forces)
    # The same as from a file of the program, which has degrees.
    file = tmp_path / "q.csv"
    with pytest.raises(myoid.InvalidInput, match="motion"):
        myoid.id(model=model, motion=np.asarray(angles))
    assert not file.exists() and set(forces.units) <= {"N m", "N"}
    with pytest.raises(myoid.InvalidInput, match="no times"):
        myoid.id(model=model, motion=dict(angles))


def test_04_id_takes_pandas(model, angles):
    pandas = pytest.importorskip("pandas")
    forces = myoid.id(model=model, motion=angles, lowpass=6).forces
    equal(myoid.id(model=model, motion=angles.to_pandas(), lowpass=6).forces, forces)
    equal(myoid.id(model=model, motion=angles.to_xarray(), lowpass=6).forces, forces)
    degrees = pandas.DataFrame(np.degrees(angles.values), index=angles.time, columns=angles.channels)
    degrees.index.name = "time"
    degrees.attrs["units"] = "deg"
    found = myoid.id(model=model, motion=degrees, lowpass=6).forces
    np.testing.assert_allclose(found.values, forces.values, rtol=1e-9, atol=1e-9)


def test_05_emg_takes_arrays(recording):
    file = recording.parent / "lift_emg.sto"
    raw = myoid.read_series(file)
    wanted = myoid.emg(file, unit="V").activations[0]
    found = myoid.emg(np.asarray(raw), rate=raw.rate, channel=raw.channels, unit="V")
    assert found.activations[0].channels == wanted.channels
    np.testing.assert_allclose(found.activations[0].values, wanted.values, rtol=1e-6, atol=1e-9)
    one = myoid.emg(1e3 * raw["BIC"], rate=raw.rate, unit="mV")
    assert one.activations[0].channels == ["inputs"] and one.normalisation[0]["reference_from"] == "inputs"
    two = myoid.emg([raw, raw[::1]], mvc=raw, unit="V")
    assert len(two.activations) == 2
    with pytest.raises(myoid.InvalidInput, match="rate"):
        myoid.emg(raw["BIC"], unit="V")


def test_06_moment_arms_over_an_angle(model):
    swept = myoid.sweep(model=model, coordinate="elbow_flexion", over=(0.2, 2.0))
    assert swept.unit == "rad" and swept.values[0] == pytest.approx(0.2) and swept.values[-1] == pytest.approx(2.0)
    by_model = model.moment_arms("elbow_flexion", {"elbow_flexion": swept.values})
    for muscle, arm in swept.moment_arm.items():
        np.testing.assert_allclose(arm, by_model[muscle], atol=1e-12)
    plotting()
    assert myoid.plot.curves(swept).get_xlabel() == "elbow_flexion [rad]"
    assert myoid.plot.curves(swept, "full_force", channels=["BIC"]).get_ylabel() == "full force [N]"


def test_07_run_and_08_parameters(result):
    row = result.parameter("BIC", "max_isometric_force")
    assert row["ci_low"] < row["estimate"] < row["ci_high"]
    for row in result.parameters.where(method="torque", verdict="identified"):
        assert row["estimate"] is not None
    assert len(result.parameters[:3]) == 3


def test_07_gates_of_an_opened_folder(result, tmp_path):
    gates = myoid.Result(result.path).gates
    assert gates == result.gates and {gate["status"] for gate in gates} <= {"pass", "warn", "fail", "info"}
    copied = result.save(tmp_path / "copied")
    (copied / "report.json").unlink()
    assert myoid.Result(copied).gates is None


def test_09_both_readings(result):
    rows = result.parameters.where(method="torque", parameter="max_isometric_force")
    assert len(rows) >= 2
    for row in rows:
        assert row["ci_low"] < row["estimate"] < row["ci_high"]
        assert row["given_ci_low"] < row["given_estimate"] < row["given_ci_high"]
        assert (row["given_ci_low"], row["given_ci_high"]) != (row["ci_low"], row["ci_high"])


def test_10_draws(result):
    draws = result.draws
    assert np.asarray(draws).shape == (len(draws), len(draws.names))
    assert list(draws) == draws.names and len(draws[:50]) == 50
    ratio = draws["BIC.max_isometric_force"] / draws["TRI.max_isometric_force"]
    assert np.average(ratio, weights=draws.weights) > 0


def test_11_two_persons(recording, protocol, tmp_path):
    other = myoid.twin(protocol=protocol, out=tmp_path / "other", seed=2).study
    (tmp_path / "persons.csv").write_text(f"name,study\nA,{recording}\nB,{other}\n")
    both = myoid.cohort(tmp_path / "persons.csv", out=tmp_path / "cohort", jobs=2)
    assert both.persons["person"] == ["A", "B"] and both.report.is_file()
    assert {"done", "gate_failed"} >= set(both.persons["outcome"])
    results = both.results
    assert list(results) == ["A", "B"] and set(both.parameters["person"]) == {"A", "B"}
    compared = myoid.compare(results["A"], results["B"])
    assert len(compared.parameters) > 3
    page = myoid.report(group=[results["A"], results["B"]], out=tmp_path / "group")
    assert page == tmp_path / "group" / "report.html" and page.is_file()
    again = myoid.cohort(tmp_path / "persons.csv", out=tmp_path / "cohort")
    assert again.persons["reused"] == [True, True]
    start = myoid.cohort(tmp_path / "persons.csv", out=tmp_path / "cohort", workflow="parallel").start
    assert start.endswith("workflow/run.sh")


def test_12_predict(result):
    predicted = myoid.predict(result, trials="lift")
    assert predicted.scores[0]["trial"] == "lift"


@pytest.mark.parametrize("of", ["result", "angles", "draws", "recording", "model", "activation"])
def test_13_joblib_and_14_pickle(of, result, recording, model, angles, tmp_path):
    thing = {"result": result, "angles": angles, "draws": result.draws, "model": model,
             "recording": myoid.read(recording.parent / "lift.trc"),
             "activation": myoid.emg(recording.parent / "lift_emg.sto", unit="V")}[of]  # fmt: skip
    for other in (pickle.loads(pickle.dumps(thing)), copy.copy(thing), copy.deepcopy(thing)):
        assert repr(other) == repr(thing) or of == "activation"
    try:
        import joblib
    except ModuleNotFoundError:
        return
    joblib.dump(thing, tmp_path / "thing.joblib")
    assert type(joblib.load(tmp_path / "thing.joblib")) is type(thing)


def test_13_joblib_in_processes(recording, model, angles):
    joblib = pytest.importorskip("joblib")
    jobs = (joblib.delayed(myoid.ik)(model=model, markers=recording.parent / "lift.trc") for _ in range(2))
    for found in joblib.Parallel(n_jobs=2)(jobs):
        equal(found.angles, angles)


def test_15_threads(recording, model, angles):
    markers = myoid.read(recording.parent / "lift.trc").markers
    with ThreadPoolExecutor(4) as pool:
        for found in pool.map(lambda _: myoid.ik(model=model, markers=markers, progress=False), range(4)):
            alike(found.angles, angles)


def test_16_errors(recording, model, tmp_path):
    missing = tmp_path / "none"
    calls = [
        lambda: myoid.read(missing.with_suffix(".c3d")), lambda: myoid.read_series(missing.with_suffix(".sto")),
        lambda: myoid.Model(missing.with_suffix(".osim")), lambda: myoid.run(missing.with_suffix(".toml")),
        lambda: myoid.ik(model=model, markers=missing.with_suffix(".trc")),
        lambda: myoid.id(model=model, motion=missing.with_suffix(".mot")),
        lambda: myoid.id(model=missing, motion=missing.with_suffix(".mot")),
        lambda: myoid.emg(missing.with_suffix(".csv")), lambda: myoid.Result(missing),
        lambda: myoid.scale(missing.with_suffix(".xml")), lambda: myoid.check(missing.with_suffix(".toml")),
        lambda: myoid.settings(missing.with_suffix(".toml")),
        lambda: myoid.cohort(missing.with_suffix(".csv"), out=tmp_path / "cohort"),
    ]  # fmt: skip
    for call in calls:
        with pytest.raises(FileNotFoundError) as failure:
            call()
        assert isinstance(failure.value, myoid.MissingFileError) and str(missing) in str(failure.value)
        again = pickle.loads(pickle.dumps(failure.value))
        assert str(again) == str(failure.value) and again.filename == failure.value.filename
    motion = recording.parent / "lift.trc"
    calls = [
        lambda: myoid.id(model="arm4", motion="m.mot", lowpass=3, speeds="s.sto"),
        lambda: myoid.simulate(excite={"BIC": 0.1}, excitations="e.sto"),
        lambda: myoid.sweep(model="arm4", coordinate="knee"), lambda: myoid.so(model="arm4", motion=motion, tendon="x"),
        lambda: myoid.run(recording, out=recording.parent), lambda: myoid.emg([motion, motion], out=tmp_path / "x"),
    ]  # fmt: skip
    for call in calls:
        with pytest.raises(myoid.InvalidInput) as failure:
            call()
        assert " --" not in str(failure.value) and not str(failure.value).startswith("--")
    gap = myoid.TimeSeries([0.0, 0.1, 0.2], [[1.0], [np.nan], [1.0]], ["elbow_flexion"], ["rad"])
    with pytest.raises(myoid.InvalidInput, match="^motion: "):
        myoid.id(model="arm4", motion=gap)


@pytest.mark.parametrize(
    "motion",
    [
        {"time": np.arange(9)[::-1], "elbow_flexion": np.ones(9)}, {"time": np.arange(5), "elbow_flexion": np.ones(9)},
        {"time": np.arange(9), "elbow_flexion": 1j * np.ones(9)}, {"time": np.arange(9)},
        {"time": [], "elbow_flexion": []}, {"time": np.arange(9), "elbow_flexion": ["a"] * 9},
        {"time": np.arange(9), "elbow_flexion": np.ones((9, 2))},
        {"time": np.arange(9), "elbow_flexion": np.full(9, np.inf)}, np.ones((9, 4)), object(), b"q.mot",
        {"time": np.arange(9).astype("datetime64[s]"), "elbow_flexion": np.ones(9)},
    ],
)  # fmt: skip
def test_16_values_that_are_no_motion(motion):
    with pytest.raises(myoid.InvalidInput, match="^motion: "):
        myoid.id(model="arm4", motion=motion)


def test_16_spans_of_time_are_seconds():
    time, angle = np.linspace(0, 1, 101), np.linspace(0.5, 1.0, 101)
    spans = (1e9 * time).round().astype("timedelta64[ns]")
    forces = myoid.id(model="arm4", motion={"time": spans, "elbow_flexion": angle}).forces
    np.testing.assert_allclose(forces.time, time, rtol=0, atol=1e-9)
    with pytest.raises(myoid.InvalidInput, match="over"):
        myoid.sweep(model="arm4", coordinate="elbow_flexion", over=(1, 0))


def test_17_messages_speak_python():
    from myoid._speech import in_python

    assert in_python("give --overwrite to replace it, or another --out") == (
        "give overwrite=True to replace it, or another out"
    )
    assert in_python("`myoid info a.osim --compare-compat` lists them, --compat opensim reproduces") == (
        "`myoid.info('a.osim', compare_compat=True)` lists them, compat opensim reproduces"
    )
    assert in_python("give them one (myoid convert --rate)") == "give them one (myoid.convert, rate)"
    assert in_python("--from: a project; a -- b, x--y") == "from_: a project; a -- b, x--y"


def test_18_ctrl_c(protocol, tmp_path):
    signal.signal(signal.SIGINT, signal.default_int_handler)
    threading.Timer(0.3, _thread.interrupt_main).start()
    with pytest.raises(KeyboardInterrupt):
        myoid.twin(protocol=protocol, subjects=1000000, truth_only=True, out=tmp_path / "many")
    assert not (tmp_path / "many").exists()


def test_19_notebook(result, recording, model, angles):
    shown = {"result": result, "angles": angles, "model": model, "draws": result.draws,
             "recording": myoid.read(recording.parent / "lift.trc"), "table": result.parameters}  # fmt: skip
    for name, thing in shown.items():
        page = thing._repr_html_()
        assert "<table>" in page and len(page) < 60_000, name
    assert "rad" in angles._repr_html_() and result.parameters[:1]._repr_html_().count("<tr>") == 2


def test_19_results_of_calls_fit_one_screen(result, recording, model, angles, tmp_path):
    shown = {
        "emg": myoid.emg(recording.parent / "lift_emg.sto", unit="V"),
        "ik": myoid.ik(model=model, markers=recording.parent / "lift.trc"),
        "paths": myoid.paths(model=model, motion=angles), "so": myoid.so(model=model, motion=angles, lowpass=6),
        "sweep": myoid.sweep(model=model, coordinate="elbow_flexion"),
        "compare": myoid.compare(result, result.save(tmp_path / "copy")), "check": myoid.check(recording),
        "simulate": myoid.simulate(excite={"BIC": 0.1}, end=0.1),
        "kinematics": model.muscle_kinematics({"elbow_flexion": np.linspace(0, 2, 500)}),
        "init": myoid.init(tmp_path / "new", from_=recording.parent, model=recording.parent / "model.osim"),
    }  # fmt: skip
    for name, thing in shown.items():
        lines = repr(thing).splitlines()
        assert len(lines) <= 24 and max(map(len, lines)) <= 140, name
        assert "<table>" in thing._repr_html_() and len(thing._repr_html_()) < 60_000, name
    assert "elbow_flexion" in repr(shown["sweep"]) and "[m]" not in repr(shown["check"])
    assert "muscle" in shown["compare"]._repr_html_() and "TimeSeries" in repr(shown["emg"])


def test_20_settings_and_init(recording, tmp_path):
    reference = myoid.settings(table="emg")
    assert any(row["key"] == "lowpass_hz" for row in reference["settings"])
    emg = myoid.settings(recording)["emg"]
    assert "lowpass_hz" in emg and emg == json.loads(program("check", recording, "--defaults", "--json"))["emg"]
    with pytest.raises(myoid.InvalidInput, match="emg"):
        myoid.settings(table="none")
    drafted = myoid.init(tmp_path / "new", from_=recording.parent, model=recording.parent / "model.osim")
    assert drafted.study == tmp_path / "new" / "study.toml" and drafted.study.is_file()
    assert isinstance(drafted.todo, list) and drafted.remarks is not None
    with pytest.raises(myoid.InvalidInput, match="overwrite=True"):
        myoid.init(tmp_path / "new", from_=recording.parent)


def test_angles_are_in_radians_on_the_way_in():
    options = dict(excite={"BIC": 0.1}, end=0.1)
    found = myoid.simulate(initial={"elbow_flexion": 1.0}, initial_speed={"elbow_flexion": 0.5}, **options)
    assert found.motion["elbow_flexion"][0] == pytest.approx(1.0, abs=1e-12)
    assert found.motion["elbow_flexion_speed"][0] == pytest.approx(0.5, abs=1e-12)


def test_identify_from_values(result, tmp_path):
    lift = result.trials["lift"]
    rows = [
        {"muscle": "BIC", "emg": "BIC", "max_isometric_force": 1060, "optimal_fiber_length": 0.1224,
         "force_length_width": 0.055, "concentric_curvature": 0.28, "eccentric_curvature_product": 0.058,
         "eccentric_plateau": 1.4, "max_shortening_speed": 1.22, "tendon_slack_length": 0.21},
        {"muscle": "TRI", "emg": "TRI", "max_isometric_force": 2047, "optimal_fiber_length": 0.1217,
         "force_length_width": 0.0548, "concentric_curvature": 0.28, "eccentric_curvature_product": 0.058,
         "eccentric_plateau": 1.4, "max_shortening_speed": 1.22, "tendon_slack_length": 0.2},
    ]  # fmt: skip
    options = dict(coordinate="elbow_flexion", method="torque")
    (tmp_path / "muscles.csv").write_text(
        ",".join(rows[0]) + "\n" + "".join(",".join(map(str, row.values())) + "\n" for row in rows)
    )
    files = myoid.identify(
        muscles=tmp_path / "muscles.csv", activations=lift.folder / "activation.sto",
        lengths=lift.folder / "MuscleAnalysis_Length.sto",
        velocities=lift.folder / "MuscleAnalysis_MuscleTendonVelocity.sto",
        moment_arms=lift.folder / "MuscleAnalysis_MomentArm_elbow_flexion.sto", torques=lift.folder / "id.sto",
        motion=lift.folder / "ik.mot", **options,
    )  # fmt: skip
    values = myoid.identify(
        muscles=rows, activations=lift["activation"], lengths=lift["MuscleAnalysis_Length"],
        velocities=[lift["MuscleAnalysis_MuscleTendonVelocity"]],
        moment_arms=lift["MuscleAnalysis_MomentArm_elbow_flexion"], torques=lift["id"], motion=lift["ik"], **options,
    )  # fmt: skip
    found, wanted = values.parameters, files.parameters
    assert found["muscle"] == wanted["muscle"] and found["parameter"] == wanted["parameter"]
    # The motion's file has rounded degrees.
    for a, b in zip(found["estimate"], wanted["estimate"]):
        assert a == pytest.approx(b, rel=1e-4, abs=1e-9)
    assert len(pickle.loads(pickle.dumps(values)).parameters) == len(found)


def test_muscle_from_values(tmp_path):
    time = np.linspace(0, 1, 101)
    toml = SOURCE / "examples/rat_soleus/muscle.toml"
    length = {"time": time, "length": 0.037 + 0.002 * np.sin(6 * time)}
    found = myoid.muscle(muscle=toml, length=length, activation=0.5)
    assert found.finished
    measured = {"time": found.series.time, "force": found.series["tendon_force"]}
    fitted = myoid.muscle(muscle=toml, length=length, activation=0.5, measured=measured, fit="max_isometric_force")
    assert fitted.estimates[0]["estimate"] == pytest.approx(fitted.estimates[0]["start"], rel=1e-4)


def test_convert_writes_values(angles, recording, tmp_path):
    (file,) = myoid.convert(angles, tmp_path / "q.csv")
    back = myoid.read_series(file)
    np.testing.assert_array_equal(back.values, angles.values)
    markers = myoid.read(recording.parent / "lift.trc").markers
    myoid.convert(markers, tmp_path / "m.trc")
    # The product and the quotient by 1000 are rounded once each.
    np.testing.assert_allclose(myoid.read(tmp_path / "m.trc").markers.positions, markers.positions, rtol=5e-16)


def test_warnings_go_to_the_line_of_the_caller(recording):
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        myoid.ik(model="arm4", markers=myoid.read(recording.parent / "lift.trc").markers, up="z")
    assert caught and all(w.filename == __file__ for w in caught)
    assert not any("/myoid." in str(w.message) for w in caught)

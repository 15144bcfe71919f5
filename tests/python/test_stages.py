"""Stages: recordings, models, EMG, motion, torques, paths, forces, single muscles, simulations, tools of OpenSim."""

import gc
import json

import numpy as np
import pytest
from conftest import SOURCE, program

import myoid


def same_series(series, file):
    """The series is in the file, which holds rounded or shortest texts of the same numbers."""
    written = myoid.read_series(file)
    assert written.channels == series.channels
    np.testing.assert_allclose(written.time, series.time, rtol=0, atol=1e-9)
    np.testing.assert_allclose(written.values, series.values, rtol=1e-9, atol=1e-12)


def numbers(file):
    """The file below its header, which names the call."""
    return file.read_bytes().split(b"endheader")[1]


def test_read_markers_and_emg_of_the_twin(recording):
    folder = recording.parent
    trc = myoid.read(folder / "lift.trc")
    assert trc.markers.positions.shape == (len(trc.markers), len(trc.markers.names), 3)
    name = trc.markers.names[0]
    assert trc.markers[name].shape == (len(trc.markers), 3) and name in trc.markers
    text = (folder / "lift.trc").read_text().splitlines()[6].split("\t")
    np.testing.assert_allclose(trc.markers.positions[0, 0], np.array(text[2:5], float) / 1000, rtol=1e-12)
    emg = myoid.read_series(folder / "lift_emg.sto")
    assert "BIC" in emg and emg.rate > 500 and len(emg) == emg.values.shape[0]
    with pytest.raises(KeyError, match="there are"):
        emg["none"]


def test_arrays_show_the_library_s_own_memory_and_keep_it(recording):
    series = myoid.read_series(recording.parent / "lift_emg.sto")
    assert not series.values.flags.owndata and series.values.flags.f_contiguous
    values, total = series.values, float(series.values.sum())
    del series
    gc.collect()
    assert float(values.sum()) == total


def test_c3d_files_equal_convert(data, tmp_path):
    readable = 0
    for file in sorted((data / "c3d").rglob("*.c3d")):
        try:
            read = myoid.read(file)
        except myoid.ReadError:
            assert "error" in program("convert", file, tmp_path / "x.trc", "--overwrite", fails=True, stderr=True)
            continue
        readable += 1
        assert read.path == str(file) and "markers" in repr(read)
        if read.markers.names:
            program("convert", file, tmp_path / "x.trc", "--overwrite", "--quiet")
            written = myoid.read(tmp_path / "x.trc").markers
            assert [n.replace(" ", "_") for n in read.markers.names] == written.names
            # The file has millimetres: the product and the quotient by 1000 are rounded once each.
            np.testing.assert_allclose(written.positions, read.markers.positions, rtol=5e-16, atol=0)
        if len(read.analog):
            program("convert", file, tmp_path / "x.csv", "--what", "channels", "--overwrite", "--quiet")
            written = myoid.read_series(tmp_path / "x.csv")
            assert written.channels == read.analog.channels
            np.testing.assert_array_equal(written.values, read.analog.values)
        assert set(read.analog.channels) <= set(read.units)
        assert myoid.info(file) == json.loads(program("info", file, "--json"))[0]
        for plate in read.plates:
            assert plate.force.shape == plate.moment.shape == (len(plate.time), 3) and plate.corners.shape == (4, 3)
        assert all(event.time >= 0 or event.label for event in read.events)
        assert isinstance(read.notes, list) and isinstance(read.other_clocks, list)
    assert readable >= 10


def test_emg_of_a_c3d_is_in_volts(data):
    found = 0
    for file in sorted((data / "c3d").rglob("*.c3d"))[:40]:
        try:
            emg = myoid.read(file).emg
        except myoid.ReadError:
            continue  # some files of the set are damaged
        found += bool(emg.channels)
        assert set(emg.units) <= {"V"}
    assert found


def test_convert_writes_what_the_program_writes(recording, tmp_path):
    source = recording.parent / "lift_emg.sto"
    files = myoid.convert(source, tmp_path / "a.csv")
    program("convert", source, tmp_path / "b.csv", "--quiet")
    assert files == [tmp_path / "a.csv"] and files[0].read_bytes() == (tmp_path / "b.csv").read_bytes()
    with pytest.raises(myoid.InvalidInput, match="exists"):
        myoid.convert(source, tmp_path / "a.csv")
    model = recording.parent / "model.osim"
    files = myoid.convert(model, tmp_path / "a.osim", compat="opensim")
    program("convert", model, tmp_path / "b.osim", "--compat", "opensim", "--quiet")
    assert files == [tmp_path / "a.osim"] and files[0].read_bytes() == (tmp_path / "b.osim").read_bytes()


def test_info_of_the_arm():
    assert myoid.info("arm4")["kind"] == json.loads(program("info", "arm4", "--json"))[0]["kind"]


def test_model_moment_arms_are_the_derivatives_of_lengths():
    arm = myoid.Model("arm4")
    assert "elbow_flexion" in arm.coordinates and {"BIC", "TRI"} <= set(arm.muscles)
    assert arm.coordinates["elbow_flexion"].unit == "rad" and arm.muscles["BIC"].max_isometric_force > 100
    assert arm.bodies and arm.markers and arm.unsupported == [] and isinstance(arm.notes, list)
    h = 1e-5
    angles = np.array([1.0 - h, 1.0, 1.0 + h])
    found = arm.muscle_kinematics({"elbow_flexion": angles}, speeds={"elbow_flexion": 2.0})
    slope = (found.length[2] - found.length[0]) / (2 * h)
    # Truncation and round-off of the central difference are below 1e-7 m.
    np.testing.assert_allclose(found.moment_arm["elbow_flexion"][1], -slope, atol=1e-7)
    np.testing.assert_allclose(found.velocity[1], 2.0 * slope, atol=1e-6)
    assert arm.lengths({"elbow_flexion": 1.0}) == dict(zip(found.muscles, found.length[1]))
    assert arm.moment_arms("elbow_flexion", {"elbow_flexion": 1.0})["BIC"] > 0.01
    # Arrays give arrays: a number for each posture, whatever the length of the array.
    angles = [0.5, 1.0, 1.5]
    arms, lengths = arm.moment_arms("elbow_flexion", {"elbow_flexion": angles}), arm.lengths({"elbow_flexion": angles})
    for i, angle in enumerate(angles):
        one = {"elbow_flexion": angle}
        assert arms["BIC"][i] == arm.moment_arms("elbow_flexion", one)["BIC"]
        assert lengths["TRI"][i] == arm.lengths(one)["TRI"]
    assert arms["BIC"].shape == (3,) and arm.lengths({"elbow_flexion": [1.0]})["BIC"].shape == (1,)
    with pytest.raises(myoid.InvalidInput, match="expected 3"):
        arm.muscle_kinematics({"elbow_flexion": angles, "shoulder_flexion": [0.0, 1.0]})
    with pytest.raises(myoid.ModelError, match="there are about"):
        arm.moment_arms("knee")
    assert "4 muscles" in repr(arm)


@pytest.fixture(scope="module")
def motion(recording, tmp_path_factory):
    """The joint angles of the lift, and their result."""
    out = tmp_path_factory.mktemp("ik") / "ik.mot"
    folder = recording.parent
    found = myoid.ik(model=folder / "model.osim", markers=folder / "lift.trc", out=out)
    return out, found


def test_ik_id_paths_so_are_the_program_s(recording, motion, tmp_path):
    model, file = recording.parent / "model.osim", motion[0]
    found = motion[1]
    program("ik", "--model", model, "--markers", recording.parent / "lift.trc", "--out", tmp_path / "ik.mot", "--quiet")
    assert numbers(file) == numbers(tmp_path / "ik.mot")
    assert found.angles.unit("elbow_flexion") == "rad" and found.marker_error_rms < 0.01 and not found.wrong_unit
    written = myoid.read_series(file)
    assert written.unit("elbow_flexion") == "rad"
    np.testing.assert_allclose(found.angles["elbow_flexion"], written["elbow_flexion"], atol=1e-8)
    assert found.frames_not_converged == found.frames_without_markers == 0 and "marker_error_RMS" in found.marker_errors

    torque = myoid.id(model=model, motion=file, lowpass=6, out=tmp_path / "id.sto", held_mass=1,
                      held_body="forearm_hand", held_at=[0, -0.3, 0])  # fmt: skip
    program("id", "--model", model, "--motion", file, "--lowpass", "6", "--held-mass", "1", "--held-body",
            "forearm_hand", "--held-at", "0", "-0.3", "0", "--out", tmp_path / "id_cli.sto", "--quiet")  # fmt: skip
    assert (tmp_path / "id.sto").read_bytes() == (tmp_path / "id_cli.sto").read_bytes()
    same_series(torque.forces, tmp_path / "id.sto")

    muscles = myoid.paths(model=model, motion=file, lowpass=6, out=tmp_path / "paths")
    same_series(muscles.length, tmp_path / "paths/MuscleAnalysis_Length.sto")
    same_series(muscles.moment_arm["elbow_flexion"], tmp_path / "paths/MuscleAnalysis_MomentArm_elbow_flexion.sto")
    assert muscles.velocity.unit("BIC") == "m/s"

    # Over the angle, at the motion's own: the same paths.
    swept = myoid.sweep(model=model, coordinate="elbow_flexion=10:130", muscle=["BIC", "TRI"], out=tmp_path / "sweep")
    assert swept.coordinate == "elbow_flexion" and set(swept.moment_arm) == {"BIC", "TRI"}
    assert (tmp_path / "sweep/sweep_elbow_flexion.svg").is_file()
    np.testing.assert_allclose(-np.gradient(swept.length["BIC"], swept.values)[1:-1], swept.moment_arm["BIC"][1:-1],
                               atol=1e-4)  # fmt: skip
    assert all((swept.full_force[m] >= swept.passive_force[m]).all() for m in swept.full_force)

    shared = myoid.so(model=model, motion=file, lowpass=6, coordinate="elbow_flexion", out=tmp_path / "so")
    written = myoid.read_series(tmp_path / "so/StaticOptimization_force.sto")
    for muscle in shared.force.channels:
        np.testing.assert_allclose(shared.force[muscle], written[muscle], rtol=1e-9, atol=1e-12)
    assert len(shared.status) == len(shared.force) == len(shared.kkt_residual)
    assert shared.frames_not_solved == 0 and shared.activation.values.max() <= 1.0 and shared.reserve.channels
    with pytest.raises(myoid.InvalidInput, match="stress"):
        myoid.so(model=model, motion=file, objective="pain")


def test_weights_are_a_dict_or_texts(recording):
    folder = recording.parent
    name = myoid.read(folder / "lift.trc").markers.names[0]
    options = dict(model=folder / "model.osim", markers=folder / "lift.trc", end=0.5)
    one = myoid.ik(**options, weight={name: 2.5})
    other = myoid.ik(**options, weight=[f"{name}=2.5"])
    np.testing.assert_array_equal(one.angles.values, other.angles.values)
    with pytest.raises(myoid.InvalidInput, match="none"):
        myoid.ik(**options, weight={"none": 1})


def test_emg_is_the_program_s(recording, tmp_path):
    folder = recording.parent
    found = myoid.emg(folder / "lift_emg.sto", mvc=folder / "mvc_emg.sto", out=tmp_path / "a.sto")
    program("emg", folder / "lift_emg.sto", "--mvc", folder / "mvc_emg.sto", "--out", tmp_path / "b.sto", "--quiet")
    assert (tmp_path / "a.sto").read_bytes() == (tmp_path / "b.sto").read_bytes()
    same_series(found.activations[0], tmp_path / "a.sto")
    assert set(found.envelopes[0].units) == {"V"} and found.methods and found.steps and found.whitening_reason
    assert found.normalisation[0]["reference_v"] > 0 and isinstance(found.whitened, bool)
    with pytest.raises(myoid.InvalidInput, match="both name"):
        myoid.emg(folder / "lift_emg.sto", out=tmp_path / "c.sto", envelope=tmp_path / "c.sto")


def test_simulate_falls_as_the_pendulum_s_energy_says(tmp_path):
    found = myoid.simulate(excite={"BIC": "0.1@0.2+0.3"}, end=0.6, energy=True, out=tmp_path / "sim",
                           sensitivity="BIC.max_isometric_force")  # fmt: skip
    program("simulate", "--excite", "BIC=0.1@0.2+0.3", "--end", "0.6", "--energy", "--sensitivity",
            "BIC.max_isometric_force", "--out", tmp_path / "cli", "--quiet")  # fmt: skip
    assert numbers(tmp_path / "sim/motion.mot") == numbers(tmp_path / "cli/motion.mot")
    assert found.finished and found.message and found.energy is not None
    assert found.excitation["BIC"].max() == pytest.approx(0.1) and len(found.motion) == 121
    work = found.energy["gravity_work"] + found.energy["gravity_energy"]
    np.testing.assert_allclose(work, work[0], atol=1e-6)
    s = found.sensitivities
    assert s["parameters"] == ["BIC.max_isometric_force"] and s["elbow_flexion"].shape == (len(s["time"]), 1)


def test_muscle_simulated_and_fitted(tmp_path):
    time = np.linspace(0, 1, 101)
    file = tmp_path / "length.sto"
    rows = "\n".join(f"{t:.17g}\t{0.037 + 0.002 * np.sin(6 * t):.17g}" for t in time)
    file.write_text(f"length\nversion=1\nnRows={len(time)}\nnColumns=2\ninDegrees=no\nendheader\ntime\tlength\n{rows}\n")
    toml = SOURCE / "examples/rat_soleus/muscle.toml"
    found = myoid.muscle(muscle=toml, length=file, activation=0.5, out=tmp_path / "force.sto")
    program("muscle", "--muscle", toml, "--length", file, "--activation", "0.5", "--out", tmp_path / "cli.sto", "--quiet")
    assert numbers(tmp_path / "force.sto") == numbers(tmp_path / "cli.sto")
    assert found.finished and found.series["tendon_force"].max() > 0 and found.estimates is None
    measured = tmp_path / "force.csv"
    rows = "\n".join(f"{t:.17g},{f:.17g}" for t, f in zip(found.series.time, found.series["tendon_force"]))
    measured.write_text(f"time,force\n{rows}\n")
    fitted = myoid.muscle(muscle=toml, length=file, activation=0.5, measured=measured, fit="max_isometric_force")
    (row,) = fitted.estimates
    # Its own force gives the starting value back.
    assert row["estimate"] == pytest.approx(row["start"], rel=1e-4) and fitted.errors[0]["fitted"] < 1e-4


@pytest.mark.filterwarnings("ignore::myoid.MyoidWarning")
def test_run_tool_and_scale(data, tmp_path):
    scaling, inverse = data / "opensim/trial_rajagopal/s05_scale.xml", data / "opensim/trial_arm26/s10_ik.xml"
    if not (scaling.is_file() and inverse.is_file()):
        pytest.skip(f"needs {scaling} and {inverse}")
    scaled = myoid.scale(scaling, out=tmp_path / "scaled")
    assert scaled.tool == "ScaleTool" and scaled.files and all(f.is_file() for f in scaled.files)
    solved = myoid.run_tool(inverse, out=tmp_path / "ik")
    assert solved.tool == "InverseKinematicsTool" and solved.good and solved.frames_failed == 0 < solved.frames
    assert all(f.parent == tmp_path / "ik" for f in solved.files)
    with pytest.raises(myoid.InvalidInput, match="no ScaleTool"):
        myoid.scale(inverse)

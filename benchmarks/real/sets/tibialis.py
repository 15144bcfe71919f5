"""tecchio-ankle: the tibialis anterior on a dynamometer, maximal stretches and fixed contractions.

Each of five trials is left out in turn. The muscle's torque is half of the torque beyond that of the relaxed ankle, as
its authors have it. The optimal fiber length is found with two generic tendons; ultrasound says 75 mm.
"""
import csv
import pathlib
import subprocess
import sys

from board import LITERATURE, Given, Row, folds, np, write

NEEDS = ("tecchio-ankle", "ceinms-rt-leg")
EXAMPLE = pathlib.Path(__file__).resolve().parents[3] / "examples/ankle_dynamometer"
EMG_HZ = 2000.0
STRETCHES = ["PL_0_01", "PL_50_01", "PL_100_01"]
FIXED = ["Ref_Long_01", "Ref_Long_02"]
HEAD = ("muscle,max_isometric_force,optimal_fiber_length,tendon_slack_length,force_length_width,concentric_curvature,"
        "eccentric_slope_ratio,eccentric_plateau,max_shortening_speed\n")


def moving_mean(x, width):
    sums = np.concatenate([[0.0], np.cumsum(x)])
    at = np.arange(len(x))
    low, high = np.maximum(0, at - width // 2), np.minimum(len(x), at + width // 2 + 1)
    return (sums[high] - sums[low]) / (high - low)


def envelope(raw):
    """Rectified about the mean and averaged over 0.2 s, twice."""
    width = int(0.2 * EMG_HZ)
    return moving_mean(moving_mean(np.abs(raw - raw.mean()), width), width)


def recorded(bench):
    """The five trials as files of `identify`."""
    ankle = bench.data / "tecchio-ankle"

    def read(name):
        return np.genfromtxt(ankle / f"{name}.csv", delimiter=",", skip_header=1)

    given = Given(bench, "ankle_angle_r")
    held = np.array([np.median(read(f"Pas_{angle}_dynamometer")[:, [2, 1]], axis=0)
                     for angle in (-15, -10, 5, 10, 20, 25)])
    relaxed = np.polyfit(held[:, 0], held[:, 1], 3)
    envelopes = {name: envelope(read(f"{name}_emg")[:, 1]) for name in STRETCHES + FIXED}
    most = max(moving_mean(e, int(0.5 * EMG_HZ)).max() for e in envelopes.values())
    for name, e in envelopes.items():
        time, torque, crank = read(f"{name}_dynamometer")[::2, :3].T
        motion = bench.folder / f"{name}.mot"
        np.savetxt(motion, np.column_stack([time, -(crank + 15.0)]), delimiter="\t", comments="", fmt="%.9g",
                   header=f"q\nversion=1\nnRows={len(time)}\nnColumns=2\ninDegrees=yes\nendheader\ntime\tankle_angle_r")
        write(bench.folder / f"{name}_a.csv", ["time", "tib_ant_r"],
              np.column_stack([np.arange(0, len(e), 10) / EMG_HZ, e[::10] / most]))
        write(bench.folder / f"{name}_t.csv", ["time", "ankle_angle_r"],
              np.column_stack([time, 0.5 * (torque - np.polyval(relaxed, crank))]))
        paths = given.paths(name, bench.data / "ceinms-rt-leg/gait2392.osim", motion)
        given.add(paths, motion, bench.folder / f"{name}_a.csv", bench.folder / f"{name}_t.csv")
    return given


def fiber_length(task, parameters):
    with parameters.open() as file:
        row = next(row for row in csv.DictReader(file) if row["parameter"] == "optimal_fiber_length")
    low, high = (1000 * float(row[key]) for key in ("ci_low", "ci_high"))
    return Row(task, "mm", 1000 * float(row["estimate"]), {"ultrasound": 75.0}, asked="holds 75",
               note=f"{low:.0f} to {high:.0f}")


def rows(bench):
    given = recorded(bench)
    others = given.baselines("ankle_angle_r", ["tib_ant_r"])
    muscles = bench.folder / "muscles.csv"
    for slack in (0.223, 0.247):
        muscles.write_text(HEAD + f"tib_ant_r,905,0.098,{slack},0.0441,0.28,1.5,1.4,0.98\n")
        found = given.left_out(muscles, "ankle_angle_r")
        if slack == 0.223:
            for name, fold, other in zip(STRETCHES + FIXED, found, others):
                yield Row(f"stretch {name}" if name in STRETCHES else f"fixed {name}", "R2", fold["identified"]["r2"], other,
                          asked=">= 0.96" if name in STRETCHES else ">= 0.9")
        yield fiber_length(f"fiber length, tendon of {1000 * slack:.0f} mm", bench.folder / "out/parameters.csv")
    yield from by_run(bench)


def by_run(bench):
    """The study of examples/, which finds the passive torque in the relaxed trials."""
    place = bench.folder / "ankle"
    subprocess.run([sys.executable, EXAMPLE / "prepare.py", bench.data / "tecchio-ankle", place], check=True)
    text = (EXAMPLE / "study.toml").read_text().replace("../../shared/data", str(bench.data))
    (place / "study.toml").write_text(text)
    bench.run("run", place / "study.toml", "--out", bench.folder / "run")
    for name, fold in folds(bench.folder / "run").items():
        yield Row(f"{name} by run", "R2", fold["identified"]["r2"], {LITERATURE: fold["literature_with_gain"]["r2"]},
                  asked=">= 0.96")
    yield from by_fascicles(bench, place, text)


def by_fascicles(bench, place, text):
    """The same study with the fascicles of all active trials; each stretch is left out in turn, with its fascicles."""
    for name in [path.name.removesuffix("_fascicle.csv") for path in place.glob("*_fascicle.csv")]:
        torque = f'external_torque = "{name}_dynamometer.csv"\n'
        text = text.replace(torque, torque + f'fascicles = "{name}_fascicle.csv"\n')
    (place / "fascicles.toml").write_text(text)
    bench.run("run", place / "fascicles.toml", "--out", bench.folder / "fascicles")
    for name, fold in folds(bench.folder / "fascicles").items():
        yield Row(f"{name}, fibers left out", "mm", 1000 * fold["fiber_length_rms_m"]["tib_ant_r"], asked="<= 3",
                  note=f"R² of the torque {fold['identified']['r2']:.3f}")
    yield fiber_length("fiber length, fascicles measured", bench.folder / "fascicles/parameters.csv")

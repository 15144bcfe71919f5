"""Shared by all sets of the scoreboard: the program, its files, rows of the table, and baselines of the same data."""
import dataclasses
import json
import pathlib
import shlex
import subprocess
import sys
import time

try:
    import numpy as np
except ImportError:
    print("skipped: numpy is not installed (Debian: python3-numpy)")
    sys.exit(77)

MEAN = "mean of the fitted trials"
REGRESSION = "regression on EMG and the joint's own terms"
LITERATURE = "the literature's muscles, one gain"


@dataclasses.dataclass
class Row:
    """A line of the scoreboard. `others`: name of each other way to predict, its value, and its source."""
    task: str
    measure: str  # "R2" is better where greater; "N m", "N" and "%" where smaller
    ours: float
    others: dict = dataclasses.field(default_factory=dict)
    asked: str = ""
    note: str = ""


@dataclasses.dataclass
class Bench:
    """The program and the folders of a set: `data` holds the recordings, `folder` is empty and the set's own."""
    program: str
    data: pathlib.Path
    folder: pathlib.Path
    said: str = ""  # by the last command, on stderr

    def run(self, *arguments):
        command = [self.program, *map(str, arguments)]
        with (self.folder / "commands.sh").open("a") as file:
            file.write(shlex.join(command) + "\n")
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode not in (0, 4):
            sys.exit(f"{self.program} {arguments[0]} ended with {done.returncode}: {done.stderr}")
        self.said = done.stderr
        return done.stdout

    def json(self, *arguments):
        return json.loads(self.run(*arguments, "--json"))


def storage(path):
    """Columns by name of a .sto, .mot or .csv file."""
    text = pathlib.Path(path).read_text().replace("endheader", "\nendheader").split("endheader")[-1].strip()
    head, *rows = text.splitlines()
    separator = "," if "," in head else None
    values = np.array([row.replace(",", " ").split() for row in rows if row.strip()], dtype=float)
    return dict(zip((name.strip() for name in head.split(separator)), values.T))


def write(path, columns, rows):
    np.savetxt(path, rows, delimiter=",", header=",".join(columns), comments="", fmt="%.9g")


def r2(measured, predicted):
    return float(1.0 - np.sum((measured - predicted) ** 2) / np.sum((measured - measured.mean()) ** 2))


def rms(values):
    return float(np.sqrt(np.mean(np.square(values))))


@dataclasses.dataclass
class Trial:
    """A trial as the baselines see it: torque and angle of the joint, and the EMG 50 ms before, on one clock."""
    torque: np.ndarray
    angle: np.ndarray
    drive: np.ndarray
    rate_hz: float

    @classmethod
    def of(cls, torque, angle, drive, rate_hz=50.0, delay_s=0.05):
        """Each argument: (time, values)."""
        first = max(torque[0][0], angle[0][0], drive[0][0] + delay_s)
        last = min(torque[0][-1], angle[0][-1], drive[0][-1])
        clock = np.arange(first, last, 1.0 / rate_hz)
        columns = np.atleast_2d(drive[1])
        return cls(np.interp(clock, *torque), np.interp(clock, *angle),
                   np.column_stack([np.interp(clock - delay_s, drive[0], column) for column in columns]), rate_hz)

    def terms(self):
        """EMG times 1, q, q^2 for each channel, and 1, q, q^2, dq/dt of the joint."""
        own = np.vander(self.angle, 3, increasing=True)
        emg = [self.drive[:, [c]] * own for c in range(self.drive.shape[1])]
        return np.column_stack([*emg, own, np.gradient(self.angle) * self.rate_hz])


def baselines(fitted, left_out):
    """R2 of the trial that was left out, by the fitted trials' mean torque and by least squares on their terms."""
    slopes, *_ = np.linalg.lstsq(np.vstack([t.terms() for t in fitted]), np.concatenate([t.torque for t in fitted]),
                                 rcond=None)
    mean = np.mean(np.concatenate([t.torque for t in fitted]))
    return {MEAN: r2(left_out.torque, np.full_like(left_out.torque, mean)),
            REGRESSION: r2(left_out.torque, left_out.terms() @ slopes)}


def folds(results, joint=None):
    """The trials that the program left out, by name, from parameters.json of a run."""
    found = json.loads((results / "parameters.json").read_text())["leave_one_trial_out"]
    return {fold["trial"]: fold for fold in found if joint is None or fold["joint"] == joint}


class Given:
    """Trials given to `identify` as files, and the fits that leave out each in turn."""

    def __init__(self, bench, coordinate):
        self.bench, self.coordinate, self.files, self.motions = bench, coordinate, [], []

    def paths(self, name, model, motion):
        folder = self.bench.folder / name
        self.bench.run("paths", "--model", model, "--motion", motion, "--lowpass", "6", "--out", folder)
        return folder

    def add(self, paths, motion, activation, torque):
        self.motions.append(motion)
        self.files.append({"--activations": activation, "--torques": torque,
                           "--lengths": paths / "MuscleAnalysis_Length.sto",
                           "--velocities": paths / "MuscleAnalysis_MuscleTendonVelocity.sto",
                           "--moment-arms": paths / f"MuscleAnalysis_MomentArm_{self.coordinate}.sto"})

    def left_out(self, muscles, coordinate, *more):
        """The folds of the fit of all trials, in their order."""
        files = [x for option in self.files[0] for x in (option, *(trial[option] for trial in self.files))]
        out = self.bench.folder / "out"
        self.bench.run("identify", "--muscles", muscles, "--coordinate", coordinate, "--out", out, "--overwrite", *more,
                       *files)
        return list(folds(out).values())

    def baselines(self, column, channels, begin=-np.inf, end=np.inf):
        """The baselines of each trial left out, by the samples between two times."""
        trials = []
        for files, motion in zip(self.files, self.motions):
            torque, angle, emg = storage(files["--torques"]), storage(motion), storage(files["--activations"])
            within = (torque["time"] >= begin) & (torque["time"] <= end)
            trials.append(Trial.of((torque["time"][within], torque[column][within]),
                                   (angle["time"], angle[self.coordinate]),
                                   (emg["time"], np.array([emg[channel] for channel in channels]))))
        return [baselines(trials[:i] + trials[i + 1:], trial) for i, trial in enumerate(trials)]


class Clock:
    """Seconds since it was made."""

    def __init__(self):
        self.begin = time.monotonic()

    def seconds(self):
        return time.monotonic() - self.begin

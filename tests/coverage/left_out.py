#!/usr/bin/env python3
"""Torque that took no part in the fit, on two public recordings: a line of figures each.

usage: left_out.py MYOID [DATA]

MYOID: the program. DATA: the folder with tecchio-ankle/ and ceinms-rt-leg/; by default MYOID_DATA, or shared/data beside
the checkout. Without them the script says so and exits with 77.

  tecchio-ankle  Three maximal stretches of the tibialis anterior and two fixed contractions; each of the five is left
                 out in turn. The muscle's torque is half of the torque beyond that of the relaxed ankle, as its authors
                 have it. R2 of at least 0.95 is expected of the stretches (0.9 to 1 of the fixed contractions).
  ceinms-rt-leg  A leg that walks at two speeds; each from the other, by five seconds and by the whole minute. The
                 subject of CEINMS-RT reaches 0.65 and 0.48 on the five seconds, and the minute must not be worse.
"""
import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile

try:
    import numpy as np
except ImportError:
    print("skipped: numpy is not installed (Debian: python3-numpy)")
    sys.exit(77)

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


def write(path, columns, rows):
    np.savetxt(path, rows, delimiter=",", header=",".join(columns), comments="", fmt="%.9g")


class Fit:
    """Files of one recording, and the fit that leaves out each trial in turn."""

    def __init__(self, program, folder):
        self.program, self.folder, self.files = program, folder, []

    def run(self, *arguments):
        done = subprocess.run([self.program, *map(str, arguments)], capture_output=True, text=True, check=False)
        if done.returncode not in (0, 4):
            sys.exit(done.stderr)

    def paths(self, name, model, motion):
        self.run("paths", "--model", model, "--motion", motion, "--lowpass", "6", "--out", self.folder / name)
        return self.folder / name

    def add(self, paths, activation, torque, coordinate):
        self.files.append({"--activations": activation, "--torques": torque,
                           "--lengths": paths / "MuscleAnalysis_Length.sto",
                           "--velocities": paths / "MuscleAnalysis_MuscleTendonVelocity.sto",
                           "--moment-arms": paths / f"MuscleAnalysis_MomentArm_{coordinate}.sto"})

    def left_out(self, muscles, coordinate, *more):
        """R2 of each trial, by the fit of the others."""
        files = [x for option in self.files[0] for x in (option, *(trial[option] for trial in self.files))]
        self.run("identify", "--muscles", muscles, "--coordinate", coordinate,
                 "--out", self.folder / "out", "--overwrite", *more, *files)
        found = json.loads((self.folder / "out/parameters.json").read_text())
        return [fold["identified"]["r2"] for fold in found["leave_one_trial_out"]]


def stretches(fit, data):
    ankle = data / "tecchio-ankle"

    def read(name):
        return np.genfromtxt(ankle / f"{name}.csv", delimiter=",", skip_header=1)

    held = np.array([np.median(read(f"Pas_{angle}_dynamometer")[:, [2, 1]], axis=0)
                     for angle in (-15, -10, 5, 10, 20, 25)])
    relaxed = np.polyfit(held[:, 0], held[:, 1], 3)
    envelopes = {name: envelope(read(f"{name}_emg")[:, 1]) for name in STRETCHES + FIXED}
    most = max(moving_mean(e, int(0.5 * EMG_HZ)).max() for e in envelopes.values())
    for name, e in envelopes.items():
        time, torque, crank = read(f"{name}_dynamometer")[::2, :3].T
        motion = fit.folder / f"{name}.mot"
        np.savetxt(motion, np.column_stack([time, -(crank + 15.0)]), delimiter="\t", comments="", fmt="%.9g",
                   header=f"q\nversion=1\nnRows={len(time)}\nnColumns=2\ninDegrees=yes\nendheader\ntime\tankle_angle_r")
        write(fit.folder / f"{name}_a.csv", ["time", "tib_ant_r"],
              np.column_stack([np.arange(0, len(e), 10) / EMG_HZ, e[::10] / most]))
        write(fit.folder / f"{name}_t.csv", ["time", "ankle_angle_r"],
              np.column_stack([time, 0.5 * (torque - np.polyval(relaxed, crank))]))
        paths = fit.paths(name, data / "ceinms-rt-leg/gait2392.osim", motion)
        fit.add(paths, fit.folder / f"{name}_a.csv", fit.folder / f"{name}_t.csv", "ankle_angle_r")
    muscles = fit.folder / "muscles.csv"
    muscles.write_text(HEAD + "tib_ant_r,905,0.098,0.223,0.0441,0.28,1.5,1.4,0.98\n")
    return dict(zip(STRETCHES + FIXED, fit.left_out(muscles, "ankle_angle_r")))


def walks(fit, data):
    leg = data / "ceinms-rt-leg"
    for walk in ("walk36", "walk45"):
        paths = fit.paths(walk, leg / "gait2392.osim", leg / walk / "ik.sto")
        fit.add(paths, leg / walk / "emgFilt.sto", leg / walk / "id.sto", "ankle_angle_r")
    return {name: fit.left_out(leg / "muscles.csv", "ankle_angle_r_moment", *part)
            for name, part in (("five seconds", ("--start", "19", "--end", "24")), ("a minute", ()))}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    beside = pathlib.Path(__file__).resolve().parents[3] / "shared/data"
    parser.add_argument("data", type=pathlib.Path, nargs="?", default=os.environ.get("MYOID_DATA", beside))
    options = parser.parse_args()
    data = pathlib.Path(options.data)
    if not all((data / part).is_dir() for part in ("tecchio-ankle", "ceinms-rt-leg")):
        print(f"needs tecchio-ankle and ceinms-rt-leg in {data}; set MYOID_DATA to the shared data folder")
        sys.exit(77)
    for name, judged in (("tecchio-ankle", stretches), ("ceinms-rt-leg", walks)):
        with tempfile.TemporaryDirectory() as folder:
            found = judged(Fit(options.program, pathlib.Path(folder)), data)
        for part, r2 in found.items():
            values = ", ".join(f"{x:.3f}" for x in np.atleast_1d(r2))
            print(f"{name}, {part}: left out, R2 {values}", flush=True)


if __name__ == "__main__":
    main()

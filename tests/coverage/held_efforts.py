#!/usr/bin/env python3
"""Held efforts of ten persons at one joint angle, and a fiber length by two generic tendons, on public recordings.

usage: held_efforts.py MYOID [DATA]

MYOID: the program. DATA: the folder with elderly-isometric/, tecchio-ankle/ and ceinms-rt-leg/; by default MYOID_DATA,
or shared/data beside the checkout. Without them the script says so and exits with 77.

  elderly-isometric  Held efforts of knee and ankle in both directions, one muscle each, constant lengths and moment
                     arms, a lever of 0.3 m (not recorded). One angle may tell no optimal fiber length; the torque of
                     each effort is asked to 10 N m.
  tecchio-ankle      The tibialis anterior with a tendon of 0.223 m (gait2392) and of 0.247 m, both generic: the
                     intervals of l_m0 must overlap and hold the 75 mm of ultrasound.
"""
import argparse
import csv
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

import left_out

MUSCLES = ("muscle,max_isometric_force,optimal_fiber_length,force_length_width,concentric_curvature,"
           "eccentric_slope_ratio,eccentric_plateau,max_shortening_speed\n"
           "E,3000,0.1,0.045,0.28,1.5,1.4,1\nF,1500,0.09,0.0405,0.28,1.5,1.4,0.9\n")
LEVER_M, GRAVITY = 0.3, 9.80665  # the load cell is in kg
TASKS = {"knee": (("knee_extension", 0, 1, 0), ("knee_flexion", 0, 1, 1)),
         "ankle": (("plantarflexion", 3, 2, 3), ("dorsiflexion", 3, 2, 2))}  # EMG of E and F, column of the load cell


def read(path):
    return np.genfromtxt(path, delimiter=",", skip_header=2)


def fit(program, folder, efforts):
    """Root mean square error [N m] of both efforts, and the verdicts of l_m0 and l_msh."""
    envelopes = [[left_out.envelope(x) for x in effort[:2]] for effort in efforts]
    most = [max(left_out.moving_mean(of[muscle], 1000).max() for of in envelopes) for muscle in range(2)]
    (folder / "muscles.csv").write_text(MUSCLES)
    files = []
    for k, (_, _, force) in enumerate(efforts):
        n = min(len(force), (len(envelopes[k][0]) + 19) // 20)
        time, sign = np.arange(n) / 100, 1 if k == 0 else -1
        series = {"activations": [envelopes[k][0][:20 * n:20] / most[0], envelopes[k][1][:20 * n:20] / most[1]],
                  "lengths": [0 * time + 0.108, 0 * time + 0.084], "moment-arms": [0 * time + 0.04, 0 * time - 0.03],
                  "torques": [sign * LEVER_M * GRAVITY * force[:n]]}
        for option, columns in series.items():
            path = folder / f"{option}{k}.csv"
            names = ["time", "joint"] if option == "torques" else ["time", "E", "F"]
            left_out.write(path, names, np.column_stack([time, *columns]))
            files.append((f"--{option}", path))
    options = sorted({option for option, _ in files})
    arguments = [x for option in options for x in (option, *(path for name, path in files if name == option))]
    done = subprocess.run([program, "identify", "--muscles", folder / "muscles.csv", "--folds", "none", "--out",
                           folder / "out", "--overwrite", *arguments], capture_output=True, text=True, check=False)
    if done.returncode not in (0, 4):
        sys.exit(done.stderr)
    trials = json.loads((folder / "out/parameters.json").read_text())["methods"][0]["trials"]
    with (folder / "out/parameters.csv").open() as file:
        verdicts = [row["verdict"] for row in csv.DictReader(file)
                    if row["parameter"] in ("optimal_fiber_length", "force_length_width")]
    return [trial["rmse_nm"] for trial in trials], verdicts


def held_efforts(program, data):
    told, errors = {}, {}
    for cell in sorted((data / "elderly-isometric").glob("*_loadcell.csv")):
        person, force = cell.name[:2], read(cell)
        for joint, tasks in TASKS.items():
            efforts = []
            for task, of_e, of_f, column in tasks:
                emg = read(cell.parent / f"{person}_{task}_emg.csv")
                efforts.append((emg[:, of_e], emg[:, of_f], force[:, column]))
            with tempfile.TemporaryDirectory() as folder:
                rms, verdicts = fit(program, pathlib.Path(folder), efforts)
            errors.setdefault(joint, []).extend(rms)
            for verdict in verdicts:
                told[verdict] = told.get(verdict, 0) + 1
            print(f"{person} {joint}: {rms[0]:.1f} and {rms[1]:.1f} N m", flush=True)
    for joint, rms in errors.items():
        print(f"{joint}: {sum(x <= 10 for x in rms)} of {len(rms)} efforts within 10 N m, median {np.median(rms):.1f} N m")
    print("verdicts of l_m0 and l_msh:", told, flush=True)


def tendons(program, data):
    for slack in ("0.223", "0.247"):
        with tempfile.TemporaryDirectory() as folder:
            judge = left_out.Fit(program, pathlib.Path(folder))
            real = judge.left_out

            def with_slack(muscles, *more, slack=slack, real=real):
                muscles.write_text(muscles.read_text().replace(",0.223,", f",{slack},"))
                return real(muscles, *more)

            judge.left_out = with_slack
            left_out.stretches(judge, data)
            with (judge.folder / "out/parameters.csv").open() as file:
                row = next(row for row in csv.DictReader(file) if row["parameter"] == "optimal_fiber_length")
        print("tendon of {} m: l_m0 {:.1f} [{:.1f}, {:.1f}] mm, {}".format(
            slack, *(1000 * float(row[key]) for key in ("estimate", "ci_low", "ci_high")), row["verdict"]), flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    beside = pathlib.Path(__file__).resolve().parents[3] / "shared/data"
    parser.add_argument("data", type=pathlib.Path, nargs="?", default=os.environ.get("MYOID_DATA", beside))
    options = parser.parse_args()
    data = pathlib.Path(options.data)
    if not all((data / part).is_dir() for part in ("elderly-isometric", "tecchio-ankle", "ceinms-rt-leg")):
        print(f"needs elderly-isometric, tecchio-ankle and ceinms-rt-leg in {data}; set MYOID_DATA to the shared folder")
        sys.exit(77)
    tendons(options.program, data)
    held_efforts(options.program, data)


if __name__ == "__main__":
    main()

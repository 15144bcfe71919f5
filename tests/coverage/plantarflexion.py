#!/usr/bin/env python3
"""Maximal plantarflexion of one person at six ankle angles: does the fit of three angles predict the other three?

usage: plantarflexion.py MYOID [DATA] [--quick]

MYOID: the program. DATA: the folder with plantarflexor-mvc/ and ceinms-rt-leg/, public recordings; by default MYOID_DATA,
or shared/data beside the checkout. Without them the script says so and exits with 77. Gastrocnemius and soleus of gait2392 are fully active, the net torque is that of the
plateau. Prints a table of the 20 choices of three angles: the error of each angle's mean torque in the middle of the
plateau, between and beyond the fitted angles. --quick is the test of ctest: two choices with the others between them,
and a choice whose plateaus are given as constants.
"""
import argparse
import csv
import itertools
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ANGLES = [70, 90, 95, 105, 110, 120]  # foot to shank [deg]; 90 is neutral
MUSCLES = ["med_gas_r", "lat_gas_r", "soleus_r"]
BEFORE_S, AFTER_S = 0.1, 0.6  # of the plateau's beginning; the greatest half second lies within


def storage(path):
    head, *rows = path.read_text().split("endheader")[1].strip().splitlines()
    return dict(zip(head.split("\t"), zip(*(map(float, row.split("\t")) for row in rows))))


def write(path, columns, rows):
    path.write_text("\n".join([",".join(columns), *(",".join(map(repr, row)) for row in rows)]) + "\n")


class Contractions:
    """The twelve contractions as files for `identify`."""

    def __init__(self, program, data, folder, steady):
        self.program, self.folder, self.angle = program, folder, {}
        self.write_muscles((data / "ceinms-rt-leg/gait2392.osim").read_text())
        motion = "q\nversion=1\nnRows=6\nnColumns=2\ninDegrees=yes\nendheader\ntime\tankle_angle_r\n"
        (folder / "q.mot").write_text(motion + "".join(f"{i}\t{a - 90}\n" for i, a in enumerate(ANGLES)))
        self.run("paths", "--model", data / "ceinms-rt-leg/gait2392.osim", "--motion", folder / "q.mot",
                 "--out", folder / "paths")
        lengths = storage(folder / "paths/MuscleAnalysis_Length.sto")
        arms = storage(folder / "paths/MuscleAnalysis_MomentArm_ankle_angle_r.sto")
        with open(data / "plantarflexor-mvc/peaks.csv") as file:
            for row in csv.DictReader(file):
                name, begin = row["trial"], float(row["peak_time [s]"])
                self.angle[name] = int(row["foot_shank_angle [deg]"])
                with open(data / f"plantarflexor-mvc/{name}.csv") as samples:
                    recorded = [list(map(float, line)) for line in list(csv.reader(samples))[1:]]
                plateau = [(s, float(row["rest_torque [Nm]"]) - torque) for s, torque in recorded
                           if begin - BEFORE_S <= s <= begin + AFTER_S]
                if steady:
                    mean = sum(torque for _, torque in plateau) / len(plateau)
                    plateau = [(s, mean) for s, _ in plateau]
                at = ANGLES.index(self.angle[name])
                for kind, columns, values in (
                        ("a", MUSCLES, [1.0] * 3), ("v", MUSCLES, [0.0] * 3),
                        ("l", MUSCLES, [lengths[m][at] for m in MUSCLES]),
                        ("r", MUSCLES, [arms[m][at] for m in MUSCLES])):
                    write(folder / f"{name}_{kind}.csv", ["time", *columns], [[s, *values] for s, _ in plateau])
                write(folder / f"{name}_t.csv", ["time", "ankle"], plateau)

    def write_muscles(self, model):
        def of(muscle, name):
            return float(re.search(f"<{name}>([^<]*)<", model[model.index(f'name="{muscle}"'):]).group(1))

        rows = []
        for muscle in MUSCLES:
            l0 = of(muscle, "optimal_fiber_length")
            rows.append(f"{muscle},{of(muscle, 'max_isometric_force')},{l0},{of(muscle, 'tendon_slack_length')},"
                        f"{0.45 * l0},0.28,1.5,1.4,{10 * l0}\n")
        (self.folder / "muscles.csv").write_text(
            "muscle,max_isometric_force,optimal_fiber_length,tendon_slack_length,force_length_width,"
            "concentric_curvature,eccentric_slope_ratio,eccentric_plateau,max_shortening_speed\n" + "".join(rows))

    def run(self, *arguments):
        done = subprocess.run([self.program, *map(str, arguments)], capture_output=True, text=True, check=False)
        if done.returncode not in (0, 4):
            sys.exit(done.stderr)

    def predicted(self, fitted):
        """{angle that was not fitted: [(error [N m], whether the 95 % band holds the torque) of each contraction]}."""
        out = self.folder / "out"
        options = [("--activations", "a"), ("--lengths", "l"), ("--velocities", "v"), ("--moment-arms", "r"),
                   ("--torques", "t")]
        held = [f"{name}_l" for name, angle in self.angle.items() if angle not in fitted]
        self.run("identify", "--muscles", self.folder / "muscles.csv", "--coordinate",
                 "ankle", "--folds", "none", "--delay", "0", "--out", out, "--overwrite", "--validate", *held,
                 *(x for option, kind in options
                   for x in (option, *(self.folder / f"{name}_{kind}.csv" for name in self.angle))))
        errors = {}
        for name, angle in self.angle.items():
            if angle in fitted:
                continue
            (file,) = (path for path in out.glob("*/predicted_torque_ankle.sto") if name in str(path))
            torque = storage(file)
            measured, found, low, high = (torque["ankle_" + key][len(torque["time"]) // 2]
                                          for key in ("measured", "predicted", "low", "high"))
            errors.setdefault(angle, []).append((found - measured, low <= measured <= high))
        return errors


def rms(values):
    return (sum(x * x for x in values) / len(values)) ** 0.5


def quick(make):
    good = True
    for fitted in ((70, 90, 120), (70, 95, 120)):
        error = rms([e for of in make(False).predicted(fitted).values() for e, _ in of])
        print(f"{fitted}: {error:.1f} N m root mean square between the fitted angles, below 20 is expected")
        good = good and error < 20.0
    # 20 degrees beyond, with torques that never change: no exactness may be read into them.
    error = max(abs(e) for of in make(True).predicted((95, 105, 120)).values() for e, _ in of)
    print(f"constants: errors up to {error:.0f} N m, below the greatest torque of 330 N m is expected")
    return good and error < 330.0


def table(make):
    contractions = make(False)
    inside, outside = [], []
    print("| fitted [deg] | " + " | ".join(f"{a}: error [N m]" for a in ANGLES) + " |")
    print("| --- |" + " --- |" * len(ANGLES))
    for fitted in itertools.combinations(ANGLES, 3):
        errors = contractions.predicted(fitted)
        for angle, of in errors.items():
            (inside if min(fitted) < angle < max(fitted) else outside).extend(of)
        cells = (" and ".join(f"{e:.0f}" for e, _ in errors[a]) if a in errors else "" for a in ANGLES)
        print(f"| {', '.join(map(str, fitted))} | " + " | ".join(cells) + " |", flush=True)
    for name, of in (("between", inside), ("beyond", outside)):
        print(f"{name} the fitted angles: {rms([e for e, _ in of]):.1f} N m root mean square, within 20 N m "
              f"{sum(abs(e) < 20 for e, _ in of)} of {len(of)}, bands hold {sum(held for _, held in of)}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    beside = pathlib.Path(__file__).resolve().parents[3] / "shared/data"
    parser.add_argument("data", type=pathlib.Path, nargs="?", default=os.environ.get("MYOID_DATA", beside))
    parser.add_argument("--quick", action="store_true")
    options = parser.parse_args()
    if not all((options.data / part).is_dir() for part in ("plantarflexor-mvc", "ceinms-rt-leg")):
        print(f"needs plantarflexor-mvc and ceinms-rt-leg in {options.data}; set MYOID_DATA to the shared data folder")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as folder:
        def make(steady):
            place = pathlib.Path(tempfile.mkdtemp(dir=folder))
            return Contractions(options.program, options.data, place, steady)

        if options.quick:
            sys.exit(0 if quick(make) else 1)
        table(make)


if __name__ == "__main__":
    main()

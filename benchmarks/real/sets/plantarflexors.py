"""plantarflexor-mvc: maximal plantarflexion of one person at six ankle angles, three predicted from three.

Gastrocnemius and soleus of gait2392 are fully active, the net torque is that of the plateau. Each contraction's mean
torque is judged in the middle of the plateau, over the 20 choices of three angles.

usage as a test: plantarflexors.py MYOID [DATA]: two choices with the others between them, and a choice whose plateaus
are given as constants.
"""
import csv
import itertools
import pathlib
import re
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from board import MEAN, Bench, Row, rms, storage  # noqa: E402
from scoreboard import data_folder  # noqa: E402

NEEDS = ("plantarflexor-mvc", "ceinms-rt-leg")
ANGLES = [70, 90, 95, 105, 110, 120]  # foot to shank [deg]; 90 is neutral
MUSCLES = ["med_gas_r", "lat_gas_r", "soleus_r"]
BEFORE_S, AFTER_S = 0.1, 0.6  # of the plateau's beginning; the greatest half second lies within


def write(path, columns, rows):
    path.write_text("\n".join([",".join(columns), *(",".join(map(repr, row)) for row in rows)]) + "\n")


class Contractions:
    """The twelve contractions as files for `identify`."""

    def __init__(self, bench, steady):
        self.bench, self.angle, self.torque = bench, {}, {}
        self.folder, data = pathlib.Path(tempfile.mkdtemp(dir=bench.folder)), bench.data
        folder = self.folder
        self.write_muscles((data / "ceinms-rt-leg/gait2392.osim").read_text())
        motion = "q\nversion=1\nnRows=6\nnColumns=2\ninDegrees=yes\nendheader\ntime\tankle_angle_r\n"
        (folder / "q.mot").write_text(motion + "".join(f"{i}\t{a - 90}\n" for i, a in enumerate(ANGLES)))
        bench.run("paths", "--model", data / "ceinms-rt-leg/gait2392.osim", "--motion", folder / "q.mot",
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
                self.torque.setdefault(self.angle[name], []).append(sum(t for _, t in plateau) / len(plateau))
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

    def predicted(self, fitted):
        """{angle that was not fitted: [(error [N m], whether the 95 % band holds the torque) of each contraction]}."""
        out = self.folder / "out"
        options = [("--activations", "a"), ("--lengths", "l"), ("--velocities", "v"), ("--moment-arms", "r"),
                   ("--torques", "t")]
        held = [f"{name}_l" for name, angle in self.angle.items() if angle not in fitted]
        self.bench.run("identify", "--muscles", self.folder / "muscles.csv", "--coordinate",
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


def rows(bench):
    contractions = Contractions(bench, False)
    errors, held, of_mean = {"between": [], "beyond": []}, {"between": 0, "beyond": 0}, {"between": [], "beyond": []}
    for fitted in itertools.combinations(ANGLES, 3):
        mean = sum(sum(contractions.torque[a]) for a in fitted) / sum(len(contractions.torque[a]) for a in fitted)
        for angle, found in contractions.predicted(fitted).items():
            where = "between" if min(fitted) < angle < max(fitted) else "beyond"
            errors[where] += [error for error, _ in found]
            held[where] += sum(holds for _, holds in found)
            of_mean[where] += [torque - mean for torque in contractions.torque[angle]]
    for where, asked in (("between", "<= 14"), ("beyond", "")):
        yield Row(f"plantarflexion {where} fitted angles", "N m", rms(errors[where]), {MEAN: rms(of_mean[where])},
                  asked=asked, note=f"bands {held[where]} of {len(errors[where])}")


def test(bench):
    good = True
    for fitted in ((70, 90, 120), (70, 95, 120)):
        error = rms([e for of in Contractions(bench, False).predicted(fitted).values() for e, _ in of])
        print(f"{fitted}: {error:.1f} N m root mean square between the fitted angles, below 20 is expected")
        good = good and error < 20.0
    # 20 degrees beyond, with torques that never change: no exactness may be read into them.
    error = max(abs(e) for of in Contractions(bench, True).predicted((95, 105, 120)).values() for e, _ in of)
    print(f"constants: errors up to {error:.0f} N m, below the greatest torque of 330 N m is expected")
    return good and error < 330.0


if __name__ == "__main__":
    place = data_folder(sys.argv[2:])
    if not all((place / part).is_dir() for part in NEEDS):
        print(f"needs {' and '.join(NEEDS)} in {place}; set MYOID_DATA to the folder of the recordings")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as own:
        sys.exit(0 if test(Bench(sys.argv[1], place, pathlib.Path(own))) else 1)

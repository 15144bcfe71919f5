"""elderly-isometric: held efforts of knee and ankle in both directions, ten persons, one muscle each, one joint angle.

Lengths and moment arms are constant; the lever of 0.3 m was not recorded. One angle may tell no optimal fiber length;
the torque of each effort is asked to 10 N m.
"""
import csv
import json

from board import MEAN, Row, np, rms, write
from sets.tibialis import envelope, moving_mean

NEEDS = ("elderly-isometric",)
MUSCLES = ("muscle,max_isometric_force,optimal_fiber_length,force_length_width,concentric_curvature,"
           "eccentric_slope_ratio,eccentric_plateau,max_shortening_speed\n"
           "E,3000,0.1,0.045,0.28,1.5,1.4,1\nF,1500,0.09,0.0405,0.28,1.5,1.4,0.9\n")
LEVER_M, GRAVITY = 0.3, 9.80665  # the load cell is in kg
TASKS = {"knee": (("knee_extension", 0, 1, 0), ("knee_flexion", 0, 1, 1)),
         "ankle": (("plantarflexion", 3, 2, 3), ("dorsiflexion", 3, 2, 2))}  # EMG of E and F, column of the load cell


def read(path):
    return np.genfromtxt(path, delimiter=",", skip_header=2)


def fit(bench, efforts):
    """Errors [N m] of the fit and of the mean torque for both efforts, and the verdicts of l_m0 and l_msh."""
    folder = bench.folder
    envelopes = [[envelope(x) for x in effort[:2]] for effort in efforts]
    most = [max(moving_mean(of[muscle], 1000).max() for of in envelopes) for muscle in range(2)]
    (folder / "muscles.csv").write_text(MUSCLES)
    files, spread = [], []
    for k, (_, _, force) in enumerate(efforts):
        n = min(len(force), (len(envelopes[k][0]) + 19) // 20)
        time, sign = np.arange(n) / 100, 1 if k == 0 else -1
        torque = sign * LEVER_M * GRAVITY * force[:n]
        spread.append(rms(torque - torque.mean()))
        series = {"activations": [envelopes[k][0][:20 * n:20] / most[0], envelopes[k][1][:20 * n:20] / most[1]],
                  "lengths": [0 * time + 0.108, 0 * time + 0.084], "moment-arms": [0 * time + 0.04, 0 * time - 0.03],
                  "torques": [torque]}
        for option, columns in series.items():
            path = folder / f"{option}{k}.csv"
            write(path, ["time", "joint"] if option == "torques" else ["time", "E", "F"],
                  np.column_stack([time, *columns]))
            files.append((f"--{option}", path))
    options = sorted({option for option, _ in files})
    arguments = [x for option in options for x in (option, *(path for name, path in files if name == option))]
    bench.run("identify", "--muscles", folder / "muscles.csv", "--folds", "none", "--out", folder / "out", "--overwrite",
              *arguments)
    trials = json.loads((folder / "out/parameters.json").read_text())["methods"][0]["trials"]
    with (folder / "out/parameters.csv").open() as file:
        verdicts = [row["verdict"] for row in csv.DictReader(file)
                    if row["parameter"] in ("optimal_fiber_length", "force_length_width")]
    return [trial["rmse_nm"] for trial in trials], spread, verdicts


def rows(bench):
    told, of_verdicts = 0, 0
    errors, spreads = {}, {}
    for cell in sorted((bench.data / "elderly-isometric").glob("*_loadcell.csv")):
        person, force = cell.name[:2], read(cell)
        for joint, tasks in TASKS.items():
            efforts = []
            for task, of_e, of_f, column in tasks:
                emg = read(cell.parent / f"{person}_{task}_emg.csv")
                efforts.append((emg[:, of_e], emg[:, of_f], force[:, column]))
            found, spread, verdicts = fit(bench, efforts)
            errors.setdefault(joint, []).extend(found)
            spreads.setdefault(joint, []).extend(spread)
            told += sum(verdict in ("identified", "reproducible", "weak") for verdict in verdicts)
            of_verdicts += len(verdicts)
    for joint, found in errors.items():
        yield Row(f"{joint}, held efforts, median", "N m", float(np.median(found)),
                  {MEAN: float(np.median(spreads[joint]))}, asked="<= 10",
                  note=f"{sum(x <= 10 for x in found)} of {len(found)} within")
    yield Row("lengths told by one angle", "count", told, asked="0", note=f"of {of_verdicts}")

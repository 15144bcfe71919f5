#!/usr/bin/env python3
"""Fits single muscles of public recordings and prints what the fits predict beside what was published.

    scoreboard.py build/release/bin/myoid DATA [--set rat simulated rat_soleus cat] [--keep FOLDER]

DATA holds rat-gastrocnemius, rat-soleus and cat-soleus (examples/get_data). A set that is not there is left out.
Every number printed comes from `myoid muscle` or from the data's own files.
"""

import argparse
import csv
import json
import math
import subprocess
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
GASTROCNEMIUS = ("max_isometric_force,optimal_fiber_length,tendon_slack_length,tendon_strain,concentric_curvature,"
                 "max_shortening_speed,passive_strain,passive_slack,activation_time,deactivation_time")


def table(path):
    """Returns the columns of a .csv or .sto file as lists of numbers by name."""
    lines = path.read_text().splitlines()
    if path.suffix == ".sto":
        lines = lines[lines.index("endheader") + 1:]
    cut = "\t" if path.suffix == ".sto" else ","
    names = lines[0].split(cut)
    rows = [[float(x) for x in line.split(cut)] for line in lines[1:] if line.strip()]
    return {name: [row[k] for row in rows] for k, name in enumerate(names)}


def run(program, *arguments):
    """Runs `myoid muscle`; returns what it printed as JSON, its warnings and the time it took."""
    begin = time.monotonic()
    done = subprocess.run([program, "muscle", "--json", *map(str, arguments)], capture_output=True, text=True)
    if done.returncode not in (0, 4):
        sys.exit(done.stderr)
    return json.loads(done.stdout), done.stderr, time.monotonic() - begin


def experiment(files):
    """Returns the options for files that each hold length, stimulus and force."""
    names = [str(f) for f in files]
    return ["--length", *names, "--column", "length", "--excitation", *names, "--drive-column", "stim",
            "--measured", *names, "--measured-column", "force"]


def rmsd(measured, simulated, until):
    """Returns the root mean square difference of force from the first stimulus to `until`(last stimulus) [s]."""
    on = [t for t, s in zip(measured["time"], measured["stim"]) if s > 0.5]
    pairs = [(f, g) for t, f, g in zip(measured["time"], measured["force"], simulated["tendon_force"])
             if on[0] < t <= until(on[-1])]
    return math.sqrt(sum((f - g) ** 2 for f, g in pairs) / len(pairs))


def mean_and_spread(values):
    mean = sum(values) / len(values)
    return mean, math.sqrt(sum((v - mean) ** 2 for v in values) / len(values))


def fit_gastrocnemius(program, files, folder, *more):
    return run(program, "--muscle", HERE / "gastrocnemius.toml", *experiment(files), "--fit", GASTROCNEMIUS,
               "--fitted", folder / "fitted.toml", "--overwrite", *more)


def rat(program, data, folder):
    """Fits isometric, quick-release and step-ramp trials; predicts the stretch-shortening cycles."""
    for animal in sorted(data.glob("rat-gastrocnemius/GMe*/")):
        trials = {kind: sorted((animal / kind).glob("*.csv")) for kind in ("ISOM", "QR", "SR", "SSC")}
        fit, _, seconds = fit_gastrocnemius(program, trials["ISOM"] + trials["QR"] + trials["SR"], folder)
        strength = next(e["estimate"] for e in fit["estimates"] if e["parameter"] == "max_isometric_force")
        published = {}
        known = animal.parent / f"published_rmsd_{animal.name}.csv"
        for row in csv.DictReader(known.open()) if known.exists() else []:
            published.setdefault(row["kind"], []).append(float(row["IM_percent_of_fmax"]))
        for kind, files in trials.items():
            until = {"ISOM": lambda end: end + 0.1, "SSC": lambda end: end}.get(kind, lambda end: math.inf)
            errors = []
            for file in files:
                run(program, "--muscle", folder / "fitted.toml", *experiment([file]), "--tolerance", "1e-6", "--out",
                    folder / "simulated.sto", "--overwrite")
                errors.append(100.0 * rmsd(table(file), table(folder / "simulated.sto"), until) / strength)
            print("| {} {}, {} | {:.1f} ± {:.1f} % of F_max | {} |".format(
                animal.name, kind, "predicted" if kind == "SSC" else "fitted", *mean_and_spread(errors),
                "{:.1f} ± {:.1f} %".format(*mean_and_spread(published[kind])) if kind in published else ""))
        print(f"| {animal.name}, time of the fit | {seconds:.0f} s | |")


def simulated(program, data, folder):
    """Fits simulated muscles, each trial with its own tendon, and compares with their true numbers."""
    for muscle in sorted(data.glob("rat-gastrocnemius/GMs*/")):
        true = json.loads((muscle.parent / "parameters.json").read_text())[muscle.name]["true"]
        truth = {"max_isometric_force": true["fmax"], "optimal_fiber_length": true["lce_opt"],
                 "tendon_slack_length": true["lsee0"], "concentric_curvature": true["a"] / true["fmax"],
                 "max_shortening_speed": true["b"] * true["fmax"] / true["a"],
                 "passive_slack": true["lpee0"] / true["lce_opt"],
                 "activation_time": true["tact"], "deactivation_time": true["tdeact"]}
        worst, held, seconds = dict.fromkeys(truth, 0.0), dict.fromkeys(truth, 0), 0.0
        replicates = sorted(muscle.glob("*/"))
        for replicate in replicates:
            fit, _, took = fit_gastrocnemius(program, sorted(replicate.glob("*.csv")), folder, "--own",
                                             "tendon_strain")
            seconds = max(seconds, took)
            for e in fit["estimates"]:
                if e["parameter"] not in truth:
                    continue
                value = truth[e["parameter"]]
                worst[e["parameter"]] = max(worst[e["parameter"]], abs(e["estimate"] / value - 1.0))
                held[e["parameter"]] += e["ci_low"] <= value <= e["ci_high"]
        for name in truth:
            print(f"| {muscle.name} {name} | within {100.0 * worst[name]:.2f} % | "
                  f"95 % interval holds {held[name]} of {len(replicates)} |")
        print(f"| {muscle.name}, longest time of a fit | {seconds:.0f} s | |")


def published_table(path, out):
    """Writes a .dat of the benchmark as .csv."""
    lines = path.read_text().split("endheader")[1].split("\n")[2:]
    out.write_text("time,value\n" + "".join(",".join(line.split()) + "\n" for line in lines if line.strip()))
    return out


def rat_soleus(program, data, folder):
    source = data / "rat-soleus"
    trials = {1: 5e-5, 2: 1e-4, 4: 5e-4, 5: 1e-3}
    length = published_table(source / "displacement.dat", folder / "displacement.csv")
    forces = [published_table(source / f"force_trial{k}.dat", folder / f"force{k}.csv") for k in trials]
    fit, _, _ = run(program, "--muscle", HERE / "rat_soleus.toml", "--excitation", "1", "--isometric-force", "1.17",
                    "--offset", "0.032106", "--length", *[length] * 4, "--scale", *trials.values(), "--measured",
                    *forces, "--fit", "max_isometric_force,max_shortening_speed,tendon_strain,activation_time,"
                    "excitation_delay,eccentric_plateau")
    for amplitude, e in zip(trials.values(), fit["errors"]):
        print(f"| rat soleus, {1e3 * amplitude:g} mm, predicted from the others | "
              f"{100.0 * e['predicted_from_the_others']:.1f} % of F_iso | 3.3 to 8.9 % |")


def cat(program, data, folder):
    """The length is 0 at 9 mm below the longest, where fiber and tendon are as long as l0 cos(7 degrees) and the tendon at full force."""
    with (data / "cat-soleus/stretches.csv").open() as stream:
        rows = list(csv.reader(stream))
    files = []
    for trial, column in (("F43", 1), ("F44", 3), ("F45", 5), ("F47", 7), ("F49", 9), ("F50", 11)):
        lines, last = ["time,length,stim,force"], -1.0
        for row in rows[1:]:
            if not (row[0] and row[column] and row[column + 1]) or float(row[0]) <= last or float(row[0]) > 14.9:
                continue
            last = float(row[0])
            stim = int(trial != "F49" and 0.96 <= last < 10.22)
            lines.append(f"{last},{0.0746 + 1e-3 * float(row[column + 1]):.7f},{stim},{row[column]}")
        files.append(folder / f"{trial}.csv")
        files[-1].write_text("\n".join(lines) + "\n")
    fit, warnings, _ = run(program, "--muscle", HERE / "cat_soleus.toml", *experiment(files), "--fit",
                           "max_isometric_force,optimal_fiber_length,tendon_slack_length,tendon_strain,passive_strain,"
                           "passive_shape,activation_time,deactivation_time", "--isometric-force", "21.6")
    for e in fit["errors"]:
        print(f"| cat soleus {Path(e['recording']).stem}, before any stretch | {21.6 * e['fitted']:.2f} N | |")
    length = next(e for e in fit["estimates"] if e["parameter"] == "optimal_fiber_length")
    print(f"| cat soleus, l_m0 | {1e3 * length['estimate']:.1f} mm ({1e3 * length['ci_low']:.1f} to "
          f"{1e3 * length['ci_high']:.1f}) | measured 42.9 mm |")
    print(f"| cat soleus, stretches told as force enhancement | {warnings.count('residual force enhancement')} of 3 | |")


def main():
    sets = {"rat": (rat, "rat-gastrocnemius"), "simulated": (simulated, "rat-gastrocnemius"),
            "rat_soleus": (rat_soleus, "rat-soleus"), "cat": (cat, "cat-soleus")}
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("myoid")
    options.add_argument("data", type=Path)
    options.add_argument("--set", nargs="+", choices=sets, default=list(sets))
    options.add_argument("--keep", type=Path)
    given = options.parse_args()
    print("| recording, measure | here | published |\n| --- | --- | --- |")
    with tempfile.TemporaryDirectory() as temporary:
        folder = given.keep or Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        for name in given.set:
            work, needs = sets[name]
            if (given.data / needs).exists():
                work(given.myoid, given.data, folder)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Virtual persons for whom everything unseen is a little wrong: does the person's interval hold the truth?

usage: realistic.py MYOID OUT [PERSONS]

MYOID: the program. OUT: a folder; each person has a folder of its own there, and a person whose persons.csv exists is
not run again. PERSONS: 16 by default. Each person is drawn with moment arms (size 12 %, slope 8 %), tendon strain (2 to
6 %), cross-talk (5 %, half normal), drift of the gain (10 %), scale and offset of the torque (2 %, 0.5 N m) and effort
of the maximal contraction (85 to 100 %) of its own. These spreads are stated here, not taken from the estimator's
beliefs. Prints a line for each parameter as a table in Markdown.
"""
import argparse
import csv
import math
import pathlib
import statistics
import subprocess
import sys

try:
    import numpy as np
except ImportError:
    print("skipped: numpy is not installed (Debian: python3-numpy)")
    sys.exit(77)

RICH = pathlib.Path(__file__).resolve().parents[2] / "examples/protocols/rich.toml"


def make(program, out, seed):
    """Runs one person, unless it was run before; returns the rows of persons.csv."""
    folder = out / str(seed)
    if not (folder / "persons.csv").exists():
        draw = np.random.default_rng(seed)
        truth = ["moment_arm_sd=0.12", "moment_arm_slope_sd=0.08", "tendon_strain=[0.02,0.06]",
                 f"crosstalk={abs(draw.normal(0, 0.05)):.4f}", f"emg_gain_drift={draw.normal(0, 0.1):.4f}",
                 f"torque_scale={1 + draw.normal(0, 0.02):.4f}", f"torque_offset_nm={draw.normal(0, 0.5):.4f}",
                 "beside_muscles=true"]
        effort = draw.uniform(0.85, 1.0)
        protocol = out / f"person_{seed}.toml"
        protocol.write_text(RICH.read_text().replace("[emg]", f"[emg]\nmvc_effort = [{effort:.3f}, {effort:.3f}]"))
        done = subprocess.run([program, "twin-study", "--protocol", protocol, "--level", "L1", "--subjects", "1",
                               "--seed", str(seed), "--truth", *truth, "--out", folder, "--overwrite"],
                              capture_output=True, text=True, check=False)
        if done.returncode not in (0, 5):
            sys.exit(done.stderr)
    with (folder / "persons.csv").open() as file:
        return [row for row in csv.DictReader(file) if row["method"] == "torque" and row["truth"] and row["ci_low"]]


def is_angle(row):
    return "_angle" in row["parameter"]


def percent(share):
    return f"{100 * share:.1f}"


def reading(rows, prefix):
    """Share held, median error, bias and median half width; of an angle in degrees, else as shares."""
    angle = is_angle(rows[0])
    value = "given_estimate" if prefix else "estimate"
    held, error, half = [], [], []
    for row in rows:
        truth, low, high = (float(row[key]) for key in ("truth", prefix + "ci_low", prefix + "ci_high"))
        size = math.pi / 180 if angle else abs(truth)
        if size == 0:
            continue
        held.append(low <= truth <= high)
        error.append((float(row[value]) - truth) / size)
        half.append((high - low) / 2 / size)
    show = (lambda x: f"{x:.1f}°") if angle else percent
    return [f"{100 * sum(held) / len(held):.0f}", show(statistics.median(map(abs, error))),
            show(statistics.median(error)), show(statistics.median(half))] if held else ["–"] * 4


def right(rows):
    """Numbers called identified, and those of them within 15 % (an angle: 10 degrees) of the truth."""
    called = [row for row in rows if row["verdict"] == "identified" and float(row["truth"])]
    near = [row for row in called
            if abs(float(row["estimate"]) - float(row["truth"])) <=
            (math.radians(10) if is_angle(row) else 0.15 * abs(float(row["truth"])))]
    return f"{len(near)} of {len(called)}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("persons", type=int, nargs="?", default=16)
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    by_parameter, all_rows = {}, []
    for seed in range(1, options.persons + 1):
        for row in make(options.program, options.out, seed):
            by_parameter.setdefault(row["parameter"], []).append(row)
            all_rows.append(row)
    print("| parameter | n | held [%] | error [%] | bias [%] | half width [%] | given: held | error | bias | half width "
          "| identified, right |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |")
    for name, rows in by_parameter.items():
        given = [row for row in rows if row.get("given_ci_low")]
        print("|", " | ".join([name, str(len(rows)), *reading(rows, ""),
                               *(reading(given, "given_") if given else ["–"] * 4), right(rows)]), "|")
    print(f"identified, right: {right(all_rows)}")


if __name__ == "__main__":
    main()

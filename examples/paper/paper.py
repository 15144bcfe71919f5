#!/usr/bin/env python3
"""The source paper's experiment: its tables I and II, its figures 8 to 10, and what happens as its assumptions fail.

usage: paper.py MYOID OUT [--persons N]

MYOID: the program. OUT: a new folder for recordings, tables and figures. N: virtual persons, 5 by default.

Virtual persons move as section IV of the paper asks (learned.toml), and their forces are known. The published criterion
is minimized for each muscle and branch. The tables are those of the first person. Then one assumption fails at a time,
and a row tells the median error of each number over all persons and muscles. With the data folder MYOID_DATA the
script goes on with the recording of an elbow in it. Python's own library is enough.
"""

import argparse
import csv
import json
import math
import os
import random
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
MUSCLES = {"TRI": "Triceps", "BRD": "Brachioradialis", "BRA": "Brachialis", "BIC": "Biceps"}
CHANNEL = {"BRA": "BIC"}  # no electrode: as the biceps
CASES = {
    "shortening": ["optimal_fiber_length", "force_length_width", "concentric_curvature"],
    "lengthening": ["optimal_fiber_length", "force_length_width", "eccentric_curvature_product", "eccentric_plateau"],
}
SYMBOL = {"optimal_fiber_length": "l_m0", "force_length_width": "l_msh", "concentric_curvature": "V_sh",
          "eccentric_curvature_product": "V_sh V_shl", "eccentric_plateau": "V_ml"}
PLAIN = {"converged": "converged", "iteration_limit": "not converged"}
HELD = ["max_isometric_force", "max_shortening_speed", "tendon_slack_length"]

# What fails | changes of the protocol | keys of [truth] | forces | F_max over the person's | EMG's relative noise
ASSUMPTIONS = [
    ("none: all assumptions hold", {}, [], "known", 1.0, 0.0),
    ("EMG 20 ms early", {}, ["emg_delay_s=[0.02,0.02]"], "known", 1.0, 0.0),
    ("EMG with 10 % noise", {}, [], "known", 1.0, 0.1),
    ("F_max 25 % too high", {}, [], "known", 1.25, 0.0),
    ("tendon stretches by 5 % at F_max", {}, ["tendon_strain=[0.05,0.05]"], "known", 1.0, 0.0),
    ("forces shared, literature's F_max", {}, [], "shared", 1.0, 0.0),
    ("the same, and co-contraction of 5 %", {"co_contraction = [0, 0]": "co_contraction = [0.05, 0.05]"}, [], "shared",
     1.0, 0.0),
]


def myoid(program, *arguments):
    done = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, check=False)
    if done.returncode not in (0, 4):
        sys.exit(f"{' '.join(map(str, arguments))}:\n{done.stderr}")


def columns(path):
    """The columns of a storage file by name."""
    body = path.read_text().split("endheader\n")[1]
    names, *rows = [line.split("\t") for line in body.splitlines() if line.strip()]
    return {name: [float(row[k]) for row in rows] for k, name in enumerate(names)}


def at(times, t, x):
    """x over t, linear between its samples, at other times."""
    found, k = [], 0
    for time in times:
        while k + 2 < len(t) and t[k + 1] < time:
            k += 1
        share = (time - t[k]) / (t[k + 1] - t[k])
        found.append(x[k] + share * (x[k + 1] - x[k]))
    return found


def hill(a, length, speed, p, case):
    """Equations (2) to (4) of the paper."""
    fl = math.exp(-(((length - p["optimal_fiber_length"]) / p["force_length_width"]) ** 2))
    vmax = p["max_shortening_speed"]
    if case == "shortening":
        v = p["concentric_curvature"]
        fv = 0.0 if speed <= -vmax else v * (vmax + speed) / (v * vmax - speed)
    else:
        product = p["eccentric_curvature_product"]
        fv = (product * vmax + p["eccentric_plateau"] * speed) / (product * vmax + speed)
    return a * fl * fv * p["max_isometric_force"]


class Recording:
    """A virtual person's recording and the run of it: lengths, speeds, activations, both kinds of forces."""

    def __init__(self, program, folder, seed, changes, truth):
        self.program, self.folder = program, folder
        folder.mkdir(parents=True)
        protocol = (HERE / "learned.toml").read_text()
        for old, new in changes.items():
            assert old in protocol, old
            protocol = protocol.replace(old, new)
        (folder / "protocol.toml").write_text(protocol)
        keys = ["--truth", *truth] if truth else []
        myoid(program, "twin", "--protocol", folder / "protocol.toml", "--seed", seed, *keys, "--out", folder / "rec")
        myoid(program, "run", folder / "rec/study.toml", "--method", "paper", "--out", folder / "run")
        rows = csv.DictReader((folder / "rec/truth.csv").open())
        self.truth = {(row["muscle"], row["parameter"]): float(row["value"]) for row in rows}
        self.shared = Fit(folder / "run")

    def by_known_forces(self, strength, noise):
        """Method paper of the person's own forces, F_max times `strength`, and EMG with noise."""
        folder = self.folder / f"known_{strength}_{noise}"
        folder.mkdir()
        names = [*CASES["shortening"], *CASES["lengthening"][2:]]
        with (folder / "muscles.csv").open("w") as file:
            file.write(",".join(["muscle", "emg", *names, *HELD]) + "\n")
            for muscle in MUSCLES:
                start = [self.shared.start[muscle, name] for name in names]
                held = [self.truth[muscle, name] for name in HELD]
                held[0] *= strength
                file.write(",".join([muscle, CHANNEL.get(muscle, muscle), *map(repr, start + held)]) + "\n")
        activation = columns(self.folder / "run/learned/activation.sto")
        with (folder / "activation.csv").open("w") as file:
            channels = [name for name in activation if name != "time"]
            file.write(",".join(["time", *channels]) + "\n")
            gains = {name: wander(activation["time"], noise, name) for name in channels}
            for i, time in enumerate(activation["time"]):
                row = [time, *(activation[c][i] * gains[c][i] for c in channels)]
                file.write(",".join(map(repr, row)) + "\n")
        run = self.folder / "run/learned"
        myoid(self.program, "identify", "--method", "paper", "--muscles", folder / "muscles.csv", "--activations",
              folder / "activation.csv", "--lengths", run / "MuscleAnalysis_Length.sto", "--velocities",
              run / "MuscleAnalysis_MuscleTendonVelocity.sto", "--forces", self.folder / "rec/truth/learned_force.sto",
              "--out", folder / "out")
        return Fit(folder / "out")


def wander(times, noise, seed):
    """1 and a smooth relative noise of this standard deviation: a sum of sines below 6 Hz."""
    if noise == 0.0:
        return [1.0] * len(times)
    chance = random.Random(seed)
    sines = [(2 * math.pi * chance.uniform(0.2, 6.0), chance.uniform(0, 2 * math.pi)) for _ in range(40)]
    return [1.0 + noise * math.sqrt(2 / 40) * sum(math.sin(w * t + p) for w, p in sines) for t in times]


class Fit:
    """What method paper found."""

    def __init__(self, folder):
        methods = json.loads((folder / "parameters.json").read_text())["methods"]
        method = next(m for m in methods if m["method"] == "paper")
        self.start = {(e["muscle"], e["parameter"]): e["initial"] for e in method["estimates"]}
        self.value = {(e["muscle"], e["case"], e["parameter"]): e["estimate"] for e in method["estimates"]}
        self.interval = {(e["muscle"], e["case"], e["parameter"]): e["ci_low"] for e in method["estimates"]}
        self.searches = {(s["muscle"], s["case"]): s for s in method["published_searches"]}


def value(x):
    return "-" if x is None else f"{x:.4g}"


def table(fit, case, title):
    """Table I or II, as the paper has it, with the criterion and the steps."""
    heads = ["muscle", "x", *(SYMBOL[n] for n in CASES[case]), "C [N²]", "steps", "plain steps"]
    lines = ["", title, "", f"| {' | '.join(heads)} |",
             "| --- | --- |" + " --- |" * (len(CASES[case]) + 3)]
    for muscle, name in MUSCLES.items():
        s = fit.searches[muscle, case]
        start = [value(fit.start[muscle, n]) for n in CASES[case]]
        found = [value(fit.value[muscle, case, n]) for n in CASES[case]]
        steps = str(s["iterations"]) if s["termination"] == "converged" else f"no minimum ({s['iterations']})"
        ended = "elsewhere" if s["plain_elsewhere"] else PLAIN.get(s["plain_termination"], "diverged")
        plain = f"{ended} ({s['plain_iterations']})"
        lines.append(f"| {name} | x_init | {' | '.join(start)} | {value(s['start_cost'])} | | |")
        lines.append(f"| {name} | x̂ | {' | '.join(found)} | {value(s['cost'])} | {steps} | {plain} |")
    return "\n".join(lines)


def svg(path, title, time, panels):
    """Panels under each other: force over time, curves as (label, color, dash, values)."""
    width, height, left, top = 900, 250, 70, 40
    text = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {top + height * len(panels)}" '
            'font-family="Helvetica, Arial, sans-serif" font-size="13">',
            f'<text x="{left}" y="22" font-size="15">{title}</text>']
    for k, curves in enumerate(panels):
        most = max(max(v) for _, _, _, v in curves) or 1.0
        base = top + height * (k + 1) - 40
        room = height - 60
        x = [left + (width - left - 20) * (t - time[0]) / (time[-1] - time[0]) for t in time]
        text.append(f'<path d="M{left} {base - room}V{base}H{width - 20}" fill="none" stroke="#888"/>')
        text.append(f'<text x="{left - 6}" y="{base - room + 5}" text-anchor="end">{most:.0f} N</text>')
        text.append(f'<text x="{left - 6}" y="{base + 5}" text-anchor="end">0</text>')
        text.append(f'<text x="{left}" y="{base + 17}">{time[0]:.1f} s</text>')
        text.append(f'<text x="{width - 20}" y="{base + 17}" text-anchor="end">{time[-1]:.1f} s</text>')
        for n, (label, color, dash, values) in enumerate(curves):
            points = " ".join(f"{a:.1f},{base - room * max(0.0, b) / most:.1f}" for a, b in zip(x, values))
            text.append(f'<polyline points="{points}" fill="none" stroke="{color}" stroke-width="1.4"{dash}/>')
            text.append(f'<text x="{left + 10 + 330 * n}" y="{base - room - 4}" fill="{color}">{label}</text>')
    path.write_text("\n".join([*text, "</svg>"]) + "\n")


def figures(fit, run, forces, held, prefix, out, what):
    """Figures 8 to 10: forces of triceps, brachioradialis and brachialis, by x̂ above and by the literature below."""
    length, speed = columns(run / "MuscleAnalysis_Length.sto"), columns(run / "MuscleAnalysis_MuscleTendonVelocity.sto")
    activation = columns(run / "activation.sto")
    time = [t for t in length["time"] if activation["time"][0] <= t <= activation["time"][-1]]
    time = time[:: max(1, len(time) // 800)]
    reference = columns(forces)
    for number, muscle in ((8, "TRI"), (9, "BRD"), (10, "BRA")):
        known = at(time, reference["time"], reference[muscle])
        a = at(time, activation["time"], activation[CHANNEL.get(muscle, muscle)])
        lm = [x - held[muscle]["tendon_slack_length"] for x in at(time, length["time"], length[muscle])]
        v = at(time, speed["time"], speed[muscle])
        by_start, by_fit = [], []
        for i in range(len(time)):
            case = "shortening" if v[i] <= 0.0 else "lengthening"
            start = {n: fit.start[muscle, n] for n in CASES[case]}
            found = {n: fit.value[muscle, case, n] for n in CASES[case]}
            by_start.append(hill(a[i], lm[i], v[i], start | held[muscle], case))
            none = None in found.values()
            by_fit.append(by_start[-1] if none else hill(a[i], lm[i], v[i], found | held[muscle], case))
        blue = (what, "#1f5fa8", "", known)
        svg(out / f"{prefix}figure{number}.svg", f"{MUSCLES[muscle]}: force of the muscle", time,
            [[blue, ("muscle model, x̂", "#b3261e", ' stroke-dasharray="7 4"', by_fit)],
             [blue, ("muscle model, literature", "#111111", ' stroke-dasharray="7 4"', by_start)]])


def median(values):
    values = sorted(values)
    return values[len(values) // 2] if values else None


def assumptions(program, out, persons):
    """A row of Markdown for each assumption that fails; the first person's fit by all assumptions."""
    print("\nMedian error [%] of each number over the minima that were found, and how the searches fared\n")
    heads = [f"{SYMBOL[n]}, {case}" for case, names in CASES.items() for n in names]
    print("| what fails | " + " | ".join(heads) + " | minima | steps | plain steps reach them |")
    print("| --- |" + " --- |" * (len(heads) + 3))
    recordings, first, rows = {}, None, []
    for label, changes, truth, forces, strength, noise in ASSUMPTIONS:
        errors, found, steps, plain, all_searches = {}, 0, [], 0, 0
        for seed in range(1, persons + 1):
            key = (seed, str(changes), str(truth))
            if key not in recordings:
                recordings[key] = Recording(program, out / f"person{len(recordings) + 1}", seed, changes, truth)
            recording = recordings[key]
            fit = recording.shared if forces == "shared" else recording.by_known_forces(strength, noise)
            first = first or (recording, fit)
            for (muscle, case), s in fit.searches.items():
                all_searches += 1
                if s["termination"] != "converged":
                    continue
                found += 1
                steps.append(s["iterations"])
                plain += s["plain_termination"] == "converged" and not s["plain_elsewhere"]
                for name in CASES[case]:
                    true = recording.truth[muscle, name]
                    errors.setdefault((case, name), []).append(abs(fit.value[muscle, case, name] - true) / true)
        cells = [median(errors.get((case, name), [])) for case, names in CASES.items() for name in names]
        rows.append([label, *cells, found, all_searches, median(steps), plain])
        shown = ["-" if c is None else f"{100 * c:.2g}" for c in cells]
        print(f"| {label} | {' | '.join(shown)} | {found} of {all_searches} | {median(steps)} | {plain} |", flush=True)
    with (out / "assumptions.csv").open("w", newline="") as file:
        csv.writer(file).writerows([["what_fails", *heads, "minima", "searches", "steps", "plain"], *rows])
    return first


def elbow(program, out, data):
    """The published method on the recording of an elbow, whose forces nobody measured."""
    study = (HERE.parent / "elbow_emg/study.toml").read_text().replace("../../../shared/data", str(data))
    (out / "elbow.toml").write_text(study)
    myoid(program, "run", out / "elbow.toml", "--method", "paper", "--out", out / "elbow")
    fit = Fit(out / "elbow")
    assert not any(fit.interval.values()), "a shared force has no interval"
    print("\nThe recording of an elbow, forces shared by static optimization. No number is a measurement.")
    print(table(fit, "shortening", "Table I: parameters estimated with C_1"))
    print(table(fit, "lengthening", "Table II: parameters estimated with C_2"))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("out", type=Path)
    parser.add_argument("--persons", type=int, default=5)
    options = parser.parse_args()
    options.out.mkdir(parents=True)
    recording, fit = assumptions(options.program, options.out, options.persons)
    print("\nThe first person, all assumptions hold, forces known")
    print(table(fit, "shortening", "Table I: parameters estimated with C_1"))
    print(table(fit, "lengthening", "Table II: parameters estimated with C_2"))
    held = {m: {name: recording.truth[m, name] for name in HELD} for m in MUSCLES}
    run = recording.folder / "run/learned"
    figures(fit, run, recording.folder / "rec/truth/learned_force.sto", held, "", options.out, "the person's force")
    data = os.environ.get("MYOID_DATA", "")
    if data and (Path(data) / "elbow-emg").is_dir():
        elbow(options.program, options.out, Path(data))
    else:
        print("\nNo elbow-emg in the folder MYOID_DATA: the recording is left out")


if __name__ == "__main__":
    main()

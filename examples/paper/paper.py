#!/usr/bin/env python3
"""The source paper's experiment: its tables I and II, its figures 8 to 10, and what happens as its assumptions fail.

usage: paper.py MYOID OUT [--page PAGE]

MYOID: the program. OUT: a new folder for recordings, tables and figures. --page: also puts the tables into this page,
between the lines <!-- printed: NAME --> and <!-- end of NAME -->, and the figures that it shows beside it.

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
import re
import shutil
import statistics
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import NamedTuple

HERE = Path(__file__).resolve().parent
PERSONS = 3
MUSCLES = {"TRI": "Triceps", "BRD": "Brachioradialis", "BRA": "Brachialis", "BIC": "Biceps"}
CHANNEL = {"BRA": "BIC"}  # no electrode: as the biceps
CASES = {
    "shortening": ["optimal_fiber_length", "force_length_width", "concentric_curvature"],
    "lengthening": ["optimal_fiber_length", "force_length_width", "eccentric_curvature_product", "eccentric_plateau"],
}
SYMBOL = {"optimal_fiber_length": "l_m0", "force_length_width": "l_msh", "concentric_curvature": "V_sh",
          "eccentric_curvature_product": "V_sh V_shl", "eccentric_plateau": "V_ml"}
HELD = ["max_isometric_force", "max_shortening_speed", "tendon_slack_length"]
ROUND_OFF = 1e-9  # N², of a criterion; the tables say < 10⁻⁹


class Failure(NamedTuple):
    """An assumption that fails, by the person, the recording, or what the fit is given."""

    label: str
    control: str = "co_contraction = [0, 0]"  # of the protocol
    truth: tuple = ()  # keys of [truth]
    shared: bool = False  # forces of static optimization and the literature's F_max, not the person's
    held: dict = {}  # factors on what the fit holds
    noise: float = 0.0  # relative, of the EMG
    fading: float = 0.0  # share of the force that is lost by the end
    muscles: tuple = tuple(MUSCLES)  # that count


FAILURES = [
    Failure("nothing: all assumptions hold"),
    Failure("EMG 20 ms early", truth=("emg_delay_s=[0.02,0.02]",)),
    Failure("EMG with 10 % noise", noise=0.1),
    Failure("brachialis not driven as the biceps: its numbers", muscles=("BRA",),
            control="co_contraction = [0, 0]\nbrachialis_synergy = 0.35"),
    Failure("F_max 25 % too high", held={"max_isometric_force": 1.25}),
    Failure("v_max 25 % too high", held={"max_shortening_speed": 1.25}),
    Failure("tendon 5 % too long", held={"tendon_slack_length": 1.05}),
    Failure("tendon stretches by 5 % at F_max", truth=("tendon_strain=[0.05,0.05]",)),
    Failure("moment arms wrong by 10 % (standard deviation)", truth=("moment_arm_sd=0.1",)),
    Failure("fatigue: 20 % of the force lost in 20 s", fading=0.2),
    Failure("another muscle law: Millard's curves", truth=("curves=millard",)),
    Failure("forces shared, literature's F_max", shared=True),
    Failure("the same, and co-contraction of 5 %", shared=True, control="co_contraction = [0.05, 0.05]"),
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

    def __init__(self, program, folder, seed, control, truth):
        self.program, self.folder = program, folder
        folder.mkdir(parents=True)
        protocol = (HERE / "learned.toml").read_text()
        usual = Failure._field_defaults["control"]
        assert usual in protocol, usual
        (folder / "protocol.toml").write_text(protocol.replace(usual, control))
        keys = ["--truth", *truth] if truth else []
        myoid(program, "twin", "--protocol", folder / "protocol.toml", "--seed", seed, *keys, "--out", folder / "rec")
        myoid(program, "run", folder / "rec/study.toml", "--method", "paper", "--out", folder / "run")
        rows = csv.DictReader((folder / "rec/truth.csv").open())
        self.truth = {(row["muscle"], row["parameter"]): float(row["value"]) for row in rows}
        self.forces = folder / "rec/truth/learned_force.sto"
        self.shared = Fit(folder / "run")

    def by_known_forces(self, failure, name):
        """Method paper of the person's own forces, with the failure of what it is given."""
        folder = self.folder / name
        folder.mkdir()
        unknown = [*CASES["shortening"], *CASES["lengthening"][2:]]
        rows = [["muscle", "emg", *unknown, *HELD]]
        for muscle in MUSCLES:
            start = [self.shared.start[muscle, name] for name in unknown]
            held = [self.truth[muscle, name] * failure.held.get(name, 1.0) for name in HELD]
            rows.append([muscle, CHANNEL.get(muscle, muscle), *start, *held])
        write(folder / "muscles.csv", rows)
        activation = columns(self.folder / "run/learned/activation.sto")
        for channel in activation.keys() - {"time"}:
            noise = wander(activation["time"], failure.noise, channel)
            activation[channel] = [a * b for a, b in zip(activation[channel], noise)]
        write(folder / "activation.csv", [list(activation), *zip(*activation.values())])
        force = columns(self.forces)
        end = force["time"][-1]
        for muscle in MUSCLES:
            force[muscle] = [f * (1.0 - failure.fading * t / end) for f, t in zip(force[muscle], force["time"])]
        write(folder / "force.csv", [list(force), *zip(*force.values())])
        run = self.folder / "run/learned"
        myoid(self.program, "identify", "--method", "paper", "--muscles", folder / "muscles.csv", "--activations",
              folder / "activation.csv", "--lengths", run / "MuscleAnalysis_Length.sto", "--velocities",
              run / "MuscleAnalysis_MuscleTendonVelocity.sto", "--forces", folder / "force.csv",
              "--out", folder / "out")
        return Fit(folder / "out")


def write(path, rows):
    with path.open("w", newline="") as file:
        csv.writer(file).writerows(rows)


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
    return f"{x:.4g}"


def percent(x):
    return "–" if x is None else "0" if x < 1e-5 else f"{100 * x:.2g}" if x < 0.1 else f"{100 * x:.0f}"


def markdown(heads, rows):
    head, *body = (f"| {' | '.join(map(str, row))} |" for row in (heads, *rows))
    return [head, "|" + " --- |" * len(heads), *body]


def estimates(fit, case):
    """Table I or II, as the paper has it, with the criterion and the steps."""
    rows = []
    for muscle, name in MUSCLES.items():
        s = fit.searches[muscle, case]
        start = [value(fit.start[muscle, n]) for n in CASES[case]]
        rows.append([name, "x_init", *start, value(s["start_cost"]), "", ""])
        if s["termination"] == "converged":
            found = [value(fit.value[muscle, case, n]) for n in CASES[case]]
            cost = "< 10⁻⁹" if s["cost"] < ROUND_OFF else value(s["cost"])
            plain = s["plain_iterations"] if reached(s) else "not reached"
            rows.append([name, "x̂", *found, cost, s["iterations"], plain])
        else:
            rows.append([name, "x̂", *("–" for _ in CASES[case]), "–", "no minimum", "–"])
    return markdown(["muscle", "x", *(SYMBOL[n] for n in CASES[case]), "C [N²]", "steps", "plain steps"], rows)


def reached(search):
    """Whether the plain steps ended at the minimum."""
    return search["plain_termination"] == "converged" and not search["plain_elsewhere"]


def counts(searches):
    """How many minima there are, after how many steps, and how many of them plain steps reach."""
    found = [s for s in searches if s["termination"] == "converged"]
    steps = round(statistics.median(s["iterations"] for s in found)) if found else "–"
    return [f"{len(found)} of {len(searches)}", steps, sum(map(reached, found))]


def polylines(time, values, width, base, room, left, most, style):
    x = [left + width * (t - time[0]) / (time[-1] - time[0]) for t in time]
    points = " ".join(f"{a:.1f},{base - room * min(1.0, max(0.0, b / most)):.1f}" for a, b in zip(x, values))
    return f'<polyline points="{points}" fill="none" {style}/>'


def svg(path, title, time, panels):
    """Panels under each other: force over time, curves as (label, color, style, values), cut off above the first."""
    width, height, left, top = 900, 250, 70, 40
    text = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {top + height * len(panels)}" '
            'font-family="Helvetica, Arial, sans-serif" font-size="13">',
            f'<rect width="100%" height="100%" fill="white"/><text x="{left}" y="22" font-size="15">{title}</text>']
    for k, curves in enumerate(panels):
        most = min(2.5 * max(curves[0][3]), max(max(values) for _, _, _, values in curves))
        base, room = top + height * (k + 1) - 40, height - 60
        text.append(f'<path d="M{left} {base - room}V{base}H{width - 20}" fill="none" stroke="#888"/>')
        text.append(f'<text x="{left - 6}" y="{base - room + 5}" text-anchor="end">{most:.0f} N</text>')
        text.append(f'<text x="{left - 6}" y="{base + 5}" text-anchor="end">0</text>')
        text.append(f'<text x="{left}" y="{base + 17}">{time[0]:.1f} s</text>')
        text.append(f'<text x="{width - 20}" y="{base + 17}" text-anchor="end">{time[-1]:.1f} s</text>')
        for n, (label, color, style, values) in enumerate(curves):
            text.append(polylines(time, values, width - left - 20, base, room, left, most, f'stroke="{color}" {style}'))
            text.append(f'<text x="{left + 10 + 330 * n}" y="{base - room - 4}" fill="{color}">{label}</text>')
    path.write_text("\n".join([*text, "</svg>"]) + "\n")


def figures(out, prefix, what, courses):
    """Figures 8 to 10: the force that was fitted and the muscle model's, by x̂ above and by the literature below."""
    for number, muscle in ((8, "TRI"), (9, "BRD"), (10, "BRA")):
        time, known, by_start, by_fit = courses(muscle)
        every = max(1, len(time) // 500)
        time, known, by_start, by_fit = (x[::every] for x in (time, known, by_start, by_fit))
        blue = (what, "#1f5fa8", 'stroke-width="2.2" stroke-opacity="0.6"', known)
        dashed = 'stroke-width="1.3" stroke-dasharray="5 3"'
        svg(out / f"{prefix}figure{number}.svg", f"{MUSCLES[muscle]}: force of the muscle", time,
            [[blue, ("muscle model, x̂", "#b3261e", dashed, by_fit)],
             [blue, ("muscle model, literature", "#111111", dashed, by_start)]])


def courses_of_person(recording, fit):
    """The forces of a muscle over time: the person's, by the literature's numbers, by x̂."""
    run = recording.folder / "run/learned"
    length, speed = columns(run / "MuscleAnalysis_Length.sto"), columns(run / "MuscleAnalysis_MuscleTendonVelocity.sto")
    activation, force = columns(run / "activation.sto"), columns(recording.forces)
    time = [t for t in length["time"] if activation["time"][0] <= t <= activation["time"][-1]]

    def courses(muscle):
        held = {name: recording.truth[muscle, name] for name in HELD}
        a = at(time, activation["time"], activation[CHANNEL.get(muscle, muscle)])
        lm = [x - held["tendon_slack_length"] for x in at(time, length["time"], length[muscle])]
        by_start, by_fit = [], []
        for drive, here, v in zip(a, lm, at(time, speed["time"], speed[muscle])):
            case = "shortening" if v <= 0.0 else "lengthening"
            by_start.append(hill(drive, here, v, held | {n: fit.start[muscle, n] for n in CASES[case]}, case))
            by_fit.append(hill(drive, here, v, held | {n: fit.value[muscle, case, n] for n in CASES[case]}, case))
        return time, at(time, force["time"], force[muscle]), by_start, by_fit

    return courses


def persons_of(program, out, failure, recordings):
    """The recordings of all persons, each made once."""
    key = (failure.control, failure.truth)
    if key not in recordings:
        world = len(recordings) + 1

        def make(seed):
            return Recording(program, out / f"world{world}_person{seed}", seed, *key)

        with ThreadPoolExecutor(2) as pool:
            recordings[key] = list(pool.map(make, range(1, PERSONS + 1)))
    return recordings[key]


def fail(program, out):
    """A row for each assumption that fails; also the first person's fit where all hold."""
    recordings, first, rows = {}, None, []
    for number, failure in enumerate(FAILURES):
        people = persons_of(program, out, failure, recordings)
        with ThreadPoolExecutor(2) as pool:
            fits = list(pool.map(
                lambda person: person.shared if failure.shared else person.by_known_forces(failure, f"known{number}"),
                people))
        first = first or (people[0], fits[0])
        errors, searches = {}, []
        for person, fit in zip(people, fits):
            for (muscle, case), search in fit.searches.items():
                if muscle not in failure.muscles:
                    continue
                searches.append(search)
                for name in CASES[case] if search["termination"] == "converged" else []:
                    true = person.truth.get((muscle, name))
                    if true is not None:  # another law has not all numbers
                        errors.setdefault((case, name), []).append(abs(fit.value[muscle, case, name] / true - 1.0))
        medians = [statistics.median(errors[case, name]) if (case, name) in errors else None
                   for case, names in CASES.items() for name in names]
        rows.append([failure.label, *medians, *counts(searches)])
    heads = ["what fails", *(f"{SYMBOL[n]}, {case}" for case, names in CASES.items() for n in names)]
    heads += ["minima", "steps", "plain steps reach"]
    write(out / "assumptions.csv", [heads, *rows])
    return markdown(heads, [[label, *map(percent, row[:7]), *row[7:]] for label, *row in rows]), *first


def literature_force(model, muscle):
    text = model.read_text()
    return float(re.search(f'name="{muscle}".*?<max_isometric_force>([^<]*)<', text, re.DOTALL).group(1))


def gains(folder):
    """The factor on each muscle's literature force that fits the shared force best."""
    sums = {muscle: [0.0, 0.0] for muscle in MUSCLES}
    for path in sorted(folder.glob("*/identified_forces.sto")):
        force = columns(path)
        for muscle, sum_of in sums.items():
            model, shared = force[f"{muscle}_literature"], force[f"{muscle}_reference"]
            sum_of[0] += sum(a * b for a, b in zip(model, shared))
            sum_of[1] += sum(a * a for a in model)
    return {muscle: a / b for muscle, (a, b) in sums.items()}


def elbow(program, out, data, model):
    """The published method on the recording of an elbow, by the literature's F_max and by that of the shared forces."""
    study = (HERE.parent / "elbow_emg/study.toml").read_text().replace("../../../shared/data", str(data))
    (out / "elbow.toml").write_text(study)
    myoid(program, "run", out / "elbow.toml", "--method", "paper", "--out", out / "elbow")
    gain = gains(out / "elbow")
    for muscle in MUSCLES:
        name, force = f'name = "{muscle}"', gain[muscle] * literature_force(model, muscle)
        study = study.replace(name, f"{name}\nstart = {{ max_isometric_force = {force:.3f} }}")
    (out / "elbow_scaled.toml").write_text(study)
    myoid(program, "run", out / "elbow_scaled.toml", "--method", "paper", "--out", out / "elbow_scaled")
    assert all(abs(g - 1.0) < 1e-3 for g in gains(out / "elbow_scaled").values()), "F_max is not the scaled one"
    fits = {"the literature's": Fit(out / "elbow"), "times the gain": Fit(out / "elbow_scaled")}
    for fit in fits.values():
        assert not any(fit.interval.values()), "a shared force has no interval"
    force = columns(out / "elbow_scaled/load2p75_T1/identified_forces.sto")
    kinds = ("reference", "literature", "identified")
    figures(out, "elbow_", "shared force", lambda muscle: (force["time"], *(force[f"{muscle}_{x}"] for x in kinds)))
    searches = [[name, *counts(fit.searches.values())] for name, fit in fits.items()]
    return {
        "elbow gains": markdown(["", *MUSCLES.values()], [["gain of F_max", *(f"{gain[m]:.2f}" for m in MUSCLES)]]),
        "elbow searches": markdown(["F_max", "minima", "steps", "plain steps reach"], searches),
    }


def put(page, tables, out):
    """The tables between their lines of the page, and the figures that the page shows beside it."""
    text = page.read_text(encoding="utf-8")
    for name, lines in tables.items():
        begin, end = f"<!-- printed: {name} -->\n", f"<!-- end of {name} -->"
        before, rest = text.split(begin)
        text = before + begin + "\n".join(lines) + "\n" + end + rest.split(end)[1]
    page.write_text(text, encoding="utf-8")
    for name in re.findall(r"\(published_(\w+\.svg)\)", text):
        if (out / name).exists():
            shutil.copy(out / name, page.parent / f"published_{name}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("out", type=Path)
    parser.add_argument("--page", type=Path)
    options = parser.parse_args()
    options.out.mkdir(parents=True)
    errors, recording, fit = fail(options.program, options.out)
    tables = {"Table I": estimates(fit, "shortening"), "Table II": estimates(fit, "lengthening"),
              "median errors in percent": errors}
    figures(options.out, "", "the person's force", courses_of_person(recording, fit))
    data = Path(os.environ.get("MYOID_DATA") or HERE / "../../../shared/data").resolve()
    if (data / "elbow-emg").is_dir():
        tables |= elbow(options.program, options.out, data, recording.folder / "rec/model.osim")
    else:
        print(f"There is no {data}/elbow-emg: the recording is left out")
    for name, lines in tables.items():
        print("", name, "", *lines, sep="\n")
    if options.page:
        put(options.page, tables, options.out)


if __name__ == "__main__":
    main()

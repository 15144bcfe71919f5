#!/usr/bin/env python3
"""Two sessions of one virtual person: who did not change, whose biceps did (+25 %), whose electrode moved.

usage: pairs.py MYOID OUT [PAIRS] [--jobs N] [--effort-sd SD] [--kinds KIND ...]

MYOID: the program. OUT: a folder; a session whose parameters.json exists there is not run again. PAIRS: 40 by default,
of each kind. The first session of a person serves all kinds. --effort-sd: from session to session, of the share that a
maximal contraction reaches (3 % by default).

  the person's, in both sessions  muscles, moment arms (size 12 %, slope 8 %), strain of the tendons (2 to 6 %), joint,
                                  exponents and delay of the EMG, cross-talk (5 %, half normal), scale of the torque
                                  (2 %), mean effort of the maximal contraction (85 to 100 %)
  each session's                  noise of EMG, markers and torque, movements, co-contraction and coordination, drift of
                                  the gains (10 %), offset of the torque (0.5 N m), effort about its mean
  a moved electrode               on the biceps: another gain (half to twice), and more cross-talk of each other muscle
                                  (10 % of the brachialis, 5 % of the others, half normal)

These spreads are stated here, not taken from the estimator's beliefs. A number that `compare` calls "differs" and that
is the same in truth is an alarm. The biceps' F_max and voluntary torque and the flexors' torque and its angle change
with the biceps. Prints a table in Markdown, then what the page of both groups says.
"""
import argparse
import concurrent.futures
import csv
import json
import math
import pathlib
import random
import re
import statistics
import subprocess
import sys

STRONGER = 1.25
PROTOCOL = """name = "pairs"
level = "L1"

[control]
synergy = 1.0
brachialis_synergy = 1.0

[emg]
mvc_window_s = 4.0
mvc_effort = [{effort:.4f}, {effort:.4f}]

[truth]
beside_muscles = true
moment_arm_sd = 0.12
moment_arm_slope_sd = 0.08
tendon_strain = [0.02, 0.06]
crosstalk = {crosstalk:.4f}
torque_scale = {scale:.4f}
emg_gain_drift = {drift:.4f}
torque_offset_nm = {offset:.4f}
{muscles}
"""
EFFORTS = 'kind = "isometric_ramp"\npeak = 0.8\nrise_s = 1.0\nhold_s = 0.7\nrest_s = 0.3\n'
FLEXION = EFFORTS + 'direction = "flexion"\nrepetitions = 3\n'  # each with another grip
EXTENSION = EFFORTS + 'direction = "extension"\nangles_deg = [30, 100]\n'
TRIALS = {  # the maximal contraction amid the others, so that a drift of the gains cancels
    "extension_before": EXTENSION,
    "stretched": FLEXION + "angle_deg = 30\n",
    "half_stretched": FLEXION + "angle_deg = 55\n",
    "relaxed": 'kind = "passive"\nfrom_deg = 15\nto_deg = 125\nraise_s = 3.0\nlower_s = 3.0\n',
    "mvc": 'kind = "mvc"\nangle_deg = 80\ndirection = "both"\nhold_s = 5.0\n',
    "middle": FLEXION + "angle_deg = 75\n",
    "bent": FLEXION + "angle_deg = 95\n",
    "fully_bent": FLEXION + "angle_deg = 115\n",
    "extension_after": EXTENSION,
}
KINDS = {"unchanged": "nothing changed", "biceps": "biceps 25 % stronger", "electrode": "electrode of the biceps moved"}
CHANGED = {("BIC", "max_isometric_force"), ("BIC", "voluntary_torque")}
FOLLOWS = {("elbow_flexion", "voluntary_torque_positive"), ("elbow_flexion", "voluntary_torque_angle_positive")}


def run(*command):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False)
    if done.returncode not in (0, 4, 5):
        raise RuntimeError(f"{' '.join(map(str, command))}\n{done.stderr}")
    return done.stdout


def muscles_of(recording, factor):
    """The tables [truth.MUSCLE] of a recording's muscles, the biceps' F_max times a factor."""
    values = {}
    with (recording / "truth.csv").open() as file:
        for row in csv.DictReader(file):
            values.setdefault(row["muscle"], {})[row["parameter"]] = float(row["value"])
    fields = ("max_isometric_force", "optimal_fiber_length", "force_length_width", "concentric_curvature",
              "eccentric_curvature_product", "eccentric_plateau", "max_shortening_speed", "tendon_slack_length")
    values["BIC"]["max_isometric_force"] *= factor
    return "".join(f"\n[truth.{muscle}]\n" + "".join(f"{field} = {values[muscle][field]!r}\n" for field in fields)
                   for muscle in ("BIC", "BRA", "BRD", "TRI"))


def move_electrode(recording, draw):
    """Gives the biceps' channel another gain and a share of each other muscle's signal, in every trial."""
    with (recording / "truth/person.csv").open() as file:
        volt = {row["of"]: float(row["value"]) for row in csv.DictReader(file) if row["quantity"] == "greatest_emg_rms"}
    gain = math.exp(draw.uniform(math.log(0.5), math.log(2)))
    share = {other: abs(draw.gauss(0, 0.1 if other == "BRA" else 0.05)) for other in ("BRA", "BRD", "TRI")}
    (recording / "moved.json").write_text(json.dumps({"gain": gain, "crosstalk": share}))
    for path in recording.glob("*_emg.sto"):
        head, _, body = path.read_text().partition("endheader\n")
        lines = body.splitlines()
        names = lines[0].split("\t")
        at = {name: names.index(name) for name in volt}
        for i, line in enumerate(lines[1:], 1):
            cells = line.split("\t")
            if len(cells) == len(names):
                value = float(cells[at["BIC"]]) + sum(
                    share[other] * volt["BIC"] / volt[other] * float(cells[at[other]]) for other in share)
                cells[at["BIC"]] = f"{gain * value:.8g}"
                lines[i] = "\t".join(cells)
        path.write_text(head + "endheader\n" + "\n".join(lines) + "\n")


def session(program, out, seed, kind, effort_sd):
    """Records and runs a session, unless it was run before; returns its folder of results. kind: "first" or of KINDS."""
    recording, results = out / f"{seed}/{kind}", out / f"{seed}/{kind}_results"
    if (results / "parameters.json").exists():
        return results
    person, own = random.Random(f"person {seed}"), random.Random(f"{seed} {kind}")
    mean_effort = person.uniform(0.85, 1.0)
    numbers = {"crosstalk": abs(person.gauss(0, 0.05)), "scale": person.gauss(1, 0.02),
               "effort": 1 - abs(1 - mean_effort - own.gauss(0, effort_sd)),
               "drift": own.gauss(0, 0.1), "offset": own.gauss(0, 0.5)}
    muscles = "" if kind == "first" else muscles_of(out / f"{seed}/first", STRONGER if kind == "biceps" else 1.0)
    # The seed is the person. Noise and movements have the seed of the trial's name, too: another name, another draw.
    trials = "".join(f'\n[[trial]]\nname = "{name}_{kind}"\n{keys}' for name, keys in TRIALS.items())
    recording.mkdir(parents=True, exist_ok=True)
    protocol = out / f"{seed}/{kind}.toml"
    protocol.write_text(PROTOCOL.format(muscles=muscles, **numbers) + trials)
    run(program, "twin", "--protocol", protocol, "--seed", seed, "--threads", 1, "--out", recording, "--overwrite")
    if kind == "electrode":
        move_electrode(recording, own)
    # The twin writes the effort of the maximal contraction into the study; a laboratory does not know it.
    study = re.sub(r"\nmvc_effort.*", "", (recording / "study.toml").read_text())
    study = study.replace('method = ["paper", "torque"]', 'method = ["torque"]\nnext_movements = 0\nfolds = "condition"')
    (recording / "study.toml").write_text(study.replace("[[trial]]\n", '[[trial]]\ncondition = "all"\n'))
    run(program, "run", recording / "study.toml", "--threads", 1, "--out", results, "--overwrite")
    return results


def same_person(out, seed, kind):
    """Stops if anything but the biceps' strength differs between a person's two truths."""
    def read(of):
        with (out / f"{seed}/{of}/truth.csv").open() as file:
            return {(row["muscle"], row["parameter"]): float(row["value"]) for row in csv.DictReader(file)
                    if not row["parameter"].startswith("voluntary")}
    first, second = read("first"), read(kind)
    for key, value in first.items():
        expected = value * (STRONGER if kind == "biceps" and key == ("BIC", "max_isometric_force") else 1.0)
        if not math.isclose(second[key], expected, rel_tol=1e-9, abs_tol=1e-12):
            sys.exit(f"person {seed}, {kind}: {key} is {second[key]}, expected {expected}")


def person(program, out, seed, kinds, effort_sd):
    """The verdicts of `compare` of each kind of pair."""
    first = session(program, out, seed, "first", effort_sd)
    found = {}
    for kind in kinds:
        second = session(program, out, seed, kind, effort_sd)
        same_person(out, seed, kind)
        file = out / f"{seed}/{kind}_compared.json"
        file.write_text(run(program, "compare", first, second, "--json"))
        found[kind] = json.loads(file.read_text())
    return found


def group(program, out, seeds, kind):
    """Headline of the page of both groups, and how many numbers it calls different."""
    folder = out / f"group_{kind}"
    run(program, "report", "--group", *(out / f"{seed}/first_results" for seed in seeds), "--after",
        *(out / f"{seed}/{kind}_results" for seed in seeds), "--out", folder, "--overwrite")
    with (folder / "tables/changes.csv").open() as file:
        differ = sum(int(row["differ"]) for row in csv.DictReader(file))
    return json.loads((folder / "report.json").read_text())["headline"], differ


def line(kind, pairs):
    """A row of the table, and the number of numbers that differ."""
    alarms = {"F_max": 0, "voluntary torque": 0, "other": 0}
    any_alarm = f_max = either = differ = 0
    half = {key: [] for key in sorted(CHANGED)}
    for pair in pairs:
        different = {(row["muscle"], row["parameter"]) for row in pair["parameters"] if row["change"] == "differs"}
        differ += len(different)
        true = CHANGED | FOLLOWS if kind == "biceps" else set()
        wrong = different - true
        any_alarm += bool(wrong)
        alarms["F_max"] += any(name == "max_isometric_force" for _, name in wrong)
        alarms["voluntary torque"] += any(name.startswith("voluntary") for _, name in wrong)
        alarms["other"] += any(name != "max_isometric_force" and not name.startswith("voluntary") for _, name in wrong)
        f_max += ("BIC", "max_isometric_force") in different
        either += bool(different & CHANGED)
        for row in pair["parameters"]:
            key = (row["muscle"], row["parameter"])
            if key in half and row["smallest_detectable"]:
                half[key].append(row["smallest_detectable"] / abs(row["first"]))
    n = len(pairs)
    width = " / ".join(f"{100 * statistics.median(x):.0f} % ({len(x)})" if x else "–" for x in half.values())
    found = f"{either} ({100 * either / n:.0f} %); F_max {f_max}" if kind == "biceps" else "–"
    text = " | ".join([KINDS[kind], str(n), f"{any_alarm} ({100 * any_alarm / n:.0f} %): " +
                       " / ".join(str(x) for x in alarms.values()), found, width])
    return f"| {text} |", differ


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("pairs", type=int, nargs="?", default=40)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--effort-sd", type=float, default=0.03)
    parser.add_argument("--kinds", nargs="+", choices=KINDS, default=list(KINDS))
    options = parser.parse_args()
    seeds = range(1, options.pairs + 1)
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        persons = list(pool.map(
            lambda seed: person(options.program, options.out, seed, options.kinds, options.effort_sd), seeds))
    print("| kind of pair | pairs | alarms: F_max / voluntary torque / other | biceps found | half width of the change "
          "of the biceps' F_max / voluntary torque, median (pairs that tell it) |")
    print("| --- | --- | --- | --- | --- |")
    pages = []
    for kind in options.kinds:
        text, differ = line(kind, [found[kind] for found in persons])
        print(text, flush=True)
        headline, of_page = group(options.program, options.out, seeds, kind)
        if differ != of_page:
            sys.exit(f"{kind}: compare calls {differ} numbers different, the page of the group {of_page}")
        pages.append(f"{KINDS[kind]}: {headline}")
    print("", *pages, sep="\n")


if __name__ == "__main__":
    main()

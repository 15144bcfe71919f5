#!/usr/bin/env python3
"""A leg of 34 muscles with 9 EMG channels: do intervals and verdicts hold where most muscles have no EMG?

usage: virtual_leg.py MYOID MODEL.osim [--persons 4] [--few | --knee] [--choices left-out,tie,unseen,synergies] [--out FOLDER]

MODEL: gait2392. --few: a leg of 17 muscles. --knee: ten
muscles and the torque of the knee, six EMG channels. Its paths give lengths and moment arms about hip, knee and ankle of made-up movements. Every person has
muscles, moment arms, activations and errors of measurement of its own; the law of a muscle is written here. Activations
are sums of five synergies and a part of the muscle's own. The study gets the model's muscles and paths, torques with
errors and nine noisy envelopes. Per choice the script prints the share of 95 % intervals of the person that hold the
truth, of muscles with and without EMG, the numbers called identified and how many of these lie within 15 % of the
truth, and R2 and the band's share of a trial that was held back.
"""
import argparse
import csv
import pathlib
import subprocess
import time
import xml.etree.ElementTree as xml

import numpy as np

ANGLES = ["hip_flexion_r", "knee_angle_r", "ankle_angle_r"]
JOINTS = list(ANGLES)
MEASURED = ["glut_max2", "rect_fem", "vas_lat", "vas_med", "bifemlh", "semiten", "med_gas", "soleus", "tib_ant"]
TIED = {"glut_max1": "glut_max2", "glut_max3": "glut_max2", "glut_med1": "glut_max2", "glut_med2": "glut_max2",
        "glut_med3": "glut_max2", "add_mag1": "semiten", "add_mag2": "semiten", "add_mag3": "semiten",
        "add_long": "rect_fem", "add_brev": "rect_fem", "pect": "rect_fem", "iliacus": "rect_fem", "psoas": "rect_fem",
        "tfl": "rect_fem", "sar": "rect_fem", "grac": "semiten", "semimem": "semiten", "bifemsh": "bifemlh",
        "vas_int": "vas_lat", "lat_gas": "med_gas", "tib_post": "soleus", "flex_dig": "soleus", "per_long": "soleus",
        "per_brev": "soleus", "ext_dig": "tib_ant"}
FEW = ["psoas", "iliacus", "vas_int", "semimem", "lat_gas", "bifemsh", "tib_post", "glut_max1"]
KNEE = ["rect_fem", "vas_lat", "vas_med", "bifemlh", "semiten", "med_gas"]
HIDDEN_AT_KNEE = ["vas_int", "semimem", "lat_gas", "bifemsh"]
MUSCLES = MEASURED + list(TIED)
RATE = 100.0
SECONDS = 8.0
DELAY = 0.06


def starts(model):
    found = {}
    for element in xml.parse(model).getroot().iter():
        name = element.get("name", "")
        if name.endswith("_r") and name[:-2] in MUSCLES and element.find("max_isometric_force") is not None:
            found[name[:-2]] = {k: float(element.find(k).text) for k in
                                ("max_isometric_force", "optimal_fiber_length", "tendon_slack_length")}
    return found


def movement(kind, rng, t):
    """Angles of hip, knee and ankle [rad], and the phase of the movement."""
    cycle = {"slow": 1.6, "fast": 1.1, "squat": 2.6, "swing": 1.8}[kind] * rng.uniform(0.9, 1.1)
    p = 2 * np.pi * (t / cycle + 0.03 * np.sin(2 * np.pi * t / 5.3))
    deep = 1 + 0.2 * np.sin(2 * np.pi * t / 6.1 + rng.uniform(0, 6))
    hip, knee, ankle = {
        "slow": (10 + 20 * np.cos(p), -30 + 25 * np.cos(p + 2.2) + 8 * np.cos(2 * p), 10 * np.sin(p + 1) - 2),
        "fast": (12 + 28 * np.cos(p), -40 + 32 * np.cos(p + 2.2) + 9 * np.cos(2 * p), 14 * np.sin(p + 1) - 3),
        "squat": (40 - 38 * np.cos(p), -48 + 42 * np.cos(p), 12 - 14 * np.cos(p)),
        "swing": (20 + 35 * np.cos(p), -45 + 38 * np.cos(1.5 * p + 1), -8 + 22 * np.cos(1.3 * p + 2)),
    }[kind]
    return np.radians(np.stack([hip * deep, np.minimum(knee * deep, -2), ankle * deep], 1)), p


def columns(path):
    head, *rows = path.read_text().split("endheader")[1].strip().splitlines()
    return dict(zip(head.split("\t"), np.array([[float(x) for x in r.split()] for r in rows]).T))


def write(path, names, t, values):
    rows = "".join("\t".join(f"{x:.9g}" for x in (ti, *row)) + "\n" for ti, row in zip(t, values))
    path.write_text(f"{path.stem}\nversion=1\nnRows={len(t)}\nnColumns={len(names) + 1}\ninDegrees=no\nendheader\n"
                    + "time\t" + "\t".join(names) + "\n" + rows)


def paths(program, model, t, q, folder):
    """Lengths, n x muscles, and moment arms, n x muscles x joints, by the model."""
    folder.mkdir(parents=True)
    write(folder / "q.mot", ANGLES, t, q)
    subprocess.run([program, "paths", "--model", model, "--motion", folder / "q.mot", "--out", folder / "out"],
                   check=True, capture_output=True)
    length = columns(folder / "out/MuscleAnalysis_Length.sto")
    arms = [columns(folder / f"out/MuscleAnalysis_MomentArm_{j}.sto") for j in JOINTS]
    return (np.stack([length[m + "_r"] for m in MUSCLES], 1),
            np.stack([np.stack([a[m + "_r"] for m in MUSCLES], 1) for a in arms], 2))


def smooth_noise(rng, n, count, tau):
    x = rng.standard_normal((n, count))
    keep = np.exp(-1 / (RATE * tau))
    for i in range(1, n):
        x[i] = keep * x[i - 1] + np.sqrt(1 - keep * keep) * x[i]
    return x


def low_passed(x, rate, cutoff):
    f = np.fft.rfftfreq(len(x), 1 / rate) / (cutoff / (np.sqrt(2) - 1) ** 0.25)
    return np.fft.irfft(np.fft.rfft(x, axis=0) / (1 + f[:, None] ** 4), len(x), axis=0)


class Person:
    def __init__(self, start, trials, rng):
        common = np.exp(0.3 * rng.standard_normal())
        self.arm = 1 + 0.12 * rng.standard_normal((len(MUSCLES), len(JOINTS)))
        self.numbers = {}
        for k, m in enumerate(MUSCLES):
            while True:
                l0 = start[m]["optimal_fiber_length"] * (1 + 0.12 * rng.standard_normal())
                slack = start[m]["tendon_slack_length"] * np.exp(0.07 * rng.standard_normal())
                fibers = [(self.length(t, k) - slack) / l0 for t in trials]
                if min(f.min() for f in fibers) > 0.1:
                    break
            self.numbers[m] = {
                "max_isometric_force": start[m]["max_isometric_force"] * common * np.exp(0.25 * rng.standard_normal()),
                "optimal_fiber_length": l0, "tendon_slack_length": slack,
                "force_length_width": 0.45 * l0 * np.exp(0.1 * rng.standard_normal()),
                "concentric_curvature": 0.28 * np.exp(0.25 * rng.standard_normal()),
                "eccentric_plateau": 1.4 + 0.1 * rng.standard_normal(),
                "max_shortening_speed": 10 * l0 * np.exp(0.15 * rng.standard_normal())}
        # Five bursts in the cycle, each with few muscles, and a part of the muscle's own.
        self.centers = rng.uniform(0, 2 * np.pi, 5)
        self.widths = rng.uniform(0.5, 1.0, 5)
        self.weights = rng.gamma(0.7, 1.0, (len(MUSCLES), 5))
        self.level = np.clip(0.1 * np.exp(0.6 * rng.standard_normal(len(MUSCLES))), 0.02, 0.3)
        self.own_center = rng.uniform(0, 2 * np.pi, len(MUSCLES))

    def length(self, trial, k):
        """The muscle's own length: that of the model, and of arms that differ by a factor."""
        own = trial["length"][:, k].copy()
        for j, joint in enumerate(JOINTS):
            moved = -np.cumsum(trial["arm"][:, k, j] * np.gradient(trial["q"][:, ANGLES.index(joint)]))
            own += (self.arm[k, j] - 1) * (moved - moved.mean())
        return own

    def activations(self, phase, rng):
        n = len(phase)
        bursts = np.stack([np.exp((np.cos(phase - c) - 1) / w ** 2) for c, w in zip(self.centers, self.widths)], 1)
        bursts *= np.exp(0.25 * smooth_noise(rng, n, 5, 1.0))
        a = bursts @ self.weights.T
        own = np.exp((np.cos(phase[:, None] - self.own_center) - 1) / 0.5) + 0.3 * np.abs(
            smooth_noise(rng, n, len(MUSCLES), 0.3))
        mixed = a / a.mean(0) + 0.4 * own / own.mean(0)
        return np.clip(self.level * mixed / 1.4, 0.002, 1.0)

    def torques(self, trial, a, t):
        late = np.stack([np.interp(t - DELAY, t, x) for x in a.T], 1)
        torque = np.zeros((len(t), len(JOINTS)))
        for k, m in enumerate(MUSCLES):
            p = self.numbers[m]
            length = self.length(trial, k)
            v, vm = np.gradient(length, t), p["max_shortening_speed"]
            vsh, vml = p["concentric_curvature"], p["eccentric_plateau"]
            product = (vml - 1) * vsh / (1.5 * (1 + vsh))
            force = np.exp(-((length - p["tendon_slack_length"] - p["optimal_fiber_length"]) /
                             p["force_length_width"]) ** 2) * p["max_isometric_force"] * late[:, k]
            force *= np.where(v > 0, (product * vm + vml * v) / (product * vm + v),
                              np.maximum(vsh * (vm + v) / (vsh * vm - v), 0))
            torque += force[:, None] * trial["arm"][:, k] * self.arm[k]
        return torque


def envelopes(a, t, rng):
    """Rectified noise of 150 Hz bandwidth about the activation, behind a low-pass of 6 Hz."""
    fine = np.arange(t[0], t[-1], 1 / 300)
    raw = np.stack([np.interp(fine, t, x) for x in a.T], 1)
    raw *= np.abs(rng.standard_normal(raw.shape)) * np.sqrt(np.pi / 2)
    smooth = np.maximum(low_passed(raw, 300, 6.0), 0)
    return np.stack([np.interp(t, fine, x) for x in smooth.T], 1)


def emg_line(m, choice):
    if m in MEASURED:
        return f'emg = "{m}"'
    return f'emg = {{ same_as = "{TIED[m]}" }}' if choice == "tie" else f'without_emg = "{choice}"'


def write_study(folder, choice, start, names):
    study = folder / f"{choice}.toml"
    text = ('[model]\nbuiltin = "none"\ncoordinate = [' + ", ".join(f'"{j}"' for j in JOINTS) + ']\n'
            '[emg]\nkind = "activation"\n[identify]\nmethod = "torque"\ncross_validate = false\n')
    for m in MUSCLES:
        if m not in MEASURED and choice == "left-out":
            continue
        numbers = ", ".join(f"{k} = {v:.6g}" for k, v in start[m].items())
        text += f'[[muscle]]\nname = "{m}"\n{emg_line(m, choice)}\nstart = {{ {numbers} }}\n'
    for name in names:
        use = "validation" if name.startswith("held") else "calibration"
        arms = ", ".join(f'"{name}_arm_{j}.sto"' for j in JOINTS)
        text += (f'[[trial]]\nname = "{name}"\nuse = "{use}"\nemg = "{name}_emg.sto"\nlengths = "{name}_length.sto"\n'
                 f'moment_arms = [{arms}]\ntorques = "{name}_torque.sto"\n')
    study.write_text(text)
    return study


def make_person(folder, start, trials, seed):
    rng = np.random.default_rng(seed)
    person = Person(start, trials.values(), rng)
    folder.mkdir(parents=True)
    gain = 1 + 0.06 * rng.standard_normal(len(MEASURED))
    scale = 1 + 0.03 * rng.standard_normal()
    for name, trial in trials.items():
        t = trial["t"]
        a = person.activations(trial["phase"] + rng.uniform(-0.2, 0.2), rng)
        torque = person.torques(trial, a, t) * scale
        torque += 0.05 * np.sqrt((torque ** 2).mean(0)) * smooth_noise(rng, len(t), len(JOINTS), 0.3)
        write(folder / f"{name}_emg.sto", MEASURED, t, envelopes(a[:, :len(MEASURED)], t, rng) * gain)
        write(folder / f"{name}_length.sto", MUSCLES, t, trial["length"])
        for j, joint in enumerate(JOINTS):
            write(folder / f"{name}_arm_{joint}.sto", MUSCLES, t, trial["arm"][:, :, j])
        write(folder / f"{name}_torque.sto", JOINTS, t, torque)
    return person


class Score:
    def __init__(self):
        self.held = {}
        self.identified, self.right, self.of_unseen, self.seconds = 0, 0, 0, 0.0
        self.r2, self.band = [], []

    def add(self, person, out):
        for row in csv.DictReader((out / "parameters.csv").open()):
            truth = person.numbers.get(row["muscle"], {}).get(row["parameter"])
            if truth is None or not row["ci_low"]:
                continue
            measured = row["muscle"] in MEASURED
            hit = float(row["ci_low"]) <= truth <= float(row["ci_high"])
            self.held.setdefault((row["parameter"], measured), []).append(hit)
            if row["verdict"] != "identified":
                continue
            self.identified += 1
            self.of_unseen += not measured
            self.right += abs(float(row["estimate"]) / truth - 1) < 0.15
        for row in csv.DictReader((out / "tables/validation_trials.csv").open()):
            self.r2.append(float(row["R2"]))
            self.band.append(float(row["in band"].split()[0]))

    def text(self):
        lines = []
        for measured in (True, False):
            of = {p: h for (p, m), h in self.held.items() if m == measured}
            if of:
                every = sum(of.values(), [])
                lines.append(f"  {'with' if measured else 'without'} EMG: {100 * np.mean(every):.1f} % of {len(every)}; "
                             + ", ".join(f"{p} {100 * np.mean(h):.0f}" for p, h in of.items()))
        lines.append(f"  identified {self.identified}, within 15 % {self.right}, of muscles without EMG "
                     f"{self.of_unseen}; {self.seconds:.0f} s a person; held out: R2 "
                     + " ".join(f"{x:.2f}" for x in self.r2) + ", in band "
                     + " ".join(f"{x:.0f}" for x in self.band) + " %")
        return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("model")
    parser.add_argument("--persons", type=int, default=4)
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--few", action="store_true")
    parser.add_argument("--knee", action="store_true")
    parser.add_argument("--choices", default="left-out,tie,unseen,synergies")
    parser.add_argument("--out", default="virtual-leg")
    args = parser.parse_args()
    out = pathlib.Path(args.out)
    if args.few:
        MUSCLES[:] = MEASURED + FEW
    if args.knee:
        MEASURED[:], JOINTS[:] = KNEE, ["knee_angle_r"]
        MUSCLES[:] = KNEE + HIDDEN_AT_KNEE
    start = starts(args.model)
    kinds = {"slow": "slow", "fast": "fast", "squat": "squat", "swing": "swing", "held": "fast"}
    scores = {choice: Score() for choice in args.choices.split(",")}
    for seed in range(args.first, args.first + args.persons):
        folder = out / f"person{seed}"
        rng = np.random.default_rng(1000 + seed)
        t = np.arange(0, SECONDS, 1 / RATE)
        trials = {}
        for name, kind in kinds.items():
            q, phase = movement(kind, rng, t)
            length, arm = paths(args.program, args.model, t, q, folder / "paths" / name)
            trials[name] = {"t": t, "q": q, "phase": phase, "length": length, "arm": arm}
        person = make_person(folder / "data", start, trials, seed)
        for choice, score in scores.items():
            study = write_study(folder / "data", choice, start, trials)
            result = folder / choice
            begin = time.time()
            done = subprocess.run([args.program, "run", study, "--out", result, "--overwrite"], capture_output=True,
                                  text=True)
            if not (result / "parameters.csv").exists():
                print(choice, seed, done.returncode, done.stdout[-1000:], done.stderr[-2000:])
                continue
            score.seconds += (time.time() - begin) / args.persons
            score.add(person, result)
            print(f"person {seed}, {choice}, {time.time() - begin:.0f} s", flush=True)
    for choice, score in scores.items():
        print(choice)
        print(score.text())


if __name__ == "__main__":
    main()

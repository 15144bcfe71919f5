"""usage: check_numbers.py PROGRAM EXAMPLES PROGRAMS

Runs the six numbered examples of the folder PROGRAMS on a virtual recording that PROGRAM makes, and compares what they
print with sources that share no code with them: the recording's files read again, the truth that the virtual person was
made with, and the formulas of the muscle's laws. Python's own library is enough.
"""

import math
import re
import subprocess
import sys
import tempfile
from pathlib import Path

NUMBER = r"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?"


def expect(found, wanted, tolerance, about):
    if not abs(found - wanted) <= tolerance:
        sys.exit(f"{about}: {found:g} is printed, {wanted:g} +- {tolerance:g} is expected")


def said(output, label):
    """All numbers of the line that begins with this label."""
    for line in output.splitlines():
        if line.startswith(label + ":"):
            return [float(n) for n in re.findall(NUMBER, line[len(label) + 1 :])]
    sys.exit(f"no line {label!r} in:\n{output}")


def columns(path):
    """The columns of a storage file by name."""
    head, body = path.read_text().split("endheader\n")
    names, *rows = [line.split("\t") for line in body.splitlines() if line.strip()]
    return {name: [float(row[k]) for row in rows] for k, name in enumerate(names)}


def truth_of(recording):
    rows = [line.split(",") for line in (recording / "truth.csv").read_text().splitlines()[1:]]
    return {(muscle, parameter): float(value) for muscle, parameter, _, value in rows}


def mean(values):
    return sum(values) / len(values)


def ladder(recording, examples, out):
    """The arguments of the six examples."""
    laws = examples / "03_muscle_forces"
    return {
        "01_read_a_recording": [recording / "swing_2kg.trc", recording / "swing_2kg_emg.sto"],
        "02_joint_angles": [recording / "model.osim", recording / "swing_2kg.trc", "2", out / "ik.mot"],
        "03_muscle_forces": [laws / "triceps.toml", laws / "lengths.csv"],
        "04_identify_triceps": [recording / "study.toml", recording / "mvc_emg.sto", recording / "ramp_emg.sto"],
        "05_how_sure_are_we": [recording / "study.toml"],
        "06_simulate_and_recover": [examples / "protocols" / "three_trials.toml", out / "person"],
    }


def check_read_a_recording(output, recording, out):
    """Against the text of the files."""
    lines = (recording / "swing_2kg.trc").read_text().splitlines()
    rate, _, frames, markers = (float(cell) for cell in lines[2].split("\t")[:4])
    expect(said(output, "markers")[0], markers, 0, "markers")
    expect(said(output, "frames")[0], frames, 0, "frames")
    expect(said(output, "frame rate")[0], rate, 1e-3, "frame rate")
    expect(said(output, "duration")[0], (frames - 1) / rate, 1e-5, "duration")
    first = next(line for line in lines if line.startswith("1\t")).split("\t")
    expect(float(re.search(rf"height of .*: ({NUMBER}) m", output)[1]), float(first[3]) / 1000, 5e-6, "height")
    emg = columns(recording / "swing_2kg_emg.sto")
    expect(said(output, "EMG rate")[0], 1 / (emg["time"][1] - emg["time"][0]), 1e-2, "EMG rate")
    for muscle in ("BIC", "BRA", "BRD", "TRI"):
        rms = 1e6 * math.sqrt(mean([v * v for v in emg[muscle]]))
        expect(said(output, f"EMG of {muscle}")[0], rms, 1e-5 * rms, f"EMG of {muscle}")


def check_joint_angles(output, recording, out):
    """Against the truth. Of the markers, 14 with 0.5 mm of noise, an angle is known to about 0.1 degrees; the least and
    the greatest of 1001 are 3.3 of such spreads further out. The torque follows the smoothed acceleration."""
    angle = [math.degrees(q) for q in columns(recording / "truth" / "swing_2kg_motion.sto")["elbow_flexion"]]
    torque = columns(recording / "truth" / "swing_2kg_torque.sto")["elbow_flexion_moment"]
    expect(said(output, "frames not converged")[0], 0, 0, "frames not converged")
    expect(said(output, "least flexion")[0], min(angle), 0.5, "least flexion")
    expect(said(output, "greatest flexion")[0], max(angle), 0.5, "greatest flexion")
    expect(said(output, "mean torque")[0], mean(torque), 0.02, "mean torque")
    expect(said(output, "greatest torque")[0], max(torque), 0.3, "greatest torque")


def check_muscle_forces(output, recording, out):
    """Against equations (2) to (4) of the source paper, with the numbers of triceps.toml; exact but for the digits."""
    rows = [[float(n) for n in re.findall(NUMBER, line)] for line in output.splitlines()]
    expect(len(rows), 12, 0, "instants")
    for time, length, speed, force in rows:
        f_l = math.exp(-(((length - 0.12) / 0.05) ** 2))
        v = speed / 1.2
        f_v = 0.28 * (1 + v) / (0.28 - v) if v <= 0 else (0.06 + 1.4 * v) / (0.06 + v)
        wanted = 0.5 * 2000 * f_l * f_v
        expect(force, wanted, 1e-3 * wanted, f"force at {time} s")
    for time, length, speed in ((0.1, 0.12, 0.0), (0.4, 0.08, -0.2), (0.6, 0.06, 0.0), (0.9, 0.08, 0.1)):
        row = next(row for row in rows if row[0] == time)
        expect(row[1], length, 5e-5, f"length at {time} s")
        expect(row[2], speed, 5e-5, f"speed at {time} s")


def check_identify_triceps(output, recording, out):
    """Against the truth. An EMG of 1 kHz below 6 Hz has some ten percent of noise in each instant and little in the mean;
    the estimates lie within three standard errors."""
    activation = columns(recording / "truth" / "ramp_activation.sto")["TRI"]
    truth = truth_of(recording)
    expect(said(output, "mean activation of TRI")[0], mean(activation), 0.02, "mean activation")
    expect(said(output, "greatest activation of TRI")[0], max(activation), 0.2, "greatest activation")
    for parameter in ("max_isometric_force", "optimal_fiber_length", "force_length_width", "concentric_curvature"):
        estimate, error = said(output, parameter)[:2]
        expect(estimate, truth["TRI", parameter], 3 * error, parameter)
        expect(error, 0, 0.5 * estimate, f"standard error of {parameter}")


def check_how_sure_are_we(output, recording, out):
    """Against the truth: three of four intervals of 95 % hold it but for one recording in 70. The literature's F_max are a
    multiple of them away, or outside."""
    truth = truth_of(recording)
    held = 0
    for muscle in ("BIC", "BRA", "BRD", "TRI"):
        estimate, percent, low, high = said(output, f"strength of {muscle}")
        expect(percent, 95, 0, "level")
        expect((high - low) / estimate, 0.75, 0.5, f"width of the interval of {muscle}")
        held += low <= truth[muscle, "max_isometric_force"] <= high
    expect(held, 4, 1, "intervals that hold the truth")
    verdicts = ("identified", "reproducible", "weak", "prior_dominated", "not_identifiable")
    counted = sum(said(output, verdict)[0] for verdict in verdicts)
    expect(counted, 74, 0, "numbers of the study")


def check_simulate_and_recover(output, recording, out):
    """Against the files of the person that the example made: its truth, and the share of the true torque's variation
    that the printed error leaves."""
    person = out / "person" / "recording"
    truth = truth_of(person)
    for muscle in ("BIC", "BRA", "BRD", "TRI"):
        found, true = said(output, f"strength of {muscle}")
        expect(true, truth[muscle, "max_isometric_force"], 0.05 + 1e-9, f"true strength of {muscle}")
        expect(found, true, 0.35 * true, f"strength of {muscle}")
    r2, error = re.search(rf"torque of held_back_2kg: R2 ({NUMBER}), error ({NUMBER}) N m rms", output).groups()
    torque = columns(person / "truth" / "held_back_2kg_torque.sto")["elbow_flexion_moment"]
    variance = mean([t * t for t in torque]) - mean(torque) ** 2
    expect(float(r2), 1 - float(error) ** 2 / variance, 0.01, "R2 of the torque")
    expect(float(r2), 1, 0.2, "R2 of the torque")


def main(program, examples, programs):
    examples, programs = Path(examples).resolve(), Path(programs).resolve()
    with tempfile.TemporaryDirectory(prefix="myoid.") as folder:
        recording, out = Path(folder) / "recording", Path(folder)
        protocol = examples / "protocols" / "three_trials.toml"
        subprocess.run([program, "twin", "--protocol", protocol, "--out", recording, "--quiet"], check=True)
        for name, arguments in ladder(recording, examples, out).items():
            output = subprocess.run(
                [programs / name[3:], *arguments], stdout=subprocess.PIPE, text=True, check=True
            ).stdout
            print(f"== {name}\n{output}", flush=True)
            globals()[f"check_{name[3:]}"](output, recording, out)
            refused = subprocess.run([programs / name[3:], "missing"] + ["missing"] * (len(arguments) - 1),
                                     stderr=subprocess.PIPE, text=True, cwd=folder, check=False)  # fmt: skip
            if refused.returncode != 3 or "missing" not in refused.stderr:
                sys.exit(f"{name}: files that are not there give {refused.returncode}: {refused.stderr}")


if __name__ == "__main__":
    main(*sys.argv[1:])

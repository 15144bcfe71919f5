#!/usr/bin/env python3
"""Processor time and memory of a fit as functions of muscles, joints and frames.

usage: leg_cost.py MYOID [--quick] [--out FOLDER]

Every study gives lengths, moment arms and torques of one trial; a third of the muscles has EMG, the others are
`unseen`. Printed are seconds of processor time, the greatest resident memory and the exponents of a power law.
"""
import argparse
import os
import pathlib
import subprocess

import numpy as np

from virtual_leg import write


def study(folder, muscles, joints, frames):
    rng = np.random.default_rng(1)
    folder.mkdir(parents=True, exist_ok=True)
    t = np.arange(frames) / 100.0
    angle = [0.5 * np.sin(2 * np.pi * t / (1.3 + 0.4 * j)) for j in range(joints)]
    arm = np.where(rng.random((muscles, joints)) < 1.5 / joints, rng.uniform(-0.05, 0.05, (muscles, joints)), 0)
    arm[np.arange(muscles), np.arange(muscles) % joints] = rng.uniform(0.02, 0.05, muscles) * (-1) ** np.arange(muscles)
    length = 0.35 - sum(np.outer(q, arm[:, j]) for j, q in enumerate(angle))
    names = [f"m{k}" for k in range(muscles)]
    activation = np.clip(0.15 * (1 + np.sin(2 * np.pi * np.outer(t, rng.uniform(0.4, 1.2, muscles)) +
                                            rng.uniform(0, 6, muscles))), 0, 1)
    force = 1000 * activation * np.exp(-((length - 0.35) / 0.045) ** 2)
    measured = [n for k, n in enumerate(names) if k % 3 == 0 or muscles < 6]
    write(folder / "emg.sto", measured, t, activation[:, [names.index(n) for n in measured]])
    write(folder / "length.sto", names, t, length)
    torque = np.zeros((frames, joints))
    for j in range(joints):
        write(folder / f"arm_q{j}.sto", names, t, np.broadcast_to(arm[:, j], (frames, muscles)))
        torque[:, j] = force @ arm[:, j]
    torque += 0.03 * np.sqrt((torque ** 2).mean(0)) * rng.standard_normal(torque.shape)
    write(folder / "torque.sto", [f"q{j}" for j in range(joints)], t, torque)
    text = '[model]\nbuiltin = "none"\ncoordinate = [' + ", ".join(f'"q{j}"' for j in range(joints)) + "]\n"
    text += '[emg]\nkind = "activation"\n[identify]\nmethod = "torque"\ncross_validate = false\n'
    for n in names:
        emg = f'emg = "{n}"' if n in measured else 'without_emg = "unseen"'
        text += (f'[[muscle]]\nname = "{n}"\n{emg}\nstart = {{ max_isometric_force = 900, optimal_fiber_length = 0.1, '
                 "tendon_slack_length = 0.25 }\n")
    arms = ", ".join(f'"arm_q{j}.sto"' for j in range(joints))
    (folder / "study.toml").write_text(
        f'{text}[[trial]]\nname = "t"\nemg = "emg.sto"\nlengths = "length.sto"\nmoment_arms = [{arms}]\n'
        'torques = "torque.sto"\n')


def cost(program, folder):
    child = subprocess.Popen([program, "run", folder / "study.toml", "--out", folder / "out", "--overwrite"],
                             stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    used = os.wait4(child.pid, 0)[2]
    return used.ru_utime + used.ru_stime, used.ru_maxrss / 1024


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--out", default="leg-cost")
    args = parser.parse_args()
    many = [4, 8, 16] if args.quick else [4, 8, 16, 32, 64, 114]
    few = [1, 2] if args.quick else [1, 2, 3, 6]
    long = [1000, 4000] if args.quick else [1000, 10000, 100000]
    series = {"muscles": [(m, 1, 1000) for m in many], "joints": [(12, j, 1000) for j in few],
              "frames": [(4, 1, n) for n in long]}
    if not args.quick:
        series["leg"] = [(43, 6, 120)]
    for number, (name, cases) in enumerate(series.items()):
        found = []
        for muscles, joints, frames in cases:
            folder = pathlib.Path(args.out) / f"{muscles}_{joints}_{frames}"
            study(folder, muscles, joints, frames)
            found.append(cost(args.program, folder))
            print(f"{muscles} muscles, {joints} joints, {frames} frames: {found[-1][0]:.1f} s, {found[-1][1]:.0f} MB",
                  flush=True)
        if len(cases) > 1:
            x = np.log([case[number] for case in cases])
            print(f"  exponent of {name}: time {np.polyfit(x, np.log([f[0] for f in found]), 1)[0]:.2f}, memory "
                  f"{np.polyfit(x, np.log([f[1] for f in found]), 1)[0]:.2f}", flush=True)


if __name__ == "__main__":
    main()

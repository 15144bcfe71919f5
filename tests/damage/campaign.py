#!/usr/bin/env python3
"""A campaign of mutations over all commands: campaign.py PROGRAM [--seconds S] [--runs N] [--seed K] [--keep DIR]

Good inputs are a small virtual person, the results of every command on that person, and the small files of the shared
recordings (MYOID_DATA, or ../shared/data) where they are there. Each run copies the inputs of one command into a folder
of its own, damages one of them, runs the program, and asks:

  crash      does the program end by a signal or with exit code 1?
  sanitizer  does a sanitizer speak? (build the program with the preset asan)
  hang       does the program need more than TIMEOUT seconds?
  silence    does the program refuse and not say why?
  lost       is an input, or a stranger's file beside the output, gone or changed?
  changed    exit code 0, other numbers, and no message that the undamaged input does not give too? Asked of damages
             that every reader can see: rows out of order, ragged rows, files shorter than their headers say.

Ends with 1 if any answer is yes, and prints the damage and the command of each.
"""

import argparse
import concurrent.futures
import hashlib
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

TIMEOUT = 120
SOURCE = Path(__file__).resolve().parents[2]
DATA = Path(os.environ.get("MYOID_DATA", SOURCE / "../shared/data"))
LARGEST = 400_000  # bytes of a file of the shared recordings
PROTOCOL = """level = "L1"
[[trial]]
name = "mvc"
kind = "mvc"
direction = "both"
[[trial]]
name = "lift"
kind = "eccentric"
held_mass_kg = 1.0
"""


class Case:
    """A command, its inputs by place, and those of them that are damaged."""

    def __init__(self, name, arguments, inputs, damaged=None):
        self.name, self.arguments, self.inputs = name, arguments, inputs
        self.damaged = damaged or list(inputs)
        self.good = None  # numbers and messages of the undamaged run


def run(program, arguments, folder, timeout=TIMEOUT):
    environment = {**os.environ, "ASAN_OPTIONS": "detect_leaks=0:allocator_may_return_null=1:exitcode=99",
                   "UBSAN_OPTIONS": "halt_on_error=1:exitcode=99", "NO_COLOR": "1"}
    try:
        done = subprocess.run([program, *arguments], cwd=folder, capture_output=True, timeout=timeout, env=environment,
                              stdin=subprocess.DEVNULL, check=False)
        return done.returncode, done.stdout.decode(errors="replace"), done.stderr.decode(errors="replace")
    except subprocess.TimeoutExpired:
        return None, "", ""


# The good inputs ------------------------------------------------------------------------------------------------------

def virtual_person(program, folder):
    """Makes a virtual person and the result of every stage in `folder`; returns the cases that start from them."""
    (folder / "p.toml").write_text(PROTOCOL)
    for arguments in (
        "twin --protocol p.toml --out rec",
        "run rec/study.toml --out res",
        "ik --model rec/model.osim --markers rec/lift.trc --out ik.mot",
        "id --model rec/model.osim --motion ik.mot --lowpass 6 --out id.sto",
        "paths --model rec/model.osim --motion ik.mot --out paths",
        "emg rec/lift_emg.sto --out activation.sto",
        "convert rec/lift.trc lift.c3d", "convert rec/lift_emg.sto emg.csv", "convert ik.mot ik.csv",
        "update-file rec/model.osim new.osim",
    ):
        code, _, err = run(program, arguments.split(), folder, 600)
        if code not in (0, 4):
            sys.exit(f"{arguments}: {code}: {err}")
    (folder / "ik.xml").write_text(
        '<?xml version="1.0"?>\n<OpenSimDocument Version="40000">\n<InverseKinematicsTool name="ik">\n'
        "<model_file>rec/model.osim</model_file>\n<marker_file>rec/lift.trc</marker_file>\n"
        "<output_motion_file>out.mot</output_motion_file>\n</InverseKinematicsTool>\n</OpenSimDocument>\n")
    (folder / "persons.csv").write_text("name,study\nA,rec/study.toml\n")
    study = ["rec"]
    model, markers, emg, motion = "rec/model.osim", "rec/lift.trc", "rec/lift_emg.sto", "ik.mot"
    return [
        Case("check study", ["check", "rec/study.toml"], study),
        Case("run", ["run", "rec/study.toml", "--out", "out"], study),
        Case("settings", ["settings", "rec/study.toml"], study, ["rec/study.toml"]),
        Case("cohort", ["cohort", "persons.csv", "--out", "out"], [*study, "persons.csv"], ["persons.csv"]),
        Case("ik", ["ik", "--model", model, "--markers", markers, "--out", "out.mot"], [model, markers]),
        Case("id", ["id", "--model", model, "--motion", motion, "--lowpass", "6", "--out", "out.sto"], [model, motion]),
        Case("paths", ["paths", "--model", model, "--motion", motion, "--out", "out"], [model, motion]),
        Case("so", ["so", "--model", model, "--motion", motion, "--lowpass", "6", "--out", "out"], [model, motion]),
        Case("simulate", ["simulate", "--model", model, "--excite", "BIC=0.1@0.2+0.3", "--end", "0.3", "--out", "out"],
             [model]),
        Case("emg", ["emg", emg, "--out", "out.sto"], [emg]),
        Case("emg csv", ["emg", "emg.csv", "--out", "out.sto"], ["emg.csv"]),
        Case("twin", ["twin", "--protocol", "p.toml", "--out", "out"], ["p.toml"]),
        Case("run-tool", ["run-tool", "ik.xml"], ["ik.xml", model, markers]),
        Case("update-file", ["update-file", model, "out.osim"], [model]),
        Case("report", ["report", "res"], ["res", "rec"], ["res"]),
        Case("predict", ["predict", "res", "--trials", "lift", "--out", "out"], ["res", "rec"], ["res"]),
        Case("compare", ["compare", "res", "other", "--out", "out"], ["res", "other"], ["other"]),
        Case("group", ["report", "--group", "res", "other", "--out", "out"], ["res", "other"], ["other"]),
        *[Case(f"{command} {file}", [command, file, *more], [file])
          for file in ("rec/lift.trc", "lift.c3d", "ik.csv", emg, motion, "rec/model.osim", "activation.sto")
          for command, more in (("info", []), ("info", ["--json"]), ("check", []))],
        *[Case(f"convert {file}", ["convert", file, "out" + to], [file])
          for file, to in (("rec/lift.trc", ".c3d"), ("lift.c3d", ".trc"), ("ik.csv", ".sto"), (emg, ".csv"),
                           (motion, ".csv"))],
    ]


def shared_cases(folder):
    """Copies the small files of the shared recordings; returns the cases that read them."""
    cases = []
    if not DATA.is_dir():
        return cases
    kinds = (".trc", ".sto", ".mot", ".c3d", ".csv", ".anc", ".edf", ".txt", ".osim", ".xml")
    for file in sorted(DATA.rglob("*")):
        if file.suffix.lower() not in kinds or not file.is_file() or file.stat().st_size > LARGEST:
            continue
        place = Path("shared") / hashlib.sha1(str(file).encode()).hexdigest()[:10] / file.name
        (folder / place).parent.mkdir(parents=True)
        shutil.copyfile(file, folder / place)
        name, short = str(place), str(file.relative_to(DATA))
        cases.append(Case(f"info {short}", ["info", "--json", name], [name]))
        if file.suffix not in (".osim", ".xml"):
            cases.append(Case(f"convert {short}", ["convert", name, "out"], [name]))
            cases.append(Case(f"emg {short}", ["emg", name, "--unit", "mV", "--out", "out.sto"], [name]))
        elif file.suffix == ".osim":
            cases.append(Case(f"update-file {short}", ["update-file", name, "out.osim"], [name]))
    return cases


# The damages ----------------------------------------------------------------------------------------------------------

def flip_bits(data, chance):
    data = bytearray(data)
    for _ in range(chance.choice([1, 1, 1, 4, 40])):
        data[chance.randrange(len(data))] ^= 1 << chance.randrange(8)
    return bytes(data)


def cut_off(data, chance):
    return data[: chance.randrange(len(data))]


def take_out(data, chance):
    at = chance.randrange(len(data))
    return data[:at] + data[at + chance.choice([1, 2, 7, 100, 5000]):]


def put_in(data, chance):
    at = chance.randrange(len(data))
    piece = chance.choice([b"\0", b"\xff" * 9, b"NaN", b"1e999", b"-", b"\t\t", b"\n\n", b"<a>" * 300, b"[" * 300, b"'\"",
                           data[at: at + 64], data[:4096], b"9" * 400, b"\xef\xbb\xbf", "é漢".encode(), b"\x1b[31m"])
    return data[:at] + piece + data[at:]


def other_number(data, chance):
    found = list(re.finditer(rb"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?", data[:200_000]))
    if not found:
        return flip_bits(data, chance)
    m = chance.choice(found)
    number = chance.choice([b"0", b"-1", b"1e300", b"1e-300", b"nan", b"inf", b"4294967296", b"-2147483649", b"", b"abc",
                            b"0x10", b"1,5", b"1.5.2", m.group() + b"0000", b"-" + m.group()])
    return data[: m.start()] + number + data[m.end():]


def crlf(data, chance):
    return data.replace(b"\r\n", b"\n").replace(b"\n", b"\r\n")


def lines_of(data):
    return data.split(b"\n")


def row_place(lines, chance):
    first = next((i for i, line in enumerate(lines) if len(re.findall(rb"[-\d.]+(?:e[-+]?\d+)?", line)) > 3), 0)
    return chance.randrange(min(first + 5, len(lines) - 3), max(len(lines) - 2, min(first + 5, len(lines) - 3) + 1))


def swap_rows(data, chance):
    lines = lines_of(data)
    if len(lines) < 20:
        return None
    a, b = row_place(lines, chance), row_place(lines, chance)
    if a == b:
        return None
    lines[a], lines[b] = lines[b], lines[a]
    return b"\n".join(lines)


def ragged_row(data, chance):
    lines = lines_of(data)
    if len(lines) < 20:
        return None
    at = row_place(lines, chance)
    cells = re.split(rb"([\t,; ]+)", lines[at].strip())
    if len(cells) < 7:
        return None
    lines[at] = b"".join(cells[: -2 * chance.randrange(1, 3)])
    return b"\n".join(lines)


def shorter_binary(data, chance):
    return data[: len(data) * chance.randrange(30, 95) // 100]


ANY = [flip_bits, cut_off, take_out, put_in, other_number, crlf]
SEEN_IN = {".trc": [swap_rows, ragged_row], ".sto": [swap_rows, ragged_row], ".mot": [swap_rows, ragged_row],
           ".csv": [swap_rows, ragged_row], ".c3d": [shorter_binary], ".edf": [shorter_binary]}


# A run ----------------------------------------------------------------------------------------------------------------

def contents(folder, places):
    files = {}
    for place in places:
        top = folder / place
        for file in [top] if top.is_file() else sorted(top.rglob("*")):
            if file.is_file():
                files[str(file.relative_to(folder))] = hashlib.sha1(file.read_bytes()).hexdigest()
    return files


def numbers_of(folder, out):
    """Returns the numbers of the output files as one text; places, times of the day and hashes are left out."""
    parts = []
    for file in sorted(folder.glob("out*")):
        for each in [file] if file.is_file() else sorted(file.rglob("*")):
            if each.suffix in (".sto", ".mot", ".csv", ".trc") and each.name != "persons.csv":
                text = each.read_text(errors="replace")
                body = text.split("endheader", 1)[-1]
                parts.append(each.name + "\n" + body)
    return "\n".join(parts)


def messages(out, err):
    """Returns the kinds of lines that were printed: numbers and paths are one sign each."""
    return {re.sub(r"\d+(?:\.\d+)?", "#", line).strip() for line in (out + "\n" + err).split("\n")} - {""}


def attempt(program, seeds, case, seed, keep):
    """Runs one damaged case; returns (damage, faults)."""
    chance = random.Random(seed)
    folder = Path(tempfile.mkdtemp(prefix="campaign."))
    try:
        for place in case.inputs:
            (folder / place).parent.mkdir(parents=True, exist_ok=True)
            copy = shutil.copytree if (seeds / place).is_dir() else shutil.copyfile
            copy(seeds / place, folder / place)
        (folder / "stranger.txt").write_text("not of this program")
        if seed is None:
            code, out, err = run(program, case.arguments, folder)
            case.good = (code, numbers_of(folder, out), messages(out, err))
            return "none", []
        files = [f for place in case.damaged for f in
                 ([folder / place] if (folder / place).is_file() else sorted((folder / place).rglob("*")))
                 if f.is_file() and f.stat().st_size > 0]
        victim = chance.choice(files)
        data = victim.read_bytes()
        seen = SEEN_IN.get(victim.suffix.lower(), [])
        damage = chance.choice(ANY + seen * 3)
        changed = damage(data, chance)
        if changed is None or changed == data:
            damage, changed = flip_bits, flip_bits(data, chance)
        victim.write_bytes(changed)
        before = contents(folder, [*case.inputs, "stranger.txt"])
        code, out, err = run(program, case.arguments, folder)
        after = contents(folder, [*case.inputs, "stranger.txt"])
        faults = []
        if code is None:
            faults.append("hang")
        elif code == 99 or "runtime error:" in err or "Sanitizer" in err:
            faults.append("sanitizer: " + next((x for x in err.split("\n") if "error" in x.lower()), "")[:200])
        elif code < 0 or code == 1 or code > 5:
            faults.append(f"crash: exit {code}: {err[-300:]}")
        elif code != 0 and not (err.strip() or out.strip()):
            faults.append("silence")
        # `report` writes its page into the result folder that it is given.
        own = case.name == "report"
        lost = [name for name, hash_ in before.items()
                if after.get(name) != hash_ and not (own and name.startswith("res/"))]
        if lost:
            faults.append(f"lost: {lost[:3]}")
        if code == 0 and damage in seen and case.good and case.good[0] == 0:
            if numbers_of(folder, out) != case.good[1] and not messages(out, err) - case.good[2]:
                faults.append("changed")
        where = f"{case.name}: {damage.__name__} of {victim.relative_to(folder)} (seed {seed})"
        if faults and keep:
            shutil.copytree(folder, Path(keep) / str(seed), dirs_exist_ok=True)
        return where, faults
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--seconds", type=float, default=180)
    parser.add_argument("--runs", type=int, default=10**9)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", default="", help="a part of the name of the cases to run")
    parser.add_argument("--keep", help="folder for the inputs of runs that failed")
    options = parser.parse_args()
    program = str(Path(options.program).resolve())
    seeds = Path(tempfile.mkdtemp(prefix="campaign.seeds."))
    try:
        cases = virtual_person(program, seeds)
        shutil.copytree(seeds / "res", seeds / "other")
        cases = [c for c in cases + shared_cases(seeds) if options.only in c.name]
        end = time.monotonic() + options.seconds
        workers = os.cpu_count() or 1
        counts, failures = {}, []
        with concurrent.futures.ThreadPoolExecutor(workers) as pool:
            # The virtual person's cases take half of the runs, whatever the number of shared files.
            own = [c for c in cases if not any(i.startswith("shared/") for i in c.inputs)]
            others = [c for c in cases if c not in own] or own
            own = own or others
            chance = random.Random(options.seed)

            def work(seed):
                if time.monotonic() > end:
                    return None
                case = chance_of[seed]
                if case.good is None and case.damaged:
                    attempt(program, seeds, case, None, None)
                return case, *attempt(program, seeds, case, seed, options.keep)

            chance_of, at, base = {}, 0, options.seed * 10**7
            while time.monotonic() < end and at < options.runs:
                batch = range(base + at, base + min(at + 50 * workers, options.runs))
                for seed in batch:
                    chance_of[seed] = chance.choice(own if chance.random() < 0.5 else others)
                for done in pool.map(work, batch):
                    if done is None:
                        continue
                    case, where, faults = done
                    counts[case.arguments[0]] = counts.get(case.arguments[0], 0) + 1
                    for fault in faults:
                        failures.append(f"{fault} | {where}")
                        print(failures[-1], flush=True)
                at += len(batch)
        print(", ".join(f"{name} {n}" for name, n in sorted(counts.items())))
        kinds = {}
        for failure in failures:
            kinds[re.split(r"[: |]", failure)[0]] = kinds.get(re.split(r"[: |]", failure)[0], 0) + 1
        print(f"{sum(counts.values())} runs of {len(counts)} commands, {len(failures)} faults {kinds or ''}")
        return 1 if failures else 0
    finally:
        shutil.rmtree(seeds, ignore_errors=True)


if __name__ == "__main__":
    sys.exit(main())

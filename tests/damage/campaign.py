#!/usr/bin/env python3
"""A campaign of mutations over all commands: campaign.py PROGRAM [--seconds S] [--runs N] [--seed K] [--keep DIR]

Good inputs are a small virtual person, the results of every command on that person, and the small files of the shared
recordings (MYOID_DATA, or ../shared/data) where they are there. Each run copies the inputs of one command into a folder
of its own, damages one of them, runs the program, and asks:

  crash      does the program end by a signal or with another exit code than 0, 3, 4 or 5?
  sanitizer  does a sanitizer speak? (build the program with the preset asan)
  hang       does the program need more than 120 seconds of processor time?
  silence    does the program refuse and not say why?
  lost       is an input, or a stranger's file beside or among the output, gone or changed?
  changed    exit code 0, other numbers, and no message that the undamaged input does not give too? Asked of damages
             that every reader can see: rows out of order, lost or ragged, files shorter than their headers say;
             numbers that no body has, of commands that compute; results that are not those on the list of their folder.

Ends with 1 if any answer is yes, and prints the damage and the command of each. A run depends on its number alone:
`--seed K` begins with K * 10000000, `--replay NUMBER` repeats one (with the same --only and --expensive). Commands that
take long come less often: they have the share `--expensive` of the time.
"""

import argparse
import concurrent.futures
import hashlib
import itertools
import os
import random
import re
import shutil
import sys
import tempfile
import time
from pathlib import Path

import campaign_cases
from campaign_damages import damaged
from program import Program

PICTURES = (".svg", ".html", ".bib", ".txt")  # of the results; commands that read results take no numbers from them
TEMPORARY = os.environ.get("TMPDIR") or ("/dev/shm" if os.access("/dev/shm", os.W_OK) else None)


def contents(folder):
    return {str(file.relative_to(folder)): hashlib.sha1(file.read_bytes()).hexdigest()
            for file in sorted(folder.rglob("*")) if file.is_file() and not file.is_symlink()}


def numbers_of(folder, case, out):
    """Returns the numbers of the output as one text; places, times of the day and hashes are left out."""
    parts = [re.sub(r"[0-9a-f]{32,}", "", out)] if "--json" in case.arguments else []
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


def lay_out(seeds, case, folder):
    for place in case.inputs:
        (folder / place).parent.mkdir(parents=True, exist_ok=True)
        copy = shutil.copytree if (seeds / place).is_dir() else shutil.copyfile
        copy(seeds / place, folder / place)
    (folder / "stranger.txt").write_text("not of this program")


def good_run(program, seeds, case):
    """Runs the undamaged case once; returns exit code, numbers and messages."""
    if case.good is None:
        with tempfile.TemporaryDirectory(prefix="campaign.", dir=TEMPORARY) as name:
            lay_out(seeds, case, Path(name))
            code, out, err = program(case.arguments, name)
            case.good = (code, numbers_of(Path(name), case, out), messages(out, err))
    return case.good


def lost(case, victim, before, after):
    """Returns the files that are gone or changed and should not be."""
    own = set()
    if case.renews:
        # The command may replace and remove its own unchanged results; what somebody changed stays, in kept-N at last.
        own = {name for name in before if name.startswith(case.renews + "/") and not name.endswith("stranger.txt")}
        hidden = any(part.startswith(".") for part in victim.split("/"))
        if not hidden and victim in own and before[victim] not in after.values():
            return [victim]
    return [name for name, hash_ in before.items() if name not in own and after.get(name) != hash_]


def faults_of(code, out, err):
    if code is None:
        return ["hang"]
    if code == 99 or "runtime error:" in err or "Sanitizer" in err:
        return ["sanitizer: " + next((x for x in err.split("\n") if "error" in x.lower()), "")[:200]]
    if code not in (0, 3, 4, 5):
        return [f"crash: exit {code}: {err[-300:]}"]
    if code != 0 and not (err.strip() or (code == 4 and out.strip()) or "error" in out):
        return ["silence"]
    return []


def attempt(program, seeds, case, number, timeout, keep):
    """Runs one damaged case; returns (damage, exit code, faults)."""
    chance = random.Random(number)
    folder = Path(tempfile.mkdtemp(prefix="campaign.", dir=TEMPORARY))
    try:
        lay_out(seeds, case, folder)
        arguments = list(case.arguments)
        if case.renews:
            (folder / case.renews / "stranger.txt").write_text("not of this program")
        elif arguments[-1] == "out" and chance.random() < 0.3:
            (folder / "out").mkdir()
            (folder / "out/stranger.txt").write_text("not of this program")
            arguments += ["--overwrite"]
        files = [f for place in case.damaged for f in
                 ([folder / place] if (folder / place).is_file() else sorted((folder / place).rglob("*")))
                 if f.is_file() and f.stat().st_size > 0 and f.name != "stranger.txt"]
        if case.sealed and chance.random() < 0.5:
            files = [folder / place for place in case.sealed]
        endings = sorted({f.suffix for f in files})
        ending = chance.choices(endings, [1 if e in PICTURES else 6 for e in endings])[0]
        victim = chance.choice([f for f in files if f.suffix == ending])
        damage, seen, changed = damaged(victim.read_bytes(), victim.suffix, arguments[0], chance)
        victim.write_bytes(changed)
        place = str(victim.relative_to(folder))
        before = contents(folder)
        code, out, err = program(arguments, folder, timeout)
        faults = faults_of(code, out, err)
        gone = lost(case, place, before, contents(folder))
        if gone:
            faults.append(f"lost: {gone[:3]}")
        if code == 0 and (seen or place in case.sealed):
            good = good_run(program, seeds, case)
            if good[0] == 0 and numbers_of(folder, case, out) != good[1] and not messages(out, err) - good[2]:
                faults.append("changed")
        if faults and keep:
            kept = Path(keep) / str(number)
            shutil.copytree(folder, kept, dirs_exist_ok=True, symlinks=True)
            (kept / "campaign.txt").write_text(f"{faults}\n{damage} of {place}\nmyoid {' '.join(arguments)}\n{code}\n"
                                               f"--- out\n{out}\n--- err\n{err}\n")
        return f"{case.name}: {damage} of {place} (run {number})", code, faults
    finally:
        shutil.rmtree(folder, ignore_errors=True)


class Tally:
    """Counts runs, seconds, exit codes and faults by group of cases."""

    def __init__(self, verbose):
        self.verbose = verbose
        self.groups, self.failures, self.runs = {}, [], 0
        self.begin = self.said = time.monotonic()

    def add(self, case, where, code, faults, seconds):
        if self.verbose:
            print(f"{code} {seconds:.2f} s {where}")
        entry = self.groups.setdefault(campaign_cases.group_of(case), {"runs": 0, "s": 0.0, "faults": 0, "codes": {}})
        entry["runs"] += 1
        entry["s"] += seconds
        entry["codes"][code] = entry["codes"].get(code, 0) + 1
        entry["faults"] += len(faults)
        self.runs += 1
        for fault in faults:
            self.failures.append(f"{fault} | {where}")
            print(self.failures[-1], flush=True)
        if time.monotonic() > self.said + 60:
            self.said = time.monotonic()
            print(f"{self.said - self.begin:.0f} s: {self.runs} runs, {len(self.failures)} faults", flush=True)

    def summary(self):
        print(f"{'group':<20} {'runs':>6} {'s/run':>7} {'s':>7} {'faults':>6}  exit codes")
        for name, e in sorted(self.groups.items()):
            codes = ", ".join(f"{code}: {n}" for code, n in sorted(e["codes"].items(), key=str))
            print(f"{name:<20} {e['runs']:>6} {e['s'] / e['runs']:>7.2f} {e['s']:>7.0f} {e['faults']:>6}  {codes}")
        kinds = {}
        for failure in self.failures:
            kind = re.split(r"[: |]", failure)[0]
            kinds[kind] = kinds.get(kind, 0) + 1
        print(f"{self.runs} runs of {len(self.groups)} groups in {time.monotonic() - self.begin:.0f} s, "
              f"{len(self.failures)} faults {kinds or ''}", flush=True)


def campaign(program, seeds, cases, options):
    """Runs the damaged cases; returns the tally."""
    tally, end = Tally(options.verbose), time.monotonic() + options.seconds
    shares = campaign_cases.weights(cases, options.expensive)

    def work(number):
        if time.monotonic() > end:
            return None
        case = random.Random(f"case {number}").choices(cases, shares)[0]
        begin = time.monotonic()
        return case, *attempt(program, seeds, case, number, options.timeout, options.keep), time.monotonic() - begin

    base = options.seed * 10**7
    numbers = iter([options.replay] if options.replay is not None else range(base, base + options.runs))
    with concurrent.futures.ThreadPoolExecutor(options.workers) as pool:
        waiting = {pool.submit(work, number) for number in itertools.islice(numbers, 2 * options.workers)}
        while waiting:
            done, waiting = concurrent.futures.wait(waiting, return_when=concurrent.futures.FIRST_COMPLETED)
            for each in done:
                if each.result() is not None:
                    tally.add(*each.result())
                    waiting |= {pool.submit(work, number) for number in itertools.islice(numbers, 1)}
    return tally


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--seconds", type=float, default=180, help="also the time of the good inputs (180)")
    parser.add_argument("--runs", type=int, default=10**6)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--workers", type=int, default=os.cpu_count() or 1, help="programs at a time (one a core)")
    parser.add_argument("--timeout", type=int, default=120, help="seconds of processor time of a run (120)")
    parser.add_argument("--only", default="", help="a part of the name of the cases to run")
    parser.add_argument("--expensive", type=float, default=0.5, help="share of the time of long commands (0.5)")
    parser.add_argument("--replay", type=int, metavar="NUMBER", help="this run alone; --only as it was")
    parser.add_argument("--undamaged", action="store_true", help="every case once without damage, with its time")
    parser.add_argument("--verbose", action="store_true", help="a line for each run")
    parser.add_argument("--keep", help="folder for the inputs and outputs of runs with a fault")
    options = parser.parse_args()
    begin = time.monotonic()
    seeds = Path(tempfile.mkdtemp(prefix="campaign.seeds.", dir=TEMPORARY))
    program = Program(options.program, options.workers, seeds)
    try:
        campaign_cases.virtual_person(program, seeds)
        cases = campaign_cases.own_cases() + campaign_cases.shared_cases(seeds)
        cases = [c for c in cases if options.only in c.name]
        for case in cases:
            case.size = sum(f.stat().st_size for place in case.inputs
                            for f in [seeds / place, *(seeds / place).rglob("*")] if f.is_file())
        print(f"{len(cases)} cases, made in {time.monotonic() - begin:.0f} s", flush=True)
        options.seconds -= time.monotonic() - begin
        if options.undamaged:
            for case in cases:
                begin = time.monotonic()
                code, _, said = good_run(program, seeds, case)
                print(f"{time.monotonic() - begin:7.2f} s  exit {code}  {case.name}"
                      + (f"  {sorted(said)[:6]}" if code not in (0, 4) else ""), flush=True)
            return 0
        tally = campaign(program, seeds, cases, options)
        tally.summary()
        return 1 if tally.failures else 0
    finally:
        program.close()
        shutil.rmtree(seeds, ignore_errors=True)


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
"""The table of README.md with the demo's largest errors, by the demo.

usage: errors_of_demo.py MYOID README.md [--write]

Runs the demo, takes per number the largest error of the muscles over the truth of the recording, by both readings, and
fails where the table has other numbers; --write puts them in.
"""
import csv
import pathlib
import subprocess
import sys
import tempfile

NUMBERS = {"greatest voluntary torque": "voluntary_torque", "F_max": "max_isometric_force", "l⁰": "optimal_fiber_length"}


def main():
    program, page = sys.argv[1], pathlib.Path(sys.argv[2])
    with tempfile.TemporaryDirectory() as folder:
        demo = pathlib.Path(folder) / "demo"
        subprocess.run([program, "demo", "--no-open", "--out", demo], check=True, capture_output=True)
        truth = {(row["muscle"], row["parameter"]): float(row["value"])
                 for row in csv.DictReader((demo / "recording/truth.csv").open())} 
        rows = [row for row in csv.DictReader((demo / "result/parameters.csv").open()) if row["method"] == "torque"]
    text = page.read_text(encoding="utf-8")
    found = text
    for name, parameter in NUMBERS.items():
        of = [(row, truth[row["muscle"], parameter]) for row in rows
              if row["parameter"] == parameter and (row["muscle"], parameter) in truth] 
        if len(of) != 4:
            sys.exit(f"{len(of)} muscles have a true {parameter}, expected 4")
        person, given = (max(abs(float(row[key]) / true - 1) for row, true in of) for key in ("estimate", "given_estimate"))
        old = next(line for line in text.splitlines() if line.startswith(f"| {name} |"))
        found = found.replace(old, f"| {name} | {100 * person:.0f} % | {100 * given:.0f} % |")
    if "--write" in sys.argv:
        page.write_text(found, encoding="utf-8")
    elif found != text:
        sys.exit(f"{page} has other errors than the demo; docs/renew.sh writes them")


if __name__ == "__main__":
    main()

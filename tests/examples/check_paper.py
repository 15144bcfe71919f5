"""usage: check_paper.py PROGRAM SCRIPT

Runs the source paper's experiment on one virtual person. Where its assumptions hold, the minima are the truth that the
person was made with, after few steps; a force that nobody measured gives no interval and no more than the prior's word.
"""

import csv
import json
import subprocess
import sys
import tempfile
from pathlib import Path


def check(condition, about):
    if not condition:
        sys.exit(about)


def main():
    program, script = sys.argv[1:]
    with tempfile.TemporaryDirectory() as parent:
        out = Path(parent) / "out"
        done = subprocess.run([sys.executable, script, program, str(out), "--persons", "1"], capture_output=True,
                              text=True, check=False, env={"PATH": "/usr/bin:/bin"})
        check(done.returncode == 0, done.stdout + done.stderr)
        check("Table I:" in done.stdout and "Table II:" in done.stdout, done.stdout)
        rows = list(csv.reader((out / "assumptions.csv").open()))
        whole = dict(zip(rows[0], rows[1]))
        check(whole["minima"] == whole["searches"] == whole["plain"] == "8", f"not all minima are found: {whole}")
        check(int(whole["steps"]) <= 12, f"{whole['steps']} steps")
        for name in rows[0][1:8]:
            check(float(whole[name]) < 1e-4, f"{name} is {float(whole[name]):.1e} off the truth")
        for row in rows[2:]:
            check(any(cell and float(cell) > 1e-3 for cell in row[1:8]) or row[8] != "8", f"nothing fails with {row[0]}")
        for number in (8, 9, 10):
            check("<polyline" in (out / f"figure{number}.svg").read_text(), f"figure {number} has no curve")
        shared = json.loads((out / "person1/run/parameters.json").read_text())["methods"]
        check([m["method"] for m in shared] == ["paper"], "run --method paper runs another method, too")
        for e in shared[0]["estimates"]:
            check(e["ci_low"] is None and e["ci_high"] is None and e["std_error"] is None, f"an interval: {e}")
            check(e["verdict"] in ("prior_dominated", "not_identifiable", "non_physical"), f"a verdict: {e}")
        page = (out / "person1/run/report.html").read_text()
        check('<details class="part"><summary><h2 id="paper">' in page, "the section is not folded")


if __name__ == "__main__":
    main()

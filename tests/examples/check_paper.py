"""usage: check_paper.py PROGRAM SOURCE

Runs the source paper's experiment. Where its assumptions hold, the minima are the truth that the persons were made
with, after few steps; where one fails, a number errs; a force that nobody measured gives no interval and no verdict
above the prior's. The tables of docs/theory/paper-method.md are those that the script prints, and the page states no
other number.
"""

import csv
import json
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

# Numbers of the page's prose that are no results.
GIVEN = [r"Figures? \d+( to \d+)?", r"Activation 1\b", r"\(0: below 0\.001 %\)", r"`[^`]*`", r"\$[^$]*\$", r"\]\([^)]*\)"]
PRINTED = re.compile(r"<!-- printed: (.+) -->\n(.*?)<!-- end of \1 -->", re.DOTALL)


def check(condition, about):
    if not condition:
        sys.exit(about)


def close(old, new):
    """Whether two words of a table agree: the same text, or numbers that differ by no more than rounding may make."""
    try:
        a, b = float(old), float(new)
    except ValueError:
        return old == new
    return abs(a - b) <= max(0.1 * abs(a), 2.0 if old.isdigit() and new.isdigit() else 1e-4)


def check_page(page, now):
    old, new = dict(PRINTED.findall(page)), dict(PRINTED.findall(now))
    check(len(old) >= 5, f"the page has only {len(old)} tables of the script")
    for name, table in old.items():
        words, others = table.split(), new[name].split()
        check(len(words) == len(others) and all(map(close, words, others)),
              f"{name} of the page is\n{table}\nthe script prints\n{new[name]}\n--page writes it")
    prose = PRINTED.sub("", page)
    for pattern in GIVEN:
        prose = re.sub(pattern, "", prose)
    for line in prose.splitlines():
        check(not re.search(r"\d", line) or line.startswith("    "), f"a number that no script prints: {line}")


def check_assumptions(path):
    """The row without a failure is exact, each other row is not."""
    heads, exact, *failed = csv.reader(path.open())
    number = heads.index("minima")
    for name, error in list(zip(heads, exact))[1:number]:
        check(float(error) < 1e-5, f"{name} is {float(error):.1e} off the truth")
    check(exact[number] == "24 of 24", f"minima: {exact[number]}")
    check(int(exact[number + 1]) <= 12, f"{exact[number + 1]} steps")
    for row in failed:
        check(any(cell and float(cell) > 1e-3 for cell in row[1:number]), f"nothing errs by {row[0]}")


def main():
    program, source = sys.argv[1], Path(sys.argv[2])
    page = source / "docs/theory/paper-method.md"
    with tempfile.TemporaryDirectory(prefix="myoid.") as parent:
        out, copy = Path(parent) / "out", Path(parent) / page.name
        shutil.copy(page, copy)
        done = subprocess.run([sys.executable, source / "examples/paper/paper.py", program, out, "--page", copy],
                              capture_output=True, text=True, check=False)  # fmt: skip
        check(done.returncode == 0, done.stdout + done.stderr)
        check_assumptions(out / "assumptions.csv")
        check_page(page.read_text(encoding="utf-8"), copy.read_text(encoding="utf-8"))
        for number in (8, 9, 10):
            drawn = (copy.parent / f"published_figure{number}.svg").read_text()
            check(drawn.count("<polyline") == 4, f"figure {number} has not its four curves")
        run = out / "world1_person1/run"
        methods = json.loads((run / "parameters.json").read_text())["methods"]
        check([m["method"] for m in methods] == ["paper"], "run --method paper runs another method, too")
        for e in methods[0]["estimates"]:
            check(e["ci_low"] is None and e["ci_high"] is None and e["std_error"] is None, f"an interval: {e}")
            check(e["verdict"] in ("prior_dominated", "not_identifiable", "non_physical"), f"a verdict: {e}")
        check('<details class="part"><summary><h2 id="paper">' in (run / "report.html").read_text(),
              "the section is not folded")


if __name__ == "__main__":
    main()

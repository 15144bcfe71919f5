#!/usr/bin/env python3
"""Public recordings of real muscles with an independent truth: this program, other tools and baselines in one table.

MYOID: the program. DATA: the folder of the recordings (examples/get_data); by default MYOID_DATA, or shared/data beside
the checkout. A set whose recordings are absent is named and left out. --set: only these, of sets/. --out: a folder for
scoreboard.md, data/scoreboard.csv and figures/scoreboard.svg; without it the table is printed. --keep: a folder for the
files of each set and commands.sh, the commands of the program that read them. README.md says how to add a set or a
tool.
"""
import argparse
import contextlib
import csv
import importlib
import io
import os
import pathlib
import shutil
import sys
import tempfile
import textwrap

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
from board import LITERATURE, MEAN, REGRESSION, Bench, Clock  # noqa: E402

BETTER_IF_GREATER = ("R2",)


def data_folder(arguments):
    beside = HERE.parents[2] / "shared/data"
    return pathlib.Path(arguments[0] if arguments else os.environ.get("MYOID_DATA", beside))


def sets():
    return sorted(path.stem for path in (HERE / "sets").glob("*.py") if path.stem != "__init__")


def judge(name, program, data, keep):
    """The rows of a set, the seconds that it took, and the folders of recordings that it lacks."""
    module = importlib.import_module(f"sets.{name}")
    missing = [part for part in module.NEEDS if not (data / part).is_dir()]
    if missing:
        return [], 0.0, missing
    clock = Clock()
    with contextlib.ExitStack() as stack:
        if keep is None:
            folder = pathlib.Path(stack.enter_context(tempfile.TemporaryDirectory()))
        else:
            folder = keep / name
            folder.mkdir(parents=True)
        return list(module.rows(Bench(program, data, folder))), clock.seconds(), []


def number(row, value):
    return f"{value:.0f}" if row.measure == "count" else f"{value:.3f}" if row.measure == "R2" else f"{value:.1f}"


def leads(row):
    """Whether there are other ways, and none predicts better. A reference of the same quantity does not compete."""
    rivals = row.others.values() if row.measure in ("R2", "N m", "N", "%") else ()
    sign = 1.0 if row.measure in BETTER_IF_GREATER else -1.0
    return bool(rivals) and not any(sign * other > sign * row.ours for other in rivals)


HEAD = """# Scoreboard

Public recordings of real muscles (`examples/get_data`): torque that took no part in a fit, as R² unless the row has a
unit. Bold: no other way in the row is better.

    benchmarks/real/scoreboard.py build/release/bin/myoid --out docs

Regression: least squares on each channel's EMG, 50 ms late, times 1, q and q², and on 1, q, q² and dq/dt of the
joint. One gain: the literature's muscles. All numbers: `docs/data/scoreboard.csv`; `benchmarks/real/README.md` says
how to add a set or a tool.

![R² of torque that took no part in a fit](figures/scoreboard.svg)
"""


def markdown(found):
    """One table; a baseline has a column of its own, every other way stands in the last one."""
    columns = {MEAN: "mean", REGRESSION: "regression", LITERATURE: "one gain"}
    lines = ["", f"| task | asked | ours | {' | '.join(columns.values())} | other |",
             "| --- " * (len(columns) + 4) + "|"]
    seconds, left_out = {}, []
    for name, (rows, took, missing) in found.items():
        if missing:
            left_out.append(f"{name} (no {', '.join(missing)})")
        seconds[name] = took
        for row in rows:
            ours = f"**{number(row, row.ours)}**" if leads(row) else number(row, row.ours)
            asked = row.asked.replace(">=", "≥").replace("<=", "≤")
            others = {who: number(row, value) for who, value in row.others.items()}
            cells = [f"{row.task}{'' if row.measure == 'R2' else f' [{row.measure}]'}", asked,
                     f"{ours}; {row.note}" if row.note else ours, *(others.pop(key, "") for key in columns),
                     "; ".join(f"{who} {value}" for who, value in others.items())]
            lines.append(f"| {' | '.join(cells)} |")
    clock = "Seconds by the clock: " + ", ".join(f"{n} {t:.0f}" for n, t in seconds.items()) + "."
    lines += ["", textwrap.fill(clock, 120)]
    if left_out:
        lines.append("Not run: " + ", ".join(left_out) + ".")
    return "\n".join(lines) + "\n"


def table(found):
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(["set", "task", "measure", "asked", "who", "value", "note"])
    for name, (rows, _, _) in found.items():
        for row in rows:
            writer.writerow([name, row.task, row.measure, row.asked, "myoid", number(row, row.ours), row.note])
            for who, value in row.others.items():
                writer.writerow([name, row.task, row.measure, row.asked, who, number(row, value), ""])
    return out.getvalue()


def figure(found, path):
    """A line for each row with R2: this program, and the others."""
    try:
        import matplotlib
    except ImportError:
        print("no figure: matplotlib is not installed (Debian: python3-matplotlib)", file=sys.stderr)
        return
    matplotlib.use("svg")
    matplotlib.rcParams.update({"svg.hashsalt": "scoreboard", "font.size": 8})
    import matplotlib.pyplot as plt
    rows = [row for of_set, _, _ in found.values() for row in of_set if row.measure == "R2"][::-1]
    axes = plt.figure(figsize=(7.5, 0.22 * len(rows) + 0.8)).add_subplot()
    kinds = {"ours": ("o", "#1f4e9c"), "another tool": ("s", "#b5482a"), "a baseline": ("|", "#777777")}
    kind_of = {"ours": "ours", **dict.fromkeys((MEAN, REGRESSION, LITERATURE), "a baseline")}
    for name, (mark, color) in kinds.items():
        points = [(max(value, -1.0), i) for i, row in enumerate(rows)
                  for who, value in [("ours", row.ours), *row.others.items()]
                  if name == kind_of.get(who, "another tool")]
        if points:
            axes.scatter(*zip(*points), marker=mark, color=color, label=name, s=28, zorder=3)
    axes.set_yticks(range(len(rows)), [row.task for row in rows])
    axes.set_xlabel("R² of torque that took no part in the fit (-1: -1 or less)")
    axes.grid(axis="x", color="#dddddd")
    axes.set_xlim(-1.05, 1.02)
    axes.legend(loc="lower left")
    path.parent.mkdir(parents=True, exist_ok=True)
    plt.savefig(path, bbox_inches="tight", metadata={"Date": None})


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", metavar="MYOID")
    parser.add_argument("data", metavar="DATA", nargs="?")
    parser.add_argument("--set", nargs="+", choices=sets(), default=sets())
    parser.add_argument("--out", metavar="FOLDER", type=pathlib.Path)
    parser.add_argument("--keep", metavar="FOLDER", type=pathlib.Path)
    options = parser.parse_args()
    for name in options.set:
        if options.keep is not None and (options.keep / name).exists():
            parser.error(f"{options.keep / name} is there already; name a new folder for --keep")
    if shutil.which(options.program) is None:
        parser.error(f"{options.program}: no program of this name can be started")
    data = data_folder([options.data] if options.data else [])
    found = {}
    for name in options.set:
        print(f"{name} ...", file=sys.stderr, flush=True)
        found[name] = judge(name, options.program, data, options.keep)
    lacking = sorted({part for _, _, missing in found.values() for part in missing})
    if lacking:
        print(f"not in {data}: {', '.join(lacking)}; examples/get_data brings what it can fetch", file=sys.stderr)
    if not any(rows for rows, _, _ in found.values()):
        sys.exit(77)
    if options.out is None:
        print(markdown(found))
        return
    (options.out / "data").mkdir(parents=True, exist_ok=True)
    (options.out / "scoreboard.md").write_text(HEAD + markdown(found))
    (options.out / "data/scoreboard.csv").write_text(table(found))
    figure(found, options.out / "figures/scoreboard.svg")


if __name__ == "__main__":
    main()

"""usage: commands_of_page.py PROGRAM PAGE SOURCE [--write]

Runs the commands of a page (indented lines that begin with `myoid`) in order, in a folder where the examples and the
recordings lie as the page expects them. Every line of a ```text block must be among the lines that the command before it
printed; white space counts once. Every number in the page's prose must be the one of the results (numbers_of_page.py).
--write puts the results' numbers and lines into the page. The recordings are those of $MYOID_DATA, else of
../shared/data beside SOURCE; exit code 77 where there are none.
"""

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import numbers_of_page


def steps(page):
    """The commands with the lines that they must print."""
    found, shown = [], None
    for line in page.read_text(encoding="utf-8").splitlines():
        if shown is not None and line == "```":
            shown = None
        elif shown is not None:
            shown.append(" ".join(line.split()))
        elif line == "```text":
            shown = found[-1][1]
        elif line.startswith("    myoid "):
            found.append((line.split(), []))
    return found


def name_of(command):
    """The folder that a command writes, or its study."""
    return command[command.index("--out") + 1] if "--out" in command else command[-1]


def run_all(program, checkout, commands):
    """Runs the commands; returns what each printed. A run prints its answer and all numbers and gates."""
    printed = {}
    for command, _ in commands:
        print("$", *command, flush=True)
        everything = ["--verbose"] if command[1] == "run" else []
        done = subprocess.run([program, *command[1:], *everything], cwd=checkout, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, check=False)  # fmt: skip
        if done.returncode not in (0, 4):
            sys.exit(f"exit code {done.returncode}\n{done.stdout}")
        printed[name_of(command)] = done.stdout
    return printed


def words(line):
    """The words of a line of output that are no numbers."""
    return [word for word in line.split() if not any(character.isdigit() for character in word)]


def now_printed(line, lines):
    """The line of `lines` that stands where `line` stood: with the same words, else with the most of its first words (two
    or more); none where there is no such line."""
    same = [other for other in lines if words(other) and words(other) == words(line)]
    if same:
        return same[0]
    alike = {other: len(os.path.commonprefix([other.split(), line.split()])) for other in lines}
    likest = max(alike, key=alike.get, default=None)
    return likest if likest and alike[likest] >= 2 else None


def with_lines(text, commands, printed):
    """The page with the lines that the commands print now, each in the place of its old one."""
    for command, shown in commands:
        lines = {" ".join(line.split()): line for line in printed[name_of(command)].splitlines()}
        for line in shown:
            now = now_printed(line, lines)
            if line not in lines and now:
                old = next(full for full in text.splitlines() if " ".join(full.split()) == line)
                text = text.replace(old, lines[now])
    return text


def main(program, page, source, write=""):
    program = Path(program).resolve()
    data = Path(os.environ.get("MYOID_DATA", Path(source) / ".." / "shared" / "data"))
    if not (data / "elbow-emg").is_dir():
        print(f"skipped: there is no {data}/elbow-emg")
        sys.exit(77)
    page = Path(page)
    with tempfile.TemporaryDirectory(prefix="myoid.") as folder:
        checkout = Path(folder) / "checkout"
        shutil.copytree(Path(source) / "examples", checkout / "examples")
        (Path(folder) / "shared").mkdir()
        (Path(folder) / "shared" / "data").symlink_to(data.resolve())
        commands = steps(page)
        if len(commands) < 6 or sum(len(shown) for _, shown in commands) < 10:
            sys.exit(f"{page} has {len(commands)} commands: is this the page?")
        printed = run_all(program, checkout, commands)
        results = numbers_of_page.Results(checkout, printed)
        text = page.read_text(encoding="utf-8")
        if write == "--write":
            text = with_lines(numbers_of_page.rewritten(text, results), commands, printed)
            page.write_text(text, encoding="utf-8")
        wrong = numbers_of_page.faults(text, results)
        for command, shown in steps(page):
            lines = {" ".join(line.split()) for line in printed[name_of(command)].splitlines()}
            wrong += [f"the page shows {line!r}, the program printed\n{printed[name_of(command)]}"
                      for line in shown if line not in lines]  # fmt: skip
        if wrong:
            sys.exit("\n".join(wrong))


if __name__ == "__main__":
    main(*sys.argv[1:])

"""usage: commands_of_page.py PROGRAM PAGE SOURCE

Runs the commands of a page (indented lines that begin with `myoid`) in order, in a folder where the examples and the
recordings lie as the page expects them. Every line of a ```text block must be among the lines that the command before it
printed; white space counts once. The recordings are those of $MYOID_DATA, else of ../shared/data beside SOURCE; exit code
77 where there are none.
"""

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path


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


def main(program, page, source):
    program = Path(program).resolve()
    data = Path(os.environ.get("MYOID_DATA", Path(source) / ".." / "shared" / "data"))
    if not (data / "elbow-emg").is_dir():
        print(f"skipped: there is no {data}/elbow-emg")
        sys.exit(77)
    with tempfile.TemporaryDirectory(prefix="myoid.") as folder:
        checkout = Path(folder) / "checkout"
        shutil.copytree(Path(source) / "examples", checkout / "examples")
        (Path(folder) / "shared").mkdir()
        (Path(folder) / "shared" / "data").symlink_to(data.resolve())
        commands = steps(Path(page))
        if len(commands) < 6 or sum(len(shown) for _, shown in commands) < 10:
            sys.exit(f"{page} has {len(commands)} commands: is this the page?")
        for command, shown in commands:
            print("$", *command, flush=True)
            done = subprocess.run([program, *command[1:]], cwd=checkout, stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT, text=True, check=False)  # fmt: skip
            if done.returncode not in (0, 4):
                sys.exit(f"exit code {done.returncode}\n{done.stdout}")
            printed = {" ".join(line.split()) for line in done.stdout.splitlines()}
            missing = [line for line in shown if line not in printed]
            if missing:
                sys.exit(f"the page shows {missing[0]!r}, the program printed\n{done.stdout}")


if __name__ == "__main__":
    main(*sys.argv[1:])

"""usage: remarks_of_recordings.py PROGRAM SOURCE

Runs `myoid check` on every public recording and on the studies of the examples, counts the remarks by their code, and
compares the table with docs/data/remarks.txt; MYOID_PRINT_PAGES=1 writes it. Whether a remark is right is judged by
hand, in judgments.py, with a reason for each case. A remark that nobody judged fails the test. The recordings are those
of $MYOID_DATA, else of ../shared/data beside SOURCE; exit code 77 where there are none.
"""

import fnmatch
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from judgments import JUDGED

ENDINGS = {".c3d", ".trc", ".csv", ".txt", ".edf", ".bdf", ".anc", ".emt", ".tsv", ".sto", ".mot"}
# Results of OpenSim and 431 files of one rat's muscle in a machine are no recordings of a laboratory of movement.
LEFT_OUT = ("opensim/", "opensim-refused/", "rat-gastrocnemius/", "round3/opensim/", "round3/stage_commands/")
STUDIES = ("elbow_emg/study.toml", "elbow_emg/study_landmarks.toml", "box_lift/study.toml", "upper_limb/study.toml")


def codes(source):
    """The codes of ground/core/remark.cpp, in order."""
    text = (source / "myoid" / "ground" / "core" / "remark.cpp").read_text(encoding="utf-8")
    return re.findall(r'"([a-z_]+)"', text[text.index("kNames = {") : text.index("static_assert")])


def recordings(data):
    found = [path.relative_to(data).as_posix() for path in data.rglob("*") if path.suffix.lower() in ENDINGS]
    return sorted(name for name in found if not name.startswith(LEFT_OUT))


def remarks_of(program, folder, file):
    done = subprocess.run([program, "check", "--json", "--quiet", file], cwd=folder, stdout=subprocess.PIPE,
                          stderr=subprocess.DEVNULL, text=True, check=False)  # fmt: skip
    try:
        return json.loads(done.stdout)
    except json.JSONDecodeError:
        return []  # refused as a whole: no recording


def judgment_of(code, file, remark):
    """Whether the remark is right, by the first entry that fits; None: nobody judged it."""
    about = remark.get("channel", "")
    for wanted, pattern, channel, right, _ in JUDGED:
        said = about + " " + remark["message"]
        if wanted == code and fnmatch.fnmatchcase(file, pattern) and re.search(channel, said):
            return right
    return None


def table(names, raised, count):
    lines = ["| remark | warnings and errors | rightly | notes | rightly | recordings |",
             "| --- | --- | --- | --- | --- | --- |"]  # fmt: skip
    false_alarms = total = 0
    for name in names:
        grave = [right for _, level, right in raised.get(name, []) if level in ("error", "warning")]
        notes = [right for _, level, right in raised.get(name, []) if level not in ("error", "warning")]
        files = len({file for file, _, _ in raised.get(name, [])})
        lines.append(f"| `{name}` | {len(grave)} | {sum(grave)} | {len(notes)} | {sum(notes)} | {files} |")
        false_alarms += len(grave) - sum(grave)
        total += len(grave)
    lines += ["", f"Of {total} warnings and errors on {count} recordings and studies {false_alarms} are false."]
    return "\n".join(lines)


def main(program, source):
    program, source = Path(program).resolve(), Path(source).resolve()
    data = Path(os.environ.get("MYOID_DATA", source / ".." / "shared" / "data")).resolve()
    if not (data / "elbow-emg").is_dir():
        print(f"skipped: there is no {data}/elbow-emg")
        sys.exit(77)
    with tempfile.TemporaryDirectory(prefix="myoid.") as folder:
        checkout = Path(folder) / "checkout"
        shutil.copytree(source / "examples", checkout / "examples")
        (Path(folder) / "shared").mkdir()
        (Path(folder) / "shared" / "data").symlink_to(data)
        jobs = [(data, file, file) for file in recordings(data)]
        jobs += [(checkout, f"examples/{study}", f"examples/{study}")
                 for study in STUDIES if (checkout / "examples" / study).is_file()]  # fmt: skip
        with ThreadPoolExecutor(max_workers=os.cpu_count()) as pool:
            found = list(pool.map(lambda job: remarks_of(program, job[0], job[1]), jobs))
    raised, open_cases = {}, []
    for (_, _, file), remarks in zip(jobs, found, strict=True):
        for remark in remarks:
            code = remark["code"]
            if remark["level"] == "detail":
                continue
            right = judgment_of(code, file, remark)
            if right is None:
                case = [code, file, remark.get("channel", ""), remark["level"], remark["message"]]
                open_cases.append(" | ".join(case))
            raised.setdefault(code, []).append((file, remark["level"], bool(right)))
    if open_cases:
        sys.exit(f"{len(open_cases)} remarks are not judged in judgments.py:\n" + "\n".join(open_cases))
    page = source / "docs" / "data" / "remarks.txt"
    printed = table(codes(source), raised, len(jobs)) + "\n"
    if os.environ.get("MYOID_PRINT_PAGES") == "1":
        page.write_text(printed, encoding="utf-8")
    elif page.read_text(encoding="utf-8") != printed:
        sys.exit(f"docs/data/remarks.txt differs from the program; MYOID_PRINT_PAGES=1 writes it:\n{printed}")
    print(printed)


if __name__ == "__main__":
    main(*sys.argv[1:])

"""The commands of campaign.py with their good inputs: a virtual person, its results, and small shared recordings."""

import hashlib
import os
import re
import shutil
import sys
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
DATA = Path(os.environ.get("MYOID_DATA", SOURCE / "../shared/data"))
LARGEST = 200_000  # bytes of a file of the shared recordings
PROTOCOL = """level = "L1"
[emg]
mvc_window_s = 0.5
[[trial]]
name = "mvc"
kind = "mvc"
direction = "both"
rise_s = 0.5
hold_s = 0.8
rest_s = 0.3
[[trial]]
name = "lift"
kind = "eccentric"
held_mass_kg = 1.0
raise_s = 0.8
lower_s = 1.2
rest_s = 0.3
"""
SOLEUS = """[muscle]
name = "soleus"
laws = "millard"
tendon = "equilibrium"
max_isometric_force = 1.276
optimal_fiber_length = 0.0171
tendon_slack_length = 0.0171
[activation]
law = "thelen"
activation_time = 0.010
"""
# Seconds of a run with sanitizers, by group of cases. Only their ratios matter.
SECONDS = {"run": 43.0, "run again": 40.0, "cohort": 40.0, "bids": 33.0, "report": 25.0, "predict": 1.0,
           "twin-study": 8.0, "design": 1.2, "identify": 0.8, "check study": 0.6, "group": 0.5, "compare": 0.5}
OF_OTHERS = 0.25
CHEAP = 1.5  # below it


class Case:
    """A command, its inputs by place, those that are damaged, and the group whose share of the runs it has."""

    def __init__(self, name, arguments, inputs, damaged=None, group=None, renews=None, sealed=()):
        self.name, self.arguments, self.inputs = name, arguments, inputs
        self.damaged = damaged or list(inputs)
        self.group = group or name
        self.renews = renews  # the folder of results among the inputs that the command makes anew
        self.sealed = sealed  # results whose content the list of their folder names: every damage can be seen
        self.size = 0  # bytes of the inputs
        self.good = None  # exit code, numbers and messages of the undamaged run


def storage(columns, rows, rate=100.0):
    """Returns the text of a storage file with the columns' functions of time."""
    text = f"name\nversion=1\nnRows={rows}\nnColumns={len(columns) + 1}\ninDegrees=no\nendheader\n"
    text += "\t".join(["time", *columns]) + "\n"
    for i in range(rows):
        text += "\t".join([f"{i / rate:.4f}", *[f"{f(i / rate):.8g}" for f in columns.values()]]) + "\n"
    return text


def bids_data_set(folder):
    """Puts the virtual person into the form of a BIDS data set, with one study for everybody."""
    person = folder / "bids/sub-01"
    shutil.copytree(folder / "rec", person)
    study = (person / "study.toml").read_text()
    for file in person.iterdir():
        study = study.replace(f'"{file.name}"', f'"../{{name}}/{file.name}"')
    (folder / "bids/code").mkdir()
    (folder / "bids/code/study.toml").write_text(re.sub(r"mass_kg = [\d.]+", "mass_kg = {weight}", study))
    (person / "study.toml").unlink()
    (folder / "bids/participants.tsv").write_text("participant_id\tweight\nsub-01\t73\n")
    (folder / "bids/dataset_description.json").write_text('{"Name": "campaign", "BIDSVersion": "1.9.0"}\n')


def virtual_person(run, folder):
    """Makes a virtual person and the result of every stage in `folder`, by run(words, folder)."""
    (folder / "p.toml").write_text(PROTOCOL)
    for arguments in (
        "twin --protocol p.toml --out rec",
        "run rec/study.toml --out res",
        "ik --model rec/model.osim --markers rec/lift.trc --out ik.mot",
        "id --model rec/model.osim --motion ik.mot --lowpass 6 --out id.sto",
        "paths --model rec/model.osim --motion ik.mot --out paths",
        "emg rec/lift_emg.sto --out activation.sto",
        "convert rec/lift.trc lift.c3d", "convert rec/lift_emg.sto emg.csv", "convert ik.mot ik.csv",
        "convert rec/model.osim new.osim",
    ):
        code, _, err = run(arguments.split(), folder)
        if code not in (0, 4):
            sys.exit(f"{arguments}: {code}: {err}")
    shutil.copytree(folder / "res", folder / "other")
    (folder / "ik.xml").write_text(
        '<?xml version="1.0"?>\n<OpenSimDocument Version="40000">\n<InverseKinematicsTool name="ik">\n'
        "<model_file>rec/model.osim</model_file>\n<marker_file>rec/lift.trc</marker_file>\n"
        "<output_motion_file>out.mot</output_motion_file>\n</InverseKinematicsTool>\n</OpenSimDocument>\n")
    (folder / "persons.csv").write_text("name,study\nA,rec/study.toml\n")
    (folder / "soleus.toml").write_text(SOLEUS)
    (folder / "length.sto").write_text(storage({"length": lambda t: 0.034 + 0.002 * t}, 60))
    (folder / "muscles.csv").write_text(
        "muscle,max_isometric_force,optimal_fiber_length,tendon_slack_length,emg\n"
        "BIC,1060,0.122,0.24,BIC\nBRD,190,0.27,0.06,BRD\nTRI,1500,0.1,0.19,TRI\n")
    bids_data_set(folder)


def own_cases():
    """Returns the cases that start from the virtual person."""
    study = ["rec"]
    model, markers, emg, motion = "rec/model.osim", "rec/lift.trc", "rec/lift_emg.sto", "ik.mot"
    lift = [f"res/lift/{file}" for file in (
        "activation.sto", "MuscleAnalysis_Length.sto", "MuscleAnalysis_MuscleTendonVelocity.sto",
        "MuscleAnalysis_MomentArm_elbow_flexion.sto", "id.sto")]
    identify = [word for pair in zip(("--activations", "--lengths", "--velocities", "--moment-arms", "--torques"), lift)
                for word in pair]
    of_model = ["--model", model, "--motion", motion]
    files = ("rec/lift.trc", "lift.c3d", "ik.csv", emg, motion, "rec/model.osim", "activation.sto")
    return [
        Case("check study", ["check", "rec/study.toml"], study),
        Case("run", ["run", "rec/study.toml", "--out", "out"], study),
        Case("run again", ["run", "rec/study.toml", "--out", "res", "--overwrite"], ["rec", "res"], ["res"],
             renews="res"),
        Case("check defaults", ["check", "rec/study.toml", "--defaults"], study, ["rec/study.toml"]),
        Case("cohort", ["cohort", "persons.csv", "--out", "out"], [*study, "persons.csv"], ["persons.csv"]),
        Case("bids", ["cohort", "bids", "out", "participant"], ["bids"],
             ["bids/code", "bids/participants.tsv", "bids/dataset_description.json"]),
        Case("init", ["init", "out", "--from", "rec"], study),
        Case("ik", ["ik", "--model", model, "--markers", markers, "--out", "out.mot"], [model, markers]),
        Case("id", ["id", *of_model, "--lowpass", "6", "--out", "out.sto"], [model, motion]),
        Case("paths", ["paths", *of_model, "--out", "out"], [model, motion]),
        Case("so", ["so", *of_model, "--lowpass", "6", "--out", "out"], [model, motion]),
        Case("simulate", ["simulate", "--model", model, "--excite", "BIC=0.1@0.2+0.3", "--end", "0.3", "--out", "out"],
             [model]),
        Case("muscle", ["muscle", "--muscle", "soleus.toml", "--length", "length.sto", "--excitation", "1", "--out",
                        "out.sto"], ["soleus.toml", "length.sto"]),
        Case("identify", ["identify", "--muscles", "muscles.csv", *identify, "--coordinate", "elbow_flexion",
                          "--out", "out"],
             ["muscles.csv", *lift]),
        Case("emg", ["emg", emg, "--out", "out.sto"], [emg]),
        Case("emg csv", ["emg", "emg.csv", "--out", "out.sto"], ["emg.csv"], group="emg"),
        Case("twin", ["twin", "--protocol", "p.toml", "--out", "out"], ["p.toml"]),
        Case("twin-study", ["twin-study", "--protocol", "p.toml", "--subjects", "1", "--out", "out"], ["p.toml"]),
        Case("design", ["design", "rec/study.toml", "--movements", "1", "--persons", "1"], study,
             ["rec/study.toml", model]),
        Case("run-tool", ["run-tool", "ik.xml"], ["ik.xml", model, markers]),
        Case("convert model", ["convert", model, "out.osim"], [model]),
        Case("report", ["report", "res"], ["res", "rec"], ["res"], renews="res"),
        Case("predict", ["predict", "res", "--trials", "lift", "--out", "out"], ["res", "rec"], ["res"],
             sealed=("res/parameters.json", "res/run.json")),
        Case("compare", ["compare", "res", "other", "--out", "out"], ["res", "other"], ["other"],
             sealed=("other/parameters.json",)),
        Case("group", ["report", "--group", "res", "other", "--out", "out"], ["res", "other"], ["other"],
             sealed=("other/parameters.json", "other/parameters.csv", "other/report.json")),
        *[Case(f"{command} {file}", [command, file, *more], [file], group=f"{command} file")
          for file in files for command, more in (("info", []), ("info", ["--json"]), ("check", []))],
        *[Case(f"convert {file}", ["convert", file, "out" + to], [file], group="convert")
          for file, to in (("rec/lift.trc", ".c3d"), ("lift.c3d", ".trc"), ("ik.csv", ".sto"), (emg, ".csv"),
                           (motion, ".csv"))],
    ]


def shared_cases(folder):
    """Copies the small files of the shared recordings; returns the cases that read them."""
    cases = []
    if not DATA.is_dir():
        return cases
    kinds = (".trc", ".sto", ".mot", ".c3d", ".csv", ".tsv", ".anc", ".edf", ".txt", ".osim", ".xml")
    for file in sorted(DATA.rglob("*")):
        if file.suffix.lower() not in kinds or not file.is_file() or not 0 < file.stat().st_size <= LARGEST:
            continue
        place = Path("shared") / hashlib.sha1(str(file.relative_to(DATA)).encode()).hexdigest()[:10] / file.name
        (folder / place).parent.mkdir(parents=True)
        shutil.copyfile(file, folder / place)
        name, short, kind = str(place), str(file.relative_to(DATA)), file.suffix.lower()
        commands = [("info", ["--json"])]
        if kind == ".osim":
            commands += [("convert", ["out.osim"])]
        elif kind != ".xml":
            commands += [("convert", ["out"]), ("check", [])]
        if kind not in (".osim", ".xml", ".trc"):
            commands += [("emg", ["--unit", "mV", "--out", "out.sto"])]
        cases += [Case(f"{command} {short}", [command, name, *more], [name], group=f"shared {command} {kind}")
                  for command, more in commands]
    return cases


def group_of(case):
    return " ".join(case.group.split()[:2])


def weights(cases, expensive=0.5):
    """Returns the share of the runs of each case.

    Expensive groups together take the share `expensive` of the time, cheap ones the rest; groups of a kind take the
    same time.
    Within a group small files come more often. Files of the shared recordings count as one group for each command, in
    which the kinds of files are equal.
    """
    def cost(name):
        return SECONDS.get(name, OF_OTHERS)

    names = sorted({group_of(c) for c in cases})
    cheap = [name for name in names if cost(name) < CHEAP]
    kinds = {name: len({c.group for c in cases if group_of(c) == name}) for name in names}
    within = {}
    for c in cases:
        within[c.group] = within.get(c.group, 0.0) + 1.0 / (1.0 + c.size / 50_000)
    result = []
    for c in cases:
        name = group_of(c)
        time = (1.0 - expensive) / len(cheap) if name in cheap else expensive / (len(names) - len(cheap))
        result.append(time / cost(name) / kinds[name] / (1.0 + c.size / 50_000) / within[c.group])
    return result

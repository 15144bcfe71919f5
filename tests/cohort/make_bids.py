#!/usr/bin/env python3
"""Turns the persons of `myoid twin --subjects N` into a BIDS data set.

usage: make_bids.py PEOPLE OUT

Markers become Motion-BIDS (_motion.tsv in m), EMG becomes EDF of 16 bits, torque and model lie under sourcedata/. The
study of the first person, with {name} and {weight} in place of the person's own, becomes code/study.toml.
"""
import json
import pathlib
import re
import sys


def read_trc(path):
    lines = path.read_text().splitlines()
    keys = dict(zip(lines[1].split("\t"), lines[2].split("\t")))
    names = [name for name in lines[3].split("\t")[2:] if name]
    scale = {"mm": 0.001, "m": 1.0}[keys["Units"]]
    rows = []
    for line in lines[5:]:
        cells = line.split("\t")
        if len(cells) < 2 or not cells[0].strip():
            continue
        cells = (cells[2:] + [""] * (3 * len(names)))[:3 * len(names)]
        rows.append(["n/a" if not cell.strip() else repr(float(cell) * scale) for cell in cells])
    return float(keys["DataRate"]), names, rows


def read_sto(path):
    lines = path.read_text().splitlines()
    header = lines.index("endheader")
    names = lines[header + 1].split("\t")
    rows = [[float(cell) for cell in line.split()] for line in lines[header + 2:] if line.strip()]
    return names[1:], [row[0] for row in rows], [row[1:] for row in rows]


def write_motion(base, trc):
    rate, names, rows = read_trc(trc)
    base.parent.mkdir(parents=True, exist_ok=True)
    stem = str(base) + "_tracksys-omc"
    pathlib.Path(stem + "_motion.tsv").write_text("".join("\t".join(row) + "\n" for row in rows))
    channels = "name\tcomponent\ttype\ttracked_point\tunits\n"
    for name in names:
        for axis in "xyz":
            channels += f"{name}_{axis}\t{axis}\tPOS\t{name}\tm\n"
    pathlib.Path(stem + "_channels.tsv").write_text(channels)
    pathlib.Path(stem + "_motion.json").write_text(json.dumps({
        "TaskName": base.name.split("task-")[1], "SamplingFrequency": rate, "TrackingSystemName": "omc",
        "MissingValues": "n/a", "SpatialAxes": "ALS"}, indent=2) + "\n")
    return stem + "_motion.tsv"


def write_edf(path, names, rate, columns):
    """EDF with records of one second; the last one is filled with its last value."""
    per_record = round(rate)
    records = -(-len(columns[0]) // per_record)
    field = lambda text, width: str(text).ljust(width)[:width].encode("ascii")
    ends = []
    for column in columns:
        end = max(abs(value) for value in column) or 1.0
        ends.append(float(f"{end * 1000.0:.6g}") * 1.0001)  # [mV]
    count = len(names)
    head = field(0, 8) + field("X X X X", 80) + field("Startdate X X X X", 80) + b"01.01.8500.00.00"
    head += field(256 * (count + 1), 8) + field("", 44) + field(records, 8) + field(1, 8) + field(count, 4)
    for texts, width in [(names, 16), ([""] * count, 80), (["mV"] * count, 8),
                         ([f"{-end:.6g}" for end in ends], 8), ([f"{end:.6g}" for end in ends], 8),
                         ([-32767] * count, 8), ([32767] * count, 8), ([""] * count, 80),
                         ([per_record] * count, 8), ([""] * count, 32)]:
        head += b"".join(field(text, width) for text in texts)
    body = bytearray()
    for record in range(records):
        for column, end in zip(columns, ends):
            end = float(f"{end:.6g}")
            for i in range(record * per_record, (record + 1) * per_record):
                value = column[min(i, len(column) - 1)] * 1000.0
                body += round(value / end * 32767).to_bytes(2, "little", signed=True)
    path.write_bytes(head + bytes(body))


def write_emg(base, sto):
    names, time, rows = read_sto(sto)
    rate = (len(time) - 1) / (time[-1] - time[0])
    base.parent.mkdir(parents=True, exist_ok=True)
    columns = [[row[c] for row in rows] for c in range(len(names))]
    write_edf(pathlib.Path(str(base) + "_emg.edf"), names, rate, columns)
    channels = "name\ttype\tunits\ttarget_muscle\n" + "".join(f"{name}\tEMG\tmV\t{name}\n" for name in names)
    pathlib.Path(str(base) + "_channels.tsv").write_text(channels)
    pathlib.Path(str(base) + "_emg.json").write_text(json.dumps({
        "TaskName": base.name.split("task-")[1], "SamplingFrequency": round(rate), "PowerLineFrequency": 50,
        "EMGPlacementScheme": "none: a virtual person", "EMGReference": "none: a virtual person",
        "SoftwareFilters": "n/a"}, indent=2) + "\n")


def label_of(task):
    return re.sub("[^A-Za-z0-9]", "", task)


def template_of(text):
    """The first person's study with the places of the data set."""
    def place(match):
        key, quote, file = match.groups()
        if key == "markers":
            task = label_of(file[:-4])
            return f'{key} = "../{{name}}/motion/{{name}}_task-{task}_tracksys-omc_motion.tsv"'
        if key == "emg" and file.endswith("_emg.sto"):
            return f'{key} = "../{{name}}/emg/{{name}}_task-{label_of(file[:-8])}_emg.edf"'
        return f'{key} = "../sourcedata/{{name}}/{file}"'

    text = re.sub(r'^(markers|emg|external_torque|file) = (")([^"]*\.\w+)"', place, text, flags=re.M)
    text = re.sub(r"^mass_kg = .*$", "mass_kg = {weight}", text, flags=re.M)
    text = re.sub(r'^unit = "V"', 'unit = "mV"', text, flags=re.M)
    return re.sub(r'^name = "virtual-.*"$', 'name = "{name}"', text, count=1, flags=re.M)


def main():
    people, out = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    folders = sorted(people.glob("person_*"))
    participants = "participant_id\tweight\n"
    for number, person in enumerate(folders, 1):
        name = f"sub-{number:03d}"
        study = (person / "study.toml").read_text()
        participants += f"{name}\t{re.search(r'^mass_kg = (.*)$', study, re.M).group(1)}\n"
        source = out / "sourcedata" / name
        source.mkdir(parents=True, exist_ok=True)
        for file in sorted(person.iterdir()):
            if file.suffix == ".trc":
                write_motion(out / name / "motion" / f"{name}_task-{label_of(file.stem)}", file)
            elif file.name.endswith("_emg.sto"):
                write_emg(out / name / "emg" / f"{name}_task-{label_of(file.name[:-8])}", file)
            elif file.is_file() and file.name != "study.toml":
                (source / file.name).write_bytes(file.read_bytes())
        if number == 1:
            (out / "code").mkdir(parents=True, exist_ok=True)
            (out / "code" / "study.toml").write_text(template_of(study))
    (out / "participants.tsv").write_text(participants)
    (out / "dataset_description.json").write_text(json.dumps(
        {"Name": "Virtual persons", "BIDSVersion": "1.10.0", "DatasetType": "raw"}, indent=2) + "\n")


if __name__ == "__main__":
    main()

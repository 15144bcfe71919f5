#!/usr/bin/env python3
"""Names the columns of the ankle recordings as a study reads them.

usage: prepare.py TECCHIO_ANKLE OUT

TECCHIO_ANKLE: the folder of the public recordings (examples/get_data tecchio-ankle). OUT: a new folder for the files of
the study. The crank's angle becomes the angle of the model's ankle (plantarflexion = crank + 15 degrees), and the torque
on the dynamometer becomes that on the foot, its opposite.
"""
import csv
import pathlib
import shutil
import sys

if len(sys.argv) != 3:
    sys.exit(__doc__)
recordings, out = map(pathlib.Path, sys.argv[1:])
out.mkdir(parents=True, exist_ok=True)
if any(out.iterdir()):
    sys.exit(f"{out} holds files, which would be replaced; name a new folder")
for path in sorted(recordings.glob("*_dynamometer.csv")):
    with path.open() as source, (out / path.name).open("w", newline="") as target:
        writer = csv.writer(target)
        writer.writerow(["time [s]", "ankle_angle_r [deg]", "ankle_angle_r_moment [Nm]"])
        for time, torque, crank in list(csv.reader(source))[1:]:
            writer.writerow([time, f"{-(float(crank) + 15):.2f}", f"{-float(torque):.2f}"])
for path in sorted(recordings.glob("*_fascicle.csv")):
    with path.open() as source, (out / path.name).open("w", newline="") as target:
        writer = csv.writer(target)
        writer.writerow(["time [s]", "tib_ant_r [mm]"])
        writer.writerows(row[:2] for row in list(csv.reader(source))[1:])
for path in recordings.glob("*_emg.csv"):
    shutil.copy(path, out)

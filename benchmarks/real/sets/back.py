"""ceinms-rt-back: L5/S1 in lifts of a box, each lift from the others, beside the subject that CEINMS-RT calibrated."""
from board import Row

NEEDS = ("ceinms-rt-back",)


def rows(bench):
    for torque in bench.json("review", bench.data / "ceinms-rt-back", "--out", bench.folder / "review")["torques"]:
        yield Row(f"back {torque['trial']}", "R2", torque["left_out"]["r2"],
                  {"CEINMS-RT" + (" (fitted)" if torque["calibration"] else ""):
                   torque["theirs"]["r2"]}, asked=">= 0.75")

"""ceinms-rt-leg: the ankle of a leg that walks at two speeds, each walk from the other.

Twice by `identify` on the project's envelopes, paths and torques, from five seconds and from a minute of each walk; once
by `review`, which computes the torque of the subject that CEINMS-RT calibrated, too.
"""
from board import Given, Row

NEEDS = ("ceinms-rt-leg",)
WALKS = ("walk36", "walk45")


def rows(bench):
    leg = bench.data / "ceinms-rt-leg"
    for torque in bench.json("review", leg, "--out", bench.folder / "review")["torques"]:
        yield Row(f"{torque['trial']} by the other, review", "R2", torque["left_out"]["r2"],
                  {"CEINMS-RT" + (" (fitted)" if torque["calibration"] else ""):
                   torque["theirs"]["r2"]}, asked=">= 0.78")
    given = Given(bench, "ankle_angle_r")
    for walk in WALKS:
        paths = given.paths(walk, leg / "gait2392.osim", leg / walk / "ik.sto")
        given.add(paths, leg / walk / "ik.sto", leg / walk / "emgFilt.sto", leg / walk / "id.sto")
    channels = ("med_gas_r", "lat_gas_r", "soleus_r", "tib_ant_r")
    for name, begin, end in (("five seconds", 19.0, 24.0), ("a minute", None, None)):
        part = () if begin is None else ("--start", begin, "--end", end)
        found = given.left_out(leg / "muscles.csv", "ankle_angle_r_moment", *part)
        others = given.baselines("ankle_angle_r_moment", channels, *(() if begin is None else (begin, end)))
        for walk, fold, other in zip(WALKS, found, others):
            yield Row(f"{walk} by {name} of the other", "R2", fold["identified"]["r2"], other)

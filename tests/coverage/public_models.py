#!/usr/bin/env python3
"""How far public models differ: the source of the beliefs about moment arms and strength.

usage: public_models.py MYOID DATA

MYOID: the program. DATA: the folder with opensim/, ceinms-rt-leg/, box-lift/ and upper-limb-optical/.
Of each muscle that two models have in common, with 10 mm or more in both, ln r2/r1 of the means over the movement, and
the slope of r2/r1 over its mean along the length of the first model, from -1 to 1. Two models that err
alike differ by sqrt(2) of the error of each. Then F_max and l_m0 of the muscles of two models of a leg and two of an
arm: the mean over muscles of the ln ratio, and its standard deviation about this mean.
"""
import pathlib
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml

import numpy as np

POSTURES = 61

# Joint of both models, its range, range in the second model, and the muscles of both.
KNEE = {"bifemlh": "bflh", "bifemsh": "bfsh", "lat_gas": "gaslat", "med_gas": "gasmed", "grac": "grac",
        "rect_fem": "recfem", "sar": "sart", "semimem": "semimem", "semiten": "semiten",
        "vas_int": "vasint", "vas_lat": "vaslat", "vas_med": "vasmed"}
ANKLE = {"ext_dig": "edl", "ext_hal": "ehl", "flex_dig": "fdl", "flex_hal": "fhl", "lat_gas": "gaslat",
         "med_gas": "gasmed", "per_brev": "perbrev", "per_long": "perlong", "soleus": "soleus",
         "tib_ant": "tibant", "tib_post": "tibpost"}
HIP = {"add_brev": "addbrev", "add_long": "addlong", "bifemlh": "bflh", "grac": "grac",
       "rect_fem": "recfem", "sar": "sart", "semimem": "semimem", "semiten": "semiten", "tfl": "tfl",
       "psoas": "psoas", "iliacus": "iliacus", "glut_max1": "glmax1", "glut_max2": "glmax2",
       "glut_max3": "glmax3", "peri": "piri"}
ARM26 = {"BIC": ["BIClong", "BICshort"], "BRA": ["BRA"], "TRIlong": ["TRIlong"],
         "TRIlat": ["TRIlat"], "TRImed": ["TRImed"]}
DAS = {"BIC": ["bic_l", "bic_b_1", "bic_b_2"], "BRA": [f"brachialis_{i}" for i in range(1, 8)],
       "TRIlong": [f"tric_long_{i}" for i in range(1, 5)],
       "TRIlat": [f"tric_lat_{i}" for i in range(1, 6)], "TRImed": [f"tric_med_{i}" for i in range(1, 6)]}
WU = {"BIC": ["bic_l", "bic_s"], "TRIlong": ["tric_long"], "TRIlat": ["tric_lat"], "TRImed": ["tric_med"]}


def columns(path):
    head, *rows = path.read_text().split("endheader")[1].strip().splitlines()
    return dict(zip(head.split("\t"), np.array([[float(x) for x in r.split()] for r in rows]).T))


def paths(program, model, coordinate, low, high):
    """Moment arms about the coordinate and lengths, along its range in degrees."""
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        rows = "".join(f"{0.01 * i}\t{q}\n" for i, q in enumerate(np.linspace(low, high, POSTURES)))
        (folder / "q.mot").write_text(f"q\nversion=1\nnRows={POSTURES}\nnColumns=2\ninDegrees=yes\n"
                                      f"endheader\ntime\t{coordinate}\n{rows}")
        subprocess.run([program, "paths", "--model", model, "--motion", folder / "q.mot", "--out",
                        folder / "out"], check=True, capture_output=True)
        return (columns(folder / f"out/MuscleAnalysis_MomentArm_{coordinate}.sto"),
                columns(folder / "out/MuscleAnalysis_Length.sto"))


def grouped(of, members):
    return [{name: np.mean([part[m] for m in heads if m in part], axis=0)
             for name, heads in members.items() if any(m in part for m in heads)} for part in of]


def differences(first, second, names):
    """ln ratio of the means and slope of the ratio, of every muscle that both have."""
    found = []
    for a, b in names.items():
        if a not in first[0] or b not in second[0]:
            continue
        r, other, length = first[0][a], second[0][b], first[1][a]
        if min(abs(r.mean()), abs(other.mean())) < 0.01 or r.mean() * other.mean() < 0:
            continue
        x = 2 * (length - length.min()) / (length.max() - length.min()) - 1
        known = abs(r) > 0.003
        ratio, weight = other[known] / r[known], abs(r[known])
        slope = np.polyfit(x[known], ratio / np.average(ratio, weights=weight), 1, w=weight)[0]
        found.append((np.log(other.mean() / r.mean()), slope))
        print(f"{a:12s} {1e3 * r.mean():6.1f} {1e3 * other.mean():6.1f} mm  "
              f"ln ratio {found[-1][0]:6.3f}  slope {slope:6.3f}")
    return found


def muscles_of(model, members):
    """F_max and l_m0 of each muscle, F_max summed and l_m0 averaged over its parts."""
    of = {}
    for muscle in xml.parse(model).iter():
        force, length = (muscle.find(f"./{tag}") for tag in ("max_isometric_force", "optimal_fiber_length"))
        if force is not None and length is not None:
            of[muscle.get("name")] = float(force.text), float(length.text)
    parts = {name: [of[m] for m in heads if m in of] for name, heads in members.items()}
    return {name: tuple(np.array(found).T @ np.ones(len(found)) / [1, len(found)])
            for name, found in parts.items() if found}


def compare_muscles(name, first, second):
    for at, parameter in enumerate(("F_max", "l_m0")):
        x = np.array([np.log(second[m][at] / first[m][at]) for m in first if m in second])
        mean, own = abs(x.mean()), x.std(ddof=1)
        print(f"{name}, {parameter} of {len(x)} muscles: ln ratio {mean:.2f} on average, {own:.2f} about it; "
              f"each {mean / np.sqrt(2):.2f} and {own / np.sqrt(2):.2f}")


def main(program, data):
    data = pathlib.Path(data)
    leg = [data / "ceinms-rt-leg/gait2392.osim", data / "opensim/rajagopal2016/model.osim"]
    found = []
    for coordinate, low, high, sign, names in [("knee_angle_r", -100, -5, -1, KNEE),
                                               ("ankle_angle_r", -35, 20, 1, ANKLE),
                                               ("hip_flexion_r", -10, 80, 1, HIP)]:
        second = paths(program, leg[1], coordinate, sign * low, sign * high)
        second = ({name: sign * r for name, r in second[0].items()}, second[1])
        names = {f"{a}_r": f"{b}_r" for a, b in names.items()}
        found += differences(paths(program, leg[0], coordinate, low, high), second, names)
    arm = grouped(paths(program, data / "opensim/arm26/model.osim", "r_elbow_flex", 15, 125), ARM26)
    for model, coordinate, members in [("box-lift/das.osim", "EL_x", DAS),
                                       ("upper-limb-optical/model_subject_1_scaled_markers.osim",
                                        "elbow_flexion", WU)]:
        other = grouped(paths(program, data / model, coordinate, 15, 125), members)
        found += differences(arm, other, {name: name for name in members})
    for name, x in zip(["ln ratio", "slope"], np.array(found).T):
        robust = 1.4826 * np.median(abs(x - np.median(x)))
        square = np.sqrt(np.mean(x * x))
        print(f"{name}: {len(x)} muscles, robust {robust:.3f}, root mean square {square:.3f}; "
              f"each {robust / np.sqrt(2):.3f} to {square / np.sqrt(2):.3f}")
    names = KNEE | ANKLE | HIP
    compare_muscles("leg", muscles_of(leg[0], {a: [f"{a}_r"] for a in names}),
                    muscles_of(leg[1], {a: [f"{b}_r"] for a, b in names.items()}))
    compare_muscles("arm", muscles_of(data / "opensim/arm26/model.osim", ARM26),
                    muscles_of(data / "box-lift/das.osim", DAS))


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])

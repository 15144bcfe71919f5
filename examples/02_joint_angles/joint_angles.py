"""Problem: markers moved with a held mass. How did the elbow move, and which torque did that take?

    joint_angles.py MODEL MARKERS HELD_KG OUT.mot      OUT.mot: the joint angles, for the second step
"""

import sys

import numpy as np

import myoid

model, markers, held_kg, motion = sys.argv[1:]

# Inverse kinematics: the posture of each frame whose model markers lie nearest to the measured.
ik = myoid.ik(model=model, markers=markers, out=motion, overwrite=True)
elbow_deg = np.degrees(ik.angles["elbow_flexion"])
print(f"frames not converged: {ik.frames_not_converged}")
print(f"least flexion: {elbow_deg.min():.4f} deg")
print(f"greatest flexion: {elbow_deg.max():.4f} deg")

# Inverse dynamics: the torque that this motion takes. Two differentiations amplify noise, so the angles are smoothed.
torque = myoid.id(model=model, motion=motion, lowpass=6.0, held_mass=float(held_kg), held_body="forearm_hand",
                  held_at=[0.0, -0.337, 0.0])  # fmt: skip
elbow_nm = torque.forces["elbow_flexion_moment"]
print(f"mean torque: {elbow_nm.mean():.4f} N m")
print(f"greatest torque: {elbow_nm.max():.4f} N m")

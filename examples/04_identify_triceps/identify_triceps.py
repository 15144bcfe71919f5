"""Problem: how strong is the triceps of the person who was recorded, and at which length is it strongest?

    identify_triceps.py STUDY.toml MVC_EMG TRIAL_EMG
"""

import sys

import myoid

study, mvc, trial = sys.argv[1:]

# Raw EMG becomes activation: filter, rectify, smooth, divide by the greatest mean over 4 s of a maximal contraction. A
# study does this for its trials by itself; here one can look at it.
activation = myoid.emg(trial, mvc=mvc, window=4.0).activations[0]
print(f"mean activation of TRI: {activation['TRI'].mean():.4f}")
print(f"greatest activation of TRI: {activation['TRI'].max():.4f}")

# The whole way from markers and EMG to the muscles' numbers, in SI units.
result = myoid.run(study)
for row in result.parameters.where(muscle="TRI", method="torque"):
    if row["std_error"] is not None:
        print(f"{row['parameter']}: {row['estimate']:.6g}, standard error {row['std_error']:.6g}, {row['verdict']}")

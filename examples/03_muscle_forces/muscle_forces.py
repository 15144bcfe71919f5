"""Problem: a muscle is held, shortened and stretched while it is half active. Which force does it make at each length
and speed?

    muscle_forces.py MUSCLE.toml LENGTHS.csv
"""

import sys

import myoid

muscle, lengths = sys.argv[1:]
result = myoid.muscle(muscle=muscle, length=lengths, activation=0.5)

# The series has a row for each sample of the file and a column for each quantity.
series = result.series
rows = zip(series.time, series["fiber_length"], series["fiber_velocity"], series["tendon_force"])
for time, length, speed, force in rows:
    print(f"at {time:.1f} s, fiber {length:.4f} m, {speed:.4f} m/s: {force:.4f} N")

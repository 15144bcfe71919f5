"""Problem: does the method find the truth? A virtual person, whose muscles are known, is recorded and identified, and a
trial that took no part in the fit is predicted.

    simulate_and_recover.py PROTOCOL.toml OUT      OUT: folder for the recording and the results
"""

import sys
from pathlib import Path

import myoid

protocol, out = sys.argv[1], Path(sys.argv[2])

# The seed makes the person: muscles, EMG, noise.
person = myoid.twin(protocol=protocol, out=out / "recording", seed=2, overwrite=True)

# The study of the recording, with the muscles of the literature as a start.
result = myoid.run(person.study, out=out / "results", overwrite=True)
for row in person.truth.where(parameter="max_isometric_force"):
    found = result.parameter(row["muscle"], "max_isometric_force")["estimate"]
    print(f"strength of {row['muscle']}: {found:.1f} N found, {row['value']:.1f} N true")

# The trials of the use `validation` took no part.
for row in myoid.predict(result).scores:
    print(f"torque of {row['trial']}: R2 {row['r2']:.4f}, error {row['rmse_nm']:.4f} N m rms")

"""Problem: a trial was recorded with markers in one file and raw EMG in another. How much is in them, and where and how
strong is it?

    read_a_recording.py MARKERS EMG
"""

import sys

import numpy as np

import myoid

markers_file, emg_file = sys.argv[1:]

# A reader returns SI units whatever the file has: this .trc file has millimeters.
markers = myoid.read(markers_file).markers
frames = len(markers)
duration = markers.time[-1] - markers.time[0]
print(f"markers: {len(markers.names)}")
print(f"frames: {frames}")
print(f"duration: {duration:.6g} s")
print(f"frame rate: {(frames - 1) / duration:.6g} Hz")
print(f"height of {markers.names[0]} in the first frame: {markers.positions[0, 0, 1]:.6g} m")

# Rows of a series are samples, columns are channels.
emg = myoid.read(emg_file).analog
print(f"EMG rate: {emg.rate:.6g} Hz")
for channel in emg.channels:
    rms = np.sqrt(np.mean(emg[channel] ** 2))
    print(f"EMG of {channel}: {1e6 * rms:.6g} uV rms")

"""Measures the import of the module and the reading of a C3D file of 100 MB, in processor time.

    PYTHONPATH=build/release/python python3 tests/python/measure.py build/release/bin/myoid

The file has 60 markers at 200 Hz and 64 channels at 2 kHz as reals; the program writes it from a .trc and an .edf file.
"""

import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

MARKERS, CHANNELS, SECONDS = 60, 64, 142
REPEATS = 7


def write_markers(path):
    frames = 200 * SECONDS
    names = [f"M{i}" for i in range(MARKERS)]
    head = ["PathFileType\t4\t(X/Y/Z)\tm.trc", "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits",
            f"200\t200\t{frames}\t{MARKERS}\tmm", "Frame#\tTime\t" + "\t\t\t".join(names),
            "\t\t" + "\t".join(f"{c}{i + 1}" for i in range(MARKERS) for c in "XYZ"), ""]  # fmt: skip
    numbers = np.random.default_rng(1).integers(-32768, 32768, (frames, 3 * MARKERS))
    rows = (f"{i + 1}\t{i / 200:.3f}\t" + "\t".join(map(str, row)) for i, row in enumerate(numbers.tolist()))
    path.write_text("\n".join([*head, *rows, ""]))


def write_channels(path):
    def fields(width, texts):
        return "".join(f"{text:<{width}}" for text in texts)

    n = CHANNELS
    head = fields(8, ["0"]) + fields(80, ["X X X X", "Startdate 01-JAN-2020 X X X"]) + fields(8, ["01.01.20", "00.00.00"])
    head += fields(8, [str(256 * (n + 1))]) + fields(44, [""]) + fields(8, [str(SECONDS), "1"]) + fields(4, [str(n)])
    head += fields(16, [f"A{i}" for i in range(n)]) + fields(80, [""] * n) + fields(8, ["mV"] * n)
    head += fields(8, ["-5"] * n) + fields(8, ["5"] * n) + fields(8, ["-32768"] * n) + fields(8, ["32767"] * n)
    head += fields(80, [""] * n) + fields(8, ["2000"] * n) + fields(32, [""] * n)
    numbers = np.random.default_rng(2).integers(-32768, 32768, SECONDS * n * 2000, dtype="<i2")
    path.write_bytes(head.encode("ascii") + numbers.tobytes())


def least(action):
    """The least processor time of several runs [s]."""
    times = []
    for _ in range(REPEATS):
        begin = time.process_time()
        action()
        times.append(time.process_time() - begin)
    return min(times)


def main():
    code = "import time; t = time.process_time(); import myoid; print(time.process_time() - t)"
    shown = [float(subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout)
             for _ in range(REPEATS)]  # fmt: skip
    print(f"import myoid: {1e3 * min(shown):.0f} ms")
    import myoid

    with tempfile.TemporaryDirectory() as folder:
        markers, channels, file = (Path(folder) / name for name in ("m.trc", "a.edf", "large.c3d"))
        write_markers(markers)
        write_channels(channels)
        subprocess.run([sys.argv[1], "convert", markers, file, "--analog", channels, "--quiet"], check=True,
                       stdout=subprocess.DEVNULL)  # fmt: skip
        size = file.stat().st_size / 1e6
        reading = least(lambda: myoid.read(file).markers.positions.shape)
        print(f"read, {size:.0f} MB: {reading:.3f} s, {size / reading:.0f} MB/s")
        whole = least(lambda: myoid.read(file).analog.values.shape)
        print(f"read, with all channels as numbers: {whole:.3f} s, {size / whole:.0f} MB/s")
        if len(sys.argv) > 2:  # a copy for another reader
            Path(sys.argv[2]).write_bytes(file.read_bytes())


main()

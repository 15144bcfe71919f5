"""Damaged results are errors of myoid_open with a sentence, never a crash: damaged.py LIBRARY RESULTS WORK"""

import ctypes
import json
import shutil
import sys
from pathlib import Path

library, results, work = ctypes.CDLL(sys.argv[1]), Path(sys.argv[2]), Path(sys.argv[3])
for name in ("myoid_open", "myoid_open_given"):
    getattr(library, name).restype = ctypes.c_void_p
whole = {name: (results / name).read_text() for name in ("parameters.json", "run.json")}


def torque(change):
    """parameters.json with another method torque."""
    parameters = json.loads(whole["parameters.json"])
    change(next(method for method in parameters["methods"] if method["method"] == "torque"))
    return {"parameters.json": json.dumps(parameters)}


deep = 1_000_000
CASES = {
    "no file": {"parameters.json": None},
    "no record of the run": {"run.json": None},
    "empty": {"parameters.json": ""},
    "cut off": {"parameters.json": whole["parameters.json"][: len(whole["parameters.json"]) // 2]},
    "nested lists": {"parameters.json": "[" * deep},
    "nested objects": {"parameters.json": '{"a":' * deep},
    "nested record": {"run.json": '{"study":' + "[" * deep + "]" * deep + "}"},
    "larger than a document may be": {"parameters.json": '"' + "x" * (129 << 20) + '"'},
    "not UTF-8": {"parameters.json": b"\xff\xfe{"},
    "a list": {"parameters.json": "[]"},
    "no method": {"parameters.json": '{"methods": [], "resting_torque": []}'},
    "no row of the covariance": torque(lambda m: m["covariance"]["matrix"].pop()),
    "a short row": torque(lambda m: m["covariance"]["matrix"][0].pop()),
    "no such unknown": torque(lambda m: m["covariance"]["parameters"].__setitem__(0, "BIC.no_such")),
    "no owner": torque(lambda m: m["covariance"]["parameters"].__setitem__(0, "nothing")),
    "numbers as names": torque(lambda m: m["covariance"]["parameters"].__setitem__(0, 7)),
    "no estimates": torque(lambda m: m.pop("estimates")),
    "an estimate without a name": torque(lambda m: m["estimates"][0].pop("parameter")),
    "study of another place": {"run.json": '{"study": "/no/such/study.toml"}'},
}
failures = []
for name, files in CASES.items():
    folder = work / "damaged"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    for file, text in {**whole, **files}.items():
        if text is not None:
            (folder / file).write_bytes(text if isinstance(text, bytes) else text.encode())
    for function in (library.myoid_open, library.myoid_open_given):
        error = ctypes.create_string_buffer(500)
        model = function(str(folder).encode(), None, error, ctypes.c_size_t(len(error)))
        if model or not error.value:
            failures.append(f"{name}: opened, or no sentence")
print(f"{len(CASES)} kinds of damage, {len(failures)} without an error", *failures, sep="\n")
sys.exit(bool(failures))

"""Myoid: muscle parameters of a person from motion capture and EMG.

    import myoid
    r = myoid.run("study.toml")
    r.parameters.where(muscle="BIC", method="torque")

Quantities are in SI units in memory (angles in radians); `read_series` gives a file's own units.

The commands of the program are functions. Arguments have the names of the command line, with "_" for "-", and SI units.
None stands for the library's default. Files are written only where `out` names one.

An input is a file, or a value: a result of `read`, `read_series`, `Model` and `run`, a DataFrame of pandas (index
`time`), an array of xarray (`channel` x `time`, markers `axis` x `channel` x `time`), or a mapping of names to arrays
with the times as "time". The value states its units, by `attrs["units"]` in pandas and xarray; without them angles are
in radians, lengths in m, forces in N. Common arguments:

    start, end: First and last time that is used [s].
    threads: Number of threads; None: all cores. Results are the same for every number.
    seed: Seed of everything random (default 1).
    overwrite: Results that exist are replaced.
    progress: A function of the finished share (0..1) and the name of the work, called in the calling thread; None: a
        bar on stderr where that is a terminal; False: nothing.

Warnings are raised as `MyoidWarning` by the module `warnings`, notes go to the logger "myoid". Ctrl-C stops a call and
raises KeyboardInterrupt. All functions raise InvalidInput, ReadError and ModelError for bad input.
"""

from __future__ import annotations

from ._needs import check_packages, why_not

check_packages()
try:
    from ._native import __version__
except ImportError as error:
    raise ImportError(why_not(error)) from error
from . import plot, stages, studies, tools
from .draws import Draws
from .errors import Error, InternalError, InvalidInput, MissingFileError, ModelError, MyoidWarning, ReadError
from .model import Model, MuscleKinematics
from .recording import Event, ForcePlate, Recording, read, read_series
from .remarks import Remark
from .results import PredictResult, Result, Trial, TwinStudyResult
from .series import Markers, Table, TimeSeries
from .stages import *  # noqa: F403
from .studies import *  # noqa: F403
from .tools import *  # noqa: F403

__all__ = [
    "plot", "read", "read_series", "Model", "Result", "Trial", "Draws", "Recording", "ForcePlate", "Event",
    "Markers", "Table", "TimeSeries", "Remark", "MuscleKinematics", "PredictResult", "TwinStudyResult", "Error",
    "InvalidInput", "ReadError", "MissingFileError", "ModelError", "InternalError", "MyoidWarning", "__version__",
]  # fmt: skip
__all__ += studies.__all__
__all__ += stages.__all__
__all__ += tools.__all__

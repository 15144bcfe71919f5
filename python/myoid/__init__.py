"""Myoid: muscle parameters of a person from motion capture and EMG.

    import myoid
    r = myoid.run("study.toml")
    r.parameters.where(muscle="BIC", method="torque")

Quantities are in SI units in memory (angles in radians); `read_series` gives a file's own units.
"""

from __future__ import annotations

from ._needs import check_packages, why_not

check_packages()
try:
    from ._native import __version__
except ImportError as error:
    raise ImportError(why_not(error)) from error
from . import commands, plot
from .commands import *  # noqa: F403
from .draws import Draws
from .errors import Error, InternalError, InvalidInput, MissingFileError, ModelError, MyoidWarning, ReadError
from .model import Model, MuscleKinematics
from .recording import Event, ForcePlate, Recording, read, read_series
from .remarks import Remark
from .results import PredictResult, Result, Trial, TwinStudyResult
from .series import Markers, Table, TimeSeries

__all__ = [
    "plot", "read", "read_series", "Model", "Result", "Trial", "Draws", "Recording", "ForcePlate", "Event",
    "Markers", "Table", "TimeSeries", "Remark", "MuscleKinematics", "PredictResult", "TwinStudyResult", "Error",
    "InvalidInput", "ReadError", "MissingFileError", "ModelError", "InternalError", "MyoidWarning", "__version__",
]  # fmt: skip
__all__ += commands.__all__

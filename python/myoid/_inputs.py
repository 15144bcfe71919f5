"""The inputs of one call: paths pass through, values become files of the program's own formats.

A command reads every input from a file, with its checks of units, clocks and gaps. A value of Python takes the same
way: the library writes it into a temporary folder, in the shortest texts that give the same numbers back.
"""

from __future__ import annotations

import csv
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import _native
from .errors import InvalidInput
from .results import _Folder
from .series import Markers, Table, TimeSeries

if TYPE_CHECKING:
    from .series import Array

# The kind of value of each option.
_KINDS = {
    "markers": "markers", "muscles": "table", "inputs": "emg", "mvc": "emg", "source": "any",
    **dict.fromkeys(
        ("motion", "speeds", "accelerations", "excitations", "activations", "lengths", "velocities", "forces",
         "moment_arms", "torques", "fascicles", "length", "activation", "excitation", "measured", "emg"), "series"),
}  # fmt: skip


def _plain_list(value: Any) -> bool:
    return isinstance(value, (list, tuple))


def _number(value: Any) -> bool:
    import numbers

    return isinstance(value, numbers.Real) and not isinstance(value, bool)


def _numbers(option: str, values: Any) -> Array:
    """Real numbers; of a span of time its seconds. Other kinds are refused, since NumPy would make other numbers of
    them."""
    import numpy as np

    array = np.asarray(values)
    if array.dtype.kind == "m":
        return array / np.timedelta64(1, "s")
    try:
        if array.dtype.kind in "biufO":
            return array.astype(float)
    except (TypeError, ValueError):
        pass
    raise InvalidInput(f"{option}: found values of the type {array.dtype}, expected real numbers")


def _units(attrs: Any, names: Sequence[str]) -> list[str]:
    """The units that pandas and xarray carry in `attrs["units"]`: one for all, or one by name."""
    units = attrs.get("units", "") if isinstance(attrs, Mapping) else ""
    if isinstance(units, Mapping):
        return [str(units.get(name, "")) for name in names]
    return [str(units or "")] * len(names)


def _clock(option: str, count: int, time: Any, rate: float | None) -> Array:
    import numpy as np

    if time is not None:
        return _numbers("time", time)
    if rate is None:
        raise InvalidInput(f"{option}: an array has no times; give rate [Hz], a mapping with 'time', or a TimeSeries")
    if not rate > 0:
        raise InvalidInput(f"rate: found {rate}, expected a number above 0")
    return np.arange(count) / rate


def _columns(option: str, values: Array, names: Sequence[str] | None) -> tuple[Array, list[str]]:
    """An array as samples x channels, and the names of the channels."""
    if values.ndim == 1:
        values = values[:, None]
    if values.ndim != 2:
        raise InvalidInput(f"{option}: found an array of {values.ndim} dimensions, expected samples x channels")
    if names is None and values.shape[1] == 1:
        names = [option]
    if names is None or len(names) != values.shape[1]:
        found = "none" if names is None else str(len(names))
        raise InvalidInput(
            f"{option}: expected a name for each of {values.shape[1]} channels, found {found}; give a DataFrame, a "
            "mapping of names, or a TimeSeries"
        )
    return values, list(names)


def to_series(option: str, value: Any, rate: float | None = None, names: Sequence[str] | None = None) -> TimeSeries:
    """A series of a TimeSeries, a DataFrame, a DataArray, a mapping of columns, or an array of samples x channels."""
    import numpy as np

    if isinstance(value, TimeSeries):
        return value
    if hasattr(value, "dims") and hasattr(value, "coords"):  # xarray
        array = value.transpose("time", ...)
        values = _numbers(option, array.values)
        labels = [str(name) for name in array.coords["channel"].values] if "channel" in array.coords else names
        values, channels = _columns(option, values, labels)
        times = _numbers("time", array.coords["time"])
        return TimeSeries(times, values, channels, _units(value.attrs, channels))
    if hasattr(value, "to_frame") and not hasattr(value, "columns"):  # one column of pandas
        value = value.to_frame(value.name if value.name is not None else option)
    if hasattr(value, "columns") and hasattr(value, "index"):  # pandas
        time = value["time"] if "time" in value.columns else value.index if value.index.name == "time" else None
        frame = value.drop(columns="time") if "time" in value.columns else value
        channels = [str(name) for name in frame.columns]
        values = _numbers(option, frame)
        return TimeSeries(_clock(option, len(values), time, rate), values, channels, _units(value.attrs, channels))
    if isinstance(value, Mapping):
        given = {str(name): _numbers(option, column) for name, column in value.items() if name != "time"}
        sizes = {column.shape for column in given.values()}
        if len(sizes) != 1 or len(next(iter(sizes))) != 1:
            raise InvalidInput(f"{option}: expected columns of one length, found {sorted(sizes)}")
        values = np.column_stack(list(given.values()))
        time = _clock(option, len(values), value.get("time"), rate)
        return TimeSeries(time, values, list(given), [""] * len(given))
    values = _numbers(option, value)
    if names is None and values.ndim == 2 and rate is not None:
        names = [str(i + 1) for i in range(values.shape[1])]
    values, channels = _columns(option, values, names)
    return TimeSeries(_clock(option, len(values), None, rate), values, channels, [""] * len(channels))


def to_markers(option: str, value: Any, rate: float | None = None) -> Markers:
    """Markers of Markers, of pyomeca's array `axis` x `channel` x `time`, of a table with columns (name, axis), or of a
    mapping of names to frames x 3 [m]."""
    import numpy as np

    if isinstance(value, Markers):
        return value
    if hasattr(value, "dims") and hasattr(value, "coords"):  # xarray
        array = value.transpose("time", "channel", "axis")
        names = [str(name) for name in array.coords["channel"].values]
        return Markers(_numbers("time", array.coords["time"]), _numbers(option, array.values)[:, :, :3], names)
    if hasattr(value, "columns") and hasattr(value, "index"):  # pandas
        names = list(dict.fromkeys(str(column[0]) for column in value.columns))
        positions = _numbers(option, value)
        if positions.shape[1] != 3 * len(names):
            raise InvalidInput(f"{option}: expected columns (name, axis) with x, y, z of each marker")
        return Markers(_clock(option, len(value), value.index, rate), positions.reshape(len(value), -1, 3), names)
    if isinstance(value, Mapping):
        given = {str(name): _numbers(option, column) for name, column in value.items() if name != "time"}
        if len({column.shape for column in given.values()}) != 1:
            raise InvalidInput(f"{option}: expected frames x 3 of each marker")
        positions = np.stack(list(given.values()), axis=1)
        return Markers(_clock(option, len(positions), value.get("time"), rate), positions, list(given))
    raise InvalidInput(
        f"{option}: an array has no names of markers; give Markers(time, positions, names) or a mapping of names to "
        "frames x 3"
    )


class Inputs:
    """The files of one call. The folder lives as long as this object.

    Attributes:
        folder: The folder of the values; None where every input is a file.
    """

    def __init__(self, function: str, options: dict[str, Any]) -> None:
        self.folder: _Folder | None = None
        self._function = function
        self._taken: set[str] = set()
        self._rate = options.pop("rate", None) if function == "emg" else None
        self._names = options.get("channel") if function == "emg" else None
        model = options.get("model")
        if getattr(model, "compat", "exact") != "exact" and options.get("compat") is None:
            options["compat"] = getattr(model, "compat")
        for option, kind in _KINDS.items():
            value = options.get(option)
            if value is not None:
                options[option] = self._files(option, kind, value, options)

    def _files(self, option: str, kind: str, value: Any, options: dict[str, Any]) -> Any:
        if _plain_list(value) and value and not all(map(_number, value)) and kind != "table":
            return [self._file(option, kind, each, options) for each in value]
        return self._file(option, kind, value, options)

    def _file(self, option: str, kind: str, value: Any, options: dict[str, Any]) -> Any:
        if isinstance(value, (str, os.PathLike)) or _number(value):
            return value
        if kind == "any":
            kind = "markers" if isinstance(value, Markers) else "emg"
        if kind == "table":
            return self._table(option, value)
        if kind == "markers":
            markers = self._named(option, to_markers, value, self._rate)
            if options.get("up") is None and markers.source:
                options["up"] = _native.laboratory_up(markers.source) or None
            path = self._path(option, ".trc")
            positions = markers.positions.reshape(len(markers), -1)
            _native.write_markers(path, markers.time, positions, markers.names)
            return path
        names = self._names if kind == "emg" and _plain_list(self._names) else None
        series = self._named(option, to_series, value, self._rate, names)
        path = self._path(option, ".csv" if kind == "emg" else ".sto")
        try:
            _native.write_series(path, series.time, series.values, series.channels, series.units)
        except InvalidInput as error:
            raise InvalidInput(f"{option}: {str(error).replace(f'{path}: ', '')}") from None
        return path

    @staticmethod
    def _named(option: str, make: Callable[..., Any], *values: Any) -> Any:
        """The result of `make`; its errors begin with the name of the option."""
        try:
            return make(option, *values)
        except InvalidInput as error:
            if str(error).startswith((option, "rate")):
                raise
            raise InvalidInput(f"{option}: {error}") from None

    def _table(self, option: str, value: Any) -> str:
        """A table (.csv) of a Table, a DataFrame or a list of rows."""
        rows: Iterable[Mapping[str, Any]] = value.to_dict("records") if hasattr(value, "to_dict") else value
        listed = [{k: "" if v is None or v != v else v for k, v in row.items()} for row in rows]
        path = self._path(option, ".csv")
        with open(path, "w", encoding="utf-8", newline="") as file:
            writer = csv.DictWriter(file, list(dict.fromkeys(key for row in listed for key in row)))
            writer.writeheader()
            writer.writerows(listed)
        return path

    def _path(self, option: str, ending: str) -> str:
        """A new file, which has the name of the option."""
        if self.folder is None:
            self.folder = _Folder(None)
        name, number = option, 1
        while name in self._taken:
            number += 1
            name = f"{option}_{number}"
        self._taken.add(name)
        return str(Path(self.folder.path) / (name + ending))

"""Series over time, markers and tables."""

from __future__ import annotations

import csv
import html
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, overload

from .errors import InvalidInput

if TYPE_CHECKING:
    from numpy.typing import NDArray
    import pandas
    import xarray

    Array = NDArray[Any]

__all__ = ["TimeSeries", "Markers", "Table"]


def _package(name: str, debian: bool = True) -> Any:
    """Imports a package that only this conversion needs. `debian`: Debian 12 has a package of it."""
    import importlib

    try:
        return importlib.import_module(name)
    except ModuleNotFoundError as error:
        remedy = f"pip install {name}" + (f" (Debian: python3-{name})" if debian else "")
        raise ModuleNotFoundError(f"this conversion needs the package {name}: {remedy}", name=name) from error


def _array(values: Array, dtype: Any, copy: Any) -> Array:
    """The values for NumPy's protocol `__array__`."""
    import numpy as np

    if copy:
        return np.array(values, dtype=dtype)
    return np.asarray(values, dtype=dtype)


@dataclass(eq=False)
class TimeSeries:
    """Samples of several channels on one clock.

    Attributes:
        time: Times of the samples [s], strictly increasing.
        values: Samples x channels, in the units of the channels.
        channels: Names of the channels.
        units: Unit of each channel: "V", "N", "N m", "m", "rad", "1" (without dimension), ...
    """

    time: Array
    values: Array
    channels: list[str]
    units: list[str]

    def __len__(self) -> int:
        return len(self.time)

    def __contains__(self, channel: object) -> bool:
        return channel in self.channels

    def __post_init__(self) -> None:
        import numpy as np

        self.time, self.values = np.asarray(self.time, dtype=float), np.asarray(self.values, dtype=float)
        if self.values.shape != (len(self.time), len(self.channels)) or len(self.units) != len(self.channels):
            raise InvalidInput(
                f"found {len(self.time)} times, values {self.values.shape}, {len(self.channels)} channels and "
                f"{len(self.units)} units; expected samples x channels, and a unit for each channel"
            )

    @overload
    def __getitem__(self, key: str) -> Array: ...
    @overload
    def __getitem__(self, key: slice | list[str] | Array) -> TimeSeries: ...
    def __getitem__(self, key: Any) -> Any:
        """`series["BIC"]`: the samples of one channel, in its unit. `series[["BIC", "TRI"]]`: these channels.
        `series[100:200]` or `series[series["BIC"] > 0.5]`: these samples."""
        if isinstance(key, str):
            return self.values[:, self._index(key)]
        if isinstance(key, int):
            raise TypeError("a number names no channel; series.values[3] is one sample, series[3:4] a series of it")
        if isinstance(key, (list, tuple)) and key and all(isinstance(name, str) for name in key):
            columns = [self._index(name) for name in key]
            return TimeSeries(self.time, self.values[:, columns], list(key), [self.units[c] for c in columns])
        return TimeSeries(self.time[key], self.values[key], self.channels, self.units)

    def _index(self, channel: str) -> int:
        try:
            return self.channels.index(channel)
        except ValueError:
            raise KeyError(f"there is no channel {channel!r}; there are {', '.join(self.channels)}") from None

    def __iter__(self) -> Iterator[str]:
        """The names of the channels, as of a data frame and a dict: `dict(series)` has an array for each."""
        return iter(self.channels)

    def keys(self) -> list[str]:
        """The names of the channels."""
        return list(self.channels)

    def items(self) -> Iterator[tuple[str, Array]]:
        """Each channel's name and samples."""
        return ((name, self[name]) for name in self.channels)

    def between(self, start: float, end: float) -> TimeSeries:
        """The samples from `start` to `end` [s], both included."""
        return self[(self.time >= start) & (self.time <= end)]

    def __array__(self, dtype: Any = None, copy: Any = None) -> Array:
        return _array(self.values, dtype, copy)

    def _repr_html_(self) -> str:
        """For notebooks: a row for each channel with its range."""
        import numpy as np

        def row(name: str, unit: str) -> Mapping[str, Any]:
            finite = self[name][np.isfinite(self[name])]
            low, high = (float(finite.min()), float(finite.max())) if len(finite) else (None, None)
            return {"channel": name, "unit": unit, "least": low, "greatest": high}

        span = f"{self.time[0]:.4g} to {self.time[-1]:.4g} s" if len(self) else "empty"
        rows = [row(name, unit) for name, unit in zip(self.channels, self.units)]
        table = Table(rows, ["channel", "unit", "least", "greatest"])
        return f"<p>{len(self)} samples, {span}</p>{table._repr_html_()}"

    def __repr__(self) -> str:
        span = f"{self.time[0]:g} to {self.time[-1]:g} s" if len(self) else "empty"
        names = ", ".join(f"{n} [{u}]" for n, u in list(zip(self.channels, self.units))[:6])
        more = f", and {len(self.channels) - 6} more" if len(self.channels) > 6 else ""
        return f"TimeSeries({len(self)} samples, {span}: {names}{more})"

    @property
    def rate(self) -> float:
        """Mean rate of the samples [Hz]; 0 with fewer than two samples."""
        if len(self) < 2:
            return 0.0
        return (len(self) - 1) / float(self.time[-1] - self.time[0])

    def unit(self, channel: str) -> str:
        """The unit of one channel."""
        return self.units[self._index(channel)]

    def to_pandas(self) -> pandas.DataFrame:
        """A table with the index `time` [s] and a column for each channel; `attrs["units"]` has the units."""
        pandas = _package("pandas")
        frame = pandas.DataFrame(self.values, index=pandas.Index(self.time, name="time"), columns=self.channels)
        frame.attrs["units"] = dict(zip(self.channels, self.units))
        return frame

    def to_xarray(self) -> xarray.DataArray:
        """An array `channel` x `time`, as pyomeca has it. `attrs["units"]` is the unit of all channels, or a dict."""
        array: xarray.DataArray = _package("xarray").DataArray(
            self.values.T, dims=("channel", "time"), coords={"channel": self.channels, "time": self.time}
        )
        same = len(set(self.units)) == 1
        array.attrs["units"] = self.units[0] if same else dict(zip(self.channels, self.units))
        array.attrs["rate"] = self.rate
        return array


def in_radians(series: TimeSeries) -> TimeSeries:
    """Writes the channels in degrees of a series that nobody else holds in radians; returns the series."""
    import math

    for i, unit in enumerate(series.units):
        if unit == "deg":
            series.values[:, i] *= math.pi / 180.0
            series.units[i] = "rad"
    return series


@dataclass(eq=False)
class Markers:
    """Markers over time, in the frame of the laboratory.

    Attributes:
        time: Times of the frames [s].
        positions: Frames x markers x 3 [m]; NaN where a marker is missing.
        names: Names of the markers.
        source: Recording whose laboratory the frame is; empty: no recording says which way is up.
    """

    time: Array
    positions: Array
    names: list[str]
    source: str = ""

    def __post_init__(self) -> None:
        import numpy as np

        self.time, self.positions = np.asarray(self.time, dtype=float), np.asarray(self.positions, dtype=float)
        if self.positions.shape != (len(self.time), len(self.names), 3):
            raise InvalidInput(
                f"found {len(self.time)} times, {len(self.names)} names and positions {self.positions.shape}; expected "
                "frames x markers x 3"
            )

    def __len__(self) -> int:
        return len(self.time)

    def __contains__(self, name: object) -> bool:
        return name in self.names

    @overload
    def __getitem__(self, key: str) -> Array: ...
    @overload
    def __getitem__(self, key: slice | list[str] | Array) -> Markers: ...
    def __getitem__(self, key: Any) -> Any:
        """`markers["RSHO"]`: the positions of one marker, frames x 3 [m]. `markers[["RSHO", "LSHO"]]`: these markers.
        `markers[100:200]`: these frames."""
        if isinstance(key, str):
            return self.positions[:, self._index(key), :]
        if isinstance(key, int):
            raise TypeError("a number names no marker; markers.positions[3] is a frame, markers[3:4] are Markers of it")
        if isinstance(key, (list, tuple)) and key and all(isinstance(name, str) for name in key):
            return Markers(self.time, self.positions[:, [self._index(n) for n in key]], list(key), self.source)
        return Markers(self.time[key], self.positions[key], self.names, self.source)

    def _index(self, name: str) -> int:
        try:
            return self.names.index(name)
        except ValueError:
            raise KeyError(f"there is no marker {name!r}; there are {', '.join(self.names)}") from None

    def __iter__(self) -> Iterator[str]:
        """The names of the markers."""
        return iter(self.names)

    def keys(self) -> list[str]:
        """The names of the markers."""
        return list(self.names)

    def items(self) -> Iterator[tuple[str, Array]]:
        """Each marker's name and positions."""
        return ((name, self[name]) for name in self.names)

    def between(self, start: float, end: float) -> Markers:
        """The frames from `start` to `end` [s], both included."""
        return self[(self.time >= start) & (self.time <= end)]

    def __array__(self, dtype: Any = None, copy: Any = None) -> Array:
        return _array(self.positions, dtype, copy)

    def _repr_html_(self) -> str:
        """For notebooks: a row for each marker with the share of its frames."""
        import numpy as np

        seen = np.isfinite(self.positions).all(axis=2).mean(axis=0) if len(self) else np.zeros(len(self.names))
        rows = [{"marker": name, "seen": f"{100 * share:.0f} %"} for name, share in zip(self.names, seen)]
        return f"<p>{len(self)} frames</p>{Table(rows, ['marker', 'seen'])._repr_html_()}"

    def __repr__(self) -> str:
        names = ", ".join([*self.names[:8], *["..."] * (len(self.names) > 8)])
        return f"Markers({len(self)} frames, {len(self.names)} markers: {names})"

    def to_pandas(self) -> pandas.DataFrame:
        """A table with the index `time` [s] and columns (marker, axis) [m]."""
        pandas = _package("pandas")
        columns = pandas.MultiIndex.from_product([self.names, ["x", "y", "z"]], names=["channel", "axis"])
        frame = pandas.DataFrame(
            self.positions.reshape(len(self), -1), index=pandas.Index(self.time, name="time"), columns=columns
        )
        frame.attrs["units"] = "m"
        return frame

    def to_xarray(self) -> xarray.DataArray:
        """An array `axis` x `channel` x `time` [m], as pyomeca has it."""
        array: xarray.DataArray = _package("xarray").DataArray(
            self.positions.transpose(2, 1, 0),
            dims=("axis", "channel", "time"),
            coords={"axis": ["x", "y", "z"], "channel": self.names, "time": self.time},
        )
        array.attrs["units"] = "m"
        return array


_SHOWN_ROWS = 60

# Columns of text, whatever stands in them: the unit "1", a muscle "1".
_TEXTS = frozenset(
    "muscle parameter unit method case verdict reason trial joint recording channel file movement message".split()
)


def _cell(column: str, text: str) -> Any:
    """A cell of a file: a number, True or False, None where it is empty, or the text."""
    if column in _TEXTS:
        return text
    if text == "":
        return None
    if text in ("true", "false"):
        return text == "true"
    try:
        return float(text)
    except ValueError:
        return text


class Table(Sequence[Mapping[str, Any]]):
    """Rows with named columns, such as parameters.csv. A row is a dict; `table["estimate"]` is a column as a list.

    Numbers are floats, empty cells None.
    """

    def __init__(self, rows: Sequence[Mapping[str, Any]], columns: Sequence[str] | None = None) -> None:
        self._rows = list(rows)
        self.columns: list[str] = list(columns if columns is not None else (rows[0] if rows else ()))

    @classmethod
    def read(cls, path: str | Path) -> Table:
        """Reads a table (.csv) of Myoid."""
        csv.field_size_limit(2**31 - 1)  # names may be long
        with open(path, encoding="utf-8", newline="") as file:
            reader = csv.reader(line for line in file if not line.startswith("#"))
            columns: list[str] = next(reader, [])
            return cls([{c: _cell(c, text) for c, text in zip(columns, row)} for row in reader], columns)

    def __len__(self) -> int:
        return len(self._rows)

    def __iter__(self) -> Iterator[Mapping[str, Any]]:
        return iter(self._rows)

    def __getitem__(self, key: Any) -> Any:
        if isinstance(key, str):
            if key not in self.columns:
                raise KeyError(f"there is no column {key!r}; there are {', '.join(self.columns)}")
            return [row[key] for row in self._rows]
        if isinstance(key, slice):
            return Table(self._rows[key], self.columns)
        return self._rows[key]

    def where(self, **cells: Any) -> Table:
        """The rows with these cells: `table.where(muscle="BIC", method="torque")`. A column `case` is `fit_case`."""
        wanted = {"case" if key == "fit_case" else key: value for key, value in cells.items()}
        unknown = [key for key in wanted if key not in self.columns]
        if unknown:
            raise KeyError(f"there is no column {unknown[0]!r}; there are {', '.join(self.columns)}")
        return Table([r for r in self._rows if all(r[k] == v for k, v in wanted.items())], self.columns)

    def to_pandas(self) -> pandas.DataFrame:
        """The table as a data frame."""
        return _package("pandas").DataFrame(self._rows, columns=self.columns)

    def __repr__(self) -> str:
        return f"Table({len(self)} rows: {', '.join(self.columns)})"

    def _repr_html_(self) -> str:
        """For notebooks: at most 60 rows."""
        head = "".join(f"<th>{html.escape(column)}</th>" for column in self.columns)
        body = "".join(
            "<tr>" + "".join(f"<td>{html.escape(_shown(row[column]))}</td>" for column in self.columns) + "</tr>"
            for row in self._rows[:_SHOWN_ROWS]
        )
        more = f"<p>and {len(self) - _SHOWN_ROWS} more rows</p>" if len(self) > _SHOWN_ROWS else ""
        return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>{more}"


def _shown(value: Any) -> str:
    if value is None:
        return ""
    return f"{value:.4g}" if isinstance(value, float) else str(value)

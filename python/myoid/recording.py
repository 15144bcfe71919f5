"""Recordings: markers, analog channels, EMG, force plates and events of one file."""

from __future__ import annotations

import html
import os
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from . import _native
from ._speech import speaking
from .series import Markers, Table, TimeSeries, in_radians

if TYPE_CHECKING:
    from .series import Array

__all__ = ["Recording", "ForcePlate", "Event", "read", "read_series"]


@dataclass(eq=False)
class ForcePlate:
    """One force plate over time, in the frame of the laboratory. Force and moment act on the person.

    Attributes:
        number: Number of the plate, from 1, as in the file.
        type: Type of the plate by the C3D guide.
        time: [s]
        force: Samples x 3 [N].
        moment: Samples x 3 [N m], about the middle of the surface.
        pressure_center: Samples x 3 [m]; NaN where the plate is not loaded.
        free_moment: Samples x 3 [N m], about the normal through the center of pressure.
        corners: 4 x 3 [m].
    """

    number: int
    type: int
    time: Array
    force: Array
    moment: Array
    pressure_center: Array
    free_moment: Array
    corners: Array


@dataclass(frozen=True)
class Event:
    """An instant that a person marked.

    Attributes:
        time: On the clock of the file [s].
        label: "Foot Strike", ...
        context: "Left", "Right", "General", or empty.
        subject: Name of the person, or empty.
    """

    time: float
    label: str
    context: str = ""
    subject: str = ""


class Recording:
    """One trial as measured: SI units, the clock of the file, the frame of the laboratory.

    Analog channels stay in the numbers of the file until they are asked for.
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path = os.fspath(path)
        with speaking():
            self._file = _native.read(self.path)

    def __fspath__(self) -> str:
        """The file: a recording stands wherever a path does."""
        return self.path

    def __getstate__(self) -> dict[str, Any]:
        """A pickle carries the name of the file, which is read again."""
        return {"path": os.path.abspath(self.path)}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__init__(state["path"])  # type: ignore[misc]

    @cached_property
    def markers(self) -> Markers:
        """Markers [m]; none for a file without markers."""
        markers = self._file.markers()
        markers.source = self.path
        return markers

    @cached_property
    def analog(self) -> TimeSeries:
        """EMG and all other channels of the first clock, each in its SI unit; "1" where the file states none."""
        return self._file.series(0)

    @cached_property
    def other_clocks(self) -> list[TimeSeries]:
        """Channels with clocks of their own."""
        return [self._file.series(clock) for clock in range(1, self._file.clock_count())]

    @property
    def units(self) -> dict[str, str]:
        """The unit of each analog channel, without reading its samples."""
        return {name: unit for clock in range(self._file.clock_count()) for name, unit in self._file.channels(clock)}

    @cached_property
    def emg(self) -> TimeSeries:
        """The channels that may be EMG [V]: in volts, not of a force plate, not named like another instrument's."""
        return self._file.emg()

    @cached_property
    def plates(self) -> list[ForcePlate]:
        """The force plates over time."""
        return [ForcePlate(**plate) for plate in self._file.plates()]

    @cached_property
    def events(self) -> list[Event]:
        """The events, in the order of the file."""
        return [Event(**event) for event in self._file.events()]

    @cached_property
    def notes(self) -> list[str]:
        """How the file was read and repaired."""
        return self._file.notes()

    def __repr__(self) -> str:
        return (
            f"Recording({self.path!r}: {len(self.markers.names)} markers, {len(self.units)} channels, "
            f"{len(self.events)} events)"
        )

    def _repr_html_(self) -> str:
        """For notebooks: the channels with their units, and the markers."""
        rows = [{"channel": name, "unit": unit} for name, unit in self.units.items()]
        text = f"<p>{html.escape(repr(self))}</p>"
        text += self.markers._repr_html_() if self.markers.names else ""
        return text + (Table(rows)._repr_html_() if rows else "")

    def to_xarray(self) -> dict[str, Any]:
        """`markers` and `analog` as arrays of xarray, with the names of pyomeca."""
        return {"markers": self.markers.to_xarray(), "analog": self.analog.to_xarray()}


def read(path: str | os.PathLike[str]) -> Recording:
    """Reads a recording of any format that docs/guide/file-formats.md lists.

    Args:
        path: The file; the ending of its name decides the format.

    Raises:
        ReadError: The file cannot be read as its name says.
    """
    return Recording(path)


def read_series(path: str | os.PathLike[str]) -> TimeSeries:
    """Reads a table (.csv, .tsv, .txt) or a storage file (.sto, .mot) as one series.

    Numbers are in the units of the file, but angles are in radians: columns of a storage file with `inDegrees=yes`
    that are neither translations (`pelvis_tx`) nor forces or EMG by their names are converted.

    Args:
        path: The file.

    Raises:
        ReadError: The file cannot be read.
    """
    with speaking():
        series, _ = _native.read_series(os.fspath(path))
    return in_radians(series)

"""Body models."""

from __future__ import annotations

import html
import os
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from . import _native
from ._shown import Shown
from ._speech import speaking
from .series import Table

if TYPE_CHECKING:
    from .series import Array

__all__ = ["Model", "Coordinate", "Muscle", "Body", "MuscleKinematics"]


@dataclass(frozen=True)
class Coordinate:
    """A coordinate of a model.

    Attributes:
        name: Name in the model file.
        unit: "rad" or "m".
        default, lower, upper: Default value and range [rad or m].
        clamped: The range is a limit.
        locked: The coordinate does not move.
        constrained: The coordinate takes no value of its own: locked, prescribed or coupled.
    """

    name: str
    unit: str
    default: float
    lower: float
    upper: float
    clamped: bool
    locked: bool
    constrained: bool


@dataclass(frozen=True)
class Muscle:
    """A muscle of a model.

    Attributes:
        name, class_name: As in the model file.
        max_isometric_force: [N]
        optimal_fiber_length, tendon_slack_length: [m]
        pennation_at_optimal: [rad]
        max_contraction_velocity: [optimal fiber lengths / s]
    """

    name: str
    class_name: str
    max_isometric_force: float
    optimal_fiber_length: float
    tendon_slack_length: float
    pennation_at_optimal: float
    max_contraction_velocity: float


@dataclass(frozen=True)
class Body:
    """A body of a model; `mass` [kg]."""

    name: str
    mass: float


@dataclass(eq=False, repr=False)
class MuscleKinematics(Shown):
    """Muscles at postures; columns are the muscles in the order of the model.

    Attributes:
        muscles: Names of the muscles.
        length: Musculotendon lengths [m], postures x muscles.
        velocity: Their rates [m/s], lengthening positive.
        moment_arm: r = -dl/dq by coordinate [m], postures x muscles.
    """

    muscles: list[str]
    length: Array
    velocity: Array
    moment_arm: dict[str, Array]


class Model:
    """A body model: an .osim file (OpenSim 1.6 to 4.5), or the built-in arm "arm4".

    Args:
        file: The model file, or "arm4".
        compat: Muscle paths: "exact", or "opensim" for OpenSim 4.5.2's with its defects.

    Raises:
        ReadError: The file cannot be read.
        ModelError: The model is inconsistent.
    """

    def __init__(self, file: str | os.PathLike[str] = "arm4", *, compat: str = "exact") -> None:
        self.file, self.compat = os.fspath(file), compat
        with speaking():
            self._model = _native.read_model({"file": self.file, "compat": compat})
        self.name: str = self._model.name()

    def __fspath__(self) -> str:
        """The file, or "arm4": a model stands wherever a path of a model does."""
        return self.file

    def __getstate__(self) -> dict[str, Any]:
        """A pickle carries the name of the file, which is read again."""
        return {"file": os.path.abspath(self.file) if os.path.isfile(self.file) else self.file, "compat": self.compat}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__init__(state["file"], compat=state["compat"])  # type: ignore[misc]

    @cached_property
    def coordinates(self) -> dict[str, Coordinate]:
        """The coordinates by name, in the order of the model."""
        return {c["name"]: Coordinate(**c) for c in self._model.coordinates()}

    @cached_property
    def muscles(self) -> dict[str, Muscle]:
        """The muscles by name, in the order of the model."""
        return {m["name"]: Muscle(**m) for m in self._model.muscles()}

    @cached_property
    def bodies(self) -> dict[str, Body]:
        """The bodies by name; the first is ground."""
        return {b["name"]: Body(**b) for b in self._model.bodies()}

    @cached_property
    def markers(self) -> list[str]:
        """Names of the markers."""
        return self._model.markers()

    @property
    def unsupported(self) -> list[str]:
        """Parts of the file that are left out and change results."""
        return self._model.unsupported()

    @property
    def notes(self) -> list[str]:
        """Repairs and omissions of the reader."""
        return self._model.notes()

    def __repr__(self) -> str:
        return f"Model({self.name!r}: {len(self.coordinates)} coordinates, {len(self.muscles)} muscles)"

    def _repr_html_(self) -> str:
        """For notebooks: the coordinates with their ranges."""
        rows = [{"coordinate": c.name, "unit": c.unit, "lower": c.lower, "upper": c.upper, "default": c.default}
                for c in self.coordinates.values()]  # fmt: skip
        return f"<p>{html.escape(repr(self))}</p>{Table(rows)._repr_html_()}"

    def muscle_kinematics(
        self, posture: Mapping[str, Any] | None = None, *, speeds: Mapping[str, Any] | None = None
    ) -> MuscleKinematics:
        """Lengths, velocities and moment arms of all muscles at one posture or many.

        Args:
            posture: Values by coordinate [rad or m]: numbers, or arrays of one length for many postures. Other
                coordinates have their default value.
            speeds: Rates by coordinate [rad/s or m/s]; 0 where not given.

        Raises:
            ModelError: There is no such coordinate.
            InvalidInput: Arrays differ in length.
        """
        import numpy as np

        given = dict(posture or {})
        rates = dict(speeds or {})
        sizes = [np.size(value) for value in [*given.values(), *rates.values()]]
        count = max(sizes, default=1)

        def spread(values: Mapping[str, Any]) -> dict[str, Any]:
            return {k: np.full(count, v) if np.ndim(v) == 0 else np.ravel(v) for k, v in values.items()}

        found = self._model.muscle_kinematics(spread(given), spread(rates), count)
        return MuscleKinematics(muscles=list(self.muscles), **found)

    def lengths(self, posture: Mapping[str, Any] | None = None) -> dict[str, Any]:
        """Musculotendon lengths [m] by muscle.

        A posture of numbers gives a number for each muscle; where a coordinate has an array, each muscle has an array
        of the same length.

        Args:
            posture: As of `muscle_kinematics` [rad or m].
        """
        found = self.muscle_kinematics(posture)
        return _by_muscle(found.muscles, found.length, posture)

    def moment_arms(self, coordinate: str, posture: Mapping[str, Any] | None = None) -> dict[str, Any]:
        """Moment arms r = -dl/dq [m] about a coordinate by muscle; numbers or arrays, as `lengths`.

        Args:
            coordinate: Name of the coordinate.
            posture: As of `muscle_kinematics` [rad or m].

        Raises:
            ModelError: The coordinate does not exist or is locked.
        """
        from .errors import ModelError

        found = self.muscle_kinematics(posture)
        if coordinate not in found.moment_arm:
            names = ", ".join(found.moment_arm)
            raise ModelError(f"there are no moment arms about {coordinate!r}; there are about {names}")
        return _by_muscle(found.muscles, found.moment_arm[coordinate], posture)


def _by_muscle(muscles: list[str], values: Array, posture: Mapping[str, Any] | None) -> dict[str, Any]:
    """The columns by muscle: arrays where the posture holds an array, else numbers."""
    import numpy as np

    if any(np.ndim(value) > 0 for value in (posture or {}).values()):
        return {muscle: values[:, i] for i, muscle in enumerate(muscles)}
    return {muscle: float(values[0, i]) for i, muscle in enumerate(muscles)}

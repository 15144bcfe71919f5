"""Pictures of results by matplotlib (`pip install matplotlib`; Debian: python3-matplotlib).

    axes = myoid.plot.forest(result)
    axes.figure.savefig("forest.png")

Each function draws into the axes `ax`, or into new ones, and returns the axes. Labels say the units.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from .errors import InvalidInput
from .results import VERDICT_COLORS, PredictResult, Result, Trial
from .series import Table, TimeSeries, _package

if TYPE_CHECKING:
    from .stages import SweepResult

__all__ = ["forest", "curves", "torque", "carpet"]

_READINGS = {"person": ("estimate", "ci_low", "ci_high"), "given": ("given_estimate", "given_ci_low", "given_ci_high")}


def _axes(ax: Any, width: float = 6.4, height: float = 4.0) -> Any:
    """The axes to draw into; `width`, `height`: size of a new figure [inch]."""
    if ax is not None:
        return ax
    _package("matplotlib")
    from matplotlib.figure import Figure

    try:  # in a notebook or a window the figure is shown
        from matplotlib import pyplot
    except ImportError:
        return Figure(figsize=(width, height), layout="constrained").add_subplot()
    return pyplot.subplots(figsize=(width, height), layout="constrained")[1]


def _label(name: str, unit: str) -> str:
    return name if unit in ("", "1") else f"{name} [{unit}]"


def forest(
    result: Result | Table, *, parameter: str | None = None, method: str = "torque", reading: str = "person",
    ax: Any = None,
) -> Any:  # fmt: skip
    """Estimates with their 95 % intervals, a row for each, in the colour of the verdict.

    Args:
        result: A result, or rows of its `parameters`.
        parameter: Only this one, in its unit; None: all, each as a multiple of its starting value.
        method: "torque", "force" or "paper".
        reading: "person", or "given" geometry and sensors.
        ax: Axes to draw into.

    Raises:
        InvalidInput: No row has an estimate and an interval.
    """
    if reading not in _READINGS:
        raise InvalidInput(f"reading: found {reading!r}, expected {', '.join(_READINGS)}")
    table = result.parameters if isinstance(result, Result) else result
    columns = _READINGS[reading]
    rows = [
        row
        for row in table.where(method=method)
        if parameter in (None, row["parameter"])
        and all(row[column] is not None for column in columns)
        and (parameter is not None or row["initial"])
    ]
    if not rows:
        raise InvalidInput(f"no row has parameter={parameter!r}, method={method!r} and an interval of this reading")
    axes = _axes(ax, height=0.8 + 0.24 * len(rows))
    seen: dict[str, Any] = {}
    for y, row in enumerate(rows):
        scale = 1.0 if parameter is not None else 1.0 / row["initial"]
        middle, *ends = (row[column] * scale for column in columns)
        low, high = min(ends), max(ends)  # a negative starting value turns them round
        color = VERDICT_COLORS.get(row["verdict"], "#888")
        axes.plot([low, high], [y, y], color=color, linewidth=2.5, solid_capstyle="butt")
        (seen[row["verdict"]],) = axes.plot([middle], [y], "o", color=color, markersize=5)
        if parameter is not None and row["initial"] is not None:
            axes.plot([row["initial"]], [y], "|", color="#777", markersize=9)
    if parameter is None:
        axes.axvline(1.0, color="#777", linewidth=0.8, zorder=0)
        middles = [row[columns[0]] / row["initial"] for row in rows]
        axes.set_xlim(min(0.0, 1.1 * min(middles)), max(2.0, 1.1 * max(middles)))
    owners = [row["muscle"] or "joint" for row in rows]
    names = [owner if parameter else f"{owner}  {row['parameter']}" for owner, row in zip(owners, rows)]
    axes.set_yticks(range(len(rows)), names)
    axes.set_ylim(len(rows) - 0.5, -0.5)
    unit = rows[0]["unit"] if parameter is not None else ""
    axes.set_xlabel(_label(parameter, unit) if parameter is not None else "estimate / starting value")
    axes.legend(list(seen.values()), [v.replace("_", " ") for v in seen], loc="best", fontsize="small")
    return axes


def curves(
    thing: TimeSeries | SweepResult, quantity: str = "moment_arm", *, channels: Sequence[str] | None = None,
    ax: Any = None,
) -> Any:  # fmt: skip
    """Channels of a series over time, or muscles of a `sweep` over the angle [rad].

    Args:
        thing: A series, or a result of `sweep`.
        quantity: Of a sweep: "moment_arm", "length" [m], "full_force" or "passive_force" [N].
        channels: Only these channels or muscles.
        ax: Axes to draw into.

    Raises:
        InvalidInput: There is no such quantity.
    """
    axes = _axes(ax)
    if isinstance(thing, TimeSeries):
        names = list(channels) if channels is not None else thing.channels
        for name in names:
            axes.plot(thing.time, thing[name], label=_label(name, thing.unit(name)))
        units = sorted({thing.unit(name) for name in names})
        axes.set_xlabel("time [s]")
        axes.set_ylabel(f"[{units[0]}]" if len(units) == 1 else "")
    else:
        units_of = {"moment_arm": "m", "length": "m", "full_force": "N", "passive_force": "N"}
        if quantity not in units_of:
            raise InvalidInput(f"quantity: found {quantity!r}, expected {', '.join(units_of)}")
        drawn: Mapping[str, Any] = getattr(thing, quantity)
        for name in channels if channels is not None else drawn:
            axes.plot(thing.values, drawn[name], label=name)
        axes.set_xlabel(_label(thing.coordinate, thing.unit))
        axes.set_ylabel(_label(quantity.replace("_", " "), units_of[quantity]))
    axes.legend(fontsize="small")
    return axes


def torque(
    predicted: PredictResult | Trial, joint: str | None = None, *, trial: str | None = None, ax: Any = None
) -> Any:
    """The measured torque of a joint and the predicted one with its 95 % band.

    Args:
        predicted: The result of `predict`, or one of its trials.
        joint: Name of the joint; None: the first.
        trial: Name of the trial; None: the first.
        ax: Axes to draw into.

    Raises:
        InvalidInput: There is no such trial or joint.
    """
    if isinstance(predicted, PredictResult):
        trials = predicted.trials
        name = trial if trial is not None else next(iter(trials), "")
        if name not in trials:
            raise InvalidInput(f"trial: found {trial!r}, expected {', '.join(trials)}")
        predicted = trials[name]
    begin = "predicted_torque_"
    joints = [series[len(begin) :] for series in predicted if series.startswith(begin)]
    joint = joint if joint is not None else next(iter(joints), "")
    if joint not in joints:
        raise InvalidInput(f"joint: found {joint!r}, expected {', '.join(joints) or 'the torques of predict'}")
    series = predicted[f"{begin}{joint}"]
    axes = _axes(ax)
    axes.fill_between(
        series.time, series[f"{joint}_low"], series[f"{joint}_high"], color="#2a78a8", alpha=0.25, linewidth=0,
        label="95 % band",
    )  # fmt: skip
    axes.plot(series.time, series[f"{joint}_predicted"], color="#2a78a8", label="predicted")
    axes.plot(series.time, series[f"{joint}_measured"], color="#222", linewidth=1, label="measured")
    axes.set_xlabel("time [s]")
    axes.set_ylabel(_label(f"torque of {joint}", "N m"))
    axes.set_title(predicted.name)
    axes.legend(fontsize="small")
    return axes


def carpet(
    series: TimeSeries, *, channels: Sequence[str] | None = None, most: float | None = None, ax: Any = None
) -> Any:
    """Channels as rows of colour over time, such as the activations of `emg`.

    Args:
        series: The series.
        channels: Only these.
        most: Value of the darkest colour; None: the greatest of all.
        ax: Axes to draw into.

    Raises:
        InvalidInput: The channels have several units, or there are fewer than two samples.
    """
    import numpy as np

    shown = series if channels is None else series[list(channels)]
    units = sorted(set(shown.units))
    if len(units) != 1 or len(shown) < 2:
        raise InvalidInput(f"found {len(shown)} samples in {', '.join(units)}; expected two or more, in one unit")
    axes = _axes(ax, height=1.2 + 0.3 * len(shown.channels))
    half = 0.5 / shown.rate
    image = axes.imshow(
        np.asarray(shown).T, aspect="auto", interpolation="nearest", cmap="magma_r", vmin=0.0, vmax=most,
        extent=(shown.time[0] - half, shown.time[-1] + half, len(shown.channels) - 0.5, -0.5),
    )  # fmt: skip
    axes.set_yticks(range(len(shown.channels)), shown.channels)
    axes.set_xlabel("time [s]")
    axes.figure.colorbar(image, ax=axes, label=_label("", units[0]) or "share of the largest effort")
    return axes

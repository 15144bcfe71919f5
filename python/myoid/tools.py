"""The commands about files: set-ups of OpenSim, what a file holds, other formats."""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ._call import call
from ._options import File, Input, Report, Texts
from ._shown import Shown
from .errors import InvalidInput, MissingFileError
from .remarks import Remark

__all__ = [
    "ToolResult", "run_tool", "scale", "info", "convert",
]  # fmt: skip


@dataclass(eq=False, repr=False)
class ToolResult(Shown):
    """What a tool of OpenSim did.

    Attributes:
        tool: "InverseKinematicsTool", "ScaleTool", ...
        summary: One line.
        files: Written, in order.
        frames, frames_failed: Numbers of frames.
        good: Every frame was solved.
        notes: Repairs and omissions.
    """

    tool: str
    summary: str
    files: list[Path]
    frames: int
    frames_failed: int
    good: bool
    notes: list[str]
    remarks: list[Remark] = field(default_factory=list)


def run_tool(setup: File, *, model: File | None = None, motion: File | None = None,
             external_loads: File | None = None, out: File | None = None, anywhere: bool = False,
             compat: str | None = None, threads: int | None = None,
             progress: Report = None) -> ToolResult:  # fmt: skip
    """Runs an OpenSim set-up file: inverse kinematics, inverse dynamics, analyses, scaling.

    Args:
        setup: Set-up file (.xml).
        model, motion, external_loads: Files in place of the set-up's.
        out: Folder of the results, in place of the set-up's.
        anywhere: Also write outside the folder of the set-up, where the set-up says so.
        compat: "opensim" (default) or "exact".
    """
    found = call("run_tool", locals())
    found["files"] = [Path(file) for file in found["files"]]
    return ToolResult(**found)


def scale(setup: File, *, model: File | None = None, motion: File | None = None, out: File | None = None,
          anywhere: bool = False, threads: int | None = None,
          progress: Report = None) -> ToolResult:  # fmt: skip
    """Scales a model by a set-up file of OpenSim's ScaleTool (`run_tool` for this one tool).

    Args:
        setup: Set-up file (.xml) with a ScaleTool.
        model: Generic model, in place of the set-up's.
        motion: Markers for placing the model's markers (.trc), in place of the set-up's.
        out: Folder of the results, in place of the set-up's.
        anywhere: As of `run_tool`.
    """
    options = locals()
    try:
        text = Path(setup).read_text(encoding="utf-8", errors="replace")
    except FileNotFoundError as error:
        raise MissingFileError(f"{setup}: there is no such file", os.fspath(setup)) from error
    except OSError as error:
        raise InvalidInput(f"{setup}: {error.strerror}") from error
    if "<ScaleTool" not in text:
        raise InvalidInput(f"{setup}: found no ScaleTool; run_tool runs the set-ups of other tools")
    found = call("run_tool", options)
    found["files"] = [Path(file) for file in found["files"]]
    return ToolResult(**found)


def info(file: File, *, compare_compat: bool = False, postures: int | None = None, jumps: bool = False,
         compat: str | None = None, threads: int | None = None, seed: int | None = None,
         progress: Report = None) -> dict[str, Any]:  # fmt: skip
    """What a file holds: channels, units, rates, duration, gaps, repairs; of a model also its unsupported elements.

    Args:
        file: A recording, table, model or study; or "arm4".
        compare_compat: Of a model: for which muscles exact paths differ from OpenSim's, over random postures.
        postures: Random postures for that.
        jumps: Of a model: where a length or moment arm jumps.
        compat: "exact" (default) or "opensim".
    """
    return call("info", locals())


def convert(source: Input, out: File, *, what: str | None = None, up: str | None = None, rotate: Texts | None = None,
            body: Texts | None = None, least_force: float | None = None, unit: str | None = None,
            channel: Texts | None = None, analog: File | None = None, rate: float | None = None,
            subject: str | None = None, compat: str | None = None, start: float | None = None,
            end: float | None = None, overwrite: bool = False, progress: Report = None) -> list[Path]:  # fmt: skip
    """Writes a recording in another format (C3D, TRC, STO/MOT, CSV), or an OpenSim file in the newest form. Returns the
    files.

    Args:
        source: A recording, an OpenSim file (.osim, .xml), or the folder of a finished run.
        out: .c3d, .trc, .sto, .mot, .csv, or a folder for everything in it; .osim, .xml of an OpenSim file; .mat of a
            storage file or of the folder of a run.
        what: "markers", "channels", "emg" or "plates".
        up: Vertical axis of the laboratory, turned to y.
        rotate: "AXIS:DEGREES", further turns.
        body: Bodies that stand on plates 1, 2, ...: writes ExternalLoads too.
        least_force: Below it a plate counts as unloaded [N] (default 10).
        unit: Unit of EMG where the file does not say.
        channel: Only these.
        analog: Channels to go with the markers of a .trc into a .c3d.
        rate: Everything on an even clock of this rate [Hz].
        subject: Label of the person in a BIDS derivative.
        compat: Of an OpenSim file: "exact" (default), or "opensim", which rounds offsets to six digits.
    """
    return [Path(file) for file in call("convert", locals())]

"""Remarks on inputs and results."""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["Remark"]


@dataclass(frozen=True)
class Remark:
    """One thing that a person should know about an input or a result.

    Attributes:
        severity: "error", "warning", "note" or "detail".
        code: The question that the remark answers, such as "marker_gap".
        text: The remark in one line.
        where: Trial or file; empty for the whole study.
        about: Marker, channel, plate or coordinate; empty where there is none.
        begin, end: The time [s] of the matter; None where it has none.
        value: The measured size, in the unit of the limit in the documentation of `check`.
    """

    severity: str
    code: str
    text: str
    where: str = ""
    about: str = ""
    begin: float | None = None
    end: float | None = None
    value: float | None = None

    def __str__(self) -> str:
        return f"{self.severity}: {self.where}: {self.text}" if self.where else f"{self.severity}: {self.text}"

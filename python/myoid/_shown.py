"""How the results of calls show themselves: a line for each field, and tables in notebooks."""

from __future__ import annotations

import dataclasses
import html
from collections.abc import Mapping
from typing import Any

from .series import Markers, Table, TimeSeries

_NAMES = 6
_TEXT = 90


def _names(names: list[str]) -> str:
    more = f", and {len(names) - _NAMES} more" if len(names) > _NAMES else ""
    return ", ".join(names[:_NAMES]) + more


def _text(text: str) -> str:
    return text if len(text) <= _TEXT else text[: _TEXT - 1] + "…"


def brief(value: Any) -> str:
    """A value in one line."""
    if isinstance(value, Table):
        return f"{len(value)} rows: {_names(value.columns)}" if len(value) else "no rows"
    if isinstance(value, (TimeSeries, Markers)):
        return _text(repr(value))
    if isinstance(value, Mapping):
        return f"{len(value)}: {_names([str(key) for key in value])}" if value else "none"
    if isinstance(value, list):
        if not value:
            return "none"
        first = brief(value[0])
        return first if len(value) == 1 else _text(f"{len(value)}: {first}, ...")
    if hasattr(value, "shape"):
        span = f", {value.min():g} to {value.max():g}" if value.size and value.dtype.kind == "f" else ""
        return f"array {value.shape}{span}"
    return _text(str(value))


@dataclasses.dataclass(eq=False, repr=False)
class Shown:
    """A dataclass that shows a line for each field."""

    def _fields(self) -> dict[str, Any]:
        return {field.name: getattr(self, field.name) for field in dataclasses.fields(self)}

    def __repr__(self) -> str:
        lines = (f"  {name}: {brief(value)}" for name, value in self._fields().items())
        return "\n".join([f"{type(self).__name__}(", *lines, ")"])

    def _repr_html_(self) -> str:
        """For notebooks: a row for each field, then its tables."""
        fields = self._fields()
        rows = [{"field": name, "value": brief(value)} for name, value in fields.items()]
        tables = (
            f"<p>{html.escape(name)}</p>{value._repr_html_()}"
            for name, value in fields.items()
            if isinstance(value, Table) and len(value)
        )
        return Table(rows, ["field", "value"])._repr_html_() + "".join(tables)

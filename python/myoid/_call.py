"""Calls of the library: progress, remarks and the text of the call."""

from __future__ import annotations

import logging
import os
import sys
import time
import warnings
from collections.abc import Callable
from typing import Any

from . import _native
from ._inputs import Inputs
from ._speech import in_python, speaking, values_in_python
from .errors import MyoidWarning

log = logging.getLogger("myoid")

Progress = Callable[[float, str], Any]


class _Bar:
    """The bar of the command line on stderr, ten times a second at most."""

    def __init__(self) -> None:
        self._begin = self._last = time.monotonic()
        self._drawn = False

    def __call__(self, share: float, what: str) -> None:
        now = time.monotonic()
        if share < 1.0 and now - self._last < 0.1:
            return
        self._last, self._drawn = now, True
        elapsed = now - self._begin
        left = f"{elapsed * (1 - share) / share:.0f} s left" if 0.02 < share < 1.0 else ""
        bar = "=" * int(share * 24)
        print(f"\r\033[K[{bar:<24}] {100 * share:3.0f} %  {left}  {what}", end="", file=sys.stderr, flush=True)

    def end(self) -> None:
        if self._drawn:
            print("\r\033[K", end="", file=sys.stderr, flush=True)


def _shown(value: Any) -> str:
    """An argument in the text of the call."""
    if isinstance(value, os.PathLike):
        return str(os.fspath(value))
    if isinstance(value, (list, tuple)) and len(value) <= 20:
        return f"[{', '.join(map(_shown, value))}]"
    if isinstance(value, dict) and len(value) <= 20:
        return f"{{{', '.join(f'{key!r}: {_shown(each)}' for key, each in value.items())}}}"
    if isinstance(value, (str, bool, int, float)):
        return repr(value)
    size = getattr(value, "shape", None) or (len(value) if hasattr(value, "__len__") else "")
    return f"{type(value).__name__} {size}".strip()


def call(function: str, options: dict[str, Any]) -> dict[str, Any]:
    """Calls a function of the library with the keyword arguments of its Python function; None is not passed on, and
    values become files (`Inputs`)."""
    given = {name: value for name, value in options.items() if value is not None}
    progress = given.pop("progress", None)
    shown = ", ".join(f"{k}={_shown(v)}" for k, v in given.items())
    inputs = Inputs(function, given)
    folder = inputs.folder.path if inputs.folder else None

    def hear(severity: str, text: str) -> None:
        """A remark that the library makes while it works: warnings become Python's, the rest goes to the log."""
        text = in_python(text, folder)
        if severity in ("warning", "error"):
            warnings.warn(text, MyoidWarning, stacklevel=4)
        else:
            log.log(logging.DEBUG if severity == "detail" else logging.INFO, text)

    given = {name: value for name, value in given.items() if value is not None}
    bar = _Bar() if progress is None and sys.stderr is not None and sys.stderr.isatty() else None
    given["command_line"] = f"myoid {function.replace('_', '-')} ({shown}) from Python"
    given["hear"] = hear
    if progress is not None and progress is not False:
        given["progress"] = progress
    elif bar is not None:
        given["progress"] = bar
    try:
        with speaking(folder):
            found: dict[str, Any] = values_in_python(getattr(_native, function)(given), folder)
    finally:
        if bar is not None:
            bar.end()
        if inputs.folder is not None and function != "identify":
            inputs.folder.remove()
    if function == "identify" and inputs.folder is not None:
        found["inputs"] = inputs.folder  # the run names these files
    return found

"""The sentences of the library in the words of Python: options are keyword arguments."""

from __future__ import annotations

import re
import shlex
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

from .errors import Error
from .remarks import Remark

_COMMAND = re.compile(r"`myoid ([a-z][a-z-]*)((?: [^`]+)?)`")
_SHORT = re.compile(r"\(myoid ([a-z][a-z-]*)((?: --[a-z][a-z-]*)+)\)")
_OPTION = re.compile(r"(?<![\w-])--([a-z][a-z0-9]*(?:-[a-z0-9]+)*)")


def _keyword(option: str) -> str:
    name = option.lstrip("-").replace("-", "_")
    return "from_" if name == "from" else name


def _option(match: re.Match[str]) -> str:
    return "overwrite=True" if match[1] == "overwrite" else _keyword(match[1])


def _call(match: re.Match[str]) -> str:
    """A command line as a call: "`myoid info FILE --jumps`" becomes "`myoid.info('FILE', jumps=True)`"."""
    try:
        words = shlex.split(match[2])
    except ValueError:
        return match[0]
    said: list[str] = []
    for word in words:
        if word.startswith("--"):
            said.append(f"{_keyword(word)}=True")
        elif said and said[-1].endswith("=True"):
            said[-1] = f"{said[-1][:-4]}{word!r}"
        else:
            said.append(repr(word))
    return f"`myoid.{match[1].replace('-', '_')}({', '.join(said)})`"


def by_option(text: str, folder: Path | None) -> str:
    """A text in which the file of a value has the name of its option."""
    return text if folder is None else re.sub(re.escape(f"{folder}/") + r"(\w+)\.(?:sto|csv|trc)", r"\1", text)


def in_python(text: str, folder: Path | None = None) -> str:
    """A sentence of the library for a caller in Python. `folder`: the folder of values that were given, whose files are
    named by their options."""
    text = _COMMAND.sub(_call, by_option(text, folder))
    text = _SHORT.sub(lambda m: f"(myoid.{_keyword(m[1])}, {_OPTION.sub(_option, m[2]).strip()})", text)
    return _OPTION.sub(_option, text)


@contextmanager
def speaking(folder: Path | None = None) -> Iterator[None]:
    """Errors of the library that leave the block speak Python."""
    try:
        yield
    except Error as error:
        error.args = (in_python(str(error), folder), *error.args[1:])
        raise


# Sentences among the values of a call; other texts are names and stay as they are.
_SENTENCES = frozenset(("message", "notes", "says", "unlike", "diagnoses", "not_converged"))


def values_in_python(found: Any, folder: Path | None, key: str = "") -> Any:
    """The values of a call with its sentences and remarks in the words of Python."""
    if isinstance(found, str):
        if key in _SENTENCES:
            return in_python(found, folder)
        return by_option(found, folder)
    if isinstance(found, Remark):
        return replace(found, text=in_python(found.text, folder), where=in_python(found.where, folder))
    if isinstance(found, dict):
        return {name: values_in_python(value, folder, str(name)) for name, value in found.items()}
    if isinstance(found, list):
        return [values_in_python(value, folder, key) for value in found]
    return found

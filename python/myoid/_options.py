"""Types of the arguments that the commands share."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Any, Union

from ._call import Progress

File = Union[str, "os.PathLike[str]"]
Input = Any  # a file, or a value: see __init__.py
Inputs = Any  # one or several
Texts = Union[str, Sequence[str]]
Numbers = Union[Mapping[str, float], Sequence[str]]
Report = Union[Progress, bool, None]

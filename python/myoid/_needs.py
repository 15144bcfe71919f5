"""What the module needs and does not find here."""

from __future__ import annotations

import importlib.util
import platform
import re
import sys
from pathlib import Path


def check_packages() -> None:
    """Raises ModuleNotFoundError without NumPy, which `pip install --no-deps` leaves out."""
    if importlib.util.find_spec("numpy") is None:
        remedy = "pip install numpy (Debian: python3-numpy)"
        raise ModuleNotFoundError(f"myoid needs the package numpy: {remedy}", name="numpy")


def why_not(error: ImportError) -> str:
    """Why the library behind the module cannot be loaded: what it needs, what is here, and what works all the same."""
    names = " ".join(file.name for file in Path(__file__).parent.glob("_native*"))
    pythons = sorted(map(int, re.findall(r"cpython-3(\d+)", names)))
    made = " or ".join(f"3.{minor}" for minor in pythons) or "none"
    here = f"Python {sys.version_info[0]}.{sys.version_info[1]}, {' '.join(platform.libc_ver())}"
    return (
        f"the library of this package cannot be loaded ({error}). It is made for Python {made}; this is {here}. "
        "The program works without it: the command myoid beside this Python."
    )

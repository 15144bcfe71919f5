"""The errors of the library. Each class stands for one class of the C++ library."""

from __future__ import annotations

import errno

__all__ = ["Error", "InvalidInput", "ReadError", "MissingFileError", "ModelError", "InternalError", "MyoidWarning"]


class Error(Exception):
    """The root of all errors of Myoid."""


class InvalidInput(Error, ValueError):
    """The caller gave an unusable value, name, unit or file. The message says what was found, what was expected and
    how to mend it."""


class ReadError(InvalidInput):
    """A file cannot be read as its name says.

    Attributes:
        path: The file.
        line: The line, counted from 1; 0 for the file as a whole.
    """

    def __init__(self, message: str, path: str = "", line: int = 0) -> None:
        super().__init__(message)
        self.path = path
        self.line = line


class MissingFileError(ReadError, FileNotFoundError):
    """A file or folder is not there. `path` and `filename` name it; it is a FileNotFoundError, too."""

    def __init__(self, message: str, path: str = "", line: int = 0) -> None:
        super().__init__(message, path, line)
        self.errno = errno.ENOENT
        self.filename = path

    def __str__(self) -> str:
        return str(self.args[0])

    def __reduce__(self) -> tuple[type, tuple[str, str, int]]:
        return type(self), (str(self), self.path, self.line)


class ModelError(InvalidInput):
    """A model is inconsistent, or needs something that is not supported."""


class InternalError(Error, RuntimeError):
    """A fault of the library itself. Please report it, with the call and, if you can, the files."""


class MyoidWarning(UserWarning):
    """A number of an input or a result may be wrong."""

"""Draws from the posterior of a run: the file posterior.csv."""

from __future__ import annotations

import csv
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, overload

from .errors import ReadError
from .series import Table, _array, _package

if TYPE_CHECKING:
    import pandas
    import xarray

    from .series import Array

__all__ = ["Draws"]


def _fault(path: str | Path, line: int, message: str) -> ReadError:
    return ReadError(f"{path}:{line}: {message}", str(path), line)


def _numbers(row: list[str], count: int, path: str | Path, line: int) -> list[float]:
    """The cells of a row."""
    try:
        numbers = [float(cell) for cell in row]
    except ValueError as error:
        raise _fault(path, line, str(error)) from None
    if len(numbers) != count:
        raise _fault(path, line, f"found {len(numbers)} cells, expected {count}; run the study again")
    return numbers


class Draws:
    """Joint draws of all unknowns of a fit. A row is one draw, in SI units.

    `draws["BIC.max_isometric_force"]` has the draws of one unknown. A function of the unknowns has the distribution of
    its values, each with its weight.

    Attributes:
        values: Draws x unknowns, the numbers of posterior.csv.
        names: Names of the unknowns, owner and parameter: "BIC.optimal_fiber_length". "BIC+BRA." stands for one number
            that two muscles share.
        units: Unit of each unknown: "N", "m", "s", "1" (without dimension), ...
        weights: Weight of each draw. Their sum is 1 but for the digits of the file.
    """

    def __init__(self, values: Array, names: list[str], units: list[str], weights: Array) -> None:
        self.values, self.names, self.units, self.weights = values, names, units, weights

    @classmethod
    def read(cls, path: str | Path, units: Mapping[str, str]) -> Draws:
        """Reads posterior.csv. `units`: the unit of each parameter, by its name without the owner.

        Raises:
            ReadError: The file is no table of numbers with a column `weight`, or has a parameter without a unit.
        """
        import numpy as np

        with open(path, encoding="utf-8", newline="") as file:
            rows = csv.reader(file)
            names: list[str] = next(rows, [])
            parameters = [name.rpartition(".")[2] for name in names[1:]]
            if names[:1] != ["weight"] or not set(parameters) <= set(units):
                raise _fault(path, 1, f"found {','.join(names)!r}, expected weight and the parameters of the run")
            numbers = [_numbers(row, len(names), path, rows.line_num) for row in rows]
            table = np.array(numbers, dtype=float).reshape(len(numbers), len(names))
        return cls(table[:, 1:], names[1:], [units[parameter] for parameter in parameters], table[:, 0])

    def __len__(self) -> int:
        return len(self.values)

    def __contains__(self, name: object) -> bool:
        return name in self.names

    @overload
    def __getitem__(self, key: str) -> Array: ...
    @overload
    def __getitem__(self, key: slice | Array) -> Draws: ...
    def __getitem__(self, key: Any) -> Any:
        """`draws["BIC.max_isometric_force"]`: the draws of one unknown, in its unit. `draws[:100]`: these draws."""
        if isinstance(key, str):
            return self.values[:, self._index(key)]
        if isinstance(key, int):
            raise TypeError("a number names no unknown; draws.values[3] is one draw, draws[3:4] are Draws of it")
        return Draws(self.values[key], self.names, self.units, self.weights[key])

    def _index(self, name: str) -> int:
        if name not in self.names:
            raise KeyError(f"there is no unknown {name!r}; there are {', '.join(self.names)}")
        return self.names.index(name)

    def __iter__(self) -> Iterator[str]:
        """The names of the unknowns."""
        return iter(self.names)

    def keys(self) -> list[str]:
        """The names of the unknowns."""
        return list(self.names)

    def items(self) -> Iterator[tuple[str, Array]]:
        """Each unknown's name and draws."""
        return ((name, self[name]) for name in self.names)

    def __array__(self, dtype: Any = None, copy: Any = None) -> Array:
        return _array(self.values, dtype, copy)

    def unit(self, name: str) -> str:
        """The unit of one unknown."""
        return self.units[self._index(name)]

    def equally_weighted(self) -> Array:
        """As many draws, of equal weight: the rows at equal steps of the sum of the weights. A draw of greater weight
        may stand twice. Draws x unknowns."""
        import numpy as np

        reached = np.cumsum(self.weights) / np.sum(self.weights)
        steps = (np.arange(len(self)) + 0.5) / len(self)
        rows: Array = self.values[np.minimum(np.searchsorted(reached, steps), len(self) - 1)]
        return rows

    def to_pandas(self) -> pandas.DataFrame:
        """A table with the index (`draw`, `weight`) and a column for each unknown; `attrs["units"]` has the units."""
        pandas = _package("pandas")
        index = pandas.MultiIndex.from_arrays([range(len(self)), self.weights], names=["draw", "weight"])
        frame = pandas.DataFrame(self.values, index=index, columns=self.names)
        frame.attrs["units"] = dict(zip(self.names, self.units))
        return frame

    def to_xarray(self) -> xarray.DataArray:
        """An array `draw` x `parameter` with the coordinates `unit` (of the parameter) and `weight` (of the draw)."""
        array: xarray.DataArray = _package("xarray").DataArray(
            self.values,
            dims=("draw", "parameter"),
            coords={
                "draw": range(len(self)),
                "parameter": self.names,
                "unit": ("parameter", self.units),
                "weight": ("draw", self.weights),
            },
        )
        return array

    def to_inference_data(self) -> Any:
        """The draws as ArviZ's InferenceData (of ArviZ 1 a DataTree) with the group `posterior`: one chain, a variable
        for each unknown with its unit in `attrs["units"]`. ArviZ knows no weights: the draws are `equally_weighted`.

        Raises:
            ImportError: ArviZ or xarray is not installed.
        """
        arviz = _package("arviz", debian=False)
        draws = self.equally_weighted()
        dataset = _package("xarray").Dataset(
            {
                name: (("chain", "draw"), draws[None, :, i], {"units": self.units[i]})
                for i, name in enumerate(self.names)
            },
            coords={"chain": [0], "draw": range(len(self))},
        )
        if hasattr(arviz, "convert_to_datatree"):
            return arviz.convert_to_datatree(dataset, group="posterior")
        return arviz.convert_to_inference_data(dataset, group="posterior")

    def _repr_html_(self) -> str:
        """For notebooks: mean and standard deviation of each unknown, with the weights."""
        import numpy as np

        share = self.weights / np.sum(self.weights)
        mean = share @ self.values
        sd = np.sqrt(np.maximum(share @ (self.values - mean) ** 2, 0.0))
        rows = [{"unknown": name, "unit": self.units[i], "mean": float(mean[i]), "standard deviation": float(sd[i])}
                for i, name in enumerate(self.names)]  # fmt: skip
        return f"<p>{len(self)} draws</p>{Table(rows)._repr_html_()}"

    def __repr__(self) -> str:
        names = ", ".join(f"{n} [{u}]" for n, u in list(zip(self.names, self.units))[:4])
        more = f", and {len(self.names) - 4} more" if len(self.names) > 4 else ""
        return f"Draws({len(self)} draws: {names}{more})"

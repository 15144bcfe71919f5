"""Results of runs: the folder that `run` and `identify` write, and what stands in it."""

from __future__ import annotations

import html
import json
import os
import shutil
import tempfile
import zlib
from collections.abc import Mapping
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .draws import Draws
from .errors import InvalidInput, MissingFileError
from .series import Table, TimeSeries, in_radians

if TYPE_CHECKING:
    import pandas
    import xarray

__all__ = ["Result", "Trial", "PredictResult", "TwinStudyResult"]

VERDICT_COLORS = {
    "identified": "#2a7",
    "reproducible": "#7a3c8f",
    "weak": "#c90",
    "prior_dominated": "#888",
    "not_identifiable": "#bbb",
    "non_physical": "#c33",
}


class _Folder:
    """A folder of results. Where the user named none, a temporary one that goes with the object."""

    def __init__(self, folder: str | os.PathLike[str] | None) -> None:
        self._temporary = tempfile.TemporaryDirectory(prefix="myoid.") if folder is None else None
        self.path = Path(self._temporary.name if self._temporary else os.fspath(folder or ""))

    def remove(self) -> None:
        """Removes a temporary folder at once."""
        if self._temporary is not None:
            self._temporary.cleanup()

    def __getstate__(self) -> dict[str, Any]:
        """A pickle carries the files of a temporary folder, and the tables of a folder that the user named."""
        kept = (lambda file: True) if self._temporary else _is_table
        files = {
            file.relative_to(self.path).as_posix(): zlib.compress(file.read_bytes())
            for file in sorted(self.path.rglob("*"))
            if file.is_file() and not any(part.startswith(".") for part in file.relative_to(self.path).parts)
            and kept(file.relative_to(self.path))
        }
        return {"path": None if self._temporary else os.fspath(self.path.absolute()), "files": files}

    def __setstate__(self, state: dict[str, Any]) -> None:
        """The named folder is opened where it is there; otherwise the files come to a temporary folder."""
        there = state["path"] is not None and Path(state["path"]).is_dir()
        self.__init__(state["path"] if there else None)  # type: ignore[misc]
        if there:
            return
        for name, content in state["files"].items():
            (self.path / name).parent.mkdir(parents=True, exist_ok=True)
            (self.path / name).write_bytes(zlib.decompress(content))


def _is_table(file: Path) -> bool:
    return file.suffix == ".csv" or file.as_posix() in ("run.json", "parameters.json", "report.json")


class Trial(Mapping[str, TimeSeries]):
    """The series of one trial by the names of their files: `trial["ik"]`, `trial["id"]`, `trial["activation"]`,
    `trial["identified_forces"]`, `trial["StaticOptimization_force"]`, ...

    Attributes:
        name: Name of the trial.
        use: "identify", "validate", ...
        failure: Why the trial failed; empty where it did not.
    """

    def __init__(self, folder: Path, name: str, use: str = "", failure: str = "") -> None:
        self.folder, self.name, self.use, self.failure = folder, name, use, failure
        self._carried: dict[str, TimeSeries] = {}

    def __getstate__(self) -> dict[str, Any]:
        """A pickle carries the series."""
        state = {k: v for k, v in self.__dict__.items() if k != "_files"}
        return {**state, "_carried": dict(self)}

    @cached_property
    def _files(self) -> dict[str, Path]:
        found = {p.stem: p for p in sorted(self.folder.glob("*")) if p.suffix in (".sto", ".mot")}
        return found or {name: self.folder / name for name in self._carried}

    def __getitem__(self, name: str) -> TimeSeries:
        """One series in SI units: angles in radians."""
        from ._native import read_result

        if name not in self._files:
            raise KeyError(f"trial {self.name!r} has no series {name!r}; there are {', '.join(self._files)}")
        if name in self._carried:
            return self._carried[name]
        return in_radians(read_result(os.fspath(self._files[name])))

    def __iter__(self) -> Any:
        return iter(self._files)

    def __len__(self) -> int:
        return len(self._files)

    def __repr__(self) -> str:
        return f"Trial({self.name!r}: {', '.join(self._files)})"


def series_of(trials: Mapping[str, Trial]) -> dict[str, dict[str, xarray.DataArray]]:
    """All series of trials by trial and name."""
    return {name: {series: trial[series].to_xarray() for series in trial} for name, trial in trials.items()}


class Result:
    """The results of a run: everything is read from the files of its folder, when it is asked for.

    `Result(folder)` opens the folder of a finished run.

    Attributes:
        path: The folder.
        remarks: The remarks of this call; empty for a folder that was opened.
    """

    def __init__(self, folder: str | os.PathLike[str], found: Mapping[str, Any] | None = None) -> None:
        self._hold(_Folder(folder), found)

    @classmethod
    def _of(cls, folder: _Folder, found: Mapping[str, Any]) -> Result:
        result = cls.__new__(cls)
        result._hold(folder, found)
        return result

    def __getstate__(self) -> dict[str, Any]:
        return {"folder": self._folder, "found": self.found}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self._hold(state["folder"], state["found"])

    def _hold(self, folder: _Folder, found: Mapping[str, Any] | None) -> None:
        self._folder = folder
        self.path = folder.path
        self.found = dict(found or {})
        self.remarks = list(self.found.get("remarks", []))
        if not self.path.is_dir():
            raise MissingFileError(f"{self.path}: there is no such folder; give that of a finished run", str(self.path))
        if not (self.path / "parameters.csv").is_file():
            raise InvalidInput(f"{self.path} holds no parameters.csv; give the folder of a finished run")

    def __fspath__(self) -> str:
        """The folder: a result stands wherever the path of a run does."""
        return os.fspath(self.path)

    @cached_property
    def parameters(self) -> Table:
        """The table of parameters.csv: a row for each muscle, parameter, method and case, with `estimate`, `ci_low`,
        `ci_high` (95 %), `verdict` and `reason`, in the unit of the column `unit`."""
        return Table.read(self.path / "parameters.csv")

    @cached_property
    def gates(self) -> list[dict[str, str]] | None:
        """The quality gates, a dict each: name, status ("pass", "warn", "fail" or "info"), value, threshold, why; None
        where neither the call nor report.json has them."""
        if "gates" in self.found:
            return list(self.found["gates"])
        file = self.path / "report.json"
        if not file.is_file():
            return None
        gates: list[dict[str, str]] | None = json.loads(file.read_text(encoding="utf-8")).get("gates")
        return gates

    @cached_property
    def run(self) -> dict[str, Any]:
        """run.json: versions, inputs with their SHA-256, all settings, trials."""
        file = self.path / "run.json"
        if not file.is_file():
            raise InvalidInput(f"{self.path} holds no run.json; only `run` writes it")
        record: dict[str, Any] = json.loads(file.read_text(encoding="utf-8"))
        return record

    @cached_property
    def trials(self) -> dict[str, Trial]:
        """The trials by name, with their series."""
        return {
            t["name"]: Trial(self.path / t.get("folder", t["name"]), t["name"], t.get("use", ""), t.get("failure", "") or "")
            for t in self.run["trials"]
        }

    @cached_property
    def tables(self) -> dict[str, Table]:
        """The tables of the report by the names of their files."""
        return {p.stem: Table.read(p) for p in sorted((self.path / "tables").glob("*.csv"))}

    @cached_property
    def draws(self) -> Draws:
        """Draws from the posterior (posterior.csv) of a fit that is not exact.

        Raises:
            InvalidInput: The run has no draws.
        """
        file = self.path / "posterior.csv"
        if not file.is_file():
            raise InvalidInput(f'{self.path} holds no posterior.csv: its fit is of data without noise, or of method paper alone')
        return Draws.read(file, dict(zip(self.parameters["parameter"], self.parameters["unit"])))

    def to_inference_data(self) -> Any:
        """The draws for ArviZ, see `Draws.to_inference_data`."""
        return self.draws.to_inference_data()

    def parameter(self, muscle: str, parameter: str, method: str = "torque") -> Mapping[str, Any]:
        """The row of one number, such as ("BIC", "max_isometric_force").

        Raises:
            KeyError: There is no such row, or there are several.
        """
        rows = self.parameters.where(muscle=muscle, parameter=parameter, method=method)
        if len(rows) != 1:
            raise KeyError(f"{len(rows)} rows have muscle={muscle!r}, parameter={parameter!r}, method={method!r}")
        row: Mapping[str, Any] = rows[0]
        return row

    def to_pandas(self) -> pandas.DataFrame:
        """`parameters` as a data frame."""
        return self.parameters.to_pandas()

    def to_xarray(self) -> dict[str, dict[str, xarray.DataArray]]:
        """All series by trial and name, `channel` x `time`."""
        return series_of(self.trials)

    @property
    def report(self) -> Path:
        """report.html"""
        return self.path / "report.html"

    @property
    def model(self) -> Path | None:
        """The identified model (.osim); None where there is none."""
        return next(iter(sorted(self.path.glob("*_identified.osim"))), None)

    def save(self, folder: str | os.PathLike[str]) -> Path:
        """Copies all files into a new folder."""
        return Path(shutil.copytree(self.path, folder, ignore=shutil.ignore_patterns(".myoid*", ".stages")))

    def __repr__(self) -> str:
        verdicts = [v for v, m in zip(self.parameters["verdict"], self.parameters["method"]) if m != "paper"]
        count = f"{verdicts.count('identified')} of {len(verdicts)} numbers identified, torques and powers among them"
        return f"Result({str(self.path)!r}: {count})"

    def _repr_html_(self) -> str:
        """For notebooks: the parameters with bars for their intervals. `report_html` shows the report."""
        return parameters_html(self.parameters)

    def report_html(self, height: int = 720) -> str:
        """The report as a frame that needs no server; empty where there is none. `height` [px]"""
        if not self.report.is_file():
            return ""
        text = html.escape(self.report.read_text(encoding="utf-8"), quote=True)
        return (
            f'<iframe srcdoc="{text}" style="width:100%;height:{height}px;border:1px solid #ccc" '
            'sandbox="allow-scripts allow-popups"></iframe>'
        )


def _bar(row: Mapping[str, Any]) -> str:
    """The interval of one number as a drawing from 0 to twice the starting value."""
    low, high, estimate, start = row["ci_low"], row["ci_high"], row["estimate"], row["initial"]
    if low is None or high is None or estimate is None or not start:
        return ""
    width = 160.0

    def x(value: float) -> float:
        return float(min(max(0.5 * value / start, 0.0), 1.0)) * width

    color = VERDICT_COLORS.get(row["verdict"], "#888")
    return (
        f'<svg width="{width:g}" height="14"><line x1="{x(start):.1f}" x2="{x(start):.1f}" y1="0" y2="14" '
        f'stroke="#ccc"/><line x1="{x(low):.1f}" x2="{x(high):.1f}" y1="7" y2="7" stroke="{color}" stroke-width="3"/>'
        f'<circle cx="{x(estimate):.1f}" cy="7" r="4" fill="{color}"/></svg>'
    )


def parameters_html(parameters: Table) -> str:
    """The table of parameters with a bar for each 95 % interval; the thin line is the starting value."""
    rows = []
    for row in parameters:
        if row["method"] == "paper":
            continue
        cells = [row["muscle"], f"{row['parameter']} [{row['unit']}]"]
        cells += ["" if row[c] is None else f"{row[c]:.4g}" for c in ("estimate", "ci_low", "ci_high")]
        text = "".join(f"<td>{html.escape(cell)}</td>" for cell in cells)
        rows.append(
            f"<tr>{text}<td>{_bar(row)}</td><td title=\"{html.escape(row['reason'] or '', quote=True)}\">"
            f"{html.escape(row['verdict'])}</td></tr>"
        )
    head = "".join(f"<th>{c}</th>" for c in ("muscle", "parameter", "estimate", "95 % low", "high", "", "verdict"))
    return f"<table><thead><tr>{head}</tr></thead><tbody>{''.join(rows)}</tbody></table>"


class PredictResult:
    """Torques and muscle forces of trials by the fit of a run, with 95 % bands.

    Attributes:
        trials: By name, with the series "predicted_torque_<joint>" (channels <joint>_measured, _predicted, _low, _high
            [N m]) and "predicted_forces" (each muscle, _low, _high [N]).
        remarks: Remarks of the call.
    """

    def __init__(self, folder: _Folder, found: Mapping[str, Any]) -> None:
        self._folder = folder
        self.remarks = found["remarks"]

    @property
    def path(self) -> Path:
        """The folder of the files."""
        return self._folder.path

    @property
    def trials(self) -> dict[str, Trial]:
        """The trials by name."""
        made = json.loads((self.path / "predictions.json").read_text(encoding="utf-8"))
        return {t["trial"]: Trial(self.path / t["folder"], t["trial"]) for t in made["trials"]}

    @cached_property
    def scores(self) -> Table:
        """A row for each trial and joint: samples, rmse_nm [N m], r2, the same below the fit's cut-off (band_rmse_nm,
        band_r2), and `covered`, the share of the samples within the band."""
        return Table.read(self.path / "predictions.csv")

    def to_pandas(self) -> pandas.DataFrame:
        """`scores` as a data frame."""
        return self.scores.to_pandas()

    def to_xarray(self) -> dict[str, dict[str, xarray.DataArray]]:
        """All series by trial and name, `channel` x `time`."""
        return series_of(self.trials)

    def _repr_html_(self) -> str:
        return self.scores._repr_html_()

    def __repr__(self) -> str:
        return f"PredictResult({', '.join(self.trials)})"


class TwinStudyResult:
    """Errors of the method over virtual persons.

    Attributes:
        level: "L0", "L1" or "L2".
        finished: Number of persons that were finished.
        failures: Seed and message of each person who failed.
        remarks: Remarks of the call.
    """

    def __init__(self, folder: _Folder, found: Mapping[str, Any]) -> None:
        self._folder = folder
        self.level: str = found["level"]
        self.finished: int = found["finished"]
        self.failures: list[tuple[int, str]] = found["failures"]
        self.remarks = found["remarks"]

    @property
    def path(self) -> Path:
        """The folder of the files."""
        return self._folder.path

    @cached_property
    def summary(self) -> Table:
        """Errors, coverage and verdicts by method, case, muscle and parameter."""
        return Table.read(self.path / "summary.csv")

    @cached_property
    def persons(self) -> Table:
        """Every estimate of every person beside its truth."""
        return Table.read(self.path / "persons.csv")

    @cached_property
    def predictions(self) -> Table:
        """Predictions of the trials that were held back."""
        return Table.read(self.path / "predictions.csv")

    def _repr_html_(self) -> str:
        return self.summary._repr_html_()

    def __repr__(self) -> str:
        return f"TwinStudyResult({self.finished} persons, level {self.level}, {len(self.failures)} failures)"

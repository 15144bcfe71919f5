"""The commands about studies and persons: run, check, compare, design, virtual persons, cohorts."""

from __future__ import annotations

import json
import os
import warnings
from collections.abc import Iterator
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from . import _native
from ._call import call
from ._options import File, Input, Inputs, Report, Texts
from ._shown import Shown
from ._speech import speaking
from .errors import InvalidInput, MyoidWarning
from .remarks import Remark
from .results import PredictResult, Result, TwinStudyResult, _Folder
from .series import Table

__all__ = [
    "run", "identify", "predict", "CheckResult", "check", "CompareResult", "compare", "ReviewResult", "review",
    "DesignResult", "design", "TwinResult", "twin", "twin_study", "CohortResult", "cohort", "report", "InitResult",
    "init", "settings",
]  # fmt: skip


def run(study: File, *, out: File | None = None, mat: File | None = None, method: Texts | None = None,
        export: Texts | None = None, video: Texts | None = None, video_offset: float | None = None,
        threads: int | None = None, seed: int | None = None, start: float | None = None, end: float | None = None,
        overwrite: bool = False, progress: Report = None) -> Result:  # fmt: skip
    """The whole pipeline, from a study's recordings to muscle parameters with their uncertainty.

    Args:
        study: study.toml
        out: Folder of the results; None: a temporary folder that lives as long as the result (`Result.save` copies it).
        mat: Parameters, series, remarks and draws also as one MATLAB file, which ends in .mat.
        method: "torque", "force", "paper"; several, in place of the study's.
        export: Muscles for other programs: "ceinms", "ceinms-rt", "osimx"; several.
        video: Films that the report shows beside the model, each "TRIAL=FILE".
        video_offset: When these films begin, in seconds of the motion.
    """
    options = locals()
    folder = _Folder(out)
    result = Result._of(folder, call("run", {**options, "out": folder.path}))
    for gate in result.gates or ():
        if gate["status"] == "fail":
            warnings.warn(f"quality gate failed: {gate['name']}: {gate['value']}", MyoidWarning, stacklevel=2)
    return result


def identify(*, from_: File | None = None, muscles: Input | None = None, activations: Inputs | None = None,
             lengths: Inputs | None = None, velocities: Inputs | None = None, forces: Inputs | None = None,
             moment_arms: Inputs | None = None, torques: Inputs | None = None,
             fascicles: Inputs | None = None, coordinate: Texts | None = None, motion: Inputs | None = None,
             lowpass: float | None = None,
             method: str | None = None, delay: float | None = None, lag: str | None = None,
             free: Texts | None = None, hold: Texts | None = None, beliefs: File | None = None,
             posterior_draws: int | None = None, compare_solvers: bool = False, starts: int | None = None,
             folds: str | None = None, scales: str | None = None, validate: Texts | None = None,
             export: Texts | None = None, out: File | None = None, mat: File | None = None,
             threads: int | None = None, seed: int | None = None, start: float | None = None,
             end: float | None = None, overwrite: bool = False, progress: Report = None) -> Result:  # fmt: skip
    """Muscle parameters straight from files, where the earlier stages are done elsewhere.

    Args:
        from_: Project of CEINMS, CEINMS-RT or NMSM, in place of muscles.csv and all files.
        muscles: muscles.csv, the muscles and their starting values, SI.
        activations: Activations, 0 to 1, in columns by muscle; one file per trial.
        lengths: Musculotendon lengths [m]; one file per trial.
        velocities: Their rates [m/s], lengthening positive; None: by the quintic spline through the lengths.
        forces: Muscle forces [N]; `paper` and `force` need them.
        moment_arms: r = -dl/dq [m]; a file for each coordinate of each trial; `torque` needs them.
        torques: The torque that the muscles provide together [N m]; `torque` needs them.
        fascicles: Measured lengths of fascicles, in columns by muscle ("TA [mm]"); one per trial, "none" for a trial
            without.
        coordinate: Columns of the torque file; None: the only one.
        motion: Joint angles, for the stiffness and viscosity of the joint itself.
        lowpass: The angles are smoothed, -3 dB here [Hz].
        method: "torque" (default), "force" or "paper".
        delay: The EMG delay is held at this [s].
        lag: "automatic", "delay" or "shared".
        free: Further parameters to identify, beside those of every fit.
        hold: Parameters that are known, such as "emg_exponent" and "emg_gain" for activations without error.
        beliefs: File with a table [beliefs], such as a study.toml; None: the usual beliefs.
        posterior_draws: Draws by Hamiltonian Monte Carlo, in place of an approximation; 0: none.
        compare_solvers: Also writes solvers.csv.
        starts: Method "paper": starts of the search.
        folds: The part that is left out and predicted: "trial", "block" or "none".
        scales: "electrode": muscles that share an electrode share one scale of every parameter; "muscle": each its own.
        validate: Trials that are not fitted but predicted, each by its number or its file of lengths.
        export: Muscles for other programs: "ceinms", "ceinms-rt", "osimx"; several.
        out: Folder of the results; None: a temporary folder.
        mat: Parameters, series and draws also as one MATLAB file, which ends in .mat.
    """
    if from_ is None and (muscles is None or activations is None or lengths is None):
        raise TypeError("identify() needs muscles, activations and lengths, or from_")
    options = locals()
    folder = _Folder(out)
    return Result._of(folder, call("identify", {**options, "out": folder.path}))


def predict(folder: File | Result, *, study: File | None = None, trials: Texts | None = None, out: File | None = None,
            threads: int | None = None, start: float | None = None, end: float | None = None, overwrite: bool = False,
            progress: Report = None) -> PredictResult:  # fmt: skip
    """Torque and muscle forces, with 95 % bands, of trials that took no part in the fit of a run.

    Args:
        folder: Folder of a run with method "torque", or its result.
        study: Another study of the same person and muscles, with the trials; None: the study of the run.
        trials: Names of the trials; None: all that took no part in the fit.
        out: Folder of the predictions; None: a temporary folder that lives as long as the result.
    """
    options = locals()
    place = _Folder(out)
    return PredictResult(place, call("predict", {**options, "out": place.path}))


@dataclass(eq=False)
class CheckResult:
    """Faults of the inputs.

    Attributes:
        findings: Worst first.
        of_study: True for a study, False for a single recording.
        trials, muscles: Of the study.
        errors: Number of findings because of which `run` refuses the study.
    """

    findings: list[Remark]
    of_study: bool
    trials: int
    muscles: int
    errors: int

    def __iter__(self) -> Iterator[Remark]:
        return iter(self.findings)

    def __len__(self) -> int:
        return len(self.findings)

    def __getitem__(self, at: int) -> Remark:
        return self.findings[at]

    def __repr__(self) -> str:
        return f"CheckResult({self.errors} errors, {len(self.findings)} findings)"

    def _repr_html_(self) -> str:
        """For notebooks: a row for each finding."""
        columns = ["severity", "where", "about", "text"]
        return Table([{c: getattr(finding, c) for c in columns} for finding in self.findings], columns)._repr_html_()

    def __bool__(self) -> bool:
        """True if `run` takes the study."""
        return self.errors == 0


def check(study: File, *, model: File | None = None, up: str | None = None, start: float | None = None,
          end: float | None = None, progress: Report = None) -> CheckResult:  # fmt: skip
    """Reads every input of a study, a single recording or motion, or a model, and lists its faults; computes nothing.

    Args:
        study: study.toml, a recording, or a model (.osim).
        model: Model of a motion (.mot, .sto), a file or "arm4"; None: unknown.
        up: Vertical of a recording's laboratory: "x", "-y", ...; None: as the file says.
    """
    return CheckResult(**call("check", locals()))


@dataclass(eq=False, repr=False)
class CompareResult(Shown):
    """Two runs, number by number.

    Attributes:
        parameters: A row for each number: first, second, difference, smallest_detectable, p_alone, p_value, tested,
            change.
        unlike: Model, person and muscles that differ.
        notes: Numbers that only one of the runs has.
    """

    parameters: Table
    unlike: list[str]
    notes: list[str]
    remarks: list[Remark] = field(default_factory=list)


def compare(first: File | Result, second: File | Result, *, out: File | None = None, overwrite: bool = False,
            progress: Report = None) -> CompareResult:  # fmt: skip
    """Two finished runs: which parameters differ by more than chance, which do not, and which cannot be told.

    Args:
        first, second: Folders of runs, or their results.
        out: Folder for report.html, figures and tables.
    """
    found = call("compare", locals())
    found["parameters"] = Table(found["parameters"])
    return CompareResult(**found)


@dataclass(eq=False, repr=False)
class ReviewResult(Shown):
    """A second opinion on a calibration of another program.

    Attributes:
        torques: A row for each joint and trial: R2 and error of the calibrated subject by its own law, and of a fit of
            the same files without this trial.
        numbers: A row for each number of the muscles: start, calibrated, estimate with 95 % interval, verdict, and
            standing: agrees, differs, untold.
        strengths: A row for each joint and direction: strength, and the part of muscles without EMG [N m].
        says: What the review finds, in sentences.
    """

    torques: Table
    numbers: Table
    strengths: Table
    says: list[str]
    remarks: list[Remark] = field(default_factory=list)


def review(project: File, *, out: File, joint: Texts | None = None, overwrite: bool = False,
           seed: int | None = None, start: float | None = None, end: float | None = None,
           threads: int | None = None, progress: Report = None) -> ReviewResult:  # fmt: skip
    """A second opinion on a calibration by CEINMS, CEINMS-RT or NMSM, from the project's own files.

    Args:
        project: Folder, set-up or subject of the project. Nothing is written into it.
        out: Folder for report.html, tables, figures and study.toml.
        joint: Joints to judge; default: those of the calibration.
    """
    found = call("review", locals())
    for name in ("torques", "numbers", "strengths"):
        found[name] = Table(found[name])
    return ReviewResult(**found)


@dataclass(eq=False, repr=False)
class DesignResult(Shown):
    """Movements to record next.

    Attributes:
        plan: A row for each movement: movement, duration_s, rest_before_s, fatigued_share.
        expected: For each movement a table of the intervals that are expected after it.
        beforehand: The intervals before the first movement.
        catalogue_size: Number of movements that were considered.
    """

    plan: Table
    expected: list[Table]
    beforehand: Table
    catalogue_size: int
    remarks: list[Remark] = field(default_factory=list)


def design(study: File | None = None, *, model: str | None = None, wire: bool = False, targets: Texts | None = None,
           after: File | None = None, criterion: str | None = None,
           movements: int | None = None, repeat: int | None = None, budget: float | None = None,
           fatigue: float | None = None, masses: Sequence[float] | float | None = None,
           no_dynamometer: bool = False, persons: int | None = None, torque_noise: float | None = None,
           emg_noise: float | None = None, threads: int | None = None, seed: int | None = None,
           progress: Report = None) -> DesignResult:  # fmt: skip
    """Which movements to record so that the targets become identifiable.

    Args:
        study: study.toml; or `model`.
        model: The built-in arm: "arm4".
        wire: With arm4: the brachialis has a wire electrode of its own.
        targets: "all", parameters, muscles or MUSCLE.PARAMETER.
        after: Folder of a finished run, whose result is known beforehand.
        criterion: "D" (volume of the confidence ellipsoid) or "A" (sum of relative variances).
        movements: How many to choose.
        repeat: The same movement at most so often.
        budget: Recording time at most [s].
        fatigue: Share of a muscle that may be fatigued.
        masses: Held masses there are [kg].
        no_dynamometer: No isokinetic movement.
        persons: Persons drawn from the priors.
        torque_noise: Standard deviation of the torque's error below 2 Hz [N m].
        emg_noise: Relative noise of the EMG envelope below 2 Hz.
    """
    found = call("design", locals())
    for name in ("plan", "beforehand"):
        found[name] = Table(found[name])
    found["expected"] = [Table(rows) for rows in found["expected"]]
    return DesignResult(**found)


@dataclass(eq=False, repr=False)
class TwinResult(Shown):
    """Virtual recordings with known parameters.

    Attributes:
        studies: study.toml of each person; none with `truth_only`.
        truth: The true values: truth.csv of one person, persons.csv of several.
    """

    studies: list[Path]
    truth: Table

    @property
    def study(self) -> Path:
        """The study of the first person."""
        return self.studies[0]


def twin(*, protocol: File, out: File, model: str | None = None, level: str | None = None,
         truth: Mapping[str, Any] | Texts | None = None, subjects: int | None = None, format: str | None = None,
         truth_only: bool = False, threads: int | None = None, seed: int | None = None, overwrite: bool = False,
         progress: Report = None) -> TwinResult:  # fmt: skip
    """A virtual recording whose truth is known: markers, raw EMG, model, study.toml, truth.csv.

    Args:
        protocol: Protocol of the recording (.toml).
        out: Folder for the recording.
        model: "arm4" (default) or "arm7" (seven heads, level L2).
        level: "L0" exact, "L1" noise, "L2" another truth than the model; None: as the protocol says.
        truth: Keys of [truth] in place of the protocol's.
        subjects: So many persons, seeds counting up, a folder each.
        format: "trc" (default) or "c3d".
        truth_only: With `subjects`: persons.csv only.
    """
    found = call("twin", locals())
    return TwinResult([Path(study) for study in found["studies"]], Table.read(found["table"]))


def twin_study(*, protocol: File, level: str | None = None, offset: float | None = None,
               truth: Mapping[str, Any] | Texts | None = None, subjects: int | None = None,
               method: Texts | None = None, out: File | None = None,
               threads: int | None = None, seed: int | None = None, overwrite: bool = False,
               progress: Report = None) -> TwinStudyResult:  # fmt: skip
    """How good is the method? Many virtual persons, the whole chain, compared with the truth.

    Args:
        protocol: Protocol of the recording (.toml).
        level: "L0", "L1" or "L2"; None: as the protocol says.
        offset: Mean of the persons away from the priors', in standard deviations.
        truth: Keys of [truth] in place of the protocol's.
        subjects: Virtual persons (default 200).
        method: "torque" (default), "force", "paper"; several.
        out: Folder of the tables; None: a temporary folder.
    """
    options = locals()
    folder = _Folder(out)
    return TwinStudyResult(folder, call("twin_study", {**options, "out": folder.path}))


@dataclass(eq=False, repr=False)
class CohortResult(Shown):
    """Many persons side by side.

    Attributes:
        path: Folder of the cohort.
        persons: A row for each person: person, outcome ("done", "gate_failed", "trials_failed", "failed", "not
            computed"), message, and reused, where the results of an earlier call stand.
        start: The command that starts the engine of `workflow`; empty without one.
    """

    path: Path
    persons: Table
    start: str = ""

    @property
    def parameters(self) -> Table:
        """The parameters of all persons: cohort.csv."""
        return Table.read(self.path / "cohort.csv")

    @property
    def report(self) -> Path:
        """The page of the group."""
        return self.path / "report.html"

    @property
    def results(self) -> dict[str, Result]:
        """The results of each computed person, by the person's folder."""
        folders = sorted(file.parent for file in (self.path / "persons").glob("*/parameters.csv"))
        return {folder.name: Result(folder) for folder in folders}


def cohort(manifest: File, *, out: File, study: File | None = None, person: Texts | None = None, group: bool = False,
           session_label: Texts | None = None, task_label: Texts | None = None, bids_filter_file: File | None = None,
           workflow: str | None = None, keep: str | None = None, work_dir: File | None = None, jobs: int | None = None,
           threads: int | None = None, start: float | None = None, end: float | None = None, overwrite: bool = False,
           progress: Report = None) -> CohortResult:  # fmt: skip
    """Many persons: a run for each, then all results side by side.

    Args:
        manifest: Table with the columns name and study, or the folder of a BIDS data set.
        out: Folder of the results.
        study: BIDS: the study of every person; None: code/study.toml.
        person: Only these persons, without the group; several.
        group: Only the tables and the page of all persons.
        session_label, task_label: BIDS: only trials of these sessions and tasks, by the names of their files.
        bids_filter_file: BIDS: the same as a file (.json).
        workflow: Writes the files for an engine and computes nothing: "snakemake", "slurm", "parallel".
        keep: Files of each person: "tables", "page" (default) or "all".
        work_dir: Folder for the stages of persons under way.
        jobs: Persons at a time; None: as many as threads.
    """
    found = call("cohort", locals())
    return CohortResult(Path(out), Table(found["persons"], ["person", "outcome", "message", "reused"]), found["start"])


def report(folder: File | None = None, *, video: Texts | None = None, video_offset: float | None = None,
           export: Texts | None = None, group: Sequence[File] | None = None, after: Sequence[File] | None = None,
           out: File | None = None, mat: File | None = None, threads: int | None = None, overwrite: bool = False,
           progress: Report = None) -> Path:  # fmt: skip
    """The report of a finished run, made again from its recordings; or one page of many runs. Returns report.html.

    Args:
        folder: Folder of a run, or its result.
        video: Films that the report shows beside the model, each "TRIAL=FILE".
        video_offset: When these films begin, in seconds of the motion.
        export: Muscles for other programs: "ceinms", "ceinms-rt", "osimx"; several.
        group: In place of `folder`: the runs, their results, or folders that hold runs.
        after: The second sessions of the persons of `group`, in the same order.
        out: Folder of the page of `group` (default "group").
        mat: Parameters, series, remarks and draws of the run also as one MATLAB file.
    """
    return Path(call("report", locals())["file"])


@dataclass(eq=False, repr=False)
class InitResult(Shown):
    """A draft of a study.

    Attributes:
        study: The file study.toml.
        todo: Questions that the draft leaves open.
    """

    study: Path
    todo: list[str]
    remarks: list[Remark] = field(default_factory=list)


def init(dir: File, study: File | None = None, *, from_: Texts | File | Sequence[File] | None = None, model: File | None = None,
         coordinate: str | None = None, overwrite: bool = False, progress: Report = None) -> InitResult:  # fmt: skip
    """A commented study.toml to start from: finds recordings, and pairs EMG channels with muscles.

    Args:
        dir: Folder for study.toml, or the file itself (.toml).
        study: The file; None: study.toml in `dir`.
        from_: Recordings, folders of them, or a project of CEINMS, CEINMS-RT or NMSM; None: the folder itself.
        model: OpenSim model (.osim); None: the only one in the folders, else "arm4".
        coordinate: The joint, by the model's coordinate; None: guessed.
    """
    found = call("init", locals())
    return InitResult(Path(found["file"]), found["todo"], found["remarks"])


def settings(study: File | None = None, *, table: str | None = None) -> Any:
    """The settings of a study with all defaults, or the meaning of every setting of study.toml.

    Args:
        study: study.toml; None: the reference, a list of tables with `settings` (key, values, default, meaning).
        table: Only this table, such as "emg".
    """
    with speaking():
        found = json.loads(_native.settings(os.fspath(study) if study is not None else ""))
    if table is None:
        return found
    if study is not None:
        known = found
    else:
        known = {entry["table"].strip("[]"): entry for entry in found}
    if table not in known:
        raise InvalidInput(f"table: found {table!r}, expected {', '.join(known)}")
    return known[table]

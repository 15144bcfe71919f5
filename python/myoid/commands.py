"""The commands of the program as functions.

Arguments have the names of the command line, with "_" for "-", and SI units: angles are in radians. None stands for
the library's default. Files are written only where `out` names one.

An input is a file, or a value: a result of `read`, `read_series`, `Model` and `run`, a DataFrame of pandas (index
`time`), an array of xarray (`channel` x `time`, markers `axis` x `channel` x `time`), or a mapping of names to arrays
with the times as "time". The value states its units, by `attrs["units"]` in pandas and xarray; without them angles are
in radians, lengths in m, forces in N. Common arguments:

    start, end: First and last time that is used [s].
    threads: Number of threads; None: all cores. Results are the same for every number.
    seed: Seed of everything random (default 1).
    overwrite: Results that exist are replaced.
    progress: A function of the finished share (0..1) and the name of the work, called in the calling thread; None: a
        bar on stderr where that is a terminal; False: nothing.

Warnings are raised as `MyoidWarning` by the module `warnings`, notes go to the logger "myoid". Ctrl-C stops a call and
raises KeyboardInterrupt. All functions raise InvalidInput, ReadError and ModelError for bad input.
"""

from __future__ import annotations

import json
import math
import os
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Union

from . import _native
from ._call import Progress, call
from ._speech import speaking
from .errors import InvalidInput, MissingFileError, MyoidWarning
from .remarks import Remark
from .model import Model
from .results import PredictResult, Result, TwinStudyResult, _Folder
from .series import Table, TimeSeries

if TYPE_CHECKING:
    from .series import Array

__all__ = [
    "run", "identify", "predict", "check", "compare", "review", "design", "emg", "ik", "id", "paths", "sweep", "so",
    "muscle", "simulate", "twin", "twin_study", "run_tool", "scale", "info", "convert", "cohort", "report", "settings",
    "init",
    "CheckResult", "CohortResult", "InitResult", "CompareResult", "DesignResult", "EmgResult", "IkResult", "IdResult",
    "PathsResult", "SoResult",
    "SweepResult",
    "MuscleResult", "SimulateResult", "TwinResult", "ToolResult",
]  # fmt: skip

File = Union[str, "os.PathLike[str]"]
Input = Any  # a file, or a value: see above
Inputs = Any  # one or several
Texts = Union[str, Sequence[str]]
Numbers = Union[Mapping[str, float], Sequence[str]]
Report = Union[Progress, bool, None]


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
             coordinate: Texts | None = None, motion: Inputs | None = None, lowpass: float | None = None,
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


@dataclass(eq=False)
class CompareResult:
    """Two runs, number by number.

    Attributes:
        parameters: A row for each number: first, second, difference, smallest_detectable, p_value, change.
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


@dataclass(eq=False)
class ReviewResult:
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


@dataclass(eq=False)
class DesignResult:
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


@dataclass(eq=False)
class EmgResult:
    """Activations of each input.

    Attributes:
        activations: 0..1, of each input.
        envelopes: [V], of each input.
        normalisation: Of each channel: resting_level_v, reference_v, reference_from, reference_time_s, from_mvc.
        whitened, whitening_reason: Whether the spectra were evened out, and why.
        steps: The chain, step by step.
        methods: Sentences for a paper's methods section.
    """

    activations: list[TimeSeries]
    envelopes: list[TimeSeries]
    normalisation: Table
    whitened: bool
    whitening_reason: str
    steps: list[str]
    methods: list[str]
    remarks: list[Remark] = field(default_factory=list)


def emg(inputs: Inputs, *, rate: float | None = None, out: File | None = None, mvc: Inputs | None = None,
        channel: Texts | None = None, unit: str | None = None, highpass: float | None = None,
        lowpass: float | None = None, no_notch: bool = False,
        whitening: bool = False, no_whitening: bool = False, as_published: bool = False, window: float | None = None,
        envelope: File | None = None, remove_ecg: bool = False, measures: File | None = None,
        measure_window: float | None = None, start: float | None = None, end: float | None = None,
        overwrite: bool = False, progress: Report = None) -> EmgResult:  # fmt: skip
    """Raw EMG to activation: high-pass, rectify, low-pass, resting level, normalized to the largest effort.

    Args:
        inputs: Files with EMG, or arrays of samples x channels; each is normalized by the largest effort of all.
        rate: Samples in a second of arrays [Hz].
        out: Activation (.sto, .mot, .csv); of several inputs a folder.
        mvc: Maximal contractions to normalize by.
        channel: Only these; of an array the names of its channels.
        unit: Unit of the numbers where the file does not say: "V", "mV", "uV".
        highpass: [Hz] (default 20)
        lowpass: -3 dB of both passes [Hz] (default 6)
        no_notch: Leave mains hum in.
        whitening, no_whitening: Even out the spectrum of all channels, or of none; default: if the files allow it.
        as_published: As the source paper.
        window: Window of the mean that counts as 1 [s] (default 0.5).
        envelope: Also write the envelope [V] here.
        remove_ecg: Take the heart out of channels that hold it, as the trunk's do.
        measures: Write onset, end, root mean square and median frequency of every burst here (.csv).
        measure_window: With `measures` also those of successive windows this long [s].
    """
    found = call("emg", locals())
    found["normalisation"] = Table(found["normalisation"])
    return EmgResult(**found)


@dataclass(eq=False)
class IkResult:
    """Joint angles.

    Attributes:
        angles: All coordinates, in the order of the model [rad or m]. (Files have degrees.)
        marker_errors: total_squared_error [m^2], RMS, maximum and the distance of each marker [m].
        marker_error_rms: Over all frames [m].
        wrong_unit: The markers are not in the unit that their file says.
        frames_not_converged, frames_without_markers: Numbers of frames.
        not_converged: Runs of frames, from 1.
        undetermined: Coordinates that the markers leave open.
    """

    angles: TimeSeries
    marker_errors: TimeSeries
    marker_error_rms: float
    wrong_unit: bool
    frames_not_converged: int
    frames_without_markers: int
    not_converged: list[str]
    undetermined: list[str]
    remarks: list[Remark] = field(default_factory=list)


def ik(*, model: File, markers: Input, out: File | None = None, up: str | None = None, weight: Numbers | None = None,
       lock: Texts | None = None, unlock: Texts | None = None, compat: str | None = None, start: float | None = None,
       end: float | None = None, overwrite: bool = False, progress: Report = None) -> IkResult:  # fmt: skip
    """Inverse kinematics: markers to joint angles.

    Args:
        model: OpenSim model (.osim), or "arm4".
        markers: Markers (.trc, .c3d), or `Markers`.
        out: Joint angles (.mot); the marker errors go beside it.
        up: Vertical axis of the laboratory: "x", "-y", ...; None: as a .c3d file says, else as the model.
        weight: Weights by marker; 1 where not given.
        lock: Coordinates held at their default value.
        unlock: Coordinates freed although the model locks them.
        compat: "exact" (default) or "opensim".
    """
    return IkResult(**call("ik", locals()))


@dataclass(eq=False)
class IdResult:
    """Joint torques.

    Attributes:
        forces: A generalized force for each coordinate [N m or N].
    """

    forces: TimeSeries
    remarks: list[Remark] = field(default_factory=list)


def id(*, model: File, motion: Input, out: File | None = None, lowpass: float | None = None,
       speeds: Input | None = None, accelerations: Input | None = None, loads: File | None = None,
       held_mass: float | None = None, held_body: str | None = None, held_at: Sequence[float] | None = None,
       compat: str | None = None, threads: int | None = None, start: float | None = None, end: float | None = None,
       overwrite: bool = False, progress: Report = None) -> IdResult:  # fmt: skip
    """Inverse dynamics: joint angles to the generalized forces that they require.

    Args:
        model: OpenSim model (.osim), or "arm4".
        motion: Joint angles (.mot, .sto).
        out: Generalized forces (.sto, .mot, .csv).
        lowpass: Smooth the angles, -3 dB at this frequency [Hz].
        speeds, accelerations: Files in place of the motion's derivatives.
        loads: An <ExternalLoads> file (.xml) of OpenSim.
        held_mass: Mass held in the hand [kg].
        held_body: Body that holds it.
        held_at: Where on that body, x y z [m].
        compat: "exact" (default) or "opensim".
    """
    return IdResult(**call("id", locals()))


@dataclass(eq=False)
class PathsResult:
    """Muscles along a motion; channels are the muscles.

    Attributes:
        length: Musculotendon lengths [m].
        velocity: Their rates [m/s], lengthening positive.
        moment_arm: r = -dl/dq by coordinate [m].
    """

    length: TimeSeries
    velocity: TimeSeries
    moment_arm: dict[str, TimeSeries]
    remarks: list[Remark] = field(default_factory=list)


def paths(*, model: File, motion: Input, out: File | None = None, lowpass: float | None = None,
          surrogate: File | None = None, surrogate_tolerance: float | None = None, check_jumps: bool = False,
          compat: str | None = None, threads: int | None = None, start: float | None = None, end: float | None = None,
          overwrite: bool = False, progress: Report = None) -> PathsResult:  # fmt: skip
    """Musculotendon lengths, velocities and moment arms along a motion.

    Args:
        model: OpenSim model (.osim), or "arm4".
        motion: Joint angles (.mot, .sto).
        out: Folder for MuscleAnalysis_*.sto.
        lowpass: Smooth the angles, -3 dB at this frequency [Hz].
        surrogate: File of fitted polynomials (.json) in the place of paths.
        surrogate_tolerance: Greatest error of a length [mm] (default 0.2).
        check_jumps: Warn where a length or moment arm jumps.
        compat: "exact" (default) or "opensim".
    """
    return PathsResult(**call("paths", locals()))


@dataclass(eq=False)
class SweepResult:
    """Muscles over one coordinate, the others at their defaults; arrays by muscle.

    Attributes:
        coordinate: Its name.
        unit: Its unit: "rad" or "m".
        values: Of the coordinate, in this unit.
        moment_arm: r = -dl/dq [m].
        length: Musculotendon lengths [m].
        full_force, passive_force: Along the tendon at rest, fully active and without activation [N].
    """

    coordinate: str
    unit: str
    values: Array
    moment_arm: dict[str, Array]
    length: dict[str, Array]
    full_force: dict[str, Array]
    passive_force: dict[str, Array]
    remarks: list[Remark] = field(default_factory=list)


def _typed(model: File | None, coordinate: str, value: float) -> str:
    """A value of a coordinate [rad, m] as the command line has it: angles in degrees."""
    known = model if isinstance(model, Model) else Model(model or "arm4")
    if coordinate not in known.coordinates:
        raise InvalidInput(f"there is no coordinate {coordinate!r}; there are {', '.join(known.coordinates)}")
    return repr(float(value) * (180 / math.pi if known.coordinates[coordinate].unit == "rad" else 1.0))


def sweep(*, model: File, coordinate: str, over: Sequence[float] | None = None, muscle: Texts | None = None,
          out: File | None = None, compat: str | None = None, threads: int | None = None, overwrite: bool = False,
          progress: Report = None) -> SweepResult:  # fmt: skip
    """Moment arms, lengths and forces of muscles over one coordinate (`myoid paths --sweep`).

    Args:
        model: OpenSim model (.osim), or "arm4".
        coordinate: "elbow_flexion", over its range in the model.
        over: Another range: first and last value [rad, m].
        muscle: Only these muscles (default: all with a moment arm of 0.1 mm).
        out: Folder for sweep_<coordinate>.csv and .svg.
        compat: "exact" (default) or "opensim".
    """
    options = locals()
    if options.pop("over") is not None and over is not None:
        if len(over) != 2 or not over[0] < over[1]:
            raise InvalidInput(f"over: found {over}, expected the first and the last value, in this order")
        first, last = (_typed(model, coordinate, value) for value in over)
        options["coordinate"] = f"{coordinate}={first}:{last}"
    return SweepResult(**call("sweep", options))


@dataclass(eq=False)
class SoResult:
    """Shared muscle forces; channels are the muscles.

    Attributes:
        force: [N]
        activation: 0..1
        reserve: Torques of the reserves by coordinate [N m].
        status: Of each frame: "optimal", "reserve_used", ...
        kkt_residual: Largest violation of the optimality conditions in each frame, relative.
        frames_not_solved, frames_with_reserve: Numbers of frames.
    """

    force: TimeSeries
    activation: TimeSeries
    reserve: TimeSeries
    status: list[str]
    kkt_residual: Array
    frames_not_solved: int
    frames_with_reserve: int
    remarks: list[Remark] = field(default_factory=list)


def so(*, model: File, motion: Input, out: File | None = None, objective: str | None = None,
       exponent: float | None = None, emg: Input | None = None, emg_weight: float | None = None,
       reserve: float | None = None, coordinate: Texts | None = None, lowpass: float | None = None,
       loads: File | None = None, tendon: str | None = None, passive: bool = False, compat: str | None = None,
       threads: int | None = None, start: float | None = None, end: float | None = None, overwrite: bool = False,
       progress: Report = None) -> SoResult:  # fmt: skip
    """Static optimization: which muscle forces make the torques of a motion?

    Args:
        model: OpenSim model (.osim), or "arm4".
        motion: Joint angles (.mot, .sto).
        out: Folder for StaticOptimization_*.
        objective: "activation" (default), "force" or "stress".
        exponent: Of the sum, above 1 (default 2).
        emg: Measured activations by muscle name (.sto), to stay near.
        emg_weight: Weight of that term (default 1).
        reserve: Optimal torque of the reserve on every coordinate [N m] (default 1).
        coordinate: Coordinates whose torque the muscles balance.
        lowpass: Smooth the angles, -3 dB at this frequency [Hz].
        loads: An <ExternalLoads> file (.xml) of OpenSim.
        tendon: "rigid" (default) or "elastic".
        passive: The fibers' passive springs and dampers pull too.
        compat: "exact" (default) or "opensim".
    """
    return SoResult(**call("so", locals()))


@dataclass(eq=False)
class MuscleResult:
    """One muscle alone: the simulated experiment, or the fit.

    Attributes:
        name: Name of the muscle.
        finished: The integration got to the end, or the fit converged.
        message: One sentence.
        series: activation, lengths [m], velocities [m/s], pennation [rad], forces [N]; None for a fit.
        mean_absolute_error: From the measured force [N]; None without one.
        relative_error: The same as a share of the isometric force.
        estimates: Of a fit: parameter, unit, start, estimate, std_error (infinite
            unless `told`), at_bound, told.
        errors: Of a fit: recording, starting_values, fitted, predicted, as shares of the isometric force.
    """

    name: str
    finished: bool
    message: str
    series: TimeSeries | None = None
    mean_absolute_error: float | None = None
    relative_error: float | None = None
    estimates: Table | None = None
    errors: Table | None = None
    remarks: list[Remark] = field(default_factory=list)


def muscle(*, muscle: File, length: Inputs, column: str | None = None, scale: Sequence[float] | float | None = None,
           offset: float | None = None, activation: Inputs | None = None, excitation: Inputs | None = None,
           drive_column: str | None = None,
           initial_activation: float | str | None = None, measured: Inputs | None = None,
           measured_column: str | None = None, fit: Texts | None = None, isometric_force: float | None = None,
           tolerance: float | None = None, out: File | None = None, start: float | None = None,
           end: float | None = None, overwrite: bool = False, progress: Report = None) -> MuscleResult:  # fmt: skip
    """One muscle alone: which force does it make under an imposed length? With `fit`: which parameters?

    Args:
        muscle: The muscle (.toml).
        length: Length of fiber and tendon together over time [m] (.sto, .mot, .csv).
        column: Which column of it.
        scale, offset: Its numbers times `scale` plus `offset` are the length [m].
        activation, excitation: One of them: a number in 0..1, or a file, or one for each length.
        drive_column: Which column of these files.
        initial_activation: With `excitation`: a number, or "settled".
        measured: Measured force over time [N].
        measured_column: Which column of it.
        fit: Parameters to identify.
        isometric_force: Force that errors are related to [N].
        tolerance: Relative, of the integration.
        out: Series over time (.sto); of a fit the parameters (.csv).
    """
    found = call("muscle", locals())
    for name in ("estimates", "errors"):
        if name in found:
            found[name] = Table(found[name])
    return MuscleResult(**found)


@dataclass(eq=False)
class SimulateResult:
    """A simulated movement. Channels are coordinates or muscles.

    Attributes:
        finished: The simulation got to its end.
        message: One sentence.
        motion: NAME, NAME_speed, NAME_acceleration of each coordinate [rad or m, 1/s, 1/s^2].
        excitation, activation: 0..1
        length, velocity: Of fiber and tendon [m], [m/s].
        fiber_length, fiber_velocity, tendon_length: [m], [m/s], [m]
        fiber_force, tendon_force: [N]
        moment_arm: [m]
        torque: By source [N m].
        energy: Works and energies [J]; None unless asked for.
        sensitivities: Derivatives by parameters of the model: parameters, time, elbow_flexion, BIC_tendon_force, ...; or None.
    """

    finished: bool
    message: str
    motion: TimeSeries
    excitation: TimeSeries
    activation: TimeSeries
    length: TimeSeries
    velocity: TimeSeries
    fiber_length: TimeSeries
    fiber_velocity: TimeSeries
    tendon_length: TimeSeries
    fiber_force: TimeSeries
    tendon_force: TimeSeries
    moment_arm: TimeSeries
    torque: TimeSeries
    energy: TimeSeries | None
    sensitivities: dict[str, Any] | None
    remarks: list[Remark] = field(default_factory=list)


def simulate(*, model: File | None = None, out: File | None = None, excitations: Input | None = None,
             excite: Numbers | None = None, rest: float | None = None, tendon: str | None = None,
             curves: str | None = None, activation: str | None = None, initial: Mapping[str, float] | None = None,
             initial_speed: Mapping[str, float] | None = None, lock: Texts | None = None, horizontal: bool = False,
             held_mass: float | None = None, held_body: str | None = None, held_at: Sequence[float] | None = None,
             rate: float | None = None, tolerance: float | None = None, energy: bool = False,
             sensitivity: Texts | None = None, figures: bool = False, threads: int | None = None,
             start: float | None = None, end: float | None = None, overwrite: bool = False,
             progress: Report = None) -> SimulateResult:  # fmt: skip
    """Forward dynamics: excitations of the muscles to motion, forces and lengths.

    Args:
        model: OpenSim model (.osim), or "arm4" (default).
        out: Folder for the results.
        excitations: Excitation per muscle over time (.sto).
        excite: Instead: {"BIC": "0.1@0.2+0.3"}, or "MUSCLE=LEVEL", "...@START", "...@START+DURATION" [s].
        rest: Excitation where `excite` says nothing (default 0.01).
        tendon: "rigid", "equilibrium" (default) or "mass".
        curves: "file", "paper", "thelen", "de_groote" or "millard".
        activation: "two_lags", "thelen", "de_groote", "recursive" or "envelope".
        initial: Values at the start by coordinate [rad, m].
        initial_speed: Speeds at the start by coordinate [rad/s, m/s].
        lock: Coordinates that do not move.
        horizontal: arm4 without gravity.
        held_mass: Mass held in the hand [kg].
        held_body: Body that holds it.
        held_at: Where on that body, x y z [m].
        rate: Samples of the results [Hz] (default 200).
        tolerance: Relative local error (default 1e-8).
        energy: Also the work of every element.
        sensitivity: Also the derivatives by these parameters of the model.
        figures: Also a figure of the movement, in `out`.
    """
    options = locals()
    for name in ("initial", "initial_speed"):
        if options[name] is not None:
            options[name] = [f"{c}={_typed(model, c, value)}" for c, value in options[name].items()]
    return SimulateResult(**call("simulate", options))


@dataclass(eq=False)
class TwinResult:
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


@dataclass(eq=False)
class ToolResult:
    """What a tool of OpenSim did.

    Attributes:
        tool: "InverseKinematicsTool", "ScaleTool", ...
        summary: One line.
        files: Written, in order.
        frames, frames_failed: Numbers of frames.
        good: Every frame was solved.
        notes: Repairs and omissions.
    """

    tool: str
    summary: str
    files: list[Path]
    frames: int
    frames_failed: int
    good: bool
    notes: list[str]
    remarks: list[Remark] = field(default_factory=list)


def run_tool(setup: File, *, model: File | None = None, motion: File | None = None,
             external_loads: File | None = None, out: File | None = None, anywhere: bool = False,
             compat: str | None = None, threads: int | None = None,
             progress: Report = None) -> ToolResult:  # fmt: skip
    """Runs an OpenSim set-up file: inverse kinematics, inverse dynamics, analyses, scaling.

    Args:
        setup: Set-up file (.xml).
        model, motion, external_loads: Files in place of the set-up's.
        out: Folder of the results, in place of the set-up's.
        anywhere: Also write outside the folder of the set-up, where the set-up says so.
        compat: "opensim" (default) or "exact".
    """
    found = call("run_tool", locals())
    found["files"] = [Path(file) for file in found["files"]]
    return ToolResult(**found)


def scale(setup: File, *, model: File | None = None, motion: File | None = None, out: File | None = None,
          anywhere: bool = False, threads: int | None = None,
          progress: Report = None) -> ToolResult:  # fmt: skip
    """Scales a model by a set-up file of OpenSim's ScaleTool (`run_tool` for this one tool).

    Args:
        setup: Set-up file (.xml) with a ScaleTool.
        model: Generic model, in place of the set-up's.
        motion: Markers for placing the model's markers (.trc), in place of the set-up's.
        out: Folder of the results, in place of the set-up's.
        anywhere: As of `run_tool`.
    """
    options = locals()
    try:
        text = Path(setup).read_text(encoding="utf-8", errors="replace")
    except FileNotFoundError as error:
        raise MissingFileError(f"{setup}: there is no such file", os.fspath(setup)) from error
    except OSError as error:
        raise InvalidInput(f"{setup}: {error.strerror}") from error
    if "<ScaleTool" not in text:
        raise InvalidInput(f"{setup}: found no ScaleTool; run_tool runs the set-ups of other tools")
    found = call("run_tool", options)
    found["files"] = [Path(file) for file in found["files"]]
    return ToolResult(**found)


def info(file: File, *, compare_compat: bool = False, postures: int | None = None, jumps: bool = False,
         compat: str | None = None, threads: int | None = None, seed: int | None = None,
         progress: Report = None) -> dict[str, Any]:  # fmt: skip
    """What a file holds: channels, units, rates, duration, gaps, repairs; of a model also its unsupported elements.

    Args:
        file: A recording, table, model or study; or "arm4".
        compare_compat: Of a model: for which muscles exact paths differ from OpenSim's, over random postures.
        postures: Random postures for that.
        jumps: Of a model: where a length or moment arm jumps.
        compat: "exact" (default) or "opensim".
    """
    return call("info", locals())


def convert(source: Input, out: File, *, what: str | None = None, up: str | None = None, rotate: Texts | None = None,
            body: Texts | None = None, least_force: float | None = None, unit: str | None = None,
            channel: Texts | None = None, analog: File | None = None, rate: float | None = None,
            subject: str | None = None, compat: str | None = None, start: float | None = None,
            end: float | None = None, overwrite: bool = False, progress: Report = None) -> list[Path]:  # fmt: skip
    """Writes a recording in another format (C3D, TRC, STO/MOT, CSV), or an OpenSim file in the newest form. Returns the
    files.

    Args:
        source: A recording, an OpenSim file (.osim, .xml), or the folder of a finished run.
        out: .c3d, .trc, .sto, .mot, .csv, or a folder for everything in it; .osim, .xml of an OpenSim file; .mat of a
            storage file or of the folder of a run.
        what: "markers", "channels", "emg" or "plates".
        up: Vertical axis of the laboratory, turned to y.
        rotate: "AXIS:DEGREES", further turns.
        body: Bodies that stand on plates 1, 2, ...: writes ExternalLoads too.
        least_force: Below it a plate counts as unloaded [N] (default 10).
        unit: Unit of EMG where the file does not say.
        channel: Only these.
        analog: Channels to go with the markers of a .trc into a .c3d.
        rate: Everything on an even clock of this rate [Hz].
        subject: Label of the person in a BIDS derivative.
        compat: Of an OpenSim file: "exact" (default), or "opensim", which rounds offsets to six digits.
    """
    return [Path(file) for file in call("convert", locals())]


@dataclass(eq=False)
class CohortResult:
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

    def _repr_html_(self) -> str:
        return self.persons._repr_html_()


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


@dataclass(eq=False)
class InitResult:
    """A draft of a study.

    Attributes:
        study: The file study.toml.
        todo: Questions that the draft leaves open.
    """

    study: Path
    todo: list[str]
    remarks: list[Remark] = field(default_factory=list)


def init(dir: File, *, from_: Texts | File | Sequence[File] | None = None, model: File | None = None,
         coordinate: str | None = None, overwrite: bool = False, progress: Report = None) -> InitResult:  # fmt: skip
    """A commented study.toml to start from: finds recordings, and pairs EMG channels with muscles.

    Args:
        dir: Folder for study.toml.
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

"""The commands of single steps: EMG, inverse kinematics and dynamics, muscle paths, force sharing, simulation."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from ._call import call
from ._options import File, Input, Inputs, Numbers, Report, Texts
from ._shown import Shown
from .errors import InvalidInput
from .model import Model
from .remarks import Remark
from .series import Table, TimeSeries

if TYPE_CHECKING:
    from .series import Array

__all__ = [
    "EmgResult", "emg", "IkResult", "ik", "IdResult", "id", "PathsResult", "paths", "SweepResult", "sweep",
    "SoResult", "so", "MuscleResult", "muscle", "SimulateResult", "simulate",
]  # fmt: skip


@dataclass(eq=False, repr=False)
class EmgResult(Shown):
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


@dataclass(eq=False, repr=False)
class IkResult(Shown):
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


@dataclass(eq=False, repr=False)
class IdResult(Shown):
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


@dataclass(eq=False, repr=False)
class PathsResult(Shown):
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


@dataclass(eq=False, repr=False)
class SweepResult(Shown):
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


@dataclass(eq=False, repr=False)
class SoResult(Shown):
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


@dataclass(eq=False, repr=False)
class MuscleResult(Shown):
    """One muscle alone: the simulated experiment, or the fit.

    Attributes:
        name: Name of the muscle.
        finished: The integration got to the end, or the fit converged.
        message: One sentence.
        series: activation, lengths [m], velocities [m/s], pennation [rad], forces [N]; None for a fit.
        mean_absolute_error: From the measured force [N]; None without one.
        relative_error: The same as a share of the isometric force.
        estimates: Of a fit: parameter, unit, start, estimate, std_error (infinite unless `told`), at_bound, told,
            scatter among the recordings, ci_low and ci_high (95 %), verdict, reason.
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
           measured_column: str | None = None, fit: Texts | None = None, own: Texts | None = None,
           laws: Texts | None = None, fitted: File | None = None, isometric_force: float | None = None,
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
        own: Of these, those of which each recording has its own value around a common one.
        laws: Sets of laws to compare by their errors on left-out recordings: "all", or some.
        fitted: With `fit`, the file of the muscle with the estimates (.toml).
        isometric_force: Force that errors are related to [N].
        tolerance: Relative, of the integration.
        out: Series over time (.sto); of a fit the parameters (.csv).
    """
    found = call("muscle", locals())
    for name in ("estimates", "errors"):
        if name in found:
            found[name] = Table(found[name])
    return MuscleResult(**found)


@dataclass(eq=False, repr=False)
class SimulateResult(Shown):
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

"""Computes how far the gap shrinks on a record that the diagnosis has not seen. No Qt."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from rotemina.app.language import get_axis_label
from rotemina.app.motion.model import CommandMemory, ModelInUse
from rotemina.app.motion.playback import ComparedRun, compare_run_again
from rotemina.plugins.gap import tr
from rotemina.sim.comparison import GapFigure, find_moving_samples
from rotemina.sim.errors import GapError
from rotemina.sim.excitation import (
    DecayingTriangleExcitation,
    ExcitationKind,
    MultisineExcitation,
    StaircaseExcitation,
    excite,
)
from rotemina.sim.gap.fit import (
    block_numbers,
    drawn_means,
    summed,
)
from rotemina.sim.gap.output import GapTrace
from rotemina.sim.gap.result import Diagnosis
from rotemina.sim.plant import simulate_nominal_response
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import Robot
from rotemina.sim.trajectory import AxisMotion, MotionEnvelope

# A new motion uses this fraction of the range of the records, because nothing is known outside it.
_RANGE_FRACTION = 0.8

_MULTISINE_DURATION_S = 6.0

# Slow records lead to slow motions. Motions longer than this are not offered.
_MAX_DURATION_S = 60.0

# A gap counts as unchanged if its reduction factor is between this value and its inverse.
MIN_SAME_RATIO = 0.95

# If the noise floor of a sensor is not known, it is assumed to be this fraction of the axis range.
_DEFAULT_FLOOR_RATIO = 1e-6

# Seed of the multisine's phases. It is unusual, so that no record has the same phases.
_PHASE_SEED = 20_261


@dataclass(frozen=True, slots=True, eq=False)
class GapReduction:
    """Gap of one axis on a new record, from the nominal and from the corrected model.

    ``figure`` contains both gaps. ``factor`` is the gap from the nominal model divided by the gap
    from the corrected model. ``interval`` is its 95 % interval, from a block bootstrap.
    """

    trace: GapTrace
    figure: GapFigure
    factor: float
    interval: tuple[float, float]

    @property
    def before(self) -> float:
        """Gap from the nominal model, SI."""
        return self.figure.nominal

    @property
    def after(self) -> float:
        """Gap from the corrected model, SI."""
        return self.figure.rms

    @property
    def is_worse(self) -> bool:
        """Whether the gap from the corrected model is clearly larger than from the nominal one."""
        return self.trace.is_corrected and self.factor < MIN_SAME_RATIO


@dataclass(frozen=True, slots=True, eq=False)
class UnseenMotionResult:
    """Gaps of all axes on one new record, with the axis whose gap shrinks most first."""

    name: str
    reductions: tuple[GapReduction, ...]


def measure_reductions(
    diagnosis: Diagnosis, model: ModelInUse, run: ComparedRun, memory: CommandMemory
) -> UnseenMotionResult:
    """Compute the gap before and after the correction on a new run, for each axis that moved.

    A run that was played with this model already contains its gap. Any other run is compared again,
    starting from the earlier commands in ``memory``.

    Raises
    ------
    InputError
        If the record does not fit the robot, or the corrected model cannot be simulated.
    """
    compared_run = run if run.model_id == model.id else compare_run_again(model, run, memory)
    reductions = [
        _measure_reduction(compared_run, axis, figure, diagnosis.robot)
        for (axis, tap), figure in compared_run.gaps.items()
        if tap is Tap.MEAS and figure is not None and axis in diagnosis.axes
    ]
    return UnseenMotionResult(
        run.name, tuple(sorted(reductions, key=lambda reduction: -reduction.factor))
    )


def _measure_reduction(
    run: ComparedRun, axis: str, figure: GapFigure, robot: Robot
) -> GapReduction:
    record, response = run.record, run.comparison.response
    corrected = response.signal(axis, Tap.MEAS)
    floor = next(
        comparison.noise_floor
        for comparison in run.comparison.taps
        if (comparison.axis, comparison.tap) == (axis, "meas")
    )
    trace = GapTrace(
        0,
        record,
        axis,
        Tap.MEAS,
        record.signal(axis, Tap.MEAS),
        run.nominal.get(axis, corrected),
        corrected,
        floor or 0.0,
        robot.axes[axis],
    )
    is_moving = find_moving_samples(
        record.time_s, np.column_stack([record.signal(name, Tap.CMD) for name in record.axes])
    )
    squares = np.stack([trace.gap_before**2, trace.gap_after**2], axis=1)
    blocks = summed(
        block_numbers(record.time_s[is_moving], trace.command[is_moving]), squares[is_moving]
    )
    resampled_means = drawn_means(blocks, np.random.default_rng(0))
    ratios = np.sqrt(resampled_means[:, 0] / np.maximum(resampled_means[:, 1], 1e-300))
    low, high = np.percentile(ratios, [2.5, 97.5])
    factor = float(figure.nominal / max(figure.rms, 1e-300))
    return GapReduction(trace, figure, factor, (float(low), float(high)))


def make_new_motion(diagnosis: Diagnosis, records: Sequence[Record], axes: Sequence[str]) -> Record:
    """Return a new motion of these axes, within the range of the records.

    No record contains this motion. Of three kinds of motion, the function chooses the one on which
    the nominal and the corrected model differ most: creep shows in holds, and ringing in fast
    motions. The motion does not exceed the speed and acceleration of the records.

    Raises
    ------
    InputError
        If the records do not move these axes, the limits of the robot allow no motion, or the
        corrected model cannot be simulated.
    """
    robot, envelope = diagnosis.robot, MotionEnvelope.of(records)
    twin = replace(robot, effects=(*robot.effects, *diagnosis.fitted))
    moved_axes = [axis for axis in axes if envelope.has_motion(axis)]
    if not moved_axes:
        raise GapError(
            tr("the records move none of these axes: {axes}; play a motion of your own").format(
                axes=", ".join(map(get_axis_label, axes))
            )
        )
    limited_robot = envelope.narrow(robot)
    swings = {axis: _find_swing(envelope.axes[axis]) for axis in moved_axes}
    motions = [
        excite(
            limited_robot,
            {axis: make_excitation(*swing) for axis, swing in swings.items()},
            seed=_PHASE_SEED,
        ).record
        for make_excitation in (_make_multisine, _make_staircase, _make_triangle)
    ]
    short_motions = [motion for motion in motions if motion.duration_s <= _MAX_DURATION_S]
    return max(short_motions, key=lambda motion: _compute_difference(robot, twin, motion))


def _find_swing(motion: AxisMotion) -> tuple[float, float]:
    """Return the amplitude and the middle, m or rad, of a swing over most of the range."""
    return _RANGE_FRACTION * (motion.high - motion.low) / 2.0, (motion.low + motion.high) / 2.0


def _make_multisine(amplitude: float, middle: float) -> ExcitationKind:
    return MultisineExcitation(
        amplitude=amplitude, offset=middle, duration_s=_MULTISINE_DURATION_S, periodic=False
    )


def _make_staircase(amplitude: float, middle: float) -> ExcitationKind:
    return StaircaseExcitation(amplitude=amplitude, offset=middle, levels=4, hold_s=0.8)


def _make_triangle(amplitude: float, middle: float) -> ExcitationKind:
    return DecayingTriangleExcitation(amplitude=amplitude, offset=middle, growing=True)


def _compute_difference(robot: Robot, twin: Robot, motion: Record) -> float:
    """Return the mean square difference of two models in noise floors², summed over all axes."""
    responses = [simulate_nominal_response(model, motion) for model in (robot, twin)]
    total = 0.0
    for axis in motion.axes:
        sensor = robot.axes[axis].sensor
        difference = np.subtract(*(response.signal(axis, Tap.MEAS) for response in responses))
        default_floor = robot.axes[axis].span * _DEFAULT_FLOOR_RATIO
        floor = (sensor.noise_floor if sensor else 0.0) or default_floor
        total += float(np.var(difference)) / floor**2
    return total

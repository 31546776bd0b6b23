"""How far a gap shrinks on a record that no diagnosis has seen. No Qt."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from rotemina.app.display_units import label
from rotemina.app.motion.command_memory import CommandMemory
from rotemina.app.motion.compared_run import Run, compared_again
from rotemina.app.motion.model_in_use import ModelInUse
from rotemina.plugins.gap import tr
from rotemina.sim.comparison.gap import GapFigure, moving
from rotemina.sim.excitation.generator import Kind, excite
from rotemina.sim.excitation.sines_and_chirps import Multisine
from rotemina.sim.excitation.staircase_steps_prbs import Staircase
from rotemina.sim.excitation.triangles_and_sweeps import DecayingTriangle
from rotemina.sim.gap.diagnosis import Diagnosis
from rotemina.sim.gap.errors import GapError
from rotemina.sim.gap.fit.row_blocks import block_numbers, drawn_means, summed
from rotemina.sim.gap.output.report.traces import Trace
from rotemina.sim.plant.response import nominal_response
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import Robot
from rotemina.sim.trajectory.motion_envelope import AxisMotion, MotionEnvelope

_SHARE_OF_WAY = 0.8  # of where the records went: beyond it nothing was examined
_MOTION_S = 6.0
_LONGEST_S = 60.0  # of a motion that is slow because the records are
SAME = 0.95  # times smaller, from which a gap is as large as before
_ATOM = 1e-6  # of the range, where a sensor's floor is not known
_SEED = 20_261  # of its phases: no other motion has it by chance


@dataclass(frozen=True, slots=True, eq=False)
class Shrunk:
    """The gap of one axis on a new record: by the nominal model, and with the causes in.

    ``figure`` is the gap, as everywhere. ``times`` is how many times smaller it is than that of
    the nominal model, with its 95 % interval from blocks of the record.
    """

    trace: Trace
    figure: GapFigure
    times: float
    interval: tuple[float, float]

    @property
    def before(self) -> float:
        """The gap of the nominal model, SI."""
        return self.figure.nominal

    @property
    def after(self) -> float:
        """The gap with the causes in, SI."""
        return self.figure.rms

    @property
    def worse(self) -> bool:
        """Whether it is larger than that of the nominal model, by enough to show."""
        return self.trace.changed and self.times < SAME


@dataclass(frozen=True, slots=True, eq=False)
class Proof:
    """The remaining gap on one new record, the axes that shrink most first."""

    name: str
    shrunk: tuple[Shrunk, ...]


def prove(diagnosis: Diagnosis, model: ModelInUse, run: Run, memory: CommandMemory) -> Proof:
    """Work out the gap of a new record before and after, for axes that were diagnosed and moved.

    A run that was played with this model has its gap already. Another is compared again: what the
    machine was commanded before is known to the model, as far as it is in the memory.

    Raises
    ------
    InputError
        If the record does not fit the robot, or the corrected model cannot be simulated.
    """
    again = run if run.model_id == model.id else compared_again(model, run, memory)
    found = [
        _shrunk(again, axis, figure, diagnosis.robot)
        for (axis, tap), figure in again.gaps.items()
        if tap is Tap.MEAS and figure is not None and axis in diagnosis.axes
    ]
    return Proof(run.name, tuple(sorted(found, key=lambda one: -one.times)))


def _shrunk(run: Run, axis: str, figure: GapFigure, robot: Robot) -> Shrunk:
    record, response = run.record, run.comparison.response
    corrected = response.signal(axis, Tap.MEAS)
    floor = next(
        one.noise_floor for one in run.comparison.taps if (one.axis, one.tap) == (axis, "meas")
    )
    trace = Trace(
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
    counted = moving(
        record.time_s, np.column_stack([record.signal(a, Tap.CMD) for a in record.axes])
    )
    squares = np.stack([trace.before**2, trace.after**2], axis=1)
    blocks = summed(block_numbers(record.time_s[counted], trace.command[counted]), squares[counted])
    drawn = drawn_means(blocks, np.random.default_rng(0))
    ratios = np.sqrt(drawn[:, 0] / np.maximum(drawn[:, 1], 1e-300))
    low, high = np.percentile(ratios, [2.5, 97.5])
    times = float(figure.nominal / max(figure.rms, 1e-300))
    return Shrunk(trace, figure, times, (float(low), float(high)))


def new_motion(diagnosis: Diagnosis, records: Sequence[Record], axes: Sequence[str]) -> Record:
    """Return a motion of these axes, where the records went, that none of them holds.

    Of a few kinds, the one on which the model and the corrected model differ most: what creeps
    shows in holds, what rings in fast ways. None exceeds the speed or acceleration of the records.

    Raises
    ------
    InputError
        If the records do not move these axes, the limits of the robot allow no motion, or the
        corrected model cannot be simulated.
    """
    robot, envelope = diagnosis.robot, MotionEnvelope.of(records)
    twin = replace(robot, effects=(*robot.effects, *diagnosis.fitted))
    moved = [axis for axis in axes if envelope.has_motion(axis)]
    if not moved:
        raise GapError(
            tr("the records move none of these axes: {axes}; play a motion of your own").format(
                axes=", ".join(map(label, axes))
            )
        )
    limited = envelope.narrow(robot)
    ways = {axis: _way(envelope.axes[axis]) for axis in moved}
    made = [
        excite(limited, {axis: kind(*way) for axis, way in ways.items()}, seed=_SEED).record
        for kind in (_fast, _held, _swinging)
    ]
    short = [motion for motion in made if motion.duration_s <= _LONGEST_S]
    return max(short, key=lambda motion: _difference(robot, twin, motion))


def _way(motion: AxisMotion) -> tuple[float, float]:
    """Return amplitude and middle of most of where an axis went."""
    return _SHARE_OF_WAY * (motion.high - motion.low) / 2.0, (motion.low + motion.high) / 2.0


def _fast(amplitude: float, middle: float) -> Kind:
    return Multisine(amplitude=amplitude, offset=middle, duration_s=_MOTION_S, periodic=False)


def _held(amplitude: float, middle: float) -> Kind:
    return Staircase(amplitude=amplitude, offset=middle, levels=4, hold_s=0.8)


def _swinging(amplitude: float, middle: float) -> Kind:
    return DecayingTriangle(amplitude=amplitude, offset=middle, growing=True)


def _difference(robot: Robot, twin: Robot, motion: Record) -> float:
    """Return by how much two models differ on a motion: rms over the axes, in noise floors."""
    answers = [nominal_response(one, motion) for one in (robot, twin)]
    squares = 0.0
    for axis in motion.axes:
        sensor = robot.axes[axis].sensor
        apart = np.subtract(*(answer.signal(axis, Tap.MEAS) for answer in answers))
        floor = (sensor.noise_floor if sensor else 0.0) or robot.axes[axis].span * _ATOM
        squares += float(np.var(apart)) / floor**2
    return squares

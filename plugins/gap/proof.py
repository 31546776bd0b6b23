"""How far a gap shrinks on a record that no diagnosis has seen. No Qt."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from rotemina.sim.excitation.generator import Kind, excite
from rotemina.sim.excitation.levels import Staircase
from rotemina.sim.excitation.swings import DecayingTriangle
from rotemina.sim.excitation.tones import Multisine
from rotemina.sim.gap.blocks import block_numbers, drawn_means, summed
from rotemina.sim.gap.diagnosis import Diagnosis
from rotemina.sim.gap.report.traces import Trace, traces
from rotemina.sim.plant.response import nominal_response
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import Robot

_SHARE_OF_WAY = 0.8  # of where the records went: beyond it nothing was examined
_MOTION_S = 6.0
_ATOM = 1e-6  # of the range, where a sensor's floor is not known
_SEED = 20_261  # of its phases: no other motion has it by chance


@dataclass(frozen=True, slots=True, eq=False)
class Shrunk:
    """The gap of one axis at one tap on a new record: as the model was, and with the causes in.

    ``times`` is rms before over rms after, with its 95 % interval from blocks of the record.
    """

    trace: Trace
    before: float
    after: float
    times: float
    interval: tuple[float, float]


@dataclass(frozen=True, slots=True, eq=False)
class Proof:
    """What is left of the gap on one new record, the axes that shrink most first."""

    name: str
    shrunk: tuple[Shrunk, ...]


def prove(diagnosis: Diagnosis, name: str, record: Record) -> Proof:
    """Work out the gap of a new record before and after, for axes that were diagnosed.

    Raises
    ------
    PlantError, EffectError
        If the record does not fit the robot, or the corrected model cannot be simulated.
    """
    known = [axis for axis in diagnosis.axes if axis in record.axes]
    found = [_shrunk(trace) for axis in known for trace in traces(diagnosis, axis, [record])]
    return Proof(name, tuple(sorted(found, key=lambda one: -one.times)))


def _shrunk(trace: Trace) -> Shrunk:
    squares = np.stack([trace.before**2, trace.after**2], axis=1)
    blocks = summed(block_numbers(trace.record.time_s, trace.command), squares)
    drawn = drawn_means(blocks, np.random.default_rng(0))
    before, after = np.sqrt(squares.mean(axis=0))
    ratios = np.sqrt(drawn[:, 0] / np.maximum(drawn[:, 1], 1e-300))
    low, high = np.percentile(ratios, [2.5, 97.5])
    times = float(before / max(after, 1e-300))
    return Shrunk(trace, float(before), float(after), times, (float(low), float(high)))


def leading(proof: Proof, axes: Sequence[str]) -> Shrunk | None:
    """Return what shrinks most among axes that have a cause, or of all where they have none."""
    return next((one for one in proof.shrunk if one.trace.axis in axes), None) or next(
        iter(proof.shrunk), None
    )


def new_motion(diagnosis: Diagnosis, records: Sequence[Record], axes: Sequence[str]) -> Record:
    """Return a motion of these axes, where the records went, that none of them holds.

    Of a few kinds, the one on which the model and the corrected model differ most: what creeps
    shows in holds, what rings in fast ways.

    Raises
    ------
    InputError
        If the limits of the robot allow none, or the corrected model cannot be simulated.
    """
    robot = diagnosis.robot
    twin = replace(robot, effects=(*robot.effects, *diagnosis.fitted))
    ways = {axis: _way(axis, records) for axis in axes}
    made = [
        excite(robot, {axis: kind(*way) for axis, way in ways.items()}, seed=_SEED).record
        for kind in (_fast, _held, _swinging)
    ]
    return max(made, key=lambda motion: _difference(robot, twin, motion))


def _way(axis: str, records: Sequence[Record]) -> tuple[float, float]:
    """Return amplitude and middle of most of where an axis went."""
    ways = [one.signal(axis, Tap.CMD) for one in records if one.has(axis, Tap.CMD)]
    low, high = min(float(way.min()) for way in ways), max(float(way.max()) for way in ways)
    return _SHARE_OF_WAY * (high - low) / 2.0, (low + high) / 2.0


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

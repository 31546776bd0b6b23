"""Safe tests of one axis, from which the next experiment is chosen.

They stay inside the travel, the speed and the acceleration that the records show, and inside every
limit of the robot. Only if a robot file states both a speed and an acceleration limit, tests up to
these are available too: then they are larger where the axis has room, but around a keep-out they
stay where the records have been. All are made by :mod:`~rotemina.sim.excitation`, from rest to
rest.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from math import pi, sqrt

import numpy as np

from rotemina.sim.errors import InputError
from rotemina.sim.excitation.axis_draft import AMPLITUDE, natural_frequency
from rotemina.sim.excitation.generator import Kind, default_rate, excite
from rotemina.sim.excitation.sines_and_chirps import Chirp, Multisine, Sine
from rotemina.sim.excitation.staircase_steps_prbs import Staircase, Steps
from rotemina.sim.excitation.triangles_and_sweeps import DecayingTriangle, Sweeps, Triangle
from rotemina.sim.messages import AxisName, Message, message
from rotemina.sim.quantities import rounded
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import KeepOut, Robot, StepperAxis
from rotemina.sim.trajectory.dry_run import mode_of
from rotemina.sim.trajectory.motion_envelope import MotionEnvelope
from rotemina.sim.trajectory.speed_and_acceleration import SETPOINT_PERIOD_S

LONGEST_S = 25.0
RICH = message("gap", "decaying triangle")  # the test of many amplitudes and speeds
_MOST_ROWS = 30_000
_USUAL_HZ = 1.0 / SETPOINT_PERIOD_S
_PER_RESONANCE = 2.0  # rows in a period of the resonance, with which the usual rate will do
_SMALL = 0.1  # of the usual amplitude
_PITCHES = 2.5  # to each side, so that what repeats with the screw shows
_HASTE = 0.9  # of the greatest speed and acceleration
_LEAST_SHARE = 1e-4  # of the range, as an amplitude where the records hardly moved
_FAST, _SLOW = message("gap", "fast {size}triangle"), message("gap", "slow {size}triangle")
_ROW_OF_STEPS, _MULTISINE = message("gap", "series of steps"), message("gap", "multisine")
_OF_OTHERS = (_FAST.fill(size=""), _SLOW.fill(size=""), _ROW_OF_STEPS, _MULTISINE)


@dataclass(frozen=True, slots=True, eq=False)
class Trial:
    """A test: what it is called, and its commands."""

    name: Message
    record: Record


@dataclass(frozen=True, slots=True)
class _Room:
    """Where an axis is moved, m or rad: the middle and ways to each side."""

    centre: float
    usual: float
    large: float
    speed: float
    acceleration: float
    pitch: float | None

    @property
    def hasty_hz(self) -> float:
        """Frequency of a sine of the large amplitude near the limits, Hz."""
        by_speed = self.speed / (2.0 * pi * self.large)
        return _HASTE * min(by_speed, sqrt(self.acceleration / self.large) / (2.0 * pi))


def has_declared_limits(robot: Robot, axis: str) -> bool:
    """Whether a robot file states how fast an axis may move, and how quickly it may start."""
    described = robot.axes[axis]
    return described.max_speed is not None and described.max_acceleration is not None


def trials(
    robot: Robot,
    axis: str,
    records: Sequence[Record],
    sources: Sequence[str] = (),
    *,
    beyond_records: bool = False,
) -> list[Trial]:
    """Return the safe tests of an axis; none where it never moved, or nothing makes it follow.

    Parameters
    ----------
    robot : Robot
    axis : str
        That is examined.
    records : sequence of Record
        Inside the motion that they show the tests stay.
    sources : sequence of str
        Other axes, each of which moves in tests of its own while the axis is held.
    beyond_records : bool
        Go up to the limits of the robot file instead, with the axes for which it states them.
    """
    envelope = MotionEnvelope.of(records)
    commanded = [one for one in dict.fromkeys((axis, *sources)) if one in envelope.axes]
    if beyond_records:
        limited = robot
        moving = [one for one in commanded if has_declared_limits(robot, one)]
    else:
        limited = envelope.narrow(robot)
        moving = [one for one in commanded if envelope.has_motion(one)]
    rate = _rate(robot, axis, records)
    found = []
    for name in moving:
        room = _room(limited, name, envelope, beyond_records=beyond_records)
        if room.usual <= 0.0:
            continue
        for title, kind in _kinds(room, min(1.0, _MOST_ROWS / (rate * LONGEST_S))):
            if name != axis:
                if title not in _OF_OTHERS:
                    continue
                held = message("gap", "{name} of {moved} while {held} is held")
                title = held.fill(name=title, moved=AxisName(name), held=AxisName(axis))
            try:
                record = excite(limited, {name: kind}, rate_hz=rate).record
            except InputError:
                continue  # this axis cannot do it
            if name != axis:
                record = _held(robot, record, axis, envelope)
            if len(record.time_s) <= _MOST_ROWS:
                found.append(Trial(title, _as_played(robot, record)))
    return found


def _kinds(room: _Room, pace: float) -> Iterator[tuple[Message, Kind]]:
    """Give tests by name; ``pace`` shortens all of them, and makes them as much faster."""
    centre, usual, large = room.centre, room.usual, room.large
    for size, amplitude in _amplitudes(room):
        yield (
            _FAST.fill(size=size),
            Triangle(
                amplitude=amplitude, offset=centre, frequency_hz=1.0 / pace, duration_s=6.0 * pace
            ),
        )
        yield (
            _SLOW.fill(size=size),
            Triangle(
                amplitude=amplitude,
                offset=centre,
                frequency_hz=0.125 / pace,
                duration_s=16.0 * pace,
            ),
        )
    yield (
        RICH,
        DecayingTriangle(
            amplitude=large, offset=centre, frequency_hz=0.5 / pace, duration_s=12.0 * pace
        ),
    )
    yield message("gap", "staircase"), Staircase(amplitude=large, offset=centre, hold_s=0.5 * pace)
    yield _ROW_OF_STEPS, Steps(amplitude=usual, offset=centre, hold_s=0.4 * pace, cycles=3)
    long_holds = Steps(amplitude=large, offset=centre, hold_s=4.0 * pace)
    yield message("gap", "steps with long holds"), long_holds
    yield (
        message("gap", "one step back and forth with very long holds"),
        Staircase(amplitude=large, offset=centre, levels=2, hold_s=6.0 * pace),
    )
    way = max(large, _PITCHES * room.pitch) if room.pitch else large
    yield (
        message("gap", "ramps at two constant speeds"),
        Sweeps(
            amplitude=way,
            offset=centre,
            speeds=(min(2.0 * way / pace, _HASTE * room.speed), 0.4 * way / pace),
            hold_s=0.3 * pace,
        ),
    )
    yield from _tones(room, pace)


def _tones(room: _Room, pace: float) -> Iterator[tuple[Message, Kind]]:
    centre = room.centre
    for hertz, seconds in ((0.3, 10.0), (3.0, 4.0), (20.0, 3.0)):
        frequency = hertz / pace
        yield (
            message("gap", "{hz} Hz sine").fill(hz=rounded(frequency, 3)),
            Sine(
                amplitude=room.usual,
                offset=centre,
                frequency_hz=frequency,
                duration_s=seconds * pace,
            ),
        )
    yield (
        message("gap", "fast {hz} Hz sine").fill(hz=rounded(room.hasty_hz, 3)),
        Sine(
            amplitude=room.large,
            offset=centre,
            frequency_hz=room.hasty_hz,
            duration_s=max(4.0 * pace, 3.0 / room.hasty_hz),
        ),
    )
    yield (
        message("gap", "chirp"),
        Chirp(amplitude=room.usual, offset=centre, low_hz=1.0 / pace, duration_s=10.0 * pace),
    )
    yield (
        _MULTISINE,
        Multisine(
            amplitude=room.usual,
            offset=centre,
            low_hz=0.5 / pace,
            period_s=4.0 * pace,
            duration_s=8.0 * pace,
            detection=0,
            slope=-0.5,
            periodic=False,
        ),
    )


def _amplitudes(room: _Room) -> Iterator[tuple[str | Message, float]]:
    yield "", room.usual
    yield message("gap", "small "), _SMALL * room.usual
    if room.large > 1.5 * room.usual:
        yield message("gap", "large "), room.large


def _room(robot: Robot, axis: str, envelope: MotionEnvelope, *, beyond_records: bool) -> _Room:
    """Return where an axis of a robot, whose limits are stated, may be moved."""
    described, motion = robot.axes[axis], envelope.axes[axis]
    assert described.max_speed is not None
    assert described.max_acceleration is not None
    low, high = described.range
    lowest, highest = max(motion.low, low), min(motion.high, high)
    centre, usual = (lowest + highest) / 2.0, (highest - lowest) / 2.0
    large, pitch = usual, None
    if beyond_records:
        least = _LEAST_SHARE * described.span
        centre = float(np.clip(centre, low + 2.0 * least, high - 2.0 * least))
        most = min(centre - low, high - centre)
        usual = large = min(max(usual, least), most)
        if robot.keep_out == KeepOut():  # else only where the tip is known to do no harm
            large = min(
                max(usual, min(AMPLITUDE * described.span, 0.5 * described.max_speed)), most
            )
        pitch = described.pitch if isinstance(described, StepperAxis) else None
    return _Room(centre, usual, large, described.max_speed, described.max_acceleration, pitch)


def _rate(robot: Robot, axis: str, records: Sequence[Record]) -> float:
    """Return the rate of the tests, Hz: the rate at which devices take set-points.

    Rows farther apart are jumps to a device, beyond any limit of speed. It is higher, at most the
    records' rate, only where the axis' resonance would be missed.
    """
    natural = natural_frequency(robot.axes[axis]) or 0.0
    if _PER_RESONANCE * natural < _USUAL_HZ:
        return _USUAL_HZ
    recorded = 1.0 / min(
        float(np.median(np.diff(one.time_s))) for one in records if len(one.time_s) > 1
    )
    return max(min(recorded, default_rate(robot, {axis: Triangle()})), _USUAL_HZ)


def _held(robot: Robot, record: Record, axis: str, envelope: MotionEnvelope) -> Record:
    """Return a test of another axis in which this one is commanded to stay."""
    motion, (low, high) = envelope.axes[axis], robot.axes[axis].range
    place = float(np.clip((motion.low + motion.high) / 2.0, low, high))
    still = np.full(len(record.time_s), place)
    unit = robot.unit(axis) or "m"
    (source,) = record.axes
    return Record.from_signals(
        record.time_s,
        {(axis, Tap.CMD): still, (source, Tap.CMD): record.signal(source, Tap.CMD)},
        {**record.units, axis: unit},
        record.metadata,
    )


def _as_played(robot: Robot, record: Record) -> Record:
    mode = mode_of(robot, record.axes)
    return replace(record, metadata={**record.metadata, "mode": mode})

"""Safe tests of one axis, from which the next experiment is chosen.

The tests stay within the travel, the speed and the acceleration of the records, and within every
limit of the robot. If the robot file declares both a speed and an acceleration limit, there are
also tests up to these limits, which may exceed the motion of the records. If there is a keep-out
zone, they stay within the travel of the records. :mod:`~rotemina.sim.excitation` makes all tests.
They begin and end at rest.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from math import pi, sqrt

import numpy as np

from rotemina.sim.errors import InputError
from rotemina.sim.excitation import (
    DEFAULT_AMPLITUDE_SHARE,
    ChirpExcitation,
    DecayingTriangleExcitation,
    ExcitationKind,
    MultisineExcitation,
    SineExcitation,
    StaircaseExcitation,
    StepsExcitation,
    SweepsExcitation,
    TriangleExcitation,
    choose_default_rate,
    compute_natural_frequency,
    excite,
)
from rotemina.sim.messages import AxisName, Message, format_rounded, message
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import (
    KeepOut,
    Robot,
    StepperAxis,
)
from rotemina.sim.trajectory import DEFAULT_SETPOINT_PERIOD_S, MotionEnvelope, find_mode

MAX_DURATION_S = 25.0
# This test contains many amplitudes and speeds.
RICH_TEST = message("gap", "decaying triangle")
_MAX_ROWS = 30_000
_DEFAULT_RATE_HZ = 1.0 / DEFAULT_SETPOINT_PERIOD_S
# The default rate is sufficient if it gives this many rows per period of the resonance.
_MIN_ROWS_PER_PERIOD = 2.0
# Small amplitudes, relative to the usual amplitude.
_SMALL_AMPLITUDE_RATIO = 0.1
# Ramps cover this many screw pitches to each side, so that periodic errors are visible.
_RAMP_PITCHES = 2.5
# Tests near a limit use this fraction of the maximum speed or acceleration.
_LIMIT_RATIO = 0.9
# Amplitude relative to the range, if the axis hardly moved in the records.
_MIN_AMPLITUDE_RATIO = 1e-4
_FAST_TRIANGLE, _SLOW_TRIANGLE = (
    message("gap", "fast {size}triangle"),
    message("gap", "slow {size}triangle"),
)
_STEP_SERIES, _MULTISINE = message("gap", "series of steps"), message("gap", "multisine")
_TESTS_OF_OTHER_AXES = (
    _FAST_TRIANGLE.fill(size=""),
    _SLOW_TRIANGLE.fill(size=""),
    _STEP_SERIES,
    _MULTISINE,
)


@dataclass(frozen=True, slots=True, eq=False)
class SafeTest:
    """A test: its name, as used within a sentence, and its commands."""

    name: Message
    record: Record


@dataclass(frozen=True, slots=True)
class _MotionBounds:
    centre: float
    usual_amplitude: float
    large_amplitude: float
    speed: float
    acceleration: float
    pitch: float | None

    @property
    def max_sine_hz(self) -> float:
        """Frequency at which a sine of large amplitude comes near the limits, Hz."""
        speed_limited_hz = self.speed / (2.0 * pi * self.large_amplitude)
        acceleration_limited_hz = sqrt(self.acceleration / self.large_amplitude) / (2.0 * pi)
        return _LIMIT_RATIO * min(speed_limited_hz, acceleration_limited_hz)


def has_declared_limits(robot: Robot, axis: str) -> bool:
    """Return whether the robot file declares a speed and an acceleration limit of an axis."""
    axis_model = robot.axes[axis]
    return axis_model.max_speed is not None and axis_model.max_acceleration is not None


def find_safe_tests(
    robot: Robot,
    axis: str,
    records: Sequence[Record],
    sources: Sequence[str] = (),
    *,
    beyond_records: bool = False,
) -> list[SafeTest]:
    """Return the safe tests of an axis: none if it never moved or cannot follow commands.

    Parameters
    ----------
    robot : Robot
    axis : str
        The examined axis.
    records : sequence of Record
        The tests stay within the range of motion of these records.
    sources : sequence of str
        Other axes that may move the examined axis. Each of them moves in separate tests, while the
        examined axis is held.
    beyond_records : bool
        Whether to use the limits of the robot file instead. Axes without such limits have no tests.
    """
    envelope = MotionEnvelope.of(records)
    commanded_axes = [name for name in dict.fromkeys((axis, *sources)) if name in envelope.axes]
    if beyond_records:
        limited_robot = robot
        tested_axes = [name for name in commanded_axes if has_declared_limits(robot, name)]
    else:
        limited_robot = envelope.narrow(robot)
        tested_axes = [name for name in commanded_axes if envelope.has_motion(name)]
    rate_hz = _choose_rate(robot, axis, records)
    tests = []
    for name in tested_axes:
        bounds = _find_motion_bounds(limited_robot, name, envelope, beyond_records=beyond_records)
        if bounds.usual_amplitude <= 0.0:
            continue
        for title, excitation in _list_tests(
            bounds, min(1.0, _MAX_ROWS / (rate_hz * MAX_DURATION_S))
        ):
            if name != axis:
                if title not in _TESTS_OF_OTHER_AXES:
                    continue
                title_template = message("gap", "{name} of {moved} while {held} is held")
                title = title_template.fill(name=title, moved=AxisName(name), held=AxisName(axis))
            try:
                record = excite(limited_robot, {name: excitation}, rate_hz=rate_hz).record
            # The test does not fit within the limits of this axis.
            except InputError:
                continue
            if name != axis:
                record = _hold_axis(robot, record, axis, envelope)
            if len(record.time_s) <= _MAX_ROWS:
                tests.append(SafeTest(title, _with_mode(robot, record)))
    return tests


def _list_tests(
    bounds: _MotionBounds, time_scale: float
) -> Iterator[tuple[Message, ExcitationKind]]:
    """Yield tests with their names. ``time_scale``, at most 1, scales all durations."""
    centre, usual, large = bounds.centre, bounds.usual_amplitude, bounds.large_amplitude
    for size, amplitude in _list_amplitudes(bounds):
        yield (
            _FAST_TRIANGLE.fill(size=size),
            TriangleExcitation(
                amplitude=amplitude,
                offset=centre,
                frequency_hz=1.0 / time_scale,
                duration_s=6.0 * time_scale,
            ),
        )
        yield (
            _SLOW_TRIANGLE.fill(size=size),
            TriangleExcitation(
                amplitude=amplitude,
                offset=centre,
                frequency_hz=0.125 / time_scale,
                duration_s=16.0 * time_scale,
            ),
        )
    yield (
        RICH_TEST,
        DecayingTriangleExcitation(
            amplitude=large,
            offset=centre,
            frequency_hz=0.5 / time_scale,
            duration_s=12.0 * time_scale,
        ),
    )
    yield (
        message("gap", "staircase"),
        StaircaseExcitation(amplitude=large, offset=centre, hold_s=0.5 * time_scale),
    )
    yield (
        _STEP_SERIES,
        StepsExcitation(amplitude=usual, offset=centre, hold_s=0.4 * time_scale, cycles=3),
    )
    long_holds = StepsExcitation(amplitude=large, offset=centre, hold_s=4.0 * time_scale)
    yield message("gap", "steps with long holds"), long_holds
    yield (
        message("gap", "one step back and forth with very long holds"),
        StaircaseExcitation(amplitude=large, offset=centre, levels=2, hold_s=6.0 * time_scale),
    )
    ramp_amplitude = max(large, _RAMP_PITCHES * bounds.pitch) if bounds.pitch else large
    yield (
        message("gap", "ramps at two constant speeds"),
        SweepsExcitation(
            amplitude=ramp_amplitude,
            offset=centre,
            speeds=(
                min(2.0 * ramp_amplitude / time_scale, _LIMIT_RATIO * bounds.speed),
                0.4 * ramp_amplitude / time_scale,
            ),
            hold_s=0.3 * time_scale,
        ),
    )
    yield from _list_tones(bounds, time_scale)


def _list_tones(
    bounds: _MotionBounds, time_scale: float
) -> Iterator[tuple[Message, ExcitationKind]]:
    centre = bounds.centre
    for nominal_hz, duration_s in ((0.3, 10.0), (3.0, 4.0), (20.0, 3.0)):
        frequency_hz = nominal_hz / time_scale
        yield (
            message("gap", "{hz} Hz sine").fill(hz=format_rounded(frequency_hz, 3)),
            SineExcitation(
                amplitude=bounds.usual_amplitude,
                offset=centre,
                frequency_hz=frequency_hz,
                duration_s=duration_s * time_scale,
            ),
        )
    yield (
        message("gap", "fast {hz} Hz sine").fill(hz=format_rounded(bounds.max_sine_hz, 3)),
        SineExcitation(
            amplitude=bounds.large_amplitude,
            offset=centre,
            frequency_hz=bounds.max_sine_hz,
            duration_s=max(4.0 * time_scale, 3.0 / bounds.max_sine_hz),
        ),
    )
    yield (
        message("gap", "chirp"),
        ChirpExcitation(
            amplitude=bounds.usual_amplitude,
            offset=centre,
            low_hz=1.0 / time_scale,
            duration_s=10.0 * time_scale,
        ),
    )
    yield (
        _MULTISINE,
        MultisineExcitation(
            amplitude=bounds.usual_amplitude,
            offset=centre,
            low_hz=0.5 / time_scale,
            period_s=4.0 * time_scale,
            duration_s=8.0 * time_scale,
            detection=0,
            slope=-0.5,
            periodic=False,
        ),
    )


def _list_amplitudes(bounds: _MotionBounds) -> Iterator[tuple[str | Message, float]]:
    yield "", bounds.usual_amplitude
    yield message("gap", "small "), _SMALL_AMPLITUDE_RATIO * bounds.usual_amplitude
    if bounds.large_amplitude > 1.5 * bounds.usual_amplitude:
        yield message("gap", "large "), bounds.large_amplitude


def _find_motion_bounds(
    robot: Robot, axis: str, envelope: MotionEnvelope, *, beyond_records: bool
) -> _MotionBounds:
    """Return the bounds of the motion of an axis, whose limits must be declared."""
    model, motion = robot.axes[axis], envelope.axes[axis]
    assert model.max_speed is not None
    assert model.max_acceleration is not None
    low, high = model.range
    lowest, highest = max(motion.low, low), min(motion.high, high)
    centre, usual = (lowest + highest) / 2.0, (highest - lowest) / 2.0
    large, pitch = usual, None
    if beyond_records:
        min_amplitude = _MIN_AMPLITUDE_RATIO * model.span
        centre = float(np.clip(centre, low + 2.0 * min_amplitude, high - 2.0 * min_amplitude))
        max_amplitude = min(centre - low, high - centre)
        usual = large = min(max(usual, min_amplitude), max_amplitude)
        # With a keep-out zone, only the travel of the records is known to be safe for the tip.
        if robot.keep_out == KeepOut():
            large = min(
                max(usual, min(DEFAULT_AMPLITUDE_SHARE * model.span, 0.5 * model.max_speed)),
                max_amplitude,
            )
        pitch = model.pitch if isinstance(model, StepperAxis) else None
    return _MotionBounds(centre, usual, large, model.max_speed, model.max_acceleration, pitch)


def _choose_rate(robot: Robot, axis: str, records: Sequence[Record]) -> float:
    """Return the rate of the tests, Hz.

    It is the rate at which devices accept set-points. At a lower rate, a device would jump from row
    to row and exceed any speed limit. A higher rate, at most that of the records, is used only if
    the resonance of the axis requires it.
    """
    natural_hz = compute_natural_frequency(robot.axes[axis]) or 0.0
    if _MIN_ROWS_PER_PERIOD * natural_hz < _DEFAULT_RATE_HZ:
        return _DEFAULT_RATE_HZ
    recorded_hz = 1.0 / min(
        float(np.median(np.diff(record.time_s))) for record in records if len(record.time_s) > 1
    )
    return max(
        min(recorded_hz, choose_default_rate(robot, {axis: TriangleExcitation()})), _DEFAULT_RATE_HZ
    )


def _hold_axis(robot: Robot, record: Record, axis: str, envelope: MotionEnvelope) -> Record:
    """Return a test of another axis, in which this axis is commanded to stay in place."""
    motion, (low, high) = envelope.axes[axis], robot.axes[axis].range
    position = float(np.clip((motion.low + motion.high) / 2.0, low, high))
    constant = np.full(len(record.time_s), position)
    unit = robot.unit(axis) or "m"
    (source,) = record.axes
    return Record.from_signals(
        record.time_s,
        {(axis, Tap.CMD): constant, (source, Tap.CMD): record.signal(source, Tap.CMD)},
        {**record.units, axis: unit},
        record.metadata,
    )


def _with_mode(robot: Robot, record: Record) -> Record:
    mode = find_mode(robot, record.axes)
    return replace(record, metadata={**record.metadata, "mode": mode})

"""The motion that shows a sensor's errors, as a trajectory inside the axis' limits.

A micro axis (stepper) makes the cycle of ISO 230-2:2014, section 5.3, with targets
``P_i = (i − 1) p + r``, r at random so that periodic errors are met at all their phases; each is
approached without overrun from below on the way up and from above on the way down. Between the
cycles it creeps a little way at four places, which shows an encoder's interpolation error.

A nano axis (piezo, force) makes slow triangles that reach ever less far, which show the curve and
the loop, and quick moves, which show the lag.
"""

from math import inf

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.calibration.errors import CalibrationError
from rotemina.sim.calibration.iso230 import ISO_RUNS, ISO_TARGETS
from rotemina.sim.excitation.moves import (
    quintic,
    rows_of,
    shortest_duration,
    shortest_quintic,
    trapezoid,
)
from rotemina.sim.messages import message
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import Robot, StepperAxis
from rotemina.sim.trajectory.axis_limits import reachable

RUNS = ISO_RUNS
TARGETS = 11
RATE_HZ = 1000.0
_LEAST_RUNS, _MOST_RUNS, _MOST_TARGETS = 3, 50, 101
_MARGIN = 0.02  # of the range, at each end
_OF_SPEED, _OF_ACCELERATION = 0.8, 0.5  # of what the axis may
_HOLD_S, _SWEEP_S = 0.3, 2.0
_GENTLE = 10.0  # times stroke/T²: a tenth of the time to come up to speed
_QUICK_S = 0.05  # far slower than an axis rings, so that the laser follows between its rows
_CREEP_M, _CREEP_S = 2e-4, 1.5  # on the way and for how long
# At distances each far shorter than the next, so that no count of periods between them is lost.
_CREEPS = (0.1, 0.115, 0.2, 0.9)
_REACHES = (1.0, 0.5, 0.2)  # of the triangles
_JUMPS = (0.2, 0.8, 0.35, 0.65, 0.45, 0.55)  # of the travel
_CROSSING_S = 1.0  # in which an axis without declared bounds crosses its range


def calibration_motion(
    robot: Robot,
    axis: str,
    *,
    runs: int = RUNS,
    targets: int = TARGETS,
    rate_hz: float = RATE_HZ,
    seed: int = 0,
) -> Record:
    """Return the trajectory of one axis; all of its runs are alike.

    Raises
    ------
    CalibrationError
        If the robot has no such axis, or a number is out of bounds.
    """
    if axis not in robot.axes:
        raise CalibrationError(
            message(
                "engine", "axis {axis}: robot {name} has no such axis; use one of {names}"
            ).fill(axis=repr(axis), name=repr(robot.name), names=", ".join(robot.axes))
        )
    _check(runs, targets, rate_hz)
    path = _Path(robot, axis, rate_hz)
    stepper = isinstance(robot.axes[axis], StepperAxis)
    rng = np.random.default_rng(seed)
    places = _targets(targets, rng)
    path.rest(_HOLD_S)
    for _ in range(runs):
        path.micro(places) if stepper else path.nano()
    values = path.values()
    kind = f"ISO 230-2 cycles of {targets} targets" if stepper else "triangles and moves"
    return Record.from_signals(
        np.arange(len(values)) / rate_hz,
        {(axis, Tap.CMD): values},
        {axis: robot.unit(axis) or "m"},
        {
            "name": f"calibration of {axis}",
            "calibration": f"{axis}: {runs} runs, {kind}",
            "calibration_runs": str(runs),
            **({"calibration_targets": str(targets)} if stepper else {}),
            "rate_hz": repr(rate_hz),
        },
    )


def _check(runs: int, targets: int, rate_hz: float) -> None:
    for name, value, least, most in (
        ("runs", runs, _LEAST_RUNS, _MOST_RUNS),
        ("targets", targets, ISO_TARGETS, _MOST_TARGETS),
        ("rate", rate_hz, 100.0, 20_000.0),
    ):
        if not least <= value <= most:
            raise CalibrationError(
                message("engine", "{name} = {value} is not between {least} and {most}").fill(
                    name=name, value=value, least=least, most=most
                )
            )


def _targets(count: int, rng: np.random.Generator) -> FloatArray:
    """Return targets as shares of the travel: even ones, each a little aside."""
    pitch = 1.0 / count
    return (np.arange(count) + 0.5 + rng.uniform(-0.25, 0.25, count)) * pitch


class _Path:
    """The way so far, in shares 0 … 1 of the travel."""

    def __init__(self, robot: Robot, axis: str, rate_hz: float) -> None:
        model = robot.axes[axis]
        low, high = reachable(model)
        self._low = low + _MARGIN * (high - low)
        self._span = (1.0 - 2.0 * _MARGIN) * (high - low)
        self._rate_hz = rate_hz
        self._stroke_ends = model.range
        speed = _OF_SPEED * (model.max_speed or inf) / self._span
        acceleration = _OF_ACCELERATION * (model.max_acceleration or inf) / self._span
        self._speed = min(speed, 1.0 / _CROSSING_S) if speed == inf else speed
        self._acceleration = 10.0 if acceleration == inf else acceleration
        self._parts: list[FloatArray] = [np.zeros(1)]

    def values(self) -> FloatArray:
        """Return the positions (n,), m or rad."""
        values = self._low + self._span * np.concatenate(self._parts)
        return np.clip(values, *self._stroke_ends)

    def micro(self, targets: FloatArray) -> None:
        """One cycle: up, down, and creeping at four places."""
        for place in (*targets, 1.0, *targets[::-1], 0.0):
            self._go(float(place))
            self.rest(_HOLD_S)
        stroke = min(_CREEP_M / self._span, 0.05)
        for place in _CREEPS:
            self._go(place)
            self.rest(_HOLD_S)
            self._sweep(place + stroke, _CREEP_S)
            self._sweep(place, _CREEP_S)
        self._go(0.0)
        self.rest(_HOLD_S)

    def nano(self) -> None:
        """Triangles that reach ever less far, and quick moves."""
        for reach in _REACHES:
            self._sweep(reach, _SWEEP_S * reach)
            self._sweep(0.0, _SWEEP_S * reach)
        for place in (*_JUMPS, 0.0):
            self._jump(place)
            self.rest(0.1)

    def rest(self, duration_s: float) -> None:
        """Stay."""
        self._parts.append(np.full(rows_of(duration_s, self._rate_hz), self._at))

    @property
    def _at(self) -> float:
        return float(self._parts[-1][-1])

    def _go(self, place: float) -> None:
        way = abs(place - self._at)
        if way:
            duration_s = shortest_duration(way, self._speed, self._acceleration)
            rows = rows_of(duration_s, self._rate_hz)
            self._parts.append(trapezoid(self._at, place, rows, self._rate_hz, self._acceleration))

    def _sweep(self, place: float, duration_s: float) -> None:
        way = abs(place - self._at)
        least_s = shortest_duration(way, self._speed, self._acceleration)
        duration_s = max(duration_s, least_s)
        # A gentle turn: what rings cannot be followed between the rows.
        acceleration = min(self._acceleration, _GENTLE * way / duration_s**2)
        rows = rows_of(duration_s, self._rate_hz)
        self._parts.append(trapezoid(self._at, place, rows, self._rate_hz, acceleration))

    def _jump(self, place: float) -> None:
        way = abs(place - self._at)
        duration_s = max(shortest_quintic(way, self._speed, self._acceleration, inf), _QUICK_S)
        self._parts.append(quintic(self._at, place, rows_of(duration_s, self._rate_hz)))

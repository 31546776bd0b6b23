"""What a loop is tried on: a step as the axis' limits let it be made, and a triangle."""

from dataclasses import dataclass
from math import inf

import numpy as np

from rotemina.sim.arrays import FloatArray, read_only
from rotemina.sim.effects.facts import Facts
from rotemina.sim.messages import message
from rotemina.sim.quantities import exact
from rotemina.sim.robot.model import Axis
from rotemina.sim.shaping.moves import MotionLimits, minimum_jerk, shortest_minimum_jerk
from rotemina.sim.tuning.errors import TuningError

STEP_SHARE, TRIANGLE_SHARE, TRIANGLE_HZ = 0.6, 0.5, 10.0  # shares of the range
_REST_S = 0.01  # before a step begins
_PERIODS = 1.5  # of the resonance: no step is shorter
_HOLD_PERIODS = 25.0  # after it; 60 ms at 420 Hz
_SWINGS = 1.0  # of the triangle


@dataclass(frozen=True, slots=True, eq=False)
class Scenario:
    """A reference (n,), m or rad, with what it begins with: ``begin_s`` of rest."""

    name: str
    reference: FloatArray
    begin_s: float

    @property
    def target(self) -> float:
        """Where it ends."""
        return float(self.reference[-1])

    @property
    def distance(self) -> float:
        """How far from its beginning, with its sign."""
        return float(self.reference[-1] - self.reference[0])


def step_of(axis: Axis, rate_hz: float, distance: float | None = None) -> Scenario:
    """Return a move of minimum jerk about mid-range, as short as the axis' limits allow.

    Raises
    ------
    TuningError
        If it does not fit into the range.
    """
    distance = STEP_SHARE * axis.span if distance is None else distance
    middle = _room(axis, distance, "step")
    pace_hz = Facts.of(axis).pace_hz
    limits = MotionLimits(axis.max_speed or inf, axis.max_acceleration or inf)
    duration_s = _PERIODS / pace_hz
    if axis.max_speed or axis.max_acceleration:
        duration_s = max(duration_s, shortest_minimum_jerk(distance, limits).duration_s)
    move = minimum_jerk(distance, duration_s)
    whole_s = _REST_S + duration_s + _HOLD_PERIODS / pace_hz
    time_s = np.arange(round(whole_s * rate_hz) + 1) / rate_hz
    start = middle - 0.5 * distance
    return Scenario("step", read_only(start + move.position(time_s - _REST_S)), _REST_S)


def triangle_of(
    axis: Axis, rate_hz: float, frequency_hz: float | None = None, swing: float | None = None
) -> Scenario:
    """Return a triangle about mid-range, of a tenth of the resonance and 10 Hz at most.

    It keeps the axis' limits: no faster than its speed, its corners rounded as its acceleration
    asks, and over a period of the resonance at least.

    Raises
    ------
    TuningError
        If it does not fit into the range.
    """
    swing = TRIANGLE_SHARE * axis.span if swing is None else swing
    middle = _room(axis, swing, "triangle")
    if frequency_hz is None:
        frequency_hz = min(TRIANGLE_HZ, 0.1 * Facts.of(axis).pace_hz)
    if axis.max_speed:
        frequency_hz = min(frequency_hz, 0.5 * axis.max_speed / abs(swing))
    turn_s = 1.0 / Facts.of(axis).pace_hz
    if axis.max_acceleration:
        turn_s = max(turn_s, 4.0 * abs(swing) * frequency_hz / axis.max_acceleration)
    whole_s = _REST_S + _SWINGS / frequency_hz
    time_s = np.arange(round(whole_s * rate_hz) + 1) / rate_hz - _REST_S
    # The mean over a turn, from the integral of the triangle: parabolas in place of corners.
    turn_s = min(turn_s, 0.5 / frequency_hz)
    ahead, behind = (
        _integral(np.maximum(frequency_hz * (time_s + shift), 0.0)) for shift in (0.0, -turn_s)
    )
    height = (ahead - behind) / (frequency_hz * turn_s)
    return Scenario("triangle", read_only(middle + swing * height), _REST_S)


def _integral(phase: FloatArray) -> FloatArray:
    """Return the integral from 0 of a triangle of period 1 that begins at 0 and goes up to ½."""
    whole = np.floor(phase)
    x = phase - whole  # over a period it is 0
    up, down, last = x**2, 0.125 - (x - 0.5) ** 2, (x - 1.0) ** 2
    return np.asarray(np.where(x < 0.25, up, np.where(x < 0.75, down, last)))


def _room(axis: Axis, length: float, name: str) -> float:
    """Return the middle of the range, about which ``length`` must fit."""
    if length == 0.0 or not abs(length) <= axis.span:
        raise TuningError(
            message(
                "engine",
                "{name} of {length}: must be no more than the axis' range, {most}, and not zero",
            ).fill(
                name=name,
                length=exact(length, axis.unit or "", size=axis.span),
                most=exact(axis.span, axis.unit or ""),
            )
        )
    return 0.5 * sum(axis.range)

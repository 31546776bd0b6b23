"""An axis with its tolerances: gain and resonance off by a few per cent."""

from dataclasses import replace

from rotemina.sim.effects.facts import Facts
from rotemina.sim.feedback.axis_loop import AxisLoop
from rotemina.sim.robot.model import AxisEffect, Robot

SPREAD = 0.05


def loops_of(
    robot: Robot, axis: str, rate_hz: float, *, delay: int = 0, spread: float = SPREAD
) -> list[AxisLoop]:
    """Return the loop around an axis as it is, and around those off by ``spread``.

    The first is the axis as it is; then, where it resonates, more gain with a higher resonance and
    with a lower one (the liveliest), less gain with a higher one (the slowest) and a lower one.

    Raises
    ------
    FeedbackError, EffectError
        As :class:`rotemina.sim.feedback.axis_loop.AxisLoop`.
    """
    nominal = AxisLoop(robot, axis, rate_hz, delay=delay)
    resonates = Facts.of(nominal.robot_axis).frequency_hz > 0.0
    return [
        nominal,
        *(
            AxisLoop(_detuned(robot, axis, off), axis, rate_hz, delay=delay, gain=1.0 + gain)
            for gain, off in _corners(spread, resonates=resonates)
        ),
    ]


def _corners(spread: float, *, resonates: bool) -> list[tuple[float, float]]:
    """Return the errors of gain and resonance that are tried beside none."""
    if spread == 0.0:
        return []
    if not resonates:
        return [(spread, 0.0), (-spread, 0.0)]
    return [(spread, spread), (spread, -spread), (-spread, spread), (-spread, -spread)]


def _detuned(robot: Robot, axis: str, off: float) -> Robot:
    if off == 0.0:
        return robot
    effect = AxisEffect(axis=axis, id="resonance_mismatch", parameters={"frequency_error": off})
    return replace(robot, effects=(*robot.effects, effect))

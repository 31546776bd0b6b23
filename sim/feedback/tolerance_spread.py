"""An axis with its tolerances: gain and resonance off by a few per cent."""

from dataclasses import replace

from rotemina.sim.effects import AxisProperties
from rotemina.sim.feedback.axis_loop import AxisLoop
from rotemina.sim.robot import AxisEffect, Robot

DEFAULT_SPREAD = 0.05


def make_spread_loops(
    robot: Robot, axis: str, rate_hz: float, *, delay: int = 0, spread: float = DEFAULT_SPREAD
) -> list[AxisLoop]:
    """Return the loop around the nominal axis, and loops around axes that differ by ``spread``.

    If the axis has a resonance, four axes differ: with a higher or lower gain, each with a higher
    or lower resonance. Otherwise two differ, in their gain.

    Raises
    ------
    FeedbackError, EffectError
        For the same reasons as in :class:`rotemina.sim.feedback.AxisLoop`.
    """
    nominal = AxisLoop(robot, axis, rate_hz, delay=delay)
    has_resonance = AxisProperties.of(nominal.robot_axis).frequency_hz > 0.0
    return [
        nominal,
        *(
            AxisLoop(
                _detune(robot, axis, frequency_error), axis, rate_hz, delay=delay, gain=1.0 + gain
            )
            for gain, frequency_error in _list_corners(spread, has_resonance=has_resonance)
        ),
    ]


def _list_corners(spread: float, *, has_resonance: bool) -> list[tuple[float, float]]:
    if spread == 0.0:
        return []
    if not has_resonance:
        return [(spread, 0.0), (-spread, 0.0)]
    return [(spread, spread), (spread, -spread), (-spread, spread), (-spread, -spread)]


def _detune(robot: Robot, axis: str, frequency_error: float) -> Robot:
    if frequency_error == 0.0:
        return robot
    effect = AxisEffect(
        axis=axis, id="resonance_mismatch", parameters={"frequency_error": frequency_error}
    )
    return replace(robot, effects=(*robot.effects, effect))

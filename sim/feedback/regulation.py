"""Gains approved for a machine's axis: checked against its model before anything moves."""

import numpy as np

from rotemina.sim.feedback.controller import Controller
from rotemina.sim.feedback.feed_forward import FeedForward, SampledInverse
from rotemina.sim.feedback.gains import Gains
from rotemina.sim.feedback.reference_lead import lead_taps
from rotemina.sim.feedback.stability import PEAK_SENSITIVITY, UnstableError, check_stability
from rotemina.sim.feedback.tolerance_spread import SPREAD, loops_of
from rotemina.sim.messages import message
from rotemina.sim.robot.model import Robot


class Regulation:
    """A loop approved for an axis, always found stable.

    Parameters
    ----------
    robot : Robot
        Its axis is taken as the file has it, and with gain and resonance off by ``spread``.
    axis : str
    gains : Gains
    rate_hz : float
        Of the loop.
    peak_sensitivity : float
        Greatest Ms of any of them.
    spread : float

    Raises
    ------
    UnstableError
        If the loop around any of them would be unstable, or nearer to it than allowed.
    FeedbackError, EffectError
        If the axis cannot be put under such a loop.
    """

    def __init__(
        self,
        robot: Robot,
        axis: str,
        gains: Gains,
        rate_hz: float,
        *,
        peak_sensitivity: float = PEAK_SENSITIVITY,
        spread: float = SPREAD,
    ) -> None:
        nominal, *others = loops_of(robot, axis, rate_hz, spread=spread)
        self.stability = check_stability(nominal.sampled, gains, peak_sensitivity)
        for other in others:
            try:
                check_stability(other.sampled, gains, peak_sensitivity)
            except UnstableError as error:
                raise UnstableError(
                    message(
                        "engine",
                        "{error} (with gain or resonance off by {spread} %)",
                    ).fill(error=str(error), spread=100.0 * spread)
                ) from error
        self.robot, self.axis, self.gains, self.rate_hz = robot, axis, gains, rate_hz
        self.limits = nominal.limits
        self.taps = lead_taps(nominal.robot_axis, self.interval_s)
        # What a live loop runs is compiled here, and not where a machine waits for it.
        nominal.follow(gains, np.full(2, 0.5 * sum(nominal.robot_axis.range)))

    @property
    def interval_s(self) -> float:
        """From sample to sample of the loop, s."""
        return 1.0 / self.rate_hz

    def controller(self, inverse: SampledInverse | None = None) -> Controller:
        """Return a controller, fed forward through the lead and an inverse, if any.

        The inverse is one at the loop's rate, without a stage against lag (``preview``).
        """
        forward = FeedForward(self.taps, inverse)
        return Controller(self.gains, self.interval_s, self.limits, forward)

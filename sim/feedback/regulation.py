"""Approved gains for a machine's axis, checked against its model before anything moves."""

import numpy as np

from rotemina.sim.errors import UnstableError
from rotemina.sim.feedback.controller import SampledController
from rotemina.sim.feedback.feed_forward import FeedForward, SampledInverse
from rotemina.sim.feedback.gains import ControllerGains
from rotemina.sim.feedback.reference_lead import compute_lead_taps
from rotemina.sim.feedback.stability import MAX_PEAK_SENSITIVITY, check_stability
from rotemina.sim.feedback.tolerance_spread import DEFAULT_SPREAD, make_spread_loops
from rotemina.sim.robot import Robot


class AxisRegulation:
    """An approved loop for an axis, which is stable within all tolerances.

    Parameters
    ----------
    robot : Robot
        Its axis is checked as in the file, and with gain and resonance changed by ``spread``.
    axis : str
    gains : ControllerGains
    rate_hz : float
        Sampling rate of the loop.
    peak_sensitivity : float
        Largest permitted Ms of all these loops.
    spread : float

    Raises
    ------
    UnstableError
        If one of these loops is unstable, or closer to instability than allowed.
    FeedbackError, EffectError
        If such a loop cannot be closed around the axis.
    """

    def __init__(
        self,
        robot: Robot,
        axis: str,
        gains: ControllerGains,
        rate_hz: float,
        *,
        peak_sensitivity: float = MAX_PEAK_SENSITIVITY,
        spread: float = DEFAULT_SPREAD,
    ) -> None:
        nominal, *detuned_loops = make_spread_loops(robot, axis, rate_hz, spread=spread)
        self.stability = check_stability(nominal.sampled_axis, gains, peak_sensitivity)
        for detuned in detuned_loops:
            try:
                check_stability(detuned.sampled_axis, gains, peak_sensitivity)
            except UnstableError as error:
                raise UnstableError(
                    "{error} (with gain or resonance off by {spread} %)",
                    error=str(error),
                    spread=100.0 * spread,
                ) from error
        self.robot, self.axis, self.gains, self.rate_hz = robot, axis, gains, rate_hz
        self.limits = nominal.limits
        self.taps = compute_lead_taps(nominal.robot_axis, self.interval_s)
        # The code of a live loop is compiled here, so that no machine has to wait for it.
        nominal.follow(gains, np.full(2, 0.5 * sum(nominal.robot_axis.range)))

    @property
    def interval_s(self) -> float:
        """Interval of the loop's samples, s."""
        return 1.0 / self.rate_hz

    def make_controller(self, inverse: SampledInverse | None = None) -> SampledController:
        """Return a controller with feed-forward through the lead and, optionally, an inverse.

        The inverse must run at the loop's rate, without the stage that compensates lag
        (``preview``).
        """
        forward = FeedForward(self.taps, inverse)
        return SampledController(self.gains, self.interval_s, self.limits, forward)

"""Gains of one axis as a search problem: from numbers between 0 and 1 to figures.

The axis is taken as it is, and with gain and resonance off by ±5 % in all four combinations. Ms is
the worst of the five. The motion, with effects, noise and rounding, is simulated of three: as it
is, with more gain at a lower resonance (the liveliest) and with less gain at a higher one (the
slowest). The other figures are the worst of those.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import log, pi

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.effects.facts import Facts
from rotemina.sim.feedback.axis_loop import AxisLoop, Traces
from rotemina.sim.feedback.feed_forward import FeedForward, SampledInverse
from rotemina.sim.feedback.gains import Gains, Notch
from rotemina.sim.feedback.reference_lead import lead_taps
from rotemina.sim.feedback.stability import (
    LoopAnalysis,
    check_stability,
    sensitivity_peak,
)
from rotemina.sim.feedback.tolerance_spread import SPREAD, loops_of
from rotemina.sim.messages import message
from rotemina.sim.quantities import rounded
from rotemina.sim.robot.model import Robot
from rotemina.sim.tuning.errors import TuningError
from rotemina.sim.tuning.objectives import Constraints
from rotemina.sim.tuning.performance_figures import UNUSABLE, Figures, figures_of, worst
from rotemina.sim.tuning.tuning_scenario import Scenario, step_of, triangle_of

VARIABLES = (
    "integral",
    "proportional",
    "derivative",
    "low_pass_hz",
    "notch_damping",
    "double_integral",
)
USUAL = (0.3, 0.0, 0.0, 0.5, 0.5, 0.0)  # an integral alone: Ms of about 1.2 on a piezo
_SEED = 20_101  # of the noise that every individual meets
# Bounds, in the axis' own pace: I over ω, P, D ω, low-pass over the resonance, ζ of the notch, J
# over I ω.
_INTEGRAL, _PROPORTIONAL, _DERIVATIVE, _DOUBLE = (0.02, 2.0), 1.0, 0.5, 0.3
_LOW_PASS, _HIGHEST_SHARE, _NOTCH = 0.5, 0.45, (0.1, 2.0)
_DERIVATIVE_FILTER = 0.1  # of 1/ω
_SHALLOWEST, _DEEPEST = 0.5, 0.01  # of the notch
_TRACKING = 2.0  # over ω·I: how soon the integral is led back


@dataclass(frozen=True, slots=True, eq=False)
class Evaluation:
    """A loop on one scenario: what is fed forward (n,), and what happened."""

    scenario: Scenario
    feed: FloatArray
    traces: Traces


class TuningProblem:
    """The loop of one axis to be tuned.

    Parameters
    ----------
    robot : Robot
        With the effects that are to act.
    axis : str
    rate_hz : float
        Of the loop.
    delay : int
        Intervals by which an output acts late.
    inverse : SampledInverse, optional
        In the feed-forward, at the loop's rate, without a stage against lag of its own.
    constraints : Constraints
    spread : float
        By how much gain and resonance may be off.

    Raises
    ------
    FeedbackError, EffectError, TuningError
        If the axis cannot be tuned.
    """

    def __init__(
        self,
        robot: Robot,
        axis: str,
        rate_hz: float,
        *,
        delay: int = 0,
        inverse: SampledInverse | None = None,
        constraints: Constraints | None = None,
        spread: float = SPREAD,
    ) -> None:
        self.robot, self.axis, self.rate_hz, self.delay = robot, axis, rate_hz, delay
        self.constraints, self.spread = constraints or Constraints(), spread
        self._variants = loops_of(robot, axis, rate_hz, delay=delay, spread=spread)
        self.loop = self._variants[0]
        own = self.loop.robot_axis
        self._facts = Facts.of(own)
        self._resonates = self._facts.frequency_hz > 0.0
        self._check_pace()
        self._analyses = [LoopAnalysis(one.sampled) for one in self._variants]
        # The liveliest and the slowest stand in the middle of the corners.
        self._simulated = (
            self._variants if len(self._variants) < 4 else [self._variants[k] for k in (0, 2, 3)]
        )
        feed_forward = FeedForward(lead_taps(own, 1.0 / rate_hz, delay=delay), inverse)
        scenarios = step_of(own, rate_hz), triangle_of(own, rate_hz)
        self._given = [(one, feed_forward.run(one.reference)) for one in scenarios]

    def gains_of(self, shares: Sequence[float] | FloatArray) -> Gains:
        """Return the gains for shares (6,) between 0 and 1, in the order of ``VARIABLES``."""
        return gains_at(self._facts, self.rate_hz, shares)

    def evaluate(self, gains: Gains) -> Figures:
        """Return the worst figures over the axes; all infinite where one is unstable.

        Where Ms alone forbids the gains, nothing is simulated and the others are infinite.
        """
        peak = max(sensitivity_peak(analysis, gains) for analysis in self._analyses)
        if peak > self.constraints.peak_sensitivity:
            return replace(UNUSABLE, peak_sensitivity=peak)
        tries = [self._tries(loop, gains) for loop in self._simulated]
        return worst([self._judged(step, triangle, peak) for step, triangle in tries])

    def try_out(self, gains: Gains) -> tuple[tuple[Evaluation, Evaluation], Figures]:
        """Return step and triangle with the axis as it is, and the figures of these two.

        Raises
        ------
        UnstableError
            If the loop is unstable or nearer to it than allowed; nothing is simulated then.
        """
        found = check_stability(self.loop.sampled, gains, self.constraints.peak_sensitivity)
        step, triangle = self._tries(self.loop, gains)
        return (step, triangle), self._judged(step, triangle, found.peak_sensitivity)

    def _tries(self, loop: AxisLoop, gains: Gains) -> tuple[Evaluation, Evaluation]:
        step, triangle = (
            Evaluation(
                scenario,
                feed,
                loop.follow(gains, scenario.reference, feed=feed, rng=np.random.default_rng(_SEED)),
            )
            for scenario, feed in self._given
        )
        return step, triangle

    def _judged(self, step: Evaluation, triangle: Evaluation, peak: float) -> Figures:
        return figures_of(
            (step.scenario, step.traces, step.feed),
            (triangle.scenario, triangle.traces, triangle.feed),
            span=self._facts.span,
            floor=self._facts.noise,
            peak_sensitivity=peak,
        )

    def _check_pace(self) -> None:
        if self._resonates and self._facts.frequency_hz >= 0.4 * self.rate_hz:
            raise TuningError(
                message(
                    "engine",
                    "axis {axis}: a loop at {rate_hz} Hz is too slow for a resonance at "
                    "{frequency_hz} Hz; use a rate above {least_hz} Hz",
                ).fill(
                    axis=self.axis,
                    rate_hz=self.rate_hz,
                    frequency_hz=rounded(self._facts.frequency_hz, 4),
                    least_hz=rounded(2.5 * self._facts.frequency_hz, 4),
                )
            )


def gains_at(facts: Facts, rate_hz: float, shares: Sequence[float] | FloatArray) -> Gains:
    """Return the gains of an axis for shares (6,) between 0 and 1, in the order of ``VARIABLES``.

    :data:`USUAL` ones are far from the edge of stability, with the filters that suit the axis.
    """
    rate = 2.0 * pi * facts.pace_hz
    integral = rate * _between(_INTEGRAL, shares[0])
    lowest = min(_LOW_PASS * facts.pace_hz, 0.5 * _HIGHEST_SHARE * rate_hz)
    notch = None
    if facts.frequency_hz > 0.0:
        damping = _between(_NOTCH, shares[4])
        depth = min(max(facts.damping_ratio / damping, _DEEPEST), _SHALLOWEST)
        notch = Notch(facts.frequency_hz, damping, depth)
    return with_amounts(
        Gains(
            derivative_filter_s=_DERIVATIVE_FILTER / rate,
            low_pass_hz=_between((lowest, _HIGHEST_SHARE * rate_hz), shares[3]),
            notch=notch,
        ),
        proportional=_PROPORTIONAL * float(shares[1]),
        integral=integral,
        double_integral=_DOUBLE * rate * integral * float(shares[5]) ** 2,
        derivative=_DERIVATIVE / rate * float(shares[2]),
    )


def with_amounts(
    gains: Gains, *, proportional: float, integral: float, double_integral: float, derivative: float
) -> Gains:
    """Return gains with other amounts, and an integral that is led back in its own time."""
    return replace(
        gains,
        proportional=proportional,
        integral=integral,
        double_integral=double_integral,
        derivative=derivative,
        tracking_s=_TRACKING / integral if integral > 0.0 else gains.tracking_s,
    )


def most_of(facts: Facts) -> dict[str, float]:
    """Return the greatest amounts that are searched, by their names in :class:`Gains`."""
    rate = 2.0 * pi * facts.pace_hz
    integral = rate * _INTEGRAL[1]
    return {
        "proportional": _PROPORTIONAL,
        "integral": integral,
        "double_integral": _DOUBLE * rate * integral,
        "derivative": _DERIVATIVE / rate,
    }


def _between(bounds: tuple[float, float], share: float) -> float:
    """Return what lies a share of the way between two bounds, by its logarithm."""
    low, high = bounds
    return float(low * np.exp(share * log(high / low)))

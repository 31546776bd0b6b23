"""The gains of one axis as a search problem: from numbers between 0 and 1 to figures.

The axis is evaluated with its nominal gain and resonance, and with both changed by ±5 % in all four
combinations. Ms is the worst of these five. The motion, with effects, noise and rounding, is
simulated for three of them: nominal, more gain with a lower resonance (the least damped) and less
gain with a higher resonance (the slowest). The other figures are the worst of these three.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import log, pi

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.effects import AxisProperties
from rotemina.sim.errors import TuningError
from rotemina.sim.feedback import (
    DEFAULT_SPREAD,
    MAX_PEAK_SENSITIVITY,
    AxisLoop,
    ControllerGains,
    FeedForward,
    LoopAnalysis,
    LoopTraces,
    NotchFilter,
    SampledInverse,
    check_stability,
    compute_lead_taps,
    compute_sensitivity_peak,
    make_spread_loops,
)
from rotemina.sim.messages import format_rounded
from rotemina.sim.robot import Robot
from rotemina.sim.tuning.performance_figures import (
    INFINITE_FIGURES,
    TuningFigures,
    compute_figures,
    worst_figures,
)
from rotemina.sim.tuning.tuning_scenario import TuningScenario, make_step, make_triangle

VARIABLES = (
    "integral",
    "proportional",
    "derivative",
    "low_pass_hz",
    "notch_damping",
    "double_integral",
)
# Shares of cautious gains: an integral alone, with Ms of about 1.2 on a piezo.
DEFAULT_SHARES = (0.3, 0.0, 0.0, 0.5, 0.5, 0.0)
# Seed of the noise, which is the same for every individual.
_NOISE_SEED = 20_101
# Bounds of the gains relative to the resonance ω of the axis: I/ω, P, D ω, and J/(I ω) for the
# double integral J.
_INTEGRAL_RANGE, _MAX_PROPORTIONAL, _MAX_DERIVATIVE, _MAX_DOUBLE_INTEGRAL = (
    (0.02, 2.0),
    1.0,
    0.5,
    0.3,
)
# Bounds of the filters: smallest ratio of low-pass to resonance, largest ratio of low-pass to rate,
# and damping ratio of the notch.
_MIN_LOW_PASS_RATIO, _MAX_LOW_PASS_RATE_RATIO, _NOTCH_DAMPING_RANGE = 0.5, 0.45, (0.1, 2.0)
# Time constant of the derivative filter times ω.
_DERIVATIVE_FILTER_RATIO = 0.1
# Bounds of the depth of the notch.
_MAX_NOTCH_DEPTH, _MIN_NOTCH_DEPTH = 0.5, 0.01
# Time constant of the anti-windup times the integral gain.
_TRACKING_RATIO = 2.0


@dataclass(frozen=True, slots=True, kw_only=True)
class TuningConstraints:
    """Limits for every point of a front.

    In addition, the output may not be limited in any sample.

    Attributes
    ----------
    peak_sensitivity : float
        Largest Ms.
    overshoot : float
        Largest overshoot as a share of the step.
    """

    peak_sensitivity: float = MAX_PEAK_SENSITIVITY
    overshoot: float = 0.02


@dataclass(frozen=True, slots=True, eq=False)
class ScenarioEvaluation:
    """Result of a loop on one scenario: the feed-forward (n,) and the simulated traces."""

    scenario: TuningScenario
    feed: FloatArray
    traces: LoopTraces


class TuningProblem:
    """The loop of one axis as a tuning problem.

    Parameters
    ----------
    robot : Robot
        Robot with the effects to simulate.
    axis : str
    rate_hz : float
        Rate of the loop.
    delay : int
        Delay of the output in sampling intervals.
    inverse : SampledInverse, optional
        Inverse in the feed-forward, at the rate of the loop, without its own lag compensation.
    constraints : TuningConstraints
    spread : float
        Relative deviation of gain and resonance from their nominal values.

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
        constraints: TuningConstraints | None = None,
        spread: float = DEFAULT_SPREAD,
    ) -> None:
        self.robot, self.axis, self.rate_hz, self.delay = robot, axis, rate_hz, delay
        self.constraints, self.spread = constraints or TuningConstraints(), spread
        self._variants = make_spread_loops(robot, axis, rate_hz, delay=delay, spread=spread)
        self.loop = self._variants[0]
        robot_axis = self.loop.robot_axis
        self._properties = AxisProperties.of(robot_axis)
        self._has_resonance = self._properties.frequency_hz > 0.0
        self._check_rate()
        self._analyses = [LoopAnalysis(variant.sampled_axis) for variant in self._variants]
        # The least damped and the slowest variant are in the middle of the four corners.
        self._simulated_variants = (
            self._variants if len(self._variants) < 4 else [self._variants[k] for k in (0, 2, 3)]
        )
        feed_forward = FeedForward(
            compute_lead_taps(robot_axis, 1.0 / rate_hz, delay=delay), inverse
        )
        scenarios = make_step(robot_axis, rate_hz), make_triangle(robot_axis, rate_hz)
        self._scenarios = [
            (scenario, feed_forward.run(scenario.reference)) for scenario in scenarios
        ]

    def gains_of(self, shares: Sequence[float] | FloatArray) -> ControllerGains:
        """Return the gains for shares (6,) between 0 and 1, in the order of ``VARIABLES``."""
        return gains_from_shares(self._properties, self.rate_hz, shares)

    def evaluate(self, gains: ControllerGains) -> TuningFigures:
        """Return the worst figures of all variants; all infinite if one of them is unstable.

        If Ms exceeds its limit, nothing is simulated and the other figures are infinite.
        """
        peak = max(compute_sensitivity_peak(analysis, gains) for analysis in self._analyses)
        if peak > self.constraints.peak_sensitivity:
            return replace(INFINITE_FIGURES, peak_sensitivity=peak)
        evaluations = [self._run_scenarios(loop, gains) for loop in self._simulated_variants]
        return worst_figures(
            [self._compute_figures(step, triangle, peak) for step, triangle in evaluations]
        )

    def try_out(
        self, gains: ControllerGains
    ) -> tuple[tuple[ScenarioEvaluation, ScenarioEvaluation], TuningFigures]:
        """Return step and triangle of the nominal axis, and the figures of these two.

        Raises
        ------
        UnstableError
            If the loop is unstable or exceeds the limit of Ms. Nothing is simulated then.
        """
        stability = check_stability(
            self.loop.sampled_axis, gains, self.constraints.peak_sensitivity
        )
        step, triangle = self._run_scenarios(self.loop, gains)
        return (step, triangle), self._compute_figures(step, triangle, stability.peak_sensitivity)

    def _run_scenarios(
        self, loop: AxisLoop, gains: ControllerGains
    ) -> tuple[ScenarioEvaluation, ScenarioEvaluation]:
        step, triangle = (
            ScenarioEvaluation(
                scenario,
                feed,
                loop.follow(
                    gains, scenario.reference, feed=feed, rng=np.random.default_rng(_NOISE_SEED)
                ),
            )
            for scenario, feed in self._scenarios
        )
        return step, triangle

    def _compute_figures(
        self, step: ScenarioEvaluation, triangle: ScenarioEvaluation, peak: float
    ) -> TuningFigures:
        return compute_figures(
            (step.scenario, step.traces, step.feed),
            (triangle.scenario, triangle.traces, triangle.feed),
            span=self._properties.span,
            floor=self._properties.noise,
            peak_sensitivity=peak,
        )

    def _check_rate(self) -> None:
        if self._has_resonance and self._properties.frequency_hz >= 0.4 * self.rate_hz:
            raise TuningError(
                "axis {axis}: a loop at {rate_hz} Hz is too slow for a resonance at "
                "{frequency_hz} Hz; use a rate above {least_hz} Hz",
                axis=self.axis,
                rate_hz=self.rate_hz,
                frequency_hz=format_rounded(self._properties.frequency_hz, 4),
                least_hz=format_rounded(2.5 * self._properties.frequency_hz, 4),
            )


def gains_from_shares(
    facts: AxisProperties, rate_hz: float, shares: Sequence[float] | FloatArray
) -> ControllerGains:
    """Return the gains of an axis for shares (6,) between 0 and 1, in the order of ``VARIABLES``.

    The shares :data:`DEFAULT_SHARES` give gains far from the stability limit, with filters that
    suit the axis.
    """
    omega = 2.0 * pi * facts.pace_hz
    integral = omega * _interpolate_log(_INTEGRAL_RANGE, shares[0])
    min_low_pass_hz = min(
        _MIN_LOW_PASS_RATIO * facts.pace_hz, 0.5 * _MAX_LOW_PASS_RATE_RATIO * rate_hz
    )
    notch = None
    if facts.frequency_hz > 0.0:
        damping = _interpolate_log(_NOTCH_DAMPING_RANGE, shares[4])
        depth = min(max(facts.damping_ratio / damping, _MIN_NOTCH_DEPTH), _MAX_NOTCH_DEPTH)
        notch = NotchFilter(facts.frequency_hz, damping, depth)
    return with_gain_amounts(
        ControllerGains(
            derivative_filter_s=_DERIVATIVE_FILTER_RATIO / omega,
            low_pass_hz=_interpolate_log(
                (min_low_pass_hz, _MAX_LOW_PASS_RATE_RATIO * rate_hz), shares[3]
            ),
            notch=notch,
        ),
        proportional=_MAX_PROPORTIONAL * float(shares[1]),
        integral=integral,
        double_integral=_MAX_DOUBLE_INTEGRAL * omega * integral * float(shares[5]) ** 2,
        derivative=_MAX_DERIVATIVE / omega * float(shares[2]),
    )


def with_gain_amounts(
    gains: ControllerGains,
    *,
    proportional: float,
    integral: float,
    double_integral: float,
    derivative: float,
) -> ControllerGains:
    """Return the gains with other amounts and the anti-windup time that suits the integral."""
    return replace(
        gains,
        proportional=proportional,
        integral=integral,
        double_integral=double_integral,
        derivative=derivative,
        tracking_s=_TRACKING_RATIO / integral if integral > 0.0 else gains.tracking_s,
    )


def max_gain_amounts(facts: AxisProperties) -> dict[str, float]:
    """Return the largest amounts in the search, by their names in :class:`ControllerGains`."""
    omega = 2.0 * pi * facts.pace_hz
    integral = omega * _INTEGRAL_RANGE[1]
    return {
        "proportional": _MAX_PROPORTIONAL,
        "integral": integral,
        "double_integral": _MAX_DOUBLE_INTEGRAL * omega * integral,
        "derivative": _MAX_DERIVATIVE / omega,
    }


def _interpolate_log(bounds: tuple[float, float], share: float) -> float:
    low, high = bounds
    return float(low * np.exp(share * log(high / low)))

"""A sampled PI or PID controller with notch, low-pass, feed-forward and limits.

The simulated loop, the live loop and the analysis of stability use the same recurrence
(:func:`rotemina.sim.feedback.controller_kernel.control`).
"""

from math import exp, isfinite

import numpy as np

from rotemina.sim.arrays import (
    BoolArray,
    ComplexArray,
    FloatArray,
)
from rotemina.sim.errors import FeedbackError
from rotemina.sim.feedback import controller_kernel
from rotemina.sim.feedback.feed_forward import FeedForward
from rotemina.sim.feedback.filters import PASS_THROUGH, Biquad, design_low_pass, design_notch
from rotemina.sim.feedback.gains import AntiWindup, ControllerGains, OutputLimits

NO_LIMITS = OutputLimits()
# Without a bound, every finite error is used.
_MAX_ERROR = float(np.finfo(np.float64).max)


class SampledController:
    """A controller that computes the output to an axis sample by sample, after :meth:`start`.

    Parameters
    ----------
    gains : ControllerGains
    interval_s : float
        Interval of the samples.
    limits : OutputLimits
    feed_forward : FeedForward, optional
        Gives the output for a reference without feedback; by default, the reference itself.

    Raises
    ------
    FeedbackError
        If a filter does not suit the rate, or the interval is not positive and finite.
    """

    def __init__(
        self,
        gains: ControllerGains,
        interval_s: float,
        limits: OutputLimits = NO_LIMITS,
        feed_forward: FeedForward | None = None,
    ) -> None:
        #: Parameters of the recurrence, and its memory, which each step updates.
        self.numbers = make_controller_parameters(gains, interval_s, limits)
        self._limits = limits.low, limits.high
        self.memory = np.zeros(controller_kernel.MEMORY_COUNT)
        self.feed_forward = feed_forward or FeedForward()
        self.interval_s = interval_s
        #: Initial value of the integral, m or rad, and number of samples for which the sensor has
        #: been too far from its reference.
        self.initial_integral, self.lost_count = 0.0, 0

    def start(self, reference: float, output: float | None = None) -> None:
        """Set a state of rest at a reference, with an output that holds the axis there.

        Without ``output`` it is the output of the feed-forward. The controller takes over without a
        jump, because the integral begins with the difference.
        """
        feed = self.feed_forward.start(reference)
        self.memory[:] = make_rest_memory(self.numbers, feed, feed if output is None else output)
        self.initial_integral = self.integral

    def hold_output(self, max_change: float) -> None:
        """Keep the output within ``max_change`` (m or rad) of its present value.

        Readings that differ from the reference by more are ignored. :meth:`release_output` ends
        both restrictions.
        """
        low, high = self._limits
        self.numbers[controller_kernel.LOW] = max(low, self.output - max_change)
        self.numbers[controller_kernel.HIGH] = min(high, self.output + max_change)
        self.numbers[controller_kernel.MAX_PLAUSIBLE_ERROR] = max_change

    def release_output(self) -> None:
        """Permit outputs up to the limits again, after :meth:`hold_output`."""
        self.numbers[controller_kernel.LOW], self.numbers[controller_kernel.HIGH] = self._limits
        self.numbers[controller_kernel.MAX_PLAUSIBLE_ERROR] = _MAX_ERROR

    def step(self, reference: float, measured: float) -> float:
        """Return the output of this sample, m or rad, which is held until the next one.

        Raises
        ------
        FeedbackError
            If the reference or the reading is not finite. The controller keeps its state.
        """
        if not (isfinite(reference) and isfinite(measured)):
            raise FeedbackError(
                "controller: reference {reference}, measured {measured}: both must be finite; "
                "hold the last output until the sensor answers again",
                reference=reference,
                measured=measured,
            )
        return self.respond_to_sample(reference, measured)

    def respond_to_sample(self, reference: float, measured: float) -> float:
        """Return the output of this sample, or the previous one if no output can be computed.

        That happens if a number is not finite, or if the reading of a held loop is implausible. The
        feed-forward advances in any case, as on a machine, which cannot wait.
        """
        feed = self.feed_forward.step(reference)
        error = reference - measured
        if not (
            abs(error) <= self.numbers[controller_kernel.MAX_PLAUSIBLE_ERROR] and isfinite(feed)
        ):
            return self.output
        return float(controller_kernel.control(self.numbers, self.memory, error, feed))

    @property
    def output(self) -> float:
        """The last output, m or rad."""
        return float(self.memory[controller_kernel.OUTPUT])

    @property
    def is_limited(self) -> bool:
        """Whether a limit cut off the last output."""
        return bool(
            self.memory[controller_kernel.OUTPUT] != self.memory[controller_kernel.UNLIMITED_OUTPUT]
        )

    def find_unlimited(self, output: FloatArray) -> BoolArray:
        """Return which outputs (n,) lie strictly inside the limits."""
        low, high = self.numbers[controller_kernel.LOW], self.numbers[controller_kernel.HIGH]
        return np.asarray((output > low) & (output < high))

    @property
    def integral(self) -> float:
        """The contribution of the integral to the output, m or rad."""
        return float(self.memory[controller_kernel.INTEGRAL])


def make_controller_parameters(
    gains: ControllerGains, interval_s: float, limits: OutputLimits
) -> FloatArray:
    """Return the parameters of the recurrence.

    Raises
    ------
    FeedbackError
        If a filter does not suit the rate, or the interval is not positive and finite.
    """
    if not (isfinite(interval_s) and interval_s > 0.0):
        raise FeedbackError(
            "loop interval {interval_s} s: must be positive and finite", interval_s=interval_s
        )
    pole = _compute_derivative_pole(gains, interval_s)
    numbers = np.zeros(controller_kernel.NUMBER_COUNT)
    numbers[controller_kernel.P] = gains.proportional
    numbers[controller_kernel.I_STEP] = gains.integral * interval_s
    numbers[controller_kernel.J_STEP] = gains.double_integral * interval_s**2
    numbers[controller_kernel.D_STEP] = gains.derivative * (1.0 - pole) / interval_s
    numbers[controller_kernel.D_POLE] = pole
    has_integral = gains.integral > 0.0 or gains.double_integral > 0.0
    numbers[controller_kernel.BACK] = (
        min(interval_s / gains.tracking_s, 1.0) if has_integral else 0.0
    )
    numbers[controller_kernel.CONDITIONAL] = gains.anti_windup is AntiWindup.CONDITIONAL
    numbers[controller_kernel.LOW], numbers[controller_kernel.HIGH] = limits.low, limits.high
    numbers[controller_kernel.MAX_STEP] = limits.rate * interval_s
    numbers[controller_kernel.MAX_PLAUSIBLE_ERROR] = _MAX_ERROR
    for first_index, biquad in zip(
        (controller_kernel.NOTCH, controller_kernel.LOW_PASS),
        _make_filters(gains, interval_s),
        strict=True,
    ):
        numbers[first_index : first_index + len(biquad)] = biquad
    return numbers


def make_rest_memory(numbers: FloatArray, feed: float, output: float) -> FloatArray:
    """Return the memory of a controller at rest, with ``output`` clipped to its limits."""
    state = np.zeros(controller_kernel.MEMORY_COUNT)
    output = min(max(output, numbers[controller_kernel.LOW]), numbers[controller_kernel.HIGH])
    state[controller_kernel.INTEGRAL] = output - feed
    state[controller_kernel.OUTPUT] = state[controller_kernel.UNLIMITED_OUTPUT] = output
    return state


def compute_response(gains: ControllerGains, interval_s: float, z: ComplexArray) -> ComplexArray:
    """Return the frequency response (…,) from error to output at points of the unit circle."""
    notch, low_pass = _make_filters(gains, interval_s)
    pole, z_inverse = _compute_derivative_pole(gains, interval_s), 1.0 / z
    integrals = gains.integral * interval_s + gains.double_integral * interval_s**2 / (
        1.0 - z_inverse
    )
    sum_of_terms = gains.proportional + integrals / (1.0 - z_inverse)
    sum_of_terms = sum_of_terms + gains.derivative * (1.0 - pole) / interval_s * (
        1.0 - z_inverse
    ) / (1.0 - pole * z_inverse)
    return np.asarray(notch.compute_response(z) * low_pass.compute_response(z) * sum_of_terms)


def _compute_derivative_pole(gains: ControllerGains, interval_s: float) -> float:
    """Return the pole a of the derivative's filter, which gives the slope of a ramp exactly."""
    time_constant_s = gains.derivative_filter_s
    return exp(-interval_s / time_constant_s) if time_constant_s > 0.0 else 0.0


def _make_filters(gains: ControllerGains, interval_s: float) -> tuple[Biquad, Biquad]:
    rate_hz, settings = 1.0 / interval_s, gains.notch
    notch = (
        design_notch(settings.frequency_hz, settings.damping, settings.depth, rate_hz)
        if settings
        else PASS_THROUGH
    )
    low_pass = design_low_pass(gains.low_pass_hz, rate_hz) if gains.low_pass_hz else PASS_THROUGH
    return notch, low_pass

"""A sampled PI or PID controller with notch, low-pass, feed-forward and limits.

One recurrence (:func:`rotemina.sim.feedback.controller_kernel.control`) serves the simulated loop,
the live one, and the analysis of stability.
"""

from math import exp, isfinite

import numpy as np

from rotemina.sim.arrays import BoolArray, ComplexArray, FloatArray
from rotemina.sim.feedback import controller_kernel
from rotemina.sim.feedback.errors import FeedbackError
from rotemina.sim.feedback.feed_forward import FeedForward
from rotemina.sim.feedback.filters import THROUGH, Biquad, low_pass, notch
from rotemina.sim.feedback.gains import AntiWindup, Gains, OutputLimits
from rotemina.sim.messages import message

NO_LIMITS = OutputLimits()
_ANY = float(np.finfo(np.float64).max)  # of finite errors


class Controller:
    """Computes the request to an axis, sample by sample; begin with :meth:`start`.

    Parameters
    ----------
    gains : Gains
    interval_s : float
        From sample to sample.
    limits : OutputLimits
    feed_forward : FeedForward, optional
        What is requested a reference without feedback; the reference itself without.

    Raises
    ------
    FeedbackError
        If a filter does not fit the rate, or the interval is none.
    """

    def __init__(
        self,
        gains: Gains,
        interval_s: float,
        limits: OutputLimits = NO_LIMITS,
        feed_forward: FeedForward | None = None,
    ) -> None:
        #: Of the recurrence, and what it remembers, which it moves on.
        self.numbers = numbers_of(gains, interval_s, limits)
        self._limits = limits.low, limits.high
        self.memory = np.zeros(controller_kernel.MEMORY)
        self.feed_forward = feed_forward or FeedForward()
        self.interval_s = interval_s
        #: What the integral added when it began, m or rad; for how many samples now the sensor has
        #: been too far off.
        self.begun_at, self.astray = 0.0, 0

    def start(self, reference: float, output: float | None = None) -> None:
        """Rest at a reference, with an output that holds the axis there.

        Without ``output`` it is what the feed-forward asks for. The controller takes over without
        a jump: the integral begins with the difference.
        """
        feed = self.feed_forward.start(reference)
        self.memory[:] = rested(self.numbers, feed, feed if output is None else output)
        self.begun_at = self.integral

    def hold(self, most: float) -> None:
        """Keep the output within ``most`` (m or rad) of its present value, until :meth:`lead`.

        A reading that is farther from the reference is not answered at all.
        """
        low, high = self._limits
        self.numbers[controller_kernel.LOW] = max(low, self.output - most)
        self.numbers[controller_kernel.HIGH] = min(high, self.output + most)
        self.numbers[controller_kernel.BELIEVED] = most

    def lead(self) -> None:
        """Let the output go as far as the limits allow again."""
        self.numbers[controller_kernel.LOW], self.numbers[controller_kernel.HIGH] = self._limits
        self.numbers[controller_kernel.BELIEVED] = _ANY

    def step(self, reference: float, measured: float) -> float:
        """Return the output of this sample, m or rad, held until the next.

        Raises
        ------
        FeedbackError
            If a number is not finite; the controller is as before then.
        """
        if not (isfinite(reference) and isfinite(measured)):
            raise FeedbackError(
                message(
                    "engine",
                    "controller: reference {reference}, measured {measured}: both must be finite; "
                    "hold the last output until the sensor answers again",
                ).fill(reference=reference, measured=measured)
            )
        return self.answer(reference, measured)

    def answer(self, reference: float, measured: float) -> float:
        """Return the output of this sample, or the last one again where none can be found.

        That is where a number is not finite, or the reading of a held loop not believed. The
        feed-forward continues all the same, as a machine's does, which cannot wait.
        """
        feed = self.feed_forward.step(reference)
        error = reference - measured
        if not (abs(error) <= self.numbers[controller_kernel.BELIEVED] and isfinite(feed)):
            return self.output
        return float(controller_kernel.control(self.numbers, self.memory, error, feed))

    @property
    def output(self) -> float:
        """The last output, m or rad."""
        return float(self.memory[controller_kernel.OUTPUT])

    @property
    def limited(self) -> bool:
        """Whether a limit cut the last output off."""
        return bool(self.memory[controller_kernel.OUTPUT] != self.memory[controller_kernel.ASKED])

    def within(self, output: FloatArray) -> BoolArray:
        """Return which outputs (n,) lie inside the limits, and not at them."""
        low, high = self.numbers[controller_kernel.LOW], self.numbers[controller_kernel.HIGH]
        return np.asarray((output > low) & (output < high))

    @property
    def integral(self) -> float:
        """What the integral adds to the output, m or rad."""
        return float(self.memory[controller_kernel.INTEGRAL])


def numbers_of(gains: Gains, interval_s: float, limits: OutputLimits) -> FloatArray:
    """Return the numbers of the recurrence."""
    if not (isfinite(interval_s) and interval_s > 0.0):
        raise FeedbackError(
            message("engine", "loop interval {interval_s} s: must be positive and finite").fill(
                interval_s=interval_s
            )
        )
    pole = _pole(gains, interval_s)
    numbers = np.zeros(controller_kernel.NUMBERS)
    numbers[controller_kernel.P] = gains.proportional
    numbers[controller_kernel.I_STEP] = gains.integral * interval_s
    numbers[controller_kernel.J_STEP] = gains.double_integral * interval_s**2
    numbers[controller_kernel.D_STEP] = gains.derivative * (1.0 - pole) / interval_s
    numbers[controller_kernel.D_POLE] = pole
    integrates = gains.integral > 0.0 or gains.double_integral > 0.0
    numbers[controller_kernel.BACK] = min(interval_s / gains.tracking_s, 1.0) if integrates else 0.0
    numbers[controller_kernel.CONDITIONAL] = gains.anti_windup is AntiWindup.CONDITIONAL
    numbers[controller_kernel.LOW], numbers[controller_kernel.HIGH] = limits.low, limits.high
    numbers[controller_kernel.MOST] = limits.rate * interval_s
    numbers[controller_kernel.BELIEVED] = _ANY
    for place, biquad in zip(
        (controller_kernel.NOTCH, controller_kernel.LOW_PASS),
        _filters(gains, interval_s),
        strict=True,
    ):
        numbers[place : place + len(biquad)] = biquad
    return numbers


def rested(numbers: FloatArray, feed: float, output: float) -> FloatArray:
    """Return the memory of a controller at rest, with ``output`` within its limits."""
    state = np.zeros(controller_kernel.MEMORY)
    output = min(max(output, numbers[controller_kernel.LOW]), numbers[controller_kernel.HIGH])
    state[controller_kernel.INTEGRAL] = output - feed
    state[controller_kernel.OUTPUT] = state[controller_kernel.ASKED] = output
    return state


def response(gains: Gains, interval_s: float, z: ComplexArray) -> ComplexArray:
    """Return the frequency response (…,) from error to output at points of the unit circle."""
    first, second = _filters(gains, interval_s)
    pole, back = _pole(gains, interval_s), 1.0 / z
    summed = gains.integral * interval_s + gains.double_integral * interval_s**2 / (1.0 - back)
    own = gains.proportional + summed / (1.0 - back)
    own = own + gains.derivative * (1.0 - pole) / interval_s * (1.0 - back) / (1.0 - pole * back)
    return np.asarray(first.response(z) * second.response(z) * own)


def _pole(gains: Gains, interval_s: float) -> float:
    """Return a of the derivative's filter, which keeps a ramp's slope exactly."""
    slow = gains.derivative_filter_s
    return exp(-interval_s / slow) if slow > 0.0 else 0.0


def _filters(gains: Gains, interval_s: float) -> tuple[Biquad, Biquad]:
    rate_hz, own = 1.0 / interval_s, gains.notch
    first = notch(own.frequency_hz, own.damping, own.depth, rate_hz) if own else THROUGH
    second = low_pass(gains.low_pass_hz, rate_hz) if gains.low_pass_hz else THROUGH
    return first, second

"""Stability of a loop: poles, margins and peak sensitivity.

With the loop's L = C G, ``S = 1/(1 + L)`` is what is left of a disturbance, and its peak Ms the
inverse of the least distance of L from −1; Ms ≤ 1.7 leaves a gain margin of at least
``Ms/(Ms − 1) = 2.4`` and a phase margin of at least ``2 asin(1/2Ms) = 34°`` (Åström and Hägglund,
"Advanced PID Control" (2006), sec. 4.6).
"""

from dataclasses import dataclass
from math import degrees, inf, pi

import numpy as np

from rotemina.sim.arrays import ComplexArray, FloatArray
from rotemina.sim.feedback import controller_kernel
from rotemina.sim.feedback.controller import NO_LIMITS, numbers_of, response
from rotemina.sim.feedback.errors import FeedbackError
from rotemina.sim.feedback.gains import Gains
from rotemina.sim.feedback.sampled_axis import SampledAxis
from rotemina.sim.messages import message
from rotemina.sim.quantities import rounded

PEAK_SENSITIVITY = 1.7
_EDGE = 1e-9  # a pole that is no nearer to the unit circle is taken to lie on it
_LOWEST = 1e-5  # of the rate: the first frequency that is looked at
_FREQUENCIES, _AROUND = 400, 60
_WIDTH = 6.0  # half of the band around a resonance that is looked at closely, in its half-widths


class UnstableError(FeedbackError):
    """Gains with which the loop would be unstable, or nearer to it than is allowed."""


@dataclass(frozen=True, slots=True, eq=False)
class LoopStability:
    """How stable a loop is.

    Attributes
    ----------
    poles : (r,) complex
        In z.
    gain_margin : float
        By what factor the loop's gain may grow; infinite where by any.
    gain_reduction : float
        To what share it may fall; 0 where to any.
    phase_margin_deg, delay_margin_s : float
        Infinite where the gain never is 1.
    peak_sensitivity, peak_hz : float
        Ms, and where.
    bandwidth_hz : float
        Below which less than 1/√2 is left of a disturbance; 0 without an integral.
    """

    poles: ComplexArray
    gain_margin: float
    gain_reduction: float
    phase_margin_deg: float
    delay_margin_s: float
    peak_sensitivity: float
    peak_hz: float
    bandwidth_hz: float

    @property
    def stable(self) -> bool:
        """Whether all poles lie inside the unit circle."""
        return self.radius < 1.0 - _EDGE

    @property
    def radius(self) -> float:
        """Amount of the largest pole."""
        return float(np.abs(self.poles).max(initial=0.0))


class LoopAnalysis:
    """Axes at one loop rate, whose responses are worked out once for many sets of gains."""

    def __init__(self, axis: SampledAxis) -> None:
        self.axis = axis
        self.frequency_hz = _frequencies(axis)
        self._z = np.exp(2j * pi * self.frequency_hz * axis.interval_s)
        self._response = axis.response(self._z)

    def loop(self, gains: Gains) -> ComplexArray:
        """Return L (m,) at ``frequency_hz`` (m,)."""
        return np.asarray(self._response * response(gains, self.axis.interval_s, self._z))

    def poles(self, gains: Gains) -> ComplexArray:
        """Return the poles (r,) of the closed loop, in z."""
        return np.asarray(np.linalg.eigvals(closed_loop(self.axis, gains)), dtype=np.complex128)

    def stability(self, gains: Gains) -> LoopStability:
        """Return poles, margins and peak sensitivity."""
        loop = self.loop(gains)
        sensitivity = 1.0 / np.abs(1.0 + loop)
        peak = int(np.argmax(sensitivity))
        reduction, margin = _gain_margins(loop)
        phase_deg, delay_s = _phase_margins(loop, self.frequency_hz)
        passed = np.flatnonzero(sensitivity >= 1.0 / np.sqrt(2.0))
        bandwidth_hz = float(self.frequency_hz[passed[0]]) if len(passed) and passed[0] else 0.0
        return LoopStability(
            self.poles(gains),
            margin,
            reduction,
            phase_deg,
            delay_s,
            float(sensitivity[peak]),
            float(self.frequency_hz[peak]),
            bandwidth_hz,
        )


def check_stability(
    axis: SampledAxis, gains: Gains, peak_sensitivity: float = PEAK_SENSITIVITY
) -> LoopStability:
    """Return how stable a loop is; gains that fail this check must not be applied.

    Raises
    ------
    UnstableError
        If it is unstable, or its peak sensitivity greater than allowed, with what tells so.
    """
    found = LoopAnalysis(axis).stability(gains)
    where = message("engine", "axis {axis}: loop at {interval_s} Hz").fill(
        axis=axis.axis, interval_s=rounded(1.0 / axis.interval_s, 6)
    )
    if not found.stable:
        raise UnstableError(
            message(
                "engine",
                "{where}: unstable, its largest pole {radius} is not inside the unit circle; lower "
                "the gains, or put a notch at the resonance; nothing was applied",
            ).fill(where=where, radius=rounded(found.radius, 6))
        )
    if found.peak_sensitivity > peak_sensitivity:
        raise UnstableError(
            message(
                "engine",
                "{where}: peak sensitivity Ms = {peak} at {peak_hz} Hz, must be at most "
                "{most}; lower the gains; nothing was applied",
            ).fill(
                where=where,
                peak=rounded(found.peak_sensitivity, 3),
                peak_hz=rounded(found.peak_hz, 4),
                most=peak_sensitivity,
            )
        )
    return found


def closed_loop(axis: SampledAxis, gains: Gains) -> FloatArray:
    """Return the matrix of ``[x_k, u_{k−1}, …, u_{k−d−1}, s_k]`` to the next sample, (r, r).

    s are the controller's memory; its share is read off the recurrence that runs.
    """
    own, into, out, through = controller_matrices(gains, axis.interval_s)
    n, late = len(axis.a), axis.delay + (1 if axis.through else 0)
    size = n + late + len(own)
    position = np.zeros(size)
    position[:n] = axis.c
    if axis.through:
        position[n + axis.delay] = axis.through
    output = -through * position
    output[n + late :] += out
    # Row j of ``inputs`` gives u_{k−j}.
    inputs = np.vstack([output, np.eye(size)[n : n + late]])
    matrix = np.zeros((size, size))
    matrix[:n, :n] = axis.a
    matrix[:n] += np.outer(axis.b, inputs[axis.delay])
    matrix[n : n + late] = inputs[:late]
    matrix[n + late :] = -np.outer(into, position)
    matrix[n + late :, n + late :] += own
    return matrix


def controller_matrices(
    gains: Gains, interval_s: float
) -> tuple[FloatArray, FloatArray, FloatArray, float]:
    """Return A, b, c, d of the controller from error to output, away from its limits.

    Found by running its recurrence once for each state and once for the input.
    """
    numbers = numbers_of(gains, interval_s, NO_LIMITS)
    size = controller_kernel.LINEAR
    columns, outputs = np.zeros((size, size + 1)), np.zeros(size + 1)
    for column in range(size + 1):
        memory = np.zeros(controller_kernel.MEMORY)
        memory[:size] = np.eye(1, size, column)[0]
        outputs[column] = controller_kernel.control(numbers, memory, float(column == size), 0.0)
        columns[:, column] = memory[:size]
    # An integral that nothing is added to would stand as a pole at 1.
    kept = np.ones(size, dtype=np.bool_)
    kept[controller_kernel.INTEGRAL] = gains.integral > 0.0 or gains.double_integral > 0.0
    kept[controller_kernel.DRIFT] = gains.double_integral > 0.0
    matrix = columns[np.ix_(kept, np.append(kept, False))]
    return matrix, columns[kept, size], outputs[:size][kept], float(outputs[size])


def sensitivity_peak(analysis: LoopAnalysis, gains: Gains) -> float:
    """Return Ms; infinite where the loop is unstable."""
    if np.abs(analysis.poles(gains)).max(initial=0.0) >= 1.0 - _EDGE:
        return inf
    return float(1.0 / np.abs(1.0 + analysis.loop(gains)).min())


def _frequencies(axis: SampledAxis) -> FloatArray:
    """Return frequencies (m,) up to half the rate, closer around the resonances of the axis."""
    half_hz = 0.5 / axis.interval_s
    found = [np.geomspace(2.0 * _LOWEST * half_hz, half_hz, _FREQUENCIES)]
    poles = np.linalg.eigvals(axis.a).astype(complex) if len(axis.a) else np.zeros(0, complex)
    for pole in poles[(poles.imag > 0.0) & (np.abs(poles) > 0.0)]:
        rate = np.log(pole) / (2.0 * pi * axis.interval_s)  # −ζω/2π + iω/2π
        width = _WIDTH * max(abs(rate.real), 0.01 * rate.imag)
        found.append(np.linspace(rate.imag - width, rate.imag + width, _AROUND))
    every = np.unique(np.concatenate(found))
    return np.asarray(every[(every > 0.0) & (every <= half_hz)])


def _gain_margins(loop: ComplexArray) -> tuple[float, float]:
    """Return the greatest factor below 1, and the least above it, that puts L through −1."""
    imaginary, real = loop.imag, loop.real
    at = np.flatnonzero(imaginary[:-1] * imaginary[1:] < 0.0)
    share = imaginary[at] / (imaginary[at] - imaginary[at + 1])
    crossing = real[at] + share * (real[at + 1] - real[at])
    if real[-1] < 0.0:  # at half the rate L is real
        crossing = np.append(crossing, real[-1])
    factors = -1.0 / crossing[crossing < 0.0]
    return (
        float(factors[factors <= 1.0].max(initial=0.0)),
        float(factors[factors > 1.0].min(initial=inf)),
    )


def _phase_margins(loop: ComplexArray, frequency_hz: FloatArray) -> tuple[float, float]:
    """Return the least phase margin, degrees, and the least delay that uses one up, s."""
    amount = np.log(np.maximum(np.abs(loop), np.finfo(np.float64).tiny))
    at = np.flatnonzero(amount[:-1] * amount[1:] < 0.0)
    if not len(at):
        return inf, inf
    share = amount[at] / (amount[at] - amount[at + 1])
    crossing = loop[at] + share * (loop[at + 1] - loop[at])
    where = frequency_hz[at] + share * (frequency_hz[at + 1] - frequency_hz[at])
    left = np.angle(-crossing)  # how much later L may come before it is at −1
    return (
        degrees(float(np.abs(left).min())),
        float((np.mod(left, 2.0 * pi) / (2.0 * pi * where)).min()),
    )

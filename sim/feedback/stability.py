"""Stability of a loop: poles, margins and peak sensitivity.

With the open loop L = C G, ``S = 1/(1 + L)`` is the share of a disturbance that remains. Its peak
Ms is the inverse of the smallest distance of L from −1. Ms ≤ 1.7 ensures a gain margin of at least
``Ms/(Ms − 1) = 2.4`` and a phase margin of at least ``2 asin(1/2Ms) = 34°`` (Åström and Hägglund,
"Advanced PID Control" (2006), sec. 4.6).
"""

from dataclasses import dataclass
from math import degrees, inf, pi

import numpy as np

from rotemina.sim.arrays import ComplexArray, FloatArray
from rotemina.sim.errors import UnstableError
from rotemina.sim.feedback import controller_kernel
from rotemina.sim.feedback.controller import NO_LIMITS, compute_response, make_controller_parameters
from rotemina.sim.feedback.gains import ControllerGains
from rotemina.sim.feedback.sampled_axis import SampledAxis
from rotemina.sim.messages import format_rounded, message

MAX_PEAK_SENSITIVITY = 1.7
# A pole this close to the unit circle counts as lying on it.
_UNIT_CIRCLE_TOLERANCE = 1e-9
# Ratio of the lowest frequency of the analysis to the sampling rate.
_MIN_FREQUENCY_SHARE = 1e-5
_FREQUENCY_COUNT, _RESONANCE_FREQUENCY_COUNT = 400, 60
# Frequencies are spaced more closely within this many half-widths of a resonance.
_RESONANCE_BAND_RATIO = 6.0


@dataclass(frozen=True, slots=True, eq=False)
class LoopStability:
    """The stability of a loop.

    Attributes
    ----------
    poles : (r,) complex
        In z.
    gain_margin : float
        Factor by which the loop's gain may grow; may be infinite.
    gain_reduction : float
        Factor to which the loop's gain may fall; may be 0.
    phase_margin_deg, delay_margin_s : float
        Infinite if the loop gain never crosses 1.
    peak_sensitivity, peak_hz : float
        Ms, and its frequency.
    bandwidth_hz : float
        Below it, less than 1/√2 of a disturbance remains. It is 0 without an integral.
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
    def is_stable(self) -> bool:
        """Whether all poles lie inside the unit circle."""
        return self.radius < 1.0 - _UNIT_CIRCLE_TOLERANCE

    @property
    def radius(self) -> float:
        """Magnitude of the largest pole."""
        return float(np.abs(self.poles).max(initial=0.0))


class LoopAnalysis:
    """The analysis of one axis with many sets of gains.

    The response of the axis is computed only once.
    """

    def __init__(self, axis: SampledAxis) -> None:
        self.axis = axis
        self.frequency_hz = _choose_frequencies(axis)
        self._z = np.exp(2j * pi * self.frequency_hz * axis.interval_s)
        self._axis_response = axis.compute_response(self._z)

    def compute_loop(self, gains: ControllerGains) -> ComplexArray:
        """Return L (m,) at ``frequency_hz`` (m,)."""
        return np.asarray(
            self._axis_response * compute_response(gains, self.axis.interval_s, self._z)
        )

    def compute_poles(self, gains: ControllerGains) -> ComplexArray:
        """Return the poles (r,) of the closed loop, in z."""
        return np.asarray(
            np.linalg.eigvals(build_closed_loop(self.axis, gains)), dtype=np.complex128
        )

    def compute_stability(self, gains: ControllerGains) -> LoopStability:
        """Return poles, margins and peak sensitivity."""
        loop = self.compute_loop(gains)
        sensitivity = 1.0 / np.abs(1.0 + loop)
        peak = int(np.argmax(sensitivity))
        reduction, margin = _find_gain_margins(loop)
        phase_deg, delay_s = _find_phase_margins(loop, self.frequency_hz)
        above_bandwidth = np.flatnonzero(sensitivity >= 1.0 / np.sqrt(2.0))
        bandwidth_hz = (
            float(self.frequency_hz[above_bandwidth[0]])
            if len(above_bandwidth) and above_bandwidth[0]
            else 0.0
        )
        return LoopStability(
            self.compute_poles(gains),
            margin,
            reduction,
            phase_deg,
            delay_s,
            float(sensitivity[peak]),
            float(self.frequency_hz[peak]),
            bandwidth_hz,
        )


def check_stability(
    axis: SampledAxis, gains: ControllerGains, peak_sensitivity: float = MAX_PEAK_SENSITIVITY
) -> LoopStability:
    """Return the stability of a loop; gains that fail this check must not be applied.

    Raises
    ------
    UnstableError
        If the loop is unstable, or its peak sensitivity exceeds the bound.
    """
    stability = LoopAnalysis(axis).compute_stability(gains)
    where = message("engine", "axis {axis}: loop at {interval_s} Hz").fill(
        axis=axis.axis, interval_s=format_rounded(1.0 / axis.interval_s, 6)
    )
    if not stability.is_stable:
        raise UnstableError(
            "{where}: unstable, its largest pole {radius} is not inside the unit circle; lower "
            "the gains, or put a notch at the resonance; nothing was applied",
            where=where,
            radius=format_rounded(stability.radius, 6),
        )
    if stability.peak_sensitivity > peak_sensitivity:
        raise UnstableError(
            "{where}: peak sensitivity Ms = {peak} at {peak_hz} Hz, must be at most "
            "{most}; lower the gains; nothing was applied",
            where=where,
            peak=format_rounded(stability.peak_sensitivity, 3),
            peak_hz=format_rounded(stability.peak_hz, 4),
            most=peak_sensitivity,
        )
    return stability


def build_closed_loop(axis: SampledAxis, gains: ControllerGains) -> FloatArray:
    """Return the matrix (r, r) from ``[x_k, u_{k−1}, …, u_{k−d−1}, s_k]`` to the next sample.

    s is the memory of the controller. Its part of the matrix is found by running the recurrence.
    """
    controller_states, input_vector, output_vector, feedthrough = compute_controller_matrices(
        gains, axis.interval_s
    )
    n, delay_count = len(axis.a), axis.delay + (1 if axis.through else 0)
    size = n + delay_count + len(controller_states)
    position = np.zeros(size)
    position[:n] = axis.c
    if axis.through:
        position[n + axis.delay] = axis.through
    output = -feedthrough * position
    output[n + delay_count :] += output_vector
    # Row j of ``inputs`` yields u_{k−j}.
    inputs = np.vstack([output, np.eye(size)[n : n + delay_count]])
    matrix = np.zeros((size, size))
    matrix[:n, :n] = axis.a
    matrix[:n] += np.outer(axis.b, inputs[axis.delay])
    matrix[n : n + delay_count] = inputs[:delay_count]
    matrix[n + delay_count :] = -np.outer(input_vector, position)
    matrix[n + delay_count :, n + delay_count :] += controller_states
    return matrix


def compute_controller_matrices(
    gains: ControllerGains, interval_s: float
) -> tuple[FloatArray, FloatArray, FloatArray, float]:
    """Return A, b, c, d of the controller from error to output, away from its limits.

    They are found by running its recurrence once for each state and once for the input.
    """
    numbers = make_controller_parameters(gains, interval_s, NO_LIMITS)
    size = controller_kernel.LINEAR_COUNT
    columns, outputs = np.zeros((size, size + 1)), np.zeros(size + 1)
    for column in range(size + 1):
        memory = np.zeros(controller_kernel.MEMORY_COUNT)
        memory[:size] = np.eye(1, size, column)[0]
        outputs[column] = controller_kernel.control(numbers, memory, float(column == size), 0.0)
        columns[:, column] = memory[:size]
    # An unused integral would remain as a pole at 1, so it is left out.
    is_used = np.ones(size, dtype=np.bool_)
    is_used[controller_kernel.INTEGRAL] = gains.integral > 0.0 or gains.double_integral > 0.0
    is_used[controller_kernel.DRIFT] = gains.double_integral > 0.0
    matrix = columns[np.ix_(is_used, np.append(is_used, False))]
    return matrix, columns[is_used, size], outputs[:size][is_used], float(outputs[size])


def compute_sensitivity_peak(analysis: LoopAnalysis, gains: ControllerGains) -> float:
    """Return Ms, or infinity if the loop is unstable."""
    if np.abs(analysis.compute_poles(gains)).max(initial=0.0) >= 1.0 - _UNIT_CIRCLE_TOLERANCE:
        return inf
    return float(1.0 / np.abs(1.0 + analysis.compute_loop(gains)).min())


def _choose_frequencies(axis: SampledAxis) -> FloatArray:
    half_hz = 0.5 / axis.interval_s
    parts = [np.geomspace(2.0 * _MIN_FREQUENCY_SHARE * half_hz, half_hz, _FREQUENCY_COUNT)]
    poles = np.linalg.eigvals(axis.a).astype(complex) if len(axis.a) else np.zeros(0, complex)
    for pole in poles[(poles.imag > 0.0) & (np.abs(poles) > 0.0)]:
        # −ζω/2π + iω/2π
        root_hz = np.log(pole) / (2.0 * pi * axis.interval_s)
        width = _RESONANCE_BAND_RATIO * max(abs(root_hz.real), 0.01 * root_hz.imag)
        parts.append(
            np.linspace(root_hz.imag - width, root_hz.imag + width, _RESONANCE_FREQUENCY_COUNT)
        )
    frequencies = np.unique(np.concatenate(parts))
    return np.asarray(frequencies[(frequencies > 0.0) & (frequencies <= half_hz)])


def _find_gain_margins(loop: ComplexArray) -> tuple[float, float]:
    """Return the largest gain factor up to 1, and the smallest above 1, at which L passes −1."""
    imaginary, real = loop.imag, loop.real
    rows = np.flatnonzero(imaginary[:-1] * imaginary[1:] < 0.0)
    fraction = imaginary[rows] / (imaginary[rows] - imaginary[rows + 1])
    crossings = real[rows] + fraction * (real[rows + 1] - real[rows])
    # At half the rate L is real.
    if real[-1] < 0.0:
        crossings = np.append(crossings, real[-1])
    factors = -1.0 / crossings[crossings < 0.0]
    return (
        float(factors[factors <= 1.0].max(initial=0.0)),
        float(factors[factors > 1.0].min(initial=inf)),
    )


def _find_phase_margins(loop: ComplexArray, frequency_hz: FloatArray) -> tuple[float, float]:
    """Return the smallest phase margin, degrees, and the smallest destabilising delay, s."""
    log_gain = np.log(np.maximum(np.abs(loop), np.finfo(np.float64).tiny))
    rows = np.flatnonzero(log_gain[:-1] * log_gain[1:] < 0.0)
    if not len(rows):
        return inf, inf
    fraction = log_gain[rows] / (log_gain[rows] - log_gain[rows + 1])
    crossings = loop[rows] + fraction * (loop[rows + 1] - loop[rows])
    crossing_hz = frequency_hz[rows] + fraction * (frequency_hz[rows + 1] - frequency_hz[rows])
    # L reaches −1 if it is delayed by this angle.
    margin = np.angle(-crossings)
    return (
        degrees(float(np.abs(margin).min())),
        float((np.mod(margin, 2.0 * pi) / (2.0 * pi * crossing_hz)).min()),
    )

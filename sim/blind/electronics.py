"""Electronics effects of the first generator: delay, lag, slew limit, saturation, quantisation.

Each function draws the shape of an effect at random. Its docstring says what the size measures.
"""

from math import pi

import numba
import numpy as np

from rotemina.sim.arrays import ComplexArray, FloatArray
from rotemina.sim.blind.filters import apply_low_pass, compute_mode_poles, delay_signal
from rotemina.sim.blind.part import BlindAxis, EffectPart, SignalStage, SimulationRun


def draw_delay(axis: BlindAxis, rng: np.random.Generator) -> EffectPart:
    """Draw a transport delay; the size is in seconds."""

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        return delay_signal(values, size / run.step_s)

    return EffectPart("delay", axis, SignalStage.DRIVE, act, (1e-4, 1.5e-2))


def _draw_lag_poles(rng: np.random.Generator) -> ComplexArray:
    """Draw one to three poles of a low-pass whose low-frequency delay is 1 s."""
    match rng.integers(4):
        case 0:
            poles = np.array([-1.0])
        case 1:
            poles = np.array([-1.0, -rng.uniform(1.5, 4.0)])
        case 2:
            poles = compute_mode_poles(1.0 / (2.0 * pi), rng.uniform(0.6, 1.0))
        case _:
            # Third-order Butterworth low-pass.
            poles = np.exp(1j * pi * np.array([2.0, 3.0, 4.0]) / 3.0)
    return np.asarray(poles * float(np.real(np.sum(-1.0 / poles))), np.complex128)


def draw_amplifier_lag(axis: BlindAxis, rng: np.random.Generator) -> EffectPart:
    """Draw an amplifier of limited bandwidth; the size is its low-frequency delay, s."""
    poles = _draw_lag_poles(rng)

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        return apply_low_pass(values, poles / size, run.step_s)

    return EffectPart("amplifier_lag", axis, SignalStage.DRIVE, act, (1e-4, 2e-2))


def draw_slew_limit(axis: BlindAxis, rng: np.random.Generator) -> EffectPart:
    """Draw a limited current into a capacitance.

    The size is 10 ranges/s divided by the maximum slew rate.
    """
    sharpness = rng.uniform(3.0, 12.0)

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        return _charge_capacitance(values, 10.0 * axis.span / size * run.step_s, sharpness)

    return EffectPart("slew_limit", axis, SignalStage.DRIVE, act, (1.0, 10.0))


@numba.njit(cache=True, error_model="numpy")
def _charge_capacitance(targets: FloatArray, limit: float, sharpness: float) -> FloatArray:
    """Return the voltage (n,) on a capacitance.

    The change in each step is softly limited to ``limit``.
    """
    voltage = np.empty_like(targets)
    voltage[0] = targets[0]
    for k in range(1, len(targets)):
        ratio = (targets[k] - voltage[k - 1]) / limit
        reduction = 1.0 / (1.0 + abs(ratio) ** sharpness) ** (1.0 / sharpness)
        if abs(ratio) > 1e6:
            reduction = 1.0 / abs(ratio)
        voltage[k] = voltage[k - 1] + limit * ratio * reduction
    return voltage


def draw_saturation(axis: BlindAxis, rng: np.random.Generator) -> EffectPart:
    """Draw an output that saturates softly before one or both ends of the range.

    The size is the distance from the ends, as a fraction of the range.
    """
    softness = axis.span * rng.uniform(0.002, 0.03)
    saturates_low, saturates_high = ((True, True), (True, False), (False, True))[rng.integers(3)]

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        lower_bend, upper_bend = axis.low + size * axis.span, axis.low + (1.0 - size) * axis.span
        out = values
        if saturates_low:
            out = lower_bend + softness * np.logaddexp(0.0, (out - lower_bend) / softness)
        if saturates_high:
            out = upper_bend - softness * np.logaddexp(0.0, (upper_bend - out) / softness)
        return np.asarray(out)

    return EffectPart("saturation", axis, SignalStage.DRIVE, act, (0.03, 0.45))


def draw_quantization(axis: BlindAxis, rng: np.random.Generator) -> EffectPart:
    """Draw a coarse converter or coarse micro-steps, mid-tread and with an offset.

    The size is the step, m or rad.
    """
    phase = rng.uniform()

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        return np.asarray((np.round(values / size + phase) - phase) * size)

    return EffectPart(
        "quantization", axis, SignalStage.DRIVE, act, (5.0 * axis.floor, 0.02 * axis.span)
    )

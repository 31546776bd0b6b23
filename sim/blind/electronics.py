"""Electronics of the generator: delay, lag, slew limit, saturation, coarse steps."""

from math import pi

import numba
import numpy as np

from rotemina.sim.arrays import ComplexArray, FloatArray
from rotemina.sim.blind.filters import lagged, mode_poles, shifted
from rotemina.sim.blind.part import Axis, Part, SimulationRun, Stage


def delay(axis: Axis, rng: np.random.Generator) -> Part:
    """Transport delay; size in seconds."""

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        return shifted(values, size / run.step_s)

    return Part("delay", axis, Stage.DRIVE, act, (1e-4, 1.5e-2))


def _lag_poles(rng: np.random.Generator) -> ComplexArray:
    """Draw a low-pass whose low-frequency delay is 1 s: one to three poles, in various places."""
    match rng.integers(4):
        case 0:
            poles = np.array([-1.0])
        case 1:
            poles = np.array([-1.0, -rng.uniform(1.5, 4.0)])
        case 2:
            poles = mode_poles(1.0 / (2.0 * pi), rng.uniform(0.6, 1.0))
        case _:
            poles = np.exp(1j * pi * np.array([2.0, 3.0, 4.0]) / 3.0)  # Butterworth
    return np.asarray(poles * float(np.real(np.sum(-1.0 / poles))), np.complex128)


def amplifier_lag(axis: Axis, rng: np.random.Generator) -> Part:
    """Bandwidth of the amplifier; size is its low-frequency delay in seconds."""
    poles = _lag_poles(rng)

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        return lagged(values, poles / size, run.step_s)

    return Part("amplifier_lag", axis, Stage.DRIVE, act, (1e-4, 2e-2))


def slew_limit(axis: Axis, rng: np.random.Generator) -> Part:
    """Limit the current into a capacitance; size is 10 ranges/s over the greatest rate."""
    sharpness = rng.uniform(3.0, 12.0)

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        return _charged(values, 10.0 * axis.span / size * run.step_s, sharpness)

    return Part("slew_limit", axis, Stage.DRIVE, act, (1.0, 10.0))


@numba.njit(cache=True, error_model="numpy")
def _charged(wanted: FloatArray, most: float, sharpness: float) -> FloatArray:
    """Voltage on the capacitance when the charge of one step is limited, softly, to ``most``."""
    held = np.empty_like(wanted)
    held[0] = wanted[0]
    for k in range(1, len(wanted)):
        asked = (wanted[k] - held[k - 1]) / most
        share = 1.0 / (1.0 + abs(asked) ** sharpness) ** (1.0 / sharpness)
        if abs(asked) > 1e6:
            share = 1.0 / abs(asked)
        held[k] = held[k - 1] + most * asked * share
    return held


def saturation(axis: Axis, rng: np.random.Generator) -> Part:
    """Output that bends over before the ends of the range as a diode conducts; size in ranges."""
    bend = axis.span * rng.uniform(0.002, 0.03)
    ends = ((True, True), (True, False), (False, True))[rng.integers(3)]

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        low, high = axis.low + size * axis.span, axis.low + (1.0 - size) * axis.span
        out = values
        if ends[0]:
            out = low + bend * np.logaddexp(0.0, (out - low) / bend)
        if ends[1]:
            out = high - bend * np.logaddexp(0.0, (high - out) / bend)
        return np.asarray(out)

    return Part("saturation", axis, Stage.DRIVE, act, (0.03, 0.45))


def quantization(axis: Axis, rng: np.random.Generator) -> Part:
    """Coarse converter or micro-steps, mid-tread and with an offset; size is the step, m or rad."""
    phase = rng.uniform()

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        return np.asarray((np.round(values / size + phase) - phase) * size)

    return Part("quantization", axis, Stage.DRIVE, act, (5.0 * axis.floor, 0.02 * axis.span))

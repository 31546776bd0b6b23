"""Actuator effects of the first generator: gain, curve, hysteresis, creep, steps and microsteps.

Each function draws the shape of an effect at random. Its docstring says what the size measures.
"""

from collections.abc import Callable
from math import pi

import numba
import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.blind.part import BlindAxis, EffectPart, SignalStage, SimulationRun
from rotemina.sim.blind.preisach import draw_plane, run_plane

Curve = Callable[[FloatArray], FloatArray]


def draw_curve(axis: BlindAxis, rng: np.random.Generator) -> Curve:
    """Draw a nonlinear curve over position, with values of the order of 1 over the travel."""
    curve_type = rng.integers(4)
    rate = rng.uniform(1.5, 3.5) * rng.choice([-1.0, 1.0])
    centre, period_count = rng.uniform(0.35, 0.65), rng.uniform(0.7, 1.0)

    def curve(position: FloatArray) -> FloatArray:
        x = (position - axis.start) / axis.travel
        if curve_type == 0:
            return np.asarray(np.sin(pi * x))
        if curve_type == 1:
            return np.asarray(np.expm1(rate * np.clip(x, -1.0, 2.0)) / np.expm1(rate) - x) * 3.0
        if curve_type == 2:
            return np.asarray(np.tanh(abs(rate) * (x - centre)) - np.tanh(abs(rate)) * (x - centre))
        return np.asarray(np.sin(2.0 * pi * (x - centre) * period_count) / 1.5)

    return curve


def draw_gain_error(axis: BlindAxis, rng: np.random.Generator) -> EffectPart:
    """Draw an actuator gain error; the size is the relative error."""
    sign = rng.choice([-1.0, 1.0])

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        return np.asarray(values * (1.0 + sign * size))

    return EffectPart("gain_error", axis, SignalStage.ACTUATOR, act, (1e-5, 0.1))


def draw_static_nonlinearity(axis: BlindAxis, rng: np.random.Generator) -> EffectPart:
    """Draw a bowed actuator characteristic; the size is in m or rad."""
    return _make_curve_part(
        "static_nonlinearity", axis, draw_curve(axis, rng), (axis.floor, 0.1 * axis.span)
    )


def _make_curve_part(
    effect: str, axis: BlindAxis, curve: Curve, sizes: tuple[float, float]
) -> EffectPart:
    """Return an effect that adds ``size`` times a curve over position."""

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        return values + size * curve(values)

    return EffectPart(effect, axis, SignalStage.ACTUATOR, act, sizes)


def draw_hysteresis(axis: BlindAxis, rng: np.random.Generator) -> EffectPart:
    """Draw a hysteresis from a Preisach plane or from Maxwell slip elements.

    The size is the width of the loop as a fraction of the range.
    """
    return _draw_preisach(axis, rng) if rng.uniform() < 0.6 else _draw_maxwell_slip(axis, rng)


def _draw_preisach(axis: BlindAxis, rng: np.random.Generator) -> EffectPart:
    everett = draw_plane(rng)
    # Only the deviation from a straight line is added. The line is fitted to a wide loop in the
    # middle of the range, so that the nominal gain does not change. The ramp is one start value,
    # then 400 rows up and 400 rows down.
    ramp = np.concatenate([[0.0], np.linspace(0.15, 0.85, 400), np.linspace(0.85, 0.15, 400)])
    loop = run_plane(everett, np.concatenate([ramp, ramp[1:401]]))[401:]
    slope, intercept = np.polyfit(np.concatenate([ramp[401:], ramp[1:401]]), loop, 1)
    width = float(np.max(loop[:400][::-1] - loop[400:]))

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        inputs = (values - axis.low) / axis.span
        deviation = run_plane(everett, inputs) - (slope * inputs + intercept)
        return np.asarray(values + axis.span * size / width * deviation)

    return EffectPart("hysteresis", axis, SignalStage.ACTUATOR, act, (0.002, 0.15))


def _draw_maxwell_slip(axis: BlindAxis, rng: np.random.Generator) -> EffectPart:
    slip_limits = np.sort(rng.uniform(0.003, 0.6, 40) ** rng.uniform(1.0, 2.0))
    stiffness = rng.gamma(2.0, 1.0, 40)
    stiffness /= np.sum(stiffness * slip_limits)

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        inputs = (values - axis.low) / axis.span
        slip_force = _compute_slip_forces(inputs, slip_limits, stiffness)
        return np.asarray(values - 0.5 * axis.span * size * slip_force)

    return EffectPart("hysteresis", axis, SignalStage.ACTUATOR, act, (0.002, 0.15))


@numba.njit(cache=True, error_model="numpy")
def _compute_slip_forces(
    inputs: FloatArray, slip_limits: FloatArray, stiffness: FloatArray
) -> FloatArray:
    stretch = np.zeros_like(slip_limits)
    out = np.empty_like(inputs)
    last_input, force = 0.0, 0.0
    for k in range(len(inputs)):
        displacement = inputs[k] - last_input
        last_input = inputs[k]
        if displacement != 0.0:
            force = 0.0
            for i in range(len(slip_limits)):
                stretch[i] = min(max(stretch[i] + displacement, -slip_limits[i]), slip_limits[i])
                force += stiffness[i] * stretch[i]
        out[k] = force
    return out


def draw_creep(axis: BlindAxis, rng: np.random.Generator) -> EffectPart:
    """Draw a creep of Kelvin–Voigt elements spread over decades of time.

    The size is the fraction of a move that is added per decade of time.
    """
    time_constants_s = np.geomspace(rng.uniform(0.03, 0.1), rng.uniform(60.0, 300.0), 9)
    elements_per_decade = 8.0 / np.log10(time_constants_s[-1] / time_constants_s[0])
    weights = rng.uniform(0.75, 1.25, 9) / elements_per_decade

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        return values + size * _compute_creep(
            values, weights, run.step_s / time_constants_s, run.lead
        )

    return EffectPart("creep", axis, SignalStage.ACTUATOR, act, (0.001, 0.05))


@numba.njit(cache=True, error_model="numpy")
def _compute_creep(
    values: FloatArray, weights: FloatArray, rates: FloatArray, lead: int
) -> FloatArray:
    """Return the creep (n,) of Kelvin–Voigt elements that are settled at the end of the lead.

    The creep is counted from that row.
    """
    settled_value = values[lead]
    strain = np.zeros_like(weights)
    decay = np.exp(-rates)
    out = np.zeros_like(values)
    for k in range(lead, len(values)):
        total = 0.0
        for i in range(len(weights)):
            target = weights[i] * (values[k] - settled_value)
            strain[i] = target + (strain[i] - target) * decay[i]
            total += strain[i]
        out[k] = total
    return out


def draw_lost_steps(axis: BlindAxis, rng: np.random.Generator) -> EffectPart:
    """Draw steps that a stepper loses at its highest load; the size is the number of events.

    Each event loses four or eight full steps.
    """
    seed = int(rng.integers(2**31))

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        record_rng = run.make_generator(seed)
        out = values.copy()
        for row in _find_highest_loads(values, run, round(size), record_rng):
            direction = np.sign(
                values[min(row + 20 * run.rows_per_sample, len(values) - 1)] - values[row]
            )
            out[row:] -= direction * 4.0 * axis.full_step * record_rng.choice([1.0, 1.0, 1.0, 2.0])
        return out

    return EffectPart("lost_steps", axis, SignalStage.ACTUATOR, act, (1.0, 4.0))


def _find_highest_loads(
    values: FloatArray, run: SimulationRun, max_count: int, record_rng: np.random.Generator
) -> list[int]:
    """Return at most ``max_count`` rows of the fine grid with a high load.

    The load is the second difference of ``values``. Each row is in a different eighth of the run.
    """
    width = 20 * run.rows_per_sample
    load = np.abs(values[2 * width :] - 2.0 * values[width:-width] + values[: -2 * width])
    load[: run.lead + width] = 0.0
    sections = np.array_split(np.arange(len(load)), 8)
    peaks = [load[section].max() for section in sections]
    loaded_sections = [k for k in record_rng.permutation(8) if peaks[k] >= 0.7 * max(peaks)]
    # Take the first row close to the peak. A small change elsewhere in the run hardly moves it.
    rows = [
        sections[k][np.argmax(load[sections[k]] >= 0.9 * peaks[k])]
        for k in loaded_sections[:max_count]
    ]
    return [int(row) + width for row in rows]


def _draw_periodic_wave(
    period: float, rng: np.random.Generator, harmonics: int, phase_wander: float
) -> Curve:
    """Draw a wave over position with rms 0.7, whose phase varies slowly along the axis."""
    orders = np.arange(1, harmonics + 1)
    amplitudes = rng.uniform(0.0, 0.5, harmonics) / orders
    amplitudes[0] = 1.0
    amplitudes /= np.sqrt(np.sum(amplitudes**2))
    phases = rng.uniform(0.0, 2.0 * pi, harmonics)
    phase_wander, wander_period = (
        phase_wander * rng.uniform(0.3, 1.0),
        rng.uniform(6.0, 20.0) * period,
    )

    def wave(position: FloatArray) -> FloatArray:
        angle = 2.0 * pi * position / period
        angle = angle + phase_wander * np.sin(2.0 * pi * position / wander_period)
        out = np.zeros_like(position)
        for order, amplitude, phase in zip(orders, amplitudes, phases, strict=True):
            out += amplitude * np.sin(order * angle + phase)
        return out

    return wave


def draw_microstep_error(axis: BlindAxis, rng: np.random.Generator) -> EffectPart:
    """Draw an error with a period of four full steps; the size is its amplitude, m."""
    wave = _draw_periodic_wave(4.0 * axis.full_step, rng, 4, 0.0)
    return _make_curve_part("microstep_error", axis, wave, (5e-8, 3e-6))


def draw_leadscrew_error(axis: BlindAxis, rng: np.random.Generator) -> EffectPart:
    """Draw an error that repeats every pitch or half pitch, with a slowly varying phase.

    The size is the amplitude, m.
    """
    wave = _draw_periodic_wave(axis.pitch / rng.choice([1.0, 1.0, 1.0, 2.0]), rng, 3, 0.3)
    return _make_curve_part("leadscrew_error", axis, wave, (5e-8, 2e-5))

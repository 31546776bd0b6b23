"""Effects of the second generator. Each has a random shape and a size.

Hysteresis follows Coleman and Hodgdon, friction Bliman and Sorine, and creep a power law. A contact
begins softly, a flexure stiffens by a hyperbolic sine, and periodic errors are arctangent waves.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import pi

import numpy as np
from scipy import signal

from rotemina.sim.arrays import FloatArray
from rotemina.sim.blind_second.dynamics import CONTACT, FRICTION, STIFFENING
from rotemina.sim.blind_second.machine_axis import FineTimeGrid, SecondAxis

DRIVE, ACTUATOR, FORCE, SPRING, MOTION, SENSOR, SAMPLED = range(7)

# (values (n,), motion of all axes (n, m), grid, random generator of the record, size) -> values
# (n,). For a force (FORCE) or a spring (SPRING), the result is the numbers of its row.
Act = Callable[[FloatArray, FloatArray, FineTimeGrid, np.random.Generator, float], FloatArray]
Random = np.random.Generator


@dataclass(frozen=True, slots=True, eq=False)
class AddedEffect:
    """An effect on an axis.

    Near ``usual_size``, the gap is approximately proportional to ``size``.
    """

    effect: str
    axis: SecondAxis
    place: int
    act: Act
    usual_size: float
    size: float = 0.0
    from_axis: str | None = None

    def with_size(self, size: float) -> "AddedEffect":
        """Return a copy with another size."""
        return replace(self, size=size)


def _delay_signal(values: FloatArray, rows: FloatArray | float) -> FloatArray:
    index = np.arange(len(values), dtype=float)
    return np.asarray(np.interp(index - rows, index, values))


def _apply_low_pass(values: FloatArray, order: int, corner_s: float, step_s: float) -> FloatArray:
    """Filter by equal poles in series, starting in the steady state at the first value."""
    pole = float(np.exp(-step_s / corner_s))
    out = values
    for _ in range(order):
        out = signal.lfilter([1.0 - pole], [1.0, -pole], out, zi=[pole * out[0]])[0]
    return np.asarray(out)


def _draw_delay(axis: SecondAxis, rng: Random) -> AddedEffect:
    return AddedEffect(
        "delay",
        axis,
        DRIVE,
        lambda values, motion, grid, record_rng, size: _delay_signal(values, size / grid.step_s),
        2e-3,
    )


def _draw_amplifier_lag(axis: SecondAxis, rng: Random) -> AddedEffect:
    order = int(rng.integers(1, 3))
    return AddedEffect(
        "amplifier_lag",
        axis,
        DRIVE,
        lambda values, motion, grid, record_rng, size: _apply_low_pass(
            values, order, size / order, grid.step_s
        ),
        2e-3,
    )


def _draw_slew_limit(axis: SecondAxis, rng: Random) -> AddedEffect:
    def act(
        values: FloatArray, motion: FloatArray, grid: FineTimeGrid, record_rng: Random, size: float
    ) -> FloatArray:
        max_step = axis.travel / size * grid.step_s
        out, position = np.empty_like(values), float(values[0])
        for k, target in enumerate(values.tolist()):
            position += max(-max_step, min(max_step, target - position))
            out[k] = position
        return out

    return AddedEffect("slew_limit", axis, DRIVE, act, 0.1)


def _draw_saturation(axis: SecondAxis, rng: Random) -> AddedEffect:
    power = rng.uniform(6.0, 20.0)
    middle = axis.low + 0.5 * axis.travel

    def act(
        values: FloatArray, motion: FloatArray, grid: FineTimeGrid, record_rng: Random, size: float
    ) -> FloatArray:
        reach = 0.5 * axis.travel * (1.0 - size)
        z = (values - middle) / reach
        return np.asarray(middle + reach * z / (1.0 + np.abs(z) ** power) ** (1.0 / power))

    return AddedEffect("saturation", axis, DRIVE, act, 0.1)


def _draw_quantization(axis: SecondAxis, rng: Random) -> AddedEffect:
    phase = rng.uniform(0.0, 1.0)
    return AddedEffect(
        "quantization",
        axis,
        DRIVE,
        lambda values, motion, grid, record_rng, size: (
            (np.floor(values / size + phase) + 0.5 - phase) * size
        ),
        1e-6,
    )


def _draw_gain_error(axis: SecondAxis, rng: Random) -> AddedEffect:
    sign = rng.choice([-1.0, 1.0])
    return AddedEffect(
        "gain_error",
        axis,
        ACTUATOR,
        lambda values, motion, grid, record_rng, size: values * (1.0 + sign * size),
        0.02,
    )


def _add_bow(axis: SecondAxis, values: FloatArray, half_waves: float, size: float) -> FloatArray:
    fraction = (values - axis.low) / axis.travel
    return np.asarray(
        values + size * axis.travel * np.sin(pi * half_waves * np.clip(fraction, -0.2, 1.2))
    )


def _draw_static_nonlinearity(axis: SecondAxis, rng: Random) -> AddedEffect:
    half_waves = rng.uniform(0.9, 1.1)
    return AddedEffect(
        "static_nonlinearity",
        axis,
        ACTUATOR,
        lambda values, motion, grid, record_rng, size: _add_bow(axis, values, half_waves, size),
        0.02,
    )


def _draw_hysteresis(axis: SecondAxis, rng: Random) -> AddedEffect:
    """Draw a hysteresis of Coleman and Hodgdon (1987): ``dw = α |dx| (x/L − w) + (1 − α …) dx``."""
    softness = rng.uniform(2.0, 5.0)

    def act(
        values: FloatArray, motion: FloatArray, grid: FineTimeGrid, record_rng: Random, size: float
    ) -> FloatArray:
        scaled_steps = (
            np.diff(values, prepend=axis.low - 0.5 * axis.travel) / axis.travel * softness
        )
        loop, loops = 0.0, np.empty_like(values)
        for k, scaled_step in enumerate(scaled_steps.tolist()):
            decay = float(np.exp(-abs(scaled_step)))
            loop = loop * decay + (1.0 - decay) * (1.0 if scaled_step > 0.0 else -1.0)
            loops[k] = loop
        fraction = np.clip((values - axis.low) / axis.travel, 0.0, 1.0)
        return np.asarray(
            values - size * axis.travel * loops * (0.7 + 0.6 * fraction * (1.0 - fraction))
        )

    return AddedEffect("hysteresis", axis, ACTUATOR, act, 0.05)


def _draw_creep(axis: SecondAxis, rng: Random) -> AddedEffect:
    """Draw a creep that superposes Andrade's power law of the time since each move."""
    exponent = rng.uniform(0.06, 0.14)

    def act(
        values: FloatArray, motion: FloatArray, grid: FineTimeGrid, record_rng: Random, size: float
    ) -> FloatArray:
        time_s = np.arange(len(values)) * grid.step_s + 0.02
        kernel = ((time_s / 0.1) ** exponent - (0.02 / 0.1) ** exponent) / (exponent * np.log(10.0))
        return np.asarray(
            values
            + size * signal.fftconvolve(np.diff(values, prepend=values[0]), kernel)[: len(values)]
        )

    return AddedEffect("creep", axis, ACTUATOR, act, 0.02)


def _draw_periodic(
    effect: str, place: int, period: float, axis: SecondAxis, rng: Random
) -> AddedEffect:
    phase, second_phase = rng.uniform(0.0, 2.0 * pi, 2)
    second_amplitude = rng.uniform(0.1, 0.4)

    def act(
        values: FloatArray, motion: FloatArray, grid: FineTimeGrid, record_rng: Random, size: float
    ) -> FloatArray:
        angle = 2.0 * pi * values / period
        wave = np.arctan2(np.sin(angle + phase), 1.6 + np.cos(angle + phase))
        return np.asarray(
            values + size * (wave + second_amplitude * np.sin(2.0 * angle + second_phase))
        )

    return AddedEffect(effect, axis, place, act, 1e-6)


def _draw_microstep_error(axis: SecondAxis, rng: Random) -> AddedEffect:
    return _draw_periodic("microstep_error", ACTUATOR, 4.0 * axis.full_step, axis, rng)


def _draw_leadscrew_error(axis: SecondAxis, rng: Random) -> AddedEffect:
    return _draw_periodic("leadscrew_error", ACTUATOR, axis.pitch, axis, rng)


def _draw_encoder_interpolation(axis: SecondAxis, rng: Random) -> AddedEffect:
    return _draw_periodic("encoder_interpolation", SENSOR, rng.choice([2e-5, 4e-5]), axis, rng)


def _draw_backlash(axis: SecondAxis, rng: Random) -> AddedEffect:
    def act(
        values: FloatArray, motion: FloatArray, grid: FineTimeGrid, record_rng: Random, size: float
    ) -> FloatArray:
        nut, out = float(values[0]) - 0.5 * size, np.empty_like(values)
        for k, position in enumerate(values.tolist()):
            distance = position - nut
            nut += distance - max(-0.5 * size, min(0.5 * size, distance))
            out[k] = nut
        return out

    return AddedEffect("backlash", axis, ACTUATOR, act, 2e-6)


def _draw_friction(axis: SecondAxis, rng: Random) -> AddedEffect:
    length, length_ratio, overshoot = (
        axis.floor * rng.uniform(20.0, 100.0),
        rng.uniform(3.0, 8.0),
        rng.uniform(0.0, 0.4),
    )
    viscous = axis.damping * rng.uniform(0.0, 0.02)
    return AddedEffect(
        "friction",
        axis,
        FORCE,
        lambda values, motion, grid, record_rng, size: np.array(
            [FRICTION, size, length, viscous, length_ratio, overshoot]
        ),
        axis.stiffness * axis.floor * 10.0,
    )


def _draw_contact(axis: SecondAxis, rng: Random) -> AddedEffect:
    position, softness_m, hardening = (
        axis.low + rng.uniform(0.6, 0.8) * axis.travel,
        0.01 * axis.travel,
        rng.uniform(0.0, 0.02),
    )
    return AddedEffect(
        "contact",
        axis,
        FORCE,
        lambda values, motion, grid, record_rng, size: np.array(
            [CONTACT, size * axis.stiffness, position, softness_m, hardening, 0.0]
        ),
        0.1,
    )


def _draw_stiffness_nonlinearity(axis: SecondAxis, rng: Random) -> AddedEffect:
    middle, length = axis.low + 0.5 * axis.travel, axis.travel * rng.uniform(0.4, 0.8)
    return AddedEffect(
        "stiffness_nonlinearity",
        axis,
        FORCE,
        lambda values, motion, grid, record_rng, size: np.array(
            [STIFFENING, size * axis.stiffness, middle, length, 0.0, 0.0]
        ),
        0.1,
    )


def _draw_resonance_mismatch(axis: SecondAxis, rng: Random) -> AddedEffect:
    sign = rng.choice([-1.0, 1.0])
    return AddedEffect(
        "resonance_mismatch",
        axis,
        SPRING,
        lambda values, motion, grid, record_rng, size: np.array([1.0 + sign * size]),
        0.1,
    )


def _draw_flexible_mode(axis: SecondAxis, rng: Random) -> AddedEffect:
    rate, ratio = 2.0 * pi * rng.uniform(15.0, 60.0), rng.uniform(0.01, 0.05)

    def act(
        values: FloatArray, motion: FloatArray, grid: FineTimeGrid, record_rng: Random, size: float
    ) -> FloatArray:
        pole = np.exp(complex(-ratio, np.sqrt(1.0 - ratio**2)) * rate * grid.step_s)
        denominator = np.array([1.0, -2.0 * pole.real, abs(pole) ** 2])
        numerator = np.array([0.0, 0.5, 0.5]) * denominator.sum()
        settled = signal.lfilter_zi(numerator, denominator) * values[0]
        return np.asarray(
            values + size * (signal.lfilter(numerator, denominator, values, zi=settled)[0] - values)
        )

    return AddedEffect("flexible_mode", axis, MOTION, act, 0.02)


def _draw_thermal_drift(axis: SecondAxis, rng: Random) -> AddedEffect:
    slow_s, fast_s, sign = rng.uniform(6.0, 30.0), rng.uniform(1.0, 4.0), rng.choice([-1.0, 1.0])

    def act(
        values: FloatArray, motion: FloatArray, grid: FineTimeGrid, record_rng: Random, size: float
    ) -> FloatArray:
        time_s = np.maximum(grid.compute_time_s(len(values)), 0.0)
        drift = 0.8 * -np.expm1(-time_s / slow_s) + 0.2 * -np.expm1(-time_s / fast_s)
        return np.asarray(values + sign * size * drift)

    return AddedEffect("thermal_drift", axis, MOTION, act, 1e-6)


def _draw_vibration(axis: SecondAxis, rng: Random) -> AddedEffect:
    frequency_hz, beat_hz = rng.uniform(15.0, 90.0), rng.uniform(0.05, 0.2)

    def act(
        values: FloatArray, motion: FloatArray, grid: FineTimeGrid, record_rng: Random, size: float
    ) -> FloatArray:
        time_s, phase = grid.compute_time_s(len(values)), record_rng.uniform(0.0, 2.0 * pi)
        relative_amplitude = 1.0 + 0.1 * np.sin(2.0 * pi * beat_hz * time_s + phase)
        return np.asarray(
            values
            + size * relative_amplitude * np.sin(2.0 * pi * frequency_hz * time_s + 7.0 * phase)
        )

    return AddedEffect("vibration", axis, MOTION, act, 1e-7)


def _draw_sensor_gain(axis: SecondAxis, rng: Random) -> AddedEffect:
    sign, middle = rng.choice([-1.0, 1.0]), axis.low + 0.5 * axis.travel
    return AddedEffect(
        "sensor_gain",
        axis,
        SENSOR,
        lambda values, motion, grid, record_rng, size: values + sign * size * (values - middle),
        0.02,
    )


def _draw_sensor_nonlinearity(axis: SecondAxis, rng: Random) -> AddedEffect:
    return AddedEffect(
        "sensor_nonlinearity",
        axis,
        SENSOR,
        lambda values, motion, grid, record_rng, size: _add_bow(axis, values, 1.0, size),
        0.02,
    )


def _draw_sensor_lag(axis: SecondAxis, rng: Random) -> AddedEffect:
    return AddedEffect(
        "sensor_lag",
        axis,
        SENSOR,
        lambda values, motion, grid, record_rng, size: _apply_low_pass(
            values, 1, size, grid.step_s
        ),
        2e-3,
    )


def _draw_sensor_noise(axis: SecondAxis, rng: Random) -> AddedEffect:
    return AddedEffect(
        "sensor_noise",
        axis,
        SAMPLED,
        lambda values, motion, grid, record_rng, size: (
            values + size * (record_rng.gamma(4.0, 0.5, len(values)) - 2.0)
        ),
        axis.floor,
    )


def _draw_sensor_quantization(axis: SecondAxis, rng: Random) -> AddedEffect:
    phase = rng.uniform(0.0, 1.0)
    return AddedEffect(
        "sensor_quantization",
        axis,
        SAMPLED,
        lambda values, motion, grid, record_rng, size: (
            (np.floor(values / size + phase) + 0.5 - phase) * size
        ),
        10.0 * axis.floor,
    )


def _draw_sensor_drift(axis: SecondAxis, rng: Random) -> AddedEffect:
    def act(
        values: FloatArray, motion: FloatArray, grid: FineTimeGrid, record_rng: Random, size: float
    ) -> FloatArray:
        walk = np.cumsum(record_rng.standard_t(5.0, len(values))) * np.sqrt(
            grid.step_s * grid.rows_per_sample
        )
        return np.asarray(values + size * walk)

    return AddedEffect("sensor_drift", axis, SAMPLED, act, axis.floor)


def _draw_sensor_outliers(axis: SecondAxis, rng: Random) -> AddedEffect:
    probability = rng.uniform(0.002, 0.01)

    def act(
        values: FloatArray, motion: FloatArray, grid: FineTimeGrid, record_rng: Random, size: float
    ) -> FloatArray:
        is_outlier = record_rng.uniform(size=len(values)) < probability
        return np.asarray(
            values
            + size
            * is_outlier
            * record_rng.choice([-1.0, 1.0], len(values))
            * record_rng.uniform(0.5, 2.0, len(values))
        )

    return AddedEffect("sensor_outliers", axis, SAMPLED, act, 100.0 * axis.floor)


DRAW_FUNCTIONS: dict[str, Callable[[SecondAxis, Random], AddedEffect]] = {
    "delay": _draw_delay,
    "amplifier_lag": _draw_amplifier_lag,
    "slew_limit": _draw_slew_limit,
    "saturation": _draw_saturation,
    "quantization": _draw_quantization,
    "gain_error": _draw_gain_error,
    "static_nonlinearity": _draw_static_nonlinearity,
    "hysteresis": _draw_hysteresis,
    "creep": _draw_creep,
    "microstep_error": _draw_microstep_error,
    "leadscrew_error": _draw_leadscrew_error,
    "encoder_interpolation": _draw_encoder_interpolation,
    "backlash": _draw_backlash,
    "friction": _draw_friction,
    "contact": _draw_contact,
    "stiffness_nonlinearity": _draw_stiffness_nonlinearity,
    "resonance_mismatch": _draw_resonance_mismatch,
    "flexible_mode": _draw_flexible_mode,
    "thermal_drift": _draw_thermal_drift,
    "vibration": _draw_vibration,
    "sensor_gain": _draw_sensor_gain,
    "sensor_nonlinearity": _draw_sensor_nonlinearity,
    "sensor_lag": _draw_sensor_lag,
    "sensor_noise": _draw_sensor_noise,
    "sensor_quantization": _draw_sensor_quantization,
    "sensor_drift": _draw_sensor_drift,
    "sensor_outliers": _draw_sensor_outliers,
}
PIEZO_ONLY_EFFECTS = frozenset(
    {"slew_limit", "saturation", "hysteresis", "creep", "stiffness_nonlinearity"}
)
STEPPER_ONLY_EFFECTS = frozenset(
    {"microstep_error", "leadscrew_error", "encoder_interpolation", "backlash", "friction"}
)


def draw_effect(
    effect: str, axis: SecondAxis, others: list[SecondAxis], rng: Random
) -> AddedEffect:
    """Draw the shape of an effect on an axis. A cross-coupling comes from one of ``others``."""
    if effect != "cross_coupling":
        return DRAW_FUNCTIONS[effect](axis, rng)
    source = others[rng.integers(len(others))]
    sign, lag_s = rng.choice([-1.0, 1.0]), rng.uniform(1e-3, 5e-3)

    def act(
        values: FloatArray, motion: FloatArray, grid: FineTimeGrid, record_rng: Random, size: float
    ) -> FloatArray:
        leak = _apply_low_pass(motion[:, source.index], 1, lag_s, grid.step_s)
        return np.asarray(values + sign * size * leak)

    return AddedEffect("cross_coupling", axis, MOTION, act, 0.01, from_axis=source.name)

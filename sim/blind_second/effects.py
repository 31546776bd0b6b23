"""Effects in their own equations: functions of a drawn shape and a size.

Hysteresis follows Coleman and Hodgdon, friction Bliman and Sorine, creep a power law; contact
begins softly, a flexure stiffens by a hyperbolic sine, periodic errors are arctangent waves.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import pi

import numpy as np
from scipy import signal

from rotemina.sim.arrays import FloatArray
from rotemina.sim.blind_second.dynamics import CONTACT, FRICTION, STIFFENING
from rotemina.sim.blind_second.machine_axis import AxisFacts, Grid

DRIVE, ACTUATOR, FORCE, SPRING, MOTION, SENSOR, SAMPLED = range(7)

# (signal (n,), motion of all axes (n, m), grid, chance of the record, size) -> signal; of a force
# (FORCE) or a spring (SPRING): the numbers of its row.
Act = Callable[[FloatArray, FloatArray, Grid, np.random.Generator, float], FloatArray]
Random = np.random.Generator


@dataclass(frozen=True, slots=True, eq=False)
class Added:
    """An effect on an axis; what it does is about in proportion to ``size`` near ``usual``."""

    effect: str
    axis: AxisFacts
    place: int
    act: Act
    usual: float
    size: float = 0.0
    from_axis: str | None = None

    def sized(self, size: float) -> "Added":
        """Return it with another size."""
        return replace(self, size=size)


def _later(x: FloatArray, rows: FloatArray | float) -> FloatArray:
    index = np.arange(len(x), dtype=float)
    return np.asarray(np.interp(index - rows, index, x))


def _low_pass(x: FloatArray, order: int, corner_s: float, step_s: float) -> FloatArray:
    """Filter by equal poles in a row, from a rest at the first value."""
    pole = float(np.exp(-step_s / corner_s))
    out = x
    for _ in range(order):
        out = signal.lfilter([1.0 - pole], [1.0, -pole], out, zi=[pole * out[0]])[0]
    return np.asarray(out)


def _delay(a: AxisFacts, r: Random) -> Added:
    return Added("delay", a, DRIVE, lambda x, q, g, c, s: _later(x, s / g.step_s), 2e-3)


def _amplifier_lag(a: AxisFacts, r: Random) -> Added:
    order = int(r.integers(1, 3))
    return Added(
        "amplifier_lag",
        a,
        DRIVE,
        lambda x, q, g, c, s: _low_pass(x, order, s / order, g.step_s),
        2e-3,
    )


def _slew_limit(a: AxisFacts, r: Random) -> Added:
    def act(x: FloatArray, q: FloatArray, g: Grid, c: Random, s: float) -> FloatArray:
        most = a.way / s * g.step_s
        out, y = np.empty_like(x), float(x[0])
        for k, asked in enumerate(x.tolist()):
            y += max(-most, min(most, asked - y))
            out[k] = y
        return out

    return Added("slew_limit", a, DRIVE, act, 0.1)


def _saturation(a: AxisFacts, r: Random) -> Added:
    power = r.uniform(6.0, 20.0)
    middle = a.low + 0.5 * a.way

    def act(x: FloatArray, q: FloatArray, g: Grid, c: Random, s: float) -> FloatArray:
        most = 0.5 * a.way * (1.0 - s)
        z = (x - middle) / most
        return np.asarray(middle + most * z / (1.0 + np.abs(z) ** power) ** (1.0 / power))

    return Added("saturation", a, DRIVE, act, 0.1)


def _quantization(a: AxisFacts, r: Random) -> Added:
    at = r.uniform(0.0, 1.0)
    return Added(
        "quantization", a, DRIVE, lambda x, q, g, c, s: (np.floor(x / s + at) + 0.5 - at) * s, 1e-6
    )


def _gain_error(a: AxisFacts, r: Random) -> Added:
    sign = r.choice([-1.0, 1.0])
    return Added("gain_error", a, ACTUATOR, lambda x, q, g, c, s: x * (1.0 + sign * s), 0.02)


def _bow(a: AxisFacts, x: FloatArray, waves: float, size: float) -> FloatArray:
    share = (x - a.low) / a.way
    return np.asarray(x + size * a.way * np.sin(pi * waves * np.clip(share, -0.2, 1.2)))


def _static_nonlinearity(a: AxisFacts, r: Random) -> Added:
    waves = r.uniform(0.9, 1.1)
    return Added(
        "static_nonlinearity", a, ACTUATOR, lambda x, q, g, c, s: _bow(a, x, waves, s), 0.02
    )


def _hysteresis(a: AxisFacts, r: Random) -> Added:
    """Follow Coleman and Hodgdon (1987): ``dw = α |dx| (x/L − w) + (1 − α …) dx``."""
    softness = r.uniform(2.0, 5.0)

    def act(x: FloatArray, q: FloatArray, g: Grid, c: Random, s: float) -> FloatArray:
        z = np.diff(x, prepend=a.low - 0.5 * a.way) / a.way * softness
        w, out = 0.0, np.empty_like(x)
        for k, dz in enumerate(z.tolist()):
            decay = float(np.exp(-abs(dz)))
            w = w * decay + (1.0 - decay) * (1.0 if dz > 0.0 else -1.0)
            out[k] = w
        share = np.clip((x - a.low) / a.way, 0.0, 1.0)
        return np.asarray(x - s * a.way * out * (0.7 + 0.6 * share * (1.0 - share)))

    return Added("hysteresis", a, ACTUATOR, act, 0.05)


def _creep(a: AxisFacts, r: Random) -> Added:
    """Creep by Andrade's power law of the time since each move, superposed."""
    power = r.uniform(0.06, 0.14)

    def act(x: FloatArray, q: FloatArray, g: Grid, c: Random, s: float) -> FloatArray:
        time_s = np.arange(len(x)) * g.step_s + 0.02
        kernel = ((time_s / 0.1) ** power - (0.02 / 0.1) ** power) / (power * np.log(10.0))
        return np.asarray(x + s * signal.fftconvolve(np.diff(x, prepend=x[0]), kernel)[: len(x)])

    return Added("creep", a, ACTUATOR, act, 0.02)


def _periodic(effect: str, place: int, period: float, a: AxisFacts, r: Random) -> Added:
    phase, second = r.uniform(0.0, 2.0 * pi, 2)
    share = r.uniform(0.1, 0.4)

    def act(x: FloatArray, q: FloatArray, g: Grid, c: Random, s: float) -> FloatArray:
        turn = 2.0 * pi * x / period
        wave = np.arctan2(np.sin(turn + phase), 1.6 + np.cos(turn + phase))
        return np.asarray(x + s * (wave + share * np.sin(2.0 * turn + second)))

    return Added(effect, a, place, act, 1e-6)


def _microstep_error(a: AxisFacts, r: Random) -> Added:
    return _periodic("microstep_error", ACTUATOR, 4.0 * a.full_step, a, r)


def _leadscrew_error(a: AxisFacts, r: Random) -> Added:
    return _periodic("leadscrew_error", ACTUATOR, a.pitch, a, r)


def _encoder_interpolation(a: AxisFacts, r: Random) -> Added:
    return _periodic("encoder_interpolation", SENSOR, r.choice([2e-5, 4e-5]), a, r)


def _backlash(a: AxisFacts, r: Random) -> Added:
    def act(x: FloatArray, q: FloatArray, g: Grid, c: Random, s: float) -> FloatArray:
        y, out = float(x[0]) - 0.5 * s, np.empty_like(x)
        for k, at in enumerate(x.tolist()):
            apart = at - y
            y += apart - max(-0.5 * s, min(0.5 * s, apart))
            out[k] = y
        return out

    return Added("backlash", a, ACTUATOR, act, 2e-6)


def _friction(a: AxisFacts, r: Random) -> Added:
    length, wide, rise = a.floor * r.uniform(20.0, 100.0), r.uniform(3.0, 8.0), r.uniform(0.0, 0.4)
    viscous = a.damping * r.uniform(0.0, 0.02)
    return Added(
        "friction",
        a,
        FORCE,
        lambda x, q, g, c, s: np.array([FRICTION, s, length, viscous, wide, rise]),
        a.stiffness * a.floor * 10.0,
    )


def _contact(a: AxisFacts, r: Random) -> Added:
    place, soft, hard = a.low + r.uniform(0.6, 0.8) * a.way, 0.01 * a.way, r.uniform(0.0, 0.02)
    return Added(
        "contact",
        a,
        FORCE,
        lambda x, q, g, c, s: np.array([CONTACT, s * a.stiffness, place, soft, hard, 0.0]),
        0.1,
    )


def _stiffness_nonlinearity(a: AxisFacts, r: Random) -> Added:
    middle, length = a.low + 0.5 * a.way, a.way * r.uniform(0.4, 0.8)
    return Added(
        "stiffness_nonlinearity",
        a,
        FORCE,
        lambda x, q, g, c, s: np.array([STIFFENING, s * a.stiffness, middle, length, 0.0, 0.0]),
        0.1,
    )


def _resonance_mismatch(a: AxisFacts, r: Random) -> Added:
    sign = r.choice([-1.0, 1.0])
    return Added(
        "resonance_mismatch", a, SPRING, lambda x, q, g, c, s: np.array([1.0 + sign * s]), 0.1
    )


def _flexible_mode(a: AxisFacts, r: Random) -> Added:
    rate, ratio = 2.0 * pi * r.uniform(15.0, 60.0), r.uniform(0.01, 0.05)

    def act(x: FloatArray, q: FloatArray, g: Grid, c: Random, s: float) -> FloatArray:
        pole = np.exp(complex(-ratio, np.sqrt(1.0 - ratio**2)) * rate * g.step_s)
        below = np.array([1.0, -2.0 * pole.real, abs(pole) ** 2])
        above = np.array([0.0, 0.5, 0.5]) * below.sum()
        start = signal.lfilter_zi(above, below) * x[0]
        return np.asarray(x + s * (signal.lfilter(above, below, x, zi=start)[0] - x))

    return Added("flexible_mode", a, MOTION, act, 0.02)


def _thermal_drift(a: AxisFacts, r: Random) -> Added:
    slow_s, quick_s, sign = r.uniform(6.0, 30.0), r.uniform(1.0, 4.0), r.choice([-1.0, 1.0])

    def act(x: FloatArray, q: FloatArray, g: Grid, c: Random, s: float) -> FloatArray:
        t = np.maximum(g.time_s(len(x)), 0.0)
        grown = 0.8 * -np.expm1(-t / slow_s) + 0.2 * -np.expm1(-t / quick_s)
        return np.asarray(x + sign * s * grown)

    return Added("thermal_drift", a, MOTION, act, 1e-6)


def _vibration(a: AxisFacts, r: Random) -> Added:
    hertz, beat = r.uniform(15.0, 90.0), r.uniform(0.05, 0.2)

    def act(x: FloatArray, q: FloatArray, g: Grid, c: Random, s: float) -> FloatArray:
        t, phase = g.time_s(len(x)), c.uniform(0.0, 2.0 * pi)
        swell = 1.0 + 0.1 * np.sin(2.0 * pi * beat * t + phase)
        return np.asarray(x + s * swell * np.sin(2.0 * pi * hertz * t + 7.0 * phase))

    return Added("vibration", a, MOTION, act, 1e-7)


def _sensor_gain(a: AxisFacts, r: Random) -> Added:
    sign, middle = r.choice([-1.0, 1.0]), a.low + 0.5 * a.way
    return Added("sensor_gain", a, SENSOR, lambda x, q, g, c, s: x + sign * s * (x - middle), 0.02)


def _sensor_nonlinearity(a: AxisFacts, r: Random) -> Added:
    return Added("sensor_nonlinearity", a, SENSOR, lambda x, q, g, c, s: _bow(a, x, 1.0, s), 0.02)


def _sensor_lag(a: AxisFacts, r: Random) -> Added:
    return Added("sensor_lag", a, SENSOR, lambda x, q, g, c, s: _low_pass(x, 1, s, g.step_s), 2e-3)


def _sensor_noise(a: AxisFacts, r: Random) -> Added:
    return Added(
        "sensor_noise",
        a,
        SAMPLED,
        lambda x, q, g, c, s: x + s * (c.gamma(4.0, 0.5, len(x)) - 2.0),
        a.floor,
    )


def _sensor_quantization(a: AxisFacts, r: Random) -> Added:
    at = r.uniform(0.0, 1.0)
    return Added(
        "sensor_quantization",
        a,
        SAMPLED,
        lambda x, q, g, c, s: (np.floor(x / s + at) + 0.5 - at) * s,
        10.0 * a.floor,
    )


def _sensor_drift(a: AxisFacts, r: Random) -> Added:
    def act(x: FloatArray, q: FloatArray, g: Grid, c: Random, s: float) -> FloatArray:
        walk = np.cumsum(c.standard_t(5.0, len(x))) * np.sqrt(g.step_s * g.every)
        return np.asarray(x + s * walk)

    return Added("sensor_drift", a, SAMPLED, act, a.floor)


def _sensor_outliers(a: AxisFacts, r: Random) -> Added:
    often = r.uniform(0.002, 0.01)

    def act(x: FloatArray, q: FloatArray, g: Grid, c: Random, s: float) -> FloatArray:
        struck = c.uniform(size=len(x)) < often
        return np.asarray(
            x + s * struck * c.choice([-1.0, 1.0], len(x)) * c.uniform(0.5, 2.0, len(x))
        )

    return Added("sensor_outliers", a, SAMPLED, act, 100.0 * a.floor)


MAKERS: dict[str, Callable[[AxisFacts, Random], Added]] = {
    "delay": _delay,
    "amplifier_lag": _amplifier_lag,
    "slew_limit": _slew_limit,
    "saturation": _saturation,
    "quantization": _quantization,
    "gain_error": _gain_error,
    "static_nonlinearity": _static_nonlinearity,
    "hysteresis": _hysteresis,
    "creep": _creep,
    "microstep_error": _microstep_error,
    "leadscrew_error": _leadscrew_error,
    "encoder_interpolation": _encoder_interpolation,
    "backlash": _backlash,
    "friction": _friction,
    "contact": _contact,
    "stiffness_nonlinearity": _stiffness_nonlinearity,
    "resonance_mismatch": _resonance_mismatch,
    "flexible_mode": _flexible_mode,
    "thermal_drift": _thermal_drift,
    "vibration": _vibration,
    "sensor_gain": _sensor_gain,
    "sensor_nonlinearity": _sensor_nonlinearity,
    "sensor_lag": _sensor_lag,
    "sensor_noise": _sensor_noise,
    "sensor_quantization": _sensor_quantization,
    "sensor_drift": _sensor_drift,
    "sensor_outliers": _sensor_outliers,
}
PIEZO_ALONE = frozenset(
    {"slew_limit", "saturation", "hysteresis", "creep", "stiffness_nonlinearity"}
)
STEPPER_ALONE = frozenset(
    {"microstep_error", "leadscrew_error", "encoder_interpolation", "backlash", "friction"}
)


def draw(effect: str, axis: AxisFacts, others: list[AxisFacts], rng: Random) -> Added:
    """Draw the shape of an effect on an axis; another axis is the source of what couples."""
    if effect != "cross_coupling":
        return MAKERS[effect](axis, rng)
    source = others[rng.integers(len(others))]
    sign, late_s = rng.choice([-1.0, 1.0]), rng.uniform(1e-3, 5e-3)

    def act(x: FloatArray, q: FloatArray, g: Grid, c: Random, s: float) -> FloatArray:
        leaked = _low_pass(q[:, source.index], 1, late_s, g.step_s)
        return np.asarray(x + sign * s * leaked)

    return Added("cross_coupling", axis, MOTION, act, 0.01, from_axis=source.name)

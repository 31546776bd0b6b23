"""Sensor effects of the first generator: gain, curve, lag, noise, steps, drift, outliers, clock.

Each function draws the shape of an effect at random. Its docstring says what the size measures.
"""

from dataclasses import replace
from math import pi

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.blind.actuator import draw_gain_error, draw_static_nonlinearity
from rotemina.sim.blind.electronics import draw_amplifier_lag, draw_quantization
from rotemina.sim.blind.filters import delay_smooth_signal
from rotemina.sim.blind.part import BlindAxis, EffectPart, SignalStage, SimulationRun


def draw_sensor_gain(axis: BlindAxis, rng: np.random.Generator) -> EffectPart:
    """Draw a gain error of the sensor; the size is the relative error."""
    return replace(draw_gain_error(axis, rng), effect="sensor_gain", stage=SignalStage.READING)


def draw_sensor_nonlinearity(axis: BlindAxis, rng: np.random.Generator) -> EffectPart:
    """Draw a bowed characteristic of the sensor; the size is in m or rad."""
    bowed = draw_static_nonlinearity(axis, rng)
    return replace(bowed, effect="sensor_nonlinearity", stage=SignalStage.READING)


def draw_sensor_lag(axis: BlindAxis, rng: np.random.Generator) -> EffectPart:
    """Draw a sensor of limited bandwidth; the size is its low-frequency delay, s."""
    return replace(draw_amplifier_lag(axis, rng), effect="sensor_lag", stage=SignalStage.SENSOR)


def draw_sensor_noise(axis: BlindAxis, rng: np.random.Generator) -> EffectPart:
    """Draw more white noise than declared, Gaussian or Laplacian.

    The size is its rms, m or rad.
    """
    seed = int(rng.integers(2**31))
    laplacian = rng.uniform() < 0.4

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        record_rng = run.make_generator(seed)
        if laplacian:
            return values + record_rng.laplace(0.0, size / 2.0**0.5, len(values))
        return values + record_rng.normal(0.0, size, len(values))

    return EffectPart(
        "sensor_noise", axis, SignalStage.READING, act, (axis.floor, 60.0 * axis.floor)
    )


def draw_sensor_quantization(axis: BlindAxis, rng: np.random.Generator) -> EffectPart:
    """Draw coarser steps than declared, mid-tread and with an offset.

    The size is the step, m or rad.
    """
    quantization, sizes = draw_quantization(axis, rng), (4.0 * axis.floor, 0.02 * axis.span)
    return replace(
        quantization, effect="sensor_quantization", stage=SignalStage.READING, sizes=sizes
    )


def draw_sensor_drift(axis: BlindAxis, rng: np.random.Generator) -> EffectPart:
    """Draw a drift of the sensor's zero: a random walk or 1/f noise.

    The size is its rms over 10 s, m or rad.
    """
    seed = int(rng.integers(2**31))
    exponent = rng.choice([1.0, 1.0, 0.5, 0.6])

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        step_s = run.step_s * run.rows_per_sample
        white_noise = run.make_generator(seed).normal(size=max(len(values), round(64.0 / step_s)))
        spectrum = np.fft.rfft(white_noise)
        frequency_hz = np.maximum(np.fft.rfftfreq(len(white_noise), step_s), 1.0 / 64.0)
        walk = np.fft.irfft(spectrum * np.sqrt(step_s) / frequency_hz**exponent, len(white_noise))[
            : len(values)
        ]
        return np.asarray(values + size * (walk - walk[0]))

    return EffectPart(
        "sensor_drift", axis, SignalStage.READING, act, (axis.floor, 0.05 * axis.span)
    )


def draw_sensor_outliers(axis: BlindAxis, rng: np.random.Generator) -> EffectPart:
    """Draw spikes, dropouts to zero, or readings that freeze for some samples.

    The size is the height of the spikes, m or rad.
    """
    seed = int(rng.integers(2**31))
    rate = 10.0 ** rng.uniform(-3.0, -2.2)
    kind = rng.integers(3)

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        record_rng = run.make_generator(seed)
        out = values.copy()
        for k in np.flatnonzero(record_rng.uniform(size=len(values)) < rate):
            length = int(record_rng.integers(1, 4)) if kind else 1
            if kind == 0:
                out[k] += size * record_rng.choice([-1.0, 1.0]) * record_rng.uniform(0.5, 1.5)
            elif kind == 1:
                out[k : k + length] = 0.0
            else:
                held_count = int(record_rng.integers(3, 12))
                out[k : k + held_count] = out[k]
        return out

    return EffectPart(
        "sensor_outliers", axis, SignalStage.READING, act, (10.0 * axis.floor, 0.3 * axis.span)
    )


def draw_encoder_interpolation(axis: BlindAxis, rng: np.random.Generator) -> EffectPart:
    """Draw an encoder whose sine and cosine, read by atan2, have unequal offset, gain and phase.

    The size scales these errors.
    """
    period = rng.choice([4e-6, 10e-6, 20e-6, 40e-6])
    offsets, gain = rng.normal(0.0, 1.0, 2), rng.normal(0.0, 0.7)
    skew = rng.normal(0.0, 0.7)

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        angle = 2.0 * pi * values / period
        sine = (1.0 + size * gain) * np.sin(angle + size * skew) + size * offsets[0]
        cosine = np.cos(angle) + size * offsets[1]
        error = np.arctan2(sine, cosine) - angle
        return np.asarray(
            values + (error - 2.0 * pi * np.round(error / (2.0 * pi))) * period / (2.0 * pi)
        )

    return EffectPart("encoder_interpolation", axis, SignalStage.READING, act, (2e-3, 0.25))


def draw_clock_skew(axis: BlindAxis, rng: np.random.Generator) -> EffectPart:
    """Draw a wrong sample clock; its time error grows from the start of the record.

    The size is the relative error.
    """
    sign = rng.choice([-1.0, 1.0])

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        delay_steps = sign * size * np.maximum(np.arange(len(values)) - run.lead, 0)
        return delay_smooth_signal(values, delay_steps)

    return EffectPart("clock_skew", axis, SignalStage.SENSOR, act, (5e-6, 2e-3))

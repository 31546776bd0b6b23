"""Sensors of the generator: gain, curve, lag, noise, steps, drift, outliers, clock."""

from dataclasses import replace
from math import pi

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.blind.actuator import gain_error, static_nonlinearity
from rotemina.sim.blind.electronics import amplifier_lag, quantization
from rotemina.sim.blind.filters import smoothly_shifted
from rotemina.sim.blind.part import Axis, Part, SimulationRun, Stage


def sensor_gain(axis: Axis, rng: np.random.Generator) -> Part:
    """Sensitivity of the sensor off by a share; size is the share."""
    return replace(gain_error(axis, rng), effect="sensor_gain", stage=Stage.READING)


def sensor_nonlinearity(axis: Axis, rng: np.random.Generator) -> Part:
    """Bowed characteristic of the sensor; size in m or rad."""
    bowed = static_nonlinearity(axis, rng)
    return replace(bowed, effect="sensor_nonlinearity", stage=Stage.READING)


def sensor_lag(axis: Axis, rng: np.random.Generator) -> Part:
    """Bandwidth of the sensor; size is its low-frequency delay in seconds."""
    return replace(amplifier_lag(axis, rng), effect="sensor_lag", stage=Stage.SENSOR)


def sensor_noise(axis: Axis, rng: np.random.Generator) -> Part:
    """More white noise than declared, Gaussian or Laplacian; size is its rms, m or rad."""
    seed = int(rng.integers(2**31))
    laplacian = rng.uniform() < 0.4

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        draw = run.chance(seed)
        if laplacian:
            return values + draw.laplace(0.0, size / 2.0**0.5, len(values))
        return values + draw.normal(0.0, size, len(values))

    return Part("sensor_noise", axis, Stage.READING, act, (axis.floor, 60.0 * axis.floor))


def sensor_quantization(axis: Axis, rng: np.random.Generator) -> Part:
    """Coarser steps than declared, mid-tread with an offset; size is the step, m or rad."""
    coarse, sizes = quantization(axis, rng), (4.0 * axis.floor, 0.02 * axis.span)
    return replace(coarse, effect="sensor_quantization", stage=Stage.READING, sizes=sizes)


def sensor_drift(axis: Axis, rng: np.random.Generator) -> Part:
    """Wander of the sensor, a random walk or 1/f; size is its rms over 10 s, m or rad."""
    seed = int(rng.integers(2**31))
    power = rng.choice([1.0, 1.0, 0.5, 0.6])

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        step_s = run.step_s * run.every
        draw = run.chance(seed).normal(size=max(len(values), round(64.0 / step_s)))
        tones = np.fft.rfft(draw)
        hertz = np.maximum(np.fft.rfftfreq(len(draw), step_s), 1.0 / 64.0)
        walk = np.fft.irfft(tones * np.sqrt(step_s) / hertz**power, len(draw))[: len(values)]
        return np.asarray(values + size * (walk - walk[0]))

    return Part("sensor_drift", axis, Stage.READING, act, (axis.floor, 0.05 * axis.span))


def sensor_outliers(axis: Axis, rng: np.random.Generator) -> Part:
    """Spikes, or dropouts to zero or to the last value; size is the spikes' height, m or rad."""
    seed = int(rng.integers(2**31))
    rate = 10.0 ** rng.uniform(-3.0, -2.2)
    form = rng.integers(3)

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        draw = run.chance(seed)
        out = values.copy()
        for k in np.flatnonzero(draw.uniform(size=len(values)) < rate):
            length = int(draw.integers(1, 4)) if form else 1
            if form == 0:
                out[k] += size * draw.choice([-1.0, 1.0]) * draw.uniform(0.5, 1.5)
            elif form == 1:
                out[k : k + length] = 0.0
            else:
                held = int(draw.integers(3, 12))
                out[k : k + held] = out[k]
        return out

    return Part("sensor_outliers", axis, Stage.READING, act, (10.0 * axis.floor, 0.3 * axis.span))


def encoder_interpolation(axis: Axis, rng: np.random.Generator) -> Part:
    """Sine and cosine of unequal offset, gain and phase, read by atan2; size is their fault."""
    period = rng.choice([4e-6, 10e-6, 20e-6, 40e-6])
    offsets, gain = rng.normal(0.0, 1.0, 2), rng.normal(0.0, 0.7)
    skew = rng.normal(0.0, 0.7)

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        turn = 2.0 * pi * values / period
        sine = (1.0 + size * gain) * np.sin(turn + size * skew) + size * offsets[0]
        cosine = np.cos(turn) + size * offsets[1]
        wrong = np.arctan2(sine, cosine) - turn
        return np.asarray(
            values + (wrong - 2.0 * pi * np.round(wrong / (2.0 * pi))) * period / (2.0 * pi)
        )

    return Part("encoder_interpolation", axis, Stage.READING, act, (2e-3, 0.25))


def clock_skew(axis: Axis, rng: np.random.Generator) -> Part:
    """Time base off by a share of the time since the start; size is the share."""
    sign = rng.choice([-1.0, 1.0])

    def act(values: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        late = sign * size * np.maximum(np.arange(len(values)) - run.lead, 0)
        return smoothly_shifted(values, late)

    return Part("clock_skew", axis, Stage.SENSOR, act, (5e-6, 2e-3))

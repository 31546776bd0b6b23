"""Motion added to an axis: coupling from another axis, thermal drift, vibration.

Each function draws the shape of an effect at random. Its docstring says what the size measures.
"""

from math import pi
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rotemina.sim.arrays import FloatArray
from rotemina.sim.blind.filters import apply_low_pass, compute_mode_poles
from rotemina.sim.blind.part import BlindAxis, EffectPart, SignalStage, SimulationRun


def draw_cross_coupling(axis: BlindAxis, rng: np.random.Generator, other: BlindAxis) -> EffectPart:
    """Draw the motion that leaks in from another axis, directly or through a mode.

    The size is the coupling factor between the two motions, each as a fraction of its range.
    """
    signed_span_ratio = rng.choice([-1.0, 1.0]) * axis.span / other.span
    through_mode = rng.uniform() < 0.3
    poles = compute_mode_poles(rng.uniform(15.0, 120.0), rng.uniform(0.02, 0.3))

    def act(motion: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        leaked_motion = motion[:, other.index] - motion[run.lead, other.index]
        if through_mode:
            leaked_motion = apply_low_pass(leaked_motion, poles, run.step_s)
        return np.asarray(signed_span_ratio * size * leaked_motion)

    sizes = (1e-5, 1.5)
    return EffectPart("cross_coupling", axis, SignalStage.MOTION, act, sizes, from_axis=other.name)


def draw_thermal_drift(axis: BlindAxis, rng: np.random.Generator) -> EffectPart:
    """Draw a warm-up with a fast and a slow time constant.

    The size is the final drift, m or rad.
    """
    fast_s, slow_s = rng.uniform(1.5, 6.0), rng.uniform(15.0, 90.0)
    fast_share = rng.uniform(0.15, 0.7)
    sign = rng.choice([-1.0, 1.0])

    def act(motion: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        elapsed_s = np.maximum(np.arange(len(motion)) - run.lead, 0) * run.step_s
        negative_rise = fast_share * np.expm1(-elapsed_s / fast_s) + (1.0 - fast_share) * np.expm1(
            -elapsed_s / slow_s
        )
        return np.asarray(-sign * size * negative_rise)

    return EffectPart(
        "thermal_drift", axis, SignalStage.MOTION, act, (axis.floor, 0.05 * axis.span)
    )


def draw_vibration(axis: BlindAxis, rng: np.random.Generator) -> EffectPart:
    """Draw one to three spectral lines with slowly varying amplitude and phase.

    The size is the amplitude of the first line, m or rad.
    """
    seed = int(rng.integers(2**31))
    amplitude_variation, phase_variation = rng.uniform(0.0, 0.15), rng.uniform(0.0, 0.3)
    frequencies = np.exp(rng.uniform(np.log(6.0), np.log(120.0), rng.choice([1, 1, 2, 3])))

    def act(motion: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        record_rng = run.make_generator(seed)
        time_s = np.arange(len(motion)) * run.step_s
        total = np.zeros(len(motion))
        for order, frequency in enumerate(frequencies):
            phase = record_rng.uniform(0.0, 2.0 * pi) + phase_variation * _draw_slow_curve(
                time_s, record_rng
            )
            relative_amplitude = 1.0 + amplitude_variation * _draw_slow_curve(time_s, record_rng)
            total += (
                relative_amplitude / (1 + order) * np.sin(2.0 * pi * frequency * time_s + phase)
            )
        return np.asarray(size * total)

    return EffectPart(
        "vibration", axis, SignalStage.MOTION, act, (0.5 * axis.floor, 0.02 * axis.span)
    )


def _draw_slow_curve(
    time_s: NDArray[np.floating[Any]], record_rng: np.random.Generator
) -> FloatArray:
    """Return a smooth random curve (n,) of rms about 1, which changes over several seconds."""
    knots_s = np.arange(-3.0, time_s[-1] + 9.0, 3.0)
    return np.asarray(np.interp(time_s, knots_s, record_rng.normal(size=len(knots_s))))

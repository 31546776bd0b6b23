"""A small smooth deviation that is in no catalogue of effects. It repeats in every run."""

from math import pi

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.blind.filters import apply_low_pass
from rotemina.sim.blind.part import BlindAxis, EffectPart, SignalStage, SimulationRun

REMAINDER_ID = "remainder"
# Bounds of the ratio of the remainder's rms to that of the gap.
MIN_REMAINDER_SHARE, MAX_REMAINDER_SHARE = 0.05, 0.3
_WAVE_COUNT = 16


def draw_remainder(axis: BlindAxis, rng: np.random.Generator) -> EffectPart:
    """Draw the shape of a remainder on an axis at random; its size, m or rad, is set later."""
    return (
        _draw_motion_remainder(axis, rng)
        if rng.uniform() < 0.6
        else _draw_time_remainder(axis, rng)
    )


def _draw_motion_remainder(axis: BlindAxis, rng: np.random.Generator) -> EffectPart:
    speed_filter_s, recent_speed_filter_s = rng.uniform(0.01, 0.1), rng.uniform(0.3, 2.0)
    speed_scale = axis.travel / rng.uniform(0.1, 0.4)
    waves = rng.normal(0.0, (4.0, 1.5, 1.0), (_WAVE_COUNT, 3))
    phases = rng.uniform(0.0, 2.0 * pi, _WAVE_COUNT)

    def act(motion: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        # The deviation is constant before the record begins.
        position = run.hold_before_record(motion[:, axis.index])
        filtered_speed = apply_low_pass(
            np.gradient(position, run.step_s), np.array([-1.0 / speed_filter_s]), run.step_s
        )
        recent_speed = apply_low_pass(
            np.abs(filtered_speed), np.array([-1.0 / recent_speed_filter_s]), run.step_s
        )
        inputs = (
            (position - axis.start) / axis.travel,
            filtered_speed / speed_scale,
            recent_speed / speed_scale,
        )
        total = np.zeros(len(position))
        for (position_factor, speed_factor, recent_speed_factor), phase in zip(
            waves, phases, strict=True
        ):
            total += np.cos(
                position_factor * inputs[0]
                + speed_factor * inputs[1]
                + recent_speed_factor * inputs[2]
                + phase
            )
        return np.asarray(size * total)

    return EffectPart(REMAINDER_ID, axis, SignalStage.MOTION, act, sizes=(0.0, np.inf))


def _draw_time_remainder(axis: BlindAxis, rng: np.random.Generator) -> EffectPart:
    """Draw a coloured random displacement of an axis.

    It is the effect of a force that is slow compared with the period of the axis: the force divided
    by the stiffness.
    """
    poles = np.array([-2.0 * pi * rng.uniform(0.3, 6.0), -2.0 * pi * rng.uniform(6.0, 20.0)])
    noise_seed = int(rng.integers(2**31))

    def act(motion: FloatArray, run: SimulationRun, size: float) -> FloatArray:
        # The noise is drawn on a fixed grid and interpolated, so that it is the same in every run
        # at any sample rate.
        grid_s = 0.01
        time_s = np.arange(len(motion)) * run.step_s
        count = int(time_s[-1] / grid_s) + 2
        white_noise = np.random.default_rng(noise_seed).normal(0.0, 1.0, count)
        coloured_noise = apply_low_pass(white_noise, poles, grid_s)
        return np.asarray(size * np.interp(time_s, np.arange(count) * grid_s, coloured_noise))

    return EffectPart(REMAINDER_ID, axis, SignalStage.MOTION, act, sizes=(0.0, np.inf))

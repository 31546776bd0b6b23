"""The function of each effect.

Hysteresis is a Preisach plane with a smooth density or a chain of Maxwell slip elements; friction
is generalised Maxwell slip, Dahl's or elastoplastic; play a nut between two compliant flanks on a
guide of bristles; creep a Kelvin–Voigt chain; contact Hertzian; an encoder's error a Lissajous
figure evaluated by atan2.
"""

from collections.abc import Callable

import numpy as np

from rotemina.sim.blind import actuator, electronics, loads, motion, sensing, uncatalogued
from rotemina.sim.blind.part import Axis, Part

Maker = Callable[[Axis, np.random.Generator], Part]

_MAKERS: dict[str, Maker] = {
    "delay": electronics.delay,
    "amplifier_lag": electronics.amplifier_lag,
    "slew_limit": electronics.slew_limit,
    "saturation": electronics.saturation,
    "quantization": electronics.quantization,
    "gain_error": actuator.gain_error,
    "static_nonlinearity": actuator.static_nonlinearity,
    "hysteresis": actuator.hysteresis,
    "creep": actuator.creep,
    "lost_steps": actuator.lost_steps,
    "microstep_error": actuator.microstep_error,
    "backlash": loads.backlash,
    "leadscrew_error": actuator.leadscrew_error,
    "friction": loads.friction,
    "resonance_mismatch": loads.resonance_mismatch,
    "flexible_mode": loads.flexible_mode,
    "stiffness_nonlinearity": loads.stiffness_nonlinearity,
    "contact": loads.contact,
    "thermal_drift": motion.thermal_drift,
    "vibration": motion.vibration,
    "sensor_gain": sensing.sensor_gain,
    "sensor_nonlinearity": sensing.sensor_nonlinearity,
    "sensor_lag": sensing.sensor_lag,
    "sensor_noise": sensing.sensor_noise,
    "sensor_quantization": sensing.sensor_quantization,
    "sensor_drift": sensing.sensor_drift,
    "sensor_outliers": sensing.sensor_outliers,
    "encoder_interpolation": sensing.encoder_interpolation,
    "clock_skew": sensing.clock_skew,
}
_UNCATALOGUED: tuple[Maker, ...] = (
    uncatalogued.speed_history_gain,
    uncatalogued.breathing_stiffness,
    uncatalogued.quadratic_mode,
    uncatalogued.wandering_detents,
    uncatalogued.busy_delay,
    uncatalogued.weary_damping,
)


def draw_part(effect: str, axis: Axis, others: tuple[Axis, ...], rng: np.random.Generator) -> Part:
    """Draw the shape of an effect on an axis; ``unknown`` is one that is in no catalogue."""
    if effect == "cross_coupling":
        return motion.cross_coupling(axis, rng, others[rng.integers(len(others))])
    if effect == "unknown":
        if others and rng.uniform() < 0.15:
            return uncatalogued.product_of_axes(axis, rng, others)
        return _UNCATALOGUED[rng.integers(len(_UNCATALOGUED))](axis, rng)
    return _MAKERS[effect](axis, rng)

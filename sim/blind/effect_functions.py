"""The functions that draw each effect.

Hysteresis is a Preisach plane with a smooth density or a chain of Maxwell slip elements. Friction
is generalised Maxwell slip, Dahl's model or an elastoplastic model. Backlash is a nut between two
compliant flanks on a guide of bristles. Creep is a Kelvin–Voigt chain, contact is Hertzian, and an
encoder's error is a Lissajous figure evaluated by atan2.
"""

from collections.abc import Callable

import numpy as np

from rotemina.sim.blind import actuator, electronics, loads, motion, sensing, uncatalogued
from rotemina.sim.blind.part import BlindAxis, EffectPart

DrawFunction = Callable[[BlindAxis, np.random.Generator], EffectPart]

_DRAW_FUNCTIONS: dict[str, DrawFunction] = {
    "delay": electronics.draw_delay,
    "amplifier_lag": electronics.draw_amplifier_lag,
    "slew_limit": electronics.draw_slew_limit,
    "saturation": electronics.draw_saturation,
    "quantization": electronics.draw_quantization,
    "gain_error": actuator.draw_gain_error,
    "static_nonlinearity": actuator.draw_static_nonlinearity,
    "hysteresis": actuator.draw_hysteresis,
    "creep": actuator.draw_creep,
    "lost_steps": actuator.draw_lost_steps,
    "microstep_error": actuator.draw_microstep_error,
    "backlash": loads.draw_backlash,
    "leadscrew_error": actuator.draw_leadscrew_error,
    "friction": loads.draw_friction,
    "resonance_mismatch": loads.draw_resonance_mismatch,
    "flexible_mode": loads.draw_flexible_mode,
    "stiffness_nonlinearity": loads.draw_stiffness_nonlinearity,
    "contact": loads.draw_contact,
    "thermal_drift": motion.draw_thermal_drift,
    "vibration": motion.draw_vibration,
    "sensor_gain": sensing.draw_sensor_gain,
    "sensor_nonlinearity": sensing.draw_sensor_nonlinearity,
    "sensor_lag": sensing.draw_sensor_lag,
    "sensor_noise": sensing.draw_sensor_noise,
    "sensor_quantization": sensing.draw_sensor_quantization,
    "sensor_drift": sensing.draw_sensor_drift,
    "sensor_outliers": sensing.draw_sensor_outliers,
    "encoder_interpolation": sensing.draw_encoder_interpolation,
    "clock_skew": sensing.draw_clock_skew,
}
_UNCATALOGUED_DRAW_FUNCTIONS: tuple[DrawFunction, ...] = (
    uncatalogued.draw_speed_history_gain,
    uncatalogued.draw_breathing_stiffness,
    uncatalogued.draw_quadratic_mode,
    uncatalogued.draw_wandering_detents,
    uncatalogued.draw_busy_delay,
    uncatalogued.draw_directional_relaxation,
)


def draw_part(
    effect: str, axis: BlindAxis, others: tuple[BlindAxis, ...], rng: np.random.Generator
) -> EffectPart:
    """Draw the shape of an effect on an axis.

    ``effect`` is an id of the catalogue, or ``unknown`` for an effect outside every catalogue.
    """
    if effect == "cross_coupling":
        return motion.draw_cross_coupling(axis, rng, others[rng.integers(len(others))])
    if effect == "unknown":
        if others and rng.uniform() < 0.15:
            return uncatalogued.draw_axis_product(axis, rng, others)
        return _UNCATALOGUED_DRAW_FUNCTIONS[rng.integers(len(_UNCATALOGUED_DRAW_FUNCTIONS))](
            axis, rng
        )
    return _DRAW_FUNCTIONS[effect](axis, rng)

"""Effects that the generator can add to a machine: their ids, stages and axis kinds."""

from typing import Literal, NamedTuple

AxisKind = Literal["piezo", "stepper", "force"]

ALL_AXIS_KINDS: tuple[AxisKind, ...] = ("piezo", "stepper", "force")
GUIDED_AXIS_KINDS: tuple[AxisKind, ...] = ("stepper", "force")


class EffectPlacement(NamedTuple):
    """The stage at which an effect acts and the axis kinds on which it can occur."""

    stage: str
    kinds: tuple[AxisKind, ...]


# The ids are repeated here on purpose: this package must not import the effect
# models that the diagnosis under test uses.
CATALOGUE: dict[str, EffectPlacement] = {
    "delay": EffectPlacement("electronics", ALL_AXIS_KINDS),
    "amplifier_lag": EffectPlacement("electronics", ALL_AXIS_KINDS),
    "slew_limit": EffectPlacement("electronics", ("piezo",)),
    "saturation": EffectPlacement("electronics", ("piezo", "force")),
    "quantization": EffectPlacement("electronics", ALL_AXIS_KINDS),
    "gain_error": EffectPlacement("actuator", ALL_AXIS_KINDS),
    "static_nonlinearity": EffectPlacement("actuator", ALL_AXIS_KINDS),
    "hysteresis": EffectPlacement("actuator", ("piezo",)),
    "creep": EffectPlacement("actuator", ("piezo",)),
    "lost_steps": EffectPlacement("actuator", ("stepper",)),
    "microstep_error": EffectPlacement("actuator", ("stepper",)),
    "backlash": EffectPlacement("mechanics", GUIDED_AXIS_KINDS),
    "leadscrew_error": EffectPlacement("mechanics", GUIDED_AXIS_KINDS),
    "friction": EffectPlacement("mechanics", GUIDED_AXIS_KINDS),
    "resonance_mismatch": EffectPlacement("mechanics", ALL_AXIS_KINDS),
    "flexible_mode": EffectPlacement("mechanics", ALL_AXIS_KINDS),
    "cross_coupling": EffectPlacement("mechanics", ALL_AXIS_KINDS),
    "stiffness_nonlinearity": EffectPlacement("mechanics", ("piezo",)),
    "contact": EffectPlacement("mechanics", ALL_AXIS_KINDS),
    "thermal_drift": EffectPlacement("mechanics", ALL_AXIS_KINDS),
    "vibration": EffectPlacement("mechanics", ALL_AXIS_KINDS),
    "sensor_gain": EffectPlacement("sensor", ALL_AXIS_KINDS),
    "sensor_nonlinearity": EffectPlacement("sensor", ALL_AXIS_KINDS),
    "sensor_lag": EffectPlacement("sensor", ALL_AXIS_KINDS),
    "sensor_noise": EffectPlacement("sensor", ALL_AXIS_KINDS),
    "sensor_quantization": EffectPlacement("sensor", ALL_AXIS_KINDS),
    "sensor_drift": EffectPlacement("sensor", ALL_AXIS_KINDS),
    "sensor_outliers": EffectPlacement("sensor", ALL_AXIS_KINDS),
    "encoder_interpolation": EffectPlacement("sensor", GUIDED_AXIS_KINDS),
    "clock_skew": EffectPlacement("sensor", ALL_AXIS_KINDS),
}

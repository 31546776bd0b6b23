"""Everything that the generator can add to a machine: effect ids, stages and axes."""

from typing import Literal, NamedTuple

Kind = Literal["piezo", "stepper", "force"]

EVERY: tuple[Kind, ...] = ("piezo", "stepper", "force")
GUIDED: tuple[Kind, ...] = ("stepper", "force")


class Entry(NamedTuple):
    """One effect: the stage at which it acts and the axis kinds on which it can sit."""

    stage: str
    kinds: tuple[Kind, ...]


# Written out once more, not imported: this package shares nothing with the effects it tests.
CATALOGUE: dict[str, Entry] = {
    "delay": Entry("electronics", EVERY),
    "amplifier_lag": Entry("electronics", EVERY),
    "slew_limit": Entry("electronics", ("piezo",)),
    "saturation": Entry("electronics", ("piezo", "force")),
    "quantization": Entry("electronics", EVERY),
    "gain_error": Entry("actuator", EVERY),
    "static_nonlinearity": Entry("actuator", EVERY),
    "hysteresis": Entry("actuator", ("piezo",)),
    "creep": Entry("actuator", ("piezo",)),
    "lost_steps": Entry("actuator", ("stepper",)),
    "microstep_error": Entry("actuator", ("stepper",)),
    "backlash": Entry("mechanics", GUIDED),
    "leadscrew_error": Entry("mechanics", GUIDED),
    "friction": Entry("mechanics", GUIDED),
    "resonance_mismatch": Entry("mechanics", EVERY),
    "flexible_mode": Entry("mechanics", EVERY),
    "cross_coupling": Entry("mechanics", EVERY),
    "stiffness_nonlinearity": Entry("mechanics", ("piezo",)),
    "contact": Entry("mechanics", EVERY),
    "thermal_drift": Entry("mechanics", EVERY),
    "vibration": Entry("mechanics", EVERY),
    "sensor_gain": Entry("sensor", EVERY),
    "sensor_nonlinearity": Entry("sensor", EVERY),
    "sensor_lag": Entry("sensor", EVERY),
    "sensor_noise": Entry("sensor", EVERY),
    "sensor_quantization": Entry("sensor", EVERY),
    "sensor_drift": Entry("sensor", EVERY),
    "sensor_outliers": Entry("sensor", EVERY),
    "encoder_interpolation": Entry("sensor", GUIDED),
    "clock_skew": Entry("sensor", EVERY),
}

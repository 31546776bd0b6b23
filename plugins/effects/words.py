"""Names of effects, stages and formulations, in the language of the window.

The model says them in English: these tables only mark its words for translation. What is not among
them, as a plugin's effect, is shown as the model says it.
"""

from rotemina.app.shell.language import marked, translate
from rotemina.sim.effects.formulation import Effect, Stage

STAGES = (
    marked("effects", "electronics"),
    marked("effects", "actuator"),
    marked("effects", "mechanics"),
    marked("effects", "sensor"),
)
# Title and summary of each effect.
EFFECTS = (
    marked("effects", "Amplifier lag"),
    marked("effects", "Phase and gain both fall with frequency; a recorded u shows it."),
    marked("effects", "Delay"),
    marked("effects", "The phase grows with frequency while the gain stays 1."),
    marked("effects", "Quantization"),
    marked("effects", "The response comes in steps, which the mechanics filter."),
    marked("effects", "Saturation"),
    marked("effects", "The output cannot reach the command, only near the ends of the range."),
    marked("effects", "Slew limit"),
    marked("effects", "Limits only large, fast motion, which becomes a triangle."),
    marked("effects", "Creep"),
    marked(
        "effects",
        "Motion continues after a move, proportional to it, with the logarithm of time.",
    ),
    marked("effects", "Gain error"),
    marked("effects", "Proportional to the command, without memory."),
    marked("effects", "Hysteresis"),
    marked(
        "effects",
        "Loops whose width grows faster than their amplitude, at any speed; odd distortion.",
    ),
    marked("effects", "Lost steps"),
    marked("effects", "Permanent jumps by multiples of four full steps, at high load."),
    marked("effects", "Microstep error"),
    marked(
        "effects",
        "Periodic in the commanded position, every four full steps; the mechanics filter it.",
    ),
    marked("effects", "Static nonlinearity"),
    marked("effects", "A curve of the command, without memory, filtered by the mechanics."),
    marked("effects", "Backlash"),
    marked("effects", "A dead band at each reversal, equally wide at any amplitude and speed."),
    marked("effects", "Contact"),
    marked("effects", "A stop or a membrane: acts only beyond a position."),
    marked("effects", "Cross coupling"),
    marked("effects", "Follows the motion of another axis."),
    marked("effects", "Flexible mode"),
    marked("effects", "A peak or a dip where the model has none."),
    marked("effects", "Friction"),
    marked("effects", "Spikes at reversals, stick-slip at low speed; damps ringing."),
    marked("effects", "Lead screw error"),
    marked("effects", "Periodic in position, once per turn: its frequency grows with speed."),
    marked("effects", "Resonance mismatch"),
    marked("effects", "Wrong frequency or damping: visible only near the resonance."),
    marked("effects", "Stiffness nonlinearity"),
    marked("effects", "A curved static characteristic, and a resonance that shifts with position."),
    marked("effects", "Thermal drift"),
    marked("effects", "Grows without motion and settles, regardless of the command."),
    marked("effects", "Vibration"),
    marked("effects", "Periodic in time, regardless of position and command."),
    marked("effects", "Clock skew"),
    marked("effects", "A lag of the reading that grows along the record."),
    marked("effects", "Encoder interpolation error"),
    marked("effects", "Periodic in position with the period of the grating, only in the reading."),
    marked("effects", "Sensor drift"),
    marked("effects", "The reading drifts slowly, also at rest; the reference does not."),
    marked("effects", "Sensor gain error"),
    marked("effects", "The reading is off in proportion to the position; the motion is not."),
    marked("effects", "Sensor lag"),
    marked(
        "effects", "Phase and gain of the reading fall with frequency; those of the motion do not."
    ),
    marked("effects", "Sensor noise"),
    marked("effects", "White noise of the reading above the declared level, without memory."),
    marked("effects", "Sensor nonlinearity"),
    marked("effects", "The reading follows a bent curve without memory; the motion does not."),
    marked("effects", "Sensor outliers"),
    marked("effects", "Single wrong samples: spikes or dropouts of the reading."),
    marked("effects", "Sensor quantization"),
    marked("effects", "Steps of the reading, sharp at any speed: no mechanics filters them."),
)
FORMULATIONS = (
    marked("effects", "appendage"),
    marked("effects", "bouc wen"),
    marked("effects", "bow and cubic"),
    marked("effects", "compliant"),
    marked("effects", "compliant screw"),
    marked("effects", "constant rate"),
    marked("effects", "cubic"),
    marked("effects", "cubic quintic"),
    marked("effects", "detuned"),
    marked("effects", "dropouts held"),
    marked("effects", "dropouts to zero"),
    marked("effects", "event"),
    marked("effects", "exponential"),
    marked("effects", "first order"),
    marked("effects", "flicker"),
    marked("effects", "hard"),
    marked("effects", "harmonics"),
    marked("effects", "logarithmic"),
    marked("effects", "lugre"),
    marked("effects", "mode"),
    marked("effects", "modes"),
    marked("effects", "modified prandtl ishlinskii"),
    marked("effects", "moving"),
    marked("effects", "overload"),
    marked("effects", "parallel"),
    marked("effects", "polynomial"),
    marked("effects", "prandtl ishlinskii"),
    marked("effects", "progressive"),
    marked("effects", "proportional"),
    marked("effects", "random walk"),
    marked("effects", "relative"),
    marked("effects", "rigid"),
    marked("effects", "screw"),
    marked("effects", "second order"),
    marked("effects", "series"),
    marked("effects", "soft"),
    marked("effects", "spikes"),
    marked("effects", "spring"),
    marked("effects", "springs"),
    marked("effects", "static"),
    marked("effects", "stop"),
    marked("effects", "stribeck"),
    marked("effects", "ten plays"),
    marked("effects", "third order"),
    marked("effects", "tone"),
    marked("effects", "transport"),
    marked("effects", "two harmonics"),
    marked("effects", "two tones"),
    marked("effects", "uniform"),
    marked("effects", "viscous"),
    marked("effects", "warm up"),
    marked("effects", "white"),
)


def effect_title(effect: Effect) -> str:
    """Return what an effect is called."""
    return translate("effects", effect.title)


def effect_summary(effect: Effect) -> str:
    """Return the characteristic of an effect."""
    return translate("effects", effect.summary)


def stage_name(stage: Stage) -> str:
    """Return what a stage of the signal chain is called."""
    return translate("effects", stage.value)


def formulation_name(name: str) -> str:
    """Return what a formulation is called."""
    return translate("effects", spoken(name))


def spoken(name: str) -> str:
    """Return the name of a formulation or a parameter as people write it."""
    return name.replace("_", " ")

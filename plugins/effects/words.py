"""Names of effects, stages and formulations, in the language of the window.

The model says them in English: these tables only mark its words for translation. What is not among
them, as a plugin's effect, is shown as the model says it.
"""

from rotemina.plugins.effects import mark, tr
from rotemina.sim.effects.formulation import Effect, Stage

STAGES = (mark("electronics"), mark("actuator"), mark("mechanics"), mark("sensor"))
# Title and summary of each effect.
EFFECTS = (
    mark("Amplifier lag"),
    mark("Phase and gain both fall with frequency; a recorded u shows it."),
    mark("Delay"),
    mark("The phase grows with frequency while the gain stays 1."),
    mark("Quantization"),
    mark("The response comes in steps, which the mechanics filter."),
    mark("Saturation"),
    mark("The output cannot reach the command, only near the ends of the range."),
    mark("Slew limit"),
    mark("Limits only large, fast motion, which becomes a triangle."),
    mark("Creep"),
    mark("Motion continues after a move, proportional to it, with the logarithm of time."),
    mark("Gain error"),
    mark("Proportional to the command, without memory."),
    mark("Hysteresis"),
    mark("Loops whose width grows faster than their amplitude, at any speed; odd distortion."),
    mark("Lost steps"),
    mark("Permanent jumps by multiples of four full steps, at high load."),
    mark("Microstep error"),
    mark("Periodic in the commanded position, every four full steps; the mechanics filter it."),
    mark("Static nonlinearity"),
    mark("A curve of the command, without memory, filtered by the mechanics."),
    mark("Backlash"),
    mark("A dead band at each reversal, equally wide at any amplitude and speed."),
    mark("Contact"),
    mark("A stop or a membrane: acts only beyond a position."),
    mark("Cross coupling"),
    mark("Follows the motion of another axis."),
    mark("Flexible mode"),
    mark("A peak or a dip where the model has none."),
    mark("Friction"),
    mark("Spikes at reversals, stick-slip at low speed; damps ringing."),
    mark("Lead screw error"),
    mark("Periodic in position, once per turn: its frequency grows with speed."),
    mark("Resonance mismatch"),
    mark("Wrong frequency or damping: visible only near the resonance."),
    mark("Stiffness nonlinearity"),
    mark("A curved static characteristic, and a resonance that shifts with position."),
    mark("Thermal drift"),
    mark("Grows without motion and settles, regardless of the command."),
    mark("Vibration"),
    mark("Periodic in time, regardless of position and command."),
    mark("Clock skew"),
    mark("A lag of the reading that grows along the record."),
    mark("Encoder interpolation error"),
    mark("Periodic in position with the period of the grating, only in the reading."),
    mark("Sensor drift"),
    mark("The reading drifts slowly, also at rest; the reference does not."),
    mark("Sensor gain error"),
    mark("The reading is off in proportion to the position; the motion is not."),
    mark("Sensor lag"),
    mark("Phase and gain of the reading fall with frequency; those of the motion do not."),
    mark("Sensor noise"),
    mark("White noise of the reading above the declared level, without memory."),
    mark("Sensor nonlinearity"),
    mark("The reading follows a bent curve without memory; the motion does not."),
    mark("Sensor outliers"),
    mark("Single wrong samples: spikes or dropouts of the reading."),
    mark("Sensor quantization"),
    mark("Steps of the reading, sharp at any speed: no mechanics filters them."),
)
FORMULATIONS = (
    mark("appendage"),
    mark("bouc wen"),
    mark("bow and cubic"),
    mark("compliant"),
    mark("compliant screw"),
    mark("constant rate"),
    mark("cubic"),
    mark("cubic quintic"),
    mark("detuned"),
    mark("dropouts held"),
    mark("dropouts to zero"),
    mark("event"),
    mark("exponential"),
    mark("first order"),
    mark("flicker"),
    mark("hard"),
    mark("harmonics"),
    mark("logarithmic"),
    mark("lugre"),
    mark("mode"),
    mark("modes"),
    mark("modified prandtl ishlinskii"),
    mark("moving"),
    mark("overload"),
    mark("parallel"),
    mark("polynomial"),
    mark("prandtl ishlinskii"),
    mark("progressive"),
    mark("proportional"),
    mark("random walk"),
    mark("relative"),
    mark("rigid"),
    mark("screw"),
    mark("second order"),
    mark("series"),
    mark("soft"),
    mark("spikes"),
    mark("spring"),
    mark("springs"),
    mark("static"),
    mark("stop"),
    mark("stribeck"),
    mark("ten plays"),
    mark("third order"),
    mark("tone"),
    mark("transport"),
    mark("two harmonics"),
    mark("two tones"),
    mark("uniform"),
    mark("viscous"),
    mark("warm up"),
    mark("white"),
)


def effect_title(effect: Effect) -> str:
    """Return what an effect is called."""
    return tr(effect.title)


def effect_summary(effect: Effect) -> str:
    """Return the characteristic of an effect."""
    return tr(effect.summary)


def stage_name(stage: Stage) -> str:
    """Return what a stage of the signal chain is called."""
    return tr(stage.value)


def formulation_name(name: str) -> str:
    """Return what a formulation is called."""
    return tr(spoken(name))


def spoken(name: str) -> str:
    """Return the name of a formulation or a parameter as people write it."""
    return name.replace("_", " ")

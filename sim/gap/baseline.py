"""The model's own parameters, which are re-tuned beside every effect that is tried."""

from rotemina.sim.gap.evidence import Evidence
from rotemina.sim.robot.model import AxisEffect, ForceAxis

GAIN, RESONANCE, FRICTION = "gain_error", "resonance_mismatch", "friction"
OWN = (GAIN, RESONANCE)  # effects that are no more than other numbers of the model


def baseline(evidence: Evidence) -> tuple[AxisEffect, ...]:
    """Return the re-tuning of an axis' own parameters, from none on.

    A missing effect must not be taken for a wrong parameter, nor a wrong parameter for an effect.
    Where a force moves an axis that nothing holds, its mass is a gain and its damping friction.
    """
    axis = evidence.robot.axes[evidence.axis]
    found = [AxisEffect(axis=evidence.axis, id=GAIN, parameters={"error": 0.0})]
    inertia = axis.inertia
    held = inertia is not None and inertia[2] > 0.0
    if not axis.static and held and not isinstance(axis, ForceAxis):
        none = {"frequency_error": 0.0, "damping_error": 0.0}
        found.append(AxisEffect(axis=evidence.axis, id=RESONANCE, parameters=none))
    if inertia is not None and not held and isinstance(axis, ForceAxis):
        found.append(
            AxisEffect(
                axis=evidence.axis,
                id=FRICTION,
                formulation="viscous",
                parameters={"viscous": 0.0},
            )
        )
    return tuple(found)


def is_own(evidence: Evidence, effect: AxisEffect) -> bool:
    """Tell whether an effect is no more than the model's own parameters are."""
    own = {(one.id, one.formulation) for one in baseline(evidence)}
    return effect.id in OWN or (effect.id, effect.formulation) in own

"""The model's own parameters, which are re-tuned together with every candidate effect."""

from rotemina.sim.effects.facts import Facts
from rotemina.sim.effects.registry import effect_named
from rotemina.sim.gap.fit.catalogue import catalogue
from rotemina.sim.gap.fit.evidence import Evidence
from rotemina.sim.robot.model import AxisEffect


def baseline(evidence: Evidence) -> tuple[AxisEffect, ...]:
    """Return the re-tuning of an axis' own parameters, from none on.

    A missing effect must not be taken for a wrong parameter, nor a wrong parameter for an effect.
    """
    facts = Facts.of(evidence.robot.axes[evidence.axis])
    found = []
    for effect in catalogue():
        own = effect.identification.retunes(facts)
        if own is not None and facts.kind in effect.kinds:
            found.append(
                AxisEffect(
                    axis=evidence.axis,
                    id=effect.id,
                    formulation=own.formulation,
                    parameters=dict(own.values),
                )
            )
    return tuple(found)


def is_own(evidence: Evidence, effect: AxisEffect) -> bool:
    """Tell whether an effect is no more than the model's own parameters are."""
    own = {(one.id, one.formulation) for one in baseline(evidence)}
    return is_whole_own(effect.id) or (effect.id, effect.formulation) in own


def is_whole_own(effect_id: str) -> bool:
    """Tell whether an effect only changes numbers of the model, in any formulation."""
    effect = effect_named(effect_id)
    return len(effect.formulations) == 1 and effect.identification.is_retuning

"""Which effects may explain the gap of an axis: every one of the catalogue that can sit there.

What chance alone decides, sample by sample, cannot be fitted to a response: noise, drift and
outliers are found by what they leave behind, and so are events such as lost steps.
"""

from collections.abc import Iterator, Sequence

from rotemina.sim.effects.attachment import Attached
from rotemina.sim.effects.errors import EffectError
from rotemina.sim.effects.formulation import Effect, Reading
from rotemina.sim.effects.registry import all_effects
from rotemina.sim.gap.evidence import Evidence
from rotemina.sim.records.record import Tap
from rotemina.sim.robot.model import AxisEffect

_EVENTS = ("lost_steps",)


def candidates(evidence: Evidence) -> tuple[AxisEffect, ...]:
    """Return every formulation of every effect that the axis may have, with its presets.

    Effects that come from another axis are listed once for each axis that a record commands.
    """
    found: list[AxisEffect] = []
    sources = _other_axes(evidence)
    for effect in all_effects()[0].values():
        if effect.id not in _EVENTS:
            found += _formulations(evidence, effect, sources if effect.coupled else [None])
    return tuple(found)


def _formulations(
    evidence: Evidence, effect: Effect, sources: Sequence[str | None]
) -> Iterator[AxisEffect]:
    for formulation in effect.formulations:
        if isinstance(formulation.acts, Reading) and formulation.acts.random:
            continue
        for source in sources:
            asked = AxisEffect(
                axis=evidence.axis, id=effect.id, formulation=formulation.name, from_axis=source
            )
            try:
                Attached.of(evidence.robot, asked)
            except EffectError:
                continue  # it cannot sit on this kind of axis
            yield asked


def _other_axes(evidence: Evidence) -> list[str | None]:
    commanded = dict.fromkeys(
        name
        for observation in evidence.observations
        for name in observation.record.axes
        if observation.record.has(name, Tap.CMD)
    )
    return [name for name in commanded if name != evidence.axis]

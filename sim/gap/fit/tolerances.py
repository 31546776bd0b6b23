"""How far a fit may take a parameter: where it would be another effect, or another machine."""

from rotemina.sim.effects.attachment import Attached
from rotemina.sim.effects.formulation import Parameter
from rotemina.sim.effects.identification import Extent, Interval


def tolerance(attached: Attached, parameter: Parameter, extent: Extent) -> Interval:
    """Return the least and greatest value of a parameter that a fit to records may find, SI."""
    bounds = parameter.bounds(attached.facts)
    domain = attached.effect.identification.domain.get(parameter.name, bounds)
    if callable(domain):
        return domain(attached.values, attached.facts, bounds, extent)
    return domain

"""How far a fit may take a parameter: where it would be another effect, or another machine."""

from collections.abc import Callable, Mapping

from rotemina.sim.effects.attachment import Attached
from rotemina.sim.effects.formulation import Parameter

Interval = tuple[float, float]

_TOUCHED = 0.7  # of the way that an axis goes, over which a contact may act
_AT_ONCE_S = 5e-4  # over which an axis may be asked to go all its way


def tolerance(attached: Attached, parameter: Parameter, reach: Interval) -> Interval:
    """Return the least and greatest value of a parameter that a fit may find, SI.

    ``reach``: the least and the greatest command of all records, m or rad.
    """
    key = attached.effect.id, parameter.name
    by_records = _BY_RECORDS.get(key)
    if by_records is not None:
        return by_records(attached, parameter, reach)
    return _FIXED.get(key) or parameter.bounds(attached.facts)


def _met_on_the_way(attached: Attached, _parameter: Parameter, reach: Interval) -> Interval:
    """Return where a contact may be, from the low end of the range: a good part of the way is free.

    What acts wherever the axis goes is no contact but another characteristic of it.
    """
    least, most = reach
    strength = attached.values.get("stiffness", attached.values.get("blocked", 1.0))
    shares = (1.0 - _TOUCHED, 1.0) if strength >= 0.0 else (0.0, _TOUCHED)
    low, high = ((least + share * (most - least)) - attached.facts.low for share in shares)
    return max(low, 0.0), min(high, attached.facts.span)


def _slower_than_asked(attached: Attached, parameter: Parameter, reach: Interval) -> Interval:
    """Return rates, in inputs per second, of which the greatest is one that hardly anything asks.

    Beyond it is no limit: a soft one that never acts would pass for a lag.
    """
    low, high = parameter.bounds(attached.facts)
    asked = (reach[1] - reach[0]) / attached.facts.gain / _AT_ONCE_S
    return low, max(min(high, asked), 2.0 * low)


_FIXED: Mapping[tuple[str, str], Interval] = {
    ("encoder_interpolation", "period"): (1e-7, 2e-4),  # a screw's, beyond
    ("flexible_mode", "damping_ratio"): (1e-4, 0.35),  # a lag, beyond
    ("resonance_mismatch", "frequency_error"): (-0.3, 0.3),
    ("resonance_mismatch", "damping_error"): (-0.8, 4.0),
}
_BY_RECORDS: Mapping[tuple[str, str], Callable[[Attached, Parameter, Interval], Interval]] = {
    ("contact", "place"): _met_on_the_way,
    ("slew_limit", "rate"): _slower_than_asked,
}

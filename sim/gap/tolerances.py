"""How far a fit may take a parameter: where it would be another effect, or another machine."""

from collections.abc import Callable, Mapping
from typing import NamedTuple

from rotemina.sim.effects.attachment import Attached
from rotemina.sim.effects.formulation import Parameter

Interval = tuple[float, float]

_TOUCHED = 0.7  # of the way that an axis goes, over which a contact may act
_AT_ONCE_S = 5e-4  # over which an axis may be asked to go all its way
_PERIODS = 3.0  # that a record holds of what is periodic: less of it is any slow change


class Extent(NamedTuple):
    """What records cover: the least and the greatest command, m or rad; the longest's time."""

    reach: Interval
    longest_s: float


def tolerance(attached: Attached, parameter: Parameter, extent: Extent) -> Interval:
    """Return the least and greatest value of a parameter that a fit to records may find, SI."""
    key = attached.effect.id, parameter.name
    by_records = _BY_RECORDS.get(key)
    if by_records is not None:
        return by_records(attached, parameter, extent)
    return _FIXED.get(key) or parameter.bounds(attached.facts)


def _met_on_the_way(attached: Attached, _parameter: Parameter, extent: Extent) -> Interval:
    """Return where a contact may be, from the low end of the range: a good part of the way is free.

    What acts wherever the axis goes is no contact but another characteristic of it.
    """
    least, most = extent.reach
    strength = attached.values.get("stiffness", attached.values.get("blocked", 1.0))
    shares = (1.0 - _TOUCHED, 1.0) if strength >= 0.0 else (0.0, _TOUCHED)
    low, high = ((least + share * (most - least)) - attached.facts.low for share in shares)
    return max(low, 0.0), min(high, attached.facts.span)


def _slower_than_asked(attached: Attached, parameter: Parameter, extent: Extent) -> Interval:
    """Return rates, in inputs per second, of which the greatest is one that hardly anything asks.

    Beyond it is no limit: a soft one that never acts would pass for a lag.
    """
    low, high = parameter.bounds(attached.facts)
    asked = (extent.reach[1] - extent.reach[0]) / attached.facts.gain / _AT_ONCE_S
    return low, max(min(high, asked), 2.0 * low)


def _seen_to_return(attached: Attached, parameter: Parameter, extent: Extent) -> Interval:
    """Return frequencies, in Hz, of which a record holds a few periods."""
    low, high = parameter.bounds(attached.facts)
    return min(max(low, _PERIODS / extent.longest_s), high), high


_FIXED: Mapping[tuple[str, str], Interval] = {
    ("encoder_interpolation", "period"): (1e-7, 2e-4),  # a screw's, beyond
    ("flexible_mode", "damping_ratio"): (1e-4, 0.35),  # a lag, beyond
    ("resonance_mismatch", "frequency_error"): (-0.3, 0.3),
    ("resonance_mismatch", "damping_error"): (-0.8, 4.0),
}
_BY_RECORDS: Mapping[tuple[str, str], Callable[[Attached, Parameter, Extent], Interval]] = {
    ("contact", "place"): _met_on_the_way,
    ("slew_limit", "rate"): _slower_than_asked,
    ("vibration", "frequency"): _seen_to_return,
}

"""The way back for a tip outside its bounds: messages, and the permitted directions."""

from rotemina.app.motion.position_envelope import PositionEnvelope
from rotemina.sim.kinematics.keep_out import Excess, KeepOutZone
from rotemina.sim.messages import Listed, Message, message
from rotemina.sim.quantities import exact

_CLOSER = 1e-9  # m by which each axis has to bring the tip nearer to its bounds


def nearer(
    zone: KeepOutZone, envelope: PositionEnvelope, column: int, at: float, out: Excess
) -> bool:
    """Return whether an axis that goes there alone brings the commanded tip back, all the way."""
    low, high = envelope.low.copy(), envelope.high.copy()
    low[column] = high[column] = at
    before, end, way = (
        zone.excess(zone.swept(*bounds))
        for bounds in (
            (envelope.low, envelope.high),
            (low, high),
            envelope.widened({column: at})[:2],
        )
    )
    broken = [number for number, excess in enumerate(out) if excess > 0.0]
    return all(way[k] <= before[k] + _CLOSER for k in broken) and any(
        end[k] < before[k] - _CLOSER for k in broken
    )


def out_text(out: Excess) -> Message:
    """Return a text that says how far the tip is outside its bounds, and what to do."""
    where = (
        (message("engine", "{much} below its floor"), out.below),
        (message("engine", "{much} above the objective's height"), out.above),
        (message("engine", "{much} outside its radius"), out.aside),
    )
    told = tuple(how.fill(much=exact(much, "m")) for how, much in where if much > 0.0)
    return message(
        "engine",
        "tip: {told}, by command or by reading: it may only move back inside, "
        "slowly and with confirmation, by axes that bring it nearer. Move it back, "
        "or repair the wrong sensor",
    ).fill(told=Listed(told))

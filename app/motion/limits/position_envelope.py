"""Bounds of the current positions, and moves that bring a tip back within its own bounds."""

from collections.abc import Iterator, Mapping
from typing import NamedTuple

from rotemina.sim.arrays import FloatArray
from rotemina.sim.kinematics import KeepOutZone, TipExcess
from rotemina.sim.messages import (
    FieldList,
    Message,
    message,
)
from rotemina.sim.units import format_exact

# Each axis must bring the tip nearer to its bounds by at least this distance.
_MIN_APPROACH_M = 1e-9


class PositionEnvelope(NamedTuple):
    """Possible current positions of the axes: bounds (axes,) of all commands that may act.

    ``deviation`` (axes,) is the difference of readings from commands beyond noise. Checks of the
    tip use its commanded position, and also its measured position, which is shifted by the
    deviation.
    """

    low: FloatArray
    high: FloatArray
    deviation: FloatArray

    def with_positions(self, positions: Mapping[int, float]) -> "PositionEnvelope":
        """Return the envelope extended to include the positions of some axes, by column."""
        low, high = self.low.copy(), self.high.copy()
        for column, position in positions.items():
            low[column], high[column] = min(low[column], position), max(high[column], position)
        return PositionEnvelope(low, high, self.deviation)

    def iterate_bounds(self) -> Iterator[tuple[FloatArray, FloatArray]]:
        """Yield the commanded bounds, and the measured bounds if they differ."""
        yield self.low, self.high
        if self.deviation.any():
            yield self.low + self.deviation, self.high + self.deviation


def is_return_move(
    zone: KeepOutZone, envelope: PositionEnvelope, column: int, target: float, excess: TipExcess
) -> bool:
    """Return whether a move of one axis to a target brings the tip nearer to its bounds.

    On the way the tip must not get farther away from any bound that it exceeds.
    """
    low, high = envelope.low.copy(), envelope.high.copy()
    low[column] = high[column] = target
    current_excess, end_excess, swept_excess = (
        zone.measure_excess(zone.find_swept_box(*bounds))
        for bounds in (
            (envelope.low, envelope.high),
            (low, high),
            envelope.with_positions({column: target})[:2],
        )
    )
    exceeded_bounds = [bound for bound, distance in enumerate(excess) if distance > 0.0]
    return all(
        swept_excess[bound] <= current_excess[bound] + _MIN_APPROACH_M for bound in exceeded_bounds
    ) and any(
        end_excess[bound] < current_excess[bound] - _MIN_APPROACH_M for bound in exceeded_bounds
    )


def describe_tip_excess(excess: TipExcess) -> Message:
    """Return a message on how far the tip is outside its bounds, and on what to do."""
    bounds = (
        (message("engine", "{much} below its floor"), excess.below),
        (message("engine", "{much} above the objective's height"), excess.above),
        (message("engine", "{much} outside its radius"), excess.aside),
    )
    excesses = tuple(
        text.fill(much=format_exact(amount, "m")) for text, amount in bounds if amount > 0.0
    )
    return message(
        "engine",
        "tip: {told} (by command or by reading). It may only move back inside: "
        "slowly, with confirmation, and by axes that bring it nearer. Move it back, "
        "or repair the faulty sensor",
    ).fill(told=FieldList(excesses))

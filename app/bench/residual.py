"""The residual of a model on records that no fit used."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.gap.errors import GapError
from rotemina.sim.gap.fit.evidence import Evidence
from rotemina.sim.gap.intake.time_leaps import pieces
from rotemina.sim.plant.response import nominal_response
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import Robot


class Residual(NamedTuple):
    """Rms of gap, of signal and of the noise floor at a tap, over all axes and records; SI."""

    gap: float
    signal: float
    floor: float

    @property
    def relative(self) -> float:
        """The gap over the signal."""
        return self.gap / self.signal


def residual_of(robot: Robot, records: Sequence[Record], tap: Tap) -> Residual:
    """Return what a model leaves of records.

    Of positions the mean is taken off, and what each record remembers from before its first row is
    its own. Of what a controller puts out nothing is taken off.

    Raises
    ------
    GapError
        If no record measures the tap.
    PlantError, EffectError
        If the model cannot be simulated.
    """
    squares = np.array(list(_squares(robot, [one.record for one in pieces(records)], tap)))
    if len(squares) == 0:
        raise GapError(f"no test record measures {tap}; name another tap in truth.toml")
    gap, signal, floor, rows = squares.sum(axis=0)
    return Residual(*np.sqrt(np.array([gap, signal, floor]) / rows).tolist())


def _squares(
    robot: Robot, records: Sequence[Record], tap: Tap
) -> Iterator[tuple[float, float, float, int]]:
    """Give sums of squares of gap, signal and floor, and rows, by record and axis."""
    for record in records:
        for axis in record.axes:
            if not record.has(axis, tap):
                continue
            real = record.signal(axis, tap)
            evidence = Evidence.of(robot, axis, [record])
            rows = len(real)
            if tap is Tap.U:
                gap = real - nominal_response(robot, record).signal(axis, tap)
                yield _sum(gap), _sum(real), 0.0, rows
                continue
            floor = evidence.floor(tap)
            (own,) = (part.rows for part in evidence.parts if part.tap == tap)
            gap = floor * evidence.residual()[own]
            yield _sum(gap), _sum(real - real.mean()), rows * floor**2, rows


def _sum(signal: FloatArray) -> float:
    return float(np.sum(signal**2))

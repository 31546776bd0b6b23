"""The residual of a model on records that were not used for fitting."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import GapError
from rotemina.sim.gap.fit import Evidence
from rotemina.sim.gap.intake import split_at_leaps
from rotemina.sim.plant import simulate_nominal_response
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import Robot


class ModelResidual(NamedTuple):
    """Rms of gap, signal and noise floor at a tap, over all axes and records, in SI units."""

    gap: float
    signal: float
    floor: float

    @property
    def relative(self) -> float:
        """Rms of the gap divided by that of the signal."""
        return self.gap / self.signal


def compute_model_residual(robot: Robot, records: Sequence[Record], tap: Tap) -> ModelResidual:
    """Compute the residual of a model on records.

    For positions, the mean is subtracted, and each record has its own fitted initial state, because
    the motion before its first row is unknown. From a controller output, nothing is subtracted.

    Raises
    ------
    GapError
        If no record measures the tap.
    PlantError, EffectError
        If the model cannot be simulated.
    """
    squares = np.array(
        list(_sum_squares_by_axis(robot, [piece.record for piece in split_at_leaps(records)], tap))
    )
    if len(squares) == 0:
        raise GapError(f"no test record measures {tap}; name another tap in truth.toml")
    gap, signal, floor, row_count = squares.sum(axis=0)
    return ModelResidual(*np.sqrt(np.array([gap, signal, floor]) / row_count).tolist())


def _sum_squares_by_axis(
    robot: Robot, records: Sequence[Record], tap: Tap
) -> Iterator[tuple[float, float, float, int]]:
    """Yield the sums of squares of gap, signal and floor, and the row count, by record and axis."""
    for record in records:
        for axis in record.axes:
            if not record.has(axis, tap):
                continue
            measured = record.signal(axis, tap)
            evidence = Evidence.of(robot, axis, [record])
            row_count = len(measured)
            if tap is Tap.U:
                gap = measured - simulate_nominal_response(robot, record).signal(axis, tap)
                yield _sum_squares(gap), _sum_squares(measured), 0.0, row_count
                continue
            floor = evidence.floor(tap)
            (tap_rows,) = (part.rows for part in evidence.parts if part.tap == tap)
            gap = floor * evidence.residual()[tap_rows]
            signal_squares = _sum_squares(measured - measured.mean())
            yield _sum_squares(gap), signal_squares, row_count * floor**2, row_count


def _sum_squares(signal: FloatArray) -> float:
    return float(np.sum(signal**2))

"""The share of the gap that a prediction closes on the withheld record."""

from collections.abc import Mapping
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.comparison.noise_floor import noise_floor
from rotemina.sim.plant.response import nominal_response
from rotemina.sim.records.reading import read_record
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import Robot

_EXERCISE_S = 1.0  # the axes are only exercised, so that their memory is known
_LEAST_GAP = 1.05  # of the floor: below it there is nothing to close

# Where no model can say what happens at which sample.
UNPREDICTABLE = frozenset(
    {"sensor_noise", "sensor_drift", "sensor_outliers", "vibration", "lost_steps"}
)


class Gap(NamedTuple):
    """Rms residuals without offset of the nominal and the corrected model, and the floor."""

    before: float
    after: float
    floor: float


def held_out_gaps(robot: Robot, measured: Path, predicted: bytes) -> dict[str, Gap]:
    """Return the gap of each axis on the withheld record (m or rad)."""
    record = read_record(measured, robot=robot)
    with TemporaryDirectory() as folder:
        written = Path(folder) / "predicted.csv"
        written.write_bytes(predicted)
        corrected = read_record(written, robot=robot)
    nominal = nominal_response(robot, record)
    return {
        axis: Gap(
            _rms(record, axis, nominal.signal(axis, Tap.MEAS)),
            _rms(record, axis, corrected.signal(axis, Tap.MEAS)),
            noise_floor(robot, record, axis, Tap.MEAS).rms or 0.0,
        )
        for axis in record.axes
        if record.has(axis, Tap.MEAS)
    }


def _rms(record: Record, axis: str, model: FloatArray) -> float:
    later = record.time_s >= record.time_s[0] + _EXERCISE_S
    return float(np.std((record.signal(axis, Tap.MEAS) - model)[later]))


def closure(gaps: Mapping[str, Gap], truth: Mapping[str, list[str]]) -> float | None:
    """Return the share of the gap's power above the floor that is closed, 0 to 1.

    ``truth`` maps each axis with a gap to its effects; axes whose effects cannot be predicted
    sample by sample, or whose gap does not show on this record, are left out. None if all are.
    """
    before = after = 0.0
    for axis, effects in truth.items():
        gap = gaps.get(axis)
        if gap is None or gap.floor <= 0.0 or UNPREDICTABLE & set(effects):
            continue
        if gap.before > _LEAST_GAP * gap.floor:
            before += (gap.before / gap.floor) ** 2 - 1.0
            after += (gap.after / gap.floor) ** 2 - 1.0
    return None if before == 0.0 else float(np.clip(1.0 - after / before, 0.0, 1.0))

"""The share of the gap that the corrected model closes on the withheld record."""

from collections.abc import Mapping
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.comparison import find_noise_floor
from rotemina.sim.plant import simulate_nominal_response
from rotemina.sim.records import Record, Tap, read_record
from rotemina.sim.robot import Robot

# The start of the record only brings the axes into a known state, and does not count.
_WARM_UP_S = 1.0
# A gap below this multiple of the noise floor counts as no gap.
_MIN_GAP_TO_FLOOR_RATIO = 1.05

# No model can predict these effects sample by sample.
UNPREDICTABLE_EFFECTS = frozenset(
    {"sensor_noise", "sensor_drift", "sensor_outliers", "vibration", "lost_steps"}
)


class HeldOutGap(NamedTuple):
    """Rms residuals of the nominal and the corrected model without their means, and noise floor."""

    before: float
    after: float
    floor: float


def compute_held_out_gaps(robot: Robot, measured: Path, predicted: bytes) -> dict[str, HeldOutGap]:
    """Compute the gap of each axis on the withheld record, m or rad.

    ``predicted`` is the text of the record that the corrected model predicts.
    """
    record = read_record(measured, robot=robot)
    with TemporaryDirectory() as folder:
        path = Path(folder) / "predicted.csv"
        path.write_bytes(predicted)
        corrected = read_record(path, robot=robot)
    nominal = simulate_nominal_response(robot, record)
    return {
        axis: HeldOutGap(
            _compute_rms(record, axis, nominal.signal(axis, Tap.MEAS)),
            _compute_rms(record, axis, corrected.signal(axis, Tap.MEAS)),
            find_noise_floor(robot, record, axis, Tap.MEAS).rms or 0.0,
        )
        for axis in record.axes
        if record.has(axis, Tap.MEAS)
    }


def _compute_rms(record: Record, axis: str, predicted: FloatArray) -> float:
    is_counted = record.time_s >= record.time_s[0] + _WARM_UP_S
    return float(np.std((record.signal(axis, Tap.MEAS) - predicted)[is_counted]))


def compute_closure(gaps: Mapping[str, HeldOutGap], truth: Mapping[str, list[str]]) -> float | None:
    """Compute how much of the gap's power above the noise floor is closed, 0 to 1.

    ``truth`` maps each axis with a gap to its effects. An axis is left out if its effects cannot be
    predicted sample by sample, or if its gap is not visible in this record. The result is None if
    no axis remains.
    """
    before = after = 0.0
    for axis, effects in truth.items():
        gap = gaps.get(axis)
        if gap is None or gap.floor <= 0.0 or UNPREDICTABLE_EFFECTS & set(effects):
            continue
        if gap.before > _MIN_GAP_TO_FLOOR_RATIO * gap.floor:
            before += (gap.before / gap.floor) ** 2 - 1.0
            after += (gap.after / gap.floor) ** 2 - 1.0
    return None if before == 0.0 else float(np.clip(1.0 - after / before, 0.0, 1.0))

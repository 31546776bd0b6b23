"""Joining a laser's record, which has its own clock, to the record of a machine.

The motion itself shows the difference of the clocks. A coarse shift comes from the correlation of
the speeds. Least squares of ``reading = a + b · laser(t + s + r t)`` then refines it. A sensor
lag becomes part of s and can no longer be identified.
"""

import numpy as np
from scipy.signal import correlate

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import SensorCalibrationError
from rotemina.sim.records import (
    Record,
    RecordChannel,
    Tap,
)

_COARSE_HZ = 100.0
_MAX_ITERATIONS = 20
# Records with a lower correlation do not show the same motion.
_MIN_CORRELATION = 0.9
# The laser's record must cover this share of the machine's record.
_MIN_COVERED_SHARE = 0.5


def join_laser_record(record: Record, laser: Record, axis: str) -> Record:
    """Join a laser's record to a record as ``ref`` of an axis, and return the rows that both cover.

    Parameters
    ----------
    record : Record
        With ``meas`` of the axis.
    laser : Record
        With ``ref`` of the axis, or with one column without a tap (``x [mm]``).
    axis : str

    Raises
    ------
    SensorCalibrationError
        If a column is missing, or if the records do not show the same motion.
    """
    if not record.has(axis, Tap.MEAS):
        raise SensorCalibrationError(
            "record: there is no column {axis}.meas to match with the laser", axis=axis
        )
    tap = next((candidate for candidate in (Tap.REF, Tap.CMD) if laser.has(axis, candidate)), None)
    if tap is None:
        raise SensorCalibrationError(
            "laser: there is no column {axis}.ref; it has {names}",
            axis=axis,
            names=", ".join(map(str, laser.columns)),
        )
    laser_values, laser_s = laser.signal(axis, tap), laser.time_s - laser.time_s[0]
    reading, time_s = record.signal(axis, Tap.MEAS), record.time_s - record.time_s[0]
    shift_s, rate = _refine_shift(
        time_s,
        reading,
        laser_s,
        laser_values,
        _find_coarse_shift(time_s, reading, laser_s, laser_values),
    )
    machine_on_laser_s = shift_s + (1.0 + rate) * time_s
    covered = (machine_on_laser_s >= laser_s[0]) & (machine_on_laser_s <= laser_s[-1])
    reference = np.interp(machine_on_laser_s, laser_s, laser_values)
    if (
        covered.mean() < _MIN_COVERED_SHARE
        or _compute_correlation(reading[covered], reference[covered]) < _MIN_CORRELATION
    ):
        raise SensorCalibrationError(
            "laser: its motion does not match that of {axis} in the record at any shift "
            "of the clocks; use the files of one run",
            axis=axis,
        )
    names = [name for name in record.columns if name != RecordChannel(axis, Tap.REF)]
    signals: dict[tuple[str, Tap], FloatArray] = {}
    for name in names:
        signals[name.axis, name.tap] = record.signal(*name)[covered]
    signals[axis, Tap.REF] = reference[covered]
    metadata = {**record.metadata, "laser_shift_s": repr(float(shift_s)), "laser_rate": repr(rate)}
    return Record.from_signals(record.time_s[covered], signals, record.units, metadata)


def _find_coarse_shift(
    time_s: FloatArray, reading: FloatArray, laser_s: FloatArray, laser_values: FloatArray
) -> float:
    """Return the laser's clock minus the machine's clock at the same motion, s, to within 10 ms."""
    speeds = []
    for clock_s, signal in ((time_s, reading), (laser_s, laser_values)):
        grid_s = np.arange(0.0, clock_s[-1], 1.0 / _COARSE_HZ)
        if len(grid_s) < 2:
            raise SensorCalibrationError(
                "a record of less than 20 ms cannot be matched with another"
            )
        speeds.append(np.gradient(np.interp(grid_s, clock_s, signal)))
    correlation = correlate(speeds[1], speeds[0])
    return float((int(np.argmax(correlation)) - (len(speeds[0]) - 1)) / _COARSE_HZ)


def _refine_shift(
    time_s: FloatArray,
    reading: FloatArray,
    laser_s: FloatArray,
    laser_values: FloatArray,
    shift_s: float,
) -> tuple[float, float]:
    """Return the shift s, in seconds, and the relative rate deviation r of the laser's clock."""
    rate = 0.0
    slope = np.gradient(laser_values, laser_s)
    centred = time_s - time_s.mean()
    for _ in range(_MAX_ITERATIONS):
        on_laser_s = shift_s + (1.0 + rate) * time_s
        laser_at_rows, slope_at_rows = (
            np.interp(on_laser_s, laser_s, laser_values),
            np.interp(on_laser_s, laser_s, slope),
        )
        covered = (on_laser_s >= laser_s[0]) & (on_laser_s <= laser_s[-1])
        columns = np.stack(
            [np.ones_like(laser_at_rows), laser_at_rows, slope_at_rows, slope_at_rows * centred],
            axis=1,
        )[covered]
        scale = np.sqrt(np.mean(columns**2, axis=0)) + np.finfo(np.float64).tiny
        solution = np.linalg.lstsq(columns / scale, reading[covered], rcond=1e-9)[0] / scale
        gain = solution[1] if abs(solution[1]) > np.finfo(np.float64).tiny else 1.0
        step_s, rate_step = solution[2] / gain, solution[3] / gain
        shift_s += step_s - rate_step * time_s.mean()
        rate += rate_step
        if abs(step_s) < 1e-8:
            break
    return float(shift_s), float(rate)


def _compute_correlation(a: FloatArray, b: FloatArray) -> float:
    with np.errstate(invalid="ignore", divide="ignore"):
        return float(np.nan_to_num(np.corrcoef(a, b)[0, 1]))

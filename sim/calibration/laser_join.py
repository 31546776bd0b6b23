"""Joining a laser's record, with its own clock, to the record of a machine.

The clocks' difference is found by the motion itself: roughly by correlating the speeds, then by
least squares of ``reading = a + b · laser(t + s + r t)``. A lag of the sensor goes into s, so it
cannot be told any more.
"""

import numpy as np
from scipy.signal import correlate

from rotemina.sim.arrays import FloatArray
from rotemina.sim.calibration.errors import CalibrationError
from rotemina.sim.messages import message
from rotemina.sim.records.record import Channel, Record, Tap

_COARSE_HZ = 100.0
_ROUNDS = 20
_ALIKE = 0.9  # correlation of both from which they are of the same motion
_LEAST_SHARE = 0.5  # of the machine's record that the laser's covers


def joined(record: Record, laser: Record, axis: str) -> Record:
    """Return the rows of a record that a laser's record covers, with ``ref`` of an axis.

    Parameters
    ----------
    record : Record
        With ``meas`` of the axis.
    laser : Record
        With ``ref`` of it; one column without a tap (``x [mm]``) does too.
    axis : str

    Raises
    ------
    CalibrationError
        If either lacks its column, or they are not of the same motion.
    """
    if not record.has(axis, Tap.MEAS):
        raise CalibrationError(
            message(
                "engine", "record: there is no column {axis}.meas to match with the laser"
            ).fill(axis=axis)
        )
    tap = next((each for each in (Tap.REF, Tap.CMD) if laser.has(axis, each)), None)
    if tap is None:
        raise CalibrationError(
            message("engine", "laser: there is no column {axis}.ref; it has {names}").fill(
                axis=axis, names=", ".join(map(str, laser.columns))
            )
        )
    seen, seen_s = laser.signal(axis, tap), laser.time_s - laser.time_s[0]
    reading, time_s = record.signal(axis, Tap.MEAS), record.time_s - record.time_s[0]
    shift_s, rate = _refined(time_s, reading, seen_s, seen, _coarse(time_s, reading, seen_s, seen))
    at_s = shift_s + (1.0 + rate) * time_s
    covered = (at_s >= seen_s[0]) & (at_s <= seen_s[-1])
    reference = np.interp(at_s, seen_s, seen)
    if covered.mean() < _LEAST_SHARE or _related(reading[covered], reference[covered]) < _ALIKE:
        raise CalibrationError(
            message(
                "engine",
                "laser: its motion does not match that of {axis} in the record at any shift "
                "of the clocks; use the files of one run",
            ).fill(axis=axis)
        )
    names = [name for name in record.columns if name != Channel(axis, Tap.REF)]
    signals: dict[tuple[str, Tap], FloatArray] = {}
    for name in names:
        signals[name.axis, name.tap] = record.signal(*name)[covered]
    signals[axis, Tap.REF] = reference[covered]
    metadata = {**record.metadata, "laser_shift_s": repr(float(shift_s)), "laser_rate": repr(rate)}
    return Record.from_signals(record.time_s[covered], signals, record.units, metadata)


def _coarse(time_s: FloatArray, reading: FloatArray, seen_s: FloatArray, seen: FloatArray) -> float:
    """Return by how much later the laser's clock shows the same motion, to 10 ms."""
    speeds = []
    for own_s, signal in ((time_s, reading), (seen_s, seen)):
        grid_s = np.arange(0.0, own_s[-1], 1.0 / _COARSE_HZ)
        if len(grid_s) < 2:
            raise CalibrationError(
                message("engine", "a record of less than 20 ms cannot be matched with another")
            )
        speeds.append(np.gradient(np.interp(grid_s, own_s, signal)))
    answer = correlate(speeds[1], speeds[0])
    return float((int(np.argmax(answer)) - (len(speeds[0]) - 1)) / _COARSE_HZ)


def _refined(
    time_s: FloatArray, reading: FloatArray, seen_s: FloatArray, seen: FloatArray, shift_s: float
) -> tuple[float, float]:
    """Return shift, s, and rate of the laser's clock against the machine's."""
    rate = 0.0
    slope = np.gradient(seen, seen_s)
    centred = time_s - time_s.mean()
    for _ in range(_ROUNDS):
        at_s = shift_s + (1.0 + rate) * time_s
        here, moved = np.interp(at_s, seen_s, seen), np.interp(at_s, seen_s, slope)
        kept = (at_s >= seen_s[0]) & (at_s <= seen_s[-1])
        table = np.stack([np.ones_like(here), here, moved, moved * centred], axis=1)[kept]
        scale = np.sqrt(np.mean(table**2, axis=0)) + np.finfo(np.float64).tiny
        found = np.linalg.lstsq(table / scale, reading[kept], rcond=1e-9)[0] / scale
        gain = found[1] if abs(found[1]) > np.finfo(np.float64).tiny else 1.0
        step_s, turn = found[2] / gain, found[3] / gain
        shift_s += step_s - turn * time_s.mean()
        rate += turn
        if abs(step_s) < 1e-8:
            break
    return float(shift_s), float(rate)


def _related(a: FloatArray, b: FloatArray) -> float:
    with np.errstate(invalid="ignore", divide="ignore"):
        return float(np.nan_to_num(np.corrcoef(a, b)[0, 1]))

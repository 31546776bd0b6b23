"""Numerical features of a residual, for the naive classifier."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from scipy.signal import periodogram
from scipy.stats import kurtosis

from rotemina.sim.arrays import FloatArray
from rotemina.sim.comparison import find_noise_floor
from rotemina.sim.plant import simulate_nominal_response
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import PiezoAxis, Robot

_BAND_EDGES_HZ = (0.0, 2.0, 20.0, 100.0, np.inf)
_EPSILON = 1e-12


def compute_gap_in_floors(robot: Robot, records: Sequence[Record], axis: str) -> float:
    """Return the rms of (measured − nominal reading) without its mean, in noise floors."""
    mean_squares = [
        float(np.mean(_compute_residual(robot, record, axis) ** 2)) for record in records
    ]
    return float(np.sqrt(np.mean(mean_squares)))


def compute_features(robot: Robot, records: Sequence[Record], axis: str) -> FloatArray:
    """Return features (f,) of the residual of an axis over all records."""
    rows = np.array([_compute_record_features(robot, record, axis) for record in records])
    is_piezo = float(isinstance(robot.axes[axis], PiezoAxis))
    return np.concatenate([rows.mean(axis=0), rows.max(axis=0), rows.min(axis=0), [is_piezo]])


def _compute_residual(robot: Robot, record: Record, axis: str) -> FloatArray:
    nominal = simulate_nominal_response(robot, record).signal(axis, Tap.MEAS)
    gap = record.signal(axis, Tap.MEAS) - nominal
    # Without a known noise floor, the residual stays in SI units.
    floor = find_noise_floor(robot, record, axis, Tap.MEAS).rms or 1.0
    return np.asarray((gap - gap.mean()) / floor)


def _compute_record_features(robot: Robot, record: Record, axis: str) -> list[float]:
    residual = _compute_residual(robot, record, axis)
    command = _standardise(record.signal(axis, Tap.CMD))
    speed = np.gradient(command)
    time_s = _standardise(record.time_s)
    regressors = [command, command**2, command**3, speed, np.sign(speed), np.gradient(speed)]
    regressors += [time_s, np.sqrt(record.time_s - record.time_s[0])]
    other_commands = [record.signal(other, Tap.CMD) for other in record.axes if other != axis]
    cross_axis_correlations = [
        _compute_squared_correlation(residual, commands) for commands in other_commands
    ]
    return [
        float(np.log10(np.std(residual) + _EPSILON)),
        *(_compute_squared_correlation(residual, regressor) for regressor in regressors),
        max(cross_axis_correlations, default=0.0),
        *_compute_band_shares(residual, record.duration_s),
        float(np.log10(3.0 + kurtosis(residual))),
        *(_compute_squared_correlation(residual[lag:], residual[:-lag]) for lag in (1, 10, 100)),
        _compute_sensor_error_share(record, axis, residual),
    ]


def _standardise(values: FloatArray) -> FloatArray:
    return np.asarray((values - values.mean()) / (values.std() + _EPSILON))


def _compute_squared_correlation(residual: FloatArray, regressor: FloatArray) -> float:
    return float(np.mean(_standardise(residual) * _standardise(regressor)) ** 2)


def _compute_band_shares(residual: FloatArray, duration_s: float) -> list[float]:
    """Return the share of the power in each band, and the share of the strongest spectral line."""
    frequencies_hz, power = periodogram(residual, (len(residual) - 1) / max(duration_s, _EPSILON))
    power = power / (power.sum() + _EPSILON)
    edge_rows = np.searchsorted(frequencies_hz, _BAND_EDGES_HZ)
    shares = [float(power[low:high].sum()) for low, high in pairwise(edge_rows)]
    return [*shares, float(power.max())]


def _compute_sensor_error_share(record: Record, axis: str, residual: FloatArray) -> float:
    """Return the share of the residual that the sensor error (reading minus reference) explains.

    Without a reference, the share is 0.5.
    """
    if not record.has(axis, Tap.REF):
        return 0.5
    sensor_error = record.signal(axis, Tap.MEAS) - record.signal(axis, Tap.REF)
    return _compute_squared_correlation(residual, sensor_error)

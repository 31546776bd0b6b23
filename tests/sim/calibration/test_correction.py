"""The correction of live readings: it is causal and does not depend on the portions."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.calibration import (
    ReadingCorrection,
    SensorLag,
    SensorModel,
    make_calibration_motion,
)
from rotemina.sim.calibration.sensor_lag import apply_lag, compute_lag_slope
from rotemina.sim.errors import SensorCalibrationError
from rotemina.sim.records import Tap
from rotemina.sim.trajectory import dry_run

MODEL = SensorModel(
    low=0.0,
    high=1.0,
    offset=0.01,
    gain_error=0.05,
    bend=(0.02, -0.01),
    radii=(0.02,),
    weights=(0.3,),
    lag=SensorLag.FIRST_ORDER,
    lag_s=2e-3,
    period=0.1,
    harmonics=(1e-3, 0.0, 5e-4, 0.0),
)


def _compute_static_reading(model, position):
    return (
        model.offset + (1.0 + model.gain_error) * position + model.compute_position_error(position)
    )


def test_without_memory_the_correction_is_the_inverse_of_the_model():
    model = replace(
        MODEL,
        gain_error=0.3,
        radii=(),
        weights=(),
        lag=SensorLag.NONE,
        harmonics=(1e-4, 0.0, 5e-5, 0.0),
    )
    position = np.linspace(0.0, 1.0, 501)
    times = np.arange(501) * 1e-3
    corrected = ReadingCorrection(model, (0.0, 1.0)).apply(
        times, _compute_static_reading(model, position)
    )
    assert corrected == pytest.approx(position, abs=1e-6)


def test_a_steady_lag_is_corrected():
    model = SensorModel(low=0.0, high=1.0, lag=SensorLag.FIRST_ORDER, lag_s=4e-3)
    times = np.arange(2000) * 1e-3
    ramp = 0.4 * times
    reading = apply_lag(ramp, SensorLag.FIRST_ORDER, 4e-3, 1e-3)
    corrected = ReadingCorrection(model, (0.0, 1.0)).apply(times, reading)
    assert corrected[200:] == pytest.approx(ramp[200:], abs=1e-9)


def test_the_correction_is_the_same_in_any_portions():
    rng = np.random.default_rng(2)
    times = np.arange(3000) * 1e-3
    reading = 0.5 + 0.4 * np.sin(3.0 * times) + rng.normal(0.0, 1e-4, 3000)
    whole = ReadingCorrection(MODEL, (0.0, 1.0)).apply(times, reading)
    live = ReadingCorrection(MODEL, (0.0, 1.0))
    cuts = np.sort(rng.integers(0, 3000, 150))
    parts = [
        live.apply(t, r)
        for t, r in zip(np.split(times, cuts), np.split(reading, cuts), strict=True)
    ]
    assert np.concatenate(parts) == pytest.approx(whole, abs=1e-12)


def test_the_correction_is_causal_and_finite_beyond_the_travel():
    times = np.arange(100) * 1e-3
    reading = np.linspace(-5.0, 5.0, 100)
    changed = reading.copy()
    changed[60:] += 1.0
    first, second = (
        ReadingCorrection(MODEL, (0.1, 0.9)).apply(times, values) for values in (reading, changed)
    )
    assert (first[:60] == second[:60]).all()
    assert np.isfinite(first).all()


def test_the_lag_is_not_corrected_across_a_pause():
    correction = ReadingCorrection(
        SensorModel(low=0.0, high=1.0, lag=SensorLag.DELAY, lag_s=2e-3), (0.0, 1.0)
    )
    correction.apply(np.arange(50) * 1e-3, np.zeros(50))
    corrected = correction.apply(1.0 + np.arange(5) * 1e-3, np.ones(5))
    assert corrected == pytest.approx(1.0)


def test_the_delay_is_exact_on_straight_lines():
    signal = np.arange(50.0)
    assert apply_lag(signal, SensorLag.DELAY, 2.5, 1.0)[5:] == pytest.approx(signal[5:] - 2.5)
    assert apply_lag(signal, SensorLag.FIRST_ORDER, 0.5, 1.0)[40:] == pytest.approx(
        signal[40:] - 0.5
    )
    assert compute_lag_slope(signal, SensorLag.FIRST_ORDER, 0.0, 1.0)[10:] == pytest.approx(
        -1.0, rel=1e-6
    )


@pytest.mark.parametrize("axis", ["x", "zn"])
def test_the_calibration_motion_stays_within_all_limits(robot, axis):
    motion = make_calibration_motion(robot, axis, runs=3)
    result = dry_run(robot, motion)
    assert result.allowed, result.objections
    travel = float(np.ptp(motion.signal(axis, Tap.CMD)))
    assert travel > 0.9 * robot.axes[axis].span


@pytest.mark.parametrize(
    ("options", "message"),
    [({"runs": 2}, "runs = 2"), ({"targets": 3}, "targets = 3"), ({"rate_hz": 5.0}, "rate = 5")],
)
def test_a_motion_out_of_bounds_is_refused(robot, options, message):
    with pytest.raises(SensorCalibrationError, match=message):
        make_calibration_motion(robot, "x", **options)
    with pytest.raises(SensorCalibrationError, match="no such axis"):
        make_calibration_motion(robot, "q")

"""Sensors with known errors: the calibration finds them, and says what it cannot."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.calibration.comparable_parts import compared
from rotemina.sim.calibration.errors import CalibrationError
from rotemina.sim.calibration.interpolation import found_period
from rotemina.sim.calibration.laser_join import joined
from rotemina.sim.calibration.regression_columns import Run
from rotemina.sim.calibration.sensor_calibration import calibrated
from rotemina.sim.calibration.sensor_lag import Lag
from rotemina.sim.records.record import Record, Tap


def _found(robot, record, axis, **options):
    return calibrated(robot, [compared(record, axis, robot)], **options)


def _figure(found, name):
    return next(each for each in found.figures if each.name == name)


def _with(record, **signals):
    """Return a record with other signals of zn, by tap."""
    own = {tuple(channel): record.signal(*channel) for channel in record.columns}
    own |= {("zn", Tap(tap)): signal for tap, signal in signals.items()}
    own = {channel: signal for channel, signal in own.items() if signal is not None}
    return Record.from_signals(record.time_s, own, record.units, record.metadata)


@pytest.fixture(scope="module")
def plain(measured):
    return measured("zn", ("sensor_gain", None, {"error": 0.02}))


def test_gain_is_found_within_its_interval(robot, plain):
    found = _found(robot, plain, "zn")
    gain = _figure(found, "gain error")
    assert abs(gain.value - 0.02) < 2.0 * gain.half_width < 1e-4
    assert found.refusal is None
    assert found.after_rms < 1.15 * robot.axes["zn"].sensor.noise_floor
    assert found.before_rms > 10.0 * found.after_rms
    assert found.notes == ()


def test_nonlinearity_is_the_bend_between_the_ends(robot, measured):
    record = measured("zn", ("sensor_nonlinearity", None, {"bow": 5e-7, "cubic": 0.0}))
    found = _found(robot, record, "zn")
    bend = _figure(found, "nonlinearity")
    assert abs(bend.value - 5e-7) < 2.0 * bend.half_width < 1e-8
    assert _figure(found, "gain error").value == pytest.approx(0.0, abs=5e-5)


@pytest.mark.parametrize("lag_s", [1e-3, pytest.param(4e-3, marks=pytest.mark.slow)])
def test_lag_is_found(robot, measured, lag_s):
    record = measured("zn", ("sensor_lag", "first_order", {"time_constant": lag_s}), rate_hz=1e3)
    found = _found(robot, record, "zn")
    lag = _figure(found, "lag, time constant")
    assert found.model.lag is Lag.FIRST_ORDER
    assert abs(lag.value - lag_s) < 1.5 * lag.half_width < 0.05 * lag_s
    assert found.after_rms < 0.5 * found.before_rms


def test_the_period_of_an_encoder_is_found_in_creeping_stretches():
    rng = np.random.default_rng(4)
    creep = np.concatenate([np.linspace(0.0, 2e-4, 600), np.linspace(2e-4, 0.0, 600)])
    places = [5e-3, 5.8e-3, 1.05e-2, 5e-2]
    way = [np.concatenate([np.linspace(0.0, at, 300), at + creep]) for at in places]
    position = np.concatenate(way)
    phase = 2.0 * np.pi * position / 20e-6
    error = 1.5e-7 * np.sin(phase) + 8e-8 * np.cos(2.0 * phase) + rng.normal(0, 4e-8, len(phase))
    run = Run(position + error, position, 1e-3)
    assert found_period([run], [error]) == pytest.approx(20e-6, rel=2e-6)
    assert found_period([run], [rng.normal(0.0, 4e-8, len(phase))]) == 0.0


def test_drift_is_named_and_not_calibrated(robot, measured):
    record = measured("zn", ("sensor_drift", "random_walk", {"rate": 5e-8}), runs=4)
    found = _found(robot, record, "zn")
    assert any("drifts" in note for note in found.notes)
    assert found.after_rms > 0.5 * found.before_rms


def test_a_healthy_sensor_gets_no_calibration(robot, measured):
    found = _found(robot, measured("zn"), "zn")
    assert found.refusal is not None
    assert "not better" in found.refusal
    assert not any("drifts" in note for note in found.notes)


def test_hysteresis_of_a_sensor(robot, measured):
    clean = measured("zn")
    reference = clean.signal("zn", Tap.REF)
    radius, play = 0.3e-6, np.empty(len(reference))
    state = reference[0]
    for row, here in enumerate(reference.tolist()):
        state = play[row] = max(here - radius, min(here + radius, state))
    noise = np.random.default_rng(5).normal(0.0, 1.2e-8, len(reference))
    found = _found(robot, _with(clean, meas=play + noise), "zn")
    width = _figure(found, "hysteresis")
    # Stops take the place of what a play leaves: the reading lags by E, so the loop is −2r wide.
    assert width.value == pytest.approx(-2.0 * radius, rel=0.03)
    # At a reversal the reading stands still over 2r, in which nothing tells where the axis is.
    assert found.after_rms < 0.3 * found.before_rms


@pytest.mark.slow
def test_encoder_interpolation_is_found_over_the_whole_range(robot, measured):
    wrong = {"period": 20e-6, "sine": 1.5e-7, "second_cosine": 8e-8, "second_sine": 0.0}
    record = measured("x", ("encoder_interpolation", None, wrong), targets=5, rate_hz=1e3)
    found = _found(robot, record, "x")
    assert found.model.period == pytest.approx(20e-6, rel=1e-6)
    sine, cosine, second_sine, second_cosine = found.model.harmonics
    assert sine == pytest.approx(1.5e-7, abs=1e-8)
    assert second_cosine == pytest.approx(8e-8, abs=1e-8)
    assert max(abs(cosine), abs(second_sine)) < 1e-8
    assert found.after_rms < 1.1 * robot.axes["x"].sensor.noise_floor
    # The table of ISO 230-2 shows it, too: what the reading said, and says.
    assert found.reading_before.accuracy > 3.0 * found.reading_after.accuracy
    assert found.reached.accuracy < found.reading_before.accuracy


def test_a_lasers_own_zero_need_not_be_the_axis(robot, plain):
    moved = _with(plain, ref=plain.signal("zn", Tap.REF) + 3e-6)
    found = _found(robot, moved, "zn", absolute=False)
    assert _figure(found, "offset").value == pytest.approx(-3e-6 * 1.02, rel=1e-3)
    middle = 0.5 * sum(found.travel)
    assert found.model.offset + found.model.gain_error * middle == pytest.approx(0.0, abs=1e-12)


def test_a_laser_that_was_lost_for_a_while(robot, plain):
    reference = np.array(plain.signal("zn", Tap.REF))
    reference[1500:1800] = reference[1500]
    record = _with(plain, ref=reference)
    found = _found(robot, record, "zn")
    assert any(note.startswith("the laser was lost from 3.000 s to 3.5") for note in found.notes)
    assert _figure(found, "gain error").value == pytest.approx(0.02, abs=1e-4)
    reference[3000:10000] = 0.0
    with pytest.raises(CalibrationError, match="70 % are needed"):
        compared(_with(plain, ref=reference), "zn", robot)


def test_what_cannot_be_compared_is_refused(robot, plain):
    with pytest.raises(CalibrationError, match=r"no column zn\.ref"):
        compared(_with(plain, ref=None), "zn", robot)
    with pytest.raises(CalibrationError, match="the robot has x, y"):
        compared(plain, "q", robot)
    with pytest.raises(CalibrationError, match="record has zn"):
        compared(plain, "x", robot)
    with pytest.raises(CalibrationError, match="at least 500"):
        compared(plain.part(slice(0, 400)), "zn", robot)
    seen, read = (3e-5 + 0.05 * plain.signal("zn", tap) for tap in (Tap.REF, Tap.MEAS))
    small = _with(plain, ref=seen, meas=read)
    with pytest.raises(CalibrationError, match="% of its range"):
        compared(small, "zn", robot)


def test_a_gap_in_the_rows_is_told(robot, plain):
    kept = np.r_[0:2500, 2700 : len(plain.time_s)]
    record = replace(plain, time_s=plain.time_s[kept], values=plain.values[kept])
    assert compared(record, "zn", robot).losses == ("no rows from 4.998 s to 5.400 s",)


def test_a_laser_with_a_clock_of_its_own_is_joined(robot, plain):
    shift_s, rate = 1.234, 50e-6
    own_s = np.arange(0.0, plain.duration_s + 3.0, 2e-3)
    at_s = (own_s - shift_s) / (1.0 + rate)
    seen = np.interp(at_s, plain.time_s, plain.signal("zn", Tap.REF))
    laser = Record.from_signals(own_s + 77.0, {("zn", Tap.REF): seen}, {"zn": "m"})
    both = joined(_with(plain, ref=None), laser, "zn")
    assert float(both.metadata["laser_shift_s"]) == pytest.approx(shift_s, abs=2e-5)
    assert float(both.metadata["laser_rate"]) == pytest.approx(rate, abs=2e-6)
    found = _found(robot, both, "zn", lags=False)
    assert _figure(found, "gain error").value == pytest.approx(0.02, abs=1e-4)
    other = Record.from_signals(
        own_s, {("zn", Tap.REF): 3e-5 + 1e-5 * np.sin(9.0 * own_s)}, {"zn": "m"}
    )
    with pytest.raises(CalibrationError, match="does not match"):
        joined(plain, other, "zn")

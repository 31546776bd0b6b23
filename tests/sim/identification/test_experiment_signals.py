"""Experiments from records, and their resampling."""

import numpy as np
import pytest

from rotemina.sim.identification.errors import (
    IdentificationError,
    SettingError,
    TimeGridError,
    TooShortError,
)
from rotemina.sim.identification.experiment_signals import signals_of, siso, uniform_rate
from rotemina.sim.identification.rate import resample
from rotemina.sim.records.record import Record, Tap


def record(time_s):
    signals = {("x", Tap.CMD): np.sin(time_s), ("x", Tap.U): np.cos(time_s)}
    return Record.from_signals(time_s, signals, {"x": "m"})


def test_channels_keep_their_names_and_units():
    signals = signals_of(record(np.arange(50) / 200), [("x", Tap.CMD)], [("x", Tap.U)])
    assert signals.rate_hz == pytest.approx(200.0)
    assert (signals.input_names, signals.output_names) == (("x.cmd",), ("x.u",))
    assert (signals.input_units, signals.output_units) == (("m",), ("V",))


def test_records_that_cannot_be_used_are_refused():
    late = np.arange(50) / 200
    late[20] += 1e-3
    with pytest.raises(TimeGridError, match=r"row 20 .* off the grid of 0.005 s, more than 1 %"):
        signals_of(record(late), [("x", Tap.CMD)], [("x", Tap.U)])
    with pytest.raises(IdentificationError, match=r"no x.meas; it has x.cmd, x.u"):
        signals_of(record(np.arange(50.0)), [("x", Tap.CMD)], [("x", Tap.MEAS)])
    with pytest.raises(TooShortError):
        uniform_rate(np.zeros(1))


@pytest.mark.parametrize(("frequency_hz", "gain"), [(10.0, 1.0), (55.0, 1.0), (90.0, 0.0)])
def test_the_paper_s_factor_keeps_the_band_and_lets_nothing_fold(frequency_hz, gain):
    """0.15 of 1 kHz is 150 Hz: 60 Hz is the end of the passband; 90 Hz would fold to 60 Hz."""
    time_s = np.arange(8000) / 1000.0
    wave = np.sin(2 * np.pi * frequency_hz * time_s)
    low = resample(siso(5.0 + wave, 2.0 * wave, 1000.0), 0.15)
    driven, answer = low.single()
    assert low.rate_hz == pytest.approx(150.0)
    np.testing.assert_allclose(answer, 2.0 * (driven - 5.0), atol=2e-3)
    assert np.std(answer) * np.sqrt(2) == pytest.approx(2.0 * gain, abs=4e-3)


def test_whole_periods_stay_whole():
    wave = np.tile(np.sin(2 * np.pi * 3 * np.arange(2000) / 2000), 3)
    low = resample(siso(wave, wave, 1000.0, period_samples=2000), 0.15)
    assert low.period_samples == 300
    assert low.count == 900
    expected = np.tile(np.sin(2 * np.pi * 3 * np.arange(300) / 300), 3)
    np.testing.assert_allclose(low.inputs[:, 0], expected, atol=2e-4)


def test_factors_that_make_no_sense_are_refused():
    wave = siso(np.arange(100.0), np.arange(100.0), 1000.0)
    for factor, reason in [(0.0, "not in"), (1.5, "not in"), (1 / np.pi, "not a fraction")]:
        with pytest.raises(SettingError, match=reason):
            resample(wave, factor)
    with pytest.raises(TooShortError, match="100 samples leave"):
        resample(wave, 0.15)
    assert resample(wave, 1.0) is wave

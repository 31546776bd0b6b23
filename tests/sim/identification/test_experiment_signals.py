"""Experiments that are made from records, and their resampling."""

import numpy as np
import pytest

from rotemina.sim.errors import (
    IdentificationError,
    IdentificationSettingError,
    TimeGridError,
    TooShortError,
)
from rotemina.sim.identification import find_uniform_rate, make_siso_signals, signals_from_record
from rotemina.sim.identification.rate import resample
from rotemina.sim.records import Record, Tap


def make_record(time_s):
    signals = {("x", Tap.CMD): np.sin(time_s), ("x", Tap.U): np.cos(time_s)}
    return Record.from_signals(time_s, signals, {"x": "m"})


def test_channels_keep_their_names_and_units():
    signals = signals_from_record(
        make_record(np.arange(50) / 200), [("x", Tap.CMD)], [("x", Tap.U)]
    )
    assert signals.rate_hz == pytest.approx(200.0)
    assert (signals.input_names, signals.output_names) == (("x.cmd",), ("x.u",))
    assert (signals.input_units, signals.output_units) == (("m",), ("V",))


def test_records_that_cannot_be_used_are_refused():
    uneven_time_s = np.arange(50) / 200
    uneven_time_s[20] += 1e-3
    with pytest.raises(TimeGridError, match=r"row 20 .* off the grid of 0.005 s, more than 1 %"):
        signals_from_record(make_record(uneven_time_s), [("x", Tap.CMD)], [("x", Tap.U)])
    with pytest.raises(IdentificationError, match=r"no x.meas; it has x.cmd, x.u"):
        signals_from_record(make_record(np.arange(50.0)), [("x", Tap.CMD)], [("x", Tap.MEAS)])
    with pytest.raises(TooShortError):
        find_uniform_rate(np.zeros(1))


@pytest.mark.parametrize(("frequency_hz", "gain"), [(10.0, 1.0), (55.0, 1.0), (90.0, 0.0)])
def test_resampling_by_the_factor_of_the_paper_keeps_the_band_without_aliasing(frequency_hz, gain):
    """At 150 Hz the passband ends at 60 Hz, and 90 Hz would alias to 60 Hz."""
    time_s = np.arange(8000) / 1000.0
    wave = np.sin(2 * np.pi * frequency_hz * time_s)
    resampled = resample(make_siso_signals(5.0 + wave, 2.0 * wave, 1000.0), 0.15)
    input_signal, output_signal = resampled.require_single_pair()
    assert resampled.rate_hz == pytest.approx(150.0)
    np.testing.assert_allclose(output_signal, 2.0 * (input_signal - 5.0), atol=2e-3)
    assert np.std(output_signal) * np.sqrt(2) == pytest.approx(2.0 * gain, abs=4e-3)


def test_whole_periods_stay_whole():
    wave = np.tile(np.sin(2 * np.pi * 3 * np.arange(2000) / 2000), 3)
    resampled = resample(make_siso_signals(wave, wave, 1000.0, period_samples=2000), 0.15)
    assert resampled.period_samples == 300
    assert resampled.count == 900
    expected = np.tile(np.sin(2 * np.pi * 3 * np.arange(300) / 300), 3)
    np.testing.assert_allclose(resampled.inputs[:, 0], expected, atol=2e-4)


def test_invalid_factors_are_refused():
    wave = make_siso_signals(np.arange(100.0), np.arange(100.0), 1000.0)
    for factor, reason in [(0.0, "not in"), (1.5, "not in"), (1 / np.pi, "not a fraction")]:
        with pytest.raises(IdentificationSettingError, match=reason):
            resample(wave, factor)
    with pytest.raises(TooShortError, match="of 100 samples 0 remain"):
        resample(wave, 0.15)
    assert resample(wave, 1.0) is wave

"""Signals that plots draw: thinned, aligned, transformed and saved without distortion."""

import numpy as np
import pytest

from rotemina.app.motion.device import HistoryWindow
from rotemina.plugins.plots.cursor_text import (
    PlotKind,
    describe_cursors,
    describe_loop,
    describe_values,
    find_nearest_value,
)
from rotemina.plugins.plots.history_signals import NothingShownError, cut_latest, to_record
from rotemina.plugins.plots.overlay_data import OverlayRun, find_time_shift
from rotemina.plugins.plots.spectra_and_loops import compute_spectrum, thin_loop
from rotemina.sim.records import read_record, write_record
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")
AXES = tuple(ROBOT.axes)
MIDDLE = np.array([sum(axis.range) / 2 for axis in ROBOT.axes.values()])
SPAN = np.array([axis.span for axis in ROBOT.axes.values()])


def make_window(time_s, motion=None):
    """Return a window in which all axes make a motion (n,), given as a share of their range."""
    motion = np.zeros(len(time_s)) if motion is None else motion
    command = MIDDLE + np.outer(motion, SPAN)
    noise = 1e-6 * SPAN * np.random.default_rng(3).standard_normal(command.shape)
    doubt = np.zeros(command.shape)
    return HistoryWindow(AXES, time_s, command, command.copy(), command + noise, command, doubt)


def test_a_thinned_loop_keeps_its_extremes_and_spikes():
    phase = np.linspace(0.0, 8.0 * np.pi, 50_001)
    x, y = (1.0 + 0.01 * phase) * (np.cos(phase), np.sin(phase))
    y[31_234] = 5.0
    x[7_777] = -4.0
    thin_x, thin_y = thin_loop(x, y, 200)
    assert len(thin_x) <= 4 * 201
    assert (thin_x.min(), thin_x.max()) == (x.min(), x.max())
    assert (thin_y.min(), thin_y.max()) == (y.min(), y.max())
    rows = [
        int(np.flatnonzero((x == a) & (y == b))[0]) for a, b in zip(thin_x, thin_y, strict=True)
    ]
    assert rows == sorted(rows)  # sorted: the line keeps the shape of the loop
    short_x, _ = thin_loop(x[:100], y[:100], 200)
    np.testing.assert_array_equal(short_x, x[:100])


def test_a_spectrum_has_the_power_of_its_signal_at_its_frequency():
    time_s = np.arange(10_000) / 1000.0
    rng = np.random.default_rng(5)
    tone = 2.0 * np.sin(2 * np.pi * 50.0 * time_s)
    noise = 0.3 * rng.standard_normal(len(time_s))
    spectrum = compute_spectrum(time_s, np.stack([tone, noise], axis=1))
    peak_hz = spectrum.frequency_hz[np.argmax(spectrum.density[:, 0])]
    assert peak_hz == pytest.approx(50.0, abs=0.5)
    step = spectrum.frequency_hz[1] - spectrum.frequency_hz[0]
    power = (spectrum.density**2).sum(axis=0) * step
    assert power == pytest.approx([2.0, 0.09], rel=0.05)  # Parseval: a²/2, σ²
    # White noise of variance σ² sampled at f has the density σ √(2/f) at all frequencies.
    assert np.median(spectrum.density[:, 1]) == pytest.approx(0.3 * np.sqrt(2e-3), rel=0.1)


def test_a_spectrum_uses_only_samples_after_a_gap_in_time():
    time_s = np.arange(4000) / 1000.0
    signal = np.sin(2 * np.pi * 20.0 * time_s)
    signal[:1000] = np.sin(2 * np.pi * 111.0 * time_s[:1000]) * 50.0
    time_with_gap_s = time_s + np.where(np.arange(4000) >= 1000, 0.7, 0.0)
    spectrum = compute_spectrum(time_with_gap_s, signal[:, None])
    assert spectrum.density[np.argmin(abs(spectrum.frequency_hz - 111.0)), 0] < 1e-3
    assert compute_spectrum(time_s[:40], signal[:40, None]) is None
    assert compute_spectrum(np.append(time_s, 9.0), np.append(signal, 0.0)[:, None]) is None


def test_another_run_is_shifted_in_time_until_its_commands_match():
    offset_s = 3.3
    time_s = 100.0 + np.arange(6000) / 1000.0
    pulse = np.exp(-(((time_s - 101.5 - offset_s) / 0.2) ** 2))
    shown = make_window(time_s, 0.2 * pulse + 0.02 * np.sin(time_s))
    other_time_s = np.arange(750) / 500.0  # another rate
    shifted_time_s = other_time_s + 100.75 + offset_s
    motion = 0.2 * np.exp(-(((shifted_time_s - 101.5 - offset_s) / 0.2) ** 2)) + 0.02 * np.sin(
        shifted_time_s
    )
    other = OverlayRun.from_window("other", make_window(other_time_s, motion))
    assert find_time_shift(shown, other) == pytest.approx(100.75 + offset_s, abs=2e-3)
    # The other run may also be longer than the shown one.
    long_run = OverlayRun.from_window("long", shown)
    short_window = make_window(shifted_time_s, motion)
    assert find_time_shift(short_window, long_run) == pytest.approx(0.0, abs=2e-3)
    assert find_time_shift(shown, OverlayRun.from_window("rest", make_window(other_time_s))) is None


def test_a_shown_window_is_saved_as_a_record_and_read_again(tmp_path):
    shown = make_window(50.0 + np.arange(500) / 1000.0, 0.1 * np.linspace(0.0, 1.0, 500))
    path = tmp_path / "shown.csv"
    write_record(to_record(shown, ROBOT), path)
    record = read_record(path, robot=ROBOT)
    assert record.axes == AXES
    run = OverlayRun.from_record("again", record, ROBOT)
    np.testing.assert_array_equal(run.command, shown.command)
    np.testing.assert_array_equal(run.measured, shown.measured)
    np.testing.assert_allclose(run.time_s, shown.device_time_s - 50.0, atol=1e-9)
    assert record.history == "unknown"
    for convert in (to_record, lambda empty, _: OverlayRun.from_window("none", empty)):
        with pytest.raises(NothingShownError):
            convert(make_window(np.empty(0)), ROBOT)


def test_the_latest_seconds_are_cut_from_the_window():
    shown = make_window(np.arange(6000) / 1000.0)
    assert cut_latest(shown, 2.0).device_time_s[0] == pytest.approx(3.999)
    assert len(cut_latest(shown, 60.0)) == 6000
    assert len(cut_latest(make_window(np.empty(0)), 2.0)) == 0


def test_cursors_read_only_existing_samples():
    x, y = np.array([0.0, 1.0, 2.0]), np.array([5.0, 7.0, 6.0])
    assert [find_nearest_value(x, y, cursor) for cursor in (0.0, 0.4, 0.6, 2.0)] == [
        5.0,
        5.0,
        7.0,
        6.0,
    ]
    assert find_nearest_value(x, y, 2.1) is None
    assert find_nearest_value(np.empty(0), np.empty(0), 0.0) is None
    assert describe_cursors(PlotKind.POSITION, -3.0, -1.0) == "A -3 s  B -1 s  Δ 2 s  1/Δ 0.5 Hz"
    assert describe_cursors(PlotKind.SPECTRUM, 10.0, 60.0).endswith("1/Δ 0.02 s")
    assert "1/Δ" not in describe_cursors(PlotKind.GAP, 1.0, 1.0)
    assert describe_values(27.5, 27.75, "mm").short == "Δ 0.25 mm"
    assert "A 27.5 mm, B 27.75 mm" in describe_values(27.5, 27.75, "mm").full
    assert describe_values(None, 1.0, "mm").short == "cursor outside"
    assert describe_loop((1.0, 2.0), (2.0, 4.5), "µm").full == "Δx 1  Δy 2.5 µm, Δy/Δx 2.5"

"""What plots draw: decimated, aligned, transformed and saved without lying."""

import numpy as np
import pytest

from rotemina.app.motion.recent_history import LiveWindow
from rotemina.plugins.plots.cursor_text import (
    Shown,
    across_text,
    loop_text,
    nearest,
    values_text,
)
from rotemina.plugins.plots.history_signals import NothingShownError, as_record, latest
from rotemina.plugins.plots.overlay_data import OtherRun, alignment
from rotemina.plugins.plots.spectra_and_loops import spectrum, thinned_loop
from rotemina.sim.records.reading import read_record
from rotemina.sim.records.writing import write_record
from rotemina.sim.robot.file import load_robot

ROBOT = load_robot("rotemina")
AXES = tuple(ROBOT.axes)
MIDDLE = np.array([sum(axis.range) / 2 for axis in ROBOT.axes.values()])
SPAN = np.array([axis.span for axis in ROBOT.axes.values()])


def window(time_s, motion=None):
    """A window in which all axes make a motion (n,), as a share of their range."""
    motion = np.zeros(len(time_s)) if motion is None else motion
    command = MIDDLE + np.outer(motion, SPAN)
    noise = 1e-6 * SPAN * np.random.default_rng(3).standard_normal(command.shape)
    doubt = np.zeros(command.shape)
    return LiveWindow(AXES, time_s, command, command.copy(), command + noise, command, doubt)


def test_a_thinned_loop_keeps_its_tips_and_every_spike():
    phase = np.linspace(0.0, 8.0 * np.pi, 50_001)
    x, y = (1.0 + 0.01 * phase) * (np.cos(phase), np.sin(phase))
    y[31_234] = 5.0
    x[7_777] = -4.0
    thin_x, thin_y = thinned_loop(x, y, 200)
    assert len(thin_x) <= 4 * 201
    assert (thin_x.min(), thin_x.max()) == (x.min(), x.max())
    assert (thin_y.min(), thin_y.max()) == (y.min(), y.max())
    rows = [
        int(np.flatnonzero((x == a) & (y == b))[0]) for a, b in zip(thin_x, thin_y, strict=True)
    ]
    assert rows == sorted(rows)  # in order: the line has the shape of the loop
    short_x, _ = thinned_loop(x[:100], y[:100], 200)
    np.testing.assert_array_equal(short_x, x[:100])


def test_a_spectrum_has_the_power_of_its_signal_at_its_frequency():
    time_s = np.arange(10_000) / 1000.0
    rng = np.random.default_rng(5)
    tone = 2.0 * np.sin(2 * np.pi * 50.0 * time_s)
    noise = 0.3 * rng.standard_normal(len(time_s))
    found = spectrum(time_s, np.stack([tone, noise], axis=1))
    tall = found.frequency_hz[np.argmax(found.density[:, 0])]
    assert tall == pytest.approx(50.0, abs=0.5)
    step = found.frequency_hz[1] - found.frequency_hz[0]
    power = (found.density**2).sum(axis=0) * step
    assert power == pytest.approx([2.0, 0.09], rel=0.05)  # Parseval: a²/2, σ²
    # White noise of variance σ² at a rate f has σ √(2/f) everywhere.
    assert np.median(found.density[:, 1]) == pytest.approx(0.3 * np.sqrt(2e-3), rel=0.1)


def test_a_spectrum_begins_anew_after_a_gap():
    time_s = np.arange(4000) / 1000.0
    signal = np.sin(2 * np.pi * 20.0 * time_s)
    signal[:1000] = np.sin(2 * np.pi * 111.0 * time_s[:1000]) * 50.0
    lost = time_s + np.where(np.arange(4000) >= 1000, 0.7, 0.0)
    found = spectrum(lost, signal[:, None])
    assert found.density[np.argmin(abs(found.frequency_hz - 111.0)), 0] < 1e-3
    assert spectrum(time_s[:40], signal[:40, None]) is None
    assert spectrum(np.append(time_s, 9.0), np.append(signal, 0.0)[:, None]) is None


@pytest.mark.parametrize("offset_s", [0.8, 3.3])
def test_another_run_is_moved_to_where_its_commands_are_those_shown(offset_s):
    time_s = 100.0 + np.arange(6000) / 1000.0
    bump = np.exp(-(((time_s - 101.5 - offset_s) / 0.2) ** 2))
    shown = window(time_s, 0.2 * bump + 0.02 * np.sin(time_s))
    its_time = np.arange(750) / 500.0  # another rate
    moved = its_time + 100.75 + offset_s
    motion = 0.2 * np.exp(-(((moved - 101.5 - offset_s) / 0.2) ** 2)) + 0.02 * np.sin(moved)
    other = OtherRun.of_window("other", window(its_time, motion))
    assert alignment(shown, other) == pytest.approx(100.75 + offset_s, abs=2e-3)
    # The longer of the two may as well be the other one.
    long = OtherRun.of_window("long", shown)
    short = window(moved, motion)
    assert alignment(short, long) == pytest.approx(0.0, abs=2e-3)
    assert alignment(shown, OtherRun.of_window("rest", window(its_time))) is None


def test_what_is_shown_is_saved_as_a_record_that_reads_back(tmp_path):
    shown = window(50.0 + np.arange(500) / 1000.0, 0.1 * np.linspace(0.0, 1.0, 500))
    path = tmp_path / "shown.csv"
    write_record(as_record(shown, ROBOT), path)
    record = read_record(path, robot=ROBOT)
    assert record.axes == AXES
    again = OtherRun.of_record("again", record, ROBOT)
    np.testing.assert_array_equal(again.command, shown.command)
    np.testing.assert_array_equal(again.measured, shown.measured)
    np.testing.assert_allclose(again.time_s, shown.device_time_s - 50.0, atol=1e-9)
    assert record.history == "unknown"
    for use in (as_record, lambda empty, _: OtherRun.of_window("none", empty)):
        with pytest.raises(NothingShownError):
            use(window(np.empty(0)), ROBOT)


def test_the_latest_seconds_are_cut_from_what_is_held():
    shown = window(np.arange(6000) / 1000.0)
    assert latest(shown, 2.0).device_time_s[0] == pytest.approx(3.999)
    assert len(latest(shown, 60.0)) == 6000
    assert len(latest(window(np.empty(0)), 2.0)) == 0


def test_cursors_read_samples_and_never_beyond_them():
    x, y = np.array([0.0, 1.0, 2.0]), np.array([5.0, 7.0, 6.0])
    assert [nearest(x, y, at) for at in (0.0, 0.4, 0.6, 2.0)] == [5.0, 5.0, 7.0, 6.0]
    assert nearest(x, y, 2.1) is None
    assert nearest(np.empty(0), np.empty(0), 0.0) is None
    assert across_text(Shown.POSITION, -3.0, -1.0) == "A -3 s  B -1 s  Δ 2 s  1/Δ 0.5 Hz"
    assert across_text(Shown.SPECTRUM, 10.0, 60.0).endswith("1/Δ 0.02 s")
    assert "1/Δ" not in across_text(Shown.GAP, 1.0, 1.0)
    assert values_text(27.5, 27.75, "mm").short == "Δ 0.25 mm"
    assert "A 27.5 mm, B 27.75 mm" in values_text(27.5, 27.75, "mm").full
    assert values_text(None, 1.0, "mm").short == "cursor outside"
    assert loop_text((1.0, 2.0), (2.0, 4.5), "µm").full == "Δx 1  Δy 2.5 µm, Δy/Δx 2.5"

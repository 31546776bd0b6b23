"""The live plots: curves, pause, views, cursors and the strip of the gap."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtGui import QColor

from rotemina.app.panel import STALE_AGE_S
from rotemina.app.widgets.drawing import SignalPlot
from rotemina.app.widgets.style.theme import DARK
from rotemina.plugins.plots.axis_plot import AxisPlot
from rotemina.plugins.plots.gap_strip import GapStrip
from rotemina.sim.records import Tap, read_record
from rotemina.sim.robot_files import load_robot

LONG_MS = 30_000


@pytest.fixture
def panel(qtbot, window):
    panel = window.panels["plots"]
    history = window.workbench.session.history
    qtbot.waitUntil(lambda: len(history.tail(1.0)) > 100, timeout=LONG_MS)
    return panel


def get_curve(panel, axis, curve):
    return panel.plots[axis].plot._curves[curve].getData()


def test_curves_are_drawn_up_to_now_with_the_gap_strip_if_there_is_room(qtbot, window, panel):
    window.resize(1280, 1080)
    window.workbench.jog("thx", 1e-5)
    history = window.workbench.session.history
    strip = panel.plots["thx"].strip

    def has_settled():
        newest = history.tail(0.1)
        panel.refresh()
        return (
            abs(newest.command[0, 3] - 5.91775e-4) < 1e-9
            and np.ptp(newest.model[:, 3]) < 1e-7
            and np.isfinite(strip._values).any()
        )

    qtbot.waitUntil(has_settled, timeout=LONG_MS)
    for curve in ("command", "model", "measured"):
        time_s, values = get_curve(panel, "thx", curve)
        assert time_s[-1] == pytest.approx(0.0, abs=0.05)
        assert values[-1] == pytest.approx(591.775, abs=3.0)
    assert strip.isVisible()
    panel.kind_choice.setCurrentIndex(2)  # a loop has no time axis
    assert not strip.isVisible()
    panel.kind_choice.setCurrentIndex(0)
    assert strip.isVisible()
    panel.plots["thx"].split_height(40)
    assert not strip.isVisible()


def test_every_view_is_drawn_with_cursors_and_an_overlay(qtbot, window, panel, tmp_path):
    panel.kind_choice.setCurrentIndex(1)
    panel.refresh()
    _, values = get_curve(panel, "zn", "measured")
    assert np.abs(values).max() < 0.1  # µm: sensor noise alone
    _, model = get_curve(panel, "zn", "model")
    assert model is None or len(model) == 0
    panel.overlay_choice.setCurrentIndex(2)
    panel.overlay_choice.activated.emit(2)
    assert "no latest run" in window.notices.notices()[0].text
    assert panel.overlay_choice.currentIndex() == 0
    panel.pause.setChecked(True)  # no update between the choice and the check
    panel.overlay_choice.setCurrentIndex(1)
    panel.overlay_choice.activated.emit(1)
    assert "The kept run" in panel._legend.text()
    for view in (0, 2, 3):
        panel.kind_choice.setCurrentIndex(view)
        for curve in ("measured", "other"):
            across, values = get_curve(panel, "zn", curve)
            assert len(across) == len(values) > 10
        np.testing.assert_allclose(values, get_curve(panel, "zn", "measured")[1], rtol=1e-9)
    panel.cursors.setChecked(True)  # on the spectrum
    plot, neighbour = panel.plots["x"].plot, panel.plots["zn"].plot
    plot._cursor_lines[0].setValue(1.0)
    plot._cursor_lines[1].setValue(2.0)
    assert [position for position, _ in neighbour.cursors] == [1.0, 2.0]
    assert panel._legend.text() == "A 10 Hz  B 100 Hz  Δ 90 Hz  1/Δ 0.01111 s"
    assert panel.plots["zn"].figures.text().startswith("Δ ")
    panel.kind_choice.setCurrentIndex(2)
    plot._cursor_lines[2].setValue(0.0)
    assert panel.plots["x"].figures.text().startswith("Δx ")
    assert neighbour.cursors[0][1] != 0.0  # each loop has separate cursors
    panel.cursors.setChecked(False)
    assert panel.plots["x"].figures.text().startswith("Gap, last 10 s")
    save_and_check(qtbot, panel, tmp_path)


def save_and_check(qtbot, panel, folder):
    """Save the picture and the data, and compare the read data with the shown data."""
    for name, magic_bytes in (("a.png", b"\x89PNG"), ("a.svg", b"<?xml")):
        panel.save_picture(folder / name)
        assert (folder / name).read_bytes().startswith(magic_bytes)
    panel.save_picture(folder / "none" / "a.svg")
    notices = panel.main_window.notices
    assert str(folder / "none") in notices.notices()[0].text
    panel.save_data(folder / "a.csv")
    qtbot.waitUntil((folder / "a.csv").exists, timeout=LONG_MS)
    record = read_record(folder / "a.csv", robot=panel.workbench.robot)
    assert len(record.time_s) == len(panel._plot_frame.window)
    np.testing.assert_array_equal(
        record.signal("thx", Tap.MEAS), panel._plot_frame.window.measured[:, 3]
    )


def test_the_scale_changes_only_if_needed(qtbot):
    plot = SignalPlot(DARK)
    qtbot.addWidget(plot)
    plot.fit_scale(0.0, 1.0, 0.0)
    first_range = plot.viewRange()[1]
    plot.fit_scale(0.05, 0.95, 0.0)
    assert plot.viewRange()[1] == first_range
    plot.fit_scale(0.0, 3.0, 0.0)
    assert plot.viewRange()[1][1] > 3.0
    plot.fit_scale(0.0, 0.1, 0.0)
    assert plot.viewRange()[1][1] < 0.2


def test_new_samples_are_drawn_one_plot_at_a_time(qtbot, window, panel, monkeypatch):
    qtbot.waitUntil(lambda: not panel._waiting_plots, timeout=LONG_MS)
    window.workbench.shown.disconnect()  # no refreshes other than those of this test
    draw_calls = []
    monkeypatch.setattr(AxisPlot, "draw", lambda plot, picture: draw_calls.append((plot, picture)))
    panel._refresh_in_parts()
    assert len(draw_calls) == 1
    panel._refresh_in_parts()  # too early: the remaining plots are drawn first
    assert len(draw_calls) == 1
    qtbot.waitUntil(lambda: len(draw_calls) == 6, timeout=LONG_MS)
    assert {plot for plot, _ in draw_calls} == set(panel.plots.values())
    assert len({id(picture) for _, picture in draw_calls}) == 1
    panel._refresh_in_parts()
    assert len(draw_calls) == 7
    panel.refresh()  # a full refresh draws all plots and clears the queue
    assert len(draw_calls) == 13
    assert not panel._waiting_plots


def test_the_gap_strip_is_scaled_by_floor_and_bounds_and_cuts_off_no_letter(qtbot):
    axis = load_robot("rotemina").axes["zn"]
    floor = axis.sensor.noise_floor
    strip = GapStrip(DARK, "zn", axis, floor)
    qtbot.addWidget(strip)
    strip.resize(300, 50)
    font = strip.font()
    font.setPixelSize(26)
    strip.setFont(font)
    picture = strip.grab().toImage()
    assert {picture.pixelColor(0, y).name() for y in range(50)} == {DARK.surface}
    font.setPixelSize(13)
    strip.setFont(font)
    time_s = np.linspace(-10.0, 0.0, 101)
    values = np.full(101, floor)
    values[40:60] = np.nan  # at rest
    values[80:] = 3e-6  # above the noise, within the following limit
    strip.show_gap_history(time_s, values, 10.0)
    assert strip.top == pytest.approx(2000.0 * floor)
    heights = [strip.to_height(size) for size in (floor, *strip.bounds.values())]
    assert heights == sorted(heights, reverse=True)
    picture = strip.grab().toImage()

    def colours(first, last):
        track = strip.find_track()
        columns = [round(track.left() + share * track.width()) for share in (first, last)]
        return {
            picture.pixelColor(x, y).name()
            for x in range(*columns)
            for y in range(int(track.top()), int(strip.to_height(floor)) + 2)
        }

    assert DARK.text in colours(0.1, 0.35)
    assert DARK.text not in colours(0.42, 0.58)
    assert DARK.warning in colours(0.85, 0.95)
    strip.set_stale(True)
    picture = strip.grab().toImage()
    assert DARK.text not in colours(0.0, 1.0)
    assert DARK.quiet in colours(0.1, 0.35)
    strip.show_gap_history(time_s, np.full(101, np.nan), 10.0)
    assert strip.top == pytest.approx(20.0 * floor)  # nothing moved


def test_old_readings_are_grey_with_their_age_and_waiting_plots_show_their_background(
    window, panel
):
    def get_pen_colours():
        curves = panel.plots["zn"].plot._curves
        return {curves[name].opts["pen"].color().name() for name in ("command", "measured")}

    state = window.workbench.session.snapshot()
    normal_colours = get_pen_colours()
    window.workbench.shown.emit(replace(state, age_s=STALE_AGE_S + 0.1))
    assert get_pen_colours() == {QColor(window.workbench.theme.quiet).name()}
    assert not panel.age.isHidden()
    assert panel.age.text() == "The newest reading is 1 s old"
    window.workbench.shown.emit(replace(state, age_s=72.4))
    assert panel.age.text() == "The newest reading is 72 s old"
    window.workbench.shown.emit(replace(state, age_s=0.0))
    assert get_pen_colours() == normal_colours
    assert panel.age.isHidden()

    plot = panel.plots["x"].plot
    plot.paint_now()
    plot.resizeEvent(None)
    centre = plot.mapTo(window, plot.rect().center())
    assert window.grab().toImage().pixelColor(centre).name() == window.workbench.theme.surface
    plot.paint_now()
    assert not plot._staggering.is_held


ARRANGEMENTS = [
    ((940, 390), [["x", "thx"], ["y", "thy"], ["z", "zn"]], True, ["z", "zn"]),
    ((940, 250), [["x", "y", "z"], ["thx", "thy", "zn"]], True, ["thx", "thy", "zn"]),
    ((590, 170), [["x", "y", "z"], ["thx", "thy", "zn"]], False, ["thx", "thy", "zn"]),
    ((1270, 170), [["x", "y", "z", "thx", "thy", "zn"]], False, []),
    ((590, 90), [["x", "y", "z", "thx", "thy", "zn"]], False, []),
]


def test_paused_plots_keep_their_curves_in_readable_rows_that_fit(qtbot, window, panel):
    grid = panel.grid
    grid.arrange(*ARRANGEMENTS[0][0], 60)
    panel.refresh()
    panel.pause.click()
    old_values = get_curve(panel, "x", "measured")[1].copy()
    window.workbench.jog("x", 1e-5)
    session = window.workbench.session
    qtbot.waitUntil(lambda: session.snapshot().command["x"] > 0.02750999, timeout=LONG_MS)
    panel.refresh()
    for size, rows, has_head, axes_with_times in ARRANGEMENTS:
        assert grid.arrange(*size, 60) is has_head
        placed_names = {}
        for name, plot in panel.plots.items():
            row, column, _, _ = grid.layout().getItemPosition(grid.layout().indexOf(plot))
            placed_names[row, column] = name
        assert placed_names == {
            (row_index, column_index): name
            for row_index, names in enumerate(rows)
            for column_index, name in enumerate(names)
        }
        times = [name for name, plot in panel.plots.items() if plot._has_times]
        assert times == axes_with_times
        for name in panel.plots:
            assert len(get_curve(panel, name, "measured")[0]) > 0
    np.testing.assert_array_equal(get_curve(panel, "x", "measured")[1], old_values)

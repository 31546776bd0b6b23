"""The live plots: what is drawn, paused, and how the gap is shown."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtGui import QColor

from rotemina.app.panel import STALE_S
from rotemina.app.shell.plot import SignalPlot
from rotemina.app.shell.theme import DARK
from rotemina.plugins.plots.axis_plot import AxisPlot
from rotemina.plugins.plots.gap_strip import GapStrip
from rotemina.sim.records.reading import read_record
from rotemina.sim.records.record import Tap
from rotemina.sim.robot.file import load_robot

LONG_MS = 30_000


@pytest.fixture
def panel(qtbot, window):
    panel = window.panels["plots"]
    history = window.workbench.session.history
    qtbot.waitUntil(lambda: len(history.tail(1.0)) > 100, timeout=LONG_MS)
    return panel


def drawn(panel, axis, curve):
    return panel.plots[axis].plot._curves[curve].getData()


def test_command_model_and_measurement_are_drawn_up_to_now(qtbot, window, panel):
    window.workbench.jog("thx", 1e-5)
    history = window.workbench.session.history

    def settled():
        newest = history.tail(0.1)
        return abs(newest.command[0, 3] - 5.91775e-4) < 1e-9 and np.ptp(newest.model[:, 3]) < 1e-7

    qtbot.waitUntil(settled, timeout=LONG_MS)
    panel.refresh()
    for curve in ("command", "model", "measured"):
        time_s, values = drawn(panel, "thx", curve)
        assert time_s[-1] == pytest.approx(0.0, abs=0.05)
        assert values[-1] == pytest.approx(591.775, abs=3.0)


def test_every_view_is_drawn_with_cursors_and_another_run_beside(qtbot, window, panel, tmp_path):
    panel.shown.setCurrentIndex(1)
    panel.refresh()
    _, values = drawn(panel, "zn", "measured")
    assert np.abs(values).max() < 0.1  # µm: sensor noise alone
    _, model = drawn(panel, "zn", "model")
    assert model is None or len(model) == 0
    panel.beside.setCurrentIndex(2)
    panel.beside.activated.emit(2)
    assert "no latest run" in window.notices.notices()[0].text
    assert panel.beside.currentIndex() == 0
    panel.pause.setChecked(True)  # so that nothing is drawn between what is asked and read
    panel.beside.setCurrentIndex(1)
    panel.beside.activated.emit(1)
    assert "The kept run" in panel._legend.text()
    for view in (0, 2, 3):
        panel.shown.setCurrentIndex(view)
        for curve in ("measured", "other"):
            across, values = drawn(panel, "zn", curve)
            assert len(across) == len(values) > 10
        np.testing.assert_allclose(values, drawn(panel, "zn", "measured")[1], rtol=1e-9)
    panel.cursors.setChecked(True)  # on the spectrum
    plot, neighbour = panel.plots["x"].plot, panel.plots["zn"].plot
    plot._lines[0].setValue(1.0)
    plot._lines[1].setValue(2.0)
    assert [at for at, _ in neighbour.cursors] == [1.0, 2.0]
    assert panel._legend.text() == "A 10 Hz  B 100 Hz  Δ 90 Hz  1/Δ 0.01111 s"
    assert panel.plots["zn"].figures.text().startswith("Δ ")
    panel.shown.setCurrentIndex(2)
    plot._lines[2].setValue(0.0)
    assert panel.plots["x"].figures.text().startswith("Δx ")
    assert neighbour.cursors[0][1] != 0.0  # every loop has its own
    panel.cursors.setChecked(False)
    assert panel.plots["x"].figures.text().startswith("Gap, last 10 s")
    saved(qtbot, panel, tmp_path)


def saved(qtbot, panel, folder):
    """Save what is shown, read it back, and find it beside itself."""
    for name, begin in (("a.png", b"\x89PNG"), ("a.svg", b"<?xml")):
        panel.save_picture(folder / name)
        assert (folder / name).read_bytes().startswith(begin)
    panel.save_picture(folder / "none" / "a.svg")
    notices = panel.main_window.notices
    assert str(folder / "none") in notices.notices()[0].text
    panel.save_data(folder / "a.csv")
    qtbot.waitUntil((folder / "a.csv").exists, timeout=LONG_MS)
    record = read_record(folder / "a.csv", robot=panel.workbench.robot)
    assert len(record.time_s) == len(panel._picture.window)
    np.testing.assert_array_equal(
        record.signal("thx", Tap.MEAS), panel._picture.window.measured[:, 3]
    )


def test_a_paused_picture_stays(qtbot, window, panel):
    panel.refresh()
    panel.pause.setChecked(True)
    before = drawn(panel, "x", "measured")[1].copy()
    window.workbench.jog("x", 1e-5)
    state = window.workbench.session
    qtbot.waitUntil(lambda: state.snapshot().command["x"] > 0.02750999, timeout=LONG_MS)
    panel.refresh()
    np.testing.assert_array_equal(drawn(panel, "x", "measured")[1], before)


def test_the_scale_follows_only_when_it_must(qtbot):
    plot = SignalPlot(DARK)
    qtbot.addWidget(plot)
    plot.follow(0.0, 1.0, 0.0)
    first = plot.viewRange()[1]
    plot.follow(0.05, 0.95, 0.0)
    assert plot.viewRange()[1] == first
    plot.follow(0.0, 3.0, 0.0)
    assert plot.viewRange()[1][1] > 3.0
    plot.follow(0.0, 0.1, 0.0)
    assert plot.viewRange()[1][1] < 0.2


def test_new_samples_reach_all_plots_one_at_a_time(qtbot, window, panel, monkeypatch):
    qtbot.waitUntil(lambda: not panel._waiting, timeout=LONG_MS)
    window.workbench.shown.disconnect()  # nothing but what is asked for here
    order = []
    monkeypatch.setattr(AxisPlot, "draw", lambda plot, picture: order.append((plot, picture)))
    panel._refresh_by_parts()
    assert len(order) == 1
    panel._refresh_by_parts()  # which comes too early: the others go on first
    assert len(order) == 1
    qtbot.waitUntil(lambda: len(order) == 6, timeout=LONG_MS)
    assert {plot for plot, _ in order} == set(panel.plots.values())
    assert len({id(picture) for _, picture in order}) == 1
    panel._refresh_by_parts()
    assert len(order) == 7
    panel.refresh()  # by hand: all at once, and what waited is done with
    assert len(order) == 13
    qtbot.wait(50)
    assert len(order) == 13


@pytest.mark.parametrize("pixels", [13, 26])
def test_the_scale_of_the_strip_fits_beside_it_however_large_text_is(qtbot, pixels):
    axis = load_robot("rotemina").axes["thx"]
    strip = GapStrip(DARK, "thx", axis, axis.sensor.noise_floor)
    qtbot.addWidget(strip)
    font = strip.font()
    font.setPixelSize(pixels)
    strip.setFont(font)
    strip.resize(300, 50)
    picture = strip.grab().toImage()
    edge = {picture.pixelColor(0, y).name() for y in range(50)}
    assert edge == {DARK.surface}  # no letter is cut


def test_the_strip_of_the_gap_stands_against_floor_and_bounds(qtbot):
    axis = load_robot("rotemina").axes["zn"]
    floor = axis.sensor.noise_floor
    strip = GapStrip(DARK, "zn", axis, floor)
    qtbot.addWidget(strip)
    strip.resize(300, 50)
    since = np.linspace(-10.0, 0.0, 101)
    values = np.full(101, floor)
    values[40:60] = np.nan  # at rest
    values[80:] = 3e-6  # more than noise, within the following bound
    strip.show_course(since, values, 10.0)
    assert strip.top == pytest.approx(2000.0 * floor)
    heights = [strip.height_of(size) for size in (floor, *strip.bounds.values())]
    assert heights == sorted(heights, reverse=True)
    picture = strip.grab().toImage()

    def colours(first, last):
        track = strip.track()
        across = [round(track.left() + share * track.width()) for share in (first, last)]
        return {
            picture.pixelColor(x, y).name()
            for x in range(*across)
            for y in range(int(track.top()), int(strip.height_of(floor)) + 2)
        }

    assert DARK.text in colours(0.1, 0.35)
    assert DARK.text not in colours(0.42, 0.58)
    assert DARK.warning in colours(0.85, 0.95)
    strip.set_stale(True)
    picture = strip.grab().toImage()
    assert DARK.text not in colours(0.0, 1.0)
    assert DARK.quiet in colours(0.1, 0.35)
    strip.show_course(since, np.full(101, np.nan), 10.0)
    assert strip.top == pytest.approx(20.0 * floor)  # nothing moved


def test_the_strip_shows_the_gap_of_the_plots_where_there_is_room(qtbot, window, panel):
    window.resize(1280, 1080)
    window.workbench.jog("zn", 1e-6)
    strip = panel.plots["zn"].strip

    def drawn_to_the_end():
        panel.refresh()
        return np.isfinite(strip._values).any()

    qtbot.waitUntil(drawn_to_the_end, timeout=LONG_MS)
    assert strip.isVisible()
    panel.shown.setCurrentIndex(2)  # a loop has no time
    assert not strip.isVisible()
    panel.shown.setCurrentIndex(0)
    assert strip.isVisible()
    panel.plots["zn"].share_height(40)
    assert not strip.isVisible()


def test_old_readings_are_grey_and_their_age_is_said(qtbot, window, panel):
    def pens():
        curves = panel.plots["zn"].plot._curves
        return {curves[name].opts["pen"].color().name() for name in ("command", "measured")}

    state = window.workbench.session.snapshot()
    own = pens()
    window.workbench.shown.emit(replace(state, age_s=STALE_S + 0.1))
    assert pens() == {QColor(window.workbench.theme.quiet).name()}
    assert not panel.age.isHidden()
    assert panel.age.text() == "The newest reading is 1 s old"
    window.workbench.shown.emit(replace(state, age_s=72.4))
    assert panel.age.text() == "The newest reading is 72 s old"
    window.workbench.shown.emit(replace(state, age_s=0.0))
    assert pens() == own
    assert panel.age.isHidden()


def test_plots_that_are_arranged_anew_keep_their_curves_while_paused(panel):
    panel.grid.arrange(940, 390, 60)
    panel.refresh()
    panel.pause.click()
    panel.grid.arrange(1270, 170, 60)
    for name in panel.plots:
        assert len(drawn(panel, name, "measured")[0]) > 0


@pytest.mark.parametrize(
    ("room", "rows", "head", "times"),
    [
        ((940, 390), [["x", "thx"], ["y", "thy"], ["z", "zn"]], True, ["z", "zn"]),
        ((940, 250), [["x", "y", "z"], ["thx", "thy", "zn"]], True, ["thx", "thy", "zn"]),
        ((590, 170), [["x", "y", "z"], ["thx", "thy", "zn"]], False, ["thx", "thy", "zn"]),
        ((1270, 170), [["x", "y", "z", "thx", "thy", "zn"]], False, []),
        ((590, 90), [["x", "y", "z", "thx", "thy", "zn"]], False, []),
    ],
)
def test_plots_stand_in_as_many_rows_as_fit_and_are_no_narrower_than_can_be_read(
    panel, room, rows, head, times
):
    grid = panel.grid
    assert grid.arrange(*room, 60) is head
    placed = {}
    for name, plot in panel.plots.items():
        row, column, _, _ = grid.layout().getItemPosition(grid.layout().indexOf(plot))
        placed[row, column] = name
    wanted = {(r, c): name for r, names in enumerate(rows) for c, name in enumerate(names)}
    assert placed == wanted
    assert [name for name, plot in panel.plots.items() if plot._times] == times


def test_a_plot_whose_turn_has_not_come_shows_its_ground_and_no_black(qtbot, window, panel):
    plot = panel.plots["x"].plot
    plot.settle()
    plot.resizeEvent(None)
    middle = plot.mapTo(window, plot.rect().center())
    assert window.grab().toImage().pixelColor(middle).name() == window.workbench.theme.surface
    plot.settle()
    assert not plot._turn.is_held

"""The live plots: what is drawn, paused, and how the gap is shown."""

import numpy as np
import pytest

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


def test_the_gap_is_measured_minus_model(qtbot, panel):
    panel.shown.setCurrentIndex(1)
    panel.refresh()
    _, values = drawn(panel, "zn", "measured")
    assert np.abs(values).max() < 0.1  # µm: sensor noise alone
    _, model = drawn(panel, "zn", "model")
    assert model is None or len(model) == 0


def test_a_paused_picture_stays(qtbot, window, panel):
    panel.refresh()
    panel.pause.setChecked(True)
    before = drawn(panel, "x", "measured")[1].copy()
    window.workbench.jog("x", 1e-5)
    state = window.workbench.session
    qtbot.waitUntil(lambda: state.snapshot().command["x"] > 0.02750999, timeout=LONG_MS)
    panel.refresh()
    np.testing.assert_array_equal(drawn(panel, "x", "measured")[1], before)


def test_the_scale_follows_only_when_it_must(panel):
    plot = panel.plots["x"].plot
    plot.follow(0.0, 1.0, 0.0)
    first = plot.viewRange()[1]
    plot.follow(0.05, 0.95, 0.0)
    assert plot.viewRange()[1] == first
    plot.follow(0.0, 3.0, 0.0)
    assert plot.viewRange()[1][1] > 3.0
    plot.follow(0.0, 0.1, 0.0)
    assert plot.viewRange()[1][1] < 0.2

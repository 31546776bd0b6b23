"""Resampling in the window: what comes out is shown before it is accepted."""

import numpy as np
import pytest
from PySide6.QtWidgets import QDialogButtonBox

from rotemina.plugins.trajectory.resampling import ResamplingDialog
from rotemina.sim.records.record import Record, Tap

TIME_S = np.arange(5) * 0.1
RAMP = Record.from_signals(TIME_S, {("x", Tap.CMD): 0.02 + 0.001 * TIME_S}, {"x": "m"})


@pytest.fixture
def dialog(qtbot, window):
    return ResamplingDialog(RAMP, window)


def ok(dialog):
    return dialog.buttons.button(QDialogButtonBox.StandardButton.Ok)


def test_the_induced_speed_is_shown_for_every_method(qtbot, dialog):
    assert dialog.outcome.text() == "X: 1 → 100 mm/s"  # a held step within one millisecond
    dialog.method.setCurrentIndex(1)
    qtbot.waitUntil(lambda: dialog.outcome.text() == "X: 1 → 1 mm/s", timeout=5000)
    assert len(dialog.resampled.time_s) == 401


def test_a_rate_that_is_none_cannot_be_accepted(qtbot, dialog):
    for text in ("", "abc", "-5", "0"):
        dialog.rate.setText(text)
        assert not ok(dialog).isEnabled()
        qtbot.waitUntil(lambda: dialog.resampled is None, timeout=5000)
        assert not ok(dialog).isEnabled()
        assert dialog.outcome.text()
    dialog.rate.setText("250")
    qtbot.waitUntil(ok(dialog).isEnabled, timeout=5000)


def test_the_accepted_trajectory_is_planned(qtbot, window, monkeypatch):
    with qtbot.waitSignal(window.workbench.plan_changed, timeout=30_000):
        window.workbench.plan_trajectory("ramp", RAMP)

    def accept(dialog):
        dialog.method.setCurrentIndex(1)
        dialog._try()
        dialog.accept()

    monkeypatch.setattr(ResamplingDialog, "show", accept)
    with qtbot.waitSignal(window.workbench.plan_changed, timeout=30_000):
        window.panels["trajectory"].resample.click()
    assert window.workbench.plan.name == "ramp, resampled"
    assert len(window.workbench.plan.trajectory.time_s) == 401

"""Resampling in the window, with a preview before it is accepted."""

import numpy as np
import pytest
from PySide6.QtWidgets import QDialogButtonBox

from rotemina.plugins.trajectory.resampling import ResamplingDialog
from rotemina.sim.messages import number_text
from rotemina.sim.records import Record, Tap

TIME_S = np.arange(5) * 0.1
RAMP = Record.from_signals(TIME_S, {("x", Tap.CMD): 0.02 + 0.001 * TIME_S}, {"x": "m"})


def get_ok_button(dialog):
    return dialog.buttons.button(QDialogButtonBox.StandardButton.Ok)


def test_the_resulting_speed_is_shown_and_an_invalid_rate_cannot_be_accepted(qtbot, window):
    dialog = ResamplingDialog(RAMP, window)
    # The default method holds values, so each step takes one millisecond.
    assert dialog.outcome.text() == "X: 1 → 100 mm/s"
    dialog.method.setCurrentIndex(1)
    qtbot.waitUntil(lambda: dialog.outcome.text() == "X: 1 → 1 mm/s", timeout=5000)
    assert len(dialog.resampled.time_s) == 401
    for text in ("", "-5", "0"):
        dialog.rate.setText(text)
        assert not get_ok_button(dialog).isEnabled()
        qtbot.waitUntil(lambda: dialog.resampled is None, timeout=5000)
        assert not get_ok_button(dialog).isEnabled()
        assert dialog.outcome.text()
    dialog.rate.setText("250")
    qtbot.waitUntil(get_ok_button(dialog).isEnabled, timeout=5000)
    number_text.use_decimal_sign(",")
    try:
        dialog.rate.setText("12,5")
        dialog._update_preview()
        assert np.diff(dialog.resampled.time_s)[0] == pytest.approx(0.08)
        for text in ("1.000,5", "nan", "1_000", "abc"):
            dialog.rate.setText(text)
            dialog._update_preview()
            assert dialog.resampled is None
            assert f"{text!r} is not a number" in dialog.outcome.text()
    finally:
        number_text.use_decimal_sign(number_text.POINT)


def test_the_accepted_trajectory_is_planned(qtbot, window, monkeypatch):
    with qtbot.waitSignal(window.workbench.plan_changed, timeout=30_000):
        window.workbench.plan_trajectory("ramp", RAMP)

    def accept_at_once(dialog):
        dialog.method.setCurrentIndex(1)
        dialog._update_preview()
        dialog.accept()

    monkeypatch.setattr(ResamplingDialog, "show", accept_at_once)
    with qtbot.waitSignal(window.workbench.plan_changed, timeout=30_000):
        window.panels["trajectory"].resample.click()
    assert window.workbench.plan.name == "ramp, resampled"
    assert len(window.workbench.plan.trajectory.time_s) == 401

"""The panel check detects errors of a panel that would escape into Qt."""

import sys

import pytest
from PySide6.QtCore import QTimer
from PySide6.QtGui import QPainter
from PySide6.QtWidgets import QLabel, QPushButton, QVBoxLayout

from rotemina.app.panel import Panel
from rotemina.app.plugin_kit import check_panel, open_panel_bench

pytestmark = pytest.mark.usefixtures("qapp")


class GoodPanel(Panel):
    title = "Good"

    def __init__(self, workbench):
        super().__init__(workbench)
        self.text = QLabel()
        QVBoxLayout(self).addWidget(self.text)
        workbench.shown.connect(self.show_state)

    def show_state(self, state):
        self.text.setText(f"{state.measured['x']:g}")


class FailingPainterPanel(GoodPanel):
    def paintEvent(self, event):  # noqa: N802 (Qt's name)
        raise ValueError("no colour")


class WrongPainterPanel(GoodPanel):
    def paintEvent(self, event):  # noqa: N802 (Qt's name)
        QPainter(self).drawLine(0, 0, 1, 1)
        QPainter().setOpacity(0.5)  # without a paint device, so Qt warns


class FailingListenerPanel(GoodPanel):
    def show_state(self, state):
        raise KeyError("thy")


class UndisconnectedPanel(GoodPanel):
    def __init__(self, workbench):
        super().__init__(workbench)
        text = self.text
        workbench.shown.connect(lambda _: text.setText("still here"))


class FailingTimerPanel(GoodPanel):
    def __init__(self, workbench):
        super().__init__(workbench)
        QTimer.singleShot(0, self, lambda: 1 / 0)


class UntitledPanel(GoodPanel):
    title = " "


class LateEnabledPanel(GoodPanel):
    def __init__(self, workbench):
        super().__init__(workbench)
        self.move = QPushButton("Move")
        self.layout().addWidget(self.move)
        workbench.refreshed.connect(self.enable)

    def enable(self, state):
        self.move.setEnabled(state.lock_reason is None)


class ImmediatelyEnabledPanel(LateEnabledPanel):
    def __init__(self, workbench):
        super().__init__(workbench)
        workbench.refreshed.disconnect(self.enable)
        self.follow(self.enable)


class ExitingPanel(GoodPanel):
    def __init__(self, workbench):
        raise SystemExit(3)


def find_failures(panel):
    return {result.name: result.note for result in check_panel(panel) if result.verdict == "failed"}


def test_good_panels_pass():
    assert find_failures(GoodPanel) == {}
    assert find_failures(ImmediatelyEnabledPanel) == {}


@pytest.mark.parametrize(
    ("panel", "name", "message"),
    [
        (FailingPainterPanel, "painted", "no colour"),
        (WrongPainterPanel, "painted", "QPainter"),
        (FailingListenerPanel, "informed", "KeyError: 'thy'"),
        (UndisconnectedPanel, "closed", "already deleted"),
        (FailingTimerPanel, "painted", "ZeroDivisionError"),
        (
            LateEnabledPanel,
            "enabled-at-once",
            "the machine was locked, the first refresh changed 'Move'",
        ),
        (UntitledPanel, "described", "the title ' '"),
        (ExitingPanel, "described", "it raised SystemExit: 3"),
    ],
)
def test_bad_panel_is_detected(panel, name, message):
    hook = sys.excepthook
    assert message in find_failures(panel)[name]
    assert sys.excepthook is hook


def test_bench_shows_the_position_of_the_machine():
    with open_panel_bench(GoodPanel, "fsm") as bench:
        assert set(bench.workbench.robot.axes) != {"x"}
    with open_panel_bench(GoodPanel) as bench:
        bench.workbench.session.jog("x", 1e-4)
        before = bench.text_of("x")
        bench.advance(1.0)
        assert bench.text_of("x") != before
        assert bench.panel.text.text() != ""

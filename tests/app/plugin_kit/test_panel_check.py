"""The check of panels finds what a panel lets escape into Qt."""

import sys

import pytest
from PySide6.QtCore import QTimer
from PySide6.QtGui import QPainter
from PySide6.QtWidgets import QLabel, QPushButton, QVBoxLayout

from rotemina.app.panel import Panel
from rotemina.app.plugin_kit.panel_bench import panel_bench
from rotemina.app.plugin_kit.panel_check import check_panel

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


class BadPainter(GoodPanel):
    def paintEvent(self, event):  # noqa: N802 (Qt's name)
        raise ValueError("no colour")


class Untidy(GoodPanel):
    def paintEvent(self, event):  # noqa: N802 (Qt's name)
        QPainter(self).drawLine(0, 0, 1, 1)
        QPainter().setOpacity(0.5)  # on nothing: Qt complains


class BadListener(GoodPanel):
    def show_state(self, state):
        raise KeyError("thy")


class Clinging(GoodPanel):
    def __init__(self, workbench):
        super().__init__(workbench)
        text = self.text
        workbench.shown.connect(lambda _: text.setText("still here"))


class BadTimer(GoodPanel):
    def __init__(self, workbench):
        super().__init__(workbench)
        QTimer.singleShot(0, self, lambda: 1 / 0)


class Nameless(GoodPanel):
    title = " "


class EnabledLate(GoodPanel):
    def __init__(self, workbench):
        super().__init__(workbench)
        self.move = QPushButton("Move")
        self.layout().addWidget(self.move)
        workbench.refreshed.connect(self.enable)

    def enable(self, state):
        self.move.setEnabled(state.locked is None)


class EnabledAtOnce(EnabledLate):
    def __init__(self, workbench):
        super().__init__(workbench)
        workbench.refreshed.disconnect(self.enable)
        self.follow(self.enable)


class Unmade(GoodPanel):
    def __init__(self, workbench):
        raise SystemExit(3)


def failures(kind):
    return {one.name: one.note for one in check_panel(kind) if one.verdict == "failed"}


def test_a_good_panel_passes():
    assert failures(GoodPanel) == {}
    assert failures(EnabledAtOnce) == {}


@pytest.mark.parametrize(
    ("kind", "name", "said"),
    [
        (BadPainter, "painted", "no colour"),
        (Untidy, "painted", "QPainter"),
        (BadListener, "informed", "KeyError: 'thy'"),
        (Clinging, "closed", "already deleted"),
        (BadTimer, "painted", "ZeroDivisionError"),
        (
            EnabledLate,
            "enabled-at-once",
            "the machine was locked, the first refresh changed 'Move'",
        ),
        (Nameless, "described", "the title ' '"),
        (Unmade, "described", "it raised SystemExit: 3"),
    ],
)
def test_a_bad_panel_is_found(kind, name, said):
    hook = sys.excepthook
    assert said in failures(kind)[name]
    assert sys.excepthook is hook


def test_the_bench_tells_where_the_machine_is():
    with panel_bench(GoodPanel, "fsm") as bench:
        assert set(bench.workbench.robot.axes) != {"x"}
    with panel_bench(GoodPanel) as bench:
        bench.workbench.session.jog("x", 1e-4)
        before = bench.text_of("x")
        bench.advance(1.0)
        assert bench.text_of("x") != before
        assert bench.panel.text.text() != ""

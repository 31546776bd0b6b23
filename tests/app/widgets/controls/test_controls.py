"""Disabled controls say why, and properties and bars update their look."""

from PySide6.QtWidgets import QLabel, QProgressBar, QPushButton, QWidget

from rotemina.app.widgets.controls import (
    enable_unless,
    get_disabled_reason,
    make_tooltip,
    set_bar_value,
    set_property,
)


def test_a_disabled_control_says_why(qtbot):
    control = QPushButton()
    qtbot.addWidget(control)
    enable_unless(control, "nothing <moves>", "Stop it")
    assert not control.isEnabled()
    assert get_disabled_reason(control) == "nothing <moves>"
    assert control.toolTip() == make_tooltip("Stop it", "Not now: nothing <moves>")
    assert "<moves>" not in control.toolTip()
    enable_unless(control, None, "Stop it")
    assert control.isEnabled()
    assert get_disabled_reason(control) is None
    assert control.toolTip() == make_tooltip("Stop it")


def test_a_property_changes_the_look(qtbot):
    parent = QWidget()
    parent.setStyleSheet("QLabel[bad=true] { color: #ff0000; }")
    qtbot.addWidget(parent)
    label = QLabel("x", parent)
    label.ensurePolished()
    before = label.palette().color(label.foregroundRole()).name()
    assert set_property(label, "bad", True)
    assert label.palette().color(label.foregroundRole()).name() == "#ff0000" != before
    assert not set_property(label, "bad", True)
    assert set_property(label, "bad", False)
    assert label.palette().color(label.foregroundRole()).name() == before


def test_a_bar_is_not_painted_at_once(qtbot):
    painted = []

    class Bar(QProgressBar):
        def paintEvent(self, event):  # noqa: N802 (Qt's name)
            painted.append(self.value())
            super().paintEvent(event)

    bar = Bar()
    qtbot.addWidget(bar)
    bar.show()
    set_bar_value(bar, 0)
    qtbot.waitUntil(lambda: painted[-1:] == [0], timeout=30_000)
    set_bar_value(bar, 60)
    assert bar.value() == 60
    assert painted[-1] == 0
    qtbot.waitUntil(lambda: painted[-1] == 60, timeout=30_000)

"""Controls that say why they cannot act, and what they show."""

from PySide6.QtWidgets import QLabel, QProgressBar, QPushButton, QWidget

from rotemina.app.widgets.controls import allow, button, fill, plain_tip, set_property, why_not


def test_a_control_that_cannot_act_says_why(qtbot):
    control = QPushButton()
    qtbot.addWidget(control)
    allow(control, "nothing <moves>", "Stop it")
    assert not control.isEnabled()
    assert why_not(control) == "nothing <moves>"
    assert control.toolTip() == plain_tip("Stop it", "Not now: nothing <moves>")
    assert "<moves>" not in control.toolTip()
    allow(control, None, "Stop it")
    assert control.isEnabled()
    assert why_not(control) is None
    assert control.toolTip() == plain_tip("Stop it")


def test_a_button_does_one_thing(qtbot):
    pressed = []
    made = button("Go", lambda: pressed.append(1), "Move <there>")
    qtbot.addWidget(made)
    made.click()
    assert pressed == [1]
    assert made.toolTip() == plain_tip("Move <there>")


def test_a_property_changes_the_look(qtbot):
    around = QWidget()
    around.setStyleSheet("QLabel[bad=true] { color: #ff0000; }")
    qtbot.addWidget(around)
    label = QLabel("x", around)
    label.ensurePolished()
    before = label.palette().color(label.foregroundRole()).name()
    assert set_property(label, "bad", True)
    assert label.palette().color(label.foregroundRole()).name() == "#ff0000" != before
    assert not set_property(label, "bad", True)
    assert set_property(label, "bad", False)
    assert label.palette().color(label.foregroundRole()).name() == before


def test_a_bar_that_fills_is_painted_later_with_the_rest(qtbot):
    painted = []

    class Bar(QProgressBar):
        def paintEvent(self, event):  # noqa: N802 (Qt's name)
            painted.append(self.value())
            super().paintEvent(event)

    bar = Bar()
    qtbot.addWidget(bar)
    bar.show()
    fill(bar, 0)
    qtbot.waitUntil(lambda: painted[-1:] == [0], timeout=30_000)
    fill(bar, 60)
    assert bar.value() == 60
    assert painted[-1] == 0
    qtbot.waitUntil(lambda: painted[-1] == 60, timeout=30_000)

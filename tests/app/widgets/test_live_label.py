"""A label whose digits change at every frame: what it says, and what is laid out for it."""

import pytest
from PySide6.QtCore import QEvent, QObject
from PySide6.QtWidgets import QApplication, QLabel, QVBoxLayout, QWidget

from rotemina.app.widgets.labels import LiveLabel


class Laid(QObject):
    """How often a widget was asked to lay its parts out anew."""

    def __init__(self, widget):
        super().__init__(widget)
        self.times = 0
        widget.installEventFilter(self)

    def eventFilter(self, watched, event):  # noqa: N802 (Qt's name)
        self.times += event.type() == QEvent.Type.LayoutRequest
        return False


@pytest.fixture
def beside(qtbot):
    """A live label in a window, beside one of Qt's."""
    window = QWidget()
    qtbot.addWidget(window)
    column = QVBoxLayout(window)
    live, plain = LiveLabel("+0.000 µm"), QLabel("+0.000 µm")
    for one in (live, plain):
        column.addWidget(one)
    with qtbot.waitExposed(window):
        window.show()
    return window, live, plain


def test_only_another_form_is_laid_out(qtbot, beside):
    window, live, _ = beside
    laid = Laid(window)
    for text in ("−1.234 µm", "+9.871 µm", "+0.000 µm"):
        live.setText(text)
        QApplication.processEvents()
        assert live.text() == live.accessibleName() == text
    assert laid.times == 0
    width = live.sizeHint().width()
    live.setText("+10.000 µm")
    qtbot.waitUntil(lambda: laid.times == 1)
    assert live.sizeHint().width() > width


@pytest.mark.parametrize("sheet", ["", "QLabel {border: 1px solid red; padding: 1px 9px}"])
def test_it_looks_like_a_label(beside, sheet):
    window, live, plain = beside
    window.setStyleSheet(sheet)
    for text in ("+0.000 µm", "−7.314 µm"):
        live.setText(text)
        plain.setText(text)
        QApplication.processEvents()
        assert live.grab().toImage() == plain.grab().toImage()

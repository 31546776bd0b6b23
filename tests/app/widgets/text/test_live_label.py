"""A live label looks like Qt's, but new digits of the same form need no layout."""

import pytest
from PySide6.QtCore import QEvent, QObject
from PySide6.QtWidgets import QApplication, QLabel, QVBoxLayout, QWidget

from rotemina.app.widgets.text import LiveLabel


class LayoutRequestCounter(QObject):
    """Counts the layout requests of a widget."""

    def __init__(self, widget):
        super().__init__(widget)
        self.count = 0
        widget.installEventFilter(self)

    def eventFilter(self, watched, event):  # noqa: N802 (Qt's name)
        self.count += event.type() == QEvent.Type.LayoutRequest
        return False


@pytest.fixture
def window_with_labels(qtbot):
    """A window with a live label and one of Qt's."""
    window = QWidget()
    qtbot.addWidget(window)
    column = QVBoxLayout(window)
    live, plain = LiveLabel("+0.000 µm"), QLabel("+0.000 µm")
    for label in (live, plain):
        column.addWidget(label)
    with qtbot.waitExposed(window):
        window.show()
    return window, live, plain


def test_only_a_text_of_another_form_is_laid_out_again(qtbot, window_with_labels):
    window, live, _ = window_with_labels
    requests = LayoutRequestCounter(window)
    for text in ("−1.234 µm", "+9.871 µm", "+0.000 µm"):
        live.setText(text)
        QApplication.processEvents()
        assert live.text() == live.accessibleName() == text
    assert requests.count == 0
    width = live.sizeHint().width()
    live.setText("+10.000 µm")
    qtbot.waitUntil(lambda: requests.count == 1)
    assert live.sizeHint().width() > width


@pytest.mark.parametrize("sheet", ["", "QLabel {border: 1px solid red; padding: 1px 9px}"])
def test_a_live_label_looks_like_a_label(window_with_labels, sheet):
    window, live, plain = window_with_labels
    window.setStyleSheet(sheet)
    for text in ("+0.000 µm", "−7.314 µm"):
        live.setText(text)
        plain.setText(text)
        QApplication.processEvents()
        assert live.grab().toImage() == plain.grab().toImage()

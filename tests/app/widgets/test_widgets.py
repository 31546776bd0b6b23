"""The widgets used by the panels."""

import pytest
from PySide6.QtCore import QPoint, QPointF, QSize, Qt
from PySide6.QtGui import QColor, QWheelEvent
from PySide6.QtWidgets import QApplication, QLabel, QWidget

from rotemina.app.widgets.controls import (
    WheelSafeComboBox,
    WheelSafeSlider,
    WheelSafeSpinBox,
    make_tooltip,
)
from rotemina.app.widgets.layout import (
    InlineQuestion,
    PanelFrame,
    find_frame,
    make_column,
    make_scroll_area,
)
from rotemina.app.widgets.style.theme import DARK
from rotemina.app.widgets.text import (
    ElidedLabel,
    TextTable,
    ValueGrid,
    make_colour_legend,
    make_plain_label,
    reserve_lines,
)
from rotemina.app.widgets.text.table import RIGHT_ALIGNED


def make_combo_box():
    combo_box = WheelSafeComboBox("Speed <of all>", letters=4)
    for percent in (100, 50, 10):
        combo_box.addItem(f"{percent} %", percent)
    return combo_box, combo_box.currentIndex, 1


def make_slider():
    slider_widget = WheelSafeSlider("Share", 500)
    return slider_widget, slider_widget.value, 200


def make_spin_box():
    spin_box = WheelSafeSpinBox()
    spin_box.setRange(0.0, 500.0)
    return spin_box, spin_box.value, 3.0


@pytest.mark.parametrize("make_widget", [make_combo_box, make_slider, make_spin_box])
def test_the_wheel_scrolls_the_area_and_not_the_control(qtbot, make_widget):
    widget, value, initial = make_widget()
    qtbot.addWidget(widget)
    (widget.setCurrentIndex if make_widget is make_combo_box else widget.setValue)(initial)
    widget.show()
    for notches in (-120, 120):
        wheel = QWheelEvent(
            QPointF(5, 5),
            QPointF(5, 5),
            QPoint(),
            QPoint(0, notches),
            Qt.MouseButton.NoButton,
            Qt.KeyboardModifier.NoModifier,
            Qt.ScrollPhase.NoScrollPhase,
            False,
        )
        QApplication.sendEvent(widget, wheel)
        assert not wheel.isAccepted()
        assert value() == initial


def test_a_text_keeps_room_for_its_lines_at_any_font_size(qtbot):
    label = make_plain_label("a", lines=2)
    qtbot.addWidget(label)
    two_line_height = label.height()
    label.setText("a\nb\nc\nd")
    assert label.sizeHint().height() > label.height() == two_line_height
    reserve_lines(label, 3)
    assert label.height() == two_line_height + label.fontMetrics().lineSpacing()
    label.setStyleSheet("font-size: 40px;")
    label.show()
    assert label.height() > 120 > two_line_height


def test_a_narrow_label_draws_the_longest_form_that_fits(qtbot):
    label, short, shortest = ElidedLabel(), ElidedLabel(), ElidedLabel()
    for elided in (label, short, shortest):
        qtbot.addWidget(elided)
    label.show_text("Gap, last 10 s 12.4 nm", "10 s: 12.4 nm", "12.4 nm")
    short.show_text("10 s: 12.4 nm")
    shortest.show_text("12.4 nm")
    label.ensurePolished()  # before that, it does not have its final font
    measure = label.fontMetrics().horizontalAdvance
    medium_width, small_width = measure("10 s: 12.4 nm") + 2, measure("12.4 nm") + 2
    assert small_width < medium_width < measure("Gap, last 10 s 12.4 nm") - 2

    def grab(elided, width):
        elided.resize(width, 20)
        return elided.grab().toImage()

    assert grab(label, medium_width) == grab(short, medium_width)
    assert grab(label, small_width) == grab(shortest, small_width) != grab(short, small_width)
    assert grab(label, 3 * medium_width) != grab(short, 3 * medium_width)
    assert label.text() == "Gap, last 10 s 12.4 nm"
    label.show_text("position <unknown>")
    assert label.toolTip() == make_tooltip("position <unknown>")
    text = make_colour_legend(DARK, [("a<b", "real"), ("c", "model")])
    assert f'<span style="color:{DARK.real}">a&lt;b</span>' in text


def test_values_are_never_cut_and_show_their_age(qtbot):
    figures = ValueGrid({"Load": "how <far>", "Way": ""}, widest="50000 µm/s")
    qtbot.addWidget(figures)
    load, way = figures.values["Load"], figures.values["Way"]
    figures.show_values("3 µm", "7 µm")
    assert (load.text(), way.text()) == ("3 µm", "7 µm")
    assert (load.accessibleName(), load.toolTip()) == ("Load", make_tooltip("how <far>"))
    assert way.toolTip() == ""
    figures.show()
    assert load.minimumWidth() >= load.fontMetrics().horizontalAdvance("50000 µm/s")
    # A micro axis: the text is wider, and no digit may be cut.
    figures.show_values("80000.00 µm", "7 µm")
    figures.adjustSize()
    assert load.width() >= load.fontMetrics().horizontalAdvance("80000.00 µm")
    figures.set_stale(True)
    assert load.property("stale") is True
    with pytest.raises(ValueError, match="zip"):
        figures.show_values("3 µm")


def test_a_table_shows_read_only_rows_of_text(qtbot):
    table = TextTable("Gaps", ("axis", "rms"))
    qtbot.addWidget(table)
    red = QColor("red")
    table.show_rows([("x", "1 nm"), ("y", "2 nm")], [None, red], tips=True)
    assert table.read_texts() == [["x", "1 nm"], ["y", "2 nm"]]
    assert table.editTriggers() == TextTable.EditTrigger.NoEditTriggers
    assert table.item(0, 1).textAlignment() == RIGHT_ALIGNED
    assert table.item(0, 0).textAlignment() != RIGHT_ALIGNED
    assert table.item(1, 0).foreground().color() == red
    assert table.item(0, 1).toolTip() == make_tooltip("1 nm")
    table.set_headers(("a", "b", "c"))
    table.show_rows([("1", "2", "3")], numeric_columns=(0,))
    assert table.read_texts() == [["1", "2", "3"]]
    assert table.item(0, 0).textAlignment() == RIGHT_ALIGNED != table.item(0, 1).textAlignment()
    assert table.horizontalHeaderItem(2).text() == "c"


@pytest.mark.parametrize("is_selectable", [True, False])
def test_table_rows_can_be_selected_unless_disabled(qtbot, is_selectable):
    table = TextTable("Gaps", ("axis",), selectable=is_selectable)
    qtbot.addWidget(table)
    table.show_rows([("x",), ("y",)])
    table.selectRow(1)
    assert bool(table.selectedItems()) is is_selectable


def test_a_question_is_answered_once(qtbot):
    done, question = [], InlineQuestion()
    qtbot.addWidget(question)
    assert question.isHidden()
    question.ask("Apply 80 V?", "Apply", lambda: done.append("yes"))
    assert (question.text.text(), question.yes.text()) == ("Apply 80 V?", "Apply")
    question.no.click()
    assert (question.isHidden(), done) == (True, [])
    question.ask("Apply 80 V?", "Apply", lambda: done.append("yes"))
    question.yes.click()
    assert (question.isHidden(), done) == (True, ["yes"])


def test_a_fitted_area_is_as_wide_as_its_content_at_any_text_size(qtbot):
    content = QWidget()
    label = QLabel("a text")
    make_column(label, on=content)
    area = make_scroll_area(content, min_width=20)
    qtbot.addWidget(area)
    area.show()
    before = area.minimumSizeHint().width()
    assert before > content.minimumSizeHint().width() > 20
    area.setStyleSheet("* { font-size: 40px; }")
    assert area.minimumSizeHint().width() > before + 20
    assert make_scroll_area(QWidget(), min_width=300).minimumSizeHint().width() == 300


class SizeDependentPanel(QWidget):
    """Needs less width if it is low, so that a horizontal scroll bar makes itself unnecessary."""

    resize_count = 0

    def minimumSizeHint(self):  # noqa: N802 (Qt's name)
        return QSize(400 if self.height() >= 200 else 50, 50)

    def resizeEvent(self, event):  # noqa: N802 (Qt's name)
        super().resizeEvent(event)
        self.resize_count += 1
        self.updateGeometry()


def test_a_frame_takes_the_size_of_its_panel_up_to_a_limit_and_scrolls(qtbot):
    panel = QWidget()
    panel.setMinimumSize(300, 3000)
    frame = PanelFrame(panel, QSize(500, 200))
    qtbot.addWidget(frame)
    assert frame.minimumSizeHint() == QSize(300, 200)
    frame.set_room(QSize(250, 100))
    assert frame.minimumSizeHint() == QSize(250, 100)
    frame.resize(320, 400)
    frame.show()
    bar = frame.verticalScrollBar().sizeHint().width()
    assert panel.size() == QSize(320 - bar, 3000)
    assert frame.verticalScrollBar().maximum() == 2600
    assert find_frame(panel) is frame
    assert find_frame(frame.parentWidget() or panel) is frame


def test_a_frame_settles_with_a_panel_whose_size_hint_depends_on_its_size(qtbot):
    panel = SizeDependentPanel()
    frame = PanelFrame(panel, QSize(500, 200))
    qtbot.addWidget(frame)
    frame.resize(300, 205)
    frame.show()
    for _ in range(10):
        QApplication.processEvents()
    before = panel.resize_count
    for _ in range(10):
        QApplication.processEvents()
    assert panel.resize_count == before
    assert frame.horizontalScrollBar().isVisible()

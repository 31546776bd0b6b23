"""The widgets that the panels are made of."""

import pytest
from PySide6.QtCore import QPoint, QPointF, QSize, Qt
from PySide6.QtGui import QColor, QWheelEvent
from PySide6.QtWidgets import QApplication, QLabel, QPushButton, QWidget

from rotemina.app.shell.theme import DARK
from rotemina.app.widgets.controls import plain_tip
from rotemina.app.widgets.figures import Figures
from rotemina.app.widgets.inline_question import Question
from rotemina.app.widgets.labels import ElidedLabel, keep_lines, legend, plain_text, show_text
from rotemina.app.widgets.layouts import in_column
from rotemina.app.widgets.scroll_areas import PanelFrame, frame_of, scrolled, tabbed
from rotemina.app.widgets.section import Section, clear
from rotemina.app.widgets.table import RIGHT, Table
from rotemina.app.widgets.wheel_safe import SteadyChoice, SteadyNumber, SteadySlider


def choice():
    made = SteadyChoice("Speed <of all>", letters=4)
    for percent in (100, 50, 10):
        made.addItem(f"{percent} %", percent)
    return made, made.currentIndex, 1


def slider():
    made = SteadySlider("Share", 500)
    return made, made.value, 200


def number():
    made = SteadyNumber()
    made.setRange(0.0, 500.0)
    return made, made.value, 3.0


@pytest.mark.parametrize("kind", [choice, slider, number])
def test_the_wheel_is_left_to_what_scrolls(qtbot, kind):
    widget, value, put = kind()
    qtbot.addWidget(widget)
    (widget.setCurrentIndex if kind is choice else widget.setValue)(put)
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
        assert value() == put


def test_a_choice_is_named_and_selects_by_value(qtbot):
    made = choice()[0]
    qtbot.addWidget(made)
    assert made.accessibleName() == "Speed <of all>"
    assert made.toolTip() == plain_tip("Speed <of all>")
    made.select(10)
    assert made.currentText() == "10 %"
    made.select(33)
    assert made.currentIndex() == -1
    assert SteadyChoice("a", "about <it>").toolTip() == plain_tip("about <it>")


def test_a_section_is_a_heading_over_a_column(qtbot):
    section = Section("Line")
    qtbot.addWidget(section)
    first, second = QPushButton("a"), QPushButton("b")
    equal = section.add_row(first, second)
    assert [equal.stretch(i) for i in (0, 1)] == [1, 1]
    unequal = section.add_row(QLabel("c"), QLabel("d"), equal=False)
    assert [unequal.stretch(i) for i in (0, 1)] == [1, 0]
    text = section.add_text()
    section.show()
    assert section.heading.isVisible()
    assert (text.textFormat(), text.wordWrap()) == (Qt.TextFormat.PlainText, True)
    assert Section().column.count() == 0
    clear(unequal)
    assert unequal.count() == 0
    assert first.isVisible()


def test_an_empty_text_takes_no_room(qtbot):
    label = plain_text()
    qtbot.addWidget(label)
    show_text(label, "<b>on</b>")
    assert not label.isHidden()
    assert label.textFormat() is Qt.TextFormat.PlainText
    show_text(label, "")
    assert label.isHidden()


def test_a_text_keeps_room_for_its_lines(qtbot):
    label = plain_text("a", lines=2)
    qtbot.addWidget(label)
    two = label.height()
    label.setText("a\nb\nc\nd")
    assert label.sizeHint().height() > label.height() == two
    keep_lines(label, 3)
    assert label.height() == two + label.fontMetrics().lineSpacing()


def test_a_cut_label_asks_for_no_width_and_tells_all_of_it(qtbot):
    label = ElidedLabel()
    qtbot.addWidget(label)
    label.show_text("position <unknown> " * 20)
    assert label.minimumSizeHint().width() == label.sizeHint().width() == 0
    assert label.toolTip() == plain_tip("position <unknown> " * 20)


def test_a_narrow_label_draws_the_longest_form_that_has_room(qtbot):
    label, short, shortest = ElidedLabel(), ElidedLabel(), ElidedLabel()
    for one in (label, short, shortest):
        qtbot.addWidget(one)
    label.show_text("Gap, last 10 s 12.4 nm", "10 s: 12.4 nm", "12.4 nm")
    short.show_text("10 s: 12.4 nm")
    shortest.show_text("12.4 nm")
    label.ensurePolished()  # until then it has not the font it is drawn in
    width_of = label.fontMetrics().horizontalAdvance
    room, little = width_of("10 s: 12.4 nm") + 2, width_of("12.4 nm") + 2
    assert little < room < width_of("Gap, last 10 s 12.4 nm") - 2

    def drawn(one, width):
        one.resize(width, 20)
        return one.grab().toImage()

    assert drawn(label, room) == drawn(short, room)
    assert drawn(label, little) == drawn(shortest, little) != drawn(short, little)
    assert drawn(label, 3 * room) != drawn(short, 3 * room)
    assert label.text() == "Gap, last 10 s 12.4 nm"


def test_a_legend_has_names_in_their_colours():
    text = legend(DARK, [("a<b", "real"), ("c", "model")])
    assert text == (
        f'<span style="color:{DARK.real}">a&lt;b</span>, <span style="color:{DARK.model}">c</span>'
    )
    assert legend(DARK, [("c", "real")], mark="▬").endswith("▬</span>&nbsp;c")


def test_figures_have_room_and_show_their_age(qtbot):
    figures = Figures({"Load": "how <far>", "Way": ""}, widest="50000 µm/s")
    qtbot.addWidget(figures)
    load, way = figures.values["Load"], figures.values["Way"]
    figures.show_values("3 µm", "7 µm")
    assert (load.text(), way.text()) == ("3 µm", "7 µm")
    assert (load.accessibleName(), load.toolTip()) == ("Load", plain_tip("how <far>"))
    assert way.toolTip() == ""
    figures.show()
    assert load.minimumWidth() >= load.fontMetrics().horizontalAdvance("50000 µm/s")
    figures.show_values("80000.00 µm", "7 µm")  # a micro axis: wider, and no digit may be cut
    figures.adjustSize()
    assert load.width() >= load.fontMetrics().horizontalAdvance("80000.00 µm")
    figures.set_stale(True)
    assert load.property("stale") is True
    with pytest.raises(ValueError, match="zip"):
        figures.show_values("3 µm")


def test_a_table_shows_rows_of_text_that_nobody_edits(qtbot):
    table = Table("Gaps", ("axis", "rms"))
    qtbot.addWidget(table)
    red = QColor("red")
    table.show_rows([("x", "1 nm"), ("y", "2 nm")], [None, red], tips=True)
    assert table.texts() == [["x", "1 nm"], ["y", "2 nm"]]
    assert table.editTriggers() == Table.EditTrigger.NoEditTriggers
    assert table.item(0, 1).textAlignment() == RIGHT
    assert table.item(0, 0).textAlignment() != RIGHT
    assert table.item(1, 0).foreground().color() == red
    assert table.item(0, 1).toolTip() == plain_tip("1 nm")
    table.set_head(("a", "b", "c"))
    table.show_rows([("1", "2", "3")], numbers=(0,))
    assert table.texts() == [["1", "2", "3"]]
    assert table.item(0, 0).textAlignment() == RIGHT != table.item(0, 1).textAlignment()
    assert table.horizontalHeaderItem(2).text() == "c"


def test_rows_of_a_table_are_chosen_unless_told_otherwise(qtbot):
    chosen = []
    for choose in (True, False):
        table = Table("Gaps", ("axis",), choose=choose)
        qtbot.addWidget(table)
        table.show_rows([("x",), ("y",)])
        table.itemSelectionChanged.connect(lambda: chosen.append(1))
        table.selectRow(1)
        assert bool(table.selectedItems()) is choose
    assert chosen == [1]


def test_a_question_is_answered_once(qtbot):
    done, question = [], Question()
    qtbot.addWidget(question)
    assert question.isHidden()
    question.ask("Apply 80 V?", "Apply", lambda: done.append("yes"))
    assert (question.text.text(), question.yes.text()) == ("Apply 80 V?", "Apply")
    question.no.click()
    assert (question.isHidden(), done) == (True, [])
    question.ask("Apply 80 V?", "Apply", lambda: done.append("yes"))
    question.yes.click()
    assert (question.isHidden(), done) == (True, ["yes"])


def test_content_is_scrolled_up_and_down_alone(qtbot):
    content = QWidget()
    content.setMinimumWidth(240)
    area = scrolled(content)
    qtbot.addWidget(area)
    off = Qt.ScrollBarPolicy.ScrollBarAlwaysOff
    assert area.horizontalScrollBarPolicy() is off
    assert area.widget() is content
    area = scrolled(QLabel("a text"), sideways=True)
    qtbot.addWidget(area)
    assert area.horizontalScrollBarPolicy() is not off


def test_a_fitted_area_is_as_wide_as_its_content_in_any_size_of_text(qtbot):
    content = QWidget()
    label = QLabel("a text")
    in_column(label, on=content)
    area = scrolled(content, least=20)
    qtbot.addWidget(area)
    area.show()
    before = area.minimumSizeHint().width()
    assert before > content.minimumSizeHint().width() > 20
    area.setStyleSheet("* { font-size: 40px; }")
    assert area.minimumSizeHint().width() > before + 20
    assert scrolled(QWidget(), least=300).minimumSizeHint().width() == 300


def test_what_depends_on_the_theme_is_fitted_anew(qtbot):
    label = plain_text(lines=2)
    qtbot.addWidget(label)
    before = label.height()
    label.setStyleSheet("font-size: 40px;")
    label.show()
    assert label.height() > 80 > before


def test_one_of_several_pages_is_seen(qtbot):
    first, second = QLabel("a"), QLabel("b")
    tabs, views = tabbed("What is shown", {"One": first, "Two": second})
    qtbot.addWidget(tabs)
    qtbot.addWidget(views)
    tabs.setCurrentIndex(1)
    assert views.currentWidget() is second
    assert [tabs.tabText(i) for i in (0, 1)] == ["One", "Two"]


class Fickle(QWidget):
    """Asks for less width when it is low: a scroll bar across makes itself needless."""

    resized = 0

    def minimumSizeHint(self):  # noqa: N802 (Qt's name)
        return QSize(400 if self.height() >= 200 else 50, 50)

    def resizeEvent(self, event):  # noqa: N802 (Qt's name)
        super().resizeEvent(event)
        self.resized += 1
        self.updateGeometry()


def test_a_frame_needs_what_its_panel_needs_up_to_the_room_and_scrolls_the_rest(qtbot):
    panel = QWidget()
    panel.setMinimumSize(300, 3000)
    frame = PanelFrame(panel, QSize(500, 200))
    qtbot.addWidget(frame)
    assert frame.minimumSizeHint() == QSize(300, 200)
    frame.give_room(QSize(250, 100))
    assert frame.minimumSizeHint() == QSize(250, 100)
    frame.resize(320, 400)
    frame.show()
    bar = frame.verticalScrollBar().sizeHint().width()
    assert panel.size() == QSize(320 - bar, 3000)
    assert frame.verticalScrollBar().maximum() == 2600
    assert frame_of(panel) is frame
    assert frame_of(frame.parentWidget() or panel) is frame


def test_a_frame_comes_to_rest_with_a_panel_whose_needs_depend_on_its_size(qtbot):
    panel = Fickle()
    frame = PanelFrame(panel, QSize(500, 200))
    qtbot.addWidget(frame)
    frame.resize(300, 205)
    frame.show()
    for _ in range(10):
        QApplication.processEvents()
    resized = panel.resized
    for _ in range(10):
        QApplication.processEvents()
    assert panel.resized == resized
    assert frame.horizontalScrollBar().isVisible()

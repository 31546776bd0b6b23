"""Rows, columns and grids: order, spacing and stretch of their parts."""

from PySide6.QtWidgets import QLabel, QWidget

from rotemina.app.widgets.layout import (
    make_column,
    make_grid,
    make_row,
)


def test_parts_have_their_order_and_stretch(qtbot):
    box, first, second = QWidget(), QLabel(), QLabel()
    qtbot.addWidget(box)
    row = make_row(first, 0, (second, 2), spacing=3)
    column = make_column(row, 1, on=box, margins=(1, 2, 3, 4), spacing=5)
    assert box.layout() is column
    assert [row.itemAt(index).widget() for index in range(3)] == [first, None, second]
    assert [row.stretch(index) for index in range(3)] == [0, 0, 2]
    assert (row.spacing(), column.spacing(), column.stretch(1)) == (3, 5, 1)
    margins = column.contentsMargins()
    assert (margins.left(), margins.top(), margins.right(), margins.bottom()) == (1, 2, 3, 4)
    assert first.parentWidget() is box


def test_a_grid_has_the_spacing_of_the_style_by_default(qtbot):
    box, other = QWidget(), QWidget()
    for widget in (box, other):
        qtbot.addWidget(widget)
    own = make_grid(on=box, margins=0, spacing=(7, -1), stretched=(0, 2))
    styled = make_grid(on=other)
    assert box.layout() is own
    assert own.horizontalSpacing() == 7
    assert own.verticalSpacing() == styled.verticalSpacing()
    assert [own.columnStretch(column) for column in range(3)] == [1, 0, 1]
    assert own.contentsMargins().left() == 0

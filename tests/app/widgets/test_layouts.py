"""Rows, columns and grids: what stands where, how far apart, and what stretches."""

from PySide6.QtWidgets import QLabel, QWidget

from rotemina.app.widgets.layouts import in_column, in_grid, in_row


def test_parts_stand_in_order_with_their_stretches(qtbot):
    box, first, second = QWidget(), QLabel(), QLabel()
    qtbot.addWidget(box)
    row = in_row(first, 0, (second, 2), spacing=3)
    column = in_column(row, 1, on=box, margins=(1, 2, 3, 4), spacing=5)
    assert box.layout() is column
    assert [row.itemAt(place).widget() for place in range(3)] == [first, None, second]
    assert [row.stretch(place) for place in range(3)] == [0, 0, 2]
    assert (row.spacing(), column.spacing(), column.stretch(1)) == (3, 5, 1)
    margins = column.contentsMargins()
    assert (margins.left(), margins.top(), margins.right(), margins.bottom()) == (1, 2, 3, 4)
    assert first.parentWidget() is box


def test_a_grid_has_the_spacing_of_the_style_where_none_is_given(qtbot):
    box, other = QWidget(), QWidget()
    for widget in (box, other):
        qtbot.addWidget(widget)
    own = in_grid(on=box, margins=0, spacing=(7, -1), stretched=(0, 2))
    styled = in_grid(on=other)
    assert box.layout() is own
    assert own.horizontalSpacing() == 7
    assert own.verticalSpacing() == styled.verticalSpacing()
    assert [own.columnStretch(column) for column in range(3)] == [1, 0, 1]
    assert own.contentsMargins().left() == 0

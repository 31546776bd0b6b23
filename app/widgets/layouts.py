"""Rows, columns and grids of widgets, each made in one call."""

from typing import TypeVar

from PySide6.QtWidgets import QBoxLayout, QGridLayout, QHBoxLayout, QLayout, QVBoxLayout, QWidget

Part = QWidget | QLayout | tuple[QWidget | QLayout, int] | int
Margins = tuple[int, int, int, int] | int
_Box = TypeVar("_Box", bound=QBoxLayout)


def keep_room(*widgets: QWidget) -> None:
    """Leave the room of widgets empty while they are hidden, so that nothing else moves."""
    for widget in widgets:
        policy = widget.sizePolicy()
        policy.setRetainSizeWhenHidden(True)
        widget.setSizePolicy(policy)


def in_row(
    *parts: Part,
    on: QWidget | None = None,
    margins: Margins | None = None,
    spacing: int | None = None,
) -> QHBoxLayout:
    """Lay parts out side by side, ``on`` a widget where one is given; return the layout.

    A part is a widget or a layout, alone or with its stretch; a number is room that stretches so
    much. ``margins`` (left, top, right, bottom, or one for all) and ``spacing`` are in pixels, by
    default those of the style.
    """
    return _filled(QHBoxLayout(), parts, on, margins, spacing)


def in_column(
    *parts: Part,
    on: QWidget | None = None,
    margins: Margins | None = None,
    spacing: int | None = None,
) -> QVBoxLayout:
    """Lay parts out one below the other, else as :func:`in_row`."""
    return _filled(QVBoxLayout(), parts, on, margins, spacing)


def in_grid(
    *,
    on: QWidget | None = None,
    margins: Margins | None = None,
    spacing: int | tuple[int, int] | None = None,
    stretched: int | tuple[int, ...] = (),
) -> QGridLayout:
    """Return an empty grid, ``on`` a widget where one is given.

    ``spacing`` is between columns and between rows, or one for both; -1 is that of the style. The
    columns that are ``stretched`` share what room is left.
    """
    grid = QGridLayout()
    _place(grid, on, margins)
    if spacing is not None:
        across, down = spacing if isinstance(spacing, tuple) else (spacing, spacing)
        grid.setHorizontalSpacing(across)
        grid.setVerticalSpacing(down)
    for column in stretched if isinstance(stretched, tuple) else (stretched,):
        grid.setColumnStretch(column, 1)
    return grid


def _filled(
    box: _Box,
    parts: tuple[Part, ...],
    on: QWidget | None,
    margins: Margins | None,
    spacing: int | None,
) -> _Box:
    _place(box, on, margins)
    if spacing is not None:
        box.setSpacing(spacing)
    for part in parts:
        if isinstance(part, int):
            box.addStretch(part)
            continue
        item, stretch = part if isinstance(part, tuple) else (part, 0)
        if isinstance(item, QWidget):
            box.addWidget(item, stretch)
        else:
            box.addLayout(item, stretch)
    return box


def _place(layout: QLayout, on: QWidget | None, margins: Margins | None) -> None:
    if on is not None:
        on.setLayout(layout)
    if margins is not None:
        layout.setContentsMargins(*((margins,) * 4 if isinstance(margins, int) else margins))

"""Rows, columns and grids of widgets, each created by one call."""

from typing import TYPE_CHECKING, TypeVar

from PySide6.QtWidgets import QBoxLayout, QGridLayout, QHBoxLayout, QLayout, QVBoxLayout, QWidget

from rotemina.sim.compatibility import serve_former_names

LayoutPart = QWidget | QLayout | tuple[QWidget | QLayout, int] | int
Margins = tuple[int, int, int, int] | int
_Box = TypeVar("_Box", bound=QBoxLayout)


def keep_room_when_hidden(*widgets: QWidget) -> None:
    """Keep the space of widgets empty while they are hidden, so that nothing else moves."""
    for widget in widgets:
        policy = widget.sizePolicy()
        policy.setRetainSizeWhenHidden(True)
        widget.setSizePolicy(policy)


def make_row(
    *parts: LayoutPart,
    on: QWidget | None = None,
    margins: Margins | None = None,
    spacing: int | None = None,
) -> QHBoxLayout:
    """Place parts side by side, on the widget ``on`` if given; return the layout.

    A part is a widget or a layout, alone or in a tuple with its stretch factor. A number is empty
    space with that stretch factor. ``margins`` (left, top, right, bottom, or one for all) and
    ``spacing`` are in px, by default those of the style.
    """
    return _fill_box(QHBoxLayout(), parts, on, margins, spacing)


def make_column(
    *parts: LayoutPart,
    on: QWidget | None = None,
    margins: Margins | None = None,
    spacing: int | None = None,
) -> QVBoxLayout:
    """Place parts below each other; otherwise like :func:`make_row`."""
    return _fill_box(QVBoxLayout(), parts, on, margins, spacing)


def make_grid(
    *,
    on: QWidget | None = None,
    margins: Margins | None = None,
    spacing: int | tuple[int, int] | None = None,
    stretched: int | tuple[int, ...] = (),
) -> QGridLayout:
    """Return an empty grid, on the widget ``on`` if given.

    ``spacing`` is the space between columns and between rows, or one value for both, in px; -1
    stands for the default of the style.
    The columns in ``stretched`` share the remaining space.
    """
    grid = QGridLayout()
    _set_up_layout(grid, on, margins)
    if spacing is not None:
        horizontal, vertical = spacing if isinstance(spacing, tuple) else (spacing, spacing)
        grid.setHorizontalSpacing(horizontal)
        grid.setVerticalSpacing(vertical)
    for column in stretched if isinstance(stretched, tuple) else (stretched,):
        grid.setColumnStretch(column, 1)
    return grid


def _fill_box(
    box: _Box,
    parts: tuple[LayoutPart, ...],
    on: QWidget | None,
    margins: Margins | None,
    spacing: int | None,
) -> _Box:
    _set_up_layout(box, on, margins)
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


def _set_up_layout(layout: QLayout, on: QWidget | None, margins: Margins | None) -> None:
    if on is not None:
        on.setLayout(layout)
    if margins is not None:
        layout.setContentsMargins(*((margins,) * 4 if isinstance(margins, int) else margins))


if not TYPE_CHECKING:
    __getattr__ = serve_former_names(
        __name__,
        Part="LayoutPart",
        in_column="make_column",
        in_grid="make_grid",
        in_row="make_row",
        keep_room="keep_room_when_hidden",
    )

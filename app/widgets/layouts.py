"""Rows and columns of widgets, each laid out in one call."""

from typing import TypeVar

from PySide6.QtWidgets import QBoxLayout, QHBoxLayout, QLayout, QVBoxLayout, QWidget

Part = QWidget | QLayout | tuple[QWidget | QLayout, int] | int
Margins = tuple[int, int, int, int] | int
_Box = TypeVar("_Box", bound=QBoxLayout)


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


def _filled(
    box: _Box,
    parts: tuple[Part, ...],
    on: QWidget | None,
    margins: Margins | None,
    spacing: int | None,
) -> _Box:
    if on is not None:
        on.setLayout(box)
    if margins is not None:
        box.setContentsMargins(*((margins,) * 4 if isinstance(margins, int) else margins))
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

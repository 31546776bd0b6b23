"""Export of the plots as pictures."""

from pathlib import Path

from PySide6.QtCore import QBuffer, QPoint, QSize
from PySide6.QtGui import QPainter
from PySide6.QtSvg import QSvgGenerator
from PySide6.QtWidgets import QWidget

from rotemina.app.settings import write_text
from rotemina.plugins.plots import tr
from rotemina.sim.errors import FileWriteError


def save_picture(widget: QWidget, path: Path) -> None:
    """Save a picture of a widget: vector graphics for ``.svg``, otherwise pixels (``.png``).

    Raises
    ------
    FileWriteError
        If the file cannot be written.
    """
    if path.suffix.lower() == ".svg":
        _save_svg(widget, path)
    elif not widget.grab().save(str(path)):
        raise FileWriteError(
            f"{path}: the picture cannot be written; choose another folder, or .png or .svg"
        )


def _save_svg(widget: QWidget, path: Path) -> None:
    buffer = QBuffer()
    buffer.open(QBuffer.OpenModeFlag.WriteOnly)
    generator = QSvgGenerator()
    generator.setOutputDevice(buffer)
    generator.setSize(QSize(widget.width(), widget.height()))
    generator.setViewBox(widget.rect())
    generator.setTitle(tr("Plots of the axes"))
    painter = QPainter(generator)
    widget.render(painter, QPoint())
    painter.end()
    write_text(path, buffer.data().toStdString())

"""The application object of Qt, and the splash screen that shows while the window is built."""

from importlib import resources

from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import QColor, QIcon, QImage, QPainter, QPixmap
from PySide6.QtWidgets import QApplication, QLabel

SIZE = QSize(360, 140)
_GROUND, _TEXT = "#14171c", "#e8ebf0"  # of the icon


def make_application() -> QApplication:
    """Return the one application object, made if there is none."""
    # A dialog of the desktop's own would take Esc for itself, and nothing would stop.
    QApplication.setAttribute(Qt.ApplicationAttribute.AA_DontUseNativeDialogs)
    application = QApplication.instance() or QApplication(["rotemina"])
    assert isinstance(application, QApplication)
    application.setApplicationName("RoTeMiNa")
    application.setWindowIcon(QIcon(_icon()))
    return application


def show_splash() -> QLabel:
    """Show the program's icon and name at once: modules are loaded for a second or two from now on.

    ``close()`` takes it away when the window is there. It is no ``QSplashScreen``: to show one
    waits a second (Qt 6.11), for which nothing would be loaded.
    """
    application = make_application()
    ratio = application.primaryScreen().devicePixelRatio()
    picture = QPixmap(SIZE * ratio)
    picture.setDevicePixelRatio(ratio)
    picture.fill(QColor(_GROUND))
    painter = QPainter(picture)
    painter.drawPixmap(QRectF(26, 30, 80, 80), _icon(), QRectF(_icon().rect()))
    font = application.font()
    font.setPointSizeF(2.2 * font.pointSizeF())
    painter.setFont(font)
    painter.setPen(QColor(_TEXT))
    painter.drawText(QRectF(130, 0, 220, 140), Qt.AlignmentFlag.AlignVCenter, "RoTeMiNa")
    painter.end()
    splash = QLabel()
    splash.setWindowFlags(Qt.WindowType.SplashScreen | Qt.WindowType.FramelessWindowHint)
    splash.setPixmap(picture)
    splash.resize(SIZE)
    splash.move(application.primaryScreen().geometry().center() - splash.rect().center())
    splash.show()
    application.processEvents()
    return splash


def _icon() -> QPixmap:
    icon = resources.files("rotemina.resources.icons").joinpath("rotemina.svg").read_bytes()
    return QPixmap.fromImage(QImage.fromData(icon))

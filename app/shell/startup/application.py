"""The Qt application object, and the splash screen shown while the window is built."""

from importlib import resources

from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import QColor, QIcon, QImage, QPainter, QPixmap
from PySide6.QtWidgets import QApplication, QLabel

SPLASH_SIZE = QSize(360, 140)
# The colours of the program's icon.
_BACKGROUND_COLOUR, _TEXT_COLOUR = "#14171c", "#e8ebf0"


def make_application() -> QApplication:
    """Return the application object; create it if there is none."""
    # A native dialog would consume Esc, so that Esc would not stop the machine.
    QApplication.setAttribute(Qt.ApplicationAttribute.AA_DontUseNativeDialogs)
    application = QApplication.instance() or QApplication(["rotemina"])
    assert isinstance(application, QApplication)
    application.setApplicationName("RoTeMiNa")
    application.setWindowIcon(QIcon(_load_icon()))
    return application


def show_splash() -> QLabel:
    """Show the program's icon and name while its modules are loaded, which takes a second or two.

    Close the returned label once the window is shown. A ``QSplashScreen`` is not used because it
    blocks for a second when it is shown (Qt 6.11), during which nothing could be loaded.
    """
    application = make_application()
    pixel_ratio = application.primaryScreen().devicePixelRatio()
    picture = QPixmap(SPLASH_SIZE * pixel_ratio)
    picture.setDevicePixelRatio(pixel_ratio)
    picture.fill(QColor(_BACKGROUND_COLOUR))
    painter = QPainter(picture)
    painter.drawPixmap(QRectF(26, 30, 80, 80), _load_icon(), QRectF(_load_icon().rect()))
    font = application.font()
    font.setPointSizeF(2.2 * font.pointSizeF())
    painter.setFont(font)
    painter.setPen(QColor(_TEXT_COLOUR))
    painter.drawText(QRectF(130, 0, 220, 140), Qt.AlignmentFlag.AlignVCenter, "RoTeMiNa")
    painter.end()
    splash = QLabel()
    splash.setWindowFlags(Qt.WindowType.SplashScreen | Qt.WindowType.FramelessWindowHint)
    splash.setPixmap(picture)
    splash.resize(SPLASH_SIZE)
    splash.move(application.primaryScreen().geometry().center() - splash.rect().center())
    splash.show()
    application.processEvents()
    return splash


def _load_icon() -> QPixmap:
    icon = resources.files("rotemina.resources.icons").joinpath("rotemina.svg").read_bytes()
    return QPixmap.fromImage(QImage.fromData(icon))

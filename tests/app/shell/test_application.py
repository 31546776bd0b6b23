"""The splash screen is there at once, in the middle of the screen."""

from PySide6.QtCore import Qt

from rotemina.app.shell.application import make_application, show_splash


def test_the_splash_shows_icon_and_name(qtbot):
    splash = show_splash()
    qtbot.addWidget(splash)
    assert splash.isVisible()
    assert not splash.testAttribute(Qt.WidgetAttribute.WA_QuitOnClose)  # it keeps no program open
    picture = splash.pixmap().toImage()
    ratio = picture.devicePixelRatio()

    def colours(left, right):
        columns = range(round(left * ratio), round(right * ratio))
        return {picture.pixel(x, y) for x in columns for y in range(picture.height())}

    assert len(colours(26, 106)) > 20  # the icon
    assert len(colours(130, 350)) > 20  # the name
    assert len(colours(0, 20)) == 1
    screen = splash.screen().geometry()
    assert (splash.geometry().center() - screen.center()).manhattanLength() <= 2


def test_there_is_one_application():
    assert make_application() is make_application()

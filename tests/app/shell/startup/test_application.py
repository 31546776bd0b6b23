"""The splash screen appears at once in the middle of the screen."""

from PySide6.QtCore import Qt

from rotemina.app.shell.startup.application import show_splash


def test_splash_shows_icon_and_name(qtbot):
    splash = show_splash()
    qtbot.addWidget(splash)
    assert splash.isVisible()
    # It does not keep the program open.
    assert not splash.testAttribute(Qt.WidgetAttribute.WA_QuitOnClose)
    picture = splash.pixmap().toImage()
    ratio = picture.devicePixelRatio()

    def find_colours(left, right):
        columns = range(round(left * ratio), round(right * ratio))
        return {picture.pixel(x, y) for x in columns for y in range(picture.height())}

    assert len(find_colours(26, 106)) > 20  # the icon
    assert len(find_colours(130, 350)) > 20  # the name
    assert len(find_colours(0, 20)) == 1
    screen = splash.screen().geometry()
    assert (splash.geometry().center() - screen.center()).manhattanLength() <= 2

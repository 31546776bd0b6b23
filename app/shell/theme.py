"""Colour roles of the window and its style sheet."""

import re
from dataclasses import dataclass
from importlib import resources
from string import Template

from PySide6.QtGui import QColor, QPalette
from PySide6.QtWidgets import QApplication, QWidget


@dataclass(frozen=True, slots=True)
class Theme:
    """Colours by role, as ``#rrggbb``; signals are told apart in grey and by colour-blind eyes.

    ``window``, ``surface`` and ``raised`` are grounds, and so are ``accent``, ``danger`` and
    ``warning`` for what stands on them.
    """

    name: str
    window: str
    surface: str
    raised: str
    line: str
    text: str
    quiet: str
    accent: str
    on_accent: str
    danger: str
    on_danger: str
    danger_text: str
    warning: str
    good: str
    command: str
    model: str
    real: str
    other: str
    virtual: str
    on_virtual: str


_COLOURS = {  # by role: dark, light, of high contrast
    "window": ("#15181d", "#eceff3", "#000000"),
    "surface": ("#1c2027", "#ffffff", "#000000"),
    "raised": ("#272d37", "#f3f5f8", "#1c1c1c"),
    "line": ("#3a4250", "#c3cad4", "#9a9a9a"),
    "text": ("#e8ebf0", "#1b2129", "#ffffff"),
    "quiet": ("#a3adbb", "#566070", "#bdbdbd"),
    "accent": ("#4c9be8", "#1f66b0", "#ffd633"),
    "on_accent": ("#08131f", "#ffffff", "#000000"),
    "danger": ("#d93a3a", "#c62828", "#ff5c5c"),
    "on_danger": ("#ffffff", "#ffffff", "#000000"),
    "danger_text": ("#ff8a80", "#b71c1c", "#ff9e9e"),
    "warning": ("#e6b450", "#8a5a00", "#ffb54d"),
    "good": ("#5fbf7f", "#1f7a43", "#5cff94"),
    "command": ("#8b95a5", "#5c6675", "#c8c8c8"),
    "model": ("#4c9be8", "#1f66b0", "#66bfff"),
    "real": ("#f0a35e", "#a64b08", "#ffa04d"),
    "other": ("#e58fc8", "#9c2c7d", "#ff9be0"),
    "virtual": ("#b795ff", "#6a3fc4", "#cbb0ff"),
    "on_virtual": ("#140a29", "#ffffff", "#000000"),
}
DARK, LIGHT, HIGH_CONTRAST = (
    Theme(name, *colours)
    for name, colours in zip(
        ("dark", "light", "contrast"), zip(*_COLOURS.values(), strict=True), strict=True
    )
)
THEMES = {theme.name: theme for theme in (DARK, LIGHT, HIGH_CONTRAST)}
#: Sizes of text to choose from; 1.0 suits a screen of 1080 lines.
SCALES = (0.9, 1.0, 1.15, 1.3, 1.5, 1.75, 2.0)
_TALL = ((2000, 1.5), (1400, 1.15))  # lines of a screen from which on text grows by itself
_LENGTH = re.compile(r"\b(\d+)px\b")


def theme_named(name: str) -> Theme:
    """Return a theme by name, the dark one where the name is unknown."""
    return THEMES.get(name, DARK)


def scale_for(lines: int) -> float:
    """Return the size of text that suits a screen of so many lines (logical pixels).

    Qt has divided them by the system's own scaling already: a screen of 4K at 200 % has 1080.
    """
    return next((scale for least, scale in _TALL if lines >= least), 1.0)


def prepare(application: QApplication, theme: Theme) -> None:
    """Give the whole application the theme's palette."""
    if application.style().objectName() != "fusion":
        application.setStyle("Fusion")
    application.setPalette(_palette(theme))


def dress(window: QWidget, theme: Theme, scale: float = 1.0) -> None:
    """Give a window, and with it all that it opens, a theme at a size of text.

    The style sheet is a window's, not the application's: under one of the application each part of
    a panel, from the smallest up, would be styled anew at every widget that it is put into.
    """
    application = QApplication.instance()
    assert isinstance(application, QApplication)
    sheet = style_sheet(theme, scale)
    if window.styleSheet() == sheet:
        return
    window.setStyleSheet("")  # first: Qt 6.11 takes a fifth of the time to change it then
    prepare(application, theme)
    window.setStyleSheet(sheet)


def style_sheet(theme: Theme, scale: float = 1.0) -> str:
    """Return the style sheet in a theme's colours; its lengths grow with the text, lines do not."""
    sheet = resources.files("rotemina.resources.theme").joinpath("window.qss").read_text("utf-8")
    roles = {name: getattr(theme, name) for name in Theme.__slots__}
    return _LENGTH.sub(
        lambda found: f"{_scaled(int(found[1]), scale)}px", Template(sheet).substitute(roles)
    )


def _scaled(length: int, scale: float) -> int:
    return length if length <= 2 else round(scale * length)


def _palette(theme: Theme) -> QPalette:
    role = QPalette.ColorRole
    colours = {
        role.Window: theme.window,
        role.Base: theme.surface,
        role.AlternateBase: theme.raised,
        role.Button: theme.raised,
        role.ToolTipBase: theme.raised,
        role.Text: theme.text,
        role.WindowText: theme.text,
        role.ButtonText: theme.text,
        role.ToolTipText: theme.text,
        role.PlaceholderText: theme.quiet,
        role.Highlight: theme.accent,
        role.Link: theme.accent,
        role.LinkVisited: theme.accent,
        role.HighlightedText: theme.on_accent,
        role.Mid: theme.line,
    }
    palette = QPalette()
    for key, colour in colours.items():
        palette.setColor(key, QColor(colour))
    for key in (role.Text, role.WindowText, role.ButtonText):
        palette.setColor(QPalette.ColorGroup.Disabled, key, QColor(theme.quiet))
    return palette

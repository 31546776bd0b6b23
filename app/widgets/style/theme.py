"""Colours of the window by role, and its style sheet."""

import re
from dataclasses import dataclass
from importlib import resources
from string import Template

from PySide6.QtGui import QColor, QPalette
from PySide6.QtWidgets import QApplication, QWidget


@dataclass(frozen=True, slots=True)
class Theme:
    """Colours by role, as ``#rrggbb``.

    Signals can be distinguished in greyscale and by colour-blind users. ``window``, ``surface`` and
    ``raised`` are backgrounds. ``accent``, ``danger`` and ``warning`` also serve as backgrounds.
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


# Colours of the dark, light and high-contrast theme by role.
_COLOURS_BY_ROLE = {
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
        ("dark", "light", "contrast"), zip(*_COLOURS_BY_ROLE.values(), strict=True), strict=True
    )
)
THEMES = {theme.name: theme for theme in (DARK, LIGHT, HIGH_CONTRAST)}
#: Text sizes to choose from. 1.0 suits a screen of 1080 lines.
TEXT_SCALES = (0.9, 1.0, 1.15, 1.3, 1.5, 1.75, 2.0)
# Smallest number of screen lines for each automatic enlargement of the text.
_AUTOMATIC_SCALES = ((2000, 1.5), (1400, 1.15))
_PIXEL_LENGTH = re.compile(r"\b(\d+)px\b")


def find_theme(name: str) -> Theme:
    """Return the theme of this name, or the dark one if the name is unknown."""
    return THEMES.get(name, DARK)


def find_text_scale(lines: int) -> float:
    """Return the text size for a screen with this many lines (logical pixels).

    Qt has already applied the system's scaling: a 4K screen at 200 % has 1080 lines.
    """
    return next((scale for min_lines, scale in _AUTOMATIC_SCALES if lines >= min_lines), 1.0)


def apply_palette(application: QApplication, theme: Theme) -> None:
    """Set the palette of the whole application to that of a theme."""
    if application.style().objectName() != "fusion":
        application.setStyle("Fusion")
    application.setPalette(_make_palette(theme))


def apply_theme(window: QWidget, theme: Theme, scale: float = 1.0) -> None:
    """Apply a theme and a text size to a window and all that it opens.

    The style sheet belongs to the window and not to the application. With an application style
    sheet, Qt would style every part of a panel again each time it is added to a widget.
    """
    application = QApplication.instance()
    assert isinstance(application, QApplication)
    sheet = make_style_sheet(theme, scale)
    if window.styleSheet() == sheet:
        return
    # Clearing it first makes the change five times as fast (Qt 6.11).
    window.setStyleSheet("")
    apply_palette(application, theme)
    window.setStyleSheet(sheet)


def make_style_sheet(theme: Theme, scale: float = 1.0) -> str:
    """Return the style sheet of a theme; its lengths grow with the text, but line widths do not."""
    sheet = resources.files("rotemina.resources.theme").joinpath("window.qss").read_text("utf-8")
    roles = {name: getattr(theme, name) for name in Theme.__slots__}
    return _PIXEL_LENGTH.sub(
        lambda match: f"{_scale_length(int(match[1]), scale)}px", Template(sheet).substitute(roles)
    )


def _scale_length(length: int, scale: float) -> int:
    return length if length <= 2 else round(scale * length)


def _make_palette(theme: Theme) -> QPalette:
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
    for palette_role, colour in colours.items():
        palette.setColor(palette_role, QColor(colour))
    for palette_role in (role.Text, role.WindowText, role.ButtonText):
        palette.setColor(QPalette.ColorGroup.Disabled, palette_role, QColor(theme.quiet))
    return palette

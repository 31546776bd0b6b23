"""Colour roles of the window and its style sheet."""

from dataclasses import dataclass
from importlib import resources
from string import Template

from PySide6.QtGui import QColor, QPalette
from PySide6.QtWidgets import QApplication


@dataclass(frozen=True, slots=True)
class Theme:
    """Colours by role, as ``#rrggbb``; signals are told apart in grey and by colour-blind eyes."""

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


DARK = Theme(
    name="dark",
    window="#15181d",
    surface="#1c2027",
    raised="#272d37",
    line="#3a4250",
    text="#e8ebf0",
    quiet="#a3adbb",
    accent="#4c9be8",
    on_accent="#08131f",
    danger="#d93a3a",
    on_danger="#ffffff",
    danger_text="#ff8a80",
    warning="#e6b450",
    good="#5fbf7f",
    command="#8b95a5",
    model="#4c9be8",
    real="#f0a35e",
)
LIGHT = Theme(
    name="light",
    window="#eceff3",
    surface="#ffffff",
    raised="#f3f5f8",
    line="#c3cad4",
    text="#1b2129",
    quiet="#566070",
    accent="#1f66b0",
    on_accent="#ffffff",
    danger="#c62828",
    on_danger="#ffffff",
    danger_text="#b71c1c",
    warning="#8a5a00",
    good="#1f7a43",
    command="#7b8594",
    model="#1f66b0",
    real="#c05a12",
)
THEMES = {theme.name: theme for theme in (DARK, LIGHT)}


def theme_named(name: str) -> Theme:
    """Return a theme by name, the dark one where the name is unknown."""
    return THEMES.get(name, DARK)


def apply(application: QApplication, theme: Theme) -> None:
    """Give the whole application the theme's palette and style sheet."""
    application.setStyle("Fusion")
    application.setPalette(_palette(theme))
    sheet = resources.files("rotemina.resources.theme").joinpath("window.qss").read_text("utf-8")
    roles = {name: getattr(theme, name) for name in Theme.__slots__}
    application.setStyleSheet(Template(sheet).substitute(roles))


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
        role.HighlightedText: theme.on_accent,
        role.Mid: theme.line,
    }
    palette = QPalette()
    for key, colour in colours.items():
        palette.setColor(key, QColor(colour))
    for key in (role.Text, role.WindowText, role.ButtonText):
        palette.setColor(QPalette.ColorGroup.Disabled, key, QColor(theme.quiet))
    return palette

"""What the command palette offers: the window's commands, its panels, and their buttons."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass

from PySide6.QtWidgets import (
    QAbstractButton,
    QDockWidget,
    QPushButton,
    QStackedWidget,
    QTabWidget,
    QToolButton,
    QWidget,
)

from rotemina.app.panel import Panel
from rotemina.app.shell.commands import Command
from rotemina.app.shell.engine_words import spoken
from rotemina.app.shell.language import translate
from rotemina.app.widgets.controls import why_not

_SIGNS = "✕…▾▴●■± "  # what ends or begins the text of a button without being a word


@dataclass(frozen=True, slots=True)
class Entry:
    """One thing that can be done.

    Attributes
    ----------
    where : menu or panel
    what : what it does
    shortcut : "" where there is none
    why_not : why it cannot be done now, or None
    run : does it
    """

    where: str
    what: str
    shortcut: str
    why_not: str | None
    run: Callable[[], object]

    @property
    def text(self) -> str:
        """All that is searched."""
        return f"{self.where}: {self.what}"


def command_entries(commands: Iterable[Command]) -> Iterator[Entry]:
    """Yield an entry for each command of the menus."""
    for command in commands:
        where, what = command.menu.replace("&", ""), command.text.replace("&", "")
        reason = command.why_not()
        yield Entry(
            where, what, command.shortcut, None if reason is None else spoken(reason), command.run
        )


def panel_entries(
    panels: Mapping[str, Panel], docks: Mapping[str, QDockWidget], show: Callable[[str], object]
) -> Iterator[Entry]:
    """Yield an entry that shows each panel, and one for each of its buttons.

    Only buttons that act when they are clicked: one that must be held down (``held``) is left out.
    """
    for name, panel in panels.items():
        title = docks[name].windowTitle() if name in docks else translate("panels", panel.title)
        yield Entry(translate("shell", "Panel"), title, "", None, lambda name=name: show(name))
        for button in _buttons(panel):
            yield Entry(
                title,
                _words(button),
                button.shortcut().toString(),
                _why_not(button),
                lambda name=name, button=button: _press(name, button, show),
            )


def _press(name: str, button: QAbstractButton, show: Callable[[str], object]) -> None:
    show(name)
    _bring_up(button)
    button.click()


def _bring_up(widget: QWidget) -> None:
    """Show the tab that a widget is on, and the one that this is on."""
    child, parent = widget, widget.parentWidget()
    while parent is not None:
        if isinstance(parent, QStackedWidget) and isinstance(parent.parentWidget(), QTabWidget):
            parent.parentWidget().setCurrentWidget(child)
        child, parent = parent, parent.parentWidget()


def _buttons(panel: QWidget) -> Iterator[QAbstractButton]:
    for button in panel.findChildren(QAbstractButton):
        kind = isinstance(button, QPushButton | QToolButton)
        # What opens a menu would wait until that is closed, and the menu wants a mouse.
        plain = kind and button.menu() is None and not button.property("held")
        if plain and _words(button) and _offered(button, panel):
            yield button


def _offered(widget: QWidget, panel: QWidget) -> bool:
    """Whether a button is there for the operator; behind another tab counts."""
    child: QWidget | None = widget
    while child is not None and child is not panel:
        parent = child.parentWidget()
        in_tabs = isinstance(parent, QStackedWidget) and isinstance(
            parent.parentWidget(), QTabWidget
        )
        if child.isHidden() and not in_tabs:
            return False
        child = parent
    return True


def _words(button: QAbstractButton) -> str:
    """Return what a button does: what it is called for those who cannot see it, else its text."""
    return button.accessibleName() or button.text().replace("&", "").strip(_SIGNS)


def _why_not(button: QAbstractButton) -> str | None:
    if button.isEnabled():
        return None
    reason = why_not(button)
    return spoken(reason) if reason else translate("shell", "its panel does not permit it now")

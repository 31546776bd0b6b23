"""What the command palette offers: the window's commands, its panels, and buttons of these."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import partial

from PySide6.QtWidgets import (
    QAbstractButton,
    QDockWidget,
    QPushButton,
    QStackedWidget,
    QTabWidget,
    QToolButton,
    QWidget,
)

from rotemina.app.panel import PaletteOffer, Panel, palette_offer
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
    is_panel : whether it shows a panel
    opens : title of the panel that it shows instead, "" where it acts
    """

    where: str
    what: str
    shortcut: str
    why_not: str | None
    run: Callable[[], object]
    is_panel: bool = False
    opens: str = ""

    @property
    def text(self) -> str:
        """All that is searched."""
        return f"{self.where}: {self.what}"


@dataclass(frozen=True, slots=True)
class PanelGuard:
    """Lets the palette move or switch something only while its panel is visible.

    Attributes
    ----------
    panels, docks : by name; a central panel has no dock
    show : shows a panel by its name
    notify : tells the operator something
    """

    panels: Mapping[str, Panel]
    docks: Mapping[str, QDockWidget]
    show: Callable[[str], object]
    notify: Callable[[str], object]

    def title(self, name: str) -> str:
        """Return the title of a panel, in the window's language."""
        if name in self.docks:
            return self.docks[name].windowTitle()
        return translate("panels", self.panels[name].title) if name in self.panels else name

    def hidden_panel(self, name: str, button: QWidget | None = None) -> str:
        """Return the title of a panel that is hidden, or whose button is; "" if it is visible."""
        panel = self.panels.get(name)
        visible = (
            panel is not None
            and panel.isVisible()
            and not panel.visibleRegion().isEmpty()  # behind another dock it is empty
            and (button is None or button.isVisible())
        )
        return "" if visible else self.title(name)

    def run(
        self, name: str, what: str, act: Callable[[], object], button: QWidget | None = None
    ) -> None:
        """Act while a panel is visible; otherwise show it, with its button, and say so."""
        hidden = self.hidden_panel(name, button)
        if not hidden:
            act()
            return
        self.show(name)
        if button is not None:
            _bring_up(button)
        text = translate(
            "shell",
            "{what}: not run, because it may move or switch something and {panel} was hidden."
            " {panel} is open now. Check it, then run the command again.",
        )
        self.notify(text.format(what=what, panel=hidden))


def command_entries(commands: Iterable[Command], guard: PanelGuard) -> Iterator[Entry]:
    """Yield an entry for each command of the menus."""
    for command in commands:
        where, what = command.menu.replace("&", ""), command.text.replace("&", "")
        reason, run, opens = command.why_not(), command.run, ""
        if command.panel and command.panel not in guard.panels:
            reason = translate("shell", "its panel is missing; use the menu")
        elif command.panel:
            run = partial(guard.run, command.panel, what, command.run)
            opens = guard.hidden_panel(command.panel)
        why = None if reason is None else spoken(reason)
        yield Entry(where, what, command.shortcut, why, run, opens=opens)


def panel_entries(guard: PanelGuard) -> Iterator[Entry]:
    """Yield an entry that shows each panel, and one for each button that it offers.

    Only buttons that act when they are clicked: one that must be held down (``held``) is left out.
    """
    for name, panel in guard.panels.items():
        title = guard.title(name)
        yield Entry(
            translate("shell", "Panel"), title, "", None, partial(guard.show, name), is_panel=True
        )
        for button, offer in _offered_buttons(panel):
            guarded = offer is PaletteOffer.WHILE_VISIBLE
            press = partial(_press, name, button, guard.show)
            yield Entry(
                title,
                _words(button),
                button.shortcut().toString(),
                _why_not(button),
                partial(guard.run, name, _words(button), press, button) if guarded else press,
                opens=guard.hidden_panel(name, button) if guarded else "",
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


def _offered_buttons(panel: QWidget) -> Iterator[tuple[QAbstractButton, PaletteOffer]]:
    for button in panel.findChildren(QAbstractButton):
        offer = palette_offer(button)
        kind = isinstance(button, QPushButton | QToolButton)
        # What opens a menu would wait until that is closed, and the menu wants a mouse.
        plain = kind and button.menu() is None and not button.property("held")
        if offer is not None and plain and _words(button) and _is_shown(button, panel):
            yield button, offer


def _is_shown(widget: QWidget, panel: QWidget) -> bool:
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
    part: QWidget | None = button
    while part is not None:  # the part of a panel that holds it may be disabled as a whole
        if reason := why_not(part):
            return spoken(reason)
        part = part.parentWidget()
    return translate("shell", "its panel does not permit it now")

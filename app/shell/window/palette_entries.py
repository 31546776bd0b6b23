"""Entries of the command palette: menu commands, panels, and buttons that panels offer."""

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

from rotemina.app.language import translate, translate_message
from rotemina.app.panel import (
    PaletteOffer,
    Panel,
    get_palette_offer,
)
from rotemina.app.shell.window.commands import MenuCommand
from rotemina.app.widgets.controls import get_disabled_reason

# Symbols at the ends of a button's text that are not part of its name.
_DECORATION_CHARS = "✕…▾▴●■± "


@dataclass(frozen=True, slots=True)
class PaletteEntry:
    """One entry of the command palette.

    Attributes
    ----------
    group : str
        Menu or panel.
    title : str
        What the entry does.
    shortcut : str
        "" if there is none.
    why_not : str or None
        Why it cannot run now.
    run : callable
    is_panel : bool
        Whether it shows a panel.
    opens : str
        Title of the panel that it opens instead of running; "" if it runs.
    """

    group: str
    title: str
    shortcut: str
    objection: str | None
    run: Callable[[], object]
    is_panel: bool = False
    opens: str = ""

    @property
    def text(self) -> str:
        """The text that is searched."""
        return f"{self.group}: {self.title}"


@dataclass(frozen=True, slots=True)
class PanelGuard:
    """Guard that lets the palette move or switch something only while its panel is visible.

    Attributes
    ----------
    panels, docks : mapping
        By panel name; a central panel has no dock.
    show : callable
        Shows a panel by its name.
    notify : callable
        Shows a text to the operator.
    """

    panels: Mapping[str, Panel]
    docks: Mapping[str, QDockWidget]
    show: Callable[[str], object]
    notify: Callable[[str], object]

    def find_title(self, name: str) -> str:
        """Return the title of a panel in the window's language."""
        if name in self.docks:
            return self.docks[name].windowTitle()
        return translate("panels", self.panels[name].title) if name in self.panels else name

    def find_hidden_panel(self, name: str, button: QWidget | None = None) -> str:
        """Return the title of a panel if it or its button is hidden, else ""."""
        panel = self.panels.get(name)
        visible = (
            panel is not None
            and panel.isVisible()
            # The visible region is empty behind another tab.
            and not panel.visibleRegion().isEmpty()
            and (button is None or button.isVisible())
        )
        return "" if visible else self.find_title(name)

    def run(
        self, name: str, title: str, action: Callable[[], object], button: QWidget | None = None
    ) -> None:
        """Run an action if its panel is visible; otherwise show the panel and a notice."""
        hidden_title = self.find_hidden_panel(name, button)
        if not hidden_title:
            action()
            return
        self.show(name)
        if button is not None:
            _select_tabs_of(button)
        text = translate(
            "shell",
            "{what}: not run, because it may move or switch something and {panel} was hidden."
            " {panel} is open now. Check it, then run the command again.",
        )
        self.notify(text.format(what=title, panel=hidden_title))


def make_command_entries(
    commands: Iterable[MenuCommand], guard: PanelGuard
) -> Iterator[PaletteEntry]:
    """Yield an entry for each menu command."""
    for command in commands:
        group, title = command.menu.replace("&", ""), command.text.replace("&", "")
        reason, run, opens = command.find_objection(), command.run, ""
        if command.panel and command.panel not in guard.panels:
            reason = translate("shell", "its panel is missing; use the menu")
        elif command.panel:
            run = partial(guard.run, command.panel, title, command.run)
            opens = guard.find_hidden_panel(command.panel)
        why_not = None if reason is None else translate_message(reason)
        yield PaletteEntry(group, title, command.shortcut, why_not, run, opens=opens)


def make_panel_entries(guard: PanelGuard) -> Iterator[PaletteEntry]:
    """Yield an entry that shows each panel, and one for each button that the panel offers.

    A button that must be held down (``held``) is left out.
    """
    for name, panel in guard.panels.items():
        title = guard.find_title(name)
        yield PaletteEntry(
            translate("shell", "Panel"), title, "", None, partial(guard.show, name), is_panel=True
        )
        for button, offer in _find_offered_buttons(panel):
            needs_visible_panel = offer is PaletteOffer.WHILE_VISIBLE
            press = partial(_press_button, name, button, guard.show)
            yield PaletteEntry(
                title,
                _make_button_title(button),
                button.shortcut().toString(),
                _find_reason(button),
                partial(guard.run, name, _make_button_title(button), press, button)
                if needs_visible_panel
                else press,
                opens=guard.find_hidden_panel(name, button) if needs_visible_panel else "",
            )


def _press_button(name: str, button: QAbstractButton, show: Callable[[str], object]) -> None:
    show(name)
    _select_tabs_of(button)
    button.click()


def _select_tabs_of(widget: QWidget) -> None:
    child, parent = widget, widget.parentWidget()
    while parent is not None:
        if isinstance(parent, QStackedWidget) and isinstance(parent.parentWidget(), QTabWidget):
            parent.parentWidget().setCurrentWidget(child)
        child, parent = parent, parent.parentWidget()


def _find_offered_buttons(panel: QWidget) -> Iterator[tuple[QAbstractButton, PaletteOffer]]:
    for button in panel.findChildren(QAbstractButton):
        offer = get_palette_offer(button)
        is_button = isinstance(button, QPushButton | QToolButton)
        # A button that opens a menu blocks until the menu is closed, which needs a mouse.
        is_plain = is_button and button.menu() is None and not button.property("held")
        if (
            offer is not None
            and is_plain
            and _make_button_title(button)
            and _is_shown(button, panel)
        ):
            yield button, offer


def _is_shown(widget: QWidget, panel: QWidget) -> bool:
    """Return whether a button is available to the operator, even if it is behind another tab."""
    child: QWidget | None = widget
    while child is not None and child is not panel:
        parent = child.parentWidget()
        is_tab_page = isinstance(parent, QStackedWidget) and isinstance(
            parent.parentWidget(), QTabWidget
        )
        if child.isHidden() and not is_tab_page:
            return False
        child = parent
    return True


def _make_button_title(button: QAbstractButton) -> str:
    return button.accessibleName() or button.text().replace("&", "").strip(_DECORATION_CHARS)


def _find_reason(button: QAbstractButton) -> str | None:
    if button.isEnabled():
        return None
    ancestor: QWidget | None = button
    # The button may be disabled as part of a disabled container.
    while ancestor is not None:
        if reason := get_disabled_reason(ancestor):
            return translate_message(reason)
        ancestor = ancestor.parentWidget()
    return translate("shell", "its panel does not permit it now")

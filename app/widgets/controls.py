"""Behaviour of controls: disabled ones state the reason, and buttons have one action."""

from collections.abc import Callable
from html import escape
from typing import TypeVar

from PySide6.QtGui import QAction, QKeySequence
from PySide6.QtWidgets import QProgressBar, QPushButton, QWidget

from rotemina.app.shell.engine_words import spoken
from rotemina.app.shell.language import translate

_Widget = TypeVar("_Widget", bound=QWidget)
_WHY_NOT = "whyNot"
_TOLD = "_told_why_not"


def plain_tip(*lines: str) -> str:
    """Return a tooltip whose lines are no markup, whatever they hold."""
    text = "<br>".join(escape(line) for line in lines if line)
    return f"<qt>{text}</qt>" if text else ""


def show_tip(widget: QWidget, *lines: str) -> None:
    """Give a widget a plain tooltip, if it has another one: Qt tells of each that is set."""
    tip = plain_tip(*lines)
    if tip != widget.toolTip():
        widget.setToolTip(tip)


def native_keys(shortcut: str) -> str:
    """Return a shortcut such as ``Ctrl+S`` as keyboards of the window's language have it."""
    return QKeySequence(shortcut).toString(QKeySequence.SequenceFormat.NativeText)


def allow(widget: QWidget | QAction, why_not: str | None, tip: str) -> None:
    """Enable a control, or disable it with a tooltip that says why it cannot act."""
    widget.setEnabled(why_not is None)
    told = why_not, tip
    if getattr(widget, _TOLD, None) == told:
        return  # panels ask for every control in every frame
    setattr(widget, _TOLD, told)
    text = plain_tip(
        tip,
        translate("widgets", "Not now: {why_not}").format(why_not=spoken(why_not))
        if why_not
        else "",
    )
    widget.setToolTip(text)
    widget.setProperty(_WHY_NOT, why_not or "")


def why_not(widget: QWidget | QAction) -> str | None:
    """Return why a control is disabled, as last set by :func:`allow`."""
    return widget.property(_WHY_NOT) or None


def button(text: str, run: Callable[[], object], tip: str = "") -> QPushButton:
    """Return a push button that does something."""
    made = QPushButton(text)
    if tip:
        made.setToolTip(plain_tip(tip))
    made.clicked.connect(lambda _: run())
    return made


def named(widget: _Widget, name: str, tip: str = "") -> _Widget:
    """Return a widget with its name, for those who hear the screen, and its tooltip, if any."""
    widget.setAccessibleName(name)
    if tip:
        widget.setToolTip(tip)
    return widget


def set_property(widget: QWidget, name: str, value: object) -> bool:
    """Give a widget the look that the style sheet has for a property; return whether it is new."""
    if widget.property(name) == value:
        return False
    widget.setProperty(name, value)
    widget.style().unpolish(widget)
    widget.style().polish(widget)
    return True


def fill(bar: QProgressBar, value: int) -> None:
    """Set how full a bar is; it is painted with the rest of the window.

    Left to itself it would be painted at once, and with it, in one go, all of the window that waits
    to be painted: many times a second, in the middle of something else.
    """
    if bar.value() != value:
        bar.setUpdatesEnabled(False)
        bar.setValue(value)
        bar.setUpdatesEnabled(True)

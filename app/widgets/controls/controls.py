"""Helpers for controls, such as disabling one with a tooltip that states the reason."""

from collections.abc import Callable
from html import escape
from typing import TYPE_CHECKING, TypeVar

from PySide6.QtGui import QAction, QKeySequence
from PySide6.QtWidgets import QProgressBar, QPushButton, QWidget

from rotemina.app.language import translate, translate_message
from rotemina.sim.compatibility import serve_former_names

_Widget = TypeVar("_Widget", bound=QWidget)
_REASON_PROPERTY = "whyNot"
_STATE_ATTRIBUTE = "_told_why_not"


def make_tooltip(*lines: str) -> str:
    """Return a tooltip with these lines of plain text, in which markup is escaped."""
    text = "<br>".join(escape(line) for line in lines if line)
    return f"<qt>{text}</qt>" if text else ""


def show_tooltip(widget: QWidget, *lines: str) -> None:
    """Set a plain tooltip, unless it is set already: Qt would send an event each time."""
    tip = make_tooltip(*lines)
    if tip != widget.toolTip():
        widget.setToolTip(tip)


def format_shortcut(shortcut: str) -> str:
    """Return a shortcut such as ``Ctrl+S`` with the key names of the window's language."""
    return QKeySequence(shortcut).toString(QKeySequence.SequenceFormat.NativeText)


def enable_unless(widget: QWidget | QAction, objection: str | None, tip: str) -> None:
    """Enable a control, or disable it with a tooltip that gives the objection."""
    widget.setEnabled(objection is None)
    current_state = objection, tip
    if getattr(widget, _STATE_ATTRIBUTE, None) == current_state:
        # Panels call this for every control in every frame.
        return
    setattr(widget, _STATE_ATTRIBUTE, current_state)
    text = make_tooltip(
        tip,
        translate("widgets", "Not now: {why_not}").format(why_not=translate_message(objection))
        if objection
        else "",
    )
    widget.setToolTip(text)
    widget.setProperty(_REASON_PROPERTY, objection or "")


def get_disabled_reason(widget: QWidget | QAction) -> str | None:
    """Return why a control is disabled, as last set by :func:`enable_unless`."""
    return widget.property(_REASON_PROPERTY) or None


def make_button(text: str, run: Callable[[], object], tip: str = "") -> QPushButton:
    """Return a push button that calls ``run``."""
    push_button = QPushButton(text)
    if tip:
        push_button.setToolTip(make_tooltip(tip))
    push_button.clicked.connect(lambda _: run())
    return push_button


def name_widget(widget: _Widget, name: str, tip: str = "") -> _Widget:
    """Set the accessible name of a widget and its tooltip, if any, and return it."""
    widget.setAccessibleName(name)
    if tip:
        widget.setToolTip(tip)
    return widget


def set_property(widget: QWidget, name: str, value: object) -> bool:
    """Set a property that the style sheet refers to; return whether it has changed."""
    if widget.property(name) == value:
        return False
    widget.setProperty(name, value)
    widget.style().unpolish(widget)
    widget.style().polish(widget)
    return True


def set_bar_value(bar: QProgressBar, value: int) -> None:
    """Set the value of a progress bar without painting it at once.

    Qt would paint the bar immediately, together with every other part of the window that needs
    painting: many times a second, in the middle of other work.
    """
    if bar.value() != value:
        bar.setUpdatesEnabled(False)
        bar.setValue(value)
        bar.setUpdatesEnabled(True)


if not TYPE_CHECKING:
    __getattr__ = serve_former_names(
        __name__,
        allow="enable_unless",
        button="make_button",
        fill="set_bar_value",
        named="name_widget",
        native_keys="format_shortcut",
        plain_tip="make_tooltip",
        show_tip="show_tooltip",
        why_not="get_disabled_reason",
    )

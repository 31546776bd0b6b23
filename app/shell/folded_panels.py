"""Buttons for the panels that a narrow window folds away; they cost it no width."""

from collections.abc import Mapping

from PySide6.QtWidgets import QDockWidget, QHBoxLayout, QToolButton, QWidget

from rotemina.app.shell.language import translate
from rotemina.app.widgets.controls import plain_tip

FOLDED = ("job", "events")  # panels that a narrow window folds away
NARROW_BELOW = 1600  # px of the window's width


class FoldedPanels(QWidget):
    """Opens one of the docks that are folded away, in the corner of the menu bar."""

    def __init__(self, docks: Mapping[str, QDockWidget]) -> None:
        super().__init__()
        self.docks = {name: docks[name] for name in FOLDED if name in docks}
        self.buttons: dict[str, QToolButton] = {}
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 24, 0)
        row.setSpacing(2)
        for name, dock in self.docks.items():
            button = self.buttons[name] = QToolButton()
            button.setObjectName("layoutChoice")
            button.setText(dock.windowTitle())
            button.setToolTip(plain_tip(translate("shell", "Open or close this panel")))
            button.setCheckable(True)
            button.clicked.connect(lambda opened, name=name: self._open(name if opened else ""))
            dock.visibilityChanged.connect(self.refresh)
            row.addWidget(button)
        self.refresh()

    def refresh(self) -> None:
        """Mark the buttons of the panels that are open."""
        for name, button in self.buttons.items():
            button.setChecked(not self.docks[name].isHidden())

    def _open(self, name: str) -> None:
        """Open one, in place of the other: a narrow window is low as well."""
        for each, dock in self.docks.items():
            dock.setVisible(each == name)
        if name:
            self.docks[name].raise_()

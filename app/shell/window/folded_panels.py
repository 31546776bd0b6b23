"""Buttons for the panels that a narrow window folds away to save width."""

from collections.abc import Mapping

from PySide6.QtWidgets import QDockWidget, QHBoxLayout, QToolButton, QWidget

from rotemina.app.language import translate
from rotemina.app.widgets.controls import make_tooltip

FOLDED_PANELS = ("job", "events")
# Below this width of the window, panels are folded away.
NARROW_WIDTH_PX = 1600


class FoldedPanelButtons(QWidget):
    """Buttons in the corner of the menu bar that open the folded panels."""

    def __init__(self, docks: Mapping[str, QDockWidget]) -> None:
        super().__init__()
        self.docks = {name: docks[name] for name in FOLDED_PANELS if name in docks}
        self.buttons: dict[str, QToolButton] = {}
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 24, 0)
        row.setSpacing(2)
        for name, dock in self.docks.items():
            button = self.buttons[name] = QToolButton()
            button.setObjectName("layoutChoice")
            button.setText(dock.windowTitle())
            button.setToolTip(make_tooltip(translate("shell", "Open or close this panel")))
            button.setCheckable(True)
            button.clicked.connect(lambda is_open, name=name: self._open(name if is_open else ""))
            dock.visibilityChanged.connect(self.refresh)
            row.addWidget(button)
        self.refresh()

    def refresh(self) -> None:
        """Show the buttons of open panels as pressed."""
        for name, button in self.buttons.items():
            button.setChecked(not self.docks[name].isHidden())

    def _open(self, name: str) -> None:
        """Open one panel and close the other: a narrow window is usually also low."""
        for other_name, dock in self.docks.items():
            dock.setVisible(other_name == name)
        if name:
            self.docks[name].raise_()

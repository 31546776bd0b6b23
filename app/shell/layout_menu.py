"""The window's layouts in its menu: those of the user, and a row of buttons for the built-in."""

from collections.abc import Callable

from PySide6.QtWidgets import QHBoxLayout, QInputDialog, QMenu, QToolButton, QWidget

from rotemina.app.shell.language import translate
from rotemina.app.shell.layouts import BUILT_IN, LONGEST_NAME, KeptLayouts, Layout
from rotemina.app.widgets.controls import native_keys, plain_tip


class LayoutRow(QWidget):
    """One button for each built-in layout, for the corner of the menu bar."""

    def __init__(self, use: Callable[[Layout], object]) -> None:
        super().__init__()
        self._row = row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 6, 0)
        row.setSpacing(2)
        self.buttons: dict[str, QToolButton] = {}
        for layout in BUILT_IN:
            button = self.buttons[layout.word] = QToolButton()
            button.setObjectName("layoutChoice")
            button.setText(layout.shown)
            button.setToolTip(
                plain_tip(f"{translate('shell', layout.tip)} ({native_keys(layout.shortcut)})")
            )
            button.setAccessibleName(translate("shell", "Layout: {name}").format(name=layout.shown))
            button.clicked.connect(lambda _=False, layout=layout: use(layout))
            button.setCheckable(True)
            row.addWidget(button)

    def stand_behind(self, other: QWidget) -> None:
        """Put another widget before the buttons."""
        self._row.insertWidget(0, other)

    def mark(self, layout: Layout | None) -> None:
        """Mark the layout that is in use; None: it is one of the user's own."""
        for word, button in self.buttons.items():
            button.setChecked(layout is not None and word == layout.word)


class KeptLayoutMenu(QMenu):
    """The layouts of the user's own: to be shown again, or deleted."""

    def __init__(self, kept: KeptLayouts, use: Callable[[str], object], parent: QWidget) -> None:
        super().__init__(translate("shell", "My layouts"), parent)
        self._kept, self._use = kept, use
        self.aboutToShow.connect(self.fill)
        self.fill()

    def fill(self) -> None:
        """Offer what is kept now."""
        self.clear()
        names = self._kept.names()
        for name in names:
            action = self.addAction(name.replace("&", "&&"))
            action.triggered.connect(lambda _=False, name=name: self._use(name))
        if not names:
            self.addAction(translate("shell", "No layout is saved")).setEnabled(False)
            return
        delete = self.addMenu(translate("shell", "Delete"))
        for name in names:
            action = delete.addAction(name.replace("&", "&&"))
            action.triggered.connect(lambda _=False, name=name: self._kept.forget(name))


def ask_name(parent: QWidget, use: Callable[[str], object]) -> QInputDialog:
    """Ask for the name of a layout beside the window, whose stop button can still be used."""
    dialog = QInputDialog(parent)
    dialog.setWindowTitle(translate("shell", "Save layout"))
    dialog.setLabelText(
        translate("shell", "Name of the layout (up to {most} letters):").format(most=LONGEST_NAME)
    )
    dialog.textValueSelected.connect(lambda text: use(text.strip()))
    dialog.finished.connect(dialog.deleteLater)
    dialog.show()
    return dialog

"""The window's layouts in its menus: those of the user, and buttons for the built-in ones."""

from collections.abc import Callable

from PySide6.QtCore import QEvent, QObject
from PySide6.QtWidgets import QInputDialog, QMenu, QMenuBar, QToolButton, QWidget

from rotemina.app.shell.folded_panels import FoldedPanels
from rotemina.app.shell.language import translate
from rotemina.app.shell.layouts import BUILT_IN, LONGEST_NAME, KeptLayouts, Layout
from rotemina.app.widgets.controls import native_keys, plain_tip
from rotemina.app.widgets.layouts import in_row


class LayoutRow(QWidget):
    """The built-in layouts and the folded panels at the right end of a menu bar.

    One button for each where there is room, else one button with a menu of them; where there is not
    even room for that, the View menu still has them all. The menus come first, and the bar asks for
    no width because of this row.
    """

    def __init__(
        self, bar: QMenuBar, use: Callable[[Layout], object], folded: FoldedPanels
    ) -> None:
        super().__init__(bar)
        self._bar, self._folded = bar, folded
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
        self._all = QWidget()
        in_row(folded, *self.buttons.values(), on=self._all, margins=0, spacing=2)
        self.short = QToolButton()
        self.short.setObjectName("layoutChoice")
        self.short.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        self.short.setAccessibleName(translate("shell", "Layout"))
        menu = QMenu(self.short)
        menu.aboutToShow.connect(self._fill)
        self.short.setMenu(menu)
        in_row(self._all, self.short, on=self, margins=(0, 0, 6, 0), spacing=0)
        self.mark(None)
        bar.installEventFilter(self)

    def mark(self, layout: Layout | None) -> None:
        """Mark the layout that is in use; None: it is one of the user's own."""
        for word, button in self.buttons.items():
            button.setChecked(layout is not None and word == layout.word)
        text = translate("shell", "Layout") if layout is None else layout.shown
        if text != self.short.text():
            self.short.setText(text)
        self.place()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 (Qt's name)
        """Follow the menu bar, and what in it has another size."""
        if event.type() in (QEvent.Type.Resize, QEvent.Type.LayoutRequest):
            self.place()
        return False

    def place(self) -> None:
        """Show as much as the menus leave room for, at the right end of the bar."""
        margins = self.layout().contentsMargins()
        around = margins.left() + margins.right()
        room = self._bar.width() - self._bar.sizeHint().width() - around
        parts = (self._all, self.short)
        fitting = next((part for part in parts if part.sizeHint().width() <= room), None)
        for part, visible in (
            (self, fitting is not None),
            *((one, one is fitting) for one in parts),
        ):
            if part.isHidden() is visible:
                part.setVisible(visible)
        if fitting is not None:
            width = fitting.sizeHint().width() + around
            self.setGeometry(self._bar.width() - width, 0, width, self._bar.height())

    def _fill(self) -> None:
        """Offer in the menu what the buttons do."""
        menu = self.short.menu()
        menu.clear()
        buttons = [*self.buttons.values()]
        if not self._folded.isHidden():
            buttons += self._folded.buttons.values()
        for button in buttons:
            action = menu.addAction(button.text().replace("&", "&&"), button.click)
            action.setCheckable(True)
            action.setChecked(button.isChecked())


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

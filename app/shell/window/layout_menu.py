"""The window's layouts in its menus: saved layouts, and buttons for the built-in ones."""

from collections.abc import Callable

from PySide6.QtCore import QEvent, QObject
from PySide6.QtWidgets import QInputDialog, QMenu, QMenuBar, QToolButton, QWidget

from rotemina.app.language import translate
from rotemina.app.shell.window.folded_panels import FoldedPanelButtons
from rotemina.app.shell.window.layouts import BUILT_IN, MAX_NAME_LENGTH, SavedLayouts, WindowLayout
from rotemina.app.widgets.controls import format_shortcut, make_tooltip
from rotemina.app.widgets.layout import make_row


class LayoutRow(QWidget):
    """Buttons for the built-in layouts and the folded panels, at the right end of a menu bar.

    If there is space, each has its own button; otherwise a single button opens a menu of them. If
    even that button does not fit, the View menu still contains them. The menus take precedence:
    this row requests no width from the menu bar.
    """

    def __init__(
        self, bar: QMenuBar, use: Callable[[WindowLayout], object], folded: FoldedPanelButtons
    ) -> None:
        super().__init__(bar)
        self._bar, self._folded = bar, folded
        self.buttons: dict[str, QToolButton] = {}
        for layout in BUILT_IN:
            button = self.buttons[layout.plain_title] = QToolButton()
            button.setObjectName("layoutChoice")
            button.setText(layout.translated_title)
            button.setToolTip(
                make_tooltip(
                    f"{translate('shell', layout.tip)} ({format_shortcut(layout.shortcut)})"
                )
            )
            button.setAccessibleName(
                translate("shell", "Layout: {name}").format(name=layout.translated_title)
            )
            button.clicked.connect(lambda _=False, layout=layout: use(layout))
            button.setCheckable(True)
        self._button_row = QWidget()
        make_row(folded, *self.buttons.values(), on=self._button_row, margins=0, spacing=2)
        self.menu_button = QToolButton()
        self.menu_button.setObjectName("layoutChoice")
        self.menu_button.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        self.menu_button.setAccessibleName(translate("shell", "Layout"))
        menu = QMenu(self.menu_button)
        menu.aboutToShow.connect(self._fill_menu)
        self.menu_button.setMenu(menu)
        make_row(self._button_row, self.menu_button, on=self, margins=(0, 0, 6, 0), spacing=0)
        self.mark_layout(None)
        bar.installEventFilter(self)

    def mark_layout(self, layout: WindowLayout | None) -> None:
        """Mark the layout in use; None means a layout that the user has arranged."""
        for title, button in self.buttons.items():
            button.setChecked(layout is not None and title == layout.plain_title)
        text = translate("shell", "Layout") if layout is None else layout.translated_title
        if text != self.menu_button.text():
            self.menu_button.setText(text)
        self.place_buttons()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 (Qt's name)
        """Place the buttons again when the menu bar or a part of it changes its size."""
        if event.type() in (QEvent.Type.Resize, QEvent.Type.LayoutRequest):
            self.place_buttons()
        return False

    def place_buttons(self) -> None:
        """Show what fits into the space that the menus leave, at the right end of the bar."""
        margins = self.layout().contentsMargins()
        margin_width = margins.left() + margins.right()
        free_width = self._bar.width() - self._bar.sizeHint().width() - margin_width
        candidates = (self._button_row, self.menu_button)
        fitting_part = next(
            (part for part in candidates if part.sizeHint().width() <= free_width), None
        )
        for part, visible in (
            (self, fitting_part is not None),
            *((candidate, candidate is fitting_part) for candidate in candidates),
        ):
            if part.isHidden() is visible:
                part.setVisible(visible)
        if fitting_part is not None:
            width = fitting_part.sizeHint().width() + margin_width
            self.setGeometry(self._bar.width() - width, 0, width, self._bar.height())

    def _fill_menu(self) -> None:
        menu = self.menu_button.menu()
        menu.clear()
        buttons = [*self.buttons.values()]
        if not self._folded.isHidden():
            buttons += self._folded.buttons.values()
        for button in buttons:
            action = menu.addAction(button.text().replace("&", "&&"), button.click)
            action.setCheckable(True)
            action.setChecked(button.isChecked())


class SavedLayoutMenu(QMenu):
    """Menu of the user's saved layouts, to restore or delete them."""

    def __init__(
        self, layouts: SavedLayouts, use: Callable[[str], object], parent: QWidget
    ) -> None:
        super().__init__(translate("shell", "My layouts"), parent)
        self._saved_layouts, self._use = layouts, use
        self.aboutToShow.connect(self.fill)
        self.fill()

    def fill(self) -> None:
        """List the layouts that are saved now."""
        self.clear()
        names = self._saved_layouts.list_names()
        for name in names:
            action = self.addAction(name.replace("&", "&&"))
            action.triggered.connect(lambda _=False, name=name: self._use(name))
        if not names:
            self.addAction(translate("shell", "No layout is saved")).setEnabled(False)
            return
        delete = self.addMenu(translate("shell", "Delete"))
        for name in names:
            action = delete.addAction(name.replace("&", "&&"))
            action.triggered.connect(lambda _=False, name=name: self._saved_layouts.delete(name))


def ask_layout_name(parent: QWidget, use: Callable[[str], object]) -> QInputDialog:
    """Ask for the name of a layout while the window and its stop button stay usable."""
    dialog = QInputDialog(parent)
    dialog.setWindowTitle(translate("shell", "Save layout"))
    dialog.setLabelText(
        translate("shell", "Name of the layout (up to {most} letters):").format(
            most=MAX_NAME_LENGTH
        )
    )
    dialog.textValueSelected.connect(lambda text: use(text.strip()))
    dialog.finished.connect(dialog.deleteLater)
    dialog.show()
    return dialog

"""Above the picture: what the left button does, zoom, and the tools beside the picture."""

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QHBoxLayout, QLabel, QPushButton, QWidget

from rotemina.app.shell.controls import allow, plain_tip
from rotemina.app.shell.language import marked, translate
from rotemina.plugins.microscope.picture_view import Hand, PictureView
from rotemina.plugins.microscope.section import SteadyChoice, button

HANDS = {
    Hand.MOVE: (
        marked("microscope", "Move"),
        marked("microscope", "Click or drag: the tip goes there. Esc, or any stop, ends this"),
    ),
    Hand.MARK: (
        marked("microscope", "Mark"),
        marked("microscope", "Click: mark a target to be visited; nothing moves"),
    ),
    Hand.MEASURE: (
        marked("microscope", "Measure"),
        marked("microscope", "Drag a line: its length and angles; nothing moves"),
    ),
    Hand.TIP: (
        marked("microscope", "Tip"),
        marked("microscope", "Click near the pipette's tip: track it from there; nothing moves"),
    ),
    Hand.CELL: (
        marked("microscope", "Cell"),
        marked("microscope", "Click into a cell: find its outline; nothing moves"),
    ),
}


class TopBar(QWidget):
    """One button for each thing that a click can do, at most one of them pressed.

    Signals
    -------
    chosen(Hand) : somebody wants the left button to do this.
    """

    chosen = Signal(object)

    def __init__(self, view: PictureView, tools: tuple[str, ...]) -> None:
        super().__init__()
        self.buttons: dict[Hand, QPushButton] = {}
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(4)
        for hand, (text, tip) in HANDS.items():
            made = QPushButton(translate("microscope", text))
            made.setCheckable(True)
            made.setToolTip(plain_tip(translate("microscope", tip)))
            made.clicked.connect(lambda on, hand=hand: self.chosen.emit(hand if on else Hand.PAN))
            self.buttons[hand] = made
            row.addWidget(made)
        row.addStretch(1)
        self.zoom = QLabel()
        self.zoom.setProperty("quiet", True)
        self.fit = button(
            translate("microscope", "Fit"),
            view.show_fitted,
            translate("microscope", "Show all of the picture (F)"),
        )
        self.one = button(
            "1:1",
            view.show_one_to_one,
            translate("microscope", "A pixel is one of the screen's (1)"),
        )
        self.tools = SteadyChoice(translate("microscope", "Tools beside the picture"))
        for name in tools:
            self.tools.addItem(name)
        for widget in (self.zoom, self.fit, self.one, self.tools):
            row.addWidget(widget)
        view.zoomed.connect(lambda: self.zoom.setText(f"{100.0 * view.viewport.zoom:.0f} %"))

    def show_hand(self, hand: Hand) -> None:
        """Show what the left button does."""
        for one, made in self.buttons.items():
            made.setChecked(one is hand)

    def refresh(self, against: dict[Hand, str | None]) -> None:
        """Lock what cannot be done now, with the reason."""
        for hand, made in self.buttons.items():
            allow(made, against.get(hand), translate("microscope", HANDS[hand][1]))

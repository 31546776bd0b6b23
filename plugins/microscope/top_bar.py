"""The bar above the picture: click modes, zoom, and tools."""

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QPushButton, QWidget

from rotemina.app.widgets.controls import allow, button, plain_tip
from rotemina.app.widgets.labels import plain_text
from rotemina.app.widgets.layouts import in_row
from rotemina.app.widgets.wheel_safe import SteadyChoice
from rotemina.app.widgets.when_dressed import leave_room
from rotemina.plugins.microscope import mark, tr
from rotemina.plugins.microscope.picture_view import PictureView, PointerTool
from rotemina.sim.quantities import fixed

TOOLS = {
    PointerTool.MOVE: (
        mark("Move"),
        mark("Click or drag: the tip moves there. Esc or any stop ends this mode"),
    ),
    PointerTool.MARK: (mark("Mark"), mark("Click: mark a target for a visit; nothing moves")),
    PointerTool.MEASURE: (
        mark("Measure"),
        mark("Drag a line: its length and angles; nothing moves"),
    ),
    PointerTool.TIP: (
        mark("Tip"),
        mark("Click near the pipette's tip: track it from there; nothing moves"),
    ),
    PointerTool.CELL: (mark("Cell"), mark("Click into a cell: find its outline; nothing moves")),
}


_WIDEST_ZOOM = "8888 %"


class TopBar(QWidget):
    """One button for each thing that a click can do, at most one of them pressed.

    Signals
    -------
    chosen(PointerTool) : someone wants the left button to do this.
    """

    chosen = Signal(object)

    def __init__(self, view: PictureView, tools: tuple[str, ...]) -> None:
        super().__init__()
        self.buttons: dict[PointerTool, QPushButton] = {}
        row = in_row(on=self, margins=0, spacing=4)
        for tool, (text, tip) in TOOLS.items():
            made = QPushButton(tr(text))
            made.setCheckable(True)
            made.setToolTip(plain_tip(tr(tip)))
            made.clicked.connect(
                lambda on, tool=tool: self.chosen.emit(tool if on else PointerTool.PAN)
            )
            self.buttons[tool] = made
            row.addWidget(made)
        row.addStretch(1)
        self.zoom = plain_text()
        self.zoom.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        self.fit = button(tr("Fit"), view.show_fitted, tr("Show all of the picture (F)"))
        self.one = button("1:1", view.show_one_to_one, tr("One camera pixel per screen pixel (1)"))
        self.tools = SteadyChoice(tr("Tools beside the picture"), letters=6)
        for name in tools:
            self.tools.addItem(name)
        for widget in (self.zoom, self.fit, self.one, self.tools):
            row.addWidget(widget)
        leave_room(self.zoom, _WIDEST_ZOOM)  # so that the first picture moves nothing
        view.zoomed.connect(lambda: self._show_zoom(view))

    def _show_zoom(self, view: PictureView) -> None:
        """Show how large the picture is; before the first one there is nothing to tell."""
        shown = view.frame is not None
        self.zoom.setText(f"{fixed(100.0 * view.viewport.zoom, 0)} %" if shown else "")

    def show_tool(self, tool: PointerTool) -> None:
        """Show what the left button does."""
        for one, made in self.buttons.items():
            made.setChecked(one is tool)

    def refresh(self, against: dict[PointerTool, str | None]) -> None:
        """Lock what cannot be done now, with the reason."""
        for tool, made in self.buttons.items():
            allow(made, against.get(tool), tr(TOOLS[tool][1]))

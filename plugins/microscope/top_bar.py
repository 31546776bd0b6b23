"""Bar above the picture: click modes, zoom and tools."""

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QPushButton, QWidget

from rotemina.app.widgets.controls import (
    WheelSafeComboBox,
    enable_unless,
    make_button,
    make_tooltip,
)
from rotemina.app.widgets.layout import make_row
from rotemina.app.widgets.style import reserve_width
from rotemina.app.widgets.text import make_plain_label
from rotemina.plugins.microscope import mark, tr
from rotemina.plugins.microscope.picture_view import PictureView, PointerTool
from rotemina.sim.messages import format_fixed

TOOL_TEXTS = {
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


_WIDEST_ZOOM_TEXT = "8888 %"


class TopBar(QWidget):
    """Bar with a button for each click mode, zoom buttons and the choice of tools.

    At most one click mode is active.

    Signals
    -------
    chosen(PointerTool) : the operator has chosen this mode.
    """

    chosen = Signal(object)

    def __init__(self, view: PictureView, tools: tuple[str, ...]) -> None:
        super().__init__()
        self.buttons: dict[PointerTool, QPushButton] = {}
        row = make_row(on=self, margins=0, spacing=4)
        for tool, (text, tooltip) in TOOL_TEXTS.items():
            tool_button = QPushButton(tr(text))
            tool_button.setCheckable(True)
            tool_button.setToolTip(make_tooltip(tr(tooltip)))
            tool_button.clicked.connect(
                lambda on, tool=tool: self.chosen.emit(tool if on else PointerTool.PAN)
            )
            self.buttons[tool] = tool_button
            row.addWidget(tool_button)
        row.addStretch(1)
        self.zoom = make_plain_label()
        self.zoom.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        self.fit = make_button(tr("Fit"), view.show_fitted, tr("Show all of the picture (F)"))
        self.one_to_one = make_button(
            "1:1", view.show_one_to_one, tr("One camera pixel per screen pixel (1)")
        )
        self.tools = WheelSafeComboBox(tr("Tools next to the picture"), letters=6)
        for name in tools:
            self.tools.addItem(name)
        for widget in (self.zoom, self.fit, self.one_to_one, self.tools):
            row.addWidget(widget)
        # Space is reserved so that the first picture does not shift the other widgets.
        reserve_width(self.zoom, _WIDEST_ZOOM_TEXT)
        view.zoomed.connect(lambda: self._show_zoom(view))

    def _show_zoom(self, view: PictureView) -> None:
        has_picture = view.frame is not None
        self.zoom.setText(f"{format_fixed(100.0 * view.viewport.zoom, 0)} %" if has_picture else "")

    def show_tool(self, tool: PointerTool) -> None:
        """Show the active click mode."""
        for button_tool, tool_button in self.buttons.items():
            tool_button.setChecked(button_tool is tool)

    def refresh(self, objections: dict[PointerTool, str | None]) -> None:
        """Disable the modes that are impossible now, with the reasons as tooltips."""
        for tool, tool_button in self.buttons.items():
            enable_unless(tool_button, objections.get(tool), tr(TOOL_TEXTS[tool][1]))

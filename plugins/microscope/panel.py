"""Microscope panel: the picture, with tools next to it."""

from collections.abc import Callable
from time import monotonic

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QFrame, QScrollArea, QStackedWidget, QWidget

from rotemina.app.language import marked, translate_message
from rotemina.app.microscope import MicroscopeStatus
from rotemina.app.motion.state import SessionState
from rotemina.app.panel import (
    Panel,
    PanelArea,
    offer_in_palette,
)
from rotemina.app.widgets.controls import make_button
from rotemina.app.widgets.layout import make_column, make_row, make_scroll_area
from rotemina.app.widgets.style import Theme, grow_with_text
from rotemina.app.widgets.text import ElidedLabel, make_plain_label
from rotemina.app.workbench import Workbench
from rotemina.drivers.cameras import CameraFrame
from rotemina.plugins.microscope import mark, tr
from rotemina.plugins.microscope.calibration_section import StageCalibrationSection
from rotemina.plugins.microscope.camera_section import CameraSection, CameraSettingsSection
from rotemina.plugins.microscope.cursor_readout import describe_cursor
from rotemina.plugins.microscope.map_section import MapSection
from rotemina.plugins.microscope.move_section import MoveSection, TargetSection
from rotemina.plugins.microscope.picture_section import LayerSection, PictureSection
from rotemina.plugins.microscope.picture_view import PictureView, PointerTool
from rotemina.plugins.microscope.pointer_tools import PointerController
from rotemina.plugins.microscope.saving_section import SavingSection
from rotemina.plugins.microscope.stack_section import StackSection
from rotemina.plugins.microscope.top_bar import TopBar
from rotemina.plugins.microscope.vision_section import CellSection, FocusSection, TipTrackingSection

TOOL_PAGES = (
    mark("Camera"),
    mark("Picture"),
    mark("Calibrate"),
    mark("Move"),
    mark("Vision"),
    mark("Save"),
    mark("Map"),
    mark("– no tools –"),
)
_TOOLS_WIDTH_PX = 250
# Two refresh periods of the window. A picture shown within this time has updated the view.
_RECENT_PICTURE_S = 0.07


class MoveQuestion(QFrame):
    """Question with the answers yes and no.

    Neither button takes the focus, so that Enter or the space bar cannot answer by accident.
    """

    def __init__(self, yes: str, answer: Callable[[bool], None]) -> None:
        super().__init__()
        self.setObjectName("question")
        self.text = make_plain_label(quiet=False, wrap=True)
        self.yes = make_button(yes, lambda: answer(True), tr("Move the tip"))
        self.yes.setProperty("primary", True)
        self.no = make_button(tr("Cancel"), lambda: answer(False), tr("Do not move"))
        for answer_button in (self.yes, self.no):
            answer_button.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        make_row((self.text, 1), self.yes, self.no, on=self, margins=(8, 4, 8, 4))
        self.hide()

    def ask(self, text: str) -> None:
        """Show the question. An empty text hides it."""
        self.text.setText(text)
        self.setVisible(bool(text))


class MicroscopePanel(Panel):
    """Panel with the picture as large as possible, and one page of tools next to it."""

    title = marked("panels", "Microscope")
    area = PanelArea.CENTRE
    order = 15
    help_page = "microscope.md#in-the-window"
    _picture_arrived = Signal()

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        self.microscope = workbench.microscope
        # Whether a picture has arrived that the window has not shown yet.
        self._is_picture_pending = False
        # Time at which the window showed the last picture.
        self._last_picture_s = float("-inf")
        self.view = PictureView(workbench.theme)
        self.pointer = PointerController(workbench, self.microscope, self.view)
        self.bar = TopBar(self.view, tuple(tr(tool) for tool in TOOL_PAGES))
        self.question = MoveQuestion(tr("Move"), self.pointer.answer)
        self.readout = ElidedLabel()
        self.readout.setProperty("quiet", True)
        self._make_sections()
        self._lay_out()
        self._connect()
        offer_in_palette(self.calibration.micro, self.calibration.nano, self.move.back)
        offer_in_palette(self.targets.next, self.stack.take, self.saving.record)
        offer_in_palette(
            self.move.stop, self.calibration.abort, self.saving.snapshot, safe_while_hidden=True
        )

    def refresh(self, state: SessionState) -> None:
        """Show the status of the microscope. Start and end videos with recordings."""
        if not (self.isVisible() or self.saving.is_needed or self.stack.is_needed):
            # Reading the status would keep the camera busy.
            return
        is_current = self.isVisible() and monotonic() - self._last_picture_s <= _RECENT_PICTURE_S
        status = self.view.status if is_current else self.microscope.status
        self.pointer.refresh(status)
        # A video and a stack continue while the panel is hidden.
        self.saving.refresh(status, state)
        self.stack.write(status, state)
        if not self.isVisible():
            return
        # A new picture has already updated the view and its overlays.
        if not is_current:
            self._show_status(status)
        if not self.texts_due:
            return
        self.bar.refresh(self.pointer.find_objections(status, state))
        page = self.bar.tools.currentIndex()
        if page < len(self._page_refreshers):
            self._page_refreshers[page](status, state)

    def _make_sections(self) -> None:
        workbench, microscope, view = self.workbench, self.microscope, self.view
        self.camera = CameraSection(workbench, microscope)
        self.settings = CameraSettingsSection(workbench, microscope, view)
        self.picture = PictureSection(view, workbench.theme)
        self.layers = LayerSection(view, workbench.settings)
        self.calibration = StageCalibrationSection(workbench, microscope)
        self.move = MoveSection(workbench, microscope)
        self.targets = TargetSection(workbench, microscope, self.pointer.visit_next)
        self.tip = TipTrackingSection(workbench, microscope)
        self.cell = CellSection(workbench, microscope)
        self.focus = FocusSection(workbench, microscope)
        self.stack = StackSection(workbench, microscope)
        self.saving = SavingSection(workbench, microscope, view)
        self.map = MapSection(workbench)
        self._pages = (
            (self.camera, self.settings),
            (self.picture, self.layers),
            (self.calibration,),
            (self.move, self.targets),
            (self.tip, self.cell, self.focus),
            (self.stack, self.saving),
            (self.map,),
        )
        self._page_refreshers: tuple[Callable[[MicroscopeStatus, SessionState], None], ...] = (
            lambda status, _: (self.camera.refresh(status), self.settings.refresh(status)),
            lambda status, _: self.picture.refresh(status),
            self.calibration.refresh,
            lambda *states: (self.move.refresh(*states), self.targets.refresh(*states)),
            lambda status, state: (
                self.tip.refresh(status),
                self.cell.refresh(status),
                self.focus.refresh(status, state),
            ),
            self.stack.refresh,
            self.map.refresh,
        )

    def _lay_out(self) -> None:
        self.tools = QStackedWidget()
        grow_with_text(self.tools, self.tools.setFixedWidth, _TOOLS_WIDTH_PX)
        for sections in self._pages:
            self.tools.addWidget(_make_page(sections))
        middle = make_row((self.view, 1), self.tools, spacing=6)
        # The central area paints no background behind the panel.
        self.setObjectName("panel")
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        parts = self.bar, (middle, 1), self.question, self.readout
        make_column(*parts, on=self, margins=(6, 4, 6, 4), spacing=4)

    def _connect(self) -> None:
        workbench = self.workbench
        self.bar.chosen.connect(self.pointer.choose_tool)
        self.bar.tools.currentIndexChanged.connect(self._choose_page)
        self.pointer.changed.connect(lambda: self.bar.show_tool(self.view.tool))
        self.pointer.confirmation_requested.connect(self.question.ask)
        self.move.stage.currentIndexChanged.connect(
            lambda _: setattr(self.pointer, "stage", self.move.stage.currentData())
        )
        self.view.hovered.connect(self._show_readout)
        self._picture_arrived.connect(self._show_newest, Qt.ConnectionType.QueuedConnection)
        unsubscribe = self.microscope.camera.listen(self._on_picture)
        workbench.closing.connect(unsubscribe)
        self.follow_frames(self.refresh)
        workbench.theme_changed.connect(self._use_theme)

    def _on_picture(self, _: CameraFrame) -> None:
        """Notify the window on the camera's thread, once for any number of pictures."""
        if not self._is_picture_pending:
            self._is_picture_pending = True
            self._picture_arrived.emit()

    def _show_newest(self) -> None:
        """Show the newest picture, which may be later than the one that was announced."""
        self._is_picture_pending = False
        if self.isVisible():
            self._last_picture_s = monotonic()
            self._show_status(self.microscope.status)

    def _show_status(self, status: MicroscopeStatus) -> None:
        self.view.show_status(status)
        self._show_readout()

    def _show_readout(self) -> None:
        status, tool = self.view.status, self.view.tool
        values = describe_cursor(status, self.view.cursor_pixel)
        mode = ""
        if tool is not PointerTool.PAN:
            mode = tr("{mode}: Esc ends it   ").format(mode=translate_message(tool))
        self.readout.show_text(mode + values)

    def _choose_page(self, page: int) -> None:
        self.tools.setVisible(page < len(self._pages))
        if page < len(self._pages):
            self.tools.setCurrentIndex(page)
        self.refresh(self.workbench.session.snapshot())

    def _use_theme(self, theme: Theme) -> None:
        self.view.set_theme(theme)
        self.picture.set_theme(theme)


def _make_page(sections: tuple[QWidget, ...]) -> QScrollArea:
    content = QWidget()
    make_column(*sections, 1, on=content, margins=(8, 0, 8, 4), spacing=4)
    return make_scroll_area(content)

"""The microscope: its picture, with tools beside it."""

from collections.abc import Callable
from time import monotonic

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QFrame, QScrollArea, QStackedWidget, QWidget

from rotemina.app.microscope.status import MicroscopeStatus
from rotemina.app.motion.state import SessionState
from rotemina.app.panel import Area, Panel, offer_in_palette
from rotemina.app.shell.engine_words import spoken
from rotemina.app.shell.language import marked
from rotemina.app.shell.theme import Theme
from rotemina.app.shell.workbench import Workbench
from rotemina.app.widgets.controls import button
from rotemina.app.widgets.labels import ElidedLabel, plain_text
from rotemina.app.widgets.layouts import in_column, in_row
from rotemina.app.widgets.scroll_areas import scrolled
from rotemina.app.widgets.when_dressed import grow_with_text
from rotemina.drivers.cameras.frame import Frame
from rotemina.plugins.microscope import mark, tr
from rotemina.plugins.microscope.calibration_section import CalibrationSection
from rotemina.plugins.microscope.camera_section import CameraSection, SettingsSection
from rotemina.plugins.microscope.cursor_readout import cursor_text
from rotemina.plugins.microscope.map_section import MapSection
from rotemina.plugins.microscope.move_section import MoveSection, TargetSection
from rotemina.plugins.microscope.picture_section import LayerSection, PictureSection
from rotemina.plugins.microscope.picture_view import PictureView, PointerTool
from rotemina.plugins.microscope.pointer_tools import PointerTools
from rotemina.plugins.microscope.saving_section import SavingSection
from rotemina.plugins.microscope.stack_section import StackSection
from rotemina.plugins.microscope.top_bar import TopBar
from rotemina.plugins.microscope.vision_section import CellSection, FocusSection, TipSection

TOOLS = (
    mark("Camera"),
    mark("Picture"),
    mark("Calibrate"),
    mark("Move"),
    mark("Vision"),
    mark("Save"),
    mark("Map"),
    mark("– no tools –"),
)
_WIDTH = 250  # of the tools, px
_LATE_S = 0.07  # after the last picture, two frames of the window


class Question(QFrame):
    """One question with a yes and a no; Enter and the space bar answer neither by accident."""

    def __init__(self, yes: str, answer: Callable[[bool], None]) -> None:
        super().__init__()
        self.setObjectName("question")
        self.text = plain_text(quiet=False, wrap=True)
        self.yes = button(yes, lambda: answer(True), tr("Move the tip"))
        self.yes.setProperty("primary", True)
        self.no = button(tr("Cancel"), lambda: answer(False), tr("Do not move"))
        for one in (self.yes, self.no):
            one.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        in_row((self.text, 1), self.yes, self.no, on=self, margins=(8, 4, 8, 4))
        self.hide()

    def ask(self, text: str) -> None:
        """Show the question; an empty one hides it."""
        self.text.setText(text)
        self.setVisible(bool(text))


class MicroscopePanel(Panel):
    """The picture as large as there is room, and one page of tools at its side."""

    title = marked("panels", "Microscope")
    area = Area.CENTRE
    order = 15
    help_page = "microscope.md#in-the-window"
    _came = Signal()

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        self.microscope = workbench.microscope
        self._awaited = False  # whether a picture that came in is yet to be taken notice of
        self._taken_s = float("-inf")  # when one was
        self.view = PictureView(workbench.theme)
        self.pointer = PointerTools(workbench, self.microscope, self.view)
        self.bar = TopBar(self.view, tuple(tr(tool) for tool in TOOLS))
        self.question = Question(tr("Move"), self.pointer.answer)
        self.readout = ElidedLabel()
        self.readout.setProperty("quiet", True)
        self._make_sections()
        self._lay_out()
        self._connect()
        offer_in_palette(self.calibration.micro, self.calibration.nano, self.move.back)
        offer_in_palette(self.targets.next, self.stack.take, self.saving.record)
        offer_in_palette(
            self.move.halt, self.calibration.abort, self.saving.snapshot, safe_while_hidden=True
        )

    def refresh(self, state: SessionState) -> None:
        """Show this moment of the microscope."""
        if not (self.isVisible() or self.saving.needed or self.stack.needed):
            return  # reading the status keeps a camera working
        brought = self.isVisible() and monotonic() - self._taken_s <= _LATE_S
        status = self.view.status if brought else self.microscope.status
        self.pointer.refresh(status)
        self.saving.refresh(status, state)  # a video goes on while nobody looks
        self.stack.write(status, state)
        if not self.isVisible():
            return
        if not brought:  # by a picture, with all that lies over it
            self._show(status)
        if not self.texts_due:
            return
        self.bar.refresh(self.pointer.against(status, state))
        page = self.bar.tools.currentIndex()
        if page < len(self._refreshing):
            self._refreshing[page](status, state)

    # --- parts ------------------------------------------------------------------------------------

    def _make_sections(self) -> None:
        bench, microscope, view = self.workbench, self.microscope, self.view
        self.camera = CameraSection(bench, microscope)
        self.settings = SettingsSection(bench, microscope, view)
        self.picture = PictureSection(view, bench.theme)
        self.layers = LayerSection(view, bench.settings)
        self.calibration = CalibrationSection(bench, microscope)
        self.move = MoveSection(bench, microscope)
        self.targets = TargetSection(bench, microscope, self.pointer.visit_next)
        self.tip = TipSection(bench, microscope)
        self.cell = CellSection(bench, microscope)
        self.focus = FocusSection(bench, microscope)
        self.stack = StackSection(bench, microscope)
        self.saving = SavingSection(bench, microscope, view)
        self.map = MapSection(bench)
        self._pages = (
            (self.camera, self.settings),
            (self.picture, self.layers),
            (self.calibration,),
            (self.move, self.targets),
            (self.tip, self.cell, self.focus),
            (self.stack, self.saving),
            (self.map,),
        )
        self._refreshing: tuple[Callable[[MicroscopeStatus, SessionState], None], ...] = (
            lambda status, _: (self.camera.refresh(status), self.settings.refresh(status)),
            lambda status, _: self.picture.refresh(status),
            self.calibration.refresh,
            lambda *now: (self.move.refresh(*now), self.targets.refresh(*now)),
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
        grow_with_text(self.tools, self.tools.setFixedWidth, _WIDTH)
        for sections in self._pages:
            self.tools.addWidget(_page(sections))
        middle = in_row((self.view, 1), self.tools, spacing=6)
        self.setObjectName("panel")  # the central area gives no ground of its own
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        parts = self.bar, (middle, 1), self.question, self.readout
        in_column(*parts, on=self, margins=(6, 4, 6, 4), spacing=4)

    def _connect(self) -> None:
        bench = self.workbench
        self.bar.chosen.connect(self.pointer.choose)
        self.bar.tools.currentIndexChanged.connect(self._choose_page)
        self.pointer.changed.connect(lambda: self.bar.show_tool(self.view.tool))
        self.pointer.asks.connect(self.question.ask)
        self.move.stage.currentIndexChanged.connect(
            lambda _: setattr(self.pointer, "stage", self.move.stage.currentData())
        )
        self.view.hovered.connect(self._show_readout)
        self._came.connect(self._take, Qt.ConnectionType.QueuedConnection)
        leave = self.microscope.camera.listen(self._hear)
        bench.closing.connect(leave)
        self.follow_frames(self.refresh)
        bench.theme_changed.connect(self._use_theme)

    # --- what happens -----------------------------------------------------------------------------

    def _hear(self, _: Frame) -> None:
        """Wake the window up, once for however many pictures; on the camera's thread."""
        if not self._awaited:
            self._awaited = True
            self._came.emit()

    def _take(self) -> None:
        """Show the newest picture, whichever it is by now."""
        self._awaited = False
        if self.isVisible():
            self._taken_s = monotonic()
            self._show(self.microscope.status)

    def _show(self, status: MicroscopeStatus) -> None:
        self.view.show_status(status)
        self._show_readout()

    def _show_readout(self) -> None:
        status, tool = self.view.status, self.view.tool
        said = cursor_text(status, self.view.cursor_at)
        mode = ""
        if tool is not PointerTool.PAN:
            mode = tr("{mode}: Esc ends it   ").format(mode=spoken(tool))
        self.readout.show_text(mode + said)

    def _choose_page(self, page: int) -> None:
        self.tools.setVisible(page < len(self._pages))
        if page < len(self._pages):
            self.tools.setCurrentIndex(page)
        self.refresh(self.workbench.session.snapshot())

    def _use_theme(self, theme: Theme) -> None:
        self.view.set_theme(theme)
        self.picture.set_theme(theme)


def _page(sections: tuple[QWidget, ...]) -> QScrollArea:
    content = QWidget()
    in_column(*sections, 1, on=content, margins=(8, 0, 8, 4), spacing=4)
    return scrolled(content)

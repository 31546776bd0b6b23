"""A z-stack: first, last, step; a TIFF with one page per position."""

from datetime import datetime
from pathlib import Path

from PySide6.QtWidgets import QLineEdit

from rotemina.app.cameras.snapshot import Circumstances, write_stack
from rotemina.app.microscope.errors import MicroscopeError
from rotemina.app.microscope.focus_run import Search
from rotemina.app.microscope.microscope import Microscope
from rotemina.app.microscope.stack_run import StackStatus
from rotemina.app.microscope.status import MicroscopeStatus
from rotemina.app.motion.state import SessionState
from rotemina.app.shell.engine_words import spoken
from rotemina.app.shell.workbench import Level, Workbench
from rotemina.app.widgets.controls import allow, button, named, plain_tip
from rotemina.app.widgets.labels import show_text
from rotemina.app.widgets.section import Section
from rotemina.app.widgets.wheel_safe import SteadyChoice
from rotemina.plugins.microscope import tr
from rotemina.plugins.microscope.feed_notice import against_moving
from rotemina.plugins.microscope.picture_saving import STAMP, circumstances, make_folder
from rotemina.plugins.microscope.words import focus_name
from rotemina.sim.quantities import parsed, rounded

_REACH_M, _STEP_M = 10e-6, 1e-6


class StackSection(Section):
    """The focus goes from the first place to the last and back; the file is written then."""

    def __init__(self, workbench: Workbench, microscope: Microscope) -> None:
        super().__init__(tr("Z-stack"))
        self._workbench, self._microscope = workbench, microscope
        self._status, self._state = MicroscopeStatus(), workbench.session.snapshot()
        self._taken: StackStatus | None = None  # whose file was begun
        self._folder = workbench.operation.data / "pictures"
        self.place = SteadyChoice(tr("Drive that moves the focus"), letters=6)
        self.place.activated.connect(lambda _: self._suggest())
        self.first, self.last, self.step = (
            _field(tr("first, µm"), tr("First position, µm, within the range of the drive")),
            _field(tr("last, µm"), tr("Last position, µm, within the range of the drive")),
            _field(tr("step, µm"), tr("Step from picture to picture, above 0 µm")),
        )
        self.step.setText(rounded(1e6 * _STEP_M))
        self.take = button(tr("Take stack"), self._take)
        self.column.addWidget(self.place)
        self.add_row(self.first, self.last, self.step)
        self.add_row(self.take)
        self.said = self.add_text()

    @property
    def needed(self) -> bool:
        """Whether a stack is under way, or done and not written yet."""
        run = self._microscope.adjustments.stacking
        return run is not None and run.status is not self._taken and not _failed(run.status)

    def write(self, status: MicroscopeStatus, state: SessionState) -> None:
        """Write a stack that is done, also while nobody looks here."""
        self._status, self._state = status, state
        stack = status.stacking
        if stack is not None and stack.search is Search.DONE and stack is not self._taken:
            self._taken = stack
            self._write(stack)

    def refresh(self, status: MicroscopeStatus, state: SessionState) -> None:
        """Show how a stack continues."""
        names = [one.name for one in status.focus_axes]
        if names != [self.place.itemData(row) for row in range(self.place.count())]:
            self.place.clear()
            for name in names:
                self.place.addItem(name, name)
            self._suggest()
        for row, one in enumerate(status.focus_axes):
            self.place.setItemText(row, focus_name(one))
        none = (
            None
            if names
            else tr("no focus drive is available: open a camera or connect the machine")
        )
        allow(
            self.take,
            none or against_moving(status, state),
            tr("Take a picture at each position and return"),
        )
        show_text(self.said, _text(status.stacking))

    def _suggest(self) -> None:
        """Offer places about where the focus is."""
        name = self.place.currentData()
        at = next((one.position for one in self._status.focus_axes if one.name == name), None)
        if at is not None:
            self.first.setText(rounded(1e6 * (at - _REACH_M), 7))
            self.last.setText(rounded(1e6 * (at + _REACH_M), 7))

    def _take(self) -> None:
        name = self.place.currentData()
        self._workbench.ask(
            lambda: self._microscope.adjustments.stack(
                name, *(_metres(field) for field in (self.first, self.last, self.step))
            )
        )

    def _write(self, stack: StackStatus) -> None:
        now = datetime.now().astimezone()
        about = circumstances(self._status, self._state, now)
        path = self._folder / f"{now.strftime(STAMP)}_stack.tif"
        self._workbench.work(
            f"z-stack {path.name}",
            tr("Writing a z-stack …"),
            lambda: _write(path, stack, about),
            lambda _: self._workbench.notify(
                Level.GOOD,
                tr("Saved {path}, {count} pictures").format(path=path, count=stack.total),
            ),
        )


def _write(path: Path, stack: StackStatus, about: Circumstances) -> None:
    make_folder(path.parent)
    write_stack(path, stack.pages, stack.axis, about)


def _metres(field: QLineEdit) -> float:
    number = parsed(field.text())
    if number is None:
        raise MicroscopeError(
            tr("{name}: {text!r} is not a number; enter one in µm").format(
                name=field.accessibleName(), text=field.text().strip()
            )
        )
    return 1e-6 * number


def _failed(stack: StackStatus) -> bool:
    return stack.search is Search.FAILED


def _text(stack: StackStatus | None) -> str:
    if stack is None:
        return ""
    if _failed(stack):
        return tr("Failed: {reason}").format(reason=spoken(stack.reason))
    return tr("{done} of {total} pictures").format(done=stack.done, total=stack.total)


def _field(hint: str, name: str) -> QLineEdit:
    field = named(QLineEdit(), name, plain_tip(name))
    field.setPlaceholderText(hint)
    return field

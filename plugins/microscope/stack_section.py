"""Z-stack from a first to a last position, saved as a TIFF with one page per position."""

from datetime import datetime
from pathlib import Path

from PySide6.QtWidgets import QLineEdit

from rotemina.app.cameras import SnapshotMetadata, write_stack
from rotemina.app.errors import MicroscopeError
from rotemina.app.language import translate_message
from rotemina.app.microscope import Microscope, MicroscopeRunState, MicroscopeStatus, StackStatus
from rotemina.app.motion.state import SessionState
from rotemina.app.widgets.controls import (
    WheelSafeComboBox,
    enable_unless,
    make_button,
    make_tooltip,
    name_widget,
)
from rotemina.app.widgets.layout import Section
from rotemina.app.widgets.text import show_or_hide_text
from rotemina.app.workbench import Level, Workbench
from rotemina.plugins.microscope import tr
from rotemina.plugins.microscope.feed_notice import find_motion_objection
from rotemina.plugins.microscope.picture_saving import (
    TIME_STAMP_FORMAT,
    make_circumstances,
    make_folder,
)
from rotemina.plugins.microscope.words import describe_focus_axis
from rotemina.sim.messages import format_rounded, parse_number

_DEFAULT_HALF_RANGE_M, _DEFAULT_STEP_M = 10e-6, 1e-6


class StackSection(Section):
    """Section to take a z-stack.

    The drive moves from the first position to the last and back. Then the file is written.
    """

    def __init__(self, workbench: Workbench, microscope: Microscope) -> None:
        super().__init__(tr("Z-stack"))
        self._workbench, self._microscope = workbench, microscope
        self._status, self._state = MicroscopeStatus(), workbench.session.snapshot()
        # The latest stack that has been or is being written to a file.
        self._written_stack: StackStatus | None = None
        self._folder = workbench.operation.data / "pictures"
        self.drive_choice = WheelSafeComboBox(tr("Drive that moves the focus"), letters=6)
        self.drive_choice.activated.connect(lambda _: self._suggest_range())
        self.first, self.last, self.step = (
            _make_field(tr("first, µm"), tr("First position, µm, within the range of the drive")),
            _make_field(tr("last, µm"), tr("Last position, µm, within the range of the drive")),
            _make_field(tr("step, µm"), tr("Step from picture to picture, above 0 µm")),
        )
        self.step.setText(format_rounded(1e6 * _DEFAULT_STEP_M))
        self.take = make_button(tr("Take stack"), self._start_stack)
        self.column.addWidget(self.drive_choice)
        self.add_row(self.first, self.last, self.step)
        self.add_row(self.take)
        self.status_label = self.add_text()

    @property
    def is_needed(self) -> bool:
        """Whether a stack is running, or finished but not written yet."""
        run = self._microscope.procedures.stack_run
        return (
            run is not None
            and run.status is not self._written_stack
            and not _has_failed(run.status)
        )

    def write(self, status: MicroscopeStatus, state: SessionState) -> None:
        """Write a finished stack, even while the section is hidden."""
        self._status, self._state = status, state
        stack = status.stack_status
        if (
            stack is not None
            and stack.state is MicroscopeRunState.DONE
            and stack is not self._written_stack
        ):
            self._written_stack = stack
            self._write_in_background(stack)

    def refresh(self, status: MicroscopeStatus, state: SessionState) -> None:
        """Show the drives and the progress of the stack."""
        names = [axis.name for axis in status.focus_axes]
        if names != [self.drive_choice.itemData(row) for row in range(self.drive_choice.count())]:
            self.drive_choice.clear()
            for name in names:
                self.drive_choice.addItem(name, name)
            self._suggest_range()
        for row, axis in enumerate(status.focus_axes):
            self.drive_choice.setItemText(row, describe_focus_axis(axis))
        drive_objection = (
            None
            if names
            else tr("no focus drive is available: open a camera or connect the machine")
        )
        enable_unless(
            self.take,
            drive_objection or find_motion_objection(status, state),
            tr("Take a picture at each position and return"),
        )
        show_or_hide_text(self.status_label, _describe_progress(status.stack_status))

    def _suggest_range(self) -> None:
        name = self.drive_choice.currentData()
        position = next(
            (axis.position for axis in self._status.focus_axes if axis.name == name), None
        )
        if position is not None:
            self.first.setText(format_rounded(1e6 * (position - _DEFAULT_HALF_RANGE_M), 7))
            self.last.setText(format_rounded(1e6 * (position + _DEFAULT_HALF_RANGE_M), 7))

    def _start_stack(self) -> None:
        name = self.drive_choice.currentData()
        self._workbench.run_request(
            lambda: self._microscope.procedures.take_stack(
                name, *(_read_metres(field) for field in (self.first, self.last, self.step))
            )
        )

    def _write_in_background(self, stack: StackStatus) -> None:
        now = datetime.now().astimezone()
        metadata = make_circumstances(self._status, self._state, now)
        path = self._folder / f"{now.strftime(TIME_STAMP_FORMAT)}_stack.tif"
        self._workbench.work(
            f"z-stack {path.name}",
            tr("Writing a z-stack …"),
            lambda: _write_file(path, stack, metadata),
            lambda _: self._workbench.notify(
                Level.GOOD,
                tr("Saved {path}, {count} pictures").format(path=path, count=stack.total),
            ),
        )


def _write_file(path: Path, stack: StackStatus, metadata: SnapshotMetadata) -> None:
    make_folder(path.parent)
    write_stack(path, stack.pages, stack.axis, metadata)


def _read_metres(field: QLineEdit) -> float:
    number = parse_number(field.text())
    if number is None:
        raise MicroscopeError(
            tr("{name}: {text!r} is not a number; enter one in µm").format(
                name=field.accessibleName(), text=field.text().strip()
            )
        )
    return 1e-6 * number


def _has_failed(stack: StackStatus) -> bool:
    return stack.state is MicroscopeRunState.FAILED


def _describe_progress(stack: StackStatus | None) -> str:
    if stack is None:
        return ""
    if _has_failed(stack):
        return tr("Failed: {reason}").format(reason=translate_message(stack.reason))
    text = tr("{done} of {total} pictures").format(done=stack.done, total=stack.total)
    return f"{text}: {translate_message(stack.reason)}" if stack.reason else text


def _make_field(hint: str, name: str) -> QLineEdit:
    field = name_widget(QLineEdit(), name, make_tooltip(name))
    field.setPlaceholderText(hint)
    return field

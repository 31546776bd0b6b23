"""Sections for moves by a click in the picture, and for visits to marked targets."""

from collections.abc import Callable

from PySide6.QtWidgets import QListWidget

from rotemina.app.language import translate_message
from rotemina.app.microscope import Microscope, MicroscopeActivity, MicroscopeStatus
from rotemina.app.motion.device import OPERATOR
from rotemina.app.motion.state import SessionState
from rotemina.app.widgets.controls import (
    WheelSafeComboBox,
    enable_unless,
    make_button,
    name_widget,
)
from rotemina.app.widgets.layout import Section
from rotemina.app.widgets.text import show_or_hide_text
from rotemina.app.workbench import Workbench
from rotemina.plugins.microscope import mark, tr
from rotemina.plugins.microscope.feed_notice import find_click_objection
from rotemina.plugins.microscope.overlays import describe_planned_move
from rotemina.plugins.microscope.words import describe_target, describe_visit

STAGE_CHOICES = ((mark("nano, else micro"), None), (mark("micro"), "micro"), (mark("nano"), "nano"))


class MoveSection(Section):
    """Section with the stage that a click moves, buttons to go back and stop, and the outcome."""

    def __init__(self, workbench: Workbench, microscope: Microscope) -> None:
        super().__init__(tr("Click to move"))
        self._guide = self.add_text()
        self._guide.setText(
            tr(
                "With Move, above the picture, a click or a drag sends the tip there. Esc "
                "or any stop ends this mode."
            )
        )
        self.stage = WheelSafeComboBox(
            tr("Stage that a click moves"),
            tr("Stage that a click moves; nano within its range"),
            letters=6,
        )
        for text, value in STAGE_CHOICES:
            self.stage.addItem(tr(text), value)
        self.column.addWidget(self.stage)
        self.back = make_button(tr("Go back"), lambda: workbench.run_request(microscope.go_back))
        self.stop = make_button(tr("Stop"), lambda: microscope.stop(by=OPERATOR))
        self.add_row(self.back, self.stop)
        self.status_label = self.add_text()

    def refresh(self, status: MicroscopeStatus, state: SessionState) -> None:
        """Show the outcome of the latest move."""
        motion_objection = (
            tr("the machine is not at rest") if state.queued or state.owners else state.lock_reason
        )
        enable_unless(
            self.back, motion_objection, tr("Return to the position before the latest move")
        )
        stop_objection = (
            tr("no move is running") if status.activity is MicroscopeActivity.NONE else None
        )
        enable_unless(self.stop, stop_objection, tr("Stop the machine in place"))
        lines = (
            describe_planned_move(status),
            describe_visit(status.visit_status),
            translate_message(status.abort_reason),
        )
        show_or_hide_text(self.status_label, "\n".join(line for line in lines if line))


class TargetSection(Section):
    """Section with the list of targets in the order in which they were marked."""

    def __init__(
        self, workbench: Workbench, microscope: Microscope, visit: Callable[[], object]
    ) -> None:
        super().__init__(tr("Targets"))
        self._workbench, self._microscope = workbench, microscope
        self.list = name_widget(QListWidget(), tr("Targets, in order"))
        self.list.setMaximumHeight(120)
        self.column.addWidget(self.list)
        self.next = make_button(tr("Visit next"), visit)
        self.next.setProperty("primary", True)
        self.remove = make_button(tr("Remove"), self._remove)
        self.clear = make_button(
            tr("Clear"), lambda: workbench.run_request(microscope.positioning.target_sequence.clear)
        )
        self.column.addWidget(self.next)
        self.add_row(self.remove, self.clear)

    def refresh(self, status: MicroscopeStatus, state: SessionState) -> None:
        """Show the list, and enable the actions that are possible now."""
        texts = [
            describe_target(number, target) for number, target in enumerate(status.targets, start=1)
        ]
        if texts != [self.list.item(row).text() for row in range(self.list.count())]:
            row = self.list.currentRow()
            self.list.clear()
            self.list.addItems(texts)
            self.list.setCurrentRow(min(row, len(texts) - 1))
        list_objection = None if texts else tr("no target is marked; use Mark above the picture")
        visit_objection = list_objection or find_click_objection(status, state)
        if visit_objection is None and all(target.visit is not None for target in status.targets):
            visit_objection = tr("every target has been visited")
        enable_unless(self.next, visit_objection, tr("Send the tip to the first unvisited target"))
        selection_objection = None if self.list.currentRow() >= 0 else tr("no target is selected")
        visiting = status.activity is MicroscopeActivity.TARGETS
        visiting_objection = tr("the tip is on its way to a target") if visiting else None
        enable_unless(
            self.remove,
            list_objection or selection_objection or visiting_objection,
            tr("Delete the selected target"),
        )
        enable_unless(self.clear, list_objection or visiting_objection, tr("Delete all targets"))

    def _remove(self) -> None:
        row = self.list.currentRow()
        self._workbench.run_request(
            lambda: self._microscope.positioning.target_sequence.remove(row)
        )

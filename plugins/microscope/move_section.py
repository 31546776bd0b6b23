"""Moves by click: preview, way back, and targets to visit."""

from collections.abc import Callable

from PySide6.QtWidgets import QListWidget

from rotemina.app.microscope.microscope import Microscope
from rotemina.app.microscope.status import Activity, MicroscopeStatus
from rotemina.app.motion.ownership import OPERATOR
from rotemina.app.motion.state import SessionState
from rotemina.app.shell.engine_words import spoken
from rotemina.app.shell.workbench import Workbench
from rotemina.app.widgets.controls import allow, button, named
from rotemina.app.widgets.labels import show_text
from rotemina.app.widgets.section import Section
from rotemina.app.widgets.wheel_safe import SteadyChoice
from rotemina.plugins.microscope import mark, tr
from rotemina.plugins.microscope.feed_notice import against_clicking
from rotemina.plugins.microscope.overlays import ghost_text
from rotemina.plugins.microscope.words import target_text, visit_text

STAGES = ((mark("nano, else micro"), None), (mark("micro"), "micro"), (mark("nano"), "nano"))


class MoveSection(Section):
    """The stage that clicks move, what the latest click came to, and back again."""

    def __init__(self, workbench: Workbench, microscope: Microscope) -> None:
        super().__init__(tr("Click to move"))
        self._guide = self.add_text()
        self._guide.setText(
            tr(
                "With Move, above the picture, a click or a drag sends the tip there. Esc "
                "or any stop ends this mode."
            )
        )
        self.stage = SteadyChoice(
            tr("Stage that a click moves"),
            tr("Stage that a click moves; nano within its range"),
            letters=6,
        )
        for text, value in STAGES:
            self.stage.addItem(tr(text), value)
        self.column.addWidget(self.stage)
        self.back = button(tr("Go back"), lambda: workbench.ask(microscope.go_back))
        self.halt = button(tr("Stop"), lambda: microscope.stop(by=OPERATOR))
        self.add_row(self.back, self.halt)
        self.said = self.add_text()

    def refresh(self, status: MicroscopeStatus, state: SessionState) -> None:
        """Show what the latest move came to."""
        busy = tr("the machine is not at rest") if state.queued or state.owners else state.locked
        allow(self.back, busy, tr("Return to the position before the latest move"))
        idle = tr("no move is running") if status.activity is Activity.NONE else None
        allow(self.halt, idle, tr("Stop the machine in place"))
        lines = (ghost_text(status), visit_text(status.visiting), spoken(status.stopped))
        show_text(self.said, "\n".join(line for line in lines if line))


class TargetSection(Section):
    """Targets in the order in which they were marked."""

    def __init__(
        self, workbench: Workbench, microscope: Microscope, visit: Callable[[], object]
    ) -> None:
        super().__init__(tr("Targets"))
        self._workbench, self._microscope = workbench, microscope
        self.list = named(QListWidget(), tr("Targets, in order"))
        self.list.setMaximumHeight(120)
        self.column.addWidget(self.list)
        self.next = button(tr("Visit next"), visit)
        self.next.setProperty("primary", True)
        self.remove = button(tr("Remove"), self._remove)
        self.clear = button(
            tr("Clear"), lambda: workbench.ask(microscope.positioning.sequence.clear)
        )
        self.column.addWidget(self.next)
        self.add_row(self.remove, self.clear)

    def refresh(self, status: MicroscopeStatus, state: SessionState) -> None:
        """Show the list."""
        texts = [target_text(number, one) for number, one in enumerate(status.targets, start=1)]
        if texts != [self.list.item(row).text() for row in range(self.list.count())]:
            row = self.list.currentRow()
            self.list.clear()
            self.list.addItems(texts)
            self.list.setCurrentRow(min(row, len(texts) - 1))
        none = None if texts else tr("no target is marked; use Mark above the picture")
        why = none or against_clicking(status, state)
        if why is None and all(one.visit is not None for one in status.targets):
            why = tr("every target has been visited")
        allow(self.next, why, tr("Send the tip to the first unvisited target"))
        chosen = None if self.list.currentRow() >= 0 else tr("no target is selected")
        visiting = status.activity is Activity.TARGETS
        under_way = tr("the tip is on its way to a target") if visiting else None
        allow(self.remove, none or chosen or under_way, tr("Delete the selected target"))
        allow(self.clear, none or under_way, tr("Delete all targets"))

    def _remove(self) -> None:
        row = self.list.currentRow()
        self._workbench.ask(lambda: self._microscope.positioning.sequence.remove(row))

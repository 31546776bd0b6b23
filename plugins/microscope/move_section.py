"""Moves by clicks: what a click would do, the way back, and targets to visit."""

from collections.abc import Callable

from PySide6.QtWidgets import QListWidget

from rotemina.app.microscope.microscope import Microscope
from rotemina.app.microscope.sight import Activity, Sight
from rotemina.app.motion.state import SessionState
from rotemina.app.shell.controls import allow, plain_tip
from rotemina.app.shell.workbench import Workbench
from rotemina.plugins.microscope.overlays import ghost_text
from rotemina.plugins.microscope.section import Section, SteadyChoice, button, show_text
from rotemina.plugins.microscope.standing import against_clicking
from rotemina.plugins.microscope.words import target_text, visit_text

STAGES = (("nano, else micro", None), ("micro", "micro"), ("nano", "nano"))


class MoveSection(Section):
    """The stage that clicks move, what the latest click came to, and back again."""

    def __init__(self, workbench: Workbench, microscope: Microscope) -> None:
        super().__init__("Click to move")
        self._guide = self.add_text()
        self._guide.setText(
            "Move, above the picture, lets a click or a drag send the tip there. Esc, or any stop, "
            "ends that."
        )
        self.stage = SteadyChoice("Stage that a click moves")
        for text, value in STAGES:
            self.stage.addItem(text, value)
        self.stage.setToolTip(plain_tip("The stage that a click moves; nano where it reaches"))
        self.column.addWidget(self.stage)
        self.back = button("Go back", lambda: workbench.ask(microscope.go_back))
        self.halt = button("Stop", lambda: workbench.ask(microscope.stop))
        self.add_row(self.back, self.halt)
        self.said = self.add_text()

    def refresh(self, sight: Sight, state: SessionState) -> None:
        """Show what the latest move came to."""
        busy = "the machine is not at rest" if state.queued or state.owners else state.locked
        allow(self.back, busy, "Return to where the machine rested before its latest move")
        idle = "nothing is under way" if sight.activity is Activity.NONE else None
        allow(self.halt, idle, "Stop the machine where it is")
        lines = (ghost_text(sight), visit_text(sight.visiting), sight.stopped)
        show_text(self.said, "\n".join(line for line in lines if line))


class TargetSection(Section):
    """Targets in the order in which they were marked."""

    def __init__(
        self, workbench: Workbench, microscope: Microscope, visit: Callable[[], object]
    ) -> None:
        super().__init__("Targets")
        self._workbench, self._microscope = workbench, microscope
        self.list = QListWidget()
        self.list.setAccessibleName("Targets, in order")
        self.list.setMaximumHeight(120)
        self.column.addWidget(self.list)
        self.next = button("Visit next", visit)
        self.next.setProperty("primary", True)
        self.remove = button("Remove", self._remove)
        self.clear = button("Clear", lambda: workbench.ask(microscope.clear_targets))
        self.column.addWidget(self.next)
        self.add_row(self.remove, self.clear)

    def refresh(self, sight: Sight, state: SessionState) -> None:
        """Show the list."""
        texts = [target_text(number, one) for number, one in enumerate(sight.targets, start=1)]
        if texts != [self.list.item(row).text() for row in range(self.list.count())]:
            row = self.list.currentRow()
            self.list.clear()
            self.list.addItems(texts)
            self.list.setCurrentRow(min(row, len(texts) - 1))
        none = None if texts else "no target is marked; mark some with Mark, above the picture"
        why = none or against_clicking(sight, state)
        if why is None and all(one.visit is not None for one in sight.targets):
            why = "every target has been visited"
        allow(self.next, why, "Send the tip to the first target that was not visited")
        chosen = None if self.list.currentRow() >= 0 else "no target is chosen"
        touring = sight.activity is Activity.TOUR
        under_way = "the tip is on its way to a target" if touring else None
        allow(self.remove, none or chosen or under_way, "Forget the chosen target")
        allow(self.clear, none or under_way, "Forget all targets")

    def _remove(self) -> None:
        row = self.list.currentRow()
        self._workbench.ask(lambda: self._microscope.remove_target(row))

"""The two buttons of the penetration, as in its own panel, and its progress."""

import time

from PySide6.QtWidgets import QSizePolicy

from rotemina.app.motion.state import SessionState
from rotemina.app.shell.engine_words import spoken
from rotemina.app.shell.workbench import Workbench
from rotemina.app.widgets.controls import plain_tip
from rotemina.app.widgets.labels import plain_text
from rotemina.app.widgets.layouts import in_column, in_row
from rotemina.drivers.clock import Clock
from rotemina.plugins.control import tr
from rotemina.plugins.penetration.plan_preview import PlanPreview
from rotemina.plugins.penetration.run_bar import RunButtons
from rotemina.plugins.penetration.words import message


class PenetrationPage(RunButtons):
    """Arm with the parameters that the Penetration panel holds; start, stop, retract."""

    def __init__(self, workbench: Workbench, clock: Clock = time.monotonic) -> None:
        super().__init__(workbench, clock)
        self._plan_preview: PlanPreview | None = None
        self._planned_for: object = None
        self.arm.setToolTip(tr("Prepare the penetration without motion"))
        self.button.setToolTip(tr("Start the armed penetration"))
        self.message = plain_text(lines=3)
        self.parameters = plain_text()
        self.phase.setMinimumSize(130, 22)
        self.phase.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        row = in_row((self.arm, 1), (self.button, 2), spacing=6)
        parts = row, self.phase, self.message, self.parameters, 1
        in_column(*parts, on=self, margins=(10, 6, 10, 4), spacing=4)

    def refresh(self, state: SessionState) -> None:
        """Show a moment, and lock what cannot be done now."""
        status = self._operation.penetration.status
        against = self.show_status(status, state, lambda: self._against_arming(state))
        told = message(status, against)
        if told != self.message.text():
            self.message.setText(told)
            self.message.setToolTip(plain_tip(told))
        axis = self._operation.penetration_parameters.axis
        told = tr("Axis {axis}; parameters: see the Penetration panel.").format(axis=axis)
        if told != self.parameters.text():
            self.parameters.setText(told)

    def _against_arming(self, state: SessionState) -> str | None:
        session, parameters = self._workbench.session, self._operation.penetration_parameters
        if self._plan_preview is None or self._planned_for != (parameters, session.driver):
            self._planned_for = (parameters, session.driver)
            self._plan_preview = PlanPreview.of(session, parameters)
        if self._plan_preview.plan is None:
            return self._plan_preview.problem
        if state.locked is not None:
            return tr("motion is locked: {locked}").format(locked=spoken(state.locked))
        return self._operation.penetration.why_not(parameters, self._plan_preview.plan)

    def _ask_to_arm(self) -> None:
        operation, parameters = self._operation, self._operation.penetration_parameters
        self._workbench.ask(lambda: operation.arm_penetration(parameters))

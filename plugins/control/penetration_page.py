"""Page with the two buttons of the Penetration panel and the state of the penetration."""

import time

from PySide6.QtWidgets import QSizePolicy

from rotemina.app.language import translate_message
from rotemina.app.motion.state import SessionState
from rotemina.app.widgets.controls import make_tooltip
from rotemina.app.widgets.layout import make_column, make_row
from rotemina.app.widgets.text import make_plain_label
from rotemina.app.workbench import Workbench
from rotemina.drivers.contract import Clock
from rotemina.plugins.control import tr
from rotemina.plugins.penetration import PlanPreview, RunButtons, describe_status


class PenetrationPage(RunButtons):
    """Page that arms and runs a penetration with the parameters of the Penetration panel."""

    def __init__(self, workbench: Workbench, clock: Clock = time.monotonic) -> None:
        super().__init__(workbench, clock)
        self._plan_preview: PlanPreview | None = None
        self._preview_inputs: object = None
        self.arm.setToolTip(tr("Prepare the penetration without motion"))
        self.main_button.setToolTip(tr("Start the armed penetration"))
        self.message = make_plain_label(lines=3)
        self.parameters = make_plain_label()
        self.phase.setMinimumSize(130, 22)
        self.phase.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        row = make_row((self.arm, 1), (self.main_button, 2), spacing=6)
        parts = row, self.phase, self.message, self.parameters, 1
        make_column(*parts, on=self, margins=(10, 6, 10, 4), spacing=4)

    def refresh(self, state: SessionState) -> None:
        """Show the state of the penetration, and enable or disable the buttons."""
        status = self._operation.penetration.status
        objection = self.show_status(status, state, lambda: self._find_arm_objection(state))
        text = describe_status(status, objection)
        if text != self.message.text():
            self.message.setText(text)
            self.message.setToolTip(make_tooltip(text))
        axis = self._operation.penetration_parameters.axis
        text = tr("Axis {axis}; parameters: see the Penetration panel.").format(axis=axis)
        if text != self.parameters.text():
            self.parameters.setText(text)

    def _find_arm_objection(self, state: SessionState) -> str | None:
        session, parameters = self._workbench.session, self._operation.penetration_parameters
        if self._plan_preview is None or self._preview_inputs != (parameters, session.driver):
            self._preview_inputs = (parameters, session.driver)
            self._plan_preview = PlanPreview.plan_for_session(session, parameters)
        if self._plan_preview.plan is None:
            return self._plan_preview.problem
        if state.lock_reason is not None:
            return tr("motion is locked: {locked}").format(
                locked=translate_message(state.lock_reason)
            )
        return self._operation.penetration.find_refusal_reason(parameters, self._plan_preview.plan)

    def _ask_to_arm(self) -> None:
        operation, parameters = self._operation, self._operation.penetration_parameters
        self._workbench.run_request(lambda: operation.arm_penetration(parameters))

"""Direct output of an amplifier voltage for service, after a question and at rest."""

from functools import partial

from PySide6.QtCore import Qt

from rotemina.app.display_units import axis_scale, label
from rotemina.app.motion.state import SessionState
from rotemina.app.shell.workbench import Workbench
from rotemina.app.widgets.controls import allow, button, named
from rotemina.app.widgets.inline_question import Question
from rotemina.app.widgets.section import Section
from rotemina.app.widgets.wheel_safe import SteadyChoice, SteadyNumber
from rotemina.plugins.connection import tr, unavailable_reasons
from rotemina.sim.quantities import exact
from rotemina.sim.robot.model import PiezoAxis


class VoltageSection(Section):
    """An axis, a voltage, and the button that asks; hidden where no axis has an amplifier."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(tr("Amplifier voltage"))
        self._workbench = workbench
        self._axes = {
            name: axis
            for name, axis in workbench.robot.axes.items()
            if isinstance(axis, PiezoAxis) and axis.voltage_range and axis.controller is None
        }
        self.axis = SteadyChoice(tr("Axis of the amplifier"))
        self.axis.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        for name in self._axes:
            self.axis.addItem(label(name), name)
        self.volts = named(SteadyNumber(), tr("Voltage"))
        self.volts.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.volts.setDecimals(2)
        self.volts.setSuffix(" V")
        self.apply = button(tr("Apply …"), self._ask)
        self.question = Question()
        self.column.addWidget(self.question)  # above what asks it, which is in sight
        self.add_row(self.axis, self.volts, self.apply)
        self.axis.currentIndexChanged.connect(self._choose)
        self.volts.valueChanged.connect(self.question.hide)
        self._choose()
        if not self._axes:
            self.hide()

    def refresh(self, state: SessionState) -> None:
        """Show a state."""
        why = unavailable_reasons.against_voltage(state, self._workbench.session.driver)
        tip = tr("For service: apply this voltage slowly, regardless of the position")
        for widget in (self.axis, self.apply):
            allow(widget, why, tip)
        bounds = tr("{low} to {high} V").format(
            low=exact(self.volts.minimum(), ""), high=exact(self.volts.maximum(), "")
        )
        allow(self.volts, why, f"{tip}; {bounds}")
        if why is not None:
            self.question.hide()  # the machine has overtaken it

    def _choose(self) -> None:
        self.question.hide()
        axis = self._axes.get(self.axis.currentData())
        if axis is not None and axis.voltage_range is not None:
            self.volts.setRange(*axis.voltage_range)

    def _ask(self) -> None:
        name, volts = self.axis.currentData(), self.volts.value()
        scale = axis_scale(self._axes[name])
        self.question.ask(
            tr("Apply {volts:g} V to {axis}? The axis moves slowly to about {position}.").format(
                volts=volts, axis=label(name), position=scale.text(volts * self._axes[name].gain)
            ),
            tr("Apply"),
            partial(self._workbench.set_voltage, name, volts),
        )

"""Section that sets an amplifier voltage directly, for servicing.

This is allowed only at rest, and after a confirmation.
"""

from functools import partial

from PySide6.QtCore import Qt

from rotemina.app.language import choose_axis_scale, get_axis_label
from rotemina.app.motion.state import SessionState
from rotemina.app.widgets.controls import (
    WheelSafeComboBox,
    WheelSafeSpinBox,
    enable_unless,
    make_button,
    name_widget,
)
from rotemina.app.widgets.layout import InlineQuestion, Section
from rotemina.app.workbench import Workbench
from rotemina.plugins.connection import tr, unavailable_reasons
from rotemina.sim.robot import PiezoAxis
from rotemina.sim.units import format_exact


class ServiceVoltageSection(Section):
    """Section that sets the amplifier voltage of an axis after a confirmation.

    It is hidden if the robot has no amplifier that the program drives directly.
    """

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(tr("Amplifier voltage"))
        self._workbench = workbench
        self._axes = {
            name: axis
            for name, axis in workbench.robot.axes.items()
            if isinstance(axis, PiezoAxis) and axis.voltage_range and axis.controller is None
        }
        self.axis = WheelSafeComboBox(tr("Axis driven by the amplifier"))
        self.axis.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        for name in self._axes:
            self.axis.addItem(get_axis_label(name), name)
        self.volts = name_widget(WheelSafeSpinBox(), tr("Voltage"))
        self.volts.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.volts.setDecimals(2)
        self.volts.setSuffix(" V")
        self.apply_button = make_button(tr("Apply …"), self._ask_to_apply)
        self.question = InlineQuestion()
        # The question is above the button that opens it, where it is certain to be visible.
        self.column.addWidget(self.question)
        self.add_row(self.axis, self.volts, self.apply_button)
        self.axis.currentIndexChanged.connect(self._on_axis_chosen)
        self.volts.valueChanged.connect(self.question.hide)
        self._on_axis_chosen()
        if not self._axes:
            self.hide()

    def refresh(self, state: SessionState) -> None:
        """Disable the fields while no voltage can be set."""
        objection = unavailable_reasons.find_voltage_objection(
            state, self._workbench.session.driver
        )
        tooltip = tr("For servicing: ramp the amplifier to this voltage without position feedback")
        for widget in (self.axis, self.apply_button):
            enable_unless(widget, objection, tooltip)
        bounds = tr("{low} to {high} V").format(
            low=format_exact(self.volts.minimum(), ""), high=format_exact(self.volts.maximum(), "")
        )
        enable_unless(self.volts, objection, f"{tooltip}; {bounds}")
        if objection is not None:
            # The machine has left the state in which the operator was asked to confirm.
            self.question.hide()

    def _on_axis_chosen(self) -> None:
        self.question.hide()
        axis = self._axes.get(self.axis.currentData())
        if axis is not None and axis.voltage_range is not None:
            self.volts.setRange(*axis.voltage_range)

    def _ask_to_apply(self) -> None:
        name, volts = self.axis.currentData(), self.volts.value()
        scale = choose_axis_scale(self._axes[name])
        self.question.ask(
            tr("Apply {volts:g} V to {axis}? The axis moves slowly to about {position}.").format(
                volts=volts,
                axis=get_axis_label(name),
                position=scale.format_with_unit(volts * self._axes[name].gain),
            ),
            tr("Apply"),
            partial(self._workbench.set_voltage, name, volts),
        )

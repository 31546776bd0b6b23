"""Page that sets the range of targets and the one-sided approach of an axis."""

from PySide6.QtWidgets import QLabel, QLineEdit, QWidget

from rotemina.app.language import choose_axis_scale, get_axis_label
from rotemina.app.motion.session import (
    WIDTH_TO_PLAY_RATIO,
    OneSidedApproach,
    find_measured_backlash,
    store_ranges,
)
from rotemina.app.motion.state import SessionState
from rotemina.app.widgets.controls import (
    WheelSafeComboBox,
    enable_unless,
    make_button,
    make_tooltip,
)
from rotemina.app.widgets.layout import make_grid
from rotemina.app.widgets.text import make_plain_label, show_or_hide_text
from rotemina.app.workbench import Level, Workbench
from rotemina.plugins.control import tr
from rotemina.plugins.control.wording import explain_invalid_target, parse_target
from rotemina.sim.messages import format_rounded
from rotemina.sim.robot import StepperAxis
from rotemina.sim.units import DisplayScale

# Default overshoot of an approach. It exceeds the backlash of most screws.
_DEFAULT_WIDTH_M = 20e-6


class AxesPage(QWidget):
    """Page that sets the range and the one-sided approach of the chosen axis.

    The fields show the settings in use until the operator types something else.
    """

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self._workbench, self._session = workbench, workbench.session
        self.axis = WheelSafeComboBox(tr("Axis"), tr("Axis whose range and approach are set"))
        for name in workbench.robot.axes:
            self.axis.addItem(get_axis_label(name), name)
        self.axis.currentIndexChanged.connect(lambda _: self._show_settings())
        self.low_field, self.high_field, self.width_field = QLineEdit(), QLineEdit(), QLineEdit()
        self.low_field.setAccessibleName(tr("Low end of the range"))
        self.high_field.setAccessibleName(tr("High end of the range"))
        self.width_field.setAccessibleName(tr("Overshoot of the approach"))
        self.narrow = make_button(tr("Narrow"), self._narrow_range)
        self.restore = make_button(tr("Whole"), self._restore_range)
        self.unit = QLabel()
        self.side = WheelSafeComboBox(tr("Approach"), tr("Side from which targets are approached"))
        for text, rising in (
            (tr("straight"), None),
            (tr("from below"), True),
            (tr("from above"), False),
        ):
            self.side.addItem(text, rising)
        self.side.activated.connect(lambda _: self._set_approach())
        self.low_field.returnPressed.connect(self._narrow_range)
        self.high_field.returnPressed.connect(self._narrow_range)
        self.width_field.returnPressed.connect(self._set_approach)
        self.backlash_text = make_plain_label()
        self.use_backlash = make_button(tr("Use"), self._use_measured_backlash)
        self._lay_out()
        self._show_settings()

    def refresh(self, state: SessionState) -> None:
        """Enable the settings that can be changed in this state, and disable the others."""
        axis, session = self._axis_name, self._session
        objection = state.lock_reason
        if objection is None and not session.at_rest:
            objection = tr("the machine is moving")
        is_narrowed = axis in session.ranges.narrowed_ranges
        enable_unless(self.narrow, objection, tr("Limit the targets of the axis to this range"))
        enable_unless(
            self.restore,
            objection or (None if is_narrowed else tr("its range is not limited")),
            tr("Restore the range of the robot file"),
        )
        if not isinstance(self._workbench.robot.axes[axis], StepperAxis):
            objection = tr("only stepper axes have backlash")
        enable_unless(self.side, objection, tr("Side from which targets are approached"))
        enable_unless(
            self.width_field,
            objection,
            tr("Distance beyond the target, more than the backlash"),
        )
        self._show_backlash(objection)

    def _show_backlash(self, objection: str | None) -> None:
        """Show the backlash in the model in use, and offer a width that covers it.

        ``objection`` is why the approach cannot be changed, or None.
        """
        backlash, scale = self._backlash, self._scale
        is_stepper = isinstance(self._workbench.robot.axes[self._axis_name], StepperAxis)
        show_or_hide_text(
            self.backlash_text,
            tr("Measured backlash: {play}").format(play=scale.format_with_unit(backlash))
            if is_stepper
            else "",
        )
        self.use_backlash.setVisible(is_stepper)
        no_backlash_reason = None
        if backlash is None:
            no_backlash_reason = tr(
                "the model in use has no backlash of this axis; diagnose the axis first"
            )
        enable_unless(
            self.use_backlash,
            objection or no_backlash_reason,
            tr("Set the width to {factor} × the backlash of the model in use").format(
                factor=format_rounded(WIDTH_TO_PLAY_RATIO)
            ),
        )

    @property
    def _backlash(self) -> float | None:
        model = self._session.model
        return find_measured_backlash(model.nominal, model.effects, self._axis_name)

    def _use_measured_backlash(self) -> None:
        """Enter a width that covers the measured backlash, without changing the side."""
        backlash = self._backlash
        if backlash is not None:
            self.width_field.setText(self._scale.format_value(WIDTH_TO_PLAY_RATIO * backlash))
            if self.side.currentData() is not None:
                self._set_approach()

    @property
    def _axis_name(self) -> str:
        return str(self.axis.currentData())

    def _lay_out(self) -> None:
        grid = make_grid(on=self, margins=(10, 6, 10, 4), spacing=(6, 4), stretched=(1, 3))
        grid.addWidget(self.axis, 0, 0, 1, 2)
        grid.addWidget(self.unit, 0, 2)
        grid.addWidget(self.narrow, 0, 3)
        grid.addWidget(self.restore, 0, 4)
        grid.addWidget(QLabel(tr("Range")), 1, 0)
        grid.addWidget(self.low_field, 1, 1, 1, 2)
        grid.addWidget(self.high_field, 1, 3, 1, 2)
        grid.addWidget(QLabel(tr("Approach")), 2, 0)
        grid.addWidget(self.side, 2, 1, 1, 2)
        grid.addWidget(self.width_field, 2, 3, 1, 2)
        grid.addWidget(self.backlash_text, 3, 0, 1, 4)
        grid.addWidget(self.use_backlash, 3, 4)
        grid.setRowStretch(4, 1)

    def _show_settings(self) -> None:
        axis = self._axis_name
        scale = self._scale
        low, high = self._session.ranges.find_range(axis)
        self.low_field.setText(scale.format_value(low))
        self.high_field.setText(scale.format_value(high))
        full_range = self._workbench.robot.axes[axis].range
        ends = " … ".join(scale.format_with_unit(end) for end in full_range)
        for field in (self.low_field, self.high_field):
            field.setToolTip(make_tooltip(tr("Within {ends}").format(ends=ends)))
        self.unit.setText(f"[{scale.symbol}]")
        approach = self._session.backlash.applied.get(axis)
        self.side.setCurrentIndex(self.side.findData(approach.rising if approach else None))
        self.width_field.setText(
            scale.format_value(approach.width if approach else _DEFAULT_WIDTH_M)
        )

    @property
    def _scale(self) -> DisplayScale:
        return choose_axis_scale(self._workbench.robot.axes[self._axis_name])

    def _read_number(self, field: QLineEdit) -> float | None:
        """Return the number in a field, m or rad, or notify the operator and return None."""
        value = parse_target(field.text(), self._scale)
        if value is None:
            text = explain_invalid_target(self._axis_name, field.text(), self._scale)
            self._workbench.notify(Level.WARNING, text, about=self)
        return value

    def _narrow_range(self) -> None:
        axis, low, high = (
            self._axis_name,
            self._read_number(self.low_field),
            self._read_number(self.high_field),
        )
        if low is None or high is None:
            return
        if self._workbench.run_request(lambda: self._session.ranges.narrow(axis, low, high)):
            self._save_ranges()

    def _restore_range(self) -> None:
        axis = self._axis_name
        if self._workbench.run_request(lambda: self._session.ranges.restore(axis)):
            self._save_ranges()

    def _save_ranges(self) -> None:
        ranges = self._session.ranges.narrowed_ranges
        store_ranges(self._workbench.settings, self._workbench.robot, ranges)
        self._show_settings()

    def _set_approach(self) -> None:
        axis, rising = self._axis_name, self.side.currentData()
        width = self._read_number(self.width_field)
        if width is not None:
            approach = None if rising is None else OneSidedApproach(width, rising)
            self._workbench.run_request(lambda: self._session.backlash.set_approach(axis, approach))
        self._show_settings()

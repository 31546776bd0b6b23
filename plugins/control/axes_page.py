"""Range and approach of one axis."""

from PySide6.QtWidgets import QLabel, QLineEdit, QWidget

from rotemina.app.display_units import axis_scale, label
from rotemina.app.motion.backlash import OVER_PLAY, Approach, play_of
from rotemina.app.motion.state import SessionState
from rotemina.app.range_settings import keep_ranges
from rotemina.app.shell.workbench import Level, Workbench
from rotemina.app.widgets.controls import allow, button, plain_tip
from rotemina.app.widgets.labels import plain_text, show_text
from rotemina.app.widgets.layouts import in_grid
from rotemina.app.widgets.wheel_safe import SteadyChoice
from rotemina.plugins.control import tr
from rotemina.plugins.control.wording import no_position, typed
from rotemina.sim.quantities import Scale, rounded
from rotemina.sim.robot.model import StepperAxis

_USUAL_WIDTH = 20e-6  # m: beyond the play of most screws


class AxesPage(QWidget):
    """Range and approach of the chosen axis; the fields show what is in use until one types."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self._workbench, self._session = workbench, workbench.session
        self.axis = SteadyChoice(tr("Axis"), tr("Axis whose range and approach are set"))
        for name in workbench.robot.axes:
            self.axis.addItem(label(name), name)
        self.axis.currentIndexChanged.connect(lambda _: self._show())
        self.low, self.high, self.width_field = QLineEdit(), QLineEdit(), QLineEdit()
        self.low.setAccessibleName(tr("Low end of the range"))
        self.high.setAccessibleName(tr("High end of the range"))
        self.width_field.setAccessibleName(tr("Overshoot of the approach"))
        self.narrow = button(tr("Narrow"), self._narrow)
        self.whole = button(tr("Whole"), self._restore)
        self.unit = QLabel()
        self.side = SteadyChoice(tr("Approach"), tr("Side from which targets are approached"))
        for text, rising in (
            (tr("straight"), None),
            (tr("from below"), True),
            (tr("from above"), False),
        ):
            self.side.addItem(text, rising)
        self.side.activated.connect(lambda _: self._approach())
        self.low.returnPressed.connect(self._narrow)
        self.high.returnPressed.connect(self._narrow)
        self.width_field.returnPressed.connect(self._approach)
        self.play = plain_text()
        self.use_play = button(tr("Use"), self._use_play)
        self._lay_out()
        self._show()

    def refresh(self, state: SessionState) -> None:
        """Lock what must not be changed now."""
        axis, session = self._axis, self._session
        why = state.locked
        if why is None and not session.at_rest:
            why = tr("the machine is moving")
        narrowed = axis in session.ranges.narrowed
        allow(self.narrow, why, tr("Limit the targets of the axis to this range"))
        allow(
            self.whole,
            why or (None if narrowed else tr("its range is not limited")),
            tr("Restore the range of the robot file"),
        )
        if not isinstance(self._workbench.robot.axes[axis], StepperAxis):
            why = tr("only stepper axes have backlash")
        allow(self.side, why, tr("Side from which targets are approached"))
        allow(self.width_field, why, tr("Distance beyond the target, more than the backlash"))
        self._show_play(why)

    def _show_play(self, why: str | None) -> None:
        """Say what play a diagnosis found, and offer it as the width."""
        play, scale = self._play, self._scale
        stepper = isinstance(self._workbench.robot.axes[self._axis], StepperAxis)
        show_text(
            self.play,
            tr("Measured backlash: {play}").format(play=scale.text(play)) if stepper else "",
        )
        self.use_play.setVisible(stepper)
        none = None
        if play is None:
            none = tr("the model in use has no backlash of this axis; diagnose the axis first")
        allow(
            self.use_play,
            why or none,
            tr("Set the width to {factor} × the backlash of the model in use").format(
                factor=rounded(OVER_PLAY)
            ),
        )

    @property
    def _play(self) -> float | None:
        model = self._session.model
        return play_of(model.nominal, model.effects, self._axis)

    def _use_play(self) -> None:
        """Take the play as the width; from which side is as it was, straight at first."""
        play = self._play
        if play is not None:
            self.width_field.setText(self._scale.number(OVER_PLAY * play))
            if self.side.currentData() is not None:
                self._approach()

    @property
    def _axis(self) -> str:
        return str(self.axis.currentData())

    def _lay_out(self) -> None:
        grid = in_grid(on=self, margins=(10, 6, 10, 4), spacing=(6, 4), stretched=(1, 3))
        grid.addWidget(self.axis, 0, 0, 1, 2)
        grid.addWidget(self.unit, 0, 2)
        grid.addWidget(self.narrow, 0, 3)
        grid.addWidget(self.whole, 0, 4)
        grid.addWidget(QLabel(tr("Range")), 1, 0)
        grid.addWidget(self.low, 1, 1, 1, 2)
        grid.addWidget(self.high, 1, 3, 1, 2)
        grid.addWidget(QLabel(tr("Approach")), 2, 0)
        grid.addWidget(self.side, 2, 1, 1, 2)
        grid.addWidget(self.width_field, 2, 3, 1, 2)
        grid.addWidget(self.play, 3, 0, 1, 4)
        grid.addWidget(self.use_play, 3, 4)
        grid.setRowStretch(4, 1)

    def _show(self) -> None:
        """Write what is in use into the fields."""
        axis = self._axis
        scale = self._scale
        low, high = self._session.ranges.of(axis)
        self.low.setText(scale.number(low))
        self.high.setText(scale.number(high))
        whole = self._workbench.robot.axes[axis].range
        ends = " … ".join(scale.text(end) for end in whole)
        for field in (self.low, self.high):
            field.setToolTip(plain_tip(tr("Within {ends}").format(ends=ends)))
        self.unit.setText(f"[{scale.symbol}]")
        approach = self._session.backlash.applied.get(axis)
        self.side.setCurrentIndex(self.side.findData(approach.rising if approach else None))
        self.width_field.setText(scale.number(approach.width if approach else _USUAL_WIDTH))

    @property
    def _scale(self) -> Scale:
        return axis_scale(self._workbench.robot.axes[self._axis])

    def _number(self, field: QLineEdit) -> float | None:
        """Return what a field says, SI; tell where it is no number."""
        value = typed(field.text(), self._scale)
        if value is None:
            text = no_position(self._axis, field.text(), self._scale)
            self._workbench.notify(Level.WARNING, text, about=self)
        return value

    def _narrow(self) -> None:
        axis, low, high = self._axis, self._number(self.low), self._number(self.high)
        if low is None or high is None:
            return
        if self._workbench.ask(lambda: self._session.ranges.narrow(axis, low, high)):
            self._keep()

    def _restore(self) -> None:
        axis = self._axis
        if self._workbench.ask(lambda: self._session.ranges.restore(axis)):
            self._keep()

    def _keep(self) -> None:
        ranges = self._session.ranges.narrowed
        keep_ranges(self._workbench.settings, self._workbench.robot, ranges)
        self._show()

    def _approach(self) -> None:
        axis, rising = self._axis, self.side.currentData()
        width = self._number(self.width_field)
        if width is not None:
            approach = None if rising is None else Approach(width, rising)
            self._workbench.ask(lambda: self._session.backlash.use(axis, approach))
        self._show()

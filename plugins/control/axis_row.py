"""Row of one axis in the Control panel: readout, range bar, jog buttons and target field."""

import time
from collections.abc import Sequence

from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QKeyEvent, QResizeEvent, QShowEvent
from PySide6.QtWidgets import QFrame, QLabel, QLineEdit, QPushButton

from rotemina.app.language import choose_axis_scale, get_axis_label
from rotemina.app.motion.limits import Range
from rotemina.app.motion.state import SessionState
from rotemina.app.widgets.controls import (
    enable_unless,
    make_tooltip,
    name_widget,
    set_property,
    show_tooltip,
)
from rotemina.app.widgets.layout import make_grid, make_row
from rotemina.app.widgets.text import ElidedLabel, LiveLabel
from rotemina.app.workbench import Level, Workbench
from rotemina.drivers.contract import Clock, DeviceState
from rotemina.plugins.control import tr
from rotemina.plugins.control.hold_to_jog import HoldToJog
from rotemina.plugins.control.large_move_confirmation import LargeMoveConfirmation
from rotemina.plugins.control.readout import PositionReadout, RangeBar
from rotemina.plugins.control.step_choice import SpeedChoice, StepChoice
from rotemina.plugins.control.wording import (
    describe_status,
    echo_target,
    explain_invalid_target,
    format_difference,
    format_distance,
    format_remaining_travel,
    grade_deviation,
    is_near_end,
    is_stale,
    make_range_tooltip,
    parse_target,
)
from rotemina.sim.trajectory import check_target
from rotemina.sim.units import DisplayScale

_MIN_NAME_WIDTH_PX = 44


class TargetField(QLineEdit):
    """Text field in which holding the Enter key has the effect of one press."""

    def keyPressEvent(self, event: QKeyEvent) -> None:  # noqa: N802 (Qt's name)
        """Process a key press, but ignore the automatic repetition of Enter."""
        is_enter = event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter)
        if not (is_enter and event.isAutoRepeat()):
            super().keyPressEvent(event)


class AxisControlRow(QFrame):
    """Readout and controls of one axis.

    The controls are disabled while the position of the axis is unknown. While the target field
    contains text, the row shows two other things: the target with its unit instead of the state of
    the axis, and the distance to the target instead of the travel left in the range.
    """

    def __init__(
        self,
        axis: str,
        workbench: Workbench,
        steps: StepChoice,
        speed: SpeedChoice,
        clock: Clock = time.monotonic,
    ) -> None:
        super().__init__()
        self.setObjectName("axisRow")
        self._axis, self._workbench, self._clock = axis, workbench, clock
        self._steps, self._speed = steps, speed
        self._robot_axis = workbench.robot.axes[axis]
        self._scale: DisplayScale = choose_axis_scale(self._robot_axis)
        self._range: Range = self._robot_axis.range
        self._command: float | None = None
        # What the controls depend on, as it was when they were last updated.
        self._shown_state: tuple[object, ...] | None = None
        self.confirmation = LargeMoveConfirmation(self._robot_axis.span, workbench.session)
        self.hold_to_jog = HoldToJog(workbench, axis, self)
        self._bar = RangeBar(workbench, axis)
        self._readout = PositionReadout(
            workbench, tr("{label} position").format(label=get_axis_label(axis))
        )
        self.status = name_widget(
            ElidedLabel(), tr("{label} state").format(label=get_axis_label(axis))
        )
        self.room_left = name_widget(
            LiveLabel(quiet=True), tr("{label} range left").format(label=get_axis_label(axis))
        )
        self.room_left.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        self.difference = name_widget(
            LiveLabel(quiet=True),
            tr("{label}: measured minus command").format(label=get_axis_label(axis)),
        )
        self.difference.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        self.minus, self.plus = self._make_jog_button("−", -1), self._make_jog_button("+", +1)
        self.target = self._make_target_field()
        self.go = QPushButton(tr("Go"))
        self.go.setAccessibleName(tr("Go to the typed {label}").format(label=get_axis_label(axis)))
        self.go.clicked.connect(self._go_to_target)
        self._lay_out()

    def refresh(self, state: SessionState) -> None:
        """Show the newest sample, and enable or disable the controls."""
        is_known = state.position_known and self._axis in state.measured
        stale = is_stale(state)
        position = state.measured[self._axis] if is_known else None
        self._command = state.command[self._axis] if is_known else None
        self._readout.show_value(
            tr("unknown") if position is None else self._scale.format_with_unit(position),
            stale=stale or not is_known,
        )
        self._bar.show_position(position, self._command, stale=stale)
        show_tooltip(self._bar, make_range_tooltip(self._axis, position, self._range, self._scale))
        self._show_room_left(position)
        self.confirmation.cancel_if_moved(self._command)
        self._show_status(state)
        self._show_difference(position, stale=stale)
        self._update_controls(_find_move_objection(state, known=is_known, stale=stale))

    def show_compensation(self, signs: str, tip: str) -> None:
        """Show symbols for active compensation next to the axis name, with a tooltip."""
        text = f"{get_axis_label(self._axis)} {signs}".rstrip()
        if text != self.name.text():
            self.name.setText(text)
            self._fit_widths()
        show_tooltip(self.name, tip)

    def show_range(self, ends: Range, forbidden: Sequence[Range]) -> None:
        """Hatch the parts of the bar that are outside the target range or forbidden for the tip.

        Parameters
        ----------
        ends : (low, high)
            The range of targets, m or rad.
        forbidden : sequence of (low, high)
            Intervals that the limits of the tip forbid, m or rad.
        """
        self._range = ends
        low, high = self._robot_axis.range
        outside = [(start, end) for start, end in ((low, ends[0]), (ends[1], high)) if start < end]
        self._bar.show_forbidden((*outside, *forbidden))

    def set_roomy(self, *, roomy: bool) -> None:
        """Use four lines with large digits if ``roomy``, and three lines otherwise."""
        if roomy is self._roomy:
            return
        self._roomy = roomy
        grid = self._grid
        if roomy:
            grid.addWidget(self._readout, 0, 1, 1, 3)
            grid.addWidget(self.status, 1, 0, 1, 2)
            grid.addWidget(self.difference, 1, 2, 1, 2)
        else:
            grid.addWidget(self.status, 0, 1)
            grid.addWidget(self.difference, 0, 2)
            grid.addWidget(self._readout, 0, 3)
        self._bar.label_ends(labelled=roomy)
        set_property(self._readout, "roomy", roomy)

    def _lay_out(self) -> None:
        self.name = QLabel(get_axis_label(self._axis))
        # The name comes from a robot file: Qt must not interpret it as markup.
        self.name.setTextFormat(Qt.TextFormat.PlainText)
        self.name.setProperty("heading", True)
        self.name.setMinimumWidth(_MIN_NAME_WIDTH_PX)
        controls = make_row(
            self.minus, self.plus, (self.target, 1), self.go, self.room_left, spacing=4
        )
        self._roomy: bool | None = None
        grid = self._grid = make_grid(on=self, margins=(0, 0, 0, 3), spacing=(-1, 1), stretched=1)
        grid.addWidget(self.name, 0, 0)
        grid.addWidget(self._bar, 2, 0, 1, 4)
        grid.addLayout(controls, 3, 0, 1, 4)
        self.set_roomy(roomy=False)

    def _make_jog_button(self, text: str, sign: int) -> QPushButton:
        button = name_widget(QPushButton(text), f"{get_axis_label(self._axis)} {text}")
        button.setProperty("jog", True)
        button.clicked.connect(lambda _: self._jog_step(sign))
        button.pressed.connect(lambda: self._start_holding(button, sign))
        button.released.connect(self.hold_to_jog.end)
        self.hold_to_jog.watch_button(button)
        return button

    def _make_target_field(self) -> TargetField:
        field = TargetField()
        field.setPlaceholderText(f"[{self._scale.symbol}]")
        field.setMinimumWidth(60)
        field.setAccessibleName(
            tr("{label} target in {symbol}").format(
                label=get_axis_label(self._axis), symbol=self._scale.symbol
            )
        )
        field.textEdited.connect(lambda _: self.confirmation.cancel())
        field.returnPressed.connect(self._go_to_target)
        return field

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 (Qt's name)
        """Fit the widths to the new font or style."""
        if self.isVisible() and event.type() in (QEvent.Type.FontChange, QEvent.Type.StyleChange):
            self._fit_widths()
        super().changeEvent(event)

    def showEvent(self, event: QShowEvent) -> None:  # noqa: N802 (Qt's name)
        """Set the widths here, because the text size is known only once the row is shown."""
        self._fit_widths()
        super().showEvent(event)

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 (Qt's name)
        """Fit the widths to the new size of the row."""
        super().resizeEvent(event)
        self._fit_widths()

    def _fit_widths(self) -> None:
        self.room_left.setFixedWidth(
            self.room_left.fontMetrics().horizontalAdvance(
                tr("{way} left").format(way="8888.8 µrad")
            )
        )
        high = self._robot_axis.range[1]
        # Motion is locked beyond the following-error limit, so no larger difference needs to fit.
        widest = format_difference(self._robot_axis.following_limit, self._scale)
        difference_width = self.difference.fontMetrics().horizontalAdvance(widest)
        reading_width = self._readout.fontMetrics().horizontalAdvance(
            self._scale.format_with_unit(high)
        )
        name_width = max(_MIN_NAME_WIDTH_PX, self.name.sizeHint().width())
        spacing = 4 * self._grid.horizontalSpacing()
        free_width = self.width() - name_width - reading_width - spacing
        # If the difference does not fit, it is hidden, so that no reading is cut off.
        is_shown = bool(self._roomy) or difference_width <= free_width
        self.difference.setMinimumWidth(difference_width if is_shown else 0)
        self.difference.setVisible(is_shown)
        sign_width = self.plus.fontMetrics().horizontalAdvance("−")
        for button in (self.minus, self.plus):
            button.setFixedWidth(max(34, 3 * sign_width))
            button.setMinimumHeight(button.fontMetrics().height())

    def _jog_step(self, sign: int) -> None:
        step, axis = self._steps.find_step(self._axis), self._axis
        if step is not None:
            session, speeds = self._workbench.session, self._speed.find_speed_limits((axis,))
            self._workbench.run_request(lambda: session.jog(axis, sign * step, speeds=speeds))

    def _start_holding(self, button: QPushButton, sign: int) -> None:
        """Start to move at constant speed if "hold" is chosen instead of a step."""
        if self._steps.find_step(self._axis) is not None:
            return
        speed = self._speed.find_hold_speed(self._axis)
        if speed is None:
            self._workbench.notify(
                Level.WARNING,
                tr("{label}: the robot file gives no max_speed; use steps instead.").format(
                    label=get_axis_label(self._axis)
                ),
                about=self,
            )
            return
        self.hold_to_jog.begin(button, sign * speed)

    def _go_to_target(self) -> None:
        text, axis = self.target.text(), self._axis
        target = parse_target(text, self._scale)
        if target is None:
            self._workbench.notify(
                Level.WARNING, explain_invalid_target(axis, text, self._scale), about=self
            )
            return
        if self._command is None:
            refusal = tr("{label} does not move: its position is unknown.").format(
                label=get_axis_label(axis)
            )
            self._workbench.notify(Level.WARNING, refusal, about=self)
            return
        # An impossible move is refused before the operator is asked to confirm it.
        if not self._workbench.run_request(
            lambda: check_target(self._workbench.robot, axis, target)
        ):
            return
        permit = self.confirmation.request_permit(target, self._command, self._clock())
        if permit is not None:
            session, speeds = self._workbench.session, self._speed.find_speed_limits((axis,))
            self._workbench.run_request(
                lambda: session.go_to({axis: target}, speeds=speeds, permit=permit)
            )

    def _show_room_left(self, position: float | None) -> None:
        typed_distance = format_distance(self.target.text(), self._scale, self._command)
        text = typed_distance or format_remaining_travel(position, self._range, self._scale)
        if text != self.room_left.text():
            self.room_left.setText(text)
        set_property(self.room_left, "quiet", not typed_distance)
        set_property(
            self.room_left, "bad", not typed_distance and is_near_end(position, self._range)
        )

    def _show_difference(self, position: float | None, *, stale: bool) -> None:
        """Show measured minus commanded position, in a colour for its severity."""
        command = self._command
        is_known = position is not None and command is not None and not stale
        difference = position - command if position is not None and command is not None else 0.0
        text = format_difference(difference, self._scale) if is_known else ""
        if text != self.difference.text():
            self.difference.setText(text)
        grade = str(grade_deviation(difference, self._robot_axis)) if is_known else ""
        if set_property(self.difference, "grade", grade):
            bound = self._scale.format_with_unit(self._robot_axis.following_limit)
            self.difference.setToolTip(
                make_tooltip(
                    tr("Measured minus command; the bound is {bound}.").format(bound=bound)
                )
            )

    def _show_status(self, state: SessionState) -> None:
        typed_target = echo_target(self.target.text(), self._scale)
        waits_for_confirmation = self.confirmation.unconfirmed_move is not None
        self.status.show_text(typed_target or describe_status(self._axis, state, self._scale))
        set_property(self.status, "quiet", not typed_target)
        set_property(self.status, "bad", not typed_target and self._axis in state.unhomed)
        text = tr("Move?") if waits_for_confirmation else tr("Go")
        if text != self.go.text():
            self.go.setText(text)
            set_property(self.go, "primary", waits_for_confirmation)

    def _update_controls(self, objection: str | None) -> None:
        name, is_hold_mode = get_axis_label(self._axis), self._steps.find_step(self._axis) is None
        waits_for_confirmation = self.confirmation.unconfirmed_move is not None
        if self._shown_state == (
            shown_state := (objection, is_hold_mode, self._range, waits_for_confirmation)
        ):
            return
        self._shown_state = shown_state
        extent = tr("while pressed") if is_hold_mode else tr("one step")
        for button in (self.minus, self.plus):
            # The command palette can only click, so it must not offer a button to be held.
            button.setProperty("held", is_hold_mode)
        enable_unless(
            self.minus, objection, tr("Move {name} down {how}").format(name=name, how=extent)
        )
        enable_unless(
            self.plus, objection, tr("Move {name} up {how}").format(name=name, how=extent)
        )
        low, high = (self._scale.format_value(end) for end in self._range)
        bounds = tr("{low} to {high} {symbol}").format(
            low=low, high=high, symbol=self._scale.symbol
        )
        enable_unless(
            self.target,
            objection,
            tr("Target of {name}, {bounds}; press Enter or Go").format(name=name, bounds=bounds),
        )
        enable_unless(
            self.go,
            objection,
            tr("A large move: press again to confirm")
            if waits_for_confirmation
            else tr("Move {name} to the typed position").format(name=name),
        )


def _find_move_objection(state: SessionState, *, known: bool, stale: bool) -> str | None:
    if state.lock_reason is not None:
        return state.lock_reason
    if not known:
        return tr("its position is unknown")
    if stale:
        return tr("its reading is too old")
    return tr("a trajectory is playing") if state.activity is DeviceState.PLAYING else None

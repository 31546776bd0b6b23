"""One axis of the control menu: readout, range bar, jog, go-to."""

import time
from collections.abc import Sequence

from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QKeyEvent, QResizeEvent, QShowEvent
from PySide6.QtWidgets import QFrame, QLabel, QLineEdit, QPushButton

from rotemina.app.display_units import axis_scale, label
from rotemina.app.motion.ranges import Range
from rotemina.app.motion.state import SessionState
from rotemina.app.shell.workbench import Level, Workbench
from rotemina.app.widgets.controls import allow, named, plain_tip, set_property, show_tip
from rotemina.app.widgets.labels import ElidedLabel, LiveLabel
from rotemina.app.widgets.layouts import in_grid, in_row
from rotemina.drivers.clock import Clock
from rotemina.drivers.samples import DeviceState
from rotemina.plugins.control import tr
from rotemina.plugins.control.hold_to_jog import Holding
from rotemina.plugins.control.large_move_confirmation import Confirmation
from rotemina.plugins.control.readout import RangeBar, Readout
from rotemina.plugins.control.step_choice import SpeedChoice, StepChoice
from rotemina.plugins.control.wording import (
    difference_text,
    echo,
    grade_of,
    is_little,
    is_stale,
    no_position,
    range_tip,
    room_left_text,
    status_text,
    typed,
    way,
)
from rotemina.sim.quantities import Scale
from rotemina.sim.trajectory.axis_limits import check_target

_NAME = 44  # px, at least


class TargetField(QLineEdit):
    """A field in which a held Enter counts once."""

    def keyPressEvent(self, event: QKeyEvent) -> None:  # noqa: N802 (Qt's name)
        """Take a key, but no repetition of Enter."""
        enter = event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter)
        if not (enter and event.isAutoRepeat()):
            super().keyPressEvent(event)


class AxisRow(QFrame):
    """Readout and controls of one axis; its controls lock while its position is unknown.

    A number in the field is read back in place of the state, with its unit, and its way from here
    in place of what is left of the range.
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
        self._described = workbench.robot.axes[axis]
        self._scale: Scale = axis_scale(self._described)
        self._ends: Range = self._described.range
        self._command: float | None = None
        self._locked: tuple[object, ...] | None = None  # what the buttons say
        self.confirmation = Confirmation(self._described.span, workbench.session)
        self.holding = Holding(workbench, axis, self)
        self._bar = RangeBar(workbench, axis)
        self._readout = Readout(workbench, tr("{label} position").format(label=label(axis)))
        self.status = named(ElidedLabel(), tr("{label} state").format(label=label(axis)))
        self.left = named(LiveLabel(quiet=True), tr("{label} range left").format(label=label(axis)))
        self.left.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        self.difference = named(
            LiveLabel(quiet=True), tr("{label}: measured minus command").format(label=label(axis))
        )
        self.difference.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        self.minus, self.plus = self._jog_button("−", -1), self._jog_button("+", +1)
        self.target = self._target_field()
        self.go = QPushButton(tr("Go"))
        self.go.setAccessibleName(tr("Go to the typed {label}").format(label=label(axis)))
        self.go.clicked.connect(self._go)
        self._lay_out()

    def refresh(self, state: SessionState) -> None:
        """Show the newest sample and lock what must not be used now."""
        known = state.position_known and self._axis in state.measured
        stale = is_stale(state)
        position = state.measured[self._axis] if known else None
        self._command = state.command[self._axis] if known else None
        self._readout.show_value(
            tr("unknown") if position is None else self._scale.text(position),
            stale=stale or not known,
        )
        self._bar.show_position(position, self._command, stale=stale)
        show_tip(self._bar, range_tip(self._axis, position, self._ends, self._scale))
        self._show_left(position)
        self.confirmation.follow(self._command)
        self._show_status(state)
        self._show_difference(position, stale=stale)
        self._lock(_against(state, known=known, stale=stale))

    def show_aids(self, signs: str, tip: str) -> None:
        """Say beside the name what stands between command and machine; the tip explains it."""
        text = f"{label(self._axis)} {signs}".rstrip()
        if text != self.name.text():
            self.name.setText(text)
            self._fit()
        show_tip(self.name, tip)

    def show_range(self, ends: Range, forbidden: Sequence[Range]) -> None:
        """Hatch in the bar what lies outside of a narrowed range, and what the tip's bounds forbid.

        All in m or rad.
        """
        self._ends = ends
        low, high = self._described.range
        outside = [part for part in ((low, ends[0]), (ends[1], high)) if part[0] < part[1]]
        self._bar.show_forbidden((*outside, *forbidden))

    def give_room(self, *, roomy: bool) -> None:
        """Take four lines with large digits where there is room, else three."""
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

    # --- parts ------------------------------------------------------------------------------------

    def _lay_out(self) -> None:
        self.name = QLabel(label(self._axis))
        self.name.setTextFormat(Qt.TextFormat.PlainText)  # a name from a file is no markup
        self.name.setProperty("heading", True)
        self.name.setMinimumWidth(_NAME)
        controls = in_row(self.minus, self.plus, (self.target, 1), self.go, self.left, spacing=4)
        self._roomy: bool | None = None
        grid = self._grid = in_grid(on=self, margins=(0, 0, 0, 3), spacing=(-1, 1), stretched=1)
        grid.addWidget(self.name, 0, 0)
        grid.addWidget(self._bar, 2, 0, 1, 4)
        grid.addLayout(controls, 3, 0, 1, 4)
        self.give_room(roomy=False)

    def _jog_button(self, text: str, sign: int) -> QPushButton:
        button = named(QPushButton(text), f"{label(self._axis)} {text}")
        button.setProperty("jog", True)
        button.clicked.connect(lambda _: self._step(sign))
        button.pressed.connect(lambda: self._hold(button, sign))
        button.released.connect(self.holding.end)
        self.holding.watch(button)
        return button

    def _target_field(self) -> TargetField:
        field = TargetField()
        field.setPlaceholderText(f"[{self._scale.symbol}]")  # *Go* is beside it
        field.setMinimumWidth(60)
        field.setAccessibleName(
            tr("{label} target in {symbol}").format(
                label=label(self._axis), symbol=self._scale.symbol
            )
        )
        field.textEdited.connect(lambda _: self.confirmation.withdraw())
        field.returnPressed.connect(self._go)
        return field

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 (Qt's name)
        """Leave room for the widest text whatever the size of text is."""
        if self.isVisible() and event.type() in (QEvent.Type.FontChange, QEvent.Type.StyleChange):
            self._fit()
        super().changeEvent(event)

    def showEvent(self, event: QShowEvent) -> None:  # noqa: N802 (Qt's name)
        """Leave room for the widest text; before, the size of text is not known."""
        self._fit()
        super().showEvent(event)

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 (Qt's name)
        """Leave room for the widest text."""
        super().resizeEvent(event)
        self._fit()

    def _fit(self) -> None:
        self.left.setFixedWidth(
            self.left.fontMetrics().horizontalAdvance(tr("{way} left").format(way="8888.8 µrad"))
        )
        high = self._described.range[1]
        # Beyond the following bound motion is locked; until there, its width is that of a bound.
        widest = difference_text(self._described.following, self._scale)
        apart = self.difference.fontMetrics().horizontalAdvance(widest)
        reading = self._readout.fontMetrics().horizontalAdvance(self._scale.text(high))
        name = max(_NAME, self.name.sizeHint().width())
        room = self.width() - name - reading - 4 * self._grid.horizontalSpacing()
        shown = bool(self._roomy) or apart <= room  # no reading is cut for it
        self.difference.setMinimumWidth(apart if shown else 0)
        self.difference.setVisible(shown)
        sign = self.plus.fontMetrics().horizontalAdvance("−")
        for button in (self.minus, self.plus):
            button.setFixedWidth(max(34, 3 * sign))
            button.setMinimumHeight(button.fontMetrics().height())

    # --- moves ------------------------------------------------------------------------------------

    def _step(self, sign: int) -> None:
        step, axis = self._steps.step(self._axis), self._axis
        if step is not None:
            session, speeds = self._workbench.session, self._speed.speeds((axis,))
            self._workbench.ask(lambda: session.jog(axis, sign * step, speeds=speeds))

    def _hold(self, button: QPushButton, sign: int) -> None:
        if self._steps.step(self._axis) is not None:
            return
        speed = self._speed.speed(self._axis)
        if speed is None:
            self._workbench.notify(
                Level.WARNING,
                tr("{label}: the robot file gives no max_speed; use steps instead.").format(
                    label=label(self._axis)
                ),
                about=self,
            )
            return
        self.holding.begin(button, sign * speed)

    def _go(self) -> None:
        text, axis = self.target.text(), self._axis
        target = typed(text, self._scale)
        if target is None:
            self._workbench.notify(Level.WARNING, no_position(axis, text, self._scale), about=self)
            return
        if self._command is None:
            text = tr("{label} does not move: its position is unknown.").format(label=label(axis))
            self._workbench.notify(Level.WARNING, text, about=self)
            return
        if not self._workbench.ask(lambda: check_target(self._workbench.robot, axis, target)):
            return  # nobody is asked about a move that cannot be made
        permit = self.confirmation.take(target, self._command, self._clock())
        if permit is not None:
            session, speeds = self._workbench.session, self._speed.speeds((axis,))
            self._workbench.ask(lambda: session.go_to({axis: target}, speeds=speeds, permit=permit))

    # --- what is shown ----------------------------------------------------------------------------

    def _show_left(self, position: float | None) -> None:
        meant = way(self.target.text(), self._scale, self._command)
        text = meant or room_left_text(position, self._ends, self._scale)
        if text != self.left.text():
            self.left.setText(text)
        set_property(self.left, "quiet", not meant)
        set_property(self.left, "bad", not meant and is_little(position, self._ends))

    def _show_difference(self, position: float | None, *, stale: bool) -> None:
        """Show how far the reading is from the command, and how grave that is."""
        command = self._command
        known = position is not None and command is not None and not stale
        apart = position - command if position is not None and command is not None else 0.0
        text = difference_text(apart, self._scale) if known else ""
        if text != self.difference.text():
            self.difference.setText(text)
        grade = str(grade_of(apart, self._described)) if known else ""
        if set_property(self.difference, "grade", grade):
            bound = self._scale.text(self._described.following)
            self.difference.setToolTip(
                plain_tip(tr("Measured minus command; the bound is {bound}.").format(bound=bound))
            )

    def _show_status(self, state: SessionState) -> None:
        """Show what a typed number means, or else how the axis stands."""
        meant = echo(self.target.text(), self._scale)
        asked = self.confirmation.asked is not None
        self.status.show_text(meant or status_text(self._axis, state, self._scale))
        set_property(self.status, "quiet", not meant)
        set_property(self.status, "bad", not meant and self._axis in state.unhomed)
        word = tr("Move?") if asked else tr("Go")
        if word != self.go.text():
            self.go.setText(word)
            set_property(self.go, "primary", asked)

    def _lock(self, why_not: str | None) -> None:
        name, held = label(self._axis), self._steps.step(self._axis) is None
        asked = self.confirmation.asked is not None
        if self._locked == (told := (why_not, held, self._ends, asked)):
            return
        self._locked = told
        how = tr("while pressed") if held else tr("one step")
        for button in (self.minus, self.plus):
            button.setProperty("held", held)  # the command palette can only click
        allow(self.minus, why_not, tr("Move {name} down {how}").format(name=name, how=how))
        allow(self.plus, why_not, tr("Move {name} up {how}").format(name=name, how=how))
        low, high = (self._scale.number(end) for end in self._ends)
        bounds = tr("{low} to {high} {symbol}").format(
            low=low, high=high, symbol=self._scale.symbol
        )
        allow(
            self.target,
            why_not,
            tr("Target of {name}, {bounds}; press Enter or Go").format(name=name, bounds=bounds),
        )
        allow(
            self.go,
            why_not,
            tr("A large move: press again to confirm")
            if asked
            else tr("Move {name} to the typed position").format(name=name),
        )


def _against(state: SessionState, *, known: bool, stale: bool) -> str | None:
    """Return why an axis must not be moved from here now."""
    if state.locked is not None:
        return state.locked
    if not known:
        return tr("its position is unknown")
    if stale:
        return tr("its reading is too old")
    return tr("a trajectory is playing") if state.activity is DeviceState.PLAYING else None

"""One axis of the control menu: readout, place in the range, jog, go-to."""

from html import escape

from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QPainter, QPaintEvent
from PySide6.QtWidgets import (
    QFrame,
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QPushButton,
    QSizePolicy,
    QWidget,
)

from rotemina.app.display import PLAIN_NUMBER, Scale, axis_scale, label
from rotemina.app.motion.state import SessionState
from rotemina.app.panel import STALE_S
from rotemina.app.shell.workbench import Level, Workbench
from rotemina.drivers.samples import DeviceState
from rotemina.plugins.control.step_choice import StepChoice
from rotemina.sim.units import from_unit


class RangeBar(QWidget):
    """Where an axis is within its range: a line with a mark for its command and its position."""

    def __init__(self, workbench: Workbench, axis: str) -> None:
        super().__init__()
        self._workbench = workbench
        self._low, self._high = workbench.robot.axes[axis].range
        self._position: float | None = None
        self._command: float | None = None
        self.setFixedHeight(10)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)

    def show_position(self, position: float | None, command: float | None) -> None:
        """Move the marks; None hides one."""
        self._position, self._command = position, command
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 (Qt's name)
        """Draw the range, the stretch up to the position, and the command's mark."""
        theme = self._workbench.theme
        painter = QPainter(self)
        painter.setPen(Qt.PenStyle.NoPen)
        width, middle = self.width(), self.height() / 2
        painter.setBrush(theme.line)
        painter.drawRect(QRectF(0, middle - 2, width, 4))
        if self._position is not None:
            painter.setBrush(theme.real)
            painter.drawRect(QRectF(0, middle - 2, width * self._share(self._position), 4))
        if self._command is not None:
            painter.setBrush(theme.text)
            painter.drawRect(QRectF((width - 2) * self._share(self._command), 0, 2, self.height()))
        painter.end()

    def _share(self, value: float) -> float:
        return min(max((value - self._low) / (self._high - self._low), 0.0), 1.0)


class AxisRow(QFrame):
    """Readout and controls of one axis; its controls lock while its position is unknown."""

    def __init__(self, axis: str, workbench: Workbench, steps: StepChoice) -> None:
        super().__init__()
        self.setObjectName("axisRow")
        self._axis, self._workbench, self._steps = axis, workbench, steps
        self._scale: Scale = axis_scale(workbench.robot.axes[axis])
        self._bar = RangeBar(workbench, axis)
        self._readout = QLabel("–")
        self._readout.setTextFormat(Qt.TextFormat.PlainText)
        self._readout.setProperty("readout", True)
        self._readout.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        self._readout.setAccessibleName(f"{label(axis)} position")
        self._command = QLabel("")
        self._command.setProperty("quiet", True)
        self._command.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        self._command.setToolTip("What the axis was last told; the large number is measured")
        self.minus, self.plus = self._jog_button("−", -1), self._jog_button("+", +1)
        self.target = self._target_field()
        self.go = QPushButton("Go")
        self.go.setToolTip(f"Move {escape(label(axis))} to the typed position")
        self.go.clicked.connect(self._go)
        self._lay_out()

    def refresh(self, state: SessionState) -> None:
        """Show the newest sample and lock what must not be used now."""
        known = state.position_known and self._axis in state.measured
        stale = state.age_s is None or state.age_s > STALE_S
        if known:
            position, command = state.measured[self._axis], state.command[self._axis]
            self._readout.setText(self._scale.text(position))
            self._command.setText(f"→ {self._scale.number(command)}")
            self._bar.show_position(position, command)
        else:
            self._readout.setText("unknown")
            self._command.setText("")
            self._bar.show_position(None, None)
        _set_property(self._readout, "stale", stale or not known)
        free = state.locked is None and state.activity is not DeviceState.PLAYING
        for widget in (self.minus, self.plus, self.target, self.go):
            widget.setEnabled(known and not stale and free)

    def _lay_out(self) -> None:
        name = QLabel(label(self._axis))
        name.setTextFormat(Qt.TextFormat.PlainText)  # a name from a file is no markup
        name.setProperty("heading", True)
        name.setMinimumWidth(52)
        low, high = self._workbench.robot.axes[self._axis].range
        self._bar.setToolTip(f"Range {self._scale.text(low)} … {self._scale.text(high)}")
        controls = QHBoxLayout()
        controls.setSpacing(6)
        controls.addWidget(self.minus)
        controls.addWidget(self.plus)
        controls.addWidget(self.target, 1)
        controls.addWidget(QLabel(self._scale.symbol))
        controls.addWidget(self.go)
        grid = QGridLayout(self)
        grid.setContentsMargins(0, 2, 0, 6)
        grid.setVerticalSpacing(2)
        grid.addWidget(name, 0, 0)
        grid.addWidget(self._command, 0, 1)
        grid.addWidget(self._readout, 0, 2)
        grid.setColumnStretch(1, 1)
        grid.addWidget(self._bar, 1, 0, 1, 3)
        grid.addLayout(controls, 2, 0, 1, 3)

    def _jog_button(self, text: str, sign: int) -> QPushButton:
        button = QPushButton(text)
        button.setProperty("jog", True)
        button.setFixedWidth(38)
        button.setToolTip(
            f"Move {escape(label(self._axis))} one step {'up' if sign > 0 else 'down'}"
        )
        button.setAccessibleName(f"{label(self._axis)} {text}")
        button.clicked.connect(
            lambda: self._workbench.jog(self._axis, sign * self._steps.step(self._axis))
        )
        return button

    def _target_field(self) -> QLineEdit:
        field = QLineEdit()
        field.setPlaceholderText("go to")
        field.setAccessibleName(f"{label(self._axis)} target in {self._scale.symbol}")
        field.returnPressed.connect(self._go)
        return field

    def _go(self) -> None:
        text = self.target.text().strip()
        if PLAIN_NUMBER.fullmatch(text) is None:
            self._workbench.notify(
                Level.WARNING,
                f"{label(self._axis)}: {text!r} is no position; type a number in "
                f"{self._scale.symbol} with a decimal point.",
            )
            return
        target = float(from_unit(float(text), self._scale.unit))
        self._workbench.go_to({self._axis: target})


def _set_property(widget: QWidget, name: str, value: bool) -> None:
    if widget.property(name) != value:
        widget.setProperty(name, value)
        widget.style().unpolish(widget)
        widget.style().polish(widget)

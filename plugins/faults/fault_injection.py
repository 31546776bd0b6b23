"""Controls for fault injection: the virtual board, and a row for each kind of fault."""

from collections.abc import Callable

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QCheckBox, QGridLayout, QLabel, QPushButton, QWidget

from rotemina.app.widgets.controls import (
    WheelSafeComboBox,
    WheelSafeSpinBox,
    enable_unless,
    make_tooltip,
    name_widget,
)
from rotemina.app.widgets.layout import (
    make_column,
    make_grid,
    make_row,
)
from rotemina.app.widgets.text import ElidedLabel, make_plain_label
from rotemina.app.workbench import Workbench
from rotemina.plugins.faults import mark, tr
from rotemina.plugins.faults.board_process import TAKES_COMMANDS, BoardProcess
from rotemina.plugins.faults.fault_catalogue import (
    ChoiceParameter,
    InjectableFault,
    NumberParameter,
    list_injectable_faults,
)
from rotemina.sim.robot import StepperAxis

_INTRODUCTION = mark(
    "For training: start a virtual board, connect to its ports, and inject "
    "faults. The virtual board runs as a separate process. The built-in simulator "
    "has neither lines nor boards that could fail; set the effects of its machine "
    "in the Effects panel."
)
_NOT_RUNNING = mark("no virtual board is running; start it first")
_NO_COMMANDS = mark("on this system a virtual board accepts no commands")
_AXES_PER_BOARD = 3


class FaultChoiceField(WheelSafeComboBox):
    """Field for a parameter that is one of several words."""

    def __init__(self, parameter: ChoiceParameter) -> None:
        super().__init__()
        for text, word in parameter.options:
            self.addItem(text, word)
        self.setEnabled(len(parameter.options) > 1)
        self.setVisible(len(parameter.options) > 1)

    def read_word(self) -> str:
        """Return the chosen word of the command."""
        return str(self.currentData())


class FaultNumberField(WheelSafeSpinBox):
    """Field for a parameter that is a number."""

    def __init__(self, parameter: NumberParameter) -> None:
        super().__init__()
        self._parameter = parameter
        self.setDecimals(parameter.decimals)
        self.setRange(parameter.low, parameter.high)
        self.setValue(parameter.default)
        if parameter.unit:
            self.setSuffix(f" {parameter.unit}")

    def read_word(self) -> str:
        """Return the number as text for the command."""
        return self._parameter.format_for_command(self.value())


class FaultRow:
    """Controls for one kind of fault: a field for each parameter, and a button."""

    def __init__(self, fault: InjectableFault, inject: Callable[[str], None]) -> None:
        self.fault = fault
        self.fields = [
            FaultChoiceField(parameter)
            if isinstance(parameter, ChoiceParameter)
            else FaultNumberField(parameter)
            for parameter in fault.parameters
        ]
        for field, parameter in zip(self.fields, fault.parameters, strict=True):
            field.setAccessibleName(f"{fault.title}: {parameter.name}")
            field.setToolTip(
                make_tooltip(f"{parameter.name}. {fault.meaning}", _format_bounds(parameter))
            )
        self.button = QPushButton(tr("Inject"))
        self.button.setAccessibleName(tr("Inject {fault}").format(fault=fault.title))
        self.button.clicked.connect(lambda _: inject(self.read_command()))

    def read_command(self) -> str:
        """Return the command with the values of the fields."""
        return self.fault.make_command(tuple(field.read_word() for field in self.fields))

    def add_to_grid(self, grid: QGridLayout, row: int) -> None:
        """Add the controls to a row of a grid."""
        title = QLabel(self.fault.title)
        title.setToolTip(make_tooltip(self.fault.meaning))
        grid.addWidget(title, row, 0)
        grid.addLayout(make_row(*((field, 1) for field in self.fields), spacing=6), row, 1)
        grid.addWidget(self.button, row, 2)


def _format_bounds(parameter: ChoiceParameter | NumberParameter) -> str:
    if isinstance(parameter, ChoiceParameter):
        return ""
    text = tr("{low:g} to {high:.7g} {unit}")
    return text.format(low=parameter.low, high=parameter.high, unit=parameter.unit).rstrip()


class FaultInjectionView(QWidget):
    """Controls that start and end the virtual board and inject faults.

    Signals
    -------
    reported(text, about, is_error)
        Emitted for each event that belongs in the history. ``about`` is the subject that replaces
        ``{about}`` in the text.
    """

    reported = Signal(str, str, bool)

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self._workbench = workbench
        self.board = BoardProcess(workbench.robot, self)
        self.lines = WheelSafeComboBox(
            tr("Lines of the virtual board"), tr("Whether the virtual boards share one serial line")
        )
        max_lines = 2 if len(workbench.robot.axes) > _AXES_PER_BOARD else 1
        self._max_lines = max_lines
        if max_lines > 1:
            self.lines.addItem(tr("a line for each board"), 2)
        self.lines.addItem(tr("one line") if max_lines == 1 else tr("one shared line"), 1)
        self.homed = QCheckBox(tr("Position known"))
        self.homed.setToolTip(tr("Start homed and without a fault, unlike a real board"))
        self.start_button = QPushButton(tr("Start virtual board"))
        self.start_button.setProperty("primary", True)
        self.start_button.clicked.connect(lambda _: self._start_board())
        self.end_button = name_widget(QPushButton(tr("End")), tr("End the virtual board"))
        self.end_button.clicked.connect(lambda _: self.board.end())
        self.state = ElidedLabel()
        self.rows: list[FaultRow] = []
        self._lay_out()
        self._connect_signals()
        self._show_state()

    def _lay_out(self) -> None:
        introduction = make_plain_label(tr(_INTRODUCTION), wrap=True)
        self.state.setProperty("quiet", True)
        buttons = make_row(self.start_button, self.end_button, (self.state, 1))
        options = make_row(self.lines, self.homed, 1)
        grid = make_grid(spacing=(8, 5), stretched=1)
        axes = self._workbench.robot.axes
        steppers = tuple(name for name, axis in axes.items() if isinstance(axis, StepperAxis))
        for row, fault in enumerate(list_injectable_faults(tuple(axes), steppers, self._max_lines)):
            fault_row = FaultRow(fault, self._inject_fault)
            fault_row.add_to_grid(grid, row)
            self.rows.append(fault_row)
        make_column(
            buttons, options, grid, introduction, 1, on=self, margins=(2, 0, 8, 4), spacing=6
        )

    def _connect_signals(self) -> None:
        self.board.listening.connect(self._offer_ports)
        self.board.line_printed.connect(self._report_line)
        self.board.error_printed.connect(lambda line: self.reported.emit(line, "", True))
        self.board.ended.connect(self._on_board_ended)
        self._workbench.closing.connect(self.board.close)

    def _start_board(self) -> None:
        lines, homed = int(self.lines.currentData()), self.homed.isChecked()
        if self._workbench.run_request(lambda: self.board.start(lines, homed=homed)):
            self._show_state()

    def _inject_fault(self, command: str) -> None:
        self.board.inject(command)

    def _offer_ports(self, ports: tuple[tuple[str, str], ...]) -> None:
        self._workbench.offer_ports(
            (port, tr("virtual {board}").format(board=board)) for port, board in ports
        )
        port_names = ", ".join(port for port, _ in ports)
        self.reported.emit(mark("virtual board on {about}"), port_names, False)
        self._show_state()

    def _report_line(self, line: str) -> None:
        # The board prints an event as "TIME s: TEXT". Other lines do not belong in the history.
        _, _, text = line.partition(" s: ")
        if text:
            self.reported.emit(text, "", False)

    def _on_board_ended(self, reason: str) -> None:
        self._workbench.offer_ports(())
        ended_text = mark("virtual board ended")
        self.reported.emit(
            mark("virtual board ended: {about}") if reason else ended_text, reason, bool(reason)
        )
        self._show_state()

    def _show_state(self) -> None:
        is_running, ports = self.board.is_running, self.board.ports
        if ports:
            port_names = ", ".join(port for port, _ in ports)
            text = tr("Listening on {ports}; connect to it.").format(ports=port_names)
        else:
            text = tr("Starting …") if is_running else tr("No virtual board is running.")
        self.state.show_text(text)
        enable_unless(
            self.start_button,
            tr("it is already running") if is_running else None,
            tr("Start boards of this robot"),
        )
        end_objection = None if is_running else tr(_NOT_RUNNING)
        enable_unless(
            self.end_button, end_objection, tr("End the virtual board; its lines fall silent")
        )
        for widget in (self.lines, self.homed):
            widget.setEnabled(not is_running)
        inject_objection = None if ports else tr(_NOT_RUNNING)
        if not TAKES_COMMANDS:
            inject_objection = tr(_NO_COMMANDS)
        for row in self.rows:
            enable_unless(row.button, inject_objection, row.fault.meaning)

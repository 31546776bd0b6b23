"""Fault injection: a virtual board, and a row of controls for each fault."""

from collections.abc import Callable

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QCheckBox, QGridLayout, QLabel, QPushButton, QWidget

from rotemina.app.shell.workbench import Workbench
from rotemina.app.widgets.controls import allow, named, plain_tip
from rotemina.app.widgets.labels import ElidedLabel, plain_text
from rotemina.app.widgets.layouts import in_column, in_grid, in_row
from rotemina.app.widgets.wheel_safe import SteadyChoice, SteadyNumber
from rotemina.plugins.faults import mark, tr
from rotemina.plugins.faults.board_process import TAKES_COMMANDS, BoardProcess
from rotemina.plugins.faults.fault_catalogue import Fault, Number, Pick, faults
from rotemina.sim.robot.model import StepperAxis

_ABOUT = mark(
    "For training: start a virtual board, connect to its ports, and inject "
    "faults. The virtual board is a process of its own. The built-in simulator "
    "has neither lines nor boards that could fail; the panel Effects sets the "
    "effects of its machine."
)
_NOT_RUNNING = mark("no virtual board is running; start it first")
_NO_COMMANDS = mark("on this system a virtual board accepts no commands")
_BOARD_AXES = 3


class Choice(SteadyChoice):
    """A parameter that is one of some words."""

    def __init__(self, pick: Pick) -> None:
        super().__init__()
        for shown, word in pick.words:
            self.addItem(shown, word)
        self.setEnabled(len(pick.words) > 1)
        self.setVisible(len(pick.words) > 1)

    def word(self) -> str:
        """Return what is sent."""
        return str(self.currentData())


class Amount(SteadyNumber):
    """A parameter that is a number."""

    def __init__(self, number: Number) -> None:
        super().__init__()
        self._number = number
        self.setDecimals(number.decimals)
        self.setRange(number.low, number.high)
        self.setValue(number.preset)
        if number.unit:
            self.setSuffix(f" {number.unit}")

    def word(self) -> str:
        """Return what is sent."""
        return self._number.word(self.value())


class FaultRow:
    """The controls of one kind of fault in a row of a grid."""

    def __init__(self, fault: Fault, inject: Callable[[str], None]) -> None:
        self.fault = fault
        self.fields = [
            Choice(each) if isinstance(each, Pick) else Amount(each) for each in fault.parameters
        ]
        for field, parameter in zip(self.fields, fault.parameters, strict=True):
            field.setAccessibleName(f"{fault.title}: {parameter.name}")
            field.setToolTip(plain_tip(f"{parameter.name}. {fault.meaning}", _bounds(parameter)))
        self.button = QPushButton(tr("Inject"))
        self.button.setAccessibleName(tr("Inject {fault}").format(fault=fault.title))
        self.button.clicked.connect(lambda _: inject(self.command()))

    def command(self) -> str:
        """Return the command as the fields have it."""
        return self.fault.command(tuple(field.word() for field in self.fields))

    def place(self, grid: QGridLayout, row: int) -> None:
        """Put the controls into a row of a grid."""
        title = QLabel(self.fault.title)
        title.setToolTip(plain_tip(self.fault.meaning))
        grid.addWidget(title, row, 0)
        grid.addLayout(in_row(*((field, 1) for field in self.fields), spacing=6), row, 1)
        grid.addWidget(self.button, row, 2)


def _bounds(parameter: Pick | Number) -> str:
    if isinstance(parameter, Pick):
        return ""
    text = tr("{low:g} to {high:.7g} {unit}")
    return text.format(low=parameter.low, high=parameter.high, unit=parameter.unit).rstrip()


class Injection(QWidget):
    """The virtual board, and what can be done to it.

    Signals
    -------
    told(str, str, bool) : something about it worth keeping, what stands in it for ``{about}``, and
        whether it is a complaint.
    """

    told = Signal(str, str, bool)

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self._workbench = workbench
        self.board = BoardProcess(workbench.robot, self)
        self.lines = SteadyChoice(
            tr("Lines of the virtual board"), tr("Whether the virtual boards share one serial line")
        )
        most = 2 if len(workbench.robot.axes) > _BOARD_AXES else 1
        self._lines = most
        if most > 1:
            self.lines.addItem(tr("a line for each board"), 2)
        self.lines.addItem(tr("one line") if most == 1 else tr("one shared line"), 1)
        self.homed = QCheckBox(tr("Position known"))
        self.homed.setToolTip(tr("Start homed and without a fault, unlike a real board"))
        self.start = QPushButton(tr("Start virtual board"))
        self.start.setProperty("primary", True)
        self.start.clicked.connect(lambda _: self._start())
        self.end = named(QPushButton(tr("End")), tr("End the virtual board"))
        self.end.clicked.connect(lambda _: self.board.end())
        self.state = ElidedLabel()
        self.rows: list[FaultRow] = []
        self._lay_out()
        self._connect()
        self._show()

    def _lay_out(self) -> None:
        about = plain_text(tr(_ABOUT), wrap=True)
        self.state.setProperty("quiet", True)
        buttons = in_row(self.start, self.end, (self.state, 1))
        options = in_row(self.lines, self.homed, 1)
        grid = in_grid(spacing=(8, 5), stretched=1)
        axes = self._workbench.robot.axes
        steppers = tuple(name for name, axis in axes.items() if isinstance(axis, StepperAxis))
        for row, fault in enumerate(faults(tuple(axes), steppers, self._lines)):
            made = FaultRow(fault, self._inject)
            made.place(grid, row)
            self.rows.append(made)
        in_column(buttons, options, grid, about, 1, on=self, margins=(2, 0, 8, 4), spacing=6)

    def _connect(self) -> None:
        self.board.listening.connect(self._offer)
        self.board.said.connect(self._note)
        self.board.complained.connect(lambda line: self.told.emit(line, "", True))
        self.board.ended.connect(self._ended)
        self._workbench.closing.connect(self.board.close)

    def _start(self) -> None:
        lines, homed = int(self.lines.currentData()), self.homed.isChecked()
        if self._workbench.ask(lambda: self.board.start(lines, homed=homed)):
            self._show()

    def _inject(self, command: str) -> None:
        self.board.inject(command)

    def _offer(self, ports: tuple[tuple[str, str], ...]) -> None:
        self._workbench.offer_ports(
            (port, tr("virtual {board}").format(board=who)) for port, who in ports
        )
        where = ", ".join(port for port, _ in ports)
        self.told.emit(mark("virtual board on {about}"), where, False)
        self._show()

    def _note(self, line: str) -> None:
        _, _, text = line.partition(" s: ")
        if text:
            self.told.emit(text, "", False)

    def _ended(self, why: str) -> None:
        self._workbench.offer_ports(())
        ended = mark("virtual board ended")
        self.told.emit(mark("virtual board ended: {about}") if why else ended, why, bool(why))
        self._show()

    def _show(self) -> None:
        """Show how the board stands, and lock what cannot be done."""
        running, ports = self.board.running, self.board.ports
        if ports:
            where = ", ".join(port for port, _ in ports)
            text = tr("Listening on {ports}; connect to it.").format(ports=where)
        else:
            text = tr("Starting …") if running else tr("No virtual board is running.")
        self.state.show_text(text)
        allow(
            self.start,
            tr("it is already running") if running else None,
            tr("Start boards of this robot"),
        )
        none = None if running else tr(_NOT_RUNNING)
        allow(self.end, none, tr("End the virtual board; its lines fall silent"))
        for widget in (self.lines, self.homed):
            widget.setEnabled(not running)
        why = None if ports else tr(_NOT_RUNNING)
        if not TAKES_COMMANDS:
            why = tr(_NO_COMMANDS)
        for row in self.rows:
            allow(row.button, why, row.fault.meaning)

"""A virtual board in a separate process, which ends with the window."""

import os
import re
import sys
import tempfile
from pathlib import Path

from PySide6.QtCore import QObject, QProcess, Signal

from rotemina.plugins.faults import mark
from rotemina.sim.robot import Robot
from rotemina.sim.robot_files import write_robot

_LISTENING_PATTERN = re.compile(r"listening on (?P<port>.+): (?P<who>board .+)")
# The command begins each line of an error message with this.
_ERROR_PREFIX = "rotemina: "
_END_TIMEOUT_MS = 1500
# The board waits for its ports and its standard input at once. Systems other than POSIX can wait
# for sockets only, so the board cannot read commands there.
TAKES_COMMANDS = os.name == "posix"


class BoardProcess(QObject):
    """Process that runs the command ``rotemina board`` and takes fault commands.

    Signals
    -------
    listening(list of (port, board))
        Emitted when all ports are open.
    line_printed(str)
        Emitted for each line of output.
    error_printed(str)
        Emitted for each error message.
    ended(str)
        Emitted when the process ends, with the reason, or with "" if the end was requested.
    """

    listening = Signal(object)
    line_printed = Signal(str)
    error_printed = Signal(str)
    ended = Signal(str)

    def __init__(self, robot: Robot, parent: QObject) -> None:
        super().__init__(parent)
        self._robot = robot
        self._end_requested = False
        self._expected_port_count = 0
        self._listening_ports: list[tuple[str, str]] = []
        self._last_error = ""
        self._folder: tempfile.TemporaryDirectory[str] | None = None
        self._process = QProcess(self)
        self._process.readyReadStandardOutput.connect(self._read_output)
        self._process.readyReadStandardError.connect(self._read_errors)
        self._process.finished.connect(lambda *_: self._on_finished())
        self._process.errorOccurred.connect(self._on_error)

    @property
    def is_running(self) -> bool:
        """Whether the process is running."""
        return self._process.state() is not QProcess.ProcessState.NotRunning

    @property
    def ports(self) -> tuple[tuple[str, str], ...]:
        """The ports on which the process listens, as pairs of port and board name."""
        return tuple(self._listening_ports)

    def start(self, lines: int, *, homed: bool) -> None:
        """Start the process unless it is running.

        Parameters
        ----------
        lines : int
            Number of serial lines, 1 or 2.
        homed : bool
            Whether the positions of the steppers are known from the start.

        Raises
        ------
        InputError
            If the robot file for the process cannot be written.
        """
        if self.is_running:
            return
        self._folder = tempfile.TemporaryDirectory(prefix="rotemina-")
        robot_file = Path(self._folder.name) / "robot.toml"
        write_robot(self._robot, robot_file)
        self._end_requested, self._expected_port_count, self._listening_ports, self._last_error = (
            False,
            lines,
            [],
            "",
        )
        arguments = ["-m", "rotemina.app.cli.main", "board", "--robot", str(robot_file)]
        if TAKES_COMMANDS:
            arguments += ["--until-stdin-closes"]
            arguments += ["--bus"] if lines == 1 and len(self._robot.axes) > 3 else []
        else:
            arguments += ["--tcp", "127.0.0.1:0"] * lines
        arguments += ["--position-known"] if homed else []
        self._process.start(sys.executable, arguments)

    def inject(self, command: str) -> None:
        """Send a fault command. The process prints a message if it is invalid."""
        self._process.write(f"{command}\n".encode())

    def end(self) -> None:
        """Request the end of the process without waiting for it."""
        self._end_requested = True
        self._process.closeWriteChannel()
        self._process.terminate()

    def close(self) -> None:
        """End the process and wait for its end. Call this when the window closes."""
        if self.is_running:
            self.end()
            if not self._process.waitForFinished(_END_TIMEOUT_MS):
                self._process.kill()
                self._process.waitForFinished(_END_TIMEOUT_MS)

    def _read_output(self) -> None:
        while self._process.canReadLine():
            line = bytes(self._process.readLine().data()).decode("utf-8", "replace").strip()
            match = _LISTENING_PATTERN.fullmatch(line)
            if match is None:
                self.line_printed.emit(line)
                continue
            self._listening_ports.append((match["port"], match["who"]))
            if len(self._listening_ports) == self._expected_port_count:
                self.listening.emit(self.ports)

    def _read_errors(self) -> None:
        text = bytes(self._process.readAllStandardError().data()).decode("utf-8", "replace")
        for line in filter(None, map(str.strip, text.splitlines())):
            if line.startswith(_ERROR_PREFIX):
                self._last_error = line.removeprefix(_ERROR_PREFIX)
                self.error_printed.emit(self._last_error)
            else:
                # The command also prints notes to this stream, such as the robot file it uses.
                self.line_printed.emit(line)

    def _on_error(self, error: QProcess.ProcessError) -> None:
        if error is QProcess.ProcessError.FailedToStart:
            self._last_error = self._process.errorString()
            self._on_finished()

    def _on_finished(self) -> None:
        self._listening_ports = []
        if self._folder is not None:
            self._folder.cleanup()
            self._folder = None
        if self._end_requested:
            self.ended.emit("")
        else:
            self.ended.emit(self._last_error or mark("the virtual board ended by itself"))

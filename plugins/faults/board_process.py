"""A virtual board as a separate process that ends with the window."""

import os
import re
import sys
import tempfile
from pathlib import Path

from PySide6.QtCore import QObject, QProcess, Signal

from rotemina.plugins.faults import mark
from rotemina.sim.robot.model import Robot
from rotemina.sim.robot.writing import write_robot

_LISTENING = re.compile(r"listening on (?P<port>.+): (?P<who>board .+)")
_COMPLAINT = "rotemina: "  # begins each line of what the command refuses
_END_MS = 1500
# Where nothing but sockets can be waited for, a process has no commands either.
TAKES_COMMANDS = os.name == "posix"


class BoardProcess(QObject):
    """Starts ``rotemina board``, reports its ports, and sends it fault commands.

    Signals
    -------
    listening(list of (port, who)) : all its ports are there.
    said(str) : a line of what it tells.
    complained(str) : a line of what it refuses.
    ended(str) : why, or "" where that was requested.
    """

    listening = Signal(object)
    said = Signal(str)
    complained = Signal(str)
    ended = Signal(str)

    def __init__(self, robot: Robot, parent: QObject) -> None:
        super().__init__(parent)
        self._robot = robot
        self._asked_to_end = False
        self._expected = 0
        self._ports: list[tuple[str, str]] = []
        self._complaint = ""
        self._folder: tempfile.TemporaryDirectory[str] | None = None
        self._process = QProcess(self)
        self._process.readyReadStandardOutput.connect(self._read)
        self._process.readyReadStandardError.connect(self._read_complaints)
        self._process.finished.connect(lambda *_: self._finish())
        self._process.errorOccurred.connect(self._fail)

    @property
    def running(self) -> bool:
        """Whether there is a process."""
        return self._process.state() is not QProcess.ProcessState.NotRunning

    @property
    def ports(self) -> tuple[tuple[str, str], ...]:
        """The ports that it listens on, and who is there."""
        return tuple(self._ports)

    def start(self, lines: int, *, homed: bool) -> None:
        """Start it with so many lines, 1 or 2; where the steppers are is known if ``homed``.

        Raises
        ------
        InputError
            If the robot cannot be written for it.
        """
        if self.running:
            return
        self._folder = tempfile.TemporaryDirectory(prefix="rotemina-")
        described = Path(self._folder.name) / "robot.toml"
        write_robot(self._robot, described)
        self._asked_to_end, self._expected, self._ports, self._complaint = False, lines, [], ""
        words = ["-m", "rotemina.app.cli.main", "board", "--robot", str(described)]
        if TAKES_COMMANDS:
            words += ["--until-stdin-closes"]
            words += ["--bus"] if lines == 1 and len(self._robot.axes) > 3 else []
        else:
            words += ["--tcp", "127.0.0.1:0"] * lines
        words += ["--position-known"] if homed else []
        self._process.start(sys.executable, words)

    def inject(self, command: str) -> None:
        """Send a fault command; the process reports errors."""
        self._process.write(f"{command}\n".encode())

    def end(self) -> None:
        """Ask it to end; this waits for nothing."""
        self._asked_to_end = True
        self._process.closeWriteChannel()
        self._process.terminate()

    def close(self) -> None:
        """End it, and wait until it has: the window goes."""
        if self.running:
            self.end()
            if not self._process.waitForFinished(_END_MS):
                self._process.kill()
                self._process.waitForFinished(_END_MS)

    def _read(self) -> None:
        while self._process.canReadLine():
            line = bytes(self._process.readLine().data()).decode("utf-8", "replace").strip()
            found = _LISTENING.fullmatch(line)
            if found is None:
                self.said.emit(line)
                continue
            self._ports.append((found["port"], found["who"]))
            if len(self._ports) == self._expected:
                self.listening.emit(self.ports)

    def _read_complaints(self) -> None:
        text = bytes(self._process.readAllStandardError().data()).decode("utf-8", "replace")
        for line in filter(None, map(str.strip, text.splitlines())):
            if line.startswith(_COMPLAINT):
                self._complaint = line.removeprefix(_COMPLAINT)
                self.complained.emit(self._complaint)
            else:  # what the command tells besides, such as the robot file it uses
                self.said.emit(line)

    def _fail(self, error: QProcess.ProcessError) -> None:
        if error is QProcess.ProcessError.FailedToStart:
            self._complaint = self._process.errorString()
            self._finish()

    def _finish(self) -> None:
        self._ports = []
        if self._folder is not None:
            self._folder.cleanup()
            self._folder = None
        if self._asked_to_end:
            self.ended.emit("")
        else:
            self.ended.emit(self._complaint or mark("the virtual board ended by itself"))

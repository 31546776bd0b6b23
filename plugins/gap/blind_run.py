"""A blind test under way as a separate process: its progress, its end, and its stop."""

import sys
from collections.abc import Sequence
from pathlib import Path

from PySide6.QtCore import QObject, QProcess, QTimer, Signal

from rotemina.plugins.gap import tr
from rotemina.plugins.gap.blind_figures import BlindResult, step
from rotemina.sim.errors import InputError

_WORKER = ("-m", "rotemina.plugins.gap.blind_worker")
_PATIENCE_MS = 5000  # before a process that was asked to end is ended
_LAST = 400  # characters of what it said in the end


class BlindRun(QObject):
    """Runs one blind test at a time; what is done is kept in its folder, case by case.

    Signals
    -------
    progressed(int, int) : cases done now, of how many that were not done before.
    finished(BlindResult)
    stopped() : it was ended before its time.
    failed(str)
    """

    progressed = Signal(int, int)
    finished = Signal(object)
    stopped = Signal()
    failed = Signal(str)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._process: QProcess | None = None
        self._out = Path()
        self._said = ""
        self._wanted = False

    @property
    def running(self) -> bool:
        """Whether a process works, be it on its end."""
        return self._process is not None

    def start(self, robot: str, cases: int, seed: int, folder: Path, *, score: bool) -> None:
        """Begin, or continue where a test of these cases was stopped; ``score``: only score it."""
        assert not self.running
        arguments = ["--cases", str(cases), "--seed", str(seed), "--robot", robot]
        # One process at a time: a core stays free for the machine and the window.
        arguments += ["--jobs", "1", "--folder", str(folder)]
        self._out = folder / "score.json"
        arguments += ["--json", str(self._out), *(["--score"] if score else [])]
        self._begin([sys.executable, *_WORKER, *arguments])

    def _begin(self, command: Sequence[str]) -> None:
        process = self._process = QProcess(self)
        self._said, self._wanted = "", True
        process.setStandardOutputFile(QProcess.nullDevice())
        process.readyReadStandardError.connect(self._hear)
        process.finished.connect(self._end)
        process.errorOccurred.connect(self._fail_to_start)
        process.start(command[0], list(command[1:]))

    def stop(self) -> None:
        """End it; the case under way is lost, those that are done stay."""
        if self._process is not None and self._wanted:
            self._wanted = False
            process = self._process
            process.terminate()
            QTimer.singleShot(_PATIENCE_MS, process, process.kill)

    def close(self) -> None:
        """End it, and wait for that."""
        if self._process is not None:
            self.stop()
            if not self._process.waitForFinished(_PATIENCE_MS):
                self._process.kill()
                self._process.waitForFinished(_PATIENCE_MS)

    def _hear(self) -> None:
        assert self._process is not None
        text = bytes(self._process.readAllStandardError().data()).decode("utf-8", "replace")
        for line in text.splitlines():
            told = step(line)
            if told is not None and self._wanted:
                self.progressed.emit(*told)
        self._said = (self._said + text)[-_LAST:]

    def _end(self, status: int, _how: QProcess.ExitStatus) -> None:
        if self._process is None:
            return
        self._hear()
        self._process.deleteLater()
        self._process = None
        if not self._wanted:
            self.stopped.emit()
        elif status != 0:
            self.failed.emit(
                tr("The blind test has ended: {reason}").format(
                    reason=self._said.strip() or f"status {status}"
                )
            )
        else:
            self._read()

    def _read(self) -> None:
        try:
            self.finished.emit(BlindResult.read(self._out))
        except InputError as error:
            self.failed.emit(str(error))

    def _fail_to_start(self, error: QProcess.ProcessError) -> None:
        if error is QProcess.ProcessError.FailedToStart and self._process is not None:
            self._process.deleteLater()
            self._process = None
            self.failed.emit(
                tr("{program}: the blind test cannot be started").format(program=sys.executable)
            )

"""Runs a blind test in a separate process, and reports its progress and end."""

import sys
from collections.abc import Sequence
from pathlib import Path

from PySide6.QtCore import QObject, QProcess, QTimer, Signal

from rotemina.plugins.gap import tr
from rotemina.plugins.gap.blind.blind_figures import BlindResult, parse_progress
from rotemina.sim.errors import InputError

_COMMAND_ARGUMENTS = ("-m", "rotemina.app.cli.main", "gap", "blind")

# A process that does not end within this time after it was asked to is killed.
_TERMINATE_TIMEOUT_MS = 5000

# A report of a failure includes this many of the last characters of the output.
_MAX_OUTPUT_CHARS = 400


class BlindTestProcess(QObject):
    """Runs one blind test at a time. Finished cases are kept in the folder of the test.

    Signals
    -------
    progressed(int, int) : number of cases completed in this run, and number of cases to run.
    finished(BlindResult) : all cases are scored.
    stopped() : the test was stopped before its end.
    failed(str) : the test has failed for this reason.
    """

    progressed = Signal(int, int)
    finished = Signal(object)
    stopped = Signal()
    failed = Signal(str)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._process: QProcess | None = None
        self._score_file = Path()
        self._output = ""
        self._is_stopping = False

    @property
    def running(self) -> bool:
        """Whether the process is running, even if it was asked to end."""
        return self._process is not None

    def start(self, robot: str, cases: int, seed: int, folder: Path, *, score: bool) -> None:
        """Start a test, or resume one with these cases; with ``score``, only score it."""
        assert not self.running
        arguments = ["--cases", str(cases), "--seed", str(seed), "--robot", robot]
        # One job at a time leaves a core free for the machine and the window.
        arguments += ["--jobs", "1", "--folder", str(folder)]
        self._score_file = folder / "score.json"
        arguments += ["--json", str(self._score_file), *(["--score"] if score else [])]
        self._begin([sys.executable, *_COMMAND_ARGUMENTS, *arguments])

    def _begin(self, command: Sequence[str]) -> None:
        process = self._process = QProcess(self)
        self._output, self._is_stopping = "", False
        process.setStandardOutputFile(QProcess.nullDevice())
        process.readyReadStandardError.connect(self._read_output)
        process.finished.connect(self._on_finished)
        process.errorOccurred.connect(self._on_error)
        process.start(command[0], list(command[1:]))

    def stop(self) -> None:
        """Stop the test. The running case is lost, and the finished ones are kept."""
        if self._process is not None and not self._is_stopping:
            self._is_stopping = True
            process = self._process
            process.terminate()
            QTimer.singleShot(_TERMINATE_TIMEOUT_MS, process, process.kill)

    def close(self) -> None:
        """Stop the test and wait until its process has ended."""
        if self._process is not None:
            self.stop()
            if not self._process.waitForFinished(_TERMINATE_TIMEOUT_MS):
                self._process.kill()
                self._process.waitForFinished(_TERMINATE_TIMEOUT_MS)

    def _read_output(self) -> None:
        assert self._process is not None
        text = bytes(self._process.readAllStandardError().data()).decode("utf-8", "replace")
        for line in text.splitlines():
            progress = parse_progress(line)
            if progress is not None and not self._is_stopping:
                self.progressed.emit(*progress)
        self._output = (self._output + text)[-_MAX_OUTPUT_CHARS:]

    def _on_finished(self, exit_code: int, _exit_status: QProcess.ExitStatus) -> None:
        if self._process is None:
            return
        self._read_output()
        self._process.deleteLater()
        self._process = None
        if self._is_stopping:
            self.stopped.emit()
        elif exit_code != 0:
            self.failed.emit(
                tr("The blind test has ended: {reason}").format(
                    reason=self._output.strip() or f"status {exit_code}"
                )
            )
        else:
            self._read_result()

    def _read_result(self) -> None:
        try:
            self.finished.emit(BlindResult.read(self._score_file))
        except InputError as error:
            self.failed.emit(str(error))

    def _on_error(self, error: QProcess.ProcessError) -> None:
        if error is QProcess.ProcessError.FailedToStart and self._process is not None:
            self._process.deleteLater()
            self._process = None
            self.failed.emit(
                tr("{program}: the blind test cannot be started").format(program=sys.executable)
            )

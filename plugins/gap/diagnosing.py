"""A diagnosis under way, away from the window's thread: its progress, its end, and its stop."""

import time
from collections.abc import Sequence
from threading import Event

from PySide6.QtCore import QObject, QTimer, Signal

from rotemina.app.display_units import label
from rotemina.app.shell.background import Background
from rotemina.plugins.gap import tr
from rotemina.plugins.gap.diagnosis_answer import Answer
from rotemina.plugins.gap.diagnosis_process import DiagnosisProcess
from rotemina.plugins.gap.words import effect_word, stage_name
from rotemina.sim.gap.compare.diagnosis_progress import Progress
from rotemina.sim.quantities import fixed
from rotemina.sim.records.record import Record
from rotemina.sim.robot.model import Robot

_FIRST_GUESS_S = 1.0  # before which nothing is said of the time left
_FIRST_GUESS_SHARE = 0.02
_RETELL_MS = 500


class StoppedError(Exception):
    """The operator has cancelled the request."""


class Diagnosing(QObject):
    """Runs one diagnosis at a time.

    The workbench's own thread stays free for what must not wait: a record that was played is
    written down and compared while a diagnosis continues.

    Signals
    -------
    progressed(str, float) : what is done now, in words, and the share that is done.
    stepped(Progress) : a step was begun, or another candidate tried.
    finished(Answer)
    failed(str)
    """

    progressed = Signal(str, float)
    stepped = Signal(object)
    finished = Signal(object)
    failed = Signal(str)
    _heard = Signal(int, object)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._background = Background(self)
        self._process = DiagnosisProcess()
        self._number = 0
        self._stopped = Event()
        self._stopped.set()
        self._began_s = 0.0
        self._step: tuple[Progress, float] | None = None  # the last, and when it came
        self._clock = QTimer(self, interval=_RETELL_MS)
        self._clock.timeout.connect(self._tell)
        self._heard.connect(self._hear)

    @property
    def running(self) -> bool:
        """Whether an answer is awaited."""
        return not self._stopped.is_set()

    @property
    def busy(self) -> bool:
        """Whether a thread still works, be it on what was stopped."""
        return self._background.busy

    def start(self, robot: Robot, names: Sequence[str], records: Sequence[Record]) -> None:
        """Diagnose records; what ran before is stopped."""
        self.stop()
        self._number += 1
        number = self._number
        stopped = self._stopped = Event()
        self._began_s, self._step = time.monotonic(), None
        self._clock.start()

        latest: Progress | None = None

        def listen(progress: Progress) -> None:
            nonlocal latest
            if stopped.is_set():
                raise StoppedError
            if progress is not latest:  # which is told again and again
                latest = progress
                self._heard.emit(number, progress)

        def work() -> Answer | None:
            try:
                return self._process.answer(robot, names, records, listen)
            except StoppedError:
                return None

        self._background.run(
            "diagnosis",
            work,
            lambda answer: self._end(number, answer),
            lambda message: self._fail(number, message),
        )

    def stop(self) -> None:
        """Discard the answer; the work ends at its next step, without waiting."""
        self._stopped.set()
        self._clock.stop()

    def stand_back(self) -> None:
        """Let a machine that moves have the cores first, even before work that was stopped."""
        if self.busy:
            self._process.stand_back()

    def close(self) -> None:
        """Stop, and wait until thread and process have ended."""
        self.stop()
        self._background.end()
        self._process.close()

    def _is_wanted(self, number: int) -> bool:
        return number == self._number and self.running

    def _hear(self, number: int, progress: Progress) -> None:
        if self._is_wanted(number):
            self._step = progress, time.monotonic() - self._began_s
            self.stepped.emit(progress)
            self._tell()

    def _tell(self) -> None:
        if self._step is not None:
            progress, at_s = self._step
            text = said(progress, at_s, time.monotonic() - self._began_s)
            self.progressed.emit(text, progress.share)

    def _end(self, number: int, answer: Answer | None) -> None:
        if self._is_wanted(number):
            self.stop()
            self.finished.emit(answer)

    def _fail(self, number: int, message: str) -> None:
        if self._is_wanted(number):
            self.stop()
            self.failed.emit(message)


def said(progress: Progress, at_s: float, now_s: float) -> str:
    """Return what is done since ``at_s``, for how long all has run, and what the rest may take."""
    text = stage_name(progress.stage)
    if progress.axis is not None:
        text += f" {label(progress.axis)}"
    if progress.candidate is not None:
        text += f": {effect_word(progress.candidate)}"
    if now_s < _FIRST_GUESS_S:
        return text
    text += f", {fixed(now_s, 0)} s"
    if progress.share < _FIRST_GUESS_SHARE:
        return text
    left_s = at_s / progress.share - now_s
    if left_s < 1.0:
        return text
    return tr("{doing}, about {time:.0f} s left").format(doing=text, time=left_s)

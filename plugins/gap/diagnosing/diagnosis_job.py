"""Runs a diagnosis in the background, and reports its progress and end."""

import time
from collections.abc import Sequence
from threading import Event

from PySide6.QtCore import QObject, QTimer, Signal

from rotemina.app.language import get_axis_label
from rotemina.app.workbench import BackgroundWorker
from rotemina.plugins.gap import tr
from rotemina.plugins.gap.answer import DiagnosisAnswer, effect_word, stage_name
from rotemina.plugins.gap.diagnosing.diagnosis_process import DiagnosisProcess
from rotemina.sim.gap.result import Progress
from rotemina.sim.messages import format_fixed
from rotemina.sim.records import Record
from rotemina.sim.robot import Robot

# The remaining time is shown only after this time and this fraction of the work, because earlier
# estimates are far off.
_MIN_TIME_FOR_ESTIMATE_S = 1.0
_MIN_FRACTION_FOR_ESTIMATE = 0.02
_TEXT_UPDATE_MS = 500


class DiagnosisStoppedError(Exception):
    """The operator has cancelled the request."""


class BackgroundDiagnosis(QObject):
    """Runs one diagnosis at a time on a separate thread.

    The workbench's thread stays free for urgent work: a record that was just played is saved and
    compared while a diagnosis continues.

    Signals
    -------
    progressed(str, float) : a text about the current step, and the completed fraction.
    stepped(Progress) : a step began, or another candidate was tried.
    finished(DiagnosisAnswer) : there is an answer.
    failed(str) : the diagnosis has failed for this reason.
    """

    progressed = Signal(str, float)
    stepped = Signal(object)
    finished = Signal(object)
    failed = Signal(str)
    _progress_received = Signal(int, object)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._background = BackgroundWorker(self)
        self._process = DiagnosisProcess()
        self._run_number = 0
        self._stop_event = Event()
        self._stop_event.set()
        self._start_s = 0.0
        # The latest step, and the time from the start of the diagnosis to this step, s.
        self._step: tuple[Progress, float] | None = None
        self._clock = QTimer(self, interval=_TEXT_UPDATE_MS)
        self._clock.timeout.connect(self._report_progress)
        self._progress_received.connect(self._on_progress)

    @property
    def running(self) -> bool:
        """Whether a diagnosis is running and was not stopped."""
        return not self._stop_event.is_set()

    @property
    def busy(self) -> bool:
        """Whether the thread is busy, perhaps with a stopped diagnosis that has not ended yet."""
        return self._background.busy

    def start(self, robot: Robot, names: Sequence[str], records: Sequence[Record]) -> None:
        """Diagnose records. Stop the running diagnosis first, if any."""
        self.stop()
        self._run_number += 1
        run_number = self._run_number
        stop_event = self._stop_event = Event()
        self._start_s, self._step = time.monotonic(), None
        self._clock.start()

        latest: Progress | None = None

        def listen(progress: Progress) -> None:
            nonlocal latest
            if stop_event.is_set():
                raise DiagnosisStoppedError
            # The latest step is reported repeatedly while it continues.
            if progress is not latest:
                latest = progress
                self._progress_received.emit(run_number, progress)

        def diagnose() -> DiagnosisAnswer | None:
            try:
                return self._process.diagnose(robot, names, records, listen)
            except DiagnosisStoppedError:
                return None

        self._background.run(
            "diagnosis",
            diagnose,
            lambda answer: self._on_answer(run_number, answer),
            lambda message: self._on_failure(run_number, message),
        )

    def stop(self) -> None:
        """Stop the diagnosis at its next step, without waiting for it."""
        self._stop_event.set()
        self._clock.stop()

    def lower_priority(self) -> None:
        """Lower the priority of the process, so that a moving machine gets the cores first.

        This also matters for a stopped diagnosis, until its process ends.
        """
        if self.busy:
            self._process.lower_priority()

    def close(self) -> None:
        """Stop the diagnosis, and wait until the thread and the process have ended."""
        self.stop()
        self._background.end()
        self._process.close()

    def _is_current(self, run_number: int) -> bool:
        return run_number == self._run_number and self.running

    def _on_progress(self, run_number: int, progress: Progress) -> None:
        if self._is_current(run_number):
            self._step = progress, time.monotonic() - self._start_s
            self.stepped.emit(progress)
            self._report_progress()

    def _report_progress(self) -> None:
        if self._step is not None:
            progress, step_start_s = self._step
            text = describe_progress(progress, step_start_s, time.monotonic() - self._start_s)
            self.progressed.emit(text, progress.share)

    def _on_answer(self, run_number: int, answer: DiagnosisAnswer | None) -> None:
        if self._is_current(run_number):
            self.stop()
            self.finished.emit(answer)

    def _on_failure(self, run_number: int, message: str) -> None:
        if self._is_current(run_number):
            self.stop()
            self.failed.emit(message)


def describe_progress(progress: Progress, at_s: float, now_s: float) -> str:
    """Describe a step of a diagnosis, with the elapsed and the remaining time.

    The step began at ``at_s``, and it is now ``now_s``, both in seconds from the start.
    """
    text = stage_name(progress.stage)
    if progress.axis is not None:
        text += f" {get_axis_label(progress.axis)}"
    if progress.candidate is not None:
        text += f": {effect_word(progress.candidate)}"
    if now_s < _MIN_TIME_FOR_ESTIMATE_S:
        return text
    text += f", {format_fixed(now_s, 0)} s"
    if progress.share < _MIN_FRACTION_FOR_ESTIMATE:
        return text
    remaining_s = at_s / progress.share - now_s
    if remaining_s < 1.0:
        return text
    return tr("{doing}, about {time:.0f} s left").format(doing=text, time=remaining_s)

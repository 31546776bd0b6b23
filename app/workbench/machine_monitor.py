"""Events of the machine, delivered on the window's thread and reported as notices."""

import logging
from collections.abc import Callable

from PySide6.QtCore import QObject, Signal

from rotemina.app.language import translate, translate_message
from rotemina.app.motion.model import ModelInUse
from rotemina.app.motion.state import (
    AlarmRaised,
    CommandRefused,
    ConnectionState,
    FaultRaised,
    ModelChanged,
    PlaybackFinished,
    SessionEvent,
    StopRequested,
)
from rotemina.app.workbench.help_topics import IsSettled, NoticeMessage, get_message_page
from rotemina.app.workbench.job_runner import JobRunner
from rotemina.app.workbench.notice_poster import Level, NoticePoster
from rotemina.app.workbench.operator_requests import OperatorRequests

logger = logging.getLogger(__name__)


class MachineMonitor(QObject):
    """Monitor of the machine and of the model in use.

    Its faults, alarms and refusals become notices, which disappear when their cause is gone.

    Signals
    -------
    stopped() : a stop was requested; questions that wait for an answer are withdrawn.
    playback_finished(PlaybackFinished) : a playback that the operator sees has ended.
    model_replaced(ModelInUse) : predictions now use another model.
    """

    stopped = Signal()
    playback_finished = Signal(object)
    model_replaced = Signal(object)
    _event_received = Signal(object)

    def __init__(self, requests: OperatorRequests, jobs: JobRunner, notices: NoticePoster) -> None:
        super().__init__(requests)
        self._session, self._jobs, self._notices = requests.session, jobs, notices
        self._event_received.connect(self._on_event)
        requests.refused.connect(self._report_refusal)
        requests.withdrawn.connect(self._report_withdrawal)
        self._unsubscribe = requests.session.subscribe(self._event_received.emit)

    def close(self) -> None:
        """Report no more events."""
        self._unsubscribe()

    def use_model(self, make: Callable[[], ModelInUse]) -> None:
        """Make predictions with another model; a refusal becomes a notice."""

        def work() -> None:
            self._session.use_model(make())

        self._jobs.work("model", translate("shell", "Switching the model …"), work, lambda _: None)

    def use_nominal_model(self) -> None:
        """Return to the model of the robot file."""
        self.use_model(lambda: ModelInUse.make_nominal(self._session.driver))

    def _report_refusal(self, reason: str) -> None:
        self._notices.notify(Level.ERROR, reason, about=get_message_page(reason))

    def _report_withdrawal(self, text: str) -> None:
        self._notices.notify(Level.WARNING, text, about="motion.md#requests-that-wait")

    def _on_event(self, event: SessionEvent) -> None:
        if isinstance(event, FaultRaised):
            self._notices.notify(
                Level.ERROR, event.message, about=event, until=self._make_fault_check()
            )
        elif isinstance(event, CommandRefused):
            text = NoticeMessage(event.message, is_refusal=True)
            self._notices.notify(Level.ERROR, text, about=event, until=self._make_device_check())
        elif isinstance(event, AlarmRaised):
            self._notices.notify(
                Level.WARNING, event.message, about=event, until=self._make_device_check()
            )
        elif isinstance(event, StopRequested):
            logger.info("%s", event.request)
            self.stopped.emit()
        elif isinstance(event, PlaybackFinished) and event.shown:
            self.playback_finished.emit(event)
        elif isinstance(event, ModelChanged):
            self._on_model_changed(event)

    def _on_model_changed(self, event: ModelChanged) -> None:
        logger.info("model in use: %s", event.model.id)
        if event.why:
            text = translate("shell", "The nominal model is in use again: {why}.")
            self._notices.notify(
                Level.WARNING,
                text.format(why=translate_message(event.why)),
                about="model.md",
                until=lambda _: self._session.model is not event.model,
            )
        self.model_replaced.emit(event.model)

    def _make_device_check(self) -> IsSettled:
        """Return a function that tells whether the device was changed after this call."""
        driver = self._session.driver
        return lambda _: self._session.driver is not driver

    def _make_fault_check(self) -> IsSettled | None:
        """Return a function that tells whether the current fault is over, or None without a fault.

        A fault is over when it is cleared, a lost link when the device is connected again, and a
        doubtful position when it is confirmed. Each is also over when another device is in use.
        """
        state, is_other_device = self._session.snapshot(), self._make_device_check()
        if state.connection is not ConnectionState.CONNECTED:
            return lambda later_state: (
                is_other_device(later_state) or later_state.connection is ConnectionState.CONNECTED
            )
        if state.fault is not None:
            return lambda later_state: is_other_device(later_state) or later_state.fault is None
        if state.doubt is not None:
            return lambda later_state: is_other_device(later_state) or later_state.doubt is None
        return None

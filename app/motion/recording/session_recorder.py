"""Records a motion session: samples, actions, inputs and messages on the host's clock."""

import hashlib
import json
import logging
import threading
import time
from collections.abc import Callable, Mapping
from importlib.metadata import version
from pathlib import Path

from rotemina.app.motion.inputs import Intent
from rotemina.app.motion.model import ModelOutputs
from rotemina.app.motion.recording.arrow_tables import find_axis_units
from rotemina.app.motion.recording.writer import RecordingWriter
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import (
    AlarmRaised,
    CommandRefused,
    ConnectionState,
    FaultRaised,
    ModelChanged,
    PlaybackFinished,
    SessionEvent,
    SessionState,
    StateChanged,
)
from rotemina.app.settings import FileOpener, open_new_file
from rotemina.drivers.abilities import EffectCarrier
from rotemina.drivers.contract import Clock, DeviceSamples, DeviceState
from rotemina.drivers.inputs import InputDevice, InputReading
from rotemina.sim.robot_files import format_robot

_EVENT_KINDS = {FaultRaised: "fault", AlarmRaised: "alarm", CommandRefused: "refused"}


class SessionRecorder:
    """Records a session from :meth:`start` to :meth:`close`; motion never waits for the recorder.

    The recorder takes samples, states, faults, refusals, stops and playbacks from the session.
    Callers on any thread add readings of sticks, frames, notes and log lines. All times are times
    of the session's clock.

    Parameters
    ----------
    session : MotionSession
    path : Path
        Path of the finished recording, usually ``*.arrows``. Until it is finished, the data are in
        ``PATH.part``.
    settings : mapping
        Settings of the program, valid as JSON. They are stored together with their digest.
    began : str
        Date and time of the start, for display.
    clock : callable
        Clock of the session.
    notify : callable
        Called with messages for the operator, on the recorder's thread.
    opener : callable
        Creates the file.

    Raises
    ------
    RecordingError
        If the file exists already or cannot be created.
    """

    def __init__(
        self,
        session: MotionSession,
        path: Path,
        *,
        settings: Mapping[str, object] | None = None,
        began: str = "",
        clock: Clock = time.monotonic,
        notify: Callable[[str], None] = lambda _: None,
        opener: FileOpener = open_new_file,
    ) -> None:
        self._session = session
        self._clock = clock
        metadata = _make_metadata(session, settings or {}, began)
        units = find_axis_units(session.robot)
        self.writer = RecordingWriter(
            path, units, metadata, clock=clock, notify=notify, opener=opener
        )
        self._last_state: SessionState | None = None
        self._stop_count = session.epoch.stops
        self._last_intent = Intent(0.0)
        self._calibration_names = session.corrections.names
        self._lock = threading.Lock()
        self._log_handler = _LogRecorder(self)
        self._unsubscribers: tuple[Callable[[], None], ...] = ()

    def start(self, *, thread: bool = True) -> None:
        """Start recording; if ``thread`` is false, the caller must call ``writer.run_once``."""
        self._record_state(self._session.snapshot())
        self._unsubscribers = (
            self._session.subscribe(self._on_event),
            self._session.tap(self._on_samples),
        )
        logging.getLogger().addHandler(self._log_handler)
        if thread:
            self.writer.start()

    def close(self) -> Path:
        """End the recording and return the finished file; safe to call twice.

        This takes as long as copying the file.

        Raises
        ------
        RecordingError
            If the file cannot be finished. The data can be recovered.
        """
        for unsubscribe in self._unsubscribers:
            unsubscribe()
        logging.getLogger().removeHandler(self._log_handler)
        return self.writer.close()

    def record_values(self, channel: str, host_time_s: float, values: Mapping[str, float]) -> None:
        """Record named values of a channel, such as the frame times of a camera."""
        self.writer.add_row(channel, host_time_s, values)

    def record_reading(self, device: InputDevice, reading: InputReading) -> None:
        """Record the reading of an input device: axes, −1 to 1, and buttons, 0 or 1."""
        names = (*device.axes, *device.buttons)
        values = (*reading.axes, *map(float, reading.buttons))
        values_by_name = dict(zip(names, values, strict=True))
        self.writer.add_row(f"input {device.identity.key}", reading.host_time_s, values_by_name)

    def record_intent(self, intent: Intent) -> None:
        """Record the operator's intent: the deflections, and the actions that have changed."""
        self.writer.add_row("intent", intent.host_time_s, intent.deflections)
        with self._lock:
            old_intent, self._last_intent = self._last_intent, intent
        changes = [
            *(f"pressed {action}" for action in sorted(intent.pressed)),
            *(f"holds {action}" for action in sorted(intent.held - old_intent.held)),
            *(f"released {action}" for action in sorted(old_intent.held - intent.held)),
        ]
        if intent.device != old_intent.device:
            changes.append(f"driven by {intent.device or 'nothing'}")
        if intent.loss_reason is not None and intent.loss_reason != old_intent.loss_reason:
            changes.append(f"lost: {intent.loss_reason}")
        for change in changes:
            self.writer.add_event("action", change, host_time_s=intent.host_time_s)

    def record_note(self, text: str) -> None:
        """Record a remark of the operator."""
        self.writer.add_event("note", text)

    def _on_samples(self, samples: DeviceSamples, outputs: ModelOutputs) -> None:
        """Record a batch of samples; called on the session's thread."""
        state = self._session.snapshot()
        self._record_stop(state)
        self._record_calibrations()
        received_s = state.sample_host_time_s
        host_time_s = self._clock() if received_s is None else received_s
        self.writer.add(samples, outputs.in_use, host_time_s)

    def _on_event(self, event: SessionEvent) -> None:
        if isinstance(event, StateChanged):
            self._record_state(event.state)
        elif isinstance(event, FaultRaised | AlarmRaised | CommandRefused):
            self.writer.add_event(_EVENT_KINDS[type(event)], event.message)
        elif isinstance(event, PlaybackFinished):
            rows = 0 if event.record is None else len(event.record.time_s)
            text = "completed" if event.completed else "ended early"
            self.writer.add_event(
                "playback_end", text, {"completed": event.completed, "rows": rows}
            )
        elif isinstance(event, ModelChanged):
            self.writer.add_event("model", event.model.id, {"why": event.why})

    def _record_state(self, state: SessionState) -> None:
        old_state, self._last_state = self._last_state, state
        old_connection = ConnectionState.DISCONNECTED if old_state is None else old_state.connection
        if state.connection is ConnectionState.CONNECTING or old_state is None:
            self.writer.start_connection()
        if state.connection is not old_connection:
            driver = self._session.driver
            details = {
                "driver": driver.name,
                "machine_kind": driver.machine_kind,
                "settings": dict(driver.settings),
            }
            self.writer.add_event("connection", state.connection, details)
        was_playing = old_state is not None and old_state.activity is DeviceState.PLAYING
        if state.activity is DeviceState.PLAYING and not was_playing:
            self.writer.add_event("playback_begin", "")
        self._record_stop(state)
        self.writer.add_event("state", state.phase, _select_state_fields(state))

    def _record_calibrations(self) -> None:
        names = self._session.corrections.names
        if names != self._calibration_names:
            self._calibration_names = names
            text = ", ".join(f"{axis}: {name}" for axis, name in names.items())
            self.writer.add_event("calibration", text or "none", names)

    def _record_stop(self, state: SessionState) -> None:
        stops, requested_s = self._session.epoch.stops, self._session.stop_requested_s
        if requested_s is not None and stops != self._stop_count:
            self._stop_count = stops
            details = {} if state.stop is None else {"by": state.stop.by, "why": state.stop.why}
            self.writer.add_event(
                "stop", str(state.stop or "stop"), details, host_time_s=requested_s
            )


class _LogRecorder(logging.Handler):
    """Log handler that records the program's log lines. It must neither fail nor log."""

    def __init__(self, recorder: SessionRecorder) -> None:
        super().__init__(logging.INFO)
        self._recorder = recorder

    def emit(self, record: logging.LogRecord) -> None:
        """Record a line with its level and logger."""
        try:
            text = record.getMessage()
            details = {"level": record.levelname, "logger": record.name}
            self._recorder.writer.add_event("log", text, details)
        except Exception:
            self.handleError(record)


def _make_metadata(
    session: MotionSession, settings: Mapping[str, object], began: str
) -> dict[str, str]:
    robot_file = format_robot(session.robot)
    driver = session.driver
    effects = driver.effects_text if isinstance(driver, EffectCarrier) else ""
    settings_json = json.dumps(dict(settings), sort_keys=True, default=str)
    return {
        "program": f"rotemina {version('rotemina')}",
        "began": began,
        "robot": session.robot.name,
        "robot_file": robot_file,
        "robot_sha256": hashlib.sha256(robot_file.encode()).hexdigest(),
        "driver": driver.name,
        "machine_kind": driver.machine_kind,
        "driver_settings": json.dumps(dict(driver.settings), default=str),
        "model": session.model.id,
        **session.labels.metadata,
        **({"effects": effects} if effects else {}),
        "calibrations": json.dumps(session.corrections.names, sort_keys=True),
        "settings": settings_json,
        "settings_sha256": hashlib.sha256(settings_json.encode()).hexdigest(),
    }


def _select_state_fields(state: SessionState) -> dict[str, object]:
    """Return the fields of a state that a replay shows; the positions are in the samples."""
    return {
        "connection": state.connection,
        "activity": state.activity,
        "progress": state.progress,
        "position_known": state.position_known,
        "fault": state.fault,
        "locked": state.lock_reason,
        "unhomed": list(state.unhomed),
        "silent_s": state.silent_s,
        "stopping": state.stopping,
        "latched": state.latch_reason,
        "differences": list(state.differences),
        "model_id": state.model_id,
        "unsettled": list(state.unsettled),
    }

"""Records a motion session: its actions, inputs and messages, on the host's clock."""

import hashlib
import json
import logging
import threading
import time
from collections.abc import Callable, Mapping
from importlib.metadata import version
from pathlib import Path

from rotemina.app.files import Opener, new_file
from rotemina.app.motion.live_models import ModelOutputs
from rotemina.app.motion.recording.arrow_tables import units_of
from rotemina.app.motion.recording.writer import RecordingWriter
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import (
    Alarmed,
    CommandRefused,
    Connection,
    Event,
    Faulted,
    ModelChanged,
    PlaybackFinished,
    SessionState,
    StateChanged,
)
from rotemina.app.motion.teleoperation.intent import Intent
from rotemina.drivers.clock import Clock
from rotemina.drivers.inputs.device import InputDevice, InputReading
from rotemina.drivers.model_abilities import EffectCarrier
from rotemina.drivers.samples import DeviceState, Samples
from rotemina.sim.robot.writing import robot_text

_KINDS = {Faulted: "fault", Alarmed: "alarm", CommandRefused: "refused"}


class SessionRecorder:
    """Records a session from :meth:`start` to :meth:`close`; motion never waits for it.

    Samples, states, faults, refusals, stops and playbacks come from the session; sticks, frames,
    notes and log lines are handed over, from any thread, all with times of the session's clock.

    Parameters
    ----------
    session : MotionSession
    path : Path
        Of the finished recording, by custom ``*.arrows``; until then it is in ``PATH.part``.
    settings : mapping
        What the program was set to, as JSON can hold it; it is kept with its digest.
    began : str
        Date and time, for people.
    clock : callable
        The session's.
    tell : callable
        Gets what the operator must know, on the recorder's thread.
    opener : callable
        How the file is made.

    Raises
    ------
    RecordingError
        If there is a file already, or none can be made.
    """

    def __init__(
        self,
        session: MotionSession,
        path: Path,
        *,
        settings: Mapping[str, object] | None = None,
        began: str = "",
        clock: Clock = time.monotonic,
        tell: Callable[[str], None] = lambda _: None,
        opener: Opener = new_file,
    ) -> None:
        self._session = session
        self._clock = clock
        metadata = _metadata(session, settings or {}, began)
        units = units_of(session.robot)
        self.writer = RecordingWriter(path, units, metadata, clock=clock, tell=tell, opener=opener)
        self._seen: SessionState | None = None
        self._stops = session.epoch.stops
        self._intent = Intent(0.0)
        self._calibrations = session.corrections.names
        self._lock = threading.Lock()
        self._log = _LogLines(self)
        self._ends: tuple[Callable[[], None], ...] = ()

    def start(self, *, thread: bool = True) -> None:
        """Begin; without a ``thread`` the caller steps ``writer.run_once``."""
        self._note_state(self._session.snapshot())
        self._ends = (
            self._session.subscribe(self._on_event),
            self._session.tap(self._on_samples),
        )
        logging.getLogger().addHandler(self._log)
        if thread:
            self.writer.start()

    def close(self) -> Path:
        """End, and return the finished file; safe to call twice.

        It takes as long as copying the recording.

        Raises
        ------
        RecordingError
            If it cannot be finished; what was recorded stays to be recovered.
        """
        for end in self._ends:
            end()
        logging.getLogger().removeHandler(self._log)
        return self.writer.close()

    def record(self, channel: str, host_time_s: float, values: Mapping[str, float]) -> None:
        """Record numbers of a channel of any name, such as the frames of a camera."""
        self.writer.record(channel, host_time_s, values)

    def record_reading(self, device: InputDevice, reading: InputReading) -> None:
        """Record the reading of an input device: its axes, −1 to 1, and its buttons, 0 or 1."""
        names = (*device.axes, *device.buttons)
        values = (*reading.axes, *map(float, reading.buttons))
        named = dict(zip(names, values, strict=True))
        self.writer.record(f"input {device.identity.key}", reading.host_time_s, named)

    def record_intent(self, intent: Intent) -> None:
        """Record the operator's requests: deflections, and changes of actions."""
        self.writer.record("intent", intent.host_time_s, intent.deflections)
        with self._lock:
            before, self._intent = self._intent, intent
        changes = [
            *(f"pressed {action}" for action in sorted(intent.pressed)),
            *(f"holds {action}" for action in sorted(intent.held - before.held)),
            *(f"released {action}" for action in sorted(before.held - intent.held)),
        ]
        if intent.device != before.device:
            changes.append(f"driven by {intent.device or 'nothing'}")
        if intent.lost is not None and intent.lost != before.lost:
            changes.append(f"lost: {intent.lost}")
        for change in changes:
            self.writer.event("action", change, host_time_s=intent.host_time_s)

    def note(self, text: str) -> None:
        """Record what someone remarks."""
        self.writer.event("note", text)

    def _on_samples(self, samples: Samples, answers: ModelOutputs) -> None:
        """Take a portion; on the session's thread."""
        state = self._session.snapshot()
        self._note_stop(state)
        self._note_calibrations()
        received_s = state.sample_host_time_s
        host_s = self._clock() if received_s is None else received_s
        self.writer.add(samples, answers.in_use, host_s)

    def _on_event(self, event: Event) -> None:
        if isinstance(event, StateChanged):
            self._note_state(event.state)
        elif isinstance(event, Faulted | Alarmed | CommandRefused):
            self.writer.event(_KINDS[type(event)], event.message)
        elif isinstance(event, PlaybackFinished):
            rows = 0 if event.record is None else len(event.record.time_s)
            text = "completed" if event.completed else "ended early"
            self.writer.event("playback_end", text, {"completed": event.completed, "rows": rows})
        elif isinstance(event, ModelChanged):
            self.writer.event("model", event.model.id, {"why": event.why})

    def _note_state(self, state: SessionState) -> None:
        before, self._seen = self._seen, state
        was = Connection.DISCONNECTED if before is None else before.connection
        if state.connection is Connection.CONNECTING or before is None:
            self.writer.connected()
        if state.connection is not was:
            driver = self._session.driver
            about = {
                "driver": driver.name,
                "machine_kind": driver.machine_kind,
                "settings": dict(driver.settings),
            }
            self.writer.event("connection", state.connection, about)
        playing = before is not None and before.activity is DeviceState.PLAYING
        if state.activity is DeviceState.PLAYING and not playing:
            self.writer.event("playback_begin", "")
        self._note_stop(state)
        self.writer.event("state", state.phase, _told(state))

    def _note_calibrations(self) -> None:
        names = self._session.corrections.names
        if names != self._calibrations:
            self._calibrations = names
            text = ", ".join(f"{axis}: {name}" for axis, name in names.items())
            self.writer.event("calibration", text or "none", names)

    def _note_stop(self, state: SessionState) -> None:
        stops, asked_s = self._session.epoch.stops, self._session.stop_asked_s
        if asked_s is not None and stops != self._stops:
            self._stops = stops
            about = {} if state.stop is None else {"by": state.stop.by, "why": state.stop.why}
            self.writer.event("stop", str(state.stop or "stop"), about, host_time_s=asked_s)


class _LogLines(logging.Handler):
    """Hands the program's log lines on; it must never fail nor log itself."""

    def __init__(self, recorder: SessionRecorder) -> None:
        super().__init__(logging.INFO)
        self._recorder = recorder

    def emit(self, record: logging.LogRecord) -> None:
        """Record a line, with the level and where it comes from."""
        try:
            text = record.getMessage()
            about = {"level": record.levelname, "logger": record.name}
            self._recorder.writer.event("log", text, about)
        except Exception:
            self.handleError(record)


def _metadata(session: MotionSession, settings: Mapping[str, object], began: str) -> dict[str, str]:
    robot_file = robot_text(session.robot)
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


def _told(state: SessionState) -> dict[str, object]:
    """Return what of a state is shown again in a replay; positions are among the samples."""
    return {
        "connection": state.connection,
        "activity": state.activity,
        "progress": state.progress,
        "position_known": state.position_known,
        "fault": state.fault,
        "locked": state.locked,
        "unhomed": list(state.unhomed),
        "silent_s": state.silent_s,
        "stopping": state.stopping,
        "latched": state.latched,
        "differences": list(state.differences),
        "model_id": state.model_id,
        "unsettled": list(state.unsettled),
    }

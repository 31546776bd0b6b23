"""Replay of a recording: the session's history and states at any speed."""

import json
from bisect import bisect_right
from contextlib import suppress
from dataclasses import replace
from itertools import pairwise
from types import MappingProxyType
from typing import Any

import numpy as np

from rotemina.app.motion.device import LiveHistory
from rotemina.app.motion.recording.backlog import RecordedEvent
from rotemina.app.motion.recording.recording_reader import RecordedSamples, Recording
from rotemina.app.motion.state import ConnectionState, SessionState
from rotemina.drivers.contract import DeviceSamples, DeviceState
from rotemina.sim.arrays import FloatArray
from rotemina.sim.messages import message

# A jump fills the history with the samples of this period before the target.
_SEEK_HISTORY_S = 60.0

# Keys of the file whose fields have another name in a :class:`SessionState`.
_FIELDS_BY_KEY = {"locked": "lock_reason", "latched": "latch_reason"}


class Replay:
    """Replay of a recording, which panels display like a session.

    Nothing moves and no clock is read; :meth:`advance` takes the elapsed time. A replay provides
    the part of a session's interface that panels read: ``robot``, ``history`` and :meth:`snapshot`.
    It also provides all ``events`` of the recording, oldest first.

    Parameters
    ----------
    recording : Recording
    history : LiveHistory, optional
        History to which samples are added; by default it holds one minute.

    Raises
    ------
    RobotFileError
        If this program cannot read the robot file of the recording.
    """

    def __init__(self, recording: Recording, history: LiveHistory | None = None) -> None:
        self.recording = recording
        self.robot = recording.robot
        self.history = history if history is not None else LiveHistory(recording.axes)
        self.host_time_s = recording.began_s
        self.events = recording.read_events()
        # Number of events up to the current time.
        self._shown_event_count = 0
        self._connection = -1
        self._state = SessionState()

    @property
    def has_ended(self) -> bool:
        """Whether the end of the recording is reached."""
        return self.host_time_s >= self.recording.ended_s

    def snapshot(self) -> SessionState:
        """Return the recorded state, with motion locked."""
        received_s = self._state.sample_host_time_s
        age_s = None if received_s is None else self.host_time_s - received_s
        return replace(
            self._state,
            age_s=age_s,
            lock_reason=message("engine", "this is a replay; the machine does not move"),
        )

    def advance(self, seconds: float) -> None:
        """Advance by ``seconds`` of the recording, which must not be negative."""
        if not seconds >= 0.0:
            raise ValueError(f"a replay cannot advance by {seconds} s; seek instead")
        begin_s = self.host_time_s
        self.host_time_s = min(begin_s + seconds, self.recording.ended_s)
        # The sample at begin_s has been shown already.
        self._show_section(np.nextafter(begin_s, np.inf), self.host_time_s)

    def seek(self, host_time_s: float) -> None:
        """Jump to a host time and fill the history with the minute before it."""
        low, high = self.recording.began_s, self.recording.ended_s
        self.host_time_s = min(max(host_time_s, low), high)
        self._connection, self._state = -1, SessionState()
        self._shown_event_count = bisect_right(
            self.events, self.host_time_s, key=lambda event: event.host_time_s
        )
        for event in reversed(self.events[: self._shown_event_count]):
            if event.kind == "state":
                self._restore_state(event)
                break
        self.history.clear()
        # The history of a fast device holds less than a minute, so more samples are not read.
        self._show_section(
            self.host_time_s - _SEEK_HISTORY_S, self.host_time_s, self.history.capacity
        )

    def _show_section(self, begin_s: float, end_s: float, max_rows: int | None = None) -> None:
        for piece in self.recording.read_pieces(begin_s, end_s, max_rows=max_rows):
            for samples in _split_by_connection(piece):
                self._append_samples(samples)
        while (
            self._shown_event_count < len(self.events)
            and self.events[self._shown_event_count].host_time_s <= end_s
        ):
            if self.events[self._shown_event_count].kind == "state":
                self._restore_state(self.events[self._shown_event_count])
            self._shown_event_count += 1

    def _append_samples(self, samples: RecordedSamples) -> None:
        if samples.connection[0] != self._connection:
            # Device times of different connections cannot be compared.
            self.history.clear()
            self._connection = int(samples.connection[0])
        device_samples = DeviceSamples(
            samples.device_time_s,
            samples.command,
            samples.measured,
            samples.inputs,
            samples.playback_row,
        )
        self.history.append(device_samples, samples.model)
        self._state = replace(
            self._state,
            command=self._select_last_values(samples.command),
            measured=self._select_last_values(samples.measured),
            model=self._select_last_values(samples.model),
            device_time_s=float(samples.device_time_s[-1]),
            sample_host_time_s=float(samples.host_time_s[-1]),
        )

    def _restore_state(self, event: RecordedEvent) -> None:
        # Damaged details must not end the replay.
        with suppress(ValueError, KeyError, TypeError):
            self._state = replace(self._state, **_parse_state(event.details))

    def _select_last_values(self, values: FloatArray) -> MappingProxyType[str, float]:
        return MappingProxyType(dict(zip(self.recording.axes, values[-1].tolist(), strict=True)))


def _parse_state(details: str) -> dict[str, Any]:
    state: dict[str, Any] = json.loads(details)
    state["connection"] = ConnectionState(state["connection"])
    state["activity"] = DeviceState(state["activity"])
    for name in ("unhomed", "differences", "unsettled"):
        if name in state:
            state[name] = tuple(state[name])
    for key, name in _FIELDS_BY_KEY.items():
        if key in state:
            state[name] = state.pop(key)
    return state


def _split_by_connection(piece: RecordedSamples) -> list[RecordedSamples]:
    cuts = [0, *(np.flatnonzero(np.diff(piece.connection)) + 1), len(piece)]
    return [piece.select_rows(slice(int(low), int(high))) for low, high in pairwise(cuts)]

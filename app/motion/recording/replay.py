"""Replay of a recording: the session's history and states, at any pace."""

import json
from bisect import bisect_right
from contextlib import suppress
from dataclasses import replace
from itertools import pairwise
from types import MappingProxyType
from typing import Any

import numpy as np

from rotemina.app.motion.recent_history import LiveHistory
from rotemina.app.motion.recording.backlog import RecordedEvent
from rotemina.app.motion.recording.recording_reader import RecordedSamples, Recording
from rotemina.app.motion.state import Connection, SessionState
from rotemina.drivers.samples import DeviceState, Samples
from rotemina.sim.arrays import FloatArray
from rotemina.sim.messages import message

_SEEN_S = 60.0  # of history that a jump fills


class Replay:
    """Feeds a history and states from a recording, for displays of a session.

    Nothing moves and no clock is read: :meth:`advance` gets the elapsed time. It has the interface
    that panels read of a session: ``robot``, ``history``, :meth:`snapshot`; and all ``events`` of
    the recording, oldest first.

    Parameters
    ----------
    recording : Recording
    history : LiveHistory, optional
        Where samples go; a minute's worth by default.

    Raises
    ------
    RobotFileError
        If the robot file in the recording is none for this program.
    """

    def __init__(self, recording: Recording, history: LiveHistory | None = None) -> None:
        self.recording = recording
        self.robot = recording.robot
        self.history = history if history is not None else LiveHistory(recording.axes)
        self.host_time_s = recording.began_s
        self.events = recording.events()
        self._at = 0  # of the events, those that were shown
        self._connection = -1
        self._state = SessionState()

    @property
    def ended(self) -> bool:
        """Whether everything was shown."""
        return self.host_time_s >= self.recording.ended_s

    def snapshot(self) -> SessionState:
        """Return the state as it was; motion is locked."""
        received_s = self._state.sample_host_time_s
        age_s = None if received_s is None else self.host_time_s - received_s
        return replace(
            self._state,
            age_s=age_s,
            locked=message("engine", "this is a replay; the machine does not move"),
        )

    def advance(self, seconds: float) -> None:
        """Advance by some time of the recording, at least 0."""
        if not seconds >= 0.0:
            raise ValueError(f"a replay goes on, not by {seconds} s; seek instead")
        begin_s = self.host_time_s
        self.host_time_s = min(begin_s + seconds, self.recording.ended_s)
        # Past the sample that was shown last, up to the one that is due.
        self._show(np.nextafter(begin_s, np.inf), self.host_time_s)

    def seek(self, host_time_s: float) -> None:
        """Jump to a time of the recording; the minute before it is in the history then."""
        low, high = self.recording.began_s, self.recording.ended_s
        self.host_time_s = min(max(host_time_s, low), high)
        self._connection, self._state = -1, SessionState()
        self._at = bisect_right(self.events, self.host_time_s, key=lambda one: one.host_time_s)
        for event in reversed(self.events[: self._at]):
            if event.kind == "state":
                self._take_state(event)
                break
        self.history.clear()
        # No more than the history holds: of a fast device that is less than a minute.
        self._show(self.host_time_s - _SEEN_S, self.host_time_s, self.history.capacity)

    def _show(self, begin_s: float, end_s: float, most: int | None = None) -> None:
        for piece in self.recording.pieces(begin_s, end_s, most=most):
            for part in _by_connection(piece):
                self._append(part)
        while self._at < len(self.events) and self.events[self._at].host_time_s <= end_s:
            if self.events[self._at].kind == "state":
                self._take_state(self.events[self._at])
            self._at += 1

    def _append(self, part: RecordedSamples) -> None:
        if part.connection[0] != self._connection:
            self.history.clear()  # a time of its own
            self._connection = int(part.connection[0])
        samples = Samples(
            part.device_time_s, part.command, part.measured, part.inputs, part.playback_row
        )
        self.history.append(samples, part.model)
        self._state = replace(
            self._state,
            command=self._by_axis(part.command),
            measured=self._by_axis(part.measured),
            model=self._by_axis(part.model),
            device_time_s=float(part.device_time_s[-1]),
            sample_host_time_s=float(part.host_time_s[-1]),
        )

    def _take_state(self, recorded: RecordedEvent) -> None:
        with suppress(ValueError, KeyError, TypeError):  # details that the disk has spoilt
            self._state = replace(self._state, **_recorded_state(recorded.details))

    def _by_axis(self, values: FloatArray) -> MappingProxyType[str, float]:
        return MappingProxyType(dict(zip(self.recording.axes, values[-1].tolist(), strict=True)))


def _recorded_state(details: str) -> dict[str, Any]:
    found: dict[str, Any] = json.loads(details)
    found["connection"] = Connection(found["connection"])
    found["activity"] = DeviceState(found["activity"])
    for name in ("unhomed", "differences", "unsettled"):
        if name in found:
            found[name] = tuple(found[name])
    return found


def _by_connection(piece: RecordedSamples) -> list[RecordedSamples]:
    """Split samples at reconnections of the device."""
    cuts = [0, *(np.flatnonzero(np.diff(piece.connection)) + 1), len(piece)]
    return [piece.part(slice(int(low), int(high))) for low, high in pairwise(cuts)]

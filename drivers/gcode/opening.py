"""Handshake with a controller: brings it to rest, empties its queue, and reads its settings."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from rotemina.drivers.contract import Clock, DriverTimeoutError, ProtocolError
from rotemina.drivers.gcode.controller_settings import ControllerSettings, make_homing_path
from rotemina.drivers.gcode.dialogue import HALT, RESET, GrblDialogue, ReceivedMessage
from rotemina.drivers.gcode.error_texts import ControllerFirmware, identify_firmware
from rotemina.drivers.gcode.first_contact import explain_no_answer
from rotemina.drivers.gcode.grbl_reports import (
    VIRTUAL_NOTE,
    ControllerMessage,
    LineAnswer,
    NoteMessage,
    SettingReport,
    StatusReport,
    WelcomeMessage,
)
from rotemina.drivers.gcode.machine_states import interpret_state
from rotemina.sim.messages import format_rounded, marked, message

_PAUSE_STEP_S = 0.01
_QUERY_PERIOD_S = 0.1
# Opening the port resets some controllers. They then take two seconds to start.
_FIRST_ANSWER_TIMEOUT_S = 6.0
# A controller may be homing and therefore not answer, so it is reset after this time.
_RESET_AFTER_S = 3.0
_REST_TIMEOUT_S = 10.0
_RESET_TIMEOUT_S = 3.0
_LINE_TIMEOUT_S = 2.0
#: A line with a longer round trip is refused, because a stop would arrive too late.
MAX_ROUND_TRIP_S = 1.0
_LEAVE_TIMEOUT_S = 2.0


@dataclass(frozen=True, slots=True)
class ControllerIdentity:
    """Settings and status that a controller reports at rest and with an empty queue.

    Attributes
    ----------
    settings : ControllerSettings
    status : StatusReport
        Status with a position.
    """

    settings: ControllerSettings
    status: StatusReport


class ControllerHandshake:
    """Procedures that connect to a controller, and that leave it in a safe state.

    Parameters
    ----------
    dialogue : GrblDialogue
    clock, pause : callable
        Return the host time, s, and wait for a number of seconds.
    port_name : str
        Name of the port, for messages.
    """

    def __init__(
        self, dialogue: GrblDialogue, clock: Clock, pause: Callable[[float], None], port_name: str
    ) -> None:
        self._dialogue = dialogue
        self._clock = clock
        self._pause = pause
        self._port_name = port_name
        self._last_query_s = float("-inf")
        self._identification_texts: list[str] = []

    def connect(self, letters: Sequence[str]) -> ControllerIdentity:
        """Halt the controller, empty its queue, and read its settings and status.

        Motion that was in progress is not resumed.

        Parameters
        ----------
        letters : sequence of str
            Letters of the axes whose settings are needed.

        Raises
        ------
        DriverTimeoutError
            If the controller does not answer.
        ProtocolError
            If its reports are not usable, or its line is too slow.
        """
        self.empty_queue()
        settings = self._read_settings(letters)
        status = self._read_status(_LINE_TIMEOUT_S)
        if status.position is None:
            raise ProtocolError(
                "{where}: the controller's reports have no machine position; send it $10=1",
                where=self._port_name,
            )
        if settings.reports_inches:
            raise ProtocolError(
                "{where}: the controller reports inches; send it $13=0", where=self._port_name
            )
        if self._dialogue.round_trip_s > MAX_ROUND_TRIP_S:
            raise ProtocolError(
                "{where}: an answer takes {took} s, but at most {most} s is allowed, since a "
                "stop takes half of that. Use a faster line",
                where=self._port_name,
                took=format_rounded(self._dialogue.round_trip_s, 2),
                most=MAX_ROUND_TRIP_S,
            )
        return ControllerIdentity(settings, status)

    def empty_queue(self) -> None:
        """Bring the axes to rest by a feed hold, then reset the controller to empty its queue.

        Raises
        ------
        DriverTimeoutError
            If the controller does not answer, or the axes do not come to rest.
        """
        self._read_status(_FIRST_ANSWER_TIMEOUT_S, reset_after_s=_RESET_AFTER_S)
        self._dialogue.send_realtime(HALT)
        self._dialogue.invalidate_reports()
        self._wait_for_rest()
        self._dialogue.send_realtime(RESET)
        self._dialogue.stop_waiting()
        self._wait_for_message(
            lambda report: isinstance(report, WelcomeMessage),
            _RESET_TIMEOUT_S,
            marked("engine", "did not reset"),
        )

    def leave(self, *, homing: bool) -> None:
        """Leave the controller idle, without a feed hold and with an empty queue.

        If it is ``homing``, it is reset first, because it may respond to nothing else.

        Raises
        ------
        DriverTimeoutError
            If the controller does not answer, or the axes do not come to rest.
        """
        if homing:
            self._dialogue.send_realtime(RESET)
        self._dialogue.stop_waiting()
        status = self._read_status(_LEAVE_TIMEOUT_S)
        if interpret_state(status).is_moving or status.state == "Hold":
            self.empty_queue()

    def _read_settings(self, letters: Sequence[str]) -> ControllerSettings:
        options, texts, is_virtual = "", dict[str, str](), False
        for note in self._request("$I"):
            if isinstance(note, NoteMessage):
                self._identification_texts.append(note.text)
                if note.text.startswith("OPT:"):
                    options = note.text.removeprefix("OPT:").split(",")[0]
                # The note must match exactly, so that damaged or longer lines do not count.
                is_virtual = is_virtual or note.text == VIRTUAL_NOTE
        firmware = identify_firmware("\n".join(self._identification_texts))
        lines = ["$$"]
        if firmware is ControllerFirmware.FLUID_NC:
            names = ("mpos_mm", "positive_direction")
            lines += [f"${make_homing_path(letter, name)}" for letter in letters for name in names]
        for line in lines:
            for setting in self._request(line):
                if isinstance(setting, SettingReport):
                    texts[setting.name.lower()] = setting.text
        return ControllerSettings(texts, options, firmware, is_virtual)

    def _wait_for_rest(self) -> None:
        end_s = self._clock() + _REST_TIMEOUT_S
        while interpret_state(self._read_status(_LINE_TIMEOUT_S)).is_moving:
            if self._clock() > end_s:
                raise DriverTimeoutError(
                    "{where}: the axes still move {rest_s} s after a feed hold; use the "
                    "machine's emergency stop switch",
                    where=self._port_name,
                    rest_s=_REST_TIMEOUT_S,
                )

    def _read_status(self, limit_s: float, reset_after_s: float = float("inf")) -> StatusReport:
        """Return a fresh status; reset the controller if there is none after `reset_after_s`."""
        start_s, was_reset = self._clock(), False
        while self._clock() - start_s < limit_s:
            self._dialogue.request_status(_QUERY_PERIOD_S, self._last_query_s)
            self._last_query_s = self._dialogue.query_sent_s or self._last_query_s
            self._pause(_PAUSE_STEP_S)
            for reception in self._receive():
                if isinstance(reception.message, StatusReport) and reception.is_fresh:
                    return reception.message
            if not was_reset and self._clock() - start_s > reset_after_s:
                self._dialogue.send_realtime(RESET)
                was_reset = True
        raise DriverTimeoutError(
            "{where}: no answer to '?' within {limit_s} s: {why}",
            where=self._port_name,
            limit_s=limit_s,
            why=explain_no_answer(*self._dialogue.first_bytes),
        )

    def _wait_for_message(
        self, is_last: Callable[[ControllerMessage], bool], limit_s: float, failure: str
    ) -> list[ControllerMessage]:
        start_s, messages = self._clock(), list[ControllerMessage]()
        while self._clock() - start_s < limit_s:
            self._pause(_PAUSE_STEP_S)
            for reception in self._receive():
                messages.append(reception.message)
                if is_last(reception.message):
                    return messages
        raise DriverTimeoutError(
            "{where}: the controller {what} within {limit_s} s",
            where=self._port_name,
            what=failure,
            limit_s=limit_s,
        )

    def _receive(self) -> list[ReceivedMessage]:
        receptions = list(self._dialogue.receive())
        self._identification_texts += [
            reception.message.text
            for reception in receptions
            if isinstance(reception.message, WelcomeMessage)
        ]
        return receptions

    def _request(self, line: str) -> list[ControllerMessage]:
        self._dialogue.send_line(line)
        messages = self._wait_for_message(
            lambda report: isinstance(report, LineAnswer),
            _LINE_TIMEOUT_S,
            message("engine", "did not answer {line}").fill(line=line),
        )
        self._dialogue.pending_line = None
        return messages

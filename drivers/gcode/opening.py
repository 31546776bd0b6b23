"""Opening of a controller: bring it to rest, empty its queue, and identify it."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from rotemina.drivers.clock import Clock
from rotemina.drivers.errors import DriverTimeoutError, ProtocolError
from rotemina.drivers.gcode.controller_settings import ControllerSettings, homing_path
from rotemina.drivers.gcode.dialogue import HALT, RESET, Dialogue, Reception
from rotemina.drivers.gcode.error_texts import Firmware, identify_firmware
from rotemina.drivers.gcode.first_contact import explain_contact
from rotemina.drivers.gcode.grbl_reports import (
    VIRTUAL,
    Answer,
    Message,
    Note,
    Setting,
    Status,
    Welcome,
)
from rotemina.drivers.gcode.machine_states import interpret_state
from rotemina.sim.messages import marked, message
from rotemina.sim.quantities import rounded

_STEP_S = 0.01
_ASK_S = 0.1
_ANSWER_S = 6.0  # one that is reset by the opening of its port starts for two seconds
_DEAF_S = 3.0  # while it homes it answers nothing: a reset ends that
_REST_S = 10.0
_RESET_S = 3.0
_LINE_S = 2.0
#: A line on which an answer takes longer is refused: a stop would come too late.
MAX_ROUND_TRIP_S = 1.0
_LEAVING_S = 2.0  # for a controller that is being closed


@dataclass(frozen=True, slots=True)
class ControllerInfo:
    """A controller's description of itself, at rest and with an empty queue.

    Attributes
    ----------
    settings : ControllerSettings
    status : Status
        It has a position.
    """

    settings: ControllerSettings
    status: Status


class Opening:
    """Meets the controller at the end of a dialogue, and leaves it.

    Parameters
    ----------
    dialogue : Dialogue
    clock, pause : callable
        The host's time, and how some of it passes.
    where : str
        The port, for messages.
    """

    def __init__(
        self, dialogue: Dialogue, clock: Clock, pause: Callable[[float], None], where: str
    ) -> None:
        self._dialogue = dialogue
        self._clock = clock
        self._pause = pause
        self._where = where
        self._last_s = float("-inf")
        self._greetings: list[str] = []

    def handshake(self, letters: Sequence[str]) -> ControllerInfo:
        """Stop whatever it does, empty it and ask it; what was under way never continues.

        Parameters
        ----------
        letters : sequence of str
            Of the axes whose settings are needed.

        Raises
        ------
        DriverTimeoutError
            If it does not answer.
        ProtocolError
            If its reports cannot be used, or its line is too slow.
        """
        self.empty()
        settings = self._read_settings(letters)
        status = self._status(_LINE_S)
        if status.position is None:
            raise ProtocolError(
                message(
                    "engine", "{where}: its reports have no machine position; send it $10=1"
                ).fill(where=self._where)
            )
        if settings.reports_inches:
            raise ProtocolError(
                message("engine", "{where}: it reports inches; send it $13=0").fill(
                    where=self._where
                )
            )
        if self._dialogue.round_trip_s > MAX_ROUND_TRIP_S:
            raise ProtocolError(
                message(
                    "engine",
                    "{where}: an answer takes {took} s; at most {most} s is accepted, as a stop "
                    "takes half of that. Use a faster line",
                ).fill(
                    where=self._where,
                    took=rounded(self._dialogue.round_trip_s, 2),
                    most=MAX_ROUND_TRIP_S,
                )
            )
        return ControllerInfo(settings, status)

    def empty(self) -> None:
        """Bring it to rest by a feed hold, then reset it: its queue is empty afterwards.

        Raises
        ------
        DriverTimeoutError
            If it does not answer, or does not come to rest.
        """
        self._status(_ANSWER_S, deaf_s=_DEAF_S)
        self._dialogue.send_realtime(HALT)
        self._dialogue.invalidate_reports()
        self._rest()
        self._dialogue.send_realtime(RESET)
        self._dialogue.forget()
        self._until(
            lambda heard: isinstance(heard, Welcome), _RESET_S, marked("engine", "did not reset")
        )

    def leave(self, *, homing: bool) -> None:
        """Leave it as it was found: idle, without a hold, its queue empty.

        While ``homing`` it may hear nothing but a reset.

        Raises
        ------
        DriverTimeoutError
            If it does not answer, or does not come to rest.
        """
        if homing:
            self._dialogue.send_realtime(RESET)
        self._dialogue.forget()
        status = self._status(_LEAVING_S)
        if interpret_state(status).moving or status.state == "Hold":
            self.empty()

    def _read_settings(self, letters: Sequence[str]) -> ControllerSettings:
        options, texts, is_virtual = "", dict[str, str](), False
        for note in self._asked("$I"):
            if isinstance(note, Note):
                self._greetings.append(note.text)
                if note.text.startswith("OPT:"):
                    options = note.text.removeprefix("OPT:").split(",")[0]
                # The whole line: nothing that a damaged or longer line contains counts.
                is_virtual = is_virtual or note.text == VIRTUAL
        firmware = identify_firmware("\n".join(self._greetings))
        lines = ["$$"]
        if firmware is Firmware.FLUID_NC:
            names = ("mpos_mm", "positive_direction")
            lines += [f"${homing_path(letter, name)}" for letter in letters for name in names]
        for line in lines:
            for setting in self._asked(line):
                if isinstance(setting, Setting):
                    texts[setting.name.lower()] = setting.text
        return ControllerSettings(texts, options, firmware, is_virtual)

    def _rest(self) -> None:
        end_s = self._clock() + _REST_S
        while interpret_state(self._status(_LINE_S)).moving:
            if self._clock() > end_s:
                raise DriverTimeoutError(
                    message(
                        "engine",
                        "{where}: the axes still move {rest_s} s after a feed hold; use the "
                        "machine's emergency stop switch",
                    ).fill(where=self._where, rest_s=_REST_S)
                )

    def _status(self, limit_s: float, deaf_s: float = float("inf")) -> Status:
        """Return a fresh status; after `deaf_s` without an answer it is reset."""
        began_s, reset = self._clock(), False
        while self._clock() - began_s < limit_s:
            self._dialogue.ask(_ASK_S, self._last_s)
            self._last_s = self._dialogue.asked_s or self._last_s
            self._pause(_STEP_S)
            for heard in self._heard():
                if isinstance(heard.message, Status) and heard.fresh:
                    return heard.message
            if not reset and self._clock() - began_s > deaf_s:
                self._dialogue.send_realtime(RESET)
                reset = True
        raise DriverTimeoutError(
            message("engine", "{where}: no answer to '?' within {limit_s} s: {why}").fill(
                where=self._where,
                limit_s=limit_s,
                why=explain_contact(*self._dialogue.first_bytes),
            )
        )

    def _until(self, ends: Callable[[Message], bool], limit_s: float, what: str) -> list[Message]:
        began_s, messages = self._clock(), list[Message]()
        while self._clock() - began_s < limit_s:
            self._pause(_STEP_S)
            for heard in self._heard():
                messages.append(heard.message)
                if ends(heard.message):
                    return messages
        raise DriverTimeoutError(
            message("engine", "{where}: it {what} within {limit_s} s").fill(
                where=self._where, what=what, limit_s=limit_s
            )
        )

    def _heard(self) -> list[Reception]:
        heard = list(self._dialogue.received())
        self._greetings += [
            reception.message.text for reception in heard if isinstance(reception.message, Welcome)
        ]
        return heard

    def _asked(self, line: str) -> list[Message]:
        self._dialogue.say(line)
        messages = self._until(
            lambda heard: isinstance(heard, Answer),
            _LINE_S,
            message("engine", "did not answer {line}").fill(line=line),
        )
        self._dialogue.awaited = None
        return messages

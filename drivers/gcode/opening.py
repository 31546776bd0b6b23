"""Opening of a controller: bring it to rest, empty its queue, and identify it."""

from collections.abc import Callable
from dataclasses import dataclass, field

from rotemina.drivers.clock import Clock
from rotemina.drivers.errors import DriverTimeoutError, ProtocolError
from rotemina.drivers.gcode.dialogue import HOLD, RESET, Dialogue
from rotemina.drivers.gcode.grbl_reports import Answer, Message, Note, Setting, Status, Welcome
from rotemina.sim.messages import marked, message

_STEP_S = 0.01
_ASK_S = 0.1
_ANSWER_S = 6.0  # one that is reset by the opening of its port starts for two seconds
_DEAF_S = 3.0  # while it homes it answers nothing: a reset ends that
_REST_S = 10.0
_RESET_S = 3.0
_LINE_S = 2.0


@dataclass(slots=True)
class ControllerInfo:
    """A controller's description of itself, at rest and with an empty queue.

    Attributes
    ----------
    settings : dict
        Its ``$$``.
    options : str
        Letters of what it was built with, ``[OPT:…]``.
    status : Status
    """

    settings: dict[int, float] = field(default_factory=dict)
    options: str = ""
    status: Status = field(default_factory=lambda: Status("Idle", 0, None))


class Opening:
    """Meets the controller at the end of a dialogue.

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

    def handshake(self) -> ControllerInfo:
        """Stop whatever it does, empty it and ask it; what was under way never continues.

        Raises
        ------
        DriverTimeoutError
            If it does not answer.
        ProtocolError
            If its reports cannot be used.
        """
        info = ControllerInfo()
        self.empty()
        for note in self._asked("$I"):
            if isinstance(note, Note) and note.text.startswith("OPT:"):
                info.options = note.text.removeprefix("OPT:").split(",")[0]
        for setting in self._asked("$$"):
            if isinstance(setting, Setting):
                info.settings[setting.number] = setting.value
        info.status = self._status(_LINE_S)
        if info.status.position is None:
            raise ProtocolError(
                message(
                    "engine", "{where}: its reports have no machine position; send it $10=1"
                ).fill(where=self._where)
            )
        if info.settings.get(13, 0.0):
            raise ProtocolError(
                message("engine", "{where}: it reports inches; send it $13=0").fill(
                    where=self._where
                )
            )
        return info

    def empty(self) -> None:
        """Bring it to rest by a feed hold, then reset it: its queue is empty afterwards.

        Raises
        ------
        DriverTimeoutError
            If it does not answer, or does not come to rest.
        """
        self._status(_ANSWER_S, deaf_s=_DEAF_S)
        self._dialogue.send_realtime(HOLD)
        self._dialogue.invalidate_reports()
        self._rest()
        self._dialogue.send_realtime(RESET)
        self._dialogue.forget()
        self._until(
            lambda one: isinstance(one, Welcome), _RESET_S, marked("engine", "did not reset")
        )

    def _rest(self) -> None:
        end_s = self._clock() + _REST_S
        while self._status(_LINE_S).moving:
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
            for told, _, fresh in self._dialogue.received():
                if isinstance(told, Status) and fresh:
                    return told
            if not reset and self._clock() - began_s > deaf_s:
                self._dialogue.send_realtime(RESET)
                reset = True
        raise DriverTimeoutError(
            message(
                "engine",
                "{where}: no answer to '?' within {limit_s} s; check that it is a GRBL "
                "controller, its power and the baud rate",
            ).fill(where=self._where, limit_s=limit_s)
        )

    def _until(self, ends: Callable[[Message], bool], limit_s: float, what: str) -> list[Message]:
        began_s, heard = self._clock(), list[Message]()
        while self._clock() - began_s < limit_s:
            self._pause(_STEP_S)
            for told, _, _ in self._dialogue.received():
                heard.append(told)
                if ends(told):
                    return heard
        raise DriverTimeoutError(
            message("engine", "{where}: it {what} within {limit_s} s").fill(
                where=self._where, what=what, limit_s=limit_s
            )
        )

    def _asked(self, line: str) -> list[Message]:
        self._dialogue.say(line)
        heard = self._until(
            lambda one: isinstance(one, Answer),
            _LINE_S,
            message("engine", "did not answer {line}").fill(line=line),
        )
        self._dialogue.awaited = None
        return heard

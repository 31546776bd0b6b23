"""Reports of a GRBL controller: each line as a message. Source: GRBL 1.1, interface.md."""

import re
from collections.abc import Mapping
from dataclasses import dataclass

from rotemina.sim.messages import marked, message

#: What alarms mean that a stage can have.
ALARMS = {
    1: marked("engine", "hard limit: a limit switch was reached"),
    2: marked("engine", "soft limit: a target lies beyond the travel"),
    3: marked("engine", "it was reset during motion"),
    6: marked("engine", "homing was ended by a reset"),
    7: marked("engine", "the door was opened during homing"),
    8: marked("engine", "homing: pulling off did not clear the limit switch"),
    9: "homing: the limit switch was not found",
}
#: Of alarms after which the controller still knows where it is.
POSITION_KEPT = frozenset({2, 4, 5})
#: Of alarms after which the controller answers nothing but a reset.
CRITICAL = frozenset({1, 2})
ERRORS = {
    5: marked("engine", "homing is not enabled ($22)"),
    8: marked("engine", "it is not idle"),
    9: marked("engine", "it is locked by an alarm"),
    11: marked("engine", "the line is too long"),
    15: marked("engine", "the target lies beyond the travel"),
    16: marked("engine", "not a jog command"),
    20: marked("engine", "unsupported G-code"),
}
_STATUS = re.compile(r"<(\w+)(?::(\d+))?\|(.*)>")
_NUMBERED = re.compile(r"(error|ALARM):(\d+)")
_SETTING = re.compile(r"\$(\d+)=(-?[\d.]+).*")


@dataclass(frozen=True, slots=True)
class Status:
    """``<State:substate|MPos:x,y,z|…>``; ``position`` in mm or degrees, None if it is no MPos."""

    state: str
    substate: int
    position: tuple[float, ...] | None

    @property
    def moving(self) -> bool:
        """Whether axes move, or still brake."""
        return self.state in ("Run", "Jog", "Home") or (self.state == "Hold" and self.substate == 1)


@dataclass(frozen=True, slots=True)
class Answer:
    """``ok``, or ``error:N``."""

    error: int | None = None

    @property
    def text(self) -> str:
        """The error in words."""
        return _in_words("error", self.error or 0, ERRORS)


@dataclass(frozen=True, slots=True)
class Alarm:
    """``ALARM:N``: the controller has locked itself."""

    number: int

    @property
    def text(self) -> str:
        """The alarm in words."""
        return _in_words("ALARM", self.number, ALARMS)


@dataclass(frozen=True, slots=True)
class Welcome:
    """The greeting after each reset."""

    text: str


@dataclass(frozen=True, slots=True)
class Setting:
    """``$N=value``."""

    number: int
    value: float


@dataclass(frozen=True, slots=True)
class Note:
    """``[…]``: a message, or what the controller was built with."""

    text: str


Message = Status | Answer | Alarm | Welcome | Setting | Note


def parse_report(line: str) -> Message | None:
    """Return the message of a line; None if it is not a controller's."""
    if line == "ok":
        return Answer()
    if line.startswith("Grbl"):
        return Welcome(line)
    if line.startswith("[") and line.endswith("]"):
        return Note(line[1:-1])
    if found := _NUMBERED.fullmatch(line):
        number = int(found[2])
        return Answer(number) if found[1] == "error" else Alarm(number)
    if found := _STATUS.fullmatch(line):
        return Status(found[1], int(found[2] or 0), _position(found[3]))
    if found := _SETTING.fullmatch(line):
        return Setting(int(found[1]), float(found[2]))
    return None


def _position(fields: str) -> tuple[float, ...] | None:
    for field in fields.split("|"):
        name, _, numbers = field.partition(":")
        if name == "MPos":
            try:
                return tuple(map(float, numbers.split(",")))
            except ValueError:
                return None
    return None


def _in_words(what: str, number: int, meanings: Mapping[int, str]) -> str:
    return message("engine", "{what}:{number}, {meaning}").fill(
        what=what,
        number=number,
        meaning=meanings.get(number, marked("engine", "see the manual")),
    )

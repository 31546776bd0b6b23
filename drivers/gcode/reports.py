"""What a GRBL controller says: each line as a message. Source: GRBL 1.1, interface.md."""

import re
from dataclasses import dataclass

#: What alarms mean that a stage can have.
ALARMS = {
    1: "hard limit: a limit switch was hit",
    2: "soft limit: a target lies beyond the travel",
    3: "it was reset in motion",
    6: "homing was ended by a reset",
    7: "the door was opened while homing",
    8: "homing: pulling off did not clear the limit switch",
    9: "homing: the limit switch was not found",
}
#: Of alarms after which the controller still knows where it is.
POSITION_KEPT = frozenset({2, 4, 5})
#: Of alarms after which the controller answers nothing but a reset.
CRITICAL = frozenset({1, 2})
ERRORS = {
    5: "homing is not enabled ($22)",
    8: "it is not idle",
    9: "it is locked by an alarm",
    11: "the line is too long",
    15: "the target lies beyond the travel",
    16: "no jog command",
    20: "unsupported G-code",
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
        return f"error:{self.error}, {ERRORS.get(self.error or 0, 'see the manual')}"


@dataclass(frozen=True, slots=True)
class Alarm:
    """``ALARM:N``: the controller has locked itself."""

    number: int

    @property
    def text(self) -> str:
        """The alarm in words."""
        return f"ALARM:{self.number}, {ALARMS.get(self.number, 'see the manual')}"


@dataclass(frozen=True, slots=True)
class Welcome:
    """What is said after each reset."""

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
    """Return what a line says; None where it is none that a controller says."""
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

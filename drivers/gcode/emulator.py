"""An emulated GRBL controller with a stage, byte for byte; its time is advanced explicitly.

It behaves as GRBL 1.1 does, as far as a host can tell: a queue of blocks, feed holds and resets,
alarms and locks, a safety door, sleep, no reports while it homes. Time is given by the caller, s.
Source: GRBL 1.1, ``protocol.c``, ``motion_control.c``, ``limits.c``.
"""

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass
from math import pi

from rotemina.drivers.gcode.blocks import Blocks
from rotemina.drivers.gcode.coordinates import check_stage
from rotemina.drivers.gcode.grbl_reports import VIRTUAL
from rotemina.drivers.gcode.parser import LineError, Target, jog_of, motion_of
from rotemina.sim.robot.model import Robot

TICK_S = 1e-3
WELCOME = "Grbl 1.1h ['$' for help]"
LETTERS = "XYZABC"
_RX_BYTES = 128
_MOST_BLOCKS = 15
_LOCKED = "[MSG:'$H'|'$X' to unlock]"
_DIRECTION, _SEEK, _PULL_OFF, _PULL_OFF_RATE = 23, 25, 27, 24
_UNITS = {"m": 1000.0, "rad": 180.0 / pi}


@dataclass(slots=True)
class _Search:
    """A homing cycle: which axes are still to be done, and how far the present one is."""

    axes: deque[int]
    pulling_off: bool = False
    gone: float = 0.0


@dataclass(slots=True)
class _Modes:
    """What earlier lines have set: G90 or G91, G20 or G21, the motion and its feed."""

    absolute: bool = True
    rapid: bool = True
    scale: float = 1.0
    feed: float = 0.0


class EmulatedStage:
    """A controller and the axes of a robot.

    Parameters
    ----------
    robot : Robot
        Its ranges, speeds and accelerations become the controller's settings.
    start_fraction : float
        Where in its range each axis stands when the power comes on; the controller does not know.
    single_homing : bool
        Whether it was built to home axes one by one.
    missing_switch : str
        Letters of axes whose switch is never found.

    Raises
    ------
    InputError
        If the robot has an axis that such a controller cannot move.
    """

    def __init__(
        self,
        robot: Robot,
        *,
        start_fraction: float = 0.5,
        single_homing: bool = True,
        missing_switch: str = "",
    ) -> None:
        check_stage(robot, LETTERS)
        axes = list(robot.axes.items())
        scales = [_UNITS[robot.unit(name) or "m"] for name, _ in axes]
        self.letters = LETTERS[: len(axes)]
        self._missing = {self.letters.index(letter) for letter in missing_switch}
        self._options = "VH" if single_homing else "V"
        self.settings = {10: 1.0, 13: 0.0, 20: 1.0, 21: 1.0, 22: 1.0}
        # Every switch is at the low end.
        self.settings[_DIRECTION] = float(2 ** len(axes) - 1)
        self.settings |= {_PULL_OFF_RATE: 60.0, _SEEK: 600.0, _PULL_OFF: 1.0}
        for number, ((_, axis), scale) in enumerate(zip(axes, scales, strict=True)):
            speed = axis.max_speed or axis.span
            self.settings |= {
                100 + number: 10_000.0,
                110 + number: round(60.0 * speed * scale, 3),
                120 + number: round((axis.max_acceleration or 10.0 * speed) * scale, 3),
                130 + number: round(axis.span * scale, 3),
            }
        travel = self._each(130)
        #: Where each axis truly is, mm or degrees above the low end of its travel.
        self.true = [start_fraction * way for way in travel]
        self.events: list[str] = []
        self._state = "Alarm"
        self._cancel = False
        self._now_s = 0.0
        self._out = bytearray()
        self._reported = False  # a question that waits for the end of a homing
        self._power_on()

    # --- what surrounds it ---------------------------------------------------------------------

    @property
    def state(self) -> str:
        """Its state, as in a report without the part after the colon."""
        return self._state

    @property
    def count(self) -> list[float]:
        """Where it takes its axes to be, machine coordinates, mm or degrees."""
        return list(self._blocks.position)

    def receive(self, data: bytes, at_s: float) -> None:
        """Let a host have written these bytes at this time, s."""
        self._live(at_s)
        for byte in data:
            self._hear(byte)

    def advance(self, to_s: float) -> bytes:
        """Advance until this time; return what has been said by then."""
        self._live(to_s)
        said = bytes(self._out)
        self._out.clear()
        return said

    def hit_limit(self) -> None:
        """Let a limit switch close: a hard limit."""
        if self._state not in ("Alarm", "Home"):
            self._alarm(1, critical=True)

    def open_door(self) -> None:
        """Open the safety door: the axes brake, and nothing goes on before it is closed."""
        self._door_is_open = True
        if self._state in ("Alarm", "Home", "Sleep"):
            return
        self._cancel = self._cancel or self._state == "Jog"
        self._state, self._hold = "Door", True

    def close_door(self) -> None:
        """Close the safety door; what was held waits to be resumed."""
        self._door_is_open = False

    def cut_power(self) -> None:
        """Interrupt the supply: the controller loses its whole state."""
        self._power_on()

    # --- bytes and lines -----------------------------------------------------------------------

    def _power_on(self) -> None:
        self._blocks = Blocks([0.0] * len(self.letters), self._each(110), self._each(120))
        self._modes = _Modes()
        self._state = "Alarm"  # homing is enabled: it wants that first
        self._critical = False
        self._search: _Search | None = None
        self._door_is_open = self._hold = self._cancel = False
        self._start()

    def _start(self) -> None:
        """Begin again, as after each reset: what waited is gone."""
        self._rx = bytearray()
        self._modes = _Modes()
        self._blocks.clear()
        self._hold = self._cancel = False
        self._reported = False
        self._say("")
        self._say(WELCOME)
        if self._state == "Alarm":
            self._say(_LOCKED)
        else:
            self._state = "Door" if self._door_is_open else "Idle"

    def _say(self, line: str) -> None:
        self._out += line.encode("ascii") + b"\r\n"

    def _hear(self, byte: int) -> None:
        if byte == 0x18:
            self._reset()
        elif byte == ord("?"):
            self._reported = True
        elif self._critical:
            return
        elif byte == ord("!"):
            self._feed_hold()
        elif byte == ord("~"):
            self._resume()
        elif byte == 0x84:
            self.open_door()
        elif byte == 0x85:
            if self._state == "Jog":
                self._cancel = self._hold = True
        elif byte < 0x80 and len(self._rx) < _RX_BYTES:
            self._rx.append(byte)
        self._report_if_asked()

    def _report_if_asked(self) -> None:
        if not self._reported or self._critical or self._search is not None:
            return
        self._reported = False
        position = ",".join(f"{at:.3f}" for at in self._blocks.counted(self._each(100)))
        speed = 60.0 * self._blocks.speed
        self._say(f"<{self._state}{self._substate()}|MPos:{position}|FS:{speed:.0f},0>")

    def _substate(self) -> str:
        if self._state == "Hold":
            return f":{int(self._blocks.moving)}"
        if self._state == "Door":
            return ":2" if self._blocks.moving else f":{int(self._door_is_open)}"
        return ""

    def _feed_hold(self) -> None:
        if self._state == "Jog":
            self._hold = self._cancel = True  # a hold ends a jog for good
        elif self._state in ("Idle", "Run"):
            self._state, self._hold = "Hold", True

    def _resume(self) -> None:
        held = self._state == "Hold" or (self._state == "Door" and not self._door_is_open)
        if held and not self._blocks.moving:
            self._state, self._hold = ("Run" if self._blocks.waiting else "Idle"), False

    def _reset(self) -> None:
        if self._search is not None:
            self._search = None
            self._alarm(6)
        elif self._blocks.moving:
            self._alarm(3)  # the motors stall: steps are lost
        self._critical = False
        if self._state == "Sleep":
            self._state = "Alarm"
        self._start()

    def _alarm(self, number: int, *, critical: bool = False) -> None:
        self._blocks.halt()
        self._search = None
        self._state, self._critical = "Alarm", critical
        self._say(f"ALARM:{number}")
        if critical:
            self._say("[MSG:Reset to continue]")
        self.events.append(f"ALARM:{number}")

    # --- time ----------------------------------------------------------------------------------

    def _live(self, to_s: float) -> None:
        while self._now_s + TICK_S <= to_s + 1e-9:
            self._now_s += TICK_S
            self._tick()

    def _tick(self) -> None:
        if self._search is not None:
            self._seek(self._search)
        elif self._blocks.waiting or self._blocks.moving:
            before = list(self._blocks.position)
            self._blocks.step(TICK_S, hold=self._hold)
            after = self._blocks.position
            self.true = [
                at + new - old for at, old, new in zip(self.true, before, after, strict=True)
            ]
        self._settle()
        # A hold keeps the main loop from lines; so does an alarm that wants a reset.
        if not self._critical and self._state not in ("Hold", "Door", "Sleep") and not self._cancel:
            self._obey_a_line()
        self._report_if_asked()

    def _settle(self) -> None:
        if self._cancel and not self._blocks.moving:
            self._blocks.clear()
            self._cancel, self._hold = False, self._state == "Door"
        if self._state in ("Run", "Jog") and not self._blocks.waiting and not self._cancel:
            self._state = "Idle"

    def _obey_a_line(self) -> None:
        end = self._rx.find(b"\n")
        if end < 0 or self._search is not None or self._blocks.count >= _MOST_BLOCKS:
            return
        line = bytes(self._rx[:end]).decode("ascii", "replace").strip().upper()
        del self._rx[: end + 1]
        try:
            if self._obey(line):
                self._say("ok")
        except LineError as error:
            self._say(f"error:{error.number}")

    def _obey(self, line: str) -> bool:
        """Do what a line says; return whether it is done, rather than answered later."""
        if line.startswith("$J="):
            self._jog(line[3:])
        elif line == "$SLP":
            self._state = "Sleep"
        elif line.startswith("$H"):
            return self._home(line[2:])
        elif line == "$X":
            if self._state == "Alarm":
                self._state = "Idle"
                self._say("[MSG:Caution: Unlocked]")
        elif line.startswith("$"):
            self._tell_or_set(line[1:])
        elif line:
            self._move(line)
        return True

    def _tell_or_set(self, text: str) -> None:
        if text == "I":
            self._say("[VER:1.1h.20190830:]")
            self._say(f"[OPT:{self._options},{_MOST_BLOCKS},{_RX_BYTES}]")
            self._say(f"[{VIRTUAL}]")
        elif text == "$":
            for number, value in sorted(self.settings.items()):
                self._say(f"${number}={value:.3f}" if number >= 100 else f"${number}={value:g}")
        else:
            name, _, told = text.partition("=")
            try:
                self.settings[int(name)] = float(told)
            except ValueError as error:
                raise LineError(3) from error
            self._blocks.limits(self._each(110), self._each(120))

    def _jog(self, text: str) -> None:
        if self._state == "Alarm":
            raise LineError(9)
        if self._state not in ("Idle", "Jog"):
            raise LineError(8)
        target = jog_of(text, self.letters, self._blocks.end)
        if not self._inside(target):
            raise LineError(15)
        self._blocks.add(target.position, target.feed / 60.0)
        if self._blocks.waiting:
            self._state = "Jog"

    def _move(self, line: str) -> None:
        if self._state == "Alarm":
            raise LineError(9)
        if self._state == "Jog":
            raise LineError(9)
        target = motion_of(line, self.letters, self._blocks.end, self._modes)
        if target is None:
            return
        if not self._inside(target):
            self._alarm(2, critical=True)
            return
        self._blocks.add(target.position, target.feed / 60.0)
        if self._blocks.waiting:
            self._state = "Run"

    def _inside(self, target: Target) -> bool:
        return not self.settings[20] or all(
            -way - 1e-6 <= at <= 1e-6
            for at, way in zip(target.position, self._each(130), strict=True)
        )

    # --- homing --------------------------------------------------------------------------------

    def _home(self, letters: str) -> bool:
        if not self.settings[22]:
            raise LineError(5)
        if self._state not in ("Idle", "Alarm"):
            raise LineError(8)
        if letters and ("H" not in self._options or set(letters) - set(self.letters)):
            raise LineError(3)
        asked = [self.letters.index(letter) for letter in letters or self.letters]
        self._search, self._state = _Search(deque(asked)), "Home"
        return False

    def _seek(self, search: _Search) -> None:
        """Continue towards the low switch of the first axis, or away from it."""
        axis = search.axes[0]
        rate = self.settings[_PULL_OFF_RATE if search.pulling_off else _SEEK]
        way = rate / 60.0 * TICK_S
        search.gone += way
        if search.pulling_off:
            self.true[axis] += way
            if search.gone >= self.settings[_PULL_OFF]:
                self._found(search, axis)
        else:
            self.true[axis] -= way
            if axis in self._missing:
                if search.gone > 1.5 * self._each(130)[axis]:
                    self._alarm(9)
                    self._start()
            elif self.true[axis] <= 0.0:
                search.pulling_off, search.gone = True, 0.0

    def _found(self, search: _Search, axis: int) -> None:
        self.true[axis] = self.settings[_PULL_OFF]
        self._blocks.set(axis, self.settings[_PULL_OFF] - self._each(130)[axis])
        search.axes.popleft()
        search.pulling_off, search.gone = False, 0.0
        if not search.axes:
            self._search, self._state = None, "Idle"
            self._say("ok")

    def _each(self, first: int) -> Sequence[float]:
        return [self.settings[first + number] for number in range(len(self.letters))]

"""Emulated GRBL controller with a stage.

To a host it behaves like GRBL 1.1, byte for byte. It emulates the queue of blocks, feed holds and
resets, alarms and locks, a safety door, and sleep, and sends no reports during homing. The caller
advances its time. Source:
GRBL 1.1, ``protocol.c``, ``motion_control.c``, ``limits.c``.
"""

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass
from math import pi

from rotemina.drivers.gcode.blocks import MotionQueue
from rotemina.drivers.gcode.grbl_reports import VIRTUAL_NOTE
from rotemina.drivers.gcode.parser import LineError, LineTarget, parse_jog, parse_motion
from rotemina.drivers.gcode.settings_check import check_stage
from rotemina.sim.robot import Robot

TICK_S = 1e-3
WELCOME = "Grbl 1.1h ['$' for help]"
LETTERS = "XYZABC"
_RX_BYTES = 128
_MAX_BLOCKS = 15
_LOCKED_NOTE = "[MSG:'$H'|'$X' to unlock]"
_DIRECTION_SETTING, _SEEK_RATE_SETTING, _PULL_OFF_SETTING, _PULL_OFF_RATE_SETTING = 23, 25, 27, 24
_SCALE_BY_UNIT = {"m": 1000.0, "rad": 180.0 / pi}


@dataclass(slots=True)
class _HomingSearch:
    """A homing cycle: the remaining axes, and the progress of the first of them.

    ``distance`` is the distance that the axis has moved in the current phase, mm or degrees.
    """

    axes: deque[int]
    pulling_off: bool = False
    distance: float = 0.0


@dataclass(slots=True)
class _ModalState:
    absolute: bool = True
    rapid: bool = True
    scale: float = 1.0
    feed: float = 0.0


class EmulatedStage:
    """An emulated controller with the axes of a robot.

    Parameters
    ----------
    robot : Robot
        The controller's settings follow from its ranges, speeds and accelerations.
    start_fraction : float
        Position of each axis at power-on, as a fraction of its range. The controller does not know
        this position.
    single_homing : bool
        Whether the controller was built to home single axes.
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
        scales = [_SCALE_BY_UNIT[robot.unit(name) or "m"] for name, _ in axes]
        self.letters = LETTERS[: len(axes)]
        self._missing_switches = {self.letters.index(letter) for letter in missing_switch}
        self._options = "VH" if single_homing else "V"
        self.settings = {10: 1.0, 13: 0.0, 20: 1.0, 21: 1.0, 22: 1.0}
        # All switches are at the low ends.
        self.settings[_DIRECTION_SETTING] = float(2 ** len(axes) - 1)
        self.settings |= {
            _PULL_OFF_RATE_SETTING: 60.0,
            _SEEK_RATE_SETTING: 600.0,
            _PULL_OFF_SETTING: 1.0,
        }
        for number, ((_, axis), scale) in enumerate(zip(axes, scales, strict=True)):
            speed = axis.max_speed or axis.span
            self.settings |= {
                100 + number: 10_000.0,
                110 + number: round(60.0 * speed * scale, 3),
                120 + number: round((axis.max_acceleration or 10.0 * speed) * scale, 3),
                130 + number: round(axis.span * scale, 3),
            }
        travel = self._read_axis_settings(130)
        #: True position of each axis, mm or degrees above the low end of its travel.
        self.true_positions = [start_fraction * length for length in travel]
        self.events: list[str] = []
        self._state = "Alarm"
        self._cancel_jog = False
        self._now_s = 0.0
        self._out = bytearray()
        # A query during homing is answered afterwards.
        self._report_requested = False
        self._power_on()

    @property
    def state(self) -> str:
        """The state word that reports contain, without the substate after the colon."""
        return self._state

    @property
    def count(self) -> list[float]:
        """The positions that the controller counts, in machine coordinates, mm or degrees."""
        return list(self._blocks.position)

    def receive(self, data: bytes, at_s: float) -> None:
        """Process bytes that the host wrote at the time ``at_s``."""
        self._advance_to(at_s)
        for byte in data:
            self._receive_byte(byte)

    def advance(self, to_s: float) -> bytes:
        """Advance to the time ``to_s``; return the bytes that the controller has sent."""
        self._advance_to(to_s)
        output = bytes(self._out)
        self._out.clear()
        return output

    def hit_limit(self) -> None:
        """Close a limit switch, which triggers the hard-limit alarm."""
        if self._state not in ("Alarm", "Home"):
            self._raise_alarm(1, critical=True)

    def open_door(self) -> None:
        """Open the safety door: the axes brake, and no motion continues until it is closed."""
        self._door_is_open = True
        if self._state in ("Alarm", "Home", "Sleep"):
            return
        self._cancel_jog = self._cancel_jog or self._state == "Jog"
        self._state, self._hold = "Door", True

    def close_door(self) -> None:
        """Close the safety door. An interrupted motion waits for the resume command."""
        self._door_is_open = False

    def cut_power(self) -> None:
        """Interrupt the power supply: the controller loses its whole state."""
        self._power_on()

    def _power_on(self) -> None:
        self._blocks = MotionQueue(
            [0.0] * len(self.letters), self._read_axis_settings(110), self._read_axis_settings(120)
        )
        self._modes = _ModalState()
        # As homing is enabled, GRBL starts locked until it is homed.
        self._state = "Alarm"
        self._needs_reset = False
        self._search: _HomingSearch | None = None
        self._door_is_open = self._hold = self._cancel_jog = False
        self._restart()

    def _restart(self) -> None:
        self._rx = bytearray()
        self._modes = _ModalState()
        self._blocks.clear()
        self._hold = self._cancel_jog = False
        self._report_requested = False
        self._send("")
        self._send(WELCOME)
        if self._state == "Alarm":
            self._send(_LOCKED_NOTE)
        else:
            self._state = "Door" if self._door_is_open else "Idle"

    def _send(self, line: str) -> None:
        self._out += line.encode("ascii") + b"\r\n"

    def _receive_byte(self, byte: int) -> None:
        if byte == 0x18:
            self._reset()
        elif byte == ord("?"):
            self._report_requested = True
        elif self._needs_reset:
            return
        elif byte == ord("!"):
            self._feed_hold()
        elif byte == ord("~"):
            self._resume()
        elif byte == 0x84:
            self.open_door()
        elif byte == 0x85:
            if self._state == "Jog":
                self._cancel_jog = self._hold = True
        elif byte < 0x80 and len(self._rx) < _RX_BYTES:
            self._rx.append(byte)
        self._report_if_requested()

    def _report_if_requested(self) -> None:
        if not self._report_requested or self._needs_reset or self._search is not None:
            return
        self._report_requested = False
        position = ",".join(
            f"{coordinate:.3f}"
            for coordinate in self._blocks.round_to_steps(self._read_axis_settings(100))
        )
        speed = 60.0 * self._blocks.speed
        self._send(f"<{self._state}{self._substate()}|MPos:{position}|FS:{speed:.0f},0>")

    def _substate(self) -> str:
        if self._state == "Hold":
            return f":{int(self._blocks.is_moving)}"
        if self._state == "Door":
            return ":2" if self._blocks.is_moving else f":{int(self._door_is_open)}"
        return ""

    def _feed_hold(self) -> None:
        if self._state == "Jog":
            # GRBL cancels a jog at a feed hold instead of pausing it.
            self._hold = self._cancel_jog = True
        elif self._state in ("Idle", "Run"):
            self._state, self._hold = "Hold", True

    def _resume(self) -> None:
        can_resume = self._state == "Hold" or (self._state == "Door" and not self._door_is_open)
        if can_resume and not self._blocks.is_moving:
            self._state, self._hold = ("Run" if self._blocks.has_blocks else "Idle"), False

    def _reset(self) -> None:
        if self._search is not None:
            self._search = None
            self._raise_alarm(6)
        elif self._blocks.is_moving:
            # The motors stop abruptly and lose steps.
            self._raise_alarm(3)
        self._needs_reset = False
        if self._state == "Sleep":
            self._state = "Alarm"
        self._restart()

    def _raise_alarm(self, number: int, *, critical: bool = False) -> None:
        self._blocks.halt()
        self._search = None
        self._state, self._needs_reset = "Alarm", critical
        self._send(f"ALARM:{number}")
        if critical:
            self._send("[MSG:Reset to continue]")
        self.events.append(f"ALARM:{number}")

    def _advance_to(self, to_s: float) -> None:
        while self._now_s + TICK_S <= to_s + 1e-9:
            self._now_s += TICK_S
            self._tick()

    def _tick(self) -> None:
        if self._search is not None:
            self._step_search(self._search)
        elif self._blocks.has_blocks or self._blocks.is_moving:
            before = list(self._blocks.position)
            self._blocks.step(TICK_S, hold=self._hold)
            after = self._blocks.position
            self.true_positions = [
                true_position + new - old
                for true_position, old, new in zip(self.true_positions, before, after, strict=True)
            ]
        self._settle()
        # No line is executed during a hold, or after an alarm that only a reset can clear.
        if (
            not self._needs_reset
            and self._state not in ("Hold", "Door", "Sleep")
            and not self._cancel_jog
        ):
            self._execute_next_line()
        self._report_if_requested()

    def _settle(self) -> None:
        if self._cancel_jog and not self._blocks.is_moving:
            self._blocks.clear()
            self._cancel_jog, self._hold = False, self._state == "Door"
        if self._state in ("Run", "Jog") and not self._blocks.has_blocks and not self._cancel_jog:
            self._state = "Idle"

    def _execute_next_line(self) -> None:
        end = self._rx.find(b"\n")
        if end < 0 or self._search is not None or self._blocks.block_count >= _MAX_BLOCKS:
            return
        line = bytes(self._rx[:end]).decode("ascii", "replace").strip().upper()
        del self._rx[: end + 1]
        try:
            if self._execute_line(line):
                self._send("ok")
        except LineError as error:
            self._send(f"error:{error.number}")

    def _execute_line(self, line: str) -> bool:
        """Execute a line; return False if its answer follows later."""
        if line.startswith("$J="):
            self._jog(line[3:])
        elif line == "$SLP":
            self._state = "Sleep"
        elif line.startswith("$H"):
            return self._home(line[2:])
        elif line == "$X":
            if self._state == "Alarm":
                self._state = "Idle"
                self._send("[MSG:Caution: Unlocked]")
        elif line.startswith("$"):
            self._report_or_set(line[1:])
        elif line:
            self._move(line)
        return True

    def _report_or_set(self, text: str) -> None:
        if text == "I":
            self._send("[VER:1.1h.20190830:]")
            self._send(f"[OPT:{self._options},{_MAX_BLOCKS},{_RX_BYTES}]")
            self._send(f"[{VIRTUAL_NOTE}]")
        elif text == "$":
            for number, value in sorted(self.settings.items()):
                self._send(f"${number}={value:.3f}" if number >= 100 else f"${number}={value:g}")
        else:
            name, _, number_text = text.partition("=")
            try:
                self.settings[int(name)] = float(number_text)
            except ValueError as error:
                raise LineError(3) from error
            self._blocks.set_limits(self._read_axis_settings(110), self._read_axis_settings(120))

    def _jog(self, text: str) -> None:
        if self._state == "Alarm":
            raise LineError(9)
        if self._state not in ("Idle", "Jog"):
            raise LineError(8)
        target = parse_jog(text, self.letters, self._blocks.end)
        if not self._is_in_travel(target):
            raise LineError(15)
        self._blocks.add(target.position, target.feed / 60.0)
        if self._blocks.has_blocks:
            self._state = "Jog"

    def _move(self, line: str) -> None:
        if self._state == "Alarm":
            raise LineError(9)
        if self._state == "Jog":
            raise LineError(9)
        target = parse_motion(line, self.letters, self._blocks.end, self._modes)
        if target is None:
            return
        if not self._is_in_travel(target):
            self._raise_alarm(2, critical=True)
            return
        self._blocks.add(target.position, target.feed / 60.0)
        if self._blocks.has_blocks:
            self._state = "Run"

    def _is_in_travel(self, target: LineTarget) -> bool:
        return not self.settings[20] or all(
            -travel - 1e-6 <= coordinate <= 1e-6
            for coordinate, travel in zip(
                target.position, self._read_axis_settings(130), strict=True
            )
        )

    def _home(self, letters: str) -> bool:
        if not self.settings[22]:
            raise LineError(5)
        if self._state not in ("Idle", "Alarm"):
            raise LineError(8)
        if letters and ("H" not in self._options or set(letters) - set(self.letters)):
            raise LineError(3)
        axes = [self.letters.index(letter) for letter in letters or self.letters]
        self._search, self._state = _HomingSearch(deque(axes)), "Home"
        return False

    def _step_search(self, search: _HomingSearch) -> None:
        axis = search.axes[0]
        rate = self.settings[_PULL_OFF_RATE_SETTING if search.pulling_off else _SEEK_RATE_SETTING]
        step = rate / 60.0 * TICK_S
        search.distance += step
        if search.pulling_off:
            self.true_positions[axis] += step
            if search.distance >= self.settings[_PULL_OFF_SETTING]:
                self._finish_axis(search, axis)
        else:
            self.true_positions[axis] -= step
            if axis in self._missing_switches:
                if search.distance > 1.5 * self._read_axis_settings(130)[axis]:
                    self._raise_alarm(9)
                    self._restart()
            elif self.true_positions[axis] <= 0.0:
                search.pulling_off, search.distance = True, 0.0

    def _finish_axis(self, search: _HomingSearch, axis: int) -> None:
        self.true_positions[axis] = self.settings[_PULL_OFF_SETTING]
        self._blocks.set_position(
            axis, self.settings[_PULL_OFF_SETTING] - self._read_axis_settings(130)[axis]
        )
        search.axes.popleft()
        search.pulling_off, search.distance = False, 0.0
        if not search.axes:
            self._search, self._state = None, "Idle"
            self._send("ok")

    def _read_axis_settings(self, first: int) -> Sequence[float]:
        return [self.settings[first + number] for number in range(len(self.letters))]

"""*Move it now*: detects which control the operator moved."""

from collections import deque
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum
from itertools import pairwise
from math import isfinite

from rotemina.app.motion.teleoperation.profile_check import PluggedDevice
from rotemina.drivers.inputs.device import InputReading
from rotemina.sim.messages import message

WINDOW_S = 1.0  # what drifts is slower than that
LEAST_WAY = 0.5  # raw, of 2: half way from the centre to an end
LEAST_STAY_S = 0.03  # away from where it was: a single wrong reading is shorter
CLEARLY = 2.0  # times as far as every other axis
MOST_PATH = 4.0  # times its way, to and fro: what goes further jitters


class Kind(StrEnum):
    """What a control is."""

    AXIS = "axis"
    BUTTON = "button"


@dataclass(frozen=True, slots=True)
class Detected:
    """The control that was moved.

    Attributes
    ----------
    device : str
        Key of the device.
    control : str
    kind : Kind
    direction : int
        1 or −1: where an axis was moved to, in raw numbers; 1 for a button.
    """

    device: str
    control: str
    kind: Kind
    direction: int


@dataclass(frozen=True, slots=True)
class Findings:
    """What was found so far.

    Attributes
    ----------
    detected : Detected or None
        The one control that was clearly moved.
    message : str
        For the operator.
    """

    detected: Detected | None
    message: str


class Detection:
    """Looks for the control that is moved, among those of one or several devices.

    Parameters
    ----------
    devices : sequence of PluggedDevice
    wanted : Kind, optional
        Only axes, or only buttons: the trigger of many a gamepad is both at once.
    """

    def __init__(self, devices: Sequence[PluggedDevice], wanted: Kind | None = None) -> None:
        self._devices = {device.identity.key: device for device in devices}
        self._wanted = wanted
        self._paths: dict[tuple[str, str], _Path] = {}
        self._up: set[tuple[str, str]] = set()
        self._pressed: dict[tuple[str, str], float] = {}

    def feed(self, key: str, reading: InputReading) -> None:
        """Process a reading of a device."""
        device = self._devices[key]
        for name, raw in zip(device.axes, reading.axes, strict=False):
            if isfinite(raw):
                path = self._paths.setdefault((key, name), _Path())
                path.add(reading.host_time_s, raw)
        for name, down in zip(device.buttons, reading.buttons, strict=False):
            button = key, name
            if not down:
                self._up.add(button)
            elif button in self._up:
                self._up.discard(button)
                self._pressed[button] = reading.host_time_s

    def findings(self, now_s: float) -> Findings:
        """Return what was moved within the last second, if that is clear."""
        moved = [*self._moved_axes(now_s), *self._moved_buttons(now_s)]
        found = [one for one in moved if self._wanted in (None, one.kind)]
        if len(found) > 1:
            names = " and ".join(f"{one.control} ({self._name(one.device)})" for one in found)
            return Findings(
                None, message("engine", "{names} moved together; move only one").fill(names=names)
            )
        if not found:
            what = self._wanted.value if self._wanted is not None else "control"
            return Findings(None, message("engine", "move the {what} now").fill(what=what))
        one = found[0]
        return Findings(
            one,
            message("engine", "{kind} {control} of {device}").fill(
                kind=one.kind.value, control=one.control, device=self._name(one.device)
            ),
        )

    def _moved_axes(self, now_s: float) -> Iterator[Detected]:
        """Yield the axis that was moved furthest, and those that nearly kept up with it."""
        ways = {axis: path.way(now_s) for axis, path in self._paths.items()}
        furthest = max((abs(way) for way in ways.values()), default=0.0)
        for (key, name), way in ways.items():
            if furthest >= LEAST_WAY and CLEARLY * abs(way) > furthest:
                yield Detected(key, name, Kind.AXIS, 1 if way > 0 else -1)

    def _moved_buttons(self, now_s: float) -> Iterator[Detected]:
        for (key, name), pressed_s in self._pressed.items():
            if now_s - pressed_s <= WINDOW_S:
                yield Detected(key, name, Kind.BUTTON, 1)

    def _name(self, key: str) -> str:
        return self._devices[key].identity.name


class _Path:
    """Where an axis was within the last second."""

    def __init__(self) -> None:
        self._points: deque[tuple[float, float]] = deque()

    def add(self, time_s: float, raw: float) -> None:
        self._points.append((time_s, raw))
        self._prune(time_s)

    def way(self, now_s: float) -> float:
        """Return how far it went from where it was a second ago, with its sign; 0 if it jitters."""
        self._prune(now_s)
        start = self._points[0][1]
        way = max((raw - start for _, raw in self._points), key=abs)
        path = sum(abs(b - a) for (_, a), (_, b) in pairwise(self._points))
        if path > MOST_PATH * abs(way) or self._away_s(now_s, 0.5 * way) < LEAST_STAY_S:
            return 0.0
        return way

    def _away_s(self, now_s: float, half: float) -> float:
        """Return for how long it was further than half its way from where it was."""
        start = self._points[0][1]
        ends = [*self._points, (now_s, 0.0)]
        return sum(
            max(after_s - time_s, 0.0)
            for (time_s, raw), (after_s, _) in pairwise(ends)
            if (raw - start) * half > half**2
        )

    def _prune(self, now_s: float) -> None:
        # The last one before the second is where it stood at its beginning.
        while len(self._points) > 1 and self._points[1][0] <= now_s - WINDOW_S:
            self._points.popleft()

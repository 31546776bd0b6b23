"""Detection of the control that the operator moves when asked to (*Move it now*)."""

from collections import deque
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum
from itertools import pairwise
from math import isfinite

from rotemina.app.motion.inputs.profile_check import PluggedDevice
from rotemina.drivers.inputs import InputReading
from rotemina.sim.messages import message

# A movement must happen within this time. Drift is slower.
DETECTION_WINDOW_S = 1.0
# Smallest distance of a movement in raw values: half of that from the centre to an end.
MIN_RAW_DISTANCE = 0.5
# An axis must be away from its start for this long, so that one wrong reading does not count.
MIN_AWAY_S = 0.03
# The axis must move this many times as far as every other axis.
MIN_LEAD_RATIO = 2.0
# An axis jitters if its path to and fro is more than this many times as long as its distance.
MAX_PATH_RATIO = 4.0


class ControlKind(StrEnum):
    """Kind of a control."""

    AXIS = "axis"
    BUTTON = "button"


@dataclass(frozen=True, slots=True)
class MovedControl:
    """Control that the operator has moved.

    Attributes
    ----------
    device : str
        Key of the device.
    control : str
    kind : ControlKind
    direction : int
        Direction of the axis in raw values, 1 or −1; 1 for a button.
    """

    device: str
    control: str
    kind: ControlKind
    direction: int


@dataclass(frozen=True, slots=True)
class DetectionResult:
    """Current result of a detection.

    Attributes
    ----------
    moved_control : MovedControl or None
        The only control that was clearly moved, or None.
    message : str
        Message for the operator.
    is_ambiguous : bool
        Whether several controls were moved together, which ``message`` names.
    """

    moved_control: MovedControl | None
    message: str
    is_ambiguous: bool = False


class ControlDetector:
    """Detects which control of one or several devices the operator moves.

    Parameters
    ----------
    devices : sequence of PluggedDevice
    kind : ControlKind, optional
        Detect only axes or only buttons. On many gamepads a trigger is both.
    """

    def __init__(self, devices: Sequence[PluggedDevice], kind: ControlKind | None = None) -> None:
        self._devices = {device.identity.key: device for device in devices}
        self._kind = kind
        self._paths: dict[tuple[str, str], _AxisPath] = {}
        self._released_buttons: set[tuple[str, str]] = set()
        self._pressed_s: dict[tuple[str, str], float] = {}

    def feed(self, key: str, reading: InputReading) -> None:
        """Process a reading of a device."""
        device = self._devices[key]
        for name, raw in zip(device.axes, reading.axes, strict=False):
            if isfinite(raw):
                path = self._paths.setdefault((key, name), _AxisPath())
                path.add(reading.host_time_s, raw)
        for name, down in zip(device.buttons, reading.buttons, strict=False):
            button = key, name
            if not down:
                self._released_buttons.add(button)
            elif button in self._released_buttons:
                self._released_buttons.discard(button)
                self._pressed_s[button] = reading.host_time_s

    def find_moved_control(self, now_s: float) -> DetectionResult:
        """Return the control that was moved within the last second, if there is only one."""
        moved_controls = [*self._find_moved_axes(now_s), *self._find_moved_buttons(now_s)]
        matches = [control for control in moved_controls if self._kind in (None, control.kind)]
        if len(matches) > 1:
            names = " and ".join(
                f"{match.control} ({self._find_device_name(match.device)})" for match in matches
            )
            return DetectionResult(
                None,
                message("engine", "{names} moved together; move only one").fill(names=names),
                is_ambiguous=True,
            )
        if not matches:
            what = self._kind.value if self._kind is not None else "control"
            return DetectionResult(None, message("engine", "move the {what} now").fill(what=what))
        match = matches[0]
        return DetectionResult(
            match,
            message("engine", "{kind} {control} of {device}").fill(
                kind=match.kind.value,
                control=match.control,
                device=self._find_device_name(match.device),
            ),
        )

    def _find_moved_axes(self, now_s: float) -> Iterator[MovedControl]:
        """Yield the axis that was moved farthest, and all axes that were moved nearly as far."""
        distances = {axis: path.compute_distance(now_s) for axis, path in self._paths.items()}
        max_distance = max((abs(distance) for distance in distances.values()), default=0.0)
        for (key, name), distance in distances.items():
            if max_distance >= MIN_RAW_DISTANCE and MIN_LEAD_RATIO * abs(distance) > max_distance:
                yield MovedControl(key, name, ControlKind.AXIS, 1 if distance > 0 else -1)

    def _find_moved_buttons(self, now_s: float) -> Iterator[MovedControl]:
        for (key, name), pressed_s in self._pressed_s.items():
            if now_s - pressed_s <= DETECTION_WINDOW_S:
                yield MovedControl(key, name, ControlKind.BUTTON, 1)

    def _find_device_name(self, key: str) -> str:
        return self._devices[key].identity.name


class _AxisPath:
    def __init__(self) -> None:
        # Time and raw value of each point.
        self._points: deque[tuple[float, float]] = deque()

    def add(self, time_s: float, raw: float) -> None:
        self._points.append((time_s, raw))
        self._prune(time_s)

    def compute_distance(self, now_s: float) -> float:
        """Return the signed distance from the position a second ago; 0 if the axis jitters."""
        self._prune(now_s)
        start = self._points[0][1]
        distance = max((raw - start for _, raw in self._points), key=abs)
        path = sum(abs(b - a) for (_, a), (_, b) in pairwise(self._points))
        if (
            path > MAX_PATH_RATIO * abs(distance)
            or self._compute_away_s(now_s, 0.5 * distance) < MIN_AWAY_S
        ):
            return 0.0
        return distance

    def _compute_away_s(self, now_s: float, half_distance: float) -> float:
        """Return for how long the axis was farther from its start than half its distance."""
        start = self._points[0][1]
        points = [*self._points, (now_s, 0.0)]
        return sum(
            max(next_s - time_s, 0.0)
            for (time_s, raw), (next_s, _) in pairwise(points)
            if (raw - start) * half_distance > half_distance**2
        )

    def _prune(self, now_s: float) -> None:
        # The last value before the window is the position at its beginning.
        while len(self._points) > 1 and self._points[1][0] <= now_s - DETECTION_WINDOW_S:
            self._points.popleft()

"""One connected input device: converts trusted readings to deflections and actions."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from rotemina.app.motion.teleoperation.axis_calibration import Calibration
from rotemina.app.motion.teleoperation.button_debounce import Button, Threshold
from rotemina.app.motion.teleoperation.input_trust import AxisTrust
from rotemina.app.motion.teleoperation.intent import Action
from rotemina.app.motion.teleoperation.profile import ActionMapping, DeviceMapping
from rotemina.app.motion.teleoperation.profile_check import PluggedDevice
from rotemina.app.motion.teleoperation.report_watch import MAX_SILENCE_S, ReportWatch
from rotemina.drivers.inputs.device import InputReading
from rotemina.sim.messages import message

#: Actions that work from every device, whoever drives, and while mappings are made.
STOPS = frozenset({Action.STOP, Action.EMERGENCY_STOP})
#: Actions that last as long as they are held, and are never *pressed*.
WHILE_HELD = frozenset({Action.CLUTCH, Action.DEAD_MAN, Action.FINE, Action.COARSE})


@dataclass(frozen=True, slots=True)
class AxisView:
    """One axis for a live bar.

    Attributes
    ----------
    control : str
    raw : float or None
        What the device says; None as long as it has said nothing.
    deflection : float
        Calibrated, −1 to 1, whether trusted or not.
    drives : str or None
    reason : str or None
        Why it is not trusted, in words; None if it is.
    """

    control: str
    raw: float | None
    deflection: float
    drives: str | None
    reason: str | None


class MappedDevice:
    """Reads one device by its calibration and its mapping.

    Parameters
    ----------
    device : PluggedDevice
    calibration : Calibration
    mapping : DeviceMapping or None
        Its controls are those of the device; None if the profile has nothing for it.
    last : InputReading, optional
        What the device said last, if it was read before: it may have nothing to add to that.
    """

    def __init__(
        self,
        device: PluggedDevice,
        calibration: Calibration,
        mapping: DeviceMapping | None,
        last: InputReading | None = None,
    ) -> None:
        self.device = device
        self.mapping = mapping
        #: What it said last; None as long as it has said nothing that still holds.
        self.newest = last
        #: Why nothing can be made of what it says; None: something can.
        self.problem: str | None = None
        #: Why it was lost in the last step; None: it was not.
        self.lost: str | None = None
        #: Actions pressed in the last step, and those held.
        self.pressed: frozenset[Action] = frozenset()
        self.held: frozenset[Action] = frozenset()
        self._calibrations = {axis: calibration.axis(axis) for axis in device.axes}
        self._trust = {axis: AxisTrust(self._calibrations[axis]) for axis in device.axes}
        self._raw: dict[str, float] = {}
        self._watch = ReportWatch(None if last is None else last.host_time_s)
        self._before = () if last is None else (last,)
        self._actors = [] if mapping is None else [_Actor(each) for each in mapping.actions]

    def step(self, readings: Sequence[InputReading], now_s: float) -> None:
        """Process the readings since the last step, oldest first, and let time pass."""
        self._watch.begin(now_s)
        self.lost = None
        pressed: set[Action] = set()
        for reading in self._before:
            pressed |= self._feed(reading)
        self._before = ()
        for reading in readings:
            pressed |= self._feed(reading)
            self._watch.receive(reading, now_s, at_rest=self._is_at_rest)
        for axis in self._trust.values():
            axis.step(now_s)
        for actor in self._actors:
            if actor.button.step(now_s):
                pressed.add(actor.action)
        self.pressed = frozenset(pressed - WHILE_HELD)
        self.held = frozenset(actor.action for actor in self._actors if actor.button.held)

    def check_silence(self, now_s: float, *, while_moving: bool) -> None:
        """Take back what it said if it has been silent for too long.

        Parameters
        ----------
        now_s : float
            ``host_time_s``.
        while_moving : bool
            Whether an axis of its seat is deflected.
        """
        silence_s = self._watch.silence_s(now_s)
        if self.device.streams:
            if silence_s > MAX_SILENCE_S:
                self._lose(_failed(MAX_SILENCE_S))
            return
        if self.mapping is None or not self._acts:
            return
        limit_s = self._watch.max_silence_s(self.mapping.when_silent)
        # A stream that breaks off with the dead-man held must not find it held when it returns.
        if silence_s > limit_s and (while_moving or self._watch.repeats_itself):
            self._lose(_failed(limit_s) if limit_s <= MAX_SILENCE_S else _held_still(limit_s))

    def forget_held(self, why: str) -> None:
        """Take back what it holds: nobody saw what it did meanwhile. A stop still counts."""
        self.pressed &= STOPS
        if self._acts or self.held:
            self._lose(why)

    def distrust(self, why: str) -> None:
        """Let no axis act until it is at rest."""
        for axis in self._trust.values():
            axis.reset(why)

    @property
    def wants_to_drive(self) -> bool:
        """Whether an axis of it is mapped to something that moves."""
        return self.mapping is not None and bool(self.mapping.axes)

    @property
    def is_deflected(self) -> bool:
        """Whether an axis of it asks for motion."""
        return any(self.deflections.values())

    @property
    def deflections(self) -> Mapping[str, float]:
        """Deflections of the trusted axes, by driven coordinate."""
        found: dict[str, float] = {}
        for mapping in self.mapping.axes if self.mapping is not None else ():
            if self._trust[mapping.control].reason is None and mapping.control in self._raw:
                deflection = self._deflection(mapping.control)
                found[mapping.drives] = -deflection if mapping.inverted else deflection
        return found

    def travel_m(self, drives: str) -> float | None:
        """Return the grip travel for a deflection of 1, m; None if not measured."""
        for mapping in self.mapping.axes if self.mapping is not None else ():
            if mapping.drives == drives:
                return self._calibrations[mapping.control].travel_m
        return None

    @property
    def axes(self) -> tuple[AxisView, ...]:
        """All its axes, mapped or not, for live bars."""
        mappings = self.mapping.axes if self.mapping is not None else ()
        drives = {mapping.control: mapping.drives for mapping in mappings}
        return tuple(
            AxisView(
                axis,
                self._raw.get(axis),
                self._deflection(axis) if axis in self._raw else 0.0,
                drives.get(axis),
                self.problem or trust.reason,
            )
            for axis, trust in self._trust.items()
        )

    def _deflection(self, axis: str) -> float:
        return self._calibrations[axis].deflection(self._raw[axis])

    @property
    def _acts(self) -> bool:
        """Whether it moves something, or holds what lets something move."""
        return self.is_deflected or any(
            actor.button.held and actor.action in WHILE_HELD for actor in self._actors
        )

    @property
    def _is_at_rest(self) -> bool:
        """Whether nobody seems to touch it: all in its dead zones, no action held."""
        mappings = self.mapping.axes if self.mapping is not None else ()
        return not any(actor.button.held for actor in self._actors) and all(
            mapping.control in self._raw and self._deflection(mapping.control) == 0.0
            for mapping in mappings
        )

    def _feed(self, reading: InputReading) -> set[Action]:
        device = self.device
        if reading.fault is not None:
            self._lose(reading.fault)
            return set()
        self.problem = None
        self.newest = reading
        for axis, raw in zip(device.axes, reading.axes, strict=True):
            self._raw[axis] = raw
            self._trust[axis].feed(reading.host_time_s, raw)
        buttons = dict(zip(device.buttons, reading.buttons, strict=True))
        return {
            actor.action
            for actor in self._actors
            if actor.button.feed(reading.host_time_s, self._down(actor, buttons))
        }

    def _down(self, actor: "_Actor", buttons: Mapping[str, bool]) -> bool:
        if actor.threshold is None:
            return buttons[actor.control]
        # It need not be seen at rest, a trigger that nobody calibrated is not; but no noise.
        if not self._trust[actor.control].plausible:
            return False
        return actor.threshold.feed(self._deflection(actor.control))

    def _lose(self, why: str) -> None:
        """Take back everything that it said, a held dead-man too."""
        if self.problem is None:
            self.lost = why
        self.problem = why
        self.newest = None
        self.held = frozenset()
        for axis in self._trust.values():
            axis.forget(why)
        if self.mapping is not None:
            self._actors = [_Actor(each) for each in self.mapping.actions]


def _failed(limit_s: float) -> str:
    return message(
        "engine",
        "silent: a streaming device has sent nothing for {limit} s and counts as released. Check "
        "its battery, radio link or cable; then release it and start again",
    ).fill(limit=limit_s)


def _held_still(limit_s: float) -> str:
    return message(
        "engine",
        "silent for {limit} s while it moved something, so it counts as released: its link may "
        "have failed. Release it and start again, and move the stick a little at least every "
        "{limit} s; or choose under Set up, Mapping that it continues while silent",
    ).fill(limit=limit_s)


class _Actor:
    """A control that does something."""

    def __init__(self, mapping: ActionMapping) -> None:
        self.control = mapping.control
        self.action = mapping.action
        self.button = Button(at_once=mapping.action in STOPS)
        self.threshold: Threshold | None = None
        if mapping.at is not None:
            self.threshold = Threshold(mapping.at, mapping.hysteresis)

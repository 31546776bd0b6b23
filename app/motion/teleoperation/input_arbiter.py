"""The input arbiter: merges the readings of all input devices into one intent.

It has neither threads nor a clock: whoever reads the devices tells it what came in and the time.
"""

from collections import Counter
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import compress
from math import inf
from types import MappingProxyType

from rotemina.app.motion.teleoperation.axis_calibration import Calibration, CalibrationError
from rotemina.app.motion.teleoperation.intent import Action, Intent
from rotemina.app.motion.teleoperation.mapped_device import STOPS, AxisView, MappedDevice
from rotemina.app.motion.teleoperation.profile import (
    DeviceMapping,
    OperatorRole,
    Profile,
    ProfileError,
)
from rotemina.app.motion.teleoperation.profile_check import (
    PluggedDevice,
    assigned,
    check_controls,
    check_profile,
    missing,
)
from rotemina.app.motion.teleoperation.report_watch import MAX_PAUSE_S, check_reading
from rotemina.app.motion.teleoperation.takeover import RoleState, Takeover
from rotemina.drivers.inputs.device import InputReading
from rotemina.sim.messages import marked, message
from rotemina.sim.quantities import rounded


@dataclass(frozen=True, slots=True)
class DeviceView:
    """One plugged device for the screen.

    Attributes
    ----------
    device : PluggedDevice
    seat : OperatorRole or None
        None if the profile has nothing for it.
    drives : bool
        Whether it is of the seat that drives.
    problem : str or None
        Why it cannot be used at all.
    axes : tuple of AxisView
    newest : InputReading or None
        What it said last, as long as that holds.
    calibration : Calibration
    faults : int
        How many reports could not be understood since it was plugged in.
    fault : str or None
        What was wrong with the latest of them.
    """

    device: PluggedDevice
    seat: OperatorRole | None
    drives: bool
    problem: str | None
    axes: tuple[AxisView, ...]
    newest: InputReading | None
    calibration: Calibration
    faults: int = 0
    fault: str | None = None

    @property
    def lit(self) -> frozenset[str]:
        """The buttons that are down."""
        said = () if self.newest is None else self.newest.buttons
        return frozenset(compress(self.device.buttons, said))


@dataclass(frozen=True, slots=True)
class DevicesView:
    """All input devices for the screen, as they were at one step.

    Attributes
    ----------
    host_time_s : float
        Of the step; −inf before the first.
    devices : tuple of DeviceView
        Those that are open.
    driving : OperatorRole
    setting_up : bool
        Whether nothing is sent but stops.
    profile : Profile or None
    problems : tuple of str
        What is wrong with the profile, and with devices as it uses them.
    """

    host_time_s: float = -inf
    devices: tuple[DeviceView, ...] = ()
    driving: OperatorRole = OperatorRole.TRAINER
    setting_up: bool = False
    profile: Profile | None = None
    problems: tuple[str, ...] = ()


class InputArbiter:
    """Ties calibration, trust, mapping and takeover together.

    Parameters
    ----------
    robot_axes : collection of str
        The axes that may be driven directly.
    profile : Profile, optional
        Without one nothing is driven.

    Raises
    ------
    ProfileError
        If the profile cannot be used with this robot.
    """

    def __init__(self, robot_axes: Collection[str], profile: Profile | None = None) -> None:
        self._robot_axes = tuple(robot_axes)
        self._profile = profile
        self._plugged: dict[str, PluggedDevice] = {}
        self._calibrations: dict[str, Calibration] = {}
        self._devices: dict[str, MappedDevice] = {}
        self._unusable: dict[str, str] = {}
        self._faults: Counter[str] = Counter()
        self._latest_fault: dict[str, str] = {}
        self._before_s: float | None = None
        #: What came in at the latest step, by device key: sound readings, oldest first.
        self.received: Mapping[str, tuple[InputReading, ...]] = MappingProxyType({})
        self._takeover = Takeover()
        #: Whether devices are being set up: only stops are sent.
        self.mapping_open = False
        self._lost: list[str] = []
        if profile is not None:
            check_profile(profile, self._robot_axes)

    # What is there

    def plug(self, device: PluggedDevice, calibration: Calibration | None = None) -> None:
        """Take in a device that was opened; one that the profile does not fit is a problem."""
        key = device.identity.key
        self.unplug(key, "replugged")
        self._plugged[key] = device
        self._calibrations[key] = calibration or Calibration(device=key)
        self._arrange({key})

    def unplug(self, key: str, why: str = "unplugged") -> None:
        """Release a device; if it was driving, that is over."""
        if key not in self._plugged:
            return
        self._lose(key, why)
        del self._plugged[key], self._calibrations[key]
        self._faults.pop(key, None)
        self._latest_fault.pop(key, None)
        self._arrange(())

    def inform(self, key: str, *, streams: bool) -> None:
        """Note whether a plugged device streams: that may turn out while it is open."""
        device = self._plugged[key]
        if device.streams is not streams:
            self._plugged[key] = self._devices[key].device = replace(device, streams=streams)

    def use(self, profile: Profile) -> None:
        """Use another profile; nothing moves before every stick was seen at rest.

        Raises
        ------
        ProfileError
            If it does not fit the robot, or names controls that a plugged device does not have;
            the one before stays. That a device is not there is no error, see :attr:`problems`.
        """
        check_profile(profile, self._robot_axes)
        for key, mapping in assigned(profile, self._plugged.values()).items():
            check_controls(mapping, self._plugged[key])
        self._profile = profile
        self._takeover = Takeover()
        self._lost.append(marked("engine", "another profile is now in use"))
        self._arrange(set(self._plugged))

    def calibrate(self, key: str, calibration: Calibration) -> None:
        """Use another calibration of a plugged device; it must be seen at rest again.

        Raises
        ------
        CalibrationError
            If there is no such device, or the calibration is another's.
        """
        if key not in self._plugged:
            raise CalibrationError(
                message(
                    "engine", "device {key} is not plugged in, so no calibration can be applied"
                ).fill(key=repr(key))
            )
        if calibration.device != key:
            raise CalibrationError(
                message("engine", "this calibration is for {device}, not for {key}").fill(
                    device=repr(calibration.device), key=repr(key)
                )
            )
        self._calibrations[key] = calibration
        self._lose(key, message("engine", "recalibrated"))
        self._arrange({key})

    def open_mapping(self) -> None:
        """Send only stops from now on; the device in control loses it."""
        if not self.mapping_open:
            self.mapping_open = True
            self._lost.append(marked("engine", "input devices are being set up"))

    def close_mapping(self) -> None:
        """Send again, after every stick was seen at rest and every button released."""
        if self.mapping_open:
            self.mapping_open = False
            self._arrange(set(self._plugged))

    # What the operator wants

    def step(self, readings: Mapping[str, Sequence[InputReading]], now_s: float) -> Intent:
        """Return the present intent.

        Parameters
        ----------
        readings : mapping of str to sequence of InputReading
            By device key, what came in since the last step, oldest first.
        now_s : float
            ``host_time_s``.
        """
        before_s = now_s if self._before_s is None else self._before_s
        self._before_s = now_s
        self.received = self._checked(readings, before_s, now_s)
        for key, device in self._devices.items():
            device.step(self.received.get(key, ()), now_s)
        self._end_stale_consent(before_s, now_s)
        for key, device in self._devices.items():
            if device.lost is not None:
                self._lose(key, device.lost)
        if not self.mapping_open:
            self._hand_over()
        lost, self._lost = "; ".join(self._lost) or None, []
        pressed, held = self._actions()
        return Intent(
            host_time_s=self._newest_s(now_s),
            deflections=MappingProxyType(self._deflections(held)),
            pressed=pressed,
            held=held,
            device=self._driving_key(),
            lost=lost,
        )

    @property
    def driving(self) -> OperatorRole:
        """The seat that drives."""
        return self._takeover.driving

    @property
    def problems(self) -> tuple[str, ...]:
        """What keeps a profile or a device from being used, in words."""
        if self._profile is None:
            return (message("engine", "no profile is chosen: the input devices do nothing"),)
        absent = missing(self._profile, tuple(self._plugged.values()))
        return (*((absent,) if absent is not None else ()), *self._unusable.values())

    @property
    def views(self) -> tuple[DeviceView, ...]:
        """All plugged devices, for live bars."""
        return tuple(
            DeviceView(
                device.device,
                device.mapping.seat if device.mapping is not None else None,
                self._drives(device),
                self._unusable.get(key) or device.problem,
                device.axes,
                device.newest,
                self._calibrations[key],
                self._faults[key],
                self._latest_fault.get(key),
            )
            for key, device in self._devices.items()
        )

    def travel_m(self, drives: str) -> float | None:
        """Return the travel of the controlling stick for a deflection of 1, m, if known."""
        ways = (device.travel_m(drives) for device in self._of(self.driving))
        return next((way for way in ways if way is not None), None)

    # How

    def _checked(
        self, readings: Mapping[str, Sequence[InputReading]], before_s: float, now_s: float
    ) -> Mapping[str, tuple[InputReading, ...]]:
        """Return sound readings of the devices that are there, and count the faults."""
        checked = {
            key: tuple(
                check_reading(self._plugged[key], reading, before_s, now_s) for reading in each
            )
            for key, each in readings.items()
            if key in self._plugged
        }
        for key, each in checked.items():
            for fault in (one.fault for one in each if one.fault is not None):
                self._faults[key] += 1
                self._latest_fault[key] = fault
        return MappingProxyType(checked)

    def _end_stale_consent(self, before_s: float, now_s: float) -> None:
        """Let nothing act by what a device said too long ago."""
        if not 0.0 <= now_s - before_s <= MAX_PAUSE_S:
            why = message(
                "engine",
                "the program was suspended or overloaded: its clock jumped by {pause} s. Release "
                "the device and start again",
            ).fill(pause=rounded(now_s - before_s, 3))
            for device in self._devices.values():
                device.forget_held(why)
        moving = {seat: any(each.is_deflected for each in self._of(seat)) for seat in OperatorRole}
        for device in self._devices.values():
            seat = None if device.mapping is None else device.mapping.seat
            device.check_silence(now_s, while_moving=seat is not None and moving[seat])

    def _arrange(self, anew: Collection[str]) -> None:
        """Give each device its mapping; those that are new, or have another one, begin again."""
        mappings = self._mappings()
        devices: dict[str, MappedDevice] = {}
        for key, device in self._plugged.items():
            mapping = mappings.get(key)
            kept = self._devices.get(key)
            if kept is None or key in anew or kept.mapping is not mapping:
                last = None if kept is None else kept.newest
                kept = MappedDevice(device, self._calibrations[key], mapping, last)
            devices[key] = kept
        self._devices = devices

    def _mappings(self) -> dict[str, DeviceMapping]:
        self._unusable = {}
        if self._profile is None:
            return {}
        found = dict(assigned(self._profile, self._plugged.values()))
        for key, mapping in tuple(found.items()):
            try:
                check_controls(mapping, self._plugged[key])
            except ProfileError as error:
                self._unusable[key] = str(error)
                del found[key]
        return found

    def _lose(self, key: str, why: str) -> None:
        if self._drives(self._devices[key]):
            self._lost.append(f"{self._plugged[key].identity.name}: {why}")
            for device in self._of(self.driving):
                device.distrust(
                    message("engine", "another device was lost ({why}): release it").fill(why=why)
                )

    def _drives(self, device: MappedDevice) -> bool:
        return device.mapping is not None and device.mapping.seat is self.driving

    def _of(self, seat: OperatorRole) -> tuple[MappedDevice, ...]:
        return tuple(
            device
            for device in self._devices.values()
            if device.mapping is not None and device.mapping.seat is seat
        )

    def _hand_over(self) -> None:
        reason = self._takeover.decide(
            self._state(OperatorRole.TRAINER), self._state(OperatorRole.TRAINEE)
        )
        if reason is not None:
            self._lost.append(reason)
            for device in self._of(self.driving):
                device.distrust(message("engine", "{reason}: release it first").fill(reason=reason))

    def _state(self, seat: OperatorRole) -> RoleState:
        devices = self._of(seat)
        deflections = [abs(d) for device in devices for d in device.deflections.values()]
        return RoleState(
            present=any(device.problem is None for device in devices),
            asks=any(Action.TAKE_OVER in device.pressed for device in devices),
            most=max(deflections, default=0.0),
        )

    def _actions(self) -> tuple[frozenset[Action], frozenset[Action]]:
        """Return the actions pressed and held: all of the seat that drives, stops of every one."""
        pressed: set[Action] = set()
        held: set[Action] = set()
        for device in self._devices.values():
            heard = self._drives(device) and not self.mapping_open
            pressed |= device.pressed if heard else device.pressed & STOPS
            held |= device.held if heard else device.held & STOPS
        return frozenset(pressed), frozenset(held)

    def _deflections(self, held: Collection[Action]) -> dict[str, float]:
        if self.mapping_open or (self._guarded() and Action.DEAD_MAN not in held):
            return {}
        devices = self._of(self.driving)
        return {axis: d for device in devices for axis, d in device.deflections.items()}

    def _guarded(self) -> bool:
        """Whether the driving seat has a dead-man, be it plugged in or not."""
        return self._profile is not None and any(
            action.action is Action.DEAD_MAN
            for device in self._profile.devices
            if device.seat is self.driving
            for action in device.actions
        )

    def _driving_key(self) -> str:
        keys = [d.device.identity.key for d in self._of(self.driving) if d.wants_to_drive]
        return keys[0] if keys else ""

    def _newest_s(self, now_s: float) -> float:
        newest = (device.newest for device in self._of(self.driving))
        times = [reading.host_time_s for reading in newest if reading is not None]
        return max(times, default=now_s)

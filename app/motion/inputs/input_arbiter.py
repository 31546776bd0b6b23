"""The input arbiter: merges the readings of all input devices into one intent.

The arbiter has neither threads nor a clock. Its caller reads the devices and passes the readings
and the time.
"""

from collections import Counter
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import compress
from math import inf
from types import MappingProxyType

from rotemina.app.errors import InputCalibrationError, InputProfileError
from rotemina.app.motion.inputs.axis_calibration import InputCalibration
from rotemina.app.motion.inputs.intent import Intent, OperatorAction
from rotemina.app.motion.inputs.mapped_device import (
    STOP_ACTIONS,
    InputAxisView,
    MappedDevice,
)
from rotemina.app.motion.inputs.profile import DeviceMapping, InputProfile, OperatorRole
from rotemina.app.motion.inputs.profile_check import (
    PluggedDevice,
    assign_mappings,
    check_controls,
    check_profile,
    describe_missing_devices,
)
from rotemina.app.motion.inputs.report_watch import MAX_PAUSE_S, sanitise_reading
from rotemina.app.motion.inputs.takeover import SeatState, Takeover
from rotemina.drivers.inputs import InputReading
from rotemina.sim.messages import format_rounded, marked, message


@dataclass(frozen=True, slots=True)
class InputDeviceView:
    """State of one plugged device, for the screen.

    Attributes
    ----------
    device : PluggedDevice
    seat : OperatorRole or None
        Role of the operator who uses the device; None if the profile does not map the device.
    is_driving : bool
        Whether the device belongs to the operator who drives.
    problem : str or None
        Why the device cannot be used.
    axes : tuple of InputAxisView
    latest_reading : InputReading or None
        Latest reading; None if it is no longer valid.
    calibration : InputCalibration
    fault_count : int
        Number of invalid reports since the device was plugged in.
    fault : str or None
        What was wrong with the latest invalid report.
    """

    device: PluggedDevice
    seat: OperatorRole | None
    is_driving: bool
    problem: str | None
    axes: tuple[InputAxisView, ...]
    latest_reading: InputReading | None
    calibration: InputCalibration
    fault_count: int = 0
    fault: str | None = None

    @property
    def pressed_buttons(self) -> frozenset[str]:
        """Names of the buttons that are pressed."""
        button_states = () if self.latest_reading is None else self.latest_reading.buttons
        return frozenset(compress(self.device.buttons, button_states))


@dataclass(frozen=True, slots=True)
class InputDisplayState:
    """State of all input devices after one step, for the screen.

    Attributes
    ----------
    host_time_s : float
        Host time of the step; −inf before the first one.
    devices : tuple of InputDeviceView
        The devices that are plugged in.
    driving_seat : OperatorRole
    is_mapping_open : bool
        Whether only stops are passed on, because devices are being set up.
    profile : InputProfile or None
    problems : tuple of str
        Problems of the profile, and of devices that it uses.
    """

    host_time_s: float = -inf
    devices: tuple[InputDeviceView, ...] = ()
    driving_seat: OperatorRole = OperatorRole.TRAINER
    is_mapping_open: bool = False
    profile: InputProfile | None = None
    problems: tuple[str, ...] = ()


class InputArbiter:
    """Combines the calibration, trust, mapping and takeover of all input devices.

    Parameters
    ----------
    robot_axes : collection of str
        Axes that may be driven directly.
    profile : InputProfile, optional
        Without a profile no axis is driven.

    Raises
    ------
    InputProfileError
        If the profile cannot be used with this robot.
    """

    def __init__(self, robot_axes: Collection[str], profile: InputProfile | None = None) -> None:
        self._robot_axes = tuple(robot_axes)
        self._profile = profile
        self._plugged_devices: dict[str, PluggedDevice] = {}
        self._calibrations: dict[str, InputCalibration] = {}
        self._devices: dict[str, MappedDevice] = {}
        self._unusable_reasons: dict[str, str] = {}
        self._fault_counts: Counter[str] = Counter()
        self._latest_faults: dict[str, str] = {}
        self._last_step_s: float | None = None
        #: Checked readings of the latest step by device key, oldest first.
        self.latest_readings: Mapping[str, tuple[InputReading, ...]] = MappingProxyType({})
        self._takeover = Takeover()
        #: Whether only stops are passed on, because devices are being set up.
        self.is_mapping_open = False
        self._loss_reasons: list[str] = []
        if profile is not None:
            check_profile(profile, self._robot_axes)

    def plug(self, device: PluggedDevice, calibration: InputCalibration | None = None) -> None:
        """Add an open device. A profile that does not fit it becomes a problem of the device."""
        key = device.identity.key
        self.unplug(key, "replugged")
        self._plugged_devices[key] = device
        self._calibrations[key] = calibration or InputCalibration(device=key)
        self._rebuild_devices({key})

    def unplug(self, key: str, reason: str = "unplugged") -> None:
        """Remove a device; if it was driving, it loses control."""
        if key not in self._plugged_devices:
            return
        self._note_loss(key, reason)
        del self._plugged_devices[key], self._calibrations[key]
        self._fault_counts.pop(key, None)
        self._latest_faults.pop(key, None)
        self._rebuild_devices(())

    def set_streaming(self, key: str, *, streams: bool) -> None:
        """Set whether a device streams, which some devices show only while they are open."""
        device = self._plugged_devices[key]
        if device.streams is not streams:
            self._plugged_devices[key] = self._devices[key].device = replace(
                device, streams=streams
            )

    def use_profile(self, profile: InputProfile) -> None:
        """Use another profile. Each axis must be at rest once before it acts.

        Raises
        ------
        InputProfileError
            If the profile does not fit the robot, or names controls that a plugged device does not
            have; then the previous profile stays in use. A missing device is not an error, see
            :attr:`problems`.
        """
        check_profile(profile, self._robot_axes)
        for key, mapping in assign_mappings(profile, self._plugged_devices.values()).items():
            check_controls(mapping, self._plugged_devices[key])
        self._profile = profile
        self._takeover = Takeover()
        self._loss_reasons.append(marked("engine", "another profile is now in use"))
        self._rebuild_devices(set(self._plugged_devices))

    def use_calibration(self, key: str, calibration: InputCalibration) -> None:
        """Use another calibration of a plugged device, whose axes must first be at rest once.

        Raises
        ------
        InputCalibrationError
            If the device is not plugged in, or the calibration belongs to another device.
        """
        if key not in self._plugged_devices:
            raise InputCalibrationError(
                "device {key} is not plugged in, so no calibration can be applied", key=repr(key)
            )
        if calibration.device != key:
            raise InputCalibrationError(
                "this calibration is for {device}, not for {key}",
                device=repr(calibration.device),
                key=repr(key),
            )
        self._calibrations[key] = calibration
        self._note_loss(key, message("engine", "recalibrated"))
        self._rebuild_devices({key})

    def open_mapping(self) -> None:
        """Pass on only stops from now on. The device that drives loses control."""
        if not self.is_mapping_open:
            self.is_mapping_open = True
            self._loss_reasons.append(marked("engine", "input devices are being set up"))

    def close_mapping(self) -> None:
        """Pass on everything again, once axes have been at rest and buttons have been released."""
        if self.is_mapping_open:
            self.is_mapping_open = False
            self._rebuild_devices(set(self._plugged_devices))

    def step(self, readings: Mapping[str, Sequence[InputReading]], now_s: float) -> Intent:
        """Process new readings and return the current intent.

        Parameters
        ----------
        readings : mapping of str to sequence of InputReading
            Readings since the last step by device key, oldest first.
        now_s : float
            Host time.
        """
        last_step_s = now_s if self._last_step_s is None else self._last_step_s
        self._last_step_s = now_s
        self.latest_readings = self._check_readings(readings, last_step_s, now_s)
        for key, device in self._devices.items():
            device.step(self.latest_readings.get(key, ()), now_s)
        self._release_stale_inputs(last_step_s, now_s)
        for key, device in self._devices.items():
            if device.loss_reason is not None:
                self._note_loss(key, device.loss_reason)
        if not self.is_mapping_open:
            self._decide_takeover()
        loss_reason, self._loss_reasons = "; ".join(self._loss_reasons) or None, []
        pressed, held = self._collect_actions()
        return Intent(
            host_time_s=self._find_latest_reading_s(now_s),
            deflections=MappingProxyType(self._collect_deflections(held)),
            pressed=pressed,
            held=held,
            device=self._find_driving_key(),
            loss_reason=loss_reason,
        )

    @property
    def driving_seat(self) -> OperatorRole:
        """Role of the operator who drives."""
        return self._takeover.driving_seat

    @property
    def problems(self) -> tuple[str, ...]:
        """Messages on why the profile or a device cannot be used."""
        if self._profile is None:
            return (message("engine", "no profile is chosen: the input devices do nothing"),)
        missing_devices = describe_missing_devices(
            self._profile, tuple(self._plugged_devices.values())
        )
        return (
            *((missing_devices,) if missing_devices is not None else ()),
            *self._unusable_reasons.values(),
        )

    @property
    def device_views(self) -> tuple[InputDeviceView, ...]:
        """States of all plugged devices, for the screen."""
        return tuple(
            InputDeviceView(
                device.device,
                device.mapping.seat if device.mapping is not None else None,
                self._is_driving(device),
                self._unusable_reasons.get(key) or device.problem,
                device.axes,
                device.latest_reading,
                self._calibrations[key],
                self._fault_counts[key],
                self._latest_faults.get(key),
            )
            for key, device in self._devices.items()
        )

    def find_travel_m(self, drives: str) -> float | None:
        """Return the grip travel of the driving stick for a deflection of 1, m, or None."""
        travels = (device.find_travel_m(drives) for device in self._find_devices(self.driving_seat))
        return next((travel for travel in travels if travel is not None), None)

    def _check_readings(
        self, readings: Mapping[str, Sequence[InputReading]], last_step_s: float, now_s: float
    ) -> Mapping[str, tuple[InputReading, ...]]:
        """Return the checked readings of plugged devices, and count the faults."""
        checked_readings = {
            key: tuple(
                sanitise_reading(self._plugged_devices[key], reading, last_step_s, now_s)
                for reading in device_readings
            )
            for key, device_readings in readings.items()
            if key in self._plugged_devices
        }
        for key, device_readings in checked_readings.items():
            for fault in (
                reading.fault for reading in device_readings if reading.fault is not None
            ):
                self._fault_counts[key] += 1
                self._latest_faults[key] = fault
        return MappingProxyType(checked_readings)

    def _release_stale_inputs(self, last_step_s: float, now_s: float) -> None:
        if not 0.0 <= now_s - last_step_s <= MAX_PAUSE_S:
            reason = message(
                "engine",
                "the program was suspended or overloaded: its clock jumped by {pause} s. Release "
                "the device and start again",
            ).fill(pause=format_rounded(now_s - last_step_s, 3))
            for device in self._devices.values():
                device.forget_held(reason)
        is_deflected = {
            seat: any(device.is_deflected for device in self._find_devices(seat))
            for seat in OperatorRole
        }
        for device in self._devices.values():
            seat = None if device.mapping is None else device.mapping.seat
            device.check_silence(now_s, while_moving=seat is not None and is_deflected[seat])

    def _rebuild_devices(self, keys: Collection[str]) -> None:
        """Give each device its mapping.

        Devices that are new, get another mapping or are among ``keys`` are set up again.
        """
        mappings = self._find_mappings()
        devices: dict[str, MappedDevice] = {}
        for key, device in self._plugged_devices.items():
            mapping = mappings.get(key)
            mapped_device = self._devices.get(key)
            if mapped_device is None or key in keys or mapped_device.mapping is not mapping:
                latest_reading = None if mapped_device is None else mapped_device.latest_reading
                mapped_device = MappedDevice(
                    device, self._calibrations[key], mapping, latest_reading
                )
            devices[key] = mapped_device
        self._devices = devices

    def _find_mappings(self) -> dict[str, DeviceMapping]:
        self._unusable_reasons = {}
        if self._profile is None:
            return {}
        mappings = dict(assign_mappings(self._profile, self._plugged_devices.values()))
        for key, mapping in tuple(mappings.items()):
            try:
                check_controls(mapping, self._plugged_devices[key])
            except InputProfileError as error:
                self._unusable_reasons[key] = str(error)
                del mappings[key]
        return mappings

    def _note_loss(self, key: str, reason: str) -> None:
        if self._is_driving(self._devices[key]):
            self._loss_reasons.append(f"{self._plugged_devices[key].identity.name}: {reason}")
            for device in self._find_devices(self.driving_seat):
                device.distrust_axes(
                    message("engine", "another device was lost ({why}): release it").fill(
                        why=reason
                    )
                )

    def _is_driving(self, device: MappedDevice) -> bool:
        return device.mapping is not None and device.mapping.seat is self.driving_seat

    def _find_devices(self, seat: OperatorRole) -> tuple[MappedDevice, ...]:
        return tuple(
            device
            for device in self._devices.values()
            if device.mapping is not None and device.mapping.seat is seat
        )

    def _decide_takeover(self) -> None:
        reason = self._takeover.decide(
            self._make_seat_state(OperatorRole.TRAINER), self._make_seat_state(OperatorRole.TRAINEE)
        )
        if reason is not None:
            self._loss_reasons.append(reason)
            for device in self._find_devices(self.driving_seat):
                device.distrust_axes(
                    message("engine", "{reason}: release it first").fill(reason=reason)
                )

    def _make_seat_state(self, seat: OperatorRole) -> SeatState:
        devices = self._find_devices(seat)
        deflections = [
            abs(deflection) for device in devices for deflection in device.deflections.values()
        ]
        return SeatState(
            is_present=any(device.problem is None for device in devices),
            requests_control=any(OperatorAction.TAKE_OVER in device.pressed for device in devices),
            max_deflection=max(deflections, default=0.0),
        )

    def _collect_actions(self) -> tuple[frozenset[OperatorAction], frozenset[OperatorAction]]:
        """Return the actions pressed and held by the driving operator, and all stops."""
        pressed: set[OperatorAction] = set()
        held: set[OperatorAction] = set()
        for device in self._devices.values():
            passes_all_actions = self._is_driving(device) and not self.is_mapping_open
            pressed |= device.pressed if passes_all_actions else device.pressed & STOP_ACTIONS
            held |= device.held if passes_all_actions else device.held & STOP_ACTIONS
        return frozenset(pressed), frozenset(held)

    def _collect_deflections(self, held: Collection[OperatorAction]) -> dict[str, float]:
        if self.is_mapping_open or (self._has_dead_man() and OperatorAction.DEAD_MAN not in held):
            return {}
        devices = self._find_devices(self.driving_seat)
        return {
            drives: deflection
            for device in devices
            for drives, deflection in device.deflections.items()
        }

    def _has_dead_man(self) -> bool:
        """Return whether the driving operator has a dead-man button, plugged in or not."""
        return self._profile is not None and any(
            action.action is OperatorAction.DEAD_MAN
            for device in self._profile.devices
            if device.seat is self.driving_seat
            for action in device.actions
        )

    def _find_driving_key(self) -> str:
        keys = [
            device.device.identity.key
            for device in self._find_devices(self.driving_seat)
            if device.has_mapped_axes
        ]
        return keys[0] if keys else ""

    def _find_latest_reading_s(self, now_s: float) -> float:
        readings = (device.latest_reading for device in self._find_devices(self.driving_seat))
        times = [reading.host_time_s for reading in readings if reading is not None]
        return max(times, default=now_s)

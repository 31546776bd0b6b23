"""Driver of a stage with a GRBL controller, which is moved by G-code."""

import time
from collections import deque
from collections.abc import Callable, Mapping
from dataclasses import replace
from types import MappingProxyType
from typing import ClassVar

from rotemina.drivers.abilities import AxisHomer, LinkReporter
from rotemina.drivers.contract import (
    Clock,
    DeviceAxis,
    DeviceSamples,
    DeviceStatus,
    DriverError,
    DriverSettingError,
    LimitError,
    LinkQuality,
    MachineKind,
    Permit,
    SettingValue,
    StateError,
)
from rotemina.drivers.gcode.controller_settings import ControllerSettings
from rotemina.drivers.gcode.controller_state import GrblController
from rotemina.drivers.gcode.coordinates import StageAxis
from rotemina.drivers.gcode.dialogue import MIN_STAMP_ERROR_S, GrblDialogue
from rotemina.drivers.gcode.opening import ControllerHandshake, ControllerIdentity
from rotemina.drivers.gcode.settings_check import check_agreement, check_stage
from rotemina.drivers.serial_lines import (
    BytePort,
    OpenPort,
    open_port,
)
from rotemina.sim.errors import InputError
from rotemina.sim.robot import Robot


class GcodeStage(AxisHomer, LinkReporter):
    """A stage of up to six stepping motors with a GRBL controller.

    Settings: ``port``, a device or a URL of pyserial; ``baud``; ``letters`` of the axes, in the
    order of the robot file; ``poll_s``, the period of status requests; ``homing_s``, the time limit
    for homing; ``trust_position``, whether the controller's step count is accepted as the position
    at opening. Otherwise the axes must be homed first.

    The controller has no position sensors, so readings are its own step count. It has no clock
    either, so a sample gets the time in the middle of its round trip. It is dropped if the answer
    was late.

    Parameters
    ----------
    robot, settings, clock
        See :class:`rotemina.drivers.contract.Driver`.
    open_port : callable
        Opens a port from a URL and a baud rate.
    pause : callable
        Waits for a number of seconds while the controller is opened or closed.

    Raises
    ------
    InputError
        If the robot has an axis that such a controller cannot move.
    """

    name = "gcode"
    service_period_s = 0.005
    stamp_error_s = MIN_STAMP_ERROR_S
    default_settings: ClassVar[Mapping[str, SettingValue]] = MappingProxyType(
        {
            "port": "",
            "baud": 115_200,
            "letters": "XYZABC",
            "poll_s": 0.02,
            "homing_s": 120.0,
            "trust_position": False,
        }
    )

    def __init__(
        self,
        robot: Robot,
        settings: Mapping[str, object] | None = None,
        *,
        clock: Clock = time.monotonic,
        open_port: OpenPort = open_port,
        pause: Callable[[float], None] = time.sleep,
    ) -> None:
        super().__init__(robot, settings, clock=clock)
        self._letters = str(self.settings["letters"])
        if set(self._letters) - set("XYZABCUVW") or len(set(self._letters)) < len(self._letters):
            raise DriverSettingError(
                "gcode: letters = {letters}: must be different letters of XYZABCUVW",
                letters=repr(self._letters),
            )
        check_stage(robot, self._letters)
        self._baud = int(self._read_bounded("baud", 300, 4_000_000))
        self._poll_s = self._read_bounded("poll_s", 0.01, 0.2)
        self._homing_s = self._read_bounded("homing_s", 1.0, 3600.0)
        self._open_port = open_port
        self._pause = pause
        self._controller: GrblController | None = None
        self._port: BytePort | None = None
        self._axes: tuple[StageAxis, ...] = ()
        self._controller_settings = ControllerSettings()

    @property
    def descriptions(self) -> tuple[DeviceAxis, ...]:
        """The axes, with the controller's step sizes, speeds and accelerations."""
        base_descriptions = super().descriptions
        if not self._axes:
            return base_descriptions
        return tuple(
            replace(
                description,
                resolution=axis.resolution,
                max_speed=axis.speed,
                max_acceleration=axis.acceleration,
            )
            for description, axis in zip(base_descriptions, self._axes, strict=True)
        )

    @property
    def homing_axes(self) -> tuple[str, ...]:
        """All axes if homing is enabled in the controller ($22), otherwise none."""
        return self.axes if self._controller_settings.can_home else ()

    @property
    def stop_pending(self) -> bool:
        """Whether a stop is incomplete: the axes must come to rest and the queue be emptied."""
        return self._controller is not None and self._controller.stop_pending

    def link_quality(self) -> LinkQuality:
        """Return the quality of the line."""
        return (
            LinkQuality() if self._controller is None else self._controller.dialogue.read_quality()
        )

    def _open(self) -> None:
        url = str(self.settings["port"])
        port = self._open_port(url, self._baud)
        self._controller_settings = ControllerSettings()
        try:
            dialogue = GrblDialogue(port, self.clock, self._baud)
            letters = self._letters[: len(self.axes)]
            identity = ControllerHandshake(dialogue, self.clock, self._pause, url).connect(letters)
            self._axes = self._match_axes(identity, url)
            self._controller_settings = identity.settings
        except BaseException:
            port.close()
            raise
        self._port = port
        controller = GrblController(
            self.name,
            dialogue,
            self._axes,
            identity.settings,
            identity.status,
            self.clock,
            poll_s=self._poll_s,
            homing_s=self._homing_s,
            port=url,
        )
        if self.settings["trust_position"] and identity.status.state == "Idle":
            controller.accept_step_count()
        self._controller = controller

    def _identify(self) -> MachineKind:
        is_virtual = self._controller_settings.is_virtual
        return MachineKind.VIRTUAL if is_virtual else MachineKind.REAL

    def _match_axes(self, identity: ControllerIdentity, url: str) -> tuple[StageAxis, ...]:
        count = len(identity.status.position or ())
        if count < len(self.axes):
            raise DriverError(
                "{url}: the controller has {count} axes, robot {robot} {expected}; choose "
                "the robot file of this stage",
                url=url,
                count=count,
                robot=repr(self.robot.name),
                expected=len(self.axes),
            )
        try:
            axes = tuple(
                StageAxis.of(self.robot, name, self._letters[number], number, identity.settings)
                for number, name in enumerate(self.axes)
            )
            check_agreement(self.robot, axes, identity.settings)
        except InputError as error:
            raise DriverError("{url}: {error}", url=url, error=str(error)) from error
        return axes

    def _close(self) -> None:
        controller, self._controller = self._controller, None
        assert controller is not None, "the contract closes only an open driver"
        try:
            if not controller.is_unreachable:
                url = str(self.settings["port"])
                handshake = ControllerHandshake(controller.dialogue, self.clock, self._pause, url)
                handshake.leave(homing=controller.is_homing)
        finally:
            if self._port is not None:
                self._port.close()

    def _status(self) -> DeviceStatus:
        controller = self._open_controller
        unhomed = tuple(axis for axis in self.axes if axis not in controller.reports.known_axes)
        return DeviceStatus(
            controller.state,
            fault=controller.fault,
            position_known=not unhomed,
            unhomed=unhomed,
            silent_s=controller.silent_s,
        )

    def _move_to(self, targets: dict[str, float], speeds: dict[str, float], permit: Permit) -> None:
        self._open_controller.move_to(targets, speeds, permit)

    def _stop(self) -> None:
        controller = self._controller
        if controller is not None:
            controller.stop()

    def _clear_fault(self, permit: Permit) -> None:
        if self._open_controller.is_braking:
            raise StateError(
                "{name}: the axes are still braking; clear the fault when they rest", name=self.name
            )
        self._open_controller.clear_fault(permit)

    def _home(self, axes: tuple[str, ...], permit: Permit) -> None:
        homes_single_axes = self._controller_settings.homes_single_axes
        if not homes_single_axes and set(axes) != set(self.axes):
            raise LimitError(
                "{name}: this controller homes all axes together; home all {count}, or build "
                "it with single-axis homing",
                name=self.name,
                count=len(self.axes),
            )
        if not self._open_controller.is_ready:
            raise StateError("{name} is still handling a stop; try again", name=self.name)
        lines = deque([("$H", self.axes)])
        if homes_single_axes:
            lines = deque(("$H" + self._letters[self.axes.index(axis)], (axis,)) for axis in axes)
        self._open_controller.home(lines, permit)

    def _read(self) -> DeviceSamples:
        samples = self._open_controller.step(self.clock())
        self.stamp_error_s = self._open_controller.dialogue.stamp_error_s
        return samples

    @property
    def _open_controller(self) -> GrblController:
        assert self._controller is not None, "the contract calls hooks of an open driver"
        return self._controller

    def _read_bounded(self, name: str, low: float, high: float) -> float:
        value = float(self.settings[name])
        if not low <= value <= high:
            raise DriverSettingError(
                "gcode: {name} = {value}: must be {low} to {high}",
                name=name,
                value=value,
                low=low,
                high=high,
            )
        return value

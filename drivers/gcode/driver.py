"""The driver of a stage that a GRBL controller moves by G-code."""

import time
from collections import deque
from collections.abc import Callable, Mapping
from dataclasses import replace
from types import MappingProxyType
from typing import ClassVar

from rotemina.drivers.abilities import Homer, Linked
from rotemina.drivers.axes import AxisDescription
from rotemina.drivers.clock import Clock
from rotemina.drivers.driver import MachineKind
from rotemina.drivers.errors import DriverError, LimitError, StateError
from rotemina.drivers.gate import Permit
from rotemina.drivers.gcode.controller_settings import ControllerSettings
from rotemina.drivers.gcode.controller_state import Controller
from rotemina.drivers.gcode.coordinates import StageAxis, check_agreement, check_stage
from rotemina.drivers.gcode.dialogue import MIN_STAMP_ERROR_S, Dialogue
from rotemina.drivers.gcode.opening import ControllerInfo, Opening
from rotemina.drivers.line_quality import LinkQuality
from rotemina.drivers.samples import DeviceStatus, Samples
from rotemina.drivers.serial_port import OpenPort, Port, open_port
from rotemina.drivers.settings import SettingError, SettingValue
from rotemina.sim.errors import InputError
from rotemina.sim.messages import message
from rotemina.sim.robot.model import Robot


class GcodeStage(Homer, Linked):
    """A stage of up to six stepping motors behind a GRBL controller.

    Settings: ``port``, a device or a URL of pyserial; ``baud``; ``letters`` of the axes, in the
    order of the robot file; ``poll_s``, how often a report is requested; ``homing_s``, how long a
    search for switches may take; ``trust_position``, take the controller's count of steps for the
    position when it is opened (otherwise the axes must be homed first).

    The controller has no sensors: readings are its own count of steps. Nor has it a clock: a sample
    is of the middle of its round trip, and is left out where the answer was late.

    Parameters
    ----------
    robot, settings, clock
        See :class:`rotemina.drivers.driver.Driver`.
    open_port : callable
        Return an open port of a URL and a baud rate.
    pause : callable
        Let some seconds pass, while the controller is opened or closed.

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
            raise SettingError(
                message(
                    "engine", "gcode: letters = {letters}: must be different ones of XYZABCUVW"
                ).fill(letters=repr(self._letters))
            )
        check_stage(robot, self._letters)
        self._baud = int(self._bounded("baud", 300, 4_000_000))
        self._poll_s = self._bounded("poll_s", 0.01, 0.2)
        self._homing_s = self._bounded("homing_s", 1.0, 3600.0)
        self._open_port = open_port
        self._pause = pause
        self._controller: Controller | None = None
        self._port: Port | None = None
        self._axes: tuple[StageAxis, ...] = ()
        self._controller_settings = ControllerSettings()

    # --- what the contract asks for ----------------------------------------------------------

    @property
    def descriptions(self) -> tuple[AxisDescription, ...]:
        """The axes, with the controller's step sizes, speeds and accelerations."""
        described = super().descriptions
        if not self._axes:
            return described
        return tuple(
            replace(
                description,
                resolution=axis.resolution,
                max_speed=axis.speed,
                max_acceleration=axis.acceleration,
            )
            for description, axis in zip(described, self._axes, strict=True)
        )

    @property
    def homing_axes(self) -> tuple[str, ...]:
        """All axes, where the controller's homing is enabled ($22)."""
        return self.axes if self._controller_settings.can_home else ()

    @property
    def stop_pending(self) -> bool:
        """Whether the controller must still come to rest and be emptied after a stop."""
        return self._controller is not None and self._controller.stop_pending

    def link_quality(self) -> LinkQuality:
        """Return the quality of the line."""
        return LinkQuality() if self._controller is None else self._controller.dialogue.quality()

    def _open(self) -> None:
        url = str(self.settings["port"])
        port = self._open_port(url, self._baud)
        self._controller_settings = ControllerSettings()
        try:
            dialogue = Dialogue(port, self.clock, self._baud)
            letters = self._letters[: len(self.axes)]
            info = Opening(dialogue, self.clock, self._pause, url).handshake(letters)
            self._axes = self._matched(info, url)
            self._controller_settings = info.settings
        except BaseException:
            port.close()
            raise
        self._port = port
        controller = Controller(
            self.name,
            dialogue,
            self._axes,
            info.settings,
            info.status,
            self.clock,
            poll_s=self._poll_s,
            homing_s=self._homing_s,
            port=url,
        )
        if self.settings["trust_position"] and info.status.state == "Idle":
            controller.trust_count()
        self._controller = controller

    def _identify(self) -> MachineKind:
        virtual = self._controller_settings.is_virtual
        return MachineKind.VIRTUAL if virtual else MachineKind.REAL

    def _matched(self, info: ControllerInfo, url: str) -> tuple[StageAxis, ...]:
        count = len(info.status.position or ())
        if count < len(self.axes):
            raise DriverError(
                message(
                    "engine",
                    "{url}: the controller has {count} axes, robot {robot} {expected}; choose "
                    "the robot file of this stage",
                ).fill(url=url, count=count, robot=repr(self.robot.name), expected=len(self.axes))
            )
        try:
            axes = tuple(
                StageAxis.of(self.robot, name, self._letters[number], number, info.settings)
                for number, name in enumerate(self.axes)
            )
            check_agreement(self.robot, axes, info.settings)
        except InputError as error:
            raise DriverError(
                message("engine", "{url}: {error}").fill(url=url, error=str(error))
            ) from error
        return axes

    def _close(self) -> None:
        controller, self._controller = self._controller, None
        assert controller is not None, "an open driver has one"
        try:
            if not controller.is_beyond_reach:
                where = str(self.settings["port"])
                opening = Opening(controller.dialogue, self.clock, self._pause, where)
                opening.leave(homing=controller.is_homing)
        finally:
            if self._port is not None:
                self._port.close()

    def _status(self) -> DeviceStatus:
        controller = self._opened
        unhomed = tuple(axis for axis in self.axes if axis not in controller.reports.known)
        return DeviceStatus(
            controller.state,
            fault=controller.fault,
            position_known=not unhomed,
            unhomed=unhomed,
            silent_s=controller.silent_s,
        )

    def _move_to(self, targets: dict[str, float], speeds: dict[str, float], permit: Permit) -> None:
        self._opened.move_to(targets, speeds, permit)

    def _stop(self) -> None:
        controller = self._controller
        if controller is not None:
            controller.stop()

    def _clear_fault(self, permit: Permit) -> None:
        if self._opened.braking:
            raise StateError(
                message(
                    "engine", "{name}: the axes are still braking; clear the fault when they rest"
                ).fill(name=self.name)
            )
        self._opened.clear_fault(permit)

    def _home(self, axes: tuple[str, ...], permit: Permit) -> None:
        single = self._controller_settings.homes_single_axes
        if not single and set(axes) != set(self.axes):
            raise LimitError(
                message(
                    "engine",
                    "{name}: this controller homes all axes together; home all {count}, or build "
                    "it with single-axis homing",
                ).fill(name=self.name, count=len(self.axes))
            )
        if not self._opened.ready:
            raise StateError(
                message("engine", "{name} is still handling a stop; try again").fill(name=self.name)
            )
        lines = deque([("$H", self.axes)])
        if single:
            lines = deque(("$H" + self._letters[self.axes.index(axis)], (axis,)) for axis in axes)
        self._opened.home(lines, permit)

    def _read(self) -> Samples:
        samples = self._opened.step(self.clock())
        self.stamp_error_s = self._opened.dialogue.stamp_error_s
        return samples

    @property
    def _opened(self) -> Controller:
        assert self._controller is not None, "the contract calls hooks of an open driver"
        return self._controller

    def _bounded(self, name: str, low: float, high: float) -> float:
        value = float(self.settings[name])
        if not low <= value <= high:
            raise SettingError(
                message("engine", "gcode: {name} = {value}: must be {low} to {high}").fill(
                    name=name, value=value, low=low, high=high
                )
            )
        return value

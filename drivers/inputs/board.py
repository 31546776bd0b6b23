"""The joystick at the machine's controller: potentiometers and buttons as an input device."""

import time
from collections.abc import Callable, Sequence

from rotemina.drivers.abilities import AnalogInputs
from rotemina.drivers.clock import Clock
from rotemina.drivers.driver import Driver
from rotemina.drivers.errors import StateError
from rotemina.drivers.inputs.device import (
    CONFIRM_S,
    InputDevice,
    InputIdentity,
    InputLostError,
    InputReading,
    InputSource,
)
from rotemina.drivers.samples import DeviceState
from rotemina.sim.errors import reason_of
from rotemina.sim.messages import marked, message

Told = tuple[tuple[float, ...], tuple[bool, ...]]


class BoardInputs(InputSource):
    """The source of the joystick at the controller, if the driver in use has one.

    The driver belongs to a worker that alone talks to the device. Nothing is asked of the device
    here: its driver's latest status and readings are looked at, as any thread may.

    Parameters
    ----------
    driver : callable
        Returns the driver in use now; the program exchanges it.
    clock : callable
        The host's time, s.
    """

    name = marked("engine", "Joystick of the controller")

    def __init__(
        self, driver: Callable[[], Driver | None], *, clock: Clock = time.monotonic
    ) -> None:
        super().__init__(clock=clock)
        self._driver = driver

    def devices(self) -> Sequence[InputIdentity]:
        """Return the device, if the driver in use has and reports it."""
        driver = self._driver()
        if not isinstance(driver, AnalogInputs):
            return ()
        try:
            _latest(driver)
        except InputLostError:
            return ()
        return (_identity(driver),)

    def open(self, identity: InputIdentity) -> "BoardJoystick":
        """Open it; see :class:`InputSource`."""
        driver = self._driver()
        if not isinstance(driver, AnalogInputs) or _identity(driver) != identity:
            raise InputLostError(
                message("engine", "{name} does not belong to the driver in use").fill(
                    name=identity.name
                )
            )
        return BoardJoystick(identity, driver, self._driver, self.clock)


class BoardJoystick(InputDevice):
    """Potentiometers and buttons, as long as the driver that they were opened on is in use.

    Parameters
    ----------
    identity : InputIdentity
    driver : AnalogInputs
        The driver that has them.
    in_use : callable
        Returns the driver in use now.
    clock : callable
        The host's time, s.
    """

    # The driver says at any moment whether its readings are still true.
    streams = True

    def __init__(
        self,
        identity: InputIdentity,
        driver: AnalogInputs,
        in_use: Callable[[], Driver | None],
        clock: Clock,
    ) -> None:
        self.identity = identity
        readings, buttons = _latest(driver)
        self.axes = tuple(f"Potentiometer {number}" for number in range(1, len(readings) + 1))
        self.buttons = tuple(f"Button {number}" for number in range(1, len(buttons) + 1))
        self._driver = driver
        self._in_use = in_use
        self._clock = clock
        self._told: Told | None = None
        self._told_s = 0.0
        self._is_open = True

    def read(self) -> tuple[InputReading, ...]:
        """Return a reading after a change, and every ``CONFIRM_S``; see :class:`InputDevice`."""
        if not self._is_open:
            raise StateError(
                message("engine", "{name} was closed; open it again").fill(name=self.identity.name)
            )
        if self._in_use() is not self._driver:
            raise InputLostError(
                message("engine", "{name}: another driver is in use now").fill(
                    name=self.identity.name
                )
            )
        readings, buttons = told = _latest(self._driver)
        if (len(readings), len(buttons)) != (len(self.axes), len(self.buttons)):
            raise InputLostError(
                message(
                    "engine",
                    "{name} now has {axes} axes and {buttons} buttons instead of "
                    "{axes_before} and {buttons_before}; open it again",
                ).fill(
                    name=self.identity.name,
                    axes=len(readings),
                    buttons=len(buttons),
                    axes_before=len(self.axes),
                    buttons_before=len(self.buttons),
                )
            )
        now_s = self._clock()
        if told == self._told and now_s - self._told_s < CONFIRM_S:
            return ()
        self._told, self._told_s = told, now_s
        axes = tuple(2.0 * reading - 1.0 for reading in readings)
        return (InputReading(now_s, axes, buttons),)

    def close(self) -> None:
        """Release it; see :class:`InputDevice`."""
        self._is_open = False


def _identity(driver: Driver) -> InputIdentity:
    return InputIdentity(f"board:{driver.name}", f"Joystick of {driver.name}", "board")


def _latest(driver: AnalogInputs) -> Told:
    """Return the latest readings of a sound driver; raise :class:`InputLostError` otherwise."""
    try:
        status = driver.status()
        readings, buttons = driver.analog_inputs()
    except Exception as error:  # its worker may be closing it at this very moment
        raise InputLostError(
            message("engine", "{name}: the joystick cannot be read: {error}").fill(
                name=driver.name, error=reason_of(error)
            )
        ) from error
    if status.state is DeviceState.CLOSED:
        raise InputLostError(
            message("engine", "{name} is not connected; connect it to use its joystick").fill(
                name=driver.name
            )
        )
    if status.state is DeviceState.FAULT:
        raise InputLostError(
            message(
                "engine", "{name}: the joystick is not trusted during a fault; clear the fault"
            ).fill(name=driver.name)
        )
    if status.silent_s > 0.0:
        raise InputLostError(
            message("engine", "{name} and its joystick have been silent for a while").fill(
                name=driver.name
            )
        )
    if not readings and not buttons:
        raise InputLostError(
            message("engine", "{name}: no joystick reports; check whether one is plugged in").fill(
                name=driver.name
            )
        )
    return readings, buttons

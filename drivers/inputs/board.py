"""The joystick wired to the machine's controller: potentiometers and buttons as an input device."""

import time
from collections.abc import Callable, Sequence

from rotemina.drivers.abilities import AnalogInputs
from rotemina.drivers.contract import Clock, DeviceState, Driver, InputLostError, StateError
from rotemina.drivers.inputs.device import (
    KEEPALIVE_PERIOD_S,
    InputDevice,
    InputIdentity,
    InputReading,
    InputSource,
)
from rotemina.sim.errors import describe_exception
from rotemina.sim.messages import marked

#: Readings of the potentiometers, 0 to 1, and whether each button is held.
JoystickState = tuple[tuple[float, ...], tuple[bool, ...]]


class BoardJoystickSource(InputSource):
    """Finds and opens the joystick wired to the machine's controller, if the driver has one.

    Only the driver's worker thread communicates with the controller. This class only reads the
    driver's latest status and readings, which any thread may do.

    Parameters
    ----------
    driver : callable
        Returns the driver in use, which may be replaced while the program runs.
    clock : callable
        Returns the host's time, s.
    """

    name = marked("engine", "Joystick of the controller")

    def __init__(
        self, driver: Callable[[], Driver | None], *, clock: Clock = time.monotonic
    ) -> None:
        super().__init__(clock=clock)
        self._get_driver = driver

    def devices(self) -> Sequence[InputIdentity]:
        """Return the joystick, if the driver in use has one and reports its readings."""
        driver = self._get_driver()
        if not isinstance(driver, AnalogInputs):
            return ()
        try:
            _read_joystick(driver)
        except InputLostError:
            return ()
        return (_make_identity(driver),)

    def open(self, identity: InputIdentity) -> "BoardJoystick":
        """Open the joystick; see :class:`InputSource`."""
        driver = self._get_driver()
        if not isinstance(driver, AnalogInputs) or _make_identity(driver) != identity:
            raise InputLostError("{name} does not belong to the driver in use", name=identity.name)
        return BoardJoystick(identity, driver, self._get_driver, self.clock)


class BoardJoystick(InputDevice):
    """The potentiometers and buttons of a driver. Reading fails once another driver is in use.

    Parameters
    ----------
    identity : InputIdentity
    driver : AnalogInputs
        The driver that has the joystick.
    get_driver_in_use : callable
        Returns the driver in use.
    clock : callable
        Returns the host's time, s.
    """

    # An unchanged state is reported in every period, and a silent driver ends the readings. So a
    # pause in the readings is a fault.
    streams = True

    def __init__(
        self,
        identity: InputIdentity,
        driver: AnalogInputs,
        get_driver_in_use: Callable[[], Driver | None],
        clock: Clock,
    ) -> None:
        self.identity = identity
        readings, buttons = _read_joystick(driver)
        self.axes = tuple(f"Potentiometer {number}" for number in range(1, len(readings) + 1))
        self.buttons = tuple(f"Button {number}" for number in range(1, len(buttons) + 1))
        self._driver = driver
        self._get_driver_in_use = get_driver_in_use
        self._clock = clock
        self._last_state: JoystickState | None = None
        self._last_reading_s = 0.0
        self._is_open = True

    def read(self) -> tuple[InputReading, ...]:
        """Return a reading if the state has changed, or if the latest reading is too old.

        An unchanged state is reported again after ``KEEPALIVE_PERIOD_S``; see :class:`InputDevice`.
        """
        if not self._is_open:
            raise StateError("{name} was closed; open it again", name=self.identity.name)
        if self._get_driver_in_use() is not self._driver:
            raise InputLostError("{name}: another driver is in use now", name=self.identity.name)
        readings, buttons = state = _read_joystick(self._driver)
        if (len(readings), len(buttons)) != (len(self.axes), len(self.buttons)):
            raise InputLostError(
                "{name} now has {axes} axes and {buttons} buttons instead of "
                "{axes_before} and {buttons_before}; open it again",
                name=self.identity.name,
                axes=len(readings),
                buttons=len(buttons),
                axes_before=len(self.axes),
                buttons_before=len(self.buttons),
            )
        now_s = self._clock()
        if state == self._last_state and now_s - self._last_reading_s < KEEPALIVE_PERIOD_S:
            return ()
        self._last_state, self._last_reading_s = state, now_s
        axes = tuple(2.0 * reading - 1.0 for reading in readings)
        return (InputReading(now_s, axes, buttons),)

    def close(self) -> None:
        """Release the joystick; see :class:`InputDevice`."""
        self._is_open = False


def _make_identity(driver: Driver) -> InputIdentity:
    return InputIdentity(
        key=f"board:{driver.name}", name=f"Joystick of {driver.name}", source="board"
    )


def _read_joystick(driver: AnalogInputs) -> JoystickState:
    """Return the driver's latest readings; raise :class:`InputLostError` if it has none."""
    try:
        status = driver.status()
        readings, buttons = driver.analog_inputs()
    # The worker may close the driver at the same time, which may raise any exception here.
    except Exception as error:
        raise InputLostError(
            "{name}: the joystick cannot be read: {error}",
            name=driver.name,
            error=describe_exception(error),
        ) from error
    if status.state is DeviceState.CLOSED:
        raise InputLostError(
            "{name} is not connected; connect it to use its joystick", name=driver.name
        )
    if status.state is DeviceState.FAULT:
        raise InputLostError(
            "{name}: the joystick is disabled during a fault; clear the fault", name=driver.name
        )
    # Above 0 only if the device has missed its time-out.
    if status.silent_s > 0.0:
        raise InputLostError(
            "{name} and its joystick do not respond; check the connection", name=driver.name
        )
    if not readings and not buttons:
        raise InputLostError(
            "{name}: no joystick responds; check that one is plugged in", name=driver.name
        )
    return readings, buttons

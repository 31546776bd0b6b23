"""Device requests without motion: parameters, display, faults, effects."""

from collections.abc import Sequence

from rotemina.app.motion.device_link import DeviceLink
from rotemina.app.motion.mailbox import ClearFault, SetEffects, able
from rotemina.drivers.abilities import Display, Parameterised
from rotemina.drivers.driver import Driver
from rotemina.drivers.gate import Permit, Purpose
from rotemina.drivers.model_abilities import EffectCarrier
from rotemina.sim.messages import message
from rotemina.sim.robot.model import AxisEffect

_NO_PARAMETERS = message("engine", "driver {name} stores no parameters")


class Service:
    """Requests other than motion; any that could permit motion pass the gate."""

    def __init__(self, link: DeviceLink) -> None:
        self._link = link

    def accept_parameters(self) -> None:
        """Move with the device's parameters as they are.

        Raises
        ------
        RefusedError
            If the device has none, or is not connected.
        """
        self._link.ask_able(
            Parameterised, _NO_PARAMETERS, lambda driver, _: driver.accept_parameters()
        )

    def write_parameters(self) -> None:
        """Write the robot file's parameters into the device.

        Raises
        ------
        RefusedError
            If the device has none, or is not connected.
        """
        self._link.ask_able(
            Parameterised,
            _NO_PARAMETERS,
            lambda driver, permit: driver.write_parameters(permit=permit),
            self._link.gate.permit(Purpose.SERVICE),
        )

    def show(self, row: int, text: str) -> None:
        """Show text on the device's display; does nothing without a display."""

        def action(driver: Driver, _: Permit) -> None:
            if isinstance(driver, Display):
                driver.show(row, text)

        if isinstance(self._link.driver, Display):
            self._link.ask(action)

    def clear_fault(self) -> None:
        """Acknowledge a device's fault; nothing happens without one.

        Raises
        ------
        RefusedError
            If the connection failed: reconnect instead.
        """
        permit = self._link.gate.permit(Purpose.SERVICE)
        self._link.refuse_unconnected()
        if self._link.worker.state.fault is not None:
            self._link.mailbox.post(ClearFault(), permit)
            self._link.note_accepted(permit.epoch)

    @property
    def effects(self) -> tuple[AxisEffect, ...] | None:
        """The effects on a simulated machine; None if the device has no effects."""
        driver = self._link.driver
        return driver.effects if isinstance(driver, EffectCarrier) else None

    def set_effects(self, effects: Sequence[AxisEffect]) -> None:
        """Put other effects on a simulated machine, also while it moves.

        Raises
        ------
        EffectError
            With axis, effect, parameter, value and bound.
        RefusedError
            If the device carries no effects, is not connected, or a queue is full.
        """
        permit = self._link.gate.permit(Purpose.SERVICE)
        real = message(
            "engine",
            "driver {name} is a real machine, whose effects cannot be changed; connect to the "
            "simulator",
        )
        able(self._link.driver, EffectCarrier, real).check_effects(effects)
        self._link.refuse_unconnected()
        self._link.mailbox.post(SetEffects(tuple(effects)), permit)

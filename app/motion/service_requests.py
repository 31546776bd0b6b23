"""What a session asks of a device that moves nothing: parameters, a display, faults, effects."""

from collections.abc import Sequence

from rotemina.app.motion.device_session import DeviceSession
from rotemina.app.motion.mailbox import ClearFault, RefusedError, SetEffects
from rotemina.app.motion.state import Connection
from rotemina.drivers.abilities import Display, Parameterised
from rotemina.drivers.driver import Driver
from rotemina.drivers.gate import Permit, Purpose
from rotemina.drivers.model_abilities import EffectCarrier
from rotemina.sim.robot.model import AxisEffect


class ServiceRequests(DeviceSession):
    """Requests about what a device is and shows; whatever could let it move passes the gate.

    Parameters are those of :class:`DeviceSession`.
    """

    def accept_parameters(self) -> None:
        """Move with the device's parameters as they are.

        Raises
        ------
        RefusedError
            If the device has none, or is not connected.
        """
        self._refuse_without_parameters()

        def accept(driver: Driver, _: Permit) -> None:
            assert isinstance(driver, Parameterised), "the session refuses on any other"
            driver.accept_parameters()

        self._ask(accept)

    def write_parameters(self) -> None:
        """Write the robot file's parameters into the device.

        Raises
        ------
        RefusedError
            If the device has none, or is not connected.
        """
        permit = self.permit(Purpose.SERVICE)
        self._refuse_without_parameters()

        def write(driver: Driver, permit: Permit) -> None:
            assert isinstance(driver, Parameterised), "the session refuses on any other"
            driver.write_parameters(permit=permit)

        self._ask(write, permit)

    def show(self, row: int, text: str) -> None:
        """Show text on the device's display; nothing happens where there is none."""

        def action(driver: Driver, _: Permit) -> None:
            if isinstance(driver, Display):
                driver.show(row, text)

        if isinstance(self.driver, Display):
            self._ask(action)

    def clear_fault(self) -> None:
        """Acknowledge a device's fault; nothing happens without one.

        Raises
        ------
        RefusedError
            If the connection failed: reconnect instead.
        """
        permit = self.permit(Purpose.SERVICE)
        state = self._worker.state
        if state.connection is not Connection.CONNECTED:
            raise RefusedError(state.locked or "not connected")
        if state.fault is not None:
            self._mailbox.post(ClearFault(), permit)

    @property
    def effects(self) -> tuple[AxisEffect, ...] | None:
        """The effects on a simulated machine; None where the device is none that carries any."""
        return self.driver.effects if isinstance(self.driver, EffectCarrier) else None

    def set_effects(self, effects: Sequence[AxisEffect]) -> None:
        """Put other effects on a simulated machine, also while it moves.

        Raises
        ------
        EffectError
            With axis, effect, parameter, value and bound.
        RefusedError
            If the device carries no effects, is not connected, or a queue is full.
        """
        permit = self.permit(Purpose.SERVICE)
        if not isinstance(self.driver, EffectCarrier):
            raise RefusedError(
                f"driver {self.driver.name!r} is a real machine: its effects are its own; "
                "connect to the simulator"
            )
        self.driver.check_effects(effects)
        if self._worker.state.connection is not Connection.CONNECTED:
            raise RefusedError(self._worker.state.locked or "not connected; connect first")
        self._mailbox.post(SetEffects(tuple(effects)), permit)

    def _refuse_without_parameters(self) -> None:
        if not isinstance(self.driver, Parameterised):
            raise RefusedError(f"driver {self.driver.name!r} keeps no parameters")

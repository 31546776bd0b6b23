"""Requests to a device that move no axis: parameters, display, faults, effects."""

from collections.abc import Sequence

from rotemina.app.motion.device import (
    ClearFaultCommand,
    DeviceLink,
    EffectsCommand,
    require_ability,
)
from rotemina.drivers.abilities import EffectCarrier, ParameterStore, TextDisplay
from rotemina.drivers.contract import Driver, Permit, PermitPurpose
from rotemina.sim.messages import message
from rotemina.sim.robot import AxisEffect

_NO_PARAMETERS = message("engine", "driver {name} stores no parameters")


class DeviceService:
    """Requests that move no axis; those that could make motion possible need a permit."""

    def __init__(self, link: DeviceLink) -> None:
        self._link = link

    def accept_parameters(self) -> None:
        """Use the device's parameters as they are, even if they differ from the robot file.

        Raises
        ------
        RequestRefusedError
            If the device stores no parameters, or is not connected.
        """
        self._link.queue_ability_call(
            ParameterStore, _NO_PARAMETERS, lambda driver, _: driver.accept_parameters()
        )

    def write_parameters(self) -> None:
        """Write the robot file's parameters into the device.

        Raises
        ------
        RequestRefusedError
            If the device stores no parameters, or is not connected.
        """
        self._link.queue_ability_call(
            ParameterStore,
            _NO_PARAMETERS,
            lambda driver, permit: driver.write_parameters(permit=permit),
            self._link.gate.permit(PermitPurpose.SERVICE),
        )

    def show_text(self, row: int, text: str) -> None:
        """Show text on the device's display; does nothing if the device has none."""

        def show(driver: Driver, _: Permit) -> None:
            if isinstance(driver, TextDisplay):
                driver.show(row, text)

        if isinstance(self._link.driver, TextDisplay):
            self._link.queue_driver_call(show)

    def clear_fault(self) -> None:
        """Acknowledge the device's fault; does nothing if there is none.

        Raises
        ------
        RequestRefusedError
            If the connection failed: reconnect instead.
        """
        permit = self._link.gate.permit(PermitPurpose.SERVICE)
        self._link.require_connection()
        if self._link.worker.state.fault is not None:
            self._link.mailbox.post(ClearFaultCommand(), permit)
            # The machine is going to be used again, so an earlier stop is no longer shown.
            self._link.record_accepted_epoch(permit.epoch)

    @property
    def effects(self) -> tuple[AxisEffect, ...] | None:
        """The effects on a simulated machine; None if the machine is real."""
        driver = self._link.driver
        return driver.effects if isinstance(driver, EffectCarrier) else None

    def set_effects(self, effects: Sequence[AxisEffect]) -> None:
        """Replace the effects of a simulated machine; this is possible while it moves.

        Raises
        ------
        EffectError
            If an effect is invalid. The message names axis, effect, parameter, value and bound.
        RequestRefusedError
            If the machine is real, the device is not connected, or the queue is full.
        """
        permit = self._link.gate.permit(PermitPurpose.SERVICE)
        refusal = message(
            "engine",
            "driver {name} is a real machine, whose effects cannot be changed; connect to the "
            "simulator",
        )
        require_ability(self._link.driver, EffectCarrier, refusal).check_effects(effects)
        self._link.require_connection()
        self._link.mailbox.post(EffectsCommand(tuple(effects)), permit)

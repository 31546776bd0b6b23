"""Abilities of devices that apply a model: effects, an inverse, a loop.

The rules are those of :class:`rotemina.drivers.driver.Driver`: final methods check, hooks do.
"""

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, final

from rotemina.drivers.driver import Driver, MachineKind
from rotemina.drivers.errors import LimitError, StateError
from rotemina.drivers.gate import Permit, Purpose
from rotemina.drivers.samples import DeviceState
from rotemina.sim.effects.attachment import Attached
from rotemina.sim.messages import message
from rotemina.sim.robot.model import AxisEffect

if TYPE_CHECKING:  # a board's commands need none of it
    from rotemina.sim.compensate.inverse import Exceedance
    from rotemina.sim.compensate.inverse_parameters import InverseModel
    from rotemina.sim.feedback.regulation import Regulation


class EffectCarrier(Driver, ABC):
    """A simulated device whose imperfections can be switched and tuned while it runs."""

    built_in_kind = MachineKind.SIMULATED

    @property
    @abstractmethod
    def effects(self) -> tuple[AxisEffect, ...]:
        """The effects in place, those that are switched off among them; any thread may ask."""

    @property
    def effects_text(self) -> str:
        """The effects that are on, as records and the library name them; "" for none."""
        return ", ".join(f"{one.axis} {one.id}" for one in self.effects if one.enabled)

    @final
    def check_effects(self, effects: Sequence[AxisEffect]) -> None:
        """Raise :class:`EffectError` if effects cannot sit on the axes of this robot."""
        for effect in effects:
            Attached.of(self.robot, effect)

    @final
    def set_effects(self, effects: Sequence[AxisEffect], *, permit: Permit | None = None) -> None:
        """Put effects in place of those before; the axes continue from where they are.

        Raises
        ------
        EffectError
            With axis, effect, parameter, value and bound; then nothing changes.
        StateError
            If the device is closed.
        """
        permit = self._permitted(permit, Purpose.SERVICE)
        self._require_open("change its effects")
        self.check_effects(effects)
        self._set_effects(tuple(effects), permit)

    @abstractmethod
    def _set_effects(self, effects: tuple[AxisEffect, ...], permit: Permit) -> None:
        """Put checked effects in place."""


class Compensator(Driver, ABC):
    """A device that sends set-points of an axis through an inverse of its hysteresis.

    Commands in its samples stay what was wanted; ``inputs`` show what was sent. It ends with
    :meth:`Driver.close` and a cleared fault.
    """

    @property
    @abstractmethod
    def compensated(self) -> "Mapping[str, Exceedance]":
        """The axes that are, and in what each has gone beyond since; any thread may ask."""

    @final
    def compensate(
        self, axis: str, model: "InverseModel | None", *, permit: Permit | None = None
    ) -> None:
        """Send an axis' set-points through an inverse, or, for None, as they are.

        The axis stays where it is: its command becomes what the inverse takes for its position,
        and with None what was sent to it last. It is moved within what the inverse saw.

        Raises
        ------
        LimitError
            If there is no such axis, the inverse is another's or does not reach where it stands.
        StateError
            If the device is closed, faulty or not at rest.
        """
        permit = self._permitted(permit)
        state = self._require_sound("change a compensation")
        if state is not DeviceState.IDLE:
            raise StateError(
                message(
                    "engine",
                    "{name}: cannot change a compensation while it is {state}; stop it or wait",
                ).fill(name=self.name, state=state)
            )
        if axis not in self.robot.axes:
            raise LimitError(
                message("engine", "{name}: no such axis {axis}; it has {axes}").fill(
                    name=self.name, axis=repr(axis), axes=", ".join(self.axes)
                )
            )
        if model is not None and model.axis != axis:
            raise LimitError(
                message("engine", "{name}: the inverse is for axis {axis}, not for {other}").fill(
                    name=self.name, axis=model.axis, other=axis
                )
            )
        self._compensate(axis, model, permit)

    @abstractmethod
    def _compensate(self, axis: str, model: "InverseModel | None", permit: Permit) -> None:
        """Change it; raise :class:`LimitError` where the inverse does not reach."""


class Regulator(Driver, ABC):
    """A device that closes a loop around an axis, from its own sensor to its actuator.

    Commands in its samples are where the axis shall be; ``inputs`` show what the loop asks for. It
    ends with :meth:`Driver.close` and a cleared fault; a stop halts the axis under its loop.
    """

    @property
    @abstractmethod
    def regulated(self) -> "Mapping[str, Regulation]":
        """The loops that are closed, by axis; any thread may ask."""

    @property
    @abstractmethod
    def regulation_limited(self) -> tuple[str, ...]:
        """The axes whose loop asks for more than a limit allows at present; any thread may ask."""

    @final
    def regulate(
        self, axis: str, regulation: "Regulation | None", *, permit: Permit | None = None
    ) -> None:
        """Close a loop around an axis, or, for None, open it.

        The axis stays where it is: its command becomes where the sensor says that it is, and with
        None what was sent to it last. A :class:`Regulation` was found stable when it was made.

        Raises
        ------
        LimitError
            If there is no such axis, the loop is another's or of another robot, or does not fit.
        StateError
            If the device is closed, faulty or not at rest.
        """
        permit = self._permitted(permit)
        state = self._require_sound("change a loop")
        if state is not DeviceState.IDLE:
            raise StateError(
                message(
                    "engine", "{name}: cannot change a loop while it is {state}; stop it or wait"
                ).fill(name=self.name, state=state)
            )
        if axis not in self.robot.axes:
            raise LimitError(
                message("engine", "{name}: no such axis {axis}; it has {axes}").fill(
                    name=self.name, axis=repr(axis), axes=", ".join(self.axes)
                )
            )
        if regulation is not None:
            if regulation.axis != axis:
                raise LimitError(
                    message("engine", "{name}: the loop is for axis {axis}, not for {other}").fill(
                        name=self.name, axis=regulation.axis, other=axis
                    )
                )
            if regulation.robot.axes[axis] != self.robot.axes[axis]:
                raise LimitError(
                    message(
                        "engine",
                        "{name}: axis {axis}: the loop was found stable on robot {robot_name} with "
                        "another such axis; check it on this one",
                    ).fill(name=self.name, axis=axis, robot_name=repr(regulation.robot.name))
                )
        self._regulate(axis, regulation, permit)

    @abstractmethod
    def _regulate(self, axis: str, regulation: "Regulation | None", permit: Permit) -> None:
        """Change it; raise :class:`LimitError` where it does not fit."""

"""Optional interfaces of drivers: simulated effects, hysteresis compensation, feedback loops.

As in :class:`rotemina.drivers.contract.Driver`, final methods check a request, and hooks execute
it.
"""

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, final

from rotemina.drivers.contract import (
    DeviceState,
    Driver,
    LimitError,
    MachineKind,
    Permit,
    PermitPurpose,
    StateError,
)
from rotemina.sim.arrays import FloatArray
from rotemina.sim.compatibility import FormerMember, serve_former_names
from rotemina.sim.effects import AttachedEffect
from rotemina.sim.robot import AxisEffect

# Without these imports at run time, the command-line tools of the boards start faster.
if TYPE_CHECKING:
    from rotemina.sim.compensate import InverseExceedance, InverseModel
    from rotemina.sim.feedback import AxisRegulation


class EffectCarrier(Driver, ABC):
    """A simulated device whose imperfections can be switched and adjusted while it runs."""

    built_in_kind = MachineKind.SIMULATED

    @property
    @abstractmethod
    def effects(self) -> tuple[AxisEffect, ...]:
        """The installed effects, including those that are switched off.

        May be read on any thread.
        """

    @property
    def effects_text(self) -> str:
        """The effects that are switched on, as records name them; empty if there are none."""
        return ", ".join(f"{effect.axis} {effect.id}" for effect in self.effects if effect.enabled)

    @final
    def check_effects(self, effects: Sequence[AxisEffect]) -> None:
        """Raise :class:`EffectError` if an effect does not fit the axes of this robot."""
        for effect in effects:
            AttachedEffect.of(self.robot, effect)

    @final
    def set_effects(self, effects: Sequence[AxisEffect], *, permit: Permit | None = None) -> None:
        """Replace all effects; the axes continue from their positions.

        Raises
        ------
        EffectError
            If an effect does not fit. In that case nothing changes. The message contains axis,
            effect, parameter, value and bound.
        StateError
            If the device is closed.
        """
        permit = self._require_permit(permit, PermitPurpose.SERVICE)
        self._require_open("change its effects")
        self.check_effects(effects)
        self._set_effects(tuple(effects), permit)

    @abstractmethod
    def _set_effects(self, effects: tuple[AxisEffect, ...], permit: Permit) -> None:
        """Replace all effects with these, which have been checked."""


class HysteresisCompensator(Driver, ABC):
    """A device that sends the set-points of an axis through an inverse of its hysteresis.

    In the samples of the device, commands are the positions that enter the inverse, and ``inputs``,
    which are those of the actuators, are its outputs. Closing the driver or clearing a fault
    switches the compensation off.
    """

    @property
    @abstractmethod
    def compensated_axes(self) -> "Mapping[str, InverseExceedance]":
        """The compensated axes, and how far each has exceeded the range of its inverse.

        May be read on any thread.
        """

    @final
    def compensate(
        self, axis: str, model: "InverseModel | None", *, permit: Permit | None = None
    ) -> None:
        """Send an axis' set-points through an inverse, or unchanged if ``model`` is None.

        The axis does not move. With an inverse, its command becomes the position that the model
        estimates for the present output. Without one, it becomes the value that was sent last. With
        an inverse, motion is limited to the range for which it was identified.

        Raises
        ------
        LimitError
            If there is no such axis, the inverse is for another axis, or the axis' position is out
            of the range of the inverse.
        StateError
            If the device is closed, has a fault, or is not at rest.
        """
        permit = self._require_permit(permit)
        state = self._require_operational("change a compensation")
        if state is not DeviceState.IDLE:
            raise StateError(
                "{name}: cannot change a compensation while it is {state}; stop it or wait",
                name=self.name,
                state=state,
            )
        if axis not in self.robot.axes:
            raise LimitError(
                "{name}: no such axis {axis}; it has {axes}",
                name=self.name,
                axis=repr(axis),
                axes=", ".join(self.axes),
            )
        if model is not None and model.axis != axis:
            raise LimitError(
                "{name}: the inverse is for axis {axis}, not for {other}",
                name=self.name,
                axis=model.axis,
                other=axis,
            )
        self._compensate(axis, model, permit)

    @abstractmethod
    def _compensate(self, axis: str, model: "InverseModel | None", permit: Permit) -> None:
        """Set the inverse; raise :class:`LimitError` if the axis' position is out of its range."""

    # Former names, which work for one more release.
    compensated = FormerMember("compensated_axes")


class AxisRegulator(Driver, ABC):
    """A device that closes a feedback loop from an axis' sensor to its actuator.

    In the samples of the device, commands are the set-points of the loop, and ``inputs``,
    which are those of the actuators, are its outputs. Closing the driver or clearing a fault opens
    all loops. A stop halts the axis with its loop closed.
    """

    @property
    @abstractmethod
    def closed_loops(self) -> "Mapping[str, AxisRegulation]":
        """The closed loops, by axis; may be read on any thread."""

    @property
    @abstractmethod
    def limited_axes(self) -> tuple[str, ...]:
        """The axes whose loop output is saturated now; may be read on any thread."""

    @final
    def regulate(
        self, axis: str, regulation: "AxisRegulation | None", *, permit: Permit | None = None
    ) -> None:
        """Close a loop around an axis, or open it if ``regulation`` is None.

        The axis does not move. Its command becomes the position that the sensor measures, or the
        value that was sent last if the loop is opened. An :class:`AxisRegulation` passed a
        stability check when it was created.

        Raises
        ------
        LimitError
            If there is no such axis, or the loop is for another axis or robot, or does not fit.
        StateError
            If the device is closed, has a fault, or is not at rest.
        """
        permit = self._require_permit(permit)
        state = self._require_operational("change a loop")
        if state is not DeviceState.IDLE:
            raise StateError(
                "{name}: cannot change a loop while it is {state}; stop it or wait",
                name=self.name,
                state=state,
            )
        if axis not in self.robot.axes:
            raise LimitError(
                "{name}: no such axis {axis}; it has {axes}",
                name=self.name,
                axis=repr(axis),
                axes=", ".join(self.axes),
            )
        if regulation is not None:
            if regulation.axis != axis:
                raise LimitError(
                    "{name}: the loop is for axis {axis}, not for {other}",
                    name=self.name,
                    axis=regulation.axis,
                    other=axis,
                )
            if regulation.robot.axes[axis] != self.robot.axes[axis]:
                raise LimitError(
                    "{name}: axis {axis}: the loop was checked for stability on robot "
                    "{robot_name}, whose axis is different; check it on this robot",
                    name=self.name,
                    axis=axis,
                    robot_name=repr(regulation.robot.name),
                )
        self._regulate(axis, regulation, permit)

    @abstractmethod
    def _regulate(self, axis: str, regulation: "AxisRegulation | None", permit: Permit) -> None:
        """Set the loop; raise :class:`LimitError` if it does not fit."""

    # Former names, which work for one more release.
    regulated = FormerMember("closed_loops")
    regulation_limited = FormerMember("limited_axes")


class TruePositions(Driver, ABC):
    """Driver of a simulated machine whose true positions can be read, for example to draw them."""

    # The tuple is replaced as a whole, so that another thread never reads a partial change.
    _true_positions: tuple[float, ...] = ()

    @property
    def true_positions(self) -> tuple[float, ...]:
        """Latest true positions of the axes, m or rad; for any thread, also after closing."""
        return self._true_positions

    def _set_true_positions(self, positions: FloatArray) -> None:
        self._true_positions = tuple(positions.tolist())


if not TYPE_CHECKING:
    __getattr__ = serve_former_names(
        __name__,
        Compensator="HysteresisCompensator",
        Regulator="AxisRegulator",
    )

"""The model used for predictions: the nominal one, or one corrected by a diagnosis.

Nothing that is sent to a machine depends on it, and nothing that protects the machine is loosened
by it.
"""

import hashlib
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from types import MappingProxyType
from typing import TYPE_CHECKING, Self

from rotemina.drivers.abilities import Parameterised
from rotemina.drivers.driver import Driver
from rotemina.sim.effects.attachment import Attached
from rotemina.sim.effects.formulation import Trait
from rotemina.sim.errors import InputError
from rotemina.sim.messages import marked, message
from rotemina.sim.records.record import Tap
from rotemina.sim.robot.model import AxisEffect, Robot
from rotemina.sim.robot.writing import robot_text

if TYPE_CHECKING:
    from rotemina.sim.gap.diagnosis import Diagnosis

_DIGITS = 8  # of a digest, that tell models apart
#: Of a record's metadata: faults and contacts while it was taken.
NOTED = "noted"
#: What may be a cell, a dish or a stop that was leant on when the model was learned.
CONTACT_LIKE = frozenset({"contact", "saturation", "stiffness_nonlinearity", "lost_steps"})
#: What no command foretells, beside effects that are random or locked to time.
_UNFORESEEN = frozenset({"lost_steps"})


class ModelError(InputError):
    """A model that cannot be used; the message gives reason and remedy."""


@dataclass(frozen=True, slots=True)
class Machine:
    """What a corrected model belongs to.

    Attributes
    ----------
    robot : str
        Digest of the robot file.
    driver : str
    boards : str
        Digest of the parameters that the boards have where they differ from the robot file, or
        empty.
    """

    robot: str
    driver: str
    boards: str = ""

    @classmethod
    def of(cls, driver: Driver) -> Self:
        """Return the machine behind a driver, as it is now."""
        boards = ""
        if isinstance(driver, Parameterised) and driver.differences:
            boards = _digest("\n".join(map(str, driver.differences)))
        return cls(fingerprint(driver.robot), driver.name, boards)

    def differs(self, other: "Machine") -> str | None:
        """Return in what another machine differs from this one, or None."""
        if self.robot != other.robot:
            return marked("engine", "the robot file has changed")
        if self.driver != other.driver:
            return message(
                "engine", "it was made for driver {driver}, but this is {other_driver}"
            ).fill(driver=repr(self.driver), other_driver=repr(other.driver))
        return (
            None
            if self.boards == other.boards
            else marked("engine", "the boards' parameters have changed")
        )


@dataclass(frozen=True, eq=False)
class ModelInUse:
    """An immutable model of one machine.

    Attributes
    ----------
    id : str
        Tells it from every other model; it stands in records, reports and events.
    nominal : Robot
        As the robot file describes it.
    effects : tuple of AxisEffect
        What a diagnosis added and commands foretell; none: the nominal model.
    offsets : mapping axis -> float
        Constants of the readings, m or rad.
    machine : Machine
    """

    id: str
    nominal: Robot
    machine: Machine
    effects: tuple[AxisEffect, ...] = ()
    offsets: Mapping[str, float] = field(default_factory=lambda: MappingProxyType({}))

    @classmethod
    def nominal_of(cls, driver: Driver) -> Self:
        """Return the model that a robot file describes."""
        machine = Machine.of(driver)
        return cls(f"nominal-{machine.robot[:_DIGITS]}", driver.robot, machine)

    @classmethod
    def corrected_by(
        cls, diagnosis: "Diagnosis", driver: Driver, beyond: Self | None = None
    ) -> Self:
        """Return the model of the connected machine with the effects of a diagnosis.

        Parameters
        ----------
        diagnosis : Diagnosis
        driver : Driver
        beyond : ModelInUse, optional
            The model in use, whose remainder may have been diagnosed: what is in it stays.

        Raises
        ------
        ModelError
            If the diagnosis is of another robot, or adds nothing that commands foretell.
        EffectError
            If an effect cannot be used.
        """
        machine, examined = Machine.of(driver), fingerprint(diagnosis.robot)
        before: tuple[AxisEffect, ...] = ()
        if beyond is not None and beyond.corrected and examined == fingerprint(beyond.robot):
            before = beyond.effects
        elif examined != machine.robot:
            raise ModelError(
                message(
                    "engine",
                    "the diagnosis belongs to an earlier state of the robot file {name}; the "
                    "one in use, {robot_name}, differs: choose the model in use, and "
                    "diagnose again",
                ).fill(name=repr(diagnosis.robot.name), robot_name=repr(driver.robot.name))
            )
        found = cls.found_by(diagnosis, machine)
        return replace(
            found,
            id=_corrected_id(machine, (*before, *found.effects), found.offsets),
            nominal=driver.robot,
            effects=(*before, *found.effects),
        )

    @classmethod
    def found_by(cls, diagnosis: "Diagnosis", machine: Machine | None = None) -> Self:
        """Return the model that a diagnosis leads to, for any machine.

        Raises
        ------
        ModelError
            If it adds nothing that commands foretell.
        EffectError
            If an effect cannot be used.
        """
        robot = diagnosis.robot
        machine = Machine(fingerprint(robot), "") if machine is None else machine
        found = tuple(effect for effect in diagnosis.fitted if effect.enabled)
        used = tuple(effect for effect in found if foreseen(robot, effect))
        if not used:
            raise ModelError(
                message(
                    "engine",
                    "the diagnosis found nothing that commands can predict: the nominal "
                    "model is as good",
                )
            )
        offsets = {
            name: offset.value
            for name, one in diagnosis.axes.items()
            if (offset := one.offsets.get(Tap.MEAS)) is not None
        }
        name = _corrected_id(machine, used, offsets)
        return cls(name, robot, machine, used, MappingProxyType(offsets))

    @property
    def corrected(self) -> bool:
        """Whether it is another than the nominal model."""
        return bool(self.effects)

    @cached_property
    def robot(self) -> Robot:
        """The model itself: the robot with all effects of the model."""
        return replace(self.nominal, effects=(*self.nominal.effects, *self.effects))

    @cached_property
    def without_contact(self) -> Robot:
        """The model without what may have been a contact: all that a penetration may go by."""
        kept = tuple(effect for effect in self.effects if effect.id not in CONTACT_LIKE)
        return replace(self.nominal, effects=(*self.nominal.effects, *kept))

    @property
    def contact_like(self) -> tuple[AxisEffect, ...]:
        """Its effects that may have been a contact."""
        return tuple(effect for effect in self.effects if effect.id in CONTACT_LIKE)


def foreseen(robot: Robot, effect: AxisEffect) -> bool:
    """Return whether commands predict an effect."""
    traits = Attached.of(robot, effect).formulation.traits
    by_chance = Trait.RANDOM in traits or Trait.LOCKED_TO_TIME in traits
    return effect.id not in _UNFORESEEN and not by_chance


def fingerprint(robot: Robot) -> str:
    """Return the digest of a robot file's contents."""
    return _digest(robot_text(robot))


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()


def _corrected_id(
    machine: Machine, effects: Sequence[AxisEffect], offsets: Mapping[str, float]
) -> str:
    said = json.dumps([[_plain(one) for one in effects], dict(offsets)], sort_keys=True)
    number = _digest(machine.robot + machine.driver + machine.boards + said)
    return f"corrected-{number[:_DIGITS]}"


def _plain(effect: AxisEffect) -> list[object]:
    parameters = dict(effect.parameters)
    return [effect.axis, effect.id, effect.formulation, effect.from_axis, parameters]

"""The model used for predictions: the nominal one, or one corrected by a diagnosis.

No command to a machine depends on this model, and no limit that protects the machine is loosened.
"""

import hashlib
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from types import MappingProxyType
from typing import TYPE_CHECKING, Self

from rotemina.app.errors import ModelError
from rotemina.drivers.abilities import ParameterStore
from rotemina.drivers.contract import Driver
from rotemina.sim.effects import AttachedEffect, EffectTrait
from rotemina.sim.messages import marked, message
from rotemina.sim.records import Tap
from rotemina.sim.robot import AxisEffect, Robot
from rotemina.sim.robot_files import format_robot

if TYPE_CHECKING:
    from rotemina.sim.gap.result import Diagnosis

# Number of digits of the digest in a model's id.
_ID_DIGIT_COUNT = 8
#: Metadata key under which a record lists the faults and contacts that occurred during it.
NOTED_KEY = "noted"
#: Effects that a diagnosis may report if the machine touched a cell, a dish or an end stop.
CONTACT_LIKE_EFFECTS = frozenset({"contact", "saturation", "stiffness_nonlinearity", "lost_steps"})
#: Effects that cannot be predicted from commands, in addition to random and time-locked effects.
_UNPREDICTABLE_EFFECTS = frozenset({"lost_steps"})


@dataclass(frozen=True, slots=True)
class MachineIdentity:
    """Identity of the machine that a corrected model belongs to.

    Attributes
    ----------
    robot : str
        Digest of the robot file.
    driver : str
        Name of the driver.
    boards : str
        Digest of the boards' parameters that differ from the robot file, or empty.
    """

    robot: str
    driver: str
    boards: str = ""

    @classmethod
    def of(cls, driver: Driver) -> Self:
        """Return the identity of the machine behind a driver, as it is now."""
        boards = ""
        if isinstance(driver, ParameterStore) and driver.differences:
            boards = _compute_digest("\n".join(map(str, driver.differences)))
        return cls(compute_fingerprint(driver.robot), driver.name, boards)

    def find_difference(self, other: "MachineIdentity") -> str | None:
        """Return a text on how another machine differs from this one, or None if it does not."""
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
        Unique id of the model, used in records, reports and events.
    nominal : Robot
        The robot as its file describes it.
    machine : MachineIdentity
    effects : tuple of AxisEffect
        Effects that a diagnosis has added and commands can predict; empty for the nominal model.
    offsets : mapping axis -> float
        Constant offsets of the readings, m or rad.
    """

    id: str
    nominal: Robot
    machine: MachineIdentity
    effects: tuple[AxisEffect, ...] = ()
    offsets: Mapping[str, float] = field(default_factory=lambda: MappingProxyType({}))

    @classmethod
    def make_nominal(cls, driver: Driver) -> Self:
        """Return the model that a robot file describes."""
        machine = MachineIdentity.of(driver)
        return cls(f"nominal-{machine.robot[:_ID_DIGIT_COUNT]}", driver.robot, machine)

    @classmethod
    def make_corrected(
        cls, diagnosis: "Diagnosis", driver: Driver, model_in_use: Self | None = None
    ) -> Self:
        """Return the model of the connected machine with the effects of a diagnosis.

        Parameters
        ----------
        diagnosis : Diagnosis
        driver : Driver
        model_in_use : ModelInUse, optional
            The model in use. Its effects are kept if the diagnosis examined the gap that it leaves.

        Raises
        ------
        ModelError
            If the diagnosis belongs to another robot, or found no effect that commands can predict.
        EffectError
            If an effect cannot be used.
        """
        machine, diagnosed_robot = MachineIdentity.of(driver), compute_fingerprint(diagnosis.robot)
        kept_effects: tuple[AxisEffect, ...] = ()
        if (
            model_in_use is not None
            and model_in_use.is_corrected
            and diagnosed_robot == compute_fingerprint(model_in_use.robot)
        ):
            kept_effects = model_in_use.effects
        elif diagnosed_robot != machine.robot:
            raise ModelError(
                "the diagnosis belongs to an earlier state of the robot file {name}; the "
                "one in use, {robot_name}, differs: choose the model in use, and "
                "diagnose again",
                name=repr(diagnosis.robot.name),
                robot_name=repr(driver.robot.name),
            )
        model = cls.from_diagnosis(diagnosis, machine)
        return replace(
            model,
            id=_make_corrected_id(machine, (*kept_effects, *model.effects), model.offsets),
            nominal=driver.robot,
            effects=(*kept_effects, *model.effects),
        )

    @classmethod
    def from_diagnosis(cls, diagnosis: "Diagnosis", machine: MachineIdentity | None = None) -> Self:
        """Return the model that results from a diagnosis, for any machine.

        Raises
        ------
        ModelError
            If the diagnosis found no effect that commands can predict.
        EffectError
            If an effect cannot be used.
        """
        robot = diagnosis.robot
        machine = MachineIdentity(compute_fingerprint(robot), "") if machine is None else machine
        enabled_effects = tuple(effect for effect in diagnosis.fitted if effect.enabled)
        predictable_effects = tuple(
            effect for effect in enabled_effects if is_predictable(robot, effect)
        )
        if not predictable_effects:
            raise ModelError(
                "the diagnosis found nothing that commands can predict: the nominal "
                "model is as good"
            )
        offsets = {
            name: offset.value
            for name, result in diagnosis.axes.items()
            if (offset := result.offsets.get(Tap.MEAS)) is not None
        }
        name = _make_corrected_id(machine, predictable_effects, offsets)
        return cls(name, robot, machine, predictable_effects, MappingProxyType(offsets))

    @property
    def is_corrected(self) -> bool:
        """Whether the model differs from the nominal model."""
        return bool(self.effects)

    @cached_property
    def robot(self) -> Robot:
        """The robot with all effects of the model."""
        return replace(self.nominal, effects=(*self.nominal.effects, *self.effects))

    def predicts_like(self, other: "ModelInUse") -> bool:
        """Whether another model makes the same predictions, also if it has another id."""
        return self.offsets == other.offsets and all(
            compute_fingerprint(mine) == compute_fingerprint(others)
            for mine, others in ((self.nominal, other.nominal), (self.robot, other.robot))
        )

    @cached_property
    def without_contact(self) -> Robot:
        """The robot without effects that a contact may have caused, for use in penetrations."""
        effects = tuple(effect for effect in self.effects if effect.id not in CONTACT_LIKE_EFFECTS)
        return replace(self.nominal, effects=(*self.nominal.effects, *effects))

    @property
    def contact_like_effects(self) -> tuple[AxisEffect, ...]:
        """The effects of the model that a contact may have caused."""
        return tuple(effect for effect in self.effects if effect.id in CONTACT_LIKE_EFFECTS)


def is_predictable(robot: Robot, effect: AxisEffect) -> bool:
    """Return whether an effect can be predicted from commands."""
    traits = AttachedEffect.of(robot, effect).formulation.traits
    is_random = EffectTrait.RANDOM in traits or EffectTrait.LOCKED_TO_TIME in traits
    return effect.id not in _UNPREDICTABLE_EFFECTS and not is_random


def compute_fingerprint(robot: Robot) -> str:
    """Return the digest of a robot file's contents."""
    return _compute_digest(format_robot(robot))


def _compute_digest(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()


def _make_corrected_id(
    machine: MachineIdentity, effects: Sequence[AxisEffect], offsets: Mapping[str, float]
) -> str:
    text = json.dumps([[_to_json(effect) for effect in effects], dict(offsets)], sort_keys=True)
    digest = _compute_digest(machine.robot + machine.driver + machine.boards + text)
    return f"corrected-{digest[:_ID_DIGIT_COUNT]}"


def _to_json(effect: AxisEffect) -> list[object]:
    parameters = dict(effect.parameters)
    return [effect.axis, effect.id, effect.formulation, effect.from_axis, parameters]

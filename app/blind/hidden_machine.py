"""A simulator whose plant has hidden effects, computed by the equations of the blind generator."""

from collections.abc import Collection
from dataclasses import dataclass
from typing import Any, cast

import numpy as np

from rotemina.app.blind.stepped_machine import STEPPED_EFFECTS, SteppedPlant, can_step_case
from rotemina.app.errors import HiddenMachineError
from rotemina.drivers.contract import Permit, StateError
from rotemina.drivers.simulator import SimulatedDevice, Simulator
from rotemina.sim.arrays import FloatArray
from rotemina.sim.blind import BlindCase, draw_case
from rotemina.sim.plant import Plant, PlantState
from rotemina.sim.robot import AxisEffect, Robot

_HEALTHY_PROBABILITY = 0.2
# Probability that a machine with effects has two.
_TWO_EFFECTS_PROBABILITY = 0.3
# Smallest effect that is drawn, in multiples of the noise floor. Users could hardly find a smaller
# one.
_MIN_EFFECT_IN_FLOORS = 10.0

#: Axis and effect.
HiddenCause = tuple[str, str]


@dataclass(frozen=True, slots=True, eq=False)
class HiddenEffects:
    """The effects of a hidden machine; ``case`` is None if the machine is healthy."""

    seed: int
    case: BlindCase | None

    @property
    def causes(self) -> frozenset[HiddenCause]:
        """Axis and effect of each cause."""
        if self.case is None:
            return frozenset()
        return frozenset(
            (effect["axis"], effect["effect"]) for effect in self.case.label()["effects"]
        )


def draw_hidden_effects(robot: Robot, seed: int) -> HiddenEffects:
    """Draw one or two effects, or sometimes none; this takes a second or more.

    Raises
    ------
    HiddenMachineError
        If the robot has no stages.
    """
    rng = np.random.default_rng(seed)
    if not robot.stages:
        raise HiddenMachineError(
            f"robot {robot.name!r} has no stages; a hidden machine needs a robot with stages, "
            "such as rotemina"
        )
    if rng.uniform() < _HEALTHY_PROBABILITY:
        return HiddenEffects(seed, None)
    kind = "double" if rng.uniform() < _TWO_EFFECTS_PROBABILITY else "single"
    while True:
        case = draw_case(robot, kind, int(rng.integers(1 << 30)), str(rng.choice(STEPPED_EFFECTS)))
        effects: list[dict[str, Any]] = case.label()["effects"]
        if can_step_case(case) and all(
            effect["floors"] >= _MIN_EFFECT_IN_FLOORS for effect in effects
        ):
            return HiddenEffects(seed, case)


class HiddenMachineSimulator(Simulator):
    """A simulator with a hidden plant, whose effects its interface does not reveal."""

    name = "hidden machine"

    def __init__(self, robot: Robot, hidden_effects: HiddenEffects, **options: Any) -> None:
        super().__init__(robot, **options)
        self._hidden_effects = hidden_effects

    @property
    def effects(self) -> tuple[AxisEffect, ...]:
        """An empty tuple, because the effects are hidden."""
        return ()

    @property
    def effects_text(self) -> str:
        """What records say about the effects."""
        return "hidden"

    def _set_effects(self, effects: tuple[AxisEffect, ...], permit: Permit) -> None:
        raise StateError("the effects of a hidden machine cannot be changed; reveal it first")

    def _make_device(self, position: FloatArray, time_s: float) -> SimulatedDevice:
        device = super()._make_device(position, time_s)
        plant = SteppedPlant(self.robot, self._hidden_effects.case)
        state = plant.find_rest_state(0.0, position)
        # SteppedPlant has all methods of Plant that the device calls.
        device.set_plant(cast("Plant", plant), cast("PlantState", state))
        return device


def is_diagnosis_right(hidden_effects: HiddenEffects, named: Collection[HiddenCause]) -> bool:
    """Whether a diagnosis names exactly the effects of the machine."""
    return hidden_effects.causes == frozenset(named)

"""A hidden machine: the blind generator's equations behind the simulator's contract."""

from collections.abc import Collection
from dataclasses import dataclass
from typing import Any, cast

import numpy as np

from rotemina.app.blind.stepped_machine import STEPPED, SteppedPlant, can_go_on
from rotemina.drivers.errors import StateError
from rotemina.drivers.gate import Permit
from rotemina.drivers.simulator.device import SimulatedDevice
from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim.arrays import FloatArray
from rotemina.sim.blind.case import Case, draw_case
from rotemina.sim.errors import InputError
from rotemina.sim.plant.plant import Plant
from rotemina.sim.plant.state import PlantState
from rotemina.sim.robot.model import AxisEffect, Robot

_HEALTHY = 0.2  # of all hidden machines have nothing
_TWO = 0.3  # of those with something have two effects
_LEAST_FLOORS = 10.0  # of an effect, below which it is no fair question

Cause = tuple[str, str]  # axis and effect


class HiddenMachineError(InputError):
    """A robot of which no hidden machine can be made."""


@dataclass(frozen=True, slots=True, eq=False)
class Secret:
    """The effects of a hidden machine; ``case`` is None if it has none."""

    seed: int
    case: Case | None

    @property
    def causes(self) -> frozenset[Cause]:
        """Axis and effect of each."""
        if self.case is None:
            return frozenset()
        return frozenset((one["axis"], one["effect"]) for one in self.case.label()["effects"])


def draw_secret(robot: Robot, seed: int) -> Secret:
    """Draw one or two effects, sometimes none; takes a second or more.

    Raises
    ------
    HiddenMachineError
        If the generator knows no such robot.
    """
    rng = np.random.default_rng(seed)
    if not robot.stages:
        raise HiddenMachineError(
            f"robot {robot.name!r} has no stages: a hidden machine is made of a RoTeMiNa"
        )
    if rng.uniform() < _HEALTHY:
        return Secret(seed, None)
    kind = "double" if rng.uniform() < _TWO else "single"
    while True:
        case = draw_case(robot, kind, int(rng.integers(1 << 30)), str(rng.choice(STEPPED)))
        told: list[dict[str, Any]] = case.label()["effects"]
        if can_go_on(case) and all(one["floors"] >= _LEAST_FLOORS for one in told):
            return Secret(seed, case)


class HiddenMachine(Simulator):
    """The simulator with a hidden plant; nothing reveals its effects."""

    name = "hidden machine"

    def __init__(self, robot: Robot, secret: Secret, **options: Any) -> None:
        super().__init__(robot, **options)
        self._secret = secret

    @property
    def effects(self) -> tuple[AxisEffect, ...]:
        """None: the effects are hidden."""
        return ()

    @property
    def effects_text(self) -> str:
        """The text about effects in records."""
        return "hidden"

    def _set_effects(self, effects: tuple[AxisEffect, ...], permit: Permit) -> None:
        raise StateError("the machine is hidden, and stays as it is: reveal it first")

    def _made(self, position: FloatArray, time_s: float) -> SimulatedDevice:
        device = super()._made(position, time_s)
        plant = SteppedPlant(self.robot, self._secret.case)
        state = plant.at_rest(0.0, position)
        # It answers to all that a device asks of a plant.
        device.use(cast("Plant", plant), cast("PlantState", state))
        return device


def is_right(secret: Secret, named: Collection[Cause]) -> bool:
    """Whether a diagnosis names all effects of the machine and no others."""
    return secret.causes == frozenset(named)

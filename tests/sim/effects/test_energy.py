"""Passive effects never feed energy in: free decays from random starts, potentials counted."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.effects.friction import SPRINGS
from rotemina.sim.plant.plant import Plant
from rotemina.sim.robot.file import parse_robot
from rotemina.sim.robot.model import AxisEffect

MASS, RATE = 2.0, 2 * np.pi * 10.0
STIFFNESS = MASS * RATE**2
SMALL = 1e-3  # m: a few times what the friction used here yields
WIDE = 0.3


def plant_with(kind, effect):
    """One undamped axis of 10 Hz, held at 0.5 by its input."""
    gain = "gain = 0.1\n" if kind == "piezo" else ""
    robot = parse_robot(
        f"[robot]\nname='one'\naxes=['a']\n[axis.a]\nkind='{kind}'\nunit='m'\nrange=[0.0, 1.0]\n"
        f"{gain}mass={MASS}\ndamping=0.0\nstiffness={STIFFNESS}\n"
    )
    return Plant.of(replace(robot, effects=(effect,)))


def nothing(_numbers, q, _v, _hidden):
    return np.zeros_like(q)


def bristles(numbers, _q, _v, hidden):
    return 0.5 * numbers[0] * hidden[:, 2] ** 2


def flexure(numbers, q, _v, _hidden):
    return numbers[0] * (q - numbers[1]) ** 4 / 4


def sharper(numbers, q, _v, _hidden):
    bent = q - numbers[1]
    return numbers[0] * bent**4 / 4 + numbers[2] * bent**6 / 6


def spring(numbers, q, _v, _hidden):
    side, place, stiffness, _ = numbers
    return 0.5 * stiffness * np.maximum(side * (q - place), 0.0) ** 2


def progressive(numbers, q, _v, _hidden):
    side, place, stiffness, _, power, depth = numbers
    bent = np.maximum(side * (q - place), 0.0) / depth
    return stiffness * depth**2 * bent ** (power + 1) / (power + 1)


def slipping(numbers, _q, _v, hidden):
    return 0.5 * (hidden[:, 2 : 2 + SPRINGS] ** 2 @ np.array(numbers[3 : 3 + SPRINGS]))


def hung_mass(_numbers, q, _v, hidden):
    mass, rate = 0.3 * MASS, 2 * np.pi * 17.0
    return 0.5 * mass * (hidden[:, 3] ** 2 + rate**2 * (q - hidden[:, 2]) ** 2)


DRY = {"coulomb_forward": 0.6, "coulomb_backward": 0.3}
PASSIVE = {
    "coulomb": ("stepper", "friction", "stribeck", DRY, SMALL, nothing),
    "stribeck": (
        "stepper",
        "friction",
        "stribeck",
        {**DRY, "static_ratio": 2.0, "stribeck_speed": 2e-3, "viscous_backward": 5.0},
        SMALL,
        nothing,
    ),
    "lugre": (
        "stepper",
        "friction",
        "lugre",
        {"coulomb": 0.6, "deflection": 1e-4, "static_ratio": 2.0, "stribeck_speed": 2e-3},
        SMALL,
        bristles,
    ),
    "stiff lugre": (
        "stepper",
        "friction",
        "lugre",
        {"coulomb": 0.6, "deflection": 1e-6, "static_ratio": 3.0, "bristle_damping": 2.0},
        SMALL,
        bristles,
    ),
    "springs": (
        "stepper",
        "friction",
        "springs",
        {"coulomb": 0.6, "backward": 0.5, "deflection": 1e-4, "shape": 1.5, "viscous": 5.0},
        SMALL,
        slipping,
    ),
    "spring": (
        "piezo",
        "contact",
        "spring",
        {"place": 0.6, "stiffness": 2.0, "damping_ratio": 0.2},
        WIDE,
        spring,
    ),
    "stiff spring below": (
        "piezo",
        "contact",
        "spring",
        {"place": 0.4, "stiffness": -30.0, "damping_ratio": 0.2},
        WIDE,
        spring,
    ),
    "progressive": (
        "piezo",
        "contact",
        "progressive",
        {"place": 0.6, "stiffness": 10.0, "damping_ratio": 0.2, "exponent": 2.0},
        WIDE,
        progressive,
    ),
    "appendage": (
        "stepper",
        "flexible_mode",
        "appendage",
        {"frequency": 17.0, "mass_ratio": 0.3, "damping_ratio": 1e-3},
        WIDE,
        hung_mass,
    ),
}
CONSERVED = {
    "flexure": ("piezo", "stiffness_nonlinearity", "cubic", {"hardening": 0.5}, WIDE, flexure),
    "sharper flexure": (
        "piezo",
        "stiffness_nonlinearity",
        "cubic_quintic",
        {"hardening": 0.2, "quintic": 0.3},
        WIDE,
        sharper,
    ),
    "undamped spring": (
        "piezo",
        "contact",
        "spring",
        {"place": 0.6, "stiffness": 5.0, "damping_ratio": 0.0},
        WIDE,
        spring,
    ),
    "undamped membrane": (
        "piezo",
        "contact",
        "progressive",
        {"place": 0.6, "stiffness": 5.0, "damping_ratio": 0.0, "exponent": 3.0},
        WIDE,
        progressive,
    ),
}


def energies(case, seed, periods=10, finer=1):
    """Return the energy over that at first, at each step of the plant, from a random start."""
    kind, effect_id, formulation, parameters, size, potential = case
    plant = plant_with(
        kind, AxisEffect(axis="a", id=effect_id, formulation=formulation, parameters=parameters)
    )
    step_s = min(plant.assembly.inner_step_s, 1.0 / 600.0) / finer
    held = np.array([0.5])
    inputs = plant.open_loop_inputs(held[None])[0]
    start = np.random.default_rng(seed).uniform(-1, 1, 2) * size
    state = plant.at(0.0, inputs, held + start[0], start[1:] * RATE)
    time_s = np.arange(int(periods * 0.1 / step_s)) * step_s
    if potential in (bristles, slipping, hung_mass):
        hidden = np.array(list(followed(plant, state, time_s)))
        q, v = hidden[:, 0], hidden[:, 1]
    else:
        motion, _ = plant.advance(state, time_s, np.full((len(time_s), 1), 0.5))
        q, v, hidden = motion.position[:, 0], motion.velocity[:, 0], None
    energy = 0.5 * MASS * v**2 + 0.5 * STIFFNESS * (q - 0.5) ** 2
    energy += potential(plant.assembly.machine.numbers[:-1], q, v, hidden)
    return energy / energy[0]


def followed(plant, state, time_s):
    """Step by step, yield states and memory together."""
    for next_s in time_s + time_s[1]:
        yield [*state.x, *state.memory]
        _, state = plant.advance(state, np.array([next_s]), np.array([[0.5]]))


@pytest.mark.parametrize("case", PASSIVE.values(), ids=PASSIVE)
def test_energy_of_a_passive_plant_never_grows(case):
    """But for the one step in which a held force sees a reversal, of the order of its square."""
    for seed in range(seeds(case, 20)):
        energy = energies(case, seed)
        assert (energy - np.minimum.accumulate(energy)).max() < 4e-3
        assert energy[60:].max() < 1 + 1e-12


@pytest.mark.slow
@pytest.mark.parametrize("case", PASSIVE.values(), ids=PASSIVE)
def test_what_grows_within_a_step_vanishes_with_the_step(case):
    growth = [
        max(
            np.diff(energies(case, seed, periods=3, finer=finer)).max()
            for seed in range(seeds(case, 20))
        )
        for finer in (1, 8)
    ]
    assert growth[1] < max(growth[0] / 8.0, 1e-7)


def seeds(case, usual):
    """Return how many random starts to try: fewer where it goes step by step."""
    return usual if case[-1] not in (bristles, hung_mass) else usual // 5


@pytest.mark.parametrize("case", CONSERVED.values(), ids=CONSERVED)
def test_an_elastic_effect_conserves_energy_to_second_order(case):
    wander = [
        max(np.ptp(energies(case, seed, finer=finer)) for seed in range(20)) for finer in (1, 4)
    ]
    assert wander[0] < 2e-2
    assert wander[1] < wander[0] / 8.0


@pytest.mark.parametrize("name", ["coulomb", "lugre", "stribeck"])
def test_friction_brings_an_undamped_axis_to_rest(name):
    energy = energies(PASSIVE[name], 1, periods=20)
    assert energy[-1] < 0.02

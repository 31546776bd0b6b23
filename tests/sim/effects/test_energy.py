"""Passive effects never add energy: free decays from random starts, including potentials."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.effects.friction import SPRING_COUNT
from rotemina.sim.plant import Plant
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import parse_robot

MASS, RATE = 2.0, 2 * np.pi * 10.0
STIFFNESS = MASS * RATE**2
SMALL = 1e-3  # m, a few times the deflection by the friction used here
WIDE = 0.3


def build_plant(kind, effect):
    """Return the plant of one undamped axis of 10 Hz, held at 0.5 by its input."""
    gain = "gain = 0.1\n" if kind == "piezo" else ""
    robot = parse_robot(
        f"[robot]\nname='one'\naxes=['a']\n[axis.a]\nkind='{kind}'\nunit='m'\nrange=[0.0, 1.0]\n"
        f"{gain}mass={MASS}\ndamping=0.0\nstiffness={STIFFNESS}\n"
    )
    return Plant.of(replace(robot, effects=(effect,)))


def no_potential(_numbers, q, _v, _hidden):
    return np.zeros_like(q)


def bristle_potential(numbers, _q, _v, hidden):
    return 0.5 * numbers[0] * hidden[:, 2] ** 2


def cubic_potential(numbers, q, _v, _hidden):
    return numbers[0] * (q - numbers[1]) ** 4 / 4


def quintic_potential(numbers, q, _v, _hidden):
    deflection = q - numbers[1]
    return numbers[0] * deflection**4 / 4 + numbers[2] * deflection**6 / 6


def spring_potential(numbers, q, _v, _hidden):
    side, place, stiffness, _ = numbers
    return 0.5 * stiffness * np.maximum(side * (q - place), 0.0) ** 2


def progressive_potential(numbers, q, _v, _hidden):
    side, place, stiffness, _, power, depth = numbers
    depth_ratio = np.maximum(side * (q - place), 0.0) / depth
    return stiffness * depth**2 * depth_ratio ** (power + 1) / (power + 1)


def slip_spring_potential(numbers, _q, _v, hidden):
    return 0.5 * (hidden[:, 2 : 2 + SPRING_COUNT] ** 2 @ np.array(numbers[3 : 3 + SPRING_COUNT]))


def appendage_potential(_numbers, q, _v, hidden):
    mass, rate = 0.3 * MASS, 2 * np.pi * 17.0
    return 0.5 * mass * (hidden[:, 3] ** 2 + rate**2 * (q - hidden[:, 2]) ** 2)


DRY = {"coulomb_forward": 0.6, "coulomb_backward": 0.3}
FADING = {"static_ratio": 2.0, "stribeck_speed": 2e-3}
LUGRE = {"coulomb": 0.6, "deflection": 1e-4, **FADING}
STIFF = {"coulomb": 0.6, "deflection": 1e-6, "static_ratio": 3.0, "bristle_damping": 2.0}
SLIPPING = {"coulomb": 0.6, "backward": 0.5, "deflection": 1e-4, "shape": 1.5, "viscous": 5.0}
ABOVE = {"place": 0.6, "damping_ratio": 0.2}
BELOW = {"place": 0.4, "damping_ratio": 0.2, "stiffness": -30.0}
ELASTIC = {"place": 0.6, "damping_ratio": 0.0, "stiffness": 5.0}
APPENDAGE = {"frequency": 17.0, "mass_ratio": 0.3, "damping_ratio": 1e-3}
SHARP = {"hardening": 0.2, "quintic": 0.3}
# Kind of axis, effect and formulation; parameters, size of the start, potential of the effect.
PASSIVE = {
    "coulomb": ("stepper friction stribeck", DRY, SMALL, no_potential),
    "stribeck": (
        "stepper friction stribeck",
        {**DRY, **FADING, "viscous_backward": 5.0},
        SMALL,
        no_potential,
    ),
    "lugre": ("stepper friction lugre", LUGRE, SMALL, bristle_potential),
    "stiff lugre": ("stepper friction lugre", STIFF, SMALL, bristle_potential),
    "springs": ("stepper friction springs", SLIPPING, SMALL, slip_spring_potential),
    "spring": ("piezo contact spring", {**ABOVE, "stiffness": 2.0}, WIDE, spring_potential),
    "stiff spring below": ("piezo contact spring", BELOW, WIDE, spring_potential),
    "progressive": (
        "piezo contact progressive",
        {**ABOVE, "stiffness": 10.0, "exponent": 2.0},
        WIDE,
        progressive_potential,
    ),
    "appendage": ("stepper flexible_mode appendage", APPENDAGE, WIDE, appendage_potential),
}
CONSERVED = {
    "flexure": ("piezo stiffness_nonlinearity cubic", {"hardening": 0.5}, WIDE, cubic_potential),
    "sharper flexure": (
        "piezo stiffness_nonlinearity cubic_quintic",
        SHARP,
        WIDE,
        quintic_potential,
    ),
    "undamped spring": ("piezo contact spring", ELASTIC, WIDE, spring_potential),
    "undamped membrane": (
        "piezo contact progressive",
        {**ELASTIC, "exponent": 3.0},
        WIDE,
        progressive_potential,
    ),
}


def simulate_energy(case, seed, periods=10, refinement=1):
    """Return the ratio of the energy to its initial value at each step, from a random start."""
    names, parameters, size, potential = case
    kind, effect_id, formulation = names.split()
    plant = build_plant(
        kind, AxisEffect(axis="a", id=effect_id, formulation=formulation, parameters=parameters)
    )
    step_s = min(plant.assembly.inner_step_s, 1.0 / 600.0) / refinement
    held = np.array([0.5])
    inputs = plant.compute_open_loop_inputs(held[None])[0]
    start = np.random.default_rng(seed).uniform(-1, 1, 2) * size
    state = plant.make_state(0.0, inputs, held + start[0], start[1:] * RATE)
    time_s = np.arange(int(periods * 0.1 / step_s)) * step_s
    if potential in (bristle_potential, slip_spring_potential, appendage_potential):
        hidden = np.array(list(iterate_states(plant, state, time_s)))
        q, v = hidden[:, 0], hidden[:, 1]
    else:
        motion, _ = plant.advance(state, time_s, np.full((len(time_s), 1), 0.5))
        q, v, hidden = motion.position[:, 0], motion.velocity[:, 0], None
    energy = 0.5 * MASS * v**2 + 0.5 * STIFFNESS * (q - 0.5) ** 2
    energy += potential(plant.assembly.tables.numbers[:-1], q, v, hidden)
    return energy / energy[0]


def iterate_states(plant, state, time_s):
    """Yield states and memory together, step by step."""
    for next_s in time_s + time_s[1]:
        yield [*state.x, *state.memory]
        _, state = plant.advance(state, np.array([next_s]), np.array([[0.5]]))


@pytest.mark.parametrize("case", PASSIVE.values(), ids=PASSIVE)
def test_energy_of_a_passive_plant_never_grows(case):
    """It may grow only in a step with a reversal, in the order of the squared step."""
    for seed in range(4):
        energy = simulate_energy(case, seed)
        assert (energy - np.minimum.accumulate(energy)).max() < 4e-3
        assert energy[60:].max() < 1 + 1e-12


@pytest.mark.slow
@pytest.mark.parametrize("case", PASSIVE.values(), ids=PASSIVE)
def test_growth_within_a_step_vanishes_with_the_step(case):
    growth = [
        max(
            np.diff(simulate_energy(case, seed, periods=3, refinement=refinement)).max()
            for seed in range(4)
        )
        for refinement in (1, 8)
    ]
    assert growth[1] < max(growth[0] / 8.0, 1e-7)


@pytest.mark.parametrize("case", CONSERVED.values(), ids=CONSERVED)
def test_an_elastic_effect_conserves_energy_to_second_order(case):
    energy_ranges = [
        max(np.ptp(simulate_energy(case, seed, refinement=refinement)) for seed in range(4))
        for refinement in (1, 4)
    ]
    assert energy_ranges[0] < 2e-2
    assert energy_ranges[1] < energy_ranges[0] / 8.0


@pytest.mark.parametrize("name", ["coulomb", "lugre", "stribeck"])
def test_friction_brings_an_undamped_axis_to_rest(name):
    energy = simulate_energy(PASSIVE[name], 1, periods=20)
    assert energy[-1] < 0.02

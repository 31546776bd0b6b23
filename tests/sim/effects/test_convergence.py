"""Convergence of forces that are held over inner steps: the order of the error in the step."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.plant import Plant
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import parse_robot

SAMPLE_S = 5e-3
TIME_S = np.arange(0.0, 2.0, SAMPLE_S)
WAVE = 0.45 * np.sin(2 * np.pi * 1.3 * TIME_S) + 0.05 * np.sign(np.sin(2 * np.pi * 2.7 * TIME_S))
STEP_COUNTS = np.array([4, 8, 16, 32])
FINE_STEP_COUNT = 1024
# Minimum numbers of steps per sample that the formulations request on this axis.
PRESET_STEP_COUNTS = {"friction": 3, "stiffness_nonlinearity": 2, "contact": 4}

FADING = {"static_ratio": 2.0, "stribeck_speed": 1e-2, "viscous_forward": 20.0}
DRY = {"coulomb_forward": 0.6, "coulomb_backward": 0.5}
BRISTLES = {"coulomb": 0.6, "deflection": 1e-4, "static_ratio": 1.5, "stribeck_speed": 2e-3}
SLIPPING = {"coulomb": 0.6, "backward": 0.8, "deflection": 1e-4}
ELASTIC = {"place": 0.7, "stiffness": 5.0, "damping_ratio": 0.0}
CASES = {
    # Effect, formulation, parameters, amplitude, minimum order, maximum error of the first step.
    "dry friction": ("friction", "stribeck", DRY, 1e-3, 1.5, 2e-3),
    "fading friction": ("friction", "stribeck", {**DRY, **FADING}, 1e-3, 0.8, 0.1),
    "lugre": ("friction", "lugre", BRISTLES, 1e-3, 0.85, 0.03),
    "springs": ("friction", "springs", SLIPPING, 1e-3, 0.85, 0.1),
    "flexure": ("stiffness_nonlinearity", "cubic", {"hardening": 0.5}, 1.0, 1.9, 0.01),
    "sharper flexure": (
        "stiffness_nonlinearity",
        "cubic_quintic",
        {"hardening": 0.2, "quintic": 0.3},
        1.0,
        1.9,
        0.01,
    ),
    "elastic contact": ("contact", "spring", ELASTIC, 1.0, 1.8, 0.05),
    "damped contact": ("contact", "spring", {**ELASTIC, "damping_ratio": 0.1}, 1.0, 0.85, 0.01),
    "membrane": ("contact", "progressive", {**ELASTIC, "exponent": 3.0}, 1.0, 1.8, 0.1),
    "damped membrane": (
        "contact",
        "progressive",
        {**ELASTIC, "exponent": 3.0, "damping_ratio": 0.1},
        1.0,
        0.8,
        0.01,
    ),
}


def simulate_deviations(effect_id, formulation, parameters, amplitude, counts):
    """Yield the deviation of an axis of 10 Hz for each number of steps per sample."""
    kind = "stepper" if effect_id == "friction" else "piezo"
    gain = "gain = 0.1\n" if kind == "piezo" else ""
    mass, rate = 2.0, 2 * np.pi * 10.0
    robot = parse_robot(
        f"[robot]\nname='one'\naxes=['a']\n[axis.a]\nkind='{kind}'\nunit='m'\nrange=[0.0, 1.0]\n"
        f"{gain}mass={mass}\ndamping={0.04 * mass * rate}\nstiffness={mass * rate**2}\n"
    )
    effect = AxisEffect(axis="a", id=effect_id, formulation=formulation, parameters=parameters)
    plant = Plant.of(replace(robot, effects=(effect,)))
    command = (0.5 + amplitude * WAVE)[:, None]
    state = plant.find_rest_state(0.0, command[0])
    for count in counts:
        stepped = replace(plant, assembly=replace(plant.assembly, inner_step_s=SAMPLE_S / count))
        yield stepped.advance(state, TIME_S, command)[0].position[:, 0] - command[:, 0]


@pytest.mark.parametrize("case", CASES.values(), ids=CASES)
def test_errors_converge_with_their_order_and_preset_steps_are_fine_enough(case):
    *case, min_order, max_first_error = case
    counts = (PRESET_STEP_COUNTS[case[0]], *STEP_COUNTS, FINE_STEP_COUNT)
    *coarse, fine = simulate_deviations(*case, counts)
    preset_error, *errors = (np.linalg.norm(path - fine) / np.linalg.norm(fine) for path in coarse)
    order = -np.polyfit(np.log(STEP_COUNTS), np.log(errors), 1)[0]
    assert order > min_order, errors
    assert errors[0] < max_first_error
    assert preset_error < 0.06

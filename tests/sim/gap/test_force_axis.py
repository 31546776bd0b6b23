"""A force-driven axis under a controller: its effort shows mass, damping and friction."""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from rotemina.sim.errors import EffectError
from rotemina.sim.gap.compare import explain, untouched
from rotemina.sim.gap.compare.attribution import attributed
from rotemina.sim.gap.compare.explanations import explanation
from rotemina.sim.gap.fit import Evidence, fit
from rotemina.sim.gap.pipeline import diagnose
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot

# The shared records are in a module of this folder.
sys.path.insert(0, str(Path(__file__).parent))
from sweeps import simulate_effort

ROBOT = load_robot("emps")
AXIS = ROBOT.axes["q"]
DRY_FRICTION = AxisEffect(
    axis="q", id="friction", parameters={"coulomb_forward": 25.0, "coulomb_backward": 15.0}
)


def make_command(seconds=8.0):
    time_s = np.arange(round(seconds * 1e3)) * 1e-3
    turn = 1.0 - np.cos(2.0 * np.pi * 0.5 * time_s) + 0.2 * (1.0 - np.cos(2 * np.pi * 2 * time_s))
    return 0.05 + 0.05 * turn


def modify_axis(**properties):
    return replace(ROBOT, axes={"q": replace(AXIS, **properties)})


def make_evidence(**properties):
    return Evidence.of(ROBOT, "q", [simulate_effort(modify_axis(**properties), make_command())])


def test_mass_and_damping_are_re_tuned():
    retuned = explain(make_evidence(mass=1.05 * AXIS.mass, damping=0.7 * AXIS.damping), ())
    assert retuned.score < 1.2
    gain, damping = retuned.fit.effects
    # A heavier axis acts like a weaker motor, and the damping scales with the force too.
    assert 1.0 / (1.0 + gain.parameters["error"]) == pytest.approx(1.05, rel=0.01)
    true_damping = (AXIS.damping + damping.parameters["viscous"]) * 1.05
    assert true_damping == pytest.approx(0.7 * AXIS.damping, rel=0.03)


def test_a_wrong_mass_alone_is_a_gain_error_without_friction():
    share = 0.8
    # The constant force is scaled too, so that it starts the axis like the model.
    machine = modify_axis(mass=share * AXIS.mass, force_offset=share * AXIS.force_offset)
    diagnosis = diagnose(ROBOT, [simulate_effort(machine, make_command())])
    (cause,) = diagnosis.causes
    assert cause.effect == "gain_error"
    assert 1.0 / (1.0 + cause.parameters[0].value) == pytest.approx(share, rel=0.02)


def test_a_mass_on_a_spring_is_not_also_a_gain_error():
    appendage = AxisEffect(
        axis="q",
        id="flexible_mode",
        formulation="appendage",
        parameters={"frequency": 18.0, "damping_ratio": 0.02, "mass_ratio": 0.4},
    )
    rigid_robot = modify_axis(mass=AXIS.mass / 1.4, force_offset=AXIS.force_offset / 1.4)
    machine = replace(rigid_robot, effects=(appendage,))
    evidence = Evidence.of(ROBOT, "q", [simulate_effort(machine, make_command())])
    gain = AxisEffect(axis="q", id="gain_error", parameters={"error": 0.35})
    damping = AxisEffect(
        axis="q", id="friction", formulation="viscous", parameters={"viscous": 0.0}
    )
    explanation_with_gain = explanation(evidence, 1, fit(evidence, [appendage, gain, damping]))
    assert explanation_with_gain.fit.cost < 1.2
    assert explanation_with_gain.fit.effects[1].parameters["error"] == pytest.approx(0.4, rel=0.05)
    assert attributed(evidence, untouched(evidence), explanation_with_gain).ids == (
        ("flexible_mode", None),
    )


def test_friction_replaces_damping():
    machine = replace(ROBOT, axes={"q": replace(AXIS, damping=200.0)}, effects=(DRY_FRICTION,))
    explanation_of_friction = explain(
        Evidence.of(ROBOT, "q", [simulate_effort(machine, make_command())]),
        [AxisEffect(axis="q", id="friction")],
    )
    friction = explanation_of_friction.causes[0].parameters
    assert explanation_of_friction.score < 1.5
    assert friction["coulomb_forward"] == pytest.approx(25.0, rel=0.05)
    assert friction["coulomb_backward"] == pytest.approx(15.0, rel=0.05)
    for direction in ("forward", "backward"):
        assert AXIS.damping + friction[f"viscous_{direction}"] == pytest.approx(200.0, rel=0.05)


def test_no_more_damping_can_be_removed_than_exists():
    too_much = AxisEffect(
        axis="q",
        id="friction",
        formulation="viscous",
        parameters={"viscous": -1.01 * AXIS.damping},
    )
    with pytest.raises(EffectError, match="viscous"):
        make_evidence().residual([too_much])


def test_a_constant_force_is_mostly_removed_from_the_gap():
    with_force = make_evidence(force_offset=AXIS.force_offset + 2.0).residual()
    without_force = make_evidence().residual()
    assert abs(with_force.mean()) < 0.2 * 2.0 / abs(AXIS.gain) / 3e-3
    assert np.std(with_force) == pytest.approx(np.std(without_force), rel=0.2)


def test_a_delay_after_the_controller_hardly_changes_its_output():
    delay = AxisEffect(axis="q", id="delay", parameters={"delay": 1e-7})
    assert np.abs(make_evidence().residual([delay]) - make_evidence().residual()).max() < 0.1

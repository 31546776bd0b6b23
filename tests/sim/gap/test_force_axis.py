"""An axis that a force moves, under a controller: its effort tells mass, damping and friction."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.effects.errors import EffectError
from rotemina.sim.gap.compare.attribution import attributed
from rotemina.sim.gap.compare.explanations import explain, explanation, untouched
from rotemina.sim.gap.diagnosis_pipeline import diagnose
from rotemina.sim.gap.fit.evidence import Evidence
from rotemina.sim.gap.fit.output_error import fit
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("emps")


AXIS = ROBOT.axes["q"]


DRY = AxisEffect(
    axis="q", id="friction", parameters={"coulomb_forward": 25.0, "coulomb_backward": 15.0}
)


def moved(robot, command, seed=0):
    time_s = np.arange(len(command)) * 1e-3
    commands = Record.from_signals(
        time_s, {("q", Tap.CMD): command}, {"q": "m"}, {"mode": "closed_loop"}
    )
    answer = simulate(robot, robot.effects, commands)
    noise = 3e-3 * np.random.default_rng(seed).standard_normal(len(command))
    signals = {("q", Tap.CMD): command, ("q", Tap.U): answer.signal("q", Tap.U) + noise}
    return Record.from_signals(time_s, signals, {"q": "m"}, {"mode": "closed_loop"})


def swings(seconds=8.0):
    time_s = np.arange(round(seconds * 1e3)) * 1e-3
    turn = 1.0 - np.cos(2.0 * np.pi * 0.5 * time_s) + 0.2 * (1.0 - np.cos(2 * np.pi * 2 * time_s))
    return 0.05 + 0.05 * turn


def replaced(**figures):
    return replace(ROBOT, axes={"q": replace(AXIS, **figures)})


def evidence(**figures):
    return Evidence.of(ROBOT, "q", [moved(replaced(**figures), swings())])


def test_mass_and_damping_are_re_tuned():
    retuned = explain(evidence(mass=1.05 * AXIS.mass, damping=0.7 * AXIS.damping), ())
    assert retuned.score < 1.2
    gain, damping = retuned.fit.effects
    # A heavier axis does what a weaker motor does, and the damping counts by the force too.
    assert 1.0 / (1.0 + gain.parameters["error"]) == pytest.approx(1.05, rel=0.01)
    known = (AXIS.damping + damping.parameters["viscous"]) * 1.05
    assert known == pytest.approx(0.7 * AXIS.damping, rel=0.03)


@pytest.mark.parametrize("share", [0.8, 1.25])
def test_a_wrong_mass_alone_is_a_gain_and_no_friction_beside_it(share):
    # A constant force that is the record's own: here it starts the axis as it would the model.
    machine = replaced(mass=share * AXIS.mass, force_offset=share * AXIS.force_offset)
    found = diagnose(ROBOT, [moved(machine, swings())])
    (cause,) = found.causes
    assert cause.effect == "gain_error"
    assert 1.0 / (1.0 + cause.parameters[0].value) == pytest.approx(share, rel=0.02)


def test_a_part_of_the_mass_on_a_spring_is_no_gain_beside_it():
    part = AxisEffect(
        axis="q",
        id="flexible_mode",
        formulation="appendage",
        parameters={"frequency": 18.0, "damping_ratio": 0.02, "mass_ratio": 0.4},
    )
    rigid = replaced(mass=AXIS.mass / 1.4, force_offset=AXIS.force_offset / 1.4)
    machine = replace(rigid, effects=(part,))
    seen = Evidence.of(ROBOT, "q", [moved(machine, swings())])
    gain = AxisEffect(axis="q", id="gain_error", parameters={"error": 0.35})
    damping = AxisEffect(
        axis="q", id="friction", formulation="viscous", parameters={"viscous": 0.0}
    )
    explained = explanation(seen, 1, fit(seen, [part, gain, damping]))
    assert explained.fit.cost < 1.2
    assert explained.fit.effects[1].parameters["error"] == pytest.approx(0.4, rel=0.05)
    assert attributed(seen, untouched(seen), explained).ids == (("flexible_mode", None),)


def test_friction_takes_the_place_of_damping():
    machine = replace(ROBOT, axes={"q": replace(AXIS, damping=200.0)}, effects=(DRY,))
    found = explain(
        Evidence.of(ROBOT, "q", [moved(machine, swings())]),
        [AxisEffect(axis="q", id="friction")],
    )
    friction = found.causes[0].parameters
    assert found.score < 1.5
    assert friction["coulomb_forward"] == pytest.approx(25.0, rel=0.05)
    assert friction["coulomb_backward"] == pytest.approx(15.0, rel=0.05)
    for way in ("forward", "backward"):
        assert AXIS.damping + friction[f"viscous_{way}"] == pytest.approx(200.0, rel=0.05)


def test_no_more_damping_can_be_taken_away_than_there_is():
    most = AxisEffect(
        axis="q",
        id="friction",
        formulation="viscous",
        parameters={"viscous": -1.01 * AXIS.damping},
    )
    with pytest.raises(EffectError, match="viscous"):
        evidence().residual([most])


def test_a_constant_force_is_mostly_the_records_own():
    own = evidence(force_offset=AXIS.force_offset + 2.0).residual()
    alike = evidence().residual()
    assert abs(own.mean()) < 0.2 * 2.0 / abs(AXIS.gain) / 3e-3
    assert np.std(own) == pytest.approx(np.std(alike), rel=0.2)


def test_a_delay_behind_the_controller_hardly_changes_what_it_asks_for():
    late = AxisEffect(axis="q", id="delay", parameters={"delay": 1e-7})
    assert np.abs(evidence().residual([late]) - evidence().residual()).max() < 0.1

"""The thrust as a board runs it, and its evaluation."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.app.errors import PenetrationError
from rotemina.app.motion.penetration import PenetrationParameters
from rotemina.app.motion.penetration.thrust import evaluate_thrust, find_resonance, plan_thrust
from rotemina.drivers.simulator.profile_motion import ProfileMotion
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")
TABLE = ((0.0, 0.0), (0.3, 0.1), (0.6, 0.9), (1.0, 1.0))


def test_the_resonance_is_that_of_the_robot_file():
    resonance = find_resonance(ROBOT, "zn")
    # The z table yields slightly: 0.15 kg on 42 kg.
    assert resonance.frequency_hz == pytest.approx(420.0, rel=5e-3)
    assert resonance.damping_ratio == pytest.approx(0.025, rel=0.02)
    assert find_resonance(load_robot("picma"), "p") is None


@pytest.mark.parametrize("shape", ["s_curve", "minimum_jerk", "table"])
@pytest.mark.parametrize("shaping", ["none", "zv", "zvdd"])
def test_a_board_runs_the_planned_profile(shape, shaping):
    parameters = PenetrationParameters(
        shape=shape, shaping=shaping, table=TABLE if shape == "table" else ()
    )
    plan = plan_thrust(ROBOT, parameters, 1e-3)
    plan.profile.check(ROBOT, 60e-6)
    assert plan.profile.duration_s == pytest.approx(0.09)
    assert plan.average_speed == pytest.approx(50e-6 / 0.09)
    assert plan.peak_speed > plan.average_speed
    motion = ProfileMotion(plan.profile, 5, 60e-6, 1e-4)
    travel = motion.advance(10_000) - 60e-6
    time_s = 1e-4 * np.arange(1, len(travel) + 1)
    assert np.abs(travel - plan.target_shape.position(time_s)).max() <= plan.fit_error + 1e-15
    assert plan.fit_error <= 50e-9
    low, high = plan.command_range
    assert low == pytest.approx(-50e-6, abs=2 * plan.fit_error + 1e-15)
    assert high <= plan.fit_error + 1e-15


def test_the_inverse_commands_differ_from_the_target():
    plan = plan_thrust(ROBOT, PenetrationParameters(shaping="inverse"), 1e-3)
    lead = -plan.profile.segments[0].displacement + plan.target_shape.position(
        np.array([plan.profile.segments[0].duration_s])
    )
    assert lead[0] > 1e-7
    assert sum(s.displacement for s in plan.profile.segments) == pytest.approx(-50e-6, rel=1e-9)


def test_a_shaper_that_leaves_no_time_is_refused_with_the_needed_duration():
    with pytest.raises(PenetrationError, match=r"takes 0\.00238 s of it; use at least 0\.00317 s"):
        plan_thrust(ROBOT, PenetrationParameters(duration_s=3e-3), 1e-3)


def test_an_axis_without_a_resonance_cannot_be_shaped():
    with pytest.raises(PenetrationError, match="has no resonance in its robot file"):
        plan_thrust(load_robot("picma"), PenetrationParameters(axis="p"), 1e-3)
    plan_thrust(load_robot("picma"), PenetrationParameters(axis="p", shaping="none"), 1e-3)


def test_the_error_does_not_include_the_delay():
    plan = plan_thrust(ROBOT, PenetrationParameters(), 1e-3)
    time_s = np.arange(0.0, 0.4, 1e-3)
    delayed_travel = plan.target_shape.position(time_s - 0.1 - 0.0137)
    thrust = evaluate_thrust(plan, time_s, 7e-6 + delayed_travel, 0.1)
    assert thrust.delay_s == pytest.approx(0.0137, abs=1e-5)
    assert thrust.error < 1e-8
    assert thrust.depth == pytest.approx(50e-6)
    assert thrust.peak_speed == pytest.approx(plan.peak_speed, rel=0.01)
    assert thrust.rate_hz == pytest.approx(1e3)
    thrust = evaluate_thrust(plan, time_s, 0.9 * delayed_travel, 0.1)
    assert thrust.depth == pytest.approx(45e-6)
    assert thrust.error == pytest.approx(5e-6, rel=0.05)


@pytest.mark.parametrize("section", [slice(0, 150), slice(110, None)])
def test_samples_that_do_not_cover_the_thrust_are_refused(section):
    plan = plan_thrust(ROBOT, PenetrationParameters(), 1e-3)
    time_s = np.arange(0.0, 0.4, 1e-3)[section]
    with pytest.raises(PenetrationError, match="no sample was taken"):
        evaluate_thrust(plan, time_s, plan.target_shape.position(time_s - 0.1), 0.1)


def test_a_thrust_faster_than_the_axis_is_refused_by_its_profile():
    slow_robot = replace(
        ROBOT, axes={**ROBOT.axes, "zn": replace(ROBOT.axes["zn"], max_speed=5e-4)}
    )
    plan = plan_thrust(slow_robot, PenetrationParameters(), 1e-3)
    with pytest.raises(ValueError, match="at most"):
        plan.profile.check(slow_robot, 60e-6)

"""Physics of the set-point generator: bounds, exact arrival, stopping distance."""

import numpy as np
import pytest
from hypothesis import given, strategies as st

from rotemina.drivers.simulator import SetpointGenerator
from rotemina.sim.robot_files import load_robot
from rotemina.sim.trajectory import SetpointLimits

LOW, HIGH, SPEED, ACCELERATION = -1.0, 2.0, 0.7, 3.0
LIMITS = SetpointLimits(*(np.array([bound]) for bound in (LOW, HIGH, SPEED, ACCELERATION)))

positions = st.one_of(st.floats(LOW, HIGH), st.sampled_from([LOW, HIGH, 0.0, 1e-12]))
ticks = st.sampled_from([1e-4, 1e-3, 0.01, 0.3])
# A few targets, each with the number of ticks that follow it. None means a stop.
target_lists = st.lists(
    st.tuples(st.one_of(positions, st.none()), st.integers(0, 400)), min_size=1, max_size=6
)


def compute_speeds(commands, start, tick_s):
    return np.diff(np.concatenate([[start], commands])) / tick_s


def check_bounds(commands, start, tick_s):
    speed = compute_speeds(commands, start, tick_s)
    acceleration = np.diff(np.concatenate([[0.0], speed])) / tick_s
    rounding = 4e-16 / tick_s
    assert np.abs(speed).max(initial=0.0) <= SPEED * (1 + 1e-9) + rounding
    assert np.abs(acceleration).max(initial=0.0) <= ACCELERATION * (1 + 1e-6) + rounding / tick_s
    assert commands.min(initial=LOW) >= LOW
    assert commands.max(initial=HIGH) <= HIGH


@given(start=positions, targets=target_lists, tick_s=ticks)
def test_bounds_hold_for_any_targets(start, targets, tick_s):
    generator = SetpointGenerator(LIMITS, tick_s, np.array([start]))
    portions = []
    for target, count in targets:
        generator.stop() if target is None else generator.retarget({0: target})
        portions.append(generator.generate(count)[:, 0])
    portions.append(generator.generate(200_000, until_rest=True)[:, 0])
    assert not generator.moving
    check_bounds(np.concatenate(portions), start, tick_s)
    last_target = targets[-1][0]
    if last_target is not None:
        assert generator.position[0] == last_target


@given(start=positions, target=positions, tick_s=ticks)
def test_a_move_from_rest_goes_straight_to_its_target(start, target, tick_s):
    generator = SetpointGenerator(LIMITS, tick_s, np.array([start]))
    generator.retarget({0: target})
    commands = generator.generate(200_000, until_rest=True)[:, 0]
    progress = np.diff(np.concatenate([[start], commands])) * np.sign(target - start)
    assert (progress >= 0).all()
    assert commands[-1] == target
    assert (generator.generate(5) == target).all()


@given(target=positions, tick_s=ticks, tick_count=st.integers(0, 3000))
def test_a_stop_takes_at_most_the_braking_distance(target, tick_s, tick_count):
    generator = SetpointGenerator(LIMITS, tick_s, np.array([0.5]))
    generator.retarget({0: target})
    commands_before = np.concatenate([[0.5, 0.5], generator.generate(tick_count)[:, 0]])
    speed = (commands_before[-1] - commands_before[-2]) / tick_s
    generator.stop()
    generator.generate(200_000, until_rest=True)
    distance = abs(generator.position[0] - commands_before[-1])
    assert distance <= speed**2 / (2 * ACCELERATION) + 1e-12
    assert not generator.moving


def test_a_long_move_takes_the_time_of_a_trapezoid():
    generator = SetpointGenerator(LIMITS, 1e-3, np.array([LOW]))
    generator.retarget({0: HIGH})
    count = len(generator.generate(200_000, until_rest=True))
    assert count * 1e-3 == pytest.approx((HIGH - LOW) / SPEED + SPEED / ACCELERATION, abs=3e-3)


def test_a_nearer_target_during_a_move_is_passed_once_and_then_reached():
    generator = SetpointGenerator(LIMITS, 1e-3, np.array([0.0]))
    generator.retarget({0: 2.0})
    position = generator.generate(1000)[-1, 0]
    generator.retarget({0: position + 0.01})
    commands = generator.generate(200_000, until_rest=True)[:, 0]
    assert commands.max() - position == pytest.approx(SPEED**2 / (2 * ACCELERATION), rel=0.02)
    assert commands[-1] == position + 0.01


def test_generating_until_rest_returns_the_same_commands():
    first, second = (SetpointGenerator(LIMITS, 1e-3, np.array([0.0])) for _ in range(2))
    for generator in (first, second):
        generator.retarget({0: 0.4})
    until_rest_commands, all_commands = first.generate(5000, until_rest=True), second.generate(5000)
    np.testing.assert_array_equal(until_rest_commands, all_commands[: len(until_rest_commands)])
    assert (all_commands[len(until_rest_commands) - 1 :] == 0.4).all()


def test_a_take_over_near_the_end_of_the_range_stays_inside():
    generator = SetpointGenerator(LIMITS, 1e-3, np.array([0.0]))
    generator.take_over(np.array([HIGH - 1e-3]), np.array([5.0]))
    commands = generator.generate(1000)
    assert commands.max() == HIGH
    assert not generator.moving


def test_an_axis_without_bounds_crosses_its_range_in_a_second():
    limits = SetpointLimits.of(load_robot("emps"))
    assert limits.speed[0] == pytest.approx(0.27)
    assert limits.acceleration[0] == pytest.approx(2.7)


def test_a_target_beyond_the_range_by_rounding_is_reached():
    robot = load_robot("rotemina")
    limits = SetpointLimits.of(robot)
    generator = SetpointGenerator(limits, 1e-3, 0.99 * limits.high)
    generator.retarget({0: float(limits.high[0]) * (1.0 + 1e-12)})
    generator.generate(1000)
    assert not generator.moving
    assert generator.position[0] == limits.high[0]


def test_the_range_of_an_axis_ends_at_the_limit_of_its_amplifier():
    limits = SetpointLimits.of(load_robot("picma"))
    assert limits.low[0] == 0.0
    assert limits.high[0] == 3.7 * 12.53e-6

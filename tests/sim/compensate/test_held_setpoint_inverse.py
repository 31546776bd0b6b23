"""An inverse for held set-points: exact at its targets, between them, and after a path."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.compensate import Inverse, InverseExceedance, SetpointInverse
from rotemina.sim.errors import CompensationError


@pytest.fixture
def model(make_inverse_model):
    return make_inverse_model()


STEP = 1e-9  # m, resolution of the device's set-points


def make_line(begin, end):
    return np.linspace(begin, end, 200)


def move_to_target(held_inverse, target):
    """Let the device run to a target and return the assumed positions of the axis meanwhile."""
    return held_inverse.advance(
        make_line(held_inverse._sent, held_inverse.add_setpoint(target))[1:]
    )


def test_a_sequence_of_targets_gives_the_commands_of_the_plain_inverse(model):
    held_inverse = SetpointInverse(model, 20e-6)
    inverse = Inverse(model, 1e-3)
    inverse.step(held_inverse.desired)
    for target in (50e-6, 10e-6, 11e-6, 9e-6, 55e-6, 30e-6, 30.5e-6):
        start = held_inverse.desired
        expected = inverse.run(make_line(start, target))[-1]
        assert held_inverse.add_setpoint(target) == pytest.approx(expected, abs=1e-12)
        positions = move_to_target(held_inverse, target)
        assert (np.diff(positions) * np.sign(target - start) >= 0.0).all()  # never backwards
        assert held_inverse.desired == pytest.approx(target, abs=1e-12)
    assert held_inverse.exceedance == InverseExceedance(0)


def test_the_position_of_a_device_that_halts_early_matches_the_inverse(model):
    held_inverse = SetpointInverse(model, 20e-6)
    start = held_inverse.desired
    set_points = make_line(20e-6, held_inverse.add_setpoint(50e-6))[:120]
    held_inverse.advance(set_points[1:])
    inverse = Inverse(model, 1e-3)
    inverse.step(start)
    assert inverse.run(make_line(start, held_inverse.desired))[-1] == pytest.approx(
        set_points[-1], abs=5 * STEP
    )
    # The memory has the turning point, so the command for the way back is exact, too.
    command_back = held_inverse.add_setpoint(15e-6)
    assert command_back == pytest.approx(
        inverse.run(make_line(held_inverse.desired, 15e-6))[-1], abs=5 * STEP
    )


def test_the_axis_is_never_faster_than_the_desired_speed(model):
    held_inverse = SetpointInverse(model, 20e-6)
    start = held_inverse.desired
    factor = held_inverse.compute_speed_factor(50e-6)
    positions = move_to_target(held_inverse, 50e-6)
    set_points = make_line(20e-6, held_inverse._sent)[1:]
    # The axis goes at most 1 / slope times as fast as the set-points.
    steepest = np.max(np.diff(positions) / np.diff(set_points))
    assert factor * steepest <= 1.0 + 1e-6
    assert 0.5 < factor * (50e-6 - start) / (held_inverse._sent - 20e-6) <= 1.0


def test_after_a_played_path_the_inverse_continues_from_its_end(model):
    path = 30e-6 + 20e-6 * np.sin(np.linspace(0.0, 12.0, 900))
    commands = Inverse(model, 1e-3, preview=True).run(path)
    held_inverse = SetpointInverse(model, 20e-6).resume_after(path, commands[-1])
    assert held_inverse.desired == path[-1]
    plain_inverse = Inverse(model, 1e-3, preview=True)
    plain_inverse.run(path)
    expected = plain_inverse.run(make_line(path[-1], 45e-6))[-1]
    assert held_inverse.add_setpoint(45e-6) == pytest.approx(expected, abs=1e-12)


def test_slow_creep_remains_as_an_offset_after_a_path(model):
    creep_model = replace(
        model, creep_times_s=np.array([0.03, 30.0]), creep_weights=np.full(2, 0.02)
    )
    path = np.concatenate([make_line(20e-6, 50e-6), np.full(20_000, 50e-6)])
    commands = Inverse(creep_model, 1e-3, preview=True).run(path)
    held_inverse = SetpointInverse(creep_model, 20e-6).resume_after(path, commands[-1])
    assert held_inverse.desired == 50e-6
    assert held_inverse.add_setpoint(50e-6) == pytest.approx(
        commands[-1], abs=1e-15
    )  # it stays where it is


def test_targets_out_of_range_are_clamped_and_reported_and_such_a_start_is_refused(model):
    held_inverse = SetpointInverse(model, 20e-6)
    assert held_inverse.add_setpoint(61e-6) == held_inverse.add_setpoint(60e-6)
    assert held_inverse.exceedance == InverseExceedance.HIGH
    with pytest.raises(CompensationError, match="move the axis there first"):
        SetpointInverse(model, 64e-6)

"""An inverse for held set-points: exact where it aims, on the loop between, and after a path."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.compensate.errors import CompensationError
from rotemina.sim.compensate.held_setpoint_inverse import HeldInverse
from rotemina.sim.compensate.inverse import Exceedance, Inverse
from rotemina.sim.compensate.inverse_parameters import InverseModel

SPAN = 65e-6
MODEL = InverseModel(
    axis="zn",
    unit="m",
    kind="prandtl_ishlinskii",
    sample_s=1e-3,
    origin=0.0,
    command_origin=0.0,
    span=SPAN,
    desired_range=(2e-6, 60e-6),
    command_range=(0.0, SPAN),
    speed=1.0,
    consequents=np.array([[0.0, 0.9, 0.1, 0.05]]),
    radii=np.array([0.1, 0.03]),
    initial=np.zeros(2),
)
STEP = 1e-9  # m: of the device's set-points


def line(begin, end):
    return np.linspace(begin, end, 200)


def moved(held, target):
    """Let the device run to a target and return where the axis is taken to be on the way."""
    return held.follow(line(held._sent, held.aim(target))[1:])


def test_a_way_of_targets_and_turns_is_that_of_the_inverse_itself():
    held = HeldInverse(MODEL, 20e-6)
    inverse = Inverse(MODEL, 1e-3)
    inverse.step(held.wanted)
    for target in (50e-6, 10e-6, 11e-6, 9e-6, 55e-6, 30e-6, 30.5e-6):
        before = held.wanted
        expected = inverse.run(line(before, target))[-1]
        assert held.aim(target) == pytest.approx(expected, abs=1e-12)
        way = moved(held, target)
        assert (np.diff(way) * np.sign(target - before) >= 0.0).all()  # never back on the way
        assert held.wanted == pytest.approx(target, abs=1e-12)
    assert held.beyond == Exceedance(0)


def test_a_device_that_halts_on_the_way_is_where_the_inverse_says():
    held = HeldInverse(MODEL, 20e-6)
    start = held.wanted
    sent = line(20e-6, held.aim(50e-6))[:120]
    held.follow(sent[1:])
    inverse = Inverse(MODEL, 1e-3)
    inverse.step(start)
    assert inverse.run(line(start, held.wanted))[-1] == pytest.approx(sent[-1], abs=5 * STEP)
    # And back from there: the memory has the turning point.
    back = held.aim(15e-6)
    assert back == pytest.approx(inverse.run(line(held.wanted, 15e-6))[-1], abs=5 * STEP)


def test_a_speed_is_never_faster_than_wanted():
    held = HeldInverse(MODEL, 20e-6)
    before = held.wanted
    rate = held.rate(50e-6)
    way = moved(held, 50e-6)
    sent = line(20e-6, held._sent)[1:]
    # The axis goes at most 1 / slope times as fast as the set-points.
    steepest = np.max(np.diff(way) / np.diff(sent))
    assert rate * steepest <= 1.0 + 1e-6
    assert 0.5 < rate * (50e-6 - before) / (held._sent - 20e-6) <= 1.0


def test_after_a_played_path_it_goes_on_from_there():
    path = 30e-6 + 20e-6 * np.sin(np.linspace(0.0, 12.0, 900))
    sent = Inverse(MODEL, 1e-3, preview=True).run(path)
    held = HeldInverse(MODEL, 20e-6).walked(path, sent[-1])
    assert held.wanted == path[-1]
    again = Inverse(MODEL, 1e-3, preview=True)
    again.run(path)
    expected = again.run(line(path[-1], 45e-6))[-1]
    assert held.aim(45e-6) == pytest.approx(expected, abs=1e-12)


def test_slow_creep_stays_as_an_offset_after_a_path():
    crept = replace(MODEL, creep_times_s=np.array([0.03, 30.0]), creep_weights=np.full(2, 0.02))
    path = np.concatenate([line(20e-6, 50e-6), np.full(20_000, 50e-6)])
    sent = Inverse(crept, 1e-3, preview=True).run(path)
    held = HeldInverse(crept, 20e-6).walked(path, sent[-1])
    assert held.wanted == 50e-6
    assert held.aim(50e-6) == pytest.approx(sent[-1], abs=1e-15)  # it stays where it is


def test_what_lies_beyond_is_clamped_and_said_and_where_it_does_not_reach_refused():
    held = HeldInverse(MODEL, 20e-6)
    assert held.aim(61e-6) == held.aim(60e-6)
    assert held.beyond == Exceedance.HIGH
    with pytest.raises(CompensationError, match="move the axis there first"):
        HeldInverse(MODEL, 64e-6)

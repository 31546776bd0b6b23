"""Backlash: a width that knows neither amplitude nor speed, from a start as after a rise."""

import numpy as np
import pytest

from rotemina.sim.effects.backlash import FLANKS, flanks, play
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")
WIDTH = 5e-6
EVERY = pytest.mark.parametrize("formulation", ["rigid", "compliant"])


def driven(command, formulation, rate_hz=1000.0, **parameters):
    record = Record.from_signals(
        np.arange(len(command)) / rate_hz, {("x", Tap.CMD): command}, {"x": "m"}
    )
    effect = AxisEffect(axis="x", id="backlash", formulation=formulation, parameters=parameters)
    return simulate(ROBOT, [effect] if parameters else (), record).signal("x", Tap.REF)


def swing(amplitude, frequency_hz, rate_hz=1000.0):
    """Return three slow swings; accelerations small enough for the axis to follow."""
    time_s = np.arange(int(3 / frequency_hz * rate_hz)) / rate_hz
    return 0.02 + amplitude * np.sin(2 * np.pi * frequency_hz * time_s)


def width_of_loop(command, path, nominal):
    """Return the distance between the ways up and down, in the middle."""
    behind = nominal - path
    half = len(command) // 3
    rising = np.gradient(nominal) > 0
    middle = np.abs(command - 0.02) < 0.2 * np.ptp(command)
    middle[:half] = False
    return behind[rising & middle].mean() - behind[~rising & middle].mean()


@EVERY
@pytest.mark.parametrize("amplitude", [3e-5, 1e-4, 1e-3])
@pytest.mark.parametrize("frequency_hz", [0.2, 1.0, 3.0])
def test_the_width_depends_on_neither_amplitude_nor_speed(formulation, amplitude, frequency_hz):
    command = swing(amplitude, frequency_hz)
    nominal = driven(command, formulation)
    width = width_of_loop(command, driven(command, formulation, width=WIDTH), nominal)
    assert width == pytest.approx(WIDTH, rel=1e-3)


@EVERY
def test_a_run_starts_as_after_a_rise(formulation):
    rest = driven(np.full(5, 0.02), formulation, width=WIDTH)
    np.testing.assert_allclose(0.02 - rest, WIDTH / 2, rtol=1e-9)


@EVERY
def test_going_on_upwards_finds_no_play(formulation):
    command = 0.02 + 1e-3 * np.linspace(0, 1, 2000)
    gap = driven(command, formulation, width=WIDTH) - driven(command, formulation)
    np.testing.assert_allclose(gap, -WIDTH / 2, rtol=1e-6)


@EVERY
def test_no_width_is_the_nominal_axis(formulation):
    command = swing(1e-4, 2.0)
    gap = driven(command, formulation, width=0.0) - driven(command, formulation)
    assert np.abs(gap).max() < 1e-14


@EVERY
def test_the_trace_is_the_same_at_any_pace(formulation):
    path = np.concatenate([np.linspace(0.02, 0.0201, 2000), np.linspace(0.0201, 0.02003, 2000)])
    slow = driven(path, formulation, rate_hz=20.0, width=WIDTH)
    fast = driven(path, formulation, rate_hz=200.0, width=WIDTH)
    assert np.abs(slow - fast).max() < 0.02 * WIDTH


def test_no_softness_is_rigid():
    command = swing(1e-4, 2.0)
    soft = driven(command, "compliant", width=WIDTH, softness=0.0)
    np.testing.assert_allclose(soft, driven(command, "rigid", width=WIDTH), rtol=0, atol=1e-16)


def test_soft_flanks_are_taken_up_bit_by_bit():
    """After a reversal by half the width, rigid play has moved nothing, soft flanks have."""
    command = 0.02 - 0.7 * WIDTH * np.linspace(0.0, 1.0, 3000)
    rigid = driven(command, "rigid", width=WIDTH)
    soft = driven(command, "compliant", width=WIDTH, softness=1.0)
    assert abs(rigid[-1] - rigid[0]) < 1e-3 * WIDTH
    assert 0.1 * WIDTH < soft[0] - soft[-1] < 0.4 * WIDTH


def test_turning_points_between_samples_are_seen():
    """Sampled slowly, the overshoot of a step still takes up the play."""
    command = np.concatenate([np.full(3, 0.02), np.full(20, 0.0201)])
    slow = driven(command, "rigid", rate_hz=10.0, width=WIDTH)
    fine = driven(np.repeat(command, 400), "rigid", rate_hz=4000.0, width=WIDTH)
    assert slow[-1] == pytest.approx(fine[-1], abs=0.05 * WIDTH)
    assert slow[-1] > 0.0201


def test_the_plain_functions_follow_their_definition():
    p, s, y = [0.5, 0.0], [0.0], 0.0
    for x in np.cumsum(np.random.default_rng(1).normal(size=300)) + 30.0:
        y = max(x - 0.5, min(x + 0.5, y))
        assert play(x, 0.0, 0.0, 1.0, 0.0, 0.0, p, s) == pytest.approx(y, abs=1e-12)
    rigid, soft = [0.0], [0.0] * FLANKS
    for x in (3.0, 2.8, 2.1, 2.5, 4.0):
        one = play(x, 0.0, 0.0, 1.0, 0.0, 0.0, p, rigid)
        many = flanks(x, 0.0, 0.0, 1.0, 0.0, 0.0, [0.0] + [0.5] * FLANKS, soft)
        assert many == pytest.approx(one, abs=1e-12)

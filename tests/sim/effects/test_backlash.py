"""Backlash: its width is independent of amplitude and speed, and a run starts as after a rise."""

import numpy as np
import pytest

from rotemina.sim.effects.backlash import PLAY_COUNT, apply_play, apply_plays
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")
WIDTH = 5e-6
every_formulation = pytest.mark.parametrize("formulation", ["rigid", "compliant"])


def simulate_position(command, formulation, rate_hz=1000.0, **parameters):
    record = Record.from_signals(
        np.arange(len(command)) / rate_hz, {("x", Tap.CMD): command}, {"x": "m"}
    )
    effect = AxisEffect(axis="x", id="backlash", formulation=formulation, parameters=parameters)
    return simulate(ROBOT, [effect] if parameters else (), record).signal("x", Tap.REF)


def make_swing(amplitude, frequency_hz, rate_hz=1000.0):
    """Return three swings, slow enough for the axis to follow."""
    time_s = np.arange(int(3 / frequency_hz * rate_hz)) / rate_hz
    return 0.02 + amplitude * np.sin(2 * np.pi * frequency_hz * time_s)


def measure_loop_width(command, path, nominal):
    """Return the distance between the upward and the downward path in mid-range."""
    lag = nominal - path
    half = len(command) // 3
    rising = np.gradient(nominal) > 0
    middle = np.abs(command - 0.02) < 0.2 * np.ptp(command)
    middle[:half] = False
    return lag[rising & middle].mean() - lag[~rising & middle].mean()


@every_formulation
@pytest.mark.parametrize(("amplitude", "frequency_hz"), [(3e-5, 3.0), (1e-4, 1.0), (1e-3, 0.2)])
def test_the_width_depends_on_neither_amplitude_nor_speed(formulation, amplitude, frequency_hz):
    command = make_swing(amplitude, frequency_hz)
    nominal = simulate_position(command, formulation)
    width = measure_loop_width(
        command, simulate_position(command, formulation, width=WIDTH), nominal
    )
    assert width == pytest.approx(WIDTH, rel=1e-3)


@every_formulation
def test_a_run_starts_as_after_a_rise_and_meets_no_play_upwards(formulation):
    command = 0.02 + 1e-3 * np.linspace(0, 1, 2000)
    gap = simulate_position(command, formulation, width=WIDTH) - simulate_position(
        command, formulation
    )
    np.testing.assert_allclose(gap, -WIDTH / 2, rtol=1e-6)


def test_zero_softness_is_rigid():
    command = make_swing(1e-4, 2.0)
    soft = simulate_position(command, "compliant", width=WIDTH, softness=0.0)
    np.testing.assert_allclose(
        soft, simulate_position(command, "rigid", width=WIDTH), rtol=0, atol=1e-16
    )


def test_soft_flanks_are_taken_up_gradually():
    """After a reversal by 0.7 of the width, the axis has moved only with soft flanks."""
    command = 0.02 - 0.7 * WIDTH * np.linspace(0.0, 1.0, 3000)
    rigid = simulate_position(command, "rigid", width=WIDTH)
    soft = simulate_position(command, "compliant", width=WIDTH, softness=1.0)
    assert abs(rigid[-1] - rigid[0]) < 1e-3 * WIDTH
    assert 0.1 * WIDTH < soft[0] - soft[-1] < 0.4 * WIDTH


def test_turning_points_between_samples_count():
    """The overshoot of a step takes up the play even if samples are too coarse to show it."""
    command = np.concatenate([np.full(3, 0.02), np.full(20, 0.0201)])
    slow = simulate_position(command, "rigid", rate_hz=10.0, width=WIDTH)
    fine = simulate_position(np.repeat(command, 400), "rigid", rate_hz=4000.0, width=WIDTH)
    assert slow[-1] == pytest.approx(fine[-1], abs=0.05 * WIDTH)
    assert slow[-1] > 0.0201


def test_the_python_functions_follow_their_definition():
    p, s, y = [0.5, 0.0], [0.0], 0.0
    for x in np.cumsum(np.random.default_rng(1).normal(size=300)) + 30.0:
        y = max(x - 0.5, min(x + 0.5, y))
        assert apply_play(x, 0.0, 0.0, 1.0, 0.0, 0.0, p, s) == pytest.approx(y, abs=1e-12)
    rigid, soft = [0.0], [0.0] * PLAY_COUNT
    for x in (3.0, 2.8, 2.1, 2.5, 4.0):
        rigid_output = apply_play(x, 0.0, 0.0, 1.0, 0.0, 0.0, p, rigid)
        soft_output = apply_plays(x, 0.0, 0.0, 1.0, 0.0, 0.0, [0.0] + [0.5] * PLAY_COUNT, soft)
        assert soft_output == pytest.approx(rigid_output, abs=1e-12)

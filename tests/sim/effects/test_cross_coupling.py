"""Cross coupling: the motion of another axis leaks in, directly or through a mode."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.signal import lsim

from rotemina.sim.effects import AttachedEffect
from rotemina.sim.errors import EffectError
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")
TIME_S = np.arange(4000) / 4000.0
MODE = {"frequency": 60.0, "damping_ratio": 0.1}
MODE_RATE = 2 * np.pi * 60.0


def simulate_coupling(formulation, source, robot=ROBOT, target="zn", **parameters):
    """Return the position of the source and the motion that leaks into a resting axis."""
    mid_positions = {name: sum(robot.axes[name].range) / 2 for name in (source, target)}
    sine = robot.axes[source].span * 1e-3 * np.sin(2 * np.pi * 15.0 * TIME_S) * (TIME_S > 0.02)
    signals = {
        (source, Tap.CMD): mid_positions[source] + sine,
        (target, Tap.CMD): np.full(4000, mid_positions[target]),
    }
    record = Record.from_signals(TIME_S, signals, {n: robot.unit(n) for n in mid_positions})
    effect = AxisEffect(
        axis=target,
        id="cross_coupling",
        formulation=formulation,
        parameters=parameters,
        from_axis=source,
    )
    before = simulate(robot, (), record)
    after = simulate(robot, [effect], record)
    np.testing.assert_allclose(
        after.signal(source, Tap.REF), before.signal(source, Tap.REF), rtol=1e-12
    )
    leaked = after.signal(target, Tap.REF) - before.signal(target, Tap.REF)
    return before.signal(source, Tap.REF), leaked


def filter_by_mode(numerator, source):
    """Return the response of the mode to a finely sampled path."""
    rest = source[0]
    system = (numerator, [1.0, 2 * 0.1 * MODE_RATE, MODE_RATE**2])
    return lsim(system, source - rest, TIME_S)[1]


@pytest.mark.parametrize(("source", "k"), [("x", 1e-4), ("thx", -0.3), ("x", 2.5)])
def test_a_static_coupling_adds_the_other_position(source, k):
    source_position, leaked = simulate_coupling("static", source, k=k)
    np.testing.assert_allclose(leaked, k * source_position, atol=1e-15)


@pytest.mark.parametrize("source", ["x", "thx"])
def test_a_coupling_through_a_mode_matches_its_transfer_function(source):
    q, leaked = simulate_coupling("mode", source, k=0.5, **MODE)
    expected = 0.5 * (q[0] + filter_by_mode([MODE_RATE**2], q))
    np.testing.assert_allclose(leaked, expected, atol=2e-3 * 0.5 * np.ptp(q))
    assert np.ptp(leaked) > 0.4 * np.ptp(q)


@pytest.mark.parametrize("source", ["x", "thx"])
def test_a_coupling_while_moving_matches_its_transfer_function(source):
    q, leaked = simulate_coupling("moving", source, k=0.5, **MODE)
    expected = 0.5 * filter_by_mode([1.0, 2 * 0.1 * MODE_RATE, 0.0], q)
    np.testing.assert_allclose(leaked, expected, atol=2e-3 * 0.5 * np.ptp(q))
    assert np.abs(leaked[:80]).max() < 1e-12 * np.ptp(q)


def test_a_static_axis_can_be_the_source():
    static = replace(ROBOT.axes["thx"], static=True, mass=None, damping=None, stiffness=None)
    robot = replace(ROBOT, axes={**ROBOT.axes, "thx": static}, couplings=())
    q, leaked = simulate_coupling("mode", "thx", robot, k=0.5, **MODE)
    held = lsim(
        ([MODE_RATE**2], [1.0, 2 * 0.1 * MODE_RATE, MODE_RATE**2]), q - q[0], TIME_S, interp=False
    )[1]
    np.testing.assert_allclose(leaked, 0.5 * (q[0] + held), atol=1e-6 * np.ptp(q))


def test_a_source_axis_without_commands_is_simulated():
    record = Record.from_signals(TIME_S, {("zn", Tap.CMD): np.full(4000, 3e-5)}, {"zn": "m"})
    effect = AxisEffect(axis="zn", id="cross_coupling", parameters={"k": 1e-3}, from_axis="x")
    leaked = simulate(ROBOT, [effect], record).signal("zn", Tap.REF) - 3e-5
    np.testing.assert_allclose(leaked, 1e-3 * 0.0275, atol=1e-15)


@pytest.mark.parametrize("source", [None, "zn", "no such"])
def test_a_coupling_needs_another_axis(source):
    effect = AxisEffect(axis="zn", id="cross_coupling", from_axis=source)
    with pytest.raises(EffectError, match="from_axis"):
        AttachedEffect.of(ROBOT, effect)

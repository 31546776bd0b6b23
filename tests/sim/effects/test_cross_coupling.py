"""Cross coupling: another axis' motion leaks in, at once or through a mode of its own."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.signal import lsim

from rotemina.sim.effects.attachment import Attached
from rotemina.sim.effects.cross_coupling import leak
from rotemina.sim.effects.errors import EffectError
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")
TIME_S = np.arange(4000) / 4000.0
MODE = {"frequency": 60.0, "damping_ratio": 0.1}
W = 2 * np.pi * 60.0


def coupled(formulation, source, robot=ROBOT, target="zn", **parameters):
    """Return the sources' position and what leaks into an axis that stands still."""
    middle = {name: sum(robot.axes[name].range) / 2 for name in (source, target)}
    moving = robot.axes[source].span * 1e-3 * np.sin(2 * np.pi * 15.0 * TIME_S) * (TIME_S > 0.02)
    signals = {
        (source, Tap.CMD): middle[source] + moving,
        (target, Tap.CMD): np.full(4000, middle[target]),
    }
    record = Record.from_signals(TIME_S, signals, {n: robot.unit(n) for n in middle})
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


def through(numerator, source):
    """Answer of a transfer function to a path that is finely sampled."""
    rest = source[0]
    system = (numerator, [1.0, 2 * 0.1 * W, W**2])
    return lsim(system, source - rest, TIME_S)[1]


@pytest.mark.parametrize("source", ["x", "thx"])
@pytest.mark.parametrize("k", [1e-4, -0.3, 2.5])
def test_a_static_coupling_adds_the_other_position(source, k):
    q, leaked = coupled("static", source, k=k)
    np.testing.assert_allclose(leaked, k * q, atol=1e-15)


@pytest.mark.parametrize("source", ["x", "thx"])
def test_through_a_mode(source):
    q, leaked = coupled("mode", source, k=0.5, **MODE)
    expected = 0.5 * (q[0] + through([W**2], q))
    np.testing.assert_allclose(leaked, expected, atol=2e-3 * 0.5 * np.ptp(q))
    assert np.ptp(leaked) > 0.4 * np.ptp(q)


@pytest.mark.parametrize("source", ["x", "thx"])
def test_while_moving(source):
    q, leaked = coupled("moving", source, k=0.5, **MODE)
    expected = 0.5 * through([1.0, 2 * 0.1 * W, 0.0], q)
    np.testing.assert_allclose(leaked, expected, atol=2e-3 * 0.5 * np.ptp(q))
    assert np.abs(leaked[:80]).max() < 1e-12 * np.ptp(q)


def test_from_a_static_axis():
    static = replace(ROBOT.axes["thx"], static=True, mass=None, damping=None, stiffness=None)
    robot = replace(ROBOT, axes={**ROBOT.axes, "thx": static}, couplings=())
    q, leaked = coupled("mode", "thx", robot, k=0.5, **MODE)
    held = lsim(([W**2], [1.0, 2 * 0.1 * W, W**2]), q - q[0], TIME_S, interp=False)[1]
    np.testing.assert_allclose(leaked, 0.5 * (q[0] + held), atol=1e-6 * np.ptp(q))


@pytest.mark.parametrize(("formulation", "figures"), [("static", {}), ("mode", MODE)])
def test_it_is_linear_and_nothing_without_k(formulation, figures):
    one = coupled(formulation, "thx", k=0.1, **figures)[1]
    two = coupled(formulation, "thx", k=0.2, **figures)[1]
    np.testing.assert_allclose(two, 2 * one, atol=1e-17)
    assert np.abs(coupled(formulation, "thx", k=0.0, **figures)[1]).max() == 0.0


def test_the_axis_that_it_comes_from_is_simulated_though_no_one_asks_for_it():
    record = Record.from_signals(TIME_S, {("zn", Tap.CMD): np.full(4000, 3e-5)}, {"zn": "m"})
    effect = AxisEffect(axis="zn", id="cross_coupling", parameters={"k": 1e-3}, from_axis="x")
    leaked = simulate(ROBOT, [effect], record).signal("zn", Tap.REF) - 3e-5
    np.testing.assert_allclose(leaked, 1e-3 * 0.0275, atol=1e-15)


@pytest.mark.parametrize("source", [None, "zn", "no such"])
def test_it_needs_another_axis(source):
    asked = AxisEffect(axis="zn", id="cross_coupling", from_axis=source)
    with pytest.raises(EffectError, match="from_axis"):
        Attached.of(ROBOT, asked)


def test_plain_python_says_the_same():
    assert leak(1.0, 2.0, 0.0, 0.0, 0.0, 0.0, [0.25], []) == 1.5

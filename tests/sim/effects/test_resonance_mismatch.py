"""Resonance mismatch: the mode moves or broadens, and what is static stays."""

import numpy as np
import pytest
from scipy.signal import lsim

from rotemina.sim.effects.errors import EffectError
from rotemina.sim.effects.resonance_mismatch import RESONANCE_MISMATCH
from rotemina.sim.plant.plant import Plant
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot, parse_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")
TIME_S = np.arange(4000) / 8000.0


def answer(parameters, command, axis="zn", robot=ROBOT):
    record = Record.from_signals(TIME_S[: len(command)], {(axis, Tap.CMD): command}, {axis: "m"})
    effect = AxisEffect(axis=axis, id="resonance_mismatch", parameters=parameters)
    return simulate(robot, [effect] if parameters else (), record).signal(axis, Tap.REF)


def lone(kind="stepper", figures="natural_frequency_hz=200.0\ndamping_ratio=0.05\n"):
    gain = "" if kind == "stepper" else "gain=2e-6\n"
    return parse_robot(
        f"[robot]\nname='one'\naxes=['a']\n[axis.a]\nkind='{kind}'\nrange=[0.0, 1e-3]\n"
        f"unit='m'\n{gain}{figures}"
    )


@pytest.mark.parametrize("kind", ["stepper", "piezo"])
@pytest.mark.parametrize(("faster", "duller"), [(0.1, 0.0), (-0.3, 0.5), (0.0, -0.5)])
def test_it_is_the_mode_with_other_figures(kind, faster, duller):
    command = 1e-4 * np.random.default_rng(2).normal(size=800).repeat(5)
    command[0] = 0.0
    parameters = {"frequency_error": faster, "damping_error": duller}
    path = answer(parameters, command, "a", lone(kind))
    rate, ratio = 2 * np.pi * 200.0 * (1 + faster), 0.05 * (1 + duller)
    system = ([rate**2], [1.0, 2 * ratio * rate, rate**2])
    expected = lsim(system, command, TIME_S, interp=False)[1]
    np.testing.assert_allclose(path, expected, atol=1e-12)


def test_the_static_gain_stays():
    command = np.concatenate([[1e-5], np.full(3999, 4e-5)])
    path = answer({"frequency_error": 0.4, "damping_error": 5.0}, command)
    assert path[-1] == pytest.approx(4e-5, rel=1e-6)


def test_a_slow_motion_does_not_show_it():
    slow = 3e-5 + 1e-5 * np.sin(2 * np.pi * 2.0 * TIME_S)
    gap = answer({"frequency_error": 0.2}, slow) - answer({}, slow)
    assert np.abs(gap[500:]).max() < 3e-4 * 1e-5


def test_no_error_is_the_nominal_axis():
    command = 3e-5 + 1e-5 * np.sin(2 * np.pi * 300.0 * TIME_S)
    nothing = {"frequency_error": 0.0, "damping_error": 0.0}
    np.testing.assert_array_equal(answer(nothing, command), answer({}, command))


def test_a_robot_stays_stable_at_the_bounds_of_its_parameters():
    for parameter in RESONANCE_MISMATCH.formulations[0].parameters:
        for value in (parameter.low, parameter.high):
            path = answer({parameter.name: value}, np.full(4000, 3e-5) + 1e-5 * (TIME_S > 0.1))
            assert np.abs(path).max() < 1e-4


def test_coupling_by_mass_is_kept():
    """The plate still carries thx into thy, and more so the nearer its resonance."""
    command = 5e-4 + 1e-4 * np.sin(2 * np.pi * 250.0 * TIME_S)
    effect = AxisEffect(axis="thx", id="resonance_mismatch", parameters={"frequency_error": -0.15})
    still = np.full(4000, 5e-4)
    signals = {("thx", Tap.CMD): command, ("thy", Tap.CMD): still}
    record = Record.from_signals(TIME_S, signals, {"thx": "rad", "thy": "rad"})
    leaks = [
        np.ptp(simulate(ROBOT, used, record).signal("thy", Tap.REF)[3000:])
        for used in ((), [effect])
    ]
    assert leaks[1] > 1.5 * leaks[0] > 0.0


@pytest.mark.parametrize("figures", ["mass=1.0\ndamping=2.0\n"])
def test_an_axis_that_nothing_holds_has_no_resonance(figures):
    robot = lone("force", figures)
    asked = AxisEffect(axis="a", id="resonance_mismatch")
    with pytest.raises(EffectError, match="no resonance"):
        Plant.of(type(robot)(name="one", axes=robot.axes, effects=(asked,)))

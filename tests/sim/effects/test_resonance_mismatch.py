"""Resonance mismatch: the mode shifts or broadens as in its transfer function."""

import numpy as np
import pytest
from scipy.signal import lsim

from rotemina.sim.effects.resonance_mismatch import RESONANCE_MISMATCH
from rotemina.sim.errors import EffectError
from rotemina.sim.plant import Plant
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot, parse_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")
TIME_S = np.arange(4000) / 8000.0


def simulate_position(parameters, command, axis="zn", robot=ROBOT):
    record = Record.from_signals(TIME_S[: len(command)], {(axis, Tap.CMD): command}, {axis: "m"})
    effect = AxisEffect(axis=axis, id="resonance_mismatch", parameters=parameters)
    return simulate(robot, [effect] if parameters else (), record).signal(axis, Tap.REF)


def make_robot(kind="stepper", inertia_lines="natural_frequency_hz=200.0\ndamping_ratio=0.05\n"):
    gain = "" if kind == "stepper" else "gain=2e-6\n"
    return parse_robot(
        f"[robot]\nname='one'\naxes=['a']\n[axis.a]\nkind='{kind}'\nrange=[0.0, 1e-3]\n"
        f"unit='m'\n{gain}{inertia_lines}"
    )


@pytest.mark.parametrize("kind", ["stepper", "piezo"])
@pytest.mark.parametrize(
    ("frequency_error", "damping_error"), [(0.1, 0.0), (-0.3, 0.5), (0.0, -0.5)]
)
def test_the_response_is_that_of_the_changed_mode(kind, frequency_error, damping_error):
    command = 1e-4 * np.random.default_rng(2).normal(size=800).repeat(5)
    command[0] = 0.0
    parameters = {"frequency_error": frequency_error, "damping_error": damping_error}
    path = simulate_position(parameters, command, "a", make_robot(kind))
    rate, ratio = 2 * np.pi * 200.0 * (1 + frequency_error), 0.05 * (1 + damping_error)
    system = ([rate**2], [1.0, 2 * ratio * rate, rate**2])
    expected = lsim(system, command, TIME_S, interp=False)[1]
    np.testing.assert_allclose(path, expected, atol=1e-12)


def test_a_robot_stays_stable_at_the_bounds_of_its_parameters():
    for parameter in RESONANCE_MISMATCH.formulations[0].parameters:
        for value in (parameter.low, parameter.high):
            path = simulate_position(
                {parameter.name: value}, np.full(4000, 3e-5) + 1e-5 * (TIME_S > 0.1)
            )
            assert np.abs(path).max() < 1e-4


def test_coupling_by_mass_remains():
    """The plate still couples thx into thy, and more strongly near the resonance."""
    command = 5e-4 + 1e-4 * np.sin(2 * np.pi * 250.0 * TIME_S)
    effect = AxisEffect(axis="thx", id="resonance_mismatch", parameters={"frequency_error": -0.15})
    constant = np.full(4000, 5e-4)
    signals = {("thx", Tap.CMD): command, ("thy", Tap.CMD): constant}
    record = Record.from_signals(TIME_S, signals, {"thx": "rad", "thy": "rad"})
    amplitudes = [
        np.ptp(simulate(ROBOT, effects, record).signal("thy", Tap.REF)[3000:])
        for effects in ((), [effect])
    ]
    assert amplitudes[1] > 1.5 * amplitudes[0] > 0.0


def test_an_axis_without_stiffness_is_refused():
    robot = make_robot("force", "mass=1.0\ndamping=2.0\n")
    effect = AxisEffect(axis="a", id="resonance_mismatch")
    with pytest.raises(EffectError, match="no resonance"):
        Plant.of(type(robot)(name="one", axes=robot.axes, effects=(effect,)))

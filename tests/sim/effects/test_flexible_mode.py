"""Flexible modes on every kind of axis, compared with state-space models solved by scipy."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.signal import StateSpace, lsim

from rotemina.sim.errors import EffectError
from rotemina.sim.plant import Plant
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect, assemble_inertia_matrices
from rotemina.sim.robot_files import load_robot, parse_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")
RATE_HZ = 8000.0
TIME_S = np.arange(3000) / RATE_HZ
MODE = {"frequency": 510.0, "damping_ratio": 0.03}
MODE_RATE = 2 * np.pi * 510.0
MODE_LOSS = 2 * 0.03 * MODE_RATE
WAVE = np.random.default_rng(3).normal(size=300).repeat(10)
WAVE[0] = 0.0


def simulate_mode(robot, axis, formulation, signals, **parameters):
    effect = AxisEffect(
        axis=axis, id="flexible_mode", formulation=formulation, parameters=parameters
    )
    units = {name: ROBOT.unit(name) or "m" if robot is ROBOT else "m" for name, _ in signals}
    record = Record.from_signals(TIME_S, signals, units)
    return simulate(robot, [effect] if parameters else (), record)


def integrate_state_space(a, b, c, inputs, start=None):
    d = np.zeros((len(c), b.shape[1]))
    return lsim(StateSpace(a, b, c, d), inputs, TIME_S, X0=start, interp=False)[1]


def make_state_space(formulation, mass, damping, stiffness, size):
    """Return A, B, C for the states [q, q̇, z, ż] and the force as input."""
    a = np.zeros((4, 4))
    a[0, 1] = a[2, 3] = 1.0
    a[1, :2] = [-stiffness / mass, -damping / mass]
    a[3, 2:] = [-(MODE_RATE**2), -MODE_LOSS]
    b = np.array([[0.0], [1.0 / mass], [0.0], [0.0]])
    c = np.array([[1.0 - size, 0.0, size, 0.0]])
    if formulation == "series":
        a[3, 0] = MODE_RATE**2
    elif formulation == "parallel":
        b[3, 0] = MODE_RATE**2 / stiffness
    else:  # a mass hung on a spring and a damper
        mode_mass = size * mass
        a[3, :2] = [MODE_RATE**2, MODE_LOSS]
        a[1] += np.array([-(MODE_RATE**2), -MODE_LOSS, MODE_RATE**2, MODE_LOSS]) * mode_mass / mass
        c = np.array([[1.0, 0.0, 0.0, 0.0]])
    return a, b, c


@pytest.mark.parametrize(
    ("formulation", "name"),
    [("parallel", "share"), ("series", "share"), ("appendage", "mass_ratio")],
)
def test_an_uncoupled_axis_moves_as_its_state_space_model(formulation, name):
    command = 0.02 + 1e-5 * WAVE
    record = simulate_mode(
        ROBOT, "x", formulation, {("x", Tap.CMD): command}, **MODE, **{name: 0.2}
    )
    mass, damping, stiffness = ROBOT.axes["x"].inertia
    system = make_state_space(formulation, mass, damping, stiffness, 0.2)
    expected = 0.02 + integrate_state_space(*system, stiffness * (command - 0.02)[:, None])
    np.testing.assert_allclose(record.signal("x", Tap.REF), expected, atol=1e-12)


@pytest.mark.parametrize("formulation", ["parallel", "series", "appendage"])
def test_a_coupled_axis_moves_as_its_state_space_model(formulation):
    """A mode on thx also shows in thy, which is coupled to thx by mass."""
    names, mass, damping, stiffness = assemble_inertia_matrices(ROBOT)
    tilt_indices = [names.index("thx"), names.index("thy")]
    mass, damping, stiffness = (
        matrix[np.ix_(tilt_indices, tilt_indices)] for matrix in (mass, damping, stiffness)
    )
    size = 0.2
    a, b = np.zeros((6, 6)), np.zeros((6, 2))  # [thx, thy, their speeds, z, ż]
    a[:2, 2:4] = np.eye(2)
    a[4, 5] = 1.0
    force = np.hstack([-stiffness, -damping, np.zeros((2, 2))])
    a[5, 4:] = [-(MODE_RATE**2), -MODE_LOSS]
    c = np.eye(2, 6)
    if formulation == "appendage":
        mode_mass = size * ROBOT.axes["thx"].mass
        pull = np.array([-(MODE_RATE**2), 0.0, -MODE_LOSS, 0.0, MODE_RATE**2, MODE_LOSS])
        a[5] = -pull
        force[0] += mode_mass * pull
    else:
        c[0, [0, 4]] = [1.0 - size, size]
    if formulation == "series":
        a[5, 0] = MODE_RATE**2
    a[2:4] = np.linalg.solve(mass, force)
    b[2:4] = np.linalg.solve(mass, stiffness)
    if formulation == "parallel":
        b[5, 0] = MODE_RATE**2
    name = "mass_ratio" if formulation == "appendage" else "share"
    signals = {("thx", Tap.CMD): 5e-4 + 1e-5 * WAVE, ("thy", Tap.CMD): 5e-4 + 1e-5 * WAVE[::-1]}
    signals["thy", Tap.CMD][0] = 5e-4
    record = simulate_mode(ROBOT, "thx", formulation, signals, **MODE, **{name: size})
    commands = np.column_stack(list(signals.values())) - 5e-4
    expected = 5e-4 + integrate_state_space(a, b, c, commands)
    for column, axis in enumerate(("thx", "thy")):
        np.testing.assert_allclose(record.signal(axis, Tap.REF), expected[:, column], atol=1e-13)


@pytest.mark.parametrize("formulation", ["parallel", "series"])
def test_a_static_axis_has_a_mode_between_its_input_and_its_position(formulation):
    robot = parse_robot(
        "[robot]\nname='one'\naxes=['p']\n[axis.p]\nkind='piezo'\nunit='m'\nstatic=true\n"
        "range=[0.0, 4.65e-5]\ngain=1.253e-5\n"
    )
    command = 2e-5 + 1e-6 * WAVE
    record = simulate_mode(robot, "p", formulation, {("p", Tap.CMD): command}, **MODE, share=0.3)
    a = np.array([[0.0, 1.0], [-(MODE_RATE**2), -MODE_LOSS]])
    mode = integrate_state_space(
        a, np.array([[0.0], [MODE_RATE**2]]), np.array([[1.0, 0.0]]), command - 2e-5
    )
    expected = 0.7 * command + 0.3 * (2e-5 + mode)
    np.testing.assert_allclose(record.signal("p", Tap.REF), expected, atol=1e-15)


def test_an_appendage_on_a_static_axis_is_refused():
    robot = load_robot("picma")
    effect = AxisEffect(axis="p", id="flexible_mode", formulation="appendage")
    with pytest.raises(EffectError, match="static"):
        Plant.of(replace(robot, effects=(effect,)))


@pytest.mark.parametrize("stiffness", [0.0, 4e5])
def test_the_mode_of_a_force_axis_is_driven_by_the_force(stiffness):
    stiffness_line = f"stiffness={stiffness}\n" if stiffness else ""
    robot = parse_robot(
        "[robot]\nname='one'\naxes=['a']\n[axis.a]\nkind='force'\nunit='m'\nrange=[-0.1, 0.1]\n"
        f"mass=2.0\ndamping=30.0\ngain=5.0\n{stiffness_line}"
    )
    signals = {("a", Tap.CMD): np.zeros(3000), ("a", Tap.U): 0.1 * WAVE}
    path = simulate_mode(robot, "a", "parallel", signals, **MODE, share=0.2).signal("a", Tap.REF)
    a, b, c = make_state_space("series", 2.0, 30.0, stiffness, 0.2)
    a[3, 0] = 0.0
    b[3, 0] = MODE_RATE**2 / stiffness if stiffness else 1.0 / 2.0
    c[0, 0] = 0.8 if stiffness else 1.0
    expected = integrate_state_space(a, b, c, 5.0 * signals["a", Tap.U][:, None])
    np.testing.assert_allclose(path, expected, atol=1e-12)


def test_an_axis_can_have_several_modes():
    """Two weak parallel modes add nearly the sum of their separate contributions."""
    record = Record.from_signals(TIME_S, {("x", Tap.CMD): 0.02 + 1e-5 * WAVE}, {"x": "m"})
    modes = [
        AxisEffect(axis="x", id="flexible_mode", parameters={"frequency": f, "share": 1e-4})
        for f in (250.0, 700.0)
    ]
    nominal, first, second, both = (
        simulate(ROBOT, effects, record).signal("x", Tap.REF)
        for effects in ((), modes[:1], modes[1:], modes)
    )
    np.testing.assert_allclose(both - nominal, (first - nominal) + (second - nominal), atol=2e-12)
    assert np.ptp(both - nominal) > 1e-10

"""Contact: no effect before its place, and a push beyond it, at any stiffness."""

import numpy as np
import pytest

from rotemina.sim.effects.contact import compute_progressive_force, compute_spring_force
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot, parse_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")
SPAN = {name: axis.span for name, axis in ROBOT.axes.items()}
every_formulation = pytest.mark.parametrize("formulation", ["spring", "progressive", "stop"])
every_force = pytest.mark.parametrize("formulation", ["spring", "progressive"])


def simulate_contact(
    command, formulation="spring", axis="zn", has_contact=True, rate_hz=4000.0, **parameters
):
    """Return the true position of an axis in contact, with ``place`` as a share of its range."""
    signals = {(axis, Tap.CMD): command}
    record = Record.from_signals(
        np.arange(len(command)) / rate_hz, signals, {axis: ROBOT.unit(axis)}
    )
    if "place" in parameters:
        parameters["place"] *= SPAN[axis]
    effect = AxisEffect(axis=axis, id="contact", formulation=formulation, parameters=parameters)
    return simulate(ROBOT, [effect] if has_contact else (), record).signal(axis, Tap.REF)


def make_strength(formulation, value):
    return {"blocked" if formulation == "stop" else "stiffness": value}


def make_swing(centre, amplitude, axis="zn"):
    wave = np.sin(2 * np.pi * 5.0 * np.arange(3000) / 4000.0)
    return ROBOT.axes[axis].range[0] + SPAN[axis] * (centre + amplitude * wave)


@every_formulation
@pytest.mark.parametrize(("axis", "side"), [("zn", 1), ("x", -1)])
def test_the_axis_is_nominal_before_the_place(formulation, axis, side):
    command = make_swing(0.5, 1e-3, axis)
    parameters = make_strength(formulation, 0.9 * side)
    path = simulate_contact(command, formulation, axis, place=0.5 + side * 2e-3, **parameters)
    nominal = simulate_contact(command, formulation, axis, has_contact=False)
    np.testing.assert_allclose(path, nominal, rtol=0, atol=2e-11 * SPAN[axis])


@every_formulation
@pytest.mark.parametrize("side", [1, -1])
def test_the_axis_is_held_back_beyond_the_place(formulation, side):
    command = make_swing(0.5, 0.3)
    path = simulate_contact(
        command, formulation, place=0.5, **make_strength(formulation, 0.9 * side)
    )
    nominal = simulate_contact(command, formulation, has_contact=False)
    beyond = side * (nominal - 0.5 * SPAN["zn"]) > 0.05 * SPAN["zn"]
    assert (side * (nominal - path)[beyond] > 0).all()
    before = np.roll(beyond, 1) | np.roll(beyond, -1) | beyond
    reach = np.abs(nominal - path)
    assert reach[~before].max() < 0.2 * reach.max()


@every_force
@pytest.mark.parametrize("stiffness", [0.1, 30.0, -10.0])
def test_the_axis_rests_where_the_forces_balance(formulation, stiffness):
    """With κ times the stiffness of the axis, the push is ``κ D (δ/D)ⁿ`` times that stiffness."""
    place = SPAN["zn"] * (0.8 if stiffness > 0 else 0.2)
    path = simulate_contact(np.full(2, place), formulation, place=0.5, stiffness=stiffness)
    depth = abs(path[0] - 0.5 * SPAN["zn"])
    power = 1.0 if formulation == "spring" else 1.5
    reference = 0.1 * SPAN["zn"]
    push = abs(stiffness) * reference * (depth / reference) ** power
    assert depth + push == pytest.approx(0.3 * SPAN["zn"], rel=1e-5)
    assert abs(path[1] - path[0]) < 1e-8 * SPAN["zn"]


def test_the_resonance_in_contact_is_that_of_both_springs():
    stiffness = 10.0
    command = np.concatenate([[0.8 * SPAN["zn"]], np.full(4000, 0.801 * SPAN["zn"])])
    path = simulate_contact(
        command, place=0.5, stiffness=stiffness, damping_ratio=0.0, rate_hz=40_000.0
    )
    path = path[1:] - path[-400:].mean()
    upward_rows = np.flatnonzero((path[:-1] < 0) & (path[1:] >= 0))
    crossings = upward_rows - path[upward_rows] / (path[upward_rows + 1] - path[upward_rows])
    frequency_hz = 40_000.0 / np.diff(crossings[1:12]).mean()
    mass, _, axis_stiffness = ROBOT.axes["zn"].inertia
    assert frequency_hz == pytest.approx(
        np.sqrt(axis_stiffness * (1 + stiffness) / mass) / (2 * np.pi), rel=1e-2
    )


def test_a_membrane_of_exponent_one_is_a_spring():
    command = make_swing(0.5, 0.3)
    parameters = {"place": 0.5, "stiffness": 2.0, "damping_ratio": 0.1}
    path = simulate_contact(command, "progressive", exponent=1.0, **parameters)
    np.testing.assert_allclose(
        path, simulate_contact(command, **parameters), atol=2e-3 * SPAN["zn"]
    )


def test_a_stop_blocks_its_share_of_the_motion():
    command = make_swing(0.5, 0.3)
    nominal = simulate_contact(command, has_contact=False)
    for blocked, side in ((0.25, 1), (-0.25, -1), (1.0, 1)):
        path = simulate_contact(command, "stop", place=0.6, blocked=blocked)
        beyond = np.maximum(side * (nominal - 0.6 * SPAN["zn"]), 0.0)
        expected = nominal - side * abs(blocked) * beyond
        np.testing.assert_allclose(path, expected, atol=1e-18)


@pytest.mark.parametrize("step_s", [1e-6, 1e-4, 1e-2])
@pytest.mark.parametrize("stiffness", [1.0, 1e6, 1e12])
def test_the_push_is_stable_at_any_stiffness_and_never_pulls(step_s, stiffness):
    """A free mass of 1 bounces off the spring without gaining speed."""
    a, b = step_s**2 / 2, step_s
    q, v = -1e-3, 0.7
    for _ in range(2000):
        numbers = [1.0, 0.0, stiffness, 0.0]
        push = compute_spring_force(q + v * step_s / 2, v, 0.0, step_s, a, b, numbers, [])
        assert push <= 0.0
        q, v = q + v * step_s + a * push, v + b * push
        assert abs(v) < 0.7 * 1.001
    assert v == pytest.approx(-0.7, rel=1e-3) or step_s == 1e-6 or stiffness == 1.0


@every_force
@pytest.mark.parametrize("speed", [1.0, -1.0])
def test_a_light_touch_pushes_little(formulation, speed):
    """Spring and damper set in gradually, so that a fit of the place meets no jump."""
    step = compute_spring_force if formulation == "spring" else compute_progressive_force
    numbers = [1.0, 0.0, 1e4, 50.0, 1.5, 1.0][: 4 if formulation == "spring" else 6]
    reach = 0.5e-3 if formulation == "spring" else 0.0  # half of the distance of a step
    pushes = [
        step(depth - reach, speed, 0.0, 1e-3, 5e-7, 1e-3, numbers, [])
        for depth in (-1e-7, 1e-7, 1e-6, 1e-5)
    ]
    assert pushes[0] == 0.0
    assert abs(pushes[1]) < 0.02
    assert (np.diff(np.abs(pushes)) >= 0).all()
    if speed > 0:
        assert pushes[3] < 0.0


@every_formulation
def test_the_place_counts_from_the_low_end(formulation):
    robot = parse_robot(
        "[robot]\nname='one'\naxes=['a']\n[axis.a]\nkind='piezo'\nunit='m'\n"
        "range=[-2.0, -1.0]\ngain=0.1\nnatural_frequency_hz=50.0\ndamping_ratio=0.1\n"
    )
    record = Record.from_signals(
        np.arange(2) * 1e-3, {("a", Tap.CMD): np.full(2, -1.2)}, {"a": "m"}
    )
    parameters = {"place": 0.5, **make_strength(formulation, 1.0)}
    effect = AxisEffect(axis="a", id="contact", formulation=formulation, parameters=parameters)
    position = simulate(robot, [effect], record).signal("a", Tap.REF)[0]
    assert -1.5 <= position < -1.3

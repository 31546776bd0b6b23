"""Contact: nothing before a place, and a push beyond it, as stiff as one likes."""

import numpy as np
import pytest

from rotemina.sim.effects.attachment import Attached
from rotemina.sim.effects.contact import progressive, spring, stop
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot, parse_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")
SPAN = {name: axis.span for name, axis in ROBOT.axes.items()}
EVERY = pytest.mark.parametrize("formulation", ["spring", "progressive", "stop"])
FORCES = pytest.mark.parametrize("formulation", ["spring", "progressive"])


def touched(command, formulation="spring", axis="zn", effects=True, rate_hz=4000.0, **parameters):
    """``place`` counts in shares of the range."""
    signals = {(axis, Tap.CMD): command}
    record = Record.from_signals(
        np.arange(len(command)) / rate_hz, signals, {axis: ROBOT.unit(axis)}
    )
    if "place" in parameters:
        parameters["place"] *= SPAN[axis]
    effect = AxisEffect(axis=axis, id="contact", formulation=formulation, parameters=parameters)
    return simulate(ROBOT, [effect] if effects else (), record).signal(axis, Tap.REF)


def strength(formulation, value):
    return {"blocked" if formulation == "stop" else "stiffness": value}


def swing(centre, amplitude, axis="zn"):
    wave = np.sin(2 * np.pi * 5.0 * np.arange(3000) / 4000.0)
    return ROBOT.axes[axis].range[0] + SPAN[axis] * (centre + amplitude * wave)


@EVERY
@pytest.mark.parametrize("axis", ["zn", "x"])
@pytest.mark.parametrize("side", [1, -1])
def test_before_the_place_there_is_nothing(formulation, axis, side):
    command = swing(0.5, 1e-3, axis)
    figures = strength(formulation, 0.9 * side)
    path = touched(command, formulation, axis, place=0.5 + side * 2e-3, **figures)
    nominal = touched(command, formulation, axis, effects=False)
    np.testing.assert_allclose(path, nominal, rtol=0, atol=2e-11 * SPAN[axis])


@EVERY
@pytest.mark.parametrize("side", [1, -1])
def test_beyond_the_place_it_holds_back(formulation, side):
    command = swing(0.5, 0.3)
    path = touched(command, formulation, place=0.5, **strength(formulation, 0.9 * side))
    nominal = touched(command, formulation, effects=False)
    beyond = side * (nominal - 0.5 * SPAN["zn"]) > 0.05 * SPAN["zn"]
    assert (side * (nominal - path)[beyond] > 0).all()
    before = np.roll(beyond, 1) | np.roll(beyond, -1) | beyond
    reach = np.abs(nominal - path)
    assert reach[~before].max() < 0.2 * reach.max()


@FORCES
@pytest.mark.parametrize("stiffness", [0.1, 1.0, 10.0, 30.0, -10.0])
def test_it_rests_where_the_forces_balance(formulation, stiffness):
    """κ of the stiffness of the axis: what pushes back is ``κ D (δ/D)ⁿ`` of it."""
    place = SPAN["zn"] * (0.8 if stiffness > 0 else 0.2)
    path = touched(np.full(2, place), formulation, place=0.5, stiffness=stiffness)
    depth = abs(path[0] - 0.5 * SPAN["zn"])
    power = 1.0 if formulation == "spring" else 1.5
    reference = 0.1 * SPAN["zn"]
    push = abs(stiffness) * reference * (depth / reference) ** power
    assert depth + push == pytest.approx(0.3 * SPAN["zn"], rel=1e-5)
    assert abs(path[1] - path[0]) < 1e-8 * SPAN["zn"]


@pytest.mark.parametrize("stiffness", [1.0, 10.0])
def test_the_resonance_in_contact_is_that_of_both_springs(stiffness):
    command = np.concatenate([[0.8 * SPAN["zn"]], np.full(4000, 0.801 * SPAN["zn"])])
    path = touched(command, place=0.5, stiffness=stiffness, damping_ratio=0.0, rate_hz=40_000.0)
    path = path[1:] - path[-400:].mean()
    up = np.flatnonzero((path[:-1] < 0) & (path[1:] >= 0))
    exact = up - path[up] / (path[up + 1] - path[up])
    found = 40_000.0 / np.diff(exact[1:12]).mean()
    mass, _, own = ROBOT.axes["zn"].inertia
    assert found == pytest.approx(np.sqrt(own * (1 + stiffness) / mass) / (2 * np.pi), rel=1e-2)


def test_a_membrane_of_exponent_one_is_a_spring():
    command = swing(0.5, 0.3)
    figures = {"place": 0.5, "stiffness": 2.0, "damping_ratio": 0.1}
    one = touched(command, "progressive", exponent=1.0, **figures)
    np.testing.assert_allclose(one, touched(command, **figures), atol=2e-3 * SPAN["zn"])


@EVERY
def test_it_goes_smoothly_through_nothing_from_one_side_to_the_other(formulation):
    command = swing(0.5, 0.3)
    nominal = touched(command, formulation, effects=False)
    none = touched(command, formulation, place=0.5, **strength(formulation, 0.0))
    np.testing.assert_allclose(none, nominal, rtol=0, atol=2e-11 * SPAN["zn"])
    for little in (1e-4, -1e-4):
        path = touched(command, formulation, place=0.5, **strength(formulation, little))
        assert 0 < np.abs(path - nominal).max() < 2e-4 * SPAN["zn"]


def test_a_stop_leaves_a_share_of_the_motion():
    command = swing(0.5, 0.3)
    nominal = touched(command, effects=False)
    for blocked, side in ((0.25, 1), (-0.25, -1), (1.0, 1)):
        path = touched(command, "stop", place=0.6, blocked=blocked)
        beyond = np.maximum(side * (nominal - 0.6 * SPAN["zn"]), 0.0)
        expected = nominal - side * abs(blocked) * beyond
        np.testing.assert_allclose(path, expected, atol=1e-18)


@pytest.mark.parametrize("step_s", [1e-6, 1e-4, 1e-2])
@pytest.mark.parametrize("stiffness", [1.0, 1e6, 1e12])
def test_the_push_is_stable_at_any_stiffness_and_never_pulls(step_s, stiffness):
    """A free mass of 1 bounces between the spring and nothing, without gaining speed."""
    a, b = step_s**2 / 2, step_s
    q, v = -1e-3, 0.7
    for _ in range(2000):
        numbers = [1.0, 0.0, stiffness, 0.0]
        push = spring(q + v * step_s / 2, v, 0.0, step_s, a, b, numbers, [])
        assert push <= 0.0
        q, v = q + v * step_s + a * push, v + b * push
        assert abs(v) < 0.7 * 1.001
    assert v == pytest.approx(-0.7, rel=1e-3) or step_s == 1e-6 or stiffness == 1.0


@FORCES
def test_plain_python_says_the_same_on_both_sides(formulation):
    step = spring if formulation == "spring" else progressive
    asked = AxisEffect(axis="zn", id="contact", formulation=formulation)
    attached = Attached.of(ROBOT, asked)
    numbers = list(attached.formulation.numbers(attached.values, attached.facts))
    mirrored = [-1.0, -numbers[1], *numbers[2:]]
    for x, v in ((4.4e-5, 0.1), (4.6e-5, 0.1), (4.6e-5, -0.1), (6e-5, 0.0)):
        push = step(x, v, 0.0, 1e-5, 3e-10, 6e-5, numbers, [])
        back = step(-x, -v, 0.0, 1e-5, 3e-10, 6e-5, mirrored, [])
        assert push == pytest.approx(-back)
        assert push <= 0.0
    assert stop(3.0, 0.0, 0.0, 0.0, 0.0, 0.0, [1.0, 2.0, 0.75], []) == 2.25
    assert stop(-3.0, 0.0, 0.0, 0.0, 0.0, 0.0, [-1.0, -2.0, 0.75], []) == -2.25


@FORCES
@pytest.mark.parametrize("speed", [1.0, -1.0])
def test_a_touch_pushes_as_little_as_it_is_short(formulation, speed):
    """Spring and damper set in evenly, so that a fit of the place meets no jump."""
    step = spring if formulation == "spring" else progressive
    numbers = [1.0, 0.0, 1e4, 50.0, 1.5, 1.0][: 4 if formulation == "spring" else 6]
    reach = 0.5e-3 if formulation == "spring" else 0.0  # half of the way of a step
    pushes = [
        step(depth - reach, speed, 0.0, 1e-3, 5e-7, 1e-3, numbers, [])
        for depth in (-1e-7, 1e-7, 1e-6, 1e-5)
    ]
    assert pushes[0] == 0.0
    assert abs(pushes[1]) < 0.02
    assert (np.diff(np.abs(pushes)) >= 0).all()
    if speed > 0:
        assert pushes[3] < 0.0


@EVERY
def test_the_place_counts_from_the_low_end(formulation):
    robot = parse_robot(
        "[robot]\nname='one'\naxes=['a']\n[axis.a]\nkind='piezo'\nunit='m'\n"
        "range=[-2.0, -1.0]\ngain=0.1\nnatural_frequency_hz=50.0\ndamping_ratio=0.1\n"
    )
    record = Record.from_signals(
        np.arange(2) * 1e-3, {("a", Tap.CMD): np.full(2, -1.2)}, {"a": "m"}
    )
    figures = {"place": 0.5, **strength(formulation, 1.0)}
    asked = AxisEffect(axis="a", id="contact", formulation=formulation, parameters=figures)
    rest = simulate(robot, [asked], record).signal("a", Tap.REF)[0]
    assert -1.5 <= rest < -1.3

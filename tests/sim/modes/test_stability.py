"""Stability verdicts in open loop."""

import re

import numpy as np
import pytest

from rotemina.sim.modes.stability import StabilityVerdict, judge_stability
from rotemina.sim.robot_files import load_robot, parse_robot


def make_robot(damping, stiffness=""):
    return parse_robot(
        "[robot]\nname='m'\naxes=['a']\n[axis.a]\nkind='force'\nunit='m'\nrange=[-1.0,1.0]\n"
        f"gain=1.0\nmass=2.0\ndamping={damping}\n{stiffness}"
    )


def test_each_group_of_the_nominal_robot_is_stable():
    parts = judge_stability(load_robot("rotemina"))
    assert [part.axes for part in parts] == [("x",), ("y",), ("z", "zn"), ("thx", "thy")]
    assert {part.verdict for part in parts} == {StabilityVerdict.STABLE}
    assert "z zn: stable; all 4 poles lie in the left half-plane" in parts[2].message
    assert all((part.poles.real < 0).all() for part in parts)


@pytest.mark.parametrize(
    ("robot", "message"),
    [
        (load_robot("emps"), "q: marginal; one pole at 0"),
        (make_robot(0.0), r"a: marginal; two poles at 0: .*double integrator"),
        (
            make_robot(0.0, "stiffness=800.0"),
            "a: marginal; an undamped pair of poles rings at 3.1831 Hz",
        ),
    ],
)
def test_axes_that_never_come_to_rest_are_marginal(robot, message):
    (part,) = judge_stability(robot)
    assert part.verdict is StabilityVerdict.MARGINAL
    assert re.match(message, part.message)


def test_a_pole_in_the_right_half_is_unstable():
    """Too strong a damping coupling makes D indefinite, which drives one motion."""
    text = "[robot]\nname='m'\naxes=['a','b']\n"
    for name in "ab":
        text += f"[axis.{name}]\nkind='force'\nunit='m'\nrange=[-1.0,1.0]\ngain=1.0\n"
        text += "mass=1.0\ndamping=1.0\nstiffness=100.0\n"
    robot = parse_robot(text + "[[coupling]]\nmatrix='D'\naxes=['a','b']\nvalue=0.5\n")
    assert [part.verdict for part in judge_stability(robot)] == [StabilityVerdict.STABLE]
    strong_coupling = robot.couplings[0].__class__(matrix="D", axes=("a", "b"), value=2.0)
    unstable_robot = type(robot)(name="m", axes=robot.axes, couplings=(strong_coupling,))
    (part,) = judge_stability(unstable_robot)
    assert part.verdict is StabilityVerdict.UNSTABLE
    assert part.poles.real.max() == pytest.approx(0.5)
    assert "a pole at +0.5 1/s" in part.message


def test_a_robot_of_static_axes_has_no_verdicts():
    assert judge_stability(load_robot("picma")) == ()


def test_the_slowest_decay_is_stated():
    (part,) = judge_stability(make_robot(4.0, "stiffness=800.0"))
    assert part.reason.endswith("the slowest decays with 1 s")
    np.testing.assert_allclose(part.poles.real, [-1.0, -1.0])

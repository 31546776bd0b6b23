"""Statements on stability, open loop."""

import re

import numpy as np
import pytest

from rotemina.sim.modes.stability import Verdict, stability
from rotemina.sim.robot.file import load_robot, parse_robot


def axis(damping, stiffness=""):
    return parse_robot(
        "[robot]\nname='m'\naxes=['a']\n[axis.a]\nkind='force'\nunit='m'\nrange=[-1.0,1.0]\n"
        f"gain=1.0\nmass=2.0\ndamping={damping}\n{stiffness}"
    )


def test_the_nominal_robot_is_stable_group_by_group():
    parts = stability(load_robot("rotemina"))
    assert [part.axes for part in parts] == [("x",), ("y",), ("z", "zn"), ("thx", "thy")]
    assert {part.verdict for part in parts} == {Verdict.STABLE}
    assert "z zn: stable; all 4 poles lie in the left half-plane" in parts[2].message
    assert all((part.poles.real < 0).all() for part in parts)


@pytest.mark.parametrize(
    ("robot", "message"),
    [
        (load_robot("emps"), "q: marginal; one pole at 0"),
        (axis(0.0), r"a: marginal; two poles at 0: .*double integrator"),
        (axis(0.0, "stiffness=800.0"), "a: marginal; an undamped pair of poles rings at 3.1831 Hz"),
    ],
)
def test_what_never_comes_to_rest_is_marginal(robot, message):
    (part,) = stability(robot)
    assert part.verdict is Verdict.MARGINAL
    assert re.match(message, part.message)


def test_a_pole_in_the_right_half_is_unstable():
    """Damping by coupling alone, D = [[0, d], [d, 0]], feeds one of its motions."""
    text = "[robot]\nname='m'\naxes=['a','b']\n"
    for name in "ab":
        text += f"[axis.{name}]\nkind='force'\nunit='m'\nrange=[-1.0,1.0]\ngain=1.0\n"
        text += "mass=1.0\ndamping=1.0\nstiffness=100.0\n"
    robot = parse_robot(text + "[[coupling]]\nmatrix='D'\naxes=['a','b']\nvalue=0.5\n")
    assert [part.verdict for part in stability(robot)] == [Verdict.STABLE]
    worse = robot.couplings[0].__class__(matrix="D", axes=("a", "b"), value=2.0)
    spoilt = type(robot)(name="m", axes=robot.axes, couplings=(worse,))
    (part,) = stability(spoilt)
    assert part.verdict is Verdict.UNSTABLE
    assert part.poles.real.max() == pytest.approx(0.5)
    assert "a pole at +0.5 1/s" in part.message


def test_static_axes_have_nothing_to_judge():
    assert stability(load_robot("picma")) == ()


def test_the_slowest_decay_is_stated():
    (part,) = stability(axis(4.0, "stiffness=800.0"))
    assert part.reason.endswith("the slowest decays with 1 s")
    np.testing.assert_allclose(part.poles.real, [-1.0, -1.0])

"""What a plan gives, in figures and curves, and where a simulated cell is put."""

import numpy as np
import pytest

from rotemina.app.motion.penetration.parameters import PenetrationParameters
from rotemina.app.motion.penetration.thrust import ThrustTrace, plan_thrust
from rotemina.app.motion.session import MotionSession
from rotemina.drivers.simulator.driver import Simulator
from rotemina.plugins.penetration.cell_view import cells_text, with_cell, without_cell
from rotemina.plugins.penetration.plan_preview import (
    PlanPreview,
    commanded_curve,
    measured_curve,
    wanted_curve,
)
from rotemina.sim.errors import InputError
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect

ROBOT = load_robot("rotemina")
CREEP = AxisEffect(axis="zn", id="creep")
ELSEWHERE = AxisEffect(axis="z", id="contact")


@pytest.fixture(scope="module")
def session():
    return MotionSession(Simulator(ROBOT))


def plan(**parameters):
    return plan_thrust(ROBOT, PenetrationParameters(**parameters), 1e-3)


def test_figures_are_those_of_the_plan_and_the_place(session):
    preview = PlanPreview.of(session, PenetrationParameters())
    assert preview.figures(ROBOT, 32.5e-6) == (
        "556 µm/s",
        "815 µm/s",
        "50.00 µm",
        "62.00 µm",
        "32.50 µm",
    )
    assert preview.figures(ROBOT, None)[-1] == "–"
    up = PlanPreview.of(session, PenetrationParameters(direction="up"))
    assert up.figures(ROBOT, 10e-6)[-1] == "55.00 µm"


@pytest.mark.parametrize(
    ("parameters", "said"),
    [
        ({"axis": "q"}, "has no axis 'q'"),
        ({"axis": "thx"}, "rotates"),
        ({"duration_s": 3e-3}, "input shaping"),
        ({"shape": "table", "table": [[0, 0], [1, 1]], "shaping": "inverse"}, "feed-forward"),
    ],
)
def test_without_a_plan_it_says_why_and_gives_no_figures(session, parameters, said):
    preview = PlanPreview.of(session, PenetrationParameters(**parameters))
    assert preview.plan is None
    assert said in preview.problem
    assert set(preview.figures(ROBOT, 0.0)) == {"–"}


@pytest.mark.parametrize("direction", ["down", "up"])
@pytest.mark.parametrize("shaping", ["none", "zvd", "inverse"])
def test_curves_go_into_the_cell_and_their_slope_is_their_speed(direction, shaping):
    made = plan(direction=direction, shaping=shaping)
    for curve in (wanted_curve(made), commanded_curve(made)):
        assert curve.way[0] == 0.0
        assert curve.way[-1] == pytest.approx(50e-6, rel=1e-3)
        assert curve.speed.max() == pytest.approx(made.peak_speed, rel=0.02)
        inside = (curve.time_s > 1e-3) & (curve.time_s < 0.089)
        slope = np.gradient(curve.way, curve.time_s)[inside]
        assert np.abs(slope - curve.speed[inside]).max() < 0.03 * made.peak_speed


def test_what_was_measured_is_drawn_over_what_was_wanted():
    made = plan()
    time_s = np.arange(-200, 300) / 1000.0
    curve = measured_curve(ThrustTrace(time_s, made.wanted.position(time_s), made))
    assert curve.time_s[0] >= -0.15 * 0.09
    assert curve.way[-1] == pytest.approx(50e-6)
    assert curve.speed.max() == pytest.approx(made.peak_speed, rel=0.01)
    short = measured_curve(ThrustTrace(time_s[200:203], time_s[200:203], made))
    assert len(short.way) == 3


def test_a_cell_is_put_ahead_moved_and_taken_away():
    once = with_cell(ROBOT, (CREEP, ELSEWHERE), "zn", 59e-6, -1.0, 0.1)
    assert once[:2] == (CREEP, ELSEWHERE)
    assert once[2].parameters == {"place": pytest.approx(59e-6), "stiffness": -0.1}
    moved = with_cell(ROBOT, once, "zn", 40e-6, 1.0, 0.5)
    assert [one.id for one in moved] == ["creep", "contact", "contact"]
    assert moved[2].parameters == {"place": pytest.approx(40e-6), "stiffness": 0.5}
    assert cells_text(ROBOT, moved, "zn") == "A cell at 40.00 µm of Z nano."
    assert without_cell(moved, "zn") == (CREEP, ELSEWHERE)
    assert cells_text(ROBOT, (CREEP, ELSEWHERE), "zn") == "There is no cell."


@pytest.mark.parametrize(
    ("at", "stiffness", "said"),
    [
        (-1e-6, 0.1, "a cell at -1.00 µm of Z nano must be within 0.65 µm to 64.35 µm"),
        (65e-6, 0.1, "must be within 0.65 µm to 64.35 µm"),
        (50e-6, 100.0, "stiffness"),
    ],
)
def test_a_cell_out_of_reach_is_refused(at, stiffness, said):
    with pytest.raises(InputError, match=said):
        with_cell(ROBOT, (), "zn", at, -1.0, stiffness)

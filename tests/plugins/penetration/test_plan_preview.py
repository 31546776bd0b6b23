"""Figures and curves of a plan, and the place of a simulated cell."""

import numpy as np
import pytest

from rotemina.app.motion.penetration import PenetrationParameters, ThrustTrace
from rotemina.app.motion.penetration.thrust import plan_thrust
from rotemina.app.motion.session import MotionSession
from rotemina.drivers.simulator import Simulator
from rotemina.plugins.penetration import PlanPreview
from rotemina.plugins.penetration.cell_view import describe_cells, with_cell, without_cell
from rotemina.plugins.penetration.plan_preview import (
    make_commanded_curve,
    make_desired_curve,
    make_measured_curve,
)
from rotemina.sim.errors import InputError
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")
CREEP = AxisEffect(axis="zn", id="creep")
CONTACT_Z = AxisEffect(axis="z", id="contact")


@pytest.fixture(scope="module")
def session():
    return MotionSession(Simulator(ROBOT))


def plan(**parameters):
    return plan_thrust(ROBOT, PenetrationParameters(**parameters), 1e-3)


def test_figures_show_the_plan_and_the_travel_left(session):
    preview = PlanPreview.plan_for_session(session, PenetrationParameters())
    assert preview.format_figures(ROBOT, 32.5e-6) == (
        "556 µm/s",
        "815 µm/s",
        "50.00 µm",
        "62.00 µm",
        "32.50 µm",
    )
    assert preview.format_figures(ROBOT, None)[-1] == "–"
    up = PlanPreview.plan_for_session(session, PenetrationParameters(direction="up"))
    assert up.format_figures(ROBOT, 10e-6)[-1] == "55.00 µm"


@pytest.mark.parametrize(
    ("parameters", "problem"),
    [
        ({"axis": "q"}, "has no axis 'q'"),
        ({"duration_s": 3e-3}, "input shaping"),
        ({"shape": "table", "table": [[0, 0], [1, 1]], "shaping": "inverse"}, "feed-forward"),
    ],
)
def test_an_impossible_plan_has_a_reason_and_no_figures(session, parameters, problem):
    preview = PlanPreview.plan_for_session(session, PenetrationParameters(**parameters))
    assert preview.plan is None
    assert problem in preview.problem
    assert set(preview.format_figures(ROBOT, 0.0)) == {"–"}


@pytest.mark.parametrize("direction", ["down", "up"])
@pytest.mark.parametrize("shaping", ["none", "inverse"])
def test_the_slope_of_the_depth_curve_is_the_speed(direction, shaping):
    thrust_plan = plan(direction=direction, shaping=shaping)
    for curve in (make_desired_curve(thrust_plan), make_commanded_curve(thrust_plan)):
        assert curve.depth[0] == 0.0
        assert curve.depth[-1] == pytest.approx(50e-6, rel=1e-3)
        assert curve.speed.max() == pytest.approx(thrust_plan.peak_speed, rel=0.02)
        is_inside = (curve.time_s > 1e-3) & (curve.time_s < 0.089)
        slope = np.gradient(curve.depth, curve.time_s)[is_inside]
        assert np.abs(slope - curve.speed[is_inside]).max() < 0.03 * thrust_plan.peak_speed


def test_the_measured_curve_covers_the_planned_thrust():
    thrust_plan = plan()
    time_s = np.arange(-200, 300) / 1000.0
    curve = make_measured_curve(
        ThrustTrace(time_s, thrust_plan.target_shape.position(time_s), thrust_plan)
    )
    assert curve.time_s[0] >= -0.15 * 0.09
    assert curve.depth[-1] == pytest.approx(50e-6)
    assert curve.speed.max() == pytest.approx(thrust_plan.peak_speed, rel=0.01)
    short = make_measured_curve(ThrustTrace(time_s[200:203], time_s[200:203], thrust_plan))
    assert len(short.depth) == 3


def test_a_cell_is_placed_moved_and_removed():
    placed = with_cell(ROBOT, (CREEP, CONTACT_Z), "zn", 59e-6, -1.0, 0.1)
    assert placed[:2] == (CREEP, CONTACT_Z)
    assert placed[2].parameters == {"place": pytest.approx(59e-6), "stiffness": -0.1}
    moved = with_cell(ROBOT, placed, "zn", 40e-6, 1.0, 0.5)
    assert [effect.id for effect in moved] == ["creep", "contact", "contact"]
    assert moved[2].parameters == {"place": pytest.approx(40e-6), "stiffness": 0.5}
    assert describe_cells(ROBOT, moved, "zn") == "A cell at 40.00 µm of Z nano."
    assert without_cell(moved, "zn") == (CREEP, CONTACT_Z)
    assert describe_cells(ROBOT, (CREEP, CONTACT_Z), "zn") == "There is no cell."


@pytest.mark.parametrize(
    ("position", "stiffness", "message"),
    [
        (-1e-6, 0.1, "a cell at -1.00 µm of Z nano must be within 0.65 µm to 64.35 µm"),
        (65e-6, 0.1, "must be within 0.65 µm to 64.35 µm"),
        (50e-6, 100.0, "stiffness"),
    ],
)
def test_a_cell_out_of_reach_is_refused(position, stiffness, message):
    with pytest.raises(InputError, match=message):
        with_cell(ROBOT, (), "zn", position, -1.0, stiffness)

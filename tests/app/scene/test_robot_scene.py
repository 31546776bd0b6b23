"""The robot as it is drawn: true to the kinematics, both ghosts, bounds, what is not to scale."""

import json
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotemina.app.scene.frames import LINKS, exaggerated, frames
from rotemina.app.scene.robot_parts import moving_parts
from rotemina.app.scene.robot_scene import Colours, Ghost, Reading, RobotScene
from rotemina.app.scene.views import View
from rotemina.sim.kinematics.chain import Chain, ChainError
from rotemina.sim.kinematics.forward import tip_position
from rotemina.sim.kinematics.keep_out import KeepOutZone
from rotemina.sim.robot.file import load_robot

COLOURS = Colours("#1c2027", "#8b95a5", "#4c9be8", "#f0a35e", "#d93a3a")
ROBOT = load_robot("rotemina")
CHAIN = Chain.of(ROBOT)


def make():
    return RobotScene(ROBOT, COLOURS, old_s=0.5)


def told(robot_scene, kind, since=0):
    return [c for c in robot_scene.scene.changes(since).commands if c["type"] == kind]


def visible(robot_scene):
    return {
        command["path"]: command["value"]
        for command in told(robot_scene, "set_property")
        if command["property"] == "visible"
    }


def note(robot_scene):
    (command,) = told(robot_scene, "note")
    return command


def positions(joints=None):
    joints = CHAIN.centre if joints is None else joints
    return dict(zip(ROBOT.axes, joints.tolist(), strict=True))


def tip_drawn(robot_scene, ghost):
    """Multiply what a viewer is told, from the root to the pin, and take the pin's lower end."""
    matrices = {
        c["path"]: np.reshape(c["matrix"], (4, 4)).T for c in told(robot_scene, "set_transform")
    }
    place = np.eye(4)
    for path in LINKS.values():
        place = place @ matrices[f"/robot/{ghost}/{path}"]
    return (place @ [0.0, 0.0, -CHAIN.pin_length, 1.0])[:3]


@given(st.lists(st.floats(0.0, 1.0), min_size=6, max_size=6))
def test_frames_lead_to_the_tip_of_the_kinematics(shares):
    joints = CHAIN.lower + np.array(shares) * (CHAIN.upper - CHAIN.lower)
    joints[3:5] *= 300.0  # far beyond what the machine tilts: the order of turns matters there
    place = np.eye(4)
    for frame in frames(joints).values():
        place = place @ frame
    tip = (place @ [0.0, 0.0, -CHAIN.pin_length, 1.0])[:3]
    np.testing.assert_allclose(tip, tip_position(CHAIN, joints), atol=1e-15)


def test_each_ghost_stands_where_its_own_positions_say():
    scene = make()
    there = CHAIN.centre + np.array([1e-3, -2e-3, 3e-3, 4e-4, -3e-4, 2e-5])
    scene.show(Reading(measured=positions(there), model=positions()))
    np.testing.assert_allclose(tip_drawn(scene, "real"), tip_position(CHAIN, there), atol=1e-15)
    centre = tip_position(CHAIN, CHAIN.centre)
    np.testing.assert_allclose(tip_drawn(scene, "model"), centre, atol=1e-15)


def test_the_offset_of_a_sensor_is_no_motion():
    axis = replace(ROBOT.axes["x"], offset=1e-3)
    robot = replace(ROBOT, axes={**ROBOT.axes, "x": axis})
    scene = RobotScene(robot, COLOURS, old_s=0.5)
    read = positions(CHAIN.centre + np.array([1e-3, 0, 0, 0, 0, 0]))
    scene.show(Reading(measured=read, model=read))
    np.testing.assert_allclose(tip_drawn(scene, "real"), tip_position(CHAIN, CHAIN.centre))


def test_the_pin_reaches_from_the_pivot_to_the_tip():
    lower, upper = [], []
    for part in moving_parts(CHAIN):
        if part.link == "pin":
            lower.append(part.middle[2] - part.shape.sizes["height"] / 2)
            upper.append(part.middle[2] + part.shape.sizes["height"] / 2)
    assert min(lower) == pytest.approx(-CHAIN.pin_length)
    assert max(upper) == pytest.approx(0.0)


def test_a_step_sends_transforms_alone():
    scene = make()
    scene.show(Reading(positions(), positions()))
    seen = scene.scene.changes().revision
    scene.show(Reading(positions(CHAIN.centre + 1e-6), positions()))
    changes = scene.scene.changes(seen).commands
    assert {command["type"] for command in changes} == {"set_transform"}
    assert all(command["path"].startswith("/robot/real") for command in changes)
    assert len(json.dumps(changes)) < 2000


@pytest.mark.parametrize("unknown", [{}, {"x": 0.0}, positions() | {"zn": np.nan}])
def test_a_ghost_of_unknown_position_is_not_drawn(unknown):
    scene = make()
    scene.show(Reading(positions(), positions()))
    scene.show(Reading(measured=unknown, model=positions()))
    assert visible(scene)["/robot/real"] is False
    assert visible(scene)["/robot/model"] is True
    assert note(scene)["warnings"] == ["real: position unknown, not drawn"]
    json.dumps(scene.scene.changes().commands, allow_nan=False)


def test_one_ghost_can_be_chosen():
    scene = make()
    scene.show(Reading(positions(), positions()))
    scene.choose(Ghost.MODEL)
    assert visible(scene)["/robot/real"] is False
    assert note(scene)["shown"] == ["model"]
    scene.choose(Ghost.MODEL, Ghost.REAL)
    assert visible(scene)["/robot/real"] is True


def test_nano_motion_is_exaggerated_about_mid_range_and_that_is_said():
    scene = make()
    there = CHAIN.centre + np.array([1e-3, 0.0, 0.0, 1e-4, -2e-4, 1e-5])
    scene.show(Reading(positions(there), positions()))
    assert note(scene)["warnings"] == []
    scene.exaggerate(100.0)
    drawn = CHAIN.centre + np.array([1e-3, 0.0, 0.0, 1e-2, -2e-2, 1e-3])
    np.testing.assert_allclose(tip_drawn(scene, "real"), tip_position(CHAIN, drawn), atol=1e-12)
    assert "100 ×" in note(scene)["warnings"][0]
    np.testing.assert_array_equal(exaggerated(CHAIN, CHAIN.centre, 7.0), CHAIN.centre)


def test_an_old_reading_is_said_in_steps():
    scene = make()
    scene.show(Reading(positions(), positions(), age_s=0.4))
    assert note(scene)["old"] is False
    scene.show(Reading(positions(), positions(), age_s=3.1))
    seen = scene.scene.changes().revision
    assert note(scene)["old"] is True
    assert "3.0 s ago" in note(scene)["warnings"][0]
    scene.show(Reading(positions(), positions(), age_s=3.4))
    assert scene.scene.changes(seen).commands == ()


def test_the_floor_is_drawn_where_it_is_and_the_dish_stands_on_it():
    scene = make()
    assert visible(scene)["/robot/bounds/floor"] is False
    zone = KeepOutZone.of(ROBOT).taught(-0.003)
    scene.bound(zone)
    assert visible(scene)["/robot/bounds/floor"] is True
    objects = {command["path"]: command["object"] for command in told(scene, "set_object")}
    for path in ("/robot/bounds/floor", "/robot/specimen/dish"):
        drawn = objects[path]
        top = drawn["object"]["matrix"][14] + drawn["geometries"][0]["height"] / 2
        assert top == pytest.approx(-0.003)
    scene.bound(zone.taught(None))
    assert visible(scene)["/robot/bounds/floor"] is False


def test_everything_of_the_robot_is_there():
    paths = " ".join(command["path"] for command in told(make(), "set_object"))
    for name in ("x/carriage", "x/y/column", "z/housing", "tilt/plate", "pin/pin"):
        for ghost in Ghost:
            assert any(
                each.startswith(f"/robot/{ghost}/") and each.endswith(name)
                for each in paths.split()
            )
    for name in ("base/rail", "specimen/dish", "specimen/cell"):
        assert f"/robot/{name}" in paths


def test_views_look_from_where_they_say():
    scene = make()
    eyes = {}
    for view in View:
        scene.look(view)
        (command,) = told(scene, "view")
        eyes[view] = np.array(command["eye"])
        assert 0 < command["near"] < np.linalg.norm(command["eye"])
    assert eyes[View.BELOW][2] < 0 < eyes[View.TOP][2]
    assert eyes[View.FRONT][1] < 0
    assert np.linalg.norm(eyes[View.CELL]) < 1e-3


def test_colours_change_everything_that_has_one():
    scene = make()
    scene.paint(replace(COLOURS, model="#010203", background="#ff0000"))
    objects = {c["path"]: c["object"] for c in told(scene, "set_object")}
    material = objects["/robot/model/x/y/z/tilt/plate"]["materials"][0]
    assert material["color"] == 0x010203
    assert note(scene)["colours"]["model"] == "#010203"
    (top,) = (c for c in told(scene, "set_property") if c["property"] == "top_color")
    assert top["value"] == [1.0, 0.0, 0.0]


def test_a_robot_without_the_chain_is_refused_with_the_reason():
    with pytest.raises(ChainError, match="has no axis"):
        RobotScene(load_robot("emps"), COLOURS, old_s=0.5)

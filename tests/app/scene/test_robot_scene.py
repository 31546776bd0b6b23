"""The drawn robot matches the kinematics and shows both ghosts, bounds and exaggeration."""

import json
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from rotemina.app.scene import GhostPositions, RobotGhost, RobotScene, SceneColours, SceneViewpoint
from rotemina.app.scene.link_frames import LINK_PATHS, compute_link_frames, exaggerate_nano_motion
from rotemina.sim.errors import ChainError
from rotemina.sim.kinematics import KeepOutZone, KinematicChain, compute_tip_position
from rotemina.sim.robot_files import load_robot

COLOURS = SceneColours("#1c2027", "#8b95a5", "#4c9be8", "#f0a35e", "#d93a3a")
ROBOT = load_robot("rotemina")
CHAIN = KinematicChain.of(ROBOT)


def make_scene():
    return RobotScene(ROBOT, COLOURS, max_age_s=0.5)


def get_commands(robot_scene, kind, since=0):
    return [
        command
        for command in robot_scene.scene.get_changes(since).commands
        if command["type"] == kind
    ]


def get_visibility(robot_scene):
    return {
        command["path"]: command["value"]
        for command in get_commands(robot_scene, "set_property")
        if command["property"] == "visible"
    }


def get_note(robot_scene):
    (command,) = get_commands(robot_scene, "note")
    return command


def make_positions(joints=None):
    joints = CHAIN.centre if joints is None else joints
    return dict(zip(ROBOT.axes, joints.tolist(), strict=True))


def compute_drawn_tip(robot_scene, ghost):
    """Multiply the transforms sent to viewers, from root to pin, and return the pin's lower end."""
    matrices = {
        command["path"]: np.reshape(command["matrix"], (4, 4)).T
        for command in get_commands(robot_scene, "set_transform")
    }
    transform = np.eye(4)
    for path in LINK_PATHS.values():
        transform = transform @ matrices[f"/robot/{ghost}/{path}"]
    return (transform @ [0.0, 0.0, -CHAIN.pin_length, 1.0])[:3]


@settings(max_examples=20)
@given(st.lists(st.floats(0.0, 1.0), min_size=6, max_size=6))
def test_link_frames_lead_to_the_kinematic_tip(shares):
    joints = CHAIN.lower + np.array(shares) * (CHAIN.upper - CHAIN.lower)
    joints[3:5] *= 300.0  # far beyond the tilt range, so that the order of rotations matters
    transform = np.eye(4)
    for frame in compute_link_frames(joints).values():
        transform = transform @ frame
    tip = (transform @ [0.0, 0.0, -CHAIN.pin_length, 1.0])[:3]
    np.testing.assert_allclose(tip, compute_tip_position(CHAIN, joints), atol=1e-15)


def test_each_ghost_is_drawn_at_its_own_positions():
    scene = make_scene()
    joints = CHAIN.centre + np.array([1e-3, -2e-3, 3e-3, 4e-4, -3e-4, 2e-5])
    scene.show_positions(GhostPositions(measured=make_positions(joints), model=make_positions()))
    np.testing.assert_allclose(
        compute_drawn_tip(scene, "real"), compute_tip_position(CHAIN, joints), atol=1e-15
    )
    centre = compute_tip_position(CHAIN, CHAIN.centre)
    np.testing.assert_allclose(compute_drawn_tip(scene, "model"), centre, atol=1e-15)


def test_sensor_offset_is_not_drawn_as_motion():
    axis = replace(ROBOT.axes["x"], offset=1e-3)
    robot = replace(ROBOT, axes={**ROBOT.axes, "x": axis})
    scene = RobotScene(robot, COLOURS, max_age_s=0.5)
    readings = make_positions(CHAIN.centre + np.array([1e-3, 0, 0, 0, 0, 0]))
    scene.show_positions(GhostPositions(measured=readings, model=readings))
    np.testing.assert_allclose(
        compute_drawn_tip(scene, "real"), compute_tip_position(CHAIN, CHAIN.centre)
    )


def test_step_sends_only_transforms():
    scene = make_scene()
    scene.show_positions(GhostPositions(make_positions(), make_positions()))
    revision = scene.scene.get_changes().revision
    scene.show_positions(GhostPositions(make_positions(CHAIN.centre + 1e-6), make_positions()))
    changes = scene.scene.get_changes(revision).commands
    assert {command["type"] for command in changes} == {"set_transform"}
    assert all(command["path"].startswith("/robot/real") for command in changes)
    assert len(json.dumps(changes)) < 2000


@pytest.mark.parametrize("unknown", [{}, {"x": 0.0}, make_positions() | {"zn": np.nan}])
def test_ghost_of_unknown_position_or_not_chosen_is_not_drawn(unknown):
    scene = make_scene()
    scene.show_positions(GhostPositions(make_positions(), make_positions()))
    scene.show_positions(GhostPositions(measured=unknown, model=make_positions()))
    assert get_visibility(scene)["/robot/real"] is False
    assert get_visibility(scene)["/robot/model"] is True
    assert get_note(scene)["warnings"] == ["real: position unknown, not drawn"]
    json.dumps(scene.scene.get_changes().commands, allow_nan=False)
    scene.show_positions(GhostPositions(make_positions(), make_positions()))
    assert get_visibility(scene)["/robot/real"] is True
    scene.choose_ghosts(RobotGhost.MODEL)
    assert get_visibility(scene)["/robot/real"] is False
    assert get_note(scene)["shown"] == ["model"]


def test_nano_motion_is_exaggerated_about_mid_range_with_a_warning():
    scene = make_scene()
    joints = CHAIN.centre + np.array([1e-3, 0.0, 0.0, 1e-4, -2e-4, 1e-5])
    scene.show_positions(GhostPositions(make_positions(joints), make_positions()))
    assert get_note(scene)["warnings"] == []
    scene.exaggerate(100.0)
    drawn_joints = CHAIN.centre + np.array([1e-3, 0.0, 0.0, 1e-2, -2e-2, 1e-3])
    np.testing.assert_allclose(
        compute_drawn_tip(scene, "real"), compute_tip_position(CHAIN, drawn_joints), atol=1e-12
    )
    assert "100 ×" in get_note(scene)["warnings"][0]
    np.testing.assert_array_equal(exaggerate_nano_motion(CHAIN, CHAIN.centre, 7.0), CHAIN.centre)


def test_age_of_an_old_reading_is_updated_in_steps():
    scene = make_scene()
    scene.show_positions(GhostPositions(make_positions(), make_positions(), age_s=0.4))
    assert get_note(scene)["old"] is False
    scene.show_positions(GhostPositions(make_positions(), make_positions(), age_s=3.1))
    revision = scene.scene.get_changes().revision
    assert get_note(scene)["old"] is True
    assert "3.0 s old" in get_note(scene)["warnings"][0]
    scene.show_positions(GhostPositions(make_positions(), make_positions(), age_s=3.4))
    assert scene.scene.get_changes(revision).commands == ()


def test_floor_is_drawn_at_its_height_with_the_dish_on_it():
    scene = make_scene()
    assert get_visibility(scene)["/robot/bounds/floor"] is False
    zone = KeepOutZone.of(ROBOT).with_floor(-0.003)
    scene.show_bounds(zone)
    assert get_visibility(scene)["/robot/bounds/floor"] is True
    objects = {command["path"]: command["object"] for command in get_commands(scene, "set_object")}
    for path in ("/robot/bounds/floor", "/robot/specimen/dish"):
        drawn_object = objects[path]
        top = drawn_object["object"]["matrix"][14] + drawn_object["geometries"][0]["height"] / 2
        assert top == pytest.approx(-0.003)
    scene.show_bounds(zone.with_floor(None))
    assert get_visibility(scene)["/robot/bounds/floor"] is False


def test_views_look_from_their_named_side():
    scene = make_scene()
    eyes = {}
    for view in SceneViewpoint:
        scene.set_viewpoint(view)
        (command,) = get_commands(scene, "view")
        eyes[view] = np.array(command["eye"])
        assert 0 < command["near"] < np.linalg.norm(command["eye"])
    assert eyes[SceneViewpoint.BELOW][2] < 0 < eyes[SceneViewpoint.TOP][2]
    assert eyes[SceneViewpoint.FRONT][1] < 0
    assert np.linalg.norm(eyes[SceneViewpoint.CELL]) < 1e-3


def test_paint_changes_every_colour():
    scene = make_scene()
    scene.paint(replace(COLOURS, model="#010203", background="#ff0000"))
    objects = {command["path"]: command["object"] for command in get_commands(scene, "set_object")}
    material = objects["/robot/model/x/y/z/tilt/plate"]["materials"][0]
    assert material["color"] == 0x010203
    assert get_note(scene)["colours"]["model"] == "#010203"
    (top,) = (
        command
        for command in get_commands(scene, "set_property")
        if command["property"] == "top_color"
    )
    assert top["value"] == [1.0, 0.0, 0.0]


def test_robot_without_the_chain_is_refused_with_a_reason():
    with pytest.raises(ChainError, match="has no axis"):
        RobotScene(load_robot("emps"), COLOURS, max_age_s=0.5)

"""The picture that needs no GPU: where points are, what covers what, what is cut off."""

from itertools import pairwise

import numpy as np
import pytest

from rotemina.app.scene.camera import Camera, pixels
from rotemina.app.scene.meshes import mesh_of
from rotemina.app.scene.painter_order import painter_order
from rotemina.app.scene.projected_picture import Picture
from rotemina.app.scene.robot_scene import Colours, Ghost, Reading, RobotScene
from rotemina.app.scene.solids import Look, Solid, box, ellipsoid, set_object, tube
from rotemina.app.scene.views import View
from rotemina.sim.kinematics.forward import tip_position
from rotemina.sim.robot.file import load_robot

WIDTH, HEIGHT = 800, 600
COLOURS = Colours("#1c2027", "#8b95a5", "#4c9be8", "#f0a35e", "#d93a3a")


def camera(target=(0.0, 0.0, 0.0), offset=(0.0, -1.0, 0.0)):
    return Camera(np.array(target), np.array(offset), 0.02)


@pytest.fixture
def robot_scene():
    scene = RobotScene(load_robot("rotemina"), COLOURS, old_s=0.5)
    place(scene)
    return scene


def place(scene, **moved):
    centre = dict(zip(scene.chain.robot.axes, scene.chain.centre.tolist(), strict=True))
    scene.show(Reading(centre | moved, centre))


def picture_of(scene):
    picture = Picture()
    for command in scene.scene.changes().commands:
        picture.obey(command)
    return picture


def test_a_known_point_is_at_its_pixel():
    (middle, right, above) = pixels(
        camera().seen(np.array([[0, 0, 0], [0.1, 0, 0], [0, 0, 0.1]])), WIDTH, HEIGHT
    )
    per_metre = HEIGHT / 2 / np.tan(np.radians(31))  # an angle of 62° from top to bottom
    assert middle == pytest.approx([400, 300])
    assert right == pytest.approx([400 + 0.1 * per_metre, 300])
    assert above == pytest.approx([400, 300 - 0.1 * per_metre])


def test_the_camera_turns_about_its_target_comes_nearer_and_shifts():
    seen = camera((0.1, 0.2, 0.3))
    for other in (seen.turned(0.7, 0.4), seen.turned(0.0, 99.0)):
        assert other.seen(seen.target[None])[0] == pytest.approx([0, 0, 1])
    assert seen.turned(np.pi / 2, 0.0).offset == pytest.approx([1, 0, 0])
    assert seen.nearer(2.0).offset == pytest.approx([0, -0.5, 0])
    assert seen.nearer(2.0).near == pytest.approx(0.01)
    assert np.linalg.norm(seen.nearer(1e9).offset) > 0
    shifted = seen.shifted(30, 20, HEIGHT)
    at = pixels(shifted.seen(seen.target[None]), WIDTH, HEIGHT)[0]
    assert at == pytest.approx([400 - 30, 300 + 20])


@pytest.mark.parametrize(
    ("shape", "volume"),
    [
        (box(1, 2, 3), 6.0),
        (tube(1, 2), 2 * np.pi),
        (tube(1, 3, foot=1e-6), np.pi),
        (ellipsoid((1, 2, 3)), 8 * np.pi),
    ],
)
def test_faces_enclose_the_solid_and_their_normals_point_outwards(shape, volume):
    mesh = mesh_of(set_object("/a", Solid(shape, (5.0, 6.0, 7.0), Look("#ffffff"))))
    assert np.linalg.norm(mesh.normals, axis=1) == pytest.approx(1)
    found = 0.0  # by the divergence theorem
    for face, normal in zip(mesh.faces, mesh.normals, strict=True):
        first, *others = mesh.points[face] - [5.0, 6.0, 7.0]
        for one, other in pairwise(others):
            area = np.linalg.norm(np.cross(one - first, other - first)) / 2
            found += area * (first @ normal) / 3
    assert found == pytest.approx(volume, rel=0.08)
    assert found < volume * (1 + 1e-9)  # inside the round ones


def test_the_nearer_solid_is_painted_later_and_a_veil_over_what_it_shares_a_place_with():
    low = np.array([[0, 0, 0], [0, 0, 1], [0, 0, 2], [0, 0, 1.0]])
    veil = np.array([False, False, False, True])
    above, below = np.array([0.5, 0.5, 9.0]), np.array([0.5, 0.5, -9.0])
    assert painter_order(low, low + 1, above, veil) == [0, 1, 3, 2]
    assert painter_order(low, low + 1, below, veil) == [2, 1, 3, 0]


def test_a_large_plate_below_does_not_cover_a_small_box_whose_middle_is_farther():
    low, high = np.array([[-9, -9, -1], [7, 7, 0.0]]), np.array([[9, 9, 0], [8, 8, 1.0]])
    order = painter_order(low, high, np.array([-5, -5, 3.0]), np.array([False, False]))
    assert order == [0, 1]


def test_the_tip_is_drawn_where_the_kinematics_have_it(robot_scene):
    robot_scene.choose(Ghost.REAL)
    robot_scene.look(View.FRONT)
    picture = picture_of(robot_scene)
    drawn = {one.path: one for one in picture.drawn(WIDTH, HEIGHT)}
    assert not any(path.startswith("/robot/model") for path in drawn)
    tip = tip_position(robot_scene.chain, robot_scene.chain.centre)
    expected = pixels(picture.camera.seen(np.array([tip])), WIDTH, HEIGHT)[0]
    corners = drawn["/robot/real/x/y/z/tilt/pin/pin"].lines.reshape(-1, 2)
    lowest = corners[corners[:, 1] > corners[:, 1].max() - 0.5]
    assert lowest.mean(axis=0) == pytest.approx(expected, abs=0.5)


def test_a_moved_axis_moves_the_pixels_of_its_body_and_no_others(robot_scene):
    robot_scene.look(View.FRONT)

    def lines():
        return {one.path: one.lines for one in picture_of(robot_scene).drawn(WIDTH, HEIGHT)}

    before = lines()
    middle = robot_scene.chain.centre[0]
    place(robot_scene, x=middle + 2e-3)
    after = lines()
    for path in ("/robot/real/x/carriage", "/robot/real/x/y/z/housing"):
        right = np.mean(after[path][:, 0]) - np.mean(before[path][:, 0])
        assert 1 < right < 10
    for path in ("/robot/base/base", "/robot/model/x/carriage", "/robot/specimen/cell"):
        assert after[path] == pytest.approx(before[path])


@pytest.mark.parametrize("view", View)
def test_every_view_stays_within_the_picture_and_shows_both_robots(robot_scene, view):
    robot_scene.look(view)
    drawn = picture_of(robot_scene).drawn(WIDTH, HEIGHT)
    assert {one.path.split("/")[2] for one in drawn} >= {"model", "real"}
    corners = np.vstack([np.array(face) for one in drawn for face in one.faces])
    lines = np.vstack([one.lines.reshape(-1, 2) for one in drawn])
    for found in (corners, lines):
        centred = np.abs(found - [WIDTH / 2, HEIGHT / 2]) / [WIDTH, HEIGHT]
        assert np.all(centred <= 0.55 + 1e-9)


def test_nothing_is_drawn_before_a_view_or_of_a_hidden_robot(robot_scene):
    assert Picture().drawn(WIDTH, HEIGHT) == []
    robot_scene.show(Reading({}, {}))
    drawn = picture_of(robot_scene).drawn(WIDTH, HEIGHT)
    assert {one.path.split("/")[2] for one in drawn} <= {"base", "specimen", "bounds"}
